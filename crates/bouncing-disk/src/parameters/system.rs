//! A disk on a platform, in SI units.

use crate::display::numbers;
use bouncing_disk_core::read_checked;
use bouncing_disk_drives::compliance::Compliance;
use std::fmt::{self, Display, Formatter};

use crate::error::Error;
use crate::parameters::contact::{Contact, ContactLaw};
use crate::parameters::dimensionless::{DimensionlessParameters, DimensionlessSystem};
use crate::parameters::disk::Disk;
use crate::parameters::driven_platform::{DriveParameters, DrivenPlatform};
use crate::parameters::platform::Platform;
use crate::parameters::scales::Scales;
use crate::parameters::stator::{StatorModes, StatorParameters};

/// A disk on a platform.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedSystem"))]
pub struct System {
    platform: Platform,
    disk: Disk,
    #[cfg_attr(feature = "serde", serde(skip))]
    dimensionless: DimensionlessSystem,
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    contact: Option<Contact>,
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    stator: Option<StatorParameters>,
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) beyond: Beyond,
}

/// Features of a motor's data sheet that its system does not contain.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) enum Beyond {
    #[default]
    Nothing,
    /// The motion of a table `[drive]`.
    Drive,
    /// The law of a table `[load]`.
    Load,
}

impl System {
    /// The system of this platform and this disk.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if a dimensionless parameter of the combination is outside its range, for
    /// example a peak acceleration above 1e8 g, or if a unit of [`Self::scales`] is too small or too large
    /// for a double.
    pub fn new(platform: Platform, disk: Disk) -> Result<Self, Error> {
        let preload = disk.preload_acceleration();
        // a_g^2/(a_e g) converts angular accelerations to multiples of friction's unit.
        let inertia = disk.gyration_radius() * disk.gyration_radius() / (disk.contact_radius() * preload);
        let dimensionless = DimensionlessParameters {
            peak_acceleration: platform.peak_acceleration() / preload,
            twist_speed: inertia * platform.peak_angular_speed() * platform.angular_frequency(),
            phase_lag: platform.phase_lag(),
            friction: disk.friction(),
            restitution: disk.restitution(),
            load: inertia * disk.load_acceleration(),
        }
        .build()?;
        Scales::new(&platform, &disk).check()?;
        Ok(Self { platform, disk, dimensionless, contact: None, stator: None, beyond: Beyond::Nothing })
    }

    /// The system of a file whose platform must be the one of Eq. (1).
    #[cfg_attr(not(feature = "serde"), allow(dead_code, reason = "only a file may have a drive"))]
    fn of_file(
        platform: Platform,
        disk: Disk,
        drive: DriveParameters,
        contact: Option<Contact>,
        stator: Option<StatorParameters>,
    ) -> Result<Self, Error> {
        drive.sine()?;
        Self::new(platform, disk)?.with_contact(contact)?.with_stator(stator)
    }

    /// The same system with another platform and disk.
    pub(crate) fn with_parts(&self, platform: Platform, disk: Disk) -> Result<Self, Error> {
        let system = Self::new(platform, disk)?.with_contact(self.contact)?.with_stator(self.stator)?;
        Ok(Self { beyond: self.beyond, ..system })
    }

    /// The same system with rigid impacts on a prescribed platform, under a constant load.
    pub(crate) const fn bare(&self) -> Self {
        Self { contact: None, stator: None, beyond: Beyond::Nothing, ..*self }
    }

    /// The platform.
    #[must_use]
    pub const fn platform(&self) -> &Platform {
        &self.platform
    }

    /// The disk.
    #[must_use]
    pub const fn disk(&self) -> &Disk {
        &self.disk
    }

    /// The same system in dimensionless form.
    #[must_use]
    pub const fn dimensionless(&self) -> &DimensionlessSystem {
        &self.dimensionless
    }

    /// The units of [`Self::dimensionless`].
    #[must_use]
    pub fn scales(&self) -> Scales {
        Scales::new(&self.platform, &self.disk)
    }

    /// The table `[contact]`, with the mass of the disk if it has materials.
    #[must_use]
    pub const fn contact(&self) -> Option<&Contact> {
        self.contact.as_ref()
    }

    /// The law and the duration (s) of compliant contacts. `None` if impacts are rigid, because no time is
    /// given or the time is below 1e-6 rad of the vibration.
    #[must_use]
    pub fn soft_contact(&self) -> Option<(ContactLaw, f64)> {
        let contact = self.contact.as_ref()?;
        let time = contact.time?;
        let holds = time * self.platform.angular_frequency() >= Compliance::CONTACT_TIMES[0];
        holds.then_some((contact.law.unwrap_or_default(), time))
    }

    /// The compliant stator, if the rotor changes the platform's motion.
    #[must_use]
    pub fn stator(&self) -> Option<StatorModes> {
        // It could be built when the table was checked, so it can be built again.
        self.stator.and_then(|stator| stator.of_platform(&self.platform).ok())
    }

    /// The same system, if its platform moves sinusoidally, unaffected by the disk, and the load is constant.
    ///
    /// # Errors
    /// [`Error::YieldingStator`], [`Error::LoadLaw`], [`Error::DriveNotSine`].
    pub(crate) const fn prescribed(&self) -> Result<&Self, Error> {
        match (self.stator, self.beyond) {
            (Some(_), _) => Err(Error::YieldingStator),
            (None, Beyond::Load) => Err(Error::LoadLaw),
            (None, Beyond::Drive) => Err(Error::DriveNotSine),
            (None, Beyond::Nothing) => Ok(self),
        }
    }

    /// The platform with the contacts of this system and the motion of a file's table `[drive]`.
    ///
    /// # Errors
    /// The errors of [`DrivenPlatform::new`]; [`Error::YieldingStator`].
    pub fn driven_platform(&self, drive: &DriveParameters) -> Result<DrivenPlatform, Error> {
        let platform = *self.prescribed()?.platform();
        let platform = DrivenPlatform::new(platform, drive.height.clone(), drive.angle.clone())?;
        Ok(platform.with_contact(self.soft_contact()))
    }

    /// The same system with another table `[contact]`.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a number that is not positive; [`Error::NeitherGiven`], [`Error::NotGiven`]
    /// and [`Error::BothGiven`] for missing or conflicting entries. With a time, also the errors of
    /// [`Compliance::new`].
    pub fn with_contact(&self, contact: Option<Contact>) -> Result<Self, Error> {
        if let Some(contact) = contact {
            contact.check()?;
            if contact.time.is_none() && contact.mass.is_none() {
                return Err(Error::NotGiven { field: "contact.mass" });
            }
        }
        let system = Self { contact, ..*self };
        if let Some((_, time)) = system.soft_contact() {
            Compliance::new(time * self.platform.angular_frequency(), self.disk.restitution())?;
        }
        Ok(system)
    }

    /// The same system with another table `[stator]`, whose steady motion without a rotor is the platform's.
    ///
    /// # Errors
    /// [`Error::OutOfRange`], [`Error::NotGiven`], [`Error::NeitherGiven`] and [`Error::BothGiven`] for
    /// invalid entries; the last one also if force, volts, torque or the twist per height imply a motion
    /// other than the platform's.
    pub fn with_stator(&self, stator: Option<StatorParameters>) -> Result<Self, Error> {
        stator.map(|stator| stator.of_platform(&self.platform)).transpose()?;
        Ok(Self { stator, ..*self })
    }

    /// P = A omega^2/g, the platform's peak acceleration in units of the preload acceleration.
    #[must_use]
    pub const fn peak_acceleration(&self) -> f64 {
        self.dimensionless.peak_acceleration()
    }

    /// omega Phi a_g^2/(mu a_e g) (s): the time in which a disk with [`Disk::friction_acceleration`] reaches
    /// the platform's largest angular speed; infinite without friction, zero without twist, NaN without either.
    #[must_use]
    pub fn rise_time(&self) -> f64 {
        self.platform.peak_angular_speed() / self.disk.friction_acceleration()
    }

    /// Axial forcing parameter Gamma = A omega^2/(pi g) (Sec. I).
    #[must_use]
    pub fn axial_forcing(&self) -> f64 {
        self.dimensionless.axial_forcing()
    }

    /// Angular forcing parameter Gamma_T = a_g^2 Phi omega^2/(a_e pi g mu) (Sec. IV); `None` without
    /// friction.
    #[must_use]
    pub fn angular_forcing(&self) -> Option<f64> {
        self.dimensionless.angular_forcing()
    }
}

impl TryFrom<System> for DimensionlessSystem {
    type Error = Error;

    /// As for a reference.
    fn try_from(system: System) -> Result<Self, Error> {
        Self::try_from(&system)
    }
}

impl TryFrom<&System> for DimensionlessSystem {
    type Error = Error;

    /// The system, if its impacts are rigid and its platform moves sinusoidally.
    ///
    /// # Errors
    /// [`Error::SoftContact`], [`Error::YieldingStator`]; for the system of a [`Motor`](crate::Motor) also
    /// [`Error::LoadLaw`] and [`Error::DriveNotSine`].
    fn try_from(system: &System) -> Result<Self, Error> {
        system.prescribed()?;
        system.soft_contact().map_or(Ok(system.dimensionless), |_| Err(Error::SoftContact))
    }
}

read_checked!(System as UncheckedSystem {
    platform: Platform,
    disk: Disk,
    #[serde(default)]
    drive: DriveParameters,
    #[serde(default)]
    contact: Option<Contact>,
    #[serde(default)]
    stator: Option<StatorParameters>,
} => System::of_file);

impl Display for System {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        f.write_str("platform ")?;
        self.platform().fmt(f)?;
        f.write_str("; disk ")?;
        self.disk().fmt(f)?;
        write!(f, "; Gamma = {}", n(self.axial_forcing()))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use bouncing_disk_core::Phase;

    use super::*;
    use crate::parameters::disk::DiskParameters;
    use crate::parameters::platform::PlatformParameters;
    use crate::parameters::stroke::Stroke;
    use crate::testing::refused;

    const PLATFORM: PlatformParameters =
        PlatformParameters { amplitude: 0.2, twist_amplitude: 1.1, angular_frequency: 15.0, phase_lag: 0.4 };

    const DISK: DiskParameters = DiskParameters {
        contact_radius: 0.135,
        gyration_radius: 0.11,
        friction: 0.6,
        restitution: 0.5,
        preload_acceleration: 9.8,
        load_acceleration: 3.0,
    };

    fn system() -> System {
        System::new(PLATFORM.build().unwrap(), DISK.build().unwrap()).unwrap()
    }

    /// The dimensionless platform, scaled back, equals the SI one.
    #[test]
    fn scales_carry_the_motion_back_to_si() {
        let (system, scales) = (system(), system().scales());
        for angle in [0.0, 1.0, 4.0] {
            let phase = Phase::new(angle).unwrap();
            let state = crate::motion::PlatformState::at(system.dimensionless(), phase);
            let pairs = [
                (state.height * scales.length, system.platform().height(phase)),
                (state.axial_velocity * scales.velocity, system.platform().velocity(phase)),
                (state.angle * scales.angle, system.platform().angle(phase)),
                (state.angular_speed * scales.angular_speed, system.platform().angular_speed(phase)),
            ];
            for (one, other) in pairs {
                assert!((one - other).abs() <= 1e-14 * other.abs().max(1.0), "{one} {other}");
            }
        }
        // Energy per unit mass: v^2/2 and (a_g speed)^2/2.
        assert!((scales.axial_energy - scales.velocity * scales.velocity).abs() < 1e-15);
        let rim = scales.angular_speed * 0.11;
        assert!((scales.rotary_energy / (rim * rim) - 1.0).abs() < 1e-14);
        assert!((system.dimensionless().load() * scales.angular_acceleration - 3.0).abs() < 1e-14);
        let friction = 0.6 * 9.8 * 0.135 / (0.11 * 0.11);
        assert!((scales.angular_acceleration * 0.6 - friction).abs() < 1e-13);
        let second = crate::motion::PhaseTime { periods: 3, phase: Phase::new(1.0).unwrap() };
        assert!((scales.time_seconds(second) - (3.0 * std::f64::consts::TAU + 1.0) / 15.0).abs() < 1e-15);
    }

    #[test]
    fn the_forcing_parameters_are_those_of_the_paper() {
        let system = system();
        let pi = std::f64::consts::PI;
        assert!((system.axial_forcing() - 0.2 * 225.0 / (pi * 9.8)).abs() < 1e-14);
        let angular = 0.11 * 0.11 * 1.1 * 225.0 / (0.135 * pi * 9.8 * 0.6);
        assert!((system.angular_forcing().unwrap() - angular).abs() < 1e-14);
        let slippery = DiskParameters { friction: 0.0, ..DISK }.build().unwrap();
        assert_eq!(System::new(*system.platform(), slippery).unwrap().angular_forcing(), None);
    }

    #[test]
    fn a_stroke_is_shared_between_lift_and_twist() {
        let stroke = Stroke {
            stroke: 0.25,
            amplitude_angle: 0.55,
            contact_radius: 0.135,
            angular_frequency: 15.0,
            phase_lag: 0.0,
        };
        let platform = Platform::from_stroke(stroke).unwrap();
        let rim = 0.135 * platform.twist_amplitude();
        assert!((platform.amplitude() * platform.amplitude() + rim * rim - 0.0625).abs() < 1e-15);
        assert!(
            (rim / platform.amplitude() - bouncing_disk_core::numerics::elementary::tan(0.55)).abs() < 1e-15
        );
        assert!(Platform::from_stroke(Stroke { amplitude_angle: FRAC_PI_2, ..stroke }).is_ok());
        let error = Platform::from_stroke(Stroke { amplitude_angle: 1.6, ..stroke }).unwrap_err();
        assert!(error.to_string().contains("amplitude_angle = 1.6"), "{error}");
    }

    #[test]
    fn illegal_parameters_are_refused_by_name() {
        let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0];
        let and = |more: f64| bad.into_iter().chain([more]);
        let platform = |change: fn(&mut PlatformParameters, f64)| {
            move |value| {
                let mut platform = PLATFORM;
                change(&mut platform, value);
                platform.build()
            }
        };
        refused("amplitude", bad, platform(|own, value| own.amplitude = value));
        refused("twist_amplitude", bad, platform(|own, value| own.twist_amplitude = value));
        refused("angular_frequency", and(0.0), platform(|own, value| own.angular_frequency = value));
        refused("phase_lag", [f64::NAN], platform(|own, value| own.phase_lag = value));
        let disk = |change: fn(&mut DiskParameters, f64)| {
            move |value| {
                let mut disk = DISK;
                change(&mut disk, value);
                disk.build()
            }
        };
        refused("contact_radius", and(0.0), disk(|own, value| own.contact_radius = value));
        refused("gyration_radius", and(0.0), disk(|own, value| own.gyration_radius = value));
        refused("friction", bad, disk(|own, value| own.friction = value));
        refused("restitution", and(1.0), disk(|own, value| own.restitution = value));
        refused("preload_acceleration", and(0.0), disk(|own, value| own.preload_acceleration = value));
        let turning = |radius: f64| DiskParameters { gyration_radius: radius, ..DISK };
        let loaded = |(torque, mass): (f64, f64)| DISK.with_load_torque(torque, mass);
        refused("mass", [(1.0, 0.0), (1.0, -0.05), (0.0, f64::INFINITY)], loaded);
        refused("torque", [(f64::NAN, 1.0)], loaded);
        refused("moment of inertia", [(1.0, 5e-324)], loaded);
        // The overflow would make the load vanish.
        refused("moment of inertia", [1e10], |radius| turning(radius).with_load_torque(1.0, 1e300));
        refused("gyration_radius", [-0.11], |radius| turning(radius).with_load_torque(1.0, 1.0));
        let moved = |platform: PlatformParameters| {
            System::new(platform.build().expect("legal"), DISK.build().expect("legal"))
        };
        let violent = moved(PlatformParameters { amplitude: 1e9, ..PLATFORM });
        assert!(matches!(violent, Err(Error::Core(_))));
        // The period in seconds exceeds the largest double, so a transient of such a motor would never end.
        let fast = |angular_frequency| PlatformParameters { angular_frequency, ..PLATFORM };
        refused("unit of time (s)", [fast(1e-310)], moved);
        let still = PlatformParameters { amplitude: 0.0, twist_amplitude: 0.0, ..fast(1e155) };
        refused("unit of length (m)", [fast(1e-160), still], moved);
    }

    /// A platform at rest, no friction and no rebound are legal.
    #[test]
    fn zeros_are_legal() {
        let platform = PlatformParameters { amplitude: 0.0, twist_amplitude: 0.0, ..PLATFORM };
        let disk = DiskParameters { friction: 0.0, restitution: 0.0, load_acceleration: 0.0, ..DISK };
        let system = System::new(platform.build().unwrap(), disk.build().unwrap()).unwrap();
        assert_eq!((system.axial_forcing(), system.angular_forcing()), (0.0, None));
        let torque = DISK.with_load_torque(0.02, 0.4).unwrap().load_acceleration;
        assert!((torque - 0.02 / (0.4 * 0.11 * 0.11)).abs() < 1e-14);
    }

    #[cfg(feature = "serde")]
    #[test]
    fn parameters_survive_json_and_illegal_json_and_misspelt_keys_are_refused() {
        let refused =
            |error: serde_json::Error, key: &str| assert!(error.to_string().contains(key), "{error}");
        let text = serde_json::to_string(&system()).unwrap();
        assert_eq!(serde_json::from_str::<System>(&text).unwrap(), system());
        let illegal = text.replace("\"restitution\":0.5", "\"restitution\":1.5");
        refused(serde_json::from_str::<System>(&illegal).unwrap_err(), "restitution = 1.5");
        // The quotes prevent a match inside a longer key: only the load may be missing, which has a default and
        // whose misspelling once counted as no load.
        let quoted = |key: &str| format!("\"{key}\"");
        for (key, misspelt) in
            [("load_acceleration", "load_aceleration"), ("phase_lag", "phase_leg"), ("disk", "disc")]
        {
            let text = text.replace(&quoted(key), &quoted(misspelt));
            refused(serde_json::from_str::<System>(&text).unwrap_err(), misspelt);
        }
        let text = serde_json::to_string(system().dimensionless()).unwrap();
        assert_eq!(serde_json::from_str::<DimensionlessSystem>(&text).unwrap(), *system().dimensionless());
        refused(
            serde_json::from_str::<DimensionlessSystem>(&text.replace("load", "lode")).unwrap_err(),
            "lode",
        );
        let stroke = r#"{"stroke":1.0,"amplitude_angle":0.0,"contact_radius":1.0,"angular_frequency":1.0,"phase_lag":0.0,"lag":1.0}"#;
        refused(serde_json::from_str::<Stroke>(stroke).unwrap_err(), "lag");
        let transition = r#"{"from":"Flight","event":"Impact","to":"Flight","via":"Sliding"}"#;
        refused(serde_json::from_str::<crate::motion::Transition>(transition).unwrap_err(), "via");
    }
}
