//! Which claims answer which entries of the [catalogue](crate::catalogue).

use std::collections::BTreeSet;

use crate::catalogue::{Class, entries, find};
use crate::claim::{Claim, Computed, Source, Verdict};
use crate::judging::Kind;

/// The claims of a figure or table that nothing can be computed for.
pub fn not_computable(figure: &str) -> Vec<Claim> {
    let of_figure = entries().unwrap_or_default().iter().filter(|entry| entry.figure == figure);
    of_figure
        .filter_map(|entry| entry.reason.as_deref().map(|reason| Claim::of_reason(entry, reason)))
        .collect()
}

/// What is wrong with the claims of a figure or table: entries that are not answered by exactly one claim (an identity by one at most), claims that
/// answer what is not theirs, numbers that come from no entry, claims without data or not judged as their kind has to be, differences
/// without a cause, and claims that count for the paper though they do not answer an entry of its own.
pub fn faults(figure: &str, claims: &[Claim]) -> Vec<String> {
    let mut faults = Vec::new();
    let entries = match entries() {
        Ok(entries) => entries,
        Err(error) => return vec![error.to_string()],
    };
    let own: BTreeSet<&str> =
        entries.iter().filter(|entry| entry.figure == figure).map(|entry| entry.key.as_str()).collect();
    for key in &own {
        let answers = claims.iter().filter(|claim| matches!(claim.source(), Source::Entry(of) if of == key));
        let count = answers.count();
        // What is true by construction needs no answer.
        let optional = count == 0 && find(key).is_ok_and(|entry| entry.class == Class::Identity);
        if count != 1 && !optional {
            faults.push(format!("{key} is answered by {count} claims"));
        }
    }
    for claim in claims {
        if claim.lacks_data() {
            faults.push(format!("\"{}\" has no data to be judged by", claim.quantity()));
        }
        let of_paper = match claim.source() {
            Source::Entry(key) => find(key).is_ok_and(|entry| entry.class == Class::Paper),
            _ => false,
        };
        if claim.class() == Class::Paper && !of_paper {
            faults.push(format!("\"{}\" counts for the paper and is not its own", claim.quantity()));
        }
        if claim.verdict() == Verdict::Differs && claim.remarks().is_empty() {
            faults.push(format!("\"{}\" differs and no reason is given", claim.quantity()));
        }
        let causeless = claim.verdict() == Verdict::Differs && claim.cause_of_difference().is_none();
        if claim.class() == Class::Paper && causeless {
            faults.push(format!("\"{}\" differs and names no cause", claim.quantity()));
        }
        let lacks = match claim.kind() {
            Some(Kind::Motor) => claim.of_single_orbits().is_none(),
            Some(Kind::Measured) => claim.class() == Class::Paper && claim.share().is_none(),
            _ => false,
        };
        if lacks {
            faults.push(format!("\"{}\" is not judged as its kind has to be", claim.quantity()));
        }
        match claim.source() {
            Source::Entry(key) if !own.contains(key.as_str()) => {
                faults.push(format!("{key} is no entry of {figure}"));
            }
            Source::Reading(key) if find(key).is_err() => faults.push(format!("{key} is no entry")),
            Source::ThisWork
                if !matches!(claim.computed(), Computed::Boolean(_)) && claim.share().is_none() =>
            {
                faults.push(format!("\"{}\" comes from no entry", claim.quantity()));
            }
            _ => {}
        }
    }
    faults
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn claims_take_the_printed_side_from_the_entry() {
        let claim = Claim::printed("section4.doubling_1", 0.486_003);
        assert_eq!((claim.id(), claim.place(), claim.printed_text()), ("fig06", "Fig. 6 caption", "0.486"));
        assert_eq!(claim.verdict(), Verdict::Reproduced);
        let claim = Claim::printed_statement("section4.single_tosses_end", false, "0.36");
        assert_eq!((claim.printed_text(), claim.verdict()), ("true", Verdict::Differs));
        let claim = Claim::reading("table2", "section3.predicted_airborne_speed", "all", 14.2);
        assert_eq!((claim.id(), claim.verdict()), ("table2", Verdict::Reproduced));
        assert!(matches!(claim.source(), Source::Reading(_)));
    }

    #[test]
    fn an_unknown_key_differs_and_says_so() {
        for claim in [
            Claim::printed("section4.no_such_number", 1.0),
            Claim::printed_statement("section4.no_such_statement", true, ""),
            Claim::printed("section4.three_branches", 3.0),
        ] {
            assert_eq!(claim.verdict(), Verdict::Differs, "{claim:?}");
            assert!(!claim.remarks().is_empty(), "{claim:?}");
        }
    }

    #[test]
    fn faults_name_what_is_missing_double_foreign_or_from_nowhere() {
        let mut claims = not_computable("fig06");
        let missing = faults("fig06", &claims).len();
        claims.push(Claim::printed("section4.doubling_1", 0.486_003));
        assert_eq!(faults("fig06", &claims).len(), missing - 1);
        claims.push(Claim::printed("section4.doubling_1", 0.486_003));
        claims.push(Claim::printed("table1.friction", 0.577));
        claims.push(Claim::number("fig06", "", "an own number", "", "1", 1.0));
        let faults = faults("fig06", &claims).join("; ");
        for part in ["doubling_1 is answered by 2", "friction is no entry of fig06", "an own number"] {
            assert!(faults.contains(part), "{faults}");
        }
    }
}
