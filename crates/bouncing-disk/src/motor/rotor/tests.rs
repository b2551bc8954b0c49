use bouncing_disk_core::ImpactState;
use bouncing_disk_core::numerics::elementary::pow;

use super::*;
use crate::motion::engine::Engine;
use crate::motion::initial_condition::InitialCondition;
use crate::parameters::dimensionless::DimensionlessParameters;
use crate::testing::golden_spread;

/// A chatter ends with the same angular speed as in the engine, also for restitutions near 1.
#[test]
fn a_long_chatter_ends_as_in_the_engine() {
    let mut count = 0;
    for restitution in [0.5, 0.99, 0.9999, 1.0 - 1e-7, 1.0 - 1e-12, 1.0 - f64::EPSILON / 2.0] {
        for k in 0..300_u64 {
            let pick = |stride: u64| golden_spread(stride * k + stride / 3);
            let system = DimensionlessParameters {
                peak_acceleration: [0.0, 0.5, 2.0][(k % 3) as usize],
                twist_speed: [0.0, 0.3, 3.0][(k / 3 % 3) as usize],
                phase_lag: 6.0 * pick(5) - 3.0,
                friction: 0.3,
                restitution,
                load: [0.0, 0.2, -0.4][(k / 9 % 3) as usize],
            }
            .build()
            .unwrap();
            let phase = Phase::new(std::f64::consts::TAU * pick(11)).unwrap();
            let speed = pow(10.0, -30.0 * pick(3));
            let launch = Launch::new(phase, speed).unwrap();
            let Some(at) = system.map().accumulation(launch) else { continue };
            let slip = [0.0, 1.0, at.duration * (pick(13) - 0.5)][(k % 3) as usize];
            let spin = system.platform_angular_speed(phase) + slip;
            // The motion of a disk launched here after an impact: both continue from the same one.
            let impact = ImpactState::new(phase, -speed / restitution).unwrap();
            let orbit = system.map().orbit(impact, ChatterPolicy::Complete);
            if orbit.launch().is_some() {
                continue;
            }
            let mut rotor = Rotor::at_rest(&system, phase, spin, ChatterPolicy::Complete).unwrap();
            rotor.contact = None;
            rotor.go_on_after(phase, orbit.clone(), 0, spin);
            assert_eq!(rotor.advance().unwrap(), RotorStep::Contact);
            let start = InitialCondition::Launch { phase, relative_speed: speed, angular_speed: spin };
            let engine = Engine::new(system, start, ChatterPolicy::Complete).unwrap();
            let record = engine.attached_after(orbit);
            let scale = system.twist_speed() + spin.abs() + 2.0 * at.duration;
            let off = rotor.speed() - record.after.angular_speed;
            assert!(off.abs() <= 1e-14 * scale, "{off:e} {k} {restitution}");
            count += 1;
        }
    }
    assert!(count > 300, "{count}");
}
