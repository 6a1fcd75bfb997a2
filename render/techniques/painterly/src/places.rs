//! Attributes of a subject at each feature (normal, direction of strokes, colour, detail, region),
//! and the subject laid out for painting: what models and pictures have in common.

use std::sync::Arc;

use glam::{Mat3, Vec2, Vec3};
use graphics::coherence::Feature;
use graphics::field::Field;
use graphics::mesh::{Curvature, DirectionField, FlowField, Mesh};
use graphics::surface::{Fragment, PackedMesh, SurfacePoint};

use super::coloring::Coloring;
use super::regions::RegionMap;
use super::settings::LayerSettings;

/// Rounds of averaging normals before curvature is found.
pub(super) const NORMAL_ROUNDS: usize = 1;

/// The strength of flow rises over this many rings of edges around singular places.
const FADE_RINGS: usize = 2;

/// A point of the subject that carries a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    /// Unit normal, interpolated.
    pub(super) normal: Vec3,
    /// Unit direction of strokes along the surface. It is the direction of flow too.
    pub(super) along: Vec3,
    /// Strength of the flow, 0 to 1.
    pub(super) flow: f32,
    /// Colour without light, encoded sRGB.
    pub(super) color: Vec3,
    /// Curvature of the surface: `d . bend d` along a unit direction d, per unit of the model.
    pub(super) bend: Mat3,
    /// How much strokes of this layer show here, 0 to 1.
    pub(super) detail: f32,
    /// Number of the region.
    pub(super) region: u16,
}

/// The places where you see strokes of a layer.
#[derive(Debug, Clone)]
pub(super) enum Detail {
    Everywhere,
    /// Where the surface bends by a large angle within this length, which is in units of the model.
    /// The settings say how large.
    Bends(f32, LayerSettings),
    /// By a picture of 0 to 1, which is stretched over the texture coordinates.
    Pictured(Field<f32>),
}

/// A subject as the strokes of one layer see it.
#[derive(Debug, Clone)]
pub(super) struct Surface {
    /// The mesh with the normals that light meets.
    pub(super) mesh: Arc<Mesh>,
    /// The mesh with the colours of this layer.
    pub(super) packed: Arc<PackedMesh>,
    pub(super) directions: Arc<Directions>,
    pub(super) detail: Detail,
    pub(super) regions: Arc<RegionMap>,
}

#[derive(Debug)]
pub(super) struct Directions {
    lines: DirectionField,
    arrows: FlowField,
    /// Curvature at each vertex.
    bends: Vec<Mat3>,
    /// Factor of the flow's strength at each vertex.
    strengths: Option<Vec<f32>>,
}

impl Directions {
    /// Strokes along `lines` of a mesh. If you give arrows for its vertices, flow has the sense and
    /// the strength of the arrows, up to 1.
    pub(super) fn new(mesh: &Mesh, lines: DirectionField, given: Option<&[[f32; 3]]>) -> Self {
        let arrows = match given {
            None => lines.oriented(FADE_RINGS),
            Some(given) => lines.oriented_by(given, FADE_RINGS),
        };
        let curvatures = Curvature::of_mesh(mesh, NORMAL_ROUNDS);
        fn along(direction: [f32; 3], curvature: f32) -> Mat3 {
            let direction = Vec3::from(direction);
            Mat3::from_cols_array_2d(&[0, 1, 2].map(|i| (direction * direction[i]).to_array()))
                * curvature
        }
        Self {
            lines,
            arrows,
            bends: curvatures
                .iter()
                .map(|own: &Curvature| {
                    along(own.along_least, own.least) + along(own.along_greatest, own.greatest)
                })
                .collect(),
            strengths: None,
        }
    }

    /// These directions with a factor of the flow's strength, 0 to 1, for each vertex.
    pub(super) fn with_strengths(self, strengths: Vec<f32>) -> Self {
        Self { strengths: Some(strengths), ..self }
    }

    /// The factor of the flow in a triangle.
    fn strength(&self, corners: [u32; 3], weights: [f32; 3]) -> f32 {
        let Some(strengths) = &self.strengths else { return 1.0 };
        (0..3).map(|i| strengths[corners[i] as usize] * weights[i]).sum()
    }
}

impl Directions {
    /// A bound on the curvature in a triangle with these corners, in any direction.
    fn greatest_bend(&self, corners: [u32; 3]) -> f32 {
        corners.map(|corner| size_of(&self.bends[corner as usize])).into_iter().fold(0.0, f32::max)
    }
}

impl Surface {
    pub(super) fn place(&self, feature: &Feature) -> Place {
        let Self { mesh, packed, directions, .. } = self;
        let triangle = mesh.triangles[feature.face as usize];
        let corners = triangle.corners;
        let positions = corners.map(|corner| Vec3::from(mesh.positions[corner as usize]));
        let weights = barycentric(positions, feature.position);
        let [_, second, third] = weights;
        let fragment = Fragment { triangle: feature.face, second, third, depth: 0.0 };
        let point = SurfacePoint::new(packed, fragment);
        let outward = point.normal(feature.position + feature.normal);
        let normal = outward.try_normalize().unwrap_or(feature.normal);
        let line = Vec3::from(directions.lines.within(corners, weights));
        let arrow = Vec3::from(directions.arrows.within(corners, weights));
        let line = if line.dot(arrow) < 0.0 { -line } else { line };
        let along = line.reject_from_normalized(normal);
        let share = Vec2::from([0, 1].map(|axis: usize| {
            let at = corners.map(|corner| mesh.texture_coordinates[corner as usize][axis]);
            (0..3).map(|i| at[i] * weights[i]).sum::<f32>()
        }));
        let bend = directions.bends[corners[0] as usize] * weights[0]
            + directions.bends[corners[1] as usize] * weights[1]
            + directions.bends[corners[2] as usize] * weights[2];
        Place {
            normal,
            along: along.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector()),
            flow: arrow.length().min(1.0) * directions.strength(corners, weights),
            color: point.albedo(),
            bend,
            detail: self.detail.at(share, bend),
            region: self.regions.at(triangle.material, share),
        }
    }

    /// A bound on the curvature around a feature, in any direction.
    pub(super) fn greatest_bend(&self, feature: &Feature) -> f32 {
        self.directions.greatest_bend(self.mesh.triangles[feature.face as usize].corners)
    }
}

impl Detail {
    /// How much strokes show at texture coordinates, where the surface bends like this.
    fn at(&self, share: Vec2, bend: Mat3) -> f32 {
        match self {
            Self::Everywhere => 1.0,
            Self::Bends(length, layers) => layers.shown(size_of(&bend) * length),
            Self::Pictured(field) => interpolated(field, share),
        }
    }
}

/// The root of the sum of squares of a curvature, which is at least the greatest curvature.
fn size_of(bend: &Mat3) -> f32 {
    let squares = [bend.x_axis, bend.y_axis, bend.z_axis].map(Vec3::length_squared);
    squares.iter().sum::<f32>().sqrt()
}

/// The value at a place, 0 to 1 over width and height, between the middles of cells.
pub(super) fn interpolated(field: &Field<f32>, share: Vec2) -> f32 {
    let last = Vec2::new(field.width() as f32 - 1.0, field.height() as f32 - 1.0);
    let at = (share * (last + 1.0) - 0.5).clamp(Vec2::ZERO, last);
    let whole = at.floor();
    let part = at - at.floor();
    let [x, y] = [whole.x as usize, whole.y as usize];
    let [right, below] = [(x + 1).min(field.width() - 1), (y + 1).min(field.height() - 1)];
    let [upper, lower] =
        [y, below].map(|y| field[(x, y)] + (field[(right, y)] - field[(x, y)]) * part.x);
    upper + (lower - upper) * part.y
}

impl Place {
    /// Unit direction along the surface, to the right of strokes that run downwards.
    pub(super) fn across(&self) -> Vec3 {
        self.normal.cross(self.along)
    }
}

/// Barycentric weights, not negative and of sum 1, of a point of a triangle.
fn barycentric([a, b, c]: [Vec3; 3], point: Vec3) -> [f32; 3] {
    let second = b - a;
    let third = c - a;
    let to = point - a;
    let normal = second.cross(third);
    let square = normal.length_squared();
    if square <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let weights = Vec2::new(to.cross(third).dot(normal), second.cross(to).dot(normal)) / square;
    let [second, third] = weights.clamp(Vec2::ZERO, Vec2::ONE).to_array();
    let third = third.min(1.0 - second);
    [1.0 - second - third, second, third]
}

/// The colours of a mesh without light, encoded sRGB, each with its area.
pub(super) fn colors(mesh: &Mesh, packed: &PackedMesh) -> Vec<(Vec3, f64)> {
    mesh.triangles
        .iter()
        .enumerate()
        .map(|(number, triangle): (usize, &graphics::mesh::Triangle)| {
            let [a, b, c] =
                triangle.corners.map(|corner| Vec3::from(mesh.positions[corner as usize]));
            let area = f64::from((b - a).cross(c - a).length()) / 2.0;
            let third = 1.0 / 3.0;
            let triangle = number as u32;
            let middle = Fragment { triangle, second: third, third, depth: 0.0 };
            (SurfacePoint::new(packed, middle).albedo(), area)
        })
        .filter(|(_, area)| area.is_finite())
        .collect()
}

#[derive(Debug)]
pub(super) struct Subject {
    /// The surface of the subject for the strokes of each layer, the lowest first, at least one.
    pub(super) surfaces: Vec<Surface>,
    /// The mesh that hides what lies behind it.
    pub(super) packed: Arc<PackedMesh>,
    /// For each triangle whether its part of the mesh is closed.
    pub(super) closed: Vec<bool>,
    pub(super) coloring: Arc<Coloring>,
    /// L* of the darkest and of the lightest tone, if the subject's lightness decides the tone.
    pub(super) lightness: Option<[f32; 2]>,
    /// Units of the subject along the longer side of a picture in which strokes have the size of the
    /// settings.
    pub(super) units: f32,
    /// We keep strokes up to this many times the density that such a picture needs.
    pub(super) more: f32,
}

#[cfg(test)]
mod tests {
    use super::super::regions::Regions;
    use super::super::settings::Settings;
    use super::*;
    use graphics::coherence::{Features, Hierarchy};
    use graphics::mesh::DirectionSettings;
    use std::sync::Arc;

    #[test]
    fn places_have_the_normals_directions_and_colours_of_the_mesh() {
        let mut mesh = Mesh::sphere(4000);
        let positions = mesh.positions.clone();
        for (color, position) in mesh.colors.iter_mut().zip(&positions) {
            *color = position.map(|value| 0.5 + 0.5 * value);
        }
        let field =
            DirectionField::of_curvature(&mesh, &DirectionSettings::default(), &[]).unwrap();
        let directions = Arc::new(Directions::new(&mesh, field, None));
        let packed = Arc::new(PackedMesh::new(&mesh));
        let settings = Settings::default();
        let regions = RegionMap::of_mesh(&Regions::default(), &mesh, &["m"], &settings).unwrap();
        let mesh = Arc::new(mesh);
        let regions = Arc::new(regions);
        // Half of a radian, over which the ball turns within half a unit, is too little to show.
        let detail = Detail::Bends(0.5, LayerSettings { detail: 0.3, ..settings.layers });
        let surface = Surface { mesh: Arc::clone(&mesh), packed, directions, detail, regions };
        let hierarchy = Hierarchy::new(&mesh);
        let features = Features::new(Arc::new(hierarchy), 1).below(30.0);
        assert!(features.len() > 200, "{}", features.len());
        for feature in &features {
            let place = surface.place(feature);
            assert_eq!((place.detail, place.region), (0.0, 0));
            let outward = feature.position.normalize();
            assert!(place.normal.dot(outward) > 0.999, "{feature:?} {place:?}");
            assert!(place.along.dot(place.normal).abs() < 1e-5);
            assert!((place.across().length() - 1.0).abs() < 1e-5);
            for direction in [place.along, place.across()] {
                assert!((direction.dot(place.bend * direction) - 1.0).abs() < 0.05, "{place:?}");
            }
            let wanted = Vec3::from(mesh.materials[0].color) * (0.5 + 0.5 * feature.position);
            assert!(place.color.distance(wanted) < 0.02, "{place:?} {wanted}");
        }
    }

    #[test]
    fn weights_of_a_point_give_the_point_back() {
        let corners = [Vec3::ZERO, Vec3::new(2.0, 0.5, 0.0), Vec3::new(0.0, 1.0, 3.0)];
        for [b, c] in [[0.2, 0.3], [0.0, 1.0], [0.5, 0.5], [0.0, 0.0]] {
            let point = corners[0] + (corners[1] - corners[0]) * b + (corners[2] - corners[0]) * c;
            let weights = barycentric(corners, point);
            let back: Vec3 = (0..3).map(|i| corners[i] * weights[i]).sum();
            assert!(back.distance(point) < 1e-5, "{weights:?}");
            assert!(weights.iter().all(|weight| *weight >= 0.0));
        }
        assert_eq!(barycentric([Vec3::ONE; 3], Vec3::ONE), [1.0, 0.0, 0.0]);
    }
}
