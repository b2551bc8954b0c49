//! Systems for tests: the motor of the paper, and random ones for property tests, biased towards the legal limits.

pub(crate) mod small_steps;

use std::f64::consts::{PI, TAU};
use std::fmt::Debug;
use std::ops::ControlFlow;
use std::sync::Mutex;

use bouncing_disk_core::numerics::elementary::exp;
use bouncing_disk_core::{ChatterPolicy, Observer, Phase, Progress, Unobserved};
use proptest::prelude::*;

use crate::error::Error;
use crate::estimate::{FitError, FitRefusal};
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

/// Table III driven in volts on a stator of 50 g, which lifts the rotor.
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

/// A motor that a new user tried, and for which results were misleading: 40 kHz, 0.5 um, 20 g, preload 5 N,
/// 12 rad/s, lag 30 degrees; radii, friction and restitution of Table III.
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

/// The expected content of an error.
pub(crate) trait Told: Debug {
    fn is_told_by(&self, error: &FitError) -> bool;
}

/// The field of a number that is out of range, or part of another message; a text that contains " = " may be
/// part of any message.
impl Told for &str {
    fn is_told_by(&self, error: &FitError) -> bool {
        match error {
            FitError::Model(Error::OutOfRange { field, .. }) if !self.contains(" = ") => field == self,
            other => other.to_string().contains(self),
        }
    }
}

impl Told for Error {
    fn is_told_by(&self, error: &FitError) -> bool {
        *error == FitError::Model(*self)
    }
}

impl Told for FitRefusal {
    fn is_told_by(&self, error: &FitError) -> bool {
        *error == FitError::Refused(*self)
    }
}

/// A row of a table of rejected calls: each of these arguments must return the error `told`.
pub(crate) fn refused<A, T: Debug, E: Into<FitError>>(
    told: impl Told,
    arguments: impl IntoIterator<Item = A>,
    call: impl Fn(A) -> Result<T, E>,
) {
    for (index, argument) in arguments.into_iter().enumerate() {
        match call(argument).map_err(Into::into) {
            Err(error) => assert!(told.is_told_by(&error), "{told:?}, number {index}: {error}"),
            Ok(legal) => panic!("{told:?}, number {index}: {legal:?}"),
        }
    }
}

/// Stops a computation at the nth call of the observer and after it.
struct StopAfter {
    calls: u64,
    /// The number of items that each call must report, if known.
    items: Option<u64>,
    /// The number of calls so far, and the last progress reported.
    seen: Mutex<(u64, Progress)>,
}

impl StopAfter {
    fn calls(calls: u64, items: Option<u64>) -> Self {
        Self { calls, items, seen: Mutex::default() }
    }

    fn seen(&self) -> (u64, Progress) {
        *self.seen.lock().expect("no panic")
    }
}

impl Observer for StopAfter {
    fn observe(&self, progress: Progress) -> ControlFlow<()> {
        let mut seen = self.seen.lock().expect("no panic");
        *seen = (seen.0 + 1, progress);
        assert!(progress.done <= progress.total, "{progress:?}");
        assert!(self.items.is_none_or(|items| progress.total == items), "{progress:?}");
        if seen.0 < self.calls { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }
}

fn on<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("starts").install(work)
}

/// The progress at which a call was stopped, if that is why it failed.
fn stopped<T>(result: &Result<T, FitError>) -> Option<Progress> {
    match result {
        Err(FitError::Model(Error::Core(bouncing_disk_core::Error::Stopped { done, total }))) => {
            Some(Progress { done: *done, total: *total })
        }
        _ => None,
    }
}

/// Checks a call with this many items on 1, 2 and 7 threads (if it is not one of several parts), stopped at
/// observer calls from the first to the last. The call must report how far it was, or return the same result as
/// without an observer. Returns how often one thread calls the observer, and its progress.
pub(crate) fn check_stops<T: PartialEq + Debug + Send + Sync, E: Into<FitError>>(
    items: impl Into<Option<u64>>,
    call: impl Fn(&dyn Observer) -> Result<T, E> + Sync,
) -> (u64, Vec<u64>) {
    let items = items.into();
    let call = |observer: &dyn Observer| call(observer).map_err(Into::into);
    let whole = call(&Unobserved).expect("no failure");
    let (mut asked, mut all_done) = (0, Vec::new());
    for threads in [1, 2, 7] {
        let patient = StopAfter::calls(u64::MAX, items);
        assert_eq!(on(threads, || call(&patient)).as_ref(), Ok(&whole), "{threads} threads");
        let (all, last) = patient.seen();
        assert!(all > 1 && items.is_none_or(|items| last.done == items), "{all} calls, last {last:?}");
        let mut stops = 0;
        for calls in [1, 2, 3, all / 2, all - 1, all] {
            let observer = StopAfter::calls(calls, items);
            let result = on(threads, || call(&observer));
            let at = format!("{threads} threads, stopped at call {calls} of {all}: {:?}", observer.seen());
            if let Ok(found) = &result {
                assert!(*found == whole && calls > 1, "{at}");
                // For a single part, only the answer after all items does not matter.
                assert!(calls + 1 >= all || threads > 1 || items.is_none(), "{at}");
                continue;
            }
            let Some(Progress { done, total }) = stopped(&result) else { panic!("{at}: {result:?}") };
            assert!(done <= total && items.is_none_or(|items| total == items), "{at}: {done} of {total}");
            assert!(done == 0 || calls > 1, "{at}: {done}");
            // The observer is not called again, except after a part that was completed anyway.
            assert!(threads > 1 || observer.seen().0 <= calls + 1, "{at}");
            stops += 1;
            if threads == 1 {
                asked = all;
                all_done.push(done);
            }
        }
        assert!(stops >= if all > 3 && threads == 1 { 2 } else { 1 }, "{threads} threads: {stops}");
    }
    (asked, all_done)
}

/// Checks a call with this many items, the first of which would take a very long time, stopped on its way.
pub(crate) fn check_endless<T: Debug + Send, E: Into<FitError>>(
    items: u64,
    call: impl Fn(&dyn Observer) -> Result<T, E> + Sync,
) {
    for threads in [1, 2, 7] {
        let result = on(threads, || call(&StopAfter::calls(5, Some(items))).map_err(Into::into));
        assert_eq!(stopped(&result), Some(Progress { done: 0, total: items }), "{result:?}");
    }
}

/// Well spread numbers in [0, 1).
pub(crate) fn golden_spread(k: u64) -> f64 {
    (k as f64 * 0.618_033_988_749_894_9) % 1.0
}

/// A number between `low` and `high` with a uniformly distributed logarithm.
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

/// Systems of every kind: still, gentle, lively or violent; without twist, friction, rebound or load.
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
        // The paper's cut has no rule for a disk that hits hard and does not rebound: the core returns
        // `NoLiftOff`.
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

    /// Autocorrelated numbers of deviation 1, each with the share `memory` of the previous one.
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
