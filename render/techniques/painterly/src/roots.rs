//! Strokes at rest: the stroke that each feature of the model carries, whatever the view, and the
//! places in the map at which strokes continue their neighbours.
//!
//! We place strokes one after the other, each beside those that we have placed already. Candidates
//! are the places at which one of the neighbours would go on, and random ones. We take the
//! candidate that differs least from the neighbours. This happens once for a model, at the size
//! that strokes have where the model fills the picture. If you see it larger or smaller, strokes go
//! on in each other within patches of some splats ([`Start`]). Patches are small, because a change
//! of size moves strokes by their way from the patch's origin.

use std::collections::VecDeque;
use std::sync::Arc;

use glam::{Vec2, Vec3};
use graphics::coherence::{Feature, Features};
use rayon::prelude::*;

use super::coloring::Coloring;
use super::places::{Place, Surface};
use super::regions::Style;
use super::tones::Tones;

/// Least cosine between the normals of strokes that continue each other.
const ALIKE: f32 = 0.6;

/// Which random numbers of a feature give the random place in the map where its stroke starts.
const RANDOM: [u64; 2] = [16, 17];

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Root {
    pub(super) place: Place,
    /// Where it starts in the map.
    pub(super) start: Start,
    /// Colour that is added to the map's.
    pub(super) color: Vec3,
    /// Tone, 0 to 1 of the map's, that does not depend on light, `None` if light decides.
    pub(super) tone: Option<f32>,
}

/// The place in the map that you see at the centre of a stroke. Strokes of one patch of the model
/// go on in the map as they do on the model, at whatever size you see them. Each adds its way from
/// the origin of its patch.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Start {
    /// Place in the map of the origin of the patch, in widths of the map.
    pub(super) origin: Vec2,
    /// Way from the origin, across and along the strokes, in units of the model.
    pub(super) way: Vec2,
}

impl Start {
    /// Place in the map, 0 to 1 in widths of the map. A unit of the model is `widths_per_unit`
    /// widths.
    pub(super) fn at(&self, widths_per_unit: f32) -> Vec2 {
        let place = self.origin + self.way * widths_per_unit;
        place - place.floor()
    }

    /// A start further on in this patch of the map.
    pub(super) fn further(&self, way: Vec2) -> Self {
        Self { way: self.way + way, ..*self }
    }
}

/// From the centre of one stroke to the centre of another, across and along the mean of both their
/// axes, in units of the model.
pub(super) fn way(from: (&Feature, &Place), to: (&Feature, &Place)) -> Vec2 {
    let between = to.0.position - from.0.position;
    fn part(one: Vec3, other: Vec3, between: Vec3) -> f32 {
        let other = if one.dot(other) < 0.0 { one } else { other };
        between.dot(one + other) / 2.0
    }
    Vec2::new(
        part(from.1.across(), to.1.across(), between),
        part(from.1.along, to.1.along, between),
    )
}

/// Whether the strokes of two places continue each other. This needs one side of the surface and
/// one region.
pub(super) fn alike(one: &Place, other: &Place) -> bool {
    one.normal.dot(other.normal) > ALIKE && one.region == other.region
}

/// The strokes of a subject. We keep those up to some density. We make all others when you ask for
/// them. Each of these continues the nearest kept one.
#[derive(Debug)]
pub(super) struct Roots {
    surface: Surface,
    coloring: Arc<Coloring>,
    /// L* of the darkest and of the lightest tone, where the subject's lightness decides the tone.
    lightness: Option<[f32; 2]>,
    /// Seeds of kept strokes, rising.
    seeds: Vec<u64>,
    /// Kept strokes and their features, in the order of the seeds.
    kept: Vec<Root>,
    features: Vec<Feature>,
    /// The kept strokes by place, where others continue them.
    grid: Option<Grid>,
}

impl Roots {
    /// Strokes on a surface, none of them kept. With `lightness`, their tone follows the colour of
    /// the surface, from the first L* to the last. Without, it follows the light.
    pub(super) fn new(
        surface: Surface,
        coloring: Arc<Coloring>,
        lightness: Option<[f32; 2]>,
    ) -> Self {
        let seeds = Vec::new();
        let kept = Vec::new();
        let features = Vec::new();
        Self { surface, coloring, lightness, seeds, kept, features, grid: None }
    }

    pub(super) fn style(&self, root: &Root) -> &Style {
        &self.surface.regions.styles[usize::from(root.place.region)]
    }

    pub(super) fn styles(&self) -> &[Style] {
        &self.surface.regions.styles
    }

    pub(super) fn count(&self) -> usize {
        self.kept.len()
    }

    /// Least and greatest size of strokes relative to the settings.
    pub(super) fn sizes(&self) -> [f32; 2] {
        self.surface.regions.sizes()
    }

    /// Keeps the strokes of the features with a priority below `priority`, in place of the strokes
    /// kept before. They start where `starts` says, or at random if it returns `None`. `reach` is
    /// half the length of a stroke in units of the model.
    pub(super) fn keeping(
        mut self,
        features: &Features,
        priority: f32,
        reach: f32,
        starts: impl FnOnce(&[Feature], &[Root]) -> Option<Vec<Start>>,
    ) -> Self {
        let mut features = features.below(priority);
        features.sort_unstable_by_key(|feature| feature.seed);
        let kept = features.par_iter().map(|feature| (*feature, self.made(feature)));
        let shown = kept.filter(|(_, root)| root.place.detail > 0.0);
        let (features, mut kept): (Vec<Feature>, Vec<Root>) = shown.unzip();
        if let Some(starts) = starts(&features, &kept) {
            kept.iter_mut().zip(starts).for_each(|(root, start)| root.start = start);
            self.grid = Some(Grid::new(features.iter().map(|feature| feature.position), reach));
        }
        self.seeds = features.iter().map(|feature| feature.seed).collect();
        (self.kept, self.features) = (kept, features);
        self
    }

    pub(super) fn of(&self, feature: &Feature) -> Root {
        match self.seeds.binary_search(&feature.seed) {
            Ok(index) => self.kept[index],
            Err(_) => self.continued(feature, self.made(feature)),
        }
    }

    /// A bound on the curvature of the surface around a feature, per unit of the model.
    pub(super) fn greatest_bend(&self, feature: &Feature) -> f32 {
        self.surface.greatest_bend(feature)
    }

    /// The stroke of a feature, which need not continue others.
    pub(super) fn unmatched(&self, feature: &Feature) -> Root {
        match self.seeds.binary_search(&feature.seed) {
            Ok(index) => self.kept[index],
            Err(_) => self.made(feature),
        }
    }

    /// A stroke that goes on in the map from the nearest kept one on its side of the surface.
    fn continued(&self, feature: &Feature, own: Root) -> Root {
        let Some(grid) = &self.grid else { return own };
        let near =
            grid.near(feature.position).filter(|&other| alike(&self.kept[other].place, &own.place));
        let near = near
            .map(|other| (self.features[other].position.distance_squared(feature.position), other));
        let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let Some((_, other)) = nearest else { return own };
        let kept = &self.kept[other];
        let way = way((&self.features[other], &kept.place), (feature, &own.place));
        Root { start: kept.start.further(way), ..own }
    }

    /// How a pixel shows colours.
    pub(super) fn coloring(&self) -> &Arc<Coloring> {
        &self.coloring
    }

    fn made(&self, feature: &Feature) -> Root {
        let place = self.surface.place(feature);
        let tone = self.lightness.map(|[darkest, lightest]| {
            let share = (Coloring::lightness(place.color) - darkest) / (lightest - darkest);
            share.clamp(0.0, 1.0)
        });
        Root {
            tone,
            start: Start {
                origin: RANDOM.map(|number| feature.unit(number)).into(),
                way: Vec2::ZERO,
            },
            color: self.coloring.of_splat(place.color),
            place,
        }
    }
}

/// Number of random candidates, besides the places that continue a neighbour.
const OFFSETS_RANDOM: u64 = 64;

/// Which random number of a feature gives its first random candidate.
const FIRST_RANDOM: u64 = 32;

const NEIGHBOURS: usize = 10;

/// Radius of a patch of the model that goes on in the map, in half lengths of splats.
const PATCH: f32 = 6.0;

/// Distance of strokes, in texels, at which we compare the brushwork.
const COMPARED_SPACING: f32 = 4.0;

/// Mean squared difference, relative to unrelated places, at which a continuation is good enough.
const GOOD: f32 = 0.02;

/// Places at which we compare splats, relative to half their width and half their length.
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
        let bytes = (0..size * size).map(|at| texels.interpolated(at % size, at / size, 0, 0));
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
        fn mix(a: f32, b: f32, share: f32) -> f32 {
            a + (b - a) * share
        }
        let [upper, lower] = [y, below].map(|y| {
            mix(self.values[y * self.size + x], self.values[y * self.size + right], share.x)
        });
        mix(upper, lower, share.y)
    }
}

/// The values that a stroke is compared with at one of its places.
struct Probe {
    /// Place from the centre of the stroke, in widths of the map.
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

    /// Number of widths of the map in a unit of the model, for one stroke.
    fn widths_per_unit(&self, index: usize) -> f32 {
        let Style { map, size, .. } = *self.style(index);
        let map = self.tones.map(map);
        map.spacing / (self.width * size * map.size as f32)
    }

    /// Where all strokes start in the map, and the share of strokes that continue a neighbour.
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
        let mut best = (f32::INFINITY, own.start, false);
        let mut offer = |start: Start, continues: bool| {
            let offset = start.at(widths_per_unit);
            let mut cost = 0.0;
            for probe in &probes {
                cost += probe.weight * (greys.at(offset + probe.place) - probe.grey).powi(2);
                // A sum of squares only grows: the rest does not matter.
                if cost >= best.0 {
                    break;
                }
            }
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
            for number in 0..OFFSETS_RANDOM {
                let first = FIRST_RANDOM + 2 * number;
                let origin =
                    Vec2::from([first, first + 1].map(|drawn| self.features[index].unit(drawn)));
                offer(Start { origin, way: Vec2::ZERO }, false);
            }
        }
        (best.1, best.2)
    }

    /// The values that the placed neighbours show at the places of a stroke.
    fn probes(&self, index: usize, beside: &[(usize, Start)], greys: &Greys) -> Vec<Probe> {
        let radii = self.radii(index);
        let widths_per_unit = self.widths_per_unit(index);
        let beside: Vec<(usize, Vec2)> =
            beside.iter().map(|(other, start)| (*other, start.at(widths_per_unit))).collect();
        let place = &self.roots[index].place;
        let center = self.features[index].position;
        let probes = PROBES.into_iter().filter_map(|[a, b]: [f32; 2]| {
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
        });
        probes.collect()
    }

    /// For each stroke the nearest others that overlap it on the same side of the surface.
    fn neighbours(&self) -> Vec<Vec<u32>> {
        let largest = self.styles.iter().map(|style| style.size).fold(0.0, f32::max);
        let reach = largest * self.radii[0].max(self.radii[1]);
        let grid = Grid::new(self.features.iter().map(|feature| feature.position), reach);
        let near = (0..self.features.len()).into_par_iter().map(|index: usize| {
            let own = self.features[index].position;
            let place = &self.roots[index].place;
            let radii = self.radii(index);
            let mut found: Vec<(f32, u32)> = grid
                .near(own)
                .filter(|&other| other != index && alike(&self.roots[other].place, place))
                .map(|other| {
                    (
                        {
                            let from = self.features[other].position - own;
                            let across = from.dot(place.across()) / radii[0];
                            let along = from.dot(place.along) / radii[1];
                            let above = from.dot(place.normal) / radii[0];
                            across * across + along * along + above * above
                        },
                        other as u32,
                    )
                })
                .filter(|(square, _)| *square < 1.0)
                .collect();
            found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            found.truncate(NEIGHBOURS);
            found.into_iter().map(|(_, other)| other).collect()
        });
        near.collect()
    }
}

/// Points in cubes of one size.
#[derive(Debug, Clone, Default)]
pub(super) struct Grid {
    side: f32,
    /// Cube and index of each point, sorted.
    order: Vec<([i32; 3], u32)>,
}

impl Grid {
    /// Sorts points into cubes of this side, above 0.
    pub(super) fn new(points: impl Iterator<Item = Vec3>, side: f32) -> Self {
        let mut order: Vec<_> = points.map(|point| cube(point, side)).zip(0..).collect();
        order.sort_unstable();
        Self { side, order }
    }

    /// Indices of the points in the cube of a place and in all cubes around it: all points that are
    /// nearer than the side of a cube, and some more.
    pub(super) fn near(&self, place: Vec3) -> impl Iterator<Item = usize> + '_ {
        let [i, j, k] = cube(place, self.side);
        let columns = (-1..=1).flat_map(move |x: i32| (-1..=1).map(move |y: i32| (x, y)));
        columns.flat_map(move |(x, y)| {
            // The cubes of a column follow one another.
            let [low, high] = [k.saturating_sub(1), k.saturating_add(1)]
                .map(|k| [i.saturating_add(x), j.saturating_add(y), k]);
            let first = self.order.partition_point(|(cube, _)| *cube < low);
            let column = self.order[first..].iter().take_while(move |(cube, _)| *cube <= high);
            column.map(|(_, index)| *index as usize)
        })
    }
}

fn cube(point: Vec3, side: f32) -> [i32; 3] {
    (point / side).floor().to_array().map(|at| at as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_points_within_the_side_of_a_cube_are_near() {
        fn point(i: usize) -> Vec3 {
            let [x, y, z] = [i % 7, i / 7 % 11, i / 77].map(|part| part as f32);
            Vec3::new(0.37 * x - 1.0, 0.23 * y - 1.3, 0.29 * z - 0.7)
        }
        let grid = Grid::new((0..300).map(point), 0.4);
        for place in [Vec3::ZERO, point(17), Vec3::splat(-1.1), Vec3::splat(50.0)] {
            let near: Vec<usize> = grid.near(place).collect();
            for index in 0..300 {
                let within = point(index).distance(place) < 0.4;
                assert!(!within || near.contains(&index), "{index} near {place}");
            }
            assert!(near.len() < 150, "{} near {place}", near.len());
        }
    }
}
