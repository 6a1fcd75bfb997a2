//! Meshes: read from OBJ, PLY and glTF with geometry, materials, textures and transforms. Invalid
//! files give errors with the location, the reason and a hint.

mod foreign;
mod shapes;

use base64::Engine;
use documents::hint::Explain;
use graphics::mesh::{Material, Mesh, MeshError};
use serde_json::json;

/// Writes these files, opens the first one as a mesh and checks it.
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

fn two_texels() -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let picture = image::RgbImage::from_raw(2, 1, vec![255, 0, 0, 0, 0, 255]).unwrap();
    picture.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// The glTF document `rest` with its version. Declares `buffer` as `data.bin`.
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

fn corners(mesh: &Mesh) -> Vec<[[f32; 3]; 3]> {
    mesh.triangles
        .iter()
        .map(|triangle| triangle.corners.map(|corner: u32| mesh.positions[corner as usize]))
        .collect()
}

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
    fn header(format: &str) -> Vec<u8> {
        format!(
            "ply\nformat {format} 1.0\ncomment a square\nelement vertex 4\nproperty float x\n\
             property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n\
             property uchar blue\nelement thing 1\nproperty list uchar short of\n\
             element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        )
        .into_bytes()
    }
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
    // The parent translates. The child mirrors and stretches along x.
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
    // A mirrored triangle has two corners swapped, so that they run counter-clockwise.
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
        // These are the indices 0 1 2 0 2 3. A strip and a fan of them have four triangles.
        assert_eq!(mesh.triangles.len(), wanted, "mode {mode}");
        assert_eq!(corners(&mesh)[0], square()[0], "mode {mode}");
        if mode == 4 {
            assert_eq!(corners(&mesh), square());
        }
    }
}

/// Asserts that the first file is refused with a hint and a message of one line with its name and
/// all of `wanted`.
#[track_caller]
fn refused(files: &[(&str, &[u8])], wanted: &[&str]) {
    let error = opened(files).unwrap_err();
    let message = error.to_string();
    for words in wanted.iter().chain(&[files[0].0]) {
        assert!(message.contains(words), "no `{words}` in: {message}");
    }
    assert!(!message.contains('\n') && error.hint().is_some(), "{message}");
}

const POSITIONS: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

#[test]
fn obj_files() {
    for (rest, wanted) in [
        ("f 1 2 4", &["line 4", "no position `4`, there are 3"][..]),
        ("f 1 2 0", &["line 4", "no position `0`"]),
        ("f 1 2 -4", &["line 4", "no position `-4`"]),
        ("f 1 2", &["line 4", "2 corners"]),
        ("f 1 2 x", &["line 4", "`x`"]),
        ("f 1/1 2/1 3/1", &["line 4", "no texture coordinate `1`, there are 0"]),
        ("f 1//1 2//1 3//1", &["line 4", "no normal `1`"]),
        ("f 1/1/1/1 2 3", &["line 4", "`1/1/1/1`"]),
        ("f 1 2 99999999999999999999", &["line 4", "99999"]),
        ("v nan 0 0\nf 1 2 3", &["line 4", "`nan`"]),
        ("v 1e99 0 0\nf 1 2 3", &["line 4", "`1e99`"]),
        ("v 0 0\nf 1 2 3", &["line 4", "2 numbers"]),
        ("v 0 0 0 0\nf 1 2 3", &["line 4", "divided by 0"]),
        ("v 0 0 0 1 0 0\nf 1 2 3", &["line 4", "colours"]),
        ("vn 0 1\nf 1 2 3", &["line 4", "`vn 0 1`"]),
        ("vt 0\nf 1 2 3", &["line 4", "`vt 0`"]),
        ("usemtl\nf 1 2 3", &["line 4", "usemtl"]),
        ("", &["no triangle"]),
        ("l 1 2\np 1", &["no triangle"]),
    ] {
        refused(&[("a.obj", format!("{POSITIONS}{rest}\n").as_bytes())], wanted);
    }
    refused(&[("a.obj", b"")], &["no triangle"]);
    refused(&[("a.obj", b"\xff\xfe\0\x01garbage")], &["no triangle"]);
}

#[test]
fn materials_and_textures_of_obj_files() {
    let obj = format!("mtllib a.mtl\n{POSITIONS}usemtl red\nf 1 2 3\n").into_bytes();
    let error = opened(&[("a.obj", &obj)]).unwrap_err();
    assert!(error.to_string().ends_with("a.obj: mtllib `a.mtl`: cannot be read"), "{error}");
    for (mtl, wanted) in [
        ("newmtl red\nKd 1 0\n", "a.mtl: line 2: no colour of 3 numbers: `Kd 1 0`"),
        ("newmtl red\nKd spectral x.rfl\n", "a.mtl: line 2: not a finite number: `spectral`"),
        ("newmtl red\nd x\n", "a.mtl: materials"),
        ("newmtl blue\nKd 0 0 1\n", "a.obj: line 5: no material `red`"),
        (
            "newmtl red\nmap_Kd no.png\n",
            "a.obj: map_Kd of the material `red` `no.png`: cannot be read",
        ),
        ("newmtl red\nmap_Kd a.mtl\n", "the texture `a.mtl`"),
    ] {
        let error = opened(&[("a.obj", &obj), ("a.mtl", mtl.as_bytes())]).unwrap_err();
        let message = error.to_string();
        assert!(message.contains(wanted), "no `{wanted}` in: {message}");
    }
}

#[test]
fn ply_files() {
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                  property float z\nelement face 1\nproperty list uchar int vertex_index\n\
                  end_header\n";
    for (rest, wanted) in [
        ("3 0 1 3\n", &["triangle 0 has vertex 3, of 3"][..]),
        ("3 0 1 -1\n", &["triangle 0 has vertex 4294967295"]),
        ("2 0 1\n", &["no triangle"]),
        ("3 0 1\n", &["line 13"]),
        ("3 0 1 x\n", &["line 13", "x"]),
        ("", &["line 13", "end of file"]),
    ] {
        let text = format!("{header}0 0 0\n1 0 0\n0 1 0\n{rest}");
        refused(&[("a.ply", text.as_bytes())], wanted);
    }
    let mut endless = header.replace("ascii", "binary_little_endian").into_bytes();
    for value in [0.0f32, 0.0, 0.0, 1.0, f32::INFINITY, 0.0, 0.0, 1.0, 0.0] {
        endless.extend(value.to_le_bytes());
    }
    endless.extend([3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]);
    refused(&[("a.ply", &endless)], &["vertex 1", "position", "inf"]);
    refused(&[("a.ply", &endless[..endless.len() - 2])], &["element `face`"]);
    let short = format!("{header}0 0 0\n1 0\n0 1 0\n3 0 1 2\n");
    refused(&[("a.ply", short.as_bytes())], &["line 11"]);
    refused(&[("a.ply", b"")], &["header"]);
    refused(&[("a.ply", b"ply\nformat ascii 1.0\nend_header\n")], &["`vertex`", "`x`"]);
    let binary =
        header.replace("ascii", "binary_little_endian").replace("vertex 3", "vertex 4000000000");
    refused(&[("a.ply", binary.as_bytes())], &["element `vertex`"]);
}

#[test]
fn gltf_files() {
    let buffer = square_bytes();
    let with = |change: &dyn Fn(&mut serde_json::Value)| {
        let mut document = square_document();
        change(&mut document);
        gltf(&buffer, document)
    };
    type Change = Box<dyn Fn(&mut serde_json::Value)>;
    let cases: Vec<(Change, &[&str])> = vec![
        (Box::new(|d| d["accessors"][0]["count"] = json!(5)), &["accessors[0] with 5 values ends"]),
        (
            Box::new(|d| d["accessors"][0]["count"] = json!(0)),
            &["primitives[0]: POSITION: accessors[0] has no values"],
        ),
        (Box::new(|d| d["accessors"][0]["count"] = json!(1u64 << 62)), &["accessors[0]"]),
        (
            Box::new(|d| d["accessors"][0]["type"] = json!("VEC4")),
            &["POSITION", "in VEC4, not FLOAT in VEC3"],
        ),
        (
            Box::new(|d| d["accessors"][0]["componentType"] = json!(5121)),
            &["POSITION", "componentType 5121"],
        ),
        (
            Box::new(|d| d["accessors"][1]["componentType"] = json!(5126)),
            &["indices", "componentType 5126"],
        ),
        (
            Box::new(|d| d["accessors"][0]["bufferView"] = json!(null)),
            &["accessors[0] has no bufferView"],
        ),
        (Box::new(|d| d["accessors"][0]["sparse"] = json!({})), &["sparse values"]),
        (Box::new(|d| d["accessors"] = json!([])), &["accessors[0] does not exist"]),
        (Box::new(|d| d["bufferViews"][0]["buffer"] = json!(4)), &["buffers[4] does not exist"]),
        (Box::new(|d| d["bufferViews"][0]["byteStride"] = json!(0)), &["byteStride of 0, not 12"]),
        (Box::new(|d| d["nodes"][0]["children"] = json!([7])), &["nodes[7] does not exist"]),
        (Box::new(|d| d["scenes"][0]["nodes"] = json!([7])), &["nodes[7] does not exist"]),
        (Box::new(|d| d["scene"] = json!(7)), &["scene: scenes[7] does not exist"]),
        (Box::new(|d| d["nodes"][0]["mesh"] = json!(7)), &["nodes[0]: meshes[7] does not exist"]),
        (
            Box::new(|d| d["meshes"][0]["primitives"][0]["material"] = json!(7)),
            &["materials[7] does not exist"],
        ),
        (Box::new(|d| d["meshes"][0]["primitives"][0]["mode"] = json!(7)), &["mode 7"]),
        (
            Box::new(|d| d["meshes"][0]["primitives"][0]["attributes"] = json!({})),
            &["meshes[0].primitives[0]: it has no POSITION"],
        ),
        (
            Box::new(|d| {
                d["materials"] = json!([{ "pbrMetallicRoughness": {
                    "baseColorTexture": { "index": 0 } } }]);
            }),
            &["materials[0]: textures[0] does not exist"],
        ),
        (
            Box::new(|d| d["nodes"][0]["translation"] = json!([1e30, 0, 0])),
            &["1e30 units from the origin"],
        ),
        (Box::new(|d| d["nodes"][0]["scale"] = json!([0, 0, 0])), &["at one point"]),
        (Box::new(|d| d["nodes"][0]["scale"] = json!([1e-30, 1, 0])), &["no triangle", "area"]),
        (Box::new(|d| d["nodes"][0]["scale"] = json!([1e300, 1e300, 1e300])), &["units wide"]),
        (
            Box::new(|d| d["accessors"][0]["bufferView"] = json!(9)),
            &["bufferViews[9] does not exist"],
        ),
        (
            Box::new(|d| d["bufferViews"][0]["byteOffset"] = json!(40)),
            &["bufferViews[0] ends after buffers[0]"],
        ),
        (Box::new(|d| d["bufferViews"][0]["byteOffset"] = json!(u64::MAX)), &["bufferViews[0]"]),
        (Box::new(|d| d["accessors"][0]["count"] = json!(2)), &["it has vertex 2, of 2"]),
        (Box::new(|d| d["meshes"][0]["primitives"][0]["mode"] = json!(1)), &["no triangle"]),
        (Box::new(|d| d["nodes"][0]["children"] = json!([0])), &["nodes[0]", "two parents"]),
        (Box::new(|d| d["scenes"][0]["nodes"] = json!([])), &["no triangle"]),
        (
            Box::new(|d| d["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(1)),
            &["NORMAL"],
        ),
        (
            Box::new(|d| {
                d["materials"] = json!([{ "pbrMetallicRoughness": {
                    "baseColorTexture": { "index": 0 } } }]);
                d["textures"] = json!([{ "source": 0 }]);
                d["images"] = json!([{ "uri": "no%20such.png" }]);
            }),
            &["images[0].uri `no such.png`: cannot be read"],
        ),
    ];
    for (change, wanted) in &cases {
        refused(&[("a.gltf", &with(&**change)), ("data.bin", &buffer)], wanted);
    }
    let whole = with(&|_| {});
    refused(&[("a.gltf", &whole)], &["buffers[0].uri `data.bin`: cannot be read"]);
    refused(&[("a.gltf", &whole), ("data.bin", &buffer[..40])], &["buffers[0]", "40 of 60 bytes"]);
    let odd = String::from_utf8(whole.clone()).unwrap().replace("data.bin", "%ff");
    refused(&[("a.gltf", odd.as_bytes())], &["buffers[0]", "%ff"]);
    refused(&[("a.glb", b"glTF\x02\0\0\0\xff\xff\xff\x7f")], &["the document"]);
    refused(&[("a.gltf", b"{")], &["the document"]);
    assert!(opened(&[("a.gltf", &whole), ("data.bin", &buffer)]).is_ok());
}

/// The square with one material, which shows the picture of `image`.
fn pictured(image: &serde_json::Value) -> serde_json::Value {
    let mut document = square_document();
    document["meshes"][0]["primitives"][0]["material"] = json!(0);
    document["materials"] =
        json!([{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
    document["textures"] = json!([{ "source": 0 }]);
    document["images"] = json!([image]);
    document
}

#[test]
fn pictures_of_gltf_files_lie_in_the_buffer_or_in_the_document() {
    let mut buffer = square_bytes();
    let picture = two_texels();
    buffer.extend(&picture);
    let view = json!({ "buffer": 0, "byteOffset": 60, "byteLength": picture.len() });
    let coded = base64::engine::general_purpose::STANDARD.encode(&picture);
    let data = format!("data:image/png;base64,{coded}");
    // The kind of a picture is clear from its content: `mimeType` may be missing.
    for image in [
        json!({ "bufferView": 2 }),
        json!({ "bufferView": 2, "mimeType": "image/png" }),
        json!({ "uri": data }),
    ] {
        let mut document = pictured(&image);
        document["bufferViews"].as_array_mut().unwrap().push(view.clone());
        let files: [(&str, &[u8]); 2] =
            [("a.gltf", &gltf(&buffer, document)), ("data.bin", &buffer)];
        let mesh = opened(&files).unwrap();
        let texture = mesh.materials[0].texture.as_ref().unwrap();
        assert_eq!(texture.texels.map_bytes(), [[255, 0, 0, 255], [0, 0, 255, 255]]);
    }
    for (image, words) in [
        (json!({}), "images[0]: it has neither a uri nor a bufferView"),
        (json!({ "bufferView": 9 }), "images[0]: bufferViews[9] does not exist"),
        (json!({ "uri": "https://example.org/a.png" }), "nothing is loaded from a network"),
        (json!({ "uri": "data:image/png;base64,AAAA" }), "the texture `images[0]`"),
        (json!({ "uri": "data:image/png,abc" }), "images[0].uri: a data URI that is not in base64"),
    ] {
        let files: [(&str, &[u8]); 2] =
            [("a.gltf", &gltf(&buffer, pictured(&image))), ("data.bin", &buffer)];
        refused(&files, &[words]);
    }
    let mut document = pictured(&json!({}));
    document["textures"] = json!([{}]);
    let files: [(&str, &[u8]); 2] = [("a.gltf", &gltf(&buffer, document)), ("data.bin", &buffer)];
    refused(&files, &["materials[0]: textures[0] has no source"]);
}

#[test]
fn names_and_paths() {
    refused(&[("a.stl", b"solid")], &["`stl`"]);
    refused(&[("model", b"")], &["``"]);
    let error = Mesh::open(std::path::Path::new("no/such/model.obj")).unwrap_err();
    assert!(error.to_string().contains("no/such/model.obj"), "{error}");
}
