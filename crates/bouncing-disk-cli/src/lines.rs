//! Lines on standard output and standard error.

use std::io::{self, Write as _};

/// Writes a line to standard output. A reader that has closed it, as `head` does, is a
/// [`Failure`](crate::failure::Failure) of its own kind.
pub(crate) fn say(text: &str) -> io::Result<()> {
    let mut to = io::stdout();
    to.write_all(format!("{}\n", text.trim_end()).as_bytes())?;
    to.flush()
}

/// Writes a line to standard error, in one call, so that lines of several threads do not mix. A failure
/// is ignored, as nobody is left to read a message.
pub(crate) fn complain(text: &str) {
    let _ = io::stderr().write_all(format!("{text}\n").as_bytes());
}
