//! Fig. 13: sensitivity of the motor to the five estimated parameters.

mod compute;
mod data;
mod draw;
mod orbits;
mod sensitivity;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::motor::TransientSettings;

pub(crate) use self::data::Fig13Data;
use self::data::Parameter;
use crate::claims::Claim;
use crate::experiment::{ExperimentError, Paper};
use crate::figures::shared::motor::MotorCase;

/// Fig. 13.
pub(crate) fn fig13(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    fig.seed("motors that print alike", compute::SEED);
    fig.seed("ensembles", TransientSettings::default().seed);
    let data = &compute::compute(fig.quality, fig.progress)?;
    fig.caption(caption(data));
    fig.parameters(parameters(data));
    fig.claims(claims(data));
    fig.draw(draw::draw(data));
    fig.data(data)
}

fn caption(data: &Fig13Data) -> String {
    let left_out: usize = data::sweep_points(data).filter(|point| point.stall().is_none()).count();
    let low: usize = data::sweep_points(data).filter(|point| point.statistics.is_low_period()).count();
    format!(
        "Effect of varying (a) μ, (b) ε, (c) θ, (d) A and (e) ωΦ about the default values (μ = {}, ε = {}, θ = {}, A = {:e} m, \
         ωΦ = {} rad/s, g = {} m/s², {} kHz). Crosses, left scales: steady-state speed over ωΦ; dots, right scales: stall torque \
         as an acceleration. Mean and standard deviation of {} members over {} rise times, relaunch perturbation below {} \
         g/ω. Pale: {low} motors on a low-period cycle. {left_out} motors have no meaningful fit and no dot. Rings: means above the limit that friction sets. \
         Bands: 5 to 95 % of single orbits that nothing perturbs and whose inputs print alike, speed gray and stall torque blue ({} motors at each of some values, joined). Dotted: \
         what the phases of the normal impulse predict; dash-dotted: the limit μ a_e g/a_g² of the stall torque; grey vertical lines: the default values. (f) Distribution of the normal impulse over the cycle of the stator. \
         The paper's ranges are not in its text; these are ours.",
        data.motor.friction,
        data.motor.restitution,
        data.motor.phase_lag_rad,
        data.motor.amplitude_m,
        data.motor.peak_angular_speed_rad_per_s,
        data.motor.preload_acceleration_m_per_s2,
        data.motor.frequency_hz / 1e3,
        data.members,
        data.rises,
        data.relaunch_perturbation,
        data.alike.drawn,
    )
}

fn parameters(data: &Fig13Data) -> Vec<(String, String)> {
    let mut rows = Vec::new();
    for sweep in &data.sweeps {
        if let (Some(first), Some(last)) = (sweep.points.first(), sweep.points.last()) {
            let value = format!(
                "{:.3e} to {:.3e} {}, {} values",
                first.value,
                last.value,
                sweep.parameter.unit(),
                sweep.points.len()
            );
            rows.push((sweep.parameter.symbol().to_owned(), value));
        }
    }
    rows.push(("members".to_owned(), data.members.to_string()));
    rows.push(("duration".to_owned(), format!("{} ωΦ a_g²/(μ a_e g)", data.rises)));
    rows.push((
        "relaunch perturbation".to_owned(),
        format!("{} and {} g/ω", data.relaunch_perturbation, data.breaking_perturbation),
    ));
    rows.push(("inputs that print alike, but for ε".to_owned(), data.alike.inputs.clone()));
    rows.push(MotorCase::contact_row([data.motor]));
    rows
}

fn claims(data: &Fig13Data) -> Vec<Claim> {
    let mut claims = vec![
        sensitivity::cosine(data),
        sensitivity::amplitude(data),
        sensitivity::twist(data),
        sensitivity::friction(data),
        sensitivity::both(data),
        sensitivity::torque_limit(data),
        sensitivity::only_reduce(data),
        orbits::slower_collisions(data),
        orbits::intervals(data),
        orbits::restitution_lowers_both(data),
        orbits::simplistic(data),
        orbits::form(data),
    ];
    claims.push(orbits::prevalent(data));
    claims.extend(orbits::commonness(data));
    claims.push(orbits::reduced_restitution(data));
    claims.extend(orbits::phases_of_impulse(data));
    claims.push(sensitivity::most_sensitive(
        data,
        "section5.speed_sensitivity",
        sensitivity::speed_change,
        [Parameter::PhaseLag, Parameter::Restitution, Parameter::PeakAngularSpeed],
    ));
    claims.push(sensitivity::most_sensitive(
        data,
        "section5.torque_sensitivity",
        sensitivity::stall_change,
        [Parameter::PhaseLag, Parameter::Restitution, Parameter::Friction],
    ));
    claims
}
