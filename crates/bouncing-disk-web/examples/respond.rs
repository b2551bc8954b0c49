//! Answers the requests of the page natively: a request on each line of the standard input, and on each line
//! of the standard output whether it was refused, the digest of the answer and its JSON. The tests of the
//! page compare the digests with those of WebAssembly.
//!
//!     echo '{"call": "orbit", "map": {"axial_forcing": 0.45, "restitution": 0.5},
//!            "start": {"impact_phase": 1.2, "normalised_speed": 1.3}}' | tr -d '\n' |
//!     cargo run --release --package bouncing-disk-web --example respond
#![allow(clippy::print_stdout, reason = "a program shows its result")]

use std::io::{BufRead, Error};

use bouncing_disk_web::Explorer;

fn main() -> Result<(), Error> {
    let mut explorer = Explorer::new();
    for line in std::io::stdin().lock().lines() {
        let reply = explorer.respond(&line?);
        let refused = if reply.refused { "refused" } else { "answered" };
        println!("{refused} {} {}", reply.digest, reply.json);
    }
    Ok(())
}
