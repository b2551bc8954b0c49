//! Chaos: Lyapunov exponents, the manifolds of saddles, and the crises in which a chaotic attractor ends.
//!
//! The largest Lyapunov exponent is the mean logarithm of the growth of a tangent vector per impact; both
//! exponents sum to 2 ln r, because the map contracts areas by r^2. An attractor ends in a boundary crisis
//! where the stable and the unstable manifold of a saddle touch (Grebogi, Ott and Yorke, Physica D 7, 181,
//! 1983); beyond it the disk stays for a mean time that falls as a power of the distance.
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
//! Whether an exponent proves chaos is a [verdict](crate::attractors::Verdict). How it is computed:
//! docs/numerics-dynamics.md.

pub(crate) mod crisis;
pub(crate) mod manifold;

pub use crate::sweep::lyapunov::spectrum::{LyapunovOutcome, LyapunovSpectrum, lyapunov_spectra};
pub use crate::sweep::lyapunov::{LyapunovEstimate, TangentGrowth, lyapunov_exponents};
pub use crisis::lifetimes::{CrisisLives, MeanLife};
pub use crisis::{Crisis, CrisisSearch, LifeAfterRest, NoCrisis, NoTangency, Tangency};
pub use manifold::{
    Manifold, ManifoldBranch, ManifoldEnd, ManifoldKind, ManifoldPiece, ManifoldSettings, PieceEnd, Side,
};
