//! The command `impasto painterly`: models and photographs in the brushwork of a map.

use std::path::Path;
use std::sync::OnceLock;

use image::{Rgb, RgbImage};
use suite::program::{Run, impasto};
use tempfile::TempDir;

/// A folder with the map `m.exr` of three tones painted in small dabs, its samples `s.exr` and its
/// `style.toml`. It is painted once for all tests.
pub(super) fn folder() -> TempDir {
    static FILES: OnceLock<[(&str, Vec<u8>); 3]> = OnceLock::new();
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in FILES.get_or_init(painted) {
        std::fs::write(folder.path().join(name), bytes).unwrap();
    }
    folder
}

fn painted() -> [(&'static str, Vec<u8>); 3] {
    let folder = tempfile::tempdir().unwrap();
    let [style, samples, map] = ["style.toml", "s.exr", "m.exr"].map(|name| path(&folder, name));
    fn run(arguments: &[&str]) -> Run {
        let run = impasto(arguments);
        assert_eq!(run.status, 0, "{arguments:?}: {}", run.err);
        run
    }
    let text = run(&["artmap", "paint", "--show-style", "dabs"]).out;
    let small = text
        .replace("side_cells = 300", "side_cells = 64")
        .replace("cell_mm = 0.18", "cell_mm = 0.36");
    std::fs::write(folder.path().join("style.toml"), small).unwrap();
    run(&["artmap", "paint", "--style", &style, "--tones", "3", "--output", &samples]);
    run(&["artmap", "build", &samples, "--size", "64", "--output", &map]);
    ["style.toml", "s.exr", "m.exr"].map(|name| (name, std::fs::read(path(&folder, name)).unwrap()))
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

/// Mean of the channels over a rectangle of a picture.
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
    let json = done(&[&arguments[..], &light, &["--json"]].concat()).json();
    assert_eq!(json["size"], serde_json::json!([120, 90]), "{json}");
    assert!(json["strokes"].as_u64().unwrap() > 50, "{json}");
    let read = image::open(&picture).unwrap();
    assert_eq!((read.width(), read.height()), (120, 90));
    assert_eq!(mean(&picture, [0, 0, 8, 8]), 255.0, "white around the sphere");
    let lit = mean(&picture, [42, 26, 10, 10]);
    let shaded = mean(&picture, [68, 54, 10, 10]);
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
    let [lit, raking] = [lit, raking].map(|name| image::open(name).unwrap().to_rgb8());
    assert_eq!(lit.dimensions(), (120, 90));
    // The light from the right changes the strokes in more than their brightness.
    let ratios: Vec<f64> =
        (45..75).map(|x| f64::from(raking[(x, 45)].0[1]) / f64::from(lit[(x, 45)].0[1])).collect();
    let range = ratios.iter().fold([f64::MAX, 0.0_f64], |[a, b], &r| [a.min(r), b.max(r)]);
    assert!(range[1] > 1.1 * range[0], "{range:?}");
    assert!(std::fs::read_dir(&maps).unwrap().count() >= 3, "a map of each pigment");
}

#[test]
fn strokes_flow_in_a_loop_and_around_a_turntable() {
    let folder = folder();
    let [map, looped, turning] = ["m.exr", "l.png", "t.gif"].map(|name| path(&folder, name));
    let model = ["shape:torus-knot", "--width", "64", "--map", &map, "--json"];
    let flow = ["--set", "flow.periods=1", "--loop", "3", "--animation", &looped];
    let json = done(&[&model[..], &flow].concat()).json();
    assert_eq!((&json["frames"], &json["frames_found"]), (&3.into(), &0.into()), "{json}");
    let frames = Path::new(&looped).with_extension("frames");
    let mut names: Vec<_> =
        std::fs::read_dir(frames).unwrap().map(|entry| entry.unwrap().path()).collect();
    names.retain(|name| name.extension().is_some_and(|ending| ending == "png"));
    names.sort();
    let frames: Vec<Vec<u8>> = names.iter().map(|name| std::fs::read(name).unwrap()).collect();
    assert!(frames[0] != frames[1] && frames[1] != frames[2], "strokes flow");
    let again = done(&[&model[..], &flow].concat()).json();
    assert_eq!(again["frames_found"], 3, "finished frames are kept");
    let json = done(&[&model[..], &["--turntable", "2", "--animation", &turning]].concat()).json();
    assert_eq!(json["frames"], 2);
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
        (
            2,
            &[&sphere[..], &written, &["--style", "dabs"]].concat(),
            &["two maps are for the same parts"],
        ),
        (2, &[&sphere[..], &written, &["--set", "gloss=1"]].concat(), &["unknown key `gloss`"]),
        (2, &[&sphere[..], &written, &["--set", "gloss"]].concat(), &["KEY=VALUE"]),
        (2, &[&sphere[..], &["--animation", &gif]].concat(), &["--turntable 60", "--loop 48"]),
        (
            2,
            &[&sphere[..], &["--animation", &gif, "--loop", "4"]].concat(),
            &["do not flow", "flow.periods=1"],
        ),
        (2, &[&sphere[..], &["--picture", "p.jpg"]].concat(), &["ends in .png or .tif"]),
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

#[test]
fn parts_of_a_model_have_maps_of_their_own() {
    let folder = folder();
    let [map, picture] = ["m.exr", "p.png"].map(|name| path(&folder, name));
    let leaves = format!("leaves={map}");
    let village = ["shape:village", "--width", "96", "--picture", &picture];
    let json = done(&[&village[..], &["--map", &map, "--map", &leaves, "--json"]].concat()).json();
    assert_eq!((&json["maps"], &json["regions"]), (&2.into(), &1.into()), "{json}");
    let doors = format!("door={map}");
    let run = painterly(&[&village[..], &["--map", &map, "--map", &doors]].concat());
    assert!(run.status == 1 && run.err.contains("no material `door`"), "{}", run.err);
    assert!(run.err.contains("leaves"), "the names of materials: {}", run.err);
}

#[test]
fn frames_for_compositing_hold_cover_depth_height_and_direction() {
    use exr::prelude::{ReadChannels, ReadLayers, read};
    let folder = folder();
    let [map, frames] = ["m.exr", "frames"].map(|name| path(&folder, name));
    let model = ["shape:sphere", "--width", "64", "--map", &map, "--exr-frames", &frames];
    done(&[&model[..], &["--turntable", "2"]].concat());
    let file = Path::new(&frames).join("frame-0002.exr");
    let read = read().no_deep_data().largest_resolution_level().all_channels();
    let image = read.first_valid_layer().all_attributes().from_file(&file).unwrap();
    let channel = |name: &str| -> Vec<f32> {
        let mut all = image.layer_data.channel_data.list.iter();
        let found = all.find(|channel| channel.name.eq(name)).unwrap();
        found.sample_data.values_as_f32().collect()
    };
    let middle = 24 * 64 + 32;
    for (name, corner) in [("A", 0.0), ("height", 0.0), ("R", 0.0), ("direction.x", 0.0)] {
        let values = channel(name);
        assert_eq!(values.len(), 64 * 48, "{name}");
        assert_eq!(values[0], corner, "{name}");
    }
    assert_eq!(channel("A")[middle], 1.0);
    assert!(channel("R")[middle] > 0.02 && channel("height")[middle] > 0.0);
    let depth = channel("Z");
    // The ball has radius 1. Its outline is farther away than its middle, but by less than that.
    let edge = (0..64).filter(|x| depth[24 * 64 + x].is_finite()).min().unwrap();
    let behind = depth[24 * 64 + edge] - depth[middle];
    assert!(depth[0] == f32::INFINITY && depth[middle] > 1.0, "{}", depth[middle]);
    assert!((0.3..1.0).contains(&behind), "{behind}");
    let [x, y] = ["direction.x", "direction.y"].map(|name| channel(name)[middle]);
    assert!((x.hypot(y) - 1.0).abs() < 1e-4, "{x} {y}");
    let run = painterly(&[&model[..], &["--json"]].concat());
    assert!(run.status == 2 && run.err.contains("another animation"), "{}", run.err);
}

#[test]
fn colours_of_a_model_are_painted_with_pigments_of_their_own() {
    let folder = folder();
    let [map, painting, picture] = ["m.exr", "o.exr", "p.png"].map(|name| path(&folder, name));
    let maps = path(&folder, "maps");
    let model = ["shape:torus-knot", "--width", "80", "--map", &map];
    let exports = ["--output", &painting, "--picture", &picture, "--pigment-maps", &maps];
    done(&[&model[..], &exports, &["--set", "colour.from=model"]].concat());
    let read = image::open(&picture).unwrap().to_rgb8();
    // The knot is blue, but the pigments of the map are not.
    let blue = read.pixels().filter(|pixel| pixel.0[2] > pixel.0[0].saturating_add(15)).count();
    assert!(blue > 500, "{blue} blue pixels");
    let names = std::fs::read_dir(&maps).unwrap().map(|entry| entry.unwrap().file_name());
    let blues = names.filter(|name| {
        let name = name.to_string_lossy().into_owned();
        name.contains("blue") || name.contains("ultramarine")
    });
    assert!(blues.count() > 0, "a map of a blue pigment");
}

#[test]
fn guides_turn_the_strokes_of_a_model() {
    let folder = folder();
    let [map, picture, guides] = ["m.exr", "p.png", "g.toml"].map(|name| path(&folder, name));
    let model = ["shape:sphere", "--width", "80", "--map", &map, "--picture", &picture];
    done(&model);
    let plain = std::fs::read(&picture).unwrap();
    let text =
        "size_px = [80, 60]\ncamera = [30, 20, 30]\n[[guide]]\npoints = [[20, 30], [60, 30]]\n";
    std::fs::write(&guides, text).unwrap();
    done(&[&model[..], &["--directions", &guides]].concat());
    assert!(plain != std::fs::read(&picture).unwrap(), "strokes follow the guide");
    std::fs::write(&guides, text.replace("camera = [30, 20, 30]\n", "")).unwrap();
    let run = painterly(&[&model[..], &["--directions", &guides]].concat());
    assert!(run.status == 1 && run.err.contains("do not tell the camera"), "{}", run.err);
    std::fs::write(&guides, text.replace("[60, 30]", "[90, 30]")).unwrap();
    let run = painterly(&[&model[..], &["--directions", &guides]].concat());
    assert!(run.status == 1 && run.err.contains("g.toml"), "{}", run.err);
}

/// Writes a picture of 60 x 40 px.
fn write(path: &str, color: impl Fn(u32, u32) -> [u8; 3]) {
    RgbImage::from_fn(60, 40, |x, y| Rgb(color(x, y))).save(path).unwrap();
}

#[test]
fn a_photograph_is_painted_in_its_colours_or_in_those_of_the_map() {
    let folder = folder();
    let [map, photo, picture] = ["m.exr", "photo.png", "p.png"].map(|name| path(&folder, name));
    write(&photo, |x, _| if x < 30 { [40, 60, 140] } else { [210, 205, 200] });
    let arguments = [&photo, "--map", &map, "--width", "120", "--picture", &picture];
    let json = done(&[&arguments[..], &["--json"]].concat()).json();
    assert_eq!(json["size"], serde_json::json!([120, 80]), "{json}");
    let own = image::open(&picture).unwrap().to_rgb8()[(25, 40)].0;
    assert!(own[2] > own[0].saturating_add(40), "blue stays: {own:?}");
    let dark = mean(&picture, [5, 5, 45, 70]);
    let light = mean(&picture, [70, 5, 45, 70]);
    assert!((dark - 80.0).abs() < 15.0 && (light - 205.0).abs() < 15.0, "{dark} {light}");
    done(&[&arguments[..], &["--set", "colour.from=map"]].concat());
    let of_map = image::open(&picture).unwrap().to_rgb8()[(25, 40)].0;
    assert!(of_map[2] < of_map[0], "the ochre of the map: {of_map:?}");
    let tones = mean(&picture, [70, 5, 45, 70]) - mean(&picture, [5, 5, 45, 70]);
    assert!(tones > 10.0, "tones follow the photograph: {tones}");
}

#[test]
fn layers_presets_and_stages_of_a_photograph() {
    let folder = folder();
    let [map, photo, stages] = ["m.exr", "photo.png", "stages"].map(|name| path(&folder, name));
    write(
        &photo,
        |x, y| if x > 30 && (x / 3 + y / 3).is_multiple_of(2) { [230; 3] } else { [60; 3] },
    );
    let arguments = [&photo, "--map", &map, "--width", "120", "--stages", &stages, "--json"];
    let json = done(&[&arguments[..], &["--preset", "knife"]].concat()).json();
    let layers = json["layers"].as_array().unwrap();
    assert!(layers.len() == 2 && layers.iter().all(|count| count.as_u64() > Some(0)), "{json}");
    for name in ["01-depth", "03-layer-1-directions", "09-layer-2-painted", "11-picture"] {
        let file = Path::new(&stages).join(format!("{name}.png"));
        assert!(file.exists(), "{}", file.display());
    }
}

#[test]
fn regions_and_flow_move_strokes_of_a_photograph_in_a_loop() {
    let folder = folder();
    let [map, photo, looped] = ["m.exr", "photo.png", "l.gif"].map(|name| path(&folder, name));
    let [regions, flow] = ["regions.toml", "flow.png"].map(|name| path(&folder, name));
    write(&photo, |x, y| [(x * 4) as u8, (y * 6) as u8, 90]);
    write(&flow, |_, _| [255, 128, 255]);
    let text = "[[region]]\nname = \"sky\"\npolygon = [[0, 0], [60, 0], [60, 20], [0, 20]]\n\
        map = \"m.exr\"\naround = [30, 10]\nflow = 2\ntwinkle = 0.2\nsize = 1.5\n";
    std::fs::write(&regions, text).unwrap();
    let arguments = [&photo, "--map", &map, "--width", "60", "--regions", &regions];
    let moving = ["--directions", &flow, "--loop", "3", "--animation", &looped, "--json"];
    let json = done(&[&arguments[..], &moving].concat()).json();
    assert_eq!((&json["frames"], &json["maps"]), (&3.into(), &2.into()), "{json}");
    let frames = Path::new(&looped).with_extension("frames");
    let names = std::fs::read_dir(&frames).unwrap().map(|entry| entry.unwrap().path());
    let mut names: Vec<_> = names.filter(|name| name.extension() == Some("png".as_ref())).collect();
    names.sort();
    let [first, then] = [0, 1].map(|index: usize| image::open(&names[index]).unwrap().to_rgb8());
    let [sky, rest] = [0..16, 32..40].map(|rows: std::ops::Range<u32>| {
        let pixels = rows.flat_map(|y| (0..60).map(move |x| (x, y)));
        let off = pixels.map(|at| i64::from(first[at].0[0]).abs_diff(i64::from(then[at].0[0])));
        off.sum::<u64>()
    });
    assert!(sky > 200, "the sky moves: {sky}");
    assert_eq!(rest, 0, "nothing else does");
}

#[test]
fn a_depth_picture_turns_a_photograph() {
    let folder = folder();
    let [map, photo, picture] = ["m.exr", "photo.png", "p.png"].map(|name| path(&folder, name));
    let [depth, swing] = ["depth.png", "s.gif"].map(|name| path(&folder, name));
    write(&photo, |x, _| [90, (x * 4) as u8, 90]);
    write(&depth, |x, _| [(x * 4) as u8; 3]);
    let arguments = [&photo, "--map", &map, "--width", "60", "--depth", &depth];
    done(&[&arguments[..], &["--picture", &picture]].concat());
    let front = std::fs::read(&picture).unwrap();
    done(&[&arguments[..], &["--camera", "20,0", "--picture", &picture]].concat());
    assert!(front != std::fs::read(&picture).unwrap(), "seen from the side");
    let run =
        done(&[&arguments[..], &["--turntable", "2", "--animation", &swing, "--json"]].concat());
    assert_eq!(run.json()["frames"], 2);
    let flat = [&photo, "--map", &map, "--camera", "20,0", "--picture", &picture];
    let run = painterly(&flat);
    assert!(run.status == 2 && run.err.contains("applies to meshes only"), "{}", run.err);
    let run = painterly(&[&arguments[..], &["--camera", "99,0", "--picture", &picture]].concat());
    assert!(run.status == 2 && run.err.contains("-80 to 80"), "{}", run.err);
}

#[test]
fn wrong_files_of_pictures_are_refused_with_their_place() {
    let folder = folder();
    let [map, photo, picture] = ["m.exr", "photo.png", "p.png"].map(|name| path(&folder, name));
    let regions = path(&folder, "regions.toml");
    write(&photo, |_, _| [90; 3]);
    for (text, words) in [
        ("[[region]]\nname = \"a\"\ncolor = 1", "line 3"),
        ("[[region]]\nname = \"a\"\nmaterial = \"b\"", "material is an area of models"),
        ("[[region]]\nname = \"a\"\nlabel = \"#000000\"", "needs a picture of labels"),
    ] {
        std::fs::write(&regions, text).unwrap();
        let run = painterly(&[&photo, "--map", &map, "--regions", &regions, "--picture", &picture]);
        assert!(run.status != 0 && run.err.contains(words), "{text}: {}", run.err);
        assert!(run.err.contains("regions.toml"), "{}", run.err);
    }
    for (option, file) in [("--directions", "none.png"), ("--depth", "none.png")] {
        let run = painterly(&[&photo, "--map", &map, option, file, "--picture", &picture]);
        assert!(run.status != 0 && run.err.contains("none.png"), "{}", run.err);
        let model = ["shape:sphere", "--map", &map, option, &photo, "--picture", &picture];
        let run = painterly(&model);
        assert!(run.status == 2 && run.err.contains("is for pictures"), "{}", run.err);
    }
    assert!(!Path::new(&picture).exists(), "nothing was written");
}
