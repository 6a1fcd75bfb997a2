//! Control net around the spines: closed around the head, open at the ferrule, closed at the
//! tip.

use super::grip::Grip;
use super::hair::FLATTENED;
use super::shape::NODES;
use super::spines::Spines;
use super::vector::Vector;

/// Number of rows of the net: one for each level of the spines, and one beyond either end so
/// that the surface starts and ends where the spines do.
pub(super) const ROWS: usize = NODES + 2;

/// Number of columns around a head with a single spine.
const AROUND_ONE: usize = 8;

/// A control point and its displacement in the last sub-step: x, y, z, 0, dx, dy, dz, 0.
pub(super) type Point = [f32; 8];

/// Number of columns of the net around `spines` spines.
pub(super) fn columns(spines: usize) -> usize {
    if spines == 1 { AROUND_ONE } else { 2 * spines + 2 }
}

/// Control net of the surface of a head.
#[derive(Debug, Clone)]
pub(super) struct Net {
    pub(super) columns: usize,
    /// Points row by row from the ferrule.
    pub(super) points: Vec<Point>,
    /// Cosine and sine of the columns around a single spine, enlarged because a B-spline stays
    /// inside its control polygon.
    circle: [(f32, f32); AROUND_ONE],
    single: bool,
    /// End of the surface in each column, at the tip.
    ends: Vec<Vector>,
}

impl Net {
    pub(super) fn new(spines: &Spines) -> Self {
        let columns = columns(spines.of.spines);
        let step = std::f32::consts::TAU / AROUND_ONE as f32;
        let inside = (2.0 + libm::cosf(step)) / 3.0;
        let circle = std::array::from_fn(|i| {
            let (sin, cos) = libm::sincosf(step * i as f32);
            (cos / inside, sin / inside)
        });
        Self {
            columns,
            points: vec![[0.0; 8]; ROWS * columns],
            circle,
            single: spines.of.spines == 1,
            ends: vec![Vector::ZERO; columns],
        }
    }

    /// Moves the origin of coordinates by whole cells.
    pub(super) fn rebase(&mut self, moved: Vector) {
        for point in &mut self.points {
            point[0] -= moved.x;
            point[1] -= moved.y;
        }
    }

    /// Places the net around `spines`; the displacements are the changes since the last call.
    pub(super) fn follow(&mut self, spines: &Spines, grip: &Grip) {
        for level in 0..NODES {
            let ring = Ring::new(spines, grip, level);
            for column in 0..self.columns {
                let place = ring.place(spines, level, column, &self.circle);
                if level + 1 < NODES {
                    self.set(level + 1, column, place);
                } else {
                    self.ends[column] = place;
                }
            }
        }
        let tip = NODES;
        let end = self.columns;
        for column in 0..end {
            let at = |row: usize, column: usize| {
                let p = self.points[row * end + column];
                Vector::new(p[0], p[1], p[2])
            };
            let first = at(1, column) * 2.0 - at(2, column);
            // The row beyond the tip is the row before it with opposite columns
            // exchanged, which closes the end bluntly. That would draw the end
            // inwards; `last` moves it back to `ends`.
            let here = at(tip - 1, column);
            let there = at(tip - 1, self.opposite(column));
            let last = self.ends[column] * 1.5 - (here + there) * 0.25;
            self.set(0, column, first);
            self.set(tip, column, last);
            self.set(tip + 1, column, there);
        }
    }

    /// Column on the opposite side of the head.
    fn opposite(&self, column: usize) -> usize {
        let half = if self.single { AROUND_ONE / 2 + column } else { self.columns - column };
        half % self.columns
    }

    /// Sets all displacements to 0.
    pub(super) fn rest(&mut self) {
        for point in &mut self.points {
            point[4..].fill(0.0);
        }
    }

    fn set(&mut self, row: usize, column: usize, to: Vector) {
        let point = &mut self.points[row * self.columns + column];
        let [x, y, z, ..] = *point;
        *point = [to.x, to.y, to.z, 0.0, to.x - x, to.y - y, to.z - z, 0.0];
    }
}

/// Cross-section of a head at one level.
struct Ring {
    centre: Vector,
    broad: Vector,
    thin: Vector,
    /// Horizontal and upward vectors across the section; `None` where the head is vertical.
    level: Option<(Vector, Vector)>,
    wider: f32,
    flatter: f32,
}

impl Ring {
    fn new(spines: &Spines, grip: &Grip, level: usize) -> Self {
        let count = spines.of.spines;
        let centre = |level: usize| {
            let sum = (0..count).fold(Vector::ZERO, |sum, k| sum + spines.node(k, level));
            sum * (1.0 / count as f32)
        };
        let above = centre(level.saturating_sub(1));
        let under = centre((level + 1).min(NODES - 1));
        let along = (above - under).unit_or(grip.axis);
        let across = spines.node(count - 1, level) - spines.node(0, level);
        let held = grip.broad.across(along).unit_or(grip.thin);
        let broad = across.across(along).unit_or(held);
        let beside = Vector::UP.cross(along);
        let load = spines.load[level];
        Self {
            centre: centre(level),
            broad,
            thin: along.cross(broad),
            level: (beside.length() > 0.05).then(|| {
                let beside = beside.unit_or(broad);
                (beside, along.cross(beside))
            }),
            wider: spines.of.splay * load,
            flatter: FLATTENED * load,
        }
    }

    fn place(
        &self,
        spines: &Spines,
        level: usize,
        column: usize,
        circle: &[(f32, f32); AROUND_ONE],
    ) -> Vector {
        let count = spines.of.spines;
        let width = spines.of.width[level];
        let half = spines.half_thickness[level];
        let offset = if count == 1 {
            let (cos, sin) = circle[column];
            self.broad * (0.5 * width * spines.width * cos) + self.thin * (half * sin)
        } else {
            // From the right edge over the upper side to the left edge, and back below.
            let (spine, side, beyond) = match column {
                0 => (count - 1, 0.0, 1.0),
                c if c <= count => (count - c, 1.0, 0.0),
                c if c == count + 1 => (0, 0.0, -1.0),
                c => (c - count - 2, -1.0, 0.0),
            };
            let margin = 0.75 * spines.of.thickness * spines.width;
            let across = spines.node(spine, level) - self.centre;
            across + self.broad * (beyond * margin * width) + self.thin * (half * side)
        };
        let Some((beside, upwards)) = self.level else { return self.centre + offset };
        let wider = beside * (offset.dot(beside) * self.wider);
        let flatter = upwards * (offset.dot(upwards) * self.flatter);
        self.centre + offset + wider - flatter
    }
}
