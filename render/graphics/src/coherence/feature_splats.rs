//! Features of a mesh as a camera sees them, and the splats of feature noise made from them.

use super::depths::DepthTiles;
use super::features::{Density, Feature, Features, InSight};
use super::octaves::{FeatureNoise, Octaves};
use super::projection::Projection;
use super::splat::{Splat, draw_splats, draw_splats_on_tiles};
use crate::compute::{Compute, GreyImage};
use crate::gpu::DeviceError;

impl Features {
    /// The features of `noise` to draw in a projection, hidden ones included. Their order does not
    /// depend on the projection. You pass them to [`draw_splats`]. If more than 16 surfaces lie
    /// behind each other, the finest octaves may be left out.
    #[must_use]
    pub fn splats(&self, projection: &Projection, noise: FeatureNoise) -> Vec<Splat> {
        let octaves = Octaves::new(noise);
        let end = octaves.end();
        let margin_px = octaves.largest_px();
        let in_sight = InSight::new(projection, Density::Screen, end, margin_px);
        self.selected(in_sight, |feature, end, splats| {
            splats.extend(projected(projection, &octaves, feature, end).into_iter().flatten());
        })
    }

    /// Draws `noise` on the surfaces that a projection shows at `depth`. This is [`draw_splats`]
    /// of [`Self::splats`], but the processor leaves out features behind these surfaces early.
    ///
    /// # Errors
    /// [`DeviceError`] if a device has no memory left or was lost, never on the processor.
    ///
    /// # Panics
    /// If another form of [`Compute`] made `depth`.
    pub fn draw(
        &self,
        compute: &mut Compute,
        depth: &GreyImage,
        projection: &Projection,
        noise: FeatureNoise,
    ) -> Result<GreyImage, DeviceError> {
        if let Compute::Gpu(_) = compute {
            return draw_splats(compute, depth, &self.splats(projection, noise));
        }
        let depth = depth.host();
        let surfaces = DepthTiles::new(depth);
        let splats = self.unhidden_splats(projection, noise, &surfaces);
        Ok(draw_splats_on_tiles(depth, &surfaces, &splats).into())
    }

    /// The features of `noise` to draw in a projection, without most of those that `surfaces`
    /// hide.
    fn unhidden_splats(
        &self,
        projection: &Projection,
        noise: FeatureNoise,
        surfaces: &DepthTiles,
    ) -> Vec<Splat> {
        let octaves = Octaves::new(noise);
        let end = octaves.end();
        let margin_px = octaves.largest_px();
        let in_sight = InSight::new(projection, Density::Screen, end, margin_px);
        self.selected(in_sight.before(surfaces, &octaves), |feature, end, splats| {
            let drawn = projected(projection, &octaves, feature, end).into_iter().flatten();
            splats.extend(drawn.filter(|splat| !splat.is_behind(surfaces)));
        })
    }
}

/// 1 for a bump, -1 for a hollow.
fn sign(feature: &Feature) -> f32 {
    if feature.unit(4) < 0.5 { 1.0 } else { -1.0 }
}

/// Draws a feature of a rank below `end` in one octave, or in two while it fades from one to the
/// next.
fn projected(
    projection: &Projection,
    octaves: &Octaves,
    feature: &Feature,
    end: f32,
) -> Option<impl Iterator<Item = Splat>> {
    let at = projection.project(feature.position)?;
    let towards = feature.normal.dot(feature.position - projection.camera.eye);
    // Pixels that one unit of area covers here.
    let focal = projection.focal_px / at.distance;
    let pixels = focal * focal * towards.abs() / at.distance;
    let rank = feature.priority / pixels;
    // The comparison is false for features that we see edge-on, because their rank is NaN or
    // infinite.
    if !(rank < end && at.depth <= 1.0) {
        return None;
    }
    let [slope_x, slope_y] = projection.slope(feature.normal, towards);
    let size = [projection.width, projection.height];
    let sign = sign(feature);
    fn near(at: f32, size: usize, r: f32) -> bool {
        at > -r && at < size as f32 + r
    }
    let parts = octaves
        .parts(rank)
        .filter(move |[radius, _]| near(at.x, size[0], *radius) && near(at.y, size[1], *radius));
    let scale = projection.depth_scale();
    let away = projection.focal_px * at.distance;
    Some(parts.map(move |[radius, amplitude]| Splat {
        x: at.x,
        y: at.y,
        narrowness: 1.0 / radius,
        amplitude: amplitude * sign,
        depth: at.depth,
        slope_x,
        slope_y,
        // This allows for one pixel, and for the curvature of the surface within the radius.
        tightness: 1.0 / (scale * (1.0 + radius / 4.0) / away),
    }))
}

/// A feature as a camera sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeenFeature {
    /// The feature.
    pub feature: Feature,
    /// Distance from the left edge in pixels.
    pub x: f32,
    /// Distance from the upper edge in pixels.
    pub y: f32,
    /// Depth, 0 (near plane) to 1 (far plane).
    pub depth: f32,
    /// Distance in front of the eye along the viewing direction, in the unit of the model.
    pub distance: f32,
    /// Cosine between the normal of its triangle and the direction to the eye, negative on
    /// triangles that face away.
    pub facing: f32,
    /// Density at which it begins to be drawn, in features per pixel of the [`Density`] you asked
    /// for.
    pub rank: f32,
}

impl Features {
    /// The features of ranks below `end` that a projection shows, hidden ones included, up to
    /// `margin_px` beyond the edges. With [`Density::Surface`] the margin counts in pixels of that
    /// density. Their order does not depend on the projection. A rank changes continuously with
    /// the camera. If more than 16 surfaces lie behind each other, features of high ranks may be
    /// left out, so that the picture and not the model bounds their number.
    #[must_use]
    pub fn seen(
        &self,
        projection: &Projection,
        density: Density,
        end: f32,
        margin_px: f32,
    ) -> Vec<SeenFeature> {
        self.seen_where(projection, density, end, margin_px, |_| true)
    }

    /// Like [`Features::seen`], but only the features for which `keep` is true.
    #[must_use]
    pub fn seen_where(
        &self,
        projection: &Projection,
        density: Density,
        end: f32,
        margin_px: f32,
        keep: impl Fn(&SeenFeature) -> bool + Sync,
    ) -> Vec<SeenFeature> {
        let in_sight = InSight::new(projection, density, end, margin_px);
        self.selected(in_sight, |feature, end, seen| {
            seen.extend(see(projection, density, feature).filter(|seen| {
                // This is false for features seen edge-on, because their rank is NaN or infinite.
                seen.rank < end && seen.depth <= 1.0 && keep(seen)
            }));
        })
    }
}

fn see(projection: &Projection, density: Density, feature: &Feature) -> Option<SeenFeature> {
    let at = projection.project(feature.position)?;
    let to_eye = projection.camera.eye - feature.position;
    let towards = feature.normal.dot(to_eye);
    let pixels = match density {
        Density::Screen => {
            let focal = projection.focal_px / at.distance;
            focal * focal * towards.abs() / at.distance
        }
        Density::Facing => (projection.focal_px / at.distance).powi(2),
        Density::Surface { px_per_unit } => px_per_unit * px_per_unit,
    };
    Some(SeenFeature {
        feature: *feature,
        x: at.x,
        y: at.y,
        depth: at.depth,
        distance: at.distance,
        facing: towards / to_eye.length(),
        rank: feature.priority / pixels,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use crate::coherence::depths::depth_field;
    use crate::coherence::hierarchy::Hierarchy;
    use crate::mesh::Mesh;
    use crate::surface::visible;
    use glam::Vec3;
    use std::sync::Arc;

    fn features(mesh: &Mesh) -> Features {
        Features::new(Arc::new(Hierarchy::new(mesh)), 7)
    }

    #[test]
    fn the_density_on_the_screen_does_not_depend_on_distance_or_triangles() {
        let noise = FeatureNoise { largest_px: 16.0, octaves: 2, persistence: 0.5, coverage: 4.0 };
        let mut densities = Vec::new();
        for (triangles, distance) in [(40_000, 2.0), (400, 2.0), (40_000, 9.0), (400, 0.3)] {
            let features = features(&Mesh::sphere(triangles));
            let camera = Camera {
                eye: Vec3::Z * (1.0 + distance),
                target: Vec3::ZERO,
                up: Vec3::Y,
                field_of_view_deg: 5.0,
                near: distance / 2.0,
                far: distance + 1.0,
            };
            // The far plane cuts off the farther half of the sphere.
            let projection = Projection::new(&camera, 400, 400);
            let splats = features.splats(&projection, noise);
            let inside = splats.iter().filter(|splat| {
                splat.narrowness < 1.0 / 12.0
                    && (0.0..400.0).contains(&splat.x)
                    && (0.0..400.0).contains(&splat.y)
            });
            let silhouette =
                (projection.focal_px / ((1.0 + distance).powi(2) - 1.0).sqrt()).min(226.0);
            let area = (std::f32::consts::PI * silhouette * silhouette).min(160_000.0);
            densities.push(inside.count() as f32 * 256.0 / area);
        }
        let mean = densities.iter().sum::<f32>() / densities.len() as f32;
        let even = densities.iter().all(|density| (density / mean - 1.0).abs() < 0.12);
        assert!(even, "{densities:?}");
    }

    #[test]
    fn hidden_features_are_left_out_and_the_noise_stays() {
        let noises = [
            FeatureNoise { largest_px: 30.0, octaves: 3, persistence: 0.6, coverage: 3.0 },
            FeatureNoise { largest_px: 4.0, octaves: 2, persistence: 0.8, coverage: 3.0 },
        ];
        for (mesh, eye) in [
            (Mesh::torus_knot(6000), Vec3::new(0.5, 0.3, 1.6)),
            (Mesh::sphere(900), Vec3::new(0.0, 0.4, 3.0)),
        ] {
            let camera = Camera {
                eye,
                target: Vec3::ZERO,
                up: Vec3::Y,
                field_of_view_deg: 50.0,
                near: 0.05,
                far: 8.0,
            };
            let width = 203;
            let height = 150;
            let projection = Projection::new(&camera, width, height);
            let depth = depth_field(&visible(&mesh, &camera, width, height));
            let surfaces = DepthTiles::new(&depth);
            let features = features(&mesh);
            for noise in noises {
                let all = features.splats(&projection, noise);
                let some = features.unhidden_splats(&projection, noise, &surfaces);
                assert!(some.len() < all.len() * 3 / 4, "{} of {}", some.len(), all.len());
                let mut rest = all.iter();
                assert!(some.iter().all(|splat| rest.any(|other| other == splat)));
                let compute = &mut Compute::cpu();
                let image = depth.clone().into();
                let plain = draw_splats(compute, &image, &all).unwrap();
                let drawn = features.draw(compute, &image, &projection, noise).unwrap();
                let pairs = plain.host().values().iter().zip(drawn.host().values());
                let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
                assert!(worst < 1e-3, "{noise:?}: {worst}");
            }
        }
    }

    #[test]
    fn an_empty_mesh_has_no_features() {
        let features = features(&Mesh::default());
        let camera = Camera::framing(Mesh::sphere(20).bounds(), 0.0, 0.0, 30.0);
        assert_eq!(features.splats(&Projection::new(&camera, 20, 20), FeatureNoise::FLOW), []);
    }

    /// Number of features per pixel of the disc that a sphere covers, seen at two distances.
    fn counts(density: Density) -> [f64; 2] {
        let mesh = Mesh::sphere(4000);
        let features = Features::new(Arc::new(Hierarchy::new(&mesh)), 3);
        [0.0, 15.0].map(|away| {
            let mut camera = Camera::framing(mesh.bounds(), 20.0, 10.0, 20.0);
            let back = (camera.eye - camera.target).normalize();
            camera.eye += back * away;
            camera.far += away;
            let projection = Projection::new(&camera, 200, 200);
            let seen = features.seen(&projection, density, 0.02, 10.0);
            seen.iter().filter(|seen| seen.facing > 0.0).count() as f64
        })
    }

    #[test]
    fn the_rank_keeps_the_density_of_the_picture_or_of_the_surface() {
        let [near, far] = counts(Density::Screen);
        assert!(far < 0.5 * near, "on the screen: {near}, {far}");
        let [near, far] = counts(Density::Facing);
        assert!(far < 0.5 * near, "facing the eye: {near}, {far}");
        let [near, far] = counts(Density::Surface { px_per_unit: 80.0 });
        assert!((far / near - 1.0).abs() < 0.1, "on the surface: {near}, {far}");
    }

    #[test]
    fn ranks_and_places_change_little_with_a_small_turn() {
        let mesh = Mesh::torus_knot(3000);
        let features = Features::new(Arc::new(Hierarchy::new(&mesh)), 3);
        let [before, after] = [30.0, 30.02].map(|azimuth| {
            let camera = Camera::framing(mesh.bounds(), azimuth, 10.0, 30.0);
            let projection = Projection::new(&camera, 200, 200);
            features.seen(&projection, Density::Screen, 0.05, 10.0)
        });
        let mut next = after.iter();
        let mut compared = 0;
        for own in before.iter().filter(|own| own.facing > 0.3 && own.rank < 0.04) {
            let seed = own.feature.seed;
            let then = next.find(|then| then.feature.seed == seed).unwrap();
            assert!((own.rank / then.rank - 1.0).abs() < 0.01, "{own:?} {then:?}");
            assert!((own.x - then.x).abs() < 0.2 && (own.y - then.y).abs() < 0.2);
            compared += 1;
        }
        assert!(compared > 300, "{compared}");
    }
}
