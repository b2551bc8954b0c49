use std::time::Instant;

use bouncing_disk_core::Phase;
use bouncing_disk_core::numerics::random::SplitMix64;

use super::measured_transient::RunPreload;
use super::*;
use crate::motor::measured_speeds::{MeasuredRun, MeasuredSpeeds};
use crate::motor::transient::{TransientSettings, transient};
use crate::testing::Noise;

/// Synthetic: a run of this motor at a preload, from a random phase, with independent errors of its speeds.
fn synthetic(motor: &Motor, acceleration: f64, duration: f64, error: f64, seed: u64) -> MeasuredTransient {
    let mut generator = SplitMix64::new(seed);
    let phase = Phase::new(6.28 * generator.unit()).expect("legal");
    let settings = TransientSettings {
        duration,
        intervals: 200,
        seed: generator.next_number(),
        ..TransientSettings::default()
    };
    let preload = RunPreload::Acceleration(acceleration);
    let motor = motor.with(|sheet| sheet.preload_acceleration = Some(acceleration)).expect("legal");
    let curve = transient(motor.system(), phase, &settings).expect("no failure");
    let mut noise = Noise::new(seed ^ 0xABCD);
    let speeds = curve.speeds.iter().map(|speed| speed + error * noise.normal()).collect();
    let run = MeasuredRun { member: 0, times: curve.times, speeds };
    MeasuredTransient { preload, runs: MeasuredSpeeds::new(vec![run]).expect("legal"), speed_error: Some(error) }
}

const FRICTION: ParameterRange = ParameterRange { parameter: FitParameter::Friction, low: 0.05, high: 1.0 };
const TWIST: ParameterRange =
    ParameterRange { parameter: FitParameter::TwistAmplitude, low: 2e-5, high: 2e-4 };
const LAG: ParameterRange = ParameterRange { parameter: FitParameter::PhaseLag, low: -0.8, high: 0.8 };
const RESTITUTION: ParameterRange = ParameterRange { parameter: FitParameter::Restitution, low: 0.2, high: 0.8 };
const AMPLITUDE: ParameterRange = ParameterRange { parameter: FitParameter::Amplitude, low: 3e-9, high: 3e-8 };

#[test]
fn scratch() {
    let sheet = Motor::paper_70_khz();
    println!("{sheet} phi {}", FitParameter::TwistAmplitude.of(&sheet));
    let built = sheet.with(|sheet| sheet.friction = 0.2).expect("legal");
    for (ranges, preloads) in [
        (vec![FRICTION], vec![9.8]),
        (vec![FRICTION, TWIST], vec![5.0, 9.8, 15.0]),
        (vec![FRICTION, TWIST, LAG], vec![9.8]),
        (vec![FRICTION, RESTITUTION], vec![5.0, 9.8, 15.0]),
        (vec![FRICTION, AMPLITUDE], vec![5.0, 9.8, 15.0]),
        (vec![FRICTION, TWIST, LAG, RESTITUTION, AMPLITUDE], vec![5.0, 9.8, 15.0]),
    ] {
        for duration in [0.8] {
            let runs: Vec<_> =
                preloads.iter().zip(1..).map(|(&g, seed)| synthetic(&built, g, duration, 0.2, seed)).collect();
            let began = Instant::now();
            let fit = ParameterFit::new(&sheet, &runs, &ranges, &ParameterFitSettings::default());
            println!("{duration} {preloads:?} {:?}", began.elapsed());
            match fit {
                Err(error) => println!("    {error}"),
                Ok(fit) => {
                    println!("    misfit {} of {}, {} evaluations", fit.misfit, fit.degrees_of_freedom, fit.evaluations);
                    fit.parameters.iter().for_each(|one| println!("    {one:?}"));
                    fit.undetermined.iter().for_each(|one| println!("    {one:?}"));
                }
            }
        }
    }
}
