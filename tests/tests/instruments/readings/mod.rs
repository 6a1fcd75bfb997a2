//! Instruments' files, from bytes to the program.

mod bad_files;
mod formats;
mod fuzz;
mod recipes;

use std::path::PathBuf;

/// A made-up file of tests/fixtures/instruments.
fn fixture(name: &str) -> String {
    suite::program::repository(&format!("tests/fixtures/instruments/{name}"))
}

/// Every made-up file that an instrument might have written, with its bytes.
fn fixtures() -> Vec<(String, Vec<u8>)> {
    let mut paths: Vec<PathBuf> =
        std::fs::read_dir(fixture("")).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let named = paths.into_iter().map(|path| {
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        (name, std::fs::read(path).unwrap())
    });
    named.filter(|(name, _)| name != "README.md" && name != "sheet.csv").collect()
}
