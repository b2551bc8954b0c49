//! What follows from the parameters of a system.

use std::f64::consts::TAU;

use bouncing_disk::System;
use serde::Serialize;

use crate::refusal::Refusal;
use crate::reply::Reply;

#[derive(Debug, Serialize)]
struct Summary {
    axial_forcing: f64,
    angular_forcing: Option<f64>,
    period: f64,
    peak_acceleration: f64,
    stroke: f64,
    rise_time: Option<f64>,
    bounces: bool,
}

pub(crate) fn answer(system: &System) -> Result<Reply, Refusal> {
    let rise_time = system.rise_time();
    Reply::short(&Summary {
        axial_forcing: system.axial_forcing(),
        angular_forcing: system.angular_forcing(),
        period: TAU / system.platform().angular_frequency(),
        peak_acceleration: system.peak_acceleration(),
        stroke: system.stroke().stroke,
        rise_time: (rise_time.is_finite() && rise_time > 0.0).then_some(rise_time),
        bounces: system.dimensionless().vibration().separation_phase().is_some(),
    })
}
