//! Mean shift in the joint domain of position and colour.
//!
//! A step moves a point to the mean of all pixels in its window: those within the distance
//! h_s in the picture and h_r in colour. The kernel is flat, so its shadow is the
//! Epanechnikov kernel (Comaniciu and Meer 2002, equations 17, 20 and 35).

use super::luv::LuvPlanes;
use pulp::Simd;

/// Radii of the window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bandwidth {
    /// h_s: radius in the picture, in pixels.
    pub(super) spatial_px: f32,
    /// h_r: radius in colour, as a difference in CIELUV.
    pub(super) range: f32,
}

/// Largest number of f32 lanes in a vector of any machine.
pub(super) const MOST_LANES: usize = 16;

/// A point of the joint domain, such as a pixel or a mode, or the difference of two points.
/// `x` and `y` are in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Mode {
    pub(super) x: f32,
    pub(super) y: f32,
    /// L*, u*, v*.
    pub(super) color: [f32; 3],
}

impl Mode {
    /// The point moved by `step`.
    pub(super) fn moved(self, step: Self) -> Self {
        let color = [0, 1, 2].map(|i| self.color[i] + step.color[i]);
        Self { x: self.x + step.x, y: self.y + step.y, color }
    }
}

/// The difference from `at` to the mean of the pixels in its window. `None` if the window
/// has no pixel.
#[inline(always)]
pub(super) fn step<S: Simd>(
    simd: S,
    planes: &LuvPlanes,
    at: Mode,
    Bandwidth { spatial_px, range }: Bandwidth,
) -> Option<Mode> {
    // Index of each lane.
    const LANES: [f32; MOST_LANES] =
        [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0];
    let lane = S::as_simd_f32s(&LANES).0[0];
    let zero = simd.splat_f32s(0.0);
    let one = simd.splat_f32s(1.0);
    let lanes = simd.splat_f32s(S::F32_LANES as f32);
    let [at_l, at_u, at_v] = at.color.map(|value| simd.splat_f32s(value));
    let most = simd.splat_f32s(range * range);
    let [mut sum_l, mut sum_u, mut sum_v, mut sum_x, mut sum_y, mut count] = [zero; 6];
    let [first, last] = [(at.y - spatial_px).ceil() as isize, (at.y + spatial_px) as isize];
    for row in first..=last {
        let dy = row as f32 - at.y;
        let half = (spatial_px * spatial_px - dy * dy).max(0.0).sqrt();
        let left = (at.x - half).ceil();
        let cells = (at.x + half - left).floor() as isize + 1;
        if cells <= 0 {
            continue;
        }
        let cells = (cells as usize).next_multiple_of(S::F32_LANES);
        let row = row.wrapping_add_unsigned(planes.margin) as usize;
        let start = (left as isize).wrapping_add_unsigned(planes.margin) as usize;
        let start = row * planes.stride + start;
        let [l, u, v] =
            [0, 1, 2].map(|plane| S::as_simd_f32s(&planes.values[plane][start..start + cells]).0);
        let mut dx = simd.add_f32s(lane, simd.splat_f32s(left - at.x));
        let half = simd.splat_f32s(half);
        let dy = simd.splat_f32s(dy);
        for ((&l, &u), &v) in l.iter().zip(u).zip(v) {
            let l = simd.sub_f32s(l, at_l);
            let u = simd.sub_f32s(u, at_u);
            let v = simd.sub_f32s(v, at_v);
            let apart = simd.mul_add_e_f32s(u, u, simd.mul_f32s(v, v));
            let apart = simd.mul_add_e_f32s(l, l, apart);
            let near = simd.less_than_or_equal_f32s(apart, most);
            let near = simd.and_m32s(near, simd.less_than_or_equal_f32s(dx, half));
            let one = simd.select_f32s(near, one, zero);
            sum_l = simd.mul_add_e_f32s(one, l, sum_l);
            sum_u = simd.mul_add_e_f32s(one, u, sum_u);
            sum_v = simd.mul_add_e_f32s(one, v, sum_v);
            sum_x = simd.mul_add_e_f32s(one, dx, sum_x);
            sum_y = simd.mul_add_e_f32s(one, dy, sum_y);
            count = simd.add_f32s(one, count);
            dx = simd.add_f32s(dx, lanes);
        }
    }
    let count = simd.reduce_sum_f32s(count);
    if count == 0.0 {
        return None;
    }
    let mean = |sum| simd.reduce_sum_f32s(sum) / count;
    Some(Mode { x: mean(sum_x), y: mean(sum_y), color: [mean(sum_l), mean(sum_u), mean(sum_v)] })
}
