//! The means over windows of time by which transients are compared.

use crate::estimate::measured_speeds::MeasuredRun;
use crate::estimate::parameter_fit::measured_transient::MeasuredTransient;

/// Intervals of a computed curve.
pub(crate) const INTERVALS: usize = 256;

/// The fewest points of a run in a window; a window with fewer is one with the next.
const LEAST_POINTS_IN_WINDOW: usize = 2;

/// The windows of the transients at one preload, and how a curve is taken to them.
#[derive(Debug, Clone)]
pub(crate) struct Windows {
    /// Means of the measured speeds (rad/s), over all runs.
    pub(crate) measured: Vec<f64>,
    /// Variance of their errors of measurement.
    pub(crate) error_variances: Vec<f64>,
    /// The contribution of each interval of a computed curve to each mean.
    weights: Vec<[f64; INTERVALS]>,
    /// Duration of the curve (s).
    pub(crate) duration: f64,
}

impl Windows {
    /// Windows whose ends are the duration, half of it, a fourth, and so on, at most `most` of them. A
    /// computed curve is taken `late` seconds after the instants that were measured.
    pub(crate) fn of(transient: &MeasuredTransient, most: usize, error_variance: f64, late: f64) -> Self {
        let (runs, duration) = (transient.runs.runs(), transient.duration());
        let mut ends: Vec<f64> = Vec::with_capacity(most);
        let mut end = duration;
        for _ in 0..most {
            ends.push(end);
            end *= 0.5;
        }
        ends.reverse();
        // The last window has half of the time, and may still be poor in points if they lie early.
        let mut bounds = vec![0.0];
        for end in ends {
            let start = bounds[bounds.len() - 1];
            if runs.iter().all(|run| points(run, start, end).count() >= LEAST_POINTS_IN_WINDOW) {
                bounds.push(end);
            }
        }
        match bounds.len() {
            1 => bounds.push(duration),
            count => bounds[count - 1] = duration,
        }
        let count = bounds.len() - 1;
        let (mut measured, mut error_variances) = (vec![0.0; count], vec![0.0; count]);
        let mut weights = vec![[0.0; INTERVALS]; count];
        for run in runs {
            for window in 0..count {
                let inside: Vec<usize> = points(run, bounds[window], bounds[window + 1]).collect();
                let share = 1.0 / (inside.len() as f64 * runs.len() as f64);
                error_variances[window] += share * share * inside.len() as f64 * error_variance;
                for index in inside {
                    measured[window] += share * run.speeds[index];
                    interpolate((run.times[index] + late) / duration, share, &mut weights[window]);
                }
            }
        }
        Self { measured, error_variances, weights, duration }
    }

    /// Number of windows.
    pub(crate) const fn count(&self) -> usize {
        self.measured.len()
    }

    /// The means of a computed curve, at the instants that were measured.
    pub(crate) fn of_curve<'a>(&'a self, speeds: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        self.weights
            .iter()
            .map(move |weights| weights.iter().zip(speeds).map(|(weight, speed)| weight * speed).sum::<f64>())
    }
}

/// The points of a run behind `start` and not behind `end`.
fn points(run: &MeasuredRun, start: f64, end: f64) -> impl Iterator<Item = usize> {
    run.times
        .iter()
        .enumerate()
        .filter(move |&(_, &time)| time > start && time <= end)
        .map(|(index, _)| index)
}

/// Adds `share` of the speed at a time, given as a share of the duration: on the line between the middles of
/// the two intervals beside it, or between the rest at time zero and the first middle.
fn interpolate(time: f64, share: f64, weights: &mut [f64; INTERVALS]) {
    let place = time * INTERVALS as f64 - 0.5;
    if place <= 0.0 {
        weights[0] += share * (2.0 * place + 1.0);
        return;
    }
    let left = (place as usize).min(INTERVALS - 1);
    let right = (left + 1).min(INTERVALS - 1);
    let beyond = place - left as f64;
    weights[left] += share * (1.0 - beyond);
    weights[right] += share * beyond;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimate::measured_speeds::MeasuredSpeeds;
    use crate::estimate::parameter_fit::measured_transient::RunPreload;

    fn transient(times: Vec<f64>, speed: impl Fn(f64) -> f64) -> MeasuredTransient {
        let speeds = times.iter().map(|&time| speed(time)).collect();
        let runs = MeasuredSpeeds::new(vec![MeasuredRun { member: 0, times, speeds }]).expect("legal");
        MeasuredTransient { preload: RunPreload::Acceleration(10.0), runs, speed_error: Some(0.0) }
    }

    fn middles(duration: f64, speed: impl Fn(f64) -> f64) -> Vec<f64> {
        (0..INTERVALS).map(|i| speed((i as f64 + 0.5) * duration / INTERVALS as f64)).collect()
    }

    /// A straight curve through zero is interpolated without an error, wherever the points lie.
    #[test]
    fn a_computed_curve_is_taken_at_the_instants_that_were_measured() {
        for times in [
            (0..100).map(|i| 0.02 * f64::from(i)).collect::<Vec<_>>(),
            vec![1e-9, 1e-3, 2e-3, 0.1, 0.3, 0.31, 0.32, 1.0, 1.9, 1.999],
            (0..40).map(|i| 1.6 + 0.01 * f64::from(i)).collect(),
        ] {
            let measured = transient(times, |time| 3.0 * time);
            let windows = Windows::of(&measured, 6, 1.0, 0.0);
            let duration = measured.duration();
            let computed: Vec<f64> = windows.of_curve(&middles(duration, |time| 3.0 * time)).collect();
            for (own, other) in computed.iter().zip(&windows.measured) {
                // Behind the last middle the curve is taken to be constant.
                assert!((own - other).abs() < 3.0 * duration / INTERVALS as f64, "{own} {other}");
            }
            if windows.count() > 1 {
                assert!((computed[0] / windows.measured[0] - 1.0).abs() < 1e-12, "{computed:?}");
            }
        }
    }

    #[test]
    fn windows_double_and_those_without_points_are_one_with_the_next() {
        let even = transient((1..=64).map(f64::from).collect(), |_| 1.0);
        let windows = Windows::of(&even, 6, 2.0, 0.0);
        assert_eq!(windows.count(), 6);
        // 2, 2, 4, 8, 16 and 32 points of variance 2.
        let variances = [1.0, 1.0, 0.5, 0.25, 0.125, 0.0625];
        assert!(
            windows.error_variances.iter().zip(variances).all(|(own, other)| (own - other).abs() < 1e-15)
        );
        let late = transient((60..=70).map(f64::from).collect(), |_| 1.0);
        assert_eq!(Windows::of(&late, 6, 1.0, 0.0).count(), 1);
        // The last half holds one point: it belongs to the window before.
        let early = transient((1..=20).chain([100]).map(f64::from).collect(), |_| 1.0);
        let windows = Windows::of(&early, 6, 21.0, 0.0);
        assert!(windows.measured.iter().all(|mean| (mean - 1.0).abs() < 1e-14));
        assert_eq!(windows.count(), 4);
    }
}
