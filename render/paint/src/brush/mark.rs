//! The mark that you get if you press a head straight down on a plane.

use graphics::field::Field;
use graphics::tile::Rect;

use super::head::Head;
use super::relief::Relief;
use super::{BrushError, HeadShape};
use crate::contact::{Contact, Touch};
use crate::motion::press::{NO_CONTACT, coat, penetration};
use crate::pose::Pose;

/// Number of sub-steps after which a resting head has settled.
const SETTLED: usize = 8;

/// The plane extends this far to each side of the pen, in widths of the head: farther than even the
/// longest hair splays.
const REACH: f64 = 4.0;

/// Cells that a clean head touches on a plane.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactMark {
    /// Whether the hair touches each cell. The field holds the touched cells and no margin. It is
    /// empty if nothing is touched.
    pub cells: Field<bool>,
    /// Position of the pen in mm from the upper left corner of `cells`.
    pub pen_mm: [f64; 2],
    /// Width of a cell in mm.
    pub cell_mm: f64,
}

impl ContactMark {
    /// Computes the mark of an upright head of `size_mm` mm width, with its broad side along x. You
    /// press it down with `pressure` (0 to 1) over cells of `cell_mm` mm.
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
        let pose =
            Pose { x: at, y: at, pressure, tilt_x_deg, tilt_y_deg, twist_deg, speed_mm_s: 0.0 };
        let mut contact = Contact::default();
        head.set_down(&pose, (0.0, 0.0), &relief);
        for _ in 0..SETTLED {
            head.advance(&pose, &relief, bounds, &mut contact);
        }
        Ok(Self::cut(&contact, at, cell_mm))
    }

    /// The touched cells of a contact with the pen at `at` cells along x and y.
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
mod mark_tests {
    //! Tests of the marks of dragged heads. We check how wide, where, and how even they are for any
    //! lean of the hand.

    use crate::brush::{Head, HeadShape, Relief};
    use crate::contact::{Contact, ExchangeRates, Touch};
    use crate::motion::press::{NO_CONTACT, coat, penetration};
    use crate::pose::Pose;
    use graphics::tile::Rect;

    const BOUNDS: Rect = Rect { x: 0, y: 0, width: 600, height: 600 };
    /// Length of a stroke, and the length from which on we measure its mark, in cells.
    const WAY: (u32, u32) = (150, 100);
    /// Headings of the stroke. Each has leans of the handle, the upright one first, and the number of
    /// directions in which the handle leans.
    const HEADINGS_AND_LEANS_DEG: [(f64, [(f64, u32); 4]); 2] = [
        (0.0, [(0.0, 1), (10.0, 4), (20.0, 4), (45.0, 8)]),
        (127.0, [(0.0, 1), (10.0, 4), (35.0, 4), (60.0, 8)]),
    ];

    const HEADS: [(HeadShape, f64); 9] = [
        (HeadShape::Round, 6.0),
        (HeadShape::Flat, 10.0),
        (HeadShape::Flat, 25.0),
        (HeadShape::Filbert, 8.0),
        (HeadShape::Bright, 10.0),
        (HeadShape::Fan, 12.0),
        (HeadShape::Rigger, 2.0),
        (HeadShape::Mop, 20.0),
        (HeadShape::Knife, 15.0),
    ];

    /// Width of a cell below a head of this size. A large head covers enough cells of twice the width.
    fn cell_mm(size_mm: f64) -> f64 {
        if size_mm < 20.0 { 0.2 } else { 0.4 }
    }

    /// How a hand holds a brush and which way it goes, in degrees from x towards y.
    #[derive(Debug, Clone, Copy)]
    struct Hand {
        lean_deg: f64,
        towards_deg: f64,
        heading_deg: f64,
        pressure: f64,
    }

    /// The mark of a straight stroke over a plane. The broad side of the head lies across the
    /// stroke.
    #[derive(Debug, Clone, Copy)]
    struct Mark {
        width_mm: f64,
        /// Distance from the path of the pen to the middle of the mark.
        offset_mm: f64,
        /// Distance from the middle of the contact to the pen, along the path.
        behind_mm: f64,
        /// Largest distance along the path from the middle of a contact to the pen.
        farthest_mm: f64,
        /// Standard deviation of the contact's area over its mean.
        unsteadiness: f64,
    }

    /// Whether a dry head touches the bare plane.
    fn touches(rates: &ExchangeRates, touch: &Touch) -> bool {
        penetration(rates, *touch, (0, 0), 0, coat(rates, *touch, 0)) != NO_CONTACT
    }

    fn mark(shape: HeadShape, size_mm: f64, hand: Hand) -> Mark {
        let cell_mm = cell_mm(size_mm);
        let mut head = Head::new(shape, size_mm, cell_mm).unwrap();
        let relief = Relief::flat(BOUNDS.width, BOUNDS.height, cell_mm);
        let mut contact = Contact::default();
        let (sin, cos) = hand.heading_deg.to_radians().sin_cos();
        let steep = hand.lean_deg.to_radians().tan();
        let (towards_y, towards_x) = hand.towards_deg.to_radians().sin_cos();
        let pose = |step: u32| {
            let way = f64::from(step) - f64::from(WAY.0) * 0.5;
            Pose {
                x: 300.3 + cos * way,
                y: 300.4 + sin * way,
                pressure: hand.pressure,
                tilt_x_deg: (steep * towards_x).atan().to_degrees(),
                tilt_y_deg: (steep * towards_y).atan().to_degrees(),
                twist_deg: hand.heading_deg + 90.0,
                speed_mm_s: 0.0,
            }
        };
        head.set_down(&pose(0), (cos, sin), &relief);
        let mut left = f64::INFINITY;
        let mut right = f64::NEG_INFINITY;
        let mut behind = Vec::new();
        let mut areas = Vec::new();
        for step in 0..=WAY.0 {
            let pose = pose(step);
            head.advance(&pose, &relief, BOUNDS, &mut contact);
            if step < WAY.1 {
                continue;
            }
            let mut along = 0.0;
            let mut count = 0.0;
            for (i, touch) in contact.touches.iter().enumerate() {
                if touches(&contact.rates, touch) {
                    let x = (contact.rect.x + i % contact.rect.width) as f64 + 0.5 - pose.x;
                    let y = (contact.rect.y + i / contact.rect.width) as f64 + 0.5 - pose.y;
                    let across = y * cos - x * sin;
                    (left, right) = (left.min(across), right.max(across));
                    along += x * cos + y * sin;
                    count += 1.0;
                }
            }
            behind.push(-along / count * cell_mm);
            areas.push(count);
        }
        let area = mean(&areas);
        let spread =
            mean(&areas.iter().map(|a| (a - area) * (a - area)).collect::<Vec<_>>()).sqrt();
        Mark {
            width_mm: (right - left + 1.0) * cell_mm,
            offset_mm: 0.5 * (left + right) * cell_mm,
            behind_mm: mean(&behind),
            farthest_mm: behind.iter().fold(0.0, |most, b| b.abs().max(most)),
            unsteadiness: spread / area,
        }
    }

    fn mean(of: &[f64]) -> f64 {
        of.iter().sum::<f64>() / of.len() as f64
    }

    /// Worst figures of the marks of `hand` over evenly spread directions of its lean: the least and
    /// the greatest width, and of each other figure the value farthest from 0.
    fn worst(shape: HeadShape, size_mm: f64, hand: Hand, directions: u32) -> [f64; 6] {
        let mut worst = [f64::INFINITY, 0.0, 0.0, 0.0, 0.0, 0.0];
        for direction in 0..directions {
            let towards_deg = 360.0 * f64::from(direction) / f64::from(directions);
            let hand = Hand { towards_deg, ..hand };
            let found = mark(shape, size_mm, hand);
            worst[0] = worst[0].min(found.width_mm);
            worst[1] = worst[1].max(found.width_mm);
            let others = [found.offset_mm, found.behind_mm, found.farthest_mm, found.unsteadiness];
            for (worst, found) in worst[2..].iter_mut().zip(others) {
                *worst = if found.abs() > worst.abs() || found.is_nan() { found } else { *worst };
            }
        }
        worst
    }

    #[test]
    fn a_leaning_hand_paints_with_the_whole_head_at_the_pen() {
        println!("head      size lean   width (mm)    offset  behind (most)  unsteady");
        let mut outside = Vec::new();
        for (shape, size_mm) in HEADS {
            let mut upright_mm = 0.0;
            let rows = HEADINGS_AND_LEANS_DEG.into_iter().flat_map(|(heading_deg, leans)| {
                leans.map(|(lean_deg, directions)| (heading_deg, lean_deg, directions))
            });
            for (heading_deg, lean_deg, directions) in rows {
                let hand = Hand { lean_deg, towards_deg: 0.0, heading_deg, pressure: 0.5 };
                let found = worst(shape, size_mm, hand, directions);
                let [least, most, offset, behind, farthest, unsteady] = found;
                if lean_deg == 0.0 {
                    upright_mm = most;
                }
                let line = format!(
                    "{:8} {size_mm:5.1} {lean_deg:4.0}  {least:5.1} .. {most:5.1}  {offset:6.2}  \
                 {behind:6.2} ({farthest:5.2})  {unsteady:.3}",
                    shape.name()
                );
                println!("{line}");
                let wide = [size_mm, upright_mm]
                    .into_iter()
                    .all(|of_mm| least >= 0.85 * of_mm && most <= 1.15 * of_mm);
                let there = offset.abs() < 1.0 && farthest < 1.0;
                // The tufts of a fan wander.
                let steady = if shape == HeadShape::Fan { 0.15 } else { 0.03 };
                if !(wide && there && unsteady < steady) {
                    outside.push(line);
                }
            }
        }
        assert!(outside.is_empty(), "{}", outside.join("\n"));
    }

    #[test]
    fn a_firmer_hand_paints_wider() {
        for (shape, size_mm) in HEADS {
            let mut before = 0.0;
            for pressure in [0.1, 0.3, 0.5, 0.7, 0.9] {
                let hand = Hand { lean_deg: 20.0, towards_deg: 45.0, heading_deg: 0.0, pressure };
                let width_mm = mark(shape, size_mm, hand).width_mm;
                assert!(width_mm >= before - cell_mm(size_mm), "{shape} at {pressure}: {width_mm}");
                before = width_mm;
            }
        }
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
            let cells = &marks[2].cells;
            let columns = [0, width - 1].into_iter().all(|x| (0..height).any(|y| cells[(x, y)]));
            let rows = [0, height - 1].into_iter().all(|y| (0..width).any(|x| cells[(x, y)]));
            assert!(columns && rows, "{shape}");
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
