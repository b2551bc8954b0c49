//! Figures as a journal prints them, written as SVG with real text and rendered to PNG with bundled fonts.
//!
//! A [`Figure`] has a size in points (1/72 inch) and holds [`Panel`]s (axes with layers) and [`Drawing`]s
//! (free sketches) at given rectangles; a [`Grid`] computes those. The same figure gives the same text on
//! every machine.
//!
//! ```
//! use bouncing_disk_plot::{Axis, Colour, Corner, Dash, Figure, Grid, Legend, Line, Panel, SINGLE_COLUMN, Ticks};
//!
//! let grid = Grid::new(SINGLE_COLUMN, 180.0, 1, 1);
//! let panel = Panel::new(grid.cell(0, 0))
//!     .x(Axis::linear(0.3, 0.6).label(r"$\Gamma$"))
//!     .y(Axis::linear(0.0, std::f64::consts::PI).label(r"$\tau_{imp}$ (rad)").ticks(Ticks::pi(1, 4)))
//!     .letter("a")
//!     .layer(Line::new([(0.33, 0.0), (0.5, 1.2)]).colour(Colour::BLUE).dash(Dash::Dashed).name("period 1"))
//!     .legend(Legend::at(Corner::TopRight));
//! let figure = Figure::new(SINGLE_COLUMN, 180.0).panel(panel);
//! assert!(figure.to_svg()?.contains("STIX Two Text"));
//! assert!(figure.to_png()?.starts_with(b"\x89PNG"));
//! # Ok::<(), bouncing_disk_plot::DrawError>(())
//! ```
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
//! | sketches, flow charts, perspective | [`Drawing`] with its [`TextBox`], [`Path`], [`Camera`] |
//! | a table between rules | [`ruled_table`] |
//! | whole pictures of results, from plain numbers | [`pictures`] |
//! | numbers in words | [`rounded`], [`in_math`] |
//! | what can go wrong | [`DrawError`] |
//!
//! Labels are a small subset of TeX between dollar signs: see [`Label::new`]. Outlines, clipping and maps to
//! the page are kurbo's, dense layers are painted by tiny-skia, and resvg renders the PNG.

mod annotation;
mod axis;
mod builders;
mod camera;
mod colour;
mod dense;
mod drawing;
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
mod picture;
pub mod pictures;
mod png_image;
mod raster;
mod ruled_table;
mod scatter;
mod style;
mod svg;
mod text_style;
mod ticks;

pub use annotation::{Arrow, Text};
pub use axis::Axis;
pub use camera::Camera;
pub use colour::Colour;
pub use dense::DensePoints;
pub use drawing::{Drawing, TextBox};
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
pub use style::{Dash, Fill, Stroke, Style};
pub use text_style::{Anchor, TextStyle};
pub use ticks::Ticks;

/// The example of the README, compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
