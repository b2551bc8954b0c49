//! Straight lines by least squares.

/// The line y = intercept + slope x of least squares, with the standard error of the slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StraightLine {
    pub(crate) slope: f64,
    pub(crate) intercept: f64,
    pub(crate) slope_error: f64,
    /// Share of the variance of y that the line explains.
    pub(crate) explained: f64,
    /// Mean and variance of x.
    x_mean: f64,
    x_variance: f64,
}

impl StraightLine {
    /// Through at least three points that do not all have the same x.
    pub(crate) fn through(points: &[(f64, f64)]) -> Option<Self> {
        let n = points.len() as f64;
        if points.len() < 3 {
            return None;
        }
        let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
        let (x_mean, y_mean) = (mean(|point| point.0), mean(|point| point.1));
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for (x, y) in points {
            let (dx, dy) = (x - x_mean, y - y_mean);
            xx += dx * dx;
            xy += dx * dy;
            yy += dy * dy;
        }
        if xx <= 0.0 || xx.is_nan() {
            return None;
        }
        let slope = xy / xx;
        let rest = (yy - slope * xy).max(0.0);
        Some(Self {
            slope,
            intercept: y_mean - slope * x_mean,
            slope_error: (rest / (n - 2.0) / xx).sqrt(),
            explained: if yy > 0.0 { 1.0 - rest / yy } else { 1.0 },
            x_mean,
            x_variance: xx / n,
        })
    }

    /// The slope over the line's own value at `x`, and its standard error: value and slope come from the same points, so
    /// that their errors are correlated.
    pub(crate) fn slope_over_value_at(&self, x: f64) -> (f64, f64) {
        let value = self.intercept + self.slope * x;
        let relative = self.slope / value;
        let lever = 1.0 + relative * (self.x_mean - x);
        let error = self.slope_error / value * (lever * lever + relative * relative * self.x_variance).sqrt();
        (relative, error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn textbook_line() {
        let line =
            StraightLine::through(&[(0.0, 1.0), (1.0, 2.0), (2.0, 2.0), (3.0, 5.0)]).expect("four points");
        assert!((line.slope - 1.2).abs() < 1e-12 && (line.intercept - 0.7).abs() < 1e-12);
        // Residuals 0.3, 0.1, −1.1, 0.7: sum of squares 1.8; slope error sqrt(1.8/2/5).
        assert!((line.slope_error - 0.18_f64.sqrt()).abs() < 1e-12);
        assert!((line.explained - 0.8).abs() < 1e-12);
    }

    #[test]
    fn too_few_points() {
        assert!(StraightLine::through(&[(0.0, 1.0), (1.0, 1.0)]).is_none());
        assert!(StraightLine::through(&[(1.0, 1.0), (1.0, 2.0), (1.0, 3.0)]).is_none());
    }
}
