//! glTF 2.0 (Khronos Group, 2021): the default scene in its rest pose. We read only base colours
//! and textures, and ignore metalness, roughness and opacity.

mod document;
mod values;

use std::path::Path;

use documents::counted_as;
use documents::file::{NamedFiles, Outside};
use glam::{DMat3, DMat4, DQuat, DVec3};
use spectra::color::Rgb;

use self::document::{Document, MaterialOfFile, Node, Primitive, entry};
use self::values::{Buffers, COLORS, COORDINATES, CORNERS, Kind, VECTORS, Values, content_of};
use super::part::{MeshError, PAINTED, PLAIN, Part, Parts, Read, Textures};
use crate::mesh::model::{Material, MeshFault};

/// Reads a `.gltf` or `.glb` file. The content decides which format it is.
pub(super) fn read(path: &Path, bytes: &[u8], outside: Outside) -> Result<Read, MeshError> {
    let (document, binary) = document::parsed(bytes)
        .map_err(|reason| MeshError::malformed(path, "the document", reason))?;
    let mut files = NamedFiles::of(path, outside);
    let buffers = Buffers::read(&document, binary, &mut files)?;
    let mut reader = Reader {
        document: &document,
        buffers: &buffers,
        parts: Parts::default(),
        coordinates: Vec::new(),
    };
    let mut textures = Textures::default();
    for (index, material) in document.materials.iter().enumerate() {
        let place = format!("materials[{index}]");
        let image = reader.image_of(material);
        let image = image.map_err(|reason| MeshError::malformed(path, place, reason))?;
        reader.add_material(material, image, &mut files, &mut textures)?;
    }
    // Materials of primitives that name none: without and with vertex colours.
    reader.parts.mesh.materials.extend([PLAIN, PAINTED]);
    reader.coordinates.extend([0, 0]);
    reader.add_scene().map_err(|fault| match fault {
        Fault::Place(place, reason) => MeshError::malformed(path, place, reason),
        Fault::Mesh(fault) => MeshError::faulty(path, fault),
    })?;
    let finished = reader.parts.finish();
    let (mesh, origin) = finished.map_err(|fault| MeshError::faulty(path, fault))?;
    Ok((mesh, origin, files.found().to_vec()))
}

/// Why a scene cannot be read: a place of the document with a reason, or the whole mesh.
enum Fault {
    Place(String, String),
    Mesh(MeshFault),
}

fn encoded(linear: [f32; 3]) -> [f32; 3] {
    let linear = linear.map(|value| f64::from(value.clamp(0.0, 1.0)));
    Rgb(linear).encoded().0.map(|value| value.clamp(0.0, 1.0) as f32)
}

struct Reader<'a> {
    document: &'a Document,
    buffers: &'a Buffers<'a>,
    parts: Parts,
    /// Index of the texture coordinate set that each material's texture uses.
    coordinates: Vec<u32>,
}

impl Reader<'_> {
    /// The index of the image that a material shows, if it has a texture.
    fn image_of(&self, material: &MaterialOfFile) -> Result<Option<usize>, String> {
        let base = material.pbr_metallic_roughness.as_ref();
        let Some(texture) = base.and_then(|base| base.base_color_texture.as_ref()) else {
            return Ok(None);
        };
        let found = entry("textures", &self.document.textures, texture.index)?;
        let Some(source) = found.source else {
            return Err(format!("textures[{}] has no source", texture.index));
        };
        entry("images", &self.document.images, source)?;
        Ok(Some(source))
    }

    fn add_material(
        &mut self,
        material: &MaterialOfFile,
        image: Option<usize>,
        files: &mut NamedFiles,
        textures: &mut Textures,
    ) -> Result<(), MeshError> {
        let base = material.pbr_metallic_roughness.as_ref();
        let factor = base.and_then(|base| base.base_color_factor).unwrap_or([1.0; 4]);
        let texture = base.and_then(|base| base.base_color_texture.as_ref());
        self.coordinates.push(texture.map_or(0, |texture| texture.tex_coord));
        let texture = match image {
            None => None,
            Some(index) => {
                let (texture, bytes) = self.image(index, files)?;
                Some(textures.decode(&bytes).map_err(|reason| {
                    let name = files.file().display().to_string();
                    MeshError::Texture { name, texture, reason }
                })?)
            }
        };
        let name = material.name.clone().unwrap_or_default();
        let color = encoded([0, 1, 2].map(|channel| factor[channel] as f32));
        self.parts.mesh.materials.push(Material { name, color, texture });
        Ok(())
    }

    /// The name of an image for errors, and its bytes.
    fn image(&self, index: usize, files: &mut NamedFiles) -> Result<(String, Vec<u8>), MeshError> {
        let place = format!("images[{index}]");
        let image = &self.document.images[index];
        match (image.buffer_view, &image.uri) {
            (Some(view), _) => match self.buffers.view(self.document, view) {
                Ok(bytes) => Ok((place, bytes.to_vec())),
                Err(reason) => Err(MeshError::malformed(files.file(), place, reason)),
            },
            (None, Some(uri)) => {
                let bytes = content_of(uri, &format!("{place}.uri"), files)?;
                Ok((if uri.starts_with("data:") { place } else { uri.clone() }, bytes))
            }
            (None, None) => {
                let reason = "it has neither a uri nor a bufferView";
                Err(MeshError::malformed(files.file(), place, reason))
            }
        }
    }

    /// Adds the nodes of the default scene, or of the first one. Without scenes, this adds all
    /// nodes.
    fn add_scene(&mut self) -> Result<(), Fault> {
        let Document { scene, scenes, nodes, meshes, .. } = self.document;
        let scene = match scene {
            Some(scene) => {
                let found = entry("scenes", scenes, *scene);
                Some(found.map_err(|reason| Fault::Place("scene".to_owned(), reason))?)
            }
            None => scenes.first(),
        };
        let mut waiting: Vec<(usize, DMat4)> = match scene {
            Some(scene) => scene.nodes.iter().map(|node| (*node, DMat4::IDENTITY)).collect(),
            None => (0..nodes.len()).map(|node| (node, DMat4::IDENTITY)).collect(),
        };
        waiting.reverse();
        // No node is met twice, so cycles end, and there are no more nodes than the file has.
        let mut met = vec![false; nodes.len()];
        while let Some((index, model_from_parent)) = waiting.pop() {
            let place = format!("nodes[{index}]");
            let node = entry("nodes", nodes, index);
            let node = node.map_err(|reason| Fault::Place("the scene".to_owned(), reason))?;
            if std::mem::replace(&mut met[index], true) {
                return Err(Fault::Place(place, "it has two parents".to_owned()));
            }
            let model_from_node = model_from_parent * matrix(node);
            if let Some(mesh) = node.mesh {
                let found = entry("meshes", meshes, mesh);
                let found = found.map_err(|reason| Fault::Place(place, reason))?;
                for (number, primitive) in found.primitives.iter().enumerate() {
                    let place = format!("meshes[{mesh}].primitives[{number}]");
                    let part = self.part(primitive, model_from_node);
                    let part = part.map_err(|reason| Fault::Place(place, reason))?;
                    if let Some(part) = part {
                        self.parts.add(part).map_err(Fault::Mesh)?;
                    }
                }
            }
            waiting.extend(node.children.iter().rev().map(|child| (*child, model_from_node)));
        }
        Ok(())
    }

    /// The triangles of a primitive, `None` for points and lines.
    fn part(&self, primitive: &Primitive, model_from_node: DMat4) -> Result<Option<Part>, String> {
        let mode = primitive.mode.unwrap_or(TRIANGLES);
        match mode {
            POINTS..TRIANGLES => return Ok(None),
            TRIANGLES | STRIP | FAN => {}
            _ => return Err(format!("it has mode {mode}, not 0 to 6")),
        }
        let painted = primitive.attributes.contains_key("COLOR_0");
        let without = self.coordinates.len() - 2 + usize::from(painted);
        let material = match primitive.material {
            None => without,
            Some(index) => {
                entry("materials", &self.document.materials, index)?;
                index
            }
        };
        let set = format!("TEXCOORD_{}", self.coordinates[material]);
        let Some(positions) = self.attribute(primitive, "POSITION", &VECTORS)? else {
            return Err("it has no POSITION".to_owned());
        };
        let normals = self.attribute(primitive, "NORMAL", &VECTORS)?;
        let coordinates = self.attribute(primitive, &set, &COORDINATES)?;
        let colors = self.attribute(primitive, "COLOR_0", &COLORS)?;
        let corners = primitive.indices.map(|index| {
            Values::of(self.document, self.buffers, index, &CORNERS)
                .map_err(|reason| format!("indices: {reason}"))
        });
        let corners = corners.transpose()?;
        let count = positions.count();
        for (what, found) in
            [("normals", normals), ("texture coordinates", coordinates), ("colours", colors)]
        {
            if let Some(found) = found.map(|values| values.count()).filter(|found| *found != count)
            {
                let vertices = counted_as(count, "vertex", "vertices");
                return Err(format!("{found} {what} for {vertices}"));
            }
        }
        // A strip has as many triangles as corners, almost.
        let triangles = corners.map_or(count, |corners| corners.count());
        let triangles = if mode == TRIANGLES { triangles / 3 } else { triangles };
        self.parts.check_room(count, triangles).map_err(|fault| fault.to_string())?;

        let mut part = Part { material: material as u32, ..Part::default() };
        let linear = DMat3::from_mat4(model_from_node);
        let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis];
        let mut greatest: f32 = 0.0;
        for at in positions.floats::<3>() {
            greatest = at.into_iter().map(f32::abs).fold(greatest, f32::max);
            part.positions.push(model_from_node.transform_point3(at.map(f64::from).into()).into());
        }
        let scale = x.length().max(y.length()).max(z.length());
        part.step = f64::from(greatest * f32::EPSILON) * scale;
        // Cofactor matrix: the inverse transpose up to scale, valid for flat nodes too.
        let mirrored = linear.determinant() < 0.0;
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
        if let Some(normals) = normals {
            let sign = if mirrored { -1.0 } else { 1.0 };
            let turned = normals.floats::<3>().map(|at| {
                let turned = cofactors * (DVec3::from(at.map(f64::from)) * sign);
                turned.normalize_or_zero().as_vec3().into()
            });
            part.normals = turned.collect();
        }
        if let Some(coordinates) = coordinates {
            part.texture_coordinates = coordinates.floats().collect();
        }
        if let Some(colors) = colors {
            part.colors = colors.floats().map(encoded).collect();
        }
        let listed: Vec<u32> = match corners {
            Some(corners) => corners.indices().collect(),
            None => (0..count as u32).collect(),
        };
        if let Some(found) = listed.iter().find(|&&corner| corner as usize >= count) {
            return Err(format!("it has vertex {found}, of {count}"));
        }
        part.corners = split(mode, &listed);
        if mirrored {
            part.corners.chunks_exact_mut(3).for_each(|corners| corners.swap(1, 2));
        }
        Ok(Some(part))
    }

    fn attribute(
        &self,
        primitive: &Primitive,
        meaning: &str,
        kind: &Kind,
    ) -> Result<Option<Values<'_>>, String> {
        let index = primitive.attributes.get(meaning);
        let values = index.map(|index| {
            Values::of(self.document, self.buffers, *index, kind)
                .map_err(|reason| format!("{meaning}: {reason}"))
        });
        values.transpose()
    }
}

/// Modes of primitives. Those before [`TRIANGLES`] are points and lines.
const POINTS: u64 = 0;
const TRIANGLES: u64 = 4;
const STRIP: u64 = 5;
const FAN: u64 = 6;

/// The matrix that takes a point in the coordinates of a node to the coordinates of its parent.
fn matrix(node: &Node) -> DMat4 {
    match &node.matrix {
        Some(columns) => DMat4::from_cols_array(columns),
        None => DMat4::from_scale_rotation_translation(
            node.scale.unwrap_or([1.0; 3]).into(),
            DQuat::from_array(node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0])),
            node.translation.unwrap_or_default().into(),
        ),
    }
}

/// Splits strips and fans into a list with three indices per triangle.
fn split(mode: u64, listed: &[u32]) -> Vec<u32> {
    match mode {
        STRIP => listed
            .windows(3)
            .enumerate()
            .flat_map(|(i, at): (usize, &[u32])| match i % 2 {
                0 => [at[0], at[1], at[2]],
                _ => [at[1], at[0], at[2]],
            })
            .collect(),
        FAN => {
            let rest = listed.get(1..).unwrap_or_default();
            rest.windows(2).flat_map(|at| [listed[0], at[0], at[1]]).collect()
        }
        _ => listed[..listed.len() / 3 * 3].to_vec(),
    }
}
