//! The parts of a branch in a range of its parameter, at the resolution of a view.

use super::{BifurcationKind, Branch, BranchEnd, BranchPoint, Continuation};
use crate::numerics::error::{Error, within};
use crate::orbits::periodic::PeriodicOrbit;
use crate::run::Unobserved;

/// Steps of the arclength in a first pass through a part, which measures its length.
const FIRST_STEP: f64 = 0.01;
const LARGEST_STEP: f64 = 0.05;

/// The smallest step of a [`Continuation`].
const SMALLEST_STEP: f64 = 1.0e-9;

/// A part has at most so many times the points that it should have.
const PATIENCE: usize = 16;

/// Most points on the way to the edge of a range.
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

impl Branch {
    /// The parts of the branch with their parameter in [`low`, `high`], in the order of the arclength, each
    /// continued anew with steps that are a share of it: at least `points` of them in [2, 1e4] on a part,
    /// however narrow the range is (the smallest step is an arclength of 1e-9). The arclengths are those of
    /// the parts. Fewer lie on a part that ends in a birth by doubling and is short: close to it the two
    /// halves of the orbit are indistinguishable, and the birth follows at once.
    ///
    /// The range only selects: it neither begins nor ends a branch. The birth by doubling that ends a branch
    /// is part of it, as the halved orbit run through twice.
    ///
    /// ```
    /// # use bouncing_disk_core::orbits::{Continuation, ContinuationParameter};
    /// # use bouncing_disk_core::{ImpactMap, Unobserved, Vibration};
    /// # let map = ImpactMap::new(Vibration::from_axial_forcing(0.34)?, 0.5)?;
    /// # let orbit = map.refine(&[map.period_one(1).expect("it exists")])?;
    /// let whole = Continuation::new(ContinuationParameter::Forcing, (0.1, 0.6), true)?;
    /// let branch = map.continued(&orbit, &whole, &Unobserved)?;
    /// let parts = branch.within((0.45, 0.45 + 1e-6), 100)?;
    /// assert_eq!(parts.len(), 1);
    /// assert!(parts[0].len() >= 100);
    /// assert_eq!((parts[0][0].parameter, branch.within((0.2, 0.3), 100)?.len()), (0.45, 0));
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an empty range or the number of points; those of [`ImpactMap::continued`]
    /// but for [`Error::NoBranch`]: a part that is not found again has the points of this branch.
    ///
    /// [`ImpactMap::continued`]: crate::ImpactMap::continued
    pub fn within(&self, (low, high): (f64, f64), points: usize) -> Result<Vec<Vec<BranchPoint>>, Error> {
        within("high end of a range", high, low.next_up(), f64::MAX, "(low end, inf)")?;
        within("points of a part", points as f64, 2.0, 1.0e4, "[2, 1e4]")?;
        // The branch ends where its own range does, also in a second pass.
        let (mut low, mut high) = (low, high);
        if let BranchEnd::RangeLimit(limit) = self.end {
            let below = self.points.iter().all(|point| point.parameter <= limit);
            (low, high) = if below { (low, high.min(limit)) } else { (low.max(limit), high) };
        }
        if low >= high {
            return Ok(Vec::new());
        }
        let known = self.known();
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
            let part = match self.part(&known[first..=index], (low, high), points) {
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
    fn known(&self) -> Vec<Known> {
        let points = self.points.iter().map(|point| Known { point: point.clone(), begins: true });
        let mut known: Vec<Known> = points.collect();
        for found in &self.bifurcations {
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
        &self,
        known: &[Known],
        (low, high): (f64, f64),
        points: usize,
    ) -> Result<Option<Vec<BranchPoint>>, Error> {
        let inside = |one: &Known| (low..=high).contains(&one.at());
        let last = known.len() - 1;
        let towards = |from: usize, to: usize| known[to].at() > known[from].at();
        // From the beginning of the branch there is only one way, so going back does not leave it.
        if inside(&known[0]) && known[0].begins {
            return self.fine(&known[0].point, towards(0, 1), (low, high), points).map(Some);
        }
        let middle =
            (1..last).filter(|index| known[*index].begins).min_by_key(|index| index.abs_diff(last / 2));
        if let Some(middle) = middle {
            let forward =
                self.fine(&known[middle].point, towards(middle, middle + 1), (low, high), points)?;
            let mut part =
                self.fine(&known[middle].point, towards(middle, middle - 1), (low, high), points)?;
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
                let settings = Continuation::new(self.parameter, (at.min(edge), at.max(edge)), rising)?;
                // At a fold the parameter goes with the square of the arclength: a longer step could leap
                // over the range, and come back on the other side.
                let gap = (known[to].point.arclength - known[from].point.arclength).abs();
                let share = ((edge - known[to].at()) / (at - known[to].at())).abs();
                let step = (0.5 * gap * share.sqrt()).clamp(SMALLEST_STEP, LARGEST_STEP);
                let settings = settings.with_steps(step, step, MOST_TO_EDGE)?;
                let map = self.map_at(at)?;
                let to_edge = map.continued_from(&known[from].point.orbit, &settings, &Unobserved)?;
                to_edge.points.last().filter(|_| to_edge.end == BranchEnd::RangeLimit(edge)).cloned()
            };
            let Some(entry) = entry else { continue };
            let mut part = self.fine(&entry, rising, (low, high), points)?;
            if from != 0 {
                part.reverse();
            }
            return Ok(Some(part));
        }
        Ok(None)
    }

    /// The branch from one of its points in a direction, as far as it lies in a range.
    fn fine(
        &self,
        from: &BranchPoint,
        rising: bool,
        (low, high): (f64, f64),
        points: usize,
    ) -> Result<Vec<BranchPoint>, Error> {
        let at = from.parameter.clamp(low, high);
        let map = self.map_at(at)?;
        let settings = Continuation::new(self.parameter, (low, high), rising)?;
        let most = points * PATIENCE;
        let mut part = map.continued_from(
            &from.orbit,
            &settings.with_steps(FIRST_STEP, LARGEST_STEP, most)?,
            &Unobserved,
        )?;
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
