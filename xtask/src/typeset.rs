//! The Markdown of the report as a document of Typst.

use anyhow::{Result, bail};
use pulldown_cmark::{CodeBlockKind, Event, HeadingLevel, Options, Parser, Tag, TagEnd};

/// Sizes, fonts and tables.
const HEAD: &str = include_str!("report.typ");
/// A column with no longer cell (characters) is as wide as its cells; the others share the rest of the line.
const NARROW: usize = 18;

/// The document, and the pictures that it shows. A quotation is a line of mathematics, which Typst sets: it is written
/// so that both read it. It refuses what the report does not need.
pub(crate) fn typst(markdown: &str) -> Result<(String, Vec<String>)> {
    let (mut text, mut pictures) = (HEAD.to_owned(), Vec::new());
    // The longest cell of each column (characters), the column of the current cell, and its length.
    let (mut widths, mut column, mut length) = (Vec::<usize>::new(), 0, 0);
    let (mut in_formula, mut in_picture) = (false, false);
    // A picture stands alone, and the next paragraph is its caption.
    let mut until_captioned = 0;
    let mut paragraph = 0;
    let mut code: Option<String> = None;
    for event in Parser::new_ext(markdown, Options::ENABLE_TABLES) {
        if let Event::Text(own) | Event::Code(own) = &event {
            length += own.chars().count();
        }
        match event {
            Event::End(TagEnd::Image) => in_picture = false,
            // The alternative text.
            _ if in_picture => {}
            Event::Text(own) if code.is_some() => code.iter_mut().for_each(|code| code.push_str(&own)),
            Event::Text(own) if in_formula => text.push_str(&own.replace("; ", " quad ")),
            Event::Text(own) => push_plain(&mut text, &own),
            Event::Code(own) => text.push_str(&format!("#raw({:?});", &*own)),
            Event::SoftBreak => text.push(' '),
            Event::Start(Tag::Heading { level, .. }) => {
                text.push_str(&format!("{} ", "=".repeat(depth(level))))
            }
            Event::Start(Tag::Emphasis) => text.push_str("#emph["),
            Event::Start(Tag::Strong) => text.push_str("#strong["),
            // Other pages of the book are not at hand.
            Event::Start(Tag::Link { dest_url, .. }) if !dest_url.contains("://") => text.push_str("#emph["),
            Event::Start(Tag::Link { dest_url, .. }) => text.push_str(&format!("#link({:?})[", &*dest_url)),
            Event::End(TagEnd::Emphasis | TagEnd::Strong | TagEnd::Link) => text.push_str("];"),
            Event::Start(Tag::Image { dest_url, .. }) => {
                text.push_str(&format!("#picture({:?})[", format!("/{dest_url}")));
                pictures.push(dest_url.into_string());
                (in_picture, until_captioned) = (true, 2);
            }
            Event::Start(Tag::List(first)) => {
                text.push_str(if first.is_some() { "#enum(" } else { "#list(" });
            }
            Event::Start(Tag::Item) => text.push('['),
            Event::End(TagEnd::Item) => text.push_str("],"),
            Event::End(TagEnd::List(_)) => text.push_str(")\n\n"),
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(_))) => code = Some(String::new()),
            Event::End(TagEnd::CodeBlock) => {
                let code = code.take().unwrap_or_default();
                text.push_str(&format!("#raw(block: true, {:?})\n\n", code.trim_end()));
            }
            Event::Start(Tag::BlockQuote(_)) => {
                text.push_str("$ ");
                in_formula = true;
            }
            Event::End(TagEnd::BlockQuote(_)) => {
                text.push_str("$\n\n");
                in_formula = false;
            }
            Event::Start(Tag::Paragraph) => paragraph = text.len(),
            Event::Start(Tag::TableRow) => {}
            Event::End(TagEnd::Paragraph) if in_formula => text.push(' '),
            Event::End(TagEnd::Paragraph) => {
                // It stays with the table that it announces.
                if text[paragraph..].trim_end_matches([']', ';']).ends_with(':') {
                    text.insert_str(paragraph, "#block(sticky: true)[");
                    text.push(']');
                }
                text.push_str(["\n\n", "]\n\n", ""][until_captioned]);
                until_captioned = until_captioned.saturating_sub(1);
            }
            Event::End(TagEnd::Heading(_)) => text.push_str("\n\n"),
            Event::Start(Tag::Table(columns)) => {
                widths = vec![0; columns.len()];
                text.push_str("#rows(COLUMNS");
            }
            Event::Start(Tag::TableHead) => {
                text.push_str(", table.header(");
                column = 0;
            }
            Event::Start(Tag::TableCell) => {
                text.push('[');
                length = 0;
            }
            Event::End(TagEnd::TableCell) => {
                if let Some(longest) = widths.get_mut(column) {
                    *longest = (*longest).max(length);
                }
                column += 1;
                text.push_str("], ");
            }
            Event::End(TagEnd::TableHead) => {
                text.push_str("table.hline(stroke: 0.4pt)), ");
                column = 0;
            }
            Event::End(TagEnd::TableRow) => {
                text.push('\n');
                column = 0;
            }
            Event::End(TagEnd::Table) => {
                text = text.replace(
                    "COLUMNS",
                    &format!("({})", widths.iter().map(|own| width(*own)).collect::<String>()),
                );
                text.push_str(")\n\n");
            }
            other => bail!("the report has {other:?}, which is not set"),
        }
    }
    Ok((text, pictures))
}

fn depth(level: HeadingLevel) -> usize {
    level as usize
}

/// Long columns share a line by the square root of their cells: a long cell may take several lines.
fn width(longest: usize) -> String {
    if longest <= NARROW { "auto, ".to_owned() } else { format!("{}fr, ", longest.isqrt()) }
}

/// Text without any mark of Typst but an index: `a_e` of the Markdown.
fn push_plain(text: &mut String, own: &str) {
    // A raised digit is a power.
    let in_index = |own: &char| own.is_alphabetic() || own.is_ascii_digit();
    let mut letters = own.chars().peekable();
    let mut before = ' ';
    while let Some(letter) = letters.next() {
        let is_index = letter == '_' && !before.is_whitespace() && letters.peek().is_some_and(in_index);
        if is_index {
            text.push_str("#sub[");
            while let Some(index) = letters.next_if(in_index) {
                text.push(index);
            }
            text.push_str("];");
        } else {
            // Quotation marks are set as such.
            if letter.is_ascii_punctuation() && !"\"',;:()!?".contains(letter) {
                text.push('\\');
            }
            text.push(letter);
        }
        before = letter;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_report_needs_is_set_and_all_else_is_refused() {
        let set = |markdown: &str| typst(markdown).map(|(text, pictures)| (text.replace(HEAD, ""), pictures));
        for (markdown, own) in [
            (
                "## A_b #1\n\nα̇_ss/t_c *is* **`a\"b`** [here](x.md) [there](https://x.y)",
                "== A#sub[b]; \\#1\n\nα̇#sub[ss];\\/t#sub[c]; #emph[is]; #strong[#raw(\"a\\\"b\");]; #emph[here]; #link(\"https://x.y\")[there];\n\n",
            ),
            ("> s(t) = A sin(ω t); a_g^2", "$ s(t) = A sin(ω t) quad a_g^2 $\n\n"),
            ("Answers, **all:**", "#block(sticky: true)[Answers, #strong[all:];]\n\n"),
            ("1. one\n2. two", "#enum([one],[two],)\n\n"),
            ("```sh\ncargo\n```", "#raw(block: true, \"cargo\")\n\n"),
            (
                "| a | b |\n| --- | --- |\n| 1 | twenty-five letters or so |",
                "#rows((auto, 5fr, ), table.header([a], [b], table.hline(stroke: 0.4pt)), [1], [twenty\\-five letters or so], \n)\n\n",
            ),
        ] {
            assert_eq!(set(markdown).expect(markdown).0, own);
        }
        let (text, pictures) = set("![a *b*](figures/c.png)\n\nd_2²\n\ne").expect("set");
        assert_eq!(text, "#picture(\"/figures/c.png\")[d#sub[2];²]\n\ne\n\n");
        assert_eq!(pictures, ["figures/c.png"]);
        for other in ["<b>bold</b>", "a\\\nb", "---"] {
            set(other).expect_err(other);
        }
    }
}
