//! `docs/errata.md`: prose by hand, every number in it from the data of a figure.
//!
//! The template beside this file holds references like `{fig06:/merging/survived:.7}`: figure, JSON pointer into its data, format. Of a long list
//! `axial_forcing~0.56` in a pointer takes the entry whose `axial_forcing` is nearest to 0.56: a place in a list means nothing, and shifts. The page is made
//! with them in paper quality, together with `docs/results.md`. `{claims:/section4.merging:.4}` is the computed number of the claim that answers an entry of the catalogue, or
//! the share of the inputs that print alike for which it holds. What the template writes out itself are numbers that the paper prints, which must stand in
//! the [catalogue](crate::catalogue): a test reads all of them.

use serde_json::Value;

use crate::claim::{Claim, Computed, Source};
use crate::page::significant;

/// The page, in the folder of the documentation.
pub const ERRATA_FILE: &str = "errata.md";

/// Stands for a figure's identifier in references to claims.
pub const CLAIMS: &str = "claims";

/// The template.
pub const TEMPLATE: &str = include_str!("errata.md");

/// Why a reference cannot be filled in.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ErrataError {
    /// The reference has no figure, pointer and format.
    #[error(
        "\"{{{reference}}}\" is no reference: figure, pointer and format, as in {{fig06:/merging/survived:.7}}"
    )]
    Malformed {
        /// What stands in braces.
        reference: String,
    },
    /// The figure has no such number.
    #[error("the data of {id} have no number at {pointer}")]
    Missing {
        /// The figure.
        id: String,
        /// The pointer.
        pointer: String,
    },
}

/// A reference to a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Reference<'a> {
    id: &'a str,
    pointer: &'a str,
    format: &'a str,
}

impl<'a> Reference<'a> {
    fn read(text: &'a str) -> Result<Self, ErrataError> {
        let malformed = || ErrataError::Malformed { reference: text.to_owned() };
        let mut parts = text.splitn(3, ':');
        let (Some(id), Some(pointer), Some(format)) = (parts.next(), parts.next(), parts.next()) else {
            return Err(malformed());
        };
        let legal = Format::read(format).is_some() && pointer.starts_with('/');
        if legal { Ok(Self { id, pointer, format }) } else { Err(malformed()) }
    }
}

/// How a number is written: `.3` with so many decimals, `e1` in powers of ten with so many decimals, `s4` with so many significant digits. Before it `%` for
/// a share in per cent, `π` for a multiple of π, `m`, `µ` for thousandths and millionths, `k` for thousands.
struct Format {
    factor: f64,
    style: Style,
    digits: usize,
}

enum Style {
    Decimals,
    Powers,
    Significant,
}

impl Format {
    fn read(text: &str) -> Option<Self> {
        let (factor, rest) = match text.chars().next()? {
            '%' => (1e2, &text[1..]),
            'π' => (std::f64::consts::FRAC_1_PI, &text['π'.len_utf8()..]),
            'm' => (1e3, &text[1..]),
            'µ' => (1e6, &text['µ'.len_utf8()..]),
            'k' => (1e-3, &text[1..]),
            _ => (1.0, text),
        };
        let style = match rest.chars().next()? {
            '.' => Style::Decimals,
            'e' => Style::Powers,
            's' => Style::Significant,
            _ => return None,
        };
        Some(Self { factor, style, digits: rest[1..].parse().ok()? })
    }

    fn write(&self, number: f64) -> String {
        let (number, digits) = (number * self.factor, self.digits);
        let text = match self.style {
            Style::Decimals => format!("{number:.digits$}"),
            Style::Powers => format!("{number:.digits$e}"),
            Style::Significant => return significant(number, digits),
        };
        text.replace('-', "−")
    }
}

/// The pieces of a template: text and what stands in braces, in turn, beginning with text.
fn pieces(template: &str) -> impl Iterator<Item = &str> {
    template.split(['{', '}'])
}

/// The template with all references filled in from the data of the figures, which `data` gives by their identifiers.
///
/// # Errors
///
/// [`ErrataError`] for the first reference that cannot be filled in.
pub fn filled(template: &str, data: impl Fn(&str) -> Option<Value>) -> Result<String, ErrataError> {
    let mut text = String::new();
    for (index, piece) in pieces(template).enumerate() {
        if index % 2 == 0 {
            text.push_str(piece);
            continue;
        }
        let Reference { id, pointer, format } = Reference::read(piece)?;
        let missing = || ErrataError::Missing { id: id.to_owned(), pointer: pointer.to_owned() };
        let data = data(id).ok_or_else(missing)?;
        let number = value_at(&data, pointer).and_then(Value::as_f64).ok_or_else(missing)?;
        let format = Format::read(format).ok_or_else(missing)?;
        text.push_str(&format.write(number));
    }
    Ok(text)
}

/// What a pointer points at; see the [module](self).
fn value_at<'a>(data: &'a Value, pointer: &str) -> Option<&'a Value> {
    pointer.split('/').skip(1).try_fold(data, |value, part| match part.split_once('~') {
        Some((field, wanted)) => {
            let wanted: f64 = wanted.parse().ok()?;
            let off = |entry: &Value| Some((entry.get(field)?.as_f64()? - wanted).abs());
            let entries = value.as_array()?.iter().filter_map(|entry| Some((off(entry)?, entry)));
            entries.min_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, entry)| entry)
        }
        None => match value {
            Value::Array(entries) => entries.get(part.parse::<usize>().ok()?),
            _ => value.get(part),
        },
    })
}

/// The numbers of the claims that answer entries of the catalogue, by key: shares where a statement is judged by them.
pub fn claim_numbers<'a>(claims: impl IntoIterator<Item = &'a Claim>) -> Value {
    let numbers = claims.into_iter().filter_map(|claim| {
        let Source::Entry(key) = claim.source() else { return None };
        let number = match claim.computed() {
            Computed::Number(number) => Some(*number),
            _ => claim.share(),
        };
        Some((key.clone(), Value::from(number?)))
    });
    Value::Object(numbers.collect())
}

/// The figures that a template refers to.
pub fn figures(template: &str) -> Vec<&str> {
    let references = pieces(template).skip(1).step_by(2);
    let mut figures: Vec<&str> = references.filter_map(|piece| piece.split(':').next()).collect();
    figures.sort_unstable();
    figures.dedup();
    figures
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use serde_json::json;

    use super::*;
    use crate::{catalogue, registry};

    #[test]
    fn references_are_filled_in_and_faults_named() {
        let data = |id: &str| {
            (id == "fig06")
                .then(|| json!({"merging": {"survived": 0.560_750_7, "width": -1.2e-7}, "list": [0.25, 3], "slices": [{"x": 1.0, "y": 5}, {"x": 2.0, "y": 6}]}))
        };
        let fill = |template: &str| filled(template, data);
        assert_eq!(fill("At {fig06:/merging/survived:.4}!").as_deref(), Ok("At 0.5608!"));
        assert_eq!(fill("{fig06:/merging/width:e1}").as_deref(), Ok("−1.2e−7"));
        assert_eq!(fill("{fig06:/list/0:%.1} %, {fig06:/list/1:.0}").as_deref(), Ok("25.0 %, 3"));
        assert_eq!(fill("{fig06:/slices/x~1.9/y:.0}, {fig06:/slices/x~-3/y:.0}").as_deref(), Ok("6, 5"));
        assert_eq!(fill("{fig06:/list/0:π.4}π").as_deref(), Ok("0.0796π"));
        assert_eq!(fill("{fig06:/list/1:s6}, {fig06:/list/1:k.3}").as_deref(), Ok("3, 0.003"));
        for (template, part) in [
            ("{fig06:/list/2:.0}", "no number at /list/2"),
            ("{fig06:/slices/z~1/y:.0}", "no number at /slices/z~1/y"),
            ("{fig06:/slices/x~one/y:.0}", "no number"),
            ("{fig07:/list/0:.0}", "data of fig07"),
            ("{fig06:/list/0}", "is no reference"),
            ("{fig06:/list/0:x}", "is no reference"),
            ("{fig06:list:.1}", "is no reference"),
        ] {
            let error = fill(template).expect_err("faulty").to_string();
            assert!(error.contains(part), "{error}");
        }
        assert_eq!(figures("{b:/x:.0} {a:/y:.0} {b:/z:.0}"), ["a", "b"]);
    }

    #[test]
    fn claims_are_referred_to_by_their_keys() {
        use crate::claim::Cases;
        let claims = [
            Claim::printed("section4.merging", 0.560_750_7),
            Claim::printed_statement("section5.linear_rise", Cases { holding: 1, tried: 4 }, ""),
            Claim::printed_statement("section4.coexistence", true, ""),
        ];
        let numbers = claim_numbers(&claims);
        let fill = |template| filled(template, |id| (id == CLAIMS).then(|| numbers.clone()));
        let text = fill("{claims:/section4.merging:.4}, {claims:/section5.linear_rise:%.0} %");
        assert_eq!(text.as_deref(), Ok("0.5608, 25 %"));
        assert!(fill("{claims:/section4.coexistence:.0}").is_err());
    }

    #[test]
    fn every_reference_of_the_template_is_well_formed() {
        let known: Vec<_> = registry::all().iter().map(|entry| entry.id()).collect();
        for piece in pieces(TEMPLATE).skip(1).step_by(2) {
            let reference = Reference::read(piece).expect("well formed");
            // The length of a cycle that rounding chooses is no number: only that of a `robust_cycle` is one.
            assert!(!reference.pointer.contains("/cycle/"), "{piece}");
            if reference.id == CLAIMS {
                catalogue::find(&reference.pointer[1..]).expect("an entry");
            } else {
                assert!(known.contains(&reference.id), "{piece}");
            }
        }
        assert_eq!(pieces(TEMPLATE).count() % 2, 1, "a brace is not closed");
    }

    /// The numbers in a text, with a sign only where it is an exponent's.
    fn numbers(text: &str) -> Vec<String> {
        let mut found = Vec::new();
        let mut current = String::new();
        for c in text.chars().chain([' ']) {
            if c.is_ascii_digit() || (c == '.' && !current.is_empty()) {
                current.push(c);
            } else if !current.is_empty() {
                found.push(std::mem::take(&mut current).trim_end_matches('.').to_owned());
            }
        }
        found
    }

    /// What is written out beside the references is printed in the paper, or names a place in it.
    #[test]
    fn every_other_number_of_the_template_is_printed_in_the_paper() {
        let entries = catalogue::entries().expect("reads");
        let printed = entries.iter().flat_map(|entry| {
            let texts = [entry.printed.as_deref().unwrap_or_default(), &entry.quantity, &entry.place];
            texts.into_iter().flat_map(numbers).collect::<Vec<_>>()
        });
        let mut printed: BTreeSet<String> = printed.collect();
        printed.extend(WRITTEN_OUT.iter().map(|number| (*number).to_owned()));
        let text: String = pieces(TEMPLATE).step_by(2).collect::<Vec<_>>().join(" ");
        // Names in code, and the figures, tables, sections, equations and indices that are referred to.
        let plain: String = text.split('`').step_by(2).collect::<Vec<_>>().join(" ");
        let mut unknown: Vec<String> = Vec::new();
        for line in plain.lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            for (index, word) in words.iter().enumerate() {
                let before = index.checked_sub(1).map_or("", |before| words[before]);
                let refers = ["Fig.", "Figs.", "Table", "Tables", "Eq.", "Eqs.", "Sec.", "Secs.", "panel"];
                if refers.iter().any(|name| before.trim_start_matches(['(', '[']) == *name)
                    || word.contains('_')
                {
                    continue;
                }
                unknown.extend(numbers(word).into_iter().filter(|number| !printed.contains(number)));
            }
        }
        assert!(
            unknown.is_empty(),
            "neither printed in the paper nor from the data of a figure: {unknown:?}"
        );
    }

    /// Numbers that are neither results nor the paper's: of definitions and years.
    const WRITTEN_OUT: [&str; 3] = ["2", "3", "2009"];
}
