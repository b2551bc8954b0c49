//! Beyond the paper: efficiency of its motor over load and phase lag, and where the energy goes.

use std::f64::consts::PI;

use bouncing_disk::Motor;
use bouncing_disk::core::{ChatterPolicy, Unobserved};
use bouncing_disk::motor::{Estimate, OperatingPoint, OperatingSettings, Operation, operations};
use bouncing_disk_plot::{
    Anchor, Axis, Band, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Line, Marker, Panel, Raster, Rect, Rule,
    Scatter, Stroke, Text, Ticks,
};
use serde::{Deserialize, Serialize};

use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// The phase lags reach this far to either side: as far as a motor turns forwards, and a little more.
const FARTHEST_LAG: f64 = 0.6 * PI;

/// The highest load of the map, as a share of the largest torque.
const LAST_SHARE: f64 = 0.8;

/// Efficiency over load and phase lag.
#[derive(Debug)]
pub struct ExtraEfficiency;

/// The data of the efficiency map.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraEfficiencyData {
    motor: Motor,
    settings: OperatingSettings,
    /// Phase lags of the columns (rad), and loads of the rows, as shares of the largest torque μ m g a_e.
    phase_lags_rad: Vec<f64>,
    load_shares: Vec<f64>,
    /// Mechanical power over the power put in, row by row: negative where the load drives the motor back.
    /// `None` where no power is put in.
    power_ratios: Vec<Vec<Option<f64>>>,
    speeds_rad_per_s: Vec<Vec<Option<f64>>>,
    /// Lag (rad), load and efficiency of the best motor of the map.
    best: (f64, f64, Estimate),
    /// Along the loads, at the best lag.
    along_load: Vec<OperatingPoint>,
}

impl Experiment for ExtraEfficiency {
    type Data = ExtraEfficiencyData;
    const ID: &'static str = "extra-efficiency";
    const TITLE: &'static str = "Efficiency of the motor over load and phase lag";
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![("ensembles", OperatingSettings::default().seed)]
    }

    fn caption(data: &ExtraEfficiencyData) -> String {
        let (lag, share, efficiency) = data.best;
        format!(
            "Efficiency of the motor of Table III at 70 kHz: mechanical power over the power that the stator puts in. (a) Over \
             load torque and phase lag, {} by {} motors on one vertical motion of {} perturbed members. Below the black line, on \
             which the mean speed is zero, the motor turns forwards; above it (grey) the load drives it back. Circle: the best motor \
             of the map, {:.2} ± {:.2} % at θ = {:.3}π and {share:.3} μ m g a_e. Dotted: the printed lag. (b) Where the energy goes \
             at the best lag, as shares of what is put in, up to stall.",
            data.phase_lags_rad.len(),
            data.load_shares.len(),
            data.settings.members,
            100.0 * efficiency.value,
            100.0 * efficiency.standard_error,
            lag / PI,
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraEfficiencyData, ExperimentError> {
        let motor = Motor::paper_70_khz();
        let settings = OperatingSettings {
            relative_error: quality.choose(0.03, 0.015),
            members: quality.choose(8, 16),
            most_impacts: quality.choose(2_000_000, 40_000_000),
            ..OperatingSettings::default()
        };
        progress.start(2, "ensembles");
        let (columns, rows, fine) = quality.choose((13_u32, 6_u32, 12_u32), (73, 41, 48));
        let lag = |k: u32| FARTHEST_LAG * (2.0 * f64::from(k) / f64::from(columns - 1) - 1.0);
        let share = |k: u32, count: u32| LAST_SHARE * f64::from(k) / f64::from(count);
        let phase_lags_rad: Vec<f64> = (0..columns).map(lag).collect();
        let load_shares: Vec<f64> = (0..rows).map(|k| share(k, rows - 1)).collect();
        let cells = load_shares.iter().flat_map(|share| phase_lags_rad.iter().map(move |lag| (*lag, *share)));
        let cells: Vec<(f64, f64)> = cells.collect();
        let motors = cells.iter().map(|cell| at(&motor, *cell)).collect::<Result<Vec<_>, _>>()?;
        let map = operations(&motors, &settings, &Unobserved)?;
        progress.advance(1);
        let points: Vec<Option<&OperatingPoint>> = map.iter().map(Operation::point).collect();
        let matrix = |of: fn(&OperatingPoint) -> Option<f64>| -> Vec<Vec<Option<f64>>> {
            let rows = points.chunks(phase_lags_rad.len());
            rows.map(|row| row.iter().map(|point| point.and_then(of)).collect()).collect()
        };
        let efficient =
            cells.iter().zip(&points).filter_map(|(cell, point)| Some((*cell, (*point)?.efficiency?)));
        let ((lag, load), efficiency) = efficient
            .max_by(|one, other| one.1.value.total_cmp(&other.1.value))
            .ok_or_else(|| ExperimentError::NoData { quantity: "best efficiency".to_owned() })?;
        let loads: Vec<f64> = (0..=fine).map(|k| share(k, fine) * motor.largest_torque()).collect();
        let along_load = at(&motor, (lag, 0.0))?.torque_speed_curve(&loads, &settings, &Unobserved)?;
        progress.advance(1);
        Ok(ExtraEfficiencyData {
            power_ratios: matrix(|point| {
                let input = point.input_power.value;
                (input > 0.0).then(|| point.mechanical_power.value / input)
            }),
            speeds_rad_per_s: matrix(|point| Some(point.speed.value)),
            best: (lag, load, efficiency),
            along_load: along_load.iter().filter_map(Operation::point).copied().collect(),
            motor,
            settings,
            phase_lags_rad,
            load_shares,
        })
    }

    fn draw(data: &ExtraEfficiencyData) -> Result<Figure, ExperimentError> {
        let levels = (100.0 * data.best.2.value).ceil().max(1.0) as usize;
        Ok(Figure::new(DOUBLE_COLUMN, 215.0).panels([
            map(data, Rect::new(44.0, 12.0, 190.0, 165.0), levels),
            colour_bar(Rect::new(242.0, 12.0, 8.0, 165.0), levels),
            shares(data, Rect::new(330.0, 12.0, 168.0, 165.0)),
        ]))
    }
}

/// The motor with this lag under this share of the largest torque.
fn at(motor: &Motor, (phase_lag, share): (f64, f64)) -> Result<Motor, bouncing_disk::Error> {
    let largest = motor.largest_torque();
    motor.with(|sheet| {
        sheet.phase_lag = phase_lag;
        sheet.load_torque = share * largest;
    })
}

/// A grey for what is driven back, and the colours of the levels, one for each per cent.
fn palette(levels: usize) -> Vec<Colour> {
    let steps = (0..levels).map(|level| Colour::scale((level as f64 + 0.5) / levels as f64));
    std::iter::once(Colour::PALE_GREY).chain(steps).collect()
}

fn map(data: &ExtraEfficiencyData, area: Rect, levels: usize) -> Panel {
    let (columns, rows) = (data.phase_lags_rad.len(), data.load_shares.len());
    let cells = data.power_ratios.iter().zip(&data.speeds_rad_per_s).flat_map(|(ratios, speeds)| {
        ratios.iter().zip(speeds).map(|cell| match cell {
            (Some(share), Some(speed)) if *speed > 0.0 => {
                1 + ((100.0 * share).max(0.0) as usize).min(levels - 1) as u8
            }
            _ => 0,
        })
    });
    // The cells lie around the lags and loads of their motors.
    let (half_lag, half_load) =
        (FARTHEST_LAG / PI / (columns - 1) as f64, 0.5 * LAST_SHARE / (rows - 1) as f64);
    let x = (-FARTHEST_LAG / PI - half_lag, FARTHEST_LAG / PI + half_lag);
    let y = (-half_load, LAST_SHARE + half_load);
    let printed = Stroke::new(Colour::DARK_GREY, 0.6).dashed(Dash::Dotted);
    let best = Scatter::new([(data.best.0 / PI, data.best.1)]).marker(Marker::Circle);
    let back = Text::at_axes(0.5, 0.93, "driven back").anchor(Anchor::Centre).size(8.0);
    Panel::new(area)
        .x(Axis::linear(x.0, x.1).label(r"phase lag $\theta/\pi$").ticks(Ticks::every(0.2).minor(2)))
        .y(Axis::linear(y.0, y.1).label(r"load $T/(\mu m g a_e)$").ticks(Ticks::every(0.2).minor(4)))
        .letter_in("a", Corner::TopRight)
        .layer(Raster::new(columns, rows, cells.collect(), &palette(levels), x, y))
        .layer(Rule::vertical(data.motor.parameters().phase_lag / PI).stroke(printed))
        .layer(Line::new(stall_line(data)).width(0.9))
        .layer(best.colour(Colour::WHITE).size(7.0).width(1.4))
        .layer(back.halo(Colour::PALE_GREY))
}

/// Lag over π and load at which the speed passes zero, on the straight line between two loads.
fn stall_line(data: &ExtraEfficiencyData) -> Vec<(f64, f64)> {
    let crossing = |column: usize| {
        (1..data.load_shares.len()).find_map(|row| {
            let [below, above] = [row - 1, row].map(|row| data.speeds_rad_per_s[row][column]);
            let (below, above) = (below?, above?);
            let (from, to) = (data.load_shares[row - 1], data.load_shares[row]);
            (below > 0.0 && above <= 0.0).then(|| from + (to - from) * below / (below - above))
        })
    };
    let lags = data.phase_lags_rad.iter().enumerate();
    lags.map(|(column, lag)| (lag / PI, crossing(column).unwrap_or(f64::NAN))).collect()
}

fn colour_bar(area: Rect, levels: usize) -> Panel {
    let top = levels as f64;
    let cells = (1..=levels).map(|level| level as u8).collect();
    Panel::new(area)
        .x(Axis::linear(0.0, 1.0).ticks(Ticks::none()))
        .y(Axis::linear(0.0, top).ticks(Ticks::none()))
        .right(Axis::linear(0.0, top).label("efficiency (%)").ticks(Ticks::every(2.0).minor(2)))
        .layer(Raster::new(1, levels, cells, &palette(levels), (0.0, 1.0), (0.0, top)))
}

fn shares(data: &ExtraEfficiencyData, area: Rect) -> Panel {
    let driving = data.along_load.iter().take_while(|point| point.mechanical_power.value >= 0.0);
    // Load, and the heights up to which work and friction reach. The stored energy, and the work of the
    // perturbation, are no share of anything.
    let heights: Vec<[f64; 3]> = driving
        .map(|point| {
            let [work, friction, restitution] =
                [point.mechanical_power, point.friction_loss, point.restitution_loss].map(|part| part.value);
            let whole = work + friction + restitution;
            [point.load_torque / data.motor.largest_torque(), work / whole, (work + friction) / whole]
        })
        .collect();
    let last = heights.last().map_or(1.0, |own| own[0]);
    let band = |from: fn(&[f64; 3]) -> f64, to: fn(&[f64; 3]) -> f64, colour: Colour| {
        Band::new(heights.iter().map(|own| (own[0], from(own), to(own))).collect::<Vec<_>>())
            .colour(colour)
            .opacity(1.0)
    };
    let edge = |index: usize| {
        Line::new(heights.iter().map(|own| (own[0], own[index])).collect::<Vec<_>>()).width(0.7)
    };
    let [_, low, high] = heights.get(heights.len() / 2).copied().unwrap_or([0.5, 0.3, 0.6]);
    let label =
        |height: f64, words: &str| Text::at_data(0.5 * last, height, words).anchor(Anchor::Centre).size(8.5);
    Panel::new(area)
        .x(Axis::linear(0.0, last).label(r"load $T/(\mu m g a_e)$").ticks(Ticks::every(0.2).minor(4)))
        .y(Axis::linear(0.0, 1.0).label("share of the energy put in").ticks(Ticks::every(0.2).minor(2)))
        .letter_in("b", Corner::TopRight)
        .layer(band(|_| 0.0, |own| own[1], Colour::rgb(150, 205, 160)))
        .layer(band(|own| own[1], |own| own[2], Colour::rgb(245, 205, 150)))
        .layer(band(|own| own[2], |_| 1.0, Colour::rgb(170, 200, 225)))
        .layer(edge(1))
        .layer(edge(2))
        .layer(label(0.5 * low, "mechanical work"))
        .layer(label(0.5 * (low + high), "friction"))
        .layer(label(0.5 * (1.0 + high), "restitution"))
}
