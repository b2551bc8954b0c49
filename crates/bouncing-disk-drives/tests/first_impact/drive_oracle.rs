//! Flights above drives in double-doubles or 256 bits: the true first root, by the signs of the gap and its
//! derivatives.
//!
//! A drive is taken exactly as stored: amplitudes, angles, joints and coefficients are doubles, c3 is a sixth
//! of the third derivative. In the first period of a flight the gap is continuous at joints, whatever the
//! rounding of the heights. Later it is the difference of two heights, and the period is 2 pi. No tolerance
//! is added.

use std::cell::OnceCell;
use std::f64::consts::TAU;

use bouncing_disk_drives::drive::DrivenImpact;

use crate::drives::Exact;
use crate::numbers::Number;
use crate::polynomials::{derivatives, first_root, jet};

/// The Taylor coefficients of a piece, and an upper bound of its height.
type Piece<N> = (Vec<N>, f64);

/// The heights of a drive over one period, as polynomials in the time since the last cut.
pub struct Heights<'a, N> {
    of: &'a Exact,
    cuts: Vec<f64>,
    pieces: Vec<OnceCell<Piece<N>>>,
}

impl<'a, N: Number> Heights<'a, N> {
    pub fn new(of: &'a Exact) -> Self {
        let count = 13 * of.harmonics.len();
        let cut = |k: usize| k as f64 / count as f64 * TAU;
        let cuts = if count == 0 { of.joints.clone() } else { (0..=count).map(cut).collect() };
        Self { of, pieces: vec![OnceCell::new(); cuts.len() - 1], cuts }
    }

    fn taylor(&self, cut: f64) -> Vec<N> {
        if self.of.harmonics.is_empty() {
            let at = self.of.drive.at(cut);
            let sixth = N::of(at.jerk) / N::of(6.0);
            return vec![N::of(at.height), N::of(at.velocity), N::of(0.5 * at.acceleration), sixth];
        }
        let mut sums = derivatives(&self.of.harmonics, &N::of(cut), N::ORDERS);
        let mut factorial = N::of(1.0);
        for (k, sum) in sums.iter_mut().enumerate().skip(1) {
            factorial = factorial * N::of(k as f64);
            *sum = sum.clone() / factorial.clone();
        }
        sums
    }

    fn piece(&self, piece: usize) -> &Piece<N> {
        self.pieces[piece].get_or_init(|| {
            let c = self.taylor(self.cuts[piece]);
            let mut sizes: Vec<_> = c.iter().map(N::abs).collect();
            sizes[0] = c[0].clone();
            let top = jet(&sizes, &N::of(self.cuts[piece + 1] - self.cuts[piece]))[0].rounded();
            (c, top + 1e-9 * top.abs())
        })
    }

    /// A bound on all heights.
    fn highest(&self) -> f64 {
        if self.of.joints.is_empty() {
            return (1.0 + 1e-9) * self.of.harmonics.iter().map(|(a, _)| a.abs()).sum::<f64>();
        }
        (0..self.pieces.len()).map(|piece| self.piece(piece).1).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// A flight from the platform, with this relative speed.
pub struct Flight<'a, N> {
    above: &'a Heights<'a, N>,
    time: f64,
    speed: f64,
}

impl<'a, N: Number> Flight<'a, N> {
    pub fn new(above: &'a Heights<'a, N>, time: f64, speed: f64) -> Self {
        Self { above, time, speed }
    }

    /// Calls `visit` with the start and the length of each stretch and its gap, until it finds something.
    fn walk(&self, visit: &mut impl FnMut(&N, &N, &[N]) -> Option<N>) -> N {
        let (above, cuts, has_joints) = (self.above, &self.above.cuts, !self.above.of.joints.is_empty());
        let count = above.pieces.len();
        let mut piece = cuts.partition_point(|&cut| cut <= self.time).min(count) - 1;
        let (mut from, mut c) = (N::of(self.time), above.piece(piece).0.clone());
        // Restarted at the launch.
        let behind = from.clone() - N::of(cuts[piece]);
        for k in 0..c.len() {
            for n in (k..c.len() - 1).rev() {
                c[n] = c[n].clone() + c[n + 1].clone() * behind.clone();
            }
        }
        let (height, disk) = (c[0].clone(), c[1].clone() + N::of(self.speed));
        let highest = above.highest();
        // The time during which the disk is above the whole platform.
        let (up, depth) = (disk.rounded(), highest - height.rounded());
        let until = if up > 0.0 { up + (up * up - 2.0 * depth).sqrt() } else { f64::NAN };
        let (mut begin, mut gap, mut speed, mut turns) = (N::of(0.0), N::of(0.0), N::of(self.speed), 0.0);
        loop {
            let in_first = |begin: &N| begin.rounded() <= TAU;
            let at_joint = piece + 1 < count || in_first(&begin) && has_joints;
            let length = if at_joint { N::of(cuts[piece + 1]) } else { N::two_pi() } - from;
            let mut own: Vec<_> = c.iter().map(|c| -c.clone()).collect();
            (own[0], own[1]) = (gap, speed);
            own[2] = own[2].clone() - N::of(0.5);
            // A parabola is lowest at one of its ends.
            let (t, after) = (begin.rounded(), (begin.clone() + length.clone()).rounded());
            let least = height.rounded() + (t * (up - 0.5 * t)).min(after * (up - 0.5 * after));
            let clear = t > TAU && least > above.piece(piece).1 + 1e-9 * (t * t + highest.abs());
            if !clear && let Some(found) = visit(&begin, &length, &own) {
                return found;
            }
            begin = begin + length.clone();
            let carried = in_first(&begin).then(|| (jet(&own, &length), jet(&c, &length)[1].clone()));
            piece = (piece + 1) % count;
            turns += if piece == 0 { 1.0 } else { 0.0 };
            let ahead = ((until - 1e-6 + self.time) / TAU).floor();
            if carried.is_none() && begin.rounded() > 2.0 * depth / until + 1e-6 && ahead > turns {
                (turns, piece) = (ahead, 0);
            }
            (from, c) = (N::of(cuts[piece]), above.piece(piece).0.clone());
            if let Some((there, before)) = carried {
                [gap, speed, _] = there;
                let kink = c[1].clone() - before;
                // As defined by the drive.
                if kink.rounded().abs() > 1e-12 * above.of.drive.bounds().speed {
                    speed = speed - kink;
                }
            } else {
                begin = N::two_pi() * N::of(turns) + from.clone() - N::of(self.time);
                let fallen = disk.clone() - begin.clone() * N::of(0.5);
                gap = height.clone() - c[0].clone() + begin.clone() * fallen;
                speed = disk.clone() - begin.clone() - c[1].clone();
            }
        }
    }

    /// The first time at which the gap, raised by this amount, is zero.
    fn first(&self, raised: f64) -> N {
        self.walk(&mut |begin, length, gap| {
            let mut gap = gap.to_vec();
            gap[0] = gap[0].clone() + N::of(raised);
            // Heights may jump by their rounding.
            if gap[0] < N::of(0.0) {
                Some(begin.clone())
            } else {
                first_root(&gap, length).map(|t| begin.clone() + t)
            }
        })
    }

    fn gap_at(&self, time: &N) -> f64 {
        let gap = self.walk(&mut |begin, length, gap| {
            let t = time.clone() - begin.clone();
            (t <= *length).then(|| jet(gap, &t)[0].clone())
        });
        gap.rounded()
    }

    /// Whether the disk truly hits at the doubt, and whether the impact differs from the solver's, which is
    /// allowed only for a doubt that rounding decides. Otherwise the impact is the first one within its
    /// error.
    pub fn judge(&self, landing: &DrivenImpact) -> Result<(bool, bool), String> {
        let DrivenImpact { impact, error, doubt, .. } = landing;
        let end = N::two_pi() * N::of(impact.periods as f64) + N::of(impact.remainder);
        let off = (self.first(0.0) - end.clone()).rounded();
        let otherwise = off.abs() > *error;
        let Some(doubt) = doubt else {
            return if otherwise { Err(format!("the true root is {off:e} off")) } else { Ok((false, false)) };
        };
        let value = self.gap_at(&N::of(doubt.at)).abs();
        if value > doubt.bound {
            return Err(format!("doubt of {value:e}, truly"));
        }
        let landed = (end.rounded() - doubt.at).abs() <= *error;
        // No deeper dip, or a gap that is pure rounding.
        let genuine = if off < 0.0 {
            (self.first(doubt.bound) - end).rounded() >= -error
        } else {
            self.gap_at(&end).abs() <= doubt.bound
        };
        if otherwise && !genuine {
            return Err(format!("the true root is {off:e} off, and no matter of rounding"));
        }
        Ok((landed != otherwise, otherwise))
    }
}
