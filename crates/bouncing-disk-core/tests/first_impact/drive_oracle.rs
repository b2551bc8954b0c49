//! Flights above drives in 256 bits: the true first root, by the signs of the gap and its derivatives.
//!
//! A drive is what it holds: amplitudes, angles, joints and coefficients are doubles, c3 is a sixth of the
//! third derivative. In the first period of a flight the gap goes on over a joint, whatever the rounding of
//! its heights; later it is the difference of two heights, and the period is 2 pi. No tolerance is added.

use std::cell::OnceCell;
use std::f64::consts::TAU;

use bouncing_disk_core::flight::DrivenImpact;

use crate::drives::Exact;
use crate::oracle::{High, PRECISION, high, low, sin_cos, two_pi};

/// Orders of the Taylor series of a Fourier sum: 2^-36/36! is below 1e-52.
const ORDERS: usize = 36;

fn abs(x: &High) -> High {
    if *x < High::ZERO { -x } else { x.clone() }
}

/// A polynomial, and its first two derivatives.
fn jet(c: &[High], t: &High) -> [High; 3] {
    let [mut value, mut slope, mut half_bend] = [high(0.0), high(0.0), high(0.0)];
    for c in c.iter().rev() {
        half_bend = half_bend * t + &slope;
        slope = slope * t + &value;
        value = value * t + c;
    }
    [value, slope, half_bend * high(2.0)]
}

/// Where the polynomial (its slope for `order` 1) changes its sign between two times.
fn zero(c: &[High], order: usize, mut lo: High, mut hi: High) -> High {
    let (mut x, above) = (hi.clone(), jet(c, &hi)[order] > High::ZERO);
    loop {
        let at = jet(c, &x);
        let (value, slope) = (&at[order], &at[order + 1]);
        *(if (*value > High::ZERO) == above { &mut hi } else { &mut lo }) = x.clone();
        let newton = (*slope != High::ZERO).then(|| &x - value / slope);
        let newton = newton.filter(|newton| (&lo..=&hi).contains(&newton));
        let next = newton.unwrap_or_else(|| (&lo + &hi) * high(0.5));
        if abs(&(&next - &x)) <= &next * high(1e-50) {
            return next;
        }
        x = next;
    }
}

/// The first root in (0, `to`] of a polynomial that is positive at 0, or leaves zero upwards.
fn first_root(c: &[High], to: &High) -> Option<High> {
    let sizes: Vec<_> = c.iter().map(abs).collect();
    let third = (3..c.len())
        .rev()
        .fold(high(0.0), |sum, k| sum * to + &sizes[k] * high((k * (k - 1) * (k - 2)) as f64));
    let mut open = vec![(high(0.0), to.clone())];
    while let Some((a, b)) = open.pop() {
        let (m, r) = ((&a + &b) * high(0.5), (&b - &a) * high(0.5));
        let [gap, slope, bend] = jet(c, &m);
        // By how much slope and bend change at most.
        let (turn, change) = (&r * (abs(&bend) + &third * &r * high(0.5)), &third * &r);
        if gap > &r * (abs(&slope) + &turn * high(0.5)) || slope > turn {
            continue;
        }
        let lowest = if -slope > turn || -&bend > change {
            b
        } else if bend <= change {
            open.extend([(m.clone(), b), (a, m)]);
            continue;
        } else if jet(c, &a)[1] >= High::ZERO {
            continue;
        } else if jet(c, &b)[1] <= High::ZERO {
            b
        } else {
            zero(c, 1, a.clone(), b)
        };
        if jet(c, &lowest)[0] <= High::ZERO {
            return Some(zero(c, 0, a, lowest));
        }
    }
    None
}

impl Exact {
    /// Where the drive is cut, in one period.
    fn cuts(&self) -> Vec<f64> {
        let count = 13 * self.harmonics.len();
        let cut = |k: usize| k as f64 / count as f64 * TAU;
        if count == 0 { self.joints.clone() } else { (0..=count).map(cut).collect() }
    }

    /// The Taylor coefficients of the height from a cut on.
    fn taylor(&self, cut: f64) -> Vec<High> {
        if self.harmonics.is_empty() {
            let at = self.drive.at(cut);
            return vec![
                high(at.height),
                high(at.velocity),
                high(0.5 * at.acceleration),
                high(at.jerk) / high(6.0),
            ];
        }
        let mut sums = vec![high(0.0); ORDERS];
        let (sin, cos) = sin_cos(&high(cut));
        let (mut s, mut c) = (sin.clone(), cos.clone());
        for (j, &(a, angle)) in (1_u32..).zip(&self.harmonics) {
            let (sin_angle, cos_angle) = sin_cos(&high(angle));
            let (value, slope) = (&s * &cos_angle + &c * &sin_angle, &c * &cos_angle - &s * &sin_angle);
            let derivatives = [value.clone(), slope.clone(), -value, -slope];
            let mut factor = high(a);
            for (k, sum) in sums.iter_mut().enumerate() {
                *sum += &factor * &derivatives[k % 4];
                factor *= high(f64::from(j));
            }
            (s, c) = (&s * &cos + &c * &sin, &c * &cos - &s * &sin);
        }
        let mut factorial = high(1.0);
        for (k, sum) in sums.iter_mut().enumerate().skip(1) {
            factorial *= high(k as f64);
            *sum /= &factorial;
        }
        sums
    }
}

/// A flight from the platform, with this relative speed.
pub struct Flight<'a> {
    of: &'a Exact,
    time: f64,
    speed: f64,
    cuts: Vec<f64>,
    pieces: Vec<OnceCell<(Vec<High>, f64)>>,
}

impl<'a> Flight<'a> {
    pub fn new(of: &'a Exact, time: f64, speed: f64) -> Self {
        let cuts = of.cuts();
        Self { of, time, speed, pieces: vec![OnceCell::new(); cuts.len() - 1], cuts }
    }

    /// The Taylor coefficients of a piece, and what it is nowhere higher than.
    fn piece(&self, piece: usize) -> &(Vec<High>, f64) {
        self.pieces[piece].get_or_init(|| {
            let c = self.of.taylor(self.cuts[piece]);
            let mut sizes: Vec<_> = c.iter().map(abs).collect();
            sizes[0] = c[0].clone();
            let top = low(&jet(&sizes, &high(self.cuts[piece + 1] - self.cuts[piece]))[0]);
            (c, top + 1e-9 * top.abs())
        })
    }

    /// Calls with the start and the length of each stretch and its gap, until something is found.
    fn walk(&self, visit: &mut impl FnMut(&High, &High, &[High]) -> Option<High>) -> High {
        let (of, cuts, count) = (self.of, &self.cuts, self.pieces.len());
        let mut piece = cuts.partition_point(|&cut| cut <= self.time).min(count) - 1;
        let (mut from, mut c) = (high(self.time), self.piece(piece).0.clone());
        // Begun anew at the launch.
        for k in 0..c.len() {
            for n in (k..c.len() - 1).rev() {
                c[n] = &c[n] + &c[n + 1] * (&from - high(cuts[piece]));
            }
        }
        let (height, disk) = (c[0].clone(), &c[1] + high(self.speed));
        let tops = || (0..count).map(|piece| self.piece(piece).1).fold(f64::NEG_INFINITY, f64::max);
        let highest = if of.joints.is_empty() { (1.0 + 1e-9) * of.sizes(0) } else { tops() };
        // When the disk is above all of the platform.
        let (up, depth) = (low(&disk), highest - low(&height));
        let until = if up > 0.0 { up + (up * up - 2.0 * depth).sqrt() } else { f64::NAN };
        let (mut begin, mut gap, mut speed, mut turns) = (high(0.0), high(0.0), high(self.speed), 0.0);
        loop {
            let in_first = |begin: &High| low(begin) <= TAU;
            let at_joint = piece + 1 < count || in_first(&begin) && !of.joints.is_empty();
            let length = if at_joint { high(cuts[piece + 1]) } else { two_pi().clone() } - &from;
            let mut own: Vec<_> = c.iter().map(|c| -c).collect();
            (own[0], own[1]) = (gap, speed);
            own[2] -= high(0.5);
            // A parabola is nowhere lower than at the lower of two ends.
            let (t, after) = (low(&begin), low(&(&begin + &length)));
            let least = low(&height) + (t * (up - 0.5 * t)).min(after * (up - 0.5 * after));
            let clear = t > TAU && least > self.piece(piece).1 + 1e-9 * (t * t + highest.abs());
            if !clear && let Some(found) = visit(&begin, &length, &own) {
                return found;
            }
            begin += &length;
            let carried = in_first(&begin).then(|| (jet(&own, &length), jet(&c, &length)[1].clone()));
            piece = (piece + 1) % count;
            turns += if piece == 0 { 1.0 } else { 0.0 };
            let ahead = ((until - 1e-6 + self.time) / TAU).floor();
            if carried.is_none() && low(&begin) > 2.0 * depth / until + 1e-6 && ahead > turns {
                (turns, piece) = (ahead, 0);
            }
            (from, c) = (high(cuts[piece]), self.piece(piece).0.clone());
            if let Some((there, before)) = carried {
                [gap, speed, _] = there;
                let kink = &c[1] - before;
                // As the drive defines it.
                if low(&kink).abs() > 1e-12 * of.drive.bounds().speed {
                    speed -= kink;
                }
            } else {
                begin = (two_pi() * high(turns) + &from - high(self.time)).with_precision(PRECISION).value();
                gap = &height - &c[0] + &begin * (&disk - &begin * high(0.5));
                speed = &disk - &begin - &c[1];
            }
        }
    }

    /// When the gap, raised by this much, is zero for the first time.
    fn first(&self, raised: f64) -> High {
        self.walk(&mut |begin, length, gap| {
            let mut gap = gap.to_vec();
            gap[0] += high(raised);
            // Heights may jump by their rounding.
            if gap[0] < High::ZERO {
                Some(begin.clone())
            } else {
                first_root(&gap, length).map(|t| begin + t)
            }
        })
    }

    fn gap_at(&self, time: &High) -> f64 {
        low(&self.walk(&mut |begin, length, gap| {
            let t = time - begin;
            (t <= *length).then(|| jet(gap, &t)[0].clone())
        }))
    }

    /// Whether the disk truly hits where it is doubted, and whether the impact is another than the solver's:
    /// then it must be the doubt that rounding decides. If not, the impact is the first one within its error.
    pub fn judge(&self, landing: &DrivenImpact) -> Result<(bool, bool), String> {
        let DrivenImpact { impact, error, doubt, .. } = landing;
        let end = two_pi() * high(impact.periods as f64) + high(impact.remainder);
        let off = low(&(self.first(0.0) - &end));
        let otherwise = off.abs() > *error;
        let Some(doubt) = doubt else {
            return if otherwise { Err(format!("the true root is {off:e} off")) } else { Ok((false, false)) };
        };
        let value = self.gap_at(&high(doubt.at)).abs();
        if value > doubt.bound {
            return Err(format!("doubt of {value:e}, truly"));
        }
        let landed = (low(&end) - doubt.at).abs() <= *error;
        // No deeper dip, or a gap that is nothing but rounding.
        let genuine = if off < 0.0 {
            low(&(self.first(doubt.bound) - &end)) >= -error
        } else {
            self.gap_at(&end).abs() <= doubt.bound
        };
        if otherwise && !genuine {
            return Err(format!("the true root is {off:e} off, and no matter of rounding"));
        }
        Ok((landed != otherwise, otherwise))
    }
}
