//! The layers that a panel can hold.

use crate::annotation::{Arrow, Text};
use crate::dense::DensePoints;
use crate::label::Label;
use crate::line::{Band, Line, Rule};
use crate::raster::Raster;
use crate::scatter::Scatter;

/// One layer of a panel; later layers cover earlier ones.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Layer {
    /// A curve or a filled area.
    Line(Line),
    /// The area between two curves.
    Band(Band),
    /// A reference line.
    Rule(Rule),
    /// Points with markers.
    Scatter(Scatter),
    /// Very many points.
    DensePoints(DensePoints),
    /// Cells.
    Raster(Raster),
    /// Words.
    Text(Text),
    /// An arrow.
    Arrow(Arrow),
}

impl Layer {
    /// The name in the legend, for the kinds of layers that it lists.
    pub(crate) fn legend_name(&self) -> Option<&Label> {
        match self {
            Self::Line(Line { name, .. })
            | Self::Band(Band { name, .. })
            | Self::Rule(Rule { name, .. })
            | Self::Scatter(Scatter { name, .. })
            | Self::DensePoints(DensePoints { name, .. }) => name.as_ref(),
            Self::Raster(_) | Self::Text(_) | Self::Arrow(_) => None,
        }
    }
}

macro_rules! into_layer {
    ($($kind:ident),*) => {
        $(impl From<$kind> for Layer {
            fn from(layer: $kind) -> Self {
                Self::$kind(layer)
            }
        })*
    };
}

into_layer!(Line, Band, Rule, Scatter, DensePoints, Raster, Text, Arrow);
