//! The motion: the event engine, what happens in flight, contact and impact, and its energy.

pub(crate) mod arc;
pub(crate) mod chatter;
pub(crate) mod contact_motion;
pub(crate) mod energy;
pub(crate) mod engine;
pub(crate) mod event;
pub(crate) mod friction;
pub(crate) mod impact;
pub(crate) mod initial_condition;
pub(crate) mod paper_chatter;
pub(crate) mod phase_time;
pub(crate) mod rotary_change;
pub(crate) mod segment;
pub(crate) mod si;
pub(crate) mod state;
pub(crate) mod trajectory;
pub(crate) mod transition;
