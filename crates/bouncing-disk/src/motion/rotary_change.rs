//! The rotary half of Eq. (2), integrated in closed form over a flight or a segment of contact, and the energy
//! balance of both; sliding contact, Eq. (12). The vertical half is in the core (`flight/gap.rs`).

use bouncing_disk_core::Phase;

use crate::motion::arc::{Arc, Term};
use crate::motion::energy::EnergyLedger;
use crate::motion::friction::Friction;
use crate::motion::phase_time::PhaseSpan;
use crate::motion::state::{DiskState, Mode, PlatformState, SlipDirection};
use crate::parameters::dimensionless::DimensionlessSystem;

/// Change of the rotary state over a segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RotaryChange {
    /// Angular speed at the end.
    pub(crate) speed: f64,
    /// Change of the angle.
    pub(crate) angle: f64,
}

/// Sliding contact (Eq. 12): d(angular speed)/d tau = -s mu N - l with N = 1 - P sin tau, integrated.
pub(crate) fn change_while_sliding(
    system: &DimensionlessSystem,
    direction: SlipDirection,
    speed: f64,
    arc: &Arc,
) -> RotaryChange {
    let t = arc.duration;
    let grip = direction.sign() * system.friction();
    let load = system.load();
    RotaryChange {
        speed: speed - (grip * arc.force().value + load * t),
        angle: t * (speed - 0.5 * load * t) - grip * arc.force_twice().value,
    }
}

/// The rotary motion of a flight: only the load acts.
#[inline(always)]
pub(crate) fn change_in_flight(load: f64, speed: f64, duration: f64) -> RotaryChange {
    // The two expressions are independent; sharing the product would cost a motor 3 % of its time.
    RotaryChange { speed: speed - load * duration, angle: duration * (speed - 0.5 * load * duration) }
}

/// The rotary motion of a segment of contact that starts with angular `speed`.
pub(crate) fn change_in_contact(
    system: &DimensionlessSystem,
    mode: Mode,
    speed: f64,
    (from, to): (Phase, Phase),
    span: PhaseSpan,
) -> RotaryChange {
    let arc = Arc::new(system.peak_acceleration(), from, span);
    match mode {
        Mode::Sliding(direction) => change_while_sliding(system, direction, speed, &arc),
        Mode::Sticking | Mode::Flight => {
            let (cosine, sine) = system.twist_components();
            RotaryChange {
                speed: system.platform_angular_speed(to),
                angle: cosine * arc.sine_change + sine * arc.cosine_change,
            }
        }
    }
}

/// The load's part of the energy balance of a flight, or of the flights of a chatter.
pub(crate) fn record_flight_load(ledger: &mut EnergyLedger, load: f64, speed: f64, change: &RotaryChange) {
    let work = load * change.angle;
    ledger.record_rotary_change(speed, change.speed);
    ledger.record_load(work, work.abs());
}

/// Energy balance of a segment of contact from `state` at `from` to `to`, during which the disk has turned by
/// `turn`.
pub(crate) fn contact_ledger(
    system: &DimensionlessSystem,
    friction: &Friction,
    state: &DiskState,
    (from, to): (Phase, Phase),
    span: PhaseSpan,
    change: &RotaryChange,
) -> EnergyLedger {
    let mut ledger = EnergyLedger::default();
    let arc = Arc::new(system.peak_acceleration(), from, span);
    let peak = system.peak_acceleration();
    let (start, end) = (PlatformState::at(system, from), PlatformState::at(system, to));
    ledger.record_axial_change([start.axial_velocity, end.axial_velocity], [start.height, end.height]);
    // Integral of N P cos tau.
    ledger.record_normal(peak * arc.sine_change - peak * peak * arc.sine_cosine, 0.0);

    let load = system.load();
    ledger.record_rotary_change(state.angular_speed, change.speed);
    let (cosine, sine) = system.twist_components();
    match state.mode {
        Mode::Sliding(direction) => {
            let mu = system.friction();
            // If friction nearly holds the load, the angle is a small difference of the angles that each
            // would cause alone.
            let t = arc.duration;
            let angle_size =
                t * (state.angular_speed.abs() + 0.5 * load.abs() * t) + mu * arc.force_twice().size;
            ledger.record_load(load * change.angle, load.abs() * angle_size);
            // Work of the platform: integral of -s mu N Q cos(tau + theta).
            let force = arc.force();
            let (force_cosine, force_sine) = (arc.force_cosine(), arc.force_sine());
            let platform: Term =
                [force.times(start.angular_speed), force_cosine.times(cosine), force_sine.times(-sine)]
                    .into_iter()
                    .sum();
            let work = -direction.sign() * mu * platform.value;
            // Loss: integral of mu N U.
            let (decay, own_cosine, own_sine) = friction.slip_law(direction);
            let slip = direction.sign() * (state.angular_speed - start.angular_speed);
            let slipped: Term = [
                force.times(slip),
                arc.force_moment().times(-decay),
                force_cosine.times(-own_cosine),
                force_sine.times(own_sine),
            ]
            .into_iter()
            .sum();
            ledger.record_friction(work, mu * slipped.value, mu * (platform.size + slipped.size));
        }
        Mode::Sticking | Mode::Flight => {
            ledger.record_load(load * change.angle, (load * change.angle).abs());
            // The friction torque is l + d(platform angular speed)/d tau: integrated times the platform's
            // speed.
            let angle_change = cosine * arc.sine_change + sine * arc.cosine_change;
            let (before, after) = (start.angular_speed, end.angular_speed);
            let work = load * angle_change + 0.5 * (after - before) * (after + before);
            ledger.record_friction(work, 0.0, 0.5 * (before * before + after * after));
        }
    }
    ledger
}
