//! How many claims of which class came out how, in the words that every summary uses.
//!
//! Results page, gallery, README and the last lines of `cargo xtask figures` all count here, so that they
//! cannot count differently. The headline is about the paper alone: what was fitted, put in, is true by
//! construction or was added by this work stands beside it.

use std::collections::BTreeSet;

use crate::claims::{Claim, Class, Verdict};

/// Numbers of claims by class and verdict, the causes of the differences, and the second verdicts of motors.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    claims: [[usize; Verdict::ALL.len()]; Class::ALL.len()],
    causes: BTreeSet<String>,
    single_orbits: [usize; Verdict::ALL.len()],
}

impl Counts {
    /// Counts the claims.
    pub fn of<'a>(claims: impl IntoIterator<Item = &'a Claim>) -> Self {
        let mut counts = Self::default();
        for claim in claims {
            counts.claims[claim.class as usize][claim.verdict as usize] += 1;
            if claim.class == Class::Paper {
                counts.causes.extend(claim.cause.as_deref().map(str::to_owned));
                if let Some(single) = claim.single_orbits {
                    counts.single_orbits[single.verdict as usize] += 1;
                }
            }
        }
        counts
    }

    /// Those of the paper by verdict, and behind them the others by class.
    pub(super) fn row(&self) -> [usize; 8] {
        let [paper, others @ ..] = self.claims;
        let [fitted, input, identity, this_work] = others.map(|verdicts| verdicts.iter().sum());
        let [reproduced, differs, depends, no_data] = paper;
        [reproduced, differs, depends, no_data, fitted, input, identity, this_work]
    }

    /// The verdicts on the paper's own numbers and statements, in a sentence.
    pub fn headline(&self) -> String {
        let [reproduced, differs, depends, no_data, ..] = self.row();
        format!(
            "Of {} numbers and statements of the paper, {reproduced} are reproduced, {differs} differ (for {} causes), {depends} depend on \
             digits that it does not print, and for {no_data} its text lacks the data to compute them.",
            reproduced + differs + depends + no_data,
            self.causes.len(),
        )
    }

    /// The claims that are no evidence for or against the paper, in a sentence.
    pub fn beside(&self) -> String {
        let [.., fitted, inputs, identities, this_work] = self.row();
        let [reproduced, differs, depends, _] = self.single_orbits;
        let motors = match reproduced + differs + depends {
            0 => String::new(),
            motors => format!(
                " Of {motors} statements about the motor that are judged by the mean of an ensemble, single orbits reproduce {reproduced} and contradict \
                 {differs}; for {depends} the verdict depends on the orbit."
            ),
        };
        format!(
            "Not counted with these: {fitted} fitted numbers, {inputs} inputs and quotations, {identities} \
             identities and {this_work} findings of this work.{motors}"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_fitted_or_true_by_construction_is_not_counted_with_the_paper() {
        let claims = [
            Claim::printed("section4.doubling_1", 0.486),
            Claim::printed("section4.doubling_2", 0.6).cause("a misprint"),
            Claim::printed("section4.share_at_fig7a", 11.6).fitted("the window"),
            Claim::printed_statement("section3.stroke_components", true, ""),
            Claim::statement("fig06", "", "ours", true, ""),
        ];
        let counts = Counts::of(&claims);
        assert_eq!(counts.row(), [1, 1, 0, 0, 1, 0, 1, 1]);
        assert!(counts.headline().starts_with(
            "Of 2 numbers and statements of the paper, 1 are reproduced, 1 differ (for 1 causes)"
        ));
        assert!(counts.beside().contains("1 fitted numbers"));
    }
}
