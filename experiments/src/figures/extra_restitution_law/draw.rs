//! The drawing of the figure.

use bouncing_disk_plot::{
    Anchor, Axis, Band, Colour, Corner, DOUBLE_COLUMN, Dash, DensePoints, Figure, Grid, Legend, Line,
    Margins, Panel, Rule, Scatter, Stroke, Text, Ticks,
};

use super::data::{ExtraRestitutionLawData, Followed};

pub(super) fn draw(data: &ExtraRestitutionLawData) -> Figure {
    const HEIGHT: f64 = 205.0;
    let margins = Margins { left: 42.0, right: 10.0, top: 12.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 1, 3)
        .margins(margins)
        .gaps(14.0, 10.0)
        .column_weights(&[1.0, 1.0, 0.85]);
    let left = grid.cell(0, 0);
    let middle = grid.cell(0, 1);
    let mut right = grid.cell(0, 2);
    // The third panel has numbers and a label of its own.
    right.left += 34.0;
    right.width -= 34.0;
    Figure::new(DOUBLE_COLUMN, HEIGHT).panels([
        diagram(data, Panel::new(left), &data.constant, "a", "constant"),
        diagram(data, Panel::new(middle), &data.viscoelastic, "b", "viscoelastic"),
        laws(data, Panel::new(right)),
    ])
}

fn diagram(
    data: &ExtraRestitutionLawData,
    panel: Panel,
    followed: &Followed,
    letter: &str,
    name: &str,
) -> Panel {
    let (from, to) = data.axial_forcing_range;
    let y = Axis::linear(-0.06, 0.3).ticks(Ticks::every(0.1).minor(2));
    let y = if letter == "a" { y.label(r"$\tau_{imp}/2\pi$") } else { y.without_numbers() };
    let dots: Vec<(f64, f64)> = followed
        .columns
        .iter()
        .flat_map(|column| {
            column.impact_phase_cycles.iter().map(|phase| (column.axial_forcing, shown(*phase)))
        })
        .collect();
    let doubling = Stroke::new(Colour::BLUE, 0.6).dashed(Dash::Dashed);
    let mut panel = panel
        .x(Axis::linear(from, to).label(r"$\Gamma$").ticks(Ticks::every(0.1).minor(5)))
        .y(y)
        .letter(letter)
        .layer(DensePoints::new(dots).colour(Colour::rgb(40, 40, 40)).radius(0.3))
        .layer(Rule::vertical(followed.first_doubling).stroke(doubling))
        .layer(Text::at_axes(0.15, 0.915, name).anchor(Anchor::Left).size(8.5));
    if let Some(lost) = followed.lost_at {
        panel = panel
            .layer(Rule::vertical(lost).stroke(Stroke::new(Colour::VERMILION, 0.6).dashed(Dash::Dotted)));
    }
    panel
}

/// A phase in periods, from -1/2 on: the attractor passes zero.
fn shown(phase: f64) -> f64 {
    if phase > 0.5 { phase - 1.0 } else { phase }
}

fn laws(data: &ExtraRestitutionLawData, panel: Panel) -> Panel {
    let last = data.restitution_by_normalised_speed.last().map_or(1.0, |point| point.0);
    let speeds =
        data.viscoelastic.columns.iter().flat_map(|column| column.normalised_impact_speed.iter().copied());
    let (slow, fast) =
        speeds.fold((f64::INFINITY, 0.0_f64), |(low, high), speed| (low.min(speed), high.max(speed)));
    let restitution = data.law.reference_restitution();
    let reference = data.law.reference_speed() / std::f64::consts::PI;
    panel
        .x(Axis::linear(0.0, last).label(r"$|w_A\Gamma/(\omega A)|$").ticks(Ticks::every(1.0).minor(5)))
        .y(Axis::linear(0.0, 1.0).label(r"restitution $\epsilon$").ticks(Ticks::every(0.2).minor(2)))
        .letter_in("c", Corner::BottomLeft)
        .layer(Band::new([(slow, 0.0, 1.0), (fast, 0.0, 1.0)]).colour(Colour::PALE_GREY).opacity(0.8))
        .layer(
            Line::new([(0.0, restitution), (last, restitution)])
                .dash(Dash::Dashed)
                .colour(Colour::DARK_GREY)
                .name("constant"),
        )
        .layer(Line::new(data.restitution_by_normalised_speed.iter().copied()).name("viscoelastic"))
        .layer(Scatter::new([(reference, restitution)]).size(5.0))
        .legend(Legend::at(Corner::TopRight))
}
