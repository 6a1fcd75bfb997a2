//! We lay guides on a model, or on a picture of any size.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, Vec3};
use graphics::camera::Camera;
use graphics::mesh::{Guide, Mesh};
use graphics::surface::{NO_TRIANGLE, VisibilityBuffer, visible};

use super::{GuideFault, Guides, GuidesError, Step, steps};

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
    /// steps of at most 1 px, we give a direction to the nearest corner of the triangle that you
    /// see there. We average the directions of one line at one vertex. Lines have gaps where they
    /// meet nothing.
    ///
    /// # Errors
    /// [`GuidesError`] if the guides are not on their picture, see [`Self::check`], or a guide sees
    /// nothing of the mesh.
    ///
    /// # Panics
    /// If a triangle has a vertex that does not exist, or there are fewer normals than positions.
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
    /// the triangle there. We meet the plane of this triangle, not the next surface point, so that
    /// a step over an edge to another surface does not point towards it.
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

/// A place on a guide, and its direction there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GuideSample {
    /// Column in pixels from the left edge.
    pub x: f64,
    /// Row in pixels from the upper edge.
    pub y: f64,
    /// Unit direction to the right and downwards, towards the last point of the line.
    pub along: [f64; 2],
}

impl Guides {
    /// Places along all guides, one after the other, in steps of at most 1 px. You give the size of
    /// a picture, `width` x `height` pixels, and we scale the guides to it.
    ///
    /// # Errors
    /// [`GuidesError`] if the guides are not on their picture, see [`Self::check`].
    pub fn on_picture(&self, width: usize, height: usize) -> Result<Vec<GuideSample>, GuidesError> {
        self.check()?;
        let [own_width, own_height] = self.size_px.map(f64::from);
        let scale = DVec2::new(width as f64 / own_width, height as f64 / own_height);
        let steps = self.lines.iter().flat_map(|line| steps(line, scale));
        Ok(steps
            .map(|step: Step| GuideSample {
                x: step.at.x,
                y: step.at.y,
                along: step.along.to_array(),
            })
            .collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use graphics::camera::Framing;
    use graphics::mesh::{DirectionField, DirectionSettings};
    use graphics::surface::position_at;

    const SIZE: [u32; 2] = [400, 300];

    fn guides(lines: Vec<Vec<[f64; 2]>>) -> Guides {
        Guides {
            file: "g.toml".to_owned(),
            picture: None,
            size_px: SIZE,
            camera: Some([0.0, 0.0, 30.0]),
            lines,
        }
    }

    /// Angle in degrees between two lines.
    fn between(one: Vec3, other: Vec3) -> f32 {
        one.normalize().dot(other.normalize()).abs().min(1.0).acos().to_degrees()
    }

    /// Angles between the field and a straight line over the ball, all along the line. The direction of
    /// the line is that between surface points 8 px apart.
    fn angles(mesh: &Mesh, camera: &Camera, field: &DirectionField, line: &[[f64; 2]]) -> Vec<f32> {
        let visible = visible(mesh, camera, SIZE[0] as usize, SIZE[1] as usize);
        let seen = |at: DVec2| visible[(at.x as usize, at.y as usize)];
        let steps: Vec<Step> = steps(line, DVec2::ONE).collect();
        steps[8..steps.len() - 8]
            .iter()
            .map(|step: &Step| {
                let ends =
                    [-4.0, 4.0].map(|ahead| position_at(mesh, seen(step.at + ahead * step.along)));
                let here = seen(step.at);
                let weights = [1.0 - here.second - here.third, here.second, here.third];
                let corners = mesh.triangles[here.triangle as usize].corners;
                between(field.within(corners, weights).into(), ends[1] - ends[0])
            })
            .collect()
    }

    #[test]
    fn a_guide_across_a_ball_turns_the_field_along_it() {
        let mesh = Mesh::sphere(5000);
        // In whole pixels, so that ends of 8 px have their direction.
        let line = vec![[120.5, 150.5], [280.5, 150.5]];
        let guides = guides(vec![line.clone()]);
        let camera = guides.camera_around(&mesh.positions).unwrap();
        let settings = DirectionSettings::default();
        let laid = guides.on_mesh(&mesh, &camera).unwrap();
        assert!(laid.len() > 10, "{} vertices", laid.len());
        assert!(laid.iter().all(|guide| guide.along[0] > 0.0), "{laid:?}");
        let free = DirectionField::of_curvature(&mesh, &settings, &[]).unwrap();
        let free = angles(&mesh, &camera, &free, &line);
        assert!(
            free.iter().all(|&angle| angle > 60.0),
            "it runs upwards without the guide: {free:?}"
        );
        let turned = DirectionField::of_curvature(&mesh, &settings, &laid).unwrap();
        let turned = angles(&mesh, &camera, &turned, &line);
        assert!(turned.iter().all(|&angle| angle < 5.0), "{turned:?}");
    }

    #[test]
    fn a_direction_is_that_of_the_line_at_any_angle() {
        let mesh = Mesh::sphere(20_000);
        let camera = guides(Vec::new()).camera_around(&mesh.positions).unwrap();
        for degrees in [0.0_f64, 20.0, 70.0, 130.0, 200.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let middle = [200.0, 150.0];
            let line = [-6.0, 6.0].map(|far| [middle[0] + far * cos, middle[1] + far * sin]);
            let laid = guides(vec![line.to_vec()]).on_mesh(&mesh, &camera).unwrap();
            for Guide { along: [x, y, _], .. } in laid {
                // The middle of the ball faces the camera, y of the picture points down.
                let found = f64::from(-y).atan2(f64::from(x)).to_degrees();
                let off = (found - degrees + 180.0).rem_euclid(360.0) - 180.0;
                assert!(off.abs() < 2.0, "{found} of {degrees} degrees");
            }
        }
    }

    #[test]
    fn a_line_over_an_outline_has_a_gap_and_no_direction_to_what_is_behind() {
        let mut mesh = Mesh::sphere(2000);
        // A second ball far behind the first, to its right.
        let behind = Mesh::sphere(2000);
        let first = mesh.positions.len() as u32;
        mesh.positions
            .extend(behind.positions.into_iter().map(|[x, y, z]: [f32; 3]| [x + 6.5, y, z - 20.0]));
        mesh.normals.extend(behind.normals);
        mesh.triangles.extend(behind.triangles.into_iter().map(|mut triangle| {
            triangle.corners = triangle.corners.map(|corner| corner + first);
            triangle
        }));
        let framing = Framing { azimuth_deg: 0.0, elevation_deg: 0.0, ..Framing::default() };
        let camera = Camera {
            eye: Vec3::new(0.0, 0.0, 6.0),
            target: Vec3::ZERO,
            near: 0.1,
            far: 100.0,
            ..framing.camera(mesh.bounds())
        };
        let laid =
            guides(vec![vec![[20.0, 150.0], [390.0, 150.0]]]).on_mesh(&mesh, &camera).unwrap();
        assert!(laid.iter().any(|guide| guide.vertex < first), "the ball in front");
        assert!(laid.iter().any(|guide| guide.vertex >= first), "the ball behind");
        for Guide { vertex, along } in laid {
            let along = Vec3::from(along);
            let middle = if vertex < first { Vec3::ZERO } else { Vec3::new(6.5, 0.0, -20.0) };
            let out = (Vec3::from(mesh.positions[vertex as usize]) - middle).normalize();
            assert!(along.dot(out).abs() < 0.3, "{along} leaves the surface at {out}");
            let right = (Vec3::from(mesh.positions[vertex as usize]) - camera.eye).cross(Vec3::Y);
            assert!(along.dot(right) > 0.0, "{along} runs back");
        }
    }

    #[test]
    fn guides_off_the_mesh_are_named() {
        let mesh = Mesh::sphere(500);
        let on = vec![[150.0, 150.0], [250.0, 150.0]];
        let guides = guides(vec![on, vec![[2.0, 2.0], [30.0, 2.0]]]);
        let camera = guides.camera_around(&mesh.positions).unwrap();
        let error = guides.on_mesh(&mesh, &camera).unwrap_err();
        assert_eq!(
            error.to_string(),
            "g.toml, guide 2: nothing of the model is seen along the line"
        );
        assert!(documents::hint::Explain::hint(&error).is_some(), "a way out");
    }

    #[test]
    fn places_and_directions_are_scaled_with_the_picture() {
        let guides = Guides {
            file: "g.toml".to_owned(),
            picture: None,
            size_px: [100, 100],
            camera: None,
            lines: vec![vec![[10.0, 10.0], [40.0, 40.0]], vec![[50.0, 90.0], [50.0, 60.0]]],
        };
        let samples = guides.on_picture(200, 100).unwrap();
        // 60 x 30 px are 67.1 px long.
        assert_eq!(samples.len(), 68 + 30);
        let first = samples[0];
        assert!((first.x - 20.44).abs() < 0.01 && (first.y - 10.22).abs() < 0.01, "{first:?}");
        let [x, y] = first.along;
        assert!((y / x - 0.5).abs() < 1e-12 && (x.hypot(y) - 1.0).abs() < 1e-12, "{first:?}");
        let last = samples[97];
        assert_eq!((last.x, last.along), (100.0, [0.0, -1.0]));
        assert!((last.y - 60.5).abs() < 1e-9, "{last:?}");
        let off = Guides { size_px: [40, 100], ..guides };
        assert!(off.on_picture(200, 100).is_err(), "off its picture");
    }
}
