//! Models and photographs that turn to colour where paint is.

use std::path::Path;

use graphics::camera::Framing;
use graphics::mesh::Mesh;
use image::{Rgb, RgbImage};
use suite::adapter::device;
use volumes::performance::{FirstView, Performance};
use volumes::script::Script;

use super::{BOX, POUR, SMALL, done, files, folder, path, pixels};

#[test]
fn the_mask_is_white_where_the_picture_is_not_the_grey_one() {
    let folder = folder();
    let [model, picture, mask] = ["box.obj", "p.png", "m.png"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR].concat();
    let told =
        done(&[&scene[..], &["--picture", &picture, "--mask", &mask, "--json"]].concat()).json();
    assert_eq!(told["size"], serde_json::json!([64, 48]), "{told}");
    assert!(told["volumes"].as_u64() >= Some(1) && told["cells"].as_u64() > Some(20), "{told}");
    let particles = told["particles"].as_u64().unwrap();
    assert_eq!(particles % 162, 0, "volumes of a grid have 162 particles: {told}");
    let on_scene = told["paint_mm3"]["on_scene"].as_f64().unwrap();
    assert!((on_scene - 150.0).abs() < 1e-3, "{told}");
    assert_eq!((&told["seconds"], &told["frames"]), (&0.5.into(), &serde_json::Value::Null));
    let shown = |what: &str| {
        let file = path(&folder, &format!("{what}.png"));
        done(&[&scene[..], &["--show", what, "--picture", &file]].concat());
        pixels(file)
    };
    let [grey, color, hatching, again] = ["grey", "colour", "hatching", "mask"].map(shown);
    let volumes = shown("volumes");
    let picture = pixels(picture);
    let mask = pixels(mask);
    assert!(again == mask, "--mask and --show mask");
    let mut inside = 0;
    let mut strokes = 0;
    for (x, y, &Rgb(found)) in picture.enumerate_pixels() {
        let own = grey[(x, y)].0;
        let held = mask[(x, y)].0 == [255; 3];
        assert_eq!(held, found != own, "{x} {y}: {found:?} {own:?}");
        assert!(own[0] == own[1] && own[1] == own[2], "{own:?} is grey");
        let wanted = if held { color[(x, y)].0 } else { own };
        assert_eq!(found, wanted, "{x} {y}");
        inside += usize::from(held);
        strokes += usize::from(hatching[(x, y)].0 != [255; 3]);
    }
    assert!((20..1500).contains(&inside), "{inside} pixels inside");
    assert!(strokes > 50, "{strokes} pixels of strokes");
    let tinted = volumes.pixels().filter(|pixel| pixel.0[2] > pixel.0[0]).count();
    assert!(tinted > 20, "{tinted} pixels of blue volumes");
}

#[test]
fn a_script_that_was_written_makes_the_same_picture() {
    let folder = folder();
    let [model, picture, script] = ["box.obj", "p.png", "s.toml"].map(|name| path(&folder, name));
    let [again, second] = ["again.png", "t.toml"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR, &["--pour", "0.6,0.4"]].concat();
    let look = ["--preset", "washed", "--set", "motion.microstructure=0.3", "--camera", "40,25,35"];
    let tints = ["--set", "drawing.tint=[0, 0.2, 0.4, 0.6, 1]"];
    let written = ["--picture", &picture, "--script-out", &script];
    done(&[&scene[..], &look, &tints, &written].concat());
    let text = std::fs::read_to_string(&script).unwrap();
    assert!(text.contains("subject = \"box.obj\""), "{text}");
    let replay = ["--width", "64", "--picture", &again, "--script-out", &second];
    done(&[&[&script[..]], &replay[..]].concat());
    let read = |name: &str| std::fs::read(name).unwrap();
    assert!(read(&picture) == read(&again), "the same bytes");
    assert_eq!(text, std::fs::read_to_string(&second).unwrap());
    // From another folder the script names the whole path.
    let elsewhere = tempfile::tempdir().unwrap();
    let moved = path(&elsewhere, "moved.toml");
    done(&[&script, "--script-out", &moved]);
    done(&[&moved, "--width", "64", "--picture", &again]);
    assert!(read(&picture) == read(&again), "the same bytes from another folder");
    // The picture would be another without one of the options.
    done(&[&scene[..], &look, &["--picture", &again]].concat());
    assert!(read(&picture) != read(&again), "tints change the picture");
}

#[test]
fn settings_come_from_presets_files_and_single_options() {
    let folder = folder();
    let [model, picture, file] =
        ["box.obj", "p.png", "washed.toml"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR, &["--picture", &picture]].concat();
    let painted = |options: &[&str]| {
        done(&[&scene[..], options].concat());
        std::fs::read(&picture).unwrap()
    };
    std::fs::write(&file, done(&["--show-preset", "washed"]).out).unwrap();
    let washed = painted(&["--preset", "washed"]);
    assert!(washed == painted(&["--settings", &file]));
    assert!(washed != painted(&[]));
    // Volumes lie on samples of the surface.
    let volumes = |samples: &str| {
        let folder = path(&folder, samples);
        let own = ["--set", samples, "--rate", "2", "--volumes", &folder];
        done(&[&[&model[..]], &SMALL[..], &POUR, &own].concat());
        std::fs::read(Path::new(&folder).join("frame-0002.ply")).unwrap()
    };
    assert!(volumes("grid.samples=64") != volumes("grid.samples=200"));
}

#[test]
fn an_animation_that_was_interrupted_ends_in_the_same_bytes() {
    let folder = folder();
    let [model, film, still] = ["box.obj", "a.gif", "p.png"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR].concat();
    let moving = ["--animation", &film, "--rate", "8", "--json"];
    let frames = Path::new(&film).with_extension("frames");
    let told = |found: u64| {
        let told = done(&[&scene[..], &moving].concat()).json();
        assert_eq!((&told["frames"], &told["frames_found"]), (&5.into(), &found.into()), "{told}");
        std::fs::read(&film).unwrap()
    };
    let whole = told(0);
    assert!(whole.starts_with(b"GIF89a"));
    let names = files(&frames, ".png");
    assert_eq!(names.len(), 5, "{names:?}");
    for index in [1, 3, 4] {
        std::fs::remove_file(frames.join(&names[index])).unwrap();
    }
    std::fs::remove_file(&film).unwrap();
    assert!(whole == told(2), "the same bytes");
    // A frame is the still of its time, and the first shows no colour yet.
    done(&[&scene[..], &["--at", "0.25", "--picture", &still]].concat());
    let shown = |index: usize| pixels(frames.join(&names[index]));
    assert!(pixels(&still) == shown(2) && shown(2) != shown(4));
    assert!(shown(0).pixels().all(|pixel| pixel.0[0] == pixel.0[2]), "grey at first");
}

#[test]
fn volumes_of_each_frame_are_those_of_the_library_at_that_moment() {
    let folder = folder();
    let [model, meshes, script] = ["box.obj", "v", "s.toml"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR, &["--json", "--script-out", &script]].concat();
    let told = done(&[&scene[..], &["--volumes", &meshes, "--rate", "4"]].concat()).json();
    let names = files(&meshes, ".ply");
    assert_eq!(names, ["frame-0001.ply", "frame-0002.ply", "frame-0003.ply"]);
    let script = Script::open(Path::new(&script)).unwrap();
    let model = Path::new(&model);
    let model = Mesh::open(model).unwrap();
    let camera = Framing { aspect: 64.0 / 48.0, ..Framing::default() }.fit(&model.positions);
    let view = FirstView::new(&model, &camera, (64, 48));
    let settings = script.settings().unwrap();
    let mut play = Performance::new(&script, &model, &settings, &view).unwrap();
    // The first frame is the beginning, without volumes.
    for (name, step) in names[1..].iter().zip([30, 60]) {
        play.advance_to(step).unwrap();
        let volumes = play.world().volumes();
        let mesh = Mesh::open(&Path::new(&meshes).join(name)).unwrap();
        let places: Vec<[f32; 3]> = volumes.iter().flat_map(|own| own.vertices()).collect();
        assert!(places.len() > 100 && mesh.positions == places, "{name}");
        let mut corners = mesh.triangles.iter().map(|triangle| triangle.corners);
        let mut first = 0;
        for volume in volumes {
            for face in &volume.mesh().faces {
                assert_eq!(corners.next(), Some(face.map(|corner| first + corner)), "{name}");
            }
            first += volume.vertices().len() as u32;
        }
        assert_eq!(corners.next(), None);
    }
    assert_eq!(told["volumes"].as_u64(), Some(play.world().volumes().len() as u64));
}

#[test]
fn a_turntable_turns() {
    let folder = folder();
    let [model, frames] = ["box.obj", "f"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR, &["--json"]].concat();
    let turning = ["--frames", &frames, "--turntable", "3", "--height", "40"];
    let told = done(&[&scene[..], &turning].concat()).json();
    assert_eq!((&told["frames"], &told["size"]), (&3.into(), &serde_json::json!([64, 40])));
    let names = files(&frames, ".png");
    let shown = |index: usize| pixels(Path::new(&frames).join(&names[index]));
    assert!(names.len() == 3 && shown(0) != shown(1) && shown(1) != shown(2));
}

#[test]
fn stages_and_passes_are_the_steps_to_the_picture() {
    use exr::prelude::{ReadChannels, ReadLayers, read};
    let folder = folder();
    let [stages, passes] = ["s", "p.exr"].map(|name| path(&folder, name));
    let [script, picture] = ["s.toml", "p.png"].map(|name| path(&folder, name));
    let text = "format = \"paint-volumes\"\nversion = 1\nsubject = \"box.obj\"\nseconds = 0.3\n\
         grid.cell = 0.2\n[[region]]\nname = \"sky blue\"\n[[region]]\nname = \"sand\"\n\
         shells = [1.0, 0.7]\n[[pour]]\npicked = [0.45, 0.6]\nfor_s = 0.2\namount_mm3 = 60.0\n\
         region = \"sand\"\n";
    std::fs::write(&script, text).unwrap();
    let written = ["--stages", &stages, "--passes", &passes, "--picture", &picture];
    done(&[&[&script[..], "--width", "64"], &written[..]].concat());
    let names = files(&stages, ".png");
    let wanted = [
        "01-seen",
        "02-light",
        "03-hatching",
        "04-colour",
        "05-grey",
        "06-count-sky-blue",
        "07-tint-sky-blue",
        "08-count-sand",
        "09-tint-sand",
        "10-volumes",
        "11-mask",
        "12-picture",
    ];
    assert_eq!(names, wanted.map(|name| format!("{name}.png")));
    let stage = |index: usize| pixels(Path::new(&stages).join(&names[index - 1]));
    assert!(stage(12) == pixels(&picture));
    let bright = |picture: &RgbImage| picture.pixels().filter(|pixel| pixel.0[0] > 0).count();
    assert_eq!(bright(&stage(6)), 0, "nothing is poured in the first region");
    assert!(bright(&stage(8)) > 20 && stage(9) == stage(11), "the second alone makes the mask");
    assert!(stage(1).get_pixel(32, 24).0[0] > 2 * stage(1).get_pixel(32, 24).0[2], "red");
    let image = read().no_deep_data().largest_resolution_level().all_channels();
    let image = image.all_layers().all_attributes().from_file(&passes).unwrap();
    let layers = image.layer_data.iter();
    let found: Vec<String> =
        layers.map(|layer| layer.attributes.layer_name.clone().unwrap().to_string()).collect();
    for name in ["colour", "grey", "count.sky blue", "tint.sand", "ink", "place", "normal"] {
        assert!(found.iter().any(|layer| layer == name), "{name} in {found:?}");
    }
}

#[test]
fn colour_spreads_over_a_photograph() {
    let folder = folder();
    let [photo, picture] = ["photo.png", "p.png"].map(|name| path(&folder, name));
    RgbImage::from_fn(60, 40, |x: u32, _: u32| {
        Rgb(if x < 30 { [40, 60, 140] } else { [210, 150, 60] })
    })
    .save(&photo)
    .unwrap();
    let scene = [&[&photo[..]], &SMALL[..], &["--pour", "0.2,0.5,40"]].concat();
    let bare = ["--set", "hatching.inside=0", "--set", "hatching.outside=0"];
    done(&[&scene[..], &bare, &["--picture", &picture]].concat());
    let found = pixels(&picture);
    assert_eq!(found.dimensions(), (64, 43));
    let under = found[(12, 21)].0;
    let near = (0..3).all(|i| under[i].abs_diff([40, 60, 140][i]) <= 2);
    assert!(near, "its own colour under the paint: {under:?}");
    let [red, green, blue] = found[(60, 21)].0;
    assert!(red == green && green == blue && (100..255).contains(&red), "{red} {green} {blue}");
}

#[test]
fn a_graphics_device_draws_the_same_picture() {
    if device().is_none() {
        return;
    }
    let folder = folder();
    let [model, cpu, gpu] = ["box.obj", "c.png", "g.png"].map(|name| path(&folder, name));
    let scene = [&model, "--width", "240", "--seconds", "0.5", "--set", "grid.cell=0.2", "--json"];
    let scene = [&scene[..], &POUR].concat();
    for (backend, file) in [("cpu", &cpu), ("gpu", &gpu)] {
        let told = done(&[&scene[..], &["--backend", backend, "--picture", file]].concat()).json();
        assert_eq!(told["backend"] == "cpu", backend == "cpu", "{told}");
    }
    let cpu = pixels(&cpu);
    let gpu = pixels(&gpu);
    let near = |a: &Rgb<u8>, b: &Rgb<u8>| (0..3).all(|i| a.0[i].abs_diff(b.0[i]) <= 2);
    let off = cpu.pixels().zip(gpu.pixels()).filter(|(a, b)| !near(a, b)).count();
    assert!(off as f64 <= 0.002 * f64::from(cpu.width() * cpu.height()), "{off} pixels differ");
}

#[test]
fn a_scene_turned_inside_out_is_painted_as_well() {
    let folder = folder();
    let [model, turned, mask] = ["box.obj", "turned.obj", "m.png"].map(|name| path(&folder, name));
    // The box with all its faces the other way round.
    let faces = |line: &str| match line.strip_prefix("f ") {
        Some(corners) => {
            let corners: Vec<&str> = corners.split(' ').rev().collect();
            format!("f {}\n", corners.join(" "))
        }
        None => format!("{line}\n"),
    };
    let held = |model: &str| {
        done(&[&[model][..], &SMALL[..], &POUR, &["--mask", &mask]].concat());
        pixels(&mask).pixels().filter(|pixel| pixel.0[0] > 127).count()
    };
    let own = held(&model);
    std::fs::write(&turned, BOX.lines().map(faces).collect::<String>()).unwrap();
    let found = held(&turned);
    // Other samples stand for the surface, so paint takes another way around the edges.
    assert!(own > 20 && (own / 2..own * 2).contains(&found), "{own} {found}");
}
