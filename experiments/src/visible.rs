//! Shows texts of somebody else's, such as fields of a file and names of folders, in messages.
//!
//! A control character that reaches a terminal moves its cursor or changes its title; one that orders text
//! from right to left makes a message read as something else; five megabytes hide it. None of them may pass.

use std::fmt;
use std::path::Path;

/// How many characters of a text a message shows.
const SHOWN: usize = 40;

/// The beginning of a text of somebody else's.
///
/// [`Display`](fmt::Display) shows it in double quotes, with everything escaped that is not visible, and says
/// how long the whole text is where it is not shown: `"aaaa…" (5000000 characters)`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excerpt {
    start: String,
    characters: usize,
}

impl Excerpt {
    /// The beginning of `text`.
    pub fn of(text: &str) -> Self {
        Self { start: text.chars().take(SHOWN).collect(), characters: text.chars().count() }
    }

    /// As [`Display`](fmt::Display), but without the quotes: for what is known to be a number.
    pub fn bare(&self) -> String {
        let mut text = self.escaped();
        if self.is_cut() {
            text.push_str(&format!("… ({} characters)", self.characters));
        }
        text
    }

    fn is_cut(&self) -> bool {
        self.characters > SHOWN
    }

    fn escaped(&self) -> String {
        // Quotes and backslashes, too, so that the quotes around it are the only ones.
        let quotable = |c| matches!(c, '"' | '\\') || is_invisible(c);
        self.start.chars().fold(String::new(), |text, c| push(text, c, quotable(c)))
    }
}

impl fmt::Display for Excerpt {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_cut() {
            write!(formatter, "\"{}…\" ({} characters)", self.escaped(), self.characters)
        } else {
            write!(formatter, "\"{}\"", self.escaped())
        }
    }
}

/// The whole text with every character escaped that does something instead of being seen, line ends included.
pub fn visible(text: &str) -> String {
    text.chars().fold(String::with_capacity(text.len()), |text, c| push(text, c, is_invisible(c)))
}

/// A path for a message.
pub fn visible_path(path: &Path) -> String {
    visible(&path.to_string_lossy())
}

fn push(mut text: String, c: char, escape: bool) -> String {
    if escape {
        text.extend(c.escape_default());
    } else {
        text.push(c);
    }
    text
}

/// Control characters, line and paragraph separators, and what changes the order of letters or has no width.
/// Combining marks stay: captions need them.
fn is_invisible(c: char) -> bool {
    c.is_control()
        || matches!(c,
            '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_seen_is_escaped_and_letters_stay() {
        let title = "\u{1b}]0;mine\u{7}";
        assert_eq!(Excerpt::of(title).to_string(), r#""\u{1b}]0;mine\u{7}""#);
        assert_eq!(Excerpt::of("a\"\\\r\n\t\0").to_string(), r#""a\"\\\r\n\t\u{0}""#);
        // Right to left, C1 and no width.
        assert_eq!(
            visible("\u{202e}1\u{2066}\u{9b}\u{feff}\u{200b}"),
            r"\u{202e}1\u{2066}\u{9b}\u{feff}\u{200b}"
        );
        assert_eq!(visible("α̇ = 5\u{a0}µm, 'é'"), "α̇ = 5\u{a0}µm, 'é'");
        assert_eq!(visible_path(Path::new("a\nb")), r"a\nb");
    }

    #[test]
    fn a_long_text_is_cut_and_counted() {
        let exact = "x".repeat(SHOWN);
        assert_eq!(Excerpt::of(&exact).to_string(), format!("\"{exact}\""));
        let long = Excerpt::of(&"é".repeat(5_000_000));
        assert_eq!(long.to_string(), format!("\"{}…\" (5000000 characters)", "é".repeat(SHOWN)));
        assert_eq!(long.bare(), format!("{}… (5000000 characters)", "é".repeat(SHOWN)));
    }
}
