//! The cascade: how fast the distances between doublings shrink.

use bouncing_disk::core::orbits::CascadeDoubling;
use bouncing_disk_plot::{Axis, Colour, Figure, Line, Panel, Rect, SINGLE_COLUMN, Scatter, Ticks};

use super::math;

/// Distances from each doubling to the next one, on a logarithmic axis.
pub(crate) fn draw(restitution: f64, found: &[CascadeDoubling]) -> Figure {
    const HEIGHT: f64 = 190.0;
    let distances: Vec<(f64, f64)> = found
        .windows(2)
        .map(|pair| (pair[0].number as f64, pair[1].axial_forcing - pair[0].axial_forcing))
        .filter(|(_, distance)| *distance > 0.0)
        .collect();
    let least = distances.iter().fold(0.1_f64, |least, (_, distance)| least.min(*distance));
    let last = found.len().max(2) as f64;
    let panel = Panel::new(Rect::new(50.0, 24.0, 184.0, 132.0))
        .x(Axis::linear(0.5, last - 0.5).label("$n$").ticks(Ticks::every(1.0).minor(1)))
        .y(Axis::log(0.3 * least, 0.3).label(r"$\Gamma_{n+1} - \Gamma_n$"))
        .title(format!(r"$\epsilon = {}$", math(restitution)))
        .layer(Line::new(distances.clone()).colour(Colour::GREY).width(0.6))
        .layer(Scatter::new(distances).size(3.2).colour(Colour::BLUE));
    Figure::new(SINGLE_COLUMN, HEIGHT).panel(panel)
}
