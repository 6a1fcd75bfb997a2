//! Maps that follow the first one: equations 4 to 6 of Yan and others (2008).

use rayon::prelude::*;

use super::candidates::{LevelMap, existing, from_coarser};
use super::canvas::SourceCanvas;
use super::descriptors::{Descriptors, Link, distance};
use super::grid::PatchGrid;
use super::level::Level;
use super::mending::mend;
use super::usage::Usage;

/// What the levels of one map have in common.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Following {
    /// Number of links of each patch.
    pub(crate) links: usize,
    /// Weight of the distance of a link beside the error of the overlap.
    pub(crate) follow: f32,
    pub(crate) uniformity: f32,
}

impl Following {
    /// Synthesises level `number` (1 is the coarsest) of a map from the same level of the first
    /// map and its own coarser level, if there is one.
    ///
    /// Equation 6 weighs pixel values as it is printed; here the weights belong to the costs.
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
