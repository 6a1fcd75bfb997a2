//! The layers of a painting as an OpenRaster file. We write each film as colour with opacity,
//! because other programs cannot mix paint.
//!
//! Light passes through a film of paint twice and scatters on its way, so you cannot blend a film
//! with the colour below by one share of opacity. But at one pixel, over one known colour, some
//! opacity and colour show exactly what the film shows. With `b` the colour below and `c` the
//! colour with the film, both as stored (encoded sRGB, 0 to 1), programs show
//! ```text
//! c = a f + (1 - a) b
//! ```
//! for opacity a and colour f. f lies within 0..1 if a is at least the share by which some channel
//! of b is moved towards black or white,
//! ```text
//! least = max over channels of (b - c) / b and (c - b) / (1 - b)
//! ```
//! We take the greater of this share and the film's own hiding power, and solve for f. This never
//! clips a value, and the stack of layers shows the painting to the rounding of 16 bits.

use graphics::export::{ExportError, OpenRaster, PictureFile, srgb16};
use graphics::field::Field;
use rayon::prelude::*;
use spectra::color::{Rgb, RgbSpace};

use crate::composite::composite_layer_row;
use crate::document::{Document, Slots};
use crate::layer::{Layer, layer_label};
use crate::light::Light;
use crate::optics::{LayerOptics, NODES, Scene};
use crate::scene::{Appearance, picture_of_lowest, scene};
use crate::shade::color_row;

/// Encodes the layers of `document` under `light` as OpenRaster: the ground, each dry layer, and
/// the wet layer, with one pixel a cell and 16 bits a channel.
///
/// Films of paint do not blend by opacity. We give each pixel of a layer the opacity by which its
/// film hides the colour below. If that is too little, we take the least opacity with which a
/// program that composites stored values by `svg:src-over` shows exactly the painting up to this
/// layer. Then we solve for the colour. So the layers together show the merged picture to the
/// rounding of 16 bits, and if you hide the upper layers you see the painting before them. If you
/// reorder layers or change colours, such a program blends them in its own way, which differs from
/// paint.
///
/// A dry layer has its own name, or else its number and the names of its pigments. We list a hidden
/// layer as hidden, with the pixels that it would have if you showed it, and make the layers above
/// without its colour. It keeps its relief, which is part of the next layer that you see.
///
/// Shadows and light of a layer's relief are part of the layer. After each layer this calls `go_on`
/// with the number of layers done. If `go_on` returns `false`, you get `None`.
///
/// # Errors
/// [`ExportError`] for a painting without cells, cells of a size out of range, and colours that are
/// not finite.
pub fn layers_file(
    document: &Document,
    light: &Light,
    mut go_on: impl FnMut(usize) -> bool,
) -> Result<Option<PictureFile>, ExportError> {
    let scene = scene(document, light);
    let size = (document.wet.width(), document.wet.height());
    let mut file = OpenRaster::new(size, document.cell_mm)?;
    let mut merged = picture_of_lowest(document, &scene, 0);
    let mut below = srgb16(&merged)?.pixels;
    file.layer("Ground", true, &opaque(&below))?;
    let dry = document.dry.iter().map(|layer| {
        let usual = layer_label(layer.id, "");
        let name = name(&layer.name, &usual, (&layer.slots, &layer.paint), document);
        (name, layer.visible, &layer.paint)
    });
    let wet = name("", "Wet paint", (&document.slots, &document.wet), document);
    let all = dry.chain([(wet, true, &document.wet)]);
    for (index, (title, visible, paint)) in all.enumerate() {
        if !go_on(index + 1) {
            return Ok(None);
        }
        let shown = (!visible).then(|| shown_scene(document, light, index));
        let scene = shown.as_ref().unwrap_or(&scene);
        let optics = scene.dry.get(index).unwrap_or(&scene.wet);
        let picture = picture_of_lowest(document, scene, index + 1);
        let above = srgb16(&picture)?.pixels;
        let pixels = layer_pixels(scene, (paint, optics), &below, &above);
        file.layer(&title, visible, &pixels)?;
        if visible {
            (merged, below) = (picture, above);
        }
    }
    let png = file.finish(&merged)?;
    let outside = png.outside as f64 / merged.values().len() as f64;
    Ok(Some(PictureFile { bytes: png.bytes, outside }))
}

/// The scene with the hidden dry layer `index` shown.
fn shown_scene(document: &Document, light: &Light, index: usize) -> Scene {
    let dry = document.dry.iter().enumerate().map(|(at, layer)| {
        (layer.slots, if at == index { layer.opacity } else { layer.shown_opacity() })
    });
    Appearance::of(document, &dry.collect::<Vec<_>>()).scene(light)
}

/// Name of a layer: its own, or else the label `usual` with the names of its pigments.
fn name(own: &str, usual: &str, (slots, paint): (&Slots, &Layer), document: &Document) -> String {
    if !own.is_empty() {
        return own.to_owned();
    }
    let totals = paint.totals();
    let used = slots.iter().zip(totals).filter(|(_, total)| *total > 0);
    let names: Vec<&str> =
        used.filter_map(|(slot, _)| Some(document.library[(*slot)?].name.as_str())).collect();
    if names.is_empty() { usual.to_owned() } else { format!("{usual}: {}", names.join(", ")) }
}

fn opaque(pixels: &Field<[u16; 3]>) -> Field<[u16; 4]> {
    let values = pixels.values().iter().map(|&[r, g, b]: &[u16; 3]| [r, g, b, u16::MAX]).collect();
    Field::from_values(pixels.width(), pixels.height(), values)
}

/// Colours and opacities of a layer that lead from the picture `below` to the picture `above`.
fn layer_pixels(
    scene: &Scene,
    (paint, optics): (&Layer, &LayerOptics),
    below: &Field<[u16; 3]>,
    above: &Field<[u16; 3]>,
) -> Field<[u16; 4]> {
    let width = below.width();
    let mut pixels = Field::filled(width, below.height(), [0; 4]);
    pixels.values_mut().par_chunks_mut(width).enumerate().for_each_init(
        || Hiding::new(scene, width),
        |hiding, (y, out)| {
            hiding.measure(scene, optics, paint, y);
            let row = below.row(y, 0, width).iter().zip(above.row(y, 0, width));
            for (out, ((below, above), &hides)) in out.iter_mut().zip(row.zip(&hiding.shares)) {
                *out = over(*below, *above, hides);
            }
        },
    );
    pixels
}

/// How far a row of films hides the colour below. We measure the contrast in encoded luminance
/// between a white and a black ground, and how much of it the films take away.
struct Hiding {
    /// Luminance of full red, green and blue.
    weights: [f64; 3],
    internal: Vec<[f32; NODES]>,
    colors: Vec<[f32; 4]>,
    /// Encoded luminance over white.
    over_white: Vec<f64>,
    /// Contrast of the bare grounds.
    bare: f64,
    /// Share of the contrast that each film hides, 0 to 1.
    shares: Vec<f64>,
}

impl Hiding {
    fn new(scene: &Scene, width: usize) -> Self {
        let matrix = RgbSpace::Srgb.xyz_from_linear();
        let weights = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let weights = weights.map(|full| matrix.apply(full)[1] / 100.0);
        let mut bare = [[0.0; 4]; 2];
        color_row(scene, &[[1.0; NODES], [0.0; NODES]], &mut bare);
        let [white, black] = bare.map(|color| luminance(&weights, &color));
        Self {
            weights,
            internal: vec![[0.0; NODES]; width],
            colors: vec![[0.0; 4]; width],
            over_white: vec![0.0; width],
            bare: white - black,
            shares: vec![0.0; width],
        }
    }

    /// Measures the films of row `y` of `paint`.
    fn measure(&mut self, scene: &Scene, optics: &LayerOptics, paint: &Layer, y: usize) {
        for backing in [1.0, 0.0] {
            self.internal.fill([backing; NODES]);
            composite_layer_row(optics, paint, (0, y), &mut self.internal);
            color_row(scene, &self.internal, &mut self.colors);
            let seen = self.colors.iter().map(|color| luminance(&self.weights, color));
            if backing == 1.0 {
                self.over_white.clear();
                self.over_white.extend(seen);
            } else {
                let pairs = self.over_white.iter().zip(seen);
                for (share, (white, black)) in self.shares.iter_mut().zip(pairs) {
                    *share = (1.0 - (white - black) / self.bare).clamp(0.0, 1.0);
                }
            }
        }
    }
}

fn luminance(weights: &[f64; 3], color: &[f32; 4]) -> f64 {
    let relative: f64 = weights.iter().zip(color).map(|(w, &value)| w * f64::from(value)).sum();
    Rgb([relative.clamp(0.0, 1.0); 3]).encoded().0[1]
}

/// Greatest value of a channel.
const FULL: f64 = 65535.0;

/// Colour and opacity that show `above` over `below`, all in 16 bits. The opacity is `hiding`, 0 to
/// 1, or more if you could not reach the colour with this.
#[must_use]
pub(super) fn over(below: [u16; 3], above: [u16; 3], hiding: f64) -> [u16; 4] {
    let pairs = [0, 1, 2].map(|i| (f64::from(below[i]) / FULL, f64::from(above[i]) / FULL));
    let least = pairs.map(|(b, c)| if c < b { (b - c) / b } else { (c - b) / (1.0 - b).max(1e-9) });
    let alpha = least.into_iter().fold(hiding.clamp(0.0, 1.0), f64::max).min(1.0);
    // We round this up, so that the colour stays within its range.
    let stored = (alpha * FULL).ceil();
    if stored == 0.0 {
        return [0; 4];
    }
    let share = stored / FULL;
    let [r, g, b] = pairs.map(|(b, c)| {
        let color = (c - (1.0 - share) * b) / share;
        (color.clamp(0.0, 1.0) * FULL).round() as u16
    });
    [r, g, b, stored as u16]
}

#[cfg(test)]
mod alpha_tests {
    use super::*;

    fn composited(below: [u16; 3], layer: [u16; 4]) -> [f64; 3] {
        let share = f64::from(layer[3]) / FULL;
        [0, 1, 2].map(|i| share * f64::from(layer[i]) + (1.0 - share) * f64::from(below[i]))
    }

    #[test]
    fn every_colour_is_reached_over_every_other() {
        let values = [0_u16, 1, 2, 300, 20_000, 32_768, 65_000, 65_534, 65_535];
        let mut clear = 0;
        for below in values {
            for above in values {
                for hiding in [0.0, 1e-6, 0.02, 0.5, 0.99, 1.0] {
                    let below = [below, 9000, 65_535];
                    let above = [above, 9000, 60_000];
                    let layer = over(below, above, hiding);
                    for (found, wanted) in composited(below, layer).into_iter().zip(above) {
                        let error = (found - f64::from(wanted)).abs();
                        assert!(error <= 0.5 + 1e-6, "{below:?} {above:?} {hiding}: {layer:?}");
                    }
                    assert!(f64::from(layer[3]) >= hiding * FULL, "{layer:?} hides {hiding}");
                    clear += usize::from(layer[3] < 65_535);
                }
            }
        }
        assert!(clear > 200, "most are not opaque: {clear}");
    }

    #[test]
    fn nothing_that_changes_nothing_is_clear() {
        assert_eq!(over([5, 6, 7], [5, 6, 7], 0.0), [0; 4]);
        let [.., alpha] = over([5, 6, 7], [5, 6, 7], 0.25);
        assert_eq!(alpha, 16_384);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brush::HeadShape;
    use crate::document::Canvas;
    use crate::pose::Sample;
    use crate::scene::picture;
    use crate::session::PaintingSession;
    use crate::strokes::{Action, BrushSpec};
    use graphics::export::png16;
    use image::{ImageBuffer, Rgb as Pixel, Rgba};
    use pigment::PigmentLibrary;
    use std::io::{Cursor, Read};

    /// A painting with two dry layers and wet paint, crossed by thin and thick strokes.
    fn painted() -> (Document, Light) {
        let oils = PigmentLibrary::van_gogh_oils();
        let canvas = Canvas { width_mm: 24.0, height_mm: 16.0, cell_mm: 0.25, ..Canvas::default() };
        let mut session = PaintingSession::on_canvas(&oils, &canvas).unwrap();
        let spec = BrushSpec { shape: HeadShape::Flat, size_mm: 5.0 };
        session.set_brush("flat", &spec).unwrap();
        let paints = [("Prussian Blue", 0.02), ("Zinc White", 0.3), ("Vermilion", 0.1)];
        for (index, (pigment, amount_mm)) in paints.into_iter().enumerate() {
            session.apply(&Action::Wash { brush: "flat".to_owned() }).unwrap();
            session.load("flat", [(pigment, 1.0)], amount_mm).unwrap();
            let y_mm = 4.0 + 3.0 * index as f64;
            session.stroke("flat", &[at(0.0, 2.0, y_mm), at(1.0, 22.0, y_mm)]).unwrap();
            session.stroke("flat", &[at(0.0, 9.0, 2.0), at(1.0, 9.0, 14.0)]).unwrap();
            if index < 2 {
                session.apply(&Action::Dry { fraction: 1.0 }).unwrap();
            }
        }
        let light = session.canvas().light().clone();
        let document = session.documents().unwrap().0;
        assert_eq!(document.dry.len(), 2, "two layers dried");
        (document, Light::clone(&light))
    }

    fn at(seconds: f64, x_mm: f64, y_mm: f64) -> Sample {
        Sample::upright(seconds, x_mm, y_mm, 0.6)
    }

    fn entry(file: &[u8], name: &str) -> Vec<u8> {
        let mut archive = zip::ZipArchive::new(Cursor::new(file)).unwrap();
        let mut bytes = Vec::new();
        archive.by_name(name).unwrap().read_to_end(&mut bytes).unwrap();
        bytes
    }

    type Layer16 = ImageBuffer<Rgba<u16>, Vec<u16>>;

    fn layer(file: &[u8], index: usize) -> Layer16 {
        let png = entry(file, &format!("data/layer{index:03}.png"));
        image::load_from_memory(&png).unwrap().into_rgba16()
    }

    /// Composites layers by normal opacity, as other programs do, in f64.
    fn composited(layers: &[Layer16]) -> Vec<[f64; 3]> {
        let mut shown = vec![[0.0; 3]; layers[0].pixels().len()];
        for layer in layers {
            for (shown, Rgba([r, g, b, a])) in shown.iter_mut().zip(layer.pixels()) {
                let share = f64::from(*a) / 65535.0;
                for (shown, value) in shown.iter_mut().zip([r, g, b]) {
                    *shown = share * f64::from(*value) + (1.0 - share) * *shown;
                }
            }
        }
        shown
    }

    /// Greatest difference between the layers as you see them and a picture, in steps of 16 bits.
    fn worst(shown: &[[f64; 3]], picture: &Field<[f32; 4]>) -> f64 {
        let wanted = srgb16(picture).unwrap().pixels;
        let channels = shown.as_flattened().iter().zip(wanted.values().as_flattened());
        channels.map(|(found, &wanted)| (found - f64::from(wanted)).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn normal_opacity_shows_the_painting_up_to_each_layer() {
        let (document, light) = painted();
        let file = layers_file(&document, &light, |_| true).unwrap().unwrap();
        let layers: Vec<Layer16> = (0..4).map(|index| layer(&file.bytes, index)).collect();
        let scene = scene(&document, &light);
        for count in 0..4 {
            let picture = picture_of_lowest(&document, &scene, count);
            let error = worst(&composited(&layers[..=count]), &picture);
            // Half a step for each layer. A step of 8 bits is 257.
            assert!(error <= 2.0, "{count} layers: {error}");
        }
        assert!(picture(&document, &scene) == picture_of_lowest(&document, &scene, 3));
        let thin = layers[1].pixels().filter(|pixel| (1..60_000).contains(&pixel[3])).count();
        assert!(thin > 200, "a thin film stays translucent: {thin}");
        let opaque = layers[2].pixels().filter(|pixel| pixel[3] > 60_000).count();
        assert!(opaque > 500, "a thick film of white hides: {opaque}");
        let clear = layers[3].pixels().filter(|pixel| pixel[3] == 0).count();
        assert!(clear > 1000, "most of the last layer is empty: {clear}");
    }

    #[test]
    fn the_merged_picture_is_the_exported_one_and_layers_have_names() {
        let (mut document, light) = painted();
        document.dry[1].name = "Light and air".to_owned();
        let file = layers_file(&document, &light, |_| true).unwrap().unwrap();
        let again = layers_file(&document, &light, |_| true).unwrap().unwrap();
        assert!(file == again, "the same bytes every time");
        let exported = png16(&picture(&document, &scene(&document, &light)), document.cell_mm);
        assert!(entry(&file.bytes, "mergedimage.png") == exported.unwrap().bytes);
        let stack = String::from_utf8(entry(&file.bytes, "stack.xml")).unwrap();
        let names: Vec<&str> =
            stack.split("name=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
        assert_eq!(names.len(), 4, "{stack}");
        assert!(names[0].starts_with("Wet paint: ") && names[0].contains("Vermilion"), "{names:?}");
        assert_eq!(names[1..], ["Light and air", "Layer 1: Prussian Blue", "Ground"]);
        assert!(!stack.contains("hidden"), "all are shown: {stack}");
        let _: ImageBuffer<Pixel<u16>, _> =
            image::load_from_memory(&entry(&file.bytes, "mergedimage.png")).unwrap().into_rgb16();
    }

    #[test]
    fn a_hidden_layer_is_hidden_in_the_file_and_has_the_pixels_that_showing_it_needs() {
        let (mut document, light) = painted();
        document.dry[1].visible = false;
        let file = layers_file(&document, &light, |_| true).unwrap().unwrap();
        let stack = String::from_utf8(entry(&file.bytes, "stack.xml")).unwrap();
        let hidden: Vec<&str> = stack.lines().filter(hidden).collect();
        assert!(hidden.len() == 1 && hidden[0].contains("layer002.png"), "{stack}");
        let seen = composited(&[0, 1, 3].map(|index| layer(&file.bytes, index)));
        let error = worst(&seen, &picture(&document, &scene(&document, &light)));
        assert!(error <= 2.0, "without the hidden layer: {error}");
        let below_wet = composited(&[0, 1, 2].map(|index| layer(&file.bytes, index)));
        document.dry[1].visible = true;
        let shown = picture_of_lowest(&document, &scene(&document, &light), 2);
        let error = worst(&below_wet, &shown);
        assert!(error <= 2.0, "with it: {error}");
    }

    #[test]
    fn an_export_can_be_cancelled() {
        let (document, light) = painted();
        assert_eq!(layers_file(&document, &light, |done| done < 2), Ok(None));
    }

    fn hidden(line: &&str) -> bool {
        line.contains("visibility=\"hidden\"")
    }
}
