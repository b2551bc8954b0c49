//! The computation of Fig. 5.

use std::f64::consts::{FRAC_PI_4, FRAC_PI_8};

use bouncing_disk::core::Phase;
use bouncing_disk::{EventKind, InitialSpin, Mode, System, toss_trajectory};

use super::data::{Column, Dependence, Fig05Data, GridPoint, Grip, Toss};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::angle_grid::{AngleGrid, launch_case, printed_angles, unreadable};
use crate::figures::toss_case::TossCase;
use crate::claims::paper::{self, SectionThree, TableOne};
use crate::claims::printed::PrintedNumber;
use crate::progress::Progress;

/// θ_1 of the caption.
pub(super) const FIRST_PHASE_LAG: f64 = 0.0;

/// Phase lags about the optimum for the remarks on torque.
const PHASE_LAGS_NEAR_ZERO: [f64; 5] = [-FRAC_PI_4, -FRAC_PI_8, 0.0, FRAC_PI_8, FRAC_PI_4];

/// Multiples of Table I's friction for the limit of sufficient friction.
const FRICTION_FACTORS: [f64; 4] = [1.0, 10.0, 100.0, 1000.0];

pub(super) fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig05Data, ExperimentError> {
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
        .map(|lag| Toss::new(&optimum.at_lag(lag), points).map(|toss| Dependence::new(&toss)))
        .collect::<Result<Vec<_>, _>>()?;
    let firm_grip = FRICTION_FACTORS
        .into_iter()
        .map(|factor| Grip::new(&table, factor, &columns))
        .collect::<Result<Vec<_>, _>>()?;
    let grid_point = GridPoint::new(&table_i, &printed)?;
    progress.advance(1);
    Ok(Fig05Data {
        table_i,
        printed,
        initial_state: InitialSpin::AbsoluteRest,
        columns,
        lags,
        firm_grip,
        grid_point,
    })
}

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
        let system = case.system()?;
        let tosses = phase_lags.into_iter().map(|lag| Toss::new(&case.at_lag(lag), points));
        Ok(Self {
            printed: printed.to_owned(),
            amplitude_angle_rad: case.amplitude_angle_rad,
            amplitude_m: system.platform().amplitude(),
            largest_hand_speed_rad_per_s: system.platform().peak_angular_speed(),
            peak_acceleration: system.peak_acceleration(),
            tosses: tosses.collect::<Result<_, _>>()?,
        })
    }
}

impl Toss {
    fn new(case: &TossCase, points: u32) -> Result<Self, ExperimentError> {
        let system = case.system()?;
        let trajectory = toss_trajectory(&system, InitialSpin::AbsoluteRest)?;
        let scales = system.scales();
        let mut toss = Self::empty(case.phase_lag_rad);
        toss.largest_hand_speed_rad_per_s = system.platform().peak_angular_speed();
        let mut sliding_time = 0.0;
        let mut contact_speeds = Vec::new();
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
                    contact_speeds.push((time, state.angular_speed));
                }
            }
            let time = scales.span_seconds(record.time.since(&trajectory.start()));
            if matches!(record.before.mode, Mode::Sliding(_)) {
                sliding_time += scales.span_seconds(record.span);
            }
            match record.event.kind() {
                EventKind::Separation => {
                    let state = scales.state(&record.after);
                    toss.separation_time_s = time;
                    toss.separation_phase_rad = record.time.phase.angle();
                    toss.airborne_speed_rad_per_s = state.angular_speed;
                    toss.hand_speed_at_separation_rad_per_s =
                        system.platform().angular_speed(record.time.phase);
                    toss.slip_at_separation_rad_per_s =
                        toss.hand_speed_at_separation_rad_per_s - state.angular_speed;
                    toss.sliding_at_separation = matches!(record.before.mode, Mode::Sliding(_));
                    let rise = state.axial_velocity * state.axial_velocity
                        / (2.0 * case.preload_acceleration_m_per_s2);
                    toss.apex_height_m = state.height + rise;
                }
                EventKind::Impact => toss.landing_time_s = time,
                _ => {}
            }
        }
        toss.sliding_share_of_contact = sliding_time / toss.separation_time_s;
        toss.lowest_speed_rad_per_s =
            contact_speeds.iter().map(|(_, speed)| *speed).fold(f64::INFINITY, f64::min);
        let middle = trajectory.start().after(bouncing_disk::PhaseSpan::from_radians(
            0.5 * toss.separation_time_s * case.angular_frequency_rad_per_s,
        ));
        let speed_at_middle =
            trajectory.at(middle).map(|snapshot| scales.state(&snapshot.disk).angular_speed);
        toss.late_gain_rad_per_s = toss.airborne_speed_rad_per_s - speed_at_middle.unwrap_or_default();
        Ok(toss)
    }

    fn empty(phase_lag_rad: f64) -> Self {
        Self {
            phase_lag_rad,
            time_s: Vec::new(),
            hand_height_m: Vec::new(),
            dough_height_m: Vec::new(),
            hand_angle_rad: Vec::new(),
            dough_angle_rad: Vec::new(),
            hand_speed_rad_per_s: Vec::new(),
            dough_speed_rad_per_s: Vec::new(),
            separation_time_s: 0.0,
            separation_phase_rad: 0.0,
            landing_time_s: 0.0,
            apex_height_m: 0.0,
            airborne_speed_rad_per_s: 0.0,
            hand_speed_at_separation_rad_per_s: 0.0,
            largest_hand_speed_rad_per_s: 0.0,
            slip_at_separation_rad_per_s: 0.0,
            sliding_at_separation: false,
            sliding_share_of_contact: 0.0,
            lowest_speed_rad_per_s: 0.0,
            late_gain_rad_per_s: 0.0,
        }
    }

    fn push(&mut self, system: &System, phase: Phase, time: f64) {
        let hand = system.platform();
        self.time_s.push(time);
        self.hand_height_m.push(hand.height(phase));
        self.hand_angle_rad.push(hand.angle(phase));
        self.hand_speed_rad_per_s.push(hand.angular_speed(phase));
    }
}

impl Dependence {
    fn new(toss: &Toss) -> Self {
        Self {
            phase_lag_rad: toss.phase_lag_rad,
            airborne_speed_rad_per_s: toss.airborne_speed_rad_per_s,
            lowest_speed_rad_per_s: toss.lowest_speed_rad_per_s,
            late_gain_rad_per_s: toss.late_gain_rad_per_s,
        }
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
