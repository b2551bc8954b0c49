//! Chaos: Lyapunov exponents, the manifolds of saddles, and the crises that end chaotic attractors.
//!
//! The largest Lyapunov exponent is the mean logarithm of the growth of a tangent vector per impact; the two
//! exponents sum to 2 ln r, because the map contracts areas by r^2. An attractor ends in a boundary crisis when
//! the stable and unstable manifolds of a saddle touch (Grebogi, Ott and Yorke, Physica D 7, 181, 1983). Beyond
//! the crisis the mean survival time falls as a power of the distance from it.
//!
//! ```
//! use bouncing_disk_core::chaos::lyapunov_exponents;
//! use bouncing_disk_core::{ImpactMap, ImpactState, Unobserved, Vibration};
//!
//! let map = ImpactMap::new(Vibration::from_axial_forcing(0.55)?, 0.5)?;
//! let start = ImpactState::from_normalised(0.8, 1.3)?;
//! let exponents = lyapunov_exponents(&[(map, start)], 200, 2_000, &Unobserved)?;
//! assert!(exponents[0].is_some_and(|exponent| exponent > 0.1));
//! # Ok::<(), bouncing_disk_core::Error>(())
//! ```
//!
//! A [verdict](crate::attractors::Verdict) decides whether an exponent proves chaos. The methods are in
//! docs/numerics-dynamics.md.

pub(crate) mod crisis;
pub(crate) mod manifold;

pub use crate::sweep::lyapunov::spectrum::{LyapunovOutcome, LyapunovSpectrum, lyapunov_spectra};
pub use crate::sweep::lyapunov::{LyapunovEstimate, TangentGrowth, lyapunov_exponents};
pub use crisis::lifetimes::{CrisisLives, MeanLife};
pub use crisis::{
    AfterCrisis, Crisis, CrisisEvent, CrisisKind, CrisisSearch, LifeAfterRest, NoCrisis, NoTangency, Tangency,
};
pub use manifold::{
    Manifold, ManifoldBranch, ManifoldEnd, ManifoldKind, ManifoldPiece, ManifoldSettings, PieceEnd, Side,
};
