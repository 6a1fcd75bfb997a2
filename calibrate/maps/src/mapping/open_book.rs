//! Maps of pixels by the book of a survey.
//!
//! A pixel is compared with the sets of the four nearest pixels of the survey. Where none explains it, it
//! is searched whole. Its result depends on itself and the book only.

use super::book::Book;
use super::prepared::{Folded, Prepared};
use crate::map_error::MapError;
use crate::search::engine::{Engine, Scratch};
use crate::search::nearest::{Nearest, Point};
use crate::search::set_fit::SetFit;

/// Entries of the book that propose sets.
const NEIGHBOURS: usize = 4;
/// Most proposed sets of a pixel.
const PROPOSED: usize = 8;
/// Gauss-Newton steps of a proposed set.
const STEPS: usize = 1;
/// Chi-square relative to that of the nearest entry up to which a pixel counts as explained.
const WORSE: f32 = 1.2;

/// A book that is ready for use.
#[derive(Debug, Clone)]
pub struct OpenBook {
    nearest: Nearest,
    /// Sets of each entry: ends in `sets`.
    ends: Vec<u32>,
    sets: Vec<SetFit>,
    chi2: Vec<f32>,
    usual_chi2: f32,
    /// Search that knows the palette of the survey.
    engine: Engine,
}

impl OpenBook {
    /// Prepares `book` for the pixels of a map.
    ///
    /// # Errors
    /// [`MapError::OtherBook`] if it was made with another library, other wavelengths or other settings.
    pub(crate) fn new(prepared: &Prepared, identity: &str, book: &Book) -> Result<Self, MapError> {
        if book.identity != identity || book.pigments != prepared.paints.names {
            let found = book.identity.clone();
            let expected = identity.to_owned();
            return Err(MapError::OtherBook { found, expected });
        }
        let point = |values: &Vec<f32>| -> Point {
            std::array::from_fn(|i| values.get(i).copied().unwrap_or(0.0))
        };
        let points: Vec<Point> = book.entries.iter().map(|entry| point(&entry.point)).collect();
        let mut ends = Vec::new();
        let mut sets = Vec::new();
        for entry in &book.entries {
            for set in &entry.sets {
                let parts = set.pigments.iter().zip(&set.shares);
                let parts: Vec<(usize, f32)> =
                    parts.map(|(&member, &share)| (usize::from(member), share)).collect();
                sets.extend(SetFit::of_parts(&parts));
            }
            ends.push(sets.len() as u32);
        }
        Ok(Self {
            nearest: Nearest::new(&points),
            ends,
            sets,
            chi2: book.entries.iter().map(|entry| entry.chi2).collect(),
            usual_chi2: book.usual_chi2,
            engine: prepared.engine.with_palette(&book.palette),
        })
    }

    fn sets(&self, entry: usize) -> &[SetFit] {
        let start = entry.checked_sub(1).map_or(0, |before| self.ends[before]) as usize;
        &self.sets[start..self.ends[entry] as usize]
    }

    /// Finds the sets that explain a pixel, the best first, in `scratch.found`. Returns whether the
    /// book explained it.
    pub(crate) fn find(&self, folded: &Folded, scratch: &mut Scratch) -> bool {
        let engine = &self.engine;
        let near = self.nearest.find::<NEIGHBOURS>(&folded.point);
        scratch.found.clear();
        let mut usual = self.usual_chi2;
        // The best sets of all neighbours come before the second-best of any.
        'ranks: for rank in 0.. {
            let mut any = false;
            for &(_, entry) in near.iter().filter(|(_, entry)| *entry != u32::MAX) {
                let entry = entry as usize;
                if rank == 0 {
                    usual = usual.max(WORSE * self.chi2[entry].min(4.0 * self.usual_chi2));
                }
                let Some(set) = self.sets(entry).get(rank) else { continue };
                any = true;
                if scratch.found.iter().any(|found| found.key() == set.key()) {
                    continue;
                }
                if scratch.found.len() == PROPOSED {
                    break 'ranks;
                }
                scratch.found.push(*set);
            }
            if !any {
                break;
            }
        }
        for set in &mut scratch.found {
            *set = engine.refined(&folded.pixel, *set, STEPS);
        }
        engine.sort(&folded.pixel, &mut scratch.found);
        let explained = scratch.found.first().is_some_and(|best| best.chi2 <= usual);
        if !explained {
            let place = engine.table.nearest(&folded.point);
            engine.search(&folded.pixel, place, scratch);
        }
        explained
    }
}
