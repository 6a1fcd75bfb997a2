//! The scene that a script is played in: the mesh, the cameras, and the steps at which we make
//! pictures.

use std::path::{Path, PathBuf};

use documents::text::{KeyPath, ValueFault};
use graphics::{
    camera::{Camera, CameraPath, Framing, Keyframe, PictureView},
    mesh::Mesh,
};
use spectra::instrument::split_file_and_name;
use volumes::performance::{FirstView, Performance, PerformanceError};
use volumes::script::{
    CameraTable, KeyframeTable, Row, ScriptCamera, Subject as ScriptSubject, frames_fit, is_light,
    steps_of,
};
use volumes::settings::Settings;

use super::script::OpenScript;
use crate::error::{PictureError, SettingError};
use crate::subject::{
    FARTHEST_DEG, OpenSubject, PictureViews, Subject, ViewRequest, picture_turns,
};

/// A scene ready to be painted.
#[derive(Debug)]
pub(super) struct Scene {
    pub(super) mesh: Mesh,
    /// Cameras of the frames. If the camera stands still, this is one.
    pub(super) cameras: Vec<Camera>,
    /// Width and height of a picture in pixels.
    pub(super) size: (usize, usize),
    /// Whether the subject is a photograph, which has its own light.
    pub(super) photograph: bool,
    /// Path of the model or photograph, or name of the shape, to be written into a script.
    subject: PathBuf,
    /// Files that the scene was read from.
    pub(super) inputs: Vec<PathBuf>,
    /// Place of the mesh's origin in the coordinates of the model's file.
    pub(super) origin: [f64; 3],
}

impl OpenScript {
    /// The model or photograph: `path` itself, or what the script there names.
    fn subject(&self, path: &Path) -> Result<PathBuf, PictureError> {
        if !self.is_file() {
            return Ok(path.to_owned());
        }
        let folder = path.parent().unwrap_or(Path::new(""));
        match self.script.subject_in(folder).map_err(|fault| self.located(fault))? {
            ScriptSubject::Shape(shape) => Ok(PathBuf::from(format!("shape:{}", shape.name()))),
            ScriptSubject::File(file) if file.is_file() => Ok(file),
            ScriptSubject::File(file) => {
                let hint = format!("put it at {}, or name another file", file.display());
                let key = KeyPath::of("subject");
                let wanted = "a file that is there";
                Err(self.located(ValueFault::new(&key, wanted, &self.script.subject, hint)))
            }
        }
    }

    /// The script before its first step.
    pub(super) fn performance_at_start(
        &self,
        scene: &Scene,
        settings: &Settings,
    ) -> Result<Performance, PictureError> {
        let Scene { mesh, cameras, size, subject, .. } = scene;
        let view = FirstView::new(mesh, &cameras[0], *size);
        Performance::new(&self.script, mesh, settings, &view).map_err(|error| match error {
            PerformanceError::World(_) => {
                let subject = subject.display().to_string();
                PictureError::Scene(subject, Box::new(error))
            }
            error => self.located_event(error),
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
    ) -> Result<String, PictureError> {
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

    /// Reads the scene. A camera path in the script gets `frames` frames. If the request gives a camera,
    /// it replaces the camera of the script.
    pub(super) fn scene(
        &mut self,
        path: &Path,
        request: &ViewRequest,
        frames: usize,
    ) -> Result<Scene, PictureError> {
        let subject = self.subject(path)?;
        // A camera path of the script sees the photograph as the studio shows it.
        let camera = self.script.camera.as_ref().filter(|_| !request.has_camera());
        let free =
            camera.is_some_and(|camera| matches!(camera.camera(frames), ScriptCamera::Path(_)));
        let views = if free { PictureViews::Free } else { PictureViews::Turned };
        let OpenSubject { subject: read, mut inputs, origin } =
            request.without_camera().subject(&subject, views)?;
        if self.is_file() {
            inputs.push(path.to_owned());
        }
        let photograph = matches!(read, Subject::Photograph(..));
        if request.has_camera() {
            inputs.extend(request.camera_file()?.map(Path::to_owned));
            self.script.camera = Some(camera_table(request, photograph, origin)?);
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
                let columns = if free { photograph.usual_width_px() } else { width };
                let mesh =
                    Mesh::of_picture(&photograph.with_opacity(columns, rows(columns, shape)));
                let height = request.height.map(|height| height as usize).filter(|_| free);
                let size = (width, height.unwrap_or_else(|| rows(width, shape)));
                let view = PictureView::of(photograph.size());
                let cameras = picture_cameras(&table, view, &mesh, frames);
                (mesh, size, cameras.map_err(|fault| self.located(fault))?)
            }
        };
        match cameras.is_empty() {
            false => Ok(Scene { mesh, cameras, size, photograph, subject, inputs, origin }),
            true => Err(PictureError::no_frames()),
        }
    }
}

/// Rows of a picture with this number of columns. `shape` is the height by the width.
fn rows(columns: usize, shape: f64) -> usize {
    ((columns as f64 * shape).round() as usize).max(1)
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

/// The camera that a request chooses, for a script of a model or a photograph. `origin` is the place of the mesh's
/// origin in the coordinates of the request.
fn camera_table(
    request: &ViewRequest,
    photograph: bool,
    origin: [f64; 3],
) -> Result<CameraTable, PictureError> {
    let turntable = request.turntable.and_then(|frames| u32::try_from(frames).ok());
    if photograph {
        let way = request.picture_camera()?.map(|way| way.map(f64::from));
        let [azimuth_deg, elevation_deg] = [0, 1].map(|axis| way.map(|way| way[axis]));
        return Ok(CameraTable { azimuth_deg, elevation_deg, turntable, ..CameraTable::default() });
    }
    let Some(path) = request.camera_file()? else {
        let Framing { azimuth_deg, elevation_deg, field_of_view_deg, .. } = request.framing(1.0)?;
        return Ok(CameraTable {
            azimuth_deg: Some((azimuth_deg % 360.0).into()),
            elevation_deg: Some(elevation_deg.into()),
            field_of_view_deg: Some(field_of_view_deg.into()),
            turntable,
            ..CameraTable::default()
        });
    };
    let CameraPath { frames, closed, keyframes } = CameraPath::open(path)?.relative_to(origin);
    let keyframes = keyframes
        .into_iter()
        .map(|own: Keyframe| KeyframeTable {
            eye: Row(own.eye),
            target: Row(own.target),
            up: Some(Row(own.up.map(f64::from))),
            field_of_view_deg: Some(own.field_of_view_deg.into()),
        })
        .collect();
    let frames = u32::try_from(frames).ok();
    Ok(CameraTable { frames, closed, keyframes, ..CameraTable::default() })
}

/// The cameras of a model in a picture of this size. A path that does not state its number of
/// frames gets `frames`.
fn model_cameras(
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
/// [`ValueFault`] if the camera is too far to a side, or if the table gives an angle of view: a photograph
/// always fills the picture.
fn picture_cameras(
    table: &CameraTable,
    view: PictureView,
    mesh: &Mesh,
    frames: usize,
) -> Result<Vec<Camera>, Box<ValueFault>> {
    if let ScriptCamera::Path(path) = table.camera(frames) {
        return Ok(path.cameras(mesh.bounds()));
    }
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

/// An angle before a photograph.
fn degrees(name: &str, value: Option<f64>) -> Result<f32, Box<ValueFault>> {
    match value {
        Some(value) if value.abs() > f64::from(FARTHEST_DEG) => {
            let wanted = format!("-{FARTHEST_DEG} to {FARTHEST_DEG} before a photograph");
            Err(fault(name, wanted, value, "0 is straight before it"))
        }
        value => Ok(value.unwrap_or(0.0) as f32),
    }
}

/// The fault of a value of the table.
fn fault(name: &str, wanted: String, found: f64, hint: &str) -> Box<ValueFault> {
    ValueFault::new(&KeyPath::of("camera").key(name), wanted, found, hint)
}

/// Steps of a world at which pictures are made.
#[derive(Debug)]
pub(super) struct Times {
    /// Step of single pictures.
    pub(super) still: u64,
    /// Steps of the frames.
    pub(super) frames: Vec<u64>,
}

impl Times {
    /// The step of the still at `at` seconds (`None` is the end), and the steps of `frames` frames
    /// at `rate` frames a second. Frames after the end of a script of `seconds` show the end.
    pub(super) fn of(
        seconds: f64,
        at: Option<f64>,
        rate: f64,
        frames: usize,
    ) -> Result<Self, SettingError> {
        let at = at.unwrap_or(seconds);
        if !(0.0..=seconds).contains(&at) {
            let reason = format!("takes 0 to {seconds} s, found `{at}`");
            let hint = "leave it out for the end, or give more [seconds]";
            return Err(SettingError::of("at", reason, hint));
        }
        let frames =
            (0..frames).map(|frame| u64::from(steps_of((frame as f64 / rate).min(seconds))));
        Ok(Self { still: u64::from(steps_of(at)), frames: frames.collect() })
    }

    /// Number of frames of a script at `rate` frames a second.
    pub(super) fn frames(script: &OpenScript, rate: f64) -> Result<usize, Box<ValueFault>> {
        frames_fit(script.script.seconds, rate).map(|frames| frames as usize)
    }

    /// The last step of all.
    pub(super) fn last(&self) -> u64 {
        self.frames.iter().copied().fold(self.still, u64::max)
    }
}
