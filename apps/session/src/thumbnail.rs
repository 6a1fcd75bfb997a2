//! Summary of a dry layer: statistics of all cells, and some cells for a thumbnail.

use std::sync::Arc;

use graphics::field::Field;
use graphics::tile::{Rect, TILE};
use paint::document::{Document, DryLayer};
use paint::ground::Ground;
use paint::layer::Layer;
use paint::painting::{DryLayerState, Painting};
use paint::scene;

use super::srgb::SrgbBytes;
use super::state::{LayerState, Thumbnail};

/// Longer side of a thumbnail in pixels: enough for a row of the panel on a screen with two pixels
/// a point.
const LONGEST: usize = 160;

/// Number of cells per pixel in each direction.
const PROBES: usize = 2;

/// Statistics and sampled cells of a dry layer.
#[derive(Debug, Clone)]
pub(super) struct LayerSummary {
    mean_mm: f64,
    max_mm: f64,
    coverage: f64,
    /// `PROBES` x `PROBES` cells for each pixel of the thumbnail.
    cells: Layer,
}

impl LayerSummary {
    /// Summary of a layer of `bounds`. `read` returns the paint of a rectangle; it is called
    /// for rows of tiles.
    ///
    /// # Errors
    /// The errors of `read`.
    pub(super) fn new<E>(
        bounds: Rect,
        cell_mm: f64,
        mut read: impl FnMut(Rect) -> Result<Layer, E>,
    ) -> Result<Self, E> {
        let (width, height) = size(bounds);
        let mut cells = Layer::empty(PROBES * width, PROBES * height);
        let place =
            |index: usize, count: usize, along: usize| (2 * index + 1) * along / (2 * count);
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
        let mm = |quanta: f64| quanta * paint::amount::mm_from_quanta(1, cell_mm);
        Ok(Self {
            mean_mm: mm(sum as f64 / painted.max(1) as f64),
            max_mm: mm(f64::from(most)),
            coverage: painted as f64 / (bounds.width * bounds.height).max(1) as f64,
            cells,
        })
    }

    /// State of the layer whose properties are `dry`.
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

    /// Picture of the layer alone over the ground, with its opacity, whether it is shown or not.
    fn thumbnail(&self, dry: &DryLayerState, painting: &Painting, bytes: &SrgbBytes) -> Thumbnail {
        let columns = self.cells.width();
        let rows = self.cells.height();
        let layer = DryLayer::new(dry.id, dry.slots, self.cells.clone());
        let layer = DryLayer { opacity: dry.opacity, ..layer };
        let document = document_of(painting, layer);
        let mut scene = scene::scene(&document, painting.light());
        // Neighbouring sampled cells are not neighbours on the canvas, so their slopes have no
        // meaning.
        scene.lamp.relief = 0.0;
        let picture = scene::picture(&document, &scene);
        let width = columns / PROBES;
        let height = rows / PROBES;
        let pixel = |index: usize| {
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
        };
        Thumbnail { width, height, pixels: (0..width * height).map(pixel).collect() }
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

/// Width and height of the thumbnail of a canvas in pixels, at most one pixel a cell.
fn size(bounds: Rect) -> (usize, usize) {
    let longer = bounds.width.max(bounds.height);
    let side = |cells: usize| (cells * LONGEST.min(longer) / longer.max(1)).max(1);
    (side(bounds.width), side(bounds.height))
}
