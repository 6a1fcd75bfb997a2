//! Spines of a head are chains of nodes. The canvas bends them. This module also knows how a hand
//! holds them.
//!
//! Hair is light and paint is thick, so a head is in equilibrium in every sub-step. Its shape
//! follows from how you hold it and how it trails. Hair leaves the ferrule along the handle, bends
//! upright towards the canvas, and lies on it from where it reaches it. The pen tows this lying
//! part: its direction follows the tractrix (Huygens 1693), the curve of a body that you drag on a
//! string. Nothing sticks and slips, so an even hand has an even contact.
//!
//! A painter leads the place where hair touches, so we hold a head such that the middle of its
//! contact is at the pen for any lean.
//!
//! Vectors are in cells: x right, y down the canvas, z up from it.

use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

use super::relief::ReliefView;
use super::{NODES, Proportions};
use crate::pose::Pose;

/// Length of the string on which we tow the lying hair, as a fraction of the length of the head.
/// This is about as much as lies at middle pressure.
const TOW: f32 = 0.35;

/// Distance between the lowest hair and the canvas at pressure 0, in cells.
const CLEARANCE: f32 = 0.5;

/// Minimum thickness of a wide head, in cells. A thinner head can pass between cell centres and
/// touch none.
const THINNEST: f32 = 2.0;

/// Minimum distance by which full pressure lowers a head, in mm. A knife is lowered by just
/// this distance.
const LEAST_DEPTH_MM: f32 = 0.6;

/// Spines of one head. Lengths in cells.
#[derive(Debug, Clone)]
pub(super) struct Spines {
    pub(super) of: &'static Proportions,
    pub(super) width: f32,
    cells_per_mm: f32,
    /// Rest position of each node: distances from the ferrule along the axis and across it.
    rest: Vec<(f32, f32)>,
    /// Half the thickness at each level.
    pub(super) half_thickness: [f32; NODES],
    /// Half the width and half the thickness of the surface around one spine at each level.
    section: [(f32, f32); NODES],
    /// Nodes by spine, from the ferrule to the tip.
    pub(super) nodes: Vec<Vector>,
    /// Pressure on each level, 0 to 1.
    pub(super) load: [f32; NODES],
    /// Direction in which hair lies on the canvas. Shorter than 1 while it swings round.
    trail: Vector,
    /// The pen in the last sub-step.
    pen: (f32, f32),
    /// Direction to the ferrule in the last sub-step.
    axis: Vector,
}

impl Spines {
    pub(super) fn new(of: &'static Proportions, width: f32, cell_mm: f64) -> Self {
        let margin = 0.5 * (of.thickness * width);
        let half_thickness = of.depth.map(|d| {
            let half = 0.5 * d * of.thickness * width;
            if d > 0.0 && of.spines > 1 { half.max(0.5 * THINNEST) } else { half }
        });
        let half_breadth =
            if of.spines == 1 { of.width.map(|w| 0.5 * w * width) } else { half_thickness };
        let outermost = if of.spines == 1 { 0.0 } else { 0.5 * width - margin };
        let length = of.length * width;
        let mut rest = Vec::new();
        for spine in 0..of.spines {
            let place = 2.0 * spine as f32 / (of.spines.max(2) - 1) as f32 - 1.0;
            let tip = if of.spines == 1 { 0.0 } else { place * outermost };
            let spread = tip * (1.0 - of.root);
            let along = (length * length - spread * spread).sqrt();
            for node in 0..NODES {
                let share = node as f32 / (NODES - 1) as f32;
                rest.push((along * share, (tip * of.root + spread * share) * of.width[node]));
            }
        }
        Self {
            of,
            width,
            cells_per_mm: 1.0 / cell_mm as f32,
            nodes: vec![Vector::ZERO; rest.len()],
            rest,
            half_thickness,
            section: rounded(half_breadth, half_thickness),
            load: [0.0; NODES],
            trail: Vector::ZERO,
            pen: (0.0, 0.0),
            axis: Vector::UP,
        }
    }

    pub(super) fn length(&self) -> f32 {
        self.of.length * self.width
    }

    pub(super) fn node(&self, spine: usize, level: usize) -> Vector {
        self.nodes[spine * NODES + level]
    }

    /// Moves the origin of coordinates by whole cells.
    pub(super) fn rebase(&mut self, moved: Vector) {
        for node in &mut self.nodes {
            *node -= moved;
        }
        self.pen.0 -= moved.x;
        self.pen.1 -= moved.y;
    }

    /// Holds the head just above the canvas at `grip`, ready to lie opposite to `heading`. If you
    /// pass zero, it lies opposite to the lean of the handle.
    pub(super) fn hang(&mut self, grip: &Grip, heading: Vector, relief: &ReliefView<'_>) {
        self.trail = (-heading).unit_or(grip.falls_to());
        self.settle(&Grip { pressure: 0.0, ..*grip }, relief);
    }

    /// Holds the straight head just above the canvas at `grip`.
    pub(super) fn hold_above(&mut self, grip: &Grip, relief: &ReliefView<'_>) {
        self.trail = Vector::ZERO;
        self.settle(&Grip { pressure: 0.0, ..*grip }, relief);
    }

    /// Presses the head down to `grip` without dragging it.
    pub(super) fn lower(&mut self, grip: &Grip, relief: &ReliefView<'_>) {
        self.settle(grip, relief);
    }

    /// Whether the blade turns over to its other side at `grip`.
    pub(super) fn turns_over(&self, grip: &Grip) -> bool {
        self.of.rigid && self.axis.dot(grip.axis) < 0.0
    }

    /// Advances one sub-step, in which the pen moved to `grip`.
    pub(super) fn advance(&mut self, grip: &Grip, relief: &ReliefView<'_>) {
        let moved = Vector::new(grip.tip.0 - self.pen.0, grip.tip.1 - self.pen.1, 0.0);
        let trail = self.trail - moved * (1.0 / (TOW * self.length()));
        self.trail = if trail.length() > 1.0 { trail.unit_or(trail) } else { trail };
        self.settle(grip, relief);
    }

    /// Distance in cells by which hair is pressed below the crests of the relief at `pressure`.
    pub(super) fn sink(&self, pressure: f32) -> f32 {
        sink_mm(pressure) * self.cells_per_mm
    }

    fn least_depth(&self, pressure: f32) -> f32 {
        LEAST_DEPTH_MM * self.cells_per_mm * pressure
    }

    /// Height of the canvas below the pen.
    fn ride(&self, grip: &Grip, relief: &ReliefView<'_>) -> f32 {
        let third = grip.broad * (self.width / 3.0);
        let (x, y) = grip.tip;
        (relief.height(x, y)
            + relief.height(x + third.x, y + third.y)
            + relief.height(x - third.x, y - third.y))
            / 3.0
    }

    fn settle(&mut self, grip: &Grip, relief: &ReliefView<'_>) {
        (self.pen, self.axis) = (grip.tip, grip.axis);
        let pen = Vector::new(grip.tip.0, grip.tip.1, 0.0);
        let ride = self.ride(grip, relief);
        if self.of.rigid {
            self.press_blade(grip, pen + Vector::UP * ride);
            return;
        }
        let hair = Hair {
            trail: self.trail,
            axis: grip.axis,
            broad: grip.broad,
            pressure: grip.pressure,
            section: &self.section,
            length: self.length(),
            sink: self.sink(grip.pressure),
        };
        let low = hair.lowest();
        let pressed = hair.drop(1.0) - hair.drop(1.0 - self.of.give * grip.pressure);
        let high = CLEARANCE + low - pressed.max(self.least_depth(grip.pressure));
        let middle = hair.middle(high, &self.of.width);
        let ferrule = pen - middle + Vector::UP * (ride + high);
        let mut pressed = [0.0; NODES];
        for (nodes, rest) in self.nodes.chunks_mut(NODES).zip(self.rest.chunks(NODES)) {
            let Laid { places, lying } = hair.laid(ferrule, rest, |x, y| relief.height(x, y));
            nodes.copy_from_slice(&places);
            for (pressed, lying) in pressed.iter_mut().zip(lying) {
                *pressed += grip.pressure * lying / self.of.spines as f32;
            }
        }
        self.load = std::array::from_fn(|level| {
            let above = pressed[level.saturating_sub(1)];
            let under = pressed[(level + 1).min(NODES - 1)];
            0.25 * above + 0.5 * pressed[level] + 0.25 * under
        });
    }

    /// Presses the edge of a blade below the canvas at `pen`.
    fn press_blade(&mut self, grip: &Grip, pen: Vector) {
        let depth = self.least_depth(grip.pressure) - CLEARANCE;
        let covered = (depth.max(0.0) / grip.axis.z).min(self.length());
        let level = Vector::new(grip.axis.x, grip.axis.y, 0.0);
        let ferrule =
            pen - level * (0.5 * covered) - Vector::UP * depth + grip.axis * self.length();
        for (node, &(along, across)) in self.nodes.iter_mut().zip(&self.rest) {
            *node = ferrule - grip.axis * along + grip.broad * across;
        }
    }
}

/// Profiles smoothed as the B-spline surface smooths them.
fn rounded(breadth: [f32; NODES], thickness: [f32; NODES]) -> [(f32, f32); NODES] {
    std::array::from_fn(|i| (smoothed_at(&breadth, i), smoothed_at(&thickness, i)))
}

fn smoothed_at(of: &[f32; NODES], i: usize) -> f32 {
    match i {
        0 => of[0],
        i if i + 1 == NODES => of[i],
        i => (of[i - 1] + 4.0 * of[i] + of[i + 1]) / 6.0,
    }
}

/// Fraction of its thickness that a head loses under full pressure (chosen by eye).
pub(super) const FLATTENED: f32 = 0.5;

/// Fraction of its thickness by which lying hair gives way to the canvas (chosen by eye).
const PRESSED: f32 = 0.6;

/// How far pressed hair bends towards its trail before it reaches the canvas (chosen by eye).
const ARC: f32 = 0.8;

/// Position of the contact within slanting hair, from the core of the hair (0) to the side that
/// faces the canvas (1). We fitted this to the contacts of all shapes.
const INWARDS: f32 = 0.7;

/// Number of points of a segment at which we look for contact.
const LOOKS: usize = 4;

/// Distance in mm by which hair is pressed below the crests of the relief at `pressure` (chosen
/// by eye).
pub(super) fn sink_mm(pressure: f32) -> f32 {
    0.01 + 0.24 * pressure
}

/// Hair of a head, without its position. Lengths are in cells.
pub(super) struct Hair<'a> {
    /// Horizontal direction in which hair lies, at most 1 long.
    pub(super) trail: Vector,
    /// Unit vector from the tip to the ferrule.
    pub(super) axis: Vector,
    /// Unit vector along the broad side.
    pub(super) broad: Vector,
    pub(super) pressure: f32,
    /// Half the width and half the thickness around a spine at each level.
    pub(super) section: &'a [(f32, f32); NODES],
    /// Length from the ferrule to the tip.
    pub(super) length: f32,
    /// Distance by which hair is pressed below the crests of the relief.
    pub(super) sink: f32,
}

/// A spine on the canvas, from the ferrule to the tip.
pub(super) struct Laid {
    pub(super) places: [Vector; NODES],
    /// How flat hair lies at each level, from 0 (it does not touch) to 1.
    pub(super) lying: [f32; NODES],
}

impl Hair<'_> {
    /// Direction of the segment that ends at `level`. `arc` says how far the hair bends towards its
    /// trail, for example 0 for unpressed hair.
    fn direction(&self, level: usize, arc: f32) -> Vector {
        let share = (level as f32 - 0.5) / (NODES - 1) as f32;
        let upright = self.axis * (share - 1.0) - Vector::UP * share;
        (upright + self.trail * (arc * share * share)).unit_or(-Vector::UP)
    }

    /// Distance from the ferrule down to the lowest point of unpressed hair.
    pub(super) fn lowest(&self) -> f32 {
        let segment = self.length / (NODES - 1) as f32;
        let mut down = 0.0;
        let mut lowest = 0.0_f32;
        for level in 1..NODES {
            let along = -self.direction(level, 0.0);
            down += segment * along.z;
            let broad = self.broad.across(along).unit_or(self.broad);
            let a = self.section[level].0 * broad.z;
            let b = self.section[level].1 * along.cross(broad).z;
            lowest = lowest.max(down + (a * a + b * b).sqrt());
        }
        lowest
    }

    /// Distance from the ferrule down to the point at `share` of the length of unpressed hair.
    pub(super) fn drop(&self, share: f32) -> f32 {
        let segment = self.length / (NODES - 1) as f32;
        (1..NODES)
            .map(|level: usize| {
                let part = (share * (NODES - 1) as f32 - (level - 1) as f32).clamp(0.0, 1.0);
                -self.direction(level, 0.0).z * part * segment
            })
            .sum()
    }

    /// Lays a spine from `ferrule` over the heights `floor`. `rest` are the distances of its nodes
    /// along the axis and across it.
    pub(super) fn laid(
        &self,
        ferrule: Vector,
        rest: &[(f32, f32)],
        floor: impl Fn(f32, f32) -> f32,
    ) -> Laid {
        let dig = 2.0 * self.sink;
        let mut lying = [0.0; NODES];
        let mut places = [ferrule + self.broad * rest[0].1; NODES];
        let mut at = ferrule;
        for level in 1..NODES {
            let segment = rest[level].0 - rest[level - 1].0;
            let way = self.direction(level, ARC * self.pressure) * segment;
            let beside = self.broad * rest[level].1;
            let mut next = at + way;
            let under = floor(next.x + beside.x, next.y + beside.y);
            // Hair lies flat once it would reach half a segment below the canvas.
            let flat = ((under - dig - next.z) * (2.0 / segment)).clamp(0.0, 1.0);
            let thick = self.section[level].1 * (1.0 - FLATTENED * self.pressure * flat);
            let held = under - dig + flat * (thick - (PRESSED * thick - dig).max(0.0));
            if next.z < held {
                let fall = held - at.z;
                let reach = (segment * segment - fall * fall).max(0.0).sqrt();
                let level_way = Vector::new(way.x, way.y, 0.0);
                next = at + level_way + (self.trail * reach - level_way) * flat;
                next.z = held;
            }
            lying[level] = flat;
            places[level] = next + beside;
            at = next;
        }
        Laid { places, lying }
    }

    /// Horizontal offset from the ferrule, which is `high` above a plane, to the middle of the
    /// contact of a head. `width` is the width of the head along the hair. If the head does not
    /// touch, this is the offset to its tip.
    pub(super) fn middle(&self, high: f32, width: &[f32; NODES]) -> Vector {
        let rest = std::array::from_fn::<_, NODES, _>(|level| {
            (self.length * level as f32 / (NODES - 1) as f32, 0.0)
        });
        let Laid { places, lying } = self.laid(Vector::UP * high, &rest, |_, _| 0.0);
        let mut sum = Vector::ZERO;
        let mut whole = 0.0;
        let mut last = places[0] + self.axis;
        // With a place before the first and one beyond the last.
        let mut extended = [places[0] * 2.0 - places[1]; NODES + 2];
        extended[1..=NODES].copy_from_slice(&places);
        extended[NODES + 1] = places[NODES - 1] * 2.0 - places[NODES - 2];
        for look in 0..=(NODES - 1) * LOOKS {
            let level = (look / LOOKS).min(NODES - 2);
            let share = look as f32 / LOOKS as f32 - level as f32;
            let weights = b_spline(share);
            let core = (0..4).fold(Vector::ZERO, |sum, i| sum + extended[level + i] * weights[i]);
            let along = (last - core).unit_or(self.axis);
            last = core;
            let flat = between(lying[level], lying[level + 1], share);
            let thick = between(self.section[level].1, self.section[level + 1].1, share)
                * (1.0 - FLATTENED * self.pressure * flat);
            // The side that faces the canvas, at right angles to the hair.
            let side = (along * along.z - Vector::UP).unit_or(Vector::ZERO);
            let place = core + side * (INWARDS * thick);
            let under = core.z + side.z * thick;
            let pressed = (-under / thick.max(0.5)).clamp(0.0, 1.0);
            let chord = (pressed * (2.0 - pressed)).sqrt();
            let weight = chord * between(width[level], width[level + 1], share);
            sum += place * weight;
            whole += weight;
        }

        fn between(a: f32, b: f32, share: f32) -> f32 {
            a + (b - a) * share
        }
        let middle = if whole > 0.0 { sum * (1.0 / whole) } else { places[NODES - 1] };
        Vector::new(middle.x, middle.y, 0.0)
    }
}

/// Largest angle of a handle from upright, in degrees. Beyond it the ferrule would touch
/// the canvas.
const FARTHEST_LEAN_DEG: f64 = 80.0;

/// If a handle leans across a blade by more than this (as the sine of the angle), the blade is
/// turned over to that side. Below this the twist decides.
const OTHER_SIDE: f32 = 0.17;

/// Angle in degrees between the blade of a knife and the canvas, at pressure 0 and at full
/// pressure (chosen by eye).
const BLADE_DEG: (f64, f64) = (25.0, 8.0);

/// Number of steps per cell to which we round positions. So if you shift a stroke by whole cells,
/// you get the same contacts.
const STEPS_PER_CELL: f64 = 65536.0;

/// Largest distance from the origin in cells. We clip positions beyond this.
const FARTHEST: f64 = 1e9;

/// Axes of a head at a pose. Lengths are in cells from `origin`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grip {
    /// The cell that contains the pose's position: origin of all coordinates of the head.
    pub(super) origin: (i64, i64),
    /// The pose's position within the cell `origin`, 0 to 1 along x and y.
    pub(super) tip: (f32, f32),
    /// Unit vector from the tip to the ferrule.
    pub(super) axis: Vector,
    /// Unit vector across the head along its broad side.
    pub(super) broad: Vector,
    /// Unit vector across the head along its thin side.
    pub(super) thin: Vector,
    pub(super) pressure: f32,
}

impl Grip {
    /// Axes of a head of these proportions at `pose`. If a number is not finite or the pressure is
    /// 0, you get `None`. A wide head or a blade lies level along its broad side, because it would
    /// stand on a corner if it leaned that way.
    pub(super) fn new(pose: &Pose, of: &Proportions) -> Option<Self> {
        if !pose.is_finite() || pose.pressure <= 0.0 {
            return None;
        }
        let pressure = pose.pressure.min(1.0);
        let (column, x) = whole_and_part(pose.x);
        let (row, y) = whole_and_part(pose.y);
        let mut handle = handle(pose.tilt_x_deg, pose.tilt_y_deg, FARTHEST_LEAN_DEG);
        let (sin, cos) = libm::sincos((pose.twist_deg % 360.0).to_radians());
        let across = Vector::new(cos as f32, sin as f32, 0.0);
        if of.spines > 1 {
            handle = handle.across(across).unit_or(Vector::UP);
        }
        let broad = across.across(handle).unit_or(across);
        let mut axis = handle;
        if of.rigid {
            let angle = BLADE_DEG.0 + (BLADE_DEG.1 - BLADE_DEG.0) * pressure;
            let (sin, cos) = libm::sincos(angle.to_radians());
            let level = Vector::UP.cross(broad);
            let side = if handle.dot(level) < -OTHER_SIDE { -1.0 } else { 1.0 };
            axis = level * (side * cos as f32) + Vector::UP * sin as f32;
        }
        Some(Self {
            origin: (column, row),
            tip: (x, y),
            axis,
            broad,
            thin: axis.cross(broad),
            pressure: pressure as f32,
        })
    }

    /// Direction in which hair bends by default: opposite to the lean of the handle, or along
    /// the thin side if the handle is upright.
    pub(super) fn falls_to(&self) -> Vector {
        let away = Vector::new(-self.axis.x, -self.axis.y, 0.0);
        let over = Vector::new(self.thin.x, self.thin.y, 0.0);
        (away * 4.0 + over * 0.25).unit_or(over)
    }
}

fn whole_and_part(cells: f64) -> (i64, f32) {
    let steps = (cells.clamp(-FARTHEST, FARTHEST) * STEPS_PER_CELL).round();
    let whole = (steps / STEPS_PER_CELL).floor();
    (whole as i64, (steps / STEPS_PER_CELL - whole) as f32)
}

/// Direction of a handle with these tilts, the first seen from the front, the second from the
/// side, limited to `farthest_deg` degrees from upright.
fn handle(tilt_x_deg: f64, tilt_y_deg: f64, farthest_deg: f64) -> Vector {
    let (sin_x, cos_x) = libm::sincos(tilt_x_deg.clamp(-90.0, 90.0).to_radians());
    let (sin_y, cos_y) = libm::sincos(tilt_y_deg.clamp(-90.0, 90.0).to_radians());
    // Proportional to (tan x, tan y, 1), but finite at 90 degrees. If both tilts are 90
    // degrees, the handle lies between the x and y axes.
    let mut x = sin_x * cos_y;
    let mut y = sin_y * cos_x;
    let z = cos_x * cos_y;
    if libm::hypot(x, y) + z < 1e-9 {
        (x, y) = (sin_x, sin_y);
    }
    let level = (x * x + y * y).sqrt();
    let lean = libm::atan2(level, z).min(farthest_deg.to_radians());
    let (sin, cos) = libm::sincos(lean);
    if level == 0.0 {
        return Vector::UP;
    }
    Vector::new((x / level * sin) as f32, (y / level * sin) as f32, cos as f32)
}

/// A position or a direction, in cells.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Vector {
    pub(super) x: f32,
    pub(super) y: f32,
    pub(super) z: f32,
}

impl Vector {
    pub(super) const ZERO: Self = Self::new(0.0, 0.0, 0.0);
    pub(super) const UP: Self = Self::new(0.0, 0.0, 1.0);

    pub(super) const fn new(x: f32, y: f32, z: f32) -> Self {
        Self { x, y, z }
    }

    pub(super) fn dot(self, other: Self) -> f32 {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    pub(super) fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    pub(super) fn length(self) -> f32 {
        self.dot(self).sqrt()
    }

    /// This direction with length 1. If its length is at most 1e-4, you get `otherwise`.
    pub(super) fn unit_or(self, otherwise: Self) -> Self {
        let length = self.length();
        if length > 1e-4 { self * (1.0 / length) } else { otherwise }
    }

    /// This direction without its component along `unit`.
    pub(super) fn across(self, unit: Self) -> Self {
        self - unit * self.dot(unit)
    }
}

impl Add for Vector {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl Sub for Vector {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl Mul<f32> for Vector {
    type Output = Self;
    fn mul(self, factor: f32) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl Neg for Vector {
    type Output = Self;
    fn neg(self) -> Self {
        self * -1.0
    }
}

impl AddAssign for Vector {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Vector {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

/// Weights of the uniform cubic B-spline.
pub(super) fn b_spline(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    let [second, third] =
        [(t, s), (s, t)].map(|(t, s)| 4.0 * s * s * s + 12.0 * s * s * t + 6.0 * s * t * t);
    [s * s * s, second + t * t * t, third + s * s * s, t * t * t].map(|w| w / 6.0)
}

#[cfg(test)]
mod tests {
    use super::super::HeadShape;
    use super::*;

    const POSE: Pose = Pose {
        x: 3.25,
        y: -1.5,
        pressure: 0.5,
        tilt_x_deg: 0.0,
        tilt_y_deg: 0.0,
        twist_deg: 0.0,
        speed_mm_s: 0.0,
    };

    #[test]
    fn axes_stand_upright_on_each_other_whatever_the_pose() {
        for (tilt_x_deg, tilt_y_deg) in
            [(0.0, 0.0), (45.0, 0.0), (90.0, 0.0), (-90.0, 90.0), (1e9, -1e9), (89.999, 30.0)]
        {
            for (twist_deg, shape) in
                [(0.0, HeadShape::Round), (90.0, HeadShape::Knife), (-1e12, HeadShape::Flat)]
            {
                let pose = Pose { tilt_x_deg, tilt_y_deg, twist_deg, ..POSE };
                let grip = Grip::new(&pose, shape.proportions()).unwrap();
                for axis in [grip.axis, grip.broad, grip.thin] {
                    assert!((axis.length() - 1.0).abs() < 1e-5, "{pose:?}: {axis:?}");
                }
                assert!(grip.axis.dot(grip.broad).abs() < 1e-5, "{pose:?}");
                assert!(grip.axis.z > 0.13, "{pose:?}: {:?}", grip.axis);
            }
        }
    }

    #[test]
    fn a_lean_is_towards_its_side_and_a_twist_clockwise() {
        let right =
            Grip::new(&Pose { tilt_x_deg: 30.0, ..POSE }, HeadShape::Round.proportions()).unwrap();
        assert!((right.axis.x - 0.5).abs() < 1e-6 && right.axis.y == 0.0);
        let lower =
            Grip::new(&Pose { tilt_y_deg: 30.0, ..POSE }, HeadShape::Round.proportions()).unwrap();
        assert!((lower.axis.y - 0.5).abs() < 1e-6);
        let turned =
            Grip::new(&Pose { twist_deg: 90.0, ..POSE }, HeadShape::Round.proportions()).unwrap();
        assert!((turned.broad.y - 1.0).abs() < 1e-6);
        assert_eq!((right.origin, right.tip), ((3, -2), (0.25, 0.5)));
    }

    #[test]
    fn a_wide_head_stays_level_and_a_blade_stands_on_its_edge() {
        for towards_deg in (0..360).step_by(15) {
            let (sin, cos) = f64::from(towards_deg).to_radians().sin_cos();
            let pose = Pose { tilt_x_deg: tilt(cos), tilt_y_deg: tilt(sin), ..POSE };
            for shape in [HeadShape::Flat, HeadShape::Knife] {
                let grip = Grip::new(&pose, shape.proportions()).unwrap();
                assert_eq!(grip.broad.z, 0.0, "{shape}, {towards_deg}");
            }
            let blade = Grip::new(&pose, HeadShape::Knife.proportions()).unwrap();
            let angle_deg = blade.axis.z.asin().to_degrees();
            assert!((angle_deg - 16.5).abs() < 0.01, "{towards_deg}: {angle_deg}");
            // The handle chooses the side.
            let leans = sin.abs() > 0.3;
            assert!(!leans || f64::from(blade.axis.y) * sin > 0.0, "{towards_deg}: {blade:?}");
        }
    }

    fn tilt(part: f64) -> f64 {
        (1.5 * part).atan().to_degrees()
    }

    #[test]
    fn no_pressure_and_no_numbers_are_no_grip() {
        assert!(
            Grip::new(&Pose { pressure: 0.0, ..POSE }, HeadShape::Round.proportions()).is_none()
        );
        assert!(Grip::new(&Pose { x: f64::NAN, ..POSE }, HeadShape::Round.proportions()).is_none());
        assert!(
            Grip::new(&Pose { twist_deg: f64::INFINITY, ..POSE }, HeadShape::Round.proportions())
                .is_none()
        );
    }
}
