//! A platform that moves and turns in any periodic way, in SI units.

use std::f64::consts::TAU;

use bouncing_disk_core::read_checked;

use crate::error::{Error, check, finite, not_negative, positive};
use crate::parameters::disk::Disk;
use crate::parameters::platform::Platform;
use crate::parameters::scales::Scales;
use crate::parameters::track::Track;

/// One period of a height (m) or an angle (rad), not yet checked.
///
/// In a file: `{ fourier = [[0.2, 0.0], [0.02, 1.5]] }`, `{ triangle = { amplitude = 0.2 } }`.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Waveform {
    /// amplitude sin(tau + phase), as in Eq. (1).
    Sine(Swing),
    /// The sum of a_j sin(j tau + phi_j) over j = 1, 2, ... of these (a_j, phi_j), at most
    /// [`MAX_HARMONICS`](bouncing_disk_core::flight::MAX_HARMONICS).
    Fourier(Vec<(f64, f64)>),
    /// Pieces (duration, [c0, c1, c2, c3]), one after the other, each c0 + c1 x + c2 x^2 + c3 x^3 from its own
    /// start: x and the durations in periods, which sum to 1. The height must be continuous; the velocity may
    /// jump. At most [`MAX_PIECES`](bouncing_disk_core::flight::MAX_PIECES).
    Pieces(Vec<(f64, [f64; 4])>),
    /// The periodic cubic spline through at least 3 samples at equal distances over one period.
    Sampled(Vec<f64>),
    /// Straight lines through the zeros and extremes of the sine.
    Triangle(Swing),
    /// Straight lines that rise for this share of the period, in [1e-9, 1 - 1e-9], and fall for the rest.
    Sawtooth(f64, Swing),
    /// The sine replaced by one parabola for each half of the period.
    Parabolas(Swing),
}

/// Size and phase of a waveform.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Swing {
    /// Amplitude (m or rad), not negative.
    pub amplitude: f64,
    /// How much earlier it is than the sine (rad).
    #[cfg_attr(feature = "serde", serde(default))]
    pub phase: f64,
}

impl Default for Waveform {
    /// No motion.
    fn default() -> Self {
        Self::Fourier(Vec::new())
    }
}

impl Waveform {
    /// amplitude sin(tau + phase).
    #[must_use]
    pub const fn sine(amplitude: f64, phase: f64) -> Self {
        Self::Sine(Swing { amplitude, phase })
    }

    /// A triangle with its zeros and extremes where sin(tau + phase) has them.
    #[must_use]
    pub const fn triangle(amplitude: f64, phase: f64) -> Self {
        Self::Triangle(Swing { amplitude, phase })
    }

    /// The harmonics of a sine or a Fourier sum.
    pub(crate) fn harmonics(&self) -> Option<Vec<(f64, f64)>> {
        match self {
            Self::Sine(Swing { amplitude, phase }) => Some(vec![(*amplitude, *phase)]),
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
        let line = |c0: f64, c1: f64| [c0, c1, 0.0, 0.0];
        let sawtooth = |rise: f64, a: f64| {
            let (up, down) = (2.0 * a / rise, -2.0 * a / (1.0 - rise));
            [(0.5 * rise, line(0.0, up)), (1.0 - rise, line(a, down)), (0.5 * rise, line(-a, up))]
        };
        let parabola = |a: f64| (0.5, [0.0, 8.0 * a, -16.0 * a, 0.0]);
        let (track, phase) = match self {
            Self::Sine(_) | Self::Fourier(_) => {
                let earlier = |(j, (a, phi)): (usize, (f64, f64))| (size * a, phi + (j + 1) as f64 * lag);
                let harmonics: Vec<_> =
                    self.harmonics().into_iter().flatten().enumerate().map(earlier).collect();
                return Track::sines(&harmonics).map_err(refuse);
            }
            Self::Sampled(samples) => {
                let samples: Vec<_> = samples.iter().map(|sample| size * sample).collect();
                (Track::sampled(&samples), 0.0)
            }
            Self::Pieces(pieces) => {
                let total = pieces.iter().fold(0.0, |sum, (duration, _)| sum + duration);
                if pieces.iter().all(|(duration, _)| *duration > 0.0) {
                    let legal = (total - 1.0).abs() <= 1.0e-12;
                    check(legal, "sum of the durations of the pieces", total, "1 (in periods)")?;
                }
                (pieces_of(pieces, size), 0.0)
            }
            Self::Triangle(Swing { amplitude, phase }) => {
                (pieces_of(&sawtooth(0.5, *amplitude), size), *phase)
            }
            Self::Sawtooth(rise, Swing { amplitude, phase }) => {
                let legal = (1.0e-9..=1.0 - 1.0e-9).contains(rise);
                check(legal, "rise", *rise, "[1e-9, 1 - 1e-9], a share of the period")?;
                (pieces_of(&sawtooth(*rise, *amplitude), size), *phase)
            }
            Self::Parabolas(Swing { amplitude, phase }) => {
                (pieces_of(&[parabola(*amplitude), parabola(-amplitude)], size), *phase)
            }
        };
        track.and_then(|track| track.earlier(phase + lag)).map_err(refuse)
    }

    /// Checks what does not depend on the disk.
    fn check(&self, of: &'static str) -> Result<(), Error> {
        if let Self::Sine(swing) | Self::Triangle(swing) | Self::Sawtooth(_, swing) | Self::Parabolas(swing) =
            self
        {
            not_negative("amplitude", swing.amplitude)?;
            finite("phase", swing.phase)?;
        }
        // In units so large that no acceleration is in the way.
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
        let unit = if largest > 0.0 && largest.is_finite() { largest } else { 1.0 };
        self.track(of, unit, 1.0, 0.0).map(|_| ())
    }
}

/// Pieces whose times are in periods and that are made `size` times as large.
fn pieces_of(pieces: &[(f64, [f64; 4])], size: f64) -> Result<Track, bouncing_disk_core::Error> {
    let scaled = |&(duration, [c0, c1, c2, c3]): &(f64, [f64; 4])| {
        let c = [c0 * size, c1 * size / TAU, c2 * size / (TAU * TAU), c3 * size / (TAU * TAU * TAU)];
        (duration * TAU, c)
    };
    Track::pieces(&pieces.iter().map(scaled).collect::<Vec<_>>())
}

/// A platform whose height and angle are any [`Waveform`]s of one period.
///
/// ```
/// use bouncing_disk::parameters::{DrivenPlatform, Waveform};
///
/// // The hand of Table I, moved along straight lines.
/// assert!(DrivenPlatform::new(15.0, Waveform::triangle(0.21, 0.0), Waveform::sine(0.97, 0.0)).is_ok());
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedPlatform"))]
pub struct DrivenPlatform {
    angular_frequency: f64,
    height: Waveform,
    angle: Waveform,
}

read_checked!(DrivenPlatform as UncheckedPlatform {
    angular_frequency: f64,
    height: Waveform,
    #[serde(default)]
    angle: Waveform,
});

impl DrivenPlatform {
    /// A platform with this angular frequency of the fundamental (rad/s), height (m) and angle (rad; none if absent
    /// in a file).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a number outside its range; [`Error::Waveform`] and [`Error::WaveformJump`] name
    /// the waveform and its harmonic, piece or sample.
    pub fn new(angular_frequency: f64, height: Waveform, angle: Waveform) -> Result<Self, Error> {
        let platform = Self { angular_frequency, height, angle };
        platform.check().map(|()| platform)
    }

    fn check(&self) -> Result<(), Error> {
        positive("angular_frequency", self.angular_frequency)?;
        self.height.check("height")?;
        self.angle.check("angle")
    }

    /// Angular frequency of the fundamental (rad/s): the period is 2 pi over it.
    #[must_use]
    pub const fn angular_frequency(&self) -> f64 {
        self.angular_frequency
    }

    /// The height (m) over a period.
    #[must_use]
    pub const fn height(&self) -> &Waveform {
        &self.height
    }

    /// The angle (rad) over a period.
    #[must_use]
    pub const fn angle(&self) -> &Waveform {
        &self.angle
    }

    /// The SI values of the units in which a motion of this disk is computed.
    #[must_use]
    pub fn scales(&self, disk: &Disk) -> Scales {
        Scales::of(self.angular_frequency, disk)
    }
}

impl From<Platform> for DrivenPlatform {
    /// The platform of Eq. (1).
    fn from(platform: Platform) -> Self {
        Self {
            angular_frequency: platform.angular_frequency(),
            height: Waveform::sine(platform.amplitude(), 0.0),
            angle: Waveform::sine(platform.twist_amplitude(), platform.phase_lag()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bouncing_disk_core::flight::{MAX_HARMONICS, MAX_PIECES};

    /// Each waveform some phase earlier is the same motion read later.
    #[test]
    fn a_phase_begins_the_period_elsewhere() {
        let samples = || Waveform::Sampled(vec![0.1, 0.2, -0.3, 0.05, 0.0]);
        let shapes: [fn(Swing) -> Waveform; 4] =
            [Waveform::Sine, Waveform::Triangle, |swing| Waveform::Sawtooth(0.8, swing), Waveform::Parabolas];
        let shapes = shapes.map(|shape| shape(Swing { amplitude: 0.3, phase: 0.4 }));
        for shape in shapes.into_iter().chain([samples()]) {
            let track = |lag| shape.track("height", 0.1, 1.0, lag).expect("legal");
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
        let nan = Swing { amplitude: 0.1, phase: f64::NAN };
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
            (Waveform::sine(-0.1, 0.0), "amplitude = -0.1"),
            (Waveform::Triangle(nan), "phase = NaN"),
            (Waveform::Sawtooth(1.0, Swing { amplitude: 0.1, phase: 0.0 }), "rise = 1"),
        ] {
            let refused = DrivenPlatform::new(15.0, height, Waveform::default()).expect_err("refused");
            assert!(refused.to_string().contains(words), "{refused}");
        }
        assert!(DrivenPlatform::new(0.0, Waveform::default(), Waveform::default()).is_err());
    }

    #[cfg(feature = "json")]
    #[test]
    fn a_platform_is_read_as_it_is_written() {
        let text = r#"{"angular_frequency": 15, "height": {"fourier": [[0.2, 0], [0.02, 1.5]]},
            "angle": {"sawtooth": [0.3, {"amplitude": 0.9}]}}"#;
        let platform: DrivenPlatform = serde_json::from_str(text).expect("legal");
        assert_eq!(platform.height(), &Waveform::Fourier(vec![(0.2, 0.0), (0.02, 1.5)]));
        let again = serde_json::to_string(&platform).expect("written");
        assert_eq!(serde_json::from_str::<DrivenPlatform>(&again).expect("read"), platform);
        assert!(serde_json::from_str::<DrivenPlatform>(&text.replace("0.9", "-1")).is_err());
        assert!(serde_json::from_str::<DrivenPlatform>(&text.replace("amplitude", "size")).is_err());
    }
}
