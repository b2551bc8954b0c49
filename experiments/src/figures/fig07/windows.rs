//! The printed fractions against the window, which the paper's text does not give.

use std::convert::Infallible;

use bouncing_disk::core::attractors::{BasinSettings, KnownOrbit};
use bouncing_disk::core::numerics::roots::bisected_bracket;
use bouncing_disk::core::{ChatterPolicy, Unobserved};

use super::data::{ATTRACTOR, CHATTERING, STILL_OPEN, kind};
use super::data::{CurvePoint, Windows};
use super::panels::{grid, map, others};
use crate::claims::paper::SectionFour;
use crate::experiment::ExperimentError;
use crate::progress::{Progress, advancing};

/// Top of the largest window.
const LARGEST_TOP: f64 = 8.0;

/// Points of the curve.
const CURVE_POINTS: usize = 160;

/// Cumulated shares by rising top: `[i]` is the sum over the lowest i rows of the share of each row.
type Sums = Vec<f64>;

/// Kinds of the cells of one forcing.
struct Cells {
    kinds: Vec<u8>,
    columns: usize,
}

impl Cells {
    fn at(
        (forcing, restitution): (f64, f64),
        (rows, columns): (usize, usize),
        progress: &dyn Progress,
    ) -> Result<Self, ExperimentError> {
        let map = map(forcing, restitution)?;
        let mut known = Vec::new();
        if let Some(state) = map.period_one(1) {
            let orbit = map.refine(&[state])?;
            if let Ok(radius) = orbit.trapping_radius(&map, 64, &Unobserved) {
                let first = KnownOrbit::new(orbit, radius)?;
                known = others(&map, &first)?;
                known.insert(0, first);
            }
        }
        let settings = BasinSettings { max_impacts: 20_000, policy: ChatterPolicy::Complete };
        let basins = map.basins(grid(LARGEST_TOP, rows, columns)?, &known, settings, &advancing(progress))?;
        let kinds = basins.labels().iter().map(|label| kind(*label, STILL_OPEN)).collect();
        Ok(Self { kinds, columns })
    }

    /// Cumulated shares of the cells that count, in a range of phases (periods).
    fn sums(&self, phases: (f64, f64), counts: impl Fn(u8) -> bool) -> Sums {
        let (from, to) =
            ((phases.0 * self.columns as f64) as usize, (phases.1 * self.columns as f64) as usize);
        let mut sums = vec![0.0];
        let mut sum = 0.0;
        for row in self.kinds.chunks_exact(self.columns) {
            // A range may run over the end of the period.
            let cells = (from..to).map(|column| row[column % self.columns]);
            sum += cells.filter(|kind| counts(*kind)).count() as f64 / (to - from) as f64;
            sums.push(sum);
        }
        sums
    }
}

fn mean(sums: &[f64], from: usize, to: usize) -> f64 {
    (sums[to] - sums[from]) / (to - from) as f64
}

/// The share in [0, top], interpolated between rows.
fn share(sums: &[f64], top: f64) -> f64 {
    let rows = (sums.len() - 1) as f64;
    let place = (top / LARGEST_TOP * rows).clamp(1.0, rows);
    let below = (place as usize).min(sums.len() - 2);
    let part = place - below as f64;
    (sums[below] + part * (sums[below + 1] - sums[below])) / place
}

/// The lowest top at which the share rises through `printed`, by bisection in the row where it does.
fn top_for(sums: &[f64], printed: f64) -> Option<f64> {
    let rows = sums.len() - 1;
    let row = (1..=rows).find(|row| mean(sums, 0, *row) >= printed)?;
    let (low, high) = (LARGEST_TOP * (row - 1) as f64 / rows as f64, LARGEST_TOP * row as f64 / rows as f64);
    let is_less = |top: f64| Ok::<_, Infallible>(share(sums, top) < printed);
    let Ok((_, top)) = bisected_bracket(low, high, 60, is_less);
    Some(top)
}

/// Half a unit of the last digit printed.
const HALF_UNIT: f64 = 0.0005;

/// Ranges of tops (whole rows) of windows [0, top] that give both printed numbers to their last digit.
fn tops_for_both(a: &[f64], b: &[f64], printed: [f64; 2]) -> Vec<(f64, f64)> {
    let rows = a.len() - 1;
    let fits = |row: &usize| {
        (mean(a, 0, *row) - printed[0]).abs() <= HALF_UNIT
            && (mean(b, 0, *row) - printed[1]).abs() <= HALF_UNIT
    };
    let fitting: Vec<usize> = (1..=rows).filter(fits).collect();
    let top = |row: usize| LARGEST_TOP * row as f64 / rows as f64;
    fitting
        .chunk_by(|one, next| one + 1 == *next)
        .map(|range| (top(range[0]), top(range[range.len() - 1])))
        .collect()
}

pub(super) fn windows(
    section: &SectionFour,
    size: (usize, usize),
    progress: &dyn Progress,
) -> Result<Windows, ExperimentError> {
    let [first, second, ..] = section.axial_forcings_of_fig7;
    let printed = section.shares_of_period_one;
    let low = Cells::at((first, section.restitution), size, progress)?;
    let high = Cells::at((second, section.restitution), size, progress)?;
    let whole = (0.0, 1.0);
    let period_one = |kind: u8| kind == ATTRACTOR;
    let bouncing = |kind: u8| kind != CHATTERING;
    let (a, b, b_all) =
        (low.sums(whole, period_one), high.sums(whole, period_one), high.sums(whole, bouncing));
    let curve = (1..=CURVE_POINTS)
        .map(|i| {
            let top = LARGEST_TOP * i as f64 / CURVE_POINTS as f64;
            CurvePoint { top, a: share(&a, top), b: share(&b, top), b_not_chattering: share(&b_all, top) }
        })
        .collect();
    Ok(Windows {
        grid: size,
        curve,
        printed,
        top_for_a: top_for(&a, printed[0]),
        top_for_b: top_for(&b, printed[1]),
        top_for_b_not_chattering: top_for(&b_all, printed[1]),
        tops_for_both: tops_for_both(&a, &b, printed),
        tops_for_both_not_chattering: tops_for_both(&a, &b_all, printed),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of which the first half counts for nothing and the second half wholly.
    fn step(rows: usize) -> Sums {
        let mut sums = vec![0.0];
        for row in 0..rows {
            sums.push(sums[row] + if row < rows / 2 { 0.0 } else { 1.0 });
        }
        sums
    }

    #[test]
    fn the_top_for_a_share_is_found_between_rows() {
        let sums = step(800);
        // (top - 4)/top = 1/5.
        let top = top_for(&sums, 0.2).expect("the share reaches a half");
        assert!((top - 5.0).abs() < 1e-12, "{top}");
        assert!((share(&sums, top) - 0.2).abs() < 1e-12);
        assert_eq!(top_for(&sums, 0.6), None);
    }

    #[test]
    fn ranges_of_tops_are_runs_of_rows() {
        let rows = 800;
        let sums_with = |share: f64| -> Sums { (0..=rows).map(|row| share * row as f64).collect() };
        assert_eq!(
            tops_for_both(&sums_with(0.1), &sums_with(0.3), [0.1, 0.3]),
            [(LARGEST_TOP / rows as f64, LARGEST_TOP)]
        );
        assert!(tops_for_both(&sums_with(0.1), &sums_with(0.4), [0.1, 0.3]).is_empty());
    }
}
