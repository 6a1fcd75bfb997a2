//! glTF 2.0 (Khronos Group, 2021): the default scene in its rest pose. We read only base colours
//! and textures, and ignore metalness, roughness and opacity.
//!
//! We check accessors, buffer views and references before the glTF reader follows them.

use std::path::Path;

use documents::counted_as;
use glam::{Mat3, Mat4, Vec3};
use gltf::accessor::{Accessor, DataType, Dimensions};
use gltf::mesh::{Mode, Semantic};
use spectra::color::Rgb;

use super::part::{MeshError, PAINTED, PLAIN, Part};
use crate::mesh::model::{Material, Mesh, Texture};

/// Reads a `.gltf` or `.glb` file. The content decides which format it is.
pub(super) fn read(name: &str, folder: &Path, bytes: &[u8]) -> Result<Mesh, MeshError> {
    let document = gltf::Gltf::from_slice(bytes)
        .map_err(|error| malformed(name, "the document", error.to_string()))?;
    let mut blob = document.blob.clone();
    let mut buffers = Vec::new();
    for buffer in document.buffers() {
        let place = format!("buffer {}", buffer.index());
        if let gltf::buffer::Source::Uri(reference) = buffer.source() {
            path_of(reference).map_err(|reason| malformed(name, &place, reason))?;
        }
        let found =
            gltf::buffer::Data::from_source_and_blob(buffer.source(), Some(folder), &mut blob);
        let found = found.map_err(|error| malformed(name, &place, error.to_string()))?;
        if found.len() < buffer.length() {
            let reason = format!("{} bytes of {}", found.len(), buffer.length());
            return Err(malformed(name, &place, reason));
        }
        buffers.push(found);
    }
    let mut reader = Reader { name, folder, buffers, mesh: Mesh::default(), coordinates: vec![] };
    for material in document.materials() {
        reader.add_material(&material)?;
    }
    // Materials of primitives that name none: without and with vertex colours.
    reader.mesh.materials.extend([PLAIN, PAINTED]);
    reader.coordinates.extend([0, 0]);
    let mut met = vec![false; document.nodes().len()];
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let mut waiting: Vec<_> = match scene {
        Some(scene) => scene.nodes().map(|node| (node, Mat4::IDENTITY)).collect(),
        None => document.nodes().map(|node| (node, Mat4::IDENTITY)).collect(),
    };
    waiting.reverse();
    while let Some((node, model_from_parent)) = waiting.pop() {
        if std::mem::replace(&mut met[node.index()], true) {
            let place = format!("node {}", node.index());
            return Err(malformed(name, &place, "it has two parents".to_owned()));
        }
        let model_from_node =
            model_from_parent * Mat4::from_cols_array_2d(&node.transform().matrix());
        if let Some(mesh) = node.mesh() {
            for primitive in mesh.primitives() {
                let place = format!("mesh {}, primitive {}", mesh.index(), primitive.index());
                let added = reader.add_primitive(&primitive, model_from_node);
                added.map_err(|reason| malformed(name, &place, reason))?;
            }
        }
        let children: Vec<_> = node.children().collect();
        waiting.extend(children.into_iter().rev().map(|child| (child, model_from_node)));
    }
    Ok(reader.mesh)
}

fn malformed(name: &str, place: &str, reason: String) -> MeshError {
    MeshError::Malformed { name: name.to_owned(), place: place.to_owned(), reason }
}

fn encoded(linear: [f32; 3]) -> [f32; 3] {
    let linear = linear.map(|value| f64::from(value.clamp(0.0, 1.0)));
    Rgb(linear).encoded().0.map(|value| value.clamp(0.0, 1.0) as f32)
}

struct Reader<'a> {
    name: &'a str,
    folder: &'a Path,
    buffers: Vec<gltf::buffer::Data>,
    mesh: Mesh,
    /// Index of the texture coordinate set that each material's texture uses.
    coordinates: Vec<u32>,
}

impl Reader<'_> {
    fn add_material(&mut self, material: &gltf::Material<'_>) -> Result<(), MeshError> {
        let base = material.pbr_metallic_roughness();
        let [r, g, b, _] = base.base_color_factor();
        let texture = base.base_color_texture();
        self.coordinates.push(texture.as_ref().map_or(0, |texture| texture.tex_coord()));
        let texture = texture.map(|texture| self.texture(&texture.texture().source()));
        let texture = texture.transpose()?;
        let name = material.name().unwrap_or_default().to_owned();
        self.mesh.materials.push(Material { name, color: encoded([r, g, b]), texture });
        Ok(())
    }

    fn texture(&self, image: &gltf::Image<'_>) -> Result<Texture, MeshError> {
        let number = format!("image {}", image.index());
        let (texture, found) = match image.source() {
            gltf::image::Source::View { view, .. } => {
                (number, slice(&view, &self.buffers).and_then(Texture::from_bytes))
            }
            gltf::image::Source::Uri { uri, .. } if uri.starts_with("data:") => {
                // The buffer loader decodes data URIs too.
                let source = gltf::buffer::Source::Uri(uri);
                let found = gltf::buffer::Data::from_source(source, Some(self.folder));
                let bytes = found.map_err(|error| error.to_string());
                (number, bytes.and_then(|bytes| Texture::from_bytes(&bytes)))
            }
            gltf::image::Source::Uri { uri, .. } => match path_of(uri) {
                Ok(path) => {
                    let bytes = std::fs::read(self.folder.join(&path)).map_err(|e| e.to_string());
                    (path, bytes.and_then(|bytes| Texture::from_bytes(&bytes)))
                }
                Err(reason) => (number, Err(reason)),
            },
        };
        found.map_err(|reason| MeshError::Texture { name: self.name.to_owned(), texture, reason })
    }

    /// Adds the triangles of a primitive. This skips points and lines.
    fn add_primitive(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        model_from_node: Mat4,
    ) -> Result<(), String> {
        if matches!(primitive.mode(), Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip)
        {
            return Ok(());
        }
        let painted = primitive.get(&Semantic::Colors(0)).is_some();
        let without = self.coordinates.len() - 2 + usize::from(painted);
        let material = primitive.material().index().unwrap_or(without);
        let set = self.coordinates[material];
        for (semantic, accessor) in primitive.attributes() {
            let kind = match semantic {
                Semantic::Positions => &POSITIONS,
                Semantic::Normals => &NORMALS,
                Semantic::TexCoords(found) if found == set => &COORDINATES,
                Semantic::Colors(0) => &COLORS,
                _ => continue,
            };
            check(&accessor, kind, &self.buffers)
                .map_err(|reason| format!("accessor {}: {reason}", accessor.index()))?;
        }
        if let Some(accessor) = primitive.indices() {
            check(&accessor, &CORNERS, &self.buffers)
                .map_err(|reason| format!("accessor {}: {reason}", accessor.index()))?;
        }
        let buffers = &self.buffers;
        let reader = primitive.reader(|buffer| buffers.get(buffer.index()).map(|data| &**data));
        let positions = reader.read_positions().ok_or_else(|| "it has no POSITION".to_owned())?;
        let mut part = Part {
            positions: positions
                .map(|at: [f32; 3]| model_from_node.transform_point3(at.into()).into())
                .collect(),
            material: material as u32,
            ..Part::default()
        };
        let count = part.positions.len();
        // Cofactor matrix: the inverse transpose up to scale, valid for flat nodes too.
        let linear = Mat3::from_mat4(model_from_node);
        let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis];
        let mirrored = linear.determinant() < 0.0;
        let cofactors = Mat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
        if let Some(normals) = reader.read_normals() {
            let sign = if mirrored { -1.0 } else { 1.0 };
            let turned =
                normals.map(|at| (cofactors * (Vec3::from(at) * sign)).normalize_or_zero());
            part.normals = turned.map(Into::into).collect();
        }
        if let Some(coordinates) = reader.read_tex_coords(set) {
            part.texture_coordinates = coordinates.into_f32().collect();
        }
        if let Some(colors) = reader.read_colors(0) {
            part.colors = colors.into_rgb_f32().map(encoded).collect();
        }
        for (what, found) in [
            ("normals", part.normals.len()),
            ("texture coordinates", part.texture_coordinates.len()),
            ("colours", part.colors.len()),
        ] {
            if found != 0 && found != count {
                return Err(format!(
                    "{found} {what} for {}",
                    counted_as(count, "vertex", "vertices")
                ));
            }
        }
        let listed: Vec<u32> = match reader.read_indices() {
            Some(indices) => indices.into_u32().collect(),
            None => (0..count as u32).collect(),
        };
        if let Some(found) = listed.iter().find(|&&corner| corner as usize >= count) {
            return Err(format!("it has vertex {found}, of {count}"));
        }
        part.corners = triangles(primitive.mode(), &listed);
        if mirrored {
            part.corners.chunks_exact_mut(3).for_each(|corners| corners.swap(1, 2));
        }
        part.append_to(&mut self.mesh);
        Ok(())
    }
}

/// Splits strips and fans into a list with three indices per triangle.
fn triangles(mode: Mode, listed: &[u32]) -> Vec<u32> {
    match mode {
        Mode::TriangleStrip => listed
            .windows(3)
            .enumerate()
            .flat_map(|(i, at): (usize, &[u32])| match i % 2 {
                0 => [at[0], at[1], at[2]],
                _ => [at[1], at[0], at[2]],
            })
            .collect(),
        Mode::TriangleFan => {
            let rest = listed.get(1..).unwrap_or_default();
            rest.windows(2).flat_map(|at| [listed[0], at[0], at[1]]).collect()
        }
        _ => listed[..listed.len() / 3 * 3].to_vec(),
    }
}

/// Component types and dimensions that we allow an attribute.
pub(super) struct Kind {
    pub(super) name: &'static str,
    pub(super) types: &'static [DataType],
    pub(super) dimensions: &'static [Dimensions],
}

pub(super) const POSITIONS: Kind =
    Kind { name: "POSITION", types: &[DataType::F32], dimensions: &[Dimensions::Vec3] };

pub(super) const NORMALS: Kind =
    Kind { name: "NORMAL", types: &[DataType::F32], dimensions: &[Dimensions::Vec3] };

const FRACTIONS: &[DataType] = &[DataType::F32, DataType::U8, DataType::U16];

pub(super) const COORDINATES: Kind =
    Kind { name: "TEXCOORD", types: FRACTIONS, dimensions: &[Dimensions::Vec2] };

pub(super) const COLORS: Kind =
    Kind { name: "COLOR", types: FRACTIONS, dimensions: &[Dimensions::Vec3, Dimensions::Vec4] };

pub(super) const CORNERS: Kind = Kind {
    name: "indices",
    types: &[DataType::U8, DataType::U16, DataType::U32],
    dimensions: &[Dimensions::Scalar],
};

/// Checks that an accessor has an allowed type and that all of its values lie within its buffer.
/// If not, the error says why.
pub(super) fn check(
    accessor: &Accessor<'_>,
    kind: &Kind,
    buffers: &[gltf::buffer::Data],
) -> Result<(), String> {
    let found = accessor.data_type();
    let dimensions = accessor.dimensions();
    if !kind.types.contains(&found) || !kind.dimensions.contains(&dimensions) {
        return Err(format!("{} of `{found:?}` in `{dimensions:?}`", kind.name));
    }
    if accessor.sparse().is_some() {
        return Err("sparse values are not read".to_owned());
    }
    let view = accessor.view().ok_or_else(|| "it has no buffer view".to_owned())?;
    slice(&view, buffers)?;
    let count = accessor.count();
    let stride = view.stride().unwrap_or(accessor.size());
    let last = count.checked_sub(1).ok_or_else(|| "it has no values".to_owned())?;
    let end = last
        .checked_mul(stride)
        .and_then(|end| end.checked_add(accessor.offset())?.checked_add(accessor.size()));
    match end.is_some_and(|end| end <= view.length()) {
        true => Ok(()),
        false => Err(format!("{count} values are more than its buffer view has")),
    }
}

pub(super) fn slice<'a>(
    view: &gltf::buffer::View<'_>,
    buffers: &'a [gltf::buffer::Data],
) -> Result<&'a [u8], String> {
    let buffer: &[u8] = &buffers[view.buffer().index()];
    let end = view.offset().checked_add(view.length());
    let within = end.and_then(|end| buffer.get(view.offset()..end));
    within.ok_or_else(|| format!("buffer view {} reaches beyond its buffer", view.index()))
}

/// Decodes the percent escapes of a relative reference (e.g. `%20`) into a path.
pub(super) fn path_of(reference: &str) -> Result<String, String> {
    let mut bytes = Vec::with_capacity(reference.len());
    let mut rest = reference.as_bytes();
    while let [first, after @ ..] = rest {
        let coded = (*first == b'%').then(|| std::str::from_utf8(after.get(..2)?).ok()).flatten();
        match coded.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            None => {
                bytes.push(*first);
                rest = after;
            }
        }
    }
    String::from_utf8(bytes).map_err(|_| format!("not a reference: `{reference}`"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_are_decoded() {
        assert_eq!(path_of("a%20b%2Fc.png").as_deref(), Ok("a b/c.png"));
        assert_eq!(path_of("100%").as_deref(), Ok("100%"));
        assert_eq!(path_of("%zz").as_deref(), Ok("%zz"));
        assert!(path_of("%ff").is_err());
    }
}
