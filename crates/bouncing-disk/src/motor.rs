//! The ultrasonic motor: speed transients, their fit, and ensembles of them (Sec. V).
//!
//! After every rest the disk leaves the platform in exactly the same vertical state, so the orbit of an ideal motor
//! falls onto a cycle that the rounding of the program has chosen. A speed, a torque or a time constant is therefore
//! the mean over an ensemble whose relaunches are perturbed by a seeded, small relative velocity and whose members
//! start at different phases; a single transient is a picture of one member.

use std::f64::consts::TAU;

use bouncing_disk_core::{ChatterPolicy, Phase};
use serde::{Deserialize, Serialize};

use crate::error::{Error, not_negative, positive};
use crate::fit::ExponentialFit;
use crate::rotor::{Rotor, RotorStep};
use crate::system::System;

/// How a transient is computed and sampled.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TransientSettings {
    /// Duration (s), positive.
    pub duration: f64,
    /// Number of equal intervals over which the speed is averaged, in [3, 1000000].
    pub intervals: usize,
    /// Size of the relaunch perturbation in units of g/omega, not negative: each separation from rest gets a
    /// relative velocity drawn evenly from [0, size). Zero gives the cycle of the rounding. Default 1e-3.
    pub relaunch_perturbation: f64,
    /// Seed of the perturbations and of the starting phases.
    pub seed: u64,
    /// What ends a chattering sequence.
    pub policy: ChatterPolicy,
}

impl Default for TransientSettings {
    fn default() -> Self {
        Self {
            duration: 3.0,
            intervals: 600,
            relaunch_perturbation: 1.0e-3,
            seed: 1,
            policy: ChatterPolicy::Complete,
        }
    }
}

impl TransientSettings {
    fn check(&self) -> Result<(), Error> {
        positive("duration", self.duration)?;
        not_negative("relaunch_perturbation", self.relaunch_perturbation)?;
        if (3..=1_000_000).contains(&self.intervals) {
            Ok(())
        } else {
            Err(Error::OutOfRange { field: "intervals", value: self.intervals as f64, legal: "[3, 1000000]" })
        }
    }
}

/// Angular speed against time, from rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SpeedCurve {
    /// Middles of the intervals (s).
    pub times: Vec<f64>,
    /// Mean angular speed in each interval (rad/s).
    pub speeds: Vec<f64>,
    /// Impacts on the way, those of summed chattering sequences not counted.
    pub impacts: u64,
    /// Separations from rest on the way.
    pub separations: u64,
}

impl SpeedCurve {
    /// The fit of alpha_ss (1 - exp(-t/t_c)).
    ///
    /// # Errors
    /// Those of [`ExponentialFit::new`].
    pub fn fit(&self) -> Result<ExponentialFit, Error> {
        ExponentialFit::new(&self.times, &self.speeds)
    }

    /// Mean speed (rad/s) over the last `fraction` in (0, 1] of the curve.
    #[must_use]
    pub fn mean_over_last(&self, fraction: f64) -> f64 {
        let count = ((self.speeds.len() as f64 * fraction) as usize).clamp(1, self.speeds.len());
        let last = &self.speeds[self.speeds.len() - count..];
        last.iter().sum::<f64>() / count as f64
    }
}

/// The splitmix64 generator: a documented, reproducible stream for each seed.
#[derive(Debug, Clone, Copy)]
struct SplitMix(u64);

impl SplitMix {
    const fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Evenly in [0, 1).
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }
}

/// The speed transient of a rotor that at `phase` lies at rest on the stator, which starts to vibrate.
///
/// # Errors
/// [`Error::OutOfRange`] for illegal settings; the errors of the flights.
pub fn transient(system: &System, phase: Phase, settings: &TransientSettings) -> Result<SpeedCurve, Error> {
    settings.check()?;
    let unit = system.scales();
    let dimensionless = system.dimensionless();
    let mut generator = SplitMix(settings.seed);
    let mut rotor = Rotor::at_rest(dimensionless, phase, 0.0, settings.policy)?;
    let mut bins = Bins::new(settings.duration, settings.intervals);
    let (mut impacts, mut separations) = (0, 0);
    // Each time is computed from whole periods; none is accumulated.
    let seconds = |rotor: &Rotor| {
        let now = rotor.time();
        (now.periods as f64 * TAU + (now.phase.angle() - phase.angle())) * unit.time
    };
    while bins.reached < settings.duration {
        match rotor.advance()? {
            RotorStep::Ended => {
                let rest = settings.duration - bins.reached;
                bins.add(settings.duration, rotor.speed() * (rest / unit.time));
                break;
            }
            RotorStep::Impact => impacts += 1,
            RotorStep::Contact => {}
            RotorStep::Separation => {
                separations += 1;
                if settings.relaunch_perturbation > 0.0 {
                    rotor.perturb_launch(settings.relaunch_perturbation * generator.unit())?;
                }
            }
        }
        bins.add(seconds(&rotor), rotor.turned());
    }
    let factor = unit.angular_speed * unit.time / bins.width;
    Ok(SpeedCurve {
        times: (0..settings.intervals).map(|i| (i as f64 + 0.5) * bins.width).collect(),
        speeds: bins.turned.into_iter().map(|angle| angle * factor).collect(),
        impacts,
        separations,
    })
}

/// The angle turned in each of a number of equal intervals of time.
struct Bins {
    turned: Vec<f64>,
    width: f64,
    /// The interval that `reached` lies in, and its end.
    index: usize,
    end: f64,
    /// Time up to which the motion has been added (s).
    reached: f64,
}

impl Bins {
    fn new(duration: f64, count: usize) -> Self {
        let width = duration / count as f64;
        Self { turned: vec![0.0; count], width, index: 0, end: width, reached: 0.0 }
    }

    /// Adds the `angle` turned from the time reached until `to`, evenly in time; what lies beyond the last interval
    /// is dropped.
    #[inline]
    fn add(&mut self, to: f64, angle: f64) {
        if to <= self.end {
            self.turned[self.index] += angle;
            self.reached = to;
        } else {
            self.add_across(to, angle);
        }
    }

    fn add_across(&mut self, to: f64, angle: f64) {
        let rate = angle / (to - self.reached);
        while to > self.end {
            self.turned[self.index] += rate * (self.end - self.reached);
            self.reached = self.end;
            if self.index + 1 == self.turned.len() {
                self.reached = to;
                return;
            }
            self.index += 1;
            self.end = (self.index + 1) as f64 * self.width;
        }
        self.turned[self.index] += rate * (to - self.reached);
        self.reached = to;
    }
}

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
/// [`Error::OutOfRange`] for no member or illegal settings; the errors of [`transient`].
pub fn ensemble(system: &System, settings: &TransientSettings, members: usize) -> Result<Ensemble, Error> {
    settings.check()?;
    if members == 0 {
        return Err(Error::OutOfRange { field: "members", value: 0.0, legal: "[1, inf)" });
    }
    let member = |index: usize| -> Result<(SpeedCurve, ExponentialFit), Error> {
        // Half a step off zero, so that no member starts on a phase that is special.
        let phase = Phase::new(TAU * (index as f64 + 0.5) / members as f64)?;
        let seed = SplitMix(settings.seed.wrapping_add(index as u64)).next();
        let curve = transient(system, phase, &TransientSettings { seed, ..*settings })?;
        let fit = curve.fit()?;
        Ok((curve, fit))
    };
    #[cfg(feature = "parallel")]
    let results: Vec<_> = {
        use rayon::prelude::*;
        (0..members).into_par_iter().map(member).collect()
    };
    #[cfg(not(feature = "parallel"))]
    let results: Vec<_> = (0..members).map(member).collect();
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
    use super::*;
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

    #[test]
    fn curve_keeps_the_angle_turned() {
        let mut bins = Bins::new(1.0, 10);
        bins.add(0.05, 0.0);
        bins.add(0.77, 7.2);
        assert!((bins.turned.iter().sum::<f64>() - 7.2).abs() < 1e-14);
        assert!((bins.turned[0] - 0.5).abs() < 1e-14 && (bins.turned[3] - 1.0).abs() < 1e-14);
        assert!(bins.turned[8].abs() <= 0.0);
        bins.add(0.95, 0.0);
        bins.add(1.4, 4.5);
        assert!((bins.turned[9] - 0.5).abs() < 1e-13, "what lies beyond the end is dropped");
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
