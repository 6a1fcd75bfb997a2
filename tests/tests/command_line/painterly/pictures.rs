//! Photographs in the brushwork of a map.

use std::path::Path;

use image::{Rgb, RgbImage};

use super::{done, folder, mean, painterly, path};

/// Writes a picture of 60 x 40 px of a colour for each pixel.
fn write(path: &str, color: impl Fn(u32, u32) -> [u8; 3]) {
    RgbImage::from_fn(60, 40, |x, y| Rgb(color(x, y))).save(path).unwrap();
}

#[test]
fn a_photograph_is_painted_in_its_colours_or_in_those_of_the_map() {
    let folder = folder();
    let [map, photo, picture] = ["m.exr", "photo.png", "p.png"].map(|name| path(&folder, name));
    write(&photo, |x, _| if x < 30 { [40, 60, 140] } else { [210, 205, 200] });
    let arguments = [&photo, "--map", &map, "--width", "120", "--picture", &picture];
    let told = done(&[&arguments[..], &["--json"]].concat()).json();
    assert_eq!(told["size"], serde_json::json!([120, 80]), "{told}");
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
    let told = done(&[&arguments[..], &["--preset", "knife"]].concat()).json();
    let layers = told["layers"].as_array().unwrap();
    assert!(layers.len() == 2 && layers.iter().all(|count| count.as_u64() > Some(0)), "{told}");
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
    let told = done(&[&arguments[..], &moving].concat()).json();
    assert_eq!((&told["frames"], &told["maps"]), (&3.into(), &2.into()), "{told}");
    let frames = Path::new(&looped).with_extension("frames");
    let read = |index: usize| {
        let names = std::fs::read_dir(&frames).unwrap().map(|entry| entry.unwrap().path());
        let mut names: Vec<_> =
            names.filter(|name| name.extension() == Some("png".as_ref())).collect();
        names.sort();
        image::open(&names[index]).unwrap().to_rgb8()
    };
    let change = |rows: std::ops::Range<u32>| {
        let first = read(0);
        let then = read(1);
        let pixels = rows.flat_map(|y| (0..60).map(move |x| (x, y)));
        let off = pixels.map(|at| i64::from(first[at].0[0]).abs_diff(i64::from(then[at].0[0])));
        off.sum::<u64>()
    };
    assert!(change(0..16) > 200, "the sky moves: {}", change(0..16));
    assert_eq!(change(32..40), 0, "nothing else does");
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
    let told =
        done(&[&arguments[..], &["--turntable", "2", "--animation", &swing, "--json"]].concat());
    assert_eq!(told.json()["frames"], 2);
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
    let refused = |text: &str, words: &str| {
        std::fs::write(&regions, text).unwrap();
        let run = painterly(&[&photo, "--map", &map, "--regions", &regions, "--picture", &picture]);
        assert!(run.status != 0 && run.err.contains(words), "{text}: {}", run.err);
        assert!(run.err.contains("regions.toml"), "{}", run.err);
    };
    refused("[[region]]\nname = \"a\"\ncolor = 1", "line 3");
    refused("[[region]]\nname = \"a\"\nmaterial = \"b\"", "material is an area of models");
    refused("[[region]]\nname = \"a\"\nlabel = \"#000000\"", "needs a picture of labels");
    for (option, file) in [("--directions", "none.png"), ("--depth", "none.png")] {
        let run = painterly(&[&photo, "--map", &map, option, file, "--picture", &picture]);
        assert!(run.status != 0 && run.err.contains("none.png"), "{}", run.err);
        let model = ["shape:sphere", "--map", &map, option, &photo, "--picture", &picture];
        let run = painterly(&model);
        assert!(run.status == 2 && run.err.contains("is for pictures"), "{}", run.err);
    }
    assert!(!Path::new(&picture).exists(), "nothing was written");
}
