//! The torque-speed curve with power and efficiency.

use bouncing_disk::core::numerics::statistics::NORMAL_975;
use bouncing_disk::{Operation, SweepQuantity};
use bouncing_disk_plot::{
    Anchor, Band, Colour, Corner, Figure, Grid, Legend, Line, Margins, Panel, Rule, SINGLE_COLUMN, Scatter,
    Stroke, Text,
};

use super::{axis, spanned, with_room};
use crate::pictures::sweep::prefixed;

/// The share of the lower panel that the legend leaves to the curves.
const UNDER_LEGEND: f64 = 0.68;

/// Two panels over the load: speed, and powers with the efficiency.
pub(crate) fn draw(largest_torque: f64, found: &[Operation]) -> Figure {
    const HEIGHT: f64 = 330.0;
    let margins = Margins { left: 46.0, right: 44.0, top: 10.0, bottom: 34.0 };
    let grid = Grid::new(SINGLE_COLUMN + 30.0, HEIGHT, 2, 1).margins(margins).gaps(10.0, 12.0);
    let loads = || found.iter().map(Operation::load_torque);
    let (torque, torque_unit) = prefixed(loads(), "N m");
    let points = |quantity: SweepQuantity, scale: f64| -> Vec<(f64, f64, f64)> {
        found
            .iter()
            .filter_map(|operation| {
                let estimate = quantity.of(operation)?;
                Some((
                    torque * operation.load_torque(),
                    scale * estimate.value,
                    scale * NORMAL_975 * estimate.standard_error,
                ))
            })
            .collect()
    };
    let speeds = points(SweepQuantity::Speed, 1.0);
    let (first, last) = with_room(loads().map(|load| torque * load));
    let x = || spanned(first, last);
    // Beyond the loads that were asked for there is nothing to see.
    let limit = Some(torque * largest_torque).filter(|limit| (first..=last).contains(limit));
    let rule = || limit.map(|limit| Rule::vertical(limit).stroke(Stroke::new(Colour::DARK_GREY, 0.8)));
    let (slowest, fastest) =
        speeds.iter().fold((0.0_f64, 0.0_f64), |(low, high), point| (low.min(point.1), high.max(point.1)));
    let middle = if speeds.is_empty() { 0.5 } else { 0.5 * (slowest + fastest) };
    let nothing = || {
        let words = Text::at_axes(0.5, 0.6, "no load has a steady speed").anchor(Anchor::Middle);
        speeds.is_empty().then(|| words.size(8.0).halo(Colour::WHITE))
    };
    let upper = Panel::new(grid.cell(0, 0))
        .x(x().without_numbers())
        .y(axis(speeds.iter().flat_map(|point| [point.1 - point.2, point.1 + point.2, 0.0]))
            .label(r"mean speed $\dot{\alpha}$ (rad/s)"))
        .letter_in("a", Corner::BottomLeft)
        .layer(Rule::horizontal(0.0).stroke(Stroke::new(Colour::GREY, 0.5)))
        .layers(rule())
        .layers(curve(&speeds, Colour::BLUE, None))
        .layers(limit.map(|limit| {
            Text::at_data(limit, middle, r"largest torque $\mu m g a_e$")
                .anchor(Anchor::Middle)
                .rotated(90.0)
                .size(7.5)
                .halo(Colour::WHITE)
        }))
        .layers(nothing());
    let powers = || found.iter().filter_map(|own| SweepQuantity::InputPower.of(own)).map(|power| power.value);
    let (power, power_unit) = prefixed(powers(), "W");
    let (input, output) =
        (points(SweepQuantity::InputPower, power), points(SweepQuantity::MechanicalPower, power));
    let efficiency = points(SweepQuantity::Efficiency, 100.0);
    // Both zeros at one height, and room above for the names.
    let ends = |points: &mut dyn Iterator<Item = f64>| {
        points.fold((0.0_f64, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)))
    };
    let (low, high) = ends(&mut input.iter().chain(&output).map(|point| point.1));
    let low = 1.1 * low;
    let high = low + (or_one(high) - low) / UNDER_LEGEND;
    let below = -low / high;
    let best = 1.1 * or_one(ends(&mut efficiency.iter().map(|point| point.1)).1)
        / (UNDER_LEGEND - (1.0 - UNDER_LEGEND) * below).max(0.2);
    let mut lower = Panel::new(grid.cell(1, 0))
        .x(x().label(format!("load torque $T$ ({torque_unit})")))
        .y(spanned(low, high).label(format!("power ({power_unit})")))
        .right(spanned(low / high * best, best).label("efficiency (%)"))
        .letter_in("b", Corner::BottomLeft)
        .layers(rule())
        .layers(curve(&input, Colour::GREY, Some("put in")))
        .layers(curve(&output, Colour::BLUE, Some("mechanical")));
    let share = efficiency.iter().map(|point| (point.0, point.1)).collect::<Vec<_>>();
    lower = lower
        .layer_right(Line::new(share.clone()).width(0.8).colour(Colour::VERMILION))
        .layer_right(Scatter::new(share).size(2.6).colour(Colour::VERMILION).name("efficiency"));
    if !speeds.is_empty() {
        lower = lower.legend(Legend::at(Corner::TopLeft).without_frame().inset(4.0));
    }
    Figure::new(SINGLE_COLUMN + 30.0, HEIGHT).panels([upper, lower])
}

/// The largest value of an axis; where nothing is above zero, one.
fn or_one(largest: f64) -> f64 {
    if largest > 0.0 { largest } else { 1.0 }
}

/// A curve with its band.
fn curve(points: &[(f64, f64, f64)], colour: Colour, name: Option<&str>) -> Vec<bouncing_disk_plot::Layer> {
    let line: Vec<(f64, f64)> = points.iter().map(|point| (point.0, point.1)).collect();
    let band = Band::new(points.iter().map(|(x, y, bar)| (*x, y - bar, y + bar)));
    let dots = Scatter::new(line.clone()).size(2.6).colour(colour);
    let dots = match name {
        Some(name) => dots.name(name),
        None => dots,
    };
    vec![
        band.colour(colour).opacity(0.2).into(),
        Line::new(line).width(0.8).colour(colour).into(),
        dots.into(),
    ]
}
