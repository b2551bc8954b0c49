//! The contents of the classes of parameters, and their derived numbers: systems, motors, maps, cuts.

use std::f64::consts::TAU;

use bouncing_disk::core::{ChatterCut as Cut, ChatterPolicy, ImpactMap, ImpactState, Phase, Vibration};
use bouncing_disk::motion::PAPER_CUT;
use bouncing_disk::motor::{MotorField, MotorParameters};
use bouncing_disk::parameters::{Contact, DimensionlessSystem, DriveParameters, StatorParameters, Waveform};
use bouncing_disk::{DiskParameters, Error, Motor as MotorModel, PlatformParameters, System as SystemModel};
use numpy::PyArray2;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};

use crate::arguments::{Arguments, Count, Made, Place, Real, extracted, held, plain};
use crate::results::{matrix, stored};
use crate::{errors, long_call};

/// The contents of a `System`. Its numbers are made when Python asks for the first one.
#[pyclass(frozen, module = "bouncing_disk._native")]
pub(crate) struct System(pub(crate) SystemModel);

#[pymethods]
impl System {
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (platform, stroke) = (self.0.platform(), self.0.stroke());
        let given = named(numbers_of(&self.0));
        let derived = [
            ("period", Some(TAU / platform.angular_frequency())),
            ("peak_angular_speed", Some(platform.peak_angular_speed())),
            ("stroke", Some(stroke.stroke)),
            ("amplitude_angle", Some(stroke.amplitude_angle)),
            ("axial_forcing", Some(self.0.axial_forcing())),
            ("angular_forcing", self.0.angular_forcing()),
            ("peak_acceleration", Some(self.0.peak_acceleration())),
            ("rise_time", Some(self.0.rise_time())),
        ];
        let all = given.map(|(name, number)| (name, Some(number))).into_iter().chain(derived);
        let given = given.into_py_dict(py)?;
        if let Some(contact) = self.0.contact() {
            given.set_item("contact", from_json(py, &stored(contact)?)?)?;
        }
        if let Some(stator) = self.0.stator() {
            given.set_item("stator", from_json(py, &stored(&stator.parameters())?)?)?;
        }
        numbers(py, given.into_any(), all)
    }

    /// The system with other values of some arguments.
    fn replaced(&self, changes: Arguments<'_>) -> PyResult<Self> {
        let mut numbers = numbers_of(&self.0);
        let mut tables = tables_of(&self.0);
        for name in changes.0.keys() {
            let name: String = name.extract()?;
            match (SYSTEM.iter().position(|known| *known == name), name.as_str()) {
                (Some(place), _) => numbers[place] = changes.real(&name)?,
                (None, "contact") => tables.0 = changes.table("contact")?,
                (None, "stator") => tables.1 = changes.table("stator")?,
                _ => return Err(PyTypeError::new_err(format!("System has no argument '{name}'"))),
            }
        }
        system_of(numbers, tables).map(Self).or_else(|error| {
            let call = named(numbers).into_py_dict(changes.py())?;
            call.update(changes.0.as_mapping())?;
            Err(errors::of_call(changes.py(), error, &call))
        })
    }
}

/// The contents of a `Motor`.
#[pyclass(frozen, module = "bouncing_disk._native")]
pub(crate) struct Motor(pub(crate) MotorModel);

#[pymethods]
impl Motor {
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (sheet, motor) = (self.0.parameters(), &self.0);
        let (platform, disk) = (motor.system().platform(), motor.system().disk());
        let all = [
            ("drive_frequency", Some(sheet.drive_frequency)),
            ("amplitude", Some(platform.amplitude())),
            ("peak_angular_speed", Some(platform.peak_angular_speed())),
            ("twist_amplitude", Some(platform.twist_amplitude())),
            ("phase_lag", Some(platform.phase_lag())),
            ("mass", Some(motor.mass())),
            ("inertia", Some(motor.inertia())),
            ("contact_radius", Some(disk.contact_radius())),
            ("gyration_radius", Some(disk.gyration_radius())),
            ("preload_force", Some(motor.preload_force())),
            ("preload_acceleration", Some(motor.preload_acceleration())),
            ("friction", Some(sheet.friction)),
            ("restitution", Some(sheet.restitution)),
            ("load_torque", Some(motor.load_torque())),
            ("largest_torque", Some(motor.largest_torque())),
            ("static_deflection", motor.static_deflection()),
        ];
        let all = numbers(py, from_json(py, &self.0.to_json())?, all)?;
        all.set_item("system", python_system(py, motor.system())?)?;
        Ok(all)
    }

    fn to_json(&self) -> String {
        self.0.to_json()
    }
}

/// The contents of a `ChatterCut`.
#[pyclass(frozen, module = "bouncing_disk._native")]
pub(crate) struct ChatterCut(pub(crate) Cut);

#[pymethods]
impl ChatterCut {
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        all.set_item("smallest_speed", self.0.smallest_speed())?;
        all.set_item("short_flight", self.0.short_flight())?;
        all.set_item("short_flights", self.0.short_flights())?;
        all.set_item("_given", all.copy()?)?;
        Ok(all)
    }
}

/// The contents of a `Drive`.
#[pyclass(frozen, module = "bouncing_disk._native")]
pub(crate) struct Drive(DriveParameters);

#[pymethods]
impl Drive {
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all: Bound<'_, PyDict> = from_json(py, &stored(&self.0)?)?.cast_into()?;
        all.set_item("_given", all.copy()?)?;
        Ok(all)
    }

    fn warnings(&self) -> Vec<String> {
        self.0.warnings().collect()
    }
}

/// The contents of an `ImpactMap`, and the axial forcing if it was given: one computed from the peak
/// acceleration may differ in the last place. Its steps are what loops in Python call themselves.
#[pyclass(frozen, name = "ImpactMap", module = "bouncing_disk._native")]
pub(crate) struct Map(pub(crate) ImpactMap, Option<f64>);

#[pymethods]
impl Map {
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let Self(map, forcing) = self;
        let (peak, restitution) = (map.vibration().peak_acceleration(), map.restitution());
        let given = forcing.map_or(("peak_acceleration", peak), |forcing| ("axial_forcing", forcing));
        let all = [
            ("axial_forcing", Some(forcing.unwrap_or_else(|| map.vibration().axial_forcing()))),
            ("peak_acceleration", Some(peak)),
            ("restitution", Some(restitution)),
            ("normalised_speed_bound", Some(map.impact_speed_bound() / std::f64::consts::PI)),
        ];
        numbers(py, [given, ("restitution", restitution)].into_py_dict(py)?.into_any(), all)
    }

    #[pyo3(signature = (*, impact_phase, axial_impact_velocity))]
    fn step(&self, py: Python<'_>, impact_phase: Real, axial_impact_velocity: Real) -> PyResult<(f64, f64)> {
        with_state(py, impact_phase, axial_impact_velocity, |state| Ok(pair(self.0.step(state)?.into())))
    }

    /// The derivative of the next impact.
    #[pyo3(signature = (*, impact_phase, axial_impact_velocity))]
    fn derivative<'py>(
        &self,
        py: Python<'py>,
        impact_phase: Real,
        axial_impact_velocity: Real,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let derivative = |state| Ok(self.0.step_with_derivative(state)?.1);
        let derivative = with_state(py, impact_phase, axial_impact_velocity, derivative)?;
        let (x, y) = (derivative.x_axis, derivative.y_axis);
        matrix(py, vec![x.x, y.x, x.y, y.y], [2, 2])
    }

    /// The orbit of one impact in closed form.
    #[pyo3(signature = (*, platform_periods=Count(Ok(1))))]
    fn period_one(&self, py: Python<'_>, platform_periods: Count) -> PyResult<Option<(f64, f64)>> {
        let periods = platform_periods.u64(py, "platform_periods")?;
        if periods == 0 {
            return Err(errors::out_of_range(py, "platform_periods", 0.0, "at least 1"));
        }
        Ok(long_call::caught(|| Ok(self.0.period_one(periods).map(pair)))?.unwrap_or(None))
    }
}

/// The dictionaries, lists and numbers of a text of the library's.
fn from_json<'py>(py: Python<'py>, json: &str) -> Made<'py> {
    py.import("json")?.call_method1("loads", (json,))
}

/// What becomes of an impact of these two numbers.
fn with_state<T>(
    py: Python<'_>,
    phase: Real,
    velocity: Real,
    work: impl FnOnce(ImpactState) -> Result<T, Error>,
) -> PyResult<T> {
    long_call::caught(|| work(state(phase.0, velocity.0)?))?.map_err(|error| {
        let call = [("impact_phase", phase.0), ("axial_impact_velocity", velocity.0)].into_py_dict(py);
        call.map_or_else(|failure| failure, |call| errors::of_call(py, error, &call))
    })
}

/// An impact of these two numbers.
pub(crate) fn state(impact_phase: f64, axial_impact_velocity: f64) -> Result<ImpactState, Error> {
    Ok(ImpactState::new(Phase::new(impact_phase)?, axial_impact_velocity)?)
}

/// The two numbers of an impact.
pub(crate) fn pair(state: ImpactState) -> (f64, f64) {
    (state.phase().angle(), state.velocity())
}

/// The numbers of an object by their names, with those that were given apart.
fn numbers<'py>(
    py: Python<'py>,
    given: Bound<'py, PyAny>,
    all: impl IntoIterator<Item = (&'static str, Option<f64>)>,
) -> PyResult<Bound<'py, PyDict>> {
    let numbers = PyDict::new(py);
    for (name, number) in all {
        numbers.set_item(name, number)?;
    }
    numbers.set_item("_given", given)?;
    Ok(numbers)
}

/// The arguments of a system.
const SYSTEM: [&str; 10] = [
    "amplitude",
    "twist_amplitude",
    "angular_frequency",
    "phase_lag",
    "contact_radius",
    "gyration_radius",
    "friction",
    "restitution",
    "preload_acceleration",
    "load_acceleration",
];

/// The parameters of a system in the order of its arguments.
fn numbers_of(system: &SystemModel) -> [f64; 10] {
    let (platform, disk) = (system.platform().parameters(), system.disk().parameters());
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

fn named(numbers: [f64; 10]) -> [(&'static str, f64); 10] {
    std::array::from_fn(|place| (SYSTEM[place], numbers[place]))
}

/// The tables that a system may have.
type Tables = (Option<Contact>, Option<StatorParameters>);

fn tables_of(system: &SystemModel) -> Tables {
    (system.contact().copied(), system.stator().map(|stator| stator.parameters()))
}

/// The system of these parameters.
fn system_of(numbers: [f64; 10], (contact, stator): Tables) -> Result<SystemModel, Error> {
    let [amplitude, twist_amplitude, angular_frequency, phase_lag, contact_radius, gyration_radius, ..] =
        numbers;
    let [.., friction, restitution, preload_acceleration, load_acceleration] = numbers;
    let platform = PlatformParameters { amplitude, twist_amplitude, angular_frequency, phase_lag };
    let disk = DiskParameters {
        contact_radius,
        gyration_radius,
        friction,
        restitution,
        preload_acceleration,
        load_acceleration,
    };
    SystemModel::new(platform.build()?, disk.build()?)?.with_contact(contact)?.with_stator(stator)
}

/// A system by its arguments.
#[pyfunction]
pub(crate) fn system(a: Arguments<'_>) -> PyResult<System> {
    let mut numbers = [0.0; 10];
    for (name, number) in SYSTEM.iter().zip(&mut numbers) {
        *number = a.real(name)?;
    }
    let tables = (a.table("contact")?, a.table("stator")?);
    system_of(numbers, tables).map(System).map_err(|error| a.refused(error))
}

/// The system that the library has made, as Python has it.
pub(crate) fn python_system<'py>(py: Python<'py>, system: &SystemModel) -> Made<'py> {
    py.import("bouncing_disk")?.getattr("System")?.call_method1("_holding", (System(*system),))
}

/// A system of the paper.
#[pyfunction]
pub(crate) fn known_system(name: &str) -> System {
    System(if name == "motor" { SystemModel::motor() } else { SystemModel::pizza_toss() })
}

/// A motor by its arguments.
#[pyfunction]
pub(crate) fn motor(a: Arguments<'_>) -> PyResult<Motor> {
    let sheet = MotorParameters {
        drive_frequency: a.real("drive_frequency")?,
        amplitude: a.optional("amplitude")?,
        peak_angular_speed: a.optional("peak_angular_speed")?,
        twist_amplitude: a.optional("twist_amplitude")?,
        phase_lag: a.real("phase_lag")?,
        mass: a.optional("mass")?,
        density: a.optional("density")?,
        rotor_radius: a.optional("rotor_radius")?,
        rotor_thickness: a.optional("rotor_thickness")?,
        contact_radius: a.real("contact_radius")?,
        gyration_radius: a.optional("gyration_radius")?,
        preload_force: a.optional("preload_force")?,
        preload_acceleration: a.optional("preload_acceleration")?,
        spring_constant: a.optional("spring_constant")?,
        friction: a.real("friction")?,
        restitution: a.real("restitution")?,
        load_torque: a.real("load_torque")?,
        contact: a.table("contact")?,
        stator: a.table("stator")?,
        load: a.table("load")?,
        drive: a.sheet_drive()?,
    };
    sheet.build().map(Motor).map_err(|error| a.refused(error))
}

/// A motor of the paper, or of the text of a data sheet.
#[pyfunction]
pub(crate) fn known_motor(py: Python<'_>, kind: &str, text: &str) -> PyResult<Motor> {
    let read = match kind {
        "toml" => MotorModel::from_toml(text),
        "json" => MotorModel::from_json(text),
        "184" => Ok(MotorModel::paper_184_khz()),
        _ => Ok(MotorModel::paper_70_khz()),
    };
    read.map(Motor).map_err(|error| errors::of_motor_file(py, &error))
}

/// The fields of a data sheet that exclude this one.
#[pyfunction]
pub(crate) fn excluded_by(name: &str) -> Vec<&'static str> {
    let field = name.parse::<MotorField>().ok();
    field.map_or_else(Vec::new, |field| field.excluded().iter().map(|other| other.name()).collect())
}

/// A map by its arguments, one of the two forcings missing. They come one by one, which takes half the time
/// of a dictionary.
#[pyfunction]
#[pyo3(signature = (axial_forcing, peak_acceleration, restitution))]
pub(crate) fn impact_map(
    py: Python<'_>,
    axial_forcing: &Bound<'_, PyAny>,
    peak_acceleration: &Bound<'_, PyAny>,
    restitution: &Bound<'_, PyAny>,
) -> PyResult<Map> {
    let (one, other) = ("axial_forcing", "peak_acceleration");
    let optional = |value, name| Ok::<_, PyErr>(extracted::<Option<Real>>(value, name)?.map(|real| real.0));
    let (forcing, peak) = (optional(axial_forcing, one)?, optional(peak_acceleration, other)?);
    let Real(restitution) = extracted(restitution, "restitution")?;
    let vibration = match (forcing, peak) {
        (Some(forcing), None) => Vibration::from_axial_forcing(forcing).map_err(Error::from),
        (None, Some(peak)) => Vibration::new(peak).map_err(Error::from),
        (None, None) => Err(Error::NeitherGiven { one, other }),
        (Some(_), Some(_)) => Err(Error::BothGiven { one, other }),
    };
    let map = vibration.and_then(|vibration| Ok(ImpactMap::new(vibration, restitution)?));
    map.map(|map| Map(map, forcing)).or_else(|error| {
        let given = [(one, forcing), (other, peak), ("restitution", Some(restitution))].into_py_dict(py)?;
        Err(Arguments(given).refused(error))
    })
}

/// The map that the library has made, as Python has it.
pub(crate) fn python_map<'py>(py: Python<'py>, map: &ImpactMap) -> Made<'py> {
    py.import("bouncing_disk")?.getattr("ImpactMap")?.call_method1("_holding", (Map(*map, None),))
}

/// A cut by its arguments.
#[pyfunction]
pub(crate) fn chatter_cut(a: Arguments<'_>) -> PyResult<ChatterCut> {
    let flights = a.count("short_flights", u32::MAX.into(), "[1, 4294967295]")? as u32;
    let cut = Cut::new(a.real("smallest_speed")?, a.real("short_flight")?, flights);
    cut.map(ChatterCut).map_err(|error| a.refused(error))
}

/// The rule of the paper's simulations.
#[pyfunction]
pub(crate) fn paper_cut() -> ChatterCut {
    ChatterCut(PAPER_CUT)
}

/// A drive that an argument is; the sine if it is `None`.
pub(crate) fn held_drive(given: &Bound<'_, PyAny>, name: &str) -> PyResult<DriveParameters> {
    if given.is_none() {
        return Ok(DriveParameters::default());
    }
    held::<Drive>(given, name).map(|drive| drive.get().0.clone())
}

/// A drive by its arguments.
#[pyfunction]
pub(crate) fn drive(a: Arguments<'_>) -> PyResult<Drive> {
    let mut table = serde_json::Map::new();
    for name in ["height", "angle", "start_phase"] {
        let given = a.get(name)?;
        if !given.is_none() {
            table.insert(name.to_owned(), plain(&given, &Place::Argument(name))?);
        }
    }
    let drive: DriveParameters = a.read("drive", table.into())?;
    drive.check().map_err(|error| errors::of(a.py(), error))?;
    Ok(Drive(drive))
}

/// The objects of this module among the arguments of a call.
impl<'py> Arguments<'py> {
    /// A drive; the sine if it is not given.
    pub(crate) fn drive(&self, name: &str) -> PyResult<DriveParameters> {
        held_drive(&self.get(name)?, name)
    }

    /// The drive of a data sheet: an object, or its dictionary.
    fn sheet_drive(&self) -> PyResult<DriveParameters> {
        match held::<Drive>(&self.get("drive")?, "drive") {
            Ok(drive) => Ok(drive.get().0.clone()),
            Err(_) => Ok(self.table("drive")?.unwrap_or_default()),
        }
    }

    /// The shape of the height of `drive` and `contact_periods`, which decide the vertical motion; `None` for rigid
    /// impacts on the sine.
    pub(crate) fn shape(&self) -> PyResult<Option<(Waveform, Option<f64>)>> {
        let drive = self.drive("drive")?;
        if drive.start_phase.is_some() {
            return Err(self.refused(Error::StartPhase));
        }
        let contact_periods = self.optional("contact_periods")?;
        let is_rigid_sine = drive.height == Waveform::Sine && contact_periods.is_none();
        Ok((!is_rigid_sine).then_some((drive.height, contact_periods)))
    }

    /// The name of an argument; of a method that has none of it, the object itself.
    fn or_self(&self, name: &'static str) -> PyResult<&'static str> {
        Ok(if self.0.contains(name)? { name } else { "self" })
    }

    pub(crate) fn system(&self) -> PyResult<SystemModel> {
        Ok(self.held::<System>("system")?.get().0)
    }

    /// The system of what is computed for rigid impacts on a prescribed platform only.
    pub(crate) fn rigid_system(&self) -> PyResult<SystemModel> {
        let system = self.system()?;
        let rigid = DimensionlessSystem::try_from(&system);
        rigid.map(|_| system).map_err(|error| self.refused(error))
    }

    pub(crate) fn motor(&self) -> PyResult<MotorModel> {
        Ok(self.held::<Motor>("motor")?.get().0.clone())
    }

    /// The motor, whose drive and contact time the arguments of the call replace.
    pub(crate) fn moved(&self, motor: &MotorModel) -> PyResult<MotorModel> {
        let time = self.optional("contact_time")?;
        let drive = if self.0.contains("drive")? { self.given("drive")? } else { None };
        let drive = drive.map(|given| held_drive(&given, "drive")).transpose()?;
        let change = |sheet: &mut MotorParameters| {
            time.into_iter().for_each(|time| MotorField::ContactTime.set(sheet, time));
            if let Some(drive) = drive {
                sheet.drive = drive;
            }
        };
        motor.with(change).map_err(|error| self.refused(error))
    }

    pub(crate) fn map(&self) -> PyResult<ImpactMap> {
        Ok(self.held::<Map>(self.or_self("impact_map")?)?.get().0)
    }

    /// The policy of the argument `chatter`.
    pub(crate) fn policy(&self) -> PyResult<ChatterPolicy> {
        Ok(match self.given("chatter")? {
            None => ChatterPolicy::Complete,
            Some(cut) => ChatterPolicy::Cut(held::<ChatterCut>(&cut, "chatter")?.get().0),
        })
    }
}
