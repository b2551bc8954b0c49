//! Periodic orbits: how to find them, their stability, and their births, doublings and ends.
//!
//! An orbit of n impacts in k periods of the platform is a fixed point of the n-th iterate of the impact map.
//! It attracts if both eigenvalues of the derivative, its Floquet multipliers, lie inside the unit circle. At a
//! fold one of them is 1; at a period doubling one is -1. The orbit with one impact in each period has a closed
//! form: cos tau = (1 - r) / ((1 + r) Gamma).
//!
//! ```
//! use bouncing_disk_core::orbits::{OrbitSearch, doubling_cascade};
//! use bouncing_disk_core::{ImpactMap, Unobserved, Vibration};
//!
//! let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
//! let found = map.periodic_orbits(&OrbitSearch::new(1, 1)?, &Unobserved)?;
//! assert_eq!(found.orbits.len(), 2); // The node and the saddle of one impact in one period.
//! let doublings = doubling_cascade(0.5, 2, &Unobserved)?.doublings;
//! assert!((doublings[0].axial_forcing - 0.486_003_078_3).abs() < 1e-9);
//! # Ok::<(), bouncing_disk_core::Error>(())
//! ```
//!
//! [`ContinuedMap::continued`] follows an orbit over a parameter. [`attractors`](crate::attractors) finds the
//! orbits on which a disk ends. The methods are in docs/numerics-dynamics.md.

pub(crate) mod cascade;
pub(crate) mod closing;
pub(crate) mod continuation;
pub(crate) mod follow_attractor;
pub(crate) mod periodic;

pub use cascade::feigenbaum::{FeigenbaumEstimate, feigenbaum_estimates};
pub use cascade::{CascadeDoubling, DoublingCascade, MAX_DOUBLINGS, doubling_cascade};
pub use closing::{ClosingMap, ContinuationParameter};
pub use continuation::curve::{Curve, CurveEnd, CurvePoint, SpecialKind, SpecialPoint};
pub use continuation::{
    Bifurcation, BifurcationKind, Branch, BranchEnd, BranchPoint, Continuation, ContinuedMap, LocatedDoubling,
};
pub use follow_attractor::{Followed, Following, follow_attractor};
pub use periodic::catalogue::{OrbitCoverage, OrbitSearch, OrbitsFound};
pub use periodic::pair::{PeriodOneOrbit, PeriodOnePair};
pub use periodic::{MAX_PERIOD, Multipliers, PeriodicOrbit, Stability};
