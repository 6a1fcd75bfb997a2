//! One lock of hair between a ferrule and the canvas.

use super::b_spline::b_spline;
use super::shape::NODES;
use super::vector::Vector;

/// Fraction of its thickness that a head loses under full pressure (chosen by eye).
pub(super) const FLATTENED: f32 = 0.5;

/// Fraction of its thickness by which lying hair gives way to the canvas (chosen by eye).
const PRESSED: f32 = 0.6;

/// How far pressed hair bends towards its trail before it reaches the canvas (chosen by eye).
const ARC: f32 = 0.8;

/// Where the contact of slanting hair lies, from its core (0) to the side that faces the canvas
/// (1); fitted to the contacts of all shapes.
const INWARDS: f32 = 0.7;

/// Number of points of a segment at which contact is looked for.
const LOOKS: usize = 4;

/// Distance in mm by which hair is pressed below the crests of the relief at `pressure` (chosen
/// by eye).
pub(super) fn sink_mm(pressure: f32) -> f32 {
    0.01 + 0.24 * pressure
}

/// Hair of a head, without its place. Lengths are in cells.
pub(super) struct Hair<'a> {
    /// Horizontal direction in which hair lies, at most 1 long.
    pub(super) trail: Vector,
    /// Unit vector from the tip to the ferrule.
    pub(super) axis: Vector,
    /// Unit vector along the broad side.
    pub(super) broad: Vector,
    /// Pressure from 0 to 1.
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
    /// Direction of the segment that ends at `level`, if it bends by `arc` of its trail.
    fn direction(&self, level: usize, arc: f32) -> Vector {
        let share = (level as f32 - 0.5) / (NODES - 1) as f32;
        let upright = self.axis * (share - 1.0) - Vector::UP * share;
        (upright + self.trail * (arc * share * share)).unit_or(-Vector::UP)
    }

    /// Distance from the ferrule down to the lowest point of hair that nothing presses.
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

    /// Distance down from the ferrule to a point of hair that nothing presses, at `share` of its
    /// length.
    pub(super) fn drop(&self, share: f32) -> f32 {
        let segment = self.length / (NODES - 1) as f32;
        (1..NODES)
            .map(|level: usize| {
                let part = (share * (NODES - 1) as f32 - (level - 1) as f32).clamp(0.0, 1.0);
                -self.direction(level, 0.0).z * part * segment
            })
            .sum()
    }

    /// Lays a spine from `ferrule` over the heights `floor`; `rest` are the distances of its nodes
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

    /// Horizontal way from the ferrule, `high` over a plane, to the middle of the contact of a
    /// head whose width along the hair is `width`; to its tip if it does not touch.
    pub(super) fn middle(&self, high: f32, width: &[f32; NODES]) -> Vector {
        let rest = std::array::from_fn::<_, NODES, _>(|level| {
            (self.length * level as f32 / (NODES - 1) as f32, 0.0)
        });
        let Laid { places, lying } = self.laid(Vector::UP * high, &rest, |_, _| 0.0);
        let mut sum = Vector::ZERO;
        let mut whole = 0.0;
        let mut last = places[0] + self.axis;
        let beyond = places[NODES - 1] * 2.0 - places[NODES - 2];
        let before = places[0] * 2.0 - places[1];
        let at = |level: isize| match usize::try_from(level) {
            Err(_) => before,
            Ok(level) => places.get(level).copied().unwrap_or(beyond),
        };
        for look in 0..=(NODES - 1) * LOOKS {
            let level = (look / LOOKS).min(NODES - 2);
            let share = look as f32 / LOOKS as f32 - level as f32;
            let weights = b_spline(share);
            let first = level as isize - 1;
            let core =
                (0..4).fold(Vector::ZERO, |sum, i| sum + at(first + i as isize) * weights[i]);
            let along = (last - core).unit_or(self.axis);
            last = core;
            let between = |a: f32, b: f32| a + (b - a) * share;
            let flat = between(lying[level], lying[level + 1]);
            let thick = between(self.section[level].1, self.section[level + 1].1)
                * (1.0 - FLATTENED * self.pressure * flat);
            // The side that faces the canvas, at right angles to the hair.
            let side = (along * along.z - Vector::UP).unit_or(Vector::ZERO);
            let place = core + side * (INWARDS * thick);
            let under = core.z + side.z * thick;
            let pressed = (-under / thick.max(0.5)).clamp(0.0, 1.0);
            let chord = (pressed * (2.0 - pressed)).sqrt();
            let weight = chord * between(width[level], width[level + 1]);
            sum += place * weight;
            whole += weight;
        }
        let middle = if whole > 0.0 { sum * (1.0 / whole) } else { places[NODES - 1] };
        Vector::new(middle.x, middle.y, 0.0)
    }
}
