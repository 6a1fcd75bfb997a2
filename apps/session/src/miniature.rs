//! Small pictures: a picture of the canvas that follows its changes, thumbnails of dry layers with
//! statistics of their cells, and pictures of the canvas after each action of the history within
//! limited memory.

use std::collections::BTreeMap;
use std::sync::Arc;

use graphics::field::Field;
use graphics::tile::{Rect, TILE, TileSet};
use paint::document::{Document, DryLayer};
use paint::ground::Ground;
use paint::layer::{DryLayerState, Layer};
use paint::painting::Painting;
use paint::scene;

use super::srgb::{SrgbBytes, runs};
use super::state::{HistoryShot, HistoryShots, LayerState, Thumbnail};

/// Longer side of the small picture in pixels, for canvases of up to `LONGEST * TILE` cells.
const LONGEST: usize = 240;

/// A small picture of the canvas. Each pixel is the mean of a square of cells. This also notes
/// which tiles changed since you last read the picture.
#[derive(Debug, Clone)]
pub(super) struct Miniature {
    bounds: Rect,
    /// Side of a pixel in cells: a power of two that divides a tile.
    step: usize,
    picture: Thumbnail,
    stale: TileSet,
}

impl Miniature {
    /// A picture of a canvas of `bounds`. None of it has been read yet.
    pub(super) fn new(bounds: Rect) -> Self {
        let longer = bounds.width.max(bounds.height);
        let mut step = 1;
        while step < TILE && longer.div_ceil(step) > LONGEST {
            step *= 2;
        }
        let width = bounds.width.div_ceil(step);
        let height = bounds.height.div_ceil(step);
        let picture = Thumbnail { width, height, pixels: vec![[0, 0, 0, 255]; width * height] };
        Self { bounds, step, picture, stale: TileSet::all(bounds) }
    }

    pub(super) fn bounds(&self) -> Rect {
        self.bounds
    }

    /// Marks tiles of the canvas as changed.
    pub(super) fn change(&mut self, tiles: &TileSet) {
        for tile in tiles.iter() {
            self.stale.insert_tile(tile);
        }
    }

    /// The picture with all changes. `read` returns a rectangle of the canvas in linear sRGB. Each
    /// call may transfer data from the device, so this calls it only once for each run of changed
    /// tiles in a row.
    pub(super) fn picture<E>(
        &mut self,
        bytes: &SrgbBytes,
        mut read: impl FnMut(Rect) -> Result<Field<[f32; 4]>, E>,
    ) -> Result<&Thumbnail, E> {
        for (run, _) in runs(&self.stale.take(), self.bounds) {
            let cells = read(run)?;
            self.reduce(run, &cells, bytes);
        }
        Ok(&self.picture)
    }

    /// Sets the pixels of the tiles in `rect` from their `cells`.
    fn reduce(&mut self, rect: Rect, cells: &Field<[f32; 4]>, bytes: &SrgbBytes) {
        let step = self.step;
        for top in (0..rect.height).step_by(step) {
            let height = step.min(rect.height - top);
            for left in (0..rect.width).step_by(step) {
                let width = step.min(rect.width - left);
                let mut sum = [0.0_f32; 3];
                for y in top..top + height {
                    for color in cells.row(y, left, width) {
                        for (sum, value) in sum.iter_mut().zip(color) {
                            *sum += value;
                        }
                    }
                }
                let [r, g, b] = sum.map(|sum| sum / (width * height) as f32);
                let x = (rect.x + left) / step;
                let y = (rect.y + top) / step;
                self.picture.pixels[y * self.picture.width + x] = bytes.pixel([r, g, b, 1.0]);
            }
        }
    }
}

/// Where two pictures of one size differ: left, top, width and height in pixels. Returns `None` if
/// they are equal.
pub(super) fn difference(before: &Thumbnail, after: &Thumbnail) -> Option<[usize; 4]> {
    let pairs = before.pixels.iter().zip(&after.pixels).enumerate();
    let places = pairs.filter(|(_, (a, b))| a != b);
    let places = places.map(|(index, _)| (index % after.width, index / after.width));
    let extent = places.fold(None, |extent: Option<[usize; 4]>, (x, y)| {
        let [x0, y0, x1, y1] = extent.unwrap_or([x, y, x, y]);
        Some([x0.min(x), y0.min(y), x1.max(x), y1.max(y)])
    });
    extent.map(|[x0, y0, x1, y1]| [x0, y0, x1 - x0 + 1, y1 - y0 + 1])
}

/// Longer side of a thumbnail in pixels. This is enough for a row of the panel on a screen with two
/// pixels per point.
const LONGEST_THUMBNAIL: usize = 160;

/// Sampled cells per pixel in each direction.
const PROBES: usize = 2;

#[derive(Debug, Clone)]
pub(super) struct LayerSummary {
    mean_mm: f64,
    max_mm: f64,
    coverage: f64,
    /// `PROBES` x `PROBES` cells for each pixel of the thumbnail.
    cells: Layer,
}

impl LayerSummary {
    /// Summary of a layer of `bounds`. `read` returns the paint of a rectangle, and is called once
    /// for each row of tiles.
    pub(super) fn new<E>(
        bounds: Rect,
        cell_mm: f64,
        mut read: impl FnMut(Rect) -> Result<Layer, E>,
    ) -> Result<Self, E> {
        let (width, height) = size(bounds);
        let mut cells = Layer::empty(PROBES * width, PROBES * height);
        fn place(index: usize, count: usize, along: usize) -> usize {
            (2 * index + 1) * along / (2 * count)
        }
        let columns: Vec<usize> =
            (0..cells.width()).map(|x| place(x, cells.width(), bounds.width)).collect();
        let rows: Vec<usize> =
            (0..cells.height()).map(|y| place(y, cells.height(), bounds.height)).collect();
        let mut sum = 0_u64;
        let mut most = 0_u32;
        let mut painted = 0_u64;
        for top in (0..bounds.height).step_by(TILE) {
            let height = TILE.min(bounds.height - top);
            let strip = read(Rect { x: 0, y: top, width: bounds.width, height })?;
            for index in 0..bounds.width * height {
                let volume = strip.cell(index).volume();
                sum += u64::from(volume);
                most = most.max(volume);
                painted += u64::from(volume > 0);
            }
            for (y, row) in rows.iter().enumerate() {
                let Some(row) = row.checked_sub(top).filter(|&row| row < height) else { continue };
                for (x, column) in columns.iter().enumerate() {
                    let cell = strip.cell(row * bounds.width + column);
                    cells.set_cell(y * columns.len() + x, cell);
                }
            }
        }
        let mm_per_quantum = paint::amount::mm_from_quanta(1, cell_mm);
        Ok(Self {
            mean_mm: sum as f64 / painted.max(1) as f64 * mm_per_quantum,
            max_mm: f64::from(most) * mm_per_quantum,
            coverage: painted as f64 / (bounds.width * bounds.height).max(1) as f64,
            cells,
        })
    }

    /// State of this layer, which has the properties `dry`.
    pub(super) fn state(
        &self,
        dry: &DryLayerState,
        painting: &Painting,
        bytes: &SrgbBytes,
    ) -> LayerState {
        LayerState {
            id: dry.id,
            name: dry.name.clone(),
            visible: dry.visible,
            slots: dry.slots,
            opacity: dry.opacity,
            mean_mm: self.mean_mm,
            max_mm: self.max_mm,
            coverage: self.coverage,
            thumbnail: Arc::new(self.thumbnail(dry, painting, bytes)),
        }
    }

    /// Picture of the layer alone over the ground. Uses its opacity, even if the layer is hidden.
    fn thumbnail(&self, dry: &DryLayerState, painting: &Painting, bytes: &SrgbBytes) -> Thumbnail {
        let columns = self.cells.width();
        let rows = self.cells.height();
        let layer = DryLayer::new(dry.id, dry.slots, self.cells.clone());
        let layer = DryLayer { opacity: dry.opacity, ..layer };
        let document = document_of(painting, layer);
        let mut scene = scene::scene(&document, painting.light());
        // The sampled cells are not neighbours on the canvas, so slopes between them mean nothing.
        scene.lamp.relief = 0.0;
        let picture = scene::picture(&document, &scene);
        let width = columns / PROBES;
        let height = rows / PROBES;
        let pixels = (0..width * height).map(|index| {
            let x = index % width * PROBES;
            let y = index / width * PROBES;
            let probes = (0..PROBES * PROBES).map(|i| (x + i % PROBES, y + i / PROBES));
            let mut sum = [0.0; 4];
            for (x, y) in probes {
                if self.cells.cell(y * columns + x).volume() > 0 {
                    for (sum, value) in sum.iter_mut().zip(picture[(x, y)]) {
                        *sum += value;
                    }
                }
            }
            // The fourth channel counts the cells with paint.
            let count = sum[3];
            let [r, g, b, _] = bytes.pixel(sum.map(|value| value / count.max(1.0)));
            [r, g, b, (255.0 * count / (PROBES * PROBES) as f32).round() as u8]
        });
        Thumbnail { width, height, pixels: pixels.collect() }
    }
}

/// Document of `layer` over the ground of `painting` without relief.
fn document_of(painting: &Painting, layer: DryLayer) -> Document {
    let width = layer.paint.width();
    let height = layer.paint.height();
    let Ground { name, reflectance, gloss, .. } = painting.ground();
    let level = Ground {
        name: name.clone(),
        height: Field::filled(width, height, 0),
        reflectance: reflectance.clone(),
        gloss: *gloss,
    };
    let cell_mm = painting.cell_mm();
    let library = painting.library().clone();
    let medium = painting.medium().clone();
    let lighting = painting.state().lighting.clone();
    let slots = layer.slots;
    let mut document = Document::bare("", cell_mm, level, library, medium, slots, lighting);
    document.dry.push(layer);
    document
}

/// Width and height of the thumbnail of a canvas in pixels, at most one pixel per cell.
fn size(bounds: Rect) -> (usize, usize) {
    let longer = bounds.width.max(bounds.height);
    let [width, height] = [bounds.width, bounds.height]
        .map(|cells| (cells * LONGEST_THUMBNAIL.min(longer) / longer.max(1)).max(1));
    (width, height)
}

/// Most memory that all pictures together may take, in bytes.
const MOST_BYTES: usize = 24 << 20;

/// Pictures of the canvas. Each is known by the number of the state that it shows.
#[derive(Debug, Clone)]
pub(super) struct Shots {
    /// Numbers of the states that undo and redo can reach.
    order: Vec<u64>,
    taken: BTreeMap<u64, HistoryShot>,
    most_bytes: usize,
}

impl Default for Shots {
    fn default() -> Self {
        Self { order: vec![0], taken: BTreeMap::new(), most_bytes: MOST_BYTES }
    }
}

impl Shots {
    /// Sets the numbers of the states that undo and redo can reach now, in increasing order. Drops
    /// the pictures of all other states.
    pub(super) fn follow(&mut self, numbers: &[u64]) {
        self.order.clear();
        self.order.extend_from_slice(numbers);
        self.taken.retain(|number, _| numbers.binary_search(number).is_ok());
    }

    /// Whether there is a picture after the first `done` actions.
    pub(super) fn has(&self, done: usize) -> bool {
        self.order.get(done).is_some_and(|number| self.taken.contains_key(number))
    }

    /// Stores the picture after the first `done` actions. If the memory is full, this drops the
    /// pictures of the oldest actions.
    pub(super) fn keep(&mut self, done: usize, picture: &Thumbnail) {
        let Some(&number) = self.order.get(done) else { return };
        let previous = done.checked_sub(1).and_then(|before| self.taken.get(&self.order[before]));
        let changed = previous.and_then(|previous| difference(&previous.picture, picture));
        let same = previous.filter(|previous| *previous.picture == *picture);
        // Actions on the palette do not change the canvas.
        let picture =
            same.map_or_else(|| Arc::new(picture.clone()), |same| Arc::clone(&same.picture));
        self.taken.insert(number, HistoryShot { picture, changed });
        let mut bytes = self.bytes();
        for oldest in self.order.clone() {
            if bytes <= self.most_bytes || oldest == number {
                break;
            }
            if self.taken.remove(&oldest).is_some() {
                bytes = self.bytes();
            }
        }
    }

    /// Memory of the pictures. A picture that several actions share counts once.
    fn bytes(&self) -> usize {
        let in_order = self.order.iter().filter_map(|number| self.taken.get(number));
        let mut last: Option<&Arc<Thumbnail>> = None;
        let mut bytes = 0;
        for HistoryShot { picture, .. } in in_order {
            if !last.is_some_and(|last| Arc::ptr_eq(last, picture)) {
                bytes += picture.pixels.len() * size_of::<[u8; 4]>();
            }
            last = Some(picture);
        }
        bytes
    }

    /// Pictures in the order of the history.
    pub(super) fn report(&self) -> HistoryShots {
        let shots = self.order.iter().map(|number| self.taken.get(number).cloned()).collect();
        HistoryShots { shots, bytes: self.bytes(), most_bytes: self.most_bytes }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    fn canvas(width: usize, height: usize, color: impl Fn(usize, usize) -> f32) -> Field<[f32; 4]> {
        Field::from_values(
            width,
            height,
            (0..width * height)
                .map(|index: usize| [color(index % width, index / width); 4])
                .collect(),
        )
    }

    fn read(canvas: &Field<[f32; 4]>) -> impl FnMut(Rect) -> Result<Field<[f32; 4]>, Infallible> {
        |rect| Ok(canvas.part(rect))
    }

    #[test]
    fn pixels_are_the_means_of_linear_light_also_at_the_rim() {
        let bytes = SrgbBytes::new();
        // 500 cells need squares of 4. The last column of pixels has 2 cells.
        let checks = canvas(498, 70, |x, y| ((x + y) % 2) as f32);
        let mut small = Miniature::new(checks.bounds());
        let picture = small.picture(&bytes, read(&checks)).unwrap().clone();
        assert_eq!((picture.width, picture.height), (125, 18));
        let grey = bytes.pixel([0.5, 0.5, 0.5, 1.0]);
        assert!(picture.pixels.iter().all(|pixel| *pixel == grey), "{:?}", picture.pixels[0]);
    }

    #[test]
    fn only_changed_tiles_are_read_again() {
        let bytes = SrgbBytes::new();
        let before = canvas(300, 200, |x, _| x as f32 / 300.0);
        let after = canvas(300, 200, |x, y| if x < 70 && y < 10 { 1.0 } else { x as f32 / 300.0 });
        let mut small = Miniature::new(before.bounds());
        let first = small.picture(&bytes, read(&before)).unwrap().clone();
        let mut changed = TileSet::default();
        changed.insert(Rect { x: 0, y: 0, width: 70, height: 10 });
        small.change(&changed);
        let mut rects = Vec::new();
        let second = small.picture(&bytes, |rect| {
            rects.push(rect);
            Ok::<_, Infallible>(after.part(rect))
        });
        let second = second.unwrap().clone();
        assert_eq!(rects, [Rect { x: 0, y: 0, width: 128, height: 64 }], "two tiles at once");
        let whole = Miniature::new(after.bounds()).picture(&bytes, read(&after)).unwrap().clone();
        assert_eq!(second, whole);
        assert_eq!(difference(&first, &second), Some([0, 0, 35, 5]), "two cells a pixel");
        assert_eq!(difference(&first, &first), None);
    }

    /// A picture of 10 x 10 pixels, 400 bytes.
    fn picture(shade: u8) -> Thumbnail {
        let mut pixels = vec![[7, 7, 7, 255]; 100];
        pixels[34] = [shade, 0, 0, 255];
        Thumbnail { width: 10, height: 10, pixels }
    }

    fn shades(shots: &Shots) -> Vec<Option<u8>> {
        shots
            .report()
            .shots
            .iter()
            .map(|shot: &Option<HistoryShot>| shot.as_ref().map(|shot| shot.picture.pixels[34][0]))
            .collect()
    }

    #[test]
    fn pictures_follow_their_actions_through_undo_and_forgetting() {
        let mut shots = Shots::default();
        shots.keep(0, &picture(10));
        for number in 1..=3 {
            shots.follow(&(0..=number).collect::<Vec<_>>());
            assert!(!shots.has(number as usize));
            shots.keep(number as usize, &picture(10 + number as u8));
            assert!(shots.has(number as usize));
        }
        assert_eq!(shades(&shots), [Some(10), Some(11), Some(12), Some(13)]);
        // Two actions were undone and another was done.
        shots.follow(&[0, 1, 4]);
        assert_eq!(shades(&shots), [Some(10), Some(11), None]);
        assert_eq!(shots.taken.len(), 2, "pictures of what was undone for good are dropped");
        shots.keep(2, &picture(14));
        // The first action can no longer be undone.
        shots.follow(&[1, 4]);
        assert_eq!(shades(&shots), [Some(11), Some(14)]);
    }

    #[test]
    fn what_an_action_changed_is_outlined_and_equal_pictures_are_shared() {
        let mut shots = Shots::default();
        shots.keep(0, &picture(10));
        shots.follow(&[0, 1, 2]);
        shots.keep(1, &picture(20));
        shots.keep(2, &picture(20));
        let HistoryShots { shots, bytes, .. } = shots.report();
        let changed: Vec<_> = shots.iter().flatten().map(|shot| shot.changed).collect();
        assert_eq!(changed, [None, Some([4, 3, 1, 1]), None]);
        assert_eq!(bytes, 800, "the third is the second");
    }

    #[test]
    fn a_full_memory_drops_the_oldest_pictures_but_never_the_new_one() {
        let mut shots = Shots { most_bytes: 900, ..Shots::default() };
        shots.follow(&[0, 1, 2, 3]);
        for done in 0..=3 {
            shots.keep(done, &picture(done as u8));
            assert!(shots.bytes() <= 900, "{done}");
        }
        assert_eq!(shades(&shots), [None, None, Some(2), Some(3)]);
        let mut tight = Shots { most_bytes: 10, ..Shots::default() };
        tight.keep(0, &picture(1));
        assert_eq!(shades(&tight), [Some(1)]);
    }
}
