//! The table `[stator]` of a file: the modes and the drive of a compliant stator. The circuit is derived in
//! docs/numerics-dynamics.md, "A stator driven in volts".

use std::f64::consts::{PI, TAU};
use std::ops::RangeInclusive;

use bouncing_disk_core::numerics::elementary::{atan2, hypot};

use crate::error::{Error, check, finite, not_negative, positive};
use crate::parameters::platform::{Platform, PlatformParameters};

/// Range of quality factors.
pub(crate) const QUALITIES: RangeInclusive<f64> = 0.5..=1.0e5;
pub(crate) const QUALITIES_IN_WORDS: &str = "[0.5, 1e5]";

/// The motions of the stator that react to the rotor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum StatorKind {
    /// The height, in one mode; the twist is prescribed.
    #[default]
    Axial,
    /// Both, in one mode that turns the tip as it rises: beta = kappa s, as for a pretwisted beam.
    AxialTwist,
    /// Both, each in a mode with its own resonance.
    AxialAndTorsional,
}

/// The table `[stator]` of a file: a stator whose motion the rotor changes. Specify the drive once: by the
/// amplitude without a rotor, outside this table, or by [`Self::force`] or [`Self::volts`]. A system and a
/// data sheet check the table.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields, default, expecting = "the table stator"))]
pub struct StatorParameters {
    /// The motions that react to the rotor; by default the height alone.
    pub kind: StatorKind,
    /// Effective mass M of the axial mode at the tip (kg), positive; required.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub mass: Option<f64>,
    /// Quality factor Q of the axial mode, in [0.5, 1e5]; required.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub quality: Option<f64>,
    /// Resonance omega_1/(2 pi) of the axial mode (Hz) with short-circuited electrodes, positive. By default
    /// it equals the drive frequency, so a sweep over that frequency needs an explicit value.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub resonance: Option<f64>,
    /// kappa (rad/m), any finite number: the twist per height of [`StatorKind::AxialTwist`], instead of twist
    /// amplitude, peak angular speed and phase lag.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub twist_per_height: Option<f64>,
    /// Effective moment of inertia of the torsional mode (kg m^2), positive.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub inertia: Option<f64>,
    /// Quality factor of the torsional mode, in [0.5, 1e5].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub torsional_quality: Option<f64>,
    /// Resonance of the torsional mode (Hz), positive. Default: the drive frequency.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub torsional_resonance: Option<f64>,
    /// Amplitude of the torque that drives the torsional mode (N m), not negative; instead of twist
    /// amplitude, peak angular speed and phase lag.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub torque: Option<f64>,
    /// Phase by which this torque leads the axial force (rad), any finite number. Default 0.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub torque_phase: Option<f64>,
    /// Torque per volt (N m/V) from the same electrodes, any finite number; instead of the torque.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub torque_per_volt: Option<f64>,
    /// Amplitude of the axial force (N), not negative.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub force: Option<f64>,
    /// Amplitude of the voltage (V), not negative.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub volts: Option<f64>,
    /// Force per volt alpha (N/V), positive.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub force_per_volt: Option<f64>,
    /// Anti-resonance (Hz), above the resonance; given with the capacitance instead of the force per volt.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub anti_resonance: Option<f64>,
    /// Clamped capacitance C_0 (F), positive; without it the current is unknown.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub capacitance: Option<f64>,
}

/// A mode of a stator: M (q'' + (omega_1/Q) q' + omega_1^2 q) = F sin(omega t + phase) plus the reaction of the
/// rotor. The tip's height is the sum of `height` q over the modes, its angle the sum of `angle` q.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct VibrationMode {
    /// Effective mass M (kg), or moment of inertia (kg m^2) of a torsional mode.
    pub mass: f64,
    /// Angular frequency omega_1 of its resonance without damping (rad/s).
    pub angular_frequency: f64,
    /// Quality factor Q, in [0.5, 1e5].
    pub quality: f64,
    /// The tip's height over the coordinate: 1 for an axial mode, 0 for a torsional one.
    pub height: f64,
    /// The tip's angle over the coordinate: 0, kappa (rad/m), or 1 for a torsional mode.
    pub angle: f64,
    /// Amplitude F of the driving force (N), or torque (N m).
    pub force: f64,
    /// Phase of the force (rad), relative to the tip's steady height A sin(omega t) without a rotor.
    pub phase: f64,
}

impl VibrationMode {
    /// The complex ratio of force to coordinate at this angular frequency (N/m, or N m/rad).
    fn stiffness(&self, angular_frequency: f64) -> [f64; 2] {
        let (own, at) = (self.angular_frequency, angular_frequency);
        [self.mass * ((own - at) * (own + at)), self.mass * at * own / self.quality]
    }

    fn stiffness_size_and_angle(&self, angular_frequency: f64) -> (f64, f64) {
        let [re, im] = self.stiffness(angular_frequency);
        (hypot(re, im), atan2(im, re))
    }

    /// This mode with the force that makes the coordinate, without a rotor, move as `amplitude` sin(omega t +
    /// `lag`).
    fn moving(self, motion: &PlatformParameters, amplitude: f64, lag: f64) -> Self {
        let (size, angle) = self.stiffness_size_and_angle(motion.angular_frequency);
        Self { force: size * amplitude, phase: lag + angle, ..self }
    }
}

/// The equivalent circuit of Butterworth and Van Dyke, under V sin(omega t + phase). The current is C_0 dV/dt
/// plus, for each mode, its force per volt times dq/dt.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Circuit {
    /// Amplitude V (V), given or computed from the force.
    pub volts: f64,
    /// Phase of the voltage (rad), equal to the phase of the axial force.
    pub phase: f64,
    /// alpha of the axial mode (N/V).
    pub force_per_volt: f64,
    /// Torque per volt of the torsional mode (N m/V); 0 if the voltage does not drive it.
    pub torque_per_volt: f64,
    /// Clamped capacitance C_0 (F).
    pub capacitance: Option<f64>,
}

/// Current and power that a stator without a rotor draws from its supply.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct ElectricalInput {
    /// Amplitude of the current (A), and its lead over the voltage (rad); `None` without a capacitance.
    pub current: Option<(f64, f64)>,
    /// Mean power (W).
    pub power: f64,
}

/// A checked compliant stator. Without a rotor its steady motion is the platform's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StatorModes {
    parameters: StatorParameters,
    motion: PlatformParameters,
    modes: [VibrationMode; 2],
    circuit: Option<Circuit>,
}

impl StatorModes {
    /// The table `[stator]`.
    #[must_use]
    pub const fn parameters(&self) -> StatorParameters {
        self.parameters
    }

    /// The steady motion without a rotor: s = A sin(omega t), beta = Phi sin(omega t + theta).
    #[must_use]
    pub const fn motion(&self) -> PlatformParameters {
        self.motion
    }

    /// The one or two modes; the first is the axial one.
    #[must_use]
    pub fn modes(&self) -> &[VibrationMode] {
        let both = self.parameters.kind == StatorKind::AxialAndTorsional;
        &self.modes[..1 + usize::from(both)]
    }

    /// Whether the twist follows [`Self::motion`] whatever the rotor does; otherwise it follows the modes.
    #[must_use]
    pub fn prescribes_twist(&self) -> bool {
        self.parameters.kind == StatorKind::Axial
    }

    /// The equivalent circuit; `None` unless the force per volt or the anti-resonance is given.
    #[must_use]
    pub const fn circuit(&self) -> Option<Circuit> {
        self.circuit
    }

    /// The amplitude of the height (m) without a rotor, under the same force at another angular frequency (rad/s).
    #[must_use]
    pub fn amplitude_at(&self, angular_frequency: f64) -> f64 {
        self.modes[0].force / self.modes[0].stiffness_size_and_angle(angular_frequency).0
    }

    /// The preload (N) above which the stator no longer lifts a rotor of this mass (kg) that lies on it, with
    /// rigid impacts. Stator and rotor together move with the amplitude F/|K - m omega^2|, with the mode's
    /// complex stiffness K; the rotor is thrown if that amplitude times omega^2 exceeds g. At the free
    /// resonance the limit is F/(1 + (M/(m Q))^2)^(1/2). `None` if friction acts on the axial mode, too.
    #[must_use]
    pub fn lift_off_preload(&self, mass: f64) -> Option<f64> {
        let (axial, omega) = (&self.modes[0], self.motion.angular_frequency);
        let ([re, im], inertia) = (axial.stiffness(omega), mass * omega * omega);
        (axial.angle == 0.0).then(|| inertia * (axial.force / hypot(re - inertia, im)))
    }

    /// Current and power without a rotor, under the same voltage at an angular frequency (rad/s); `None`
    /// without a circuit. Excludes the power of a torque that the voltage does not supply.
    #[must_use]
    pub fn electrical_input_at(&self, angular_frequency: f64) -> Option<ElectricalInput> {
        let Circuit { volts, force_per_volt, torque_per_volt, capacitance, .. } = self.circuit?;
        // The admittance i omega (C_0 + sum of alpha^2/stiffness).
        let (mut conductance, mut susceptance) = (0.0, 0.0);
        for (mode, per_volt) in self.modes().iter().zip([force_per_volt, torque_per_volt]) {
            let [re, im] = mode.stiffness(angular_frequency);
            let size = hypot(re, im);
            let own = angular_frequency * (per_volt / size) * (per_volt / size);
            (conductance, susceptance) = (conductance + own * im, susceptance + own * re);
        }
        let current = capacitance.map(|capacitance| {
            let susceptance = susceptance + angular_frequency * capacitance;
            (volts * hypot(conductance, susceptance), atan2(susceptance, conductance))
        });
        Some(ElectricalInput { current, power: 0.5 * volts * volts * conductance })
    }
}

/// The steady motion without a rotor as stated in a file. Values that a stator computes are absent.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GivenMotion {
    pub(crate) angular_frequency: f64,
    pub(crate) amplitude: Option<f64>,
    /// Its name, and its value.
    pub(crate) twist_amplitude: Option<(&'static str, f64)>,
    pub(crate) phase_lag: f64,
}

impl StatorParameters {
    /// The fields that determine the amplitude, and the twist with its phase.
    pub(crate) fn computes(&self) -> [Option<&'static str>; 2] {
        let first = |fields: [(_, Option<f64>); 3]| {
            fields.iter().find(|field| field.1.is_some()).map(|field| field.0)
        };
        [
            first([("stator.force", self.force), ("stator.volts", self.volts), ("", None)]),
            first([
                ("stator.twist_per_height", self.twist_per_height),
                ("stator.torque", self.torque),
                ("stator.torque_per_volt", self.torque_per_volt),
            ]),
        ]
    }

    /// Checks the numbers, and that everything needed is given and nothing else.
    fn check(&self) -> Result<(), Error> {
        use StatorKind::{Axial, AxialAndTorsional, AxialTwist};
        type Legal = fn(&'static str, f64) -> Result<f64, Error>;
        let quality: Legal =
            |field, value| check(QUALITIES.contains(&value), field, value, QUALITIES_IN_WORDS);
        let all: &[StatorKind] = &[Axial, AxialTwist, AxialAndTorsional];
        let torsional: &[StatorKind] = &[AxialAndTorsional];
        let fields: [(_, _, Legal, _); 15] = [
            ("stator.mass", self.mass, positive, all),
            ("stator.quality", self.quality, quality, all),
            ("stator.resonance", self.resonance, positive, all),
            ("stator.twist_per_height", self.twist_per_height, finite, &[AxialTwist]),
            ("stator.inertia", self.inertia, positive, torsional),
            ("stator.torsional_quality", self.torsional_quality, quality, torsional),
            ("stator.torsional_resonance", self.torsional_resonance, positive, torsional),
            ("stator.torque", self.torque, not_negative, torsional),
            ("stator.torque_phase", self.torque_phase, finite, torsional),
            ("stator.torque_per_volt", self.torque_per_volt, finite, torsional),
            ("stator.force", self.force, not_negative, all),
            ("stator.volts", self.volts, not_negative, all),
            ("stator.force_per_volt", self.force_per_volt, positive, all),
            ("stator.anti_resonance", self.anti_resonance, positive, all),
            ("stator.capacitance", self.capacitance, positive, all),
        ];
        let given = |name: &str| fields.iter().any(|(field, value, ..)| *field == name && value.is_some());
        for (field, value, legal, kinds) in fields {
            if let Some(value) = value {
                legal(field, value)?;
                if !kinds.contains(&self.kind) {
                    return Err(Error::BothGiven { one: "another stator.kind", other: field });
                }
            }
        }
        for (one, other) in [
            ("stator.force", "stator.volts"),
            ("stator.force_per_volt", "stator.anti_resonance"),
            ("stator.torque", "stator.torque_per_volt"),
            ("stator.torque_phase", "stator.torque_per_volt"),
        ] {
            if given(one) && given(other) {
                return Err(Error::BothGiven { one, other });
            }
        }
        let has_circuit = given("stator.force_per_volt") || given("stator.anti_resonance");
        for (one, needs) in [
            (true, "stator.mass"),
            (true, "stator.quality"),
            (self.kind == AxialAndTorsional, "stator.inertia"),
            (self.kind == AxialAndTorsional, "stator.torsional_quality"),
            (given("stator.torque_phase"), "stator.torque"),
            (given("stator.anti_resonance"), "stator.capacitance"),
        ] {
            if one && !given(needs) {
                return Err(Error::NotGiven { field: needs });
            }
        }
        let needs_circuit = ["stator.volts", "stator.torque_per_volt", "stator.capacitance"];
        match needs_circuit.into_iter().find(|field| given(field)) {
            Some(field) if !has_circuit => Err(Error::NoForcePerVolt { field }),
            _ => Ok(()),
        }
    }

    /// The stator with this steady motion without a rotor.
    pub(crate) fn build(self, given: GivenMotion) -> Result<StatorModes, Error> {
        let GivenMotion { angular_frequency, amplitude, twist_amplitude, phase_lag } = given;
        let exclude = |one: Option<&'static str>, other: Option<&'static str>| match (one, other) {
            (Some(one), Some(other)) => Err(Error::BothGiven { one, other }),
            _ => Ok(()),
        };
        let [lifts, twists] = self.computes();
        exclude(amplitude.map(|_| "amplitude"), lifts)?;
        exclude(twist_amplitude.map(|(name, _)| name), twists)?;
        exclude((phase_lag != 0.0).then_some("phase_lag"), twists)?;
        self.check()?;
        let mode =
            |mass: Option<f64>, quality: Option<f64>, resonance: Option<f64>, height: f64| VibrationMode {
                mass: mass.unwrap_or_default(),
                angular_frequency: resonance.map_or(angular_frequency, |resonance| TAU * resonance),
                quality: quality.unwrap_or_default(),
                height,
                angle: 1.0 - height,
                force: 0.0,
                phase: 0.0,
            };
        let mut axial = mode(self.mass, self.quality, self.resonance, 1.0);
        let torsional = mode(self.inertia, self.torsional_quality, self.torsional_resonance, 0.0);
        let (stiffness, angle) = axial.stiffness_size_and_angle(angular_frequency);
        let force_per_volt = self.alpha(&axial)?;
        let drive = self.force.or(self.volts.zip(force_per_volt).map(|(volts, alpha)| volts * alpha));
        let amplitude = match (amplitude, drive) {
            (_, Some(force)) => force / stiffness,
            (Some(amplitude), None) => amplitude,
            (None, None) => return Err(Error::NeitherGiven { one: "amplitude", other: "stator.volts" }),
        };
        axial = VibrationMode { force: drive.unwrap_or(stiffness * amplitude), phase: angle, ..axial };
        let volts = |alpha| self.volts.unwrap_or(axial.force / alpha);
        let circuit = force_per_volt.map(|alpha| Circuit {
            volts: volts(alpha),
            phase: axial.phase,
            force_per_volt: alpha,
            torque_per_volt: self.torque_per_volt.unwrap_or_default(),
            capacitance: self.capacitance,
        });
        let torque =
            self.torque.or(circuit.zip(self.torque_per_volt).map(|(own, per_volt)| own.volts * per_volt));
        let (twist_amplitude, phase_lag) = match (self.twist_per_height, torque, twist_amplitude) {
            (Some(kappa), ..) => (kappa.abs() * amplitude, if kappa < 0.0 { PI } else { 0.0 }),
            (_, Some(torque), _) => {
                let (stiffness, angle) = torsional.stiffness_size_and_angle(angular_frequency);
                let turned = if torque < 0.0 { PI } else { 0.0 };
                (torque.abs() / stiffness, axial.phase + self.torque_phase.unwrap_or(turned) - angle)
            }
            (.., Some((_, twist))) => (twist, phase_lag),
            (.., None) => {
                return Err(Error::NeitherGiven { one: "peak_angular_speed", other: "twist_amplitude" });
            }
        };
        let motion = PlatformParameters { amplitude, twist_amplitude, angular_frequency, phase_lag };
        if self.kind == StatorKind::AxialTwist {
            let legal = phase_lag == 0.0 || phase_lag.abs().to_bits() == PI.to_bits();
            check(legal, "phase_lag", phase_lag, "0, pi or -pi (rad) if stator.kind is axial_twist")?;
            axial.angle = match self.twist_per_height {
                Some(kappa) => kappa,
                None if amplitude == 0.0 => return Err(Error::NotGiven { field: "stator.twist_per_height" }),
                None if phase_lag == 0.0 => twist_amplitude / amplitude,
                None => -twist_amplitude / amplitude,
            };
        }
        let torsional = match self.kind {
            StatorKind::AxialAndTorsional => torsional.moving(&motion, twist_amplitude, phase_lag),
            _ => axial,
        };
        let stator = StatorModes { parameters: self, motion, modes: [axial, torsional], circuit };
        for (mode, moved) in stator.modes().iter().zip([amplitude, twist_amplitude]) {
            finite("angular frequency of the stator (rad/s)", mode.angular_frequency)?;
            let legal = mode.force.is_normal() && moved.is_normal() || mode.force == 0.0 && moved == 0.0;
            check(
                legal,
                "force of the stator (N, or N m)",
                mode.force,
                "a normal number, or 0 if there is no motion",
            )?;
        }
        Ok(stator)
    }

    /// The stator of a platform whose parameters must equal those computed from this table.
    pub(crate) fn of_platform(self, platform: &Platform) -> Result<StatorModes, Error> {
        let (own, [lifts, twists]) = (platform.parameters(), self.computes());
        let twist_amplitude = ("twist_amplitude", own.twist_amplitude);
        let given = GivenMotion {
            angular_frequency: own.angular_frequency,
            amplitude: lifts.is_none().then_some(own.amplitude),
            twist_amplitude: twists.is_none().then_some(twist_amplitude),
            phase_lag: if twists.is_none() { own.phase_lag } else { 0.0 },
        };
        let stator = self.build(given)?;
        match (lifts, twists) {
            (Some(other), _) if stator.motion.amplitude.to_bits() != own.amplitude.to_bits() => {
                Err(Error::BothGiven { one: "amplitude", other })
            }
            (_, Some(other)) if stator.motion != own => {
                Err(Error::BothGiven { one: "twist_amplitude", other })
            }
            _ => Ok(stator),
        }
    }

    /// The force per volt, given or from the anti-resonance.
    fn alpha(&self, axial: &VibrationMode) -> Result<Option<f64>, Error> {
        let Some((anti_resonance, capacitance)) = self.anti_resonance.zip(self.capacitance) else {
            return Ok(self.force_per_volt);
        };
        // M C_0 (omega_a^2 - omega_1^2)
        let (own, anti) = (axial.angular_frequency, TAU * anti_resonance);
        check(anti > own, "stator.anti_resonance", anti_resonance, "above stator.resonance (Hz)")?;
        let alpha = (axial.mass * capacitance * ((anti - own) * (anti + own))).sqrt();
        positive("force per volt of stator.anti_resonance and stator.capacitance", alpha).map(Some)
    }
}

#[cfg(test)]
mod tests;
