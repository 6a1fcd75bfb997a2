//! Samples of a surface by their place.

use glam::Vec3;

use crate::wetting::SurfaceSamples;

/// Even samples of the surface of a scene. All slices have the same length.
#[derive(Debug, Clone, Copy)]
pub struct SampledSurface<'a> {
    /// Places in the unit of the scene.
    pub places: &'a [Vec3],
    /// Normals of the triangles that they lie on, of length 1.
    pub normals: &'a [Vec3],
    /// Area that each sample stands for, in the unit of the scene squared.
    pub areas: &'a [f32],
    /// Numbers of the bodies that they lie on, 0 where volumes of all bodies have films.
    pub bodies: &'a [u32],
}

impl<'a> From<&'a SurfaceSamples> for SampledSurface<'a> {
    fn from(samples: &'a SurfaceSamples) -> Self {
        let SurfaceSamples { places, normals, areas, bodies, .. } = samples;
        Self { places, normals, areas, bodies }
    }
}

/// The samples of a surface sorted into cubes, so that those near a place are found quickly.
#[derive(Debug, Clone)]
pub struct SampleLattice {
    side: f32,
    /// Cube of each entry of `order`, along z, y and x, ascending.
    cubes: Vec<[i32; 3]>,
    /// Indices of the samples; those of one cube in ascending order.
    order: Vec<u32>,
    lowest: [i32; 3],
    highest: [i32; 3],
}

impl SampleLattice {
    /// Sorts samples into cubes with this side in the unit of the scene, which should be about as
    /// long as the radius of most volumes. Places that are no numbers count as 0.
    ///
    /// # Panics
    /// If `side` is not above 0.
    #[must_use]
    pub fn of(places: &[Vec3], side: f32) -> Self {
        assert!(side > 0.0, "cubes have a side above 0");
        let mut sorted: Vec<([i32; 3], u32)> =
            places.iter().zip(0..).map(|(&at, index)| (cube(at, side), index)).collect();
        sorted.sort_unstable();
        let [mut lowest, mut highest] = [[i32::MAX; 3], [i32::MIN; 3]];
        for (cube, _) in &sorted {
            lowest = std::array::from_fn(|axis| lowest[axis].min(cube[axis]));
            highest = std::array::from_fn(|axis| highest[axis].max(cube[axis]));
        }
        let (cubes, order) = sorted.into_iter().unzip();
        Self { side, cubes, order, lowest, highest }
    }

    /// Indices of the samples in all cubes that the box around a ball touches, always in the
    /// same order. They may lie outside of the ball.
    pub fn near(&self, center: Vec3, reach: f32) -> impl Iterator<Item = usize> + '_ {
        let low = cube(center - reach, self.side);
        let high = cube(center + reach, self.side);
        let [z, y, x] = std::array::from_fn(|axis| {
            (low[axis].max(self.lowest[axis]), high[axis].min(self.highest[axis]))
        });
        let rows = (z.0..=z.1).flat_map(move |z| (y.0..=y.1).map(move |y| [z, y]));
        rows.flat_map(move |[z, y]| {
            let from = self.cubes.partition_point(|cube| *cube < [z, y, x.0]);
            let row = self.cubes[from..].iter().zip(&self.order[from..]);
            row.take_while(move |(cube, _)| **cube <= [z, y, x.1]).map(|(_, &index)| index as usize)
        })
    }
}

/// The cube of a place along z, y and x.
fn cube(at: Vec3, side: f32) -> [i32; 3] {
    let [x, y, z] = (at / side).floor().to_array();
    [z, y, x].map(|along| along as i32)
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    #[test]
    fn every_sample_in_a_ball_is_found_once() {
        let random = &mut ChaCha8Rng::seed_from_u64(3);
        let mut axis = || random.random_range(-2.0_f32..3.0);
        let places: Vec<Vec3> = (0..3000).map(|_| Vec3::new(axis(), axis(), axis())).collect();
        let lattice = SampleLattice::of(&places, 0.4);
        for reach in [0.0, 0.1, 0.5, 2.0, 100.0] {
            let center = Vec3::new(axis(), axis(), axis());
            let mut found: Vec<usize> = lattice.near(center, reach).collect();
            let held = (0..places.len()).filter(|&i| places[i].distance(center) <= reach);
            for index in held {
                assert!(found.contains(&index), "{reach}: {index}");
            }
            assert!(
                !found
                    .iter()
                    .any(|&i: &usize| (places[i] - center).abs().max_element() > reach + 0.4001),
                "{reach}"
            );
            let count = found.len();
            found.sort_unstable();
            found.dedup();
            assert_eq!(found.len(), count);
        }
        assert_eq!(SampleLattice::of(&[], 1.0).near(Vec3::ZERO, 9.0).count(), 0);
    }
}
