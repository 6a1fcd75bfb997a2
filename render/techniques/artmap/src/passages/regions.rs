//! Regions of a picture: the label of each pixel, neighbours, and the joining of neighbours. You
//! can compare colours in CIELUV, and by intensity with its gradient.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap, VecDeque};

use graphics::blurred;
use graphics::field::Field;
use graphics::picture::Picture;
use rayon::prelude::*;
use spectra::color::{Luv, Rgb, RgbSpace};

/// Regions of a picture, from an over-segmentation.
#[derive(Debug, Clone, PartialEq)]
pub struct Regions {
    /// Region of each pixel. Regions count from 0 without gaps, in the order in which regions
    /// first appear row by row.
    pub labels: Field<u32>,
    /// Number of regions.
    pub count: usize,
}

pub(super) fn beside(pixel: u32, width: usize, height: usize) -> impl Iterator<Item = u32> {
    let across = width as u32;
    let x = pixel as usize % width;
    let y = pixel as usize / width;
    let around = [
        (x > 0).then(|| pixel - 1),
        (x + 1 < width).then(|| pixel + 1),
        (y > 0).then(|| pixel - across),
        (y + 1 < height).then(|| pixel + across),
    ];
    around.into_iter().flatten()
}

impl Regions {
    /// Numbers regions anew. Their labels may be any numbers below `labels_below`.
    pub(super) fn numbered(mut labels: Field<u32>, labels_below: usize) -> Self {
        let mut numbers = vec![None; labels_below];
        let mut count = 0;
        for label in labels.values_mut() {
            *label = *numbers[*label as usize].get_or_insert_with(|| {
                count += 1;
                count - 1
            });
        }
        Self { labels, count: count as usize }
    }

    /// The pixels of each region, row by row.
    pub(super) fn pixels(&self) -> Vec<Vec<u32>> {
        let mut pixels = vec![Vec::new(); self.count];
        for (pixel, &label) in (0..).zip(self.labels.values()) {
            pixels[label as usize].push(pixel);
        }
        pixels
    }

    pub(super) fn neighbours(&self) -> Vec<BTreeSet<u32>> {
        let width = self.labels.width();
        let height = self.labels.height();
        let mut neighbours = vec![BTreeSet::new(); self.count];
        for y in 0..height {
            for x in 0..width {
                let own = self.labels[(x, y)];
                let right = (x + 1 < width).then(|| self.labels[(x + 1, y)]);
                let below = (y + 1 < height).then(|| self.labels[(x, y + 1)]);
                for other in [right, below].into_iter().flatten().filter(|&other| other != own) {
                    neighbours[own as usize].insert(other);
                    neighbours[other as usize].insert(own);
                }
            }
        }
        neighbours
    }

    /// Distance of each pixel from the nearest pixel of another region, along rows and columns.
    /// This is 1 at a border, and more inside. The edge of the picture does not count as a border.
    pub(super) fn depths(&self) -> Field<u32> {
        let width = self.labels.width();
        let height = self.labels.height();
        let mut depths = Field::filled(width, height, u32::MAX);
        let labels = self.labels.values();
        let mut queue = VecDeque::new();
        for (pixel, &own) in (0..).zip(labels) {
            if beside(pixel, width, height).any(|other| labels[other as usize] != own) {
                depths.values_mut()[pixel as usize] = 1;
                queue.push_back(pixel);
            }
        }
        while let Some(pixel) = queue.pop_front() {
            let deeper = depths.values()[pixel as usize] + 1;
            for other in beside(pixel, width, height) {
                let depth = &mut depths.values_mut()[other as usize];
                if *depth == u32::MAX {
                    *depth = deeper;
                    queue.push_back(other);
                }
            }
        }
        depths
    }
}

/// Joins neighbours, cheapest first, while their cost is below `limit`. Among equal costs the pair
/// of the smallest labels comes first. A joined region has the summary that `unite` makes of both.
///
/// You pass and get summaries in the order of the labels. Costs must be at least 0.
pub(super) fn joined<T>(
    regions: &Regions,
    summaries: Vec<T>,
    limit: f64,
    cost: impl Fn(&T, &T) -> f64,
    unite: impl Fn(&mut T, T),
) -> (Regions, Vec<T>) {
    let mut summaries: Vec<Option<T>> = summaries.into_iter().map(Some).collect();
    let mut neighbours = regions.neighbours();
    let mut into: Vec<u32> = (0..regions.count as u32).collect();
    let mut versions = vec![0u32; regions.count];
    let mut queue = BinaryHeap::new();
    let offer = |queue: &mut BinaryHeap<_>, versions: &[u32], summaries: &[Option<T>], a, b| {
        let one = u32::min(a, b);
        let other = u32::max(a, b);
        let [i, j] = [one, other].map(|label| label as usize);
        if let (Some(first), Some(second)) = (&summaries[i], &summaries[j]) {
            let cost = cost(first, second);
            if cost < limit {
                // Bits of numbers of at least 0 are in the order of the numbers.
                queue.push(Reverse((cost.to_bits(), one, other, versions[i], versions[j])));
            }
        }
    };
    for (one, around) in (0u32..).zip(&neighbours) {
        for &other in around.iter().filter(|&&other| other > one) {
            offer(&mut queue, &versions, &summaries, one, other);
        }
    }
    while let Some(Reverse((_, one, other, version, other_version))) = queue.pop() {
        let i = one as usize;
        let j = other as usize;
        if versions[i] != version || versions[j] != other_version {
            continue;
        }
        let Some(part) = summaries[j].take() else { continue };
        if let Some(whole) = &mut summaries[i] {
            unite(whole, part);
        }
        versions[i] += 1;
        versions[j] += 1;
        into[j] = one;
        for beyond in std::mem::take(&mut neighbours[j]) {
            neighbours[beyond as usize].remove(&other);
            if beyond != one {
                neighbours[beyond as usize].insert(one);
                neighbours[i].insert(beyond);
            }
        }
        for &beyond in &neighbours[i] {
            offer(&mut queue, &versions, &summaries, one, beyond);
        }
    }
    relabelled(regions, &into, summaries)
}

/// Replaces each label by the one that its region ended in. `into` leads from each label to the
/// smaller one that we joined it to.
fn relabelled<T>(
    regions: &Regions,
    into: &[u32],
    mut summaries: Vec<Option<T>>,
) -> (Regions, Vec<T>) {
    let mut ends = into.to_vec();
    for label in 0..ends.len() {
        ends[label] = ends[ends[label] as usize];
    }
    let values = regions.labels.values();
    let labels = values.iter().map(|&label| ends[label as usize]).collect();
    let width = regions.labels.width();
    let height = regions.labels.height();
    let found = Regions::numbered(Field::from_values(width, height, labels), regions.count);
    // We number labels in the order of first appearance, which is the order of the least labels.
    let kept = summaries.iter_mut().filter_map(Option::take).collect();
    (found, kept)
}

/// We smooth before we take gradients, by this standard deviation in pixels.
const GRADIENT_SIGMA: f64 = 1.0;

/// CIELUV of every pixel, relative to the white of sRGB.
pub(super) fn luv_of(picture: &Picture) -> Field<[f32; 3]> {
    let white = RgbSpace::Srgb.white();
    let xyz = RgbSpace::Srgb.xyz_from_linear();
    mapped(picture, |color| {
        let xyz = xyz.apply(color.map(|value| f64::from(value.max(0.0))));
        Luv::from_xyz(xyz.into(), white).to_array().map(|value| value as f32)
    })
}

/// Intensity of every pixel, 0 to 1. This is luminance encoded by the curve of sRGB.
pub(super) fn intensity_of(picture: &Picture) -> Field<f32> {
    let weights = RgbSpace::Srgb.xyz_from_linear().0[1];
    mapped(picture, |color| {
        let parts = weights.iter().zip(color);
        let luminance: f64 = parts.map(|(weight, value)| weight / 100.0 * f64::from(value)).sum();
        Rgb([luminance.clamp(0.0, 1.0); 3]).encoded().0[0] as f32
    })
}

/// Gradient of the intensity per pixel, to the right and down. We smooth the picture slightly
/// first.
pub(super) fn gradient_of(intensity: &Field<f32>) -> Field<[f32; 2]> {
    let width = intensity.width();
    let height = intensity.height();
    let single = intensity.values().iter().map(|&value| [value]).collect();
    let smooth = blurred(&Field::from_values(width, height, single), GRADIENT_SIGMA);
    let mut gradient = Field::filled(width, height, [0.0; 2]);
    gradient.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
        let above = y.saturating_sub(1);
        let below = (y + 1).min(height - 1);
        for (x, found) in row.iter_mut().enumerate() {
            let left = x.saturating_sub(1);
            let right = (x + 1).min(width - 1);
            // Scharr's weights have the least error in direction (Jaehne 1999).
            fn side([a, b, c]: [(usize, usize); 3], smooth: &Field<[f32; 1]>) -> f32 {
                3.0 * (smooth[a][0] + smooth[c][0]) + 10.0 * smooth[b][0]
            }
            let over_x = side([(right, above), (right, y), (right, below)], &smooth)
                - side([(left, above), (left, y), (left, below)], &smooth);
            let over_y = side([(left, below), (x, below), (right, below)], &smooth)
                - side([(left, above), (x, above), (right, above)], &smooth);
            *found = [over_x / 32.0, over_y / 32.0];
        }
    });
    gradient
}

fn mapped<T: Send>(picture: &Picture, map: impl Fn([f32; 3]) -> T + Sync) -> Field<T> {
    let values = picture.values().par_iter().with_min_len(4096).map(|&color| map(color)).collect();
    Field::from_values(picture.width(), picture.height(), values)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(labels: &[u32]) -> Regions {
        let below = labels.iter().max().map_or(0, |&most| most as usize + 1);
        Regions::numbered(Field::from_values(labels.len(), 1, labels.to_vec()), below)
    }

    #[test]
    fn neighbours_are_joined_cheapest_first_with_means_that_follow() {
        let regions = row(&[0, 1, 2, 3]);
        let sums = vec![(0.0, 1.0), (1.0, 1.0), (2.5, 1.0), (9.0, 1.0)];
        fn apart(a: &(f64, f64), b: &(f64, f64)) -> f64 {
            (a.0 / a.1 - b.0 / b.1).abs()
        }
        fn unite(a: &mut (f64, f64), b: (f64, f64)) {
            *a = (a.0 + b.0, a.1 + b.1);
        }
        // 0 and 1 are joined first. Their mean 0.5 is then 2.0 from the third.
        let (found, sums_found) = joined(&regions, sums.clone(), 1.8, apart, unite);
        assert_eq!(found.labels.values(), [0, 0, 1, 2]);
        assert_eq!(sums_found, [(1.0, 2.0), (2.5, 1.0), (9.0, 1.0)]);
        let (found, _) = joined(&regions, sums, 2.1, apart, unite);
        assert_eq!(found.labels.values(), [0, 0, 0, 1]);
    }

    #[test]
    fn regions_that_do_not_touch_are_not_joined() {
        let regions = row(&[0, 1, 2]);
        let (found, _) =
            joined(&regions, vec![1.0, 5.0, 1.0], 1.0, |a, b| f64::abs(a - b), |_, _| ());
        assert_eq!(found.count, 3);
    }

    #[test]
    fn depth_counts_from_the_border_of_the_region() {
        let regions = row(&[0, 0, 0, 1, 1]);
        assert_eq!(regions.depths().values(), [3, 2, 1, 1, 2]);
    }

    #[test]
    fn white_and_a_middle_grey_have_their_lightness_and_intensity() {
        // Luminance 0.2140 is encoded 0.5 and has L* 53.39.
        let picture = Field::from_values(3, 1, vec![[1.0; 3], [0.214_041; 3], [0.0; 3]]);
        let luv = luv_of(&picture);
        for (x, lightness) in [100.0, 53.389, 0.0].into_iter().enumerate() {
            let [l, u, v] = luv[(x, 0)];
            assert!((l - lightness).abs() < 0.01, "{l}, wanted {lightness}");
            assert!(u.abs() < 0.01 && v.abs() < 0.01, "{u} {v}");
        }
        let intensity = intensity_of(&picture);
        assert!((intensity[(0, 0)] - 1.0).abs() < 1e-6, "{}", intensity[(0, 0)]);
        assert!((intensity[(1, 0)] - 0.5).abs() < 1e-4, "{}", intensity[(1, 0)]);
    }

    #[test]
    fn the_gradient_of_a_ramp_is_its_slope() {
        let values = (0..20 * 20).map(|i| 0.02 * (i % 20) as f32 - 0.01 * (i / 20) as f32);
        let gradient = gradient_of(&Field::from_values(20, 20, values.collect()));
        let [x, y] = gradient[(10, 10)];
        assert!((x - 0.02).abs() < 1e-5 && (y + 0.01).abs() < 1e-5, "{x} {y}");
    }
}
