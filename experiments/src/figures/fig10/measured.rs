//! A user's transient speed curves beside those of Fig. 10, as the paper's panels (d)-(f) show its three trials.

use bouncing_disk::ExponentialFit;
use serde::{Deserialize, Serialize};

use crate::experiment::ExperimentError;
use crate::measured::{Column, Layout, Range, Series};
use bouncing_disk_plot::{Anchor, Axis, Colour, Corner, Dash, Legend, Line, Panel, Rect, Text};

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

/// One measured trial with its fit.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Trial {
    pub(super) trial: u32,
    time_s: Vec<f64>,
    angular_speed_rad_per_s: Vec<f64>,
    fit: ExponentialFit,
}

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
        let fit = ExponentialFit::new(&time_s, &angular_speed_rad_per_s)
            .map_err(|error| series.unusable(Some(trial), error))?;
        let first_s = time_s.iter().copied().find(|time| *time > 0.0).unwrap_or_default();
        let last_s = time_s.last().copied().unwrap_or_default();
        if !(first_s..=last_s).contains(&fit.time_constant) {
            let time_constant_s = fit.time_constant;
            return Err(series.unusable(Some(trial), Undetermined { time_constant_s, first_s, last_s }));
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

/// The panel of a trial; `model` is the fit to the computed curves that it is compared with.
pub(super) fn panel(area: Rect, trials: &[Trial], trial: &Trial, model: ExponentialFit) -> Panel {
    let last = trials.iter().filter_map(|trial| trial.time_s.last().copied()).fold(0.0, f64::max);
    let speeds = trials.iter().flat_map(|trial| trial.angular_speed_rad_per_s.iter().copied());
    let (low, high) = speeds
        .chain(trials.iter().map(|trial| trial.fit.steady_speed))
        .chain([model.speed(last)])
        .fold((0.0_f64, 0.0_f64), |(low, high), speed| (low.min(speed), high.max(speed)));
    let room = 0.1 * (high - low);
    let fit = trial.fit;
    let points = trial.time_s.iter().copied().zip(trial.angular_speed_rad_per_s.iter().copied());
    // The words stand where the curve does not go.
    let bottom = if fit.steady_speed < 0.0 { 0.74 } else { 0.04 };
    let note =
        |line: f64, text: String| Text::at_axes(0.96, bottom + 0.08 * line, text).anchor(Anchor::Right);
    let curve = |fit: ExponentialFit| super::picture::sampled(last, move |time| fit.speed(time));
    let drawn = Panel::new(area)
        .letter_in(
            ["g", "h", "i"].get(trial.trial as usize - 1).copied().unwrap_or_default(),
            Corner::TopLeft,
        )
        .x(Axis::linear(0.0, last).label(r"$t$ (s)"))
        .y(Axis::linear(if low < 0.0 { low - room } else { 0.0 }, high + 8.0 * room)
            .label(r"$\dot{\alpha}$ (rad/s)"))
        .layer(Line::new(points).colour(Colour::BLUE).width(0.6).name("measured"))
        .layer(Line::new(curve(model)).colour(Colour::VERMILION).dash(Dash::Dotted).name("model, (b)"))
        .layer(Line::new(curve(fit)).colour(Colour::BLACK).width(1.0).dash(Dash::Dashed).name("fit"))
        .layer(note(2.0, format!("measured, trial ${}$", trial.trial)))
        .layer(note(1.0, format!(r"$\dot{{\alpha}}_{{ss}} = {:.1}$ rad/s", fit.steady_speed)))
        .layer(note(0.0, format!("$t_c = {:.3}$ s", fit.time_constant)));
    let first = trials.first().is_some_and(|first| first.trial == trial.trial);
    if first { drawn.legend(Legend::at(Corner::TopRight)) } else { drawn }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use super::*;

    /// Synthetic readings 20 (1 - exp(-t/0.5)) at 0 to 3 s.
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
