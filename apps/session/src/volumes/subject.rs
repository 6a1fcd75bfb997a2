//! Subjects that a scene is opened from.

use std::path::{Path, PathBuf};

/// Prefix of the names of the models that come with the program.
pub const SHAPE: &str = "shape:";

/// A subject that a scene is opened from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Subject {
    /// A model that comes with the program, such as `village`.
    Shape(String),
    /// A model or a photograph in a file.
    File(PathBuf),
    /// A script in a file.
    Script(PathBuf),
    /// The text of a script that was recovered, and the folder of the files that it names.
    Text {
        /// Text of the script.
        text: String,
        /// Folder that its subject lies in.
        folder: PathBuf,
    },
}

impl Subject {
    /// The subject that the text of a command line names, if it names one of a scene: `shape:NAME`,
    /// or a file whose ending is that of a model or of a script of paint volumes. Pictures are not
    /// told apart from those that are pinned beside a painting: [`Subject::of_file`] takes them.
    #[must_use]
    pub fn from_text(text: &str) -> Option<Self> {
        if let Some(name) = text.strip_prefix(SHAPE) {
            return Some(Self::Shape(name.to_owned()));
        }
        let path = Path::new(text);
        match ending(path).as_str() {
            "glb" | "gltf" | "obj" | "ply" => Some(Self::File(path.to_owned())),
            "toml" => Some(Self::Script(path.to_owned())),
            _ => None,
        }
    }

    /// The subject in a file that the painter chose for a scene.
    #[must_use]
    pub fn of_file(path: &Path) -> Self {
        match ending(path).as_str() {
            "toml" => Self::Script(path.to_owned()),
            _ => Self::File(path.to_owned()),
        }
    }
}

/// Ending of a file's name in small letters.
fn ending(path: &Path) -> String {
    let ending = path.extension().and_then(|ending| ending.to_str());
    ending.unwrap_or_default().to_ascii_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_line_names_shapes_models_and_scripts() {
        let village = Some(Subject::Shape("village".to_owned()));
        assert_eq!(Subject::from_text("shape:village"), village);
        let model = Some(Subject::File(PathBuf::from("a/Jug.GLB")));
        assert_eq!(Subject::from_text("a/Jug.GLB"), model);
        let script = Some(Subject::Script(PathBuf::from("wakes.toml")));
        assert_eq!(Subject::from_text("wakes.toml"), script);
        for other in ["still.png", "oils.json", "painting.exr", "village"] {
            assert_eq!(Subject::from_text(other), None, "{other} is not of a scene alone");
        }
        let photograph = Path::new("still.png");
        assert_eq!(Subject::of_file(photograph), Subject::File(photograph.to_owned()));
    }
}
