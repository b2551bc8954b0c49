//! The committed results page and pictures.

use std::f64::consts::PI;
use std::fs;
use std::path::PathBuf;

use bouncing_disk::core::numerics::elementary::{acos, asin};
use bouncing_disk_experiments::registry;
use bouncing_disk_experiments::report::pages::{
    DIGESTS_FILE, Digests, LARGEST_PICTURE, LARGEST_VECTOR, PICTURES_FOLDER, digest, template,
};

/// All pictures together may be so large (bytes).
const ALL_PICTURES: usize = 4_000_000;

fn docs(name: &str) -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs")).join(name)
}

#[test]
fn the_committed_files_are_those_that_were_generated_and_small() {
    const COMMAND: &str = "cargo xtask figures --docs";
    let folder = docs(PICTURES_FOLDER);
    let digests = fs::read(folder.join(DIGESTS_FILE)).expect("the digests are committed");
    let digests: Digests = serde_json::from_slice(&digests).expect("written by this version");
    let (template, of_template) = template();
    for (name, expected) in &digests.pages {
        let own = if name == template {
            of_template.clone()
        } else {
            digest(&fs::read(docs(name)).expect("the page is committed"))
        };
        assert_eq!(own, *expected, "{name} was edited; to repair: {COMMAND}");
    }
    let entries = registry::all();
    let mut ids: Vec<_> = entries.iter().map(|entry| entry.id).collect();
    ids.sort_unstable();
    assert!(digests.figures.keys().eq(&ids), "to repair: {COMMAND}");
    let mut together = 0;
    for (id, digests) in &digests.figures {
        let picture = fs::read(folder.join(format!("{id}.png"))).expect("the picture is committed");
        assert_eq!(digest(&picture), digests.picture, "{id}.png was edited");
        assert!(picture.len() <= LARGEST_PICTURE, "{id}.png has {} bytes", picture.len());
        together += picture.len();
        let vector = fs::read(folder.join(format!("{id}.svg"))).expect("the vector file is committed");
        assert_eq!(digest(&vector), digests.vector, "{id}.svg was edited");
        assert!(vector.len() <= LARGEST_VECTOR, "{id}.svg has {} bytes", vector.len());
    }
    assert!(together <= ALL_PICTURES, "the pictures have {together} bytes");
}

#[test]
fn the_citation_is_of_this_version() {
    let citation = fs::read_to_string(docs("../CITATION.cff")).expect("committed");
    let version = format!("\nversion: {}\n", env!("CARGO_PKG_VERSION"));
    assert!(citation.contains(&version) && citation.contains("\n    doi: 10.1103/PhysRevE.80.046201\n"));
}

/// The pages that are filled with numbers of the figures.
const WITH_NUMBERS: [&str; 2] = ["results.md", "errata.md"];

fn page(name: &str) -> String {
    fs::read_to_string(docs(name)).expect("the page is committed")
}

/// The powers of ten in a text that are below 1e-12, each with the words before it.
fn below_rounding(text: &str) -> Vec<String> {
    const SUPERSCRIPTS: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹";
    let plain: String = text
        .replace("10⁻", "1e-")
        .chars()
        .map(|letter| match SUPERSCRIPTS.chars().position(|one| one == letter) {
            Some(digit) => char::from(b'0' + digit as u8),
            None if letter == '−' => '-',
            None => letter,
        })
        .collect();
    let words: Vec<&str> = plain.split_whitespace().collect();
    let exponent = |word: &str| {
        let (before, after) = word.split_once("e-")?;
        let digits = after.find(|letter: char| !letter.is_ascii_digit()).unwrap_or(after.len());
        before.ends_with(|last: char| last.is_ascii_digit()).then(|| after[..digits].parse::<u32>().ok())?
    };
    let small = |index: &usize| exponent(words[*index]).is_some_and(|exponent| exponent > 12);
    (0..words.len()).filter(small).map(|index| words[index.saturating_sub(2)..=index].join(" ")).collect()
}

/// What is 0 but for rounding is said to be 0, or to be at most so much.
#[test]
fn no_page_prints_the_noise_of_rounding_as_a_number() {
    assert_eq!(below_rounding("at θ = 2.3e−15π and 2 × 10⁻¹³ m, 1e-12"), ["θ = 2.3e-15π", "2 × 1e-13"]);
    for name in WITH_NUMBERS {
        let noise = below_rounding(&page(name)).into_iter().filter(|words| !words.starts_with("at most "));
        assert_eq!(
            noise.collect::<Vec<_>>(),
            [""; 0],
            "{name}: a number below 1e-12 is rounding; write \"at most 1e-12\""
        );
    }
}

/// A number that stands beside a formula of printed numbers is its value.
#[test]
fn numbers_beside_formulas_are_their_values() {
    // Table I: c, a_e, omega and g, and the launch speeds of Eq. (14).
    let (stroke, radius, frequency, gravity) = (0.25, 0.135, 15.0, 9.8);
    let (launch, rotary) = (3.1 / stroke, radius * 14.0 / stroke);
    let share = |squared: f64| gravity / (stroke * squared);
    let [printed, by_eq_14] = [frequency * frequency, launch * launch + rotary * rotary].map(share);
    // Of the restitution 0.5.
    let (fold, step) = (0.5 / 1.5, 2.0 * 1.25 / (PI * 1.5 * 1.5));
    let first_doubling = (fold * fold + step * step).sqrt();
    let lowest = asin(printed) / PI;
    let said = [
        ("errata.md", format!("the nearest to 0 is −{lowest:.4}π, that is −arcsin(g/cω²)")),
        ("errata.md", format!("arcsin(g/cω²) = {:.4} rad", asin(printed))),
        ("errata.md", format!("arccos(g/cω²) = {:.4}π", acos(by_eq_14) / PI)),
        ("errata.md", format!("{:.4} = (π − 1)/(π + 1)", (PI - 1.0) / (PI + 1.0))),
        ("errata.md", format!("sqrt(2gh) = {:.3} m/s", (2.0 * gravity * 0.045).sqrt())),
        ("errata.md", format!("0.95²/(2 × 0.045) = {:.2} m/s²", 0.95 * 0.95 / (2.0 * 0.045))),
        ("errata.md", format!("sqrt(0.9/4.5) = {:.3}", (0.9_f64 / 4.5).sqrt())),
        ("errata.md", format!("Γ_1 to Γ_7 = {first_doubling:.10}")),
        ("results.md", format!("arcsin(g/cω²) = {lowest:.4}π")),
        ("results.md", format!("arccos(g/cω²) = {:.4}π", acos(printed) / PI)),
        ("results.md", format!("(1 − ε)/(1 + ε) = {fold:.4}")),
    ];
    for (name, said) in said {
        let words = page(name).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(&said), "{name}: {said}");
    }
}
