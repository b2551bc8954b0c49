//! The ultrasonic motor: ensembles of speed transients, and their fits (Sec. V).
//!
//! After every rest the disk leaves the platform in exactly the same vertical state, so the computed orbit of
//! an ideal motor falls onto a cycle selected by rounding. A speed, a torque or a time constant
//! is therefore a mean over an ensemble: each relaunch is perturbed by a small random relative velocity from
//! a seeded stream, and the members start at different phases. A single transient is one random sample.

use crate::display::numbers;
use bouncing_disk_core::Observer;
use bouncing_disk_core::numerics::statistics::{mean, standard_deviation};
use bouncing_disk_core::run::{Watch, WorkCount};
use std::fmt::{self, Display, Formatter};

use crate::error::{Error, check, finite, not_negative, room_for};
use crate::estimate::fit::ExponentialFit;
use crate::motor::batch::members::{MAX_MEMBERS, TransientMember};
use crate::motor::batch::transients::transients;
use crate::motor::rotor::transient::{SpeedCurve, TransientSettings};
use crate::parameters::system::System;

/// A mean over the members of an ensemble, with its spread.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// Standard deviation of the members (with divisor n - 1).
    pub deviation: f64,
    /// Standard error of the mean.
    pub standard_error: f64,
}

impl Spread {
    /// The spread of at least one value, all finite.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if there are no values, if a value is not finite, or if a double cannot represent
    /// the deviation.
    pub fn of(values: &[f64]) -> Result<Self, Error> {
        check(!values.is_empty(), "number of values", 0.0, "[1, inf)")?;
        for &value in values {
            finite("value of a spread", value)?;
        }
        let mean = finite("mean", mean(values))?;
        let deviation = not_negative("deviation", standard_deviation(values))?;
        Ok(Self { mean, deviation, standard_error: deviation / (values.len() as f64).sqrt() })
    }
}

/// An ensemble of transients of one motor.
///
/// The fits of its members are meaningless if the duration is too short or the sampling too coarse. A
/// [`TransientFit`](crate::estimate::TransientFit) rejects such curves, and fits the mean curve instead of
/// the members.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TransientEnsemble {
    /// The curve of each member.
    pub curves: Vec<SpeedCurve>,
    /// The fit of each member.
    pub fits: Vec<ExponentialFit>,
    /// Steady speed alpha_ss (rad/s), from the fits of all members. Near the load that stalls the motor a
    /// curve hardly rises and its fit is meaningless; use [`SpeedCurve::mean_over_last`] there.
    pub steady_speed: Spread,
    /// Time constant t_c (s).
    pub time_constant: Spread,
    /// Stall acceleration alpha_ss/t_c (rad/s^2).
    pub stall_acceleration: Spread,
}

impl TransientEnsemble {
    /// Computes `members` >= 1 transients with evenly spaced starting phases and consecutive seeds from
    /// `settings.seed` ([`TransientMember::of_ensemble`]). The result is the same for any number of threads.
    ///
    /// The observer's items are the members, counted once when their transients are computed, and once more
    /// when they are fitted. The fit of one curve is not interrupted: it takes about 10 microseconds for each
    /// interval.
    ///
    /// # Errors
    /// The errors of [`TransientMember::of_ensemble`] and [`transient`](crate::motor::transient()).
    pub fn new(
        system: &System,
        settings: &TransientSettings,
        members: usize,
        observer: &dyn Observer,
    ) -> Result<Self, Error> {
        let members = TransientMember::of_ensemble(system, settings, members)?;
        Self::of_results(transients(&members, observer)?, observer)
    }

    /// The ensemble of the [`transients`] of all members.
    ///
    /// The observer's items are the fits.
    ///
    /// # Errors
    /// The first error in the order of the members; [`Error::OutOfRange`] if there are no members; the errors
    /// of [`ExponentialFit::new`].
    pub fn of_results(
        results: Vec<Result<SpeedCurve, Error>>,
        observer: &dyn Observer,
    ) -> Result<Self, Error> {
        let members = results.len();
        let watch = Watch::begin(observer, 0, members as u64)?;
        // Each thread counts its own work, as it may fit many short curves between two calls of the observer.
        let fitted = |work: &mut WorkCount<'_>, curve: Result<SpeedCurve, Error>| {
            let curve = curve?;
            let fit = ExponentialFit::counted(&curve.times, &curve.speeds, work)?;
            watch.finish(1);
            Ok::<_, Error>((curve, fit))
        };
        #[cfg(feature = "parallel")]
        let results: Vec<_> = {
            use rayon::prelude::*;
            results.into_par_iter().map_init(|| watch.work(), fitted).collect()
        };
        #[cfg(not(feature = "parallel"))]
        let results: Vec<_> = {
            let mut work = watch.work();
            results.into_iter().map(|curve| fitted(&mut work, curve)).collect()
        };
        let mut curves = room_for("members of an ensemble", members, MAX_MEMBERS)?;
        let mut fits = room_for("members of an ensemble", members, MAX_MEMBERS)?;
        for result in results {
            let (curve, fit) = result?;
            curves.push(curve);
            fits.push(fit);
        }
        watch.end();
        let of = |value: fn(&ExponentialFit) -> f64| Spread::of(&fits.iter().map(value).collect::<Vec<_>>());
        Ok(Self {
            steady_speed: of(|fit| fit.steady_speed)?,
            time_constant: of(|fit| fit.time_constant)?,
            stall_acceleration: of(ExponentialFit::stall_acceleration)?,
            curves,
            fits,
        })
    }
}

impl Display for Spread {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        write!(f, "{} +- {} (deviation {})", n(self.mean), n(self.standard_error), n(self.deviation))
    }
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::Unobserved;

    use bouncing_disk_core::ChatterPolicy;

    use std::f64::consts::TAU;

    use bouncing_disk_core::Phase;
    use bouncing_disk_core::numerics::random::SplitMix64;

    use super::*;
    use crate::motor::rotor::{Rotor, RotorStep};
    use crate::testing::{check_stops, motor, refused};
    use crate::{Engine, InitialCondition};

    /// The error names the value, not a mean that is undefined because of it.
    #[test]
    fn a_value_that_is_not_finite_is_named() {
        for value in [f64::INFINITY, f64::NEG_INFINITY] {
            let named = Error::OutOfRange { field: "value of a spread", value, legal: "finite" };
            assert_eq!(Spread::of(&[1.0, value, 2.0]), Err(named));
        }
        assert!(Spread::of(&[]).is_err());
        let error = Spread::of(&[1.0, f64::NAN]).expect_err("not a number").to_string();
        assert!(error.contains("value of a spread"), "{error}");
    }

    #[test]
    fn a_spread_is_that_of_a_sample() {
        let spread = Spread::of(&[2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0]).expect("values");
        assert!((spread.mean - 5.0).abs() < 1e-15);
        assert!((spread.deviation - (32.0_f64 / 7.0).sqrt()).abs() < 1e-15);
        assert!((spread.standard_error - (4.0_f64 / 7.0).sqrt()).abs() < 1e-15);
        // A single value has no known deviation.
        let one = Spread { mean: -3.0, deviation: 0.0, standard_error: 0.0 };
        assert_eq!(Spread::of(&[-3.0]), Ok(one));
    }

    /// As documented, the perturbation is large enough to break the cycle that rounding selects, and too
    /// small to be visible.
    #[test]
    fn relaunches_are_perturbed_by_a_thousandth_unless_told_otherwise() {
        assert!((TransientSettings::default().relaunch_perturbation - 1e-3).abs() < 1e-18);
    }

    /// Evenly spaced phases over the cycle, the first half a step after zero, and a stream of random numbers
    /// for each member.
    #[test]
    fn members_are_the_transients_of_their_phases_and_seeds() {
        let system = motor(1e-8, 0.0);
        let settings =
            TransientSettings { duration: 0.2, intervals: 20, seed: 1, ..TransientSettings::default() };
        let all = TransientEnsemble::new(&system, &settings, 4, &Unobserved).expect("no failure");
        let seeds = [1, 2, 3, 4].map(|counted| SplitMix64::new(counted).next_number());
        for (k, curve) in all.curves.iter().enumerate() {
            let phase = Phase::new(TAU / 8.0 * [1.0, 3.0, 5.0, 7.0][k]).expect("finite");
            let own = |seed: u64| {
                crate::motor::transient(&system, phase, &TransientSettings { seed, ..settings }, &Unobserved)
                    .expect("no failure")
            };
            assert_eq!(*curve, own(seeds[k]), "{k}");
            assert_ne!(*curve, own(seeds[k ^ 1]), "the seed matters");
            assert_eq!(all.fits[k], curve.fit().expect("legal curve"));
            // The midpoints of the intervals.
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
            let start = InitialCondition::Contact { phase, angular_speed: 0.0 };
            let mut engine = Engine::new(system, start, policy).expect("legal");
            for _ in 0..3_000 {
                let record = engine.advance().expect("no failure");
                let step = rotor.advance().expect("no failure");
                let Some(record) = record else {
                    assert_eq!(step, RotorStep::Ended);
                    break;
                };
                // The vertical motion agrees to the bit, the speed up to the closed form of the chattering
                // sums.
                assert_eq!(record.time, rotor.time());
                let difference = (record.after.angular_speed - rotor.speed()).abs();
                assert!(difference <= 1e-12 * system.dimensionless().twist_speed(), "{difference}");
            }
        }
    }

    /// At its lowest point the stator turns at the speed of the resting rotor, up to rounding. Friction cannot
    /// hold the rotor there, and rounding must not make it seem to.
    #[test]
    fn rotor_starts_as_the_engine_at_the_lowest_point() {
        let system = motor(1e-8, 0.0);
        let policy = ChatterPolicy::Complete;
        for angle in [0.75 * TAU, 0.75 * TAU * (1.0 - f64::EPSILON), 0.75 * TAU * (1.0 + f64::EPSILON)] {
            let phase = Phase::new(angle).expect("finite");
            let mut rotor = Rotor::at_rest(system.dimensionless(), phase, 0.0, policy).expect("legal");
            while rotor.advance().expect("no failure") != RotorStep::Separation {}
            let start = InitialCondition::Contact { phase, angular_speed: 0.0 };
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

    /// Perturbations from 1e-5 to 1e-1 agree within 3 %. Smaller ones do not: the first impacts after a
    /// relaunch are then always the same, and more of them for smaller perturbations (docs/numerics-impacts.md,
    /// "Motors remember the rounding").
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
                let runs = TransientEnsemble::new(&system, &settings, 16, &Unobserved).expect("no failure");
                let means: Vec<f64> =
                    runs.curves.iter().map(|curve| curve.mean_over_last(0.6).expect("legal")).collect();
                let spread = Spread::of(&means).expect("finite");
                assert!(spread.standard_error < 0.01 * spread.mean, "{spread:?}");
                spread.mean
            })
            .collect();
        for speed in &speeds {
            assert!((speed / speeds[1] - 1.0).abs() < 0.03, "{speeds:?}");
        }
    }

    #[test]
    fn an_ensemble_is_that_of_its_transients_and_can_be_stopped() {
        let system = motor(1e-8, 0.0);
        let settings = TransientSettings { duration: 0.2, intervals: 50, ..TransientSettings::default() };
        let members = TransientMember::of_ensemble(&system, &settings, 5).expect("legal");
        let results = transients(&members, &Unobserved).expect("unobserved");
        let all = TransientEnsemble::new(&system, &settings, 5, &Unobserved).expect("no failure");
        assert!(all.curves.iter().all(|curve| curve.separations > 0));
        assert_eq!(TransientEnsemble::of_results(results.clone(), &Unobserved), Ok(all));
        check_stops(5, |observer| TransientEnsemble::of_results(results.clone(), observer));
        check_stops(5, |observer| TransientEnsemble::new(&system, &settings, 5, observer));
        assert!(TransientEnsemble::of_results(Vec::new(), &Unobserved).is_err());
    }

    #[test]
    fn illegal_settings_and_too_many_members_are_refused() {
        let system = motor(1e-8, 0.0);
        let d = TransientSettings::default();
        let of = |settings, members| TransientEnsemble::new(&system, &settings, members, &Unobserved);
        refused("duration", [0.0, f64::NAN], |duration| of(TransientSettings { duration, ..d }, 2));
        refused("intervals", [2], |intervals| of(TransientSettings { intervals, ..d }, 2));
        refused("relaunch_perturbation", [-1.0], |relaunch_perturbation| {
            of(TransientSettings { relaunch_perturbation, ..d }, 2)
        });
        refused("members", [0], |members| of(d, members));
        for (members, intervals, count) in [
            (usize::MAX, 600, usize::MAX),
            (MAX_MEMBERS + 1, 3, MAX_MEMBERS + 1),
            (MAX_MEMBERS, 1_000_000, MAX_MEMBERS * 1_000_000),
        ] {
            let error = of(TransientSettings { intervals, ..d }, members).expect_err("too many");
            assert!(
                matches!(error, Error::Core(bouncing_disk_core::Error::TooLarge { count: asked, .. }) if asked == count as u64),
                "{error}"
            );
        }
    }

    /// The squares of such values once overflowed or vanished.
    #[test]
    fn values_of_any_size_have_a_spread() {
        for size in [1.0, 1e300, 1e-300, 1e-200] {
            let spread = Spread::of(&[1.0 * size, 2.0 * size, 3.0 * size]).expect("finite");
            assert!((spread.mean / (2.0 * size) - 1.0).abs() < 1e-15, "{spread:?}");
            assert!((spread.deviation / size - 1.0).abs() < 1e-15, "{spread:?}");
        }
        assert!(Spread::of(&[f64::MAX, -f64::MAX]).is_err(), "no double holds the deviation");
    }
}
