//! Places in the map at which strokes continue those of their neighbours.
//!
//! Strokes are placed one after the other, each beside those that are placed already. Candidates
//! are the places at which one of the neighbours would go on, and random ones; the candidate that
//! differs least from what the neighbours show is taken. This happens once for a model, at the
//! size that strokes have where the model fills the picture. Seen larger or smaller, strokes go on
//! in each other within patches of some splats ([`Start`]); patches are small, because a change of
//! size moves strokes by their way from the patch's origin.

use std::collections::VecDeque;

use glam::Vec2;
use graphics::coherence::Feature;
use rayon::prelude::*;

use super::grid::Grid;
use super::regions::Style;
use super::roots::{Root, Start, alike, way};
use super::tones::Tones;

/// Random candidates beside the continuations.
const RANDOM: u64 = 64;

/// Number of a feature's first random candidate.
const FIRST_RANDOM: u64 = 32;

/// Most neighbours of a stroke.
const NEIGHBOURS: usize = 10;

/// Radius of a patch of the model that goes on in the map, in half lengths of splats.
const PATCH: f32 = 6.0;

/// Texels between strokes where they are compared.
const COMPARED_SPACING: f32 = 4.0;

/// Mean squared difference, by that of unrelated places, at which a continuation is good enough.
const GOOD: f32 = 0.02;

/// Places of a splat at which it is compared, by half its width and length.
const PROBES: [[f32; 2]; 21] = [
    [0.0, 0.0],
    [0.35, 0.0],
    [-0.35, 0.0],
    [0.0, 0.35],
    [0.0, -0.35],
    [0.3, 0.3],
    [-0.3, 0.3],
    [0.3, -0.3],
    [-0.3, -0.3],
    [0.7, 0.0],
    [-0.7, 0.0],
    [0.0, 0.7],
    [0.0, -0.7],
    [0.55, 0.45],
    [-0.55, 0.45],
    [0.55, -0.45],
    [-0.55, -0.45],
    [0.2, 0.65],
    [-0.2, -0.65],
    [0.65, -0.2],
    [-0.65, 0.2],
];

/// Strokes to match.
pub(super) struct Matching<'a> {
    pub(super) features: &'a [Feature],
    pub(super) roots: &'a [Root],
    pub(super) tones: &'a Tones,
    /// Index of the tone of each map by which strokes are compared.
    pub(super) slices: &'a [usize],
    /// How strokes are painted, by region.
    pub(super) styles: &'a [Style],
    /// Half the width and length of a splat in units of the model, before the size of its region.
    pub(super) radii: [f32; 2],
    /// Distance of neighbouring strokes in units of the model, before the size of the region.
    pub(super) width: f32,
}

/// The brushwork that is compared.
struct Greys {
    size: usize,
    values: Vec<f32>,
    /// Twice the variance: the mean squared difference of unrelated places.
    unrelated: f32,
}

impl Greys {
    fn of(tones: &Tones, map: usize, slice: usize) -> Self {
        let halvings = tones.halvings(map, tones.map(map).spacing / COMPARED_SPACING);
        let texels = tones.texels(slice, halvings);
        let size = texels.size;
        let bytes = (0..size * size).map(|at| texels.between(at % size, at / size, 0, 0));
        let values: Vec<f32> = bytes.map(|[first, ..]| first / 256.0).collect();
        let mean = values.iter().sum::<f32>() / values.len() as f32;
        let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f32>();
        Self { size, unrelated: 2.0 * variance / values.len() as f32, values }
    }

    /// The grey at a place in widths of the map, interpolated.
    fn at(&self, place: Vec2) -> f32 {
        let size = self.size as f32;
        let at = (place - place.floor()) * size;
        let whole = at.floor();
        let share = at - whole;
        let [x, y] = [whole.x as usize % self.size, whole.y as usize % self.size];
        let [right, below] = [(x + 1) % self.size, (y + 1) % self.size];
        let value = |x: usize, y: usize| self.values[y * self.size + x];
        let mix = |a: f32, b: f32, share: f32| a + (b - a) * share;
        let upper = mix(value(x, y), value(right, y), share.x);
        mix(upper, mix(value(x, below), value(right, below), share.x), share.y)
    }
}

/// What a stroke is compared with at one of its places.
struct Probe {
    /// From its centre, in widths of the map.
    place: Vec2,
    grey: f32,
    weight: f32,
}

impl Matching<'_> {
    fn style(&self, index: usize) -> &Style {
        &self.styles[usize::from(self.roots[index].place.region)]
    }

    /// Half the width and length of a splat in units of the model.
    fn radii(&self, index: usize) -> [f32; 2] {
        self.radii.map(|radius| radius * self.style(index).size)
    }

    /// Widths of the map of a stroke to a unit of the model.
    fn widths_per_unit(&self, index: usize) -> f32 {
        let Style { map, size, .. } = *self.style(index);
        let map = self.tones.map(map);
        map.spacing / (self.width * size * map.size as f32)
    }

    /// Where all strokes start in the map; and the share of strokes that continue a neighbour.
    pub(super) fn starts(&self) -> (Vec<Start>, f64) {
        let maps = self.slices.iter().enumerate();
        let greys: Vec<Greys> =
            maps.map(|(map, &slice)| Greys::of(self.tones, map, slice)).collect();
        let neighbours = self.neighbours();
        let mut placed: Vec<Option<Start>> = vec![None; self.roots.len()];
        let mut waiting = VecDeque::new();
        let mut seen = vec![false; self.roots.len()];
        let mut continued = 0;
        for first in 0..self.roots.len() {
            if seen[first] {
                continue;
            }
            seen[first] = true;
            waiting.push_back(first);
            while let Some(index) = waiting.pop_front() {
                let (start, continues) =
                    self.place(index, &neighbours[index], &placed, &greys[self.style(index).map]);
                placed[index] = Some(start);
                continued += usize::from(continues);
                for &next in &neighbours[index] {
                    if !std::mem::replace(&mut seen[next as usize], true) {
                        waiting.push_back(next as usize);
                    }
                }
            }
        }
        let starts = placed.into_iter().map(Option::unwrap_or_default).collect();
        (starts, continued as f64 / self.roots.len().max(1) as f64)
    }

    /// Where one stroke starts, and whether it continues a neighbour.
    fn place(
        &self,
        index: usize,
        neighbours: &[u32],
        placed: &[Option<Start>],
        greys: &Greys,
    ) -> (Start, bool) {
        let own = &self.roots[index];
        let widths_per_unit = self.widths_per_unit(index);
        let beside: Vec<(usize, Start)> = neighbours
            .iter()
            .filter_map(|&other| Some((other as usize, placed[other as usize]?)))
            .collect();
        let probes = self.probes(index, &beside, greys);
        // A sum of squares only grows: above the least cost so far the rest does not matter.
        let cost = |start: &Start, least: f32| -> f32 {
            let offset = start.at(widths_per_unit);
            let mut sum = 0.0;
            for probe in &probes {
                sum += probe.weight * (greys.at(offset + probe.place) - probe.grey).powi(2);
                if sum >= least {
                    break;
                }
            }
            sum
        };
        let mut best = (f32::INFINITY, own.start, false);
        let mut offer = |start: Start, continues: bool| {
            let cost = cost(&start, best.0);
            if cost < best.0 {
                best = (cost, start, continues);
            }
            best
        };
        let good = GOOD * greys.unrelated * probes.iter().map(|probe| probe.weight).sum::<f32>();
        let mut beyond = Vec::new();
        let reach = PATCH * self.radii(index)[1];
        for &(other, start) in &beside {
            let from = (&self.features[other], &self.roots[other].place);
            let next = start.further(way(from, (&self.features[index], &own.place)));
            if next.way.length() <= reach {
                offer(next, true);
            } else {
                // The same place in the map, as the origin of a new patch.
                let origin = next.at(widths_per_unit);
                beyond.push(Start { origin, way: Vec2::ZERO });
            }
        }
        if probes.is_empty() {
            return (own.start, false);
        }
        if offer(own.start, false).0 > good {
            beyond.into_iter().for_each(|start| _ = offer(start, true));
        }
        if offer(own.start, false).0 > good {
            for number in 0..RANDOM {
                let unit = |axis| self.features[index].unit(FIRST_RANDOM + 2 * number + axis);
                let origin = Vec2::new(unit(0), unit(1));
                offer(Start { origin, way: Vec2::ZERO }, false);
            }
        }
        (best.1, best.2)
    }

    /// What the placed neighbours show at the places of a stroke.
    fn probes(&self, index: usize, beside: &[(usize, Start)], greys: &Greys) -> Vec<Probe> {
        let radii = self.radii(index);
        let widths_per_unit = self.widths_per_unit(index);
        let beside: Vec<(usize, Vec2)> =
            beside.iter().map(|(other, start)| (*other, start.at(widths_per_unit))).collect();
        let place = &self.roots[index].place;
        let center = self.features[index].position;
        let probe = |[a, b]: [f32; 2]| {
            let at = center + place.across() * (a * radii[0]) + place.along * (b * radii[1]);
            let mut sum = 0.0;
            let mut total = 0.0;
            for &(other, offset) in &beside {
                let there = &self.roots[other].place;
                let from = at - self.features[other].position;
                let [x, y] = [from.dot(there.across()), from.dot(there.along)];
                let square = (x / radii[0]).powi(2) + (y / radii[1]).powi(2);
                let weight = (1.0 - square).max(0.0).powi(8);
                if weight > 0.0 {
                    sum += weight * greys.at(offset + Vec2::new(x, y) * widths_per_unit);
                    total += weight;
                }
            }
            // A place that neighbours hardly reach shows this stroke alone.
            let own = (1.0 - a * a - b * b).max(0.0).powi(2);
            (total > 1e-4).then(|| Probe {
                place: Vec2::new(a * radii[0], b * radii[1]) * widths_per_unit,
                grey: sum / total,
                weight: own * (total / (total + 0.05)),
            })
        };
        PROBES.into_iter().filter_map(probe).collect()
    }

    /// For each stroke the nearest others that overlap it on the same side of the surface.
    fn neighbours(&self) -> Vec<Vec<u32>> {
        let largest = self.styles.iter().map(|style| style.size).fold(0.0, f32::max);
        let reach = largest * self.radii[0].max(self.radii[1]);
        let grid = Grid::new(self.features.iter().map(|feature| feature.position), reach);
        let near = |index: usize| {
            let own = self.features[index].position;
            let place = &self.roots[index].place;
            let radii = self.radii(index);
            let off = |other: usize| {
                let from = self.features[other].position - own;
                let across = from.dot(place.across()) / radii[0];
                let along = from.dot(place.along) / radii[1];
                let above = from.dot(place.normal) / radii[0];
                across * across + along * along + above * above
            };
            let mut found: Vec<(f32, u32)> = grid
                .near(own)
                .filter(|&other| other != index && alike(&self.roots[other].place, place))
                .map(|other| (off(other), other as u32))
                .filter(|(square, _)| *square < 1.0)
                .collect();
            found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            found.truncate(NEIGHBOURS);
            found.into_iter().map(|(_, other)| other).collect()
        };
        (0..self.features.len()).into_par_iter().map(near).collect()
    }
}
