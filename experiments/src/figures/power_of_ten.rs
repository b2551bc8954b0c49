//! Powers of ten in labels.

/// The power of ten of a number that is one.
pub(crate) fn exponent(value: f64) -> String {
    let text = format!("{value:e}");
    text.split_once('e').map_or(text.clone(), |(_, power)| power.replace('-', "\u{2212}"))
}
