//! The failures that end a command before its result is there, and their exit statuses.

use std::fmt::Display;
use std::io;
use std::path::Path;
use std::process::ExitCode;

use bouncing_disk::estimate::{FitError, MeasuredSpeedsError};
use bouncing_disk::store::StorageError;
use bouncing_disk_plot::DrawError;

use crate::interrupt;
use crate::lines::complain;

pub(crate) type Result<T, E = Failure> = std::result::Result<T, E>;

/// Why a command has no result.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The command line or a file that it names is not legal: status 2, as in clap.
    Usage(String),
    /// The computation failed, or the system returned an error: status 1.
    Failed(String),
    /// A signal stopped it: status 128 and the number of the signal, 130 for Ctrl-C. The text says which
    /// rows are kept, and how to resume.
    Interrupted(String),
    /// The reader of the output has closed it, as `head` does. Nobody is left to read a message, and this is not an
    /// error.
    NobodyReads,
}

impl Failure {
    /// Prints the message on standard error, and returns the exit status.
    pub(crate) fn tell(self) -> ExitCode {
        let (text, status) = match self {
            Self::NobodyReads => return ExitCode::SUCCESS,
            Self::Failed(text) => (format!("error: {text}"), 1),
            Self::Usage(text) => (format!("error: {text}"), 2),
            Self::Interrupted(text) => (format!("bouncing-disk: {text}"), interrupt::exit_status()),
        };
        complain(&text);
        ExitCode::from(status)
    }
}

/// The failure of a file that cannot be read, in the same form for all commands.
pub(crate) fn unreadable(path: &Path, why: impl Display) -> Failure {
    Failure::Usage(format!("{} cannot be read: {why}", path.display()))
}

/// The failure of a file of measured speeds or points that contains none.
pub(crate) fn unmeasured(path: &Path, error: MeasuredSpeedsError) -> Failure {
    match error {
        MeasuredSpeedsError::Unreadable { source, .. } => unreadable(path, source),
        error => Failure::Usage(with_causes(error)),
    }
}

/// The text of an error with its causes.
pub(crate) fn with_causes(error: impl std::error::Error + Send + Sync + 'static) -> String {
    format!("{:#}", anyhow::Error::new(error))
}

impl From<bouncing_disk::core::Error> for Failure {
    fn from(error: bouncing_disk::core::Error) -> Self {
        use bouncing_disk::core::Error;
        match error {
            Error::OutOfRange { .. } | Error::TooLarge { .. } | Error::NotOfKind { .. } => {
                Self::Usage(error.to_string())
            }
            // Some calls count units of work that mean nothing to a user.
            Error::Stopped { done, total } => {
                let share = if total == 0 { 0.0 } else { 100.0 * done as f64 / total as f64 };
                Self::Interrupted(format!("interrupted at {share:.0} %; nothing is written"))
            }
            _ => Self::Failed(error.to_string()),
        }
    }
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
            | Error::Lengths { .. }
            | Error::NoForcePerVolt { .. }
            | Error::SwitchedMotion
            | Error::EmptyAxis { .. }
            | Error::RepeatedAxis { .. }
            | Error::Waveform { .. }
            | Error::WaveformJump { .. }
            | Error::DriveNotSine
            | Error::SoftContact
            | Error::YieldingStator
            | Error::LoadLaw
            | Error::LoadInTime
            | Error::NoSuchNumber
            | Error::StartPhase => Self::Usage(error.to_string()),
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
                Self::Failed(with_causes(error))
            }
            _ => Self::Usage(with_causes(error)),
        }
    }
}

impl From<DrawError> for Failure {
    fn from(error: DrawError) -> Self {
        Self::Failed(format!("the picture cannot be drawn: {}", with_causes(error)))
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::NobodyReads,
            _ => Self::Failed(with_causes(error)),
        }
    }
}
