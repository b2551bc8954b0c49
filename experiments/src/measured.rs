//! A user's own measurements: comma-separated files that are drawn over a figure and fitted as the paper fits its own.
//!
//! The paper prints its measured points only as pictures, so none come with this crate. [`Measurements`] (`folder.rs`)
//! holds what lies in `data/measured`; a figure names the files that it can show by their [`Layout`] (`layout.rs`), which
//! are read and checked line by line in `parse.rs`, and gets a [`Series`] of checked numbers (`series.rs`).
//! `data/measured/README.md` has the same layouts in words.

mod error;
mod folder;
mod layout;
mod parse;
mod series;

pub use error::{LineFault, MeasuredError};
pub use folder::Measurements;
pub use layout::{Column, LARGEST, LARGEST_FILE, Layout, MOST_ROWS, Range, Role, SMALLEST, TINIEST};
pub use series::Series;
