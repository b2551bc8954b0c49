//! The drawing of the figure.

use bouncing_disk_plot::{
    Anchor, Axis, Colour, Corner, DOUBLE_COLUMN, Dash, Drawing, Figure, Legend, Line, Marker, Panel, Path,
    Rect, Scatter, Stroke, TextStyle, Ticks,
};

use super::data::{Cascade, Constants, ExtraCascadeData};

const COLOURS: [Colour; 3] = [Colour::BLACK, Colour::BLUE, Colour::VERMILION];

/// n of the axes.
const NUMBERS: (f64, f64) = (0.3, 13.7);
const ESTIMATED: (f64, f64) = (6.3, 13.7);

/// What is smaller is drawn here: agreement to the last bit.
const LEAST: f64 = 1e-17;

/// A distance from the known constant that is smaller is drawn here.
const LEAST_DEVIATION: f64 = 1e-12;

pub(super) fn draw(data: &ExtraCascadeData) -> Figure {
    const HEIGHT: f64 = 410.0;
    let areas = [40.0, 212.0, 384.0].map(|left| Rect::new(left, 12.0, 116.0, 170.0));
    let deviations = Axis::log(LEAST_DEVIATION, 1.0);
    let delta = |constants: &Constants| (constants.forcing_ratio, constants.delta, constants.delta_error);
    let alpha = |constants: &Constants| (constants.width_ratio, constants.alpha, constants.alpha_error);
    let b = constants_panel(data, areas[1], data.published_delta, delta)
        .y(deviations.clone().label(r"distance from $\delta$"))
        .letter_in("b", Corner::TopRight);
    let c = constants_panel(data, areas[2], data.published_alpha, alpha)
        .y(deviations.label(r"distance from $\alpha$"))
        .letter_in("c", Corner::TopRight);
    let figure = Figure::new(DOUBLE_COLUMN, HEIGHT).panels([distances(data, areas[0]), b, c]);
    match data.cascades.first() {
        Some(cascade) => figure.drawing(numbers(cascade, Rect::new(8.0, 226.0, DOUBLE_COLUMN - 16.0, 180.0))),
        None => figure,
    }
}

fn distances(data: &ExtraCascadeData, area: Rect) -> Panel {
    let mut panel = Panel::new(area)
        .x(Axis::linear(NUMBERS.0, NUMBERS.1).label("$n$").ticks(Ticks::every(2.0).minor(2)))
        .y(Axis::log(LEAST, 1.0).label(r"$\Gamma_\infty - \Gamma_n$"))
        .letter_in("a", Corner::TopRight)
        .legend(Legend::at(Corner::TopRight).without_frame().inset(18.0));
    for (cascade, colour) in data.cascades.iter().zip(COLOURS) {
        let name = format!(r"$\epsilon = {}$", cascade.restitution);
        let distances = cascade.distances();
        let numbered = |of: fn(&super::data::Doubling) -> f64| {
            cascade
                .doublings
                .iter()
                .map(|doubling| (doubling.number as f64, of(doubling).max(LEAST)))
                .collect::<Vec<_>>()
        };
        panel = panel
            .layer(Line::new(distances.clone()).colour(colour).width(0.5))
            .layer(Scatter::new(distances).size(3.0).colour(colour).name(name.as_str()))
            .layer(
                Line::new(numbered(|doubling| doubling.forcing_error_in_doubles))
                    .colour(colour)
                    .width(0.7)
                    .dash(Dash::Dotted),
            )
            .layer(
                Scatter::new(numbered(|doubling| doubling.true_error_in_doubles))
                    .marker(Marker::Cross)
                    .size(3.0)
                    .width(0.6)
                    .colour(colour),
            );
    }
    panel
}

/// The distances of one constant from what is published.
fn constants_panel(
    data: &ExtraCascadeData,
    area: Rect,
    published: f64,
    of: impl Fn(&Constants) -> (f64, f64, f64),
) -> Panel {
    let mut panel = Panel::new(area)
        .x(Axis::linear(ESTIMATED.0, ESTIMATED.1).label("$n$").ticks(Ticks::every(2.0).minor(2)));
    let off = |value: f64| (value - published).abs().max(LEAST_DEVIATION);
    for (index, (cascade, colour)) in data.cascades.iter().zip(COLOURS).enumerate() {
        // Beside each other.
        let place = |number: usize| number as f64 + 0.18 * (index as f64 - 1.0);
        let (mut ratios, mut values, mut doubles) = (Vec::new(), Vec::new(), Vec::new());
        for estimate in &cascade.estimates {
            let x = place(estimate.number);
            let (ratio, value, error) = of(&estimate.extended);
            ratios.push((x, off(ratio)));
            values.push((x, off(value)));
            doubles.push((x, off(of(&estimate.in_doubles).1)));
            panel = panel.layer(Line::new([(x, off(value)), (x, error)]).colour(colour).width(0.5));
        }
        panel = panel
            .layer(Scatter::new(ratios).marker(Marker::Circle).size(2.8).width(0.6).colour(colour))
            .layer(Scatter::new(values).size(2.8).colour(colour))
            .layer(Scatter::new(doubles).marker(Marker::Cross).size(3.0).width(0.6).colour(colour));
    }
    panel
}

/// The columns of the table: left ends and heads.
const COLUMNS: [(f64, &str); 6] = [
    (0.0, "$n$"),
    (20.0, r"$\Gamma_n$"),
    (168.0, r"$\delta_n$"),
    (240.0, r"$\delta$, extrapolated"),
    (350.0, r"$\alpha_n$"),
    (402.0, r"$\alpha$, extrapolated"),
];

const TEXT: f64 = 7.5;

/// The numbers of one cascade.
fn numbers(cascade: &Cascade, area: Rect) -> Drawing {
    const HEAD: f64 = 11.0;
    const ROW: f64 = 11.6;
    let (width, height) = (area.width, area.height);
    let style = TextStyle::new(Anchor::LeftCentre).size(TEXT);
    let rule = |y: f64| Path::new().move_to(0.0, y).line_to(width, y);
    let mut drawing = Drawing::new(area, (0.0, width), (height, 0.0))
        .text((0.0, -9.0), TextStyle::new(Anchor::LeftCentre).size(9.0), "(d)")
        .stroke(rule(0.0), Stroke::new(Colour::BLACK, 0.5))
        .stroke(rule(HEAD + 2.0), Stroke::new(Colour::BLACK, 0.5));
    for (x, head) in COLUMNS {
        drawing = drawing.text((x + 4.0, 0.5 * HEAD + 1.0), style, head);
    }
    for (row, doubling) in cascade.doublings.iter().enumerate() {
        let y = HEAD + 2.0 + ROW * (row as f64 + 0.6);
        let mut cells = vec![doubling.number.to_string(), doubling.axial_forcing.clone()];
        let (delta, alpha) = cascade.ratios(doubling.number);
        let written = |ratio: Option<f64>| ratio.map_or_else(String::new, |ratio| format!("{ratio:.8}"));
        let estimate = cascade.estimate(doubling.number);
        let extrapolated = |of: fn(&Constants) -> (f64, f64)| {
            estimate.map(of).map_or_else(String::new, |(value, error)| with_error(value, error))
        };
        cells.push(written(delta));
        cells.push(extrapolated(|constants| (constants.delta, constants.delta_error)));
        cells.push(written(alpha));
        cells.push(extrapolated(|constants| (constants.alpha, constants.alpha_error)));
        for ((x, _), cell) in COLUMNS.iter().zip(cells) {
            drawing = drawing.text((x + 4.0, y), style, cell.as_str());
        }
    }
    let last = HEAD + 2.0 + ROW * (cascade.doublings.len() as f64 + 0.2);
    drawing.stroke(rule(last), Stroke::new(Colour::BLACK, 0.5))
}

/// A value with its error in units of the last of its digits, the first one that is uncertain: 4.66920(3).
fn with_error(value: f64, error: f64) -> String {
    let mut decimals = 0_usize;
    let mut unit = 1.0;
    while error < unit && decimals < 14 {
        decimals += 1;
        unit /= 10.0;
    }
    format!("{value:.decimals$}({:.0})", (error / unit).ceil())
}
