//! The drawing of Fig. 3.

use bouncing_disk::motion::{EventKind, ModeKind, Transition};
use bouncing_disk_plot::{
    Anchor, Axis, Colour, Corner, Dash, Drawing, Figure, Legend, Line, Marker, Panel, Rect, Scatter, Stroke,
    Style, Text, TextStyle, Ticks,
};

use super::census::Census;
use super::cycle::ChatteringCycle;

const CHART_HEIGHT: f64 = 232.0;
const INSET_HEIGHT: f64 = 150.0;
const CHART_WIDTH: f64 = 366.0;
/// Half the size of a box.
const HALF: (f64, f64) = (44.0, 20.0);
const FLIGHT: (f64, f64) = (82.0, 196.0);
const IMPACT: (f64, f64) = (268.0, 196.0);
const STICKING: (f64, f64) = (82.0, 66.0);
const SLIDING: (f64, f64) = (268.0, 66.0);
/// Half way between the columns.
const BETWEEN: f64 = 175.0;

/// Points and words of an arrow of the chart, in points from the lower left corner.
type ChartArrow = (Vec<(f64, f64)>, Vec<(&'static str, (f64, f64), Anchor)>);

/// The arrow of a transition, if the chart has one; impacts and attachments start at the impact. Long, for it is a table: one
/// arm for each arrow of the chart.
pub(super) fn arrow(transition: Transition) -> Option<ChartArrow> {
    use EventKind::{Attachment, Impact, Separation, SlipReversal, SlipToStick, StickToSlip};
    use ModeKind::{Flight, Sliding, Sticking};
    let (across, up) = HALF;
    let Transition { from, event, to } = transition;
    Some(match (from, event, to) {
        (Flight, Impact, Flight) => (
            vec![(IMPACT.0 - across, IMPACT.1 - 8.0), (FLIGHT.0 + across, FLIGHT.1 - 8.0)],
            vec![
                ("rebound", (BETWEEN, IMPACT.1 - 19.0), Anchor::Middle),
                (r"$\dot{x} > \dot{s}$ or $N \leq 0$", (BETWEEN, IMPACT.1 - 30.0), Anchor::Middle),
            ],
        ),
        (Flight, Attachment, Sliding) => (
            vec![(SLIDING.0, IMPACT.1 - up), (SLIDING.0, SLIDING.1 + up)],
            vec![
                ("attachment", (SLIDING.0 + 5.0, 143.0), Anchor::Left),
                (r"$\dot{x} = \dot{s},\; N > 0,$", (SLIDING.0 + 5.0, 131.0), Anchor::Left),
                (r"$\dot{\alpha} \neq \dot{\beta}$ or", (SLIDING.0 + 5.0, 118.0), Anchor::Left),
                (r"$|\ddot{\beta}| > \ddot{\beta}_{env}$", (SLIDING.0 + 5.0, 104.0), Anchor::Left),
            ],
        ),
        (Flight, Attachment, Sticking) => (
            vec![(IMPACT.0 - 30.0, IMPACT.1 - up), (STICKING.0 + 30.0, STICKING.1 + up)],
            vec![
                ("attachment", (152.0, 138.0), Anchor::Right),
                (r"$\dot{x} = \dot{s},\; N > 0$", (140.0, 126.0), Anchor::Right),
                (
                    r"$\dot{\alpha} = \dot{\beta},\; |\ddot{\beta}| \leq \ddot{\beta}_{env}$",
                    (162.0, 110.0),
                    Anchor::Left,
                ),
            ],
        ),
        (Sticking, Separation, Flight) => (
            vec![(STICKING.0 - 22.0, STICKING.1 + up), (FLIGHT.0 - 22.0, FLIGHT.1 - up)],
            vec![
                ("separation", (STICKING.0 - 26.0, 135.0), Anchor::Right),
                ("$N = 0$", (STICKING.0 - 26.0, 123.0), Anchor::Right),
            ],
        ),
        (Sliding, Separation, Flight) => (
            vec![
                (SLIDING.0, SLIDING.1 - up),
                (SLIDING.0, 16.0),
                (7.0, 16.0),
                (7.0, FLIGHT.1),
                (FLIGHT.0 - across, FLIGHT.1),
            ],
            vec![("separation, $N = 0$", (BETWEEN - 60.0, 6.0), Anchor::Middle)],
        ),
        (Sticking, StickToSlip, Sliding) => (
            vec![(STICKING.0 + across, STICKING.1 + 8.0), (SLIDING.0 - across, SLIDING.1 + 8.0)],
            vec![
                ("stick to slip", (BETWEEN, STICKING.1 + 24.0), Anchor::Middle),
                (r"$|\ddot{\beta}| > \ddot{\beta}_{env}$", (BETWEEN, STICKING.1 + 12.0), Anchor::Middle),
            ],
        ),
        (Sliding, SlipToStick, Sticking) => (
            vec![(SLIDING.0 - across, SLIDING.1 - 8.0), (STICKING.0 + across, STICKING.1 - 8.0)],
            vec![
                ("slip to stick", (BETWEEN, STICKING.1 - 18.0), Anchor::Middle),
                (
                    r"$\dot{\alpha} = \dot{\beta},\; |\ddot{\beta}| \leq \ddot{\beta}_{env}$",
                    (BETWEEN, STICKING.1 - 31.0),
                    Anchor::Middle,
                ),
            ],
        ),
        (Sliding, SlipReversal, Sliding) => (
            vec![
                (SLIDING.0 + across, SLIDING.1 + 9.0),
                (SLIDING.0 + across + 14.0, SLIDING.1 + 9.0),
                (SLIDING.0 + across + 14.0, SLIDING.1 - 9.0),
                (SLIDING.0 + across, SLIDING.1 - 9.0),
            ],
            vec![
                ("slip reversal", (SLIDING.0 + 8.0, SLIDING.1 - 31.0), Anchor::Left),
                (
                    r"$\dot{\alpha} = \dot{\beta},\; |\ddot{\beta}| > \ddot{\beta}_{env}$",
                    (SLIDING.0 + 8.0, SLIDING.1 - 44.0),
                    Anchor::Left,
                ),
            ],
        ),
        _ => return None,
    })
}

fn chart(census: &Census) -> Drawing {
    let area = Rect::new(0.0, 0.0, CHART_WIDTH, CHART_HEIGHT);
    let mut drawing = Drawing::new(area, (0.0, CHART_WIDTH), (0.0, CHART_HEIGHT));
    let stroke = Stroke::new(Colour::BLACK, 0.8);
    let grey = Colour::BLACK.mixed(Colour::WHITE, 0.25);
    // Every flight ends in the impact, from where rebound and attachment go on.
    drawing = drawing
        .arrow([(FLIGHT.0 + HALF.0, FLIGHT.1 + 8.0), (IMPACT.0 - HALF.0, IMPACT.1 + 8.0)], stroke)
        .text((BETWEEN, FLIGHT.1 + 22.0), Anchor::Middle, "collision")
        .text((BETWEEN, FLIGHT.1 + 12.0), Anchor::Middle, "$x = s$")
        .arrow([(CHART_WIDTH - 16.0, IMPACT.1), (IMPACT.0 + HALF.0, IMPACT.1)], stroke)
        .text((CHART_WIDTH - 2.0, IMPACT.1 + 6.0), Anchor::Right, "start");
    for (points, words) in census.transitions.iter().filter_map(|transition| arrow(*transition)) {
        drawing = drawing.arrow(points, stroke);
        for (words, at, anchor) in words {
            drawing = drawing.text(at, TextStyle::new(anchor).size(8.0).colour(grey), words);
        }
    }
    let size = (2.0 * HALF.0, 2.0 * HALF.1);
    let boxes = [
        (FLIGHT, 2.0, ["Flight", r"$\ddot{x} = -g$"], Colour::SKY),
        (IMPACT, 20.0, ["Impact", r"Eqs. (6), (10)"], Colour::ORANGE),
        (STICKING, 2.0, ["Sticking", r"$x = s,\;\dot{\alpha} = \dot{\beta}$"], Colour::GREEN),
        (SLIDING, 2.0, ["Sliding", r"$x = s$, Eq. (12)"], Colour::GREEN),
    ];
    for (centre, corner, lines, colour) in boxes {
        let style = Style::from(stroke).fill(colour.mixed(Colour::WHITE, 0.75));
        drawing = drawing.text_box(centre, size, corner, style, lines);
    }
    drawing
}

fn inset(cycle: &ChatteringCycle) -> Panel {
    let area = Rect::new(40.0, CHART_HEIGHT + 10.0, CHART_WIDTH - 50.0, INSET_HEIGHT - 44.0);
    let points = |heights: &[f64], before: bool| {
        let all = cycle.time_cycles.iter().copied().zip(heights.iter().copied());
        Line::new(all.filter(|(time, _)| (*time < 0.0) == before).collect::<Vec<_>>())
    };
    let curve = |heights: &[f64]| points(heights, false).width(1.1);
    let earlier = |heights: &[f64], colour: Colour| {
        points(heights, true).width(0.8).colour(colour.mixed(Colour::WHITE, 0.5))
    };
    let events = [
        (0.0, cycle.collision_height, "(c)", (-0.02, -0.08), Anchor::RightCentre),
        (cycle.attachment_cycles, cycle.attachment_height, "(a)", (0.015, -0.16), Anchor::LeftCentre),
        (cycle.separation_cycles, cycle.separation_height, "(s)", (-0.02, 0.22), Anchor::RightCentre),
    ];
    let mut panel = Panel::new(area)
        .x(Axis::linear(-0.56, 0.56).label(r"$\omega (t - t_c)/2\pi$").ticks(Ticks::every(0.25)))
        .y(Axis::linear(-1.4, 2.2).label("$x/A$, $s/A$").ticks(Ticks::every(1.0)))
        .title("Inset: one cycle")
        .layer(earlier(&cycle.platform_height, Colour::BLACK))
        .layer(earlier(&cycle.disk_height, Colour::VERMILION).dash(Dash::Dashed))
        .layer(curve(&cycle.platform_height).name("platform"))
        .layer(curve(&cycle.disk_height).colour(Colour::VERMILION).dash(Dash::Dashed).name("disk"))
        .layer(
            Scatter::new(events.iter().map(|event| (event.0, event.1)))
                .marker(Marker::Circle)
                .size(4.0)
                .filled_white(),
        )
        .legend(Legend::at(Corner::TopRight).without_frame());
    for (time, height, name, (right, up), anchor) in events {
        panel = panel.layer(Text::at_data(time + right, height + up, name).anchor(anchor).size(8.0));
    }
    panel
}

pub(super) fn draw(census: &Census, cycle: &ChatteringCycle) -> Figure {
    let height = CHART_HEIGHT + INSET_HEIGHT;
    Figure::new(CHART_WIDTH, height).drawing(chart(census)).panel(inset(cycle))
}
