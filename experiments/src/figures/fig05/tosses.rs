//! The tosses of the columns of Fig. 5, moment by moment.

use bouncing_disk::motion::{EventKind, Mode, PhaseSpan};
use bouncing_disk::toss::{InitialSpin, toss_trajectory};
use serde::Serialize;

use crate::experiment::ExperimentError;
use crate::figures::shared::toss::TossCase;

/// One amplitude ratio.
#[derive(Debug, Serialize)]
pub(super) struct Column {
    /// φ_L as printed.
    pub(super) printed: String,
    pub(super) amplitude_angle_rad: f64,
    /// ωΦ.
    pub(super) largest_hand_speed_rad_per_s: f64,
    /// One per phase lag of the caption.
    pub(super) tosses: Vec<Toss>,
}

impl Column {
    pub(super) fn new(
        text: &str,
        case: &TossCase,
        lags: [f64; 2],
        points: u32,
    ) -> Result<Self, ExperimentError> {
        let tosses = lags.into_iter().map(|lag| Toss::new(&case.at_lag(lag), points));
        Ok(Self {
            printed: text.to_owned(),
            amplitude_angle_rad: case.amplitude_angle_rad,
            largest_hand_speed_rad_per_s: case.system()?.platform().peak_angular_speed(),
            tosses: tosses.collect::<Result<_, _>>()?,
        })
    }
}

/// One toss, from the lowest point of the hand until the dough lands. Time runs from the start, heights from
/// the hand's mean height.
#[derive(Debug, Default, Serialize)]
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
    /// The highest point of the flight.
    pub(super) apex_height_m: f64,
    pub(super) airborne_speed_rad_per_s: f64,
    pub(super) hand_speed_at_separation_rad_per_s: f64,
    /// Hand minus dough at the separation.
    pub(super) slip_at_separation_rad_per_s: f64,
    pub(super) sliding_at_separation: bool,
    /// The dough's lowest speed in contact.
    pub(super) lowest_speed_rad_per_s: f64,
    /// The increase of the speed in the second half of the time in contact.
    pub(super) late_gain_rad_per_s: f64,
}

impl Toss {
    pub(super) fn new(case: &TossCase, points: u32) -> Result<Self, ExperimentError> {
        let system = case.system()?;
        let (scales, hand) = (system.scales(), system.platform());
        let trajectory = toss_trajectory(&system, InitialSpin::AbsoluteRest)?;
        let start = trajectory.start();
        let mut toss = Self {
            phase_lag_rad: case.phase_lag_rad,
            lowest_speed_rad_per_s: f64::INFINITY,
            ..Self::default()
        };
        for record in trajectory.records() {
            for step in 0..=points {
                let snapshot = record.evaluate(system.dimensionless(), f64::from(step) / f64::from(points));
                let (phase, state) = (snapshot.time.phase, scales.state(&snapshot.disk));
                toss.time_s.push(scales.span_seconds(snapshot.time.since(&start)));
                toss.hand_height_m.push(hand.height(phase));
                toss.hand_angle_rad.push(hand.angle(phase));
                toss.hand_speed_rad_per_s.push(hand.angular_speed(phase));
                toss.dough_height_m.push(state.height);
                toss.dough_angle_rad.push(state.angle);
                toss.dough_speed_rad_per_s.push(state.angular_speed);
                if record.before.mode != Mode::Flight {
                    toss.lowest_speed_rad_per_s = toss.lowest_speed_rad_per_s.min(state.angular_speed);
                }
            }
            if record.event.kind() == EventKind::Separation {
                let state = scales.state(&record.after);
                let rise =
                    state.axial_velocity * state.axial_velocity / (2.0 * case.preload_acceleration_m_per_s2);
                toss.separation_time_s = scales.span_seconds(record.time.since(&start));
                toss.airborne_speed_rad_per_s = state.angular_speed;
                toss.hand_speed_at_separation_rad_per_s = hand.angular_speed(record.time.phase);
                toss.slip_at_separation_rad_per_s =
                    toss.hand_speed_at_separation_rad_per_s - state.angular_speed;
                toss.sliding_at_separation = matches!(record.before.mode, Mode::Sliding(_));
                toss.apex_height_m = state.height + rise;
            }
        }
        let half = PhaseSpan::from_radians(0.5 * toss.separation_time_s * case.angular_frequency_rad_per_s);
        let middle =
            trajectory.at(start.after(half)).map(|snapshot| scales.state(&snapshot.disk).angular_speed);
        toss.late_gain_rad_per_s = toss.airborne_speed_rad_per_s - middle.unwrap_or_default();
        Ok(toss)
    }

    /// How far the dough is behind the hand at the separation, as a share of the hand's speed.
    pub(super) fn slip_share(&self) -> f64 {
        self.slip_at_separation_rad_per_s / self.hand_speed_at_separation_rad_per_s
    }
}
