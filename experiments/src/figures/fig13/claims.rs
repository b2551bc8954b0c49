//! What the paper says about Fig. 13.

use super::data::{Fig13Data, Parameter};
use super::{orbits, sensitivity};
use crate::claims::Claim;

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
    claims.push(orbits::prevalent(data));
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
    claims
}
