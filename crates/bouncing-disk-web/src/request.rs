//! Requests. Numbers are SI and angles are radians, unless a name says otherwise: phases of pictures are in
//! periods of the platform, and the speeds of impacts are normalised by the amplitude of the platform's
//! velocity, |w_A| Gamma/(A omega), as in Fig. 7 of the paper. A range goes from a low to a high number.

use std::f64::consts::{PI, TAU};

use bouncing_disk::core::{ImpactMap, ImpactState, Vibration};
use bouncing_disk::drives::compliance::Compliance;
use bouncing_disk::motor::MotorParameters;
use bouncing_disk::parameters::{Contact, StatorParameters, Waveform};
use bouncing_disk::{DiskParameters, PlatformParameters, System};
use serde::{Deserialize, Serialize};

use crate::reply::Refusal;

/// Platform and disk in SI units, in one flat table, with the time of a contact with a damper; 0 is rigid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SystemParameters {
    #[serde(flatten)]
    platform: PlatformParameters,
    #[serde(flatten)]
    disk: DiskParameters,
    #[serde(default)]
    pub(crate) contact_time: f64,
    /// What is set to a value, one after the other: a quantity that follows from the parameters, or one of them.
    #[serde(default, skip_serializing)]
    set: Vec<(String, f64)>,
}

impl SystemParameters {
    pub(crate) fn build(&self) -> Result<System, Refusal> {
        let time = Some(self.contact_time).filter(|time| *time != 0.0);
        let contact = time.map(|_| Contact { time, ..Contact::default() });
        let system = System::new(self.platform.build()?, self.disk.build()?)?.with_contact(contact)?;
        self.set.iter().try_fold(system, |system, (name, value)| set(&system, name, *value))
    }
}

/// The same system with another value of a quantity or parameter.
fn set(system: &System, name: &str, value: f64) -> Result<System, Refusal> {
    let stroke = system.stroke();
    Ok(match name {
        "axial_forcing" => system.with_axial_forcing(value)?,
        "stroke" => system.with_stroke(value, stroke.amplitude_angle)?,
        "amplitude_angle" => system.with_stroke(stroke.stroke, value)?,
        "contact_periods" => {
            let most = 10.0 * (Compliance::CONTACT_TIMES[1] / TAU / 10.0).floor();
            if !(0.0..=most).contains(&value) {
                return Err(Refusal::out_of_range("contact_periods", value, "[0, 1590]"));
            }
            let time = value * TAU / system.platform().angular_frequency();
            return set(system, "contact_time", time);
        }
        _ => {
            let parameters = SystemParameters::from(system);
            let table = serde_json::to_value(parameters).and_then(|mut table| {
                table[name] = value.into();
                serde_json::from_value::<SystemParameters>(table)
            });
            table.map_err(|error| Refusal::of_request(&error))?.build()?
        }
    })
}

impl From<&System> for SystemParameters {
    fn from(system: &System) -> Self {
        let contact_time = system.contact().and_then(|contact| contact.time).unwrap_or(0.0);
        let (platform, disk) = (system.platform().parameters(), system.disk().parameters());
        Self { platform, disk, contact_time, set: Vec::new() }
    }
}

/// The map of the vertical motion: that of a system, or of these two numbers.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged)]
pub(crate) enum MapParameters {
    OfSystem(SystemParameters),
    OfForcing { axial_forcing: f64, restitution: f64 },
}

impl MapParameters {
    /// Compliant contacts are errors, unless the time is too short to matter ([`System::soft_contact`]).
    pub(crate) fn build(&self) -> Result<ImpactMap, Refusal> {
        match self {
            Self::OfSystem(system) => {
                let system = system.build()?;
                if system.soft_contact().is_none() {
                    return map(forcing_of(&system), system.disk().restitution());
                }
                let message =
                    "verdicts and basins are computed for rigid impacts only: set the contact time to 0";
                Err(Refusal::new("computation", message.to_owned()))
            }
            Self::OfForcing { axial_forcing, restitution } => map(*axial_forcing, *restitution),
        }
    }
}

/// An impact: its phase (rad) and its normalised speed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ImpactStart {
    pub(crate) impact_phase: f64,
    pub(crate) normalised_speed: f64,
}

impl ImpactStart {
    pub(crate) fn state(self) -> Result<ImpactState, Refusal> {
        Ok(ImpactState::from_normalised(self.impact_phase, self.normalised_speed)?)
    }
}

impl From<&ImpactState> for ImpactStart {
    fn from(state: &ImpactState) -> Self {
        Self { impact_phase: state.phase().angle(), normalised_speed: state.normalised_speed() }
    }
}

/// How a motion begins; SI.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum MotionStart {
    Impact { impact_phase: f64, normalised_speed: f64, angular_speed: f64 },
    Flight { phase: f64, angular_speed: f64, gap: f64, relative_velocity: f64 },
}

/// A request of the page.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "call", rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum Request {
    // Checks parameters, and states all of them with their derived quantities.
    Check { system: SystemParameters, mass: f64 },
    Motion { system: SystemParameters, start: MotionStart, periods: u64, samples_per_period: u64 },
    // The single toss of a disk that rests on the platform at its lowest point.
    Toss { system: SystemParameters },
    Diagram(DiagramRequest),
    // The long-term motion of the orbit from a start.
    Orbit { map: MapParameters, start: ImpactStart },
    // The branches of one impact every few periods in a range, stable and unstable, with their doublings.
    Branches { restitution: f64, axial_forcing: [f64; 2] },
    // All attractors of a map with the shares of the starts that end on them.
    Attractors { map: MapParameters },
    Basins(BasinsRequest),
    // The report of a data sheet before anything turns.
    MotorReport { sheet: MotorParameters },
    MotorTransient(TransientRequest),
    MotorLoads(LoadsRequest),
    MotorStall { sheet: MotorParameters, relative_error: f64, seed: u64 },
    SheetRead { text: String },
    SheetOfSystem { system: SystemParameters, mass: f64, stator: Option<StatorParameters> },
}

/// The columns `[from, to)` of an orbit diagram of `count` forcings. Angular speeds follow from the angular
/// forcing, the phase lag and the load of the system, of which only the amplitude is taken from the column.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DiagramRequest {
    pub(crate) system: SystemParameters,
    pub(crate) axial_forcing: [f64; 2],
    pub(crate) count: usize,
    pub(crate) columns: [usize; 2],
    pub(crate) start: ImpactStart,
    pub(crate) transient: usize,
    pub(crate) recorded: usize,
    /// Largest number of impacts that are discarded from an orbit that has not settled after `transient`
    /// ones.
    #[serde(default)]
    pub(crate) patience: usize,
    /// Whether the rotation is computed, too: it costs some times the vertical motion.
    #[serde(default)]
    pub(crate) rotation: bool,
    /// The shape of the platform's height; the rotation is computed for the sine.
    #[serde(default)]
    pub(crate) drive: Waveform,
}

/// The rows `[from, to)` of a grid of starts.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BasinsRequest {
    pub(crate) map: MapParameters,
    pub(crate) phase_periods: [f64; 2],
    pub(crate) phases: usize,
    pub(crate) normalised_speed: [f64; 2],
    pub(crate) speeds: usize,
    pub(crate) rows: [usize; 2],
}

/// Run-ups of so many motors.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TransientRequest {
    pub(crate) sheet: MotorParameters,
    pub(crate) members: usize,
    pub(crate) rise_times: f64,
    pub(crate) points: usize,
    pub(crate) seed: u64,
}

/// The steady operation of a motor under loads (N m).
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct LoadsRequest {
    pub(crate) sheet: MotorParameters,
    pub(crate) load_torques: Vec<f64>,
    pub(crate) relative_error: f64,
    /// Largest number of impacts that the answer may take, up to 20 million.
    pub(crate) most_impacts: u64,
    pub(crate) seed: u64,
}

/// The axial forcing, by operations whose order mostly gives one that was set back to the bit.
pub(crate) fn forcing_of(system: &System) -> f64 {
    let omega = system.platform().angular_frequency();
    system.platform().amplitude() * (omega * omega) / (PI * system.disk().preload_acceleration())
}

pub(crate) fn map(axial_forcing: f64, restitution: f64) -> Result<ImpactMap, Refusal> {
    Ok(ImpactMap::new(Vibration::from_axial_forcing(axial_forcing)?, restitution)?)
}
