//! The printed numbers and statements of the paper, and how they are judged.
//!
//! [`printed`] reads numbers as the paper prints them, [`catalogue`] has all that it prints, and `paper` gives some of it to
//! experiments as typed inputs. [`judging`] has the rule of each kind; [`Claim`] compares one printed number or statement with
//! ours, and [`answers`] says whether each entry of the catalogue is answered by one claim.

pub mod answers;
pub mod catalogue;
mod claim;
pub mod judging;
pub(crate) mod paper;
pub mod printed;

pub use catalogue::Class;
pub use claim::{Claim, Computed, SingleOrbits, all, any};
pub use judging::{Cases, Kind, Verdict};
