//! Derived quantities of a system, its single toss, and the long-term motion of one orbit.

use std::f64::consts::{PI, TAU};

use bouncing_disk::System;
use bouncing_disk::core::ImpactMap;
use bouncing_disk::core::attractors::{UndecidedReason, Verdict, VerdictSettings};
use bouncing_disk::motor::MotorParameters;
use bouncing_disk::parameters::ContactStatement;
use bouncing_disk::toss::{InitialSpin, single_toss};
use serde_json::json;

use crate::reply::{Refusal, Reply};
use crate::request::{ImpactStart, SystemParameters, forcing_of};

/// The parameters, and derived quantities. The angular forcing is null without friction, the rise time (that
/// of a motor without load) where nothing turns; the peak acceleration is in units of the preload, and an
/// impact with the normalised speed 1 has the speed unit (m/s); the load torque is that on a disk of this
/// mass (kg). A platform that `bounces` leaves a disk at rest. The contact time over the period and the
/// indentation are null where no time is given.
pub(crate) fn summary(system: &System, mass: f64) -> Result<Reply, Refusal> {
    // The mass belongs to no system: it is legal where a load can be its torque.
    system.disk().parameters().with_load_torque(0.0, mass)?;
    let period = TAU / system.platform().angular_frequency();
    let parameters = SystemParameters::from(system);
    Reply::short(&json!({
        "axial_forcing": forcing_of(system),
        "angular_forcing": system.angular_forcing(),
        "period": period,
        "contact_periods": parameters.contact_time / period,
        "peak_acceleration": system.peak_acceleration(),
        "speed_unit": PI * system.scales().velocity,
        "twist_speed": system.platform().peak_angular_speed(),
        "friction_acceleration": system.disk().friction_acceleration(),
        "load_torque": MotorParameters::of_system(system, mass).load_torque,
        "stroke": system.stroke().stroke,
        "amplitude_angle": system.stroke().amplitude_angle,
        "rise_time": Some(system.rise_time()).filter(|time| time.is_finite() && *time > 0.0),
        "bounces": system.dimensionless().vibration().separation_phase().is_some(),
        "contact": system.contact_statement(None).map(|own| ContactStatement::rows(Some(&own))),
        "system": parameters,
    }))
}

/// The performance of the toss of Sec. III, of a disk that does not turn before; SI. A platform that never falls away
/// from the disk, and compliant contacts, are errors.
pub(crate) fn toss(system: &System) -> Result<Reply, Refusal> {
    Reply::short(&single_toss(system, InitialSpin::AbsoluteRest)?)
}

/// Impacts and platform periods of a round are null where nothing repeats; the two Floquet multipliers are
/// pairs of real and imaginary parts. The exponent is the growth per impact with its standard error; the
/// exponent of a periodic orbit follows from its multipliers and has none. `rounding_dependent`: the cycle
/// after a rest was chosen by rounding.
pub(crate) fn verdict(map: &ImpactMap, start: ImpactStart) -> Result<Reply, Refusal> {
    let verdict = map.verdict(start.state()?, VerdictSettings::default())?;
    let (mut round, mut multipliers, mut exponent, mut exponent_error) = (None, None, None, None);
    let mut rounding_dependent = false;
    let kind = match &verdict {
        Verdict::Periodic { impacts, platform_periods, multipliers: found, .. } => {
            round = Some((*impacts, *platform_periods));
            multipliers = Some(found.pairs());
            // JSON has no infinity, so the exponent of a superstable orbit is omitted.
            exponent = Some(found.lyapunov_exponent(*impacts)).filter(|exponent| exponent.is_finite());
            "periodic"
        }
        Verdict::Chaotic { exponent: found, standard_error, .. } => {
            (exponent, exponent_error) = (Some(*found), Some(*standard_error));
            "chaotic"
        }
        Verdict::Chattering { cycle, .. } => {
            round = Some((cycle.impacts, cycle.platform_periods));
            rounding_dependent = !cycle.is_exact();
            "chattering"
        }
        Verdict::AtRest { .. } => "at-rest",
        Verdict::Undecided {
            reason:
                UndecidedReason::ExponentNearZero { exponent: found, standard_error }
                | UndecidedReason::NoPeriodFound { exponent: found, standard_error }
                | UndecidedReason::TransientMayLast { exponent: found, standard_error, .. },
            ..
        } => {
            (exponent, exponent_error) = (Some(*found), Some(*standard_error));
            "undecided"
        }
        _ => "undecided",
    };
    Reply::short(&json!({
        "kind": kind,
        "impacts": round.map(|(impacts, _)| impacts),
        "platform_periods": round.map(|(_, periods)| periods),
        "multipliers": multipliers,
        "exponent": exponent,
        "exponent_error": exponent_error,
        "rounding_dependent": rounding_dependent,
        "text": verdict.to_string(),
    }))
}
