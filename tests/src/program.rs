//! The program `impasto`, run in process.

use std::path::PathBuf;

/// What a run gave.
#[derive(Debug)]
pub struct Run {
    /// Its exit status.
    pub status: u8,
    /// Its results.
    pub out: String,
    /// Its remarks and errors.
    pub err: String,
}

impl Run {
    /// The results as JSON.
    ///
    /// # Panics
    /// If they are none.
    #[must_use]
    pub fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.out)
            .unwrap_or_else(|error| panic!("{error}: {}\n{}", self.out, self.err))
    }
}

/// Runs `impasto` with `arguments`.
#[must_use]
pub fn impasto(arguments: &[&str]) -> Run {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let all = std::iter::once("impasto").chain(arguments.iter().copied());
    let status = impasto::run(all, &mut out, &mut err, impasto::Screen::default());
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("the program writes UTF-8");
    Run { status, out: text(out), err: text(err) }
}

/// A file of the repository, as a path from anywhere.
#[must_use]
pub fn repository(file: &str) -> String {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..");
    root.join(file).display().to_string()
}
