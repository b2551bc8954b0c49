//! The gallery: one HTML page without scripts and without anything from the network.

use std::fmt::Write as _;

use bouncing_disk::Provenance;

use crate::claim::{Claim, Class, Computed, Verdict};
use crate::count::Counts;
use crate::experiment::Quality;
use crate::printed::is_multiple_of_pi;
use crate::registry::is_extra;
use crate::visible::visible;

const STYLE: &str = include_str!("page.css");

/// What comes before the figures that the paper does not have.
const BEYOND: &str = "<h2 id=\"beyond\">Beyond the paper</h2>\n\
    <p>Figures that the paper does not have, of what the same model says about loads, power, fits and designs. All their \
    rows are of class <i>this work</i>: what is expected follows from another computation, and counts neither for nor \
    against the paper.</p>\n";

/// One figure of the gallery.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// The identifier.
    pub id: String,
    /// The short title.
    pub title: String,
    /// The caption.
    pub caption: String,
    /// Names and values with units.
    pub parameters: Vec<(String, String)>,
    /// Printed against computed.
    pub claims: Vec<Claim>,
    /// The quality it was made in.
    pub quality: Quality,
    /// The time it took.
    pub run_time_s: f64,
    /// Faults of the user's measurements that are therefore not shown.
    pub warnings: Vec<String>,
    /// Whether the sources, the measurements or the files have changed since.
    pub outdated: bool,
    /// Whether there is a table as comma-separated values.
    pub has_table: bool,
    /// The width of the picture in pixels.
    pub width: Option<u32>,
}

/// The page, which says where it comes from.
pub fn html(provenance: &Provenance, sections: &[Section]) -> String {
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>Rotating bouncing disks: figures and numbers</title>\n\
         <meta name=\"generator\" content=\"{} {}\">\n<meta name=\"provenance\" content=\"{}\">\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n",
        escaped(provenance.program()),
        escaped(provenance.version()),
        escaped(&serde_json::to_string(provenance).unwrap_or_default()),
    );
    push_header(&mut page, sections);
    page.push_str("<main>\n");
    for section in sections.iter().filter(|section| !is_extra(&section.id)) {
        push_section(&mut page, section);
    }
    let mut extras = sections.iter().filter(|section| is_extra(&section.id)).peekable();
    if extras.peek().is_some() {
        page.push_str(BEYOND);
    }
    for section in extras {
        push_section(&mut page, section);
    }
    page.push_str(
        "</main>\n<footer><p>Made by <code>cargo xtask figures</code>.</p></footer>\n</body>\n</html>\n",
    );
    page
}

fn push_header(page: &mut String, sections: &[Section]) {
    let counts = Counts::of(sections.iter().flat_map(|section| &section.claims));
    page.push_str(
        "<header>\n<h1>Rotating bouncing disks, tossing pizza dough, and ultrasonic motors</h1>\n\
         <p>Figures and tables of K.-C. Liu, J. Friend and L. Yeo, Phys. Rev. E <b>80</b>, 046201 (2009), computed \
         anew. A printed number counts as reproduced when ours agrees within half a unit of its last printed digit, \
         unless another tolerance is given.</p>\n\
         <p>A row of class <i>paper</i> is a number or a statement of the paper, and only these count for or against \
         it. <i>Fitted</i>: a parameter of ours was chosen so that the number comes out. <i>Input</i>: a parameter, a \
         choice, a measurement or a quotation, with nothing to compute. <i>Identity</i>: true by construction, or one \
         printed number against another. <i>This work</i>: a further reading of a printed number, or a finding that \
         the paper does not have. Each row of class <i>paper</i> is judged by the rule of its kind \
         (<code>docs/judging.md</code>).</p>\n",
    );
    let _ = writeln!(
        page,
        "<p>{} figures and tables{}. <b>{}</b> {}</p>",
        sections.iter().filter(|section| !is_extra(&section.id)).count(),
        match sections.iter().filter(|section| is_extra(&section.id)).count() {
            0 => String::new(),
            extras => format!(", and {extras} <a href=\"#beyond\">beyond the paper</a>"),
        },
        escaped(&counts.headline()),
        escaped(&counts.beside())
    );
    page.push_str("<nav>");
    for section in sections {
        let _ = writeln!(page, "<a href=\"#{0}\">{1}</a>", escaped(&section.id), escaped(&name(&section.id)));
    }
    page.push_str("</nav>\n</header>\n");
}

fn push_section(page: &mut String, section: &Section) {
    let id = escaped(&section.id);
    let title = escaped(&section.title);
    let heading = escaped(&section.title);
    let _ = writeln!(page, "<section id=\"{id}\">\n<h2>{}. {heading}</h2>", escaped(&name(&section.id)));
    // Four pixels are a point; 1.9 pixels per point make a double column fill the page.
    let width =
        section.width.map(|pixels| format!(" style=\"width:{}px\"", pixels * 19 / 40)).unwrap_or_default();
    let caption = escaped(&section.caption);
    let _ = writeln!(
        page,
        "<figure>\n<a href=\"{id}.svg\"><img src=\"{id}.png\" alt=\"{title}\"{width}></a>\n\
         <figcaption>{caption}</figcaption>\n</figure>"
    );
    if section.outdated {
        let _ = writeln!(
            page,
            "<p class=\"differs\">Out of date: the program or the measurements have changed since. To repair: \
             <code>cargo xtask figures {id}</code></p>"
        );
    }
    for warning in &section.warnings {
        let _ = writeln!(page, "<p class=\"differs\">Measurements not shown: {}</p>", escaped(warning));
    }
    push_parameters(page, &section.parameters);
    push_claims(page, &section.claims, is_extra(&section.id));
    let table =
        if section.has_table { format!(", <a href=\"{id}.csv\">table (CSV)</a>") } else { String::new() };
    let _ = writeln!(
        page,
        "<p class=\"files\">{} quality, {}. <a href=\"{id}.json\">data (JSON)</a>{table}, \
         <a href=\"{id}.svg\">SVG</a>, <a href=\"{id}.png\">PNG</a></p>\n</section>",
        capitalised(section.quality.name()),
        duration(section.run_time_s),
    );
}

fn push_parameters(page: &mut String, parameters: &[(String, String)]) {
    if parameters.is_empty() {
        return;
    }
    page.push_str("<h3>Parameters</h3>\n<table class=\"parameters\">\n<tbody>\n");
    for (name, value) in parameters {
        let _ = writeln!(page, "<tr><td>{}</td><td>{}</td></tr>", escaped(name), escaped(value));
    }
    page.push_str("</tbody>\n</table>\n");
}

fn push_claims(page: &mut String, claims: &[Claim], beyond_paper: bool) {
    if claims.is_empty() {
        return;
    }
    let reference = if beyond_paper { "Expected" } else { "Printed" };
    let _ = write!(
        page,
        "<h3>{reference} against computed</h3>\n<table class=\"claims\">\n<thead><tr><th>Place</th><th>Quantity</th>\
         <th>{reference}</th><th>Computed</th><th>Tolerance</th><th>Class</th><th>Verdict</th><th>Note</th></tr></thead>\n<tbody>\n",
    );
    for claim in claims {
        let ClaimTexts { computed, printed, tolerance } = ClaimTexts::new(claim);
        let verdict = claim.verdict().name();
        let words = verdict_words(claim);
        // What the paper says in words is "true" in its catalogue.
        let printed = if printed == "true" { "stated".to_owned() } else { printed };
        let cells = [
            ("Place", "", claim.place()),
            ("Quantity", "", claim.quantity()),
            (reference, "number", printed.as_str()),
            ("Computed", "number", computed.as_str()),
            ("Tolerance", "number", tolerance.as_str()),
            ("Class", "", &class_words(claim)),
        ];
        page.push_str("<tr>");
        for (label, class, text) in cells {
            let class = if class.is_empty() { String::new() } else { format!(" class=\"{class}\"") };
            let _ = write!(page, "<td data-label=\"{label}\"{class}>{}</td>", escaped(text));
        }
        let note = if claim.remarks().is_empty() { "—" } else { claim.remarks() };
        let _ = writeln!(
            page,
            "<td data-label=\"Verdict\"><span class=\"verdict {verdict}\">{}</span></td>\
             <td data-label=\"Note\">{}</td></tr>",
            words,
            escaped(note)
        );
    }
    page.push_str("</tbody>\n</table>\n");
}

/// The class of a claim as one reads it, and the kind of what is the paper's own.
pub(crate) fn class_words(claim: &Claim) -> String {
    let class = match claim.class() {
        Class::Paper => "paper",
        Class::Fitted => "fitted",
        Class::Input => "input",
        Class::Identity => "identity",
        Class::ThisWork => "this work",
    };
    match claim.kind().filter(|_| claim.class() == Class::Paper) {
        Some(kind) => format!("{class}: {}", kind.name()),
        None => class.to_owned(),
    }
}

/// The verdict of a claim as one reads it, with its cause and the verdict of single orbits. What is not the paper's is neither reproduced nor does it
/// differ.
pub(crate) fn verdict_words(claim: &Claim) -> String {
    let words = |verdict| match (claim.class(), verdict) {
        (Class::Input, Verdict::NotComputable) => "put in",
        (_, Verdict::NotComputable) => "no data",
        (_, Verdict::DependsOnUnprintedDigits) => "depends on unprinted digits",
        (Class::Paper, Verdict::Reproduced) => "reproduced",
        (Class::Paper, Verdict::Differs) => "differs",
        (_, Verdict::Reproduced) => "agrees",
        (_, Verdict::Differs) => "does not agree",
    };
    let mut text = words(claim.verdict()).to_owned();
    if let Some(cause) = claim.cause_of_difference() {
        let _ = write!(text, " ({cause})");
    }
    if let Some(single) = claim.of_single_orbits() {
        let verdict = match single.verdict {
            Verdict::DependsOnUnprintedDigits => "depend on the orbit",
            other => words(other),
        };
        let _ =
            write!(text, "; single orbits: {verdict} ({} of {})", single.cases.holding, single.cases.tried);
    }
    text
}

/// The numbers of a claim as one reads them.
pub(crate) struct ClaimTexts {
    pub(crate) computed: String,
    pub(crate) printed: String,
    pub(crate) tolerance: String,
}

impl ClaimTexts {
    pub(crate) fn new(claim: &Claim) -> Self {
        let computed = match claim.computed() {
            Computed::Number(number) => with_unit(&like(claim.printed_text(), *number, 6), claim.unit()),
            Computed::Boolean(true) => "holds".to_owned(),
            Computed::Boolean(false) => "does not hold".to_owned(),
            Computed::Text(text) => text.clone(),
            Computed::Nothing => "—".to_owned(),
        };
        let printed = match claim.computed() {
            Computed::Boolean(_) => "stated".to_owned(),
            Computed::Text(_) if claim.share().is_some() => "stated".to_owned(),
            _ => with_unit(claim.printed_text(), claim.unit()),
        };
        let tolerance =
            claim.tolerance().map_or("—".to_owned(), |tolerance| like(claim.printed_text(), tolerance, 2));
        Self { computed, printed, tolerance }
    }
}

/// "Fig. 6" for `fig06`, "Table II" for `table2`, the identifier for anything else.
pub(crate) fn name(id: &str) -> String {
    let number = |digits: &str| digits.parse::<u32>().ok();
    if let Some(figure) = id.strip_prefix("fig").and_then(number) {
        return format!("Fig. {figure}");
    }
    match id.strip_prefix("table").and_then(number) {
        Some(1) => "Table I".to_owned(),
        Some(2) => "Table II".to_owned(),
        Some(3) => "Table III".to_owned(),
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
pub(crate) fn like(printed: &str, number: f64, digits: usize) -> String {
    if is_multiple_of_pi(printed) {
        format!("{}π", significant(number / std::f64::consts::PI, digits))
    } else {
        significant(number, digits)
    }
}

/// A number with so many significant digits, as one reads it.
pub(crate) fn significant(number: f64, digits: usize) -> String {
    if number == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{number:.*e}", digits.max(1) - 1);
    let Some((mantissa, exponent)) = scientific.split_once('e') else { return scientific };
    let exponent: i32 = exponent.parse().unwrap_or_default();
    let text = if (-4..=6).contains(&exponent) {
        let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or_default();
        shortened(&format!("{number:.decimals$}"))
    } else {
        format!("{} × 10{}", shortened(mantissa), superscript(exponent))
    };
    text.replace('-', "−")
}

/// Without zeros at the end of the decimals.
fn shortened(number: &str) -> String {
    if number.contains('.') {
        number.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        number.to_owned()
    }
}

fn superscript(number: i32) -> String {
    let raised = |c| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        '9' => '⁹',
        _ => '⁰',
    };
    number.to_string().chars().map(raised).collect()
}

fn duration(seconds: f64) -> String {
    if seconds < 1.0 {
        "less than a second".to_owned()
    } else if seconds < 100.0 {
        format!("{seconds:.1} s")
    } else {
        let whole = seconds.round() as u64;
        format!("{} min {} s", whole / 60, whole % 60)
    }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

fn escaped(text: &str) -> String {
    visible(text).chars().fold(String::with_capacity(text.len()), push_escaped)
}

fn push_escaped(mut page: String, letter: char) -> String {
    match letter {
        '&' => page.push_str("&amp;"),
        '<' => page.push_str("&lt;"),
        '>' => page.push_str("&gt;"),
        '"' => page.push_str("&quot;"),
        _ => page.push(letter),
    }
    page
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::provenance;

    #[test]
    fn numbers_are_readable() {
        assert_eq!(significant(0.486_003_078_3, 6), "0.486003");
        assert_eq!(significant(22.0, 6), "22");
        assert_eq!(significant(-1.234_567_89e-8, 6), "−1.23457 × 10⁻⁸");
        assert_eq!(significant(70_000.0, 6), "70000");
        assert_eq!(significant(0.0005, 2), "0.0005");
        assert_eq!(significant(999_999.96, 6), "1000000");
        assert_eq!(significant(0.0, 6), "0");
        assert_eq!(like("0.323π", 0.3225 * std::f64::consts::PI, 6), "0.3225π");
        assert_eq!(like("cos(0.26π)", 0.685_9, 6), "0.6859");
    }

    #[test]
    fn names_of_figures_and_tables() {
        assert_eq!(name("fig06"), "Fig. 6");
        assert_eq!(name("fig13"), "Fig. 13");
        assert_eq!(name("table3"), "Table III");
        assert_eq!(name("demo"), "demo");
    }

    #[test]
    fn what_is_beyond_the_paper_stands_behind_it_and_is_not_counted_with_it() {
        let section = |id: &str| Section {
            id: id.to_owned(),
            title: "A title".to_owned(),
            caption: String::new(),
            parameters: Vec::new(),
            claims: vec![Claim::expected(id, "this work", "speed", "rad/s", (2.0, 0.1), 2.05)],
            quality: Quality::Draft,
            run_time_s: 0.1,
            warnings: Vec::new(),
            outdated: false,
            has_table: false,
            width: None,
        };
        let page = |ids: &[&str]| {
            html(&provenance::new(provenance::GALLERY), &ids.iter().map(|id| section(id)).collect::<Vec<_>>())
        };
        let both = page(&["extra-fit", "fig06"]);
        let place = |text: &str| both.find(text).unwrap_or_else(|| panic!("{text} in {both}"));
        assert!(place("<section id=\"fig06\"") < place("<h2 id=\"beyond\""));
        assert!(place("<h2 id=\"beyond\"") < place("<section id=\"extra-fit\""));
        assert!(both.contains("1 figures and tables, and 1 <a href=\"#beyond\">beyond the paper</a>"));
        assert!(both.contains("Expected against computed") && both.contains("Printed against computed"));
        assert!(!page(&["fig06"]).contains("beyond"));
    }

    #[test]
    fn the_page_needs_nothing_from_outside() {
        let section = Section {
            id: "fig06".to_owned(),
            title: "A \"title\"".to_owned(),
            caption: "Γ < 1".to_owned(),
            parameters: vec![("ε".to_owned(), "0.5".to_owned())],
            claims: vec![Claim::number("fig06", "text", "Γ", "", "0.486", 0.486)],
            quality: Quality::Paper,
            run_time_s: 75.2,
            warnings: vec!["fig06.csv, line 2: \"<script>\u{202e}x\" is not a number".to_owned()],
            outdated: true,
            has_table: true,
            width: Some(2040),
        };
        let page = html(&provenance::new(provenance::GALLERY), &[section]);
        assert!(!page.contains("http") && !page.contains("<script"), "{page}");
        assert!(page.contains("Γ &lt; 1") && page.contains("fig06.csv") && page.contains("75.2 s"));
        assert!(page.contains("class=\"verdict reproduced\""));
        let head =
            "<meta name=\"provenance\" content=\"{&quot;program&quot;:&quot;bouncing-disk-experiments&quot;";
        assert!(page.contains(head), "{page}");
        assert!(
            page.contains(r"Measurements not shown: fig06.csv, line 2: &quot;&lt;script&gt;\u{202e}x&quot;")
        );
    }
}
