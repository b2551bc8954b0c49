//! Beyond the paper: speed and mechanical power of its motor against the load.

use bouncing_disk::Motor;
use bouncing_disk::core::numerics::statistics::NORMAL_975;
use bouncing_disk::core::{ChatterPolicy, Unobserved};
use bouncing_disk::estimate::{FitSettings, IntervalEstimate, TransientEnsemble, TransientFit};
use bouncing_disk::motor::{Estimate, OperatingPoint, OperatingSettings, Operation, TransientSettings};
use bouncing_disk_plot::pictures::interval_curve;
use bouncing_disk_plot::{
    Anchor, Axis, Band, Colour, Corner, Dash, Figure, Fill, Grid, Legend, Line, Margins, Marker, Panel, Rule,
    SINGLE_COLUMN, Scatter, Stroke, Text, Ticks,
};
use serde::{Deserialize, Serialize};

use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// The highest load of the curve, as a share of the largest torque. Beyond it the motor is driven back faster
/// and faster, and needs ever longer to settle.
const LAST_SHARE: f64 = 0.8;

/// Duration of the transients in rise times ωΦ a_g²/(μ a_e g).
const RISES: f64 = 8.0;

/// The right end of the axis, as a share of the largest torque, and newton metres in micronewton metres.
const END: f64 = 1.12;
const MICRO: f64 = 1e6;

/// Speed and power against load.
#[derive(Debug)]
pub struct ExtraTorqueSpeed;

/// The data of the torque-speed figure.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraTorqueSpeedData {
    settings: OperatingSettings,
    /// μ m g a_e: no load above it is held.
    largest_torque_n_m: f64,
    points: Vec<OperatingPoint>,
    /// The load that stops the motor.
    stall_n_m: Estimate,
    /// The paper's estimate of it, the moment of inertia times α̇_ss/t_c of so many transients without load.
    transients: usize,
    paper_stall_n_m: IntervalEstimate,
}

impl Experiment for ExtraTorqueSpeed {
    type Data = ExtraTorqueSpeedData;
    const ID: &'static str = "extra-torque-speed";
    const TITLE: &'static str = "Speed and power of the motor against its load";
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![
            ("ensembles under load", OperatingSettings::default().seed),
            ("transients", TransientSettings::default().seed),
        ]
    }

    fn caption(data: &ExtraTorqueSpeedData) -> String {
        format!(
            "The motor of Table III at 70 kHz under a load: (a) mean speed, (b) mechanical power. Dots: means over {} perturbed \
             members; grey bands: 95 % intervals. Square: the load that stops the motor. Diamond: the paper's estimate from the run-up \
             without load, the moment of inertia times α̇_ss/t_c, with the 95 % interval of {} transients. Beyond μ m g a_e = {:.2} µN m \
             (grey) friction cannot hold the load and there is no steady speed. Dashed: the power if the speed fell along a straight \
             line from no load to stall.",
            data.settings.members,
            data.transients,
            MICRO * data.largest_torque_n_m,
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraTorqueSpeedData, ExperimentError> {
        let motor = Motor::paper_70_khz();
        let settings = OperatingSettings {
            relative_error: quality.choose(0.02, 0.0075),
            members: quality.choose(8, 16),
            most_impacts: quality.choose(10_000_000, 200_000_000),
            ..OperatingSettings::default()
        };
        progress.start(3, "ensembles");
        let (largest_torque_n_m, count) = (motor.largest_torque(), quality.choose(16, 48));
        let share = |k: u32| LAST_SHARE * f64::from(k) / f64::from(count);
        let loads: Vec<f64> = (0..=count).map(|k| share(k) * largest_torque_n_m).collect();
        let operations = motor.torque_speed_curve(&loads, &settings, &Unobserved)?;
        progress.advance(1);
        let stall_n_m = motor.stall_load(&settings, &Unobserved)?.torque;
        progress.advance(1);
        let (system, transients) = (motor.system(), quality.choose(12, 64));
        let duration = RISES * system.rise_time();
        let run_up = TransientSettings { duration, intervals: 240, ..TransientSettings::default() };
        let runs = TransientEnsemble::new(system, &run_up, transients, &Unobserved)?;
        let estimate = TransientFit::new(&runs.curves, &FitSettings::default())?.stall_acceleration();
        let [value, low, high] =
            [estimate.value, estimate.low, estimate.high].map(|own| motor.inertia() * own);
        progress.advance(1);
        Ok(ExtraTorqueSpeedData {
            settings,
            largest_torque_n_m,
            points: operations.iter().filter_map(Operation::point).copied().collect(),
            stall_n_m,
            transients,
            paper_stall_n_m: IntervalEstimate { value, low, high },
        })
    }

    fn draw(data: &ExtraTorqueSpeedData) -> Result<Figure, ExperimentError> {
        const HEIGHT: f64 = 330.0;
        let margins = Margins { left: 40.0, right: 12.0, top: 34.0, bottom: 34.0 };
        let grid = Grid::new(SINGLE_COLUMN, HEIGHT, 2, 1).margins(margins).gaps(10.0, 12.0);
        Ok(Figure::new(SINGLE_COLUMN, HEIGHT).panel(speeds(data, &grid)).panel(powers(data, &grid)))
    }
}

/// A panel over the loads with a quantity and its interval, and the region in which the motor runs away.
fn frame(
    data: &ExtraTorqueSpeedData,
    grid: &Grid,
    row: usize,
    of: impl Fn(&OperatingPoint) -> Estimate,
    (low, high): (f64, f64),
) -> Panel {
    let largest = MICRO * data.largest_torque_n_m;
    let x = Axis::linear(0.0, END * largest).ticks(Ticks::every(10.0).minor(5));
    let top = Axis::linear(0.0, END).ticks(Ticks::every(0.2).minor(2));
    let (x, top) = if row == 0 {
        (x.without_numbers(), top.label(r"load $T/(\mu m g a_e)$"))
    } else {
        (x.label(r"load torque $T$ (µN m)"), top.without_numbers())
    };
    let runaway = Band::new([(largest, low, high), (END * largest, low, high)]);
    let points: Vec<(f64, f64, f64)> = data
        .points
        .iter()
        .map(|point| (MICRO * point.load_torque, of(point).value, NORMAL_975 * of(point).standard_error))
        .collect();
    Panel::new(grid.cell(row, 0))
        .x(x)
        .top(top)
        .letter_in(["a", "b"][row], Corner::TopRight)
        .layer(runaway.colour(Colour::PALE_GREY).opacity(1.0))
        .layer(Rule::horizontal(0.0).stroke(Stroke::new(Colour::GREY, 0.5)))
        .layer(Rule::vertical(largest).stroke(Stroke::new(Colour::DARK_GREY, 0.8)))
        .layers(interval_curve(&points, Colour::BLACK, Fill::new(Colour::LIGHT_GREY, 0.8), None))
}

fn speeds(data: &ExtraTorqueSpeedData, grid: &Grid) -> Panel {
    let speeds = || data.points.iter().map(|point| point.speed.value);
    let (low, high) = (1.08 * speeds().fold(0.0_f64, f64::min), 1.3 * speeds().fold(0.0_f64, f64::max));
    let y = Axis::linear(low, high).ticks(Ticks::every(5.0).minor(5));
    let (stall, estimate) = (data.stall_n_m, data.paper_stall_n_m);
    let mark = |value: f64, half: f64, marker: Marker, colour: Colour| {
        let own = Scatter::new([(MICRO * value, 0.0)]).marker(marker).colour(colour);
        own.size(6.5).width(1.2).errors_x([MICRO * half])
    };
    let text = Text::at_data(1.06 * MICRO * data.largest_torque_n_m, 0.5 * (low + high), r"runs away");
    let half = NORMAL_975 * stall.standard_error;
    let estimated =
        mark(estimate.value, 0.5 * (estimate.high - estimate.low), Marker::Diamond, Colour::VERMILION);
    frame(data, grid, 0, |point| point.speed, (low, high))
        .y(y.label(r"mean speed $\dot{\alpha}$ (rad/s)"))
        .layer(mark(stall.value, half, Marker::Square, Colour::BLUE).name("stall load"))
        .layer(estimated.name(r"$I\dot{\alpha}_{ss}/t_c$ (paper)"))
        .layer(text.anchor(Anchor::Centre).rotated(90.0).size(8.0))
        .legend(Legend::at(Corner::BottomLeft))
}

fn powers(data: &ExtraTorqueSpeedData, grid: &Grid) -> Panel {
    let power = |point: &OperatingPoint| Estimate {
        value: MICRO * point.mechanical_power.value,
        standard_error: MICRO * point.mechanical_power.standard_error,
    };
    let highest = data.points.iter().map(|point| power(point).value).fold(0.0_f64, f64::max);
    let (low, high) = (-0.35 * highest, 1.25 * highest);
    let first = data.points.first().map_or(0.0, |point| point.speed.value);
    let stall = data.stall_n_m.value;
    // Of a straight line from the speed without load to the stall load.
    let parabola = (0..=60).map(|k| {
        let load = stall * f64::from(k) / 60.0;
        (MICRO * load, MICRO * load * first * (1.0 - load / stall))
    });
    let parabola = Line::new(parabola).dash(Dash::Dashed).colour(Colour::GREY).width(0.7);
    frame(data, grid, 1, power, (low, high))
        .y(Axis::linear(low, high).label(r"mechanical power $T\dot{\alpha}$ (µW)"))
        .layer(parabola.name("of a straight speed line"))
        .legend(Legend::at(Corner::BottomLeft))
}
