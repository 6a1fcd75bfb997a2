//! Invalid mesh files: errors with the location, the reason and a hint.

use documents::hint::Explain;
use graphics::mesh::{Mesh, MeshError};
use serde_json::json;

use super::{gltf, opened, square_bytes, square_document};

/// Asserts that the first file is refused with a hint and a message of one line that names the file
/// and contains all of `wanted`.
#[track_caller]
fn refused(files: &[(&str, &[u8])], wanted: &[&str]) {
    let error = opened(files).unwrap_err();
    let told = error.to_string();
    for words in wanted.iter().chain(&[files[0].0]) {
        assert!(told.contains(words), "no `{words}` in: {told}");
    }
    assert!(!told.contains('\n') && error.hint().is_some(), "{told}");
}

const POSITIONS: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

#[test]
fn obj_files() {
    let with = |rest: &str| format!("{POSITIONS}{rest}\n").into_bytes();
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
        refused(&[("a.obj", &with(rest))], wanted);
    }
    refused(&[("a.obj", b"")], &["no triangle"]);
    refused(&[("a.obj", b"\xff\xfe\0\x01garbage")], &["no triangle"]);
}

#[test]
fn materials_and_textures_of_obj_files() {
    let obj = format!("mtllib a.mtl\n{POSITIONS}usemtl red\nf 1 2 3\n").into_bytes();
    let error = opened(&[("a.obj", &obj)]).unwrap_err();
    assert!(matches!(&error, MeshError::Unreadable { name, .. } if name.ends_with("a.mtl")));
    let with = |mtl: &str| opened(&[("a.obj", &obj), ("a.mtl", mtl.as_bytes())]).unwrap_err();
    for (mtl, wanted) in [
        ("newmtl red\nKd 1 0\n", "a.mtl: line 2: no colour of 3 numbers: `Kd 1 0`"),
        ("newmtl red\nKd spectral x.rfl\n", "a.mtl: line 2: not a finite number: `spectral`"),
        ("newmtl red\nd x\n", "a.mtl: materials"),
        ("newmtl blue\nKd 0 0 1\n", "a.obj: line 5: no material `red`"),
        ("newmtl red\nmap_Kd no.png\n", "the texture `no.png`"),
        ("newmtl red\nmap_Kd a.mtl\n", "the texture `a.mtl`"),
    ] {
        let told = with(mtl).to_string();
        assert!(told.contains(wanted), "no `{wanted}` in: {told}");
    }
}

#[test]
fn ply_files() {
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                  property float z\nelement face 1\nproperty list uchar int vertex_index\n\
                  end_header\n";
    let with = |rest: &str| format!("{header}{rest}").into_bytes();
    let places = "0 0 0\n1 0 0\n0 1 0\n";
    for (rest, wanted) in [
        ("3 0 1 3\n", &["triangle 0 has vertex 3, of 3"][..]),
        ("3 0 1 -1\n", &["triangle 0 has vertex 4294967295"]),
        ("2 0 1\n", &["no triangle"]),
        ("3 0 1\n", &["line 13"]),
        ("3 0 1 x\n", &["line 13", "x"]),
        ("", &["line 13", "end of file"]),
    ] {
        refused(&[("a.ply", &with(&format!("{places}{rest}")))], wanted);
    }
    let mut endless = header.replace("ascii", "binary_little_endian").into_bytes();
    for value in [0.0f32, 0.0, 0.0, 1.0, f32::INFINITY, 0.0, 0.0, 1.0, 0.0] {
        endless.extend(value.to_le_bytes());
    }
    endless.extend([3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]);
    refused(&[("a.ply", &endless)], &["vertex 1", "position", "inf"]);
    refused(&[("a.ply", &endless[..endless.len() - 2])], &["element `face`"]);
    refused(&[("a.ply", &with("0 0 0\n1 0\n0 1 0\n3 0 1 2\n"))], &["line 11"]);
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
        (Box::new(|d| d["accessors"][0]["count"] = json!(5)), &["accessor 0", "5 values"]),
        (Box::new(|d| d["accessors"][0]["count"] = json!(0)), &["no values"]),
        (Box::new(|d| d["accessors"][0]["count"] = json!(1u64 << 62)), &["accessor 0"]),
        (Box::new(|d| d["accessors"][0]["type"] = json!("VEC4")), &["POSITION", "Vec4"]),
        (Box::new(|d| d["accessors"][0]["componentType"] = json!(5121)), &["POSITION", "U8"]),
        (Box::new(|d| d["accessors"][1]["componentType"] = json!(5126)), &["indices", "F32"]),
        (
            Box::new(|d| d["accessors"][0]["bufferView"] = json!(null)),
            &["document", "accessors[0].bufferView"],
        ),
        (Box::new(|d| d["accessors"][0]["bufferView"] = json!(9)), &["document"]),
        (Box::new(|d| d["bufferViews"][0]["byteOffset"] = json!(40)), &["buffer view 0"]),
        (Box::new(|d| d["bufferViews"][0]["byteOffset"] = json!(u64::MAX)), &["buffer view 0"]),
        (Box::new(|d| d["accessors"][0]["count"] = json!(2)), &["it has vertex 2, of 2"]),
        (Box::new(|d| d["meshes"][0]["primitives"][0]["mode"] = json!(1)), &["no triangle"]),
        (Box::new(|d| d["nodes"][0]["children"] = json!([0])), &["node 0", "two parents"]),
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
            &["the texture `no such.png`"],
        ),
    ];
    for (change, wanted) in &cases {
        refused(&[("a.gltf", &with(&**change)), ("data.bin", &buffer)], wanted);
    }
    let whole = with(&|_| {});
    refused(&[("a.gltf", &whole)], &["buffer 0"]);
    refused(&[("a.gltf", &whole), ("data.bin", &buffer[..40])], &["buffer 0", "40 bytes of 60"]);
    let odd = String::from_utf8(whole.clone()).unwrap().replace("data.bin", "%ff");
    refused(&[("a.gltf", odd.as_bytes())], &["buffer 0", "%ff"]);
    refused(&[("a.glb", b"glTF\x02\0\0\0\xff\xff\xff\x7f")], &["the document"]);
    refused(&[("a.gltf", b"{")], &["the document"]);
    assert!(opened(&[("a.gltf", &whole), ("data.bin", &buffer)]).is_ok());
}

#[test]
fn names_and_paths() {
    refused(&[("a.stl", b"solid")], &["`stl`"]);
    refused(&[("model", b"")], &["``"]);
    let error = Mesh::open(std::path::Path::new("no/such/model.obj")).unwrap_err();
    assert!(error.to_string().contains("no/such/model.obj"), "{error}");
}
