//! The impacts of periodic orbits in the plane of phase and speed.

use bouncing_disk::core::orbits::{OrbitsFound, Stability};
use bouncing_disk_plot::{
    Axis, Colour, Corner, Figure, Legend, Marker, Panel, Rect, SINGLE_COLUMN, Scatter, Ticks,
};

use super::{PHASE, SPEED, largest, math};

/// Attracting orbits filled, unstable ones open, with a colour for each number of impacts.
pub(crate) fn draw(axial_forcing: f64, restitution: f64, found: &OrbitsFound) -> Figure {
    const HEIGHT: f64 = 230.0;
    let most = found.orbits.iter().map(|orbit| orbit.period()).max().unwrap_or(0);
    let speeds =
        found.orbits.iter().flat_map(|orbit| orbit.states.iter().map(|state| state.normalised_speed()));
    let mut panel = Panel::new(Rect::new(44.0, 24.0, 190.0, 172.0))
        .x(Axis::linear(0.0, 1.0).label(PHASE).ticks(Ticks::every(0.2).minor(4)))
        .y(Axis::linear(0.0, 1.5 * largest(speeds, 0.5)).label(SPEED))
        .title(format!(r"$\Gamma = {}$, $\epsilon = {}$", math(axial_forcing), math(restitution)))
        .markers_on_top();
    for impacts in 1..=most {
        let of = |attracts: bool| {
            found
                .orbits
                .iter()
                .filter(|orbit| orbit.period() == impacts)
                .filter(|orbit| (orbit.stability() == Stability::Stable) == attracts)
                .flat_map(|orbit| orbit.states.iter())
                .map(|state| (state.phase().cycles(), state.normalised_speed()))
                .collect::<Vec<_>>()
        };
        let colour = Colour::cycle(impacts - 1);
        let (open, filled) = (of(false), of(true));
        let name = format!("{impacts} impact{}", if impacts == 1 { "" } else { "s" });
        if !open.is_empty() {
            let dots = Scatter::new(open).marker(Marker::Circle).size(3.6).width(0.8).colour(colour);
            panel = panel.layer(dots.name(format!("{name}, unstable or marginal")));
        }
        if !filled.is_empty() {
            let dots = Scatter::new(filled).marker(Marker::Dot).size(4.4).colour(colour);
            panel = panel.layer(dots.name(format!("{name}, attracts")));
        }
    }
    Figure::new(SINGLE_COLUMN, HEIGHT)
        .panel(panel.legend(Legend::at(Corner::TopRight).without_frame().inset(4.0)))
}
