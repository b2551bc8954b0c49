//! Writes lines to whoever reads them.

use std::fmt::Arguments;
use std::io::{self, ErrorKind, Write};

/// Writes a line, or several. A reader that has gone, as `head` does, wanted no more: that is no error.
///
/// # Errors
///
/// Other errors of the system, such as a full disk.
pub(crate) fn line(mut to: impl Write, text: Arguments<'_>) -> io::Result<()> {
    // One call, so that lines of several threads do not mix.
    match to.write_all(format!("{text}\n").as_bytes()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}

/// As `println!`, but without its panic: gives the result of [`line()`].
macro_rules! say {
    ($($text:tt)*) => { $crate::output::line(std::io::stdout(), format_args!($($text)*)) };
}

/// As `eprintln!`, but without its panic. If standard error is closed, nobody is left to inform.
macro_rules! complain {
    ($($text:tt)*) => {{ let _ = $crate::output::line(std::io::stderr(), format_args!($($text)*)); }};
}

pub(crate) use {complain, say};

#[cfg(test)]
mod tests {
    use super::*;

    struct Refusing(ErrorKind);

    impl Write for Refusing {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(self.0.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_reader_that_has_gone_is_no_error_and_a_full_disk_is() {
        assert!(line(Refusing(ErrorKind::BrokenPipe), format_args!("unread")).is_ok());
        let full = line(Refusing(ErrorKind::StorageFull), format_args!("unwritten"));
        assert_eq!(full.expect_err("refused").kind(), ErrorKind::StorageFull);
    }
}
