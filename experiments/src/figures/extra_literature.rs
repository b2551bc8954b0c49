//! Beyond the paper: what others have published on bouncing balls, beside what the exact map gives.

mod behaviour;
mod catalogue;
mod chaos;
mod chile;
mod claims;
mod compute;
mod data;
mod draw;
mod exercises;
mod high_bounce;
mod others;
mod page;
mod paper;
mod speeds;
mod toronto;
mod tufillaro;
mod windows;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;
use serde_json::Value;

use self::catalogue::Entry;
pub use self::data::ExtraLiteratureData;
use self::data::{Answer, Judgement};
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;
use crate::table::{Cell, Table};

/// Answers by the names of the statements.
type Answers = Result<Vec<(&'static str, Answer)>, ExperimentError>;

/// What the literature says.
#[derive(Debug)]
pub struct ExtraLiterature;

impl Experiment for ExtraLiterature {
    type Data = ExtraLiteratureData;
    const ID: &'static str = "extra-literature";
    const TITLE: &'static str = "The literature beside us";
    const DISCUSSION: &'static str = include_str!("extra_literature/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(data: &ExtraLiteratureData) -> String {
        let counts =
            Judgement::ALL.map(|judgement| format!("{} {}", judgement.words(), data.count(judgement)));
        format!(
            "What {} passages of others state of bouncing balls, beside the exact map: {}. Their words, and what comes out, are in \
             docs/literature.md.",
            data.sources.len(),
            counts.join(", ")
        )
    }

    fn compute(_: Quality, progress: &dyn Progress) -> Result<ExtraLiteratureData, ExperimentError> {
        compute::compute(progress)
    }

    fn draw(data: &ExtraLiteratureData) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &ExtraLiteratureData) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &ExtraLiteratureData) -> Vec<(String, String)> {
        [
            ("passages", data.sources.len().to_string()),
            ("statements", data.rows().count().to_string()),
            ("sources that could not be read", data.not_read.len().to_string()),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .into()
    }

    fn table(data: &ExtraLiteratureData) -> Option<Table> {
        let mut table = Table::new(["id", "source", "quantity", "printed", "computed", "verdict", "reason"]);
        for (source, row) in data.rows() {
            table.push([
                Cell::from(source.id.as_str()),
                Cell::from(source.source.as_str()),
                Cell::from(row.quantity.as_str()),
                row.printed.as_deref().map_or(Cell::Empty, Cell::from),
                Cell::from(row.answer.computed.as_str()),
                Cell::from(row.answer.judgement.words()),
                Cell::from(row.answer.reason.as_str()),
            ]);
        }
        Some(table)
    }
}

impl ExtraLiterature {
    /// The page `docs/literature.md`, from the stored data.
    ///
    /// # Errors
    ///
    /// When another version wrote them and they do not fit.
    pub fn page(stored: Value) -> Result<String, ExperimentError> {
        let data: ExtraLiteratureData =
            serde_path_to_error::deserialize(stored).map_err(ExperimentError::Stored)?;
        Ok(page::page(&data))
    }
}

/// A number that is compared with the printed one of a statement, within half a unit of its last digit.
fn rounds_to_printed(entry: &Entry, name: &str, computed: f64) -> Result<Answer, ExperimentError> {
    rounds_within(entry, name, computed, 0.0)
}

/// The same within a tolerance that is printed, too, where it is the larger one.
fn rounds_within(
    entry: &Entry,
    name: &str,
    computed: f64,
    tolerance: f64,
) -> Result<Answer, ExperimentError> {
    const DIGITS: usize = 7;
    let printed = entry.printed(name)?;
    // A value between two printed ones may round either way; the decimal digits are rounded themselves.
    let tolerance = printed.half_unit.max(tolerance) * (1.0 + 1e-9);
    Ok(Answer::number(computed, DIGITS, (computed - printed.value).abs() <= tolerance))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_agrees_up_to_half_a_unit_of_its_last_digit() {
        let entries = catalogue::entries().expect("legal");
        // Printed 0.486.
        let (entry, name) = (&entries[0], "doubling_1");
        let judged = |computed| rounds_to_printed(entry, name, computed).expect("printed").judgement;
        for agreeing in [0.4855, 0.486, 0.4865] {
            assert_eq!(judged(agreeing), Judgement::Agrees, "{agreeing}");
        }
        for other in [0.4854, 0.4866, 0.0, -0.486, f64::NAN, f64::INFINITY] {
            assert_eq!(judged(other), Judgement::Differs, "{other}");
        }
        // A printed grid counts where it is wider, and never narrows.
        let within = |computed, grid| rounds_within(entry, name, computed, grid).expect("printed").judgement;
        assert_eq!(within(0.4885, 0.003), Judgement::Agrees);
        assert_eq!(within(0.4865, 1e-9), Judgement::Agrees);
        assert!(rounds_to_printed(entry, "nothing", 0.486).is_err());
    }
}
