//! A disk on a platform, in SI units.

use std::f64::consts::TAU;

use bouncing_disk::core::Phase;
use bouncing_disk::{DiskParameters, Platform, PlatformParameters, Stroke, System as Model};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arguments::row;
use crate::names::{Name, Named, name};
use crate::real::Real;
use crate::system_dict::{DISK, PLATFORM, SystemParts};
use crate::system_names::{DERIVED, OF_LOAD, OF_PARTS, OF_STROKE};
use crate::text::Json;
use crate::{errors, results, system_dict, text};

type Row<'py> = Bound<'py, PyArray1<f64>>;

/// A disk on a vibrating and twisting platform, in SI units.
///
/// Every value is checked as the object is made, which never changes after that.
///
/// Parameters
/// ----------
/// amplitude : float
///     Amplitude A of the platform's height (m), not negative.
/// twist_amplitude : float
///     Amplitude Phi of its angle (rad), not negative.
/// angular_frequency : float
///     Angular frequency omega (rad/s), positive.
/// phase_lag : float, default 0
///     Phase lag theta of the twist (rad).
/// contact_radius : float
///     Effective contact radius a_e (m) of the disk, positive.
/// gyration_radius : float
///     Radius of gyration a_g (m), positive.
/// friction : float
///     Coefficient of friction mu, not negative.
/// restitution : float
///     Coefficient of restitution, in [0, 1).
/// preload_acceleration : float
///     Preload acceleration g (m/s^2), positive.
/// load_acceleration : float, default 0
///     Angular deceleration by a load torque (rad/s^2).
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> toss = bd.System.pizza_toss()
/// >>> round(toss.axial_forcing, 3)
/// 1.558
/// >>> toss.replace(friction=0.05).friction
/// 0.05
#[pyclass(frozen, eq, module = "bouncing_disk")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct System(pub(crate) Model);

fn build(py: Python<'_>, parts: SystemParts, names: &[Name]) -> PyResult<System> {
    let made = parts.platform.build().and_then(|platform| Model::new(platform, parts.disk.build()?));
    made.map(System).map_err(|error| errors::of_named(py, error, names))
}

impl System {
    /// The numbers in the order of the arguments.
    fn numbers(&self) -> [f64; 10] {
        let (platform, disk) = (self.0.platform().parameters(), self.0.disk().parameters());
        [
            platform.amplitude,
            platform.twist_amplitude,
            platform.angular_frequency,
            platform.phase_lag,
            disk.contact_radius,
            disk.gyration_radius,
            disk.friction,
            disk.restitution,
            disk.preload_acceleration,
            disk.load_acceleration,
        ]
    }

    /// The arguments of the constructor.
    fn arguments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dictionary = PyDict::new(py);
        for (name, value) in PLATFORM.iter().chain(&DISK).zip(self.numbers()) {
            dictionary.set_item(name, value)?;
        }
        Ok(dictionary)
    }
}

#[pymethods]
impl System {
    #[new]
    #[pyo3(signature = (
        *, amplitude, twist_amplitude, angular_frequency, phase_lag=Real(0.0), contact_radius, gyration_radius,
        friction, restitution, preload_acceleration, load_acceleration=Real(0.0)
    ), text_signature = "(*, amplitude, twist_amplitude, angular_frequency, phase_lag=0.0, contact_radius, \
                         gyration_radius, friction, restitution, preload_acceleration, load_acceleration=0.0)")]
    #[expect(clippy::too_many_arguments, reason = "they are keywords")]
    fn new(
        py: Python<'_>,
        amplitude: Real,
        twist_amplitude: Real,
        angular_frequency: Real,
        phase_lag: Real,
        contact_radius: Real,
        gyration_radius: Real,
        friction: Real,
        restitution: Real,
        preload_acceleration: Real,
        load_acceleration: Real,
    ) -> PyResult<Self> {
        let platform = PlatformParameters {
            amplitude: amplitude.0,
            twist_amplitude: twist_amplitude.0,
            angular_frequency: angular_frequency.0,
            phase_lag: phase_lag.0,
        };
        let disk = DiskParameters {
            contact_radius: contact_radius.0,
            gyration_radius: gyration_radius.0,
            friction: friction.0,
            restitution: restitution.0,
            preload_acceleration: preload_acceleration.0,
            load_acceleration: load_acceleration.0,
        };
        build(py, SystemParts { platform, disk }, &DERIVED)
    }

    /// The pizza toss of Table I of the paper.
    #[staticmethod]
    fn pizza_toss() -> Self {
        Self(Model::pizza_toss())
    }

    /// The motor of Table III of the paper.
    ///
    /// Returns
    /// -------
    /// System
    #[staticmethod]
    fn motor() -> Self {
        Self(Model::motor())
    }

    /// A system whose platform moves along a stroke that is shared between lift and twist (Eq. 13 of the
    /// paper).
    ///
    /// Parameters
    /// ----------
    /// stroke : float
    ///     Stroke c (m), not negative.
    /// amplitude_angle : float
    ///     Amplitude angle phi_L (rad), in [0, pi/2]: 0 lifts only, pi/2 twists only.
    /// angular_frequency, phase_lag, contact_radius, gyration_radius : float
    /// friction, restitution, preload_acceleration, load_acceleration : float
    ///     As of :class:`System`.
    ///
    /// Returns
    /// -------
    /// System
    ///
    /// Examples
    /// --------
    /// >>> import bouncing_disk as bd
    /// >>> bd.System.from_stroke(stroke=0.25, amplitude_angle=0.55, angular_frequency=15.0, contact_radius=0.135,
    /// ...     gyration_radius=0.11, friction=0.6, restitution=0.5,
    /// ...     preload_acceleration=9.8) == bd.System.pizza_toss()
    /// True
    #[staticmethod]
    #[pyo3(signature = (
        *, stroke, amplitude_angle, angular_frequency, phase_lag=Real(0.0), contact_radius, gyration_radius, friction,
        restitution, preload_acceleration, load_acceleration=Real(0.0)
    ), text_signature = "(*, stroke, amplitude_angle, angular_frequency, phase_lag=0.0, contact_radius, \
                         gyration_radius, friction, restitution, preload_acceleration, load_acceleration=0.0)")]
    #[expect(clippy::too_many_arguments, reason = "they are keywords")]
    fn from_stroke(
        py: Python<'_>,
        stroke: Real,
        amplitude_angle: Real,
        angular_frequency: Real,
        phase_lag: Real,
        contact_radius: Real,
        gyration_radius: Real,
        friction: Real,
        restitution: Real,
        preload_acceleration: Real,
        load_acceleration: Real,
    ) -> PyResult<Self> {
        let hand = Stroke {
            stroke: stroke.0,
            amplitude_angle: amplitude_angle.0,
            contact_radius: contact_radius.0,
            angular_frequency: angular_frequency.0,
            phase_lag: phase_lag.0,
        };
        let disk = DiskParameters {
            contact_radius: contact_radius.0,
            gyration_radius: gyration_radius.0,
            friction: friction.0,
            restitution: restitution.0,
            preload_acceleration: preload_acceleration.0,
            load_acceleration: load_acceleration.0,
        };
        let platform =
            Platform::from_stroke(hand).map_err(|error| errors::of_named(py, error, &OF_STROKE))?;
        build(py, SystemParts { platform: platform.parameters(), disk }, &OF_STROKE)
    }

    /// The same system with other parameters.
    ///
    /// Parameters
    /// ----------
    /// **changes : float
    ///     Arguments of :class:`System`.
    ///
    /// Returns
    /// -------
    /// System
    #[pyo3(signature = (**changes))]
    fn replace<'py>(
        &self,
        py: Python<'py>,
        changes: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let arguments = self.arguments(py)?;
        if let Some(changes) = changes {
            arguments.update(changes.as_mapping())?;
        }
        py.get_type::<Self>().call((), Some(&arguments))
    }

    /// The same system with a load torque.
    ///
    /// Parameters
    /// ----------
    /// torque : float
    ///     Load torque T_L (N m); a positive one decelerates a positive rotation.
    /// mass : float
    ///     Mass m of the disk (kg), positive.
    ///
    /// Returns
    /// -------
    /// System
    #[pyo3(signature = (*, torque, mass))]
    fn with_load_torque(&self, py: Python<'_>, torque: Real, mass: Real) -> PyResult<Self> {
        let loaded = self.0.with_load_torque(torque.0, mass.0);
        loaded.map(Self).map_err(|error| errors::of_named(py, error, &OF_LOAD))
    }

    /// Amplitude A of the platform's height (m).
    #[getter]
    fn amplitude(&self) -> f64 {
        self.0.platform().amplitude()
    }

    /// Amplitude Phi of the platform's angle (rad).
    #[getter]
    fn twist_amplitude(&self) -> f64 {
        self.0.platform().twist_amplitude()
    }

    /// Angular frequency omega (rad/s).
    #[getter]
    fn angular_frequency(&self) -> f64 {
        self.0.platform().angular_frequency()
    }

    /// Period of the platform (s).
    #[getter]
    fn period(&self) -> f64 {
        TAU / self.0.platform().angular_frequency()
    }

    /// Largest angular speed omega Phi of the platform (rad/s).
    #[getter]
    fn peak_angular_speed(&self) -> f64 {
        self.0.platform().peak_angular_speed()
    }

    /// Stroke c = (A^2 + (a_e Phi)^2)^(1/2) at the contact radius (m), Eq. (13).
    #[getter]
    fn stroke(&self) -> f64 {
        self.0.stroke().stroke
    }

    /// Amplitude angle phi_L = arctan(a_e Phi/A) (rad): 0 lifts, pi/2 turns; 0 where nothing moves.
    #[getter]
    fn amplitude_angle(&self) -> f64 {
        self.0.stroke().amplitude_angle
    }

    /// Height and angle of the platform.
    ///
    /// Parameters
    /// ----------
    /// phases : (n,) array_like
    ///     Phases omega t (rad).
    ///
    /// Returns
    /// -------
    /// ((n,) float64 array, (n,) float64 array)
    ///     A sin(omega t) (m) and Phi sin(omega t + theta) (rad), Eq. (1).
    ///
    /// Examples
    /// --------
    /// >>> import bouncing_disk as bd
    /// >>> import numpy as np
    /// >>> pizza = bd.System.pizza_toss()
    /// >>> height, angle = pizza.platform_motion(phases=[0.5 * np.pi])
    /// >>> float(height[0]) == pizza.amplitude, float(angle[0]) == pizza.twist_amplitude
    /// (True, True)
    #[pyo3(signature = (*, phases))]
    fn platform_motion<'py>(
        &self,
        py: Python<'py>,
        phases: &Bound<'py, PyAny>,
    ) -> PyResult<(Row<'py>, Row<'py>)> {
        let platform = self.0.platform();
        let phases = row(phases, "phases")?
            .into_iter()
            .map(|phase| Phase::new(phase).named(&[name("phase", &["phases"])]))
            .collect::<Result<Vec<_>, _>>()
            .map_err(|error| errors::of(py, error))?;
        let of =
            |value: &dyn Fn(Phase) -> f64| results::array(py, phases.iter().copied().map(value).collect());
        Ok((of(&|phase| platform.height(phase)), of(&|phase| platform.angle(phase))))
    }

    /// Phase lag theta of the twist (rad).
    #[getter]
    fn phase_lag(&self) -> f64 {
        self.0.platform().phase_lag()
    }

    /// Effective contact radius a_e (m).
    #[getter]
    fn contact_radius(&self) -> f64 {
        self.0.disk().contact_radius()
    }

    /// Radius of gyration a_g (m).
    #[getter]
    fn gyration_radius(&self) -> f64 {
        self.0.disk().gyration_radius()
    }

    /// Coefficient of friction mu.
    #[getter]
    fn friction(&self) -> f64 {
        self.0.disk().friction()
    }

    /// Coefficient of restitution.
    #[getter]
    fn restitution(&self) -> f64 {
        self.0.disk().restitution()
    }

    /// Preload acceleration g (m/s^2).
    #[getter]
    fn preload_acceleration(&self) -> f64 {
        self.0.disk().preload_acceleration()
    }

    /// Angular deceleration by the load (rad/s^2).
    #[getter]
    fn load_acceleration(&self) -> f64 {
        self.0.disk().load_acceleration()
    }

    /// Axial forcing parameter Gamma = A omega^2/(pi g).
    #[getter]
    fn axial_forcing(&self) -> f64 {
        self.0.axial_forcing()
    }

    /// Angular forcing parameter Gamma_T = a_g^2 Phi omega^2/(a_e pi g mu); None without friction.
    #[getter]
    fn angular_forcing(&self) -> Option<f64> {
        self.0.angular_forcing()
    }

    /// Peak acceleration A omega^2/g of the platform in units of the preload acceleration.
    #[getter]
    fn peak_acceleration(&self) -> f64 {
        self.0.peak_acceleration()
    }

    /// Time (s) in which friction that pushes one way gives the disk the platform's largest angular speed.
    #[getter]
    fn rise_time(&self) -> f64 {
        self.0.rise_time()
    }

    /// The parameters as a dictionary of two, as the Rust library stores them.
    ///
    /// Returns
    /// -------
    /// dict
    ///     ``{"platform": {...}, "disk": {...}}``, each of numbers by the names of the arguments.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        system_dict::to(py, self.numbers())
    }

    /// The system of such a dictionary.
    ///
    /// Parameters
    /// ----------
    /// parameters : dict
    ///     As of :meth:`to_dict`.
    ///
    /// Returns
    /// -------
    /// System
    #[staticmethod]
    fn from_dict(py: Python<'_>, parameters: &Bound<'_, PyDict>) -> PyResult<Self> {
        build(py, system_dict::parts(parameters)?, &OF_PARTS)
    }

    /// The parameters as JSON, which the Rust library reads as well.
    ///
    /// Returns
    /// -------
    /// str
    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        text::to_json(&self.to_dict(py)?)
    }

    /// The system of such a text.
    ///
    /// Parameters
    /// ----------
    /// json : str
    ///     As of :meth:`to_json`.
    ///
    /// Returns
    /// -------
    /// System
    #[staticmethod]
    fn from_json(py: Python<'_>, json: Json) -> PyResult<Self> {
        build(py, json.read(py)?, &OF_PARTS)
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<((), Bound<'py, PyDict>)> {
        Ok(((), self.arguments(py)?))
    }

    fn __hash__(&self) -> u64 {
        text::hash(&self.numbers())
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        text::call("System", &self.arguments(py)?)
    }
}
