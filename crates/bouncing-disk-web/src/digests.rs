//! Digests that name the bits of results: the same on every machine.
//!
//! `digests.json` of the Python package holds those of x86-64; here they are computed wherever this crate is compiled for
//! (`examples/digests.rs`, and `digests` in WebAssembly), beside the golden ones of the core.

#[path = "../../bouncing-disk-core/tests/golden/results.rs"]
mod golden;
mod results;

use bouncing_disk::{Error, PAPER_CHATTER};

/// The digests of what users compute most, as JSON, by their names.
///
/// # Errors
/// None of the results fails; the library's errors are passed on.
pub fn digests() -> Result<String, Error> {
    let lines: Vec<_> =
        results::all()?.iter().map(|(name, digest)| format!("  \"{name}\": \"{digest}\"")).collect();
    Ok(format!("{{\n{}\n}}\n", lines.join(",\n")))
}

/// What differs from the golden digests of the core, a line each: nothing, wherever IEEE 754 is kept.
#[must_use]
pub fn golden_differences() -> Vec<String> {
    [
        golden::launches_of_every_regime(),
        golden::chaotic_orbit(),
        golden::orbits_with_chatter(PAPER_CHATTER),
        golden::basin_labels(),
    ]
    .concat()
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_digests_are_those_that_python_compares_with() {
        let stored = include_str!("../../bouncing-disk-python/tests/digests.json");
        assert_eq!(super::digests().expect("no failure"), stored);
    }
}
