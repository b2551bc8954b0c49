//! Basins as cells, with the impacts of the periodic attractors in them, and a key.

use std::rc::Rc;

use bouncing_disk::core::attractors::{ATTACHED, FIRST_ORBIT, Label, UNDECIDED};
use bouncing_disk_plot::{Axis, Colour, Figure, Marker, Panel, Raster, Rect, Scatter, Ticks};

use super::{PHASE, SPEED, math};

/// What is drawn.
pub(crate) struct Picture {
    pub(crate) axial_forcing: f64,
    pub(crate) restitution: f64,
    pub(crate) phases: [f64; 2],
    pub(crate) speeds: [f64; 2],
    /// Cells along each axis.
    pub(crate) cells: usize,
    /// Row by row, from the lowest speed.
    pub(crate) labels: Rc<[Label]>,
    pub(crate) legend: Vec<(Label, String)>,
    /// Label, phase (periods) and normalised speed of the impacts of the periodic attractors.
    pub(crate) impacts: Vec<(Label, f64, f64)>,
}

/// As in the paper: the rest white, the first orbit black; further ones in colours.
fn colour(label: Label) -> Colour {
    match label {
        UNDECIDED => Colour::LIGHT_GREY,
        ATTACHED => Colour::WHITE,
        FIRST_ORBIT => Colour::BLACK,
        other => Colour::cycle(usize::from(other - FIRST_ORBIT)),
    }
}

impl Picture {
    pub(crate) fn draw(&self) -> Figure {
        const WIDTH: f64 = 470.0;
        const HEIGHT: f64 = 300.0;
        let palette: Vec<Colour> = (0..=Label::MAX).map(colour).collect();
        let ([left, right], [bottom, top]) = (self.phases, self.speeds);
        let (x, y) = ((left, right), (bottom, top));
        let raster = Raster::new(self.cells, self.cells, self.labels.to_vec(), &palette, x, y);
        let spots = |of: fn(Label) -> bool| {
            self.impacts.iter().filter(move |own| of(own.0)).map(|own| (own.1, own.2))
        };
        let crosses = |spots: Vec<(f64, f64)>, colour: Colour| {
            Scatter::new(spots).marker(Marker::Cross).size(5.5).width(1.1).colour(colour)
        };
        let map = Panel::new(Rect::new(44.0, 26.0, 290.0, 240.0))
            .x(Axis::linear(left, right).label(PHASE))
            .y(Axis::linear(bottom, top).label(SPEED))
            .title(format!(
                r"$\Gamma = {}$, $\epsilon = {}$",
                math(self.axial_forcing),
                math(self.restitution)
            ))
            .layer(raster)
            .layer(crosses(spots(|label| label == FIRST_ORBIT).collect(), Colour::WHITE))
            .layer(crosses(spots(|label| label != FIRST_ORBIT).collect(), Colour::BLACK))
            .markers_on_top();
        Figure::new(WIDTH, HEIGHT).panels([map, self.key(&palette)])
    }

    fn key(&self, palette: &[Colour]) -> Panel {
        let there: Vec<&(Label, String)> =
            self.legend.iter().filter(|(label, _)| self.labels.contains(label)).collect();
        let count = there.len().max(1);
        let squares = there.iter().rev().map(|(label, _)| *label).collect();
        let ends = (0.0, count as f64);
        let ticks = there.iter().enumerate().map(|(k, (_, words))| {
            let place = (count - 1 - k) as f64 + 0.5;
            (place, short(words))
        });
        let size = 14.0_f64.min(240.0 / count as f64) * count as f64;
        Panel::new(Rect::new(348.0, 26.0, 14.0, size))
            .x(Axis::linear(0.0, 1.0).ticks(Ticks::none()))
            .y(Axis::linear(ends.0, ends.1).ticks(Ticks::none()))
            .right(Axis::linear(ends.0, ends.1).ticks(Ticks::at(ticks)))
            .layer(Raster::new(1, count, squares, palette, (0.0, 1.0), ends))
    }
}

/// The words without their details, for which there is no room.
fn short(words: &str) -> String {
    // Every start takes impacts of its own until it rests.
    if words.starts_with("rest") {
        return "rest".to_owned();
    }
    let words = words.split(',').next().unwrap_or(words);
    words.split(" and ").next().unwrap_or(words).to_owned()
}
