//! A platform that moves and turns in any periodic way, in SI units.

use std::f64::consts::TAU;

#[cfg(any(doc, test))]
use bouncing_disk_core::flight::{MAX_HARMONICS, MAX_PIECES};
use bouncing_disk_core::numerics::elementary::wrapped_angle;

use crate::driven::track::Track;
use crate::error::{Error, check, finite, not_negative, positive};
use crate::parameters::disk::Disk;
use crate::parameters::platform::Platform;
use crate::parameters::scales::Scales;

/// One period of a height (m) or an angle (rad), not yet checked. Phases are in radians; time in [`Pieces`] is
/// in periods.
///
/// In a file: `{ fourier = [[0.2, 0.0], [0.02, 1.5]] }`, `{ triangle = { amplitude = 0.2 } }`.
///
/// [`Pieces`]: Self::Pieces
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
#[non_exhaustive]
pub enum Waveform {
    /// amplitude sin(tau + phase), as in Eq. (1).
    Sine {
        /// Amplitude, not negative.
        amplitude: f64,
        /// Phase (rad).
        #[cfg_attr(feature = "serde", serde(default))]
        phase: f64,
    },
    /// The sum of a_j sin(j tau + phi_j) over j = 1, 2, ... of these (a_j, phi_j), at most [`MAX_HARMONICS`].
    Fourier(Vec<(f64, f64)>),
    /// Pieces (duration, [c0, c1, c2, c3]), one after the other, each c0 + c1 x + c2 x^2 + c3 x^3 from its own
    /// start: x and the durations in periods, which sum to 1. The height must be continuous; the velocity may
    /// jump. At most [`MAX_PIECES`].
    Pieces(Vec<(f64, [f64; 4])>),
    /// The periodic cubic spline through samples at equal distances over one period, from 3 to [`MAX_PIECES`].
    Sampled(Vec<f64>),
    /// Straight lines through the zeros and extremes of the sine.
    Triangle {
        /// Amplitude, not negative.
        amplitude: f64,
        /// Phase (rad).
        #[cfg_attr(feature = "serde", serde(default))]
        phase: f64,
    },
    /// Straight lines that rise for a share of the period and fall for the rest.
    Sawtooth {
        /// Amplitude, not negative.
        amplitude: f64,
        /// Share of the period in which it rises, in [1e-9, 1 - 1e-9].
        rise: f64,
        /// Phase (rad).
        #[cfg_attr(feature = "serde", serde(default))]
        phase: f64,
    },
    /// The sine replaced by one parabola for each half of the period.
    Parabolas {
        /// Amplitude, not negative.
        amplitude: f64,
        /// Phase (rad).
        #[cfg_attr(feature = "serde", serde(default))]
        phase: f64,
    },
    /// The sine replaced by one cubic for each quarter of the period, through its zeros and extremes.
    Cubics {
        /// Amplitude, not negative.
        amplitude: f64,
        /// Phase (rad).
        #[cfg_attr(feature = "serde", serde(default))]
        phase: f64,
    },
}

/// Pieces of one period, in periods.
type PieceList = Vec<(f64, [f64; 4])>;

impl Default for Waveform {
    /// No motion.
    fn default() -> Self {
        Self::Fourier(Vec::new())
    }
}

impl Waveform {
    /// The harmonics of a sine or a Fourier sum.
    pub(crate) fn harmonics(&self) -> Option<Vec<(f64, f64)>> {
        match self {
            Self::Sine { amplitude, phase } => Some(vec![(*amplitude, *phase)]),
            Self::Fourier(harmonics) => Some(harmonics.clone()),
            _ => None,
        }
    }

    /// The motion in units of `unit`, `factor` times as large and `lag` (rad) earlier.
    pub(crate) fn track(&self, of: &'static str, unit: f64, factor: f64, lag: f64) -> Result<Track, Error> {
        let size = factor / unit;
        let refuse = |source| match source {
            bouncing_disk_core::Error::HeightJump { piece, jump } => {
                Error::WaveformJump { of, piece, jump: jump * unit }
            }
            source => Error::Waveform { of, source },
        };
        if let Some(harmonics) = self.harmonics() {
            let earlier = |(j, (a, phi)): (usize, &(f64, f64))| (size * a, phi + (j + 1) as f64 * lag);
            let harmonics: Vec<_> = harmonics.iter().enumerate().map(earlier).collect();
            return Track::sines(&harmonics).map_err(refuse);
        }
        if let (Self::Sampled(samples), true) = (self, lag == 0.0) {
            let samples: Vec<_> = samples.iter().map(|sample| size * sample).collect();
            return Track::sampled(&samples).map_err(refuse);
        }
        let (pieces, phase) = self.pieces(of)?;
        let total = pieces.iter().fold(0.0, |sum, (duration, _)| sum + duration);
        if pieces.iter().all(|(duration, _)| *duration > 0.0) {
            let legal = (total - 1.0).abs() <= 1.0e-12;
            check(legal, "sum of the durations of the pieces", total, "1 (in periods)")?;
        }
        let scaled = |(duration, c): (f64, [f64; 4])| {
            let mut power = size;
            let c = c.map(|c| {
                let scaled = c * power;
                power /= TAU;
                scaled
            });
            (duration * TAU, c)
        };
        let pieces: PieceList = earlier(pieces, phase + lag).into_iter().map(scaled).collect();
        Track::pieces(&pieces).map_err(refuse)
    }

    /// The pieces of a waveform that is not a Fourier sum, and by what phase it is earlier.
    fn pieces(&self, of: &'static str) -> Result<(PieceList, f64), Error> {
        let line = |c0: f64, c1: f64| [c0, c1, 0.0, 0.0];
        Ok(match *self {
            Self::Pieces(ref pieces) => (pieces.clone(), 0.0),
            Self::Triangle { amplitude, phase } => {
                return Self::Sawtooth { amplitude, rise: 0.5, phase }.pieces(of);
            }
            Self::Sawtooth { amplitude: a, rise, phase } => {
                let legal = (1.0e-9..=1.0 - 1.0e-9).contains(&rise);
                check(legal, "rise", rise, "[1e-9, 1 - 1e-9], a share of the period")?;
                let (up, down) = (2.0 * a / rise, -2.0 * a / (1.0 - rise));
                let pieces = vec![
                    (0.5 * rise, line(0.0, up)),
                    (1.0 - rise, line(a, down)),
                    (0.5 * rise, line(-a, up)),
                ];
                (pieces, phase)
            }
            Self::Parabolas { amplitude: a, phase } => {
                let half = |a: f64| (0.5, [0.0, 8.0 * a, -16.0 * a, 0.0]);
                (vec![half(a), half(-a)], phase)
            }
            Self::Cubics { amplitude: a, phase } => {
                let rising = |a: f64| (0.25, [0.0, 6.0 * a, 0.0, -32.0 * a]);
                let falling = |a: f64| (0.25, [a, 0.0, -24.0 * a, 32.0 * a]);
                (vec![rising(a), falling(a), rising(-a), falling(-a)], phase)
            }
            Self::Sampled(ref samples) => {
                // The pieces of the spline, so that they can be begun elsewhere.
                let source = |source| Error::Waveform { of, source };
                let spline = Track::sampled(samples).map_err(source)?;
                let share = 1.0 / samples.len() as f64;
                let piece = |knot: Option<crate::driven::track::Next>| {
                    let at = spline.at(knot.map_or(0.0, |knot| knot.time));
                    let c = [at.height, at.velocity, 0.5 * at.acceleration, at.jerk / 6.0];
                    (share, [c[0], c[1] * TAU, c[2] * (TAU * TAU), c[3] * (TAU * TAU * TAU)])
                };
                let mut time = 0.0;
                let mut pieces = vec![piece(None)];
                while let Some(next) = spline.next_knot(time).filter(|next| next.time > time) {
                    time = next.time;
                    pieces.push(piece(Some(next)));
                }
                (pieces, 0.0)
            }
            Self::Sine { .. } | Self::Fourier(_) => (Vec::new(), 0.0),
        })
    }

    /// Checks what does not depend on the disk.
    fn check(&self, of: &'static str) -> Result<(), Error> {
        match *self {
            Self::Sine { amplitude, phase }
            | Self::Triangle { amplitude, phase }
            | Self::Sawtooth { amplitude, phase, .. }
            | Self::Parabolas { amplitude, phase }
            | Self::Cubics { amplitude, phase } => {
                not_negative("amplitude", amplitude)?;
                finite("phase", phase)?;
            }
            Self::Fourier(_) | Self::Pieces(_) | Self::Sampled(_) => {}
        }
        // In units of its own size, so that the largest acceleration is not in the way.
        self.track(of, self.size(), 1.0, 0.0).map(|_| ())
    }

    /// A size far above all heights and accelerations over a period; 1 where there is none.
    fn size(&self) -> f64 {
        let largest =
            |numbers: &mut dyn Iterator<Item = f64>| numbers.fold(0.0, |most: f64, x| most.max(x.abs()));
        let size = match self {
            Self::Fourier(harmonics) => largest(&mut harmonics.iter().map(|(a, _)| *a)),
            Self::Pieces(pieces) => largest(&mut pieces.iter().flat_map(|(_, c)| c.iter().copied())),
            Self::Sampled(samples) => {
                let count = samples.len() as f64;
                largest(&mut samples.iter().copied()) * count * count * 1.0e-4
            }
            Self::Sine { amplitude, .. }
            | Self::Triangle { amplitude, .. }
            | Self::Sawtooth { amplitude, .. }
            | Self::Parabolas { amplitude, .. }
            | Self::Cubics { amplitude, .. } => *amplitude,
        };
        if size > 0.0 && size.is_finite() { size } else { 1.0 }
    }
}

/// The same period begun at `phase` (rad): the piece in which that is is cut in two.
fn earlier(pieces: PieceList, phase: f64) -> PieceList {
    let mut left = wrapped_angle(phase) / TAU;
    if left == 0.0 || !left.is_finite() {
        return pieces;
    }
    let mut index = 0;
    while index + 1 < pieces.len() && left >= pieces[index].0 {
        left -= pieces[index].0;
        index += 1;
    }
    let Some(&(duration, [c0, c1, c2, c3])) = pieces.get(index) else { return pieces };
    let mut shifted = Vec::with_capacity(pieces.len() + 1);
    if duration > left {
        let c = [
            c0 + left * (c1 + left * (c2 + left * c3)),
            c1 + left * (2.0 * c2 + left * (3.0 * c3)),
            c2 + 3.0 * left * c3,
            c3,
        ];
        shifted.push((duration - left, c));
    }
    shifted.extend_from_slice(&pieces[index + 1..]);
    shifted.extend_from_slice(&pieces[..index]);
    if left > 0.0 {
        shifted.push((left, [c0, c1, c2, c3]));
    }
    shifted
}

/// The parameters of a [`DrivenPlatform`], not yet checked.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct DrivenPlatformParameters {
    /// Angular frequency of the fundamental (rad/s), positive: the period is 2 pi over it.
    pub angular_frequency: f64,
    /// The height (m) over a period.
    pub height: Waveform,
    /// The angle (rad) over a period; none if absent in a serialised form.
    #[cfg_attr(feature = "serde", serde(default))]
    pub angle: Waveform,
}

impl DrivenPlatformParameters {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a number outside its range; [`Error::Waveform`] and [`Error::WaveformJump`] name
    /// the waveform and its harmonic, piece or sample.
    pub fn build(self) -> Result<DrivenPlatform, Error> {
        positive("angular_frequency", self.angular_frequency)?;
        self.height.check("height")?;
        self.angle.check("angle")?;
        Ok(DrivenPlatform { parameters: self })
    }
}

/// A platform whose height and angle are any [`Waveform`]s of one period.
///
/// ```
/// use bouncing_disk::parameters::{DrivenPlatformParameters, Waveform};
///
/// // The hand of Table I, moved along straight lines.
/// let hand = DrivenPlatformParameters {
///     angular_frequency: 15.0,
///     height: Waveform::Triangle { amplitude: 0.21, phase: 0.0 },
///     angle: Waveform::Sine { amplitude: 0.97, phase: 0.0 },
/// };
/// assert!(hand.build().is_ok());
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "DrivenPlatformParameters", into = "DrivenPlatformParameters")
)]
pub struct DrivenPlatform {
    parameters: DrivenPlatformParameters,
}

impl DrivenPlatform {
    /// The parameters, to be changed and built again.
    #[must_use]
    pub const fn parameters(&self) -> &DrivenPlatformParameters {
        &self.parameters
    }

    /// Angular frequency of the fundamental (rad/s).
    #[must_use]
    pub const fn angular_frequency(&self) -> f64 {
        self.parameters.angular_frequency
    }

    /// The height (m) over a period.
    #[must_use]
    pub const fn height(&self) -> &Waveform {
        &self.parameters.height
    }

    /// The angle (rad) over a period.
    #[must_use]
    pub const fn angle(&self) -> &Waveform {
        &self.parameters.angle
    }

    /// The SI values of the units in which a motion of this disk is computed.
    #[must_use]
    pub fn scales(&self, disk: &Disk) -> Scales {
        Scales::of(self.angular_frequency(), disk)
    }
}

impl From<Platform> for DrivenPlatform {
    /// The platform of Eq. (1).
    fn from(platform: Platform) -> Self {
        let sine = |amplitude, phase| Waveform::Sine { amplitude, phase };
        let parameters = DrivenPlatformParameters {
            angular_frequency: platform.angular_frequency(),
            height: sine(platform.amplitude(), 0.0),
            angle: sine(platform.twist_amplitude(), platform.phase_lag()),
        };
        Self { parameters }
    }
}

impl TryFrom<DrivenPlatformParameters> for DrivenPlatform {
    type Error = Error;

    fn try_from(parameters: DrivenPlatformParameters) -> Result<Self, Error> {
        parameters.build()
    }
}

impl From<DrivenPlatform> for DrivenPlatformParameters {
    fn from(platform: DrivenPlatform) -> Self {
        platform.parameters
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(height: Waveform) -> String {
        let platform =
            DrivenPlatformParameters { angular_frequency: 15.0, height, angle: Waveform::default() };
        platform.build().expect_err("refused").to_string()
    }

    /// Each waveform `phase` earlier is the same motion read `phase` later.
    #[test]
    fn a_phase_begins_the_period_elsewhere() {
        let shapes: [fn(f64) -> Waveform; 5] = [
            |phase| Waveform::Sine { amplitude: 0.3, phase },
            |phase| Waveform::Triangle { amplitude: 0.3, phase },
            |phase| Waveform::Sawtooth { amplitude: 0.3, rise: 0.8, phase },
            |phase| Waveform::Parabolas { amplitude: 0.3, phase },
            |phase| Waveform::Cubics { amplitude: 0.3, phase },
        ];
        for shape in shapes {
            let track = |phase| shape(phase).track("height", 0.1, 1.0, 0.0).expect("legal");
            let (own, lag) = (track(0.0), shape(0.0).track("height", 0.1, 1.0, 0.7).expect("legal"));
            for phase in [0.7, -2.0, 0.5 * TAU, 5.0] {
                let shifted = track(phase);
                for k in 0..97 {
                    let time = 0.065 * f64::from(k);
                    let error = shifted.at(time).height - own.at(time + phase).height;
                    assert!(error.abs() < 1e-14, "{:?} {time}: {error:e}", shape(phase));
                }
            }
            assert!((lag.at(1.0).height - own.at(1.7).height).abs() < 1e-14);
            // The extremes and zeros of the sine, except for the sawtooth.
            assert!(own.at(0.0).height.abs() < 1e-15 && own.at(0.5 * TAU).height.abs() < 1e-14);
        }
        let samples = Waveform::Sampled(vec![0.1, 0.2, -0.3, 0.05, 0.0]);
        let own = samples.track("height", 0.1, 1.0, 0.0).expect("legal");
        let shifted = samples.track("height", 0.1, 1.0, 2.0).expect("legal");
        for k in 0..97 {
            let time = 0.065 * f64::from(k);
            assert!((shifted.at(time).velocity - own.at(time + 2.0).velocity).abs() < 1e-12);
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
            (Waveform::Sine { amplitude: -0.1, phase: 0.0 }, "amplitude = -0.1"),
            (Waveform::Triangle { amplitude: 0.1, phase: f64::NAN }, "phase = NaN"),
            (Waveform::Sawtooth { amplitude: 0.1, rise: 1.0, phase: 0.0 }, "rise = 1"),
        ] {
            let text = refusal(height);
            assert!(text.contains(words), "{text}");
        }
    }

    #[cfg(feature = "json")]
    #[test]
    fn a_platform_is_read_as_it_is_written() {
        let text = r#"{"angular_frequency": 15, "height": {"fourier": [[0.2, 0], [0.02, 1.5]]},
            "angle": {"sawtooth": {"amplitude": 0.9, "rise": 0.3}}}"#;
        let platform: DrivenPlatform = serde_json::from_str(text).expect("legal");
        assert_eq!(platform.height(), &Waveform::Fourier(vec![(0.2, 0.0), (0.02, 1.5)]));
        let again = serde_json::to_string(&platform).expect("written");
        assert_eq!(serde_json::from_str::<DrivenPlatform>(&again).expect("read"), platform);
        let still = text.replace("0.02", "1e400");
        assert!(serde_json::from_str::<DrivenPlatform>(&still).is_err());
        assert!(serde_json::from_str::<DrivenPlatform>(&text.replace("rise", "raise")).is_err());
    }
}
