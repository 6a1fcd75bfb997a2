//! Exports of a painting for other programs: pictures, layers, spectral OpenEXR and pigment maps.
//!
//! Use [`PaintingExports`] to write the files of a painting in progress. The other functions encode
//! a document in memory. One document always gives the same bytes.

mod pigment_maps;
mod layers;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use documents::file::{FileAction, FileError, write_whole};
use documents::hint::Explain;
use graphics::export::{ExportError, OutsideGamut, PictureFormat, picture_file};
use graphics::field::Field;

use crate::amount::mm_from_quanta;
use crate::document::{Document, Slots};
use crate::file::{PaintingFileError, write};
use crate::layer::{Layer, SLOTS};
use crate::light::Light;
use crate::painting::{Painting, PaintingError};
use crate::scene::{PixelsPerCell, SpectralDocument};

pub use layers::layers_file;
pub use pigment_maps::{NamedFile, PigmentMap, pigment_maps, spectral_exr};

/// Start of the names of pigment maps.
const STEM: &str = "painting";

/// Function that takes path and content of a file.
pub type PutFile<'a> = dyn FnMut(&Path, &[u8]) -> Result<(), FileError> + 'a;

/// Files that you want of a painting. `None` skips a file. We write each whole or not at all.
///
/// ```no_run
/// use paint::export::PaintingExports;
/// use graphics::export::PictureFormat;
///
/// # fn example(painting: &mut paint::painting::Painting) -> Result<(), Box<dyn std::error::Error>>
/// { let exports = PaintingExports {
///     picture: Some(("wheat.png".into(), PictureFormat::Png16)),
///     painting: Some("wheat.exr".into()),
///     ..PaintingExports::default()
/// };
/// if let Some(outside) = exports.write(painting)? {
///     eprintln!("{outside}");
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct PaintingExports {
    /// Path and format of the picture.
    pub picture: Option<(PathBuf, PictureFormat)>,
    /// Pixels of the picture along a cell's width.
    pub pixels_per_cell: PixelsPerCell,
    /// Path of an OpenRaster file with the layers, see [`layers_file`].
    pub layers: Option<PathBuf>,
    /// Path and wavelengths of a spectral OpenEXR: the reflectance of every cell, without
    /// relief and gloss.
    pub spectral: Option<(PathBuf, SpectralBands)>,
    /// Folder for a map of each pigment. We create it if needed. See [`pigment_maps`] for the
    /// files.
    pub pigment_maps: Option<PathBuf>,
    /// Path of the painting itself, see [`crate::file`].
    pub painting: Option<PathBuf>,
}

impl PaintingExports {
    /// Makes and writes the files. If colours of the picture are outside its gamut, you get a note.
    ///
    /// # Errors
    /// [`PaintingExportError`] if we cannot compute the painting or cannot encode or write a file.
    /// Files that we wrote before the error stay on the disk.
    pub fn write(
        &self,
        painting: &mut Painting,
    ) -> Result<Option<OutsideGamut>, PaintingExportError> {
        self.write_with(painting, &mut |path, bytes| write_whole(path, bytes))
    }

    /// Makes the files and hands path and content of each to `put`, as [`Self::write`] hands them
    /// to [`write_whole`]. Use this if you send some of them elsewhere.
    ///
    /// # Errors
    /// The errors of [`Self::write`] and of `put`.
    pub fn write_with(
        &self,
        painting: &mut Painting,
        put: &mut PutFile<'_>,
    ) -> Result<Option<OutsideGamut>, PaintingExportError> {
        let cell_mm = painting.cell_mm();
        let mut outside = None;
        if let Some((path, format)) = &self.picture {
            let file = picture_file(
                &painting.fine_picture(self.pixels_per_cell)?,
                cell_mm / self.pixels_per_cell.count() as f64,
                *format,
            )?;
            put(path, &file.bytes)?;
            outside = file.outside_gamut();
        }
        let rest = [&self.layers, &self.pigment_maps, &self.painting];
        if self.spectral.is_none() && rest.iter().all(|path| path.is_none()) {
            return Ok(outside);
        }
        let document = painting.document()?;
        if let Some(path) = &self.layers
            && let Some(file) = layers_file(&document, painting.light(), |_| true)?
        {
            put(path, &file.bytes)?;
            outside = outside.or(file.outside_gamut());
        }
        if let Some((path, bands)) = &self.spectral {
            let picture = painting.picture()?;
            let file = spectral_file(&document, painting.light(), &picture, *bands, |_| true)?;
            put(path, &file.unwrap_or_default())?;
        }
        if let Some(folder) = &self.pigment_maps {
            make_folder(folder)?;
            for file in pigment_maps(STEM, &painting_maps(&document), cell_mm)? {
                put(&folder.join(&file.name), &file.bytes)?;
            }
        }
        if let Some(path) = &self.painting {
            put(path, &write(&document)?)?;
        }
        Ok(outside)
    }
}

/// Writes `files` into `folder`, and creates it if needed. This writes each file whole or not at
/// all.
///
/// # Errors
/// [`FileError`] with the path of the file, or of the folder if it cannot be created.
pub fn save_files(folder: &Path, files: &[NamedFile]) -> Result<(), FileError> {
    make_folder(folder)?;
    files.iter().try_for_each(|file| write_whole(&folder.join(&file.name), &file.bytes))
}

fn make_folder(folder: &Path) -> Result<(), FileError> {
    documents::file::disk::create_dir_all(folder).map_err(|reason| FileError {
        path: folder.to_owned(),
        action: FileAction::Write,
        reason: Arc::new(reason),
    })
}

/// A painting cannot be exported.
#[derive(Debug, thiserror::Error, Explain)]
pub enum PaintingExportError {
    /// The state of the painting cannot be computed.
    #[error(transparent)]
    Painting(#[from] PaintingError),
    /// A picture, spectrum or map cannot be encoded.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// The painting cannot be encoded.
    #[error(transparent)]
    PaintingFile(#[from] PaintingFileError),
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
}

/// Wavelengths of a spectral picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum SpectralBands {
    /// The eight wavelengths of the picture.
    #[default]
    Nodes,
    /// All wavelengths of the library. We compute them in double precision.
    Full,
}

/// Encodes a spectral OpenEXR of `document`: the reflectance of every cell without relief and
/// gloss, and `picture` (computed under `light`) for programs that show colours. After each row
/// this calls `go_on` with the number of rows done. If `go_on` returns `false`, you get `None`.
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

/// Makes a map of each pigment: the height of its paint in mm, summed over all layers. The vehicle
/// comes last. You do not get a map of a pigment that is in no slot of any layer.
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
