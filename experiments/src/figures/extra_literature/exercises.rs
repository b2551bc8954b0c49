//! What lecture exercises ask of the high-bounce map, and what the exact one answers.

use super::Answers;
use super::behaviour::{after_rest, behaviours, map};
use super::catalogue::Entry;
use super::data::{Answer, rounded};
use super::high_bounce::{HighBounceMap, birth};
use super::windows::Window;

/// Starts along each axis.
const STARTS: u32 = 10;

/// The window in which the diagram changes; their drive is 2 P.
pub(super) fn window(entry: &Entry) -> Answers {
    const NAME: &str = "window";
    let restitution = entry.input("restitution")?;
    let (low, high) = (entry.input_of(NAME, "low")?.value, entry.input_of(NAME, "high")?.value);
    let born = 2.0 * birth(restitution, 1);
    let window = Answer::number(born, 6, (low..=high).contains(&born))
        .because("the orbits with one impact in each period are born there, in both maps");
    let (approximate, exact) =
        (2.0 * HighBounceMap::first_doubling(restitution, 1), 2.0 * Window::of(restitution, 1).doubling);
    let doubling = Answer::nothing_printed(format!(
        "{} in the exact map, {} in theirs, {:.1} % less",
        rounded(exact, 6),
        rounded(approximate, 6),
        100.0 * (1.0 - approximate / exact)
    ))
    .with_value(exact);
    Ok(vec![(NAME, window), ("doubling", doubling)])
}

/// What both maps do at one point.
pub(super) fn behaviour(entry: &Entry) -> Answers {
    let (restitution, peak_acceleration) = (entry.input("restitution")?, 0.5 * entry.input("drive")?);
    let exact = map(peak_acceleration, restitution)?;
    let found = behaviours(&exact, STARTS)?;
    let window = Window::of(restitution, 1);
    let stage = if window.holds(peak_acceleration) {
        "attracts"
    } else if peak_acceleration < window.birth {
        "is not born yet"
    } else {
        "has doubled"
    };
    let rest = match after_rest(&exact)? {
        Some(_) => "",
        None => "; a disk at rest stays there",
    };
    let high_bounce = HighBounceMap { peak_acceleration, restitution };
    let answer = Answer::nothing_printed(found.words()).because(format!(
        "P = {}: the orbit with one impact in each period {stage}{rest}. High-bounce map: {}",
        rounded(peak_acceleration, 6),
        high_bounce.words(STARTS)
    ));
    Ok(vec![("behaviour", answer)])
}
