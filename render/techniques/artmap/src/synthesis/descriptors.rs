//! Patches described by few numbers, and the patches most like a given one: the coherence search
//! space of Yan and others (2008, section 4.2), kept as nearest neighbours.
//!
//! A patch is sampled at up to 7 x 7 places after smoothing, and projected onto the principal
//! components of the patches of all samples. Neighbours are found by comparing all descriptors:
//! with some 30 components that is exact and as fast as a tree.

use graphics::blurred;
use graphics::field::Field;
use nalgebra::{DMatrix, SymmetricEigen};
use rayon::prelude::*;

use super::level::{FEATURES, Level};

/// Places along a side at which a patch is sampled.
const SAMPLES: usize = 7;
/// Numbers of a sampled patch.
const NUMBERS: usize = SAMPLES * SAMPLES * FEATURES;
/// Share of the variance that the components keep.
const KEPT: f64 = 0.97;
/// Patches of each sample from which the components are found.
const TRAINED: usize = 600;

/// Principal components of patches of one size.
#[derive(Debug)]
pub(crate) struct PatchSpace {
    patch: usize,
    mean: Vec<f32>,
    /// One unit vector after the other.
    components: Vec<f32>,
}

/// The described patches of one sample.
#[derive(Debug)]
pub(crate) struct Descriptors {
    /// First texel of each patch.
    pub(crate) places: Vec<[u16; 2]>,
    /// Index of the patch at each texel; `u32::MAX` where there is none.
    index: Field<u32>,
    dimensions: usize,
    values: Vec<f32>,
}

/// A patch that resembles another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Link {
    /// First texel of the patch.
    pub(crate) place: [u16; 2],
    /// Mean squared difference of the features of both patches, which have deviation 1.
    pub(crate) distance: f32,
}

impl PatchSpace {
    /// The space of patches of `patch` x `patch` texels of `levels`.
    pub(crate) fn of(levels: &[&Level], patch: usize) -> Self {
        let mut rows: Vec<[f32; NUMBERS]> = Vec::new();
        for level in levels {
            let smooth = smoothed(level, patch);
            let places = level.places(patch);
            let step = places.len().div_ceil(TRAINED).max(1);
            rows.extend(places.iter().step_by(step).map(|&place| sampled(&smooth, place, patch)));
        }
        let count = rows.len().max(1) as f64;
        let mean: Vec<f64> = (0..NUMBERS)
            .map(|i| rows.iter().map(|row| f64::from(row[i])).sum::<f64>() / count)
            .collect();
        // Summed by our own loops: a library's product may round differently on other machines.
        let covariance: Vec<Vec<f64>> = (0..NUMBERS)
            .into_par_iter()
            .map(|i| {
                let mut sums = vec![0.0; NUMBERS];
                for row in &rows {
                    let centred = f64::from(row[i]) - mean[i];
                    let others = row.iter().zip(&mean);
                    for (sum, (value, mean)) in sums.iter_mut().zip(others) {
                        *sum += centred * (f64::from(*value) - mean);
                    }
                }
                sums
            })
            .collect();
        let matrix = DMatrix::from_fn(NUMBERS, NUMBERS, |i, j| covariance[i][j] / count);
        let eigen = SymmetricEigen::new(matrix);
        let mut order: Vec<usize> = (0..NUMBERS).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
        let total: f64 = eigen.eigenvalues.iter().map(|value| value.max(0.0)).sum();
        let mut components = Vec::new();
        let mut kept = 0.0;
        for index in order {
            if kept >= KEPT * total {
                break;
            }
            kept += eigen.eigenvalues[index].max(0.0);
            components.extend(eigen.eigenvectors.column(index).iter().map(|value| *value as f32));
        }
        Self { patch, mean: mean.iter().map(|mean| *mean as f32).collect(), components }
    }

    /// Describes all patches of a sample.
    pub(crate) fn describe(&self, level: &Level) -> Descriptors {
        let smooth = smoothed(level, self.patch);
        let places = level.places(self.patch);
        let mut index = Field::filled(level.mask.width(), level.mask.height(), u32::MAX);
        for (number, &[x, y]) in places.iter().enumerate() {
            index[(usize::from(x), usize::from(y))] = number as u32;
        }
        let dimensions = self.components.len() / NUMBERS;
        let mut values = vec![0.0; dimensions * places.len()];
        if dimensions > 0 {
            values.par_chunks_exact_mut(dimensions).zip(&places).for_each(
                |(values, &place): (&mut [f32], &[u16; 2])| {
                    let mut numbers = sampled(&smooth, place, self.patch);
                    numbers.iter_mut().zip(&self.mean).for_each(|(number, mean)| *number -= mean);
                    for (value, component) in
                        values.iter_mut().zip(self.components.chunks_exact(NUMBERS))
                    {
                        *value = product(&numbers, component);
                    }
                },
            );
        }
        Descriptors { places, index, dimensions, values }
    }
}

impl Descriptors {
    /// Descriptor of the patch that starts at a texel, if there is one.
    pub(crate) fn at(&self, [x, y]: [u16; 2]) -> Option<&[f32]> {
        let x = usize::from(x);
        let y = usize::from(y);
        if x >= self.index.width() || y >= self.index.height() {
            return None;
        }
        let index = self.index[(x, y)];
        (index != u32::MAX).then(|| self.of(index as usize))
    }

    /// The `count` patches most like the one described by `wanted`, nearest first; of equal ones
    /// the first in the sample.
    pub(crate) fn nearest(&self, wanted: &[f32], count: usize) -> Vec<Link> {
        let mut all: Vec<(f32, u32)> = (0..self.places.len())
            .map(|index| (distance(wanted, self.of(index)), index as u32))
            .collect();
        let order = |a: &(f32, u32), b: &(f32, u32)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
        if count < all.len() {
            all.select_nth_unstable_by(count, order);
            all.truncate(count);
        }
        all.sort_unstable_by(order);
        // By reference: collected from the list itself, links would keep the memory of all patches.
        all.iter()
            .map(|&(distance, index): &(f32, u32)| Link {
                place: self.places[index as usize],
                distance,
            })
            .collect()
    }

    fn of(&self, index: usize) -> &[f32] {
        &self.values[index * self.dimensions..][..self.dimensions]
    }
}

/// Mean squared difference of the features of two described patches.
pub(crate) fn distance(a: &[f32], b: &[f32]) -> f32 {
    let mut lanes = [0.0_f32; 8];
    let first = a.chunks_exact(8);
    let second = b.chunks_exact(8);
    let rest = first.remainder().iter().zip(second.remainder());
    let rest: f32 = rest.map(|(a, b)| (a - b) * (a - b)).sum();
    for (a, b) in first.zip(second) {
        for lane in 0..8 {
            lanes[lane] += (a[lane] - b[lane]) * (a[lane] - b[lane]);
        }
    }
    (lanes.iter().sum::<f32>() + rest) / NUMBERS as f32
}

fn product(a: &[f32; NUMBERS], b: &[f32]) -> f32 {
    let mut lanes = [0.0_f32; 4];
    for (a, b) in a.chunks_exact(4).zip(b.chunks_exact(4)) {
        for lane in 0..4 {
            lanes[lane] += a[lane] * b[lane];
        }
    }
    lanes.iter().sum()
}

/// Distance of the places at which a patch is sampled, in texels.
fn stride(patch: usize) -> f64 {
    patch as f64 / SAMPLES.min(patch) as f64
}

fn smoothed(level: &Level, patch: usize) -> Field<[f32; FEATURES]> {
    blurred(&level.features, 0.5 * (stride(patch) - 1.0))
}

fn sampled(smooth: &Field<[f32; FEATURES]>, [x, y]: [u16; 2], patch: usize) -> [f32; NUMBERS] {
    let at = |index: usize| ((index as f64 + 0.5) * patch as f64 / SAMPLES as f64) as usize;
    let mut numbers = [0.0; NUMBERS];
    for (index, values) in numbers.chunks_exact_mut(FEATURES).enumerate() {
        let i = at(index % SAMPLES);
        let j = at(index / SAMPLES);
        values.copy_from_slice(&smooth[(usize::from(x) + i, usize::from(y) + j)]);
    }
    numbers
}
