#![doc = include_str!("../README.md")]
//!
//! # Contents
//!
//! | what | where |
//! | --- | --- |
//! | the page: its size, its parts, SVG and PNG | [`Figure`], [`SINGLE_COLUMN`], [`DOUBLE_COLUMN`] |
//! | rectangles on the page | [`Grid`], [`Margins`], [`Rect`] |
//! | a frame with axes | [`Panel`], [`Axis`], [`Ticks`], [`Legend`], [`Corner`] |
//! | layers of a panel: curves and areas | [`Line`], [`Band`], [`Rule`] |
//! | layers of points and cells | [`Scatter`] with its [`Marker`], [`DensePoints`], [`Raster`] |
//! | layers of words | [`Text`], [`Arrow`]; any of these is a [`Layer`] |
//! | how shapes look, in all layers alike | [`Style`] of [`Stroke`] and [`Fill`], [`Dash`], [`Colour`] |
//! | words with symbols and scripts | [`Label`], placed by an [`Anchor`], set in a [`TextStyle`] |
//! | sketches, flow charts, perspective | [`Drawing`] of [`Path`]s, [`Camera`] |
//! | a table between rules | [`ruled_table`] |
//! | whole pictures of results, from plain numbers | [`pictures`] |
//! | numbers in words | [`rounded`], [`in_math`] |
//! | what can go wrong | [`DrawError`] |
//!
//! Labels are a small subset of TeX between dollar signs: see [`Label::new`]. A [`Figure`] has a size in points
//! (1/72 inch) and contains [`Panel`]s (axes with layers) and [`Drawing`]s (free sketches) at given rectangles;
//! a [`Grid`] computes these rectangles.

mod annotation;
mod axis;
mod builders;
mod camera;
mod colour;
mod dense;
mod drawing;
mod encode;
mod error;
mod figure;
mod font;
mod frame;
mod label;
mod layer;
mod legend;
mod line;
mod numbers;
mod panel;
mod path;
pub mod pictures;
mod raster;
mod ruled_table;
mod scatter;
mod style;
mod svg;
mod ticks;

pub use annotation::{Arrow, Text};
pub use axis::Axis;
pub use camera::Camera;
pub use colour::Colour;
pub use dense::DensePoints;
pub use drawing::Drawing;
pub use error::DrawError;
pub use figure::{DOUBLE_COLUMN, Figure, SINGLE_COLUMN};
pub use frame::{Grid, Margins, Rect};
pub use label::Label;
pub use layer::Layer;
pub use legend::{Corner, Legend};
pub use line::{Band, Line, Rule};
pub use numbers::{in_math, rounded};
pub use panel::Panel;
pub use path::Path;
pub use raster::Raster;
pub use ruled_table::ruled_table;
pub use scatter::{Marker, Scatter};
pub use style::{Anchor, Dash, Fill, Stroke, Style, TextStyle};
pub use ticks::Ticks;
