//! A lamp prepared for shading relief: what both backends compute with.

use super::tops::MARGIN;
use crate::amount::QUANTA_PER_CELL;
use crate::optics::{Gloss, Scene};

/// How far shading looks for what casts a shadow, in mm.
pub const REACH_MM: f32 = 0.8;

/// Most that relief may add to the light of level paint, as a share of it.
pub const MOST: f32 = 1.5;

/// How far a slope towards the lamp overtops the lamp's own where half of the light is left.
pub const SOFT: f32 = 0.3;

/// Distances towards the lamp at which the surface is looked at, in mm, with the weight of what
/// stands there: shadows end softly.
const SHADOW: [(f32, f32); 6] =
    [(0.1, 1.0), (0.2, 1.0), (0.3, 1.0), (0.4, 0.9), (0.6, 0.7), (REACH_MM, 0.4)];

/// Distances of what stands around, in mm: along the axes and along the diagonals.
const AROUND: [f32; 2] = [0.2, 0.45];

/// A cell at an offset whose height matters to the light of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tap {
    /// Offset in cells along x and y.
    pub offset: [i32; 2],
    /// Slope for each quantum that the other cell is higher.
    pub per_quantum: f32,
    /// Subtracted from the slope: that of the ray to the lamp, or 0.
    pub less: f32,
}

/// A lamp, prepared for shading relief.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReliefLamp {
    /// Derivative of n . l / l_z by the slopes along x and y, for a normal that is not
    /// yet normalised.
    pub towards_lamp: [f32; 2],
    /// The unit vector h halfway between lamp and viewer.
    pub halfway: [f32; 3],
    /// Share of ambient light, 0 to 1.
    pub ambient: f32,
    /// Slope for a height difference of one quantum over two cells, times the lamp's relief.
    pub slope: f32,
    /// By [`TopMaterial`](super::TopMaterial): gloss with its strength times the share of direct
    /// light, and h_z to its exponent.
    pub gloss: [(Gloss, f32); 3],
    /// Cells towards the lamp that may shade this one.
    pub shadow: [Tap; SHADOW.len()],
    /// Cells around that may hide part of the sky.
    pub around: [Tap; 8],
}

/// How far shading looks in cells of `cell_mm`: a change of height changes the light of cells up
/// to this distance along x and y.
#[must_use]
pub fn reach(cell_mm: f64) -> usize {
    cells(REACH_MM, cell_mm as f32).round() as usize
}

/// Distance of `mm` in cells of `cell_mm`: at least 1, at most [`MARGIN`].
fn cells(mm: f32, cell_mm: f32) -> f32 {
    (mm / cell_mm).clamp(1.0, MARGIN as f32)
}

impl ReliefLamp {
    /// Prepares the lamp of `scene`.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let lamp = &scene.lamp;
        let [x, y, z] = lamp.direction;
        let length = (x * x + y * y + (z + 1.0) * (z + 1.0)).sqrt();
        let halfway = [x, y, z + 1.0].map(|v| v / length);
        let gloss = |gloss: Gloss| {
            let strength = gloss.strength * (1.0 - lamp.ambient);
            (Gloss { strength, ..gloss }, halfway[2].powf(gloss.exponent))
        };
        let tap = |direction: [f32; 2], mm: f32| {
            let offset = direction.map(|v| (v * cells(mm, scene.cell_mm)).round());
            let distance = offset[0].hypot(offset[1]).max(1.0);
            let per_quantum = lamp.relief / (distance * QUANTA_PER_CELL as f32);
            Tap { offset: offset.map(|v| v as i32), per_quantum, less: 0.0 }
        };
        // A lamp straight above has no direction on the canvas, and nothing stands in its way.
        let level = x.hypot(y).max(1e-6);
        let shadow = SHADOW.map(|(mm, weight)| {
            let tap = tap([x / level, y / level], mm);
            Tap { per_quantum: weight * tap.per_quantum, less: weight * z / level, ..tap }
        });
        let around = std::array::from_fn(|i| {
            let (sin, cos) = (std::f32::consts::FRAC_PI_4 * i as f32).sin_cos();
            tap([cos, sin], AROUND[i % 2])
        });
        Self {
            towards_lamp: [-x / z, -y / z],
            halfway,
            ambient: lamp.ambient,
            slope: lamp.relief / (2.0 * QUANTA_PER_CELL as f32),
            gloss: [lamp.wet, lamp.dry, lamp.ground].map(gloss),
            shadow,
            around,
        }
    }
}
