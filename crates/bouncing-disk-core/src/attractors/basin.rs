//! Basins of attraction of the impact map on a grid of impact phases and speeds.

pub(crate) mod boundary;
pub(crate) mod entropy;
mod labels;
mod lockstep;
mod screen;
mod starts;

use core::f64::consts::TAU;

use core::ops::Range;

use crate::chatter::policy::ChatterPolicy;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::{Error, within};
use crate::numerics::fraction::Fraction;
use crate::numerics::stored::read_checked;
use crate::orbits::periodic::PeriodicOrbit;
use crate::run::Observer;
use crate::sweep::SweepEvent;
use crate::sweep::bouncing_map::{BouncingMap, BouncingOrbit as _};

/// The fate of a start, in one byte.
pub type Label = u8;
/// Neither at rest nor near a known orbit after the allowed number of impacts: undecided, or on a chaotic
/// attractor.
pub const UNDECIDED: Label = 0;
/// The disk came to rest on the platform: the basin of the chattering orbit.
pub const ATTACHED: Label = 1;
/// The first known periodic orbit; the labels of the next ones count up from here.
pub const FIRST_ORBIT: Label = 2;

/// Largest number of cells of one grid.
pub const MAX_CELLS: u64 = 1 << 31;

/// Largest number of known orbits that labels can distinguish.
const MAX_KNOWN: f64 = 250.0;

/// One axis of a grid: `cells` cells of equal width from `low` to `high`, each represented by its centre.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedAxis"))]
pub struct Axis {
    low: f64,
    high: f64,
    cells: usize,
}

impl Axis {
    /// An axis from `low` up to `high`, with 1 to 100 000 cells.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an empty, reversed or non-finite axis, or one whose length overflows.
    pub fn new(low: f64, high: f64, cells: usize) -> Result<Self, Error> {
        within("axis low end", low, f64::MIN, f64::MAX, "finite")?;
        if !(high > low && (high - low).is_finite()) {
            return Err(Error::OutOfRange {
                field: "axis high end",
                value: high,
                legal: "above the low end, and less than 1.8e308 above it",
            });
        }
        within("axis cells", cells as f64, 1.0, 100_000.0, "[1, 100000]")?;
        Ok(Self { low, high, cells })
    }

    /// Low end.
    #[must_use]
    pub const fn low(&self) -> f64 {
        self.low
    }

    /// High end.
    #[must_use]
    pub const fn high(&self) -> f64 {
        self.high
    }

    /// Number of cells.
    #[must_use]
    pub const fn cells(&self) -> usize {
        self.cells
    }

    /// Centre of cell `index`; for an index beyond the last cell, the centre of the last.
    #[must_use]
    pub fn centre(&self, index: usize) -> f64 {
        let index = index.min(self.cells - 1);
        self.low + (self.high - self.low) * ((index as f64 + 0.5) / self.cells as f64)
    }
}

read_checked!(Axis as UncheckedAxis { low: f64, high: f64, cells: usize } => Axis::new);

/// A grid of starts: impact phase in periods (tau_imp/2 pi) and normalised impact speed |w_A Gamma/(omega
/// A)|.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedGrid"))]
pub struct Grid {
    phase: Axis,
    speed: Axis,
}

impl Grid {
    /// Largest number of periods, of either sign, on the phase axis: beyond it a double cannot resolve half a
    /// period.
    pub const MAX_PERIODS: f64 = 4_503_599_627_370_496.0;

    /// Largest normalised speed on the speed axis: no flight is this fast, and its square is far from
    /// overflow.
    pub const MAX_SPEED: f64 = 1.0e100;

    /// A grid of impact phases in periods, within [`Self::MAX_PERIODS`] of zero, and normalised impact speeds
    /// in [0, [`Self::MAX_SPEED`]].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an axis outside these ranges.
    pub fn new(phase: Axis, speed: Axis) -> Result<Self, Error> {
        for end in [phase.low(), phase.high()] {
            within(
                "impact phase",
                end,
                -Self::MAX_PERIODS,
                Self::MAX_PERIODS,
                "[-4.5e15, 4.5e15] (periods)",
            )?;
        }
        within("lowest normalised speed", speed.low(), 0.0, Self::MAX_SPEED, "[0, 1e100]")?;
        within("highest normalised speed", speed.high(), 0.0, Self::MAX_SPEED, "[0, 1e100]")?;
        Ok(Self { phase, speed })
    }

    /// Impact phase (rad) of the cells of a column, in [0, 2 pi]: whole periods are removed without rounding.
    #[must_use]
    pub fn impact_angle(&self, column: usize) -> f64 {
        let cycles = self.phase.centre(column);
        (cycles - cycles.floor()) * TAU
    }

    /// Impact phase in periods.
    #[must_use]
    pub const fn phase(&self) -> &Axis {
        &self.phase
    }

    /// Normalised impact speed |w|/pi.
    #[must_use]
    pub const fn speed(&self) -> &Axis {
        &self.speed
    }
}

read_checked!(Grid as UncheckedGrid { phase: Axis, speed: Axis } => Grid::new);

/// An attracting periodic orbit and the radius within which a start counts as captured.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedKnownOrbit"))]
pub struct KnownOrbit {
    orbit: PeriodicOrbit,
    radius: f64,
}

read_checked!(KnownOrbit as UncheckedKnownOrbit { orbit: PeriodicOrbit, radius: f64 } => KnownOrbit::new);

impl KnownOrbit {
    /// An orbit with its capture `radius` in radians (a radian counts as much as the speed P): see
    /// [`PeriodicOrbit::trapping_radius`].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a negative or non-finite radius; errors of [`ImpactMap::refine`] for an
    /// orbit that it would not return: no impacts or too many, at rest, no period of the platform.
    pub fn new(orbit: PeriodicOrbit, radius: f64) -> Result<Self, Error> {
        within("attraction radius", radius, 0.0, f64::MAX, "[0, inf) (rad)")?;
        orbit.check()?;
        Ok(Self { orbit, radius })
    }

    /// The orbit.
    #[must_use]
    pub const fn orbit(&self) -> &PeriodicOrbit {
        &self.orbit
    }

    /// The radius in radians.
    #[must_use]
    pub const fn radius(&self) -> f64 {
        self.radius
    }
}

/// The label of the first known orbit whose radius contains the impact; speeds are in units of `scale`.
pub(super) fn caught(known: &[KnownOrbit], state: ImpactState, scale: f64) -> Option<Label> {
    let index = known.iter().position(|known| known.orbit.distance(state, scale) <= known.radius)?;
    Some(FIRST_ORBIT + index as Label)
}

/// The label of a start with an impact in `state`, if this impact decides it: near a known orbit, or (under
/// the complete policy) certain to chatter to rest.
pub(super) fn settles(
    map: &impl BouncingMap,
    state: ImpactState,
    known: &[KnownOrbit],
    policy: ChatterPolicy,
) -> Option<Label> {
    let rests = || policy == ChatterPolicy::Complete && map.chatters_to_rest_after(state);
    caught(known, state, map.speed_scale()).or_else(|| rests().then_some(ATTACHED))
}

/// The label of a start; `follow` is called before each flight.
///
/// # Errors
/// Errors of a flight and of `follow`.
pub(super) fn label_of_start(
    map: &impl BouncingMap,
    start: ImpactState,
    known: &[KnownOrbit],
    settings: BasinSettings,
    mut follow: impl FnMut() -> Result<(), Error>,
) -> Result<Label, Error> {
    if let Some(label) = settles(map, start, known, settings.policy) {
        return Ok(label);
    }
    let mut orbit = map.orbit(start, settings.policy);
    for _ in 0..settings.max_impacts {
        follow()?;
        match orbit.next_event()? {
            Some(SweepEvent::Impact(impact)) => {
                if let Some(label) = settles(map, impact.state, known, settings.policy) {
                    return Ok(label);
                }
            }
            Some(_) | None => return Ok(ATTACHED),
        }
    }
    Ok(UNDECIDED)
}

/// Checks that labels can distinguish all known orbits.
pub(crate) fn check_number_of(known: &[KnownOrbit]) -> Result<(), Error> {
    within("number of known orbits", known.len() as f64, 0.0, MAX_KNOWN, "[0, 250]").map(|_| ())
}

/// Checks the number of known orbits, and that they belong to this map.
pub(super) fn check_known(
    known: &[KnownOrbit],
    check_orbit: impl Fn(&PeriodicOrbit) -> Result<(), Error>,
) -> Result<(), Error> {
    check_number_of(known)?;
    known.iter().try_for_each(|known| check_orbit(&known.orbit))
}

/// Checks that there are rows, and that the grid contains them.
pub(super) fn check_rows(grid: Grid, rows: &Range<usize>) -> Result<(), Error> {
    let refuse = |what, found: usize, expected: usize| {
        Err(Error::Unfitting { what, found: found as u64, expected: expected as u64 })
    };
    let height = grid.speed().cells();
    if rows.end > height {
        return refuse("end of the rows of a grid", rows.end, height);
    }
    if rows.start >= rows.end {
        return refuse("first row of rows of a grid", rows.start, rows.end.saturating_sub(1));
    }
    Ok(())
}

/// The settings that limit how long a start is followed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct BasinSettings {
    /// Impacts after which a start is left [`UNDECIDED`].
    pub max_impacts: u32,
    /// The policy that ends a chattering sequence.
    pub policy: ChatterPolicy,
}

impl Default for BasinSettings {
    fn default() -> Self {
        Self { max_impacts: 2_000, policy: ChatterPolicy::Complete }
    }
}

/// Labels of a grid, row by row: rows by rising speed, cells in a row by rising phase.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Basins {
    labels: Vec<Label>,
    columns: usize,
}

impl Basins {
    /// Checks deserialised basins: at least one row, only whole rows, and labels that orbits can have.
    fn check(&self) -> Result<(), Error> {
        let Self { labels, columns } = self;
        within("columns of basins", *columns as f64, 1.0, 100_000.0, "[1, 100000]")?;
        let rows = labels.len().div_ceil(*columns).max(1);
        if labels.len() != rows * columns {
            let (found, expected) = (labels.len() as u64, (rows * columns) as u64);
            return Err(Error::Unfitting { what: "labels of basins", found, expected });
        }
        let most = f64::from(FIRST_ORBIT) + MAX_KNOWN - 1.0;
        let largest = labels.iter().max().copied().unwrap_or(UNDECIDED);
        within("label of basins", largest.into(), 0.0, most, "[0, 251]")?;
        Ok(())
    }

    /// Basins of at least one whole row of labels from another source, such as an array in another program.
    /// Measuring a boundary needs only labels.
    ///
    /// ```
    /// use bouncing_disk_core::attractors::{ATTACHED, Basins, FIRST_ORBIT};
    ///
    /// let basins = Basins::of_labels(vec![ATTACHED, ATTACHED, ATTACHED, FIRST_ORBIT], 2)?;
    /// assert_eq!(basins.entropy(2)?.boundary_boxes, 1);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a number of columns outside [1, 100000] and for a label that no orbit can
    /// have; [`Error::Unfitting`] for an incomplete row.
    pub fn of_labels(labels: Vec<Label>, columns: usize) -> Result<Self, Error> {
        let basins = Self { labels, columns };
        basins.check().map(|()| basins)
    }

    /// The basins of grids stacked on one another, slowest starts first: their rows in sequence.
    ///
    /// # Errors
    /// [`Error::Unfitting`] if the numbers of columns differ, or there are no basins; [`Error::TooLarge`] for
    /// more than [`MAX_CELLS`] cells.
    pub fn stacked(parts: impl IntoIterator<Item = Self>) -> Result<Self, Error> {
        let mut parts = parts.into_iter();
        let Some(mut whole) = parts.next() else {
            return Err(Error::Unfitting { what: "parts of basins", found: 0, expected: 1 });
        };
        for part in parts {
            if part.columns != whole.columns {
                let (found, expected) = (part.columns as u64, whole.columns as u64);
                return Err(Error::Unfitting { what: "columns of a part of basins", found, expected });
            }
            let count = whole.labels.len() as u64 + part.labels.len() as u64;
            if count > MAX_CELLS {
                return Err(Error::TooLarge { what: "cells of basins", count, limit: MAX_CELLS });
            }
            whole.labels.extend(part.labels);
        }
        Ok(whole)
    }

    /// Number of columns: cells along the phase.
    #[must_use]
    pub const fn columns(&self) -> usize {
        self.columns
    }

    /// Number of rows: cells along the speed.
    #[must_use]
    pub const fn rows(&self) -> usize {
        self.labels.len() / self.columns
    }

    /// All labels: `phase.cells()` per row, rows by rising speed.
    #[must_use]
    pub fn labels(&self) -> &[Label] {
        &self.labels
    }

    /// The labels of one row.
    ///
    /// Empty if there is no such row.
    #[must_use]
    pub fn row(&self, index: usize) -> &[Label] {
        self.labels.chunks_exact(self.columns).nth(index).unwrap_or(&[])
    }

    /// The share of cells with this label.
    #[must_use]
    pub fn fraction(&self, label: Label) -> f64 {
        self.labels.iter().filter(|&&own| own == label).count() as f64 / self.labels.len() as f64
    }

    /// The number of cells with this label, with the confidence interval that a random sample of this size
    /// would have for the share. For [`UNDECIDED`] these are the cells without a known fate.
    ///
    /// The cells of a grid are spread more evenly than a random sample: the error of the share is at most
    /// about half the share of the boundary cells, and mostly far less.
    #[must_use]
    pub fn share(&self, label: Label) -> Fraction {
        let count = self.labels.iter().filter(|&&own| own == label).count() as u64;
        let of = self.labels.len() as u64;
        Fraction::new(count, of).unwrap_or_default()
    }
}

impl ImpactMap {
    /// The label of one start: [`ATTACHED`], the index of a known orbit + [`FIRST_ORBIT`], or [`UNDECIDED`].
    ///
    /// This call is for loops over starts. Unlike [`Self::basins`] it does not check that the known orbits
    /// belong to this map: see [`Self::check_orbit`].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for more than 250 known orbits; errors of [`crate::Vibration::first_impact`].
    pub fn basin_label(
        &self,
        start: ImpactState,
        known: &[KnownOrbit],
        settings: BasinSettings,
    ) -> Result<Label, Error> {
        check_number_of(known)?;
        label_of_start(self, start, known, settings, || Ok(()))
    }

    /// The basins on a grid.
    ///
    /// The labels do not depend on the number of threads.
    ///
    /// The items of `observer` are the rows.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for more than 250 known orbits; [`Error::NotAnOrbit`] for an orbit of another
    /// map; [`Error::TooLarge`] for a grid of more than [`MAX_CELLS`] cells or too large for the memory;
    /// errors of [`crate::Vibration::first_impact`].
    pub fn basins(
        &self,
        grid: Grid,
        known: &[KnownOrbit],
        settings: BasinSettings,
        observer: &dyn Observer,
    ) -> Result<Basins, Error> {
        let labels = self.labels_of_rows(grid, 0..grid.speed().cells(), known, settings, observer)?;
        Ok(Basins { columns: grid.phase().cells(), labels })
    }
}

/// Impacts of known orbits with which a state can be compared in about the time of a flight.
const TARGETS_OF_FLIGHT: usize = 8;

/// The work of a flight and of comparing its impact with the known orbits, in units of an observer.
pub(super) fn flights_of_label(known: &[KnownOrbit]) -> u64 {
    let impacts: usize = known.iter().map(|known| known.orbit.period()).sum();
    1 + (impacts / TARGETS_OF_FLIGHT) as u64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flight::platform::vibration::Vibration;
    use crate::run::Unobserved;

    fn map() -> ImpactMap {
        ImpactMap::new(Vibration::from_axial_forcing(0.45).expect("legal"), 0.5).expect("legal")
    }

    fn orbit() -> PeriodicOrbit {
        map().refine(&[map().period_one(1).expect("exists")]).expect("refines")
    }

    fn axis(low: f64, high: f64, cells: usize) -> Axis {
        Axis::new(low, high, cells).expect("legal")
    }

    fn refused<T: std::fmt::Debug>(result: Result<T, Error>, name: &str) {
        let error = result.expect_err(name);
        assert!(matches!(error, Error::OutOfRange { field, .. } if field == name), "{error}");
    }

    #[cfg(feature = "serde")]
    #[test]
    fn an_axis_that_is_read_is_as_legal_as_one_that_is_made() {
        let own = axis(-1.0, 3.0, 5);
        let text = serde_json::to_string(&own).expect("writes");
        assert_eq!(serde_json::from_str::<Axis>(&text).expect("legal"), own);
        for (text, complaint) in [
            (r#"{"low":0.0,"high":1.0,"cells":0}"#, "axis cells = 0"),
            (r#"{"low":0.0,"high":1.0,"cells":18446744073709551615}"#, "axis cells"),
            (r#"{"low":1.0,"high":0.0,"cells":5}"#, "axis high end = 0"),
            (r#"{"low":0.0,"high":1.0,"cells":5,"sells":6}"#, "sells"),
        ] {
            let error = serde_json::from_str::<Axis>(text).expect_err(text).to_string();
            assert!(error.contains(complaint), "{error}");
        }
    }

    #[cfg(feature = "serde")]
    #[test]
    fn a_grid_that_is_read_is_as_legal_as_one_that_is_made() {
        let own = Grid::new(axis(0.0, 1.0, 5), axis(0.0, 2.0, 6)).expect("legal");
        let text = serde_json::to_string(&own).expect("writes");
        assert_eq!(serde_json::from_str::<Grid>(&text).expect("legal"), own);
        let negative = text.replace(r#""low":0.0,"high":2.0"#, r#""low":-2.0,"high":2.0"#);
        let error = serde_json::from_str::<Grid>(&negative).expect_err("negative").to_string();
        assert!(error.contains("lowest normalised speed = -2"), "{error}");
        let misspelt = text.replace("speed", "sped");
        assert!(serde_json::from_str::<Grid>(&misspelt).expect_err("misspelt").to_string().contains("sped"));
    }

    #[cfg(feature = "serde")]
    #[test]
    fn settings_with_a_misspelt_key_are_refused() {
        let text = r#"{"max_impacts":7,"policy":"Complete","polcy":"Complete"}"#;
        assert!(
            serde_json::from_str::<BasinSettings>(text)
                .is_err_and(|error| error.to_string().contains("polcy"))
        );
    }

    #[test]
    fn every_cell_has_a_finite_centre() {
        refused(Axis::new(f64::MIN, f64::MAX, 3), "axis high end");
        let widest = axis(-0.5 * f64::MAX, 0.49 * f64::MAX, 3);
        for index in [0, 1, 2, 3, usize::MAX] {
            assert!(widest.centre(index).is_finite(), "{index}");
        }
        assert_eq!(axis(0.0, 1.0, 4).centre(usize::MAX).to_bits(), 0.875_f64.to_bits());
    }

    /// On such axes phases would have no fraction of a period, or speeds would be infinite in the units of
    /// the map.
    #[test]
    fn axes_beyond_what_phases_and_speeds_can_hold_are_no_grid() {
        let ordinary = axis(0.0, 1.0, 3);
        refused(Grid::new(axis(0.0, 1e300, 3), ordinary), "impact phase");
        refused(Grid::new(axis(-1e16, 1.0, 3), ordinary), "impact phase");
        refused(Grid::new(ordinary, axis(0.0, 1.7e308, 3)), "highest normalised speed");
        refused(Grid::new(ordinary, axis(-1.0, 1.0, 3)), "lowest normalised speed");
        // Too fast for a flight: an error, not a panic.
        let fast = Grid::new(ordinary, axis(0.0, Grid::MAX_SPEED, 3)).expect("legal");
        for policy in [ChatterPolicy::Complete, crate::chatter::policy::PAPER_POLICY] {
            let settings = BasinSettings { max_impacts: 3, policy };
            let error = map().basins(fast, &[], settings, &Unobserved).expect_err("too fast");
            assert!(matches!(error, Error::FlightTooLong { .. }), "{error}");
        }
    }

    #[test]
    fn a_grid_that_fills_the_memory_is_refused_with_its_size() {
        let side = axis(0.0, 1.0, 100_000);
        let grid = Grid::new(side, side).expect("legal");
        let error = map().basins(grid, &[], BasinSettings::default(), &Unobserved).expect_err("too large");
        let expected = Error::TooLarge { what: "cells of a grid", count: 10_000_000_000, limit: MAX_CELLS };
        assert_eq!(error, expected);
    }

    #[test]
    fn a_radius_that_is_none_catches_nothing() {
        for radius in [f64::NAN, -1.0, f64::INFINITY, f64::NEG_INFINITY] {
            refused(KnownOrbit::new(orbit(), radius), "attraction radius");
        }
        let empty = PeriodicOrbit { states: Vec::new(), ..orbit() };
        refused(KnownOrbit::new(empty, 0.1), "impacts of a periodic orbit");
        let known = KnownOrbit::new(orbit(), 0.1).expect("legal");
        assert_eq!((known.orbit(), known.radius().to_bits()), (&orbit(), 0.1_f64.to_bits()));
    }

    /// A label is one byte: the label of the 255th orbit would overflow.
    #[test]
    fn one_start_knows_no_more_orbits_than_a_grid() {
        let far = KnownOrbit::new(orbit(), 0.0).expect("legal");
        let mut known = vec![far; 300];
        let start = ImpactState::from_normalised(1.0, 0.3).expect("legal");
        known[290] = KnownOrbit::new(orbit(), 10.0).expect("legal");
        refused(map().basin_label(start, &known, BasinSettings::default()), "number of known orbits");
        known.truncate(250);
        known[249] = KnownOrbit::new(orbit(), 10.0).expect("legal");
        let label = map().basin_label(start, &known, BasinSettings::default());
        assert_eq!(label, Ok(FIRST_ORBIT + 249));
    }
}
