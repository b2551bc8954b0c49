//! The contents of the classes of parameters, and their derived numbers: systems, motors, maps, cuts.

use std::f64::consts::{PI, TAU};

use bouncing_disk::core::{
    BouncingMap, ChatterCut as Cut, ChatterPolicy, ImpactMap, ImpactState, Phase, Vibration,
};
use bouncing_disk::drives::{DrivenFamily, DrivenMap};
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

/// The contents of a `System`. Its numbers are computed when Python first asks for one.
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

/// The contents of an `ImpactMap`. Loops in Python call its steps directly.
#[pyclass(frozen, name = "ImpactMap", module = "bouncing_disk._native")]
pub(crate) struct Map {
    /// The map of rigid impacts on the sine, with this forcing and restitution.
    pub(crate) sine: ImpactMap,
    /// The axial forcing if given: computed from the peak acceleration it may differ in the last place.
    forcing: Option<f64>,
    /// The map itself if it is on another platform.
    pub(crate) other: Option<Box<(DrivenMap, Platform)>>,
}

/// A call with the map of rigid impacts on the sine, or with the one on another platform.
macro_rules! on_map {
    ($of:expr, |$map:ident| $call:expr) => {
        match $of.other.as_deref() {
            None => {
                let $map = &$of.sine;
                $call
            }
            Some(($map, _)) => $call,
        }
    };
}
pub(crate) use on_map;

/// A platform with another drive than the sine, or with compliant contacts.
pub(crate) struct Platform {
    drive: Option<DriveParameters>,
    contact_periods: Option<f64>,
}

impl Platform {
    /// `None` for rigid impacts on the sine.
    fn new(drive: Option<DriveParameters>, contact_periods: Option<f64>) -> Result<Option<Self>, Error> {
        if let Some(drive) = &drive {
            drive.check()?;
            drive.start_phase.map_or(Ok(()), |_| Err(Error::StartPhase))?;
        }
        let own = Self { drive, contact_periods };
        Ok((contact_periods.is_some() || own.height().sine().is_err()).then_some(own))
    }

    fn height(&self) -> &Waveform {
        self.drive.as_ref().map_or(&Waveform::Sine, |drive| &drive.height)
    }

    pub(crate) fn map(&self, sine: &ImpactMap) -> Result<DrivenMap, Error> {
        self.height().map(sine, self.contact_periods)
    }

    /// The maps that differ in the number of this name.
    pub(crate) fn family(&self, sine: &ImpactMap, number: &str) -> Result<DrivenFamily, Error> {
        self.height().family(sine, self.contact_periods, number.parse()?)
    }

    /// The maps that differ in the numbers of these names.
    pub(crate) fn family_of_two(&self, sine: &ImpactMap, numbers: [&str; 2]) -> Result<DrivenFamily, Error> {
        let [first, second] = numbers;
        self.height().family_of_two(sine, self.contact_periods, [first.parse()?, second.parse()?])
    }
}

impl Map {
    /// The map for calls that need rigid impacts on the sine.
    pub(crate) fn rigid_sine(&self, py: Python<'_>) -> PyResult<&ImpactMap> {
        let Some((_, platform)) = self.other.as_deref() else { return Ok(&self.sine) };
        let refused = platform.height().sine().err();
        let argument = if refused.is_some() { "drive" } else { "contact_periods" };
        let message = format!(
            "this holds only for rigid impacts on the sine, but the map has {argument}=; use a map without it"
        );
        Err(errors::of_kind(py, message, &refused.unwrap_or(Error::SoftContact)))
    }
}

#[pymethods]
impl Map {
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (peak, restitution) = (self.sine.vibration().peak_acceleration(), self.sine.restitution());
        let given = self.forcing.map_or(("peak_acceleration", peak), |forcing| ("axial_forcing", forcing));
        let given = [given, ("restitution", restitution)].into_py_dict(py)?;
        let platform = self.other.as_ref().map(|other| &other.1);
        let contact = platform.and_then(|own| own.contact_periods);
        let drive = platform.and_then(|own| own.drive.clone()).map(|own| python(py, "Drive", Drive(own)));
        let drive = drive.transpose()?;
        // No bound is known for a compliant contact.
        let unknown = contact.map(|_| f64::NAN);
        let bound = unknown.unwrap_or_else(|| on_map!(self, |map| map.impact_speed_bound() / PI));
        let all = [
            ("axial_forcing", Some(self.forcing.unwrap_or_else(|| self.sine.vibration().axial_forcing()))),
            ("peak_acceleration", Some(peak)),
            ("restitution", Some(restitution)),
            ("contact_periods", contact),
            ("normalised_speed_bound", Some(bound)),
        ];
        let all = numbers(py, given.clone().into_any(), all)?;
        all.set_item("drive", &drive)?;
        drive.map_or(Ok(()), |own| given.set_item("drive", own))?;
        contact.map_or(Ok(()), |own| given.set_item("contact_periods", own))?;
        Ok(all)
    }

    #[pyo3(signature = (*, impact_phase, axial_impact_velocity))]
    fn step(&self, py: Python<'_>, impact_phase: Real, axial_impact_velocity: Real) -> PyResult<(f64, f64)> {
        let step = |state| Ok(pair(on_map!(self, |map| BouncingMap::step(map, state)?).into()));
        with_state(py, impact_phase, axial_impact_velocity, step)
    }

    /// The derivative of the next impact.
    #[pyo3(signature = (*, impact_phase, axial_impact_velocity))]
    fn derivative<'py>(
        &self,
        py: Python<'py>,
        impact_phase: Real,
        axial_impact_velocity: Real,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let derivative = |state| Ok(on_map!(self, |map| map.step_with_derivative(state)?.1));
        let derivative = with_state(py, impact_phase, axial_impact_velocity, derivative)?;
        let (x, y) = (derivative.x_axis, derivative.y_axis);
        matrix(py, vec![x.x, y.x, x.y, y.y], [2, 2])
    }

    /// The orbit of one impact in closed form.
    #[pyo3(signature = (*, platform_periods=Count(Ok(1))))]
    fn period_one(&self, py: Python<'_>, platform_periods: Count) -> PyResult<Option<(f64, f64)>> {
        let (map, periods) = (self.rigid_sine(py)?, platform_periods.u64(py, "platform_periods")?);
        if periods == 0 {
            return Err(errors::out_of_range(py, "platform_periods", 0.0, "at least 1"));
        }
        Ok(long_call::caught(|| Ok(map.period_one(periods).map(pair)))?.unwrap_or(None))
    }
}

/// The dictionaries, lists and numbers of a text from the library.
fn from_json<'py>(py: Python<'py>, json: &str) -> Made<'py> {
    py.import("json")?.call_method1("loads", (json,))
}

/// The result for an impact of these two numbers.
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

/// The numbers of an object by name, the given ones separately.
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

/// The object of this class that holds an object of the library.
fn python<'py>(py: Python<'py>, class: &str, held: impl IntoPyObject<'py>) -> Made<'py> {
    py.import("bouncing_disk")?.getattr(class)?.call_method1("_holding", (held,))
}

/// A system of the library as Python's object.
pub(crate) fn python_system<'py>(py: Python<'py>, system: &SystemModel) -> Made<'py> {
    python(py, "System", System(*system))
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
        drive: drive_of(&a.get("drive")?)?.unwrap_or_default(),
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

/// A map from its arguments; one of the two forcings is missing. The arguments are passed one by one, which takes
/// half the time of a dictionary; the last two are passed only if one of them is given.
#[pyfunction]
#[pyo3(signature = (axial_forcing, peak_acceleration, restitution, drive=None, contact_periods=None))]
pub(crate) fn impact_map<'py>(
    py: Python<'py>,
    axial_forcing: &Bound<'py, PyAny>,
    peak_acceleration: &Bound<'py, PyAny>,
    restitution: &Bound<'py, PyAny>,
    drive: Option<&Bound<'py, PyAny>>,
    contact_periods: Option<&Bound<'py, PyAny>>,
) -> PyResult<Map> {
    let (one, other, contact) = ("axial_forcing", "peak_acceleration", "contact_periods");
    let optional = |value, name| Ok::<_, PyErr>(extracted::<Option<Real>>(value, name)?.map(|real| real.0));
    let (forcing, peak) = (optional(axial_forcing, one)?, optional(peak_acceleration, other)?);
    let Real(restitution) = extracted(restitution, "restitution")?;
    let periods =
        contact_periods.map(|given| extracted::<Real>(given, contact)).transpose()?.map(|real| real.0);
    // For the sine, which loops make, no shape is moved.
    let is_sine = drive.is_none() && periods.is_none();
    let drive = drive.map(drive_of).transpose()?.flatten().map(Box::new);
    let sine = || {
        let vibration = match (forcing, peak) {
            (Some(forcing), None) => Vibration::from_axial_forcing(forcing)?,
            (None, Some(peak)) => Vibration::new(peak)?,
            (None, None) => return Err(Error::NeitherGiven { one, other }),
            (Some(_), Some(_)) => return Err(Error::BothGiven { one, other }),
        };
        Ok(ImpactMap::new(vibration, restitution)?)
    };
    let platform = |sine: &ImpactMap| {
        let platform = Platform::new(drive.map(|own| *own), periods)?;
        platform.map(|own| Ok(Box::new((own.map(sine)?, own)))).transpose()
    };
    let refused = |error: Error| {
        let given = [(one, forcing), (other, peak), ("restitution", Some(restitution)), (contact, periods)];
        given.into_py_dict(py).map_or_else(|failure| failure, |given| Arguments(given).refused(error))
    };
    let sine = sine().map_err(refused)?;
    let other = if is_sine { None } else { platform(&sine).map_err(refused)? };
    Ok(Map { sine, forcing, other })
}

/// The map of the vertical motion of a system.
#[pyfunction]
pub(crate) fn map_of_system(a: Arguments<'_>) -> Made<'_> {
    let system = DimensionlessSystem::try_from(&a.system()?).map_err(|error| a.refused(error))?;
    python_map(a.py(), system.map())
}

/// A map of the sine from the library as Python's object.
pub(crate) fn python_map<'py>(py: Python<'py>, map: &ImpactMap) -> Made<'py> {
    python(py, "ImpactMap", Map { sine: *map, forcing: None, other: None })
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

/// The drive of the argument `drive`, an object or its dictionary.
pub(crate) fn drive_of(given: &Bound<'_, PyAny>) -> PyResult<Option<DriveParameters>> {
    if given.is_none() {
        return Ok(None);
    }
    match held::<Drive>(given, "drive") {
        Ok(drive) => Ok(Some(drive.get().0.clone())),
        Err(_) => Arguments([("drive", given)].into_py_dict(given.py())?).table("drive"),
    }
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
    /// The platform of `drive` and `contact_periods`; `None` for rigid impacts on the sine.
    pub(crate) fn platform(&self) -> PyResult<Option<Platform>> {
        let platform = Platform::new(drive_of(&self.get("drive")?)?, self.optional("contact_periods")?);
        platform.map_err(|error| self.refused(error))
    }

    pub(crate) fn system(&self) -> PyResult<SystemModel> {
        Ok(self.held::<System>("system")?.get().0)
    }

    /// The system for calls that need rigid impacts on a prescribed platform.
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
        let drive = if self.0.contains("drive")? { drive_of(&self.get("drive")?)? } else { None };
        let change = |sheet: &mut MotorParameters| {
            time.into_iter().for_each(|time| MotorField::ContactTime.set(sheet, time));
            if let Some(drive) = drive {
                sheet.drive = drive;
            }
        };
        motor.with(change).map_err(|error| self.refused(error))
    }

    /// The map of a function, or of a method of the map.
    pub(crate) fn map(&self) -> PyResult<Bound<'py, Map>> {
        self.held(if self.0.contains("impact_map")? { "impact_map" } else { "self" })
    }

    /// The policy of the argument `chatter`.
    pub(crate) fn policy(&self) -> PyResult<ChatterPolicy> {
        Ok(match self.given("chatter")? {
            None => ChatterPolicy::Complete,
            Some(cut) => ChatterPolicy::Cut(held::<ChatterCut>(&cut, "chatter")?.get().0),
        })
    }
}
