//! The colours of a map of one quantity, from low to high.

use bouncing_disk_plot::Colour;

/// The colours of low, middle and high values.
const COLOURS: [Colour; 4] = [
    Colour::rgb(253, 231, 160),
    Colour::rgb(120, 198, 140),
    Colour::rgb(35, 120, 150),
    Colour::rgb(50, 25, 95),
];

/// The colour a share of the way through the scale; beyond its ends, that of the end.
pub(crate) fn colour(share: f64) -> Colour {
    let place = share.clamp(0.0, 1.0) * (COLOURS.len() - 1) as f64;
    let index = (place as usize).min(COLOURS.len() - 2);
    COLOURS[index].mixed(COLOURS[index + 1], place - index as f64)
}
