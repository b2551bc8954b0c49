//! The lists of all experiments: those of the paper, and those beyond it.

use crate::experiment::{RegisteredExperiment, entry};
use crate::figures::{
    extra_branches, extra_cascade, extra_contact, extra_crisis, extra_design, extra_drives, extra_efficiency,
    extra_fit, extra_lyapunov, extra_manifolds, extra_regimes, extra_restitution_law, extra_torque_speed,
    extra_traps, extra_yielding, fig01, fig02, fig03, fig04, fig05, fig06, fig07, fig08, fig09, fig10, fig11,
    fig12, fig13, fig14, table1, table2, table3,
};
use crate::measured::Layout;

/// The figures and tables of the paper, in its order.
pub fn paper() -> Vec<RegisteredExperiment> {
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

/// The figures beyond the paper, made only when they are asked for.
pub fn extras() -> Vec<RegisteredExperiment> {
    // One line per module of `figures`, whose name has underscores where the identifier has hyphens.
    vec![
        entry::<extra_torque_speed::ExtraTorqueSpeed>(),
        entry::<extra_efficiency::ExtraEfficiency>(),
        entry::<extra_restitution_law::ExtraRestitutionLaw>(),
        entry::<extra_traps::ExtraTraps>(),
        entry::<extra_fit::ExtraFit>(),
        entry::<extra_design::ExtraDesign>(),
        entry::<extra_lyapunov::ExtraLyapunov>(),
        entry::<extra_regimes::ExtraRegimes>(),
        entry::<extra_branches::ExtraBranches>(),
        entry::<extra_cascade::ExtraCascade>(),
        entry::<extra_crisis::ExtraCrisis>(),
        entry::<extra_manifolds::ExtraManifolds>(),
        entry::<extra_drives::ExtraDrives>(),
        entry::<extra_contact::ExtraContact>(),
        entry::<extra_yielding::ExtraYielding>(),
    ]
}

/// All experiments: those of the paper, and behind them those beyond it.
pub fn all() -> Vec<RegisteredExperiment> {
    paper().into_iter().chain(extras()).collect()
}

/// The files of measurements that all experiments together can show.
pub fn measurements(entries: &[RegisteredExperiment]) -> Vec<Layout> {
    entries.iter().flat_map(|entry| entry.measurements.iter().copied()).collect()
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
    fn the_paper_is_there_and_what_is_beyond_it_says_so_once() {
        let figures = (1..=14).map(|figure| format!("fig{figure:02}"));
        let expected: Vec<_> = figures.chain((1..=3).map(|table| format!("table{table}"))).collect();
        let ids: Vec<_> = paper().iter().map(|entry| entry.id).collect();
        assert_eq!(ids, expected);
        assert!(
            paper().iter().all(|entry| !entry.is_extra()) && extras().iter().all(|entry| entry.is_extra())
        );
        let mut ids: Vec<_> = extras().iter().map(|entry| entry.id).collect();
        for words in &ids {
            let legal = |word: &str| !word.is_empty() && word.bytes().all(|b| b.is_ascii_lowercase());
            assert!(words.split('-').all(legal), "{words}");
        }
        let count = ids.len();
        ids.sort_unstable();
        ids.dedup();
        assert!(count > 0 && ids.len() == count);
    }

    #[test]
    fn the_readme_of_the_measurements_states_every_layout() {
        const README: &str = include_str!("../../data/measured/README.md");
        for layout in measurements(&all()) {
            let (_, section) =
                README.split_once(&format!("### `{}`", layout.file)).expect("a section of its own");
            let (_, block) = section.split_once("```csv\n").expect("an example");
            let (example, _) = block.split_once("```").expect("its end");
            assert_eq!(example.lines().next(), Some(layout.header().as_str()), "{}", layout.file);
            let single = Layout { least_rows: 1, ..layout };
            crate::measured::Series::read(&single, example.as_bytes()).expect("a legal example");
            for column in layout.columns {
                assert!(section.contains(&format!("| `{}` |", column.name)), "{}", column.name);
            }
        }
    }
}
