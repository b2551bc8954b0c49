//! A user's decelerations and coefficients of friction for Fig. 9.

use bouncing_disk_plot::{Colour, Dash, Layer, Line, Marker, Scatter};
use serde::{Deserialize, Serialize};

use crate::experiment::ExperimentError;
use crate::figures::numbers::StraightLine;
use crate::measured::{Column, Layout, Range, Series};

/// Speeds of the rotor after the motor is switched off.
pub const DECELERATIONS: Layout = Layout {
    file: "fig09_deceleration.csv",
    columns: &[
        Column::trial(99),
        Column::constant("preload_n", Range::Positive),
        Column::time(),
        Column::value("angular_speed_rad_per_s", Range::NotNegative),
    ],
    least_rows: 3,
};

/// Coefficients of friction against preload.
pub const FRICTIONS: Layout = Layout {
    file: "fig09_friction.csv",
    columns: &[Column::value("preload_n", Range::Positive), Column::value("friction", Range::NotNegative)],
    least_rows: 2,
};

/// A deceleration and its straight line, α̇ = −α̈_brake (t − t_c) of Fig. 9.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Deceleration {
    /// The number of the trial.
    pub trial: u32,
    /// Normal force N (N).
    pub preload_n: f64,
    /// Times (s).
    pub time_s: Vec<f64>,
    /// Speeds (rad/s).
    pub angular_speed_rad_per_s: Vec<f64>,
    /// Slope of the line (rad/s²), below 0.
    pub brake_rad_per_s2: f64,
    /// The time (s) at which the line reaches 0.
    pub stop_s: f64,
    /// μ by Eq. (17).
    pub friction: f64,
}

/// A trial that no straight line to rest can be fitted to.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BrakingError {
    /// Too few speeds of a moving rotor.
    #[error("{found} speeds above 0; legal is 3 or more")]
    TooFew {
        /// The speeds above 0.
        found: usize,
    },
    /// The rotor does not slow down.
    #[error("the slope of the line is {slope:e} rad/s²; legal is a number below 0")]
    NotBraking {
        /// The slope (rad/s²).
        slope: f64,
    },
}

/// Fits every trial; `moment_of_inertia` is m a_g² (kg m²) and `contact_radius` a_e (m) of Eq. (17).
pub fn decelerations(
    series: &Series,
    moment_of_inertia: f64,
    contact_radius: f64,
) -> Result<Vec<Deceleration>, ExperimentError> {
    let fitted = series.trials::<4>().into_iter().map(|(trial, rows)| {
        let preload_n = rows.first().map_or(f64::NAN, |row| row[1]);
        let moving: Vec<(f64, f64)> =
            rows.iter().filter(|row| row[3] > 0.0).map(|row| (row[2], row[3])).collect();
        let refused = |error| ExperimentError::from(series.unusable(Some(trial), error));
        let line = StraightLine::through(&moving)
            .ok_or_else(|| refused(BrakingError::TooFew { found: moving.len() }))?;
        let stop_s = -line.intercept / line.slope;
        if line.slope >= 0.0 || !stop_s.is_finite() {
            return Err(refused(BrakingError::NotBraking { slope: line.slope }));
        }
        Ok(Deceleration {
            trial,
            preload_n,
            time_s: rows.iter().map(|row| row[2]).collect(),
            angular_speed_rad_per_s: rows.iter().map(|row| row[3]).collect(),
            brake_rad_per_s2: line.slope,
            stop_s,
            friction: -moment_of_inertia * line.slope / (contact_radius * preload_n),
        })
    });
    fitted.collect()
}

impl Deceleration {
    /// The speeds and the line.
    pub fn layers(&self) -> Vec<Layer> {
        let points = self.time_s.iter().copied().zip(self.angular_speed_rad_per_s.iter().copied());
        let start = self.time_s.first().copied().unwrap_or_default();
        let line = [(start, self.brake_rad_per_s2 * (start - self.stop_s)), (self.stop_s, 0.0)];
        vec![
            Scatter::new(points).marker(Marker::Cross).colour(Colour::GREEN).name("measured").into(),
            Line::new(line).colour(Colour::GREEN).dash(Dash::Dashed).into(),
        ]
    }

    /// The numbers of the line.
    pub fn words(&self) -> String {
        format!(
            "trial {} at {} N: α̈_brake = {:.3} rad/s², t_c = {:.4} s, μ = {:.4} by Eq. (17)",
            self.trial, self.preload_n, self.brake_rad_per_s2, self.stop_s, self.friction
        )
    }
}

/// The points of [`FRICTIONS`] for the drawing, preloads in the unit of its axis.
pub fn friction_layers(points: &[(f64, f64)]) -> Vec<Layer> {
    vec![
        Scatter::new(points.iter().copied())
            .marker(Marker::Cross)
            .colour(Colour::GREEN)
            .name("measured")
            .into(),
    ]
}

/// Mean, standard deviation and slope of [`FRICTIONS`].
pub fn friction_words(series: &Series) -> Result<String, ExperimentError> {
    let points: Vec<(f64, f64)> = series.rows::<2>().map(|[preload, friction]| (preload, friction)).collect();
    let frictions: Vec<f64> = points.iter().map(|point| point.1).collect();
    let spread = bouncing_disk::estimate::Spread::of(&frictions)?;
    let slope = StraightLine::through(&points).map_or_else(String::new, |line| {
        format!("; slope against preload {:.3} ± {:.3} 1/N", line.slope, line.slope_error)
    });
    Ok(format!("μ = {:.3} ± {:.3} of {} points{slope}", spread.mean, spread.deviation, points.len()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::chain;

    fn read(body: &str) -> Result<Vec<Deceleration>, ExperimentError> {
        let text = format!("{}\n{body}", DECELERATIONS.header());
        let series = Series::read(&DECELERATIONS, text.as_bytes()).expect("well formed");
        decelerations(&series, 1e-6, 5e-3)
    }

    #[test]
    fn the_slope_gives_the_friction() {
        // Synthetic: 20 − 100 t; the speed at rest is not fitted.
        let trials = read("4,0.2,0,20\n4,0.2,0.1,10\n4,0.2,0.15,5\n4,0.2,0.3,0\n").expect("brakes");
        let [trial] = &trials[..] else { panic!("one trial") };
        assert!((trial.brake_rad_per_s2 + 100.0).abs() < 1e-9 && (trial.stop_s - 0.2).abs() < 1e-12);
        // 1e-6 · 100/(5e-3 · 0.2)
        assert!((trial.friction - 0.1).abs() < 1e-12);
        assert!(trial.words().contains("μ = 0.1000"));
    }

    #[test]
    fn a_rotor_that_does_not_brake_is_refused() {
        let error = chain(&read("1,0.2,0,1\n1,0.2,1,2\n1,0.2,2,3\n").expect_err("speeds up"));
        assert!(error.contains("trial 1 cannot be evaluated: the slope of the line is 1e0"), "{error}");
        let error = chain(&read("1,0.2,0,1\n1,0.2,1,0\n1,0.2,2,0\n").expect_err("one speed"));
        assert!(error.contains("1 speeds above 0; legal is 3 or more"), "{error}");
    }

    #[test]
    fn frictions_are_summarised() {
        let text = format!("{}\n0.1,0.1\n0.2,0.1\n0.3,0.1\n", FRICTIONS.header());
        let series = Series::read(&FRICTIONS, text.as_bytes()).expect("well formed");
        assert!(friction_words(&series).expect("finite").starts_with("μ = 0.100 ± 0.000 of 3 points; slope"));
    }
}
