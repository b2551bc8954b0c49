//! Single values on the command line: `--set disk.friction=0.2`.

use std::str::FromStr;

use crate::output::lines::visible;

/// A key and the number that it is given. Whether there is such a key, and whether the number is legal, is
/// seen where it is set.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Setting {
    pub(crate) key: String,
    pub(crate) value: f64,
}

impl FromStr for Setting {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let Some((key, value)) = text.split_once('=') else {
            return Err("a setting is KEY=VALUE, such as disk.friction=0.2".to_owned());
        };
        let number = value.trim().parse();
        let value = number.map_err(|_| format!("{:?} is no number", visible(value.trim())))?;
        Ok(Self { key: key.trim().to_owned(), value })
    }
}

/// That there is no such key, and which one may be meant.
pub(super) fn unknown<'k>(key: &str, known: impl Iterator<Item = &'k str>) -> String {
    let known: Vec<&str> = known.collect();
    let likeness = |name: &str| strsim::jaro_winkler(name, key);
    let best = known.iter().copied().max_by(|one, other| likeness(one).total_cmp(&likeness(other)));
    let shown = visible(&key.chars().take(60).collect::<String>());
    match best.filter(|name| likeness(name) > 0.8) {
        Some(name) => format!("the key \"{shown}\" is unknown; did you mean \"{name}\"?"),
        None => format!("the key \"{shown}\" is unknown; the known ones are {}", known.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_setting_is_a_key_and_a_number() {
        let read = |text: &str| text.parse::<Setting>();
        assert_eq!(read("disk.friction=0.2"), Ok(Setting { key: "disk.friction".to_owned(), value: 0.2 }));
        assert_eq!(read(" a = -1e-9 ").unwrap().value.to_bits(), (-1e-9_f64).to_bits());
        for text in ["", "friction", "friction=", "friction=x", "friction=0,2"] {
            assert!(read(text).is_err(), "{text}");
        }
    }

    #[test]
    fn the_nearest_key_is_named() {
        let known = || ["friction", "restitution"].into_iter();
        assert!(unknown("fricton", known()).ends_with("did you mean \"friction\"?"));
        assert!(unknown("colour", known()).ends_with("the known ones are friction, restitution"));
        assert!(unknown(&"x".repeat(1_000), known()).len() < 200);
    }
}
