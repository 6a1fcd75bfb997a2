//! Files as the page passes them.

use js_sys::{Array, JsString, Uint8Array};

/// Names and contents of files.
pub(crate) fn files(
    names: &Array<JsString>,
    contents: &Array<Uint8Array>,
) -> Vec<(String, Vec<u8>)> {
    let names = names.iter().map(String::from);
    names.zip(contents.iter().map(|bytes| bytes.to_vec())).collect()
}
