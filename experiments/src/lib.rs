//! Every figure and table of Liu, Friend and Yeo, Phys. Rev. E **80**, 046201 (2009): its data, its drawing and
//! its printed numbers compared with ours.
//!
//! One module of [`figures`] makes one figure or table, in four files: `data.rs` has its types, `compute.rs`, `draw.rs` and
//! `claims.rs` what follows. It implements [`Experiment`]:
//!
//! * `compute` computes plain, serialisable data (units in the field names); it knows no picture,
//! * `draw` turns that data into a [`Figure`](bouncing_disk_plot::Figure); it computes nothing,
//! * `claims` compares every number the paper prints with the computed one ([`Claim`]); what is printed stands in the
//!   [`catalogue`] alone.
//!
//! [`registry`] lists the experiments; [`output`] writes their files; [`page`] makes the gallery, [`results`] the
//! committed page, [`extra_pictures`] the pictures of the figures beyond the paper. [`provenance`] is what every file says of its origin.

pub mod answers;
pub mod artifacts;
pub mod cache_key;
pub mod catalogue;
pub mod claim;
mod colour_scale;
pub mod committed_picture;
pub mod count;
pub mod digits;
pub mod errata;
pub mod experiment;
pub mod extra_pictures;
pub mod figures;
mod finite;
pub mod json;
pub mod judging;
pub mod measured;
pub mod output;
pub mod page;
pub mod paper;
pub mod printed;
pub mod progress;
pub mod provenance;
pub mod registry;
pub mod results;
pub mod summary;
pub mod sweep_picture;
pub mod table;
#[cfg(test)]
mod testing;
pub mod visible;

pub use claim::Claim;
pub use experiment::{Experiment, ExperimentError, Quality};
pub use finite::FiniteError;
pub use measured::Measurements;
pub use progress::{Progress, Silent};
pub use sweep_picture::sweep_picture;
pub use table::Table;

/// Compiles and runs the examples of the workspace's README, which no packaged crate may read.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct ReadmeExamples;
