//! The passes of a search: the grid, the points that may be the best, finer grids, and the value at the
//! optimum.

use std::f64::consts::TAU;

use bouncing_disk_core::numerics::statistics::NORMAL_975;

use super::line::Line;
use super::{
    Best, BestValue, CHEAP_PLACES, Found, PARTS, Place, QuantityBound, SEEDS, Search, SearchRange, value,
};
use crate::error::Error;
use crate::motor::operation::point::Estimate;
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::parameter_sweep::groups::operations_in_groups;
use crate::motor::parameter_sweep::quantity::SweepQuantity;
use crate::motor::stator::Stator;

/// Members per point on the first grid for compliant stators.
const DEAR_MEMBERS: usize = 8;

/// The relative error of the first grid is at least this; each further pass over the candidates divides it by
/// the factor below.
const ROUGH: f64 = 0.1;
const FINER: f64 = 3.0;

/// The share of the settings' `most_impacts` that a point may use before the optimum is found; otherwise a
/// few points that do not settle would take most of the time.
pub(super) const SHARE_OF_PLACE: f64 = 0.125;

/// If more points than this are computed together, they share the impacts that this number of points may use.
const CROWD: f64 = 32.0;

/// Impacts that any point may use.
const LEAST_IMPACTS: f64 = 1e5;

/// A speed below this share of the stator's largest speed is rounding.
const ROUNDING: f64 = 1e-6;

impl Search<'_> {
    /// Searches from the grid to the optimum.
    pub(super) fn run(&mut self, side: usize, steps: [i32; 2]) -> Result<Best, Error> {
        let mut all = self.grid(side);
        let wanted = self.settings.relative_error;
        let mut error = wanted.max(ROUGH);
        let mut open: Vec<usize> = (0..all.len()).collect();
        loop {
            self.measure(&mut all, &open, error)?;
            if error <= wanted {
                break;
            }
            open = self.possible(&all, open);
            // The others need no further computation.
            self.watch.finish((all.len() - open.len()) as u64);
            error = (error / FINER).max(wanted);
        }
        self.peak = narrow_peak(&all, side, self.sought.ranges.len());
        let mut step: Vec<f64> = self.sought.ranges.iter().map(|range| self.step(range, side)).collect();
        for steps in steps {
            let middle = all[self.best_of(&all)?].at.clone();
            step.iter_mut().for_each(|step| *step /= PARTS);
            let first = all.len();
            all.extend(self.around(&middle, steps, &step));
            let new: Vec<usize> = (first..all.len()).collect();
            self.measure(&mut all, &new, wanted)?;
        }
        if step.len() > 1 && matches!(self.motor.stator_motion(), Stator::Sine) {
            for field in 0..step.len() {
                if !self.sought.leaves_height(self.motor, field)? {
                    self.scan(field, &mut all)?;
                }
            }
        }
        let mut place = all[self.best_of(&all)?].clone();
        let mut lines = Vec::new();
        for (field, step) in step.into_iter().enumerate() {
            let line = self.line(&mut place, field, step, &mut all)?;
            lines.push(line);
        }
        self.result(&place, &lines, &all)
    }

    fn step(&self, range: &SearchRange, side: usize) -> f64 {
        1.0 / (side - usize::from(!range.is_turn())) as f64
    }

    fn grid(&self, side: usize) -> Vec<Place> {
        let lines = self.sought.ranges.iter().map(|range| {
            let step = self.step(range, side);
            (0..side).map(|k| (k as f64 * step).min(1.0)).collect::<Vec<f64>>()
        });
        let mut all: Vec<Vec<f64>> = vec![Vec::new()];
        for line in lines {
            all = all
                .iter()
                .flat_map(|at| line.iter().map(|own| at.iter().copied().chain([*own]).collect()))
                .collect();
        }
        all.into_iter().map(|at| Place { at, found: None }).collect()
    }

    /// Scans the whole range of a field through the best point, because motions lock to cycles in windows
    /// that a grid over two fields misses.
    fn scan(&mut self, field: usize, all: &mut Vec<Place>) -> Result<(), Error> {
        let (middle, side) = (all[self.best_of(all)?].at.clone(), CHEAP_PLACES[0]);
        let step = self.step(&self.sought.ranges[field], side);
        let along = (0..side).map(|k| {
            let mut at = middle.clone();
            at[field] = (k as f64 * step).min(1.0);
            Place { at, found: None }
        });
        let first = all.len();
        all.extend(along);
        let new: Vec<usize> = (first..all.len()).collect();
        self.measure(all, &new, self.settings.relative_error.max(ROUGH))?;
        self.peak = self.peak.max(narrow_peak(&all[first..], side, 1));
        let open = self.possible(all, new);
        self.measure(all, &open, self.settings.relative_error)
    }

    /// A finer grid around a point.
    fn around(&self, middle: &[f64], steps: i32, step: &[f64]) -> Vec<Place> {
        let mut all: Vec<Vec<f64>> = vec![Vec::new()];
        for ((middle, step), range) in middle.iter().zip(step).zip(&self.sought.ranges) {
            let own = (-steps..=steps).map(|k| middle + f64::from(k) * step);
            let own: Vec<f64> = own.filter(|at| range.is_turn() || (0.0..=1.0).contains(at)).collect();
            all = all
                .iter()
                .flat_map(|at| own.iter().map(|own| at.iter().copied().chain([*own]).collect()))
                .collect();
        }
        all.into_iter().map(|at| Place { at, found: None }).collect()
    }

    /// Computes some of the points.
    pub(super) fn measure(&mut self, all: &mut [Place], which: &[usize], error: f64) -> Result<(), Error> {
        let mut settings = OperatingSettings { relative_error: error, ..*self.settings };
        if error >= ROUGH && self.motor.stator_motion().yields() {
            settings.members = settings.members.min(DEAR_MEMBERS);
        }
        // The number of impacts grows as the inverse square of the error: a point that would need more is not
        // refined, and stays open.
        let share = (self.settings.relative_error / error).min(1.0);
        let crowd = (CROWD / which.len() as f64).min(1.0);
        self.measure_with(all, which, &settings.with_share(share * share * SHARE_OF_PLACE * crowd))
    }

    pub(super) fn measure_with(
        &mut self,
        all: &mut [Place],
        which: &[usize],
        settings: &OperatingSettings,
    ) -> Result<(), Error> {
        let motors = which.iter().map(|index| self.sought.motor_at(self.motor, &all[*index].at));
        // Values that are legal at the ends may be illegal between them, such as a quality below a half; such
        // points are skipped.
        let (mut legal, mut motors_of) = (Vec::new(), Vec::new());
        for (index, motor) in which.iter().zip(motors) {
            match motor {
                Ok(motor) => {
                    legal.push(*index);
                    motors_of.push(motor);
                }
                Err(failure) => self.failure = Some(failure),
            }
        }
        self.places += legal.len();
        let rows = operations_in_groups(&motors_of, settings, self.watch)?;
        for (index, row) in legal.into_iter().zip(rows) {
            match row {
                Ok(row) => all[index].found = Found::of(self.sought, row.operation()),
                Err(failure) => self.failure = Some(failure),
            }
        }
        Ok(())
    }

    /// The points that may be the best.
    fn possible(&self, all: &[Place], open: Vec<usize>) -> Vec<usize> {
        let keeping = open.iter().filter_map(|index| all[*index].found.as_ref());
        let keeping = keeping.filter(|found| found.margin(self.sought) >= 1.0);
        let least = keeping.map(Found::at_least).fold(f64::NEG_INFINITY, f64::max);
        let may = |found: &Found| found.at_most() >= least && found.margin(self.sought) >= -NORMAL_975;
        let kept: Vec<usize> =
            open.iter().copied().filter(|index| all[*index].found.as_ref().is_some_and(&may)).collect();
        if kept.is_empty() { open } else { kept }
    }

    /// The best of the points that satisfy the bounds.
    pub(super) fn best_of(&self, all: &[Place]) -> Result<usize, Error> {
        let known = || all.iter().enumerate().filter_map(|(index, own)| Some((index, own.found.as_ref()?)));
        let keeping = known().filter(|(_, found)| found.is_settled && found.margin(self.sought) >= 1.0);
        let best = keeping.max_by(|one, other| one.1.value.value.total_cmp(&other.1.value.value));
        let Some((index, found)) = best else {
            let nearest = known()
                .max_by(|one, other| one.1.margin(self.sought).total_cmp(&other.1.margin(self.sought)));
            let Some((_, found)) = nearest else {
                let quantity = self.sought.objective.name();
                return Err(self.failure.unwrap_or(Error::NotPositive { quantity, value: f64::NAN }));
            };
            let failing = self.sought.bounds.iter().zip(&found.bounds).min_by(|one, other| {
                let margin = |(bound, own): &(&QuantityBound, &Estimate)| bound.margin(own.value);
                margin(one).total_cmp(&margin(other))
            });
            return Err(match failing {
                Some((bound, own)) if found.is_settled => Error::NotKept {
                    quantity: bound.quantity.name(),
                    is_least: bound.is_least,
                    bound: bound.value,
                    nearest: own.value,
                },
                // Every point still drifts.
                _ => Error::NotPositive { quantity: self.sought.objective.name(), value: found.value.value },
            });
        };
        // Without friction only rounding turns the rotor.
        let fastest = self.motor.system().platform().peak_angular_speed();
        let is_rounding =
            self.sought.objective == SweepQuantity::Speed && found.value.value <= ROUNDING * fastest;
        if found.at_least() <= 0.0 || is_rounding {
            return Err(Error::NotPositive {
                quantity: self.sought.objective.name(),
                value: found.value.value,
            });
        }
        Ok(index)
    }

    /// The value at the best point, with other perturbations.
    fn result(&mut self, place: &Place, lines: &[Line], all: &[Place]) -> Result<Best, Error> {
        let motor = self.sought.motor_at(self.motor, &place.at)?;
        let settings =
            OperatingSettings { seed: self.settings.seed.wrapping_add(1 + SEEDS as u64), ..*self.settings };
        // There are as many rows as motors.
        let row = operations_in_groups(&[motor], &settings, self.watch)?.swap_remove(0)?;
        // Of several coexisting motions, the one that was found there.
        let off = |found: &Found| place.found.as_ref().map_or(0.0, |own| (value(found) - value(own)).abs());
        let known = row.branches.iter().map(|operation| Found::of(self.sought, operation)).enumerate();
        let nearest = known
            .filter_map(|(branch, found)| Some((branch, found?)))
            .min_by(|(_, one), (_, other)| off(one).total_cmp(&off(other)));
        let Some((branch, found)) = nearest else {
            return Err(Error::NotPositive { quantity: self.sought.objective.name(), value: f64::NAN });
        };
        // The values that were certainly better elsewhere, within the bounds as far as they are known.
        let elsewhere = all.iter().filter_map(|place| place.found.as_ref());
        let elsewhere = elsewhere.filter(|found| found.margin(self.sought) >= -1.0);
        let better = elsewhere.map(Found::at_least).fold(found.value.value, f64::max) - found.value.value;
        let beside = lines.iter().map(|line| line.beside).fold(self.peak, f64::max);
        let value = Estimate {
            standard_error: found.value.standard_error + (better + beside) / NORMAL_975,
            ..found.value
        };
        let values = self.sought.ranges.iter().zip(lines).map(|(range, line)| {
            let value = range.value(line.best);
            let turn = if range.is_turn() { -TAU * ((value + 0.5 * TAU) / TAU).floor() } else { 0.0 };
            let width = (range.high - range.low) * (line.top[1] - line.top[0]);
            let end = [0.0, 1.0].iter().any(|end| (line.best - end).abs() < 1e-9);
            BestValue {
                field: range.field,
                value: Estimate { value: value + turn, standard_error: 0.5 * width },
                good_from_to: line.good.map(|ends| ends.map(|end| range.value(end) + turn)),
                is_at_end: end && !range.is_turn(),
            }
        });
        Ok(Best { values: values.collect(), value, row, branch, bounds: found.bounds, places: self.places })
    }
}

impl OperatingSettings {
    /// The same settings with a share of the impacts.
    pub(super) fn with_share(self, share: f64) -> Self {
        let most_impacts = (self.most_impacts as f64 * share).max(LEAST_IMPACTS) as u64;
        Self { most_impacts: most_impacts.min(self.most_impacts), ..self }
    }
}

/// The height of a peak that is narrower than the grid, as for a locked motion: the amount by which a point
/// certainly exceeds its two neighbours along a field and their own trend. Similar peaks may lie between the
/// points.
fn narrow_peak(all: &[Place], side: usize, fields: usize) -> f64 {
    let settled = |index: usize| all[index].found.as_ref().filter(|found| found.is_settled);
    let value = |index: usize| settled(index).map(|found| found.value);
    let best = all.iter().filter_map(|place| place.found.as_ref()).map(|found| found.value.value);
    let best = best.fold(0.0, f64::max);
    let mut highest = 0.0_f64;
    for field in 0..fields {
        let stride = side.pow((fields - 1 - field) as u32);
        for index in 0..all.len() {
            let along = index / stride % side;
            if along < 2 || along + 2 >= side {
                continue;
            }
            let near = [index - 2 * stride, index - stride, index, index + stride, index + 2 * stride];
            let [Some(a), Some(b), Some(own), Some(c), Some(d)] = near.map(value) else { continue };
            // A smooth top falls off at an increasing rate.
            let beside = [b, c].map(|near| near.value + NORMAL_975 * near.standard_error);
            let falls = (a.value - b.value).abs().max((c.value - d.value).abs());
            let height = own.value - NORMAL_975 * own.standard_error - beside[0].max(beside[1]) - falls;
            if own.value >= 0.5 * best {
                highest = highest.max(height);
            }
        }
    }
    highest
}

/// Number of passes, including the first grid, until the errors reach this value.
pub(super) fn passes(wanted: f64) -> usize {
    let mut error = wanted.max(ROUGH);
    let mut passes = 1;
    while error > wanted {
        error = (error / FINER).max(wanted);
        passes += 1;
    }
    passes
}
