//! The colours of a picture at the size of the strokes of each layer, and where they are needed.

use glam::Vec3;
use graphics::encoding::lab_from_linear;
use graphics::field::{Field, blurred};
use graphics::mesh::Texture;
use graphics::picture::{Photograph, Picture};
use rayon::prelude::*;
use spectra::color::Rgb;

use super::settings::Settings;

/// Cells of a layer to the distance of its strokes.
const CELLS: f32 = 3.0;

/// Difference in CIELAB at which usual settings show smaller strokes.
const DIFFERENCE: f32 = 7.0;

/// A picture as the strokes of one layer show it.
#[derive(Debug)]
pub(super) struct LayerColors {
    /// Mean colours of cells, linear sRGB.
    pub(super) picture: Picture,
    pub(super) lab: Field<[f32; 3]>,
    /// Where strokes show, 0 to 1; `None` on the lowest layer.
    pub(super) shown: Option<Field<f32>>,
}

/// The colours of all layers, the lowest first.
pub(super) fn layer_colors(photograph: &Photograph, settings: &Settings) -> Vec<LayerColors> {
    let layer = |number: u32| {
        let own = settings.of_layer(number);
        let picture = at_strokes(photograph, own.reference_px / own.strokes.width_px * CELLS);
        let lab = lab_from_linear(&picture);
        let shown = number.checked_sub(1).map(|_| {
            // What strokes of the layer below can show of it.
            let sigma = f64::from(CELLS / 2.0 / settings.layers.ratio);
            let below = blurred(&lab, sigma);
            let pairs = lab.values().par_iter().zip(below.values());
            let off = pairs.map(|(&own, &below)| [Vec3::from(own).distance(below.into())]);
            let off = Field::from_values(lab.width(), lab.height(), off.collect());
            let around = blurred(&off, f64::from(CELLS) / 2.0);
            let shown = around.values().iter().map(|[off]| settings.layers.shown(off / DIFFERENCE));
            Field::from_values(lab.width(), lab.height(), shown.collect())
        });
        LayerColors { picture, lab, shown }
    };
    (0..settings.layers.count).map(layer).collect()
}

impl LayerColors {
    /// The colours as a texture.
    pub(super) fn texture(&self) -> Texture {
        Texture {
            width: self.picture.width() as u32,
            height: self.picture.height() as u32,
            texels: self
                .picture
                .values()
                .par_iter()
                .map(|rgb: &[f32; 3]| {
                    let linear = rgb.map(|value| f64::from(value.clamp(0.0, 1.0)));
                    let [r, g, b] = Rgb(linear).encoded().to_bytes();
                    u32::from_le_bytes([r, g, b, 255])
                })
                .collect(),
        }
    }

    /// The L* below and above which lie one hundredth of the picture each.
    pub(super) fn range(&self) -> [f32; 2] {
        let mut lightness: Vec<f32> = self.lab.values().iter().map(|lab| lab[0]).collect();
        lightness.sort_unstable_by(f32::total_cmp);
        let at = |share: f32| lightness[(share * (lightness.len() - 1) as f32) as usize];
        let [dark, light] = [at(0.01), at(0.99)];
        [dark, light.max(dark + 1.0)]
    }
}

/// Mean colours of a picture in about so many cells along its longer side, not more than it has.
fn at_strokes(photograph: &Photograph, cells: f32) -> Picture {
    let (width, height) = photograph.size();
    let longer = width.max(height) as f32;
    let scale = (cells / longer).min(1.0);
    let side = |px: usize| ((px as f32 * scale).round() as usize).max(1);
    photograph.on_canvas(side(width), side(height))
}

#[cfg(test)]
mod tests {
    use graphics::export::frame_png;

    use super::*;

    #[test]
    fn small_strokes_show_where_large_ones_would_blur() {
        // An even half, and one of fine stripes.
        let color = |x: usize| {
            if x >= 128 && (x / 4).is_multiple_of(2) { [230, 220, 210] } else { [60, 70, 80] }
        };
        let values = (0..256 * 128).map(|index| color(index % 256)).collect();
        let png = frame_png(&Field::from_values(256, 128, values)).unwrap();
        let photograph = Photograph::from_bytes("stripes", &png).unwrap();
        let mut settings = Settings { reference_px: 256.0, ..Settings::default() };
        settings.layers.count = 2;
        settings.strokes.width_px = 12.0;
        let layers = layer_colors(&photograph, &settings);
        assert!(layers[0].shown.is_none());
        assert_eq!((layers[0].picture.width(), layers[1].picture.width()), (64, 128));
        let shown = layers[1].shown.as_ref().unwrap();
        assert!(shown[(10, 30)] == 0.0 && shown[(100, 30)] > 0.9, "{}", shown[(100, 30)]);
        let [dark, light] = layers[0].range();
        assert!((20.0..40.0).contains(&dark) && light > dark + 20.0, "{dark} {light}");
    }
}
