//! Reads files in the browser slice by slice.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use maps::cube::{ReadAt, ScanFile};
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    /// Fills `into` from file number `file`, starting at byte `start`.
    #[wasm_bindgen(catch, js_namespace = globalThis, js_name = impastoSlice)]
    fn slice(file: u32, start: f64, into: &mut [u8]) -> Result<(), JsValue>;
}

/// A file of the worker, by its number.
#[derive(Debug)]
struct Slices {
    file: u32,
    bytes: u64,
}

impl ReadAt for Slices {
    fn bytes(&self) -> u64 {
        self.bytes
    }

    fn read_exact_at(&self, buffer: &mut [u8], position: u64) -> io::Result<()> {
        if position.saturating_add(buffer.len() as u64) > self.bytes {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        // A page's files are far below 2^53 bytes.
        slice(self.file, position as f64, buffer)
            .map_err(|reason| io::Error::other(reason.as_string().unwrap_or_default()))
    }
}

/// The worker's files, sorted by number.
pub(crate) fn scan_files(names: Vec<String>, sizes: &[f64]) -> Vec<ScanFile> {
    let files = names.into_iter().zip(sizes).zip(0..);
    files
        .map(|((name, bytes), file): ((String, &f64), u32)| ScanFile {
            name: PathBuf::from(name),
            contents: Arc::new(Slices { file, bytes: *bytes as u64 }),
        })
        .collect()
}
