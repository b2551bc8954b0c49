//! Every figure and table of Liu, Friend and Yeo, Phys. Rev. E **80**, 046201 (2009): its data, its drawing
//! and its printed numbers compared with ours.
//!
//! One module of `figures` makes one figure or table. Its function computes, and records in a [`Paper`] the data, the
//! [drawing](bouncing_disk_plot::Figure), and every number and statement of the paper compared with ours ([`Claim`]); printed
//! numbers stand in the [catalogue](claims::catalogue) alone.
//!
//! [`registry`] lists the experiments; [`output`] writes their files, each with its [`provenance`];
//! [`report`] makes the gallery and the committed pages from all of them.

pub mod claims;
pub mod experiment;
mod figures;
pub mod json;
pub mod output;
pub mod progress;
pub mod provenance;
pub mod registry;
pub mod report;
#[cfg(test)]
mod testing;

pub use claims::Claim;
pub use experiment::{Experiment, ExperimentError, Paper, Quality};
pub use json::FiniteError;
pub use progress::{Progress, Silent};

/// Compiles and runs the examples of the workspace's README, which no packaged crate may read.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct ReadmeExamples;
