//! The computation of Fig. 9.

use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::{
    BrakingRotor, DiskParameters, Engine, Event, InitialCondition, PlatformParameters, Spread, System, Trajectory,
};

use super::data::{Curve, Fig09Data};
use crate::experiment::ExperimentError;
use crate::figures::motor_case::MotorCase;
use crate::figures::regression::StraightLine;
use crate::figures::synthetic::Noise;
use crate::paper;
use crate::progress::Progress;

/// Preloads of the model and of the synthetic record, evenly over the range of Sec. V B; the record is made up.
const PRELOADS: u32 = 9;
const SYNTHETIC: u32 = 25;
pub(super) const SEED: u64 = 9;

/// Speeds of a curve that the line is fitted to.
const SAMPLES: usize = 60;

pub(super) fn compute(progress: &dyn Progress) -> Result<Fig09Data, ExperimentError> {
    progress.start(u64::from(PRELOADS), "preloads");
    let section = paper::section_five()?;
    let case = MotorCase::default_of(&paper::table_three()?, &section);
    let [lowest, highest] = paper::preloads()?.measured_range_n;
    let rotor_mass_kg = section.rotor_mass_kg();
    let first_speed_rad_per_s = case.peak_angular_speed_rad_per_s;
    let share = |k: u32, count: u32| f64::from(k) / f64::from(count - 1);
    let curves = (0..PRELOADS)
        .map(|k| {
            let preload = lowest + share(k, PRELOADS) * (highest - lowest);
            progress.advance(1);
            curve(&case, rotor_mass_kg, preload, first_speed_rad_per_s)
        })
        .collect::<Result<Vec<_>, _>>()?;
    let printed_mean = paper::value("section5.mean_friction")?;
    let printed_deviation = paper::value("section5.friction_deviation")?;
    let mut noise = Noise::new(SEED);
    let synthetic: Vec<(f64, f64)> = (0..SYNTHETIC)
        .map(|k| {
            let friction = noise.log_normal(printed_mean, printed_deviation);
            (lowest + share(k, SYNTHETIC) * (highest - lowest), friction)
        })
        .collect();
    let frictions: Vec<f64> = synthetic.iter().map(|point| point.1).collect();
    let line = StraightLine::through(&synthetic);
    Ok(Fig09Data {
        case,
        rotor_mass_kg,
        first_speed_rad_per_s,
        curves,
        printed_mean,
        printed_deviation,
        synthetic_spread: Spread::of(&frictions)?,
        synthetic_slope_per_n: line.map_or(0.0, |line| line.slope),
        synthetic_slope_error_per_n: line.map_or(0.0, |line| line.slope_error),
        synthetic,
        measured_decelerations: Vec::new(),
        measured_frictions: Vec::new(),
        measured_words: String::new(),
    })
}

fn still_system(case: &MotorCase, preload_acceleration: f64) -> Result<System, ExperimentError> {
    let platform = PlatformParameters {
        amplitude: 0.0,
        twist_amplitude: 0.0,
        angular_frequency: std::f64::consts::TAU * case.frequency_hz,
        phase_lag: 0.0,
    };
    let disk = DiskParameters {
        contact_radius: case.contact_radius_m,
        gyration_radius: case.gyration_radius_m,
        friction: case.friction,
        restitution: case.restitution,
        preload_acceleration,
        load_acceleration: 0.0,
    };
    let platform = platform.build()?;
    Ok(System::new(platform, disk.build()?)?)
}

/// The rotor on the still stator from `first_speed` to rest.
fn curve(case: &MotorCase, mass: f64, preload_n: f64, first_speed: f64) -> Result<Curve, ExperimentError> {
    let system = still_system(case, preload_n / mass)?;
    let scales = system.scales();
    let phase = Phase::new(0.0)?;
    let start = InitialCondition::Contact { phase, angular_speed: first_speed / scales.angular_speed };
    let mut engine = Engine::new(system, start, ChatterPolicy::Complete)?;
    let braked = Trajectory::record(&mut engine, |record| record.event == Event::SlipToStick)?;
    let points: Vec<(f64, f64)> = braked
        .uniform(SAMPLES)
        .map(|snapshot| (scales.time_seconds(snapshot.time), scales.state(&snapshot.disk).angular_speed))
        .collect();
    let line = StraightLine::through(&points);
    let (slope, intercept) = line.map_or((f64::NAN, f64::NAN), |line| (line.slope, line.intercept));
    let rotor = BrakingRotor {
        normal_force: preload_n,
        mass,
        contact_radius: case.contact_radius_m,
        gyration_radius: case.gyration_radius_m,
    };
    let friction = rotor.friction(slope)?;
    Ok(Curve {
        preload_n,
        time_s: points.iter().map(|point| point.0).collect(),
        angular_speed_rad_per_s: points.iter().map(|point| point.1).collect(),
        brake_rad_per_s2: slope,
        stop_s: -intercept / slope,
        friction,
    })
}
