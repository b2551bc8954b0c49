//! Rotors on a platform that never falls away: they stick and slide, each by itself, without chaos.
//!
//! The steady motion is computed directly, without following a run-up: it repeats from period to period, and
//! its speed is the fixed point of the map over a period (docs/numerics/motors.md, "A motor that is never
//! thrown").

use std::f64::consts::TAU;

use bouncing_disk_core::run::WorkCount;
use bouncing_disk_core::{ChatterPolicy, Phase};

use crate::driven::{DrivenEngine, DrivenSystem};
use crate::error::Error;
use crate::motion::energy::EnergyLedger;
use crate::motion::engine::Engine;
use crate::motion::event::{Event, SteeredMotion};
use crate::motion::initial_condition::InitialCondition;
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motor::operation::window::{AxialWindow, RotorWindow, Window};
use crate::motor::rotor::transient::FLIGHTS_OF_EVENT;
use crate::parameters::dimensionless::DimensionlessSystem;

/// Halvings that find the steady speed: to 1e-18 of the range in which it lies.
const HALVINGS: u32 = 60;

/// Periods of the steady motion that are computed for its energies: enough for these to be large compared
/// with the rounding of the speed at both ends.
const PERIODS: u64 = 16;

/// A rotor, and its system on a stator that moves in another way than by Eq. (1).
pub(crate) type LyingRotor = (DimensionlessSystem, Option<DrivenSystem>);

/// Rotors that lie on the platform for ever.
#[derive(Debug)]
pub(crate) struct Lying {
    rotors: Vec<LyingRotor>,
    phase: Phase,
    /// [`PERIODS`] that all rotors repeat; computed when first needed.
    round: Option<Window>,
}

impl Lying {
    pub(crate) const fn new(rotors: Vec<LyingRotor>, phase: Phase) -> Self {
        Self { rotors, phase, round: None }
    }

    /// A window of whole periods of the steady motion, at least of `duration` rad but for the most of them.
    pub(crate) fn next_window(
        &mut self,
        duration: f64,
        most: u64,
        work: &mut WorkCount<'_>,
    ) -> Result<Window, Error> {
        let round = match self.round.take() {
            Some(round) => round,
            None => self.steady_round(work)?,
        };
        let periods = ((duration / TAU) as u64).saturating_add(1).min(most);
        let times = periods as f64 / PERIODS as f64;
        let window = Window {
            axial: AxialWindow {
                duration: periods as f64 * TAU,
                impacts: periods,
                normal_work: times * round.axial.normal_work,
                energy_change: times * round.axial.energy_change,
                ..AxialWindow::default()
            },
            rotors: round
                .rotors
                .iter()
                .map(|rotor| RotorWindow {
                    angle: times * rotor.angle,
                    friction_work: times * rotor.friction_work,
                    friction_loss: times * rotor.friction_loss,
                    load_work: times * rotor.load_work,
                    kinetic_change: times * rotor.kinetic_change,
                    stator: None,
                })
                .collect(),
        };
        self.round = Some(round);
        Ok(window)
    }

    fn steady_round(&self, work: &mut WorkCount<'_>) -> Result<Window, Error> {
        let mut window = Window::default();
        for (index, rotor) in self.rotors.iter().enumerate() {
            let speed = steady_speed(rotor, self.phase, work)?;
            let (ledger, rotor, _) = motion(rotor, self.phase, speed, PERIODS, work)?;
            window.rotors.push(rotor);
            if index == 0 {
                window.axial.normal_work = ledger.normal_work;
                window.axial.energy_change = ledger.axial_kinetic_change + ledger.potential_change;
            }
        }
        Ok(window)
    }
}

/// The angular speed at a phase to which a rotor from rest tends. The gain of a period falls with the speed
/// at its beginning, so its sign changes once.
fn steady_speed(rotor: &LyingRotor, phase: Phase, work: &mut WorkCount<'_>) -> Result<f64, Error> {
    let (system, _) = rotor;
    let mut gain = |speed: f64| Ok::<_, Error>(motion(rotor, phase, speed, 1, work)?.2 - speed);
    let first = gain(0.0)?;
    // Beyond it a rotor slides one way for a whole period, and comes back.
    let most = TAU * (system.friction() + system.load().abs()) * (1.0 + system.peak_acceleration());
    let (mut near, mut far) = (0.0, (system.twist_speed() + most).copysign(first));
    for _ in 0..HALVINGS {
        let middle = 0.5 * (near + far);
        if gain(middle)? * first > 0.0 {
            near = middle;
        } else {
            far = middle;
        }
    }
    Ok(near)
}

/// Some periods of a rotor from a phase and an angular speed: energies, the rotor's part, the speed at the
/// end.
fn motion(
    (system, driven): &LyingRotor,
    phase: Phase,
    angular_speed: f64,
    periods: u64,
    work: &mut WorkCount<'_>,
) -> Result<(EnergyLedger, RotorWindow, f64), Error> {
    let end = PhaseTime::in_first_period(phase).after(PhaseSpan { periods, remainder: 0.0 });
    let start = InitialCondition::Contact { phase, angular_speed };
    let mut ledger = EnergyLedger::default();
    let (before, after) = if let Some(driven) = driven {
        let mut engine = DrivenEngine::new(driven.clone(), start, ChatterPolicy::Complete)?;
        let before = *engine.state();
        let left = |engine: &DrivenEngine| end.since(&engine.time()).radians();
        while let Some(record) = engine.advance_within(left(&engine))? {
            work.spend(FLIGHTS_OF_EVENT)?;
            ledger += record.ledger;
        }
        ledger += engine.ledger_after(left(&engine));
        (before, engine.state_after(left(&engine)).1)
    } else {
        let mut engine = Engine::new(*system, start, ChatterPolicy::Complete)?;
        let before = *engine.state();
        engine.pause_at(end);
        while let Some(record) = engine.advance()? {
            work.spend(FLIGHTS_OF_EVENT)?;
            ledger += record.ledger;
            if record.event == Event::Separation {
                break;
            }
        }
        (before, *engine.state())
    };
    let rotor = RotorWindow {
        angle: after.angle - before.angle,
        friction_work: ledger.friction_work,
        friction_loss: ledger.friction_loss,
        load_work: ledger.load_work,
        kinetic_change: 0.5
            * (after.angular_speed - before.angular_speed)
            * (after.angular_speed + before.angular_speed),
        stator: None,
    };
    Ok((ledger, rotor, after.angular_speed))
}
