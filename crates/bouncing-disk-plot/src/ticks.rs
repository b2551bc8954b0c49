//! The ticks of an axis, and their labels.

use std::f64::consts::PI;

use crate::builders::builders;
use crate::label::Label;

/// Largest number of ticks that an axis can show; a step that needs more is an error.
const MOST_TICKS: f64 = 400.0;

/// The choice of ticks of an axis; by default round steps with about five labels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ticks {
    pub(crate) choice: Choice,
    /// Number of parts into which minor ticks divide the distance between major ones.
    pub(crate) parts: Option<u32>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum Choice {
    /// Round steps, about five labels.
    #[default]
    Automatic,
    Every(f64),
    /// Steps of pi times a fraction, given as numerator and denominator.
    PiFractions(u32, u32),
    PiDecimals(f64),
    At(Vec<(f64, Label)>),
}

builders!(Ticks {
    /// Divides the distance between labelled ticks into `parts` by minor ticks; 1 for none.
    minor(parts: u32) |own| own.parts = Some(parts);
});

impl Ticks {
    /// No ticks.
    pub fn none() -> Self {
        Choice::At(Vec::new()).into()
    }

    /// Round steps, at most five over a span.
    pub(crate) fn few(span: f64) -> Self {
        let (step, parts) = round_step(span / 5.0);
        Self::every(step).minor(parts)
    }

    /// A label at every multiple of `step`.
    pub fn every(step: f64) -> Self {
        Choice::Every(step).into()
    }

    /// A label at every multiple of `numerator`/`denominator` π, written as a fraction: `π/2`, `π`, `3π/2`.
    pub fn pi(numerator: u32, denominator: u32) -> Self {
        Choice::PiFractions(numerator, denominator).into()
    }

    /// A label at every multiple of `step` π, written as a decimal: `0.2π`.
    pub fn pi_decimal(step: f64) -> Self {
        Choice::PiDecimals(step).into()
    }

    /// Labels at given values.
    pub fn at<L: Into<Label>>(ticks: impl IntoIterator<Item = (f64, L)>) -> Self {
        Choice::At(ticks.into_iter().map(|(value, label)| (value, label.into())).collect()).into()
    }
}

impl From<Choice> for Ticks {
    fn from(choice: Choice) -> Self {
        Self { choice, parts: None }
    }
}

/// A tick; minor ones have no label.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tick {
    pub(crate) value: f64,
    pub(crate) label: Option<Label>,
}

/// The ticks of an axis, and the power of ten omitted from their numbers.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PlacedTicks {
    pub(crate) ticks: Vec<Tick>,
    pub(crate) power: Option<i32>,
}

/// The ticks of a linear axis; `Err` contains the invalid step.
pub(crate) fn linear(ticks: &Ticks, low: f64, high: f64, room: usize) -> Result<PlacedTicks, f64> {
    let (low, high) = if low < high { (low, high) } else { (high, low) };
    let (step, parts) = match ticks.choice {
        Choice::At(ref given) => return Ok(within(given, low, high)),
        Choice::Automatic => automatic_step(low, high, room),
        Choice::Every(step) => (step, 2),
        Choice::PiFractions(top, bottom) => (PI * f64::from(top) / f64::from(bottom), 2),
        Choice::PiDecimals(step) => (PI * step, 2),
    };
    let parts = ticks.parts.unwrap_or(parts).max(1);
    let count = (high - low) / step * f64::from(parts);
    if !(step > 0.0 && step.is_finite() && count <= MOST_TICKS) {
        return Err(step);
    }
    // Ends that are multiples of the step up to rounding carry a tick.
    let slack = 1e-6;
    let minor_step = step / f64::from(parts);
    let first = (low / minor_step - slack).ceil() as i64;
    let last = (high / minor_step + slack).floor() as i64;
    let pi = matches!(ticks.choice, Choice::PiFractions(..) | Choice::PiDecimals(_));
    let power = if pi { None } else { common_power(low.abs().max(high.abs())) };
    let ticks = (first..=last).map(|index| {
        if index % i64::from(parts) != 0 {
            return Tick { value: index as f64 * minor_step, label: None };
        }
        let multiple = index / i64::from(parts);
        let value = multiple as f64 * step;
        let label = match ticks.choice {
            Choice::PiFractions(numerator, denominator) => pi_fraction(multiple, numerator, denominator),
            Choice::PiDecimals(step) => pi_decimal(multiple, step),
            _ => Label::plain(&number(value, step, power)),
        };
        Tick { value, label: Some(label) }
    });
    Ok(PlacedTicks { ticks: ticks.collect(), power })
}

/// The ticks of a logarithmic axis: decades, and the eight values between them.
pub(crate) fn logarithmic(ticks: &Ticks, low: f64, high: f64) -> PlacedTicks {
    let (low, high) = if low < high { (low, high) } else { (high, low) };
    if let Choice::At(given) = &ticks.choice {
        return within(given, low, high);
    }
    let inside = |value: f64| value >= low * (1.0 - 1e-9) && value <= high * (1.0 + 1e-9);
    let first = libm::floor(libm::log10(low) - 1e-9) as i32;
    let last = libm::ceil(libm::log10(high) + 1e-9) as i32;
    let decades = (first..=last).filter(|exponent| inside(power_of_ten(*exponent))).count();
    // With fewer than two decades in sight, 2 and 5 are labelled too; with many, only some decades are.
    let label_between = decades < 2;
    let every = (decades as i32 + 7) / 8;
    let mut ticks = Vec::new();
    for exponent in first..=last {
        for digit in 1..=9 {
            let value = f64::from(digit) * power_of_ten(exponent);
            if !inside(value) {
                continue;
            }
            let label = match digit {
                1 if exponent.rem_euclid(every.max(1)) == 0 => Some(format!("$10^{{{exponent}}}$")),
                2 | 5 if label_between => Some(format!("${digit}\\times 10^{{{exponent}}}$")),
                _ => None,
            };
            ticks.push(Tick { value, label: label.map(|text| Label::new(&text)) });
        }
    }
    PlacedTicks { ticks, power: None }
}

/// The given ticks that lie on the axis.
fn within(given: &[(f64, Label)], low: f64, high: f64) -> PlacedTicks {
    let inside = given.iter().filter(|(value, _)| (low..=high).contains(value));
    let ticks = inside.map(|(value, label)| Tick { value: *value, label: Some(label.clone()) });
    PlacedTicks { ticks: ticks.collect(), power: None }
}

/// The exact power of ten nearest in double precision.
fn power_of_ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(f64::NAN)
}

/// The round number (1, 2 or 5 times a power of ten) at or above `raw`, and the number of parts into which minor
/// ticks divide it.
fn round_step(raw: f64) -> (f64, u32) {
    let exponent = libm::floor(libm::log10(raw) + 1e-9) as i32;
    let unit = power_of_ten(exponent);
    let mantissa = raw / unit;
    let (digit, parts) = if mantissa <= 1.0 + 1e-6 {
        (1, 5)
    } else if mantissa <= 2.0 {
        (2, 4)
    } else if mantissa <= 5.0 {
        (5, 5)
    } else {
        (10, 5)
    };
    // Reading the decimal text gives the nearest double; a product would not.
    (format!("{digit}e{exponent}").parse().unwrap_or(f64::NAN), parts)
}

/// A round step for this number of labels, or a finer one if it would leave fewer than two labels.
fn automatic_step(low: f64, high: f64, room: usize) -> (f64, u32) {
    let choice = round_step((high - low) / room.max(1) as f64);
    let labels = |step: f64| libm::floor(high / step) - libm::ceil(low / step) + 1.0;
    if labels(choice.0) >= 2.0 { choice } else { round_step(0.5 * choice.0) }
}

/// The power of ten to omit from the numbers, if they are very large or small.
fn common_power(largest: f64) -> Option<i32> {
    let plain = (1e-3..1e5).contains(&largest) || largest == 0.0;
    (!plain).then(|| libm::floor(libm::log10(largest) + 1e-9) as i32)
}

/// A number with as many decimals as the step needs.
fn number(value: f64, step: f64, power: Option<i32>) -> String {
    let unit = power.map_or(1.0, power_of_ten);
    decimal(value / unit, decimals(step / unit))
}

/// The number of decimals, at most six, with which multiples of `step` are exact.
fn decimals(step: f64) -> usize {
    let mut scaled = step.abs();
    for count in 0..6 {
        if (scaled - scaled.round()).abs() < 1e-6 * scaled.max(1.0) && scaled.round() > 0.0 {
            return count;
        }
        scaled *= 10.0;
    }
    6
}

fn decimal(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    if text.trim_start_matches('-').bytes().all(|b| matches!(b, b'0' | b'.')) {
        return text.trim_start_matches('-').to_owned();
    }
    text.replace('-', "−")
}

/// `multiple` times `numerator`/`denominator` π in lowest terms.
fn pi_fraction(multiple: i64, numerator: u32, denominator: u32) -> Label {
    let top = multiple * i64::from(numerator);
    let bottom = i64::from(denominator);
    let divisor = greatest_common_divisor(top.unsigned_abs(), bottom.unsigned_abs()).max(1) as i64;
    let (top, bottom) = (top / divisor, bottom / divisor);
    let sign = if top < 0 { "−" } else { "" };
    let text = match (top.abs(), bottom) {
        (0, _) => "0".to_owned(),
        (1, 1) => format!("{sign}$\\pi$"),
        (n, 1) => format!("{sign}{n}$\\pi$"),
        (1, d) => format!("{sign}$\\pi$/{d}"),
        (n, d) => format!("{sign}{n}$\\pi$/{d}"),
    };
    Label::new(&text)
}

fn greatest_common_divisor(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { greatest_common_divisor(b, a % b) }
}

fn pi_decimal(multiple: i64, step: f64) -> Label {
    let text = match decimal(multiple as f64 * step, decimals(step)) {
        _ if multiple == 0 => "0".to_owned(),
        // A whole multiple of one, whatever its decimals.
        one if one.trim_end_matches('0') == "1." || one == "1" => "$\\pi$".to_owned(),
        one if one.trim_end_matches('0') == "−1." || one == "−1" => "−$\\pi$".to_owned(),
        other => format!("{other}$\\pi$"),
    };
    Label::new(&text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(placed: &PlacedTicks) -> Vec<String> {
        let labels = placed.ticks.iter().filter_map(|tick| tick.label.as_ref());
        labels.map(|label| label.source().replace('$', "")).collect()
    }

    #[test]
    fn automatic_steps_are_round() {
        let ticks = linear(&Ticks::default(), 0.3, 0.6, 6).expect("ticks");
        assert_eq!(labels(&ticks), ["0.30", "0.35", "0.40", "0.45", "0.50", "0.55", "0.60"]);
        let ticks = linear(&Ticks::default(), -22.0, 22.0, 5).expect("ticks");
        assert_eq!(labels(&ticks), ["−20", "−10", "0", "10", "20"]);
        let ticks = linear(&Ticks::default(), 0.0, 2e-8, 5).expect("ticks");
        assert_eq!(labels(&ticks), ["0.0", "0.5", "1.0", "1.5", "2.0"]);
        assert_eq!(ticks.power, Some(-8));
    }

    /// With room for three labels the step would be 2, of whose multiples only 0 lies on the axis.
    #[test]
    fn no_automatic_scale_has_a_single_label() {
        let ticks = linear(&Ticks::default(), -1.575, 1.575, 3).expect("ticks");
        assert_eq!(labels(&ticks), ["−1", "0", "1"]);
    }

    #[test]
    fn a_few_labels_are_a_few_whatever_the_span() {
        for span in [1e-12, 3e-7, 0.1, 0.83, 1.0, 2.0, 4.99, 5.0, 7.0, 99.0, 1e9] {
            let Choice::Every(step) = Ticks::few(span).choice else { panic!("{span}") };
            assert!((2.0..=5.000_01).contains(&(span / step)), "{span}: {step}");
        }
    }

    #[test]
    fn multiples_of_pi() {
        let ticks = linear(&Ticks::pi(1, 2), -PI, 2.0 * PI, 5).expect("ticks");
        assert_eq!(labels(&ticks), ["−\\pi", "−\\pi/2", "0", "\\pi/2", "\\pi", "3\\pi/2", "2\\pi"]);
        let ticks = linear(&Ticks::pi_decimal(0.1), 0.0, 0.5 * PI, 5).expect("ticks");
        assert_eq!(labels(&ticks), ["0", "0.1\\pi", "0.2\\pi", "0.3\\pi", "0.4\\pi", "0.5\\pi"]);
        let ticks = linear(&Ticks::pi_decimal(0.5), -PI, PI, 5).expect("ticks");
        assert_eq!(labels(&ticks), ["−\\pi", "−0.5\\pi", "0", "0.5\\pi", "\\pi"]);
    }

    #[test]
    fn logarithmic_ticks_are_decades() {
        let ticks = logarithmic(&Ticks::default(), 1e-9, 1e-7);
        assert_eq!(labels(&ticks), ["10^{-9}", "10^{-8}", "10^{-7}"]);
        assert_eq!(ticks.ticks.len(), 19);
        let ticks = logarithmic(&Ticks::default(), 0.3, 0.8);
        assert_eq!(labels(&ticks), ["5\\times 10^{-1}"]);
    }

    #[test]
    fn a_step_that_gives_too_many_ticks_is_refused() {
        assert_eq!(linear(&Ticks::every(1e-6), 0.0, 1.0, 5), Err(1e-6));
        assert_eq!(linear(&Ticks::every(-0.5), 0.0, 1.0, 5), Err(-0.5));
        assert!(linear(&Ticks::pi(1, 0), 0.0, 1.0, 5).is_err());
        assert_eq!(linear(&Ticks::every(0.5).minor(5), 0.0, 1.0, 5).map(|placed| placed.ticks.len()), Ok(11));
    }
}
