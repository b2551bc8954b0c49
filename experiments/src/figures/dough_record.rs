//! A user's diameters of the dough for Fig. 14.

use bouncing_disk_plot::{Colour, Dash, Layer, Line, Marker, Scatter};
use serde::{Deserialize, Serialize};

use crate::experiment::ExperimentError;
use crate::figures::numbers::StraightLine;
use crate::measured::{Column, Layout, Range, SMALLEST, Series};

/// Diameters against time.
pub const DIAMETERS: Layout = Layout {
    file: "fig14.csv",
    columns: &[Column::time(), Column::value("diameter", Range::Positive)],
    least_rows: 3,
};

/// Diameters over that of their straight line at the first time, d/d_0 = 1 + slope (t − t_0).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Growth {
    /// Times (s).
    pub time_s: Vec<f64>,
    /// d/d_0.
    pub relative_diameter: Vec<f64>,
    /// Slope (1/s).
    pub slope_per_s: f64,
    /// Its standard error (1/s).
    pub slope_error_per_s: f64,
}

/// The line has no diameter at the first time that others can be divided by.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the line gives a first diameter of {diameter:e}; legal is {SMALLEST:e} or more")]
pub struct GrowthError {
    /// The diameter, in the unit of the file.
    pub diameter: f64,
}

impl Growth {
    /// Fits the line to all points of a file.
    pub fn of(series: &Series) -> Result<Self, ExperimentError> {
        let points: Vec<(f64, f64)> = series.rows::<2>().map(|[time, diameter]| (time, diameter)).collect();
        let first = points.first().map_or(f64::NAN, |point| point.0);
        let line = StraightLine::through(&points);
        let diameter = line.map_or(f64::NAN, |line| line.intercept + line.slope * first);
        match line {
            Some(line) if diameter >= SMALLEST => {
                let (slope_per_s, slope_error_per_s) = line.slope_over_value_at(first);
                Ok(Self {
                    time_s: points.iter().map(|point| point.0).collect(),
                    relative_diameter: points.iter().map(|point| point.1 / diameter).collect(),
                    slope_per_s,
                    slope_error_per_s,
                })
            }
            _ => Err(series.unusable(None, GrowthError { diameter }).into()),
        }
    }

    /// The points and the line.
    pub fn layers(&self) -> Vec<Layer> {
        let points = self.time_s.iter().copied().zip(self.relative_diameter.iter().copied());
        let first = self.time_s.first().copied().unwrap_or_default();
        let last = self.time_s.last().copied().unwrap_or_default();
        let line = [(first, 1.0), (last, 1.0 + self.slope_per_s * (last - first))];
        vec![
            Scatter::new(points).marker(Marker::Cross).colour(Colour::GREEN).name("measured").into(),
            Line::new(line).colour(Colour::GREEN).dash(Dash::Dashed).name("its fit").into(),
        ]
    }

    /// The equation of the line.
    pub fn words(&self) -> String {
        format!(
            "d/d₀ = 1 + ({:.4} ± {:.4}) (t − {}), {} points",
            self.slope_per_s,
            self.slope_error_per_s,
            self.time_s.first().copied().unwrap_or_default(),
            self.time_s.len()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(body: &str) -> Result<Growth, ExperimentError> {
        let text = format!("{}\n{body}", DIAMETERS.header());
        Growth::of(&Series::read(&DIAMETERS, text.as_bytes()).expect("well formed"))
    }

    #[test]
    fn the_line_is_normalised_at_the_first_time() {
        // Synthetic: 200 + 10 (t − 2).
        let growth = read("2,200\n3,210\n6,240\n").expect("a line");
        assert!(
            (growth.slope_per_s - 0.05).abs() < 1e-12 && (growth.relative_diameter[2] - 1.2).abs() < 1e-12
        );
        assert!(growth.words().starts_with("d/d₀ = 1 + (0.0500 ± 0.0000) (t − 2), 3 points"));
    }

    #[test]
    fn a_line_without_a_first_diameter_is_refused() {
        let error = read("0,1\n1,1\n2,1\n2.5,1\n3,100\n").expect_err("starts below 0");
        assert!(crate::experiment::chain(&error).contains("legal is 1e-12 or more"));
    }
}
