//! Requests that cannot be met.

use bouncing_disk::core::Error as CoreError;
use bouncing_disk::{Error, MotorFileError};
use serde::Serialize;

/// Why a request cannot be met, for a form that shows it where the value is typed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Refusal {
    /// `out-of-range`, `computation`, `text` or `request`.
    kind: &'static str,
    quantity: Option<&'static str>,
    value: Option<f64>,
    range: Option<&'static str>,
    message: String,
}

impl Refusal {
    const fn new(kind: &'static str, message: String) -> Self {
        Self { kind, quantity: None, value: None, range: None, message }
    }

    /// A request that is none.
    pub(crate) fn of_request(error: &serde_json::Error) -> Self {
        Self::new("request", format!("the request cannot be read: {error}"))
    }

    /// A computation that has no result.
    pub(crate) fn computation(error: &dyn std::error::Error) -> Self {
        Self::new("computation", error.to_string())
    }

    /// A number of a request that no value of the library would refuse.
    pub(crate) fn out_of_range(field: &'static str, value: f64, legal: &'static str) -> Self {
        Error::OutOfRange { field, value, legal }.into()
    }
}

impl From<Error> for Refusal {
    fn from(error: Error) -> Self {
        let message = error.to_string();
        match error {
            Error::OutOfRange { field, value, legal }
            | Error::Core(CoreError::OutOfRange { field, value, legal }) => Self {
                kind: "out-of-range",
                quantity: Some(field),
                // JSON has no infinity; the message has it.
                value: Some(value).filter(|value| value.is_finite()),
                range: Some(legal),
                message,
            },
            _ => Self::new("computation", message),
        }
    }
}

impl From<CoreError> for Refusal {
    fn from(error: CoreError) -> Self {
        Error::from(error).into()
    }
}

impl From<MotorFileError> for Refusal {
    fn from(error: MotorFileError) -> Self {
        match error {
            MotorFileError::Illegal(error) => error.into(),
            _ => Self::new("text", error.to_string()),
        }
    }
}
