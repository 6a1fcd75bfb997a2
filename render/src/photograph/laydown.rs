//! How thick a loaded brush lays its paint, found by trial strokes.
//!
//! What a head leaves in a sub-step is bounded (Baxter, Wendt and Lin 2004,
//! algorithm 1), so a stroke's height depends on how long the head lies on each
//! cell: on its shape, size and pressure. That is measured, not modelled; where
//! one stroke is too thin, the brush goes back over its path.

use super::plan::Plan;
use super::planned::{COVER, samples};
use graphics::field::Field;
use paint::BrushId;
use paint::amount::{mm_from_quanta, quanta_from_mm};
use paint::brush::{Head, HeadShape, Relief};
use paint::engine::PaintEngine;
use paint::layer::Layer;
use paint::motion::MotionConstants;
use paint::painting::PaintingError;
use paint::pose::Sample;
use paint::stroke::{contacts, substeps};

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
        most_mm: f64,
    ) -> Result<Self, PaintingError> {
        let mut trial = Trial::new(shape, size_mm, cell_mm, plan)?;
        let (around, along) = trial.head.paint_grid();
        let head_area = (around * along) as f64 * (cell_mm / size_mm).powi(2);
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
    head: Head,
    plan: &'a Plan,
    relief: Relief,
    engine: PaintEngine,
    brush: BrushId,
}

impl<'a> Trial<'a> {
    fn new(
        shape: HeadShape,
        size_mm: f64,
        cell_mm: f64,
        plan: &'a Plan,
    ) -> Result<Self, PaintingError> {
        let head = Head::new(shape, size_mm, cell_mm)?;
        let size = size_mm / cell_mm;
        let (width, height) = (((LENGTH + 3.0) * size).ceil(), (3.0 * size).ceil());
        let (width, height) = (width as usize, height as usize);
        let mut engine = PaintEngine::on_cpu(Field::filled(width, height, 0));
        let (around, along) = head.paint_grid();
        let brush = engine.add_brush(around, along)?;
        let relief = Relief::flat(width, height, cell_mm);
        Ok(Self { head, plan, relief, engine, brush })
    }

    /// The mean height, in mm, that a straight stroke leaves along its middle
    /// half, over what it is to cover.
    fn height_mm(&mut self, passes: usize, load_mm: f64) -> Result<f64, PaintingError> {
        let cell_mm = self.head.cell_mm();
        let size = self.head.size_mm() / cell_mm;
        let bounds = self.engine.bounds();
        let middle = bounds.height as f64 / 2.0;
        self.engine.set_wet(&Layer::empty(bounds.width, bounds.height))?;
        let (around, along) = self.head.paint_grid();
        let mut loaded = Layer::empty(around, along);
        loaded.vehicle.values_mut().fill(quanta_from_mm(load_mm, cell_mm));
        self.engine.set_brush_paint(self.brush, &loaded)?;
        let points = (4.0 * LENGTH) as usize;
        let path: Vec<[f64; 2]> =
            (0..=points).map(|point| [size * (1.5 + 0.25 * point as f64), middle]).collect();
        let samples = to_and_fro(&samples(&path, self.plan, size, cell_mm), passes);
        let poses = substeps(&samples, cell_mm)?;
        for contact in contacts(&mut self.head, poses, &self.relief, bounds) {
            self.engine.apply_contacts(self.brush, &MotionConstants::default(), &[contact])?;
        }
        let wet = self.engine.wet()?;
        let span = |middle: f64, reach: f64| (middle - reach) as usize..(middle + reach) as usize;
        let mut quanta = 0;
        let mut cells = 0;
        for y in span(middle, (COVER * size / 2.0).max(0.5)) {
            for x in span(size * (1.5 + LENGTH / 2.0), LENGTH * size / 4.0) {
                quanta += u64::from(wet.vehicle[(x, y)]);
                cells += 1;
            }
        }
        Ok(quanta as f64 * mm_from_quanta(1, cell_mm) / f64::from(cells.max(1)))
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

#[cfg(test)]
mod tests {
    use super::*;

    const CELL_MM: f64 = 0.25;

    #[test]
    fn strokes_come_out_within_a_factor_of_two() {
        let plan = Plan::default();
        for (shape, size_mm) in [(HeadShape::Filbert, 8.0), (HeadShape::Round, 2.0)] {
            let laydown = Laydown::tried(shape, size_mm, CELL_MM, &plan, 0.1).unwrap();
            let mut trial = Trial::new(shape, size_mm, CELL_MM, &plan).unwrap();
            for height_mm in [0.02, 0.03, 0.05] {
                let Touch { passes, load_mm } = laydown.touch(height_mm, LENGTH);
                let found = trial.height_mm(passes, load_mm).unwrap();
                let ratio = found / height_mm;
                assert!((0.5..2.0).contains(&ratio), "{shape} {size_mm}: {found} for {height_mm}");
            }
        }
    }

    #[test]
    fn longer_strokes_take_more_paint() {
        let laydown = Laydown { curves: vec![vec![[0.1, 0.02], [0.2, 0.06]]], head_area: 4.0 };
        let touch = |height, length| laydown.touch(height, length);
        assert!((touch(0.04, LENGTH).load_mm - 0.15).abs() < 1e-9, "{:?}", touch(0.04, LENGTH));
        assert_eq!(touch(0.04, LENGTH).passes, 1);
        assert!(touch(0.04, 2.0 * LENGTH).load_mm > 0.18);
        assert!(touch(0.04, 1.0).load_mm < 0.15);
        assert!((touch(0.5, LENGTH).load_mm - 0.1925).abs() < 1e-9, "as near as it comes");
    }

    #[test]
    fn going_back_keeps_the_path_and_the_clock() {
        let sample = |seconds: f64| Sample {
            seconds,
            x_mm: seconds,
            y_mm: 0.0,
            pressure: 0.5,
            tilt_x_deg: 0.0,
            tilt_y_deg: 0.0,
            twist_deg: 90.0,
        };
        let way = to_and_fro(&[sample(0.0), sample(1.0), sample(3.0)], 3);
        let told: Vec<(f64, f64)> = way.iter().map(|s| (s.seconds, s.x_mm)).collect();
        let wanted = [
            (0.0, 0.0),
            (1.0, 1.0),
            (3.0, 3.0),
            (3.0, 3.0),
            (5.0, 1.0),
            (6.0, 0.0),
            (6.0, 0.0),
            (7.0, 1.0),
            (9.0, 3.0),
        ];
        assert_eq!(told, wanted);
    }
}
