//! The faces of many volumes in one list, for counting and drawing.

use glam::Vec3;
use graphics::export::{ExportError, ply};
use graphics::mesh::Triangle;
use graphics::surface::ClosedSurfaces;

use crate::volume::Volume;

/// Colours that distinguish regions, encoded sRGB (Okabe and Ito 2008). You can tell them apart
/// with deficient colour vision.
pub const REGIONS: [[f32; 3]; 7] = [
    [0.0, 0.447, 0.698],
    [0.902, 0.624, 0.0],
    [0.0, 0.620, 0.451],
    [0.800, 0.475, 0.655],
    [0.337, 0.706, 0.914],
    [0.835, 0.369, 0.0],
    [0.941, 0.894, 0.259],
];

/// The closed surfaces of volumes as triangles. The material of a triangle is the index of its
/// volume.
#[derive(Debug, Clone, Default)]
pub struct VolumeSurfaces {
    /// Places of the vertices, volume by volume, in the unit of the scene.
    pub vertices: Vec<[f32; 3]>,
    /// The faces, volume by volume, counter-clockwise seen from outside.
    pub triangles: Vec<Triangle>,
}

impl VolumeSurfaces {
    /// The faces of these volumes.
    #[must_use]
    pub fn of(volumes: &[Volume]) -> Self {
        let mut surfaces = Self::default();
        surfaces.update(volumes);
        surfaces
    }

    /// Normals of the vertices, of length 1. Each is the mean of the normals of its faces by area.
    #[must_use]
    pub fn normals(&self) -> Vec<Vec3> {
        let mut normals = vec![Vec3::ZERO; self.vertices.len()];
        for triangle in &self.triangles {
            let corners = triangle.corners.map(|corner| corner as usize);
            let [a, b, c] = corners.map(|corner| Vec3::from(self.vertices[corner]));
            let twice_area = (b - a).cross(c - a);
            for corner in corners {
                normals[corner] += twice_area;
            }
        }
        normals.into_iter().map(Vec3::normalize_or_zero).collect()
    }

    /// Replaces all faces by the faces of these volumes, in the same memory.
    pub fn update(&mut self, volumes: &[Volume]) {
        self.clear();
        for (volume, surface) in volumes.iter().zip(0..) {
            self.add(volume, 1.0, surface);
        }
    }

    /// The surfaces as a list for counting. Pass this to an
    /// [`InsideCounter`](graphics::surface::InsideCounter).
    #[must_use]
    pub fn closed(&self) -> ClosedSurfaces<'_, [f32; 3]> {
        ClosedSurfaces { vertices: &self.vertices, triangles: &self.triangles }
    }

    /// Removes all faces.
    pub fn clear(&mut self) {
        self.vertices.clear();
        self.triangles.clear();
    }

    /// Adds the faces of a volume, scaled about its centre, as the surface with this index.
    pub fn add(&mut self, volume: &Volume, scale: f32, surface: u32) {
        let first = self.vertices.len() as u32;
        let center = volume.center;
        match scale == 1.0 {
            true => self.vertices.extend(volume.vertices()),
            false => self.vertices.extend(
                volume
                    .vertices()
                    .map(|at: [f32; 3]| (center + (Vec3::from(at) - center) * scale).to_array()),
            ),
        }
        let faces = volume.mesh().faces.iter();
        let faces = faces
            .map(|face| Triangle { corners: face.map(|corner| first + corner), material: surface });
        self.triangles.extend(faces);
    }
}

/// A binary PLY file of the surfaces of volumes. Each has the colour of its region.
///
/// # Errors
/// [`ExportError`] for more than 2^31 vertices.
pub fn ply_of(volumes: &[Volume]) -> Result<Vec<u8>, ExportError> {
    let surfaces = VolumeSurfaces::of(volumes);
    let colors = volumes.iter().flat_map(|volume| {
        let color = REGIONS[usize::from(volume.region) % REGIONS.len()];
        std::iter::repeat_n(color, volume.mesh().directions.len())
    });
    let vertices: Vec<_> = surfaces.vertices.iter().copied().zip(colors).collect();
    let faces: Vec<_> = surfaces.triangles.iter().map(|triangle| triangle.corners).collect();
    ply(&vertices, &faces)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_are_those_of_the_volumes_in_their_order() {
        let volumes = [Volume::ball(Vec3::X, 0.5, 1, 0), Volume::ball(Vec3::Y, 0.2, 2, 0)];
        let mut surfaces = VolumeSurfaces::of(&volumes);
        assert_eq!(surfaces.triangles.len(), 80 + 320);
        for triangle in &surfaces.triangles {
            let volume = &volumes[triangle.material as usize];
            for corner in triangle.corners {
                let at = Vec3::from(surfaces.vertices[corner as usize]);
                let distance = at.distance(volume.center) / volume.radius;
                assert!((1.0..1.1).contains(&distance), "{distance}");
            }
        }
        for (normal, at) in surfaces.normals().into_iter().zip(&surfaces.vertices).take(42) {
            let outward = (Vec3::from(*at) - Vec3::X).normalize();
            assert!(normal.dot(outward) > 0.99, "{normal}");
        }
        surfaces.add(&volumes[0], 0.5, 2);
        for at in &surfaces.vertices[42 + 162..] {
            let distance = Vec3::from(*at).distance(volumes[0].center) / volumes[0].radius;
            assert!((0.5..0.55).contains(&distance), "{distance}");
        }
        surfaces.update(&volumes[1..]);
        assert_eq!((surfaces.vertices.len(), surfaces.triangles.len()), (162, 320));
        assert!(surfaces.triangles.iter().all(|triangle| triangle.material == 0));
    }
}
