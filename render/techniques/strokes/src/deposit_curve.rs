//! Thickness of the film that a loaded brush lays, measured with trial strokes.
//!
//! A head leaves a film nearly in proportion to the paint that it holds. The ratio depends on the
//! shape, the size and the pressure of the head. We measure this instead of modelling it.

use super::planned_strokes::{COVER, poses};
use super::settings::Plan;
use graphics::field::Field;
use paint::BrushId;
use paint::amount::{mm_from_quanta, quanta_from_mm};
use paint::brush::{Head, HeadShape, Relief};
use paint::document::Medium;
use paint::engine::PaintEngine;
use paint::layer::Layer;
use paint::motion::MotionConstants;
use paint::painting::PaintingError;
use paint::stroke::{contacts, substeps};

/// Length of a trial stroke in brush widths.
const LENGTH: f64 = 4.0;
/// Loads tried in mm, rising.
const LOADS_MM: [f64; 4] = [0.05, 0.2, 0.8, 3.2];

/// Thickness of the film that a brush lays, by its load.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct DepositCurve {
    /// Two or more pairs of load and thickness laid, both in mm and rising from 0.
    curve: Vec<[f64; 2]>,
    /// Area of the head that holds paint, in squares as wide as the brush.
    head_area: f64,
}

impl DepositCurve {
    /// Measures a brush of `size_mm` on a smooth dry ground.
    pub(super) fn measure(
        shape: HeadShape,
        size_mm: f64,
        cell_mm: f64,
        plan: &Plan,
    ) -> Result<Self, PaintingError> {
        let mut trial = Trial::new(shape, size_mm, cell_mm, plan)?;
        let mut curve = vec![[0.0; 2]];
        for load_mm in LOADS_MM {
            let height_mm = trial.height_mm(load_mm)?;
            if height_mm > curve[curve.len() - 1][1] {
                curve.push([load_mm, height_mm]);
            }
        }
        if curve.len() == 1 {
            // A brush that lays nothing at all may as well be full.
            curve.push([LOADS_MM[LOADS_MM.len() - 1], f64::MIN_POSITIVE]);
        }
        Ok(Self { curve, head_area: trial.head_area() })
    }

    /// Load in mm with which a stroke of `length` brush widths is `height_mm` mm thick half-way.
    pub(super) fn load_mm(&self, height_mm: f64, length: f64) -> f64 {
        let thinner = self.curve.partition_point(|[_, laid_mm]| *laid_mm < height_mm);
        let above = thinner.clamp(1, self.curve.len() - 1);
        let [[from, thin], [to, thick]] = [self.curve[above - 1], self.curve[above]];
        // Beyond the last load, the last share holds.
        let load_mm = from + (height_mm - thin) / (thick - thin) * (to - from);
        // Half-way along a longer stroke, the head has given more.
        let given_mm = (length - LENGTH) / 2.0 * height_mm / self.head_area;
        (load_mm + given_mm).max(load_mm / 2.0).min(LOADS_MM[LOADS_MM.len() - 1])
    }
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
        let width = ((LENGTH + 3.0) * size).ceil();
        let height = (3.0 * size).ceil();
        let width = width as usize;
        let height = height as usize;
        let mut engine = PaintEngine::on_cpu(Field::filled(width, height, 0));
        let (around, along) = head.paint_grid();
        let brush = engine.add_brush(around, along)?;
        let relief = Relief::flat(width, height, cell_mm);
        Ok(Self { head, plan, relief, engine, brush })
    }

    /// Area of the head that holds paint, in squares as wide as the brush.
    fn head_area(&self) -> f64 {
        let (around, along) = self.head.paint_grid();
        let cell = self.head.cell_mm() / self.head.size_mm();
        (around * along) as f64 * self.head.paint_cell_area() * cell.powi(2)
    }

    /// Mean thickness in mm of the paint that a straight stroke leaves along its middle half,
    /// over the width that it should cover.
    fn height_mm(&mut self, load_mm: f64) -> Result<f64, PaintingError> {
        let cell_mm = self.head.cell_mm();
        let size = self.head.size_mm() / cell_mm;
        let bounds = self.engine.bounds();
        let middle = bounds.height as f64 / 2.0;
        self.engine.set_wet(&Layer::empty(bounds.width, bounds.height))?;
        let (around, along) = self.head.paint_grid();
        let mut loaded = Layer::empty(around, along);
        let column_mm = load_mm * self.head.paint_cell_area();
        loaded.vehicle.values_mut().fill(quanta_from_mm(column_mm, cell_mm));
        self.engine.set_brush_paint(self.brush, &loaded)?;
        let points = (4.0 * LENGTH) as usize;
        let path: Vec<[f64; 2]> =
            (0..=points).map(|point| [size * (1.5 + 0.25 * point as f64), middle]).collect();
        let samples = poses(&path, self.plan, size, cell_mm);
        let poses = substeps(&samples, cell_mm, self.head.size_mm())?;
        let motion = MotionConstants::new(cell_mm, Medium::default().stiffness);
        for contact in contacts(&mut self.head, poses, &self.relief, bounds) {
            self.engine.apply_contacts(self.brush, &motion, &[contact])?;
        }
        let wet = self.engine.wet()?;
        let along = (size * (1.5 + LENGTH / 2.0), LENGTH * size / 4.0);
        let [rows, columns] = [(middle, (COVER * size / 2.0).max(0.5)), along]
            .map(|(middle, reach)| (middle - reach) as usize..(middle + reach) as usize);
        let mut quanta = 0;
        let mut cells = 0;
        for y in rows {
            for x in columns.clone() {
                quanta += u64::from(wet.vehicle[(x, y)]);
                cells += 1;
            }
        }
        Ok(quanta as f64 * mm_from_quanta(1, cell_mm) / f64::from(cells.max(1)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use paint::document::Canvas;
    use paint::ground::GroundKind;
    use paint::session::PaintingSession;
    use pigment::PigmentLibrary;

    const CELL_MM: f64 = 0.25;

    /// Mean thickness in mm along the middle half of a stroke of `length` brush widths on a panel,
    /// over the width that it covers.
    fn laid_mm(brush: (HeadShape, f64), load_mm: f64, length: f64, plan: &Plan) -> f64 {
        let (shape, size_mm) = brush;
        let canvas = Canvas {
            width_mm: (length + 3.0) * size_mm,
            height_mm: 3.0 * size_mm,
            cell_mm: CELL_MM,
            ground: GroundKind::Panel.spec(1),
        };
        let oils = PigmentLibrary::van_gogh_oils();
        let mut session = PaintingSession::on_canvas(&oils, &canvas).unwrap();
        let painting = session.canvas_mut();
        let size = size_mm / CELL_MM;
        let path =
            (0..=(4.0 * length) as usize).map(|at| [size * (1.5 + 0.25 * at as f64), 1.5 * size]);
        let path: Vec<[f64; 2]> = path.collect();
        let brush = painting.add_brush(shape, size_mm).unwrap();
        let white = std::array::from_fn(|slot| f64::from(u8::from(slot == 0)));
        painting.load(brush, &white, 0.0, load_mm).unwrap();
        painting.stroke(brush, &poses(&path, plan, size, CELL_MM)).unwrap();
        let wet = painting.wet().unwrap();
        let mut sum = 0.0;
        let mut cells = 0;
        for y in ((1.5 - COVER / 2.0) * size) as usize..((1.5 + COVER / 2.0) * size) as usize {
            for x in
                ((1.5 + 0.25 * length) * size) as usize..((1.5 + 0.75 * length) * size) as usize
            {
                sum += mm_from_quanta(wet.cell(y * wet.vehicle.width() + x).volume(), CELL_MM);
                cells += 1;
            }
        }
        sum / f64::from(cells)
    }

    #[test]
    fn strokes_come_out_as_thick_as_asked() {
        let plan = Plan::default();
        for brush in [(HeadShape::Filbert, 8.0), (HeadShape::Round, 2.0)] {
            let curve = DepositCurve::measure(brush.0, brush.1, CELL_MM, &plan).unwrap();
            for length in [LENGTH, 12.0] {
                for height_mm in [0.05, 0.1, 0.3] {
                    let laid = laid_mm(brush, curve.load_mm(height_mm, length), length, &plan);
                    let off = laid / height_mm - 1.0;
                    assert!(off.abs() < 0.2, "{brush:?}, {length}: {laid} for {height_mm}");
                }
            }
        }
    }

    #[test]
    fn longer_strokes_take_more_paint() {
        let curve = vec![[0.0, 0.0], [0.1, 0.02], [0.2, 0.06]];
        let curve = DepositCurve { curve, head_area: 4.0 };
        assert!((curve.load_mm(0.04, LENGTH) - 0.15).abs() < 1e-9);
        assert!((curve.load_mm(0.04, 2.0 * LENGTH) - 0.17).abs() < 1e-9);
        assert!((curve.load_mm(0.04, 1.0) - 0.135).abs() < 1e-9);
        assert!((curve.load_mm(0.1, LENGTH) - 0.3).abs() < 1e-9, "beyond the last");
        assert!(curve.load_mm(9.0, LENGTH) <= 3.2);
    }
}
