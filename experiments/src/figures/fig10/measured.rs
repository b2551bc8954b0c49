//! A user's transient speed curves beside those of Fig. 10, as the paper's panels (d)-(f) show its three trials.

use bouncing_disk::ExponentialFit;
use bouncing_disk::core::Unobserved;

use super::data::Trial;
use crate::experiment::ExperimentError;
use crate::measured::{Column, Layout, Range, Series};

/// Panels in a row, and so the most trials.
const TRIALS: u32 = 3;

/// The file.
pub(super) const LAYOUT: Layout = Layout {
    file: "fig10.csv",
    columns: &[
        Column::trial(TRIALS),
        Column::time(),
        Column::value("angular_speed_rad_per_s", Range::Signed),
    ],
    least_rows: 3,
};

/// A fit that the record does not determine.
#[derive(Debug, thiserror::Error)]
#[error(
    "the time constant of the fit, {time_constant_s:e} s, is outside the record; legal is {first_s} to {last_s} s"
)]
struct Undetermined {
    time_constant_s: f64,
    first_s: f64,
    last_s: f64,
}

/// Fits every trial of a file.
pub(super) fn trials(series: &Series) -> Result<Vec<Trial>, ExperimentError> {
    let fitted = series.trials::<3>().into_iter().map(|(trial, rows)| {
        let (time_s, angular_speed_rad_per_s): (Vec<f64>, Vec<f64>) =
            rows.into_iter().map(|[_, time, speed]| (time, speed)).unzip();
        let fit = ExponentialFit::new(&time_s, &angular_speed_rad_per_s, &Unobserved)
            .map_err(|error| series.unusable(Some(trial), error))?;
        let first_s = time_s.iter().copied().find(|time| *time > 0.0).unwrap_or_default();
        let last_s = time_s.last().copied().unwrap_or_default();
        if !(first_s..=last_s).contains(&fit.time_constant) {
            let time_constant_s = fit.time_constant;
            return Err(series
                .unusable(Some(trial), Undetermined { time_constant_s, first_s, last_s })
                .into());
        }
        Ok(Trial { trial, time_s, angular_speed_rad_per_s, fit })
    });
    fitted.collect()
}

/// What the caption says about the trials; nothing when there are none.
pub(super) fn caption(trials: &[Trial]) -> String {
    if trials.is_empty() {
        return String::new();
    }
    let fits: Vec<String> = trials
        .iter()
        .map(|trial| {
            let fit = &trial.fit;
            format!(
                "trial {}: α̇_ss = {:.2} rad/s, t_c = {:.4} s, α̇_ss/t_c = {:.2} rad/s², root mean square deviation {:.2} \
                 rad/s, {} points",
                trial.trial,
                fit.steady_speed,
                fit.time_constant,
                fit.stall_acceleration(),
                fit.residual,
                trial.time_s.len(),
            )
        })
        .collect();
    format!(
        " Bottom row: measurements read from {} with their fits (dashed) and the mean fit of (b) (dotted): {}.",
        LAYOUT.file,
        fits.join("; ")
    )
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use super::*;

    /// Synthetic speeds 20 (1 - exp(-t/0.5)) at 0 to 3 s.
    fn synthetic(trial: u32, scale: f64) -> String {
        let fit = ExponentialFit { steady_speed: 20.0, time_constant: 0.5, residual: 0.0 };
        (0..=60).fold(String::new(), |mut text, index| {
            let time = f64::from(index) / 20.0;
            let _ = writeln!(text, "{trial},{time},{}", fit.speed(time * scale));
            text
        })
    }

    fn read(body: &str) -> Result<Vec<Trial>, ExperimentError> {
        let text = format!("{}\n{body}", LAYOUT.header());
        trials(&Series::read(&LAYOUT, text.as_bytes()).expect("well formed"))
    }

    #[test]
    fn the_constants_of_each_trial_come_back() {
        let trials = read(&(synthetic(1, 1.0) + &synthetic(3, 2.0))).expect("fits");
        let fits: Vec<_> = trials.iter().map(|trial| (trial.trial, trial.fit)).collect();
        for ((trial, fit), (number, constant)) in fits.into_iter().zip([(1, 0.5), (3, 0.25)]) {
            assert_eq!(trial, number);
            assert!((fit.steady_speed - 20.0).abs() < 1e-5, "{fit:?}");
            assert!((fit.time_constant - constant).abs() < 1e-6, "{fit:?}");
        }
        assert!(caption(&trials).contains("trial 3: α̇_ss = 20.00 rad/s, t_c = 0.2500 s"));
        assert!(caption(&[]).is_empty());
    }

    #[test]
    fn a_record_without_a_transient_is_refused() {
        for body in [synthetic(2, 0.01), "2,0,0\n2,1,0\n2,2,0\n".to_owned()] {
            let error = crate::experiment::chain(&read(&body).expect_err("no transient"));
            assert!(
                error.starts_with("fig10.csv: trial 2 cannot be evaluated: the time constant"),
                "{error}"
            );
        }
        let error = crate::experiment::chain(&read("1,0,0\n1,1,1\n2,1,1\n").expect_err("two points"));
        assert!(error.contains("number of points"), "{error}");
    }
}
