//! A triangle mesh with materials and textures: its validity, its vertex normals, and its closed
//! parts.
//!
//! We weld vertices at the same position for normals and closed parts, so that seams of textures
//! do not matter.

use std::ops::Range;

use documents::{counted_as, hint::Explain};
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// A triangle mesh. All per-vertex lists must have the same length.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Vertex positions in the model's own unit, y points up.
    pub positions: Vec<[f32; 3]>,
    /// Outward unit normals, one per vertex.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates per vertex as in glTF: (0, 0) is the upper left corner of the texture,
    /// (1, 1) the lower right. Textures repeat.
    pub texture_coordinates: Vec<[f32; 2]>,
    /// Vertex colours, encoded sRGB in 0..1. They multiply the material's colour. If a file has
    /// none, this is white.
    pub colors: Vec<[f32; 3]>,
    /// Triangles, wound counter-clockwise seen from outside.
    pub triangles: Vec<Triangle>,
    /// Materials, at least one if there are triangles.
    pub materials: Vec<Material>,
}

/// A triangle: three vertex indices and a material index.
#[derive(Debug, Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Triangle {
    /// Indices into the per-vertex lists.
    pub corners: [u32; 3],
    /// Index into [`Mesh::materials`].
    pub material: u32,
}

/// Colour of a surface: a base colour, which a texture may multiply.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name in the file, empty if it has none. Several materials may share this name.
    pub name: String,
    /// Base colour, encoded sRGB in 0..1.
    pub color: [f32; 3],
    /// Texture that multiplies the base colour, if any.
    pub texture: Option<Texture>,
}

/// An 8-bit texture image.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Texture {
    /// Width in texels.
    pub width: u32,
    /// Height in texels. Row 0 is the top.
    pub height: u32,
    /// Texels row by row, encoded sRGB with opacity, packed as `0xAABBGGRR` (red in the
    /// lowest byte).
    pub texels: Vec<u32>,
}

impl Material {
    /// A material without name and texture. Pass `color` in encoded sRGB, 0..1.
    #[must_use]
    pub fn plain(color: [f32; 3]) -> Self {
        Self::named("", color)
    }

    /// A material without texture. Pass `color` in encoded sRGB, 0..1.
    #[must_use]
    pub fn named(name: &str, color: [f32; 3]) -> Self {
        Self { name: name.to_owned(), color, texture: None }
    }
}

impl Mesh {
    /// Lowest and highest corner of the axis-aligned bounding box, zeros for a mesh without
    /// vertices.
    #[must_use]
    pub fn bounds(&self) -> [Vec3; 2] {
        let mut positions = self.positions.iter().map(|&position| Vec3::from(position));
        let Some(first) = positions.next() else { return [Vec3::ZERO; 2] };
        positions.fold([first; 2], |[low, high], position| [low.min(position), high.max(position)])
    }
}

/// Least and greatest width of a mesh that is read from a file. Squares of areas of its triangles
/// must be 32-bit numbers.
pub(super) const LEAST_SIZE: f64 = 1e-9;
pub(super) const MOST_SIZE: f64 = 1e9;

/// A defect of a mesh. All indices count from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum MeshFault {
    /// The mesh has no triangles.
    #[error("the mesh has no triangle")]
    #[hint("export the model with its faces; points and lines are not drawn")]
    NoTriangle,
    /// A per-vertex list has another length than the list of positions.
    #[error("{found} {what} for {}", counted_as(*wanted, "vertex", "vertices"))]
    #[hint("give every vertex and texel its value")]
    ListLength {
        /// Name of the list, for example `normals`.
        what: &'static str,
        /// Length of that list.
        found: usize,
        /// Number of positions.
        wanted: usize,
    },
    /// A vertex attribute is infinite or not a number.
    #[error("vertex {vertex} has the {what} `{found:?}`")]
    #[hint("clean the model in the program that made it (Blender: Mesh > Clean Up)")]
    NotFinite {
        /// Index of the vertex.
        vertex: usize,
        /// Name of the attribute, for example `position`.
        what: &'static str,
        /// Value of the attribute.
        found: Vec<f32>,
    },
    /// All vertices lie at one point.
    #[error("all {vertices} vertices of the mesh lie at one point")]
    #[hint("export the model again, with its true positions")]
    OnePoint {
        /// Number of vertices.
        vertices: usize,
    },
    /// The mesh is too small or too large for 32-bit numbers.
    #[error("the mesh is {size:e} units wide, not {LEAST_SIZE:e} to {MOST_SIZE:e}")]
    #[hint("scale the model, for example to a width of 1 unit")]
    Size {
        /// The longest side of the bounding box, in the model's own unit.
        size: f64,
    },
    /// The mesh lies so far from the origin that rounding destroys its shape.
    #[error(
        "the mesh is {size:e} units wide and lies {away:e} units from the origin, where the numbers \
         of the file tell only places {step:e} units apart"
    )]
    #[hint("move the model to the origin in the program that made it, and export it again")]
    TooFar {
        /// The longest side of the bounding box.
        size: f64,
        /// The greatest coordinate of its centre.
        away: f64,
        /// The distance of two neighbouring numbers there.
        step: f64,
    },
    /// Every triangle is a point or a line.
    #[error("no triangle of the mesh has an area")]
    #[hint("export the model again; its triangles are points and lines, which cannot be drawn")]
    NoArea,
    /// The mesh has more parts than we read.
    #[error("the mesh has {found} {what}, more than {most}")]
    #[hint("reduce the model in the program that made it (Blender: Decimate)")]
    TooMany {
        /// `vertices` or `triangles`.
        what: &'static str,
        /// The number of them in the file.
        found: usize,
        /// The greatest number that we read.
        most: usize,
    },
    /// A triangle refers to a vertex that does not exist.
    #[error("triangle {triangle} has vertex {found}, of {vertices}")]
    #[hint("the file is damaged: export it again")]
    NoSuchVertex {
        /// Index of the triangle.
        triangle: usize,
        /// Vertex index it refers to.
        found: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// A triangle refers to a material that does not exist.
    #[error("triangle {triangle} has material {found}, of {materials}")]
    #[hint("the file is damaged: export it again")]
    NoSuchMaterial {
        /// Index of the triangle.
        triangle: usize,
        /// Material index it refers to.
        found: u32,
        /// Number of materials.
        materials: usize,
    },
    /// A material's colour is outside 0..1.
    #[error("material {material} has the colour `{found:?}`")]
    #[hint("colours are encoded sRGB from 0 to 1")]
    Color {
        /// Index of the material.
        material: usize,
        /// The colour, encoded sRGB.
        found: [f32; 3],
    },
    /// A texture is empty, or its texel count is not width times height.
    #[error("the texture of material {material} has {texels} texels for {width} x {height}")]
    #[hint("give every vertex and texel its value")]
    Texture {
        /// Index of the material.
        material: usize,
        /// Number of texels.
        texels: usize,
        /// Width in texels.
        width: u32,
        /// Height in texels.
        height: u32,
    },
}

impl Mesh {
    /// Checks that you can render the mesh: consistent list lengths, finite attributes, valid
    /// indices, colours in 0..1.
    ///
    /// # Errors
    /// The first [`MeshFault`] found.
    pub fn check(&self) -> Result<(), MeshFault> {
        let wanted = self.positions.len();
        for (what, found) in [
            ("normals", self.normals.len()),
            ("texture coordinates", self.texture_coordinates.len()),
            ("colours", self.colors.len()),
        ] {
            if found != wanted {
                return Err(MeshFault::ListLength { what, found, wanted });
            }
        }
        check_finite("position", &self.positions)?;
        check_finite("normal", &self.normals)?;
        check_finite("texture coordinate", &self.texture_coordinates)?;
        check_finite("colour", &self.colors)?;
        for (index, material) in self.materials.iter().enumerate() {
            if material.color.iter().any(|value| !(0.0..=1.0).contains(value)) {
                return Err(MeshFault::Color { material: index, found: material.color });
            }
            let Some(texture) = &material.texture else { continue };
            let width = texture.width;
            let height = texture.height;
            let texels = texture.texels.len();
            if texels == 0 || width as usize * height as usize != texels {
                return Err(MeshFault::Texture { material: index, texels, width, height });
            }
        }
        if self.triangles.is_empty() {
            return Err(MeshFault::NoTriangle);
        }
        let materials = self.materials.len();
        for (index, triangle) in self.triangles.iter().enumerate() {
            let corners = triangle.corners;
            if let Some(&found) = corners.iter().find(|&&corner| corner as usize >= wanted) {
                return Err(MeshFault::NoSuchVertex { triangle: index, found, vertices: wanted });
            }
            if triangle.material as usize >= materials {
                let found = triangle.material;
                return Err(MeshFault::NoSuchMaterial { triangle: index, found, materials });
            }
        }
        Ok(())
    }
}

impl Mesh {
    /// Checks that some triangle has an area, so that there is something to draw.
    pub(super) fn check_area(&self) -> Result<(), MeshFault> {
        let has_area = self.triangles.iter().any(|triangle| {
            let [a, b, c] =
                triangle.corners.map(|corner| Vec3::from(self.positions[corner as usize]));
            (b - a).cross(c - a).try_normalize().is_some()
        });
        if has_area { Ok(()) } else { Err(MeshFault::NoArea) }
    }
}

fn check_finite<const N: usize>(what: &'static str, values: &[[f32; N]]) -> Result<(), MeshFault> {
    match values.iter().position(|value| value.iter().any(|number| !number.is_finite())) {
        None => Ok(()),
        Some(vertex) => Err(MeshFault::NotFinite { vertex, what, found: values[vertex].to_vec() }),
    }
}

impl Mesh {
    /// Numbers the distinct positions from 0. Returns this number for every vertex, and how many
    /// distinct positions there are.
    pub(super) fn weld(&self) -> (Vec<u32>, usize) {
        // Adding 0 turns -0 into 0.
        let bits = |at: u32| self.positions[at as usize].map(|value| (value + 0.0).to_bits());
        let mut order: Vec<u32> = (0..self.positions.len() as u32).collect();
        order.par_sort_unstable_by_key(|&at| (bits(at), at));
        let mut welded = vec![0; order.len()];
        let mut count = 0;
        for (i, &at) in order.iter().enumerate() {
            count += u32::from(i > 0 && bits(order[i - 1]) != bits(at));
            welded[at as usize] = count;
        }
        let count = if order.is_empty() { 0 } else { count as usize + 1 };
        (welded, count)
    }

    /// Whether the surface is watertight and oriented outwards. For this, every edge is used
    /// equally often in both directions, and the enclosed volume is positive.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let (welded, _) = self.weld();
        let mut edges: Vec<[u32; 3]> = Vec::with_capacity(3 * self.triangles.len());
        for triangle in &self.triangles {
            let [a, b, c] = triangle.corners.map(|corner| welded[corner as usize]);
            // Lower vertex first. The third entry is the direction of travel.
            fn edge(from: u32, to: u32) -> [u32; 3] {
                [from.min(to), from.max(to), u32::from(from < to)]
            }
            edges.extend([edge(a, b), edge(b, c), edge(c, a)].into_iter().filter(|e| e[0] != e[1]));
        }
        edges.par_sort_unstable();
        let balanced = edges.chunk_by(|a, b| a[..2] == b[..2]).all(|edge| {
            2 * edge.iter().filter(|[.., direction]| *direction == 1).count() == edge.len()
        });
        balanced && self.volume() > 0.0
    }

    /// Six times the enclosed volume. This is negative if the mesh is inside out.
    fn volume(&self) -> f64 {
        let first = self.positions.first().copied().unwrap_or_default().map(f64::from);
        let volumes = self.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.corners.map(|corner| {
                let position = self.positions[corner as usize];
                [0, 1, 2].map(|axis| f64::from(position[axis]) - first[axis])
            });
            let [x, y, z] =
                [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
            x * c[0] + y * c[1] + z * c[2]
        });
        volumes.sum()
    }
}

impl Mesh {
    /// Computes a normal for every vertex from the adjacent triangles, weighted by the angle at
    /// the vertex (Thuermer and Wuethrich, "Computing vertex normals from polygonal facets",
    /// 1998). Vertices with the same position get the same normal. If a vertex has no triangles,
    /// this gives +y.
    #[must_use]
    pub fn vertex_normals(&self) -> Vec<[f32; 3]> {
        let (welded, count) = self.weld();
        let mut sums = vec![Vec3::ZERO; count];
        for triangle in &self.triangles {
            let at = triangle.corners.map(|corner| Vec3::from(self.positions[corner as usize]));
            let Some(normal) = (at[1] - at[0]).cross(at[2] - at[0]).try_normalize() else {
                continue;
            };
            for i in 0..3 {
                let [here, next, last] = [at[i], at[(i + 1) % 3], at[(i + 2) % 3]];
                let vertex = welded[triangle.corners[i] as usize] as usize;
                sums[vertex] += normal * (next - here).angle_between(last - here);
            }
        }
        let normals: Vec<[f32; 3]> =
            sums.iter().map(|sum| sum.try_normalize().unwrap_or(Vec3::Y).into()).collect();
        welded.iter().map(|&vertex| normals[vertex as usize]).collect()
    }

    /// Normals after `rounds` rounds of averaging each with its neighbours along edges (Bousseau,
    /// Kaplan, Thollot and Sillion 2006, section 3.3). Use this to simplify shading while the
    /// silhouette stays. Vertices with the same position count as one, so texture seams do not
    /// show. If you pass 0 rounds, you get the normals unchanged.
    #[must_use]
    pub fn smoothed_normals(&self, rounds: usize) -> Vec<[f32; 3]> {
        if rounds == 0 {
            return self.normals.clone();
        }
        let (welded, count) = self.weld();
        let triangles = self
            .triangles
            .iter()
            .map(|triangle| triangle.corners.map(|corner: u32| welded[corner as usize]));
        let neighbours = Neighbours::of_triangles(triangles, count);
        let mut normals = vec![Vec3::ZERO; count];
        for (&vertex, &normal) in welded.iter().zip(&self.normals) {
            normals[vertex as usize] += Vec3::from(normal);
        }
        normals.par_iter_mut().for_each(|normal| *normal = normal.normalize_or_zero());
        let mut next = normals.clone();
        for _ in 0..rounds {
            next.par_iter_mut().with_min_len(1 << 10).enumerate().for_each(|(vertex, next)| {
                let around = neighbours.of(vertex).iter();
                let sum: Vec3 = around.map(|&other| normals[other as usize]).sum();
                // Opposite normals cancel out: keep the old one.
                *next = (normals[vertex] + sum).try_normalize().unwrap_or(normals[vertex]);
            });
            std::mem::swap(&mut normals, &mut next);
        }
        welded.iter().map(|&vertex| normals[vertex as usize].into()).collect()
    }
}

impl Mesh {
    /// Returns for every triangle whether its connected part of the mesh is watertight and oriented
    /// outwards. [`Self::is_closed`] reports this for a whole mesh.
    ///
    /// # Panics
    /// If a triangle has a vertex that does not exist. [`Mesh::check`] finds that.
    #[must_use]
    pub fn closed_parts(&self) -> Vec<bool> {
        let (welded, count) = self.weld();
        let corners = self.triangles.iter().map(|triangle| triangle.corners);
        let triangles: Vec<[u32; 3]> =
            corners.map(|corners| corners.map(|corner| welded[corner as usize])).collect();
        let (part_of, parts) = parts(&Neighbours::of_triangles(triangles.iter().copied(), count));
        let mut open = vec![false; parts];
        let mut edges: Vec<[u32; 3]> = Vec::with_capacity(3 * triangles.len());
        for [a, b, c] in &triangles {
            // Lower place first. The third entry is the direction of travel.
            fn edge(from: u32, to: u32) -> [u32; 3] {
                [from.min(to), from.max(to), u32::from(from < to)]
            }
            let all = [edge(*a, *b), edge(*b, *c), edge(*c, *a)];
            edges.extend(all.into_iter().filter(|edge| edge[0] != edge[1]));
        }
        edges.sort_unstable();
        for edge in edges.chunk_by(|a, b| a[..2] == b[..2]) {
            let onwards = edge.iter().filter(|[.., direction]| *direction == 1).count();
            open[part_of[edge[0][0] as usize] as usize] |= 2 * onwards != edge.len();
        }
        let mut volumes = vec![0.0; parts];
        let first = self.positions.first().map_or(DVec3::ZERO, |at| DVec3::from(at.map(f64::from)));
        for (triangle, places) in self.triangles.iter().zip(&triangles) {
            let [a, b, c] = triangle
                .corners
                .map(|corner| DVec3::from(self.positions[corner as usize].map(f64::from)) - first);
            volumes[part_of[places[0] as usize] as usize] += a.cross(b).dot(c);
        }
        triangles
            .iter()
            .map(|places: &[u32; 3]| part_of[places[0] as usize] as usize)
            .map(|part| !open[part] && volumes[part] > 0.0)
            .collect()
    }
}

fn parts(neighbours: &Neighbours) -> (Vec<u32>, usize) {
    let mut part_of = vec![u32::MAX; neighbours.count()];
    let mut parts = 0;
    for first in 0..part_of.len() {
        if part_of[first] != u32::MAX {
            continue;
        }
        part_of[first] = parts;
        let mut waiting = vec![first];
        while let Some(place) = waiting.pop() {
            for &next in neighbours.of(place) {
                if std::mem::replace(&mut part_of[next as usize], parts) != parts {
                    waiting.push(next as usize);
                }
            }
        }
        parts += 1;
    }
    (part_of, parts as usize)
}

#[derive(Debug, Clone)]
pub(super) struct Neighbours {
    starts: Vec<u32>,
    others: Vec<u32>,
}

impl Neighbours {
    pub(super) fn of_triangles(triangles: impl Iterator<Item = [u32; 3]>, count: usize) -> Self {
        let mut edges: Vec<[u32; 2]> = Vec::with_capacity(6 * triangles.size_hint().0);
        for [a, b, c] in triangles {
            edges.extend([[a, b], [b, a], [b, c], [c, b], [c, a], [a, c]]);
        }
        edges.par_sort_unstable();
        edges.dedup();
        edges.retain(|[from, to]| from != to);
        let mut starts = vec![0; count + 1];
        edges.iter().for_each(|[from, _]| starts[*from as usize + 1] += 1);
        for vertex in 0..count {
            starts[vertex + 1] += starts[vertex];
        }
        Self { starts, others: edges.iter().map(|[_, to]| *to).collect() }
    }

    pub(super) fn count(&self) -> usize {
        self.starts.len() - 1
    }

    pub(super) fn of(&self, vertex: usize) -> &[u32] {
        &self.others[self.slots(vertex)]
    }

    /// Range of a vertex's neighbours in a list over all neighbours of all vertices.
    pub(super) fn slots(&self, vertex: usize) -> Range<usize> {
        self.starts[vertex] as usize..self.starts[vertex + 1] as usize
    }

    /// Index of the neighbour `to` of the vertex `from` in a list over all neighbours of all
    /// vertices. `None` if they are not neighbours.
    pub(super) fn slot(&self, from: u32, to: u32) -> Option<usize> {
        let slots = self.slots(from as usize);
        let found = self.others[slots.clone()].binary_search(&to).ok()?;
        Some(slots.start + found)
    }

    pub(super) fn slot_count(&self) -> usize {
        self.others.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::test_shapes::bare;

    #[test]
    fn each_part_is_closed_or_open_for_itself() {
        let sphere = Mesh::sphere(100);
        assert!(sphere.closed_parts().iter().all(|closed| *closed));
        let mut both = sphere.clone();
        let first = both.positions.len() as u32;
        let sheet = bare(&[[5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [5.0, 1.0, 0.0]], &[[0, 1, 2]]);
        both.positions.extend(&sheet.positions);
        let mut triangle = sheet.triangles[0];
        triangle.corners = triangle.corners.map(|corner| corner + first);
        both.triangles.push(triangle);
        let closed = both.closed_parts();
        assert!(closed[..closed.len() - 1].iter().all(|closed| *closed));
        assert!(!closed[closed.len() - 1], "a sheet is open");
    }

    #[test]
    fn a_part_with_a_hole_or_inside_out_is_open() {
        let mut holed = Mesh::sphere(100);
        holed.triangles.pop();
        assert!(holed.closed_parts().iter().all(|closed| !closed));
        let mut inside_out = Mesh::sphere(100);
        inside_out.triangles.iter_mut().for_each(|triangle| triangle.corners.swap(0, 1));
        assert!(inside_out.closed_parts().iter().all(|closed| !closed));
        assert!(Mesh::default().closed_parts().is_empty());
    }
}
