//! The axes of a panel.

use crate::builders::builders;
use crate::colour::Colour;
use crate::error::DrawError;
use crate::label::Label;
use crate::numbers::extent;
use crate::ticks::{self, PlacedTicks, Ticks};

/// Range, scale, label and ticks of one axis. The first end of the range is on the left or at the bottom; an
/// axis may run backwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    first: f64,
    last: f64,
    logarithmic: bool,
    pub(crate) label: Label,
    ticks: Ticks,
    pub(crate) shows_numbers: bool,
    pub(crate) label_distance: Option<f64>,
    pub(crate) colour: Colour,
}

builders!(Axis {
    /// Sets the label: the quantity that the axis shows, with its unit.
    label(label: impl Into<Label>) |own| own.label = label.into();
    /// Chooses the ticks.
    ticks(ticks: Ticks) |own| own.ticks = ticks;
    /// Keeps the ticks but omits their numbers, which a neighbouring panel shows.
    without_numbers() |own| own.shows_numbers = false;
    /// Sets the distance in points from the frame to the label, to align the labels of several panels.
    label_distance(points: f64) |own| own.label_distance = Some(points);
    /// Sets the colour of the numbers and the label, to distinguish the axes of two quantities.
    colour(colour: Colour) |own| own.colour = colour;
});

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
            logarithmic: false,
            label: Label::plain(""),
            ticks: Ticks::default(),
            shows_numbers: true,
            label_distance: None,
            colour: Colour::BLACK,
        }
    }

    /// A logarithmic axis; both ends are positive.
    pub fn log(first: f64, last: f64) -> Self {
        Self { logarithmic: true, ..Self::linear(first, last) }
    }

    /// A linear axis that contains all finite values, with a margin on both sides and three to five labels.
    pub(crate) fn around(values: impl IntoIterator<Item = f64>) -> Self {
        let (low, high) = Self::ends_around(values);
        Self::spanned(low, high)
    }

    /// The ends of the axis of [`Self::around`].
    pub(crate) fn ends_around(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
        let (low, high) = extent(values);
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        let size = low.abs().max(high.abs());
        let room = match high - low {
            span if span > 1e-9 * size => 0.06 * span,
            // All alike.
            _ if size > 0.0 => 0.1 * size,
            _ => 1.0,
        };
        (low - room, high + room)
    }

    /// A linear axis with three to five labels: some panels are too narrow for more.
    pub(crate) fn spanned(low: f64, high: f64) -> Self {
        Self::linear(low, high).ticks(Ticks::few(high - low))
    }

    /// 0 at the first end, 1 at the last; NaN if a logarithmic axis cannot show the value.
    pub(crate) fn fraction(&self, value: f64) -> f64 {
        match self.logarithmic {
            false => (value - self.first) / (self.last - self.first),
            true if value > 0.0 => libm::log(value / self.first) / libm::log(self.last / self.first),
            true => f64::NAN,
        }
    }

    pub(crate) fn check(&self) -> Result<(), DrawError> {
        let (axis, low, high) = (self.label.source().to_owned(), self.first, self.last);
        let extent = (high - low).abs();
        let finite = low.is_finite() && high.is_finite() && extent.is_finite() && extent > 0.0;
        let shown = !self.logarithmic || (low > 0.0 && high > 0.0);
        if finite && shown { Ok(()) } else { Err(DrawError::AxisRange { axis, low, high }) }
    }

    /// The ticks, for an axis of `length` points with about `spacing` points between labels.
    pub(crate) fn choose_ticks(&self, length: f64, spacing: f64) -> Result<PlacedTicks, DrawError> {
        self.check()?;
        if self.logarithmic {
            return Ok(ticks::logarithmic(&self.ticks, self.first, self.last));
        }
        let room = (length / spacing).clamp(2.0, 8.0) as usize;
        ticks::linear(&self.ticks, self.first, self.last, room).map_err(|step| DrawError::TickStep {
            axis: self.label.source().to_owned(),
            step,
            low: self.first,
            high: self.last,
        })
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
        for axis in [Axis::linear(1.0, 1.0), Axis::linear(0.0, f64::NAN), Axis::log(0.0, 1.0)] {
            assert!(matches!(axis.check(), Err(DrawError::AxisRange { .. })), "{axis:?}");
        }
        for values in [&[][..], &[0.0], &[1.0, 1.0], &[f64::NAN, 3.0], &[-1e-300, 1e-300], &[1e300, -1e300]] {
            assert!(Axis::around(values.iter().copied()).choose_ticks(100.0, 25.0).is_ok(), "{values:?}");
        }
    }
}
