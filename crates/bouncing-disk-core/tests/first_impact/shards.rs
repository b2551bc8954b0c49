//! Campaigns that take hours. Two variables select a part: `CAMPAIGN_SIZE` is the number of cases or shards,
//! and `CAMPAIGN_SEED` selects others: 1e9 times this is added to each seed.

use bouncing_disk_core::run::in_parallel;
use serde_json::{Map, Value};

fn variable(name: &str) -> Option<u64> {
    std::env::var(name).ok().map(|text| text.parse().unwrap())
}

pub fn size(usual: u64) -> u64 {
    variable("CAMPAIGN_SIZE").unwrap_or(usual)
}

pub fn seed(usual: u64) -> u64 {
    usual + 1_000_000_000 * variable("CAMPAIGN_SEED").unwrap_or(0)
}

/// Shards of one kind of case.
pub struct Kind {
    pub name: &'static str,
    pub shards: u64,
    /// The report of the shard with this seed, an object with a list of `failures`.
    pub run: fn(u64) -> Value,
}

/// Runs the shards of each kind on all processors, and prints the sums of their numbers.
///
/// # Panics
/// If any shard has failures.
#[allow(clippy::print_stdout, reason = "asked for, to update the documented numbers")]
pub fn run(kinds: &[Kind]) {
    for (number, kind) in (1..).zip(kinds) {
        let shards = size(kind.shards);
        let shard = |shard| (kind.run)(seed(1_000_000 * number + shard as u64));
        let mut sums = Map::new();
        for told in in_parallel(usize::try_from(shards).unwrap(), shard) {
            assert_eq!(told["failures"], Value::Array(Vec::new()), "{}", kind.name);
            for (field, number) in told.as_object().unwrap() {
                let Some(number) = number.as_u64() else { continue };
                let sum = sums.entry(field).or_insert_with(|| Value::from(0));
                *sum = Value::from(sum.as_u64().unwrap() + number);
            }
        }
        println!("{}: {}", kind.name, Value::Object(sums));
    }
}
