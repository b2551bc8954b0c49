//! Fig. 10(a)-(c): transient speed curves of the motor and their fits, for both readings of Table III.

mod measured;

use std::f64::consts::{PI, TAU};

use bouncing_disk::core::{ChatterPolicy, OrbitEvent};
use bouncing_disk::{Ensemble, ExponentialFit, RampFit, Spread, System, TransientSettings, ensemble};
use serde::{Deserialize, Serialize};

use crate::claim::Claim;
use crate::draw::{
    Anchor, Axis, Band, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Grid, Legend, Line, Panel, Rect, Text,
    Ticks,
};
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::figures::exponent;
use crate::figures::motor_case::{LOW_PERIOD_FLIGHTS, MotorCase, core_error};
use crate::ledger;
use crate::measured::{Layout, Series};
use crate::paper::{self, SectionFive, TableThree};
use crate::progress::Progress;

/// Relaunch perturbations (units of g/omega) for which the steady speed is compared.
const PERTURBATIONS: [f64; 7] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-7, 1e-9];

/// The smallest perturbation whose steady speed is held against that of the default.
const SMALLEST_COMPARED: f64 = 1e-5;

/// A relaunch perturbation (units of g/omega) that breaks the low-period cycle of panel (a).
const BREAKING_PERTURBATION: f64 = 0.1;

/// Curve points of the member that is drawn, and of the ensemble's band.
const MEMBER_INTERVALS: usize = 600;
const BAND_POINTS: usize = 60;

/// Fig. 10.
#[derive(Debug)]
pub struct Fig10;

/// The data of Fig. 10.
#[derive(Debug, Serialize, Deserialize)]
pub struct Fig10Data {
    table_iii: TableThree,
    section: SectionFive,
    members: usize,
    relaunch_perturbation: f64,
    readings: Vec<Reading>,
    broken_cycle: BrokenCycle,
    perturbations: Vec<PerturbationEffect>,
    own_motor_axial_forcing: f64,
    tsujino_axial_forcing: f64,
    tsujino_peak_acceleration: f64,
    /// A user's own trials.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    measured: Vec<measured::Trial>,
}

/// One reading of Table III.
#[derive(Debug, Serialize, Deserialize)]
struct Reading {
    preload_acceleration_m_per_s2: f64,
    frequency_hz: f64,
    duration_s: f64,
    /// mu a_e g/a_g^2: the acceleration if friction pushed one way all the time.
    largest_acceleration_rad_per_s2: f64,
    panels: Vec<Transient>,
}

/// One amplitude: a member with its fit, and the ensemble.
#[derive(Debug, Serialize, Deserialize)]
struct Transient {
    amplitude_m: f64,
    axial_forcing: f64,
    member_time_s: Vec<f64>,
    member_speed_rad_per_s: Vec<f64>,
    member_fit: ExponentialFit,
    band_time_s: Vec<f64>,
    band_low_rad_per_s: Vec<f64>,
    band_high_rad_per_s: Vec<f64>,
    steady_speed_rad_per_s: Spread,
    time_constant_s: Spread,
    stall_acceleration_rad_per_s2: Spread,
    stall_torque_n_m: Spread,
    /// Root mean square of member minus exponential fit, over the steady speed; mean over the ensemble.
    relative_oscillation: f64,
    /// The same for the fit of a linear rise to a constant speed.
    relative_ramp_residual: f64,
    /// The chattering cycle that the unperturbed motor repeats, if it does so within 200 impacts.
    cycle: Option<Cycle>,
    impacts_per_s: f64,
}

/// An eventually periodic chattering orbit: what happens between two separations from rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Cycle {
    platform_periods: u64,
    /// Flights longer than one period of the platform.
    long_flights: usize,
    impacts: usize,
}

/// The cycle of a motor that comes to rest within 200 impacts of a separation from rest: every separation leaves
/// it in the same vertical state, so the first rest closes the cycle. Not [`MotorCase::cycle`], which counts flights of more
/// than half a period.
fn cycle(system: &System) -> Result<Option<Cycle>, ExperimentError> {
    let map = system.dimensionless().map();
    let Some(phase) = map.vibration().separation_phase() else { return Ok(None) };
    let orbit = map.orbit_from_launch(phase, 0.0, ChatterPolicy::Complete).map_err(core_error)?;
    let mut cycle = Cycle { platform_periods: 0, long_flights: 0, impacts: 0 };
    for event in orbit.take(200) {
        match event.map_err(core_error)? {
            OrbitEvent::Impact(impact) => {
                cycle.impacts += 1;
                cycle.long_flights += usize::from(impact.periods > 0);
                cycle.platform_periods += impact.turns;
            }
            OrbitEvent::Stick(stick) => {
                let turns = stick.separation.map_or(0, |(_, turns)| turns);
                cycle.platform_periods += stick.attachment.turns + turns;
                return Ok(Some(cycle));
            }
            _ => {}
        }
    }
    Ok(None)
}

/// A panel whose low-period cycle a stronger perturbation breaks.
#[derive(Debug, Serialize, Deserialize)]
struct BrokenCycle {
    amplitude_m: f64,
    relaunch_perturbation: f64,
    fit: ExponentialFit,
    steady_speed_rad_per_s: Spread,
    relative_oscillation: f64,
}

/// Steady speed against the size of the relaunch perturbation (first reading, default amplitude).
#[derive(Debug, Serialize, Deserialize)]
struct PerturbationEffect {
    relaunch_perturbation: f64,
    steady_speed_rad_per_s: Spread,
}

/// Gamma of an amplitude (m), frequency (Hz) and preload acceleration (m/s^2).
fn axial_forcing(amplitude: f64, frequency_hz: f64, preload: f64) -> f64 {
    let angular_frequency = TAU * frequency_hz;
    amplitude * angular_frequency * angular_frequency / (PI * preload)
}

/// Root mean square of member minus exponential fit over the steady speed, mean over the ensemble.
fn relative_oscillation(runs: &Ensemble) -> f64 {
    runs.fits.iter().map(|fit| fit.residual / fit.steady_speed).sum::<f64>() / runs.fits.len() as f64
}

fn transient(system: &System, runs: &Ensemble, mass: f64) -> Result<Transient, ExperimentError> {
    let member = &runs.curves[0];
    let fit = runs.fits[0];
    let per_point = member.times.len() / BAND_POINTS;
    let (mut time, mut low, mut high) = (Vec::new(), Vec::new(), Vec::new());
    for point in 0..BAND_POINTS {
        let range = point * per_point..(point + 1) * per_point;
        let means: Vec<f64> = runs
            .curves
            .iter()
            .map(|curve| curve.speeds[range.clone()].iter().sum::<f64>() / per_point as f64)
            .collect();
        let spread = Spread::of(&means).map_err(ExperimentError::model)?;
        time.push(0.5 * (member.times[range.start] + member.times[range.end - 1]));
        low.push(spread.mean - spread.deviation);
        high.push(spread.mean + spread.deviation);
    }
    let mut ramp_residual = 0.0;
    for curve in &runs.curves {
        let ramp = RampFit::new(&curve.times, &curve.speeds).map_err(ExperimentError::model)?;
        ramp_residual += ramp.residual / ramp.steady_speed;
    }
    let gyration_radius = system.disk().gyration_radius();
    let torque = |acceleration: f64| mass * gyration_radius * gyration_radius * acceleration;
    let stall = runs.stall_acceleration;
    Ok(Transient {
        amplitude_m: system.platform().amplitude(),
        axial_forcing: system.axial_forcing(),
        member_time_s: member.times.clone(),
        member_speed_rad_per_s: member.speeds.clone(),
        member_fit: fit,
        band_time_s: time,
        band_low_rad_per_s: low,
        band_high_rad_per_s: high,
        steady_speed_rad_per_s: runs.steady_speed,
        time_constant_s: runs.time_constant,
        stall_acceleration_rad_per_s2: stall,
        stall_torque_n_m: Spread {
            mean: torque(stall.mean),
            deviation: torque(stall.deviation),
            standard_error: torque(stall.standard_error),
        },
        relative_oscillation: relative_oscillation(runs),
        relative_ramp_residual: ramp_residual / runs.curves.len() as f64,
        cycle: cycle(system)?,
        impacts_per_s: member.impacts as f64 / (member.times[0] + member.times[member.times.len() - 1]),
    })
}

impl Experiment for Fig10 {
    type Data = Fig10Data;

    const ID: &'static str = "fig10";

    const TITLE: &'static str = "Transient speed curves of the ultrasonic motor";
    const READING: &str = include_str!("fig10/reading.md");

    const MEASUREMENTS: &'static [Layout] = &[measured::LAYOUT];

    fn caption(data: &Fig10Data) -> String {
        format!(
            "Transient speed curves of the motor of Table III from rest, each fitted with α̇_ss(1 − e^(−t/t_c)), for \
             A = 10⁻⁹, 10⁻⁸ and 10⁻⁷ m. (a)–(c) preload acceleration {} m/s² (gravity; the 70 of Table III read as \
             ω/2π in kHz); (d)–(f) the same with g = {} m/s² as printed. Grey line: one member (speeds averaged over \
             1/{} of the time shown); black dashed line: its fit; blue band: mean ± one standard deviation of {} \
             members, which differ in the starting phase and in the seed of a relaunch perturbation below {} g/ω. In (a) the \
             motor repeats a low-period chattering cycle; the dotted line is the fit when perturbations of {} g/ω break \
             it. The measured curves of the paper's panels (d)–(f) are not in its text.{}",
            data.section.gravity_m_per_s2,
            data.table_iii.preload_acceleration_m_per_s2,
            MEMBER_INTERVALS,
            data.members,
            data.relaunch_perturbation,
            data.broken_cycle.relaunch_perturbation,
            measured::caption(&data.measured),
        )
    }

    fn run(quality: Quality, progress: &dyn Progress) -> Result<Fig10Data, ExperimentError> {
        let table = paper::table_three()?;
        let section = paper::section_five()?;
        let case = MotorCase::default_of(&table, &section);
        let members = quality.choose(6, 32);
        let mass = section.rotor_mass_kg();
        let defaults = TransientSettings::default();
        let amplitudes = section.amplitudes_of_fig10_m;
        progress.start((2 * amplitudes.len() + 1 + PERTURBATIONS.len()) as u64, "ensembles");

        let mut readings = Vec::new();
        for (preload, duration) in
            [(section.gravity_m_per_s2, 6.0), (table.preload_acceleration_m_per_s2, 0.9)]
        {
            let mut panels = Vec::new();
            for amplitude in amplitudes {
                let system =
                    MotorCase { amplitude_m: amplitude, preload_acceleration_m_per_s2: preload, ..case }
                        .system()?;
                let settings = TransientSettings { duration, intervals: MEMBER_INTERVALS, ..defaults };
                let runs = ensemble(&system, &settings, members).map_err(ExperimentError::model)?;
                panels.push(transient(&system, &runs, mass)?);
                progress.advance(1);
            }
            let arm =
                1e-3 * table.contact_radius_mm / (1e-6 * table.gyration_radius_mm * table.gyration_radius_mm);
            readings.push(Reading {
                preload_acceleration_m_per_s2: preload,
                frequency_hz: section.default_frequency_hz,
                duration_s: duration,
                largest_acceleration_rad_per_s2: table.friction * arm * preload,
                panels,
            });
        }

        let smallest = amplitudes[0];
        let system = MotorCase { amplitude_m: smallest, ..case }.system()?;
        let settings = TransientSettings {
            duration: readings[0].duration_s,
            intervals: MEMBER_INTERVALS,
            relaunch_perturbation: BREAKING_PERTURBATION,
            ..defaults
        };
        let runs = ensemble(&system, &settings, members).map_err(ExperimentError::model)?;
        let broken_cycle = BrokenCycle {
            amplitude_m: smallest,
            relaunch_perturbation: BREAKING_PERTURBATION,
            fit: runs.fits[0],
            steady_speed_rad_per_s: runs.steady_speed,
            relative_oscillation: relative_oscillation(&runs),
        };
        progress.advance(1);

        let system = case.system()?;
        let mut perturbations = Vec::new();
        for relaunch_perturbation in PERTURBATIONS {
            let settings =
                TransientSettings { duration: quality.choose(6.0, 20.0), relaunch_perturbation, ..defaults };
            let runs = ensemble(&system, &settings, members).map_err(ExperimentError::model)?;
            // The last two thirds: six time constants after the start at the least.
            let means = runs.curves.iter().map(|curve| curve.mean_over_last(2.0 / 3.0));
            let means = means.collect::<Result<Vec<_>, _>>().map_err(ExperimentError::model)?;
            perturbations.push(PerturbationEffect {
                relaunch_perturbation,
                steady_speed_rad_per_s: Spread::of(&means).map_err(ExperimentError::model)?,
            });
            progress.advance(1);
        }
        Ok(Fig10Data {
            members,
            relaunch_perturbation: defaults.relaunch_perturbation,
            readings,
            broken_cycle,
            perturbations,
            own_motor_axial_forcing: axial_forcing(
                section.own_motor_amplitude_m,
                section.default_frequency_hz,
                section.gravity_m_per_s2,
            ),
            tsujino_axial_forcing: axial_forcing(
                section.tsujino_amplitude_m,
                section.tsujino_frequency_hz,
                section.tsujino_preload_acceleration_m_per_s2,
            ),
            tsujino_peak_acceleration: PI
                * axial_forcing(
                    section.tsujino_amplitude_m,
                    section.tsujino_frequency_hz,
                    section.tsujino_preload_acceleration_m_per_s2,
                ),
            table_iii: table,
            section,
            measured: Vec::new(),
        })
    }

    fn overlay(data: &mut Fig10Data, series: &Series) -> Result<(), ExperimentError> {
        data.measured = measured::trials(series)?;
        Ok(())
    }

    fn draw(data: &Fig10Data) -> Result<Figure, ExperimentError> {
        let rows = if data.measured.is_empty() { 2 } else { 3 };
        let height = 150.0 * rows as f64;
        let grid = Grid::new(DOUBLE_COLUMN, height, rows, 3);
        let mut figure = Figure::new(DOUBLE_COLUMN, height);
        for (row, reading) in data.readings.iter().enumerate() {
            for (column, panel) in reading.panels.iter().enumerate() {
                let letter = ["a", "b", "c", "d", "e", "f"][3 * row + column];
                let mut area = drawn(grid.cell(row, column), letter, reading, panel);
                if row == 0 && column == 0 {
                    let fit = data.broken_cycle.fit;
                    area = area.layer(
                        Line::new(sampled(reading.duration_s, |time| fit.speed(time)))
                            .colour(Colour::VERMILION)
                            .dash(Dash::Dotted)
                            .name("fit, cycle broken"),
                    );
                }
                figure = figure.panel(area);
            }
        }
        if let Some(panel) = data.readings.first().and_then(|reading| reading.panels.get(1)) {
            let model = ExponentialFit {
                steady_speed: panel.steady_speed_rad_per_s.mean,
                time_constant: panel.time_constant_s.mean,
                residual: 0.0,
            };
            for trial in &data.measured {
                let cell = grid.cell(2, trial.trial as usize - 1);
                figure = figure.panel(measured::panel(cell, &data.measured, trial, model));
            }
        }
        Ok(figure)
    }

    fn claims(data: &Fig10Data) -> Vec<Claim> {
        claims(data)
    }

    fn parameters(data: &Fig10Data) -> Vec<(String, String)> {
        let table = &data.table_iii;
        let value = |name: &str, value: f64, unit: &str| {
            (name.to_owned(), format!("{value} {unit}").trim().to_owned())
        };
        vec![
            value("μ", table.friction, ""),
            value("ε", table.restitution, ""),
            value("θ", table.phase_lag_rad, "rad"),
            value("ωΦ", table.peak_angular_speed_rad_per_s, "rad/s"),
            value("a_e", table.contact_radius_mm, "mm"),
            value("a_g", table.gyration_radius_mm, "mm"),
            value("ω/2π", data.section.default_frequency_hz, "Hz"),
            value("members", data.members as f64, ""),
            value("relaunch perturbation", data.relaunch_perturbation, "g/ω"),
        ]
    }
}

fn drawn(area: Rect, letter: &str, reading: &Reading, panel: &Transient) -> Panel {
    let fit = panel.member_fit;
    let smooth = sampled(reading.duration_s, |time| fit.speed(time));
    let band = panel
        .band_time_s
        .iter()
        .zip(panel.band_low_rad_per_s.iter().zip(&panel.band_high_rad_per_s))
        .map(|(&time, (&low, &high))| (time, low, high));
    let member =
        panel.member_time_s.iter().zip(&panel.member_speed_rad_per_s).map(|(&time, &speed)| (time, speed));
    let note = |y: f64, text: String| Text::at_axes(0.94, y, text).anchor(Anchor::Right);
    let ensemble = |spread: &Spread, digits: usize| {
        format!("{:.digits$} \\pm {:.digits$}", spread.mean, spread.deviation)
    };
    let drawn = Panel::new(area)
        .letter_in(letter, Corner::TopLeft)
        .x(Axis::linear(0.0, reading.duration_s)
            .ticks(Ticks::every(if reading.duration_s > 2.0 { 2.0 } else { 0.3 }))
            .label(r"$t$ (s)"))
        .y(Axis::linear(0.0, 44.0).ticks(Ticks::every(10.0)).label(r"$\dot{\alpha}$ (rad/s)"))
        .layer(Line::new(member).colour(Colour::GREY).width(0.6).name("one member"))
        .layer(Band::new(band).colour(Colour::BLUE).opacity(0.30).name("ensemble"))
        .layer(Line::new(smooth).colour(Colour::BLACK).width(1.0).dash(Dash::Dashed).name("fit"))
        .layer(note(0.28, format!("$A = 10^{{{}}}$ m", exponent(panel.amplitude_m))))
        .layer(note(0.20, format!("$g = {}$ m/s$^2$", reading.preload_acceleration_m_per_s2)))
        .layer(note(
            0.12,
            format!(r"$\dot{{\alpha}}_{{ss}} = {}$ rad/s", ensemble(&panel.steady_speed_rad_per_s, 1)),
        ))
        .layer(note(0.04, format!("$t_c = {}$ s", ensemble(&panel.time_constant_s, 3))));
    if letter == "a" { drawn.legend(Legend::at(Corner::TopRight)) } else { drawn }
}

/// A curve at 201 times from 0 to `duration`.
fn sampled(duration: f64, curve: impl Fn(f64) -> f64) -> impl Iterator<Item = (f64, f64)> {
    (0..=200).map(move |i| {
        let time = duration * f64::from(i) / 200.0;
        (time, curve(time))
    })
}

fn claims(data: &Fig10Data) -> Vec<Claim> {
    let id = Fig10::ID;
    let section = &data.section;
    let [first, second] = &data.readings[..] else { return Vec::new() };
    let mut claims = vec![
        Claim::printed("section1.own_motor_axial_forcing", data.own_motor_axial_forcing)
            .note("ω read as 2π · 70 kHz, which this number confirms"),
        Claim::printed("section1.tsujino_axial_forcing", data.tsujino_axial_forcing).note(format!(
            "A ω²/g without the factor π is {:.1}, which rounds to the printed value: the π of the definition was left out",
            data.tsujino_peak_acceleration
        )),
        Claim::printed_statement(
            "section1.motors_bounce",
            data.own_motor_axial_forcing.min(data.tsujino_axial_forcing) * PI > 1.0,
            format!(
                "Γ = {:.2} and {:.2} for the two motors of Sec. I",
                data.own_motor_axial_forcing, data.tsujino_axial_forcing
            ),
        ),
        Claim::reading(id, "table3.preload_acceleration", "default g", section.gravity_m_per_s2).note(format!(
            "Sec. V A announces {} inputs and Table III prints {}; the frequency is missing, its default is {} kHz, and \
             preload is gravity: the 70 is ω/2π in kHz. Both readings are computed",
            ledger::text("section5.announced_inputs").unwrap_or_default(),
            paper::printed_inputs(),
            section.default_frequency_hz / 1000.0
        )),
    ];
    let lowest = first.panels.iter().map(|panel| panel.axial_forcing).fold(f64::INFINITY, f64::min);
    let merging = ledger::number("section4.merging", 0).map_or(f64::NAN, |printed| printed.value);
    claims.push(Claim::printed_statement(
        "section4.motor_regime",
        lowest > merging,
        format!("the smallest A of Fig. 10 has Γ = {lowest:.2}"),
    ));
    let oscillations: Vec<f64> = first.panels.iter().map(|panel| panel.relative_oscillation).collect();
    let ramps: Vec<f64> = first.panels.iter().map(|panel| panel.relative_ramp_residual).collect();
    let percent = |values: &[f64]| {
        values.iter().map(|value| format!("{:.2} %", 100.0 * value)).collect::<Vec<_>>().join(", ")
    };
    let broken = &data.broken_cycle;
    let low_period = first.panels[0].cycle.as_ref().map_or_else(String::new, |cycle| {
        format!(
            "; at A = 10⁻⁹ m, where A ω²/g = 2π² to all printed digits, the motor repeats a chattering cycle of {} periods \
             with {} long flights, so the speed rises linearly and then stays (the form of Fig. 12); relaunch perturbations \
             of {} g/ω break the cycle and give α̇_ss = {:.1} ± {:.1} rad/s and {:.2} %",
            cycle.platform_periods,
            cycle.long_flights,
            broken.relaunch_perturbation,
            broken.steady_speed_rad_per_s.mean,
            broken.steady_speed_rad_per_s.deviation,
            100.0 * broken.relative_oscillation
        )
    });
    claims.push(Claim::printed_statement(
        "section5.exponential_transients",
        oscillations.iter().zip(&ramps).all(|(exponential, ramp)| exponential < ramp),
        format!(
            "root mean square deviation over α̇_ss from the exponential: {}; from a linear rise to a constant: {}{low_period}",
            percent(&oscillations),
            percent(&ramps)
        ),
    ));
    claims.push(Claim::printed_statement(
        "section5.oscillation_grows",
        oscillations.windows(2).all(|pair| pair[0] < pair[1]),
        format!(
            "deviation from the exponential at 10⁻⁹, 10⁻⁸, 10⁻⁷ m: {}{low_period}",
            percent(&oscillations)
        ),
    ));
    let kicked = [broken.relative_oscillation, oscillations[1], oscillations[2]];
    claims.push(Claim::statement(
        id,
        "Sec. V B",
        "the oscillation of the speed grows with A, the low-period cycle of the smallest A broken",
        kicked.windows(2).all(|pair| pair[0] < pair[1]),
        format!("deviation from the exponential at 10⁻⁹, 10⁻⁸, 10⁻⁷ m: {}", percent(&kicked)),
    ));
    let rates: Vec<f64> = first.panels.iter().map(|panel| panel.impacts_per_s).collect();
    claims.push(Claim::printed_statement(
        "section5.frequent_collisions",
        rates.windows(2).all(|pair| pair[0] > pair[1]),
        format!(
            "impacts per second at 10⁻⁹, 10⁻⁸, 10⁻⁷ m: {}",
            rates.iter().map(|rate| format!("{rate:.0}")).collect::<Vec<_>>().join(", ")
        ),
    ));
    let within_limit = data
        .readings
        .iter()
        .flat_map(|reading| reading.panels.iter().map(move |panel| (reading, panel)))
        .all(|(reading, panel)| {
            panel.stall_acceleration_rad_per_s2.mean <= reading.largest_acceleration_rad_per_s2
        });
    claims.push(Claim::printed_statement(
        "section5.torque_limit",
        within_limit,
        format!(
            "α̇_ss/t_c at the default A is {:.1} rad/s² (a torque of {:.2e} N m) against a limit μ a_e g/a_g² of {:.1} rad/s²; \
             as printed, g = 70 m/s²: {:.0} against {:.0} rad/s²",
            first.panels[1].stall_acceleration_rad_per_s2.mean,
            first.panels[1].stall_torque_n_m.mean,
            first.largest_acceleration_rad_per_s2,
            second.panels[1].stall_acceleration_rad_per_s2.mean,
            second.largest_acceleration_rad_per_s2
        ),
    ));
    let compared: Vec<&PerturbationEffect> = data
        .perturbations
        .iter()
        .filter(|effect| effect.relaunch_perturbation >= SMALLEST_COMPARED)
        .collect();
    let speeds = compared.iter().map(|effect| effect.steady_speed_rad_per_s.mean);
    let (least, most) = speeds.fold((f64::INFINITY, 0.0_f64), |(a, b), speed| (a.min(speed), b.max(speed)));
    let all = data
        .perturbations
        .iter()
        .map(|effect| {
            let spread = effect.steady_speed_rad_per_s;
            format!("{:e}: {:.2} ± {:.2}", effect.relaunch_perturbation, spread.mean, spread.standard_error)
        })
        .collect::<Vec<_>>()
        .join("; ");
    claims.push(Claim::statement(
        id,
        "our ensemble",
        "the steady speed does not depend on the relaunch perturbation from 1e-5 to 1e-1 g/ω (within 4 %)",
        most - least <= 0.04 * least,
        format!(
            "steady speed (rad/s) by perturbation: {all}. Below 1e-5 it falls slowly: the first impacts after a relaunch \
             are then the same every time, the more of them the smaller the perturbation"
        ),
    ));
    let cycles: Vec<(f64, &Cycle)> =
        first.panels.iter().filter_map(|panel| Some((panel.amplitude_m, panel.cycle.as_ref()?))).collect();
    let described: Vec<String> = cycles
        .iter()
        .map(|(amplitude, cycle)| {
            format!(
                "{} periods, {} long flights at A = {amplitude:e} m",
                cycle.platform_periods, cycle.long_flights
            )
        })
        .collect();
    claims.push(Claim::printed_statement(
        "section5.long_period_chattering",
        cycles.iter().all(|(_, cycle)| cycle.long_flights > LOW_PERIOD_FLIGHTS),
        format!(
            "cycles of the unperturbed motor from rest to rest that close within 200 impacts: {}; those of up to \
             {LOW_PERIOD_FLIGHTS} long flights are called low-period here",
            described.join(", ")
        ),
    ));
    claims
}
