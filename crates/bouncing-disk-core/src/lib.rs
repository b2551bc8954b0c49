//! The vertical motion of a disk that bounces on a sinusoidally vibrating platform, without units.
//!
//! Time is counted in radians of the platform's phase (1/omega), length in g/omega^2; the one parameter of the
//! platform is its peak acceleration P = pi Gamma in units of g.

mod analysis;
mod chatter;
mod error;
mod flight;
mod lockstep;
mod map;
mod numerics;
mod platform;
#[cfg(test)]
mod testing;

pub use analysis::basin::{
    ATTACHED, Axis, BasinSettings, Basins, FIRST_ORBIT, Grid, KnownOrbit, Label, MAX_CELLS, UNDECIDED,
};
pub use analysis::follow_attractor::{Followed, Following, follow_attractor};
pub use analysis::orbit_batch::OrbitBatch;
pub use analysis::periodic::{MAX_PERIOD, Multipliers, PeriodDoubling, PeriodicOrbit, period_doublings};
pub use analysis::sweep::{
    Landing, MAX_RECORDED, SweepEvent, lyapunov_exponents, orbit_diagram, survival_times, sweep,
};
pub use chatter::accumulation::{
    Accumulation, ChatterImpact, ChatterPolicy, PAPER_SHORT_FLIGHT, PAPER_SHORT_FLIGHTS, PAPER_SMALLEST_SPEED,
};
pub use chatter::series::{ChatterSeries, ImpactRange, PowerSeries};
pub use error::Error;
pub use flight::first_impact::{Impact, Launch, MAX_FLIGHT_DURATION};
pub use flight::reference;
pub use lockstep::flights::{Flights, LaneImpacts, LaneLoop};
pub use lockstep::lanes::InstructionSet;
pub use map::impact_map::{Attachment, ImpactMap, ImpactState, Orbit, OrbitEvent};
pub use numerics::elementary;
pub use platform::phase::Phase;
pub use platform::vibration::Vibration;
