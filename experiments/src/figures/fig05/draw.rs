//! The drawing of Fig. 5: a row for each quantity, a column for each amplitude ratio.

use bouncing_disk_plot::{
    Anchor, Axis, Band, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Grid, Legend, Line, Margins, Panel,
    Rule, Stroke, Text, Ticks,
};

use super::tosses::{Column, Toss};

const HEIGHT: f64 = 400.0;
/// The phase lags of the caption.
const LAGS: [(Colour, &str); 2] =
    [(Colour::BLUE, r"$\theta_1 = 0$"), (Colour::VERMILION, r"$\theta_2 = \pi/2$")];

/// A quantity of hand and dough, and its axis: the ends, the step of the numbers and the name.
struct Row {
    of: [fn(&Toss) -> &[f64]; 2],
    ends: (f64, f64),
    step: f64,
    label: &'static str,
    /// The end of the time axis (s): a whole toss for the heights, the contact and what follows for the angles.
    last: f64,
}

const ROWS: [Row; 3] = [
    Row {
        of: [|toss| &toss.hand_height_m, |toss| &toss.dough_height_m],
        ends: (-0.35, 0.95),
        step: 0.25,
        label: "height (m)",
        last: 0.9,
    },
    Row {
        of: [|toss| &toss.hand_angle_rad, |toss| &toss.dough_angle_rad],
        ends: (-2.4, 4.8),
        step: 1.0,
        label: "angle (rad)",
        last: 0.32,
    },
    Row {
        of: [|toss| &toss.hand_speed_rad_per_s, |toss| &toss.dough_speed_rad_per_s],
        ends: (-30.0, 38.0),
        step: 10.0,
        label: "angular speed (rad/s)",
        last: 0.32,
    },
];

pub(super) fn draw(columns: &[Column]) -> Figure {
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 3, 3)
        .margins(Margins { left: 40.0, right: 10.0, top: 18.0, bottom: 30.0 })
        .gaps(10.0, 36.0);
    let mut figure = Figure::new(DOUBLE_COLUMN, HEIGHT);
    for (index, row) in ROWS.iter().enumerate() {
        for (letter, column) in columns.iter().enumerate() {
            let mut panel = framed(Panel::new(grid.cell(index, letter)), row, &column.tosses[0], letter == 0);
            panel =
                if index == 0 { heights(panel, row, column, letter) } else { rotation(panel, row, column) };
            let legend = |corner| Legend::at(corner).without_frame().inset(2.0);
            panel = match (index, letter) {
                (0, 2) => panel.legend(legend(Corner::BottomRight)),
                (1, 0) => panel.legend(legend(Corner::TopRight)),
                _ => panel,
            };
            figure = figure.panel(panel);
        }
    }
    figure
}

/// Axes, the time in contact, and the line at zero.
fn framed(panel: Panel, row: &Row, toss: &Toss, labelled: bool) -> Panel {
    let (low, high) = row.ends;
    let axis = Axis::linear(low, high).label(row.label).ticks(Ticks::every(row.step)).label_distance(25.0);
    let ticks = Ticks::every(if row.last > 0.5 { 0.2 } else { 0.1 });
    let separation = toss.separation_time_s;
    panel
        .x(Axis::linear(0.0, row.last).label("$t$ (s)").ticks(ticks))
        .y(if labelled { axis } else { axis.label("").without_numbers() })
        .layer(Band::new([(0.0, low, high), (separation, low, high)]).colour(Colour::PALE_GREY).opacity(0.7))
        .layer(Rule::horizontal(0.0).stroke(Stroke::new(Colour::LIGHT_GREY, 0.5)))
        .layer(Rule::vertical(separation).stroke(Stroke::new(Colour::GREY, 0.7).dashed(Dash::Dotted)))
}

/// The curves of hand and dough.
fn curves(row: &Row, toss: &Toss, colour: Colour) -> [Line; 2] {
    let curve = |values: &[f64]| {
        let points = toss.time_s.iter().copied().zip(values.iter().copied());
        Line::new(points.collect::<Vec<_>>()).width(1.2).colour(colour)
    };
    let [hand, dough] = row.of.map(|of| curve(of(toss)));
    [hand.dash(Dash::Dashed), dough]
}

/// Both phase lags have the same heights.
fn heights(panel: Panel, row: &Row, column: &Column, letter: usize) -> Panel {
    let toss = &column.tosses[0];
    let [hand, dough] = curves(row, toss, Colour::BLACK);
    let (low, high) = row.ends;
    let separation = toss.separation_time_s + 0.012 * row.last;
    let name = Text::at_data(separation, low + 0.12 * (high - low), r"$t_{sep}$");
    // The time that the lower rows show.
    let (shown, top) = (ROWS[1].last, high - 0.08);
    let bracket = Line::new([(0.0, top - 0.05), (0.0, top), (shown, top), (shown, top - 0.05)]);
    let below = Text::at_data(shown + 0.012, top - 0.03, "lower rows");
    let ratio = column.printed.replace('π', r"\pi");
    panel
        .layer(hand.name("hand"))
        .layer(dough.name("dough"))
        .title(format!(r"({}) $\phi_L = {ratio}$", ["a", "b", "c"][letter]))
        .layer(name.anchor(Anchor::LeftCentre).size(8.0))
        .layer(bracket.colour(Colour::GREY).width(0.8))
        .layer(below.anchor(Anchor::LeftCentre).size(8.0))
}

fn rotation(panel: Panel, row: &Row, column: &Column) -> Panel {
    column.tosses.iter().zip(LAGS).fold(panel, |panel, (toss, (colour, lag))| {
        let [hand, dough] = curves(row, toss, colour);
        panel.layer(hand).layer(dough.name(lag))
    })
}
