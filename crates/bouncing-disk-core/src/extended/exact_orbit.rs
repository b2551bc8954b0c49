//! The orbit of a disk from its separation, in many digits.
//!
//! Each flight begins from the certified first impact in doubles and is continued by Newton's iteration with
//! twice the bits in every step, so that the last one alone has all of them. The derivative of the map tells,
//! in doubles, how far an error of the start has grown: as many bits of the state mean nothing any more and
//! are dropped.

use dashu_int::IBig;
use glam::DMat2;

use crate::error::Error;
use crate::extended::fixed_point::FixedPoint;
use crate::flight::launch::Launch;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::elementary::ln;
use crate::observer::Watch;
use crate::platform::phase::Phase;

/// Bits of a state that must mean something: those of a double, and what decides whether a flight's first
/// impact is sure.
const LEAST_BITS: usize = 96;

/// Bits beyond those that mean something, so that dropping the rest adds nothing to the error.
const GUARD_BITS: usize = 32;

/// Bits are dropped by whole words.
const WORD: usize = 64;

/// Bits of a duration that the certified solver finds in doubles, where the flight is sure.
const BITS_OF_DOUBLES: usize = 30;

/// How near (units of g/omega^2, times 1 + P) a flight may come to an earlier impact: far more than the
/// rounding of the gap in doubles, 1e-14 of the same.
const SURE_MARGIN: f64 = 1.0e-10;

/// The share of (1 + P) and of the duration, up to 1 rad, that the impact speed must reach. The gap then dips
/// behind the impact by 5e-13 (1 + P) of the squared duration at least, and an impact in doubles is one.
const SURE_SPEED: f64 = 1.0e-6;

/// A correction (rad, times the duration up to 1) of a duration in doubles that is another flight.
const SAME_FLIGHT: f64 = 1.0e-6;

/// Newton steps of one flight: their bits double, so that forty are far more than any flight takes.
const MAX_NEWTON_STEPS: u32 = 40;

/// The phase (rad) to which doubles follow an orbit when they do.
const FOLLOWED: f64 = 1.0e-3;

/// The disk as it leaves the platform.
#[derive(Debug, Clone)]
struct ExactLaunch {
    /// The phase in [0, 2 pi), with its sine and cosine.
    angle: IBig,
    sin: IBig,
    cos: IBig,
    /// Relative to the platform.
    speed: IBig,
}

/// The growth of an error: its first-order matrix, in units of 2^`power`.
#[derive(Debug, Clone, Copy)]
struct ErrorGrowth {
    /// The products D D^T of the derivatives, of an error that is 1 in phase and speed at the start.
    square: DMat2,
    log2_scale: f64,
    largest: f64,
}

impl ErrorGrowth {
    const fn new() -> Self {
        Self { square: DMat2::IDENTITY, log2_scale: 0.0, largest: 0.0 }
    }

    /// Bits lost so far, at most.
    fn grow(&mut self, derivative: DMat2) -> f64 {
        self.square = derivative * self.square * derivative.transpose();
        let size = self.square.x_axis.x + self.square.y_axis.y;
        self.log2_scale += 0.5 * ln(size) / core::f64::consts::LN_2;
        self.square *= 1.0 / size;
        // The roundings on the way are errors of later starts, which have not grown as much.
        if self.log2_scale < 0.0 {
            *self = Self { largest: self.largest, ..Self::new() };
        }
        self.largest = self.largest.max(self.log2_scale);
        self.largest
    }
}

/// How an orbit was followed.
#[derive(Debug, Clone, Copy)]
pub(super) enum Followed {
    /// To its rest.
    Rest { impacts: u64, periods: u64, phase: f64, lost_bits: f64, impacts_in_doubles: u64 },
    /// For so many impacts, without one.
    Flying { impacts: u64, lost_bits: f64, impacts_in_doubles: u64 },
    /// Until no bits were left.
    Spent { impacts: u64 },
    /// To a flight whose first impact doubles cannot tell.
    Unsure { impacts: u64, margin: f64 },
}

/// The end of a flight.
enum Flight {
    Lands { next: ExactLaunch, impact: ImpactState, derivative: DMat2, turns: u64 },
    Unsure(f64),
}

/// An orbit from separation, and the arithmetic that follows it.
#[derive(Debug)]
pub(super) struct ExactOrbit {
    map: ImpactMap,
    arithmetic: FixedPoint,
    /// Bits at the start.
    bits: usize,
    launch: ExactLaunch,
    /// The launch in doubles; the first one is from rest.
    in_doubles: (Phase, f64),
}

impl ExactOrbit {
    /// The orbit of a map with a separation, in so many bits.
    pub(super) fn new(map: ImpactMap, bits: usize) -> Result<Self, Error> {
        let arithmetic = FixedPoint::new(bits);
        let peak = map.vibration().peak_acceleration();
        let none =
            Error::OutOfRange { field: "peak_acceleration", value: peak, legal: "above 1: it separates" };
        let phase = map.vibration().separation_phase().ok_or(none)?;
        let sought = arithmetic.quotient(&arithmetic.number(1.0), &arithmetic.number(peak));
        let mut angle = arithmetic.number(phase.angle());
        let mut left = f64::INFINITY;
        // Newton's iteration for sin(angle) = 1/P, until it no longer comes nearer.
        let (sin, cos) = loop {
            let (sin, cos) = arithmetic.sin_cos(&angle);
            let distance = &sought - &sin;
            let size = arithmetic.value(&distance).abs();
            if size >= left || distance.is_zero() {
                break (sin, cos);
            }
            left = size;
            angle += arithmetic.quotient(&distance, &cos);
        };
        let launch = ExactLaunch { angle, sin, cos, speed: IBig::ZERO };
        Ok(Self { map, arithmetic, bits, launch, in_doubles: (phase, 0.0) })
    }

    /// Follows the orbit to its rest or for so many impacts.
    pub(super) fn follow(mut self, max_impacts: u64, watch: &Watch<'_>) -> Result<Followed, Error> {
        let restitution = self.map.restitution();
        let vibration = *self.map.vibration();
        let (mut growth, mut lost_bits) = (ErrorGrowth::new(), 0.0);
        let (mut periods, mut impacts_in_doubles) = (0, 0);
        // The orbit that doubles find by themselves, as long as it is this one.
        let mut shadow = Some(self.in_doubles);
        let mut state = ImpactState::new(self.in_doubles.0, 0.0)?;
        for impacts in 0..max_impacts {
            watch.set_done(impacts);
            watch.ask()?;
            let left = self.bits - (lost_bits as usize).min(self.bits);
            if left < LEAST_BITS {
                return Ok(Followed::Spent { impacts });
            }
            self.drop_bits(left + GUARD_BITS);
            let (next, impact, derivative) = match self.fly(state)? {
                Flight::Unsure(margin) => return Ok(Followed::Unsure { impacts, margin }),
                Flight::Lands { next, impact, derivative, turns } => {
                    periods += turns;
                    (next, impact, derivative)
                }
            };
            lost_bits = growth.grow(derivative);
            self.launch = next;
            state = impact;
            self.in_doubles = (impact.phase(), -restitution * impact.velocity());
            if let Some((phase, speed)) = shadow {
                let found = vibration.impact_after(phase, speed)?;
                let distance = (found.phase.angle() - impact.phase().angle()).abs();
                let follows = distance <= FOLLOWED || distance >= core::f64::consts::TAU - FOLLOWED;
                impacts_in_doubles += u64::from(follows);
                shadow = follows.then_some((found.phase, -restitution * found.velocity));
            }
            let (phase, speed) = self.in_doubles;
            if let Some(rest) = vibration.accumulation(phase, speed, restitution) {
                let separation = vibration.separation_phase().map_or(0.0, |phase| phase.angle());
                let to_separation = u64::from(separation <= rest.phase.angle());
                return Ok(Followed::Rest {
                    impacts: impacts + 1,
                    periods: periods + rest.turns + to_separation,
                    phase: rest.phase.angle(),
                    lost_bits,
                    impacts_in_doubles,
                });
            }
        }
        Ok(Followed::Flying { impacts: max_impacts, lost_bits, impacts_in_doubles })
    }

    /// Takes off bits that mean nothing any more.
    fn drop_bits(&mut self, enough: usize) {
        let enough = enough.next_multiple_of(WORD);
        let Some(spare) = self.arithmetic.bits().checked_sub(enough) else { return };
        if spare == 0 {
            return;
        }
        self.arithmetic = self.arithmetic.with_fewer(enough);
        let ExactLaunch { angle, sin, cos, speed } = &mut self.launch;
        for number in [angle, sin, cos, speed] {
            *number >>= spare;
        }
    }

    /// One flight; `from` is the state in doubles that it follows.
    fn fly(&self, from: ImpactState) -> Result<Flight, Error> {
        let vibration = self.map.vibration();
        let peak = vibration.peak_acceleration();
        let (phase, speed) = self.in_doubles;
        let found = vibration.impact_after(phase, speed)?;
        let duration = found.duration();
        let margin = vibration.graze_margin(Launch::new(phase, speed)?, &found);
        if margin < SURE_MARGIN * (1.0 + peak) {
            return Ok(Flight::Unsure(margin));
        }
        let least = SURE_SPEED * (1.0 + peak) * duration.min(1.0);
        if -found.velocity < least {
            // The depth of the dip behind the impact.
            return Ok(Flight::Unsure(found.velocity * found.velocity / (2.0 * (1.0 + peak))));
        }
        let all = self.arithmetic.bits();
        let mut h = self.arithmetic.number(duration);
        // A step squares an error times this: half the curvature of the gap, at most, by its slope.
        let lost = (ln((1.0 + peak) / -found.velocity) / core::f64::consts::LN_2).max(0.0) as usize + 2;
        // Bits that are right before a step, at least, of which a step makes twice as many.
        let (mut right, mut steps) = (BITS_OF_DOUBLES, 0);
        let exact_peak = self.arithmetic.number(peak);
        let (sin, cos, velocity, angle) = loop {
            let bits = (2 * right + WORD).next_multiple_of(WORD).min(all);
            let arithmetic = self.arithmetic.with_fewer(bits);
            let fewer = |number: &IBig| number >> (all - bits);
            let ExactLaunch { angle, sin, cos, speed } = &self.launch;
            let (p, now) = (fewer(&exact_peak), fewer(&h));
            let disk_speed = fewer(speed) + arithmetic.product(&p, &fewer(cos));
            let there = fewer(angle) + &now;
            let (s, c) = arithmetic.sin_cos(&there);
            // The gap, and its slope: the impact velocity.
            let rise = arithmetic.product(&p, &(&s - fewer(sin)));
            let gap = arithmetic.product(&disk_speed, &now) - (arithmetic.square(&now) >> 1_usize) - rise;
            let slope = &disk_speed - &now - arithmetic.product(&p, &c);
            let step = -arithmetic.quotient(&gap, &slope);
            if arithmetic.value(&step).abs() > SAME_FLIGHT * duration.min(1.0) {
                return Ok(Flight::Unsure(arithmetic.value(&gap).abs()));
            }
            h = (now + &step) << (all - bits);
            // The step is the error that it takes away: so many bits were right, and twice as many are.
            right = (2 * arithmetic.zero_bits(&step)).saturating_sub(lost).min(bits).max(BITS_OF_DOUBLES);
            if bits == all && right == all {
                // The end of the flight moves on by the step, whose cube is nothing.
                let square = arithmetic.square(&step) >> 1_usize;
                let s1 = &s + arithmetic.product(&c, &step) - arithmetic.product(&s, &square);
                let c1 = &c - arithmetic.product(&s, &step) - arithmetic.product(&c, &square);
                let velocity = &disk_speed - &h - arithmetic.product(&p, &c1);
                break (s1, c1, velocity, there + step);
            }
            steps += 1;
            if steps > MAX_NEWTON_STEPS {
                return Ok(Flight::Unsure(arithmetic.value(&gap).abs()));
            }
        };
        let period = self.arithmetic.period();
        let turns = &angle / &period;
        let angle = angle - &turns * period;
        let as_double = self.arithmetic.value(&angle);
        let phase = Phase::from_parts(
            as_double.min(core::f64::consts::TAU.next_down()),
            self.arithmetic.value(&sin),
            self.arithmetic.value(&cos),
        );
        let speed = self.arithmetic.product(&velocity, &self.arithmetic.number(-self.map.restitution()));
        let impact = ImpactState::new(phase, self.arithmetic.value(&velocity).min(0.0))?;
        let turns = u64::try_from(turns).unwrap_or(u64::MAX);
        let derivative = self.map.derivative(from, impact, self.arithmetic.value(&h));
        Ok(Flight::Lands { next: ExactLaunch { angle, sin, cos, speed }, impact, derivative, turns })
    }
}
