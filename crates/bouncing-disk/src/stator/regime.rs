//! The joint motions of disk and stator between two events, each as a linear flow.
//!
//! The accelerations of the modes, the normal force N and the torque T of friction on the disk follow from
//! one small system of linear equations, whose right-hand sides are functionals of the state:
//!
//! ```text
//! r_j'' + h_j N + l_j T = -d_j r_j' - f_j^2 r_j
//! N = 0,   N = -k y - c y',   or   N - sum of phi_j r_j'' = 1 + s''
//! T = 0,   T = -+mu N,        or   T - sum of psi_j r_j'' = load + beta''
//! ```
//!
//! with the steady height s and angle beta. The alternatives for N are flight, compliant contact and rigid
//! contact; those for T are flight, sliding forwards or backwards, and sticking.

use std::f64::consts::TAU;

use super::linear_flow::{Functional, LinearFlow, Vector};
use super::works::Works;
use super::{LoadLine, MODES, StatorSystem};
use crate::motion::state::{Mode, SlipDirection};

/// Components of a state.
pub(crate) const N: usize = 11;
/// Gap and relative velocity.
pub(crate) const GAP: usize = 0;
pub(crate) const CLOSING: usize = 1;
/// r and r' of both modes.
pub(crate) const DISPLACEMENTS: [usize; MODES] = [2, 4];
pub(crate) const VELOCITIES: [usize; MODES] = [3, 5];
/// Angle, since the last event, and angular speed of the disk.
pub(crate) const ANGLE: usize = 6;
pub(crate) const SPEED: usize = 7;
/// Sine and cosine of the phase, and 1.
pub(crate) const SIN: usize = 8;
pub(crate) const COS: usize = 9;
pub(crate) const ONE: usize = 10;

pub(crate) type State = Vector<N>;

/// The kind of contact between disk and stator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ContactStiffness {
    Rigid,
    Soft { stiffness: f64, damping: f64 },
}

/// A flow, and the functionals that end it when they first fall below zero.
#[derive(Debug, Clone)]
pub(crate) struct Regime {
    pub(crate) flow: LinearFlow<N>,
    /// The gap.
    pub(crate) gap: Functional<N>,
    /// -k y - c y', the force of a compliant contact before it is cut off; N in a contact.
    pub(crate) force: Functional<N>,
    /// The slip in the direction of a slide.
    pub(crate) slip: Functional<N>,
    /// mu N - T and mu N + T while friction holds.
    pub(crate) hold: [Functional<N>; 2],
    /// Distances of the speed from the lower and the upper end of the piece of the load.
    pub(crate) nodes: [Option<Functional<N>>; 2],
    /// Works and losses during the regime.
    pub(super) works: Works,
}

pub(super) fn unit(index: usize) -> State {
    let mut unit = [0.0; N];
    unit[index] = 1.0;
    unit
}

fn sum(a: &State, b: &State, factor: f64) -> State {
    std::array::from_fn(|i| a[i] + factor * b[i])
}

/// The acceleration of a steady motion.
fn steady_acceleration([a, b]: [f64; 2]) -> State {
    let mut of = [0.0; N];
    (of[SIN], of[COS]) = (-a, -b);
    of
}

impl Regime {
    /// The regime of this mode on a piece of the load.
    pub(crate) fn new(system: &StatorSystem, line: &LoadLine, mode: Mode) -> Self {
        let friction = system.base.friction();
        let load = sum(&unit(ONE).map(|one| line.torque * one), &unit(SPEED), line.slope);
        let pull = match system.contact {
            ContactStiffness::Rigid => [0.0; N],
            ContactStiffness::Soft { stiffness, damping } => {
                sum(&unit(GAP).map(|one| -stiffness * one), &unit(CLOSING), -damping)
            }
        };
        // Unknowns: the accelerations r'', N and T.
        const FORCE: usize = MODES;
        const TORQUE: usize = MODES + 1;
        let mut left = [[0.0; MODES + 2]; MODES + 2];
        let mut right = [[0.0; N]; MODES + 2];
        for (j, mode) in system.modes.iter().enumerate() {
            (left[j][j], left[j][FORCE], left[j][TORQUE]) = (1.0, mode.by_force, mode.by_torque);
            (right[j][VELOCITIES[j]], right[j][DISPLACEMENTS[j]]) = (-mode.damping, -mode.stiffness);
        }
        (left[FORCE][FORCE], left[TORQUE][TORQUE]) = (1.0, 1.0);
        match (mode, system.contact) {
            (Mode::Flight, _) => {}
            (_, ContactStiffness::Soft { .. }) => right[FORCE] = pull,
            (_, ContactStiffness::Rigid) => {
                for (j, mode) in system.modes.iter().enumerate() {
                    left[FORCE][j] = -mode.height;
                }
                right[FORCE] = sum(&unit(ONE), &steady_acceleration(system.height), 1.0);
            }
        }
        match mode {
            Mode::Flight => {}
            Mode::Sticking => {
                for (j, mode) in system.modes.iter().enumerate() {
                    left[TORQUE][j] = -mode.angle;
                }
                right[TORQUE] = sum(&load, &steady_acceleration(system.angle), 1.0);
            }
            Mode::Sliding(direction) => left[TORQUE][FORCE] = direction.sign() * friction,
        }
        let solution = solved(left, right);
        let (force, torque) = (solution[FORCE], solution[TORQUE]);

        let mut matrix = [[0.0; N]; N];
        for j in 0..MODES {
            (matrix[DISPLACEMENTS[j]], matrix[VELOCITIES[j]]) = (unit(VELOCITIES[j]), solution[j]);
        }
        (matrix[SIN][COS], matrix[COS][SIN]) = (1.0, -1.0);
        (matrix[ANGLE], matrix[SPEED]) = (unit(SPEED), sum(&torque, &load, -1.0));
        if mode == Mode::Sticking {
            // The same without the load, whose rounding would make the disk drift relative to a stator that
            // hardly turns.
            let modes = system.modes.iter().zip(&solution);
            matrix[SPEED] = modes.fold(steady_acceleration(system.angle), |turns, (mode, acceleration)| {
                sum(&turns, acceleration, mode.angle)
            });
        }
        if mode == Mode::Flight || system.contact != ContactStiffness::Rigid {
            // w' = N - 1 - s''.
            let fall = sum(&force, &unit(ONE), -1.0);
            let mut relative = sum(&fall, &steady_acceleration(system.height), -1.0);
            for (mode, acceleration) in system.modes.iter().zip(&solution) {
                relative = sum(&relative, acceleration, -mode.height);
            }
            (matrix[GAP], matrix[CLOSING]) = (unit(CLOSING), relative);
        }
        let flow = LinearFlow::new(matrix, rate(system, line, mode), TAU);

        let mut slip = unit(SPEED);
        (slip[SIN], slip[COS]) = (system.angle[1], -system.angle[0]);
        for (j, mode) in system.modes.iter().enumerate() {
            slip[VELOCITIES[j]] = -mode.angle;
        }
        if mode == Mode::Sliding(SlipDirection::Backward) {
            slip = slip.map(|entry| -entry);
        }
        let grips = force.map(|entry| friction * entry);
        let works = Works::new(system, mode, [&force, &torque, &slip], (line.slope != 0.0).then_some(load));
        let force = if mode == Mode::Flight { pull } else { force };
        Self {
            gap: flow.functional(unit(GAP)),
            force: flow.functional(force),
            slip: flow.functional(slip),
            hold: [-1.0, 1.0].map(|sign| flow.functional(sum(&grips, &torque, sign))),
            nodes: [(1.0, line.from), (-1.0, line.to)].map(|(sign, node)| {
                let distance = sum(&unit(SPEED).map(|one| sign * one), &unit(ONE), -sign * node);
                node.is_finite().then(|| flow.functional(distance))
            }),
            works,
            flow,
        }
    }
}

/// A bound on the eigenvalues: from the modes, the drive, and the spring and damper with all masses that they
/// move.
fn rate(system: &StatorSystem, line: &LoadLine, mode: Mode) -> f64 {
    let mobility = system.mobility();
    let mut rate = line.slope.abs().max(1.0);
    for mode in &system.modes {
        rate = rate.max(mode.stiffness.sqrt() + mode.damping);
    }
    if mode != Mode::Flight {
        // In a slide the disk may reduce the effective inertia.
        rate /= (mobility[0][0] - system.base.friction() * mobility[0][1].abs()).min(1.0);
    }
    if mode != Mode::Flight
        && let ContactStiffness::Soft { stiffness, damping } = system.contact
    {
        let share = mobility[0][0] + system.base.friction() * mobility[0][1].abs();
        rate += (stiffness * share).sqrt() + damping * share;
    }
    rate
}

/// The solution of a small system of equations, by elimination with pivots; singular systems were rejected
/// earlier.
fn solved<const M: usize>(mut left: [[f64; M]; M], mut right: [State; M]) -> [State; M] {
    for column in 0..M {
        let best = (column..M).fold(column, |best, row| {
            if left[row][column].abs() > left[best][column].abs() { row } else { best }
        });
        left.swap(column, best);
        right.swap(column, best);
        let (pivot, known) = (left[column], right[column]);
        for row in 0..M {
            if row == column || left[row][column] == 0.0 {
                continue;
            }
            let factor = left[row][column] / pivot[column];
            for (entry, above) in left[row].iter_mut().zip(&pivot) {
                *entry -= factor * above;
            }
            right[row] = sum(&right[row], &known, -factor);
        }
    }
    std::array::from_fn(|row| right[row].map(|entry| entry / left[row][row]))
}
