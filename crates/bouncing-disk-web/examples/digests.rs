//! Prints the digests of results as JSON, and fails where the golden ones of the core differ:
//!
//!     cargo run --release --package bouncing-disk-web --features digests --example digests >
//!     crates/bouncing-disk-python/tests/digests.json
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program shows its result")]

use std::process::ExitCode;

use bouncing_disk_web::{digests, golden_differences};

fn main() -> ExitCode {
    let differences = golden_differences();
    for line in &differences {
        eprintln!("{line}");
    }
    match digests() {
        Ok(digests) => print!("{digests}"),
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    }
    if differences.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
