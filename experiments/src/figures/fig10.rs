//! Fig. 10(a)-(c): transient speed curves of the motor and their fits, for both readings of Table III.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::Unobserved;
use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::estimate::ExponentialFit;
use bouncing_disk::motor::TransientSettings;
use bouncing_disk_plot::Figure;

use self::compute::MEMBER_INTERVALS;
pub use self::data::Fig10Data;
use self::data::Trial;
use crate::claims::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality, named};
use crate::figures::shared::motor::MotorCase;
use crate::measured::{Column, Layout, Range, Series};
use crate::progress::Progress;

/// Fig. 10.
#[derive(Debug)]
pub struct Fig10;

impl Experiment for Fig10 {
    type Data = Fig10Data;

    const ID: &'static str = "fig10";

    const TITLE: &'static str = "Transient speed curves of the ultrasonic motor";
    const DISCUSSION: &str = include_str!("fig10/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![("motors that print alike", compute::SEED), ("ensembles", TransientSettings::default().seed)]
    }

    const MEASUREMENTS: &'static [Layout] = &[LAYOUT];

    fn caption(data: &Fig10Data) -> String {
        let exception = &data.exception;
        let [gravity, printed] = [0, 1]
            .map(|row| data.readings.get(row).map_or(f64::NAN, |row| row.preload_acceleration_m_per_s2));
        format!(
            "Transient speed curves of the motor of Table III from rest, each fitted with α̇_ss(1 − e^(−t/t_c)), for \
             A = 10⁻⁹, 10⁻⁸ and 10⁻⁷ m. (a)–(c) preload acceleration {gravity} m/s² (standard gravity; the 70 of Table III read as \
             ω/2π in kHz); (a′)–(c′) the same with g = {printed} m/s² as printed. Grey line: one member (speeds averaged over \
             1/{MEMBER_INTERVALS} of the time shown); black dashed line: its fit, whose numbers stand in the panel; blue band: mean ± one \
             standard deviation of {} members, which differ in the starting phase and in the seed of a relaunch perturbation below {} g/ω: {}. \
             Gray band in (a)–(c): 5 to 95 % of {} single orbits that nothing perturbs and whose inputs print alike ({}). \
             Dotted in (a): the same motor at exactly g = {} m/s², where Aω²/g is 2π² and a low-period cycle exists in a range of g \
             of {:.1e} m/s² only. The paper's panels (d)–(f) are measured curves, which are not in its text.{}",
            data.members,
            data.relaunch_perturbation,
            ensembles(data),
            data.alike.motors[0].len(),
            data.alike.inputs,
            exception.preload_acceleration_m_per_s2,
            exception.highest_preload_acceleration_m_per_s2 - exception.lowest_preload_acceleration_m_per_s2,
            caption(&data.measured),
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig10Data, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn overlay(data: &mut Fig10Data, series: &Series) -> Result<(), ExperimentError> {
        data.measured = trials(series)?;
        Ok(())
    }

    fn draw(data: &Fig10Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &Fig10Data) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &Fig10Data) -> Vec<(String, String)> {
        let motor = &data.motor;
        let own = [
            ("a_e", format!("{} m", motor.contact_radius_m)),
            ("a_g", format!("{} m", motor.gyration_radius_m)),
            ("ω/2π", format!("{} Hz", motor.frequency_hz)),
            ("members", data.members.to_string()),
            ("relaunch perturbation", format!("{} g/ω", data.relaunch_perturbation)),
            ("inputs that print alike", data.alike.inputs.clone()),
        ];
        let panels = data.readings.first().map_or(&[][..], |reading| &reading.panels);
        let motors = panels.iter().map(|panel| MotorCase { amplitude_m: panel.amplitude_m, ..*motor });
        [motor.shared_inputs(), named(own), vec![MotorCase::contact_row(motors)]].concat()
    }
}

/// The statistics of the panels, in words.
fn ensembles(data: &Fig10Data) -> String {
    let panels = data.readings.iter().flat_map(|reading| &reading.panels);
    let words = panels.map(|panel| {
        let (speed, constant) = (panel.steady_speed_rad_per_s, panel.time_constant_s);
        format!(
            "{:.2} ± {:.2} rad/s, {:.4} ± {:.4} s",
            speed.mean, speed.deviation, constant.mean, constant.deviation
        )
    });
    words.collect::<Vec<_>>().join("; ")
}

/// Panels in a row, and so the most trials.
const TRIALS: u32 = 3;

/// The file.
const LAYOUT: Layout = Layout {
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
fn trials(series: &Series) -> Result<Vec<Trial>, ExperimentError> {
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

/// The sentence of the caption about the trials; empty if there are none.
fn caption(trials: &[Trial]) -> String {
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
    use super::*;
    use std::fmt::Write as _;

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
