//! The drawing of the figure.

use std::f64::consts::PI;

use bouncing_disk_plot::{
    Axis, Band, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Legend, Line, Marker, Panel, Rect, Scatter,
    Ticks,
};

use super::data::{Best, Curve, ExtraDesignData};

/// Colour and dashes of the limits, as the data have them.
const STYLES: [(Colour, Dash); 3] =
    [(Colour::BLACK, Dash::Solid), (Colour::BLUE, Dash::Dashed), (Colour::VERMILION, Dash::Dotted)];

pub(super) fn draw(data: &ExtraDesignData) -> Figure {
    const HEIGHT: f64 = 215.0;
    let left = Rect::new(40.0, 12.0, 210.0, 165.0);
    let upper = Rect::new(306.0, 12.0, 192.0, 78.0);
    let lower = Rect::new(306.0, 98.0, 192.0, 79.0);
    let frequencies = || Axis::linear(8.6, 16.4).ticks(Ticks::every(2.0).minor(2));
    let hand = &data.table_one;
    let circle = |value: f64| {
        Scatter::new([(hand.angular_frequency, value)])
            .marker(Marker::Circle)
            .colour(Colour::GREEN)
            .size(6.0)
            .width(1.2)
    };
    let most = data
        .curves
        .iter()
        .flat_map(|curve| &curve.points)
        .map(|point| point.robustness.digits.most)
        .fold(0.0, f64::max);
    let bands = data.curves.iter().zip(STYLES).map(|(curve, (colour, _))| {
        Band::new(curve.points.iter().map(|point| {
            let digits = point.robustness.digits;
            (point.design.hand.angular_frequency, digits.least, digits.most)
        }))
        .colour(colour)
        .opacity(0.15)
    });
    let named = data.curves.iter().zip(STYLES).map(|(curve, style)| {
        let name =
            curve.highest_flight_m.map_or("any height".to_owned(), |height| format!("at most {height} m"));
        line(curve, style, |point| point.design.value).name(name)
    });
    let plain = |of: fn(&Best) -> f64| -> Vec<Line> {
        data.curves.iter().zip(STYLES).map(|(curve, style)| line(curve, style, of)).collect()
    };
    let speeds = Panel::new(left)
        .x(frequencies().label(r"$\omega$ (rad/s)"))
        .y(Axis::linear(0.0, 1.12 * most).label(r"airborne speed $\dot{\alpha}_f$ (rad/s)"))
        .letter_in("a", Corner::TopRight)
        .layers(bands)
        .layers(named)
        .layer(circle(data.table_one_worst_rad_per_s).name("Table I"))
        .legend(Legend::at(Corner::BottomRight));
    let angles = Panel::new(upper)
        .x(frequencies().without_numbers())
        .y(Axis::linear(0.0, 0.5).label(r"$\phi_L/\pi$").ticks(Ticks::every(0.25).minor(5)))
        .letter_in("b", Corner::BottomRight)
        .layers(plain(|point| point.design.hand.amplitude_angle / PI))
        .layer(circle(hand.amplitude_angle / PI));
    let lags = Panel::new(lower)
        .x(frequencies().label(r"$\omega$ (rad/s)"))
        .y(Axis::linear(-0.1, 0.1).label(r"$\theta/\pi$").ticks(Ticks::every(0.1).minor(5)))
        .letter_in("c", Corner::BottomRight)
        .layers(plain(|point| point.design.hand.phase_lag / PI))
        .layer(circle(hand.phase_lag / PI));
    Figure::new(DOUBLE_COLUMN, HEIGHT).panels([speeds, angles, lags])
}

fn line(curve: &Curve, (colour, dash): (Colour, Dash), of: fn(&Best) -> f64) -> Line {
    Line::new(curve.points.iter().map(|point| (point.design.hand.angular_frequency, of(point))))
        .colour(colour)
        .dash(dash)
        .width(1.0)
}
