//! The axes of a panel.

use crate::error::DrawError;
use crate::label::Label;
use crate::ticks::{self, PlacedTicks, Ticks};

/// Linear or logarithmic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Scale {
    /// Equal distances are equal differences.
    Linear,
    /// Equal distances are equal ratios.
    Logarithmic,
}

/// Range, scale, label and ticks of one axis. The first end of the range is at the left or below; an axis may
/// run backwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    first: f64,
    last: f64,
    scale: Scale,
    label: Label,
    ticks: Ticks,
    labelled: bool,
    label_distance: Option<f64>,
}

impl Default for Axis {
    fn default() -> Self {
        Self::linear(0.0, 1.0)
    }
}

impl Axis {
    /// A linear axis.
    pub fn linear(first: f64, last: f64) -> Self {
        Self {
            first,
            last,
            scale: Scale::Linear,
            label: Label::plain(""),
            ticks: Ticks::default(),
            labelled: true,
            label_distance: None,
        }
    }

    /// A logarithmic axis; both ends are positive.
    pub fn log(first: f64, last: f64) -> Self {
        Self { scale: Scale::Logarithmic, ..Self::linear(first, last) }
    }

    /// A linear axis that holds all finite values with a little room on both sides.
    pub fn around(values: impl IntoIterator<Item = f64>) -> Self {
        let mut low = f64::INFINITY;
        let mut high = f64::NEG_INFINITY;
        for value in values.into_iter().filter(|value| value.is_finite()) {
            low = if value < low { value } else { low };
            high = if value > high { value } else { high };
        }
        if low > high {
            return Self::linear(0.0, 1.0);
        }
        let room = if high > low { 0.05 * (high - low) } else { 0.5 + 0.05 * low.abs() };
        Self::linear(low - room, high + room)
    }

    /// What the axis shows, with its unit.
    #[must_use]
    pub fn label(mut self, label: impl Into<Label>) -> Self {
        self.label = label.into();
        self
    }

    /// Chooses the ticks.
    #[must_use]
    pub fn ticks(mut self, ticks: Ticks) -> Self {
        self.ticks = ticks;
        self
    }

    /// Keeps the ticks and leaves out their numbers, where a neighbouring panel shows them.
    #[must_use]
    pub fn without_numbers(mut self) -> Self {
        self.labelled = false;
        self
    }

    /// The distance in points from the frame to the label, to align the labels of several panels.
    #[must_use]
    pub fn label_distance(mut self, points: f64) -> Self {
        self.label_distance = Some(points);
        self
    }

    pub(crate) fn label_text(&self) -> &Label {
        &self.label
    }

    pub(crate) fn shows_numbers(&self) -> bool {
        self.labelled
    }

    pub(crate) fn distance(&self) -> Option<f64> {
        self.label_distance
    }

    /// 0 at the first end, 1 at the last; NaN for what a logarithmic axis cannot show.
    pub(crate) fn fraction(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => (value - self.first) / (self.last - self.first),
            Scale::Logarithmic if value > 0.0 => {
                libm::log(value / self.first) / libm::log(self.last / self.first)
            }
            Scale::Logarithmic => f64::NAN,
        }
    }

    pub(crate) fn check(&self) -> Result<(), DrawError> {
        let (axis, low, high) = (self.label.source().to_owned(), self.first, self.last);
        let extent = (high - low).abs();
        if !(low.is_finite() && high.is_finite() && extent.is_finite() && extent > 0.0) {
            return Err(DrawError::AxisRange { axis, low, high });
        }
        if self.scale == Scale::Logarithmic && !(low > 0.0 && high > 0.0) {
            return Err(DrawError::LogarithmicRange { axis, low, high });
        }
        Ok(())
    }

    /// The ticks, for an axis of `length` points with about `spacing` points between labels.
    pub(crate) fn choose_ticks(&self, length: f64, spacing: f64) -> Result<PlacedTicks, DrawError> {
        self.check()?;
        match self.scale {
            Scale::Logarithmic => Ok(ticks::logarithmic(&self.ticks, self.first, self.last).into()),
            Scale::Linear => {
                let room = (length / spacing).clamp(2.0, 8.0) as usize;
                ticks::linear(&self.ticks, self.first, self.last, room).map_err(|step| DrawError::TickStep {
                    axis: self.label.source().to_owned(),
                    step,
                    low: self.first,
                    high: self.last,
                })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_run_from_the_first_end_to_the_last() {
        assert!((Axis::linear(2.0, 1.0).fraction(1.25) - 0.75).abs() < 1e-15);
        assert!((Axis::log(1e-9, 1e-7).fraction(1e-8) - 0.5).abs() < 1e-12);
        assert!(Axis::log(1.0, 10.0).fraction(-1.0).is_nan());
    }

    #[test]
    fn impossible_ranges_are_refused() {
        assert!(matches!(Axis::linear(1.0, 1.0).check(), Err(DrawError::AxisRange { .. })));
        assert!(matches!(Axis::linear(0.0, f64::NAN).check(), Err(DrawError::AxisRange { .. })));
        assert!(matches!(Axis::log(0.0, 1.0).check(), Err(DrawError::LogarithmicRange { .. })));
        assert!(Axis::around([f64::NAN, 3.0]).check().is_ok());
        assert!(Axis::around([]).check().is_ok());
    }
}
