//! Which volumes may hold something that a picture shows.

use glam::{Mat4, Vec3};
use graphics::camera::Camera;
use graphics::compute::Image;
use graphics::surface::{Fragment, NO_TRIANGLE, VisibilityBuffer};
use rayon::prelude::*;

use crate::volume::Volume;

/// Sides of a tile in samples.
const TILE: usize = 16;

/// Depths this much apart may be equal but for rounding.
const MARGIN: f32 = 1e-5;

/// The depths that a picture shows, in tiles of samples.
#[derive(Debug)]
pub(super) struct InSight {
    clip_from_model: Mat4,
    /// Width and height in samples.
    size: [f32; 2],
    /// Tiles in a row.
    columns: usize,
    /// Least and greatest seen depth of each tile; none for a picture on a device.
    depths: Option<Vec<[f32; 2]>>,
}

impl InSight {
    /// Of what `camera` sees. The depths of a picture on a device are not looked at.
    pub(super) fn new(camera: &Camera, visible: &Image<Fragment>) -> Self {
        let (width, height) = visible.size();
        let depths = match visible {
            Image::Host(visible) => Some(tiles(visible)),
            Image::Device(_) => None,
        };
        Self {
            clip_from_model: camera.clip_from_model(width as f32 / height as f32),
            size: [width as f32, height as f32],
            columns: width.div_ceil(TILE),
            depths,
        }
    }

    /// Whether a volume may hold something that is seen. It is false only if the box around the
    /// volume meets no tile in which something at its depth is seen.
    pub(super) fn may_hold(&self, volume: &Volume) -> bool {
        let [low, high] = bounds(volume);
        let mut least = Vec3::INFINITY;
        let mut most = Vec3::NEG_INFINITY;
        for corner in 0..8 {
            let at =
                Vec3::from([0, 1, 2].map(|axis: usize| {
                    if corner >> axis & 1 == 0 { low[axis] } else { high[axis] }
                }));
            let clip = self.clip_from_model * at.extend(1.0);
            // Behind the eye there is no place in the picture.
            let before = clip.w > f32::MIN_POSITIVE && clip.is_finite();
            if !before {
                return true;
            }
            let at = clip.truncate() / clip.w;
            (least, most) = (least.min(at), most.max(at));
        }
        let [width, height] = self.size;
        // A sample more on each side, for corners that are rounded.
        let columns = [(0.5 + 0.5 * least.x) * width - 1.0, (0.5 + 0.5 * most.x) * width + 1.0];
        let rows = [(0.5 - 0.5 * most.y) * height - 1.0, (0.5 - 0.5 * least.y) * height + 1.0];
        if columns[1] < 0.0 || rows[1] < 0.0 || columns[0] > width || rows[0] > height {
            return false;
        }
        let Some(depths) = &self.depths else { return true };
        let range = |[from, to]: [f32; 2], side: f32| {
            let last = (side as usize).saturating_sub(1) / TILE;
            from as usize / TILE..=(to as usize / TILE).min(last)
        };
        let across = range(columns, width);
        let depths_of_row = depths.chunks(self.columns);
        let rows = range(rows, height);
        let rows = depths_of_row.take(rows.end() + 1).skip(*rows.start());
        let mut tiles = rows.flat_map(|row| &row[across.clone()]);
        tiles
            .any(|[nearest, farthest]| *nearest <= most.z + MARGIN && *farthest >= least.z - MARGIN)
    }
}

/// The box around a volume.
fn bounds(volume: &Volume) -> [Vec3; 2] {
    let along = |axis: usize, start: f32, choose: fn(f32, f32) -> f32| {
        volume.particles.places[axis].iter().copied().fold(start, choose)
    };
    let low = [0, 1, 2].map(|axis| along(axis, f32::INFINITY, f32::min));
    let high = [0, 1, 2].map(|axis| along(axis, f32::NEG_INFINITY, f32::max));
    [low, high].map(|corner| volume.center + Vec3::from(corner))
}

/// Least and greatest seen depth of each tile; infinite and minus infinite where nothing is seen.
fn tiles(visible: &VisibilityBuffer) -> Vec<[f32; 2]> {
    let width = visible.width();
    let rows = visible.values().par_chunks(width.max(1) * TILE);
    let tiles = rows.flat_map_iter(|rows| {
        let mut tiles = vec![[f32::INFINITY, f32::NEG_INFINITY]; width.div_ceil(TILE)];
        for row in rows.chunks(width) {
            for (tile, seen) in tiles.iter_mut().zip(row.chunks(TILE)) {
                for fragment in seen.iter().filter(|seen| seen.triangle != NO_TRIANGLE) {
                    *tile = [tile[0].min(fragment.depth), tile[1].max(fragment.depth)];
                }
            }
        }
        tiles
    });
    tiles.collect()
}

#[cfg(test)]
mod tests {
    use graphics::field::Field;
    use graphics::surface::{Count, Crossings, visible};

    use super::*;
    use crate::surfaces::VolumeSurfaces;
    use crate::test_volumes::{bumpy, camera, plane};

    fn count(volume: &Volume, camera: &Camera, seen: &VisibilityBuffer) -> usize {
        let own = VolumeSurfaces::of(std::slice::from_ref(volume));
        let counts: Field<i32> = Crossings::default().sum(&Count, own.closed(), camera, seen);
        counts.values().iter().filter(|&&count| count != 0).count()
    }

    #[test]
    fn a_volume_that_holds_something_seen_is_in_sight() {
        let mut left_out = 0;
        let mut held = 0;
        for (turned, distance) in [(0.0, 6.0), (50.0, 5.0), (85.0, 2.5), (10.0, 0.4)] {
            let camera = camera(turned, distance);
            let seen = visible(&plane(20), &camera, 97, 61);
            let in_sight = InSight::new(&camera, &Image::from(seen.clone()));
            for i in 0..400_u64 {
                let at = |by: u64, most: f32| (i * by % 401) as f32 / 401.0 * most;
                let center = Vec3::new(at(7, 8.0) - 2.0, at(31, 8.0) - 2.0, at(97, 3.0) - 1.5);
                let volume = bumpy(center, 0.1 + at(13, 0.5), 1, i);
                let holds = count(&volume, &camera, &seen) > 0;
                let kept = in_sight.may_hold(&volume);
                assert!(kept || !holds, "{turned}: volume {i} at {center}");
                left_out += usize::from(!kept);
                held += usize::from(holds);
            }
        }
        assert!(left_out > 800 && held > 50, "{left_out} {held}");
    }

    #[test]
    fn without_depths_a_volume_in_the_picture_is_in_sight() {
        let camera = camera(0.0, 6.0);
        let seen = visible(&plane(4), &camera, 97, 61);
        let whole = InSight::new(&camera, &Image::from(seen));
        let without = InSight { depths: None, ..whole };
        let ball = |x: f32, z: f32| Volume::ball(Vec3::new(x, 2.0, z), 0.3, 1, 1);
        assert!(without.may_hold(&ball(2.0, -1.0)) && !without.may_hold(&ball(12.0, 0.0)));
    }
}
