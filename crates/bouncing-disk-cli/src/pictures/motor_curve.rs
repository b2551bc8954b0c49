//! The torque-speed curve with power and efficiency.

use bouncing_disk::core::numerics::statistics::NORMAL_975;
use bouncing_disk::motor::{Operation, SweepQuantity};
use bouncing_disk_plot::{
    Anchor, Band, Colour, Corner, Figure, Grid, Legend, Line, Margins, Marker, Panel, Rule, SINGLE_COLUMN,
    Scatter, Stroke, Text,
};

use super::{spanned, with_room};
use crate::output::numbers::shown;
use crate::pictures::sweep::prefixed;

/// The share of the lower panel that the legend leaves to the curves.
const UNDER_LEGEND: f64 = 0.68;

/// The distance of the foot of a rotated name from its rule (points): room for what is below its line.
const NEXT_TO_RULE: f64 = 3.0;

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
        with_room(speeds.iter().flat_map(|point| [point.1 - point.2, point.1 + point.2, 0.0]));
    // To the left of a rule, where nothing but the curve is: at the upper end, or in the middle of what is
    // below zero.
    let beside = |load: f64, label: String, below_zero: bool| {
        let left = (load - first) / (last - first) - NEXT_TO_RULE / grid.cell(0, 0).width;
        let (height, anchor) = if below_zero {
            (-0.5 * slowest / (fastest - slowest), Anchor::Middle)
        } else {
            (0.97, Anchor::Right)
        };
        Text::at_axes(left, height, label).anchor(anchor).rotated(90.0).size(7.5).halo(Colour::WHITE)
    };
    let stall = stall(&speeds);
    let stall_rule = || stall.map(|stall| Rule::vertical(stall).stroke(Stroke::new(Colour::GREY, 0.5)));
    // Two digits are what a straight line between two loads is good for.
    let stall_name = |stall: f64| {
        let rounded = format!("{stall:.1e}").parse().unwrap_or(stall);
        // Where there is more room; left of the stall the speed is above zero.
        beside(stall, format!("stall, {} {torque_unit}", shown(rounded)), -slowest > fastest)
    };
    let nothing = || {
        let words = Text::at_axes(0.5, 0.6, "no load has a steady speed").anchor(Anchor::Middle);
        speeds.is_empty().then(|| words.size(8.0).halo(Colour::WHITE))
    };
    let upper = Panel::new(grid.cell(0, 0))
        .x(x().without_numbers())
        .y(spanned(slowest, fastest).label(r"mean speed $\dot{\alpha}$ (rad/s)"))
        .letter_in("a", Corner::BottomLeft)
        .layer(Rule::horizontal(0.0).stroke(Stroke::new(Colour::GREY, 0.5)))
        .layers(rule())
        .layers(stall_rule())
        .layers(curve(&speeds, Colour::BLUE, None))
        .layers(stall.map(|stall| {
            Scatter::new([(stall, 0.0)]).marker(Marker::Circle).size(4.5).colour(Colour::BLUE).filled_white()
        }))
        .layers(stall.map(stall_name))
        .layers(limit.map(|limit| beside(limit, r"largest torque $\mu m g a_e$".to_owned(), false)))
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
        .layers(stall_rule())
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

/// The load at which the motor stops, on the straight line between the two loads (each with its speed and the
/// half width of an interval) at which it turns to opposite sides; `None` where nothing tells the two speeds
/// apart.
fn stall(speeds: &[(f64, f64, f64)]) -> Option<f64> {
    speeds.windows(2).find_map(|pair| {
        let [(load, speed, bar), (next_load, next, next_bar)] = *pair else { return None };
        let stops = (speed > 0.0) != (next > 0.0) && (speed - next).abs() > bar + next_bar;
        stops.then(|| load + (next_load - load) * speed / (speed - next))
    })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stall_lies_where_the_speed_changes_its_sign() {
        let at = |points: &[(f64, f64, f64)]| stall(points);
        assert_eq!(at(&[(0.0, 8.0, 0.1), (1.0, 3.0, 0.1), (2.0, -1.0, 0.1), (3.0, -9.0, 0.1)]), Some(1.75));
        assert_eq!(at(&[(0.0, -3.0, 0.1), (1.0, 0.0, 0.1), (2.0, 3.0, 0.1)]), Some(1.0));
        // It always lies within the loads, and a motor that does not turn has none.
        for none in [&[][..], &[(0.0, 8.0, 0.1)], &[(0.0, 8.0, 0.1), (1.0, 7.0, 0.1)]] {
            assert_eq!(at(none), None);
        }
        assert_eq!(at(&[(0.0, 0.1, 0.3), (1.0, -0.1, 0.3)]), None);
    }
}
