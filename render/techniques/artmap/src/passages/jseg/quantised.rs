//! Colour classes of a picture: splits along the principal axis, then the means of Lloyd.
//!
//! Deng and Manjunath quantise by peer groups and a generalised Lloyd algorithm. Here the colours
//! are slightly smoothed instead of filtered by peer groups, and the start is deterministic: the
//! class of the largest squared error is halved until there are enough (Wu 1991).

use graphics::blurred;
use graphics::field::Field;
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;

/// Smoothing of the colours, as a standard deviation in pixels.
const SIGMA: f64 = 1.0;

/// Side of the cells of CIELUV in which equal colours are counted together.
const CELL: f32 = 2.0;

/// Number of rounds of Lloyd's algorithm.
const ROUNDS: usize = 8;

/// Colours of one cell of CIELUV.
#[derive(Debug, Clone, Copy)]
struct Bin {
    pixels: f64,
    mean: Vector3<f64>,
}

/// Class of every pixel of a CIELUV picture, below `most` (at most 255).
///
/// Pictures of few colours have fewer classes.
pub(super) fn quantised(luv: &Field<[f32; 3]>, most: usize) -> Field<u8> {
    let smooth = blurred(luv, SIGMA);
    let (bins, bin_of) = binned(&smooth);
    let centers = lloyd(&bins, split(&bins, most));
    let class: Vec<u8> = bins.iter().map(|bin| nearest(&centers, bin.mean) as u8).collect();
    let values = bin_of.into_iter().map(|bin| class[bin as usize]).collect();
    Field::from_values(luv.width(), luv.height(), values)
}

/// The occupied cells of CIELUV, and the cell of each pixel.
fn binned(luv: &Field<[f32; 3]>) -> (Vec<Bin>, Vec<u32>) {
    let cell = |value: f32| ((value / CELL).round() as i32 + 512).clamp(0, 1023) as u64;
    let mut keys: Vec<u64> = (0u64..)
        .zip(luv.values())
        .map(|(pixel, &[l, u, v])| (cell(l) << 52) | (cell(u) << 42) | (cell(v) << 32) | pixel)
        .collect();
    keys.par_sort_unstable();
    let mut bin_of = vec![0; keys.len()];
    let mut bins = Vec::new();
    for same in keys.chunk_by(|one, other| one >> 32 == other >> 32) {
        let mut sum = Vector3::zeros();
        for &key in same {
            let pixel = (key & u64::from(u32::MAX)) as usize;
            bin_of[pixel] = bins.len() as u32;
            sum += Vector3::from(luv.values()[pixel].map(f64::from));
        }
        let pixels = same.len() as f64;
        bins.push(Bin { pixels, mean: sum / pixels });
    }
    (bins, bin_of)
}

/// A class while it is being split: its bins, mean and squared error.
struct Class {
    bins: Vec<Bin>,
    mean: Vector3<f64>,
    scatter: Matrix3<f64>,
}

impl Class {
    fn of(bins: Vec<Bin>) -> Self {
        let pixels: f64 = bins.iter().map(|bin| bin.pixels).sum();
        let sum: Vector3<f64> = bins.iter().map(|bin| bin.mean * bin.pixels).sum();
        let mean = sum / pixels;
        let scatter = bins.iter().fold(Matrix3::zeros(), |scatter, bin| {
            let off = bin.mean - mean;
            scatter + off * off.transpose() * bin.pixels
        });
        Self { bins, mean, scatter }
    }

    /// Both sides of the plane through the mean, across the axis of largest scatter.
    fn halves(self) -> [Vec<Bin>; 2] {
        let eigen = self.scatter.symmetric_eigen();
        let axis = eigen.eigenvectors.column(eigen.eigenvalues.imax()).into_owned();
        let (low, high) =
            self.bins.into_iter().partition(|bin| axis.dot(&(bin.mean - self.mean)) < 0.0);
        [low, high]
    }
}

/// Means of `most` classes at most.
fn split(bins: &[Bin], most: usize) -> Vec<Vector3<f64>> {
    let mut classes = vec![Class::of(bins.to_vec())];
    while classes.len() < most {
        let error = |class: &Class| class.scatter.trace();
        let worst = (0..classes.len())
            .rev()
            .max_by(|&one, &other| error(&classes[one]).total_cmp(&error(&classes[other])));
        let Some(worst) = worst.filter(|&worst| classes[worst].bins.len() > 1) else { break };
        let [low, high] = classes.remove(worst).halves();
        let parts = [low, high].into_iter().filter(|part| !part.is_empty());
        let before = classes.len();
        classes.extend(parts.map(Class::of));
        if classes.len() < before + 2 {
            break;
        }
    }
    classes.into_iter().map(|class| class.mean).collect()
}

/// Means after some rounds in which each bin goes to its nearest mean (Lloyd 1982). Classes that
/// lose all their bins are left out.
fn lloyd(bins: &[Bin], mut centers: Vec<Vector3<f64>>) -> Vec<Vector3<f64>> {
    for _ in 0..ROUNDS {
        let mut sums = vec![(Vector3::zeros(), 0.0); centers.len()];
        for bin in bins {
            let (sum, pixels) = &mut sums[nearest(&centers, bin.mean)];
            *sum += bin.mean * bin.pixels;
            *pixels += bin.pixels;
        }
        let kept = sums.into_iter().filter(|(_, pixels)| *pixels > 0.0);
        centers = kept.map(|(sum, pixels)| sum / pixels).collect();
    }
    centers
}

/// Index of the nearest of `centers`; the first of equally near ones.
fn nearest(centers: &[Vector3<f64>], color: Vector3<f64>) -> usize {
    let apart = |index: usize| (centers[index] - color).norm_squared();
    (0..centers.len()).min_by(|&a, &b| apart(a).total_cmp(&apart(b))).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_of_unlike_colors_are_classes_of_their_own() {
        let colors = [[20.0, 0.0, 0.0], [50.0, 60.0, 10.0], [80.0, -20.0, 40.0]];
        let values = (0..90 * 20).map(|i| colors[(i % 90) / 30]).collect();
        let classes = quantised(&Field::from_values(90, 20, values), 3);
        let found = [15, 45, 75].map(|x| classes[(x, 10)]);
        assert!(found[0] != found[1] && found[1] != found[2] && found[0] != found[2], "{found:?}");
        for (pixel, class) in classes.values().iter().enumerate() {
            // Up to 2 px from an edge the colours are blended by the smoothing.
            let area = pixel % 90 / 30;
            let place = pixel % 30;
            if (3..27).contains(&place) {
                assert_eq!(*class, found[area], "pixel {pixel}");
            }
        }
    }

    #[test]
    fn one_color_is_one_class() {
        let classes = quantised(&Field::filled(30, 20, [40.0, 3.0, 4.0]), 16);
        assert!(classes.values().iter().all(|&class| class == 0), "one class");
    }

    #[test]
    fn rounds_of_lloyd_bring_the_means_nearer_to_the_colors() {
        // Lightness is dense in the dark and sparse in the light.
        let bins: Vec<Bin> = (0..60)
            .map(|i| Bin { pixels: 1.0, mean: Vector3::new(f64::from(i * i) / 36.0, 0.0, 0.0) })
            .collect();
        let error = |centers: &[Vector3<f64>]| -> f64 {
            bins.iter()
                .map(|bin| (centers[nearest(centers, bin.mean)] - bin.mean).norm_squared())
                .sum()
        };
        let start = split(&bins, 6);
        let end = lloyd(&bins, start.clone());
        assert!(error(&end) < error(&start), "{} {}", error(&end), error(&start));
    }

    #[test]
    fn there_are_as_many_classes_as_asked_for() {
        let ramp = (0..200 * 4).map(|i| [(i % 200) as f32 / 2.0, 0.0, 0.0]).collect();
        let classes = quantised(&Field::from_values(200, 4, ramp), 12);
        assert_eq!(classes.values().iter().max(), Some(&11));
    }
}
