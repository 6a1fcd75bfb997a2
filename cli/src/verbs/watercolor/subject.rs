//! The subject: a photograph, or a mesh and its cameras.

use std::path::{Path, PathBuf};

use clap::Args;
use render::camera::{Camera, CameraPath, Framing};
use render::mesh::{Mesh, SampleModel};
use render::picture::Photograph;
use render::watercolor::PhotographPainter;

use crate::failure::{Failure, Result};

/// Number of triangles of a built-in model.
const TRIANGLES: usize = 60_000;
/// Smallest width or height that can be asked for, in pixels.
const LEAST: u64 = 16;
/// Largest width or height, in pixels.
const MOST: u64 = 16_384;
/// Width of a picture of a mesh unless told otherwise, in pixels.
const WIDTH: usize = 1000;

#[derive(Debug, Args)]
#[command(next_help_heading = "Subject")]
pub(super) struct SubjectOptions {
    /// Width of the picture in pixels [default: a photograph's own, its longer side at most 1600;
    /// of a mesh 1000]
    #[arg(long, value_name = "PX", value_parser = clap::value_parser!(u64).range(LEAST..=MOST))]
    width: Option<u64>,
    /// Height of the picture of a mesh in pixels [default: three quarters of the width]
    #[arg(long, value_name = "PX", value_parser = clap::value_parser!(u64).range(LEAST..=MOST))]
    height: Option<u64>,
    /// From where a mesh is seen, all of it in the picture: degrees around it and above the
    /// horizon, and the angle of view, as `30,20,30`; or a file of keyframes (.toml)
    #[arg(long, value_name = "DEG,DEG[,DEG]|FILE", allow_hyphen_values = true)]
    camera: Option<String>,
    /// Turn around a mesh in so many pictures
    #[arg(long, value_name = "FRAMES", value_parser = clap::value_parser!(u64).range(1..=100_000))]
    turntable: Option<u64>,
}

/// The subject to paint.
pub(super) enum Subject {
    /// A photograph, and the width of its picture in pixels.
    Photograph(Photograph, usize),
    /// A mesh, its cameras, and width and height of the pictures in pixels.
    Mesh(Box<Mesh>, Vec<Camera>, (usize, usize)),
}

impl SubjectOptions {
    /// Reads the subject, and returns it with the files it was read from.
    pub(super) fn subject(&self, path: &Path) -> Result<(Subject, Vec<PathBuf>)> {
        let text = path.to_string_lossy();
        if let Some(name) = text.strip_prefix("shape:") {
            let Some(shape) = SampleModel::from_name(name) else {
                let names = SampleModel::ALL.map(SampleModel::name).join(", ");
                return Err(Failure::usage(
                    format!("there is no shape `{name}`"),
                    format!("shapes are {names}"),
                ));
            };
            return self.mesh(shape.mesh(TRIANGLES), Vec::new());
        }
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        if let Some("obj" | "gltf" | "glb" | "ply") = ending.as_deref() {
            return self.mesh(Mesh::open(path)?, vec![path.to_owned()]);
        }
        for (option, given) in [
            ("--camera", self.camera.is_some()),
            ("--turntable", self.turntable.is_some()),
            ("--height", self.height.is_some()),
        ] {
            if given {
                return Err(Failure::usage(
                    format!("{option} is for meshes, and {text} is none"),
                    "meshes end in .obj, .gltf, .glb or .ply; shape:village is one too",
                ));
            }
        }
        let photograph = Photograph::open(path)?;
        let (own_width, height) = photograph.size();
        let usual = || PhotographPainter::usual_width_px(&photograph);
        let width = self.width.map_or_else(usual, |width| width as usize);
        let rows = (width as f64 * height as f64 / own_width as f64).round();
        if self.width.is_none() && width.max(height) < LEAST as usize {
            return Err(Failure::usage(
                format!("{text}: {width} x {height} pixels are too few for a picture"),
                format!("give --width {LEAST} or more"),
            ));
        }
        if rows > MOST as f64 {
            return Err(Failure::usage(
                format!(
                    "{text}: a picture has {MOST} pixels a side at most, and this has {rows} rows"
                ),
                "give a smaller --width",
            ));
        }
        Ok((Subject::Photograph(photograph, width), vec![path.to_owned()]))
    }

    fn mesh(&self, mesh: Mesh, mut inputs: Vec<PathBuf>) -> Result<(Subject, Vec<PathBuf>)> {
        let width = self.width.map_or(WIDTH, |width| width as usize);
        let height = self.height.map_or(width * 3 / 4, |height| height as usize).max(1);
        let bounds = mesh.bounds();
        let aspect = width as f32 / height as f32;
        let file = self.camera.as_deref().filter(|text| text.ends_with(".toml"));
        let cameras = match (file, self.turntable) {
            (Some(path), None) => {
                inputs.push(path.into());
                CameraPath::open(Path::new(path))?.cameras(bounds)
            }
            (Some(path), Some(_)) => {
                return Err(Failure::usage(
                    format!("--turntable moves the camera, and {path} does so too"),
                    "leave one of both out",
                ));
            }
            (None, turntable) => {
                let framing = self.framing(aspect)?;
                match turntable {
                    Some(frames) => framing.fit_turntable(&mesh.positions, frames as usize),
                    None => vec![framing.fit(&mesh.positions)],
                }
            }
        };
        Ok((Subject::Mesh(Box::new(mesh), cameras, (width, height)), inputs))
    }

    fn framing(&self, aspect: f32) -> Result<Framing> {
        let usual = Framing { aspect, ..Framing::default() };
        let Some(text) = &self.camera else { return Ok(usual) };
        let refused = || {
            Failure::usage(
                format!(
                    "--camera takes degrees around the mesh, above the horizon (-90 to 90) and of view (1 to 170), or a .toml file, found `{text}`"
                ),
                "--camera 30,20 is usual",
            )
        };
        let numbers: Result<Vec<f32>, _> = text.split(',').map(|n| n.trim().parse()).collect();
        let (azimuth_deg, elevation_deg, field_of_view_deg) =
            match numbers.map_err(|_| refused())?[..] {
                [azimuth, elevation] => (azimuth, elevation, usual.field_of_view_deg),
                [azimuth, elevation, field] => (azimuth, elevation, field),
                _ => return Err(refused()),
            };
        let fits = azimuth_deg.is_finite()
            && (-90.0..=90.0).contains(&elevation_deg)
            && (1.0..=170.0).contains(&field_of_view_deg);
        if !fits {
            return Err(refused());
        }
        Ok(Framing { azimuth_deg, elevation_deg, field_of_view_deg, aspect })
    }
}
