//! Places strokes on a surface, along the model's own texture coordinates or on three planes. Also
//! how hatching looks.

use glam::{Vec2, Vec3};
use graphics::camera::Camera;
use graphics::surface::{Fragment, PackedMesh};

/// A model has this many tiles of strokes along its longest side, for the three planes.
const TILES: f32 = 2.0;

/// A plane begins to count if its component of the normal reaches this share of the greatest one.
const PLANE_FROM: f32 = 0.8;

/// Strokes follow the surface down to this cosine between sight and surface. Beyond this they lie
/// closer together, as a draughtsman's do towards an outline. They also do not change fast while
/// you turn the model.
const LEAST_COSINE: f32 = 0.58;

/// Coordinates are useful up to this stretch, which is length along u over length along v or the
/// reverse.
const MOST_STRETCH: f32 = 4.0;

/// This share of a model's area must have useful coordinates.
const USEFUL_SHARE: f32 = 0.9;

/// A point of a surface, mapped to the tile of strokes by one plane or by the model's own
/// coordinates. `weight` says how much this mapping counts, 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Patch {
    pub(crate) u: f32,
    pub(crate) v: f32,
    /// Greatest change of 2 u + v from one pixel to the next. The strokes across follow lines on
    /// which 2 u + v is constant. They cross the strokes along at 63 degrees, and the tile still
    /// repeats.
    pub(crate) across_per_px: f32,
    /// Greatest change of v from one pixel to the next.
    pub(crate) v_per_px: f32,
    pub(crate) weight: f32,
}

/// Maps points of a model to the tile of strokes, for the view of a camera.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Placing {
    pub(crate) coordinates: Coordinates,
    pub(crate) eye: Vec3,
    /// Size of a pixel at distance 1 from the eye.
    pub(crate) pixel: f32,
    /// Tiles per unit of the model.
    pub(crate) tiles: f32,
    /// Lowest corner of the model. The tiles of the three planes begin there.
    pub(crate) origin: Vec3,
    /// Cosine and sine of the strokes' angle in the planes.
    pub(crate) turn: Vec2,
}

impl Placing {
    /// The mapping for a picture that is `height_px` pixels high.
    pub(crate) fn new(
        look: &HatchingLook,
        (mesh_is_useful, bounds): (bool, [Vec3; 2]),
        camera: &Camera,
        height_px: usize,
    ) -> Self {
        let by_mesh = if mesh_is_useful { Coordinates::Own } else { Coordinates::ThreePlanes };
        let half = (camera.field_of_view_deg / 2.0).to_radians().tan();
        let longest = (bounds[1] - bounds[0]).max_element();
        Self {
            coordinates: look.coordinates.unwrap_or(by_mesh),
            eye: camera.eye,
            pixel: 2.0 * half / height_px.max(1) as f32,
            tiles: TILES / longest.max(f32::MIN_POSITIVE),
            origin: bounds[0],
            turn: Vec2::from_angle(look.angle_deg.to_radians()),
        }
    }

    /// The patches of a point with a unit normal towards the eye. Unused ones weigh 0. You get the
    /// change across only if strokes are `crossed`.
    #[inline(always)]
    pub(crate) fn patches(
        &self,
        mesh: &PackedMesh,
        fragment: Fragment,
        (position, normal): (Vec3, Vec3),
        crossed: bool,
    ) -> [Patch; 3] {
        let sight = Sight::new(position - self.eye, normal, self.pixel);
        match self.coordinates {
            Coordinates::Own => {
                [own_patch(mesh, fragment, &sight, crossed), Patch::default(), Patch::default()]
            }
            Coordinates::ThreePlanes => self.planes(position, normal, &sight, crossed),
        }
    }

    #[inline(always)]
    fn planes(&self, position: Vec3, normal: Vec3, sight: &Sight, crossed: bool) -> [Patch; 3] {
        let facing = normal.abs();
        let least = PLANE_FROM * facing.max_element();
        let weights = (facing - least).max(Vec3::ZERO);
        let weights = weights / (weights.x + weights.y + weights.z).max(f32::MIN_POSITIVE);
        let at = (position - self.origin) * self.tiles;
        // Strokes fall from right to left on every side of an upright model.
        let planes = [
            (weights.x, -Vec3::Z * side(normal.x), Vec3::Y),
            (weights.y, Vec3::X, -Vec3::Z * side(normal.y)),
            (weights.z, Vec3::X * side(normal.z), Vec3::Y),
        ];
        planes.map(|(weight, right, up): (f32, Vec3, Vec3)| {
            if weight <= 0.0 {
                return Patch::default();
            }
            let along_u = right * self.turn.x + up * self.turn.y;
            let along_v = up * self.turn.x - right * self.turn.y;
            Patch {
                u: along_u.dot(at),
                v: along_v.dot(at),
                across_per_px: if crossed {
                    sight.per_px(2.0 * along_u + along_v) * self.tiles
                } else {
                    0.0
                },
                v_per_px: sight.per_px(along_v) * self.tiles,
                weight,
            }
        })
    }
}

#[inline(always)]
fn side(component: f32) -> f32 {
    if component < 0.0 { -1.0 } else { 1.0 }
}

struct Sight {
    ray: Vec3,
    normal: Vec3,
    /// Cosine between ray and normal. It is negative.
    cosine: f32,
    /// Size of the pixel at the surface, if the surface faced the eye.
    pixel: f32,
}

impl Sight {
    #[inline(always)]
    fn new(from_eye: Vec3, normal: Vec3, pixel: f32) -> Self {
        let distance = from_eye.length();
        let ray = from_eye / distance.max(f32::MIN_POSITIVE);
        let cosine = ray.dot(normal).min(-LEAST_COSINE);
        Self { ray, normal, cosine, pixel: pixel * distance }
    }

    /// Greatest change of a value with this gradient from one pixel to the next, on the surface
    /// that the ray meets.
    #[inline(always)]
    fn per_px(&self, gradient: Vec3) -> f32 {
        let seen = gradient - self.normal * (gradient.dot(self.ray) / self.cosine);
        seen.length() * self.pixel
    }
}

#[inline(always)]
fn own_patch(mesh: &PackedMesh, fragment: Fragment, sight: &Sight, crossed: bool) -> Patch {
    let [a, b, c] = mesh.triangles[fragment.triangle as usize]
        .corners
        .map(|corner| &mesh.vertices[corner as usize]);
    let [to_b, to_c] = [b, c].map(|to| Vec3::from(to.position) - Vec3::from(a.position));
    let [du, dv] = [[b.u - a.u, c.u - a.u], [b.v - a.v, c.v - a.v]];
    let [along_u, along_v] = gradients([to_b, to_c], [du, dv]);
    Patch {
        u: a.u + du[0] * fragment.second + du[1] * fragment.third,
        v: a.v + dv[0] * fragment.second + dv[1] * fragment.third,
        across_per_px: if crossed { sight.per_px(2.0 * along_u + along_v) } else { 0.0 },
        v_per_px: sight.per_px(along_v),
        weight: 1.0,
    }
}

/// Gradients in the plane of a triangle. You give the changes of two values along two of its edges.
/// On a triangle without area the gradients are 0.
#[inline(always)]
fn gradients([to_b, to_c]: [Vec3; 2], changes: [[f32; 2]; 2]) -> [Vec3; 2] {
    let normal = to_b.cross(to_c);
    let area = normal.dot(normal);
    let by = if area > 0.0 { 1.0 / area } else { 0.0 };
    let [of_b, of_c] = [to_c.cross(normal) * by, normal.cross(to_b) * by];
    changes.map(|[second, third]| of_b * second + of_c * third)
}

/// Whether strokes can follow the texture coordinates. For this they must lie on the surface
/// without much stretch nearly everywhere.
#[must_use]
pub fn has_useful_coordinates(mesh: &PackedMesh) -> bool {
    let mut useful = 0.0;
    let mut all = 0.0;
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.corners.map(|corner| &mesh.vertices[corner as usize]);
        let edges = [b, c].map(|to| Vec3::from(to.position) - Vec3::from(a.position));
        let changes = [[b.u - a.u, c.u - a.u], [b.v - a.v, c.v - a.v]];
        let [u, v] = gradients(edges, changes);
        let area = edges[0].cross(edges[1]).length();
        // Squares of the singular values of the map: half the sum, and their product.
        let half = 0.5 * (u.length_squared() + v.length_squared());
        let product = u.length_squared() * v.length_squared() - u.dot(v).powi(2);
        let root = (half * half - product).max(0.0).sqrt();
        all += area;
        if half - root > 0.0 && half + root <= MOST_STRETCH.powi(2) * (half - root) {
            useful += area;
        }
    }
    all > 0.0 && useful >= USEFUL_SHARE * all
}

/// Where strokes lie on surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coordinates {
    /// Along the model's own texture coordinate u. One tile of strokes takes one tile of texture.
    Own,
    /// Projected along the three axes. Each counts where the surface faces it.
    ThreePlanes,
}

/// How hatching looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HatchingLook {
    /// Where strokes lie on surfaces. If you leave this at `None`, we take the model's own texture
    /// coordinates if they are useful ([`super::has_useful_coordinates`]).
    pub coordinates: Option<Coordinates>,
    /// Share of the strokes inside of volumes, 0 to 1. If you pass 0, you see no hatching there.
    pub inside: f32,
    /// Share of the strokes outside of volumes, 0 to 1.
    pub outside: f32,
    /// Factor of the colour under full ink, 0 to 1.
    pub pencil: f32,
    /// Width of a stroke in pixels, 1 to 16. It varies by a third either way.
    pub width_px: f32,
    /// Half the range of tone over which a texel takes ink, 0.01 to 0.15. A greater value is
    /// softer.
    pub softness: f32,
    /// Tone of the darkest shade, 0 to 1. If you pass 0, no paper stays between the strokes.
    pub darkest: f32,
    /// Angle of the strokes in the three planes, in degrees from the horizontal.
    pub angle_deg: f32,
}

impl Default for HatchingLook {
    /// Pencil strokes 2.8 pixels wide that slant like a right hand's.
    fn default() -> Self {
        Self {
            coordinates: None,
            inside: 1.0,
            outside: 1.0,
            pencil: 0.15,
            width_px: 2.8,
            softness: 0.12,
            darkest: 0.15,
            angle_deg: 32.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use graphics::mesh::Mesh;

    fn camera() -> Camera {
        Camera {
            eye: Vec3::Z * 10.0,
            target: Vec3::ZERO,
            up: Vec3::Y,
            field_of_view_deg: 30.0,
            near: 0.1,
            far: 30.0,
        }
    }

    #[test]
    fn strokes_follow_a_plane_as_the_pixels_see_it() {
        let look = HatchingLook { angle_deg: 0.0, ..HatchingLook::default() };
        let bounds = [-Vec3::ONE, Vec3::ONE];
        let placing = Placing::new(&look, (false, bounds), &camera(), 570);
        let mesh = PackedMesh::new(&Mesh::default());
        let fragment = Fragment::EMPTY;
        let [_, _, facing] = placing.patches(&mesh, fragment, (Vec3::ZERO, Vec3::Z), true);
        assert_eq!(facing.weight, 1.0);
        let wanted = 10.0 * 2.0 * 15.0_f32.to_radians().tan() / 570.0;
        assert!((facing.across_per_px / wanted - 5.0_f32.sqrt()).abs() < 1e-4);
        assert!((facing.v_per_px / wanted - 1.0).abs() < 1e-5);
        // A floor that the eye looks down on: depth passes faster.
        let tilted = Vec3::new(0.0, 0.8, 0.6);
        let slope: f32 = 4.0 / 3.0;
        let [_, floor, _] = placing.patches(&mesh, fragment, (Vec3::ZERO, tilted), true);
        assert_eq!(floor.weight, 1.0);
        assert!((floor.across_per_px / wanted - 2.0_f32.hypot(slope)).abs() < 1e-4, "{floor:?}");
        assert!((floor.v_per_px / wanted / slope - 1.0).abs() < 1e-5, "{floor:?}");
        // Planes pass into each other with weights that sum to 1.
        let corner = Vec3::ONE.normalize();
        let weights =
            placing.patches(&mesh, fragment, (Vec3::ZERO, corner), true).map(|at| at.weight);
        assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-6 && weights[0] > 0.3);
    }

    #[test]
    fn coordinates_are_useful_where_they_lie_flat() {
        let mut sheet =
            Mesh { materials: vec![graphics::mesh::Material::plain([1.0; 3])], ..Mesh::default() };
        let cells = graphics::mesh::GridSize { columns: 4, rows: 4 };
        sheet.add_grid(cells, 0, |uv| Vec3::new(uv.x, -uv.y, 0.0));
        assert!(has_useful_coordinates(&PackedMesh::new(&sheet)));
        sheet.texture_coordinates.iter_mut().for_each(|uv| uv[0] *= 5.0);
        assert!(!has_useful_coordinates(&PackedMesh::new(&sheet)));
        sheet.texture_coordinates.iter_mut().for_each(|uv| *uv = [0.0; 2]);
        assert!(!has_useful_coordinates(&PackedMesh::new(&sheet)));
        assert!(!has_useful_coordinates(&PackedMesh::new(&Mesh::default())));
    }
}
