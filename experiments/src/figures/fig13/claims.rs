//! What the paper says about Fig. 13.

use super::data::{Fig13Data, ID, Parameter};
use super::{orbits, sensitivity};
use crate::claim::Claim;
use crate::figures::motor_case::perturbation_claim;

pub(super) fn claims(data: &Fig13Data) -> Vec<Claim> {
    let mut claims = vec![
        sensitivity::cosine(data),
        sensitivity::amplitude(data),
        sensitivity::twist(data),
        sensitivity::friction(data),
        sensitivity::both(data),
        sensitivity::speed_limit(data),
        sensitivity::torque_limit(data),
        orbits::slower_collisions(data),
        orbits::intervals(data),
        orbits::restitution_lowers_both(data),
        orbits::simplistic(data),
        orbits::form(data),
    ];
    claims.extend(orbits::prevalent(data));
    claims.extend(orbits::commonness(data));
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
    for motor in &data.perturbations {
        claims.push(perturbation_claim(
            ID,
            &format!(
                "at ε = {} the steady speed does not depend on the size of the relaunch perturbation",
                motor.restitution
            ),
            &motor.effects,
        ));
    }
    claims
}
