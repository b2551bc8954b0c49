//! Beyond the paper: which preloads trap a motor in a short cycle.

use std::f64::consts::PI;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::motor::{TrapVerdict, low_period_traps};
use bouncing_disk::{Motor, Unobserved};
use bouncing_disk_plot::{
    Axis, Colour, DOUBLE_COLUMN, Dash, Figure, Panel, Raster, Rect, Rule, Stroke, Ticks,
};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::claims::paper;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Γ and restitutions of the second map.
const FORCINGS: [f64; 2] = [12.0, 14.0];
const RESTITUTIONS: [f64; 2] = [0.02, 0.9];

/// Cycles of one, two, three, and more flights.
const KINDS: usize = 4;
const COLOURS: [Colour; KINDS] = [Colour::VERMILION, Colour::BLUE, Colour::GREEN, Colour::DARK_GREY];
const NAMES: [&str; KINDS] = ["1", "2", "3", r"$\geq 4$"];

/// How much of a colour is left where the perturbation ends the cycle.
const PALE: f64 = 0.72;

/// Low-period traps over the forcing.
#[derive(Debug)]
pub struct ExtraTraps;

/// The data of the maps of traps.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraTrapsData {
    /// The motor whose preload is changed.
    motor: Motor,
    /// Integer parts of Γ of the rows, and fractions of the columns.
    whole_forcings: Vec<u32>,
    forcing_fractions: Vec<f64>,
    by_fraction: Map,
    /// Γ of the columns and restitutions of the rows.
    axial_forcings: Vec<f64>,
    restitutions: Vec<f64>,
    by_restitution: Map,
    /// Preloads of Fig. 11 (m/s²) and the share of them that is trapped, at each amplitude (m).
    share_of_fig11: Vec<TrappedShare>,
}

/// The verdicts on the motors of a grid, row by row.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Map {
    /// Long flights of the unperturbed cycle; 0 where it is not short.
    long_flights: Vec<Vec<usize>>,
    /// Whether the perturbed motor repeats it.
    is_trap: Vec<Vec<bool>>,
}

/// How many of the preloads of a range are trapped.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct TrappedShare {
    amplitude_m: f64,
    preloads_m_per_s2: [f64; 2],
    forcings: [f64; 2],
    motors: usize,
    trapped: usize,
}

impl Experiment for ExtraTraps {
    type Data = ExtraTrapsData;
    const ID: &'static str = "extra-traps";
    const TITLE: &'static str = "Preloads that trap the motor in a short cycle";
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(data: &ExtraTrapsData) -> String {
        let [from, to] = [data.whole_forcings.first(), data.whole_forcings.last()]
            .map(|end| end.copied().unwrap_or_default());
        let shares: Vec<String> = data
            .share_of_fig11
            .iter()
            .map(|share| {
                format!(
                    "{:.1} % at A = {:e} m",
                    100.0 * share.trapped as f64 / share.motors as f64,
                    share.amplitude_m
                )
            })
            .collect();
        format!(
            "Preloads that trap a motor in a short cycle of flights and rest. (a) The restitution of Table III, {}: the integer part of \
             Γ = Aω²/(πg), {from} to {to}, against its fraction. (b) Γ against the restitution. Full colours: the cycle survives the \
             perturbation of its relaunches, and the motor has the speed of the cycle; pale: the unperturbed motor has a cycle of so many flights \
             longer than half a period, which the perturbation ends; white: its cycle is longer. The preload enters by Γ alone: of the preloads \
             of Fig. 11, {} are trapped.",
            data.motor.parameters().restitution,
            shares.join(", "),
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraTrapsData, ExperimentError> {
        let motor = Motor::paper_70_khz();
        let (rows, columns) = quality.choose((24, 80), (64, 400));
        let whole_forcings: Vec<u32> = (1..=rows).collect();
        let forcing_fractions = middles([0.0, 1.0], columns);
        let (high, wide) = quality.choose((24, 80), (120, 400));
        let (axial_forcings, restitutions) = (middles(FORCINGS, wide), middles(RESTITUTIONS, high));
        progress.start(u64::from(rows) + high as u64 + 1, "rows");
        let by_fraction = map(progress, &whole_forcings, |whole| {
            let forcings = forcing_fractions.iter().map(|fraction| f64::from(*whole) + fraction);
            verdicts(&motor, forcings)
        })?;
        let by_restitution = map(progress, &restitutions, |restitution| {
            let motor = motor.with(|sheet| sheet.restitution = *restitution)?;
            verdicts(&motor, axial_forcings.iter().copied())
        })?;
        let share_of_fig11 = shares(&motor, quality.choose(400, 4_000))?;
        progress.advance(1);
        Ok(ExtraTrapsData {
            motor,
            whole_forcings,
            forcing_fractions,
            by_fraction,
            axial_forcings,
            restitutions,
            by_restitution,
            share_of_fig11,
        })
    }

    fn draw(data: &ExtraTrapsData) -> Result<Figure, ExperimentError> {
        Ok(draw(data))
    }

    fn parameters(data: &ExtraTrapsData) -> Vec<(String, String)> {
        [
            ("ε of (a)", data.motor.parameters().restitution.to_string()),
            ("motors", format!("{} by {}", data.forcing_fractions.len(), data.whole_forcings.len())),
            ("relaunch perturbation", "1e-3 g/ω".to_owned()),
            ("relaunches", "64".to_owned()),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .into()
    }
}

/// The middles of equal parts of a range.
fn middles([from, to]: [f64; 2], count: usize) -> Vec<f64> {
    (0..count).map(|k| from + (to - from) * (k as f64 + 0.5) / count as f64).collect()
}

/// Verdicts on a motor with the preloads that give these Γ.
fn verdicts(motor: &Motor, forcings: impl Iterator<Item = f64>) -> Result<Vec<TrapVerdict>, ExperimentError> {
    let peak = motor.system().platform().peak_acceleration();
    let preloads: Vec<f64> = forcings.map(|forcing| peak / (PI * forcing)).collect();
    Ok(low_period_traps(motor, &preloads, &Unobserved)?)
}

/// The rows of a map, in parallel and in their order.
fn map<T: Sync>(
    progress: &dyn Progress,
    rows: &[T],
    verdicts: impl Fn(&T) -> Result<Vec<TrapVerdict>, ExperimentError> + Sync,
) -> Result<Map, ExperimentError> {
    let rows: Vec<Result<Vec<TrapVerdict>, ExperimentError>> = rows
        .par_iter()
        .map(|row| {
            let done = verdicts(row);
            progress.advance(1);
            done
        })
        .collect();
    let mut map = Map::default();
    for row in rows {
        let row = row?;
        map.long_flights
            .push(row.iter().map(|verdict| verdict.cycle.map_or(0, |cycle| cycle.long_flights)).collect());
        map.is_trap.push(row.iter().map(|verdict| verdict.is_trap).collect());
    }
    Ok(map)
}

/// How many of the preloads of Fig. 11, on a regular grid, are trapped.
fn shares(motor: &Motor, motors: usize) -> Result<Vec<TrappedShare>, ExperimentError> {
    let section = paper::section_five()?;
    let ends = paper::preloads()?.preload_accelerations_m_per_s2;
    let preloads = middles(ends, motors);
    section
        .amplitudes_of_fig10_m
        .into_iter()
        .map(|amplitude_m| {
            let motor = motor.with(|sheet| sheet.amplitude = amplitude_m)?;
            let peak = motor.system().platform().peak_acceleration();
            let trapped = low_period_traps(&motor, &preloads, &Unobserved)?;
            Ok(TrappedShare {
                amplitude_m,
                preloads_m_per_s2: ends,
                forcings: [ends[1], ends[0]].map(|preload| peak / (PI * preload)),
                motors,
                trapped: trapped.iter().filter(|verdict| verdict.is_trap).count(),
            })
        })
        .collect()
}

/// White, and of each kind the pale and the full colour.
fn palette() -> Vec<Colour> {
    let pairs = COLOURS.into_iter().flat_map(|colour| [colour.mixed(Colour::WHITE, PALE), colour]);
    std::iter::once(Colour::WHITE).chain(pairs).collect()
}

fn cells(map: &Map) -> Vec<u8> {
    let flights = map.long_flights.iter().flatten();
    flights
        .zip(map.is_trap.iter().flatten())
        .map(|(flights, is_trap)| match flights {
            0 => 0,
            count => 1 + 2 * ((*count).min(KINDS) - 1) as u8 + u8::from(*is_trap),
        })
        .collect()
}

fn draw(data: &ExtraTrapsData) -> Figure {
    const HEIGHT: f64 = 235.0;
    let left = Rect::new(40.0, 12.0, 196.0, 188.0);
    let right = Rect::new(276.0, 12.0, 166.0, 188.0);
    let key = Rect::new(460.0, 40.0, 24.0, 80.0);
    let first = f64::from(data.whole_forcings.first().copied().unwrap_or(1));
    let rows = data.whole_forcings.len();
    let y = (first - 0.5, first + rows as f64 - 0.5);
    let columns = data.forcing_fractions.len();
    let by_fraction = Panel::new(left)
        .x(Axis::linear(0.0, 1.0).label(r"fraction of $\Gamma$").ticks(Ticks::every(0.2).minor(2)))
        .y(Axis::linear(y.0, y.1).label(r"integer part of $\Gamma$"))
        .letter("a")
        .layer(Raster::new(columns, rows, cells(&data.by_fraction), &palette(), (0.0, 1.0), y))
        .layer(Rule::vertical(0.5).stroke(Stroke::new(Colour::BLACK, 0.5).dashed(Dash::Dotted)));
    let (wide, high) = (data.axial_forcings.len(), data.restitutions.len());
    let (x, y) = (edges(&data.axial_forcings), edges(&data.restitutions));
    let by_restitution = Panel::new(right)
        .x(Axis::linear(x.0, x.1).label(r"$\Gamma$").ticks(Ticks::every(0.5).minor(5)))
        .y(Axis::linear(y.0, y.1).label(r"restitution $\epsilon$").ticks(Ticks::every(0.2).minor(4)))
        .letter("b")
        .layer(Raster::new(wide, high, cells(&data.by_restitution), &palette(), x, y))
        .layer(
            Rule::horizontal(data.motor.parameters().restitution)
                .stroke(Stroke::new(Colour::BLACK, 0.5).dashed(Dash::Dotted)),
        );
    // Below each other, the pale colour on the left.
    let squares: Vec<u8> = (0..KINDS as u8).rev().flat_map(|kind| [1 + 2 * kind, 2 + 2 * kind]).collect();
    let ticks = (0..KINDS).map(|kind| ((KINDS - 1 - kind) as f64 + 0.5, NAMES[kind]));
    let legend = Panel::new(key)
        .x(Axis::linear(0.0, 2.0).ticks(Ticks::none()))
        .y(Axis::linear(0.0, KINDS as f64).ticks(Ticks::none()))
        .right(Axis::linear(0.0, KINDS as f64).ticks(Ticks::at(ticks)))
        .title("flights")
        .layer(Raster::new(2, KINDS, squares, &palette(), (0.0, 2.0), (0.0, KINDS as f64)));
    Figure::new(DOUBLE_COLUMN, HEIGHT).panels([by_fraction, by_restitution, legend])
}

/// The outer edges of equal cells with these middles.
fn edges(middles: &[f64]) -> (f64, f64) {
    match middles {
        [first, second, .., last] => {
            let half = 0.5 * (second - first);
            (first - half, last + half)
        }
        _ => (0.0, 1.0),
    }
}
