//! Reading meshes from OBJ, PLY and glTF: geometry, materials, textures and transforms.

use graphics::mesh::{Material, Mesh};
use serde_json::json;

use super::{SQUARE, gltf, opened, square_bytes, square_document, two_texels};

/// Positions of the corners of every triangle.
fn corners(mesh: &Mesh) -> Vec<[[f32; 3]; 3]> {
    mesh.triangles
        .iter()
        .map(|triangle| triangle.corners.map(|corner: u32| mesh.positions[corner as usize]))
        .collect()
}

/// The two triangles of the square.
fn square() -> Vec<[[f32; 3]; 3]> {
    let [a, b, c, d] = SQUARE;
    vec![[a, b, c], [a, c, d]]
}

#[test]
fn obj_with_materials_textures_and_groups() {
    let obj = b"# a square\r
mtllib my colours.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0.25 1
vt 0.75 0
vt 1 0.5
vn 0 0 2
o left
usemtl wood
f 1/1/1 2/2/1 3/3/1 4/3/1
l 1 2
o right
usemtl plain one
f -4 -3 -2
";
    let mtl = b"newmtl wood\nKd 1 0.5 0.25\nmap_Kd -s 1 1 1 two texels.png\nnewmtl plain one\nKd 0.1 0.2 0.3\n";
    let files: [(&str, &[u8]); 3] =
        [("a.obj", obj), ("my colours.mtl", mtl), ("two texels.png", &two_texels())];
    let mesh = opened(&files).unwrap();
    let [a, b, c, _] = SQUARE;
    assert_eq!(corners(&mesh), [&square()[..], &[[a, b, c]]].concat());
    let materials: Vec<u32> = mesh.triangles.iter().map(|triangle| triangle.material).collect();
    assert_eq!(materials, [0, 0, 1]);
    assert_eq!(mesh.materials[1], Material::named("plain one", [0.1, 0.2, 0.3]));
    let texture = mesh.materials[0].texture.as_ref().unwrap();
    assert_eq!((texture.width, texture.height), (2, 1));
    assert_eq!(texture.texels.map_bytes(), [[255, 0, 0, 255], [0, 0, 255, 255]]);
    // The vertical texture coordinate runs upwards in the file and downwards in `Mesh`.
    assert_eq!(mesh.texture_coordinates[..3], [[0.25, 0.0], [0.75, 1.0], [1.0, 0.5]]);
    assert!(mesh.normals.iter().all(|normal| *normal == [0.0, 0.0, 1.0]), "{:?}", mesh.normals);
}

trait Bytes {
    fn map_bytes(&self) -> Vec<[u8; 4]>;
}

impl Bytes for Vec<u32> {
    fn map_bytes(&self) -> Vec<[u8; 4]> {
        self.iter().map(|texel| texel.to_le_bytes()).collect()
    }
}

#[test]
fn obj_with_colors_of_vertices_and_nothing_else() {
    let obj = b"v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 2\nf 1 2 3\n";
    let mesh = opened(&[("a.OBJ", obj)]).unwrap();
    assert_eq!(mesh.colors, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    assert_eq!(mesh.normals, [[0.0, 0.0, 1.0]; 3]);
    assert_eq!(mesh.materials, [Material::plain([1.0; 3])]);
    // A fourth coordinate divides the position.
    let mesh = opened(&[("a.obj", b"v 0 0 0\nv 2 0 0 2\nv 0 1 0\nf 1 2 3\n")]).unwrap();
    assert_eq!(mesh.positions[1], [1.0, 0.0, 0.0]);
}

#[test]
fn ply_as_text_and_in_both_binaries() {
    let header = |format: &str| {
        format!(
            "ply\nformat {format} 1.0\ncomment a square\nelement vertex 4\nproperty float x\n\
             property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n\
             property uchar blue\nelement thing 1\nproperty list uchar short of\n\
             element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        )
        .into_bytes()
    };
    let mut text = header("ascii");
    let [mut low, mut high] = ["binary_little_endian", "binary_big_endian"].map(header);
    for ([x, y, z], red) in SQUARE.iter().zip([0u8, 51, 102, 255]) {
        text.extend(format!("{x} {y} {z} {red} 0 255\n").into_bytes());
        for value in [x, y, z] {
            low.extend(value.to_le_bytes());
            high.extend(value.to_be_bytes());
        }
        low.extend([red, 0, 255]);
        high.extend([red, 0, 255]);
    }
    text.extend(b"2 7 8\n4 0 1 2 3\n");
    low.extend([2, 7, 0, 8, 0, 4, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0]);
    high.extend([2, 0, 7, 0, 8, 4, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3]);
    for content in [text, low, high] {
        let mesh = opened(&[("a.ply", &content)]).unwrap();
        assert_eq!(corners(&mesh), square());
        assert_eq!(mesh.colors[1], [0.2, 0.0, 1.0]);
        assert_eq!(mesh.materials, [Material::plain([1.0; 3])]);
        assert_eq!(mesh.normals, [[0.0, 0.0, 1.0]; 4]);
    }
}

#[test]
fn gltf_with_transforms_materials_and_textures() {
    let mut document = square_document();
    // The parent translates; the child mirrors and stretches along x.
    document["nodes"] = json!([
        { "translation": [10, 0, 0], "children": [1] },
        { "mesh": 0, "scale": [-2, 1, 1] },
        { "mesh": 0, "translation": [0, 0, 99] }
    ]);
    document["meshes"][0]["primitives"][0]["material"] = json!(0);
    document["materials"] = json!([{ "name": "painted", "pbrMetallicRoughness": {
        "baseColorFactor": [0.21404114, 1, 0, 1], "baseColorTexture": { "index": 0 } } }]);
    document["textures"] = json!([{ "source": 0 }]);
    document["images"] = json!([{ "uri": "two%20texels.png" }]);
    let buffer = square_bytes();
    let files: [(&str, &[u8]); 3] = [
        ("a.gltf", &gltf(&buffer, document)),
        ("data.bin", &buffer),
        ("two texels.png", &two_texels()),
    ];
    let mesh = opened(&files).unwrap();
    let [a, b, c, d] = SQUARE.map(|[x, y, z]: [f32; 3]| [10.0 - 2.0 * x, y, z]);
    // A mirrored triangle has two corners swapped, so that it runs counter-clockwise.
    assert_eq!(corners(&mesh), [[a, c, b], [a, d, c]]);
    assert!(mesh.normals.iter().all(|normal| *normal == [0.0, 0.0, 1.0]), "{:?}", mesh.normals);
    let Material { name, color: [r, g, b], texture } = &mesh.materials[0];
    assert_eq!(name, "painted");
    assert!((r - 0.5).abs() < 1e-4 && *g > 0.9999 && *b < 1e-6, "{r} {g} {b}");
    assert_eq!(texture.as_ref().unwrap().texels.map_bytes()[1], [0, 0, 255, 255]);
}

#[test]
fn binary_gltf_and_strips_and_fans() {
    let buffer = square_bytes();
    for (mode, wanted) in [(4, 2), (5, 4), (6, 4)] {
        let mut document = square_document();
        document["meshes"][0]["primitives"][0]["mode"] = json!(mode);
        document["asset"] = json!({ "version": "2.0" });
        document["buffers"] = json!([{ "byteLength": buffer.len() }]);
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut glb = b"glTF\x02\0\0\0".to_vec();
        glb.extend(((12 + 8 + text.len() + 8 + buffer.len()) as u32).to_le_bytes());
        glb.extend((text.len() as u32).to_le_bytes());
        glb.extend(b"JSON");
        glb.extend(&text);
        glb.extend((buffer.len() as u32).to_le_bytes());
        glb.extend(b"BIN\0");
        glb.extend(&buffer);
        let mesh = opened(&[("a.glb", &glb)]).unwrap();
        // Of the indices 0 1 2 0 2 3; a strip and a fan of them have four triangles.
        assert_eq!(mesh.triangles.len(), wanted, "mode {mode}");
        assert_eq!(corners(&mesh)[0], square()[0], "mode {mode}");
        if mode == 4 {
            assert_eq!(corners(&mesh), square());
        }
    }
}
