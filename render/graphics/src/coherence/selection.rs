//! The features of a mesh that a sight or a density needs.

use glam::Vec3;
use rayon::prelude::*;

use super::depth_tiles::DepthTiles;
use super::features::{Feature, Features, Half};
use super::hierarchy::Face;
use super::octaves::Octaves;
use super::projection::Projection;

/// Triangles are halved at most this often; f32 cannot represent smaller ones.
const MAX_HALVINGS: u32 = 40;

/// The quantity that the rank of a feature refers to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Density {
    /// Features per pixel of the picture: their density there stays as the model moves away.
    Screen,
    /// Features per pixel that the surface would cover if it faced the eye: dense towards outlines.
    Facing,
    /// Features per square of this many pixels to a unit of the model: their density on the surface
    /// stays.
    Surface {
        /// Pixels to a unit of the model, above 0.
        px_per_unit: f32,
    },
}

/// Selects the features of a noise.
pub(super) trait Select: Sync {
    /// The highest priority that is needed within a sphere; `None` if nothing in it is. With a
    /// `normal`, all of it lies on the plane through the centre with this normal.
    fn needed(&self, center: Vec3, radius: f32, normal: Option<Vec3>) -> Option<f32>;

    /// Whether nothing in a sphere is needed, since surfaces before it hide it. `share` is the area
    /// within the sphere times the highest priority that is needed there.
    fn hidden(&self, _center: Vec3, _radius: f32, _share: f64) -> bool {
        false
    }
}

/// Selects the features that one projection needs.
pub(super) struct InSight<'a> {
    pub(super) projection: &'a Projection,
    /// The quantity that ranks refer to.
    pub(super) density: Density,
    /// Features of this rank and above are not needed.
    pub(super) end: f32,
    /// Viewing direction, of length 1.
    forward: Vec3,
    /// Unit normals, inwards, of the planes through the eye that bound what reaches the picture.
    sides: [Vec3; 4],
    /// How far beyond these planes features may lie, in the unit of the model.
    beyond: f32,
    /// The surfaces that hide others, and the octaves of the features.
    surfaces: Option<(&'a DepthTiles, &'a Octaves)>,
}

/// Selects all features below a priority.
struct Below(f32);

impl<'a> InSight<'a> {
    /// Features of at most this radius in pixels; with a density on the surface, where a unit of
    /// the model has as many pixels as the density says.
    pub(super) fn new(
        projection: &'a Projection,
        density: Density,
        end: f32,
        margin_px: f32,
    ) -> Self {
        let forward = (projection.camera.target - projection.camera.eye).normalize_or_zero();
        let [margin_px, beyond] = match density {
            Density::Screen | Density::Facing => [margin_px, 0.0],
            Density::Surface { px_per_unit } => [0.0, margin_px / px_per_unit],
        };
        let [right, up] = projection.axes();
        let slope = |size: usize| (size as f32 / 2.0 + margin_px) / projection.focal_px;
        let [across, down] = [slope(projection.width), slope(projection.height)];
        let side = |axis: Vec3, slope: f32| (forward * slope - axis).normalize_or_zero();
        let sides = [side(right, across), side(-right, across), side(up, down), side(-up, down)];
        Self { projection, density, end, forward, sides, beyond, surfaces: None }
    }

    /// Without most of the features that `surfaces` hide. Ranks are those of `octaves`.
    pub(super) fn before(mut self, surfaces: &'a DepthTiles, octaves: &'a Octaves) -> Self {
        self.surfaces = Some((surfaces, octaves));
        self
    }
}

impl Select for InSight<'_> {
    fn needed(&self, center: Vec3, radius: f32, normal: Option<Vec3>) -> Option<f32> {
        let projection = self.projection;
        let to = center - projection.camera.eye;
        let along = to.dot(self.forward);
        // On a plane seen at a grazing angle few pixels show much of the surface. The distance
        // of the eye from the plane is the same everywhere on it, except for rounding.
        let towards = match normal {
            Some(normal) => normal.dot(to).abs() + 1e-4 * (to.length() + radius),
            None => to.length() + radius,
        };
        if along + radius < projection.camera.near || along - radius > projection.camera.far {
            return None;
        }
        if self.sides.iter().any(|side| side.dot(to) < -radius - self.beyond) {
            return None;
        }
        let nearest = (along - radius).max(projection.camera.near);
        Some(match self.density {
            Density::Screen => {
                self.end * projection.focal_px * projection.focal_px * towards / nearest.powi(3)
            }
            Density::Facing => self.end * (projection.focal_px / nearest).powi(2),
            Density::Surface { px_per_unit } => self.end * px_per_unit * px_per_unit,
        })
    }

    fn hidden(&self, center: Vec3, radius: f32, share: f64) -> bool {
        let (Some((surfaces, octaves)), projection) = (self.surfaces, self.projection) else {
            return false;
        };
        let to = center - projection.camera.eye;
        let along = to.dot(self.forward);
        let nearest = along - radius;
        // No feature of an area has a lower priority than one feature on all of it.
        let reach = octaves.largest_from((f64::from(self.end) / share) as f32);
        // A feature shows up to twice its tolerance before its surface, and its plane may lean
        // towards the eye.
        let ahead = nearest - nearest / projection.focal_px * (2.0 + 1.5 * reach);
        if ahead <= projection.camera.near {
            return false;
        }
        let [right, up] = projection.axes();
        let limits = |slope: f32, size: usize| {
            let middle = size as f32 / 2.0 + projection.focal_px * slope;
            let around = projection.focal_px * radius * (1.0 + slope.abs()) / nearest + reach;
            [middle - around, middle + around]
        };
        let columns = limits(to.dot(right) / along, projection.width);
        let rows = limits(-to.dot(up) / along, projection.height);
        projection.depth_at(ahead) > surfaces.farthest(columns, rows)
    }
}

impl Select for Below {
    fn needed(&self, _: Vec3, _: f32, _: Option<Vec3>) -> Option<f32> {
        Some(self.0)
    }
}

impl Features {
    /// What `draw` makes of the features that `select` needs, and of some more. Their order does
    /// not depend on the selection.
    pub(super) fn selected<T: Send + Copy>(
        &self,
        select: &impl Select,
        draw: impl Fn(&Feature, &mut Vec<T>) + Sync,
    ) -> Vec<T> {
        let subtrees = self.subtrees.par_iter().map(|&subtree| {
            let mut drawn = Vec::new();
            self.select(select, subtree, &mut |feature| draw(feature, &mut drawn));
            drawn
        });
        let mut drawn = Vec::new();
        for &patch in &self.above {
            draw(&self.of_patches[patch], &mut drawn);
        }
        let subtrees: Vec<_> = subtrees.collect();
        drawn.reserve(subtrees.iter().map(Vec::len).sum());
        subtrees.iter().for_each(|subtree| drawn.extend_from_slice(subtree));
        drawn
    }

    /// All features with a lower priority than this, in an order that does not depend on it.
    #[must_use]
    pub fn below(&self, priority: f32) -> Vec<Feature> {
        self.selected(&Below(priority), |feature, all| {
            if feature.priority < priority {
                all.push(*feature);
            }
        })
    }

    fn select(&self, select: &impl Select, subtree: usize, draw: &mut impl FnMut(&Feature)) {
        let end = self.hierarchy.patches[subtree].end;
        let mut index = subtree;
        while index < end {
            let patch = &self.hierarchy.patches[index];
            // The centre of a patch is that of its box, which lies on no plane of its faces.
            if !wanted(select, patch.center, patch.radius, None, patch.area) {
                index = patch.end;
                continue;
            }
            draw(&self.of_patches[index]);
            if patch.faces.len() == 1 {
                let face = &self.hierarchy.faces[patch.faces.start];
                for half in Half::whole(face, self.seed.child(index as u64)).halves() {
                    halve(select, half, face, face.area / 2.0, draw);
                }
            }
            index += 1;
        }
    }
}

/// Whether features of an `area` within a sphere, and of its parts, are selected.
fn wanted(
    select: &impl Select,
    center: Vec3,
    radius: f32,
    normal: Option<Vec3>,
    area: f64,
) -> bool {
    let share = select.needed(center, radius, normal).map(|needed| f64::from(needed) * area);
    share.is_some_and(|share| share > 1.0 && !select.hidden(center, radius, share))
}

fn halve(
    select: &impl Select,
    half: Half,
    face: &Face,
    area: f64,
    draw: &mut impl FnMut(&Feature),
) {
    let [a, b, c] = half.corners;
    let center = (a + b + c) / 3.0;
    let radius = [a, b, c].map(|at| at.distance_squared(center)).into_iter();
    let radius = radius.fold(0.0, f32::max).sqrt();
    if half.depth > MAX_HALVINGS || !wanted(select, center, radius, Some(face.normal), area) {
        return;
    }
    let halves = half.halves();
    draw(&half.feature(&halves, face, area));
    for half in halves {
        halve(select, half, face, area / 2.0, draw);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::camera::Camera;
    use crate::coherence::hierarchy::Hierarchy;
    use crate::mesh::Mesh;

    #[test]
    fn all_features_below_a_priority_are_found_in_one_order() {
        for triangles in [20, 3000] {
            let hierarchy = Arc::new(Hierarchy::new(&Mesh::sphere(triangles)));
            let area = hierarchy.patches[0].area;
            let features = Features::new(hierarchy, 7);
            let [few, many] = [50.0, 400.0].map(|priority| features.below(priority));
            for (found, priority) in [(&few, 50.0), (&many, 400.0)] {
                let wanted = area * priority;
                let error = (found.len() as f64 - wanted).abs();
                assert!(error < 2.0 * wanted.sqrt(), "{triangles}: {}", found.len());
            }
            let of_many: Vec<u64> =
                many.iter().filter(|own| own.priority < 50.0).map(|own| own.seed).collect();
            let of_few: Vec<u64> = few.iter().map(|own| own.seed).collect();
            assert_eq!(of_few, of_many);
            let mut seeds: Vec<u64> = many.iter().map(|own| own.seed).collect();
            seeds.sort_unstable();
            assert!(seeds.windows(2).all(|pair| pair[0] != pair[1]), "two of one seed");
        }
    }

    #[test]
    fn an_eye_inside_a_mesh_finds_all_features_of_the_picture_and_few_others() {
        let mesh = Mesh::sphere(3000);
        let features = Features::new(Arc::new(Hierarchy::new(&mesh)), 7);
        let eye = Vec3::new(0.1, 0.2, -0.1);
        let camera = Camera {
            eye,
            target: eye + Vec3::new(0.3, 0.1, 1.0),
            near: 0.01,
            ..Camera::framing(mesh.bounds(), 0.0, 0.0, 40.0)
        };
        let size = [160, 120];
        let margin_px = 6.0;
        let end = 0.02;
        let projection = Projection::new(&camera, size[0], size[1]);
        for density in [Density::Screen, Density::Facing, Density::Surface { px_per_unit: 90.0 }] {
            let reaches = |position: Vec3| {
                projection.project(position).is_some_and(|at| {
                    let own = match density {
                        Density::Surface { px_per_unit } => {
                            margin_px * projection.focal_px / (at.distance * px_per_unit)
                        }
                        _ => margin_px,
                    };
                    let inside = |at: f32, size: usize| at > -own && at < size as f32 + own;
                    inside(at.x, size[0]) && inside(at.y, size[1])
                })
            };
            let seen = features.seen(&projection, density, end, margin_px);
            let mut found: Vec<u64> = Vec::new();
            for own in seen.iter().filter(|own| reaches(own.feature.position)) {
                found.push(own.feature.seed);
            }
            // The surface is at least 0.7 in front of the eye where it shows.
            let most = end * (projection.focal_px / 0.7).powi(2) * 1.5;
            let rank = |own: &Feature| {
                let at = projection.project(own.position)?;
                let focal = projection.focal_px / at.distance;
                let towards = own.normal.dot(camera.eye - own.position).abs();
                Some(match density {
                    Density::Screen => own.priority * at.distance / (focal * focal * towards),
                    Density::Facing => own.priority / (focal * focal),
                    Density::Surface { px_per_unit } => own.priority / (px_per_unit * px_per_unit),
                })
            };
            let all = features.below(most);
            let wanted = all.iter().filter(|own| reaches(own.position));
            let wanted = wanted.filter(|own| rank(own).is_some_and(|rank| rank < end));
            let wanted: Vec<u64> = wanted.map(|own| own.seed).collect();
            assert_eq!(found, wanted, "{density:?}");
            assert!(wanted.len() > 100, "{density:?}: {}", wanted.len());
            assert!(seen.len() < 2 * wanted.len(), "{density:?}: {} seen", seen.len());
        }
    }
}
