//! A march in doubles that confirms an impact or hands it to the high-precision oracle: it uses the gap and a
//! bound on its curvature, but no pieces, brackets or forms.

use std::f64::consts::{PI, TAU};

use bouncing_disk_core::{Impact, Phase};

use crate::oracle::{STEP_SHARE, U};

/// Largest number of steps before a flight is left to the oracle.
const MAX_STEPS: u32 = 400;

/// The finding of the march about an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Finding {
    /// The gap is zero at the impact and positive before, beyond the rounding of doubles.
    Confirmed,
    /// Rounding leaves this open.
    Open,
    /// The impact's time, phases and velocities do not agree.
    Contradiction(&'static str),
}

/// A flight from `phase`, starting `gap` above the platform (zero for a launch) with relative `speed`.
#[derive(Debug, Clone, Copy)]
pub struct Flight {
    pub peak: f64,
    pub phase: Phase,
    pub gap: f64,
    pub speed: f64,
}

/// Checks the ranges of an impact, which need no solution.
pub fn check_form(impact: &Impact) -> Result<(), &'static str> {
    if !(0.0..TAU).contains(&impact.phase.angle()) || !(0.0..TAU).contains(&impact.remainder) {
        return Err("phase or remainder outside [0, 2 pi)");
    }
    if impact.duration() <= 0.0 {
        return Err("no flight at all");
    }
    if impact.velocity.is_nan() || impact.velocity > 0.0 {
        return Err("hit from above");
    }
    Ok(())
}

/// h - sin h, with relative accuracy.
fn sine_deficit(h: f64, sine: f64) -> f64 {
    if h > 0.5 {
        return h - sine;
    }
    let z = h * h;
    h * z / 6.0
        * (1.0
            - z / 20.0
                * (1.0
                    - z / 42.0
                        * (1.0 - z / 72.0 * (1.0 - z / 110.0 * (1.0 - z / 156.0 * (1.0 - z / 210.0))))))
}

/// The gap in doubles, with bounds of its error.
pub struct Sample {
    pub gap: f64,
    pub gap_error: f64,
    pub velocity: f64,
    pub velocity_error: f64,
    /// Minus the curvature, 1 - P sin, and P cos of the phase.
    pub pull: f64,
    pub pull_error: f64,
    pub third: f64,
}

impl Sample {
    /// The sample at a time after a start with this gap and relative speed, given the phase's sine and
    /// cosine, with relative accuracy.
    pub fn after(peak: f64, (gap, speed): (f64, f64), (s0, c0): (f64, f64), t: f64) -> Self {
        let (p, w) = (peak, speed);
        let (half_sin, half_cos) = libm::sincos(0.5 * t);
        let (versine, s) = (2.0 * half_sin * half_sin, 2.0 * half_sin * half_cos);
        let c = 1.0 - versine;
        let deficit = sine_deficit(t, s);
        let size = gap + w.abs() * t + 0.5 * t * t + p * (s0.abs() * versine + c0.abs() * deficit);
        Self {
            gap: gap + (w * t - 0.5 * t * t) + p * (s0 * versine + c0 * deficit),
            gap_error: 32.0 * U * size,
            velocity: (w - t) + p * (s0 * s + c0 * versine),
            velocity_error: 32.0 * U * (w.abs() + t + p * (s0.abs() * s.abs() + c0.abs() * versine)),
            pull: 1.0 - p * (s0 * c + c0 * s),
            pull_error: 16.0 * U * (1.0 + p),
            third: p * (c0 * c - s0 * s),
        }
    }

    /// Whether the gap falls throughout from here to `ahead`.
    pub fn falls_for(&self, peak: f64, ahead: f64) -> bool {
        let bend = (self.pull_error - self.pull + (self.third.abs() + 0.5 * peak * ahead) * ahead)
            .min(peak - 1.0 + self.pull_error);
        self.velocity + self.velocity_error + bend.max(0.0) * ahead < 0.0
    }

    /// A step that cannot reach a root: the curvature is never below -(1 + P), and for a step of at most `s`
    /// not below P sin - P |cos| s - P s^2/2 - 1.
    pub fn safe_step(&self, gap: f64, velocity: f64, peak: f64) -> f64 {
        let mut best = safe_time(gap, velocity, 1.0 + peak);
        let mut cap = best;
        // A disk that starts with almost no speed and no pull needs many.
        for _ in 0..400 {
            cap *= 4.0;
            if cap > PI {
                break;
            }
            let bend = self.pull + self.pull_error + (self.third.abs() + 0.5 * peak * cap) * cap;
            let time = safe_time(gap, velocity, bend).min(cap);
            if time <= best {
                break;
            }
            best = time;
        }
        best * STEP_SHARE
    }
}

/// The first zero of gap + velocity s - bend s^2/2.
fn safe_time(gap: f64, velocity: f64, bend: f64) -> f64 {
    if bend <= 0.0 {
        return if velocity >= 0.0 { f64::INFINITY } else { gap / -velocity };
    }
    let root = (velocity * velocity + 2.0 * bend * gap).sqrt();
    if velocity >= 0.0 { (velocity + root) / bend } else { 2.0 * gap / (root - velocity) }
}

/// A march by steps that cannot pass a root, because the gap's downward curvature is bounded.
pub struct March {
    pub peak: f64,
    pub from: f64,
    pub to: f64,
    /// Whether the gap falls to a root at the end.
    pub to_root: bool,
    /// Start and end of the time above the crests, during which no impact is possible.
    pub clear: Option<(f64, f64)>,
}

impl March {
    /// The number of steps, and the time, if any, at which rounding leaves open whether there is a root.
    pub fn run(&self, at: impl Fn(f64) -> Sample) -> (u32, Option<f64>) {
        let mut t = self.from;
        for step in 0..MAX_STEPS {
            if let Some((from, until)) = self.clear
                && t > from
                && t < until
            {
                t = until;
            }
            let ahead = (self.to - t) * (1.0 + 1.0e-12);
            if ahead <= 0.0 {
                return (step, None);
            }
            let at = at(t);
            if self.to_root && at.falls_for(self.peak, ahead) {
                return (step + 1, None);
            }
            let sure = if t > 0.0 { at.gap - at.gap_error } else { at.gap };
            let by = at.safe_step(sure, at.velocity - at.velocity_error, self.peak);
            if sure <= 0.0 && t > 0.0 || by.is_nan() || by <= 16.0 * U * t {
                return (step + 1, Some(t));
            }
            t += by;
        }
        (MAX_STEPS, Some(t))
    }
}

impl Flight {
    fn at(&self, t: f64) -> Sample {
        Sample::after(self.peak, (self.gap, self.speed), (self.phase.sin(), self.phase.cos()), t)
    }

    /// The consistency of the impact: phase, turns, periods, remainder and velocities must give the same
    /// time.
    pub fn agrees(&self, impact: &Impact) -> Result<(), &'static str> {
        let (angle, h) = (impact.phase.angle(), impact.duration());
        check_form(impact)?;
        let by_phase = (angle - self.phase.angle()) + impact.turns as f64 * TAU;
        if (by_phase - h).abs() > 4.0e-15 + 4.0 * f64::EPSILON * h {
            return Err("phases and turns tell another time");
        }
        // A disk in free flight loses one unit of speed per radian.
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
        // Half of the oracle's tolerance, in addition to the rounding of this evaluation.
        if end.gap.abs() > end.gap_error + 0.5e-14 * TAU * end.velocity.abs() {
            return Finding::Open;
        }
        self.is_first(h)
    }

    /// The duration 2 w/(1 - P sin tau) of a launch that returns before the pull, which is not a small
    /// difference, has changed by a rounding: the squares of the march would underflow. `None` for other
    /// flights.
    fn brief_parabola(&self) -> Option<f64> {
        let sine = self.peak * self.phase.sin();
        let pull = 1.0 - sine;
        let h = 2.0 * self.speed / pull;
        let plain = pull > 1.0e-2 * (1.0 + self.peak) && self.gap <= 0.0 && self.speed > 0.0;
        (plain && h * (1.0 + self.peak) < 1.0e-16 * pull).then_some(h)
    }

    /// Whether the pull at the start may be pure rounding of P and the phase.
    pub fn is_weightless(&self) -> bool {
        (1.0 - self.peak * self.phase.sin()).abs() <= 1.0e-13 * (1.0 + self.peak)
    }

    fn is_first(&self, h: f64) -> Finding {
        let (p, s0, c0) = (self.peak, self.phase.sin(), self.phase.cos());
        // Above the crests no impact is possible.
        let disk_speed = self.speed + p * c0;
        let depth = p * (1.0 - s0) - self.gap;
        let radicand = disk_speed * disk_speed - 2.0 * depth;
        let above = (radicand > 0.0 && disk_speed > 0.0 && depth > 0.0).then(|| {
            let until = disk_speed + radicand.sqrt();
            (2.0 * depth / until * (1.0 + 1.0e-9), until * (1.0 - 1.0e-9))
        });
        let march = March { peak: p, from: 0.0, to: h, to_root: true, clear: above };
        if march.run(|t| self.at(t)).1.is_some() { Finding::Open } else { Finding::Confirmed }
    }
}
