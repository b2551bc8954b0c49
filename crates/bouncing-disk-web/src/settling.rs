//! Whether an orbit is still settling.

/// Changes from round to round that are rounding, relative to the largest value.
const ROUNDING: f64 = 1.0e-12;

/// How much further than before a value may move on: of two motions that both settle, say spin and impact,
/// one disturbs the other.
const LARGEST_GROWTH: f64 = 1.05;

/// The fewest rounds from which an approach can be judged.
const FEWEST_ROUNDS: usize = 4;

/// Whether the values, one of each impact, are still on their way to values that repeat: every `period`
/// impacts, for some period up to `longest_period`, each has moved in the same direction as before, hardly
/// further than before, and by more than `tolerance` in all.
///
/// Near a period doubling or a fold, where a multiplier is near 1 or -1, an orbit needs many impacts to
/// settle, and a record after a fixed number of them is a transient; so is the spin of a disk that slides in
/// each impact. Values that repeat, are chaotic or spiral in are not on their way in this sense; the latter
/// settle as fast as the impacts lose energy.
pub(crate) fn is_settling(values: &[f64], longest_period: usize, tolerance: f64) -> bool {
    let largest = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let slack = ROUNDING * largest;
    let comes_nearer = |period: &usize| {
        // From the end, where chaos gives itself away as soon as anywhere else.
        (2 * period..values.len()).rev().all(|index| {
            let before = values[index - period] - values[index - 2 * period];
            let after = values[index] - values[index - period];
            let goes_on = before * after >= 0.0 || after.abs() <= slack;
            goes_on && after.abs() <= LARGEST_GROWTH * before.abs() + slack
        })
    };
    // A sequence that repeats after n impacts, or comes nearer to doing so, does so after 2n impacts as well.
    let Some(period) = (1..=longest_period.min(values.len() / FEWEST_ROUNDS)).find(comes_nearer) else {
        return false;
    };
    (0..period).any(|class| {
        let last = class + (values.len() - 1 - class) / period * period;
        (values[last] - values[class]).abs() > tolerance
    })
}

/// The smallest period up to `longest_period` after which all values are the same again, within `tolerance`;
/// `None` also with fewer than four rounds of it.
pub(crate) fn repeats_every(values: &[f64], longest_period: usize, tolerance: f64) -> Option<usize> {
    (1..=longest_period.min(values.len() / FEWEST_ROUNDS)).find(|period| {
        (*period..values.len()).rev().all(|index| (values[index] - values[index - period]).abs() <= tolerance)
    })
}

#[cfg(test)]
mod tests {
    use bouncing_disk::core::sweep::orbit_diagram;
    use bouncing_disk::core::{ChatterPolicy, ImpactMap, ImpactState, Unobserved, Vibration};

    use super::*;

    fn speeds(axial_forcing: f64, transient: usize) -> Vec<f64> {
        let vibration = Vibration::from_axial_forcing(axial_forcing).expect("legal");
        let map = ImpactMap::new(vibration, 0.5).expect("legal");
        let start = ImpactState::from_normalised(1.2, 1.3).expect("legal");
        let orbit = map.orbit(start, ChatterPolicy::Complete);
        let columns = orbit_diagram(&[orbit], transient, 200, &Unobserved).expect("follows");
        columns[0].iter().map(|state| state.normalised_speed()).collect()
    }

    #[test]
    fn orbits_settle_slowly_near_their_doublings_and_nowhere_else() {
        let settling = |forcing, transient| is_settling(&speeds(forcing, transient), 32, 1e-6);
        for forcing in [0.4859, 0.486, 0.486003, 0.48601, 0.5306, 0.5307] {
            assert!(settling(forcing, 300), "{forcing}");
        }
        for forcing in [0.4, 0.45, 0.5, 0.52, 0.535, 0.545, 0.56, 0.58, 0.6, 0.61] {
            assert!(!settling(forcing, 300), "{forcing}");
        }
        assert!(!settling(0.4859, 30_000));
        for hundred in 0..100 {
            let chaotic = 0.545 + 0.0007 * f64::from(hundred);
            assert!(!settling(chaotic, 1000), "{chaotic}");
        }
    }

    #[test]
    fn values_that_repeat_have_a_period_and_do_not_settle() {
        let slowly: Vec<f64> = (0..100).map(|impact| 0.3 + 1.0 / f64::from(impact + 50)).collect();
        assert!(is_settling(&slowly, 8, 1e-6));
        assert!(!is_settling(&[0.3, 0.7].repeat(50), 8, 1e-6));
        assert_eq!(repeats_every(&[0.3, 0.7].repeat(50), 8, 1e-6), Some(2));
        assert_eq!(repeats_every(&[0.3, 0.7], 8, 1e-6), None);
    }

    #[test]
    fn constant_drift_settles_and_too_few_values_tell_nothing() {
        let drift: Vec<f64> = (0..200).map(|k| 1e-4 * f64::from(k) + 0.1 * f64::from(k % 2)).collect();
        assert!(is_settling(&drift, 32, 1e-6) && !is_settling(&drift, 32, 0.1));
        let growing: Vec<f64> = (0..200).map(|k| f64::from(k * k)).collect();
        assert!(!is_settling(&growing, 32, 1e-6));
        assert!(!is_settling(&[], 32, 1e-6) && !is_settling(&[1.0, 2.0, 3.0], 32, 1e-6));
        assert!(!is_settling(&[f64::NAN; 100], 32, 1e-6));
    }
}
