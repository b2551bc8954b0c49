//! The drawing of Fig. 5.

use bouncing_disk_plot::{
    Anchor, Axis, Band, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Grid, Legend, Line, Margins, Panel,
    Rule, Stroke, Text, Ticks,
};

use super::data::{Column, Fig05Data, Toss};

const HEIGHT: f64 = 400.0;
/// The end of the time axes (s): a whole toss for the heights, the contact and what follows for the angles.
const LAST_TIME: [f64; 3] = [0.9, 0.32, 0.32];
const COLOURS: [Colour; 2] = [Colour::BLUE, Colour::VERMILION];
const LAGS: [&str; 2] = [r"$\theta_1 = 0$", r"$\theta_2 = \pi/2$"];

/// One row: what is drawn, and on which axis.
struct Row {
    hand: fn(&Toss) -> &[f64],
    dough: fn(&Toss) -> &[f64],
    axis: Axis,
    low: f64,
    high: f64,
}

impl Row {
    /// With an axis over (`low`, `high`) that has a number every `step`.
    fn new([hand, dough]: [fn(&Toss) -> &[f64]; 2], (low, high): (f64, f64), step: f64, label: &str) -> Self {
        let axis = Axis::linear(low, high).label(label).ticks(Ticks::every(step)).label_distance(25.0);
        Self { hand, dough, axis, low, high }
    }
}

fn rows() -> [Row; 3] {
    [
        Row::new(
            [|toss| &toss.hand_height_m, |toss| &toss.dough_height_m],
            (-0.35, 0.95),
            0.25,
            "height (m)",
        ),
        Row::new(
            [|toss| &toss.hand_angle_rad, |toss| &toss.dough_angle_rad],
            (-2.4, 4.8),
            1.0,
            "angle (rad)",
        ),
        Row::new(
            [|toss| &toss.hand_speed_rad_per_s, |toss| &toss.dough_speed_rad_per_s],
            (-30.0, 38.0),
            10.0,
            "angular speed (rad/s)",
        ),
    ]
}

fn curve(toss: &Toss, values: &[f64]) -> Line {
    Line::new(toss.time_s.iter().copied().zip(values.iter().copied()).collect::<Vec<_>>()).width(1.2)
}

fn panel(mut panel: Panel, column: &Column, row: &Row, index: usize, letter: usize) -> Panel {
    let last = LAST_TIME[index];
    let step = if last > 0.5 { 0.2 } else { 0.1 };
    let y = if letter == 0 { row.axis.clone() } else { row.axis.clone().label("").without_numbers() };
    panel = panel.x(Axis::linear(0.0, last).label("$t$ (s)").ticks(Ticks::every(step))).y(y);
    let Some(first) = column.tosses.first() else { return panel };
    let contact = [(0.0, row.low, row.high), (first.separation_time_s, row.low, row.high)];
    panel = panel
        .layer(Band::new(contact).colour(Colour::PALE_GREY).opacity(0.7))
        .layer(Rule::horizontal(0.0).stroke(Stroke::new(Colour::LIGHT_GREY, 0.5)))
        .layer(
            Rule::vertical(first.separation_time_s)
                .stroke(Stroke::new(Colour::GREY, 0.7).dashed(Dash::Dotted)),
        );
    // Both phase lags have the same heights.
    let shown = if index == 0 { 1 } else { column.tosses.len() };
    for (toss, (colour, lag)) in column.tosses.iter().zip(COLOURS.into_iter().zip(LAGS)).take(shown) {
        let colour = if index == 0 { Colour::BLACK } else { colour };
        let (hand, dough) = (curve(toss, (row.hand)(toss)), curve(toss, (row.dough)(toss)));
        let hand = hand.colour(colour).dash(Dash::Dashed);
        let dough = dough.colour(colour);
        panel = match index {
            0 => panel.layer(hand.name("hand")).layer(dough.name("dough")),
            _ => panel.layer(hand).layer(dough.name(lag)),
        };
    }
    match (index, letter) {
        (0, 2) | (1, 0) => panel = panel.legend(Legend::at(Corner::TopRight).without_frame().inset(2.0)),
        _ => {}
    }
    if index == 0 {
        let name = format!(r"$\phi_L = {}$", column.printed.replace('π', r"\pi"));
        let sep = Text::at_data(
            first.separation_time_s + 0.012 * last,
            row.low + 0.12 * (row.high - row.low),
            r"$t_{sep}$",
        );
        panel = panel
            .title(format!("({}) {name}", ["a", "b", "c"][letter]))
            .layer(sep.anchor(Anchor::LeftCentre).size(8.0));
    }
    panel
}

pub(super) fn draw(data: &Fig05Data) -> Figure {
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 3, 3)
        .margins(Margins { left: 40.0, right: 10.0, top: 18.0, bottom: 30.0 })
        .gaps(10.0, 36.0);
    let mut figure = Figure::new(DOUBLE_COLUMN, HEIGHT);
    for (index, row) in rows().iter().enumerate() {
        for (letter, column) in data.columns.iter().enumerate() {
            figure = figure.panel(panel(Panel::new(grid.cell(index, letter)), column, row, index, letter));
        }
    }
    figure
}
