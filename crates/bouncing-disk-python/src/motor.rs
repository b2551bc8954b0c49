//! Data sheets of motors.

use bouncing_disk::{Motor as Model, MotorField, MotorParameters};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::arguments::ProgressCallable;
use crate::real::{Real, optional};
use crate::regime::regime;
use crate::system::System;
use crate::system_names::OF_MOTOR;
use crate::text::Json;
use crate::{errors, long_call, results, text};

/// A motor by its data sheet, in SI units.
///
/// Of each pair of alternatives exactly one is given: ``peak_angular_speed`` or ``twist_amplitude``, ``mass``
/// or ``density``, ``preload_force`` or ``preload_acceleration``.
///
/// Parameters
/// ----------
/// drive_frequency : float
///     Drive frequency omega/(2 pi) (Hz), positive.
/// amplitude : float
///     Axial amplitude A of the stator (m), not negative.
/// peak_angular_speed : float, optional
///     Largest angular speed omega Phi of the stator (rad/s), not negative.
/// twist_amplitude : float, optional
///     Twist amplitude Phi of the stator (rad), not negative.
/// phase_lag : float, default 0
///     Phase lag theta of the twist (rad).
/// mass : float, optional
///     Mass m of the rotor (kg), positive.
/// density : float, optional
///     Density of the rotor (kg/m^3), positive, with ``rotor_radius`` and ``rotor_thickness`` of a solid
///     disc.
/// rotor_radius, rotor_thickness : float, optional
///     Outer radius and thickness of the rotor (m), positive.
/// contact_radius : float
///     Effective contact radius a_e (m), positive.
/// gyration_radius : float, optional
///     Radius of gyration a_g (m), positive; that of a solid disc where a rotor radius is given.
/// preload_force : float, optional
///     All of the force that presses the rotor onto the stator (N), positive.
/// preload_acceleration : float, optional
///     That force by the mass (m/s^2), positive.
/// spring_constant : float, optional
///     Constant of the spring that makes the preload (N/m), positive.
/// friction : float
///     Coefficient of friction mu, not negative.
/// restitution : float
///     Coefficient of restitution, in [0, 1).
/// load_torque : float, default 0
///     Load torque T_L (N m); a positive one decelerates a positive rotation.
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> motor = bd.Motor(drive_frequency=70e3, amplitude=1e-8, peak_angular_speed=30.0, mass=1e-3, contact_radius=1.25e-3,
/// ...     gyration_radius=6.3e-3, preload_acceleration=9.8, friction=0.1, restitution=0.5)
/// >>> motor.replace(friction=0.2).friction
/// 0.2
/// >>> bd.Motor.from_json(motor.to_json()) == motor
/// True
#[pyclass(frozen, eq, module = "bouncing_disk")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Motor(pub(crate) Model);

impl Motor {
    fn arguments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let sheet = self.0.parameters();
        let arguments = PyDict::new(py);
        let optional = [
            ("drive_frequency", Some(sheet.drive_frequency)),
            ("amplitude", Some(sheet.amplitude)),
            ("peak_angular_speed", sheet.peak_angular_speed),
            ("twist_amplitude", sheet.twist_amplitude),
            ("phase_lag", Some(sheet.phase_lag)),
            ("mass", sheet.mass),
            ("density", sheet.density),
            ("rotor_radius", sheet.rotor_radius),
            ("rotor_thickness", sheet.rotor_thickness),
            ("contact_radius", Some(sheet.contact_radius)),
            ("gyration_radius", sheet.gyration_radius),
            ("preload_force", sheet.preload_force),
            ("preload_acceleration", sheet.preload_acceleration),
            ("spring_constant", sheet.spring_constant),
            ("friction", Some(sheet.friction)),
            ("restitution", Some(sheet.restitution)),
            ("load_torque", Some(sheet.load_torque)),
        ];
        for (name, value) in optional {
            if let Some(value) = value {
                arguments.set_item(name, value)?;
            }
        }
        Ok(arguments)
    }
}

#[pymethods]
impl Motor {
    #[new]
    #[pyo3(signature = (
        *, drive_frequency, amplitude, peak_angular_speed=None, twist_amplitude=None, phase_lag=Real(0.0), mass=None,
        density=None, rotor_radius=None, rotor_thickness=None, contact_radius, gyration_radius=None,
        preload_force=None, preload_acceleration=None, spring_constant=None, friction, restitution,
        load_torque=Real(0.0)
    ), text_signature = "(*, drive_frequency, amplitude, peak_angular_speed=None, twist_amplitude=None, \
                         phase_lag=0.0, mass=None, density=None, rotor_radius=None, rotor_thickness=None, \
                         contact_radius, gyration_radius=None, preload_force=None, preload_acceleration=None, \
                         spring_constant=None, friction, restitution, load_torque=0.0)")]
    #[expect(clippy::too_many_arguments, reason = "they are keywords")]
    fn new(
        py: Python<'_>,
        drive_frequency: Real,
        amplitude: Real,
        peak_angular_speed: Option<Real>,
        twist_amplitude: Option<Real>,
        phase_lag: Real,
        mass: Option<Real>,
        density: Option<Real>,
        rotor_radius: Option<Real>,
        rotor_thickness: Option<Real>,
        contact_radius: Real,
        gyration_radius: Option<Real>,
        preload_force: Option<Real>,
        preload_acceleration: Option<Real>,
        spring_constant: Option<Real>,
        friction: Real,
        restitution: Real,
        load_torque: Real,
    ) -> PyResult<Self> {
        let sheet = MotorParameters {
            drive_frequency: drive_frequency.0,
            amplitude: amplitude.0,
            peak_angular_speed: optional(peak_angular_speed),
            twist_amplitude: optional(twist_amplitude),
            phase_lag: phase_lag.0,
            mass: optional(mass),
            density: optional(density),
            rotor_radius: optional(rotor_radius),
            rotor_thickness: optional(rotor_thickness),
            contact_radius: contact_radius.0,
            gyration_radius: optional(gyration_radius),
            preload_force: optional(preload_force),
            preload_acceleration: optional(preload_acceleration),
            spring_constant: optional(spring_constant),
            friction: friction.0,
            restitution: restitution.0,
            load_torque: load_torque.0,
        };
        sheet.build().map(Self).map_err(|error| errors::of_named(py, error, &OF_MOTOR))
    }

    /// The same motor with other values in its data sheet.
    ///
    /// Parameters
    /// ----------
    /// **changes : float or None
    ///     Arguments of :class:`Motor`; None takes a value out. A number takes the place of its alternative, so that
    ///     a motor with a ``preload_acceleration`` gets a ``preload_force`` by naming the force alone.
    ///
    /// Returns
    /// -------
    /// Motor
    ///
    /// Examples
    /// --------
    /// >>> import bouncing_disk as bd
    /// >>> pressed = bd.Motor.paper_70_khz().replace(preload_force=0.02)
    /// >>> "preload_acceleration" in pressed.to_dict()
    /// False
    #[pyo3(signature = (**changes))]
    fn replace<'py>(
        &self,
        py: Python<'py>,
        changes: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let arguments = self.arguments(py)?;
        if let Some(changes) = changes {
            // Who names both alternatives is told so.
            for (name, value) in changes {
                let field = name.extract::<String>()?.parse::<MotorField>();
                for other in field.ok().filter(|_| !value.is_none()).map_or(&[][..], MotorField::excluded) {
                    if arguments.contains(other.name())? {
                        arguments.del_item(other.name())?;
                    }
                }
            }
            arguments.update(changes.as_mapping())?;
        }
        py.get_type::<Self>().call((), Some(&arguments))
    }

    /// The system without the mass.
    #[getter]
    fn system(&self) -> System {
        System(*self.0.system())
    }

    /// Drive frequency (Hz).
    #[getter]
    fn drive_frequency(&self) -> f64 {
        self.0.parameters().drive_frequency
    }

    /// Axial amplitude A of the stator (m).
    #[getter]
    fn amplitude(&self) -> f64 {
        self.0.parameters().amplitude
    }

    /// Largest angular speed omega Phi of the stator (rad/s).
    #[getter]
    fn peak_angular_speed(&self) -> f64 {
        self.0.system().platform().peak_angular_speed()
    }

    /// Twist amplitude Phi of the stator (rad).
    #[getter]
    fn twist_amplitude(&self) -> f64 {
        self.0.system().platform().twist_amplitude()
    }

    /// Phase lag theta of the twist (rad).
    #[getter]
    fn phase_lag(&self) -> f64 {
        self.0.parameters().phase_lag
    }

    /// Mass m of the rotor (kg).
    #[getter]
    fn mass(&self) -> f64 {
        self.0.mass()
    }

    /// Moment of inertia m a_g^2 of the rotor (kg m^2).
    #[getter]
    fn inertia(&self) -> f64 {
        self.0.inertia()
    }

    /// Effective contact radius a_e (m).
    #[getter]
    fn contact_radius(&self) -> f64 {
        self.0.system().disk().contact_radius()
    }

    /// Radius of gyration a_g (m).
    #[getter]
    fn gyration_radius(&self) -> f64 {
        self.0.system().disk().gyration_radius()
    }

    /// Force that presses the rotor onto the stator (N).
    #[getter]
    fn preload_force(&self) -> f64 {
        self.0.preload_force()
    }

    /// That force by the mass (m/s^2).
    #[getter]
    fn preload_acceleration(&self) -> f64 {
        self.0.preload_acceleration()
    }

    /// Coefficient of friction mu.
    #[getter]
    fn friction(&self) -> f64 {
        self.0.parameters().friction
    }

    /// Coefficient of restitution.
    #[getter]
    fn restitution(&self) -> f64 {
        self.0.parameters().restitution
    }

    /// Load torque T_L (N m).
    #[getter]
    fn load_torque(&self) -> f64 {
        self.0.load_torque()
    }

    /// mu m g a_e (N m), which no motor exceeds in the mean.
    #[getter]
    fn largest_torque(&self) -> f64 {
        self.0.largest_torque()
    }

    /// Static deflection of the preload's spring (m); None without one.
    #[getter]
    fn static_deflection(&self) -> Option<f64> {
        self.0.static_deflection()
    }

    /// What is unlikely to be meant in the data sheet, in words.
    ///
    /// Returns
    /// -------
    /// tuple of str
    fn warnings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.0.warnings().iter().map(ToString::to_string))
    }

    /// What the data sheet says before anything turns: forcing, regime, largest torque.
    ///
    /// Parameters
    /// ----------
    /// progress : callable, optional
    ///     Called as ``progress(done, total)``.
    ///
    /// Returns
    /// -------
    /// MotorReport
    #[pyo3(signature = (*, progress=ProgressCallable(None)), text_signature = "($self, /, *, progress=None)")]
    fn report<'py>(&self, py: Python<'py>, progress: ProgressCallable) -> PyResult<Bound<'py, PyAny>> {
        let report = long_call::run(py, progress.0, |observer| self.0.report(observer))?;
        let (name, impacts, platform_periods, rests, exponent) = regime(&report.regime);
        let fields = (
            report.axial_forcing,
            report.angular_forcing,
            report.peak_acceleration,
            name,
            impacts,
            platform_periods,
            rests,
            exponent,
            report.periods_per_flight,
            report.largest_torque,
            report.static_deflection,
            report.preload_change_bound,
        );
        let rest = (self.warnings(py)?, report.to_string());
        results::make(py, "MotorReport", results::joined(py, fields, rest)?)
    }

    /// The data sheet as a dictionary: the values that are given.
    ///
    /// Returns
    /// -------
    /// dict
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.arguments(py)
    }

    /// The motor of such a dictionary.
    ///
    /// Parameters
    /// ----------
    /// parameters : dict
    ///     As of :meth:`to_dict`.
    ///
    /// Returns
    /// -------
    /// Motor
    #[staticmethod]
    fn from_dict<'py>(py: Python<'py>, parameters: &Bound<'py, PyDict>) -> PyResult<Bound<'py, PyAny>> {
        py.get_type::<Self>().call((), Some(parameters))
    }

    /// The motor of the paper's Table III, driven at 70 kHz.
    ///
    /// The paper does not print its mass: it is that of a solid steel ball of the printed 20 mm.
    ///
    /// Returns
    /// -------
    /// Motor
    #[staticmethod]
    fn paper_70_khz() -> Self {
        Self(Model::paper_70_khz())
    }

    /// The same motor as the paper drives it at 184 kHz.
    ///
    /// Returns
    /// -------
    /// Motor
    #[staticmethod]
    fn paper_184_khz() -> Self {
        Self(Model::paper_184_khz())
    }

    /// The motor of a data sheet in TOML, such as the command line's ``--template`` writes.
    ///
    /// Parameters
    /// ----------
    /// toml : str
    ///     The text of the file.
    ///
    /// Returns
    /// -------
    /// Motor
    ///
    /// Examples
    /// --------
    /// >>> import bouncing_disk as bd
    /// >>> text = "\n".join(f"{key} = {value!r}" for key, value in bd.Motor.paper_70_khz().to_dict().items())
    /// >>> bd.Motor.from_toml(text) == bd.Motor.paper_70_khz()
    /// True
    #[staticmethod]
    fn from_toml(py: Python<'_>, toml: Json) -> PyResult<Self> {
        let read = Model::from_toml(toml.as_str());
        read.map(Self).map_err(|error| errors::of_motor_file(py, &error, &OF_MOTOR))
    }

    /// The data sheet as the JSON that the Rust library and its command line read.
    ///
    /// Returns
    /// -------
    /// str
    fn to_json(&self) -> String {
        self.0.to_json()
    }

    /// The motor of such a text; errors name the line.
    ///
    /// Parameters
    /// ----------
    /// json : str
    ///     As of :meth:`to_json`.
    ///
    /// Returns
    /// -------
    /// Motor
    #[staticmethod]
    fn from_json(py: Python<'_>, json: Json) -> PyResult<Self> {
        let read = Model::from_json(json.as_str());
        read.map(Self).map_err(|error| errors::of_motor_file(py, &error, &OF_MOTOR))
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<((), Bound<'py, PyDict>)> {
        Ok(((), self.arguments(py)?))
    }

    fn __hash__(&self) -> u64 {
        let numbers =
            [self.drive_frequency(), self.amplitude(), self.mass(), self.friction(), self.load_torque()];
        text::hash(&numbers)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        text::call("Motor", &self.arguments(py)?)
    }
}
