//! The drawing: the verdicts as a table.

use bouncing_disk_plot::{Figure, Label, ruled_table};

use super::data::ExtraLiteratureData;

/// The longest printed text that is drawn whole.
const LONGEST: usize = 44;

pub(super) fn draw(data: &ExtraLiteratureData) -> Figure {
    let header = ["", "quantity", "printed", "the exact map"].map(Label::new);
    let rows: Vec<Vec<Label>> = data
        .rows()
        .map(|(source, row)| {
            let printed = row.printed.as_deref().unwrap_or_default();
            let short: String = printed.chars().take(LONGEST).collect();
            let ellipsis = if printed.chars().count() > LONGEST { " …" } else { "" };
            vec![
                Label::plain(&source.id),
                Label::plain(&row.quantity),
                Label::plain(&format!("{short}{ellipsis}")),
                Label::plain(row.answer.judgement.words()),
            ]
        })
        .collect();
    ruled_table(&header, &rows)
}
