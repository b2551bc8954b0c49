//! The dimensionless vertical motion: its forcing, its restitution and its initial impact.

use std::f64::consts::TAU;
use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use bouncing_disk::System;
use bouncing_disk::core::{Error, ImpactMap, ImpactState, Phase, Vibration};
use bouncing_disk::drives::DrivenMap;
use bouncing_disk::parameters::{DimensionlessSystem, DrivenPlatform, Waveform};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::prelude::*;
use crate::range::number;

/// Heading of forcing and restitution in the help.
pub(super) const VERTICAL: &str = "Vertical motion (no units)";

/// The restitution, and the system from which it and the forcing are taken unless given. The forcing is an
/// option of each command, whose help states its default.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = VERTICAL)]
pub(super) struct MapArgs {
    /// Coefficient of restitution, in [0, 1); with `verdicts` a range, too. Taken from FILE, --preset or --set
    /// unless given, else 0.5
    #[arg(long, short, value_name = "EPSILON", allow_hyphen_values = true)]
    restitution: Option<Range>,
    #[command(flatten)]
    system: SystemArgs,
}

impl MapArgs {
    /// The system, whose impacts are rigid, and the shape of its height, which alone determines the motion; `None` if
    /// the template was requested.
    pub(super) fn begin(
        &self,
        output: &OutputArgs,
        grid: Option<&GridArgs>,
        context: Context,
    ) -> Result<Option<(System, Waveform)>> {
        let Some(DrivenDisk { system, drive }) = self.system.begin(output, true, grid, context)? else {
            return Ok(None);
        };
        DimensionlessSystem::try_from(system)?;
        Ok(Some((system, DrivenPlatform::of_drive(*system.platform(), &drive)?.height().clone())))
    }

    /// Forcings and restitutions: as given, else from the system if one was given, else `otherwise` and the
    /// restitution of the toss.
    pub(super) fn values(&self, system: &System, given: Option<Range>, otherwise: Range) -> (Range, Range) {
        let own = if self.system.is_given() { Range::single(system.axial_forcing()) } else { otherwise };
        let restitution = Range::single(system.disk().restitution());
        (given.unwrap_or(own), self.restitution.unwrap_or(restitution))
    }

    /// The same if each is a single number.
    pub(super) fn pair(&self, system: &System, given: Option<Range>, otherwise: f64) -> Result<(f64, f64)> {
        let (forcings, restitutions) = self.values(system, given, Range::single(otherwise));
        Ok((single(forcings, "--axial-forcing")?, single(restitutions, "--restitution")?))
    }
}

/// A compliant contact, for the commands that support it.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = VERTICAL)]
pub(super) struct ContactArgs {
    /// Duration of an isolated impact in periods of the platform, in [1e-6, 1000]: a spring and damper with
    /// the restitution above replace rigid impacts. A release at speed v is shown as the equivalent rigid
    /// impact: the same phase, and the speed v/EPSILON
    #[arg(long, value_name = "PERIODS", allow_negative_numbers = true)]
    pub(super) contact_periods: Option<f64>,
}

pub(super) fn single(range: Range, option: &str) -> Result<f64> {
    let several = || Failure::Usage(format!("{option} {range}: this command needs a single number"));
    range.only().ok_or_else(several)
}

pub(super) fn map(axial_forcing: f64, restitution: f64) -> Result<ImpactMap, Error> {
    ImpactMap::new(Vibration::from_axial_forcing(axial_forcing)?, restitution)
}

/// The map of a platform whose height is not a sine, or with a contact time (periods).
pub(super) fn driven_map(
    shape: &Waveform,
    contact_periods: Option<f64>,
    axial_forcing: f64,
    restitution: f64,
) -> Result<DrivenMap> {
    Ok(shape.map(&map(axial_forcing, restitution)?, contact_periods)?)
}

/// A field of a job that is omitted for a sine.
pub(super) fn is_sine(shape: &Waveform) -> bool {
    *shape == Waveform::Sine
}

/// The paper's platform, whose map has closed forms.
pub(super) fn is_rigid_sine(shape: &Waveform, contact_periods: Option<f64>) -> bool {
    is_sine(shape) && contact_periods.is_none()
}

/// The end of a line on the vertical motion with another shape or contact.
pub(super) fn and_shape(shape: &Waveform, contact_periods: Option<f64>) -> String {
    let shape = if is_sine(shape) { String::new() } else { format!(", {shape}") };
    shape + &contact_periods.map_or_else(String::new, |periods| format!(", contact time {periods} periods"))
}

/// The parameters of a job, with shape and contact if they are not the paper's.
pub(super) fn with_shape(mut job: Value, shape: &Waveform, contact_periods: Option<f64>) -> Value {
    if !is_sine(shape) {
        job["drive"] = json!(shape);
    }
    if let Some(periods) = contact_periods {
        job["contact_periods"] = json!(periods);
    }
    job
}

pub(super) const NO_PERIOD_ONE: &str =
    "--start period-1 exists only for rigid impacts on the sine; give rest, rise or PHASE,SPEED";

/// Distance of a start from the period-1 orbit, relative to its speed: if the orbit is unstable, the
/// disk leaves it at once.
const BESIDE: f64 = 1.01;

/// A start, which every map converts to its own impact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub(crate) enum Start {
    /// At rest on the platform when it rises fastest.
    Rest,
    /// An impact when the platform rises fastest, with the speed of the period-1 orbit.
    Rise,
    /// One per cent faster than the impact of the period-1 orbit; it does not exist below the birth of the orbit.
    PeriodOne,
    /// Impact phase in periods, and normalised impact speed.
    At(f64, f64),
}

/// The possible starts, for the help.
pub(crate) const STARTS: &str = "`rest`, at rest on the platform when it rises fastest; `rise`, an impact at the \
                                 same phase with the speed of the period-1 orbit; `period-1`, 1 % faster than the \
                                 impact of the period-1 orbit, if that orbit exists; or PHASE,SPEED, the impact \
                                 phase in periods (tau/2pi) and the normalised impact speed |w_A Gamma/(omega A)|";

impl Start {
    /// The impact for a map, on a platform that rises fastest at the phase `rise` (0 for the sine); `None` if the
    /// map has no such start.
    pub(crate) fn of(self, map: &ImpactMap, rise: f64) -> Result<Option<ImpactState>, Error> {
        match self {
            // A platform that falls away at once, as at a joint of parabolas, launches the disk.
            Self::Rest => ImpactState::new(Phase::new(rise)?, 0.0).map(Some),
            Self::Rise => ImpactState::new(Phase::new(rise)?, -map.period_one_impact_speed(1)).map(Some),
            Self::PeriodOne => map
                .period_one(1)
                .map(|orbit| ImpactState::new(orbit.phase(), BESIDE * orbit.velocity()))
                .transpose(),
            Self::At(phase, speed) => ImpactState::from_normalised(TAU * phase, speed).map(Some),
        }
    }

    /// The start of an orbit, for a legend.
    pub(crate) fn in_words(&self) -> String {
        match self {
            Self::Rest => "from rest".to_owned(),
            Self::Rise => "from a rise".to_owned(),
            Self::PeriodOne => "from the period-1 orbit".to_owned(),
            Self::At(phase, speed) => format!("from {phase}, {speed}"),
        }
    }
}

impl FromStr for Start {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let named = [Self::Rest, Self::Rise, Self::PeriodOne].into_iter().find(|own| own.to_string() == text);
        if let Some(named) = named {
            return Ok(named);
        }
        let form = || format!("{text:?} is not a start; give rest, rise, period-1 or PHASE,SPEED");
        let (phase, speed) = text.split_once(',').ok_or_else(form)?;
        let (phase, speed) = (number(phase)?, number(speed)?);
        ImpactState::from_normalised(TAU * phase, speed).map_err(|error| error.to_string())?;
        Ok(Self::At(phase, speed))
    }
}

impl Display for Start {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rest => f.write_str("rest"),
            Self::Rise => f.write_str("rise"),
            Self::PeriodOne => f.write_str("period-1"),
            Self::At(phase, speed) => write!(f, "{phase},{speed}"),
        }
    }
}

impl TryFrom<String> for Start {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<Start> for String {
    fn from(start: Start) -> Self {
        start.to_string()
    }
}

#[cfg(test)]
mod tests {
    use bouncing_disk::core::{ChatterPolicy, OrbitEvent};

    use super::*;

    #[test]
    fn starts_are_written_and_read() {
        for start in [Start::Rest, Start::Rise, Start::PeriodOne, Start::At(0.1, 1.0 / 3.0)] {
            assert_eq!(start.to_string().parse(), Ok(start));
            let stored = serde_json::to_string(&start).unwrap();
            assert_eq!(serde_json::from_str::<Start>(&stored).unwrap(), start);
        }
        for text in ["", "up", "1", "1,-1", "nan,1", "1,inf", "1,2,3"] {
            assert!(text.parse::<Start>().is_err(), "{text}");
        }
    }

    /// From the same height and speed of the platform, whenever its period begins, to the same impact.
    #[test]
    fn shifted_platforms_have_the_same_starts() {
        let shape = |phase: f64| Waveform::Fourier(vec![(1.0, phase)]);
        let first = |start: Start, shift: f64| {
            let driven = driven_map(&shape(shift), None, 0.5, 0.5).unwrap();
            let state = start.of(&map(0.5, 0.5).unwrap(), driven.drive().fastest_rise_phase());
            let state = state.unwrap().unwrap();
            let at = driven.drive().at(state.phase().angle());
            let next = driven.orbit(state, ChatterPolicy::Complete).find_map(|event| match event.unwrap() {
                OrbitEvent::Impact(landing) => Some(landing.velocity),
                _ => None,
            });
            [at.height, at.velocity, state.velocity(), next.unwrap()]
        };
        for start in [Start::Rest, Start::Rise] {
            let known = first(start, 0.0);
            for shift in [1.0, 0.5 * TAU, 134.0 / 360.0 * TAU, 5.0, TAU.next_down()] {
                let own = first(start, shift);
                let near = own.iter().zip(known).all(|(own, known)| (own - known).abs() < 1e-12);
                assert!(near, "{start} {shift}: {own:?} {known:?}");
            }
        }
    }

    #[test]
    fn below_its_birth_there_is_no_period_one_orbit() {
        let of = |forcing: f64| Start::PeriodOne.of(&map(forcing, 0.5).unwrap(), 0.0).unwrap();
        assert!(of(0.3).is_none() && of(0.4).is_some());
        assert!(Start::Rise.of(&map(0.0, 0.5).unwrap(), 0.0).unwrap().is_some());
    }
}
