//! The pigment library of a verb. You name it first among the words, else we take the default one.

use std::path::{Path, PathBuf};

use calibrate::library::PigmentLibrary;
use documents::file::{is_standard_input, is_there};

use crate::console::Console;
use crate::failure::{Context, Failure, Result};

/// Environment variable with the path of the default library.
pub(crate) const VARIABLE: &str = "IMPASTO_LIBRARY";

/// A library, and the file that it was read from.
#[derive(Debug)]
pub(crate) struct ChosenLibrary {
    pub(crate) library: PigmentLibrary,
    /// Its file, `None` for the oils that ship.
    pub(crate) path: Option<PathBuf>,
}

impl ChosenLibrary {
    /// Name of the file in messages, also of the library that ships.
    pub(crate) fn name(&self) -> String {
        self.path.as_ref().map_or_else(
            || "van-gogh-oils.pigments.json".to_owned(),
            |path| path.display().to_string(),
        )
    }

    /// Files that it was read from, which no output overwrites.
    pub(crate) fn inputs(&self) -> Vec<PathBuf> {
        self.path.iter().cloned().collect()
    }
}

/// The path in [`VARIABLE`], if it holds one.
pub(crate) fn default_path() -> Option<PathBuf> {
    let path = std::env::var_os(VARIABLE).filter(|path| !path.is_empty());
    path.map(PathBuf::from)
}

/// Reads the library at `path`. Without a path we read the default library and say so.
pub(crate) fn chosen(path: Option<&Path>, console: &mut Console<'_>) -> Result<ChosenLibrary> {
    if path.is_none() && default_path().is_none() {
        console.remark(format!(
            "library: Van Gogh's oils, which ship (name another first, or set {VARIABLE})"
        ))?;
    }
    quietly_chosen(path, console)
}

/// Like [`chosen`]. Use this for verbs with a help that names the shipped library as the default.
pub(crate) fn quietly_chosen(
    path: Option<&Path>,
    console: &mut Console<'_>,
) -> Result<ChosenLibrary> {
    let Some((path, library)) = named_or_default(path)? else {
        let library = PigmentLibrary::van_gogh_oils();
        return Ok(ChosenLibrary { library, path: None });
    };
    let count = documents::counted(library.pigments.len(), "pigment");
    console.detail(format!("library: {} ({count})", path.display()))?;
    Ok(ChosenLibrary { library, path: Some(path) })
}

/// Reads the library at `path`. If you give no path, reads the one that [`VARIABLE`] names, and
/// errors name the variable too. Returns `None` if there is neither.
pub(crate) fn named_or_default(path: Option<&Path>) -> Result<Option<(PathBuf, PigmentLibrary)>> {
    let Some(own) = path.map(Path::to_owned).or_else(default_path) else { return Ok(None) };
    let read = PigmentLibrary::open(&own).map_err(Failure::from);
    let library = match path {
        Some(_) => read?,
        None => read.context(|| format!("the default library, which {VARIABLE} names"))?,
    };
    Ok(Some((own, library)))
}

/// Splits the words of a verb into the path of a library, if the first word is one, and the others.
/// `may_be_file` says whether the other words may be paths of files.
pub(crate) fn split(words: &[String], may_be_file: bool) -> (Option<PathBuf>, &[String]) {
    match words {
        [first, rest @ ..] if is_library(first, may_be_file) => (Some(PathBuf::from(first)), rest),
        _ => (None, words),
    }
}

/// Whether a word is the path of a library: by its ending, because it is standard input, or because
/// there is such a file. Where other words may be files too, the file must hold JSON.
fn is_library(word: &str, may_be_file: bool) -> bool {
    let path = Path::new(word);
    let is_json = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json"));
    if is_json || is_standard_input(path) {
        return true;
    }
    is_there(path)
        && (!may_be_file
            || std::fs::read(path).is_ok_and(|bytes| bytes.trim_ascii_start().starts_with(b"{")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_word_is_a_library_if_it_is_a_file_of_one() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, text).unwrap();
            path.display().to_string()
        };
        let library = file("oils", " {\"format\": 1}");
        let table = file("a.csv", "sample,400\n");
        for (word, alone, among_files) in [
            ("missing.json", true, true),
            ("-", true, true),
            (library.as_str(), true, true),
            (table.as_str(), true, false),
            ("#4a7d8c", false, false),
            ("Zinc White=9", false, false),
        ] {
            let words = [word.to_owned(), "more".to_owned()];
            assert_eq!(split(&words, false).0.is_some(), alone, "{word}");
            assert_eq!(split(&words, true).0.is_some(), among_files, "{word}");
            assert_eq!(split(&words, true).1.len(), if among_files { 1 } else { 2 }, "{word}");
        }
    }
}
