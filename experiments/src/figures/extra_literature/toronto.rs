//! What the program of the University of Toronto states of its parameters.

use std::f64::consts::TAU;

use bouncing_disk::core::{
    BifurcationKind, Continuation, ContinuationParameter, CycleTrust, ImpactMap, Verdict, VerdictSettings,
};

use super::Answers;
use super::behaviour::{Behaviour, Behaviours, behaviours, behaviours_of, counted, map, verdicts_after_rest};
use super::catalogue::Entry;
use super::data::{Answer, rounded};
use super::windows::{Window, cosine_at_doubling};
use crate::claim::Cases;
use crate::experiment::ExperimentError;

/// The standard value; the program's own is read as 9.8 m/s², and the text does not say it.
const OTHER_GRAVITY_M_PER_S2: f64 = 9.81;
/// Values of g from the program's to the other one.
const GRAVITIES: u32 = 21;

/// Birth and stability of the orbits with one impact, for all restitutions and k.
pub(super) fn one_impact(_: &Entry) -> Answers {
    let (mut largest, mut branches) = (0.0_f64, 0);
    for tenth in 1..=9 {
        let restitution = f64::from(tenth) / 10.0;
        for k in 1..=3 {
            let window = Window::of(restitution, k);
            let start = map(0.5 * (window.birth + window.doubling), restitution)?;
            let pair = start.period_one_pair(k.into()).ok_or_else(|| super::paper::lost("period-1 orbit"))?;
            let Some(orbit) = pair.node.orbit(&start)? else { continue };
            let range = (0.5 * window.birth / std::f64::consts::PI, window.doubling);
            let falling = Continuation::new(ContinuationParameter::Forcing, range, false)?;
            let branch = start.continued(&orbit, &falling)?;
            let Some(fold) = branch.of_kind(BifurcationKind::Fold).next() else { continue };
            let at_birth = window.birth / (std::f64::consts::PI * fold.point.parameter);
            (largest, branches) = (largest.max((at_birth - 1.0).abs()), branches + 1);
        }
    }
    let birth =
        Answer::statement(branches > 0 && largest < 1e-9, format!("K = 1 at the fold, to {largest:.0e}"))
            .because(format!("{branches} branches, r from 0.1 to 0.9 and k up to 3"));
    let bounds: Vec<String> = [0.2, 0.3, 0.6, 0.95]
        .iter()
        .map(|&restitution| format!("{} at r = {restitution}", rounded(cosine_at_doubling(restitution), 4)))
        .collect();
    let stability = Answer::not_comparable(format!("for K above {}", bounds.join(", "))).because(
        "\"a bit\" is no number; K is the cosine of the impact phase, and towards r = 1 nearly all K from 0 to 1 attract",
    );
    Ok(vec![("birth", birth), ("stability", stability)])
}

/// P of an amplitude and a frequency, in the program's gravity and in all up to the standard one.
fn peaks(amplitude_m: f64, frequency_hz: f64, gravity_m_per_s2: f64) -> Vec<f64> {
    let angular = TAU * frequency_hz;
    let peak = |index: u32| {
        let share = f64::from(index) / f64::from(GRAVITIES - 1);
        amplitude_m * angular * angular
            / (gravity_m_per_s2 + (OTHER_GRAVITY_M_PER_S2 - gravity_m_per_s2) * share)
    };
    (0..GRAVITIES).map(peak).collect()
}

/// Whether an orbit with one impact attracts.
pub(super) fn stable_orbit(entry: &Entry) -> Answers {
    let restitution = entry.input("restitution")?;
    let periods = entry.input("platform_periods")?;
    let k = periods as u32;
    let window = Window::of(restitution, k);
    let peaks =
        peaks(entry.input("amplitude_m")?, entry.input("frequency_hz")?, entry.input("gravity_m_per_s2")?);
    let stable = |peak: f64| -> Result<bool, ExperimentError> {
        let map = map(peak, restitution)?;
        let Some(pair) = map.period_one_pair(k.into()) else { return Ok(false) };
        Ok(pair.node.multipliers().spectral_radius() < 1.0 && pair.node.is_admissible(&map)?)
    };
    let agreement = Cases::of(peaks.iter().map(|peak| stable(*peak)).collect::<Result<Vec<_>, _>>()?);
    let here = map(peaks[0], restitution)?;
    let multipliers = match here.period_one_pair(k.into()) {
        Some(pair) => format!("multipliers {:.3}", pair.node.multipliers()),
        None => "no such orbit".to_owned(),
    };
    let text =
        format!("{multipliers} at P = {}, K = {}", rounded(peaks[0], 5), rounded(window.birth / peaks[0], 4));
    let mut reason =
        format!("it attracts for P from {} to {}", rounded(window.birth, 5), rounded(window.doubling, 5));
    if !window.holds(peaks[0]) {
        reason.push_str(&format!("; found there instead: {}", behaviours(&here, 10)?.words()));
    }
    Ok(vec![("stability", Answer::share(agreement, text).because(reason))])
}

/// The four sticking orbits.
pub(super) fn sticking(entry: &Entry) -> Answers {
    const NAMES: [&str; 4] = ["point_1", "point_2", "point_3", "point_4"];
    NAMES.into_iter().map(|name| Ok((name, sticking_at(entry, name)?))).collect()
}

fn sticking_at(entry: &Entry, name: &'static str) -> Result<Answer, ExperimentError> {
    let input = |input: &str| entry.input_of(name, input).map(|number| number.value);
    let restitution = input("restitution")?;
    let peaks = peaks(input("amplitude_m")?, input("frequency_hz")?, entry.input("gravity_m_per_s2")?);
    let (maps, verdicts) = after_rests(&peaks, restitution)?;
    let again = verdicts.iter().map(|verdict| Behaviour::of(verdict).rests_again());
    let agreement = Cases::of(again);
    let text = verdicts.first().map_or_else(String::new, cycle_words);
    let from_everywhere = behaviours(&maps[0], 8)?;
    Ok(Answer::share(agreement, text).because(format!(
        "P = {}; all starts: {}",
        rounded(peaks[0], 5),
        from_everywhere.words()
    )))
}

/// Impacts that a ball is followed for after a rest.
const IMPACTS_AFTER_REST: u64 = 6_000;

/// The maps, and what a ball does that leaves a rest.
fn after_rests(peaks: &[f64], restitution: f64) -> Result<(Vec<ImpactMap>, Vec<Verdict>), ExperimentError> {
    let maps = peaks.iter().map(|peak| map(*peak, restitution)).collect::<Result<Vec<_>, _>>()?;
    let settings =
        VerdictSettings { transient: 500, impacts: IMPACTS_AFTER_REST - 500, ..VerdictSettings::default() };
    let verdicts = verdicts_after_rest(&maps, settings)?;
    Ok((maps, verdicts))
}

fn cycle_words(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Chattering { cycle, .. } => format!(
            "thrown and caught with {} in {}{}",
            counted(cycle.long_flights, "long flight"),
            counted(cycle.platform_periods, "period"),
            if cycle.is_exact() { "" } else { ", chosen by rounding" }
        ),
        other => format!("no second rest: {}", Behaviours::of([other]).words()),
    }
}

/// What a drive does to balls of four restitutions.
pub(super) fn restitutions(entry: &Entry) -> Answers {
    let peaks =
        peaks(entry.input("amplitude_m")?, entry.input("frequency_hz")?, entry.input("gravity_m_per_s2")?);
    let restitution = |name: &str| entry.input_of(name, "restitution").map(|number| number.value);
    let mut answers = Vec::new();
    for (name, modes) in [("bimodal", 2), ("trimodal", 3)] {
        let maps = peaks
            .iter()
            .map(|peak| map(*peak, restitution(name)?).map_err(Into::into))
            .collect::<Result<Vec<_>, ExperimentError>>()?;
        let found = behaviours_of(&maps, 8)?;
        let agreement = Cases::of(found.iter().map(|at| at.iter().any(|one| one.modes() == Some(modes))));
        let words = found.first().map(Behaviours::words).unwrap_or_default();
        let answer = Answer::share(agreement, words).because(format!(
            "holds where an attractor has {modes} different flights, the short ones of a chatter not counted"
        ));
        answers.push((name, answer));
    }
    let some = growths(&peaks, restitution("chaotic")?)?;
    let more = growths(&peaks, restitution("more_chaotic")?)?;
    let positive = |found: &Growth| found.exponent > 3.0 * found.standard_error;
    let chaotic = Cases::of(some.iter().map(positive));
    let larger = some.iter().zip(&more).map(|(some, more)| positive(more) && more.exponent > some.exponent);
    answers.push(("chaotic", Answer::share(chaotic, growth_words(&some)).because(ROUND_OR_CHAOS)));
    answers.push((
        "more_chaotic",
        Answer::share(Cases::of(larger), growth_words(&more)).because(ROUND_OR_CHAOS),
    ));
    Ok(answers)
}

const ROUND_OR_CHAOS: &str = "judged by the growth of small differences from impact to impact of a ball that leaves a rest; their runs of \
     20 periods cannot tell a long round from chaos";

/// How fast orbits that leave a rest come apart.
struct Growth {
    /// Logarithmic, per flight.
    exponent: f64,
    standard_error: f64,
    verdict: Verdict,
}

fn growths(peaks: &[f64], restitution: f64) -> Result<Vec<Growth>, ExperimentError> {
    let (_, verdicts) = after_rests(peaks, restitution)?;
    let growth = |verdict: Verdict| {
        let (exponent, standard_error) = match verdict {
            Verdict::Chaotic { exponent, standard_error, .. } => (exponent, standard_error),
            Verdict::Chattering { cycle, .. } => match cycle.trust {
                CycleTrust::ChosenByRounding { exponent: Some(exponent), standard_error: Some(error) } => {
                    (exponent, error)
                }
                // An exact round is none that comes apart.
                _ => (0.0, 0.0),
            },
            _ => (0.0, 0.0),
        };
        Growth { exponent, standard_error, verdict }
    };
    Ok(verdicts.into_iter().map(growth).collect())
}

fn growth_words(growths: &[Growth]) -> String {
    growths.first().map_or_else(String::new, |first| {
        format!(
            "exponent {:.2} ± {:.2} per flight; {}",
            first.exponent,
            first.standard_error,
            match first.verdict {
                Verdict::Chaotic { .. } => format!("no second rest in {IMPACTS_AFTER_REST} impacts"),
                ref other => cycle_words(other),
            }
        )
    })
}
