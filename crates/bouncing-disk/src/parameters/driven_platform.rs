//! A platform that moves and turns with any periodic motion, in SI units.

use std::f64::consts::TAU;
use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use bouncing_disk_core::{ImpactMap, Vibration};
use bouncing_disk_drives::DrivenFamily;
use bouncing_disk_drives::{Drive, DrivenMap};

use crate::display::rough;
use crate::error::{Error, check, finite};
use crate::parameters::contact::ContactLaw;
use crate::parameters::disk::Disk;
use crate::parameters::platform::Platform;
use crate::parameters::scales::Scales;

/// Largest accepted [`Waveform::acceleration_change`]: it is 0.25 for 6 samples of a sine, 0.5 for a corner and
/// 0.8 for pure noise.
const LARGEST_CHANGE: f64 = 0.3;

/// Largest difference between two samples of the same instant, as a share of the range of all samples.
const SAME_INSTANT: f64 = 1.0e-3;

/// The least ratios of the fourth difference with a duplicated last sample to the difference without it, and to
/// the usual difference. Smooth shapes of 16 samples reach 2 and 4 at their turning points, and more elsewhere.
const STANDS_OUT: [f64; 2] = [1.5, 3.0];

/// The shape of a motion over one period tau = 0 to 2 pi: the height or the angle, divided by its amplitude.
/// [`DrivenPlatform::new`] checks it.
///
/// In a file: `"triangle"`, `{ sawtooth = 0.3 }`, `{ fourier = [[1.0, 0.0], [0.1, 1.5]] }`.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", try_from = "Given"))]
#[non_exhaustive]
pub enum Waveform {
    /// sin(tau), as in Eq. (1).
    #[default]
    Sine,
    /// The pairs (a_j, phi_j) of a sum of a_j sin(j tau + phi_j) over j = 1, 2, ..., at most
    /// [`MAX_HARMONICS`](bouncing_disk_drives::drive::MAX_HARMONICS).
    Fourier(Vec<(f64, f64)>),
    /// Consecutive pieces (duration, [c0, c1, c2, c3]): c0 + c1 x + c2 x^2 + c3 x^3, x from the start of the
    /// piece. x and the durations are in periods; the durations sum to 1. The height must be continuous; the
    /// velocity may jump. At most [`MAX_PIECES`](bouncing_disk_drives::drive::MAX_PIECES).
    Pieces(Vec<(f64, [f64; 4])>),
    /// The periodic cubic spline through at least 3 equidistant samples over one period.
    Sampled(Vec<f64>),
    /// Straight lines through the zeros and extremes of the sine.
    Triangle,
    /// Straight lines from 0 at tau = 0 to 1, to -1 and back to 0. They rise for the given share of the
    /// period, in [1e-9, 1 - 1e-9], and fall for the rest.
    Sawtooth(f64),
    /// One parabola in each half-period of the sine.
    Parabolas,
    /// One cubic in each quarter-period: the spline through the zeros and extremes of the sine.
    Cubics,
}

/// The serialised form of a shape; it accepts any value, because serde's own errors name Rust types.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(untagged, deny_unknown_fields)]
enum Given {
    Name(String),
    Sawtooth { sawtooth: f64 },
    Fourier { fourier: Vec<(f64, f64)> },
    Pieces { pieces: Vec<(f64, Vec<f64>)> },
    Sampled { sampled: Vec<f64> },
    Other(serde::de::IgnoredAny),
}

#[cfg(feature = "serde")]
impl TryFrom<Given> for Waveform {
    type Error = String;

    fn try_from(given: Given) -> Result<Self, String> {
        let wrong = if let Given::Name(name) = &given { format!("{name:?}") } else { "this".to_owned() };
        let piece = |(duration, mut own): (f64, Vec<f64>)| {
            own.resize(own.len().max(4), 0.0);
            Some((duration, own.try_into().ok()?))
        };
        let shape = match given {
            Given::Sawtooth { sawtooth } => Some(Self::Sawtooth(sawtooth)),
            Given::Fourier { fourier } => Some(Self::Fourier(fourier)),
            Given::Pieces { pieces } => {
                pieces.into_iter().map(piece).collect::<Option<_>>().map(Self::Pieces)
            }
            Given::Sampled { sampled } => Some(Self::Sampled(sampled)),
            Given::Name(name) => {
                let named = [Self::Sine, Self::Triangle, Self::Parabolas, Self::Cubics];
                named.into_iter().find(|shape| shape.to_string() == name)
            }
            Given::Other(_) => None,
        };
        shape.ok_or_else(|| {
            format!(
                "{wrong} is not a shape; write \"sine\", \"triangle\", \"parabolas\", \"cubics\", {{ sawtooth = 0.3 }}, \
                 {{ fourier = [[1.0, 0.0], [0.1, 1.5]] }}, {{ sampled = [0.0, 1.0, -1.0] }} or {{ pieces = \
                 [[0.5, [0.0, 1.0]], [0.5, [0.5, -1.0]]] }} with at most 4 coefficients"
            )
        })
    }
}

/// A parameter that varies over a family of maps.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum MapNumber {
    /// `axial_forcing`: the forcing Gamma.
    AxialForcing,
    /// `restitution`.
    Restitution,
    /// `contact_periods`: the duration of a compliant contact (periods).
    ContactPeriods,
    /// A parameter of the shape, by its name and position in a file, counted from 0: `sawtooth`,
    /// `fourier[1][0]` for the amplitude of the second harmonic, `sampled[3]`.
    OfShape((String, Vec<usize>)),
}

impl FromStr for MapNumber {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let known = [Self::AxialForcing, Self::Restitution, Self::ContactPeriods];
        if let Some(own) = known.into_iter().find(|own| own.to_string() == text) {
            return Ok(own);
        }
        let mut parts = text.split('[');
        let name = parts.next().unwrap_or_default();
        let place = parts.map(|part| part.strip_suffix(']')?.parse().ok()).collect::<Option<_>>();
        Ok(Self::OfShape((name.to_owned(), place.ok_or(Error::NoSuchNumber)?)))
    }
}

/// Formats it as it is parsed.
impl Display for MapNumber {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::AxialForcing => f.write_str("axial_forcing"),
            Self::Restitution => f.write_str("restitution"),
            Self::ContactPeriods => f.write_str("contact_periods"),
            Self::OfShape((name, place)) => {
                f.write_str(name)?;
                place.iter().try_for_each(|index| write!(f, "[{index}]"))
            }
        }
    }
}

impl Display for Waveform {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sine => f.write_str("sine"),
            Self::Fourier(harmonics) => write!(f, "Fourier sum of {} harmonics", harmonics.len()),
            Self::Pieces(pieces) => write!(f, "{} pieces", pieces.len()),
            Self::Sampled(samples) => write!(f, "{} samples", samples.len()),
            Self::Triangle => f.write_str("triangle"),
            Self::Sawtooth(rise) => write!(f, "sawtooth, rise {rise}"),
            Self::Parabolas => f.write_str("parabolas"),
            Self::Cubics => f.write_str("cubics"),
        }
    }
}

impl Waveform {
    /// Checks that the shape is the sine of Eq. (1).
    ///
    /// # Errors
    /// [`Error::DriveNotSine`].
    pub fn sine(&self) -> Result<(), Error> {
        if *self == Self::Sine { Ok(()) } else { Err(Error::DriveNotSine) }
    }

    /// The impact map for a height of this shape, with the amplitude and the restitution of `sine`. If an
    /// impact lasts `contact_periods` (periods), the map leads from one release to the next
    /// ([`DrivenMap::with_contact_time`]).
    ///
    /// # Errors
    /// The errors of [`DrivenPlatform::new`] and [`DrivenMap::with_contact_time`]; [`Error::OutOfRange`] for
    /// a contact time outside [1e-6, 1000] periods.
    pub fn map(&self, sine: &ImpactMap, contact_periods: Option<f64>) -> Result<DrivenMap, Error> {
        let track = self.track("height", sine.vibration().peak_acceleration(), 0.0)?;
        let map = DrivenMap::new(track, sine.restitution())?;
        let Some(periods) = contact_periods else { return Ok(map) };
        let legal = "[1e-6, 1000] (periods of the platform)";
        check((1e-6..=1000.0).contains(&periods), "contact_periods", periods, legal)?;
        Ok(map.with_contact_time(TAU * periods)?)
    }

    /// A family of [`Self::map`]s that differ in one parameter: the forcing, the restitution, the contact
    /// time, or a parameter of the shape, by its position.
    ///
    /// ```
    /// use bouncing_disk::core::orbits::{
    ///     BifurcationKind, Continuation, ContinuationParameter, ContinuedMap as _, OrbitSearch, Stability,
    /// };
    /// use bouncing_disk::core::{ImpactMap, Unobserved, Vibration};
    /// use bouncing_disk::parameters::{MapNumber, Waveform};
    ///
    /// let shape = Waveform::Fourier(vec![(1.0, 0.0), (0.1, 0.3)]);
    /// let sine = ImpactMap::new(Vibration::from_axial_forcing(0.36)?, 0.5)?;
    /// let family = shape.family(&sine, None, "fourier[1][0]".parse()?)?;
    /// let orbits = family.map().periodic_orbits(&OrbitSearch::new(1, 1)?, &Unobserved)?;
    /// let settings = Continuation::new(ContinuationParameter::Number, (-0.5, 0.5), true)?;
    /// let node = orbits.iter().find(|orbit| orbit.stability() == Stability::Stable).expect("exists");
    /// let branch = family.continued(node, &settings, &Unobserved)?;
    /// assert!(branch.of_kind(BifurcationKind::Doubling).next().is_some());
    /// # Ok::<(), bouncing_disk::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`Self::map`]; [`Error::NoSuchNumber`] for a position that the shape does not have.
    pub fn family(
        &self,
        sine: &ImpactMap,
        contact_periods: Option<f64>,
        number: MapNumber,
    ) -> Result<DrivenFamily, Error> {
        let (now, unit) = self.number_now(sine, contact_periods, &number)?;
        let with = self.maps(sine, contact_periods, [number]);
        Ok(DrivenFamily::new(now, unit, move |value| with([value]))?)
    }

    /// The maps that differ in two numbers, for curves of bifurcations over both.
    ///
    /// # Errors
    /// The errors of [`Self::family`], for either number.
    pub fn family_of_two(
        &self,
        sine: &ImpactMap,
        contact_periods: Option<f64>,
        numbers: [MapNumber; 2],
    ) -> Result<DrivenFamily, Error> {
        let [first, second] = &numbers;
        let (one, unit) = self.number_now(sine, contact_periods, first)?;
        let (other, other_unit) = self.number_now(sine, contact_periods, second)?;
        let with = self.maps(sine, contact_periods, numbers);
        Ok(DrivenFamily::of_two([one, other], [unit, other_unit], with)?)
    }

    /// The value of a number, and its unit in the arclength of a branch.
    fn number_now(
        &self,
        sine: &ImpactMap,
        contact_periods: Option<f64>,
        number: &MapNumber,
    ) -> Result<(f64, f64), Error> {
        self.map(sine, contact_periods)?;
        let forcing = sine.vibration().axial_forcing();
        Ok(match number {
            MapNumber::AxialForcing => (forcing, forcing),
            MapNumber::Restitution => (sine.restitution(), 1.0),
            MapNumber::ContactPeriods => (contact_periods.ok_or(Error::NoSuchNumber)?, 1.0),
            MapNumber::OfShape(place) => (*self.clone().number(place).ok_or(Error::NoSuchNumber)?, 1.0),
        })
    }

    /// The map for each value of these numbers.
    fn maps<const N: usize>(
        &self,
        sine: &ImpactMap,
        contact_periods: Option<f64>,
        numbers: [MapNumber; N],
    ) -> impl Fn([f64; N]) -> Option<DrivenMap> + Send + Sync + 'static {
        let (shape, sine) = (self.clone(), *sine);
        move |values| {
            let (mut shape, mut periods) = (shape.clone(), contact_periods);
            let (mut vibration, mut restitution) = (*sine.vibration(), sine.restitution());
            for (number, value) in numbers.iter().zip(values) {
                match number {
                    MapNumber::AxialForcing => vibration = Vibration::from_axial_forcing(value).ok()?,
                    MapNumber::Restitution => restitution = value,
                    MapNumber::ContactPeriods => periods = Some(value),
                    MapNumber::OfShape(place) => *shape.number(place)? = value,
                }
            }
            shape.map(&ImpactMap::new(vibration, restitution).ok()?, periods).ok()
        }
    }

    /// A parameter of the shape by its position.
    fn number(&mut self, place: &(String, Vec<usize>)) -> Option<&mut f64> {
        match (self, place.0.as_str(), &place.1[..]) {
            (Self::Sawtooth(rise), "sawtooth", []) => Some(rise),
            (Self::Sampled(samples), "sampled", [k]) => samples.get_mut(*k),
            (Self::Fourier(harmonics), "fourier", [j, 0]) => harmonics.get_mut(*j).map(|own| &mut own.0),
            (Self::Fourier(harmonics), "fourier", [j, 1]) => harmonics.get_mut(*j).map(|own| &mut own.1),
            (Self::Pieces(pieces), "pieces", [k, 0]) => pieces.get_mut(*k).map(|own| &mut own.0),
            (Self::Pieces(pieces), "pieces", [k, 1, c]) => pieces.get_mut(*k)?.1.get_mut(*c),
            _ => None,
        }
    }

    /// The largest change of the acceleration at the samples if every second sample is removed, as a share of
    /// its peak.
    fn acceleration_change(&self) -> Option<f64> {
        let Self::Sampled(samples) = self else { return None };
        let bend = |k: usize| {
            let y = |k: usize| samples[k % samples.len()];
            y(k + 2) - 2.0 * y(k + 1) + y(k)
        };
        let (mut change, mut peak) = (0.0_f64, 0.0_f64);
        for k in 0..samples.len() {
            // Second differences over one step and over two differ by a quarter of the fourth difference.
            change = change.max(0.25 * (bend(k + 2) - 2.0 * bend(k + 1) + bend(k)).abs());
            peak = peak.max(bend(k).abs());
        }
        Some(change / peak)
    }

    /// Whether the last sample repeats the first: the two are nearly equal, also compared with their
    /// neighbours, and the fourth differences there stand out with the last sample but not without it. Noise
    /// on a shape that rests at both ends does not trigger this, as its fourth differences are equally large
    /// everywhere.
    fn repeats_its_first_sample(&self) -> bool {
        let Self::Sampled(samples) = self else { return false };
        let count = samples.len();
        let difference = |y: &[f64]| (y[0] - 4.0 * y[1] + 6.0 * y[2] - 4.0 * y[3] + y[4]).abs();
        let mut elsewhere: Vec<_> = samples.windows(5).map(difference).collect();
        elsewhere.sort_by(f64::total_cmp);
        let Some(typical) = elsewhere.get(elsewhere.len() / 2) else { return false };
        // The last three samples and the first three.
        let [c, b, last, first, second, third] = [3, 2, 1, 0, -1, -2].map(|back| {
            let place = (count as i64 - back) % count as i64;
            samples[place as usize]
        });
        let range = |pick: fn(f64, f64) -> f64| samples.iter().copied().fold(first, pick);
        let gap = (last - first).abs();
        let neighbours = (second - first).abs().max((last - b).abs());
        let is_closed = gap <= SAME_INSTANT * (range(f64::max) - range(f64::min)) && 8.0 * gap < neighbours;
        let without = difference(&[c, b, first, second, third]);
        let with = difference(&[c, b, last, first, second]).max(difference(&[b, last, first, second, third]));
        is_closed && with > STANDS_OUT[0] * without && with > STANDS_OUT[1] * typical
    }

    /// The motion with this amplitude, advanced by `lag` (rad).
    pub(crate) fn track(&self, of: &'static str, amplitude: f64, lag: f64) -> Result<Drive, Error> {
        let refuse = |source| match source {
            bouncing_disk_core::Error::HeightJump { piece, jump } => {
                Error::WaveformJump { of, piece, jump: jump / amplitude }
            }
            source => Error::Waveform { of, source },
        };
        let track = match self {
            Self::Sine => Drive::fourier(&[(amplitude, 0.0)]),
            Self::Fourier(harmonics) => {
                let harmonics = harmonics.iter().map(|(a, phase)| (amplitude * a, *phase));
                Drive::fourier(&harmonics.collect::<Vec<_>>())
            }
            Self::Sampled(samples) => {
                let samples: Vec<_> = samples.iter().map(|sample| amplitude * sample).collect();
                Drive::sampled(&samples)
            }
            Self::Pieces(pieces) => {
                let total = pieces.iter().fold(0.0, |sum, (duration, _)| sum + duration);
                if pieces.iter().all(|(duration, _)| *duration > 0.0) {
                    let legal = (total - 1.0).abs() <= 1.0e-12;
                    check(legal, "sum of the durations of the pieces", total, "1 (in periods)")?;
                }
                pieces_of(pieces, amplitude)
            }
            Self::Triangle => Drive::triangle(amplitude),
            Self::Sawtooth(rise) => Drive::sawtooth(amplitude, *rise),
            Self::Parabolas => Drive::parabolas(amplitude),
            Self::Cubics => Drive::cubics(amplitude),
        };
        track.and_then(|track| track.earlier(lag)).map_err(refuse)
    }

    /// Checks that need neither amplitude nor disk.
    fn check(&self, of: &'static str) -> Result<(), Error> {
        if *self == Self::Sine {
            return Ok(());
        }
        // A power of two, so small that no acceleration is too large.
        let amplitude = 1.0 / (1_u128 << 100) as f64;
        self.track(of, amplitude, 0.0).map(|_| ())
    }
}

/// Pieces with durations in periods, scaled in height by `size`.
fn pieces_of(pieces: &[(f64, [f64; 4])], size: f64) -> Result<Drive, bouncing_disk_core::Error> {
    let scaled = |&(duration, [c0, c1, c2, c3]): &(f64, [f64; 4])| {
        let c = [c0 * size, c1 * size / TAU, c2 * size / (TAU * TAU), c3 * size / (TAU * TAU * TAU)];
        (duration * TAU, c)
    };
    Drive::pieces(&pieces.iter().map(scaled).collect::<Vec<_>>())
}

/// A [`Platform`] with any [`Waveform`]s f and h instead of its sines: the height is A f(tau), the angle Phi
/// h(tau + theta). The axial forcing Gamma = A omega^2/(pi g) keeps its form: A multiplies f as given, and is
/// half the stroke only if f ranges from -1 to 1.
///
/// ```
/// use bouncing_disk::System;
/// use bouncing_disk::parameters::{DrivenPlatform, Waveform};
///
/// // The hand of Table I, moved along straight lines.
/// let hand = *System::pizza_toss().platform();
/// assert!(DrivenPlatform::new(hand, Waveform::Triangle, Waveform::Triangle).is_ok());
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DrivenPlatform {
    platform: Platform,
    height: Waveform,
    angle: Waveform,
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    contact: Option<(ContactLaw, f64)>,
}

impl DrivenPlatform {
    /// A platform with these waveforms of height and angle.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a number outside its range; [`Error::Waveform`] and [`Error::WaveformJump`]
    /// for an invalid waveform, with its harmonic, piece or sample.
    pub fn new(platform: Platform, height: Waveform, angle: Waveform) -> Result<Self, Error> {
        height.check("height")?;
        angle.check("angle")?;
        Ok(Self { platform, height, angle, contact: None })
    }

    /// This platform with the motion that the table `[drive]` of a file specifies.
    ///
    /// # Errors
    /// The errors of [`Self::new`]; [`Error::StartPhase`] if the table contains a start phase.
    pub fn of_drive(platform: Platform, drive: &DriveParameters) -> Result<Self, Error> {
        if drive.start_phase.is_some() {
            return Err(Error::StartPhase);
        }
        Self::new(platform, drive.height.clone(), drive.angle.clone())
    }

    /// This platform with contacts of this law and duration (s), as from [`System::soft_contact`]; `None` for
    /// rigid impacts.
    ///
    /// [`System::soft_contact`]: crate::System::soft_contact
    #[must_use]
    pub fn with_contact(self, contact: Option<(ContactLaw, f64)>) -> Self {
        Self { contact, ..self }
    }

    /// The law and the duration (s) of compliant contacts.
    #[must_use]
    pub const fn contact(&self) -> Option<(ContactLaw, f64)> {
        self.contact
    }

    /// Amplitudes, frequency and phase lag.
    #[must_use]
    pub const fn platform(&self) -> &Platform {
        &self.platform
    }

    /// The shape of the height.
    #[must_use]
    pub const fn height(&self) -> &Waveform {
        &self.height
    }

    /// The shape of the angle.
    #[must_use]
    pub const fn angle(&self) -> &Waveform {
        &self.angle
    }

    /// The SI values of the units in which a motion of this disk is computed.
    #[must_use]
    pub fn scales(&self, disk: &Disk) -> Scales {
        Scales::new(&self.platform, disk)
    }
}

impl From<Platform> for DrivenPlatform {
    /// The platform of Eq. (1).
    fn from(platform: Platform) -> Self {
        Self { platform, height: Waveform::Sine, angle: Waveform::Sine, contact: None }
    }
}

/// The table `[drive]` of a file: a motion of the platform other than the sine of Eq. (1).
/// [`DrivenPlatform::of_drive`] checks it.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "GivenDrive"))]
pub struct DriveParameters {
    /// The shape of the height; the sine by default, whatever the angle is.
    pub height: Waveform,
    /// The shape of the angle; the sine by default, whatever the height is.
    pub angle: Waveform,
    /// Phase at which a toss starts (rad); `None` is the lowest point of the height.
    pub start_phase: Option<f64>,
}

/// The serialised form of the table, with the keys for which a specific error is returned.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize, Default)]
#[serde(deny_unknown_fields, default, expecting = "the table drive")]
struct GivenDrive {
    height: Waveform,
    angle: Waveform,
    start_phase: Option<f64>,
    segments: Option<serde::de::IgnoredAny>,
    then: Option<serde::de::IgnoredAny>,
}

#[cfg(feature = "serde")]
impl TryFrom<GivenDrive> for DriveParameters {
    type Error = String;

    fn try_from(given: GivenDrive) -> Result<Self, String> {
        let GivenDrive { height, angle, start_phase, segments, then } = given;
        let refused = [("segments", segments.is_some()), ("then", then.is_some())];
        let Some((key, _)) = refused.into_iter().find(|(_, is_given)| *is_given) else {
            return Ok(Self { height, angle, start_phase });
        };
        Err(format!(
            "drive.{key} is not a key: a drive is one motion that repeats. Give a start-up or a burst as a table \
             of samples, {{ sampled = [...] }}, or, in Rust, continue one `DrivenEngine` with the next by \
             `DrivenEngine::of_state`"
        ))
    }
}

impl DriveParameters {
    /// Whether the platform moves as in Eq. (1).
    #[must_use]
    pub fn is_sine(&self) -> bool {
        *self == Self::default()
    }

    /// Checks that the platform moves as in Eq. (1).
    ///
    /// # Errors
    /// [`Error::DriveNotSine`]; [`Error::StartPhase`].
    pub fn sine(&self) -> Result<(), Error> {
        self.height.sine()?;
        self.angle.sine()?;
        if self.start_phase.is_none() { Ok(()) } else { Err(Error::StartPhase) }
    }

    /// Checks the shapes and the phase.
    ///
    /// # Errors
    /// The errors of [`DrivenPlatform::new`].
    pub fn check(&self) -> Result<(), Error> {
        self.start_phase.map(|phase| finite("start_phase", phase)).transpose()?;
        self.height.check("height")?;
        self.angle.check("angle")
    }

    /// Warnings about legal but probably unintended values: a last sample that repeats the first, samples
    /// with noise or corners, or too few samples.
    pub fn warnings(&self) -> impl Iterator<Item = String> {
        let both = [("height", &self.height), ("angle", &self.angle)];
        both.into_iter().filter_map(|(of, shape)| {
            if shape.repeats_its_first_sample() {
                return Some(format!(
                    "the {of}: the last sample seems to repeat the first, which already begins the next period; \
                     leave it out, so that the samples keep their spacing"
                ));
            }
            let change = shape.acceleration_change().filter(|change| *change > LARGEST_CHANGE)?;
            let percent = rough(100.0 * change);
            Some(format!(
                "the {of}: without every second sample its acceleration changes by {percent} % of the peak; smooth \
                 noisy samples, add samples if there are few, and write corners as pieces"
            ))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bouncing_disk_drives::drive::{MAX_HARMONICS, MAX_PIECES};

    fn hand() -> Platform {
        *crate::System::pizza_toss().platform()
    }

    /// A waveform shifted by a phase is the same motion, sampled from a later start.
    #[test]
    fn a_phase_begins_the_period_elsewhere() {
        for shape in [
            Waveform::Sine,
            Waveform::Fourier(vec![(0.8, 0.4), (0.2, -1.0)]),
            Waveform::Triangle,
            Waveform::Sawtooth(0.8),
            Waveform::Parabolas,
            Waveform::Cubics,
            Waveform::Sampled(vec![0.1, 0.2, -0.3, 0.05, 0.0]),
        ] {
            let track = |lag| shape.track("height", 3.0, lag).expect("legal");
            let own = track(0.0);
            for lag in [0.7, -2.0, 0.5 * TAU, 5.0, -0.4] {
                let shifted = track(lag);
                for k in 0..97 {
                    let time = 0.065 * f64::from(k);
                    let error = shifted.at(time).height - own.at(time + lag).height;
                    assert!(error.abs() < 1e-13, "{shape:?} {time}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn noise_and_corners_of_samples_give_a_warning() {
        let warned = |count: u32, noise: f64, shape: Waveform| {
            let track = shape.track("height", 1.0, 0.0).expect("legal");
            let time = |k| TAU * f64::from(k) / f64::from(count);
            let sample = |k| track.height(time(k)) + if k % 2 == 0 { noise } else { -noise };
            Waveform::Sampled((0..count).map(sample).collect()).acceleration_change() > Some(LARGEST_CHANGE)
        };
        assert!(!warned(6, 0.0, Waveform::Sine) && warned(5, 0.0, Waveform::Sine));
        assert!(!warned(64, 1e-4, Waveform::Sine) && warned(64, 1e-2, Waveform::Sine));
        assert!(!warned(64, 0.0, Waveform::Parabolas) && warned(64, 0.0, Waveform::Triangle));
    }

    /// Covers a sum of harmonics from any phase, a recorded loop with and without its first sample repeated
    /// at the end, and shapes whose ends are equal although no sample is repeated.
    #[test]
    fn a_first_sample_at_the_end_gives_a_warning_of_its_own() {
        let sums: [&[(f64, f64)]; 2] = [&[(1.0, 0.0)], &[(1.0, 0.4), (0.15, 0.9), (0.02, 0.0)]];
        for (count, start) in (0..40).map(|k| (16 << (k % 5), 0.16 * f64::from(k))) {
            for (sum, noise) in sums.iter().flat_map(|sum| [(sum, 0.0), (sum, 1e-4 / f64::from(count))]) {
                let track = Waveform::Fourier(sum.to_vec()).track("height", 1.0, start).expect("legal");
                let sample = |k| {
                    let own = if k % 3 == 0 { noise } else { -noise };
                    track.height(TAU * f64::from(k) / f64::from(count)) + own
                };
                let open: Vec<_> = (0..count).map(sample).collect();
                let closed: Vec<_> = open.iter().copied().chain([open[0] + noise]).collect();
                let of =
                    |samples| DriveParameters { height: Waveform::Sampled(samples), ..Default::default() };
                assert_eq!(of(open).warnings().count(), 0, "{count} {start}");
                let told: Vec<_> = of(closed).warnings().collect();
                assert!(told.len() == 1 && told[0].contains("the last sample"), "{count} {start}: {told:?}");
            }
        }
        // The fewest samples that can show it.
        let few = DriveParameters {
            height: Waveform::Sampled(vec![0.0, 1.0, 0.0, -1.0, 0.0]),
            ..Default::default()
        };
        assert!(few.warnings().any(|told| told.contains("the last sample") && !told.contains("  ")));
        assert!(!Waveform::Sampled(vec![0.0, 1.0, 0.0, -1.0]).repeats_its_first_sample());
        // A throw between two rests, with noise from a separate generator.
        for (count, level) in [64_u32, 256, 1024]
            .into_iter()
            .flat_map(|count| [1e-6, 1e-5, 1e-4, 3e-4].map(|level| (count, level)))
        {
            let mut state = u64::from(count);
            for draw in 0..50 {
                let sample = |k| {
                    let phase = f64::from(k) / f64::from(count);
                    let sine = bouncing_disk_core::numerics::elementary::sin(TAU * (phase - 0.25));
                    let bump = if (0.25..0.75).contains(&phase) { sine * sine } else { 0.0 };
                    state =
                        state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    bump + level * ((state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0)
                };
                let shape = Waveform::Sampled((0..count).map(sample).collect());
                assert!(!shape.repeats_its_first_sample(), "{count} {level:e} {draw}");
            }
        }
        // The middle of the period lies between two samples; a trapezoid rests at both ends.
        let cosine =
            |k: u32| bouncing_disk_core::numerics::elementary::cos(TAU * (f64::from(k) + 0.5) / 32.0);
        let trapezoid = |k: u32| (f64::from(k.min(31 - k)) / 8.0 - 0.5).clamp(0.0, 1.0);
        for shape in [(0..32).map(cosine).collect(), (0..32).map(trapezoid).collect(), vec![0.0; 8]] {
            assert!(!Waveform::Sampled(shape).repeats_its_first_sample());
        }
    }

    #[test]
    fn bad_waveforms_are_refused_with_their_place() {
        let line = |c0: f64, c1: f64| [c0, c1, 0.0, 0.0];
        for (height, words) in [
            (Waveform::Fourier(vec![(0.1, 0.0), (f64::NAN, 0.0)]), "height: the harmonic 1 of 2"),
            (Waveform::Fourier(vec![(0.1, 0.0); MAX_HARMONICS + 1]), "at most 32"),
            (Waveform::Pieces(Vec::new()), "sum of the durations of the pieces = 0"),
            (Waveform::Pieces(vec![(0.5, line(0.0, 0.0))]), "sum of the durations of the pieces = 0.5"),
            (Waveform::Pieces(vec![(0.5, line(0.0, 0.0)), (0.0, line(0.0, 0.0))]), "the piece 1 of 2"),
            (Waveform::Pieces(vec![(f64::NAN, line(0.0, 0.0))]), "the piece is not finite"),
            (
                Waveform::Pieces(vec![(0.5, line(0.0, 0.2)), (0.5, line(0.125, -0.25))]),
                "the height jumps by 0.025",
            ),
            (Waveform::Sampled(vec![0.0, 0.1]), "number of samples = 2"),
            (Waveform::Sampled(vec![0.0, 0.1, f64::INFINITY]), "the sample 2 of 3"),
            (Waveform::Sampled(vec![0.0; MAX_PIECES + 1]), "samples"),
            (Waveform::Sawtooth(1.0), "rise = 1"),
        ] {
            let refused = DrivenPlatform::new(hand(), height, Waveform::Sine).expect_err("refused");
            assert!(refused.to_string().contains(words), "{refused}");
        }
    }

    #[cfg(all(feature = "json", feature = "toml"))]
    #[test]
    fn a_drive_is_read_as_it_is_written() {
        let text = "height = { fourier = [[1, 0.0], [0.1, 1.5]] }\nangle = \"triangle\"\n";
        let drive: DriveParameters = toml::from_str(text).expect("legal");
        assert_eq!(drive.height, Waveform::Fourier(vec![(1.0, 0.0), (0.1, 1.5)]));
        assert_eq!((&drive.angle, drive.start_phase), (&Waveform::Triangle, None));
        assert!(DrivenPlatform::of_drive(hand(), &drive).is_ok());
        let shifted = format!("{text}start_phase = 0.25\n");
        let drive: DriveParameters = toml::from_str(&shifted).expect("legal");
        assert_eq!(drive.start_phase, Some(0.25));
        assert_eq!(DrivenPlatform::of_drive(hand(), &drive), Err(Error::StartPhase));
        let again = serde_json::to_string(&drive).expect("written");
        assert_eq!(serde_json::from_str::<DriveParameters>(&again).expect("read"), drive);
        let pieces = "height = { pieces = [[0.5, [0.0, 1.0]], [0.5, [0.5, -1]]] }";
        let drive: DriveParameters = toml::from_str(pieces).expect("legal");
        assert_eq!(
            drive.height,
            Waveform::Pieces(vec![(0.5, [0.0, 1.0, 0.0, 0.0]), (0.5, [0.5, -1.0, 0.0, 0.0])])
        );
        for rise in ["1e-10", "1.0"] {
            let steep: DriveParameters =
                toml::from_str(&format!("height = {{ sawtooth = {rise} }}")).expect("a shape");
            let refused = DrivenPlatform::of_drive(hand(), &steep).expect_err("too steep").to_string();
            assert!(refused.contains("outside its legal range [1e-9, 1 - 1e-9], a share"), "{refused}");
        }
        for (text, words) in [
            (text.replace("[1, 0.0]", "[1, 0.0, 7.0]"), "this is not a shape; write \"sine\", "),
            (pieces.replace("-1]", "-1, 0, 0, 9]"), "this is not a shape"),
            (pieces.replace("]]]", "], 3]]"), "this is not a shape"),
            ("height = 'sawtooth'".to_owned(), "\"sawtooth\" is not a shape"),
        ] {
            let refused = toml::from_str::<DriveParameters>(&text).expect_err("refused").to_string();
            assert!(refused.contains(words), "{refused}");
        }
        for (from, to) in [("angle", "angel"), ("start", "strat"), ("triangle", "triangel")] {
            let refused = toml::from_str::<DriveParameters>(&shifted.replace(from, to)).expect_err("refused");
            assert!(refused.to_string().contains(to), "{refused}");
        }
        for (entry, key) in
            [("segments = [{ lag = 0.3 }]", "drive.segments"), ("then = 'rest'", "drive.then")]
        {
            let refused =
                toml::from_str::<DriveParameters>(&format!("{text}{entry}\n")).expect_err("refused");
            assert!(
                refused.to_string().contains(&format!("{key} is not a key: a drive is one motion")),
                "{refused}"
            );
        }
        let nan = DriveParameters { start_phase: Some(f64::NAN), ..DriveParameters::default() };
        assert!(matches!(nan.check(), Err(Error::OutOfRange { field: "start_phase", .. })));
    }
}
