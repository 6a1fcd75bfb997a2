//! A smooth field of lines along a surface.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::evidence::Evidence;
use super::links::Links;
use super::settings::{DirectionFault, DirectionSettings, Guide, Line};
use super::smoothing::smooth_squares;
use super::within::line_within;
use crate::mesh::model::Mesh;
use crate::mesh::places::Places;
use crate::mesh::shape_tensor::{PlaceShape, place_shapes};
use crate::mesh::tangent_plane::TangentPlane;

/// Least smoothing length, as a share of the model's radius: places without curvature
/// take their neighbours' directions through it.
const LEAST_SMOOTHING: f64 = 1e-3;

/// Least length of the part of a guide along the surface, relative to the guide.
const LEAST_ALONG: f64 = 1e-3;

/// A smooth field of tangent directions of arbitrary sign on a mesh, one for every vertex.
///
/// It belongs to the model: it does not depend on a camera, and it turns with the mesh. Only a
/// connected part without any direction in its shape, such as a sphere or a plane, follows a fixed
/// axis (y, or x if its surface faces up), and its poles stay singular.
#[derive(Debug, Clone)]
pub struct DirectionField {
    pub(super) of_vertex: Vec<u32>,
    pub(super) links: Links,
    pub(super) planes: Vec<TangentPlane>,
    /// Squares of the lines at all places, of length 0 to 1.
    pub(super) squares: Vec<DVec2>,
    /// Unit lines at all places.
    pub(super) lines: Vec<DVec3>,
    /// Unit arrows of guides, at the places that have one.
    pub(super) guided: Vec<Option<DVec3>>,
}

/// A surface, from which evidence is found.
struct Base<'a> {
    of_vertex: &'a [u32],
    shapes: Vec<PlaceShape>,
    radius: f64,
    links: Links,
    planes: Vec<TangentPlane>,
    fixed: Vec<bool>,
}

impl DirectionField {
    /// The field along the principal directions of the mesh's curvature
    /// ([`Mesh::curvatures`]), smoothed over `settings.smoothing` as lines of two-fold
    /// symmetry. A direction counts by the difference between the absolute values of both
    /// curvatures times the model's radius; where they are equal the neighbours decide. Vertices
    /// with a guide have its direction.
    ///
    /// # Errors
    /// [`DirectionFault`] if the smoothing is outside 0..1, or a guide has no such vertex or no part
    /// along the surface there.
    ///
    /// # Panics
    /// If a triangle has a vertex that does not exist, or there are fewer normals than positions;
    /// [`Mesh::check`] finds both.
    pub fn of_curvature(
        mesh: &Mesh,
        settings: &DirectionSettings,
        guides: &[Guide],
    ) -> Result<Self, DirectionFault> {
        Self::found(mesh, settings, guides, |base| {
            let mut evidence = Evidence::of_curvature(&base.shapes, base.radius, settings.along);
            evidence.add_axes(&base.links, &base.planes, &base.shapes, &base.fixed);
            evidence
        })
    }

    /// The field through given lines, one for each vertex, smoothed over `settings.smoothing`. A
    /// line counts by its weight and the area around its vertex; where weights are 0 the neighbours
    /// decide. Vertices with a guide have its direction.
    ///
    /// # Errors
    /// Those of [`Self::of_curvature`].
    ///
    /// # Panics
    /// Those of [`Self::of_curvature`], or if there are fewer lines than vertices.
    pub fn of_lines(
        mesh: &Mesh,
        lines: &[Line],
        settings: &DirectionSettings,
        guides: &[Guide],
    ) -> Result<Self, DirectionFault> {
        Self::found(mesh, settings, guides, |base| {
            let mut evidence =
                Evidence::of_lines(base.of_vertex, &base.planes, &base.shapes, lines);
            evidence.add_axes(&base.links, &base.planes, &base.shapes, &base.fixed);
            evidence
        })
    }

    fn found(
        mesh: &Mesh,
        settings: &DirectionSettings,
        guides: &[Guide],
        evidence: impl FnOnce(&Base<'_>) -> Evidence,
    ) -> Result<Self, DirectionFault> {
        if !(0.0..=1.0).contains(&settings.smoothing) {
            return Err(DirectionFault::Smoothing { found: settings.smoothing });
        }
        let places = Places::of(mesh, settings.normal_rounds);
        let normals = places.normals.par_iter();
        let planes: Vec<_> = normals.map(|&normal| TangentPlane::of_normal(normal)).collect();
        let (guided, given) = fixed_squares(guides, &places.of_vertex, &planes)?;
        let fixed: Vec<bool> = guided.iter().map(Option::is_some).collect();
        let shapes = place_shapes(&places, &planes);
        let links = Links::new(&places, &planes);
        let radius = places.radius();
        let base = Base { of_vertex: &places.of_vertex, shapes, radius, links, planes, fixed };
        let evidence = evidence(&base);
        let Base { links, planes, fixed, .. } = base;
        let length = radius * settings.smoothing.max(LEAST_SMOOTHING);
        let squares = smooth_squares(&links, &evidence, length * length, &fixed, &given);
        let pairs = squares.par_iter().zip(&planes);
        let lines = pairs.map(|(&square, plane)| line(plane, square)).collect();
        Ok(Self { of_vertex: places.of_vertex, links, planes, squares, lines, guided })
    }

    /// Unit direction at a vertex, of arbitrary sign, perpendicular to its smoothed normal.
    ///
    /// # Panics
    /// If the mesh has no such vertex.
    #[must_use]
    pub fn along(&self, vertex: usize) -> [f32; 3] {
        self.lines[self.of_vertex[vertex] as usize].as_vec3().to_array()
    }

    /// How well the direction at a vertex is determined, 0 to 1: near 0 at singular places, around
    /// which directions cancel out, and far from any evidence.
    ///
    /// # Panics
    /// If the mesh has no such vertex.
    #[must_use]
    pub fn reliability(&self, vertex: usize) -> f32 {
        self.squares[self.of_vertex[vertex] as usize].length().min(1.0) as f32
    }

    /// Unit direction, of arbitrary sign, at a point inside a triangle with these corners, whose
    /// barycentric weights are not negative and add up to 1. But for the sign it is continuous
    /// in the triangle and across its edges, except at singular points.
    ///
    /// # Panics
    /// If the mesh has no such vertices.
    #[must_use]
    pub fn within(&self, corners: [u32; 3], weights: [f32; 3]) -> [f32; 3] {
        let places = corners.map(|corner| self.of_vertex[corner as usize] as usize);
        let normals = places.map(|place| self.planes[place].normal);
        let lines = places.map(|place| self.lines[place]);
        line_within(normals, lines, weights.map(f64::from)).as_vec3().to_array()
    }
}

/// Line with this square; a projected axis where nothing determines it.
fn line(plane: &TangentPlane, square: DVec2) -> DVec3 {
    let axis = plane.projected(DVec3::Y);
    plane.along(if square == DVec2::ZERO { axis.rotate(axis) } else { square })
}

/// The unit arrows of guides at the places that they fix, and their unit squares.
fn fixed_squares(
    guides: &[Guide],
    of_vertex: &[u32],
    planes: &[TangentPlane],
) -> Result<(Vec<Option<DVec3>>, Vec<DVec2>), DirectionFault> {
    let mut fixed = vec![None; planes.len()];
    let mut given = vec![DVec2::ZERO; planes.len()];
    for (index, guide) in guides.iter().enumerate() {
        let Some(&place) = of_vertex.get(guide.vertex as usize) else {
            let vertices = of_vertex.len();
            return Err(DirectionFault::NoSuchVertex {
                guide: index,
                found: guide.vertex,
                vertices,
            });
        };
        let off =
            DirectionFault::OffSurface { guide: index, vertex: guide.vertex, found: guide.along };
        let along = DVec3::from(guide.along.map(f64::from)).try_normalize().ok_or(off.clone())?;
        let flat = planes[place as usize].projected(along);
        if flat.length() <= LEAST_ALONG {
            return Err(off);
        }
        let unit = flat.normalize();
        fixed[place as usize] = Some(along);
        given[place as usize] = unit.rotate(unit);
    }
    Ok((fixed, given))
}
