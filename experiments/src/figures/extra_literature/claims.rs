//! Every judged statement as a claim of this work.

use super::data::{ExtraLiteratureData, Judgement};
use crate::claim::Claim;

const ID: &str = "extra-literature";

pub(super) fn claims(data: &ExtraLiteratureData) -> Vec<Claim> {
    let judged = data.rows().filter_map(|(source, row)| {
        let printed = row.printed.as_deref()?;
        let answer = &row.answer;
        let quantity = format!("{}, printed \"{printed}\"", row.quantity);
        let mut evidence = format!("the exact map: {}", answer.computed);
        if !answer.reason.is_empty() {
            evidence.push_str("; ");
            evidence.push_str(&answer.reason);
        }
        let claim = |holds: bool| {
            Claim::statement(ID, source.id.as_str(), quantity.as_str(), holds, evidence.as_str())
        };
        match (answer.judgement, answer.agreement) {
            (Judgement::NotComparable | Judgement::NothingPrinted, _) => None,
            (_, Some(agreement)) => Some(claim(true).judged_over(agreement)),
            (judgement, None) => Some(claim(judgement == Judgement::Agrees)),
        }
    });
    judged.collect()
}
