//! A march in doubles that confirms an impact or hands it to the high-precision oracle: it knows the gap and
//! how strongly it can bend, and nothing of pieces, brackets or forms.

use std::f64::consts::TAU;

use bouncing_disk_core::{Impact, Phase};

use crate::oracle::{Sample, U, sine_deficit};

/// Steps before a flight is left to the oracle.
const MAX_STEPS: u32 = 400;

/// What the march makes of an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Finding {
    /// The gap is zero there and positive before, beyond the rounding of doubles.
    Confirmed,
    /// The rounding leaves it open.
    Open,
    /// What the impact says of itself does not agree: time, phases and velocities.
    Contradiction(&'static str),
}

/// A flight from `phase`, at first `gap` above the platform (zero for a launch), with relative `speed`.
#[derive(Debug, Clone, Copy)]
pub struct Flight {
    pub peak: f64,
    pub phase: Phase,
    pub gap: f64,
    pub speed: f64,
}

impl Flight {
    fn at(&self, t: f64) -> Sample {
        let (p, w, s0, c0) = (self.peak, self.speed, self.phase.sin(), self.phase.cos());
        let (half_sin, half_cos) = libm::sincos(0.5 * t);
        let (versine, s) = (2.0 * half_sin * half_sin, 2.0 * half_sin * half_cos);
        let c = 1.0 - versine;
        let deficit = sine_deficit(t, s);
        let size = self.gap + w.abs() * t + 0.5 * t * t + p * (s0.abs() * versine + c0.abs() * deficit);
        Sample {
            gap: self.gap + (w * t - 0.5 * t * t) + p * (s0 * versine + c0 * deficit),
            gap_error: 32.0 * U * size,
            velocity: (w - t) + p * (s0 * s + c0 * versine),
            velocity_error: 32.0 * U * (w.abs() + t + p * (s0.abs() * s.abs() + c0.abs() * versine)),
            pull: 1.0 - p * (s0 * c + c0 * s),
            pull_error: 16.0 * U * (1.0 + p),
            third: p * (c0 * c - s0 * s),
        }
    }

    /// What the impact says of itself: phase, turns, periods, remainder and velocities must tell the same
    /// time.
    pub fn agrees(&self, impact: &Impact) -> Result<(), &'static str> {
        let (angle, h) = (impact.phase.angle(), impact.duration());
        if !(0.0..TAU).contains(&angle) || !(0.0..TAU).contains(&impact.remainder) {
            return Err("phase or remainder outside [0, 2 pi)");
        }
        if h <= 0.0 {
            return Err("no flight at all");
        }
        if impact.velocity.is_nan() || impact.velocity > 0.0 {
            return Err("hit from above");
        }
        let by_phase = (angle - self.phase.angle()) + impact.turns as f64 * TAU;
        if (by_phase - h).abs() > 4.0e-15 + 4.0 * f64::EPSILON * h {
            return Err("phases and turns tell another time");
        }
        // A disk in free flight loses a unit of speed a radian.
        let lost = self.speed + self.peak * (self.phase.cos() - impact.phase.cos()) - impact.velocity;
        let rounding = 1.0e-14 * (1.0 + self.peak + self.speed.abs() + h);
        if impact.velocity < 0.0 && (lost - h).abs() > rounding {
            return Err("the velocities tell another time");
        }
        Ok(())
    }

    pub fn confirm(&self, impact: &Impact) -> Finding {
        if let Err(reason) = self.agrees(impact) {
            return Finding::Contradiction(reason);
        }
        let h = impact.duration();
        if let Some(expected) = self.brief_parabola() {
            // Subnormal numbers have fewer digits.
            let digits = 4.0 * f64::from_bits(1);
            let near = (h - expected).abs() <= 1.0e-13 * expected + digits
                && (impact.velocity + self.speed).abs() <= 1.0e-13 * self.speed + digits;
            return if near { Finding::Confirmed } else { Finding::Open };
        }
        let end = self.at(h);
        // Half of what the oracle allows, beside the rounding of this evaluation.
        if end.gap.abs() > end.gap_error + 0.5e-14 * TAU * end.velocity.abs() {
            return Finding::Open;
        }
        self.is_first(h)
    }

    /// The duration 2 w/(1 - P sin tau) of a launch that is back before the pull, no small difference, has
    /// changed by a rounding: the squares of the march would underflow. `None` for other flights.
    fn brief_parabola(&self) -> Option<f64> {
        let sine = self.peak * self.phase.sin();
        let pull = 1.0 - sine;
        let h = 2.0 * self.speed / pull;
        let plain = pull > 1.0e-2 * (1.0 + self.peak) && self.gap <= 0.0 && self.speed > 0.0;
        (plain && h * (1.0 + self.peak) < 1.0e-16 * pull).then_some(h)
    }

    /// Whether the pull at the start may be nothing but the rounding of P and the phase.
    pub fn is_weightless(&self) -> bool {
        (1.0 - self.peak * self.phase.sin()).abs() <= 1.0e-13 * (1.0 + self.peak)
    }

    fn is_first(&self, h: f64) -> Finding {
        let (p, s0, c0) = (self.peak, self.phase.sin(), self.phase.cos());
        // Above the crests there is nothing to hit.
        let disk_speed = self.speed + p * c0;
        let depth = p * (1.0 - s0) - self.gap;
        let radicand = disk_speed * disk_speed - 2.0 * depth;
        let above = if radicand > 0.0 && disk_speed > 0.0 && depth > 0.0 {
            let until = disk_speed + radicand.sqrt();
            (2.0 * depth / until * (1.0 + 1.0e-9), until * (1.0 - 1.0e-9))
        } else {
            (f64::INFINITY, f64::INFINITY)
        };
        let mut t = 0.0;
        for _ in 0..MAX_STEPS {
            if t > above.0 && t < above.1 {
                t = above.1;
            }
            let ahead = (h - t) * (1.0 + 1.0e-12);
            if ahead <= 0.0 {
                return Finding::Confirmed;
            }
            let at = self.at(t);
            if at.falls_for(p, ahead) {
                return Finding::Confirmed;
            }
            let sure = if t > 0.0 { at.gap - at.gap_error } else { at.gap };
            if sure <= 0.0 && t > 0.0 {
                return Finding::Open;
            }
            let step = at.safe_step(sure, at.velocity - at.velocity_error, p);
            if step.is_nan() || step <= 16.0 * U * t {
                return Finding::Open;
            }
            t += step;
        }
        Finding::Open
    }
}
