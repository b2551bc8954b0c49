//! A chatter in closed form: every impact, and every sum over impacts, as a power series in r^n.
//!
//! The accumulation point is the same from impact to impact, and near it there is a coordinate y in which going
//! to the next impact is a multiplication by r: the remaining time R is a power series in y, and the n-th impact
//! is at y = r^n. A quantity of an impact is then also a power series in r^n, and its sums are geometric. The
//! remaining times p, q, o at three successive impacts obey the recurrence r (p - q) sum c_k M_k(q, p) = (q - o)
//! sum c_k M_k(q, o), derived in docs/numerics-impacts.md, "Every impact at once". With `[k]` = 1 + r + ... +
//! r^(k-1) and r (1 - r)^2 divided out, this recurrence gives the coefficients rho_m of R:
//!
//! ```text
//! rho_m [m][m-1]/2 = - the coefficient of y^m in  D B + H E  (rho_m = 0 there),
//! H_k = rho_k [k],   D_k = rho_k [k][k-1],   B = sum c_k M_k(q, o)/alpha,
//! E = sum c_k/(alpha (k+1)(k+2)) sum_(1 <= j <= k) (k + 1 - j) q^(k-j) (p^j - o^j)/(1 - r),
//! ```
//!
//! and (p^j - o^j)/(1 - r) has the coefficients `[2k]` of p^j: nothing cancels, however near r is to 1.
//!
//! A quantity f(y) without constant term sums to sum f_k (y_m^k - y_n^k)/(1 - r^k) over the impacts m + 1 to n.
//! The coefficients of flights and speeds omit their common factor 1 - r, so
//! f_k/(1 - r^k) becomes `f_k/[k]`. The difference y_m^k - y_n^k is y_m^k (1 - x)(1 + x + ... + x^(k-1)) with
//! x = r^(n-m) and 1 - x from `expm1`. Work and angle need a sum of f times the decrease of a second series g
//! since impact m, which contains (1 - r) sum y^a (1 - r y) over y = 1, r, r^2, ... In closed form, with z = r x,
//!
//! ```text
//! (1 - x^a)/[a] - r (1 - x^(a+1))/[a+1]
//!     = (1 - x)(1 - z) sum_(i < a) x^i (1 + z + ... + z^(a-i-1)) / ([a][a+1]),
//! ```
//!
//! without a difference of nearly equal numbers: sums over one impact, over ten and over all have the same
//! relative accuracy.

use crate::flight::platform::phase::Phase;
use crate::flight::platform::vibration::Vibration;
use crate::numerics::elementary::{exp, exp_m1, ln, ln_1p, sin_cos_bounded};

use super::expansion::{Expansion, LARGEST_COUNTED_RESTITUTION, LAST_SHARE, SMALLEST_COUNTED_SPEED};

/// Order of the power series. The longest chatter lasts 0.01 rad, so the omitted terms of a sine are below
/// 1e-17 of it.
const ORDER: usize = 6;

/// Newton steps towards the scale of y; the first guess has an error of a thirtieth.
const SCALE_STEPS: u32 = 6;

/// Steps of a bracketed Newton iteration; bisection alone needs this many for a share down to 1e-16 with 50
/// bits.
const ROOT_STEPS: u32 = 110;

/// Relative size of the last step of that iteration; the resulting index is checked.
const LAST_STEP: f64 = 1.0e-15;

/// Largest error of an index due to rounding, in impacts; beyond 2^53 impacts, neighbours differ by less than
/// rounding.
const INDEX_STEPS: u32 = 2;

/// A power series in y = r^n, n the number of impacts since the start of a chatter, truncated at the sixth
/// order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerSeries([f64; ORDER + 1]);

impl PowerSeries {
    /// The series without terms.
    pub const ZERO: Self = Self([0.0; ORDER + 1]);

    /// A number.
    const fn constant(value: f64) -> Self {
        let mut series = Self::ZERO;
        series.0[0] = value;
        series
    }

    /// Each coefficient times a factor that depends on its order.
    fn weighted(&self, factor: impl Fn(usize) -> f64) -> Self {
        let mut result = *self;
        for (order, coefficient) in result.0.iter_mut().enumerate() {
            *coefficient *= factor(order);
        }
        result
    }

    /// The series times a number.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        self.weighted(|_| factor)
    }

    /// The sum of two series.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let mut sum = *self;
        for (mine, its) in sum.0.iter_mut().zip(other.0) {
            *mine += its;
        }
        sum
    }

    /// The product of two series.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let mut product = Self::ZERO;
        for (i, mine) in self.0.iter().enumerate() {
            for (k, its) in other.0[..=ORDER - i].iter().enumerate() {
                product.0[i + k] += mine * its;
            }
        }
        product
    }

    /// This series divided by y; it must have no constant term.
    #[must_use]
    pub fn per_share(&self) -> Self {
        Self(core::array::from_fn(|k| self.0.get(k + 1).copied().unwrap_or(0.0)))
    }

    /// The value at `y`.
    #[must_use]
    pub fn at(&self, y: f64) -> f64 {
        self.0.iter().rev().fold(0.0, |sum, coefficient| sum * y + coefficient)
    }
}

/// The sums 1 + x + ... + x^(k - 1) = (1 - x^k)/(1 - x) for k = 0, 1, ...
fn geometric_sums(x: f64) -> [f64; 2 * ORDER + 1] {
    let mut sums = [0.0; 2 * ORDER + 1];
    for k in 1..sums.len() {
        sums[k] = 1.0 + x * sums[k - 1];
    }
    sums
}

/// x^k for k = 0, 1, ...
fn powers(x: f64) -> [f64; 2 * ORDER + 1] {
    let mut powers = [1.0; 2 * ORDER + 1];
    for k in 1..powers.len() {
        powers[k] = x * powers[k - 1];
    }
    powers
}

/// A chattering sequence in closed form, from [`crate::ImpactMap::chatter_series`].
///
/// Its impacts are numbered from 1; number 0 is the launch from which it starts. The flight that ends with
/// impact n + 1, and the effects of this impact, are power series in r^n. All contain the factor 1 - r. The
/// coefficients omit it, so that they do not vanish near r = 1: such a series represents a quantity divided
/// by 1 - r.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChatterSeries {
    restitution: f64,
    /// ln r.
    rate: f64,
    /// [`geometric_sums`] of r.
    sums: [f64; 2 * ORDER + 1],
    duration: f64,
    remaining: PowerSeries,
    impact_speed: PowerSeries,
    launch_speed: PowerSeries,
    sine: PowerSeries,
    cosine: PowerSeries,
}

impl Vibration {
    /// The chatter after a launch at `phase` with `speed` > 0 in closed form, for a sequence that
    /// [`Self::accumulation`] accepts with a duration above 0 and a `restitution` in (0, 1).
    #[must_use]
    pub(crate) fn chatter_series(&self, phase: Phase, speed: f64, restitution: f64) -> ChatterSeries {
        let (pull, drift) = (self.contact_force(phase), self.velocity(phase));
        let duration = Expansion { pull, drift, restitution }.duration(speed);
        // Pull and drift at the accumulation point, from those at the start: near a separation the pull of a
        // rounded phase would differ.
        let (sin, cos) = sin_cos_bounded(duration);
        let sin_half = sin_cos_bounded(0.5 * duration).0;
        let last_pull = pull - (drift * sin - (1.0 - pull) * (2.0 * sin_half * sin_half));
        let last_drift = drift * cos - (1.0 - pull) * sin;
        let sums = geometric_sums(restitution);
        let shape = Shape::new(restitution, &sums, forces(last_pull, last_drift, duration));
        let scales = powers(shape.scale());
        let scaled = |series: &PowerSeries, unit: f64| series.weighted(|k| scales[k] * unit);
        let remaining = scaled(&shape.remaining, duration);
        let square = remaining.times(&remaining);
        let fourth = square.times(&square);
        let sine = remaining.times(
            &PowerSeries::constant(1.0).plus(&square.scaled(-1.0 / 6.0)).plus(&fourth.scaled(1.0 / 120.0)),
        );
        let versine = square.times(
            &PowerSeries::constant(0.5).plus(&square.scaled(-1.0 / 24.0)).plus(&fourth.scaled(1.0 / 720.0)),
        );
        let (last_sin, last_cos) = sin_cos_bounded(phase.angle() + duration);
        ChatterSeries {
            restitution,
            rate: ln(restitution),
            sums,
            duration,
            remaining,
            impact_speed: scaled(&shape.impact_speed(), last_pull * duration),
            launch_speed: scaled(&shape.launch_speed(), last_pull * duration),
            sine: versine.scaled(-last_sin).plus(&sine.scaled(-last_cos)),
            cosine: versine.scaled(-last_cos).plus(&sine.scaled(last_sin)),
        }
    }
}

/// The pull a time R before the accumulation point relative to the pull there, as a power series in R over
/// `unit`: 1 - P sin(s - R) with a = 1 - P sin s and b = P cos s is a + b sin R + (1 - a)(1 - cos R).
fn forces(pull: f64, drift: f64, unit: f64) -> [f64; ORDER] {
    let (odd, even) = (drift * unit / pull, (1.0 - pull) * unit / pull * unit);
    let square = unit * unit;
    [1.0, odd, even / 2.0, -odd * square / 6.0, -even * square / 24.0, odd * square * square / 120.0]
}

/// The path of a chatter in units of its duration and of the pull at the accumulation point, not yet scaled
/// in y.
struct Shape<'a> {
    sums: &'a [f64; 2 * ORDER + 1],
    squares: [f64; 2 * ORDER + 1],
    forces: [f64; ORDER],
    restitution: f64,
    /// R/T = y + ...
    remaining: PowerSeries,
}

impl<'a> Shape<'a> {
    fn new(restitution: f64, sums: &'a [f64; 2 * ORDER + 1], forces: [f64; ORDER]) -> Self {
        let mut remaining = PowerSeries::ZERO;
        remaining.0[1] = 1.0;
        let mut shape =
            Self { sums, squares: powers(restitution * restitution), forces, restitution, remaining };
        for order in 2..=ORDER {
            let (before, growth) = shape.means_at_impact();
            let decay = shape.remaining.weighted(|k| if k > 0 { sums[k] * sums[k - 1] } else { 0.0 });
            let rest = decay.times(&before).plus(&shape.flight().times(&growth)).0[order];
            shape.remaining.0[order] = -2.0 * rest / (sums[order] * sums[order - 1]);
        }
        shape
    }

    /// The flight divided by 1 - r.
    fn flight(&self) -> PowerSeries {
        self.remaining.weighted(|k| self.sums[k])
    }

    /// The sum of `forces` times the mean of R^k over a flight, weighted with the distance to one end as a
    /// share of the flight. `near` is R^k at that end, `far` at the other.
    fn mean(&self, far: impl Fn(usize) -> PowerSeries, near: impl Fn(usize) -> PowerSeries) -> PowerSeries {
        let (far, near): ([PowerSeries; ORDER], [PowerSeries; ORDER]) =
            (core::array::from_fn(far), core::array::from_fn(near));
        let mut sum = PowerSeries::ZERO;
        for (k, force) in self.forces.iter().enumerate() {
            for j in 0..=k {
                let weight = force * (k + 1 - j) as f64 / ((k + 1) * (k + 2)) as f64;
                sum = sum.plus(&far[k - j].times(&near[j]).scaled(weight));
            }
        }
        sum
    }

    /// R^k.
    fn power(&self, k: usize) -> PowerSeries {
        (0..k).fold(PowerSeries::constant(1.0), |power, _| power.times(&self.remaining))
    }

    /// R^k one impact later.
    fn next_power(&self, k: usize) -> PowerSeries {
        let ratios = powers(self.restitution);
        self.power(k).weighted(|order| ratios[order])
    }

    /// The mean at an impact that determines the launch speed after it, and the excess of the mean that
    /// determines the speed before it, divided by 1 - r.
    fn means_at_impact(&self) -> (PowerSeries, PowerSeries) {
        let after =
            self.mean(|k| self.next_power(k), |k| self.power(k).weighted(|order| self.squares[order]));
        let growth = self.mean(
            |k| self.next_power(k),
            |k| if k > 0 { self.power(k).weighted(|order| self.sums[2 * order]) } else { PowerSeries::ZERO },
        );
        (after, growth)
    }

    /// Speed of the impact that ends the flight, divided by 1 - r.
    fn impact_speed(&self) -> PowerSeries {
        self.flight().times(&self.mean(|k| self.next_power(k), |k| self.power(k)))
    }

    /// Speed of the launch that begins the flight, divided by 1 - r.
    fn launch_speed(&self) -> PowerSeries {
        self.flight().times(&self.mean(|k| self.power(k), |k| self.next_power(k)))
    }

    /// The y at which the whole duration remains.
    fn scale(&self) -> f64 {
        let slopes = self.remaining.weighted(|k| k as f64);
        (0..SCALE_STEPS).fold(1.0, |y, _| y - y * (self.remaining.at(y) - 1.0) / slopes.at(y))
    }
}

impl ChatterSeries {
    /// Whether a chatter after a launch with `speed` has too many impacts for
    /// [`crate::ImpactMap::chatter_impacts`], or impacts too slow to sum one by one.
    #[must_use]
    #[inline]
    pub fn is_needed(speed: f64, restitution: f64) -> bool {
        let slow = speed > 0.0 && speed < SMALLEST_COUNTED_SPEED;
        restitution > LARGEST_COUNTED_RESTITUTION || (slow && restitution > 0.0)
    }

    /// Time from the start to the accumulation point (rad), as in [`crate::ImpactMap::accumulation`].
    #[must_use]
    pub const fn duration(&self) -> f64 {
        self.duration
    }

    /// Time from impact n to the accumulation point (rad), as a series in r^n.
    #[must_use]
    pub const fn remaining(&self) -> &PowerSeries {
        &self.remaining
    }

    /// Duration of the flight after impact n (rad), divided by 1 - r.
    #[must_use]
    pub fn flight(&self) -> PowerSeries {
        self.per_flight(&self.remaining)
    }

    /// Speed |w_A| of impact n + 1, divided by 1 - r, as a series in r^n.
    #[must_use]
    pub const fn impact_speed(&self) -> &PowerSeries {
        &self.impact_speed
    }

    /// Relative launch speed after impact n, divided by 1 - r.
    #[must_use]
    pub const fn launch_speed(&self) -> &PowerSeries {
        &self.launch_speed
    }

    /// Sine and cosine of the phase of impact n minus their values at the accumulation point.
    #[must_use]
    pub const fn pair_changes(&self) -> (&PowerSeries, &PowerSeries) {
        (&self.sine, &self.cosine)
    }

    /// The decrease of a series without constant term over the flight after impact n, divided by 1 - r.
    #[must_use]
    pub fn per_flight(&self, series: &PowerSeries) -> PowerSeries {
        series.weighted(|k| self.sums[k])
    }

    /// The sum over all impacts from n + 1 of a quantity that is given divided by 1 - r; the inverse
    /// of [`Self::per_flight`].
    #[must_use]
    pub fn summed(&self, series: &PowerSeries) -> PowerSeries {
        series.weighted(|k| if k > 0 { 1.0 / self.sums[k] } else { 0.0 })
    }

    /// r^n and 1 - r^n.
    fn share_after(&self, impacts: u64) -> (f64, f64) {
        match impacts {
            0 => (1.0, 0.0),
            1 => (self.restitution, 1.0 - self.restitution),
            _ => {
                let exponent = impacts as f64 * self.rate;
                (exp(exponent), -exp_m1(exponent))
            }
        }
    }

    /// r^n after n impacts, 0 after all of them (`None`).
    #[must_use]
    pub fn share(&self, impacts: Option<u64>) -> f64 {
        impacts.map_or(0.0, |impacts| self.share_after(impacts).0)
    }

    /// The impacts `from` + 1 to `to`, or all from `from` + 1.
    #[must_use]
    pub fn range(&self, from: u64, to: Option<u64>) -> ImpactRange<'_> {
        let (ratio, lost) = to.map_or((0.0, 1.0), |to| self.share_after(to.saturating_sub(from)));
        ImpactRange {
            series: self,
            first: self.share_after(from).0,
            ratio,
            lost,
            sums: geometric_sums(ratio),
        }
    }

    /// Impacts until the launch speed is below 1e-17 of the first one.
    #[must_use]
    pub fn impacts(&self) -> u64 {
        let last = LAST_SHARE * (self.launch_speed.at(1.0) / self.launch_speed.0[1]);
        (ln(last) / self.rate).ceil() as u64
    }

    /// The number of impacts up to `time` (rad) after the start, or `None` if this time is not before the
    /// accumulation point.
    #[must_use]
    pub fn impacts_by(&self, time: f64) -> Option<u64> {
        if time >= self.duration {
            return None;
        }
        let left = self.duration - time;
        let is_by = |impacts: u64| {
            // From the nearer end.
            if left < time {
                self.remaining.at(self.share_after(impacts).0) >= left
            } else {
                self.range(0, Some(impacts)).change(&self.remaining) <= time
            }
        };
        let mut impacts = if left < time {
            let slopes = self.remaining.weighted(|k| k as f64);
            let share = (0..SCALE_STEPS).fold(left / self.remaining.0[1], |share, _| {
                share - share * (self.remaining.at(share) - left) / slopes.at(share)
            });
            (ln(share) / self.rate) as u64
        } else {
            self.first_negative(0, time, &self.remaining).map_or(0, |later| later.saturating_sub(1))
        };
        for _ in 0..INDEX_STEPS {
            if impacts > 0 && !is_by(impacts) {
                impacts -= 1;
            } else if is_by(impacts + 1) {
                impacts += 1;
            }
        }
        Some(impacts)
    }

    /// The first impact n >= `from` at which `start` minus the decrease of `series` from impact `from` to
    /// impact n is negative.
    #[must_use]
    pub fn first_negative(&self, from: u64, start: f64, series: &PowerSeries) -> Option<u64> {
        if start < 0.0 {
            return Some(from);
        }
        let path = Path::new(start, series, self.share_after(from).0);
        if path.is_surely_not_negative() {
            return None;
        }
        let is_negative =
            |later: u64| start - self.range(from, Some(from.saturating_add(later))).change(series) < 0.0;
        path.crossings().into_iter().flatten().find_map(|(crossing, end)| {
            let index = (ln_1p(-crossing) / self.rate).ceil();
            if !index.is_finite() {
                return None;
            }
            let mut later = index as u64;
            for _ in 0..INDEX_STEPS {
                if later > 0 && is_negative(later - 1) {
                    later -= 1;
                }
            }
            // The continuous path may be negative only between two impacts and positive at both: then the
            // next negative stretch decides.
            (self.share_after(later).1 <= end || is_negative(later)).then(|| from.saturating_add(later))
        })
    }
}

/// Consecutive impacts of a chatter, and sums over them.
///
/// If the terms of the series are positive, so are the terms of a sum: nothing cancels, for few impacts or
/// many.
#[derive(Debug, Clone, Copy)]
pub struct ImpactRange<'a> {
    series: &'a ChatterSeries,
    /// r^n at the launch before the first of them.
    first: f64,
    /// The share q of `first` left after the last one, and 1 - q.
    ratio: f64,
    lost: f64,
    /// [`geometric_sums`] of q.
    sums: [f64; 2 * ORDER + 1],
}

impl ImpactRange<'_> {
    /// The decrease of a series from before the first to after the last impact.
    #[must_use]
    pub fn change(&self, series: &PowerSeries) -> f64 {
        self.lost * series.weighted(|k| self.sums[k]).at(self.first)
    }

    /// The sum of a quantity that is given divided by 1 - r.
    #[must_use]
    pub fn sum(&self, quantity: &PowerSeries) -> f64 {
        self.change(&self.series.summed(quantity))
    }

    /// The sum of the products of two quantities of an impact, each given divided by 1 - r.
    #[must_use]
    pub fn product(&self, one: &PowerSeries, other: &PowerSeries) -> f64 {
        (1.0 - self.series.restitution) * self.sum(&one.times(other))
    }

    /// The sum of a `quantity` (given divided by 1 - r) times the decrease of `series` from before the first
    /// impact to after the summed one.
    #[must_use]
    pub fn moment(&self, quantity: &PowerSeries, series: &PowerSeries) -> f64 {
        let (restitution, own) = (self.series.restitution, &self.series.sums);
        // The sums of (1 - r) y^a (1 - r y) over the impacts, y = 1, r, r^2, ...
        let both = geometric_sums(self.ratio * restitution);
        let both_lost = self.lost + self.ratio * (1.0 - restitution);
        let mut moments = [0.0; 2 * ORDER];
        let mut overlap = 0.0;
        for a in 1..moments.len() {
            overlap = both[a] + self.ratio * overlap;
            moments[a] = self.lost * both_lost / (own[a] * own[a + 1]) * overlap;
        }
        let (ratios, scales) = (powers(restitution), powers(self.first));
        let mut sum = 0.0;
        for k in 1..=ORDER {
            for i in 1..=ORDER {
                // 1 - (r y)^i = (1 - r y)(1 + r y + ... + (r y)^(i - 1)).
                let inner: f64 = (0..i).map(|l| ratios[l] * moments[k + l]).sum();
                sum += (quantity.0[k] * scales[k]) * (series.0[i] * scales[i]) * inner;
            }
        }
        sum
    }
}

/// A start value minus the decrease of a series, as a polynomial in the share d in [0, 1] by which r^n has
/// decreased.
struct Path([f64; ORDER + 1]);

impl Path {
    fn new(start: f64, series: &PowerSeries, first: f64) -> Self {
        let scales = powers(first);
        let mut path = [0.0; ORDER + 1];
        path[0] = start;
        let scaled = series.0.iter().zip(scales).map(|(coefficient, scale)| coefficient * scale);
        for (k, coefficient) in scaled.enumerate().skip(1) {
            // 1 - (1 - d)^k, term by term.
            let mut binomial = -1.0;
            for (l, term) in path.iter_mut().enumerate().take(k + 1).skip(1) {
                binomial *= -((k + 1 - l) as f64) / l as f64;
                *term -= coefficient * binomial;
            }
        }
        Self(path)
    }

    fn at(&self, d: f64) -> f64 {
        PowerSeries(self.0).at(d)
    }

    fn derivative(&self) -> Self {
        Self(core::array::from_fn(|k| self.0.get(k + 1).map_or(0.0, |next| (k + 1) as f64 * next)))
    }

    fn is_surely_not_negative(&self) -> bool {
        self.0[0] + self.0[1..].iter().map(|term| term.min(0.0)).sum::<f64>() >= 0.0
    }

    /// The points at which the path falls below zero, with the ends of the monotonic stretches that contain
    /// them.
    fn crossings(&self) -> [Option<(f64, f64)>; ORDER] {
        let mut derivatives: [Self; ORDER] = core::array::from_fn(|_| Self(self.0));
        for k in 1..ORDER {
            derivatives[k] = derivatives[k - 1].derivative();
        }
        // Between the roots of one derivative the previous derivative is monotonic.
        let mut ends = [1.0; ORDER + 1];
        ends[0] = 0.0;
        let mut count = 2;
        for pair in derivatives.windows(2).rev() {
            let [_, slope] = pair else { continue };
            let curvature = slope.derivative();
            let mut next = [1.0; ORDER + 1];
            next[0] = 0.0;
            let mut found = 1;
            for stretch in ends[..count].windows(2) {
                let (low, high) = (stretch[0], stretch[1]);
                if (slope.at(low) < 0.0) != (slope.at(high) < 0.0) {
                    next[found] = slope.root(&curvature, low, high);
                    found += 1;
                }
            }
            (ends, count) = (next, found + 1);
        }
        let mut crossings = [None; ORDER];
        for (crossing, stretch) in crossings.iter_mut().zip(ends[..count].windows(2)) {
            let (low, high) = (stretch[0], stretch[1]);
            if self.at(low) >= 0.0 && self.at(high) < 0.0 {
                *crossing = Some((self.root(&derivatives[1], low, high), high));
            }
        }
        crossings
    }

    /// The root between `low` and `high`, at which the signs differ and between which the path is monotonic.
    fn root(&self, derivative: &Self, mut low: f64, mut high: f64) -> f64 {
        let low_is_negative = self.at(low) < 0.0;
        let mut at = low;
        for _ in 0..ROOT_STEPS {
            let value = self.at(at);
            if (value < 0.0) == low_is_negative {
                low = at;
            } else {
                high = at;
            }
            let newton = at - value / derivative.at(at);
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - at).abs() <= LAST_STEP * next {
                return next;
            }
            at = next;
        }
        at
    }
}

#[cfg(test)]
mod tests;
