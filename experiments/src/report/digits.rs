//! How many digits the pages show.
//!
//! A number on `docs/results.md` and `docs/errata.md` has four significant digits. More are kept where they
//! decide a verdict, and only those that `recomputed.json` lists: each of them another program, from the
//! equations alone, has to find, or it is an input.

use std::sync::OnceLock;

use serde::Deserialize;

/// Significant digits of every other number.
const DIGITS: usize = 4;

/// A number that keeps more digits.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(not(test), expect(dead_code, reason = "only tests ask for names and meanings"))]
struct Kept {
    id: String,
    /// Its meaning, with its unit.
    meaning: String,
    /// As the pages show it.
    value: String,
}

/// The numbers that keep more than four digits.
fn kept() -> &'static [Kept] {
    static KEPT: OnceLock<Vec<Kept>> = OnceLock::new();
    KEPT.get_or_init(|| serde_json::from_str(include_str!("../../recomputed.json")).unwrap_or_default())
}

/// The text with every longer number rounded, except in backquotes, links and names.
pub(super) fn rounded(text: &str) -> String {
    let mut page = String::with_capacity(text.len());
    for (index, piece) in text.split('`').enumerate() {
        if index > 0 {
            page.push('`');
        }
        if index % 2 == 1 { page.push_str(piece) } else { push_rounded(&mut page, piece) }
    }
    page
}

fn push_rounded(page: &mut String, text: &str) {
    let mut rest = text;
    while let Some(start) = rest.find(|letter: char| letter.is_ascii_digit()) {
        let (before, from) = rest.split_at(start);
        page.push_str(before);
        let end = from.find(|letter: char| !letter.is_ascii_digit() && letter != '.').unwrap_or(from.len());
        let (number, behind) = from.split_at(end);
        // A full stop ends a sentence.
        let (number, stop) = number.strip_suffix('.').map_or((number, ""), |number| (number, "."));
        let named =
            page.ends_with(|last: char| last.is_ascii_alphanumeric() || matches!(last, '_' | '/' | '.'));
        match shorter(number).filter(|_| !named) {
            Some(short) => page.push_str(&short),
            None => page.push_str(number),
        }
        page.push_str(stop);
        rest = behind;
    }
    page.push_str(rest);
}

/// Four digits of a number that has more and is not [`kept`]. The number of an article may begin with a zero.
fn shorter(number: &str) -> Option<String> {
    if number.starts_with('0') && !number.contains('.') {
        return None;
    }
    let significant = number.trim_start_matches(['0', '.']);
    let significant = if number.contains('.') { significant } else { significant.trim_end_matches('0') };
    let digits = significant.bytes().filter(u8::is_ascii_digit).count();
    if digits <= DIGITS || kept().iter().any(|kept| kept.value == number) {
        return None;
    }
    let value: f64 = number.parse().ok()?;
    let exponent: i32 = format!("{value:.*e}", DIGITS - 1).split_once('e')?.1.parse().ok()?;
    let last = exponent + 1 - DIGITS as i32;
    Some(match usize::try_from(last) {
        Ok(zeros) => {
            let unit = (0..zeros).fold(1.0, |unit, _| 10.0 * unit);
            format!("{:.0}", unit * (value / unit).round())
        }
        Err(_) => format!("{value:.*}", last.unsigned_abs() as usize),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_digits_are_enough_for_what_is_not_listed() {
        for (text, short) in [
            ("Γ = 0.486003, −0.8168140899333463π.", "Γ = 0.4860, −0.8168π."),
            ("1350912 events of 3888, 20000 impacts", "1351000 events of 3888, 20000 impacts"),
            ("0.4860030783, [0, 1]", "0.4860030783, [0, 1]"),
            ("1.000000000010e-8 m, 9.9996", "1.000e-8 m, 10.00"),
            (
                "![](figures/fig01234.png) `0.123456` a0.12345",
                "![](figures/fig01234.png) `0.123456` a0.12345",
            ),
            ("12315.04 and 0.00004123456, 046201", "12320 and 0.00004123, 046201"),
        ] {
            assert_eq!(rounded(text), short);
        }
    }

    #[test]
    fn what_keeps_more_digits_is_listed_once_and_stands_on_a_page() {
        const PAGES: [&str; 2] =
            [include_str!("../../../docs/results.md"), include_str!("../../../docs/errata.md")];
        assert!((1..60).contains(&kept().len()));
        for one in kept() {
            assert!(!one.id.is_empty() && !one.meaning.is_empty(), "{one:?}");
            assert_eq!(
                kept().iter().filter(|other| other.id == one.id || other.value == one.value).count(),
                1
            );
            assert!(one.value.bytes().filter(u8::is_ascii_digit).count() > DIGITS, "{one:?}");
            assert!(PAGES.iter().any(|page| page.contains(&one.value)), "{one:?}");
        }
    }
}
