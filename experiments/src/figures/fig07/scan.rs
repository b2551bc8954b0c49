//! Basins on coarse grids: along the period-1 window, beyond the crisis, from rest, and against the window, which the paper's
//! text does not give.

use std::convert::Infallible;
use std::f64::consts::PI;

use bouncing_disk::core::attractors::{ATTACHED, BasinSettings, FIRST_ORBIT, KnownOrbit, UNDECIDED};
use bouncing_disk::core::numerics::roots::bisected_bracket;
use bouncing_disk::core::orbits::follow_attractor;
use bouncing_disk::core::sweep::survival_times;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, Launch, Phase, Unobserved};

use super::data::{
    ATTRACTOR, Beyond, CHATTERING, CurvePoint, Easiness, Other, Rest, STILL_OPEN, TopShares, Traced, Windows,
    kind,
};
use super::panels::{grid, others, start};
use crate::claims::paper::SectionFour;
use crate::experiment::{ExperimentError, Quality};
use crate::figures::shared::map_in_parallel;
use crate::figures::shared::{FORCING_RANGE, map};
use crate::progress::{Progress, advancing};

/// Forcings from that of panel (a) to that of (b).
const ALONG_WINDOW: u32 = 16;
/// The tops of the windows in which shares are taken: every whole one from where speeds of period 1 (1.33)
/// are well inside.
const TOPS: [usize; 7] = [2, 3, 4, 5, 6, 7, 8];
/// Impacts after which a start along the window belongs neither to period 1 nor to chattering.
const LONGEST_ALONG: u32 = 4_000;
/// Impacts after which a start beyond the crisis counts as one that never comes to rest. The transients of
/// some hundred impacts that the crisis leaves are over by far.
const LONGEST_BEYOND: u32 = 20_000;
/// Phases between separation and its mirror image at which a disk at rest is let go, too: there the platform
/// falls away.
const REST_PHASES: u32 = 64;
/// Longest period (impacts) that is recognised, and how well two rounds agree.
const LONGEST_PERIOD: usize = 256;
/// See [`LONGEST_PERIOD`].
const REPEATS_WITHIN: f64 = 1.0e-6;
/// Steps of Γ in which the further attractor of panel (b) is followed, and impacts in each.
const TRACE_STEP: f64 = 2.0e-5;
/// See [`TRACE_STEP`].
const TRACE_IMPACTS: usize = 500;
/// How far it is followed at most; it is lost long before.
const TRACE_REACH: f64 = 0.03;

/// Shares of the period-1 and the chattering basin along the period-1 window.
pub(super) fn along_window(
    section: &SectionFour,
    quality: Quality,
) -> Result<Vec<Easiness>, ExperimentError> {
    let [first, last, ..] = section.axial_forcings_of_fig7;
    let (rows, columns) = quality.choose((80, 40), (240, 90));
    let forcing = |index| first + (last - first) * f64::from(index) / f64::from(ALONG_WINDOW - 1);
    map_in_parallel(&(0..ALONG_WINDOW).map(forcing).collect::<Vec<_>>(), |&axial_forcing| {
        let map = map(axial_forcing, section.restitution)?;
        let mut known = Vec::new();
        if let Some(state) = map.period_one(1) {
            let orbit = map.refine(&[state])?;
            if let Ok(radius) = orbit.trapping_radius(&map, 64, &Unobserved) {
                known.push(KnownOrbit::new(orbit, radius)?);
            }
        }
        let highest = TOPS[TOPS.len() - 1];
        let settings = BasinSettings { max_impacts: LONGEST_ALONG, policy: ChatterPolicy::Complete };
        let basins = map.basins(grid(highest as f64, rows, columns)?, &known, settings, &Unobserved)?;
        let shares = TOPS
            .iter()
            .map(|top| {
                let cells = &basins.labels()[..columns * (rows * top / highest)];
                let share =
                    |label| cells.iter().filter(|own| **own == label).count() as f64 / cells.len() as f64;
                TopShares { top: *top as f64, period_one: share(FIRST_ORBIT), chattering: share(ATTACHED) }
            })
            .collect();
        Ok(Easiness { axial_forcing, shares })
    })
}

/// The starts that do not come to rest, from the printed Γ of the merging to the end of the diagram of
/// Fig. 6.
pub(super) fn beyond(
    section: &SectionFour,
    top: f64,
    quality: Quality,
) -> Result<Vec<Beyond>, ExperimentError> {
    let (first, last) = (section.merging, FORCING_RANGE.1);
    let (step, side) = quality.choose((5.0e-4, 8), (2.0e-4, 16));
    let count = ((last - first) / step).round() as u32;
    let forcings: Vec<f64> = (0..=count).map(|index| first + step * f64::from(index)).collect();
    map_in_parallel(&forcings, |&axial_forcing| {
        let map = map(axial_forcing, section.restitution)?;
        let grid = grid(top, side, side)?;
        let settings = BasinSettings { max_impacts: LONGEST_BEYOND, policy: ChatterPolicy::Complete };
        let basins = map.basins(grid, &[], settings, &Unobserved)?;
        let open = |label: &u8| *label == UNDECIDED;
        let mut period = None;
        if let Some(index) = basins.labels().iter().position(open) {
            let from = start(&grid, index / side, index % side)?;
            let survivor =
                map.state_after(from, LONGEST_BEYOND as usize, ChatterPolicy::Complete, &Unobserved)?;
            if let Some(state) = survivor {
                period = map.period_of(state, LONGEST_PERIOD, REPEATS_WITHIN)?;
            }
        }
        Ok(Beyond {
            axial_forcing,
            starts: side * side,
            not_at_rest: basins.labels().iter().filter(|label| open(label)).count(),
            impacts: LONGEST_BEYOND,
            period,
        })
    })
}

/// The fate of a disk at rest on the platform, at any phase.
pub(super) fn rest(forcings: &[f64], restitution: f64) -> Result<Vec<Rest>, ExperimentError> {
    map_in_parallel(forcings, |&axial_forcing| {
        let map: ImpactMap = map(axial_forcing, restitution)?;
        let mut orbits = Vec::new();
        if let Some(leaves) = map.vibration().separation_phase() {
            // At all other phases it stays until the first of these.
            let falling = PI - 2.0 * leaves.angle();
            for index in 0..REST_PHASES {
                let angle = leaves.angle() + falling * f64::from(index) / f64::from(REST_PHASES);
                let phase = if index == 0 { Ok(leaves) } else { Phase::new(angle) };
                let phase = phase?;
                let orbit = Launch::new(phase, 0.0)
                    .map(|launch| map.orbit_from_launch(launch, ChatterPolicy::Complete));
                orbits.push(orbit?);
            }
        }
        let longest = LONGEST_BEYOND as usize;
        let lives = survival_times(&orbits, longest, &Unobserved)?;
        Ok(Rest {
            axial_forcing,
            starts: orbits.len(),
            come_to_rest: lives.into_iter().filter(|lived| *lived < longest).count(),
        })
    })
}

/// Where the further attractor of panel (b) comes from and where it is lost.
pub(super) fn traced(
    axial_forcing: f64,
    other: &Other,
    restitution: f64,
) -> Result<Option<Traced>, ExperimentError> {
    let Some(&(cycles, speed)) = other.impacts.first() else { return Ok(None) };
    let first = bouncing_disk::core::ImpactState::from_normalised(2.0 * PI * cycles, speed)?;
    let steps = (TRACE_REACH / TRACE_STEP) as u32;
    // Γ and period as far as it can be followed: to a rest, or to the period-1 orbit.
    let trace = |direction: f64| -> Result<Vec<(f64, Option<usize>)>, ExperimentError> {
        let forcings = (0..=steps).map(|step| axial_forcing + direction * TRACE_STEP * f64::from(step));
        let mut passed = Vec::new();
        for at in follow_attractor(restitution, forcings, first, TRACE_IMPACTS, ChatterPolicy::Complete) {
            let at = at?;
            let period = at.map.period_of(at.state, LONGEST_PERIOD, REPEATS_WITHIN)?;
            if period == Some(1) {
                break;
            }
            passed.push((at.axial_forcing, period));
        }
        Ok(passed)
    };
    let (down, up) = rayon::join(|| trace(-1.0), || trace(1.0));
    let (down, up) = (down?, up?);
    let undoubled = |(_, period): &&(f64, Option<usize>)| *period == Some(other.impacts.len() / 2);
    Ok(down.last().zip(up.last()).map(|(lowest, highest)| Traced {
        step: TRACE_STEP,
        appears: lowest.0,
        period_where_it_appears: lowest.1,
        doubles: down.iter().find(undoubled).map(|at| at.0),
        lost: highest.0,
    }))
}

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
