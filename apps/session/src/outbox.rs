//! Sends pictures to the front end in parts, never more than it receives, and measures the latency
//! of samples.

use std::collections::VecDeque;
use std::sync::Arc;

use graphics::tile::{Rect, TileSet};
use paint::painting::{OpenStroke, Painting, PaintingError};
use paint::session::PaintingSession;
use paint::strokes::{Stroke, SurfaceId};
use web_time::{Duration, Instant};

use super::event::{Event, HeadOnCanvas};
use super::meter::Meter;
use super::miniature::Miniature;
use super::srgb::{SrgbBytes, encode};
use super::state::Thumbnail;

/// Most parts that may be sent without being confirmed: a little more than two frames. Without this
/// limit, a slow front end would first receive pictures that are out of date.
const MOST_UNCONFIRMED: usize = 4;

const PART_TILES: usize = 128;

/// Shortest time between two renderings: 60 a second.
const SHORTEST_INTERVAL: Duration = Duration::from_micros(16_000);

/// Longest time between two renderings, if they are slow.
const LONGEST_INTERVAL: Duration = Duration::from_millis(33);

/// The time between two renderings is at least this multiple of the time that one takes. In a page,
/// rendering and painting share a thread.
const RENDERING_TIMES: u32 = if cfg!(target_arch = "wasm32") { 6 } else { 3 };

/// Time between two renderings while the paint is behind the pen: 20 a second.
const INTERVAL_BEHIND: Duration = Duration::from_millis(48);

/// A picture and the tiles that must be sent.
#[derive(Debug)]
struct UnsentTiles {
    surface: SurfaceId,
    second: bool,
    unsent: TileSet,
}

impl UnsentTiles {
    /// Renders the tiles that changed. Notes that they must be sent, and read again for the small
    /// picture.
    fn refresh(
        &mut self,
        painting: &mut Painting,
        small: &mut Option<Miniature>,
    ) -> Result<(), PaintingError> {
        let tiles = painting.refresh(self.second)?;
        if let Some(small) = small
            && self.surface.is_canvas()
            && !self.second
        {
            small.change(&tiles);
        }
        for tile in tiles.iter() {
            self.unsent.insert_tile(tile);
        }
        Ok(())
    }
}

/// Parts of all pictures that must be sent.
#[derive(Debug)]
pub(super) struct Outbox {
    bytes: SrgbBytes,
    views: [UnsentTiles; 4],
    /// Small picture of the canvas. It is `None` until someone asks for it.
    small: Option<Miniature>,
    /// Parts that were sent but not confirmed.
    unconfirmed: usize,
    next: Instant,
    /// Arrival times of the samples of the open stroke that the paint has not reached.
    unpainted: VecDeque<Instant>,
    /// Arrival times of the samples that are painted and whose tiles are not all sent yet.
    arrived: VecDeque<Instant>,
    /// If this is true, the paint is behind the pen and goes before pictures.
    pub(super) paint_is_behind: bool,
}

impl Outbox {
    pub(super) fn new() -> Self {
        fn view(surface: SurfaceId, second: bool) -> UnsentTiles {
            UnsentTiles { surface, second, unsent: TileSet::default() }
        }
        Self {
            bytes: SrgbBytes::new(),
            views: [
                view(SurfaceId::Canvas, false),
                view(SurfaceId::Palette, false),
                view(SurfaceId::Canvas, true),
                view(SurfaceId::Palette, true),
            ],
            small: None,
            unconfirmed: 0,
            next: Instant::now(),
            unpainted: VecDeque::new(),
            arrived: VecDeque::new(),
            paint_is_behind: false,
        }
    }

    pub(super) fn bytes(&self) -> &SrgbBytes {
        &self.bytes
    }

    /// Drops everything that was not sent. Call this when another painting was opened.
    pub(super) fn clear(&mut self) {
        for view in &mut self.views {
            view.unsent = TileSet::default();
        }
        self.small = None;
        self.arrived.clear();
    }

    /// Counts `parts` as received by the front end.
    pub(super) fn confirm(&mut self, parts: usize) {
        self.unconfirmed = self.unconfirmed.saturating_sub(parts);
    }

    /// Adds a sample of the open stroke, by its arrival time.
    pub(super) fn add_sample(&mut self, arrived: Instant) {
        self.unpainted.push_back(arrived);
    }

    /// Counts the samples that the paint of the open stroke has reached.
    pub(super) fn follow(&mut self, stroke: &OpenStroke) {
        let ahead = stroke.stroke().samples.len() - stroke.reached();
        let reached = self.unpainted.len().saturating_sub(ahead);
        self.arrived.extend(self.unpainted.drain(..reached));
    }

    /// Forgets the samples of an earlier stroke.
    pub(super) fn begin_stroke(&mut self) {
        self.unpainted.clear();
    }

    /// Whether pictures may be rendered and sent now.
    pub(super) fn is_due(&self, now: Instant) -> bool {
        self.unconfirmed < MOST_UNCONFIRMED && now >= self.next
    }

    /// Time of the next rendering, or `None` while too many parts are not confirmed.
    pub(super) fn due(&self) -> Option<Instant> {
        (self.unconfirmed < MOST_UNCONFIRMED).then_some(self.next)
    }

    /// Sends the shape of the head. It counts as one part that is not confirmed yet.
    pub(super) fn send_head(&mut self, head: HeadOnCanvas, send: &dyn Fn(Event)) {
        send(Event::Head(Some(Arc::new(head))));
        self.unconfirmed += 1;
    }

    /// Whether rendered tiles must still be sent.
    pub(super) fn is_behind(&self) -> bool {
        self.views.iter().any(|view| !view.unsent.is_empty())
    }

    /// Small picture of the canvas as it is now.
    pub(super) fn small_picture(
        &mut self,
        canvas: &mut Painting,
    ) -> Result<&Thumbnail, PaintingError> {
        let [first, ..] = &mut self.views;
        first.refresh(canvas, &mut self.small)?;
        let bounds = canvas.bounds();
        let small = self.small.get_or_insert_with(|| Miniature::new(bounds));
        if small.bounds() != bounds {
            *small = Miniature::new(bounds);
        }
        small.picture(&self.bytes, |rect| canvas.picture_in(false, rect))
    }

    /// Renders the changed tiles and sends as many as the front end can receive.
    pub(super) fn send_changes(
        &mut self,
        session: &mut PaintingSession,
        meter: &mut Meter,
        send: &dyn Fn(Event),
    ) -> Result<(), PaintingError> {
        let start = Instant::now();
        for view in &mut self.views {
            let painting = session.painting_mut(view.surface);
            let shown = painting.filter(|own| !view.second || own.second_light().is_some());
            let Some(painting) = shown else {
                view.unsent = TileSet::default();
                continue;
            };
            let bounds = painting.bounds();
            view.refresh(painting, &mut self.small)?;
            while self.unconfirmed < MOST_UNCONFIRMED && !view.unsent.is_empty() {
                let part = take_first_tiles(&mut view.unsent, PART_TILES);
                let tiles = encode(&part, bounds, &self.bytes, |rect: Rect| {
                    painting.picture_in(view.second, rect)
                })?;
                let complete = view.unsent.is_empty();
                let newest = self.arrived.back().copied().filter(|_| complete && !view.second);
                send(Event::Tiles { surface: view.surface, second: view.second, tiles, newest });
                self.unconfirmed += 1;
            }
        }
        let now = Instant::now();
        if !self.is_behind() {
            for arrived in self.arrived.drain(..) {
                meter.add_sample(now, arrived);
            }
        }
        let interval = (RENDERING_TIMES * (now - start)).clamp(SHORTEST_INTERVAL, LONGEST_INTERVAL);
        self.next = start + if self.paint_is_behind { INTERVAL_BEHIND } else { interval };
        Ok(())
    }
}

/// Removes the first `most` tiles from `set` and returns them.
fn take_first_tiles(set: &mut TileSet, most: usize) -> TileSet {
    let mut first = TileSet::default();
    let mut rest = TileSet::default();
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

/// Number of sub-steps of the open stroke that follow from its samples and are not painted yet.
pub(super) fn waiting_substeps(session: &PaintingSession) -> usize {
    session.open_stroke().map_or(0, OpenStroke::waiting)
}

/// Whether the brush of the open stroke was lifted.
pub(super) fn is_lifted(session: &PaintingSession) -> bool {
    session.open_stroke().is_some_and(OpenStroke::is_lifted)
}

/// How the head of the open stroke is bent now.
pub(super) fn head_on_canvas(session: &PaintingSession) -> Option<HeadOnCanvas> {
    let Stroke { on: surface, brush, .. } = session.open_stroke()?.stroke();
    let surface = *surface;
    let id = session.brush_id_on(brush, surface)?;
    let mesh = session.painting(surface)?.head(id).mesh()?;
    Some(HeadOnCanvas { surface, around: mesh.around, along: mesh.along, vertices: mesh.vertices })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_whole_picture_is_sent_in_parts_and_no_tile_twice() {
        let all = TileSet::all(Rect { x: 0, y: 0, width: 1920, height: 1080 });
        let mut left = all.clone();
        let mut sent = TileSet::default();
        let mut parts = Vec::new();
        while !left.is_empty() {
            let part = take_first_tiles(&mut left, PART_TILES);
            parts.push(part.len());
            for tile in part.iter() {
                assert!(sent.insert_tile(tile), "{tile:?} is sent once");
            }
        }
        assert_eq!((parts, sent), (vec![128, 128, 128, 126], all));
    }
}
