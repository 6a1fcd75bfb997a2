//! The readers, each with sound files.

use std::path::Path;

use artmap::painted::Style;
use artmap::passages::Marks;
use calibrate::library::PigmentLibrary;
use calibrate::{FitRequest, ReadingOptions, Readings, Residuals};
use documents::request::request_from_json;
use graphics::camera::CameraPath;
use graphics::exr_picture::linear_picture;
use graphics::mesh::Mesh;
use graphics::picture::Photograph;
use image::ImageFormat;
use maps::Book;
use maps::cube::{Cube, CubeOptions, CubeScale};
use paint::strokes::StrokeScript;
use painterly::Regions;
use painterly::guides::Guides;
use session::brushes::BrushSet;
use session::swatches::SwatchBook;
use spectra::color_book::ColorBook;
use spectra::{WavelengthList, lamp_from_bytes};
use volumes::script::Script;

/// Kind of the files that a reader takes. One test feeds all readers of the same kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Measurement,
    Toml,
    Json,
    Binary,
}

impl Kind {
    /// Inputs for each reader in CI.
    pub(crate) fn inputs(self) -> u64 {
        match self {
            Self::Measurement | Self::Json => 4_000,
            Self::Toml => 10_000,
            // Pictures are unpacked.
            Self::Binary => 1_500,
        }
    }
}

/// Names and bytes of files.
type Files = Vec<(String, Vec<u8>)>;

/// A reader of a file.
pub(crate) struct Reader {
    pub(crate) name: &'static str,
    pub(crate) kind: Kind,
    /// Sound files, with names whose endings the reader knows.
    pub(crate) seeds: fn() -> Files,
    /// Reads a file by its name and bytes. An error is in words.
    pub(crate) read: fn(&str, &[u8]) -> Result<(), String>,
}

fn words<T, E: std::fmt::Display>(read: Result<T, E>) -> Result<(), String> {
    read.map(drop).map_err(|error| error.to_string())
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Reads a file on the disk.
fn on_disk(
    name: &str,
    bytes: &[u8],
    read: impl Fn(&Path) -> Result<(), String>,
) -> Result<(), String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    read(&path)
}

/// Files below the fixtures.
fn fixtures(names: &[&str]) -> Files {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures");
    names.iter().map(|name| file(&folder.join(name))).collect()
}

fn file(path: &Path) -> (String, Vec<u8>) {
    let name = path.file_name().unwrap().to_str().unwrap().to_owned();
    (name, std::fs::read(path).unwrap())
}

/// All files of a folder below the fixtures but its README.
fn folder(name: &str) -> Files {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name);
    let mut paths: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_none_or(|ending| ending != "md"));
    paths.sort();
    paths.iter().map(|path| file(path)).collect()
}

fn made(name: &str, content: &str) -> (String, Vec<u8>) {
    (name.to_owned(), content.as_bytes().to_vec())
}

/// The heading and some rows of the oils that ship.
fn oils() -> Files {
    let all = include_str!("../../../measurements/van-gogh-oils.csv");
    let rows: Vec<&str> = all.lines().take(24).collect();
    let table = "sample;film;backing;thickness_mm;Red (g);White (g);400;500;600;700\n\
        a;paint;white;0,1;1;0;0,1;0,2;0,3;0,4\nb;none;white;;;;0,9;0,9;0,9;0,9\n";
    vec![made("oils.csv", &rows.join("\n")), made("table.csv", table)]
}

fn pictures() -> Files {
    let picture =
        image::RgbImage::from_fn(9, 7, |x, y| image::Rgb([x as u8 * 20, y as u8 * 30, 99]));
    [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::Tiff, ImageFormat::WebP]
        .into_iter()
        .map(|format| {
            let mut bytes = std::io::Cursor::new(Vec::new());
            picture.write_to(&mut bytes, format).unwrap();
            (format!("picture.{}", format.extensions_str()[0]), bytes.into_inner())
        })
        .collect()
}

fn linear_pictures() -> Files {
    let mut picture = graphics::field::Field::filled(9, 7, [0.5_f32, 0.25, 0.125, 1.0]);
    picture[(3, 4)] = [12.0, 0.0, 1.0, 1.0];
    vec![("picture.exr".to_owned(), graphics::export::linear_exr(&picture, 0.1).unwrap())]
}

/// A scan of 3 lines, 4 samples and 4 bands in one file: the header, a line `DATA`, and the data.
fn scans() -> Files {
    let header = "ENVI\nlines = 3\nsamples = 4\nbands = 4\nheader offset = 0\ndata type = 1\ninterleave = bil\n\
        byte order = 0\nwavelength units = nm\nwavelength = {400, 500, 600, 700}\nDATA\n";
    let mut bytes = header.as_bytes().to_vec();
    bytes.extend((0..48).map(|at| 40 + 3 * at));
    vec![("scan.hdr".to_owned(), bytes)]
}

fn read_scan(name: &str, bytes: &[u8]) -> Result<(), String> {
    let mark = b"DATA\n";
    let at = bytes.windows(mark.len()).position(|window| window == mark);
    let (header, data) =
        at.map_or((bytes, &[][..]), |at| (&bytes[..at], &bytes[at + mark.len()..]));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, header).unwrap();
    std::fs::write(path.with_extension("bil"), data).unwrap();
    let options = CubeOptions { scale: CubeScale::White(200.0), ..CubeOptions::default() };
    let cube = Cube::open_with(&path, &options).map_err(|error| error.to_string())?;
    words(cube.read_rows(0..1))
}

/// All readers.
pub(crate) const READERS: &[Reader] = &[
    Reader {
        name: "instruments",
        kind: Kind::Measurement,
        seeds: || {
            let mut files = [folder("instruments"), folder("instruments_xml")].concat();
            // A table of measurements.
            files.retain(|(name, _)| name != "sheet.csv");
            files
        },
        read: |name, bytes| words(spectra::instrument::read(name, bytes, None)),
    },
    Reader {
        name: "measurements",
        kind: Kind::Measurement,
        seeds: oils,
        read: |name, bytes| {
            words(Readings::from_files(&[(name, bytes)], &ReadingOptions::default()))
        },
    },
    Reader {
        name: "spectra",
        kind: Kind::Measurement,
        seeds: oils,
        read: |name, bytes| {
            words(Readings::spectra_from_files(&[(name, bytes)], &ReadingOptions::default()))
        },
    },
    Reader {
        name: "lamps",
        kind: Kind::Measurement,
        seeds: || vec![made("lamp.txt", "nm,power\n400,1\n500,2\n600,2.5\n700,3\n780,3\n")],
        read: |name, bytes| words(lamp_from_bytes(name, bytes, None)),
    },
    Reader {
        name: "wavelengths",
        kind: Kind::Measurement,
        seeds: || vec![made("nm.txt", "400\n410.5\n420\n700 nm\n")],
        read: |name, bytes| words(WavelengthList::from_text(name, &text(bytes))),
    },
    Reader {
        name: "colour books",
        kind: Kind::Measurement,
        seeds: || {
            vec![
                made("book.csv", "name,L*,a*,b*\nRAL 5012,55.1,-15.3,-31.9\nSky,80,-3,-12\n"),
                made(
                    "book.gpl",
                    "GIMP Palette\nName: two\nColumns: 0\n#\n255 0 0\tRed\n0 9 200\tBlue\n",
                ),
            ]
        },
        read: |name, bytes| words(ColorBook::read(name, bytes, None)),
    },
    Reader { name: "spectral scans", kind: Kind::Measurement, seeds: scans, read: read_scan },
    Reader {
        name: "watercolour settings",
        kind: Kind::Toml,
        seeds: || fixtures(&["formats/landscape.toml", "formats/rough.toml"]),
        read: |name, bytes| words(watercolor::Settings::from_toml(name, &text(bytes))),
    },
    Reader {
        name: "painterly settings",
        kind: Kind::Toml,
        seeds: || fixtures(&["formats/night.toml"]),
        read: |name, bytes| words(painterly::Settings::from_toml(name, &text(bytes))),
    },
    Reader {
        name: "volume settings",
        kind: Kind::Toml,
        seeds: || fixtures(&["formats/bleed.toml"]),
        read: |name, bytes| words(volumes::settings::Settings::from_toml(name, &text(bytes))),
    },
    Reader {
        name: "volume scripts",
        kind: Kind::Toml,
        seeds: || fixtures(&["formats/village.toml", "formats/poured.toml"]),
        read: |name, bytes| words(Script::from_text(name, &text(bytes))),
    },
    Reader {
        name: "styles",
        kind: Kind::Toml,
        seeds: || fixtures(&["formats/dabs.toml"]),
        read: |name, bytes| words(Style::from_toml(name, &text(bytes))),
    },
    Reader {
        name: "marks",
        kind: Kind::Toml,
        seeds: || fixtures(&["formats/marks.toml"]),
        read: |name, bytes| words(Marks::from_toml(name, &text(bytes))),
    },
    Reader {
        name: "guides",
        kind: Kind::Toml,
        seeds: || fixtures(&["formats/guides.toml"]),
        read: |name, bytes| words(Guides::from_toml(name, &text(bytes))),
    },
    Reader {
        name: "regions",
        kind: Kind::Toml,
        seeds: || {
            // A region by label needs a picture beside the file.
            let region = "name = \"sky\"\npolygon = [[0, 0], [600, 0], [600, 180], [0, 220]]\n\
                around = [420, 90]\nmap = \"oil-long\"\nflow = 2\ntwinkle = 0.2\nsize = 1.5\n";
            vec![made("regions.toml", &format!("[[region]]\n{region}"))]
        },
        read: |name, bytes| words(Regions::from_toml(name, &text(bytes))),
    },
    Reader {
        name: "camera paths",
        kind: Kind::Toml,
        seeds: || fixtures(&["formats/camera.toml"]),
        read: |name, bytes| words(CameraPath::from_text(name, &text(bytes))),
    },
    Reader {
        name: "pigment libraries",
        kind: Kind::Json,
        seeds: || fixtures(&["formats/library.json"]),
        read: |name, bytes| words(PigmentLibrary::from_json(name, &text(bytes))),
    },
    Reader {
        name: "residuals",
        kind: Kind::Json,
        seeds: || fixtures(&["formats/residuals.json"]),
        read: |name, bytes| words(Residuals::from_json(name, &text(bytes))),
    },
    Reader {
        name: "surveys",
        kind: Kind::Json,
        seeds: || fixtures(&["formats/survey.json"]),
        read: |_, bytes| words(Book::from_json(&text(bytes))),
    },
    Reader {
        name: "scripts of strokes",
        kind: Kind::Json,
        seeds: || fixtures(&["formats/every-action.json"]),
        read: |name, bytes| words(StrokeScript::from_json(name, bytes)),
    },
    Reader {
        name: "brushes",
        kind: Kind::Json,
        seeds: || fixtures(&["formats/brushes.json"]),
        read: |name, bytes| words(BrushSet::of_json(&text(bytes), name)),
    },
    Reader {
        name: "kept mixtures",
        kind: Kind::Json,
        seeds: || fixtures(&["formats/swatches.json"]),
        read: |name, bytes| words(SwatchBook::from_json(name, &text(bytes))),
    },
    Reader {
        name: "requests of fits",
        kind: Kind::Json,
        seeds: || vec![made("fit.json", r#"{"method": "qp", "reference": null}"#)],
        read: |_, bytes| words(request_from_json::<FitRequest>(&text(bytes))),
    },
    Reader {
        name: "paintings",
        kind: Kind::Binary,
        seeds: || fixtures(&["formats/painting.exr", "formats/with-palette.exr"]),
        read: |name, bytes| {
            words(paint::file::read(name, bytes))?;
            words(paint::file::read_table(name, bytes))
        },
    },
    Reader {
        name: "samples of brushwork",
        kind: Kind::Binary,
        seeds: || fixtures(&["formats/samples.exr"]),
        read: |name, bytes| words(artmap::sample::file::read(name, bytes)),
    },
    Reader {
        name: "photographs",
        kind: Kind::Binary,
        seeds: pictures,
        read: |name, bytes| words(Photograph::from_bytes(name, bytes)),
    },
    Reader {
        name: "pictures in linear light",
        kind: Kind::Binary,
        seeds: linear_pictures,
        read: |name, bytes| words(linear_picture(name, bytes)),
    },
    Reader {
        name: "models",
        kind: Kind::Binary,
        seeds: || {
            let model = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nvn 0 0 1\nvt 0 0.5\nf 1/1/1 2/1/1 3/1/1\nf 1 3 4\n";
            let points = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
                0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
            vec![made("model.obj", model), made("model.ply", points)]
        },
        read: |name, bytes| on_disk(name, bytes, |path| words(Mesh::open(path))),
    },
];
