//! Writes lines for whoever reads them.

use std::io::{self, Write as _};

/// Writes a line to standard output. A reader that has gone, as `head` does, is an error of its own kind,
/// which [`Failure`](crate::failure::Failure) tells from others.
pub(crate) fn say(text: &str) -> io::Result<()> {
    let mut to = io::stdout();
    to.write_all(format!("{}\n", text.trim_end()).as_bytes())?;
    to.flush()
}

/// Writes a line to standard error, in one call, so that lines of several threads do not mix. If it is
/// refused, nobody is left to read a message.
pub(crate) fn complain(text: &str) {
    let _ = io::stderr().write_all(format!("{text}\n").as_bytes());
}

/// A text from elsewhere (a key, a name of a file) on one line, with everything escaped that a terminal would
/// obey.
pub(crate) fn visible(text: &str) -> String {
    text.chars()
        .flat_map(|letter| if letter.is_control() { letter.escape_debug().collect() } else { vec![letter] })
        .collect()
}
