//! The detection of impacts that come near an earlier one.

use super::VerdictSettings;
use crate::map::impact_map::ImpactState;
use crate::orbits::periodic::phase_difference;

/// Fewest further impacts before the next return counts, after a return that proved nothing. The total wait
/// is this number plus half of all impacts so far.
const LEAST_WAIT: u64 = 16;

/// Compares each impact with one reference (R. P. Brent, BIT 20, 176 (1980)). The reference is renewed after
/// 1, 2, 4, ... impacts, up to the longest period. So short periods are found early, and only one impact is
/// kept.
#[derive(Debug, Clone)]
pub(crate) struct Returns {
    reference: Option<ImpactState>,
    /// Impacts since the reference, and the number after which it is renewed.
    age: usize,
    window: usize,
    /// Passes of the phase through 0 since the reference.
    turns: u64,
    /// Impacts so far, and the number after which the next return counts.
    impacts: u64,
    wait: u64,
    /// The nearest return to this reference and to the last one: distance and impacts.
    nearest: [Option<(f64, usize)>; 2],
}

impl Returns {
    pub(crate) const fn new() -> Self {
        Self { reference: None, age: 0, window: 1, turns: 0, impacts: 0, wait: 0, nearest: [None; 2] }
    }

    /// Receives the next impact, before which the phase passed 0 `turns` times. If this impact is a return,
    /// the result is the number of impacts since the reference.
    #[inline]
    pub(crate) fn see(
        &mut self,
        state: ImpactState,
        turns: u64,
        settings: &VerdictSettings,
    ) -> Option<usize> {
        self.impacts += 1;
        let Some(reference) = self.reference else {
            self.reference = Some(state);
            return None;
        };
        self.age += 1;
        self.turns += turns;
        let age = self.age;
        let speed = 1.0 + reference.velocity().abs();
        let phase = phase_difference(state.phase().angle(), reference.phase().angle()).abs();
        let distance = phase.max((state.velocity() - reference.velocity()).abs() / speed);
        // Impacts of one chatter are close to each other, but not returns.
        let counts = self.turns > 0;
        if counts && self.nearest[0].is_none_or(|(least, _)| distance < least) {
            self.nearest[0] = Some((distance, age));
        }
        if age >= self.window {
            (self.reference, self.age, self.turns) = (Some(state), 0, 0);
            self.window = (2 * self.window).min(settings.longest_period);
            self.nearest = [None, self.nearest[0].or(self.nearest[1])];
        }
        (counts && distance <= settings.tolerance && self.impacts >= self.wait).then_some(age)
    }

    /// Notes that a return proved nothing.
    pub(super) const fn reject(&mut self) {
        self.wait = self.impacts + self.impacts / 2 + LEAST_WAIT;
    }

    /// The distance of the nearest return, and its number of impacts.
    pub(super) fn nearest(&self) -> Option<(f64, usize)> {
        self.nearest.into_iter().flatten().min_by(|one, other| one.0.total_cmp(&other.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flight::platform::phase::Phase;

    fn state(angle: f64, velocity: f64) -> ImpactState {
        ImpactState::new(Phase::new(angle).expect("legal"), velocity).expect("legal")
    }

    /// Each period is found within four periods, but no period longer than the limit.
    #[test]
    fn every_period_up_to_the_longest_is_found() {
        for period in [1_usize, 2, 3, 5, 7, 16, 31, 64, 65] {
            let settings = VerdictSettings { longest_period: 64, ..VerdictSettings::default() };
            let mut returns = Returns::new();
            let impact = |k: usize| state(0.05 * (k % period) as f64, -1.0);
            let found = (0..1_000).find_map(|k| Some((k, returns.see(impact(k), 1, &settings)?)));
            if period > 64 {
                assert_eq!((found, returns.nearest().is_some()), (None, true));
            } else {
                let (after, age) = found.expect("repeats");
                assert!(age == period && after <= 4 * period, "{period}: {age} after {after}");
            }
        }
    }

    #[test]
    fn the_seam_of_the_phase_is_no_distance_and_a_chatter_no_return() {
        let settings = VerdictSettings { tolerance: 1e-6, ..VerdictSettings::default() };
        let mut returns = Returns::new();
        assert_eq!(returns.see(state(1e-8, -1.0), 0, &settings), None);
        assert_eq!(returns.see(state(core::f64::consts::TAU - 1e-8, -1.0), 1, &settings), Some(1));
        let mut returns = Returns::new();
        assert!((0..100).all(|_| returns.see(state(1.0, -1e-9), 0, &settings).is_none()));
        assert_eq!(returns.nearest(), None);
    }

    /// A return that proved nothing is not tried again at every impact.
    #[test]
    fn after_a_rejection_another_return_is_waited_for() {
        let settings = VerdictSettings::default();
        let mut returns = Returns::new();
        let mut tried = 0;
        for _ in 0..100_000 {
            if returns.see(state(1.0, -1.0), 1, &settings).is_some() {
                returns.reject();
                tried += 1;
            }
        }
        assert!((5..40).contains(&tried), "{tried}");
    }

    /// The nearest return is found among the returns to the last two references.
    #[test]
    fn the_nearest_return_has_its_impacts() {
        let settings = VerdictSettings { longest_period: 8, ..VerdictSettings::default() };
        let mut returns = Returns::new();
        for k in 0..50 {
            // Period 3 with a drift.
            let _ = returns.see(state(0.5 * f64::from(k % 3) + 1e-4 * f64::from(k), -1.0), 1, &settings);
        }
        assert!(matches!(returns.nearest(), Some((_, 3))), "{:?}", returns.nearest());
    }
}
