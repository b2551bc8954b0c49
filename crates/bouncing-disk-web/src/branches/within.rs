//! The parts of a branch in a range of its parameter, at the resolution of a view.

use bouncing_disk::core::orbits::{
    BifurcationKind, Branch, BranchEnd, BranchPoint, Continuation, ContinuedMap as _, PeriodicOrbit,
};
use bouncing_disk::core::{Error, Unobserved};

/// Steps of the arclength in a first pass through a part, which measures its length.
const FIRST_STEP: f64 = 0.01;
const LARGEST_STEP: f64 = 0.05;

/// The smallest step of a [`Continuation`].
const SMALLEST_STEP: f64 = 1.0e-9;

/// A part has at most so many times the points that it should have.
const PATIENCE: usize = 16;

/// Largest number of points on the way to the edge of a range.
const MOST_TO_EDGE: usize = 10_000;

/// A known point of the branch.
struct Known {
    point: BranchPoint,
    /// Newton's method cannot begin at a fold or at a birth, where the equations are singular in the
    /// parameter.
    begins: bool,
}

impl Known {
    const fn at(&self) -> f64 {
        self.point.parameter
    }
}

/// The parts of a branch with their parameter in [`low`, `high`], in the order of the arclength, each
/// continued again with steps that are a share of it: at least `points` of them on a part, however narrow the
/// range is (the smallest step is an arclength of 1e-9). Arclengths are measured along the parts. Fewer lie on a
/// part that ends in a birth by doubling and is short: close to it the two halves of the orbit are
/// indistinguishable, and the birth follows at once.
///
/// The range only selects: it neither begins nor ends a branch. The birth by doubling that ends a branch is
/// part of it, as the halved orbit run through twice.
///
/// # Errors
/// Those of [`continued`](bouncing_disk::core::orbits::ContinuedMap::continued) but for [`Error::NoBranch`]: a
/// part that is not found again has the points of this branch.
pub(crate) fn within(
    branch: &Branch,
    (low, high): (f64, f64),
    points: usize,
) -> Result<Vec<Vec<BranchPoint>>, Error> {
    // The branch ends where its own range does, also in a second pass.
    let (mut low, mut high) = (low, high);
    if let BranchEnd::RangeLimit(limit) = branch.end {
        let below = branch.points.iter().all(|point| point.parameter <= limit);
        (low, high) = if below { (low, high.min(limit)) } else { (low.max(limit), high) };
    }
    if low >= high {
        return Ok(Vec::new());
    }
    let known = known_points(branch);
    let inside = |index: usize| (low..=high).contains(&known[index].at());
    let meets = |index: usize| {
        let (a, b) = (known[index].at(), known[index + 1].at());
        a.min(b) <= high && a.max(b) >= low
    };
    let (mut parts, mut index) = (Vec::new(), 0);
    while index + 1 < known.len() {
        if !meets(index) {
            index += 1;
            continue;
        }
        let first = index;
        index += 1;
        while index + 1 < known.len() && inside(index) {
            index += 1;
        }
        let part = match part(branch, &known[first..=index], (low, high), points) {
            Err(Error::NoBranch { .. }) | Ok(None) => {
                (first..=index).filter(|one| inside(*one)).map(|one| known[one].point.clone()).collect()
            }
            found => found?.unwrap_or_default(),
        };
        if !part.is_empty() {
            parts.push(part);
        }
    }
    Ok(parts)
}

/// All points and the singular ones, in the order of the arclength.
fn known_points(branch: &Branch) -> Vec<Known> {
    let points = branch.points.iter().map(|point| Known { point: point.clone(), begins: true });
    let mut known: Vec<Known> = points.collect();
    for found in &branch.bifurcations {
        match found.kind {
            BifurcationKind::Fold => known.push(Known { point: found.point.clone(), begins: false }),
            BifurcationKind::Birth => known.push(Known { point: twice(&found.point), begins: false }),
            _ => {}
        }
    }
    known.sort_by(|a, b| a.point.arclength.total_cmp(&b.point.arclength));
    known
}

/// The part of the branch between the first and the last of these points that lies in a range: all but
/// these two do.
fn part(
    branch: &Branch,
    known: &[Known],
    (low, high): (f64, f64),
    points: usize,
) -> Result<Option<Vec<BranchPoint>>, Error> {
    let inside = |one: &Known| (low..=high).contains(&one.at());
    let last = known.len() - 1;
    let towards = |from: usize, to: usize| known[to].at() > known[from].at();
    // From the beginning of the branch there is only one way, so going back does not leave it.
    if inside(&known[0]) && known[0].begins {
        return fine(branch, &known[0].point, towards(0, 1), (low, high), points).map(Some);
    }
    let middle = (1..last).filter(|index| known[*index].begins).min_by_key(|index| index.abs_diff(last / 2));
    if let Some(middle) = middle {
        let forward = fine(branch, &known[middle].point, towards(middle, middle + 1), (low, high), points)?;
        let mut part = fine(branch, &known[middle].point, towards(middle, middle - 1), (low, high), points)?;
        part.reverse();
        part.extend(forward.into_iter().skip(1));
        return Ok(Some(part));
    }
    for (from, to) in [(0, 1), (last, last - 1)] {
        if !known[from].begins {
            continue;
        }
        let rising = towards(from, to);
        let entry = if inside(&known[from]) {
            Some(known[from].point.clone())
        } else {
            let (at, edge) = (known[from].at(), if rising { low } else { high });
            let settings = Continuation::new(branch.parameter, (at.min(edge), at.max(edge)), rising)?;
            // At a fold the parameter goes with the square of the arclength: a longer step could leap
            // over the range, and come back on the other side.
            let gap = (known[to].point.arclength - known[from].point.arclength).abs();
            let share = ((edge - known[to].at()) / (at - known[to].at())).abs();
            let step = (0.5 * gap * share.sqrt()).clamp(SMALLEST_STEP, LARGEST_STEP);
            let settings = settings.with_steps(step, step, MOST_TO_EDGE)?;
            let map = branch.map_at(at)?;
            let to_edge = map.continued_from(&known[from].point.orbit, &settings, &Unobserved)?;
            to_edge.points.last().filter(|_| to_edge.end == BranchEnd::RangeLimit(edge)).cloned()
        };
        let Some(entry) = entry else { continue };
        let mut part = fine(branch, &entry, rising, (low, high), points)?;
        if from != 0 {
            part.reverse();
        }
        return Ok(Some(part));
    }
    Ok(None)
}

/// The branch from one of its points in a direction, as far as it lies in a range.
fn fine(
    branch: &Branch,
    from: &BranchPoint,
    rising: bool,
    (low, high): (f64, f64),
    points: usize,
) -> Result<Vec<BranchPoint>, Error> {
    let at = from.parameter.clamp(low, high);
    let map = branch.map_at(at)?;
    let settings = Continuation::new(branch.parameter, (low, high), rising)?;
    let most = points * PATIENCE;
    let mut part =
        map.continued_from(&from.orbit, &settings.with_steps(FIRST_STEP, LARGEST_STEP, most)?, &Unobserved)?;
    // A branch that ends in its birth may have no point but the first before it.
    let ends = part.points.iter().chain(part.of_kind(BifurcationKind::Birth).map(|birth| &birth.point));
    let length = ends.fold(0.0_f64, |most, end| most.max(end.arclength));
    if part.points.len() < points && length > 0.0 {
        let step = (length / points as f64).clamp(SMALLEST_STEP, LARGEST_STEP);
        part = map.continued_from(&from.orbit, &settings.with_steps(step, step, most)?, &Unobserved)?;
    }
    let birth = part.of_kind(BifurcationKind::Birth).next().map(|found| twice(&found.point));
    part.points.extend(birth.filter(|birth| (low..=high).contains(&birth.parameter)));
    Ok(part.points)
}

/// An orbit passed twice, which a doubled orbit is at its birth.
fn twice(point: &BranchPoint) -> BranchPoint {
    let PeriodicOrbit { states, platform_periods, monodromy, position_error, trace_error } = &point.orbit;
    let orbit = PeriodicOrbit {
        states: states.repeat(2),
        platform_periods: 2 * platform_periods,
        monodromy: *monodromy * *monodromy,
        position_error: *position_error,
        trace_error: 2.0 * point.trace.abs() * trace_error,
    };
    BranchPoint {
        parameter: point.parameter,
        orbit,
        trace: point.trace * point.trace - 2.0 * point.determinant,
        determinant: point.determinant * point.determinant,
        arclength: point.arclength,
    }
}

#[cfg(test)]
mod tests {
    use bouncing_disk::core::numerics::elementary::{pow, sin};
    use bouncing_disk::core::orbits::ContinuationParameter;
    use bouncing_disk::core::{ImpactMap, Vibration};

    use super::*;

    fn forcing(low: f64, high: f64, rising: bool) -> Continuation {
        Continuation::new(ContinuationParameter::Forcing, (low, high), rising).expect("legal")
    }

    /// Parts are curves of the branch, whatever the range: through folds, from a birth, and between two points.
    #[test]
    fn the_parts_of_a_branch_do_not_depend_on_where_its_points_lie() {
        let map = ImpactMap::new(Vibration::from_axial_forcing(1.0 / 3.0 + 1e-3).expect("legal"), 0.5)
            .expect("legal");
        let pair = map.period_one_pair(1).expect("above its birth");
        let orbit = pair.node.orbit(&map).expect("no failure").expect("admissible");
        let back = map.continued(&orbit, &forcing(0.2, 0.6, false), &Unobserved).expect("continued");
        let on = map.continued(&orbit, &forcing(0.2, 0.6, true), &Unobserved).expect("continued");
        let doubled = on.switched(0, &forcing(0.2, 0.6, true), &Unobserved).expect("doubles");
        let stem = doubled.map_at(doubled.points[0].parameter).expect("legal");
        let stem = stem
            .continued(&doubled.points[0].orbit, &forcing(0.2, 0.6, false), &Unobserved)
            .expect("continued");
        assert_eq!(stem.bifurcations.last().map(|last| last.kind), Some(BifurcationKind::Birth));
        let third = 1.0 / 3.0;
        let doubling = ImpactMap::first_doubling_forcing(0.5);
        for (branch, range, ends) in [
            (&on, (0.45, 0.45 + 1e-12), (0.45, 0.45 + 1e-12)),
            (&on, (0.4, 0.5), (0.4, 0.5)),
            (&on, (0.55, 0.7), (0.55, 0.6)),
            (&back, (0.33, 0.45), (map.vibration().axial_forcing(), 0.45)),
            (&back, (third - 1e-7, third + 1e-7), (third + 1e-7, third + 1e-7)),
            (&back, (third - 1e-10, third + 1e-10), (third + 1e-10, third + 1e-10)),
            (&stem, (doubling - 1e-7, doubling + 1e-7), (doubling + 1e-7, doubling)),
            (&doubled, (0.5, 0.5 + 1e-9), (0.5, 0.5 + 1e-9)),
        ] {
            let parts = within(branch, range, 50).expect("found");
            assert_eq!(parts.len(), 1, "{range:?}");
            let (first, last) = (&parts[0][0], &parts[0][parts[0].len() - 1]);
            let near = |a: f64, b: f64| (a - b).abs() < 1e-14;
            assert!(
                near(first.parameter, ends.0) && near(last.parameter, ends.1),
                "{range:?}: {} {}",
                first.parameter,
                last.parameter
            );
            let least = if last.orbit.period() == 2 && near(last.parameter, doubling) { 10 } else { 50 };
            assert!(range.1 - range.0 < 1e-8 || parts[0].len() >= least, "{range:?}: {}", parts[0].len());
            for point in &parts[0] {
                assert!((range.0..=range.1).contains(&point.parameter));
                // Its birth passes an orbit twice.
                let monodromy = point.orbit.monodromy;
                let trace = monodromy.x_axis.x + monodromy.y_axis.y;
                assert!((point.trace - trace).abs() < 1e-9 * (1.0 + trace.abs()), "{range:?}: {point:?}");
                let known = pow(0.25, point.orbit.period() as f64);
                assert!((point.determinant - known).abs() < 1e-9, "{range:?}: {point:?}");
                let map = branch.map_at(point.parameter).expect("legal");
                let states = &point.orbit.states;
                let mut around = None;
                for (state, next) in states.iter().zip(states.iter().cycle().skip(1)) {
                    let (impact, derivative) = map.step_with_derivative(*state).expect("flies");
                    around = Some(around.map_or(derivative, |around| derivative * around));
                    let apart = impact.phase.angle() - next.phase().angle();
                    assert!(sin(apart).abs() < 1e-9, "{range:?}: {apart}");
                }
                // Of a birth, which is an orbit passed twice, too.
                let around = around.expect("an impact");
                let trace = around.x_axis.x + around.y_axis.y;
                let off = [point.trace - trace, point.determinant - around.determinant()];
                assert!(off[0].abs().max(off[1].abs()) < 1e-9, "{range:?}: {off:?}");
            }
        }
        assert_eq!(within(&on, (0.1, 0.3), 50), Ok(Vec::new()));
        assert_eq!(within(&on, (0.7, 0.8), 50), Ok(Vec::new()));
    }
}
