//! Statistics of a motor from an ensemble of transients, and the orbit that it would repeat unperturbed.

use std::f64::consts::TAU;

use bouncing_disk::core::{ChatterPolicy, Phase, Unobserved};
use bouncing_disk::estimate::{RampFit, RiseForm, Spread, TransientEnsemble};
use bouncing_disk::toss::{
    ChatteringCycle, EXAMINED_IMPACTS, LOCKED_FLIGHTS, LOCKED_WITHIN, MultiTossSettings, OrbitClass,
    TOSS_START, multi_toss,
};
use bouncing_disk::{Error, InitialCondition, System};

/// A fit whose constant exceeds this share of the duration, or whose residual exceeds [`LARGEST_RESIDUAL`] of
/// its steady speed, is meaningless: the speed does not settle, or is not significantly above zero.
pub(crate) const LARGEST_CONSTANT: f64 = 0.5;
/// See [`LARGEST_CONSTANT`].
pub(crate) const LARGEST_RESIDUAL: f64 = 0.25;

/// Impacts that show most chattering cycles.
const FIRST_EXAMINED: usize = EXAMINED_IMPACTS / 16;

/// The orbit that the unperturbed motor repeats, from a rotor at rest on the stator at its lowest point.
pub(crate) fn unperturbed_orbit(motor: &System, policy: ChatterPolicy) -> Result<OrbitClass, Error> {
    let start = InitialCondition::Contact { phase: Phase::new(TOSS_START)?, angular_speed: 0.0 };
    let examined = |examined_impacts| {
        let settings = MultiTossSettings {
            policy,
            transient_impacts: 0,
            examined_impacts,
            ..MultiTossSettings::default()
        };
        Ok(multi_toss(*motor, start, settings, &Unobserved)?.class)
    };
    // Every separation leaves the same vertical state: a cycle that the first impacts show is the last one's.
    match examined(FIRST_EXAMINED)? {
        cycle @ OrbitClass::Chattering(_) => Ok(cycle),
        _ => examined(EXAMINED_IMPACTS),
    }
}

/// Ensemble statistics of one motor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EnsembleStatistics {
    /// Steady speed (rad/s) from the fits; where less than half of the members can be fitted, the mean over
    /// the last half of each.
    pub(crate) steady_speed: Spread,
    /// Stall acceleration (rad/s^2) over the members that can be fitted; `None` where less than half can.
    pub(crate) stall_acceleration: Option<Spread>,
    /// The curve that was fitted: the ramp where a cycle survives the perturbation and it fits better.
    form: RiseForm,
    /// Whether the exponential fits the curves better than the ramp.
    pub(crate) is_exponential: bool,
    /// Members without a meaningful fit ([`LARGEST_CONSTANT`]).
    unfitted: usize,
    /// The orbit repeated without perturbation ([`unperturbed_orbit`]).
    pub(crate) orbit: OrbitClass,
    /// Whether that orbit is a chattering cycle of at most eight long flights and the perturbed members
    /// repeat it, too, judged by the mean time between their separations.
    pub(crate) locked: bool,
}

impl EnsembleStatistics {
    /// The statistics of the transients of `motor`, each of `duration` (s).
    pub(crate) fn of(
        motor: &System,
        runs: &TransientEnsemble,
        duration: f64,
        policy: ChatterPolicy,
    ) -> Result<Self, Error> {
        let orbit = unperturbed_orbit(motor, policy)?;
        let ramps = runs
            .curves
            .iter()
            .map(|curve| RampFit::new(&curve.times, &curve.speeds))
            .collect::<Result<Vec<_>, _>>()?;
        let locked = matches!(orbit, OrbitClass::Chattering(cycle) if repeats(motor, runs, duration, cycle));
        let squares =
            |residuals: &mut dyn Iterator<Item = f64>| residuals.map(|value| value * value).sum::<f64>();
        let exponential = squares(&mut runs.fits.iter().map(|fit| fit.residual));
        let ramp = squares(&mut ramps.iter().map(|fit| fit.residual));
        let form = if locked && ramp < exponential { RiseForm::Ramp } else { RiseForm::Exponential };
        let fits: Vec<(f64, f64, f64)> = match form {
            RiseForm::Exponential => {
                runs.fits.iter().map(|fit| (fit.steady_speed, fit.time_constant, fit.residual)).collect()
            }
            RiseForm::Ramp => {
                ramps.iter().map(|fit| (fit.steady_speed, fit.rise_time, fit.residual)).collect()
            }
        };
        let fitted: Vec<_> = fits
            .iter()
            .filter(|(steady, constant, residual)| {
                *constant < LARGEST_CONSTANT * duration && *residual < LARGEST_RESIDUAL * steady.abs()
            })
            .collect();
        let enough = 2 * fitted.len() >= fits.len();
        let steady: Vec<f64> = if enough {
            fitted.iter().map(|fit| fit.0).collect()
        } else {
            runs.curves.iter().map(|curve| curve.mean_over_last(0.5)).collect::<Result<_, _>>()?
        };
        let stall: Vec<f64> = fitted.iter().map(|fit| fit.0 / fit.1).collect();
        Ok(Self {
            steady_speed: Spread::of(&steady)?,
            stall_acceleration: enough.then(|| Spread::of(&stall)).transpose()?,
            form,
            is_exponential: exponential < ramp,
            unfitted: fits.len() - fitted.len(),
            orbit,
            locked,
        })
    }
}

/// Whether the members of an ensemble repeat a short cycle.
fn repeats(motor: &System, runs: &TransientEnsemble, duration: f64, cycle: ChatteringCycle) -> bool {
    let separations: u64 = runs.curves.iter().map(|curve| curve.separations).sum();
    let frequency = motor.platform().angular_frequency() / TAU;
    let between = duration * frequency * runs.curves.len() as f64 / separations.max(1) as f64;
    cycle.long_flights <= LOCKED_FLIGHTS
        && (between / cycle.platform_periods as f64 - 1.0).abs() <= LOCKED_WITHIN
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

    use bouncing_disk::motor::TransientSettings;

    use super::*;

    /// Evenly filling.
    fn golden_spread(k: u64) -> f64 {
        (k as f64 * 0.618_033_988_749_894_9) % 1.0
    }

    fn statistics(motor: &System, members: usize) -> EnsembleStatistics {
        let settings = TransientSettings {
            duration: 6.0 * motor.rise_time(),
            intervals: 240,
            ..TransientSettings::default()
        };
        let runs = TransientEnsemble::new(motor, &settings, members, &Unobserved).expect("no failure");
        EnsembleStatistics::of(motor, &runs, settings.duration, settings.policy).expect("no failure")
    }

    #[test]
    fn a_gentle_stator_never_throws_the_rotor() {
        let motor = System::motor().with_platform(|stator| stator.amplitude = 4e-11).expect("legal");
        assert!(motor.axial_forcing() < FRAC_1_PI);
        assert_eq!(unperturbed_orbit(&motor, ChatterPolicy::Complete), Ok(OrbitClass::AtRest));
    }

    /// The first impacts show the cycle that the last ones repeat, and a cycle that is longer is found, too.
    #[test]
    fn the_unperturbed_orbit_is_the_one_at_the_end() {
        let mut longer = 0;
        for k in 0..60_u64 {
            let motor = System::motor()
                .with_platform(|stator| stator.amplitude = [1e-8, 1e-9, 3e-10][(k % 3) as usize])
                .and_then(|motor| {
                    motor.with_disk(|rotor| {
                        rotor.preload_acceleration = 1.0 + 9.0 * golden_spread(k);
                        rotor.restitution = 0.9 * golden_spread(7 * k);
                    })
                })
                .expect("legal");
            let settings = MultiTossSettings {
                transient_impacts: 0,
                examined_impacts: EXAMINED_IMPACTS,
                ..MultiTossSettings::default()
            };
            let phase = Phase::new(TOSS_START).expect("finite");
            let start = InitialCondition::Contact { phase, angular_speed: 0.0 };
            let all = multi_toss(motor, start, settings, &Unobserved).expect("no failure").class;
            assert_eq!(unperturbed_orbit(&motor, ChatterPolicy::Complete), Ok(all), "{motor:?}");
            longer +=
                u32::from(matches!(all, OrbitClass::Chattering(cycle) if 2 * cycle.impacts > FIRST_EXAMINED));
        }
        assert!(longer > 0, "no cycle outlasts the first impacts");
    }

    #[test]
    fn a_plastic_rotor_repeats_a_ramp_and_is_fitted_by_one() {
        let motor = System::motor().with_disk(|rotor| rotor.restitution = 0.0).expect("legal");
        let statistics = statistics(&motor, 2);
        assert!(statistics.locked && statistics.form == RiseForm::Ramp, "{statistics:?}");
        let stall = statistics.stall_acceleration.expect("fitted").mean;
        assert!((stall / motor.disk().friction_acceleration() - 1.0).abs() < 0.02, "{stall}");
    }

    #[test]
    fn a_quarter_of_a_turn_leaves_nothing_to_fit() {
        let motor = System::motor().with_platform(|stator| stator.phase_lag = FRAC_PI_2).expect("legal");
        let statistics = statistics(&motor, 4);
        assert!(statistics.steady_speed.mean.abs() < 0.4 * motor.platform().peak_angular_speed());
        assert_eq!(statistics.stall_acceleration.is_none(), statistics.unfitted > 2);
    }
}
