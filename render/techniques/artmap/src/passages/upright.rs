//! Turns passages into upright samples. This file finds the direction of a passage's strokes,
//! estimates their distance by autocorrelation, and computes the frame, which gives the place in
//! the picture that each texel shows. All channels are resampled at once.

use graphics::blurred;
use graphics::field::Field;
use graphics::picture::Picture;
use graphics::tile::Rect;
use paint::layer::SLOTS;
use rayon::prelude::*;

use super::joining::RegionTraits;
use super::settings::SourcePicture;
use crate::sample::TexelPaint;

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Upright {
    pub(super) color: Picture,
    pub(super) paint: Option<Field<TexelPaint>>,
    pub(super) height_mm: Option<Field<f32>>,
    pub(super) mask: Field<bool>,
}

#[derive(Debug, Clone, Copy, Default)]
struct Texel {
    color: [f32; 3],
    paint: TexelPaint,
    height_mm: f32,
}

/// The passage `mask` of a picture in `frame`.
///
/// We blend colours in linear light, paint and heights as mm. Each texel is the mean over its area
/// inside the passage. Texels outside are zeros.
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

fn cut_to_extent(texels: Field<Option<Texel>>) -> Field<Option<Texel>> {
    let width = texels.width();
    let height = texels.height();
    let columns: Vec<usize> =
        (0..width).filter(|&x| (0..height).any(|y| texels[(x, y)].is_some())).collect();
    let rows: Vec<usize> =
        (0..height).filter(|&y| texels.row(y, 0, width).iter().any(Option::is_some)).collect();
    match (columns.first().zip(columns.last()), rows.first().zip(rows.last())) {
        (Some((&left, &right)), Some((&top, &bottom))) => {
            texels.part(Rect { x: left, y: top, width: right - left + 1, height: bottom - top + 1 })
        }
        // Passages of single pixels in a row may be lost where we make a sample smaller.
        _ => Field::filled(0, 0, None),
    }
}

/// Below this coherence a passage has no direction.
const LEAST_COHERENCE: f64 = 0.2;

/// Direction of the strokes of a passage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokeDirection {
    /// Angle of the strokes in degrees, 0 to 180: 0 along x, 90 along y, growing from x (right) to
    /// y (down).
    pub degrees: f64,
    /// Share of the strong gradients that agree in direction, 0 to 1.
    pub coherence: f64,
    /// Whether to turn the passage until its strokes run along y. This is false if the coherence
    /// is below 0.2.
    pub turned: bool,
}

impl StrokeDirection {
    /// Direction of the strokes among `pixels`, which lie `depth` deep inside the passage.
    pub(super) fn of(
        pixels: &[u32],
        depth: &Field<u32>,
        intensity: &Field<f32>,
        gradient: &Field<[f32; 2]>,
    ) -> Self {
        let traits = RegionTraits::of(pixels, depth, intensity, gradient);
        let coherence = traits.coherence();
        let degrees = traits.angle().to_degrees();
        Self { degrees, coherence, turned: coherence >= LEAST_COHERENCE }
    }

    /// Unit vector along the strokes. This is y for a passage that is not turned.
    pub(super) fn along(&self) -> [f64; 2] {
        if !self.turned {
            return [0.0, 1.0];
        }
        let (sin, cos) = self.degrees.to_radians().sin_cos();
        [cos, sin]
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Frame {
    /// Place of the texel (0, 0) in the picture, in pixels from the first pixel's middle.
    origin: [f64; 2],
    /// Unit vector across the strokes, which is x of the sample.
    across: [f64; 2],
    /// Unit vector along the strokes, which is y of the sample.
    along: [f64; 2],
    /// Texels per pixel, across and along.
    scale: [f64; 2],
    /// Width and height in texels.
    pub(super) size: [usize; 2],
}

/// A pixel that contributes to a texel, and how much.
pub(super) type Tap = (usize, f32);

impl Frame {
    /// The frame that holds all true pixels of `mask`, which has at least one.
    ///
    /// For example, a frame along y of scale 1 shows the pixels as they are.
    pub(super) fn around(mask: &Field<bool>, along: [f64; 2], scale: [f64; 2]) -> Self {
        let across = [along[1], -along[0]];
        let mut least = [f64::INFINITY; 2];
        let mut most = [f64::NEG_INFINITY; 2];
        for (pixel, _) in mask.values().iter().enumerate().filter(|(_, inside)| **inside) {
            let place = [(pixel % mask.width()) as f64, (pixel / mask.width()) as f64];
            for (axis, direction) in [across, along].into_iter().enumerate() {
                let length = dot(place, direction);
                least[axis] = least[axis].min(length);
                most[axis] = most[axis].max(length);
            }
        }
        let size = [0, 1].map(|axis| {
            let texels = (most[axis] - least[axis]) * scale[axis];
            // Rounding must not add a row.
            (texels - 1e-9).ceil().max(0.0) as usize + 1
        });
        let origin = [0, 1].map(|i| least[0] * across[i] + least[1] * along[i]);
        Self { origin, across, along, scale, size }
    }

    /// The result of `gather` for each texel that lies in the mask by at least half, `None`
    /// elsewhere. Weights are above 0 and sum to 1 over pixels inside the mask, so that nothing
    /// from outside bleeds in.
    pub(super) fn resampled<T: Send + Sync>(
        &self,
        mask: &Field<bool>,
        gather: impl Fn(&[Tap]) -> T + Sync,
    ) -> Field<Option<T>> {
        let [width, height] = self.size;
        let texels = (0..width * height).into_par_iter().with_min_len(256).map_init(
            Vec::new,
            |taps, texel| {
                let place = [(texel % width) as f64, (texel / width) as f64];
                self.taps(mask, place, taps).then(|| gather(taps))
            },
        );
        Field::from_values(width, height, texels.collect())
    }

    /// Fills `taps` for the texel at `place`. Returns false if it lies outside the mask.
    ///
    /// A texel is a tent over the sample's axes. It reaches one texel to each side, or one pixel
    /// where pixels are larger.
    fn taps(&self, mask: &Field<bool>, place: [f64; 2], taps: &mut Vec<Tap>) -> bool {
        taps.clear();
        let lengths = [0, 1].map(|axis| place[axis] / self.scale[axis]);
        let middle = [0, 1]
            .map(|i| self.origin[i] + lengths[0] * self.across[i] + lengths[1] * self.along[i]);
        // Half widths of the tent in pixels along its axes.
        let half = self.scale.map(|scale| (1.0 / scale).max(1.0));
        let reach = [0, 1].map(|i| half[0] * self.across[i].abs() + half[1] * self.along[i].abs());
        let [columns, rows] = [0, 1]
            .map(|i| (middle[i] - reach[i]).ceil() as i64..=(middle[i] + reach[i]).floor() as i64);
        let mut inside = 0.0;
        let mut all = 0.0;
        for y in rows {
            for x in columns.clone() {
                let off = [x as f64 - middle[0], y as f64 - middle[1]];
                let [across, along] = [(self.across, half[0]), (self.along, half[1])]
                    .map(|(direction, half)| (1.0 - dot(off, direction).abs() / half).max(0.0));
                let weight = across * along;
                // Below this, pixels beyond the tent would count by rounding alone.
                if weight < 1e-9 {
                    continue;
                }
                all += weight;
                let (Ok(x), Ok(y)) = (usize::try_from(x), usize::try_from(y)) else { continue };
                if x < mask.width() && y < mask.height() && mask[(x, y)] {
                    inside += weight;
                    taps.push((y * mask.width() + x, weight as f32));
                }
            }
        }
        taps.iter_mut().for_each(|(_, weight)| *weight /= inside as f32);
        inside > 0.0 && inside >= 0.5 * all
    }
}

fn dot(one: [f64; 2], other: [f64; 2]) -> f64 {
    one[0] * other[0] + one[1] * other[1]
}

/// The maximum of the autocorrelation must exceed the minimum before it by this.
const LEAST_SHARPNESS: f64 = 0.1;

/// The autocorrelation must reach this at the maximum. Blotches of one size without order have a
/// minimum too, from which the autocorrelation rises to about 0.
const LEAST_PEAK: f64 = 0.1;

/// We count a rise or fall of the autocorrelation from this size on.
const RIPPLE: f64 = 0.02;

/// We smooth against noise by this standard deviation in pixels.
const NOISE_SIGMA: f64 = 1.0;

/// We look for distances up to this share of the passage's width.
const LARGEST_SHARE: f64 = 1.0 / 4.0;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Estimate {
    pub(super) spacing_px: f64,
    /// Difference of the first maximum of the autocorrelation and the minimum before it, up to 2.
    pub(super) sharpness: f64,
}

/// Estimates the distance between strokes among the true pixels of `mask`. The strokes run along
/// `along`. If you pass false for `turned`, strokes have no direction, and we take the mean over x
/// and y.
///
/// We look for the first minimum of the autocorrelation across the strokes and the maximum after
/// it. A parabola through the maximum gives fractions of a pixel. `None` if there is no maximum,
/// or if the sharpness or the maximum itself is below 0.1.
pub(super) fn estimated(
    intensity: &Field<f32>,
    mask: &Field<bool>,
    along: [f64; 2],
    turned: bool,
) -> Option<Estimate> {
    let mut correlation = across(intensity, mask, along);
    if !turned {
        let other = across(intensity, mask, [along[1], -along[0]]);
        correlation.truncate(other.len());
        correlation.iter_mut().zip(other).for_each(|(one, other)| *one = (*one + other) / 2.0);
    }
    first_peak(&correlation)
}

/// Autocorrelation across the strokes, at distances of 0, 1, .. pixels.
fn across(intensity: &Field<f32>, mask: &Field<bool>, along: [f64; 2]) -> Vec<f64> {
    let frame = Frame::around(mask, along, [1.0; 2]);
    let upright = frame.resampled(mask, |taps| {
        taps.iter().map(|&(pixel, weight)| weight * intensity.values()[pixel]).sum::<f32>()
    });
    let detail = detail(&upright);
    let width = detail.width();
    let largest = (width as f64 * LARGEST_SHARE) as usize;
    (0..=largest).into_par_iter().map(|lag| correlation(&detail, lag)).collect()
}

/// Detail of the intensity, with 1 as the second number. Both are 0 outside the passage. Detail is
/// a narrow mean less a wide mean, and both means take only pixels of the passage.
fn detail(upright: &Field<Option<f32>>) -> Field<[f32; 2]> {
    let width = upright.width();
    let height = upright.height();
    let weighted = upright.values().iter().map(|value| value.map_or([0.0; 2], |v| [v, 1.0]));
    let weighted = Field::from_values(width, height, weighted.collect());
    let narrow = blurred(&weighted, NOISE_SIGMA);
    let wide = blurred(&weighted, width.max(6) as f64 / 6.0);
    let means = narrow.values().iter().zip(wide.values()).zip(upright.values());
    let detail = means.map(|((narrow, wide), inside)| match inside {
        Some(_) => [narrow[0] / narrow[1] - wide[0] / wide[1], 1.0],
        None => [0.0; 2],
    });
    Field::from_values(width, height, detail.collect())
}

fn correlation(detail: &Field<[f32; 2]>, lag: usize) -> f64 {
    let width = detail.width();
    let mut product = 0.0;
    let mut left = 0.0;
    let mut right = 0.0;
    for row in detail.values().chunks_exact(width.max(1)) {
        for (one, other) in row.iter().zip(&row[lag..]) {
            let both = f64::from(one[1] * other[1]);
            let [one, other] = [one, other].map(|detail| f64::from(detail[0]) * both);
            product += one * other;
            left += one * one;
            right += other * other;
        }
    }
    let norm = (left * right).sqrt();
    if norm > 1e-12 { product / norm } else { 0.0 }
}

/// The first maximum after the first minimum. Each must stand out by [`RIPPLE`]. `None` if there
/// is no clear one.
fn first_peak(correlation: &[f64]) -> Option<Estimate> {
    let mut valley = 0;
    let mut peak = None;
    for (lag, &value) in correlation.iter().enumerate().skip(1) {
        match peak {
            None if value < correlation[valley] => valley = lag,
            None if value > correlation[valley] + RIPPLE => peak = Some(lag),
            Some(highest) if value > correlation[highest] => peak = Some(lag),
            Some(highest) if value < correlation[highest] - RIPPLE => {
                let [before, top, after] =
                    [highest - 1, highest, highest + 1].map(|i| correlation[i]);
                let bend = before - 2.0 * top + after;
                let shift = if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 };
                let sharpness = top - correlation[valley];
                let spacing_px = highest as f64 + shift.clamp(-0.5, 0.5);
                let clear = sharpness >= LEAST_SHARPNESS && top >= LEAST_PEAK;
                return clear.then_some(Estimate { spacing_px, sharpness });
            }
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::made_up::{Brush, Texture, textured};
    use super::super::regions::{Regions, gradient_of, intensity_of};
    use super::*;
    use crate::sample::PaintOfSamples;
    use pigment::library::PigmentLibrary;
    use std::sync::Arc;

    fn disc() -> (SourcePicture, Field<bool>) {
        fn inside(i: usize) -> bool {
            let x = (i % 60) as f64 - 30.0;
            let y = (i / 60) as f64 - 25.0;
            x.hypot(y) < 20.0
        }
        let mask = Field::from_values(60, 50, (0..3000).map(inside).collect());
        let height = (0..3000).map(|i| if inside(i) { 0.4 } else { 9.0_f32 }).collect();
        let height = Field::from_values(60, 50, height);
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
        // This thin spur of the passage is lost where we make the sample smaller.
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

    fn direction_of(texture: Texture) -> StrokeDirection {
        let intensity = intensity_of(&textured(160, 120, 5, &[texture], |_, _| 0));
        let whole = Regions { labels: Field::filled(160, 120, 0), count: 1 };
        let pixels: Vec<u32> = (0..160 * 120).collect();
        StrokeDirection::of(&pixels, &whole.depths(), &intensity, &gradient_of(&intensity))
    }

    #[test]
    fn strokes_have_their_direction_within_2_degrees() {
        for brush in Brush::ALL.into_iter().filter(|brush| brush.has_direction()) {
            for degrees in [0.0, 30.0, 75.0, 120.0, 179.0] {
                let texture = Texture { brush, degrees, ..Texture::default() };
                let found = direction_of(texture);
                let off = (found.degrees - degrees).abs();
                let off = off.min(180.0 - off);
                assert!(off < 2.0, "{brush:?} at {degrees}: {found:?}");
                assert!(found.turned, "{brush:?} at {degrees}: {found:?}");
            }
        }
    }

    #[test]
    fn specks_are_not_turned() {
        let found = direction_of(Texture { brush: Brush::Specks, ..Texture::default() });
        assert!(!found.turned && found.coherence < 0.2, "{found:?}");
        assert_eq!(found.along(), [0.0, 1.0]);
    }

    #[test]
    fn a_frame_along_y_of_scale_1_shows_the_pixels_as_they_are() {
        let mut mask = Field::filled(12, 9, true);
        (0..12).for_each(|x| mask[(x, 0)] = false);
        mask[(5, 4)] = false;
        let frame = Frame::around(&mask, [0.0, 1.0], [1.0; 2]);
        assert_eq!(frame.size, [12, 8]);
        let found = frame.resampled(&mask, |taps| taps.to_vec());
        for y in 0..8 {
            for x in 0..12 {
                let wanted = mask[(x, y + 1)].then(|| vec![((y + 1) * 12 + x, 1.0)]);
                assert_eq!(found[(x, y)], wanted, "{x} {y}");
            }
        }
    }

    #[test]
    fn a_turned_frame_runs_along_the_strokes() {
        // Values grow along 30 degrees: along y of the frame.
        let mask = Field::filled(60, 50, true);
        let (sin, cos) = 30f64.to_radians().sin_cos();
        let frame = Frame::around(&mask, [cos, sin], [1.0, 2.0]);
        let found = frame.resampled(&mask, |taps: &[Tap]| -> f64 {
            taps.iter()
                .map(|&(pixel, weight)| {
                    f64::from(weight) * ((pixel % 60) as f64 * cos + (pixel / 60) as f64 * sin)
                })
                .sum()
        });
        let x = frame.size[0] / 2;
        let y = frame.size[1] / 2;
        fn at(x: usize, y: usize, found: &Field<Option<f64>>) -> f64 {
            found[(x, y)].unwrap()
        }
        assert!(
            (at(x, y + 8, &found) - at(x, y, &found) - 4.0).abs() < 0.15,
            "two texels a pixel along y"
        );
        assert!((at(x + 5, y, &found) - at(x, y, &found)).abs() < 0.15, "and even across");
    }

    #[test]
    fn a_smaller_sample_takes_means() {
        let mask = Field::filled(40, 40, true);
        let frame = Frame::around(&mask, [0.0, 1.0], [0.25; 2]);
        let found = frame.resampled(&mask, |taps| {
            taps.iter().map(|&(p, weight)| weight * (((p % 40 + p / 40) % 2) as f32)).sum::<f32>()
        });
        let middle = found[(5, 5)].unwrap();
        assert!((middle - 0.5).abs() < 0.05, "{middle}");
    }

    fn estimate(texture: Texture) -> Option<Estimate> {
        let (sin, cos) = texture.degrees.to_radians().sin_cos();
        let picture = textured(200, 150, 11, &[texture], |_, _| 0);
        let mask = Field::filled(200, 150, true);
        estimated(&intensity_of(&picture), &mask, [cos, sin], texture.brush.has_direction())
    }

    #[test]
    fn spacings_are_within_8_percent_on_four_brushes_of_five_or_refused() {
        for (degrees, spacing) in [(90.0, 12.0), (30.0, 9.5), (140.0, 17.0)] {
            let mut near = 0;
            for brush in Brush::ALL {
                let texture = Texture { brush, degrees, spacing, ..Texture::default() };
                let Some(found) = estimate(texture) else { continue };
                let off = found.spacing_px / spacing - 1.0;
                assert!(off.abs() < 0.08, "{brush:?} {degrees} {spacing}: {found:?}");
                near += 1;
            }
            assert!(near >= 4, "{near} of 5 brushes at {degrees}, {spacing}");
        }
    }

    #[test]
    fn a_peak_is_refined_between_pixels_and_noise_is_refused() {
        fn wave(lag: usize) -> f64 {
            (std::f64::consts::TAU * lag as f64 / 10.4).cos()
        }
        let found = first_peak(&(0..30).map(wave).collect::<Vec<_>>()).unwrap();
        assert!((found.spacing_px - 10.4).abs() < 0.05, "{found:?}");
        assert!(found.sharpness > 1.8, "{found:?}");
        let falling: Vec<f64> = (0..30).map(|lag| (-0.2 * f64::from(lag)).exp()).collect();
        assert_eq!(first_peak(&falling), None);
        fn faint(height: f64) -> Vec<f64> {
            (0..30).map(|lag| height * wave(lag) - if lag > 0 { 0.3 } else { 0.0 }).collect()
        }
        assert_eq!(first_peak(&faint(0.35)), None, "a maximum near 0 is none");
        assert!(first_peak(&faint(0.6)).is_some(), "one of 0.3 is");
        let flat = Field::filled(80, 60, 0.5);
        assert_eq!(estimated(&flat, &Field::filled(80, 60, true), [0.0, 1.0], true), None);
    }
}
