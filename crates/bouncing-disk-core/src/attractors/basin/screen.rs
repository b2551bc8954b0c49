//! A fast screen for the impacts of a batch that decide the label of their start, consistent with `settles`.

use core::f64::consts::TAU;

use pulp::{Simd, WithSimd};

use super::{ATTACHED, BasinSettings, FIRST_ORBIT, KnownOrbit, Label, TARGETS_OF_FLIGHT, settles};
use crate::chatter::rest_proof::RestProof;
use crate::map::impact_map::ImpactMap;
use crate::numerics::error::Error;
use crate::sweep::lockstep::lanes::{Batch, Dispatch, Impacts, LANES, Lanes, Mask, lanes_of, mask};

/// Share by which the screen's radius exceeds the known orbit's, so that its rounding does not matter.
const SLACK: f64 = 1.0e-9;

/// Targets with which a batch is compared between two calls of an observer.
const TARGETS_AT_ONCE: usize = 1 << 12;

/// The work of comparing a batch with a target, in flights.
const FLIGHTS_OF_TARGET: u64 = 2;

/// An impact of a known orbit.
#[derive(Debug, Clone, Copy)]
struct Target {
    label: Label,
    angle: f64,
    velocity: f64,
    square_radius: f64,
}

/// The labels decided by the impacts of the lanes, consistent with `settles`.
#[derive(Debug, Clone)]
pub(super) struct LabelMasks {
    pub(super) labels: Mask,
    /// Lanes left to `settles`.
    pub(super) doubtful: Mask,
    either: Mask,
    /// Lanes that are labelled or doubtful.
    pub(super) settled: Lanes,
}

/// The tests that decide the label of a start: the known orbits and the proof of rest.
pub(super) struct Judge<'a> {
    map: &'a ImpactMap,
    known: &'a [KnownOrbit],
    settings: BasinSettings,
    targets: Vec<Target>,
    proof: RestProof,
    dispatch: Dispatch,
}

impl<'a> Judge<'a> {
    pub(super) fn new(
        map: &'a ImpactMap,
        known: &'a [KnownOrbit],
        settings: BasinSettings,
        dispatch: Dispatch,
    ) -> Self {
        let targets = known.iter().zip(FIRST_ORBIT..).flat_map(|(known, label)| {
            known.orbit().states.iter().map(move |state| Target {
                label,
                angle: state.phase().angle(),
                velocity: state.velocity(),
                square_radius: known.radius() * known.radius(),
            })
        });
        Self {
            map,
            known,
            settings,
            targets: targets.collect(),
            proof: RestProof::new(map.vibration(), map.restitution()),
            dispatch,
        }
    }

    /// Finds the lanes whose impacts decide their labels. `spend` receives the work in units of an observer:
    /// the flights of a batch, and the comparisons with the targets.
    #[inline(always)]
    pub(super) fn screen(
        &self,
        impacts: &Impacts,
        verdicts: &mut LabelMasks,
        mut spend: impl FnMut(u64) -> Result<(), Error>,
    ) -> Result<(), Error> {
        spend(LANES as u64)?;
        let (mut left, mut begins) = (self.targets.as_slice(), true);
        loop {
            // From the last one down: the first known orbit that captures a state decides its label.
            let (others, targets) = left.split_at(left.len().saturating_sub(TARGETS_AT_ONCE));
            spend(FLIGHTS_OF_TARGET * targets.len() as u64)?;
            self.dispatch.run(Screen {
                impacts,
                targets,
                begins,
                proof: self.proof,
                peak: self.map.vibration().peak_acceleration(),
                restitution: self.map.restitution(),
                verdicts,
            });
            if others.is_empty() {
                return Ok(());
            }
            (left, begins) = (others, false);
        }
    }

    /// The work of resolving a doubt, in units of an observer.
    pub(super) const fn work_of_doubt(&self) -> u64 {
        (self.targets.len() / TARGETS_OF_FLIGHT) as u64
    }

    /// The label of a settled lane, with its doubt resolved; `None` if this leaves the start undecided.
    #[inline(always)]
    pub(super) fn label(&self, verdicts: &LabelMasks, batch: &Batch, lane: usize) -> Option<Label> {
        if verdicts.doubtful[lane] == 0 {
            return Some(verdicts.labels[lane] as Label);
        }
        settles(self.map, batch.impact_state(lane), self.known, self.settings.policy)
    }
}

struct Screen<'a> {
    impacts: &'a Impacts,
    targets: &'a [Target],
    /// Whether no targets have been compared yet.
    begins: bool,
    proof: RestProof,
    peak: f64,
    restitution: f64,
    verdicts: &'a mut LabelMasks,
}

impl WithSimd for Screen<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { impacts, targets, begins, proof, peak, restitution, verdicts } = self;
        if begins {
            find_rest(impacts, proof, restitution, verdicts);
        }
        for target in targets.iter().rev() {
            find_caught(impacts, *target, 1.0 / peak, verdicts);
        }
        for lane in 0..LANES {
            verdicts.either[lane] = mask(verdicts.labels[lane] | verdicts.doubtful[lane] != 0);
        }
        verdicts.settled = lanes_of(&verdicts.either);
    }
}

#[inline(always)]
fn find_rest(impacts: &Impacts, proof: RestProof, restitution: f64, verdicts: &mut LabelMasks) {
    for lane in 0..LANES {
        let speed = -restitution * impacts.velocity[lane];
        let (angle, sin, cos) = (impacts.angle[lane], impacts.sin[lane], impacts.cos[lane]);
        let rests = mask(proof.is_certain(angle, sin, cos, speed));
        verdicts.labels[lane] = rests & u64::from(ATTACHED);
        verdicts.doubtful[lane] = mask(speed <= 0.0);
    }
}

#[inline(always)]
fn find_caught(impacts: &Impacts, target: Target, inverse_peak: f64, verdicts: &mut LabelMasks) {
    let label = u64::from(target.label);
    let (least, most) = (target.square_radius * (1.0 - SLACK), target.square_radius * (1.0 + SLACK));
    // Selected from copies: masked stores are slow.
    let (labels, doubtful) = (verdicts.labels, verdicts.doubtful);
    for lane in 0..LANES {
        let turned = (impacts.angle[lane] - target.angle).abs();
        let back = TAU - turned;
        let phase = if turned < back { turned } else { back };
        let velocity = (impacts.velocity[lane] - target.velocity) * inverse_peak;
        let square = phase * phase + velocity * velocity;
        let inside = mask(square < least);
        verdicts.labels[lane] = (labels[lane] & !inside) | (label & inside);
        verdicts.doubtful[lane] = doubtful[lane] | (mask(square <= most) & !inside);
    }
}

impl LabelMasks {
    pub(super) const fn new() -> Self {
        Self { labels: [0; LANES], doubtful: [0; LANES], either: [0; LANES], settled: Lanes::NONE }
    }
}
