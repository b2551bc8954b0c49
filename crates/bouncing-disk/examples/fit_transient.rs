//! Steady speed and time constant of a motor from curves that scatter, with their uncertainties.
//!
//!     cargo run --release -p bouncing-disk --example fit_transient
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use bouncing_disk::System;
use bouncing_disk::core::Unobserved;
use bouncing_disk::estimate::{FitError, FitSettings, MeasuredRun, MeasuredSpeeds, TransientEnsemble};
use bouncing_disk::motor::TransientSettings;

fn main() -> Result<(), FitError> {
    // Synthetic measurements: ten simulated runs of the motor of Table III take the place of recorded ones.
    // With the feature `csv`, `MeasuredSpeeds::from_csv` reads recorded ones from a file.
    let settings = TransientSettings { duration: 6.0, intervals: 120, ..TransientSettings::default() };
    let synthetic = TransientEnsemble::new(&System::motor(), &settings, 10, &Unobserved)?.curves;
    let runs: Vec<MeasuredRun> = synthetic
        .into_iter()
        .zip(1..)
        .map(|(curve, member)| MeasuredRun { member, times: curve.times, speeds: curve.speeds })
        .collect();

    // The fit is to the mean over the runs; their scatter gives the 95 % intervals.
    let fit = MeasuredSpeeds::new(runs.clone())?.fit(&FitSettings::default(), &Unobserved)?;
    println!("steady speed {:.3} rad/s", fit.steady_speed());
    println!("time constant {:.3} s", fit.time_constant());
    println!("stall acceleration, as the paper estimates it, {:.3} rad/s^2", fit.stall_acceleration());

    // The first 0.9 s alone do not determine them, and the fit says so.
    let short = runs.into_iter().map(|mut run| {
        run.times.truncate(18);
        run.speeds.truncate(18);
        run
    });
    match MeasuredSpeeds::new(short.collect())?.fit(&FitSettings::default(), &Unobserved) {
        Ok(fit) => println!("time constant {:.3} s", fit.time_constant()),
        Err(error) => println!("{error}"),
    }
    Ok(())
}
