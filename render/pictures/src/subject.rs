//! The subject of a picture and how it is seen: a photograph, or a mesh and its cameras.

use std::path::{Path, PathBuf};

use documents::{
    did_you_mean,
    file::{Outside, is_standard_input, read},
};
use graphics::{
    camera::{Camera, CameraPath, Framing},
    mesh::{Mesh, ModelFile, SampleModel},
    picture::Photograph,
    picture_formats::begins_like_picture,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::{PictureError, SettingError};

/// Number of triangles of a built-in model, chosen by eye.
const TRIANGLES: usize = 60_000;
/// Smallest width or height of a picture, in pixels.
pub const LEAST_PX: u64 = 16;
/// Largest width or height of a picture, in pixels.
pub const MOST_PX: u64 = 16_384;
/// Largest number of frames.
pub const MOST_FRAMES: u64 = 100_000;
/// Angle by which the camera of a picture swings to each side, in degrees.
const SWING_DEG: f32 = 8.0;
/// Largest angle between a camera of a picture and the view from straight ahead, in degrees.
pub const FARTHEST_DEG: f32 = 80.0;
/// Default width of a picture of a mesh, in pixels.
const WIDTH: usize = 1000;

/// Size of a picture, and the cameras that see its subject.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ViewRequest {
    /// Width of the picture in pixels, 16 to 16384 [default: a photograph's own, its longer side at most 1600,
    /// and 1000 of a mesh]
    pub width: Option<u64>,
    /// Height of the picture of a mesh in pixels [default: three quarters of the width]
    pub height: Option<u64>,
    /// Camera. For a mesh: degrees around it, degrees above the horizon, and the angle of view, such
    /// as `30,20,30`, at a distance that shows the whole mesh; or a file of keyframes (.toml). For a
    /// picture that can be turned (under volumes, or with a depth): degrees to the right and upwards,
    /// such as `8,4`
    pub camera: Option<String>,
    /// Turn the camera around a mesh in this number of frames, 1 to 100000. In front of a picture
    /// that can be turned, the camera swings from side to side
    pub turntable: Option<u64>,
    /// Let a model, a file of settings and a file of regions name files outside of their own folders. Without this,
    /// materials, textures, buffers, pictures and maps must lie in the folder of the file that names them, or below
    pub allow_outside: bool,
}

/// Cameras from which a picture may be seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PictureViews {
    /// Only from the front, the whole picture.
    Front,
    /// From the front, or turned by the degrees that the request gives.
    Turned,
    /// Any camera, and the picture may have another aspect than its subject.
    Free,
}

/// A model or picture to paint.
#[derive(Debug)]
pub enum Subject {
    /// A photograph, and the width of the picture in pixels.
    Photograph(Photograph, usize),
    /// A mesh, its cameras, and the width and height of the pictures in pixels.
    Mesh(Box<Mesh>, Vec<Camera>, (usize, usize)),
}

/// A subject that was read from its files.
#[derive(Debug)]
pub struct OpenSubject {
    /// The model or picture to paint.
    pub subject: Subject,
    /// Files that it was read from, also those that a model names.
    pub inputs: Vec<PathBuf>,
    /// Place of a mesh's origin in the coordinates of its file. It is 0 unless the model lies far from the origin,
    /// see [`ModelFile::origin`].
    pub origin: [f64; 3],
}

/// Refuses the value of `key` if it lies outside a range.
pub(crate) fn check_range(
    key: &str,
    value: Option<u64>,
    [least, most]: [u64; 2],
) -> Result<(), SettingError> {
    match value {
        Some(value) if !(least..=most).contains(&value) => {
            let reason = format!("takes {least} to {most}, found `{value}`");
            Err(SettingError::of(key, reason, "leave it out for the default"))
        }
        _ => Ok(()),
    }
}

impl ViewRequest {
    /// Whether files may name other files outside of their own folders.
    #[must_use]
    pub fn outside(&self) -> Outside {
        Outside::allowed_if(self.allow_outside)
    }

    /// Reads the subject at `path`, or makes the model of `shape:NAME`. `views` says how a picture may be seen.
    ///
    /// # Errors
    /// [`PictureError`] for a subject or a path of the camera that cannot be read, and for a size or camera that
    /// the subject does not take.
    pub fn subject(&self, path: &Path, views: PictureViews) -> Result<OpenSubject, PictureError> {
        check_range("width", self.width, [LEAST_PX, MOST_PX])?;
        check_range("height", self.height, [LEAST_PX, MOST_PX])?;
        check_range("turntable", self.turntable, [1, MOST_FRAMES])?;
        let turned = views != PictureViews::Front;
        let free = views == PictureViews::Free;
        let text = path.to_string_lossy();
        if let Some(name) = text.strip_prefix("shape:") {
            return self.mesh(shape(name)?.mesh(TRIANGLES), [0.0; 3], Vec::new());
        }
        if is_mesh(path)? {
            let ModelFile { mesh, origin, files } = ModelFile::open(path, self.outside())?;
            return self.mesh(mesh, origin, [vec![path.to_owned()], files].concat());
        }
        for (key, present) in [
            ("camera", self.camera.is_some() && !turned),
            ("turntable", self.turntable.is_some() && !turned),
            ("height", self.height.is_some() && !free),
        ] {
            if present {
                let reason = format!("applies to meshes only, and {text} is not a mesh");
                let hint =
                    "names of meshes end in .obj, .gltf, .glb or .ply; shape:village is a mesh too";
                return Err(SettingError::of(key, reason, hint).into());
            }
        }
        let photograph = Photograph::open(path)?;
        let (own_width, height) = photograph.size();
        let width = self.width.map_or_else(|| photograph.usual_width_px(), |width| width as usize);
        let rows = (width as f64 * height as f64 / own_width as f64).round();
        if self.width.is_none() && width.max(height) < LEAST_PX as usize {
            let message = format!("{text}: {width} x {height} pixels are too few for a picture");
            return Err(
                SettingError::whole(message, format!("give [width={LEAST_PX}] or more")).into()
            );
        }
        if rows > MOST_PX as f64 {
            let message = format!(
                "{text}: the picture would have {rows} rows of pixels, more than `{MOST_PX}`"
            );
            return Err(SettingError::whole(message, "give a smaller [width]").into());
        }
        let subject = Subject::Photograph(photograph, width);
        Ok(OpenSubject { subject, inputs: vec![path.to_owned()], origin: [0.0; 3] })
    }

    /// Whether the request chooses the camera.
    #[must_use]
    pub fn has_camera(&self) -> bool {
        self.camera.is_some() || self.turntable.is_some()
    }

    /// The request without a camera of its own: the usual camera shows the subject in the same
    /// size.
    #[must_use]
    pub fn without_camera(&self) -> Self {
        Self { camera: None, turntable: None, ..self.clone() }
    }

    /// The file of keyframes that `camera` names. `None` if it gives degrees or nothing.
    ///
    /// # Errors
    /// [`SettingError`] if a turntable moves the camera too.
    pub fn camera_file(&self) -> Result<Option<&Path>, SettingError> {
        let text = self
            .camera
            .as_deref()
            .filter(|text| text.ends_with(".toml") || is_standard_input(Path::new(text)));
        let Some(path) = text.map(Path::new) else { return Ok(None) };
        match self.turntable {
            None => Ok(Some(path)),
            Some(_) => Err(SettingError::of(
                "turntable",
                format!("and {} both move the camera", path.display()),
                "leave one of them out",
            )),
        }
    }

    /// Positions of the cameras of a picture, in degrees to the right and upwards from straight
    /// ahead: one position, or all positions of a swing around straight ahead.
    ///
    /// # Errors
    /// The errors of [`Self::picture_camera`].
    pub fn picture_turns(&self) -> Result<Vec<[f32; 2]>, SettingError> {
        Ok(picture_turns(self.picture_camera()?, self.turntable))
    }

    /// Degrees to the right and upwards that `camera` gives for a picture.
    ///
    /// # Errors
    /// [`SettingError`] for another text.
    pub fn picture_camera(&self) -> Result<Option<[f32; 2]>, SettingError> {
        let Some(text) = &self.camera else { return Ok(None) };
        match numbers(text).as_deref() {
            Ok(&[right, up]) if right.abs() <= FARTHEST_DEG && up.abs() <= FARTHEST_DEG => {
                Ok(Some([right, up]))
            }
            _ => Err(SettingError::of(
                "camera",
                format!(
                    "of a picture takes degrees to the right and upwards (-80 to 80), found `{text}`"
                ),
                "try [camera=8,4]",
            )),
        }
    }

    fn mesh(
        &self,
        mesh: Mesh,
        origin: [f64; 3],
        mut inputs: Vec<PathBuf>,
    ) -> Result<OpenSubject, PictureError> {
        let width = self.width.map_or(WIDTH, |width| width as usize);
        let height = self.height.map_or(width * 3 / 4, |height| height as usize).max(1);
        let bounds = mesh.bounds();
        let aspect = width as f32 / height as f32;
        let cameras = match self.camera_file()? {
            Some(path) => {
                inputs.push(path.into());
                CameraPath::open(path)?.relative_to(origin).cameras(bounds)
            }
            None => {
                let framing = self.framing(aspect)?;
                match self.turntable {
                    Some(frames) => framing.fit_turntable(&mesh.positions, frames as usize),
                    None => vec![framing.fit(&mesh.positions)],
                }
            }
        };
        let subject = Subject::Mesh(Box::new(mesh), cameras, (width, height));
        Ok(OpenSubject { subject, inputs, origin })
    }

    /// The camera of a mesh that `camera` gives in degrees, for pictures of this aspect.
    ///
    /// # Errors
    /// [`SettingError`] for a text that gives no camera.
    pub fn framing(&self, aspect: f32) -> Result<Framing, SettingError> {
        let usual = Framing { aspect, ..Framing::default() };
        let Some(text) = &self.camera else { return Ok(usual) };
        let (azimuth_deg, elevation_deg, field_of_view_deg) = match numbers(text).as_deref() {
            Ok(&[azimuth, elevation]) => (azimuth, elevation, usual.field_of_view_deg),
            Ok(&[azimuth, elevation, field]) => (azimuth, elevation, field),
            _ => return Err(no_framing(text)),
        };
        let in_range = azimuth_deg.is_finite()
            && (-90.0..=90.0).contains(&elevation_deg)
            && (1.0..=170.0).contains(&field_of_view_deg);
        if !in_range {
            return Err(no_framing(text));
        }
        Ok(Framing { azimuth_deg, elevation_deg, field_of_view_deg, aspect })
    }
}

fn shape(name: &str) -> Result<SampleModel, SettingError> {
    SampleModel::from_name(name).ok_or_else(|| {
        let names = SampleModel::ALL.map(SampleModel::name);
        let similar = did_you_mean(name, names).map_or_else(String::new, |s| s + " ");
        let hint = format!("{similar}shapes are {}", names.join(", "));
        SettingError::whole(format!("unknown shape `{name}`"), "").verbatim(hint)
    })
}

/// Numbers that commas separate.
fn numbers(text: &str) -> Result<Vec<f32>, std::num::ParseFloatError> {
    text.split(',').map(|number| number.trim().parse()).collect()
}

fn no_framing(text: &str) -> SettingError {
    let reason = format!(
        "takes degrees around the mesh, above the horizon (-90 to 90) and of the view (1 to 170), or a .toml file, found `{text}`"
    );
    SettingError::of("camera", reason, "try [camera=30,20]")
}

/// Whether a file is a mesh. Its ending decides. Standard input is a mesh if it does not begin like
/// a picture.
fn is_mesh(path: &Path) -> Result<bool, PictureError> {
    if is_standard_input(path) {
        return Ok(!begins_like_picture(&read(path)?));
    }
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    Ok(matches!(ending.as_deref(), Some("obj" | "gltf" | "glb" | "ply")))
}

/// Positions of the cameras of a picture, in degrees to the right and upwards from straight ahead.
/// Without `frames` this is the position `way`, or straight ahead without a `way`.
/// With `frames`, it is so many positions of a swing around straight ahead, as wide as `way`, or a
/// small swing without a `way`.
#[must_use]
pub fn picture_turns(way: Option<[f32; 2]>, frames: Option<u64>) -> Vec<[f32; 2]> {
    let Some(frames) = frames else { return vec![way.unwrap_or_default()] };
    let [right, up] = way.unwrap_or([SWING_DEG, SWING_DEG / 2.0]);
    (0..frames)
        .map(|frame: u64| {
            let (sin, cos) = (std::f32::consts::TAU * frame as f32 / frames as f32).sin_cos();
            [right * sin, up * cos]
        })
        .collect()
}
