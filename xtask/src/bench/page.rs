//! `docs/performance.md`: a template with the stored measurements, one column per processor.

use super::record::Record;

const TEMPLATE: &str = include_str!("performance.md");

/// The page.
pub(super) fn page(records: &[Record], dependencies: &str) -> String {
    filled(TEMPLATE, records, dependencies)
}

/// Fills a template: what stands in braces becomes a cell for each record.
fn filled(template: &str, records: &[Record], dependencies: &str) -> String {
    let mut text = template.replace("{dependencies}", dependencies.trim_end());
    while let Some((before, (formula, after))) =
        text.split_once('{').and_then(|(before, rest)| Some((before, rest.split_once('}')?)))
    {
        let cells = records.iter().map(|record| cell(formula, record).unwrap_or_else(|| "-".to_owned()));
        text = format!("{before}{}{after}", cells.collect::<Vec<_>>().join(" | "));
    }
    text
}

/// A fact about the record, the time of a bench, its inverse in 1/s (`1/bench`), or a quotient (`bench : bench`).
fn cell(formula: &str, record: &Record) -> Option<String> {
    let ns = |bench: &str| record.times_ns.get(bench).copied();
    match formula {
        "processor" => Some(record.heading()),
        "rule" => Some("---:".to_owned()),
        "compiler" => Some(record.compiler.clone()),
        "source" => Some(format!("`{}`", record.source)),
        "passes" => Some(record.passes.to_string()),
        "first_build" => record.first_build_s.map(|seconds| format!("{seconds} s")),
        _ => match (formula.strip_prefix("1/"), formula.split_once(" : ")) {
            (Some(bench), _) => Some(digits(1.0e9 / ns(bench)?)),
            (_, Some((over, under))) => Some(format!("{:.2}", ns(over)? / ns(under)?)),
            _ => Some(time(ns(formula)?)),
        },
    }
}

/// A time with its unit.
pub(super) fn time(ns: f64) -> String {
    let units = [(1.0, "ns"), (1.0e3, "µs"), (1.0e6, "ms"), (1.0e9, "s")];
    let (scale, unit) = units.into_iter().rfind(|(scale, _)| ns >= *scale).unwrap_or(units[0]);
    format!("{} {unit}", digits(ns / scale))
}

/// Three significant digits, with commas.
fn digits(value: f64) -> String {
    match value {
        value if value < 9.995 => return format!("{value:.2}"),
        value if value < 99.95 => return format!("{value:.1}"),
        _ => {}
    }
    let mut scale = 1.0;
    while value / scale >= 999.5 {
        scale *= 10.0;
    }
    let whole = ((value / scale).round() * scale).to_string();
    let groups: Vec<_> = whole.as_bytes().rchunks(3).rev().map(String::from_utf8_lossy).collect();
    groups.join(",")
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::{
        ATTACHED, Axis, BasinSettings, ChatterPolicy, Grid, ImpactMap, ImpactState, KnownOrbit, UNDECIDED,
        Unobserved, Vibration,
    };

    use super::super::record::tests::record;
    use super::*;

    #[test]
    fn a_formula_becomes_a_cell_for_each_processor() {
        let records = [record(&[("w1", 124.0), ("w2", 2.0e5)]), record(&[("w1", 9.0)])];
        let template = "| {processor} |\n| {w1} | {1/w2} | {w2 : w1} | {first_build} |\n{dependencies}";
        let expected = "| A Processor (1/2), AVX-512 | A Processor (1/2), AVX-512 |\n\
                        | 124 ns | 9.00 ns | 5,000 | - | 1612.90 | - | 30 s | 30 s |\n| glam |";
        assert_eq!(filled(template, &records, "| glam |\n"), expected);
    }

    #[test]
    fn numbers_have_three_digits_and_commas() {
        assert_eq!([1.0, 0.4, 9.996, 99.96].map(digits), ["1.00", "0.40", "10.0", "100"]);
        assert_eq!([999.6, 1_234.0, 7_654_321.0].map(digits), ["1,000", "1,230", "7,650,000"]);
        assert_eq!([0.5, 999.0, 1.6e4, 1.19e9].map(time), ["0.50 ns", "999 ns", "16.0 µs", "1.19 s"]);
    }

    #[test]
    fn every_bench_of_the_template_is_one_that_was_measured() {
        let records = Record::all(&crate::workspace::in_workspace(super::super::STORE)).expect("readable");
        for formula in TEMPLATE.split('{').skip(1).filter_map(|rest| Some(rest.split_once('}')?.0)) {
            // What the stored processors may lack.
            let formula = formula.replace("Avx512", "Avx2");
            let known = records.iter().any(|record| cell(&formula, record).is_some());
            assert!(known || ["dependencies", "first_build"].contains(&formula.as_str()), "{formula}");
        }
    }

    #[test]
    fn what_the_template_says_of_w3_is_true() {
        let map = ImpactMap::new(Vibration::from_axial_forcing(0.5).expect("legal"), 0.5).expect("legal");
        let start = ImpactState::from_normalised(0.8, 1.3).expect("legal");
        let orbit =
            map.settled_orbit(start, 4_000, 4, 1.0e-8, &Unobserved).expect("no failure").expect("settles");
        let radius = orbit.trapping_radius(&map, 64, &Unobserved).expect("attracts");
        let says = |text: String| assert!(TEMPLATE.contains(&text), "{text}");
        says(format!("within {radius:.4} of"));
        for state in &orbit.states {
            says(format!("τ = {} with v = {}", state.phase().angle(), state.velocity()));
        }
        let axis = |high| Axis::new(0.0, high, 300).expect("legal axis");
        let grid = Grid::new(axis(1.0), axis(2.0)).expect("legal grid");
        let settings = BasinSettings { max_impacts: 500, policy: ChatterPolicy::Complete };
        let known = [KnownOrbit::new(orbit, radius).expect("legal")];
        let basins = map.basins(grid, &known, settings, &Unobserved).expect("no failure");
        let count = |wanted| basins.labels().iter().filter(|label| **label == wanted).count();
        assert_eq!([count(ATTACHED), count(UNDECIDED)], [58_850, 0]);
        says("58,850 are attached, all others caught".to_owned());
    }
}
