//! The scene that a script is played in: the mesh, the cameras, and the steps at which we make
//! pictures.

use std::path::{Path, PathBuf};

use graphics::camera::{Camera, CameraPath, Framing, Keyframe, PictureView};
use graphics::mesh::Mesh;
use pictures::{FARTHEST_DEG, PictureViews, Subject, ViewRequest, picture_turns};
use spectra::instrument::split_file_and_name;
use volumes::performance::{FirstView, Performance, PerformanceError};
use volumes::script::{
    CameraTable, KeyframeTable, Row, Script, ScriptCamera, ScriptError, Subject as ScriptSubject,
    frames_fit, is_light, steps_of,
};
use volumes::settings::Settings;
use volumes::toml_text::{Fault, KeyPath, KeyStep};

use super::options::PourOptions;
use crate::failure::{Failure, Result};
use crate::readings::{is_toml, text};

/// A script with the file that it was read from, if any.
pub(super) struct OpenScript {
    pub(super) script: Script,
    /// Name of the file and its text.
    file: Option<(String, String)>,
    /// Number of pours in the script itself. The pours after these come from the command line.
    own_pours: usize,
    /// Whether the command line gives the duration.
    seconds_given: bool,
    /// Whether the command line gives the camera.
    camera_given: bool,
}

/// A scene ready to be painted.
pub(super) struct Scene {
    pub(super) mesh: Mesh,
    /// Cameras of the frames. If the camera stands still, this is one.
    pub(super) cameras: Vec<Camera>,
    /// Width and height of a picture in pixels.
    pub(super) size: (usize, usize),
    /// Whether it is a photograph, which has light of its own.
    pub(super) photograph: bool,
    /// Path of the model or photograph, or name of the shape, to be written into a script.
    subject: PathBuf,
    /// Files that it was read from.
    pub(super) inputs: Vec<PathBuf>,
}

impl OpenScript {
    /// Reads a script, or makes one in which nothing happens to `subject`.
    pub(super) fn of(subject: &Path, pours: &PourOptions) -> Result<Self> {
        let seconds_given = pours.has_seconds();
        if !is_toml(subject) {
            let script = Script::new(&subject.to_string_lossy(), pours.usual_seconds());
            return Ok(Self {
                script,
                file: None,
                own_pours: 0,
                seconds_given,
                camera_given: false,
            });
        }
        let name = subject.display().to_string();
        let text = text(subject)?;
        let script = Script::open_own(subject)?;
        let own_pours = script.pours.len();
        Ok(Self { script, file: Some((name, text)), own_pours, seconds_given, camera_given: false })
    }

    /// Whether it was read from a file.
    pub(super) fn is_file(&self) -> bool {
        self.file.is_some()
    }

    /// A fault of the script with its file and line.
    pub(super) fn located(&self, fault: Box<Fault>) -> Failure {
        if let Some(option) = self.option_of(&fault.key) {
            let Fault { wanted, found, hint, .. } = *fault;
            let message = format!("{option} takes {wanted}, found `{found}`");
            // Names of pigments depend on the library.
            return match option.starts_with("--palette") {
                true => Failure::data(message, hint),
                false => Failure::usage(message, hint),
            };
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
            ("camera", _) if self.camera_given => Some("--camera".to_owned()),
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
    pub(super) fn performance_at_start(
        &self,
        scene: &Scene,
        settings: &Settings,
    ) -> Result<Performance> {
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

    /// The script as text for a file in `folder`. The files of the subject, the `library` and a lamp get
    /// paths relative to this folder. `light` is the light of the paint, if there is paint: a name, or
    /// the file of a lamp.
    pub(super) fn text(
        &self,
        scene: &Scene,
        title: &str,
        folder: &Path,
        (library, light): (Option<&Path>, Option<&str>),
    ) -> Result<String> {
        let mut script = self.script.clone();
        script.subject = path_from(&scene.subject, folder);
        script.library = library.map(|file| path_from(file, folder)).or(script.library);
        (script.illuminant, script.lamp) = match light {
            Some(light) if is_light(light) => (Some(light.to_owned()), None),
            Some(lamp) => (None, Some(lamp_from(lamp, folder))),
            None => (None, None),
        };
        script.title = title.to_owned();
        Ok(script.to_text()?)
    }

    /// Reads the scene. A camera path in the script gets `frames` frames. If options give a camera,
    /// it replaces the camera of the script.
    pub(super) fn scene(
        &mut self,
        path: &Path,
        options: &ViewRequest,
        frames: usize,
    ) -> Result<Scene> {
        let subject = self.subject(path)?;
        // Before a path of the script a photograph is seen as the studio shows it.
        let camera = self.script.camera.as_ref().filter(|_| !options.has_camera());
        let free =
            camera.is_some_and(|camera| matches!(camera.camera(frames), ScriptCamera::Path(_)));
        let views = if free { PictureViews::Free } else { PictureViews::Turned };
        let (read, mut inputs) = options.without_camera().subject(&subject, views)?;
        if self.file.is_some() {
            inputs.push(path.to_owned());
        }
        let photograph = matches!(read, Subject::Photograph(..));
        if options.has_camera() {
            inputs.extend(options.camera_file()?.map(Path::to_owned));
            self.script.camera = Some(camera_table(options, photograph)?);
            self.script = self.script.rounded();
            self.camera_given = true;
            self.script.check().map_err(|fault| self.located(fault))?;
        }
        let table = self.script.camera.clone().unwrap_or_default();
        let (mesh, size, cameras) = match read {
            Subject::Mesh(mesh, _, size) => {
                let cameras = model_cameras(&table, &mesh, size, frames);
                (*mesh, size, cameras)
            }
            Subject::Photograph(photograph, width) => {
                let (own_width, own_height) = photograph.size();
                let shape = own_height as f64 / own_width as f64;
                let rows = |columns: usize| ((columns as f64 * shape).round() as usize).max(1);
                let columns = if free { photograph.usual_width_px() } else { width };
                let mesh = Mesh::of_picture(&photograph.with_opacity(columns, rows(columns)));
                let size = (
                    width,
                    options
                        .height
                        .map(|height| height as usize)
                        .filter(|_| free)
                        .unwrap_or(rows(width)),
                );
                let view = PictureView::of(photograph.size());
                let cameras = picture_cameras(&table, view, &mesh, frames);
                (mesh, size, cameras.map_err(|fault| self.located(fault))?)
            }
        };
        match cameras.is_empty() {
            false => Ok(Scene { mesh, cameras, size, photograph, subject, inputs }),
            true => Err(Failure::data("the camera path has no frames", "give frames = 60")),
        }
    }
}

/// The path of a subject relative to a folder, or its whole path if it does not lie below the folder.
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

/// The file of a lamp relative to a folder, with the name of its spectrum if it has one.
fn lamp_from(lamp: &str, folder: &Path) -> String {
    let (file, name) = split_file_and_name(lamp);
    let file = path_from(Path::new(file), folder);
    name.map_or(file.clone(), |name| format!("{file}#{name}"))
}

/// The camera that options choose, for a script of a model or a photograph.
pub(super) fn camera_table(options: &ViewRequest, photograph: bool) -> Result<CameraTable> {
    let turntable = options.turntable.and_then(|frames| u32::try_from(frames).ok());
    if photograph {
        let way = options.picture_camera()?.map(|way| way.map(f64::from));
        let [azimuth_deg, elevation_deg] = [0, 1].map(|axis| way.map(|way| way[axis]));
        return Ok(CameraTable { azimuth_deg, elevation_deg, turntable, ..CameraTable::default() });
    }
    let Some(path) = options.camera_file()? else {
        let Framing { azimuth_deg, elevation_deg, field_of_view_deg, .. } = options.framing(1.0)?;
        return Ok(CameraTable {
            azimuth_deg: Some((azimuth_deg % 360.0).into()),
            elevation_deg: Some(elevation_deg.into()),
            field_of_view_deg: Some(field_of_view_deg.into()),
            turntable,
            ..CameraTable::default()
        });
    };
    let CameraPath { frames, closed, keyframes } = CameraPath::open(path)?;
    let keyframes = keyframes
        .into_iter()
        .map(|own: Keyframe| KeyframeTable {
            eye: Row(own.eye.map(f64::from)),
            target: Row(own.target.map(f64::from)),
            up: Some(Row(own.up.map(f64::from))),
            field_of_view_deg: Some(own.field_of_view_deg.into()),
        })
        .collect();
    let frames = u32::try_from(frames).ok();
    Ok(CameraTable { frames, closed, keyframes, ..CameraTable::default() })
}

/// The cameras of a model in a picture of this size. A path that does not state its number of
/// frames gets `frames`.
pub(super) fn model_cameras(
    table: &CameraTable,
    mesh: &Mesh,
    (width, height): (usize, usize),
    frames: usize,
) -> Vec<Camera> {
    let framing = match table.camera(frames) {
        ScriptCamera::Path(path) => return path.cameras(mesh.bounds()),
        ScriptCamera::Framing(framing) => framing,
    };
    let framing = Framing { aspect: width as f32 / height as f32, ..framing };
    match table.turntable {
        Some(frames) => framing.fit_turntable(&mesh.positions, frames as usize),
        None => vec![framing.fit(&mesh.positions)],
    }
}

/// The cameras before a photograph.
///
/// # Errors
/// [`Fault`] if the camera is too far to a side, or if the table gives an angle of view: a photograph
/// always fills the picture.
pub(super) fn picture_cameras(
    table: &CameraTable,
    view: PictureView,
    mesh: &Mesh,
    frames: usize,
) -> Result<Vec<Camera>, Box<Fault>> {
    if let ScriptCamera::Path(path) = table.camera(frames) {
        return Ok(path.cameras(mesh.bounds()));
    }
    let degrees = |name, value: Option<f64>| match value {
        Some(value) if value.abs() > f64::from(FARTHEST_DEG) => {
            let wanted = format!("-{FARTHEST_DEG} to {FARTHEST_DEG} before a photograph");
            Err(fault(name, wanted, value, "0 is straight before it"))
        }
        value => Ok(value.unwrap_or(0.0) as f32),
    };
    let right = degrees("azimuth_deg", table.azimuth_deg)?;
    let up = degrees("elevation_deg", table.elevation_deg)?;
    if let Some(angle) = table.field_of_view_deg {
        let wanted = "no value before a photograph, which fills the picture";
        return Err(fault("field_of_view_deg", wanted.to_owned(), angle, "leave it out"));
    }
    let given = table.azimuth_deg.is_some() || table.elevation_deg.is_some();
    let turns = picture_turns(given.then_some([right, up]), table.turntable.map(u64::from));
    Ok(turns.into_iter().map(|[right, up]| view.turned(right, up)).collect())
}

/// The fault of a value of the table.
fn fault(name: &str, wanted: String, found: f64, hint: &str) -> Box<Fault> {
    let key = KeyPath::of("camera").key(name);
    let hint = hint.to_owned();
    Box::new(Fault { key, wanted, found: found.to_string(), hint })
}

/// Steps of a world at which pictures are made.
pub(super) struct Times {
    /// Step of single pictures.
    pub(super) still: u64,
    /// Steps of the frames.
    pub(super) frames: Vec<u64>,
}

impl Times {
    /// The step of the still at `at` seconds (`None` is the end), and the steps of `frames` frames
    /// at `rate` frames a second. Frames after the end of a script of `seconds` show the end.
    pub(super) fn of(seconds: f64, at: Option<f64>, rate: f64, frames: usize) -> Result<Self> {
        let at = at.unwrap_or(seconds);
        if !(0.0..=seconds).contains(&at) {
            return Err(Failure::usage(
                format!("--at takes 0 to {seconds} s, found `{at}`"),
                "leave it out for the end, or give more --seconds",
            ));
        }
        let frames =
            (0..frames).map(|frame| u64::from(steps_of((frame as f64 / rate).min(seconds))));
        Ok(Self { still: u64::from(steps_of(at)), frames: frames.collect() })
    }

    /// Number of frames of a script at `rate` frames a second.
    pub(super) fn frames(script: &OpenScript, rate: f64) -> Result<usize, Box<Fault>> {
        frames_fit(script.script.seconds, rate).map(|frames| frames as usize)
    }

    /// The last step of all.
    pub(super) fn last(&self) -> u64 {
        self.frames.iter().copied().fold(self.still, u64::max)
    }
}
