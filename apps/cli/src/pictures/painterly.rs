//! `impasto painterly` paints 3D models and pictures in the brushwork of art maps. You can give
//! directions of strokes, and the depth of a picture.

use std::path::PathBuf;

use clap::{Args, value_parser};
use paint::ground::GroundKind;
use painterly::Painter;
use pictures::{
    MOST_FRAMES, PainterlyRequest, PictureOutcome, PictureRequest, PigmentRequest,
    TechniqueOutcome, TechniqueRequest,
};
use serde_json::json;

use super::animation::{AnimationOptions, SubjectOptions};
use super::engine::BackendOption;
use super::exports::{Exports, frames_text, grounds, painted};
use super::technique::{ShowPreset, StyleOptions, Styled};
use crate::console::Console;
use crate::failure::Result;
use crate::library_choice::named_or_default;

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
    /// Write all intermediate stages of the picture into this folder, as PNG: depth, and for each layer
    /// its strokes, directions, tones and paint
    #[arg(long, value_name = "FOLDER", help_heading = "Exports")]
    stages: Option<PathBuf>,
    /// Let strokes flow in a loop of this number of frames, seen from a camera that stands still
    /// (for --animation)
    #[arg(long = "loop", value_name = "FRAMES", value_parser = value_parser!(u64).range(1..=MOST_FRAMES),
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
        let outcome = painted(&self.request()?, console)?;
        print(&outcome, self.json, console)
    }

    /// The picture of these options.
    fn request(&self) -> Result<PictureRequest> {
        let BrushworkOptions { map, style, regions } = &self.brushwork;
        let FormOptions { directions, depth } = &self.form;
        let PigmentOptions { with_pigments, palette, ground, .. } = &self.pigments;
        Ok(PictureRequest {
            subject: self.subject.clone().unwrap_or_default(),
            technique: TechniqueRequest::Painterly(PainterlyRequest {
                map: map.clone(),
                style: style.clone(),
                regions: regions.clone(),
                directions: directions.clone(),
                depth: depth.clone(),
                loop_frames: self.loop_frames,
                exr_frames: self.exr_frames.clone(),
                with_pigments: *with_pigments,
                ground: ground.name().to_owned(),
            }),
            view: self.subject_options.request(),
            style: self.settings.request(),
            pigments: PigmentRequest {
                library: self.pigments.library()?,
                palette: palette.clone(),
                ..PigmentRequest::default()
            },
            exports: self.exports.request(),
            stages: self.stages.clone(),
            animation: self.animation.request(),
            device: self.backend.device(),
        })
    }
}

/// Prints the summary of a run.
fn print(outcome: &PictureOutcome, as_json: bool, console: &mut Console<'_>) -> Result<()> {
    let PictureOutcome { size: (width, height), backend, technique, .. } = outcome;
    let TechniqueOutcome::Painterly { strokes, layers, matched, maps, regions } = technique else {
        return Ok(());
    };
    if as_json {
        return console.json(&json!({
            "size": [width, height],
            "backend": backend,
            "strokes": strokes,
            "layers": layers,
            "matched": matched,
            "maps": maps,
            "regions": regions,
            "frames": outcome.frames,
            "frames_found": outcome.frames_found,
        }));
    }
    let strokes = documents::counted(*strokes, "stroke");
    let share = 100.0 * matched;
    let line = format!("{width} x {height} pixels, {strokes}, {share:.0} % continue a neighbour");
    console.line(line + &frames_text(outcome))
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Brushwork")]
struct BrushworkOptions {
    /// The map (.exr, as `artmap build` writes it). MATERIAL=FILE is for the parts of a model with
    /// that material; may be repeated
    #[arg(long, value_name = "[MATERIAL=]FILE")]
    map: Vec<String>,
    /// Paint samples in this style and make a map of them, with the defaults of `artmap paint` and
    /// `artmap build`: oil-flat, oil-long, dabs, knife, hatching, dry-brush, or a file (.toml)
    /// [default: the style of the preset, or oil-flat]
    #[arg(long, value_name = "NAME|FILE")]
    style: Option<String>,
    /// Regions with a map, direction, size, flow or tones of their own (.toml)
    #[arg(long, value_name = "FILE")]
    regions: Option<PathBuf>,
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Subject")]
struct FormOptions {
    /// Directions of strokes: guides drawn as lines (.toml), or for a picture a PNG. Its red (to
    /// the right) and green (upwards) give the direction, where one half is 0, and its blue the
    /// strength of flow
    #[arg(long, value_name = "FILE")]
    directions: Option<PathBuf>,
    /// Depth of a picture: white is near, black is far (.png, .jpg, .tif, .webp). It makes a relief
    /// of the picture, which --camera and --turntable then turn
    #[arg(long, value_name = "FILE")]
    depth: Option<PathBuf>,
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Pigments")]
struct PigmentOptions {
    /// Paint the first picture with pigments, and show it as a painting, with relief and gloss; exports
    /// other than --picture imply it
    #[arg(long)]
    with_pigments: bool,
    /// Library of the pigments for the colours of a model or photograph [default: the library of the
    /// map, else the one in IMPASTO_LIBRARY, else the Van Gogh oils that ship]
    #[arg(value_name = "LIBRARY", group = "library_of_paint")]
    pigments: Option<PathBuf>,
    /// Old name of LIBRARY
    #[arg(long = "pigments", value_name = "LIBRARY", hide = true, group = "library_of_paint")]
    pigments_before: Option<PathBuf>,
    /// Up to eight pigments for the colours of the subject, separated by commas [default: the nearest
    /// ones]
    #[arg(long, value_name = "PIGMENTS")]
    palette: Vec<String>,
    /// Ground: linen, paper or panel
    #[arg(long, value_name = "KIND", default_value = "panel", value_parser = grounds())]
    ground: GroundKind,
}

impl PigmentOptions {
    /// The library that is given. A palette without one is of the default library.
    fn library(&self) -> Result<Option<PathBuf>> {
        match self.pigments.as_ref().or(self.pigments_before.as_ref()) {
            None if !self.palette.is_empty() => Ok(named_or_default(None)?.map(|(path, _)| path)),
            given => Ok(given.cloned()),
        }
    }
}

impl Styled for Painter {
    const USUAL: &'static str = "settings of their own";
}
