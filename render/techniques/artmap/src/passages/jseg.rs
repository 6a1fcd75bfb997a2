//! JSEG: regions of alike colour and texture (Deng and Manjunath, "Unsupervised segmentation of
//! color-texture regions in images and video", IEEE PAMI 23, 2001).
//!
//! ```text
//! colours -> classes -> J of each pixel in four windows -> valleys -> growing -+-> merging
//!                                      ^                                       |
//!                                      +------------- next window -------------+
//! ```
//!
//! Classes: Deng and Manjunath quantise by peer groups and a generalised Lloyd algorithm. Here we
//! smooth the colours slightly instead of filtering them by peer groups. Our start is
//! deterministic: we halve the class with the largest squared error along its principal axis until
//! there are enough (Wu 1991).
//!
//! J = (S_T - S_W) / S_W. S_T is the scatter of all places about their mean, and S_W the scatter
//! within the classes (equations 1 to 5). Inside a texture the classes are mixed and J is small.
//! At a border of textures it is large.
//!
//! Valleys are the connected pixels of a region with small J. They grow until they fill their
//! region. First, we add parts of small J that touch a single valley to this valley, at the
//! current scale and all finer ones. Then single pixels follow, smallest J at the finest scale
//! first (section IV B). At the end we merge neighbours with similar histograms of colour.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use graphics::blurred;
use graphics::field::Field;
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;

use super::regions::{Regions, beside, joined};

struct Scale {
    /// We look at pixels this far apart. The window is 8 times as wide, plus 1.
    step: usize,
    least_px: usize,
    /// We use this scale if the picture's shorter side is longer than this, in pixels.
    above_px: usize,
}

/// Windows of 65, 33, 17 and 9 pixels (Deng and Manjunath 2001, table I).
const SCALES: [Scale; 4] = [
    Scale { step: 8, least_px: 2048, above_px: 512 },
    Scale { step: 4, least_px: 512, above_px: 256 },
    Scale { step: 2, least_px: 128, above_px: 128 },
    Scale { step: 1, least_px: 32, above_px: 0 },
];

/// Regions of a CIELUV picture, which we quantise to `color_classes` classes at most.
///
/// This is an over-segmentation: we use all scales down to the finest, and merge only neighbours
/// with nearly equal histograms.
pub(crate) fn jseg(luv: &Field<[f32; 3]>, color_classes: usize) -> Regions {
    if luv.values().is_empty() {
        return Regions { labels: Field::filled(luv.width(), luv.height(), 0), count: 0 };
    }
    let classes = quantised(luv, color_classes);
    let shorter = luv.width().min(luv.height());
    let scales: Vec<&Scale> = SCALES.iter().filter(|scale| shorter > scale.above_px).collect();
    let j: Vec<Field<f32>> = scales.iter().map(|scale| j_values(&classes, scale.step)).collect();
    let whole = Field::filled(luv.width(), luv.height(), 0);
    let mut regions = Regions { labels: whole, count: 1 };
    for (place, scale) in scales.iter().enumerate() {
        regions = divided(&regions, scale, &j[place..]);
    }
    merged(&regions, &classes)
}

/// Divides the regions by their valleys at one scale. `j` starts with this scale.
fn divided(regions: &Regions, scale: &Scale, j: &[Field<f32>]) -> Regions {
    let mut labels = regions.labels.clone();
    let mut next = regions.count as u32;
    for (label, pixels) in (0..).zip(regions.pixels()) {
        let found = valleys(&labels, label, &pixels, &j[0], scale.least_px);
        if found.len() > 1 {
            grow(&mut labels, label, &pixels, &found, j, next);
            next += found.len() as u32 - 1;
        }
    }
    Regions::numbered(labels, next as usize)
}

const SIGMA: f64 = 1.0;

/// We count equal colours together in cells of CIELUV with this side.
const CELL: f32 = 2.0;

const ROUNDS: usize = 8;

#[derive(Debug, Clone, Copy)]
struct Bin {
    pixels: f64,
    mean: Vector3<f64>,
}

/// Class of every pixel of a CIELUV picture, below `most` (at most 255).
///
/// If a picture has few colours, it has fewer classes.
fn quantised(luv: &Field<[f32; 3]>, most: usize) -> Field<u8> {
    let smooth = blurred(luv, SIGMA);
    let (bins, bin_of) = binned(&smooth);
    let centers = lloyd(&bins, split(&bins, most));
    let class: Vec<u8> = bins.iter().map(|bin| nearest(&centers, bin.mean) as u8).collect();
    let values = bin_of.into_iter().map(|bin| class[bin as usize]).collect();
    Field::from_values(luv.width(), luv.height(), values)
}

fn binned(luv: &Field<[f32; 3]>) -> (Vec<Bin>, Vec<u32>) {
    fn cell(value: f32) -> u64 {
        ((value / CELL).round() as i32 + 512).clamp(0, 1023) as u64
    }
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

    /// Cuts the class by the plane through the mean, across the axis of largest scatter.
    fn halves(self) -> [Vec<Bin>; 2] {
        let eigen = self.scatter.symmetric_eigen();
        let axis = eigen.eigenvectors.column(eigen.eigenvalues.imax()).into_owned();
        let (low, high) =
            self.bins.into_iter().partition(|bin| axis.dot(&(bin.mean - self.mean)) < 0.0);
        [low, high]
    }
}

/// Means of at most `most` classes.
fn split(bins: &[Bin], most: usize) -> Vec<Vector3<f64>> {
    let mut classes = vec![Class::of(bins.to_vec())];
    while classes.len() < most {
        fn error(class: &Class) -> f64 {
            class.scatter.trace()
        }
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

/// Moves the means in some rounds in which each bin goes to its nearest mean (Lloyd 1982). This
/// leaves out classes that lose all their bins.
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

/// Index of the nearest of `centers`. If several are equally near, this is the first.
fn nearest(centers: &[Vector3<f64>], color: Vector3<f64>) -> usize {
    let apart = centers.iter().map(|center| (center - color).norm_squared());
    apart.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(index, _)| index)
}

/// Radius of the window at the finest scale. This makes it 9 pixels wide.
const RADIUS: isize = 4;

const MOST_CLASSES: usize = 32;

/// Largest value of J. We use it where no class has two places in the window.
const MOST: f32 = 100.0;

/// J of every pixel in a round window of 8 `step` + 1 pixels. We look at each `step`-th pixel
/// along both axes. These are 69 places at every scale.
///
/// # Panics
/// If a class is 32 or above.
fn j_values(classes: &Field<u8>, step: usize) -> Field<f32> {
    let width = classes.width() as isize;
    let height = classes.height() as isize;
    let step = step as isize;
    let disc: Vec<(isize, isize)> = (-RADIUS..=RADIUS)
        .flat_map(|y| (-RADIUS..=RADIUS).map(move |x| (x, y)))
        .filter(|(x, y)| x * x + y * y <= RADIUS * (RADIUS + 1))
        .collect();
    let mut found = Field::filled(classes.width(), classes.height(), 0.0);
    found.values_mut().par_chunks_mut(classes.width().max(1)).enumerate().for_each(|(y, row)| {
        let y = y as isize;
        for (x, j) in row.iter_mut().enumerate() {
            let x = x as isize;
            let mut window = Window::default();
            for &(dx, dy) in &disc {
                let px = x + dx * step;
                let py = y + dy * step;
                if px >= 0 && px < width && py >= 0 && py < height {
                    let class = classes[(px as usize, py as usize)];
                    window.add(class, dx as i32, dy as i32);
                }
            }
            *j = window.j();
        }
    });
    found
}

#[derive(Default)]
struct Window {
    by_class: [[i32; 3]; MOST_CLASSES],
    squares: i32,
}

impl Window {
    #[inline]
    fn add(&mut self, class: u8, x: i32, y: i32) {
        let sums = &mut self.by_class[class as usize];
        *sums = [sums[0] + 1, sums[1] + x, sums[2] + y];
        self.squares += x * x + y * y;
    }

    fn j(&self) -> f32 {
        fn about([count, x, y]: [i32; 3]) -> f32 {
            match count {
                0 => 0.0,
                count => (x * x + y * y) as f32 / count as f32,
            }
        }
        let mut whole = [0; 3];
        let mut means = 0.0;
        for class in self.by_class {
            whole = [0, 1, 2].map(|i| whole[i] + class[i]);
            means += about(class);
        }
        let total = self.squares as f32 - about(whole);
        let within = (self.squares as f32 - means).max(0.0);
        let between = (total - within).max(0.0);
        if between <= MOST * within { between / within.max(f32::MIN_POSITIVE) } else { MOST }
    }
}

/// Offsets of the threshold from the mean of J, in standard deviations (Deng and Manjunath 2001,
/// section IV A).
const OFFSETS: [f64; 7] = [-0.7, -0.6, -0.4, -0.2, 0.0, 0.2, 0.4];

/// The valleys of the region `label` with at least `least_px` pixels.
///
/// `pixels` are the pixels of the region. We take the threshold that gives most valleys, and the
/// lowest one of several.
fn valleys(
    labels: &Field<u32>,
    label: u32,
    pixels: &[u32],
    j: &Field<f32>,
    least_px: usize,
) -> Vec<Vec<u32>> {
    let count = pixels.len() as f64;
    fn value(pixel: u32, j: &Field<f32>) -> f64 {
        f64::from(j.values()[pixel as usize])
    }
    let mean = pixels.iter().map(|&pixel| value(pixel, j)).sum::<f64>() / count;
    let squares = pixels.iter().map(|&pixel| (value(pixel, j) - mean).powi(2)).sum::<f64>();
    let deviation = (squares / count).sqrt();
    let mut found: Vec<Vec<u32>> = Vec::new();
    for offset in OFFSETS {
        let threshold = mean + offset * deviation;
        let parts = components(pixels, (labels.width(), labels.height()), |pixel: u32| {
            labels.values()[pixel as usize] == label && value(pixel, j) < threshold
        });
        let large: Vec<_> = parts.into_iter().filter(|part| part.len() >= least_px).collect();
        if large.len() > found.len() {
            found = large;
        }
    }
    found
}

/// The connected parts of the `pixels` that are `inside`. Parts are connected by rows and columns.
fn components(
    pixels: &[u32],
    (width, height): (usize, usize),
    inside: impl Fn(u32) -> bool,
) -> Vec<Vec<u32>> {
    let Some((&first, &last)) = pixels.first().zip(pixels.last()) else { return Vec::new() };
    // Pixels are in rising order, so this needs no field of the picture's size.
    let mut seen = vec![false; (last - first) as usize + 1];
    let mut parts = Vec::new();
    for &pixel in pixels {
        if seen[(pixel - first) as usize] || !inside(pixel) {
            continue;
        }
        seen[(pixel - first) as usize] = true;
        let mut part = vec![pixel];
        let mut next = 0;
        while next < part.len() {
            for other in beside(part[next], width, height) {
                if (first..=last).contains(&other)
                    && !seen[(other - first) as usize]
                    && inside(other)
                {
                    seen[(other - first) as usize] = true;
                    part.push(other);
                }
            }
            next += 1;
        }
        parts.push(part);
    }
    parts
}

const NOBODY: u32 = u32::MAX;

/// Divides a region among its valleys. The first valley keeps `label` in `labels`. The second one
/// and those after it get `first_new` and up.
///
/// `j` holds the fields of J from this scale to the finest.
fn grow(
    labels: &mut Field<u32>,
    label: u32,
    pixels: &[u32],
    valleys: &[Vec<u32>],
    j: &[Field<f32>],
    first_new: u32,
) {
    let Some(finest) = j.last() else { return };
    let size = (labels.width(), labels.height());
    pixels.iter().for_each(|&pixel| labels.values_mut()[pixel as usize] = NOBODY);
    let names = std::iter::once(label).chain(first_new..);
    let names: Vec<u32> = names.take(valleys.len()).collect();
    for (valley, &name) in valleys.iter().zip(&names) {
        valley.iter().for_each(|&pixel| labels.values_mut()[pixel as usize] = name);
    }
    for j in j {
        grow_parts(labels, pixels, &names, j);
    }
    let mut queue = BinaryHeap::new();
    // The bits of J, which is at least 0, are in its order.
    fn entry(pixel: u32, finest: &Field<f32>) -> Reverse<(u32, u32)> {
        Reverse((finest.values()[pixel as usize].to_bits(), pixel))
    }
    for &pixel in pixels.iter().filter(|&&pixel| labels.values()[pixel as usize] == NOBODY) {
        if beside(pixel, size.0, size.1)
            .any(|other: u32| names.binary_search(&labels.values()[other as usize]).is_ok())
        {
            queue.push(entry(pixel, finest));
        }
    }
    while let Some(Reverse((_, pixel))) = queue.pop() {
        if labels.values()[pixel as usize] != NOBODY {
            continue;
        }
        let around =
            beside(pixel, size.0, size.1).map(|other: u32| labels.values()[other as usize]);
        let Some(owner) = around.filter(|owner| names.binary_search(owner).is_ok()).min() else {
            continue;
        };
        labels.values_mut()[pixel as usize] = owner;
        for other in beside(pixel, size.0, size.1) {
            if labels.values()[other as usize] == NOBODY {
                queue.push(entry(other, finest));
            }
        }
    }
}

/// Takes the parts of the remaining pixels with J below their mean. If a part touches a single
/// valley, the valley gets it.
fn grow_parts(labels: &mut Field<u32>, pixels: &[u32], names: &[u32], j: &Field<f32>) {
    let width = labels.width();
    let height = labels.height();
    fn value(pixel: u32, j: &Field<f32>) -> f64 {
        f64::from(j.values()[pixel as usize])
    }
    fn is_left(labels: &Field<u32>, pixel: u32) -> bool {
        labels.values()[pixel as usize] == NOBODY
    }
    let left: Vec<u32> = pixels.iter().copied().filter(|&pixel| is_left(labels, pixel)).collect();
    let mean = left.iter().map(|&pixel| value(pixel, j)).sum::<f64>() / left.len().max(1) as f64;
    for part in components(&left, (width, height), |pixel: u32| {
        is_left(labels, pixel) && value(pixel, j) <= mean
    }) {
        let around = part.iter().flat_map(|&pixel| beside(pixel, width, height));
        let mut owners = around
            .map(|other| labels.values()[other as usize])
            .filter(|owner| names.binary_search(owner).is_ok());
        let Some(owner) = owners.next() else { continue };
        if owners.all(|other| other == owner) {
            part.iter().for_each(|&pixel| labels.values_mut()[pixel as usize] = owner);
        }
    }
}

/// We merge neighbours if their histograms are closer than this. Deng and Manjunath take 0.4. An
/// over-segmentation keeps more regions apart.
const ALIKE: f64 = 0.1;

type Histogram = Vec<f64>;

/// Merges regions until no two neighbours have histograms closer than 0.1. The distance is the
/// Euclidean distance of the shares of the classes of CIELUV (Deng and Manjunath 2001, section IV
/// C).
fn merged(regions: &Regions, classes: &Field<u8>) -> Regions {
    let most = classes.values().iter().max().map_or(0, |&class| class as usize + 1);
    let mut histograms: Vec<Histogram> = vec![vec![0.0; most]; regions.count];
    for (&label, &class) in regions.labels.values().iter().zip(classes.values()) {
        histograms[label as usize][class as usize] += 1.0;
    }
    joined(regions, histograms, ALIKE, apart, |whole: &mut Histogram, part: Histogram| {
        whole.iter_mut().zip(part).for_each(|(sum, more)| *sum += more);
    })
    .0
}

fn apart(one: &Histogram, other: &Histogram) -> f64 {
    let [pixels, other_pixels] = [one, other].map(|histogram| histogram.iter().sum::<f64>());
    let shares = one.iter().zip(other).map(|(a, b)| a / pixels - b / other_pixels);
    shares.map(|share| share * share).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mixtures() -> Field<[f32; 3]> {
        fn color(x: usize, y: usize) -> [f32; 3] {
            match (x < 80, y < 60) {
                (true, _) => {
                    [if (x / 3 + y / 5).is_multiple_of(2) { 30.0 } else { 45.0 }, 0.0, 10.0]
                }
                (false, true) => {
                    [if (y / 3 + x / 7).is_multiple_of(2) { 62.0 } else { 80.0 }, 20.0, 0.0]
                }
                (false, false) => [55.0, -30.0, -20.0],
            }
        }
        let values = (0..160 * 130).map(|i| color(i % 160, i / 160)).collect();
        Field::from_values(160, 130, values)
    }

    #[test]
    fn no_region_spans_two_textures() {
        let regions = jseg(&mixtures(), 16);
        fn texture(pixel: usize) -> usize {
            match (pixel % 160 < 80, pixel / 160 < 60) {
                (true, _) => 0,
                (false, true) => 1,
                (false, false) => 2,
            }
        }
        let mut strays = 0;
        for pixels in regions.pixels() {
            let mut counts = [0; 3];
            pixels.iter().for_each(|&pixel| counts[texture(pixel as usize)] += 1);
            strays += pixels.len() - counts.iter().max().unwrap();
        }
        assert!(regions.count >= 3, "{} regions", regions.count);
        assert!(strays < 160 * 130 / 50, "{strays} pixels lie in a region of another texture");
    }

    #[test]
    fn regions_do_not_depend_on_threads() {
        let picture = mixtures();
        fn with(threads: usize, picture: &Field<[f32; 3]>) -> Regions {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| jseg(picture, 16))
        }
        assert!(with(1, &picture) == with(3, &picture));
    }

    #[test]
    fn pictures_of_any_size_have_regions() {
        for (width, height) in [(0, 0), (1, 1), (1, 40), (9, 2)] {
            let regions = jseg(&Field::filled(width, height, [50.0, 0.0, 0.0]), 10);
            assert_eq!(regions.count, usize::from(width > 0), "{width} x {height}");
        }
    }

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
        fn error(centers: &[Vector3<f64>], bins: &[Bin]) -> f64 {
            bins.iter()
                .map(|bin| (centers[nearest(centers, bin.mean)] - bin.mean).norm_squared())
                .sum()
        }
        let start = split(&bins, 6);
        let end = lloyd(&bins, start.clone());
        assert!(
            error(&end, &bins) < error(&start, &bins),
            "{} {}",
            error(&end, &bins),
            error(&start, &bins)
        );
    }

    #[test]
    fn there_are_as_many_classes_as_asked_for() {
        let ramp = (0..200 * 4).map(|i| [(i % 200) as f32 / 2.0, 0.0, 0.0]).collect();
        let classes = quantised(&Field::from_values(200, 4, ramp), 12);
        assert_eq!(classes.values().iter().max(), Some(&11));
    }

    fn map(width: usize, height: usize, class: impl Fn(usize, usize) -> u8) -> Field<u8> {
        let values = (0..width * height).map(|i| class(i % width, i / width)).collect();
        Field::from_values(width, height, values)
    }

    #[test]
    fn an_even_mixture_has_j_near_0_and_one_class_0() {
        let checks = j_values(&map(40, 40, |x, y| ((x + y) % 2) as u8), 1);
        assert!(checks[(20, 20)] < 0.01, "{}", checks[(20, 20)]);
        let even = j_values(&map(40, 40, |_, _| 3), 1);
        assert!(even.values().iter().all(|&j| j == 0.0), "one class");
    }

    #[test]
    fn two_half_discs_have_the_j_of_their_means() {
        let halves = map(40, 40, |x, _| u8::from(x > 20));
        // This follows the definition, from the places themselves.
        let mut places = Vec::new();
        for y in -4i32..=4 {
            for x in -4i32..=4 {
                if x * x + y * y <= 20 {
                    places.push((f64::from(x), f64::from(y), x > 0));
                }
            }
        }
        let sides = [&[false, true][..], &[true], &[false]];
        let [all, right, left] = sides.map(|sides| {
            let of: Vec<_> = places.iter().filter(|place| sides.contains(&place.2)).collect();
            let count = of.len() as f64;
            let mean = of.iter().fold((0.0, 0.0), |m, p| (m.0 + p.0 / count, m.1 + p.1 / count));
            of.iter().map(|p| (p.0 - mean.0).powi(2) + (p.1 - mean.1).powi(2)).sum::<f64>()
        });
        let within = right + left;
        let wanted = (all - within) / within;
        let found = f64::from(j_values(&halves, 1)[(20, 20)]);
        assert!((found - wanted).abs() < 1e-4, "{found}, wanted {wanted}");
        assert!(found > 0.5, "{found}");
    }

    #[test]
    fn a_larger_window_sees_a_border_from_further_away() {
        let halves = map(80, 80, |x, _| u8::from(x > 40));
        assert_eq!(j_values(&halves, 1)[(30, 40)], 0.0);
        assert!(j_values(&halves, 4)[(30, 40)] > 0.1, "33 pixels wide");
    }

    #[test]
    fn valleys_are_the_large_parts_of_small_j() {
        // Two basins of 8 x 10 pixels with a ridge of 4 between them, and a pit of 4 pixels.
        let mut j = Field::filled(20, 10, 0.1);
        for y in 0..10 {
            for x in 8..12 {
                j[(x, y)] = 1.0;
            }
        }
        for (x, y) in [(9, 4), (10, 4), (9, 5), (10, 5)] {
            j[(x, y)] = 0.05;
        }
        let labels = Field::filled(20, 10, 0);
        let pixels: Vec<u32> = (0..200).collect();
        let found = valleys(&labels, 0, &pixels, &j, 32);
        assert_eq!(found.iter().map(Vec::len).collect::<Vec<_>>(), [80, 80]);
        let found = valleys(&labels, 0, &pixels, &j, 4);
        assert_eq!(found.len(), 3, "the pit is large enough");
        assert!(valleys(&labels, 0, &pixels, &j, 100).is_empty(), "none is so large");
    }

    #[test]
    fn only_pixels_of_the_region_are_looked_at() {
        let labels = Field::from_values(4, 1, vec![1, 0, 1, 1]);
        let j = Field::from_values(4, 1, vec![0.0, 0.0, 0.0, 9.0]);
        assert_eq!(valleys(&labels, 1, &[0, 2, 3], &j, 1), [vec![0], vec![2]]);
    }

    #[test]
    fn valleys_meet_at_the_ridge() {
        // J rises towards column 6. The valleys are the outermost columns.
        let j: Vec<f32> = (0..13 * 3).map(|i| 6.0 - f32::abs((i % 13) as f32 - 6.0)).collect();
        let j = Field::from_values(13, 3, j);
        let mut labels = Field::filled(13, 3, 4);
        let pixels: Vec<u32> = (0..39).collect();
        let valleys = [vec![0, 13, 26], vec![12, 25, 38]];
        grow(&mut labels, 4, &pixels, &valleys, &[j], 9);
        for y in 0..3 {
            assert_eq!(labels.row(y, 0, 6), [4; 6]);
            assert_eq!(labels.row(y, 7, 6), [9; 6]);
        }
        assert!([4, 9].contains(&labels[(6, 1)]), "the ridge belongs to one of them");
    }

    #[test]
    fn pixels_of_other_regions_stay() {
        let mut labels = Field::from_values(5, 1, vec![0, 0, 0, 7, 7]);
        let j = Field::from_values(5, 1, vec![0.0, 0.3, 0.5, 0.1, 0.1]);
        grow(&mut labels, 0, &[0, 1, 2], &[vec![0], vec![2]], &[j], 8);
        assert_eq!(labels.values()[3..], [7, 7]);
        assert_eq!(labels.values()[..3], [0, 0, 8]);
    }

    #[test]
    fn only_neighbours_of_one_mixture_are_merged() {
        // Three strips of 40 columns: the first two have classes 0 and 1 in equal parts.
        fn class(x: usize, y: usize) -> usize {
            match x / 40 {
                0 => (x + y) % 2,
                1 => (x / 2 + y) % 2,
                _ => 1 + (x + y) % 2,
            }
        }
        let values = (0..120 * 20).map(|i| class(i % 120, i / 120) as u8).collect();
        let classes = Field::from_values(120, 20, values);
        let labels = (0..120 * 20).map(|i| (i % 120 / 40) as u32).collect();
        let regions = Regions::numbered(Field::from_values(120, 20, labels), 3);
        let found = merged(&regions, &classes);
        assert_eq!(found.count, 2);
        assert_eq!([5, 45, 85].map(|x| found.labels[(x, 3)]), [0, 0, 1]);
    }
}
