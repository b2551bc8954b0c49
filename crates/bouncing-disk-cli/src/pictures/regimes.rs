//! The map of verdicts over forcing and restitution, with a key; a strip where the restitution is one.

use bouncing_disk_plot::{Axis, Colour, DOUBLE_COLUMN, Figure, Panel, Raster, Rect, Ticks};

use super::math;
use crate::commands::verdicts::Kind;
use crate::range::Range;

const fn colour(kind: Kind) -> Colour {
    match kind {
        Kind::AtRest => Colour::PALE_GREY,
        Kind::ExactCycle => Colour::WHITE,
        Kind::LongCycle => Colour::rgb(250, 225, 160),
        Kind::PeriodOne => Colour::BLUE,
        Kind::PeriodTwo => Colour::SKY,
        Kind::PeriodThree => Colour::GREEN,
        Kind::LongerPeriod => Colour::PURPLE,
        Kind::Chaotic => Colour::VERMILION,
        Kind::Undecided => Colour::BLACK,
        Kind::NoStart => Colour::GREY,
    }
}

/// The name in the key, which has little room.
const fn short(kind: Kind) -> &'static str {
    match kind {
        Kind::LongCycle => "same, by rounding",
        Kind::LongerPeriod => r"period $\geq 4$",
        other => other.name(),
    }
}

/// The map: kinds row by row, a row for each restitution.
pub(crate) fn draw(forcings: Range, restitutions: Range, kinds: &[Kind]) -> Figure {
    let strip = restitutions.count() == 1;
    let frame = if strip { 120.0 } else { 256.0 };
    let height = frame + 46.0;
    let area = Rect::new(44.0, 10.0, 346.0, frame);
    let (x, y) = (forcings.cell_ends(0.01), restitutions.cell_ends(1.0));
    let place = |kind: &Kind| Kind::ALL.iter().position(|own| own == kind).unwrap_or_default() as u8;
    let palette = Kind::ALL.map(colour);
    let cells = kinds.iter().map(place).collect();
    let vertical = match restitutions.only() {
        Some(only) => {
            let middle = 0.5 * (y.0 + y.1);
            Axis::linear(y.0, y.1).ticks(Ticks::at([(middle, format!("${}$", math(only)))]).minor(1))
        }
        None => Axis::linear(y.0, y.1),
    };
    let map = Panel::new(area)
        .x(Axis::linear(x.0, x.1).label(r"$\Gamma$"))
        .y(vertical.label(r"restitution $\epsilon$"))
        .layer(Raster::new(forcings.count(), restitutions.count(), cells, &palette, x, y));
    // Those that there are, from above in their order.
    let there: Vec<Kind> = Kind::ALL.into_iter().filter(|kind| kinds.contains(kind)).collect();
    let count = there.len().max(1);
    let squares = there.iter().rev().map(place).collect();
    let ticks = there.iter().enumerate().map(|(k, kind)| ((count - 1 - k) as f64 + 0.5, short(*kind)));
    let ends = (0.0, count as f64);
    let size = 12.0_f64.min(frame / count as f64) * count as f64;
    let key = Panel::new(Rect::new(404.0, 10.0 + 0.5 * (frame - size), 12.0, size))
        .x(Axis::linear(0.0, 1.0).ticks(Ticks::none()))
        .y(Axis::linear(ends.0, ends.1).ticks(Ticks::none()))
        .right(Axis::linear(ends.0, ends.1).ticks(Ticks::at(ticks)))
        .layer(Raster::new(1, count, squares, &palette, (0.0, 1.0), ends));
    Figure::new(DOUBLE_COLUMN, height).panels([map, key])
}
