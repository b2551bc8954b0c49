//! What Liu, Friend and Yeo print on the cascade and its end.

use bouncing_disk::core::numerics::roots::bracket_of_width;
use bouncing_disk::core::{
    BifurcationKind, ChatterPolicy, Continuation, ContinuationParameter, Error, ImpactState,
    doubling_cascade, follow_attractor, survival_times,
};

use super::behaviour::map_at;
use super::catalogue::Entry;
use super::data::{Answer, Judgement, rounded};
use super::{Answers, rounds_to_printed};
use crate::experiment::ExperimentError;

/// The forcings of the first five doublings.
pub(super) fn doublings(entry: &Entry) -> Answers {
    const NAMES: [&str; 5] = ["doubling_1", "doubling_2", "doubling_3", "doubling_4", "doubling_5"];
    let cascade = doubling_cascade(entry.input("restitution")?, NAMES.len())?;
    let answers = NAMES.into_iter().zip(cascade).map(|(name, found)| {
        let answer = rounds_to_printed(entry, name, found.axial_forcing)?;
        let distance = found.axial_forcing - entry.printed(name)?.value;
        Ok((
            name,
            match answer.judgement {
                Judgement::Agrees => answer,
                _ => answer.because(format!(
                    "by {distance:.0e}, while rounding moves it by {:.0e} at most: see the errata on Fig. 6",
                    found.forcing_error
                )),
            },
        ))
    });
    answers.collect()
}

/// Birth and end of the period-1 orbit, from its branch.
pub(super) fn period_one(entry: &Entry) -> Answers {
    let map = map_at(0.4, entry.input("restitution")?)?;
    let orbit = map.refine(&[map.period_one(1).ok_or_else(|| lost("period-1 orbit"))?])?;
    let special = |rising: bool, kind: BifurcationKind| {
        let settings = Continuation::new(ContinuationParameter::Forcing, (0.1, 0.6), rising)?;
        let branch = map.continued(&orbit, &settings)?;
        let found = branch.of_kind(kind).next().map(|found| found.point.clone());
        found.ok_or_else(|| lost("bifurcation of the period-1 orbit"))
    };
    let (birth, end) = (special(false, BifurcationKind::Fold)?, special(true, BifurcationKind::Doubling)?);
    let phase = |point: &bouncing_disk::core::BranchPoint| point.orbit.states[0].phase().cycles();
    let at_birth = phase(&birth).min(1.0 - phase(&birth));
    Ok(vec![
        ("birth", rounds_to_printed(entry, "birth", birth.parameter)?),
        ("end", rounds_to_printed(entry, "end", end.parameter)?),
        (
            "phase_at_birth",
            Answer::statement(at_birth < 1e-6, "0")
                .with_value(at_birth)
                .because("at the fold, where the phase changes like the root of the forcing's distance"),
        ),
        ("phase_at_end", rounds_to_printed(entry, "phase_at_end", phase(&end))?),
    ])
}

/// Where the attractor of the cascade is lost to chattering.
pub(super) fn crisis(entry: &Entry) -> Answers {
    const IMPACTS: usize = 50_000;
    let (survived, lost) = crisis_bracket(entry.input("restitution")?, IMPACTS)?;
    let middle = 0.5 * (survived + lost);
    let answer = rounds_to_printed(entry, "crisis", middle)?.because(format!(
        "{STARTS} orbits on the attractor live for {IMPACTS} impacts each at {}, and not at {}",
        rounded(survived, 7),
        rounded(lost, 7)
    ));
    Ok(vec![("crisis", answer)])
}

/// Orbits that must survive.
const STARTS: usize = 8;
/// Where the attractor is chaotic and safe, and where it is long gone.
const SAFE: f64 = 0.5555;
const GONE: f64 = 0.567;
const BRACKET: f64 = 1.0e-6;

/// States on the attractor of the cascade well before its end.
pub(super) fn on_attractor(restitution: f64) -> Result<Vec<ImpactState>, ExperimentError> {
    let first = map_at(0.45, restitution)?.period_one(1).ok_or_else(|| lost("period-1 orbit"))?;
    let forcings = (0..).map(|step| 0.45 + 5.0e-4 * f64::from(step)).take_while(|forcing| *forcing < SAFE);
    let mut state = first;
    for followed in follow_attractor(restitution, forcings, first, 300, ChatterPolicy::Complete) {
        state = followed?.state;
    }
    let map = map_at(SAFE, restitution)?;
    let mut states = Vec::new();
    for _ in 0..STARTS {
        let next = map.state_after(state, 1_000, ChatterPolicy::Complete)?;
        state = next.ok_or_else(|| lost("attractor of the cascade"))?;
        states.push(state);
    }
    Ok(states)
}

/// The last forcing at which all orbits survive so many impacts, and the first at which one is lost.
pub(super) fn crisis_bracket(restitution: f64, impacts: usize) -> Result<(f64, f64), ExperimentError> {
    let starts = on_attractor(restitution)?;
    bracket_of_width(SAFE, GONE, BRACKET, |forcing| {
        let map = map_at(forcing, restitution)?;
        let orbits: Vec<_> = starts.iter().map(|start| map.orbit(*start, ChatterPolicy::Complete)).collect();
        Ok(survival_times(&orbits, impacts)?.into_iter().all(|lived| lived == impacts))
    })
}

/// The error of an orbit that is known to exist and was not found.
pub(super) fn lost(what: &'static str) -> ExperimentError {
    ExperimentError::model(Error::NotSettled { what, iterations: 0, residual: 0.0 })
}
