//! Values on the command line: a number, a range of them, a word.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use serde::{Deserialize, Serialize};

/// Largest number of values of a range: a longer one is a typing error.
const MOST: usize = 1_000_000;

/// Numbers at equal distances, both ends included: `0.1:1.5:500` on the command line, or a single number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Unchecked")]
pub(crate) struct Range {
    first: f64,
    last: f64,
    count: usize,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    first: f64,
    last: f64,
    count: usize,
}

impl TryFrom<Unchecked> for Range {
    type Error = String;

    fn try_from(Unchecked { first, last, count }: Unchecked) -> Result<Self, String> {
        Self::new(first, last, count)
    }
}

impl Range {
    /// From `first` to `last` >= `first`; a single value has equal ends.
    pub(crate) fn new(first: f64, last: f64, count: usize) -> Result<Self, String> {
        let range = Self { first, last, count };
        if let Some(end) = [first, last].into_iter().find(|end| !end.is_finite()) {
            return Err(format!("{end} is not finite"));
        }
        match count {
            0 => Err("it has no values; the third part, the number of points, must be at least 1".to_owned()),
            1 if first < last => {
                Err(format!("one point cannot be both {first:?} and {last:?}; give at least 2 points"))
            }
            _ if count > MOST => Err(format!("{count} points are more than {MOST}, the largest number")),
            1 => Ok(range),
            _ if last < first => Err(format!("it is reversed, as {last:?} is below {first:?}")),
            _ if !(last - first).is_finite() => {
                Err(format!("the distance from {first:?} to {last:?} is too large for a double"))
            }
            _ if range.rises() => Ok(range),
            _ => Err(format!(
                "{count} points from {first:?} to {last:?} are not distinct numbers; widen the range or take fewer points"
            )),
        }
    }

    /// Whether every value is above its predecessor: a step finer than the spacing of doubles repeats values.
    fn rises(&self) -> bool {
        (1..self.count).all(|index| self.value(index - 1) < self.value(index))
    }

    pub(crate) const fn single(value: f64) -> Self {
        Self { first: value, last: value, count: 1 }
    }

    pub(crate) const fn count(&self) -> usize {
        self.count
    }

    pub(crate) const fn ends(&self) -> (f64, f64) {
        (self.first, self.last)
    }

    /// The value with this index, or the last value if the index is too large.
    pub(crate) fn value(&self, index: usize) -> f64 {
        if index + 1 >= self.count {
            return self.last;
        }
        self.first + (self.last - self.first) * index as f64 / (self.count - 1) as f64
    }

    pub(crate) fn values(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.count).map(|index| self.value(index))
    }

    /// The only value; `None` of several.
    pub(crate) fn only(&self) -> Option<f64> {
        (self.count == 1).then_some(self.first)
    }

    /// The outer ends of equal cells with the values in their middles; `width` is the width of a single cell.
    pub(crate) fn cell_ends(&self, width: f64) -> (f64, f64) {
        let step = match self.count {
            // A huge number absorbs `width`.
            1 => width.max(0.01 * self.first.abs()),
            count => (self.last - self.first) / (count - 1) as f64,
        };
        (self.first - 0.5 * step, self.last + 0.5 * step)
    }
}

/// Name and value of NAME=VALUE; `form` is the error for any other text.
pub(crate) fn assignment<'t>(text: &'t str, form: &str) -> Result<(&'t str, &'t str), String> {
    text.split_once('=').map(|(name, value)| (name.trim(), value)).ok_or_else(|| form.to_owned())
}

/// A number as people write it.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    let value: f64 = text.trim().parse().map_err(|_| format!("{text:?} is not a number"))?;
    if value.is_finite() { Ok(value) } else { Err(format!("{text:?} is not finite")) }
}

impl FromStr for Range {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.split(':').collect::<Vec<_>>()[..] {
            [value] => Ok(Self::single(number(value)?)),
            [first, last, count] => {
                let whole = count.trim().parse();
                let count = whole.map_err(|_| format!("{count:?} is not a number of points"))?;
                Self::new(number(first)?, number(last)?, count)
            }
            _ => Err("a range is FIRST:LAST:POINTS, both ends included, such as 0.1:1.5:500".to_owned()),
        }
    }
}

impl Display for Range {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.only() {
            Some(value) => write!(f, "{value}"),
            None => write!(f, "{}:{}:{}", self.first, self.last, self.count),
        }
    }
}

/// The two ends of an interval: `0.5:0.7` on the command line, or a single number twice.
pub(crate) fn interval(text: &str) -> Result<[f64; 2], String> {
    let [low, high] = match text.split(':').collect::<Vec<_>>()[..] {
        [value] => [number(value)?; 2],
        [low, high] => [number(low)?, number(high)?],
        _ => return Err("an interval is LOW:HIGH, such as 0.5:0.7".to_owned()),
    };
    if high < low { Err(format!("it is reversed, as {high} is below {low}")) } else { Ok([low, high]) }
}

/// Words, their help and their meaning. An old word is accepted, but has no help and is not listed.
pub(crate) type Words<T> = &'static [(&'static str, &'static str, T)];

pub(crate) fn one_of<T: Copy + Send + Sync + 'static>(words: Words<T>) -> impl TypedValueParser<Value = T> {
    let possible =
        words.iter().map(|(word, help, _)| PossibleValue::new(*word).help(*help).hide(help.is_empty()));
    PossibleValuesParser::new(possible).try_map(move |word| {
        let found = words.iter().find(|(own, ..)| *own == word);
        found.map(|(.., value)| *value).ok_or("an unknown word")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Range, String> {
        text.parse()
    }

    #[test]
    fn both_ends_are_there_to_the_last_bit() {
        let range = read("0.1:1.5:500").unwrap();
        let values: Vec<f64> = range.values().collect();
        assert_eq!(values.len(), 500);
        assert_eq!((values[0].to_bits(), values[499].to_bits()), (0.1_f64.to_bits(), 1.5_f64.to_bits()));
        assert!(values.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(range.to_string(), "0.1:1.5:500");
        assert_eq!(read(&range.to_string()), Ok(range));
    }

    #[test]
    fn one_number_is_a_range_of_one() {
        for text in ["0.5", "0.5:0.5:1"] {
            let range = read(text).unwrap();
            assert_eq!((range.only(), range.count()), (Some(0.5), 1));
            assert_eq!(range.cell_ends(1.0), (0.0, 1.0));
        }
        assert_eq!(read("-0.0").unwrap().only().map(f64::to_bits), Some((-0.0_f64).to_bits()));
    }

    #[test]
    fn a_wrong_range_is_refused_with_the_reason() {
        for (text, told) in [
            ("", "not a number"),
            ("a", "\"a\" is not a number"),
            ("nan", "not finite"),
            ("inf", "not finite"),
            ("0:1", "FIRST:LAST:POINTS"),
            ("0:1:2:3", "FIRST:LAST:POINTS"),
            ("0:1:0", "no values"),
            ("0:1:1", "one point"),
            ("1:0:5", "reversed"),
            ("0:0:2", "2 points from 0.0 to 0.0 are not distinct numbers"),
            ("0.3:0.30000000000000004:3", "3 points from 0.3 to 0.30000000000000004 are not distinct"),
            ("1:1.0000000000000004:1000", "not distinct numbers"),
            ("0:1e-322:100", "not distinct numbers"),
            ("0:1:-1", "number of points"),
            ("0:1:1.5", "number of points"),
            ("0:1:1000001", "more than 1000000"),
            ("-1e308:1e308:3", "from -1e308 to 1e308 is too large"),
        ] {
            let error = read(text).unwrap_err();
            assert!(error.contains(told), "{text}: {error}");
        }
    }

    /// The next number above is as near as a point can be.
    #[test]
    fn neighbouring_numbers_are_a_range() {
        let first = 0.3_f64;
        for step in 1..5_u64 {
            let last = f64::from_bits(first.to_bits() + step);
            let range = Range::new(first, last, step as usize + 1).unwrap();
            let bits: Vec<u64> = range.values().map(f64::to_bits).collect();
            assert_eq!(bits, (0..=step).map(|up| first.to_bits() + up).collect::<Vec<_>>());
            assert!(Range::new(first, last, step as usize + 2).is_err());
        }
    }

    #[test]
    fn a_stored_range_is_checked_again() {
        let read = |text: &str| serde_json::from_str::<Range>(text);
        assert_eq!(read(r#"{"first":0.0,"last":1.0,"count":3}"#).unwrap(), Range::new(0.0, 1.0, 3).unwrap());
        assert!(read(r#"{"first":1.0,"last":0.0,"count":3}"#).is_err());
        assert!(read(r#"{"first":0.0,"last":1.0,"count":3,"step":1}"#).is_err());
    }

    #[test]
    fn an_interval_has_two_ends() {
        assert_eq!(interval("0.5:0.7"), Ok([0.5, 0.7]));
        assert_eq!(interval("0.5"), Ok([0.5, 0.5]));
        for text in ["0.7:0.5", "1:2:3", "x", "nan:1"] {
            assert!(interval(text).is_err(), "{text}");
        }
    }
}
