//! What a file holds, found by its content and not by its name.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use pigment::library::PigmentLibrary;
use render::paint::document::Document;
use render::paint::ground::GroundRelief;
use render::paint::strokes::StrokeScript;
use serde::Deserialize;
use spectra::lamp_from_bytes;

use super::job::{Progress, Stopped};
use session::FileFailure;

/// What a file was opened as.
#[derive(Debug, Clone, PartialEq)]
pub enum Opened {
    /// A painting, and its file, which a recording of what is done to it needs.
    Painting(Box<Document>, Arc<Vec<u8>>),
    /// Pigments to begin a painting with.
    Library(Box<PigmentLibrary>),
    /// Strokes to be played.
    Recording {
        /// The script; files that it names are told from the root.
        script: Box<StrokeScript>,
        /// Its pigments.
        library: Box<PigmentLibrary>,
        /// What the painter should know.
        remarks: Vec<FileFailure>,
    },
    /// A picture, to stand beside the canvas.
    Picture,
    /// A measured lamp, which the light may be named after.
    Lamp,
}

/// The kinds of files, told apart by their first bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    OpenExr,
    Picture,
    Json,
    Text,
}

/// The longest file other than a painting, in bytes: 256 MiB.
const LONGEST: u64 = 256 << 20;

/// The longest painting, in bytes: 16 GiB.
const LONGEST_PAINTING: u64 = 16 << 30;

/// Reads `path` as whatever it is.
///
/// # Errors
/// [`Stopped`] if it cannot be read, is none of these, or is a faulty one.
pub fn read(path: &Path, progress: &Progress) -> Result<Opened, Stopped> {
    let (kind, mut file, length) = kind(path)?;
    let name = path.display().to_string();
    // A picture is decoded by whom it is for.
    if kind == Kind::Picture {
        return Ok(Opened::Picture);
    }
    let limit = if kind == Kind::OpenExr { LONGEST_PAINTING } else { LONGEST };
    if length > limit {
        let what = format!("{name}: a file of up to {limit} bytes is wanted, found `{length}`");
        return Err(FileFailure::new(what, WANTED).into());
    }
    let bytes = whole(path, &mut file, length, progress)?;
    let opened = match kind {
        Kind::OpenExr => {
            let document = render::paint::file::read(&name, &bytes)
                .map_err(|error| FileFailure::told(&error, error.hint()))?;
            Opened::Painting(Box::new(document), Arc::new(bytes))
        }
        Kind::Json => json(path, &name, &bytes)?,
        Kind::Picture | Kind::Text => {
            lamp_from_bytes(&name, &bytes, None).map_err(|error| {
                let told = FileFailure::told(&error, None::<String>);
                FileFailure::new(told.what, WANTED)
            })?;
            Opened::Lamp
        }
    };
    progress.tell(1.0)?;
    Ok(opened)
}

const WANTED: &str = "a painting (.exr), a pigment library or a recording (.json), a picture \
                      (.png, .jpg) or a lamp's spectrum can be opened";

fn kind(path: &Path) -> Result<(Kind, File, u64), FileFailure> {
    let unreadable = |error: std::io::Error| FileFailure::io(path, "read", &error);
    // Before it is opened: to open a pipe would wait for its other end.
    let found = std::fs::metadata(path).map_err(unreadable)?;
    if !found.is_file() {
        let what = format!("{}: an ordinary file is wanted", path.display());
        return Err(FileFailure::new(what, WANTED));
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
    } else if start.starts_with(b"\x89PNG\r\n\x1a\n") || start.starts_with(b"\xff\xd8\xff") {
        Kind::Picture
    } else if text.starts_with(b"{") {
        Kind::Json
    } else {
        Kind::Text
    };
    Ok((kind, File::open(path).map_err(unreadable)?, found.len()))
}

/// All of the file, told as half of the work.
fn whole(
    path: &Path,
    file: &mut File,
    length: u64,
    progress: &Progress,
) -> Result<Vec<u8>, Stopped> {
    const PIECE: u64 = 8 << 20;
    let mut bytes = Vec::with_capacity(length as usize);
    loop {
        progress.tell(0.5 * bytes.len() as f64 / length.max(1) as f64)?;
        let read = file.take(PIECE).read_to_end(&mut bytes);
        if read.map_err(|error| FileFailure::io(path, "read", &error))? == 0 {
            return Ok(bytes);
        }
    }
}

fn json(path: &Path, name: &str, bytes: &[u8]) -> Result<Opened, FileFailure> {
    #[derive(Deserialize)]
    struct Format {
        #[serde(default)]
        format: serde_json::Value,
    }
    let text = String::from_utf8_lossy(bytes);
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let Format { format } = serde_json::from_str(text)
        .map_err(|error| FileFailure::new(format!("{name}: no sound JSON: {error}"), WANTED))?;
    match format.as_str() {
        Some("impasto-pigment-library") => library(name, text),
        Some("strokes") => recording(path, name, bytes),
        _ => {
            let wanted = "`format` must be \"strokes\" or \"impasto-pigment-library\"";
            Err(FileFailure::new(format!("{name}: {wanted}, found `{format}`"), WANTED))
        }
    }
}

fn library(name: &str, text: &str) -> Result<Opened, FileFailure> {
    let library = PigmentLibrary::from_json(name, text)
        .map_err(|error| FileFailure::told(&error, error.hint()))?;
    Ok(Opened::Library(Box::new(library)))
}

fn recording(path: &Path, name: &str, bytes: &[u8]) -> Result<Opened, FileFailure> {
    let mut script =
        StrokeScript::from_json(name, bytes).map_err(|error| FileFailure::explained(&error))?;
    let folder = path.parent().map(Path::to_owned).unwrap_or_default();
    let mut remarks = Vec::new();
    let library = named_library(&script, &folder, &mut remarks)?;
    if let Some(start) = &mut script.start {
        // Its pigments are those of that painting.
        *start = folder.join(&start).display().to_string();
    } else {
        script.resolve(&library).map_err(|error| FileFailure::explained(&error))?;
    }
    for surface in std::iter::once(&mut script.canvas).chain(&mut script.mixing) {
        if let GroundRelief::Image(picture) = &mut surface.ground.relief {
            picture.path = folder.join(&picture.path).display().to_string();
        }
    }
    Ok(Opened::Recording { script: Box::new(script), library: Box::new(library), remarks })
}

/// The library that a script names: the built-in one by its title, else a file
/// beside the script, else the built-in one, which is said.
fn named_library(
    script: &StrokeScript,
    folder: &Path,
    remarks: &mut Vec<FileFailure>,
) -> Result<PigmentLibrary, FileFailure> {
    let built_in = PigmentLibrary::van_gogh_oils();
    let Some(named) = script.library.as_ref().filter(|named| **named != built_in.title) else {
        return Ok(built_in);
    };
    let path: PathBuf = folder.join(named);
    if !path.is_file() {
        let what = format!("the recording was made for the library `{named}`, which is not there");
        remarks.push(FileFailure::new(what, "the built-in oils are used"));
        return Ok(built_in);
    }
    let bytes = std::fs::read(&path).map_err(|error| FileFailure::io(&path, "read", &error))?;
    let text = String::from_utf8_lossy(&bytes);
    PigmentLibrary::from_json(&path.display().to_string(), &text)
        .map_err(|error| FileFailure::told(&error, error.hint()))
}

#[cfg(test)]
mod tests {
    use render::paint::strokes::{Canvas, PaletteSpec};

    use super::*;

    fn opened(name: &str, bytes: &[u8]) -> Result<Opened, Stopped> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        read(&path, &Progress::default())
    }

    fn failure(name: &str, bytes: &[u8]) -> FileFailure {
        match opened(name, bytes) {
            Err(Stopped::Failed(failure)) => failure,
            other => panic!("{name}: {other:?}"),
        }
    }

    fn script() -> StrokeScript {
        let canvas = Canvas {
            width_mm: 12.0,
            height_mm: 8.0,
            cell_mm: 0.5,
            ground: render::paint::ground::GroundSpec::default(),
        };
        let palette = PaletteSpec::from_names(["Zinc White", "Prussian Blue"]);
        StrokeScript::new("A study", "CC0-1.0", canvas, palette)
    }

    #[test]
    fn kinds_are_found_by_content_whatever_the_name() {
        let library = PigmentLibrary::van_gogh_oils();
        let script = script();
        let resolved = script.resolve(&library).unwrap();
        let (width, height) = script.canvas.cells();
        let ground = script.canvas.ground.ground(width, height, 0.5, &library).unwrap();
        let document = script.bare(&library, &resolved, ground);
        let painting = render::paint::file::write(&document).unwrap();
        let wanted = Opened::Painting(Box::new(document), Arc::new(painting.clone()));
        assert_eq!(opened("a.txt", &painting), Ok(wanted));
        let told = opened("b.png", script.to_json().unwrap().as_bytes()).unwrap();
        assert!(matches!(&told, Opened::Recording { script: s, .. } if **s == script), "{told:?}");
        let told = opened("c", library.to_json().as_bytes());
        assert_eq!(told, Ok(Opened::Library(Box::new(library))));
        assert_eq!(opened("d.exr", b"\x89PNG\r\n\x1a\nrest"), Ok(Opened::Picture));
        assert_eq!(opened("e.json", b"nm,power\n400,1\n700,3\n"), Ok(Opened::Lamp));
    }

    #[test]
    fn what_cannot_be_opened_names_the_file_and_the_way_out() {
        for (name, bytes) in [
            ("a.exr", &b"\x76\x2f\x31\x01cut off"[..]),
            ("b.json", b"{\"format\": "),
            ("c.json", b"{\"format\": \"other\"}"),
            ("d.json", b"{}"),
            ("e.txt", b"a shopping list"),
            ("f", b""),
        ] {
            let failure = failure(name, bytes);
            assert!(failure.what.contains(name), "{name}: {failure}");
            assert!(failure.hint.is_some(), "{name}: {failure}");
        }
        let missing = read(Path::new("/no/such/file.exr"), &Progress::default());
        assert!(matches!(missing, Err(Stopped::Failed(_))), "{missing:?}");
        let folder = tempfile::tempdir().unwrap();
        let told = read(folder.path(), &Progress::default());
        assert!(matches!(told, Err(Stopped::Failed(_))), "a folder: {told:?}");
    }

    #[test]
    fn a_recording_takes_the_files_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let mut library = PigmentLibrary::van_gogh_oils();
        library.title = "mine".to_owned();
        std::fs::write(folder.path().join("mine.json"), library.to_json()).unwrap();
        let mut script = script();
        script.library = Some("mine.json".to_owned());
        let path = folder.path().join("strokes.json");
        let told = |script: &StrokeScript| {
            std::fs::write(&path, script.to_json().unwrap()).unwrap();
            match read(&path, &Progress::default()) {
                Ok(Opened::Recording { script, library, remarks }) => (script, library, remarks),
                other => panic!("no recording: {other:?}"),
            }
        };
        assert_eq!(told(&script), (Box::new(script.clone()), Box::new(library), Vec::new()));
        script.library = Some("lost.json".to_owned());
        let (_, library, remarks) = told(&script);
        assert_eq!((*library, remarks.len()), (PigmentLibrary::van_gogh_oils(), 1));
        script.library = None;
        script.start = Some("before.exr".to_owned());
        let (script, ..) = told(&script);
        let wanted = folder.path().join("before.exr");
        assert_eq!(script.start.as_deref(), wanted.to_str());
    }
}
