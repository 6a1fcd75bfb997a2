//! Paints strokes that nobody sees in a page, before the painter's first one.
//!
//! A browser compiles the functions of a module for speed only after they have run for a while.
//! Without these strokes, slow functions would paint the first second of the first stroke.

use paint::brush::HeadShape;
use paint::document::Canvas;
use paint::ground::GroundSpec;
use paint::painting::PaintingError;
use paint::pose::Sample;
use paint::session::PaintingSession;
use paint::strokes::BrushSpec;
use pigment::library::PigmentLibrary;

use super::srgb::{SrgbBytes, encode};

/// Number of strokes. Each has about 20 sub-steps.
const STROKES: usize = 30;

/// Size of the canvas in mm, and of its cells.
const SIZE_MM: (f64, f64) = (16.0, 12.0);
const CELL_MM: f64 = 0.1;

/// The brush and the paint that the studio opens with.
const BRUSH: &str = "round";
const BRUSH_MM: f64 = 6.0;
const PAINT: [(&str, f64); 2] = [("Zinc White", 1.0), ("Ultramarine", 1.0)];

/// The strokes that still have to be painted, on their own canvas.
#[derive(Debug)]
pub struct WarmUp {
    left: usize,
    session: Option<PaintingSession>,
}

impl Default for WarmUp {
    fn default() -> Self {
        Self { left: STROKES, session: None }
    }
}

impl WarmUp {
    /// Paints the next stroke and its picture, up to about 50 ms of work. Returns whether there was
    /// one.
    pub fn step(&mut self) -> bool {
        if self.left == 0 {
            return false;
        }
        self.left -= 1;
        // If this fails, the same error comes again when the painter begins, and is shown then.
        if self.paint().is_err() {
            self.left = 0;
        }
        if self.left == 0 {
            self.session = None;
        }
        true
    }

    fn paint(&mut self) -> Result<(), PaintingError> {
        let Some(session) = &mut self.session else {
            self.session = Some(Self::begin()?);
            return Ok(());
        };
        let (from, to) = if self.left.is_multiple_of(2) { (6.0, 7.6) } else { (7.6, 6.0) };
        let samples = [(0.0, from), (0.02, to)];
        let stroke = samples.map(|(s, x)| Sample::upright(s, x, 0.5 * SIZE_MM.1, 0.5));
        session.stroke(BRUSH, &stroke)?;
        let canvas = session.canvas_mut();
        let tiles = canvas.refresh(false)?;
        let bounds = canvas.bounds();
        encode(&tiles, bounds, &SrgbBytes::new(), |rect| canvas.picture_in(false, rect))?;
        Ok(())
    }

    fn begin() -> Result<PaintingSession, PaintingError> {
        let (width_mm, height_mm) = SIZE_MM;
        let ground = GroundSpec::default();
        let canvas = Canvas { width_mm, height_mm, cell_mm: CELL_MM, ground };
        let mut session = PaintingSession::on_canvas(&PigmentLibrary::van_gogh_oils(), &canvas)?;
        session.set_brush(BRUSH, &BrushSpec { shape: HeadShape::Round, size_mm: BRUSH_MM })?;
        session.load(BRUSH, PAINT, 0.3)?;
        Ok(session)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strokes_are_painted_until_none_is_left() {
        let mut warm_up = WarmUp::default();
        assert!(warm_up.step() && warm_up.session.is_some());
        warm_up.paint().unwrap();
        fn painted(warm_up: &mut WarmUp) -> u64 {
            let canvas = warm_up.session.as_mut().unwrap().canvas_mut();
            canvas.wet().unwrap().totals().iter().sum()
        }
        let first = painted(&mut warm_up);
        warm_up.paint().unwrap();
        assert!(first > 0 && painted(&mut warm_up) > first);
        assert_eq!(std::iter::from_fn(|| warm_up.step().then_some(())).count(), STROKES - 1);
        assert!(warm_up.session.is_none());
    }
}
