//! How thick a loaded brush lays its paint, found by trial strokes.
//!
//! What a head leaves in a sub-step is bounded (Baxter, Wendt and Lin 2004,
//! algorithm 1), so a stroke's height depends on how long the head lies on each
//! cell: on its shape, size and pressure. That is measured, not modelled; where
//! one stroke is too thin, the brush goes back over its path.

use calibrate::library::PigmentLibrary;

use super::plan::Plan;
use super::planned::{COVER, samples};
use crate::amount::mm_from_quanta;
use crate::field::Field;
use crate::layer::SLOTS;
use crate::optics::Gloss;
use crate::paint::brush::{Head, HeadShape};
use crate::paint::document::{Document, Ground, Lighting, Medium};
use crate::paint::on_cpu::OnCpu;
use crate::paint::painting::{Painting, PaintingError};
use crate::paint::pose::Sample;

/// The most times that a brush goes over one path.
const MOST_PASSES: usize = 4;
/// Length of a trial stroke, in sizes of the brush.
const LENGTH: f64 = 4.0;
/// The least load tried, in mm; each next one is twice as high.
const LEAST_LOAD_MM: f64 = 0.05;
const LOADS: usize = 7;

/// A brush on trial.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Laydown {
    /// For each number of passes, the load and the height that it gave, in mm.
    curves: Vec<Vec<[f64; 2]>>,
    /// Area of the head's paint, in squares of the brush's width.
    head_area: f64,
}

/// What a stroke is painted with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Touch {
    /// How often the brush goes over the path, 1 and up.
    pub(super) passes: usize,
    /// Height of the paint on the head, in mm.
    pub(super) load_mm: f64,
}

impl Laydown {
    /// Tries the brush of `size_mm` on a smooth dry ground, until it lays
    /// `most_mm` or has gone over its path as often as it may.
    pub(super) fn tried(
        shape: HeadShape,
        size_mm: f64,
        cell_mm: f64,
        plan: &Plan,
        library: &PigmentLibrary,
        most_mm: f64,
    ) -> Result<Self, PaintingError> {
        let (around, along) = Head::new(shape, size_mm, cell_mm)?.paint_grid();
        let head_area = (around * along) as f64 * (cell_mm / size_mm).powi(2);
        let mut trial = Trial { shape, size_mm, cell_mm, plan, library };
        let mut curves: Vec<Vec<[f64; 2]>> = Vec::new();
        for passes in 1..=MOST_PASSES {
            let mut curve = Vec::with_capacity(LOADS);
            for power in 0..LOADS {
                let load_mm = LEAST_LOAD_MM * f64::from(1 << power);
                curve.push([load_mm, trial.height_mm(passes, load_mm)?]);
            }
            let highest = curve.iter().map(|[_, height]| *height).fold(0.0, f64::max);
            curves.push(curve);
            if highest >= most_mm {
                break;
            }
        }
        Ok(Self { curves, head_area })
    }

    /// What lays a stroke of `length` sizes of the brush to `height_mm`, or as
    /// near as the brush comes.
    pub(super) fn touch(&self, height_mm: f64, length: f64) -> Touch {
        let found = self.curves.iter().enumerate().find_map(|(index, curve)| {
            Some(Touch { passes: index + 1, load_mm: load_for(curve, height_mm)? })
        });
        let touch = found.unwrap_or_else(|| {
            let curve = &self.curves[self.curves.len() - 1];
            let highest = curve.iter().map(|[_, height]| *height).fold(0.0, f64::max);
            let load_mm = load_for(curve, 0.95 * highest).unwrap_or(LEAST_LOAD_MM);
            Touch { passes: self.curves.len(), load_mm }
        });
        // A longer stroke takes more paint off the head, a shorter one less.
        let more = (length - LENGTH) * height_mm / self.head_area;
        Touch { load_mm: (touch.load_mm + more).max(touch.load_mm / 2.0), ..touch }
    }
}

/// The least load that gives a height, if any does.
fn load_for(curve: &[[f64; 2]], height_mm: f64) -> Option<f64> {
    let mut before = [0.0, 0.0];
    for &[load, height] in curve {
        if height >= height_mm {
            let share = (height_mm - before[1]) / (height - before[1]);
            return Some(before[0] + share * (load - before[0]));
        }
        before = [load, height];
    }
    None
}

/// What all trials of a brush share.
struct Trial<'a> {
    shape: HeadShape,
    size_mm: f64,
    cell_mm: f64,
    plan: &'a Plan,
    library: &'a PigmentLibrary,
}

impl Trial<'_> {
    /// The mean height, in mm, that a straight stroke leaves along its middle
    /// half, over what it is to cover.
    fn height_mm(&mut self, passes: usize, load_mm: f64) -> Result<f64, PaintingError> {
        let size = self.size_mm / self.cell_mm;
        let width = ((LENGTH + 3.0) * size).ceil() as usize;
        let height = (3.0 * size).ceil() as usize;
        let mut painting = self.canvas(width, height)?;
        let brush = painting.add_brush(self.shape, self.size_mm)?;
        let recipe = std::array::from_fn(|slot| if slot == 0 { 1.0 } else { 0.0 });
        painting.load(brush, &recipe, 0.0, load_mm)?;
        let points = (4.0 * LENGTH) as usize;
        let path: Vec<[f64; 2]> = (0..=points)
            .map(|point| [size * (1.5 + 0.25 * point as f64), height as f64 / 2.0])
            .collect();
        let samples = samples(&path, self.plan, size, self.cell_mm);
        painting.stroke(brush, &to_and_fro(&samples, passes))?;
        let wet = painting.wet()?;
        let span = |middle: f64, reach: f64| (middle - reach) as usize..(middle + reach) as usize;
        let mut quanta = 0;
        let mut cells = 0;
        let reach = (COVER * size / 2.0).max(0.5);
        for y in span(height as f64 / 2.0, reach) {
            for x in span(size * (1.5 + LENGTH / 2.0), LENGTH * size / 4.0) {
                quanta += u64::from(wet.cell(y * width + x).volume());
                cells += 1;
            }
        }
        Ok(quanta as f64 * mm_from_quanta(1, self.cell_mm) / f64::from(cells.max(1)))
    }

    /// A smooth bare canvas.
    fn canvas(&self, width: usize, height: usize) -> Result<Painting, PaintingError> {
        let floor = Field::filled(width, height, 0);
        let engine = Box::new(OnCpu::new(floor.clone()));
        let ground = Ground {
            name: "trial".to_owned(),
            height: floor,
            reflectance: vec![1.0; self.library.grid.count()],
            gloss: Gloss { strength: 0.0, exponent: 10.0 },
        };
        let mut slots = [None; SLOTS];
        slots[0] = Some(0);
        let (library, medium) = (self.library.clone(), Medium::default());
        let light = Lighting::default();
        let bare = Document::bare("trial", self.cell_mm, ground, library, medium, slots, light);
        Painting::open(bare, engine, 0)
    }
}

/// A path that is gone over `passes` times, forth and back.
pub(super) fn to_and_fro(samples: &[Sample], passes: usize) -> Vec<Sample> {
    let lasts = samples.last().map_or(0.0, |sample| sample.seconds);
    let mut way: Vec<Sample> = Vec::with_capacity(samples.len() * passes);
    for pass in 0..passes {
        let begun = lasts * pass as f64;
        if pass % 2 == 0 {
            way.extend(samples.iter().map(|s| Sample { seconds: begun + s.seconds, ..*s }));
        } else {
            let back = samples.iter().rev();
            way.extend(back.map(|s| Sample { seconds: begun + lasts - s.seconds, ..*s }));
        }
    }
    way
}
