//! The first root, proven to be the first, of a function that is a polynomial of degree at most 3 plus damped
//! sines.
//!
//! Let G be the function, and M4 a bound on its fourth derivative. A step h from t is certain to pass no root
//! if the cubic Taylor polynomial minus the largest remainder M4 h^4/24 stays above zero. A root is certain
//! to be the first one if the cubic plus that remainder ends below zero, and the function falls or is concave
//! over the whole step (docs/numerics-impacts.md, "The first root of a polynomial and damped sines").
//!
//! Near a simple root a step leaves at most a fifth of the distance to it. Near a minimum of height m, a step
//! leaves a tenth of the distance until this is of the order sqrt(m/G''), so that the rounding error e bounds
//! the number of steps by a multiple of log(1/e). Far from roots a step is at least (G/M4)^(1/4). The
//! campaign on drives needed 880 evaluations at most.

use core::ops::{Add, Mul};

use bouncing_disk_core::Error;
use bouncing_disk_core::numerics::elementary::{exp, sin_cos, sine_deficit_ratio, versine_ratio};
use bouncing_disk_core::parts::{finite, within};

/// Rounding of the terms of an evaluation, relative to their sizes: about 30 roundoffs, of which about 6 are
/// needed.
const ROUNDING: f64 = 32.0 * 1.110_223_024_625_156_5e-16;

/// Evaluations after which a search reports [`Error::NoConvergence`].
const MAX_EVALUATIONS: u32 = 100_000;

/// Largest last correction of a root, by the Taylor cubic, as a share of the time. Over this correction the
/// slope may change by at most the same share.
const LAST_STEP: f64 = 1.0e-2;

/// exp(-d t) (c cos w t + s sin w t), or t times it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DampedSine {
    /// Coefficient c of the cosine.
    pub cosine: f64,
    /// Coefficient s of the sine.
    pub sine: f64,
    /// Angular frequency w >= 0; zero for an exponential (over-damped).
    pub frequency: f64,
    /// Rate of decay d >= 0.
    pub decay: f64,
    /// Whether the term has a factor t (critical damping; an amplitude that grows in time).
    pub with_time: bool,
}

impl DampedSine {
    /// An undamped sine.
    pub(crate) const fn steady(cosine: f64, sine: f64, frequency: f64) -> Self {
        Self { cosine, sine, frequency, decay: 0.0, with_time: false }
    }

    /// Checks that the term is finite and does not grow exponentially.
    fn check(&self) -> Result<(), Error> {
        finite("cosine of a damped sine", self.cosine)?;
        finite("sine of a damped sine", self.sine)?;
        within("frequency of a damped sine", self.frequency, 0.0, 1.0e8, "[0, 1e8]")?;
        within("decay of a damped sine", self.decay, 0.0, 1.0e8, "[0, 1e8] (terms must not grow)")?;
        Ok(())
    }

    /// The real part of (c - i s) (re + i im): the term is the real part of (c - i s) exp(z), z = (i w - d)
    /// t.
    fn part(&self, (re, im): (f64, f64)) -> f64 {
        self.cosine * re + self.sine * im
    }

    fn size(&self) -> f64 {
        self.cosine.abs() + self.sine.abs()
    }

    /// (i w - d)^k times a complex number.
    fn turned(&self, k: u32, z: (f64, f64)) -> (f64, f64) {
        (0..k).fold(z, |z, _| times(z, (-self.decay, self.frequency)))
    }

    /// Value, slope, second and third derivative at zero.
    fn at_zero(&self) -> [f64; 4] {
        let power = |k| self.part(self.turned(k, (1.0, 0.0)));
        if self.with_time {
            [0.0, power(0), 2.0 * power(1), 3.0 * power(2)]
        } else {
            [power(0), power(1), power(2), power(3)]
        }
    }

    /// Adds the term at t minus its value and slope at zero, with its derivatives and the bound on the fourth
    /// derivative from t to the end of the search.
    fn add(&self, t: f64, to: f64, jet: &mut Jet) {
        let rate = self.decay + self.frequency;
        let z = (-self.decay * t, self.frequency * t);
        let (sin, cos) = sin_cos(z.1);
        let e = if self.decay > 0.0 { exp(z.0) } else { 1.0 };
        let whole = (e * cos, e * sin);
        let (second, first) = exponential(z, whole, rate * t);
        let power = rate * rate * rate;
        if self.with_time {
            let scaled = |k: f64| times((k + z.0, z.1), whole);
            jet.value += t * self.part(first);
            jet.slope += self.part(first) + self.part(times(z, whole));
            jet.bend += self.part(self.turned(1, scaled(2.0)));
            jet.third += self.part(self.turned(2, scaled(3.0)));
            jet.fourth += self.size() * power * e * (4.0 + rate * to);
        } else {
            jet.value += self.part(second);
            jet.slope += self.part(self.turned(1, first));
            jet.bend += self.part(self.turned(2, whole));
            jet.third += self.part(self.turned(3, whole));
            jet.fourth += self.size() * power * rate * e;
        }
    }
}

/// Amplitude, exponent z, and exp(z t) at the end of an integral.
type Oscillation = ((f64, f64), (f64, f64), (f64, f64));

/// The integrals from 0 to t of exp(z s) and, if `weighted`, s exp(z s), with the exponential at the end.
fn exponential_integrals(z: (f64, f64), t: f64, end: (f64, f64), weighted: bool) -> [(f64, f64); 2] {
    let x = (z.0 * t, z.1 * t);
    let scaled = |(re, im): (f64, f64), by: f64| (re * by, im * by);
    if x == (0.0, 0.0) {
        return [(t, 0.0), (0.5 * t * t, 0.0)];
    }
    if x.0.abs() + x.1.abs() < 0.5 {
        // Sums of x^k/(k + 1)! and of x^k/(k! (k + 2)).
        let (mut sum, mut second) = ((0.0, 0.0), (0.0, 0.0));
        for k in (1..16).rev() {
            sum = scaled(times(x, (1.0 + sum.0, sum.1)), 1.0 / f64::from(k + 1));
        }
        if weighted {
            let mut power = (1.0, 0.0);
            for k in 0..16 {
                second.0 += power.0 / f64::from(k + 2);
                second.1 += power.1 / f64::from(k + 2);
                power = scaled(times(power, x), 1.0 / f64::from(k + 1));
            }
        }
        return [scaled((1.0 + sum.0, sum.1), t), scaled(second, t * t)];
    }
    let size = z.0 * z.0 + z.1 * z.1;
    let over = |value: (f64, f64)| scaled(times(value, (z.0, -z.1)), 1.0 / size);
    let whole = over((end.0 - 1.0, end.1));
    [whole, if weighted { over((t * end.0 - whole.0, t * end.1 - whole.1)) } else { (0.0, 0.0) }]
}

/// exp(z) - 1 - z and exp(z) - 1 with relative accuracy, for a number z of at most this `size` with the
/// exponential `whole`.
fn exponential(z: (f64, f64), whole: (f64, f64), size: f64) -> ((f64, f64), (f64, f64)) {
    if size < 0.5 {
        let mut sum = (1.0 / 15.0, 0.0);
        for k in (3..15).rev() {
            sum = times(
                (sum.0 * z.0 - sum.1 * z.1 + 1.0, sum.0 * z.1 + sum.1 * z.0),
                (1.0 / f64::from(k), 0.0),
            );
        }
        let sum = (0.5 * (1.0 + (sum.0 * z.0 - sum.1 * z.1)), 0.5 * (sum.0 * z.1 + sum.1 * z.0));
        let second = times(times(z, z), sum);
        (second, (z.0 + second.0, z.1 + second.1))
    } else {
        let first = (whole.0 - 1.0, whole.1);
        ((first.0 - z.0, first.1 - z.1), first)
    }
}

fn times(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}

/// A function near one time: value and derivatives, a bound on the fourth derivative from there on, and the
/// errors of value and slope.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Jet {
    /// The value.
    pub value: f64,
    /// The first derivative.
    pub slope: f64,
    /// The second derivative.
    pub bend: f64,
    /// The third derivative.
    pub third: f64,
    /// Bound on the magnitude of the fourth derivative up to the end of the search.
    pub fourth: f64,
    /// Bound on the error of the value.
    pub error: f64,
    /// Bound on the error of the slope.
    pub slope_error: f64,
    /// Bound on the error of the second derivative.
    pub bend_error: f64,
}

/// A polynomial of degree at most 3 plus damped sines.
///
/// The function is stored as its value and slope at t = 0, and its terms minus their own value and slope
/// there. So a function that starts at zero keeps its relative accuracy arbitrarily close to the start.
///
/// ```
/// use bouncing_disk_core::numerics::elementary::{exp, sin};
/// use bouncing_disk_drives::quasi_polynomial::{DampedSine, FirstRoot, QuasiPolynomial};
///
/// // 1 - t/2 + exp(-t/10) sin t.
/// let ringing = DampedSine { cosine: 0.0, sine: 1.0, frequency: 1.0, decay: 0.1, with_time: false };
/// let sum = QuasiPolynomial::new([1.0, -0.5, 0.0, 0.0], vec![ringing])?;
/// let FirstRoot::Root(root) = sum.first_root(0.0, 100.0)? else { panic!("it falls below zero") };
/// let t = root.at;
/// assert!((1.0 - 0.5 * t + exp(-0.1 * t) * sin(t)).abs() < 1e-14 && root.error < 1e-13);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct QuasiPolynomial {
    start: [f64; 2],
    start_error: [f64; 2],
    bend: f64,
    third: f64,
    terms: Vec<DampedSine>,
    /// Sums of size times rate^k for k = 0, 1, 2.
    sizes: [f64; 3],
    /// The fourth derivative of the undamped terms without t.
    steady_fourth: f64,
    /// Constant and slope of the line, if the function is this line plus the terms. Far from the start the
    /// function is evaluated in this form, because the polynomial with the given value and slope at the start
    /// has a larger rounding error.
    line: Option<[f64; 2]>,
}

/// Radians of the fastest term after which a function is evaluated as a sum of line and terms.
const FAR: f64 = 4.0;

/// A root, and the slope with which the function falls through it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    /// The time of the root.
    pub at: f64,
    /// Bound on its error.
    pub error: f64,
    /// The slope at the root.
    pub slope: f64,
    /// Zero; or a bound on the function's magnitude at the root, if within the error the function may just
    /// touch or miss zero.
    pub doubt: f64,
    /// Evaluations of the function.
    pub evaluations: u32,
}

/// The first root after the start of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FirstRoot {
    /// The function falls through zero here and was positive before.
    Root(Root),
    /// There is no root.
    None {
        /// Evaluations of the function.
        evaluations: u32,
    },
    /// The function comes within its rounding error of zero, and leaves again: rounding hides whether there
    /// is a root.
    Undecided {
        /// The time at which it is lowest.
        at: f64,
        /// Its evaluated value at this time.
        value: f64,
        /// Bound on its magnitude at this time.
        bound: f64,
        /// The time from which it is positive again: the search can be resumed there.
        until: f64,
        /// Evaluations of the function.
        evaluations: u32,
    },
}

impl QuasiPolynomial {
    /// c0 + c1 t + c2 t^2 + c3 t^3 and the terms.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for numbers that are not finite, and for growing terms.
    pub fn new(polynomial: [f64; 4], terms: Vec<DampedSine>) -> Result<Self, Error> {
        let (mut start, mut error) = ([polynomial[0], polynomial[1]], [0.0; 2]);
        for coefficient in polynomial {
            finite("coefficient of a quasi-polynomial", coefficient)?;
        }
        for term in &terms {
            term.check()?;
            let at_zero = term.at_zero();
            for k in 0..2 {
                start[k] += at_zero[k];
                error[k] += ROUNDING * at_zero[k].abs();
            }
        }
        Ok(Self::known(start, error, [polynomial[2], polynomial[3]], terms))
    }

    /// The function with this value and slope at t = 0, known to these errors, plus c2 t^2 + c3 t^3 and the
    /// terms without their own value and slope at t = 0. All numbers are known to be legal.
    pub(crate) fn known(
        start: [f64; 2],
        start_error: [f64; 2],
        [c2, c3]: [f64; 2],
        terms: Vec<DampedSine>,
    ) -> Self {
        let (mut sizes, mut steady_fourth) = ([0.0; 3], 0.0);
        for term in &terms {
            let (size, rate) = (term.size(), term.decay + term.frequency);
            // A term with a factor t counts by its slope.
            if !term.with_time {
                sizes[0] += size;
                sizes[1] += size * rate;
                sizes[2] += size * rate * rate;
            }
            if term.decay == 0.0 && !term.with_time {
                steady_fourth += size * ((rate * rate) * (rate * rate));
            }
        }
        Self { start, start_error, bend: 2.0 * c2, third: 6.0 * c3, terms, sizes, steady_fourth, line: None }
    }

    /// The function with the same second derivative, but with another value and slope at t = 0, known to
    /// these errors.
    #[must_use]
    pub fn starting_with(self, start: [f64; 2], start_error: [f64; 2]) -> Self {
        Self { start, start_error, line: None, ..self }
    }

    /// The function marked as the sum of its terms and this constant, which it equals up to the rounding of
    /// its start.
    pub(crate) fn summed_with(self, constant: f64) -> Self {
        Self { line: Some([constant, 0.0]), ..self }
    }

    /// Adds `change` to the second derivative at all times.
    pub(crate) fn bent_by(mut self, change: f64) -> Self {
        self.bend += change;
        self
    }

    /// The integral from 0, plus this initial value, of a sum of terms and a constant.
    pub(crate) fn integral(self, start: f64) -> Self {
        let mut constant = start;
        let mut terms = Vec::with_capacity(self.terms.len());
        for term in &self.terms {
            let size = term.decay * term.decay + term.frequency * term.frequency;
            // Division by i w - d.
            let over = |(re, im): (f64, f64)| {
                let (re, im) = times((re, im), (-term.decay, -term.frequency));
                (re / size, im / size)
            };
            let once = over((term.cosine, -term.sine));
            let of =
                |(re, im): (f64, f64), with_time| DampedSine { cosine: re, sine: -im, with_time, ..*term };
            terms.push(of(once, term.with_time));
            if term.with_time {
                let (re, im) = over(once);
                terms.push(of((-re, -im), false));
                constant += re;
            } else {
                constant -= once.0;
            }
        }
        let errors = [0.0, self.start_error[0]];
        let slope = self.line.map_or(0.0, |line| line[0]);
        Self { line: Some([constant, slope]), ..Self::known([start, self.start[0]], errors, [0.0; 2], terms) }
    }

    /// The function plus a line.
    #[must_use]
    pub fn plus_line(mut self, constant: f64, slope: f64) -> Self {
        self.start[0] += constant;
        self.start[1] += slope;
        self.line = self.line.map(|line| [line[0] + constant, line[1] + slope]);
        self
    }

    /// `value` times the function plus `slope` times its derivative, for undamped terms.
    pub(crate) fn with_its_slope(self, value: f64, slope: f64) -> Self {
        let terms = self.terms.iter().map(|term| {
            let turned = slope * term.frequency;
            DampedSine {
                cosine: value * term.cosine + turned * term.sine,
                sine: value * term.sine - turned * term.cosine,
                ..*term
            }
        });
        let (bend, third) = (self.bend, self.third);
        let start = [
            value * self.start[0] + slope * self.start[1],
            value * self.start[1] + slope * self.at(0.0, 0.0).bend,
        ];
        let polynomial = [0.5 * (value * bend + slope * third), value * third * (1.0 / 6.0)];
        Self::known(start, [0.0; 2], polynomial, terms.collect())
    }

    /// Value, derivatives and their bounds at t >= 0; the bound on the fourth derivative holds up to `to`.
    #[must_use]
    pub fn at(&self, t: f64, to: f64) -> Jet {
        if let Some(line) = self.line
            && self.terms.iter().any(|term| (term.decay + term.frequency) * t > FAR)
        {
            return self.sum_at(line, t, to);
        }
        let mut jet = Jet { fourth: self.steady_fourth, ..Jet::default() };
        let (mut growing, mut bends) = (0.0, 0.0);
        for term in &self.terms {
            if term.decay == 0.0 && !term.with_time {
                let (w, c, s) = (term.frequency, term.cosine, term.sine);
                let x = w * t;
                let (sin, cos, versine, deficit) = if x < 0.5 {
                    let square = x * x;
                    let (versine, deficit) = (square * versine_ratio(x), square * x * sine_deficit_ratio(x));
                    (x - deficit, 1.0 - versine, versine, deficit)
                } else {
                    let (sin, cos) = sin_cos(x);
                    (sin, cos, 1.0 - cos, x - sin)
                };
                let value = c * cos + s * sin;
                let slope = w * (s * cos - c * sin);
                jet.value -= c * versine + s * deficit;
                jet.slope -= w * (c * sin + s * versine);
                jet.bend -= w * w * value;
                jet.third -= w * w * slope;
            } else {
                let before = jet.fourth;
                term.add(t, to, &mut jet);
                // Beyond the range of doubles the search is hopeless anyway.
                debug_assert!(jet.fourth >= before || to.is_infinite());
                if term.with_time {
                    let rate = term.decay + term.frequency;
                    let x = rate * t;
                    growing += term.size() * (1.0 + x).min(2.0) * x.min(1.0 + x);
                    bends += ROUNDING * term.size() * rate * (2.0 + x);
                }
            }
        }
        let (c0, c1) = (self.start[0], self.start[1]);
        let parabola = 0.5 * self.bend + t * (self.third * (1.0 / 6.0));
        jet.value += c0 + t * (c1 + t * parabola);
        jet.slope += c1 + t * (self.bend + t * (0.5 * self.third));
        jet.bend += self.bend + t * self.third;
        jet.third += self.third;
        let [s0, s1, s2] = self.sizes;
        let pull = self.bend.abs() + t * self.third.abs();
        let near = c1.abs() + t * pull;
        jet.error = self.start_error[0]
            + t * self.start_error[1]
            + ROUNDING * (0.125 * (c0.abs() + t * near) + (t * t * s2).min(s0 + t * s1) + t * growing);
        jet.bend_error = ROUNDING * (0.125 * pull + s2) + bends;
        jet.slope_error = self.start_error[1] + ROUNDING * (0.125 * near + (t * s2).min(2.0 * s1) + growing);
        jet
    }

    /// The integral from 0 to t of the product with another function, in closed form; `None` unless each
    /// function is a line plus damped sines without a factor t.
    #[must_use]
    pub fn product_integral(&self, other: &Self, t: f64) -> Option<f64> {
        let ([a0, a1], [b0, b1]) = (self.line?, other.line?);
        if self.terms.iter().chain(&other.terms).any(|term| term.with_time) {
            return None;
        }
        let lines = t * (a0 * b0 + t * (0.5 * (a0 * b1 + a1 * b0) + t * a1 * b1 * (1.0 / 3.0)));
        let [own, others] = [self, other].map(|sum| sum.oscillations(t));
        let line_with = |[c0, c1]: [f64; 2], &(a, z, end): &Oscillation| {
            let [whole, weighted] = exponential_integrals(z, t, end, c1 != 0.0);
            c0 * times(a, whole).0 + c1 * times(a, weighted).0
        };
        let pair = |&(a, z, end): &Oscillation, &(b, y, other): &Oscillation| {
            let both = |b, y: (f64, f64), other| {
                let [whole, _] = exponential_integrals((z.0 + y.0, z.1 + y.1), t, times(end, other), false);
                times(times(a, b), whole).0
            };
            0.5 * (both(b, y, other) + both((b.0, -b.1), (y.0, -y.1), (other.0, -other.1)))
        };
        let mut total = lines;
        for one in &own {
            total += line_with([b0, b1], one);
            for more in &others {
                total += pair(one, more);
            }
        }
        for more in &others {
            total += line_with([a0, a1], more);
        }
        Some(total)
    }

    /// The terms, one for each exponent: amplitude, exponent, and the exponential at t.
    fn oscillations(&self, t: f64) -> Vec<Oscillation> {
        let mut found: Vec<Oscillation> = Vec::with_capacity(self.terms.len());
        for term in &self.terms {
            let z = (-term.decay, term.frequency);
            if let Some((a, ..)) = found.iter_mut().find(|(_, known, _)| *known == z) {
                *a = (a.0 + term.cosine, a.1 - term.sine);
                continue;
            }
            let (sin, cos) = sin_cos(z.1 * t);
            let e = if z.0 < 0.0 { exp(z.0 * t) } else { 1.0 };
            found.push(((term.cosine, -term.sine), z, (e * cos, e * sin)));
        }
        found
    }

    /// [`Self::at`], evaluated as a sum of line and terms.
    fn sum_at(&self, [constant, slope]: [f64; 2], t: f64, to: f64) -> Jet {
        // Each term minus its value at the start: slow terms keep their digits next to a fast one.
        let mut jet = Jet { value: self.start[0] + t * slope, slope, ..Jet::default() };
        let mut sizes = [constant.abs() + t * slope.abs(), slope.abs(), 0.0];
        for term in &self.terms {
            let (rate, grows) = (term.decay + term.frequency, f64::from(u8::from(term.with_time)));
            let (sin, cos) = sin_cos(term.frequency * t);
            let e = if term.decay > 0.0 { exp(-term.decay * t) } else { 1.0 };
            let whole = (e * cos, e * sin);
            // The derivatives of t exp(z) are (k + z) (i w - d)^(k - 1) exp(z).
            let of = |k: u32| {
                let here = if term.with_time { times((f64::from(k), 0.0), whole) } else { (0.0, 0.0) };
                let along = term.part(term.turned(k, whole)) * if term.with_time { t } else { 1.0 };
                along + if k > 0 { term.part(term.turned(k - 1, here)) } else { 0.0 }
            };
            jet.value += if term.with_time {
                of(0)
            } else {
                term.part(exponential((-term.decay * t, term.frequency * t), whole, rate * t).1)
            };
            jet.slope += of(1);
            jet.bend += of(2);
            jet.third += of(3);
            let size = term.size() * e;
            let cube = size * rate * rate * rate;
            jet.fourth += cube * (rate * (1.0 - grows) + grows * (4.0 + rate * to));
            // The angle is also rounded.
            let size = size * (1.0 + grows * t) * (1.0 + rate * t * 0.05);
            sizes[0] += size;
            sizes[1] += size * (rate + grows);
            sizes[2] += size * (rate + grows) * (rate + grows);
        }
        [jet.error, jet.slope_error, jet.bend_error] = sizes.map(|size| ROUNDING * size);
        jet
    }

    /// The first root in (`from`, `to`].
    ///
    /// A function that starts at exactly zero must rise from there: the start does not count as a root.
    ///
    /// # Errors
    /// [`Error::NoConvergence`] after 100,000 evaluations.
    pub fn first_root(&self, from: f64, to: f64) -> Result<FirstRoot, Error> {
        first_root(|t| self.at(t, to), from, to)
    }
}

impl Add<f64> for QuasiPolynomial {
    type Output = Self;

    fn add(mut self, constant: f64) -> Self {
        self.start[0] += constant;
        self.line = self.line.map(|[own, slope]| [own + constant, slope]);
        self
    }
}

impl Add for QuasiPolynomial {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        for k in 0..2 {
            self.start[k] += other.start[k];
            self.start_error[k] += other.start_error[k];
        }
        self.sizes = core::array::from_fn(|k| self.sizes[k] + other.sizes[k]);
        self.bend += other.bend;
        self.third += other.third;
        self.steady_fourth += other.steady_fourth;
        self.line = self.line.zip(other.line).map(|(a, b)| [a[0] + b[0], a[1] + b[1]]);
        self.terms.extend(other.terms);
        self
    }
}

impl Mul<f64> for QuasiPolynomial {
    type Output = Self;

    fn mul(mut self, factor: f64) -> Self {
        for term in &mut self.terms {
            term.cosine *= factor;
            term.sine *= factor;
        }
        let size = factor.abs();
        Self {
            start: self.start.map(|value| value * factor),
            start_error: self.start_error.map(|error| error * size),
            bend: self.bend * factor,
            third: self.third * factor,
            terms: self.terms,
            sizes: self.sizes.map(|term| term * size),
            steady_fourth: self.steady_fourth * size,
            line: self.line.map(|line| line.map(|value| value * factor)),
        }
    }
}

/// Whether a polynomial is certainly positive on (0, 1], from its Bernstein coefficients: the first one is
/// exact, the others have this `rounding`.
fn all_positive<const N: usize>(bernstein: [f64; N], rounding: f64) -> bool {
    bernstein[0] > 0.0 && bernstein[1..].iter().all(|&b| b > rounding)
}

/// Whether a polynomial is negative on [0, 1].
fn all_negative<const N: usize>(bernstein: [f64; N], rounding: f64) -> bool {
    bernstein.iter().all(|&b| b < -rounding)
}

/// Rounding of the sums in the conditions below, relative to their terms.
const SUM_ROUNDING: f64 = 8.0 * f64::EPSILON;

impl Jet {
    /// Slope, bend, third derivative and bound on the fourth as comparable terms at a distance h, and the
    /// rounding of their sums.
    fn terms(&self, h: f64) -> ([f64; 4], f64) {
        let terms = [self.slope, self.bend * h, self.third * (h * h), self.fourth * (h * h * h)];
        let size = terms[0].abs() + terms[1].abs() + terms[2].abs() + terms[3].abs();
        (terms, SUM_ROUNDING * size)
    }

    /// Whether the function is certainly positive for the next `h`.
    fn clears(&self, h: f64) -> bool {
        let ([v, a, j, m], rounding) = self.terms(h);
        let (g, v) = (self.value - self.error, (v - self.slope_error) * h);
        let (a, j, m) = (a * h, j * h, m * h);
        all_positive(
            [
                g,
                g + 0.25 * v,
                g + 0.5 * v + a * (1.0 / 12.0),
                g + 0.75 * v + 0.25 * a + j * (1.0 / 24.0),
                g + v + 0.5 * a + (j - 0.25 * m) * (1.0 / 6.0),
            ],
            SUM_ROUNDING * g.abs() + rounding * h,
        )
    }

    /// [`Self::clears`] for a function that starts at zero, with this zero divided out.
    fn clears_from_zero(&self, h: f64) -> bool {
        let ([v, a, j, m], rounding) = self.terms(h);
        let a = a - self.bend_error * h;
        let end = (j - 0.25 * m) * (1.0 / 6.0);
        if v > 0.0 {
            let middle = v + a * (1.0 / 3.0) + j * (1.0 / 18.0);
            all_positive([v, v + a * (1.0 / 6.0), middle, v + 0.5 * a + end], rounding)
        } else if a > 0.0 {
            all_positive([a, a + j * (1.0 / 6.0), 0.5 * a + end], rounding)
        } else {
            // From rest with a bend that is pure rounding.
            self.bend >= 0.0 && j > 0.0 && end > rounding
        }
    }

    /// Whether the function has exactly one root in the next `h`, and is negative at its end.
    fn crosses_once(&self, h: f64) -> bool {
        let ([v, a, j, m], rounding) = self.terms(h);
        let v = v + self.slope_error;
        let end = (self.value + self.error) + h * (v + 0.5 * a + (j + 0.25 * m) * (1.0 / 6.0));
        let falls = [
            v,
            v + a * (1.0 / 3.0),
            v + a * (2.0 / 3.0) + j * (1.0 / 6.0),
            v + a + 0.5 * j + m * (1.0 / 6.0),
        ];
        end < -(SUM_ROUNDING * self.value.abs() + rounding * h)
            && (all_negative(falls, rounding) || all_negative([a, a + 0.5 * j, a + j + 0.5 * m], rounding))
    }

    /// [`Self::crosses_once`] for a function that starts at zero and leaves it upwards.
    fn returns_once(&self, h: f64) -> bool {
        let ([v, a, j, m], rounding) = self.terms(h);
        let a = a + self.bend_error * h;
        let falls = if v > 0.0 {
            all_negative([a, a + j * (1.0 / 3.0), a + j * (2.0 / 3.0) + 0.25 * m], rounding)
        } else {
            all_negative([j, j + 0.5 * m], rounding)
        };
        falls && v + 0.5 * a + (j + 0.25 * m) * (1.0 / 6.0) < -rounding
    }

    /// The first positive root of the cubic, as a guess; NaN if there is none.
    fn guess(&self, from_zero: bool) -> f64 {
        let (v, a, j) = (self.slope, self.bend, self.third);
        let g = self.value.max(0.0) + 2.0 * self.error;
        let parabola = if from_zero {
            if v > 0.0 { -2.0 * v / a } else { -3.0 * a / j }
        } else {
            // The stable form of the first root of g + v h + a h^2/2.
            let radicand = v * v - 2.0 * a * g;
            let root = radicand.sqrt();
            if v <= 0.0 { 2.0 * g / (root - v) } else { -(v + root) / a }
        };
        if parabola > 0.0 { self.refined(parabola, from_zero) } else { f64::NAN }
    }

    /// A guess after one Newton step on the cubic.
    fn refined(&self, h: f64, from_zero: bool) -> f64 {
        let (v, a, j) = (self.slope, self.bend, self.third);
        let (value, slope) = if from_zero {
            if v <= 0.0 {
                return h;
            }
            (v + h * (0.5 * a + h * j * (1.0 / 6.0)), 0.5 * a + h * j * (1.0 / 3.0))
        } else {
            let g = self.value.max(0.0) + 2.0 * self.error;
            (g + h * (v + h * (0.5 * a + h * j * (1.0 / 6.0))), v + h * (a + 0.5 * h * j))
        };
        let next = h - value / slope;
        if next > 0.5 * h && next < 2.0 * h { next } else { h }
    }

    /// Whether a function that starts at zero returns after `h`, before its second derivative has changed by
    /// more than rounding; the products of a search would then underflow.
    fn is_brief(&self, h: f64) -> bool {
        let (change, rest) = (self.third.abs() * h, self.fourth * h * h);
        if self.slope > 0.0 {
            change + rest < 1.0e-17 * self.bend.abs()
        } else {
            self.fourth * h < 1.0e-17 * self.third.abs()
        }
    }

    /// The error bound of a nearby root, and a bound on the value: zero unless the slope may vanish within
    /// this error, so that there may be another root or none.
    pub(crate) fn root_error(&self) -> (f64, f64) {
        let Self { error, slope, bend, third, fourth, .. } = *self;
        let steep = 2.0 * error / slope.abs();
        let change = steep * (bend.abs() + steep * (0.5 * third.abs() + steep * fourth * (1.0 / 6.0)));
        if change <= 0.5 * slope.abs() {
            return (steep, 0.0);
        }
        // The distance at which the effect of the bend, or of the third derivative, exceeds the rounding.
        let parabola = (8.0 * error / bend.abs()).sqrt();
        let cubic = libm::cbrt(48.0 * error / third.abs());
        (2.0 * if cubic < parabola { cubic } else { parabola }, 4.0 * error)
    }
}

/// The first root in (`from`, `to`] of a function given by its [`Jet`]s.
///
/// # Errors
/// [`Error::NoConvergence`] if the search does not end.
pub fn first_root(at: impl Fn(f64) -> Jet, from: f64, to: f64) -> Result<FirstRoot, Error> {
    let mut search = Search { at, evaluations: 0 };
    let mut t = from;
    let mut jet = search.jet(t);
    let launch = jet.value == 0.0 && jet.error == 0.0;
    let mut trial = f64::INFINITY;
    // A touch hidden by rounding: its time and the value.
    let mut doubt: Option<(f64, f64, f64)> = None;
    let mut before = t;
    while search.evaluations < MAX_EVALUATIONS {
        let from_zero = launch && t <= from;
        let left = to - t;
        let guess = jet.guess(from_zero);
        for reach in [1.03, 1.3] {
            let h = guess * reach;
            let certain = h > 0.0 && if from_zero { jet.returns_once(h) } else { jet.crosses_once(h) };
            if certain {
                if doubt.is_some() {
                    // First the earlier doubt; the search can be resumed here.
                    return Ok(doubtful(doubt, t, search.evaluations));
                }
                if from_zero && jet.is_brief(guess) {
                    let evaluations = search.evaluations;
                    if guess > left {
                        return Ok(FirstRoot::None { evaluations });
                    }
                    let slope = if jet.slope > 0.0 { -jet.slope } else { -0.5 * guess * jet.bend };
                    let (bend, third) = (jet.bend.abs(), jet.third.abs());
                    let unsure = if jet.slope > 0.0 { bend } else { bend.min(third * guess) };
                    let error = guess * (ROUNDING + jet.bend_error / unsure);
                    return Ok(FirstRoot::Root(Root { at: guess, error, slope, doubt: 0.0, evaluations }));
                }
                if h > left && search.jet(to).value > 0.0 {
                    return Ok(doubtful(doubt, t, search.evaluations));
                }
                let guess = jet.refined(guess, from_zero);
                return search.bracketed((t, t + h), t + guess).map(FirstRoot::Root);
            }
        }
        if !from_zero && jet.value < -jet.error {
            // The doubtful function has become negative.
            return search.bracketed((before, t), t).map(FirstRoot::Root);
        }
        if from_zero || jet.value > jet.error {
            if let Some((lowest, value, bound)) = doubt {
                let evaluations = search.evaluations;
                return Ok(FirstRoot::Undecided { at: lowest, value, bound, until: t, evaluations });
            }
            if left <= 0.0 {
                break;
            }
            // The longest safe step of a few tries.
            let mut h = left.min(trial).min(if guess > 0.0 { 0.98 * guess } else { jet.scale() });
            let mut clear = false;
            // A share of the smallest double is the smallest double.
            while h > f64::EPSILON * t && h > f64::MIN_POSITIVE {
                clear = if from_zero { jet.clears_from_zero(h) } else { jet.clears(h) };
                if clear {
                    break;
                }
                h *= 0.6;
            }
            if clear {
                if h >= left {
                    break;
                }
                before = t;
                t += h;
                trial = 4.0 * h;
                jet = search.jet(t);
                continue;
            }
        }
        // Rounding hides the sign: the search goes to the lowest point, and from there beyond the doubt.
        if doubt.is_none_or(|(_, value, _)| jet.value < value) {
            doubt = Some((t, jet.value, 2.0 * jet.error));
        }
        if left <= 0.0 {
            break;
        }
        let e = 4.0 * jet.error + f64::MIN_POSITIVE;
        let lowest = -jet.slope / jet.bend;
        let h = if jet.slope < 0.0 && lowest > 4.0 * f64::EPSILON * t {
            lowest
        } else {
            let slope = jet.slope.max(0.0);
            2.0 * e / (slope + (slope * slope + 2.0 * e * jet.bend.max(0.0)).sqrt())
        };
        let h =
            if h.is_finite() { h.max(4.0 * f64::EPSILON * t) } else { 4.0 * f64::EPSILON * t.max(1.0e-300) };
        t = if h < left { t + h } else { to };
        jet = search.jet(t);
    }
    if search.evaluations >= MAX_EVALUATIONS {
        return Err(Error::NoConvergence { evaluations: search.evaluations, time: t, gap: jet.value });
    }
    Ok(doubtful(doubt, t, search.evaluations))
}

fn doubtful(doubt: Option<(f64, f64, f64)>, until: f64, evaluations: u32) -> FirstRoot {
    match doubt {
        Some((at, value, bound)) => FirstRoot::Undecided { at, value, bound, until, evaluations },
        None => FirstRoot::None { evaluations },
    }
}

impl Jet {
    /// The time scale on which the function changes.
    fn scale(&self) -> f64 {
        let ratio = 48.0 * self.value.max(self.bend.abs()) / self.fourth;
        if ratio > 0.0 { ratio.sqrt().max(ratio.sqrt().sqrt()) } else { f64::INFINITY }
    }
}

struct Search<F> {
    at: F,
    evaluations: u32,
}

impl<F: Fn(f64) -> Jet> Search<F> {
    fn jet(&mut self, t: f64) -> Jet {
        self.evaluations += 1;
        (self.at)(t)
    }

    /// The root between two times: the function is positive at the first (or it is the start of the flight)
    /// and negative at the second.
    fn bracketed(&mut self, (mut lo, mut hi): (f64, f64), guess: f64) -> Result<Root, Error> {
        let mut t = guess;
        let mut worst = (0.0, 0.0);
        for _ in 0..200 {
            if !(t > lo && t < hi) {
                t = 0.5 * (lo + hi);
                // The root may be tens of decades below the bracket's end.
                if lo < 1.0e-3 * hi && lo > 0.0 {
                    t = (lo * hi).sqrt();
                }
            }
            let jet = self.jet(t);
            worst = (t, jet.value);
            let (g, v) = (jet.value, jet.slope);
            // The root of the Taylor cubic near here: Halley's step, corrected twice.
            let mut step = -2.0 * g * v / (2.0 * v * v - g * jet.bend);
            for _ in 0..2 {
                let value = g + step * (v + step * (0.5 * jet.bend + step * jet.third * (1.0 / 6.0)));
                step -= value / (v + step * (jet.bend + 0.5 * step * jet.third));
            }
            // The remainder of the cubic, and the corrections, which converge by the square of this ratio.
            let square = step * step;
            let settled = jet.fourth * square * square <= f64::EPSILON * v.abs() * t
                && (step * jet.bend).abs() <= LAST_STEP * v.abs()
                && (square * jet.third).abs() <= LAST_STEP * v.abs()
                && step.abs() <= LAST_STEP * t;
            // At or before the start, within rounding.
            let at_once = t + step <= lo && g.abs() <= jet.error;
            let narrow = hi - lo <= 4.0 * f64::EPSILON * t || at_once;
            if g == 0.0 || narrow || settled && v < 0.0 {
                let step = if g == 0.0 || narrow && !at_once { 0.0 } else { step };
                let at = (t + step).clamp(lo, hi);
                let step = at - t;
                let slope = v + step * (jet.bend + 0.5 * step * jet.third);
                let (error, doubt) = jet.root_error();
                let error = error + 2.0 * f64::EPSILON * at;
                return Ok(Root { at, error, slope, doubt, evaluations: self.evaluations });
            }
            if g > 0.0 {
                lo = t;
            } else {
                hi = t;
            }
            t += step;
        }
        Err(Error::NoConvergence { evaluations: self.evaluations, time: worst.0, gap: worst.1 })
    }
}
