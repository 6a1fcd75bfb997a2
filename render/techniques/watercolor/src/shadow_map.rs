//! Shadow maps: the surfaces of a model that a distant light sees (Williams 1978). The borders are
//! soft, since we take the share of nearby pixels that are closer to the light (Reeves, Salesin and
//! Cook 1987).

use glam::{Mat4, Vec3};
use graphics::camera::Camera;
use graphics::compute::{Compute, Image};
use graphics::gpu::DeviceError;
use graphics::surface::{Fragment, Model, VisibilityBuffer};

/// Vertical angle of view in degrees of the camera that stands for a distant light. This is narrow,
/// so that the rays are nearly parallel.
const VIEW_DEG: f32 = 4.0;

/// Shadows fade below this cosine of the light, since light that grazes a surface gives it little
/// anyway. About 14 degrees, chosen by eye.
pub(super) const GRAZING: f32 = 0.25;

/// Offset along the normal, and tolerance of distance, of a point in a shadow map, in its
/// pixels: a surface must not cast shadows on itself.
pub(super) const OFFSET_PX: f32 = 1.5;

/// Half the width of the border of a shadow, as a share of the width of the map, and its limits in
/// pixels. Chosen by eye.
const SOFT: f32 = 0.004;
const SOFT_PX: [f32; 2] = [1.0, 8.0];

/// The surfaces that a distant light reaches first.
#[derive(Debug, Clone)]
pub struct ShadowMap {
    /// The surfaces that the light reaches first, on a square grid.
    pub fragments: Image<Fragment>,
    /// The camera in the place of the light.
    pub camera: Camera,
}

/// The measures of a shadow map that shading needs.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShadowView {
    /// From model coordinates to the light's picture, as for a camera.
    pub(super) clip_from_model: Mat4,
    /// Distances of the near and the far plane from the light.
    pub(super) planes: [f32; 2],
    /// Width of a pixel of the map in the unit of the model.
    pub(super) pixel: f32,
    /// Unit vectors to the right and upwards in the map, in model coordinates.
    pub(super) axes: [Vec3; 2],
    /// Half the width of the border of a shadow, in pixels of the map.
    pub(super) soft: usize,
}

impl ShadowMap {
    /// The map of `side` x `side` pixels of `model`, which lies in a sphere. You give the light by
    /// a unit vector towards it, `direction`.
    ///
    /// # Errors
    /// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
    /// processor.
    ///
    /// # Panics
    /// If another form of [`Compute`] made the model.
    pub fn new(
        compute: &mut Compute,
        model: &mut Model,
        direction: Vec3,
        (center, radius): (Vec3, f32),
        side: usize,
    ) -> Result<Self, DeviceError> {
        let radius = if radius > 0.0 { 1.02 * radius } else { 1.0 };
        let distance = radius / (VIEW_DEG / 2.0).to_radians().sin();
        let up = if direction.y.abs() < 0.9 { Vec3::Y } else { Vec3::X };
        let camera = Camera {
            eye: center + direction * distance,
            target: center,
            up,
            field_of_view_deg: VIEW_DEG,
            near: distance - radius,
            far: distance + radius,
        };
        let fragments = model.visible(compute, &camera, side, side)?;
        Ok(Self { fragments, camera })
    }

    pub(super) fn view(&self) -> ShadowView {
        let Camera { near, far, field_of_view_deg, eye, target, up } = self.camera;
        let width = (near + far) * (field_of_view_deg / 2.0).to_radians().tan();
        let side = self.fragments.size().0.max(1) as f32;
        let forward = target - eye;
        let right = forward.cross(up).normalize_or_zero();
        ShadowView {
            clip_from_model: self.camera.clip_from_model(1.0),
            planes: [near, far],
            pixel: width / side,
            axes: [right, right.cross(forward).normalize_or_zero()],
            soft: (SOFT * side).round().clamp(SOFT_PX[0], SOFT_PX[1]) as usize,
        }
    }
}

impl ShadowView {
    /// The share of light, 0 to 1, that reaches a place on a surface: the mean over a square of
    /// the map. `cosine`, above 0, belongs to the angle between `normal` and the light.
    pub(super) fn lit(
        &self,
        map: &VisibilityBuffer,
        place: Vec3,
        normal: Vec3,
        cosine: f32,
    ) -> f32 {
        let clip = self.clip_from_model * (place + normal * (OFFSET_PX * self.pixel)).extend(1.0);
        let side = map.width() as f32;
        let soft = self.soft as f32;
        let x = (clip.x / clip.w + 1.0) / 2.0 * side - 0.5;
        let y = (1.0 - clip.y / clip.w) / 2.0 * side - 0.5;
        if ![x, y].iter().all(|&at| at >= soft && at < side - 1.0 - soft) {
            return 1.0;
        }
        let left = x as usize;
        let top = y as usize;
        let [near, far] = self.planes;
        let distance = clip.w - OFFSET_PX * self.pixel;
        // Depth of the surface here, and its change for a pixel to the right and downwards.
        let scale = near * far / (far - near);
        let depth = far / (far - near) - scale / distance;
        let lean = scale / (distance * distance) * self.pixel / cosine.max(GRAZING);
        let [right, up] = self.axes;
        let [by_column, by_row] = [lean * normal.dot(right), -lean * normal.dot(up)];
        let free = |column: usize, row: usize| {
            let own = depth + by_column * (column as f32 - x) + by_row * (row as f32 - y);
            let first = map[(column, row)].depth;
            if first < 1.0 && first < own { 0.0 } else { 1.0 }
        };
        let columns = left - self.soft..=left + self.soft + 1;
        let rows = top - self.soft..=top + self.soft + 1;
        // Most places lie wholly in the light or in the shadow.
        let [first, last] = [*columns.start(), *columns.end()];
        let [upper, lower] = [*rows.start(), *rows.end()];
        let mut sum = 0.0;
        for row in [upper, top, lower] {
            sum += free(first, row) + free(left, row) + free(last, row);
        }
        if sum == 0.0 || sum == 9.0 {
            return sum / 9.0;
        }
        let a = x - left as f32;
        let b = y - top as f32;
        let mut lit = 0.0;
        for row in rows {
            let mut sum = 0.0;
            for column in columns.clone() {
                sum += border_share(column, [first, last], a) * free(column, row);
            }
            lit += border_share(row, [upper, lower], b) * sum;
        }
        lit / (2.0 * soft + 1.0).powi(2)
    }
}

/// Share of row or column `at` that lies in a square. The square begins at the share `part` of the
/// row or column `first` and ends at the share `part` of `last`.
fn border_share(at: usize, [first, last]: [usize; 2], part: f32) -> f32 {
    match at {
        at if at == first => 1.0 - part,
        at if at == last => part,
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests {
    //! The border of a cast shadow: how light comes back across it.

    use super::{ShadowMap, ShadowView};
    use crate::toon::{Toon, shade_toon};
    use glam::Vec3;
    use graphics::camera::Camera;
    use graphics::compute::Compute;
    use graphics::distant_light::DistantLight;
    use graphics::field::Field;
    use graphics::mesh::{GridSize, Material, Mesh};
    use graphics::surface::{Model, NO_TRIANGLE, PackedMesh, position_at};
    use graphics::tones::ToneRamp;

    const SIZE: (usize, usize) = (400, 400);

    /// Towards the light, so that the shadow of the ball lies beside it on the floor.
    const LIGHT: Vec3 = Vec3::new(0.6, 0.8, 0.0);

    /// A white ball of radius 1 that floats over a white floor at -1.5.
    fn ball_over_floor() -> Mesh {
        let mut mesh = Mesh::sphere(4000);
        mesh.colors.fill([1.0; 3]);
        mesh.materials[0] = Material::plain([1.0; 3]);
        let first = mesh.positions.len();
        mesh.add_grid(GridSize { columns: 9, rows: 9 }, 0, |at| {
            Vec3::new(12.0 * at.x - 6.0, -1.5, 12.0 * at.y - 6.0)
        });
        mesh.normals[first..].fill([0.0, 1.0, 0.0]);
        mesh
    }

    /// Shadows at half the brightness, and nothing else that changes a white surface.
    fn shaded(mesh: &Mesh, camera: &Camera, side: usize) -> (Field<[f32; 4]>, ShadowView) {
        let compute = &mut Compute::cpu();
        let toon = Toon {
            light: DistantLight::WithModel(LIGHT),
            tones: ToneRamp::steps(1, 0.0),
            shadow_color: [0.5; 3],
            ..Toon::default()
        };
        let mut model = Model::new(compute, PackedMesh::new(mesh)).unwrap();
        let [low, high] = mesh.bounds();
        let sphere = ((low + high) / 2.0, low.distance(high) / 2.0);
        let map = ShadowMap::new(compute, &mut model, LIGHT, sphere, side).unwrap();
        let visible = model.visible(compute, camera, SIZE.0, SIZE.1).unwrap();
        let color = shade_toon(compute, &model, &visible, camera, &toon, Some(&map)).unwrap();
        (compute.download(&color).unwrap(), map.view())
    }

    /// For each pixel of the floor the distance of its ray of light from the ball, below 0 where
    /// the ball is in its way, and the share of light that reaches it.
    fn floor(side: usize) -> (Vec<[f32; 2]>, ShadowView) {
        let mesh = ball_over_floor();
        let camera = Camera::framing(mesh.bounds(), 0.0, 65.0, 14.0);
        let (picture, view) = shaded(&mesh, &camera, side);
        let seen = graphics::surface::visible(&mesh, &camera, SIZE.0, SIZE.1);
        let mut found = Vec::new();
        for (fragment, color) in seen.values().iter().zip(picture.values()) {
            if fragment.triangle == NO_TRIANGLE {
                continue;
            }
            let place = position_at(&mesh, *fragment);
            if place.y < -1.499 {
                let away = (place - LIGHT * place.dot(LIGHT)).length() - 1.0;
                found.push([away, 2.0 * color[1] - 1.0]);
            }
        }
        (found, view)
    }

    #[test]
    fn light_comes_back_evenly_over_the_border_of_a_shadow() {
        for (side, soft) in [(1024, 4), (512, 2)] {
            let (found, view) = floor(side);
            assert_eq!(view.soft, soft);
            let half = (soft as f32 + 0.5) * view.pixel;
            // Corners of the square that is averaged reach farther than its sides, and places are
            // lifted by the offset.
            let far = 1.5 * half + 2.0 * view.pixel;
            for [away, lit] in &found {
                let wanted = if *away < 0.0 { 0.0 } else { 1.0 };
                let far_off = away.abs() > far;
                assert!(!far_off || (lit - wanted).abs() < 1e-3, "{side}: {lit} at {away}");
            }
            let means = [-1.0, -0.5, 0.0, 0.5].map(|from: f32| {
                let between = (from * half)..((from + 0.5) * half);
                let lit = found.iter().filter(|[away, _]| between.contains(away));
                let (sum, count) = lit.fold((0.0, 0), |(sum, n), [_, lit]| (sum + lit, n + 1));
                assert!(count > 20, "{side}: {count} pixels from {from}");
                sum / count as f32
            });
            let wanted = [0.125, 0.375, 0.625, 0.875];
            let even = means.iter().zip(wanted).all(|(lit, wanted)| (lit - wanted).abs() < 0.12);
            assert!(even, "{side}: {means:?}");
        }
    }

    #[test]
    fn a_shadow_glazes_white_surfaces_and_leaves_colours_to_their_density() {
        for (own, wanted) in
            [([1.0, 0.8, 0.4], [0.8, 0.64, 0.32]), ([0.9, 0.1, 0.0], [0.9, 0.1, 0.0])]
        {
            let mut mesh = ball_over_floor();
            mesh.materials[0] = Material::plain(own);
            let camera = Camera::framing(mesh.bounds(), 0.0, 65.0, 14.0);
            let (picture, _) = shaded(&mesh, &camera, 512);
            let seen = picture.values().iter().filter(|color| color[3] == 1.0);
            let darkest = seen.min_by(|a, b| a[0].total_cmp(&b[0])).unwrap();
            let near =
                darkest.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-3);
            assert!(near, "{darkest:?} for {wanted:?}");
        }
    }
}
