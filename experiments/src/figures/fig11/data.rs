//! The numbers of Fig. 11.

use std::f64::consts::TAU;

use bouncing_disk::TransientSettings;
use bouncing_disk::core::ChatterPolicy;
use serde::{Deserialize, Serialize};

use super::measured::Measured;
use crate::experiment::{ExperimentError, Quality};
use crate::figures::motor_case::{Cycle, MotorCase, MotorStatistics, PerturbationEffect, perturbation_table};
use crate::paper::{self, Preloads};
use crate::progress::Progress;

/// Duration of a transient in rise times ωΦ a_g²/(μ a_e g): seven time constants or more.
const RISES: f64 = 6.0;

/// Relaunch perturbations (g/ω) for which the results are compared.
const PERTURBATIONS: [f64; 5] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5];

/// Peak accelerations Aω²/g on both sides of the end of bouncing.
const PEAKS_ABOUT_ONE: [f64; 4] = [0.5, 0.999, 1.001, 1.5];

/// The data of Fig. 11.
#[derive(Debug, Serialize, Deserialize)]
pub struct Fig11Data {
    pub(super) motor: MotorCase,
    pub(super) printed: Preloads,
    /// Mass of the rotor, a solid steel ball.
    pub(super) rotor_mass_kg: f64,
    pub(super) members: usize,
    pub(super) rises: f64,
    pub(super) relaunch_perturbation: f64,
    /// By frequency, then amplitude.
    pub(super) curves: Vec<Curve>,
    /// The default amplitude at the middle of the preloads, by frequency.
    pub(super) perturbations: Vec<Vec<PerturbationEffect>>,
    /// What the rotor does at forcings about 1/π, at full preload.
    pub(super) end_of_bouncing: Vec<Gentle>,
    /// A user's own measurements.
    #[serde(default, skip_serializing_if = "Measured::is_empty")]
    pub(super) measured: Measured,
}

/// One amplitude at one frequency.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Curve {
    pub(super) frequency_hz: f64,
    pub(super) amplitude_m: f64,
    pub(super) points: Vec<Point>,
}

/// One preload.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Point {
    pub(super) preload_acceleration_m_per_s2: f64,
    pub(super) preload_mn: f64,
    pub(super) axial_forcing: f64,
    pub(super) statistics: MotorStatistics,
}

/// An amplitude so small that the rotor hardly bounces, or not at all.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Gentle {
    pub(super) axial_forcing: f64,
    pub(super) cycle: Cycle,
}

impl Fig11Data {
    /// The range of preloads (mN) of the measured trends.
    pub(super) fn trend_mn(&self) -> [f64; 2] {
        self.printed.measured_range_n.map(|preload| 1e3 * preload)
    }

    /// m a_g² (kg m²), which makes a torque of an angular acceleration.
    pub(super) fn moment_of_inertia(&self) -> f64 {
        self.rotor_mass_kg * self.motor.gyration_radius_m * self.motor.gyration_radius_m
    }
}

pub(super) fn run(quality: Quality, progress: &dyn Progress) -> Result<Fig11Data, ExperimentError> {
    let printed = paper::preloads()?;
    let section = paper::section_five()?;
    let motor = MotorCase::default_of(&paper::table_three()?, &section);
    let rotor_mass_kg = section.rotor_mass_kg();
    let members = quality.choose(4, 16);
    let relaunch_perturbation = TransientSettings::default().relaunch_perturbation;
    let preloads = preloads(&printed, quality.choose(9, 34));
    let frequencies = printed.frequencies_hz;
    let amplitudes = section.amplitudes_of_fig10_m;
    progress.start((frequencies.len() * (amplitudes.len() * preloads.len() + 1)) as u64, "ensembles");

    let mut curves = Vec::new();
    let mut perturbations = Vec::new();
    for frequency_hz in frequencies {
        for amplitude_m in amplitudes {
            let mut points = Vec::new();
            for &preload in &preloads {
                let case =
                    MotorCase { frequency_hz, amplitude_m, preload_acceleration_m_per_s2: preload, ..motor };
                points.push(Point {
                    preload_acceleration_m_per_s2: preload,
                    preload_mn: 1e3 * rotor_mass_kg * preload,
                    axial_forcing: case.system()?.axial_forcing(),
                    statistics: case.statistics(RISES, members, relaunch_perturbation)?,
                });
                progress.advance(1);
            }
            curves.push(Curve { frequency_hz, amplitude_m, points });
        }
        let [low, high] = printed.measured_range_n;
        let middle = MotorCase {
            frequency_hz,
            preload_acceleration_m_per_s2: 0.5 * (low + high) / rotor_mass_kg,
            ..motor
        };
        perturbations.push(perturbation_table(&middle, &PERTURBATIONS, 2.0 * RISES, 2 * members)?);
        progress.advance(1);
    }
    let mut end_of_bouncing = Vec::new();
    let angular_frequency = TAU * motor.frequency_hz;
    for peak in PEAKS_ABOUT_ONE {
        let amplitude_m =
            peak * motor.preload_acceleration_m_per_s2 / (angular_frequency * angular_frequency);
        let case = MotorCase { amplitude_m, ..motor };
        end_of_bouncing.push(Gentle {
            axial_forcing: case.system()?.axial_forcing(),
            cycle: case.cycle(ChatterPolicy::Complete)?,
        });
    }
    Ok(Fig11Data {
        motor,
        printed,
        rotor_mass_kg,
        members,
        rises: RISES,
        relaunch_perturbation,
        curves,
        perturbations,
        end_of_bouncing,
        measured: Measured::default(),
    })
}

/// Equally spaced preload accelerations over the printed range.
fn preloads(printed: &Preloads, count: u32) -> Vec<f64> {
    let [first, last] = printed.preload_accelerations_m_per_s2;
    (0..count).map(|index| first + (last - first) * f64::from(index) / f64::from(count - 1)).collect()
}
