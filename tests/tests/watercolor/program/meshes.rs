//! `impasto watercolor` of meshes: file formats, shapes, cameras, stages, and the GPU.

use image::{Rgb, RgbImage};

use super::{CORNERS, Folder, SIDES, decoded, difference, opened, painted, picture, watercolor};

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
    let number = |value: usize| (value as u32).to_le_bytes();
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

/// Number of painted pixels: those with a channel below 200.
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
    let Some(device) = suite::adapter::device() else { return };
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
        let far = |(a, b): &(&Rgb<u8>, &Rgb<u8>)| (0..3).any(|i| a.0[i].abs_diff(b.0[i]) > 2);
        let far = pairs.filter(far).count();
        // At an edge between two triangles CPU and GPU may choose different ones.
        assert!(far <= 19 && mean < 0.02, "{mesh}: {far} pixels, {mean} in the mean");
    }
}
