//! Options for the files of a picture or painting. Also long work behind a progress bar, which prints each file and
//! remark of the work, and the names of the grounds that you can paint on.

use std::path::PathBuf;

use clap::{
    Args, ValueEnum,
    builder::{PossibleValuesParser, TypedValueParser},
    value_parser,
};
use documents::{Task, counted};
use graphics::compute::Compute;
use paint::{ground::GroundKind, scene::PixelsPerCell};
use pictures::{ExportRequest, Listener, Note, PictureOutcome, PictureRequest};

use crate::console::{Console, without_noise};
use crate::failure::Result;
use crate::progress::Following;

/// Bits of a channel of a PNG.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum Bits {
    #[value(name = "8")]
    Eight,
    #[value(name = "16")]
    Sixteen,
}

/// Wavelengths of a spectral picture.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Bands {
    /// The eight wavelengths at which the picture is computed
    Nodes,
    /// All wavelengths of the library, computed again in double precision
    Full,
}

/// Options for the files that a painting is exported to.
#[derive(Debug, Clone, Args)]
pub(crate) struct Exports {
    /// Write a picture (.png, .tif), the layers (.ora), or the painting itself with all its layers, so
    /// that it can be changed later (.exr); may be repeated. With - a PNG goes to the output
    #[arg(short, long, value_name = "FILE", help_heading = "Exports")]
    output: Vec<PathBuf>,
    /// Write the picture: .png (sRGB), .tif (sRGB, 16 bits) or .exr (linear sRGB, as computed)
    #[arg(long, value_name = "FILE", help_heading = "Exports")]
    picture: Option<PathBuf>,
    /// Bits of a channel of a PNG picture
    #[arg(long, value_enum, default_value = "8", help_heading = "Exports")]
    bits: Bits,
    /// Pixels of the picture along the width of a cell, 1 to 4. With 2 or more you no longer see
    /// the cells, and the relief is lit between their centres too
    #[arg(
        long,
        value_name = "N",
        default_value_t = 1,
        value_parser = value_parser!(u8).range(1..=i64::from(PixelsPerCell::MOST)),
        help_heading = "Exports"
    )]
    supersample: u8,
    /// Write the layers for programs that paint in layers: OpenRaster (.ora) of 16 bits, with the
    /// ground, each dry layer and the wet paint. In this order and with normal opacity they show
    /// the picture. Real films do not mix by opacity, so another order or mode does not look like
    /// paint
    #[arg(long, value_name = "FILE", help_heading = "Exports")]
    layers: Option<PathBuf>,
    /// Write a spectral OpenEXR: the reflectance of every cell, without relief and gloss
    #[arg(long, value_name = "FILE", help_heading = "Exports")]
    spectral: Option<PathBuf>,
    /// Wavelengths of --spectral
    #[arg(long, value_enum, default_value = "nodes", help_heading = "Exports")]
    bands: Bands,
    /// Write a map of each pigment into this folder (16-bit PNG, the scale in JSON, the
    /// amounts in CSV), summed over all layers
    #[arg(long, value_name = "FOLDER", help_heading = "Exports")]
    pigment_maps: Option<PathBuf>,
}

impl Exports {
    /// The files of these options.
    pub(crate) fn request(&self) -> ExportRequest {
        ExportRequest {
            output: self.output.clone(),
            picture: self.picture.clone(),
            bits: match self.bits {
                Bits::Eight => 8,
                Bits::Sixteen => 16,
            },
            supersample: self.supersample,
            layers: self.layers.clone(),
            spectral: self.spectral.clone(),
            bands: match self.bands {
                Bands::Nodes => pictures::Bands::Nodes,
                Bands::Full => pictures::Bands::Full,
            },
            pigment_maps: self.pigment_maps.clone(),
        }
    }
}

/// Does long work behind a progress bar. If the work reports a note, we hide the bar for a moment and print the
/// note. If printing fails, the work ends early.
pub(crate) fn heard<T>(
    console: &mut Console<'_>,
    work: impl FnOnce(&Task, &mut Listener<'_>) -> Result<T>,
) -> Result<T> {
    let following = Following::new(console);
    let task = following.task();
    let mut printed = Ok(());
    let done = work(&task, &mut |note| {
        if printed.is_ok() {
            printed = following.paused(|| print(note, console));
        }
        if printed.is_err() {
            task.cancel();
        }
    });
    drop(following);
    printed?;
    done
}

fn print(note: Note, console: &mut Console<'_>) -> Result<()> {
    match note {
        Note::Remark(remark) => console.remarks(&[remark]),
        Note::Library { path, pigments } => {
            let pigments = counted(pigments, "pigment");
            console.detail(format!("library: {} ({pigments})", path.display()))
        }
        Note::Wrote(path) => console.wrote(&path),
        Note::Streamed(content) => console.stream(&content),
    }
}

/// Paints a picture and writes its files.
pub(crate) fn painted(
    request: &PictureRequest,
    console: &mut Console<'_>,
) -> Result<PictureOutcome> {
    let job = heard(console, |task, listener| Ok(request.open(task, listener)?))?;
    let compute = without_noise(console, || Compute::choose(job.device().into()))??;
    heard(console, |task, listener| Ok(job.paint(compute, task, listener)?))
}

/// The part of a summary that is about the frames of an animation, e.g. `, 25 frames`. Empty without an animation.
pub(crate) fn frames_text(outcome: &PictureOutcome) -> String {
    let Some(frames) = outcome.frames else { return String::new() };
    let found = match outcome.frames_found {
        None | Some(0) => String::new(),
        Some(found) => format!(" ({found} of them existed already)"),
    };
    format!(", {}{found}", counted(frames, "frame"))
}

/// Names of the grounds to paint on.
pub(crate) fn grounds() -> impl TypedValueParser<Value = GroundKind> {
    let names = PossibleValuesParser::new(GroundKind::CANVASES.map(GroundKind::name));
    names.try_map(|name| name.parse::<GroundKind>())
}
