//! `impasto watercolor` paints photographs and meshes as watercolors. You can paint with calibrated
//! pigments instead of the colour model of Bousseau et al. (2006), write the stages before a
//! picture, or the frames of a moving camera.

use std::path::PathBuf;

use clap::Args;
use documents::Task;
use graphics::compute::Compute;
use graphics::encoding::{encoded_from_linear, linear_from_encoded};
use graphics::export::frame_of;
use graphics::picture::Photograph;
use paint::document::{Document, Lighting};
use paint::engine::PaintEngine;
use paint::light::Light;
use paint::painting::Painting;
use paint::technique::Technique;
use serde_json::json;
use watercolor::{Form, GlazePainter, Masks, Settings, WatercolorPainter};

use crate::animation::{Animation, AnimationOptions, FramesDigest};
use crate::console::Console;
use crate::engine::BackendOption;
use crate::failure::{Failure, Result};
use crate::output::{Output, StageFolder};
use crate::palette::palette;
use crate::pictures::{Exports, OpenExports};
use crate::progress::followed;
use crate::readings::{library, viewing};
use crate::subject::{PictureViews, Subject, SubjectOptions};
use crate::surface::ground;
use crate::technique::{ShowPreset, StyleOptions, Styled, painted, prepared, write_stages};

/// Paint a photograph or a 3D model as a watercolor
///
/// A photograph becomes flat regions (mean shift, then smoothed outlines), a mesh is shaded in a few
/// tones. Both are then painted alike: edges wobble with the paper's grain, pigment gathers at the
/// edges of washes, clouds and grains of pigment change its density, and a dry brush leaves the
/// hollows of the paper bare (Bousseau, Kaplan, Thollot and Sillion 2006). While a camera moves,
/// clouds and grains stay on the object.
#[derive(Debug, Args)]
pub(crate) struct Watercolor {
    /// A photograph (.png, .jpg, .tif, .webp), a mesh (.obj, .gltf, .glb, .ply), or a built-in shape
    /// (shape:still-life, shape:village, shape:torus-knot, shape:sphere)
    #[arg(required_unless_present = "show_preset")]
    subject: Option<PathBuf>,
    #[command(flatten)]
    show_preset: ShowPreset<WatercolorPainter>,
    #[command(flatten)]
    backend: BackendOption,
    /// Print JSON: size, backend, regions, frames, pigments
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    outputs: OutputOptions,
    #[command(flatten)]
    subject_options: SubjectOptions,
    #[command(flatten)]
    style: StyleOptions<WatercolorPainter>,
    #[command(flatten)]
    animation: AnimationOptions,
    #[command(flatten)]
    pigments: PigmentOptions,
}

impl Watercolor {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        if self.show_preset.print(console)? {
            return Ok(());
        }
        let path = self.subject.clone().unwrap_or_default();
        if !self.outputs.any() && !self.animation.any() {
            return Err(Failure::usage(
                "nothing would be written",
                "add --picture watercolor.png, --stages FOLDER, or --animation turning.gif",
            ));
        }
        let settings = self.style.settings()?;
        let pictures = settings.paper.scan.iter().chain(&settings.toon.greys);
        let mut inputs: Vec<PathBuf> = self.style.input().cloned().into_iter().collect();
        inputs.extend(pictures.map(PathBuf::from));
        inputs.extend(self.pigments.input().cloned());
        let (subject, files) = self.subject_options.subject(&path, PictureViews::Front)?;
        inputs.extend(files);
        inputs.extend(self.outputs.inputs());
        let still = match &subject {
            Subject::Photograph(..) => true,
            Subject::Mesh(_, cameras, _) => cameras.len() < 2,
        };
        if still && self.animation.any() {
            return Err(Failure::usage(
                "--animation and --frames need a mesh and a camera that moves",
                "add --turntable 60, or --camera path.toml with keyframes",
            ));
        }
        self.outputs.check(self.pigments.input().is_some())?;
        let glazes = self.pigments.glaze_painter(&settings, console)?;
        let animation = self.animation.open(&inputs)?;
        // Last, because it creates folders.
        let outputs = self.outputs.open(inputs, animation.as_ref().and_then(Animation::file))?;
        let title = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let title = title.unwrap_or_default();
        let job = Job { title, settings, glazes, outputs, animation };
        let compute = self.backend.compute(console)?;
        let summary = job.paint(subject, compute, console)?;
        print(&summary, self.json, console)
    }
}

/// Prints the summary of a run.
fn print(summary: &Summary, as_json: bool, console: &mut Console<'_>) -> Result<()> {
    let Summary { size: (width, height), backend, regions, frames, pigments } = summary;
    if as_json {
        return console.json(&json!({
            "size": [width, height],
            "backend": backend,
            "regions": regions,
            "frames": frames.map(|(frames, _)| frames),
            "frames_found": frames.map(|(_, found)| found),
            "pigments": pigments,
        }));
    }
    let mut line = format!("{width} x {height} pixels on {backend}");
    if let Some(regions) = regions {
        line += &format!(", {}", documents::counted(*regions, "region"));
    }
    if let Some((frames, found)) = frames {
        line += &format!(", {}", documents::counted(*frames, "frame"));
        if *found > 0 {
            line += &format!(" ({found} of them existed already)");
        }
    }
    if !pigments.is_empty() {
        line += &format!(", painted with {}", pigments.join(", "));
    }
    console.line(line)
}

impl Styled for WatercolorPainter {
    const USUAL: &'static str = "settings between the presets";
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Pigments")]
struct PigmentOptions {
    /// Paint with this library: every colour is matched by a glaze over the paper, and density
    /// becomes its thickness
    #[arg(value_name = "LIBRARY", group = "library_of_paint")]
    pigments: Option<PathBuf>,
    /// Old name of LIBRARY
    #[arg(long = "pigments", value_name = "LIBRARY", hide = true, group = "library_of_paint")]
    pigments_before: Option<PathBuf>,
    /// Up to eight pigments of the library, separated by commas [default: the ones nearest to the
    /// picture's colours]
    #[arg(long, value_name = "PIGMENTS", requires = "library_of_paint")]
    palette: Vec<String>,
    /// Reflectance of the paper as measured: 0 to 1, or a file of spectra (FILE#SAMPLE)
    /// [default: computed from the setting paper.colour]
    #[arg(long, value_name = "PAPER", requires = "library_of_paint")]
    over: Option<String>,
    /// Light: D65, A, FL11, 5600K, or the file of a lamp
    #[arg(long, value_name = "LIGHT", default_value = "D65", requires = "library_of_paint")]
    illuminant: String,
}

impl PigmentOptions {
    /// Path of the library, if given.
    fn input(&self) -> Option<&PathBuf> {
        self.pigments.as_ref().or(self.pigments_before.as_ref())
    }

    /// Creates the painter of glazes, if a library is given.
    fn glaze_painter(
        &self,
        settings: &Settings,
        console: &mut Console<'_>,
    ) -> Result<Option<GlazePainter>> {
        let Some(path) = self.input() else { return Ok(None) };
        let library = library(path)?;
        let palette = match self.palette.is_empty() {
            true => None,
            false => Some(palette(&self.palette, &library)?),
        };
        let paper = match &self.over {
            Some(text) => {
                let (paper, remark) = ground(text, console)?.on_grid(library.grid)?;
                console.remarks(&remark)?;
                paper
            }
            None => GlazePainter::paper_of_settings(settings, &library)?,
        };
        let lighting = Lighting { illuminant: self.illuminant.clone(), ..Lighting::default() };
        let light = Light::new(&library, &viewing(&lighting.illuminant, &lighting.observer)?)?;
        let painter = GlazePainter::new(library, paper, light, lighting);
        Ok(Some(match palette {
            Some(palette) => painter.with_palette(palette),
            None => painter,
        }))
    }
}

/// Opens a painting of glazes under the light that they were matched under.
fn open_painting(document: Document, glazes: &GlazePainter) -> Result<Painting> {
    let engine = PaintEngine::on_cpu(document.ground.height.clone());
    Ok(Painting::open_under(document, glazes.light().clone(), engine, 0)?)
}

#[derive(Debug, Args)]
struct OutputOptions {
    #[command(flatten)]
    exports: Exports,
    /// Write every intermediate stage into this folder, as PNG
    #[arg(long, value_name = "FOLDER", help_heading = "Exports")]
    stages: Option<PathBuf>,
    /// Mask of the dry brush, stretched over the picture: white where the brush is dry
    #[arg(long, value_name = "PICTURE", help_heading = "Style")]
    dry_brush_mask: Option<PathBuf>,
    /// Mask of the density changes, stretched over the picture: white where density changes
    #[arg(long, value_name = "PICTURE", help_heading = "Style")]
    density_mask: Option<PathBuf>,
}

/// Output files that were checked to be writable, and the masks.
struct OpenOutputs {
    exports: OpenExports,
    stages: Option<StageFolder>,
    dry_brush_mask: Option<PathBuf>,
    density_mask: Option<PathBuf>,
}

impl OutputOptions {
    /// Whether any output is requested.
    fn any(&self) -> bool {
        self.exports.any() || self.stages.is_some()
    }

    /// Paths of the masks.
    fn inputs(&self) -> impl Iterator<Item = PathBuf> {
        self.dry_brush_mask.iter().chain(&self.density_mask).cloned()
    }

    /// Refuses options that need pigments if the picture is painted without them.
    fn check(&self, pigments: bool) -> Result<()> {
        match self.exports.layer_option().filter(|_| !pigments) {
            None => Ok(()),
            Some(option) => Err(Failure::usage(
                format!("{option} needs pigments, but no library is given"),
                "name a LIBRARY after the subject, such as oils.json; for a linear picture --picture FILE.exr",
            )),
        }
    }

    /// Checks that all files can be written and overwrite neither the animation nor an input.
    fn open(self, inputs: Vec<PathBuf>, animation: Option<&Output>) -> Result<OpenOutputs> {
        let Self { exports, stages, dry_brush_mask, density_mask } = self;
        let exports = exports.open(&inputs)?;
        if let Some(animation) = animation.filter(|animation| exports.writes(animation)) {
            return Err(Failure::usage(
                format!(
                    "{}: the picture and the animation have this file name",
                    animation.path().display()
                ),
                "give each its own file name",
            ));
        }
        let stages = stages.map(|folder| StageFolder::open(&folder, &inputs)).transpose()?;
        Ok(OpenOutputs { exports, stages, dry_brush_mask, density_mask })
    }
}

impl OpenOutputs {
    /// Reads the masks.
    fn masks(&self) -> Result<Masks> {
        let open = |path: &Option<PathBuf>| path.as_deref().map(Photograph::open).transpose();
        Ok(Masks { dry_brush: open(&self.dry_brush_mask)?, density: open(&self.density_mask)? })
    }
}

/// Settings and outputs of one run.
struct Job {
    title: String,
    settings: Settings,
    glazes: Option<GlazePainter>,
    outputs: OpenOutputs,
    animation: Option<Animation>,
}

/// Summary of a finished run.
struct Summary {
    /// Width and height in pixels.
    size: (usize, usize),
    /// Name of the device.
    backend: String,
    /// Number of regions of a photograph.
    regions: Option<usize>,
    /// Number of frames of an animation, and the number of these that existed already.
    frames: Option<(usize, usize)>,
    /// Names of the pigments. Without a library this is empty.
    pigments: Vec<String>,
}

impl Job {
    /// Paints the subject. The picture and the stages show a mesh from the first camera, the animation from
    /// all cameras.
    fn paint(
        self,
        subject: Subject,
        compute: Compute,
        console: &mut Console<'_>,
    ) -> Result<Summary> {
        let Self { title, settings, mut glazes, outputs, animation } = self;
        let masks = outputs.masks()?;
        let mut digest = FramesDigest::default().add(&env!("CARGO_PKG_VERSION")).add(&settings);
        let (form, cameras, size) = match subject {
            Subject::Photograph(photograph, width) => {
                (Form::Photograph(photograph, width), None, None)
            }
            Subject::Mesh(mesh, cameras, size) => {
                digest = digest.add(&cameras);
                if animation.is_some() {
                    digest = digest.add(&mesh).add(&compute.name()).add(&glazes);
                    // The settings hold only the paths of these pictures, so add their content.
                    digest = digest.add(&settings.paper.scan.as_ref().map(std::fs::read));
                    digest = digest.add(&settings.toon.greys.as_ref().map(std::fs::read));
                    digest = digest.add(&masks.controls(size.0, size.1));
                }
                (Form::Model(mesh, size), Some(cameras), Some(size))
            }
        };
        let subject = watercolor::Subject { form, masks, compute };
        let mut painter = prepared::<WatercolorPainter>(subject, &settings, console)?;
        let size = size.unwrap_or_else(|| painter.size());
        let view = match &cameras {
            None => None,
            Some(cameras) => Some(cameras.first().ok_or_else(|| {
                Failure::data("the camera path has no frames", "give frames = 60")
            })?),
        };
        let count = cameras.as_ref().map_or(1, Vec::len);
        let recording = match animation {
            Some(animation) => Some(animation.begin(digest, count, size)?),
            None => None,
        };
        if let Some(folder) = &outputs.stages {
            write_stages(&mut painter, view, folder, console)?;
        }
        if outputs.exports.any() {
            match &mut glazes {
                None => {
                    let px_mm = painter.px_mm();
                    let picture = painted(&mut painter, view, console)?;
                    outputs.exports.write_picture(
                        &linear_from_encoded(&picture),
                        px_mm,
                        console,
                    )?;
                }
                Some(glazes) => {
                    let mut painting = followed(console, |task| -> Result<Painting> {
                        let document = painter.painting(view, (glazes, &title), task)?;
                        open_painting(document, glazes)
                    })?;
                    outputs.exports.write(&mut painting, console)?;
                }
            }
        }
        let mut frames = None;
        if let Some(recording) = recording {
            if let Some(glazes) = &mut glazes {
                // Pigments are chosen from the first camera, so that a resumed run chooses the same.
                painter.choose_pigments(view, glazes)?;
            }
            let task = Task::default();
            let found = recording.paint(console, |index| {
                let view = cameras.as_ref().map(|cameras| &cameras[index]);
                let picture = match &mut glazes {
                    None => painter.paint(view, &task)?,
                    Some(glazes) => {
                        let document = painter.painting(view, (glazes, "frame"), &task)?;
                        encoded_from_linear(&open_painting(document, glazes)?.picture()?)
                    }
                };
                Ok(frame_of(&picture))
            })?;
            frames = Some((count, found));
        }
        Ok(Summary {
            size,
            backend: painter.compute_name().to_owned(),
            regions: painter.regions(),
            frames,
            pigments: pigment_names(glazes.as_ref()),
        })
    }
}

/// Names of the pigments that the glazes use. Without glazes this is empty.
fn pigment_names(glazes: Option<&GlazePainter>) -> Vec<String> {
    glazes.iter().flat_map(|glazes| glazes.pigments()).map(str::to_owned).collect()
}
