//! Which claims answer which entries of the [catalogue](super::catalogue).

use std::collections::BTreeSet;

use super::catalogue::{Class, entries, find};
use super::claim::{Claim, Computed};
use super::judging::{Kind, Verdict};

/// The claims of a figure or table that nothing can be computed for.
pub fn not_computable(figure: &str) -> Vec<Claim> {
    let of_figure = entries().unwrap_or_default().iter().filter(|entry| entry.figure == figure);
    of_figure
        .filter_map(|entry| entry.reason.as_deref().map(|reason| Claim::of_reason(entry, reason)))
        .collect()
}

/// The faults of the claims of a figure or table: entries that are not answered by exactly one claim (an
/// identity by one at most), claims that answer an entry of another figure, numbers that come from no entry,
/// claims without data or not judged by the rule of their kind, differences without a cause, and claims that
/// count for the paper though they do not answer an entry of its own.
pub fn faults(figure: &str, claims: &[Claim]) -> Vec<String> {
    let entries = match entries() {
        Ok(entries) => entries,
        Err(error) => return vec![error.to_string()],
    };
    let own: BTreeSet<&str> =
        entries.iter().filter(|entry| entry.figure == figure).map(|entry| entry.key.as_str()).collect();
    let unanswered = own.iter().filter_map(|key| {
        let answers = claims.iter().filter(|claim| claim.key.as_deref() == Some(*key));
        let count = answers.count();
        // A statement that is true by construction needs no answer.
        let optional = count == 0 && find(key).is_ok_and(|entry| entry.class == Class::Identity);
        (count != 1 && !optional).then(|| format!("{key} is answered by {count} claims"))
    });
    let of_claims = claims.iter().flat_map(|claim| {
        let of_paper = claim.class == Class::Paper;
        let differs = claim.verdict == Verdict::Differs;
        let entry = claim.key.as_deref().and_then(|key| find(key).ok());
        let answers_paper = entry.is_some_and(|entry| entry.class == Class::Paper);
        let misjudged = match claim.kind {
            Some(Kind::Motor) => claim.single_orbits.is_none(),
            Some(Kind::Measured) => of_paper && claim.share.is_none(),
            _ => false,
        };
        let foreign = match &claim.key {
            Some(key) => !own.contains(key.as_str()),
            None => !matches!(claim.computed, Computed::Boolean(_)) && claim.share.is_none(),
        };
        let faults = [
            (claim.lacks_data(), "has no data to be judged by"),
            (of_paper && !answers_paper, "counts for the paper and is not its own"),
            (differs && claim.note.is_empty(), "differs and no reason is given"),
            (of_paper && differs && claim.cause.is_none(), "differs and names no cause"),
            (misjudged, "is not judged as its kind has to be"),
            (foreign, "comes from no entry of this figure"),
        ];
        let found = faults.into_iter().filter(|(is_fault, _)| *is_fault);
        found.map(|(_, fault)| format!("\"{}\" {fault}", claim.quantity)).collect::<Vec<_>>()
    });
    unanswered.chain(of_claims).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn claims_take_the_printed_side_from_the_entry() {
        let claim = Claim::printed("section4.doubling_1", 0.486_003);
        let printed = [&claim.id, &claim.place, &claim.printed].map(String::as_str);
        assert_eq!(printed, ["fig06", "Fig. 6 caption", "0.486"]);
        assert_eq!(claim.verdict, Verdict::Reproduced);
        let claim = Claim::printed_statement("section4.single_tosses_end", false, "0.36");
        assert_eq!((claim.printed.as_str(), claim.verdict), ("true", Verdict::Differs));
        for claim in [
            Claim::printed("section4.no_such_number", 1.0),
            Claim::printed_statement("section4.no_such_statement", true, ""),
            Claim::printed("section4.three_branches", 3.0),
        ] {
            assert_eq!(claim.verdict, Verdict::Differs, "{claim:?}");
            assert!(!claim.note.is_empty(), "{claim:?}");
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
        claims.push(Claim::number(["fig06", "", "an own number", ""], "1", 1.0));
        let faults = faults("fig06", &claims).join("; ");
        for part in [
            "doubling_1 is answered by 2",
            "begins to slip\" comes from no",
            "\"an own number\" comes from no",
        ] {
            assert!(faults.contains(part), "{part}: {faults}");
        }
    }
}
