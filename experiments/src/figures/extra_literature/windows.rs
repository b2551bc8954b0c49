//! Where the orbits with one impact attract, in closed form (docs/numerics/dynamics.md, "Orbits with one impact").

use std::f64::consts::PI;

use bouncing_disk::core::numerics::roots::bisection;

use super::behaviour::map;
use super::high_bounce::birth;
use crate::experiment::ExperimentError;

/// The peak accelerations between which the orbit with an impact every k periods attracts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Window {
    pub(super) birth: f64,
    pub(super) doubling: f64,
}

impl Window {
    pub(super) fn of(restitution: f64, platform_periods: u32) -> Self {
        let birth = birth(restitution, platform_periods);
        let height = doubling_height(restitution);
        Self { birth, doubling: (birth * birth + height * height).sqrt() }
    }

    pub(super) fn holds(&self, peak_acceleration: f64) -> bool {
        self.birth < peak_acceleration && peak_acceleration < self.doubling
    }
}

/// P sin tau where an orbit with one impact doubles, for every k.
pub(super) fn doubling_height(restitution: f64) -> f64 {
    let sum = 1.0 + restitution;
    2.0 * (1.0 + restitution * restitution) / (sum * sum)
}

/// cos tau where the orbit with an impact in each period doubles.
pub(super) fn cosine_at_doubling(restitution: f64) -> f64 {
    birth(restitution, 1) / Window::of(restitution, 1).doubling
}

/// The restitution above which the orbits of k = 1 and k = 2 attract at the same forcing: the first one still does where the
/// second is born. From the multipliers.
pub(super) fn first_shared_restitution() -> Result<f64, ExperimentError> {
    bisection(0.1, 0.9, 60, |restitution| {
        let map = map(2.0 * PI * (1.0 - restitution) / (1.0 + restitution), restitution)?;
        let pair = map.period_one_pair(1).ok_or_else(|| super::paper::lost("period-1 orbit"))?;
        Ok(pair.node.multipliers().spectral_radius() >= 1.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_window_is_that_of_the_multipliers() {
        for (restitution, k) in [(0.2, 1), (0.5, 1), (0.3, 3), (0.9, 7)] {
            let window = Window::of(restitution, k);
            let radius = |peak: f64| {
                let map = map(peak, restitution).expect("legal");
                map.period_one_pair(k.into()).map(|pair| pair.node.multipliers().spectral_radius())
            };
            assert_eq!(radius(window.birth * (1.0 - 1e-12)), None);
            assert!(radius(window.birth * (1.0 + 1e-9)).is_some_and(|radius| radius < 1.0));
            assert!(radius(window.doubling * (1.0 - 1e-9)).is_some_and(|radius| radius < 1.0));
            assert!(radius(window.doubling * (1.0 + 1e-9)).is_some_and(|radius| radius > 1.0));
            assert!(window.holds(0.5 * (window.birth + window.doubling)));
            assert!(!window.holds(window.birth) && !window.holds(window.doubling));
        }
    }

    #[test]
    fn the_first_shared_restitution_is_that_of_its_formula() {
        let root = 3.0_f64.sqrt() * PI;
        let closed = ((root - 2.0) / (root + 2.0)).sqrt();
        assert!((first_shared_restitution().expect("found") - closed).abs() < 1e-12);
    }
}
