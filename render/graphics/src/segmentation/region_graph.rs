//! The graph of regions and their neighbours, in which two regions at a time are merged.

use rayon::prelude::*;

use super::mean_shift::Mode;
use super::regions::{Sets, numbered};
use crate::field::Field;

/// Sums over the pixels of a region.
#[derive(Debug, Clone, Copy, Default)]
struct Weight {
    /// Number of pixels.
    pixels: u32,
    /// Sums of L*, u*, v* of the modes.
    colors: [f64; 3],
    /// Number of pixels with paint.
    painted: u32,
}

/// The regions of a picture. A merged region keeps the smallest label of its parts.
pub(super) struct RegionGraph {
    weights: Vec<Weight>,
    /// Labels of the neighbours of each region; some may have been merged since.
    neighbours: Vec<Vec<u32>>,
    sets: Sets,
}

impl RegionGraph {
    /// The graph of `count` labelled regions with the modes of their pixels.
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

    /// Number of labels, merged regions included.
    pub(super) fn count(&self) -> usize {
        self.weights.len()
    }

    /// Number of pixels of a region; 0 if it was merged into another.
    pub(super) fn pixels(&self, region: u32) -> u32 {
        self.weights[region as usize].pixels
    }

    /// The distance of the mean modes of two regions in CIELUV, increased by a large constant
    /// if one is paint and the other bare paper.
    pub(super) fn apart(&self, one: u32, other: u32) -> f64 {
        const PAPER: f64 = 1e4;
        let [one, other] = [one, other].map(|region| &self.weights[region as usize]);
        let mean = |sum: f64, of: &Weight| sum / f64::from(of.pixels);
        let off = |i: usize| mean(one.colors[i], one) - mean(other.colors[i], other);
        let paper = PAPER * (mean(one.painted.into(), one) - mean(other.painted.into(), other));
        (off(0).powi(2) + off(1).powi(2) + off(2).powi(2) + paper.powi(2)).sqrt()
    }

    /// The neighbours of a region, by rising label.
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

    /// Replaces `labels` by those of the merged regions, numbered without gaps. Returns the
    /// number of regions.
    pub(super) fn relabel(mut self, labels: &mut Field<u32>) -> usize {
        numbered(&mut self.sets, labels.values_mut(), self.weights.len())
    }
}

/// The neighbours of each region, by rising label.
fn neighbours(labels: &Field<u32>, count: usize) -> Vec<Vec<u32>> {
    let rows: Vec<&[u32]> = labels.values().chunks_exact(labels.width()).collect();
    let along = |y: usize| {
        let row = rows[y];
        let below = rows.get(y + 1).copied().unwrap_or(row);
        let beside = row.iter().zip(&row[1..]).chain(row.iter().zip(below));
        let apart = beside.filter(|(a, b)| a != b);
        apart.map(|(&a, &b)| (u64::from(a.min(b)) << 32) | u64::from(a.max(b)))
    };
    let mut pairs: Vec<u64> = (0..rows.len()).into_par_iter().flat_map_iter(along).collect();
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
