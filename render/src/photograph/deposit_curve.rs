//! Height of the paint that a loaded brush lays, measured with trial strokes.
//!
//! The paint that a head leaves per sub-step is bounded (Baxter, Wendt and Lin 2004, algorithm
//! 1), so a stroke's height depends on how long the head touches each cell, that is on its
//! shape, size and pressure. The height is measured, not modelled. Where one stroke is too
//! thin, the brush goes back over its path.

use super::plan::Plan;
use super::planned::{COVER, poses};
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

/// Most passes of a brush over one path.
const MOST_PASSES: usize = 4;
/// Length of a trial stroke in brush widths.
const LENGTH: f64 = 4.0;
/// Least load tried in mm; each further load is twice the one before.
const LEAST_LOAD_MM: f64 = 0.05;
/// Number of loads tried.
const LOADS: usize = 7;

/// Heights of paint that a brush lays, by passes and load.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct DepositCurve {
    /// For each number of passes, pairs of load and height laid, both in mm.
    curves: Vec<Vec<[f64; 2]>>,
    /// Area of the head that holds paint, in squares as wide as the brush.
    head_area: f64,
}

/// Load and passes of a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct StrokeLoad {
    /// Number of passes over the path, 1 or more.
    pub(super) passes: usize,
    /// Height of the paint on the head in mm.
    pub(super) load_mm: f64,
}

impl DepositCurve {
    /// Measures a brush of `size_mm` on a smooth dry ground with more and more passes, until it
    /// lays `most_mm` or has made the most passes.
    pub(super) fn measure(
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

    /// Load and passes that lay a stroke of `length` brush widths to `height_mm`, or as near to
    /// it as the brush comes.
    pub(super) fn load_for_stroke(&self, height_mm: f64, length: f64) -> StrokeLoad {
        let found = self.curves.iter().enumerate().find_map(|(index, curve)| {
            Some(StrokeLoad { passes: index + 1, load_mm: load_for(curve, height_mm)? })
        });
        let load = found.unwrap_or_else(|| {
            let curve = &self.curves[self.curves.len() - 1];
            let highest = curve.iter().map(|[_, height]| *height).fold(0.0, f64::max);
            let load_mm = load_for(curve, 0.95 * highest).unwrap_or(LEAST_LOAD_MM);
            StrokeLoad { passes: self.curves.len(), load_mm }
        });
        // A longer stroke takes more paint off the head, a shorter one less.
        let more = (length - LENGTH) * height_mm / self.head_area;
        StrokeLoad { load_mm: (load.load_mm + more).max(load.load_mm / 2.0), ..load }
    }
}

/// Least load that gives a height, interpolated; `None` if none does.
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

/// Set-up of the trial strokes of one brush.
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

    /// Mean height in mm of the paint that a straight stroke leaves along its middle half, over
    /// the width that it should cover.
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
        let samples = repeated_path(&poses(&path, self.plan, size, cell_mm), passes);
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

/// Poses along a path that is followed `passes` times, forth and back in turn.
pub(super) fn repeated_path(samples: &[Sample], passes: usize) -> Vec<Sample> {
    let duration = samples.last().map_or(0.0, |sample| sample.seconds);
    let mut repeated: Vec<Sample> = Vec::with_capacity(samples.len() * passes);
    for pass in 0..passes {
        let start = duration * pass as f64;
        if pass % 2 == 0 {
            repeated.extend(samples.iter().map(|s| Sample { seconds: start + s.seconds, ..*s }));
        } else {
            let back = samples.iter().rev();
            repeated.extend(back.map(|s| Sample { seconds: start + duration - s.seconds, ..*s }));
        }
    }
    repeated
}

#[cfg(test)]
mod tests {
    use super::*;

    const CELL_MM: f64 = 0.25;

    #[test]
    fn strokes_come_out_within_a_factor_of_two() {
        let plan = Plan::default();
        for (shape, size_mm) in [(HeadShape::Filbert, 8.0), (HeadShape::Round, 2.0)] {
            let curve = DepositCurve::measure(shape, size_mm, CELL_MM, &plan, 0.1).unwrap();
            let mut trial = Trial::new(shape, size_mm, CELL_MM, &plan).unwrap();
            for height_mm in [0.02, 0.03, 0.05] {
                let StrokeLoad { passes, load_mm } = curve.load_for_stroke(height_mm, LENGTH);
                let found = trial.height_mm(passes, load_mm).unwrap();
                let ratio = found / height_mm;
                assert!((0.5..2.0).contains(&ratio), "{shape} {size_mm}: {found} for {height_mm}");
            }
        }
    }

    #[test]
    fn longer_strokes_take_more_paint() {
        let curve = DepositCurve { curves: vec![vec![[0.1, 0.02], [0.2, 0.06]]], head_area: 4.0 };
        let load = |height, length| curve.load_for_stroke(height, length);
        assert!((load(0.04, LENGTH).load_mm - 0.15).abs() < 1e-9, "{:?}", load(0.04, LENGTH));
        assert_eq!(load(0.04, LENGTH).passes, 1);
        assert!(load(0.04, 2.0 * LENGTH).load_mm > 0.18);
        assert!(load(0.04, 1.0).load_mm < 0.15);
        assert!((load(0.5, LENGTH).load_mm - 0.1925).abs() < 1e-9, "as near as it comes");
    }

    #[test]
    fn repeated_passes_keep_the_path_and_the_time() {
        let sample = |seconds: f64| Sample {
            seconds,
            x_mm: seconds,
            y_mm: 0.0,
            pressure: 0.5,
            tilt_x_deg: 0.0,
            tilt_y_deg: 0.0,
            twist_deg: 90.0,
        };
        let repeated = repeated_path(&[sample(0.0), sample(1.0), sample(3.0)], 3);
        let found: Vec<(f64, f64)> = repeated.iter().map(|s| (s.seconds, s.x_mm)).collect();
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
        assert_eq!(found, wanted);
    }
}
