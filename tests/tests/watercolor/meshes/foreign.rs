//! Models from anyone: far from the origin, without an extent, with files elsewhere.

use base64::Engine;
use documents::file::{NamedFileError, Outside};
use documents::hint::Explain;
use graphics::mesh::{Mesh, MeshError, ModelFile};
use serde_json::json;

use super::{
    POSITIONS, gltf, opened, pictured, refused, square_bytes, square_document, two_texels,
};

/// A pyramid over a square, as OBJ, PLY with double numbers, or glTF with a translated node. All
/// positions are moved by `offset`.
fn moved_pyramid(ending: &str, offset: [f64; 3]) -> Vec<u8> {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.25]];
    let corners = [&corners[..], &[[0.5, 0.5, 1.0]]].concat();
    let faces = [[0, 1, 2], [0, 2, 3], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
    let moved = corners.iter().map(|at| [0, 1, 2].map(|axis| at[axis] + offset[axis]));
    match ending {
        "obj" => {
            let places = moved.map(|[x, y, z]| format!("v {x} {y} {z}\n"));
            let faces = faces.map(|face| {
                let [a, b, c] = face.map(|corner| corner + 1);
                format!("f {a} {b} {c}\n")
            });
            (places.collect::<String>() + &faces.concat()).into_bytes()
        }
        "ply" => {
            let header = "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\n\
                          property double y\nproperty double z\nelement face 6\n\
                          property list uchar int vertex_index\nend_header\n";
            let places = moved.map(|[x, y, z]| format!("{x} {y} {z}\n"));
            let faces = faces.map(|[a, b, c]| format!("3 {a} {b} {c}\n"));
            (header.to_owned() + &places.collect::<String>() + &faces.concat()).into_bytes()
        }
        _ => {
            let places = corners.iter().flatten().flat_map(|&value| (value as f32).to_le_bytes());
            let faces = faces.iter().flatten().map(|corner| *corner as u8);
            let bytes: Vec<u8> = places.chain(faces).collect();
            let coded = base64::engine::general_purpose::STANDARD.encode(&bytes);
            json!({
                "asset": { "version": "2.0" },
                "buffers": [{ "byteLength": bytes.len(),
                    "uri": format!("data:application/octet-stream;base64,{coded}") }],
                "bufferViews": [{ "buffer": 0, "byteLength": 60 },
                    { "buffer": 0, "byteOffset": 60, "byteLength": 18 }],
                "accessors": [
                    { "bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3" },
                    { "bufferView": 1, "componentType": 5121, "count": 18, "type": "SCALAR" }],
                "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
                "nodes": [{ "mesh": 0, "translation": offset }]
            })
            .to_string()
            .into_bytes()
        }
    }
}

#[test]
fn models_far_from_the_origin_are_moved_to_it() {
    for ending in ["obj", "ply", "gltf"] {
        let name = format!("a.{ending}");
        let at_origin = opened(&[(&name, &moved_pyramid(ending, [0.0; 3]))]).unwrap();
        for far in [1e5, 5e5, 1e6, 1e7, 1e8, 1e12] {
            for offset in [[far, 0.0, 0.0], [0.0, -far, 0.0], [far, far / 2.0, -far]] {
                let bytes = moved_pyramid(ending, offset);
                let folder = tempfile::tempdir().unwrap();
                let path = folder.path().join(&name);
                std::fs::write(&path, bytes).unwrap();
                let file = ModelFile::open(&path, Outside::Refused).unwrap();
                assert_eq!(file.origin, offset, "{name}");
                assert!(file.mesh == at_origin, "{name} at {offset:?}");
            }
        }
        // Nearer models stay where they are, to the bit.
        let near = opened(&[(&name, &moved_pyramid(ending, [10.0, 0.0, 0.0]))]).unwrap();
        assert_eq!(near.positions[0], [10.0, 0.0, 0.0]);
        for (offset, words) in [(1e16, "1e16 units from the origin"), (1e30, "1e30 units from")] {
            let bytes = moved_pyramid(ending, [offset, 0.0, 0.0]);
            refused(&[(&name, &bytes)], &[words, "tell only places"]);
        }
    }
}

#[test]
fn meshes_without_an_extent_are_refused() {
    for (text, words) in [
        ("v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n", "all 3 vertices of the mesh lie at one point"),
        ("v 0 0 0\nv 1e-30 0 0\nv 0 1e-30 0\nf 1 2 3\n", "the mesh is 1e-30 units wide"),
        ("v 0 0 0\nv 1e30 0 0\nv 0 1e30 0\nf 1 2 3\n", "the mesh is 1e30 units wide"),
        ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "no triangle of the mesh has an area"),
        ("v 1e30 0 0\nv 1e30 1 0\nv 1e30 0 1\nf 1 2 3\n", "1e30 units from the origin"),
    ] {
        refused(&[("a.obj", text.as_bytes())], &[words]);
    }
    // The 32-bit numbers of this file are one unit apart, as far as the model is wide.
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
               property float z\nelement face 1\nproperty list uchar int vertex_index\n\
               end_header\n1e7 0 0\n10000001 0 0\n1e7 1 0\n3 0 1 2\n";
    refused(&[("a.ply", ply.as_bytes())], &["tell only places"]);
    let elements = ply.replace("element face", "element nothing 9999999999\nelement face");
    refused(&[("a.ply", elements.as_bytes())], &["element `nothing`", "no properties"]);
}

#[cfg(unix)]
#[test]
fn a_model_names_only_regular_files_of_its_folder() {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("inner");
    std::fs::create_dir(&inner).unwrap();
    for path in [folder.path().join("far.mtl"), inner.join("near.mtl")] {
        std::fs::write(path, "newmtl red\nKd 1 0 0\n").unwrap();
    }
    std::fs::write(folder.path().join("far.png"), two_texels()).unwrap();
    std::fs::write(folder.path().join("far.bin"), square_bytes()).unwrap();
    std::os::unix::fs::symlink("../far.mtl", inner.join("link.mtl")).unwrap();
    fn obj(library: &str) -> String {
        format!("mtllib {library}\n{POSITIONS}usemtl red\nf 1 2 3\n")
    }
    fn buffers(uri: &str) -> String {
        let text = String::from_utf8(gltf(&square_bytes(), square_document())).unwrap();
        text.replace("data.bin", uri)
    }
    fn images(uri: &str) -> String {
        let document = pictured(&json!({ "uri": uri }));
        let text = String::from_utf8(gltf(&square_bytes(), document)).unwrap();
        text.replace("data.bin", "near.bin")
    }
    std::fs::write(inner.join("near.bin"), square_bytes()).unwrap();
    let textured = inner.join("textured.mtl");
    std::fs::write(&textured, "newmtl red\nmap_Kd ../far.png\n").unwrap();
    let far_bin = folder.path().join("far.bin").display().to_string();
    // Name and content of a model, and the place that names a file outside.
    for (name, text, place) in [
        ("a.obj", obj("../far.mtl"), "mtllib `../far.mtl`"),
        ("a.obj", obj("link.mtl"), "mtllib `link.mtl`"),
        ("a.obj", obj("textured.mtl"), "map_Kd of the material `red` `../far.png`"),
        ("a.gltf", buffers("../far.bin"), "buffers[0].uri `../far.bin`"),
        ("a.gltf", buffers("..%2Ffar.bin"), "buffers[0].uri `../far.bin`"),
        ("a.gltf", buffers(&far_bin), "buffers[0].uri"),
        ("a.gltf", buffers(&format!("file://{far_bin}")), "buffers[0].uri"),
        ("a.gltf", images("../far.png"), "images[0].uri `../far.png`"),
    ] {
        let path = inner.join(name);
        std::fs::write(&path, text).unwrap();
        let error = Mesh::open(&path).unwrap_err();
        let message = error.to_string();
        assert!(message.contains(place) && message.contains("lies outside"), "{message}");
        assert!(matches!(error, MeshError::Named(NamedFileError::Outside { .. })), "{message}");
        assert!(error.hint().unwrap().to_string().contains("`allow_outside`"));
        let file = ModelFile::open(&path, Outside::Allowed).unwrap();
        assert!(!file.files.is_empty());
    }
    let path = inner.join("a.obj");
    std::fs::write(&path, obj("near.mtl")).unwrap();
    let file = ModelFile::open(&path, Outside::Refused).unwrap();
    assert_eq!(file.files, [inner.join("near.mtl")]);
    // Devices and pipes are not even opened: they may have no end.
    let pipe = inner.join("pipe");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    for (name, text) in [
        ("a.obj", obj("/dev/zero")),
        ("a.obj", obj("pipe")),
        ("a.gltf", buffers("/dev/zero")),
        ("a.gltf", buffers("pipe")),
        ("a.gltf", buffers(".")),
    ] {
        std::fs::write(inner.join(name), text).unwrap();
        for outside in [Outside::Refused, Outside::Allowed] {
            let error = ModelFile::open(&inner.join(name), outside).unwrap_err();
            assert!(error.to_string().ends_with("is not a regular file"), "{error}");
        }
    }
}
