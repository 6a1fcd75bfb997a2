//! The subject of a script.

use std::path::{Component, Path, PathBuf};

use documents::similar_names;
use graphics::mesh::SampleModel;

use super::file::Script;
use crate::toml_text::{Checked, Fault, KeyPath};

/// Longest path in bytes.
const LONGEST: usize = 1024;

/// The model or photograph that a script paints.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Subject {
    /// A model that is made, written `shape:NAME`.
    Shape(SampleModel),
    /// A file with a model or a photograph.
    File(PathBuf),
}

impl Script {
    /// The subject; a path starts from `folder`, the folder of the script.
    ///
    /// # Errors
    /// [`Fault`] of `subject` for an unknown shape, another script, and for a path that is empty or has control
    /// characters.
    pub fn subject_in(&self, folder: &Path) -> Result<Subject, Box<Fault>> {
        self.check_subject()?;
        match self.subject.strip_prefix("shape:").and_then(SampleModel::from_name) {
            Some(shape) => Ok(Subject::Shape(shape)),
            None => Ok(Subject::File(folder.join(&self.subject))),
        }
    }

    pub(super) fn check_subject(&self) -> Checked {
        let key = KeyPath::of("subject");
        if let Some(name) = self.subject.strip_prefix("shape:") {
            if SampleModel::from_name(name).is_some() {
                return Ok(());
            }
            let names = SampleModel::ALL.map(SampleModel::name);
            let similar = similar_names(name, names);
            let hint = match similar.is_empty() {
                true => format!("shapes are {}", names.join(", ")),
                false => format!("did you mean shape:{}?", similar.join(" or shape:")),
            };
            return Err(Fault::new(&key, "the name of a shape after `shape:`", name, hint));
        }
        let ending = Path::new(&self.subject).extension();
        if ending.is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
            let hint = "name the model or photograph that the other script paints";
            return Err(Fault::new(&key, "a model or a photograph", &self.subject, hint));
        }
        let fits =
            (1..=LONGEST).contains(&self.subject.len()) && !self.subject.contains(char::is_control);
        match fits {
            true => Ok(()),
            false => Err(Fault::new(
                &key,
                format!("a path of 1 to {LONGEST} bytes without control characters"),
                self.subject.escape_debug(),
                "subject = \"shape:still-life\" is a model that is always there",
            )),
        }
    }

    /// Checks that all paths lead to files in the script's folder or below it.
    pub(super) fn check_files_beside(&self) -> Checked {
        if !self.subject.starts_with("shape:") {
            check_beside("subject", &self.subject)?;
        }
        for (key, path) in [("library", &self.library), ("lamp", &self.lamp)] {
            path.as_deref().map_or(Ok(()), |path| check_beside(key, path))?;
        }
        Ok(())
    }
}

fn check_beside(key: &str, path: &str) -> Checked {
    let mut parts = Path::new(path).components();
    // Colons and backslashes lead elsewhere on Windows.
    let below =
        parts.all(|part| matches!(part, Component::Normal(_))) && !path.contains(['\\', ':']);
    match below {
        true => Ok(()),
        false => Err(Fault::new(
            &KeyPath::of(key),
            "a path below the script's folder",
            path,
            "put the file beside the script",
        )),
    }
}
