//! Beyond the paper: which preloads trap a motor in a short cycle.

use std::f64::consts::PI;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::motor::{TrapVerdict, low_period_traps};
use bouncing_disk::{Motor, Unobserved};
use bouncing_disk_plot::{
    Axis, Colour, DOUBLE_COLUMN, Dash, Figure, Panel, Raster, Rect, Rule, Stroke, Ticks,
};
use serde::{Deserialize, Serialize};

use crate::claims::paper;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::figures::shared::map_in_parallel;
use crate::progress::Progress;

/// Γ and restitutions of the second map.
const FORCINGS: (f64, f64) = (12.0, 14.0);
const RESTITUTIONS: (f64, f64) = (0.02, 0.9);

/// Cycles of one, two, three, and more flights.
const KINDS: usize = 4;
const COLOURS: [Colour; KINDS] = [Colour::VERMILION, Colour::BLUE, Colour::GREEN, Colour::DARK_GREY];
const NAMES: [&str; KINDS] = ["1", "2", "3", r"$\geq 4$"];

/// How much of a colour is left where the perturbation ends the cycle.
const PALE: f64 = 0.72;

/// Low-period traps over the forcing.
#[derive(Debug)]
pub struct ExtraTraps;

/// The data of the maps of traps. Of each motor of a row a digit: 0 where its cycle is not short, else 2 n − 1 for a cycle of n
/// long flights, n up to 4, and 2 n where the perturbed motor repeats it.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraTrapsData {
    restitution: f64,
    /// By the integer part of Γ, from 1 on, and its fraction.
    by_fraction: Vec<String>,
    by_restitution: Vec<String>,
    /// Amplitudes (m), and the share of the preloads of Fig. 11 that is trapped.
    trapped_of_fig11: Vec<(f64, f64)>,
}

impl Experiment for ExtraTraps {
    type Data = ExtraTrapsData;
    const ID: &'static str = "extra-traps";
    const TITLE: &'static str = "Preloads that trap the motor in a short cycle";
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(data: &ExtraTrapsData) -> String {
        let shares = data.trapped_of_fig11.iter();
        let shares =
            shares.map(|(amplitude, share)| format!("{:.1} % at A = {amplitude:e} m", 100.0 * share));
        format!(
            "Preloads that trap a motor in a short cycle of flights and rest. (a) The restitution of Table III, {}: the integer part of \
             Γ = Aω²/(πg), 1 to {}, against its fraction. (b) Γ against the restitution. Full colours: the cycle survives the \
             perturbation of 64 relaunches by up to 1e-3 g/ω, and the motor has the speed of the cycle; pale: the unperturbed motor has a cycle of so many flights \
             longer than half a period, which the perturbation ends; white: its cycle is longer. The preload enters by Γ alone: of the preloads \
             of Fig. 11, {} are trapped.",
            data.restitution,
            data.by_fraction.len(),
            shares.collect::<Vec<_>>().join(", "),
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraTrapsData, ExperimentError> {
        let motor = Motor::paper_70_khz();
        let (rows, columns) = quality.choose((24_u32, 80), (64, 400));
        let (high, wide) = quality.choose((24, 80), (120, 400));
        progress.start(u64::from(rows) + high as u64 + 1, "rows");
        let wholes: Vec<f64> = (1..=rows).map(f64::from).collect();
        let fractions = middles((0.0, 1.0), columns);
        let by_fraction = map(progress, &wholes, |whole| {
            verdicts(&motor, fractions.iter().map(|fraction| whole + fraction))
        })?;
        let forcings = middles(FORCINGS, wide);
        let by_restitution = map(progress, &middles(RESTITUTIONS, high), |restitution| {
            let motor = motor.with(|sheet| sheet.restitution = restitution)?;
            verdicts(&motor, forcings.iter().copied())
        })?;
        let [least, most] = paper::preloads()?.preload_accelerations_m_per_s2;
        let preloads = middles((least, most), quality.choose(400, 4_000));
        let trapped = |amplitude: f64| {
            let motor = motor.with(|sheet| sheet.amplitude = Some(amplitude))?;
            let verdicts = low_period_traps(&motor, &preloads, &Unobserved)?;
            let trapped = verdicts.iter().filter(|verdict| verdict.is_trap).count();
            Ok::<_, ExperimentError>((amplitude, trapped as f64 / preloads.len() as f64))
        };
        let amplitudes = paper::section_five()?.amplitudes_of_fig10_m;
        let trapped_of_fig11 = amplitudes.into_iter().map(trapped).collect::<Result<_, _>>()?;
        progress.advance(1);
        let restitution = motor.parameters().restitution;
        Ok(ExtraTrapsData { restitution, by_fraction, by_restitution, trapped_of_fig11 })
    }

    fn draw(data: &ExtraTrapsData) -> Result<Figure, ExperimentError> {
        let dotted = Stroke::new(Colour::BLACK, 0.5).dashed(Dash::Dotted);
        let integers = (0.5, data.by_fraction.len() as f64 + 0.5);
        let by_fraction = Panel::new(Rect::new(40.0, 12.0, 196.0, 188.0))
            .x(Axis::linear(0.0, 1.0).label(r"fraction of $\Gamma$").ticks(Ticks::every(0.2).minor(2)))
            .y(Axis::linear(integers.0, integers.1).label(r"integer part of $\Gamma$"))
            .letter("a")
            .layer(raster(&data.by_fraction, (0.0, 1.0), integers))
            .layer(Rule::vertical(0.5).stroke(dotted));
        let (x, y) = (FORCINGS, RESTITUTIONS);
        let by_restitution = Panel::new(Rect::new(276.0, 12.0, 166.0, 188.0))
            .x(Axis::linear(x.0, x.1).label(r"$\Gamma$").ticks(Ticks::every(0.5).minor(5)))
            .y(Axis::linear(y.0, y.1).label(r"restitution $\epsilon$").ticks(Ticks::every(0.2).minor(4)))
            .letter("b")
            .layer(raster(&data.by_restitution, x, y))
            .layer(Rule::horizontal(data.restitution).stroke(dotted));
        // Below each other, the pale colour on the left.
        let squares: Vec<u8> = (0..KINDS as u8).rev().flat_map(|kind| [1 + 2 * kind, 2 + 2 * kind]).collect();
        let ticks = (0..KINDS).map(|kind| ((KINDS - 1 - kind) as f64 + 0.5, NAMES[kind]));
        let kinds = KINDS as f64;
        let legend = Panel::new(Rect::new(460.0, 40.0, 24.0, 80.0))
            .x(Axis::linear(0.0, 2.0).ticks(Ticks::none()))
            .y(Axis::linear(0.0, kinds).ticks(Ticks::none()))
            .right(Axis::linear(0.0, kinds).ticks(Ticks::at(ticks)))
            .title("flights")
            .layer(Raster::new(2, KINDS, squares, &palette(), (0.0, 2.0), (0.0, kinds)));
        Ok(Figure::new(DOUBLE_COLUMN, 235.0).panels([by_fraction, by_restitution, legend]))
    }
}

/// The middles of equal parts of a range.
fn middles((from, to): (f64, f64), count: usize) -> Vec<f64> {
    (0..count).map(|k| from + (to - from) * (k as f64 + 0.5) / count as f64).collect()
}

/// Verdicts on a motor with the preloads that give these Γ.
fn verdicts(motor: &Motor, forcings: impl Iterator<Item = f64>) -> Result<Vec<TrapVerdict>, ExperimentError> {
    let peak = motor.system().platform().peak_acceleration();
    let preloads: Vec<f64> = forcings.map(|forcing| peak / (PI * forcing)).collect();
    Ok(low_period_traps(motor, &preloads, &Unobserved)?)
}

/// The rows of a map, in parallel and in their order.
fn map(
    progress: &dyn Progress,
    rows: &[f64],
    verdicts: impl Fn(f64) -> Result<Vec<TrapVerdict>, ExperimentError> + Sync,
) -> Result<Vec<String>, ExperimentError> {
    let digit = |verdict: &TrapVerdict| {
        let flights = verdict.cycle.map_or(0, |cycle| cycle.long_flights.min(KINDS)) as u8;
        let kind = if flights == 0 { 0 } else { 2 * flights - 1 + u8::from(verdict.is_trap) };
        char::from(b'0' + kind)
    };
    let row = |row: &f64| {
        let done = verdicts(*row).map(|verdicts| verdicts.iter().map(digit).collect::<String>());
        progress.advance(1);
        done
    };
    map_in_parallel(rows, row)
}

/// White, and of each kind the pale and the full colour.
fn palette() -> Vec<Colour> {
    let pairs = COLOURS.into_iter().flat_map(|colour| [colour.mixed(Colour::WHITE, PALE), colour]);
    std::iter::once(Colour::WHITE).chain(pairs).collect()
}

fn raster(rows: &[String], x: (f64, f64), y: (f64, f64)) -> Raster {
    let cells = rows.iter().flat_map(|row| row.bytes().map(|digit| digit.saturating_sub(b'0').min(8)));
    let columns = rows.first().map_or(0, String::len);
    Raster::new(columns, rows.len(), cells.collect(), &palette(), x, y)
}
