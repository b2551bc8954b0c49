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
