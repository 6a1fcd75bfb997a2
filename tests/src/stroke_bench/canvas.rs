//! Sets up a canvas, brushes and hands for the strokes of the bench.

use std::ops::Range;
use std::sync::Arc;

use calibrate::library::PigmentLibrary;
use graphics::encoding::encoded_from_linear;
use graphics::field::Field;
use image::RgbImage;
use paint::amount::{mm_from_quanta, quanta_from_mm};
use paint::document::{Document, Lighting, Medium, Slots};
use paint::ground::GroundKind;
use paint::layer::{Cell, Layer, SLOTS};
use paint::light::Light;
use paint::painting::Painting;
use paint::{BrushId, HeadShape, PaintEngine, Sample};
use spectra::color::{Lab, RgbSpace};

use super::heights::Heights;
use super::measure::extent_mm;
use super::report::{Curve, Panel};

/// Pigments of the bench by slot.
pub const PIGMENTS: [&str; 5] =
    ["Ultramarine", "Chrome Yellow", "Zinc White", "Vermilion", "Lead White"];
/// Slot of the blue.
pub const BLUE_SLOT: usize = 0;
/// Slot of the yellow.
pub const YELLOW_SLOT: usize = 1;
/// Slot of the red.
pub const RED_SLOT: usize = 3;
/// Slot of the white that hides best.
pub const WHITE_SLOT: usize = 4;
/// Recipe of pure blue paint.
pub const BLUE: [f64; SLOTS] = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
/// Recipe of pure yellow paint.
pub const YELLOW: [f64; SLOTS] = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
/// Recipe of pure red paint.
pub const RED: [f64; SLOTS] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
/// Recipe of the white that hides best.
pub const WHITE: [f64; SLOTS] = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
/// Recipe of a light, hiding blue, in which relief shows.
pub const BODY: [f64; SLOTS] = [1.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0];

/// The bench never undoes anything.
const UNDO_BYTES: u64 = 1 << 20;

/// Settings of a run.
#[derive(Debug)]
pub struct Bench {
    /// Pigments of the bench.
    pub library: PigmentLibrary,
    /// Width of a cell in mm where a case does not choose its own.
    pub cell_mm: f64,
    /// Whether only the main strokes of each case are painted.
    pub small: bool,
    light: Arc<Light>,
}

impl Bench {
    /// Settings of a full run with cells of 0.1 mm, or of a small one with cells of 0.2 mm.
    ///
    /// # Panics
    /// Never: the library that ships has the default light.
    #[must_use]
    pub fn new(small: bool) -> Self {
        let library = PigmentLibrary::van_gogh_oils();
        let Lighting { illuminant, observer, .. } = Lighting::default();
        let light = Light::named(&library, &illuminant, &observer).expect("the default light");
        let cell_mm = if small { 0.2 } else { 0.1 };
        Self { library, cell_mm, small, light: Arc::new(light) }
    }

    /// A bare panel of `width_mm` x `height_mm`.
    #[must_use]
    pub fn panel(&self, size_mm: (f64, f64)) -> Easel {
        Easel::new(self, self.cell_mm, size_mm, GroundKind::Panel, |_, _| None)
    }
}

/// A canvas on the easel.
#[derive(Debug)]
pub struct Easel {
    /// The painting.
    pub painting: Painting,
}

impl Easel {
    /// A canvas with wet paint. For a place in mm, `paint` returns the slot and the height in mm.
    ///
    /// # Panics
    /// If the canvas cannot be made.
    #[must_use]
    pub fn new(
        bench: &Bench,
        cell_mm: f64,
        (width_mm, height_mm): (f64, f64),
        ground: GroundKind,
        paint: impl Fn(f64, f64) -> Option<(usize, f64)>,
    ) -> Self {
        let library = bench.library.clone();
        let [width, height] = [width_mm, height_mm].map(|mm| (mm / cell_mm).round() as usize);
        let ground = ground.spec(1).build(width, height, cell_mm, &library).expect("a ground");
        let slots: Slots = std::array::from_fn(|slot| {
            PIGMENTS
                .get(slot)
                .map(|name: &&str| library.find(name).expect("a pigment of the bench"))
        });
        let engine = PaintEngine::on_cpu(ground.height.clone());
        let medium = Medium::default();
        let lighting = Lighting::default();
        let mut document =
            Document::bare("strokes", cell_mm, ground, library.clone(), medium, slots, lighting);
        for index in 0..width * height {
            let [x, y] = [index % width, index / width].map(|at| (at as f64 + 0.5) * cell_mm);
            if let Some((slot, mm)) = paint(x, y) {
                let mut cell = Cell::default();
                cell.pigments[slot] = quanta_from_mm(mm, cell_mm);
                document.wet.set_cell(index, cell);
            }
        }
        let painting = Painting::open_under(document, Arc::clone(&bench.light), engine, UNDO_BYTES)
            .expect("a painting");
        Self { painting }
    }

    /// Adds a clean brush.
    ///
    /// # Panics
    /// If the size is out of range.
    pub fn brush(&mut self, shape: HeadShape, size_mm: f64) -> BrushId {
        self.painting.add_brush(shape, size_mm).expect("a brush")
    }

    /// Squeezes a heap of `mm3` of `recipe` out of a tube at a place in mm.
    ///
    /// # Panics
    /// If the place is off the canvas.
    pub fn squeeze(&mut self, recipe: &[f64; SLOTS], mm3: f64, (x_mm, y_mm): (f64, f64)) {
        self.painting.squeeze(recipe, 0.0, x_mm, y_mm, mm3).expect("a heap");
    }

    /// Washes a brush and loads it with `mm` of `recipe` without vehicle.
    ///
    /// # Panics
    /// If the brush cannot hold that much.
    pub fn load(&mut self, brush: BrushId, recipe: &[f64; SLOTS], mm: f64) {
        self.load_thinned(brush, recipe, 0.0, mm);
    }

    /// Washes a brush and loads it with `mm` of `recipe`, of which `vehicle` (0 to 1) is vehicle.
    ///
    /// # Panics
    /// If the brush cannot hold that much.
    pub fn load_thinned(&mut self, brush: BrushId, recipe: &[f64; SLOTS], vehicle: f64, mm: f64) {
        self.painting.wash(brush).expect("a clean brush");
        self.painting.load(brush, recipe, vehicle, mm).expect("a loaded brush");
    }

    /// Paints a stroke.
    ///
    /// # Panics
    /// If a sample is impossible.
    pub fn stroke(&mut self, brush: BrushId, samples: &[Sample]) {
        self.painting.stroke(brush, samples).expect("a stroke");
    }

    /// Wet paint on the canvas.
    ///
    /// # Panics
    /// Never on the processor.
    #[must_use]
    pub fn wet(&mut self) -> Layer {
        self.painting.wet().expect("the wet paint")
    }

    /// Paint on a brush.
    ///
    /// # Panics
    /// Never on the processor.
    #[must_use]
    pub fn on_brush(&mut self, brush: BrushId) -> Layer {
        self.painting.brush_paint(brush).expect("the paint of a brush")
    }

    /// Quanta of each slot, and last of vehicle, on the canvas and on `brushes`.
    #[must_use]
    pub fn quanta(&mut self, brushes: &[BrushId]) -> [i64; SLOTS + 1] {
        let mut layers = vec![self.wet()];
        layers.extend(brushes.iter().map(|&brush| self.on_brush(brush)));
        let totals = layers.iter().map(Layer::totals);
        totals.fold([0; SLOTS + 1], |sum, one| std::array::from_fn(|i| sum[i] + one[i] as i64))
    }

    /// Heights of the wet paint.
    #[must_use]
    pub fn heights(&mut self) -> Heights {
        let wet = self.wet();
        let cell_mm = self.painting.cell_mm();
        let cells = 0..wet.width() * wet.height();
        let mm = cells.map(|index| mm_from_quanta(wet.cell(index).volume(), cell_mm)).collect();
        Heights::new(cell_mm, wet.width(), mm)
    }

    /// Heights of the bare ground.
    #[must_use]
    pub fn ground(&self) -> Heights {
        let height = &self.painting.ground().height;
        let cell_mm = self.painting.cell_mm();
        Heights::new(
            cell_mm,
            height.width(),
            height
                .values()
                .iter()
                .map(|&quanta: &i32| f64::from(quanta) * mm_from_quanta(1, cell_mm))
                .collect(),
        )
    }

    /// Mean height in mm of the paint over all cells of a head.
    #[must_use]
    pub fn load_mm(&mut self, brush: BrushId) -> f64 {
        let paint = self.on_brush(brush);
        let cell_mm = self.painting.cell_mm();
        let cells = paint.width() * paint.height();
        let sum: f64 =
            (0..cells).map(|index| mm_from_quanta(paint.cell(index).volume(), cell_mm)).sum();
        sum / cells as f64
    }

    /// Colours of all cells, row by row, without relief and gloss.
    ///
    /// # Panics
    /// Never on the processor.
    #[must_use]
    pub fn colors(&mut self) -> Vec<Lab> {
        let matrix = RgbSpace::Srgb.xyz_from_linear();
        let picture = self.painting.flat_picture().expect("a picture");
        picture
            .values()
            .iter()
            .map(|rgb: &[f32; 4]| {
                let linear = [rgb[0], rgb[1], rgb[2]].map(f64::from);
                Lab::from_xyz(matrix.apply(linear).into(), RgbSpace::Srgb.white())
            })
            .collect()
    }

    /// Pictures of a part of the canvas (ranges in mm) in the default light and in a raking one,
    /// 20 degrees above the canvas.
    ///
    /// # Panics
    /// If the part is empty.
    #[must_use]
    pub fn show(
        &mut self,
        caption: impl Into<String>,
        x_mm: Range<f64>,
        y_mm: Range<f64>,
    ) -> Panel {
        let heights = self.heights();
        let columns = heights.columns_in(x_mm);
        let rows = heights.rows_in(y_mm);
        let mut pictures = Vec::new();
        for elevation_deg in [Lighting::default().elevation_deg, 20.0] {
            let lighting = Lighting { elevation_deg, ..Lighting::default() };
            self.painting.relight(lighting).expect("a light that has a name");
            let picture = encoded_from_linear(&self.painting.picture().expect("a picture"));
            pictures.push(cut(&picture, columns.clone(), rows.clone()));
        }
        self.painting.relight(Lighting::default()).expect("a light that has a name");
        let cell_mm = heights.cell_mm();
        let size_mm = (columns.len() as f64 * cell_mm, rows.len() as f64 * cell_mm);
        let curves = sections(&heights, &columns, &rows);
        Panel { caption: caption.into(), size_mm, zoom: 1.0, pictures, curves }
    }

    /// Pictures like [`Easel::show`], but large enough to see single cells.
    ///
    /// # Panics
    /// If the part is empty.
    #[must_use]
    pub fn enlarge(&mut self, caption: &str, x_mm: Range<f64>, y_mm: Range<f64>) -> Panel {
        self.show(format!("{caption}, enlarged"), x_mm, y_mm).zoomed(5.0)
    }
}

/// Sections through the paint in `columns` and `rows`: across and along, each at the middle and as
/// a mean.
fn sections(heights: &Heights, columns: &Range<usize>, rows: &Range<usize>) -> Vec<Curve> {
    let step_mm = heights.cell_mm();
    let middle = (columns.start + columns.end) / 2;
    let quarter = columns.len() / 4;
    let across = [middle..middle + 1, middle - quarter..middle + quarter]
        .map(|columns| heights.across(columns)[rows.clone()].to_vec());
    // Use the middle 60 % of the first mark, or of the picture if there is no mark.
    let (top, bottom) =
        first_mark_mm(&across[1], step_mm).unwrap_or((0.0, rows.len() as f64 * step_mm));
    let row = |share: f64| {
        let row = (top + share * (bottom - top)) / step_mm;
        (rows.start + row as usize).min(rows.end - 1)
    };
    let along = [row(0.5)..row(0.5) + 1, row(0.2)..row(0.8) + 1]
        .map(|rows| heights.along(rows)[columns.clone()].to_vec());
    let sections = [("across", across), ("along", along)];
    sections.map(|(caption, lines)| Curve { caption, step_mm, lines: lines.into() }).into()
}

/// Both edges in mm of the first mark of a profile. Gaps below 1 mm belong to it.
fn first_mark_mm(profile: &[f64], step_mm: f64) -> Option<(f64, f64)> {
    let (top, bottom) = extent_mm(profile, step_mm)?;
    let level = 0.05 * profile.iter().fold(0.0, |a: f64, &b| a.max(b));
    let gap = (1.0 / step_mm).ceil() as usize;
    let first = (top / step_mm) as usize;
    let bare = profile[first + 1..].windows(gap).position(|part| part.iter().all(|&mm| mm < level));
    Some((top, bare.map_or(bottom, |cells| (first + 1 + cells) as f64 * step_mm)))
}

fn cut(picture: &Field<[f32; 4]>, columns: Range<usize>, rows: Range<usize>) -> RgbImage {
    let left = columns.start;
    let top = rows.start;
    RgbImage::from_fn(columns.len() as u32, rows.len() as u32, |x, y| {
        let at = (top + y as usize) * picture.width() + left + x as usize;
        let [r, g, b, _] = picture.values()[at].map(|value| (255.0 * value).round() as u8);
        image::Rgb([r, g, b])
    })
}
