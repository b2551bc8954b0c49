//! Makes texts from outside, such as fields of a file and names of folders, visible in messages.
//!
//! A control character that reaches a terminal moves its cursor or changes its title; one that orders text
//! from right to left makes a message read as something else; five megabytes hide it. None of them may pass.

use std::path::Path;

/// How many characters of a text a message shows.
const SHOWN: usize = 40;

/// The beginning of a text in double quotes, with everything escaped that is not visible, and the length of
/// the text where not all of it is shown: `"aaaa…" (5000000 characters)`.
pub fn excerpt(text: &str) -> String {
    // Quotes and backslashes, too, so that the quotes around it are the only ones.
    let quotable = |c| matches!(c, '"' | '\\') || is_invisible(c);
    let start = escaped(text.chars().take(SHOWN), quotable);
    match text.chars().count() {
        characters if characters > SHOWN => format!("\"{start}…\" ({characters} characters)"),
        _ => format!("\"{start}\""),
    }
}

/// The whole text with every character escaped that does something instead of being seen, line ends included.
pub fn visible(text: &str) -> String {
    escaped(text.chars(), is_invisible)
}

/// A path for a message.
pub fn visible_path(path: &Path) -> String {
    visible(&path.to_string_lossy())
}

fn escaped(letters: impl Iterator<Item = char>, escape: impl Fn(char) -> bool) -> String {
    let mut text = String::new();
    for c in letters {
        if escape(c) { text.extend(c.escape_default()) } else { text.push(c) }
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
    fn what_is_not_seen_is_escaped_and_what_is_long_is_cut_and_counted() {
        assert_eq!(excerpt("\u{1b}]0;mine\u{7}"), r#""\u{1b}]0;mine\u{7}""#);
        assert_eq!(excerpt("a\"\\\r\n\t\0"), r#""a\"\\\r\n\t\u{0}""#);
        // Right to left, C1 and no width.
        let invisible = "\u{202e}1\u{2066}\u{9b}\u{feff}\u{200b}";
        assert_eq!(visible(invisible), r"\u{202e}1\u{2066}\u{9b}\u{feff}\u{200b}");
        assert_eq!(visible("α̇ = 5\u{a0}µm, 'é'"), "α̇ = 5\u{a0}µm, 'é'");
        assert_eq!(visible_path(Path::new("a\nb")), r"a\nb");
        let exact = "x".repeat(SHOWN);
        assert_eq!(excerpt(&exact), format!("\"{exact}\""));
        let long = "é".repeat(5_000_000);
        assert_eq!(excerpt(&long), format!("\"{}…\" (5000000 characters)", "é".repeat(SHOWN)));
    }
}
