//! Sub-steps that a head bends through while others are painted.

use crate::brush::{Head, Relief, SideBySide, StrokeTool};
use crate::contact::Contact;
use crate::pose::Pose;
use crate::stroke::Path;
use graphics::tile::Rect;

/// Most sub-steps that go to the backend together: enough to hide the cost of a call.
const BATCH: usize = 32;

/// Number of cells of contacts after which no more sub-steps are added to a batch, so that they
/// stay in the cache (chosen by timing).
const BATCH_CELLS: usize = 80_000;

/// Number of cells of a contact from which on sub-steps are drawn side by side, if there are
/// threads for it: below, handing them over takes longer.
const WIDE_CELLS: usize = 6_000;

/// Maximum number of sub-steps drawn side by side.
const SIDE_BY_SIDE: usize = 4;

/// Number of sub-steps after one whose contact has `cells` cells that are drawn side by side on
/// `threads` threads, of which one or more move the paint.
fn abreast(cells: usize, threads: usize) -> usize {
    if cells < WIDE_CELLS { 1 } else { (threads / 2).clamp(1, SIDE_BY_SIDE) }
}

/// Sub-steps that the head has bent through.
#[derive(Debug, Clone)]
pub(super) struct Batch {
    pub(super) contacts: Vec<Contact>,
    /// Number of contacts in use.
    pub(super) count: usize,
    /// Number of samples that the head had reached after them.
    pub(super) reached: usize,
    /// Poses of the sub-steps that are drawn next.
    poses: Vec<Pose>,
    side_by_side: SideBySide,
}

impl Batch {
    pub(super) fn empty() -> Self {
        let nothing = Contact::default();
        Self {
            contacts: vec![nothing; BATCH],
            count: 0,
            reached: 0,
            poses: Vec::new(),
            side_by_side: SideBySide::default(),
        }
    }

    /// Bends `head` through the next poses of `path`, as `tool`.
    pub(super) fn bend(
        &mut self,
        path: &mut Path,
        (head, tool): (&mut Head, StrokeTool),
        relief: &Relief,
        bounds: Rect,
    ) {
        self.count = 0;
        let mut cells = 0;
        let mut last = 0;
        while self.count < BATCH && cells < BATCH_CELLS {
            let rest = &mut self.contacts[self.count..];
            let count = abreast(last, rayon::current_num_threads()).min(rest.len());
            self.poses.clear();
            self.poses.extend(path.by_ref().take(count));
            match self.poses.as_slice() {
                [] => break,
                [pose] => head.advance_as(tool, pose, relief, bounds, &mut rest[0]),
                poses => self.side_by_side.advance_as((head, tool), poses, relief, bounds, rest),
            }
            let drawn = &rest[..self.poses.len()];
            cells += drawn.iter().map(|contact| contact.touches.len()).sum::<usize>();
            last = drawn.last().map_or(0, |contact| contact.touches.len());
            self.count += drawn.len();
        }
        self.reached = path.reached();
    }
}
