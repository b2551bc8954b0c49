//! `docs/performance.md`: the template with the numbers of a run.

use std::fmt::Write as _;

use anyhow::bail;

use super::record::{Record, Reference};
use super::table::{self, digits, time};

const TEMPLATE: &str = include_str!("performance.md");
/// What stands where there is no number.
const NOT_MEASURED: &str = "not measured in this run";

/// A number that is held against a floor and a goal.
struct Aim {
    what: &'static str,
    unit: &'static str,
    /// Whether more is better.
    rate: bool,
    floor: f64,
    /// The same as the floor where there is only one number.
    goal: f64,
    value: Option<f64>,
    /// The same from the middle of all measurements.
    middle: Option<f64>,
    /// Whether the run was long enough for a verdict.
    decides: bool,
}

impl Aim {
    fn reaches(&self, value: f64, aim: f64) -> bool {
        if self.rate { value >= aim } else { value <= aim }
    }

    fn verdict(&self) -> &'static str {
        match self.value {
            None => "-",
            Some(_) if !self.decides => "no verdict from a short run",
            Some(value) if self.reaches(value, self.goal) => "met",
            Some(value) if self.reaches(value, self.floor) => "floor met, goal not",
            Some(_) => "**not met**",
        }
    }

    fn row(&self) -> String {
        let number = |value: f64| if value >= 1.0e3 { grouped(value) } else { digits(value) };
        let goal = if self.reaches(self.floor, self.goal) { "-".to_owned() } else { number(self.goal) };
        let value = self.value.map_or_else(|| NOT_MEASURED.to_owned(), number);
        let middle = self.middle.map_or_else(|| "-".to_owned(), number);
        let (what, unit, floor) = (self.what, self.unit, number(self.floor));
        format!("| {what} | {unit} | {floor} | {goal} | {value} | {middle} | {} |\n", self.verdict())
    }
}

/// A whole number with commas, three digits significant.
fn grouped(value: f64) -> String {
    let mut scale = 1.0;
    while value / scale >= 1.0e3 {
        scale *= 10.0;
    }
    table::with_commas(((value / scale).round() * scale) as usize)
}

/// Which of the times of a bench is meant.
type Time = fn(&Record, &str) -> Option<f64>;

/// How much faster two threads are; only where two processors were there.
fn speed_up(run: &Record, prefix: &str, time: Time) -> Option<f64> {
    let of = |threads: usize| time(run, &format!("{prefix}threads_{threads}"));
    (run.machine.processors >= 2).then(|| Some(of(1)? / of(2)?)).flatten()
}

fn aims(run: &Record) -> Vec<Aim> {
    let two = run.machine.processors >= 2;
    let decides = !run.quick;
    let aim = |what, unit, rate, (floor, goal), value, middle| Aim {
        what,
        unit,
        rate,
        floor,
        goal,
        value,
        middle,
        decides,
    };
    let both = |of: &dyn Fn(Time) -> Option<f64>| (of(Record::median_ns), of(Record::middle_ns));
    let time = |what, aims, name: &str| {
        let (value, middle) = both(&|time| time(run, name));
        aim(what, "ns an impact", false, aims, value, middle)
    };
    let rate = |what, unit, aims, name: &str| {
        let (value, middle) = both(&|time| time(run, name).map(|ns| 1.0e9 / ns));
        aim(what, unit, true, aims, value, middle)
    };
    let panel =
        |time: Time| time(run, "w3/panel_1000/threads_2").filter(|_| two).map(|ns| ns * 1.0e6 / 1.0e9);
    let (panel, panel_middle) = both(&panel);
    let (faster, faster_middle) = both(&|time| speed_up(run, "w3/panel_1000/", time));
    let once =
        |what, floor, value: Option<f64>| aim(what, "s", false, (floor, floor), value.filter(|_| two), None);
    vec![
        time("W1, one after the other", (130.0, 95.0), "w1/scalar"),
        time("W1, in lockstep, AVX-512", (8.0, 5.0), "w1/lanes/Avx512"),
        time("W1, in lockstep, AVX2", (12.0, 9.0), "w1/lanes/Avx2"),
        time("W1, in lockstep, baseline", (22.0, 22.0), "w1/lanes/Baseline"),
        rate("W2, one motor", "motor s/s", (5_500.0, 5_500.0), "w2/one_motor"),
        rate("W2, ensemble, a core", "motor s/s", (4.0e4, 4.0e4), "w2/ensemble/threads_1"),
        rate("W3, a core", "cells/s", (3.0e6, 8.0e6), "w3/threads_1"),
        aim("panel of 1000 x 1000 cells, two threads", "s", false, (0.2, 0.2), panel, panel_middle),
        aim("panel, two threads over one", "times", true, (1.9, 1.9), faster, faster_middle),
        once("all figures, draft, two processors", 15.0, run.figures.map(|figures| figures.draft_s)),
        once("all figures, paper, two processors", 120.0, run.figures.map(|figures| figures.paper_s)),
        once("release build of xtask from nothing, two processors", 180.0, run.build_s),
    ]
}

fn aims_table(run: &Record) -> String {
    let head =
        "| | unit | floor | goal | measured | middle | |\n| --- | --- | ---: | ---: | ---: | ---: | --- |\n";
    aims(run).iter().fold(head.to_owned(), |text, aim| text + &aim.row())
}

/// How a time grows along a group of benches whose last name is a number.
fn growth_table(run: &Record, group: &str, along: &str) -> String {
    let prefix = format!("growth/{group}/");
    let number = |name: &str| name.strip_prefix(&prefix)?.parse::<f64>().ok();
    let mut points: Vec<_> =
        run.benches.iter().filter_map(|(name, measured)| Some((number(name)?, measured))).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let Some((_, first)) = points.first().copied() else { return format!("{NOT_MEASURED}\n") };
    let mut text = format!(
        "| {along} | time of one {} | against the first |\n| ---: | ---: | ---: |\n",
        table::element(&prefix)
    );
    for (at, measured) in points {
        let at = if at >= 1.0e3 { grouped(at) } else { at.to_string() };
        let against = measured.ratio() / first.ratio();
        let _ = writeln!(text, "| {at} | {} | {against:.2} |", time(measured.median_ns));
    }
    text
}

/// What an impact costs in pairs.
fn limit_table(run: &Record) -> String {
    let mut text =
        "| | one impact | one pair | pairs an impact costs |\n| --- | ---: | ---: | ---: |\n".to_owned();
    let rows = [
        ("one after the other", "w1/scalar", "limit/pair/chained"),
        ("in lockstep, baseline", "w1/lanes/Baseline", "limit/pair/lanes/Baseline"),
        ("in lockstep, AVX2", "w1/lanes/Avx2", "limit/pair/lanes/Avx2"),
        ("in lockstep, AVX-512", "w1/lanes/Avx512", "limit/pair/lanes/Avx512"),
    ];
    for (what, impact, pair) in rows {
        let (Some(impact), Some(pair)) = (run.benches.get(impact), run.benches.get(pair)) else {
            let _ = writeln!(text, "| {what} | {NOT_MEASURED} | | |");
            continue;
        };
        let (ns, pair_ns) = (time(impact.median_ns), time(pair.median_ns));
        let _ = writeln!(text, "| {what} | {ns} | {pair_ns} | {} |", digits(impact.ratio() / pair.ratio()));
    }
    text
}

fn threads_table(run: &Record) -> String {
    if run.machine.processors < 2 {
        return "Not measured in this run: one processor was available.\n".to_owned();
    }
    let prefixes = run.benches.keys().filter_map(|name| name.strip_suffix("threads_1"));
    let mut text = "| | one thread | two threads | times faster | by the middles |\n| --- | ---: | ---: | ---: | ---: |\n"
        .to_owned();
    for prefix in prefixes {
        let of = |threads: usize| run.median_ns(&format!("{prefix}threads_{threads}")).map(time);
        let faster = |time: Time| speed_up(run, prefix, time);
        let faster = (faster(Record::median_ns), faster(Record::middle_ns));
        if let (Some(one), Some(two), (Some(faster), Some(middle))) = (of(1), of(2), faster) {
            let name = prefix.trim_end_matches(['_', '/']);
            let _ = writeln!(text, "| `{name}` | {one} | {two} | {faster:.2} | {middle:.2} |");
        }
    }
    text
}

/// Our numbers in the units of the other tools' table.
fn own_row(run: &Record) -> String {
    let cell = |value: Option<f64>| value.map_or_else(|| NOT_MEASURED.to_owned(), grouped);
    let ns = |name: &str| run.median_ns(name).map_or_else(|| NOT_MEASURED.to_owned(), digits);
    let rate = |name: &str| cell(run.median_ns(name).map(|ns| 1.0e9 / ns));
    let one = format!(
        "| this crate, one after the other | {} | {} | {} |",
        ns("w1/scalar"),
        rate("w2/one_motor"),
        rate("w3/scalar")
    );
    let best = ["Avx512", "Avx2", "Baseline"]
        .into_iter()
        .map(|set| format!("w1/lanes/{set}"))
        .find(|name| run.benches.contains_key(name))
        .unwrap_or_default();
    format!(
        "{one}\n| this crate, in lockstep, one thread | {} | {} | {} |",
        ns(&best),
        rate("w2/ensemble/threads_1"),
        rate("w3/threads_1")
    )
}

fn run_table(run: &Record, baseline: Option<&Record>) -> String {
    let mut text = match baseline {
        Some(_) => "| | this run | baseline |\n| --- | --- | --- |\n".to_owned(),
        None => "| | this run |\n| --- | --- |\n".to_owned(),
    };
    let mut row = |name: &str, value: &dyn Fn(&Record) -> String| {
        let values = std::iter::once(run).chain(baseline).map(value);
        let _ = writeln!(text, "| {name} | {} |", values.collect::<Vec<_>>().join(" | "));
    };
    row("processor", &|run| run.machine.processor.clone());
    row("processors used", &|run| run.machine.processors.to_string());
    row("compiler", &|run| run.machine.compiler.clone());
    row("source", &|run| format!("`{}`", run.machine.source));
    for reference in Reference::ALL {
        row(&format!("reference `{}`", reference.name()), &|run| {
            run.reference_ns(reference).map_or_else(|| "-".to_owned(), time)
        });
    }
    row("measured", &|run| if run.quick { "once" } else { "several times" }.to_owned());
    text
}

/// The page.
pub(super) fn page(run: &Record, baseline: Option<&Record>) -> anyhow::Result<String> {
    let tables = [
        ("run", run_table(run, baseline)),
        ("aims", aims_table(run)),
        ("all", table::markdown(&table::rows(run, baseline))),
        ("growth_cells", growth_table(run, "cells", "cells")),
        ("growth_impacts", growth_table(run, "impacts", "impacts")),
        ("growth_forcing", growth_table(run, "forcing", "Γ")),
        ("growth_flight", growth_table(run, "flight_periods", "periods in flight")),
        ("limit", limit_table(run)),
        ("threads", threads_table(run)),
        ("own", own_row(run)),
    ];
    let mut page = TEMPLATE.to_owned();
    for (name, text) in tables.into_iter().chain(super::workloads::places()?) {
        let place = format!("{{{{{name}}}}}");
        if !page.contains(&place) {
            bail!("the template of the page has no place {place}");
        }
        page = page.replace(&place, text.trim_end());
    }
    if let Some((_, rest)) = page.split_once("{{") {
        bail!(
            "the template of the page has an unknown place {{{{{}",
            rest.lines().next().unwrap_or_default()
        );
    }
    Ok(page)
}

#[cfg(test)]
mod tests {
    use super::super::record::tests::record;
    use super::*;

    #[test]
    fn every_place_of_the_template_is_filled() {
        let run = record(&[("growth/cells/100", 400.0), ("growth/cells/10000", 300.0)]);
        let page = page(&run, Some(&run)).expect("complete");
        assert!(page.contains("| 10,000 | 300 ns | 0.75 |"), "{page}");
        assert!(
            page.contains("| `growth/cells/100` | 400 ns | 400 ns of 1 | cell | chain | 40.0 | 40.0 |"),
            "{page}"
        );
    }

    #[test]
    fn a_verdict_needs_a_measurement() {
        let rows = |run: &Record| aims_table(run);
        let line = |text: &str, start: &str| {
            text.lines().find(|line| line.starts_with(start)).expect("listed").to_owned()
        };
        let mut run = record(&[("w1/scalar", 180.0), ("w3/panel_1000/threads_2", 100.0)]);
        run.add(record(&[("w1/scalar", 90.0)]).benches);
        let scalar = line(&rows(&run), "| W1, one after");
        // The least time decides, not the middle.
        assert_eq!(scalar, "| W1, one after the other | ns an impact | 130 | 95.0 | 90.0 | 135 | met |");
        assert!(line(&rows(&run), "| W1, in lockstep, AVX2").ends_with("not measured in this run | - | - |"));
        assert!(line(&rows(&run), "| panel").ends_with("| 0.100 | 0.100 | met |"));
        run.build_s = Some(190.0);
        assert!(line(&rows(&run), "| release build").ends_with("| 190 | - | **not met** |"));
        // Two threads on one processor are no measurement of two threads.
        run.machine.processors = 1;
        assert!(line(&rows(&run), "| release build").ends_with("not measured in this run | - | - |"));
        assert!(line(&rows(&run), "| panel").ends_with("not measured in this run | - | - |"));
        run.benches = record(&[("w1/scalar", 110.0)]).benches;
        assert!(line(&rows(&run), "| W1, one after").ends_with("| 110 | 110 | floor met, goal not |"));
        run.benches = record(&[("w1/scalar", 140.0)]).benches;
        assert!(line(&rows(&run), "| W1, one after").ends_with("| 140 | 140 | **not met** |"));
        run.quick = true;
        assert!(
            line(&rows(&run), "| W1, one after").ends_with("| 140 | 140 | no verdict from a short run |")
        );
    }

    #[test]
    fn two_threads_are_held_against_one_by_the_least_times_and_by_the_middles() {
        let mut run = record(&[("w3/threads_1", 400.0), ("w3/threads_2", 200.0)]);
        run.add(record(&[("w3/threads_1", 300.0), ("w3/threads_2", 240.0)]).benches);
        let table = threads_table(&run);
        assert!(table.contains("| `w3` | 300 ns | 200 ns | 1.50 | 1.59 |"), "{table}");
        run.machine.processors = 1;
        assert!(!threads_table(&run).contains("w3"));
    }

    #[test]
    fn large_numbers_are_grouped_to_three_digits() {
        assert_eq!([grouped(1_234.0), grouped(7_654_321.0), grouped(999.6)], ["1,230", "7,650,000", "1,000"]);
    }
}
