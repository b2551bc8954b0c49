//! The products of the results of all figures: the gallery with `claims.json`, and the committed pages.
//!
//! A claim becomes a row of words once; one set of templates turns rows into HTML and Markdown.

pub mod counts;
mod digits;
pub mod gallery;
pub mod pages;
mod schema;

use std::collections::BTreeMap;

use minijinja::{Environment, ErrorKind, UndefinedBehavior, Value, context};
use serde::Serialize;

use crate::claims::printed::is_multiple_of_pi;
use crate::claims::{Claim, Class, Computed, Verdict};
use crate::experiment::{Experiment, Record};

/// A template that needs what is not there, or a number of a discussion that no claim has.
pub use minijinja::Error as TemplateError;

/// A claim as one reads it.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Row {
    place: String,
    quantity: String,
    printed: String,
    computed: String,
    tolerance: String,
    class: String,
    verdict: Verdict,
    /// With the cause and the verdict of single orbits.
    words: String,
    /// For how many of the inputs that print alike it holds.
    share: String,
    note: String,
    cause: String,
    /// Whether it counts against the paper.
    is_against: bool,
    /// The entry that has the printed text, and its file in data/paper; empty for what is not printed.
    key: String,
    printed_in: String,
    /// File and line of the code that states it, and apart.
    code: String,
    code_file: String,
    code_line: String,
}

impl Row {
    fn of(claim: &Claim) -> Self {
        let of_digits = |number, digits| like(&claim.printed, number, digits);
        let is_statement =
            claim.printed == "true" || matches!(claim.computed, Computed::Text(_)) && claim.share.is_some();
        let class = claim.class.words();
        let key = claim.key.as_deref().unwrap_or_default();
        let (code_file, code_line) = claim.code.rsplit_once(':').unwrap_or_default();
        Self {
            place: claim.place.clone(),
            quantity: claim.quantity.clone(),
            // The catalogue has "true" for a statement in words.
            printed: if is_statement { "stated".to_owned() } else { with_unit(&claim.printed, &claim.unit) },
            computed: match &claim.computed {
                Computed::Number(number) => with_unit(&of_digits(*number, 6), &claim.unit),
                Computed::Boolean(true) => "holds".to_owned(),
                Computed::Boolean(false) => "does not hold".to_owned(),
                Computed::Text(text) => text.clone(),
                Computed::Nothing => "—".to_owned(),
            },
            tolerance: claim.tolerance.map_or("—".to_owned(), |tolerance| of_digits(tolerance, 2)),
            class: match claim.kind.filter(|_| claim.class == Class::Paper) {
                Some(kind) => format!("{class}: {}", kind.name()),
                None => class.to_owned(),
            },
            verdict: claim.verdict,
            words: verdict_words(claim),
            share: claim.share.map_or("—".to_owned(), |share| format!("{:.0} %", 100.0 * share)),
            note: claim.note.clone(),
            cause: claim.cause.as_deref().unwrap_or_default().to_owned(),
            is_against: claim.class == Class::Paper && claim.verdict == Verdict::Differs,
            key: key.to_owned(),
            printed_in: key
                .split_once('.')
                .map_or_else(String::new, |(file, _)| format!("data/paper/{file}.json")),
            code: claim.code.clone(),
            code_file: code_file.to_owned(),
            code_line: code_line.to_owned(),
        }
    }
}

/// A verdict on the paper in words.
fn words(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Reproduced => "reproduced",
        Verdict::Differs => "differs",
        Verdict::DependsOnUnprintedDigits => "depends on unprinted digits",
        Verdict::NotComputable => "no data",
    }
}

/// The verdict of a claim in words, with its cause and the verdict of single orbits. A claim that is not the
/// paper's is neither reproduced nor does it differ.
fn verdict_words(claim: &Claim) -> String {
    let own = |verdict| match (claim.class, verdict) {
        (Class::Input, Verdict::NotComputable) => "put in",
        (Class::Paper, _) | (_, Verdict::NotComputable | Verdict::DependsOnUnprintedDigits) => words(verdict),
        (_, Verdict::Reproduced) => "agrees",
        (_, Verdict::Differs) => "does not agree",
    };
    let mut text = own(claim.verdict).to_owned();
    if let Some(cause) = &claim.cause {
        text.push_str(&format!(" ({cause})"));
    }
    if let Some(single) = claim.single_orbits {
        let verdict = match single.verdict {
            Verdict::DependsOnUnprintedDigits => "depend on the orbit",
            other => own(other),
        };
        let cases = single.cases;
        text.push_str(&format!("; single orbits: {verdict} ({} of {})", cases.holding, cases.tried));
    }
    text
}

/// The discussion of an experiment with the numbers of its claims.
pub(crate) fn discussion(experiment: &Experiment, claims: &[Claim]) -> Result<String, TemplateError> {
    let numbers = claims.iter().filter_map(|claim| match (&claim.key, &claim.computed) {
        (Some(key), Computed::Number(number)) => Some((key.clone(), like(&claim.printed, *number, 4))),
        // Not found, as may be with other inputs than the paper's.
        (Some(key), Computed::Text(_) | Computed::Nothing) => Some((key.clone(), "—".to_owned())),
        _ => None,
    });
    let claims: BTreeMap<_, _> = numbers.collect();
    environment().render_named_str(experiment.id, experiment.discussion.trim(), context! { claims })
}

/// One figure as one reads it.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Section {
    id: String,
    /// "Fig. 6" for `fig06`, "Table II" for `table2`, the identifier for anything else.
    name: String,
    title: String,
    caption: String,
    discussion: String,
    parameters: Vec<(String, String)>,
    rows: Vec<Row>,
}

impl Section {
    fn of(record: &Record) -> Self {
        Self {
            id: record.id.clone(),
            name: name(&record.id),
            title: record.title.clone(),
            caption: record.caption.clone(),
            discussion: record.discussion.clone(),
            parameters: record.parameters.clone(),
            rows: record.claims.iter().map(Row::of).collect(),
        }
    }
}

/// The templates, and what they may ask for.
fn environment() -> Environment<'static> {
    let mut environment = Environment::new();
    environment.set_undefined_behavior(UndefinedBehavior::Strict);
    environment.set_trim_blocks(true);
    environment.set_lstrip_blocks(true);
    environment.set_keep_trailing_newline(true);
    environment
        .add_filter("cell", |text: &str| text.replace('|', "\\|").replace('\n', " ").replace('*', "\\*"));
    environment.add_filter("symbols", |text: &str| Value::from_safe_string(symbols(text)));
    environment.add_filter("number", number);
    environment.add_filter("near", near);
    environment
}

/// HTML in which what follows an underscore is set below: `φ_L` as φ<sub>L</sub>. A name in code, such as `impact_phase`, has more
/// than two letters before it and stays.
fn symbols(text: &str) -> String {
    let escaped = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;");
    let (mut html, mut letters, mut below) = (String::new(), 0, false);
    for c in escaped.chars() {
        // A dot above a letter is a character of its own.
        let is_mark = ('\u{300}'..='\u{36f}').contains(&c);
        if below && !(c.is_alphanumeric() || is_mark) {
            html.push_str("</sub>");
            below = false;
        }
        if c == '_' && (1..=2).contains(&letters) {
            html.push_str("<sub>");
            below = true;
        } else {
            html.push(c);
        }
        letters = if c.is_alphanumeric() { letters + 1 } else { letters * usize::from(is_mark) };
    }
    if below {
        html.push_str("</sub>");
    }
    html
}

/// How a number is written: `.3` with so many decimals, `e1` in powers of ten with so many decimals, `s4`
/// with so many significant digits. Before it `%` for a share in per cent, `π` for a multiple of π, `m`, `µ`
/// for thousandths and millionths, `k` for thousands.
fn number(number: f64, format: &str) -> Result<String, TemplateError> {
    let malformed = || TemplateError::new(ErrorKind::InvalidOperation, format!("{format} is no format"));
    let factors = [('%', 1e2), ('π', std::f64::consts::FRAC_1_PI), ('m', 1e3), ('µ', 1e6), ('k', 1e-3)];
    let with_factor = factors.iter().find_map(|(sign, factor)| Some((format.strip_prefix(*sign)?, *factor)));
    let (style, factor) = with_factor.unwrap_or((format, 1.0));
    let number = number * factor;
    let mut letters = style.chars();
    let first = letters.next().ok_or_else(malformed)?;
    let digits: usize = letters.as_str().parse().map_err(|_| malformed())?;
    match first {
        '.' => Ok(format!("{number:.digits$}").replace('-', "−")),
        'e' => Ok(format!("{number:.digits$e}").replace('-', "−")),
        's' => Ok(significant(number, digits)),
        _ => Err(malformed()),
    }
}

/// The entry of a long list whose `field` is nearest to a number: a place in a list means nothing, and
/// shifts.
fn near(list: Value, field: &str, wanted: f64) -> Result<Value, TemplateError> {
    let mut nearest: Option<(f64, Value)> = None;
    for entry in list.try_iter()? {
        let off = (f64::try_from(entry.get_attr(field)?)? - wanted).abs();
        if nearest.as_ref().is_none_or(|(least, _)| off < *least) {
            nearest = Some((off, entry));
        }
    }
    nearest.map(|(_, entry)| entry).ok_or_else(|| TemplateError::new(ErrorKind::NonKey, "an empty list"))
}

/// "Fig. 6" for `fig06`, "Table II" for `table2`, the identifier for anything else.
fn name(id: &str) -> String {
    let number = |digits: &str| digits.parse::<u32>().ok();
    if let Some(figure) = id.strip_prefix("fig").and_then(number) {
        return format!("Fig. {figure}");
    }
    match id.strip_prefix("table").and_then(number) {
        Some(table @ 1..=3) => format!("Table {}", "I".repeat(table as usize)),
        _ => id.to_owned(),
    }
}

fn with_unit(number: &str, unit: &str) -> String {
    // A printed text may bring its unit along.
    if unit.is_empty() || number.ends_with(unit) {
        number.to_owned()
    } else {
        format!("{number}\u{a0}{unit}")
    }
}

/// A number with so many significant digits, as a multiple of π where the printed one is.
fn like(printed: &str, number: f64, digits: usize) -> String {
    if is_multiple_of_pi(printed) {
        format!("{}π", significant(number / std::f64::consts::PI, digits))
    } else {
        significant(number, digits)
    }
}

/// A number with so many significant digits, as one reads it.
fn significant(number: f64, digits: usize) -> String {
    if number == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{number:.*e}", digits.max(1) - 1);
    let Some((mantissa, exponent)) = scientific.split_once('e') else { return scientific };
    let exponent: i32 = exponent.parse().unwrap_or_default();
    let text = if (-4..=6).contains(&exponent) {
        let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or_default();
        shortened(&format!("{number:.decimals$}")).to_owned()
    } else {
        let raised = |c: char| c.to_digit(10).map_or('⁻', |digit| SUPERSCRIPTS[digit as usize]);
        let power: String = exponent.to_string().chars().map(raised).collect();
        format!("{} × 10{power}", shortened(mantissa))
    };
    text.replace('-', "−")
}

const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// Without zeros at the end of the decimals.
fn shortened(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn numbers_and_names_are_readable() {
        for (number, digits, text) in [
            (0.486_003_078_3, 6, "0.486003"),
            (22.0, 6, "22"),
            (-1.234_567_89e-8, 6, "−1.23457 × 10⁻⁸"),
            (70_000.0, 6, "70000"),
            (0.0005, 2, "0.0005"),
            (999_999.96, 6, "1000000"),
            (0.0, 6, "0"),
        ] {
            assert_eq!(significant(number, digits), text);
        }
        assert_eq!(like("0.323π", 0.3225 * std::f64::consts::PI, 6), "0.3225π");
        assert_eq!(like("cos(0.26π)", 0.685_9, 6), "0.6859");
        let names = ["fig06", "fig13", "table1", "table3", "demo"].map(name);
        assert_eq!(names, ["Fig. 6", "Fig. 13", "Table I", "Table III", "demo"]);
    }

    #[test]
    fn verdicts_are_said_in_words() {
        let row =
            |computed: f64| Row::of(&Claim::printed("section4.doubling_2", computed).cause("a misprint"));
        assert_eq!([row(0.5307), row(0.6)].map(|row| row.words), ["reproduced", "differs (a misprint)"]);
        let ours = |holds| Row::of(&Claim::statement("fig06", "", "ours", holds, "")).words;
        assert_eq!([Some(true), Some(false), None].map(ours), ["agrees", "does not agree", "no data"]);
    }

    #[test]
    fn symbols_are_set_and_names_of_code_are_not() {
        for (text, html) in [
            ("φ_L = 0.2 & a_e<1", "φ<sub>L</sub> = 0.2 &amp; a<sub>e</sub>&lt;1"),
            ("α\u{307}_ss/t_c", "α\u{307}<sub>ss</sub>/t<sub>c</sub>"),
            ("δl_0, τ_imp", "δl<sub>0</sub>, τ<sub>imp</sub>"),
            ("impact_phase_rad", "impact_phase_rad"),
        ] {
            assert_eq!(symbols(text), html);
        }
    }

    #[test]
    fn references_of_a_template_are_filled_in_and_faults_named() {
        let data = json!({"merging": {"survived": 0.560_750_7, "width": -1.2e-7}, "list": [0.25, 3],
            "slices": [{"x": 1.0, "y": 5}, {"x": 2.0, "y": 6}]});
        let fill = |template: &str| {
            let data = Value::from_serialize(&data);
            environment().render_str(template, context! { fig06 => data }).map_err(|error| error.to_string())
        };
        for (template, text) in [
            (r#"At {{ fig06.merging.survived|number(".4") }}!"#, "At 0.5608!"),
            (r#"{{ fig06.merging.width|number("e1") }}"#, "−1.2e−7"),
            (r#"{{ fig06.list[0]|number("%.1") }} %, {{ fig06.list[1]|number(".0") }}"#, "25.0 %, 3"),
            (r#"{{ (fig06.slices|near("x", 1.9)).y|number(".0") }}"#, "6"),
            (r#"{{ fig06.list[0]|number("π.4") }}π, {{ fig06.list[1]|number("s6") }}"#, "0.0796π, 3"),
            (r#"{{ fig06.list[1]|number("k.3") }}"#, "0.003"),
        ] {
            assert_eq!(fill(template).as_deref(), Ok(text));
        }
        for template in [
            r#"{{ fig06.list[2]|number(".0") }}"#,
            r#"{{ (fig06.slices|near("z", 1)).y|number(".0") }}"#,
            r#"{{ fig07.list[0]|number(".0") }}"#,
            r#"{{ fig06.list[0]|number("x") }}"#,
            r#"{{ fig06.merging|number(".1") }}"#,
        ] {
            fill(template).expect_err(template);
        }
    }

    #[test]
    fn a_discussion_takes_its_numbers_from_the_claims() {
        let mut demo = crate::testing::demo_entries().remove(0);
        let claims = [Claim::printed("section4.merging", 0.560_750_7)];
        demo.discussion = "Lost at {{ claims[\"section4.merging\"] }}, for good.\n";
        assert_eq!(discussion(&demo, &claims).ok().as_deref(), Some("Lost at 0.5608, for good."));
        demo.discussion = "{{ claims[\"section4.doubling_1\"] }}";
        discussion(&demo, &claims).expect_err("not answered");
    }
}
