//! The scene, its cameras and its script.

use std::path::{Path, PathBuf};

use render::camera::{Camera, CameraPath, Framing, PictureView};
use render::mesh::Mesh;
use render::volumes::script::{Script, ScriptCamera, ScriptError, Subject as ScriptSubject};
use render::volumes::toml_text::Fault;

use crate::failure::{Context, Failure, Result};
use crate::subject::{Subject, SubjectOptions};

/// A script with the file that it was read from, if any.
pub(super) struct OpenScript {
    pub(super) script: Script,
    /// Name of the file and its text.
    file: Option<(String, String)>,
}

/// A scene ready to be painted.
pub(super) struct Scene {
    pub(super) mesh: Mesh,
    /// Cameras of the frames; one for a camera that stands still.
    pub(super) cameras: Vec<Camera>,
    /// Width and height of a picture in pixels.
    pub(super) size: (usize, usize),
    /// Whether it is a photograph, which has light of its own.
    pub(super) photograph: bool,
    /// Files that it was read from.
    pub(super) inputs: Vec<PathBuf>,
}

impl OpenScript {
    /// Reads a script, or makes one in which nothing happens to `subject` for `seconds`.
    pub(super) fn of(subject: &Path, seconds: f64) -> Result<Self> {
        if !is_script(subject) {
            let script = Script::new(&subject.to_string_lossy(), seconds);
            return Ok(Self { script, file: None });
        }
        let name = subject.display().to_string();
        let text = std::fs::read_to_string(subject)
            .context(|| format!("{name}: this file cannot be read"))?;
        let script = Script::open_own(subject)?;
        Ok(Self { script, file: Some((name, text)) })
    }

    /// A fault of the script with its file and line.
    pub(super) fn located(&self, fault: Box<Fault>) -> Failure {
        match &self.file {
            Some((name, text)) => ScriptError::located(name, text, fault).into(),
            None => ScriptError::from(fault).into(),
        }
    }

    /// An error of playing with its file and line.
    pub(super) fn located_event(
        &self,
        error: render::volumes::performance::PerformanceError,
    ) -> Failure {
        match &self.file {
            Some((name, text)) => error.located(name, text).into(),
            None => error.into(),
        }
    }

    /// Reads the scene. `frames` is the number of frames of a camera path of the script.
    pub(super) fn scene(
        &self,
        path: &Path,
        options: &SubjectOptions,
        frames: usize,
    ) -> Result<Scene> {
        let folder = path.parent().unwrap_or(Path::new(""));
        let subject = match is_script(path) {
            false => path.to_owned(),
            true => match self.script.subject_in(folder).map_err(|fault| self.located(fault))? {
                ScriptSubject::Shape(shape) => PathBuf::from(format!("shape:{}", shape.name())),
                ScriptSubject::File(file) => file,
            },
        };
        let (read, mut inputs) = options.subject(&subject, true)?;
        if is_script(path) {
            inputs.push(path.to_owned());
        }
        let scene = match read {
            Subject::Mesh(mesh, cameras, size) => {
                let aspect = size.0 as f32 / size.1 as f32;
                let own = self.script.camera.as_ref().filter(|_| !options.has_camera());
                let cameras = match own.map(|camera| camera.camera(frames)) {
                    None => cameras,
                    Some(ScriptCamera::Path(path)) => path_cameras(&path, &mesh),
                    Some(ScriptCamera::Framing(framing)) => {
                        vec![Framing { aspect, ..framing }.fit(&mesh.positions)]
                    }
                };
                Scene { mesh: *mesh, cameras, size, photograph: false, inputs }
            }
            Subject::Photograph(photograph, width) => {
                let (own_width, own_height) = photograph.size();
                let rows = (width as f64 * own_height as f64 / own_width as f64).round() as usize;
                let size = (width, rows.max(1));
                let mesh = Mesh::of_picture(&photograph.with_opacity(size.0, size.1));
                let view = PictureView::of(photograph.size());
                let turns = options.picture_turns()?.into_iter();
                let cameras = turns.map(|[right, up]| view.turned(right, up)).collect();
                Scene { mesh, cameras, size, photograph: true, inputs }
            }
        };
        match scene.cameras.is_empty() {
            false => Ok(scene),
            true => Err(Failure::data("the camera path has no frames", "give frames = 60")),
        }
    }
}

fn path_cameras(path: &CameraPath, mesh: &Mesh) -> Vec<Camera> {
    path.cameras(mesh.bounds())
}

/// Whether a subject is a script.
fn is_script(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"))
}
