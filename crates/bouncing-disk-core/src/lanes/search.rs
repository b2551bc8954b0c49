//! The search in a window, `GapForm::root`, for many flights that need different numbers of steps.

use pulp::{Simd, WithSimd};

use super::list::List;
use super::{LANES, Mask, ROW, Row, mask, packed};
use crate::elementary::rotated;
use crate::gap::Jet;

/// Evaluations before the last step; flights that need more are left to the solver of one flight.
const EVALUATIONS: usize = 8;

/// Packed flights in one of the forms of the gap.
pub(super) trait Forms {
    /// Evaluates what [`Self::jet`] needs besides the pair of the phase, and the phases, of flights `from..to`.
    fn evaluate(&mut self, times: &mut Times, from: usize, to: usize);

    /// Gap and derivatives of one flight at the time evaluated last.
    fn jet(&self, times: &Times, k: usize) -> Jet;

    fn swap(&mut self, a: usize, b: usize);
}

/// Times reached, the windows that hold the roots, and the pairs of the phases.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct Times {
    pub(super) lo: Row,
    pub(super) hi: Row,
    pub(super) time: Row,
    pub(super) sin: Row,
    pub(super) cos: Row,
    root: Row,
    step: Row,
    /// Flights near their root, and those that can be.
    near: Mask,
    pub(super) open: Mask,
    /// The lane of each flight.
    pub(super) lanes: List,
}

impl Times {
    pub(super) const fn new() -> Self {
        Self {
            lo: ROW,
            hi: ROW,
            time: ROW,
            sin: ROW,
            cos: ROW,
            root: ROW,
            step: ROW,
            near: [0; LANES],
            open: [0; LANES],
            lanes: List::new(),
        }
    }

    /// Drops the flights that are not open.
    pub(super) fn keep_open(&mut self, forms: &mut impl Forms) {
        let mut kept = 0;
        for k in 0..self.lanes.len() {
            if self.open[k] != 0 {
                if kept != k {
                    self.swap(kept, k);
                    forms.swap(kept, k);
                }
                kept += 1;
            }
        }
        self.lanes.truncate(kept);
    }

    #[inline(always)]
    fn swap(&mut self, a: usize, b: usize) {
        self.lo.swap(a, b);
        self.hi.swap(a, b);
        self.time.swap(a, b);
        self.sin.swap(a, b);
        self.cos.swap(a, b);
        self.near.swap(a, b);
        self.open.swap(a, b);
        self.lanes.swap(a, b);
    }
}

/// Finds the roots of the flights listed: time, sine and cosine of the impact for those that stay `open`.
pub(super) struct Search<'a, F> {
    pub(super) forms: &'a mut F,
    pub(super) times: &'a mut Times,
}

impl<F: Forms> WithSimd for Search<'_, F> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { forms, times } = self;
        let count = times.lanes.len();
        // Flights that are done come first.
        let mut done = 0;
        for evaluation in 1..=EVALUATIONS {
            // Whole groups: what is done stays as it is when evaluated again.
            let (from, to) = (done / super::GROUP * super::GROUP, packed(count));
            forms.evaluate(times, from, to);
            for k in from..to {
                times.near[k] = mask(forms.jet(times, k).is_near_root());
            }
            if evaluation > 1 {
                for k in done..count {
                    if (times.near[k] | !times.open[k]) != 0 {
                        times.swap(done, k);
                        forms.swap(done, k);
                        done += 1;
                    }
                }
                if done == count {
                    break;
                }
            }
            step(forms, times, done / super::GROUP * super::GROUP, to);
        }
        let to = packed(count);
        for k in 0..to {
            times.open[k] &= times.near[k];
            let jet = forms.jet(times, k);
            let delta = jet.last_step();
            (times.sin[k], times.cos[k]) = rotated(times.sin[k], times.cos[k], delta);
            times.time[k] += delta;
        }
    }
}

/// One step of the search; none where the root is near.
#[inline(always)]
fn step<F: Forms>(forms: &F, times: &mut Times, from: usize, to: usize) {
    for k in from..to {
        times.root[k] = forms.jet(times, k).radicand().sqrt();
    }
    for k in from..to {
        let jet = forms.jet(times, k);
        let root = times.root[k];
        let model = jet.corrected_step(jet.quadratic_step(root), root);
        let newton = -(jet.gap * (1.0 / jet.slope));
        times.step[k] = if root > 0.0 { model } else { newton };
    }
    for k in from..to {
        let jet = forms.jet(times, k);
        let (t, near) = (times.time[k], times.near[k]);
        let above = jet.gap > 0.0;
        let lo = if above { t } else { times.lo[k] };
        let hi = if above { times.hi[k] } else { t };
        let next = t + times.step[k];
        let fine = mask(jet.slope < 0.0) & mask(next > lo) & mask(next < hi);
        let next = if fine != 0 { next } else { 0.5 * (lo + hi) };
        times.time[k] = if near != 0 { t } else { next };
        times.lo[k] = lo;
        times.hi[k] = hi;
    }
}
