//! Runs of the program `impasto` in process, with captured output.

use std::path::PathBuf;

/// Exit status and output of a run.
#[derive(Debug)]
pub struct Run {
    /// Exit status: 0 done, 1 if the data or a comparison fails, 2 if the program could not run.
    pub status: u8,
    /// Standard output: the results.
    pub out: String,
    /// Standard error: remarks and errors.
    pub err: String,
}

impl Run {
    /// Parses the results as JSON.
    ///
    /// # Panics
    /// If the results are not JSON.
    #[must_use]
    pub fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.out)
            .unwrap_or_else(|error| panic!("{error}: {}\n{}", self.out, self.err))
    }
}

/// Runs `impasto` with `arguments`.
#[must_use]
pub fn impasto(arguments: &[&str]) -> Run {
    let mut out = Vec::new();
    let mut err = Vec::new();
    let all = std::iter::once("impasto").chain(arguments.iter().copied());
    let status = impasto::run(all, &mut out, &mut err, impasto::Screen::default());
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("the program writes UTF-8");
    Run { status, out: text(out), err: text(err) }
}

/// Path of a file of the repository, valid from any working folder.
#[must_use]
pub fn repository(file: &str) -> String {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..");
    root.join(file).display().to_string()
}
