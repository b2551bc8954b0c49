//! The search: a grid over frequency, lag and amplitude angle, then golden sections inside of each other
//! around its best points (docs/numerics/design.md, "The search").

use bouncing_disk_core::run::{Watch, WorkCount};

use crate::error::Error;
use crate::toss::design::constraints::{TossCertificate, TossConstraints};
use crate::toss::design::hand::{Hand, value_of};

/// Points of the grid along frequency, lag and amplitude angle; and where the frequency is given.
const GRID: [usize; 3] = [9, 25, 33];
const FINE_GRID: [usize; 3] = [1, 97, 129];

/// How many peaks of the grid are refined.
const PEAKS: usize = 4;

/// Half the width of the bracket, in steps of the grid, of the refinements that follow each other.
const BRACKETS: [f64; 4] = [1.0, 0.1, 0.01, 0.001];

/// Golden sections along each axis in one refinement: to 4.5e-4 of the bracket.
const SECTIONS: usize = 16;

/// Boxes that follow each other along a ridge at most, and the relative gain below which its top is reached.
const MOST_BOXES: usize = 40;
const CLIMBED: f64 = 1e-10;

/// Stages that are reported to an observer: the grid, and each refinement.
pub(super) const STAGES: u64 = 1 + (PEAKS + BRACKETS.len() - 1) as u64;

/// Work of one evaluation, in flights.
const FLIGHTS_OF_EVALUATION: u64 = 64;

/// The result of the search.
pub(super) struct Found {
    pub(super) hand: Hand,
    pub(super) certificate: TossCertificate,
}

/// The objective over the unit cube of frequency, lag and amplitude angle.
struct Objective<'a, 'w> {
    constraints: &'a TossConstraints,
    /// The frequencies at which the dough can leave the hand.
    frequencies: [f64; 2],
    work: WorkCount<'w>,
}

/// A place in the cube, and the value there.
#[derive(Debug, Clone, Copy)]
struct Place {
    at: [f64; 3],
    value: f64,
}

fn between([low, high]: [f64; 2], share: f64) -> f64 {
    // The end itself, not what rounding makes of it.
    if share >= 1.0 { high } else { low + (high - low) * share }
}

impl Objective<'_, '_> {
    fn hand(&self, at: [f64; 3]) -> Option<Hand> {
        let angular_frequency = between(self.frequencies, at[0]);
        let angles = self.constraints.amplitude_angles(angular_frequency)?;
        Some(Hand {
            angular_frequency,
            phase_lag: between(self.constraints.phase_lag, at[1]),
            amplitude_angle: between(angles, at[2]),
        })
    }

    fn value(&mut self, at: [f64; 3]) -> Result<f64, Error> {
        self.work.spend(FLIGHTS_OF_EVALUATION)?;
        // At the least frequency the dough just does not leave.
        let Some(hand) = self.hand(at) else { return Ok(0.0) };
        value_of(self.constraints, hand.stroke(self.constraints), self.constraints.dough)
    }

    /// The best place in a box, from `axis` on: golden sections along this axis over the best along the next
    /// ones.
    fn best_in(&mut self, bounds: &[[f64; 2]; 3], at: [f64; 3], axis: usize) -> Result<Place, Error> {
        if axis == 3 {
            return Ok(Place { at, value: self.value(at)? });
        }
        let [mut low, mut high] = bounds[axis];
        let mut along = |position: f64| {
            let mut place = at;
            place[axis] = position;
            self.best_in(bounds, place, axis + 1)
        };
        let mut best = along(low)?;
        if low >= high {
            return Ok(best);
        }
        // Optima often lie at the end of a range, which sections approach and never reach.
        let end = along(high)?;
        best = better(best, end);
        const SHARE: f64 = 0.618_033_988_749_894_9;
        let mut one = along(high - SHARE * (high - low))?;
        let mut other = along(low + SHARE * (high - low))?;
        for _ in 0..SECTIONS {
            best = better(better(best, one), other);
            if one.value >= other.value {
                high = other.at[axis];
                other = one;
                one = along(high - SHARE * (high - low))?;
            } else {
                low = one.at[axis];
                one = other;
                other = along(low + SHARE * (high - low))?;
            }
        }
        Ok(better(better(best, one), other))
    }
}

/// The first one unless the second is above it.
fn better(one: Place, other: Place) -> Place {
    if other.value > one.value { other } else { one }
}

/// The grid with its values, row by row.
struct Grid {
    shape: [usize; 3],
    values: Vec<f64>,
}

impl Grid {
    fn new(objective: &mut Objective<'_, '_>, shape: [usize; 3]) -> Result<Self, Error> {
        let count = shape.iter().product();
        let mut grid = Self { shape, values: Vec::with_capacity(count) };
        for index in 0..count {
            let value = objective.value(grid.place(grid.indices(index)))?;
            grid.values.push(value);
        }
        Ok(grid)
    }

    const fn indices(&self, index: usize) -> [usize; 3] {
        let [_, lags, angles] = self.shape;
        [index / (lags * angles), index / angles % lags, index % angles]
    }

    fn value(&self, [i, j, k]: [usize; 3]) -> f64 {
        self.values[(i * self.shape[1] + j) * self.shape[2] + k]
    }

    fn step(&self, axis: usize) -> f64 {
        if self.shape[axis] > 1 { 1.0 / (self.shape[axis] - 1) as f64 } else { 0.0 }
    }

    fn place(&self, indices: [usize; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| indices[axis] as f64 * self.step(axis))
    }

    /// The points next to this one along an axis.
    fn neighbours(&self, indices: [usize; 3], axis: usize) -> impl Iterator<Item = [usize; 3]> + use<> {
        let last = self.shape[axis] - 1;
        let moved = move |index: usize| {
            let mut place = indices;
            place[axis] = index;
            place
        };
        let own = indices[axis];
        let below = (own > 0).then(|| moved(own - 1));
        let above = (own < last).then(|| moved(own + 1));
        below.into_iter().chain(above)
    }

    /// The points that no neighbour exceeds, best first; of equal ones the first.
    fn peaks(&self) -> Vec<usize> {
        let mut peaks: Vec<usize> = (0..self.values.len())
            .filter(|&index| {
                let own = self.indices(index);
                (0..3)
                    .all(|axis| self.neighbours(own, axis).all(|next| self.value(next) <= self.values[index]))
            })
            .collect();
        peaks.sort_by(|&one, &other| self.values[other].total_cmp(&self.values[one]));
        peaks.truncate(PEAKS);
        peaks
    }

    /// By how much the objective could exceed `best` between points that are not next to it, if between two
    /// points it changes no faster than from one to the other, or from either to its next neighbour.
    fn hidden_gain(&self, best: &Place) -> f64 {
        let mut gain = 0.0_f64;
        for (index, value) in self.values.iter().enumerate() {
            let own = self.indices(index);
            let place = self.place(own);
            if (0..3).all(|axis| (place[axis] - best.at[axis]).abs() <= 1.0001 * self.step(axis)) {
                continue;
            }
            let rise: f64 = (0..3).map(|axis| self.rise_between(own, axis)).sum();
            gain = gain.max(value + rise - best.value);
        }
        gain
    }

    /// How far the objective may rise above the higher one of a point and a neighbour along an axis.
    fn rise_between(&self, own: [usize; 3], axis: usize) -> f64 {
        let value = self.value(own);
        let differences = |place: [usize; 3]| {
            let own = self.value(place);
            self.neighbours(place, axis).map(move |next| (self.value(next) - own).abs())
        };
        let rises = self.neighbours(own, axis).map(|next| {
            let steepest = differences(own).chain(differences(next)).fold(0.0, f64::max);
            // Up from one and down to the other at the steepest slope.
            0.5 * (steepest - (self.value(next) - value).abs())
        });
        rises.fold(0.0, f64::max)
    }
}

/// The best place in the box about a place, then in the box about that, and so on: along a ridge that leaves
/// the box.
fn climb(
    objective: &mut Objective<'_, '_>,
    mut best: Place,
    around: impl Fn([f64; 3]) -> [[f64; 2]; 3],
) -> Result<Place, Error> {
    for _ in 0..MOST_BOXES {
        let next = better(best, objective.best_in(&around(best.at), best.at, 0)?);
        let gained = next.value - best.value;
        best = next;
        if gained <= CLIMBED * best.value.abs() {
            break;
        }
    }
    Ok(best)
}

/// The best hand motion of constraints that are legal.
pub(super) fn search(constraints: &TossConstraints, watch: &Watch<'_>) -> Result<Found, Error> {
    let [least, most] = constraints.angular_frequency;
    let lift_off = (constraints.dough.preload_acceleration / constraints.stroke).sqrt();
    let frequencies = [least.max(lift_off).min(most), most];
    let mut objective = Objective { constraints, frequencies, work: watch.work() };
    let ranges = [frequencies, constraints.phase_lag, [0.0, 1.0]];
    let points = if frequencies[0] < frequencies[1] { GRID } else { FINE_GRID };
    let shape = std::array::from_fn(|axis| if ranges[axis][0] < ranges[axis][1] { points[axis] } else { 1 });
    let grid = Grid::new(&mut objective, shape)?;
    watch.finish(1);

    let around = |at: [f64; 3], width: f64| -> [[f64; 2]; 3] {
        std::array::from_fn(|axis| {
            let half = width * grid.step(axis);
            let last = if shape[axis] > 1 { 1.0 } else { 0.0 };
            [(at[axis] - half).clamp(0.0, last), (at[axis] + half).clamp(0.0, last)]
        })
    };
    // A hand motion that throws: without friction none is better than any other, and some throw nothing.
    let middle = around([1.0, 0.5, 0.5], 0.0).map(|[at, _]| at);
    let mut best = Place { at: middle, value: objective.value(middle)? };
    for peak in grid.peaks() {
        let own = Place { at: grid.place(grid.indices(peak)), value: grid.values[peak] };
        best = better(best, climb(&mut objective, own, |at| around(at, BRACKETS[0]))?);
        watch.finish(1);
    }
    for width in &BRACKETS[1..] {
        best = climb(&mut objective, best, |at| around(at, *width))?;
        watch.finish(1);
    }
    let peak_acceleration = constraints.stroke * most * most / constraints.dough.preload_acceleration;
    Ok(Found {
        hand: objective.hand(best.at).ok_or(Error::NeverLeaves { peak_acceleration })?,
        certificate: TossCertificate {
            grid_points: grid.values.len(),
            best_on_grid: grid.values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            hidden_gain: grid.hidden_gain(&best),
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(values: &[f64]) -> Grid {
        Grid { shape: [1, 1, values.len()], values: values.to_vec() }
    }

    #[test]
    fn a_plateau_beside_a_cliff_may_hide_a_peak() {
        let best = |share: f64| Place { at: [0.0, 0.0, share], value: 1.0 };
        // Between two points at 0.9, each a step of 0.9 above the next one, there may be a peak of 0.9 +
        // 0.45.
        let gain = row(&[0.0, 1.0, 0.0, 0.0, 0.9, 0.9, 0.0, 0.0, 0.0]).hidden_gain(&best(0.125));
        assert!((gain - 0.35).abs() < 1e-15, "{gain}");
        // A ramp hides nothing, nor do values far below; the surroundings of the optimum have been searched.
        for values in [[0.0, 0.2, 0.4, 0.6, 0.8, 1.0], [0.0, 0.1, 0.0, 0.1, 0.0, 1.0]] {
            assert!(row(&values).hidden_gain(&best(1.0)).abs() <= 0.0, "{values:?}");
        }
        assert!(row(&[1.0]).hidden_gain(&best(0.0)).abs() <= 0.0);
    }

    #[test]
    fn peaks_are_what_no_neighbour_exceeds_best_first() {
        assert_eq!(row(&[0.5, 0.1, 0.9, 0.9, 0.2, 0.7]).peaks(), [2, 3, 5, 0]);
        assert_eq!(row(&[3.0]).peaks(), [0]);
        let square = Grid { shape: [2, 1, 2], values: vec![1.0, 3.0, 4.0, 2.0] };
        assert_eq!(square.peaks(), [2, 1]);
        assert_eq!((square.indices(3), square.place([1, 0, 1])), ([1, 0, 1], [1.0, 0.0, 1.0]));
    }
}
