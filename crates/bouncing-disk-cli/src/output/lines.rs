//! Writes lines to whoever reads them.

use std::fmt::Arguments;
use std::io::{self, Write};

/// Writes a text and a line end. A reader that has gone, as `head` does, is an error of its own kind, which
/// [`Failure`](crate::failure::Failure) tells from others.
pub(crate) fn line(mut to: impl Write, text: Arguments<'_>) -> io::Result<()> {
    // One call, so that lines of several threads do not mix.
    to.write_all(format!("{text}\n").as_bytes())?;
    to.flush()
}

/// As `println!`, but without its panic: gives the result of [`line()`].
macro_rules! say {
    ($($text:tt)*) => { $crate::output::lines::line(std::io::stdout(), format_args!($($text)*)) };
}

/// As `eprintln!`, but without its panic. A standard error that refuses a line leaves nobody to be told.
macro_rules! complain {
    ($($text:tt)*) => {{ let _ = $crate::output::lines::line(std::io::stderr(), format_args!($($text)*)); }};
}

pub(crate) use {complain, say};

/// A text from elsewhere (a key, a name of a file) on one line, with everything escaped that a terminal would
/// obey.
pub(crate) fn visible(text: &str) -> String {
    text.chars()
        .flat_map(|letter| if letter.is_control() { letter.escape_debug().collect() } else { vec![letter] })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_terminal_is_told_nothing_but_text() {
        assert_eq!(visible("α\u{1b}[2J\n"), "α\\u{1b}[2J\\n");
    }

    #[test]
    fn a_line_ends() {
        let mut text = Vec::new();
        line(&mut text, format_args!("{} of {}", 1, 2)).unwrap();
        assert_eq!(text, b"1 of 2\n");
    }
}
