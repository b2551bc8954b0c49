//! Every figure and table of Liu, Friend and Yeo, Phys. Rev. E **80**, 046201 (2009): its data, its drawing
//! and its printed numbers compared with ours.
//!
//! One module of [`figures`] makes one figure or table. It implements [`Experiment`]:
//!
//! * `compute` computes plain, serialisable data (units in the field names); it knows no picture,
//! * `draw` turns that data into a [`Figure`](bouncing_disk_plot::Figure); it computes nothing,
//! * `claims` compares every number the paper prints with the computed one ([`Claim`]); printed numbers stand
//!   in the [catalogue](claims::catalogue) alone.
//!
//! [`registry`] lists the experiments; [`output`] writes their files, each with its [`provenance`];
//! [`report`] makes the gallery and the committed pages from all of them.

pub mod claims;
pub mod experiment;
pub mod figures;
pub mod json;
pub mod output;
pub mod progress;
pub mod provenance;
pub mod registry;
pub mod report;
#[cfg(test)]
mod testing;

pub use claims::Claim;
pub use experiment::{Experiment, ExperimentError, Quality};
pub use json::FiniteError;
pub use progress::{Progress, Silent};

/// Compiles and runs the examples of the workspace's README, which no packaged crate may read.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct ReadmeExamples;
