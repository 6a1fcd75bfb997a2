//! `impasto painterly`: paints 3D models in the brushwork of an art map.

mod brushwork;

mod settings;

use std::path::PathBuf;

use clap::{Args, value_parser};
use render::artmap::map::ArtMap;
use render::camera::Camera;
use render::encoding::{linear_from_encoded, over_white};
use render::export::frame_of;
use render::light::Light;
use render::mesh::Mesh;
use render::paint::engine::PaintEngine;
use render::paint::ground::{GroundKind, GroundSpec};
use render::paint::painting::Painting;
use render::painterly::{ModelPainter, Preset, Settings};
use serde_json::json;
use spectra::Viewing;

use crate::animation::{Animation, AnimationOptions, FramesDigest};
use crate::canvas::grounds;
use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::pictures::{Exports, OpenExports};
use crate::plain_picture::PX_MM;
use crate::subject::{Subject, SubjectOptions};
use brushwork::BrushworkOptions;
use settings::{SettingsOptions, preset_names};

/// Paint a 3D model in the brushwork of a painting
///
/// The model is covered with strokes of an art map. They run along its form, their tone follows the
/// light, and they stay on the surface while the camera moves (Yan, Chi, Lee and Lin 2008). Make a
/// map of a painting with `impasto artmap`, or name a style.
#[derive(Debug, Args)]
pub(crate) struct Painterly {
    /// A mesh (.obj, .gltf, .glb, .ply), or a built-in shape (shape:still-life, shape:village,
    /// shape:torus-knot, shape:sphere)
    #[arg(required_unless_present = "show_preset")]
    subject: Option<PathBuf>,
    /// Print the settings of a preset, each with its meaning, and do nothing else
    #[arg(long, value_name = "NAME", conflicts_with = "subject", value_parser = preset_names())]
    show_preset: Option<Preset>,
    /// Paint the first picture with the pigments of the map, and show it as a painting, with relief
    /// and gloss; exports other than --picture imply it
    #[arg(long, help_heading = "Exports")]
    with_pigments: bool,
    /// Ground of a painting with pigments: linen, paper or panel
    #[arg(long, value_name = "KIND", default_value = "panel", value_parser = grounds(), help_heading = "Exports")]
    ground: GroundKind,
    #[command(flatten)]
    exports: Exports,
    /// Let strokes flow in a loop of this number of frames, seen from a camera that stands still
    /// (for --animation)
    #[arg(long = "loop", value_name = "FRAMES", value_parser = value_parser!(u64).range(1..=100_000),
          conflicts_with = "turntable", help_heading = "Animation")]
    loop_frames: Option<u64>,
    /// Print JSON: size, strokes, matched, frames, frames_found
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    brushwork: BrushworkOptions,
    #[command(flatten)]
    settings: SettingsOptions,
    #[command(flatten)]
    subject_options: SubjectOptions,
    #[command(flatten)]
    animation: AnimationOptions,
}

impl Painterly {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        if let Some(preset) = self.show_preset {
            return console.line(preset.text().trim_end());
        }
        if !self.exports.any() && !self.animation.any() {
            return Err(Failure::usage(
                "nothing would be written",
                "add --picture painted.png, or --turntable 60 --animation turning.gif",
            ));
        }
        let settings = self.settings.settings()?;
        let path = self.subject.clone().unwrap_or_default();
        let (subject, mut inputs) = self.subject_options.subject(&path)?;
        let Subject::Mesh(mesh, cameras, size) = subject else {
            return Err(Failure::usage(
                format!("{}: only models are painted with a map", path.display()),
                "give a mesh (.obj, .gltf, .glb, .ply), or shape:still-life",
            ));
        };
        let cameras = self.frames(cameras, &settings)?;
        inputs.extend(self.brushwork.inputs().chain(self.settings.input().cloned()));
        let title = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let painting = self.painting(&title.unwrap_or_default());
        let animation = self.animation.open(&inputs)?;
        let exports = self.exports.open(&inputs)?;
        let file = animation.as_ref().and_then(Animation::file);
        if let Some(file) = file.filter(|file| exports.writes(file)) {
            return Err(Failure::usage(
                format!(
                    "{}: the picture and the animation have this file name",
                    file.path().display()
                ),
                "give each its own file name",
            ));
        }
        let map = self.brushwork.map(console)?;
        let job = Job { settings, cameras, size, painting, exports, animation };
        let summary = job.paint(&mesh, &map, console)?;
        summary.print(self.json, console)
    }

    /// Title and ground of a painting, if the picture is one.
    fn painting(&self, title: &str) -> Option<(String, GroundSpec)> {
        let wanted = self.with_pigments || self.exports.layer_option().is_some();
        wanted.then(|| (title.to_owned(), self.ground.spec(1)))
    }

    /// The cameras of all frames.
    fn frames(&self, cameras: Vec<Camera>, settings: &Settings) -> Result<Vec<Camera>> {
        let Some(&first) = cameras.first() else {
            return Err(Failure::data("the camera path has no frames", "give frames = 60"));
        };
        let Some(frames) = self.loop_frames else {
            if cameras.len() < 2 && self.animation.any() {
                return Err(Failure::usage(
                    "--animation and --frames need a camera or strokes that move",
                    "add --turntable 60, --camera path.toml with keyframes, or --loop 48",
                ));
            }
            return Ok(cameras);
        };
        if cameras.len() > 1 {
            return Err(Failure::usage(
                "--loop needs a camera that stands still",
                "leave out --loop: strokes flow while the camera moves too",
            ));
        }
        if settings.flow.periods == 0 {
            return Err(Failure::usage(
                "strokes do not flow with these settings",
                "add --set flow.periods=1",
            ));
        }
        Ok(vec![first; frames as usize])
    }
}

/// What is painted, and where it is written.
struct Job {
    settings: Settings,
    cameras: Vec<Camera>,
    size: (usize, usize),
    /// Title and ground of a painting with pigments, if it is one.
    painting: Option<(String, GroundSpec)>,
    exports: OpenExports,
    animation: Option<Animation>,
}

impl Job {
    fn paint(self, mesh: &Mesh, map: &ArtMap, console: &mut Console<'_>) -> Result<Summary> {
        let Self { settings, cameras, size, painting, exports, animation } = self;
        let mut painter = ModelPainter::new(mesh, map, &settings)?;
        let recording = match animation {
            None => None,
            Some(animation) => {
                let digest = FramesDigest::default()
                    .add(&env!("CARGO_PKG_VERSION"))
                    .add(&settings)
                    .add(&cameras)
                    .add(&mesh)
                    .add(map);
                Some(animation.begin(digest, cameras.len(), size)?)
            }
        };
        let strokes = painter.splats(&cameras[0], size, 0.0)?.1.len();
        match painting {
            _ if !exports.any() => {}
            Some((title, ground)) => {
                let document = painter.painting(&cameras[0], size, 0.0, (&title, &ground))?;
                let engine = PaintEngine::on_cpu(document.ground.height.clone());
                let light = Light::new(&document.library, &Viewing::default())?;
                exports.write(&mut Painting::open_under(document, light, engine, 0)?, console)?;
            }
            None => {
                let painted = painter.paint(&cameras[0], size, 0.0)?;
                let linear = linear_from_encoded(&over_white(&painted.color));
                exports.write_picture(&linear, PX_MM, console)?;
            }
        }
        let mut frames = None;
        if let Some(recording) = recording {
            let count = cameras.len();
            let found = recording.paint(console, |index| {
                // One loop of the flow over all frames.
                let seconds = f64::from(settings.flow.loop_seconds) * index as f64 / count as f64;
                let painted = painter.paint(&cameras[index], size, seconds)?;
                Ok(frame_of(&over_white(&painted.color)))
            })?;
            frames = Some((count, found));
        }
        Ok(Summary { size, strokes, matched: painter.matched(), frames })
    }
}

/// Summary of a finished run.
struct Summary {
    /// Width and height in pixels.
    size: (usize, usize),
    /// Number of strokes of the first picture.
    strokes: usize,
    /// Share of strokes that continue a neighbour.
    matched: f64,
    /// Number of frames of an animation, and the number of these that existed already.
    frames: Option<(usize, usize)>,
}

impl Summary {
    fn print(&self, as_json: bool, console: &mut Console<'_>) -> Result<()> {
        let Self { size: (width, height), strokes, matched, frames } = self;
        if as_json {
            return console.json(&json!({
                "size": [width, height],
                "strokes": strokes,
                "matched": matched,
                "frames": frames.map(|(frames, _)| frames),
                "frames_found": frames.map(|(_, found)| found),
            }));
        }
        let mut line = format!(
            "{width} x {height} pixels, {strokes} strokes, {:.0} % continue a neighbour",
            100.0 * matched
        );
        if let Some((frames, found)) = frames {
            line += &format!(", {frames} frames");
            if *found > 0 {
                line += &format!(" ({found} of them existed already)");
            }
        }
        console.line(line)
    }
}
