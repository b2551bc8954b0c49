//! The vertical motion of a disk that bounces on a sinusoidally vibrating platform, without units.
//!
//! Time is counted in radians of the platform's phase (1/omega), length in g/omega^2; the one parameter of the
//! platform is its peak acceleration P = pi Gamma in units of g.

mod basin;
mod catching;
mod chatter;
mod drop;
pub mod elementary;
mod ensemble;
mod error;
mod flight;
mod flights;
mod follow;
mod gap;
mod lanes;
mod map;
mod margin;
mod periodic;
mod phase;
pub mod reference;
mod rest;
mod shortcuts;
mod sweep;
#[cfg(test)]
mod testing;
mod vibration;

pub use basin::{
    ATTACHED, Axis, BasinSettings, Basins, FIRST_ORBIT, Grid, KnownOrbit, Label, MAX_CELLS, UNDECIDED,
};
pub use chatter::{
    Accumulation, ChatterImpact, ChatterPolicy, ChatterSeries, ImpactRange, PAPER_SHORT_FLIGHT,
    PAPER_SHORT_FLIGHTS, PAPER_SMALLEST_SPEED, PowerSeries,
};
pub use ensemble::Ensemble;
pub use error::Error;
pub use flight::{Impact, Launch, MAX_FLIGHT_DURATION};
pub use flights::{Flights, LaneImpacts, LaneLoop};
pub use follow::{Followed, Following, follow};
pub use lanes::InstructionSet;
pub use map::{ImpactMap, ImpactState, Orbit, OrbitEvent, Stick};
pub use periodic::{MAX_PERIOD, Multipliers, PeriodDoubling, PeriodicOrbit, period_doublings};
pub use phase::Phase;
pub use sweep::{Landing, MAX_RECORDED, SweepEvent, columns, lives, lyapunov_exponents, sweep};
pub use vibration::Vibration;
