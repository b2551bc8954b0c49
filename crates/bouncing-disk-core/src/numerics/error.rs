//! The errors of this crate.

/// An error of the core. Every variant carries the numbers needed to see why it occurred.
///
/// The messages print numbers with all their digits, very small or large ones in scientific notation, and
/// whole numbers of a range, such as counts, without a fraction.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Error {
    /// An argument lies outside its legal range.
    #[error("{field} = {} {}", without_fraction(*value), illegal(legal))]
    OutOfRange {
        /// The name of the argument.
        field: &'static str,
        /// The given value.
        value: f64,
        /// The legal range, in words.
        legal: &'static str,
    },
    /// A disk at rest on the platform does not leave it at this phase: the platform is not falling away.
    #[error(
        "a disk at rest on the platform (peak acceleration {peak_acceleration:?} g) does not lift off at phase {phase:?} rad"
    )]
    NoLiftOff {
        /// Launch phase in radians.
        phase: f64,
        /// Peak acceleration of the platform in units of the preload acceleration.
        peak_acceleration: f64,
    },
    /// The flight would last longer than the period counter can represent exactly.
    #[error(
        "a flight that begins at relative speed {relative_speed:?} lasts {duration:?} rad, more than the limit of \
         {limit:?} rad"
    )]
    FlightTooLong {
        /// Launch speed relative to the platform, in units of g/omega.
        relative_speed: f64,
        /// Duration of the flight in radians.
        duration: f64,
        /// The largest duration in radians.
        limit: f64,
    },
    /// The pieces of a drive do not join.
    #[error(
        "the platform jumps by {jump:?} g/omega^2 where piece {piece} begins: its height must be continuous"
    )]
    HeightJump {
        /// The index of the piece, from 0; the first piece follows the last.
        piece: usize,
        /// Its height at its start minus the height of the previous piece at its end.
        jump: f64,
    },
    /// An impact on a kink of the platform's velocity has no derivative, and so no multipliers.
    #[error(
        "the impact at phase {phase:?} rad is on a kink of the drive, so the map has no derivative there"
    )]
    ImpactOnKink {
        /// The phase of the impact in radians.
        phase: f64,
    },
    /// The root finder used up its evaluations. This is a defect of the solver; please report the numbers.
    #[error(
        "the search for an impact did not converge after {evaluations} evaluations: gap {gap:?} after {time:?} \
         rad"
    )]
    NoConvergence {
        /// Evaluations of the gap.
        evaluations: u32,
        /// Last time tried, in radians after the start of the search.
        time: f64,
        /// The gap there, in units of g/omega^2.
        gap: f64,
    },
    /// An iteration (an orbit search, a refinement) did not converge.
    #[error("{what} did not converge after {iterations} iterations; last residual {residual:?}")]
    NotSettled {
        /// What was sought.
        what: &'static str,
        /// Iterations used.
        iterations: u32,
        /// Size of the last residual.
        residual: f64,
    },
    /// A periodic orbit is not proven to attract: it does not, or rounding leaves this undecided.
    #[error(
        "the orbit is not proven to attract: its largest multiplier is {spectral_radius:?}, the error of the trace \
         {trace_error:?}"
    )]
    NotAttracting {
        /// The larger modulus of its multipliers.
        spectral_radius: f64,
        /// The error bound of the trace of its derivative.
        trace_error: f64,
    },
    /// No region around an attracting orbit can be proven to be attracted: an impact is too slow, or a graze
    /// too near.
    #[error(
        "no neighbourhood of the orbit is proven to lie in its basin, down to a radius of {region:?} rad"
    )]
    NothingProven {
        /// The smallest region tried (rad).
        region: f64,
    },
    /// The given orbit is not a periodic orbit of the map.
    #[error("not an orbit of this map: {}", missed(*impact, *distance))]
    NotAnOrbit {
        /// The index of the impact, from 0.
        impact: usize,
        /// The distance of the following impact from the next one of the orbit (rad, or relative to 1 + the
        /// largest impact speed of the orbit); infinite if the disk stays on the platform.
        distance: f64,
    },
    /// The solution of an iteration has an impact with zero speed: a disk at rest, not a periodic orbit.
    #[error(
        "impact {index} of the solution has no speed (phase {phase:?} rad): a disk at rest is not a periodic orbit"
    )]
    ImpactWithoutSpeed {
        /// The index of the impact.
        index: usize,
        /// Its phase in radians.
        phase: f64,
    },
    /// The solution of an iteration lasts less than one period of the platform: its impacts repeat one instant
    /// within rounding and are not a periodic orbit.
    #[error(
        "the solution of {impacts} impacts lasts less than one period of the platform, so it is not an orbit \
         (fastest impact {speed:?} g/omega)"
    )]
    NoPlatformPeriods {
        /// Impacts of the solution.
        impacts: usize,
        /// The largest of their speeds, in units of g/omega.
        speed: f64,
    },
    /// In a search for an orbit by its impacts, a flight hits the platform earlier: the orbit ends at a
    /// graze.
    #[error(
        "flight {index} of the orbit should last {sought:?} rad, but the disk hits the platform after {found:?} rad"
    )]
    EarlierImpact {
        /// The index of the flight.
        index: usize,
        /// Its duration in the sought orbit, in radians.
        sought: f64,
        /// The time of the first impact, in radians after the launch.
        found: f64,
    },
    /// No branch of periodic orbits begins: the orbit does not exist on this map, or is not isolated, as at a
    /// fold.
    #[error(
        "no branch begins at {parameter:?}: {what} was not found there, or is not isolated (as at a fold)"
    )]
    NoBranch {
        /// The orbit.
        what: &'static str,
        /// The parameter of the continuation at which the search took place.
        parameter: f64,
    },
    /// A branch of periodic orbits ends before it doubles its period.
    #[error(
        "the branch ends without another period doubling after {after:?} (the last doubling, or the start)"
    )]
    NoDoubling {
        /// The parameter of the last doubling, or of the start of the branch.
        after: f64,
    },
    /// A number refers to a list item that is not of the required kind.
    #[error("the {} is not {expected}", item(what, *index, *count))]
    NotOfKind {
        /// The kind of items in the list.
        what: &'static str,
        /// The given number, from 0.
        index: usize,
        /// The length of the list.
        count: usize,
        /// The expected kind.
        expected: &'static str,
    },
    /// A text is not a decimal number.
    #[error("the text is not a decimal number: byte {at} (counted from 0) is unexpected")]
    NoDecimal {
        /// The byte position in the text, counted from 0.
        at: usize,
    },
    /// A law of restitution returns a number outside [0, 1], or NaN.
    #[error(
        "the law of restitution gives {restitution:?} at the impact speed {impact_speed:?} g/omega, outside [0, 1]"
    )]
    IllegalRestitution {
        /// The value of the law.
        restitution: f64,
        /// The impact speed, in units of g/omega.
        impact_speed: f64,
    },
    /// A chatter has a closed form only for a constant restitution: another law needs a cut.
    #[error(
        "chattering has a closed form for constant restitution only: use `ChatterPolicy::Cut` with any other law"
    )]
    NoClosedForm,
    /// The observer of a long call has stopped it.
    #[error("stopped after {done} of {total} items")]
    Stopped {
        /// Finished items.
        done: u64,
        /// All items.
        total: u64,
    },
    /// Stored data are inconsistent, or parts do not fit together.
    #[error("{what}: found {found}, expected {expected}")]
    Unfitting {
        /// The quantity that does not fit.
        what: &'static str,
        /// The number found.
        found: u64,
        /// The only or the largest number that fits.
        expected: u64,
    },
    /// More was requested than the limit allows or, if `count` is within the limit, than the memory can hold.
    #[error("{count} {what} {}: at most {limit}", if count > limit { "are too many" } else { "do not fit into memory" })]
    TooLarge {
        /// The kind of items requested.
        what: &'static str,
        /// The requested number.
        count: u64,
        /// The largest number.
        limit: u64,
    },
}

/// A number as text: a whole one as 1 and not 1.0, because counts are also floating-point numbers here.
fn without_fraction(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").map_or_else(|| text.clone(), str::to_owned)
}

/// The end of a sentence about an illegal value: its range is an interval, or other words.
fn illegal(legal: &str) -> String {
    if legal.starts_with(['[', '(']) {
        format!("is outside its legal range {legal}")
    } else {
        format!("is not legal: it must be {legal}")
    }
}

/// An item of a list, or the only one.
fn item(what: &str, index: usize, count: usize) -> String {
    if count == 1 { what.to_owned() } else { format!("{what} {index} of {count} (counted from 0)") }
}

/// Checks that `value` lies in [`low`, `high`]; NaN does not.
pub fn within(
    field: &'static str,
    value: f64,
    low: f64,
    high: f64,
    legal: &'static str,
) -> Result<f64, Error> {
    if value >= low && value <= high { Ok(value) } else { Err(Error::OutOfRange { field, value, legal }) }
}

/// The message for an impact, numbered from 1, that does not lead to the next one of an orbit.
fn missed(impact: usize, distance: f64) -> String {
    let number = impact.saturating_add(1);
    if distance.is_infinite() {
        format!("the disk stays on the platform after impact {number}")
    } else {
        format!("after impact {number} the next impact is off by {distance:?} (rad, or relative speed)")
    }
}

/// Checks that `value` is finite.
pub fn finite(field: &'static str, value: f64) -> Result<f64, Error> {
    within(field, value, f64::MIN, f64::MAX, "finite")
}

/// Checks that `value` is finite and not negative.
pub fn not_negative(field: &'static str, value: f64) -> Result<f64, Error> {
    within(field, value, 0.0, f64::MAX, "[0, inf)")
}

/// An empty vector with room for `count` <= `limit` items. It reserves the memory, so that a lack of memory
/// is an error. The limit is needed because some systems promise memory that they do not have.
pub(crate) fn room_for<T>(what: &'static str, count: u64, limit: u64) -> Result<Vec<T>, Error> {
    let refusal = Error::TooLarge { what, count, limit };
    let mut room = Vec::new();
    match usize::try_from(count) {
        Ok(items) if count <= limit && room.try_reserve_exact(items).is_ok() => Ok(room),
        _ => Err(refusal),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A speed of 1e-300 was once printed with 299 zeros, which hid the number and the point of the message.
    #[test]
    fn texts_tell_numbers_of_any_size_in_few_digits() {
        for number in [1.25e-300, 1.25e-121, 1.25e300] {
            for error in [
                Error::OutOfRange { field: "speed", value: number, legal: "[0, 1]" },
                Error::NoLiftOff { phase: number, peak_acceleration: number },
                Error::FlightTooLong { relative_speed: number, duration: number, limit: number },
                Error::NoConvergence { evaluations: 200, time: number, gap: number },
                Error::NotSettled { what: "search", iterations: 7, residual: number },
                Error::NotAttracting { spectral_radius: number, trace_error: number },
                Error::NothingProven { region: number },
                Error::NotAnOrbit { impact: 3, distance: number },
                Error::ImpactWithoutSpeed { index: 3, phase: number },
                Error::NoPlatformPeriods { impacts: 2, speed: number },
                Error::EarlierImpact { index: 5, sought: number, found: number },
                Error::IllegalRestitution { restitution: number, impact_speed: number },
            ] {
                let text = error.to_string();
                assert!(text.contains(&format!("{number:e}")) && text.len() < 160, "{text}");
            }
        }
    }

    #[test]
    fn a_missed_impact_is_numbered_from_one() {
        let text = |distance| Error::NotAnOrbit { impact: 0, distance }.to_string();
        let off = "not an orbit of this map: after impact 1 the next impact is off by 0.45 (rad, or relative speed)";
        assert_eq!(text(0.45), off);
        let stays = "not an orbit of this map: the disk stays on the platform after impact 1";
        assert_eq!(text(f64::INFINITY), stays);
    }

    /// A count that was too large was once printed as 1073741825.0.
    #[test]
    fn whole_numbers_outside_of_their_range_have_no_fraction() {
        for (value, told) in [
            (1_073_741_825.0, "1073741825"),
            (f64::from(u32::MAX), "4294967295"),
            (0.0, "0"),
            (-1.0, "-1"),
            (0.1, "0.1"),
            (1e17, "1e17"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "NaN"),
        ] {
            let error = Error::OutOfRange { field: "count", value, legal: "[1, 10]" };
            assert_eq!(error.to_string(), format!("count = {told} is outside its legal range [1, 10]"));
        }
    }

    #[test]
    fn ranges_in_words_complete_the_sentence() {
        let told = |value, legal| Error::OutOfRange { field: "count", value, legal }.to_string();
        assert_eq!(told(0.0, "at least 1"), "count = 0 is not legal: it must be at least 1");
        assert_eq!(told(0.0, "(0, inf)"), "count = 0 is outside its legal range (0, inf)");
    }

    #[test]
    fn the_only_item_has_no_number() {
        let told =
            |index, count| Error::NotOfKind { what: "sample", index, count, expected: "finite" }.to_string();
        assert_eq!(told(0, 1), "the sample is not finite");
        assert_eq!(told(2, 5), "the sample 2 of 5 (counted from 0) is not finite");
    }

    #[test]
    fn memory_that_is_not_there_is_an_error_with_its_size() {
        for (count, limit) in [(11, 10), (u64::MAX, 10), (u64::MAX, u64::MAX), (1 << 60, u64::MAX)] {
            let refusal = Error::TooLarge { what: "numbers", count, limit };
            assert_eq!(room_for::<u64>("numbers", count, limit), Err(refusal));
            assert!(refusal.to_string().contains(&count.to_string()), "{refusal}");
        }
        assert!(room_for::<u64>("numbers", 10, 10).is_ok_and(|room| room.capacity() >= 10));
    }
}
