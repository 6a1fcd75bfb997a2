//! `impasto paint`, `relight` and `gpu` from end to end.

use std::path::Path;

use calibrate::PigmentId;
use paint::amount::mm_from_quanta;
use paint::layer::SLOTS;
use suite::program::{Run, impasto};

/// A script with most actions, on a canvas of 120 x 80 cells.
pub(crate) const SCRIPT: &str = r##"{
  "format": "strokes", "version": 1, "title": "A trial",
  "canvas": {"width_mm": 24, "height_mm": 16, "cell_mm": 0.2},
  "palette": {"W": "Lead White", "Y": "Chrome Yellow", "B": "Prussian Blue", "R": "Vermilion"},
  "brushes": {"flat": {"shape": "flat", "size_mm": 5}, "knife": {"shape": "knife", "size_mm": 4}},
  "actions": [
    {"load": {"brush": "flat", "recipe": {"W": 3, "B": 1}, "vehicle": 0.2, "amount_mm": 0.3}},
    {"stroke": {"brush": "flat", "samples": [[0, 3, 4, 0.4], [0.5, 20, 5, 0.6, 10, 0, 45]]}},
    {"dry": {"fraction": 0.8}},
    {"load": {"brush": "knife", "recipe": {"Y": 1}, "amount_mm": 0.5}},
    {"stroke": {"brush": "knife", "samples": [[0, 12, 2, 0.5], [0.5, 12, 14, 0.5]]}},
    {"stroke": {"brush": "flat", "samples": [[0, 9, 9, 1]]}},
    {"undo": {}},
    {"redo": {}},
    {"light": {"illuminant": "A", "observer": "1931-2", "azimuth_deg": 90, "elevation_deg": 30,
      "ambient": 0.5, "relief": 1}}
  ]
}"##;

/// Writes [`SCRIPT`] with `from` replaced by `to` into `folder`. Returns its path.
pub(crate) fn script(folder: &Path, from: &str, to: &str) -> String {
    assert!(from.is_empty() || SCRIPT.matches(from).count() == 1, "`{from}` stands once");
    let path = folder.join("script.json");
    let text = if from.is_empty() { SCRIPT.to_owned() } else { SCRIPT.replace(from, to) };
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

/// The path of `name` in `folder`.
pub(crate) fn place(folder: &Path, name: &str) -> String {
    folder.join(name).to_str().unwrap().to_owned()
}

fn done(run: &Run) {
    assert_eq!(run.status, 0, "{}", run.err);
    // Highlights of gloss are brighter than sRGB white, on which the program remarks.
    let expected =
        run.err.lines().all(|line| line.contains("outside sRGB") || line.starts_with("Wrote "));
    assert!(expected, "{}", run.err);
}

#[test]
fn the_same_script_gives_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let script = script(folder, "", "");
    let names = ["painting.exr", "picture.png", "spectral.exr"];
    let files = ["a-", "b-"].map(|run| names.map(|name| place(folder, &format!("{run}{name}"))));
    for [painting, picture, spectral] in &files {
        let run = impasto(&[
            "paint",
            &script,
            "--backend",
            "cpu",
            "--output",
            painting,
            "--picture",
            picture,
            "--spectral",
            spectral,
            "--json",
        ]);
        done(&run);
        let told = run.json();
        assert_eq!(told["canvas"], serde_json::json!([120, 80]));
        assert_eq!((told["actions"].as_u64(), told["strokes"].as_u64()), (Some(9), Some(3)));
        assert!(told["substeps"].as_u64() > Some(100), "{told}");
    }
    for (a, b) in files[0].iter().zip(&files[1]) {
        let a = std::fs::read(a).unwrap();
        let b = std::fs::read(b).unwrap();
        assert!(a.len() > 1000 && a == b, "{} and {} bytes", a.len(), b.len());
    }
    // `relight` without changes gives the picture that `paint` wrote.
    let again = place(folder, "again.png");
    let run = impasto(&["relight", &files[0][0], "--backend", "cpu", "--picture", &again]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.out.contains("light A") && run.out.contains("dry 0"), "{}", run.out);
    assert!(std::fs::read(&again).unwrap() == std::fs::read(&files[0][1]).unwrap(), "not the same");
}

#[test]
fn a_painting_is_relit_under_a_lamp_and_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let script = script(folder, "", "");
    let painting = place(folder, "a.exr");
    done_with_lines(&impasto(&["paint", &script, "--backend", "cpu", "--output", &painting]));
    let lamp = place(folder, "lamp.csv");
    let lines: Vec<String> = (380..=780).step_by(10).map(|nm| format!("{nm},{nm}")).collect();
    std::fs::write(&lamp, lines.join("\n")).unwrap();
    let relit = place(folder, "b.exr");
    let picture = place(folder, "b.png");
    done_with_lines(&impasto(&[
        "relight",
        &painting,
        "--backend",
        "cpu",
        "--illuminant",
        &lamp,
        "--output",
        &relit,
        "--picture",
        &picture,
        "--swap",
        "all:Chrome Yellow=Minium",
        "--opacity",
        "0=0.5",
    ]));
    let again = place(folder, "c.png");
    let run = impasto(&["relight", &relit, "--backend", "cpu", "--picture", &again, "--json"]);
    done(&run);
    assert_eq!(run.json()["layers"][0]["opacity"], 0.5);
    assert!(std::fs::read(&again).unwrap() == std::fs::read(&picture).unwrap(), "not the same");
    // Without the lamp's file `relight` is refused, unless another light is given.
    std::fs::remove_file(&lamp).unwrap();
    let run = impasto(&["relight", &relit, "--backend", "cpu"]);
    assert_eq!(run.status, 2, "{}", run.err);
    assert!(run.err.contains("lamp.csv") && run.err.contains("hint:"), "{}", run.err);
    done_with_lines(&impasto(&["relight", &relit, "--backend", "cpu", "--illuminant", "D65"]));
}

fn done_with_lines(run: &Run) {
    done(run);
    assert!(!run.out.is_empty(), "no output");
}

#[test]
fn exports_are_checked_before_anything_is_painted() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let script = script(folder, "", "");
    let exr = place(folder, "a.exr");
    let file = place(folder, "file");
    std::fs::write(&file, "not a folder").unwrap();
    let below = place(folder, "file/maps");
    for (arguments, wanted) in [
        (vec!["--picture", &exr, "--output", &exr], "two exports have this file name"),
        (vec!["--picture", "a.jpg"], "that ends in .png or .tif or .tiff or .exr"),
        (vec!["--output", "a.jpg"], "that ends in .png, .tif, .ora or .exr"),
        (vec!["--pigment-maps", &below], "cannot be created"),
        (vec!["--output", "/no/such/folder/a.exr"], "cannot be written"),
        (vec![], "nothing would be written"),
    ] {
        let mut all = vec!["paint", &script, "--backend", "cpu"];
        all.extend(arguments);
        let run = impasto(&all);
        assert_eq!(run.status, 2, "{all:?}: {}", run.err);
        assert!(run.err.contains(wanted), "{all:?}: {}", run.err);
        assert!(!Path::new(&exr).exists(), "{all:?} left a file");
    }
}

#[test]
fn pigment_maps_sum_all_layers() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let script = script(folder, "", "");
    let maps = place(folder, "maps");
    let painting = place(folder, "painting.exr");
    let to = ["--pigment-maps", &maps, "--output", &painting];
    done_with_lines(&impasto(&[&["paint", &script, "--backend", "cpu"][..], &to].concat()));
    let mut names: Vec<String> = std::fs::read_dir(&maps)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert!(names.iter().any(|name| name.ends_with(".png")), "{names:?}");
    assert!(names.iter().any(|name| name.ends_with(".csv")), "{names:?}");
    assert!(names.iter().all(|name| !name.starts_with('.')), "{names:?}");

    let document = paint::file::read("a.exr", &std::fs::read(&painting).unwrap()).unwrap();
    let dry = document.dry.iter().map(|layer| (&layer.slots, &layer.paint));
    let layers: Vec<_> = dry.chain([(&document.slots, &document.wet)]).collect();
    assert!(layers.len() > 1, "no dry layer to sum");
    let recipe = std::fs::read_to_string(Path::new(&maps).join("painting.recipe.csv")).unwrap();
    let quantum_mm3 = mm_from_quanta(1, document.cell_mm) * document.cell_mm.powi(2);
    for line in recipe.lines().skip(1) {
        let mut fields = line.split(',');
        let name = fields.next().unwrap();
        let volume = fields.next().unwrap();
        let volume: f64 = volume.parse().unwrap();
        let held = layers.iter().map(|(slots, paint)| {
            let place = if name == "vehicle" {
                Some(SLOTS)
            } else {
                slots.iter().position(|slot: &Option<PigmentId>| {
                    slot.is_some_and(|pigment| document.library[pigment].name == name)
                })
            };
            place.map_or(0, |place| paint.totals()[place])
        });
        let wanted = held.sum::<u64>() as f64 * quantum_mm3;
        assert!((volume - wanted).abs() <= 1e-5 * wanted, "{name}: {volume} for {wanted}");
    }
    assert!(recipe.contains("Prussian Blue") && recipe.contains("Chrome Yellow"), "{recipe}");
}

#[test]
fn what_the_adapter_is_can_be_read_by_programs() {
    let told = impasto(&["gpu", "--json"]).json();
    assert!(told["adapters"].is_array() && told["why"].is_string(), "{told}");
}
