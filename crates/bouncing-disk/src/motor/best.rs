//! Optimises a quantity over one or two fields of a data sheet, within bounds on other quantities.
//!
//! A grid of points is computed roughly; candidates for the best one are computed again with smaller errors,
//! and finer grids surround the best one. Lines of points through the best one determine the position and the
//! width of the optimum. The value is measured there, with perturbations other than those that selected the
//! point. See docs/numerics-dynamics.md, "Optimisation of a quantity".
//!
//! Eight seeds alternate along a line, because points of one seed may share a vertical motion and its errors.
//! Each end of the range within 1 % is moved inwards by its 95 % error, from a jackknife over the seeds with
//! Student's quantile. The stated error is enlarged by the possible misses of the search: 1.96 times the
//! scatter of a line too rough for a cubic, and the height of a peak narrower than the grid. This height is
//! the excess of a point over its two neighbours, beyond their errors and their difference from the next
//! points. For two fields with rigid impacts on a sine, 400 points along each field that changes the vertical
//! motion show such peaks.

mod cubic;
mod line;
mod search;

use std::f64::consts::TAU;
use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use bouncing_disk_core::Observer;
use bouncing_disk_core::numerics::statistics::NORMAL_975;
use bouncing_disk_core::run::Watch;

use self::search::passes;
use crate::error::{Error, check, finite};
use crate::motor::batch::shared_orbit::is_shared;
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::motor_field::MotorField;
use crate::motor::operation::point::{Estimate, OperatingRow, Operation, Shortfall};
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::parameter_sweep::axis::{SweepAxis, check_axes};
use crate::motor::parameter_sweep::quantity::SweepQuantity;
use crate::motor::stator::Stator;

/// Number of points along a single field, and along each of two fields. The first pair is for rigid impacts
/// on a sine, with milliseconds per point; then follow other motors, and compliant stators, with a tenth of a
/// second or more per point.
const CHEAP_PLACES: [usize; 2] = [400, 32];
const PLACES: [usize; 2] = [200, 16];
const DEAR_PLACES: [usize; 2] = [64, 8];

/// Number of points along a field that does not affect the vertical motion, such as load or lag: no motion
/// locks between them.
const SMOOTH_PLACES: usize = 64;

/// Finer grids about the best point: the ratio of each step to the next, and the numbers of steps on either
/// side. For a compliant stator the second grid has fewer steps.
const PARTS: f64 = 3.0;
const STEPS: [i32; 2] = [2, 2];
const DEAR_STEPS: [i32; 2] = [2, 1];

/// Number of points on either side along a line, for a first pass and for the fit, and the factor by which
/// the fitted values are more accurate than requested.
const LOOK: i32 = 4;
const SIDE: i32 = 16;
const DEAR_SIDE: i32 = 8;
const SURER: f64 = 2.0;

/// Seeds that alternate along a line, because points of one seed may share a vertical motion and its errors.
/// If they do, all seeds together use `SHARED` times the impacts of a point with its own motion.
const SEEDS: usize = 8;
const SHARED: f64 = 2.0;

/// Largest number of passes along one line, each with a different length, and the ratio of successive
/// lengths.
const LOOKS: usize = 6;
const LENGTHEN: f64 = 3.0;

/// A range of a field that is searched.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SearchRange {
    /// The field of the data sheet.
    pub field: MotorField,
    /// Its least value, in the unit of the field. A phase lag that varies over a whole turn has no ends.
    pub low: f64,
    /// Its largest value.
    pub high: f64,
}

/// A bound that an optimum has to satisfy.
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
    /// Whether the bound is a lower one; otherwise it is an upper one.
    pub is_least: bool,
    /// The bound, in the unit of the quantity.
    pub value: f64,
}

impl QuantityBound {
    /// Whether an operation satisfies the bound; `None` if its quantity is unknown.
    #[must_use]
    pub fn is_kept(&self, operation: &Operation) -> Option<bool> {
        Some(self.margin(self.quantity.of(operation)?.value) >= 0.0)
    }

    /// The margin by which a value satisfies the bound; negative if it violates it.
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
            format!(
                "{text:?} is not a bound; write QUANTITY >= NUMBER or QUANTITY <= NUMBER, such as speed >= 5"
            )
        };
        let signs = [(">=", true), ("<=", false)];
        let parts = signs.iter().find_map(|(sign, is_least)| Some((text.split_once(sign)?, *is_least)));
        let ((name, value), is_least) = parts.ok_or_else(form)?;
        let value = value.trim().parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(form)?;
        Ok(Self { quantity: name.parse()?, is_least, value })
    }
}

/// The quantity to be optimised, with ranges and bounds.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BestSearch {
    /// The quantity to be maximised.
    pub objective: SweepQuantity,
    /// The one or two fields that may vary. Everything else is taken from the data sheet.
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
    /// The range around this value, with the other field at its optimum, in which the quantity is at least 99
    /// % of its best value and the bounds are satisfied. `None` if the curve is too rough to tell, as near a
    /// locked motion. The range of a phase lag may extend beyond the circle.
    pub good_from_to: Option<[f64; 2]>,
    /// Whether the optimum lies at an end of the searched range.
    pub is_at_end: bool,
}

/// An optimum of a quantity.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Best {
    /// The fields, in the order of the ranges.
    pub values: Vec<BestValue>,
    /// The quantity, measured at this point. Its error includes the possible gain at a better point nearby.
    pub value: Estimate,
    /// The motor in operation there.
    pub row: OperatingRow,
    /// The branch of the row to which the value refers. If motions coexist, the branch of another motion may
    /// come first.
    pub branch: usize,
    /// The quantities of the bounds, in the order of the bounds.
    pub bounds: Vec<Estimate>,
    /// Number of points that were computed.
    pub places: usize,
}

/// The known results at a point.
#[derive(Debug, Clone)]
struct Found {
    value: Estimate,
    bounds: Vec<Estimate>,
    /// Whether the result no longer drifts, so that its errors are valid.
    is_settled: bool,
}

/// A point, with each coordinate in [0, 1], or unbounded for a whole turn.
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
    /// Number of points on either side along a line.
    side: i32,
    /// [`narrow_peak`] from the grid and scans.
    peak: f64,
    places: usize,
}

impl Motor {
    /// The best value of a quantity over one or two fields of the data sheet, under bounds on other
    /// quantities. If motions coexist, a point is judged by the first branch of its row; the reported value
    /// belongs to the same motion.
    ///
    /// The observer's items are the points that may be computed.
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
    /// [`Error::OutOfRange`] for illegal ranges, bounds and settings, and the errors of
    /// [`MotorParameters::build`](crate::motor::MotorParameters::build) at the ends of the ranges;
    /// [`Error::NotKept`] if no point satisfies the bounds; [`Error::NotPositive`] if the quantity is nowhere
    /// positive, or not certain to be positive; the errors of [`operations`](crate::motor::operations) if no
    /// motor can be followed.
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
            let one = "a stator of kind axial_twist";
            return Err(Error::BothGiven { one, other: "a search for phase_lag" });
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

impl SearchRange {
    fn value(&self, at: f64) -> f64 {
        self.low + (self.high - self.low) * at
    }

    /// Whether the range is a whole turn, which has no ends.
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

    /// The least margin of the bounds, in standard errors.
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

    /// The lower end of the value's 95 % interval; infinite while the value still drifts.
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

fn value(found: &Found) -> f64 {
    found.value.value
}

#[cfg(test)]
mod tests;
