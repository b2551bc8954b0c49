//! The drawing of Fig. 3.

use bouncing_disk::{EventKind, ModeKind, Transition};

use super::Fig03Data;
use super::census::Census;
use super::cycle::Cycle;
use crate::draw::{
    Anchor, Axis, Colour, Corner, Dash, Drawing, Figure, Label, Legend, Line, Marker, Panel, Rect, Scatter,
    Stroke, Text, Ticks,
};

const CHART_HEIGHT: f64 = 206.0;
const INSET_HEIGHT: f64 = 150.0;
const CHART_WIDTH: f64 = 318.0;
/// Half the size of a box.
const HALF: (f64, f64) = (43.0, 20.0);
const FLIGHT: (f64, f64) = (74.0, 172.0);
const IMPACT: (f64, f64) = (240.0, 172.0);
const STICKING: (f64, f64) = (74.0, 56.0);
const SLIDING: (f64, f64) = (240.0, 56.0);

/// An arrow of the chart, in points from the lower left corner.
pub(super) struct ChartArrow {
    pub(super) transition: Transition,
    /// Whether the layout has a place for it; one that has none is drawn straight and in colour.
    pub(super) planned: bool,
    points: Vec<(f64, f64)>,
    words: Vec<(&'static str, (f64, f64), Anchor)>,
}

fn place(mode: ModeKind) -> (f64, f64) {
    match mode {
        ModeKind::Flight => FLIGHT,
        ModeKind::Sticking => STICKING,
        ModeKind::Sliding => SLIDING,
    }
}

/// One arrow per transition seen; impacts and attachments start at the impact.
pub(super) fn arrows(census: &Census) -> Vec<ChartArrow> {
    census.transitions.iter().map(|counted| arrow(counted.transition)).collect()
}

fn arrow(transition: Transition) -> ChartArrow {
    use EventKind::{Attachment, Impact, Separation, SlipReversal, SlipToStick, StickToSlip};
    use ModeKind::{Flight, Sliding, Sticking};
    let (across, up) = HALF;
    let Transition { from, event, to } = transition;
    let (points, words) = match (from, event, to) {
        (Flight, Impact, Flight) => (
            vec![(IMPACT.0 - across, IMPACT.1 - 8.0), (FLIGHT.0 + across, FLIGHT.1 - 8.0)],
            vec![
                ("rebound", (157.0, 152.0), Anchor::Middle),
                (r"$\dot{x} > \dot{s}$", (157.0, 142.0), Anchor::Middle),
            ],
        ),
        (Flight, Attachment, Sliding) => (
            vec![(SLIDING.0, IMPACT.1 - up), (SLIDING.0, SLIDING.1 + up)],
            vec![
                ("attachment", (245.0, 124.0), Anchor::Left),
                (r"$\dot{x} = \dot{s}$", (245.0, 111.0), Anchor::Left),
                (r"$\dot{\alpha} \neq \dot{\beta}$", (245.0, 98.0), Anchor::Left),
            ],
        ),
        (Flight, Attachment, Sticking) => (
            vec![(IMPACT.0 - 30.0, IMPACT.1 - up), (STICKING.0 + 30.0, STICKING.1 + up)],
            vec![
                ("attachment", (150.0, 122.0), Anchor::Right),
                (r"$\dot{\alpha} = \dot{\beta}$", (150.0, 92.0), Anchor::Left),
            ],
        ),
        (Sticking, Separation, Flight) => (
            vec![(STICKING.0 - 14.0, STICKING.1 + up), (FLIGHT.0 - 14.0, FLIGHT.1 - up)],
            vec![("separation", (56.0, 117.0), Anchor::Right), ("$N = 0$", (56.0, 105.0), Anchor::Right)],
        ),
        (Sliding, Separation, Flight) => (
            vec![
                (SLIDING.0, SLIDING.1 - up),
                (SLIDING.0, 14.0),
                (7.0, 14.0),
                (7.0, FLIGHT.1),
                (FLIGHT.0 - across, FLIGHT.1),
            ],
            vec![("separation, $N = 0$", (157.0, 4.0), Anchor::Middle)],
        ),
        (Sticking, StickToSlip, Sliding) => (
            vec![(STICKING.0 + across, STICKING.1 + 8.0), (SLIDING.0 - across, SLIDING.1 + 8.0)],
            vec![("stick to slip", (157.0, 68.0), Anchor::Middle)],
        ),
        (Sliding, SlipToStick, Sticking) => (
            vec![(SLIDING.0 - across, SLIDING.1 - 8.0), (STICKING.0 + across, STICKING.1 - 8.0)],
            vec![
                ("slip to stick", (157.0, 52.0), Anchor::Middle),
                (r"$\dot{\alpha} = \dot{\beta}$", (157.0, 34.5), Anchor::Middle),
            ],
        ),
        (Sliding, SlipReversal, Sliding) => (
            vec![
                (SLIDING.0 + across, SLIDING.1 + 9.0),
                (SLIDING.0 + across + 14.0, SLIDING.1 + 9.0),
                (SLIDING.0 + across + 14.0, SLIDING.1 - 9.0),
                (SLIDING.0 + across, SLIDING.1 - 9.0),
            ],
            vec![("slip reversal", (SLIDING.0 + 18.0, SLIDING.1 - 32.0), Anchor::Left)],
        ),
        _ => {
            let points = vec![place(from), place(to)];
            return ChartArrow { transition, planned: false, points, words: Vec::new() };
        }
    };
    ChartArrow { transition, planned: true, points, words }
}

fn chart(data: &Fig03Data) -> Drawing {
    let area = Rect::new(0.0, 0.0, CHART_WIDTH, CHART_HEIGHT);
    let mut drawing = Drawing::new(area, (0.0, CHART_WIDTH), (0.0, CHART_HEIGHT));
    let stroke = Stroke::new(Colour::BLACK, 0.8);
    let grey = Colour::BLACK.mixed(Colour::WHITE, 0.25);
    // Every flight ends in the impact, from where rebound and attachment go on.
    drawing = drawing
        .arrow([(FLIGHT.0 + HALF.0, FLIGHT.1 + 8.0), (IMPACT.0 - HALF.0, IMPACT.1 + 8.0)], stroke)
        .text((157.0, 194.0), Anchor::Middle, "collision")
        .text((157.0, 184.0), Anchor::Middle, "$x = s$");
    for arrow in arrows(&data.census) {
        let colour = if arrow.planned { Colour::BLACK } else { Colour::VERMILION };
        if !arrow.planned {
            let Transition { from, event, to } = arrow.transition;
            let (one, other) = (place(from), place(to));
            let middle = (0.5 * (one.0 + other.0), 0.5 * (one.1 + other.1));
            drawing = drawing.text_styled(
                middle,
                Anchor::Middle,
                Label::plain(&format!("{event:?}")),
                None,
                colour,
                0.0,
            );
        }
        drawing = drawing.arrow(arrow.points, Stroke::new(colour, 0.8));
        for (words, at, anchor) in arrow.words {
            drawing = drawing.text_styled(at, anchor, words, Some(8.0), grey, 0.0);
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
        drawing = drawing.text_box(centre, size, corner, lines, stroke, colour.mixed(Colour::WHITE, 0.75));
    }
    drawing
}

fn inset(cycle: &Cycle) -> Panel {
    let area = Rect::new(40.0, CHART_HEIGHT + 10.0, CHART_WIDTH - 50.0, INSET_HEIGHT - 44.0);
    let curve = |heights: &[f64]| {
        Line::new(cycle.time_cycles.iter().copied().zip(heights.iter().copied()).collect::<Vec<_>>())
    };
    let events = [
        (cycle.collision_cycles, cycle.collision_height, "(c)", (-0.02, -0.08), Anchor::RightCentre),
        (cycle.attachment_cycles, cycle.attachment_height, "(a)", (0.015, -0.16), Anchor::LeftCentre),
        (cycle.separation_cycles, cycle.separation_height, "(s)", (-0.015, 0.10), Anchor::RightCentre),
    ];
    let mut panel = Panel::new(area)
        .x(Axis::linear(0.0, 1.05).label(r"$\omega t/2\pi$").ticks(Ticks::every(0.25)))
        .y(Axis::linear(-1.4, 2.2).label("$x/A$, $s/A$").ticks(Ticks::every(1.0)))
        .letter("a")
        .layer(curve(&cycle.platform_height).width(1.1).name("platform"))
        .layer(curve(&cycle.disk_height).colour(Colour::VERMILION).dash(Dash::Dashed).width(1.1).name("disk"))
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

pub(super) fn figure(data: &Fig03Data) -> Figure {
    let height = CHART_HEIGHT + INSET_HEIGHT;
    Figure::new(CHART_WIDTH, height).drawing(chart(data)).panel(inset(&data.cycle))
}
