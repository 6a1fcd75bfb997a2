//! `impasto painterly` paints 3D models and pictures in the brushwork of art maps. You can give
//! directions of strokes, and the depth of a picture.

mod job;

use std::path::PathBuf;

use clap::{Args, value_parser};
use graphics::camera::{Camera, PictureView};
use graphics::mesh::{Guide, Mesh};
use painterly::guides::Guides;
use painterly::{FlowPicture, Form, Painter, PictureForm, Preset, Settings};

use crate::animation::{Animation, AnimationOptions};
use crate::console::Console;
use crate::engine::BackendOption;
use crate::failure::{Failure, Result};
use crate::output::StageFolder;
use crate::pictures::Exports;
use crate::readings::is_toml;
use crate::subject::{PictureViews, Subject, SubjectOptions};
use crate::technique::{ShowPreset, StyleOptions, Styled};
use job::{BrushworkOptions, ExrFrames, Job, PigmentOptions, Scene};

/// Paint a 3D model or a photograph in the brushwork of a painting
///
/// A model is covered with strokes of an art map. They run along its form, their tone follows the
/// light, and they stay on the surface while the camera moves (Yan, Chi, Lee and Lin 2008). A
/// photograph is painted in its own colours, with strokes along its edges. Make a map of a painting
/// with `impasto artmap`, or name a style.
#[derive(Debug, Args)]
pub(crate) struct Painterly {
    /// A photograph (.png, .jpg, .tif, .webp), a mesh (.obj, .gltf, .glb, .ply), or a built-in shape
    /// (shape:still-life, shape:village, shape:torus-knot, shape:sphere)
    #[arg(required_unless_present = "show_preset")]
    subject: Option<PathBuf>,
    #[command(flatten)]
    show_preset: ShowPreset<Painter>,
    #[command(flatten)]
    exports: Exports,
    /// Write each frame into this folder as OpenEXR, for compositing: colour and cover, depth, height
    /// of the brushwork, direction of strokes
    #[arg(long, value_name = "FOLDER", help_heading = "Animation")]
    exr_frames: Option<PathBuf>,
    /// Write every step to the picture into this folder, as PNG: depth, strokes, directions and tones
    /// of each layer, and what it paints
    #[arg(long, value_name = "FOLDER", help_heading = "Exports")]
    stages: Option<PathBuf>,
    /// Let strokes flow in a loop of this number of frames, seen from a camera that stands still
    /// (for --animation)
    #[arg(long = "loop", value_name = "FRAMES", value_parser = value_parser!(u64).range(1..=100_000),
          conflicts_with = "turntable", help_heading = "Animation")]
    loop_frames: Option<u64>,
    /// Print JSON: size, backend, strokes, layers, matched, maps, regions, frames, frames_found
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    backend: BackendOption,
    #[command(flatten)]
    brushwork: BrushworkOptions,
    #[command(flatten)]
    settings: StyleOptions<Painter>,
    #[command(flatten)]
    subject_options: SubjectOptions,
    #[command(flatten)]
    form: FormOptions,
    #[command(flatten)]
    animation: AnimationOptions,
    #[command(flatten)]
    pigments: PigmentOptions,
}

impl Painterly {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        if self.show_preset.print(console)? {
            return Ok(());
        }
        if !self.exports.any()
            && !self.animation.any()
            && self.stages.is_none()
            && self.exr_frames.is_none()
        {
            return Err(Failure::usage(
                "nothing would be written",
                "add --picture painted.png, or --turntable 60 --animation turning.gif",
            ));
        }
        let settings = self.settings.settings()?;
        let path = self.subject.clone().unwrap_or_default();
        let views = match self.form.has_depth() {
            true => PictureViews::Turned,
            false => PictureViews::Front,
        };
        let (subject, mut inputs) = self.subject_options.subject(&path, views)?;
        inputs.extend(self.brushwork.inputs());
        inputs.extend(self.form.inputs().chain(self.settings.input().cloned()));
        inputs.extend(self.pigments.input());
        let scene = self.scene(subject, &settings)?;
        let title = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let layers = self.exports.layer_option().is_some();
        let painting = self.pigments.materials(&title.unwrap_or_default(), layers, console)?;
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
        let stages = self.stages.as_deref();
        let stages = stages.map(|folder| StageFolder::open(folder, &inputs)).transpose()?;
        let exr_frames = self.exr_frames.as_deref();
        let exr_frames = exr_frames
            .map(|folder| ExrFrames::open(folder, scene.cameras.len(), &inputs))
            .transpose()?;
        let preset = self.settings.preset().unwrap_or(Preset::Impressionist);
        let maps = self.brushwork.maps(preset.style(), console)?;
        let compute = self.backend.compute(console)?;
        let job =
            Job { compute, settings, scene, painting, exports, stages, exr_frames, animation };
        let summary = job.paint(&maps, console)?;
        summary.print(self.json, console)
    }

    /// The subject with the cameras of all frames.
    fn scene(&self, subject: Subject, settings: &Settings) -> Result<Scene> {
        let (form, cameras, size) = match subject {
            Subject::Mesh(mesh, cameras, size) => {
                let guides = self.form.of_model(&mesh)?;
                (Form::Model(mesh, guides), cameras, size)
            }
            Subject::Photograph(photograph, width) => {
                let (own_width, own_height) = photograph.size();
                let rows = (width as f64 * own_height as f64 / own_width as f64).round() as usize;
                let size = (width, rows.max(1));
                let form = self.form.of_picture()?;
                let view = PictureView::of(photograph.size());
                let turns = self.subject_options.picture_turns()?;
                let cameras = turns.into_iter().map(|[right, up]| view.turned(right, up));
                (Form::Picture(photograph, form), cameras.collect(), size)
            }
        };
        Ok(Scene { form, cameras: self.frames(cameras, settings)?, size })
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
        let still = settings.flow.periods == 0 && settings.flow.twinkle == 0.0;
        if still && !self.brushwork.has_regions() {
            return Err(Failure::usage(
                "strokes do not flow with these settings",
                "add --set flow.periods=1, or --set flow.twinkle=0.2",
            ));
        }
        Ok(vec![first; frames as usize])
    }
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Subject")]
struct FormOptions {
    /// Directions of strokes: guides drawn as lines (.toml); or of a picture a PNG whose red (to the
    /// right) and green (upwards) point about one half, and whose blue is the strength of flow
    #[arg(long, value_name = "FILE")]
    directions: Option<PathBuf>,
    /// Depth of a picture, which makes a relief of it, before which --camera and --turntable move:
    /// white is near, black is far (.png, .jpg, .tif, .webp)
    #[arg(long, value_name = "FILE")]
    depth: Option<PathBuf>,
}

impl FormOptions {
    /// Files of the form.
    fn inputs(&self) -> impl Iterator<Item = PathBuf> {
        self.directions.iter().chain(&self.depth).cloned()
    }

    /// Whether a camera may turn a picture.
    fn has_depth(&self) -> bool {
        self.depth.is_some()
    }

    /// The form of a picture.
    fn of_picture(&self) -> Result<PictureForm> {
        let depth = self.depth.as_deref().map(PictureForm::depth_of).transpose()?;
        let mut form = PictureForm { depth, ..PictureForm::default() };
        match &self.directions {
            Some(path) if is_toml(path) => form.guides = PictureForm::guides_of(path)?,
            Some(path) => form.flow = Some(FlowPicture::open(path)?),
            None => {}
        }
        Ok(form)
    }

    /// The guides of a model.
    fn of_model(&self, mesh: &Mesh) -> Result<Vec<Guide>> {
        if let Some(path) = &self.depth {
            return Err(Failure::usage(
                format!("--depth {} is for pictures, and this is a model", path.display()),
                "leave out --depth: a model has its own",
            ));
        }
        let Some(path) = &self.directions else { return Ok(Vec::new()) };
        if !is_toml(path) {
            return Err(Failure::usage(
                format!("--directions {} is for pictures, and this is a model", path.display()),
                "draw guides over a view of the model: guides.toml",
            ));
        }
        let guides = Guides::open(path)?;
        let Some(camera) = guides.camera_around(&mesh.positions) else {
            return Err(Failure::data(
                format!("{}: the guides do not tell the camera of their view", path.display()),
                "add camera = [30.0, 20.0, 30.0] with the degrees of --camera",
            ));
        };
        Ok(guides.on_mesh(mesh, &camera)?)
    }
}

impl Styled for Painter {
    const USUAL: &'static str = "settings of their own";
}
