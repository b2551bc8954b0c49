//! The systems of the paper's tables, and systems derived from another by changing a few parameters.

use std::f64::consts::{PI, TAU};

use bouncing_disk_core::Vibration;

use crate::error::{Error, moderate_not_negative};
use crate::parameters::disk::DiskParameters;
use crate::parameters::platform::{Platform, PlatformParameters};
use crate::parameters::stroke::Stroke;
use crate::parameters::system::System;

/// The hand of Table I.
const HAND: Stroke = Stroke {
    stroke: 0.25,
    amplitude_angle: 0.55,
    contact_radius: 0.135,
    angular_frequency: 15.0,
    phase_lag: 0.0,
};

/// The dough of Table I. The table states no restitution, as a single toss does not depend on it; 0.5 is the
/// value of Sec. IV.
const DOUGH: DiskParameters = DiskParameters {
    contact_radius: 0.135,
    gyration_radius: 0.11,
    friction: 0.6,
    restitution: 0.5,
    preload_acceleration: 9.8,
    load_acceleration: 0.0,
};

/// Drive frequency (Hz) of the paper's motor, the "70" that Table III prints as g.
pub(crate) const DRIVE_FREQUENCY: f64 = 70e3;

/// Amplitude of the stator's height (m) of Table III.
pub(crate) const STATOR_AMPLITUDE: f64 = 1e-8;

/// The largest angular speed of the stator (rad/s) of Table III.
pub(crate) const STATOR_SPEED: f64 = 30.0;

/// The rotor of Table III under its own weight.
pub(crate) const ROTOR: DiskParameters = DiskParameters {
    contact_radius: 1.25e-3,
    gyration_radius: 6.3e-3,
    friction: 0.1,
    restitution: 0.5,
    preload_acceleration: 9.8,
    load_acceleration: 0.0,
};

impl Stroke {
    /// The hand of Table I ([`System::pizza_toss`]), which can be changed and turned into a platform
    /// ([`Platform::from_stroke`]).
    #[must_use]
    pub const fn pizza_toss() -> Self {
        HAND
    }
}

impl System {
    /// The pizza toss of Table I: a linear hand motion (theta = 0) with a stroke of 0.25 m at 15 rad/s, and
    /// its dough.
    ///
    /// ```
    /// use bouncing_disk::System;
    /// use bouncing_disk::toss::{InitialSpin, single_toss};
    ///
    /// let toss = single_toss(&System::pizza_toss(), InitialSpin::AbsoluteRest)?;
    /// assert_eq!(toss.airborne_speed.round(), 14.0);
    /// # Ok::<(), bouncing_disk::Error>(())
    /// ```
    #[must_use]
    pub fn pizza_toss() -> Self {
        Platform::from_stroke(HAND)
            .and_then(|hand| Self::new(hand, DOUGH.build()?))
            .expect("the values of Table I are legal, which a test shows")
    }

    /// The motor of Table III, its "70" read as the drive frequency in kHz: a stator with A = 10 nm that
    /// turns at up to 30 rad/s in phase with its rise, and a rotor under its own weight.
    ///
    /// ```
    /// use bouncing_disk::System;
    ///
    /// // The same motor with ten times the amplitude and slightly less friction.
    /// let motor = System::motor()
    ///     .with_platform(|stator| stator.amplitude = 1e-7)?
    ///     .with_disk(|rotor| rotor.friction = 0.09)?;
    /// assert_eq!(motor.axial_forcing().round(), 628.0);
    /// # Ok::<(), bouncing_disk::Error>(())
    /// ```
    #[must_use]
    pub fn motor() -> Self {
        let angular_frequency = TAU * DRIVE_FREQUENCY;
        let stator = PlatformParameters {
            amplitude: STATOR_AMPLITUDE,
            twist_amplitude: STATOR_SPEED / angular_frequency,
            angular_frequency,
            phase_lag: 0.0,
        };
        stator
            .build()
            .and_then(|stator| Self::new(stator, ROTOR.build()?))
            .expect("the values of Table III are legal, which a test shows")
    }

    /// The same system with other parameters of the platform.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the parameter, its value and its legal range.
    pub fn with_platform(&self, change: impl FnOnce(&mut PlatformParameters)) -> Result<Self, Error> {
        let mut parameters = self.platform().parameters();
        change(&mut parameters);
        self.with_parts(parameters.build()?, *self.disk())
    }

    /// The same system with other parameters of the disk.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the parameter, its value and its legal range.
    pub fn with_disk(&self, change: impl FnOnce(&mut DiskParameters)) -> Result<Self, Error> {
        let mut parameters = self.disk().parameters();
        change(&mut parameters);
        self.with_parts(*self.platform(), parameters.build()?)
    }

    /// The same system with the amplitude that corresponds to this axial forcing parameter Gamma = A
    /// omega^2/(pi g).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] names the parameter, its value and its legal range.
    pub fn with_axial_forcing(&self, axial_forcing: f64) -> Result<Self, Error> {
        let peak_acceleration = Vibration::from_axial_forcing(axial_forcing)?.peak_acceleration();
        let (preload, omega) = (self.disk().preload_acceleration(), self.platform().angular_frequency());
        self.with_platform(|platform| platform.amplitude = peak_acceleration * preload / (omega * omega))
    }

    /// The same system with the twist amplitude that corresponds to this angular forcing parameter Gamma_T =
    /// a_g^2 Phi omega^2/(a_e pi g mu); without friction there is none.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] names the parameter, its value and its legal range.
    pub fn with_angular_forcing(&self, angular_forcing: f64) -> Result<Self, Error> {
        moderate_not_negative("angular_forcing", angular_forcing)?;
        let (disk, omega) = (self.disk(), self.platform().angular_frequency());
        let friction = disk.contact_radius() * PI * disk.preload_acceleration() * disk.friction();
        let inertia = disk.gyration_radius() * omega;
        let unit = friction / (inertia * inertia);
        self.with_platform(|platform| platform.twist_amplitude = angular_forcing * unit)
    }

    /// The same system with the amplitudes that correspond to this stroke (m) and amplitude angle (rad) at the
    /// disk's contact radius (Eq. 13).
    ///
    /// # Errors
    /// The errors of [`Platform::from_stroke`] and of [`Self::new`].
    pub fn with_stroke(&self, stroke: f64, amplitude_angle: f64) -> Result<Self, Error> {
        let platform = Platform::from_stroke(Stroke { stroke, amplitude_angle, ..self.stroke() })?;
        self.with_parts(platform, *self.disk())
    }

    /// The same system with a load `torque` (N m) on a disk of `mass` (kg).
    ///
    /// # Errors
    /// The errors of [`DiskParameters::with_load_torque`] and [`Self::new`].
    pub fn with_load_torque(&self, torque: f64, mass: f64) -> Result<Self, Error> {
        self.with_parts(*self.platform(), self.disk().parameters().with_load_torque(torque, mass)?.build()?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_presets_are_legal_and_those_of_the_tables() {
        let toss = System::pizza_toss();
        // Table I: Gamma from the table's numbers, with A = c cos(phi_L).
        let expected =
            0.25 * bouncing_disk_core::numerics::elementary::cos(0.55) * 225.0 / (std::f64::consts::PI * 9.8);
        assert!((toss.axial_forcing() - expected).abs() < 1e-14, "{}", toss.axial_forcing());
        let motor = System::motor();
        assert!((motor.platform().peak_angular_speed() - 30.0).abs() < 1e-13);
        assert!((motor.axial_forcing() - 62.83).abs() < 0.01, "{}", motor.axial_forcing());
    }

    #[test]
    fn a_system_has_the_forcings_and_the_stroke_that_it_is_given() {
        let toss = System::pizza_toss();
        let forced = toss.with_axial_forcing(0.45).and_then(|one| one.with_angular_forcing(1.3));
        let forced = forced.expect("legal");
        assert!((forced.axial_forcing() - 0.45).abs() < 1e-15);
        assert!((forced.angular_forcing().expect("friction") - 1.3).abs() < 1e-15);
        let stroke = forced.with_stroke(0.25, 0.55).expect("legal");
        assert_eq!((stroke.platform(), stroke.disk()), (toss.platform(), toss.disk()));
        for (name, wrong) in [
            ("axial_forcing", toss.with_axial_forcing(4e7)),
            ("angular_forcing", toss.with_angular_forcing(-1.0)),
            ("amplitude_angle", toss.with_stroke(0.25, 2.0)),
        ] {
            assert!(wrong.expect_err("illegal").to_string().contains(name), "{name}");
        }
    }

    #[test]
    fn one_parameter_is_changed_and_checked() {
        let motor = System::motor();
        let rougher = motor.with_disk(|rotor| rotor.friction = 0.2).expect("legal");
        assert_eq!(rougher.disk().friction().to_bits(), 0.2_f64.to_bits());
        assert_eq!(rougher.platform(), motor.platform());
        let error = motor.with_disk(|rotor| rotor.restitution = 1.0).expect_err("illegal");
        assert!(error.to_string().contains("restitution"), "{error}");
        let error = motor.with_platform(|stator| stator.amplitude = f64::NAN).expect_err("illegal");
        assert!(error.to_string().contains("amplitude"), "{error}");
    }
}
