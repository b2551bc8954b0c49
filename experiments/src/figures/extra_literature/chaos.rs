//! Chaos under a constant restitution, its end, and orbits of three impacts.

use bouncing_disk::core::{
    BifurcationKind, Branch, ChatterPolicy, Continuation, ContinuationParameter, ImpactMap, ImpactState,
    LyapunovOutcome, Multipliers, Orbit, OrbitSearch, Verdict, lyapunov_spectra, orbit_diagram, verdicts,
};

use super::Answers;
use super::behaviour::{SETTINGS, map_at, starts};
use super::catalogue::Entry;
use super::data::{Answer, rounded};
use super::paper::{crisis_bracket, lost, on_attractor};
use crate::experiment::ExperimentError;

/// The restitution of the paper, where the chaotic range of the forcing is known.
const RESTITUTION: f64 = 0.5;

/// An orbit of three impacts that doubles twice, and whether there is chaos.
pub(super) fn three_and_chaos(entry: &Entry) -> Answers {
    let (found, tried) = three_impacts()?;
    let twice: Vec<&Doubled> = found.iter().filter(|orbit| orbit.twelve.is_some()).collect();
    let shown = twice.first().map_or_else(String::new, |orbit| {
        format!(
            "; r = {}, k = {}: attracts from Γ = {}, doubles to 6 at {}, to 12 at {}",
            orbit.restitution,
            orbit.platform_periods,
            orbit.from.map_or_else(|| "below".to_owned(), |forcing| rounded(forcing, 7)),
            orbit.six.map_or_else(|| "none".to_owned(), |forcing| rounded(forcing, 7)),
            orbit.twelve.map_or_else(|| "none".to_owned(), |forcing| rounded(forcing, 7)),
        )
    });
    let three = Answer::statement(
        !twice.is_empty(),
        format!("{} branches of attracting orbits of three impacts, {} of them double to 6 and to 12{shown}", found.len(), twice.len()),
    )
    .because(format!("parameters are not in the text; looked for from {tried} starts, r from 0.3 to 0.8 and Γ from 0.2 to 1.5"));
    Ok(vec![("three_impacts", three), chaos_answer(entry)?])
}

/// The same question, put as an open problem.
pub(super) fn open_question(entry: &Entry) -> Answers {
    Ok(vec![chaos_answer(entry)?])
}

fn chaos_answer(entry: &Entry) -> Result<(&'static str, Answer), ExperimentError> {
    const NAME: &str = "chaos";
    let (text, positive) = chaos()?;
    let printed = entry.statement(NAME)?.printed.is_some();
    // The statement that is printed is that there is none.
    let answer = if printed { Answer::statement(!positive, text) } else { Answer::nothing_printed(text) };
    Ok((
        NAME,
        answer.because(
            "a computation and no proof: a finite orbit cannot tell an attractor from a long transient",
        ),
    ))
}

/// Exponents on the attractor of the cascade, and whether all are positive.
fn chaos() -> Result<(String, bool), ExperimentError> {
    const FORCINGS: [f64; 3] = [0.545, 0.55, 0.555];
    const IMPACTS: u64 = 100_000;
    let states = on_attractor(RESTITUTION)?;
    let starts: Vec<_> = FORCINGS
        .iter()
        .map(|forcing| Ok((map_at(*forcing, RESTITUTION)?, states[0])))
        .collect::<Result<_, ExperimentError>>()?;
    let outcomes = lyapunov_spectra(&starts, 1_000, IMPACTS)?;
    let mut parts = Vec::new();
    let mut positive = true;
    for (forcing, outcome) in FORCINGS.iter().zip(&outcomes) {
        match outcome {
            LyapunovOutcome::Exponents(spectrum) => {
                positive &= spectrum.largest > 3.0 * spectrum.standard_error;
                parts.push(format!(
                    "{:.4} ± {:.4} at Γ = {forcing}",
                    spectrum.largest, spectrum.standard_error
                ));
            }
            _ => {
                positive = false;
                parts.push(format!("none at Γ = {forcing}"));
            }
        }
    }
    let text = format!(
        "exponents per impact at r = {RESTITUTION}, without a rest in {IMPACTS} impacts: {}",
        parts.join(", ")
    );
    Ok((text, positive))
}

/// A branch of orbits of three impacts.
struct Doubled {
    restitution: f64,
    platform_periods: u64,
    /// Where it begins to attract: a fold, or its end.
    from: Option<f64>,
    six: Option<f64>,
    twelve: Option<f64>,
}

/// Attracting orbits of three impacts, one of each k and restitution, and their doublings.
fn three_impacts() -> Result<(Vec<Doubled>, usize), ExperimentError> {
    const FORCINGS: u32 = 66;
    let mut all = Vec::new();
    for tenth in 3..=8 {
        for step in 0..FORCINGS {
            let forcing = 0.2 + 1.3 * (f64::from(step) + 0.5) / f64::from(FORCINGS);
            all.extend(starts(&map_at(forcing, f64::from(tenth) / 10.0)?, 3)?);
        }
    }
    let mut found: Vec<Doubled> = Vec::new();
    for ((map, _), verdict) in all.iter().zip(verdicts(&all, SETTINGS)?) {
        let Verdict::Periodic { impacts: 3, platform_periods, state, .. } = verdict else { continue };
        let restitution = map.restitution();
        let forcing = map.vibration().axial_forcing();
        let known = found.iter().any(|orbit| {
            orbit.platform_periods == platform_periods
                && (orbit.restitution - restitution).abs() < 1e-9
                && orbit.six.is_none_or(|six| forcing < six)
        });
        if known {
            continue;
        }
        let states = super::behaviour::impacts(map, state, 3)?;
        let orbit = map.refine(&states)?;
        let settings = |rising: bool| Continuation::new(ContinuationParameter::Forcing, (0.1, 2.0), rising);
        let falling = map.continued(&orbit, &settings(false)?)?;
        let rising = map.continued(&orbit, &settings(true)?)?;
        let six = doubling(&rising);
        let twelve = match six {
            Some(index) => {
                let branch = rising.switched(index, &settings(true)?)?;
                doubling(&branch).map(|index| branch.bifurcations[index].point.parameter)
            }
            None => None,
        };
        found.push(Doubled {
            restitution,
            platform_periods,
            from: falling.bifurcations.first().map(|first| first.point.parameter),
            six: six.map(|index| rising.bifurcations[index].point.parameter),
            twelve,
        });
    }
    Ok((found, all.len()))
}

/// The first bifurcation of a branch, if it is a doubling.
fn doubling(branch: &Branch) -> Option<usize> {
    branch.bifurcations.first().filter(|first| first.kind == BifurcationKind::Doubling).map(|_| 0)
}

/// What the attractor of the cascade touches where it is lost.
pub(super) fn mechanism(_: &Entry) -> Answers {
    const BELOW: [f64; 3] = [1.0e-3, 1.0e-4, 1.0e-5];
    const SKIPPED: usize = 1_000;
    const IMPACTS: usize = 20_000;
    let (survived, _) = crisis_bracket(RESTITUTION, 20_000)?;
    let states = on_attractor(RESTITUTION)?;
    let mut touched = Vec::new();
    for below in BELOW {
        let map = map_at(survived - below, RESTITUTION)?;
        let orbits: Vec<Orbit> =
            states.iter().map(|state| map.orbit(*state, ChatterPolicy::Complete)).collect();
        let impacts = orbit_diagram(&orbits, SKIPPED, IMPACTS)?.concat();
        let slowest = impacts.iter().map(|state| -state.velocity()).fold(f64::INFINITY, f64::min);
        touched.push(Touched {
            slowest,
            margin: graze_margin(&map, &impacts)?,
            saddle: nearest_saddle(&map, &impacts)?,
        });
    }
    let listed = |of: fn(&Touched) -> String| touched.iter().map(of).collect::<Vec<_>>().join(", ");
    let margins = if touched.iter().all(|of| of.margin.is_none()) {
        "no gap has a minimum on the way of a flight".to_owned()
    } else {
        let margin = |of: &Touched| of.margin.map_or_else(|| "none".to_owned(), |margin| rounded(margin, 2));
        format!("smallest gap on the way of a flight {} g/ω²", listed(margin))
    };
    let answer = Answer::nothing_printed(format!(
        "1e-3, 1e-4 and 1e-5 below the crisis: slowest impact {} g/ω; {margins}; the nearest saddle with positive multipliers and at most three \
         impacts is {} away",
        listed(|of| rounded(of.slowest, 3)),
        listed(|of| format!("{} ({} in {})", rounded(of.saddle.2, 2), of.saddle.0, of.saddle.1)),
    ))
    .because(
        "an attractor that comes ever nearer to a saddle is what a boundary crisis needs, one that comes to an impact without speed or a gap of \
         zero would graze; extra-crisis has the mechanism itself",
    );
    Ok(vec![("mechanism", answer)])
}

/// What an attractor is near to.
struct Touched {
    /// Units of g/omega.
    slowest: f64,
    /// The smallest minimum of the gap on the way of a flight (g/omega^2); none where no gap has one.
    margin: Option<f64>,
    /// Impacts and periods of the nearest saddle, and its distance.
    saddle: (usize, u64, f64),
}

/// The smallest minimum of the gap on the way of the flights after some of the impacts.
fn graze_margin(map: &ImpactMap, impacts: &[ImpactState]) -> Result<Option<f64>, ExperimentError> {
    const EVERY: usize = 8;
    let mut least = f64::INFINITY;
    for state in impacts.iter().step_by(EVERY) {
        let impact = map.step(*state)?;
        least = least.min(map.vibration().graze_margin(map.rebound(*state), &impact));
    }
    Ok(least.is_finite().then_some(least))
}

/// The nearest saddle with positive multipliers that the attractor does not visit: impacts, periods, and its distance.
fn nearest_saddle(map: &ImpactMap, impacts: &[ImpactState]) -> Result<(usize, u64, f64), ExperimentError> {
    let search = OrbitSearch::new(3, 4)?.with_starts(32, 32)?;
    let peak = map.vibration().peak_acceleration();
    let mut nearest: Option<(usize, u64, f64)> = None;
    for orbit in map.periodic_orbits(&search)?.orbits {
        let saddle = matches!(orbit.multipliers(), Multipliers::Real(large, _) if large > 1.0);
        if !saddle {
            continue;
        }
        let distance = impacts.iter().map(|state| orbit.distance(*state, peak)).fold(f64::INFINITY, f64::min);
        if nearest.is_none_or(|(_, _, known)| distance < known) {
            nearest = Some((orbit.period(), orbit.platform_periods, distance));
        }
    }
    nearest.ok_or_else(|| lost("saddle"))
}
