//! The command `impasto painterly`: models in the brushwork of a map.

use std::path::Path;

use suite::program::{Run, impasto};
use tempfile::TempDir;

/// A folder with the map `m.exr` of three tones painted in small dabs.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| path(&folder, name);
    let run = |arguments: &[&str]| {
        let run = impasto(arguments);
        assert_eq!(run.status, 0, "{arguments:?}: {}", run.err);
        run
    };
    let text = run(&["artmap", "paint", "--show-style", "dabs"]).out;
    let small = text
        .replace("side_cells = 300", "side_cells = 64")
        .replace("cell_mm = 0.18", "cell_mm = 0.36");
    std::fs::write(folder.path().join("style.toml"), small).unwrap();
    let (style, samples, map) = (file("style.toml"), file("s.exr"), file("m.exr"));
    run(&["artmap", "paint", "--style", &style, "--tones", "3", "--output", &samples]);
    run(&["artmap", "build", &samples, "--size", "64", "--output", &map]);
    folder
}

fn path(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).display().to_string()
}

fn painterly(arguments: &[&str]) -> Run {
    impasto(&[&["painterly"], arguments].concat())
}

#[track_caller]
fn done(arguments: &[&str]) -> Run {
    let run = painterly(arguments);
    assert_eq!(run.status, 0, "{arguments:?}: {}", run.err);
    run
}

/// Mean of the channels of the pixels of a picture in a rectangle.
fn mean(picture: &str, [x, y, width, height]: [u32; 4]) -> f64 {
    let picture = image::open(picture).unwrap().to_rgb8();
    let pixels = (y..y + height).flat_map(|y| (x..x + width).map(move |x| (x, y)));
    let sum: f64 = pixels.map(|(x, y)| picture[(x, y)].0.map(f64::from).iter().sum::<f64>()).sum();
    sum / f64::from(3 * width * height)
}

#[test]
fn a_sphere_is_painted_in_the_tones_of_the_light_on_white() {
    let folder = folder();
    let [map, picture] = ["m.exr", "p.png"].map(|name| path(&folder, name));
    let arguments = ["shape:sphere", "--width", "120", "--map", &map, "--picture", &picture];
    let light = ["--set", "light.azimuth_deg=-45", "--set", "light.elevation_deg=30"];
    let told = done(&[&arguments[..], &light, &["--json"]].concat()).json();
    assert_eq!(told["size"], serde_json::json!([120, 90]), "{told}");
    assert!(told["strokes"].as_u64().unwrap() > 50, "{told}");
    let read = image::open(&picture).unwrap();
    assert_eq!((read.width(), read.height()), (120, 90));
    assert_eq!(mean(&picture, [0, 0, 8, 8]), 255.0, "white around the sphere");
    let (lit, shaded) = (mean(&picture, [42, 26, 10, 10]), mean(&picture, [68, 54, 10, 10]));
    assert!(lit > shaded + 25.0 && lit < 250.0, "{lit} {shaded}");
    let bytes = std::fs::read(&picture).unwrap();
    done(&[&arguments[..], &light].concat());
    assert!(bytes == std::fs::read(&picture).unwrap(), "the same bytes");
    done(&[&arguments[..], &["--preset", "paper"]].concat());
    assert!(bytes != std::fs::read(&picture).unwrap(), "a preset changes the picture");
}

#[test]
fn a_painting_with_the_pigments_of_the_map_is_relit_like_any_other() {
    let folder = folder();
    let [map, painting] = ["m.exr", "painting.exr"].map(|name| path(&folder, name));
    let [lit, raking] = ["lit.png", "raking.png"].map(|name| path(&folder, name));
    let maps = path(&folder, "maps");
    let model = ["shape:sphere", "--width", "120", "--map", &map];
    let exports = ["--output", &painting, "--picture", &lit, "--pigment-maps", &maps];
    done(&[&model[..], &exports].concat());
    let relit =
        ["relight", &painting, "--azimuth", "90", "--elevation", "12", "--picture", &raking];
    let run = impasto(&relit);
    assert_eq!(run.status, 0, "{}", run.err);
    let pixels = |name: &str| image::open(name).unwrap().to_rgb8();
    let (lit, raking) = (pixels(&lit), pixels(&raking));
    assert_eq!(lit.dimensions(), (120, 90));
    // The light from the right changes the strokes, not only their brightness.
    let ratio = |x: u32| f64::from(raking[(x, 45)].0[1]) / f64::from(lit[(x, 45)].0[1]);
    let ratios: Vec<f64> = (45..75).map(ratio).collect();
    let range = ratios.iter().fold([f64::MAX, 0.0_f64], |[a, b], &r| [a.min(r), b.max(r)]);
    assert!(range[1] > 1.1 * range[0], "{range:?}");
    assert!(std::fs::read_dir(&maps).unwrap().count() >= 3, "a map of each pigment");
    let refused = painterly(&[&model[..], &exports, &["--set", "colour.from=model"]].concat());
    assert!(refused.status == 2 && refused.err.contains("its own colours only"), "{}", refused.err);
}

#[test]
fn strokes_flow_in_a_loop_and_around_a_turntable() {
    let folder = folder();
    let [map, looped, turning] = ["m.exr", "l.png", "t.gif"].map(|name| path(&folder, name));
    let model = ["shape:torus-knot", "--width", "64", "--map", &map, "--json"];
    let flow = ["--set", "flow.periods=1", "--loop", "3", "--animation", &looped];
    let told = done(&[&model[..], &flow].concat()).json();
    assert_eq!((&told["frames"], &told["frames_found"]), (&3.into(), &0.into()), "{told}");
    let frame = |index: usize| {
        let frames = Path::new(&looped).with_extension("frames");
        let mut names: Vec<_> =
            std::fs::read_dir(frames).unwrap().map(|entry| entry.unwrap().path()).collect();
        names.retain(|name| name.extension().is_some_and(|ending| ending == "png"));
        names.sort();
        std::fs::read(&names[index]).unwrap()
    };
    assert!(frame(0) != frame(1) && frame(1) != frame(2), "strokes flow");
    let again = done(&[&model[..], &flow].concat()).json();
    assert_eq!(again["frames_found"], 3, "finished frames are kept");
    let told = done(&[&model[..], &["--turntable", "2", "--animation", &turning]].concat()).json();
    assert_eq!(told["frames"], 2);
    assert!(std::fs::read(&turning).unwrap().starts_with(b"GIF89a"));
}

#[test]
fn wrong_options_are_refused_before_anything_is_written() {
    let folder = folder();
    let [map, picture] = ["m.exr", "p.png"].map(|name| path(&folder, name));
    let [samples, gif] = ["s.exr", "a.gif"].map(|name| path(&folder, name));
    let sphere = ["shape:sphere", "--map", &map];
    let written = ["--picture", &picture];
    for (status, arguments, words) in [
        (2, &sphere[..], &["nothing would be written"][..]),
        (2, &["shape:cow", "--map", &map, "--picture", &picture], &["unknown shape `cow`"]),
        (1, &["shape:sphere", "--map", &samples, "--picture", &picture], &["no art map"]),
        (2, &["shape:sphere", "--map", "none.exr", "--picture", &picture], &["none.exr"]),
        (2, &["shape:sphere", "--style", "oils", "--picture", &picture], &["style called `oils`"]),
        (2, &[&sphere[..], &written, &["--style", "dabs"]].concat(), &["cannot be used with"]),
        (1, &[&sphere[..], &written, &["--set", "gloss=1"]].concat(), &["unknown field `gloss`"]),
        (2, &[&sphere[..], &written, &["--set", "gloss"]].concat(), &["KEY=VALUE"]),
        (2, &[&sphere[..], &["--animation", &gif]].concat(), &["--turntable 60", "--loop 48"]),
        (
            2,
            &[&sphere[..], &["--animation", &gif, "--loop", "4"]].concat(),
            &["do not flow", "flow.periods=1"],
        ),
        (2, &[&sphere[..], &["--picture", "p.jpg"]].concat(), &["ends in .png or .exr"]),
    ] {
        let run = painterly(arguments);
        assert_eq!(run.status, status, "{arguments:?}: {}", run.err);
        for word in words {
            assert!(run.err.contains(word), "{arguments:?}: `{word}` is not in {}", run.err);
        }
    }
    assert!(!Path::new(&picture).exists() && !Path::new(&gif).exists(), "nothing was written");
    let text = done(&["--show-preset", "hatching"]).out;
    assert!(text.contains("[strokes]"), "{text}");
}
