//! Sums of a polynomial and damped sines, judged by an oracle.
//!
//! It knows the sum in double-doubles and a bound on its curvature, halves intervals until each is
//! positive: |G(m)| > |G'(m)| d + max|G''| d^2/2 on each. It shares nothing with the solver. Among the sums are
//! nearly cancelling frequencies, and minima at 1e-16 to 1e-3 from zero.

use bouncing_disk_drives::quasi_polynomial::{DampedSine, FirstRoot, QuasiPolynomial};

use crate::launches::SplitMix;
use crate::numbers::{Dd, dd};

/// Whether the function, raised by `doubt`, is positive in (`from`, `to`]; if not, the place where it is not.
fn positive(gap: &Sum, from: f64, to: f64, doubt: f64) -> Result<(), String> {
    let mut stack = vec![(from, to)];
    let mut steps = 0;
    while let Some((a, b)) = stack.pop() {
        if b <= a {
            continue;
        }
        steps += 1;
        if steps > 200_000 {
            return Err(format!("open at {a:e} of {to:e}"));
        }
        let (m, r) = (0.5 * (a + b), 0.5 * (b - a));
        let (value, slope) = gap.at(dd(m));
        let least = (value + dd(doubt)).high() - slope.high().abs() * r - 0.5 * gap.bend(a, b) * r * r;
        if least > 0.0 {
            continue;
        }
        if (value + dd(doubt)).high() <= 0.0 {
            return Err(format!("{:e} at {m:e} of {to:e}", value.high()));
        }
        if r <= 4.0 * f64::EPSILON * m {
            return Err(format!("open: {:e} at {m:e} of {to:e}", value.high()));
        }
        stack.extend([(m, b), (a, m)]);
    }
    Ok(())
}

/// Whether the function has a root within `error` of t.
fn has_root_at(gap: &Sum, t: Dd, error: f64) -> Result<(), String> {
    let (value, slope) = gap.at(t);
    let bend = gap.bend((t.high() - error).max(0.0), t.high() + error);
    let legal = error * (slope.high().abs() + bend * error);
    if value.high().abs() <= legal {
        Ok(())
    } else {
        Err(format!(
            "{:e} at {:e}, where {legal:e} is legal: slope {:e}",
            value.high(),
            t.high(),
            slope.high()
        ))
    }
}

/// exp(x) in double-doubles, for x in [-700, 0].
fn exp(x: Dd) -> Dd {
    let mut halvings = 0;
    let mut y = x;
    while y.high().abs() > 0.01 {
        y = y * dd(0.5);
        halvings += 1;
    }
    let mut sum = dd(1.0);
    for k in (1..14).rev() {
        sum = dd(1.0) + sum * y / dd(f64::from(k));
    }
    (0..halvings).fold(sum, |sum, _| sum * sum)
}

struct Sum {
    polynomial: [f64; 4],
    terms: Vec<DampedSine>,
}

impl Sum {
    /// Value and slope.
    fn at(&self, t: Dd) -> (Dd, Dd) {
        let [c0, c1, c2, c3] = self.polynomial.map(dd);
        let mut value = c0 + t * (c1 + t * (c2 + t * c3));
        let mut slope = c1 + t * (dd(2.0) * c2 + t * (dd(3.0) * c3));
        for term in &self.terms {
            let (w, d) = (dd(term.frequency), dd(term.decay));
            let (sin, cos) = (w * t).sin_cos();
            let e = exp(-(d * t));
            let (c, s) = (dd(term.cosine), dd(term.sine));
            let plain = e * (c * cos + s * sin);
            let derived = e * (w * (s * cos - c * sin)) - d * plain;
            if term.with_time {
                value = value + t * plain;
                slope = slope + plain + t * derived;
            } else {
                value = value + plain;
                slope = slope + derived;
            }
        }
        (value, slope)
    }

    /// A bound on the second derivative between two times.
    fn bend(&self, from: f64, to: f64) -> f64 {
        let [_, _, c2, c3] = self.polynomial;
        let terms: f64 = self
            .terms
            .iter()
            .map(|term| {
                let rate = term.frequency + term.decay;
                let size = (term.cosine.abs() + term.sine.abs()) * libm::exp(-term.decay * from);
                if term.with_time { size * rate * (2.0 + rate * to) } else { size * rate * rate }
            })
            .sum();
        2.0 * c2.abs() + 6.0 * c3.abs() * to + terms
    }
}

fn damped(random: &mut SplitMix) -> Sum {
    let mut terms = Vec::new();
    let count = 1 + random.next() % 4;
    for _ in 0..count {
        let frequency = random.decades(-1.0, 1.5);
        let decay = if random.unit() < 0.3 { 0.0 } else { frequency * random.decades(-3.0, 0.5) };
        terms.push(DampedSine {
            cosine: random.uniform(-1.0, 1.0),
            sine: random.uniform(-1.0, 1.0),
            frequency: if random.unit() < 0.15 && decay > 0.0 { 0.0 } else { frequency },
            decay,
            with_time: random.unit() < 0.25 && decay > 0.0,
        });
    }
    if random.unit() < 0.3 {
        // Nearly equal frequencies that nearly cancel.
        let near =
            DampedSine { frequency: terms[0].frequency * (1.0 + random.decades(-12.0, -2.0)), ..terms[0] };
        terms.push(DampedSine { cosine: -near.cosine, sine: -near.sine, ..near });
    }
    let value: f64 = terms.iter().map(|term| if term.with_time { 0.0 } else { term.cosine }).sum();
    let polynomial =
        [random.decades(-6.0, 1.0) - value, random.uniform(-1.0, 1.0), random.uniform(-0.5, 0.2), 0.0];
    Sum { polynomial, terms }
}

fn judge(sum: &Sum) -> Result<bool, String> {
    let solver = QuasiPolynomial::new(sum.polynomial, sum.terms.clone()).unwrap();
    let end = 60.0;
    match solver.first_root(0.0, end).map_err(|error| error.to_string())? {
        FirstRoot::Root(root) => {
            if root.doubt <= 0.0 || sum.at(dd(root.at)).0.high().abs() > root.doubt {
                has_root_at(sum, dd(root.at), root.error)?;
            }
            positive(sum, 0.0, root.at - 4.0 * root.error, 2.0 * root.doubt)?;
            Ok(root.doubt <= 0.0)
        }
        FirstRoot::None { .. } => positive(sum, 0.0, end, 0.0).map(|()| true),
        FirstRoot::Undecided { at, bound, until, .. } => {
            let value = sum.at(dd(at)).0.high();
            if value.abs() > bound {
                return Err(format!("doubted at {at:e}: {value:e}, bound {bound:e}"));
            }
            positive(sum, 0.0, until, 2.0 * bound)?;
            Ok(false)
        }
    }
}

#[test]
fn first_roots_of_damped_sums() {
    let mut random = SplitMix::new(61);
    let mut failures = Vec::new();
    let mut doubts = 0;
    for _ in 0..4_000 {
        let sum = damped(&mut random);
        match judge(&sum) {
            Ok(decided) => doubts += u32::from(!decided),
            Err(reason) => failures.push(format!("{:?} {:?}: {reason}", sum.polynomial, sum.terms)),
        }
    }
    assert!(failures.is_empty(), "{}: {}", failures.len(), failures[..failures.len().min(4)].join("\n"));
    assert!(doubts <= 2, "{doubts} doubts in random sums");
}

/// Sums lowered until they touch zero, and then by a little more or less.
#[test]
fn grazes_of_damped_sums() {
    let mut random = SplitMix::new(62);
    let mut failures = Vec::new();
    let (mut doubts, mut grazes) = (0, 0);
    while grazes < 1_500 {
        let mut sum = damped(&mut random);
        sum.polynomial[0] += 20.0;
        // The first minimum of a sampling, refined by bisection of the slope.
        let slope = |t: f64| sum.at(dd(t)).1.high();
        let Some(k) =
            (1..600).find(|&k| slope(0.05 * f64::from(k)) < 0.0 && slope(0.05 * f64::from(k + 1)) > 0.0)
        else {
            continue;
        };
        let (mut lo, mut hi) = (0.05 * f64::from(k), 0.05 * f64::from(k + 1));
        for _ in 0..80 {
            let m = 0.5 * (lo + hi);
            if slope(m) < 0.0 { lo = m } else { hi = m }
        }
        let depth = random.sign() * random.decades(-16.0, -3.0);
        sum.polynomial[0] -= sum.at(dd(lo)).0.high() - depth;
        let begins = sum.at(dd(0.0)).0.high() > 1e-3 && positive(&sum, 0.0, 0.9 * lo, 0.0).is_ok();
        if !begins {
            continue;
        }
        grazes += 1;
        match judge(&sum) {
            Ok(decided) => doubts += u32::from(!decided),
            Err(reason) => {
                failures.push(format!("{depth:e} at {lo} {:?} {:?}: {reason}", sum.polynomial, sum.terms));
            }
        }
    }
    assert!(failures.is_empty(), "{}: {}", failures.len(), failures[..failures.len().min(4)].join("\n"));
    // Depths of 1e-16 to 1e-3: a rounding of about 1e-14 leaves two decades of thirteen in doubt.
    assert!(doubts > 0 && doubts < grazes / 3, "{doubts} of {grazes}");
}

#[test]
fn growing_terms_are_refused_by_name() {
    let growing = DampedSine { cosine: 1.0, sine: 0.0, frequency: 1.0, decay: -0.1, with_time: false };
    let refusal = QuasiPolynomial::new([1.0, 0.0, 0.0, 0.0], vec![growing]).unwrap_err().to_string();
    assert!(refusal.contains("terms must not grow"), "{refusal}");
}
