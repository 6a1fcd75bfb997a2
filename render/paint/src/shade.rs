//! Shades painted cells: from internal reflectance to the light that reaches the eye,
//! through surface reflection, colour, relief and gloss.
//!
//! A flat painting shows what an instrument measures: under any lamp, a cell whose
//! neighbours are level has exactly the colour of its film. Relief multiplies that by
//! `ambient + (1 - ambient) (n . l) / l_z`, where n is the surface normal and l the
//! direction to the lamp. Gloss is Blinn's (1977) with h = (l + v) / |l + v| and v towards
//! the viewer: `strength (1 - ambient) max(0, (n . h)^exponent - h_z^exponent)`. A level
//! surface thus has no highlight; what its specular reflection adds to a reading is
//! already in Saunderson's k1.

use pulp::Simd;

use crate::amount::QUANTA_PER_CELL;
use crate::optics::{Gloss, Lamp, NODES, Scene, SceneSurface};
use graphics::lanes::multiply_add;

/// Heights of the surface in and around a row of cells, in quanta. Each slice extends one
/// cell beyond the row at both ends.
#[derive(Debug, Clone, Copy)]
pub struct RowHeights<'a> {
    /// Heights in the row above; at the upper edge of the canvas those of the row itself.
    pub above: &'a [i32],
    /// Heights in the row.
    pub here: &'a [i32],
    /// Heights in the row below; at the lower edge of the canvas those of the row itself.
    pub below: &'a [i32],
}

/// The topmost material in a cell, which decides its gloss.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum TopMaterial {
    /// Wet paint.
    Wet = 0,
    /// Dry paint with no wet paint over it.
    Dry = 1,
    /// The ground without paint.
    Ground = 2,
}

/// Computes the linear sRGB of a row of cells, with white at 1, and writes it to `out`
/// with 1 as the fourth component. `internal` holds the internal reflectance of each
/// cell, `materials` its topmost material.
///
/// # Panics
/// If the slices do not have the lengths that belong to `internal.len()` cells.
pub fn shade_row(
    scene: &Scene,
    heights: &RowHeights<'_>,
    internal: &[[f32; NODES]],
    materials: &[TopMaterial],
    out: &mut [[f32; 4]],
) {
    let count = internal.len();
    assert!(materials.len() == count && out.len() == count, "slices must hold {count} cells");
    for row in [heights.above, heights.here, heights.below] {
        assert_eq!(row.len(), count + 2, "heights must extend one cell beyond both ends");
    }
    pulp::Arch::new().dispatch(Color { scene, internal, out });
    if scene.lamp.relief == 0.0 {
        return;
    }
    let shading = SlopeShading::new(&scene.lamp);
    let mut normals = [Normal::default(); BLOCK];
    for (block, out) in out.chunks_mut(BLOCK).enumerate() {
        let first = block * BLOCK;
        let normals = &mut normals[..out.len()];
        pulp::Arch::new().dispatch(Shade { shading: &shading, heights, first, normals, out });
        for ((normal, material), out) in normals.iter().zip(&materials[first..]).zip(out) {
            let highlight = shading.highlight(normal.n_dot_h, *material as usize);
            for channel in &mut out[..3] {
                *channel += highlight;
            }
        }
    }
}

/// Number of cells whose diffuse light is computed before their gloss; small enough that
/// they stay in the L1 cache.
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
        let SceneSurface { k1, k2, specular } = self.scene.surface;
        let through = (1.0 - k1) * (1.0 - k2);
        let rgb = self.scene.rgb_from_nodes.map(|[r, g, b]| [r, g, b, 0.0]);
        for (internal, out) in self.internal.iter().zip(self.out) {
            let mut measured = [0.0; NODES];
            for i in 0..NODES {
                let r = internal[i];
                measured[i] = specular + through * r / multiply_add::<S>(-k2, r, 1.0);
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

/// A lamp, prepared for shading slopes.
struct SlopeShading {
    /// Derivative of n . l / l_z by the slopes along x and y, for a normal that is not
    /// yet normalised.
    towards_lamp: [f32; 2],
    /// The unit vector h halfway between lamp and viewer.
    halfway: [f32; 3],
    ambient: f32,
    /// Slope for a height difference of one quantum over two cells, times the lamp's relief.
    slope: f32,
    /// By [`TopMaterial`]: gloss with its strength times the share of direct light, and
    /// h_z to its exponent.
    gloss: [(Gloss, f32); 3],
}

#[derive(Clone, Copy, Default)]
struct Normal {
    n_dot_h: f32,
}

impl SlopeShading {
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

    /// Light of the highlight of a surface with this n . h.
    #[inline(always)]
    fn highlight(&self, n_dot_h: f32, material: usize) -> f32 {
        let (gloss, level) = self.gloss[material.min(2)];
        if gloss.strength == 0.0 || n_dot_h <= self.halfway[2] {
            return 0.0;
        }
        gloss.strength * (n_dot_h.powf(gloss.exponent) - level).max(0.0)
    }
}

struct Shade<'a> {
    shading: &'a SlopeShading,
    heights: &'a RowHeights<'a>,
    /// Index of the block's first cell in the row.
    first: usize,
    normals: &'a mut [Normal],
    out: &'a mut [[f32; 4]],
}

impl pulp::WithSimd for Shade<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { shading, heights, first, normals, out } = self;
        let count = out.len();
        let left = &heights.here[first..][..count];
        let right = &heights.here[first + 2..][..count];
        let above = &heights.above[first + 1..][..count];
        let below = &heights.below[first + 1..][..count];
        let normals = &mut normals[..count];
        let mut diffuse = [0.0; BLOCK];
        for i in 0..count {
            let x = shading.slope * (right[i] as f32 - left[i] as f32);
            let y = shading.slope * (below[i] as f32 - above[i] as f32);
            let length = (multiply_add::<S>(x, x, y * y) + 1.0).sqrt();
            let [by_x, by_y] = shading.towards_lamp;
            let lit = (1.0 + multiply_add::<S>(x, by_x, y * by_y)) / length;
            let lit = if lit > 0.0 { lit } else { 0.0 };
            diffuse[i % BLOCK] = multiply_add::<S>(1.0 - shading.ambient, lit - 1.0, 1.0);
            let [h_x, h_y, h_z] = shading.halfway;
            normals[i].n_dot_h = (h_z - multiply_add::<S>(x, h_x, y * h_y)) / length;
        }
        for (out, diffuse) in out.iter_mut().zip(diffuse) {
            for channel in &mut out[..3] {
                *channel *= diffuse;
            }
        }
    }
}
