//! Works and losses in a contact: integrals of products of two linear functionals of the state, by the
//! eight-point rule.
//!
//! On a whole step the functionals at the points are functionals of the state at its start, computed once. (The
//! integral is a quadratic form of that state, but a form would lose the digits of a product of two small
//! differences of components.)

use std::array;
use std::sync::OnceLock;

use super::linear_flow::{LinearFlow, dot, size};
use super::regime::{CLOSING, COS, ContactStiffness, N, SIN, SPEED, State, VELOCITIES, unit};
use super::{MODES, StatorSystem};
use crate::motion::energy::EnergyLedger;
use crate::motion::gauss::EIGHT_POINTS;
use crate::motion::state::Mode;
use crate::motion::stator_ledger::StatorLedger;

/// Largest number of functionals: eight of the disk and its load, and three of each mode.
const MOST: usize = 8 + 3 * MODES;

/// A value at each point of the rule.
type AtPoints = [f64; 8];

/// The quantity that a product contributes to.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Work {
    /// Work of the platform by the normal force, and the loss in the damper of the contact.
    Normal,
    Damper,
    /// Work of the platform by friction, and the loss in friction.
    Friction,
    Slip,
    /// Work against a load that changes with the speed.
    Load,
    /// Work of the drive on a mode, the loss in its damping, and its work on the disk.
    Drive(usize),
    Damping(usize),
    Given(usize),
}

/// All works and losses of a regime.
#[derive(Debug, Clone, Default)]
pub(super) struct Works {
    functionals: Vec<State>,
    /// Each product with a factor and the indices of its functionals.
    products: Vec<(Work, f64, [usize; 2])>,
    /// Friction torque and slip, whose terms determine the rounding of the work of friction.
    rounding: [State; 2],
    /// For each component of the state, its weights in the functionals at the points of a whole step,
    /// computed at first use.
    at_points: OnceLock<Box<[[AtPoints; MOST]; N]>>,
}

impl Works {
    /// The works of a regime, with its functionals of the force, the friction torque and the slip. The load
    /// is a fourth functional if it changes with the speed.
    pub(super) fn new(
        system: &StatorSystem,
        mode: Mode,
        [force, torque, slip]: [&State; 3],
        load: Option<State>,
    ) -> Self {
        let mut tip = wave([-system.height[1], system.height[0]]);
        let mut turn = wave([-system.angle[1], system.angle[0]]);
        let mut works = Self::default();
        let flies = mode == Mode::Flight;
        for (index, mode) in system.modes.iter().enumerate().filter(|(_, mode)| mode.weight > 0.0) {
            (tip[VELOCITIES[index]], turn[VELOCITIES[index]]) = (mode.height, mode.angle);
            let ([a, b], f, d) = (mode.steady, mode.stiffness - 1.0, mode.damping);
            let mut speed = wave([-b, a]);
            speed[VELOCITIES[index]] = 1.0;
            let drive = wave([f * a - d * b, f * b + d * a]);
            works.add(Work::Drive(index), mode.weight, [drive, speed]);
            works.add(Work::Damping(index), mode.weight * d, [speed, speed]);
            if !flies {
                let given = array::from_fn(|i| mode.height * force[i] + system.arm * mode.angle * torque[i]);
                works.add(Work::Given(index), 1.0, [given, speed]);
            }
        }
        if flies {
            return works;
        }
        works.rounding = [*torque, *slip];
        works.add(Work::Normal, 1.0, [*force, tip]);
        works.add(Work::Friction, 1.0, [*torque, turn]);
        if let ContactStiffness::Soft { damping, .. } = system.contact {
            works.add(Work::Damper, damping, [unit(CLOSING), unit(CLOSING)]);
        }
        if let Mode::Sliding(_) = mode {
            works.add(Work::Slip, system.base.friction(), [*force, *slip]);
        }
        if let Some(load) = load {
            works.add(Work::Load, 1.0, [load, unit(SPEED)]);
        }
        works
    }

    fn add(&mut self, work: Work, factor: f64, functionals: [State; 2]) {
        let places = functionals.map(|of| {
            let known =
                self.functionals.iter().position(|known| known.map(f64::to_bits) == of.map(f64::to_bits));
            known.unwrap_or_else(|| {
                self.functionals.push(of);
                self.functionals.len() - 1
            })
        });
        self.products.push((work, factor, places));
    }

    /// Adds the works and losses of a whole step from this state on, and returns the state at its end.
    pub(super) fn record_step(
        &self,
        flow: &LinearFlow<N>,
        state: &State,
        ledgers: (&mut EnergyLedger, &mut StatorLedger),
    ) -> State {
        let count = self.functionals.len();
        let mut values = [AtPoints::default(); MOST];
        for (weights, component) in self.at_points.get_or_init(|| self.at_points(flow)).iter().zip(state) {
            for (values, weights) in values.iter_mut().zip(&weights[..count]) {
                for (value, weight) in values.iter_mut().zip(weights) {
                    *value += weight * component;
                }
            }
        }
        let end = flow.advance(state);
        let rounding = 0.5 * flow.step() * (self.rounding_at(state) + self.rounding_at(&end));
        self.record(&values, flow.step(), rounding, ledgers);
        end
    }

    /// Adds the works and losses of part of a step from this state on.
    pub(super) fn record_part(
        &self,
        flow: &LinearFlow<N>,
        state: &State,
        length: f64,
        ledgers: (&mut EnergyLedger, &mut StatorLedger),
    ) {
        if length <= 0.0 {
            return;
        }
        let expanded = flow.expand(state, length);
        let (mut values, mut rounding) = ([AtPoints::default(); MOST], 0.0);
        for (point, (time, part)) in points(length).into_iter().enumerate() {
            let at = expanded.at(time);
            for (values, functional) in values.iter_mut().zip(&self.functionals) {
                values[point] = dot(functional, &at);
            }
            rounding += part * self.rounding_at(&at);
        }
        self.record(&values, length, rounding, ledgers);
    }

    /// Sum of the magnitudes of the terms of friction's power.
    fn rounding_at(&self, state: &State) -> f64 {
        size(&self.rounding[0], state) * size(&self.rounding[1], state)
    }

    fn record(
        &self,
        values: &[AtPoints; MOST],
        length: f64,
        rounding: f64,
        (ledger, stator): (&mut EnergyLedger, &mut StatorLedger),
    ) {
        let parts = points(length).map(|(_, part)| part);
        ledger.record_friction(0.0, 0.0, rounding);
        for &(work, factor, [one, other]) in &self.products {
            let powers = values[one].iter().zip(values[other]).zip(parts);
            let value = factor * powers.map(|((one, other), part)| part * (one * other)).sum::<f64>();
            match work {
                Work::Normal => ledger.record_normal(value, 0.0),
                Work::Damper => ledger.record_normal(0.0, value),
                Work::Friction => ledger.record_friction(value, 0.0, 0.0),
                Work::Slip => ledger.record_friction(0.0, value, value.abs()),
                Work::Load => ledger.record_load(value, value.abs()),
                Work::Drive(mode) => stator.record(mode, value, 0.0, 0.0),
                Work::Damping(mode) => stator.record(mode, 0.0, value, 0.0),
                Work::Given(mode) => stator.record(mode, 0.0, 0.0, value),
            }
        }
    }

    fn at_points(&self, flow: &LinearFlow<N>) -> Box<[[AtPoints; MOST]; N]> {
        let mut weights = Box::new([[AtPoints::default(); MOST]; N]);
        for (component, weights) in weights.iter_mut().enumerate() {
            for (point, (time, _)) in points(flow.step()).into_iter().enumerate() {
                let at = flow.after(&unit(component), time);
                for (weights, functional) in weights.iter_mut().zip(&self.functionals) {
                    weights[point] = dot(functional, &at);
                }
            }
        }
        weights
    }
}

/// Times and weights of the rule on an interval of this length.
fn points(length: f64) -> [(f64, f64); 8] {
    let half = 0.5 * length;
    array::from_fn(|index| {
        let (node, weight) = EIGHT_POINTS[index / 2];
        let node = if index % 2 == 0 { node } else { -node };
        (half * (1.0 + node), half * weight)
    })
}

fn wave([sine, cosine]: [f64; 2]) -> State {
    let mut wave = [0.0; N];
    (wave[SIN], wave[COS]) = (sine, cosine);
    wave
}
