//! The picture.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI, TAU};

use bouncing_disk::core::flight::Compliance;
use bouncing_disk_plot::{
    Anchor, Axis, Colour, Corner, DOUBLE_COLUMN, Dash, DensePoints, Figure, Grid, Legend, Line, Margins,
    Panel, Raster, Rect, Rule, Scatter, Stroke, Text, Ticks,
};

use super::{
    AMPLITUDES, CONTACT_TIMES, Cells, Curve, ExtraContactData, FORCINGS, LAGS, Lives, PRELOADS, RESTITUTIONS,
    TRANSITION,
};

/// Motions and colours of the map, in the order of [`Cells::regimes`].
/// and where their words are.
const REGIMES: [(&str, Colour, (f64, f64)); 4] = [
    ("never leaves", Colour::PALE_GREY, (4.0, 0.55)),
    ("taps", Colour::SKY, (3.0, 300.0)),
    ("long flights", Colour::ORANGE, (0.2, 30.0)),
    ("other", Colour::GREY, (0.17, 0.5)),
];

/// What a map shows of its cells.
type Quantity = fn(&Cells) -> &[f64];

/// Colours of a quantity.
const LEVELS: u8 = 30;

pub(super) fn draw(data: &ExtraContactData) -> Figure {
    const HEIGHT: f64 = 700.0;
    let margins = Margins { left: 44.0, right: 34.0, top: 18.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 5, 3).margins(margins).gaps(58.0, 44.0);
    let cell = |row, column| grid.cell(row, column);
    let mut panels = vec![regimes(data, cell(0, 0))];
    let maps: [(&str, Quantity, _, f64, _); 4] = [
        (r"(b) mean phase of the force, $\tau/\pi$", |own| &own.mean_phases, (-0.1, 0.5), PI, (0, 1)),
        (r"(c) best phase lag, $\theta/\pi$", |own| &own.best_lags, (-0.5, 0.1), PI, (0, 2)),
        (r"(d) speed$/\omega\Phi$ at $\theta = 0$", |own| &own.speeds_at_zero, (0.0, 1.0), 1.0, (1, 0)),
        (r"(e) speed$/\omega\Phi$ at the best lag", |own| &own.best_speeds, (0.0, 1.0), 1.0, (1, 1)),
    ];
    for (title, of, ends, unit, (row, column)) in maps {
        panels.extend(map(data, cell(row, column), title, of, (ends, unit)));
    }
    panels.push(transition(data, cell(1, 2)));
    panels.push(lives(&data.lives, cell(2, 0)));
    let speed = || Axis::linear(-0.6, 1.05).label(r"speed / $\omega\Phi$").ticks(Ticks::every(0.5).minor(5));
    let times = || Axis::log(CONTACT_TIMES.0, CONTACT_TIMES.1).label(r"$T_c/T$");
    panels.push(
        curves(&data.over_time, cell(2, 1), speeds, |_, lag| lag != 1)
            .x(times())
            .y(speed())
            .title("(h) restitution and law"),
    );
    panels.push(runs(data, cell(2, 2)));
    let preload = || Axis::log(PRELOADS.0, PRELOADS.1).label(r"$g$ (m/s$^2$)");
    panels.push(
        curves(&data.over_preload, cell(3, 0), speeds, longest)
            .x(preload())
            .y(speed())
            .title("(j) speed over preload"),
    );
    panels.push(
        curves(&data.over_preload, cell(3, 1), |own| &own.stall_shares, longest)
            .title("(k) stall torque over preload")
            .x(preload())
            .y(Axis::linear(-0.6, 1.05).label(r"torque / $\mu m g a_e$").ticks(Ticks::every(0.5).minor(5))),
    );
    let lag = || Axis::linear(-PI, PI).label(r"$\theta$").ticks(Ticks::pi(1, 2));
    panels.push(
        curves(&data.over_lag, cell(3, 2), speeds, |_, lag| lag == 0)
            .x(lag())
            .y(Axis::linear(-1.05, 1.05).label(r"speed / $\omega\Phi$").ticks(Ticks::every(0.5).minor(5)))
            .title("(l) speed over the lag")
            .layers([0.0, -FRAC_PI_2].map(|lag| Rule::vertical(lag).stroke(thin()))),
    );
    panels.push(
        curves(&data.over_lag, cell(4, 0), |own| &own.stall_shares, |_, lag| lag == 0)
            .x(lag())
            .y(Axis::linear(-1.05, 1.05).label(r"torque / $\mu m g a_e$").ticks(Ticks::every(0.5).minor(5)))
            .title("(m) stall torque over the lag"),
    );
    panels.push(
        curves(&data.over_restitution, cell(4, 1), speeds, longest)
            .x(Axis::linear(RESTITUTIONS.0, RESTITUTIONS.1)
                .label(r"restitution $\epsilon$")
                .ticks(Ticks::every(0.2).minor(2)))
            .y(speed())
            .title("(n) speed over restitution"),
    );
    panels.push(
        curves(&data.over_amplitude, cell(4, 2), speeds, longest)
            .x(Axis::log(AMPLITUDES.0, AMPLITUDES.1).label("$A$ (m)"))
            .y(speed())
            .title("(o) speed over amplitude"),
    );
    Figure::new(DOUBLE_COLUMN, HEIGHT).panels(panels)
}

fn thin() -> Stroke {
    Stroke::new(Colour::GREY, 0.5).dashed(Dash::Dotted)
}

fn plane(area: Rect) -> Panel {
    Panel::new(area)
        .x(Axis::log(CONTACT_TIMES.0, CONTACT_TIMES.1).label(r"$T_c/T$"))
        .y(Axis::log(FORCINGS.0, FORCINGS.1).label(r"$\Gamma$"))
}

fn regimes(data: &ExtraContactData, area: Rect) -> Panel {
    let palette = REGIMES.map(|(_, colour, _)| colour);
    let cells = data
        .cells
        .regimes
        .iter()
        .flat_map(|row| row.bytes())
        .map(|own| own.saturating_sub(b'0').min(3))
        .collect();
    // m g/(k A) = 1/(pi Γ k), with the stiffness in units of m ω².
    let line = |ratio: f64| {
        let times = [CONTACT_TIMES.0, CONTACT_TIMES.1];
        let points = times.iter().filter_map(|time| {
            let stiffness = Compliance::new(TAU * time, data.restitution).ok()?.stiffness();
            Some((*time, FRAC_1_PI / (ratio * stiffness)))
        });
        Line::new(points.collect::<Vec<_>>()).colour(Colour::BLACK).width(0.6).dash(Dash::Dotted)
    };
    let own = data.ring.map(|time| (time, data.axial_forcing));
    plane(area)
        .title("(a) motion")
        .layer(raster(data, cells, &palette))
        .layers([0.1, 1.0, 10.0].map(line))
        .layer(Line::new(own).colour(Colour::WHITE).width(2.0))
        .layers(REGIMES.map(|(words, _, (x, y))| Text::at_data(x, y, words).anchor(Anchor::Centre).size(6.5)))
}

/// The cells of a map in the plane.
fn raster(data: &ExtraContactData, cells: Vec<u8>, palette: &[Colour]) -> Raster {
    Raster::new(data.cells.columns, data.cells.regimes.len(), cells, palette, CONTACT_TIMES, FORCINGS)
}

/// A map with the bar of its colours, whose `ends` are in this unit.
fn map(
    data: &ExtraContactData,
    area: Rect,
    title: &str,
    of: Quantity,
    (ends, unit): ((f64, f64), f64),
) -> [Panel; 2] {
    let steps = (0..LEVELS).map(|level| Colour::scale((f64::from(level) + 0.5) / f64::from(LEVELS)));
    let palette: Vec<Colour> = steps.collect();
    let level = |value: f64| {
        let share = (value / unit - ends.0) / (ends.1 - ends.0);
        (share * f64::from(LEVELS)).clamp(0.0, f64::from(LEVELS - 1)) as u8
    };
    let cells = of(&data.cells).iter().map(|value| level(*value)).collect();
    let bar = Rect { left: area.left + area.width + 4.0, width: 6.0, ..area };
    let bar = Panel::new(bar)
        .x(Axis::linear(0.0, 1.0).ticks(Ticks::none()))
        .y(Axis::linear(ends.0, ends.1).ticks(Ticks::none()))
        .right(Axis::linear(ends.0, ends.1).ticks(Ticks::every(0.2).minor(2)))
        .layer(Raster::new(1, LEVELS.into(), (0..LEVELS).collect(), &palette, (0.0, 1.0), ends));
    let own = plane(area);
    let first = area.left < DOUBLE_COLUMN / 4.0;
    let own = if first { own } else { own.y(Axis::log(FORCINGS.0, FORCINGS.1).without_numbers()) };
    [own.title(title).layer(raster(data, cells, &palette)), bar]
}

fn transition(data: &ExtraContactData, area: Rect) -> Panel {
    let dots =
        |dots: &[(f64, f64)], colour| DensePoints::new(dots.iter().copied()).colour(colour).radius(0.35);
    Panel::new(area)
        .title("(f) transition")
        .x(Axis::linear(TRANSITION.0, TRANSITION.1).label(r"$T_c/T$").ticks(Ticks::every(0.1).minor(2)))
        .y(Axis::linear(0.0, 1.0).label(r"$\tau/2\pi$").ticks(Ticks::every(0.5).minor(5)))
        .layer(dots(&data.transition.flown, Colour::LIGHT_GREY))
        .layer(dots(&data.transition.tapped, Colour::BLUE))
}

fn lives(lives: &[Lives], area: Rect) -> Panel {
    let mut panel = Panel::new(area)
        .title("(g) mean life of long flights")
        .x(Axis::linear(0.45, 2.3).label(r"$T_c/T$").ticks(Ticks::every(0.5).minor(5)))
        .y(Axis::log(1e2, 1e7).label("periods"));
    for (index, lives) in lives.iter().enumerate() {
        let colour = Colour::cycle(index);
        let known = lives.points.iter().filter_map(|life| Some((life.contact_time, life.mean()?.0)));
        let known: Vec<_> = known.filter(|point| point.1 > 0.0).collect();
        panel = panel
            .layer(Line::new(known.clone()).colour(colour).width(0.8).name(lives.name.as_str()))
            .layer(Scatter::new(known).colour(colour).size(2.5))
            .layers(
                lives
                    .tapped_from
                    .map(|from| Rule::vertical(from).stroke(Stroke::new(colour, 0.7).dashed(Dash::Dashed))),
            );
    }
    panel.legend(Legend::at(Corner::TopRight))
}

/// What a rotor does at each lag, over the quantity of the curves; of some curves and lags by their indices.
fn curves(
    curves: &[Curve],
    area: Rect,
    of: fn(&Curve) -> &[Vec<f64>; LAGS.len()],
    shown: impl Fn(usize, usize) -> bool,
) -> Panel {
    const DASHES: [Dash; LAGS.len()] = [Dash::Solid, Dash::Dotted, Dash::Dashed];
    let mut panel = Panel::new(area);
    for (index, curve) in curves.iter().enumerate() {
        for (lag, dash) in DASHES.into_iter().enumerate().filter(|(lag, _)| shown(index, *lag)) {
            let points = curve.values.iter().copied().zip(of(curve)[lag].iter().copied());
            panel = panel.layer(Line::new(points).colour(Colour::cycle(index)).dash(dash).width(0.9));
        }
    }
    panel
}

const fn speeds(own: &Curve) -> &[Vec<f64>; LAGS.len()] {
    &own.speeds
}

/// All contacts without a lag, and all lags of the longest contact.
const fn longest(contact: usize, lag: usize) -> bool {
    lag == 0 || contact == 4
}

fn runs(data: &ExtraContactData, area: Rect) -> Panel {
    let last = data.runs.iter().flat_map(|run| run.points.last()).map(|point| point.0).fold(0.0, f64::max);
    let mut panel = Panel::new(area)
        .title("(i) run-up")
        .x(Axis::linear(0.0, 2.2 * last.max(1e-3)).label("$t$ (s)"))
        .y(Axis::linear(0.0, 30.0).label("speed (rad/s)").ticks(Ticks::every(10.0).minor(5)));
    for (index, run) in data.runs.iter().enumerate() {
        let line = Line::new(run.points.iter().copied()).colour(Colour::cycle(index)).width(0.7);
        panel = panel.layer(line.name(run.name.as_str()));
    }
    panel.legend(Legend::at(Corner::TopRight))
}
