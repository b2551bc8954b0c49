//! The two branches of the diagrams: the attractor that is followed in Γ from its period-1 orbit, and the chattering orbit of
//! a disk from rest.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use bouncing_disk::InitialCondition;
use bouncing_disk::core::orbits::{Followed, follow_attractor};
use bouncing_disk::core::sweep::{SweepEvent, sweep};
use bouncing_disk::core::{ImpactState, Launch, Phase, Unobserved};
use bouncing_disk::motion::PAPER_CHATTER;
use bouncing_disk::parameters::{DimensionlessSystem, ForcingParameters};
use bouncing_disk::toss::{
    ChatteringCycle, LONG_FLIGHT, MultiTossSettings, OrbitClass, TOSS_START, multi_toss,
};
use serde::Serialize;

use crate::claims::paper;
use crate::experiment::ExperimentError;
use crate::figures::shared::numbers::six_decimals;
use crate::figures::shared::{FORCING_RANGE, map, map_in_parallel};
use crate::progress::Progress;

/// An orbit that has not attached after so many impacts does not come to rest.
pub(super) const LONGEST_CYCLE: usize = 20_000;

/// Phase lag θ and angular forcing Γ_T.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Twist {
    pub(super) phase_lag_rad: f64,
    pub(super) angular_forcing: f64,
}

/// What the paper prints of its diagrams.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inputs {
    pub(super) restitution: f64,
    /// Γ from which the period-1 attractor is followed.
    pub(super) followed_from: f64,
    /// Panel (c).
    pub(super) linear: Twist,
    /// Panel (d).
    pub(super) semielliptical: Twist,
}

impl Inputs {
    pub(super) fn printed() -> Result<Self, ExperimentError> {
        let section = paper::section_four()?;
        let twist = |phase_lag_rad, angular_forcing| Twist { phase_lag_rad, angular_forcing };
        Ok(Self {
            restitution: section.restitution,
            followed_from: section.followed_from,
            linear: twist(section.linear_phase_lag_rad, section.linear_angular_forcing),
            semielliptical: twist(
                section.semielliptical_phase_lag_rad,
                section.semielliptical_angular_forcing,
            ),
        })
    }

    pub(super) fn twists(&self) -> [Twist; 2] {
        [self.linear, self.semielliptical]
    }

    /// The diagram with the angular forcings of (c) and (d) exchanged.
    pub(super) fn exchanged(self) -> Self {
        let Self { mut linear, mut semielliptical, .. } = self;
        std::mem::swap(&mut linear.angular_forcing, &mut semielliptical.angular_forcing);
        Self { linear, semielliptical, ..self }
    }

    pub(super) fn system(
        &self,
        axial_forcing: f64,
        twist: Twist,
    ) -> Result<DimensionlessSystem, ExperimentError> {
        let Twist { phase_lag_rad: phase_lag, angular_forcing } = twist;
        let parameters =
            ForcingParameters { axial_forcing, angular_forcing, phase_lag, restitution: self.restitution };
        parameters.build().map_err(ExperimentError::model)
    }
}

/// A disk after this impact, or without one at rest on the platform at its lowest point; it turns with the platform, or not at all.
pub(super) fn start(
    system: &DimensionlessSystem,
    state: Option<ImpactState>,
    turns: bool,
) -> Result<InitialCondition, ExperimentError> {
    let phase = state.map_or_else(|| Phase::new(TOSS_START), |state| Ok(state.phase()))?;
    let angular_speed = if turns { system.platform_angular_speed(phase) } else { 0.0 };
    Ok(match state {
        Some(state) => InitialCondition::Launch {
            phase,
            relative_speed: -system.restitution() * state.velocity(),
            angular_speed,
        },
        None => InitialCondition::Contact { phase, angular_speed },
    })
}

/// The impacts at one Γ. Coordinates are rounded to 1e-6, far below the resolution of the picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Slice {
    pub(super) axial_forcing: f64,
    /// Impacts in one round of a periodic orbit or from one rest to the next of a chattering one, if it
    /// repeats.
    pub(super) period: Option<usize>,
    /// Periods of the platform in the same.
    pub(super) platform_periods: Option<u64>,
    pub(super) impact_phase_cycles: Vec<f64>,
    pub(super) normalised_impact_speed: Vec<f64>,
    /// α'/|ωΦ| just before the impact, for (c), and its mean.
    pub(super) linear: Vec<f64>,
    pub(super) linear_mean: f64,
    /// The same for (d).
    pub(super) semielliptical: Vec<f64>,
    pub(super) semielliptical_mean: f64,
}

impl Slice {
    /// After this impact or from rest, for both rotary motions; `None` if the followed attractor comes to rest.
    pub(super) fn of(
        axial_forcing: f64,
        state: Option<ImpactState>,
        inputs: Inputs,
        settings: MultiTossSettings,
    ) -> Result<Option<Self>, ExperimentError> {
        let toss = |twist: Twist| -> Result<_, ExperimentError> {
            let system = inputs.system(axial_forcing, twist)?;
            let orbit = multi_toss(system, start(&system, state, true)?, settings, &Unobserved)?;
            let scale = PI * twist.angular_forcing;
            let speeds = orbit.collisions.iter().map(|impact| six_decimals(impact.angular_speed / scale));
            let mean = orbit.mean_angular_speed.unwrap_or_default() / scale;
            Ok((speeds.collect::<Vec<f64>>(), mean, orbit))
        };
        let (linear, linear_mean, orbit) = toss(inputs.linear)?;
        let (period, platform_periods) = match orbit.class {
            OrbitClass::Chattering(_) | OrbitClass::AtRest if state.is_some() => return Ok(None),
            OrbitClass::Periodic { period, platform_periods, .. } => (Some(period), Some(platform_periods)),
            OrbitClass::Chattering(cycle) => (Some(cycle.impacts), Some(cycle.platform_periods)),
            _ => (None, None),
        };
        let (semielliptical, semielliptical_mean, _) = toss(inputs.semielliptical)?;
        let impacts = orbit.collisions.iter().map(|impact| impact.state);
        Ok(Some(Self {
            axial_forcing,
            period,
            platform_periods,
            impact_phase_cycles: impacts.clone().map(|state| six_decimals(state.phase.cycles())).collect(),
            normalised_impact_speed: impacts
                .map(|state| six_decimals(-state.axial_impact_velocity / PI))
                .collect(),
            linear,
            linear_mean,
            semielliptical,
            semielliptical_mean,
        }))
    }
}

/// Both branches.
pub(super) struct Diagram {
    pub(super) inputs: Inputs,
    pub(super) settings: MultiTossSettings,
    /// The period-1 orbit where following starts, if there is one.
    pub(super) first: Option<ImpactState>,
    /// Γ and a state on the followed attractor, as far as the run on the way could follow it.
    pub(super) walk: Vec<Followed>,
    /// The followed attractor by rising Γ, as far as the longer run found it.
    pub(super) followed: Vec<Slice>,
    /// The cycle of a disk from rest at each Γ; `None` where it never leaves or does not come to rest again.
    pub(super) cycles: Vec<(f64, Option<ChatteringCycle>)>,
    /// The chattering orbit, where there is such a cycle.
    pub(super) chattering: Vec<Slice>,
}

impl Diagram {
    pub(super) fn of(
        values: usize,
        inputs: Inputs,
        settings: MultiTossSettings,
        progress: &dyn Progress,
    ) -> Result<Self, ExperimentError> {
        let Inputs { restitution, followed_from, .. } = inputs;
        let (low, high) = FORCING_RANGE;
        let forcings: Vec<f64> =
            (0..values).map(|i| low + (high - low) * i as f64 / (values - 1) as f64).collect();
        let first = map(followed_from, restitution)?.period_one(1);
        let above = || forcings.iter().copied().filter(|forcing| *forcing >= followed_from);
        let follow =
            |first| follow_attractor(restitution, above(), first, settings.transient_impacts, PAPER_CHATTER);
        let walk: Vec<Followed> = first.into_iter().flat_map(follow).collect::<Result<_, _>>()?;
        progress.advance((values - walk.len()) as u64);
        let followed = map_in_parallel(&walk, |at| {
            let slice = Slice::of(at.axial_forcing, Some(at.state), inputs, settings);
            progress.advance(1);
            slice
        })?;
        // The attractor is lost where its orbit comes to rest in the longer run, too.
        let followed: Vec<Slice> = followed.into_iter().map_while(|slice| slice).collect();
        let cycles = forcings.iter().copied().zip(cycles(&forcings, restitution)?).collect::<Vec<_>>();
        let chattering = map_in_parallel(&cycles, |&(forcing, cycle)| {
            let slice = cycle.map(|cycle| {
                let slice = Slice::of(forcing, None, inputs, settings)?;
                let (period, platform_periods) = (Some(cycle.impacts), Some(cycle.platform_periods));
                Ok::<_, ExperimentError>(slice.map(|slice| Slice { period, platform_periods, ..slice }))
            });
            progress.advance(1);
            Ok(slice.transpose()?.flatten())
        })?;
        let chattering = chattering.into_iter().flatten().collect();
        Ok(Self { inputs, settings, first, walk, followed, cycles, chattering })
    }

    /// The walk where it is on the attractor.
    pub(super) fn on_attractor(&self) -> &[Followed] {
        &self.walk[..self.followed.len()]
    }

    /// Γ and a state on the attractor.
    pub(super) fn states(&self) -> Vec<(f64, ImpactState)> {
        self.on_attractor().iter().map(|at| (at.axial_forcing, at.state)).collect()
    }

    /// The Γ at which a disk from rest comes to rest again.
    pub(super) fn resting(&self) -> Vec<f64> {
        self.chattering.iter().map(|slice| slice.axial_forcing).collect()
    }

    /// Whether a disk from rest comes to rest again at the Γ of a slice of the followed attractor.
    pub(super) fn rests_beside(&self, followed: &Slice) -> bool {
        let own = followed.axial_forcing.to_bits();
        self.chattering.iter().any(|slice| slice.axial_forcing.to_bits() == own)
    }

    /// The attracting period-1 orbits, by rising Γ.
    pub(super) fn period_ones(&self) -> Vec<&Slice> {
        self.followed.iter().filter(|slice| slice.period == Some(1)).collect()
    }

    /// The followed attractor between two Γ; nothing if one of them is not a number.
    pub(super) fn between(&self, low: f64, high: f64) -> Vec<&Slice> {
        let inside = |slice: &&Slice| slice.axial_forcing > low && slice.axial_forcing < high;
        self.followed.iter().filter(inside).collect()
    }
}

/// The cycles of a disk that has been at rest, at each Γ; `None` where it never leaves or does not come to
/// rest again.
pub(super) fn cycles(
    forcings: &[f64],
    restitution: f64,
) -> Result<Vec<Option<ChatteringCycle>>, ExperimentError> {
    let (mut orbits, mut leaving, mut cycles) = (Vec::new(), Vec::new(), vec![None; forcings.len()]);
    for (index, &forcing) in forcings.iter().enumerate() {
        let map = map(forcing, restitution)?;
        if let Some(leaves) = map.vibration().separation_phase() {
            orbits.push(map.orbit_from_launch(Launch::new(leaves, 0.0)?, PAPER_CHATTER));
            leaving.push(index);
        }
    }
    let walked = sweep(
        &orbits,
        |_| (ChatteringCycle::default(), false),
        |(cycle, rests), event| match event {
            SweepEvent::Impact(landing) => {
                cycle.impacts += 1;
                cycle.platform_periods += landing.turns;
                cycle.long_flights += usize::from(landing.duration > LONG_FLIGHT);
                if cycle.impacts < LONGEST_CYCLE { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            }
            SweepEvent::Attachment(rest) => {
                cycle.platform_periods +=
                    rest.accumulation.turns + rest.separation.map_or(0, |(_, turns)| turns);
                *rests = true;
                ControlFlow::Break(())
            }
            _ => ControlFlow::Break(()),
        },
        &Unobserved,
    )?;
    for (index, (cycle, rests)) in leaving.into_iter().zip(walked) {
        cycles[index] = rests.then_some(cycle);
    }
    Ok(cycles)
}

/// So many of all, or some more, evenly.
pub(super) fn sampled<T: Copy>(count: usize, all: &[T]) -> Vec<T> {
    all.iter().copied().step_by((all.len() / count).max(1)).collect()
}
