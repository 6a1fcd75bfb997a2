//! Reads files of any kind; the kind is detected from the content, not the name.

use documents::file::disk;
use documents::file::disk::File;
use std::io::Read;
use std::path::Path;
use std::sync::Arc;

use graphics::exr_picture::linear_picture;
use graphics::picture_formats::begins_like_picture;
use paint::document::Document;
use paint::file::PaintingFileError;
use paint::strokes::{SideTable, StrokeScript};
use pigment::library::PigmentLibrary;
use serde::Deserialize;
use spectra::lamp_from_bytes;

use super::job::{JobError, Progress};
use super::problem::Problem;
use crate::language::{tr, tr_format};

/// The content of a file.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Opened {
    /// A painting.
    Painting {
        /// The painting itself.
        document: Box<Document>,
        /// Palette and brushes that were saved with it; the problem if they cannot be read.
        table: Result<Option<Box<SideTable>>, Problem>,
        /// Content of its file, which a recording of further work on it needs.
        bytes: Arc<Vec<u8>>,
    },
    /// A pigment library to begin a painting with.
    Library(Box<PigmentLibrary>),
    /// A recording to be played.
    Recording {
        /// The script, with absolute paths of the files that it names.
        script: Box<StrokeScript>,
        /// The pigments that it names.
        library: Box<PigmentLibrary>,
        /// Remarks for the painter.
        remarks: Vec<Problem>,
    },
    /// A picture to be shown beside the canvas. It is decoded where it is shown.
    Picture,
    /// The spectrum of a lamp. A light can be named after this file.
    Lamp,
}

/// Kinds of files, distinguished by their first bytes.
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
pub(crate) fn read(path: &Path, progress: &Progress) -> Result<Opened, JobError> {
    let (kind, mut file, length) = kind(path)?;
    let name = path.display().to_string();
    // A picture is decoded where it is shown.
    if kind == Kind::Picture {
        return Ok(Opened::Picture);
    }
    let limit = if kind == Kind::OpenExr { MAX_PAINTING_BYTES } else { MAX_BYTES };
    if length > limit {
        let text = format!("{name}: the file must have at most {limit} bytes, found `{length}`");
        return Err(Problem::new(text, OPENABLE).into());
    }
    let bytes = read_all(path, &mut file, length, progress)?;
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
                // A linear picture of another program.
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
    progress.report(1.0)?;
    Ok(opened)
}

const OPENABLE: &str = "open a painting (.exr), a pigment library or a recording (.json), a \
                        picture (.png, .jpg, .tif, .webp) or the spectrum of a lamp";

fn kind(path: &Path) -> Result<(Kind, File, u64), Problem> {
    let unreadable = |error: std::io::Error| Problem::io(path, "read", &error);
    // Checked before opening it, because opening a pipe would wait for its other end.
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
fn read_all(
    path: &Path,
    file: &mut File,
    length: u64,
    progress: &Progress,
) -> Result<Vec<u8>, JobError> {
    const PIECE: u64 = 8 << 20;
    let mut bytes = Vec::with_capacity(length as usize);
    loop {
        progress.report(0.5 * bytes.len() as f64 / length.max(1) as f64)?;
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
    if let Some(start) = &mut script.start {
        // The script is not resolved here: its pigments are those of the painting that it
        // starts from.
        *start = folder.join(&start).display().to_string();
    } else {
        script.resolve(&library).map_err(|error| Problem::from_error(&error))?;
    }
    script.complete_picture_paths(&folder);
    Ok(Opened::Recording { script: Box::new(script), library: Box::new(library), remarks })
}

#[cfg(test)]
mod tests {
    use paint::strokes::{Canvas, PaletteSpec};

    use super::*;

    fn opened(name: &str, bytes: &[u8]) -> Result<Opened, JobError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        read(&path, &Progress::default())
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
        let missing = read(Path::new("/no/such/file.exr"), &Progress::default());
        assert!(matches!(missing, Err(JobError::Failed(_))), "{missing:?}");
        let folder = tempfile::tempdir().unwrap();
        let opened_as = read(folder.path(), &Progress::default());
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
            match read(&path, &Progress::default()) {
                Ok(Opened::Recording { script, library, remarks }) => (script, library, remarks),
                other => panic!("no recording: {other:?}"),
            }
        };
        assert_eq!(opened_as(&script), (Box::new(script.clone()), Box::new(library), Vec::new()));
        script.library = Some("lost.json".to_owned());
        let (_, library, remarks) = opened_as(&script);
        assert_eq!((*library, remarks.len()), (PigmentLibrary::van_gogh_oils(), 1));
        script.library = None;
        script.start = Some("before.exr".to_owned());
        let (script, ..) = opened_as(&script);
        let wanted = folder.path().join("before.exr");
        assert_eq!(script.start.as_deref(), wanted.to_str());
    }
}
