//! The contents of a data sheet.

use std::f64::consts::TAU;

use crate::parameters::contact::Contact;
use crate::parameters::driven_platform::{DriveParameters, Waveform};
use crate::parameters::load::LoadLaw;
use crate::parameters::stator::StatorParameters;
use crate::parameters::system::System;

/// The data sheet of a motor, not yet checked. Alternatives are optional, but exactly one of each pair must
/// be given: [`Self::peak_angular_speed`] or [`Self::twist_amplitude`], [`Self::mass`] or [`Self::density`],
/// [`Self::preload_force`] or [`Self::preload_acceleration`]. In a file `null` means the same as a missing
/// field.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct MotorParameters {
    /// Drive frequency omega/(2 pi) (Hz), positive. Not the angular frequency in rad/s.
    pub drive_frequency: f64,
    /// Axial amplitude A of the stator's height (m), not negative; for a compliant stator, the amplitude
    /// without a rotor. Required unless `force` or `volts` of [`Self::stator`] determine it.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub amplitude: Option<f64>,
    /// Largest angular speed omega Phi of the stator (rad/s), not negative.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub peak_angular_speed: Option<f64>,
    /// Twist amplitude Phi of the stator's angle (rad), not negative; an alternative to the speed.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub twist_amplitude: Option<f64>,
    /// Phase lag theta of the twist (rad), any finite number. Default 0.
    #[cfg_attr(feature = "serde", serde(default))]
    pub phase_lag: f64,
    /// Mass m of the rotor (kg), positive.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub mass: Option<f64>,
    /// Density of the rotor (kg/m^3), positive; an alternative to the mass, used with [`Self::rotor_radius`]
    /// and [`Self::rotor_thickness`] of a solid disc.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub density: Option<f64>,
    /// Outer radius R of the rotor (m), positive.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub rotor_radius: Option<f64>,
    /// Thickness of the rotor (m), positive; only with a density.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub rotor_thickness: Option<f64>,
    /// Effective contact radius a_e (m), positive: where the friction force acts.
    pub contact_radius: f64,
    /// Radius of gyration a_g (m), positive. Default: R/sqrt(2), the value of a solid disc, if a rotor radius
    /// is given.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub gyration_radius: Option<f64>,
    /// Preload F (N), positive: the total force that presses the rotor onto the stator. The rotor's weight is
    /// not added; include it if it contributes. The paper's g is F/m.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub preload_force: Option<f64>,
    /// Preload acceleration g = F/m (m/s^2), positive; an alternative to the force.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub preload_acceleration: Option<f64>,
    /// Constant k of the spring that provides the preload (N/m), positive. Required for the static deflection
    /// and the bound on the change of the preload; the motion does not depend on it.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub spring_constant: Option<f64>,
    /// Coefficient of friction mu, static and kinetic, not negative.
    pub friction: f64,
    /// Coefficient of restitution, in [0, 1).
    pub restitution: f64,
    /// Load torque T_L (N m), any finite number; a positive load decelerates a positive rotation. Default 0.
    #[cfg_attr(feature = "serde", serde(default))]
    pub load_torque: f64,
    /// Duration of an impact, or materials and geometry; the mass is the rotor's. Without this table a report
    /// cannot tell whether rigid impacts are valid.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub contact: Option<Contact>,
    /// A compliant stator; without this table the stator's motion is prescribed.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub stator: Option<StatorParameters>,
    /// A torque that depends on speed and time, and an inertia on the shaft; an alternative to
    /// [`Self::load_torque`].
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub load: Option<LoadLaw>,
    /// The motion of the stator, if it differs from the sines of Eq. (1). Its waveforms multiply the
    /// amplitudes, and there is no `start_phase`. This table excludes [`Self::stator`] and [`Self::load`].
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "DriveParameters::is_sine"))]
    pub drive: DriveParameters,
}

impl MotorParameters {
    /// A sheet without numbers. A required number that remains NaN is rejected before the sheet is used.
    pub(crate) const EMPTY: Self = Self {
        drive_frequency: f64::NAN,
        amplitude: None,
        peak_angular_speed: None,
        twist_amplitude: None,
        phase_lag: 0.0,
        mass: None,
        density: None,
        rotor_radius: None,
        rotor_thickness: None,
        contact_radius: f64::NAN,
        gyration_radius: None,
        preload_force: None,
        preload_acceleration: None,
        spring_constant: None,
        friction: f64::NAN,
        restitution: f64::NAN,
        load_torque: 0.0,
        contact: None,
        stator: None,
        load: None,
        drive: DriveParameters { height: Waveform::Sine, angle: Waveform::Sine, start_phase: None },
    };

    /// The data sheet of a system whose disk has this mass (kg): frequency, amplitudes and preload
    /// acceleration of the system, and the torque m a_g^2 d alpha/dt of its load. It is not yet checked. The
    /// frequency omega/(2 pi) is rounded, so the angular frequency of the motor may differ in the last bit.
    /// The system of a motor contains neither the drive nor the load of its sheet.
    ///
    /// ```
    /// use bouncing_disk::System;
    /// use bouncing_disk::motor::MotorParameters;
    ///
    /// let motor = MotorParameters::of_system(&System::motor(), 1e-3).build()?;
    /// assert!((motor.parameters().drive_frequency - 70e3).abs() < 1e-10);
    /// assert_eq!(motor.system().disk(), System::motor().disk());
    /// # Ok::<(), bouncing_disk::Error>(())
    /// ```
    #[must_use]
    pub fn of_system(system: &System, mass: f64) -> Self {
        let (platform, disk) = (system.platform(), system.disk());
        let gyration_radius = disk.gyration_radius();
        let stator = system.stator().map(|stator| stator.parameters());
        let [lifts, twists] = stator.unwrap_or_default().computes().map(|field| field.is_none());
        Self {
            drive_frequency: platform.angular_frequency() / TAU,
            amplitude: lifts.then_some(platform.amplitude()),
            twist_amplitude: twists.then_some(platform.twist_amplitude()),
            phase_lag: if twists { platform.phase_lag() } else { 0.0 },
            mass: Some(mass),
            contact_radius: disk.contact_radius(),
            gyration_radius: Some(gyration_radius),
            preload_acceleration: Some(disk.preload_acceleration()),
            friction: disk.friction(),
            restitution: disk.restitution(),
            load_torque: disk.load_acceleration() * (mass * gyration_radius * gyration_radius),
            contact: system.contact().map(|contact| Contact { mass: None, ..*contact }),
            stator,
            ..Self::EMPTY
        }
    }
}
