//! The subcommands of `impasto library` that check, compare, join, convert, guess and export.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod exports;
mod joins;

use std::path::PathBuf;

use calibrate::library::PigmentLibrary;
use suite::program::{Run, impasto, repository};
use tempfile::TempDir;

fn oils() -> String {
    repository("measurements/van-gogh-oils.pigments.json")
}

fn text(path: &str) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

fn read(path: &str) -> PigmentLibrary {
    PigmentLibrary::from_json(path, &text(path)).unwrap()
}

/// A temporary folder for files.
struct LibraryFolder(TempDir);

impl LibraryFolder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> String {
        let path: PathBuf = self.0.path().join(name);
        path.to_str().unwrap().to_owned()
    }

    /// Writes the library `from` with a `change` to the file `name`. Returns its path.
    fn changed(&self, name: &str, from: &str, change: impl FnOnce(&mut PigmentLibrary)) -> String {
        let mut library = read(from);
        change(&mut library);
        let path = self.path(name);
        std::fs::write(&path, library.to_json()).unwrap();
        path
    }
}

/// Runs `impasto library ARGUMENTS` and asserts that it succeeds.
fn done(arguments: &[&str]) -> Run {
    let run = tried(arguments);
    assert_eq!(run.status, 0, "{arguments:?}: {}", run.err);
    run
}

fn tried(arguments: &[&str]) -> Run {
    impasto(&[&["library"], arguments].concat())
}

/// Asserts that the command ends with `status` and an error with a hint and all of `words`.
fn refused(arguments: &[&str], status: u8, words: &[&str]) {
    let run = tried(arguments);
    assert_eq!(run.status, status, "{arguments:?}: {}", run.err);
    for word in words.iter().chain(&["hint:"]) {
        assert!(run.err.contains(word), "{word}: {}", run.err);
    }
}

/// Largest difference of reflectance between the libraries, over masstones and 1:1 mixtures of
/// pigments that both have. Leaves out pigments with unknown S.
fn furthest(first: &PigmentLibrary, second: &PigmentLibrary) -> f64 {
    let known: Vec<&str> = (first.pigments.iter())
        .filter(|p| p.identified && second.pigments.iter().any(|q| q.name == p.name))
        .map(|p| p.name.as_str())
        .collect();
    assert!(known.len() > 1, "pigments in common: {known:?}");
    fn film(library: &PigmentLibrary, names: [&str; 2]) -> Vec<f64> {
        let recipe = library.recipe(names.map(|name| (name, 1.0))).unwrap();
        library.mix(recipe).unwrap().hiding(library.saunderson)
    }
    let mut largest: f64 = 0.0;
    for a in &known {
        for b in &known {
            let films = [film(first, [a, b]), film(second, [a, b])];
            let apart = films[0].iter().zip(&films[1]).map(|(x, y)| (x - y).abs());
            largest = apart.fold(largest, f64::max);
        }
    }
    largest
}
