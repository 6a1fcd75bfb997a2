//! Plays strokes in WebAssembly, so that tests can compare the paint with what the program paints.

#[path = "../../../../render/paint/examples/replay_digest/replayed.rs"]
mod replayed;

use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// Digest of the paint after the first `actions` of a script of strokes.
///
/// # Errors
/// A `JsError` if the script cannot be read or played.
#[wasm_bindgen]
pub fn digest(script: &[u8], actions: usize) -> Result<String, JsError> {
    replayed::digest(script, actions).map_err(|error| JsError::new(&error.to_string()))
}
