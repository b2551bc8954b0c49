//! The drawing of Table I.

use bouncing_disk_plot::{Figure, Label, ruled_table};

use super::data::Table1Data;

pub(super) fn draw(data: &Table1Data) -> Figure {
    let header = ["", "printed", "computed", "from"].map(Label::new);
    let rows: Vec<Vec<Label>> = data
        .rows
        .iter()
        .map(|row| {
            let unit = if row.unit.is_empty() { String::new() } else { format!(" {}", row.unit) };
            let digits = row.decimals;
            let uncertainty = row
                .uncertainty
                .as_ref()
                .map_or_else(String::new, |uncertainty| format!(" ± {:.digits$}", uncertainty.sum));
            let computed = row
                .computed
                .map_or_else(String::new, |computed| format!("{computed:.digits$}{uncertainty}{unit}"));
            let printed = row.printed.as_ref().map_or_else(String::new, |text| format!("{text}{unit}"));
            vec![
                Label::new(&row.label),
                Label::plain(&printed),
                Label::plain(&computed),
                Label::new(&row.origin),
            ]
        })
        .collect();
    ruled_table(&header, &rows)
}
