//! Shades painted cells: from internal reflectance to the light that reaches the eye, through
//! surface reflection, colour, relief and gloss. `shade.wgsl` follows this specification.
//!
//! A flat painting shows what an instrument measures: under any lamp, a cell on level paint has
//! exactly the colour of its film. Relief multiplies this colour by
//! ```text
//! f = 1 + ambient (open - 1) + (1 - ambient) (seen (n . l) / l_z - 1)
//! open = 1 / (1 + mean of s^2)     s: slopes up to the cells around, in eight directions
//! seen = 1 / (1 + (r / SOFT)^2)    r: how much a slope towards the lamp exceeds the lamp's
//! ```
//! where n is the surface normal and l the direction to the lamp. `open` is the share of the
//! sky above horizons of these slopes, `seen` a cast shadow with a soft edge. Both are 1 on a
//! level surface, and look [`REACH_MM`] far.
//!
//! Light beyond the light of level paint is bounded by Reinhard's (2002) shoulder: with e = f - 1
//! above 0 and m the greatest channel of the colour, the factor is
//! `1 + e / (1 + e (m / (1 - m) + 1 / MOST))`. It starts with f's own slope, stays below
//! 1 + [`MOST`], and leaves m below 1, so that no hue shifts.
//!
//! Gloss is Blinn's (1977) with h = (l + v) / |l + v| and v towards the viewer:
//! `x = strength (1 - ambient) seen max(0, (n . h)^exponent - h_z^exponent)`. The mirrored
//! share `x / (1 + x)` replaces as much of the light from within. A level surface thus has no
//! highlight: what its specular reflection adds to a reading is already in Saunderson's k1.

use std::ops::Range;

use graphics::lanes::{greater, lesser, multiply_add};
use pulp::Simd;
use rayon::prelude::*;

use crate::amount::QUANTA_PER_CELL;
use crate::optics::{Gloss, NODES, Scene, SceneSurface};

/// Width in cells of the margin on both sides of every row: how far shading may look.
pub const MARGIN: usize = 32;

/// Height of the surface at every cell, in quanta. Beyond the edges of the canvas we continue the
/// surface level.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Tops {
    width: usize,
    height: usize,
    /// Rows of `MARGIN + width + MARGIN` heights.
    values: Vec<i32>,
}

impl Tops {
    /// A level surface over `width` x `height` cells.
    #[must_use]
    pub fn level(width: usize, height: usize) -> Self {
        Self { width, height, values: vec![0; (width + 2 * MARGIN) * height] }
    }

    /// Number of columns and rows of the canvas.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// Height at a cell in quanta.
    ///
    /// # Panics
    /// If the cell lies outside the canvas.
    #[must_use]
    pub fn at(&self, cell: (usize, usize)) -> i32 {
        self.row(cell, [0, 0], 1)[0]
    }

    /// Sets the heights of the columns `spans(y)` of each row y in `rows` to `top(x, y)`, on all
    /// cores.
    ///
    /// # Panics
    /// If rows or spans reach beyond the canvas.
    pub fn set<'a>(
        &mut self,
        rows: Range<usize>,
        spans: impl Fn(usize) -> &'a [Range<usize>] + Sync,
        top: impl Fn(usize, usize) -> i32 + Sync,
    ) {
        let width = self.width;
        let stride = width + 2 * MARGIN;
        let first = rows.start;
        let values = &mut self.values[rows.start * stride..rows.end * stride];
        values.par_chunks_mut(stride).enumerate().for_each(|(row, values)| {
            let y = first + row;
            for span in spans(y) {
                let inside = &mut values[MARGIN..][..width][span.clone()];
                for (x, value) in span.clone().zip(inside) {
                    *value = top(x, y);
                }
            }
            let left = values[MARGIN];
            let right = values[MARGIN + width - 1];
            values[..MARGIN].fill(left);
            values[MARGIN + width..].fill(right);
        });
    }

    /// Sets all heights to `top(x, y)`, on all cores.
    pub fn set_all(&mut self, top: impl Fn(usize, usize) -> i32 + Sync) {
        if self.width > 0 {
            let row = 0..self.width;
            self.set(0..self.height, |_| std::slice::from_ref(&row), top);
        }
    }

    /// Heights of `count` cells from (`x`, `y`) on, moved by `offset` in x and y.
    ///
    /// # Panics
    /// If the offset along x exceeds [`MARGIN`], or the canvas does not have these cells.
    #[inline(always)]
    fn row(&self, (x, y): (usize, usize), offset: [i32; 2], count: usize) -> &[i32] {
        let [along, down] = offset;
        let row = y.saturating_add_signed(down as isize).min(self.height - 1);
        let first = (x + MARGIN).wrapping_add_signed(along as isize);
        &self.values[row * (self.width + 2 * MARGIN)..][first..][..count]
    }
}

/// How far shading looks for what casts a shadow, in mm.
pub const REACH_MM: f32 = 0.8;

/// Most that relief may add to the light of level paint, as a share of it.
pub const MOST: f32 = 1.5;

/// A surface towards the lamp casts a shadow if the slope up to it exceeds the slope of the lamp.
/// If the excess is this large, half of the light is left.
pub const SOFT: f32 = 0.3;

/// Distances towards the lamp at which we look at the surface, in mm, each with its weight. For
/// example, shadows end softly because of these weights.
const SHADOW: [(f32, f32); 6] =
    [(0.1, 1.0), (0.2, 1.0), (0.3, 1.0), (0.4, 0.9), (0.6, 0.7), (REACH_MM, 0.4)];

/// Distances in mm to the cells that may hide part of the sky: along the axes and along the
/// diagonals.
const AROUND: [f32; 2] = [0.2, 0.45];

/// A cell near another cell. Its height changes the light of the other.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tap {
    /// Offset in cells along x and y.
    pub offset: [i32; 2],
    /// Slope for each quantum by which the near cell is higher.
    pub per_quantum: f32,
    /// Subtracted from the slope: the slope of the ray to the lamp, or 0.
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
    /// For each [`TopMaterial`], its gloss with the strength times the share of direct light, and
    /// h_z to the power of the exponent.
    pub gloss: [(Gloss, f32); 3],
    /// Cells towards the lamp that may shade this one.
    pub shadow: [Tap; SHADOW.len()],
    /// Cells around that may hide part of the sky.
    pub around: [Tap; 8],
}

/// How far shading looks in cells of `cell_mm`. If you change a height, the light changes in cells
/// up to this distance along x and y.
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
        let gloss = [lamp.wet, lamp.dry, lamp.ground].map(|gloss: Gloss| {
            let strength = gloss.strength * (1.0 - lamp.ambient);
            (Gloss { strength, ..gloss }, halfway[2].powf(gloss.exponent))
        });
        let tap = |direction: [f32; 2], mm: f32| {
            let offset = direction.map(|v| (v * cells(mm, scene.cell_mm)).round());
            let distance = offset[0].hypot(offset[1]).max(1.0);
            let per_quantum = lamp.relief / (distance * QUANTA_PER_CELL as f32);
            Tap { offset: offset.map(|v| v as i32), per_quantum, less: 0.0 }
        };
        // A lamp straight above does not have a direction on the canvas, and nothing stands in its
        // way.
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
            gloss,
            shadow,
            around,
        }
    }
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

/// Adds relief and gloss to `out`, the linear sRGB of a row of level cells. See [`shade_row`].
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

/// Number of cells for which we compute diffuse light before gloss. This is small enough that they
/// stay in the L1 cache.
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
    /// Share of the light that a surface with this n . h mirrors from the lamp. The surface sees
    /// the share `lamp` of it.
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

/// Limits the factor `diffuse` on the light of a colour, so that its greatest channel `most` stays
/// below 1.
#[inline(always)]
fn bounded<S: Simd>(diffuse: f32, most: f32) -> f32 {
    let more = greater(diffuse - 1.0, 0.0);
    let room = greater(1.0 - most, 1e-6);
    let bound = multiply_add::<S>(more, multiply_add::<S>(room, 1.0 / MOST, most), room);
    lesser(diffuse, 1.0) + more * room / bound
}
