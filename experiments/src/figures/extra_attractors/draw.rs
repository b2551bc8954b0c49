//! The drawing of the figure.

use bouncing_disk::core::{BoundaryFit, elementary};
use bouncing_disk_plot::{
    Axis, Colour, Corner, DOUBLE_COLUMN, Figure, Legend, Line, Marker, Panel, Raster, Rect, Scatter, Ticks,
};

use super::data::{BasinsAt, Boundary, ExtraAttractorsData, Kind, Sweep};

/// What each kind is called and drawn in.
const KINDS: [(Kind, &str, Colour); 8] = [
    (Kind::Rest, "rest", Colour::LIGHT_GREY),
    (Kind::Once, "1", Colour::BLUE),
    (Kind::Twice, "2", Colour::GREEN),
    (Kind::Thrice, "3", Colour::VERMILION),
    (Kind::Longer, r"$\geq 4$", Colour::PURPLE),
    (Kind::Mixed, "other", Colour::ORANGE),
    (Kind::Chaotic, "chaotic", Colour::BLACK),
    (Kind::Unclassified, "unclassified", Colour::SKY),
];

/// The colours of the labels of the basins: undecided, rest, and the attractors.
const BASINS: [Colour; 9] = [
    Colour::BLACK,
    Colour::WHITE,
    Colour::SKY,
    Colour::VERMILION,
    Colour::BLUE,
    Colour::GREEN,
    Colour::ORANGE,
    Colour::PURPLE,
    Colour::DARK_GREY,
];

/// The least share that is drawn.
const LEAST: f64 = 3.0e-4;

/// The lower end of the axes of shares and of uncertain shares: room for a key below all that is drawn.
const FLOORS: [f64; 2] = [1.0e-5, 3.0e-4];

fn shares(sweep: &Sweep, named: &[Kind], area: Rect, letter: &str) -> Panel {
    let ends = (sweep.axial_forcings.first(), sweep.axial_forcings.last());
    let (low, high) = (ends.0.copied().unwrap_or(0.0), ends.1.copied().unwrap_or(1.0));
    let mut panel = Panel::new(area)
        .x(Axis::linear(low, high).label(r"$\Gamma$").ticks(Ticks::every(0.2).minor(4)))
        .y(Axis::log(FLOORS[0], 1.5).label("share of the starts"))
        .letter_in(letter, Corner::BottomRight);
    let markers = sweep.axial_forcings.len() < 100;
    for (kind, name, colour) in KINDS {
        let points = sweep.found.iter().zip(&sweep.axial_forcings).flat_map(|(found, forcing)| {
            let own = found.iter().filter(move |own| own.kind == kind && own.share() >= LEAST);
            own.map(move |own| (*forcing, own.share(), own.interval))
        });
        let points: Vec<_> = points.collect();
        // The key of one panel serves both.
        if points.is_empty() && !named.contains(&kind) {
            continue;
        }
        let errors = points.iter().map(|(_, _, (low, high))| 0.5 * (high - low));
        let own = Scatter::new(points.iter().map(|(forcing, share, _)| (*forcing, *share)));
        let own = own.marker(Marker::Dot).size(if markers { 2.0 } else { 1.3 }).colour(colour).name(name);
        panel = panel.layer(if markers { own.errors_y(errors) } else { own });
    }
    panel
}

fn basins(data: &BasinsAt, area: Rect) -> Panel {
    let last = BASINS.len() as u8 - 1;
    let cells = data.rows.iter().flat_map(|row| row.bytes().map(|own| (own.saturating_sub(b'a')).min(last)));
    Panel::new(area)
        .x(Axis::linear(0.0, 1.0).label(r"$\tau_{imp}/2\pi$").ticks(Ticks::every(0.2).minor(2)))
        .y(Axis::linear(0.0, data.top).label(r"$|w_A \Gamma/(\omega A)|$").ticks(Ticks::every(1.0).minor(2)))
        .letter("c")
        .layer(Raster::new(data.cells, data.cells, cells.collect(), &BASINS, (0.0, 1.0), (0.0, data.top)))
}

fn key(data: &BasinsAt, area: Rect) -> Panel {
    let count = data.found.len().min(BASINS.len() - 1);
    let names: Vec<_> = data.found.iter().take(count).map(|own| own.name()).collect();
    let ticks = names.iter().enumerate().map(|(k, name)| ((count - 1 - k) as f64 + 0.5, name.as_str()));
    let ends = (0.0, count as f64);
    Panel::new(area)
        .x(Axis::linear(0.0, 1.0).ticks(Ticks::none()))
        .y(Axis::linear(ends.0, ends.1).ticks(Ticks::none()))
        .right(Axis::linear(ends.0, ends.1).ticks(Ticks::at(ticks)))
        .layer(Raster::new(1, count, (1..=count as u8).rev().collect(), &BASINS, (0.0, 1.0), ends))
}

/// The boundaries, in their order.
const BOUNDARIES: [Colour; 3] = [Colour::BLUE, Colour::VERMILION, Colour::BLACK];

fn uncertain(boundaries: &[Boundary], area: Rect) -> Panel {
    let ticks = [(1.0, "1"), (2.0, "2"), (4.0, "4"), (8.0, "8"), (16.0, "16")];
    let mut panel = Panel::new(area)
        .x(Axis::log(0.8, 20.0).label("distance (cells)").ticks(Ticks::at(ticks)))
        .y(Axis::log(FLOORS[1], 4.0).label("uncertain share"))
        .letter_in("d", Corner::TopLeft);
    for (boundary, colour) in boundaries.iter().zip(BOUNDARIES) {
        let shares = boundary.scaling.shares.iter().filter(|share| share.uncertain.count() > 0);
        let points: Vec<_> = shares.map(|share| (share.distance as f64, share.uncertain.value())).collect();
        if let BoundaryFit::PowerLaw { exponent, .. } = boundary.scaling.fit {
            // Through the mean of the logarithms, as the fit goes.
            let log = |of: fn(&(f64, f64)) -> f64| {
                points.iter().map(|point| elementary::ln(of(point))).sum::<f64>() / points.len() as f64
            };
            let (x, y) = (log(|point| point.0), log(|point| point.1));
            let at =
                |point: &(f64, f64)| (point.0, elementary::exp(y + exponent * (elementary::ln(point.0) - x)));
            panel = panel.layer(Line::new(points.iter().map(at)).width(0.7).colour(colour));
        }
        let name = format!(r"$\Gamma = {}$, $\epsilon = {}$", boundary.axial_forcing, boundary.restitution);
        panel = panel.layer(Scatter::new(points).marker(Marker::Dot).size(3.0).colour(colour).name(name));
    }
    panel.legend(Legend::at(Corner::BottomRight).without_frame())
}

pub(super) fn draw(data: &ExtraAttractorsData) -> Figure {
    const HEIGHT: f64 = 400.0;
    let areas = [Rect::new(46.0, 12.0, 196.0, 150.0), Rect::new(296.0, 12.0, 196.0, 150.0)];
    let mut figure = Figure::new(DOUBLE_COLUMN, HEIGHT);
    let found = data.sweeps.iter().flat_map(|sweep| sweep.found.iter().flatten());
    let named: Vec<Kind> = found.filter(|own| own.share() >= LEAST).map(|own| own.kind).collect();
    for ((sweep, area), letter) in data.sweeps.iter().zip(areas).zip(["a", "b"]) {
        let panel = shares(sweep, &named, area, letter);
        figure = figure.panel(if letter == "a" {
            panel.legend(Legend::at(Corner::BottomLeft).without_frame())
        } else {
            panel
        });
    }
    figure
        .panel(basins(&data.basins, Rect::new(46.0, 206.0, 220.0, 158.0)))
        .panel(key(&data.basins, Rect::new(274.0, 220.0, 10.0, 130.0)))
        .panel(uncertain(&data.boundaries, Rect::new(362.0, 206.0, 130.0, 158.0)))
}
