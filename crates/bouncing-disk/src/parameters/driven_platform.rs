//! A platform that moves and turns in any periodic way, in SI units.

use std::f64::consts::TAU;
use std::fmt::{self, Display, Formatter};

use bouncing_disk_core::{Drive, DrivenMap, ImpactMap};

use crate::error::{Error, check};
use crate::parameters::disk::Disk;
use crate::parameters::platform::Platform;
use crate::parameters::scales::Scales;

/// The shape of a motion over one period: height or angle in multiples of its amplitude, where the sine of
/// Eq. (1) has sin(tau). Not yet checked.
///
/// In a file: `"triangle"`, `{ sawtooth = 0.3 }`, `{ fourier = [[1.0, 0.0], [0.1, 1.5]] }`.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Waveform {
    /// sin(tau), as in Eq. (1).
    #[default]
    Sine,
    /// The sum of a_j sin(j tau + phi_j) over j = 1, 2, ... of these (a_j, phi_j), at most
    /// [`MAX_HARMONICS`](bouncing_disk_core::flight::MAX_HARMONICS).
    #[cfg_attr(feature = "serde", serde(deserialize_with = "read::harmonics"))]
    Fourier(Vec<(f64, f64)>),
    /// Pieces (duration, [c0, c1, c2, c3]), one after the other, each c0 + c1 x + c2 x^2 + c3 x^3 from its own
    /// start: x and the durations in periods, which sum to 1. The height must be continuous; the velocity may
    /// jump. At most [`MAX_PIECES`](bouncing_disk_core::flight::MAX_PIECES).
    #[cfg_attr(feature = "serde", serde(deserialize_with = "read::pieces"))]
    Pieces(Vec<(f64, [f64; 4])>),
    /// The periodic cubic spline through at least 3 samples at equal distances over one period.
    Sampled(Vec<f64>),
    /// Straight lines through the zeros and extremes of the sine.
    Triangle,
    /// Straight lines that rise for this share of the period, in [1e-9, 1 - 1e-9], and fall for the rest: from
    /// 0 at tau = 0 to 1, to -1, and back.
    Sawtooth(f64),
    /// The sine replaced by one parabola for each half of the period.
    Parabolas,
    /// The sine replaced by one cubic for each quarter of the period: the spline through its zeros and extremes.
    Cubics,
}

/// Lists of lists: a tuple would ignore what a file has too much.
#[cfg(feature = "serde")]
mod read {
    use serde::de::{Deserialize, Deserializer, Error};

    #[derive(serde::Deserialize)]
    #[serde(untagged)]
    enum Item {
        Number(f64),
        Numbers(Vec<f64>),
    }

    pub(super) fn harmonics<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<(f64, f64)>, D::Error> {
        let of_one = |(index, own): (usize, Vec<f64>)| match own[..] {
            [amplitude, angle] => Ok((amplitude, angle)),
            _ => Err(D::Error::custom(format!("harmonic number {index} is not [amplitude, phase]"))),
        };
        Vec::deserialize(from)?.into_iter().enumerate().map(of_one).collect()
    }

    pub(super) fn pieces<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<(f64, [f64; 4])>, D::Error> {
        let of_one = |(index, own): (usize, Vec<Item>)| match &own[..] {
            [Item::Number(duration), Item::Numbers(given)] if given.len() <= 4 => {
                let mut coefficients = [0.0; 4];
                coefficients[..given.len()].copy_from_slice(given);
                Ok((*duration, coefficients))
            }
            _ => Err(D::Error::custom(format!(
                "piece number {index} is not [duration, [c0, c1, c2, c3]]; the last coefficients may be left out"
            ))),
        };
        Vec::deserialize(from)?.into_iter().enumerate().map(of_one).collect()
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
    /// The harmonics of a sine or a Fourier sum.
    pub(crate) fn harmonics(&self) -> Option<Vec<(f64, f64)>> {
        match self {
            Self::Sine => Some(vec![(1.0, 0.0)]),
            Self::Fourier(harmonics) => Some(harmonics.clone()),
            _ => None,
        }
    }

    /// That the shape is that of Eq. (1).
    ///
    /// # Errors
    /// [`Error::DriveNotSine`].
    pub fn sine(&self) -> Result<(), Error> {
        if *self == Self::Sine { Ok(()) } else { Err(Error::DriveNotSine) }
    }

    /// The impact map of a height of this shape, with the amplitude and the restitution of the `sine`'s.
    ///
    /// # Errors
    /// Those of [`DrivenPlatform::new`].
    pub fn map(&self, sine: &ImpactMap) -> Result<DrivenMap, Error> {
        let track = self.track("height", sine.vibration().peak_acceleration(), 0.0)?;
        Ok(DrivenMap::new(track, sine.restitution())?)
    }

    /// The motion with this amplitude, `lag` (rad) earlier.
    pub(crate) fn track(&self, of: &'static str, amplitude: f64, lag: f64) -> Result<Drive, Error> {
        let refuse = |source| match source {
            bouncing_disk_core::Error::HeightJump { piece, jump } => {
                Error::WaveformJump { of, piece, jump: jump / amplitude }
            }
            source => Error::Waveform { of, source },
        };
        let track = match self {
            Self::Sine | Self::Fourier(_) => {
                let harmonics = self.harmonics().into_iter().flatten();
                Drive::fourier(&harmonics.map(|(a, phase)| (amplitude * a, phase)).collect::<Vec<_>>())
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

    /// Checks what does not depend on amplitude and disk.
    fn check(&self, of: &'static str) -> Result<(), Error> {
        // So small that no acceleration is in the way.
        let largest = match self {
            Self::Fourier(harmonics) => harmonics.iter().fold(0.0, |most: f64, (a, _)| most.max(a.abs())),
            Self::Pieces(pieces) => {
                pieces.iter().flat_map(|(_, c)| c).fold(0.0, |most: f64, c| most.max(c.abs()))
            }
            Self::Sampled(samples) => {
                let count = samples.len() as f64;
                samples.iter().fold(0.0, |most: f64, sample| most.max(sample.abs())) * count * count
            }
            _ => 1.0,
        };
        let amplitude = if largest > 0.0 && largest.is_finite() { 1.0 / largest } else { 1.0 };
        self.track(of, amplitude, 0.0).map(|_| ())
    }
}

/// Pieces whose times are in periods and that are made `size` times as large.
fn pieces_of(pieces: &[(f64, [f64; 4])], size: f64) -> Result<Drive, bouncing_disk_core::Error> {
    let scaled = |&(duration, [c0, c1, c2, c3]): &(f64, [f64; 4])| {
        let c = [c0 * size, c1 * size / TAU, c2 * size / (TAU * TAU), c3 * size / (TAU * TAU * TAU)];
        (duration * TAU, c)
    };
    Drive::pieces(&pieces.iter().map(scaled).collect::<Vec<_>>())
}

/// A [`Platform`] whose sines are replaced by any [`Waveform`]s: height A f(tau), angle Phi h(tau + theta). The
/// axial forcing Gamma = A omega^2/(pi g) keeps its meaning, whatever the shape.
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
}

impl DrivenPlatform {
    /// A platform with these shapes of height and angle.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a number outside its range; [`Error::Waveform`] and [`Error::WaveformJump`] name
    /// the waveform and its harmonic, piece or sample.
    pub fn new(platform: Platform, height: Waveform, angle: Waveform) -> Result<Self, Error> {
        height.check("height")?;
        angle.check("angle")?;
        Ok(Self { platform, height, angle })
    }

    /// This platform with the motion of a file's table.
    ///
    /// # Errors
    /// Those of [`Self::new`]; [`Error::ScheduledDrive`] where the motion is a schedule.
    pub fn of_drive(platform: Platform, drive: &DriveParameters) -> Result<Self, Error> {
        if drive.is_schedule() {
            return Err(Error::ScheduledDrive);
        }
        Self::new(platform, drive.height.clone(), drive.angle.clone())
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
        Self { platform, height: Waveform::Sine, angle: Waveform::Sine }
    }
}

/// The table `[drive]` of a file: how the platform moves in place of the sine of Eq. (1).
/// [`DrivenPlatform::of_drive`] checks it, and
/// [`Schedule::of_drive`](crate::driven::Schedule::of_drive) where it has segments.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields, default, expecting = "the table drive"))]
pub struct DriveParameters {
    /// The shape of the height.
    pub height: Waveform,
    /// The shape of the angle.
    pub angle: Waveform,
    /// Phase at which the first segment starts (rad).
    pub start_phase: f64,
    /// Motions one after the other; without any the motion is periodic.
    pub segments: Vec<ScheduleSegment>,
    /// What comes after the last segment.
    pub then: AfterSchedule,
}

impl DriveParameters {
    /// Whether the platform moves as in Eq. (1).
    #[must_use]
    pub fn is_sine(&self) -> bool {
        *self == Self::default()
    }

    /// That the platform moves as in Eq. (1).
    ///
    /// # Errors
    /// [`Error::DriveNotSine`].
    pub fn sine(&self) -> Result<(), Error> {
        if self.is_sine() { Ok(()) } else { Err(Error::DriveNotSine) }
    }

    /// Checks the shapes; a schedule is checked with its disk.
    ///
    /// # Errors
    /// As [`DrivenPlatform::new`].
    pub fn check(&self) -> Result<(), Error> {
        self.height.check("height")?;
        self.angle.check("angle")
    }

    /// Whether segments follow one another, in place of a periodic motion.
    #[must_use]
    pub fn is_schedule(&self) -> bool {
        !self.segments.is_empty() || self.start_phase != 0.0 || self.then != AfterSchedule::Repeat
    }
}

/// A part of a [`Schedule`](crate::driven::Schedule), by factors of the schedule's platform.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields, default))]
pub struct ScheduleSegment {
    /// Duration in its own periods, in (0, 1e5].
    pub periods: f64,
    /// Height and angle are this many times those of the platform, in [0, 1e6].
    pub amplitude: f64,
    /// The same at the end of a ramp, linear in time, in [0, 1e6]; `None` for a constant amplitude.
    pub ramp_to: Option<f64>,
    /// The frequency is this many times that of the platform, in (0, 1e6].
    pub frequency: f64,
    /// The angle is this much (rad of the fundamental) earlier than the platform's.
    pub lag: f64,
}

impl Default for ScheduleSegment {
    /// One period of the platform's own motion.
    fn default() -> Self {
        Self { periods: 1.0, amplitude: 1.0, ramp_to: None, frequency: 1.0, lag: 0.0 }
    }
}

/// What comes after the last segment of a schedule.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum AfterSchedule {
    /// The last segment goes on for ever.
    #[default]
    Repeat,
    /// The platform stays where it is; a disk in the air comes down and settles on it.
    Rest,
}

#[cfg(test)]
mod tests {
    use super::*;
    use bouncing_disk_core::flight::{MAX_HARMONICS, MAX_PIECES};

    fn hand() -> Platform {
        *crate::System::pizza_toss().platform()
    }

    /// Each waveform some phase earlier is the same motion read later.
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
    fn bad_waveforms_are_refused_with_their_place() {
        let line = |c0: f64, c1: f64| [c0, c1, 0.0, 0.0];
        for (height, words) in [
            (Waveform::Fourier(vec![(0.1, 0.0), (f64::NAN, 0.0)]), "height: harmonic number 1"),
            (Waveform::Fourier(vec![(0.1, 0.0); MAX_HARMONICS + 1]), "at most 32"),
            (Waveform::Pieces(Vec::new()), "sum of the durations of the pieces = 0"),
            (Waveform::Pieces(vec![(0.5, line(0.0, 0.0))]), "sum of the durations of the pieces = 0.5"),
            (Waveform::Pieces(vec![(0.5, line(0.0, 0.0)), (0.0, line(0.0, 0.0))]), "piece number 1 of 2"),
            (Waveform::Pieces(vec![(f64::NAN, line(0.0, 0.0))]), "piece number 0 of 1"),
            (
                Waveform::Pieces(vec![(0.5, line(0.0, 0.2)), (0.5, line(0.125, -0.25))]),
                "the height jumps by 0.025",
            ),
            (Waveform::Sampled(vec![0.0, 0.1]), "number of samples = 2"),
            (Waveform::Sampled(vec![0.0, 0.1, f64::INFINITY]), "sample number 2 of 3"),
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
        assert_eq!((&drive.angle, drive.is_schedule()), (&Waveform::Triangle, false));
        assert!(DrivenPlatform::of_drive(hand(), &drive).is_ok());
        let schedule = format!("{text}then = \"rest\"\n[[segments]]\nperiods = 2.25\nlag = 0.3\n");
        let drive: DriveParameters = toml::from_str(&schedule).expect("legal");
        assert_eq!((drive.segments[0].lag, drive.then), (0.3, AfterSchedule::Rest));
        assert_eq!(DrivenPlatform::of_drive(hand(), &drive), Err(Error::ScheduledDrive));
        let again = serde_json::to_string(&drive).expect("written");
        assert_eq!(serde_json::from_str::<DriveParameters>(&again).expect("read"), drive);
        let pieces = "height = { pieces = [[0.5, [0.0, 1.0]], [0.5, [0.5, -1]]] }";
        let drive: DriveParameters = toml::from_str(pieces).expect("legal");
        assert_eq!(
            drive.height,
            Waveform::Pieces(vec![(0.5, [0.0, 1.0, 0.0, 0.0]), (0.5, [0.5, -1.0, 0.0, 0.0])])
        );
        for (text, words) in [
            (text.replace("[1, 0.0]", "[1, 0.0, 7.0]"), "harmonic number 0 is not"),
            (pieces.replace("-1]", "-1, 0, 0, 9]"), "piece number 1 is not"),
            (pieces.replace("]]]", "], 3]]"), "piece number 1 is not"),
        ] {
            let refused = toml::from_str::<DriveParameters>(&text).expect_err("refused").to_string();
            assert!(refused.contains(words), "{refused}");
        }
        for (from, to) in [("angle", "angel"), ("lag", "leg"), ("triangle", "triangel")] {
            let refused =
                toml::from_str::<DriveParameters>(&schedule.replace(from, to)).expect_err("refused");
            assert!(refused.to_string().contains(to), "{refused}");
        }
    }
}
