//! The pictures on their way to the window: never more than it takes.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::{Duration, Instant};

use render::paint::painting::{Painting, PaintingError};
use render::paint::session::PaintingSession;
use render::paint::strokes::SurfaceId;
use render::tile::{Rect, TileSet};

use super::event::{Event, HeadOnCanvas};
use super::meter::Meter;
use super::srgb::SrgbBytes;
use super::tiles::encoded;

/// Parts of pictures that may be on their way at once: two frames' worth and a
/// little, so that a window that is late finds the newest.
const UNTAKEN: usize = 4;

/// Tiles told at once, so that a whole picture comes piece by piece.
const PIECE: usize = 128;

/// The least time between two looks at what changed: 60 a second.
const PACE: Duration = Duration::from_micros(16_000);

/// The most, if showing takes long.
const SLOWEST: Duration = Duration::from_millis(33);

/// One picture, and what of it the window has not been told.
#[derive(Debug)]
struct View {
    surface: SurfaceId,
    second: bool,
    unsent: TileSet,
}

/// What the window has yet to be told of the pictures.
#[derive(Debug)]
pub(super) struct Outbox {
    bytes: SrgbBytes,
    views: [View; 3],
    untaken: usize,
    next: Instant,
    /// When the samples arrived that the paint has reached but nobody saw.
    arrived: VecDeque<Instant>,
}

impl Outbox {
    pub(super) fn new() -> Self {
        let view = |surface, second| View { surface, second, unsent: TileSet::default() };
        Self {
            bytes: SrgbBytes::new(),
            views: [
                view(SurfaceId::Canvas, false),
                view(SurfaceId::Palette, false),
                view(SurfaceId::Canvas, true),
            ],
            untaken: 0,
            next: Instant::now(),
            arrived: VecDeque::new(),
        }
    }

    pub(super) fn bytes(&self) -> &SrgbBytes {
        &self.bytes
    }

    /// Forgets what was not told: other pictures came.
    pub(super) fn clear(&mut self) {
        for view in &mut self.views {
            view.unsent = TileSet::default();
        }
        self.arrived.clear();
    }

    /// The window took `parts`.
    pub(super) fn taken(&mut self, parts: usize) {
        self.untaken = self.untaken.saturating_sub(parts);
    }

    /// The paint has reached a sample that had arrived then.
    pub(super) fn reached(&mut self, arrived: Instant) {
        self.arrived.push_back(arrived);
    }

    /// Whether the window would take something now.
    pub(super) fn is_due(&self, now: Instant) -> bool {
        self.untaken < UNTAKEN && now >= self.next
    }

    /// When to look again; none while the window has not taken what it was told.
    pub(super) fn due(&self) -> Option<Instant> {
        (self.untaken < UNTAKEN).then_some(self.next)
    }

    /// Tells where the head is; a part like those of pictures.
    pub(super) fn tell_head(&mut self, head: HeadOnCanvas, tell: &dyn Fn(Event)) {
        tell(Event::Head(Some(Arc::new(head))));
        self.untaken += 1;
    }

    /// Whether something is computed that was not told.
    pub(super) fn is_behind(&self) -> bool {
        self.views.iter().any(|view| !view.unsent.is_empty())
    }

    /// Computes what changed and tells as much of it as the window takes.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub(super) fn show(
        &mut self,
        session: &mut PaintingSession,
        meter: &mut Meter,
        tell: &dyn Fn(Event),
    ) -> Result<(), PaintingError> {
        let began = Instant::now();
        for view in &mut self.views {
            let painting = session.painting_mut(view.surface);
            let seen = |painting: &&mut Painting| !view.second || painting.second_light().is_some();
            let Some(painting) = painting.filter(seen) else {
                view.unsent = TileSet::default();
                continue;
            };
            let bounds = painting.bounds();
            for tile in painting.refresh(view.second)?.iter() {
                view.unsent.insert_tile(tile);
            }
            while self.untaken < UNTAKEN && !view.unsent.is_empty() {
                let piece = first_tiles(&mut view.unsent, PIECE);
                let read = |rect: Rect| painting.picture_in(view.second, rect);
                let tiles = encoded(&piece, bounds, &self.bytes, read)?;
                let whole = view.unsent.is_empty();
                let newest = self.arrived.back().copied().filter(|_| whole && !view.second);
                tell(Event::Tiles { surface: view.surface, second: view.second, tiles, newest });
                self.untaken += 1;
            }
        }
        let now = Instant::now();
        if !self.is_behind() {
            for arrived in self.arrived.drain(..) {
                meter.shown(now, arrived);
            }
        }
        self.next = began + (3 * (now - began)).clamp(PACE, SLOWEST);
        Ok(())
    }
}

/// Takes the first `most` tiles out of `set`.
fn first_tiles(set: &mut TileSet, most: usize) -> TileSet {
    let (mut first, mut rest) = (TileSet::default(), TileSet::default());
    for (index, tile) in set.iter().enumerate() {
        if index < most {
            first.insert_tile(tile)
        } else {
            rest.insert_tile(tile)
        };
    }
    *set = rest;
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_whole_picture_comes_piece_by_piece_and_no_tile_twice() {
        let all = TileSet::all(Rect { x: 0, y: 0, width: 1920, height: 1080 });
        let (mut left, mut told) = (all.clone(), TileSet::default());
        let mut pieces = Vec::new();
        while !left.is_empty() {
            let piece = first_tiles(&mut left, PIECE);
            pieces.push(piece.len());
            for tile in piece.iter() {
                assert!(told.insert_tile(tile), "{tile:?} is told once");
            }
        }
        assert_eq!((pieces, told), (vec![128, 128, 128, 126], all));
    }
}
