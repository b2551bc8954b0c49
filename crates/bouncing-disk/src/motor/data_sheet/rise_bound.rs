//! How high a rotor can fly: a bound for all flights, derived in docs/numerics/motors.md, "How high a rotor flies".

/// Share by which the bound is raised for the rounding of its own few operations.
const ROUNDING: f64 = 1.0e-12;

/// A bound on the upward speed after any impact (units of g/omega), for peak acceleration P >= 0 and a restitution r in
/// [0, 1): V = (P + r sqrt(P^2 + 4 P (1 - r)/(1 + r)))/(1 - r).
pub(super) fn highest_speed(peak_acceleration: f64, restitution: f64) -> f64 {
    let (p, r) = (peak_acceleration, restitution);
    let root = (p * p + 4.0 * p * (1.0 - r) / (1.0 + r)).sqrt();
    (p + r * root) / (1.0 - r) * (1.0 + ROUNDING)
}

/// A bound on the height above the middle of the platform's motion (units of g/omega^2): P + V^2/2.
pub(super) fn highest_rise(peak_acceleration: f64, restitution: f64) -> f64 {
    let speed = highest_speed(peak_acceleration, restitution);
    // A rotor that never leaves the platform from rest rises with it; the bound holds for those that were thrown, too.
    (peak_acceleration + 0.5 * speed * speed) * (1.0 + ROUNDING)
}
