//! The orbit of two impacts that is born where the period-1 orbit doubles, in closed form while both impacts
//! are on one cubic; derived in `docs/studying-the-dynamics.md`.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI, TAU};

use bouncing_disk::core::numerics::elementary::ln;
use bouncing_disk::core::numerics::roots::bisection;
use bouncing_disk::core::{DrivenMap, Error, ImpactState, Phase};
use glam::DVec2;
use serde::{Deserialize, Serialize};

use super::{Shape, critical_bend, ratio};

/// Points of a drawn branch.
const POINTS: u32 = 40;

/// So far above the forcing at which an impact is at the joint, as a share of it, is the orbit beyond.
const BEYOND: f64 = 1e-3;

/// Impacts of the orbit beyond: before, and of which bands and exponent are taken.
const SETTLING: usize = 2_000;
const JUDGED: usize = 20_000;

/// Multipliers nearer to one are those of a neutral family.
const NEUTRAL: f64 = 1e-9;

/// The branch of the 2-cycle.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Doubled {
    /// Γ and phase (cycles) of both impacts.
    pub first: Vec<(f64, f64)>,
    pub second: Vec<(f64, f64)>,
    /// The largest difference between an impact in closed form and that of the map.
    pub misfit: f64,
    /// Γ up to which it attracts; `None` if it does nowhere.
    pub attracts_to: Option<f64>,
    /// Γ at which an impact is at the joint.
    pub joint: f64,
    /// What follows, where the acceleration jumps at the joint.
    pub beyond: Option<Beyond>,
}

/// The motion just beyond the forcing at which an impact is at a joint.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Beyond {
    /// Γ, and the 2-cycle with an impact before the joint: its phase (rad), and the larger multiplier.
    pub axial_forcing: f64,
    pub first_phase: f64,
    pub multiplier: f64,
    /// Whether every second impact of an orbit lies in an interval of its own, and the Lyapunov exponent of this orbit
    /// per impact.
    pub has_two_bands: bool,
    pub exponent: f64,
}

/// The branch of a drive whose first piece is curved and holds the period-1 orbit.
pub(super) fn doubled(shape: Shape, restitution: f64) -> Result<Option<Doubled>, Error> {
    if shape == Shape::Sine || shape.is_piecewise_linear() {
        return Ok(None);
    }
    let at = |apart| TwoCycle::new(shape, restitution, apart);
    let at_joint = bisection(0.0, PI, 60, |apart| Ok::<_, Error>(at(apart)?.phases[0] > 0.0))?;
    let (mut first, mut second, mut misfit) = (Vec::new(), Vec::new(), 0.0_f64);
    for k in 0..POINTS {
        let cycle = at(at_joint * f64::from(k) / f64::from(POINTS))?;
        first.push((cycle.axial_forcing, cycle.phases[0] / TAU));
        second.push((cycle.axial_forcing, cycle.phases[1] / TAU));
        misfit = misfit.max(cycle.misfit()?);
    }
    let attracts_to = if at(at_joint / f64::from(POINTS))?.attracts()? {
        let end = bisection(0.0, at_joint, 40, |apart| at(apart)?.attracts())?;
        Some(at(end)?.axial_forcing)
    } else {
        None
    };
    let cycle = at(at_joint)?;
    let jumps = shape.drive(1.0)?.acceleration(0.0) != 0.0;
    let beyond = if jumps { Some(cycle.beyond(shape, restitution)?) } else { None };
    Ok(Some(Doubled { first, second, misfit, attracts_to, joint: cycle.axial_forcing, beyond }))
}

struct TwoCycle {
    axial_forcing: f64,
    phases: [f64; 2],
    states: [ImpactState; 2],
    map: DrivenMap,
}

impl TwoCycle {
    /// The one whose impacts are so far `apart` in phase (rad), in two periods.
    fn new(shape: Shape, restitution: f64, apart: f64) -> Result<Self, Error> {
        let (unit, ratio) = (shape.drive(1.0)?.at(0.0), ratio(restitution));
        let (square, short) = (apart * apart, apart * apart / (6.0 * TAU));
        let amplitude = |middle: f64| {
            -critical_bend(restitution) / (unit.acceleration + unit.jerk * (middle - ratio * short))
        };
        let middle = bisection(0.0, FRAC_PI_2, 60, |middle| {
            let a = amplitude(middle);
            let velocity = a * (unit.velocity + middle * (unit.acceleration + 0.5 * unit.jerk * middle));
            let needed = (TAU * TAU - square) / (2.0 * TAU) * (ratio - a * unit.jerk * short)
                - a * unit.jerk * square / 24.0;
            Ok::<_, Error>(a < 0.0 || velocity > needed)
        })?;
        let map = DrivenMap::new(shape.drive(amplitude(middle))?, restitution)?;
        let phases = [middle - 0.5 * apart, middle + 0.5 * apart];
        let [one, two] = phases.map(|phase| map.drive().at(phase));
        let rise = two.height - one.height;
        let (to_two, to_one) = (TAU + apart, TAU - apart);
        let states = [
            ImpactState::new(Phase::new(phases[0])?, -0.5 * to_one - rise / to_one - one.velocity)?,
            ImpactState::new(Phase::new(phases[1])?, -0.5 * to_two + rise / to_two - two.velocity)?,
        ];
        Ok(Self { axial_forcing: amplitude(middle) * FRAC_1_PI, phases, states, map })
    }

    fn misfit(&self) -> Result<f64, Error> {
        let mut most = 0.0_f64;
        for index in 0..2 {
            let (next, expected) = (self.map.step(self.states[index])?.impact, self.states[1 - index]);
            let late = next.phase.angle() - expected.phase().angle();
            // A phase 0 may be just below a turn.
            let late = late.abs().min(TAU - late.abs());
            most = most.max(late).max((next.velocity - expected.velocity()).abs());
        }
        Ok(most)
    }

    fn attracts(&self) -> Result<bool, Error> {
        let [one, two] = self.states;
        let both = self.map.step_with_derivative(two)?.1 * self.map.step_with_derivative(one)?.1;
        let trace = both.x_axis.x + both.y_axis.y;
        Ok(trace.abs() < 1.0 + both.determinant() - NEUTRAL)
    }

    /// From the 2-cycle at the joint to slightly higher forcing.
    fn beyond(&self, shape: Shape, restitution: f64) -> Result<Beyond, Error> {
        let axial_forcing = self.axial_forcing * (1.0 + BEYOND);
        let map = shape.map(axial_forcing, restitution)?;
        let moved = ImpactState::new(Phase::new(-10.0 * BEYOND)?, self.states[0].velocity())?;
        let orbit = map.refine(&[moved, self.states[1]])?;
        let first = orbit.states[0].phase().angle();
        let (mut state, mut tangent, mut sum) = (moved, DVec2::X, 0.0);
        let mut ends = [(f64::INFINITY, f64::NEG_INFINITY); 2];
        for index in 0..SETTLING + JUDGED {
            let (landing, derivative) = map.step_with_derivative(state)?;
            state = landing.impact.into();
            tangent = derivative * tangent;
            let length = tangent.length();
            tangent /= length;
            if index >= SETTLING {
                sum += ln(length);
                let phase = state.phase().angle();
                let phase = if phase > PI { phase - TAU } else { phase };
                let (low, high) = &mut ends[index % 2];
                (*low, *high) = (low.min(phase), high.max(phase));
            }
        }
        Ok(Beyond {
            axial_forcing,
            first_phase: if first > PI { first - TAU } else { first },
            multiplier: orbit.multipliers().spectral_radius(),
            has_two_bands: ends[0].1 < ends[1].0 || ends[1].1 < ends[0].0,
            exponent: sum / JUDGED as f64,
        })
    }
}
