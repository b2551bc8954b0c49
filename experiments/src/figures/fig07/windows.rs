//! The printed shares 11.6 % and 39.1 % of the period-1 basin: the panels' shares, and for which windows they come out.

use std::convert::Infallible;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::core::attractors::BasinSettings;
use bouncing_disk::core::numerics::roots::bisected_bracket;
use serde::Serialize;

use super::basins::{Panel, grid, period_one, with_others};
use super::cells::{ATTRACTOR, CHATTERING, STILL_OPEN, kind};
use crate::claims::paper::SectionFour;
use crate::claims::{Claim, all};
use crate::experiment::{ExperimentError, Paper};
use crate::figures::shared::map;
use crate::progress::{Progress, advancing};

/// Top of the largest window.
const LARGEST_TOP: f64 = 8.0;
/// Points of the curve.
const CURVE_POINTS: usize = 160;
/// Half a unit of the last digit printed.
const HALF_UNIT: f64 = 0.0005;

/// Shares of windows [0, top] of |w_A Γ/(ωA)| over a whole period, at the Γ of (a) and (b).
#[derive(Serialize)]
pub(super) struct Windows {
    grid: (usize, usize),
    /// The printed shares of the period-1 orbit.
    pub(super) printed: [f64; 2],
    pub(super) curve: Vec<CurvePoint>,
    /// Lowest top that gives the number printed for (a), and for (b); `None` up to the end of the curve.
    top_for_a: Option<f64>,
    top_for_b: Option<f64>,
    /// Ranges of tops that give both printed numbers, with the period-1 orbit alone in (b), and with all that does not chatter.
    tops_for_both: Vec<(f64, f64)>,
    tops_for_both_not_chattering: Vec<(f64, f64)>,
}

/// One window: the shares of the period-1 orbit in (a) and (b), and of all that does not chatter in (b).
#[derive(Serialize)]
pub(super) struct CurvePoint {
    pub(super) top: f64,
    pub(super) a: f64,
    pub(super) b: f64,
    pub(super) b_not_chattering: f64,
}

/// Sums of the shares of each row over the lowest rows: none, one, two ...
struct Sums(Vec<f64>);

impl Sums {
    fn of(kinds: &[u8], columns: usize, counts: impl Fn(u8) -> bool) -> Self {
        let rows = kinds.chunks_exact(columns);
        let shares = rows.map(|row| row.iter().filter(|kind| counts(**kind)).count() as f64 / columns as f64);
        let sums = shares.scan(0.0, |sum, share| {
            *sum += share;
            Some(*sum)
        });
        Self(std::iter::once(0.0).chain(sums).collect())
    }

    fn rows(&self) -> usize {
        self.0.len() - 1
    }

    fn top(&self, row: usize) -> f64 {
        LARGEST_TOP * row as f64 / self.rows() as f64
    }

    /// The share of the lowest rows.
    fn mean(&self, rows: usize) -> f64 {
        self.0[rows] / rows as f64
    }

    /// The share in [0, top], interpolated between rows.
    fn share(&self, top: f64) -> f64 {
        let rows = self.rows() as f64;
        let place = (top / LARGEST_TOP * rows).clamp(1.0, rows);
        let below = (place as usize).min(self.rows() - 1);
        let part = place - below as f64;
        (self.0[below] + part * (self.0[below + 1] - self.0[below])) / place
    }

    /// The lowest top at which the share rises through `printed`, by bisection in the row where it does.
    fn top_for(&self, printed: f64) -> Option<f64> {
        let row = (1..=self.rows()).find(|row| self.mean(*row) >= printed)?;
        let is_less = |top: f64| Ok::<_, Infallible>(self.share(top) < printed);
        let Ok((_, top)) = bisected_bracket(self.top(row - 1), self.top(row), 60, is_less);
        Some(top)
    }

    /// Ranges of tops (whole rows) that give both printed numbers to their last digit, with those of (b) in `other`.
    fn tops_for_both(&self, other: &Self, printed: [f64; 2]) -> Vec<(f64, f64)> {
        let fits = |row: &usize| {
            (self.mean(*row) - printed[0]).abs() <= HALF_UNIT
                && (other.mean(*row) - printed[1]).abs() <= HALF_UNIT
        };
        let fitting: Vec<usize> = (1..=self.rows()).filter(fits).collect();
        let ranges = fitting.chunk_by(|one, next| one + 1 == *next);
        ranges.map(|range| (self.top(range[0]), self.top(range[range.len() - 1]))).collect()
    }
}

impl Windows {
    pub(super) fn of(
        section: &SectionFour,
        grid_size: (usize, usize),
        progress: &dyn Progress,
    ) -> Result<Self, ExperimentError> {
        let (rows, columns) = grid_size;
        let kinds = |forcing: f64| -> Result<Vec<u8>, ExperimentError> {
            let map = map(forcing, section.restitution)?;
            let known = period_one(&map)?.map_or(Ok(Vec::new()), |first| with_others(&map, first))?;
            let settings = BasinSettings { max_impacts: 20_000, policy: ChatterPolicy::Complete };
            let grid = grid(LARGEST_TOP, rows, columns)?;
            let basins = map.basins(grid, &known, settings, &advancing(progress))?;
            Ok(basins.labels().iter().map(|label| kind(*label, STILL_OPEN)).collect())
        };
        let [first, second, ..] = section.axial_forcings_of_fig7;
        let (low, high) = (kinds(first)?, kinds(second)?);
        let [a, b] = [&low, &high].map(|kinds| Sums::of(kinds, columns, |kind| kind == ATTRACTOR));
        let b_all = Sums::of(&high, columns, |kind| kind != CHATTERING);
        let printed = section.shares_of_period_one;
        let tops = (1..=CURVE_POINTS).map(|i| LARGEST_TOP * i as f64 / CURVE_POINTS as f64);
        let point =
            |top| CurvePoint { top, a: a.share(top), b: b.share(top), b_not_chattering: b_all.share(top) };
        Ok(Self {
            grid: grid_size,
            printed,
            curve: tops.map(point).collect(),
            top_for_a: a.top_for(printed[0]),
            top_for_b: b.top_for(printed[1]),
            tops_for_both: a.tops_for_both(&b, printed),
            tops_for_both_not_chattering: a.tops_for_both(&b_all, printed),
        })
    }
}

/// The printed shares, and that the basin widens.
pub(super) fn claims(fig: &mut Paper<'_>, windows: &Windows, cells: usize, [a, b]: [&Panel; 2]) {
    let keys = ["section4.share_at_fig7a", "section4.share_at_fig7b"];
    for ((key, panel), top) in keys.into_iter().zip([a, b]).zip([windows.top_for_a, windows.top_for_b]) {
        let share = panel.shares.attractor;
        let claim = Claim::printed(key, 100.0 * share);
        fig.claim(claim.fitted("the window's top, 5, which gives both printed shares").note(format!(
            "± {:.2} % (binomial); {:.1} % of the cells lie at a boundary; {} gives the printed share",
            100.0 * (share * (1.0 - share)).sqrt() / cells as f64,
            100.0 * panel.boundary_shares[0].1,
            top.map_or("no top up to 8".to_owned(), |top| format!("a top of {top:.3}")),
        )));
    }
    fig.claim(widens(&windows.curve));
}

fn widens(curve: &[CurvePoint]) -> Claim {
    let holding = || curve.iter().filter(|point| point.a > 0.0);
    Claim::printed_statement(
        "section4.basin_widens",
        all(holding(), |point| point.b > point.a),
        format!(
            "in each of {} windows [0, top] up to 8 that hold any of the basin of (a), panel (f)",
            holding().count()
        ),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of which the first half counts for nothing and the second half wholly.
    #[test]
    fn the_top_for_a_share_is_found_between_rows() {
        let kinds: Vec<u8> = (0..800).map(|row| u8::from(row >= 400)).collect();
        let sums = Sums::of(&kinds, 1, |kind| kind == 1);
        // (top - 4)/top = 1/5.
        let top = sums.top_for(0.2).expect("the share reaches a half");
        assert!((top - 5.0).abs() < 1e-12, "{top}");
        assert!((sums.share(top) - 0.2).abs() < 1e-12);
        assert_eq!(sums.top_for(0.6), None);
    }

    #[test]
    fn ranges_of_tops_are_runs_of_rows() {
        let rows = 800;
        let sums = |share: f64| Sums((0..=rows).map(|row| share * row as f64).collect());
        assert_eq!(
            sums(0.1).tops_for_both(&sums(0.3), [0.1, 0.3]),
            [(LARGEST_TOP / rows as f64, LARGEST_TOP)]
        );
        assert!(sums(0.1).tops_for_both(&sums(0.4), [0.1, 0.3]).is_empty());
    }

    #[test]
    fn a_basin_does_not_widen_without_data() {
        assert!(widens(&[]).lacks_data());
    }
}
