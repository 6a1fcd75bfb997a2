//! Upright samples: all channels of a passage through one resampling.

use graphics::field::Field;
use graphics::picture::Picture;
use graphics::tile::Rect;
use paint::layer::SLOTS;

use super::frame::{Frame, Tap};
use super::source::SourcePicture;
use crate::sample::TexelPaint;

/// Channels of an upright passage, cut to the extent of its mask.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Upright {
    pub(super) color: Picture,
    pub(super) paint: Option<Field<TexelPaint>>,
    pub(super) height_mm: Option<Field<f32>>,
    pub(super) mask: Field<bool>,
}

/// All channels of one texel.
#[derive(Debug, Clone, Copy, Default)]
struct Texel {
    color: [f32; 3],
    paint: TexelPaint,
    height_mm: f32,
}

/// The passage `mask` of a picture in `frame`.
///
/// Colours are blended in linear light, paint and heights as mm: means over the area of a texel
/// inside of the passage. Texels outside of it are zeros.
pub(super) fn upright(source: &SourcePicture, mask: &Field<bool>, frame: &Frame) -> Upright {
    let texels = cut_to_extent(frame.resampled(mask, |taps| gathered(source, taps)));
    let width = texels.width();
    let height = texels.height();
    Upright {
        color: channel(&texels, |texel| texel.color),
        paint: source.paint.as_ref().map(|_| channel(&texels, |texel| texel.paint)),
        height_mm: source.height_mm.as_ref().map(|_| channel(&texels, |texel| texel.height_mm)),
        mask: Field::from_values(
            width,
            height,
            texels.values().iter().map(Option::is_some).collect(),
        ),
    }
}

fn gathered(source: &SourcePicture, taps: &[Tap]) -> Texel {
    let mut texel = Texel::default();
    for &(pixel, weight) in taps {
        let color = source.color.values()[pixel];
        (0..3).for_each(|i| texel.color[i] += weight * color[i]);
        if let Some((paint, _)) = &source.paint {
            let paint = &paint.values()[pixel];
            (0..SLOTS).for_each(|i| texel.paint.pigments_mm[i] += weight * paint.pigments_mm[i]);
            texel.paint.vehicle_mm += weight * paint.vehicle_mm;
        }
        if let Some(height) = &source.height_mm {
            texel.height_mm += weight * height.values()[pixel];
        }
    }
    texel
}

fn channel<T: Default>(texels: &Field<Option<Texel>>, of: impl Fn(&Texel) -> T) -> Field<T> {
    let values = texels.values().iter().map(|texel| texel.as_ref().map_or(T::default(), &of));
    Field::from_values(texels.width(), texels.height(), values.collect())
}

/// The rows and columns that hold a texel of the passage.
fn cut_to_extent(texels: Field<Option<Texel>>) -> Field<Option<Texel>> {
    let width = texels.width();
    let height = texels.height();
    let full_column = |x: &usize| (0..height).any(|y| texels[(*x, y)].is_some());
    let full_row = |y: &usize| texels.row(*y, 0, width).iter().any(Option::is_some);
    let columns = (0..width).find(full_column).zip((0..width).rev().find(full_column));
    let rows = (0..height).find(full_row).zip((0..height).rev().find(full_row));
    match (columns, rows) {
        (Some((left, right)), Some((top, bottom))) => {
            texels.part(Rect { x: left, y: top, width: right - left + 1, height: bottom - top + 1 })
        }
        // Passages of single pixels in a row may be lost where a sample is made smaller.
        _ => Field::filled(0, 0, None),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use pigment::library::PigmentLibrary;

    use super::*;
    use crate::sample::PaintOfSamples;

    /// A picture of all channels, with other values inside of a disc than outside.
    fn disc() -> (SourcePicture, Field<bool>) {
        let inside = |i: usize| {
            let x = (i % 60) as f64 - 30.0;
            let y = (i / 60) as f64 - 25.0;
            x.hypot(y) < 20.0
        };
        let field = |value: &dyn Fn(bool) -> f32| -> Field<f32> {
            Field::from_values(60, 50, (0..3000).map(|i| value(inside(i))).collect())
        };
        let mask = Field::from_values(60, 50, (0..3000).map(inside).collect());
        let height = field(&|inside| if inside { 0.4 } else { 9.0 });
        let color = height.values().iter().map(|&h| [h, 0.5 * h, 0.1]).collect();
        let paint = height.values().iter().map(|&h| TexelPaint {
            pigments_mm: [h, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0 * h],
            vehicle_mm: 0.5 * h,
        });
        let paint_of = PaintOfSamples {
            library: Arc::new(PigmentLibrary::van_gogh_oils()),
            slots: Default::default(),
        };
        let source = SourcePicture {
            paint: Some((Field::from_values(60, 50, paint.collect()), paint_of)),
            height_mm: Some(height),
            ..SourcePicture::of_colors(Field::from_values(60, 50, color), "a disc")
        };
        (source, mask)
    }

    /// Gives pixels the values that the disc has inside.
    fn spur_like_disc(mut source: SourcePicture, pixels: &[usize]) -> SourcePicture {
        let middle = 25 * 60 + 30;
        for &pixel in pixels {
            source.color.values_mut()[pixel] = source.color.values()[middle];
            if let Some(height) = &mut source.height_mm {
                height.values_mut()[pixel] = height.values()[middle];
            }
            if let Some((paint, _)) = &mut source.paint {
                paint.values_mut()[pixel] = paint.values()[middle];
            }
        }
        source
    }

    #[test]
    fn nothing_bleeds_in_and_heights_stay_mm() {
        let (source, mut mask) = disc();
        // A thin spur of the passage, which is lost where the sample is made smaller.
        let spur: Vec<usize> = (2..10).map(|x| 25 * 60 + x).collect();
        for &pixel in &spur {
            mask.values_mut()[pixel] = true;
        }
        let source = spur_like_disc(source, &spur);
        for (degrees, scale) in
            [(90.0, [1.0; 2]), (37.0, [1.0; 2]), (120.0, [0.4; 2]), (15.0, [2.5, 1.0])]
        {
            let (sin, cos) = f64::to_radians(degrees).sin_cos();
            let found = upright(&source, &mask, &Frame::around(&mask, [cos, sin], scale));
            let height = found.height_mm.unwrap();
            let paint = found.paint.unwrap();
            let area = 400.0 * std::f64::consts::PI * scale[0] * scale[1];
            let count = found.mask.values().iter().filter(|inside| **inside).count() as f64;
            assert!((count / area - 1.0).abs() < 0.05, "{degrees}: {count} texels of {area}");
            for (texel, &inside) in found.mask.values().iter().enumerate() {
                let wanted = if inside { 0.4 } else { 0.0 };
                let paint = paint.values()[texel];
                for (value, share) in [
                    (height.values()[texel], 1.0),
                    (found.color.values()[texel][0], 1.0),
                    (found.color.values()[texel][1], 0.5),
                    (paint.pigments_mm[0], 1.0),
                    (paint.pigments_mm[7], 2.0),
                    (paint.vehicle_mm, 0.5),
                ] {
                    assert!((value - share * wanted).abs() < 1e-5, "{degrees}: {value} {share}");
                }
            }
            let width = found.mask.width();
            let rows = found.mask.height();
            for y in [0, rows - 1] {
                assert!((0..width).any(|x| found.mask[(x, y)]), "row {y} should be cut off");
            }
            for x in [0, width - 1] {
                assert!((0..rows).any(|y| found.mask[(x, y)]), "column {x} should be cut off");
            }
        }
    }
}
