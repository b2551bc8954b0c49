//! The first impact: judged launch by launch by a high-precision oracle, and compared with the stored cases.
#![allow(unreachable_pub, reason = "the modules of a test have no public interface")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod attack;
mod campaign;
mod cases;
mod contacts;
mod drive_oracle;
mod driven;
mod drives;
mod drops;
mod elementary;
mod launches;
mod march;
mod numbers;
mod oracle;
#[path = "../paper/mod.rs"]
mod paper;
mod polynomials;
mod properties;
mod releases;
mod seams;
mod shards;
mod sums;
