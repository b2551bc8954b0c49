//! Answers, and refusals of requests that cannot be met.

use bouncing_disk::Error;
use bouncing_disk::core::Error as CoreError;
use bouncing_disk::core::numerics::digest::Digest;
use serde::Serialize;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen::prelude::wasm_bindgen;

/// The answer to a request: JSON for short data, flat arrays for long data.
#[cfg_attr(target_arch = "wasm32", wasm_bindgen(getter_with_clone))]
#[derive(Debug, Clone, PartialEq)]
pub struct Reply {
    /// What is short, or the refusal, as JSON.
    pub json: String,
    /// Numbers, in rows.
    pub numbers: Vec<f64>,
    /// Labels, modes and kinds.
    pub bytes: Vec<u8>,
    /// Whether the request is rejected.
    pub refused: bool,
    /// Sixteen hexadecimal digits of all of it, which are the same on every machine.
    pub digest: String,
}

impl Reply {
    pub(crate) fn new(json: &impl Serialize, numbers: Vec<f64>, bytes: Vec<u8>) -> Result<Self, Refusal> {
        let json = serde_json::to_string(json).map_err(|error| Refusal::of_request(&error))?;
        let mut digest = Digest::of(json.as_bytes());
        for number in &numbers {
            // Which of its many bit patterns NaN has depends on the processor.
            digest.number(if number.is_nan() { f64::NAN } else { *number });
        }
        digest.bytes(&bytes);
        Ok(Self { json, numbers, bytes, refused: false, digest: digest.to_string() })
    }

    pub(crate) fn short(json: &impl Serialize) -> Result<Self, Refusal> {
        Self::new(json, Vec::new(), Vec::new())
    }

    pub(crate) fn refusal(refusal: &Refusal) -> Self {
        // Texts and finite numbers can always be written.
        let json = serde_json::to_string(refusal).unwrap_or_default();
        let digest = Digest::of(json.as_bytes()).to_string();
        Self { json, numbers: Vec::new(), bytes: Vec::new(), refused: true, digest }
    }
}

/// Why a request cannot be met, for a form that shows it where the value is typed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Refusal {
    /// `out-of-range`, `computation`, `text` or `request`.
    kind: &'static str,
    quantity: Option<&'static str>,
    range: Option<&'static str>,
    message: String,
}

impl Refusal {
    pub(crate) const fn new(kind: &'static str, message: String) -> Self {
        Self { kind, quantity: None, range: None, message }
    }

    /// A text that is not a request.
    pub(crate) fn of_request(error: &serde_json::Error) -> Self {
        Self::new("request", format!("the request cannot be read: {error}"))
    }

    /// An illegal number of a request that the library does not check.
    pub(crate) fn out_of_range(field: &'static str, value: f64, legal: &'static str) -> Self {
        Error::OutOfRange { field, value, legal }.into()
    }
}

impl From<Error> for Refusal {
    fn from(error: Error) -> Self {
        let message = error.to_string();
        match error {
            Error::OutOfRange { field, legal, .. }
            | Error::Core(CoreError::OutOfRange { field, legal, .. }) => {
                Self { kind: "out-of-range", quantity: Some(field), range: Some(legal), message }
            }
            _ => Self::new("computation", message),
        }
    }
}

impl From<CoreError> for Refusal {
    fn from(error: CoreError) -> Self {
        Error::from(error).into()
    }
}
