//! What a painting can be exported as: the options, and the files.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::{Args, ValueEnum};
use render::export::{self, PictureFormat, painting_maps, pigment_maps, spectral_file};
use render::field::Field;
use render::paint::file;
use render::paint::painting::Painting;

use crate::console::Console;
use crate::failure::Refusal;
use crate::output::Output;

/// Bits of a channel of a PNG.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum Bits {
    #[value(name = "8")]
    Eight,
    #[value(name = "16")]
    Sixteen,
}

/// Which wavelengths a spectral picture holds.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum SpectralBands {
    /// The eight that the picture was computed with
    Nodes,
    /// All of the library's, computed anew in double precision
    Full,
}

/// The files to make of a painting.
#[derive(Debug, Clone, Args)]
pub(crate) struct Exports {
    /// Write the picture: .png (sRGB) or .exr (linear sRGB, nothing clipped)
    #[arg(long, value_name = "FILE", help_heading = "Exports")]
    picture: Option<PathBuf>,
    /// Bits of a channel of a PNG picture
    #[arg(long, value_enum, default_value = "8", help_heading = "Exports")]
    bits: Bits,
    /// Write a spectral OpenEXR: the reflectance of every cell, without relief and gloss
    #[arg(long, value_name = "FILE", help_heading = "Exports")]
    spectral: Option<PathBuf>,
    /// Wavelengths of --spectral
    #[arg(long, value_enum, default_value = "nodes", help_heading = "Exports")]
    bands: SpectralBands,
    /// Write a map of each pigment into this folder (16-bit PNG, the scale in JSON, the
    /// amounts in CSV), summed over all layers
    #[arg(long, value_name = "FOLDER", help_heading = "Exports")]
    pigment_maps: Option<PathBuf>,
    /// Write the painting itself, with all that can be changed later (.exr)
    #[arg(long, value_name = "FILE", help_heading = "Exports")]
    output: Option<PathBuf>,
}

/// Files known to be writable.
pub(crate) struct OpenExports {
    options: Exports,
    picture: Option<Output>,
    spectral: Option<Output>,
    painting: Option<Output>,
}

impl Exports {
    /// Whether any file was asked for.
    pub(crate) fn any(&self) -> bool {
        self.picture.is_some()
            || self.spectral.is_some()
            || self.pigment_maps.is_some()
            || self.output.is_some()
    }

    /// An option that only a painting can fulfil, if one was given.
    pub(crate) fn of_paint(&self) -> Option<&'static str> {
        let options = [
            ("--spectral", self.spectral.is_some()),
            ("--pigment-maps", self.pigment_maps.is_some()),
            ("--output", self.output.is_some()),
        ];
        options.into_iter().find(|(_, given)| *given).map(|(option, _)| option)
    }

    /// Checks, before the slow part, that all can be written.
    pub(crate) fn open(self, inputs: &[PathBuf]) -> anyhow::Result<OpenExports> {
        let wanted = |path: &Option<PathBuf>, endings: &[&str]| -> anyhow::Result<_> {
            let Some(path) = path else { return Ok(None) };
            let found = path.extension().map(|e| e.to_string_lossy().to_lowercase());
            if !endings.iter().any(|ending| found.as_deref() == Some(ending)) {
                return Err(Refusal::usage(
                    format!("{}: this file ends in .{}", path.display(), endings.join(" or .")),
                    format!("try {}", path.with_extension(endings[0]).display()),
                ));
            }
            Ok(Some(Output::open(path, inputs)?))
        };
        let picture = wanted(&self.picture, &["png", "exr"])?;
        let spectral = wanted(&self.spectral, &["exr"])?;
        let painting = wanted(&self.output, &["exr"])?;
        let all: Vec<&Output> = [&picture, &spectral, &painting].into_iter().flatten().collect();
        for (index, output) in all.iter().enumerate() {
            if all[..index].iter().any(|other| output.is_same_as(other)) {
                return Err(Refusal::usage(
                    format!("{}: two exports would be this file", output.path().display()),
                    "give each a name of its own",
                ));
            }
        }
        if let Some(folder) = &self.pigment_maps {
            let cannot = || format!("{}: this folder cannot be made", folder.display());
            std::fs::create_dir_all(folder).with_context(cannot)?;
            Output::open(&folder.join("painting.csv"), inputs)?;
        }
        Ok(OpenExports { picture, spectral, painting, options: self })
    }
}

impl OpenExports {
    /// Whether any file was asked for.
    pub(crate) fn any(&self) -> bool {
        self.options.any()
    }

    /// Whether `other` would be one of its files.
    pub(crate) fn writes(&self, other: &Output) -> bool {
        let all = [&self.picture, &self.spectral, &self.painting];
        all.into_iter().flatten().any(|output| output.is_same_as(other))
    }

    /// Writes the picture alone, which is linear sRGB.
    pub(crate) fn write_picture(
        self,
        picture: &Field<[f32; 4]>,
        cell_mm: f64,
        console: &mut Console<'_>,
    ) -> anyhow::Result<()> {
        match self.picture {
            Some(output) => write_picture(output, self.options.bits, picture, cell_mm, console),
            None => Ok(()),
        }
    }

    /// Computes and writes them.
    pub(crate) fn write(
        self,
        painting: &mut Painting,
        console: &mut Console<'_>,
    ) -> anyhow::Result<()> {
        let cell_mm = painting.cell_mm();
        if let Some(output) = self.picture {
            write_picture(output, self.options.bits, &painting.picture()?, cell_mm, console)?;
        }
        if self.spectral.is_none() && self.options.pigment_maps.is_none() && self.painting.is_none()
        {
            return Ok(());
        }
        let document = painting.document()?;
        if let Some(output) = self.spectral {
            let picture = painting.picture()?;
            let bands = match self.options.bands {
                SpectralBands::Nodes => export::Bands::Nodes,
                SpectralBands::Full => export::Bands::Full,
            };
            let made = spectral_file(&document, painting.light(), &picture, bands, |_| true)?;
            if let Some(bytes) = made {
                output.write(bytes)?;
            }
        }
        if let Some(folder) = self.options.pigment_maps {
            for file in pigment_maps("painting", &painting_maps(&document), cell_mm)? {
                Output::open(&folder.join(file.name), &[])?.write(file.bytes)?;
            }
        }
        if let Some(output) = self.painting {
            output.write(file::write(&document)?)?;
        }
        Ok(())
    }
}

fn write_picture(
    output: Output,
    bits: Bits,
    picture: &Field<[f32; 4]>,
    cell_mm: f64,
    console: &mut Console<'_>,
) -> anyhow::Result<()> {
    let (bytes, remark) = picture_file(output.path(), bits, picture, cell_mm)?;
    if let Some(remark) = remark {
        console.remark(remark)?;
    }
    output.write(bytes)
}

/// The picture in the format that its name says, and a remark on what that
/// format could not hold.
pub(crate) fn picture_file(
    path: &Path,
    bits: Bits,
    picture: &Field<[f32; 4]>,
    cell_mm: f64,
) -> anyhow::Result<(Vec<u8>, Option<String>)> {
    let exr = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr"));
    let format = match bits {
        _ if exr => PictureFormat::LinearExr,
        Bits::Eight => PictureFormat::Png8,
        Bits::Sixteen => PictureFormat::Png16,
    };
    let file = export::picture_file(picture, cell_mm, format)?;
    let share = 100.0 * file.clipped;
    let remark = format!(
        "{}: {share:.1} % of the cells are outside sRGB and were clipped; .exr keeps them",
        path.display()
    );
    Ok((file.bytes, (share >= 0.05).then_some(remark)))
}
