//! The first impact on drives and the motion in compliant contacts, judged by high-precision oracles.
#![allow(unreachable_pub, reason = "the modules of a test have no public interface")]
#![allow(dead_code, reason = "the oracle is shared with the tests of the core")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod contacts;
mod drive_oracle;
mod driven;
mod drives;
#[path = "../../../bouncing-disk-core/tests/first_impact/launches.rs"]
mod launches;
#[path = "../../../bouncing-disk-core/tests/first_impact/march.rs"]
mod march;
mod numbers;
#[path = "../../../bouncing-disk-core/tests/first_impact/oracle.rs"]
mod oracle;
mod polynomials;
mod releases;
#[path = "../../../bouncing-disk-core/tests/first_impact/shards.rs"]
mod shards;
mod sums;
