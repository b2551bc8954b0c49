//! Taps on a sine: a flight and a compliant contact in succession, computed without a search.
//!
//! The tests below decide on signs and roots. [`CompliantPlatform`] computes the taps that they leave
//! undecided, one in 300 for the motor of Table III.
//!
//! **Closed form.** Let D = (k - 1)^2 + c^2. The gap is y = -1/k + (P/D) ((k - 1) sin t - c cos t) + h, with
//! the free oscillation h'' + c h' + k h = 0. So the force is F = 1 + p1 sin t + p2 cos t + h''. The integral
//! of F is t - p1 cos t + p2 sin t + h', and the integral of this is t^2/2 - p1 sin t - p2 cos t + h. The
//! integrals of F cos t, F sin t and y'^2 are combinations of the derivatives of h cos t, h sin t, h' cos t,
//! h' sin t, h^2 and h'^2. So the values of these functions at the ends of a piece determine all works and
//! losses in it.
//!
//! **Signs by tables.** cos t, sin t and the two free oscillations u1, u2 since the touch are stored as
//! polynomials of degree 9. The pieces have a length of l = 1.5 radians of the fastest rate (1, sqrt(k) or
//! c). Each polynomial matches value and four derivatives at both ends, so its error is at most M10
//! (l/2)^10/10!, 1.6e-8 M10 at l = 1.5. The bound M10 on the tenth derivative follows from the recursion
//! h^(n+2) = -c h^(n+1) - k h^(n) of derivatives and from the energy of h, which falls. On a piece F is a
//! combination of the four functions, with coefficients in Bernstein's form:
//!
//! - If all coefficients are above the error, F > 0.
//! - If their signs change once, also with the error added or subtracted, there is one root, unless |F'|^2 is
//!   below eight times the error times the largest second derivative.
//! - Otherwise the piece is halved, up to six times, and then left undecided.
//!
//! Fourth-order steps on the closed form then polish the root.
//!
//! **The flight.** Let z = k y + c y', which is minus the force without its cut-off. At the release z = 0,
//! and the disk is free as long as z > 0. While y < 0 it then rises, because y' > -(k/c) y > 0. The product y
//! exp(k t/c) rises while z > 0 and falls while z < 0. Suppose that z certainly stays negative once it has
//! fallen below zero. Then y has at most one zero after that, with y' < 0: the touch. If y is negative as z
//! falls through zero, the force returns there. The tables determine the signs of z. If z > 0 up to a time
//! with y > 0, the spring is free as soon as y vanishes, and the first impact of the sine may take over. Both
//! z and F start at zero, and the error of the first piece is of fifth order in time, so all coefficients
//! except the first need only exceed four times the bound.

use core::f64::consts::TAU;
use core::ops::RangeInclusive;

use bouncing_disk_core::numerics::elementary::{
    exp, exp_m1, sin_cos, sine_deficit, versine_ratio, wrapped_angle,
};
use bouncing_disk_core::{Launch, Phase, Vibration};
use bouncing_disk_drives::compliance::CompliantPlatform;

/// Coefficients of a piece: a polynomial that matches the function's first derivatives at both ends.
const COUNT: usize = 10;
const DEGREE: f64 = 9.0;

/// A polynomial on a piece, in Bernstein's form.
type Piece = [f64; COUNT];

/// cos t, sin t, u1 and u2 at a time since the touch.
type Anchor = [f64; 4];

/// Anchors within a piece.
const ANCHORS: usize = (PIECE / (2.0 * NEAR)) as usize + 1;

/// Terms of a Taylor series.
const TERMS: usize = 9;

/// Length of a piece, in radians of the fastest change.
const PIECE: f64 = 1.5;

/// Largest number of pieces of a table; longer contacts are left to the general solver.
const MOST_PIECES: f64 = 256.0;

/// Longest step, in radians of the fastest change, for which Taylor series are used: their first omitted
/// terms are below 3e-17. [`Anchor`]s are twice as far apart.
const NEAR: f64 = 0.05;

/// Rounding of the coefficients of a piece, relative to their terms.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// Largest number of pieces over which a short flight is followed.
const SCANNED: f64 = 5.0;

/// The share of its first piece over which a function that starts at zero must certainly rise.
const START: f64 = 0.125;

/// Bisections of a piece whose coefficients do not decide.
const HALVINGS: u32 = 6;

/// Largest number of fourth-order steps to a root; after a step smaller than [`LAST_STEP`], in radians of the
/// fastest change, only rounding error is left.
const STEPS: u32 = 12;
const LAST_STEP: f64 = 5.0e-5;

/// The closed forms and tables of taps of one system.
#[derive(Debug, Clone)]
pub(crate) struct TapSolver {
    vibration: Vibration,
    stiffness: f64,
    damping: f64,
    /// Half the damping, and the frequency of the free oscillation or, beyond critical damping, the
    /// corresponding rate.
    decay: f64,
    frequency: f64,
    over: bool,
    inverse_frequency: f64,
    inverse_stiffness: f64,
    /// (k - 1)/D and c/D, D = (k - 1)^2 + c^2.
    gain: [f64; 2],
    /// The steady gap is -1/k plus these times sine and cosine of the phase.
    steady: [f64; 2],
    /// The steady force is 1 plus these times sine and cosine of the phase.
    force: [f64; 2],
    /// Length of a piece (rad), and the fastest change.
    length: f64,
    rate: f64,
    /// cos t, sin t, u1 and u2 over the time since the touch.
    pieces: Vec<[Piece; 4]>,
    /// The largest errors of the four functions, including those of their coefficients.
    errors: [f64; 4],
    /// The four functions at the starts of the pieces and at equidistant points within the first piece, and
    /// the Taylor series of u1 and u2 at zero.
    starts: Vec<Anchor>,
    anchors: [Anchor; ANCHORS],
    spacing: f64,
    series: [[f64; TERMS]; 2],
}

/// An instant of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TapInstant {
    /// Time since the touch (rad).
    pub(crate) after: f64,
    /// Sine and cosine of the phase.
    pub(crate) sin: f64,
    /// See [`Self::sin`].
    pub(crate) cos: f64,
    /// The gap minus its steady part, and the derivative of this difference.
    free: f64,
    free_slope: f64,
}

/// Integrals over a contact, each up to a constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TapIntegrals {
    /// Integral of the force.
    pub(crate) impulse: f64,
    /// Integral of that integral.
    pub(crate) lift: f64,
    /// Integral of the force times the cosine of the phase.
    pub(crate) force_cos: f64,
    /// Integral of the force times the sine of the phase.
    pub(crate) force_sin: f64,
    /// Integral of the square of the velocity relative to the platform, times the damping.
    pub(crate) loss: f64,
}

/// The end of a flight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TapTouch {
    /// Duration of the flight (rad).
    pub(crate) duration: f64,
    /// Phase of the touch, and the number of times the phase has passed 0.
    pub(crate) phase: Phase,
    /// See [`Self::phase`].
    pub(crate) turns: u64,
    /// The gap: zero, or negative if the force returns before the spring is free.
    pub(crate) gap: f64,
    /// Velocity relative to the platform.
    pub(crate) velocity: f64,
}

/// A contact, from the touch to the release.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Tap {
    /// Phase of the touch.
    pub(crate) angle: f64,
    /// The touch.
    pub(crate) start: TapInstant,
    /// The release.
    pub(crate) end: TapInstant,
    /// The phase of the release, and the number of times the phase has passed 0 since the touch.
    pub(crate) phase: Phase,
    /// See [`Self::phase`].
    pub(crate) turns: u64,
    /// An upper bound on the force.
    pub(crate) largest_force: f64,
    /// Gap at the release.
    pub(crate) gap: f64,
    /// Velocity relative to the platform at the release.
    pub(crate) velocity: f64,
}

impl TapSolver {
    /// The solver for this platform, if it is a sine and its spring has a damper.
    #[must_use]
    pub(crate) fn new(platform: &CompliantPlatform) -> Option<Self> {
        let vibration = platform.drive().as_vibration()?;
        let (stiffness, damping) = (platform.compliance().stiffness(), platform.compliance().damping());
        if damping == 0.0 {
            return None;
        }
        let (own, decay) = (stiffness.sqrt(), 0.5 * damping);
        let square = (own - decay) * (own + decay);
        let frequency = square.abs().sqrt();
        let size = (stiffness - 1.0) * (stiffness - 1.0) + damping * damping;
        let gain = [(stiffness - 1.0) / size, damping / size];
        let peak = vibration.peak_acceleration();
        let rate = damping.max(own).max(1.0);
        let mut solver = Self {
            vibration,
            stiffness,
            damping,
            decay,
            frequency,
            over: square < 0.0,
            inverse_frequency: 1.0 / frequency,
            inverse_stiffness: 1.0 / stiffness,
            gain,
            steady: [peak * gain[0], -peak * gain[1]],
            force: [-peak * (1.0 + gain[0]), peak * gain[1]],
            length: PIECE / rate,
            rate,
            pieces: Vec::new(),
            errors: [0.0; 4],
            starts: Vec::new(),
            anchors: [[0.0; 4]; ANCHORS],
            spacing: 2.0 * NEAR / rate,
            series: [[0.0; TERMS]; 2],
        };
        let span = (4.0 * TAU).max(2.0 * platform.compliance().contact_time());
        let count = (span * rate / PIECE).min(MOST_PIECES) as usize + 1;
        // The derivatives of a free oscillation are combinations of itself and its slope.
        let mut terms = [[1.0, 0.0]; COUNT + 1];
        for n in 0..COUNT {
            let [value, slope] = terms[n];
            terms[n + 1] = [-stiffness * slope, value - damping * slope];
        }
        let free =
            |[value, slope]: [f64; 2]| core::array::from_fn(|n| terms[n][0] * value + terms[n][1] * slope);
        let states = |k: usize| -> [[f64; COUNT / 2]; 4] {
            let t = k as f64 * solver.length;
            let ((sin, cos), [u1, u2]) = (sin_cos(t), solver.oscillations(t));
            [
                [cos, -sin, -cos, sin, cos],
                [sin, cos, -sin, -cos, sin],
                free([u1, -stiffness * u2]),
                free([u2, u1 - damping * u2]),
            ]
        };
        let pieces: Vec<_> = (0..count)
            .map(|k| {
                let (from, to) = (states(k), states(k + 1));
                core::array::from_fn(|of| between(&from[of], &to[of], solver.length))
            })
            .collect();
        solver.pieces = pieces;
        // (h/2)^10/10! times the largest tenth derivative; the energy of a free oscillation decreases.
        let mut share = 1.0;
        for n in 1..=COUNT {
            share *= 0.5 * solver.length / n as f64;
        }
        let [value, slope] = terms[COUNT].map(f64::abs);
        let tenth = value + slope * own;
        solver.errors = [1.0, 1.0, tenth, tenth / own].map(|most| share * most);
        let sizes = [1.0, 1.0, 1.0, 1.0 / own];
        solver.errors = [0, 1, 2, 3].map(|of| solver.errors[of] + ROUNDING * sizes[of]);
        let mut factor = 1.0;
        for (n, term) in terms[..TERMS].iter().enumerate() {
            factor /= n.max(1) as f64;
            let [first, second] = &mut solver.series;
            (first[n], second[n]) = (term[0] * factor, term[1] * factor);
        }
        let anchor = |t: f64| {
            let ((sin, cos), [u1, u2]) = (sin_cos(t), solver.oscillations(t));
            [cos, sin, u1, u2]
        };
        let starts = (0..count).map(|index| anchor(index as f64 * solver.length)).collect();
        let anchors = core::array::from_fn(|index| anchor(index as f64 * solver.spacing));
        (solver.starts, solver.anchors) = (starts, anchors);
        Some(solver)
    }

    /// u1, which starts with value 1 and slope 0, and u2, which starts with value 0 and slope 1.
    fn oscillations(&self, t: f64) -> [f64; 2] {
        if self.over {
            let slow = self.stiffness / (self.decay + self.frequency);
            let (slowly, lost) = (exp(-slow * t), exp_m1(-2.0 * self.frequency * t));
            let second = -0.5 * lost * self.inverse_frequency * slowly;
            return [slowly * (1.0 + 0.5 * lost) + self.decay * second, second];
        }
        let decayed = exp(-self.decay * t);
        let (sin, cos) = sin_cos(self.frequency * t);
        let second = decayed * if self.frequency > 0.0 { sin * self.inverse_frequency } else { t };
        [decayed * cos + self.decay * second, second]
    }

    /// The same over a short step.
    fn near_oscillations(&self, step: f64) -> [f64; 2] {
        self.series.map(|c| {
            let (s2, s4) = (step * step, (step * step) * (step * step));
            let low = (c[0] + c[1] * step) + s2 * (c[2] + c[3] * step);
            let high = (c[4] + c[5] * step) + s2 * (c[6] + c[7] * step);
            low + s4 * (high + s4 * c[8])
        })
    }

    /// The instant with these values of cos t, sin t, u1 and u2, `after` another one.
    fn later(&self, from: &TapInstant, after: f64, [cos, sin, u1, u2]: Anchor) -> TapInstant {
        let (value, slope) = (from.free, from.free_slope);
        TapInstant {
            after: from.after + after,
            sin: from.sin * cos + from.cos * sin,
            cos: from.cos * cos - from.sin * sin,
            free: value * u1 + slope * u2,
            free_slope: slope * u1 - (self.stiffness * value + self.damping * slope) * u2,
        }
    }

    /// The instant `step` later, for a short step.
    fn moved(&self, from: &TapInstant, step: f64) -> TapInstant {
        let NearSine { sine, versine, .. } = NearSine::of(step);
        let [u1, u2] = self.near_oscillations(step);
        let moved = self.later(from, step, [0.0, sine, u1, u2]);
        TapInstant {
            sin: from.sin + (from.cos * sine - from.sin * versine),
            cos: from.cos - (from.sin * sine + from.cos * versine),
            ..moved
        }
    }

    /// The instant `after` the touch of a contact that begins with `start`; `None` beyond the table.
    #[must_use]
    pub(crate) fn instant(&self, start: &TapInstant, after: f64) -> Option<TapInstant> {
        let piece = (after >= 0.0).then_some((after / self.length) as usize)?;
        let begun = piece as f64 * self.length;
        let index = ((after - begun) / self.spacing + 0.5) as usize;
        let begun_at = self.later(start, begun, *self.starts.get(piece)?);
        let passed = index as f64 * self.spacing;
        let anchor = self.later(&begun_at, passed, *self.anchors.get(index)?);
        Some(self.moved(&anchor, after - (begun + passed)))
    }

    /// A root, near an instant, of the function with this value and these three derivatives; `None` if the
    /// steps do not converge.
    pub(crate) fn polished(
        &self,
        start: &TapInstant,
        from: TapInstant,
        function: impl Fn(&TapInstant) -> [f64; 4],
    ) -> Option<TapInstant> {
        let mut at = from;
        for _ in 0..STEPS {
            let step = step_of(function(&at));
            let size = step.abs() * self.rate;
            at = if size <= NEAR { self.moved(&at, step) } else { self.instant(start, at.after + step)? };
            if size <= LAST_STEP {
                return Some(at);
            }
        }
        None
    }

    /// The sine.
    #[must_use]
    pub(crate) const fn vibration(&self) -> &Vibration {
        &self.vibration
    }

    /// The gap at a release with this relative velocity.
    #[must_use]
    pub(crate) const fn gap_at_release(&self, velocity: f64) -> f64 {
        -self.damping * self.inverse_stiffness * velocity
    }

    /// The energy of the spring at a `gap` <= 0.
    #[must_use]
    pub(crate) const fn spring_energy(&self, gap: f64) -> f64 {
        0.5 * self.stiffness * gap * gap
    }

    /// The integral of the force up to an instant, up to a constant.
    #[must_use]
    pub(crate) fn impulse(&self, at: &TapInstant) -> f64 {
        let [sine, cosine] = self.force;
        at.after - sine * at.cos + cosine * at.sin + at.free_slope
    }

    /// The force at an instant.
    #[must_use]
    pub(crate) fn force(&self, at: &TapInstant) -> f64 {
        let [sine, cosine] = self.force;
        1.0 + sine * at.sin + cosine * at.cos - (self.stiffness * at.free + self.damping * at.free_slope)
    }

    /// The first three derivatives of the force.
    #[must_use]
    pub(crate) fn force_slopes(&self, at: &TapInstant) -> [f64; 3] {
        let [sine, cosine] = self.force;
        let (k, c) = (self.stiffness, self.damping);
        let bend = -(k * at.free + c * at.free_slope);
        let third = -(k * at.free_slope + c * bend);
        let fourth = -(k * bend + c * third);
        let fifth = -(k * third + c * fourth);
        [
            sine * at.cos - cosine * at.sin + third,
            -(sine * at.sin + cosine * at.cos) + fourth,
            fifth - (sine * at.cos - cosine * at.sin),
        ]
    }

    /// The velocity relative to the platform.
    fn velocity(&self, at: &TapInstant) -> f64 {
        let [sine, cosine] = self.steady;
        sine * at.cos - cosine * at.sin + at.free_slope
    }

    /// The integrals up to an instant.
    #[must_use]
    pub(crate) fn integrals(&self, at: &TapInstant) -> TapIntegrals {
        let &TapInstant { after: t, sin: s, cos: c, free: h, free_slope: g } = at;
        let [p, r] = self.force;
        let (sc, ss) = (s * c, s * s);
        // First for h cos and h sin, from the derivatives of h cos, h sin, h' cos and h' sin; then for h'
        // cos, h' sin.
        let first = -(g * c + self.damping * h * c + h * s);
        let second = -(g * s + self.damping * h * s - h * c);
        let [near, far] = self.gain;
        let (in_cos, in_sin) = (near * first - far * second, near * second + far * first);
        let (slope_cos, slope_sin) = (h * c + in_sin, h * s - in_cos);
        let squares = -0.5 * (g * g + self.stiffness * h * h) / self.damping;
        let [a, b] = self.steady;
        let driven = 0.5 * (a * a * (t + sc) + b * b * (t - sc)) - a * b * ss;
        TapIntegrals {
            impulse: self.impulse(at),
            lift: 0.5 * t * t - p * s - r * c + h,
            force_cos: s + 0.5 * (p * ss + r * (t + sc)) + (g * c + slope_sin),
            force_sin: -c + 0.5 * (p * (t - sc) + r * ss) + (g * s - slope_cos),
            loss: self.damping * (driven + 2.0 * (a * slope_cos - b * slope_sin) + squares),
        }
    }

    /// The contact after a touch, if its release can be decided.
    #[must_use]
    pub(crate) fn contact(&self, touch: &TapTouch) -> Option<Tap> {
        let &TapTouch { phase, gap, velocity, .. } = touch;
        let (sin, cos) = (phase.sin(), phase.cos());
        let [a, b] = self.steady;
        let start = TapInstant {
            after: 0.0,
            sin,
            cos,
            free: gap + self.inverse_stiffness - (a * sin + b * cos),
            free_slope: velocity - (a * cos - b * sin),
        };
        let ([p, r], k, c) = (self.force, self.stiffness, self.damping);
        let value = -(k * start.free + c * start.free_slope);
        let slope = -(k * start.free_slope + c * value);
        let weights = [p * sin + r * cos, p * cos - r * sin, value, slope];
        let margin = self.margin(&weights, 1.0);
        // The energy of a free oscillation decreases.
        let largest = 1.0
            + (p * p + r * r).sqrt()
            + (value * value + slope * slope * self.inverse_stiffness).sqrt()
            + margin;
        let mut found = None;
        for (index, piece) in self.pieces.iter().enumerate() {
            let force: Piece = core::array::from_fn(|i| {
                1.0 + (weights[0] * piece[0][i] + weights[1] * piece[1][i])
                    + (weights[2] * piece[2][i] + weights[3] * piece[3][i])
            });
            if lowest(&force) > margin {
                continue;
            }
            let share = first_fall_after(&force, margin, [index == 0 && gap < 0.0, false])?;
            if let Some(share) = share {
                found = Some((index as f64, (index as f64 + share) * self.length));
                break;
            }
        }
        let (index, near) = found?;
        let end = self.polished(&start, self.instant(&start, near)?, |at| {
            let [slope, bend, third] = self.force_slopes(at);
            [self.force(at), slope, bend, third]
        })?;
        let slope = self.force_slopes(&end)[0];
        // There is no second root within the margin: the curvature of the force is below twice its size times
        // the square of the rate, and 288 piece lengths exceed that.
        let bend = 288.0 * largest / (self.length * self.length);
        let within = (index * self.length..=(index + 1.0) * self.length).contains(&end.after);
        if !(within && slope < 0.0 && slope * slope > 8.0 * margin * bend) {
            return None;
        }
        let (angle, turns) = phase_of(phase.angle() + end.after);
        let velocity = self.velocity(&end);
        (velocity > 0.0).then(|| Tap {
            angle: phase.angle(),
            start,
            end,
            phase: Phase::from_parts(angle, end.sin, end.cos),
            turns,
            largest_force: largest,
            gap: self.gap_at_release(velocity),
            velocity,
        })
    }

    fn margin(&self, weights: &[f64; 4], constant: f64) -> f64 {
        let [a, b, c, d] = [0, 1, 2, 3].map(|of| weights[of].abs() * self.errors[of]);
        ROUNDING * constant + ((a + b) + (c + d))
    }

    /// The flight from a release with this `gap` < 0 and `velocity` to the next touch, if it can be decided.
    ///
    /// Let z = k y + c y', the force by which spring and damper would pull at the gap y. The product y exp(k
    /// t/c) rises while z > 0 and falls while z < 0. So y vanishes at most once after z has fallen below zero
    /// for good. At the release z is zero and rises.
    #[must_use]
    pub(crate) fn flight(&self, phase: Phase, gap: f64, velocity: f64) -> Option<TapTouch> {
        let (sin, cos) = (phase.sin(), phase.cos());
        let peak = self.vibration.peak_acceleration();
        let (k, c, start) = (self.stiffness, self.damping, velocity + peak * cos);
        let weights = [
            c * start + k * (gap + peak * sin),
            k * start - c,
            -0.5 * k,
            -peak * (k * sin + c * cos),
            peak * (c * sin - k * cos),
        ];
        let rounding = self.margin(&[weights[3], weights[4], 0.0, 0.0], weights[0].abs());
        let release = Fall { sin, cos, gap, velocity };
        // Beyond a few pieces the search for impacts takes less time.
        let near = 2.0 * start <= SCANNED * self.length;
        let (mut below, mut fallen) = (gap, false);
        for (index, piece) in self.pieces.iter().enumerate() {
            let (from, to) = (index as f64 * self.length, (index + 1) as f64 * self.length);
            let [first, second] = [weights[1] * self.length, weights[2] * self.length * self.length];
            let line = [
                weights[0] + from * (weights[1] + from * weights[2]),
                (weights[1] + 2.0 * from * weights[2]) * self.length,
                second,
            ];
            let pulls: Piece = core::array::from_fn(|i| {
                (line[0] + (line[1] * SHARES[i] + line[2] * PAIRS[i]))
                    + (weights[3] * piece[0][i] + weights[4] * piece[1][i])
            });
            let steps = (index + 1) as f64;
            let margin = rounding + ROUNDING * steps * (first.abs() + steps * second.abs());
            let above = gap
                + to * (velocity - 0.5 * to)
                + peak * (cos * (to - piece[1][COUNT - 1]) + sin * (1.0 - piece[0][COUNT - 1]));
            let mut falls = None;
            if fallen {
                let pushes = lowest(&pulls.map(|pull| -pull)) > margin;
                if !pushes {
                    return None;
                }
            } else if let Some(share) = first_fall_after(&pulls, margin, [index == 0, true])? {
                (fallen, falls) = (true, Some(from + share * self.length));
            } else if above > 0.0 && !near {
                let early =
                    if index == 0 { step_of([gap, velocity, peak * sin - 1.0, peak * cos]) } else { 0.0 };
                let line = from + below / (below - above) * (to - from);
                let guess = if early > from && early < to { early } else { line };
                return self.long_flight(phase, newton(guess, &(from..=to), peak, &release, gap_of)?);
            }
            below = above;
            if !fallen || above > 0.0 {
                continue;
            }
            let line = [
                (gap + peak * sin) + from * (start - 0.5 * from),
                (start - from) * self.length,
                -0.5 * self.length * self.length,
            ];
            let gaps: Piece = core::array::from_fn(|i| {
                (line[0] + (line[1] * SHARES[i] + line[2] * PAIRS[i]))
                    - peak * (sin * piece[0][i] + cos * piece[1][i])
            });
            let touch = gaps[..COUNT - 1].iter().rposition(|&gap| gap > 0.0).and_then(|last| {
                let share = last as f64 + gaps[last] / (gaps[last] - gaps[last + 1]);
                newton(from + share / DEGREE * self.length, &(from..=to), peak, &release, gap_of)
            });
            let ended = |(duration, there): (f64, Fall), gap: f64| {
                let (phase, turns) = there.phase(phase, duration);
                Some(TapTouch { duration, phase, turns, gap, velocity: there.velocity })
            };
            // While the force would push, the gap falls below zero at most once.
            if let Some(touch) = touch
                && touch.1.velocity < 0.0
            {
                return ended(touch, 0.0);
            }
            let pull = |[gap, speed, bend, third, fourth]: [f64; 5]| {
                [k * gap + c * speed, k * speed + c * bend, k * bend + c * third, k * third + c * fourth]
            };
            let again = newton(falls?, &(from..=to), peak, &release, pull)?;
            let gap = self.gap_at_release(again.1.velocity);
            return if again.1.gap < 0.0 { ended(again, gap) } else { None };
        }
        None
    }

    /// The flight of a disk whose spring is `freed`; it ends at the sine's first impact.
    fn long_flight(&self, phase: Phase, (freed, there): (f64, Fall)) -> Option<TapTouch> {
        let rises = there.velocity > 0.0;
        if !rises {
            return None;
        }
        let (start, turns) = there.phase(phase, freed);
        let impact = self.vibration.first_impact(Launch::new(start, there.velocity).ok()?).ok()?;
        Some(TapTouch {
            duration: freed + impact.duration(),
            phase: impact.phase,
            turns: turns + impact.turns,
            gap: 0.0,
            velocity: impact.velocity,
        })
    }
}

const fn gap_of([gap, speed, bend, third, _]: [f64; 5]) -> [f64; 4] {
    [gap, speed, bend, third]
}

/// The fourth-order step to a root from the value and three derivatives of a function.
fn step_of([value, slope, bend, third]: [f64; 4]) -> f64 {
    let square = slope * slope;
    -value * (square - 0.5 * value * bend)
        / (slope * (square - value * bend) + value * value * third * (1.0 / 6.0))
}

/// A root in this range, and the disk there, of the function whose value and three derivatives are computed
/// from those of the gap.
fn newton(
    from: f64,
    range: &RangeInclusive<f64>,
    peak: f64,
    release: &Fall,
    function: impl Fn([f64; 5]) -> [f64; 4],
) -> Option<(f64, Fall)> {
    let (mut at, mut there) = (from, release.after(from, peak));
    for _ in 0..STEPS {
        let step = step_of(function(there.derivatives(peak)));
        at += step;
        there = if step.abs() <= NEAR { there.after(step, peak) } else { release.after(at, peak) };
        if step.abs() <= LAST_STEP * at.min(1.0) {
            return range.contains(&at).then_some((at, there));
        }
    }
    None
}

/// A disk in free flight: sine and cosine of the phase, gap and relative velocity.
#[derive(Debug, Clone, Copy)]
struct Fall {
    sin: f64,
    cos: f64,
    gap: f64,
    velocity: f64,
}

impl Fall {
    /// The gap and its first four derivatives.
    fn derivatives(&self, peak: f64) -> [f64; 5] {
        let (sine, cosine) = (peak * self.sin, peak * self.cos);
        [self.gap, self.velocity, sine - 1.0, cosine, -sine]
    }

    /// The disk at this time after the start.
    fn after(&self, t: f64, peak: f64) -> Self {
        let NearSine { sine, versine, deficit } = if t.abs() <= NEAR {
            NearSine::of(t)
        } else {
            let (sine, cosine) = sin_cos(t);
            let (deficit, versine) = if t < 0.5 {
                (sine_deficit(t, sine), t * t * versine_ratio(t))
            } else {
                (t - sine, 1.0 - cosine)
            };
            NearSine { sine, versine, deficit }
        };
        let &Self { sin, cos, gap, velocity } = self;
        Self {
            sin: sin + (cos * sine - sin * versine),
            cos: cos - (sin * sine + cos * versine),
            gap: gap + t * (velocity - 0.5 * t) + peak * (cos * deficit + sin * versine),
            velocity: velocity - t + peak * (cos * versine + sin * sine),
        }
    }

    /// The phase at this time after the start, and the number of turns removed.
    fn phase(&self, from: Phase, after: f64) -> (Phase, u64) {
        let (angle, turns) = phase_of(from.angle() + after);
        (Phase::from_parts(angle, self.sin, self.cos), turns)
    }
}

/// sin t, 1 - cos t and t - sin t.
struct NearSine {
    sine: f64,
    versine: f64,
    deficit: f64,
}

impl NearSine {
    /// The values for a short step, by series up to the ninth power.
    fn of(t: f64) -> Self {
        let s = t * t;
        let versine = s * (0.5 - s * (1.0 / 24.0 - s * (1.0 / 720.0 - s * (1.0 / 40_320.0))));
        let deficit = t * s * (1.0 / 6.0 - s * (1.0 / 120.0 - s * (1.0 / 5_040.0 - s * (1.0 / 362_880.0))));
        Self { sine: t - deficit, versine, deficit }
    }
}

/// The phase at an angle, and the number of turns removed.
fn phase_of(angle: f64) -> (f64, u64) {
    let phase = wrapped_angle(angle);
    (phase, ((angle - phase) / TAU + 0.5) as u64)
}

/// Coefficients of the line x and of the parabola x^2 on a piece.
const SHARES: Piece =
    [0.0, 1.0 / 9.0, 2.0 / 9.0, 3.0 / 9.0, 4.0 / 9.0, 5.0 / 9.0, 6.0 / 9.0, 7.0 / 9.0, 8.0 / 9.0, 1.0];
const PAIRS: Piece =
    [0.0, 0.0, 2.0 / 72.0, 6.0 / 72.0, 12.0 / 72.0, 20.0 / 72.0, 30.0 / 72.0, 42.0 / 72.0, 56.0 / 72.0, 1.0];

/// The polynomial with these derivatives at both ends of a piece of this length.
fn between(from: &[f64; COUNT / 2], to: &[f64; COUNT / 2], length: f64) -> Piece {
    let mut piece = [0.0; COUNT];
    let mut scale = 1.0;
    let (mut left, mut right) = ([0.0; COUNT / 2], [0.0; COUNT / 2]);
    for j in 0..COUNT / 2 {
        (left[j], right[j]) = (scale * from[j], scale * to[j]);
        scale *= length / (DEGREE - j as f64);
    }
    for i in 0..COUNT / 2 {
        let mut binomial = 1.0;
        for j in 0..=i {
            piece[i] += binomial * left[j];
            piece[COUNT - 1 - i] += if j % 2 == 0 { binomial } else { -binomial } * right[j];
            binomial *= (i - j) as f64 / (j + 1) as f64;
        }
    }
    piece
}

fn lowest(piece: &Piece) -> f64 {
    let least = |a: f64, b: f64| if a < b { a } else { b };
    let half: [f64; COUNT / 2] = core::array::from_fn(|i| least(piece[i], piece[i + COUNT / 2]));
    least(least(least(half[0], half[1]), least(half[2], half[3])), half[4])
}

/// The parts of a polynomial on either side of a division of its piece.
fn split(piece: &Piece, share: f64) -> (Piece, Piece) {
    let (mut left, mut right) = ([0.0; COUNT], *piece);
    for (i, value) in left.iter_mut().enumerate() {
        *value = right[0];
        for j in 0..COUNT - 1 - i {
            right[j] += share * (right[j + 1] - right[j]);
        }
    }
    (left, right)
}

/// [`first_fall`] for a function that may rise from zero at the start of its piece, where the errors of the
/// table vanish with the fifth power of the time.
#[allow(clippy::option_option, reason = "not decided, and no root")]
fn first_fall_after(piece: &Piece, margin: f64, [from_zero, for_good]: [bool; 2]) -> Option<Option<f64>> {
    if !from_zero {
        return first_fall(piece, margin, for_good, HALVINGS);
    }
    if piece[1..].iter().all(|&value| value > 4.0 * margin) {
        return Some(None);
    }
    let (near, far) = split(piece, START);
    if near[1..].iter().any(|&value| value <= 4.0 * margin) {
        return None;
    }
    Some(first_fall(&far, margin, for_good, HALVINGS)?.map(|share| START + (1.0 - START) * share))
}

/// The approximate share of the piece at which a function that starts above zero first falls below zero, if
/// it does. With `for_good`, the function must also stay below zero up to the end of the piece. `None` if
/// values within the margin of zero may decide.
#[allow(clippy::option_option, reason = "not decided, and no root")]
fn first_fall(piece: &Piece, margin: f64, for_good: bool, halvings: u32) -> Option<Option<f64>> {
    let falls = piece.iter().position(|&value| value <= margin);
    let Some(falls) = falls else { return Some(None) };
    let below = piece.iter().position(|&value| value < -margin);
    if let Some(below) = below
        && falls > 0
        && piece[below..].iter().all(|&value| value < -margin)
        // Between them the coefficients fall: any of them may have either sign.
        && piece[falls - 1..=below].is_sorted_by(|a, b| a > b)
    {
        let (above, low) = (piece[below - 1], piece[below]);
        let place = (below - 1) as f64 + above / (above - low);
        return Some(Some((place / DEGREE).clamp(0.0, 1.0)));
    }
    if halvings == 0 || piece[0] <= margin || piece[0].is_nan() {
        return None;
    }
    let (left, right) = split(piece, 0.5);
    match first_fall(&left, margin, for_good, halvings - 1)? {
        Some(_) if for_good && right.iter().any(|&value| value >= -margin) => None,
        Some(share) => Some(Some(0.5 * share)),
        None => Some(first_fall(&right, margin, for_good, halvings - 1)?.map(|share| 0.5 + 0.5 * share)),
    }
}
