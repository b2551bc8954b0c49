//! Converts between the amplitudes of a platform and the stroke's length and direction, Eq. (13), which may
//! come from launch speeds, Eq. (14).

use std::f64::consts::FRAC_PI_2;

use bouncing_disk_core::numerics::elementary::{atan2, hypot, sin_cos};

use crate::error::{Error, check, not_negative, positive};
use crate::parameters::platform::{Platform, PlatformParameters};
use crate::parameters::system::System;

/// A platform motion given by the length and the direction of its stroke; see [`Platform::from_stroke`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Stroke {
    /// Stroke c (m), not negative: the half length of the helical path of a point at the contact radius.
    pub stroke: f64,
    /// Amplitude angle phi_L (rad) in [0, pi/2]: 0 is a purely vertical motion, pi/2 a purely rotary one.
    pub amplitude_angle: f64,
    /// Effective contact radius a_e (m), positive, at which the stroke is measured. It should equal the disk's
    /// ([`DiskParameters::contact_radius`](crate::DiskParameters::contact_radius)), which is not checked.
    pub contact_radius: f64,
    /// Angular frequency omega (rad/s), positive.
    pub angular_frequency: f64,
    /// Phase lag theta of the twist (rad), any finite number.
    pub phase_lag: f64,
}

/// The input of Eq. (14), taken from a video: the speeds at which the disk rises and turns as it leaves.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LaunchSpeeds {
    /// Axial speed at separation (m/s), positive.
    pub axial_speed: f64,
    /// Angular speed at separation (rad/s), not negative.
    pub angular_speed: f64,
    /// Stroke c (m), positive.
    pub stroke: f64,
    /// Effective contact radius a_e (m), positive.
    pub contact_radius: f64,
}

impl Stroke {
    /// The linear motion (phase lag 0) whose largest speeds are the launch speeds, if the disk does not slip
    /// (Eq. 14): omega^2 = (v/c)^2 + (a_e w/c)^2 and phi_L = arctan(a_e w/v) for axial and angular speeds v
    /// and w.
    ///
    /// The disk leaves after the platform's speed has passed its maximum, and both components are smaller than
    /// their maxima by the factor cos tau_sep. Eq. (14) neglects this, which makes omega too small but does not
    /// affect phi_L.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the field, its value and its legal range.
    pub fn from_launch_speeds(launch: LaunchSpeeds) -> Result<Self, Error> {
        positive("axial_speed", launch.axial_speed)?;
        not_negative("angular_speed", launch.angular_speed)?;
        positive("stroke", launch.stroke)?;
        positive("contact_radius", launch.contact_radius)?;
        let rim_speed = launch.contact_radius * launch.angular_speed;
        let speed = (launch.axial_speed * launch.axial_speed + rim_speed * rim_speed).sqrt();
        Ok(Self {
            stroke: launch.stroke,
            amplitude_angle: atan2(rim_speed, launch.axial_speed),
            contact_radius: launch.contact_radius,
            angular_frequency: positive("angular_frequency", speed / launch.stroke)?,
            phase_lag: 0.0,
        })
    }
}

impl Platform {
    /// The motion with a given stroke and amplitude angle, (a_e Phi, A) = c (sin phi_L, cos phi_L) (Eq. 13).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the field, its value and its legal range.
    pub fn from_stroke(stroke: Stroke) -> Result<Self, Error> {
        not_negative("stroke", stroke.stroke)?;
        positive("contact_radius", stroke.contact_radius)?;
        let angle = stroke.amplitude_angle;
        check((0.0..=FRAC_PI_2).contains(&angle), "amplitude_angle", angle, "[0, pi/2] (rad)")?;
        let (sine, cosine) = sin_cos(stroke.amplitude_angle);
        PlatformParameters {
            amplitude: stroke.stroke * cosine,
            twist_amplitude: stroke.stroke * sine / stroke.contact_radius,
            angular_frequency: stroke.angular_frequency,
            phase_lag: stroke.phase_lag,
        }
        .build()
    }
}

impl System {
    /// Length and direction of the stroke, measured at the disk's contact radius: c = (A^2 + (a_e
    /// Phi)^2)^(1/2) and phi_L = arctan(a_e Phi/A) (Eq. 13), 0 if nothing moves. [`Platform::from_stroke`] is
    /// the inverse.
    #[must_use]
    pub fn stroke(&self) -> Stroke {
        let (platform, contact_radius) = (self.platform(), self.disk().contact_radius());
        let twist = contact_radius * platform.twist_amplitude();
        Stroke {
            stroke: hypot(platform.amplitude(), twist),
            amplitude_angle: atan2(twist, platform.amplitude()),
            contact_radius,
            angular_frequency: platform.angular_frequency(),
            phase_lag: platform.phase_lag(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A 3-4-5 triangle of rim speed, axial speed and c omega.
    const LAUNCH: LaunchSpeeds =
        LaunchSpeeds { axial_speed: 4.0, angular_speed: 30.0, stroke: 0.5, contact_radius: 0.1 };

    #[test]
    fn eq_14_gives_back_the_largest_speeds_of_the_platform() {
        let stroke = Stroke::from_launch_speeds(LAUNCH).expect("legal");
        assert!((stroke.angular_frequency - 10.0).abs() < 1e-14, "{stroke:?}");
        let platform = Platform::from_stroke(stroke).expect("legal");
        assert!((platform.amplitude() * platform.angular_frequency() - LAUNCH.axial_speed).abs() < 1e-14);
        assert!((platform.peak_angular_speed() - LAUNCH.angular_speed).abs() < 1e-13);
    }

    #[test]
    fn a_system_gives_back_the_stroke_that_it_was_made_from() {
        let pizza = System::pizza_toss();
        for (amplitude_angle, phase_lag) in [(0.0, 0.0), (1e-9, -3.0), (0.55, 0.3), (FRAC_PI_2, 7.0)] {
            let stroke = Stroke { amplitude_angle, phase_lag, ..Stroke::pizza_toss() };
            let platform = Platform::from_stroke(stroke).expect("legal");
            let found = System::new(platform, *pizza.disk()).expect("legal").stroke();
            assert!((found.stroke / stroke.stroke - 1.0).abs() < 1e-15, "{found:?}");
            assert!((found.amplitude_angle - amplitude_angle).abs() < 1e-15, "{found:?}");
            assert_eq!(Stroke { stroke: stroke.stroke, amplitude_angle, ..found }, stroke);
        }
        let still =
            PlatformParameters { amplitude: 0.0, twist_amplitude: 0.0, ..pizza.platform().parameters() };
        let still = System::new(still.build().expect("legal"), *pizza.disk()).expect("legal").stroke();
        assert_eq!((still.stroke, still.amplitude_angle), (0.0, 0.0));
    }

    #[test]
    fn eq_14_refuses_speeds_that_launch_nothing() {
        for (launch, name) in [
            (LaunchSpeeds { axial_speed: 0.0, ..LAUNCH }, "axial_speed"),
            (LaunchSpeeds { angular_speed: -1.0, ..LAUNCH }, "angular_speed"),
            (LaunchSpeeds { stroke: 0.0, ..LAUNCH }, "stroke"),
            (LaunchSpeeds { contact_radius: f64::NAN, ..LAUNCH }, "contact_radius"),
            (LaunchSpeeds { axial_speed: 1e300, ..LAUNCH }, "angular_frequency"),
        ] {
            crate::testing::refused(name, [launch], Stroke::from_launch_speeds);
        }
    }
}
