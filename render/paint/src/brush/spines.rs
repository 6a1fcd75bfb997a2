//! Spines of a head: chains of masses and springs, bent by the canvas.
//!
//! Hair is light and paint is thick, so that a head is nearly in equilibrium in every sub-step.
//! The springs are solved by position based dynamics (Mueller et al. 2007): in each of a few
//! iterations, every constraint in turn moves its nodes to satisfy it. The remaining error is
//! corrected in the next sub-step, which acts as damping. No step can overshoot, so that any
//! pose is stable.

use super::grip::Grip;
use super::relief::ReliefView;
use super::shape::{NODES, Proportions};
use super::vector::Vector;

/// Number of solver iterations in a sub-step (chosen by eye).
const ITERATIONS: usize = 6;

/// Fraction of the misalignment between neighbouring spines corrected per iteration (chosen by
/// eye).
const TOGETHER: f32 = 0.6;

/// Coefficient of friction of hair on a primed canvas (chosen by eye).
const FRICTION: f32 = 1.0;

/// Fraction of its thickness that a head loses under full pressure (chosen by eye).
pub(super) const FLATTENED: f32 = 0.5;

/// Distance between the lowest hair and the canvas at pressure 0, in cells.
const CLEARANCE: f32 = 0.5;

/// Minimum thickness of a wide head, in cells. A thinner head can pass between cell centres
/// and touch none.
const THINNEST: f32 = 2.0;

/// Minimum distance by which full pressure lowers a head, in cells; a knife is lowered by just
/// this distance.
const LEAST_DEPTH: f32 = 6.0;

/// Distance by which hair is pressed below the crests of the relief at `pressure`, in cells:
/// 0.1 at first contact, 2.5 at full pressure.
pub(super) fn sink(pressure: f32) -> f32 {
    0.1 + 2.4 * pressure
}

/// Spines of one head; lengths in cells.
#[derive(Debug, Clone)]
pub(super) struct Spines {
    pub(super) of: &'static Proportions,
    pub(super) width: f32,
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
    touching: Vec<bool>,
    before: Vec<Vector>,
    /// Distance by which the hair around each node reaches below it.
    below: Vec<f32>,
}

impl Spines {
    pub(super) fn new(of: &'static Proportions, width: f32) -> Self {
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
        let nodes = rest.len();
        Self {
            of,
            width,
            rest,
            half_thickness,
            section: rounded(half_breadth, half_thickness),
            nodes: vec![Vector::ZERO; nodes],
            load: [0.0; NODES],
            touching: vec![false; nodes],
            before: vec![Vector::ZERO; nodes],
            below: vec![0.0; nodes],
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
    }

    /// Holds the head just above the canvas at `grip`, slightly bent to the side on which
    /// it will lie: opposite to `heading`, unless that is zero.
    pub(super) fn hang(&mut self, grip: &Grip, heading: Vector, relief: &ReliefView<'_>) {
        let fall = (-heading).unit_or(grip.falls_to()) * (0.03 * self.length());
        self.hold_above(grip, fall, relief);
    }

    /// Holds the head just above the canvas at `grip`, with its tip shifted by `fall`
    /// (zero leaves it straight).
    pub(super) fn hold_above(&mut self, grip: &Grip, fall: Vector, relief: &ReliefView<'_>) {
        let grip = &Grip { pressure: 0.0, ..*grip };
        let ferrule = self.ferrule(grip, relief);
        for (i, rest) in self.rest.iter().enumerate() {
            let share = (i % NODES) as f32 / (NODES - 1) as f32;
            let bent = if self.of.rigid { Vector::ZERO } else { fall * (share * share) };
            self.nodes[i] = placed(grip, ferrule, *rest) + bent;
        }
        self.touching.fill(false);
        self.load = [0.0; NODES];
    }

    /// Presses the head from just above the canvas down to `grip` without dragging it.
    pub(super) fn lower(&mut self, grip: &Grip, relief: &ReliefView<'_>) {
        const STAGES: usize = 16;
        for stage in 1..=2 * STAGES {
            let share = (stage as f32 / STAGES as f32).min(1.0);
            self.settle(&Grip { pressure: grip.pressure * share, ..*grip }, relief, 0.0);
        }
    }

    /// Advances one sub-step, in which the handle moved to `grip`.
    pub(super) fn advance(&mut self, grip: &Grip, relief: &ReliefView<'_>) {
        self.settle(grip, relief, FRICTION);
    }

    /// Position of the ferrule. Its height follows the canvas below the tip.
    fn ferrule(&self, grip: &Grip, relief: &ReliefView<'_>) -> Vector {
        let third = grip.broad * (self.width / 3.0);
        let (x, y) = grip.tip;
        let ride = (relief.height(x, y)
            + relief.height(x + third.x, y + third.y)
            + relief.height(x - third.x, y - third.y))
            / 3.0;
        let foot = grip.axis * self.length();
        let mut lowest = f32::INFINITY;
        for (i, &rest) in self.rest.iter().enumerate() {
            let below = self.reach_down(i % NODES, grip.broad, grip.thin);
            lowest = lowest.min(placed(grip, Vector::ZERO, rest).z - below);
        }
        let rim = self.reach_down(0, grip.broad, grip.thin);
        let give = if self.of.rigid { 0.0 } else { self.of.give };
        let depth = (give * (-lowest - rim)).max(LEAST_DEPTH) * grip.pressure;
        Vector::new(x + foot.x, y + foot.y, ride + CLEARANCE - lowest - depth)
    }

    /// Distance by which hair at `level` reaches below its node, for this orientation of the
    /// section.
    fn reach_down(&self, level: usize, broad: Vector, thin: Vector) -> f32 {
        let (breadth, thickness) = self.section[level];
        let (a, b) = (breadth * broad.z, thickness * thin.z);
        (a * a + b * b).sqrt()
    }

    fn settle(&mut self, grip: &Grip, relief: &ReliefView<'_>, friction: f32) {
        let ferrule = self.ferrule(grip, relief);
        if self.of.rigid {
            for (node, &rest) in self.nodes.iter_mut().zip(&self.rest) {
                *node = placed(grip, ferrule, rest);
            }
            return;
        }
        let dig = 2.0 * sink(grip.pressure);
        self.before.copy_from_slice(&self.nodes);
        for spine in 0..self.of.spines {
            self.carry(spine, grip, ferrule);
        }
        self.measure(grip);
        for _ in 0..ITERATIONS {
            for spine in 0..self.of.spines {
                self.relax(spine, grip, ferrule, relief, dig, friction);
            }
            self.hold_together(grip);
        }
        for spine in 0..self.of.spines {
            self.fit(spine, grip, ferrule, relief, dig);
        }
        self.feel(grip, relief, dig);
    }

    /// Moves hair that hangs free with the ferrule; hair in contact stays.
    fn carry(&mut self, spine: usize, grip: &Grip, ferrule: Vector) {
        let first = spine * NODES;
        let root = placed(grip, ferrule, self.rest[first]);
        let moved = root - self.nodes[first];
        for i in first..first + NODES {
            if !self.touching[i] {
                self.nodes[i] += moved;
            }
        }
        self.nodes[first] = root;
    }

    /// Updates the distance by which the hair around each node reaches below it.
    fn measure(&mut self, grip: &Grip) {
        for i in 0..self.nodes.len() {
            let level = i % NODES;
            let next = if level + 1 < NODES { i + 1 } else { i };
            let last = if level > 0 { i - 1 } else { i };
            let along = (self.nodes[last] - self.nodes[next]).unit_or(grip.axis);
            let broad = grip.broad.across(along).unit_or(grip.thin);
            let thin = along.cross(broad);
            let flattened = 1.0 - FLATTENED * self.load[level];
            let reach = self.reach_down(level, broad, thin) * flattened;
            // The surface rounds off a bend, by this much at its node.
            let raised = (self.nodes[last].z - 2.0 * self.nodes[i].z + self.nodes[next].z) / 6.0;
            let inner = level > 0 && level + 1 < NODES;
            let most = 0.25 * self.length() / NODES as f32;
            self.below[i] = reach - if inner { raised.clamp(0.0, most) } else { 0.0 };
        }
    }

    /// Applies the constraints of one spine once.
    fn relax(
        &mut self,
        spine: usize,
        grip: &Grip,
        ferrule: Vector,
        relief: &ReliefView<'_>,
        dig: f32,
        friction: f32,
    ) {
        let range = spine * NODES..(spine + 1) * NODES;
        let rest = &self.rest[range.clone()];
        let below = &self.below[range.clone()];
        let before = &self.before[range.clone()];
        let nodes = &mut self.nodes[range];
        let straight = placed(grip, ferrule, rest[1]) - placed(grip, ferrule, rest[0]);
        bend(nodes, rest, grip.broad, straight, self.of.stiffness);
        stretch(nodes, straight.length());
        for i in 1..NODES {
            let node = &mut nodes[i];
            let floor = relief.height(node.x, node.y) - dig + below[i];
            let pressed = floor - node.z;
            if pressed > 0.0 {
                node.z = floor;
                drag(node, before[i], friction * pressed);
            }
        }
    }

    /// Applies the springs between neighbouring spines: the hair of a head moves together.
    fn hold_together(&mut self, grip: &Grip) {
        for i in NODES..self.nodes.len() {
            if i % NODES > 0 {
                let beside = grip.broad * (self.rest[i].1 - self.rest[i - NODES].1);
                let off = (self.nodes[i] - self.nodes[i - NODES] - beside) * (0.5 * TOGETHER);
                self.nodes[i - NODES] += off;
                self.nodes[i] -= off;
            }
        }
    }

    /// Shortens the overlong segments of a spine, from the ferrule on, and keeps its hair at most
    /// `dig` cells below the relief. Short segments stay: hair that is pushed bends.
    fn fit(
        &mut self,
        spine: usize,
        grip: &Grip,
        ferrule: Vector,
        relief: &ReliefView<'_>,
        dig: f32,
    ) {
        let range = spine * NODES..(spine + 1) * NODES;
        let rest = &self.rest[range.clone()];
        let below = &self.below[range.clone()];
        let nodes = &mut self.nodes[range];
        let straight = placed(grip, ferrule, rest[1]) - placed(grip, ferrule, rest[0]);
        let segment = straight.length();
        for i in 1..NODES {
            let apart = nodes[i] - nodes[i - 1];
            let length = apart.length();
            if length > segment {
                nodes[i] = nodes[i - 1] + apart * (segment / length);
            }
            let floor = relief.height(nodes[i].x, nodes[i].y) - dig + below[i];
            nodes[i].z = nodes[i].z.max(floor);
        }
    }

    /// Updates which nodes touch the canvas, and the pressure on each level.
    fn feel(&mut self, grip: &Grip, relief: &ReliefView<'_>, dig: f32) {
        let mut pressed = [0.0; NODES];
        for (i, node) in self.nodes.iter().enumerate() {
            let gap = node.z - self.below[i] - (relief.height(node.x, node.y) - dig);
            self.touching[i] = i % NODES > 0 && gap < 0.5;
            if self.touching[i] {
                pressed[i % NODES] += grip.pressure / self.of.spines as f32;
            }
        }
        for level in 0..NODES {
            let above = pressed[level.saturating_sub(1)];
            let under = pressed[(level + 1).min(NODES - 1)];
            let wanted = 0.25 * above + 0.5 * pressed[level] + 0.25 * under;
            self.load[level] += 0.25 * (wanted - self.load[level]);
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

/// Position on the unbent head.
fn placed(grip: &Grip, ferrule: Vector, (along, across): (f32, f32)) -> Vector {
    ferrule - grip.axis * along + grip.broad * across
}

/// Applies the bending springs: they pull each three nodes in a row towards their shape at rest,
/// and the first segment towards the direction of the ferrule. Stiffness falls towards the tip,
/// where the hair is thinner.
fn bend(
    nodes: &mut [Vector],
    rest: &[(f32, f32)],
    broad: Vector,
    straight: Vector,
    stiffness: f32,
) {
    nodes[1] += (nodes[0] + straight - nodes[1]) * stiffness;
    for i in 1..NODES - 1 {
        let thinned = 1.0 - 0.75 * i as f32 / NODES as f32;
        let at_rest = broad * (rest[i + 1].1 - 2.0 * rest[i].1 + rest[i - 1].1);
        let bent = nodes[i + 1] - nodes[i] * 2.0 + nodes[i - 1] - at_rest;
        let above = if i == 1 { 0.0 } else { 1.0 };
        let part = bent * (stiffness * thinned / (5.0 + above));
        nodes[i - 1] -= part * above;
        nodes[i] += part * 2.0;
        nodes[i + 1] -= part;
    }
}

/// Applies the stretching springs, which are stiff.
fn stretch(nodes: &mut [Vector], segment: f32) {
    for i in 1..NODES {
        let apart = nodes[i] - nodes[i - 1];
        let length = apart.length().max(1e-4);
        let excess = apart * ((length - segment) / length);
        if i == 1 {
            nodes[1] -= excess;
        } else {
            nodes[i - 1] += excess * 0.5;
            nodes[i] -= excess * 0.5;
        }
    }
}

/// Applies friction: moves a node back along the canvas towards its position `before`, by at
/// most `most` cells.
fn drag(node: &mut Vector, before: Vector, most: f32) {
    let slid = Vector::new(node.x - before.x, node.y - before.y, 0.0);
    let length = slid.length();
    let back = if length <= most { 1.0 } else { most / length };
    *node -= slid * back;
}
