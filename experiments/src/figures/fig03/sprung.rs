//! A rotor on a spring instead of under a constant preload (Sec. I).
//!
//! The engine keeps its constant preload. A spring that is compressed by δl_0 at the middle of the rotor's
//! travel presses with g (1 + (x − x_middle)/δl_0): the preload changes by the travel over δl_0 from end to
//! end. The effect on a flight has a closed form, because the flight is a piece of an oscillation with the
//! frequency sqrt(g/δl_0).

use std::convert::Infallible;

use bouncing_disk::core::numerics::elementary::{asin, sin, sin_cos};
use bouncing_disk::core::numerics::roots::bisection;
use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::motion::EventKind;
use bouncing_disk::toss::TOSS_START;
use bouncing_disk::{Engine, EventRecord, System};
use serde::Serialize;

use crate::claims::paper;
use crate::experiment::{ExperimentError, Quality};
use crate::figures::shared::motor::MotorCase;

/// Springs under the motors of Fig. 10.
#[derive(Debug, Serialize)]
pub(super) struct Sprung {
    /// See `deflection_for_share_m`.
    pub(super) preload_share: f64,
    pub(super) motors: Vec<SprungMotor>,
}

/// A motor of Table III with an amplitude.
#[derive(Debug, Serialize)]
pub(super) struct SprungMotor {
    pub(super) amplitude_m: f64,
    pub(super) axial_forcing: f64,
    /// Events of the motion from rest under constant preload in which the highest point was looked for.
    pub(super) events: usize,
    /// From the stator's lowest point to the rotor's highest.
    pub(super) travel_m: f64,
    /// The static deflection for which the preload changes by the share, from end to end of the travel.
    pub(super) deflection_for_share_m: f64,
    /// By the spring, the first flight of a rotor at rest.
    pub(super) springs: Vec<SprungFlight>,
}

/// The first flight of a rotor at rest with a spring, against that under constant preload.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct SprungFlight {
    /// The static deflection over the travel.
    pub(super) deflection_over_travel: f64,
    /// Duration with the spring over that without, minus 1.
    pub(super) duration_change: f64,
    /// The same for the speed of the fall at the impact.
    pub(super) fall_speed_change: f64,
    /// How much later in the stator's motion the impact comes, in periods.
    pub(super) impact_shift_cycles: f64,
}

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

    fn compared(&self, spring: &Spring, constant: End) -> Option<SprungFlight> {
        let end = self.impact(spring)?;
        Some(SprungFlight {
            deflection_over_travel: 0.0,
            duration_change: end.duration / constant.duration - 1.0,
            fall_speed_change: end.velocity / constant.velocity - 1.0,
            impact_shift_cycles: (end.duration - constant.duration) / std::f64::consts::TAU,
        })
    }
}

fn engine(system: &System) -> Result<Engine, ExperimentError> {
    let phase = Phase::new(TOSS_START)?;
    let start = bouncing_disk::InitialCondition::Contact { phase, angular_speed: 0.0 };
    Ok(Engine::new(*system, start, ChatterPolicy::Complete)?)
}

/// The first launch of a rotor at rest, and the end of its flight under constant preload.
fn first_flight(system: &System) -> Result<Option<(Launch, End)>, ExperimentError> {
    let mut before: Option<EventRecord> = None;
    for record in engine(system)? {
        let record = record?;
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
        let launch = record?.after;
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
        springs,
    })
}

/// The motors of Table III with the amplitudes of Fig. 10.
pub(super) fn sprung(quality: Quality) -> Result<Sprung, ExperimentError> {
    let section = paper::section_five()?;
    let default = MotorCase::table_three()?;
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

    fn motors() -> Vec<(Launch, End)> {
        let section = paper::section_five().expect("reads");
        let default = MotorCase::table_three().expect("reads");
        let system = |amplitude_m: f64| MotorCase { amplitude_m, ..default }.system().expect("legal");
        let flight = |system: System| first_flight(&system).expect("runs").expect("flies");
        section.amplitudes_of_fig10_m.into_iter().map(system).map(flight).collect()
    }

    #[test]
    fn a_flight_on_a_spring_obeys_its_equation_of_motion() {
        const SMALL: f64 = 1e-3;
        for (launch, _) in motors() {
            let travel = launch.height + 0.5 * launch.velocity * launch.velocity + launch.peak;
            for ratio in DEFLECTIONS {
                let spring = Spring { middle: 0.5 * travel - launch.peak, deflection: ratio * travel };
                let end = launch.impact(&spring).expect("lands");
                assert!((launch.at(&spring, 0.0).0 - launch.height).abs() < 1e-12);
                for share in [0.1, 0.5, 0.9] {
                    let time = share * end.duration;
                    let height = |by: f64| launch.at(&spring, time + by);
                    let ((before, _), (here, velocity), (after, _)) =
                        (height(-SMALL), height(0.0), height(SMALL));
                    let preload = 1.0 + (here - spring.middle) / spring.deflection;
                    let rounding = 1e-14 * travel / (SMALL * SMALL);
                    assert!(
                        ((after - 2.0 * here + before) / (SMALL * SMALL) + preload).abs() < 1e-6 + rounding
                    );
                    assert!(((after - before) / (2.0 * SMALL) - velocity).abs() < 1e-6 + rounding);
                    assert!(here > launch.platform(time));
                }
            }
        }
    }

    #[test]
    fn a_very_soft_spring_presses_like_the_constant_preload_of_the_engine() {
        for (launch, constant) in motors() {
            let spring = Spring { middle: launch.height, deflection: 1e16 };
            let there = launch.impact(&spring).expect("lands");
            assert!((there.duration - constant.duration).abs() < 1e-6, "{there:?} {constant:?}");
            assert!((there.velocity / constant.velocity - 1.0).abs() < 1e-8, "{there:?} {constant:?}");
        }
    }
}
