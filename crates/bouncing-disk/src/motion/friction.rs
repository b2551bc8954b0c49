//! Friction while disk and platform touch, Eq. (4): whether it holds, when it gives way, and when a slip
//! ends. (The normal force N = 1 - P sin tau, Eq. (3), is the core's `Vibration::contact_force`.)
//!
//! Let U >= 0 be the slip speed in one direction s (s = +1: the disk is ahead). While the disk slides,
//!
//! ```text
//! dU/dtau = -(mu + s l) + mu P sin tau + s Q sin(tau + theta) = -decay + amplitude sin(tau + lead)
//! ```
//!
//! A disk at the platform's speed begins to slip in direction s exactly when this rate is positive, and sticks
//! when it is positive for neither direction. The rates of the two directions add up to -2 mu N, so in contact
//! they are never both positive. Each is positive over one interval of the period, known in closed form. The
//! position of the phase relative to these intervals (the *windows*) decides whether friction holds and when a
//! slip ends; the sign of a rounded force never does. The event that follows, and the state after it, are
//! decided in `contact_motion.rs`.

use std::cmp::Ordering;
use std::f64::consts::{FRAC_PI_2, TAU};

use bouncing_disk_core::Phase;
use bouncing_disk_core::flight::MAX_FLIGHT_DURATION;
use bouncing_disk_core::numerics::elementary::{acos, atan2, hypot, sin_cos, wrapped_angle};
use bouncing_disk_core::numerics::roots::falling_root;

use crate::error::Error;
use crate::motion::arc::sine_deficit;
use crate::motion::phase_time::PhaseSpan;
use crate::motion::state::SlipDirection;
use crate::parameters::dimensionless::DimensionlessSystem;

/// Relative accuracy to which the end of a slip is located.
const ROOT_ACCURACY: f64 = 2.0 * f64::EPSILON;

/// A slip speed this small, relative to the terms of its computation, may have the wrong sign; the limit is far
/// above the rounding of the speed.
const DOUBTFUL_SPEED: f64 = 1.0e-12;

/// The part of the period in which a slip speed grows.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Growth {
    /// Empty.
    Never,
    /// The whole period.
    Always,
    /// The `width` radians from the phase whose negative is `shift`.
    Within { shift: f64, width: f64 },
}

/// The law of the slip speed in one direction.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Slip {
    /// mu + s l.
    decay: f64,
    /// Amplitude and its two components: amplitude sin(tau + lead) = cosine sin tau + sine cos tau.
    amplitude: f64,
    cosine: f64,
    sine: f64,
    growth: Growth,
}

/// The windows of growth that a disk at the platform's speed has just been through, so that it cannot slip
/// there again before the next period. Otherwise rounding could make a slip end and begin again at the same
/// instant for ever.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Spent {
    /// Neither.
    None,
    /// The window of this direction.
    One(SlipDirection),
    /// Both.
    Both,
}

impl Spent {
    fn includes(self, direction: SlipDirection) -> bool {
        match self {
            Self::None => false,
            Self::One(spent) => spent == direction,
            Self::Both => true,
        }
    }
}

/// Coulomb friction in contact (Eq. 4, with the closed envelope counted as holding).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Friction {
    forward: Slip,
    backward: Slip,
    /// Neither twist nor load: no torque acts on the disk, and friction holds it up to the separation. Without
    /// this flag rounding would let it slip an instant earlier.
    unloaded: bool,
    /// Without friction, but with a relative acceleration, the disk is never held.
    slippery: bool,
}

impl Friction {
    pub(crate) fn new(system: &DimensionlessSystem) -> Self {
        let forward = Slip::new(system, SlipDirection::Forward);
        let backward = Slip::new(system, SlipDirection::Backward);
        let unloaded = system.twist_speed() == 0.0 && system.load() == 0.0;
        Self { forward, backward, unloaded, slippery: system.friction() == 0.0 && !unloaded }
    }

    const fn slip(&self, direction: SlipDirection) -> &Slip {
        match direction {
            SlipDirection::Forward => &self.forward,
            SlipDirection::Backward => &self.backward,
        }
    }

    /// The direction in which a disk at the platform's speed slips at once; `None` if friction holds it.
    pub(crate) fn onset(&self, phase: Phase, spent: Spent) -> Option<SlipDirection> {
        let slips =
            |direction: SlipDirection| !spent.includes(direction) && self.slip(direction).grows_at(phase);
        if slips(SlipDirection::Forward) {
            Some(SlipDirection::Forward)
        } else if slips(SlipDirection::Backward) {
            Some(SlipDirection::Backward)
        } else if self.slippery {
            // The two windows fill the period; only rounding can place a phase in neither.
            Some(if let Spent::One(direction) = spent {
                direction.reversed()
            } else {
                SlipDirection::Forward
            })
        } else {
            None
        }
    }

    /// Time in (0, 2 pi] for which a disk that friction holds at `phase` continues to stick, and the
    /// direction in which it then slips; `None` if it sticks for ever.
    pub(crate) fn stick_end(&self, phase: Phase) -> Option<(f64, SlipDirection)> {
        if self.unloaded {
            return None;
        }
        let next = |direction| self.slip(direction).time_to_growth(phase).map(|time| (time, direction));
        match (next(SlipDirection::Forward), next(SlipDirection::Backward)) {
            (Some(ahead), Some(behind)) => Some(if ahead.0 <= behind.0 { ahead } else { behind }),
            (one, None) | (None, one) => one,
        }
    }

    /// Time until the slip in `direction`, with `speed` >= 0 at `phase`, ends: the first return of the slip
    /// speed to zero. A `speed` of zero means that the slip begins at `phase`, according to [`Self::onset`]
    /// or [`Self::stick_end`]. `None` if it does not end within `limit` radians, or never.
    ///
    /// # Errors
    /// [`Error::SlipTooLong`] without a limit, if the end is too far away for its phase to be resolved.
    pub(crate) fn slip_end(
        &self,
        direction: SlipDirection,
        phase: Phase,
        speed: f64,
        limit: Option<f64>,
    ) -> Result<Option<PhaseSpan>, Error> {
        self.slip(direction).end(phase, speed, limit)
    }

    /// Constants (decay, cosine, sine) of the slip speed's closed form
    /// U = U_0 - decay (tau - tau_0) - cosine (cos tau - cos tau_0) + sine (sin tau - sin tau_0).
    pub(crate) const fn slip_law(&self, direction: SlipDirection) -> (f64, f64, f64) {
        let slip = self.slip(direction);
        (slip.decay, slip.cosine, slip.sine)
    }
}

impl Slip {
    fn new(system: &DimensionlessSystem, direction: SlipDirection) -> Self {
        let sign = direction.sign();
        let (twist_cosine, twist_sine) = system.twist_components();
        let decay = system.friction() + sign * system.load();
        let cosine = system.friction() * system.peak_acceleration() + sign * twist_cosine;
        let sine = sign * twist_sine;
        let amplitude = hypot(cosine, sine);
        // amplitude sin(angle) > decay over an interval about the crest; a tangency counts as holding, or,
        // for the opposite sign, as growing throughout.
        let growth = if decay >= amplitude {
            Growth::Never
        } else if decay <= -amplitude {
            Growth::Always
        } else {
            let half = acos(decay / amplitude);
            Growth::Within { shift: atan2(sine, cosine) - (FRAC_PI_2 - half), width: 2.0 * half }
        };
        Self { decay, amplitude, cosine, sine, growth }
    }

    fn grows_at(&self, phase: Phase) -> bool {
        match self.growth {
            Growth::Never => false,
            Growth::Always => true,
            Growth::Within { shift, width } => wrapped_angle(phase.angle() + shift) < width,
        }
    }

    /// Time in (0, 2 pi] to the next start of growth.
    fn time_to_growth(&self, phase: Phase) -> Option<f64> {
        match self.growth {
            Growth::Never => None,
            // Friction cannot have held the disk before; slip at once.
            Growth::Always => Some(0.0),
            Growth::Within { shift, .. } => Some(TAU - wrapped_angle(phase.angle() + shift)),
        }
    }

    /// The sign of a slip speed that was `start` within the last period; `Equal` if the sign may be due to
    /// rounding.
    fn certain_sign(&self, start: f64, value: f64) -> Ordering {
        let doubt = DOUBTFUL_SPEED * (start.abs() + self.decay.abs() + self.amplitude);
        if value > doubt {
            Ordering::Greater
        } else if value < -doubt {
            Ordering::Less
        } else {
            Ordering::Equal
        }
    }

    fn end(&self, phase: Phase, speed: f64, limit: Option<f64>) -> Result<Option<PhaseSpan>, Error> {
        let path = SlipPath::new(self, phase, speed);
        let (periods, root) = match self.growth {
            Growth::Always => return Ok(None),
            Growth::Never => {
                if self.decay <= 0.0 {
                    // Decay and amplitude are both zero: nothing changes the slip speed.
                    return Ok((speed <= 0.0).then_some(PhaseSpan::ZERO));
                }
                // U + decay t lies within the amplitude of its mean.
                let mean = speed + path.cosine_start;
                let earliest = ((mean - self.amplitude) / self.decay).max(0.0);
                let latest = ((mean + self.amplitude) / self.decay).max(earliest);
                let Some(periods) = whole_periods(earliest, limit)? else { return Ok(None) };
                let passed = periods as f64;
                let path = path.later_by(passed);
                let shift = passed * TAU;
                (periods, path.falling_root((earliest - shift).max(0.0), latest - shift))
            }
            Growth::Within { shift, width } => {
                let mut since = wrapped_angle(phase.angle() + shift);
                if speed <= 0.0 && since >= width {
                    // The slip begins here, so this is the start of the window up to rounding.
                    since = 0.0;
                }
                // The highest slip speed (in the past if negative) and the lowest one of the first period.
                let (highest, lowest) = (width - since, TAU - since);
                let sign = match limit {
                    Some(limit) if limit <= highest => Ordering::Greater,
                    Some(limit) if limit < lowest => self.certain_sign(speed, path.at(limit).0),
                    _ => Ordering::Equal,
                };
                if sign == Ordering::Greater {
                    return Ok(None);
                }
                // The slip speed falls until then.
                let least = if sign == Ordering::Less { -speed.abs() } else { path.at(lowest).0 };
                if least <= 0.0 {
                    (0, path.falling_root(highest.max(0.0), lowest))
                } else if self.decay <= 0.0 {
                    return Ok(None);
                } else {
                    // Each period reduces it by 2 pi decay; find the first one whose lowest speed is not
                    // positive.
                    let loss = TAU * self.decay;
                    let estimate = (least / loss - 1.0).max(0.0) * TAU;
                    let Some(mut periods) = whole_periods(estimate, limit)? else { return Ok(None) };
                    periods = periods.max(1);
                    while least - periods as f64 * loss > 0.0 {
                        periods += 1;
                    }
                    while periods > 1 && least - (periods - 1) as f64 * loss <= 0.0 {
                        periods -= 1;
                    }
                    (periods, path.later_by(periods as f64).falling_root(highest, lowest))
                }
            }
        };
        let span = normalised(periods, root);
        Ok(limit.is_none_or(|limit| span.radians() < limit).then_some(span))
    }
}

/// Whole periods in `duration`; `None` if it exceeds the limit.
fn whole_periods(duration: f64, limit: Option<f64>) -> Result<Option<u64>, Error> {
    match limit {
        Some(limit) if duration >= limit => Ok(None),
        None if duration > MAX_FLIGHT_DURATION => {
            Err(Error::SlipTooLong { duration, limit: MAX_FLIGHT_DURATION })
        }
        _ => Ok(Some((duration / TAU) as u64)),
    }
}

/// `periods` and `time`, which may be negative or longer than a period, as a span.
fn normalised(mut periods: u64, mut time: f64) -> PhaseSpan {
    while time < 0.0 && periods > 0 {
        time += TAU;
        periods -= 1;
    }
    while time >= TAU {
        time -= TAU;
        periods += 1;
    }
    PhaseSpan { periods, remainder: time.max(0.0) }
}

/// The slip speed over time, from its value, rate and phase at the start:
/// U(t) = U_0 + rate t + cosine_start (1 - cos t) - sine_start (t - sin t).
#[derive(Debug, Clone, Copy)]
struct SlipPath {
    speed: f64,
    rate: f64,
    /// amplitude cos and amplitude sin of the sinusoid's angle at the start.
    cosine_start: f64,
    sine_start: f64,
    decay: f64,
}

impl SlipPath {
    fn new(slip: &Slip, phase: Phase, speed: f64) -> Self {
        let cosine_start = slip.cosine * phase.cos() - slip.sine * phase.sin();
        let sine_start = slip.cosine * phase.sin() + slip.sine * phase.cos();
        let rate = match slip.growth {
            // sin a - sin b as a product: exactly zero at the beginning of the window.
            Growth::Within { shift, width } => {
                let since = wrapped_angle(phase.angle() + shift);
                let since = if speed <= 0.0 && since >= width { 0.0 } else { since };
                let (sine_half, _) = sin_cos(0.5 * since);
                let (_, cosine_middle) = sin_cos(FRAC_PI_2 - 0.5 * width + 0.5 * since);
                2.0 * slip.amplitude * cosine_middle * sine_half
            }
            Growth::Never | Growth::Always => sine_start - slip.decay,
        };
        Self { speed, rate, cosine_start, sine_start, decay: slip.decay }
    }

    /// The same path, starting a whole number of periods later.
    fn later_by(mut self, periods: f64) -> Self {
        self.speed -= periods * (TAU * self.decay);
        self
    }

    /// Slip speed and its rate.
    fn at(&self, time: f64) -> (f64, f64) {
        let (sine_half, cosine_half) = sin_cos(0.5 * time);
        let versine = 2.0 * sine_half * sine_half;
        let sine = 2.0 * sine_half * cosine_half;
        let speed = self.speed
            + (self.rate * time + (self.cosine_start * versine - self.sine_start * sine_deficit(time, sine)));
        (speed, self.rate + (self.cosine_start * sine - self.sine_start * versine))
    }

    /// The root in [`low`, `high`], over which the speed falls from positive to negative.
    fn falling_root(&self, low: f64, high: f64) -> f64 {
        // At zero the values are known, without calling `at`.
        let start = if low.abs() <= 0.0 { (self.speed, self.rate) } else { self.at(low) };
        falling_root(low, high, start, ROOT_ACCURACY, |time| self.at(time))
    }
}

/// Largest number of contact events (slips that begin, end or reverse) in one segment of contact of at most
/// one period.
///
/// A slip that begins at the platform's speed begins inside its direction's window and ends after it. A segment
/// this short contains at most two parts of each of the two windows (its ends may cut one in two). That makes
/// four slips, each with a beginning and an end, and the end of a slip with which the segment began.
pub const MAX_CONTACT_EVENTS: usize = 9;

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::parameters::dimensionless::DimensionlessParameters;

    const GENTLE: DimensionlessParameters = DimensionlessParameters {
        peak_acceleration: 0.0,
        twist_speed: 1.0,
        phase_lag: 0.0,
        friction: 0.5,
        restitution: 0.5,
        load: 0.0,
    };

    fn friction(parameters: DimensionlessParameters) -> Friction {
        Friction::new(&parameters.build().unwrap())
    }

    fn phase(angle: f64) -> Phase {
        Phase::new(angle).unwrap()
    }

    /// With P = 0 and theta = 0, friction holds while |Q sin tau| <= mu.
    #[test]
    fn sticking_ends_where_the_envelope_is_left() {
        let friction = friction(GENTLE);
        let (time, direction) = friction.stick_end(phase(0.0)).unwrap();
        assert!((time - PI / 6.0).abs() < 1e-15 && direction == SlipDirection::Forward);
        let (time, direction) = friction.stick_end(phase(PI)).unwrap();
        assert!((time - PI / 6.0).abs() < 4e-15 && direction == SlipDirection::Backward);
    }

    /// With P = 2 both windows begin at the separation if the twist reverses there (theta = -pi/6). Only at
    /// this instant can they begin together, as the rates of the two directions add up to -2 mu N. If rounding
    /// leaves the rates equal, the disk slips forward.
    #[test]
    fn a_tie_of_both_directions_goes_forward() {
        let mut ties = 0;
        for k in 1..2_000 {
            let friction = friction(DimensionlessParameters {
                peak_acceleration: 2.0,
                twist_speed: 4e-4 * f64::from(k),
                phase_lag: -PI / 6.0,
                ..GENTLE
            });
            let time = |slip: &Slip| slip.time_to_growth(phase(4.0)).unwrap();
            let (ahead, behind) = (time(&friction.forward), time(&friction.backward));
            assert!((ahead - behind).abs() < 1e-14, "{ahead} {behind}");
            let first = if behind < ahead { SlipDirection::Backward } else { SlipDirection::Forward };
            assert_eq!(friction.stick_end(phase(4.0)), Some((ahead.min(behind), first)));
            ties += u32::from(ahead.to_bits() == behind.to_bits());
        }
        assert!(ties > 10, "{ties}");
    }

    /// On the envelope itself the disk slips if the force grows and is held if it falls.
    #[test]
    fn on_the_envelope_the_derivative_decides() {
        let friction = friction(GENTLE);
        let nudge = 1e-14;
        assert_eq!(friction.onset(phase(PI / 6.0 + nudge), Spent::None), Some(SlipDirection::Forward));
        assert_eq!(friction.onset(phase(PI / 6.0 - nudge), Spent::None), None);
        assert_eq!(friction.onset(phase(5.0 * PI / 6.0 + nudge), Spent::None), None);
        assert_eq!(friction.onset(phase(PI / 2.0), Spent::One(SlipDirection::Forward)), None);
    }

    /// A force that only touches the envelope is held; just above, it slips.
    #[test]
    fn a_tangency_holds() {
        let touching = friction(DimensionlessParameters { twist_speed: 0.5, ..GENTLE });
        assert_eq!(touching.stick_end(phase(0.0)), None);
        assert_eq!(touching.onset(phase(PI / 2.0), Spent::None), None);
        let twist_speed = 0.5 * (1.0 + 4.0 * f64::EPSILON);
        let crossing = friction(DimensionlessParameters { twist_speed, ..GENTLE });
        let (time, _) = crossing.stick_end(phase(0.0)).unwrap();
        assert!((time - PI / 2.0).abs() < 1e-7);
        let end = crossing.slip_end(SlipDirection::Forward, phase(time), 0.0, None).unwrap().unwrap();
        assert!(end.radians() > 0.0 && end.radians() < 1e-6, "{end:?}");
    }

    /// A load beyond the friction accelerates the slip for ever.
    #[test]
    fn a_slip_under_too_much_load_never_ends() {
        let loaded = friction(DimensionlessParameters { load: 2.0, ..GENTLE });
        assert_eq!(loaded.onset(phase(1.0), Spent::None), Some(SlipDirection::Backward));
        assert_eq!(loaded.slip_end(SlipDirection::Backward, phase(1.0), 0.0, None), Ok(None));
        // Forward, friction and load brake together: decay 2.5, amplitude 1.
        let end = loaded.slip_end(SlipDirection::Forward, phase(1.0), 3.0, None).unwrap().unwrap().radians();
        let left = 3.0 - 2.5 * end - (sin_cos(1.0 + end).1 - sin_cos(1.0).1);
        assert!(left.abs() < 1e-14, "{left}");
    }

    /// A long slip that oscillates: the first root, after many periods, agrees with a scan.
    #[test]
    fn a_long_slip_ends_at_its_first_root() {
        let slow = friction(DimensionlessParameters { friction: 1e-3, ..GENTLE });
        for speed in [0.1, 1.0, 5.0, 40.0] {
            let start = phase(2.0);
            let slip = |time: f64| speed - 1e-3 * time - (sin_cos(2.0 + time).1 - sin_cos(2.0).1);
            let end = slow.slip_end(SlipDirection::Forward, start, speed, None).unwrap().unwrap().radians();
            let first = (1..).map(|step| f64::from(step) * 1e-3).find(|time| slip(*time) <= 0.0).unwrap();
            assert!(end <= first + 1e-9 && end > first - 2e-3, "{end} {first}");
            assert!(slip(end).abs() < 1e-12 * speed.max(1.0));
        }
    }

    /// A limit only excludes slips that last longer: it may end the search early, but never changes the result.
    #[test]
    fn a_limit_changes_no_slip_within_it() {
        let (mut ended, mut dropped) = (0, 0);
        for k in 0..200_000_u32 {
            let share = |factor: f64| (f64::from(k) * factor) % 1.0;
            let friction = friction(DimensionlessParameters {
                peak_acceleration: 4.0 * share(0.618_034),
                twist_speed: 6.0 * share(0.754_878) * share(0.1377),
                phase_lag: 2.0 * PI * share(0.569_84),
                load: if k % 3 == 0 { 0.2 * share(0.324_718) } else { 0.0 },
                ..GENTLE
            });
            let direction = if k % 2 == 0 { SlipDirection::Forward } else { SlipDirection::Backward };
            let (start, speed) = (phase(TAU * share(0.414_214)), 3.0 * share(0.732_051) * share(0.236_068));
            let Ok(Some(end)) = friction.slip_end(direction, start, speed, None) else { continue };
            let free = end.radians();
            for limit in [free, free * (1.0 + f64::EPSILON), free + 1e-13, 7.0 * share(0.887_298)] {
                let limited = friction.slip_end(direction, start, speed, Some(limit)).unwrap();
                assert_eq!(limited, (free < limit).then_some(end), "{start:?} {speed} {limit}");
                ended += usize::from(limited.is_some());
                dropped += usize::from(limited.is_none());
            }
        }
        assert!(ended > 100_000 && dropped > 100_000, "{ended} {dropped}");
    }

    #[test]
    fn a_slip_beyond_resolution_is_refused() {
        let still = friction(DimensionlessParameters { twist_speed: 0.0, ..GENTLE });
        let error = still.slip_end(SlipDirection::Forward, phase(0.0), 1e12, None).unwrap_err();
        assert!(matches!(error, Error::SlipTooLong { duration, .. } if (duration - 2e12).abs() < 1.0));
        assert_eq!(still.slip_end(SlipDirection::Forward, phase(0.0), 1e12, Some(6.0)), Ok(None));
    }
}
