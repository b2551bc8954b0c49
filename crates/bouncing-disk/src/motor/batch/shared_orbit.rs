//! One vertical motion that carries many rotors.
//!
//! The rotary motion never acts back on the vertical one. Motors that differ only in load, friction, phase
//! lag, twist amplitude, radii or mass share every flight, impact and rest. The orbit is computed once; for
//! each rotor an impact adds only a clamp and a few products. The rotors also share the perturbations of the
//! relaunches (common random numbers). Hence the differences between their results are more precise than the
//! results themselves, whose errors are not independent. See docs/numerics-dynamics.md.

pub(crate) mod vertical;

use crate::error::Error;
use crate::parameters::contact::ContactLaw;
use crate::parameters::system::System;

/// Checks that these motors share one vertical motion ([`is_shared`]); returns the first, which represents
/// all.
///
/// # Errors
/// [`Error::NotShared`] with the quantity that differs; [`Error::OutOfRange`] for no motor.
pub(crate) fn shared_by(systems: &[System]) -> Result<&System, Error> {
    let Some(first) = systems.first() else {
        return Err(Error::OutOfRange { field: "number of rotors", value: 0.0, legal: "[1, 1000000]" });
    };
    for system in systems {
        system.prescribed()?;
        for (one, other) in of_vertical_motion(first).into_iter().zip(of_vertical_motion(system)) {
            let ((field, one), (_, other)) = (one, other);
            if one.to_bits() != other.to_bits() {
                return Err(Error::NotShared { field, one, other });
            }
        }
    }
    Ok(first)
}

/// Whether two motors share one vertical motion: the same peak acceleration P and restitution to the bit, the
/// same unit of time, and the same contact.
pub(crate) fn is_shared(one: &System, other: &System) -> bool {
    vertical_key(one) == vertical_key(other)
}

/// The numbers that all motors on one vertical motion must share.
pub(crate) fn vertical_key(system: &System) -> [u64; 6] {
    of_vertical_motion(system).map(|(_, value)| value.to_bits())
}

fn of_vertical_motion(system: &System) -> [(&'static str, f64); 6] {
    let (law, time) = system.soft_contact().unwrap_or_default();
    [
        ("peak acceleration P", system.peak_acceleration()),
        ("restitution", system.disk().restitution()),
        ("angular frequency (rad/s)", system.platform().angular_frequency()),
        ("preload acceleration (m/s^2)", system.disk().preload_acceleration()),
        ("contact.time (s)", time),
        ("contact.law", f64::from(u8::from(law == ContactLaw::Hysteresis))),
    ]
}
