//! A campaign of many cases in shards: each is written to a file of its own when it is done, so that a
//! campaign can be broken off and taken up again.

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use serde_json::Value;

/// Shards of one kind of case.
pub struct Kind {
    /// The files are `name-0.json` and so on.
    pub name: &'static str,
    pub shards: u64,
    /// What the shard with this seed says of itself, an object with a list of `failures`.
    pub run: fn(u64) -> Value,
}

/// Runs the shards that have no file yet in the folder that the variable `CAMPAIGN` names, on all processors.
///
/// # Panics
/// If any shard in the folder has failures.
pub fn run(kinds: &[Kind]) {
    let folder = PathBuf::from(std::env::var_os("CAMPAIGN").expect("CAMPAIGN names a folder"));
    std::fs::create_dir_all(&folder).unwrap();
    let place = |kind: &Kind, shard: u64| folder.join(format!("{}-{shard}.json", kind.name));
    let shards: Vec<_> = (1..)
        .zip(kinds)
        .flat_map(|(number, kind)| {
            (0..kind.shards).map(move |shard| (kind, shard, 1_000_000 * number + shard))
        })
        .filter(|&(kind, shard, _)| !place(kind, shard).exists())
        .collect();
    let next = AtomicUsize::new(0);
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some(&(kind, shard, seed)) = shards.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let file = place(kind, shard);
                    std::fs::write(file.with_extension("partial"), (kind.run)(seed).to_string()).unwrap();
                    std::fs::rename(file.with_extension("partial"), file).unwrap();
                }
            });
        }
    });
    let mut sums = serde_json::Map::new();
    for kind in kinds {
        for shard in 0..kind.shards {
            let told: Value = serde_json::from_slice(&std::fs::read(place(kind, shard)).unwrap()).unwrap();
            assert_eq!(told["failures"], Value::Array(Vec::new()), "{} {shard}", kind.name);
            for (field, number) in told.as_object().unwrap() {
                let Some(number) = number.as_u64() else { continue };
                let sum = sums.entry(format!("{} {field}", kind.name)).or_insert_with(|| Value::from(0));
                *sum = Value::from(sum.as_u64().unwrap() + number);
            }
        }
    }
    std::fs::write(folder.join("sums.json"), format!("{:#}", Value::Object(sums))).unwrap();
}
