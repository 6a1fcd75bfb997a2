//! The lightness of a texture, as figures read it.

use graphics::blurred;
use graphics::encoding::lab_from_linear;
use graphics::field::Field;
use graphics::picture::Picture;

use crate::tiling::blurred_tile;

/// L* of a texture that tiles, or of a sample with a mask.
#[derive(Debug, Clone, PartialEq)]
pub struct Texture {
    lightness: Field<f32>,
    /// Texels that belong to it; `None` for all of a texture that tiles.
    mask: Option<Field<bool>>,
}

impl Texture {
    /// A texture of linear sRGB that tiles.
    #[must_use]
    pub fn tiled(color: &Picture) -> Self {
        Self { lightness: lightness(color), mask: None }
    }

    /// The texels of a sample, in linear sRGB, that are true in the mask.
    ///
    /// # Panics
    /// If the sizes differ.
    #[must_use]
    pub fn masked(color: &Picture, mask: &Field<bool>) -> Self {
        let size = (color.width(), color.height());
        let covered = (mask.width(), mask.height());
        assert_eq!(size, covered, "a mask must cover its sample");
        Self { lightness: lightness(color), mask: Some(mask.clone()) }
    }

    /// The texture without its variation over distances much longer than `sigma` texels: L* less
    /// its mean around each texel, weighted by a Gaussian of that deviation.
    #[must_use]
    pub fn levelled(&self, sigma: f64) -> Self {
        let means = match &self.mask {
            None => blurred_tile(&self.lightness, sigma),
            Some(mask) => masked_blur(&self.lightness, mask, sigma),
        };
        let mut lightness = self.lightness.clone();
        let pairs = lightness.values_mut().iter_mut().zip(means.values());
        pairs.for_each(|(value, mean)| *value -= mean);
        Self { lightness, mask: self.mask.clone() }
    }

    /// Width and height in texels.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.lightness.width(), self.lightness.height())
    }

    /// Mean L* of the texels that belong to it.
    #[must_use]
    pub fn tone(&self) -> f64 {
        let count = self.inside().count().max(1) as f64;
        self.inside().map(f64::from).sum::<f64>() / count
    }

    /// L* of every texel, those outside the mask too.
    #[must_use]
    pub fn lightness(&self) -> &Field<f32> {
        &self.lightness
    }

    /// L* of the texels that belong to it, row by row.
    pub(super) fn inside(&self) -> impl Iterator<Item = f32> + '_ {
        let inside = |index: usize| self.mask.as_ref().is_none_or(|mask| mask.values()[index]);
        let values = self.lightness.values().iter().enumerate();
        values.filter(move |(index, _)| inside(*index)).map(|(_, value)| *value)
    }

    /// Calls `with` with L* of every texel and of the one `step` away, where both belong to it.
    pub(super) fn pairs(&self, step: [isize; 2], mut with: impl FnMut(f32, f32)) {
        let (width, height) = self.size();
        let inside = |at: (usize, usize)| self.mask.as_ref().is_none_or(|mask| mask[at]);
        for y in 0..height {
            for x in 0..width {
                let u = x as isize + step[0];
                let v = y as isize + step[1];
                let other = if self.mask.is_none() {
                    (u.rem_euclid(width as isize) as usize, v.rem_euclid(height as isize) as usize)
                } else if u < 0 || v < 0 || u >= width as isize || v >= height as isize {
                    continue;
                } else {
                    (u as usize, v as usize)
                };
                if inside((x, y)) && inside(other) {
                    with(self.lightness[(x, y)], self.lightness[other]);
                }
            }
        }
    }
}

/// Blur of the values inside a mask; values outside give nothing.
fn masked_blur(values: &Field<f32>, mask: &Field<bool>, sigma: f64) -> Field<f32> {
    let weighed = values
        .values()
        .iter()
        .zip(mask.values())
        .map(|(value, &inside): (&f32, &bool)| {
            let weight = f32::from(inside);
            [weight * value, weight]
        })
        .collect();
    let width = values.width();
    let height = values.height();
    let sums = blurred(&Field::from_values(width, height, weighed), sigma);
    Field::from_values(
        width,
        height,
        sums.values()
            .iter()
            .map(|&[sum, weight]: &[f32; 2]| if weight > 1e-4 { sum / weight } else { 0.0 })
            .collect(),
    )
}

fn lightness(color: &Picture) -> Field<f32> {
    let lab = lab_from_linear(color);
    let values = lab.values().iter().map(|lab| lab[0]).collect();
    Field::from_values(lab.width(), lab.height(), values)
}
