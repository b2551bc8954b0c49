//! The known field that a misspelt one was probably meant to be.

use crate::motor::data_sheet::fields::FIELDS;

/// Longest key that is compared letter by letter: a longer one is like none.
const LONGEST_KEY: usize = 64;

/// Shortest part of a name that may stand for it: "load" for "load_torque".
const SHORTEST_PART: usize = 4;

/// Most characters of a text of others that an error repeats.
const LONGEST_EXCERPT: usize = 60;

/// The beginning of a text of others.
pub(super) fn excerpt(text: &str) -> String {
    if text.chars().nth(LONGEST_EXCERPT).is_none() {
        return text.to_owned();
    }
    text.chars().take(LONGEST_EXCERPT).chain("...".chars()).collect()
}

/// The known key that is most like this one: that of the symbol or the other name that it is; that with the
/// fewest changes of a letter, if they are less than half of its letters; that which it is a part of, or
/// which is a part of it.
pub(super) fn nearest(key: &str) -> Option<&'static str> {
    if key.is_empty() || key.len() > LONGEST_KEY {
        return None;
    }
    if let Some(field) = FIELDS.iter().find(|field| field.also.contains(&key)) {
        return Some(field.name);
    }
    let key: String = key
        .trim()
        .chars()
        .map(|letter| if letter == '-' || letter == ' ' { '_' } else { letter.to_ascii_lowercase() })
        .collect();
    let near = FIELDS.iter().map(|field| (distance(&key, field.name), field.name)).min()?;
    if 3 * near.0 <= key.chars().count() {
        return Some(near.1);
    }
    let part = FIELDS
        .iter()
        .find(|field| key.contains(field.name) || key.len() >= SHORTEST_PART && field.name.contains(&key));
    part.map(|field| field.name).or_else(|| (2 * near.0 < key.chars().count()).then_some(near.1))
}

/// The fewest letters to insert, to remove or to replace, two neighbours that are exchanged counting once
/// (the optimal string alignment distance).
fn distance(one: &str, other: &str) -> usize {
    let (one, other): (Vec<char>, Vec<char>) = (one.chars().collect(), other.chars().collect());
    let mut before_last: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=other.len()).collect();
    for (i, letter) in one.iter().enumerate() {
        let mut row = vec![i + 1];
        for (j, wanted) in other.iter().enumerate() {
            let replaced = last[j] + usize::from(letter != wanted);
            let mut least = replaced.min(last[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && *letter == other[j - 1] && one[i - 1] == *wanted {
                least = least.min(before_last[j - 1] + 1);
            }
            row.push(least);
        }
        before_last = std::mem::replace(&mut last, row);
    }
    last[other.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_of_hand() {
        for (one, other, expected) in [
            ("", "", 0),
            ("", "abc", 3),
            ("abc", "", 3),
            ("load_torqe", "load_torque", 1),
            ("laod", "load", 1),
            ("kitten", "sitting", 3),
            ("ca", "abc", 3),
            ("mü", "mu", 1),
        ] {
            assert_eq!(distance(one, other), expected, "{one} {other}");
            assert_eq!(distance(other, one), expected, "{other} {one}");
        }
    }

    #[test]
    fn every_name_is_nearest_to_itself_with_one_letter_changed() {
        for field in &FIELDS {
            for place in 0..field.name.len() {
                let mut less = field.name.to_owned();
                less.remove(place);
                assert_eq!(nearest(&less), Some(field.name), "{less}");
            }
        }
    }

    #[test]
    fn symbols_parts_and_other_spellings_are_understood() {
        for (key, expected) in [
            ("load_torqe", Some("load_torque")),
            ("load", Some("load_torque")),
            ("a_e", Some("contact_radius")),
            ("mu", Some("friction")),
            ("A", Some("amplitude")),
            ("g", Some("preload_acceleration")),
            ("Drive-Frequency", Some("drive_frequency")),
            ("frequency", Some("drive_frequency")),
            ("friction_coefficient", Some("friction")),
            ("colour", None),
            ("x", None),
            ("", None),
            ("€€€", None),
        ] {
            assert_eq!(nearest(key), expected, "{key}");
        }
        assert_eq!(nearest(&"load_torque".repeat(10)), None);
    }
}
