//! Why a figure cannot be drawn.

/// Why a figure cannot be drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DrawError {
    /// A label uses a TeX command that this crate does not know.
    #[error("label \"{label}\": unknown command \\{command}")]
    UnknownCommand {
        /// The command without its backslash.
        command: String,
        /// The source of the label.
        label: String,
    },
    /// Braces or dollar signs of a label do not pair up, or a script or accent lacks its argument.
    #[error("label \"{label}\": {what}")]
    MalformedLabel {
        /// The fault.
        what: &'static str,
        /// The source of the label.
        label: String,
    },
    /// A character is in none of the bundled fonts.
    #[error("label \"{label}\": the bundled fonts lack {character:?}")]
    MissingGlyph {
        /// The character.
        character: char,
        /// The source of the label.
        label: String,
    },
    /// The ends of an axis coincide or are not finite, or a logarithmic axis includes zero or negative values.
    #[error(
        "axis \"{axis}\": the range {low} to {high} is empty, not finite, or below zero on a logarithmic scale"
    )]
    AxisRange {
        /// The label of the axis.
        axis: String,
        /// One end.
        low: f64,
        /// The other end.
        high: f64,
    },
    /// The step between ticks is not a positive number, or causes too many ticks.
    #[error("axis \"{axis}\": ticks every {step} from {low} to {high} cannot be drawn")]
    TickStep {
        /// The label of the axis.
        axis: String,
        /// The step.
        step: f64,
        /// One end of the axis.
        low: f64,
        /// The other end.
        high: f64,
    },
    /// A layer refers to the axis on the right of a panel that has none.
    #[error("panel \"{panel}\": a layer needs the right axis, which is missing")]
    NoRightAxis {
        /// The letter of the panel.
        panel: String,
    },
    /// A cell of a raster refers to no colour of its palette.
    #[error("a raster cell has colour {index}, but the palette has only {colours}")]
    RasterColour {
        /// The index.
        index: u8,
        /// The size of the palette.
        colours: usize,
    },
    /// A list is empty or does not have one value for each point or cell.
    #[error("{what}: {given} values for {needed} points or cells")]
    Length {
        /// Which list.
        what: &'static str,
        /// Its length.
        given: usize,
        /// The number of points or cells.
        needed: usize,
    },
    /// The figure or a panel has no area, or is too large for a picture.
    #[error("{what} of {width} by {height} points has no area, or is too large for a picture")]
    Size {
        /// Which part.
        what: &'static str,
        /// Its width in points.
        width: f64,
        /// Its height in points.
        height: f64,
    },
    /// The renderer could not read the vector picture, or the PNG encoder failed.
    #[error("rendering failed: {message}")]
    Render {
        /// Its report.
        message: String,
    },
}
