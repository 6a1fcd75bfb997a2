//! Numbered copies of a painting: beside `study.exr` a folder `study.revisions` with
//! `0001.exr` and the thumbnail `0001.png`.
//!
//! A revision is kept only on request, not at every save: undo and autosave cover the time
//! between two saves.

use std::path::{Path, PathBuf};
use web_time::SystemTime;

use image::imageops::FilterType;
use image::{ImageReader, Limits, RgbImage, RgbaImage};
use paint::document::Document;
use paint::light::Light;
use paint::scene::{picture, scene};

use super::job::{JobError, Progress};
use super::problem::Problem;
use documents::file::disk;
use documents::file::write_whole;

/// Length of the longer side of a thumbnail, in pixels.
const MAX_SIDE: u32 = 192;

/// A numbered copy of a painting.
#[derive(Debug, Clone, PartialEq)]
pub struct Revision {
    /// Number, from 1.
    pub number: u32,
    /// Path of its file.
    pub path: PathBuf,
    /// Size of its file in bytes.
    pub bytes: u64,
    /// Time at which it was kept, if the system knows it.
    pub kept: Option<SystemTime>,
    /// The thumbnail, if its file exists.
    pub thumbnail: Option<RgbaImage>,
}

/// Folder of the revisions of the painting in `path`.
#[must_use]
pub(super) fn folder(path: &Path) -> PathBuf {
    path.with_extension("revisions")
}

/// Writes `document` as the next revision of the painting in `path`, with a thumbnail under
/// `light`. Returns the path of the revision.
///
/// # Errors
/// [`JobError`] if it cannot be written.
pub(super) fn keep(
    path: &Path,
    document: &Document,
    light: &Light,
    progress: &Progress,
) -> Result<PathBuf, JobError> {
    let folder = folder(path);
    disk::create_dir_all(&folder).map_err(|error| Problem::io(&folder, "created", &error))?;
    let number = 1 + numbers(&folder)?.into_iter().map(|(number, _)| number).max().unwrap_or(0);
    let bytes = paint::file::write(document).map_err(|error| Problem::from_error(&error))?;
    progress.report(0.5)?;
    let thumbnail = thumbnail(document, light);
    progress.report(0.9)?;
    let mut png = std::io::Cursor::new(Vec::new());
    thumbnail
        .write_to(&mut png, image::ImageFormat::Png)
        .map_err(|error| Problem::without_hint(&error))?;
    let kept = folder.join(format!("{number:04}.exr"));
    // The thumbnail is written first, because a revision counts as complete once its
    // painting exists.
    write_whole(&kept.with_extension("png"), png.get_ref()).map_err(Problem::from)?;
    write_whole(&kept, &bytes).map_err(Problem::from)?;
    Ok(kept)
}

/// Lists the revisions of the painting in `path`, the newest first.
///
/// # Errors
/// [`JobError`] if the folder cannot be read.
pub(super) fn list(path: &Path, progress: &Progress) -> Result<Vec<Revision>, JobError> {
    let mut found = numbers(&folder(path))?;
    found.sort_unstable_by_key(|(number, _)| std::cmp::Reverse(*number));
    let mut revisions = Vec::with_capacity(found.len());
    for (number, path) in found {
        progress.report(0.0)?;
        let Ok(file) = disk::metadata(&path) else { continue };
        let thumbnail = read_thumbnail(&path.with_extension("png"));
        let bytes = file.len();
        let kept = file.modified().ok();
        revisions.push(Revision { number, path, bytes, kept, thumbnail });
    }
    Ok(revisions)
}

/// Deletes the revision in `path` with its thumbnail, and the folder if it is empty then.
///
/// # Errors
/// [`Problem`] if `path` is not a revision or cannot be removed.
pub(super) fn delete(path: &Path) -> Result<(), Problem> {
    let beside = path.parent().and_then(Path::extension).is_some_and(|end| end == "revisions");
    if !beside || number(path).is_none() {
        let text = format!("{}: is not a revision", path.display());
        return Err(Problem::new(text, "delete it in a file manager"));
    }
    disk::remove_file(path).map_err(|error| Problem::io(path, "deleted", &error))?;
    let _ = disk::remove_file(path.with_extension("png"));
    // Removes the folder if it is empty now.
    let _ = path.parent().map(disk::remove_dir);
    Ok(())
}

fn number(path: &Path) -> Option<u32> {
    let name = path.file_name()?.to_str()?.strip_suffix(".exr")?;
    (name.len() >= 4 && name.bytes().all(|byte| byte.is_ascii_digit())).then_some(())?;
    name.parse().ok()
}

fn numbers(folder: &Path) -> Result<Vec<(u32, PathBuf)>, Problem> {
    let entries = match disk::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(Problem::io(folder, "read", &error)),
    };
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    Ok(paths.filter_map(|path| Some((number(&path)?, path))).collect())
}

/// Renders a thumbnail of at most [`MAX_SIDE`] pixels per side, in sRGB; it is averaged in
/// linear light.
fn thumbnail(document: &Document, light: &Light) -> RgbImage {
    let picture = picture(document, &scene(document, light));
    let width = picture.width() as u32;
    let height = picture.height() as u32;
    let values = picture.values().iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
    let Some(linear) = image::Rgb32FImage::from_raw(width, height, values) else {
        return RgbImage::new(1, 1);
    };
    let longest = width.max(height).max(1);
    let side = |length: u32| (length * MAX_SIDE.min(longest) / longest).max(1);
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
    limits.max_image_width = Some(4 * MAX_SIDE);
    limits.max_image_height = Some(4 * MAX_SIDE);
    reader.limits(limits);
    Some(reader.decode().ok()?.into_rgba8())
}
