//! How near a flight came to an earlier impact.

use core::f64::consts::{PI, TAU};

use crate::flight::launch::Impact;
use crate::flight::launch::Launch;
use crate::flight::platform::vibration::Vibration;
use crate::numerics::elementary::sin_cos;

/// Bisection and Newton steps to a minimum of the gap.
const MAX_STEPS: u32 = 100;

impl Vibration {
    /// The graze margin of a flight: the smallest local minimum of the gap strictly between `launch` and
    /// `impact`, the result of [`Self::first_impact`], in units of g/omega^2. Infinite if the gap has no
    /// minimum on the way.
    ///
    /// If it is small compared with P, a slightly different launch would have hit the platform earlier. It is
    /// computed separately from the impact because an orbit does not need it.
    ///
    /// The gap has at most one minimum in each interval in which the platform falls away faster than the disk.
    /// The minima are a concave sequence (the disk's parabola, sampled once a period), so the first or the last
    /// one is the smallest: the cost does not grow with the length of the flight.
    #[must_use]
    pub fn graze_margin(&self, launch: Launch, impact: &Impact) -> f64 {
        let peak = self.peak_acceleration();
        if peak <= 1.0 {
            return f64::INFINITY;
        }
        let phase = launch.phase();
        let speed = launch.relative_speed() + peak * phase.cos();
        let duration = impact.duration();
        let width = PI - 2.0 * self.separation_angle;
        // Interval k is [first + 2 pi k, that + width]; in an interval that contains the launch, the gap
        // rises throughout.
        let first = self.time_to_separation(phase.angle());
        // A minimum needs a falling gap at the start of the interval and a rising one at its end.
        let slope = self.separation_speed;
        let lowest = (((speed - slope) - first) / TAU).floor() + 1.0;
        let highest = (((speed + slope).min(duration) - width - first) / TAU).ceil() - 1.0;
        let (lowest, highest) = (lowest.max(0.0), highest);
        if lowest > highest {
            return f64::INFINITY;
        }
        let depth = peak - peak * phase.sin();
        let minimum = |k: f64| self.smallest_gap(speed, depth, first + k * TAU, width);
        minimum(lowest).min(minimum(highest))
    }

    /// The smallest gap in the convex interval of `width` that begins `start` after a launch with disk speed
    /// `speed`, `depth` below the crests.
    fn smallest_gap(&self, speed: f64, depth: f64, start: f64, width: f64) -> f64 {
        let peak = self.peak_acceleration();
        let (mut lo, mut hi) = (0.0, width);
        let mut t = 0.5 * width;
        for _ in 0..MAX_STEPS {
            let (s, c) = sin_cos(self.separation_angle + t);
            let slope = (speed - (start + t)) - peak * c;
            if slope < 0.0 {
                lo = t;
            } else {
                hi = t;
            }
            let next = t - slope / (peak * s - 1.0);
            let next = if next > lo && next < hi { next } else { 0.5 * (lo + hi) };
            if (next - t).abs() <= 1.0e-10 {
                break;
            }
            t = next;
        }
        let h = start + t;
        // If the parabola reaches the crests, the height above them as a product, so that nothing large
        // cancels.
        let radicand = speed * speed - 2.0 * depth;
        let above = if radicand > 0.0 && speed > 0.0 {
            let later = speed + radicand.sqrt();
            let earlier = 2.0 * depth / later;
            0.5 * (h - earlier) * (later - h)
        } else {
            h * (speed - 0.5 * h) - depth
        };
        let (s, _) = sin_cos(self.separation_angle + t);
        above + peak * (1.0 - s)
    }
}
