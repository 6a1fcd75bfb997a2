//! Meshes: reading their files, normals, and checks.

mod files;
mod bad_files;
mod normals;

use graphics::mesh::{Mesh, MeshError};

/// Writes files of these names and contents, opens the first as a mesh and checks the mesh.
fn opened(files: &[(&str, &[u8])]) -> Result<Mesh, MeshError> {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in files {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    let opened = Mesh::open(&folder.path().join(files[0].0));
    if let Ok(mesh) = &opened {
        mesh.check().unwrap();
        let lengths = mesh.normals.iter().map(|n| n.iter().map(|v| v * v).sum::<f32>());
        assert!(lengths.into_iter().all(|length| (length - 1.0).abs() < 1e-5), "unit normals");
    }
    opened
}

/// A PNG of two texels, red and blue.
fn two_texels() -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let picture = image::RgbImage::from_raw(2, 1, vec![255, 0, 0, 0, 0, 255]).unwrap();
    picture.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// The glTF document `rest` with its version and with `buffer` declared as `data.bin`.
fn gltf(buffer: &[u8], mut rest: serde_json::Value) -> Vec<u8> {
    rest["asset"] = serde_json::json!({ "version": "2.0" });
    rest["buffers"] = serde_json::json!([{ "uri": "data.bin", "byteLength": buffer.len() }]);
    rest.to_string().into_bytes()
}

/// Positions of the corners of a square in the plane z = 0.
const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

/// The buffer of [`SQUARE`] for glTF: positions (48 bytes) and indices as u16 (12 bytes).
fn square_bytes() -> Vec<u8> {
    let corners: [u16; 6] = [0, 1, 2, 0, 2, 3];
    let places = SQUARE.iter().flatten().flat_map(|value| value.to_le_bytes());
    places.chain(corners.iter().flat_map(|corner| corner.to_le_bytes())).collect()
}

/// A glTF document with one node of [`SQUARE`].
fn square_document() -> serde_json::Value {
    serde_json::json!({
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 12 }
        ],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
              "min": [0, 0, 0], "max": [1, 1, 0] },
            { "bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR" }
        ],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "nodes": [{ "mesh": 0 }],
        "scenes": [{ "nodes": [0] }],
        "scene": 0
    })
}
