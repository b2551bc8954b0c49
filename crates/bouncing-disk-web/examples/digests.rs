//! Prints the digests of results as JSON, and fails where the golden ones of the core differ:
//!
//!     cargo run --release --package bouncing-disk-web --features digests --example digests >
//!     crates/bouncing-disk-python/tests/digests.json
#![allow(clippy::print_stdout, reason = "a program shows its result")]

use bouncing_disk_web::{digests, golden_differences};

fn main() -> Result<(), String> {
    print!("{}", digests()?);
    let differences = golden_differences();
    if differences.is_empty() { Ok(()) } else { Err(differences.join("\n")) }
}
