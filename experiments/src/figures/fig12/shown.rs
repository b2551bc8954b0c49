//! A motor whose transient is drawn: its flights, the two fits, what the impulses of a cycle predict, and a short part of its rise.

use std::f64::consts::PI;

use bouncing_disk::core::{ChatterPolicy, Launch, OrbitEvent, Phase, Unobserved};
use bouncing_disk::estimate::{ExponentialFit, RampFit};
use bouncing_disk::motor::{NormalImpulses, TransientSettings, transient};
use bouncing_disk::toss::{CollisionEvent, Collisions, LONG_FLIGHT};
use bouncing_disk::{Engine, Event, InitialCondition, Trajectory};
use serde::Serialize;

use crate::experiment::ExperimentError;
use crate::figures::shared::motor::{Cycle, LOW_PERIOD_FLIGHTS, MotorCase, RobustCycle};
use crate::figures::shared::numbers::StraightLine;

/// Relative distance of the amplitudes that are tried: a fraction of the width of a robust cycle of two
/// flights.
const AMPLITUDE_STEP: f64 = 1e-9;
/// Largest number of amplitudes tried on each side.
const MOST_STEPS: u32 = 40_000;
/// Duration drawn, in rise times ωΦ a_g²/(μ a_e g).
pub(super) const LONG_RISES: f64 = 6.0;
/// Duration drawn of the low-period case, in predicted times to the steady speed.
const LOW_RISES: f64 = 1.6;
/// Impulses for the prediction of a long cycle.
const IMPULSES: usize = 20_000;
/// Samples of a zoom, and its flights.
const ZOOM_SAMPLES: usize = 1_500;
const ZOOM_FLIGHTS: usize = 12;
/// Cycles of low period whose flights are drawn: enough to show their lines.
const LINE_CYCLES: usize = 10;
/// The first slope is that of this share of the rise.
const FIRST_PART: f64 = 0.1;
/// The zoom starts at this share of the time to the steady speed; of the long-period case, of the rise time.
const ZOOM_AT: f64 = 0.5;
/// The speed has reached its last value when it differs from it by this share.
const REACHED_WITHIN: f64 = 0.02;

/// A motor whose transient is drawn. Nothing perturbs it.
#[derive(Serialize)]
pub(super) struct Shown {
    pub(super) motor: MotorCase,
    /// Amplitude over the printed one minus 1.
    pub(super) amplitude_offset: f64,
    pub(super) axial_forcing: f64,
    /// Its cycle, if rounding does not choose it.
    pub(super) robust_cycle: Option<RobustCycle>,
    pub(super) duration_s: f64,
    /// Each flight longer than half a period: its start and the speed during it.
    pub(super) flight_time_s: Vec<f64>,
    pub(super) flight_speed_rad_per_s: Vec<f64>,
    /// The same motor averaged over equal intervals, and its fits.
    pub(super) fits: Fits,
    /// The prediction from the impulses of one cycle.
    pub(super) prediction: Prediction,
    pub(super) zoom: Zoom,
}

/// The two forms fitted to the same curve.
#[derive(Serialize)]
pub(super) struct Fits {
    pub(super) exponential: ExponentialFit,
    pub(super) ramp_residual_rad_per_s: f64,
    /// Mean over the last fifth.
    pub(super) last_speed_rad_per_s: f64,
    /// Straight line through the whole of the rise, and its largest distance from the curve.
    pub(super) slope_rad_per_s2: f64,
    pub(super) farthest_from_line_rad_per_s: f64,
    /// Straight line through the first tenth of the rise.
    pub(super) first_slope_rad_per_s2: f64,
    /// First time at which the speed is within 2 % of the last one.
    pub(super) reached_s: Option<f64>,
}

/// Straight pieces from the impulses of one cycle.
#[derive(Serialize)]
pub(super) struct Prediction {
    /// μ a_e g/a_g² S(0), S(0) the net share of the normal impulse that pushes a slow rotor forwards.
    pub(super) slope_rad_per_s2: f64,
    pub(super) steady_speed_rad_per_s: f64,
    /// When the pieces reach it.
    pub(super) reached_s: f64,
    pub(super) time_s: Vec<f64>,
    pub(super) speed_rad_per_s: Vec<f64>,
}

/// A short part of the rise. Of the low-period case the flights of many cycles, which form its lines.
#[derive(Serialize)]
pub(super) struct Zoom {
    pub(super) time_s: Vec<f64>,
    pub(super) speed_rad_per_s: Vec<f64>,
    pub(super) height_m: Vec<f64>,
    /// Flights of many cycles: their starts and speeds.
    pub(super) flight_time_s: Vec<f64>,
    pub(super) flight_speed_rad_per_s: Vec<f64>,
}

/// The flights of the motor from rest that are longer than half a period, at most so many and for so long: their starts (s) and the
/// speed (rad/s) during each.
pub(super) fn flown(
    motor: &MotorCase,
    flights: usize,
    duration_s: f64,
) -> Result<(Vec<f64>, Vec<f64>), ExperimentError> {
    let system = motor.system()?;
    let scales = system.scales();
    let mut collisions = Collisions::new(system, start()?, ChatterPolicy::Complete)?;
    let (mut times, mut speeds) = (Vec::new(), Vec::new());
    let mut last = None;
    while times.len() < flights
        && let Some(event) = collisions.advance()?
    {
        let time = match event {
            CollisionEvent::Collision(collision) => {
                let long = |from| collision.time.since(&from).radians() > LONG_FLIGHT;
                if let Some(from) = last.filter(|from| long(*from)) {
                    times.push(scales.time_seconds(from));
                    speeds.push(scales.angular_speed * collision.angular_speed);
                }
                collision.time
            }
            CollisionEvent::Attachment { time, .. } | CollisionEvent::Separation { time, .. } => time,
            _ => continue,
        };
        last = Some(time);
        if scales.time_seconds(time) > duration_s {
            break;
        }
    }
    Ok((times, speeds))
}

/// Whether the rotor, thrown from rest, is at rest again after two flights or a few.
fn is_short(motor: &MotorCase) -> Result<bool, ExperimentError> {
    let system = motor.system()?;
    let map = system.dimensionless().map();
    let Some(leaves) = map.vibration().separation_phase() else { return Ok(false) };
    let launch = Launch::new(leaves, 0.0)?;
    let mut orbit = map.orbit_from_launch(launch, ChatterPolicy::Complete);
    let mut flights = 0;
    while flights <= LOW_PERIOD_FLIGHTS {
        match orbit.advance()? {
            Some(OrbitEvent::Impact(impact)) => {
                flights += usize::from(impact.periods > 0 || impact.remainder > LONG_FLIGHT);
            }
            Some(OrbitEvent::Attachment(_)) => return Ok(flights > 1),
            _ => break,
        }
    }
    Ok(false)
}

/// The motor at the amplitude nearest to that of `case` whose unperturbed motion is a robust low-period cycle
/// of more than one flight.
pub(super) fn nearest_low_period(case: &MotorCase) -> Result<MotorCase, ExperimentError> {
    for step in 0..MOST_STEPS {
        for sign in [1.0, -1.0] {
            let amplitude_m = case.amplitude_m * (1.0 + AMPLITUDE_STEP * (sign * f64::from(step)));
            let near = MotorCase { amplitude_m, ..*case };
            if is_short(&near)? && near.robust_cycle()?.is_some() {
                return Ok(near);
            }
        }
    }
    Err(ExperimentError::NoData { quantity: "robust low-period cycle".to_owned() })
}

/// A rotor at rest on the stator at its lowest point.
fn start() -> Result<InitialCondition, ExperimentError> {
    Ok(InitialCondition::Contact { phase: Phase::new(1.5 * PI)?, angular_speed: 0.0 })
}

pub(super) fn shown(motor: MotorCase, printed_amplitude: f64) -> Result<Shown, ExperimentError> {
    let system = motor.system()?;
    let cycle = motor.cycle(ChatterPolicy::Complete)?;
    let low = cycle.is_low_period();
    let prediction = predict(&motor, low)?;
    let duration_s = if low { LOW_RISES * prediction.reached_s } else { LONG_RISES * motor.rise_time_s() };

    let (flight_time_s, flight_speed_rad_per_s) = flown(&motor, usize::MAX, duration_s)?;
    Ok(Shown {
        amplitude_offset: motor.amplitude_m / printed_amplitude - 1.0,
        axial_forcing: system.axial_forcing(),
        robust_cycle: motor.robust_cycle()?,
        duration_s,
        fits: fits(&motor, duration_s)?,
        zoom: zoom(
            &motor,
            cycle,
            ZOOM_AT * if low { prediction.reached_s } else { motor.rise_time_s() },
            (&flight_time_s, &flight_speed_rad_per_s),
        )?,
        flight_time_s,
        flight_speed_rad_per_s,
        prediction,
        motor,
    })
}

fn fits(motor: &MotorCase, duration: f64) -> Result<Fits, ExperimentError> {
    let settings = TransientSettings {
        duration,
        intervals: 400,
        relaunch_perturbation: 0.0,
        ..TransientSettings::default()
    };
    let phase = Phase::new(1.5 * PI)?;
    let curve = transient(&motor.system()?, phase, &settings, &Unobserved)?;
    let last = curve.mean_over_last(0.2)?;
    let points = || curve.times.iter().copied().zip(curve.speeds.iter().copied());
    let reached_s = points().find(|(_, speed)| (speed - last).abs() <= REACHED_WITHIN * last.abs());
    let reached_s = reached_s.map(|point| point.0);
    let until = |share: f64| {
        let end = share * reached_s.unwrap_or(duration);
        points().take_while(|(time, _)| *time < end).collect::<Vec<(f64, f64)>>()
    };
    let rise = until(1.0);
    let line = StraightLine::through(&rise);
    let first = StraightLine::through(&until(FIRST_PART));
    let farthest = |line: StraightLine| {
        let off = rise.iter().map(|(time, speed)| (speed - line.intercept - line.slope * time).abs());
        off.fold(0.0, f64::max)
    };
    Ok(Fits {
        exponential: curve.fit()?,
        ramp_residual_rad_per_s: RampFit::new(&curve.times, &curve.speeds)?.residual,
        last_speed_rad_per_s: last,
        slope_rad_per_s2: line.map_or(0.0, |line| line.slope),
        farthest_from_line_rad_per_s: line.map_or(0.0, farthest),
        first_slope_rad_per_s2: first.map_or(0.0, |line| line.slope),
        reached_s,
    })
}

fn predict(motor: &MotorCase, low_period: bool) -> Result<Prediction, ExperimentError> {
    let system = motor.system()?;
    let impulses =
        NormalImpulses::of(system.dimensionless().map(), if low_period { 1 } else { IMPULSES }, 0.0)?;
    let levels = impulses.balance(motor.phase_lag_rad);
    let (rise, top) = (motor.rise_time_s(), motor.peak_angular_speed_rad_per_s);
    let steady = levels.steady_speed();
    let (times, speeds) = levels.transient(LONG_RISES, 6_000);
    let reached = times.iter().zip(&speeds).find(|(_, speed)| **speed >= (1.0 - REACHED_WITHIN) * steady);
    let thin = |values: &[f64], unit: f64| values.iter().step_by(20).map(|value| unit * value).collect();
    Ok(Prediction {
        slope_rad_per_s2: motor.largest_acceleration() * levels.net_share(0.0),
        steady_speed_rad_per_s: top * steady,
        reached_s: rise * reached.map_or(LONG_RISES, |(time, _)| *time),
        time_s: thin(&times, rise),
        speed_rad_per_s: thin(&speeds, top),
    })
}

/// Speed and height from the first separation after `from_s` on.
fn zoom(
    motor: &MotorCase,
    cycle: Cycle,
    from_s: f64,
    flown: (&[f64], &[f64]),
) -> Result<Zoom, ExperimentError> {
    let system = motor.system()?;
    let scales = system.scales();
    let mut engine = Engine::new(system, start()?, ChatterPolicy::Complete)?;
    let mut started = false;
    while let Some(record) = engine.advance()? {
        started = scales.time_seconds(record.time) >= from_s;
        if started && record.event == Event::Separation {
            break;
        }
    }
    // Three cycles of low period, else a number of flights.
    let low = cycle.flights().filter(|_| cycle.is_low_period());
    let flights = low.map_or(ZOOM_FLIGHTS, |flights| 3 * flights);
    let mut seen = 0;
    let record = Trajectory::record(&mut engine, |record| {
        let flight = matches!(record.event, Event::Impact { .. });
        seen += usize::from(flight && record.span.radians() > PI);
        seen >= flights && (low.is_none() || record.event == Event::Separation)
    })?;
    let first = flown.0.partition_point(|time| *time < from_s);
    let many = LINE_CYCLES * cycle.flights().filter(|_| cycle.is_low_period()).unwrap_or_default();
    let of_lines = |values: &[f64]| values.iter().skip(first).take(many).copied().collect();
    let mut zoom = Zoom {
        time_s: Vec::new(),
        speed_rad_per_s: Vec::new(),
        height_m: Vec::new(),
        flight_time_s: of_lines(flown.0),
        flight_speed_rad_per_s: of_lines(flown.1),
    };
    if !started {
        return Ok(zoom);
    }
    for snapshot in record.uniform(ZOOM_SAMPLES) {
        let state = scales.state(&snapshot.disk);
        zoom.time_s.push(scales.time_seconds(snapshot.time));
        zoom.speed_rad_per_s.push(state.angular_speed);
        zoom.height_m.push(state.height);
    }
    Ok(zoom)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::paper;

    /// Of what is drawn in (d) to (f) no change of the inputs by some units in the last place alters
    /// anything; of the printed amplitude it does.
    #[test]
    fn the_low_period_case_that_is_drawn_is_not_chosen_by_rounding() {
        let cases = paper::chattering_cases().expect("reads");
        let motor = MotorCase::table_three().expect("reads");
        let printed = MotorCase {
            amplitude_m: cases.amplitudes_m[1],
            preload_acceleration_m_per_s2: cases.preload_accelerations_m_per_s2[1],
            ..motor
        };
        assert_eq!(printed.robust_cycle().expect("runs"), None);
        let drawn = nearest_low_period(&printed).expect("there is one");
        let robust = drawn.robust_cycle().expect("runs").expect("robust").cycle();
        assert!(robust.is_low_period() && robust.flights() > Some(1), "{robust:?}");
        let off = (drawn.amplitude_m / printed.amplitude_m - 1.0).abs();
        assert!(off < 1.5e-5, "{off}: {robust:?}");
    }
}
