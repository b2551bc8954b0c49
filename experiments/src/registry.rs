//! The list of all experiments.

use crate::experiment::{RegisteredExperiment, entry};
use crate::figures::{
    fig01, fig02, fig03, fig04, fig05, fig06, fig07, fig08, fig09, fig10, fig11, fig12, fig13, fig14, table1,
    table2, table3,
};

/// The figures and tables of the paper, in its order.
pub fn all() -> Vec<RegisteredExperiment> {
    // One line per module of `figures`: `entry::<fig06::Fig06>(),`
    vec![
        entry::<fig01::Fig01>(),
        entry::<fig02::Fig02>(),
        entry::<fig03::Fig03>(),
        entry::<fig04::Fig04>(),
        entry::<fig05::Fig05>(),
        entry::<fig06::Fig06>(),
        entry::<fig07::Fig07>(),
        entry::<fig08::Fig08>(),
        entry::<fig09::Fig09>(),
        entry::<fig10::Fig10>(),
        entry::<fig11::Fig11>(),
        entry::<fig12::Fig12>(),
        entry::<fig13::Fig13>(),
        entry::<fig14::Fig14>(),
        entry::<table1::Table1>(),
        entry::<table2::Table2>(),
        entry::<table3::Table3>(),
    ]
}

/// An identifier that no experiment has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no figure or table is called \"{given}\"; known are: {}", known.join(", "))]
pub struct UnknownId {
    /// What was asked for.
    pub given: String,
    /// Every identifier there is.
    pub known: Vec<&'static str>,
}

/// The entries called `ids`, each once, in the order of `entries`; all of them when `ids` is empty.
pub fn select<'a>(
    entries: &'a [RegisteredExperiment],
    ids: &[String],
) -> Result<Vec<&'a RegisteredExperiment>, UnknownId> {
    if let Some(given) = ids.iter().find(|given| !entries.iter().any(|entry| entry.id == **given)) {
        let known = entries.iter().map(|entry| entry.id).collect();
        return Err(UnknownId { given: given.clone(), known });
    }
    let asked = |entry: &&RegisteredExperiment| ids.is_empty() || ids.iter().any(|given| given == entry.id);
    Ok(entries.iter().filter(asked).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::demo_entries;

    #[test]
    fn identifiers_select_in_the_order_of_the_list_and_an_unknown_one_lists_the_known() {
        let entries = demo_entries();
        let error = select(&entries, &["fig99".to_owned()]).expect_err("fig99 does not exist");
        assert_eq!(error.to_string(), "no figure or table is called \"fig99\"; known are: demo, broken");
        assert_eq!(select(&entries, &[]).expect("all").len(), entries.len());
        let selected = select(&entries, &["broken".to_owned(), "demo".to_owned()]).expect("both exist");
        assert_eq!(selected.iter().map(|entry| entry.id).collect::<Vec<_>>(), ["demo", "broken"]);
    }

    #[test]
    fn every_figure_and_table_of_the_paper_is_there() {
        let figures = (1..=14).map(|figure| format!("fig{figure:02}"));
        let expected: Vec<_> = figures.chain((1..=3).map(|table| format!("table{table}"))).collect();
        let ids: Vec<_> = all().iter().map(|entry| entry.id).collect();
        assert_eq!(ids, expected);
    }
}
