//! Pass 3: sums divided by their weights, shown as pixels.

use glam::{Vec3, Vec4};
use graphics::smoothstep;

use super::coloring::Coloring;
use super::gather::{Gathered, LOST, Sums};
use super::tones::Tones;

/// Cover below which the strokes of the lowest layer thin out.
pub(super) const THIN: f32 = 1e-3;

/// Sums of weights over which strokes beyond an outline come in, from none to full cover, at the
/// least overhang; the first falls to 0 at the full overhang.
const OVERHANG: [f32; 2] = [0.7, 0.9];

/// How much further the highest ridges of a stroke reach beyond an outline than its furrows.
const BRISTLES: f32 = 1.0;

/// Makes pixels of sums.
#[derive(Debug, Clone, Copy)]
pub(super) struct Divide<'a> {
    pub(super) tones: &'a Tones,
    pub(super) coloring: &'a Coloring,
    /// How far strokes reach beyond outlines, 0 to 1.
    pub(super) overhang: f32,
    /// Cover around which strokes on the mesh end, above 0; up to [`THIN`] for the lowest layer.
    pub(super) thin: f32,
}

impl Divide<'_> {
    /// The pixel of a square: encoded sRGB with cover, and height. `covered` tells whether the mesh
    /// is seen there: then it is never bare where any stroke reaches.
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

    /// Shares of a pixel that show strokes before the mesh, and strokes on it.
    #[inline(always)]
    pub(super) fn shares(
        &self,
        gathered: &Gathered,
        covered: bool,
        (row, column): (usize, usize),
    ) -> [f32; 2] {
        let cover = |sums: &Sums| match sums.weight[row][column] > LOST {
            true => sums.cover[row][column],
            false => 0.0,
        };
        let under = match self.lowest() {
            true => (cover(&gathered.on) * (1.0 / THIN)).min(1.0),
            // Ridges of strokes on others reach further than furrows too.
            false => {
                let ridge = self.ridge(&gathered.on, row, column) - 0.5;
                let on = cover(&gathered.on) * (1.0 + BRISTLES * ridge);
                smoothstep([0.5 * self.thin, 1.5 * self.thin], on)
            }
        };
        let out = cover(&gathered.before);
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

    /// Whether nothing lies below these strokes.
    #[inline(always)]
    fn lowest(&self) -> bool {
        self.thin <= THIN
    }

    /// How high the brushwork stands, 0 to 1 of the map's heights; its lightness in maps without.
    #[inline(always)]
    fn ridge(&self, sums: &Sums, row: usize, column: usize) -> f32 {
        let channel = if self.tones.step[3] > 0.0 { 3 } else { 0 };
        let weight = sums.weight[row][column];
        if weight > LOST { sums.bytes[row][column][channel] / (65_280.0 * weight) } else { 0.0 }
    }

    /// Encoded sRGB and height of one surface; zeros where it has no stroke.
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
