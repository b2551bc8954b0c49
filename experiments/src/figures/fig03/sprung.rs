//! A rotor on a spring instead of under a constant preload (Sec. I).
//!
//! A spring that is compressed by δl_0 at the middle of the rotor's travel presses with g (1 + (x − x_middle)/δl_0). A
//! flight on it has a closed form: a piece of an oscillation with the frequency sqrt(g/δl_0).

use std::convert::Infallible;
use std::f64::consts::{PI, TAU};

use bouncing_disk::core::numerics::elementary::{asin, sin, sin_cos};
use bouncing_disk::core::numerics::roots::bisection;
use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::motion::EventKind;
use bouncing_disk::toss::TOSS_START;
use bouncing_disk::{Engine, InitialCondition, System};
use serde::Serialize;

use crate::experiment::ExperimentError;
use crate::figures::shared::motor::MotorCase;

/// A spring that is compressed by so many times the rotor's travel is compressed by "much more" than it: the preload changes
/// by a hundredth from end to end.
pub(super) const MUCH_GREATER: f64 = 100.0;
/// Steps of a period in which the impact of a flight on a spring is looked for.
const STEPS: f64 = 256.0;

/// A motor of Table III with an amplitude, and the first flight of its rotor from rest with such a spring against that under
/// constant preload.
#[derive(Debug, Serialize)]
pub(super) struct SprungMotor {
    pub(super) amplitude_m: f64,
    /// Events of the motion from rest under constant preload in which the highest point was looked for.
    events: usize,
    /// From the stator's lowest point to the rotor's highest.
    pub(super) travel_m: f64,
    deflection_m: f64,
    /// Duration with the spring over that without, minus 1; then the same for the speed of the fall at the impact.
    pub(super) duration_change: f64,
    pub(super) fall_speed_change: f64,
    /// How much later in the stator's motion the impact comes, in periods.
    impact_shift_cycles: f64,
}

/// A flight in the units of the engine: heights are above the platform's mean, gravity is 1.
#[derive(Clone, Copy, Debug)]
struct Flight {
    peak: f64,
    height: f64,
    velocity: f64,
    /// Duration, and velocity at the impact, under constant preload.
    constant: (f64, f64),
}

/// The middle of the travel and the static deflection, in the same units.
type Spring = (f64, f64);

impl Flight {
    /// The first flight of a rotor at rest, and the highest point of so many events.
    fn first(system: &System, events: usize) -> Result<(Self, f64), ExperimentError> {
        let start = InitialCondition::Contact { phase: Phase::new(TOSS_START)?, angular_speed: 0.0 };
        let peak = system.peak_acceleration();
        let (mut launch, mut first, mut highest) = (None, None, peak);
        for record in Engine::new(*system, start, ChatterPolicy::Complete)?.take(events) {
            let record = record?;
            let (height, velocity) = (record.after.height, record.after.axial_velocity);
            if velocity > 0.0 {
                highest = highest.max(height + 0.5 * velocity * velocity);
            }
            let constant = (record.span.radians(), record.before.axial_velocity);
            match record.event.kind() {
                EventKind::Separation => launch = Some((height, velocity)),
                EventKind::Impact => {
                    let flight = |(height, velocity)| Self { peak, height, velocity, constant };
                    first = first.or(launch.map(flight));
                }
                _ => {}
            }
        }
        let never = bouncing_disk::Error::NeverLeaves { peak_acceleration: peak };
        first.map(|flight| (flight, highest)).ok_or_else(|| ExperimentError::model(never))
    }

    fn platform(&self, time: f64) -> f64 {
        self.peak * sin(asin(1.0 / self.peak) + time)
    }

    /// Height and velocity a time after the launch.
    fn at(&self, (middle, deflection): Spring, time: f64) -> (f64, f64) {
        let rate = 1.0 / deflection.sqrt();
        let (sine, cosine) = sin_cos(rate * time);
        let half = sin(0.5 * rate * time);
        // The rotor swings about the height at which the spring would be relaxed.
        let reach = self.height - middle + deflection;
        let height = self.height - 2.0 * reach * half * half + self.velocity / rate * sine;
        (height, self.velocity * cosine - reach * rate * sine)
    }

    /// Duration and velocity at the impact with a spring; `None` if there is none in half a swing, in which every flight
    /// ends.
    fn impact(&self, spring: Spring) -> Option<(f64, f64)> {
        let step = TAU / STEPS;
        let flies = |time: f64| self.at(spring, time).0 - self.platform(time) > 0.0;
        let mut low = step;
        while flies(low + step) {
            low += step;
            if low > PI * spring.1.sqrt() {
                return None;
            }
        }
        // Down to the last place of the time.
        let Ok(duration) = bisection(low, low + step, 60, |time| Ok::<_, Infallible>(flies(time)));
        Some((duration, self.at(spring, duration).1))
    }
}

impl SprungMotor {
    pub(super) fn new(case: &MotorCase, events: usize) -> Result<Self, ExperimentError> {
        let system = case.system()?;
        let (flight, highest) = Flight::first(&system, events)?;
        let low = -flight.peak;
        let travel = highest - low;
        let travel_m = travel * system.scales().length;
        let never = bouncing_disk::Error::NeverLeaves { peak_acceleration: flight.peak };
        let end = flight.impact((0.5 * (low + highest), MUCH_GREATER * travel));
        let (duration, velocity) = end.ok_or_else(|| ExperimentError::model(never))?;
        Ok(Self {
            amplitude_m: case.amplitude_m,
            events,
            travel_m,
            deflection_m: MUCH_GREATER * travel_m,
            duration_change: duration / flight.constant.0 - 1.0,
            fall_speed_change: velocity / flight.constant.1 - 1.0,
            impact_shift_cycles: (duration - flight.constant.0) / TAU,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flight_on_a_spring_obeys_its_equation_of_motion_and_a_soft_one_presses_like_the_constant_preload() {
        const SMALL: f64 = 1e-3;
        let system = MotorCase::table_three().expect("reads").system().expect("legal");
        let (flight, highest) = Flight::first(&system, 100).expect("flies");
        let spring = (0.5 * (highest - flight.peak), 10.0 * (highest + flight.peak));
        let (duration, _) = flight.impact(spring).expect("lands");
        assert!((flight.at(spring, 0.0).0 - flight.height).abs() < 1e-12);
        for time in [0.1, 0.5, 0.9].map(|share| share * duration) {
            let [before, here, after] = [-SMALL, 0.0, SMALL].map(|by| flight.at(spring, time + by));
            let preload = 1.0 + (here.0 - spring.0) / spring.1;
            assert!(((after.0 - before.0) / (2.0 * SMALL) - here.1).abs() < 1e-6);
            assert!(((after.1 - before.1) / (2.0 * SMALL) + preload).abs() < 1e-6);
            assert!(here.0 > flight.platform(time));
        }
        let soft = flight.impact((flight.height, 1e16)).expect("lands");
        assert!((soft.0 - flight.constant.0).abs() < 1e-6);
        assert!((soft.1 / flight.constant.1 - 1.0).abs() < 1e-8);
    }
}
