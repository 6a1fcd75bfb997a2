//! `impasto paint --from`: refusals, separation maps, and painting a photograph.

use std::path::Path;

use graphics::export::png8;
use graphics::field::Field;
use image::{ImageFormat, RgbImage};
use paint::document::Medium;
use paint::ground::GroundSpec;
use paint::light::Light;
use strokes::{
    ColorErrors, FilmMaterials, PaintFilm, Photograph, Separation, SeparationSettings,
    black_compensated, rebuild_picture,
};
use suite::program::{Run, impasto};

use crate::made::STUDIO;

const PALETTE: &str = "Zinc White,Vermilion,Prussian Blue";

/// A small photograph in `folder`: red to blue, dark to light, 32 x 24 pixels.
fn photograph(folder: &Path) -> String {
    let picture = Field::from_values(
        32,
        24,
        (0..32 * 24)
            .map(|i: usize| {
                let x = (i % 32) as f32 / 31.0;
                let y = (i / 32) as f32 / 23.0;
                [0.1 + 0.5 * (1.0 - x), 0.1 + 0.2 * y, 0.1 + 0.3 * x, 1.0]
            })
            .collect(),
    );
    let path = folder.join("ramp.png");
    std::fs::write(&path, png8(&picture, 1.0).unwrap().bytes).unwrap();
    path.display().to_string()
}

fn paint(from: &str, more: &[&str]) -> Run {
    impasto(&[&["paint", "--from", from], more].concat())
}

#[test]
fn what_cannot_be_painted_is_refused_with_a_way_out() {
    let folder = tempfile::tempdir().unwrap();
    let photo = photograph(folder.path());
    let file = |name: &str| folder.path().join(name).display().to_string();
    let missing = file("none.png");
    let text = file("text.png");
    let out = file("out.png");
    std::fs::write(&text, "no picture").unwrap();
    let broken = file("broken.jpg");
    let mut jpeg = std::io::Cursor::new(Vec::new());
    let noise =
        RgbImage::from_fn(64, 64, |x, y| [(x * y) as u8, (x * 31) as u8, (y * 17) as u8].into());
    noise.write_to(&mut jpeg, ImageFormat::Jpeg).unwrap();
    let mut jpeg = jpeg.into_inner();
    let middle = jpeg.len() / 2;
    // Ones throughout are no code.
    jpeg[middle..middle + 6].copy_from_slice(&[0xff, 0, 0xff, 0, 0xff, 0]);
    std::fs::write(&broken, jpeg).unwrap();
    let with = |option, value| paint(&photo, &["--picture", &out, option, value]);
    let refused: [(Run, u8, &str, &str); 12] = [
        (paint(&missing, &["--picture", &out]), 2, "none.png", "hint:"),
        (paint(&text, &["--picture", &out]), 1, "text.png", "hint:"),
        (
            paint(&broken, &["--picture", &out]),
            1,
            "broken.jpg: the JPEG file is damaged",
            "hint: copy",
        ),
        (with("--palette", "Zinc White,Mauvein"), 1, "`Mauvein`", "hint:"),
        (with("--palette", "Zinc White,Zinc White"), 2, "once", "hint: leave"),
        (with("--brushes", "16,0"), 2, "--brushes takes 0.5 to 100, found `0`", "hint: brushes"),
        (with("--width-mm", "1e9"), 2, "--width-mm takes 5 to 5000", "hint: 200 mm"),
        (with("--width-mm", "NaN"), 2, "found `NaN`", "hint: 200 mm"),
        (with("--cell-mm", "0"), 2, "--cell-mm takes 0.02 to 5", "hint:"),
        (
            paint(&photo, &["--picture", &out, "--cell-mm", "0.02", "--width-mm", "5000"]),
            2,
            "at most 67108864 cells",
            "hint:",
        ),
        (paint(&photo, &[]), 2, "nothing would be written", "hint: add --picture"),
        (with("--tolerance", "0"), 2, "--tolerance takes 0.5 to 100", "hint:"),
    ];
    for (run, status, what, hint) in refused {
        assert_eq!(run.status, status, "{what}: {}", run.err);
        assert!(run.err.contains(what) && run.err.contains(hint), "{what}: {}", run.err);
        assert!(!Path::new(&out).exists(), "{what}: something was written");
    }
    let script = impasto(&["paint", "strokes.json", "--from", &photo, "--picture", &out]);
    assert_eq!(script.status, 2, "{}", script.err);
    let alone = impasto(&["paint", "strokes.json", "--seed", "2", "--picture", &out]);
    assert!(alone.status == 2 && alone.err.contains("--from <PHOTO>"), "{}", alone.err);
    let maps = file("maps");
    let thin = paint(&photo, &["--separate", &maps, "--thin", "--picture", &out]);
    assert!(thin.status == 2 && thin.err.contains("hint: leave --thin"), "{}", thin.err);
    assert!(!Path::new(&maps).exists(), "a folder was made");
    let own = paint(&photo, &["--picture", &photo]);
    assert!(own.status == 2 && own.err.contains("never overwritten"), "{}", own.err);
}

#[test]
fn separating_writes_maps_and_tells_the_error_of_the_library() {
    let folder = tempfile::tempdir().unwrap();
    let photo = photograph(folder.path());
    let maps = folder.path().join("maps");
    let into = maps.display().to_string();
    let options = ["--width-mm", "16", "--cell-mm", "0.5", "--palette", PALETTE, "--json"];
    let run = paint(&photo, &[&["--separate", &into], &options[..]].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    for pigment in ["zinc-white", "vermilion", "prussian-blue", "thickness", "rebuilt"] {
        let file = maps.join(format!("separation.{pigment}.png"));
        assert_eq!(Photograph::open(&file).unwrap().size(), (32, 24), "{pigment}");
    }
    for file in ["separation.maps.json", "separation.recipe.csv"] {
        assert!(maps.join(file).is_file(), "{file}");
    }
    let json = run.json();
    let written = std::fs::read_to_string(maps.join("separation.errors.json")).unwrap();
    assert_eq!(json, serde_json::from_str::<serde_json::Value>(&written).unwrap());

    let library = &STUDIO.library;
    let light = Light::named(library, "D65", "1931-2").unwrap();
    let mut slots = [None; 8];
    for (slot, name) in slots.iter_mut().zip(PALETTE.split(',')) {
        *slot = Some(library.find(name).unwrap());
    }
    let ground = GroundSpec::default().build(1, 1, 0.5, library).unwrap().reflectance;
    let scattering_per_mm = Medium::of(library).scattering_per_mm;
    let materials = FilmMaterials { library, slots: &slots, ground: &ground, scattering_per_mm };
    let film = PaintFilm::at_nodes(materials, &light.quadrature);
    let settings =
        SeparationSettings { least_mm: 0.03, most_mm: 0.12, ..SeparationSettings::default() };
    let separation = Separation::new(film, &settings).unwrap();
    let seen = Photograph::open(Path::new(&photo)).unwrap().on_canvas(32, 24);
    let target = black_compensated(&seen, separation.black());
    let made = rebuild_picture(separation.film(), &separation.separate(&target));
    let errors = ColorErrors::between(&separation, &target, &made);
    assert_eq!(json["error"], serde_json::to_value(errors).unwrap());
    assert_eq!(json["palette"][2], "Prussian Blue");
}

#[test]
fn a_photograph_is_painted_and_its_strokes_paint_it_again() {
    let folder = tempfile::tempdir().unwrap();
    let photo = photograph(folder.path());
    let [first, script, again] = ["first.exr", "strokes.json", "again.exr"]
        .map(|name| folder.path().join(name).display().to_string());
    let options = [
        ["--palette", PALETTE],
        ["--width-mm", "24"],
        ["--cell-mm", "0.5"],
        ["--brushes", "3,6"],
        ["--ground", "panel"],
        ["--output", &first],
        ["--strokes-out", &script],
    ];
    let run = paint(&photo, &[options.concat(), vec!["--json", "--backend", "cpu"]].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    let json = run.json();
    assert_eq!(json["canvas"], serde_json::json!([48, 36]));
    assert_eq!(json["levels"][0]["size_mm"], 6.0, "coarse before fine");
    assert!(json["levels"][1]["strokes"].as_u64() > Some(3), "{json}");
    assert!(json["error"]["mean_in_gamut"].as_f64().unwrap() < 4.0, "{json}");
    let run = impasto(&["paint", &script, "--output", &again, "--backend", "cpu"]);
    assert_eq!(run.status, 0, "{}", run.err);
    let [first, again] = [first, again].map(|path| std::fs::read(path).unwrap());
    assert!(first == again, "the script paints something else");
}
