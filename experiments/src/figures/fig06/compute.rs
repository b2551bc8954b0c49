//! The diagrams: following the period-1 attractor, and the chattering orbit from rest.

use std::f64::consts::PI;

use bouncing_disk::core::chaos::lyapunov_exponents;
use bouncing_disk::core::orbits::{Followed, doubling_cascade, follow_attractor};
use bouncing_disk::core::sweep::orbit_diagram;
use bouncing_disk::core::{ImpactState, Launch, Unobserved};
use bouncing_disk::motion::PAPER_CHATTER;
use bouncing_disk::toss::{ChatteringCycle, MultiTossSettings};

use super::data::{
    BestLag, Bouncing, Column, Fig06Data, ForcingEffect, Merging, SingleTosses, Slice, Transfer,
};
use super::slices::{Inputs, branch_crossings, followed_slice, forcing_effect, no_orbit};
use super::{chattering, contact, explored, period_one};
use crate::claims::paper::{self, SectionFour};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::shared::map_in_parallel;
use crate::figures::shared::{FORCING_RANGE, map};
use crate::progress::Progress;

/// Impacts after which the motion of a disk that has not come to rest is recorded.
const SETTLING: usize = 20_000;
/// Longest period (impacts) of an orbit that it may have settled on, and how well two rounds of it agree.
const LONGEST_PERIOD: usize = 256;
/// See [`LONGEST_PERIOD`].
const REPEATS_WITHIN: f64 = 1.0e-6;
/// Number of values of Γ, of the followed attractor and of the disk from rest, at which transfers and lags
/// are computed.
const SAMPLED: usize = 40;
/// Impacts that a search for the best lag discards: more than the rotation takes to settle at Γ_T = 100.
const LAG_TRANSIENT: usize = 300;
/// Impacts over which a Lyapunov exponent is taken.
const GROWTH_IMPACTS: usize = 4_000;

fn settings(quality: Quality) -> MultiTossSettings {
    MultiTossSettings {
        policy: PAPER_CHATTER,
        transient_impacts: quality.choose(1_000, 3_000),
        examined_impacts: quality.choose(100, 300),
        longest_period: quality.choose(50, 128),
        tolerance: 1.0e-7,
    }
}

pub(super) fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig06Data, ExperimentError> {
    let section = paper::section_four()?;
    let inputs = Inputs::from(&section);
    let Inputs { restitution, followed_from, linear, semielliptical } = inputs;
    let values = quality.choose(200, 2_000);
    let settings = settings(quality);
    let forcings: Vec<f64> = (0..values)
        .map(|i| {
            let (low, high) = FORCING_RANGE;
            low + (high - low) * i as f64 / (values - 1) as f64
        })
        .collect();
    progress.start(2 * values as u64, "orbits");
    let first_map = map(followed_from, restitution)?;
    let first = first_map.period_one(1).ok_or_else(|| no_orbit(followed_from))?;
    let first_orbit = first_map.refine(&[first])?;
    let diagrams = Diagrams::of(&forcings, first, inputs, settings, progress)?;
    progress.start(3, "searches");
    let not_chattering: Vec<f64> = forcings
        .iter()
        .zip(&diagrams.chattering)
        .filter(|(forcing, slice)| **forcing * PI > 1.0 && slice.is_none())
        .map(|(forcing, _)| *forcing)
        .collect();
    let not_chattering = map_in_parallel(&not_chattering, |forcing| bouncing(*forcing, restitution))?;
    let Searches { merging, single_tosses, doublings, zoom } =
        Searches::of(&diagrams, &section, settings, quality, progress)?;
    let last = doublings.last().copied().unwrap_or(f64::NAN);
    let chaotic: Vec<&Followed> =
        diagrams.on_attractor().iter().filter(|at| at.axial_forcing > last).collect();
    let lyapunov_exponents = exponents(&chaotic)?;
    let crisis = merging.axial_forcing();
    let impacts: Vec<(f64, Option<usize>)> =
        diagrams.cycles.iter().map(|(forcing, cycle)| (*forcing, cycle.map(|cycle| cycle.impacts))).collect();
    let explored = explored::explored(first, inputs, &merging, &impacts)?;
    let resting: Vec<f64> = sampled(SAMPLED, &diagrams.resting());
    let chatters = chattering::chatters(&resting, restitution)?;
    let forcing_effects = diagrams.forcing_effects(doublings.get(1).copied(), crisis, inputs, settings)?;
    let (transfers, best_lags) = along_the_diagram(&diagrams, &chaotic, crisis, inputs, settings)?;
    let one_impact_decides = explored::one_impact_decides(crisis, restitution, quality)?;
    let period_one_threshold = period_one::threshold(inputs, first)?;
    let branch_crossings = branch_crossings(&diagrams.followed, &doublings);
    let at_doubling = doublings.first().copied().unwrap_or(f64::NAN);
    let phase = map(at_doubling, restitution)?.period_one(1).ok_or_else(|| no_orbit(at_doubling))?.phase();
    Ok(Fig06Data {
        restitution,
        axial_forcing_range: FORCING_RANGE,
        basin_axial_forcings: section.axial_forcings_of_fig7,
        axial_forcing_values: values,
        transient_impacts: settings.transient_impacts,
        examined_impacts: settings.examined_impacts,
        linear,
        semielliptical,
        followed_from,
        followed: diagrams.followed,
        chattering: diagrams.chattering.into_iter().flatten().collect(),
        not_chattering,
        zoom,
        doublings,
        period_one_threshold,
        phase_at_first_doubling_rad: phase.angle(),
        multiplier_where_followed_from: bouncing_disk::core::orbits::Multipliers::of(first_orbit.monodromy)
            .spectral_radius(),
        merging,
        single_tosses,
        chatters,
        forcing_effects,
        branch_crossings,
        lyapunov_exponents,
        period_one: period_one::period_one(inputs)?,
        motions: contact::motions(&section.axial_forcings_of_fig7, inputs)?,
        dimension: contact::dimension()?,
        torque_ratios: contact::torque_ratios()?,
        transfers,
        motor_share_in_impacts: contact::motor_transfer()?,
        explored,
        best_lags,
        one_impact_decides,
    })
}

/// So many of all, or some more, evenly.
fn sampled<T: Copy>(count: usize, all: &[T]) -> Vec<T> {
    all.iter().copied().step_by((all.len() / count).max(1)).collect()
}

/// Γ and the Lyapunov exponent of each orbit that has one.
fn exponents(chaotic: &[&Followed]) -> Result<Vec<(f64, f64)>, ExperimentError> {
    let orbits: Vec<_> = chaotic.iter().map(|at| (at.map, at.state)).collect();
    let growths = lyapunov_exponents(&orbits, 0, GROWTH_IMPACTS, &Unobserved)?;
    Ok(chaotic.iter().zip(growths).filter_map(|(at, growth)| Some((at.axial_forcing, growth?))).collect())
}

/// The attractor that is followed in Γ, and the chattering orbit.
struct Diagrams {
    first: ImpactState,
    /// Where each Γ left the orbit, as far as the run on the way could follow it.
    walk: Vec<Followed>,
    /// As far as the longer run found the attractor.
    followed: Vec<Slice>,
    /// At each Γ; `None` where a disk from rest does not chatter.
    cycles: Vec<(f64, Option<ChatteringCycle>)>,
    chattering: Vec<Option<Slice>>,
}

impl Diagrams {
    fn of(
        forcings: &[f64],
        first: ImpactState,
        inputs: Inputs,
        settings: MultiTossSettings,
        progress: &dyn Progress,
    ) -> Result<Self, ExperimentError> {
        let Inputs { restitution, followed_from, .. } = inputs;
        let above = forcings.iter().copied().filter(|forcing| *forcing >= followed_from);
        let walk: Vec<Followed> =
            follow_attractor(restitution, above, first, settings.transient_impacts, PAPER_CHATTER)
                .collect::<Result<_, _>>()?;
        progress.advance((forcings.len() - walk.len()) as u64);
        let followed = map_in_parallel(&walk, |followed| {
            let slice = followed_slice(followed, inputs, settings);
            progress.advance(1);
            slice
        })?;
        // The attractor is lost where its orbit comes to rest in the longer run, too.
        let followed: Vec<Slice> = followed.into_iter().map_while(|slice| slice).collect();
        let cycles = chattering::cycles(forcings, restitution, settings.policy)?;
        let cycles: Vec<_> = forcings.iter().copied().zip(cycles).collect();
        let chattering = map_in_parallel(&cycles, |&(forcing, cycle)| {
            let slice = chattering::chattering_slice(forcing, cycle, inputs, settings);
            progress.advance(1);
            slice
        })?;
        Ok(Self { first, walk, followed, cycles, chattering })
    }

    /// The Γ at which a disk from rest comes to rest again.
    fn resting(&self) -> Vec<f64> {
        self.cycles.iter().filter(|(_, cycle)| cycle.is_some()).map(|(forcing, _)| *forcing).collect()
    }

    /// The effect of Γ_T on the rotation from the period-4 bifurcation on: for the followed attractor, and
    /// beyond the crisis for the disk from rest.
    fn forcing_effects(
        &self,
        period_four: Option<f64>,
        crisis: f64,
        inputs: Inputs,
        settings: MultiTossSettings,
    ) -> Result<Vec<ForcingEffect>, ExperimentError> {
        let inputs = inputs.exchanged();
        let period_four = period_four.unwrap_or(f64::NAN);
        let followed = self.on_attractor().iter().zip(&self.followed);
        let followed: Vec<_> = followed.filter(|(at, _)| at.axial_forcing > period_four).collect();
        let beyond = self.cycles.iter().zip(&self.chattering).filter(|((forcing, _), _)| *forcing > crisis);
        let beyond: Vec<_> = beyond.filter_map(|(at, drawn)| Some((at, drawn.as_ref()?))).collect();
        let of_followed = map_in_parallel(&sampled(SAMPLED, &followed), |(at, drawn)| {
            let exchanged = followed_slice(at, inputs, settings)?;
            Ok(exchanged.and_then(|exchanged| forcing_effect(drawn, &exchanged)))
        })?;
        let of_resting = map_in_parallel(&sampled(SAMPLED, &beyond), |((forcing, cycle), drawn)| {
            let exchanged = chattering::chattering_slice(*forcing, *cycle, inputs, settings)?;
            Ok(exchanged.and_then(|exchanged| forcing_effect(drawn, &exchanged)))
        })?;
        Ok(of_followed.into_iter().chain(of_resting).flatten().collect())
    }

    /// The walk where it is on the attractor.
    fn on_attractor(&self) -> &[Followed] {
        &self.walk[..self.followed.len()]
    }
}

/// The results of bisections and of further orbits.
struct Searches {
    merging: Merging,
    single_tosses: SingleTosses,
    doublings: Vec<f64>,
    zoom: Vec<Column>,
}

impl Searches {
    /// Side by side, for in most of them one step follows from another.
    fn of(
        diagrams: &Diagrams,
        section: &SectionFour,
        settings: MultiTossSettings,
        quality: Quality,
        progress: &dyn Progress,
    ) -> Result<Self, ExperimentError> {
        let inputs = Inputs::from(section);
        let Diagrams { first, walk, cycles, .. } = diagrams;
        let crisis = || explored::merging(*first, inputs, quality.choose(40_000, 400_000));
        let others = || -> Result<_, ExperimentError> {
            let single_tosses = chattering::single_tosses(cycles, section, settings.policy)?;
            progress.advance(1);
            let doublings = doubling_cascade(inputs.restitution, 7, &Unobserved)?.complete()?;
            progress.advance(1);
            let below = walk.iter().rev().find(|at| at.axial_forcing <= explored::ZOOM.0);
            let zoom = explored::zoom(below.map_or(*first, |at| at.state), inputs, quality)?;
            Ok((single_tosses, doublings, zoom))
        };
        let (merging, others) = rayon::join(crisis, others);
        let (merging, (single_tosses, doublings, zoom)) = (merging?, others?);
        progress.advance(1);
        let doublings: Vec<f64> = doublings.into_iter().map(|doubling| doubling.axial_forcing).collect();
        Ok(Self { merging, single_tosses, doublings, zoom })
    }
}

/// The transfers of angular momentum and the best lags, evenly over the diagram: of the followed attractor,
/// and of the disk from rest, all along and beyond the crisis.
fn along_the_diagram(
    diagrams: &Diagrams,
    chaotic: &[&Followed],
    crisis: f64,
    inputs: Inputs,
    settings: MultiTossSettings,
) -> Result<(Vec<Transfer>, Vec<BestLag>), ExperimentError> {
    let states: Vec<(f64, ImpactState)> =
        diagrams.on_attractor().iter().map(|at| (at.axial_forcing, at.state)).collect();
    let resting = sampled(SAMPLED, &diagrams.resting());
    let transfers = contact::transfers(&sampled(SAMPLED, &states), &resting, inputs)?;
    let beyond: Vec<f64> = resting.iter().copied().filter(|forcing| *forcing > crisis).collect();
    let beyond = sampled(SAMPLED / 4, &beyond);
    let lag_settings = MultiTossSettings { transient_impacts: LAG_TRANSIENT, ..settings };
    let chaotic: Vec<(f64, ImpactState)> = chaotic.iter().map(|at| (at.axial_forcing, at.state)).collect();
    let lagged: Vec<_> =
        sampled(SAMPLED / 4, &states).into_iter().chain(sampled(SAMPLED / 4, &chaotic)).collect();
    Ok((transfers, explored::best_lags(&lagged, &beyond, inputs, lag_settings)?))
}

/// The motion on which a disk from rest settles if it does not come to rest again.
fn bouncing(axial_forcing: f64, restitution: f64) -> Result<Bouncing, ExperimentError> {
    let map = map(axial_forcing, restitution)?;
    let mut period = None;
    if let Some(leaves) = map.vibration().separation_phase() {
        let orbit = map.orbit_from_launch(Launch::new(leaves, 0.0)?, PAPER_CHATTER);
        let settled = orbit_diagram(&[orbit], SETTLING, 1, &Unobserved)?;
        if let Some(state) = settled.first().and_then(|states| states.first()) {
            period = map.period_of(*state, LONGEST_PERIOD, REPEATS_WITHIN)?;
        }
    }
    Ok(Bouncing { axial_forcing, period })
}
