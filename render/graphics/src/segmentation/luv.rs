//! Conversion of a picture to CIELUV in f32, with a margin so that windows need no clipping.

use rayon::prelude::*;
use spectra::color::{Rgb, RgbSpace};

use crate::field::Field;

/// L* of cells outside the picture, so far from every colour that no window contains them.
const NOWHERE: f32 = 1e6;

/// L*, u* and v* relative to the white of sRGB; each is a plane with a margin on all sides.
pub(super) struct LuvPlanes {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Width of the margin in cells. No window contains a cell of the margin.
    pub(super) margin: usize,
    /// Distance from one row to the next, in cells.
    pub(super) stride: usize,
    pub(super) values: [Vec<f32>; 3],
}

impl LuvPlanes {
    /// Converts encoded sRGB with coverage, composited on white. `margin` is in cells.
    pub(super) fn new(picture: &Field<[f32; 4]>, margin: usize) -> Self {
        let width = picture.width();
        let height = picture.height();
        let stride = width + 2 * margin;
        let luv = LuvOfSrgb::new();
        let mut values = [(); 3].map(|()| vec![NOWHERE; stride * (height + 2 * margin)]);
        let [lightness, u, v] = &mut values;
        let rows = lightness
            .par_chunks_mut(stride)
            .zip(u.par_chunks_mut(stride))
            .zip(v.par_chunks_mut(stride))
            .skip(margin)
            .take(height);
        rows.enumerate().for_each(|(y, ((lightness, u), v))| {
            for (x, pixel) in picture.row(y, 0, width).iter().enumerate() {
                let [r, g, b, coverage] = *pixel;
                let over_white = [r, g, b].map(|c| 1.0 - coverage * (1.0 - c));
                [lightness[margin + x], u[margin + x], v[margin + x]] = luv.of(over_white);
            }
        });
        Self { width, height, margin, stride, values }
    }

    /// The colour of a pixel.
    pub(super) fn at(&self, x: usize, y: usize) -> [f32; 3] {
        let cell = (y + self.margin) * self.stride + x + self.margin;
        [0, 1, 2].map(|plane| self.values[plane][cell])
    }
}

/// Number of steps in the table of the sRGB transfer curve.
const STEPS: usize = 4096;

/// Conversion of encoded sRGB to CIELUV, within 1e-3 of the conversion in f64 (tested).
struct LuvOfSrgb {
    /// Linear light at equal steps of the encoded value, 0 to 1; the last entry is repeated.
    linear: Vec<f32>,
    /// Matrix from linear sRGB to X, Y, Z, scaled so that white has Y = 1.
    xyz: [[f32; 3]; 3],
    /// u' and v' of white.
    white: [f32; 2],
}

impl LuvOfSrgb {
    fn new() -> Self {
        let decoded = |step: usize| Rgb([step.min(STEPS) as f64 / STEPS as f64; 3]).linear().0[0];
        let xyz = RgbSpace::Srgb.xyz_from_linear().0.map(|row| row.map(|x| (x / 100.0) as f32));
        let white = RgbSpace::Srgb.white();
        let sum = white.x + 15.0 * white.y + 3.0 * white.z;
        Self {
            linear: (0..=STEPS + 1).map(|step| decoded(step) as f32).collect(),
            xyz,
            white: [4.0 * white.x / sum, 9.0 * white.y / sum].map(|x| x as f32),
        }
    }

    /// L*, u*, v* of `rgb`, which is clamped to 0..1.
    fn of(&self, rgb: [f32; 3]) -> [f32; 3] {
        let linear = rgb.map(|value| {
            let place = value.clamp(0.0, 1.0) * STEPS as f32;
            let step = place as usize;
            let low = self.linear[step];
            let high = self.linear[step + 1];
            low + (place - step as f32) * (high - low)
        });
        let [x, y, z] =
            self.xyz.map(|row| row[0] * linear[0] + (row[1] * linear[1] + row[2] * linear[2]));
        // For dark colours the curve is a straight line, (29/3)^3 Y.
        let lightness =
            if y > 216.0 / 24389.0 { 116.0 * y.cbrt() - 16.0 } else { 24389.0 / 27.0 * y };
        let sum = x + 15.0 * y + 3.0 * z;
        if sum <= 0.0 {
            return [0.0; 3];
        }
        let scale = 13.0 * lightness;
        let [u, v] = [4.0 * x / sum - self.white[0], 9.0 * y / sum - self.white[1]];
        [lightness, scale * u, scale * v]
    }
}

#[cfg(test)]
mod tests {
    use spectra::color::Luv;

    use super::*;

    #[test]
    fn colors_are_those_of_f64() {
        let fast = LuvOfSrgb::new();
        let steps = [0.0, 1e-4, 0.01, 0.04, 0.041, 0.1, 0.3, 0.55, 0.8, 0.999, 1.0];
        let white = RgbSpace::Srgb.white();
        for r in steps {
            for g in steps {
                for b in steps {
                    let linear = Rgb([r, g, b].map(f64::from)).linear().0;
                    let xyz = RgbSpace::Srgb.xyz_from_linear().apply(linear);
                    let exact = Luv::from_xyz(xyz.into(), white).to_array();
                    for (found, exact) in fast.of([r, g, b]).into_iter().zip(exact) {
                        let off = (f64::from(found) - exact).abs();
                        assert!(off < 1e-3, "{r} {g} {b}: {found}, exactly {exact}");
                    }
                }
            }
        }
    }

    #[test]
    fn bare_paper_is_white_and_outside_is_nowhere() {
        let picture = Field::from_values(2, 1, vec![[0.2, 0.3, 0.4, 0.0], [1.0; 4]]);
        let planes = LuvPlanes::new(&picture, 2);
        assert_eq!(planes.at(0, 0), planes.at(1, 0));
        assert!((planes.at(0, 0)[0] - 100.0).abs() < 1e-3, "{:?}", planes.at(0, 0));
        let inside = planes.values[0].iter().filter(|&&l| l < NOWHERE).count();
        assert_eq!(inside, 2);
    }
}
