//! Exports of a painting: pictures, layers, spectra and pigment maps.

use std::path::Path;

use graphics::export::{OutsideGamut, PictureFormat, picture_file};
use paint::document::Document;
use paint::export::{SpectralBands, layers_file, painting_maps, pigment_maps, spectral_file};
use paint::light::Light;
use paint::scene::{PixelsPerCell, fine_picture, picture, scene};

use super::job::{JobError, Progress};
use super::problem::Problem;
use crate::language::tr;
use documents::file::disk;
use documents::file::write_whole;

/// An export of a painting that the painter chose.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Export {
    /// Kind of the file that is made.
    pub kind: ExportKind,
    /// Resolution of a picture; layers, spectra and maps have one value a cell.
    pub pixels: PixelsPerCell,
}

/// The kind of an export.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExportKind {
    /// The picture under its light.
    Picture(PictureFormat),
    /// The ground and all layers of paint, as OpenRaster.
    Layers,
    /// A spectral OpenEXR with the reflectance of every cell.
    Spectral(SpectralBands),
    /// A folder with one map for each pigment.
    PigmentMaps,
}

impl ExportKind {
    /// Extension of the file's or folder's name.
    #[must_use]
    pub(crate) fn ending(self) -> &'static str {
        match self {
            Self::Picture(PictureFormat::Png8 | PictureFormat::Png16) => "png",
            Self::Picture(PictureFormat::Tiff16) => "tif",
            Self::Picture(PictureFormat::LinearExr) => "exr",
            Self::Layers => "ora",
            Self::Spectral(_) => "spectral.exr",
            Self::PigmentMaps => "maps",
        }
    }
}

/// Writes `export` of `document` under `light` to `path`. Returns a remark if colours were
/// outside the gamut.
///
/// # Errors
/// [`JobError`] if the export failed or was cancelled. No incomplete file is left; pigment
/// maps that were already written stay.
pub(crate) fn export(
    Export { kind, pixels }: Export,
    document: &Document,
    light: &Light,
    path: &Path,
    progress: &Progress,
) -> Result<Option<Problem>, JobError> {
    let problem = |error: graphics::export::ExportError| Problem::without_hint(&error);
    progress.report(0.0)?;
    match kind {
        ExportKind::Picture(format) => {
            let scene = scene(document, light);
            let picture = match pixels.count() {
                1 => picture(document, &scene),
                _ => fine_picture(document, &scene, pixels),
            };
            progress.report(0.5)?;
            let pixel_mm = document.cell_mm / pixels.count() as f64;
            let file = picture_file(&picture, pixel_mm, format).map_err(problem)?;
            progress.report(0.9)?;
            write_whole(path, &file.bytes).map_err(Problem::from)?;
            Ok(file.outside_gamut().map(|outside| gamut_remark(path, outside)))
        }
        ExportKind::Layers => {
            let count = (document.dry.len() + 2) as f64;
            let file = layers_file(document, light, |done| {
                progress.report(0.9 * done as f64 / count).is_ok()
            })
            .map_err(problem)?;
            let Some(file) = file else { return Err(JobError::Cancelled) };
            write_whole(path, &file.bytes).map_err(Problem::from)?;
            Ok(file.outside_gamut().map(|outside| gamut_remark(path, outside)))
        }
        ExportKind::Spectral(bands) => {
            let picture = picture(document, &scene(document, light));
            let rows = document.wet.height().max(1) as f64;
            let file = spectral_file(document, light, &picture, bands, |row| {
                progress.report(0.1 + 0.7 * row as f64 / rows).is_ok()
            })
            .map_err(problem)?;
            let Some(bytes) = file else { return Err(JobError::Cancelled) };
            progress.report(0.9)?;
            write_whole(path, &bytes).map_err(Problem::from)?;
            Ok(None)
        }
        ExportKind::PigmentMaps => {
            let maps = painting_maps(document);
            progress.report(0.3)?;
            let files = pigment_maps("painting", &maps, document.cell_mm).map_err(problem)?;
            disk::create_dir_all(path).map_err(|error| Problem::io(path, "created", &error))?;
            let count = files.len() as f64;
            for (index, file) in files.into_iter().enumerate() {
                progress.report(0.6 + 0.4 * index as f64 / count)?;
                write_whole(&path.join(file.name), &file.bytes).map_err(Problem::from)?;
            }
            Ok(None)
        }
    }
}

fn gamut_remark(path: &Path, outside: OutsideGamut) -> Problem {
    let text = format!("{}: {outside}", path.display());
    Problem::new(text, tr("export linear OpenEXR to keep them"))
}

#[cfg(test)]
mod tests {
    use paint::amount::QUANTA_PER_CELL;
    use paint::ground::GroundSpec;
    use paint::strokes::{Canvas, PaletteSpec, StrokeScript};
    use pigment::library::PigmentLibrary;

    use super::*;

    /// A canvas under a thick layer of a green that sRGB cannot show.
    fn green() -> Document {
        let cell_mm = 0.5;
        let ground = GroundSpec::default();
        let canvas = Canvas { width_mm: 12.0, height_mm: 8.0, cell_mm, ground };
        let palette = PaletteSpec::from_names(["Zinc White", "Emerald Green"]);
        let script = StrokeScript::new("Green", "CC0-1.0", canvas, palette);
        let library = PigmentLibrary::van_gogh_oils();
        let resolved = script.resolve(&library).unwrap();
        let (width, height) = script.canvas.cells();
        let ground = script.canvas.ground.build(width, height, cell_mm, &library).unwrap();
        let mut document = script.bare(&library, &resolved, ground);
        for amounts in document.wet.pigments.values_mut() {
            amounts[1] = QUANTA_PER_CELL;
        }
        document
    }

    #[test]
    fn colors_that_a_picture_loses_are_told_with_its_path() {
        let folder = tempfile::tempdir().unwrap();
        let document = green();
        let light = Light::named(&document.library, "D65", "1931-2").unwrap();
        let pixels = PixelsPerCell::new(1).unwrap();
        for (format, told) in [
            (PictureFormat::Png8, true),
            (PictureFormat::Png16, true),
            (PictureFormat::Tiff16, true),
            (PictureFormat::LinearExr, false),
        ] {
            let kind = ExportKind::Picture(format);
            let path = folder.path().join(format!("green.{}", kind.ending()));
            let progress = Progress::default();
            let chosen = Export { kind, pixels };
            let remark = export(chosen, &document, &light, &path, &progress).unwrap();
            assert_eq!(remark.is_some(), told, "{format:?}: {remark:?}");
            let name = path.display().to_string();
            assert!(remark.is_none_or(|remark| remark.text.starts_with(&name)), "{format:?}");
        }
    }
}
