use ply_rs_bw::ply::{
    Addable, DefaultElement, ElementDef, Encoding, Ply, Property, PropertyDef, PropertyType,
    ScalarType,
};
use ply_rs_bw::writer::Writer;

use super::ExportError;

/// Encodes triangles as a binary PLY file (Turk 1994). Each vertex has `x`, `y`, `z` and a colour
/// as `red`, `green`, `blue`. You give the colour in encoded sRGB (0..1), and the file stores
/// bytes. Each face has `vertex_indices`.
///
/// # Errors
/// [`ExportError::Encoder`] if there are 2^31 vertices or more.
pub fn ply(vertices: &[([f32; 3], [f32; 3])], faces: &[[u32; 3]]) -> Result<Vec<u8>, ExportError> {
    fn failed(reason: String) -> ExportError {
        ExportError::Encoder { format: "PLY", reason }
    }
    if i32::try_from(vertices.len()).is_err() {
        return Err(failed(format!("{} vertices are more than 2147483647", vertices.len())));
    }
    let mut ply = Ply::<DefaultElement>::new();
    ply.header.encoding = Encoding::BinaryLittleEndian;
    let mut vertex = ElementDef::new("vertex".to_owned());
    for (names, kind) in
        [(["x", "y", "z"], ScalarType::Float), (["red", "green", "blue"], ScalarType::UChar)]
    {
        for name in names {
            let kind = PropertyType::Scalar(kind.clone());
            vertex.properties.add(PropertyDef::new(name.to_owned(), kind));
        }
    }
    ply.header.elements.add(vertex);
    let mut face = ElementDef::new("face".to_owned());
    let corners = PropertyType::List(ScalarType::UChar, ScalarType::Int);
    face.properties.add(PropertyDef::new("vertex_indices".to_owned(), corners));
    ply.header.elements.add(face);
    let written = vertices.iter().map(|(position, color)| {
        let mut element = DefaultElement::new();
        for (name, value) in ["x", "y", "z"].into_iter().zip(position) {
            element.insert(name.to_owned(), Property::Float(*value));
        }
        for (name, value) in ["red", "green", "blue"].into_iter().zip(color) {
            let byte = (value.clamp(0.0, 1.0) * 255.0).round() as u8;
            element.insert(name.to_owned(), Property::UChar(byte));
        }
        element
    });
    ply.payload.insert("vertex".to_owned(), written.collect());
    let written = faces.iter().map(|corners| {
        let mut element = DefaultElement::new();
        let corners = corners.iter().map(|&corner| corner as i32).collect();
        element.insert("vertex_indices".to_owned(), Property::ListInt(corners));
        element
    });
    ply.payload.insert("face".to_owned(), written.collect());
    let mut bytes = Vec::new();
    Writer::new().write_ply(&mut bytes, &mut ply).map_err(|error| failed(error.to_string()))?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;

    #[test]
    fn triangles_are_read_as_they_were_written() {
        let vertices = [
            ([0.0, 0.0, 0.0], [1.0, 0.0, 0.2]),
            ([1.5, 0.0, 0.0], [0.0, 1.0, 0.4]),
            ([0.0, -2.0, 0.25], [1.0; 3]),
        ];
        let bytes = ply(&vertices, &[[0, 1, 2]]).unwrap();
        assert_eq!(bytes, ply(&vertices, &[[0, 1, 2]]).unwrap());
        let file = tempfile::Builder::new().suffix(".ply").tempfile().unwrap();
        std::fs::write(file.path(), bytes).unwrap();
        let mesh = Mesh::open(file.path()).unwrap();
        assert_eq!(mesh.positions, vertices.map(|(position, _)| position));
        assert_eq!(mesh.triangles[0].corners, [0, 1, 2]);
        for (found, (_, wanted)) in mesh.colors.iter().zip(vertices) {
            for (found, wanted) in found.iter().zip(wanted) {
                assert!((found - wanted).abs() < 1e-6, "{found} {wanted}");
            }
        }
    }
}
