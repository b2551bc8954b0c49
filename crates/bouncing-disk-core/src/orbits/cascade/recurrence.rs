//! A periodic orbit represented by a closed sequence of impact times alone.
//!
//! Two impacts at the phases a and b, separated by a flight of h = b - a + 2 pi k, determine this flight:
//! with D = (sin b - sin a)/h the disk leaves with the speed P D + h/2 and arrives with P D - h/2. The law of
//! restitution at every impact is then one equation in three successive times, and its linearisation a
//! three-term recurrence. A flight costs one sine and cosine, and no equation has to be solved.
//!
//! With the relative launch speed w_i, the relative impact velocity u_i and the flight h_i after impact i,
//! the law w_i + r u_i = 0 has derivatives with respect to the phases of impacts i - 1, i and i + 1:
//!
//! - phase i - 1: r w_(i-1)/h_(i-1);
//! - phase i: w_i/h_i - 1 + (1 + r) P sin tau_i - r (u_i/h_(i-1) + 1);
//! - phase i + 1: -u_(i+1)/h_i, which is positive.
//!
//! Two homogeneous and two particular solutions, carried once around, solve the closed recurrence in O(n). On
//! a cascade this is stable: no multiplier exceeds 1, and the growing parts grow like a power of the period.
//! The determinants of the steps telescope to r^(2n), the determinant around the orbit in any coordinates.

use crate::numerics::real::Real;

/// The impacts of an orbit, given by their phases (rad, not reduced), and the periods of the platform that
/// each following flight adds to the difference of the phases.
#[derive(Debug, Clone)]
pub(crate) struct ImpactTimes<R> {
    pub(crate) phases: Vec<R>,
    pub(crate) periods: Vec<i32>,
}

/// The law of restitution at one impact, `w + r u = 0`, and its derivatives with respect to the peak
/// acceleration and to the phases of the previous, this and the next impact.
#[derive(Debug, Clone, Copy)]
struct ImpactEquation<R> {
    residual: R,
    before: R,
    own: R,
    after: R,
    by_peak: R,
}

/// All equations of an orbit: see [`ImpactEquation`].
#[derive(Debug)]
pub(crate) struct Equations<R> {
    of_impacts: Vec<ImpactEquation<R>>,
    /// The largest residual, and the largest speed of an impact.
    pub(crate) worst: f64,
    /// The launch speeds relative to the platform required by the law of restitution, and the durations of
    /// the flights.
    pub(crate) flights: Vec<(f64, f64)>,
}

/// A 2x2 matrix by columns.
type Columns<R> = [[R; 2]; 2];

/// The solution of all equations except the closing one: it maps the changes at the impact before the first
/// and at the first to the same changes one round later.
struct Transfer<R> {
    /// The changes caused by a unit change of either, in sequence.
    homogeneous: [Vec<R>; 2],
    /// The changes caused by the residuals and by a unit of the peak acceleration.
    particular: [Vec<R>; 2],
}

/// The changes of all phases that cancel the residuals, and the changes caused by a unit of the peak
/// acceleration.
#[derive(Debug)]
pub(crate) struct Correction<R> {
    pub(crate) by_residual: Vec<R>,
    pub(crate) by_peak: Vec<R>,
}

impl<R: Real> ImpactTimes<R> {
    pub(crate) fn len(&self) -> usize {
        self.phases.len()
    }

    /// The equations at this orbit.
    pub(crate) fn equations(&self, peak: R, restitution: R) -> Equations<R> {
        let n = self.len();
        let one = R::of(1.0);
        let half = R::of(0.5);
        let pairs: Vec<(R, R)> = self.phases.iter().map(|phase| phase.sin_cos()).collect();
        // Duration, mean rise of the sine, launch speed and impact velocity of the flight after each impact.
        let flights: Vec<(R, R, R, R)> = (0..n)
            .map(|i| {
                let next = (i + 1) % n;
                let duration =
                    self.phases[next] - self.phases[i] + R::of(2.0 * f64::from(self.periods[i])) * R::PI;
                let rise = (pairs[next].0 - pairs[i].0) / duration;
                let launch = peak * (rise - pairs[i].1) + half * duration;
                let impact = peak * (rise - pairs[next].1) - half * duration;
                (duration, rise, launch, impact)
            })
            .collect();
        let mut worst = 0.0_f64;
        let of_impacts = (0..n).map(|i| {
            let (duration, rise, launch, next_impact) = flights[i];
            let (duration_before, rise_before, launch_before, impact) = flights[(i + n - 1) % n];
            let (sin, cos) = pairs[i];
            let residual = launch + restitution * impact;
            worst = worst.max(residual.magnitude().value());
            ImpactEquation {
                residual,
                before: restitution * launch_before / duration_before,
                own: launch / duration - one + peak * sin * (one + restitution)
                    - restitution * (impact / duration_before + one),
                after: -next_impact / duration,
                by_peak: rise - cos + restitution * (rise_before - cos),
            }
        });
        let of_impacts = of_impacts.collect();
        // By the law: for a tiny restitution the difference of the speeds is pure rounding error.
        let launch = |i: usize| (-restitution * flights[(i + n - 1) % n].3).value();
        let flights = (0..n).map(|i| (launch(i), flights[i].0.value())).collect();
        Equations { of_impacts, worst, flights }
    }
}

impl<R: Real> Equations<R> {
    /// Whether all numbers are finite, and every flight leaves the platform and comes back to it.
    pub(crate) fn are_of_flights(&self) -> bool {
        let zero = R::of(0.0);
        self.flights.iter().all(|&(launch, duration)| launch > 0.0 && duration > 0.0 && duration.is_finite())
            && self.of_impacts.iter().all(|impact| impact.after > zero && impact.own.value().is_finite())
    }

    fn transfer(&self) -> Transfer<R> {
        let n = self.of_impacts.len();
        let (zero, one) = (R::of(0.0), R::of(1.0));
        let begun = |before: R, first: R| {
            let mut values = Vec::with_capacity(n + 2);
            values.extend([before, first]);
            values
        };
        let mut homogeneous = [begun(one, zero), begun(zero, one)];
        let mut particular = [begun(zero, zero), begun(zero, zero)];
        for (i, impact) in self.of_impacts.iter().enumerate() {
            let inverse = one / impact.after;
            let next = |values: &[R], right: R| {
                (right - impact.own * values[i + 1] - impact.before * values[i]) * inverse
            };
            for values in &mut homogeneous {
                values.push(next(values, zero));
            }
            for (values, right) in particular.iter_mut().zip([-impact.residual, -impact.by_peak]) {
                values.push(next(values, right));
            }
        }
        Transfer { homogeneous, particular }
    }

    /// The trace of the derivative around the orbit; the determinant is the restitution to the power 2n.
    pub(crate) fn trace(&self) -> R {
        let [first, second] = self.transfer().monodromy();
        first[0] + second[1]
    }

    /// The changes that return with the opposite sign after one round of a flipping orbit (multiplier -1),
    /// scaled so that the largest is 1, and the index of the largest.
    pub(crate) fn flipping_direction(&self) -> (Vec<R>, usize) {
        let transfer = self.transfer();
        let [first, second] = transfer.monodromy();
        let n = self.of_impacts.len();
        // (M + 1) y = 0: the larger of the two rows.
        let one = R::of(1.0);
        let rows = [[first[0] + one, second[0]], [first[1], second[1] + one]];
        let size = |row: &[R; 2]| row[0].magnitude().value().max(row[1].magnitude().value());
        let row = if size(&rows[0]) >= size(&rows[1]) { rows[0] } else { rows[1] };
        let direction = [row[1], -row[0]];
        let mut changes: Vec<R> = (1..=n).map(|i| transfer.homogeneous_at(i, direction)).collect();
        let mut widest = 0;
        for (i, change) in changes.iter().enumerate() {
            if change.magnitude() > changes[widest].magnitude() {
                widest = i;
            }
        }
        let largest = changes[widest];
        for change in &mut changes {
            *change = *change / largest;
        }
        (changes, widest)
    }

    /// The changes of the phases that close the linearised orbit; not finite if it has a multiplier of
    /// exactly 1.
    pub(crate) fn corrected(&self) -> Correction<R> {
        let transfer = self.transfer();
        let [first, second] = transfer.monodromy();
        let n = self.of_impacts.len();
        let one = R::of(1.0);
        // (1 - M) y = the change that the right side produces from zero in one round.
        let (a, b, c, d) = (one - first[0], -second[0], -first[1], one - second[1]);
        let determinant = a * d - b * c;
        let [by_residual, by_peak] = [0, 1].map(|k| {
            let values = &transfer.particular[k];
            let end = [values[n], values[n + 1]];
            let start = [(d * end[0] - b * end[1]) / determinant, (a * end[1] - c * end[0]) / determinant];
            (1..=n).map(|i| values[i] + transfer.homogeneous_at(i, start)).collect()
        });
        Correction { by_residual, by_peak }
    }
}

impl<R: Real> Transfer<R> {
    /// The derivative around the orbit, of (change before, change at the first impact).
    fn monodromy(&self) -> Columns<R> {
        [0, 1].map(|k| {
            let values = &self.homogeneous[k];
            [values[values.len() - 2], values[values.len() - 1]]
        })
    }

    fn homogeneous_at(&self, i: usize, start: [R; 2]) -> R {
        self.homogeneous[0][i] * start[0] + self.homogeneous[1][i] * start[1]
    }
}
