//! The sums of sines of a platform as Taylor series, and the first roots of polynomials from the signs of
//! their derivatives, so that no root is missed.

use crate::numbers::Number;

/// Steps of a refinement, which halves its bracket down to the briefest flights; more are needed only if
/// rounding hides the root.
const MAX_STEPS: u32 = 1_500;

/// A polynomial, and its first two derivatives.
pub fn jet<N: Number>(c: &[N], t: &N) -> [N; 3] {
    let [mut value, mut slope, mut half_bend] = [0.0; 3].map(N::of);
    for c in c.iter().rev() {
        half_bend = half_bend * t.clone() + slope.clone();
        slope = slope * t.clone() + value.clone();
        value = value * t.clone() + c.clone();
    }
    [value, slope, half_bend * N::of(2.0)]
}

/// The time between two others at which the polynomial (its slope for `order` 1) changes its sign.
fn zero<N: Number>(c: &[N], order: usize, mut lo: N, mut hi: N) -> N {
    let zero = N::of(0.0);
    let (mut x, above) = (hi.clone(), jet(c, &hi)[order] > zero);
    for _ in 0..MAX_STEPS {
        let at = jet(c, &x);
        let (value, slope) = (at[order].clone(), at[order + 1].clone());
        *(if (value > zero) == above { &mut hi } else { &mut lo }) = x.clone();
        let newton = (slope != zero).then(|| x.clone() - value / slope);
        let newton = newton.filter(|newton| (&lo..=&hi).contains(&newton));
        let next = newton.unwrap_or_else(|| (lo.clone() + hi.clone()) * N::of(0.5));
        if (next.clone() - x).abs() <= next.clone() * N::of(N::ROUNDING) {
            return next;
        }
        x = next;
    }
    x
}

/// The first root in (0, `to`] of a polynomial that is positive at 0, or leaves zero upwards.
pub fn first_root<N: Number>(c: &[N], to: &N) -> Option<N> {
    first_fall(c, N::of(0.0), to.clone()).map(|(from, to)| zero(c, 0, from, to))
}

/// The two times that enclose the first zero of a polynomial that is positive at the start, or leaves zero
/// upwards.
pub fn first_fall<N: Number>(c: &[N], from: N, to: N) -> Option<(N, N)> {
    let third = (3..c.len())
        .rev()
        .fold(N::of(0.0), |sum, k| sum * to.clone() + c[k].abs() * N::of((k * (k - 1) * (k - 2)) as f64));
    let half = || N::of(0.5);
    let mut open = vec![(from, to)];
    while let Some((a, b)) = open.pop() {
        if b <= a {
            continue;
        }
        let (m, r) = ((a.clone() + b.clone()) * half(), (b.clone() - a.clone()) * half());
        let [gap, slope, bend] = jet(c, &m);
        // Bounds on the changes of slope and bend.
        let change = third.clone() * r.clone();
        let turn = r.clone() * (bend.abs() + change.clone() * half());
        if gap > r.clone() * (slope.abs() + turn.clone() * half()) || slope > turn {
            continue;
        }
        let lowest = if -slope > turn || -bend.clone() > change {
            b
        } else if r <= m.clone() * N::of(N::ROUNDING) {
            // Pure rounding.
            return Some((a, b));
        } else if bend <= change {
            open.extend([(m.clone(), b), (a, m)]);
            continue;
        } else if jet(c, &a)[1] >= N::of(0.0) {
            continue;
        } else if jet(c, &b)[1] <= N::of(0.0) {
            b
        } else {
            zero(c, 1, a.clone(), b)
        };
        if jet(c, &lowest)[0] <= N::of(0.0) {
            return Some((a, lowest));
        }
    }
    None
}

/// The derivatives of a sum of harmonics (amplitude, angle) at one time, starting with the sum itself.
pub fn derivatives<N: Number>(harmonics: &[(f64, f64)], time: &N, count: usize) -> Vec<N> {
    let mut sums = vec![N::of(0.0); count];
    for (j, &(a, angle)) in (1_u32..).zip(harmonics) {
        if a == 0.0 {
            continue;
        }
        let j = N::of(f64::from(j));
        let (sin, cos) = (j.clone() * time.clone() + N::of(angle)).turn();
        let cycle = [sin.clone(), cos.clone(), -sin, -cos];
        let mut factor = N::of(a);
        for (k, sum) in sums.iter_mut().enumerate() {
            *sum = sum.clone() + factor.clone() * cycle[k % 4].clone();
            factor = factor * j.clone();
        }
    }
    sums
}
