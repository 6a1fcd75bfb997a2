//! Options that export a painting, and the files that they write. Other pictures that verbs write
//! use the functions here too, for example sheets of samples.

use std::path::{Path, PathBuf};

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum, value_parser};
use documents::file::write_whole;
use documents::hint::Explain;
use graphics::export::{OutsideGamut, PictureFormat, picture_file};
use graphics::field::Field;
use graphics::picture::Picture;
use paint::export::{PaintingExports, SpectralBands};
use paint::ground::GroundKind;
use paint::painting::Painting;
use paint::scene::PixelsPerCell;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::output::{Output, OutputFolder, is_stream};
use crate::progress::waited;

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

/// Kind of a file that `--output` names, by its ending.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Picture,
    Layers,
    Painting,
}

impl Kind {
    /// The kind of a file, `None` for other endings. Without a name it is a picture.
    fn of(path: &Path) -> Option<Self> {
        if is_stream(path) {
            return Some(Self::Picture);
        }
        let ending = path.extension()?.to_string_lossy().to_lowercase();
        match ending.as_str() {
            "png" | "tif" | "tiff" => Some(Self::Picture),
            "ora" => Some(Self::Layers),
            "exr" => Some(Self::Painting),
            _ => None,
        }
    }
}

/// Export files that were checked to be writable.
pub(crate) struct OpenExports {
    options: Exports,
    picture: Option<Output>,
    layers: Option<Output>,
    spectral: Option<Output>,
    painting: Option<Output>,
    pigment_maps: Option<OutputFolder>,
}

impl Exports {
    /// Whether any export is requested.
    pub(crate) fn any(&self) -> bool {
        self.picture.is_some()
            || self.layers.is_some()
            || self.spectral.is_some()
            || self.pigment_maps.is_some()
            || !self.output.is_empty()
    }

    /// Whether `--output` names a file of this kind.
    fn has(&self, kind: Kind) -> bool {
        self.output.iter().any(|path| Kind::of(path) == Some(kind))
    }

    /// The one file of a kind, from its own option or from `--output`.
    fn one(&self, kind: Kind, own: Option<&PathBuf>) -> Result<Option<PathBuf>> {
        let named = self.output.iter().filter(|path| Kind::of(path) == Some(kind));
        let all: Vec<&PathBuf> = own.into_iter().chain(named).collect();
        match all[..] {
            [] => Ok(None),
            [one] => Ok(Some(one.clone())),
            [first, second, ..] => Err(Failure::usage(
                format!("{} and {} are of one kind", first.display(), second.display()),
                "write one of them, and the other in a second run",
            )),
        }
    }

    /// Refuses a file of `--output` with an ending that we do not know.
    fn check_endings(&self) -> Result<()> {
        let Some(path) = self.output.iter().find(|path| Kind::of(path).is_none()) else {
            return Ok(());
        };
        Err(Failure::usage(
            format!(
                "{}: expected a file name that ends in .png, .tif, .ora or .exr",
                path.display()
            ),
            format!(
                "try {} for a picture, or {} for the painting",
                path.with_extension("png").display(),
                path.with_extension("exr").display()
            ),
        ))
    }

    /// First option present that needs layers of pigments, not only a picture.
    pub(crate) fn layer_option(&self) -> Option<&'static str> {
        let options = [
            ("--supersample", self.supersample != 1),
            ("--layers", self.layers.is_some()),
            ("--output", self.has(Kind::Layers)),
            ("--spectral", self.spectral.is_some()),
            ("--pigment-maps", self.pigment_maps.is_some()),
            ("--output", self.has(Kind::Painting)),
        ];
        options.into_iter().find(|(_, present)| *present).map(|(option, _)| option)
    }

    /// Checks, before the slow part of a verb, that all files can be written.
    pub(crate) fn open(self, inputs: &[PathBuf]) -> Result<OpenExports> {
        let open = |path: &Option<PathBuf>, endings: &[&str]| {
            path.as_ref().map(|path| Output::with_ending(path, endings, inputs)).transpose()
        };
        self.check_endings()?;
        let named = self.one(Kind::Picture, self.picture.as_ref())?;
        if named.is_none() && self.supersample != 1 {
            return Err(Failure::usage("--supersample is of a picture", "add --output FILE.png"));
        }
        let picture = open(&named, &["png", "tif", "tiff", "exr"])?;
        let layers = open(&self.one(Kind::Layers, self.layers.as_ref())?, &["ora"])?;
        let spectral = open(&self.spectral, &["exr"])?;
        let painting = open(&self.one(Kind::Painting, None)?, &["exr"])?;
        let all = [&picture, &layers, &spectral, &painting];
        let all: Vec<&Output> = all.into_iter().flatten().collect();
        for (index, output) in all.iter().enumerate() {
            if all[..index].iter().any(|other| output.is_same_as(other)) {
                return Err(Failure::usage(
                    format!("{}: two exports have this file name", output.path().display()),
                    "give each export its own file name",
                ));
            }
        }
        let maps = self.pigment_maps.as_deref();
        let pigment_maps = maps.map(|folder| OutputFolder::open(folder, inputs)).transpose()?;
        if let Some(folder) = &pigment_maps {
            folder.check(["painting.csv".to_owned()])?;
        }
        Ok(OpenExports { picture, layers, spectral, painting, pigment_maps, options: self })
    }
}

impl OpenExports {
    /// Whether any export is requested.
    pub(crate) fn any(&self) -> bool {
        self.options.any()
    }

    /// Whether `other` is one of the export files.
    pub(crate) fn writes(&self, other: &Output) -> bool {
        let all = [&self.picture, &self.layers, &self.spectral, &self.painting];
        all.into_iter().flatten().any(|output| output.is_same_as(other))
    }

    /// Writes only the picture, from linear sRGB.
    pub(crate) fn write_picture(
        self,
        picture: &Field<[f32; 4]>,
        cell_mm: f64,
        console: &mut Console<'_>,
    ) -> Result<()> {
        let Some(output) = self.picture else { return Ok(()) };
        let format = self.options.bits.format(output.path());
        let file = picture_file(picture, cell_mm, format)?;
        remark_gamut(output.path(), file.outside_gamut(), console)?;
        output.write(file.bytes, console)
    }

    /// Computes all exports of `painting` and writes their files.
    pub(crate) fn write(self, painting: &mut Painting, console: &mut Console<'_>) -> Result<()> {
        let Exports { bits, bands, pigment_maps, supersample, .. } = self.options;
        if let Some(folder) = &self.pigment_maps {
            folder.make()?;
        }
        let path = |output: &Output| output.path().to_owned();
        let bands = match bands {
            Bands::Nodes => SpectralBands::Nodes,
            Bands::Full => SpectralBands::Full,
        };
        let exports = PaintingExports {
            picture: self.picture.as_ref().map(|output| (path(output), bits.format(output.path()))),
            pixels_per_cell: PixelsPerCell::new(supersample)?,
            layers: self.layers.as_ref().map(path),
            spectral: self.spectral.as_ref().map(|output| (path(output), bands)),
            pigment_maps,
            painting: self.painting.as_ref().map(path),
        };
        let mut streamed = Vec::new();
        let mut wrote = Vec::new();
        let mut keep = |path: &Path, bytes: &[u8]| {
            if is_stream(path) {
                streamed.push(bytes.to_vec());
                return Ok(());
            }
            wrote.push(path.to_owned());
            write_whole(path, bytes)
        };
        let outside = waited("making the files", console, || {
            exports.write_with(painting, &mut keep).map_err(Failure::from)
        })?;
        streamed.iter().try_for_each(|bytes| console.stream(bytes))?;
        if let Some(folder) = &exports.pigment_maps {
            wrote.retain(|path| path.parent() != Some(folder));
            wrote.push(folder.clone());
        }
        wrote.iter().try_for_each(|path| console.wrote(path))?;
        let picture = exports.picture.as_ref().map(|(path, _)| path);
        match picture.or(exports.layers.as_ref()) {
            Some(path) => remark_gamut(path, outside, console),
            None => Ok(()),
        }
    }
}

impl Bits {
    /// File format of a picture at `path`, from its extension and the bits of a PNG.
    fn format(self, path: &Path) -> PictureFormat {
        match (PictureFormat::from_path(path), self) {
            (Some(format @ (PictureFormat::LinearExr | PictureFormat::Tiff16)), _) => format,
            (_, Self::Eight) => PictureFormat::Png8,
            (_, Self::Sixteen) => PictureFormat::Png16,
        }
    }
}

/// Prints a remark if colours were outside the gamut.
fn remark_gamut(
    path: &Path,
    outside: Option<OutsideGamut>,
    console: &mut Console<'_>,
) -> Result<()> {
    match outside.map(|outside| gamut_remark(path, outside)) {
        Some(remark) => console.remark(remark),
        None => Ok(()),
    }
}

/// Remark on the colours of the picture at `path` that were outside its gamut.
pub(crate) fn gamut_remark(path: &Path, outside: OutsideGamut) -> String {
    let hint = outside.hint().map(|hint| format!("; {hint}")).unwrap_or_default();
    format!("{}: {outside}{hint}", path.display())
}

/// Width of a pixel of a picture to look at, in mm: 96 to the inch.
pub(crate) const PX_MM: f64 = 25.4 / 96.0;

/// Opens the output of a picture to look at.
pub(crate) fn picture_output(path: Option<&Path>, inputs: &[PathBuf]) -> Result<Option<Output>> {
    path.map(|path| Output::with_ending(path, &["png", "exr"], inputs)).transpose()
}

/// Refuses two outputs of one file name.
pub(crate) fn refuse_same(outputs: &[Option<&Output>]) -> Result<()> {
    let outputs: Vec<&Output> = outputs.iter().copied().flatten().collect();
    for (index, output) in outputs.iter().enumerate() {
        if outputs[..index].iter().any(|other| output.is_same_as(other)) {
            return Err(Failure::usage(
                format!("{}: two outputs have this file name", output.path().display()),
                "give each output its own file name",
            ));
        }
    }
    Ok(())
}

/// Encodes a picture of linear sRGB for `output`, with a remark on colours that it cannot hold.
pub(crate) fn picture_bytes(
    picture: &Picture,
    output: &Output,
    console: &mut Console<'_>,
) -> Result<Vec<u8>> {
    let opaque = picture.values().iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect();
    let opaque = Field::from_values(picture.width(), picture.height(), opaque);
    let format = PictureFormat::from_path(output.path()).unwrap_or_default();
    let file = picture_file(&opaque, PX_MM, format)?;
    if let Some(outside) = file.outside_gamut() {
        console.remark(gamut_remark(output.path(), outside))?;
    }
    Ok(file.bytes)
}

/// Names of the grounds to paint on.
pub(crate) fn grounds() -> impl TypedValueParser<Value = GroundKind> {
    let names = PossibleValuesParser::new(GroundKind::CANVASES.map(GroundKind::name));
    names.try_map(|name| name.parse::<GroundKind>())
}
