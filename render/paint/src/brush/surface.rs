//! The surface of a head: a control net around the spines, its limit surface as a grid of facets,
//! and a mesh for drawing.
//!
//! The net runs closed around the head, open at the ferrule and closed at the tip. Over a regular
//! net the limit of Catmull-Clark subdivision (1978) is the uniform bicubic B-spline, so we
//! evaluate this directly.

use graphics::lanes::lesser;

use super::NODES;
use super::spines::{FLATTENED, Grip, Spines, Vector, b_spline};

/// Number of paint cells of a facet along the head and around it, if the head has enough cells.
/// The head bends along its hair, so its facets are shorter there.
const ALONG: f32 = 4.0;
const AROUND: f32 = 6.0;

/// Maximum lengths of spans along the head and around it, in paint cells, for facets of [`ALONG`]
/// and [`AROUND`] cells. Longer spans have longer facets. For example, a round brush of 60 cells
/// has spans of these lengths.
const SPAN_ALONG: f32 = 30.0;
const SPAN_AROUND: f32 = 24.0;

/// Maximum number of paint cells of a head. On a larger head they are wider than the cells of
/// the canvas.
const MOST_CELLS: f32 = 1_048_576.0;

/// Number of spans of the surface along the head.
pub(super) const SPANS: usize = ROWS - 3;

/// Division of a span, along or around, into facets.
#[derive(Debug, Clone)]
struct Span {
    facets: usize,
    /// Number of paint cells of each facet.
    cells: usize,
    /// Weights of the four control points at the start of each facet and at the end of the span.
    weights: Vec<[f32; 4]>,
}

impl Span {
    /// Facets of a span of `length` paint cells, each of about `facet` cells. On a span longer than
    /// `usual`, facets grow with the square root of its length. This is enough, because a larger
    /// head bends less and its facets stay as near to its surface.
    fn new(length: f32, facet: f32, usual: f32) -> Self {
        let facet = (facet * (length / usual).max(1.0).sqrt()).round();
        let facets = (length / facet).round().max(1.0);
        let cells = (length / facets).round().clamp(1.0, facet);
        let weights = (0..=facets as usize).map(|i| b_spline(i as f32 / facets)).collect();
        Self { facets: facets as usize, cells: cells as usize, weights }
    }
}

/// Surface of a head. Vertices row by row from the ferrule.
#[derive(Debug, Clone)]
pub(super) struct LimitSurface {
    around: Span,
    along: Span,
    columns: usize,
    /// Positions and displacements of vertices. Valid where [`LimitSurface::is_near`].
    pub(super) vertices: Vec<Point>,
    near: Vec<bool>,
    /// The net evaluated along the head but not around it.
    line: Vec<Point>,
}

impl LimitSurface {
    /// Surface of a net of `columns` columns around a head of this perimeter and length, in
    /// cells of the canvas.
    pub(super) fn new(columns: usize, perimeter: f32, length: f32) -> Self {
        let cell = (perimeter * length / MOST_CELLS).sqrt().max(1.0);
        let around = Span::new(perimeter / columns as f32 / cell, AROUND, SPAN_AROUND);
        let along = Span::new(length / SPANS as f32 / cell, ALONG, SPAN_ALONG);
        let vertices = (SPANS * along.facets + 1) * columns * around.facets;
        Self {
            columns,
            vertices: vec![[0.0; 8]; vertices],
            near: vec![false; SPANS * columns],
            line: vec![[0.0; 8]; columns],
            around,
            along,
        }
    }

    /// Number of facets around and along.
    pub(super) fn facets(&self) -> (usize, usize) {
        (self.columns * self.around.facets, SPANS * self.along.facets)
    }

    /// Number of paint cells of each facet, around and along.
    pub(super) fn cells_of_facet(&self) -> (usize, usize) {
        (self.around.cells, self.along.cells)
    }

    /// Number of paint cells of the head, around and along.
    pub(super) fn cells(&self) -> (usize, usize) {
        let facets = self.facets();
        let cells = self.cells_of_facet();
        (facets.0 * cells.0, facets.1 * cells.1)
    }

    /// Whether a facet may reach below the ceiling of the last evaluation.
    #[inline]
    pub(super) fn is_near(&self, column: usize, row: usize) -> bool {
        self.near[row / self.along.facets * self.columns + column / self.around.facets]
    }

    /// Number of facets of each span around the head. [`LimitSurface::is_near`] is the same for
    /// all facets of a span.
    pub(super) fn facets_of_span(&self) -> usize {
        self.around.facets
    }

    /// Evaluates the surface where it may reach below `ceiling`, and passes each vertex with
    /// its row to `finish`.
    #[inline(always)]
    pub(super) fn evaluate(
        &mut self,
        net: &Net,
        ceiling: f32,
        mut finish: impl FnMut(usize, &mut Point),
    ) {
        self.find_near(net, ceiling);
        let columns = self.columns;
        let width = columns * self.around.facets;
        for row in 0..=SPANS * self.along.facets {
            let span = (row / self.along.facets).min(SPANS - 1);
            let step = row - span * self.along.facets;
            // A row between two spans belongs to both.
            let other = if step == 0 { span.saturating_sub(1) } else { span };
            let near = |c: usize| self.near[span * columns + c] || self.near[other * columns + c];
            if !(0..columns).any(near) {
                continue;
            }
            let weights = &self.along.weights[step];
            for (column, point) in self.line.iter_mut().enumerate() {
                let control = |i: usize| &net.points[(span + i) * columns + column];
                *point = combined(weights, control(0), control(1), control(2), control(3));
            }
            for column in 0..columns {
                let before = if column == 0 { columns - 1 } else { column - 1 };
                let count = match (near(column), near(before)) {
                    (true, _) => self.around.facets,
                    (false, true) => 1,
                    (false, false) => continue,
                };
                let after =
                    |i: usize| if column + i < columns { column + i } else { column + i - columns };
                let line = [before, column, after(1), after(2)].map(|i| self.line[i]);
                let vertices =
                    &mut self.vertices[row * width + column * self.around.facets..][..count];
                for (vertex, weights) in vertices.iter_mut().zip(&self.around.weights) {
                    *vertex = combined(weights, &line[0], &line[1], &line[2], &line[3]);
                    finish(row, vertex);
                }
            }
        }
    }

    fn find_near(&mut self, net: &Net, ceiling: f32) {
        for span in 0..SPANS {
            // The lowest of four control points along, then the lowest of four of these around.
            for column in 0..self.columns {
                let lowest = (0..4).map(|i| net.points[(span + i) * self.columns + column][2]);
                self.line[column][2] = lowest.fold(f32::INFINITY, lesser);
            }
            for column in 0..self.columns {
                let around =
                    (0..4).map(|i| self.line[(column + self.columns - 1 + i) % self.columns][2]);
                self.near[span * self.columns + column] =
                    around.fold(f32::INFINITY, lesser) < ceiling;
            }
        }
    }
}

#[inline(always)]
fn combined(weights: &[f32; 4], a: &Point, b: &Point, c: &Point, d: &Point) -> Point {
    let mut sum = [0.0; 8];
    for i in 0..8 {
        sum[i] = weights[0] * a[i] + weights[1] * b[i] + weights[2] * c[i] + weights[3] * d[i];
    }
    sum
}

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
    /// Cosine and sine of the columns around a single spine. We enlarge them because a B-spline
    /// stays inside its control polygon.
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

    /// Places the net around `spines`. The displacements are the changes since the last call.
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
            // The row beyond the tip is the row before it with opposite columns exchanged, which
            // closes the end bluntly. This would draw the end inwards. `last` moves it back to
            // `ends`.
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
    /// Horizontal and upward vectors across the section. `None` where the head is vertical.
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

/// Number of vertices for each span of the surface along the head.
const VERTICES_A_SPAN: usize = 3;

/// Minimum number of vertices around a head.
const VERTICES_AROUND: usize = 24;

/// Surface of a head over the canvas: rows of vertices around it, from the ferrule to the tip.
#[derive(Debug, Clone, PartialEq)]
pub struct HeadMesh {
    /// Number of vertices around the head. The last is next to the first.
    pub around: usize,
    /// Number of rows, from the open ferrule to the closed tip.
    pub along: usize,
    /// `around * along` vertices: x and y in cells of the canvas, height over its plane in
    /// cells. Where hair is pressed into the canvas they lie slightly below it.
    pub vertices: Vec<[f32; 3]>,
}

impl HeadMesh {
    /// Mesh of the surface of `net`, whose coordinates start at the cell `origin`: 300 to 600
    /// vertices.
    pub(super) fn of(net: &Net, origin: (i64, i64)) -> Self {
        let steps = VERTICES_AROUND.div_ceil(net.columns);
        let weights: Vec<_> = (0..steps).map(|i| b_spline(i as f32 / steps as f32)).collect();
        let around = net.columns * steps;
        let along = SPANS * VERTICES_A_SPAN + 1;
        let mut vertices = Vec::with_capacity(around * along);
        let mut line = vec![[0.0; 3]; net.columns];
        for row in 0..along {
            let span = (row / VERTICES_A_SPAN).min(SPANS - 1);
            let here = b_spline((row - span * VERTICES_A_SPAN) as f32 / VERTICES_A_SPAN as f32);
            for (column, point) in line.iter_mut().enumerate() {
                *point = blended(
                    here,
                    std::array::from_fn(|i: usize| {
                        first(&net.points[(span + i) * net.columns + column])
                    }),
                );
            }
            for column in 0..net.columns {
                let four = std::array::from_fn(|i: usize| {
                    line[(column + net.columns - 1 + i) % net.columns]
                });
                vertices.extend(weights.iter().map(|weights| {
                    let [x, y, z] = blended(*weights, four);
                    [x + origin.0 as f32, y + origin.1 as f32, z]
                }));
            }
        }
        Self { around, along, vertices }
    }
}

fn first(&[x, y, z, ..]: &Point) -> [f32; 3] {
    [x, y, z]
}

fn blended(weights: [f32; 4], points: [[f32; 3]; 4]) -> [f32; 3] {
    std::array::from_fn(|i| weights.iter().zip(&points).map(|(w, point)| w * point[i]).sum())
}

#[cfg(test)]
mod tests {
    use super::super::{Head, HeadShape, Relief};
    use super::*;
    use crate::contact::Contact;
    use crate::pose::Pose;
    use graphics::tile::Rect;

    #[test]
    fn weights_sum_to_one_and_reproduce_a_line() {
        for i in 0..=10 {
            let t = i as f32 / 10.0;
            let w = b_spline(t);
            let line: f32 = w.iter().zip([-1.0, 0.0, 1.0, 2.0]).map(|(w, x)| w * x).sum();
            assert!((w.iter().sum::<f32>() - 1.0).abs() < 1e-6, "{t}: {w:?}");
            assert!((line - t).abs() < 1e-6, "{t}: {line}");
        }
    }

    #[test]
    fn facets_have_about_as_many_cells_as_asked_for_and_large_heads_wider_ones() {
        for length in 8..200 {
            let span = Span::new(length as f32, 6.0, 200.0);
            let cell = length as f32 / (span.facets * span.cells) as f32;
            assert!((4..=6).contains(&span.cells), "{length}: {span:?}");
            assert!((0.8..1.5).contains(&cell), "{length}: {cell}");
        }
        let of_a_long_span = Span::new(96.0, AROUND, SPAN_AROUND);
        assert_eq!((of_a_long_span.facets, of_a_long_span.cells), (8, 12), "twice as long");
        let large = LimitSurface::new(8, 6000.0, 5000.0);
        let around = large.facets();
        let along = large.cells_of_facet();
        let cells = around.0 * along.0 * around.1 * along.1;
        assert!(cells < 1_100_000, "{cells}");
    }

    const POSE: Pose = Pose {
        x: 150.4,
        y: 100.2,
        pressure: 0.6,
        tilt_x_deg: 20.0,
        tilt_y_deg: 0.0,
        twist_deg: 90.0,
        speed_mm_s: 0.0,
    };

    const BOUNDS: Rect = Rect { x: 0, y: 0, width: 400, height: 300 };

    /// Extent along x, y and height in cells.
    fn extent(vertices: &[[f32; 3]]) -> [(f32, f32); 3] {
        std::array::from_fn(|i| {
            let of = vertices.iter().map(|vertex| vertex[i]);
            (of.clone().fold(f32::INFINITY, f32::min), of.fold(f32::NEG_INFINITY, f32::max))
        })
    }

    #[test]
    fn a_hovering_head_stands_over_its_place_and_touches_nothing() {
        let relief = Relief::flat(400, 300, 0.1);
        for shape in HeadShape::ALL {
            let mut head = Head::new(shape, 4.0, 0.1).unwrap();
            assert_eq!(head.mesh(), None, "{shape} was never seen");
            head.hover(&Pose { tilt_x_deg: 0.0, ..POSE }, &relief);
            let mesh = head.mesh().unwrap();
            assert_eq!(mesh.vertices.len(), mesh.around * mesh.along, "{shape}");
            assert!((200..=600).contains(&mesh.vertices.len()), "{shape}: {}", mesh.vertices.len());
            let [x, y, height] = extent(&mesh.vertices);
            assert!((-0.5..2.5).contains(&height.0), "{shape}: {height:?}");
            assert!(height.1 > 10.0, "{shape}: {height:?}");
            // The tip is where the pen points.
            let tip = &mesh.vertices[mesh.around * (mesh.along - 1)..];
            let [tip_x, tip_y, _] = extent(tip);
            let inside = [(tip_x, POSE.x), (tip_y, POSE.y)]
                .into_iter()
                .all(|((low, high), at)| low - 2.0 <= at as f32 && at as f32 <= high + 2.0);
            assert!(inside, "{shape}: {tip_x:?} {tip_y:?}");
            // 40 cells wide, and turned by 90 degrees.
            if shape != HeadShape::Knife {
                assert!((30.0..52.0).contains(&(y.1 - y.0)), "{shape}: {y:?}");
            }
            assert!(shape == HeadShape::Knife || x.1 - x.0 < 60.0, "{shape}: {x:?}");
        }
    }

    #[test]
    fn a_pressed_head_reaches_the_canvas_where_it_touches() {
        let relief = Relief::flat(400, 300, 0.1);
        for shape in HeadShape::ALL {
            let mut head = Head::new(shape, 4.0, 0.1).unwrap();
            let mut contact = Contact::default();
            head.set_down(&POSE, (1.0, 0.0), &relief);
            let mut pose = POSE;
            for _ in 0..20 {
                pose.x += 1.0;
                head.advance(&pose, &relief, BOUNDS, &mut contact);
            }
            let mesh = head.mesh().unwrap();
            let [x, y, height] = extent(&mesh.vertices);
            // Hair that gives way is drawn below the canvas, by up to half its thickness.
            assert!((-20.0..0.5).contains(&height.0), "{shape}: {height:?}");
            let rect = contact.rect;
            let left = rect.x as f32;
            let right = (rect.x + rect.width) as f32;
            let top = rect.y as f32;
            let bottom = (rect.y + rect.height) as f32;
            assert!(x.0 <= left + 2.0 && x.1 >= right - 2.0, "{shape}: {x:?} over {rect:?}");
            assert!(y.0 <= top + 2.0 && y.1 >= bottom - 2.0, "{shape}: {y:?} over {rect:?}");
            head.lift();
            assert_eq!(head.mesh(), None, "{shape} is lifted");
        }
    }

    #[test]
    fn hovering_before_a_stroke_leaves_no_trace_in_it() {
        let relief = Relief::flat(400, 300, 0.1);
        let [after_hovering, alone] = [true, false].map(|hovers| {
            let mut head = Head::new(HeadShape::Filbert, 4.0, 0.1).unwrap();
            if hovers {
                head.hover(&Pose { x: 20.0, twist_deg: 10.0, ..POSE }, &relief);
            }
            head.set_down(&POSE, (1.0, 0.0), &relief);
            let mut contact = Contact::default();
            head.advance(&Pose { x: POSE.x + 1.0, ..POSE }, &relief, BOUNDS, &mut contact);
            contact
        });
        assert!(after_hovering == alone, "another stroke");
    }
}
