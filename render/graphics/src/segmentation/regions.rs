//! Regions: connected pixels with modes that are close. This has their graph of neighbours, and
//! merges regions that are too small or too similar.
//!
//! A smooth gradient becomes one region, however much the colours of its ends differ. A painter
//! lays such a gradient in a few washes. So we divide the modes of a region by the plane through
//! their mean perpendicular to the axis of greatest variance, until no part has a greater variance
//! than colours spread evenly over one step.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rayon::prelude::*;

use super::mean_shift::{Bandwidth, Mode};
use crate::field::Field;

/// Disjoint sets (union-find), each identified by its smallest member.
pub(super) struct Sets {
    parents: Vec<u32>,
}

impl Sets {
    pub(super) fn new(count: usize) -> Self {
        Self { parents: (0..count as u32).collect() }
    }

    /// The smallest member of the set of `member`.
    pub(super) fn least(&mut self, mut member: u32) -> u32 {
        while self.parents[member as usize] != member {
            let parent = self.parents[member as usize];
            self.parents[member as usize] = self.parents[parent as usize];
            member = parent;
        }
        member
    }

    /// Unites the sets of two members. Returns the smallest member of the union.
    pub(super) fn join(&mut self, one: u32, other: u32) -> u32 {
        let one = self.least(one);
        let other = self.least(other);
        let least = one.min(other);
        let greater = one.max(other);
        self.parents[greater as usize] = least;
        least
    }
}

/// Renumbers labels without gaps, in the order in which they first appear row by row. Returns how
/// many different labels there are.
pub(super) fn numbered(sets: &mut Sets, labels: &mut [u32], count: usize) -> usize {
    const NONE: u32 = u32::MAX;
    let mut numbers = vec![NONE; count];
    let mut found = 0;
    for label in labels {
        let number = &mut numbers[sets.least(*label) as usize];
        if *number == NONE {
            *number = found;
            found += 1;
        }
        *label = *number;
    }
    found as usize
}

/// We link neighbours if the colours of their modes differ by at most this, in range radii. With
/// 1, the pixels of a soft edge would link the regions on both sides. A region that this value
/// divides needlessly is merged again later.
const LINK: f32 = 0.5;

/// Labels every pixel with its region. Returns the labels with the number of regions. This links
/// neighbours in a row or column if their modes are within the spatial radius and half the range
/// radius of each other, and both are `painted` or both bare. Regions are the connected components
/// (Comaniciu and Meer 2002, section 4.2, step 2).
pub(super) fn linked(
    modes: &Field<Mode>,
    painted: impl Fn(usize) -> bool,
    bandwidth: Bandwidth,
) -> (Field<u32>, usize) {
    let width = modes.width();
    let height = modes.height();
    let [near_px, near] = [bandwidth.spatial_px.powi(2), (LINK * bandwidth.range).powi(2)];
    let values = modes.values();
    let alike = |one: usize, other: usize| {
        let a = &values[one];
        let b = &values[other];
        let [l, u, v] = [0, 1, 2].map(|i| a.color[i] - b.color[i]);
        let x = a.x - b.x;
        let y = a.y - b.y;
        (l * l + u * u + v * v <= near)
            & (x * x + y * y <= near_px)
            & (painted(one) == painted(other))
    };
    let mut sets = Sets::new(values.len());
    for y in 0..height {
        for x in 0..width {
            let pixel = y * width + x;
            if x > 0 && alike(pixel, pixel - 1) {
                sets.join(pixel as u32, pixel as u32 - 1);
            }
            if y > 0 && alike(pixel, pixel - width) {
                sets.join(pixel as u32, (pixel - width) as u32);
            }
        }
    }
    let mut labels: Vec<u32> = (0..values.len() as u32).collect();
    let count = numbered(&mut sets, &mut labels, values.len());
    (Field::from_values(width, height, labels), count)
}

#[derive(Debug, Clone, Copy, Default)]
struct Weight {
    pixels: u32,
    /// Sums of L*, u*, v* of the modes.
    colors: [f64; 3],
    painted: u32,
}

/// The regions of a picture. A merged region keeps the smallest label of its parts.
pub(super) struct RegionGraph {
    weights: Vec<Weight>,
    /// Labels of the neighbours of each region. Some may have been merged since then.
    neighbours: Vec<Vec<u32>>,
    sets: Sets,
}

impl RegionGraph {
    pub(super) fn new(
        labels: &Field<u32>,
        count: usize,
        modes: &Field<Mode>,
        painted: impl Fn(usize) -> bool,
    ) -> Self {
        let mut weights = vec![Weight::default(); count];
        for (pixel, (&label, mode)) in labels.values().iter().zip(modes.values()).enumerate() {
            let weight = &mut weights[label as usize];
            weight.pixels += 1;
            weight.painted += u32::from(painted(pixel));
            for (sum, value) in weight.colors.iter_mut().zip(mode.color) {
                *sum += f64::from(value);
            }
        }
        Self { weights, neighbours: neighbours(labels, count), sets: Sets::new(count) }
    }

    pub(super) fn count(&self) -> usize {
        self.weights.len()
    }

    /// Number of pixels of a region. This is 0 if it was merged into another.
    pub(super) fn pixels(&self, region: u32) -> u32 {
        self.weights[region as usize].pixels
    }

    /// The distance between the mean colours of two regions in CIELUV, as means over the modes of
    /// their pixels. We add a large constant if one is paint and the other bare paper.
    pub(super) fn apart(&self, one: u32, other: u32) -> f64 {
        const PAPER: f64 = 1e4;
        let [one, other] = [one, other].map(|region| &self.weights[region as usize]);
        fn mean(sum: f64, of: &Weight) -> f64 {
            sum / f64::from(of.pixels)
        }
        fn off(i: usize, one: &Weight, other: &Weight) -> f64 {
            mean(one.colors[i], one) - mean(other.colors[i], other)
        }
        let paper = PAPER * (mean(one.painted.into(), one) - mean(other.painted.into(), other));
        (off(0, one, other).powi(2)
            + off(1, one, other).powi(2)
            + off(2, one, other).powi(2)
            + paper.powi(2))
        .sqrt()
    }

    pub(super) fn around(&mut self, region: u32) -> &[u32] {
        let mut around = std::mem::take(&mut self.neighbours[region as usize]);
        around.iter_mut().for_each(|label| *label = self.sets.least(*label));
        around.sort_unstable();
        around.dedup();
        around.retain(|&label| label != region);
        self.neighbours[region as usize] = around;
        &self.neighbours[region as usize]
    }

    /// Merges two regions. Returns the label of the merged one.
    pub(super) fn join(&mut self, one: u32, other: u32) -> u32 {
        let whole = self.sets.join(one, other);
        let part = if whole == one { other } else { one };
        let added = std::mem::take(&mut self.weights[part as usize]);
        let weight = &mut self.weights[whole as usize];
        weight.pixels += added.pixels;
        weight.painted += added.painted;
        for (sum, more) in weight.colors.iter_mut().zip(added.colors) {
            *sum += more;
        }
        let mut short = std::mem::take(&mut self.neighbours[part as usize]);
        let long = &mut self.neighbours[whole as usize];
        if long.len() < short.len() {
            std::mem::swap(long, &mut short);
        }
        long.append(&mut short);
        whole
    }

    /// Replaces `labels` by the labels of the merged regions, and numbers these without gaps.
    /// Returns the number of regions.
    pub(super) fn relabel(mut self, labels: &mut Field<u32>) -> usize {
        numbered(&mut self.sets, labels.values_mut(), self.weights.len())
    }
}

fn neighbours(labels: &Field<u32>, count: usize) -> Vec<Vec<u32>> {
    let rows: Vec<&[u32]> = labels.values().chunks_exact(labels.width()).collect();
    let mut pairs: Vec<u64> = (0..rows.len())
        .into_par_iter()
        .flat_map_iter(|y: usize| {
            let row = rows[y];
            let below = rows.get(y + 1).copied().unwrap_or(row);
            let beside = row.iter().zip(&row[1..]).chain(row.iter().zip(below));
            let apart = beside.filter(|(a, b)| a != b);
            apart.map(|(&a, &b)| (u64::from(a.min(b)) << 32) | u64::from(a.max(b)))
        })
        .collect();
    pairs.par_sort_unstable();
    pairs.dedup();
    let mut neighbours = vec![Vec::new(); count];
    for pair in pairs {
        let a = (pair >> 32) as u32;
        let b = pair as u32;
        neighbours[a as usize].push(b);
        neighbours[b as usize].push(a);
    }
    neighbours
}

/// Merges each region of fewer than `least_px` pixels into the neighbour of the nearest mean colour
/// (see [`RegionGraph::apart`]), the smallest region first, until none is left or there is one
/// region. Ties go to the smallest label.
pub(super) fn join_small(graph: &mut RegionGraph, least_px: u32) {
    let all = (0..graph.count() as u32).map(|region| Reverse((graph.pixels(region), region)));
    let mut small: BinaryHeap<_> = all.filter(|Reverse((pixels, _))| *pixels < least_px).collect();
    while let Some(Reverse((pixels, region))) = small.pop() {
        // We may have joined it since.
        if graph.pixels(region) != pixels {
            continue;
        }
        let around = graph.around(region).to_vec();
        let nearest = around
            .into_iter()
            .min_by(|&a, &b| graph.apart(region, a).total_cmp(&graph.apart(region, b)));
        let Some(nearest) = nearest else { continue };
        let whole = graph.join(region, nearest);
        if graph.pixels(whole) < least_px {
            small.push(Reverse((graph.pixels(whole), whole)));
        }
    }
}

/// Merges neighbours if their mean colours differ by at most `range` in CIELUV (see
/// [`RegionGraph::apart`]), the nearest first. Ties go to the smallest labels.
pub(super) fn join_alike(graph: &mut RegionGraph, range: f64) {
    // Distances are not negative, so their bit patterns sort in the same order.
    let mut pairs = BinaryHeap::new();
    for region in 0..graph.count() as u32 {
        for other in graph.around(region).to_vec() {
            let apart = graph.apart(region, other);
            if region < other && apart <= range {
                pairs.push(Reverse((apart.to_bits(), region, other)));
            }
        }
    }
    while let Some(Reverse((apart, one, other))) = pairs.pop() {
        // Either may have changed since.
        let current = graph.pixels(one) > 0
            && graph.pixels(other) > 0
            && graph.apart(one, other).to_bits() == apart;
        if !current {
            continue;
        }
        let whole = graph.join(one, other);
        for other in graph.around(whole).to_vec() {
            let apart = graph.apart(whole, other);
            if apart <= range {
                let one = whole.min(other);
                let other = whole.max(other);
                pairs.push(Reverse((apart.to_bits(), one, other)));
            }
        }
    }
}

const ROUNDS: usize = 24;

/// Divides the `count` regions of `labels` until the variance of a part along any axis is at most
/// `step`^2 / 12. This is the variance of colours spread evenly over `step` in CIELUV. Then
/// divides them into connected parts. Returns the new labels and their number.
pub(super) fn cut(
    labels: &Field<u32>,
    count: usize,
    modes: &Field<Mode>,
    step: f32,
) -> (Field<u32>, usize) {
    let most = f64::from(step).powi(2) / 12.0;
    let mut pixels = by_region(labels, count);
    let parts: Vec<Vec<&mut [u32]>> = pixels
        .par_iter_mut()
        .map(|region| {
            let mut parts = Vec::new();
            halve(region, modes.values(), most, &mut parts);
            parts
        })
        .collect();
    let mut part_of = vec![0u32; labels.values().len()];
    for (number, part) in (0u32..).zip(parts.iter().flatten()) {
        part.iter().for_each(|&pixel| part_of[pixel as usize] = number);
    }
    let width = labels.width();
    let height = labels.height();
    let mut sets = Sets::new(part_of.len());
    for pixel in 0..part_of.len() {
        let x = pixel % width;
        let y = pixel / width;
        if x > 0 && part_of[pixel] == part_of[pixel - 1] {
            sets.join(pixel as u32, pixel as u32 - 1);
        }
        if y > 0 && part_of[pixel] == part_of[pixel - width] {
            sets.join(pixel as u32, (pixel - width) as u32);
        }
    }
    let mut own: Vec<u32> = (0..part_of.len() as u32).collect();
    let count = numbered(&mut sets, &mut own, part_of.len());
    (Field::from_values(width, height, own), count)
}

fn by_region(labels: &Field<u32>, count: usize) -> Vec<Vec<u32>> {
    let mut sizes = vec![0; count];
    labels.values().iter().for_each(|&label| sizes[label as usize] += 1);
    let mut pixels: Vec<Vec<u32>> = sizes.into_iter().map(Vec::with_capacity).collect();
    for (pixel, &label) in (0..).zip(labels.values()) {
        pixels[label as usize].push(pixel);
    }
    pixels
}

/// Halves `pixels` until no part has a variance above `most` along any axis.
fn halve<'a>(pixels: &'a mut [u32], modes: &[Mode], most: f64, parts: &mut Vec<&'a mut [u32]>) {
    let Some(plane) = Plane::across(pixels, modes).filter(|plane| plane.variance > most) else {
        parts.push(pixels);
        return;
    };
    // This sort is stable: pixels below the plane come first, and each side keeps its order.
    pixels.sort_by_key(|&pixel| plane.height(&modes[pixel as usize]) >= 0.0);
    let below = pixels.partition_point(|&pixel| plane.height(&modes[pixel as usize]) < 0.0);
    if below == 0 || below == pixels.len() {
        parts.push(pixels);
        return;
    }
    let (low, high) = pixels.split_at_mut(below);
    halve(low, modes, most, parts);
    halve(high, modes, most, parts);
}

/// Goes through the mean colour, perpendicular to the axis of greatest variance.
struct Plane {
    mean: [f64; 3],
    axis: [f64; 3],
    variance: f64,
}

impl Plane {
    fn across(pixels: &[u32], modes: &[Mode]) -> Option<Self> {
        let count = pixels.len() as f64;
        let mut sums = [0.0; 3];
        let mut squares = [[0.0; 3]; 3];
        for &pixel in pixels {
            let color = modes[pixel as usize].color.map(f64::from);
            for i in 0..3 {
                sums[i] += color[i];
                for j in 0..3 {
                    squares[i][j] += color[i] * color[j];
                }
            }
        }
        let mean = sums.map(|sum| sum / count);
        let covariance: [[f64; 3]; 3] = std::array::from_fn(|i| {
            std::array::from_fn(|j| squares[i][j] / count - mean[i] * mean[j])
        });
        // If we start from the channel of greatest variance, the start is hardly ever
        // perpendicular to the axis.
        let first = (0..3).max_by(|&a, &b| covariance[a][a].total_cmp(&covariance[b][b]))?;
        let mut axis = covariance[first];
        let mut variance = 0.0;
        for _ in 0..ROUNDS {
            let length = axis.iter().map(|v| v * v).sum::<f64>().sqrt();
            if length <= 0.0 {
                return None;
            }
            let unit = axis.map(|v| v / length);
            axis = covariance.map(|row| (0..3).map(|i| row[i] * unit[i]).sum());
            variance = (0..3).map(|i| axis[i] * unit[i]).sum();
        }
        Some(Self { mean, axis, variance })
    }

    /// Signed distance from the plane in arbitrary units, positive above it.
    fn height(&self, mode: &Mode) -> f64 {
        (0..3).map(|i| self.axis[i] * (f64::from(mode.color[i]) - self.mean[i])).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::super::mean_shift::Mode;
    use super::*;
    use crate::field::Field;

    #[test]
    fn sets_are_told_by_their_least() {
        let mut sets = Sets::new(5);
        assert_eq!(sets.join(4, 2), 2);
        assert_eq!(sets.join(4, 1), 1);
        assert_eq!([0, 1, 2, 3, 4].map(|member| sets.least(member)), [0, 1, 1, 3, 1]);
        let mut labels = [3, 4, 0, 2];
        assert_eq!(numbered(&mut sets, &mut labels, 5), 3);
        assert_eq!(labels, [0, 1, 2, 1]);
    }

    #[test]
    fn links_reach_over_steps_within_the_bandwidths_only() {
        // The row has steps in L* of 2, 2, 3, then a step of place, then the paper's edge.
        let row = [(0.0, 10.0), (0.0, 12.0), (0.0, 14.0), (0.0, 17.0), (9.0, 17.0), (9.0, 17.0)];
        let modes = Field::from_values(
            6,
            1,
            row.map(|(x, l)| Mode { x, y: 0.0, color: [l, 0.0, 0.0] }).to_vec(),
        );
        let bandwidth = Bandwidth { spatial_px: 4.0, range: 4.0 };
        let (labels, count) = linked(&modes, |pixel| pixel < 5, bandwidth);
        assert_eq!((labels.values(), count), (&[0, 0, 0, 1, 2, 3][..], 4));
    }

    /// The labels of a row of regions after `joining`. You give a region by its number of pixels
    /// and its L*.
    fn joined(regions: &[(usize, f32)], joining: impl Fn(&mut RegionGraph)) -> Vec<u32> {
        let mut labels = Vec::new();
        let mut modes = Vec::new();
        for (label, &(pixels, l)) in (0..).zip(regions) {
            labels.extend(vec![label; pixels]);
            modes.extend(vec![Mode { color: [l, 0.0, 0.0], ..Mode::default() }; pixels]);
        }
        let width = labels.len();
        let mut labels = Field::from_values(width, 1, labels);
        let modes = Field::from_values(width, 1, modes);
        let mut graph = RegionGraph::new(&labels, regions.len(), &modes, |_| true);
        joining(&mut graph);
        let count = graph.relabel(&mut labels);
        assert_eq!(labels.values().last().copied(), Some(count as u32 - 1));
        labels.values().to_vec()
    }

    #[test]
    fn the_small_join_the_nearest_in_color() {
        fn row(l: f32) -> Vec<u32> {
            joined(&[(3, 10.0), (1, l), (3, 60.0)], |graph| join_small(graph, 2))
        }
        assert_eq!(row(40.0), [0, 0, 0, 1, 1, 1, 1]);
        assert_eq!(row(30.0), [0, 0, 0, 0, 1, 1, 1]);
    }

    #[test]
    fn the_smallest_goes_first_and_the_whole_counts() {
        let row = [(4, 0.0), (1, 50.0), (2, 60.0), (4, 90.0)];
        let found = joined(&row, |graph| join_small(graph, 3));
        assert_eq!(found, [0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2]);
        assert_eq!(joined(&[(2, 0.0)], |graph| join_small(graph, 10)), [0, 0]);
        let row = [(2, 0.0), (1, 9.0), (3, 20.0)];
        assert_eq!(joined(&row, |graph| join_small(graph, 10)), [0; 6]);
    }

    #[test]
    fn the_alike_are_joined_the_nearest_first() {
        // 7 with 9.9, then 4 with 1. Their means, 2 and 8.45, are too far apart.
        let row = [(2, 1.0), (1, 4.0), (2, 7.0), (2, 9.9)];
        let found = joined(&row, |graph| join_alike(graph, 4.0));
        assert_eq!(found, [0, 0, 0, 1, 1, 1, 1]);
        assert_eq!(joined(&row, |graph| join_alike(graph, 2.0)), [0, 0, 1, 2, 2, 3, 3]);
    }

    #[test]
    fn paint_does_not_join_paper_unless_it_must() {
        let mut labels = Field::from_values(5, 1, vec![0, 0, 1, 2, 2]);
        let modes = Field::filled(5, 1, Mode::default());
        let mut graph = RegionGraph::new(&labels, 3, &modes, |pixel| pixel > 1);
        join_small(&mut graph, 2);
        join_alike(&mut graph, 100.0);
        assert_eq!(graph.relabel(&mut labels), 2);
        assert_eq!(labels.values(), [0, 0, 1, 1, 1]);
    }

    fn row(colors: &[[f32; 3]]) -> Field<Mode> {
        let modes = colors.iter().map(|&color| Mode { color, ..Mode::default() }).collect();
        Field::from_values(colors.len(), 1, modes)
    }

    #[test]
    fn a_ramp_is_cut_into_even_steps() {
        let colors: Vec<[f32; 3]> = (0..80).map(|i| [i as f32, 0.0, i as f32 / 2.0]).collect();
        let labels = Field::filled(80, 1, 0);
        // 80 of L* and 40 of v* are 89.4 in all: four steps of 22.4.
        let (found, count) = cut(&labels, 1, &row(&colors), 23.0);
        assert_eq!(count, 4);
        let wanted: Vec<u32> = (0..80).map(|i| i / 20).collect();
        assert_eq!(found.values(), wanted);
        assert_eq!(
            [60.0, 88.0, 90.0].map(|step| cut(&labels, 1, &row(&colors), step).1),
            [2, 2, 1]
        );
    }

    #[test]
    fn parts_hang_together_and_stay_in_their_region() {
        let colors = [0.0, 0.0, 50.0, 0.0, 0.0, 0.0].map(|l| [l, 0.0, 0.0]);
        let labels = Field::from_values(6, 1, vec![0, 0, 0, 0, 1, 1]);
        let (found, count) = cut(&labels, 2, &row(&colors), 20.0);
        assert_eq!((found.values(), count), (&[0, 0, 1, 2, 3, 3][..], 4));
    }

    #[test]
    fn even_color_is_not_cut() {
        let labels = Field::filled(5, 1, 0);
        assert_eq!(cut(&labels, 1, &row(&[[30.0, 7.0, -3.0]; 5]), 1.0).1, 1);
    }
}
