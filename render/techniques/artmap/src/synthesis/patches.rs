//! Synthesis patch by patch. It looks for places that continue what the coarser level or
//! neighbouring patches show.
//!
//! We make the first map after Wei and Levoy (2000), at several resolutions. The others follow it
//! by equations 4 to 6 of Yan and others (2008).

use graphics::field::Field;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::canvas::{SourceCanvas, Usage, as_texel, mend};
use super::descriptors::{Descriptors, Link, distance};
use super::level::{Level, PatchGrid, difference};

#[derive(Debug, Clone)]
pub(crate) struct LevelMap {
    /// Texel of the sample's level that each texel of the map shows.
    pub(crate) sources: Field<[u16; 2]>,
    /// Place of the patch of each cell of the grid.
    pub(crate) places: Vec<[u16; 2]>,
}

/// Place of a patch in the sample, from the coarser level. The patch then shows, at the texel
/// `into`, the same part of the sample that the coarser level shows at `texel` of the map.
pub(crate) fn from_coarser(
    coarser: &LevelMap,
    texel: (usize, usize),
    into: [usize; 2],
) -> [isize; 2] {
    let last = coarser.sources.width() - 1;
    let [x, y] = coarser.sources[((texel.0 / 2).min(last), (texel.1 / 2).min(last))];
    fn fine(coarse: u16, texel: usize, into: usize) -> isize {
        2 * coarse as isize + (texel % 2) as isize - into as isize
    }
    [fine(x, texel.0, into[0]), fine(y, texel.1, into[1])]
}

pub(crate) fn around(
    middle: [isize; 2],
    reach: isize,
    described: &Descriptors,
) -> impl Iterator<Item = [u16; 2]> + '_ {
    (-reach..=reach)
        .flat_map(move |j| (-reach..=reach).map(move |i| [middle[0] + i, middle[1] + j]))
        .filter_map(|place| existing(place, described))
}

/// The place as whole numbers. `None` if no patch of the sample starts there.
pub(crate) fn existing(place: [isize; 2], described: &Descriptors) -> Option<[u16; 2]> {
    let [x, y] = place.map(u16::try_from);
    let place = [x.ok()?, y.ok()?];
    described.at(place).map(|_| place)
}

pub(crate) fn continuations(
    canvas: &SourceCanvas<'_>,
    places: &[[u16; 2]],
    [column, row]: [usize; 2],
    described: &Descriptors,
) -> Vec<[u16; 2]> {
    let grid = canvas.grid;
    fn step(index: usize, grid: &PatchGrid) -> isize {
        (grid.origin(index) - grid.origin(index - 1)) as isize
    }
    fn of(column: usize, row: usize, grid: &PatchGrid, places: &[[u16; 2]]) -> [isize; 2] {
        places[row * grid.count + column].map(|at| at as isize)
    }
    let mut found = Vec::new();
    if column > 0 {
        let [x, y] = of(column - 1, row, &grid, places);
        found.extend(existing([x + step(column, &grid), y], described));
    }
    if row > 0 {
        let [x, y] = of(column, row - 1, &grid, places);
        found.extend(existing([x, y + step(row, &grid)], described));
    }
    found
}

/// If costs are up to this factor of the least, they count as equal, and chance decides (Efros and
/// Freeman 2001).
const TOLERANCE: f32 = 1.1;
/// We try texels this far around the place of the coarser level.
const REACH: isize = 2;
const COARSER: f32 = 1.0;

/// Synthesises one level of the first map. It starts from the coarser level, if there is one.
pub(crate) fn first_level(
    (level, described): (&Level, &Descriptors),
    grid: PatchGrid,
    coarser: Option<(&Level, &LevelMap)>,
    uniformity: f32,
    random: &mut ChaCha8Rng,
) -> LevelMap {
    let mut canvas = SourceCanvas::new(level, grid);
    let mut usage = Usage::new(level, grid.patch, grid.count * grid.count, uniformity);
    let mut places: Vec<[u16; 2]> = Vec::with_capacity(grid.count * grid.count);
    for cell in grid.cells() {
        let mut candidates = match coarser {
            Some((_, map)) => placed_as(map, &canvas, cell, described),
            None => described.places.clone(),
        };
        candidates.extend(continuations(&canvas, &places, cell, described));
        candidates.sort_unstable_by_key(|&[x, y]| (y, x));
        candidates.dedup();
        if candidates.is_empty() {
            candidates.clone_from(&described.places);
        }
        let overlap = canvas.overlap(cell);
        let costs: Vec<f32> = candidates
            .iter()
            .map(|&place: &[u16; 2]| {
                let coarse = coarser.map_or(0.0, |(level, map)| {
                    COARSER * coarse_difference(level, map, &canvas, cell, place)
                });
                (canvas.cost(&overlap, place) + coarse) * usage.penalty(place)
            })
            .collect();
        let least = costs.iter().copied().fold(f32::INFINITY, f32::min);
        let good = candidates.iter().zip(&costs).filter(|(_, cost)| **cost <= TOLERANCE * least);
        let good: Vec<[u16; 2]> = good.map(|(place, _)| *place).collect();
        let place = good[random.random_range(0..good.len())];
        canvas.paste(cell, place);
        usage.note(place);
        places.push(place);
    }
    let mut sources = canvas.sources;
    mend(level, &mut sources);
    LevelMap { sources, places }
}

fn placed_as(
    coarser: &LevelMap,
    canvas: &SourceCanvas<'_>,
    cell: [usize; 2],
    described: &Descriptors,
) -> Vec<[u16; 2]> {
    let PatchGrid { size, patch, .. } = canvas.grid;
    let [x, y] = cell.map(|index| canvas.grid.origin(index));
    let near = patch / 4;
    let far = 3 * patch / 4;
    let texels = [[patch / 2, patch / 2], [near, near], [far, near], [near, far], [far, far]];
    texels
        .into_iter()
        .flat_map(|into| {
            around(
                from_coarser(coarser, ((x + into[0]) % size, (y + into[1]) % size), into),
                REACH,
                described,
            )
        })
        .collect()
}

fn coarse_difference(
    level: &Level,
    map: &LevelMap,
    canvas: &SourceCanvas<'_>,
    cell: [usize; 2],
    place: [u16; 2],
) -> f32 {
    let PatchGrid { size, patch, .. } = canvas.grid;
    let [x, y] = cell.map(|index| canvas.grid.origin(index));
    let last = (level.look.width() - 1, level.look.height() - 1);
    let mut sum = 0.0;
    let mut count = 0.0;
    for row in (0..patch).step_by(2) {
        for column in (0..patch).step_by(2) {
            let shown = map.sources[((x + column) % size / 2, (y + row) % size / 2)];
            let (u, v) = as_texel([place[0] + column as u16, place[1] + row as u16]);
            let here = ((u / 2).min(last.0), (v / 2).min(last.1));
            sum += difference(&level.look[here], &level.look[as_texel(shown)]);
            count += 1.0;
        }
    }
    sum / count
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct Following {
    pub(crate) links: usize,
    /// Weight of a link's distance relative to the error of the overlap.
    pub(crate) follow: f32,
    pub(crate) uniformity: f32,
}

impl Following {
    /// Synthesises level `number` (1 is the coarsest) of a map from the same level of the first
    /// map and its own coarser level, if there is one.
    ///
    /// Equation 6 as printed multiplies pixel values by the weights. We multiply the costs by them.
    pub(crate) fn level(
        &self,
        number: usize,
        (level, described): (&Level, &Descriptors),
        (first, first_described): (&LevelMap, &Descriptors),
        grid: PatchGrid,
        coarser: Option<&LevelMap>,
    ) -> LevelMap {
        let wanted: Vec<&[f32]> =
            first.places.iter().filter_map(|&place| first_described.at(place)).collect();
        let links: Vec<Vec<Link>> =
            wanted.par_iter().map(|wanted| described.nearest(wanted, self.links)).collect();
        let mut canvas = SourceCanvas::new(level, grid);
        let cells = grid.count * grid.count;
        let mut usage = Usage::new(level, grid.patch, cells, self.uniformity);
        let mut places = Vec::with_capacity(cells);
        let coarse_weight = 1.0 / number as f32;
        for ((cell, links), wanted) in grid.cells().zip(&links).zip(&wanted) {
            let overlap = canvas.overlap(cell);
            let cost = |place: [u16; 2], distance: f32| {
                let error = canvas.cost(&overlap, place) + self.follow * distance;
                error * usage.penalty(place)
            };
            let mut best: Option<(f32, [u16; 2])> = None;
            let mut offer = |cost: f32, place: [u16; 2]| {
                if best.is_none_or(|(least, _)| cost < least) {
                    best = Some((cost, place));
                }
            };
            let inherited = coarser.and_then(|coarser| {
                let into = [grid.patch / 2; 2];
                let place = from_coarser(coarser, canvas.middle(cell), into);
                existing(place, described)
            });
            let link_weight = if inherited.is_some() { 1.0 - coarse_weight } else { 1.0 };
            for link in links {
                offer(link_weight * cost(link.place, link.distance), link.place);
            }
            if let Some(place) = inherited {
                let away = described.at(place).map_or(0.0, |found| distance(wanted, found));
                offer(coarse_weight * cost(place, away), place);
            }
            let Some((_, place)) = best else { continue };
            canvas.paste(cell, place);
            usage.note(place);
            places.push(place);
        }
        let mut sources = canvas.sources;
        mend(level, &mut sources);
        LevelMap { sources, places }
    }
}
