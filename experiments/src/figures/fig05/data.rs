//! The data of Fig. 5.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, FRAC_PI_8};

use bouncing_disk::core::Phase;
use bouncing_disk::{EventKind, InitialSpin, Mode, System, toss_trajectory};
use serde::{Deserialize, Serialize};

use crate::experiment::ExperimentError;
use crate::figures::angle_grid::{AngleGrid, launch_case, printed_angles, unreadable};
use crate::figures::motor_case::core_error;
use crate::figures::toss_case::{TossCase, maximum};
use crate::paper::{SectionThree, TableOne};

/// θ_1 of the caption.
pub(super) const FIRST_PHASE_LAG: f64 = 0.0;

/// Phase lags about the optimum for the remarks on torque.
pub(super) const PHASE_LAGS_NEAR_ZERO: [f64; 5] = [-FRAC_PI_4, -FRAC_PI_8, 0.0, FRAC_PI_8, FRAC_PI_4];

/// Multiples of Table I's friction for the limit of sufficient friction.
pub(super) const FRICTION_FACTORS: [f64; 4] = [1.0, 10.0, 100.0, 1000.0];

/// The data of Fig. 5.
#[derive(Debug, Serialize, Deserialize)]
pub struct Fig05Data {
    pub(super) table_i: TableOne,
    pub(super) printed: SectionThree,
    pub(super) initial_state: InitialSpin,
    pub(super) columns: Vec<Column>,
    /// The toss at the printed optimal φ_L with phase lags about 0.
    pub(super) lags: Vec<Dependence>,
    pub(super) firm_grip: Vec<Grip>,
    pub(super) grid_point: GridPoint,
    pub(super) effects: Effects,
}

/// The φ_L of panel (c) as a point of the even grid on which the three printed angles lie.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct GridPoint {
    /// ω of Eq. (14), not rounded.
    pub(super) angular_frequency_rad_per_s: f64,
    pub(super) largest_amplitude_angle_rad: f64,
    pub(super) intervals: u32,
    pub(super) index: u32,
    pub(super) amplitude_angle_rad: f64,
}

impl GridPoint {
    pub(super) fn new(table: &TableOne, section: &SectionThree) -> Result<Self, ExperimentError> {
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

/// What φ_L and θ act on.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Effects {
    /// Over the amplitude angle, θ = 0.
    pub(super) of_angle: Vec<Influence>,
    /// Over the phase lag, at the printed optimal φ_L.
    pub(super) of_lag: Vec<Influence>,
}

/// The three things of Sec. III B that the amplitude ratio affects, and what the phase lag sets.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Influence {
    pub(super) amplitude_angle_rad: f64,
    pub(super) phase_lag_rad: f64,
    pub(super) separation_phase_rad: f64,
    /// ωΦ.
    pub(super) largest_hand_speed_rad_per_s: f64,
    /// N at the lowest point, in m g.
    pub(super) largest_force: f64,
    /// Where within a quarter of a period of τ = 0 the hand turns fastest.
    pub(super) fastest_hand_phase_rad: f64,
}

impl Influence {
    pub(super) fn new(case: &TossCase) -> Result<Self, ExperimentError> {
        /// Samples of the phase among which the fastest one is bracketed.
        const BRACKETS: u32 = 33;
        let system = case.system()?;
        let platform = system.platform();
        let fastest = maximum((-FRAC_PI_2, FRAC_PI_2), BRACKETS, |phase| {
            Ok::<_, ExperimentError>(platform.angular_speed(Phase::new(phase).map_err(core_error)?).abs())
        })?;
        Ok(Self {
            amplitude_angle_rad: case.amplitude_angle_rad,
            phase_lag_rad: case.phase_lag_rad,
            separation_phase_rad: case.toss(InitialSpin::AbsoluteRest)?.separation_phase,
            largest_hand_speed_rad_per_s: platform.peak_angular_speed(),
            largest_force: 1.0 + system.peak_acceleration(),
            fastest_hand_phase_rad: fastest.place,
        })
    }
}

impl Effects {
    pub(super) fn new(table: &TossCase, optimum: &TossCase) -> Result<Self, ExperimentError> {
        /// Amplitude angles from the first to the largest.
        const ANGLES: u32 = 20;
        let angles = (1..=ANGLES).map(|index| table.last_angle() * f64::from(index) / f64::from(ANGLES));
        Ok(Self {
            of_angle: angles.map(|angle| Influence::new(&table.at_angle(angle))).collect::<Result<_, _>>()?,
            of_lag: PHASE_LAGS_NEAR_ZERO
                .into_iter()
                .map(|lag| Influence::new(&optimum.at_lag(lag)))
                .collect::<Result<_, _>>()?,
        })
    }
}

/// One amplitude ratio.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Column {
    /// φ_L as printed.
    pub(super) printed: String,
    pub(super) amplitude_angle_rad: f64,
    pub(super) amplitude_m: f64,
    /// ωΦ.
    pub(super) largest_hand_speed_rad_per_s: f64,
    /// A ω²/g: the contact force lies between 1 + this, at the lowest point, and 0, at the separation (in m
    /// g).
    pub(super) peak_acceleration: f64,
    /// One per phase lag of the caption.
    pub(super) tosses: Vec<Toss>,
}

impl Column {
    pub(super) fn new(
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

/// One toss, from the lowest point of the hand until the dough lands. Time runs from the start, heights from
/// the hand's mean height.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Toss {
    pub(super) phase_lag_rad: f64,
    pub(super) time_s: Vec<f64>,
    pub(super) hand_height_m: Vec<f64>,
    pub(super) dough_height_m: Vec<f64>,
    pub(super) hand_angle_rad: Vec<f64>,
    pub(super) dough_angle_rad: Vec<f64>,
    pub(super) hand_speed_rad_per_s: Vec<f64>,
    pub(super) dough_speed_rad_per_s: Vec<f64>,
    pub(super) separation_time_s: f64,
    pub(super) separation_phase_rad: f64,
    pub(super) landing_time_s: f64,
    /// The highest point of the flight.
    pub(super) apex_height_m: f64,
    pub(super) airborne_speed_rad_per_s: f64,
    pub(super) hand_speed_at_separation_rad_per_s: f64,
    pub(super) largest_hand_speed_rad_per_s: f64,
    /// Hand minus dough at the separation.
    pub(super) slip_at_separation_rad_per_s: f64,
    pub(super) sliding_at_separation: bool,
    /// Share of the time in contact during which the dough slides.
    pub(super) sliding_share_of_contact: f64,
    /// The dough's lowest speed in contact.
    pub(super) lowest_speed_rad_per_s: f64,
    /// What the speed gains in the second half of the time in contact.
    pub(super) late_gain_rad_per_s: f64,
}

impl Toss {
    pub(super) fn new(case: &TossCase, points: u32) -> Result<Self, ExperimentError> {
        let system = case.system()?;
        let trajectory =
            toss_trajectory(&system, InitialSpin::AbsoluteRest).map_err(ExperimentError::model)?;
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

/// What a phase lag does to the toss.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Dependence {
    pub(super) phase_lag_rad: f64,
    pub(super) airborne_speed_rad_per_s: f64,
    pub(super) lowest_speed_rad_per_s: f64,
    pub(super) late_gain_rad_per_s: f64,
}

impl Dependence {
    pub(super) fn new(toss: &Toss) -> Self {
        Self {
            phase_lag_rad: toss.phase_lag_rad,
            airborne_speed_rad_per_s: toss.airborne_speed_rad_per_s,
            lowest_speed_rad_per_s: toss.lowest_speed_rad_per_s,
            late_gain_rad_per_s: toss.late_gain_rad_per_s,
        }
    }
}

/// The tosses of the three columns at θ_1 with more friction.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Grip {
    pub(super) friction: f64,
    /// 1 minus airborne speed over hand speed at the separation, by column.
    pub(super) missing_share: Vec<f64>,
}

impl Grip {
    pub(super) fn new(table: &TossCase, factor: f64, columns: &[Column]) -> Result<Self, ExperimentError> {
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
