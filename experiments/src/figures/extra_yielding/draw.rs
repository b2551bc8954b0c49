//! The picture.

use bouncing_disk_plot::{
    Axis, Band, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Grid, Legend, Line, Margins, Panel, Raster,
    Rect, Ticks,
};

use super::{CARRIES, CONTACT_TIMES, Curve, DETUNINGS, ExtraYieldingData, MASSES, PRELOADS, PULLS, Point};

/// The range (mN) in which the authors found the speed constant.
const CONSTANT: (f64, f64) = (80.0, 280.0);

/// The weight of the ball over its mass (m/s²).
const WEIGHT: f64 = 9.81;

pub(super) fn draw(data: &ExtraYieldingData) -> Figure {
    const HEIGHT: f64 = 590.0;
    let margins = Margins { left: 44.0, right: 14.0, top: 18.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 4, 3).margins(margins).gaps(52.0, 44.0);
    let cell = |row, column| grid.cell(row, column);
    let disk = *bouncing_disk::System::motor().disk();
    // The torque of friction over the preload (m).
    let arm = disk.friction() * disk.contact_radius();
    let torque = 1e6 * arm * data.mass_kg * PRELOADS.1;
    let rows = [
        (&data.rigid, "70 kHz, rigid, by $M$", ["(a)", "(b)", "(c)"]),
        (&data.soft, "70 kHz, by $T_c/T$", ["(d)", "(e)", "(f)"]),
        (&data.fast, "184 kHz, by $A_0$", ["(g)", "(h)", "(i)"]),
    ];
    let mut panels = Vec::new();
    for (row, (curves, words, letters)) in rows.into_iter().enumerate() {
        let title = |column: usize, name: &str| format!("{} {name}: {words}", letters[column]);
        let speed = Axis::linear(0.0, 31.0).label("speed (rad/s)").ticks(Ticks::every(10.0).minor(5));
        let stall =
            Axis::linear(0.0, 1.05 * torque).label(r"torque (µN m)").ticks(Ticks::every(20.0).minor(4));
        let share = Axis::linear(0.0, 1.05).label(r"$A/A_0$").ticks(Ticks::every(0.5).minor(5));
        let own = |area, of: fn(&Point) -> f64, axis: Axis, name: String| {
            over_preload(data, curves, area, of).y(axis).title(name.as_str())
        };
        panels.push(own(cell(row, 0), |point| point.speed, speed, title(0, "speed")));
        let mut torques = own(cell(row, 1), |point| 1e6 * point.stall_torque, stall, title(1, "torque"));
        if row > 0 {
            let all = [0.0, PRELOADS.1].map(|g| (1e3 * g * data.mass_kg, 1e6 * arm * g * data.mass_kg));
            torques = torques.layer(Line::new(all).colour(Colour::BLACK).width(0.6).dash(Dash::Dotted));
        }
        panels.push(torques.legend(Legend::at(Corner::TopLeft)));
        let mut amplitudes = own(cell(row, 2), |point| point.amplitude, share, title(2, "amplitude"));
        if row == 0 {
            amplitudes = amplitudes
                .layers(curves.iter().filter(|curve| curve.twists).enumerate().filter_map(law(data)));
        }
        panels.push(amplitudes);
    }
    panels.push(map(data, cell(3, 0)));
    panels.push(detuned(data, cell(3, 1)));
    panels.push(magnet(data, cell(3, 2)));
    Figure::new(DOUBLE_COLUMN, HEIGHT).panels(panels)
}

/// A₀(1 − g/g_c) through the amplitude at the lowest preload.
fn law<'a>(data: &'a ExtraYieldingData) -> impl Fn((usize, &'a Curve)) -> Option<Line> {
    |(index, curve)| {
        let (preload, point) = curve.points.iter().find(|own| own.1.amplitude < 0.97)?;
        let ends = preload / (1.0 - point.amplitude);
        let points = [(0.0, 1.0), (1e3 * ends * data.mass_kg, 0.0)];
        Some(Line::new(points).colour(Colour::cycle(index)).width(0.5))
    }
}

fn over_preload(data: &ExtraYieldingData, curves: &[Curve], area: Rect, of: fn(&Point) -> f64) -> Panel {
    let newton = |preload: f64| 1e3 * preload * data.mass_kg;
    let range = Band::new([CONSTANT.0, CONSTANT.1].map(|end| (end, -1e3, 1e3)))
        .colour(Colour::PALE_GREY)
        .opacity(0.6);
    let axis =
        Axis::linear(0.0, newton(PRELOADS.1) + 5.0).label("preload (mN)").ticks(Ticks::every(100.0).minor(5));
    let own = curves.len() / 2;
    let mut panel = Panel::new(area).x(axis).layer(range);
    for (index, curve) in curves.iter().enumerate() {
        let points = curve.points.iter().map(|(preload, point)| (newton(*preload), of(point)));
        let line = Line::new(points).colour(Colour::cycle(index % own)).width(0.9);
        panel =
            panel.layer(if curve.twists { line.name(curve.name.as_str()) } else { line.dash(Dash::Dashed) });
    }
    panel
}

/// How many features show.
fn map(data: &ExtraYieldingData, area: Rect) -> Panel {
    let (columns, found) = &data.map;
    let palette = [Colour::WHITE, Colour::PALE_GREY, Colour::SKY, Colour::ORANGE, Colour::VERMILION];
    let (x, y) = ((1e6 * MASSES.0, 1e6 * MASSES.1), CONTACT_TIMES);
    let cells = Raster::new(*columns, found.len() / columns, found.clone(), &palette, x, y);
    Panel::new(area)
        .title("(j) features, 70 kHz, mode twists")
        .x(Axis::linear(x.0, x.1).label("$M/Q$ (mg)").ticks(Ticks::every(10.0).minor(5)))
        .y(Axis::log(y.0, y.1).label("$T_c/T$"))
        .layer(cells)
}

fn detuned(data: &ExtraYieldingData, area: Rect) -> Panel {
    let mut panel = Panel::new(area)
        .title("(k) 70 kHz, 330 mN")
        .x(Axis::linear(1e2 * DETUNINGS.0, 1e2 * DETUNINGS.1)
            .label("resonance over drive frequency, less 1 (%)")
            .ticks(Ticks::every(0.5).minor(5)))
        .y(Axis::linear(0.0, 48.0).label("speed (rad/s)").ticks(Ticks::every(10.0).minor(5)));
    for (index, curve) in data.detuned.iter().enumerate() {
        let points = curve.points.iter().map(|(detuning, point)| (1e2 * detuning, point.speed));
        let line = Line::new(points).colour(Colour::cycle(index % 2)).width(0.9);
        panel =
            panel.layer(if curve.twists { line.name(curve.name.as_str()) } else { line.dash(Dash::Dashed) });
    }
    panel.legend(Legend::at(Corner::TopRight))
}

/// The relative change of the preload over the height of a mean flight.
pub(super) fn change(preload: f64, flight: f64, pull: f64) -> f64 {
    // The magnet takes the rest of the weight: (d_0/d)^n of it.
    let taken = (WEIGHT - preload).max(0.0);
    let distance = CARRIES * bouncing_disk::core::numerics::elementary::pow(WEIGHT / taken, 1.0 / pull);
    pull * taken * (preload * flight * flight / 8.0) / (distance * preload)
}

fn magnet(data: &ExtraYieldingData, area: Rect) -> Panel {
    let mut panel = Panel::new(area)
        .title("(l) change of a magnet's preload")
        .x(Axis::linear(0.0, 335.0).label("preload (mN)").ticks(Ticks::every(100.0).minor(5)))
        .y(Axis::log(1e-8, 1e3).label("share in a flight"));
    let rigid = data.rigid.iter().find(|curve| !curve.twists && curve.name == "10 g");
    let soft = data.soft.iter().find(|curve| !curve.twists && curve.name == "4.3");
    let shown = [("rigid, 100 nm", rigid, 1.0), ("rigid, 10 nm", rigid, 0.1), ("$T_c/T$ = 4.3", soft, 1.0)];
    for (index, (name, curve, scale)) in shown.into_iter().enumerate() {
        for (pull, dash) in PULLS.into_iter().zip([Dash::Solid, Dash::Dashed]) {
            let points = curve.into_iter().flat_map(|curve| &curve.points).filter(|own| own.0 < WEIGHT);
            let points = points.map(|(preload, point)| {
                (1e3 * preload * data.mass_kg, change(*preload, scale * point.flight, pull))
            });
            let line =
                Line::new(points.collect::<Vec<_>>()).colour(Colour::cycle(index)).dash(dash).width(0.9);
            panel = panel.layer(if pull > PULLS[0] { line } else { line.name(name) });
        }
    }
    panel.legend(Legend::at(Corner::TopRight))
}
