//! Text formats of instruments, read by the library and by the program.

mod bad_files;
mod formats;
mod fuzz;
mod recipes;
mod tables;
mod workbooks;

use std::path::PathBuf;

/// Path of a made-up file in tests/fixtures/instruments.
fn fixture(name: &str) -> String {
    suite::program::repository(&format!("tests/fixtures/instruments/{name}"))
}

/// Names and bytes of all made-up instrument files.
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
