//! Simulated scans: their truth, their bytes, and how near their maps come to it. The scans are of
//! known mixtures and of small paintings with paint laid by hand.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use calibrate::PigmentLibrary;
use graphics::field::Field;
use maps::cube::envi::WRITTEN_SCALE;
use maps::truth::{PaintClass, Truth};
use paint::amount::quanta_from_mm;
use paint::document::{Document, DryLayer, LayerId, Lighting, Medium, Slots};
use paint::file;
use paint::ground::Ground;
use paint::layer::Layer;
use paint::optics::Gloss;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};
use serde_json::Value;
use suite::oils::library;
use suite::program::{Run, impasto, repository};

fn simulate(painting: &Path, scan: &Path, more: &[&str]) -> Run {
    let [painting, scan] = [painting, scan].map(|path| path.display().to_string());
    impasto(&[&["simulate-scan", &painting, "-o", &scan], more].concat())
}

const CLEAR: [&str; 10] =
    ["--blur", "0", "--shot-noise", "0", "--read-noise", "0", "--drift", "0", "--surface", "0"];

#[test]
fn truth_is_what_is_known_by_hand() {
    let folder = tempfile::tempdir().unwrap();
    let mut document = bare(16, 6, with_clear_viridian());
    lay(&mut document.wet, (12..16, 0..6), &[("Lead White", 4.0)]);
    let mut document = dried(document);
    lay(&mut document.wet, (4..8, 0..6), &[("Lead White", 3.0), ("Vermilion", 1.0)]);
    // K d = 0.01 mm x 50 x 1, so that exp(-2 K d) of the contrast below remains.
    let hidden = 1.0 - (-1.0f64).exp();
    lay(&mut document.wet, (8..16, 0..6), &[("Viridian", 0.01)]);
    let painting = written_painting(&document, folder.path());
    let scan = folder.path().join("scan.hdr");
    let run = simulate(&painting, &scan, &CLEAR);
    assert_eq!(run.status, 0, "{}", run.err);
    let truth = Truth::open(folder.path().join("scan-truth.zarr")).unwrap();
    assert_eq!((truth.lines(), truth.samples()), (6, 16));
    let rows = truth.block(0).unwrap();
    let order = ["Lead White", "Vermilion", "Viridian"]
        .map(|name| truth.pigments().iter().position(|known| known == name).unwrap());
    for (sample, class, ground, shares) in [
        (1, PaintClass::Bare, 1.0, [0.0; 3]),
        (5, PaintClass::Hiding, 0.0, [0.75, 0.25, 0.0]),
        (9, PaintClass::Thin, 1.0 - hidden, [0.0, 0.0, 1.0]),
        (13, PaintClass::Glaze, 0.0, [1.0 - hidden, 0.0, hidden]),
    ] {
        let at = 3 * 16 + sample;
        assert_eq!(rows.class[at], class, "column {sample}");
        assert!((f64::from(rows.ground[at]) - ground).abs() < 1e-3, "{}", rows.ground[at]);
        for (place, expected) in order.iter().zip(shares) {
            let found = f64::from(rows.share[at * truth.pigments().len() + place]);
            assert!((found - expected).abs() < 1e-3, "column {sample}: {found}, not {expected}");
        }
    }
    // Without blur, noise and drift the scan has the exact spectra.
    let cube = maps::Cube::open(&scan).unwrap();
    let block = cube.read_rows(0..6).unwrap();
    let mixture = document
        .library
        .mix(document.library.recipe([("Lead White", 0.75), ("Vermilion", 0.25)]).unwrap());
    let exact = mixture.unwrap().hiding(document.library.saunderson);
    for (found, exact) in block.pixel(2 * 16 + 6).iter().zip(&exact) {
        let apart = (f64::from(*found) - exact).abs();
        assert!(apart < 0.6 / f64::from(WRITTEN_SCALE), "{found}, not {exact}");
    }
}

#[test]
fn blur_makes_edges_and_joins_the_truth_as_it_joins_light() {
    let folder = tempfile::tempdir().unwrap();
    let painting = written_painting(&patches(), folder.path());
    let scan = folder.path().join("scan.hdr");
    let run = simulate(&painting, &scan, &["--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    let classes = &run.json()["classes"];
    let [hiding, edge] = ["hiding", "edge"].map(|class| classes[class].as_u64().unwrap());
    assert_eq!(hiding + edge, 64 * 48, "{classes}");
    assert!(edge > 300 && hiding > 1500, "{classes}");
    let truth = Truth::open(folder.path().join("scan-truth.zarr")).unwrap();
    let rows = truth.block(0).unwrap();
    let viridian = truth.pigments().iter().position(|name| name == "Viridian").unwrap();
    let [inside, left, right] =
        [40, 47, 48].map(|x| rows.share[(8 * 64 + x) * rows.pigments + viridian]);
    // From a patch with 30 % of it to one with none, and half as much at the edge between both.
    let edge = f32::midpoint(left, right);
    assert!((inside - 0.3).abs() < 1e-3 && (edge - 0.15).abs() < 1e-3, "{edge}");
}

#[test]
fn the_same_seed_gives_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let painting = written_painting(&patches(), folder.path());
    let bytes = |name: &str, more: &[&str]| {
        let run = simulate(&painting, &folder.path().join(format!("{name}.hdr")), more);
        assert_eq!(run.status, 0, "{}", run.err);
        let chunk = folder.path().join(format!("{name}-truth.zarr/share/c/0/0/0"));
        [folder.path().join(format!("{name}.bil")), chunk].map(|path| std::fs::read(path).unwrap())
    };
    let first = bytes("first", &[]);
    assert_eq!(first[0].len(), 64 * 48 * 31 * 2);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(pool.install(|| bytes("second", &[])), first);
    let header = std::fs::read_to_string(folder.path().join("first.hdr")).unwrap();
    assert!(header.contains("seed 1") && header.contains("blur 1.5"), "{header}");
    let other = bytes("third", &["--seed", "2"]);
    assert!(other[0] != first[0] && other[1] == first[1], "the truth is that of the painting");
    // A second run replaces the files of the first one.
    assert_eq!(bytes("third", &[]), first);
}

fn figure(json: &Value, kind: &str, figure: &str) -> f64 {
    let rows = json["truth"]["kinds"].as_array().unwrap();
    let row = rows.iter().find(|row| row["kind"] == kind).unwrap();
    row[figure].as_f64().unwrap()
}

#[test]
fn maps_of_a_simulated_scan_are_near_its_truth() {
    let folder = tempfile::tempdir().unwrap();
    let painting = written_painting(&patches(), folder.path());
    let [out_of_31, out_of_204, truth, scanned] =
        ["maps-31", "maps-204", "scan-truth.zarr", "scan.hdr"]
            .map(|name| folder.path().join(name).display().to_string());
    for (bands, out) in [("31", out_of_31), ("204", out_of_204)] {
        let scan = folder.path().join("scan.hdr");
        assert_eq!(simulate(&painting, &scan, &["--bands", bands]).status, 0);
        let run = impasto(&["map", &scanned, "-o", &out, "--truth", &truth, "--json"]);
        assert_eq!(run.status, 0, "{}", run.err);
        let json = run.json();
        for (kind, precision, recall, error) in [
            ("hiding, light", 0.8, 0.9, 0.06),
            ("hiding, middle", 0.9, 0.9, 0.1),
            ("hiding, dark", 0.75, 0.85, 0.25),
        ] {
            let [p, r, e] =
                ["precision", "recall", "share_error"].map(|name| figure(&json, kind, name));
            assert!(p > precision && r > recall && e < error, "{bands}, {kind}: {p} {r} {e}");
        }
        assert!(figure(&json, "hiding, light", "chi2_risen") < 0.2, "{}", json["truth"]);
    }
}

#[test]
fn bare_ground_is_told_by_a_region_or_a_file_and_no_paint_is() {
    let folder = tempfile::tempdir().unwrap();
    let mut document = bare(64, 48, library());
    lay(&mut document.wet, (24..64, 0..24), &[("Lead White", 2.0), ("Viridian", 1.0)]);
    lay(&mut document.wet, (24..64, 24..48), &[("Lead White", 3.0), ("Bone Black", 0.1)]);
    let painting = written_painting(&document, folder.path());
    let path = |name: &str| folder.path().join(name).display().to_string();
    assert_eq!(simulate(&painting, &folder.path().join("scan.hdr"), &[]).status, 0);
    let rows: Vec<String> = (0..31).map(|i| format!("{},0.6", 400 + 10 * i)).collect();
    std::fs::write(path("ground.csv"), format!("nm,ground\n{}\n", rows.join("\n"))).unwrap();
    for (name, ground) in [("region", "2..20,2..14".to_owned()), ("file", path("ground.csv"))] {
        let out = path(name);
        let truth = path("scan-truth.zarr");
        let run = impasto(
            &[
                &["map", &path("scan.hdr"), "-o", &out, "--ground", &ground],
                &["--truth", &truth, "--json"][..],
            ]
            .concat(),
        );
        assert_eq!(run.status, 0, "{name}: {}", run.err);
        let json = run.json();
        let [bare, light] = ["bare", "hiding, light"].map(|kind| figure(&json, kind, "mapped"));
        assert!(bare < 0.01, "{name}: {bare} of the ground is mapped");
        assert!(light > 0.99, "{name}: {light}");
    }
    let map = |ground: &str| impasto(&["map", &path("scan.hdr"), "--ground", ground]);
    let run = map("40..60,0..4");
    assert!(
        run.status == 2 && run.err.contains("64 x 48") | run.err.contains("48 x 64"),
        "{}",
        run.err
    );
    let run = map(&path("no-such-file.csv"));
    assert!(run.status != 0 && run.err.contains("no-such-file.csv"), "{}", run.err);
    std::fs::write(path("short.csv"), "nm,ground\n500,0.5\n510,0.5\n520,0.5\n").unwrap();
    let run = map(&path("short.csv"));
    assert!(
        run.status == 2 && run.err.contains("400 nm") && run.err.contains("--ground"),
        "{}",
        run.err
    );
}

#[test]
fn halves_of_the_mixtures_have_none_in_common() {
    let readings = repository("measurements/van-gogh-oils.csv");
    let [all, first, second] =
        [&[][..], &["--half", "0"], &["--half", "1"]].map(|more: &[&str]| -> BTreeSet<String> {
            let usual =
                ["fit", &readings, "--method", "weighted", "--below-surface", "floor", "--json"];
            let run = impasto(&[&usual, more].concat());
            assert_eq!(run.status, 0, "{}", run.err);
            let rows = run.json()["per_sample"].as_array().unwrap().clone();
            rows.iter().map(|row| row["sample"].as_str().unwrap().to_owned()).collect()
        });
    let both: BTreeSet<String> = first.intersection(&second).cloned().collect();
    assert_eq!(first.union(&second).count(), all.len());
    assert!(both.len() < 20, "films of one pigment alone are in both: {both:?}");
    assert!(first.len().abs_diff(second.len()) < 4, "{} and {}", first.len(), second.len());
    let run = impasto(&["fit", &readings, "--half", "2"]);
    assert!(run.status == 2 && run.err.contains("--half"), "{}", run.err);
}

#[test]
fn what_cannot_be_simulated_or_compared_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let painting = written_painting(&patches(), folder.path());
    let scan = folder.path().join("scan.hdr");
    for (more, word) in [
        (&["--bands", "1"][..], "2 to 2000"),
        (&["--blur", "21"], "0 to 20"),
        (&["--shot-noise", "2"], "--shot-noise"),
        (&["--surface", "nan"], "0 to 1"),
    ] {
        let run = simulate(&painting, &scan, more);
        assert!(run.status == 2 && run.err.contains(word), "{more:?}: {}", run.err);
    }
    let other = folder.path().join("notes");
    std::fs::create_dir(&other).unwrap();
    std::fs::write(other.join("mine.txt"), "kept").unwrap();
    let run = simulate(&painting, &scan, &["--truth", &other.display().to_string()]);
    assert!(run.status == 2 && run.err.contains("holds files"), "{}", run.err);
    assert!(other.join("mine.txt").exists() && !scan.exists(), "nothing was written");
    let run = simulate(&painting, &folder.path().join("scan.png"), &[]);
    assert!(run.status == 2 && run.err.contains(".hdr"), "{}", run.err);
    let empty = folder.path().join("empty");
    std::fs::create_dir(&empty).unwrap();
    let unpainted = written_painting(&bare(4, 4, library()), &empty);
    let run = simulate(&unpainted, &scan, &[]);
    assert!(run.status == 1 && run.err.contains("no paint"), "{}", run.err);
    // This is the truth of a smaller scan.
    let small = folder.path().join("small");
    std::fs::create_dir(&small).unwrap();
    let mut document = bare(4, 4, library());
    lay(&mut document.wet, (0..4, 0..4), &[("Lead White", 1.0)]);
    assert_eq!(
        simulate(&written_painting(&document, &small), &small.join("scan.hdr"), &[]).status,
        0
    );
    assert_eq!(simulate(&painting, &scan, &[]).status, 0);
    let maps = |truth: &str, out: &str| {
        let [scan, out, truth] =
            ["scan.hdr", out, truth].map(|name| folder.path().join(name).display().to_string());
        impasto(&["map", &scan, "-o", &out, "--truth", &truth])
    };
    let run = maps("small/scan-truth.zarr", "maps-1");
    assert!(run.status == 2 && run.err.contains("4 x 4"), "{}", run.err);
    let run = maps("notes", "maps-2");
    assert!(run.status == 2 && !folder.path().join("maps-2").exists(), "{}", run.err);
    std::fs::remove_file(folder.path().join("scan-truth.zarr/class/c/0/0")).unwrap();
    let run = maps("scan-truth.zarr", "maps-3");
    assert!(run.status == 1 && run.err.contains("is missing"), "{}", run.err);
}

/// Recipes of the patches. Each patch is four columns wide.
pub(crate) const RECIPES: [&[(&str, f64)]; 6] = [
    &[("Lead White", 0.9), ("Ultramarine", 0.1)],
    &[("Lead White", 0.5), ("Viridian", 0.5)],
    &[("Chrome Yellow", 1.0)],
    &[("Chrome Yellow", 0.7), ("Vermilion", 0.3)],
    &[("Vermilion", 1.0)],
    &[("Lead White", 1.0)],
];

/// Writes an ENVI scan of `rows` x 24 pixels of patches with noise, with all values multiplied by
/// `scale`.
pub(crate) fn written_scan(folder: &Path, rows: usize, scale: f64) -> PathBuf {
    let oils = PigmentLibrary::van_gogh_oils();
    let noise = Normal::new(0.0, 0.002).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(4);
    let mut data = Vec::new();
    for _ in 0..rows {
        for column in 0..24 {
            let mixture =
                oils.mix(oils.recipe(RECIPES[column / 4].iter().copied()).unwrap()).unwrap();
            for value in mixture.hiding(oils.saunderson) {
                let value = (scale * (value + noise.sample(&mut random))) as f32;
                data.extend_from_slice(&value.to_le_bytes());
            }
        }
    }
    let mut nm = String::new();
    for (index, wavelength) in oils.grid.wavelengths_nm().enumerate() {
        write!(nm, "{}{wavelength}", if index == 0 { "" } else { ", " }).unwrap();
    }
    let header = format!(
        "ENVI\nsamples = 24\nlines = {rows}\nbands = {}\nheader offset = 0\ndata type = 4\n\
         interleave = bip\nbyte order = 0\nwavelength units = Nanometers\nwavelength = {{{nm}}}\n",
        oils.grid.count()
    );
    std::fs::write(folder.join("scan.bip"), data).unwrap();
    let path = folder.join("scan.hdr");
    std::fs::write(&path, header).unwrap();
    path
}

const CELL_MM: f64 = 0.1;

/// Pigments of all paintings, by slot.
pub(crate) const NAMES: [&str; 8] = [
    "Lead White",
    "Vermilion",
    "Viridian",
    "Chrome Yellow",
    "Ultramarine",
    "Prussian Blue",
    "Bone Black",
    "Emerald Green",
];

/// A painting without paint on a grey ground.
pub(crate) fn bare(width: usize, height: usize, library: PigmentLibrary) -> Document {
    let slots: Slots = NAMES.map(|name| Some(library.find(name).unwrap()));
    Document {
        title: "laid by hand".to_owned(),
        cell_mm: CELL_MM,
        ground: Ground {
            name: "even".to_owned(),
            height: Field::filled(width, height, 0),
            reflectance: vec![0.6; library.grid.count()],
            gloss: Gloss { strength: 0.0, exponent: 1.0 },
        },
        library,
        // One mm of white has S d = 50.
        medium: Medium { scattering_per_mm: 50.0, ..Medium::default() },
        dry: Vec::new(),
        next_layer: LayerId::FIRST,
        slots,
        wet: Layer::empty(width, height),
        lighting: Lighting { relief: 0.0, ..Lighting::default() },
    }
}

/// Lays paint on all cells of `columns` and `rows`, as heights of pigments in mm.
pub(crate) fn lay(
    layer: &mut Layer,
    (columns, rows): (std::ops::Range<usize>, std::ops::Range<usize>),
    recipe: &[(&str, f64)],
) {
    for y in rows {
        for x in columns.clone() {
            for (name, mm) in recipe {
                let slot = NAMES.iter().position(|known| known == name).unwrap();
                layer.pigments[(x, y)][slot] = quanta_from_mm(*mm, CELL_MM);
            }
        }
    }
}

/// Turns the wet paint into a dry layer below an empty wet one.
pub(crate) fn dried(mut document: Document) -> Document {
    let width = document.wet.width();
    let height = document.wet.height();
    let paint = std::mem::replace(&mut document.wet, Layer::empty(width, height));
    document.dry.push(DryLayer {
        id: LayerId::FIRST,
        name: String::new(),
        visible: true,
        slots: document.slots,
        opacity: 1.0,
        paint,
    });
    document.next_layer = LayerId(2);
    document
}

pub(crate) fn written_painting(document: &Document, folder: &Path) -> PathBuf {
    let path = folder.join("painting.exr");
    std::fs::write(&path, file::write(document).unwrap()).unwrap();
    path
}

/// The oils with a viridian that only absorbs: K = 1 and hardly any S at all wavelengths.
pub(crate) fn with_clear_viridian() -> PigmentLibrary {
    let mut library = library();
    let viridian = library.find("Viridian").unwrap().index();
    let pigment = &mut library.pigments[viridian];
    pigment.absorption.fill(1.0);
    pigment.scattering.fill(1e-6);
    library
}

/// Recipes of the patches of [`patches`] as pigments and shares, of all tones.
pub(crate) const PATCHES: [&[(&str, f64)]; 12] = [
    &[("Lead White", 1.0)],
    &[("Lead White", 0.8), ("Ultramarine", 0.2)],
    &[("Lead White", 0.7), ("Viridian", 0.3)],
    &[("Lead White", 0.5), ("Vermilion", 0.5)],
    &[("Chrome Yellow", 1.0)],
    &[("Chrome Yellow", 0.6), ("Vermilion", 0.4)],
    &[("Chrome Yellow", 0.8), ("Prussian Blue", 0.2)],
    &[("Lead White", 0.5), ("Prussian Blue", 0.5)],
    &[("Vermilion", 1.0)],
    &[("Viridian", 1.0)],
    &[("Ultramarine", 0.7), ("Vermilion", 0.3)],
    &[("Ultramarine", 1.0)],
];

/// A painting of thick patches of 16 x 16 cells in three rows of four, one per recipe.
pub(crate) fn patches() -> Document {
    let mut document = bare(64, 48, library());
    for (index, recipe) in PATCHES.iter().enumerate() {
        let column = 16 * (index % 4);
        let row = 16 * (index / 4);
        let mm: Vec<(&str, f64)> =
            recipe.iter().map(|(name, share)| (*name, 4.0 * share)).collect();
        lay(&mut document.wet, (column..column + 16, row..row + 16), &mm);
    }
    document
}
