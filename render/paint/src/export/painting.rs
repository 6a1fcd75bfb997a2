//! Exports of a document: spectra, and maps of its pigments.

use super::pigment_maps::PigmentMap;
use super::spectral_exr::spectral_exr;
use crate::amount::mm_from_quanta;
use crate::document::{Document, Slots};
use crate::layer::{Layer, SLOTS};
use crate::light::Light;
use crate::scene::SpectralDocument;
use graphics::export::ExportError;
use graphics::field::Field;

/// Wavelengths of a spectral picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum SpectralBands {
    /// The eight wavelengths that the picture was computed with.
    #[default]
    Nodes,
    /// All wavelengths of the library, computed in double precision.
    Full,
}

/// Encodes a spectral OpenEXR of `document`: the reflectance of every cell without relief
/// and gloss, and `picture` (computed under `light`) for programs that show colours. After
/// each row `go_on` is called with the number of rows done; if it returns `false`, the
/// result is `None`.
///
/// # Errors
/// [`ExportError`] in the cases of [`spectral_exr`].
pub fn spectral_file(
    document: &Document,
    light: &Light,
    picture: &Field<[f32; 4]>,
    bands: SpectralBands,
    go_on: impl FnMut(usize) -> bool,
) -> Result<Option<Vec<u8>>, ExportError> {
    let (wavelengths_nm, spectral) = match bands {
        SpectralBands::Nodes => {
            let spectral = SpectralDocument::at_nodes(document, &light.quadrature);
            (light.quadrature.rule.nodes_nm.clone(), spectral)
        }
        SpectralBands::Full => {
            let wavelengths_nm = document.library.grid.wavelengths_nm().collect();
            (wavelengths_nm, SpectralDocument::full(document))
        }
    };
    let Some(planes) = spectral.planes(go_on) else { return Ok(None) };
    spectral_exr(picture, &wavelengths_nm, &planes, document.cell_mm).map(Some)
}

/// Makes a map of each pigment: the height of its paint in mm, summed over all layers. The
/// vehicle comes last. Pigments in no slot of any layer are left out.
#[must_use]
pub fn painting_maps(document: &Document) -> Vec<PigmentMap> {
    let width = document.wet.width();
    let height = document.wet.height();
    let mut sums: Vec<Option<Vec<u64>>> = vec![None; document.library.pigments.len() + 1];
    let vehicle = sums.len() - 1;
    let dry = document.dry.iter().map(|layer| (&layer.slots, &layer.paint));
    for (slots, paint) in dry.chain([(&document.slots, &document.wet)]) {
        add(&mut sums, vehicle, slots, paint);
    }
    let mut found = Vec::new();
    for (index, sum) in sums.into_iter().enumerate() {
        let Some(sum) = sum else { continue };
        let height_mm = Field::from_values(
            width,
            height,
            sum.iter()
                .map(|&quanta: &u64| (quanta as f64 * mm_from_quanta(1, document.cell_mm)) as f32)
                .collect(),
        );
        let name = document.library.pigments.get(index).map_or("vehicle", |p| &p.name).to_owned();
        found.push(PigmentMap { name, height_mm });
    }
    found
}

fn add(sums: &mut [Option<Vec<u64>>], vehicle: usize, slots: &Slots, paint: &Layer) {
    let cells = paint.vehicle.values().len();
    for slot in 0..=SLOTS {
        let target = match slots.get(slot) {
            Some(Some(pigment)) => pigment.index(),
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
