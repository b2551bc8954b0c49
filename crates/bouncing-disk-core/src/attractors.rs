//! Attractors: the final motions of the disk, their basins, and how certain the answers are.
//!
//! Every impact is slower than [`ImpactMap::impact_speed_bound`](crate::ImpactMap::impact_speed_bound), so a
//! search from starts in this region finds every attractor whose basin is not too small. A start counts as
//! captured by a periodic orbit once it comes within the [trapping
//! radius](crate::orbits::PeriodicOrbit::trapping_radius) of that orbit; no other definition of "near enough"
//! is used.
//!
//! ```
//! use bouncing_disk_core::attractors::{AttractorSearch, Axis, BasinSettings, Grid};
//! use bouncing_disk_core::{ImpactMap, Unobserved, Vibration};
//!
//! let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
//! let found = map.attractors(&AttractorSearch::default().with_starts(200)?, &Unobserved)?;
//! assert_eq!(found.all().len(), 2); // The disk at rest, and one impact in each period.
//! let grid = Grid::new(Axis::new(0.0, 1.0, 20)?, Axis::new(0.0, 3.0, 20)?)?;
//! let basins = found.basins(grid, BasinSettings::default(), &Unobserved)?;
//! assert_eq!(basins.labels().len(), 400);
//! # Ok::<(), bouncing_disk_core::Error>(())
//! ```
//!
//! [`verdicts`] decides whether single orbits rest, repeat or are chaotic; [`BasinEntropy`] and
//! [`BoundaryScaling`] measure basins. The methods are in docs/numerics-dynamics.md.

mod attracting_map;
pub(crate) mod attraction;
pub(crate) mod basin;
pub(crate) mod search;
pub(crate) mod verdict;

pub use attracting_map::AttractingMap;
pub use basin::boundary::{BoundaryFit, BoundaryScaling, UncertainShare};
pub use basin::entropy::BasinEntropy;
pub use basin::{
    ATTACHED, Axis, BasinSettings, Basins, FIRST_ORBIT, Grid, KnownOrbit, Label, MAX_CELLS, UNDECIDED,
};
pub use search::cells::VisitedCells;
pub use search::over_forcing::{
    AttractorsAt, BasinFractions, FollowedAttractor, MAX_FORCINGS, basin_fractions_over,
};
pub use search::settings::AttractorSearch;
pub use search::{AfterRest, Attractor, AttractorKind, Attractors, Recurrence};
pub use verdict::{CycleTrust, RestCycle, UndecidedReason, Verdict, VerdictSettings, each_verdict, verdicts};
