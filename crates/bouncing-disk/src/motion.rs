//! The motion from event to event: flight, impact, chattering, slip and stick.
//!
//! In flight the disk falls and its spin is constant, except under a load. An impact turns the relative axial
//! velocity w_A into -r w_A and gives the disk the angular impulse -sgn(w_T) min(mu a_e F, m a_g^2 |w_T|)
//! against the slip w_T, where F = m (1 + r) |w_A| (Eqs. 5 to 10 of Liu, Friend and Yeo). In contact the disk
//! sticks or slides by Coulomb's law (Eqs. 4 and 12). No event is missed: each impact is proven to be the
//! first, and the infinitely many impacts of a chattering sequence are summed.
//!
//! ```
//! use bouncing_disk::core::{ChatterPolicy, Phase};
//! use bouncing_disk::{Engine, Event, InitialCondition, System, Trajectory};
//!
//! // The dough of Table I, from rest on the hand until its first landing.
//! let start = InitialCondition::Contact { phase: Phase::new(0.0)?, angular_speed: 0.0 };
//! let mut engine = Engine::new(System::pizza_toss(), start, ChatterPolicy::Complete)?;
//! let thrown = Trajectory::record(&mut engine, |record| matches!(record.event, Event::Impact { .. }))?;
//! assert!(thrown.records().iter().any(|record| record.event == Event::Separation));
//! // Each term of the energy balance is computed separately, and together they close.
//! assert!(thrown.ledger().relative_closure() < 1e-12);
//! # Ok::<(), bouncing_disk::Error>(())
//! ```
//!
//! [`SiState`] and [`SiEnergy`] are in SI units; [`Transition`] lists which event may follow which. Tosses are
//! in [`toss`](crate::toss). docs/numerics-impacts.md explains how chattering is summed.

pub(crate) mod arc;
pub(crate) mod chatter;
pub(crate) mod contact_motion;
pub(crate) mod energy;
pub(crate) mod engine;
pub(crate) mod event;
pub(crate) mod friction;
pub(crate) mod gauss;
pub(crate) mod impact;
pub(crate) mod impact_energy;
pub(crate) mod initial_condition;
pub(crate) mod paper_chatter;
pub(crate) mod phase_time;
pub(crate) mod rotary_change;
pub(crate) mod segment;
pub(crate) mod si;
pub(crate) mod state;
pub(crate) mod stator_ledger;
pub(crate) mod trajectory;
pub(crate) mod transition;

pub use energy::EnergyLedger;
pub use engine::sample::{MAX_SAMPLED_PERIODS, MAX_SAMPLES};
pub use engine::{Ground, OnGround, SineGround};
pub use event::{Energies, Motion, MotionRecord};
pub use friction::MAX_CONTACT_EVENTS;
pub use paper_chatter::{PAPER_CHATTER, PAPER_CUT};
pub use phase_time::{PhaseSpan, PhaseTime};
pub use segment::Segment;
pub use si::{SiEnergy, SiState};
pub use state::{DiskState, Mode, PlatformState, SlipDirection, Snapshot};
pub use transition::{EventKind, ModeKind, Transition};
