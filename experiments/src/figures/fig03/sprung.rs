//! A rotor on a spring instead of under a constant preload (Sec. I).
//!
//! The engine keeps its constant preload. A spring that is compressed by δl_0 at the middle of the rotor's
//! travel presses with g (1 + (x − x_middle)/δl_0): the preload changes by the travel over δl_0 from end to
//! end. What that does to a flight is computed in closed form, for it is a piece of an oscillation with the
//! frequency sqrt(g/δl_0), and bounded by the two parabolas under the largest and the smallest preload,
//! between which it lies.

use std::convert::Infallible;

use bouncing_disk::core::elementary::{asin, hypot, sin, sin_cos};
use bouncing_disk::core::numerics::roots::bisection;
use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::{Engine, EventKind, EventRecord, System, TOSS_START};

use super::data::{Sprung, SprungFlight, SprungMotor};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::motor_case::{MotorCase, core_error};
use crate::paper;

/// The change of the preload, from end to end of the travel, for which the deflection is given.
const SHARE: f64 = 0.01;
/// Static deflections that are tried, over the rotor's travel.
const DEFLECTIONS: [f64; 4] = [10.0, 100.0, 1_000.0, 10_000.0];
/// Steps of a period in which the impact of a flight on a spring is looked for.
const STEPS: f64 = 256.0;

/// A flight in the units of the engine: the height is that above the platform's mean, gravity is 1.
#[derive(Clone, Copy, Debug)]
struct Launch {
    peak: f64,
    phase: f64,
    height: f64,
    velocity: f64,
}

/// A spring in the same units.
#[derive(Clone, Copy, Debug)]
struct Spring {
    middle: f64,
    deflection: f64,
}

impl Spring {
    /// The preload at a height, in units of g.
    fn preload(&self, height: f64) -> f64 {
        1.0 + (height - self.middle) / self.deflection
    }
}

/// The end of a flight: its duration and the rotor's velocity there.
#[derive(Clone, Copy, Debug)]
struct End {
    duration: f64,
    velocity: f64,
}

impl Launch {
    fn platform(&self, time: f64) -> f64 {
        self.peak * sin(self.phase + time)
    }

    /// Height and velocity a time after the launch.
    fn at(&self, spring: &Spring, time: f64) -> (f64, f64) {
        let rate = 1.0 / spring.deflection.sqrt();
        let (sine, cosine) = sin_cos(rate * time);
        let half = sin(0.5 * rate * time);
        // The rotor swings about the height at which the spring would be relaxed.
        let reach = self.height - spring.middle + spring.deflection;
        let height = self.height - 2.0 * reach * half * half + self.velocity / rate * sine;
        (height, self.velocity * cosine - reach * rate * sine)
    }

    /// The highest point.
    fn apex(&self, spring: &Spring) -> f64 {
        let relaxed = spring.middle - spring.deflection;
        relaxed + hypot(self.height - relaxed, self.velocity * spring.deflection.sqrt())
    }

    /// The first impact after the launch, by steps of a small share of a period and bisection; `None` if
    /// there is none in half a swing, in which every flight ends.
    fn impact(&self, spring: &Spring) -> Option<End> {
        let step = std::f64::consts::TAU / STEPS;
        let longest = std::f64::consts::PI * spring.deflection.sqrt();
        let gap = |time: f64| self.at(spring, time).0 - self.platform(time);
        let mut low = step;
        while gap(low + step) > 0.0 {
            low += step;
            if low > longest {
                return None;
            }
        }
        // Down to the last place of the time.
        let Ok(duration) = bisection(low, low + step, 60, |time| Ok::<_, Infallible>(gap(time) > 0.0));
        Some(End { duration, velocity: self.at(spring, duration).1 })
    }

    /// When a flight under a constant preload comes down to a height that is not above its highest point.
    fn falls_to(&self, height: f64, preload: f64) -> f64 {
        let under = self.velocity * self.velocity + 2.0 * preload * (self.height - height);
        (self.velocity + under.max(0.0).sqrt()) / preload
    }

    fn compared(&self, spring: &Spring, constant: End) -> Option<SprungFlight> {
        let end = self.impact(spring)?;
        let (largest, smallest) = (spring.preload(self.apex(spring)), spring.preload(-self.peak));
        // The impact happens between the platform's highest and lowest points.
        let bounds = (self.falls_to(self.peak, largest), self.falls_to(-self.peak, smallest));
        let share = |duration: f64| duration / constant.duration - 1.0;
        Some(SprungFlight {
            deflection_over_travel: 0.0,
            preload_change: largest - smallest,
            duration_change: share(end.duration),
            fall_speed_change: end.velocity / constant.velocity - 1.0,
            impact_shift_cycles: (end.duration - constant.duration) / std::f64::consts::TAU,
            duration_bounds: (share(bounds.0), share(bounds.1)),
        })
    }
}

fn engine(system: &System) -> Result<Engine, ExperimentError> {
    let phase = Phase::new(TOSS_START).map_err(core_error)?;
    let start = bouncing_disk::InitialCondition::Contact { phase, angular_speed: 0.0 };
    Engine::new(*system, start, ChatterPolicy::Complete).map_err(ExperimentError::model)
}

/// The first launch of a rotor at rest, and the end of its flight under constant preload.
fn first_flight(system: &System) -> Result<Option<(Launch, End)>, ExperimentError> {
    let mut before: Option<EventRecord> = None;
    for record in engine(system)? {
        let record = record.map_err(ExperimentError::model)?;
        if let (Some(launch), EventKind::Impact) = (before, record.event.kind()) {
            let launch = Launch {
                peak: system.peak_acceleration(),
                phase: asin(1.0 / system.peak_acceleration()),
                height: launch.after.height,
                velocity: launch.after.axial_velocity,
            };
            let end = End { duration: record.span.radians(), velocity: record.before.axial_velocity };
            return Ok(Some((launch, end)));
        }
        if record.event.kind() == EventKind::Separation {
            before = Some(record);
        }
    }
    Ok(None)
}

/// The highest point of a rotor, over so many events from rest, in the units of the engine.
fn highest(system: &System, events: usize) -> Result<f64, ExperimentError> {
    let mut highest = system.peak_acceleration();
    for record in engine(system)?.take(events) {
        let launch = record.map_err(ExperimentError::model)?.after;
        let rise = 0.5 * launch.axial_velocity * launch.axial_velocity;
        if launch.axial_velocity > 0.0 {
            highest = highest.max(launch.height + rise);
        }
    }
    Ok(highest)
}

fn motor(case: &MotorCase, events: usize) -> Result<SprungMotor, ExperimentError> {
    let system = case.system()?;
    let length = system.scales().length;
    let no_flight = || {
        ExperimentError::model(bouncing_disk::Error::NeverLeaves {
            peak_acceleration: system.peak_acceleration(),
        })
    };
    let (launch, constant) = first_flight(&system)?.ok_or_else(no_flight)?;
    let (low, high) = (-system.peak_acceleration(), highest(&system, events)?);
    let travel = high - low;
    let springs = DEFLECTIONS
        .into_iter()
        .map(|ratio| {
            let spring = Spring { middle: 0.5 * (low + high), deflection: ratio * travel };
            let flight = launch.compared(&spring, constant).ok_or_else(no_flight)?;
            Ok(SprungFlight { deflection_over_travel: ratio, ..flight })
        })
        .collect::<Result<_, ExperimentError>>()?;
    Ok(SprungMotor {
        amplitude_m: case.amplitude_m,
        axial_forcing: system.axial_forcing(),
        events,
        travel_m: travel * length,
        deflection_for_share_m: travel * length / SHARE,
        flight_cycles: constant.duration / std::f64::consts::TAU,
        springs,
    })
}

/// The motors of Table III with the amplitudes of Fig. 10.
pub(super) fn sprung(quality: Quality) -> Result<Sprung, ExperimentError> {
    let section = paper::section_five()?;
    let default = MotorCase::default_of(&paper::table_three()?, &section);
    let events = quality.choose(2_000, 20_000);
    let motors = section
        .amplitudes_of_fig10_m
        .into_iter()
        .map(|amplitude_m| motor(&MotorCase { amplitude_m, ..default }, events))
        .collect::<Result<_, _>>()?;
    Ok(Sprung { preload_share: SHARE, motors })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A separate integrator: Runge-Kutta of the fourth order on ẍ = −preload(x), with the impact by halving
    /// the last step.
    fn integrated(launch: &Launch, spring: &Spring) -> End {
        let acceleration = |height: f64| -spring.preload(height);
        let advanced = |(x, v): (f64, f64), h: f64| {
            let one = (v, acceleration(x));
            let two = (v + 0.5 * h * one.1, acceleration(x + 0.5 * h * one.0));
            let three = (v + 0.5 * h * two.1, acceleration(x + 0.5 * h * two.0));
            let four = (v + h * three.1, acceleration(x + h * three.0));
            (
                x + h / 6.0 * (one.0 + 2.0 * two.0 + 2.0 * three.0 + four.0),
                v + h / 6.0 * (one.1 + 2.0 * two.1 + 2.0 * three.1 + four.1),
            )
        };
        let mut step = std::f64::consts::TAU / 300.0;
        let (mut time, mut state) = (0.0, (launch.height, launch.velocity));
        (time, state) = (time + step, advanced(state, step));
        while step > 1e-13 {
            let next = advanced(state, step);
            if next.0 > launch.platform(time + step) {
                (time, state) = (time + step, next);
            } else {
                step *= 0.5;
            }
        }
        End { duration: time, velocity: state.1 }
    }

    fn motors() -> Vec<(System, Launch, End)> {
        let section = paper::section_five().expect("reads");
        let default = MotorCase::default_of(&paper::table_three().expect("reads"), &section);
        let system = |amplitude_m: f64| MotorCase { amplitude_m, ..default }.system().expect("legal");
        section
            .amplitudes_of_fig10_m
            .into_iter()
            .map(system)
            .map(|system| {
                let (launch, end) = first_flight(&system).expect("runs").expect("flies");
                (system, launch, end)
            })
            .collect()
    }

    #[test]
    fn a_flight_on_a_spring_agrees_with_a_separate_integrator_and_with_the_engine_within_the_bound() {
        for (_, launch, constant) in motors() {
            let apex = launch.height + 0.5 * launch.velocity * launch.velocity;
            let (middle, travel) = (0.5 * (apex - launch.peak), apex + launch.peak);
            for ratio in DEFLECTIONS {
                let spring = Spring { middle, deflection: ratio * travel };
                let (here, there) = (launch.impact(&spring).expect("lands"), integrated(&launch, &spring));
                assert!((here.duration - there.duration).abs() < 1e-6, "{ratio} {here:?} {there:?}");
                assert!((here.velocity / there.velocity - 1.0).abs() < 1e-8, "{ratio} {here:?} {there:?}");
                // The engine's constant preload against the spring's, both ends of which bound the flight.
                let flight = launch.compared(&spring, constant).expect("lands");
                let (early, late) = flight.duration_bounds;
                assert!(early <= flight.duration_change && flight.duration_change <= late, "{flight:?}");
                assert!(early <= 0.0 && 0.0 <= late, "{flight:?}");
                assert!(flight.preload_change <= 1.01 / ratio, "{flight:?}");
            }
        }
    }

    #[test]
    fn a_very_soft_spring_presses_like_the_constant_preload_of_the_engine() {
        for (_, launch, constant) in motors() {
            let spring = Spring { middle: launch.height, deflection: 1e16 };
            let there = integrated(&launch, &spring);
            assert!((there.duration - constant.duration).abs() < 1e-6, "{there:?} {constant:?}");
            assert!((there.velocity / constant.velocity - 1.0).abs() < 1e-8, "{there:?} {constant:?}");
        }
    }
}
