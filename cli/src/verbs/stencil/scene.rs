//! The scene, its cameras and its script.

use std::path::{Path, PathBuf};

use render::camera::{Camera, CameraPath, Framing, Keyframe, PictureView};
use render::mesh::Mesh;
use render::volumes::performance::{FirstView, Performance, PerformanceError};
use render::volumes::script::{
    CameraTable, KeyframeTable, Row, Script, ScriptCamera, ScriptError, Subject as ScriptSubject,
};
use render::volumes::settings::Settings;
use render::volumes::toml_text::{Fault, KeyPath, KeyStep};
use render::watercolor::PhotographPainter;

use super::pours::PourOptions;
use crate::failure::{Context, Failure, Result};
use crate::subject::{PictureViews, Subject, SubjectOptions};

/// A script with the file that it was read from, if any.
pub(super) struct OpenScript {
    pub(super) script: Script,
    /// Name of the file and its text.
    file: Option<(String, String)>,
    /// Number of its own pours; later ones are of the command line.
    own_pours: usize,
    /// Whether the command line gives the duration.
    seconds_given: bool,
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
    /// The model or photograph, for a script.
    subject: PathBuf,
    /// Files that it was read from.
    pub(super) inputs: Vec<PathBuf>,
}

impl OpenScript {
    /// Reads a script, or makes one in which nothing happens to `subject`.
    pub(super) fn of(subject: &Path, pours: &PourOptions) -> Result<Self> {
        let seconds_given = pours.has_seconds();
        if !is_script(subject) {
            let script = Script::new(&subject.to_string_lossy(), pours.usual_seconds());
            return Ok(Self { script, file: None, own_pours: 0, seconds_given });
        }
        let name = subject.display().to_string();
        let text = std::fs::read_to_string(subject)
            .context(|| format!("{name}: this file cannot be read"))?;
        let script = Script::open_own(subject)?;
        let own_pours = script.pours.len();
        Ok(Self { script, file: Some((name, text)), own_pours, seconds_given })
    }

    /// Whether it was read from a file.
    pub(super) fn is_file(&self) -> bool {
        self.file.is_some()
    }

    /// A fault of the script with its file and line.
    pub(super) fn located(&self, fault: Box<Fault>) -> Failure {
        if let Some(option) = self.option_of(&fault.key) {
            let Fault { wanted, found, hint, .. } = *fault;
            return Failure::data(format!("{option} takes {wanted}, found `{found}`"), hint);
        }
        match &self.file {
            Some((name, text)) => ScriptError::located(name, text, fault).into(),
            None => ScriptError::from(fault).into(),
        }
    }

    /// The option that gave the value at `key`, if it was one.
    fn option_of(&self, key: &KeyPath) -> Option<String> {
        let (first, index) = match &key.0[..] {
            [KeyStep::Key(first), KeyStep::Index(index), ..] => (first, Some(*index)),
            [KeyStep::Key(first), ..] => (first, None),
            _ => return None,
        };
        match (first.as_str(), index) {
            ("seconds", _) if self.seconds_given || self.file.is_none() => {
                Some("--seconds".to_owned())
            }
            ("pour", Some(index)) if index >= self.own_pours => {
                Some(format!("--pour number {}", index + 1 - self.own_pours))
            }
            ("palette", _) if self.file.is_none() => Some("--palette or --paint".to_owned()),
            _ => None,
        }
    }

    /// An error of playing with its file and line.
    pub(super) fn located_event(&self, error: PerformanceError) -> Failure {
        if let Some(option) = error.table().and_then(|table| self.option_of(table)) {
            return error.placed(option).into();
        }
        match &self.file {
            Some((name, text)) => error.located(name, text).into(),
            None => error.into(),
        }
    }

    /// The model or photograph: `path` itself, or what the script there names.
    fn subject(&self, path: &Path) -> Result<PathBuf> {
        if self.file.is_none() {
            return Ok(path.to_owned());
        }
        let folder = path.parent().unwrap_or(Path::new(""));
        match self.script.subject_in(folder).map_err(|fault| self.located(fault))? {
            ScriptSubject::Shape(shape) => Ok(PathBuf::from(format!("shape:{}", shape.name()))),
            ScriptSubject::File(file) if file.is_file() => Ok(file),
            ScriptSubject::File(file) => Err(self.located(Box::new(Fault {
                key: KeyPath::of("subject"),
                wanted: "a file that is there".to_owned(),
                found: self.script.subject.clone(),
                hint: format!("put it at {}, or name another file", file.display()),
            }))),
        }
    }

    /// The script before its first step.
    pub(super) fn beginning(&self, scene: &Scene, settings: &Settings) -> Result<Performance> {
        let Scene { mesh, cameras, size, .. } = scene;
        let view = FirstView::new(mesh, &cameras[0], *size);
        Performance::new(&self.script, mesh, settings, &view).map_err(|error| {
            let of_scene = matches!(error, PerformanceError::World(_));
            let failure = self.located_event(error);
            match of_scene {
                true => failure
                    .within(format!("{}: paint cannot be poured over it", scene.subject.display())),
                false => failure,
            }
        })
    }

    /// The script as text, to be written into `folder`: with the subject's path from there, and the
    /// camera of a mesh that options choose.
    pub(super) fn text(
        &self,
        scene: &Scene,
        options: &SubjectOptions,
        folder: &Path,
    ) -> Result<String> {
        let mut script = self.script.clone();
        script.subject = path_from(&scene.subject, folder);
        if !scene.photograph && options.has_camera() {
            script.camera = Some(camera_table(options)?);
        }
        Ok(script.to_text()?)
    }

    /// Reads the scene. `frames` is the number of frames of a camera path of the script.
    pub(super) fn scene(
        &self,
        path: &Path,
        options: &SubjectOptions,
        frames: usize,
    ) -> Result<Scene> {
        let subject = self.subject(path)?;
        let own = self.script.camera.as_ref().filter(|_| !options.has_camera());
        let own = own.map(|camera| camera.camera(frames));
        let views = match own {
            Some(ScriptCamera::Path(_)) => PictureViews::Free,
            _ => PictureViews::Turned,
        };
        let (read, mut inputs) = options.subject(&subject, views)?;
        if self.file.is_some() {
            inputs.push(path.to_owned());
        }
        let scene = match read {
            Subject::Mesh(mesh, cameras, size) => {
                let aspect = size.0 as f32 / size.1 as f32;
                let cameras = match own {
                    None => cameras,
                    Some(ScriptCamera::Path(path)) => path_cameras(&path, &mesh),
                    Some(ScriptCamera::Framing(framing)) => {
                        vec![Framing { aspect, ..framing }.fit(&mesh.positions)]
                    }
                };
                Scene { mesh: *mesh, cameras, size, photograph: false, subject, inputs }
            }
            Subject::Photograph(photograph, width) => {
                let (own_width, own_height) = photograph.size();
                let rows = (width as f64 * own_height as f64 / own_width as f64).round() as usize;
                if let Some(ScriptCamera::Path(path)) = own {
                    // As the studio shows it: with the pixels that it has by itself.
                    let columns = PhotographPainter::usual_width_px(&photograph);
                    let height = columns as f64 * own_height as f64 / own_width as f64;
                    let picture =
                        photograph.with_opacity(columns, (height.round() as usize).max(1));
                    let mesh = Mesh::of_picture(&picture);
                    let cameras = path_cameras(&path, &mesh);
                    let size = (width, options.height().unwrap_or(rows).max(1));
                    return with_cameras(Scene {
                        mesh,
                        cameras,
                        size,
                        photograph: true,
                        subject,
                        inputs,
                    });
                }
                let size = (width, rows.max(1));
                let mesh = Mesh::of_picture(&photograph.with_opacity(size.0, size.1));
                let view = PictureView::of(photograph.size());
                let turns = options.picture_turns()?.into_iter();
                let cameras = turns.map(|[right, up]| view.turned(right, up)).collect();
                Scene { mesh, cameras, size, photograph: true, subject, inputs }
            }
        };
        with_cameras(scene)
    }
}

/// A scene that some camera sees.
fn with_cameras(scene: Scene) -> Result<Scene> {
    match scene.cameras.is_empty() {
        false => Ok(scene),
        true => Err(Failure::data("the camera path has no frames", "give frames = 60")),
    }
}

/// The path of a subject from a folder, or its whole path if it does not lie below the folder.
fn path_from(subject: &Path, folder: &Path) -> String {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let path = match (subject.canonicalize(), folder.canonicalize()) {
        (Ok(subject), Ok(folder)) => {
            subject.strip_prefix(&folder).map_or(subject.clone(), Path::to_owned)
        }
        // A shape has no file.
        _ => subject.to_owned(),
    };
    path.to_string_lossy().into_owned()
}

/// The camera of a mesh that options choose.
fn camera_table(options: &SubjectOptions) -> Result<CameraTable> {
    let Some(path) = options.camera_file() else {
        let Framing { azimuth_deg, elevation_deg, field_of_view_deg, .. } = options.framing(1.0)?;
        return Ok(CameraTable {
            azimuth_deg: Some(azimuth_deg.into()),
            elevation_deg: Some(elevation_deg.into()),
            field_of_view_deg: Some(field_of_view_deg.into()),
            ..CameraTable::default()
        });
    };
    let CameraPath { closed, keyframes, .. } = CameraPath::open(path)?;
    let keyframe = |own: Keyframe| KeyframeTable {
        eye: Row(own.eye.map(f64::from)),
        target: Row(own.target.map(f64::from)),
        up: Some(Row(own.up.map(f64::from))),
        field_of_view_deg: Some(own.field_of_view_deg.into()),
    };
    let keyframes = keyframes.into_iter().map(keyframe).collect();
    Ok(CameraTable { closed, keyframes, ..CameraTable::default() })
}

fn path_cameras(path: &CameraPath, mesh: &Mesh) -> Vec<Camera> {
    path.cameras(mesh.bounds())
}

/// Whether a subject is a script.
fn is_script(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"))
}
