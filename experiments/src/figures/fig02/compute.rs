//! The computation of Fig. 2.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use bouncing_disk::{Platform, Stroke};

use super::data::{Fig02Data, Trajectory};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::hand_path::HandPath;
use crate::claims::paper;
use crate::progress::Progress;

/// The shape of a path does not depend on its size: the contact radius is 1 m here, the stroke this many of it.
const CONTACT_RADIUS: f64 = 1.0;
const STROKE: f64 = 1.5;

/// Any frequency gives the same path.
const ANGULAR_FREQUENCY: f64 = 1.0;

/// θ of (a)–(c) and φ_L of (d)–(f): for (a) Sec. IV A names θ, for (c) Sec. III B; the others are not in the text.
const PHASE_LAGS: [f64; 3] = [-FRAC_PI_2, -FRAC_PI_4, 0.0];
const AMPLITUDE_ANGLES: [f64; 3] = [0.05 * PI, 0.25 * PI, 0.45 * PI];

impl Trajectory {
    fn new(phase_lag: f64, amplitude_angle: f64, intervals: u32) -> Result<Self, ExperimentError> {
        let stroke = Stroke {
            stroke: STROKE,
            amplitude_angle,
            contact_radius: CONTACT_RADIUS,
            angular_frequency: ANGULAR_FREQUENCY,
            phase_lag,
        };
        let platform = Platform::from_stroke(stroke)?;
        let path = HandPath::new(&platform, intervals)?;
        Ok(Self { phase_lag_rad: phase_lag, amplitude_angle_rad: amplitude_angle, path })
    }
}

pub(super) fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig02Data, ExperimentError> {
    let intervals = quality.choose(120, 720);
    let printed_angle = paper::value("section1.amplitude_angle_of_fig2_abc")?;
    let printed_lag = paper::value("section1.phase_lag_of_fig2_def")?;
    let lags = PHASE_LAGS.map(|lag| (lag, printed_angle));
    let ratios = AMPLITUDE_ANGLES.map(|angle| (printed_lag, angle));
    progress.start((lags.len() + ratios.len()) as u64, "trajectories");
    let mut panels = Vec::new();
    for (lag, angle) in lags.into_iter().chain(ratios) {
        panels.push(Trajectory::new(lag, angle, intervals)?);
        progress.advance(1);
    }
    Ok(Fig02Data { stroke_over_contact_radius: STROKE / CONTACT_RADIUS, panels })
}
