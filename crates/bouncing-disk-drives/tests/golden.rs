//! The recorded digests, on this machine.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "golden/on_drives.rs"]
mod on_drives;
#[path = "../../bouncing-disk-core/tests/golden/results.rs"]
#[allow(dead_code, reason = "the rest is for the tests of the core")]
mod results;

#[test]
fn orbits_on_drives() {
    assert_eq!(on_drives::orbits_on_drives(), [""; 0]);
}

#[test]
fn orbits_with_compliance() {
    assert_eq!(on_drives::orbits_with_compliance(), [""; 0]);
}

#[test]
fn periodic_orbits() {
    let recorded = [0x4455_9a97_4f62_b38d, 0x24a4_243e_efa0_0d14];
    assert_eq!(on_drives::periodic_orbits_on_drives(3, 40, recorded), [""; 0]);
}

#[test]
fn branches() {
    assert_eq!(on_drives::branches_on_drives(), [""; 0]);
}
