//! What a painting can be exported as: the options, and the files.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::{Args, ValueEnum};
use render::amount::mm_from_quanta;
use render::export::{FloatBits, PigmentMap, linear_exr, pigment_maps, png8, png16, spectral_exr};
use render::field::Field;
use render::layer::{Layer, SLOTS};
use render::paint::document::{Document, Slots};
use render::paint::file;
use render::paint::painting::Painting;
use render::paint::scene::Spectral;

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
    /// Computes and writes them.
    pub(crate) fn write(
        self,
        painting: &mut Painting,
        console: &mut Console<'_>,
    ) -> anyhow::Result<()> {
        let cell_mm = painting.cell_mm();
        if let Some(output) = self.picture {
            let path = self.options.picture.unwrap_or_default();
            let picture = painting.picture()?;
            let (bytes, remark) = picture_file(&path, self.options.bits, &picture, cell_mm)?;
            if let Some(remark) = remark {
                console.remark(remark)?;
            }
            output.write(bytes)?;
        }
        if self.spectral.is_none() && self.options.pigment_maps.is_none() && self.painting.is_none()
        {
            return Ok(());
        }
        let document = painting.document()?;
        if let Some(output) = self.spectral {
            let picture = painting.picture()?;
            let quadrature = &painting.light().quadrature;
            let (wavelengths_nm, spectral) = match self.options.bands {
                SpectralBands::Nodes => {
                    (quadrature.nodes_nm.clone(), Spectral::at_nodes(&document, quadrature))
                }
                SpectralBands::Full => {
                    let grid = document.library.grid;
                    (grid.wavelengths_nm().collect(), Spectral::full(&document))
                }
            };
            let planes = planes(&spectral, picture.width(), picture.height());
            output.write(spectral_exr(&picture, &wavelengths_nm, &planes, cell_mm)?)?;
        }
        if let Some(folder) = self.options.pigment_maps {
            for file in pigment_maps("painting", &maps(&document), cell_mm)? {
                Output::open(&folder.join(file.name), &[])?.write(file.bytes)?;
            }
        }
        if let Some(output) = self.painting {
            output.write(file::write(&document)?)?;
        }
        Ok(())
    }
}

/// The picture in the format that its name says, and a remark on what that
/// format could not hold.
pub(crate) fn picture_file(
    path: &Path,
    bits: Bits,
    picture: &Field<[f32; 4]>,
    cell_mm: f64,
) -> anyhow::Result<(Vec<u8>, Option<String>)> {
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr")) {
        return Ok((linear_exr(picture, cell_mm, FloatBits::Single)?, None));
    }
    let png = match bits {
        Bits::Eight => png8(picture, cell_mm)?,
        Bits::Sixteen => png16(picture, cell_mm)?,
    };
    let share = 100.0 * png.clipped as f64 / picture.values().len() as f64;
    let remark = format!(
        "{}: {share:.1} % of the cells are outside sRGB and were clipped; .exr keeps them",
        path.display()
    );
    Ok((png.bytes, (share >= 0.05).then_some(remark)))
}

/// Reflectance by wavelength, for every cell.
fn planes(spectral: &Spectral<'_>, width: usize, height: usize) -> Vec<Field<f32>> {
    let mut planes = vec![Field::filled(width, height, 0.0); spectral.count()];
    for y in 0..height {
        for (x, spectrum) in spectral.measured_row(y).into_iter().enumerate() {
            for (plane, value) in planes.iter_mut().zip(spectrum) {
                plane[(x, y)] = value as f32;
            }
        }
    }
    planes
}

/// The height of each pigment's paint over all layers, and of vehicle last.
fn maps(document: &Document) -> Vec<PigmentMap> {
    let (width, height) = (document.wet.width(), document.wet.height());
    let mut sums: Vec<Option<Vec<u64>>> = vec![None; document.library.pigments.len() + 1];
    let vehicle = sums.len() - 1;
    let dry = document.dry.iter().map(|layer| (&layer.slots, &layer.paint));
    for (slots, paint) in dry.chain([(&document.slots, &document.wet)]) {
        add(&mut sums, vehicle, slots, paint);
    }
    let mut found = Vec::new();
    for (index, sum) in sums.into_iter().enumerate() {
        let Some(sum) = sum else { continue };
        let mm = |&quanta: &u64| (quanta as f64 * mm_from_quanta(1, document.cell_mm)) as f32;
        let height_mm = Field::from_values(width, height, sum.iter().map(mm).collect());
        let name = document.library.pigments.get(index).map_or("vehicle", |p| &p.name).to_owned();
        found.push(PigmentMap { name, height_mm });
    }
    found
}

fn add(sums: &mut [Option<Vec<u64>>], vehicle: usize, slots: &Slots, paint: &Layer) {
    let cells = paint.vehicle.values().len();
    for slot in 0..=SLOTS {
        let target = match slots.get(slot) {
            Some(Some(pigment)) => *pigment,
            Some(None) => continue,
            None => vehicle,
        };
        let sum = sums[target].get_or_insert_with(|| vec![0; cells]);
        for (index, total) in sum.iter_mut().enumerate() {
            let cell = paint.cell(index);
            *total += u64::from(cell.pigments.get(slot).copied().unwrap_or(cell.vehicle));
        }
    }
}
