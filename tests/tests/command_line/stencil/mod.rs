//! The command `impasto stencil`: models and photographs that turn to colour where paint is,
//! cameras of options and of the scripts that it writes, and volumes as films of measured pigments.

mod faults;
mod recordings;

use std::fs;
use std::path::Path;

use graphics::camera::Framing;
use graphics::mesh::Mesh;
use image::{Rgb, RgbImage};
use suite::program::{Run, device, impasto, repository};
use tempfile::TempDir;
use volumes::performance::{FirstView, Performance};
use volumes::script::Script;

/// A red box of 2 x 1 x 1 units.
const BOX: &str = "mtllib box.mtl\nv -1 0 -0.5\nv 1 0 -0.5\nv 1 1 -0.5\nv -1 1 -0.5\nv -1 0 0.5\n\
    v 1 0 0.5\nv 1 1 0.5\nv -1 1 0.5\nusemtl red\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\n\
    f 1 5 8 4\nf 2 3 7 6\n";

fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("box.obj"), BOX).unwrap();
    fs::write(folder.path().join("box.mtl"), "newmtl red\nKd 0.8 0.1 0.05\n").unwrap();
    folder
}

fn path(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).display().to_string()
}

fn stencil(arguments: &[&str]) -> Run {
    impasto(&[&["stencil"], arguments].concat())
}

#[track_caller]
fn done(arguments: &[&str]) -> Run {
    let run = stencil(arguments);
    assert_eq!(run.status, 0, "{arguments:?}: {}", run.err);
    run
}

/// Options of a small picture: wide cells, half a second, one sample per pixel.
const SMALL: [&str; 8] =
    ["--width", "64", "--seconds", "0.5", "--set", "grid.cell=0.2", "--set", "picture.samples=1"];

/// Pours 150 mm3 of paint near the middle of the first picture.
const POUR: [&str; 2] = ["--pour", "0.45,0.6,150"];

fn pixels(path: impl AsRef<Path>) -> RgbImage {
    image::open(path).unwrap().to_rgb8()
}

/// Sorted names of the files in a folder that end in `ending`.
fn files(folder: impl AsRef<Path>, ending: &str) -> Vec<String> {
    let names = fs::read_dir(folder).unwrap();
    let names = names.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = names.filter(|name| name.ends_with(ending)).collect();
    names.sort();
    names
}

#[test]
fn the_mask_is_white_where_the_picture_is_not_the_grey_one() {
    let folder = folder();
    let [model, picture, mask] = ["box.obj", "p.png", "m.png"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR].concat();
    let json =
        done(&[&scene[..], &["--picture", &picture, "--mask", &mask, "--json"]].concat()).json();
    assert_eq!(json["size"], serde_json::json!([64, 48]), "{json}");
    assert!(json["volumes"].as_u64() >= Some(1) && json["cells"].as_u64() > Some(20), "{json}");
    let particles = json["particles"].as_u64().unwrap();
    assert_eq!(particles % 162, 0, "volumes of a grid have 162 particles: {json}");
    let on_scene = json["paint_mm3"]["on_scene"].as_f64().unwrap();
    assert!((on_scene - 150.0).abs() < 1e-3, "{json}");
    assert_eq!((&json["seconds"], &json["frames"]), (&0.5.into(), &serde_json::Value::Null));
    let [grey, color, hatching, again, volumes] = ["grey", "colour", "hatching", "mask", "volumes"]
        .map(|what| {
            let file = path(&folder, &format!("{what}.png"));
            done(&[&scene[..], &["--show", what, "--picture", &file]].concat());
            pixels(file)
        });
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
    let text = fs::read_to_string(&script).unwrap();
    assert!(text.contains("subject = \"box.obj\""), "{text}");
    let replay = ["--width", "64", "--picture", &again, "--script-out", &second];
    done(&[&[&script[..]], &replay[..]].concat());
    fn same(one: &str, other: &str) -> bool {
        fs::read(one).unwrap() == fs::read(other).unwrap()
    }
    assert!(same(&picture, &again), "the same bytes");
    assert_eq!(text, fs::read_to_string(&second).unwrap());
    // From another folder, the script uses the whole path.
    let elsewhere = tempfile::tempdir().unwrap();
    let moved = path(&elsewhere, "moved.toml");
    done(&[&script, "--script-out", &moved]);
    done(&[&moved, "--width", "64", "--picture", &again]);
    assert!(same(&picture, &again), "the same bytes from another folder");
    // If you leave out one of the options, you get another picture.
    done(&[&scene[..], &look, &["--picture", &again]].concat());
    assert!(!same(&picture, &again), "tints change the picture");
}

#[test]
fn settings_come_from_presets_files_and_single_options() {
    let folder = folder();
    let [model, picture, file] =
        ["box.obj", "p.png", "washed.toml"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR, &["--picture", &picture]].concat();
    let painted = |options: &[&str]| {
        done(&[&scene[..], options].concat());
        fs::read(&picture).unwrap()
    };
    fs::write(&file, done(&["--show-preset", "washed"]).out).unwrap();
    let washed = painted(&["--preset", "washed"]);
    assert!(washed == painted(&["--settings", &file]));
    assert!(washed != painted(&[]));
    // Volumes lie on samples of the surface.
    let [few, many] = ["grid.samples=64", "grid.samples=200"].map(|samples| {
        let folder = path(&folder, samples);
        let own = ["--set", samples, "--rate", "2", "--volumes", &folder];
        done(&[&[&model[..]], &SMALL[..], &POUR, &own].concat());
        fs::read(Path::new(&folder).join("frame-0002.ply")).unwrap()
    });
    assert!(few != many);
}

#[test]
fn an_animation_that_was_interrupted_ends_in_the_same_bytes() {
    let folder = folder();
    let [model, film, still] = ["box.obj", "a.gif", "p.png"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR].concat();
    let moving = ["--animation", &film, "--rate", "8", "--json"];
    let frames = Path::new(&film).with_extension("frames");
    let film_with_frames_found = |found: u64| {
        let json = done(&[&scene[..], &moving].concat()).json();
        assert_eq!((&json["frames"], &json["frames_found"]), (&5.into(), &found.into()), "{json}");
        fs::read(&film).unwrap()
    };
    let whole = film_with_frames_found(0);
    assert!(whole.starts_with(b"GIF89a"));
    let names = files(&frames, ".png");
    assert_eq!(names.len(), 5, "{names:?}");
    for index in [1, 3, 4] {
        fs::remove_file(frames.join(&names[index])).unwrap();
    }
    fs::remove_file(&film).unwrap();
    assert!(whole == film_with_frames_found(2), "the same bytes");
    // A frame is the still of its time, and the first shows no colour yet.
    done(&[&scene[..], &["--at", "0.25", "--picture", &still]].concat());
    let [first, middle, last] = [0, 2, 4].map(|index: usize| pixels(frames.join(&names[index])));
    assert!(pixels(&still) == middle && middle != last);
    assert!(first.pixels().all(|pixel| pixel.0[0] == pixel.0[2]), "grey at first");
}

#[test]
fn volumes_of_each_frame_are_those_of_the_library_at_that_moment() {
    let folder = folder();
    let [model, meshes, script] = ["box.obj", "v", "s.toml"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR, &["--json", "--script-out", &script]].concat();
    let json = done(&[&scene[..], &["--volumes", &meshes, "--rate", "4"]].concat()).json();
    let names = files(&meshes, ".ply");
    assert_eq!(names, ["frame-0001.ply", "frame-0002.ply", "frame-0003.ply"]);
    let script = Script::open(Path::new(&script)).unwrap();
    let model = Path::new(&model);
    let model = Mesh::open(model).unwrap();
    let camera = Framing { aspect: 64.0 / 48.0, ..Framing::default() }.fit(&model.positions);
    let view = FirstView::new(&model, &camera, (64, 48));
    let settings = script.settings().unwrap();
    let mut play = Performance::new(&script, &model, &settings, &view).unwrap();
    // The first frame shows the beginning, without volumes.
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
    assert_eq!(json["volumes"].as_u64(), Some(play.world().volumes().len() as u64));
}

#[test]
fn a_turntable_turns() {
    let folder = folder();
    let [model, frames] = ["box.obj", "f"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR, &["--json"]].concat();
    let turning = ["--frames", &frames, "--turntable", "3", "--height", "40"];
    let json = done(&[&scene[..], &turning].concat()).json();
    assert_eq!((&json["frames"], &json["size"]), (&3.into(), &serde_json::json!([64, 40])));
    let names = files(&frames, ".png");
    let shown: Vec<RgbImage> =
        names.iter().map(|name| pixels(Path::new(&frames).join(name))).collect();
    assert!(shown.len() == 3 && shown[0] != shown[1] && shown[1] != shown[2]);
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
    fs::write(&script, text).unwrap();
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
    let stages: Vec<RgbImage> =
        names.iter().map(|name| pixels(Path::new(&stages).join(name))).collect();
    let [seen, .., hidden, _, bright, tint, _, mask, picture_stage] = &stages[..] else { panic!() };
    assert!(*picture_stage == pixels(&picture));
    let [none, some] =
        [hidden, bright].map(|picture| picture.pixels().filter(|pixel| pixel.0[0] > 0).count());
    assert_eq!(none, 0, "nothing is poured in the first region");
    assert!(some > 20 && tint == mask, "the second alone makes the mask");
    assert!(seen.get_pixel(32, 24).0[0] > 2 * seen.get_pixel(32, 24).0[2], "red");
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
        let json = done(&[&scene[..], &["--backend", backend, "--picture", file]].concat()).json();
        assert_eq!(json["backend"] == "cpu", backend == "cpu", "{json}");
    }
    let cpu = pixels(&cpu);
    let gpu = pixels(&gpu);
    let pairs = cpu.pixels().zip(gpu.pixels());
    let off = pairs.filter(|(a, b)| (0..3).any(|i| a.0[i].abs_diff(b.0[i]) > 2)).count();
    assert!(off as f64 <= 0.002 * f64::from(cpu.width() * cpu.height()), "{off} pixels differ");
}

#[test]
fn a_scene_turned_inside_out_is_painted_as_well() {
    let folder = folder();
    let [model, turned, mask] = ["box.obj", "turned.obj", "m.png"].map(|name| path(&folder, name));
    // The box with all its faces the other way round.
    let faces = BOX.lines().map(|line| match line.strip_prefix("f ") {
        Some(corners) => {
            let corners: Vec<&str> = corners.split(' ').rev().collect();
            format!("f {}\n", corners.join(" "))
        }
        None => format!("{line}\n"),
    });
    fs::write(&turned, faces.collect::<String>()).unwrap();
    let [own, found] = [&model, &turned].map(|model| {
        done(&[&[&model[..]], &SMALL[..], &POUR, &["--mask", &mask]].concat());
        pixels(&mask).pixels().filter(|pixel| pixel.0[0] > 127).count()
    });
    // The surface has other samples, so paint takes another way around the edges.
    assert!(own > 20 && (own / 2..own * 2).contains(&found), "{own} {found}");
}

/// A frame rate of 8 Hz: five frames in half a second, unless the camera has its own number.
const RATE: [&str; 2] = ["--rate", "8"];

/// Paints a still and a film of `subject` with these options of its camera, and again with only the
/// script that this wrote. Compares their bytes, and returns the still, the film and the script.
fn replayed(subject: &str, camera: &[&str]) -> (Vec<u8>, Vec<u8>, String) {
    let folder = tempfile::tempdir().unwrap();
    let [picture, film, script] = ["p.png", "f.gif", "s.toml"].map(|name| path(&folder, name));
    let [again, second, other] = ["q.png", "g.gif", "t.toml"].map(|name| path(&folder, name));
    let written = ["--picture", &picture, "--animation", &film, "--script-out", &script];
    done(&[&[subject], &SMALL[..], &POUR, &RATE, camera, &written].concat());
    let written = ["--picture", &again, "--animation", &second, "--script-out", &other];
    done(&[&[&script[..], "--width", "64"], &RATE[..], &written].concat());
    let text = fs::read_to_string(&script).unwrap();
    let [picture, again, film, second] =
        [picture, again, film, second].map(|name| fs::read(name).unwrap());
    assert!(picture == again, "{camera:?}: the still");
    assert!(film == second, "{camera:?}: the film");
    assert_eq!(text, fs::read_to_string(&other).unwrap(), "{camera:?}");
    (picture, film, text)
}

#[test]
fn a_script_that_was_written_has_the_camera_of_a_model() {
    let folder = folder();
    let [model, camera] = ["box.obj", "path.toml"].map(|name| path(&folder, name));
    let text = "frames = 4\n[[keyframe]]\neye = [3.123456789, 2.0, 5.0]\ntarget = [0.0, 0.5, 0.0]\n\
        [[keyframe]]\neye = [5.0, 3.0, 1.987654321]\ntarget = [0.0, 0.5, 0.0]\n\
        field_of_view_deg = 41.23456789\n";
    fs::write(&camera, text).unwrap();
    let plain = replayed(&model, &[]);
    let turning = replayed(&model, &["--turntable", "3"]);
    let turned = replayed(&model, &["--turntable", "3", "--camera", "400,25,35"]);
    let led = replayed(&model, &["--camera", &camera]);
    assert!(turning.2.contains("turntable = 3") && led.2.contains("frames = 4"), "{}", led.2);
    let stills = [&plain.0, &turned.0, &led.0];
    let films = [&plain.1, &turning.1, &turned.1, &led.1];
    assert!((0..3).all(|i| (0..i).all(|j| stills[i] != stills[j])));
    assert!((0..4).all(|i| (0..i).all(|j| films[i] != films[j])));
    let both = ["--turntable", "3", "--camera", &camera, "--mask", "m.png"];
    let run = stencil(&[&[&model[..]], &SMALL[..], &POUR, &both].concat());
    assert!(run.status == 2 && run.err.contains("both move the camera"), "{}", run.err);
}

#[test]
fn a_script_that_was_written_has_the_camera_of_a_photograph() {
    let folder = folder();
    let [photo, script, mask] = ["photo.png", "s.toml", "m.png"].map(|name| path(&folder, name));
    RgbImage::from_fn(60, 40, |x: u32, y: u32| {
        Rgb(if x < 30 { [40, 60, 140] } else { [210, 5 * y as u8, 60] })
    })
    .save(&photo)
    .unwrap();
    let plain = replayed(&photo, &[]);
    let turned = replayed(&photo, &["--camera", "18,-9"]);
    let swinging = replayed(&photo, &["--turntable", "3"]);
    assert!(plain.0 != turned.0 && plain.1 != swinging.1 && turned.1 != swinging.1);
    assert!(turned.2.contains("azimuth_deg = 18.0"), "{}", turned.2);
    let head = "format = \"paint-volumes\"\nversion = 1\nsubject = \"photo.png\"\nseconds = 0.5\n\
        [[pour]]\npicked = [0.5, 0.5]\nfor_s = 0.2\namount_mm3 = 20.0\n[camera]\n";
    for (key, words) in [
        ("elevation_deg = 85", "line 10: camera.elevation_deg takes -80 to 80"),
        ("field_of_view_deg = 40", "line 10: camera.field_of_view_deg takes no value before"),
    ] {
        fs::write(&script, format!("{head}{key}\n")).unwrap();
        let run = stencil(&[&script, "--mask", &mask]);
        assert!(run.status == 1 && run.err.contains(words), "{}", run.err);
        assert!(run.err.contains("hint: "), "{}", run.err);
    }
}

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
    let own = pixels(&picture);
    let same = relit(&[]);
    let off = own.pixels().zip(same.pixels());
    let off = off.map(|(a, b)| (0..3).map(|i| a.0[i].abs_diff(b.0[i])).max().unwrap());
    assert!(off.max() <= Some(1), "the picture as it was saved");
    // Where ultramarine was poured, the picture turns from blue to red, and only there.
    let swapped = relit(&["--swap", "all:Ultramarine=Vermilion"]);
    fn redness(pixel: &Rgb<u8>) -> i32 {
        i32::from(pixel.0[0]) - i32::from(pixel.0[2])
    }
    let turned = same.pixels().zip(swapped.pixels()).filter(|(a, b)| a != b);
    let turned: Vec<i32> = turned.map(|(a, b)| redness(b) - redness(a)).collect();
    assert!((20..1500).contains(&turned.len()), "{} pixels changed", turned.len());
    assert!(turned.iter().all(|&more| more >= 0), "{turned:?}");
    assert!(turned.iter().filter(|&&more| more > 40).count() > 20, "{turned:?}");
    assert!(relit(&["--illuminant", "A", "--adaptation", "0"]) != same);
    let names = files(&maps, ".png");
    assert!(names.iter().any(|name| name.to_lowercase().contains("ultramarine")), "{names:?}");
    assert!(fs::metadata(&spectral).unwrap().len() > 1000);
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
        let text = fs::read_to_string(&script).unwrap();
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
    // You can show parts of a painting, but not write them as one.
    done(&[&scene[..], &palette, &["--show", "mask", "--picture", &picture]].concat());
    assert!(pixels(&picture).pixels().all(|pixel| [0, 255].contains(&pixel.0[1])));
    let output = path(&folder, "o.exr");
    let run = stencil(&[&scene[..], &palette, &["--show", "mask", "--output", &output]].concat());
    assert!(run.status == 2 && run.err.contains("--output is of the painting"), "{}", run.err);
}

#[test]
fn a_written_script_knows_its_pigments_and_guards_them() {
    let folder = folder();
    fs::copy(library(), path(&folder, "own.toml")).unwrap();
    let [model, pigments] = ["box.obj", "own.toml"].map(|name| path(&folder, name));
    let [script, one, other] = ["s.toml", "1.png", "2.png"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR, &["--pigments", &pigments]].concat();
    let paint = ["--palette", "Viridian", "--illuminant", "A"];
    done(&[&scene[..], &paint, &["--picture", &one, "--script-out", &script]].concat());
    let text = fs::read_to_string(&script).unwrap();
    assert!(
        text.contains("library = \"own.toml\"") && text.contains("illuminant = \"A\""),
        "{text}"
    );
    done(&[&script, "--width", "64", "--picture", &other]);
    assert_eq!(pixels(&one), pixels(&other), "the script alone makes the same picture");
    done(&[&script, "--width", "64", "--picture", &other, "--illuminant", "D65"]);
    assert_ne!(pixels(&one), pixels(&other), "another light");
    let before = fs::read(&pigments).unwrap();
    let refused = stencil(&[&script, "--width", "64", "--script-out", &pigments]);
    assert_eq!(refused.status, 2, "{}", refused.err);
    assert!(refused.err.contains("own.toml") && fs::read(&pigments).unwrap() == before);
    let alone =
        [&[&model[..]], &SMALL[..], &POUR, &["--picture", &one, "--illuminant", "A"]].concat();
    let refused = stencil(&alone);
    assert!(
        refused.status == 2 && refused.err.contains("--illuminant needs pigments"),
        "{}",
        refused.err
    );
}

#[test]
fn a_written_script_holds_its_ground_and_its_lamp() {
    let folder = folder();
    let library = library();
    let lamp = "nm,halogen,led\n380,0.1,0.02\n500,0.5,0.4\n600,0.9,0.7\n730,1.3,0.05\n";
    fs::write(path(&folder, "lamp.csv"), lamp).unwrap();
    fs::write(path(&folder, "paper.csv"), "nm,rag\n380,0.512345678\n730,0.8\n").unwrap();
    let [model, script, lamp, paper] =
        ["box.obj", "s.toml", "lamp.csv#led", "paper.csv"].map(|name| path(&folder, name));
    let files = ["1.png", "1.exr", "2.png", "2.exr"].map(|name| path(&folder, name));
    let [one, layers, other, again] = &files;
    let scene = [&[&model[..]], &SMALL[..], &POUR, &["--pigments", &library]].concat();
    let paint = ["--palette", "Viridian", "--ground", "linen", "--over", &paper];
    let paint = [&paint[..], &["--illuminant", &lamp]].concat();
    let exports = ["--picture", one, "--output", layers, "--script-out", &script];
    done(&[&scene[..], &paint, &exports].concat());
    fs::remove_file(&paper).unwrap();
    let replayed = |options: &[&str]| {
        let written = [&script, "--width", "64", "--picture", other, "--output", again];
        done(&[&written[..], options].concat());
        [other, again].map(|file| fs::read(file).unwrap())
    };
    let bytes = [one, layers].map(|file| fs::read(file).unwrap());
    assert!(replayed(&[]) == bytes, "the script alone makes the same picture and painting");
    for other in [["--over", "black"], ["--ground", "paper"], ["--illuminant", "A"]] {
        assert!(replayed(&other) != bytes, "{other:?} is another painting");
    }
    // If you write the script again to another folder, the lamp is still found.
    let below = path(&folder, "below");
    fs::create_dir(&below).unwrap();
    let moved = format!("{below}/t.toml");
    done(&[&script, "--width", "64", "--script-out", &moved]);
    let options = ["--width", "64", "--picture", other, "--output", again];
    done(&[&[&moved[..]], &options[..]].concat());
    assert!([other, again].map(|file| fs::read(file).unwrap()) == bytes);
    let bare =
        [&[&model[..]], &SMALL[..], &POUR, &["--picture", one, "--ground", "linen"]].concat();
    let refused = stencil(&bare);
    assert!(
        refused.status == 2 && refused.err.contains("--ground needs pigments"),
        "{}",
        refused.err
    );
}

#[test]
fn the_passes_hold_the_heights_of_each_pigment() {
    use exr::prelude::{ReadChannels, ReadLayers, read};
    let folder = folder();
    let library = library();
    let [photo, passes] = ["photo.png", "p.exr"].map(|name| path(&folder, name));
    RgbImage::from_pixel(60, 40, Rgb([180; 3])).save(&photo).unwrap();
    // A photograph is 200 mm wide and fills the picture, so a pixel is 1 mm^2.
    let scene = [&photo, "--width", "200", "--set", "picture.samples=1", "--pigments", &library];
    let paint = ["--pour", "0.4,0.5,18", "--paint", "Ultramarine=3,Lead White=1"];
    let json = done(&[&scene[..], &paint, &["--passes", &passes, "--json"]].concat()).json();
    let image = read().no_deep_data().largest_resolution_level().all_channels();
    let image = image.all_layers().all_attributes().from_file(&passes).unwrap();
    let part = |wanted: &str| {
        let mut layers = image.layer_data.iter();
        layers
            .find(|own| {
                own.attributes
                    .layer_name
                    .as_ref()
                    .is_some_and(|name: &exr::prelude::Text| *name == *wanted)
            })
            .unwrap()
    };
    let values = |wanted: &str, channel: &str| -> Vec<f64> {
        let channels = &part(wanted).channel_data.list;
        let own = channels.iter().find(|own| own.name == *channel).unwrap();
        own.sample_data.values_as_f32().map(f64::from).collect()
    };
    assert_eq!(part("heights").channel_data.list.len(), 2);
    let [blue, white] = ["Ultramarine", "Lead White"].map(|name| values("heights", name));
    let laid: f64 = blue.iter().chain(&white).sum();
    let on_scene = json["paint_mm3"]["on_scene"].as_f64().unwrap();
    assert!((on_scene - 18.0).abs() < 1e-3, "{json}");
    assert!((laid / on_scene - 1.0).abs() < 0.02, "{laid} of {on_scene} mm3");
    let counts = values("count.1", "N");
    for ((blue, white), count) in blue.iter().zip(&white).zip(&counts) {
        assert_eq!(*blue > 0.0, *count > 0.0, "a film where volumes are");
        assert!((blue - 3.0 * white).abs() <= 2e-5, "{blue} {white}");
    }
    // This is the film of the preset grisaille, and a little more at its edge.
    let most = blue.iter().zip(&white).map(|(blue, white)| blue + white).fold(0.0, f64::max);
    assert!((0.003..0.012).contains(&most), "{most} mm");
    assert!(counts.iter().filter(|&&count| count > 0.0).count() > 4000);
}
