//! The source of a tape: the vertical motion of a disk, on which friction does not act back.

use bouncing_disk_core::run::WorkCount;
use bouncing_disk_core::{ChatterPolicy, Phase};
use bouncing_disk_drives::Drive;

use super::Tape;
use super::engine::EngineTape;
use super::recurrence::Touch;
use super::rigid::RigidTape;
use super::tap::TapSolver;
use super::taps::TapTape;
use crate::driven::{DrivenEngine, DrivenStart, DrivenSystem};
use crate::error::Error;
use crate::motion::event::Motion;
use crate::motion::phase_time::PhaseTime;
use crate::motion::state::DiskState;
use crate::motor::stator::Stator;
use crate::parameters::dimensionless::{DimensionlessParameters, DimensionlessSystem};
use crate::stator::{StatorEngine, StatorState, StatorSystem};

/// The source from which a tape is recorded.
#[derive(Debug, Clone)]
pub(crate) enum Source {
    /// A sine with rigid impacts.
    Rigid(Box<RigidTape>),
    /// A sine with compliant contacts.
    Taps(Box<TapTape>),
    /// Waveforms.
    Driven(Box<EngineTape<DrivenEngine>>),
    /// A stator with a compliant height.
    Yielding(Box<EngineTape<StatorEngine>>),
}

impl Source {
    /// The source for a disk that lies on this stator at a phase, or is thrown up from it with a multiple of
    /// the platform's largest speed (not from a compliant stator). Friction must not act back on the height.
    pub(crate) fn new(
        stator: &Stator,
        system: &DimensionlessSystem,
        start: (Phase, Option<f64>),
        perturbation: (f64, u64),
    ) -> Result<Self, Error> {
        let phase = start.0;
        // Compliant contacts need no perturbation, as no rest merges all motions.
        let undisturbed = (0.0, perturbation.1);
        Ok(match stator {
            Stator::Sine => Self::Rigid(Box::new(RigidTape::new(system, start, perturbation)?)),
            Stator::Driven(own) => {
                let soft = own.system.compliance.is_some();
                Self::driven(&own.system, start, if soft { undisturbed } else { perturbation })?
            }
            Stator::Yielding(own) if own.yields() => {
                Self::yielding(own, phase, if own.takes_time() { undisturbed } else { perturbation })?
            }
            Stator::Yielding(own) => match own.contact_time() {
                None => Self::Rigid(Box::new(RigidTape::new(own.base(), start, perturbation)?)),
                Some(time) => Self::driven(&soft(own.base(), time)?, start, undisturbed)?,
            },
        })
    }

    /// The source for a disk on a stator that moves by waveforms, or with compliant contacts.
    pub(crate) fn driven(
        system: &DrivenSystem,
        (phase, thrown): (Phase, Option<f64>),
        perturbation: (f64, u64),
    ) -> Result<Self, Error> {
        let still = DrivenSystem { friction: 0.0, load: 0.0, angle: Drive::fourier(&[])?, ..system.clone() };
        let angular_speed = 0.0;
        // A platform at rest cannot throw.
        let start = match thrown.map(|share| share * system.height.bounds().speed) {
            Some(relative_speed) if relative_speed > 0.0 => {
                DrivenStart::Launch { phase, relative_speed, angular_speed }
            }
            _ => DrivenStart::Contact { phase, angular_speed },
        };
        Ok(Self::of_engine(DrivenEngine::new(still, start, ChatterPolicy::Complete)?, perturbation))
    }

    /// The source for a disk without friction, from its state in a prescribed motion.
    pub(crate) fn of_engine(engine: DrivenEngine, perturbation: (f64, u64)) -> Self {
        let compliance = engine.system().compliance.as_ref();
        let (takes_time, solver) = (compliance.is_some(), compliance.and_then(TapSolver::new));
        let engine = EngineTape::new(engine, takes_time, perturbation);
        match solver {
            Some(solver) => Self::Taps(Box::new(TapTape::new(solver, engine))),
            None => Self::Driven(Box::new(engine)),
        }
    }

    fn yielding(system: &StatorSystem, phase: Phase, perturbation: (f64, u64)) -> Result<Self, Error> {
        let own = system.base().parameters();
        let still = DimensionlessParameters { friction: 0.0, load: 0.0, twist_speed: 0.0, ..own }.build()?;
        let still = system.without_law()?.with_base(&still)?;
        let mut engine = StatorEngine::new(still, DrivenStart::Contact { phase, angular_speed: 0.0 })?;
        engine.bounds_closely = true;
        Ok(Self::Yielding(Box::new(EngineTape::new(engine, system.takes_time(), perturbation))))
    }

    /// Continues from another state of the disk and its compliant stator.
    pub(crate) fn go_on_from(&mut self, time: PhaseTime, state: StatorState) -> Result<(), Error> {
        let Self::Yielding(source) = self else { return Ok(()) };
        let mut engine = StatorEngine::of_state(source.engine.system().clone(), time, state)?;
        engine.bounds_closely = true;
        source.resume(engine);
        Ok(())
    }

    /// Records a step, which lasts until the next event or longer.
    pub(crate) fn record(&mut self, tape: &mut Tape, work: &mut WorkCount<'_>) -> Result<Touch, Error> {
        match self {
            Self::Rigid(source) => source.record(tape, work),
            Self::Taps(source) => source.record(tape, work),
            Self::Driven(source) => source.record(tape, work),
            Self::Yielding(source) => source.record(tape, work),
        }
    }

    /// The end of the recorded motion.
    pub(crate) fn time(&self) -> PhaseTime {
        match self {
            Self::Rigid(source) => source.time(),
            Self::Taps(source) => source.time(),
            Self::Driven(source) => source.engine.time(),
            Self::Yielding(source) => source.engine.time(),
        }
    }

    /// The phase (rad) at the end.
    pub(crate) fn phase(&self) -> f64 {
        self.time().phase.angle()
    }

    /// Whether the contacts are compliant; unspecified for a compliant stator.
    pub(crate) const fn takes_time(&self) -> bool {
        match self {
            Self::Taps(_) => true,
            Self::Driven(source) => source.takes_time(),
            Self::Rigid(_) | Self::Yielding(_) => false,
        }
    }

    /// The disk at the end; `None` for rigid impacts on a sine, and for a compliant stator.
    pub(crate) fn disk(&self) -> Option<DiskState> {
        match self {
            Self::Taps(source) => Some(source.disk()),
            Self::Driven(source) => Some(source.engine.disk()),
            Self::Rigid(_) | Self::Yielding(_) => None,
        }
    }

    /// Whether the stator has modes, whose energies are recorded.
    pub(crate) fn yields(&self) -> bool {
        matches!(self, Self::Yielding(_))
    }
}

/// A disk on a sine with compliant contacts.
fn soft(system: &DimensionlessSystem, contact_time: f64) -> Result<DrivenSystem, Error> {
    bare(system.peak_acceleration(), system.restitution())?.with_contact_time(contact_time)
}

/// A disk without friction on a sine, with rigid impacts.
pub(crate) fn bare(amplitude: f64, restitution: f64) -> Result<DrivenSystem, Error> {
    let height = Drive::fourier(&[(amplitude, 0.0)])?;
    let angle = Drive::fourier(&[])?;
    Ok(DrivenSystem { height, angle, friction: 0.0, restitution, load: 0.0, compliance: None })
}
