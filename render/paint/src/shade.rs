//! From internal reflectance to the light that reaches the eye: surface,
//! colour, relief, and gloss.
//!
//! What an instrument measures is what a flat painting shows: under any lamp a
//! cell whose neighbours are level has exactly the colour of its film. Relief
//! changes that by `ambient + (1 - ambient) (n . l) / l_z`, with n the normal of
//! the surface and l the direction to the lamp. Gloss is Blinn's (1977), with
//! h = (l + v) / |l + v| and v towards the viewer:
//! `strength (1 - ambient) max(0, (n . h)^exponent - h_z^exponent)`. A level
//! surface thus adds no veil; what its mirror reflection adds to a reading is in
//! Saunderson's k1 already.

use pulp::Simd;

use crate::amount::QUANTA_PER_CELL;
use crate::optics::{Gloss, Lamp, NODES, Scene, SceneSurface};
use graphics::lanes::multiply_add;

/// The heights of the surface around a row, in quanta; each one cell longer than
/// the row at both ends.
#[derive(Debug, Clone, Copy)]
pub struct Relief<'a> {
    /// Of the row above; at the upper edge the row itself.
    pub above: &'a [i32],
    /// Of the row.
    pub here: &'a [i32],
    /// Of the row below; at the lower edge the row itself.
    pub below: &'a [i32],
}

/// Linear sRGB of a row of cells of `internal` reflectance into `out`, white at
/// 1; the fourth number is 1. `bare` is 0 where wet paint lies on top, 1 where
/// dry paint does, 2 where the ground is bare.
///
/// # Panics
/// If lengths do not fit.
pub fn shade_row(
    scene: &Scene,
    relief: &Relief<'_>,
    internal: &[[f32; NODES]],
    bare: &[u8],
    out: &mut [[f32; 4]],
) {
    let count = internal.len();
    assert!(bare.len() == count && out.len() == count, "{count} cells");
    for row in [relief.above, relief.here, relief.below] {
        assert_eq!(row.len(), count + 2, "heights of {count} cells and one more at both ends");
    }
    pulp::Arch::new().dispatch(Color { scene, internal, out });
    if scene.lamp.relief == 0.0 {
        return;
    }
    let bumps = Bumps::new(&scene.lamp);
    let mut normals = [Normal::default(); BLOCK];
    for (block, out) in out.chunks_mut(BLOCK).enumerate() {
        let first = block * BLOCK;
        let normals = &mut normals[..out.len()];
        pulp::Arch::new().dispatch(Shade { bumps: &bumps, relief, first, normals, out });
        for ((normal, bare), out) in normals.iter().zip(&bare[first..]).zip(out) {
            let shine = bumps.shine(normal.mirrored, usize::from(*bare));
            for channel in &mut out[..3] {
                *channel += shine;
            }
        }
    }
}

/// Cells shaded between two looks at their gloss; they stay in the nearest cache.
const BLOCK: usize = 64;

struct Color<'a> {
    scene: &'a Scene,
    internal: &'a [[f32; NODES]],
    out: &'a mut [[f32; 4]],
}

impl pulp::WithSimd for Color<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let SceneSurface { k1, k2, floor } = self.scene.surface;
        let through = (1.0 - k1) * (1.0 - k2);
        let rgb = self.scene.rgb_from_nodes.map(|[r, g, b]| [r, g, b, 0.0]);
        for (internal, out) in self.internal.iter().zip(self.out) {
            let mut measured = [0.0; NODES];
            for i in 0..NODES {
                let r = internal[i];
                measured[i] = floor + through * r / multiply_add::<S>(-k2, r, 1.0);
            }
            let mut sum = [0.0, 0.0, 0.0, 1.0];
            for node in 0..NODES {
                for channel in 0..4 {
                    sum[channel] =
                        multiply_add::<S>(measured[node], rgb[node][channel], sum[channel]);
                }
            }
            *out = sum;
        }
    }
}

/// What a lamp makes of slopes.
struct Bumps {
    /// Change of n . l / l_z by the slopes along x and y, for a normal not yet
    /// brought to unit length.
    towards_lamp: [f32; 2],
    /// The vector h.
    halfway: [f32; 3],
    ambient: f32,
    /// Slope of the surface, in cells a cell, for one quantum over two cells.
    slope: f32,
    /// Gloss of wet, dry and bare, strength times the lamp's share, and h_z to
    /// the exponent.
    gloss: [(Gloss, f32); 3],
}

#[derive(Clone, Copy, Default)]
struct Normal {
    /// n . h
    mirrored: f32,
}

impl Bumps {
    fn new(lamp: &Lamp) -> Self {
        let [x, y, z] = lamp.direction;
        let length = (x * x + y * y + (z + 1.0) * (z + 1.0)).sqrt();
        let halfway = [x, y, z + 1.0].map(|v| v / length);
        let gloss = |gloss: Gloss| {
            let strength = gloss.strength * (1.0 - lamp.ambient);
            (Gloss { strength, ..gloss }, halfway[2].powf(gloss.exponent))
        };
        Self {
            towards_lamp: [-x / z, -y / z],
            halfway,
            ambient: lamp.ambient,
            slope: lamp.relief / (2.0 * QUANTA_PER_CELL as f32),
            gloss: [lamp.wet, lamp.dry, lamp.ground].map(gloss),
        }
    }

    /// The gloss of a surface with this n . h.
    #[inline(always)]
    fn shine(&self, mirrored: f32, bare: usize) -> f32 {
        let (gloss, level) = self.gloss[bare.min(2)];
        if gloss.strength == 0.0 || mirrored <= self.halfway[2] {
            return 0.0;
        }
        gloss.strength * (mirrored.powf(gloss.exponent) - level).max(0.0)
    }
}

struct Shade<'a> {
    bumps: &'a Bumps,
    relief: &'a Relief<'a>,
    first: usize,
    normals: &'a mut [Normal],
    out: &'a mut [[f32; 4]],
}

impl pulp::WithSimd for Shade<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { bumps, relief, first, normals, out } = self;
        let count = out.len();
        let left = &relief.here[first..][..count];
        let right = &relief.here[first + 2..][..count];
        let above = &relief.above[first + 1..][..count];
        let below = &relief.below[first + 1..][..count];
        let normals = &mut normals[..count];
        let mut diffuse = [0.0; BLOCK];
        for i in 0..count {
            let x = bumps.slope * (right[i] as f32 - left[i] as f32);
            let y = bumps.slope * (below[i] as f32 - above[i] as f32);
            let length = (multiply_add::<S>(x, x, y * y) + 1.0).sqrt();
            let [by_x, by_y] = bumps.towards_lamp;
            let lit = (1.0 + multiply_add::<S>(x, by_x, y * by_y)) / length;
            let lit = if lit > 0.0 { lit } else { 0.0 };
            diffuse[i % BLOCK] = multiply_add::<S>(1.0 - bumps.ambient, lit - 1.0, 1.0);
            let [h_x, h_y, h_z] = bumps.halfway;
            normals[i].mirrored = (h_z - multiply_add::<S>(x, h_x, y * h_y)) / length;
        }
        for (out, diffuse) in out.iter_mut().zip(diffuse) {
            for channel in &mut out[..3] {
                *channel *= diffuse;
            }
        }
    }
}
