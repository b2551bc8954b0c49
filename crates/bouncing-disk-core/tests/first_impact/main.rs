//! The first impact: judged launch by launch by a high-precision oracle, and compared with the stored cases.
#![allow(unreachable_pub, reason = "the modules of a test have no public interface")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod attack;
mod campaign;
mod cases;
mod drops;
mod elementary;
mod launches;
mod march;
mod oracle;
#[path = "../paper/mod.rs"]
mod paper;
mod properties;
mod seams;
mod shards;
