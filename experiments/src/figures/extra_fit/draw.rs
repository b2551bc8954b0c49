//! The drawing of the figure.

use bouncing_disk_plot::{
    Axis, Band, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Legend, Line, Marker, Panel, Rect, Rule,
    Scatter, Stroke, Ticks,
};

use super::data::{Duration, ExtraFitData};

/// One dot of the mean in so many.
const DOT_EVERY: usize = 4;

/// The last duration shown, in time constants.
const LAST: f64 = 8.4;

pub(super) fn draw(data: &ExtraFitData) -> Figure {
    const HEIGHT: f64 = 215.0;
    let left = Rect::new(40.0, 12.0, 196.0, 165.0);
    let upper = Rect::new(296.0, 12.0, 202.0, 78.0);
    let lower = Rect::new(296.0, 98.0, 202.0, 79.0);
    Figure::new(DOUBLE_COLUMN, HEIGHT).panels([
        transient(data, left),
        intervals(data, upper),
        coverage(data, lower),
    ])
}

fn transient(data: &ExtraFitData, area: Rect) -> Panel {
    let curve = |speeds: &[f64]| -> Vec<(f64, f64)> {
        data.times_s.iter().copied().zip(speeds.iter().copied()).collect()
    };
    let last = data.times_s.last().copied().unwrap_or(1.0);
    let members = data.members_rad_per_s.iter().enumerate().map(|(place, member)| {
        let line = Line::new(curve(member)).colour(Colour::LIGHT_GREY).width(0.4);
        if place == 0 { line.name("members") } else { line }
    });
    let mean: Vec<(f64, f64)> = curve(&data.mean_rad_per_s).into_iter().step_by(DOT_EVERY).collect();
    let mut panel = Panel::new(area)
        .x(Axis::linear(0.0, last).label(r"$t$ (s)").ticks(Ticks::every(1.0).minor(5)))
        .y(Axis::linear(-2.0, 1.35 * data.steady_speed_rad_per_s)
            .label(r"$\dot{\alpha}$ (rad/s)")
            .ticks(Ticks::every(10.0).minor(5)))
        .letter("a")
        .layers(members)
        .layer(
            Line::new(curve(&data.exponential_rad_per_s)).colour(Colour::BLUE).width(1.1).name("exponential"),
        );
    if let Some(ramp) = &data.ramp_rad_per_s {
        panel = panel.layer(
            Line::new(curve(ramp)).colour(Colour::VERMILION).dash(Dash::Dashed).width(0.9).name("ramp"),
        );
    }
    panel.layer(Scatter::new(mean).size(2.6).name("mean")).legend(Legend::at(Corner::BottomRight))
}

fn durations() -> Axis {
    Axis::linear(0.0, LAST).ticks(Ticks::every(2.0).minor(2))
}

fn intervals(data: &ExtraFitData, area: Rect) -> Panel {
    let (low, high) = (0.4, 0.9);
    let found: Vec<_> = data
        .durations
        .iter()
        .filter_map(|duration| duration.time_constant_s.map(|interval| (duration.time_constants, interval)))
        .collect();
    let refused = data
        .durations
        .iter()
        .filter(|duration| duration.time_constant_s.is_none())
        .map(|duration| (duration.time_constants, low + 0.1 * (high - low)));
    let bars = found.iter().flat_map(|(at, interval)| {
        let cap = 0.06;
        [
            Line::new([(*at, interval.low), (*at, interval.high)]).width(0.7),
            Line::new([(at - cap, interval.low), (at + cap, interval.low)]).width(0.7),
            Line::new([(at - cap, interval.high), (at + cap, interval.high)]).width(0.7),
        ]
    });
    Panel::new(area)
        .x(durations().without_numbers())
        .y(Axis::linear(low, high).label(r"$t_c$ (s)").ticks(Ticks::every(0.2).minor(2)))
        .letter_in("b", Corner::TopRight)
        .layer(
            Rule::horizontal(data.time_constant_s)
                .stroke(Stroke::new(Colour::GREY, 0.6).dashed(Dash::Dashed)),
        )
        .layers(bars)
        .layer(
            Scatter::new(found.iter().map(|(at, interval)| (*at, interval.value))).size(4.0).name("fitted"),
        )
        .layer(
            Scatter::new(refused)
                .marker(Marker::Cross)
                .colour(Colour::VERMILION)
                .size(5.0)
                .width(1.0)
                .name("refused"),
        )
        .legend(Legend::at(Corner::TopLeft))
}

fn coverage(data: &ExtraFitData, area: Rect) -> Panel {
    let share = |of: fn(&Duration) -> usize| -> Vec<(f64, f64)> {
        data.durations
            .iter()
            .filter(|duration| 2 * duration.accepted > duration.tried)
            .map(|duration| (duration.time_constants, of(duration) as f64 / duration.accepted as f64))
            .collect()
    };
    let refused = data.durations.iter().enumerate().map(|(place, duration)| {
        let (at, half) = (duration.time_constants, 0.12);
        let height = 1.0 - duration.accepted as f64 / duration.tried as f64;
        let band = Band::new([(at - half, 0.0, height), (at + half, 0.0, height)]);
        let band = band.colour(Colour::ORANGE).opacity(0.6);
        if place == 0 { band.name("refused") } else { band }
    });
    Panel::new(area)
        .x(durations().label(r"duration ($t_c$)"))
        .y(Axis::linear(0.0, 1.3).label("share").ticks(Ticks::every(0.5).minor(5)))
        .letter_in("c", Corner::TopRight)
        .layers(refused)
        .layer(Rule::horizontal(0.95).stroke(Stroke::new(Colour::GREY, 0.6).dashed(Dash::Dashed)))
        .layer(
            Scatter::new(share(|duration| duration.speeds_covered))
                .marker(Marker::Square)
                .colour(Colour::BLUE)
                .size(5.0)
                .name("speed covered"),
        )
        .layer(Scatter::new(share(|duration| duration.constants_covered)).size(3.6).name(r"$t_c$ covered"))
        .legend(Legend::at(Corner::BottomRight))
}
