//! Files that inputs name: the materials and textures of models, the pictures of settings and
//! regions, the start of a script. They lie beside the file that names them, and they are inputs,
//! which no output replaces. Also models far from the origin, with cameras in their coordinates.

use std::fs;
use std::path::Path;

use suite::program::impasto;
use tempfile::TempDir;

/// A square with a texture, and a sheet behind it.
const MODEL: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 -1\nvt 0 0\n\
    vt 1 0\nvt 1 1\nusemtl a\nf 1/1 2/2 3/3\nf 1/1 3/3 4/2\nusemtl b\nf 1 5 2\n";
const MATERIALS: &str = "newmtl a\nmap_Kd photo.png\nnewmtl b\nKd 0.9 0.2 0.1\n";

/// A folder with the model `m.obj`, its materials and its texture.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("m.obj"), MODEL).unwrap();
    fs::write(folder.path().join("m.mtl"), MATERIALS).unwrap();
    let texture =
        image::RgbImage::from_fn(8, 8, |x, y| image::Rgb([30 * x as u8, 9 * y as u8, 90]));
    texture.save(folder.path().join("photo.png")).unwrap();
    folder
}

fn path(folder: &Path, name: &str) -> String {
    folder.join(name).display().to_string()
}

/// Options of a picture that is made quickly.
const SMALL: [&str; 4] = ["--width", "32", "--backend", "cpu"];

/// Asserts that a command ends with this status and says all these words, and that the file at
/// `kept` keeps its bytes.
#[track_caller]
fn refused(arguments: &[&str], status: u8, words: &[&str], kept: &str) {
    let before = fs::read(kept).unwrap();
    let run = impasto(arguments);
    assert_eq!(run.status, status, "{arguments:?}: {}", run.err);
    for words in words {
        assert!(run.err.contains(words), "no `{words}` in: {}", run.err);
    }
    assert!(fs::read(kept).unwrap() == before, "{kept} was replaced");
}

#[test]
fn the_files_of_a_model_are_never_overwritten() {
    let folder = folder();
    let [model, texture] = ["m.obj", "photo.png"].map(|name| path(folder.path(), name));
    let words = ["photo.png", "is an input file"];
    for verb in ["watercolor", "painterly", "stencil"] {
        let mut arguments = [&[verb, &model, "-o", &texture], &SMALL[..]].concat();
        if verb == "stencil" {
            arguments.extend(["--pour", "0.5,0.5", "--seconds", "0.1"]);
        }
        refused(&arguments, 2, &words, &texture);
    }
    // A script names the model, which names the texture.
    let script = path(folder.path(), "s.toml");
    let header = "format = \"paint-volumes\"\nversion = 1\ntitle = \"t\"\nsubject = \"m.obj\"\n";
    let pour = "[[pour]]\npicked = [0.5, 0.5]\nfor_s = 0.1\namount_mm3 = 9\n";
    fs::write(&script, format!("{header}seconds = 0.1\n{pour}")).unwrap();
    refused(&[&["stencil", &script, "-o", &texture], &SMALL[..]].concat(), 2, &words, &texture);
}

#[test]
fn the_files_of_regions_are_never_overwritten() {
    let folder = folder();
    let [model, labels, map] =
        ["photo.png", "labels.png", "night.exr"].map(|name| path(folder.path(), name));
    fs::copy(&model, &labels).unwrap();
    fs::write(&map, "a map").unwrap();
    let regions = path(folder.path(), "regions.toml");
    let text = "labels = \"labels.png\"\n[[region]]\nname = \"a\"\nlabel = \"#00005a\"\n";
    fs::write(&regions, format!("{text}map = \"night.exr\"\n")).unwrap();
    for output in [&labels, &map] {
        let arguments = ["painterly", &model, "--regions", &regions, "-o", output];
        let arguments = [&arguments[..], &SMALL[..]].concat();
        refused(&arguments, 2, &["is an input file"], output);
    }
}

#[test]
fn files_outside_the_folder_need_an_option() {
    let folder = folder();
    let inner = folder.path().join("inner");
    fs::create_dir(&inner).unwrap();
    let model = path(&inner, "m.obj");
    fs::write(&model, MODEL.replace("m.mtl", "../m.mtl")).unwrap();
    let output = path(folder.path(), "out.png");
    fs::copy(path(folder.path(), "photo.png"), inner.join("photo.png")).unwrap();
    let picture = [&["watercolor", &model, "-o", &output], &SMALL[..]].concat();
    let words = ["m.obj: mtllib `../m.mtl`: lies outside the folder", "--allow-outside"];
    refused(&picture, 1, &words, &model);
    let run = impasto(&[&picture[..], &["--allow-outside"]].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    // A file of settings names a picture. A change of one setting comes from the user.
    let settings = path(&inner, "paper.toml");
    fs::write(&settings, "[toon]\ngreys = \"../photo.png\"\n").unwrap();
    let model = path(folder.path(), "m.obj");
    let picture = [&["watercolor", &model, "-o", &output], &SMALL[..]].concat();
    let with_file = [&picture[..], &["--settings", &settings]].concat();
    refused(&with_file, 1, &["toon.greys `../photo.png`: lies outside", "--allow-outside"], &model);
    let change = format!("toon.greys={}", path(&inner, "photo.png"));
    for more in [
        &["--settings", &settings, "--allow-outside"][..],
        &["--settings", &settings, "--set", &change],
        &["--set", &change],
    ] {
        let run = impasto(&[&picture[..], more].concat());
        assert_eq!(run.status, 0, "{more:?}: {}", run.err);
    }
    // Regions name pictures and maps.
    let regions = path(&inner, "regions.toml");
    let photograph = path(folder.path(), "photo.png");
    for (key, text) in [
        ("labels", "labels = \"../photo.png\"\n".to_owned()),
        ("map", "[[region]]\nname = \"a\"\nmaterial = \"a\"\nmap = \"../photo.png\"\n".to_owned()),
    ] {
        fs::write(&regions, text).unwrap();
        let arguments = ["painterly", &photograph, "--regions", &regions, "-o", &output];
        let words = [&format!("{key} `../photo.png`: lies outside")[..], "--allow-outside"];
        refused(&[&arguments[..], &SMALL[..]].concat(), 1, &words, &photograph);
    }
}

/// A script that continues the painting at `start`.
fn continued(start: &str) -> String {
    format!(
        "{{\"format\": \"strokes\", \"version\": 1, \"title\": \"t\", \"canvas\": \
         {{\"width_mm\": 12, \"height_mm\": 9, \"cell_mm\": 0.5}}, \"palette\": {{\"W\": \
         \"Lead White\"}}, \"start\": \"{start}\", \"brushes\": {{\"r\": {{\"shape\": \
         \"round\", \"size_mm\": 3}}}}, \"actions\": [{{\"dry\": {{}}}}]}}"
    )
}

#[test]
fn a_script_continues_only_a_painting_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("inner");
    fs::create_dir(&inner).unwrap();
    fs::write(folder.path().join("far.exr"), "no painting").unwrap();
    fs::create_dir(inner.join("folder.exr")).unwrap();
    let script = path(&inner, "s.json");
    let output = path(folder.path(), "p.png");
    fs::write(&script, continued("../far.exr")).unwrap();
    let arguments = ["paint", &script, "-o", &output, "--backend", "cpu"];
    let words = ["start `../far.exr`: lies outside the folder", "--allow-outside"];
    refused(&arguments, 1, &words, &script);
    let run = impasto(&[&arguments[..], &["--allow-outside"]].concat());
    assert!(run.err.contains("far.exr") && !run.err.contains("outside"), "{}", run.err);
    fs::write(&script, continued("folder.exr")).unwrap();
    refused(&arguments, 1, &["start `folder.exr`: is not a regular file"], &script);
}

/// The path of a camera before a model that is moved by `x`.
fn camera(x: f64) -> String {
    let [eye, target] = [0.75 + x, 0.5 + x];
    format!("frames = 1\n[[keyframe]]\neye = [{eye}, 1, 4]\ntarget = [{target}, 0.5, 0]\n")
}

#[test]
fn a_model_far_from_the_origin_is_painted_like_one_at_the_origin() {
    let folder = folder();
    let picture = |x: f64, options: &[&str]| {
        let moved = MODEL.lines().map(|line| match line.strip_prefix("v ") {
            Some(rest) => {
                let (first, rest) = rest.split_once(' ').unwrap();
                format!("v {} {rest}\n", first.parse::<f64>().unwrap() + x)
            }
            None => format!("{line}\n"),
        });
        let [model, output] = ["moved.obj", "out.png"].map(|name| path(folder.path(), name));
        fs::write(&model, moved.collect::<String>()).unwrap();
        let run = impasto(&[&["watercolor", &model, "-o", &output], &SMALL[..], options].concat());
        assert_eq!(run.status, 0, "{x}: {}", run.err);
        fs::read(output).unwrap()
    };
    let cameras = path(folder.path(), "camera.toml");
    let at_origin = picture(0.0, &[]);
    fs::write(&cameras, camera(0.0)).unwrap();
    let with_camera = picture(0.0, &["--camera", &cameras]);
    assert!(at_origin != with_camera);
    for x in [1e5, 5e5, 1e6, 1e7, 1e8] {
        assert!(picture(x, &[]) == at_origin, "at {x}");
        fs::write(&cameras, camera(x)).unwrap();
        assert!(picture(x, &["--camera", &cameras]) == with_camera, "a camera at {x}");
    }
}

#[test]
fn many_equal_faces_take_the_memory_of_a_few() {
    let folder = tempfile::tempdir().unwrap();
    let corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.2\n";
    let [few, many] = [4, 800].map(|faces: usize| {
        let [model, output] = ["m.obj", "out.png"].map(|name| path(folder.path(), name));
        fs::write(&model, format!("{corners}{}", "f 1 2 3 4\n".repeat(faces))).unwrap();
        let started = std::time::Instant::now();
        let run = impasto(&[&["watercolor", &model, "-o", &output], &SMALL[..]].concat());
        assert_eq!(run.status, 0, "{}", run.err);
        started.elapsed()
    });
    // Without a limit, 800 faces took 24 seconds and 3.7 GB.
    assert!(many < 20 * few + std::time::Duration::from_secs(8), "{many:?}, {few:?} for four");
}
