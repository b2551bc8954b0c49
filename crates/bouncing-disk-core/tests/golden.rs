//! The recorded digests, on this machine.

mod paper;
#[path = "golden/results.rs"]
mod results;

fn assert_none(differences: &[String]) {
    assert!(differences.is_empty(), "not as recorded:\n{}", differences.join("\n"));
}

#[test]
fn launches_of_every_regime() {
    assert_none(&results::launches_of_every_regime());
}

#[test]
fn chaotic_orbit() {
    assert_none(&results::chaotic_orbit());
}

#[test]
fn orbits_with_chatter() {
    assert_none(&results::orbits_with_chatter(paper::PAPER_POLICY));
}

#[test]
fn basin_labels() {
    assert_none(&results::basin_labels());
}

#[test]
fn branches() {
    assert_none(&results::branches());
}

#[test]
fn cascade() {
    assert_none(&results::cascade());
}

#[test]
fn attractors() {
    assert_none(&results::attractors());
}

#[test]
fn verdicts_and_exponents() {
    assert_none(&results::verdicts_and_exponents());
}

#[test]
fn periodic_orbits() {
    assert_none(&results::periodic_orbits());
}

#[test]
fn drops() {
    assert_none(&results::drops());
}
