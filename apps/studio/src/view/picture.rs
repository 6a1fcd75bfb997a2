//! A picture on the screen, divided into chunks. We upload only visible chunks, and of these only
//! the changed parts.

use eframe::egui::{Color32, ColorImage, Painter, Rect as Points, pos2};
use graphics::tile::Rect;

use super::canvas::draw_quads;
use super::mipmap::{MipLevels, next_level_rect};
use super::texture::{LazyTexture, Quad, Vertex};
use super::transform::Placement;
use crate::theme;
use session::TilePixels;

/// Cells per side of a chunk. Its texture has one more on every inner side, so that neighbouring
/// chunks interpolate without a seam.
const CHUNK: usize = 512;

/// From this zoom on you see cells as squares, in physical pixels per cell.
const SQUARES: f64 = 3.0;

/// From this number of changed rectangles on, we upload the whole chunk.
const MOST_CHANGES: usize = 24;

/// The drawn part of a picture, limited by a column of cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DrawnPart {
    /// All columns of the surface.
    Whole,
    /// The columns left of this one.
    LeftOf(f64),
    /// The columns right of this one.
    RightOf(f64),
}

/// A rectangular piece of a level with its own texture.
struct Chunk {
    inner: Rect,
    /// These cells and their neighbours. The texture holds them all.
    padded: Rect,
    texture: Option<LazyTexture>,
    /// Rectangles that changed since the last upload.
    changed: Vec<Rect>,
}

/// A picture on the screen.
pub struct Picture {
    name: &'static str,
    levels: MipLevels,
    chunks: Vec<Vec<Chunk>>,
    uploaded: u64,
    /// Cells written since the last call of `take_fresh` or the last drawing.
    fresh: Option<Rect>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Shown {
    pub(super) level: usize,
    /// Whether we interpolate its cells.
    pub(super) interpolate: bool,
}

impl std::fmt::Debug for Picture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let cells = self.cells();
        f.debug_struct("Picture").field("name", &self.name).field("cells", &cells).finish()
    }
}

impl Picture {
    /// A picture of `cells` columns and rows, grey until you write it.
    #[must_use]
    pub fn new(name: &'static str, cells: (usize, usize)) -> Self {
        let levels = MipLevels::new(cells.0, cells.1, theme::SURROUND);
        let chunks = (0..levels.count()).map(|level| chunks(levels.bounds(level))).collect();
        Self { name, levels, chunks, uploaded: 0, fresh: None }
    }

    /// Columns and rows of cells.
    #[must_use]
    pub fn cells(&self) -> (usize, usize) {
        let Rect { width, height, .. } = self.levels.bounds(0);
        (width, height)
    }

    /// Writes a rectangle of the picture.
    pub fn write(&mut self, tile: &TilePixels) {
        self.levels.write(tile.rect, &tile.pixels);
        let mut changed = tile.rect.intersection(self.levels.bounds(0));
        self.fresh = Some(self.fresh.map_or(changed, |fresh| union(fresh, changed)));
        for (level, chunks) in self.chunks.iter_mut().enumerate() {
            if level > 0 {
                changed = next_level_rect(changed);
            }
            chunks.iter_mut().for_each(|chunk| chunk.record_change(changed));
        }
    }

    /// Pixels of a rectangle as you wrote them: 8-bit sRGB, row by row.
    #[must_use]
    pub fn pixels(&self, rect: Rect) -> ColorImage {
        self.levels.region(0, rect.intersection(self.levels.bounds(0)))
    }

    /// Total number of bytes uploaded to the graphics device.
    #[must_use]
    pub fn uploaded(&self) -> u64 {
        self.uploaded
    }

    /// Which level is shown at this placement, and how. `density` is the number of pixels per
    /// point.
    pub(super) fn shown(&self, placement: &Placement, density: f64) -> Shown {
        let zoom = placement.scale() * density;
        // We take the level with one to two cells per pixel, or level 0.
        let finest = (1.0 / zoom).log2().floor().max(0.0) as usize;
        let level = finest.min(self.levels.count() - 1);
        let smooth = zoom < SQUARES && !placement.aligned;
        // A reduced level is always interpolated.
        Shown { level, interpolate: smooth || zoom < 1.0 }
    }

    /// The rectangle of the cells written since the last call or drawing, if any.
    pub(super) fn take_fresh(&mut self) -> Option<Rect> {
        self.fresh.take()
    }

    /// Mipmap levels of the picture.
    pub(super) fn levels(&self) -> &MipLevels {
        &self.levels
    }

    /// Draws the visible part of the picture, limited to `part`.
    pub fn draw(&mut self, painter: &Painter, placement: &Placement, part: DrawnPart) {
        self.fresh = None;
        let density = f64::from(painter.pixels_per_point());
        let Shown { level, interpolate } = self.shown(placement, density);
        let size = 1_usize << level;
        let (width, height) = self.cells();
        let (from, to) = match part {
            DrawnPart::Whole => (0.0, width as f64),
            DrawnPart::LeftOf(column) => (0.0, column.clamp(0.0, width as f64)),
            DrawnPart::RightOf(column) => (column.clamp(0.0, width as f64), width as f64),
        };
        let mut quads = Vec::new();
        for chunk in &mut self.chunks[level] {
            let cells = |at: usize| (at * size) as f64;
            let left = cells(chunk.inner.x).max(from);
            let right = cells(chunk.inner.x + chunk.inner.width).min(to);
            let top = cells(chunk.inner.y);
            let bottom = cells(chunk.inner.y + chunk.inner.height).min(height as f64);
            if right <= left || bottom <= top {
                continue;
            }
            let corners = [[left, top], [right, top], [right, bottom], [left, bottom]];
            let points = corners.map(|corner| placement.point(corner));
            if !Points::from_points(&points).intersects(painter.clip_rect()) {
                continue;
            }
            let (texture, bytes) = chunk.upload(&self.levels, level);
            self.uploaded += bytes;
            quads.push(Quad {
                corners: [0, 1, 2, 3].map(|at: usize| {
                    let uv = chunk.uv(corners[at].map(|cells| cells / size as f64));
                    Vertex { point: points[at], uv, color: Color32::WHITE }
                }),
                texture: Some((texture, interpolate)),
            });
        }
        draw_quads(painter, quads);
    }
}

fn chunks(bounds: Rect) -> Vec<Chunk> {
    let mut all = Vec::new();
    for y in (0..bounds.height).step_by(CHUNK) {
        for x in (0..bounds.width).step_by(CHUNK) {
            let inner = Rect { x, y, width: CHUNK, height: CHUNK }.intersection(bounds);
            all.push(Chunk {
                inner,
                padded: inner.grown(1, bounds),
                texture: None,
                changed: Vec::new(),
            });
        }
    }
    all
}

impl Chunk {
    fn record_change(&mut self, rect: Rect) {
        let part = rect.intersection(self.padded);
        if part.is_empty() || self.texture.is_none() {
            return;
        }
        // We join adjacent tiles into one upload.
        if let Some(joined) = self.changed.iter_mut().find(|other| is_tight_union(**other, part)) {
            *joined = union(*joined, part);
        } else if self.changed.len() < MOST_CHANGES {
            self.changed.push(part);
        } else {
            self.changed = vec![self.padded];
        }
    }

    /// Returns the up-to-date texture and the number of bytes uploaded for it.
    fn upload(&mut self, levels: &MipLevels, level: usize) -> (LazyTexture, u64) {
        let Some(texture) = &self.texture else {
            let texture = LazyTexture::new(levels.region(level, self.padded));
            self.texture = Some(texture.clone());
            return (texture, (4 * self.padded.width * self.padded.height) as u64);
        };
        if !self.changed.is_empty()
            && texture.pending_cells() > self.padded.width * self.padded.height
        {
            // More cells wait than the chunk has, so it is cheaper to upload it whole.
            self.changed = vec![self.padded];
        }
        let mut sum = 0;
        for rect in self.changed.drain(..) {
            let at = [rect.x - self.padded.x, rect.y - self.padded.y];
            texture.write(at, levels.region(level, rect));
            sum += (4 * rect.width * rect.height) as u64;
        }
        (texture.clone(), sum)
    }

    /// Texture coordinates, 0 to 1, of a position in the level.
    fn uv(&self, [x, y]: [f64; 2]) -> eframe::egui::Pos2 {
        let Rect { x: left, y: top, width, height } = self.padded;
        let across = (x - left as f64) / width as f64;
        let down = (y - top as f64) / height as f64;
        pos2(across as f32, down as f32)
    }
}

/// Whether the bounding rectangle is at most a quarter larger than the union of both.
fn is_tight_union(a: Rect, b: Rect) -> bool {
    let area = |rect: Rect| rect.width * rect.height;
    let overlap = area(a.intersection(b));
    4 * area(union(a, b)) <= 5 * (area(a) + area(b) - overlap)
}

fn union(a: Rect, b: Rect) -> Rect {
    let x = a.x.min(b.x);
    let y = a.y.min(b.y);
    let right = (a.x + a.width).max(b.x + b.width);
    let bottom = (a.y + a.height).max(b.y + b.height);
    Rect { x, y, width: right - x, height: bottom - y }
}
