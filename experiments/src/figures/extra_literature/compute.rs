//! The computation: every entry of `data/literature` by the function that answers it.

use rayon::prelude::*;

use super::catalogue::{self, Entry};
use super::data::{Compared, ExtraLiteratureData, Row, Unread};
use super::{Answers, chaos, chile, exercises, others, paper, toronto, tufillaro};
use crate::experiment::ExperimentError;
use crate::progress::Progress;

type Computation = fn(&Entry) -> Answers;

/// What answers which entry, in the order of the file.
const COMPUTATIONS: &[(&str, Computation)] = &[
    ("LFY-1", paper::doublings),
    ("LFY-2", paper::period_one),
    ("LFY-3", paper::crisis),
    ("TAR-26", tufillaro::amplitudes),
    ("TAR-24", tufillaro::contraction),
    ("TAR-20", tufillaro::bound),
    ("TAR-22", tufillaro::sticking),
    ("TAR-21", tufillaro::stopping_time),
    ("TAR-28", tufillaro::both_attract),
    ("TAR-39", tufillaro::coexistence),
    ("TAR-18", tufillaro::high_bounce),
    ("MAPLE-1", exercises::window),
    ("MAPLE-2", exercises::behaviour),
    ("MAPLE-3", exercises::behaviour),
    ("TOR-0", toronto::one_impact),
    ("TOR-1", toronto::stable_orbit),
    ("TOR-2", toronto::stable_orbit),
    ("TOR-3", toronto::stable_orbit),
    ("TOR-4", toronto::stable_orbit),
    ("TOR-5", toronto::stable_orbit),
    ("TOR-6", toronto::stable_orbit),
    ("TOR-7", toronto::sticking),
    ("TOR-8", toronto::restitutions),
    ("UCH-0", chile::diagram),
    ("UCH-1", chile::bands),
    ("UCH-2", chile::doublings),
    ("UCH-3", chile::third_report),
    ("UCH-4", chile::two_speeds),
    ("UCH-5", chile::one_speed),
    ("UCH-6", chile::slowing),
    ("DEV-1", others::rest_to_rest),
    ("BAR-1", others::strip),
    ("CED-1", chaos::three_and_chaos),
    ("VL-1", chaos::open_question),
    ("BAO-1", others::impulse_ratio),
    ("OPP-1", others::periods),
    ("DOR-1", others::without_bounce),
    ("LIV-1", chaos::mechanism),
    ("FER-1", others::mean_square),
];

pub(super) fn compute(progress: &dyn Progress) -> Result<ExtraLiteratureData, ExperimentError> {
    let entries = catalogue::entries()?;
    progress.start(entries.len() as u64, "statements");
    let sources = entries
        .into_par_iter()
        .map(|entry| {
            let compared = compared(entry);
            progress.advance(1);
            compared
        })
        .collect::<Result<_, _>>()?;
    let not_read = catalogue::not_read()?
        .into_iter()
        .map(|catalogue::NotRead { source, seen }| Unread { source, seen })
        .collect();
    Ok(ExtraLiteratureData { sources, not_read })
}

/// An entry with its answers: one for each of its statements, in their order.
fn compared(entry: Entry) -> Result<Compared, ExperimentError> {
    let none = || ExperimentError::NoData { quantity: entry.id.clone() };
    let (_, computation) = COMPUTATIONS.iter().find(|(id, _)| *id == entry.id).ok_or_else(none)?;
    let answers = computation(&entry)
        .map_err(|source| ExperimentError::Search { quantity: entry.id.clone(), source: Box::new(source) })?;
    if !answers.iter().map(|(name, _)| *name).eq(entry.statements.iter().map(|own| own.name.as_str())) {
        return Err(none());
    }
    let Entry { id, source, address, quotation, statements, .. } = entry;
    let rows = statements.into_iter().zip(answers).map(|(statement, (_, answer))| Row {
        name: statement.name,
        quantity: statement.quantity,
        printed: statement.printed,
        answer,
    });
    Ok(Compared { id, source, address, quotation, rows: rows.collect() })
}

#[cfg(test)]
mod tests {
    use super::super::data::Judgement;
    use super::*;
    use crate::progress::Silent;

    #[test]
    fn every_entry_has_a_computation_and_every_computation_an_entry() {
        let entries = catalogue::entries().expect("legal");
        let ids: Vec<&str> = entries.iter().map(|entry| entry.id.as_str()).collect();
        let computed: Vec<&str> = COMPUTATIONS.iter().map(|(id, _)| *id).collect();
        assert_eq!(ids, computed);
    }

    #[test]
    fn an_entry_without_a_computation_or_with_another_statement_is_an_error() {
        let entry = |id: &str| {
            let mut entry = catalogue::entries().expect("legal").remove(0);
            entry.id = id.to_owned();
            entry
        };
        assert!(compared(entry("LFY-1")).is_ok());
        assert!(compared(entry("LFY-9")).is_err());
        let mut shorter = entry("LFY-1");
        shorter.statements.swap(0, 1);
        assert!(compared(shorter).is_err());
    }

    /// What is not printed is not judged, what differs or cannot be compared says why.
    #[test]
    fn every_judgement_fits_what_is_printed() {
        let data = compute(&Silent).expect("computed");
        for (source, row) in data.rows() {
            let answer = &row.answer;
            let nothing = answer.judgement == Judgement::NothingPrinted;
            assert_eq!(nothing, row.printed.is_none(), "{} {}", source.id, row.name);
            assert!(!answer.computed.is_empty() && !answer.computed.contains("NaN"), "{}", source.id);
            let agrees = answer.judgement == Judgement::Agrees;
            assert!(agrees || nothing || !answer.reason.is_empty(), "{} {}", source.id, row.name);
        }
    }
}
