//! Judges whether a mean over windows is steady, and how well it is known, from the scatter of independent
//! members and the remaining dependence on the start.

use bouncing_disk_core::numerics::statistics::{NORMAL_975, mean, standard_deviation};

use crate::motor::operation::point::{Estimate, Shortfall, error_of_mean};

/// A drift is significant beyond this number of its standard errors, however large the requested error: no
/// bound covers a vertical motion that still changes. A drift has about twice the standard error of the mean.
/// With 15 degrees of freedom a significant drift occurs by chance in one of 20 tests; the motor is then
/// merely followed for longer.
const DRIFT: f64 = NORMAL_975;

/// Motors that lock to one motion have almost no scatter, and the remainder of their start-up decays for
/// ever. A drift below this share of the requested error is ignored.
const NEGLIGIBLE: f64 = 1e-3;

/// Parts of the windows, the first of which is always omitted as start-up.
const PARTS: usize = 3;

/// If the means of members differ by this many times the amount that the scatter of their own windows
/// explains, the means depend on the start. The factor is large because successive windows may be correlated,
/// which that scatter does not show.
const DECIDED: f64 = 5.0;

/// The number of windows that are omitted from a total.
pub(crate) const fn left_out(windows: usize) -> usize {
    windows / PARTS
}

/// Mean speeds of windows in order of time, `[member][window]`, without the start-up.
pub(crate) type Speeds = [Vec<f64>];

/// The mean speed midway between rotors that started from far below and far above on the same vertical
/// motions, with a bound on its bias from the rotors above. Rotors never overtake each other, so a steady
/// rotor stays between the two. `None` if it is not finite.
fn steady_speed(middle: &Speeds, above: &Speeds, are_perturbed: bool) -> Option<Estimate> {
    let of = |speeds: &Speeds| {
        let means: Vec<f64> = speeds.iter().map(|windows| mean(windows)).collect();
        if are_perturbed { Estimate::of_decade(&means) } else { Estimate::of(&means) }
    };
    Some(of(middle).ok()?.bounded_by(of(above).ok()?))
}

/// The largest difference between the mean of a member and the overall mean, if the start decides the speed;
/// `None` if the scatter in time explains the differences.
pub(crate) fn decided_by_start(speeds: &Speeds) -> Option<f64> {
    let means: Vec<f64> = speeds.iter().map(|windows| mean(windows)).collect();
    let own = |windows: &Vec<f64>| {
        let deviation = standard_deviation(windows);
        deviation * deviation / windows.len() as f64
    };
    let explained = mean(&speeds.iter().map(own).collect::<Vec<_>>()).sqrt();
    let (all, between) = (mean(&means), standard_deviation(&means));
    let most = means.iter().fold(0.0_f64, |most, own| (own - all).abs().max(most));
    (between > DECIDED * explained).then_some(most)
}

/// The late mean of the windows' values minus the early mean, with its standard error, if it is significant:
/// the value then still drifts.
pub(crate) fn drift(stated: &Speeds, wanted: f64) -> Option<(f64, f64)> {
    let drifts: Vec<f64> = stated
        .iter()
        .map(|windows| {
            let (early, late) = windows.split_at(windows.len().div_ceil(3));
            mean(late) - mean(early)
        })
        .collect();
    let (drift, standard_error) = (mean(&drifts), error_of_mean(&drifts));
    let is_significant =
        drift.abs() > (DRIFT * standard_error).max(NEGLIGIBLE * wanted) || !drift.is_finite();
    is_significant.then_some((drift, standard_error))
}

/// Judges the mean speed over windows. `None` if it is steady, if its standard error is at most `wanted`, and
/// if the bound on the start-up contributes no more to this error than the scatter does. If members have
/// perturbations of different sizes, the scatter is about the mean at each size.
pub(crate) fn shortfall(
    middle: &Speeds,
    above: &Speeds,
    are_perturbed: bool,
    wanted: f64,
) -> Option<Shortfall> {
    if let Some((drift, standard_error)) = drift(middle, wanted) {
        return Some(Shortfall::Drift { drift, standard_error });
    }
    let (Some(speed), Some(bounded)) =
        (steady_speed(middle, middle, are_perturbed), steady_speed(middle, above, are_perturbed))
    else {
        return Some(Shortfall::Drift { drift: f64::NAN, standard_error: f64::NAN });
    };
    let bound = bounded.standard_error - speed.standard_error;
    if bound > speed.standard_error.max(NEGLIGIBLE * wanted) {
        let standard_error = speed.standard_error;
        return Some(Shortfall::Drift { drift: bound * NORMAL_975, standard_error });
    }
    let standard_error = bounded.standard_error;
    (standard_error > wanted).then_some(Shortfall::Error { standard_error, wanted })
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::numerics::elementary::exp;
    use bouncing_disk_core::numerics::random::SplitMix64;

    use super::*;

    fn noisy(members: u64, windows: usize, curve: impl Fn(f64) -> f64) -> Vec<Vec<f64>> {
        (0..members)
            .map(|seed| {
                let mut random = SplitMix64::new(seed);
                (0..windows).map(|window| curve(window as f64) + random.unit() - 0.5).collect()
            })
            .collect()
    }

    /// The shortfall if the rotors from below and from above have met.
    fn alone(speeds: &Speeds, wanted: f64) -> Option<Shortfall> {
        shortfall(speeds, speeds, false, wanted)
    }

    #[test]
    fn steady_means_are_judged_by_their_errors() {
        let speeds = noisy(16, 12, |_| 5.0);
        // The deviation of a mean of 12 x 16 uniformly distributed numbers.
        let error = (1.0_f64 / 12.0 / 192.0).sqrt();
        assert_eq!(alone(&speeds, 2.0 * error), None);
        let Some(Shortfall::Error { standard_error, .. }) = alone(&speeds, 0.3 * error) else {
            panic!("too well known")
        };
        assert!((standard_error / error - 1.0).abs() < 0.5, "{standard_error} {error}");
    }

    #[test]
    fn a_start_up_is_seen() {
        let speeds = noisy(16, 12, |window| 5.0 * (1.0 - exp(-window / 6.0)));
        for wanted in [0.1, 100.0] {
            assert!(matches!(alone(&speeds, wanted), Some(Shortfall::Drift { .. })), "{wanted}");
        }
        // A drift hidden by the scatter is not significant.
        assert_eq!(alone(&noisy(16, 12, |window| 1e-4 * window), 0.1), None);
    }

    /// The scatter does not contain the remainder of the start-up. While this is large, the run must
    /// continue; a small remainder is added to the error.
    #[test]
    fn what_depends_on_the_start_is_no_part_of_a_steady_mean() {
        let (below, above) = (noisy(16, 12, |_| 5.0), noisy(16, 12, |_| 5.3));
        assert_eq!(alone(&below, 0.2), None);
        let Some(Shortfall::Drift { drift, .. }) = shortfall(&below, &above, false, 0.2) else {
            panic!("steady")
        };
        assert!((drift - 0.3).abs() < 1e-12, "{drift}");
        let near = noisy(16, 12, |_| 5.01);
        assert_eq!(shortfall(&below, &near, false, 0.2), None);
        let error = |above: &Speeds| steady_speed(&below, above, false).expect("finite").standard_error;
        assert!((error(&near) - error(&below) - 0.01 / NORMAL_975).abs() < 1e-12);
    }

    /// Members that keep their own speeds differ by much more than their windows do.
    #[test]
    fn starts_that_decide_on_the_speed_are_seen() {
        let speeds = noisy(16, 12, |_| 5.0);
        assert_eq!(decided_by_start(&speeds), None);
        let apart: Vec<Vec<f64>> = (0..16_i32)
            .zip(&speeds)
            .map(|(member, windows)| windows.iter().map(|speed| speed + f64::from(member)).collect())
            .collect();
        // Members at 0 to 15 about their mean of 7.5.
        let most = decided_by_start(&apart).expect("they differ");
        assert!((most - 7.5).abs() < 0.5, "{most}");
        let neutral: Vec<Vec<f64>> = (0..4).map(|member| vec![f64::from(member); 8]).collect();
        assert_eq!(decided_by_start(&neutral), Some(1.5));
        assert_eq!(decided_by_start(&vec![vec![1.0; 6]; 4]), None);
    }

    #[test]
    fn motions_without_spread_are_steady_only_if_they_do_not_change() {
        assert_eq!(alone(&vec![vec![1.0; 6]; 4], 1e-9), None);
        let drifting: Vec<f64> = (0..6).map(f64::from).collect();
        // The early third of six windows is 0 and 1, the rest 2 to 5: a drift of 3.
        for (wanted, drifts) in [(1e-9, true), (2.9e3, true), (3.1e3, false)] {
            let shortfall = alone(&vec![drifting.clone(); 4], wanted);
            assert_eq!(matches!(shortfall, Some(Shortfall::Drift { .. })), drifts, "{wanted}");
        }
        assert!(matches!(alone(&vec![vec![f64::NAN; 6]; 4], 1.0), Some(Shortfall::Drift { .. })));
    }
}
