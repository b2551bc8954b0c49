//! A witness that follows one orbit until there is a verdict.
//!
//! On a drive the rounding error of a cycle is the sum of the solver's bounds, each magnified, plus 1e-9 rad
//! for the phase of separation; it is 1 if a graze is in doubt. A kick counts as an impact.
//!
//! A cycle that cannot end within the allowed impacts is called chaotic; its number of rests shows where it
//! began. In a window whose period exceeds the longest one searched for, the exponent is negative and the
//! motion undecided.

use core::f64::consts::PI;
use core::ops::ControlFlow;

use super::proof::{Proof, prove};
use super::returns::Returns;
use super::{CycleTrust, RestCycle, UndecidedReason, Verdict, VerdictSettings};
use crate::chatter::accumulation::Accumulation;
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::{Attachment, ImpactState};
use crate::numerics::batch_means::BatchMeans;
use crate::numerics::elementary::{exp, ln};
use crate::orbits::periodic::{Stability, phase_difference};
use crate::sweep::bouncing_map::{BouncingMap, DISSIPATION_TIMES};
use crate::sweep::lyapunov::{LyapunovEstimate, TangentGrowth};
use crate::sweep::{SweepEvent, SweepImpact};

/// A flight is long if it lasts longer than this (rad), half a period of the platform.
const LONG_FLIGHT: f64 = PI;

/// The largest rounding error (rad and g/omega) of a cycle that counts as exact: a thousandth of the size of
/// the motion. The neglected higher-order terms are then a thousandth of this error.
const TRUSTED_ROUNDING: f64 = 1.0e-3;

/// The course of the motion since the disk separated from rest.
#[derive(Debug, Clone)]
struct Round {
    /// The phase of the separation.
    from: Phase,
    /// Impacts before the separation.
    before: u64,
    /// Impacts since then, including a kick.
    impacts: u64,
    long_flights: u64,
    turns: u64,
    /// Logarithms of the growth of a perturbation by each flight after the first impact.
    growth: BatchMeans,
    /// Whether all these logarithms are known.
    is_known: bool,
    /// The error of the last impact, and the largest so far.
    rounding: f64,
    worst_rounding: f64,
}

impl Round {
    fn new(from: Phase, before: u64, kicks: u64) -> Self {
        Self {
            from,
            before,
            impacts: kicks,
            long_flights: 0,
            turns: 0,
            growth: LyapunovEstimate::growths(),
            is_known: true,
            rounding: 0.0,
            worst_rounding: 0.0,
        }
    }

    fn see(&mut self, impact: &SweepImpact) {
        self.turns += impact.turns;
        self.long_flights += u64::from(impact.duration > LONG_FLIGHT);
    }

    /// Takes the logarithm of the growth by a flight, and the error of its impact; the first flight has no
    /// growth.
    fn grow(&mut self, growth: f64, error: f64) {
        self.growth.push(growth);
        self.round(exp(growth), error);
    }

    /// Multiplies the earlier error by the growth, and adds the error of this impact.
    fn round(&mut self, growth: f64, error: f64) {
        self.rounding = self.rounding * growth + error;
        // This also holds for NaN.
        let told = if self.rounding < 1.0 { self.rounding } else { 1.0 };
        self.worst_rounding = self.worst_rounding.max(told);
    }
}

/// Phase difference (rad) below which two separations are the same.
const SAME_SEPARATION: f64 = 1.0e-9;

/// An orbit that returns to within this (rad, and relative speed) is on a periodic orbit, even if its
/// perturbations grow: on a chaotic orbit only about one in 1e8 of the compared pairs of impacts is this
/// close.
const ON_AN_ORBIT: f64 = 1.0e-9;

/// An orbit on the way to its verdict.
#[derive(Debug, Clone)]
pub(crate) struct Witness<'m, M> {
    map: &'m M,
    settings: VerdictSettings,
    state: ImpactState,
    /// Impacts since the start or since the last separation, and earlier ones.
    impacts: u64,
    before: u64,
    returns: Returns,
    /// The growth of a perturbation, from the end of the transient or from the first impact after a rest.
    tangent: TangentGrowth,
    /// The logarithms of the growth after the transient, and the turns of the phase.
    growth: BatchMeans,
    turns: u64,
    /// The logarithm of the contraction of areas since then, on maps that do not contract areas by the
    /// squared restitution at each impact.
    shrunk: f64,
    grazed: Option<(u64, Phase)>,
    /// The phase at which a disk came to rest that has not separated since, and its error.
    attached: Option<(Phase, f64)>,
    round: Option<Round>,
    /// The earlier rounds; empty if the disk always leaves the platform at one phase.
    earlier: Vec<Round>,
    verdict: Option<Verdict>,
}

impl<'m, M: BouncingMap> Witness<'m, M> {
    pub(crate) fn new((map, state): (&'m M, ImpactState), settings: VerdictSettings) -> Self {
        Self {
            map,
            settings,
            state,
            impacts: 0,
            before: 0,
            returns: Returns::new(),
            tangent: TangentGrowth::default(),
            growth: LyapunovEstimate::growths(),
            turns: 0,
            shrunk: 0.0,
            grazed: None,
            attached: None,
            round: None,
            earlier: Vec::new(),
            verdict: None,
        }
    }

    /// Receives the next event of the orbit.
    pub(crate) fn see(&mut self, event: &SweepEvent) -> ControlFlow<()> {
        match event {
            SweepEvent::Impact(impact) => self.impact(impact),
            SweepEvent::Attachment(rest) => self.rest(rest),
            SweepEvent::Separation(change) => self.separates(change.phase, change.turns, 0),
            SweepEvent::Kick(change) => self.separates(change.phase, change.turns, 1),
        }
        if self.verdict.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// The verdict, once the orbit has been followed far enough.
    pub(crate) fn verdict(self) -> Verdict {
        // An orbit ends without a verdict if the disk stays on the platform, perhaps without an impact or a
        // chatter.
        let (phase, error) = self.attached.unwrap_or((self.state.phase(), 0.0));
        let after = self.before + self.impacts;
        self.verdict.unwrap_or(if error.is_finite() || self.map.shrinks_areas_exactly() {
            Verdict::AtRest { phase, after }
        } else {
            Verdict::Undecided { reason: UndecidedReason::RestNotProven { phase, after }, rests: 1 }
        })
    }

    fn impact(&mut self, impact: &SweepImpact) {
        let (from, state) = (self.state, impact.state);
        self.state = state;
        self.impacts += 1;
        let counts = self.impacts > self.settings.transient;
        if counts {
            self.turns += impact.turns;
        }
        if let Some(round) = &mut self.round {
            round.see(impact);
        }
        self.grow(from, impact, counts);
        if let Some(period) = self.returns.see(state, impact.turns, &self.settings) {
            self.verdict = self.periodic(period, Stability::Marginal);
            if self.verdict.is_none() {
                self.returns.reject();
            }
        }
        if self.verdict.is_none() && self.impacts >= self.settings.allowed() {
            self.verdict = Some(self.conclusion());
        }
    }

    /// Follows a perturbation through the flight between two impacts.
    #[inline]
    fn grow(&mut self, from: ImpactState, impact: &SweepImpact, counts: bool) {
        if self.grazed.is_some() || !(counts || self.round.is_some()) {
            return;
        }
        let state = impact.state;
        if self.round.is_some() && self.impacts == 1 {
            // The error of the state in which the disk left the platform.
            let error = self.map.separation_error() + f64::EPSILON * (1.0 + state.velocity().abs());
            if let Some(round) = &mut self.round {
                round.round(0.0, error);
            }
            return;
        }
        let (derivative, error) = self.map.derivative(from, state, impact.duration);
        let growth = self.tangent.grow(derivative);
        if let Some(round) = &mut self.round {
            round.grow(growth, error);
        }
        if counts {
            self.growth.push(growth);
            if !self.map.shrinks_areas_exactly() {
                self.shrunk -= ln(derivative.determinant().abs());
            }
        }
        if !self.tangent.is_bounded() {
            self.grazed = Some((self.before + self.impacts, state.phase()));
            // The growth of the following flights is unknown.
            if let Some(round) = &mut self.round {
                round.worst_rounding = 1.0;
            }
        }
    }

    fn rest(&mut self, rest: &Attachment) {
        let Accumulation { phase, error_bound, .. } = rest.accumulation;
        self.attached = Some((phase, error_bound));
        if let Some(round) = &mut self.round {
            round.turns += rest.accumulation.turns;
        }
        if let Some((separation, turns)) = rest.separation {
            self.separates(separation, turns, 0);
        }
    }

    /// The disk leaves the platform, after `turns` of the phase in contact; a kick counts as an impact.
    fn separates(&mut self, phase: Phase, turns: u64, kicks: u64) {
        if let Some(mut round) = self.round.take() {
            round.turns += turns;
            round.impacts += self.impacts;
            round.is_known &= self.grazed.is_none();
            self.earlier.push(round);
        }
        let same =
            |round: &Round| phase_difference(round.from.angle(), phase.angle()).abs() <= SAME_SEPARATION;
        if let Some(first) = self.earlier.iter().position(same) {
            // If the phases lie on either side of the seam, the turn between them belongs to neither.
            let seam = phase.angle() - self.earlier[first].from.angle();
            if let Some(last) = self.earlier.last_mut() {
                last.turns = last.turns.saturating_add_signed(i64::from(seam > PI) - i64::from(seam < -PI));
            }
            let after = self.earlier[first].before;
            self.verdict = Some(Verdict::Chattering { cycle: cycle(&self.earlier[first..]), after });
            return;
        }
        // From here on nothing depends on the past.
        let (after, earlier) = (self.before + self.impacts, core::mem::take(&mut self.earlier));
        let start = (self.map, ImpactState::of_impact(phase, 0.0));
        let round = Some(Round::new(phase, after, kicks));
        *self = Self { before: after, round, earlier, ..Self::new(start, self.settings) };
    }

    /// The number of times the disk has come to rest.
    const fn rests(&self) -> u64 {
        self.round.is_some() as u64
    }

    /// The verdict if the orbit approaches an attracting one of this period, or stays at one no less stable
    /// than `least`.
    fn periodic(&self, period: usize, least: Stability) -> Option<Verdict> {
        let proof = prove(self.map, self.state, period, &self.settings)?;
        let Proof { orbit, distance, stability } = proof;
        let (impacts, platform_periods) = (orbit.period() as u64, orbit.platform_periods);
        let (multipliers, state, rests) = (orbit.multipliers(), *orbit.states.first()?, self.rests());
        let after = self.before + self.impacts;
        if stability == Stability::Stable {
            let verdict =
                Verdict::Periodic { impacts, platform_periods, multipliers, state, distance, after, rests };
            return Some(verdict);
        }
        let reason = UndecidedReason::OnPeriodicOrbit {
            impacts,
            platform_periods,
            multipliers,
            multiplier_error: orbit.multiplier_error(),
            state,
        };
        (stability <= least).then_some(Verdict::Undecided { reason, rests })
    }

    /// The verdict on an orbit that has used up its impacts.
    fn conclusion(&self) -> Verdict {
        let rests = self.rests();
        if let Some((impacts, phase)) = self.grazed {
            return Verdict::Undecided { reason: UndecidedReason::Grazing { impacts, phase }, rests };
        }
        // There are at least 64 impacts.
        let nothing = LyapunovEstimate { exponent: 0.0, standard_error: 0.0, impacts: self.impacts };
        let estimate = LyapunovEstimate::of(&self.growth).unwrap_or(nothing);
        let LyapunovEstimate { exponent, standard_error, impacts } = estimate;
        // A slowly approaching orbit has not returned to within the tolerance; one that started on a
        // repelling orbit may have stayed there.
        let nearest = self.returns.nearest();
        let nearest = nearest.filter(|(distance, _)| !estimate.grows() || *distance <= ON_AN_ORBIT);
        if let Some(verdict) = nearest.and_then(|(_, period)| self.periodic(period, Stability::Unstable)) {
            return verdict;
        }
        let needed = if self.map.shrinks_areas_exactly() {
            self.map.transient_impacts()
        } else {
            DISSIPATION_TIMES * impacts as f64 / self.shrunk.max(f64::MIN_POSITIVE)
        };
        let reason = if estimate.grows() && (self.impacts as f64) < needed {
            UndecidedReason::TransientMayLast { exponent, standard_error, needed }
        } else if estimate.grows() {
            let platform_periods = self.turns;
            return Verdict::Chaotic { exponent, standard_error, impacts, platform_periods, rests };
        } else if estimate.shrinks() {
            UndecidedReason::NoPeriodFound { exponent, standard_error }
        } else {
            UndecidedReason::ExponentNearZero { exponent, standard_error }
        };
        Verdict::Undecided { reason, rests }
    }
}

/// The cycle that repeats after these rounds.
fn cycle(rounds: &[Round]) -> RestCycle {
    let sum = |of: fn(&Round) -> u64| rounds.iter().map(of).sum();
    let mut worst = &rounds[0];
    for round in &rounds[1..] {
        if round.worst_rounding > worst.worst_rounding {
            worst = round;
        }
    }
    let rounding_error = worst.worst_rounding;
    let trust = if rounding_error <= TRUSTED_ROUNDING {
        CycleTrust::Exact
    } else {
        let measured = |value: Option<f64>| value.filter(|_| worst.is_known);
        let exponent = measured(worst.growth.mean());
        CycleTrust::ChosenByRounding { exponent, standard_error: measured(worst.growth.standard_error()) }
    };
    RestCycle {
        impacts: sum(|round| round.impacts),
        platform_periods: sum(|round| round.turns),
        long_flights: sum(|round| round.long_flights),
        rounding_error,
        trust,
    }
}
