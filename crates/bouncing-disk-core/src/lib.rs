//! The vertical motion of a disk that bounces on a sinusoidally vibrating platform, without units.
//!
//! Time is counted in radians of the platform's phase (1/omega), length in g/omega^2; the one parameter of the
//! platform is its peak acceleration P = pi Gamma in units of g.
//!
//! ```
//! use std::f64::consts::TAU;
//! use bouncing_disk_core::{ChatterPolicy, ImpactMap, Unobserved, Vibration, orbit_diagram};
//!
//! # fn main() -> Result<(), bouncing_disk_core::Error> {
//! // Gamma = 0.45 and restitution 0.5: a disk on the period-1 orbit lands once in every period.
//! let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
//! let state = map.period_one(1).expect("it exists from Gamma = 1/3 on");
//! assert!((map.step(state)?.duration() - TAU).abs() < 1e-12);
//! // One column of the orbit diagram: 50 impacts after 200 that are not looked at.
//! let column = orbit_diagram(&[map.orbit(state, ChatterPolicy::Complete)], 200, 50, &Unobserved)?;
//! assert_eq!(column[0].len(), 50);
//! # Ok(())
//! # }
//! ```
//!
//! What there is, by what it is about:
//!
//! | about | items |
//! | --- | --- |
//! | the platform | [`Phase`], [`Vibration`] |
//! | one flight | [`Launch`], [`Impact`], [`Vibration::first_impact`], [`Vibration::first_impact_of_drop`], [`mod@reference`] |
//! | chattering | [`ImpactMap::accumulation`], [`ChatterSeries`], [`ChatterPolicy`], [`ChatterCut`], [`ImpactMap::chatters_to_rest`] |
//! | the impact map | [`ImpactMap`], [`ImpactState`], [`Orbit`], [`OrbitEvent`], [`Attachment`] |
//! | laws of restitution | [`Constant`] (the paper's), [`KuwabaraKono`], [`RestitutionLaw`] for one's own; [`ImpactMap::with_law`] |
//! | periodic orbits | [`PeriodicOrbit`], [`Multipliers`], [`PeriodOnePair`], [`OrbitSearch`] and [`ImpactMap::periodic_orbits`], [`follow_attractor`] |
//! | branches of them | [`Continuation`] and [`ImpactMap::continued`], [`Branch`], [`Bifurcation`] |
//! | manifolds and crises | [`ImpactMap::manifold`], [`Manifold`], [`ImpactMap::step_back`]; [`CrisisSearch`], [`Crisis`], [`Crisis::lives`] |
//! | bounds that every attractor obeys | [`ImpactMap::launch_speed_bound`], [`ImpactMap::impact_speed_bound`], [`ImpactMap::impact_speed_bound_at`], [`ImpactMap::flight_duration_bound`] |
//! | the doubling cascade | [`doubling_cascade`], [`CascadeDoubling`], [`feigenbaum_estimates`], [`FeigenbaumEstimate`] |
//! | many orbits | [`OrbitBatch`], [`orbit_diagram`], [`survival_times`], [`lyapunov_exponents`], [`lyapunov_spectra`], [`sweep`] |
//! | what an orbit does for good | [`Verdict`], [`verdicts`], [`VerdictSettings`] |
//! | basins | [`Grid`], [`Axis`], [`Basins`], [`BasinSettings`], [`KnownOrbit`]; their measures [`BasinEntropy`], [`BoundaryScaling`] |
//! | attractors without being told | [`AttractorSearch`] and [`ImpactMap::attractors`], [`Attractors`] and their [basins](Attractors::basins), [`basin_fractions_over`] |
//! | long calls | [`Observer`], [`Progress`], [`Watch`]; to stop, store and go on: [`BasinRun`], [`SweepRun`], [`PartialResults`], [`Branch::extended`], [`BasinFractions::extended`] |
//! | arithmetic | [`numerics`]: [`elementary`] functions with the same bits on every processor, minima, random streams |
//!
//! | feature | default | what it does |
//! | --- | --- | --- |
//! | `extended` | no | module `extended`: double-doubles, the cascade to 25 digits |
//! | `parallel` | yes | grids and sweeps over the threads of rayon's pool, with the same bits |
//! | `serde` | yes | `Serialize` and `Deserialize`, both or neither, for what is stored |
//!
//! What is read passes the checks of what is made: a value outside its range, a key that is
//! missing, unless it is that of an optional value, and one that is unknown are errors. An infinite error bound is `null` in JSON, which has no such number.
//! With `serde_json`, switch on its feature `float_roundtrip`: without it a third of all numbers change in the last bit when
//! they are read, and what is gone on with is no longer the same.

mod analysis;
mod chatter;
mod error;
#[cfg(feature = "extended")]
pub mod extended;
mod flight;
mod lockstep;
mod map;
pub mod numerics;
mod observer;
mod platform;
// The model reads as the core does.
#[doc(hidden)]
pub mod stored;
#[cfg(test)]
mod testing;

pub use analysis::attractors::cells::VisitedCells;
pub use analysis::attractors::over_forcing::{
    AttractorsAt, BasinFractions, FollowedAttractor, MAX_FORCINGS, basin_fractions_over,
};
pub use analysis::attractors::settings::AttractorSearch;
pub use analysis::attractors::{AfterRest, Attractor, AttractorKind, Attractors, Recurrence};
pub use analysis::basin::boundary::{BoundaryFit, BoundaryScaling, UncertainShare};
pub use analysis::basin::entropy::BasinEntropy;
pub use analysis::basin::{
    ATTACHED, Axis, BasinRun, BasinSettings, Basins, FIRST_ORBIT, Grid, KnownOrbit, Label, MAX_CELLS,
    UNDECIDED,
};
pub use analysis::cascade::feigenbaum::{FeigenbaumEstimate, feigenbaum_estimates};
pub use analysis::cascade::{CascadeDoubling, MAX_DOUBLINGS, doubling_cascade};
pub use analysis::closing::ContinuationParameter;
pub use analysis::continuation::{
    Bifurcation, BifurcationKind, Branch, BranchEnd, BranchPoint, BranchTip, Continuation,
};
pub use analysis::crisis::lifetimes::{CrisisLives, MeanLife};
pub use analysis::crisis::{Crisis, CrisisSearch, LifeAfterRest, NoCrisis, NoTangency, Tangency};
pub use analysis::follow_attractor::{Followed, Following, follow_attractor};
pub use analysis::lyapunov::spectrum::{LyapunovOutcome, LyapunovSpectrum, lyapunov_spectra};
pub use analysis::lyapunov::{LyapunovEstimate, TangentGrowth, lyapunov_exponents};
pub use analysis::manifold::{
    Manifold, ManifoldBranch, ManifoldEnd, ManifoldKind, ManifoldPiece, ManifoldSettings, PieceEnd, Side,
};
pub use analysis::orbit_batch::OrbitBatch;
pub use analysis::periodic::pair::{PeriodOneOrbit, PeriodOnePair};
pub use analysis::periodic::search::{OrbitCoverage, OrbitSearch, OrbitsFound};
pub use analysis::periodic::{MAX_PERIOD, Multipliers, PeriodicOrbit, Stability};
pub use analysis::sweep::{
    MAX_RECORDED, PartialResults, SweepEvent, SweepImpact, SweepRun, is_settling, orbit_diagram,
    repeats_every, survival_times, sweep,
};
pub use analysis::verdict::{
    CycleTrust, RestCycle, UndecidedReason, Verdict, VerdictSettings, each_verdict, verdicts,
};
pub use chatter::accumulation::{Accumulation, ChatterImpact};
pub use chatter::impact_series::{ChatterSeries, ImpactRange, PowerSeries};
pub use chatter::policy::{ChatterCut, ChatterPolicy};
pub use error::Error;
pub use flight::first_impact::MAX_FLIGHT_DURATION;
pub use flight::impact::Impact;
pub use flight::launch::Launch;
pub use flight::reference;
// How many flights are computed at once is no promise: the model, benches and tests use these.
#[doc(hidden)]
pub use lockstep::flights::{Flights, LaneImpacts, LaneLoop, LaneRunner};
#[doc(hidden)]
pub use lockstep::lanes::InstructionSet;
pub use map::impact_map::{Attachment, ImpactMap, ImpactState, Orbit, OrbitEvent};
pub use map::restitution_law::kuwabara_kono::KuwabaraKono;
pub use map::restitution_law::{Constant, RestitutionLaw};
pub use numerics::elementary;
pub use observer::{FLIGHTS_BETWEEN_CALLS, Observer, Progress, Unobserved, Watch, WorkCount};
pub use platform::phase::Phase;
pub use platform::vibration::Vibration;

/// Compiles and runs the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
