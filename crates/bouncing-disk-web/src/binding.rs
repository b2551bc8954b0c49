//! What JavaScript sees.

use wasm_bindgen::prelude::wasm_bindgen;

use crate::{Explorer as Answers, Reply as Answer};

/// Answers the requests of the page; it keeps the attractors of the last map.
#[wasm_bindgen]
#[derive(Debug, Default)]
pub struct Explorer(Answers);

#[wasm_bindgen]
impl Explorer {
    /// One that knows nothing yet.
    #[wasm_bindgen(constructor)]
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The answer to a request in JSON, in `page/src/protocol.ts`.
    pub fn respond(&mut self, request: &str) -> Reply {
        Reply(self.0.respond(request))
    }
}

/// An answer. JavaScript calls `free` when it has taken what it needs.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Reply(Answer);

#[wasm_bindgen]
impl Reply {
    /// What is short, or the refusal.
    #[wasm_bindgen(getter)]
    #[must_use]
    pub fn json(&self) -> String {
        self.0.json().to_owned()
    }

    /// Whether the request is refused.
    #[wasm_bindgen(getter)]
    #[must_use]
    pub fn refused(&self) -> bool {
        self.0.refused()
    }

    /// Sixteen hexadecimal digits of the answer.
    #[wasm_bindgen(getter)]
    #[must_use]
    pub fn digest(&self) -> String {
        self.0.digest().to_string()
    }

    /// The numbers, as a `Float64Array` of its own.
    #[must_use]
    pub fn numbers(&mut self) -> Vec<f64> {
        self.0.take_numbers()
    }

    /// The bytes, as a `Uint8Array` of its own.
    #[must_use]
    pub fn bytes(&mut self) -> Vec<u8> {
        self.0.take_bytes()
    }
}

/// The digests of results as JSON, for the tests; an error is a text that is none.
#[cfg(feature = "digests")]
#[allow(unreachable_pub, reason = "wasm-bindgen takes public functions alone")]
#[wasm_bindgen]
#[must_use]
pub fn digests() -> String {
    crate::digests().unwrap_or_else(|error| error.to_string())
}

/// What differs from the golden digests of the core.
#[cfg(feature = "digests")]
#[allow(unreachable_pub, reason = "wasm-bindgen takes public functions alone")]
#[wasm_bindgen]
#[must_use]
pub fn golden_differences() -> Vec<String> {
    crate::golden_differences()
}
