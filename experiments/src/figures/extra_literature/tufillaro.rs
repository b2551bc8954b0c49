//! What the online chapter of Tufillaro, Abbott and Reilly states.

use std::f64::consts::{PI, TAU};

use bouncing_disk::core::{
    ChatterPolicy, ImpactMap, ImpactState, Launch, Orbit, OrbitEvent, Phase, Verdict, VerdictSettings,
    doubling_cascade,
};

use super::Answers;
use super::behaviour::{Behaviour, behaviours, behaviours_of, map, map_at, starts, verdicts_after_rest};
use super::catalogue::Entry;
use super::data::{Answer, rounded};
use super::high_bounce::birth;
use super::windows::{Window, first_shared_restitution};
use crate::experiment::ExperimentError;

/// The peak acceleration of an amplitude, of the drive that the text does not give.
fn drive(entry: &Entry) -> Result<f64, ExperimentError> {
    let angular = TAU * entry.input("frequency_hz")?;
    Ok(angular * angular / entry.input("gravity_cm_per_s2")?)
}

fn drive_words(entry: &Entry) -> Result<String, ExperimentError> {
    Ok(format!("{} Hz, {} cm/s²", entry.input("frequency_hz")?, entry.input("gravity_cm_per_s2")?))
}

/// The amplitudes of the first two doublings.
pub(super) fn amplitudes(entry: &Entry) -> Answers {
    const NAME: &str = "amplitudes";
    let (first, second) = (entry.input_of(NAME, "first")?, entry.input_of(NAME, "second")?);
    let least = (second.value - second.half_unit) / (first.value + first.half_unit);
    let most = (second.value + second.half_unit) / (first.value - first.half_unit);
    let ratio = |restitution: f64| -> Result<f64, ExperimentError> {
        let cascade = doubling_cascade(restitution, 2)?;
        Ok(cascade[1].axial_forcing / cascade[0].axial_forcing)
    };
    let mut legal = Vec::new();
    for percent in 2..=98 {
        let restitution = f64::from(percent) / 100.0;
        // A branch may end before its second doubling.
        if ratio(restitution).is_ok_and(|ratio| (least..=most).contains(&ratio)) {
            legal.push(restitution);
        }
    }
    let restitution = entry.input("restitution")?;
    let unit = drive(entry)?;
    let amplitudes: Vec<String> = doubling_cascade(restitution, 2)?
        .iter()
        .map(|found| rounded(PI * found.axial_forcing / unit, 4))
        .collect();
    let text = format!(
        "ratio of both {} at r = {restitution}; printed {} to {}",
        rounded(ratio(restitution)?, 5),
        rounded(least, 5),
        rounded(most, 5)
    );
    let reason = format!(
        "drive and restitution are in a table that is an image; the ratio fits for r from {} to {}. With {} and r = \
         {restitution}, which is inferred, {} cm",
        legal.first().copied().unwrap_or(f64::NAN),
        legal.last().copied().unwrap_or(f64::NAN),
        drive_words(entry)?,
        amplitudes.join(" and "),
    );
    Ok(vec![(NAME, Answer::not_comparable(text).with_value(ratio(restitution)?).because(reason))])
}

/// How fast two neighbouring starts come together.
pub(super) fn contraction(entry: &Entry) -> Answers {
    const MOST: u32 = 200;
    let map = map(drive(entry)? * entry.input("amplitude_cm")?, entry.input("restitution")?)?;
    let orbit = map.period_one_pair(1).ok_or_else(|| super::paper::lost("period-1 orbit"))?.node;
    let difference = entry.input("difference")?;
    let apart = |one: &ImpactState, other: &ImpactState| {
        let cycles = (one.phase().cycles() - other.phase().cycles()).abs();
        cycles.min(1.0 - cycles)
    };
    let settings = VerdictSettings { transient: 100, impacts: 400, ..VerdictSettings::default() };
    let (mut together, mut on_orbit) = (Vec::new(), Vec::new());
    for (map, start) in starts(&map, 8)? {
        let verdict = map.verdict(start, settings)?;
        if !matches!(verdict, Verdict::Periodic { impacts: 1, platform_periods: 1, rests: 0, .. }) {
            continue;
        }
        let moved = Phase::new(start.phase().angle() + TAU * difference)?;
        let (mut one, mut other) = (start, ImpactState::new(moved, start.velocity())?);
        let (mut last_apart, mut last_off) = (0, 0);
        for impact in 1..=MOST {
            (one, other) = (map.step(one)?.into(), map.step(other)?.into());
            // The last time that they are told apart by five decimals, and that the sixth is not settled.
            if apart(&one, &other) > 0.5 * difference {
                last_apart = impact;
            }
            if apart(&one, &orbit.state) > 0.1 * difference {
                last_off = impact;
            }
        }
        together.push(last_apart + 1);
        on_orbit.push(last_off + 1);
    }
    let text = format!(
        "from {} starts on its basin {} (median; {}) and {} ({})",
        together.len(),
        median(&mut together),
        extent(&together),
        median(&mut on_orbit),
        extent(&on_orbit),
    );
    let reason = format!(
        "start values and drive are in images. With {} and r = {}, which is inferred: multipliers {:.4}; counted until the phases, \
         a hundred-thousandth of a period apart at first, differ by less than half of that, and until the orbit is a millionth \
         away",
        drive_words(entry)?,
        map.restitution(),
        orbit.multipliers()
    );
    Ok(vec![("contraction", Answer::not_comparable(text).because(reason))])
}

/// The middle one; 0 of none. Sorts.
fn median(counts: &mut [u32]) -> u32 {
    counts.sort_unstable();
    counts.get(counts.len() / 2).copied().unwrap_or_default()
}

/// "5 to 9" of sorted counts.
fn extent(counts: &[u32]) -> String {
    let end = |count: Option<&u32>| count.copied().unwrap_or_default();
    format!("{} to {}", end(counts.first()), end(counts.last()))
}

/// The bound of the text, rebuilt from its steps, beside the one that is proven.
pub(super) fn bound(_: &Entry) -> Answers {
    let fastest = super::speeds::fastest()?;
    let largest = |of: fn(&super::speeds::Fastest) -> f64| fastest.iter().map(of).fold(0.0, f64::max);
    let tighter = fastest.iter().filter(|at| at.proven < at.rebuilt).count();
    let text = format!(
        "(1 + 3r)/(1 − r) P, rebuilt from the steps of the text; the fastest orbit of {} maps reaches {} of it",
        fastest.len(),
        rounded(largest(|at| at.speed / at.rebuilt), 3)
    );
    let reason = format!(
        "the formula is an image. The proven bound of docs/numerics/dynamics.md is the smaller one for {tighter} of the maps, and {} of it is reached",
        rounded(largest(|at| at.speed / at.proven), 3)
    );
    Ok(vec![("bound", Answer::nothing_printed(text).because(reason))])
}

/// What follows the first rest.
pub(super) fn sticking(_: &Entry) -> Answers {
    const COLUMNS: u32 = 500;
    const RESTITUTION: f64 = 0.5;
    /// That of Fig. 6.
    const LAST: f64 = 0.62;
    let still = map(1.0, RESTITUTION)?.vibration().separation_phase();
    let (mut largest, mut released) = (0.0_f64, true);
    for excess in [1e-12, 1e-6, 1e-3, 1.0, 100.0] {
        let peak = 1.0 + excess;
        match map(peak, RESTITUTION)?.vibration().separation_phase() {
            Some(phase) => largest = largest.max((peak * phase.sin() - 1.0).abs()),
            None => released = false,
        }
    }
    let release = Answer::statement(
        still.is_none() && released && largest < 1e-12,
        "at P = 1 never, above it where P sin τ = 1",
    );
    let maps = (0..COLUMNS)
        .map(|column| {
            let share = (f64::from(column) + 0.5) / f64::from(COLUMNS);
            map_at(1.0 / PI + (LAST - 1.0 / PI) * share, RESTITUTION)
        })
        .collect::<Result<Vec<_>, _>>()?;
    let settings = VerdictSettings { transient: 1_000, impacts: 20_000, ..VerdictSettings::default() };
    let verdicts = verdicts_after_rest(&maps, settings)?;
    let (mut again, mut exactly, mut unknown) = (0_u32, 0_u32, 0_u32);
    let mut never = Vec::new();
    for (map, verdict) in maps.iter().zip(&verdicts) {
        match Behaviour::of(verdict) {
            behaviour if behaviour.rests_again() => {
                again += 1;
                exactly += u32::from(repeats_exactly(map)?);
            }
            Behaviour::Periodic { .. } | Behaviour::Chaotic => never.push(map.vibration().axial_forcing()),
            _ => unknown += 1,
        }
    }
    let text = format!(
        "{again} of {COLUMNS} forcings from 1/π to {LAST} at r = {RESTITUTION} rest again, {exactly} of these in a round that \
         repeats to the last bit; {} never rest again{}",
        never.len(),
        never.first().zip(never.last()).map_or_else(String::new, |(first, last)| format!(
            ", between Γ = {} and {}",
            rounded(*first, 4),
            rounded(*last, 4)
        ))
    );
    let repetition = Answer::statement(again == exactly && never.is_empty(), text).because(format!(
        "where the disk rests again the round repeats for ever, as it always leaves with the same phase and speed; but the \
         flight from a rest may end on an attractor without rest{}",
        if unknown > 0 { format!("; {unknown} undecided") } else { String::new() }
    ));
    Ok(vec![("release", release), ("repetition", repetition)])
}

/// Whether the second and the third round from a rest are the same to the last bit.
fn repeats_exactly(map: &ImpactMap) -> Result<bool, ExperimentError> {
    let Some(phase) = map.vibration().separation_phase() else { return Ok(false) };
    let mut orbit = map.orbit_from_launch(Launch::new(phase, 0.0)?, ChatterPolicy::Complete);
    Ok(round(&mut orbit)? == round(&mut orbit)?)
}

/// The impacts up to the next rest.
fn round(orbit: &mut Orbit) -> Result<Vec<[u64; 2]>, ExperimentError> {
    let mut impacts = Vec::new();
    for event in orbit {
        match event? {
            OrbitEvent::Impact(impact) => {
                impacts.push([impact.phase.angle().to_bits(), impact.velocity.to_bits()]);
            }
            _ => break,
        }
    }
    Ok(impacts)
}

/// How long a ball bounces on a platform at rest.
pub(super) fn stopping_time(entry: &Entry) -> Answers {
    let (speed, restitution) = (entry.input("speed_m_per_s")?, entry.input("restitution")?);
    let still = map(0.0, restitution)?;
    let time = |gravity: f64| -> Result<f64, ExperimentError> {
        // In units of 1 s: a platform that does not move has no frequency.
        let launch = Launch::new(Phase::new(0.0)?, speed / gravity)?;
        let mut time = 0.0;
        for event in still.orbit_from_launch(launch, ChatterPolicy::Complete) {
            time += match event? {
                OrbitEvent::Impact(impact) => impact.duration(),
                OrbitEvent::Attachment(rest) => rest.accumulation.duration,
                _ => break,
            };
        }
        Ok(time)
    };
    let (standard, school) = (time(9.81)?, time(9.8)?);
    let text = format!("{} s with 9.81 m/s², {} s with 9.8 m/s²", rounded(standard, 5), rounded(school, 5));
    let closed = 2.0 * speed / (9.81 * (1.0 - restitution));
    let answer = Answer::nothing_printed(text).with_value(standard).because(format!(
        "an exercise; 2 v/(g (1 − r)), from which the completed chatter deviates by {:.0e} of it",
        ((standard - closed) / closed).abs()
    ));
    Ok(vec![("stopping_time", answer)])
}

/// Where the orbits with an impact every period and every other period both attract.
pub(super) fn both_attract(_: &Entry) -> Answers {
    let threshold = first_shared_restitution()?;
    let root = 3.0_f64.sqrt() * PI;
    let closed = ((root - 2.0) / (root + 2.0)).sqrt();
    let (high, low) = (0.75, 0.65);
    let peak = 0.5 * (birth(high, 2) + Window::of(high, 1).doubling);
    let found = behaviours(&map(peak, high)?, 12)?;
    let has = |periods: u64| {
        found.iter().any(|one| one == Behaviour::Periodic { impacts: 1, platform_periods: periods })
    };
    let missing = birth(low, 2) - Window::of(low, 1).doubling;
    let text = format!("possible only for r > {}", rounded(threshold, 7));
    let answer = Answer::nothing_printed(text).with_value(threshold).because(format!(
        "an exercise; 2π(1 − r)/(1 + r) < P < P of the first doubling, so that r² > (√3 π − 2)/(√3 π + 2), {} by this formula. At r = {high}, P = {} {}; \
         at r = {low} the second is born {} above the doubling of the first",
        rounded(closed, 7),
        rounded(peak, 4),
        if has(1) && has(2) { "both are reached from a grid of starts" } else { "a grid of starts does not reach both" },
        rounded(missing, 3),
    ));
    Ok(vec![("window", answer)])
}

/// How many attractors there are over the forcing.
pub(super) fn coexistence(_: &Entry) -> Answers {
    const COLUMNS: u32 = 60;
    const RESTITUTION: f64 = 0.5;
    const STARTS: u32 = 6;
    let forcing = |column: u32| 0.3 + 0.7 * (f64::from(column) + 0.5) / f64::from(COLUMNS);
    let maps =
        (0..COLUMNS).map(|column| map_at(forcing(column), RESTITUTION)).collect::<Result<Vec<_>, _>>()?;
    let found = behaviours_of(&maps, STARTS)?;
    let of = |attractors: usize| found.iter().filter(|column| column.decided() == attractors).count();
    let more = found.iter().filter(|column| column.decided() > 2).count();
    let text = format!(
        "at r = {RESTITUTION} and Γ from 0.3 to 1: one motion at {}, two at {}, more at {more} of {COLUMNS} forcings",
        of(1),
        of(2)
    );
    let answer = Answer::statement(of(2) + more > 0, text).because(format!(
        "{} starts at each forcing; cycles with rest count as motions, and two orbits of the same period as one",
        STARTS * STARTS
    ));
    Ok(vec![("coexistence", answer)])
}

/// What the high-bounce map shares with the exact one, and by how much its first doubling is off.
pub(super) fn high_bounce(_: &Entry) -> Answers {
    let (mut apart, mut tried) = (0, 0);
    let mut errors = Vec::new();
    for tenth in 1..=9 {
        let restitution = f64::from(tenth) / 10.0;
        for k in 1..=3 {
            let born = birth(restitution, k);
            tried += 1;
            let exists = |peak: f64| -> Result<bool, ExperimentError> {
                Ok(map(peak, restitution)?.period_one_pair(k.into()).is_some())
            };
            apart += u32::from(exists(born * (1.0 - 1e-12))? || !exists(born * (1.0 + 1e-12))?);
        }
        let window = Window::of(restitution, 1);
        let approximate = super::high_bounce::HighBounceMap::first_doubling(restitution, 1);
        errors.push((restitution, approximate / window.doubling - 1.0));
    }
    let births = Answer::statement(apart == 0, format!("the same births for {tried} pairs of r and k")).because(
        "and a doubling after each; it knows no earlier impact, no rest and therefore no chatter, and its area shrinks by r and not \
         by r² in an impact",
    );
    let listed: Vec<String> = errors
        .iter()
        .map(|(restitution, error)| format!("{:.1} % at {restitution}", 100.0 * error))
        .collect();
    let doubling = Answer::nothing_printed(format!("P too small by {}", listed.join(", ").replace('-', "")))
        .because("k = 1; P sin τ = 1 in place of 2(1 + r²)/(1 + r)², docs/numerics/dynamics.md");
    Ok(vec![("births", births), ("doubling_error", doubling)])
}
