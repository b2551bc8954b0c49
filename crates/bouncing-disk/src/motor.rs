//! The ultrasonic motor: ensembles of speed transients, and their fits (Sec. V).
//!
//! After every rest the disk leaves the platform in exactly the same vertical state, so the orbit of an ideal motor
//! falls onto a cycle that the rounding of the program has chosen. A speed, a torque or a time constant is therefore
//! the mean over an ensemble whose relaunches are perturbed by a seeded, small relative velocity and whose members
//! start at different phases; a single transient is a picture of one member.

use std::f64::consts::TAU;

use bouncing_disk_core::Phase;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::fit::ExponentialFit;
use crate::system::System;
use crate::transient::{SpeedCurve, SplitMix, TransientSettings};
use crate::transients::{TransientMember, transients};

/// A mean over the members of an ensemble, with its spread.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// Standard deviation of the members (with n - 1).
    pub deviation: f64,
    /// Standard error of the mean.
    pub standard_error: f64,
}

impl Spread {
    /// Of at least one value.
    #[must_use]
    pub fn of(values: &[f64]) -> Self {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares = values.iter().fold(0.0, |sum, value| sum + (value - mean) * (value - mean));
        let deviation = if n > 1.0 { (squares / (n - 1.0)).sqrt() } else { 0.0 };
        Self { mean, deviation, standard_error: deviation / n.sqrt() }
    }
}

/// An ensemble of transients of one motor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Ensemble {
    /// The curve of each member.
    pub curves: Vec<SpeedCurve>,
    /// The fit of each member.
    pub fits: Vec<ExponentialFit>,
    /// Steady speed alpha_ss (rad/s).
    pub steady_speed: Spread,
    /// Time constant t_c (s).
    pub time_constant: Spread,
    /// Stall acceleration alpha_ss/t_c (rad/s^2).
    pub stall_acceleration: Spread,
}

/// Computes `members` >= 1 transients with starting phases spread evenly over the cycle and seeds counted up from
/// `settings.seed`. The result is the same for any number of threads.
///
/// # Errors
/// [`Error::OutOfRange`] for no member or illegal settings; the errors of [`transient`](crate::transient()).
pub fn ensemble(system: &System, settings: &TransientSettings, members: usize) -> Result<Ensemble, Error> {
    settings.check()?;
    if members == 0 {
        return Err(Error::OutOfRange { field: "members", value: 0.0, legal: "[1, inf)" });
    }
    let member = |index: usize| -> Result<TransientMember, Error> {
        // Half a step off zero, so that no member starts on a phase that is special.
        let phase = Phase::new(TAU * (index as f64 + 0.5) / members as f64)?;
        let seed = SplitMix(settings.seed.wrapping_add(index as u64)).next();
        Ok(TransientMember { system: *system, phase, settings: TransientSettings { seed, ..*settings } })
    };
    let runs = transients(&(0..members).map(member).collect::<Result<Vec<_>, _>>()?);
    let fitted = |curve: Result<SpeedCurve, Error>| -> Result<(SpeedCurve, ExponentialFit), Error> {
        let curve = curve?;
        let fit = curve.fit()?;
        Ok((curve, fit))
    };
    #[cfg(feature = "parallel")]
    let results: Vec<_> = {
        use rayon::prelude::*;
        runs.into_par_iter().map(fitted).collect()
    };
    #[cfg(not(feature = "parallel"))]
    let results: Vec<_> = runs.into_iter().map(fitted).collect();
    let mut curves = Vec::with_capacity(members);
    let mut fits = Vec::with_capacity(members);
    for result in results {
        let (curve, fit) = result?;
        curves.push(curve);
        fits.push(fit);
    }
    let of = |value: fn(&ExponentialFit) -> f64| Spread::of(&fits.iter().map(value).collect::<Vec<_>>());
    Ok(Ensemble {
        steady_speed: of(|fit| fit.steady_speed),
        time_constant: of(|fit| fit.time_constant),
        stall_acceleration: of(ExponentialFit::stall_acceleration),
        curves,
        fits,
    })
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::ChatterPolicy;

    use super::*;
    use crate::rotor::{Rotor, RotorStep};
    use crate::{DiskParameters, Engine, PlatformParameters, Start};

    /// The motor of Table III.
    fn motor(amplitude: f64, load_acceleration: f64) -> System {
        let omega = TAU * 70e3;
        let platform = PlatformParameters {
            amplitude,
            twist_amplitude: 30.0 / omega,
            angular_frequency: omega,
            phase_lag: 0.0,
        };
        let disk = DiskParameters {
            contact_radius: 1.25e-3,
            gyration_radius: 6.3e-3,
            friction: 0.1,
            restitution: 0.5,
            preload_acceleration: 9.8,
            load_acceleration,
        };
        System::new(platform.build().expect("legal"), disk.build().expect("legal")).expect("legal")
    }

    #[test]
    fn a_spread_is_that_of_a_sample() {
        let spread = Spread::of(&[2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0]);
        assert!((spread.mean - 5.0).abs() < 1e-15);
        assert!((spread.deviation - (32.0_f64 / 7.0).sqrt()).abs() < 1e-15);
        assert!((spread.standard_error - (4.0_f64 / 7.0).sqrt()).abs() < 1e-15);
        // Of one value nothing is known but itself.
        let one = Spread { mean: -3.0, deviation: 0.0, standard_error: 0.0 };
        assert_eq!(Spread::of(&[-3.0]), one);
    }

    /// What the documentation says: neither the cycle of the rounding nor a visible kick.
    #[test]
    fn relaunches_are_perturbed_by_a_thousandth_unless_told_otherwise() {
        assert!((TransientSettings::default().relaunch_perturbation - 1e-3).abs() < 1e-18);
    }

    /// Phases evenly over the cycle, half a step off zero, and a stream of random numbers for each member.
    #[test]
    fn members_are_the_transients_of_their_phases_and_seeds() {
        let system = motor(1e-8, 0.0);
        let settings =
            TransientSettings { duration: 0.2, intervals: 20, seed: 40, ..TransientSettings::default() };
        let all = ensemble(&system, &settings, 4).expect("no failure");
        let seeds = [40, 41, 42, 43].map(|counted| SplitMix(counted).next());
        for (k, curve) in all.curves.iter().enumerate() {
            let phase = Phase::new(TAU / 8.0 * [1.0, 3.0, 5.0, 7.0][k]).expect("finite");
            let own = |seed: u64| {
                crate::transient(&system, phase, &TransientSettings { seed, ..settings }).expect("no failure")
            };
            assert_eq!(*curve, own(seeds[k]), "{k}");
            assert_ne!(*curve, own(seeds[k ^ 1]), "the seed matters");
            assert_eq!(all.fits[k], curve.fit().expect("legal curve"));
            // The middles of the intervals.
            for (i, time) in curve.times.iter().enumerate() {
                assert!((time - 0.005 * (2 * i + 1) as f64).abs() < 1e-15, "{i} {time}");
            }
        }
        let mean = |value: fn(&ExponentialFit) -> f64| all.fits.iter().map(value).sum::<f64>() / 4.0;
        assert!((all.steady_speed.mean - mean(|fit| fit.steady_speed)).abs() < 1e-12);
        assert!((all.time_constant.mean - mean(|fit| fit.time_constant)).abs() < 1e-12);
        let stall = mean(|fit| fit.steady_speed / fit.time_constant);
        assert!((all.stall_acceleration.mean - stall).abs() < 1e-12 * stall.abs());
    }

    #[test]
    fn rotor_follows_the_engine() {
        for (amplitude, load) in [(1e-8, 0.0), (1e-9, 5.0), (2e-11, 0.0)] {
            let system = motor(amplitude, load);
            let phase = Phase::new(4.0).expect("finite");
            let policy = ChatterPolicy::Complete;
            let mut rotor = Rotor::at_rest(system.dimensionless(), phase, 0.0, policy).expect("legal");
            let start = Start::Contact { phase, angular_speed: 0.0 };
            let mut engine = Engine::new(system, start, policy).expect("legal");
            for _ in 0..3_000 {
                let record = engine.advance().expect("no failure");
                let step = rotor.advance().expect("no failure");
                let Some(record) = record else {
                    assert_eq!(step, RotorStep::Ended);
                    break;
                };
                // The vertical motion to the bit; the speed up to the closed form of the chattering sums.
                assert_eq!(record.time, rotor.time());
                let difference = (record.after.angular_speed - rotor.speed()).abs();
                assert!(difference <= 1e-12 * system.dimensionless().twist_speed(), "{difference}");
            }
        }
    }

    /// At its lowest point the stator turns with the speed of the resting rotor, up to rounding. Friction cannot hold
    /// the rotor there, and must not seem to.
    #[test]
    fn rotor_starts_as_the_engine_at_the_lowest_point() {
        let system = motor(1e-8, 0.0);
        let policy = ChatterPolicy::Complete;
        for angle in [0.75 * TAU, 0.75 * TAU * (1.0 - f64::EPSILON), 0.75 * TAU * (1.0 + f64::EPSILON)] {
            let phase = Phase::new(angle).expect("finite");
            let mut rotor = Rotor::at_rest(system.dimensionless(), phase, 0.0, policy).expect("legal");
            while rotor.advance().expect("no failure") != RotorStep::Separation {}
            let start = Start::Contact { phase, angular_speed: 0.0 };
            let mut engine = Engine::new(system, start, policy).expect("legal");
            let record = loop {
                let record = engine.advance().expect("no failure").expect("it separates");
                if record.event == crate::Event::Separation {
                    break record;
                }
            };
            let difference = (record.after.angular_speed - rotor.speed()).abs();
            assert!(difference <= 1e-12 * system.dimensionless().twist_speed(), "{difference}");
            assert!(rotor.speed() < 0.01 * system.dimensionless().twist_speed());
        }
    }

    /// Sizes from 1e-5 to 1e-1 agree within 3 %. Smaller ones do not: the first impacts after a relaunch are then the
    /// same every time, the more of them the smaller the perturbation (docs/numerics.md).
    #[test]
    fn steady_speed_does_not_depend_on_the_size_of_the_perturbation() {
        let system = motor(1e-8, 0.0);
        let speeds: Vec<f64> = [1e-1, 1e-3, 1e-5]
            .iter()
            .map(|&relaunch_perturbation| {
                let settings = TransientSettings {
                    duration: 10.0,
                    relaunch_perturbation,
                    ..TransientSettings::default()
                };
                let runs = ensemble(&system, &settings, 16).expect("no failure");
                let means: Vec<f64> = runs.curves.iter().map(|curve| curve.mean_over_last(0.6)).collect();
                let spread = Spread::of(&means);
                assert!(spread.standard_error < 0.01 * spread.mean, "{spread:?}");
                spread.mean
            })
            .collect();
        for speed in &speeds {
            assert!((speed / speeds[1] - 1.0).abs() < 0.03, "{speeds:?}");
        }
    }

    #[test]
    fn ensemble_is_the_same_for_any_number_of_threads() {
        let system = motor(1e-8, 0.0);
        let settings = TransientSettings { duration: 0.2, intervals: 50, ..TransientSettings::default() };
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("pool");
            pool.install(|| ensemble(&system, &settings, 5)).expect("no failure")
        };
        let all = run(1);
        assert_eq!(all, run(2));
        assert_eq!(all, run(7));
        assert!(all.curves.iter().all(|curve| curve.separations > 0));
    }

    #[test]
    fn illegal_settings_are_named() {
        let system = motor(1e-8, 0.0);
        for settings in [
            TransientSettings { duration: 0.0, ..TransientSettings::default() },
            TransientSettings { duration: f64::NAN, ..TransientSettings::default() },
            TransientSettings { intervals: 2, ..TransientSettings::default() },
            TransientSettings { relaunch_perturbation: -1.0, ..TransientSettings::default() },
        ] {
            assert!(matches!(ensemble(&system, &settings, 2), Err(Error::OutOfRange { .. })));
        }
        assert!(ensemble(&system, &TransientSettings::default(), 0).is_err());
    }
}
