//! Snapshots of every figure and table at draft quality.
//!
//! Every number and statement that the paper prints about a figure must be answered by exactly one of its claims. A
//! snapshot holds caption, parameters, data, table and claims with their verdicts. Words, labels and integers are
//! compared exactly, floats within [`RELATIVE_TOLERANCE`]. Long arrays are held as statistics, which a reader can
//! judge, and a digest of all their bits, which is compared exactly: the arithmetic is the same on every machine
//! (`docs/numerics/solver.md`). Fields named in [`VARYING`] come from a library whose last bits depend on the processor;
//! they are compared by tolerance only.
//!
//! A new experiment is added to [`snapshots!`]; the tests fail as long as it is not there or has no snapshot.
//! `INSTA_UPDATE=always cargo test -p bouncing-disk-experiments --test snapshots` writes the snapshots again.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};

use bouncing_disk_experiments::experiment::{Quality, RegisteredExperiment, chain};
use bouncing_disk_experiments::{Silent, answers, registry};
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
            check(&identifier(stringify!($id)));
        })*
    };
}

snapshots![
    fig01,
    fig02,
    fig03,
    fig04,
    fig05,
    fig06,
    fig07,
    fig08,
    fig09,
    fig10,
    fig11,
    fig12,
    fig13,
    fig14,
    table1,
    table2,
    table3,
    extra_torque_speed,
    extra_efficiency,
    extra_restitution_law,
    extra_traps,
    extra_fit,
    extra_design,
    extra_lyapunov,
    extra_regimes,
    extra_branches,
    extra_cascade,
    extra_crisis,
    extra_manifolds,
    extra_attractors,
];

/// The identifier of the experiment whose test has this name, which cannot have hyphens.
fn identifier(test: &str) -> String {
    test.replace('_', "-")
}

/// Fields, by experiment, that depend on the last bits of a linear-algebra library. A path names the keys from the
/// data downwards; indices of arrays are not part of it. Everything below a path is left out of all digests.
const VARYING: &[(&str, &[&str])] = &[];

/// Two floats agree if they differ by less than this share of the larger one.
const RELATIVE_TOLERANCE: f64 = 1e-9;
/// Two floats agree if they differ by less than this: round-off of quantities of order one.
const ABSOLUTE_TOLERANCE: f64 = 1e-15;
/// Arrays of more numbers than this are held as statistics.
const LONGEST_LIST: usize = 40;
/// Texts of more bytes than this are held as a digest.
const LONGEST_TEXT: usize = 4000;

fn entries() -> Vec<Box<dyn RegisteredExperiment>> {
    registry::all()
}

/// All that an experiment makes, except for pictures.
fn product(entry: &dyn RegisteredExperiment) -> Map<String, Value> {
    let made = || {
        let outcome = entry.compute(Quality::Draft, &Silent)?;
        let table = outcome.table().map(|table| table.to_csv()).transpose()?;
        // A figure that cannot be drawn is a failure, too.
        outcome.draw()?.to_svg()?;
        let mut product = Map::new();
        product.insert("title".to_owned(), entry.title().into());
        product.insert("caption".to_owned(), outcome.caption().into());
        product.insert("parameters".to_owned(), json!(outcome.parameters()));
        let claims = outcome.claims();
        let faults = answers::faults(entry.id(), &claims);
        assert!(faults.is_empty(), "claims of {} against data/paper: {}", entry.id(), faults.join("; "));
        product.insert("claims".to_owned(), json!(claims));
        product.insert("table".to_owned(), json!(table));
        product.insert("data".to_owned(), outcome.to_json()?);
        Ok(product)
    };
    made().unwrap_or_else(|error: bouncing_disk_experiments::ExperimentError| {
        panic!("{}: {}", entry.id(), chain(&error))
    })
}

fn check(id: &str) {
    let entries = entries();
    let entry = registry::find(&entries, id).unwrap_or_else(|error| panic!("{error}"));
    let mut product = product(entry);
    let varying: Vec<_> = VARYING.iter().filter(|(name, _)| *name == id).map(|(_, path)| *path).collect();
    let data = product["data"].take();
    product.insert("data".to_owned(), Summary { varying: &varying }.of(&data, &mut Vec::new()));
    if let Some(Value::String(table)) = product.get("table") {
        // The numbers are in the data already, where they are compared by tolerance.
        let lines: Vec<_> = table.lines().collect();
        let summary = json!({"header": lines.first(), "rows": lines.len().saturating_sub(1)});
        product.insert("table".to_owned(), summary);
    }
    let text = serde_json::to_string_pretty(&product).expect("plain data");
    let mut settings = Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_comparator(Box::new(Close));
    settings.bind(|| insta::assert_snapshot!(id, text));
}

/// The 64-bit FNV-1a hash. Floats are written with the digits that give the same double back, so that the text has
/// all their bits.
fn digest(text: &str) -> String {
    bouncing_disk::core::numerics::digest::Digest::of(text.as_bytes()).to_string()
}

/// Makes data short.
struct Summary<'a> {
    varying: &'a [&'a [&'a str]],
}

impl Summary<'_> {
    fn of(&self, value: &Value, path: &mut Vec<String>) -> Value {
        match value {
            Value::Object(fields) => {
                let mut short = Map::new();
                for (name, field) in fields {
                    path.push(name.clone());
                    short.insert(name.clone(), self.of(field, path));
                    path.pop();
                }
                Value::Object(short)
            }
            Value::Array(items) => self.of_array(items, path),
            Value::String(text) if text.len() > LONGEST_TEXT => {
                json!({"bytes": text.len(), "digest": digest(text)})
            }
            other => other.clone(),
        }
    }

    fn of_array(&self, items: &[Value], path: &mut Vec<String>) -> Value {
        if let Some(leaves) = leaves(items).filter(|leaves| leaves.len() > LONGEST_LIST) {
            return self.statistics(items, &leaves, path);
        }
        let rows: Option<Vec<_>> = items.iter().map(Value::as_object).collect();
        match rows {
            Some(rows) if rows.len() > LONGEST_LIST => self.columns(&rows, path),
            _ => Value::Array(items.iter().map(|item| self.of(item, path)).collect()),
        }
    }

    /// Many records become one list per field; a record without the field counts as null.
    fn columns(&self, rows: &[&Map<String, Value>], path: &mut Vec<String>) -> Value {
        let mut columns: BTreeMap<&String, Vec<Value>> = BTreeMap::new();
        for name in rows.iter().flat_map(|row| row.keys()) {
            columns.entry(name).or_default();
        }
        for (name, column) in &mut columns {
            column.extend(rows.iter().map(|row| row.get(*name).cloned().unwrap_or_default()));
        }
        let mut short = Map::new();
        short.insert("records".to_owned(), rows.len().into());
        for (name, column) in columns {
            path.push(name.clone());
            short.insert(name.clone(), self.of_array(&column, path));
            path.pop();
        }
        Value::Object(short)
    }

    fn statistics(&self, items: &[Value], leaves: &[&Value], path: &[String]) -> Value {
        let varies = self.varying.iter().any(|start| {
            start.len() <= path.len() && start.iter().zip(path).all(|(one, other)| *one == other.as_str())
        });
        let mut short = Map::new();
        short.insert("count".to_owned(), leaves.len().into());
        if !varies {
            short.insert("digest".to_owned(), digest(&Value::from(items).to_string()).into());
        }
        let numbers: Vec<f64> = leaves.iter().filter_map(|leaf| leaf.as_f64()).collect();
        if numbers.len() < leaves.len() {
            short.insert("nulls".to_owned(), leaves.iter().filter(|leaf| leaf.is_null()).count().into());
        }
        if let (Some(first), Some(last)) = (numbers.first(), numbers.last()) {
            let mut sorted = numbers.clone();
            sorted.sort_by(f64::total_cmp);
            let part = |quarters: usize| sorted[quarters * (sorted.len() - 1) / 4];
            let mean = numbers.iter().sum::<f64>() / numbers.len() as f64;
            short.insert("first_last".to_owned(), json!([first, last]));
            short.insert("quartiles".to_owned(), json!([part(0), part(1), part(2), part(3), part(4)]));
            short.insert("mean".to_owned(), mean.into());
        }
        Value::Object(short)
    }
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
    let mut registered: Vec<_> = entries().iter().map(|entry| entry.id().to_owned()).collect();
    let mut tested: Vec<_> = TESTED.iter().map(|test| identifier(test)).collect();
    registered.sort_unstable();
    tested.sort_unstable();
    assert_eq!(registered, tested, "add the experiment to the list in tests/snapshots.rs");
}

#[test]
fn identifiers_are_legal_unique_and_in_order() {
    let ids: Vec<_> = registry::paper().iter().map(|entry| entry.id()).collect();
    let legal: Vec<String> =
        (1..=14).map(|n| format!("fig{n:02}")).chain((1..=3).map(|n| format!("table{n}"))).collect();
    for id in &ids {
        assert!(legal.iter().any(|legal| legal == id), "{id} is no figure or table of the paper");
    }
    assert!(ids.windows(2).all(|pair| pair[0] < pair[1]), "not in order, or not unique: {ids:?}");
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let entries = entries();
    let next = AtomicUsize::new(0);
    // Each thread takes the next entry: one that computes with a single thread leaves the others of the machine free.
    let compare = || {
        while let Some(entry) = entries.get(next.fetch_add(1, Ordering::Relaxed)) {
            let [alone, together] = [1, 7].map(|threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
                pool.install(|| digest(&Value::Object(product(&**entry)).to_string()))
            });
            assert_eq!(alone, together, "{}", entry.id());
        }
    };
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..2).map(|_| scope.spawn(compare)).collect();
        for thread in threads {
            thread.join().expect("no entry differs");
        }
    });
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
fn long_arrays_become_statistics_with_a_digest_unless_their_bits_vary() {
    let numbers: Vec<_> = (0..50).map(|n| 0.1 * f64::from(n)).collect();
    let data = json!({"angle": numbers, "nested": {"faer": [numbers, numbers]}, "short": [1.0, 2.0]});
    let varying: &[&str] = &["nested", "faer"];
    let short = Summary { varying: &[varying] }.of(&data, &mut Vec::new());
    assert_eq!(short["short"], data["short"]);
    assert_eq!(short["angle"]["count"], 50);
    assert_eq!(short["angle"]["first_last"], json!([0.0, 0.1 * 49.0]));
    assert!(short["angle"]["digest"].is_string());
    assert_eq!(short["nested"]["faer"]["count"], 100);
    assert!(short["nested"]["faer"].get("digest").is_none());
    // The last bit of one number changes the digest.
    let mut other = data.clone();
    other["angle"][7] = json!(f64::from_bits(numbers[7].to_bits() + 1));
    let other = Summary { varying: &[] }.of(&other, &mut Vec::new());
    assert_ne!(short["angle"]["digest"], other["angle"]["digest"]);
    let records: Vec<_> = numbers.iter().map(|number| json!({"x": number, "mode": "flight"})).collect();
    let short = Summary { varying: &[] }.of(&json!(records), &mut Vec::new());
    assert_eq!((&short["records"], &short["x"]["count"]), (&json!(50), &json!(50)));
    assert_eq!(short["mode"]["count"], 50);
}
