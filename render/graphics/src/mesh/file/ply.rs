//! PLY (Turk 1994), text or binary: positions, normals, colours, texture coordinates and polygons.
//! We split polygons into triangle fans.

use std::path::Path;

use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult,
};

use documents::file::Outside;

use super::part::{MeshError, PAINTED, PLAIN, Part, Parts, Read};
use crate::mesh::model::{Mesh, MeshFault};

/// Reads a PLY file. This skips elements other than vertices and faces.
pub(super) fn read(path: &Path, bytes: &[u8], _: Outside) -> Result<Read, MeshError> {
    let name = path.display().to_string();
    let malformed = |place: &str, reason: &str| MeshError::Malformed {
        name: name.clone(),
        place: place.to_owned(),
        reason: reason.split_whitespace().collect::<Vec<_>>().join(" "),
    };
    let failed = |place: &str, text: bool, error: ParseError| match error.line() {
        Some(line) if text => {
            let message = error.to_string();
            // The message also starts with the line number.
            let reason = message.strip_prefix(&format!("Line {line}: ")).unwrap_or(&message);
            malformed(&format!("line {line}"), reason)
        }
        _ => malformed(place, &error.to_string()),
    };
    let mut reader = Reader::new(bytes);
    let header = Parser::<Other>::new().read_header(&mut reader);
    let header = header.map_err(|error| failed("the header", true, error))?;
    let text = header.encoding == Encoding::Ascii;
    let mut vertices = Vec::new();
    let mut faces = Vec::new();
    for (name, element) in &header.elements {
        let of = format!("element `{name}`");
        // Without a property an element takes no bytes, so nothing would limit their number.
        if element.properties.is_empty() && element.count > 0 {
            return Err(malformed(&of, "it has no properties"));
        }
        let read = match name.as_str() {
            "vertex" => elements(&mut reader, element, &header).map(|found| vertices = found),
            "face" => elements(&mut reader, element, &header).map(|found| faces = found),
            _ => elements::<Other>(&mut reader, element, &header).map(drop),
        };
        read.map_err(|error| failed(&of, text, error))?;
    }
    fn has(element: &str, property: &str, header: &Header) -> bool {
        header.elements.get(element).is_some_and(|found| found.properties.contains_key(property))
    }
    let lacking = ["x", "y", "z"].iter().find(|axis| !has("vertex", axis, &header));
    if let Some(axis) = lacking {
        return Err(malformed("element `vertex`", &format!("it has no property `{axis}`")));
    }
    let read = assembled(&vertices, &faces, &|property| has("vertex", property, &header));
    let (mesh, origin) = read.map_err(|fault| MeshError::Faulty(name, fault))?;
    Ok((mesh, origin, Vec::new()))
}

fn elements<E: PropertyAccess>(
    reader: &mut Reader<&[u8]>,
    element: &ElementDef,
    header: &Header,
) -> Result<Vec<E>, ParseError> {
    Parser::new().read_payload_for_element(reader, element, header)
}

fn assembled(
    vertices: &[Vertex],
    faces: &[Face],
    has: &dyn Fn(&str) -> bool,
) -> Result<(Mesh, [f64; 3]), MeshFault> {
    let mut parts = Parts::default();
    let triangles = faces.iter().map(|face| face.corners.len().saturating_sub(2)).sum();
    parts.check_room(vertices.len(), triangles)?;
    let mut part = Part {
        positions: vertices.iter().map(|vertex| vertex.position).collect(),
        step: vertices.iter().map(|vertex| vertex.step).fold(0.0, f64::max),
        ..Part::default()
    };
    if has("nx") {
        part.normals = vertices.iter().map(|vertex| vertex.normal).collect();
    }
    if COORDINATES.iter().any(|[u, _]| has(u)) {
        let upwards = vertices.iter().map(|vertex| vertex.coordinates);
        part.texture_coordinates = upwards.map(|[u, v]| [u, 1.0 - v]).collect();
    }
    if COLORS.iter().any(|[red, ..]| has(red)) {
        let colors = vertices.iter().map(|vertex| vertex.color);
        part.colors = colors.map(|rgb| rgb.map(|value| value.clamp(0.0, 1.0))).collect();
    }
    for face in faces {
        for i in 2..face.corners.len() {
            part.corners.extend([face.corners[0], face.corners[i - 1], face.corners[i]]);
        }
    }
    parts.mesh.materials.push(if part.colors.is_empty() { PLAIN } else { PAINTED });
    parts.add(part)?;
    parts.finish()
}

/// Names that programs use for texture coordinates and colours.
const COORDINATES: [[&str; 2]; 4] =
    [["u", "v"], ["s", "t"], ["texture_u", "texture_v"], ["texture_s", "texture_t"]];
const COLORS: [[&str; 3]; 3] =
    [["red", "green", "blue"], ["r", "g", "b"], ["diffuse_red", "diffuse_green", "diffuse_blue"]];

#[derive(Default)]
struct Vertex {
    position: [f64; 3],
    /// Greatest distance of two neighbouring numbers near the position, in its type.
    step: f64,
    normal: [f32; 3],
    coordinates: [f32; 2],
    color: [f32; 3],
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, key: &str, property: Property) -> PropertyAccessResult {
        let Some(value) = property.to_f32_lossy() else { return PropertyAccessResult::Ignored };
        match key {
            "x" | "y" | "z" => {
                let exact = match property {
                    Property::Double(value) => value,
                    Property::Int(value) => value.into(),
                    Property::UInt(value) => value.into(),
                    _ => value.into(),
                };
                if let Property::Float(value) = property {
                    self.step = self.step.max(f64::from(value.abs() * f32::EPSILON));
                }
                self.position[usize::from(key.as_bytes()[0] - b'x')] = exact;
            }
            "nx" => self.normal[0] = value,
            "ny" => self.normal[1] = value,
            "nz" => self.normal[2] = value,
            _ => {
                fn column(row: &[&str], key: &str) -> Option<usize> {
                    row.iter().position(|name| *name == key)
                }
                if let Some(axis) = COORDINATES.iter().find_map(|row| column(row, key)) {
                    self.coordinates[axis] = value;
                } else if let Some(channel) = COLORS.iter().find_map(|row| column(row, key)) {
                    // We scale integer colours by the greatest value of their type.
                    self.color[channel] = match property {
                        Property::UChar(_) | Property::Char(_) => value / 255.0,
                        Property::UShort(_) | Property::Short(_) => value / 65535.0,
                        _ => value,
                    };
                }
            }
        }
        PropertyAccessResult::Set
    }
}

#[derive(Default)]
struct Face {
    corners: Vec<u32>,
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, key: &str, property: Property) -> PropertyAccessResult {
        if !["vertex_indices", "vertex_index"].contains(&key) {
            return PropertyAccessResult::Ignored;
        }
        // We map a negative index to one that is out of range.
        fn whole(value: i64) -> u32 {
            u32::try_from(value).unwrap_or(u32::MAX)
        }
        self.corners = match property {
            Property::ListChar(list) => list.into_iter().map(|at| whole(at.into())).collect(),
            Property::ListUChar(list) => list.into_iter().map(u32::from).collect(),
            Property::ListShort(list) => list.into_iter().map(|at| whole(at.into())).collect(),
            Property::ListUShort(list) => list.into_iter().map(u32::from).collect(),
            Property::ListInt(list) => list.into_iter().map(|at| whole(at.into())).collect(),
            Property::ListUInt(list) => list,
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

struct Other;

impl PropertyAccess for Other {
    fn new() -> Self {
        Self
    }
}
