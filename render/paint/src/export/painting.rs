//! A painting at rest as pictures, spectra and maps.

use super::pigment_maps::PigmentMap;
use super::spectral_exr::spectral_exr;
use crate::amount::mm_from_quanta;
use crate::document::{Document, Slots};
use crate::layer::{Layer, SLOTS};
use crate::light::Light;
use crate::scene::Spectral;
use graphics::export::ExportError;
use graphics::export::{linear_exr, png8, png16};
use graphics::field::Field;

/// What a picture is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum PictureFormat {
    /// PNG in sRGB, 8 bits a channel.
    #[default]
    Png8,
    /// PNG in sRGB, 16 bits a channel.
    Png16,
    /// OpenEXR of linear sRGB, 32 bits a channel, nothing clipped.
    LinearExr,
}

/// A picture's file.
#[derive(Debug, Clone, PartialEq)]
pub struct PictureFile {
    /// Its content.
    pub bytes: Vec<u8>,
    /// Share of the cells that the format has no colour for, and that were
    /// clipped, 0..1.
    pub clipped: f64,
}

/// A picture in linear sRGB (white at 1), of cells of `cell_mm`, as a file.
///
/// # Errors
/// [`ExportError`] as the format's own function has it.
pub fn picture_file(
    picture: &Field<[f32; 4]>,
    cell_mm: f64,
    format: PictureFormat,
) -> Result<PictureFile, ExportError> {
    let png = match format {
        PictureFormat::Png8 => png8(picture, cell_mm)?,
        PictureFormat::Png16 => png16(picture, cell_mm)?,
        PictureFormat::LinearExr => {
            let bytes = linear_exr(picture, cell_mm)?;
            return Ok(PictureFile { bytes, clipped: 0.0 });
        }
    };
    let clipped = png.clipped as f64 / picture.values().len() as f64;
    Ok(PictureFile { bytes: png.bytes, clipped })
}

/// Which wavelengths a spectral picture holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Bands {
    /// The eight that the picture was computed with.
    #[default]
    Nodes,
    /// All of the library's, computed anew in double precision.
    Full,
}

/// A spectral OpenEXR of `document`: the reflectance of every cell without
/// relief and gloss, and `picture` for programs that show colours. `light` is
/// that of the picture. `go_on` is told the rows done after each; when it says
/// `false` there is no file.
///
/// # Errors
/// [`ExportError`] as [`spectral_exr`] has it.
pub fn spectral_file(
    document: &Document,
    light: &Light,
    picture: &Field<[f32; 4]>,
    bands: Bands,
    mut go_on: impl FnMut(usize) -> bool,
) -> Result<Option<Vec<u8>>, ExportError> {
    let (wavelengths_nm, spectral) = match bands {
        Bands::Nodes => {
            (light.quadrature.nodes_nm.clone(), Spectral::at_nodes(document, &light.quadrature))
        }
        Bands::Full => (document.library.grid.wavelengths_nm().collect(), Spectral::full(document)),
    };
    let (width, height) = (document.wet.width(), document.wet.height());
    let mut planes = vec![Field::filled(width, height, 0.0); spectral.count()];
    for y in 0..height {
        for (x, spectrum) in spectral.measured_row(y).into_iter().enumerate() {
            for (plane, value) in planes.iter_mut().zip(spectrum) {
                plane[(x, y)] = value as f32;
            }
        }
        if !go_on(y + 1) {
            return Ok(None);
        }
    }
    spectral_exr(picture, &wavelengths_nm, &planes, document.cell_mm).map(Some)
}

/// The height of each pigment's paint over all layers, and of vehicle last;
/// only what some layer has.
#[must_use]
pub fn painting_maps(document: &Document) -> Vec<PigmentMap> {
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
