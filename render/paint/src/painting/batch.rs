//! Sub-steps that a head bends through while others are painted.

use crate::brush::{Head, Relief, StrokeTool};
use crate::contact::Contact;
use crate::stroke::Path;
use graphics::tile::Rect;

/// Most sub-steps that go to the backend together: enough to hide the cost of a call.
const BATCH: usize = 32;

/// Number of cells of contacts after which no more sub-steps are added to a batch, so that they
/// stay in the cache (chosen by timing).
const BATCH_CELLS: usize = 80_000;

/// Sub-steps that the head has bent through.
#[derive(Debug, Clone)]
pub(super) struct Batch {
    pub(super) contacts: Vec<Contact>,
    /// Number of contacts in use.
    pub(super) count: usize,
    /// Number of samples that the head had reached after them.
    pub(super) reached: usize,
}

impl Batch {
    pub(super) fn empty() -> Self {
        let nothing = Contact::default();
        Self { contacts: vec![nothing; BATCH], count: 0, reached: 0 }
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
        for contact in &mut self.contacts {
            if cells >= BATCH_CELLS {
                break;
            }
            let Some(pose) = path.next() else { break };
            head.advance_as(tool, &pose, relief, bounds, contact);
            cells += contact.touches.len();
            self.count += 1;
        }
        self.reached = path.reached();
    }
}
