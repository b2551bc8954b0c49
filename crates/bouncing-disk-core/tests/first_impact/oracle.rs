//! A high-precision oracle for the first impact: it uses the gap function of the flight and is independent of
//! the solver.
//!
//! The arithmetic is `dashu-float` at [`PRECISION`] bits. Its own sine takes more than 100 us at this
//! precision (it recomputes pi for every argument), so sine and cosine are a table at multiples of 1/1024, by
//! angle addition from `dashu`'s values for the first, and a Taylor series for the rest; a test compares them
//! with `dashu`'s own.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::OnceLock;

use bouncing_disk_core::{Impact, Launch, Phase, Vibration};
use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

use crate::launches::Case;
use crate::march::{March, Sample, check_form};

/// A binary floating-point number of [`PRECISION`] bits.
pub type High = FBig<HalfEven, 2>;

/// Bits of the oracle. The gap of the longest flight is 5e12, so its rounding is below 1e-44.
pub const PRECISION: usize = 256;

/// The unit roundoff of a double.
pub const U: f64 = 0.5 * f64::EPSILON;

/// Allowed error of the impact phase in conditioning limits (see [`Limits`]); [`PHASE_TOLERANCE`] is allowed,
/// too.
pub const PHASE_FACTOR: f64 = 8.0;

/// Allowed error of the impact phase even for better conditioning: 1e-14 of a period.
pub const PHASE_TOLERANCE: f64 = 1.0e-14 * TAU;

/// Allowed error of the impact velocity in conditioning limits.
pub const VELOCITY_FACTOR: f64 = 8.0;

/// A dip of the gap is undecidable in double precision if its depth is below this many perturbations of the
/// gap by one unit roundoff in each of P, w and the launch phase.
pub const DIP_FACTOR: f64 = 8.0;

/// Allowed difference between the carried pair and the sine and cosine of the angle, which is rounded itself:
/// a few roundoffs of 2 pi.
const PAIR_TOLERANCE: f64 = 6.0 * U * TAU;

/// Steps of conservative advancement in high precision before the oracle gives up with an error.
const MAX_HIGH_STEPS: u32 = 20_000;

/// Conservative steps are computed in doubles and shortened by this much.
pub const STEP_SHARE: f64 = 1.0 - 1.0e-9;

/// `x`, exactly.
pub fn high(x: f64) -> High {
    High::try_from(x).unwrap().with_precision(PRECISION).value()
}

/// The double nearest to `x`.
pub fn low(x: &High) -> f64 {
    x.to_f64().value()
}

struct Tables {
    two_pi: High,
    half_pi: High,
    /// (sin, cos) of k/1024.
    pairs: Vec<(High, High)>,
    inverse_factorials: Vec<High>,
}

/// Steps of the table of sines in one radian.
const TABLE_STEPS: f64 = 1024.0;

/// Terms of the Taylor series: (1/2048)^22 / 22! is below 2^-310.
const TERMS: usize = 22;

fn tables() -> &'static Tables {
    static TABLES: OnceLock<Tables> = OnceLock::new();
    TABLES.get_or_init(|| {
        let wide = PRECISION + 64;
        let widened = |x: f64| High::try_from(x).unwrap().with_precision(wide).value();
        let mut inverse_factorials = vec![high(1.0)];
        for k in 1..=TERMS {
            let next = &inverse_factorials[k - 1] / high(k as f64);
            inverse_factorials.push(next);
        }
        let (sin_step, cos_step) = widened(1.0 / TABLE_STEPS).sin_cos();
        let (mut sin, mut cos) = (widened(0.0), widened(1.0));
        let mut pairs = Vec::new();
        for _ in 0..=(6.3 * TABLE_STEPS) as usize {
            let next = (&sin * &cos_step + &cos * &sin_step, &cos * &cos_step - &sin * &sin_step);
            pairs.push((sin.with_precision(PRECISION).value(), cos.with_precision(PRECISION).value()));
            (sin, cos) = next;
        }
        let pi = High::pi(wide);
        Tables {
            two_pi: &pi * High::from(2),
            half_pi: (pi / High::from(2)).with_precision(PRECISION).value(),
            pairs,
            inverse_factorials,
        }
    })
}

/// 2 pi, with 64 bits more than [`PRECISION`].
pub fn two_pi() -> &'static High {
    &tables().two_pi
}

/// Sine and cosine of a non-negative number of at most a few million radians.
pub fn sin_cos(x: &High) -> (High, High) {
    let tables = tables();
    let turns = (low(x) / TAU).floor();
    let x = if turns == 0.0 { x.clone() } else { x - &tables.two_pi * high(turns) };
    let k = (low(&x) * TABLE_STEPS).round().max(0.0);
    let r = (x - high(k / TABLE_STEPS)).with_precision(PRECISION).value();
    turned(&tables.pairs[k as usize], &r, TERMS)
}

/// Sine and cosine of an angle with this `pair`, rotated by a small angle.
fn turned(pair: &(High, High), by: &High, terms: usize) -> (High, High) {
    let factors = &tables().inverse_factorials;
    let square = by * by;
    let mut sine = factors[terms - 1].clone();
    let mut cosine = factors[terms].clone();
    let mut n = terms;
    while n >= 4 {
        sine = &factors[n - 3] - sine * &square;
        cosine = &factors[n - 2] - cosine * &square;
        n -= 2;
    }
    cosine = &factors[0] - cosine * &square;
    sine *= by;
    (&pair.0 * &cosine + &pair.1 * &sine, &pair.1 * cosine - &pair.0 * sine)
}

/// 1 - cos h and h - sin h of a short flight as series: no digit cancels.
fn versine_and_deficit(h: &High) -> (High, High) {
    let factors = &tables().inverse_factorials;
    let square = h * h;
    let series = |first: usize| {
        let mut sum = high(0.0);
        for n in (first..TERMS).step_by(2).rev() {
            sum = &factors[n] - sum * &square;
        }
        sum
    };
    (series(2) * &square, series(3) * &square * h)
}

/// asin(1/P) with its sine and cosine.
fn separation_of(p: &High) -> (High, High, High) {
    let sine = high(1.0) / p;
    let cosine = ((p - high(1.0)) * (p + high(1.0))).sqrt() / p;
    let near = high(libm::asin(low(&sine)));
    let (s, c) = sin_cos(&near);
    // The sine of the remaining angle, at most 3e-8, and its arc.
    let d = &sine * c - &cosine * s;
    let d2 = &d * &d;
    let mut arc = high(0.0);
    let ratios =
        [(1.0, 6.0), (3.0, 40.0), (15.0, 336.0), (105.0, 3456.0), (945.0, 42240.0), (10395.0, 599_040.0)];
    for (numerator, denominator) in ratios.into_iter().rev() {
        arc = (arc + high(numerator) / high(denominator)) * &d2;
    }
    (near + &d + d * arc, sine, cosine)
}

/// A case in exact arithmetic.
pub struct Exact {
    p: High,
    tau: High,
    s0: High,
    c0: High,
    /// Disk speed at launch, w + P cos tau.
    disk_speed: High,
    peak: f64,
    speed: f64,
    /// The initial gap between disk and platform: zero for a launch.
    start_gap: f64,
    /// The effect of one unit roundoff in the data on the launch phase.
    launch_shift: f64,
    separation: bool,
    half: High,
}

/// The gap and its derivatives at one time.
pub struct Point {
    pub gap: High,
    pub velocity: High,
    sin: High,
    cos: High,
}

/// The conditioning limits of an impact: the effect of one unit roundoff u = 2^-53 in each of P, w and the
/// launch phase (and of P in the height of the crests, if the disk passes one).
///
/// The gap changes by dg = u (w h + P |h cos tau - sin(tau + h) + sin tau| \[+ P\] + tau |d gap/d tau|), the
/// impact by 2 dg / (|v| + sqrt(v^2 + 2 dg |curvature|)), and the phase has a roundoff u 2 pi of its own. For
/// a launch from rest at the phase of separation, u tan sigma replaces u tau and is added to the phase,
/// because sigma = asin(1/P) moves by this amount.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    pub gap: f64,
    /// The limit of the impact phase, and of the duration without one roundoff of it.
    pub phase: f64,
    pub duration: f64,
    pub velocity: f64,
}

/// A first impact in high precision.
pub struct Solution {
    pub duration: High,
    /// The phase in [0, 2 pi).
    pub phase: High,
    pub velocity: High,
    pub limits: Limits,
}

/// The judgement of an impact that passed.
#[derive(Debug, Clone)]
pub struct Verdict {
    pub undecidable: bool,
    pub duration: High,
    pub limits: Limits,
    pub phase_error: f64,
    pub velocity_error: f64,
    pub duration_error: f64,
    pub fast_steps: u32,
    pub high_steps: u32,
}

/// The result of conservative advancement.
enum Advance {
    /// No root before the given one.
    Clear,
    /// A root at this earlier time.
    Earlier(High),
}

impl Exact {
    /// A disk that starts `gap` above the platform, or on it.
    pub fn dropped(case: &Case, gap: f64) -> Self {
        Self { start_gap: gap, ..Self::new(case) }
    }

    pub fn new(case: &Case) -> Self {
        let p = high(case.peak);
        let (tau, s0, c0, launch_shift) = if case.separation {
            let (tau, s0, c0) = separation_of(&p);
            let tangent = low(&s0) / low(&c0);
            (tau, s0, c0, U * tangent)
        } else {
            let tau = high(case.angle);
            let (s0, c0) = sin_cos(&tau);
            (tau, s0, c0, U * case.angle)
        };
        let disk_speed = high(case.speed) + &p * &c0;
        Self {
            p,
            tau,
            s0,
            c0,
            disk_speed,
            peak: case.peak,
            speed: case.speed,
            start_gap: 0.0,
            launch_shift,
            separation: case.separation,
            half: high(0.5),
        }
    }

    /// The phase at the time `h`, in [0, 2 pi).
    fn phase_at(&self, h: &High) -> High {
        let angle = &self.tau + h;
        // Reduced before it is rounded: long flights keep their phase.
        let turns = (low(&angle) / TAU).floor();
        let angle = (angle - two_pi() * high(turns)).with_precision(PRECISION).value();
        if low(&angle) < 0.0 { angle + two_pi() } else { angle }
    }

    pub fn at(&self, h: &High) -> Point {
        self.point(h, sin_cos(&self.phase_at(h)))
    }

    /// The point a small step after `before`.
    fn after(&self, before: Point, h: &High, step: &High) -> Point {
        if low(step).abs() > 1.0e-8 {
            return self.at(h);
        }
        self.point(h, turned(&(before.sin, before.cos), step, 10))
    }

    fn point(&self, h: &High, (sin, cos): (High, High)) -> Point {
        if low(h) < 1.0e-2 {
            return self.point_of_short_flight(h, sin, cos);
        }
        let gap =
            high(self.start_gap) + h * (&self.disk_speed - h * &self.half) - &self.p * (&sin - &self.s0);
        let velocity = &self.disk_speed - h - &self.p * &cos;
        Point { gap, velocity, sin, cos }
    }

    /// [`Self::point`] without cancellation in a short flight.
    fn point_of_short_flight(&self, h: &High, sin: High, cos: High) -> Point {
        let (versine, deficit) = versine_and_deficit(h);
        let speed = high(self.speed);
        let gap = high(self.start_gap)
            + h * (&speed - h * &self.half)
            + &self.p * (&self.s0 * &versine + &self.c0 * &deficit);
        let velocity = speed - h + &self.p * (&self.s0 * (h - &deficit) + &self.c0 * &versine);
        Point { gap, velocity, sin, cos }
    }

    /// The duration of a flight so short that the initial pull holds for all of it, to thirty digits. Gap and
    /// velocity may be so small that the doubles of the march cannot square them. Also returns the relative
    /// effect of one unit roundoff in P and the phase on the pull. `None` for other flights.
    pub fn brief_flight(&self) -> Option<(High, f64)> {
        let pull = high(1.0) - &self.p * &self.s0;
        let (gap, speed) = (high(self.start_gap), high(self.speed));
        let radicand = &speed * &speed + high(2.0) * &pull * &gap;
        if radicand <= high(0.0) || (low(&pull) <= 0.0 && self.speed >= 0.0) {
            return None;
        }
        let root = radicand.clone().sqrt();
        let h = if self.speed > 0.0 { (&speed + root) / &pull } else { high(2.0) * &gap / (root - &speed) };
        // The next term of the series relative to those before, and the rounding of the pull.
        let force = low(&pull).abs().max(low(&(&speed / &h)).abs());
        let share = low(&h) * self.peak / force;
        let shift = U * self.peak * low(&self.s0).abs() + self.launch_shift * self.peak * low(&self.c0).abs();
        // Cancellation between velocity and pull counts, too.
        let sizes = &speed * &speed + high(2.0) * &pull * &gap * high(low(&pull).signum());
        let doubt = (shift / force + U) * low(&(sizes / &radicand)).max(1.0);
        (low(&h) < 1.0e-40 && share < 1.0e-25).then_some((h, doubt))
    }

    /// Whether the platform is at its crest between the launch and the time `h`; false for a very short
    /// flight.
    fn passes_crest(&self, h: &High) -> bool {
        let ahead = FRAC_PI_2 - low(&self.tau);
        let ahead = if ahead > 0.0 { ahead } else { ahead + TAU };
        low(h) >= ahead.max(0.25)
    }

    /// The effect of one unit roundoff in each of P, w and the launch phase on the gap, the impact phase and
    /// the velocity at the time `h`.
    pub fn limits(&self, h: &High, at: &Point) -> Limits {
        // The gains of the sine and the cosine of the phase, and their differences from the tangents.
        let (sine_gain, cosine_gain, sine_bend, cosine_bend) = if low(h) < 1.0e-2 {
            let (versine, deficit) = versine_and_deficit(h);
            let sine = h - &deficit;
            (
                &self.c0 * &sine - &self.s0 * &versine,
                -(&self.s0 * &sine + &self.c0 * &versine),
                &self.s0 * &versine + &self.c0 * &deficit,
                &self.s0 * &deficit - &self.c0 * &versine,
            )
        } else {
            let (sine, cosine) = (&at.sin - &self.s0, &at.cos - &self.c0);
            let bends = (h * &self.c0 - &sine, &self.s0 * h + &cosine);
            (sine, cosine, bends.0, bends.1)
        };
        let by_peak = self.peak * low(&sine_bend).abs();
        let by_phase = self.peak * low(&cosine_bend).abs();
        // After a crest, heights are counted from the crests, with their own rounding.
        let crest = if self.passes_crest(h) { self.peak } else { 0.0 };
        let gap =
            U * (self.start_gap + self.speed.abs() * low(h) + by_peak + crest) + self.launch_shift * by_phase;
        let slope = low(&at.velocity).abs();
        let curvature = low(&(&self.p * &at.sin - high(1.0))).abs();
        let time = if gap > 0.0 {
            2.0 * gap / (slope + (slope * slope + 2.0 * gap * curvature).sqrt())
        } else {
            0.0
        };
        let own = self.own_shift();
        let phase = time + own + U * TAU;
        let velocity_by_peak = self.peak * low(&cosine_gain).abs();
        let velocity_by_phase = self.peak * low(&sine_gain).abs();
        let velocity = U * (self.speed.abs() + velocity_by_peak + slope)
            + self.launch_shift * velocity_by_phase
            + time * (curvature + self.peak * low(&at.cos).abs() * time);
        Limits { gap, phase, duration: time + own + U * low(h), velocity }
    }

    /// The root near `from` through which the gap falls, by Newton's method; `None` if there is none.
    fn refine(&self, from: &High) -> Option<(High, Point)> {
        let mut h = from.clone();
        let mut at = self.at(&h);
        for _ in 0..60 {
            let slope = low(&at.velocity);
            if slope >= 0.0 {
                return None;
            }
            let step = &at.gap / &at.velocity;
            let size = low(&step).abs();
            if size <= 1.0e-32 * low(&h) {
                // A sign change, by Taylor's theorem with the largest possible curvature, 1 + P.
                let reach = 1.0e-26 * low(&h);
                let margin = slope.abs() * reach - (1.0 + self.peak) * reach * reach;
                return (low(&at.gap).abs() < margin).then_some((h, at));
            }
            if size > 0.1 * low(&h) {
                return None;
            }
            h -= &step;
            at = self.after(at, &h, &-step);
        }
        None
    }

    /// The effect of rounding the phase of separation on the angle; the carried pair is not affected.
    fn own_shift(&self) -> f64 {
        if self.separation { self.launch_shift } else { 0.0 }
    }

    /// Time at which the gap, while it is convex, has its minimum after `from`.
    fn lowest_after(&self, from: &High) -> Option<(High, Point)> {
        let mut h = from.clone();
        for _ in 0..80 {
            let at = self.at(&h);
            let curvature = &self.p * &at.sin - high(1.0);
            if low(&curvature) <= 0.0 {
                return None;
            }
            let step = &at.velocity / &curvature;
            let size = low(&step).abs();
            if size <= 1.0e-30 * low(&h) {
                return Some((h, at));
            }
            if size > 1.0 {
                return None;
            }
            h -= step;
        }
        None
    }

    /// The same if the gap is still concave at `from`: the first time before `end` at which it rises again.
    fn lowest_beyond(&self, from: &High, end: &High) -> Option<(High, Point)> {
        let mut before = from.clone();
        loop {
            let after = &before * high(2.0);
            if low(&(end - &after)) <= 0.0 {
                return None;
            }
            if low(&self.at(&after).velocity) > 0.0 {
                let (mut falling, mut rising) = (before, after);
                for _ in 0..100 {
                    let middle = (&falling + &rising) * high(0.5);
                    if low(&self.at(&middle).velocity) > 0.0 { rising = middle } else { falling = middle }
                }
                let at = self.at(&rising);
                return Some((rising, at));
            }
            before = after;
        }
    }

    /// The start of the search for a root: not at a launch from rest, where the gap has a double or triple
    /// zero but is convex until pi - sigma.
    fn search_start(&self) -> Result<High, String> {
        if self.speed > 0.0 || self.start_gap > 0.0 {
            return Ok(high(0.0));
        }
        let sigma = if self.separation { self.tau.clone() } else { separation_of(&self.p).0 };
        let start = &tables().half_pi * high(2.0) - sigma - &self.tau;
        if low(&start) > 0.0 {
            Ok(start)
        } else {
            Err("from rest where the platform does not fall away".into())
        }
    }

    /// The times at which the disk rises above the crests and comes down to their height, and its speed then.
    fn above_crests(&self) -> Option<(High, High, High)> {
        let depth = &self.p * (high(1.0) - &self.s0) - high(self.start_gap);
        let radicand = &self.disk_speed * &self.disk_speed - high(2.0) * &depth;
        let starts_above = low(&depth) < 0.0;
        if low(&radicand) <= 0.0 || (low(&self.disk_speed) <= 0.0 && !starts_above) {
            return None;
        }
        let fall = radicand.sqrt();
        let until = &self.disk_speed + &fall;
        if starts_above {
            // If this is lost in the rounding of both speeds, the time above the crests is too short to skip.
            return (low(&until) > 1.0e-30 * low(&fall)).then(|| (high(0.0), until, fall));
        }
        Some((high(2.0) * depth / &until, until, fall))
    }

    /// The first impact, by conservative advancement in high precision alone.
    pub fn first_root(&self) -> Result<Solution, String> {
        // To just before it is at the crests' height again, where the gap may already be zero.
        let above = self.above_crests().map(|(from, until, _)| (from, until * high(STEP_SHARE)));
        let mut h = self.search_start()?;
        for _ in 0..MAX_HIGH_STEPS {
            if let Some((from, until)) = &above
                && low(&(&h - from)) >= 0.0
                && low(&(until - &h)) > 0.0
            {
                h = until.clone();
            }
            let point = self.at(&h);
            let at = self.sample(&point);
            if low(&h) > 0.0 && at.gap <= 0.0 {
                return Err(format!("stepped over a root before {}", low(&h)));
            }
            if at.velocity < 0.0
                && at.gap < -0.1 * at.velocity
                && let Some((root, end)) = self.refine(&h)
                && at.falls_for(self.peak, low(&(&root - &h)) * (1.0 + 1.0e-9))
            {
                return Ok(self.solution(root, &end));
            }
            let step = at.safe_step(at.gap, at.velocity, self.peak);
            if step <= 1.0e-30 * low(&h) {
                return Err(format!("a double root at {}", low(&h)));
            }
            h += high(step);
        }
        Err(format!("the advancement stopped at {}", low(&h)))
    }

    /// The smallest gap of any dip (or of an inflection with almost no slope) before `end`, over its
    /// perturbation by a roundoff of the data; infinity if there is none. If it is small, rounding decides
    /// the first impact.
    pub fn smallest_dip_before(&self, end: &High) -> f64 {
        if self.peak <= 1.0 {
            return f64::INFINITY;
        }
        let sigma = separation_of(&self.p).0;
        let last = (low(end) / TAU) as u32 + 2;
        let mut smallest = f64::INFINITY;
        let mut turn = 0;
        while turn <= last {
            // The gap is convex from here to there; only the first and last turns come near the platform.
            let whole = two_pi() * high(f64::from(turn));
            let from = &whole + &sigma - &self.tau;
            let to = whole + &tables().half_pi * high(2.0) - &sigma - &self.tau;
            for h in self.lowest_between(from, to) {
                if low(&h) > 0.0 && low(&(end - &h)) > 0.0 {
                    let at = self.at(&h);
                    smallest = smallest.min(low(&at.gap).abs() / self.limits(&h, &at).gap);
                }
            }
            turn = if turn == 2 { (last - 2).max(3) } else { turn + 1 };
        }
        smallest
    }

    /// The minimum of the gap in a convex piece, and its ends if they have almost no slope.
    fn lowest_between(&self, mut from: High, mut to: High) -> Vec<High> {
        let slope = |h: &High| low(&self.at(h).velocity);
        let (start, end) = (slope(&from), slope(&to));
        let mut flat = Vec::new();
        flat.extend((start.abs() < 1.0e-3 * self.peak).then(|| from.clone()));
        flat.extend((end.abs() < 1.0e-3 * self.peak).then(|| to.clone()));
        if start < 0.0 && end > 0.0 {
            for _ in 0..60 {
                let middle = (&from + &to) * high(0.5);
                if slope(&middle) < 0.0 {
                    from = middle;
                } else {
                    to = middle;
                }
            }
            flat.push(from);
        }
        flat
    }

    fn solution(&self, duration: High, at: &Point) -> Solution {
        Solution {
            phase: self.phase_at(&duration),
            velocity: at.velocity.clone(),
            limits: self.limits(&duration, at),
            duration,
        }
    }

    fn sample(&self, point: &Point) -> Sample {
        Sample {
            gap: low(&point.gap),
            gap_error: 0.0,
            velocity: low(&point.velocity),
            velocity_error: 0.0,
            pull: low(&(high(1.0) - &self.p * &point.sin)),
            pull_error: 0.0,
            third: low(&(&self.p * &point.cos)),
        }
    }

    /// Judges an impact found by the solver.
    pub fn judge(&self, impact: &Impact) -> Result<Verdict, String> {
        check_form(impact)?;
        check_pair(impact.phase, self.own_shift())?;
        let claimed = (two_pi() * high(impact.periods as f64) + high(impact.remainder))
            .with_precision(PRECISION + 32)
            .value();
        let claimed_phase = two_pi() * high(impact.turns as f64) + high(impact.phase.angle());
        let mut verdict = match self.refine(&claimed) {
            Some((root, at)) => Verdict {
                undecidable: false,
                limits: self.limits(&root, &at),
                phase_error: low(&(&claimed_phase - &self.tau - &root)).abs(),
                velocity_error: low(&(high(impact.velocity) - &at.velocity)).abs(),
                duration_error: low(&(&claimed - &root)).abs(),
                duration: root,
                fast_steps: 0,
                high_steps: 0,
            },
            None => Verdict {
                undecidable: true,
                limits: self.limits(&claimed, &self.at(&claimed)),
                phase_error: low(&(&claimed_phase - &self.tau - &claimed)).abs(),
                velocity_error: 0.0,
                duration_error: 0.0,
                duration: claimed.clone(),
                fast_steps: 0,
                high_steps: 0,
            },
        };
        let limits = verdict.limits;
        if verdict.undecidable || verdict.phase_error > PHASE_TOLERANCE.max(PHASE_FACTOR * limits.phase) {
            // No root there: then the gap must be pure rounding.
            let at = self.at(&claimed);
            let residual = low(&at.gap).abs();
            let limits = self.limits(&claimed, &at);
            if residual > DIP_FACTOR * limits.gap {
                return Err(format!("gap of {residual:e} at the impact, {limits:?}; {verdict:?}"));
            }
            verdict = Verdict { undecidable: true, limits, duration: claimed, ..verdict };
        } else {
            let short = impact.periods == 0 && low(&verdict.duration) < 0.5;
            let duration_limit = if short {
                PHASE_FACTOR * limits.duration
            } else {
                PHASE_TOLERANCE.max(PHASE_FACTOR * limits.phase)
            };
            if verdict.duration_error > duration_limit {
                return Err(format!("duration off: {verdict:?}"));
            }
            if verdict.velocity_error > VELOCITY_FACTOR * limits.velocity {
                return Err(format!("velocity off: {verdict:?}"));
            }
        }
        if let Advance::Earlier(earlier) = self.first(&mut verdict)? {
            let end = low(&verdict.duration);
            let message = || format!("missed an impact at {} before {end}", low(&earlier));
            let (dip, at) = self
                .lowest_after(&earlier)
                .or_else(|| self.lowest_beyond(&earlier, &verdict.duration))
                .ok_or_else(message)?;
            let depth = low(&at.gap);
            let limit = self.limits(&dip, &at).gap;
            if low(&dip) >= end || depth < -DIP_FACTOR * limit {
                return Err(format!("{}: dip of {depth:e} at {}, limit {limit:e}", message(), low(&dip)));
            }
            verdict.undecidable = true;
        }
        Ok(verdict)
    }

    /// Looks for a root before the one in the verdict by conservative advancement: the gap's downward
    /// curvature is bounded, so a step within the bound cannot jump over a root. Above the crests of the
    /// platform no impact is possible.
    fn first(&self, verdict: &mut Verdict) -> Result<Advance, String> {
        let target = if verdict.undecidable {
            // Up to where the dip is pure rounding.
            let at = self.at(&verdict.duration);
            let curvature = low(&(&self.p * &at.sin - high(1.0))).abs();
            let width = 4.0 * (2.0 * DIP_FACTOR * verdict.limits.gap / curvature).sqrt();
            &verdict.duration - high(width)
        } else {
            verdict.duration.clone()
        };
        let start = self.search_start()?;
        if let Some((above_from, above_until, fall)) = self.above_crests()
            && low(&above_until) <= low(&target)
        {
            if let Advance::Earlier(h) = self.advance_from_launch(&start, &above_from, false, verdict)? {
                return Ok(Advance::Earlier(h));
            }
            return self.advance_from_crests(&above_until, &fall, &target, verdict);
        }
        self.advance_from_launch(&start, &target, true, verdict)
    }

    /// From `from` to `end` (a root if `to_root`), the gap in doubles written so that it has relative
    /// accuracy.
    fn advance_from_launch(
        &self,
        from: &High,
        end: &High,
        to_root: bool,
        verdict: &mut Verdict,
    ) -> Result<Advance, String> {
        let (start, pair) = ((self.start_gap, self.speed), (low(&self.s0), low(&self.c0)));
        let eval = |t: f64| Sample::after(self.peak, start, pair, t);
        self.advance(&high(0.0), low(from), end, to_root && !verdict.undecidable, eval, verdict)
    }

    /// From the time at which the disk comes down to the height of the crests.
    fn advance_from_crests(
        &self,
        reference: &High,
        fall: &High,
        end: &High,
        verdict: &mut Verdict,
    ) -> Result<Advance, String> {
        let p = self.peak;
        let fall = low(fall);
        let angle = self.phase_at(reference);
        let (s0, c0) = libm::sincos(low(&angle));
        let to_crest = libm::sin(0.5 * low(&(&tables().half_pi - angle)));
        let start_depth = 2.0 * p * to_crest * to_crest;
        let eval = |t: f64| {
            let (s, c) = libm::sincos(t);
            let half = libm::sin(0.5 * t);
            let versine = 2.0 * half * half;
            let size = start_depth + fall * t + 0.5 * t * t + p * (s0.abs() * versine + c0.abs());
            Sample {
                gap: start_depth - t * (fall + 0.5 * t) + p * (s0 * versine - c0 * s),
                gap_error: 32.0 * U * size,
                velocity: -(fall + t) + p * (s0 * s - c0 * c),
                velocity_error: 32.0 * U * (fall + t + p),
                pull: 1.0 - p * (s0 * c + c0 * s),
                pull_error: 16.0 * U * (1.0 + p),
                third: p * (c0 * c - s0 * s),
            }
        };
        self.advance(reference, 0.0, end, !verdict.undecidable, eval, verdict)
    }

    fn advance(
        &self,
        reference: &High,
        start: f64,
        end: &High,
        to_root: bool,
        eval: impl Fn(f64) -> Sample,
        verdict: &mut Verdict,
    ) -> Result<Advance, String> {
        let goal = low(&(end - reference));
        let march = March { peak: self.peak, from: start, to: goal, to_root, clear: None };
        let (steps, open) = march.run(eval);
        verdict.fast_steps += steps;
        let Some(t) = open else { return Ok(Advance::Clear) };
        let mut h = reference + high(t);
        // The last step may have been too long by a rounding: go back a little.
        h = &h - &h * high(4.0 * U);
        if low(&h) <= 0.0 {
            return Err("the advancement does not leave the launch".into());
        }
        for _ in 0..MAX_HIGH_STEPS {
            if low(&(end - &h)) <= 0.0 {
                return Ok(Advance::Clear);
            }
            verdict.high_steps += 1;
            let point = self.at(&h);
            let at = self.sample(&point);
            if to_root && at.falls_for(self.peak, low(&(end - &h)) * (1.0 + 1.0e-9)) {
                return Ok(Advance::Clear);
            }
            let step = if at.gap <= 0.0 { 0.0 } else { at.safe_step(at.gap, at.velocity, self.peak) };
            if step <= 1.0e-32 * low(&h) {
                return Ok(Advance::Earlier(h));
            }
            h += high(step);
        }
        Err(format!("the advancement stopped at {} before {}", low(&h), low(end)))
    }
}

/// Checks the sine and cosine that the phase carries against its angle.
fn check_pair(phase: Phase, own_shift: f64) -> Result<(), String> {
    let (s, c) = libm::sincos(phase.angle());
    let pair_error = (s - phase.sin()).abs().max((c - phase.cos()).abs());
    if pair_error > PAIR_TOLERANCE + 4.0 * own_shift {
        return Err(format!("the carried pair is {pair_error:e} off its angle"));
    }
    Ok(())
}

/// The solver's input for a case.
pub fn launch(case: &Case) -> (Vibration, Launch) {
    let vibration = Vibration::new(case.peak).unwrap();
    let phase =
        if case.separation { vibration.separation_phase().unwrap() } else { Phase::new(case.angle).unwrap() };
    (vibration, Launch::new(phase, case.speed).unwrap())
}
