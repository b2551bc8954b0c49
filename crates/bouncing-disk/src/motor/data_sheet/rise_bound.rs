//! How high a rotor can fly: a bound for all flights (docs/numerics-dynamics.md, "A bound on flight heights").
//!
//! In the model's units, let V be the rotor's absolute upward velocity just after an impact, and U, |U| <= P,
//! the platform's. Launch and impact are both on the platform, so their heights differ by at most 2 P, and
//! the speed v at the next impact obeys v^2 <= V^2 + 4 P. By the impact law, V' = U + r (U - v^) = (1 + r) U -
//! r v^ with the velocity v^ >= -v before the impact, so
//!
//! ```text
//! V' <= (1 + r) P + r sqrt(V^2 + 4 P) = f(|V|).
//! ```
//!
//! After an impact the rotor moves upwards relative to the platform, V' >= U >= -P, so a downward velocity is
//! bounded by P <= f as well. The function f rises with a slope below r < 1 and has a single fixed point V\*,
//! called M in docs/numerics-dynamics.md, "Bounded speeds":
//!
//! ```text
//! V* = (P + r sqrt(P^2 + 4 P (1 - r)/(1 + r)))/(1 - r).
//! ```
//!
//! *From rest.* A separation has V <= P <= V\*, and |V| <= V\* implies |V'| <= f(V\*) = V\*: no impact of a
//! motor that starts at rest exceeds V\*, however it chatters and rests. A relaunch perturbed by a relative
//! speed s has V <= P + s, which is also below V\* for s <= V\* - P. A motor that lifts off has P > 1 and V\* -
//! P > 2 r, so the default of 1e-3 is covered for r >= 0.0005; for smaller r, V\* grows by at most s.
//!
//! *Attractors.* On a bounded set that the motion maps onto itself, let M be the least upper bound of |V|.
//! Each state has a predecessor in the set, so M <= f(M), hence M <= V\*. This covers attractors that no
//! motor reaches from rest.
//!
//! The height above the middle of the platform's motion is at most P at the launch, rises by at most V^2/2 and is never
//! below -P: |z| <= P + V\*^2/2.
//!
//! At P = 200 and r = 0, 0.1 and 0.5 the fastest of 20,000 impacts reached little more than half of V\*, and
//! hence a quarter of the height. The tests follow orbits for forcings up to 1e5 and restitutions up to 1 -
//! 1e-9.

/// Relative increase of the bound to cover the rounding of its own few operations.
const ROUNDING: f64 = 1.0e-12;

/// A bound on the upward speed after any impact (units of g/omega), for peak acceleration P >= 0 and a
/// restitution r in [0, 1): V = (P + r sqrt(P^2 + 4 P (1 - r)/(1 + r)))/(1 - r).
pub(crate) fn highest_speed(peak_acceleration: f64, restitution: f64) -> f64 {
    let (p, r) = (peak_acceleration, restitution);
    let root = (p * p + 4.0 * p * (1.0 - r) / (1.0 + r)).sqrt();
    (p + r * root) / (1.0 - r) * (1.0 + ROUNDING)
}

/// A bound on the height above the middle of the platform's motion (units of g/omega^2): P + V^2/2.
pub(crate) fn highest_rise(peak_acceleration: f64, restitution: f64) -> f64 {
    let speed = highest_speed(peak_acceleration, restitution);
    // A rotor that never leaves the platform from rest rises with it; the bound also holds for thrown rotors.
    (peak_acceleration + 0.5 * speed * speed) * (1.0 + ROUNDING)
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::numerics::random::SplitMix64;
    use bouncing_disk_core::{ChatterPolicy, ImpactMap, Launch, OrbitEvent, Vibration};

    use super::*;

    const RESTITUTIONS: [f64; 6] = [0.0, 0.1, 0.5, 0.8, 0.95, 1.0 - 1e-9];

    /// The bound is reached if the worst case repeats: the closed form solves the equation that defines the
    /// bound.
    #[test]
    fn the_bound_is_the_fixed_point_of_the_worst_case() {
        for r in [0.0, 0.1, 0.5, 0.8, 0.95] {
            for p in [0.0, 1e-300, 1e-3, 0.5, 1.0, 3.0, 200.0, 1e8] {
                let mut speed = 0.0_f64;
                for _ in 0..2_000 {
                    speed = (1.0 + r) * p + r * (speed * speed + 4.0 * p).sqrt();
                }
                let bound = highest_speed(p, r);
                assert!((bound - speed).abs() <= 1e-11 * speed, "{p} {r}: {bound} {speed}");
            }
        }
    }

    /// The largest upward speed and height of an orbit of many impacts from rest.
    fn largest(p: f64, r: f64) -> (f64, f64) {
        let vibration = Vibration::new(p).expect("legal");
        let map = ImpactMap::new(vibration, r).expect("legal");
        let start = Launch::new(vibration.separation_phase().expect("P > 1"), 0.0).expect("legal");
        let mut orbit = map.orbit_from_launch(start, ChatterPolicy::Complete);
        let mut random = SplitMix64::new(7);
        let (mut fastest, mut highest) = (0.0_f64, 0.0_f64);
        for _ in 0..20_000 {
            if let Some(launch) = orbit.launch() {
                let upwards = launch.relative_speed() + vibration.velocity(launch.phase());
                fastest = fastest.max(upwards);
                let rise = 0.5 * upwards.max(0.0) * upwards;
                highest = highest.max(vibration.height(launch.phase()) + rise);
            }
            if let Some(OrbitEvent::Attachment(_)) = orbit.advance().expect("no failure") {
                // Other members of an ensemble: the speed from rest stays below the platform's.
                orbit.perturb_launch(1e-9 * random.unit()).expect("legal");
            }
        }
        (fastest, highest)
    }

    #[test]
    fn no_orbit_from_rest_exceeds_the_bound() {
        for r in RESTITUTIONS {
            for p in [1.0 + 1e-9, 1.1, 1.5, 2.0, 5.0, 20.0, 200.0, 1e5] {
                let (fastest, highest) = largest(p, r);
                assert!(fastest <= highest_speed(p, r) + 1e-9, "{p} {r}: {fastest}");
                assert!(highest <= highest_rise(p, r) + 1e-9, "{p} {r}: {highest}");
            }
        }
    }

    /// The bound is useful, because a lively orbit comes near it.
    #[test]
    fn some_orbits_come_near_the_bound() {
        for r in [0.0, 0.1, 0.5] {
            let (fastest, _) = largest(200.0, r);
            assert!(fastest > 0.5 * highest_speed(200.0, r), "{r}: {fastest}");
        }
    }
}
