//! Drawing: figures as the journal prints them, written as SVG with real text and rendered to PNG.
//!
//! A [`Figure`] has a size in points (1/72 inch) and holds [`Panel`]s (axes with layers) and [`Drawing`]s (free
//! sketches) at given rectangles; a [`Grid`] computes those. The journal's columns are [`SINGLE_COLUMN`] and
//! [`DOUBLE_COLUMN`] wide.
//!
//! ```
//! use bouncing_disk_plot::{Axis, Colour, Figure, Grid, Legend, Corner, Line, Panel, Ticks, SINGLE_COLUMN};
//!
//! let grid = Grid::new(SINGLE_COLUMN, 180.0, 1, 1);
//! let panel = Panel::new(grid.cell(0, 0))
//!     .x(Axis::linear(0.3, 0.6).label(r"$\Gamma$"))
//!     .y(Axis::linear(0.0, std::f64::consts::PI).label(r"$\tau_{imp}$ (rad)").ticks(Ticks::pi(1, 4)))
//!     .letter("a")
//!     .layer(Line::new([(0.33, 0.0), (0.5, 1.2)]).colour(Colour::BLUE).name("period 1"))
//!     .legend(Legend::at(Corner::TopRight));
//! let svg = Figure::new(SINGLE_COLUMN, 180.0).panel(panel).to_svg()?;
//! assert!(svg.contains("STIX Two Text"));
//! # Ok::<(), bouncing_disk_plot::DrawError>(())
//! ```
//!
//! # Why no plotting library
//!
//! The labels of this paper mix italic variables, upright words, scripts and dotted accents in one line. Two libraries
//! were judged, kuva from its source and plotters from its documentation. kuva 0.6.0 has the right axes, but sets titles, tick labels and legends in one style
//! without scripts, drops the dot of a dotted alpha (its other way, a typesetter, adds some 200 crates), has no
//! image primitive for basins of attraction, places panels on a fixed grid only, and has no free drawings.
//! plotters has neither ticks inside the frame nor any of the label features. What remains after replacing
//! labels, images, panels and sketches is an SVG writer; so this is one. It draws what these figures need and
//! nothing else.

mod annotation;
mod axis;
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
mod panel;
mod picture;
mod png_image;
mod raster;
mod ruled_table;
mod scatter;
mod stroke;
mod svg;
mod ticks;

pub use annotation::{Anchor, Arrow, Text};
pub use axis::{Axis, Scale};
pub use camera::Camera;
pub use colour::Colour;
pub use dense::DensePoints;
pub use drawing::{Drawing, Path};
pub use error::DrawError;
pub use figure::{DOUBLE_COLUMN, Figure, SINGLE_COLUMN};
pub use frame::{Grid, Margins, Rect};
pub use label::{Label, Style};
pub use layer::Layer;
pub use legend::{Corner, Legend};
pub use line::{Band, Line, Rule};
pub use panel::Panel;
pub use raster::Raster;
pub use ruled_table::ruled_table;
pub use scatter::{Marker, Scatter};
pub use stroke::{Dash, Stroke};
pub use ticks::Ticks;
