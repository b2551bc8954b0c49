//! What ends a command before its result is there, and the exit status that it gives.

use std::io;
use std::process::ExitCode;

use bouncing_disk::{FitError, MeasuredSpeedsError, StorageError};
use bouncing_disk_plot::DrawError;

use crate::interrupt;

/// Exit status of a computation that failed.
const FAILED: u8 = 1;
/// Exit status of a line or a file that cannot be used; clap has the same.
const USAGE: u8 = 2;

/// Why a command gives no result.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The command line or a file that it names is not legal: status 2.
    Usage(String),
    /// The computation failed, or the system refused: status 1.
    Failed(String),
    /// A signal stopped it: status 128 and the number of the signal, 130 for Ctrl-C. The text says what is
    /// kept and how to go on.
    Interrupted(String),
    /// Whoever read the output has gone, as `head` does: nobody is left to be told anything, and that is no
    /// error.
    NobodyReads,
}

impl Failure {
    /// A fault of the command line.
    pub(crate) fn usage(text: impl Into<String>) -> Self {
        Self::Usage(text.into())
    }

    /// A fault of the computation.
    pub(crate) fn failed(text: impl Into<String>) -> Self {
        Self::Failed(text.into())
    }

    /// The same with words before it: the file that it is about.
    pub(crate) fn in_context(self, context: &str) -> Self {
        let with = |text: String| format!("{context}: {text}");
        match self {
            Self::Usage(text) => Self::Usage(with(text)),
            Self::Failed(text) => Self::Failed(with(text)),
            other => other,
        }
    }

    /// What the user is told, if anything.
    pub(crate) fn text(&self) -> Option<&str> {
        match self {
            Self::Usage(text) | Self::Failed(text) | Self::Interrupted(text) => Some(text),
            Self::NobodyReads => None,
        }
    }

    /// The exit status.
    pub(crate) fn exit_code(&self) -> ExitCode {
        match self {
            Self::Usage(_) => ExitCode::from(USAGE),
            Self::Failed(_) => ExitCode::from(FAILED),
            Self::Interrupted(_) => ExitCode::from(interrupt::exit_status()),
            Self::NobodyReads => ExitCode::SUCCESS,
        }
    }
}

/// A text with all that caused it.
fn with_causes(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        let own = error.to_string();
        // A transparent error has the text of its cause.
        if !text.ends_with(&own) {
            text = format!("{text}: {own}");
        }
        cause = error.source();
    }
    text
}

impl From<bouncing_disk::core::Error> for Failure {
    fn from(error: bouncing_disk::core::Error) -> Self {
        use bouncing_disk::core::Error;
        match error {
            Error::OutOfRange { .. } | Error::TooLarge { .. } => Self::Usage(error.to_string()),
            Error::Stopped { done, total } => {
                Self::Interrupted(format!("interrupted: {}", part(done, total)))
            }
            _ => Self::Failed(error.to_string()),
        }
    }
}

/// How far a call was. Some count in work that has no name for a user.
fn part(done: u64, total: u64) -> String {
    let share = if total == 0 { 0.0 } else { 100.0 * done as f64 / total as f64 };
    format!("{share:.0} % were done, and nothing is written")
}

impl From<bouncing_disk::Error> for Failure {
    fn from(error: bouncing_disk::Error) -> Self {
        use bouncing_disk::Error;
        match error {
            Error::Core(core) => core.into(),
            Error::OutOfRange { .. }
            | Error::NotGiven { .. }
            | Error::NeitherGiven { .. }
            | Error::BothGiven { .. }
            | Error::EmptyAxis { .. }
            | Error::RepeatedAxis { .. } => Self::Usage(error.to_string()),
            _ => Self::Failed(error.to_string()),
        }
    }
}

impl From<FitError> for Failure {
    fn from(error: FitError) -> Self {
        match error {
            FitError::Model(error) => error.into(),
            refused => Self::Failed(refused.to_string()),
        }
    }
}

impl From<StorageError> for Failure {
    fn from(error: StorageError) -> Self {
        match error {
            StorageError::Model(error) => error.into(),
            // A journal that is locked now may be free later: the line is not at fault.
            StorageError::Io { .. } | StorageError::NotStorable { .. } | StorageError::Busy { .. } => {
                Self::Failed(with_causes(&error))
            }
            _ => Self::Usage(with_causes(&error)),
        }
    }
}

impl From<MeasuredSpeedsError> for Failure {
    fn from(error: MeasuredSpeedsError) -> Self {
        Self::Usage(with_causes(&error))
    }
}

impl From<DrawError> for Failure {
    fn from(error: DrawError) -> Self {
        Self::Failed(format!("the picture cannot be drawn: {}", with_causes(&error)))
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::NobodyReads,
            _ => Self::Failed(with_causes(&error)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_input_is_told_from_a_failed_computation() {
        let range = bouncing_disk::Error::OutOfRange { field: "friction", value: -1.0, legal: "[0, inf)" };
        assert!(matches!(Failure::from(range), Failure::Usage(_)));
        let weak = bouncing_disk::Error::NeverLeaves { peak_acceleration: 0.5 };
        assert!(matches!(Failure::from(weak), Failure::Failed(_)));
        let stopped = bouncing_disk::core::Error::Stopped { done: 1, total: 4 };
        let Failure::Interrupted(text) = Failure::from(bouncing_disk::Error::Core(stopped)) else { panic!() };
        assert_eq!(text, "interrupted: 25 % were done, and nothing is written");
    }

    #[test]
    fn a_reader_that_has_gone_is_no_failure() {
        let gone = Failure::from(io::Error::from(io::ErrorKind::BrokenPipe));
        assert!(matches!(gone, Failure::NobodyReads));
        assert_eq!(gone.text(), None);
        let full = Failure::from(io::Error::from(io::ErrorKind::StorageFull));
        assert!(matches!(full, Failure::Failed(_)));
    }

    #[test]
    fn a_context_names_the_file() {
        let failure = Failure::usage("no number").in_context("a.toml");
        assert_eq!(failure.text(), Some("a.toml: no number"));
    }
}
