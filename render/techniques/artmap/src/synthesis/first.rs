//! The first map: multi-resolution synthesis after Wei and Levoy (2000), patch by patch.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::candidates::{LevelMap, around, continuations, from_coarser};
use super::canvas::{SourceCanvas, as_texel};
use super::descriptors::Descriptors;
use super::grid::PatchGrid;
use super::level::{Level, difference};
use super::mending::mend;
use super::usage::Usage;

/// Costs up to this factor of the least are equal, and chance decides (Efros and Freeman 2001).
const TOLERANCE: f32 = 1.1;
/// Texels around the place of the coarser level that are tried.
const REACH: isize = 2;
/// Weight of the coarser level beside the overlap.
const COARSER: f32 = 1.0;

/// Synthesises one level of the first map from the coarser one, if there is one.
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
        let cost = |&place: &[u16; 2]| {
            let coarse = coarser.map_or(0.0, |(level, map)| {
                COARSER * coarse_difference(level, map, &canvas, cell, place)
            });
            (canvas.cost(&overlap, place) + coarse) * usage.penalty(place)
        };
        let costs: Vec<f32> = candidates.iter().map(cost).collect();
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

/// Places near those that the coarser level shows at five texels of a cell's patch.
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
    let place = |into: [usize; 2]| {
        from_coarser(coarser, ((x + into[0]) % size, (y + into[1]) % size), into)
    };
    texels.into_iter().flat_map(|into| around(place(into), REACH, described)).collect()
}

/// Mean squared difference between the coarser map and the coarser level of a patch.
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
