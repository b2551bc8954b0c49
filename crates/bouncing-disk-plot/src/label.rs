//! Labels: text with mathematics in a small subset of TeX.
//!
//! Between dollar signs, Latin and lower-case Greek letters are italic; upper-case Greek letters, digits and
//! operators are upright, as in the journal. `_` and `^` set scripts, `\dot` and `\ddot` accents. Two or more
//! Latin letters in a script form a word and are upright (`$\tau_{imp}$`), unless `\mathit` is used. Greek
//! letters may be written as such (`$τ_{imp}$`) or as commands.

use crate::error::DrawError;
use crate::font::{self, FontStyle};

/// The level of letters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Level {
    Base,
    Subscript,
    Superscript,
}

/// Letters of one shape at one height.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Span {
    pub(crate) text: String,
    pub(crate) style: FontStyle,
    pub(crate) level: Level,
}

/// The size of sub- and superscripts relative to the text.
pub(crate) const SCRIPT_SIZE: f64 = 0.7;

/// A label, parsed when it is made; faults are reported when the figure is written.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    source: String,
    spans: Vec<Span>,
    fault: Option<DrawError>,
}

impl Label {
    /// Reads text with mathematics between dollar signs: `r"speed $\dot{\alpha}_f$ (rad/s)"`.
    pub fn new(source: &str) -> Self {
        match parse(source) {
            Ok(spans) => Self { source: source.to_owned(), spans, fault: None },
            Err(fault) => Self { source: source.to_owned(), spans: Vec::new(), fault: Some(fault) },
        }
    }

    /// Text without any markup.
    pub fn plain(text: &str) -> Self {
        let span = Span { text: text.to_owned(), style: FontStyle::Roman, level: Level::Base };
        Self { source: text.to_owned(), spans: vec![span], fault: None }
    }

    pub(crate) fn source(&self) -> &str {
        &self.source
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.spans.iter().all(|span| span.text.is_empty()) && self.fault.is_none()
    }

    /// The spans, or what is wrong with the label.
    pub(crate) fn spans(&self) -> Result<&[Span], DrawError> {
        if let Some(fault) = &self.fault {
            return Err(fault.clone());
        }
        for span in &self.spans {
            if let Some(character) = span.text.chars().find(|c| font::advance(*c, span.style).is_none()) {
                return Err(DrawError::MissingGlyph { character, label: self.source.clone() });
            }
        }
        Ok(&self.spans)
    }

    /// The width at a font size.
    pub(crate) fn width(&self, size: f64) -> f64 {
        let mut width = 0.0;
        for span in &self.spans {
            let scale = if span.level == Level::Base { size } else { size * SCRIPT_SIZE };
            for character in span.text.chars() {
                width += scale * font::advance(character, span.style).unwrap_or(0.5);
            }
        }
        width
    }
}

impl From<&str> for Label {
    fn from(source: &str) -> Self {
        Self::new(source)
    }
}

impl From<String> for Label {
    fn from(source: String) -> Self {
        Self::new(&source)
    }
}

fn parse(source: &str) -> Result<Vec<Span>, DrawError> {
    let mut spans = Vec::new();
    let mut rest = source;
    for mathematics in [false, true].into_iter().cycle() {
        let end = dollar(rest);
        if mathematics && end.is_none() {
            return Err(malformed(source, "a dollar sign is not closed"));
        }
        let (part, after) = rest.split_at(end.unwrap_or(rest.len()));
        if mathematics {
            spans.extend(Parser { source, rest: part }.list(Level::Base, false)?);
        } else {
            push(&mut spans, &part.replace("\\$", "$"), FontStyle::Roman, Level::Base);
        }
        let Some(after) = after.strip_prefix('$') else { break };
        rest = after;
    }
    Ok(spans)
}

/// The first dollar sign that is not escaped.
fn dollar(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    (0..bytes.len()).find(|&at| bytes[at] == b'$' && (at == 0 || bytes[at - 1] != b'\\'))
}

fn malformed(label: &str, what: &'static str) -> DrawError {
    DrawError::MalformedLabel { what, label: label.to_owned() }
}

fn push(spans: &mut Vec<Span>, text: &str, style: FontStyle, level: Level) {
    if text.is_empty() {
        return;
    }
    match spans.last_mut() {
        Some(last) if last.style == style && last.level == level => last.text.push_str(text),
        _ => spans.push(Span { text: text.to_owned(), style, level }),
    }
}

struct Parser<'a> {
    source: &'a str,
    rest: &'a str,
}

impl Parser<'_> {
    fn next(&mut self) -> Option<char> {
        let character = self.rest.chars().next()?;
        self.rest = &self.rest[character.len_utf8()..];
        Some(character)
    }

    /// Everything up to the closing brace (if `in_group`) or the end.
    fn list(&mut self, level: Level, in_group: bool) -> Result<Vec<Span>, DrawError> {
        let mut spans = Vec::new();
        while let Some(character) = self.next() {
            match character {
                '}' if in_group => return Ok(spans),
                '}' => return Err(malformed(self.source, "a closing brace has no opening one")),
                _ => self.item(character, level, &mut spans)?,
            }
        }
        if in_group { Err(malformed(self.source, "a brace is not closed")) } else { Ok(spans) }
    }

    fn item(&mut self, character: char, level: Level, spans: &mut Vec<Span>) -> Result<(), DrawError> {
        match character {
            '{' => append(spans, self.list(level, true)?),
            '_' => append(spans, words_upright(self.argument(Level::Subscript)?)),
            '^' => append(spans, words_upright(self.argument(Level::Superscript)?)),
            '\\' => self.command(level, spans)?,
            '\'' => push(spans, "′", FontStyle::Roman, level),
            '-' => operator(spans, '−', level),
            ',' if level == Level::Base => push(spans, ",\u{2009}", FontStyle::Roman, level),
            c if c.is_whitespace() => {}
            c if is_operator(c) => operator(spans, c, level),
            c => push(spans, c.encode_utf8(&mut [0; 4]), letter_style(c), level),
        }
        Ok(())
    }

    /// One character, command or group.
    fn argument(&mut self, level: Level) -> Result<Vec<Span>, DrawError> {
        loop {
            match self.next() {
                None | Some('}') => return Err(malformed(self.source, "an argument is missing")),
                Some(c) if c.is_whitespace() => {}
                Some('{') => return self.list(level, true),
                Some(c) => {
                    let mut spans = Vec::new();
                    self.item(c, level, &mut spans)?;
                    return Ok(spans);
                }
            }
        }
    }

    /// The text of a group, spaces kept, commands not read.
    fn verbatim(&mut self) -> Result<String, DrawError> {
        let text = self.rest.trim_start().strip_prefix('{').and_then(|rest| rest.split_once('}'));
        let Some((text, rest)) = text else {
            return Err(malformed(self.source, "an argument is missing"));
        };
        self.rest = rest;
        Ok(text.to_owned())
    }

    fn command(&mut self, level: Level, spans: &mut Vec<Span>) -> Result<(), DrawError> {
        let length = self.rest.bytes().take_while(u8::is_ascii_alphabetic).count();
        let (name, rest) = self.rest.split_at(length);
        self.rest = rest;
        let accent = match name {
            "dot" => Some('\u{307}'),
            "ddot" => Some('\u{308}'),
            "hat" => Some('\u{302}'),
            "bar" => Some('\u{304}'),
            _ => None,
        };
        if let Some(accent) = accent {
            let mut accented = self.argument(level)?;
            let Some(first) = accented.first_mut() else {
                return Err(malformed(self.source, "an accent has no letter"));
            };
            let after = first.text.chars().next().map_or(0, char::len_utf8);
            first.text.insert(after, accent);
            append(spans, accented);
            return Ok(());
        }
        match name {
            "mathrm" | "text" | "mathit" => {
                let style = if name == "mathit" { FontStyle::Italic } else { FontStyle::Roman };
                let text = self.verbatim()?;
                push(spans, &text, style, level);
            }
            "" => match self.next() {
                Some(',') => push(spans, "\u{2009}", FontStyle::Roman, level),
                Some(' ' | ';') => push(spans, "\u{a0}", FontStyle::Roman, level),
                Some(c @ ('%' | '{' | '}' | '$' | '_')) => {
                    push(spans, c.encode_utf8(&mut [0; 4]), FontStyle::Roman, level);
                }
                other => {
                    let command = other.map_or(String::new(), String::from);
                    return Err(DrawError::UnknownCommand { command, label: self.source.to_owned() });
                }
            },
            _ => match symbol(name) {
                Some(c) if is_operator(c) => operator(spans, c, level),
                Some(c) => push(spans, c.encode_utf8(&mut [0; 4]), letter_style(c), level),
                None if is_function(name) => push(spans, name, FontStyle::Roman, level),
                None => {
                    let (command, label) = (name.to_owned(), self.source.to_owned());
                    return Err(DrawError::UnknownCommand { command, label });
                }
            },
        }
        Ok(())
    }
}

fn append(spans: &mut Vec<Span>, more: Vec<Span>) {
    for span in more {
        push(spans, &span.text, span.style, span.level);
    }
}

/// Italic runs of two or more Latin letters become upright: they are words, not products.
fn words_upright(mut spans: Vec<Span>) -> Vec<Span> {
    for span in &mut spans {
        let word = span.text.len() > 1 && span.text.bytes().all(|b| b.is_ascii_alphabetic());
        if word && span.style == FontStyle::Italic {
            span.style = FontStyle::Roman;
        }
    }
    spans
}

fn letter_style(character: char) -> FontStyle {
    let lower_greek = ('α'..='ω').contains(&character) || matches!(character, 'ϕ' | 'ϑ' | 'ϵ' | 'ϖ');
    if character.is_ascii_alphabetic() || lower_greek { FontStyle::Italic } else { FontStyle::Roman }
}

fn is_operator(character: char) -> bool {
    matches!(character, '=' | '<' | '>' | '+' | '−' | '±' | '×' | '·')
        || matches!(character, '≤' | '≥' | '≈' | '≠' | '∼' | '∝' | '→' | '≪' | '≫' | '∈')
}

/// An operator between two operands has spaces around it; a sign has none.
fn operator(spans: &mut Vec<Span>, character: char, level: Level) {
    let before =
        spans.iter().rev().find(|span| span.level == level).and_then(|span| span.text.chars().last());
    let sign = matches!(character, '+' | '−' | '±' | '∼' | '≈' | '<' | '>' | '→');
    let after_operand = !spans.is_empty()
        && !before.is_some_and(|c| {
            is_operator(c) || matches!(c, '(' | '[' | '{' | '/' | ',' | '\u{2009}' | '\u{a0}')
        });
    let spaced = level == Level::Base && (after_operand || !sign);
    let space = if spaced { "\u{a0}" } else { "" };
    let text = if character == '·' { "·".to_owned() } else { format!("{space}{character}{space}") };
    push(spans, &text, FontStyle::Roman, level);
}

fn is_function(name: &str) -> bool {
    matches!(
        name,
        "sin" | "cos" | "tan" | "ln" | "log" | "exp" | "max" | "min" | "arcsin" | "arccos" | "arctan"
    )
}

/// Names of characters, each before its character.
const SYMBOLS: &str = "
    alpha α beta β gamma γ delta δ epsilon ε varepsilon ε zeta ζ eta η theta θ kappa κ lambda λ mu μ nu ν xi ξ
    pi π rho ρ sigma σ tau τ phi ϕ varphi φ chi χ psi ψ omega ω
    Gamma Γ Delta Δ Theta Θ Lambda Λ Pi Π Sigma Σ Phi Φ Psi Ψ Omega Ω
    times × cdot · pm ± le ≤ leq ≤ ge ≥ geq ≥ approx ≈ sim ∼ ne ≠ neq ≠ propto ∝ ll ≪ gg ≫ to → rightarrow →
    infty ∞ partial ∂ degree ° prime ′ langle ⟨ rangle ⟩ ldots … dots …";

fn symbol(name: &str) -> Option<char> {
    let mut words = SYMBOLS.split_whitespace();
    words.find(|word| *word == name)?;
    words.next()?.chars().next()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spans(source: &str) -> Vec<(String, FontStyle, Level)> {
        let label = Label::new(source);
        let spans = label.spans().unwrap_or_else(|error| panic!("{error}"));
        spans.iter().map(|span| (span.text.clone(), span.style, span.level)).collect()
    }

    #[test]
    fn letters_scripts_and_accents() {
        use FontStyle::{Italic, Roman};
        use Level::{Base, Subscript, Superscript};
        assert_eq!(
            spans(r"$|\dot{\alpha}_f|$ (rad/s)"),
            [
                ("|".to_owned(), Roman, Base),
                ("α\u{307}".to_owned(), Italic, Base),
                ("f".to_owned(), Italic, Subscript),
                ("| (rad/s)".to_owned(), Roman, Base),
            ]
        );
        assert_eq!(spans("$τ_{imp}$")[1], ("imp".to_owned(), Roman, Subscript));
        assert_eq!(spans(r"$\Gamma_T$")[0], ("Γ".to_owned(), Roman, Base));
        assert_eq!(spans("$10^{-8}$")[1], ("−8".to_owned(), Roman, Superscript));
        assert_eq!(spans(r"$\theta = -\pi/4$")[1].0, "\u{a0}=\u{a0}−");
        assert_eq!(spans("$τ, w$")[1].0, ",\u{2009}");
        assert_eq!(spans(r"costs \$5")[0].0, "costs $5");
    }

    #[test]
    fn faults_are_reported_with_the_label() {
        for (source, part) in [
            (r"$\nosuch$", "\\nosuch"),
            ("$x", "dollar"),
            ("$x_{a$", "brace"),
            ("$x}$", "brace"),
            ("$x_$", "argument"),
            (r"$\dot{}$", "accent"),
            ("漢", "漢"),
        ] {
            let error = Label::new(source).spans().expect_err(source).to_string();
            assert!(error.contains(part) && error.contains(source), "{error}");
        }
    }

    #[test]
    fn scripts_are_narrower() {
        assert!(Label::new("$10^{-8}$").width(10.0) < Label::new("10−8").width(10.0));
    }
}
