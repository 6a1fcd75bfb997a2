//! The readers, each with sound files.

use std::path::Path;

use artmap::painted::Style;
use artmap::passages::Marks;
use calibrate::curation::{self, LibraryFrame};
use calibrate::library::{AmountKind, PigmentLibrary};
use calibrate::measurement::Recipes;
use calibrate::{FitRequest, ReadingOptions, Readings, Residuals};
use documents::file::Outside;
use documents::hint::Explain;
use documents::request::request_from_json;
use graphics::camera::CameraPath;
use graphics::exr_picture::linear_picture;
use graphics::mesh::ModelFile;
use graphics::picture::Photograph;
use graphics::tones::ToneRamp;
use maps::cube::{Cube, CubeOptions, CubeScale};
use maps::truth::Truth;
use maps::{Book, StoredMaps};
use paint::document::Document;
use paint::strokes::StrokeScript;
use painterly::Regions;
use painterly::guides::Guides;
use session::LostSession;
use session::brushes::BrushSet;
use session::swatches::SwatchBook;
use spectra::color_book::ColorBook;
use spectra::optics::Surface;
use spectra::{WavelengthList, lamp_from_bytes};
use volumes::script::Script;

use super::input::{Files, on_disk};
use super::seeds::{
    autosaves, fixtures, folder, library_tables, linear_pictures, made, maps_and_truth, models,
    oils, palettes, pictures, scans, workbooks, zipped,
};

/// Kind of the files that a reader takes. One test feeds all readers of the same kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Measurement,
    Toml,
    Json,
    Binary,
}

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

fn frame() -> LibraryFrame {
    LibraryFrame {
        title: "a table".to_owned(),
        licence: "CC0-1.0".to_owned(),
        source: "a table".to_owned(),
        amounts: AmountKind::Relative,
        reference: None,
        saunderson: Surface::NONE,
    }
}

fn read_scan(path: &Path) -> Result<(), String> {
    let scale = match path.extension().is_some_and(|ending| ending == "hdr" || ending == "tif") {
        true => CubeScale::White(200.0),
        false => CubeScale::default(),
    };
    let cube = Cube::open_with(path, &CubeOptions { scale, ..CubeOptions::default() });
    words(cube.map_err(|error| error.to_string())?.read_rows(0..1))
}

/// Reads a model, which must be sound then, and not larger than its file.
fn read_model(name: &str, bytes: &[u8]) -> Result<(), String> {
    on_disk(name, bytes, |path| {
        let file = ModelFile::open(path, Outside::Refused).map_err(|error| {
            let message = error.to_string();
            assert!(error.hint().is_some(), "{message}: no way out");
            assert!(message.contains(name) || message.contains("a.mtl"), "{message}: no file");
            message
        })?;
        file.mesh.check().unwrap();
        let longest = file.mesh.positions.len().max(file.mesh.triangles.len());
        // Two nodes show a mesh of the seeds twice.
        assert!(longest <= 2 * bytes.len() + 60, "{longest} vertices or triangles");
        Ok(())
    })
}

fn read_maps(path: &Path) -> Result<(), String> {
    if path.ends_with("truth.zarr") {
        let truth = Truth::open(path).map_err(|error| error.to_string())?;
        return words(truth.block(0));
    }
    let maps = StoredMaps::open(path).map_err(|error| error.to_string())?;
    words(maps.read(0..1, 0..1))
}

fn read_autosave(path: &Path) -> Result<(), String> {
    for lost in LostSession::all(path).map_err(|error| error.to_string())? {
        lost.work().map_err(|error| error.to_string())?;
        for file in lost.files() {
            words(Document::open(&file))?;
        }
    }
    Ok(())
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
    Reader {
        name: "palettes",
        kind: Kind::Measurement,
        seeds: palettes,
        read: |name, bytes| words(ColorBook::read(name, bytes, None)),
    },
    Reader {
        name: "workbooks",
        kind: Kind::Measurement,
        seeds: workbooks,
        read: |name, bytes| words(spectra::instrument::read(name, &zipped(bytes), None)),
    },
    Reader {
        name: "recipes",
        kind: Kind::Measurement,
        seeds: || {
            let recipes = "sample,reading,film,backing,thickness_mm,Red (g),White (g)\n\
                a,white,paint,white,0.1,1,0.5\na,black,paint,black,0.1,1,0.5\nb,,none,white,,,\n";
            vec![made("recipes.csv", recipes)]
        },
        read: |name, bytes| words(Recipes::from_csv(name, bytes, None)),
    },
    Reader {
        name: "tables of a library",
        kind: Kind::Measurement,
        seeds: library_tables,
        read: |name, bytes| words(curation::from_csv(name, &text(bytes), frame())),
    },
    Reader {
        name: "spectral scans",
        kind: Kind::Measurement,
        seeds: scans,
        read: |name, bytes| on_disk(name, bytes, read_scan),
    },
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
        name: "art maps",
        kind: Kind::Binary,
        seeds: || fixtures(&["formats/artmap.exr"]),
        read: |name, bytes| words(artmap::map::file::read(name, bytes)),
    },
    Reader {
        name: "tone ramps",
        kind: Kind::Binary,
        seeds: pictures,
        read: |name, bytes| on_disk(name, bytes, |path| words(ToneRamp::open(path))),
    },
    Reader { name: "models", kind: Kind::Binary, seeds: models, read: read_model },
    Reader {
        name: "maps and truth",
        kind: Kind::Binary,
        seeds: maps_and_truth,
        read: |name, bytes| on_disk(name, bytes, read_maps),
    },
    Reader {
        name: "autosaves",
        kind: Kind::Binary,
        seeds: autosaves,
        read: |name, bytes| on_disk(name, bytes, read_autosave),
    },
];
