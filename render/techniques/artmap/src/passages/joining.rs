//! Joins regions to passages, starting from the scribbles.
//!
//! We join regions by their traits: tone, contrast, and direction of strokes. Yan, Chi, Lee and
//! Lin (2008, section 4.1) average the directions of the strongest fifth of the gradients. Angles
//! jump from 180 to 0 degrees, so we average the structure tensor instead. Gaps are single strokes
//! that are unlike the mean of the strokes around them. We add them to the passage at the end.

use std::collections::{BTreeSet, VecDeque};
use std::f64::consts::PI;

use graphics::field::Field;
use rayon::prelude::*;

use super::regions::{Regions, beside, joined};

#[derive(Debug, Clone, PartialEq)]
struct Candidate {
    traits: RegionTraits,
    scribble: Option<usize>,
}

/// A passage: all pixels that were joined to a scribble, and how many regions lie under this
/// scribble.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Passage {
    pub(super) pixels: Vec<u32>,
    pub(super) regions_under: usize,
}

/// Finds the passage of each scribble.
///
/// All regions under a scribble belong to it. If a region lies under several scribbles, we divide
/// it among them. Then we join neighbours, the most alike first, while their unlikeness is below
/// `reach`. We never join regions of different scribbles. At the end we fill gaps.
pub(super) fn passages(
    regions: &Regions,
    scribbles: &[Vec<u32>],
    intensity: &Field<f32>,
    gradient: &Field<[f32; 2]>,
    reach: f64,
) -> Vec<Passage> {
    let (regions, under) = united(&divided(regions, scribbles), scribbles);
    let traits = traits_of(&regions, intensity, gradient);
    let mut candidates: Vec<Candidate> =
        traits.into_iter().map(|traits| Candidate { traits, scribble: None }).collect();
    for (number, scribble) in scribbles.iter().enumerate() {
        let first = scribble.first().map(|&pixel| regions.labels.values()[pixel as usize]);
        if let Some(label) = first {
            candidates[label as usize].scribble = Some(number);
        }
    }
    let (regions, candidates) = joined(&regions, candidates, reach, apart, unite);
    let owners: Vec<Option<usize>> =
        candidates.iter().map(|candidate| candidate.scribble).collect();
    let traits: Vec<RegionTraits> =
        candidates.into_iter().map(|candidate| candidate.traits).collect();
    let owners = filled(&regions, &traits, &owners, reach);
    let mut found: Vec<Passage> = under
        .into_iter()
        .map(|regions_under| Passage { pixels: Vec::new(), regions_under })
        .collect();
    for (pixel, &label) in (0..).zip(regions.labels.values()) {
        if let Some(number) = owners[label as usize] {
            found[number].pixels.push(pixel);
        }
    }
    found
}

/// Joins regions of like traits without scribbles. Also returns their traits.
pub(super) fn joined_alike(
    regions: &Regions,
    intensity: &Field<f32>,
    gradient: &Field<[f32; 2]>,
    reach: f64,
) -> (Regions, Vec<RegionTraits>) {
    let traits = traits_of(regions, intensity, gradient);
    joined(regions, traits, reach, RegionTraits::apart, |whole, part| whole.add(&part))
}

fn apart(one: &Candidate, other: &Candidate) -> f64 {
    match (one.scribble, other.scribble) {
        (Some(first), Some(second)) if first != second => f64::INFINITY,
        _ => one.traits.apart(&other.traits),
    }
}

fn unite(whole: &mut Candidate, part: Candidate) {
    whole.traits.add(&part.traits);
    whole.scribble = whole.scribble.or(part.scribble);
}

/// Divides regions under several scribbles. Each pixel goes to the scribble that is nearest along
/// a path of rows and columns inside the region. If two are equally near, the first one gets it.
fn divided(regions: &Regions, scribbles: &[Vec<u32>]) -> Regions {
    let width = regions.labels.width();
    let height = regions.labels.height();
    let mut owners = vec![BTreeSet::new(); regions.count];
    for (number, scribble) in scribbles.iter().enumerate() {
        for &pixel in scribble {
            owners[regions.labels.values()[pixel as usize] as usize].insert(number);
        }
    }
    let mut labels = regions.labels.clone();
    let mut reached = vec![false; width * height];
    let mut queue = VecDeque::new();
    let mut next = regions.count as u32;
    for scribble in scribbles {
        // One scribble may run over several shared regions, so each has its own new label.
        let mut names = vec![None; regions.count];
        for &pixel in scribble
            .iter()
            .filter(|&&pixel| owners[regions.labels.values()[pixel as usize] as usize].len() > 1)
        {
            let region = regions.labels.values()[pixel as usize];
            let name = *names[region as usize].get_or_insert_with(|| {
                next += 1;
                next - 1
            });
            labels.values_mut()[pixel as usize] = name;
            reached[pixel as usize] = true;
            queue.push_back(pixel);
        }
    }
    while let Some(pixel) = queue.pop_front() {
        let region = regions.labels.values()[pixel as usize];
        let name = labels.values()[pixel as usize];
        for other in beside(pixel, width, height) {
            let inside = regions.labels.values()[other as usize] == region;
            if inside && !std::mem::replace(&mut reached[other as usize], true) {
                labels.values_mut()[other as usize] = name;
                queue.push_back(other);
            }
        }
    }
    Regions::numbered(labels, next as usize)
}

/// Makes one region of all regions under a scribble. Also returns their number before this, for
/// each scribble.
fn united(regions: &Regions, scribbles: &[Vec<u32>]) -> (Regions, Vec<usize>) {
    let mut names: Vec<u32> = (0..regions.count as u32).collect();
    let mut under = Vec::new();
    for scribble in scribbles {
        let labels = scribble.iter().map(|&pixel| regions.labels.values()[pixel as usize]);
        let labels: BTreeSet<u32> = labels.collect();
        under.push(labels.len());
        if let Some(&first) = labels.first() {
            labels.iter().for_each(|&label| names[label as usize] = first);
        }
    }
    let labels = regions.labels.values().iter().map(|&label| names[label as usize]).collect();
    let width = regions.labels.width();
    let height = regions.labels.height();
    (Regions::numbered(Field::from_values(width, height, labels), regions.count), under)
}

/// We take the direction from the pixels with the strongest gradients, which are this share of all.
const STRONGEST: f64 = 0.2;

/// At this distance from the border, in pixels, the neighbouring region does not affect gradients.
const INSIDE: u32 = 4;

/// A difference of this size in the mean intensity (0 to 1) adds 1 to the unlikeness. The next two
/// are for the deviation of the intensity and for the direction.
const MEAN_STEP: f64 = 0.08;
const DEVIATION_STEP: f64 = 0.05;
const ANGLE_STEP: f64 = 25.0 * PI / 180.0;

/// Sums over a region, which give you its traits. To join regions, add their sums.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct RegionTraits {
    pub(super) pixels: f64,
    /// Sum of the intensity.
    sum: f64,
    /// Sum of the squared intensity.
    squares: f64,
    /// Sum of the strongest gradients, along x and y. Their angles are doubled.
    doubled: [f64; 2],
    /// Sum of the squared lengths of these gradients.
    strength: f64,
}

impl RegionTraits {
    /// Traits of the given pixels. Pass the distance of each pixel from the region's border as
    /// `depth`.
    pub(super) fn of(
        pixels: &[u32],
        depth: &Field<u32>,
        intensity: &Field<f32>,
        gradient: &Field<[f32; 2]>,
    ) -> Self {
        let mut traits = Self { pixels: pixels.len() as f64, ..Self::default() };
        for &pixel in pixels {
            let value = f64::from(intensity.values()[pixel as usize]);
            traits.sum += value;
            traits.squares += value * value;
        }
        for pixel in strongest(&inner(pixels, depth), gradient) {
            let [x, y] = gradient.values()[pixel as usize].map(f64::from);
            traits.doubled[0] += x * x - y * y;
            traits.doubled[1] += 2.0 * x * y;
            traits.strength += x * x + y * y;
        }
        traits
    }

    pub(super) fn add(&mut self, other: &Self) {
        self.pixels += other.pixels;
        self.sum += other.sum;
        self.squares += other.squares;
        self.doubled[0] += other.doubled[0];
        self.doubled[1] += other.doubled[1];
        self.strength += other.strength;
    }

    /// Mean intensity, 0 to 1.
    pub(super) fn mean(&self) -> f64 {
        self.sum / self.pixels.max(1.0)
    }

    pub(super) fn deviation(&self) -> f64 {
        (self.squares / self.pixels.max(1.0) - self.mean().powi(2)).max(0.0).sqrt()
    }

    /// Share of the gradients that agree in direction: 1 if all do, 0 if they have no common
    /// direction.
    pub(super) fn coherence(&self) -> f64 {
        let [x, y] = self.doubled;
        if self.strength > 0.0 { (x.hypot(y) / self.strength).min(1.0) } else { 0.0 }
    }

    /// Angle of the strokes, which run across the gradient, in radians from 0 to pi: 0 along x,
    /// growing from x (right) to y (down).
    pub(super) fn angle(&self) -> f64 {
        let [x, y] = self.doubled;
        let angle = (0.5 * y.atan2(x) + 0.5 * PI).rem_euclid(PI);
        // Rounding may reach pi itself.
        if angle < PI { angle } else { 0.0 }
    }

    /// Unlikeness of two regions. You may join them if this is below 1.
    pub(super) fn apart(&self, other: &Self) -> f64 {
        let mean = (self.mean() - other.mean()) / MEAN_STEP;
        let deviation = (self.deviation() - other.deviation()) / DEVIATION_STEP;
        let turn = (self.angle() - other.angle()).abs();
        let turn = turn.min(PI - turn) / ANGLE_STEP;
        let coherence = self.coherence().min(other.coherence());
        (mean * mean + deviation * deviation + coherence * turn * turn).sqrt()
    }
}

pub(super) fn traits_of(
    regions: &Regions,
    intensity: &Field<f32>,
    gradient: &Field<[f32; 2]>,
) -> Vec<RegionTraits> {
    let depth = regions.depths();
    let pixels = regions.pixels();
    pixels
        .par_iter()
        .map(|pixels: &Vec<u32>| RegionTraits::of(pixels, &depth, intensity, gradient))
        .collect()
}

/// Pixels for the gradients of a region, far enough from its border that no neighbour affects them.
/// If the pixels deep inside are at least a quarter of the region, we take these. If not, we take
/// the ones that are not at its border, or else all.
fn inner(pixels: &[u32], depth: &Field<u32>) -> Vec<u32> {
    let depths = [INSIDE, 2];
    let found = depths
        .into_iter()
        .map(|least: u32| -> Vec<u32> {
            pixels
                .iter()
                .copied()
                .filter(|pixel: &u32| depth.values()[*pixel as usize] >= least)
                .collect()
        })
        .find(|inner| inner.len() * 4 >= pixels.len());
    found.unwrap_or_else(|| pixels.to_vec())
}

/// The fifth of the pixels that has the largest gradients. Among pixels with equal gradients, the
/// first count.
fn strongest(pixels: &[u32], gradient: &Field<[f32; 2]>) -> Vec<u32> {
    let mut by_strength: Vec<(u32, u32)> = pixels
        .iter()
        .map(|&pixel| {
            let [x, y] = gradient.values()[pixel as usize];
            // The bits of numbers of at least 0 have their order. The complement turns it around.
            (!(x * x + y * y).to_bits(), pixel)
        })
        .collect();
    let count = (pixels.len() as f64 * STRONGEST).ceil() as usize;
    if count > 0 && count < by_strength.len() {
        by_strength.select_nth_unstable(count - 1);
        by_strength.truncate(count);
    }
    by_strength.sort_unstable_by_key(|&(_, pixel)| pixel);
    by_strength.into_iter().map(|(_, pixel)| pixel).collect()
}

/// A gap borders on passages with more than this share of its border.
const LEAST_BORDER: f64 = 0.5;

/// A gap has at most this share of the area of its passage.
const MOST_AREA: f64 = 0.2;

/// How unlike its passage a gap may be, relative to the limit for regions that we join.
const MORE_UNLIKE: f64 = 2.5;

/// The passage of each region, after filling gaps. A gap is a region of small area that belongs to
/// no passage and borders mainly on passages. It goes to the passage that it is most like, unless
/// it is very unlike all.
///
/// A region of the size of a stroke has the tone of this stroke, which scatters about the mean of
/// the passage. So its place decides together with its traits. Regions behind a gap that are like
/// the passage count as its border. We join them once the gap is filled. The edge of the picture
/// does not count as a border. This method is ours. Yan, Chi, Lee and Lin do not say what becomes
/// of such regions.
pub(super) fn filled(
    regions: &Regions,
    traits: &[RegionTraits],
    passages: &[Option<usize>],
    reach: f64,
) -> Vec<Option<usize>> {
    let borders = borders(regions);
    let whole = sums(traits, passages);
    let mut found = passages.to_vec();
    loop {
        let mut changed = false;
        for label in 0..regions.count {
            if found[label].is_none() {
                found[label] = around(label, &borders[label], traits, &whole, &found, reach);
                changed |= found[label].is_some();
            }
        }
        if !changed {
            return found;
        }
    }
}

fn sums(traits: &[RegionTraits], passages: &[Option<usize>]) -> Vec<RegionTraits> {
    let count = passages.iter().flatten().max().map_or(0, |&last| last + 1);
    let mut whole = vec![RegionTraits::default(); count];
    for (traits, passage) in traits.iter().zip(passages) {
        if let Some(passage) = *passage {
            whole[passage].add(traits);
        }
    }
    whole
}

/// The passage that the region `label` touches and may join. If there are several, this is the one
/// that it is most like.
fn around(
    label: usize,
    borders: &[(u32, u32)],
    traits: &[RegionTraits],
    whole: &[RegionTraits],
    found: &[Option<usize>],
    reach: f64,
) -> Option<usize> {
    let own = &traits[label];
    let length = |chosen: &dyn Fn(u32) -> bool| -> u32 {
        borders.iter().filter(|(other, _)| chosen(*other)).map(|(_, length)| length).sum()
    };
    let all = length(&|_| true);
    (0..whole.len())
        .filter(|passage: &usize| {
            let whole = &whole[*passage];
            let enclosed = f64::from(length(&|other: u32| {
                found[other as usize].is_some() || traits[other as usize].apart(whole) < reach
            })) > LEAST_BORDER * f64::from(all);
            let small = own.pixels < MOST_AREA * whole.pixels;
            let gap = enclosed && small && own.apart(whole) < MORE_UNLIKE * reach;
            length(&|other: u32| found[other as usize] == Some(*passage)) > 0
                && (gap || own.apart(whole) < reach)
        })
        .min_by(|one, other| own.apart(&whole[*one]).total_cmp(&own.apart(&whole[*other])))
}

/// The neighbours of each region by rising label, and the lengths of the common borders in pixels.
fn borders(regions: &Regions) -> Vec<Vec<(u32, u32)>> {
    let width = regions.labels.width();
    let height = regions.labels.height();
    let mut pairs = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let own = regions.labels[(x, y)];
            let right = (x + 1 < width).then(|| regions.labels[(x + 1, y)]);
            let below = (y + 1 < height).then(|| regions.labels[(x, y + 1)]);
            for other in [right, below].into_iter().flatten().filter(|&other| other != own) {
                pairs.extend([(own, other), (other, own)]);
            }
        }
    }
    pairs.sort_unstable();
    let mut borders = vec![Vec::new(); regions.count];
    for same in pairs.chunk_by(|one, other| one == other) {
        borders[same[0].0 as usize].push((same[0].1, same.len() as u32));
    }
    borders
}

#[cfg(test)]
mod gaps_tests {
    use super::super::regions::gradient_of;
    use super::*;
    use graphics::field::Field;

    /// Passages of strips. You give the first column of each, its tone, and the passages known
    /// before.
    fn strips<const N: usize>(
        starts: [usize; N],
        tones: [f32; N],
        known: [Option<usize>; N],
    ) -> Vec<Option<usize>> {
        let labels: Vec<usize> = (0..100 * 40)
            .map(|i: usize| starts.partition_point(|&start| start <= i % 100) - 1)
            .collect();
        let intensity = labels.iter().map(|&label| tones[label]).collect();
        let intensity = Field::from_values(100, 40, intensity);
        let labels = labels.into_iter().map(|label| label as u32).collect();
        let regions = Regions { labels: Field::from_values(100, 40, labels), count: N };
        let traits = traits_of(&regions, &intensity, &gradient_of(&intensity));
        filled(&regions, &traits, &known, 1.0)
    }

    #[test]
    fn a_small_stroke_between_two_passages_goes_to_the_like_one() {
        let known = [Some(0), None, Some(1)];
        for (tone, like) in [(0.62, Some(0)), (0.75, Some(1)), (0.2, None)] {
            assert_eq!(strips([0, 48, 52], [0.5, tone, 0.9], known)[1], like, "{tone}");
        }
        let wide = strips([0, 40, 60], [0.5, 0.62, 0.9], known)[1];
        assert_eq!(wide, None, "a large area is not a stroke");
        let beside_free = strips([0, 48, 52], [0.5, 0.62, 0.9], [Some(0), None, None])[1];
        assert_eq!(beside_free, None, "only half of its border");
    }

    #[test]
    fn a_like_region_behind_a_gap_is_joined() {
        let known = [Some(0), None, None, Some(1)];
        let found = strips([0, 50, 54, 70], [0.5, 0.4, 0.5, 0.8], known);
        assert_eq!(found, [Some(0), Some(0), Some(0), Some(1)]);
    }
}

#[cfg(test)]
mod tests {
    use super::super::regions::gradient_of;
    use super::*;

    fn strips(tones: [f32; 6]) -> (Regions, Field<f32>) {
        let labels = (0..60 * 20).map(|i| (i % 60 / 10) as u32).collect();
        let regions = Regions { labels: Field::from_values(60, 20, labels), count: 6 };
        let intensity = (0..60 * 20).map(|i| tones[i % 60 / 10]).collect();
        (regions, Field::from_values(60, 20, intensity))
    }

    fn columns(passage: &Passage) -> Vec<u32> {
        let columns: BTreeSet<u32> = passage.pixels.iter().map(|pixel| pixel % 60 / 10).collect();
        columns.into_iter().collect()
    }

    #[test]
    fn scribbles_grow_over_like_regions_and_never_meet() {
        let (regions, intensity) = strips([0.30, 0.32, 0.34, 0.36, 0.80, 0.82]);
        let gradient = gradient_of(&intensity);
        let find = |scribbles: &[Vec<u32>], reach| {
            passages(&regions, scribbles, &intensity, &gradient, reach)
        };
        let one = find(&[vec![5]], 1.0);
        assert_eq!((columns(&one[0]), one[0].regions_under), (vec![0, 1, 2, 3], 1));
        let both = find(&[vec![5], vec![35]], 1.0);
        let found: Vec<Vec<u32>> = both.iter().map(columns).collect();
        assert_eq!(found, [vec![0, 1], vec![2, 3]]);
        assert_eq!(columns(&find(&[vec![5]], 0.1)[0]), [0], "a small reach");
        let bridge = find(&[(5..45).collect()], 1.0);
        assert_eq!(bridge[0].regions_under, 5, "regions under a scribble belong to it");
    }

    #[test]
    fn a_region_under_two_scribbles_is_divided_between_them() {
        let (_, intensity) = strips([0.4; 6]);
        let whole = Regions { labels: Field::filled(60, 20, 0), count: 1 };
        let scribbles = [vec![10], vec![50]];
        let found = passages(&whole, &scribbles, &intensity, &gradient_of(&intensity), 1.0);
        assert_eq!(found[0].pixels.len() + found[1].pixels.len(), 1200);
        // Columns up to 30 are as near to the first scribble as to the second, or nearer.
        assert_eq!(found[0].pixels.len(), 31 * 20);
    }

    /// Waves about a mean, with crests that run at an angle.
    fn waves(degrees: f64, mean: f64, height: f64) -> RegionTraits {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let intensity = Field::from_values(
            60,
            60,
            (0..3600)
                .map(|i: usize| {
                    let across = (i % 60) as f64 * -sin + (i / 60) as f64 * cos;
                    (mean + height * (across * 0.8).sin()) as f32
                })
                .collect(),
        );
        let whole = Regions { labels: Field::filled(60, 60, 0), count: 1 };
        traits_of(&whole, &intensity, &gradient_of(&intensity))[0]
    }

    #[test]
    fn waves_have_their_mean_deviation_and_direction() {
        for degrees in [0.0, 30.0, 75.0, 120.0, 179.0] {
            let found = waves(degrees, 0.4, 0.1);
            assert!((found.mean() - 0.4).abs() < 0.01, "{}", found.mean());
            assert!((found.deviation() - 0.1 / 2f64.sqrt()).abs() < 0.005, "{found:?}");
            assert!(found.coherence() > 0.95, "{}", found.coherence());
            let off = (found.angle().to_degrees() - degrees).abs();
            assert!(off.min(180.0 - off) < 1.0, "{} of {degrees}", found.angle().to_degrees());
        }
    }

    #[test]
    fn unlikeness_is_that_of_its_formula() {
        let [one, other] = [waves(175.0, 0.4, 0.1), waves(5.0, 0.44, 0.1)];
        let coherence = one.coherence().min(other.coherence());
        let wanted = ((0.04f64 / 0.08).powi(2) + coherence * (10.0f64 / 25.0).powi(2)).sqrt();
        assert!((one.apart(&other) - wanted).abs() < 0.03, "{} {wanted}", one.apart(&other));
        let flat = RegionTraits { pixels: 9.0, sum: 3.6, squares: 1.44, ..one };
        let flat = RegionTraits { doubled: [0.0; 2], strength: 0.0, ..flat };
        let wanted = one.deviation() / 0.05;
        assert!((one.apart(&flat) - wanted).abs() < 0.03, "no direction, no cost of turning");
    }

    #[test]
    fn a_border_does_not_lend_its_direction() {
        // Waves along x at the left, a much lighter area at the right.
        fn value(i: usize) -> f32 {
            match i % 60 < 30 {
                true => 0.3 + 0.05 * ((i / 60) as f32 * 0.9).sin(),
                false => 0.9,
            }
        }
        let intensity = Field::from_values(60, 60, (0..3600).map(value).collect());
        let labels = (0..3600).map(|i| u32::from(i % 60 >= 30)).collect();
        let regions = Regions { labels: Field::from_values(60, 60, labels), count: 2 };
        let found = &traits_of(&regions, &intensity, &gradient_of(&intensity))[0];
        let degrees = found.angle().to_degrees();
        assert!(!(1.0..=179.0).contains(&degrees), "{degrees}");
    }
}
