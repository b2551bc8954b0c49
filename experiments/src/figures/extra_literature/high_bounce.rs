//! The map in which the height of the platform does not matter: a flight lasts twice the speed after the impact.
//!
//! It knows no first impact and no rest, and may leave a disk below the platform (docs/numerics/dynamics.md, "The
//! high-bounce map").

use std::f64::consts::{PI, TAU};

use bouncing_disk::core::TangentGrowth;
use bouncing_disk::core::elementary::{cos, sin_cos, wrapped_angle};
use glam::DMat2;

/// Impacts before an orbit is judged, and those that it is judged by.
const TRANSIENT: usize = 5_000;
const IMPACTS: usize = 5_000;
/// The longest period that is looked for, and how near a return must come.
const LONGEST_PERIOD: usize = 64;
const TOLERANCE: f64 = 1.0e-7;

/// The high-bounce map: phase and own speed after an impact, in the units of the exact map.
#[derive(Clone, Copy, Debug)]
pub(super) struct HighBounceMap {
    pub(super) peak_acceleration: f64,
    pub(super) restitution: f64,
}

/// What an orbit of the high-bounce map does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct HighBounceOrbit {
    /// Its smallest period in impacts, if it repeats itself.
    pub(super) period: Option<usize>,
    /// The largest Lyapunov exponent per impact; none where it has no finite one.
    pub(super) exponent: Option<f64>,
    /// The share of its impacts that leave the disk slower than the platform, which no disk can be.
    pub(super) impossible_share: f64,
}

impl HighBounceMap {
    /// The peak acceleration at which the orbit with an impact every k periods doubles, in closed form: P sin tau = 1.
    pub(super) fn first_doubling(restitution: f64, platform_periods: u32) -> f64 {
        let birth = birth(restitution, platform_periods);
        (birth * birth + 1.0).sqrt()
    }

    /// The next impact.
    pub(super) fn step(&self, (phase, speed): (f64, f64)) -> (f64, f64) {
        let next = wrapped_angle(phase + 2.0 * speed);
        let kick = (1.0 + self.restitution) * self.peak_acceleration;
        (next, self.restitution * speed + kick * cos(next))
    }

    /// The derivative of the next impact, which has this phase, by the one before.
    pub(super) fn derivative(&self, next_phase: f64) -> DMat2 {
        let (sine, _) = sin_cos(next_phase);
        let slope = -(1.0 + self.restitution) * self.peak_acceleration * sine;
        DMat2::from_cols_array(&[1.0, slope, 2.0, self.restitution + 2.0 * slope])
    }

    /// What the orbit from this impact does.
    pub(super) fn orbit(&self, start: (f64, f64)) -> HighBounceOrbit {
        let mut state = start;
        for _ in 0..TRANSIENT {
            state = self.step(state);
        }
        let settled = state;
        let (mut growth, mut impossible, mut period) = (TangentGrowth::default(), 0, None);
        for impact in 1..=IMPACTS {
            state = self.step(state);
            growth.grow(self.derivative(state.0));
            impossible += usize::from(state.1 < self.peak_acceleration * cos(state.0));
            let turned = wrapped_angle(state.0 - settled.0);
            let apart = turned.min(TAU - turned).max((state.1 - settled.1).abs());
            if period.is_none() && impact <= LONGEST_PERIOD && apart < TOLERANCE {
                period = Some(impact);
            }
        }
        HighBounceOrbit {
            period,
            exponent: growth.exponent().filter(|exponent| exponent.is_finite()),
            impossible_share: impossible as f64 / IMPACTS as f64,
        }
    }

    /// What orbits from a grid of starts do, n phases by n speeds up to P (1 + r)/(1 - r), which none exceeds for good.
    pub(super) fn orbits(&self, n: u32) -> Vec<HighBounceOrbit> {
        let fastest = (1.0 + self.restitution) / (1.0 - self.restitution) * self.peak_acceleration;
        let middle = |index: u32| (f64::from(index) + 0.5) / f64::from(n);
        let starts = (0..n * n).map(|index| (TAU * middle(index % n), fastest * middle(index / n)));
        starts.map(|start| self.orbit(start)).collect()
    }

    /// In words: how many of the orbits do what.
    pub(super) fn words(&self, n: u32) -> String {
        let orbits = self.orbits(n);
        let mut periods: Vec<usize> = orbits.iter().filter_map(|orbit| orbit.period).collect();
        periods.sort_unstable();
        periods.dedup();
        let of = |period: usize| orbits.iter().filter(|orbit| orbit.period == Some(period)).count();
        let mut parts: Vec<String> = periods
            .iter()
            .map(|&period| format!("period {period} ({} of {})", of(period), orbits.len()))
            .collect();
        let others: Vec<f64> =
            orbits.iter().filter(|orbit| orbit.period.is_none()).filter_map(|orbit| orbit.exponent).collect();
        if let Some(largest) = others.iter().copied().reduce(f64::max) {
            parts.push(format!("no period, exponent {largest:.2} ({} of {})", others.len(), orbits.len()));
        }
        let impossible = orbits.iter().map(|orbit| orbit.impossible_share).fold(0.0, f64::max);
        if impossible > 0.0 {
            parts.push(format!(
                "up to {:.0} % of the impacts leave it below the platform",
                100.0 * impossible
            ));
        }
        parts.join("; ")
    }
}

/// The peak acceleration at which the orbits with an impact every k periods are born, in both maps.
pub(super) fn birth(restitution: f64, platform_periods: u32) -> f64 {
    f64::from(platform_periods) * PI * (1.0 - restitution) / (1.0 + restitution)
}

#[cfg(test)]
mod tests {
    use super::*;
    use bouncing_disk::core::Multipliers;
    use bouncing_disk::core::elementary::atan2;

    /// The multipliers of the orbit with an impact every k periods that attracts at first; none below its birth.
    fn period_one_multipliers(map: &HighBounceMap, platform_periods: u32) -> Option<Multipliers> {
        let cosine = birth(map.restitution, platform_periods) / map.peak_acceleration;
        let phase = atan2((1.0 - cosine * cosine).sqrt(), cosine);
        (cosine <= 1.0).then(|| Multipliers::of(map.derivative(phase)))
    }

    #[test]
    fn the_orbit_with_one_impact_doubles_where_the_closed_form_says() {
        for (restitution, k) in [(0.1, 1), (0.3, 2), (0.5, 1), (0.9, 5)] {
            let doubling = HighBounceMap::first_doubling(restitution, k);
            let radius = |peak_acceleration: f64| {
                let map = HighBounceMap { peak_acceleration, restitution };
                period_one_multipliers(&map, k).map(|multipliers| multipliers.spectral_radius())
            };
            assert!(radius(doubling * (1.0 - 1e-9)).is_some_and(|radius| radius < 1.0), "{restitution}");
            assert!(radius(doubling * (1.0 + 1e-9)).is_some_and(|radius| radius > 1.0), "{restitution}");
            assert_eq!(radius(birth(restitution, k) * (1.0 - 1e-9)), None);
        }
    }

    #[test]
    fn the_derivative_is_that_of_a_step_and_contracts_by_the_restitution() {
        let map = HighBounceMap { peak_acceleration: 1.7, restitution: 0.6 };
        let (start, small) = ((1.1, 2.3), 1e-6);
        let next = map.step(start);
        let derivative = map.derivative(next.0);
        assert!((derivative.determinant() - 0.6).abs() < 1e-14);
        let by_phase = map.step((start.0 + small, start.1));
        let by_speed = map.step((start.0, start.1 + small));
        let slopes =
            [by_phase, by_speed].map(|(phase, speed)| [(phase - next.0) / small, (speed - next.1) / small]);
        for (slope, expected) in slopes.concat().iter().zip(derivative.to_cols_array()) {
            assert!((slope - expected).abs() < 1e-4, "{slope} {expected}");
        }
    }

    #[test]
    fn an_orbit_is_periodic_before_the_doubling_and_chaotic_far_beyond() {
        let orbit = |factor: f64| {
            let peak_acceleration = factor * HighBounceMap::first_doubling(0.5, 1);
            HighBounceMap { peak_acceleration, restitution: 0.5 }.orbit((0.8, PI))
        };
        assert_eq!(orbit(0.99).period, Some(1));
        assert_eq!(orbit(1.01).period, Some(2));
        let chaotic = orbit(4.0);
        assert_eq!(chaotic.period, None);
        assert!(chaotic.exponent.is_some_and(|exponent| exponent > 0.0) && chaotic.impossible_share > 0.0);
    }
}
