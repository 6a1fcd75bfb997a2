//! Orientation field of a picture: the direction along edges, extended into flat regions.
//!
//! We smooth the structure tensor of all three channels (Di Zenzo 1986). Its minor eigenvector is
//! the direction (Kyprianidis and Kang 2011). Litwinowicz 1997 interpolates directions from strong
//! gradients into flat regions. Here we spread the tensor itself by Gaussians of doubling width
//! and falling weight. Together they decay like a power of the distance, so that stronger and
//! nearer edges dominate.

use rayon::prelude::*;

use crate::field::{Field, blurred};

/// Weight of each Gaussian relative to the one half as wide. We chose it by eye.
const WIDER: f32 = 0.25;

/// Orientation of edges at every cell, as a unit vector of arbitrary sign.
#[derive(Debug, Clone, PartialEq)]
pub struct OrientationField {
    along: Field<[f32; 2]>,
    agreement: Field<f32>,
}

impl OrientationField {
    /// Computes the field of a CIELAB picture. This smooths the tensor by a Gaussian of standard
    /// deviation `sigma`, in cells.
    #[must_use]
    pub fn from_lab(lab: &Field<[f32; 3]>, sigma: f64) -> Self {
        let width = lab.width();
        let height = lab.height();
        let tensor = tensor(lab);
        let mut sum = blurred(&tensor, sigma);
        let mut wider = 2.0 * sigma.max(0.5);
        let mut weight = WIDER;
        while wider < width.max(height) as f64 {
            let spread = blurred(&tensor, wider);
            let pairs = sum.values_mut().par_iter_mut().zip(spread.values());
            pairs.for_each(|(sum, spread)| {
                sum.iter_mut().zip(spread).for_each(|(sum, value)| *sum += weight * value);
            });
            wider *= 2.0;
            weight *= WIDER;
        }
        let along = sum.values().par_iter().map(weak_direction).collect();
        let agreement = sum.values().par_iter().map(agreement).collect();
        Self {
            along: Field::from_values(width, height, along),
            agreement: Field::from_values(width, height, agreement),
        }
    }

    /// Unit vector along the edge at a cell: x to the right, y down.
    #[must_use]
    pub fn direction(&self, x: usize, y: usize) -> [f64; 2] {
        self.along[(x, y)].map(f64::from)
    }

    /// How far the gradients around a cell agree in direction, from 0 (not at all) to 1 (fully).
    #[must_use]
    pub fn agreement(&self, x: usize, y: usize) -> f32 {
        self.agreement[(x, y)]
    }
}

/// Structure tensor: squares and product of the gradient's components, summed over the
/// channels.
fn tensor(lab: &Field<[f32; 3]>) -> Field<[f32; 3]> {
    let width = lab.width();
    let height = lab.height();
    let mut tensor = Field::filled(width, height, [0.0; 3]);
    tensor.values_mut().par_chunks_mut(width).enumerate().for_each(|(y, row)| {
        let above = y.saturating_sub(1);
        let below = (y + 1).min(height - 1);
        for (x, cell) in row.iter_mut().enumerate() {
            let left = x.saturating_sub(1);
            let right = (x + 1).min(width - 1);
            for channel in 0..3 {
                let sides = [left, right].map(|x| [(x, above), (x, y), (x, below)]);
                let over_x = slope(lab, channel, sides);
                let sides = [above, below].map(|y| [(left, y), (x, y), (right, y)]);
                let over_y = slope(lab, channel, sides);
                cell[0] += over_x * over_x;
                cell[1] += over_x * over_y;
                cell[2] += over_y * over_y;
            }
        }
    });
    tensor
}

/// Change from one side of a pixel to the other. Scharr's weights have the least error in
/// direction (Jaehne 1999).
fn slope(lab: &Field<[f32; 3]>, channel: usize, sides: [[(usize, usize); 3]; 2]) -> f32 {
    let [from, to] = sides.map(|[first, middle, last]| {
        3.0 * (lab[first][channel] + lab[last][channel]) + 10.0 * lab[middle][channel]
    });
    (to - from) / 32.0
}

/// Difference of the tensor's eigenvalues over their sum. This is 0 where there is no gradient.
fn agreement(tensor: &[f32; 3]) -> f32 {
    let [xx, xy, yy] = *tensor;
    if xx + yy < 1e-12 {
        return 0.0;
    }
    ((xx - yy).powi(2) + 4.0 * xy * xy).sqrt() / (xx + yy)
}

/// Minor eigenvector of the tensor. Where there is no gradient, this points along x.
fn weak_direction(tensor: &[f32; 3]) -> [f32; 2] {
    let [xx, xy, yy] = tensor.map(f64::from);
    if xx + yy < 1e-12 {
        return [1.0, 0.0];
    }
    let (sin, cos) = (0.5 * (2.0 * xy).atan2(xx - yy)).sin_cos();
    [-sin as f32, cos as f32]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grating_is_followed_and_spreads_into_the_flat() {
        for degrees in [0.0_f64, 30.0, 75.0, 120.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let values = (0..96 * 96).map(|i| {
                let x = (i % 96) as f64;
                let y = (i / 96) as f64;
                // Waves perpendicular to the direction, within a disc.
                let inside = (x - 48.0).hypot(y - 48.0) < 24.0;
                let wave = ((y * cos - x * sin) * 0.7).sin();
                [if inside { 50.0 + 10.0 * wave as f32 } else { 50.0 }, 0.0, 0.0]
            });
            let flow =
                OrientationField::from_lab(&Field::from_values(96, 96, values.collect()), 4.0);
            for (x, y) in [(48, 48), (40, 52), (56, 44)] {
                let [u, v] = flow.direction(x, y);
                let across = (v * cos - u * sin).abs();
                assert!(flow.agreement(x, y) > 0.8, "{}", flow.agreement(x, y));
                assert!(across < 5.0_f64.to_radians().sin(), "{degrees}: {u} {v} at {x}, {y}");
            }
        }
    }

    #[test]
    fn an_even_picture_flows_along_x() {
        let flow = OrientationField::from_lab(&Field::filled(20, 10, [40.0, 1.0, 2.0]), 2.0);
        assert_eq!(flow.direction(5, 5), [1.0, 0.0]);
        assert_eq!(flow.agreement(5, 5), 0.0);
    }
}
