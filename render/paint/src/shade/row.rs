//! Shading of a row of cells on the processor: the specification of `shade.wgsl`.

use pulp::Simd;

use super::relief_lamp::{MOST, ReliefLamp, SOFT};
use super::tops::Tops;
use crate::optics::{NODES, Scene, SceneSurface};
use graphics::lanes::{greater, lesser, multiply_add};

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
/// with 1 as the fourth component. `first` is the column and row of the first cell in `tops`,
/// `internal` holds the internal reflectance of each cell, `materials` its topmost material.
///
/// # Panics
/// If the slices do not have the lengths that belong to `internal.len()` cells, or these do not
/// lie within `tops`.
pub fn shade_row(
    scene: &Scene,
    (tops, first): (&Tops, (usize, usize)),
    internal: &[[f32; NODES]],
    materials: &[TopMaterial],
    out: &mut [[f32; 4]],
) {
    color_row(scene, internal, out);
    relieve_row(scene, (tops, first), materials, out);
}

/// Computes the linear sRGB of a row of level cells like [`shade_row`].
///
/// # Panics
/// If the slices differ in length.
pub fn color_row(scene: &Scene, internal: &[[f32; NODES]], out: &mut [[f32; 4]]) {
    assert_eq!(internal.len(), out.len(), "each cell needs a colour");
    graphics::lanes::vectorized(Color { scene, internal, out });
}

/// Adds relief and gloss to `out`, the linear sRGB of a row of level cells; see [`shade_row`].
///
/// # Panics
/// If the slices differ in length, or cells do not lie within `tops`.
pub fn relieve_row(
    scene: &Scene,
    (tops, first): (&Tops, (usize, usize)),
    materials: &[TopMaterial],
    out: &mut [[f32; 4]],
) {
    let count = out.len();
    assert_eq!(materials.len(), count, "each cell has a topmost material");
    if scene.lamp.relief == 0.0 {
        return;
    }
    let (x, y) = first;
    let (width, height) = tops.size();
    assert!(x + count <= width && y < height, "cells must lie within {width} x {height}");
    let lamp = ReliefLamp::new(scene);
    for (block, out) in out.chunks_mut(BLOCK).enumerate() {
        let from = block * BLOCK;
        let mut seen = Seen::default();
        let light = Relief { lamp: &lamp, tops, first: (x + from, y), count: out.len() };
        graphics::lanes::vectorized(Shade { light, seen: &mut seen, out });
        for (i, (material, out)) in materials[from..].iter().zip(out).enumerate() {
            let mirrored = lamp.mirrored(seen.n_dot_h[i], seen.lamp[i], *material as usize);
            if mirrored > 0.0 {
                for channel in &mut out[..3] {
                    *channel += mirrored * (1.0 - *channel);
                }
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

impl ReliefLamp {
    /// Share of the light that a surface with this n . h mirrors from the lamp, of which it
    /// sees the share `lamp`.
    #[inline(always)]
    fn mirrored(&self, n_dot_h: f32, lamp: f32, material: usize) -> f32 {
        let (gloss, level) = self.gloss[material.min(2)];
        if gloss.strength == 0.0 || n_dot_h <= self.halfway[2] {
            return 0.0;
        }
        let mirrored = lamp * gloss.strength * (n_dot_h.powf(gloss.exponent) - level).max(0.0);
        mirrored / (1.0 + mirrored)
    }
}

/// How much of the lamp the cells of a block see, and at which angle.
struct Seen {
    n_dot_h: [f32; BLOCK],
    /// Share of the lamp that nothing hides.
    lamp: [f32; BLOCK],
}

impl Default for Seen {
    fn default() -> Self {
        Self { n_dot_h: [0.0; BLOCK], lamp: [1.0; BLOCK] }
    }
}

/// The surface of up to [`BLOCK`] cells of a row.
struct Relief<'a> {
    lamp: &'a ReliefLamp,
    tops: &'a Tops,
    first: (usize, usize),
    count: usize,
}

impl Relief<'_> {
    fn heights(&self, offset: [i32; 2]) -> &[i32] {
        self.tops.row(self.first, offset, self.count)
    }
}

struct Shade<'a> {
    light: Relief<'a>,
    seen: &'a mut Seen,
    out: &'a mut [[f32; 4]],
}

impl pulp::WithSimd for Shade<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { light, seen, out } = self;
        let lamp = light.lamp;
        let count = light.count.min(BLOCK);
        let here = &light.heights([0, 0])[..count];
        let mut hidden = [0.0f32; BLOCK];
        let mut sky = [0.0f32; BLOCK];
        for tap in &lamp.shadow {
            let there = &light.heights(tap.offset)[..count];
            for i in 0..count {
                let up = there[i] as f32 - here[i] as f32;
                hidden[i] = greater(multiply_add::<S>(tap.per_quantum, up, -tap.less), hidden[i]);
            }
        }
        for tap in &lamp.around {
            let there = &light.heights(tap.offset)[..count];
            for i in 0..count {
                let up = tap.per_quantum * (there[i] as f32 - here[i] as f32);
                let up = greater(up, 0.0);
                sky[i] = multiply_add::<S>(up, up, sky[i]);
            }
        }
        let [left, right] = [[-1, 0], [1, 0]].map(|offset| &light.heights(offset)[..count]);
        let [above, below] = [[0, -1], [0, 1]].map(|offset| &light.heights(offset)[..count]);
        let [by_x, by_y] = lamp.towards_lamp;
        let [h_x, h_y, h_z] = lamp.halfway;
        let mut diffuse = [0.0; BLOCK];
        for i in 0..count {
            let x = lamp.slope * (right[i] as f32 - left[i] as f32);
            let y = lamp.slope * (below[i] as f32 - above[i] as f32);
            let length = (multiply_add::<S>(x, x, y * y) + 1.0).sqrt();
            let lit = (1.0 + multiply_add::<S>(x, by_x, y * by_y)) / length;
            let over = hidden[i] * (1.0 / SOFT);
            let free = 1.0 / multiply_add::<S>(over, over, 1.0);
            let open = 1.0 / multiply_add::<S>(sky[i], 0.125, 1.0);
            let lit = multiply_add::<S>(free, greater(lit, 0.0), -1.0);
            let from_sky = lamp.ambient * (open - 1.0);
            diffuse[i] = 1.0 + multiply_add::<S>(1.0 - lamp.ambient, lit, from_sky);
            seen.n_dot_h[i] = (h_z - multiply_add::<S>(x, h_x, y * h_y)) / length;
            seen.lamp[i] = free;
        }
        for (out, diffuse) in out.iter_mut().zip(diffuse) {
            let [r, g, b, _] = *out;
            let most = greater(greater(r, g), greater(b, 0.0));
            let factor = bounded::<S>(diffuse, most);
            for channel in &mut out[..3] {
                *channel *= factor;
            }
        }
    }
}

/// Factor on a colour whose greatest channel is `most`, for a factor of `diffuse` on its light.
#[inline(always)]
fn bounded<S: Simd>(diffuse: f32, most: f32) -> f32 {
    let more = greater(diffuse - 1.0, 0.0);
    let room = greater(1.0 - most, 1e-6);
    let bound = multiply_add::<S>(more, multiply_add::<S>(room, 1.0 / MOST, most), room);
    lesser(diffuse, 1.0) + more * room / bound
}
