//! The claims as the report groups them: by rule, by cause, and by what is missing.

use minijinja::{Value, context};

use super::Row;
use crate::claims::{Claim, Class, Computed, Kind, Verdict};

/// What the template of the report takes from all claims. Only those of the paper are in it.
pub(super) fn values<'a>(claims: impl IntoIterator<Item = &'a Claim>) -> Value {
    let paper: Vec<&Claim> = claims.into_iter().filter(|claim| claim.class == Class::Paper).collect();
    let counts = |of_rule: &dyn Fn(Option<Kind>) -> bool| {
        let of_verdict = |verdict| move |claim: &&&Claim| of_rule(claim.kind) && claim.verdict == verdict;
        Verdict::ALL.map(|verdict| paper.iter().filter(of_verdict(verdict)).count())
    };
    let rows = |selects: &dyn Fn(&Claim) -> bool| -> Vec<Row> {
        paper.iter().filter(|claim| selects(claim)).map(|claim| Row::of(claim)).collect()
    };
    let rule = |kind: &Kind| context! { name => kind.name(), rule => kind.rule(), counts => counts(&|own| own == Some(*kind)) };
    let cause = |cause: &str| {
        let rows = rows(&|claim| claim.cause == Some(cause));
        let places = distinct(rows.iter().map(|row| row.place.as_str()));
        context! { cause, places, rows }
    };
    let has_value = |claim: &Claim| claim.computed != Computed::Nothing;
    context! {
        rules => Kind::ALL.iter().map(rule).collect::<Vec<_>>(),
        unruled => counts(&|kind| kind.is_none()),
        together => counts(&|_| true),
        causes => distinct(paper.iter().filter_map(|claim| claim.cause)).into_iter().map(cause).collect::<Vec<_>>(),
        conclusions => rows(&|claim| claim.place.to_lowercase().contains("abstract")),
        dependent => rows(&|claim| claim.verdict == Verdict::DependsOnUnprintedDigits),
        undefined => rows(&|claim| claim.verdict == Verdict::NotComputable && has_value(claim)),
        missing => rows(&|claim| claim.verdict == Verdict::NotComputable && !has_value(claim)),
    }
}

/// Each text once, in the order of their first places.
fn distinct<'a>(texts: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    texts.fold(Vec::new(), |mut found, text| {
        if !found.contains(&text) {
            found.push(text);
        }
        found
    })
}
