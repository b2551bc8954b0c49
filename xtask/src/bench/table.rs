//! The table of a run, beside that of a baseline.

use super::record::{Change, Measured, Record};

/// The heads of the columns.
const HEADS: [&str; 8] = ["bench", "time", "middle", "per", "reference", "ratio", "baseline", "change"];

/// The cells of a row.
pub(super) type Row = [String; HEADS.len()];

/// What one element of a bench is.
pub(super) fn element(name: &str) -> &'static str {
    let (group, rest) = name.split_once('/').unwrap_or((name, ""));
    match group {
        "w1" | "impact" => "impact",
        "w2" => "motor second",
        "w3" => "cell",
        "growth" if rest.starts_with("cells") => "cell",
        "growth" => "impact",
        "limit" => "pair",
        "figures" => "figure",
        _ => "call",
    }
}

/// A time with three to four digits and its unit.
pub(super) fn time(ns: f64) -> String {
    let (value, unit) = match ns {
        ns if ns < 1.0e3 => (ns, "ns"),
        ns if ns < 1.0e6 => (ns / 1.0e3, "µs"),
        ns if ns < 1.0e9 => (ns / 1.0e6, "ms"),
        ns => (ns / 1.0e9, "s"),
    };
    format!("{} {unit}", digits(value))
}

/// A positive number to three or four digits.
pub(super) fn digits(value: f64) -> String {
    match value {
        value if value < 1.0 => format!("{value:.3}"),
        value if value < 10.0 => format!("{value:.2}"),
        value if value < 100.0 => format!("{value:.1}"),
        value => format!("{value:.0}"),
    }
}

/// A whole number with commas.
pub(super) fn with_commas(number: usize) -> String {
    let text = number.to_string();
    let mut grouped = String::new();
    for (index, digit) in text.chars().enumerate() {
        if index > 0 && (text.len() - index).is_multiple_of(3) {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped
}

/// A change with its sign, or that it is within what the uncertainties explain.
fn change(change: Change) -> String {
    let Change { relative, uncertainty } = change;
    let number = format!("{:+.1} % ± {:.1}", 100.0 * relative, 100.0 * uncertainty);
    if relative.abs() <= uncertainty { format!("{number} (noise)") } else { number }
}

/// The rows of the table, one for each bench of the run or the baseline.
pub(super) fn rows(run: &Record, baseline: Option<&Record>) -> Vec<Row> {
    let none = || "-".to_owned();
    let known = |name: &String| baseline.and_then(|baseline| baseline.benches.get(name));
    let mut rows: Vec<_> = run
        .benches
        .iter()
        .map(|(name, now)| {
            let before: Option<&Measured> = known(name);
            let same = before.filter(|before| before.reference == now.reference);
            [
                name.clone(),
                time(now.median_ns),
                format!("{} of {}", time(now.middle_ns()), now.medians_ns.len()),
                element(name).to_owned(),
                now.reference.name().to_owned(),
                digits(now.ratio()),
                same.map_or_else(none, |before| digits(before.ratio())),
                before.map_or_else(none, |before| {
                    Change::between(before, now).map_or_else(|| "other reference".to_owned(), change)
                }),
            ]
        })
        .collect();
    let lost = baseline.iter().flat_map(|baseline| &baseline.benches);
    for (name, before) in lost.filter(|(name, _)| !run.benches.contains_key(*name)) {
        let ratio = digits(before.ratio());
        rows.push([
            name.clone(),
            none(),
            none(),
            element(name).to_owned(),
            before.reference.name().to_owned(),
            none(),
            ratio,
            "not measured now".to_owned(),
        ]);
    }
    rows
}

/// The table with aligned columns: names to the left, numbers to the right.
pub(super) fn aligned(rows: &[Row]) -> String {
    let heads = HEADS.map(str::to_owned);
    let all = || std::iter::once(&heads).chain(rows);
    let width = |column: usize| all().map(|row| row[column].chars().count()).max().unwrap_or_default();
    let widths: [usize; HEADS.len()] = std::array::from_fn(width);
    all()
        .map(|row| {
            let cells = row.iter().zip(widths).enumerate().map(|(column, (cell, width))| match column {
                0 | 3 | 4 => format!("{cell:<width$}"),
                _ => format!("{cell:>width$}"),
            });
            format!("{}\n", cells.collect::<Vec<_>>().join("  ").trim_end())
        })
        .collect()
}

/// The table in Markdown.
pub(super) fn markdown(rows: &[Row]) -> String {
    let mut text =
        format!("| {} |\n| --- | ---: | ---: | --- | --- | ---: | ---: | ---: |\n", HEADS.join(" | "));
    for [name, rest @ ..] in rows {
        text.push_str(&format!("| `{name}` | {} |\n", rest.join(" | ")));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::record::Reference;
    use super::super::record::tests::record;
    use super::*;

    #[test]
    fn a_table_shows_both_runs_and_what_is_lost() {
        let mut run = record(&[("w1/scalar", 160.0), ("w3/scalar", 2_500.0)]);
        run.add(record(&[("w1/scalar", 150.0)]).benches);
        let baseline = record(&[("w1/scalar", 100.0), ("w2/one_motor", 200_000.0)]);
        let text = aligned(&rows(&run, Some(&baseline)));
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(
            lines,
            [
                "bench            time        middle  per           reference  ratio  baseline            change",
                "w1/scalar      150 ns   155 ns of 2  impact        chain       15.0      10.0     +50.0 % ± 4.0",
                "w3/scalar     2.50 µs  2.50 µs of 1  cell          chain        250         -                 -",
                "w2/one_motor        -             -  motor second  chain          -     20000  not measured now",
            ]
        );
        let mut other = run.clone();
        other.benches.get_mut("w1/scalar").expect("there").reference = Reference::Lanes;
        let [.., ratio, before, change] = &rows(&run, Some(&other))[0];
        assert_eq!([ratio, before, change], ["15.0", "-", "other reference"]);
        let same = aligned(&rows(&run, Some(&run)));
        assert!(same.contains("+0.0 % ± 4.0 (noise)"), "{same}");
    }
}
