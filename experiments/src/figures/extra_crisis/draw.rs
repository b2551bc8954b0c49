//! The drawing of the figure.

use bouncing_disk_plot::{
    Axis, Colour, DOUBLE_COLUMN, Dash, DensePoints, Figure, Line, Marker, Panel, Rect, Scatter, Ticks,
};

use super::data::{ExtraCrisisData, Spot};

/// What panel (a) shows: phases in periods, normalised speeds.
const PHASES: (f64, f64) = (-0.12, 0.32);
const SPEEDS: (f64, f64) = (0.95, 1.65);
/// Half the width and the height of panel (b).
const MAGNIFIED: (f64, f64) = (0.006, 0.010);

/// Points of the lines of panel (c).
const POINTS: usize = 60;

pub(super) fn draw(data: &ExtraCrisisData) -> Figure {
    const HEIGHT: f64 = 232.0;
    let panels = [
        plane(data, Rect::new(42.0, 14.0, 150.0, 180.0), PHASES, SPEEDS, "a").layer(
            Scatter::new(data.tangency.iter().copied())
                .marker(Marker::Cross)
                .size(3.5)
                .width(0.7)
                .colour(Colour::BLACK),
        ),
        magnified(data, Rect::new(240.0, 14.0, 108.0, 180.0)),
        lives(data, Rect::new(402.0, 14.0, 100.0, 180.0)),
    ];
    Figure::new(DOUBLE_COLUMN, HEIGHT).panels(panels)
}

/// A part of the plane with attractor, manifolds and saddle.
fn plane(data: &ExtraCrisisData, area: Rect, x: (f64, f64), y: (f64, f64), letter: &'static str) -> Panel {
    let steps = if x.1 - x.0 > 0.1 { (0.1, 0.2) } else { (0.005, 0.005) };
    let mut panel = Panel::new(area)
        .x(Axis::linear(x.0, x.1).label(r"$\tau_{imp}/2\pi$").ticks(Ticks::every(steps.0).minor(2)))
        .y(Axis::linear(y.0, y.1).label(r"$|w_A\Gamma/(\omega A)|$").ticks(Ticks::every(steps.1).minor(2)))
        .letter(letter);
    let shown = |pieces: &[Vec<Spot>]| -> Vec<Vec<Spot>> { visible(pieces, x, y) };
    for piece in shown(&data.stable) {
        panel = panel.layer(Line::new(piece).width(0.6).colour(Colour::BLUE));
    }
    panel = panel.layer(DensePoints::new(data.attractor.iter().copied()).colour(Colour::BLACK).radius(0.35));
    if letter == "b" {
        for piece in shown(&data.unstable) {
            panel = panel.layer(Line::new(piece).width(0.6).colour(Colour::VERMILION));
        }
    }
    panel.layer(
        Scatter::new(data.saddle.iter().copied())
            .marker(Marker::Circle)
            .size(5.0)
            .width(1.0)
            .colour(Colour::VERMILION),
    )
}

fn magnified(data: &ExtraCrisisData, area: Rect) -> Panel {
    let (phase, speed) = data.magnified;
    let x = (phase - MAGNIFIED.0, phase + MAGNIFIED.0);
    let y = (speed - MAGNIFIED.1, speed + MAGNIFIED.1);
    plane(data, area, x, y, "b").layer(
        Scatter::new(data.tangency.iter().copied())
            .marker(Marker::Cross)
            .size(4.0)
            .width(0.8)
            .colour(Colour::BLACK),
    )
}

fn lives(data: &ExtraCrisisData, area: Rect) -> Panel {
    let known: Vec<_> = data.lives.lives.iter().filter(|life| life.ended > 0).collect();
    let (mut least, mut most) = (f64::MAX, 0.0_f64);
    let (mut near, mut far) = (f64::MAX, 0.0_f64);
    for life in &known {
        (least, most) = (least.min(life.impacts), most.max(life.impacts));
        (near, far) = (near.min(life.beyond), far.max(life.beyond));
    }
    let mut panel = Panel::new(area)
        .x(Axis::log(0.5 * near, 2.0 * far).label(r"$\Gamma-\Gamma_c$"))
        .y(Axis::log(0.5 * least, 8.0 * most).label("mean life (impacts)"))
        .letter("c");
    let points = known.iter().map(|life| (life.beyond, life.impacts));
    let errors = known.iter().map(|life| life.relative_error * life.impacts);
    panel = panel.layer(Scatter::new(points).size(2.0).colour(Colour::BLACK).errors_y(errors));
    if let Ok(law) = &data.lives.scaling {
        let ratio = (law.range.1 / law.range.0).sqrt();
        let middle = law.range.0 * ratio;
        let along = |exponent: f64| {
            let (near, far, height) = (law.range.0, law.range.1, law.at(middle));
            (0..=POINTS).map(move |k| {
                let share = k as f64 / POINTS as f64;
                let x = near * bouncing_disk::core::elementary::pow(far / near, share);
                (x, height * bouncing_disk::core::elementary::pow(x / middle, exponent))
            })
        };
        panel = panel.layer(Line::new(along(law.exponent)).width(0.8).colour(Colour::VERMILION));
        if let Some(expected) = data.expected_exponent {
            panel =
                panel.layer(Line::new(along(-expected)).width(0.8).colour(Colour::BLUE).dash(Dash::Dashed));
        }
    }
    panel
}

/// The parts of the pieces within a window: the neighbours just outside among them.
fn visible(pieces: &[Vec<Spot>], x: (f64, f64), y: (f64, f64)) -> Vec<Vec<Spot>> {
    let inside = |spot: &Spot| spot.0 >= x.0 && spot.0 <= x.1 && spot.1 >= y.0 && spot.1 <= y.1;
    let mut shown = Vec::new();
    for piece in pieces {
        let mut current: Vec<Spot> = Vec::new();
        for (i, spot) in piece.iter().enumerate() {
            let beside = |k: Option<usize>| k.and_then(|k| piece.get(k)).is_some_and(inside);
            if inside(spot) || beside(i.checked_sub(1)) || beside(Some(i + 1)) {
                current.push(*spot);
            } else if current.len() > 1 {
                shown.push(std::mem::take(&mut current));
            } else {
                current.clear();
            }
        }
        if current.len() > 1 {
            shown.push(current);
        }
    }
    shown
}
