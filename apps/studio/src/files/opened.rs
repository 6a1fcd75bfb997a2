//! Reads files of any kind, and the numbered revisions of a painting. The content decides on the
//! kind, the name does not.
//!
//! Revisions lie beside `study.exr` in a folder `study.revisions`, for example as `0001.exr` with
//! the thumbnail `0001.png`. We keep a revision only on request, because undo and autosave cover
//! the time between two saves.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use documents::Task;
use documents::file::disk::File;
use documents::file::{NamedFiles, Outside, disk, write_whole};
use eframe::egui::{ColorImage, Context, TextureHandle, TextureOptions};
use graphics::exr_picture::linear_picture;
use graphics::picture_formats::begins_like_picture;
use image::imageops::FilterType;
use image::{ImageReader, Limits, RgbImage, RgbaImage};
use paint::document::Document;
use paint::file::PaintingFileError;
use paint::light::Light;
use paint::scene::{picture, scene};
use paint::strokes::{SideTable, StrokeScript};
use pigment::library::PigmentLibrary;
use serde::Deserialize;
use spectra::lamp_from_bytes;
use web_time::SystemTime;

use super::job::JobError;
use super::problem::Problem;
use crate::language::{tr, tr_format};

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Opened {
    Painting {
        document: Box<Document>,
        /// Palette and brushes saved with it, or the problem if they cannot be read.
        table: Result<Option<Box<SideTable>>, Problem>,
        /// Content of the file. If you paint on, the recording needs it.
        bytes: Arc<Vec<u8>>,
    },
    /// A pigment library to begin a painting with.
    Library(Box<PigmentLibrary>),
    /// A recording to be played.
    Recording {
        /// The script, with absolute paths of the files that it names.
        script: Box<StrokeScript>,
        /// The pigments of the script.
        library: Box<PigmentLibrary>,
        /// Remarks for the painter.
        remarks: Vec<Problem>,
    },
    /// A picture to show beside the canvas. The panel that shows it decodes it.
    Picture,
    /// The spectrum of a lamp. You can name a light after this file.
    Lamp,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    OpenExr,
    Picture,
    Json,
    Text,
}

/// Maximum size of a file that is not a painting, in bytes: 256 MiB.
const MAX_BYTES: u64 = 256 << 20;

/// Maximum size of a painting's file, in bytes: 16 GiB.
const MAX_PAINTING_BYTES: u64 = 16 << 30;

/// Reads `path` according to its kind.
///
/// # Errors
/// [`JobError`] if the file cannot be read, is of an unknown kind, or is invalid.
pub(crate) fn read(path: &Path, task: &Task) -> Result<Opened, JobError> {
    let (kind, mut file, length) = kind(path)?;
    let name = path.display().to_string();
    // We decode a picture where it is shown.
    if kind == Kind::Picture {
        return Ok(Opened::Picture);
    }
    let limit = if kind == Kind::OpenExr { MAX_PAINTING_BYTES } else { MAX_BYTES };
    if length > limit {
        let text = format!("{name}: the file must have at most {limit} bytes, found `{length}`");
        return Err(Problem::new(text, OPENABLE).into());
    }
    let bytes = read_all(path, &mut file, length, task)?;
    let opened = match kind {
        Kind::OpenExr => {
            match paint::file::read(&name, &bytes) {
                Ok(document) => {
                    let table = paint::file::read_table(&name, &bytes);
                    let table = table.map_err(|error| Problem::from_error(&error));
                    let table = table.map(|table| table.map(Box::new));
                    let document = Box::new(document);
                    let bytes = Arc::new(bytes);
                    Opened::Painting { document, table, bytes }
                }
                // This is a linear picture of another program.
                Err(PaintingFileError::Format { .. }) if linear_picture(&name, &bytes).is_ok() => {
                    Opened::Picture
                }
                Err(error) => return Err(Problem::from_error(&error).into()),
            }
        }
        Kind::Json => json(path, &name, &bytes)?,
        Kind::Picture | Kind::Text => {
            lamp_from_bytes(&name, &bytes, None)
                .map_err(|error| Problem::new(Problem::without_hint(&error).text, OPENABLE))?;
            Opened::Lamp
        }
    };
    task.reach(1.0)?;
    Ok(opened)
}

const OPENABLE: &str = "open a painting (.exr), a pigment library or a recording (.json), a \
                        picture (.png, .jpg, .tif, .webp) or the spectrum of a lamp";

fn kind(path: &Path) -> Result<(Kind, File, u64), Problem> {
    let unreadable = |error: std::io::Error| Problem::io(path, "read", &error);
    // We check this before opening. If we opened a pipe, we would wait for its other end.
    let found = disk::metadata(path).map_err(unreadable)?;
    if !found.is_file() {
        let text = format!("{}: is not an ordinary file", path.display());
        return Err(Problem::new(text, OPENABLE));
    }
    let mut start = [0; 64];
    let mut file = File::open(path).map_err(unreadable)?;
    let mut got = 0;
    while got < start.len() {
        match file.read(&mut start[got..]).map_err(unreadable)? {
            0 => break,
            more => got += more,
        }
    }
    let start = &start[..got];
    let text = start.strip_prefix(b"\xef\xbb\xbf").unwrap_or(start).trim_ascii_start();
    let kind = if start.starts_with(b"\x76\x2f\x31\x01") {
        Kind::OpenExr
    } else if begins_like_picture(start) {
        Kind::Picture
    } else if text.starts_with(b"{") {
        Kind::Json
    } else {
        Kind::Text
    };
    Ok((kind, File::open(path).map_err(unreadable)?, found.len()))
}

/// Reads the whole file and reports progress up to one half.
fn read_all(path: &Path, file: &mut File, length: u64, task: &Task) -> Result<Vec<u8>, JobError> {
    const PIECE: u64 = 8 << 20;
    let mut bytes = Vec::with_capacity(length as usize);
    loop {
        task.reach(0.5 * bytes.len() as f64 / length.max(1) as f64)?;
        let read = file.take(PIECE).read_to_end(&mut bytes);
        if read.map_err(|error| Problem::io(path, "read", &error))? == 0 {
            return Ok(bytes);
        }
    }
}

fn json(path: &Path, name: &str, bytes: &[u8]) -> Result<Opened, Problem> {
    #[derive(Deserialize)]
    struct Format {
        #[serde(default)]
        format: serde_json::Value,
    }
    let text = String::from_utf8_lossy(bytes);
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let Format { format } = serde_json::from_str(text)
        .map_err(|error| Problem::new(format!("{name}: is not valid JSON: {error}"), OPENABLE))?;
    match format.as_str() {
        Some("impasto-pigment-library") => library(name, text),
        Some("strokes") => recording(path, name, bytes),
        _ => {
            let wanted = "`format` must be \"strokes\" or \"impasto-pigment-library\"";
            Err(Problem::new(format!("{name}: {wanted}, found `{format}`"), OPENABLE))
        }
    }
}

fn library(name: &str, text: &str) -> Result<Opened, Problem> {
    let library =
        PigmentLibrary::from_json(name, text).map_err(|error| Problem::from_error(&error))?;
    Ok(Opened::Library(Box::new(library)))
}

fn recording(path: &Path, name: &str, bytes: &[u8]) -> Result<Opened, Problem> {
    let mut script =
        StrokeScript::from_json(name, bytes).map_err(|error| Problem::from_error(&error))?;
    let folder = path.parent().map(Path::to_owned).unwrap_or_default();
    let mut remarks = Vec::new();
    let named = script.open_library(&folder).map_err(|error| Problem::from_error(&error))?;
    if let Some(missing) = named.missing {
        let text = tr_format!(
            "the recording needs the library `{missing}`, which does not exist",
            missing
        );
        remarks.push(Problem::new(text, tr("the built-in oils are used instead")));
    }
    let library = named.library;
    // The recording is one of the painter's own, so its painting may lie anywhere.
    let mut files = NamedFiles::of(path, Outside::Allowed);
    if let Some(start) = &mut script.start {
        // We do not resolve the script here, because its pigments come from the painting that it
        // starts from.
        let found = files.find("start", start).map_err(|error| Problem::from_error(&error))?;
        *start = found.display().to_string();
    } else {
        script.resolve(&library).map_err(|error| Problem::from_error(&error))?;
    }
    script.complete_picture_paths(&mut files).map_err(|error| Problem::from_error(&error))?;
    Ok(Opened::Recording { script: Box::new(script), library: Box::new(library), remarks })
}

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
    /// Time at which it was kept, if known.
    pub kept: Option<SystemTime>,
    /// The thumbnail, if its file exists.
    pub thumbnail: Option<RgbaImage>,
}

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
    task: &Task,
) -> Result<PathBuf, JobError> {
    let folder = folder(path);
    disk::create_dir_all(&folder).map_err(|error| Problem::io(&folder, "created", &error))?;
    let number = 1 + numbers(&folder)?.into_iter().map(|(number, _)| number).max().unwrap_or(0);
    let bytes = paint::file::write(document).map_err(|error| Problem::from_error(&error))?;
    task.reach(0.5)?;
    let thumbnail = thumbnail(document, light);
    task.reach(0.9)?;
    let mut png = std::io::Cursor::new(Vec::new());
    thumbnail
        .write_to(&mut png, image::ImageFormat::Png)
        .map_err(|error| Problem::without_hint(&error))?;
    let kept = folder.join(format!("{number:04}.exr"));
    // We write the thumbnail first, because a revision counts as complete once its painting exists.
    write_whole(&kept.with_extension("png"), png.get_ref()).map_err(Problem::from)?;
    write_whole(&kept, &bytes).map_err(Problem::from)?;
    Ok(kept)
}

/// Lists the revisions of the painting in `path`, the newest first.
///
/// # Errors
/// [`JobError`] if the folder cannot be read.
pub(super) fn list(path: &Path, task: &Task) -> Result<Vec<Revision>, JobError> {
    let mut found = numbers(&folder(path))?;
    found.sort_unstable_by_key(|(number, _)| std::cmp::Reverse(*number));
    let mut revisions = Vec::with_capacity(found.len());
    for (number, path) in found {
        task.reach(0.0)?;
        let Ok(file) = disk::metadata(&path) else { continue };
        let thumbnail = read_thumbnail(&path.with_extension("png"));
        let bytes = file.len();
        let kept = file.modified().ok();
        revisions.push(Revision { number, path, bytes, kept, thumbnail });
    }
    Ok(revisions)
}

/// Deletes the revision in `path` with its thumbnail, and the folder if this empties it.
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
    // This fails if the folder is not empty.
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

/// Renders a thumbnail of at most [`MAX_SIDE`] pixels per side, in sRGB. We average in linear
/// light.
fn thumbnail(document: &Document, light: &Light) -> RgbImage {
    let picture = picture(document, &scene(document, light));
    let width = picture.width() as u32;
    let height = picture.height() as u32;
    let values = picture.values().iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
    let Some(linear) = image::Rgb32FImage::from_raw(width, height, values) else {
        return RgbImage::new(1, 1);
    };
    let longest = width.max(height).max(1);
    let [width, height] =
        [width, height].map(|length| (length * MAX_SIDE.min(longest) / longest).max(1));
    let small = image::imageops::resize(&linear, width, height, FilterType::Triangle);
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

/// A revision with its thumbnail as a texture.
#[derive(Clone)]
pub struct ListedRevision {
    /// File and number of the revision.
    pub revision: Revision,
    /// The thumbnail, if its file exists.
    pub texture: Option<TextureHandle>,
}

impl std::fmt::Debug for ListedRevision {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.revision.path.fmt(formatter)
    }
}

/// Revisions of the painting, the newest first.
#[derive(Debug, Clone, Default)]
pub struct RevisionList {
    /// The painting's file. Without one, there are no revisions.
    pub path: Option<PathBuf>,
    /// The revisions, the newest first.
    pub revisions: Vec<ListedRevision>,
}

impl RevisionList {
    /// Replaces the list and uploads the thumbnails.
    pub fn set(&mut self, ctx: &Context, path: Option<PathBuf>, revisions: Vec<Revision>) {
        self.path = path;
        let listed = revisions.into_iter().map(|revision| {
            let texture = revision.thumbnail.as_ref().map(|picture| {
                let size = [picture.width() as usize, picture.height() as usize];
                let image = ColorImage::from_rgba_unmultiplied(size, picture.as_raw());
                let name = revision.path.display().to_string();
                ctx.load_texture(name, image, TextureOptions::LINEAR)
            });
            ListedRevision { revision, texture }
        });
        self.revisions = listed.collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use paint::strokes::{Canvas, PaletteSpec};

    fn opened(name: &str, bytes: &[u8]) -> Result<Opened, JobError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        read(&path, &Task::default())
    }

    fn failure(name: &str, bytes: &[u8]) -> Problem {
        match opened(name, bytes) {
            Err(JobError::Failed(failure)) => failure,
            other => panic!("{name}: {other:?}"),
        }
    }

    fn script() -> StrokeScript {
        let canvas = Canvas {
            width_mm: 12.0,
            height_mm: 8.0,
            cell_mm: 0.5,
            ground: paint::ground::GroundSpec::default(),
        };
        let palette = PaletteSpec::from_names(["Zinc White", "Prussian Blue"]);
        StrokeScript::new("A study", "CC0-1.0", canvas, palette)
    }

    #[test]
    fn the_kind_is_detected_from_the_content_not_the_name() {
        let library = PigmentLibrary::van_gogh_oils();
        let script = script();
        let resolved = script.resolve(&library).unwrap();
        let (width, height) = script.canvas.cells();
        let ground = script.canvas.ground.build(width, height, 0.5, &library).unwrap();
        let document = script.bare(&library, &resolved, ground);
        let painting = paint::file::write(&document).unwrap();
        let bytes = Arc::new(painting.clone());
        let wanted = Opened::Painting { document: Box::new(document), table: Ok(None), bytes };
        assert_eq!(opened("a.txt", &painting), Ok(wanted));
        let opened_as = opened("b.png", script.to_json().unwrap().as_bytes()).unwrap();
        assert!(
            matches!(&opened_as, Opened::Recording { script: s, .. } if **s == script),
            "{opened_as:?}"
        );
        let opened_as = opened("c", library.to_json().as_bytes());
        assert_eq!(opened_as, Ok(Opened::Library(Box::new(library))));
        for picture in [
            &b"\x89PNG\r\n\x1a\nrest"[..],
            b"\xff\xd8\xff\xe0rest",
            b"II*\0\x08\0\0\0rest",
            b"MM\0*\0\0\0\x08rest",
            b"RIFF\x24\0\0\0WEBPVP8 rest",
        ] {
            assert_eq!(opened("d.exr", picture), Ok(Opened::Picture), "{picture:?}");
        }
        let scene = graphics::field::Field::filled(3, 2, [0.5, 2.0, 0.1, 1.0]);
        let scene = graphics::export::linear_exr(&scene, 0.1).unwrap();
        assert_eq!(opened("f.exr", &scene), Ok(Opened::Picture));
        assert_eq!(opened("e.json", b"nm,power\n400,1\n700,3\n"), Ok(Opened::Lamp));
    }

    #[test]
    fn a_file_that_cannot_be_opened_is_named_with_a_hint() {
        for (name, bytes) in [
            ("a.exr", &b"\x76\x2f\x31\x01cut off"[..]),
            ("b.json", b"{\"format\": "),
            ("c.json", b"{\"format\": \"other\"}"),
            ("d.json", b"{}"),
            ("e.txt", b"a shopping list"),
            ("f", b""),
        ] {
            let failure = failure(name, bytes);
            assert!(failure.text.contains(name), "{name}: {failure:?}");
            assert!(failure.hint.is_some(), "{name}: {failure:?}");
        }
        let missing = read(Path::new("/no/such/file.exr"), &Task::default());
        assert!(matches!(missing, Err(JobError::Failed(_))), "{missing:?}");
        let folder = tempfile::tempdir().unwrap();
        let opened_as = read(folder.path(), &Task::default());
        assert!(matches!(opened_as, Err(JobError::Failed(_))), "a folder: {opened_as:?}");
    }

    #[test]
    fn a_recording_uses_the_files_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let mut library = PigmentLibrary::van_gogh_oils();
        library.title = "mine".to_owned();
        std::fs::write(folder.path().join("mine.json"), library.to_json()).unwrap();
        let mut script = script();
        script.library = Some("mine.json".to_owned());
        let path = folder.path().join("strokes.json");
        let opened_as = |script: &StrokeScript| {
            std::fs::write(&path, script.to_json().unwrap()).unwrap();
            match read(&path, &Task::default()) {
                Ok(Opened::Recording { script, library, remarks }) => (script, library, remarks),
                other => panic!("no recording: {other:?}"),
            }
        };
        assert_eq!(opened_as(&script), (Box::new(script.clone()), Box::new(library), Vec::new()));
        script.library = Some("lost.json".to_owned());
        let (_, library, remarks) = opened_as(&script);
        assert_eq!((*library, remarks.len()), (PigmentLibrary::van_gogh_oils(), 1));
        script.library = None;
        std::fs::write(folder.path().join("before.exr"), "a painting").unwrap();
        script.start = Some("before.exr".to_owned());
        let (script, ..) = opened_as(&script);
        let wanted = folder.path().join("before.exr");
        assert_eq!(script.start.as_deref(), wanted.to_str());
    }
}
