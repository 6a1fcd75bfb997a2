//! Options for the subject: a photograph, or a mesh and its cameras.

use std::path::{Path, PathBuf};

use clap::Args;
use documents::file::{is_standard_input, read};
use documents::question;
use graphics::camera::{Camera, CameraPath, Framing};
use graphics::mesh::{Mesh, SampleModel};
use graphics::picture::Photograph;
use graphics::picture_formats::begins_like_picture;

use crate::failure::{Failure, Result};

/// Number of triangles of a built-in model, chosen by eye.
const TRIANGLES: usize = 60_000;
/// Smallest width or height of a picture, in pixels.
const LEAST: u64 = 16;
/// Largest width or height of a picture, in pixels.
const MOST: u64 = 16_384;
/// Degrees by which the camera of a picture swings to both sides.
const SWING_DEG: f32 = 8.0;
/// Degrees that a camera stands away from straight before a picture at most.
pub(crate) const FARTHEST_DEG: f32 = 80.0;
/// Default width of a picture of a mesh, in pixels.
const WIDTH: usize = 1000;

#[derive(Debug, Args)]
#[command(next_help_heading = "Subject")]
pub(crate) struct SubjectOptions {
    /// Width of the picture in pixels [default: a photograph's own, its longer side at most 1600;
    /// of a mesh 1000]
    #[arg(long, value_name = "PX", value_parser = clap::value_parser!(u64).range(LEAST..=MOST))]
    width: Option<u64>,
    /// Height of the picture of a mesh in pixels [default: three quarters of the width]
    #[arg(long, value_name = "PX", value_parser = clap::value_parser!(u64).range(LEAST..=MOST))]
    height: Option<u64>,
    /// Camera that shows all of a mesh: degrees around it and above the horizon, and the angle of
    /// view, such as `30,20,30`; or a file of keyframes (.toml). For a picture, if its camera may
    /// move: degrees to the right and upwards
    #[arg(long, value_name = "DEG,DEG[,DEG]|FILE", allow_hyphen_values = true)]
    camera: Option<String>,
    /// Turn the camera around a mesh in this number of frames; in front of a picture, if its camera
    /// may move, it swings
    #[arg(long, value_name = "FRAMES", value_parser = clap::value_parser!(u64).range(1..=100_000))]
    turntable: Option<u64>,
}

/// Cameras that may see a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PictureViews {
    /// The whole picture from the front.
    Front,
    /// From the front, or from where `--camera` and `--turntable` turn the camera.
    Turned,
    /// Any camera, with pictures of any shape.
    Free,
}

/// A model or picture to paint.
pub(crate) enum Subject {
    /// A photograph, and the width of the picture in pixels.
    Photograph(Photograph, usize),
    /// A mesh, its cameras, and the width and height of the pictures in pixels.
    Mesh(Box<Mesh>, Vec<Camera>, (usize, usize)),
}

impl SubjectOptions {
    /// Reads the subject. Returns it with the paths of the files that it was read from. `views` says
    /// how a picture may be seen.
    pub(crate) fn subject(
        &self,
        path: &Path,
        views: PictureViews,
    ) -> Result<(Subject, Vec<PathBuf>)> {
        let turned = views != PictureViews::Front;
        let free = views == PictureViews::Free;
        let text = path.to_string_lossy();
        if let Some(name) = text.strip_prefix("shape:") {
            let Some(shape) = SampleModel::from_name(name) else {
                let names = SampleModel::ALL.map(SampleModel::name);
                return Err(Failure::usage(
                    format!("unknown shape `{name}`"),
                    format!("{}shapes are {}", question(name, &names), names.join(", ")),
                ));
            };
            return self.mesh(shape.mesh(TRIANGLES), Vec::new());
        }
        if is_mesh(path)? {
            return self.mesh(Mesh::open(path)?, vec![path.to_owned()]);
        }
        for (option, present) in [
            ("--camera", self.camera.is_some() && !turned),
            ("--turntable", self.turntable.is_some() && !turned),
            ("--height", self.height.is_some() && !free),
        ] {
            if present {
                return Err(Failure::usage(
                    format!("{option} applies to meshes only, and {text} is not a mesh"),
                    "names of meshes end in .obj, .gltf, .glb or .ply; shape:village is a mesh too",
                ));
            }
        }
        let photograph = Photograph::open(path)?;
        let (own_width, height) = photograph.size();
        let width = self.width.map_or_else(|| photograph.usual_width_px(), |width| width as usize);
        let rows = (width as f64 * height as f64 / own_width as f64).round();
        if self.width.is_none() && width.max(height) < LEAST as usize {
            return Err(Failure::usage(
                format!("{text}: {width} x {height} pixels are too few for a picture"),
                format!("give --width {LEAST} or more"),
            ));
        }
        if rows > MOST as f64 {
            return Err(Failure::usage(
                format!("{text}: the picture would have {rows} rows of pixels, more than `{MOST}`"),
                "give a smaller --width",
            ));
        }
        Ok((Subject::Photograph(photograph, width), vec![path.to_owned()]))
    }

    /// Height of the picture in pixels, if it is given.
    pub(crate) fn height(&self) -> Option<usize> {
        self.height.map(|height| height as usize)
    }

    /// Whether options choose the camera.
    pub(crate) fn has_camera(&self) -> bool {
        self.camera.is_some() || self.turntable.is_some()
    }

    /// The subject at the same size, seen by the default camera.
    pub(crate) fn without_camera(&self) -> Self {
        Self { width: self.width, height: self.height, camera: None, turntable: None }
    }

    /// Number of frames of `--turntable`.
    pub(crate) fn turntable(&self) -> Option<u64> {
        self.turntable
    }

    /// The file of keyframes of `--camera`, if it names one.
    pub(crate) fn camera_file(&self) -> Result<Option<&Path>> {
        let is_file = |text: &&str| text.ends_with(".toml") || is_standard_input(Path::new(text));
        let text = self.camera.as_deref().filter(is_file);
        let Some(path) = text.map(Path::new) else { return Ok(None) };
        match self.turntable {
            None => Ok(Some(path)),
            Some(_) => Err(Failure::usage(
                format!("--turntable and {} both move the camera", path.display()),
                "leave one of them out",
            )),
        }
    }

    /// Positions of the cameras of a picture, in degrees to the right and upwards from straight
    /// before it: one position, or those of a swing around it.
    pub(crate) fn picture_turns(&self) -> Result<Vec<[f32; 2]>> {
        Ok(picture_turns(self.picture_camera()?, self.turntable))
    }

    /// Degrees to the right and upwards that `--camera` gives for a picture.
    pub(crate) fn picture_camera(&self) -> Result<Option<[f32; 2]>> {
        let Some(text) = &self.camera else { return Ok(None) };
        let numbers: Result<Vec<f32>, _> =
            text.split(',').map(|number| number.trim().parse()).collect();
        match numbers.as_deref() {
            Ok(&[right, up]) if right.abs() <= FARTHEST_DEG && up.abs() <= FARTHEST_DEG => {
                Ok(Some([right, up]))
            }
            _ => Err(Failure::usage(
                format!(
                    "--camera of a picture takes degrees to the right and upwards (-80 to 80), found `{text}`"
                ),
                "try --camera 8,4",
            )),
        }
    }

    fn mesh(&self, mesh: Mesh, mut inputs: Vec<PathBuf>) -> Result<(Subject, Vec<PathBuf>)> {
        let width = self.width.map_or(WIDTH, |width| width as usize);
        let height = self.height.map_or(width * 3 / 4, |height| height as usize).max(1);
        let bounds = mesh.bounds();
        let aspect = width as f32 / height as f32;
        let cameras = match self.camera_file()? {
            Some(path) => {
                inputs.push(path.into());
                CameraPath::open(path)?.cameras(bounds)
            }
            None => {
                let framing = self.framing(aspect)?;
                match self.turntable {
                    Some(frames) => framing.fit_turntable(&mesh.positions, frames as usize),
                    None => vec![framing.fit(&mesh.positions)],
                }
            }
        };
        Ok((Subject::Mesh(Box::new(mesh), cameras, (width, height)), inputs))
    }

    /// The camera of a mesh that `--camera` gives in degrees, for pictures of this aspect.
    pub(crate) fn framing(&self, aspect: f32) -> Result<Framing> {
        let usual = Framing { aspect, ..Framing::default() };
        let Some(text) = &self.camera else { return Ok(usual) };
        let invalid = || {
            Failure::usage(
                format!(
                    "--camera takes degrees around the mesh, above the horizon (-90 to 90) and of the view (1 to 170), or a .toml file, found `{text}`"
                ),
                "try --camera 30,20",
            )
        };
        let numbers: Result<Vec<f32>, _> = text.split(',').map(|n| n.trim().parse()).collect();
        let (azimuth_deg, elevation_deg, field_of_view_deg) =
            match numbers.map_err(|_| invalid())?[..] {
                [azimuth, elevation] => (azimuth, elevation, usual.field_of_view_deg),
                [azimuth, elevation, field] => (azimuth, elevation, field),
                _ => return Err(invalid()),
            };
        let in_range = azimuth_deg.is_finite()
            && (-90.0..=90.0).contains(&elevation_deg)
            && (1.0..=170.0).contains(&field_of_view_deg);
        if !in_range {
            return Err(invalid());
        }
        Ok(Framing { azimuth_deg, elevation_deg, field_of_view_deg, aspect })
    }
}

/// Whether a file is a mesh. Its ending decides. Standard input is a mesh if it does not begin like
/// a picture.
fn is_mesh(path: &Path) -> Result<bool> {
    if is_standard_input(path) {
        return Ok(!begins_like_picture(&read(path)?));
    }
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    Ok(matches!(ending.as_deref(), Some("obj" | "gltf" | "glb" | "ply")))
}

/// Degrees to the right and upwards of the cameras before a picture: `way` alone, or as many as
/// `frames` on a swing around it. Without a `way`, the camera is straight before the picture, and a
/// swing is small.
pub(crate) fn picture_turns(way: Option<[f32; 2]>, frames: Option<u64>) -> Vec<[f32; 2]> {
    let Some(frames) = frames else { return vec![way.unwrap_or_default()] };
    let [right, up] = way.unwrap_or([SWING_DEG, SWING_DEG / 2.0]);
    (0..frames)
        .map(|frame: u64| {
            let (sin, cos) = (std::f32::consts::TAU * frame as f32 / frames as f32).sin_cos();
            [right * sin, up * cos]
        })
        .collect()
}
