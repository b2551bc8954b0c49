//! The plane of impact phase and impact speed, and the impacts of periodic orbits in it.

use crate::axis::Axis;
use crate::colour::Colour;
use crate::figure::{Figure, SINGLE_COLUMN};
use crate::frame::Rect;
use crate::legend::{Corner, Legend};
use crate::numbers::in_math;
use crate::panel::Panel;
use crate::scatter::{Marker, Scatter};
use crate::ticks::Ticks;

/// The label of the impact phase, in periods of the platform.
pub const IMPACT_PHASE: &str = r"$\tau_{imp}/2\pi$";

/// The label of the normalised impact speed.
pub const IMPACT_SPEED: &str = r"$|w_A\Gamma/(\omega A)|$";

/// The title of a picture at one forcing and one restitution.
pub fn forcing_and_restitution(axial_forcing: f64, restitution: f64) -> String {
    format!(r"$\Gamma = {}$, $\epsilon = {}$", in_math(axial_forcing), in_math(restitution))
}

/// The axis of all impact phases.
pub(super) fn all_phases() -> Axis {
    Axis::linear(0.0, 1.0).label(IMPACT_PHASE).ticks(Ticks::every(0.2).minor(4))
}

/// The largest of these speeds, at least `least`.
pub(super) fn fastest(speeds: impl IntoIterator<Item = f64>, least: f64) -> f64 {
    speeds.into_iter().filter(|speed| speed.is_finite()).fold(least, f64::max)
}

/// The impacts of orbits as crosses, for a map of basins.
pub fn crosses(impacts: impl IntoIterator<Item = (f64, f64)>, colour: Colour) -> Scatter {
    Scatter::new(impacts).marker(Marker::Cross).size(5.5).width(1.1).colour(colour)
}

/// Impacts (phase in periods, normalised speed) of periodic orbits, and whether each orbit attracts. Markers
/// are filled for attracting orbits and open for others, with a colour for each number of impacts.
pub fn periodic_orbits(title: &str, orbits: &[(bool, Vec<(f64, f64)>)]) -> Figure {
    const HEIGHT: f64 = 230.0;
    let most = orbits.iter().map(|orbit| orbit.1.len()).max().unwrap_or(0);
    let speeds = orbits.iter().flat_map(|orbit| &orbit.1).map(|impact| impact.1);
    let mut panel = Panel::new(Rect::new(44.0, 24.0, 190.0, 172.0))
        .x(all_phases())
        .y(Axis::linear(0.0, 1.5 * fastest(speeds, 0.5)).label(IMPACT_SPEED))
        .title(title)
        .markers_on_top();
    for impacts in 1..=most {
        let colour = Colour::cycle(impacts - 1);
        let plural = if impacts == 1 { "" } else { "s" };
        for attracts in [false, true] {
            let own = orbits.iter().filter(|orbit| orbit.0 == attracts && orbit.1.len() == impacts);
            let own: Vec<_> = own.flat_map(|orbit| orbit.1.iter().copied()).collect();
            if own.is_empty() {
                continue;
            }
            let dots = Scatter::new(own).colour(colour);
            let (dots, words) = if attracts {
                (dots.marker(Marker::Dot).size(4.4), "attracts")
            } else {
                (dots.marker(Marker::Circle).size(3.6).width(0.8), "unstable or marginal")
            };
            panel = panel.layer(dots.name(format!("{impacts} impact{plural}, {words}")));
        }
    }
    Figure::new(SINGLE_COLUMN, HEIGHT)
        .panel(panel.legend(Legend::at(Corner::TopRight).without_frame().inset(4.0)))
}
