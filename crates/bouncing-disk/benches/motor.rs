//! Ten seconds of the motor of Table III (70 kHz, A = 1e-8 m, g = 9.8 m/s^2, restitution 0.5, friction 0.1).

use std::f64::consts::TAU;
use std::hint::black_box;

use bouncing_disk::core::Phase;
use bouncing_disk::{
    DiskParameters, PlatformParameters, System, TransientMember, TransientSettings, transient, transients,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

fn motor() -> System {
    let angular_frequency = TAU * 70e3;
    let platform = PlatformParameters {
        amplitude: 1e-8,
        twist_amplitude: 30.0 / angular_frequency,
        angular_frequency,
        phase_lag: 0.0,
    };
    let disk = DiskParameters {
        contact_radius: 1.25e-3,
        gyration_radius: 6.3e-3,
        friction: 0.1,
        restitution: 0.5,
        preload_acceleration: 9.8,
        load_acceleration: 0.0,
    };
    System::new(platform.build().expect("legal"), disk.build().expect("legal")).expect("legal system")
}

fn motor_second(c: &mut Criterion) {
    let system = motor();
    let phase = Phase::new(4.0).expect("finite");
    let mut seed = 0;
    // Another seed every time: the mean over the orbits that rounding or a perturbation may choose.
    c.bench_function("w2_ten_motor_seconds", |bencher| {
        bencher.iter(|| {
            seed += 1;
            let settings = TransientSettings { duration: 10.0, seed, ..TransientSettings::default() };
            black_box(transient(&system, phase, &settings))
        });
    });
}

/// Elements are motor seconds.
fn ensemble(c: &mut Criterion) {
    const MEMBERS: u32 = 64;
    let system = motor();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread");
    let mut group = c.benchmark_group("w2");
    group.sample_size(20).throughput(Throughput::Elements(10 * u64::from(MEMBERS)));
    let mut seed = 0;
    group.bench_function("ensemble", |bencher| {
        bencher.iter(|| {
            let members: Vec<_> = (0..MEMBERS)
                .map(|index| {
                    seed += 1;
                    let settings = TransientSettings { duration: 10.0, seed, ..TransientSettings::default() };
                    let angle = TAU * (f64::from(index) + 0.5) / f64::from(MEMBERS);
                    TransientMember { system, phase: Phase::new(angle).expect("finite"), settings }
                })
                .collect();
            black_box(pool.install(|| transients(&members)))
        });
    });
    group.finish();
}

criterion_group!(benches, motor_second, ensemble);
criterion_main!(benches);
