//! W2: the motor of Table III ([`System::motor`]). The time is that of one motor second.

use std::f64::consts::TAU;
use std::hint::black_box;

use bouncing_disk::core::{Phase, Unobserved};
use bouncing_disk::motor::{OperatingSettings, TransientMember, TransientSettings, transient, transients};
use bouncing_disk::parameters::{Contact, StatorParameters};
use bouncing_disk::{Motor, System};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// Motor seconds of one transient.
const DURATION: u32 = 10;
/// Transients of an ensemble.
const MEMBERS: u32 = 512;
/// Motor seconds of each.
const MEMBER_DURATION: u32 = 2;

fn w2(c: &mut Criterion) {
    let system = System::motor();
    let phase = Phase::new(4.0).expect("finite");
    let settings =
        TransientSettings { duration: f64::from(DURATION), seed: 0, ..TransientSettings::default() };
    let mut group = c.benchmark_group("w2");
    group.throughput(Throughput::Elements(u64::from(DURATION)));
    let mut seed = 0;
    // Another seed every time: the mean over the orbits that rounding or a perturbation may choose.
    group.bench_function("one_motor", |bencher| {
        bencher.iter(|| {
            seed += 1;
            black_box(
                transient(&system, phase, &TransientSettings { seed, ..settings }, &Unobserved)
                    .expect("no failure"),
            )
        });
    });
    group.sample_size(10).throughput(Throughput::Elements(u64::from(MEMBER_DURATION * MEMBERS)));
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        group.bench_function(format!("ensemble/threads_{threads}"), |bencher| {
            bencher.iter(|| {
                let members: Vec<_> = (0..MEMBERS)
                    .map(|index| {
                        seed += 1;
                        let duration = f64::from(MEMBER_DURATION);
                        let angle = TAU * (f64::from(index) + 0.5) / f64::from(MEMBERS);
                        TransientMember {
                            system,
                            phase: Phase::new(angle).expect("finite"),
                            settings: TransientSettings { duration, seed, ..settings },
                        }
                    })
                    .collect();
                black_box(pool.install(|| transients(&members, &Unobserved)))
            });
        });
    }
    group.finish();
}

/// A torque-speed curve of 30 loads whose speeds have standard errors of 1 % of the speed without load.
fn torque_speed_curve(c: &mut Criterion) {
    let motor = Motor::paper_70_khz();
    let loads: Vec<f64> = (0..30).map(|k| motor.largest_torque() * f64::from(k) / 31.0).collect();
    let mut group = c.benchmark_group("torque_speed_curve");
    group.sample_size(10);
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        let mut seed = 0;
        group.bench_function(format!("threads_{threads}"), |bencher| {
            bencher.iter(|| {
                seed += 1;
                let settings = OperatingSettings { seed, ..OperatingSettings::default() };
                black_box(
                    pool.install(|| motor.torque_speed_curve(&loads, &settings, &Unobserved))
                        .expect("no failure"),
                )
            });
        });
    }
    group.finish();
}

/// An operating point with contacts that take so many periods, against rigid impacts: one rotor from either side
/// on each of four vertical motions, on one thread, per motor second.
fn contact(c: &mut Criterion) {
    let settings =
        OperatingSettings { members: 4, relative_error: 1e-6, most_impacts: 100_000, ..Default::default() };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread starts");
    let mut group = c.benchmark_group("contact");
    group.sample_size(10);
    for periods in [0.0, 0.05, 0.5, 1.0, 2.0] {
        let contact = (periods > 0.0).then(|| Contact::lasting(periods / 70e3));
        let motor = Motor::paper_70_khz().with(|sheet| sheet.contact = contact).expect("legal");
        let operate =
            || pool.install(|| motor.torque_speed_curve(&[0.0], &settings, &Unobserved)).expect("no failure");
        let point = *operate()[0].point().expect("it does not run away");
        let followed = point.averaged_time + 4.0 * point.start_up;
        // In microseconds of the motor: the throughput in millions a second is motor seconds a second.
        group.throughput(Throughput::Elements((1e6 * followed) as u64));
        group.bench_function(format!("periods_{periods}"), |bencher| bencher.iter(|| black_box(operate())));
    }
    group.finish();
}

/// The run-up of a motor with 0.1 um without a rotor on a stator of 50 g with a quality factor of 300, against one whose
/// motion is prescribed; three motor seconds.
fn stator(c: &mut Criterion) {
    let prescribed = Motor::paper_70_khz().with(|sheet| sheet.amplitude = Some(1e-7)).expect("legal");
    let (mass, quality) = (Some(0.05), Some(300.0));
    let modes = StatorParameters { mass, quality, ..StatorParameters::default() };
    let yielding = prescribed.with(|sheet| sheet.stator = Some(modes)).expect("legal");
    let mut group = c.benchmark_group("stator");
    group.sample_size(20);
    group.throughput(Throughput::Elements(3_000_000));
    let mut seed = 0;
    let mut settings = || {
        seed += 1;
        TransientSettings { seed, ..TransientSettings::default() }
    };
    let phase = |settings: &TransientSettings| Phase::new(settings.seed as f64).expect("finite");
    group.bench_function("prescribed", |bencher| {
        bencher.iter(|| {
            let settings = settings();
            black_box(
                transient(prescribed.system(), phase(&settings), &settings, &Unobserved).expect("no failure"),
            )
        });
    });
    group.bench_function("yielding", |bencher| {
        bencher.iter(|| {
            let settings = settings();
            black_box(yielding.transient(phase(&settings), &settings, &Unobserved).expect("no failure"))
        });
    });
    group.finish();
}

criterion_group!(benches, w2, torque_speed_curve, contact, stator);
criterion_main!(benches);
