//! What the homework of the Universidad de Chile and the reports on it state.
//!
//! Their amplitude, gravity and mass are 1: P = omega^2, and a speed of theirs is one of ours over omega.

use std::f64::consts::PI;

use bouncing_disk::core::{
    ChatterPolicy, ImpactMap, ImpactState, Launch, Phase, Verdict, VerdictSettings, doubling_cascade,
    orbit_diagram,
};

use super::behaviour::{Behaviour, forcing_of_frequency, frequency_of_forcing, impacts, map_at, own_speed};
use super::catalogue::Entry;
use super::data::{Answer, rounded};
use super::{Answers, rounds_to_printed, rounds_within};
use crate::claim::Cases;
use crate::experiment::ExperimentError;

const SETTINGS: VerdictSettings =
    VerdictSettings { transient: 3_000, impacts: 6_000, longest_period: 64, tolerance: 1.0e-7 };
/// Feigenbaum's constant, by which the doublings accumulate.
const FEIGENBAUM: f64 = 4.669_201_609;
/// Doublings that the accumulation is extrapolated from.
const DOUBLINGS: usize = 9;

fn map_of(entry: &Entry, frequency: f64) -> Result<ImpactMap, ExperimentError> {
    Ok(map_at(forcing_of_frequency(frequency), entry.input("restitution")?)?)
}

/// Their start: on the platform as it rises through zero, with the own speed 2.
fn launch(frequency: f64) -> Result<Launch, ExperimentError> {
    const SPEED: f64 = 2.0;
    Ok(Launch::new(Phase::new(0.0)?, SPEED * frequency - frequency * frequency)?)
}

/// Their speeds after the impacts that follow the first `skipped`.
fn speeds(
    entry: &Entry,
    frequency: f64,
    skipped: usize,
    recorded: usize,
) -> Result<Vec<f64>, ExperimentError> {
    let map = map_of(entry, frequency)?;
    let orbit = map.orbit_from_launch(launch(frequency)?, ChatterPolicy::Complete);
    let diagram = orbit_diagram(&[orbit], skipped, recorded)?;
    Ok(diagram.iter().flatten().map(|state| own_speed(&map, state) / frequency).collect())
}

/// What the orbit from their start does.
fn verdict(entry: &Entry, frequency: f64) -> Result<(ImpactMap, Verdict), ExperimentError> {
    let map = map_of(entry, frequency)?;
    let first = map.orbit_from_launch(launch(frequency)?, ChatterPolicy::Complete).next();
    let state: ImpactState = match first.transpose()? {
        Some(bouncing_disk::core::OrbitEvent::Impact(impact)) => impact.into(),
        _ => return Err(super::paper::lost("first impact")),
    };
    Ok((map, map.verdict(state, SETTINGS)?))
}

/// Their speeds on the attracting orbit, largest first; empty where it is none.
fn orbit_speeds(entry: &Entry, frequency: f64) -> Result<Vec<f64>, ExperimentError> {
    let (map, verdict) = verdict(entry, frequency)?;
    let Verdict::Periodic { impacts: count, state, .. } = verdict else { return Ok(Vec::new()) };
    let states = impacts(&map, state, count)?;
    let mut speeds: Vec<f64> = states.iter().map(|state| own_speed(&map, state) / frequency).collect();
    speeds.sort_by(|one, other| other.total_cmp(one));
    Ok(speeds)
}

/// What the orbit does, in a word.
fn word(verdict: &Verdict) -> String {
    match Behaviour::of(verdict) {
        Behaviour::Periodic { impacts, .. } => impacts.to_string(),
        Behaviour::Chaotic => "chaos".to_owned(),
        behaviour if behaviour.rests_again() => "rests".to_owned(),
        _ => "undecided".to_owned(),
    }
}

/// The diagram that the homework asks for.
pub(super) fn diagram(entry: &Entry) -> Answers {
    const STEPS: u32 = 130;
    let (from, to) = (entry.input("from")?, entry.input("to")?);
    let mut runs: Vec<(String, f64, f64)> = Vec::new();
    for step in 0..=STEPS {
        let frequency = from + (to - from) * f64::from(step) / f64::from(STEPS);
        let word = word(&verdict(entry, frequency)?.1);
        match runs.last_mut() {
            Some(run) if run.0 == word => run.2 = frequency,
            _ => runs.push((word, frequency, frequency)),
        }
    }
    let count = |word: &str| runs.iter().filter(|run| run.0 == word).count();
    let listed: Vec<String> = runs
        .iter()
        .take_while(|run| run.0 != "chaos")
        .map(|(word, from, to)| format!("{word} from {} to {}", rounded(*from, 4), rounded(*to, 4)))
        .collect();
    let behind = runs.iter().skip_while(|run| run.0 != "chaos").filter(|run| run.0 != "chaos");
    let windows: Vec<String> =
        behind.map(|(word, from, _)| format!("{word} at {}", rounded(*from, 4))).collect();
    let text = format!(
        "speeds of the orbit from their start: {}; behind it chaos in {} parts, with windows: {}",
        listed.join(", "),
        count("chaos"),
        if windows.is_empty() { "none".to_owned() } else { windows.join(", ") }
    );
    Ok(vec![(
        "diagram",
        Answer::nothing_printed(text).because(format!("{} frequencies in steps of 0.001", STEPS + 1)),
    )])
}

/// The frequency of a doubling of the cascade, the accumulation for none.
fn doubling(entry: &Entry, number: Option<usize>) -> Result<f64, ExperimentError> {
    let cascade = doubling_cascade(entry.input("restitution")?, number.unwrap_or(DOUBLINGS))?;
    let forcing = |back: usize| cascade[cascade.len() - 1 - back].axial_forcing;
    Ok(frequency_of_forcing(match number {
        Some(_) => forcing(0),
        None => forcing(0) + (forcing(0) - forcing(1)) / (FEIGENBAUM - 1.0),
    }))
}

/// Where both bands of the chaotic attractor merge: the speeds of every other impact overlap.
fn band_merging(entry: &Entry) -> Result<f64, ExperimentError> {
    const IMPACTS: usize = 40_000;
    let start = doubling(entry, None)?;
    bouncing_disk::core::numerics::roots::bisection(start, 1.79, 14, |frequency| {
        let speeds = speeds(entry, frequency, 2_000, IMPACTS)?;
        let range = |parity: usize| {
            let own = speeds.iter().skip(parity).step_by(2);
            own.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &speed| {
                (low.min(speed), high.max(speed))
            })
        };
        let ((low, high), (other_low, other_high)) = (range(0), range(1));
        Ok(high < other_low || other_high < low)
    })
}

/// Doublings and bands, read off a diagram with a grid of 0.003.
pub(super) fn bands(entry: &Entry) -> Answers {
    let grid = entry.input("grid")?;
    let merging = band_merging(entry)?;
    let answer = |name: &'static str, computed: f64, reason: &str| -> Result<_, ExperimentError> {
        Ok((name, rounds_within(entry, name, computed, grid)?.because(reason)))
    };
    let read = "read off a grid of 0.003";
    let before = entry.printed("doubling_2")?.value - grid;
    let between = orbit_speeds(entry, before)?;
    let late = format!(
        "behind a doubling the speeds are hard to tell apart: those at {} are {}",
        rounded(before, 4),
        between.iter().map(|speed| rounded(*speed, 4)).collect::<Vec<_>>().join(", ")
    );
    Ok(vec![
        answer("doubling_1", doubling(entry, Some(1))?, read)?,
        answer("doubling_2", doubling(entry, Some(2))?, &late)?,
        answer(
            "two_bands",
            doubling(entry, None)?,
            "the accumulation of the doublings; what \"without a pattern\" is, is not defined",
        )?,
        answer("one_band", merging, "every other impact is in the same range of speeds from there on")?,
    ])
}

/// The first two doublings.
pub(super) fn doublings(entry: &Entry) -> Answers {
    [("doubling_1", 1), ("doubling_2", 2)]
        .into_iter()
        .map(|(name, number)| Ok((name, rounds_to_printed(entry, name, doubling(entry, Some(number))?)?)))
        .collect()
}

/// The third report.
pub(super) fn third_report(entry: &Entry) -> Answers {
    let mut answers = doublings(entry)?;
    let frequency = |name: &str| entry.input_of(name, "frequency").map(|number| number.value);
    let last = frequency("periods")?;
    let seen =
        |frequency: f64| -> Result<String, ExperimentError> { Ok(word(&verdict(entry, frequency)?.1)) };
    let (before, until) = (seen(frequency("relaxation")?)?, seen(last)?);
    let third = doubling(entry, Some(3))?;
    answers.push((
        "periods",
        Answer::statement(
            third > last && before == "1" && until == "4",
            format!("period {until} at {last}; the third doubling is at {}", rounded(third, 6)),
        ),
    ));
    let accumulation = doubling(entry, None)?;
    let chaos = entry.input_of("chaos", "frequency")?;
    let holds = (accumulation - chaos.value).abs() <= chaos.half_unit;
    answers.push((
        "chaos",
        Answer::number(accumulation, 6, holds).because(format!(
            "the accumulation of the doublings; at {} itself: {}",
            chaos.value,
            seen(chaos.value)?
        )),
    ));
    let edge = frequency("gap")?;
    let before = outer_share(entry, edge - 0.01)?;
    let beyond = (1..=10)
        .map(|step| outer_share(entry, edge + 0.001 * f64::from(step)))
        .collect::<Result<Vec<_>, _>>()?;
    let (least, most) =
        beyond.iter().fold((1.0_f64, 0.0_f64), |(least, most), &share| (least.min(share), most.max(share)));
    answers.push((
        "gap",
        Answer::share(
            Cases::of(beyond.iter().map(|share| *share > before)),
            format!(
                "{:.0} % of the speeds in the outer thirds of their range at {}, {:.0} to {:.0} % from {} to 1.79",
                100.0 * before,
                rounded(edge - 0.01, 4),
                100.0 * least,
                100.0 * most,
                rounded(edge + 0.001, 4)
            ),
        )
        .because("an orbit of three impacts attracts at 1.783 and doubles"),
    ));
    let text = relaxation_words(entry, frequency("relaxation")?)?;
    answers.push(("relaxation", Answer::not_comparable(text).because(CRITERION)));
    Ok(answers)
}

const CRITERION: &str = "how near is near enough is not printed";

/// The share of the speeds that lies in the lowest and in the highest third of their range.
fn outer_share(entry: &Entry, frequency: f64) -> Result<f64, ExperimentError> {
    let speeds = speeds(entry, frequency, 2_000, 20_000)?;
    let low = speeds.iter().copied().fold(f64::INFINITY, f64::min);
    let high = speeds.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let outer =
        speeds.iter().filter(|&&speed| (3.0 * (speed - low) / (high - low) - 1.5).abs() > 0.5).count();
    Ok(outer as f64 / speeds.len() as f64)
}

/// After how many impacts from their start the speed stays within a distance of the attracting orbit.
fn relaxation(entry: &Entry, frequency: f64, distance: f64) -> Result<usize, ExperimentError> {
    let orbit = orbit_speeds(entry, frequency)?;
    let speeds = speeds(entry, frequency, 0, 6_000)?;
    let off = |speed: f64| orbit.iter().all(|own| (own - speed).abs() > distance);
    Ok(speeds.iter().rposition(|&speed| off(speed)).map_or(0, |last| last + 1))
}

fn relaxation_words(entry: &Entry, frequency: f64) -> Result<String, ExperimentError> {
    let counts = [0.01, 0.001, 0.0001]
        .map(|distance| relaxation(entry, frequency, distance).map(|count| count.to_string()))
        .into_iter()
        .collect::<Result<Vec<_>, _>>()?;
    Ok(format!("{} impacts to within 0.01, 0.001, 0.0001 of the speed at {frequency}", counts.join(", ")))
}

/// Both speeds of the period-2 orbit.
pub(super) fn two_speeds(entry: &Entry) -> Answers {
    const STEP: f64 = 0.0002;
    let frequency = entry.input("frequency")?;
    let speeds = orbit_speeds(entry, frequency)?;
    let [fast, slow] = speeds[..] else { return Err(super::paper::lost("period-2 orbit")) };
    let (printed_fast, printed_slow) = (entry.printed("fast")?, entry.printed("slow")?);
    let mut legal = Vec::new();
    for step in -50..=50 {
        let near = frequency + STEP * f64::from(step);
        if let [fast, slow] = orbit_speeds(entry, near)?[..]
            && (fast - printed_fast.value).abs() <= printed_fast.half_unit
            && (slow - printed_slow.value).abs() <= printed_slow.half_unit
        {
            legal.push(near);
        }
    }
    let reason = legal.first().zip(legal.last()).map_or_else(
        || "no frequency within 0.01 has both printed speeds".to_owned(),
        |(from, to)| {
            format!("both printed speeds are those of ω from {} to {}", rounded(*from, 5), rounded(*to, 5))
        },
    );
    Ok(vec![
        ("fast", rounds_to_printed(entry, "fast", fast)?.because(reason.as_str())),
        ("slow", rounds_to_printed(entry, "slow", slow)?.because(reason.as_str())),
    ])
}

/// The speed of the period-1 orbit, as three reports read it.
pub(super) fn one_speed(entry: &Entry) -> Answers {
    let exact =
        |name: &str| -> Result<f64, ExperimentError> { Ok(PI / entry.input_of(name, "frequency")?.value) };
    let input = |name: &str, input: &str| entry.input_of(name, input);
    let (fast, slow) = (input("toledo", "fast")?, input("toledo", "slow")?);
    let speed = exact("toledo")?;
    let frequency = input("toledo", "frequency")?.value;
    let settled = orbit_speeds(entry, frequency)?;
    let both = [fast, slow].iter().all(|number| (speed - number.value).abs() <= number.half_unit);
    let transient = speeds(entry, frequency, 14, 2)?;
    let toledo = Answer::number(speed, 6, both && settled.len() == 1).because(format!(
        "a single speed, π/ω: no orbit of period 2 attracts yet. Both numbers are a transient; from their start impacts 15 and 16 \
         leave with {}",
        transient.iter().map(|speed| rounded(*speed, 4)).collect::<Vec<_>>().join(" and ")
    ));
    let read = input("leiva", "speed")?;
    let speed = exact("leiva")?;
    let leiva = Answer::number(speed, 6, (speed - read.value).abs() <= read.half_unit).because("π/ω");
    let (low, high) = (input("brevadiaz", "low")?.value, input("brevadiaz", "high")?.value);
    let speed = exact("brevadiaz")?;
    let brevadiaz = Answer::number(speed, 6, (low..=high).contains(&speed)).because("π/ω");
    Ok(vec![("toledo", toledo), ("leiva", leiva), ("brevadiaz", brevadiaz)])
}

/// One speed before the doubling, two behind it.
pub(super) fn slowing(entry: &Entry) -> Answers {
    let frequency = |name: &str, input: &str| entry.input_of(name, input).map(|number| number.value);
    let listed =
        |speeds: &[f64]| speeds.iter().map(|speed| rounded(*speed, 5)).collect::<Vec<_>>().join(" and ");
    let multiplier = |frequency: f64| -> Result<String, ExperimentError> {
        Ok(match verdict(entry, frequency)?.1 {
            Verdict::Periodic { multipliers, .. } => format!("multipliers {multipliers:.4}"),
            other => word(&other),
        })
    };
    let mut answers = Vec::new();
    for (name, count) in [("one_value", 1), ("two_values", 2)] {
        let at = frequency(name, "frequency")?;
        let speeds = orbit_speeds(entry, at)?;
        answers
            .push((name, Answer::statement(speeds.len() == count, listed(&speeds)).because(multiplier(at)?)));
    }
    let texts = ["first", "second", "third"]
        .map(|input| relaxation_words(entry, frequency("relaxation", input)?))
        .into_iter()
        .collect::<Result<Vec<_>, _>>()?;
    answers.push(("relaxation", Answer::not_comparable(texts.join("; ")).because(CRITERION)));
    Ok(answers)
}
