//! Numbered copies of a painting: beside `study.exr` a folder `study.revisions`
//! with `0001.exr`, and `0001.png` to look at.
//!
//! They are kept when the painter asks for it, not at every save: what is
//! between two saves, undo and autosave hold.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use image::imageops::FilterType;
use image::{ImageReader, Limits, RgbImage, RgbaImage};
use render::light::Light;
use render::paint::document::Document;
use render::paint::scene::{picture, scene};

use super::job::{Progress, Stopped};
use session::FileFailure;
use session::whole;

/// The longer side of a thumbnail, in pixels.
const LONGEST: u32 = 192;

/// A copy.
#[derive(Debug, Clone, PartialEq)]
pub struct Revision {
    /// Its number, from 1.
    pub number: u32,
    /// Its file.
    pub path: PathBuf,
    /// The file's length.
    pub bytes: u64,
    /// When it was kept, if the system tells.
    pub kept: Option<SystemTime>,
    /// What it looks like, if its picture is there.
    pub thumbnail: Option<RgbaImage>,
}

/// The folder of the revisions of the painting in `path`.
#[must_use]
pub(super) fn folder(path: &Path) -> PathBuf {
    path.with_extension("revisions")
}

/// Keeps `document` as the next revision of the painting in `path`, shown under
/// `light`.
///
/// # Errors
/// [`Stopped`] if it cannot be written.
pub(super) fn keep(
    path: &Path,
    document: &Document,
    light: &Light,
    progress: &Progress,
) -> Result<PathBuf, Stopped> {
    let folder = folder(path);
    std::fs::create_dir_all(&folder).map_err(|error| FileFailure::io(&folder, "made", &error))?;
    let number = 1 + numbers(&folder)?.into_iter().map(|(number, _)| number).max().unwrap_or(0);
    let bytes = render::paint::file::write(document)
        .map_err(|error| FileFailure::told(&error, error.hint()))?;
    progress.tell(0.5)?;
    let thumbnail = thumbnail(document, light);
    progress.tell(0.9)?;
    let mut png = std::io::Cursor::new(Vec::new());
    thumbnail
        .write_to(&mut png, image::ImageFormat::Png)
        .map_err(|error| FileFailure::told(&error, None::<String>))?;
    let kept = folder.join(format!("{number:04}.exr"));
    // The picture first: a revision is there when its painting is.
    whole::write(&kept.with_extension("png"), png.get_ref())?;
    whole::write(&kept, &bytes)?;
    Ok(kept)
}

/// The revisions of the painting in `path`, the newest first.
///
/// # Errors
/// [`Stopped`] if the folder cannot be read.
pub(super) fn list(path: &Path, progress: &Progress) -> Result<Vec<Revision>, Stopped> {
    let mut found = numbers(&folder(path))?;
    found.sort_unstable_by_key(|(number, _)| std::cmp::Reverse(*number));
    let mut revisions = Vec::with_capacity(found.len());
    for (number, path) in found {
        progress.tell(0.0)?;
        let Ok(file) = std::fs::metadata(&path) else { continue };
        let thumbnail = read_thumbnail(&path.with_extension("png"));
        let (bytes, kept) = (file.len(), file.modified().ok());
        revisions.push(Revision { number, path, bytes, kept, thumbnail });
    }
    Ok(revisions)
}

/// Deletes the revision in `path`.
///
/// # Errors
/// [`FileFailure`] if it is none, or cannot be removed.
pub(super) fn delete(path: &Path) -> Result<(), FileFailure> {
    let beside = path.parent().and_then(Path::extension).is_some_and(|end| end == "revisions");
    if !beside || number(path).is_none() {
        let what = format!("{}: is no revision", path.display());
        return Err(FileFailure::new(what, "delete it where you keep your files"));
    }
    std::fs::remove_file(path).map_err(|error| FileFailure::io(path, "deleted", &error))?;
    let _ = std::fs::remove_file(path.with_extension("png"));
    // The last one takes the folder with it, unless something else is there.
    let _ = path.parent().map(std::fs::remove_dir);
    Ok(())
}

fn number(path: &Path) -> Option<u32> {
    let name = path.file_name()?.to_str()?.strip_suffix(".exr")?;
    (name.len() >= 4 && name.bytes().all(|byte| byte.is_ascii_digit())).then_some(())?;
    name.parse().ok()
}

fn numbers(folder: &Path) -> Result<Vec<(u32, PathBuf)>, FileFailure> {
    let entries = match std::fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(FileFailure::io(folder, "read", &error)),
    };
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    Ok(paths.filter_map(|path| Some((number(&path)?, path))).collect())
}

/// The picture of `document` at most [`LONGEST`] pixels long, in sRGB; averaged
/// in linear light.
fn thumbnail(document: &Document, light: &Light) -> RgbImage {
    let picture = picture(document, &scene(document, light));
    let (width, height) = (picture.width() as u32, picture.height() as u32);
    let values = picture.values().iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
    let Some(linear) = image::Rgb32FImage::from_raw(width, height, values) else {
        return RgbImage::new(1, 1);
    };
    let longest = width.max(height).max(1);
    let side = |length: u32| (length * LONGEST.min(longest) / longest).max(1);
    let small = image::imageops::resize(&linear, side(width), side(height), FilterType::Triangle);
    let encoded = small.pixels().flat_map(|pixel| {
        let linear = spectra::color::Rgb(pixel.0.map(|v| f64::from(v.clamp(0.0, 1.0))));
        linear.encoded().0.map(|v| (v * 255.0).round() as u8)
    });
    RgbImage::from_raw(small.width(), small.height(), encoded.collect()).unwrap_or_default()
}

fn read_thumbnail(path: &Path) -> Option<RgbaImage> {
    let mut reader = ImageReader::open(path).ok()?;
    let mut limits = Limits::default();
    limits.max_image_width = Some(4 * LONGEST);
    limits.max_image_height = Some(4 * LONGEST);
    reader.limits(limits);
    Some(reader.decode().ok()?.into_rgba8())
}
