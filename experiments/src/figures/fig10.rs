//! Fig. 10(a)-(c): transient speed curves of the motor and their fits, for both readings of Table III.

mod alike;
mod panels;
mod picture;

use std::f64::consts::{PI, TAU};

use bouncing_disk::PlatformParameters;
use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::motor::TransientSettings;
use serde::Serialize;

use self::alike::Alike;
use self::panels::{MEMBER_INTERVALS, Reading, Transient};
use super::shared::alike::{AlikeMotor, DRAWN, PrintedInputs};
use super::shared::motor::{INTERVALS, MotorCase, MotorStatistics, statistics};
use crate::claims::paper::{self, STANDARD_GRAVITY};
use crate::claims::{Cases, Claim, all, catalogue};
use crate::experiment::{ExperimentError, Paper};

/// Relaunch perturbations (units of g/omega) for which the steady speed is compared: from none at all.
const PERTURBATIONS: [f64; 8] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-7, 1e-9, 0.0];
/// Duration of the transients compared, in rise times.
const COMPARED_RISES: [f64; 2] = [6.0, 12.0];
/// Duration of the transients drawn with gravity and with the printed g (s).
const DURATIONS_S: [f64; 2] = [6.0, 0.9];
/// Seed of the inputs that print alike.
const SEED: u64 = 10;

/// Steady speed and stall acceleration for one size of the relaunch perturbation.
#[derive(Serialize)]
struct PerturbationEffect {
    /// In units of g/ω.
    relaunch_perturbation: f64,
    statistics: MotorStatistics,
}

/// Fig. 10.
pub(crate) fn fig10(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    let section = paper::section_five()?;
    let case = MotorCase::table_three()?;
    let amplitudes = section.amplitudes_of_fig10_m;
    let members = fig.quality.choose(4, 16);
    let defaults = TransientSettings::default();
    fig.chattering(ChatterPolicy::Complete);
    fig.seed("motors that print alike", SEED);
    fig.seed("ensembles", defaults.seed);
    fig.record("motor", &case)?;
    fig.record("members", &members)?;
    fig.record("relaunch_perturbation", &defaults.relaunch_perturbation)?;
    fig.progress.start((2 * amplitudes.len() + 3) as u64, "parts");

    let mut readings = Vec::new();
    let gravities = [STANDARD_GRAVITY, paper::table_three()?.preload_acceleration_m_per_s2];
    for (preload_acceleration_m_per_s2, duration_s) in gravities.into_iter().zip(DURATIONS_S) {
        let mut panels = Vec::new();
        for amplitude_m in amplitudes {
            let motor = MotorCase { amplitude_m, preload_acceleration_m_per_s2, ..case };
            panels.push(panels::transient(&motor, duration_s, members)?);
            fig.progress.advance(1);
        }
        readings.push(Reading { preload_acceleration_m_per_s2, duration_s, panels });
    }
    fig.record("readings", &readings)?;
    // The motor of the smallest amplitude at exactly the printed g.
    let exception = panels::exception(&MotorCase { amplitude_m: amplitudes[0], ..case }, DURATIONS_S[0])?;
    fig.record("exception", &exception)?;
    fig.progress.advance(1);
    let count = fig.quality.choose(DRAWN / 10, DRAWN);
    let alike = Alike::drawn(PrintedInputs::table_three()?, count, SEED)?;
    fig.record("alike", &alike)?;
    fig.progress.advance(1);
    let rises = fig.quality.choose(COMPARED_RISES[0], COMPARED_RISES[1]);
    let ensembles = PERTURBATIONS.map(|perturbation| (case, members, perturbation));
    let effects = PERTURBATIONS.into_iter().zip(statistics(&ensembles, rises)?);
    let effect =
        |(relaunch_perturbation, statistics)| PerturbationEffect { relaunch_perturbation, statistics };
    fig.record("perturbations", &effects.map(effect).collect::<Vec<_>>())?;
    fig.progress.advance(1);

    let own =
        axial_forcing(section.own_motor_amplitude_m, section.default_frequency_hz, section.gravity_m_per_s2)?;
    fig.record("own_motor_axial_forcing", &own)?;
    fig.claim(
        Claim::printed("section1.own_motor_axial_forcing", own)
            .note("ω read as 2π · 70 kHz, which this number confirms"),
    );
    let tsujino = axial_forcing(
        section.tsujino_amplitude_m,
        section.tsujino_frequency_hz,
        section.tsujino_preload_acceleration_m_per_s2,
    )?;
    fig.record("tsujino_axial_forcing", &tsujino)?;
    fig.record("tsujino_peak_acceleration", &(PI * tsujino))?;
    fig.claim(
        Claim::printed("section1.tsujino_axial_forcing", tsujino)
            .note(format!(
                "A ω²/g, without the factor 1/π, is {:.1}: the printed 70 if that has one digit",
                PI * tsujino
            ))
            .cause("a factor π missing from Γ"),
    );
    let merging = catalogue::number("section4.merging", 0)?.value;
    let motors = || alike.motors.iter().flatten().map(|motor| motor.axial_forcing);
    fig.claim(Claim::printed_statement(
        "section4.motor_regime",
        Cases::of(motors().map(|forcing| forcing > merging)),
        format!(
            "the lowest Γ is {:.2}, of all motors whose inputs print alike at the three A",
            motors().fold(f64::INFINITY, f64::min)
        ),
    ));
    transients(fig, &readings[0].panels, &alike);

    fig.parameters(case.shared_inputs());
    fig.parameter("a_e", format!("{} m", case.contact_radius_m));
    fig.parameter("a_g", format!("{} m", case.gyration_radius_m));
    fig.parameter("ω/2π", format!("{} Hz", case.frequency_hz));
    fig.parameter("members", members);
    fig.parameter("relaunch perturbation", format!("{} g/ω", defaults.relaunch_perturbation));
    fig.parameter("inputs that print alike", &alike.inputs);
    fig.parameters([MotorCase::contact_row(amplitudes.map(|amplitude_m| MotorCase { amplitude_m, ..case }))]);
    fig.caption(format!(
        "Transients of the motor of Table III from rest, fitted with α̇_ss(1 − e^(−t/t_c)). (a)–(c) Standard gravity, the 70 of \
         Table III read as ω/2π in kHz; (a′)–(c′) g = {} m/s² as printed. Gray line: one of {members} members, means over \
         1/{MEMBER_INTERVALS} of the time; its fit dashed; blue: mean ± standard deviation of the members. Gray band: 5 to 95 % of \
         {count} unperturbed orbits whose inputs print alike. Dotted: exactly g = {} m/s², where a low-period cycle exists in a \
         range of {:.1e} m/s² only.",
        gravities[1],
        exception.preload_acceleration_m_per_s2,
        exception.highest_preload_acceleration_m_per_s2 - exception.lowest_preload_acceleration_m_per_s2,
    ));
    fig.draw(picture::draw(&readings, &exception, &alike));
    Ok(())
}

/// Gamma of an amplitude (m), frequency (Hz) and preload acceleration (m/s^2).
fn axial_forcing(amplitude: f64, frequency_hz: f64, preload: f64) -> Result<f64, ExperimentError> {
    let angular_frequency = TAU * frequency_hz;
    let stator = PlatformParameters { amplitude, twist_amplitude: 0.0, angular_frequency, phase_lag: 0.0 };
    Ok(stator.build()?.axial_forcing(preload))
}

/// The statements about the transients at the three amplitudes: of ensembles, and of single orbits that nothing perturbs.
fn transients(fig: &mut Paper<'_>, ensembles: &[Transient], alike: &Alike) {
    let listed = |of: fn(&Transient) -> f64, scale: f64| {
        ensembles.iter().map(|panel| format!("{:.3}", scale * of(panel))).collect::<Vec<_>>().join(", ")
    };
    let mean_rises =
        |of: fn(&Transient) -> f64| all(ensembles.windows(2), |pair| of(&pair[0]) < of(&pair[1]));
    let rises = |of: fn(&AlikeMotor) -> f64| {
        Cases::of(alike.draws().map(|draw| draw.windows(2).all(|pair| of(pair[0]) < of(pair[1]))))
    };
    fig.claim(
        Claim::printed_statement(
            "section5.exponential_transients",
            all(ensembles, |panel| panel.relative_exponential_residual < panel.relative_ramp_residual),
            format!(
                "mean residuals of the exponential {} %, of a linear rise to a constant {} % of the steady speed",
                listed(|panel| panel.relative_exponential_residual, 1e2),
                listed(|panel| panel.relative_ramp_residual, 1e2),
            ),
        )
        .single_orbits(Cases::of(alike.draws().map(|draw| draw.into_iter().all(AlikeMotor::is_exponential)))),
    );
    fig.claim(
        Claim::printed_statement(
            "section5.oscillation_grows",
            mean_rises(|panel| panel.oscillation),
            format!(
                "in the second half the speed, in means over 1/{INTERVALS} of the time, is {} % of ωΦ off its line",
                listed(|panel| panel.oscillation, 1e2),
            ),
        )
        .single_orbits(rises(|motor| motor.oscillation)),
    );
    fig.claim(alike::long_period_oscillates(alike));
    fig.claim(
        Claim::printed_statement(
            "section5.frequent_collisions",
            mean_rises(|panel| -panel.impacts_per_s),
            format!(
                "{} impacts a millisecond, without summed chatters",
                listed(|panel| panel.impacts_per_s, 1e-3)
            ),
        )
        .single_orbits(rises(|motor| -motor.impacts_per_s)),
    );
    fig.claim(alike::long_period(alike));
    fig.claim(alike::transient_chaos(alike));
}
