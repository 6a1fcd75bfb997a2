//! Exports of a painting: what can be made, and the making.

use std::path::Path;

use render::export::{
    Bands, PictureFormat, painting_maps, picture_file, pigment_maps, spectral_file,
};
use render::light::Light;
use render::paint::document::Document;
use render::paint::scene::{picture, scene};

use super::job::{Progress, Stopped};
use session::FileFailure;
use session::whole;

/// What is to be made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Export {
    /// The picture.
    Picture(PictureFormat),
    /// The reflectance of every cell.
    Spectral(Bands),
    /// A folder with a map of each pigment.
    PigmentMaps,
}

impl Export {
    /// How the file's name ends; of a folder too.
    #[must_use]
    pub fn ending(self) -> &'static str {
        match self {
            Self::Picture(PictureFormat::Png8 | PictureFormat::Png16) => "png",
            Self::Picture(PictureFormat::LinearExr) => "exr",
            Self::Spectral(_) => "spectral.exr",
            Self::PigmentMaps => "maps",
        }
    }
}

/// Makes `export` of `document` under `light` and writes it to `path`; says what
/// the painter should know of it.
///
/// # Errors
/// [`Stopped`]; then no file is written, and of maps those that are complete.
pub fn export(
    export: Export,
    document: &Document,
    light: &Light,
    path: &Path,
    progress: &Progress,
) -> Result<Option<FileFailure>, Stopped> {
    let told = |error: render::export::ExportError| FileFailure::told(&error, None::<String>);
    let shown = || picture(document, &scene(document, light));
    progress.tell(0.0)?;
    match export {
        Export::Picture(format) => {
            let picture = shown();
            progress.tell(0.5)?;
            let file = picture_file(&picture, document.cell_mm, format).map_err(told)?;
            progress.tell(0.9)?;
            whole::write(path, &file.bytes)?;
            Ok((file.clipped >= 0.0005).then(|| clipped(path, file.clipped)))
        }
        Export::Spectral(bands) => {
            let picture = shown();
            let rows = document.wet.height().max(1) as f64;
            let go_on = |row| progress.tell(0.1 + 0.7 * row as f64 / rows).is_ok();
            let file = spectral_file(document, light, &picture, bands, go_on).map_err(told)?;
            let Some(bytes) = file else { return Err(Stopped::Cancelled) };
            progress.tell(0.9)?;
            whole::write(path, &bytes)?;
            Ok(None)
        }
        Export::PigmentMaps => {
            let maps = painting_maps(document);
            progress.tell(0.3)?;
            let files = pigment_maps("painting", &maps, document.cell_mm).map_err(told)?;
            std::fs::create_dir_all(path).map_err(|error| FileFailure::io(path, "made", &error))?;
            let count = files.len() as f64;
            for (index, file) in files.into_iter().enumerate() {
                progress.tell(0.6 + 0.4 * index as f64 / count)?;
                whole::write(&path.join(file.name), &file.bytes)?;
            }
            Ok(None)
        }
    }
}

fn clipped(path: &Path, share: f64) -> FileFailure {
    let (path, share) = (path.display(), 100.0 * share);
    let what = format!("{path}: {share:.1} % of the cells are outside sRGB and were clipped");
    FileFailure::new(what, "linear OpenEXR keeps them")
}
