//! `impasto watercolor`: paints photographs and meshes as watercolors.
//!
//! Options for the style of a watercolor: a preset, a file of settings, single settings.
//!
//! Options for painting with calibrated pigments instead of the colour model of Bousseau et al.
//! (2006).
//!
//! Options and files of single pictures: the finished one, and the stages before it.
//!
//! Settings of one watercolor, and the summary of the result.
//!
//! `impasto watercolor` of a photograph.
//!
//! `impasto watercolor` of a mesh: a picture, or the frames of a moving camera.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use graphics::camera::Camera;
use graphics::compute::Compute;
use graphics::encoding::{encoded_from_linear, linear_from_encoded};
use graphics::export::frame_of;
use graphics::mesh::Mesh;
use graphics::picture::Photograph;
use serde_json::json;
use watercolor::{GlazePainter, Masks, ModelPainter, PhotographPainter, Preset, Settings, Stage};

use crate::animation::{Animation, AnimationOptions, FramesDigest};
use crate::console::Console;
use crate::engine::BackendOption;
use crate::failure::{Failure, Result};
use crate::output::{NamedStage, Output, StageFolder};
use crate::palette::palette;
use crate::pictures::{Exports, OpenExports};
use crate::progress::{Waiting, waited};
use crate::readings::{library, text, viewing};
use crate::setting_changes::changes;
use crate::subject::{PictureViews, Subject, SubjectOptions};
use crate::surface::ground;
use paint::document::{Document, Document as MeshDocument, Lighting};
use paint::engine::PaintEngine;
use paint::light::Light;
use paint::painting::Painting;

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
    /// Print the settings of a preset, each with its meaning, and do nothing else
    #[arg(long, value_name = "NAME", conflicts_with = "subject", value_parser = preset_names())]
    show_preset: Option<Preset>,
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
    style: StyleOptions,
    #[command(flatten)]
    animation: AnimationOptions,
    #[command(flatten)]
    pigments: PigmentOptions,
}

impl Watercolor {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        if let Some(preset) = self.show_preset {
            return console.line(preset.text().trim_end());
        }
        let path = self.subject.clone().unwrap_or_default();
        if !self.outputs.any() && !self.animation.any() {
            return Err(Failure::usage(
                "nothing would be written",
                "add --picture watercolor.png, --stages FOLDER, or --animation turning.gif",
            ));
        }
        let (settings, mut inputs) = self.style.settings()?;
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
        let summary = match subject {
            Subject::Photograph(photograph, width) => {
                paint(compute, job, &photograph, width, console)?
            }
            Subject::Mesh(mesh, cameras, size) => {
                paint_mesh(compute, job, *mesh, &cameras, size, console)?
            }
        };
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

#[derive(Debug, Args)]
#[command(next_help_heading = "Style")]
struct StyleOptions {
    /// Preset of settings that ships with impasto [default: settings between the presets]
    #[arg(long, value_name = "NAME", value_parser = preset_names())]
    preset: Option<Preset>,
    /// Settings from a file (TOML); others keep the values of the preset
    #[arg(long, value_name = "FILE")]
    settings: Option<PathBuf>,
    /// Change one setting, such as `edges.strength=2` or `paper.kind=rough`; may be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
}

impl StyleOptions {
    /// Reads the settings. Returns them with the paths of the files that they use.
    fn settings(&self) -> Result<(Settings, Vec<PathBuf>)> {
        let mut settings = self.preset.map_or_else(Settings::default, Preset::settings);
        let mut inputs = Vec::new();
        if let Some(path) = &self.settings {
            let name = path.display().to_string();
            let text = text(path)?;
            let before = settings.clone();
            (settings.paper.scan, settings.toon.greys) = (None, None);
            settings = settings.changed(&name, &text)?;
            // Paths of pictures are relative to the settings file.
            let folder = path.parent().unwrap_or(Path::new(""));
            let beside = |named: Option<String>, before: Option<String>| {
                named.map(|file| folder.join(file).display().to_string()).or(before)
            };
            settings.paper.scan = beside(settings.paper.scan, before.paper.scan);
            settings.toon.greys = beside(settings.toon.greys, before.toon.greys);
            inputs.push(path.clone());
        }
        for change in changes(&self.set, "edges.strength=2")? {
            let changed = settings.changed(&change.name, &change.toml);
            settings = changed.map_err(|error| Failure::from(error).of_option())?;
        }
        let pictures = settings.paper.scan.iter().chain(&settings.toon.greys);
        inputs.extend(pictures.map(PathBuf::from));
        Ok((settings, inputs))
    }
}

/// Parses the name of a preset; an error lists the names.
fn preset_names() -> impl TypedValueParser<Value = Preset> {
    let names = PossibleValuesParser::new(Preset::ALL.map(Preset::name));
    names.try_map(|name| name.parse::<Preset>())
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Pigments")]
struct PigmentOptions {
    /// Paint with this library: every colour is matched by a glaze over the paper, and density
    /// becomes its thickness
    #[arg(value_name = "LIBRARY", group = "library_of_paint")]
    pigments: Option<PathBuf>,
    /// The library, as it was named before
    #[arg(long = "pigments", value_name = "LIBRARY", hide = true, group = "library_of_paint")]
    pigments_before: Option<PathBuf>,
    /// Up to eight pigments of the library, separated by commas [default: those that come nearest
    /// to the picture's colours]
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
    /// Whether the stages are to be written.
    fn wants_stages(&self) -> bool {
        self.stages.is_some()
    }

    /// Reads the masks.
    fn masks(&self) -> Result<Masks> {
        let open = |path: &Option<PathBuf>| path.as_deref().map(Photograph::open).transpose();
        Ok(Masks { dry_brush: open(&self.dry_brush_mask)?, density: open(&self.density_mask)? })
    }

    /// Writes the stages, numbered from 1 in their order.
    fn write_stages(&self, stages: &[NamedStage], console: &mut Console<'_>) -> Result<()> {
        self.stages.as_ref().map_or(Ok(()), |folder| folder.write(stages, console))
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
    /// Names of the pigments; empty without a library.
    pigments: Vec<String>,
}

/// Paints a photograph, and writes the picture and the stages.
fn paint(
    compute: Compute,
    job: Job,
    photograph: &Photograph,
    width: usize,
    console: &mut Console<'_>,
) -> Result<Summary> {
    let Job { title, settings, mut glazes, outputs, .. } = job;
    let mut painter = PhotographPainter::new(settings)
        .with_compute(compute)
        .with_width_px(width)
        .with_masks(outputs.masks()?);
    let waiting = Waiting::new("finding regions", console.shows_progress());
    let prepared = painter.prepare(photograph)?;
    let regions = Some(prepared.regions);
    drop(waiting);
    let mut stages: Vec<NamedStage> = Vec::new();
    let mut picture = None;
    if outputs.wants_stages() {
        let (width, height) = painter.picture_size(photograph);
        stages.push(("photograph".to_owned(), photograph.with_opacity(width, height)));
        stages.push(("regions".to_owned(), prepared.flat_regions()));
        let mut keep = |stage: Stage, color| {
            stages.push((stage.name().to_owned(), color));
        };
        picture = Some(painter.paint_prepared(&prepared, Some(&mut keep))?);
        outputs.write_stages(&stages, console)?;
    }
    if outputs.exports.any() {
        match &mut glazes {
            None => {
                let px_mm = prepared.textures.paper.px_mm;
                let picture = match picture {
                    Some(picture) => picture,
                    None => waited("painting", console, || painter.finish(prepared))?,
                };
                outputs.exports.write_picture(&linear_from_encoded(&picture), px_mm, console)?;
            }
            Some(glazes) => {
                let waiting = Waiting::new("mixing glazes", console.shows_progress());
                let wash = &prepared.wash;
                let textures = &prepared.textures;
                let document = glazes.paint(&title, wash, textures, &prepared.settings)?;
                let mut painting = open_painting(document, glazes)?;
                drop(waiting);
                outputs.exports.write(&mut painting, console)?;
            }
        }
    }
    Ok(Summary {
        size: painter.picture_size(photograph),
        backend: painter.compute_name().to_owned(),
        regions,
        frames: None,
        pigments: pigment_names(glazes.as_ref()),
    })
}

/// Names of the pigments that the glazes use; empty without glazes.
fn pigment_names(glazes: Option<&GlazePainter>) -> Vec<String> {
    glazes.iter().flat_map(|glazes| glazes.pigments()).map(str::to_owned).collect()
}

/// Paints a mesh. The picture and the stages show it from the first camera, the animation from all
/// cameras.
fn paint_mesh(
    compute: Compute,
    job: Job,
    mesh: Mesh,
    cameras: &[Camera],
    size: (usize, usize),
    console: &mut Console<'_>,
) -> Result<Summary> {
    let Job { title, settings, mut glazes, outputs, animation } = job;
    let (width, height) = size;
    let controls = outputs.masks()?.controls(width, height);
    let mut digest =
        FramesDigest::default().add(&env!("CARGO_PKG_VERSION")).add(&settings).add(&cameras);
    if animation.is_some() {
        digest = digest.add(&mesh).add(&compute.name()).add(&glazes);
        // The settings hold only the paths of these pictures, so add their content.
        digest = digest.add(&settings.paper.scan.as_ref().map(std::fs::read));
        digest = digest.add(&settings.toon.greys.as_ref().map(std::fs::read));
        digest = digest.add(&controls);
    }
    let mut painter = waited("preparing the model", console, || {
        ModelPainter::new(compute, mesh, &settings, size)
    })?;
    painter.set_controls(controls);
    let Some(first) = cameras.first() else {
        return Err(Failure::data("the camera path has no frames", "give frames = 60"));
    };
    let recording = match animation {
        Some(animation) => Some(animation.begin(digest, cameras.len(), size)?),
        None => None,
    };
    if outputs.wants_stages() {
        let mut stages = vec![("surface".to_owned(), painter.unlit(first)?)];
        let mut keep = |stage: Stage, color| stages.push((stage.name().to_owned(), color));
        painter.paint_stages(first, Some(&mut keep))?;
        outputs.write_stages(&stages, console)?;
    }
    if outputs.exports.any() {
        match &mut glazes {
            None => {
                let painted = waited("painting", console, || painter.paint(first))?;
                let picture = linear_from_encoded(&painted);
                outputs.exports.write_picture(&picture, painter.paper().px_mm, console)?;
            }
            Some(glazes) => {
                let document = waited("painting", console, || -> Result<MeshDocument> {
                    let (wash, textures) = painter.wash(first)?;
                    Ok(glazes.paint(&title, &wash, &textures, painter.settings())?)
                })?;
                outputs.exports.write(&mut open_painting(document, glazes)?, console)?;
            }
        }
    }
    let mut frames = None;
    if let Some(recording) = recording {
        if let Some(glazes) = &mut glazes {
            // Pigments are chosen from the first camera, so that a resumed run chooses the same.
            glazes.choose(&painter.wash(first)?.0)?;
        }
        let found = recording.paint(console, |index| {
            let camera = &cameras[index];
            let picture = match &mut glazes {
                None => painter.paint(camera)?,
                Some(glazes) => {
                    let (wash, textures) = painter.wash(camera)?;
                    let document = glazes.paint("frame", &wash, &textures, painter.settings())?;
                    encoded_from_linear(&open_painting(document, glazes)?.picture()?)
                }
            };
            Ok(frame_of(&picture))
        })?;
        frames = Some((cameras.len(), found));
    }
    Ok(Summary {
        size,
        backend: painter.compute_name().to_owned(),
        regions: None,
        frames,
        pigments: pigment_names(glazes.as_ref()),
    })
}
