//! Writes the JavaScript for the native part of a page. This is the command of wasm-bindgen as a
//! crate of this workspace: so you need not install it, and its version comes from the lock file.

use std::path::Path;

use anyhow::{Context, bail};
use wasm_bindgen_cli_support::Bindgen;

fn main() -> anyhow::Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [input, folder] = words.as_slice() else {
        bail!("two paths are wanted, of the module and of the folder to write, found {words:?}");
    };
    let mut bindgen = Bindgen::new();
    bindgen.input_path(input).web(true)?.typescript(false);
    bindgen.remove_name_section(true).remove_producers_section(true);
    bindgen.generate(Path::new(folder)).with_context(|| format!("module {input}"))
}
