//! Spines of a head: chains of nodes, bent by the canvas.
//!
//! Hair is light and paint is thick, so that a head is in equilibrium in every sub-step and its
//! shape is given by how it is held and how it trails. Hair leaves the ferrule along the
//! handle, bends upright towards the canvas, and lies on it from where it reaches it. What lies
//! is towed: its direction follows the pen as the tractrix does (Huygens 1693), the curve of a
//! body that is dragged on a string. Nothing sticks and slips, so an even hand has an even
//! contact.
//!
//! A painter leads the place where hair touches, so a head is held such that the middle of its
//! contact is at the pen, whatever its lean.

use super::grip::Grip;
use super::hair::{Hair, Laid, sink_mm};
use super::relief::ReliefView;
use super::shape::{NODES, Proportions};
use super::vector::Vector;

/// Length of the string on which the lying hair is towed, as a fraction of the length of the
/// head: about as much as lies at middle pressure.
const TOW: f32 = 0.35;

/// Distance between the lowest hair and the canvas at pressure 0, in cells.
const CLEARANCE: f32 = 0.5;

/// Minimum thickness of a wide head, in cells. A thinner head can pass between cell centres
/// and touch none.
const THINNEST: f32 = 2.0;

/// Minimum distance by which full pressure lowers a head, in mm; a knife is lowered by just
/// this distance.
const LEAST_DEPTH_MM: f32 = 0.6;

/// Spines of one head; lengths in cells.
#[derive(Debug, Clone)]
pub(super) struct Spines {
    pub(super) of: &'static Proportions,
    pub(super) width: f32,
    /// Number of cells in a mm.
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
    /// Direction in which hair lies on the canvas; shorter than 1 while it swings round.
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

    /// The node at `level` of `spine`.
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

    /// Holds the head just above the canvas at `grip`, ready to lie opposite to `heading`, or
    /// opposite to the lean of the handle if that is zero.
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

    /// Whether a blade lies on its other side at `grip` than it did.
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

    /// Bends the head to `grip`.
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
    let at = |of: &[f32; NODES], i: usize| match i {
        0 => of[0],
        i if i + 1 == NODES => of[i],
        i => (of[i - 1] + 4.0 * of[i] + of[i + 1]) / 6.0,
    };
    std::array::from_fn(|i| (at(&breadth, i), at(&thickness, i)))
}
