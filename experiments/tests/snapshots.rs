//! Snapshots of every figure and table at draft quality.
//!
//! Every number and statement that the paper prints about a figure must be answered by exactly one of its claims. A
//! snapshot holds caption, parameters, data and claims with their verdicts. Words, labels and integers are
//! compared exactly, floats within [`RELATIVE_TOLERANCE`]. Long arrays are held as statistics, which a reader can
//! judge, and a digest of all their bits, which is compared exactly: the arithmetic is the same on every machine
//! (`docs/numerics-impacts.md`).
//!
//! A new experiment is added to [`snapshots!`]; the tests fail as long as it is not there or has no snapshot.
//! `INSTA_UPDATE=always cargo test -p bouncing-disk-experiments --test snapshots` writes the snapshots again.

use std::collections::BTreeSet;

use bouncing_disk_experiments::claims::answers;
use bouncing_disk_experiments::experiment::{Experiment, Quality, Record, chain};
use bouncing_disk_experiments::{Silent, registry};
use insta::internals::SnapshotContents;
use insta::{Comparator, Settings, Snapshot};
use serde_json::{Map, Value, json};

/// One test per experiment, so that they run in parallel and a failure names the figure.
macro_rules! snapshots {
    ($($id:ident),* $(,)?) => {
        /// The experiments that have a test.
        const TESTED: &[&str] = &[$(stringify!($id)),*];
        $(#[test]
        fn $id() {
            check(stringify!($id));
        })*
    };
}

snapshots![
    fig01, fig02, fig03, fig04, fig05, fig06, fig07, fig08, fig09, fig10, fig11, fig12, fig13, fig14, table1,
    table2, table3,
];

/// Two floats agree if they differ by less than this share of the larger one.
const RELATIVE_TOLERANCE: f64 = 1e-9;
/// Two floats agree if they differ by less than this: round-off of quantities of order one.
const ABSOLUTE_TOLERANCE: f64 = 1e-15;
/// Arrays of more numbers than this are held as statistics.
const LONGEST_LIST: usize = 12;
/// The same of arrays of integers, labels and verdicts.
const LONGEST_LABELS: usize = 40;
/// Lists of more records than this are held by columns.
const MOST_RECORDS: usize = 4;
/// What fits into a line is on one.
const LINE: usize = 130;
/// Texts of more bytes than this are held as a digest.
const LONGEST_TEXT: usize = 4000;

/// The most words of a caption, and characters of a note.
const MOST_WORDS: usize = 90;
const LONGEST_NOTE: usize = 200;

/// All that an experiment makes, except for pictures.
fn product(entry: &Experiment) -> Map<String, Value> {
    let made = || {
        let made = entry.compute(Quality::Draft, &Silent)?;
        // A figure that cannot be drawn is a failure, too.
        made.figure.to_svg()?;
        let Record { caption, parameters, claims, data, .. } = made.record;
        let faults = answers::faults(entry.id, &claims);
        assert!(faults.is_empty(), "claims of {} against data/paper: {}", entry.id, faults.join("; "));
        assert!(caption.split_whitespace().count() <= MOST_WORDS, "the caption of {}", entry.id);
        for claim in &claims {
            let note = claim.evidence().chars().count();
            assert!(note <= LONGEST_NOTE, "{}: a note of {note} characters: {}", entry.id, claim.evidence());
        }
        // The catalogue has the rest of each.
        let reviewed = [
            "key",
            "quantity",
            "verdict",
            "printed",
            "unit",
            "computed",
            "cause",
            "share",
            "single_orbits",
            "note",
        ];
        let claims = claims.iter().map(|claim| {
            let mut claim = json!(claim).as_object().cloned().unwrap_or_default();
            let has_key = claim.contains_key("key");
            claim.retain(|name, value| {
                reviewed.contains(&name.as_str())
                    && !(has_key && name == "quantity")
                    && !["", "true"].contains(&value.as_str().unwrap_or("-"))
            });
            claim
        });
        let computed = claims.filter(|claim| !claim["computed"].is_null());
        let product = json!({"title": entry.title, "caption": caption, "parameters": parameters,
            "claims": computed.collect::<Vec<_>>(), "data": data});
        Ok(product.as_object().cloned().unwrap_or_default())
    };
    made().unwrap_or_else(|error: bouncing_disk_experiments::ExperimentError| {
        panic!("{}: {}", entry.id, chain(&error))
    })
}

fn check(id: &str) {
    let entries = registry::all();
    let entry = registry::select(&entries, &[id.to_owned()]).unwrap_or_else(|error| panic!("{error}"))[0];
    // The snapshot was stored with as many threads as there are processors: other bits with more of them are seen.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(7).build().expect("threads");
    let mut product = pool.install(|| product(entry));
    let data = product["data"].take();
    product.insert("data".to_owned(), summary(&data));
    let text = layout(&Value::Object(product), 0);
    let mut settings = Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_comparator(Box::new(Close));
    settings.bind(|| insta::assert_snapshot!(id, text));
}

/// The 64-bit FNV-1a hash. Floats are written with the digits that give the same double back, so that the
/// text has all their bits.
fn digest(text: &str) -> String {
    bouncing_disk::core::numerics::digest::Digest::of(text.as_bytes()).to_string()
}

/// JSON in which what fits into a line is on one.
fn layout(value: &Value, depth: usize) -> String {
    let flat = value.to_string();
    let parts: Vec<String> = match value {
        _ if depth + flat.len() <= LINE => return flat,
        Value::Object(fields) => {
            fields.iter().map(|(name, field)| format!("{name:?}: {}", layout(field, depth + 1))).collect()
        }
        Value::Array(items) => items.iter().map(|item| layout(item, depth + 1)).collect(),
        _ => return flat,
    };
    let [open, close] = if value.is_object() { ['{', '}'] } else { ['[', ']'] };
    let indent = " ".repeat(depth);
    format!("{open}\n {indent}{}\n{indent}{close}", parts.join(&format!(",\n {indent}")))
}

/// Data made short.
fn summary(value: &Value) -> Value {
    match value {
        Value::Object(fields) => fields.iter().map(|(name, field)| (name.clone(), summary(field))).collect(),
        Value::Array(items) => summary_of_list(items),
        Value::String(text) if text.len() > LONGEST_TEXT => {
            json!({"bytes": text.len(), "digest": digest(text)})
        }
        other => other.clone(),
    }
}

fn summary_of_list(items: &[Value]) -> Value {
    if let Some(leaves) = leaves(items) {
        let longest = if leaves.iter().any(|leaf| leaf.is_f64()) { LONGEST_LIST } else { LONGEST_LABELS };
        if leaves.len() > longest {
            return statistics(items, &leaves);
        }
    }
    let rows: Option<Vec<_>> = items.iter().map(Value::as_object).collect();
    match rows {
        Some(rows) if rows.len() > MOST_RECORDS => columns(&rows),
        _ => items.iter().map(summary).collect(),
    }
}

/// Many records become one list per field; a record without the field counts as null.
fn columns(rows: &[&Map<String, Value>]) -> Value {
    let names: BTreeSet<&String> = rows.iter().flat_map(|row| row.keys()).collect();
    let mut short = Map::from_iter([("records".to_owned(), rows.len().into())]);
    for name in names {
        let column: Vec<_> = rows.iter().map(|row| row.get(name).cloned().unwrap_or_default()).collect();
        short.insert(name.clone(), summary_of_list(&column));
    }
    Value::Object(short)
}

fn statistics(items: &[Value], leaves: &[&Value]) -> Value {
    let mut short = json!({"count": leaves.len(), "digest": digest(&Value::from(items).to_string())});
    let numbers: Vec<f64> = leaves.iter().filter_map(|leaf| leaf.as_f64()).collect();
    if numbers.len() < leaves.len() {
        short["nulls"] = leaves.iter().filter(|leaf| leaf.is_null()).count().into();
    }
    if let (Some(first), Some(last)) = (numbers.first(), numbers.last()) {
        let mut sorted = numbers.clone();
        sorted.sort_by(f64::total_cmp);
        let part = |quarters: usize| sorted[quarters * (sorted.len() - 1) / 4];
        short["first_last"] = json!([first, last]);
        short["quartiles"] = json!([part(0), part(1), part(2), part(3), part(4)]);
        short["mean"] = (numbers.iter().sum::<f64>() / numbers.len() as f64).into();
    }
    short
}

/// All leaves of nested arrays; `None` if there is an object among them. Texts and booleans count as leaves.
fn leaves(items: &[Value]) -> Option<Vec<&Value>> {
    let mut found = Vec::new();
    for item in items {
        match item {
            Value::Array(inner) => found.extend(leaves(inner)?),
            Value::Object(_) => return None,
            leaf => found.push(leaf),
        }
    }
    Some(found)
}

/// Compares snapshots as JSON: floats by tolerance, everything else exactly.
#[derive(Clone)]
struct Close;

impl Comparator for Close {
    fn matches(&self, reference: &Snapshot, test: &Snapshot) -> bool {
        let read = |snapshot: &Snapshot| match snapshot.contents() {
            SnapshotContents::Text(text) => serde_json::from_str::<Value>(&text.to_string()).ok(),
            SnapshotContents::Binary(_) => None,
        };
        match (read(reference), read(test)) {
            (Some(reference), Some(test)) => close(&reference, &test),
            _ => false,
        }
    }

    fn dyn_clone(&self) -> Box<dyn Comparator> {
        Box::new(self.clone())
    }
}

fn close(one: &Value, other: &Value) -> bool {
    match (one, other) {
        (Value::Number(one), Value::Number(other)) if one.is_f64() && other.is_f64() => {
            let (one, other) = (one.as_f64().unwrap_or(f64::NAN), other.as_f64().unwrap_or(f64::NAN));
            (one - other).abs() <= (RELATIVE_TOLERANCE * one.abs().max(other.abs())).max(ABSOLUTE_TOLERANCE)
        }
        (Value::Array(one), Value::Array(other)) => {
            one.len() == other.len() && one.iter().zip(other).all(|(one, other)| close(one, other))
        }
        (Value::Object(one), Value::Object(other)) => {
            one.len() == other.len()
                && one.iter().all(|(name, one)| other.get(name).is_some_and(|other| close(one, other)))
        }
        (one, other) => one == other,
    }
}

#[test]
fn every_experiment_has_a_test_and_every_test_an_experiment() {
    let mut registered: Vec<_> = registry::all().iter().map(|entry| entry.id).collect();
    let mut tested = TESTED.to_vec();
    registered.sort_unstable();
    tested.sort_unstable();
    assert_eq!(registered, tested, "add the experiment to the list in tests/snapshots.rs");
}

#[test]
fn floats_are_compared_by_tolerance_and_all_else_exactly() {
    let reference = json!({"n": 3, "x": 1.0, "small": 1e-8, "list": [0.5, null], "word": "chattering"});
    let with = |name: &str, value: Value| {
        let mut changed = reference.clone();
        changed[name] = value;
        close(&reference, &changed)
    };
    assert!(with("x", json!(1.0 + 1e-10)) && !with("x", json!(1.0 + 1e-8)) && !with("x", json!(1)));
    assert!(with("small", json!(1e-8 * (1.0 + 1e-10))) && !with("small", json!(1.001e-8)));
    assert!(!with("n", json!(4)) && !with("word", json!("periodic")) && !with("list", json!([0.5])));
    assert!(!with("more", json!(1)));
}

#[test]
fn long_arrays_become_statistics_with_a_digest() {
    let numbers: Vec<_> = (0..50).map(|n| 0.1 * f64::from(n)).collect();
    let data = json!({"angle": numbers, "nested": [numbers, numbers], "short": [1.0, 2.0]});
    let short = summary(&data);
    assert_eq!((&short["short"], &short["nested"]["count"]), (&data["short"], &json!(100)));
    assert_eq!(short["angle"]["count"], 50);
    assert_eq!(short["angle"]["first_last"], json!([0.0, 0.1 * 49.0]));
    // The last bit of one number changes the digest.
    let mut other = data.clone();
    other["angle"][7] = json!(f64::from_bits(numbers[7].to_bits() + 1));
    assert_ne!(short["angle"]["digest"], summary(&other)["angle"]["digest"]);
    let records: Vec<_> = numbers.iter().map(|number| json!({"x": number, "mode": "flight"})).collect();
    let short = summary(&json!(records));
    assert_eq!((&short["records"], &short["x"]["count"]), (&json!(50), &json!(50)));
    assert_eq!(short["mode"]["count"], 50);
}
