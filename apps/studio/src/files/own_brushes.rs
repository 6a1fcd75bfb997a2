//! Own brushes of the painter, as the window shows them.

use session::brushes::folder::StoredSet;
use session::brushes::{BrushSet, ImportedBrush};

/// Own brushes, in sets that are written to the home folder when they change.
#[derive(Debug, Default)]
pub struct BrushSets {
    /// The sets, each with its file.
    pub sets: Vec<StoredSet>,
    /// Number of the set that is shown.
    pub shown: usize,
    /// The brush that was taken over last, with what became of its settings.
    pub imported: Option<ImportedBrush>,
    /// The sets as their files have them.
    pub(super) written: Vec<StoredSet>,
    pub(super) is_read: bool,
    /// Whether reading them has begun.
    pub(super) is_asked: bool,
}

/// Brushes that a file held.
#[derive(Debug)]
pub(super) enum ReadBrushes {
    /// A set of this program.
    Set(BrushSet),
    /// A brush of MyPaint.
    Myb(Box<ImportedBrush>),
}

impl BrushSets {
    /// Whether the sets were read from the home folder, so that they can be changed.
    #[must_use]
    pub fn is_read(&self) -> bool {
        self.is_read
    }

    /// The set that is shown, if there is one.
    #[must_use]
    pub fn set(&self) -> Option<&BrushSet> {
        self.sets.get(self.shown).map(|stored| &stored.set)
    }

    /// The set that is shown, to change it.
    pub fn set_mut(&mut self) -> Option<&mut BrushSet> {
        self.sets.get_mut(self.shown).map(|stored| &mut stored.set)
    }

    /// Removes the set that is shown, with its file.
    pub fn remove_set(&mut self) {
        if self.shown < self.sets.len() {
            self.sets.remove(self.shown);
            self.shown = self.shown.min(self.sets.len().saturating_sub(1));
        }
    }
}
