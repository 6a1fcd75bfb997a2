//! Passes 2 and 3. We sum the strokes at each pixel of a square with their weights, and divide the
//! sums by the weights.
//!
//! Weights are Gaussians to a power, so that the strongest stroke of a place shows most. A first
//! round sums the weights alone. The second looks up the map only where a weight matters.

use glam::{Vec3, Vec4};
use graphics::lanes::{greater, lesser};
use graphics::smoothstep;
use pulp::Simd;

use super::coloring::Coloring;
use super::splats::{Lie, SIDE, Square, StrokeSplat, Values, bowl, bring_forward, nearness};
use super::tones::Tones;

/// We subtract this share of the sum (a step of 8 bits) from each weight and leave out weights that
/// are not larger. So splats appear without a step.
const NEGLIGIBLE: f32 = 1.0 / 256.0;

/// We multiply weights by this before we raise them to a power, so that the weights of a thin cover
/// do not become 0 in f32.
const SCALE: f32 = 8.0;

/// If the sum of weights is below this, f32 has lost it, and we take it as 0.
pub(super) const LOST: f32 = 1e-30;

/// Sums over the strokes of one surface at each pixel of a square.
#[derive(Debug, Clone)]
pub(super) struct Sums {
    /// Bytes of the map times 256, by channel, times weights.
    pub(super) bytes: [[[f32; 4]; SIDE]; SIDE],
    /// Colours of the splats times weights.
    pub(super) color: [[[f32; 3]; SIDE]; SIDE],
    pub(super) weight: Values,
    /// Sum of the amounts that splats add to the cover.
    pub(super) cover: Values,
    /// Weights of all splats.
    pub(super) total: Values,
    /// The splats with their weights, in the order of the list.
    pub(super) parts: Vec<(u32, Values)>,
}

/// Sums of the strokes on the mesh, and of the strokes that reach out in front of it.
#[derive(Debug, Clone)]
pub(super) struct Gathered {
    pub(super) on: Sums,
    pub(super) before: Sums,
    /// Splats that lie in front of the mesh at some pixels: their index, depth and weight.
    raised: Vec<(u32, Values, Values)>,
}

/// The splats and tones that a square gathers from, and the sums that it gathers into.
pub(super) struct Gather<'a> {
    pub(super) square: &'a Square,
    /// Indices of splats.
    pub(super) list: &'a [u32],
    pub(super) splats: &'a [StrokeSplat],
    pub(super) tones: &'a Tones,
    pub(super) squarings: u32,
    /// Weight of the lowest furrow, before it is squared, relative to the highest ridge.
    pub(super) furrow: f32,
    /// Whether splats have colours of their own.
    pub(super) colored: bool,
    /// Whether we look up the map. If not, we sum only the weights of all splats.
    pub(super) textured: bool,
    pub(super) into: &'a mut Gathered,
}

impl Sums {
    fn new() -> Self {
        Self {
            bytes: [[[0.0; 4]; SIDE]; SIDE],
            color: [[[0.0; 3]; SIDE]; SIDE],
            weight: [[0.0; SIDE]; SIDE],
            cover: [[0.0; SIDE]; SIDE],
            total: [[0.0; SIDE]; SIDE],
            parts: Vec::new(),
        }
    }

    fn clear(&mut self) {
        if self.parts.is_empty() {
            return;
        }
        let parts = std::mem::take(&mut self.parts);
        *self = Self { parts, ..Self::new() };
        self.parts.clear();
    }

    /// Whether any splat has weight.
    pub(super) fn any(&self) -> bool {
        !self.parts.is_empty()
    }

    /// Adds a splat with its weights. For a weight of 1, it adds `cover` to the cover.
    #[inline(always)]
    fn add(&mut self, number: u32, weight: Values, shape: &Values, cover: f32) {
        for row in 0..SIDE {
            for column in 0..SIDE {
                self.total[row][column] += weight[row][column];
                self.cover[row][column] += shape[row][column] * cover;
            }
        }
        self.parts.push((number, weight));
    }
}

impl Gathered {
    /// Empty sums. You can use them for one square after the other.
    pub(super) fn new() -> Self {
        Self { on: Sums::new(), before: Sums::new(), raised: Vec::new() }
    }
}

impl pulp::WithSimd for Gather<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { square, list, splats, tones, squarings, furrow, colored, textured, into } = self;
        into.on.clear();
        into.before.clear();
        into.raised.clear();
        for &number in list {
            let splat = &splats[number as usize];
            let lie = square.lie(splat);
            if lie == Lie::Hidden {
                continue;
            }
            let shape = square.shape(splat);
            let cover = splat.cover / splat.weight;
            if lie == Lie::On {
                into.on.add(number, powered(shape, squarings), &shape, cover);
                continue;
            }
            let plane = square.plane(splat);
            let [on, before] = square.shares(splat, &plane);
            if any(&on) {
                let weight = times(&powered(shape, squarings), &on);
                into.on.add(number, weight, &times(&shape, &on), cover);
            }
            if any(&before) {
                let raised = times(&shape, &before);
                into.raised.push((number, bowl(splat, &plane, &raised), shape));
            }
        }
        raise(square, splats, squarings, into);
        if textured {
            sum(square, splats, (tones, furrow), colored, &mut into.on);
            sum(square, splats, (tones, furrow), colored, &mut into.before);
        }
    }
}

/// Adds the weights of the splats that reach out in front of the mesh. Only splats of the nearest
/// surface count.
#[inline(always)]
fn raise(square: &Square, splats: &[StrokeSplat], squarings: u32, into: &mut Gathered) {
    let mut nearest = [[f32::INFINITY; SIDE]; SIDE];
    into.raised.iter().for_each(|(_, bowl, _)| bring_forward(&mut nearest, bowl));
    for (number, bowl, shape) in &into.raised {
        let splat = &splats[*number as usize];
        let [_, before] = square.shares(splat, &square.plane(splat));
        let share = times(&before, &nearness(splat, &nearest, bowl));
        let weight = times(&powered(*shape, squarings), &share);
        let cover = splat.cover / splat.weight;
        into.before.add(*number, weight, &times(shape, &share), cover);
    }
}

#[inline(always)]
fn sum(
    square: &Square,
    splats: &[StrokeSplat],
    (tones, furrow): (&Tones, f32),
    colored: bool,
    into: &mut Sums,
) {
    let Sums { bytes, color, weight: weights, total, parts, .. } = into;
    shown(square, splats, (tones, furrow), (parts, total), |part| {
        let Part { splat, pixel: [row, column], texel, weight, .. } = part;
        let sums = bytes[row][column].iter_mut().zip(texel);
        sums.for_each(|(sum, value)| *sum += value * weight);
        if colored {
            let sums = color[row][column].iter_mut().zip(splat.color);
            sums.for_each(|(sum, value)| *sum += value * weight);
        }
        weights[row][column] += weight;
    });
}

/// The texel and weight of a splat at a pixel of a square.
pub(super) struct Part<'a> {
    pub(super) splat: &'a StrokeSplat,
    /// Row and column of the pixel.
    pub(super) pixel: [usize; 2],
    /// Column and row of the texel to the upper left.
    pub(super) place: [usize; 2],
    /// Weights of the next texels, to the right and below, in 256ths.
    pub(super) share: [u32; 2],
    /// Bytes of the map, times 256.
    pub(super) texel: [f32; 4],
    pub(super) weight: f32,
}

/// Calls `with` for all splats of a surface, in their order, and the pixels where their weights
/// matter.
#[inline(always)]
pub(super) fn shown<'a>(
    square: &Square,
    splats: &'a [StrokeSplat],
    (tones, furrow): (&Tones, f32),
    (parts, total): (&[(u32, Values)], &Values),
    mut with: impl FnMut(Part<'a>),
) {
    let mut least = *total;
    least.iter_mut().flatten().for_each(|value| *value *= NEGLIGIBLE);
    // Maps without relief have a height of 0 everywhere.
    let furrow = if tones.step[3] > 0.0 { furrow } else { 1.0 };
    let ridges = (1.0 - furrow) / (256.0 * 255.0);
    for (number, part) in parts {
        let splat = &splats[*number as usize];
        let texels = tones.texels(splat.slice as usize, splat.halvings as usize);
        // In texels, from the centre of the first one.
        let size = texels.size as f32;
        let offset = splat.offset.map(|at| at - 0.5 / size);
        let left = square.first[0] - splat.x;
        for row in 0..SIDE {
            let weight = &part[row];
            let least = &least[row];
            let mut matters = false;
            for column in 0..SIDE {
                matters |= weight[column] > least[column];
            }
            if !matters {
                continue;
            }
            let down = square.first[1] - splat.y + row as f32;
            let mut place = [[0_i32; SIDE]; 2];
            let mut share = [[0_i32; SIDE]; 2];
            for (axis, coordinate) in [splat.across, splat.along].into_iter().enumerate() {
                let first = offset[axis]
                    + splat.extent[axis] * (coordinate[0] * left + coordinate[1] * down);
                let step = splat.extent[axis] * coordinate[0];
                for column in 0..SIDE {
                    let at = first + step * column as f32;
                    let at = (at - at.floor()) * size;
                    let texel = lesser(at.floor(), size - 1.0);
                    place[axis][column] = texel as i32;
                    share[axis][column] = (256.0 * lesser(at - texel, 1.0)) as i32;
                }
            }
            for column in 0..SIDE {
                let own_weight = weight[column] - least[column];
                if own_weight <= 0.0 {
                    continue;
                }
                let [u, v] = [place[0][column] as usize, place[1][column] as usize];
                let [a, b] = [share[0][column] as u32, share[1][column] as u32];
                let texel = texels.interpolated(u, v, a, b);
                let high = furrow + texel[3] * ridges;
                let own_weight = own_weight * high * high;
                let pixel = [row, column];
                let place = [u, v];
                let share = [a, b];
                with(Part { splat, pixel, place, share, texel, weight: own_weight });
            }
        }
    }
}

/// Weights times [`SCALE`], squared `squarings` times.
#[inline(always)]
fn powered(mut weights: Values, squarings: u32) -> Values {
    weights.iter_mut().flatten().for_each(|weight| *weight *= SCALE);
    for _ in 0..squarings {
        weights = times(&weights, &weights);
    }
    weights
}

#[inline(always)]
fn times(one: &Values, other: &Values) -> Values {
    let mut product = [[0.0; SIDE]; SIDE];
    for row in 0..SIDE {
        for column in 0..SIDE {
            product[row][column] = one[row][column] * other[row][column];
        }
    }
    product
}

#[inline(always)]
fn any(values: &Values) -> bool {
    values.iter().flatten().fold(0.0, |most, &value| greater(value, most)) > 0.0
}

/// Where the cover is below this, the strokes of the lowest layer thin out.
pub(super) const THIN: f32 = 1e-3;

/// Between these sums of weights, strokes beyond an outline change from no cover to full cover.
/// This holds for an overhang of 0. With a full overhang the first sum is 0.
const OVERHANG: [f32; 2] = [0.7, 0.9];

/// How much further the highest ridges of a stroke reach beyond an outline than its furrows.
const BRISTLES: f32 = 1.0;

#[derive(Debug, Clone, Copy)]
pub(super) struct Divide<'a> {
    pub(super) tones: &'a Tones,
    pub(super) coloring: &'a Coloring,
    /// How far strokes reach beyond outlines, 0 to 1.
    pub(super) overhang: f32,
    /// Strokes on the mesh end where the cover falls to about this. Above 0. Values up to [`THIN`]
    /// mean the lowest layer.
    pub(super) thin: f32,
}

impl Divide<'_> {
    /// The pixel of a square: encoded sRGB with cover, and height. `covered` says whether you see
    /// the mesh there. Then it is never bare where any stroke reaches.
    #[inline(always)]
    pub(super) fn pixel(
        &self,
        gathered: &Gathered,
        covered: bool,
        (row, column): (usize, usize),
    ) -> ([f32; 4], f32) {
        let [over, rest] = self.shares(gathered, covered, (row, column));
        let on = self.surface(&gathered.on, row, column);
        if over <= 0.0 {
            return ([on.x, on.y, on.z, rest], on.w * rest);
        }
        let before = self.surface(&gathered.before, row, column);
        let cover = over + rest;
        let mixed = (before * over + on * rest) / cover;
        ([mixed.x, mixed.y, mixed.z, cover], before.w * over + on.w * rest)
    }

    /// Shares of a pixel that show strokes in front of the mesh, and strokes on it.
    #[inline(always)]
    pub(super) fn shares(
        &self,
        gathered: &Gathered,
        covered: bool,
        (row, column): (usize, usize),
    ) -> [f32; 2] {
        #[inline(always)]
        fn cover(sums: &Sums, column: usize, row: usize) -> f32 {
            match sums.weight[row][column] > LOST {
                true => sums.cover[row][column],
                false => 0.0,
            }
        }
        let under = match self.lowest() {
            true => (cover(&gathered.on, column, row) * (1.0 / THIN)).min(1.0),
            // Ridges of strokes on others reach further than furrows too.
            false => {
                let ridge = self.ridge(&gathered.on, row, column) - 0.5;
                let on = cover(&gathered.on, column, row) * (1.0 + BRISTLES * ridge);
                smoothstep([0.5 * self.thin, 1.5 * self.thin], on)
            }
        };
        let out = cover(&gathered.before, column, row);
        let over = if self.overhang > 0.0 && out > 0.0 {
            // The ridges of a stroke reach further than its furrows.
            let out = out * (1.0 + BRISTLES * (self.ridge(&gathered.before, row, column) - 0.5));
            let start = OVERHANG[0] * (1.0 - self.overhang);
            smoothstep([start, start + OVERHANG[1] - OVERHANG[0]], out)
        } else {
            0.0
        };
        let bare =
            if covered && self.lowest() && out > 0.0 { (1.0 - over) * (1.0 - under) } else { 0.0 };
        let over = over + bare;
        if over <= 0.0 { [0.0, under] } else { [over, (1.0 - over) * under] }
    }

    /// Whether these are the strokes of the lowest layer.
    #[inline(always)]
    fn lowest(&self) -> bool {
        self.thin <= THIN
    }

    /// How high the brushwork stands, 0 to 1 of the map's heights. For maps without relief this is
    /// the lightness.
    #[inline(always)]
    fn ridge(&self, sums: &Sums, row: usize, column: usize) -> f32 {
        let channel = if self.tones.step[3] > 0.0 { 3 } else { 0 };
        let weight = sums.weight[row][column];
        if weight > LOST { sums.bytes[row][column][channel] / (65_280.0 * weight) } else { 0.0 }
    }

    /// Encoded sRGB and height of one surface, zeros where it has no stroke.
    #[inline(always)]
    fn surface(&self, sums: &Sums, row: usize, column: usize) -> Vec4 {
        let weight = sums.weight[row][column];
        if weight <= LOST {
            return Vec4::ZERO;
        }
        let bytes = sums.bytes[row][column].map(|sum| sum * (1.0 / (256.0 * weight)));
        let [x, y, z, height] = self.tones.values(bytes);
        let color = Vec3::new(x, y, z) + Vec3::from(sums.color[row][column]) / weight;
        self.coloring.shown(color).extend(height)
    }
}
