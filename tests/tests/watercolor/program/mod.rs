//! The command `impasto watercolor`: meshes (file formats, shapes, cameras, stages, GPU),
//! photographs (colours, formats, stages, masks, GPU), and a moving camera (frames, GIF and APNG,
//! resumed runs).

mod refusals;
mod pigments;

use std::fs::File;
use std::io::BufReader;
use std::path::Path;
use std::time::Duration;

use graphics::export::png8;
use graphics::field::Field;
use image::codecs::gif::GifDecoder;
use image::codecs::png::PngDecoder;
use image::{AnimationDecoder, Rgb, RgbImage};
use suite::program::{Run, impasto};
use tempfile::TempDir;

struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// Path of a file in the folder. It need not exist.
    fn file(&self, name: &str) -> String {
        self.0.path().join(name).display().to_string()
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) -> String {
        std::fs::write(self.0.path().join(name), content).unwrap();
        self.file(name)
    }

    /// Sorted names in the subfolder `inside`. There are none if the folder does not exist.
    fn names(&self, inside: &str) -> Vec<String> {
        let Ok(entries) = std::fs::read_dir(self.0.path().join(inside)) else { return Vec::new() };
        let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<_> = names.collect();
        names.sort();
        names
    }

    /// A photograph of 160 x 120 pixels: red on the left, blue on the right, darker downwards, with
    /// a yellow disc in the middle.
    fn photograph(&self) -> String {
        let colors = (0..160 * 120).map(|i| {
            let x = (i % 160) as f32;
            let y = (i / 160) as f32;
            let light = 1.0 - 0.5 * y / 120.0;
            let [r, g, b] = match (x - 80.0).hypot(y - 60.0) {
                ..30.0 => [0.8, 0.6, 0.1],
                _ if x < 80.0 => [0.6, 0.1, 0.05],
                _ => [0.05, 0.15, 0.5],
            };
            [r * light, g * light, b * light, 1.0]
        });
        let picture = Field::from_values(160, 120, colors.collect());
        self.write("photo.png", png8(&picture, 1.0).unwrap().bytes)
    }

    /// A mask of 160 x 120 pixels, white on the left and black on the right.
    fn mask(&self) -> String {
        let picture = Field::from_values(
            160,
            120,
            (0..160 * 120).map(|i: usize| [if i % 160 < 80 { 1.0 } else { 0.0 }; 4]).collect(),
        );
        self.write("mask.png", png8(&picture, 1.0).unwrap().bytes)
    }

    /// An OBJ file of a pyramid on a square, with a colour for each corner.
    fn pyramid(&self) -> String {
        let mut text: String = CORNERS
            .into_iter()
            .map(|([x, y, z], [r, g, b]): ([i8; 3], [u8; 3])| {
                format!("v {x} {y} {z} {r} {g} {b}\n")
            })
            .collect();
        for [a, b, c] in SIDES {
            text += &format!("f {} {} {}\n", a + 1, b + 1, c + 1);
        }
        self.write("pyramid.obj", text)
    }
}

/// Positions and colours of the corners of a pyramid.
const CORNERS: [([i8; 3], [u8; 3]); 5] = [
    ([-1, 0, 1], [1, 0, 0]),
    ([1, 0, 1], [0, 1, 0]),
    ([1, 0, -1], [0, 0, 1]),
    ([-1, 0, -1], [1, 1, 0]),
    ([0, 2, 0], [1, 0, 1]),
];
const SIDES: [[u16; 3]; 6] = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [0, 2, 1], [0, 3, 2]];

fn watercolor(subject: &str, options: &[&str]) -> Run {
    impasto(&[&["watercolor", subject], options].concat())
}

/// Runs `impasto watercolor` on the CPU and asserts success.
#[track_caller]
fn painted(subject: &str, options: &[&str]) -> Run {
    let run = watercolor(subject, &[&["--backend", "cpu"], options].concat());
    assert_eq!(run.status, 0, "{options:?}: {}", run.err);
    run
}

/// Paints `subject` with `options` on the CPU. Returns the bytes of the PNG.
#[track_caller]
fn picture(folder: &Folder, subject: &str, options: &[&str]) -> Vec<u8> {
    let out = folder.file("picture.png");
    painted(subject, &[options, &["--picture", &out]].concat());
    std::fs::read(out).unwrap()
}

fn decoded(bytes: &[u8]) -> RgbImage {
    image::load_from_memory(bytes).unwrap().into_rgb8()
}

fn opened(path: impl AsRef<Path>) -> RgbImage {
    decoded(&std::fs::read(path).unwrap())
}

/// Mean and largest difference of two pictures of equal size, in levels of 8 bits.
#[track_caller]
fn difference(one: &RgbImage, other: &RgbImage) -> (f64, u8) {
    assert_eq!(one.dimensions(), other.dimensions(), "sizes");
    let pairs = one.as_raw().iter().zip(other.as_raw());
    let (sum, most) = pairs
        .map(|(a, b)| a.abs_diff(*b))
        .fold((0_u64, 0), |(sum, most), level| (sum + u64::from(level), most.max(level)));
    (sum as f64 / one.as_raw().len() as f64, most)
}

/// The mean colour of the columns from `left` to `right`.
fn mean(picture: &RgbImage, left: u32, right: u32) -> [f64; 3] {
    let inside = picture.enumerate_pixels().filter(|(x, ..)| (left..right).contains(x));
    let mut sum = [0.0; 3];
    let mut count = 0.0;
    for (.., pixel) in inside {
        (0..3).for_each(|i| sum[i] += f64::from(pixel.0[i]));
        count += 1.0;
    }
    sum.map(|sum| sum / count)
}

const SMALL: [&str; 2] = ["--width", "64"];

fn ply() -> String {
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n\
         property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        CORNERS.len(),
        SIDES.len()
    );
    for ([x, y, z], color) in CORNERS {
        let [r, g, b] = color.map(|value| value * 255);
        text += &format!("{x} {y} {z} {r} {g} {b}\n");
    }
    for [a, b, c] in SIDES {
        text += &format!("3 {a} {b} {c}\n");
    }
    text
}

fn glb() -> Vec<u8> {
    let places = CORNERS.iter().flat_map(|(place, _)| place.map(f32::from));
    let colors = CORNERS.iter().flat_map(|(_, color)| color.map(f32::from));
    let corners = SIDES.as_flattened().iter().flat_map(|corner| corner.to_le_bytes());
    let buffer: Vec<u8> = places.chain(colors).flat_map(f32::to_le_bytes).chain(corners).collect();
    let document = serde_json::json!({
        "asset": { "version": "2.0" },
        "buffers": [{ "byteLength": buffer.len() }],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": 60 },
            { "buffer": 0, "byteOffset": 60, "byteLength": 60 },
            { "buffer": 0, "byteOffset": 120, "byteLength": 36 }
        ],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3",
              "min": [-1, 0, -1], "max": [1, 2, 1] },
            { "bufferView": 1, "componentType": 5126, "count": 5, "type": "VEC3" },
            { "bufferView": 2, "componentType": 5123, "count": 18, "type": "SCALAR" }
        ],
        "meshes": [{ "primitives": [
            { "attributes": { "POSITION": 0, "COLOR_0": 1 }, "indices": 2 }] }],
        "nodes": [{ "mesh": 0 }],
        "scenes": [{ "nodes": [0] }],
        "scene": 0
    });
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    fn number(value: usize) -> [u8; 4] {
        (value as u32).to_le_bytes()
    }
    let mut glb = b"glTF\x02\0\0\0".to_vec();
    glb.extend(number(12 + 8 + text.len() + 8 + buffer.len()));
    glb.extend(number(text.len()));
    glb.extend(b"JSON");
    glb.extend(&text);
    glb.extend(number(buffer.len()));
    glb.extend(b"BIN\0");
    glb.extend(&buffer);
    glb
}

/// Number of painted pixels. These have a channel below 200.
fn covered(picture: &RgbImage) -> usize {
    picture.pixels().filter(|pixel: &&Rgb<u8>| pixel.0.iter().any(|value| *value < 200)).count()
}

#[test]
fn one_mesh_is_one_picture_from_every_format() {
    let folder = Folder::new();
    let obj = folder.pyramid();
    let ply = folder.write("pyramid.ply", ply());
    let glb = folder.write("pyramid.GLB", glb());
    let [obj, ply, glb] = [obj, ply, glb].map(|path| decoded(&picture(&folder, &path, &SMALL)));
    assert_eq!(obj.dimensions(), (64, 48));
    let share = covered(&obj) as f64 / (64.0 * 48.0);
    assert!((0.1..0.7).contains(&share), "{share} of the picture is painted");
    for (name, other) in [("ply", ply), ("glb", glb)] {
        let (mean, most) = difference(&obj, &other);
        assert!(mean < 0.01 && most <= 2, "{name}: {mean}, {most}");
    }
}

#[test]
fn shapes_that_come_with_the_program_are_painted() {
    let folder = Folder::new();
    let mut all: Vec<RgbImage> = Vec::new();
    for name in ["still-life", "village", "torus-knot", "sphere"] {
        let made = decoded(&picture(&folder, &format!("shape:{name}"), &SMALL));
        assert!(covered(&made) > 200, "{name}: {} pixels painted", covered(&made));
        assert!(all.iter().all(|other| difference(other, &made).0 > 3.0), "{name}: same picture");
        all.push(made);
    }
}

#[test]
fn cameras_are_numbers_or_a_file() {
    let folder = Folder::new();
    let pyramid = folder.pyramid();
    let out = folder.file("out.png");
    let run = painted(&pyramid, &["--width", "64", "--height", "64", "--picture", &out, "--json"]);
    assert_eq!(run.json()["size"], serde_json::json!([64, 64]));
    assert_eq!(run.json()["regions"], serde_json::Value::Null);
    let from =
        |camera: &str| decoded(&picture(&folder, &pyramid, &["--width", "64", "--camera", camera]));
    let usual = decoded(&picture(&folder, &pyramid, &SMALL));
    assert_eq!(usual, from("30,20"));
    assert_eq!(usual, from(" 30, 20 ,30"));
    for other in ["-60,20", "30,-40", "30,20,90"] {
        assert!(difference(&usual, &from(other)).0 > 1.0, "{other} equals the default camera");
    }
    // From straight above, the tip is in the middle of the picture.
    let above = from("0,90");
    let [r, g, b] = above.get_pixel(32, 24).0;
    assert!(g < r && g < b, "the tip is purple, found {r} {g} {b}");

    let path = "frames = 2\n[[keyframe]]\neye = [0.0, 1.0, 8.0]\ntarget = [0.0, 1.0, 0.0]\n\
                [[keyframe]]\neye = [8.0, 1.0, 0.0]\ntarget = [0.0, 1.0, 0.0]\n";
    let there = folder.write("path.toml", path);
    let back = folder.write("back.toml", path.replace("8.0, 1.0, 0.0]", "-8.0, 1.0, 0.0]"));
    // A single picture is the first frame of a path.
    assert_eq!(from(&there), from(&back));
    let away = folder
        .write("away.toml", path.replace("target = [0.0, 1.0, 0.0]", "target = [0.0, 1.0, 99.0]"));
    assert_eq!(covered(&from(&away)), 0, "paint without a visible mesh");
}

#[test]
fn stages_of_a_mesh_begin_with_its_surface() {
    let folder = Folder::new();
    let pyramid = folder.pyramid();
    let out = folder.file("out.png");
    let stages = folder.file("stages");
    painted(&pyramid, &["--width", "64", "--stages", &stages, "--picture", &out]);
    let names = [
        "01-surface.png",
        "02-wash.png",
        "03-wobble.png",
        "04-edges.png",
        "05-flow.png",
        "06-back-runs.png",
        "07-dispersion.png",
        "08-paper.png",
        "09-dry-brush.png",
        "10-sheet.png",
    ];
    assert_eq!(folder.names("stages"), names);
    let [surface, wash] = [0, 1].map(|i| opened(format!("{stages}/{}", names[i])));
    assert!(difference(&surface, &wash).0 > 1.0, "no shading");
    let (_, most) = difference(&opened(format!("{stages}/10-sheet.png")), &opened(&out));
    assert!(most <= 1, "{most}");
}

#[test]
fn a_device_paints_the_same_mesh() {
    let Some(device) = suite::program::device() else { return };
    drop(device);
    let folder = Folder::new();
    for (mesh, look) in [("shape:still-life", "portrait"), ("shape:torus-knot", "sketch")] {
        let look = ["--width", "160", "--preset", look];
        let on_cpu = decoded(&picture(&folder, mesh, &look));
        let out = folder.file("device.png");
        let run = watercolor(mesh, &[&look[..], &["--backend", "gpu", "--picture", &out]].concat());
        assert_eq!(run.status, 0, "{}", run.err);
        let made = opened(&out);
        let (mean, _) = difference(&on_cpu, &made);
        let pairs = on_cpu.pixels().zip(made.pixels());
        let far = pairs.filter(|(a, b)| (0..3).any(|i| a.0[i].abs_diff(b.0[i]) > 2)).count();
        // At an edge between two triangles, CPU and GPU may choose different ones.
        assert!(far <= 19 && mean < 0.02, "{mesh}: {far} pixels, {mean} in the mean");
    }
}

const KEYS: [&str; 6] = ["backend", "frames", "frames_found", "pigments", "regions", "size"];

#[test]
fn a_photograph_becomes_a_picture_of_its_colors() {
    let folder = Folder::new();
    let photo = folder.photograph();
    let out = folder.file("out.png");
    let run = painted(&photo, &["--picture", &out, "--json"]);
    let json = run.json();
    let mut keys: Vec<_> = json.as_object().unwrap().keys().map(String::as_str).collect();
    keys.sort_unstable();
    assert_eq!(keys, KEYS);
    assert_eq!(json["size"], serde_json::json!([160, 120]));
    assert_eq!(
        (json["backend"].as_str(), &json["frames"]),
        (Some("cpu"), &serde_json::Value::Null)
    );
    assert!((3..60).contains(&json["regions"].as_u64().unwrap()), "{json}");
    assert_eq!(json["pigments"], serde_json::json!([]));
    let made = opened(&out);
    let original = opened(&photo);
    assert_eq!(made.dimensions(), (160, 120));
    let [r, _, b] = mean(&made, 4, 40);
    let [far_r, _, far_b] = mean(&made, 120, 156);
    assert!(r > b + 40.0 && far_b > far_r + 40.0, "{r} {b}, {far_r} {far_b}");
    let (off, _) = difference(&made, &original);
    assert!((5.0..80.0).contains(&off), "{off}");

    let words = painted(&photo, &["--picture", &out]);
    assert!(words.out.starts_with("160 x 120 pixels on cpu, "), "{}", words.out);
    assert!(
        words.out.ends_with(" regions\n")
            && words.err.lines().all(|line| line.starts_with("Wrote ")),
        "{words:?}"
    );
    let smaller = decoded(&picture(&folder, &photo, &["--width", "80"]));
    assert_eq!(smaller.dimensions(), (80, 60));
}

#[test]
fn the_same_wish_gives_the_same_bytes_and_other_formats_the_same_picture() {
    let folder = Folder::new();
    let photo = folder.photograph();
    let first = picture(&folder, &photo, &["--preset", "landscape"]);
    assert!(first == picture(&folder, &photo, &["--preset", "landscape"]), "other bytes");
    let deep = picture(&folder, &photo, &["--preset", "landscape", "--bits", "16"]);
    let deep = image::load_from_memory(&deep).unwrap();
    assert_eq!(deep.color(), image::ColorType::Rgb16);
    let (_, most) = difference(&decoded(&first), &deep.into_rgb8());
    assert!(most <= 1, "{most}");
    let exr = folder.file("out.exr");
    painted(&photo, &["--picture", &exr]);
    assert!(std::fs::read(exr).unwrap().starts_with(&[0x76, 0x2f, 0x31, 0x01]));
}

#[test]
fn stages_are_written_in_their_order_and_the_last_is_the_picture() {
    let folder = Folder::new();
    let photo = folder.photograph();
    let out = folder.file("out.png");
    let stages = folder.file("stages");
    painted(&photo, &["--stages", &stages, "--picture", &out, "--preset", "sketch"]);
    let names = [
        "01-photograph.png",
        "02-regions.png",
        "03-wash.png",
        "04-wobble.png",
        "05-edges.png",
        "06-flow.png",
        "07-back-runs.png",
        "08-dispersion.png",
        "09-paper.png",
        "10-dry-brush.png",
        "11-sheet.png",
    ];
    assert_eq!(folder.names("stages"), names);
    let all = names.map(|name| opened(format!("{stages}/{name}")));
    assert_eq!(all[0], opened(&photo), "the photograph is unchanged");
    for (pair, names) in all.windows(2).zip(names.windows(2)) {
        assert!(difference(&pair[0], &pair[1]).1 > 0, "{names:?} are alike");
    }
    let (_, most) = difference(&all[10], &opened(&out));
    assert!(most <= 1, "{most}");
    // `--stages` alone is enough output.
    let alone = folder.file("alone");
    painted(&photo, &["--stages", &alone, "--preset", "sketch"]);
    assert_eq!(folder.names("alone"), names);
    let [one, other] =
        [&alone, &stages].map(|folder| std::fs::read(format!("{folder}/11-sheet.png")).unwrap());
    assert!(one == other, "the picture changed the stages");
}

#[test]
fn masks_say_where_density_changes_and_where_the_brush_is_dry() {
    let folder = Folder::new();
    let photo = folder.photograph();
    let mesh = folder.pyramid();
    let mask = folder.mask();
    let black = RgbImage::new(20, 10);
    let none = folder.file("none.png");
    black.save(&none).unwrap();
    let dry: &[&str] = &[
        "--set",
        "dry_brush.amount=0.6",
        "--set",
        "dry_brush.patches=0",
        "--set",
        "dry_brush.outline_px=0",
    ];
    let size: &[&str] = &["--width", "160", "--height", "120"];
    for (subject, size) in [(&photo, &[][..]), (&mesh, size)] {
        for (option, look) in [("--density-mask", &[][..]), ("--dry-brush-mask", dry)] {
            let [all, half, nothing] = [&[][..], &[option, &mask], &[option, &none]]
                .map(|more| decoded(&picture(&folder, subject, &[size, look, more].concat())));
            assert!(difference(&all, &nothing).0 > 0.5, "{option} does nothing");
            for (x, y, pixel) in half.enumerate_pixels() {
                let wanted = if x < 80 { &all } else { &nothing };
                assert_eq!(pixel, wanted.get_pixel(x, y), "{option} at {x}, {y}");
            }
        }
    }
}

#[test]
fn a_device_paints_the_same_photograph() {
    let Some(device) = suite::program::device() else { return };
    drop(device);
    let folder = Folder::new();
    let photo = folder.photograph();
    let look = ["--preset", "sketch"];
    let on_cpu = decoded(&picture(&folder, &photo, &look));
    let out = folder.file("device.png");
    let options = [&look[..], &["--backend", "gpu", "--picture", &out, "--json"]].concat();
    let run = watercolor(&photo, &options);
    assert_eq!(run.status, 0, "{}", run.err);
    assert_ne!(run.json()["backend"], "cpu");
    let (_, most) = difference(&on_cpu, &opened(&out));
    assert!(most <= 2, "{most} of 255");
}

#[test]
fn small_and_narrow_photographs_are_painted() {
    let folder = Folder::new();
    for (width, height) in [(1, 16), (3, 200), (200, 2)] {
        let name = folder.file("odd.png");
        RgbImage::from_pixel(width, height, Rgb([200, 90, 40])).save(&name).unwrap();
        let made = decoded(&picture(&folder, &name, &["--preset", "landscape"]));
        assert_eq!(made.dimensions(), (width, height));
    }
}

const TURN: [&str; 4] = ["--width", "48", "--turntable", "4"];

/// Paints a turntable of four frames of the pyramid, with the options `into`.
#[track_caller]
fn turned(folder: &Folder, into: &[&str]) -> Run {
    painted(&folder.pyramid(), &[&TURN[..], into, &["--json"]].concat())
}

fn frame(folder: &Folder, inside: &str, number: usize) -> String {
    folder.file(&format!("{inside}/frame-{number:04}.png"))
}

fn rgb(frames: Vec<image::Frame>) -> Vec<RgbImage> {
    frames
        .into_iter()
        .map(|frame: image::Frame| image::DynamicImage::from(frame.into_buffer()).into_rgb8())
        .collect()
}

#[test]
fn a_gif_and_an_apng_hold_every_frame() {
    let folder = Folder::new();
    let gif = folder.file("turn.gif");
    let apng = folder.file("turn.png");
    let json = turned(&folder, &["--animation", &gif, "--rate", "10"]).json();
    assert_eq!((json["frames"].as_u64(), json["frames_found"].as_u64()), (Some(4), Some(0)));
    let names =
        ["animation.json", "frame-0001.png", "frame-0002.png", "frame-0003.png", "frame-0004.png"];
    assert_eq!(folder.names("turn.frames"), names);
    let kept: Vec<_> = (1..=4).map(|n| opened(frame(&folder, "turn.frames", n))).collect();
    for pair in kept.windows(2) {
        assert!(difference(&pair[0], &pair[1]).0 > 1.0, "two frames are alike");
    }

    // Both animations use one folder of frames, so another format and rate need no new frame.
    let json = turned(&folder, &["--animation", &apng]).json();
    assert_eq!(json["frames_found"], 4);
    let decoder = GifDecoder::new(BufReader::new(File::open(&gif).unwrap())).unwrap();
    let frames = decoder.into_frames().collect_frames().unwrap();
    assert!(frames.iter().all(|f| Duration::from(f.delay()) == Duration::from_millis(100)));
    let of_gif = rgb(frames);
    let decoder = PngDecoder::new(BufReader::new(File::open(&apng).unwrap())).unwrap();
    let frames = decoder.apng().unwrap().into_frames().collect_frames().unwrap();
    assert!(frames.iter().all(|f| Duration::from(f.delay()) == Duration::from_millis(40)));
    let of_apng = rgb(frames);
    assert_eq!(of_apng, kept, "an APNG has all colours");
    assert_eq!(of_gif.len(), 4);
    for (shown, kept) in of_gif.iter().zip(&kept) {
        let (mean, _) = difference(shown, kept);
        assert!(mean < 6.0, "{mean}");
    }
}

#[test]
fn a_run_that_was_broken_off_makes_what_is_missing() {
    let folder = Folder::new();
    let frames = folder.file("frames");
    let gif = folder.file("turn.gif");
    let found = |options: &[&str]| turned(&folder, options).json()["frames_found"].as_u64();
    let wish: &[&str] = &["--frames", &frames, "--animation", &gif];
    assert_eq!(found(wish), Some(0));
    fn all(folder: &Folder) -> Vec<Vec<u8>> {
        (1..=4).map(|n| std::fs::read(frame(folder, "frames", n)).unwrap()).collect()
    }
    let first = all(&folder);
    let animation = std::fs::read(&gif).unwrap();
    // One frame is missing, one is truncated, and one is a picture of other software.
    std::fs::remove_file(frame(&folder, "frames", 2)).unwrap();
    std::fs::write(frame(&folder, "frames", 3), &first[2][..first[2].len() - 9]).unwrap();
    RgbImage::new(5, 5).save(frame(&folder, "frames", 4)).unwrap();
    std::fs::remove_file(&gif).unwrap();
    assert_eq!(found(wish), Some(1));
    assert!(all(&folder) == first, "other frames than before");
    assert!(std::fs::read(&gif).unwrap() == animation, "another animation");
    // Frames that exist are not painted again.
    let painted_over = RgbImage::new(48, 36);
    painted_over.save(frame(&folder, "frames", 1)).unwrap();
    assert_eq!(found(wish), Some(4));
    assert_eq!(opened(frame(&folder, "frames", 1)), painted_over);
    let words = painted(&folder.pyramid(), &[&TURN[..], wish].concat());
    assert_eq!(words.out, "48 x 36 pixels on cpu, 4 frames (4 of them existed already)\n");

    // With any other option, all frames are painted again.
    for more in [
        &["--set", "flow.seed=2"][..],
        &["--camera", "31,20"],
        &["--height", "40"],
        &["--preset", "sketch"],
    ] {
        assert_eq!(found(&[wish, more].concat()), Some(0), "{more:?}");
        assert!(all(&folder) != first, "{more:?}: old frames");
    }
    assert_eq!(found(wish), Some(0));
    assert!(all(&folder) == first, "the first options again");
    assert_eq!(folder.names("frames").len(), 5, "a partial file remains");
}

#[test]
fn other_content_of_an_input_is_another_wish() {
    let folder = Folder::new();
    let frames = folder.file("frames");
    let scan = folder.mask();
    let set = format!("paper.scan={scan}");
    let mesh = folder.pyramid();
    let found = || {
        let options = ["--frames", &frames, "--set", &set, "--json"];
        painted(&mesh, &[&TURN[..], &options].concat()).json()["frames_found"].as_u64()
    };
    assert_eq!((found(), found()), (Some(0), Some(4)));
    RgbImage::from_fn(40, 40, |x, y| Rgb([(6 * (x ^ y)) as u8; 3])).save(&scan).unwrap();
    assert_eq!(found(), Some(0), "frames with the old paper");
    std::fs::write(&mesh, std::fs::read_to_string(&mesh).unwrap().replace("v 0 2 0", "v 0 3 0"))
        .unwrap();
    assert_eq!(found(), Some(0), "frames of the old mesh");
}

#[test]
fn noise_follows_the_mesh_unless_it_is_static() {
    let folder = Folder::new();
    // A ball of one colour, lit from the camera, looks the same from all sides. Only noise changes
    // between two frames.
    let look = ["--width", "64", "--turntable", "8", "--set", "flow.strength=3"];
    let mut first_frames = Vec::new();
    for (method, moves) in [("static", false), ("particles", true), ("features", true)] {
        let frames = folder.file(method);
        let set = format!("coherence.method={method}");
        painted("shape:sphere", &[&look[..], &["--set", &set, "--frames", &frames]].concat());
        let [one, next] = [1, 2].map(|n| opened(frame(&folder, method, n)));
        let (mean, _) = difference(&one, &next);
        assert!(if moves { mean > 2.0 } else { mean < 0.5 }, "{method}: {mean}");
        first_frames.push(one);
    }
    let (mean, _) = difference(&first_frames[1], &first_frames[2]);
    assert!(mean > 1.0, "both methods give the same noise");
}

#[test]
fn a_path_is_followed_from_a_file() {
    let folder = Folder::new();
    let mesh = folder.pyramid();
    let path = "frames = 3\n[[keyframe]]\neye = [0.0, 1.0, 8.0]\ntarget = [0.0, 1.0, 0.0]\n\
                [[keyframe]]\neye = [0.0, 1.0, 16.0]\ntarget = [0.0, 1.0, 0.0]\n";
    let camera = folder.write("path.toml", path);
    let frames = folder.file("frames");
    let options = ["--width", "48", "--camera", &camera, "--frames", &frames, "--json"];
    assert_eq!(painted(&mesh, &options).json()["frames"], 3);
    let seen = [1, 2, 3].map(|n: usize| {
        let picture = opened(frame(&folder, "frames", n));
        picture.pixels().filter(|pixel| pixel.0.iter().any(|value| *value < 200)).count()
    });
    assert!(seen[0] > 2 * seen[2] && seen[1] > seen[2] && seen[0] > seen[1], "{seen:?}");
}

#[test]
fn a_device_makes_the_frames_of_the_processor() {
    let Some(device) = suite::program::device() else { return };
    drop(device);
    let folder = Folder::new();
    let mesh = folder.pyramid();
    for method in ["particles", "features"] {
        let set = format!("coherence.method={method}");
        let [cpu, gpu] = ["cpu", "gpu"].map(|backend| {
            let frames = folder.file(&format!("{method}-{backend}"));
            let options = ["--set", &set, "--frames", &frames, "--backend", backend];
            let run = watercolor(&mesh, &[&TURN[..], &options].concat());
            assert_eq!(run.status, 0, "{}", run.err);
            opened(format!("{frames}/frame-0002.png"))
        });
        let (mean, most) = difference(&cpu, &gpu);
        assert!(most <= 2, "{method}: {most} of 255, {mean} in the mean");
    }
}
