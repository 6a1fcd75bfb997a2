//! A picture on the screen, in pieces: only what is seen is uploaded, and of that
//! only what changed.

use eframe::egui::{Color32, ColorImage, Painter, Rect as Points, pos2};
use render::tile::Rect;

use super::levels::{Levels, halved};
use super::sheet::{Corner, Quad, Sheet, draw};
use super::transform::Placement;
use crate::theme;
use session::TilePixels;

/// Cells of a level in one texture, each way; one more on every inner side lets
/// neighbours blend.
const CHUNK: usize = 512;

/// From so many physical pixels a cell on, cells are shown as squares.
const SQUARES: f64 = 3.0;

/// Changes that a chunk keeps apart before it is uploaded whole.
const MOST_CHANGES: usize = 24;

/// The part of a picture that is drawn, by columns of cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Half {
    /// All.
    Whole,
    /// What is left of a column.
    Left(f64),
    /// What is right of a column.
    Right(f64),
}

/// A piece of a level.
struct Chunk {
    /// The cells it draws.
    inner: Rect,
    /// Those and their neighbours: the texture.
    padded: Rect,
    sheet: Option<Sheet>,
    /// What changed since the last upload.
    changed: Vec<Rect>,
}

/// A picture on the screen.
pub struct Picture {
    name: &'static str,
    levels: Levels,
    chunks: Vec<Vec<Chunk>>,
    uploaded: u64,
}

impl std::fmt::Debug for Picture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let cells = self.cells();
        f.debug_struct("Picture").field("name", &self.name).field("cells", &cells).finish()
    }
}

impl Picture {
    /// A picture of so many cells that nobody has told yet.
    #[must_use]
    pub fn new(name: &'static str, cells: (usize, usize)) -> Self {
        let levels = Levels::new(cells.0, cells.1, theme::SURROUND);
        let chunks = (0..levels.count()).map(|level| chunks(levels.bounds(level))).collect();
        Self { name, levels, chunks, uploaded: 0 }
    }

    /// Its cells, across and down.
    #[must_use]
    pub fn cells(&self) -> (usize, usize) {
        let Rect { width, height, .. } = self.levels.bounds(0);
        (width, height)
    }

    /// Takes what the worker told.
    pub fn write(&mut self, tile: &TilePixels) {
        self.levels.write(tile.rect, &tile.pixels);
        let mut changed = tile.rect.intersection(self.levels.bounds(0));
        for (level, chunks) in self.chunks.iter_mut().enumerate() {
            if level > 0 {
                changed = halved(changed);
            }
            chunks.iter_mut().for_each(|chunk| chunk.mark(changed));
        }
    }

    /// Cells as they were told: 8-bit sRGB, row by row.
    #[must_use]
    pub fn pixels(&self, rect: Rect) -> ColorImage {
        self.levels.cut(0, rect.intersection(self.levels.bounds(0)))
    }

    /// Bytes handed to the graphics device so far.
    #[must_use]
    pub fn uploaded(&self) -> u64 {
        self.uploaded
    }

    /// Draws what of `half` is seen within the painter's clip.
    pub fn draw(&mut self, painter: &Painter, placement: &Placement, half: Half) {
        let density = f64::from(painter.pixels_per_point());
        let zoom = placement.scale() * density;
        // The level whose cells are one to two in a pixel, or level 0.
        let finest = (1.0 / zoom).log2().floor().max(0.0) as usize;
        let level = finest.min(self.levels.count() - 1);
        let smooth = zoom < SQUARES && !placement.aligned;
        // A level seen smaller than it is always blends.
        let blended = smooth || zoom < 1.0;
        let size = 1_usize << level;
        let (width, height) = self.cells();
        let (from, to) = match half {
            Half::Whole => (0.0, width as f64),
            Half::Left(column) => (0.0, column.clamp(0.0, width as f64)),
            Half::Right(column) => (column.clamp(0.0, width as f64), width as f64),
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
            let (sheet, bytes) = chunk.upload(&self.levels, level);
            self.uploaded += bytes;
            let corner = |at: usize| {
                let place = chunk.place(corners[at].map(|cells| cells / size as f64));
                Corner { point: points[at], place, color: Color32::WHITE }
            };
            quads.push(Quad { corners: [0, 1, 2, 3].map(corner), sheet: Some((sheet, blended)) });
        }
        draw(painter, quads);
    }
}

/// A level's chunks, in rows.
fn chunks(bounds: Rect) -> Vec<Chunk> {
    let mut all = Vec::new();
    for y in (0..bounds.height).step_by(CHUNK) {
        for x in (0..bounds.width).step_by(CHUNK) {
            let inner = Rect { x, y, width: CHUNK, height: CHUNK }.intersection(bounds);
            all.push(Chunk {
                inner,
                padded: inner.grown(1, bounds),
                sheet: None,
                changed: Vec::new(),
            });
        }
    }
    all
}

impl Chunk {
    /// Notes a change of its level.
    fn mark(&mut self, rect: Rect) {
        let part = rect.intersection(self.padded);
        if part.is_empty() || self.sheet.is_none() {
            return;
        }
        // Neighbouring tiles become one upload.
        if let Some(joined) = self.changed.iter_mut().find(|other| tight(**other, part)) {
            *joined = union(*joined, part);
        } else if self.changed.len() < MOST_CHANGES {
            self.changed.push(part);
        } else {
            self.changed = vec![self.padded];
        }
    }

    /// Its sheet, brought up to date, and how many bytes that took.
    fn upload(&mut self, levels: &Levels, level: usize) -> (Sheet, u64) {
        let bytes = |rect: Rect| (4 * rect.width * rect.height) as u64;
        let Some(sheet) = &self.sheet else {
            let sheet = Sheet::new(levels.cut(level, self.padded));
            self.sheet = Some(sheet.clone());
            return (sheet, bytes(self.padded));
        };
        if !self.changed.is_empty() && sheet.waiting() > self.padded.width * self.padded.height {
            // Nothing was drawn for long: all at once is less.
            self.changed = vec![self.padded];
        }
        let mut sum = 0;
        for rect in self.changed.drain(..) {
            let at = [rect.x - self.padded.x, rect.y - self.padded.y];
            sheet.write(at, levels.cut(level, rect));
            sum += bytes(rect);
        }
        (sheet.clone(), sum)
    }

    /// A place of its level in the texture, 0..1.
    fn place(&self, [x, y]: [f64; 2]) -> eframe::egui::Pos2 {
        let Rect { x: left, y: top, width, height } = self.padded;
        let across = (x - left as f64) / width as f64;
        let down = (y - top as f64) / height as f64;
        pos2(across as f32, down as f32)
    }
}

/// Whether the smallest rectangle around both is hardly more than both.
fn tight(a: Rect, b: Rect) -> bool {
    let area = |rect: Rect| rect.width * rect.height;
    let overlap = area(a.intersection(b));
    4 * area(union(a, b)) <= 5 * (area(a) + area(b) - overlap)
}

fn union(a: Rect, b: Rect) -> Rect {
    let (x, y) = (a.x.min(b.x), a.y.min(b.y));
    let right = (a.x + a.width).max(b.x + b.width);
    let bottom = (a.y + a.height).max(b.y + b.height);
    Rect { x, y, width: right - x, height: bottom - y }
}
