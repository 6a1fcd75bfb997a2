//! Enlargement of flat regions with crisp outlines.
//!
//! Each pixel weighs the colours around it by a cubic B-spline and takes the heaviest one, so
//! that outlines are smooth curves. Where the two heaviest are nearly equal they mix, over
//! about a pixel.

use rayon::prelude::*;

use graphics::field::Field;

/// The picture `flat` in `width` x `height` pixels, as many as it has or more.
pub(crate) fn enlarged(flat: &Field<[f32; 4]>, width: usize, height: usize) -> Field<[f32; 4]> {
    if (flat.width(), flat.height()) == (width, height) {
        return flat.clone();
    }
    let enlarged = Enlarged::new(flat, width, height);
    let mut picture = Field::filled(width, height, [0.0; 4]);
    picture.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
        row.iter_mut().enumerate().for_each(|(x, out)| *out = enlarged.at(x, y));
    });
    picture
}

/// A flat picture, seen on a grid of another size.
pub(super) struct Enlarged<'a> {
    flat: &'a Field<[f32; 4]>,
    /// Pixels of the flat picture per pixel of the enlarged one.
    step: [f32; 2],
}

impl<'a> Enlarged<'a> {
    /// The picture `flat` on a grid of `width` x `height` pixels, as many as it has or more.
    pub(super) fn new(flat: &'a Field<[f32; 4]>, width: usize, height: usize) -> Self {
        let step = [
            flat.width() as f32 / width.max(1) as f32,
            flat.height() as f32 / height.max(1) as f32,
        ];
        Self { flat, step }
    }

    /// The colour of a pixel.
    pub(super) fn at(&self, x: usize, y: usize) -> [f32; 4] {
        let [(columns, across), (rows, down)] = self.taps(x, y);
        let middle = self.flat[(columns[1], rows[1])];
        let mut colors = [(middle, 0.0_f32); 16];
        let mut count = 0;
        for (row, down) in rows.into_iter().zip(down) {
            for (column, across) in columns.into_iter().zip(across) {
                let color = self.flat[(column, row)];
                let weight = across * down;
                match colors[..count].iter_mut().find(|(own, _)| *own == color) {
                    Some((_, sum)) => *sum += weight,
                    None => {
                        colors[count] = (color, weight);
                        count += 1;
                    }
                }
            }
        }
        if count == 1 {
            return colors[0].0;
        }
        let [mut first, mut second] = [(middle, 0.0_f32); 2];
        for &own in &colors[..count] {
            if own.1 > first.1 {
                (first, second) = (own, first);
            } else if own.1 > second.1 {
                second = own;
            }
        }
        // The difference of the weights grows by about 4/3 in a pixel of the flat picture.
        let apart = (first.1 - second.1) / (4.0 / 3.0 * self.step[0]);
        let share = (0.5 - apart).clamp(0.0, 0.5);
        super::wet::mixed(first.0, second.0, share)
    }

    /// A smooth picture of the size of the flat one at a pixel, interpolated linearly.
    pub(super) fn smooth<const N: usize>(
        &self,
        picture: &Field<[f32; N]>,
        x: usize,
        y: usize,
    ) -> [f32; N] {
        let place = |at: usize, step: f32, size: usize| {
            let at = ((at as f32 + 0.5) * step - 0.5).clamp(0.0, (size - 1) as f32);
            let low = at as usize;
            (low, (low + 1).min(size - 1), at - low as f32)
        };
        let (left, right, a) = place(x, self.step[0], picture.width());
        let (above, below, b) = place(y, self.step[1], picture.height());
        let corners = [(left, above), (right, above), (left, below), (right, below)];
        let [p, q, r, s] = corners.map(|corner| picture[corner]);
        std::array::from_fn(|i| {
            let upper = p[i] + (q[i] - p[i]) * a;
            let lower = r[i] + (s[i] - r[i]) * a;
            upper + (lower - upper) * b
        })
    }

    /// Columns and rows around a pixel, each with its weights.
    fn taps(&self, x: usize, y: usize) -> [([usize; 4], [f32; 4]); 2] {
        let axis = |at: usize, step: f32, size: usize| {
            let place = (at as f32 + 0.5) * step - 0.5;
            let low = place.floor();
            let cells =
                [-1.0, 0.0, 1.0, 2.0].map(|by| (low + by).clamp(0.0, (size - 1) as f32) as usize);
            (cells, b_spline(place - low))
        };
        [axis(x, self.step[0], self.flat.width()), axis(y, self.step[1], self.flat.height())]
    }
}

/// Weights of the cubic B-spline at the share `t` between the second and third of four cells.
fn b_spline(t: f32) -> [f32; 4] {
    let u = 1.0 - t;
    let square = |t: f32| (3.0 * t - 6.0) * t * t + 4.0;
    [u * u * u, square(t), square(u), t * t * t].map(|weight| weight / 6.0)
}
