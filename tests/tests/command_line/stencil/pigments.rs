//! Volumes as films of measured pigments.

use suite::program::{impasto, repository};

use super::{POUR, SMALL, done, files, folder, path, pixels, stencil};

fn library() -> String {
    repository("measurements/van-gogh-oils.pigments.json")
}

#[test]
fn a_painting_of_volumes_is_relit_and_repainted() {
    let folder = folder();
    let library = library();
    let [model, painting, picture] = ["box.obj", "o.exr", "p.png"].map(|name| path(&folder, name));
    let [spectral, maps, shown] = ["s.exr", "maps", "r.png"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR, &["--pigments", &library]].concat();
    let paint = ["--palette", "Ultramarine,Chrome Yellow", "--paint", "Ultramarine=1"];
    let under = ["--ground", "paper", "--over", "white", "--illuminant", "D65"];
    let exports = ["--output", &painting, "--picture", &picture, "--pigment-maps", &maps];
    let bands = ["--spectral", &spectral, "--bands", "nodes", "--bits", "16"];
    done(&[&scene[..], &paint, &under, &exports, &bands].concat());
    let bits = image::open(&picture).unwrap();
    assert!(bits.as_rgb16().is_some() || bits.as_rgba16().is_some(), "{:?}", bits.color());
    let relit = |options: &[&str]| {
        let run = impasto(&[&["relight", &painting, "--picture", &shown], options].concat());
        assert_eq!(run.status, 0, "{options:?}: {}", run.err);
        pixels(&shown)
    };
    let (own, same) = (pixels(&picture), relit(&[]));
    let off = own.pixels().zip(same.pixels());
    let off = off.map(|(a, b)| (0..3).map(|i| a.0[i].abs_diff(b.0[i])).max().unwrap());
    assert!(off.max() <= Some(1), "the picture as it was saved");
    // Where ultramarine was poured the picture turns from blue to red, and nowhere else.
    let swapped = relit(&["--swap", "all:Ultramarine=Vermilion"]);
    let redness = |pixel: &image::Rgb<u8>| i32::from(pixel.0[0]) - i32::from(pixel.0[2]);
    let turned = same.pixels().zip(swapped.pixels()).filter(|(a, b)| a != b);
    let turned: Vec<i32> = turned.map(|(a, b)| redness(b) - redness(a)).collect();
    assert!((20..1500).contains(&turned.len()), "{} pixels changed", turned.len());
    assert!(turned.iter().all(|&more| more >= 0), "{turned:?}");
    assert!(turned.iter().filter(|&&more| more > 40).count() > 20, "{turned:?}");
    assert!(relit(&["--illuminant", "A", "--adaptation", "0"]) != same);
    let names = files(&maps, ".png");
    assert!(names.iter().any(|name| name.to_lowercase().contains("ultramarine")), "{names:?}");
    assert!(std::fs::metadata(&spectral).unwrap().len() > 1000);
}

#[test]
fn pours_take_the_palette_in_turn_and_recipes_mix() {
    let folder = folder();
    let library = library();
    let [model, picture, script] = ["box.obj", "p.png", "s.toml"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR, &["--pigments", &library]].concat();
    let written = ["--picture", &picture, "--script-out", &script];
    let text = |options: &[&str]| {
        done(&[&scene[..], &written, options].concat());
        let text = std::fs::read_to_string(&script).unwrap();
        (text, pixels(&picture))
    };
    let palette = ["--palette", "Ultramarine,Chrome Yellow", "--pour", "0.6,0.4"];
    let (in_turn, picture_of_two) = text(&palette);
    for words in ["preset = \"grisaille\"", "P1 = 1.0", "P2 = 1.0", "P1 = \"Ultramarine\""] {
        assert!(in_turn.contains(words), "{words}: {in_turn}");
    }
    let recipe = ["--paint", "Eosin Lake (lead, wax)=1, Ultramarine=2, Ultramarine"];
    let (mixed, other) = text(&recipe);
    for words in ["P1 = 1.0", "P2 = 3.0", "P1 = \"Eosin Lake (lead, wax)\""] {
        assert!(mixed.contains(words), "{words}: {mixed}");
    }
    assert!(picture_of_two != other);
    let own = ["--palette", "Eosin Lake (lead, wax),Ultramarine", "--pour", "0.6,0.4"];
    let (commas, _) = text(&own);
    for words in ["P1 = \"Eosin Lake (lead, wax)\"", "P2 = \"Ultramarine\"", "P2 = 1.0"] {
        assert!(commas.contains(words), "{words}: {commas}");
    }
    // Parts of a painting are shown too, but not written as one.
    done(&[&scene[..], &palette, &["--show", "mask", "--picture", &picture]].concat());
    assert!(pixels(&picture).pixels().all(|pixel| [0, 255].contains(&pixel.0[1])));
    let output = path(&folder, "o.exr");
    let run = stencil(&[&scene[..], &palette, &["--show", "mask", "--output", &output]].concat());
    assert!(run.status == 2 && run.err.contains("--output is of the painting"), "{}", run.err);
}

#[test]
fn a_written_script_knows_its_pigments_and_guards_them() {
    let folder = folder();
    std::fs::copy(library(), path(&folder, "own.toml")).unwrap();
    let [model, pigments] = ["box.obj", "own.toml"].map(|name| path(&folder, name));
    let [script, one, other] = ["s.toml", "1.png", "2.png"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR, &["--pigments", &pigments]].concat();
    let paint = ["--palette", "Viridian", "--illuminant", "A"];
    done(&[&scene[..], &paint, &["--picture", &one, "--script-out", &script]].concat());
    let text = std::fs::read_to_string(&script).unwrap();
    assert!(
        text.contains("library = \"own.toml\"") && text.contains("illuminant = \"A\""),
        "{text}"
    );
    done(&[&script, "--width", "64", "--picture", &other]);
    assert_eq!(pixels(&one), pixels(&other), "the script alone makes the same picture");
    done(&[&script, "--width", "64", "--picture", &other, "--illuminant", "D65"]);
    assert_ne!(pixels(&one), pixels(&other), "another light");
    let before = std::fs::read(&pigments).unwrap();
    let refused = stencil(&[&script, "--width", "64", "--script-out", &pigments]);
    assert_eq!(refused.status, 2, "{}", refused.err);
    assert!(refused.err.contains("own.toml") && std::fs::read(&pigments).unwrap() == before);
    let alone =
        [&[&model[..]], &SMALL[..], &POUR, &["--picture", &one, "--illuminant", "A"]].concat();
    let refused = stencil(&alone);
    assert!(
        refused.status == 2 && refused.err.contains("--illuminant needs pigments"),
        "{}",
        refused.err
    );
}
