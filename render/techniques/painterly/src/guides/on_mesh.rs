//! Guides laid on a model.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, Vec3};
use graphics::camera::Camera;
use graphics::mesh::{Guide, Mesh};
use graphics::surface::{NO_TRIANGLE, VisibilityBuffer, visible};

use super::error::{GuideFault, GuidesError};
use super::lines::Guides;
use super::walk::{Step, steps};

/// Half the length in pixels over which the direction of a line is taken.
const HALF_STEP_PX: f64 = 0.05;

/// Least length of the part of a direction along the surface, relative to the direction.
const LEAST_ALONG: f32 = 0.05;

/// A model as a camera sees it.
struct View<'a> {
    mesh: &'a Mesh,
    visible: VisibilityBuffer,
    eye: DVec3,
    /// The camera's axes to the right and up, as long as half the picture at distance 1, and the
    /// viewing direction.
    axes: [DVec3; 3],
}

impl Guides {
    /// Lays the guides on the surface of `mesh` that `camera` sees in a picture of `size_px`. In
    /// steps of at most 1 px a direction is given to the nearest corner of the triangle seen there;
    /// directions of one line at one vertex are averaged. Lines have gaps where nothing is seen.
    ///
    /// # Errors
    /// [`GuidesError`] if the guides are not on their picture, see [`Self::check`], or a guide sees
    /// nothing of the mesh.
    ///
    /// # Panics
    /// If a triangle has a vertex that does not exist, or there are fewer normals than positions;
    /// [`Mesh::check`] finds both.
    pub fn on_mesh(&self, mesh: &Mesh, camera: &Camera) -> Result<Vec<Guide>, GuidesError> {
        self.check()?;
        let view = View::new(mesh, camera, self.size_px);
        let mut guides = Vec::new();
        for (index, line) in self.lines.iter().enumerate() {
            let laid = view.laid(line);
            if laid.is_empty() {
                return Err(self.fault(index, GuideFault::OffMesh));
            }
            guides.extend(laid);
        }
        Ok(guides)
    }
}

impl<'a> View<'a> {
    fn new(mesh: &'a Mesh, camera: &Camera, size_px: [u32; 2]) -> Self {
        let [width, height] = size_px.map(|side| side as usize);
        let up_by = (f64::from(camera.field_of_view_deg).to_radians() / 2.0).tan();
        let right_by = up_by * width as f64 / height as f64;
        let [right, up, back] = camera.axes().map(|axis| axis.as_dvec3());
        Self {
            mesh,
            visible: visible(mesh, camera, width, height),
            eye: camera.eye.as_dvec3(),
            axes: [right * right_by, up * up_by, -back],
        }
    }

    /// One guide for each vertex nearest to a line, by vertex.
    fn laid(&self, line: &[[f64; 2]]) -> Vec<Guide> {
        let mut sums: BTreeMap<u32, DVec3> = BTreeMap::new();
        for (vertex, along) in steps(line, DVec2::ONE).filter_map(|step| self.direction(step)) {
            *sums.entry(vertex).or_default() += along;
        }
        let guides = sums.into_iter().filter_map(|(vertex, sum)| {
            // Opposite directions of a line that turns back cancel out.
            let along = sum.try_normalize()?.as_vec3();
            let normal = Vec3::from(self.mesh.normals[vertex as usize]).normalize_or_zero();
            let flat = along - normal * along.dot(normal);
            (flat.length() > LEAST_ALONG).then(|| Guide { vertex, along: along.to_array() })
        });
        guides.collect()
    }

    /// The vertex nearest to the surface point of a step, and the unit direction of the line over
    /// the triangle there. The plane of the triangle is met, not the next surface point, so that a
    /// step over an edge to another surface has no direction towards it.
    fn direction(&self, step: Step) -> Option<(u32, DVec3)> {
        let fragment = self.visible[(step.at.x as usize, step.at.y as usize)];
        if fragment.triangle == NO_TRIANGLE {
            return None;
        }
        let corners = self.mesh.triangles[fragment.triangle as usize].corners;
        let places =
            corners.map(|corner| Vec3::from(self.mesh.positions[corner as usize]).as_dvec3());
        let [from, at, to] = [-HALF_STEP_PX, 0.0, HALF_STEP_PX]
            .map(|ahead| self.met(places, step.at + ahead * step.along));
        let along = (to? - from?).try_normalize()?;
        let at = at?;
        let distances = places.map(|place| place.distance_squared(at));
        let nearest = [1, 2].into_iter().fold(0, |nearest, corner| {
            if distances[corner] < distances[nearest] { corner } else { nearest }
        });
        Some((corners[nearest], along))
    }

    /// The point in the plane of a triangle that is seen at a place of the picture.
    fn met(&self, [a, b, c]: [DVec3; 3], at: DVec2) -> Option<DVec3> {
        let size = DVec2::new(self.visible.width() as f64, self.visible.height() as f64);
        let DVec2 { x, y } = 2.0 * at / size - 1.0;
        let [right, up, forward] = self.axes;
        let ray = forward + right * x - up * y;
        let normal = (b - a).cross(c - a);
        let distance = normal.dot(a - self.eye) / normal.dot(ray);
        (distance.is_finite() && distance > 0.0).then(|| self.eye + distance * ray)
    }
}

#[cfg(test)]
mod tests;
