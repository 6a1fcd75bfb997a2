//! Opens what a scene is made from.

use std::path::{Path, PathBuf};

use documents::file::disk;
use graphics::mesh::Mesh;
use graphics::picture::Photograph;
use pigment::library::PigmentLibrary;
use volumes::script::{self, Script, ScriptError};

use super::materials::{Materials, fill_tubes};
use super::subject::{SHAPE, Subject};
use crate::failure::FileFailure;

/// Number of triangles of a model that comes with the program, as the command line makes it.
const TRIANGLES: usize = 60_000;

/// A scene that was read.
#[derive(Debug)]
pub(super) struct OpenedScene {
    /// The script; with no events for a subject alone.
    pub(super) script: Script,
    /// Name and text of the script, for messages.
    pub(super) source: (String, String),
    /// Its pigments.
    pub(super) materials: Materials,
    /// The surfaces of the subject.
    pub(super) mesh: Mesh,
    /// Whether the subject is a photograph.
    pub(super) flat: bool,
    /// Folder that the subject lies in.
    pub(super) folder: PathBuf,
    /// File of the subject; `None` for a model that comes with the program.
    pub(super) file: Option<PathBuf>,
}

impl OpenedScene {
    /// Reads `subject` and all that it names.
    ///
    /// # Errors
    /// [`FileFailure`] that names the file, and the place in a script.
    pub(super) fn read(subject: &Subject) -> Result<Self, FileFailure> {
        match subject {
            Subject::Shape(name) => Self::of_script(
                new_script(&format!("{SHAPE}{name}"), name)?,
                (format!("{SHAPE}{name}"), String::new()),
                Path::new(""),
            ),
            Subject::File(path) => {
                let path = absolute(path);
                let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
                let title = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
                let folder = path.parent().unwrap_or(Path::new(""));
                let source = (path.display().to_string(), String::new());
                Self::of_script(new_script(name, title)?, source, folder)
            }
            Subject::Script(path) => {
                let path = absolute(path);
                let script = Script::open(&path).map_err(|error| FileFailure::explained(&error))?;
                let text = disk::read_to_string(&path).unwrap_or_default();
                let folder = path.parent().unwrap_or(Path::new(""));
                Self::of_script(script, (path.display().to_string(), text), folder)
            }
            Subject::Text { text, folder } => {
                let name = "the recovered scene";
                let script = Script::from_own_text(name, text);
                let script = script.map_err(|error| FileFailure::explained(&error))?;
                Self::of_script(script, (name.to_owned(), text.clone()), folder)
            }
        }
    }

    fn of_script(
        script: Script,
        source: (String, String),
        folder: &Path,
    ) -> Result<Self, FileFailure> {
        let subject = script.subject_in(folder).map_err(|fault| {
            FileFailure::explained(&ScriptError::located(&source.0, &source.1, fault))
        })?;
        let (mesh, flat, file) = match subject {
            script::Subject::Shape(shape) => (shape.mesh(TRIANGLES), false, None),
            script::Subject::File(path) if is_mesh(&path) => {
                let mesh = Mesh::open(&path).map_err(|error| FileFailure::explained(&error))?;
                (mesh, false, Some(path))
            }
            script::Subject::File(path) => (photograph(&path)?, true, Some(path)),
        };
        let materials = Materials::of(&script, (&source.0, &source.1), folder)?;
        let mut script = script;
        if flat {
            script.light_of_its_own();
        }
        // What is shown is what is saved.
        let script = script.rounded();
        Ok(Self { script, source, materials, mesh, flat, folder: folder.to_owned(), file })
    }
}

/// The script of a scene in which nothing has happened.
fn new_script(subject: &str, title: &str) -> Result<Script, FileFailure> {
    let mut script = Script::new(subject, 0.0);
    script.title = title.to_owned();
    let library = PigmentLibrary::van_gogh_oils();
    fill_tubes(&mut script, &library)?;
    script.library = Some(library.title);
    Ok(script)
}

/// Whether a file's name has the ending of a model.
fn is_mesh(path: &Path) -> bool {
    let endings = ["glb", "gltf", "obj", "ply"];
    let ending = path.extension().and_then(|ending| ending.to_str());
    ending.is_some_and(|ending| endings.contains(&ending.to_ascii_lowercase().as_str()))
}

/// A photograph as a flat model, with as many pixels as the command line gives it.
fn photograph(path: &Path) -> Result<Mesh, FileFailure> {
    let photograph = Photograph::open(path).map_err(|error| FileFailure::explained(&error))?;
    let (width, height) = photograph.size();
    let columns = photograph.usual_width_px();
    let rows = (columns as f64 * height as f64 / width as f64).round() as usize;
    Ok(Mesh::of_picture(&photograph.with_opacity(columns, rows.max(1))))
}

fn absolute(path: &Path) -> PathBuf {
    disk::absolute(path).unwrap_or_else(|_| path.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_scene_has_the_tubes_of_the_easel() {
        let opened = OpenedScene::read(&Subject::Shape("sphere".to_owned())).unwrap();
        assert_eq!((opened.script.title.as_str(), opened.script.palette.len()), ("sphere", 8));
        assert!(opened.mesh.triangles.len() > 50_000 && opened.file.is_none());
    }

    #[test]
    fn what_cannot_be_opened_is_named_with_a_way_out() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, text).unwrap();
            path
        };
        let future = "format = \"paint-volumes\"\nversion = 9\nsubject = \"shape:village\"\n";
        let wrong = "format = \"paint-volumes\"\nversion = 1\nsubject = \"shape:vilage\"\n\
                     seconds = 1.0\n";
        for (subject, wanted) in [
            (Subject::Shape("vilage".to_owned()), "vilage"),
            (Subject::File(file("a.ply", "no ply")), "a.ply"),
            (Subject::File(file("b.png", "no picture")), "b.png"),
            (Subject::File(folder.path().join("missing.glb")), "missing.glb"),
            (Subject::Script(file("c.toml", "seconds = ")), "c.toml"),
            (Subject::Script(file("d.toml", future)), "line 2"),
            (Subject::Script(file("e.toml", wrong)), "line 3"),
        ] {
            let failure = OpenedScene::read(&subject).unwrap_err();
            assert!(failure.what.contains(wanted), "{subject:?}: {failure:?}");
            assert!(failure.hint.is_some(), "{subject:?}: {failure:?}");
        }
    }
}
