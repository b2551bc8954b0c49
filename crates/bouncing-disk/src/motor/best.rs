//! The best of a quantity over one or two fields of a data sheet, within bounds on other quantities.
//!
//! A grid of places is computed roughly; those that may be the best are computed again with smaller errors, and finer grids lie
//! about the best one. Lines through it show how wide the optimum is and where its top lies; the value is measured there, with
//! other perturbations than those that chose the place. docs/numerics/motors.md, "The best of a quantity".

mod line;

use std::f64::consts::TAU;
use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use bouncing_disk_core::Observer;
use bouncing_disk_core::numerics::statistics::NORMAL_975;
use bouncing_disk_core::run::Watch;

use self::line::Cubic;
use crate::error::{Error, check, finite};
use crate::motor::batch::shared_orbit::is_shared;
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::motor_field::MotorField;
use crate::motor::operation::point::{Estimate, OperatingRow, Operation, Shortfall};
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::parameter_sweep::axis::{SweepAxis, check_axes};
use crate::motor::parameter_sweep::groups::operations_in_groups;
use crate::motor::parameter_sweep::quantity::SweepQuantity;
use crate::motor::stator::Stator;
use crate::statistics::student_quantile;

/// Places along one field, and along each of two: of rigid impacts on a sine, where each takes milliseconds; of all else; and of
/// stators that yield, where each takes a tenth of a second and more.
const CHEAP_PLACES: [usize; 2] = [400, 32];
const PLACES: [usize; 2] = [200, 16];
const DEAR_PLACES: [usize; 2] = [64, 8];

/// Members of a place of stators that yield on the first grid.
const DEAR_MEMBERS: usize = 8;

/// Places along a field that leaves the vertical motion as it is, such as load or lag: no motion locks between them.
const SMOOTH_PLACES: usize = 64;

/// The first grid is at most so accurate, and each further pass over what may be the best so many times more.
const ROUGH: f64 = 0.1;
const FINER: f64 = 3.0;

/// The share of the settings' most impacts that a place may have on the way to the optimum: few places that do not settle would
/// take most of the time.
const SHARE_OF_PLACE: f64 = 0.125;

/// Impacts that any place may have.
const LEAST_IMPACTS: f64 = 1e5;

/// Finer grids about the best place, each so many times finer than the one before, up to so many of its steps on either side:
/// of a stator that yields fewer on the second one.
const PARTS: f64 = 3.0;
const STEPS: [i32; 2] = [2, 2];
const DEAR_STEPS: [i32; 2] = [2, 1];

/// Places on either side of a line, of a first look and of the fit; its values are so many times more accurate than asked for.
const LOOK: i32 = 4;
const SIDE: i32 = 16;
const DEAR_SIDE: i32 = 8;
const SURER: f64 = 2.0;

/// The largest relative error that settings may ask for.
const LARGEST_ERROR: f64 = 0.5;

/// Seeds of a line, in turn along it: places of one seed may share a vertical motion, and with it their errors. There the seeds
/// have together so many times the impacts of a place that has one motion.
const SEEDS: usize = 8;
const SHARED: f64 = 2.0;

/// Least places of a line.
const LEAST: usize = 8;

/// Most looks at one line, each with another length, and by how much that changes.
const LOOKS: usize = 6;
const LENGTHEN: f64 = 3.0;

/// A speed below this share of the stator's is none.
const ROUNDING: f64 = 1e-6;

/// A value beyond this share of the best one is good.
const GOOD: f64 = 0.99;

/// The part of a line that says how wide its top is: values beyond this share of the best one.
const NEAR: f64 = 2.0 * GOOD - 1.0;

/// Places of a cubic among which its top is taken.
const FINE: i32 = 500;

/// A line whose values scatter by more than this share of the best one, and so many times their own errors, is too rough for a
/// range.
const ROUGHEST: f64 = 0.25 * (1.0 - GOOD);
const EXPLAINED: f64 = 1.5;

/// Values with errors below this share of the best one say a range by themselves.
const EXACT: f64 = 0.1 * (1.0 - GOOD);

/// No value of a smooth line is so many times the scatter off.
const OUTLIER: f64 = 4.0;

/// A line between a field's ends.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SearchRange {
    /// The field of the data sheet.
    pub field: MotorField,
    /// Its least and largest value, in the unit of the field. A phase lag over a whole turn has no ends.
    pub low: f64,
    /// The largest.
    pub high: f64,
}

/// A bound that an optimum has to keep.
///
/// ```
/// use bouncing_disk::motor::QuantityBound;
///
/// let bound: QuantityBound = "speed >= 5".parse()?;
/// assert_eq!(bound.to_string(), "speed >= 5");
/// assert!("speed > 5".parse::<QuantityBound>().is_err());
/// # Ok::<(), String>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct QuantityBound {
    /// The quantity.
    pub quantity: SweepQuantity,
    /// Whether the bound is its least value; otherwise it is the largest.
    pub is_least: bool,
    /// The bound, in the unit of the quantity.
    pub value: f64,
}

impl QuantityBound {
    /// Whether an operation keeps the bound, as far as its quantity is known at all.
    #[must_use]
    pub fn is_kept(&self, operation: &Operation) -> Option<bool> {
        Some(self.margin(self.quantity.of(operation)?.value) >= 0.0)
    }

    /// By how much a value keeps the bound; negative where it does not.
    fn margin(&self, value: f64) -> f64 {
        if self.is_least { value - self.value } else { self.value - value }
    }
}

impl Display for QuantityBound {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        let sign = if self.is_least { ">=" } else { "<=" };
        write!(formatter, "{} {sign} {}", self.quantity.name(), self.value)
    }
}

impl FromStr for QuantityBound {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = || {
            format!("a bound is QUANTITY >= NUMBER or QUANTITY <= NUMBER, such as speed >= 5, not {text:?}")
        };
        let signs = [(">=", true), ("<=", false)];
        let parts = signs.iter().find_map(|(sign, is_least)| Some((text.split_once(sign)?, *is_least)));
        let ((name, value), is_least) = parts.ok_or_else(form)?;
        let value = value.trim().parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(form)?;
        Ok(Self { quantity: name.parse()?, is_least, value })
    }
}

/// What is sought.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BestSearch {
    /// The quantity whose largest value is sought.
    pub objective: SweepQuantity,
    /// The fields that may vary: one or two. All else is taken from the data sheet.
    pub ranges: Vec<SearchRange>,
    /// Bounds on quantities of the same operating point: at most two.
    pub bounds: Vec<QuantityBound>,
}

/// A field at the optimum.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BestValue {
    /// The field.
    pub field: MotorField,
    /// Its value, in the unit of the field, with its standard error.
    pub value: Estimate,
    /// The range around it, with the other field as it is at the optimum, in which the quantity has at least 99 % of its best
    /// value and the bounds are kept. `None` where the curve is too rough to tell, as next to a locked motion. That of a phase
    /// lag may reach beyond the circle.
    pub good_from_to: Option<[f64; 2]>,
    /// Whether the optimum lies at an end of the range that was searched.
    pub is_at_end: bool,
}

/// The best of a quantity.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Best {
    /// The fields, in their order.
    pub values: Vec<BestValue>,
    /// The quantity, measured at this place. Its error also holds what a better place nearby may bring.
    pub value: Estimate,
    /// The motor in operation there.
    pub row: OperatingRow,
    /// The quantities of the bounds, in their order.
    pub bounds: Vec<Estimate>,
    /// Places that were computed.
    pub places: usize,
}

/// What is known of a place.
#[derive(Debug, Clone)]
struct Found {
    value: Estimate,
    bounds: Vec<Estimate>,
    /// Whether it drifts no more, so that its errors hold.
    is_settled: bool,
}

/// A place, each coordinate in [0, 1], or anywhere on a circle.
#[derive(Debug, Clone)]
struct Place {
    at: Vec<f64>,
    found: Option<Found>,
}

struct Search<'a> {
    motor: &'a Motor,
    sought: &'a BestSearch,
    settings: &'a OperatingSettings,
    watch: &'a Watch<'a>,
    /// Why a motor could not be followed.
    failure: Option<Error>,
    /// Places on either side of a line.
    side: i32,
    /// [`narrow_peak`] of grid and scans.
    peak: f64,
    places: usize,
}

/// A line through the best place: along it the value and the quantities of the bounds, if they are smooth.
struct Line {
    best: f64,
    /// Between which values the optimum lies.
    top: [f64; 2],
    good: Option<[f64; 2]>,
    /// How much more a place beside the best one may bring.
    beside: f64,
}

impl Motor {
    /// The best of a quantity over one or two fields of the data sheet, under bounds on others. Where motions coexist, it is
    /// that of the first branch of a row.
    ///
    /// The items of `observer` are the places that are computed, at most.
    ///
    /// ```
    /// use bouncing_disk::core::Unobserved;
    /// use bouncing_disk::Motor;
    /// use bouncing_disk::motor::{BestSearch, MotorField, OperatingSettings, SearchRange, SweepQuantity};
    ///
    /// // The lag at which the paper's motor turns fastest.
    /// let turn = SearchRange { field: MotorField::PhaseLag, low: 0.0, high: std::f64::consts::TAU };
    /// let sought = BestSearch { objective: SweepQuantity::Speed, ranges: vec![turn], bounds: vec![] };
    /// let settings = OperatingSettings { relative_error: 0.05, ..OperatingSettings::default() };
    /// let best = Motor::paper_70_khz().best(&sought, &settings, &Unobserved)?;
    /// let from_to = best.values[0].good_from_to.expect("a smooth curve");
    /// assert!(from_to[0] < best.values[0].value.value && best.values[0].value.value < from_to[1]);
    /// # Ok::<(), bouncing_disk::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for illegal ranges, bounds and settings, and those of
    /// [`MotorParameters::build`](crate::motor::MotorParameters::build) at the ends of the ranges; [`Error::NotKept`] where no
    /// place keeps the bounds; [`Error::NotPositive`] where the quantity is nowhere positive, or not surely so; those of
    /// [`operations`](crate::motor::operations) where no motor can be followed.
    pub fn best(
        &self,
        sought: &BestSearch,
        settings: &OperatingSettings,
        observer: &dyn Observer,
    ) -> Result<Best, Error> {
        sought.check(self)?;
        settings.check()?;
        let stator = self.stator_motion();
        let is_dear = stator.yields();
        let (places, on_side, steps) = match stator {
            Stator::Sine => (CHEAP_PLACES, SIDE, STEPS),
            _ if is_dear => (DEAR_PLACES, DEAR_SIDE, DEAR_STEPS),
            _ => (PLACES, SIDE, STEPS),
        };
        let is_smooth = sought.ranges.len() == 1 && sought.leaves_height(self, 0)?;
        let side = places[sought.ranges.len() - 1];
        let side = if is_smooth { side.min(SMOOTH_PLACES) } else { side };
        let fields = sought.ranges.len();
        let coarse = side.pow(fields as u32);
        let on_line = LOOKS * (2 * LOOK + 3) as usize + (2 * on_side + 3) as usize;
        let around: usize = steps.iter().map(|steps| ((2 * steps + 1) as usize).pow(fields as u32)).sum();
        let scanned = if fields > 1 && matches!(stator, Stator::Sine) { 2 * CHEAP_PLACES[0] } else { 0 };
        let most = passes(settings.relative_error) * coarse + around + fields * on_line + 2 * scanned + 1;
        let watch = Watch::begin(observer, 0, most as u64)?;
        let mut search = Search {
            motor: self,
            sought,
            settings,
            watch: &watch,
            failure: None,
            side: on_side,
            peak: 0.0,
            places: 0,
        };
        let best = search.run(side, steps)?;
        watch.end();
        Ok(best)
    }
}

impl BestSearch {
    fn check(&self, motor: &Motor) -> Result<(), Error> {
        let axes: Vec<SweepAxis> = self
            .ranges
            .iter()
            .map(|range| SweepAxis::new(range.field, vec![range.low, range.high]))
            .collect();
        check_axes(&axes)?;
        check(self.bounds.len() <= 2, "number of bounds", self.bounds.len() as f64, "[0, 2]")?;
        for bound in &self.bounds {
            finite(bound.quantity.name(), bound.value)?;
        }
        for range in &self.ranges {
            check(range.low < range.high, "upper end of a range", range.high, "above its lower end")?;
        }
        let twists = motor.stator().is_some_and(|stator| stator.modes()[0].angle != 0.0);
        if twists && self.ranges.iter().any(|range| range.field == MotorField::PhaseLag) {
            let one = "a stator of the kind axial_twist";
            return Err(Error::BothGiven { one, other: "a phase lag to be found" });
        }
        for corner in [0.0, 1.0] {
            self.motor_at(motor, &vec![corner; self.ranges.len()])?;
        }
        Ok(())
    }

    /// Whether all motors along a field share one vertical motion.
    fn leaves_height(&self, motor: &Motor, field: usize) -> Result<bool, Error> {
        let end = |at: f64| {
            let mut own = vec![0.0; self.ranges.len()];
            own[field] = at;
            self.motor_at(motor, &own)
        };
        let (low, high) = (end(0.0)?, end(1.0)?);
        Ok(!motor.stator_motion().acts_back() && is_shared(low.system(), high.system()))
    }

    fn motor_at(&self, motor: &Motor, at: &[f64]) -> Result<Motor, Error> {
        let mut sheet = motor.parameters().clone();
        for (range, at) in self.ranges.iter().zip(at) {
            range.field.set(&mut sheet, range.value(*at));
        }
        sheet.build()
    }
}

impl OperatingSettings {
    /// The same with a share of the impacts.
    fn with_share(self, share: f64) -> Self {
        let most_impacts = (self.most_impacts as f64 * share).max(LEAST_IMPACTS) as u64;
        Self { most_impacts: most_impacts.min(self.most_impacts), ..self }
    }
}

impl SearchRange {
    fn value(&self, at: f64) -> f64 {
        self.low + (self.high - self.low) * at
    }

    /// Whether it is a whole turn, which has no ends.
    fn is_turn(&self) -> bool {
        self.field == MotorField::PhaseLag && self.high - self.low >= TAU * (1.0 - 1e-9)
    }
}

impl Found {
    fn of(sought: &BestSearch, operation: &Operation) -> Option<Self> {
        let known = |quantity: SweepQuantity| {
            quantity.of(operation).filter(|own| own.value.is_finite() && own.standard_error.is_finite())
        };
        let bounds = sought.bounds.iter().map(|bound| known(bound.quantity)).collect::<Option<_>>()?;
        let drifts = matches!(
            operation,
            Operation::Unsettled(_, Shortfall::Drift { .. } | Shortfall::PowerBalance { .. })
        );
        Some(Self { value: known(sought.objective)?, bounds, is_settled: !drifts })
    }

    /// The least margin of the bounds, in standard errors; how far a place keeps all of them.
    fn margin(&self, sought: &BestSearch) -> f64 {
        let own = sought.bounds.iter().zip(&self.bounds);
        let margins = own.map(|(bound, own)| {
            let margin = bound.margin(own.value);
            if own.standard_error > 0.0 {
                margin / own.standard_error
            } else {
                f64::INFINITY.copysign(margin)
            }
        });
        margins.fold(f64::INFINITY, f64::min)
    }

    /// The ends of its interval; open where it still drifts.
    fn at_least(&self) -> f64 {
        if self.is_settled {
            self.value.value - NORMAL_975 * self.value.standard_error
        } else {
            f64::NEG_INFINITY
        }
    }

    fn at_most(&self) -> f64 {
        if self.is_settled {
            self.value.value + NORMAL_975 * self.value.standard_error
        } else {
            f64::INFINITY
        }
    }
}

impl Search<'_> {
    fn run(&mut self, side: usize, steps: [i32; 2]) -> Result<Best, Error> {
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
            // The others need no further look.
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

    /// Goes along a whole field through the best place: motions lock on cycles in windows that a grid over two fields misses.
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

    /// A finer grid about a place.
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

    /// Computes some of the places.
    fn measure(&mut self, all: &mut [Place], which: &[usize], error: f64) -> Result<(), Error> {
        let mut settings = OperatingSettings { relative_error: error, ..*self.settings };
        if error >= ROUGH && self.motor.stator_motion().yields() {
            settings.members = settings.members.min(DEAR_MEMBERS);
        }
        // An error takes impacts as its inverse square: a place that needs more is not known better, and stays open.
        let share = (self.settings.relative_error / error).min(1.0);
        self.measure_with(all, which, &settings.with_share(share * share * SHARE_OF_PLACE))
    }

    fn measure_with(
        &mut self,
        all: &mut [Place],
        which: &[usize],
        settings: &OperatingSettings,
    ) -> Result<(), Error> {
        let motors = which.iter().map(|index| self.sought.motor_at(self.motor, &all[*index].at));
        // What is legal at the ends may not be between them, such as a quality below a half: no place.
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

    /// Which of the places may be the best.
    fn possible(&self, all: &[Place], open: Vec<usize>) -> Vec<usize> {
        let keeping = open.iter().filter_map(|index| all[*index].found.as_ref());
        let keeping = keeping.filter(|found| found.margin(self.sought) >= 1.0);
        let least = keeping.map(Found::at_least).fold(f64::NEG_INFINITY, f64::max);
        let may = |found: &Found| found.at_most() >= least && found.margin(self.sought) >= -NORMAL_975;
        let kept: Vec<usize> =
            open.iter().copied().filter(|index| all[*index].found.as_ref().is_some_and(&may)).collect();
        if kept.is_empty() { open } else { kept }
    }

    /// The best of the places that keep the bounds.
    fn best_of(&self, all: &[Place]) -> Result<usize, Error> {
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
                // All that there is still drifts.
                _ => Error::NotPositive { quantity: self.sought.objective.name(), value: found.value.value },
            });
        };
        // A speed that friction does not give is that of rounding.
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

    /// Looks along a field through the best place, and moves it to the top if the line is smooth.
    fn line(
        &mut self,
        place: &mut Place,
        field: usize,
        step: f64,
        all: &mut Vec<Place>,
    ) -> Result<Line, Error> {
        let range = self.sought.ranges[field];
        let along = |place: &Place, half: f64, side: i32| -> Vec<Place> {
            let offsets = (-side..=side).map(|k| half * f64::from(k) / f64::from(side));
            let ats = offsets.map(|offset| place.at[field] + offset);
            // The end of the range belongs to the line.
            let inside = |at: &f64| range.is_turn() || (0.0..=1.0).contains(at);
            let mut ats: Vec<f64> = ats.filter(inside).collect();
            for end in [0.0, 1.0] {
                if !range.is_turn() && (place.at[field] - end).abs() < half && !ats.contains(&end) {
                    ats.push(end);
                }
            }
            ats.sort_by(f64::total_cmp);
            let of = |at: f64| {
                let mut own = place.at.clone();
                own[field] = at;
                Place { at: own, found: None }
            };
            ats.into_iter().map(of).collect()
        };
        let (mut half, mut lengthened) = (2.0 * step, None);
        for _ in 0..LOOKS {
            let first = all.len();
            all.extend(along(place, half, LOOK));
            let new: Vec<usize> = (first..all.len()).collect();
            self.measure(all, &new, self.settings.relative_error)?;
            if let Ok(better) = self.best_of(&all[first..])
                && all[first + better].found.as_ref().map(|found| found.value.value)
                    > place.found.as_ref().map(|found| found.value.value)
            {
                *place = all[first + better].clone();
            }
            let near =
                new.iter().filter_map(|index| Some((all[*index].at[field], all[*index].found.as_ref()?)));
            // Of this look: an earlier value of the same place may be off by its error.
            let top = near.clone().fold(0.0, |most: f64, (_, found)| most.max(value(found)));
            let (good, bad): (Vec<_>, Vec<_>) = near.partition(|(_, found)| value(found) >= GOOD * top);
            let sides = [-1.0, 1.0].map(|sign| {
                let end = if sign < 0.0 { place.at[field] } else { 1.0 - place.at[field] };
                let has_end = !range.is_turn() && end < half;
                has_end || bad.iter().any(|(at, _)| sign * (at - place.at[field]) > 0.0)
            });
            let too_short = sides != [true; 2] && half < 0.5;
            let too_long = good.len() < LOOK as usize && half > step / LENGTHEN;
            // Where it is too long and then too short it is rough.
            if !(too_short || too_long) || lengthened == Some(!too_short) {
                break;
            }
            lengthened = Some(too_short);
            half = if too_short { (half * LENGTHEN).min(0.5) } else { half / LENGTHEN };
        }
        let first = all.len();
        all.extend(along(place, half, self.side));
        let new: Vec<usize> = (first..all.len()).collect();
        let relative_error = self.settings.relative_error / SURER;
        let settings = OperatingSettings { relative_error, ..*self.settings };
        let mut settings = settings.with_share(SHARE_OF_PLACE);
        // One motion for the whole line becomes eight.
        if self.sought.leaves_height(self.motor, field)? {
            settings.relative_error = (relative_error * (SEEDS as f64 / SHARED).sqrt()).min(LARGEST_ERROR);
        }
        for seed in 0..SEEDS {
            let own: Vec<usize> = new.iter().copied().skip(seed).step_by(SEEDS).collect();
            settings.seed = self.settings.seed.wrapping_add(1 + seed as u64);
            self.measure_with(all, &own, &settings)?;
        }
        let known: Vec<(f64, &Found)> = new
            .iter()
            .filter_map(|index| {
                Some(((all[*index].at[field] - place.at[field]) / half, all[*index].found.as_ref()?))
            })
            .collect();
        if known.len() == new.len() {
            let exact = self.exact_line(place, field, half, &known);
            if let Some(line) = exact.or_else(|| self.smooth_line(place, field, half, &known)) {
                return Ok(line);
            }
        }
        Ok(self.rough_line(place, field, half, &known, all))
    }

    /// The line through a place where values are so well known that they say top and range by themselves, even across a kink;
    /// moves the place to the best of them. `None` where bounds part the line: their places lie between.
    fn exact_line(
        &self,
        place: &mut Place,
        field: usize,
        half: f64,
        known: &[(f64, &Found)],
    ) -> Option<Line> {
        let (top, best) = known
            .iter()
            .enumerate()
            .max_by(|(_, one), (_, other)| value(one.1).total_cmp(&value(other.1)))?;
        let largest = known.iter().map(|(_, found)| found.value.standard_error).fold(0.0, f64::max);
        let keeps = |own: &(f64, &Found)| own.1.is_settled && own.1.margin(self.sought) >= 1.0;
        if largest > EXACT * value(best.1) || !known.iter().all(keeps) {
            return None;
        }
        let is_good = |own: &&(f64, &Found)| own.1.at_least() >= GOOD * best.1.at_most();
        let up = known[top..].iter().take_while(is_good).last().unwrap_or(best);
        let down = known[..=top].iter().rev().take_while(is_good).last().unwrap_or(best);
        let beside = [known[top.saturating_sub(1)], known[(top + 1).min(known.len() - 1)]];
        let (middle, error) = (place.at[field], 0.5 * half * (beside[1].0 - beside[0].0) / NORMAL_975);
        let at = |own: &(f64, &Found)| middle + half * own.0;
        place.at[field] = at(best);
        // The slope on the lower side bounds how high a kink between two places rises.
        let beside = value(best.1) - value(beside[0].1).min(value(beside[1].1));
        let (best, good) = (at(best), Some([at(down), at(up)]));
        Some(Line { best, top: [best - error, best + error], good, beside })
    }

    /// The line through a place where a cubic explains its values at offsets in [-1, 1]; moves the place to its top. The jackknife
    /// over the seeds gives the errors of top and ends.
    fn smooth_line(
        &self,
        place: &mut Place,
        field: usize,
        half: f64,
        known: &[(f64, &Found)],
    ) -> Option<Line> {
        let best = known.iter().map(|(_, found)| value(found)).fold(0.0, f64::max);
        let squares: f64 =
            known.iter().map(|(_, found)| found.value.standard_error * found.value.standard_error).sum();
        let explained = EXPLAINED * (squares / known.len() as f64).sqrt();
        let whole = Cubic::of(known.iter().copied(), value).filter(|cubic| {
            known.len() >= LEAST
                && cubic.scatter <= explained.max(ROUGHEST * best)
                && cubic.largest <= OUTLIER * cubic.scatter.max(1e-12 * best)
        })?;
        // A cubic describes the line well near its top only.
        let is_near = |(x, _): &(f64, &Found)| whole.at(*x) >= NEAR * best;
        let takes_near = known.iter().filter(|own| is_near(own)).count() >= LEAST;
        let own = known.iter().copied().enumerate().filter(|(_, own)| !takes_near || is_near(own));
        let own: Vec<(usize, (f64, &Found))> = own.collect();
        let middle = place.at[field];
        let Some([top, low, high]) = self.top_and_ends(&own, |_| true)? else {
            let part = half / f64::from(self.side);
            return Some(Line { best: middle, top: [middle - part, middle + part], good: None, beside: 0.0 });
        };
        let without = (0..SEEDS).map(|seed| self.top_and_ends(&own, |index| index % SEEDS != seed));
        let without = without.collect::<Option<Option<Vec<[f64; 3]>>>>()?;
        let errors = without.map(|without| [0, 1, 2].map(|which| jackknife(&without, which)));
        let at = |x: f64| middle + half * x;
        let best = at(top);
        place.at[field] = best;
        let Some([top, at_low, at_high]) = errors else {
            return Some(Line { best, top: [at(-1.0), at(1.0)], good: None, beside: 0.0 });
        };
        let good = [at(low + NORMAL_975 * at_low), at(high - NORMAL_975 * at_high)];
        let good = (good[0] <= best && best <= good[1]).then_some(good);
        Some(Line { best, top: [best - half * top, best + half * top], good, beside: 0.0 })
    }

    /// Where the cubic through some places has its top within the bounds, and between which offsets it is good; `None` within
    /// where it keeps the bounds nowhere, and where there are too few places.
    fn top_and_ends(
        &self,
        places: &[(usize, (f64, &Found))],
        is_of: impl Fn(usize) -> bool,
    ) -> Option<Option<[f64; 3]>> {
        let own = || places.iter().filter(|(index, _)| is_of(*index)).map(|(_, own)| *own);
        let cubic = Cubic::of(own(), value)?;
        let bounds = (0..self.sought.bounds.len())
            .map(|bound| Cubic::of(own(), |found| found.bounds[bound].value))
            .collect::<Option<Vec<Cubic>>>()?;
        let keeps = |x: f64| {
            let own = self.sought.bounds.iter().zip(&bounds);
            own.into_iter().all(|(bound, cubic)| bound.margin(cubic.at(x)) >= 0.0)
        };
        let [low, high] = [places[0].1.0, places[places.len() - 1].1.0];
        let x = |k: i32| low + (high - low) * f64::from(k) / f64::from(FINE);
        let keeping = (0..=FINE).filter(|k| keeps(x(*k)));
        let top = keeping.max_by(|one, other| cubic.at(x(*one)).total_cmp(&cubic.at(x(*other))));
        Some(top.map(|top| {
            let least = GOOD * cubic.at(x(top));
            let is_good = |k: &i32| cubic.at(x(*k)) >= least && keeps(x(*k));
            let up = (top..=FINE).take_while(is_good).last().unwrap_or(top);
            let down = (0..=top).rev().take_while(is_good).last().unwrap_or(top);
            [top, down, up].map(x)
        }))
    }

    /// The line through a place where values jump, by the places on it that may be as good.
    fn rough_line(
        &self,
        place: &Place,
        field: usize,
        half: f64,
        known: &[(f64, &Found)],
        all: &[Place],
    ) -> Line {
        let (middle, part) = (place.at[field], half / f64::from(self.side));
        let best = known.iter().map(|(_, found)| found.value.value).fold(0.0, f64::max);
        let scatter = Cubic::of(known.iter().copied(), value).map_or(0.0, |cubic| cubic.scatter);
        let least = place.found.as_ref().map_or(f64::NEG_INFINITY, Found::at_least);
        let may = all.iter().filter(|own| {
            let beside = own.at.iter().zip(&place.at).enumerate();
            let is_on_line =
                beside.into_iter().all(|(index, (own, best))| index == field || own.total_cmp(best).is_eq());
            is_on_line && own.found.as_ref().is_some_and(|found| found.at_most() >= least)
        });
        let top = may.fold([middle - part, middle + part], |[low, high], own| {
            [low.min(own.at[field]), high.max(own.at[field])]
        });
        Line { best: middle, top, good: None, beside: NORMAL_975 * scatter.min(best) }
    }

    /// The value at the best place, with other perturbations.
    fn result(&mut self, place: &Place, lines: &[Line], all: &[Place]) -> Result<Best, Error> {
        let motor = self.sought.motor_at(self.motor, &place.at)?;
        let settings =
            OperatingSettings { seed: self.settings.seed.wrapping_add(1 + SEEDS as u64), ..*self.settings };
        // As many as motors.
        let row = operations_in_groups(&[motor], &settings, self.watch)?.swap_remove(0)?;
        let Some(found) = Found::of(self.sought, row.operation()) else {
            return Err(Error::NotPositive { quantity: self.sought.objective.name(), value: f64::NAN });
        };
        // What surely was better elsewhere, within the bounds as far as they are known.
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
        Ok(Best { values: values.collect(), value, row, bounds: found.bounds, places: self.places })
    }
}

fn value(found: &Found) -> f64 {
    found.value.value
}

/// The standard error of one of three numbers, each computed without each of [`SEEDS`] in turn, as large as few seeds make it.
fn jackknife(without: &[[f64; 3]], which: usize) -> f64 {
    let count = without.len() as f64;
    let mean = without.iter().map(|own| own[which]).sum::<f64>() / count;
    let squares: f64 = without.iter().map(|own| (own[which] - mean) * (own[which] - mean)).sum();
    (squares * (count - 1.0) / count).sqrt() * student_quantile(count - 1.0) / NORMAL_975
}

/// By how much a place surely exceeds the two beside it along a field, beyond what these fall on: the height of a peak that is
/// narrower than the grid, as of a locked motion. Others like it may lie between the places.
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
            // A smooth top falls off ever faster.
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

/// Passes over the first grid until its errors are these.
fn passes(wanted: f64) -> usize {
    let mut error = wanted.max(ROUGH);
    let mut passes = 1;
    while error > wanted {
        error = (error / FINER).max(wanted);
        passes += 1;
    }
    passes
}

#[cfg(test)]
mod tests;
