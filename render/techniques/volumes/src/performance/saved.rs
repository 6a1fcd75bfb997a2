//! Performances as files, from which they go on to the same bytes.

use super::player::Performance;
use crate::saved::{Kind, Reader, SavedError, Stored, identity, opened, sealed};

/// Files with a performance.
const PERFORMANCE: Kind =
    Kind { format: b"impasto-played\0\0", version: 1, name: "moment of a script" };

impl Performance {
    /// The present moment as the bytes of a file: the world, and which events are over. `wish` are
    /// words for what it belongs to, such as a digest of scene and settings;
    /// [`Performance::resumed`] wants the same.
    #[must_use]
    pub fn saved(&self, wish: &str) -> Vec<u8> {
        let mut state = Vec::new();
        (self.next as u64).store(&mut state);
        self.singles.store(&mut state);
        self.world.store_state(&mut state);
        sealed(PERFORMANCE, &self.identity(wish), &state)
    }

    /// The moment that [`Performance::saved`] gave as `file`, of this performance, which plays the
    /// same script on the same scene. It goes on to the same bytes.
    ///
    /// # Errors
    /// [`SavedError`] if the file holds no such moment or one of another version, is damaged, or
    /// was saved over another scene, with other settings or events, or under another wish.
    pub fn resumed(&self, file: &[u8], wish: &str) -> Result<Self, SavedError> {
        let state = opened(PERFORMANCE, &self.identity(wish), file)?;
        let mut reader = Reader::new(state);
        let moment = self.with_state(&mut reader).filter(|_| reader.is_empty());
        moment.ok_or(SavedError::Damaged)
    }

    fn with_state(&self, from: &mut Reader<'_>) -> Option<Self> {
        let next = usize::try_from(u64::read(from)?).ok()?;
        let singles = Vec::<Option<u64>>::read(from)?;
        if next > self.events.len() || singles.len() != self.singles.len() {
            return None;
        }
        let world = self.world.with_state(from)?;
        Some(Self { world, next, singles, ..self.clone() })
    }

    /// The digest of all that decides how it goes on, but for its state.
    fn identity(&self, wish: &str) -> [u8; 32] {
        let done = format!("{:?} {:?} {:?}", self.script, self.events, self.picked);
        identity([wish, &self.world.print(), &done])
    }
}
