//! Answers.

use std::fmt;

use bouncing_disk::core::numerics::digest::Digest;
use serde::Serialize;

use crate::refusal::Refusal;

/// The answer to a request: JSON for what is short, flat arrays for what is long.
#[derive(Clone, PartialEq)]
pub struct Reply {
    json: String,
    numbers: Vec<f64>,
    bytes: Vec<u8>,
    refused: bool,
    digest: Digest,
}

impl fmt::Debug for Reply {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { json, numbers, bytes, refused, digest } = self;
        let (numbers, bytes) = (numbers.len(), bytes.len());
        write!(
            f,
            "Reply {{ refused: {refused}, numbers: {numbers}, bytes: {bytes}, digest: {digest}, {json} }}"
        )
    }
}

impl Reply {
    /// An answer of all three parts.
    pub(crate) fn new(json: &impl Serialize, numbers: Vec<f64>, bytes: Vec<u8>) -> Result<Self, Refusal> {
        let json = serde_json::to_string(json).map_err(|error| Refusal::of_request(&error))?;
        let mut digest = Digest::of(json.as_bytes());
        for number in &numbers {
            // Which of its many bit patterns a number that is none has depends on the processor.
            digest.number(if number.is_nan() { f64::NAN } else { *number });
        }
        digest.bytes(&bytes);
        Ok(Self { json, numbers, bytes, refused: false, digest })
    }

    /// An answer that is JSON alone.
    pub(crate) fn short(json: &impl Serialize) -> Result<Self, Refusal> {
        Self::new(json, Vec::new(), Vec::new())
    }

    /// The answer to a request that cannot be met.
    pub(crate) fn refusal(refusal: &Refusal) -> Self {
        // Texts and finite numbers can always be written.
        let json = serde_json::to_string(refusal).unwrap_or_default();
        let digest = Digest::of(json.as_bytes());
        Self { json, numbers: Vec::new(), bytes: Vec::new(), refused: true, digest }
    }

    /// What is short, or the refusal, as JSON.
    #[must_use]
    pub fn json(&self) -> &str {
        &self.json
    }

    /// Numbers, in rows; the columns are in `page/src/protocol.ts`.
    #[must_use]
    pub fn numbers(&self) -> &[f64] {
        &self.numbers
    }

    /// Labels, modes and kinds.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Whether the request is refused.
    #[must_use]
    pub const fn refused(&self) -> bool {
        self.refused
    }

    /// The digest of all of it, which is the same on every machine.
    #[must_use]
    pub const fn digest(&self) -> Digest {
        self.digest
    }

    /// The numbers, which are gone from here then.
    pub fn take_numbers(&mut self) -> Vec<f64> {
        std::mem::take(&mut self.numbers)
    }

    /// The bytes, which are gone from here then.
    pub fn take_bytes(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.bytes)
    }
}
