//! The list of all experiments.

use crate::experiment::Experiment;
use crate::figures;

/// A list of figures: their module, which has a function of the same name and `discussion.md` in its folder, and their title.
macro_rules! experiments {
    ($($id:ident: $title:literal,)*) => {
        vec![$(Experiment {
            id: stringify!($id),
            title: $title,
            discussion: include_str!(concat!("figures/", stringify!($id), "/discussion.md")),
            make: figures::$id::$id,
        }),*]
    };
}

/// The figures and tables of the paper, in its order.
pub fn all() -> Vec<Experiment> {
    experiments! {
        fig01: "The displacement variables of the bouncing disk",
        fig02: "Trajectories of tossing hands and stators",
        fig03: "Flow chart of the simulation",
        fig04: "The performance of single tosses",
        fig05: "Hand motions and the resulting dough trajectories",
        fig06: "Bifurcation diagrams",
        fig07: "Basins of attraction",
        fig08: "Geometric details of the ultrasonic motor",
        fig09: "Coefficient of friction from the rotor's deceleration",
        fig10: "Transient speed curves of the ultrasonic motor",
        fig11: "Effect of preload on steady-state speed and stall torque",
        fig12: "Speed transients of long-period and low-period chattering",
        fig13: "Effect of the estimated parameters on steady-state speed and stall torque",
        fig14: "Growth of the dough over multiple tosses",
        table1: "Full specification of a single toss",
        table2: "Effects of input parameter uncertainties",
        table3: "Default values for the dimensional parameters",
    }
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
pub fn select<'a>(entries: &'a [Experiment], ids: &[String]) -> Result<Vec<&'a Experiment>, UnknownId> {
    if let Some(given) = ids.iter().find(|given| !entries.iter().any(|entry| entry.id == **given)) {
        let known = entries.iter().map(|entry| entry.id).collect();
        return Err(UnknownId { given: given.clone(), known });
    }
    let asked = |entry: &&Experiment| ids.is_empty() || ids.iter().any(|given| given == entry.id);
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
        assert!(expected.iter().all(|id| ids.contains(&id.as_str())), "{ids:?}");
    }
}
