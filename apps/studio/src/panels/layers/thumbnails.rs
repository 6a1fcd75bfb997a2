//! Cache of the textures of layer thumbnails, scaled to the pixels of the screen.

use std::sync::Arc;

use eframe::egui::{
    Color32, ColorImage, Context, Pos2, Rect, Rgba, Sense, TextureHandle, TextureOptions, Ui, Vec2,
    vec2,
};

use crate::theme;
use session::Thumbnail;

/// A thumbnail on the screen, with its width and height in pixels there.
type Scaled = (Arc<Thumbnail>, [usize; 2], TextureHandle);

/// Textures of the thumbnails in use.
#[derive(Clone, Default)]
pub(super) struct Thumbnails(Vec<Scaled>);

impl std::fmt::Debug for Thumbnails {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Thumbnails").field(&self.0.len()).finish()
    }
}

impl Thumbnails {
    /// Draws a thumbnail within `area` points, keeping its aspect ratio, pixel by pixel.
    pub(super) fn show(&mut self, ui: &mut Ui, thumbnail: &Arc<Thumbnail>, area: Vec2) {
        let (rect, _) = ui.allocate_exact_size(area, Sense::hover());
        if thumbnail.width == 0 || thumbnail.height == 0 {
            return;
        }
        let size = vec2(thumbnail.width as f32, thumbnail.height as f32);
        let scale = (area.x / size.x).min(area.y / size.y);
        let density = ui.pixels_per_point();
        let pixels = (size * scale * density).round().max(Vec2::splat(1.0));
        let place = Rect::from_center_size(rect.center(), pixels / density);
        // On whole pixels, so that no filter blurs it.
        let corner = (place.min * density).round() / density;
        let place = Rect::from_min_size(corner, pixels / density);
        let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
        let size = [pixels.x as usize, pixels.y as usize];
        let texture = self.texture(ui.ctx(), thumbnail, size).id();
        ui.painter().rect_filled(place, 0.0, theme::SURROUND);
        ui.painter().image(texture, place, whole, Color32::WHITE);
    }

    /// Drops textures of thumbnails that are not in `layers`.
    pub(super) fn keep<'a>(&mut self, layers: impl Iterator<Item = &'a Arc<Thumbnail>> + Clone) {
        self.0.retain(|(kept, ..)| layers.clone().any(|layer| Arc::ptr_eq(kept, layer)));
    }

    fn texture(
        &mut self,
        context: &Context,
        thumbnail: &Arc<Thumbnail>,
        size: [usize; 2],
    ) -> &TextureHandle {
        let index = self
            .0
            .iter()
            .position(|(kept, of, _): &Scaled| Arc::ptr_eq(kept, thumbnail) && *of == size)
            .unwrap_or_else(|| {
                // A screen of another density needs another size.
                self.0.retain(|(kept, ..)| !Arc::ptr_eq(kept, thumbnail));
                let image = ColorImage::new(size, scaled(thumbnail, size));
                let texture = context.load_texture("layer", image, TextureOptions::LINEAR);
                self.0.push((Arc::clone(thumbnail), size, texture));
                self.0.len() - 1
            });
        &self.0[index].2
    }
}

/// The thumbnail with other columns and rows: each pixel is the mean of what it covers.
fn scaled(thumbnail: &Thumbnail, [width, height]: [usize; 2]) -> Vec<Color32> {
    let color = |[red, green, blue, alpha]: [u8; 4]| {
        Rgba::from(Color32::from_rgba_unmultiplied(red, green, blue, alpha))
    };
    let source: Vec<Rgba> = thumbnail.pixels.iter().copied().map(color).collect();
    let columns: Vec<_> = (0..width).map(|x| shares(x, width, thumbnail.width)).collect();
    let mut pixels = Vec::with_capacity(width * height);
    for y in 0..height {
        let rows = shares(y, height, thumbnail.height);
        for columns in &columns {
            let mut mean = Rgba::TRANSPARENT;
            for &(row, share) in &rows {
                for &(column, part) in columns {
                    mean = mean + source[row * thumbnail.width + column] * (share * part);
                }
            }
            pixels.push(Color32::from(mean));
        }
    }
    pixels
}

/// The pixels of `source` that pixel `index` of `count` covers, with the share of each; their sum
/// is 1.
fn shares(index: usize, count: usize, source: usize) -> Vec<(usize, f32)> {
    let scale = source as f64 / count as f64;
    let from = index as f64 * scale;
    let to = (index + 1) as f64 * scale;
    let last = ((to - 1e-9) as usize).min(source - 1);
    (from as usize..=last)
        .map(|pixel: usize| {
            let covered = to.min((pixel + 1) as f64) - from.max(pixel as f64);
            (pixel, (covered / scale) as f32)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scaled_pixel_is_the_mean_of_what_it_covers() {
        for (count, source) in [(3, 7), (7, 3), (60, 160), (1, 5), (4, 4)] {
            let mut covered = vec![0.0; source];
            for index in 0..count {
                let shares = shares(index, count, source);
                let sum: f32 = shares.iter().map(|(_, share)| share).sum();
                assert!((sum - 1.0).abs() < 1e-5, "{index} of {count}: {sum}");
                for (pixel, share) in shares {
                    covered[pixel] += share * source as f32 / count as f32;
                }
            }
            assert!(covered.iter().all(|sum| (sum - 1.0).abs() < 1e-4), "{covered:?}");
        }
        let pixels = vec![[255, 0, 0, 255], [0, 0, 0, 0], [255, 0, 0, 255], [0, 0, 0, 0]];
        let thumbnail = Thumbnail { width: 2, height: 2, pixels };
        let half = scaled(&thumbnail, [1, 2]);
        assert!(half.iter().all(|color| (120..136).contains(&color.a())), "{half:?}");
        assert_eq!(scaled(&thumbnail, [2, 2])[0], Color32::from_rgb(255, 0, 0));
    }
}
