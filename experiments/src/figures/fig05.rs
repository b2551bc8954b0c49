//! Fig. 5: hand motions and the dough's motion in single tosses.

use std::f64::consts::{FRAC_PI_4, FRAC_PI_8, PI};

use bouncing_disk::System;
use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::motion::{EventKind, Mode};
use bouncing_disk::toss::{InitialSpin, toss_trajectory};
use bouncing_disk_plot::{
    Anchor, Axis, Band, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Grid, Legend, Line, Margins, Panel,
    Rule, Stroke, Text, Ticks,
};
use serde::Serialize;

use super::shared::toss::{AngleGrid, TossCase, launch_case, printed_angles, unreadable};
use crate::claims::paper::{self, SectionThree, TableOne};
use crate::claims::printed::PrintedNumber;
use crate::claims::{self as claim, Claim};
use crate::experiment::{ExperimentError, Paper, named};

/// Fig. 5.
pub(crate) fn fig05(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    let (quality, progress) = (fig.quality, fig.progress);
    let points = quality.choose(60, 240);
    let table_i = paper::table_one()?;
    let printed = paper::section_three()?;
    let table = TossCase::from(&table_i);
    let angles = [
        &printed.amplitude_angle_of_largest_speed_ratio_rad,
        &printed.optimal_amplitude_angle_rad,
        &printed.amplitude_angle_of_fig5c_rad,
    ];
    let phase_lags = [FIRST_PHASE_LAG, paper::value("section3.second_phase_lag_of_fig5")?];
    progress.start(angles.len() as u64 + 1, "columns");
    let mut columns = Vec::new();
    let mut optimum = table;
    for (index, text) in angles.into_iter().enumerate() {
        let Some(angle) = PrintedNumber::read(text) else { continue };
        let case = table.at_angle(angle.value);
        if index == 1 {
            optimum = case;
        }
        columns.push(Column::new(text, &case, phase_lags, points)?);
        progress.advance(1);
    }
    let lags = PHASE_LAGS_NEAR_ZERO
        .into_iter()
        .map(|lag| {
            let toss = Toss::new(&optimum.at_lag(lag), points)?;
            Ok::<_, ExperimentError>(Dependence {
                phase_lag_rad: lag,
                lowest_speed_rad_per_s: toss.lowest_speed_rad_per_s,
                late_gain_rad_per_s: toss.late_gain_rad_per_s,
            })
        })
        .collect::<Result<Vec<_>, _>>()?;
    let firm_grip = FRICTION_FACTORS
        .into_iter()
        .map(|factor| Grip::new(&table, factor, &columns))
        .collect::<Result<Vec<_>, _>>()?;
    let grid_point = GridPoint::new(&table_i, &printed)?;
    progress.advance(1);
    let data = &Fig05Data { table_i, printed, columns, lags, firm_grip, grid_point };
    fig.caption(format!(
        "Details of various hand motions (dashed curves) and the resulting dough trajectories (solid curves): height, \
         angle and angular speed in single tosses with Table I's parameters, for the amplitude ratios φ_L = {}. Two phase \
         lags, θ_1 = 0 (blue) and θ_2 = π/2 (vermilion), which have the same heights. Time runs from the hand's lowest point, \
         where the dough is at rest; shaded: dough and hand in contact, up to the separation at t_sep, at the phase τ_sep = ωt_sep − π/2. Heights are \
         shown up to the landing, angles and speeds in and after the contact. The effects of a suboptimal φ_L are seen \
         in the speeds at θ_1: slip at the separation at high φ_L, a low hand speed ωΦ at low φ_L.",
        data.columns.iter().map(|column| column.printed.as_str()).collect::<Vec<_>>().join(", ")
    ));
    fig.parameters(parameters(data));
    fig.claims(claims(data));
    fig.draw(draw(data)?);
    fig.data(data)
}

fn parameters(data: &Fig05Data) -> Vec<(String, String)> {
    let table = &data.table_i;
    let angles: Vec<_> = data.columns.iter().map(|column| column.printed.as_str()).collect();
    let lags = data.columns.first().map_or(String::new(), |column| {
        column.tosses.iter().map(|toss| pi(toss.phase_lag_rad)).collect::<Vec<_>>().join(", ")
    });
    named([
        ("amplitude angle φ_L", angles.join(", ")),
        ("phase lag θ", lags),
        ("stroke c", format!("{} m", table.stroke_m.value)),
        ("angular frequency ω", format!("{} rad/s", table.angular_frequency_rad_per_s.value)),
        ("contact radius a_e", format!("{} m", table.contact_radius_m.value)),
        ("radius of gyration a_g", format!("{} m", table.gyration_radius_m.value)),
        ("friction μ", table.friction.value.to_string()),
        ("gravity g", format!("{} m/s²", table.preload_acceleration_m_per_s2)),
        ("start", "lowest point of the hand, τ = 3π/2; dough at rest".to_owned()),
    ])
}

fn claims(data: &Fig05Data) -> Vec<Claim> {
    let mut claims = amplitude_ratio(data);
    claims.push(no_slip(data));
    claims.extend(phase_lag(data));
    claims
}

fn draw(data: &Fig05Data) -> Result<Figure, ExperimentError> {
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 3, 3)
        .margins(Margins { left: 40.0, right: 10.0, top: 18.0, bottom: 30.0 })
        .gaps(10.0, 36.0);
    let mut figure = Figure::new(DOUBLE_COLUMN, HEIGHT);
    for (index, row) in rows().iter().enumerate() {
        for (letter, column) in data.columns.iter().enumerate() {
            figure = figure.panel(panel(Panel::new(grid.cell(index, letter)), column, row, index, letter));
        }
    }
    Ok(figure)
}

/// The data of Fig. 5.
#[derive(Debug, Serialize)]
pub(crate) struct Fig05Data {
    table_i: TableOne,
    printed: SectionThree,
    columns: Vec<Column>,
    /// The toss at the printed optimal φ_L with phase lags about 0.
    lags: Vec<Dependence>,
    firm_grip: Vec<Grip>,
    grid_point: GridPoint,
}

/// The φ_L of panel (c) as a point of the even grid on which the three printed angles lie.
#[derive(Debug, Serialize)]
struct GridPoint {
    /// ω of Eq. (14), not rounded.
    angular_frequency_rad_per_s: f64,
    largest_amplitude_angle_rad: f64,
    intervals: u32,
    index: u32,
    amplitude_angle_rad: f64,
}

/// One amplitude ratio.
#[derive(Debug, Serialize)]
struct Column {
    /// φ_L as printed.
    printed: String,
    amplitude_angle_rad: f64,
    /// ωΦ.
    largest_hand_speed_rad_per_s: f64,
    /// One per phase lag of the caption.
    tosses: Vec<Toss>,
}

/// One toss, from the lowest point of the hand until the dough lands. Time runs from the start, heights from
/// the hand's mean height.
#[derive(Debug, Default, Serialize)]
struct Toss {
    phase_lag_rad: f64,
    time_s: Vec<f64>,
    hand_height_m: Vec<f64>,
    dough_height_m: Vec<f64>,
    hand_angle_rad: Vec<f64>,
    dough_angle_rad: Vec<f64>,
    hand_speed_rad_per_s: Vec<f64>,
    dough_speed_rad_per_s: Vec<f64>,
    separation_time_s: f64,
    /// The highest point of the flight.
    apex_height_m: f64,
    airborne_speed_rad_per_s: f64,
    hand_speed_at_separation_rad_per_s: f64,
    /// Hand minus dough at the separation.
    slip_at_separation_rad_per_s: f64,
    sliding_at_separation: bool,
    /// The dough's lowest speed in contact.
    lowest_speed_rad_per_s: f64,
    /// The increase of the speed in the second half of the time in contact.
    late_gain_rad_per_s: f64,
}

/// The effect of a phase lag on the toss.
#[derive(Debug, Serialize)]
struct Dependence {
    phase_lag_rad: f64,
    lowest_speed_rad_per_s: f64,
    late_gain_rad_per_s: f64,
}

/// The tosses of the three columns at θ_1 with more friction.
#[derive(Debug, Serialize)]
struct Grip {
    friction: f64,
    /// 1 minus airborne speed over hand speed at the separation, by column.
    missing_share: Vec<f64>,
}

/// θ_1 of the caption.
const FIRST_PHASE_LAG: f64 = 0.0;

/// Phase lags about the optimum for the remarks on torque.
const PHASE_LAGS_NEAR_ZERO: [f64; 5] = [-FRAC_PI_4, -FRAC_PI_8, 0.0, FRAC_PI_8, FRAC_PI_4];

/// Multiples of Table I's friction for the limit of sufficient friction.
const FRICTION_FACTORS: [f64; 4] = [1.0, 10.0, 100.0, 1000.0];

impl GridPoint {
    fn new(table: &TableOne, section: &SectionThree) -> Result<Self, ExperimentError> {
        let case = launch_case(table, section);
        let grid = AngleGrid::with(case.largest_angle(), &printed_angles(section)?).ok_or_else(unreadable)?;
        let index = grid.indices.last().copied().ok_or_else(unreadable)?;
        Ok(Self {
            angular_frequency_rad_per_s: case.angular_frequency_rad_per_s,
            largest_amplitude_angle_rad: grid.largest,
            intervals: grid.intervals,
            index,
            amplitude_angle_rad: grid.angle(index),
        })
    }
}

impl Column {
    fn new(
        printed: &str,
        case: &TossCase,
        phase_lags: [f64; 2],
        points: u32,
    ) -> Result<Self, ExperimentError> {
        let tosses = phase_lags.into_iter().map(|lag| Toss::new(&case.at_lag(lag), points));
        Ok(Self {
            printed: printed.to_owned(),
            amplitude_angle_rad: case.amplitude_angle_rad,
            largest_hand_speed_rad_per_s: case.system()?.platform().peak_angular_speed(),
            tosses: tosses.collect::<Result<_, _>>()?,
        })
    }
}

impl Toss {
    fn new(case: &TossCase, points: u32) -> Result<Self, ExperimentError> {
        let system = case.system()?;
        let trajectory = toss_trajectory(&system, InitialSpin::AbsoluteRest)?;
        let scales = system.scales();
        let mut toss = Self { phase_lag_rad: case.phase_lag_rad, ..Self::default() };
        let mut lowest = f64::INFINITY;
        for record in trajectory.records() {
            let flies = record.before.mode == Mode::Flight;
            for step in 0..=points {
                let snapshot = record.evaluate(system.dimensionless(), f64::from(step) / f64::from(points));
                let time = scales.span_seconds(snapshot.time.since(&trajectory.start()));
                let state = scales.state(&snapshot.disk);
                toss.push(&system, snapshot.time.phase, time);
                toss.dough_height_m.push(state.height);
                toss.dough_angle_rad.push(state.angle);
                toss.dough_speed_rad_per_s.push(state.angular_speed);
                if !flies {
                    lowest = lowest.min(state.angular_speed);
                }
            }
            if record.event.kind() == EventKind::Separation {
                let state = scales.state(&record.after);
                toss.separation_time_s = scales.span_seconds(record.time.since(&trajectory.start()));
                toss.airborne_speed_rad_per_s = state.angular_speed;
                toss.hand_speed_at_separation_rad_per_s = system.platform().angular_speed(record.time.phase);
                toss.slip_at_separation_rad_per_s =
                    toss.hand_speed_at_separation_rad_per_s - state.angular_speed;
                toss.sliding_at_separation = matches!(record.before.mode, Mode::Sliding(_));
                let rise =
                    state.axial_velocity * state.axial_velocity / (2.0 * case.preload_acceleration_m_per_s2);
                toss.apex_height_m = state.height + rise;
            }
        }
        toss.lowest_speed_rad_per_s = lowest;
        let middle = trajectory.start().after(bouncing_disk::motion::PhaseSpan::from_radians(
            0.5 * toss.separation_time_s * case.angular_frequency_rad_per_s,
        ));
        let speed_at_middle =
            trajectory.at(middle).map(|snapshot| scales.state(&snapshot.disk).angular_speed);
        toss.late_gain_rad_per_s = toss.airborne_speed_rad_per_s - speed_at_middle.unwrap_or_default();
        Ok(toss)
    }

    fn push(&mut self, system: &System, phase: Phase, time: f64) {
        let hand = system.platform();
        self.time_s.push(time);
        self.hand_height_m.push(hand.height(phase));
        self.hand_angle_rad.push(hand.angle(phase));
        self.hand_speed_rad_per_s.push(hand.angular_speed(phase));
    }
}

impl Grip {
    fn new(table: &TossCase, factor: f64, columns: &[Column]) -> Result<Self, ExperimentError> {
        let friction = factor * table.friction;
        let missing = columns.iter().map(|column| {
            let case =
                TossCase { friction, ..table.at_angle(column.amplitude_angle_rad).at_lag(FIRST_PHASE_LAG) };
            let toss = Toss::new(&case, 1)?;
            Ok::<_, ExperimentError>(
                toss.slip_at_separation_rad_per_s / toss.hand_speed_at_separation_rad_per_s,
            )
        });
        Ok(Self { friction, missing_share: missing.collect::<Result<_, _>>()? })
    }
}

const HEIGHT: f64 = 400.0;
/// The end of the time axes (s): a whole toss for the heights, the contact and what follows for the angles.
const LAST_TIME: [f64; 3] = [0.9, 0.32, 0.32];
const COLOURS: [Colour; 2] = [Colour::BLUE, Colour::VERMILION];
const LAGS: [&str; 2] = [r"$\theta_1 = 0$", r"$\theta_2 = \pi/2$"];

/// One row: the drawn quantity and its axis.
struct Row {
    hand: fn(&Toss) -> &[f64],
    dough: fn(&Toss) -> &[f64],
    axis: Axis,
    low: f64,
    high: f64,
}

impl Row {
    /// With an axis over (`low`, `high`) that has a number every `step`.
    fn new([hand, dough]: [fn(&Toss) -> &[f64]; 2], (low, high): (f64, f64), step: f64, label: &str) -> Self {
        let axis = Axis::linear(low, high).label(label).ticks(Ticks::every(step)).label_distance(25.0);
        Self { hand, dough, axis, low, high }
    }
}

fn rows() -> [Row; 3] {
    [
        Row::new(
            [|toss| &toss.hand_height_m, |toss| &toss.dough_height_m],
            (-0.35, 0.95),
            0.25,
            "height (m)",
        ),
        Row::new(
            [|toss| &toss.hand_angle_rad, |toss| &toss.dough_angle_rad],
            (-2.4, 4.8),
            1.0,
            "angle (rad)",
        ),
        Row::new(
            [|toss| &toss.hand_speed_rad_per_s, |toss| &toss.dough_speed_rad_per_s],
            (-30.0, 38.0),
            10.0,
            "angular speed (rad/s)",
        ),
    ]
}

fn curve(toss: &Toss, values: &[f64]) -> Line {
    Line::new(toss.time_s.iter().copied().zip(values.iter().copied()).collect::<Vec<_>>()).width(1.2)
}

fn panel(mut panel: Panel, column: &Column, row: &Row, index: usize, letter: usize) -> Panel {
    let last = LAST_TIME[index];
    let step = if last > 0.5 { 0.2 } else { 0.1 };
    let y = if letter == 0 { row.axis.clone() } else { row.axis.clone().label("").without_numbers() };
    panel = panel.x(Axis::linear(0.0, last).label("$t$ (s)").ticks(Ticks::every(step))).y(y);
    let Some(first) = column.tosses.first() else { return panel };
    let contact = [(0.0, row.low, row.high), (first.separation_time_s, row.low, row.high)];
    panel = panel
        .layer(Band::new(contact).colour(Colour::PALE_GREY).opacity(0.7))
        .layer(Rule::horizontal(0.0).stroke(Stroke::new(Colour::LIGHT_GREY, 0.5)))
        .layer(
            Rule::vertical(first.separation_time_s)
                .stroke(Stroke::new(Colour::GREY, 0.7).dashed(Dash::Dotted)),
        );
    // Both phase lags have the same heights.
    let shown = if index == 0 { 1 } else { column.tosses.len() };
    for (toss, (colour, lag)) in column.tosses.iter().zip(COLOURS.into_iter().zip(LAGS)).take(shown) {
        let colour = if index == 0 { Colour::BLACK } else { colour };
        let (hand, dough) = (curve(toss, (row.hand)(toss)), curve(toss, (row.dough)(toss)));
        let hand = hand.colour(colour).dash(Dash::Dashed);
        let dough = dough.colour(colour);
        panel = match index {
            0 => panel.layer(hand.name("hand")).layer(dough.name("dough")),
            _ => panel.layer(hand).layer(dough.name(lag)),
        };
    }
    match (index, letter) {
        (0, 2) | (1, 0) => panel = panel.legend(Legend::at(Corner::TopRight).without_frame().inset(2.0)),
        _ => {}
    }
    if index == 0 {
        let name = format!(r"$\phi_L = {}$", column.printed.replace('π', r"\pi"));
        let sep = Text::at_data(
            first.separation_time_s + 0.012 * last,
            row.low + 0.12 * (row.high - row.low),
            r"$t_{sep}$",
        );
        panel = panel
            .title(format!("({}) {name}", ["a", "b", "c"][letter]))
            .layer(sep.anchor(Anchor::LeftCentre).size(8.0));
    }
    panel
}

/// The share of the hand's speed that a dough in a firm grip may lack.
const NEARLY_NOTHING: f64 = 0.01;
/// The hand's speed at the lowest point, cos(3π/2 + θ), is known to this share of the largest one.
const ROUNDING: f64 = 100.0 * f64::EPSILON;
fn pi(angle: f64) -> String {
    format!("{:.3}π", angle / PI)
}

/// The toss at θ_1 of a column.
fn first(column: &Column) -> Option<&Toss> {
    column.tosses.first()
}

/// A quantity of the tosses at θ_1, by column, as text.
fn listed(data: &Fig05Data, value: impl Fn(&Column, &Toss) -> String) -> String {
    let parts = data.columns.iter().filter_map(|column| {
        first(column).map(|toss| format!("φ_L = {}: {}", column.printed, value(column, toss)))
    });
    parts.collect::<Vec<_>>().join("; ")
}

fn values(data: &Fig05Data, value: impl Fn(&Column, &Toss) -> f64) -> Vec<f64> {
    data.columns.iter().filter_map(|column| first(column).map(|toss| value(column, toss))).collect()
}

fn rises(values: &[f64]) -> Option<bool> {
    claim::all(values.windows(2), |pair| pair[0] < pair[1])
}

fn falls(values: &[f64]) -> Option<bool> {
    claim::all(values.windows(2), |pair| pair[0] > pair[1])
}

/// Whether all of several statements hold; `None` where one of them has no data.
fn both<const N: usize>(statements: [Option<bool>; N]) -> Option<bool> {
    statements.into_iter().try_fold(true, |so_far, holds| Some(so_far && holds?))
}

/// What φ_L does.
fn amplitude_ratio(data: &Fig05Data) -> Vec<Claim> {
    let slip_share =
        |_: &Column, toss: &Toss| toss.slip_at_separation_rad_per_s / toss.hand_speed_at_separation_rad_per_s;
    let slips = values(data, slip_share);
    let point = &data.grid_point;
    let height = values(data, |_, toss| toss.apex_height_m);
    let speed = values(data, |_, toss| toss.airborne_speed_rad_per_s);
    vec![
        Claim::printed_statement(
            "section3.slip_at_high_angle",
            both([
                data.columns.last().and_then(first).map(|toss| toss.sliding_at_separation),
                rises(&slips),
            ]),
            listed(data, |column, toss| format!("{:.1} % behind the hand", 100.0 * slip_share(column, toss))),
        )
        .note("θ = 0; at low φ_L the dough slides in the last moments only, where N falls to zero"),
        Claim::printed_statement(
            "section3.middle_column_is_fastest",
            match speed[..] {
                [low, middle, high] => Some(middle > low && middle > high),
                _ => None,
            },
            listed(data, |_, toss| format!("airborne speed {:.2} rad/s", toss.airborne_speed_rad_per_s)),
        )
        .note("θ = 0; the fastest toss with Table I's parameters has another φ_L, see fig04"),
        Claim::printed_statement(
            "section3.height_falls_with_angle",
            falls(&height),
            listed(data, |_, toss| format!("apex {:.3} m above the hand's mean height", toss.apex_height_m)),
        ),
        Claim::printed("section3.amplitude_angle_of_fig5c", point.amplitude_angle_rad)
            .fitted("the number of equal intervals of φ_L, the smallest with which all three printed angles are points of the grid")
            .note(format!(
                "computed {:.4}π: point {} of {} equal intervals from 0 to arccos(g/cω²) = {:.4}π with ω = {:.3} rad/s of Eq. (14), see fig04",
                point.amplitude_angle_rad / PI,
                point.index,
                point.intervals,
                point.largest_amplitude_angle_rad / PI,
                point.angular_frequency_rad_per_s
            )),
    ]
}

/// Enough force and friction.
fn no_slip(data: &Fig05Data) -> Claim {
    let missing = |grip: &Grip, column: usize| grip.missing_share.get(column).map(|share| share.abs());
    let converges = claim::all(0..data.columns.len(), |column| {
        let missing: Vec<f64> = data.firm_grip.iter().filter_map(|grip| missing(grip, column)).collect();
        // At Table I's friction a dough that is behind the hand may cross its speed as the friction grows.
        falls(missing.get(1..).unwrap_or_default()) == Some(true)
            && missing.last().is_some_and(|last| *last < NEARLY_NOTHING)
    });
    let firmest = data.firm_grip.last();
    let most =
        firmest.map_or(f64::NAN, |grip| grip.missing_share.iter().fold(0.0, |most, own| own.abs().max(most)));
    Claim::printed_statement(
        "section3.no_slip_at_separation",
        converges,
        format!(
            "the share of the hand's speed at τ_sep that the dough lacks, θ = 0, vanishes as μ grows: at most {most:.1e} at μ = {}",
            firmest.map_or(f64::NAN, |grip| grip.friction),
        ),
    )
}

/// The effect of θ.
fn phase_lag(data: &Fig05Data) -> Vec<Claim> {
    let lags = &data.lags;
    let late = |wanted: fn(f64) -> bool| {
        lags.iter().filter(move |lag| wanted(lag.phase_lag_rad)).map(|lag| lag.late_gain_rad_per_s)
    };
    let at_zero = late(|lag| lag == FIRST_PHASE_LAG).next();
    let reduced = at_zero.and_then(|zero| claim::all(late(|lag| lag > 0.0), |gain| gain < zero));
    let at_rest =
        ROUNDING * data.columns.iter().map(|own| own.largest_hand_speed_rad_per_s).fold(0.0, f64::max);
    let reversed =
        claim::all(lags, |lag| (lag.phase_lag_rad < 0.0) == (lag.lowest_speed_rad_per_s < -at_rest));
    let places = format!(
        "φ_L = {}, θ = {}",
        data.printed.optimal_amplitude_angle_rad,
        lags.iter().map(|lag| pi(lag.phase_lag_rad)).collect::<Vec<_>>().join(", ")
    );
    vec![
        Claim::printed_statement(
            "section3.positive_lag_torque",
            reduced,
            format!("a positive lag gains less speed in the second half of the contact; {places}"),
        ),
        Claim::printed_statement(
            "section3.negative_lag_torque",
            reversed,
            format!(
                "judged by the torque; the phase of the fastest hand is −θ. The dough starts at rest and turns backwards where θ is negative alone; {places}"
            ),
        ),
    ]
}
