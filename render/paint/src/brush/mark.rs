//! The mark of a head that is pressed straight down on a plane.

use super::error::BrushError;
use super::head::Head;
use super::relief::Relief;
use super::shape::HeadShape;
use crate::contact::{Contact, Touch};
use crate::motion::press::{NO_CONTACT, coat, penetration};
use crate::pose::Pose;
use graphics::field::Field;
use graphics::tile::Rect;

/// Number of sub-steps after which a resting head has settled.
const SETTLED: usize = 8;

/// Extent of the plane relative to the width of the head, on each side of the pen: the hair of the
/// longest heads splays less.
const REACH: f64 = 4.0;

/// Cells that a clean head touches on a plane.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactMark {
    /// Whether the hair touches each cell. The field holds the touched cells and no margin; it is
    /// empty if nothing is touched.
    pub cells: Field<bool>,
    /// Position of the pen in mm from the upper left corner of `cells`.
    pub pen_mm: [f64; 2],
    /// Width of a cell in mm.
    pub cell_mm: f64,
}

impl ContactMark {
    /// The mark of an upright head of `size_mm` mm width, with its broad side along x, that is
    /// pressed down with `pressure` (0 to 1) over cells of `cell_mm` mm.
    ///
    /// # Errors
    /// [`BrushError`], as for [`Head::new`].
    pub fn of(
        shape: HeadShape,
        size_mm: f64,
        cell_mm: f64,
        pressure: f64,
    ) -> Result<Self, BrushError> {
        let mut head = Head::new(shape, size_mm, cell_mm)?;
        let middle = (REACH * size_mm / cell_mm).ceil().max(4.0) as usize;
        let side = 2 * middle;
        let relief = Relief::flat(side, side, cell_mm);
        let bounds = Rect { x: 0, y: 0, width: side, height: side };
        let at = middle as f64;
        let tilt_x_deg = 0.0;
        let tilt_y_deg = 0.0;
        let twist_deg = 0.0;
        let pose = Pose { x: at, y: at, pressure, tilt_x_deg, tilt_y_deg, twist_deg };
        let mut contact = Contact::default();
        head.set_down(&pose, (0.0, 0.0), &relief);
        for _ in 0..SETTLED {
            head.advance(&pose, &relief, bounds, &mut contact);
        }
        Ok(Self::cut(&contact, at, cell_mm))
    }

    /// The touched cells of a contact whose pen is at `at` cells along x and y.
    fn cut(contact: &Contact, at: f64, cell_mm: f64) -> Self {
        let Rect { x: left, y: top, width, .. } = contact.rect;
        let held: Vec<bool> = contact
            .touches
            .iter()
            .map(|touch: &Touch| {
                let coat = coat(&contact.rates, *touch, 0);
                penetration(&contact.rates, *touch, (0, 0), 0, coat) != NO_CONTACT
            })
            .collect();
        let places = held.iter().enumerate().filter(|(_, held)| **held);
        let places = places.map(|(index, _)| (index % width, index / width));
        let mut extent: Option<[usize; 4]> = None;
        for (x, y) in places {
            let [x0, y0, x1, y1] = extent.unwrap_or([x, y, x, y]);
            extent = Some([x0.min(x), y0.min(y), x1.max(x), y1.max(y)]);
        }
        let Some([x0, y0, x1, y1]) = extent else {
            return Self { cells: Field::filled(0, 0, false), pen_mm: [0.0; 2], cell_mm };
        };
        let rows = (y0..=y1).flat_map(|y| held[y * width + x0..=y * width + x1].iter().copied());
        let cells = Field::from_values(x1 - x0 + 1, y1 - y0 + 1, rows.collect());
        let pen_mm =
            [(left + x0, at), (top + y0, at)].map(|(first, at)| (at - first as f64) * cell_mm);
        Self { cells, pen_mm, cell_mm }
    }

    /// Width and height of the mark in mm.
    #[must_use]
    pub fn size_mm(&self) -> [f64; 2] {
        [self.cells.width(), self.cells.height()].map(|cells| cells as f64 * self.cell_mm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mark(shape: HeadShape, size_mm: f64, pressure: f64) -> ContactMark {
        ContactMark::of(shape, size_mm, 0.1, pressure).unwrap()
    }

    #[test]
    fn a_mark_grows_with_the_pressure_and_ends_at_its_outermost_cells() {
        for shape in HeadShape::ALL {
            let marks = [0.15, 0.5, 1.0].map(|pressure| mark(shape, 6.0, pressure));
            let areas = marks
                .each_ref()
                .map(|mark: &ContactMark| mark.cells.values().iter().filter(|held| **held).count());
            assert!(
                areas[0] > 0 && areas[0] < areas[1] && areas[1] < areas[2],
                "{shape}: {areas:?}"
            );
            let [width, height] = [marks[2].cells.width(), marks[2].cells.height()];
            let column = |x: usize| (0..height).any(|y| marks[2].cells[(x, y)]);
            let row = |y: usize| (0..width).any(|x| marks[2].cells[(x, y)]);
            assert!(column(0) && column(width - 1) && row(0) && row(height - 1), "{shape}");
        }
    }

    #[test]
    fn a_pressed_flat_is_as_wide_as_its_head_and_the_pen_stands_over_its_middle() {
        let flat = mark(HeadShape::Flat, 10.0, 0.5);
        let [width, height] = flat.size_mm();
        assert!((9.0..12.0).contains(&width), "{width} mm");
        assert!(height < 0.6 * width, "the broad side lies along x: {height} mm");
        assert!((flat.pen_mm[0] - 0.5 * width).abs() < 0.5, "{:?}", flat.pen_mm);
    }

    #[test]
    fn a_head_that_is_not_pressed_leaves_no_mark_and_a_wrong_size_is_refused() {
        assert_eq!(mark(HeadShape::Round, 6.0, 0.0).size_mm(), [0.0, 0.0]);
        assert!(ContactMark::of(HeadShape::Round, 500.0, 0.1, 0.5).is_err());
    }
}
