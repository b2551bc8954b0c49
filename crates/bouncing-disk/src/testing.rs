//! Systems of tests: the motor of the paper, and random ones for property tests, biased to the legal limits.

pub(crate) mod small_steps;

use std::f64::consts::{PI, TAU};

use bouncing_disk_core::numerics::elementary::exp;
use bouncing_disk_core::{ChatterPolicy, Phase};
use proptest::prelude::*;

use crate::motion::initial_condition::InitialCondition;
use crate::parameters::dimensionless::{DimensionlessParameters, DimensionlessSystem};
use crate::parameters::stator::StatorParameters;
use crate::{Motor, System};

/// The motor of Table III, at an `amplitude` in m and a load in rad/s^2.
pub(crate) fn motor(amplitude: f64, load_acceleration: f64) -> System {
    System::motor()
        .with_platform(|stator| stator.amplitude = amplitude)
        .and_then(|motor| motor.with_disk(|rotor| rotor.load_acceleration = load_acceleration))
        .expect("legal")
}

/// Table III on a stator of 50 g in volts, which it lifts.
pub(crate) fn in_volts() -> Motor {
    let table = StatorParameters {
        mass: Some(0.05),
        quality: Some(300.0),
        resonance: Some(70e3),
        anti_resonance: Some(70.4e3),
        capacitance: Some(1.2e-9),
        volts: Some(10.0),
        ..StatorParameters::default()
    };
    let motor = Motor::paper_70_khz().with(|sheet| {
        (sheet.amplitude, sheet.stator) = (None, Some(table));
        (sheet.mass, sheet.preload_acceleration, sheet.preload_force) = (Some(0.033), None, Some(0.3));
    });
    motor.expect("legal")
}

/// The motor on which a new user came to grief: 40 kHz, 0.5 um, 20 g, preload 5 N, 12 rad/s, lag 30 degrees;
/// radii, friction and restitution of Table III.
pub(crate) fn tried_motor() -> System {
    let angular_frequency = TAU * 40e3;
    System::motor()
        .with_platform(|stator| {
            stator.angular_frequency = angular_frequency;
            stator.amplitude = 0.5e-6;
            stator.twist_amplitude = 12.0 / angular_frequency;
            stator.phase_lag = PI / 6.0;
        })
        .and_then(|motor| motor.with_disk(|rotor| rotor.preload_acceleration = 5.0 / 0.02))
        .expect("legal")
}

/// The field of a number that is refused because it is out of range.
pub(crate) fn refused_field<T: std::fmt::Debug>(
    result: Result<T, impl Into<crate::estimate::FitError> + std::fmt::Debug>,
) -> &'static str {
    match result.map_err(Into::into) {
        Err(crate::estimate::FitError::Model(crate::Error::OutOfRange { field, .. })) => field,
        other => panic!("{other:?}"),
    }
}

/// Well spread numbers in [0, 1).
pub(crate) fn golden_spread(k: u64) -> f64 {
    (k as f64 * 0.618_033_988_749_894_9) % 1.0
}

/// A number whose logarithm is uniform between those of `low` and `high`.
pub(crate) fn log_uniform(low: f64, high: f64) -> impl Strategy<Value = f64> {
    let (low, high) = (
        bouncing_disk_core::numerics::elementary::ln(low),
        bouncing_disk_core::numerics::elementary::ln(high),
    );
    (low..high).prop_map(exp)
}

pub(crate) fn phase() -> impl Strategy<Value = Phase> {
    (0.0..TAU).prop_map(|angle| Phase::new(angle).unwrap())
}

pub(crate) fn policy() -> impl Strategy<Value = ChatterPolicy> {
    prop_oneof![Just(ChatterPolicy::Complete), Just(crate::motion::PAPER_CHATTER)]
}

/// Systems of every kind: still, gentle, lively, violent; without twist, friction, rebound or load.
pub(crate) fn system() -> impl Strategy<Value = DimensionlessSystem> {
    let peak = prop_oneof![
        1 => Just(0.0),
        1 => Just(1.0),
        3 => 0.0..1.0_f64,
        6 => 1.0..3.0_f64,
        3 => log_uniform(1.0, 1e3),
        1 => log_uniform(1e3, 1e6),
    ];
    system_with(peak.boxed())
}

pub(crate) fn system_with(peak: BoxedStrategy<f64>) -> impl Strategy<Value = DimensionlessSystem> {
    let twist = prop_oneof![1 => Just(0.0), 3 => 0.0..2.0_f64, 2 => log_uniform(1e-6, 1e6)];
    let friction = prop_oneof![1 => Just(0.0), 5 => 0.01..1.5_f64];
    let restitution = prop_oneof![1 => Just(0.0), 5 => 0.0..0.95_f64];
    let load = prop_oneof![2 => Just(0.0), 2 => -0.5..0.5_f64, 1 => -3.0..3.0_f64];
    (peak, twist, -PI..PI, friction, restitution, load).prop_map(
        |(peak_acceleration, twist_speed, phase_lag, friction, restitution, load)| {
            DimensionlessParameters { peak_acceleration, twist_speed, phase_lag, friction, restitution, load }
                .build()
                .unwrap()
        },
    )
}

/// Starts of every kind, with speeds in proportion to the platform's.
pub(crate) fn start(system: DimensionlessSystem) -> impl Strategy<Value = InitialCondition> {
    let peak = system.peak_acceleration() + 1.0;
    let twist = system.twist_speed() + 1.0;
    let spin = prop_oneof![Just(None), (-2.0..2.0_f64).prop_map(Some)];
    (phase(), spin, 0..4_u8, 0.001..2.0_f64, -2.0..2.0_f64).prop_map(
        move |(phase, spin, kind, size, velocity)| {
            let angular_speed =
                spin.map_or_else(|| system.platform_angular_speed(phase), |spin| spin * twist);
            match kind {
                0 | 1 => InitialCondition::Contact { phase, angular_speed },
                2 => InitialCondition::Launch { phase, relative_speed: size * peak, angular_speed },
                _ => InitialCondition::Flight {
                    phase,
                    gap: size * peak,
                    relative_velocity: velocity * peak,
                    angular_speed,
                },
            }
        },
    )
}

/// A system, a start and a policy.
pub(crate) fn motion() -> impl Strategy<Value = (DimensionlessSystem, InitialCondition, ChatterPolicy)> {
    (system(), policy()).prop_flat_map(|(system, policy)| {
        // The paper's cut has no rule for a disk that hits hard and does not rebound: the core reports
        // NoLiftOff.
        (Just(system), start(system), Just(policy))
    })
}

/// Seeded normal numbers, for data that are labelled synthetic.
pub(crate) struct Noise(bouncing_disk_core::numerics::random::SplitMix64);

impl Noise {
    pub(crate) fn new(seed: u64) -> Self {
        Self(bouncing_disk_core::numerics::random::SplitMix64::new(seed))
    }

    /// The next number of mean 0 and deviation 1 (Box and Muller).
    pub(crate) fn normal(&mut self) -> f64 {
        crate::statistics::normal(&mut self.0)
    }

    /// Numbers of deviation 1 of which each remembers the share `memory` of the one before.
    pub(crate) fn correlated(&mut self, count: usize, memory: f64) -> Vec<f64> {
        let mut value = self.normal();
        let fresh = (1.0 - memory * memory).sqrt();
        (0..count)
            .map(|_| {
                value = memory * value + fresh * self.normal();
                value
            })
            .collect()
    }
}
