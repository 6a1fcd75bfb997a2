//! Saving, drying, merging and exporting keep the colours of the picture.

use documents::hint::Explain;
use graphics::export::{linear_exr, png8, png16};
use graphics::field::Field;
use image::ImageDecoder;
use paint::brush::HeadShape;
use paint::file;
use paint::painting::{LayerRef, MERGE_TOLERANCE, Painting, PaintingError};
use paint::scene::SpectralDocument;
use spectra::color::{Adaptation, Rgb, RgbSpace};

use super::studio::{
    BLUE, CELL_MM, WHITE, YELLOW, along, bare, crossing, differences, loaded, on_both, on_cpu,
};

/// Largest colour difference that counts as invisible, in CIEDE2000.
const UNSEEN: f64 = 0.1;

fn largest(a: &Field<[f32; 4]>, b: &Field<[f32; 4]>) -> f64 {
    differences(a, b).last().copied().unwrap()
}

/// Wet strokes over a partly dried layer, in daylight.
fn some_painting() -> Painting {
    let mut painting = on_cpu(bare(130, 100));
    crossing(&mut painting);
    painting.dry(0.6).unwrap();
    let brush = loaded(&mut painting, HeadShape::Fan, 5.0, YELLOW, 0.3);
    painting.stroke(brush, &along(&[(4.0, 4.0), (20.0, 16.0)], 0.6)).unwrap();
    painting
}

#[test]
fn a_saved_painting_comes_back_to_the_bit() {
    let mut painting = some_painting();
    let document = painting.document().unwrap();
    let bytes = file::write(&document).unwrap();
    let back = file::read("a.exr", &bytes).unwrap();
    assert!(back == document, "not the same painting");
    assert!(file::write(&back).unwrap() == bytes, "not the same bytes");
    let mut reopened = on_cpu(back);
    assert!(reopened.picture().unwrap() == painting.picture().unwrap(), "not the same picture");
    assert!(reopened.document().unwrap() == document, "opening changed the painting");
}

#[test]
fn drying_leaves_the_colors_as_they_were() {
    for fraction in [1.0, 0.37] {
        for mut painting in on_both(&bare(130, 100)) {
            crossing(&mut painting);
            let before = painting.flat_picture().unwrap();
            assert!(painting.dry(fraction).unwrap(), "there was paint");
            let moved = largest(&before, &painting.flat_picture().unwrap());
            assert!(moved < UNSEEN, "{fraction} dried moved a colour by {moved}");
            assert!(painting.wet_totals_mm().unwrap()[WHITE] >= 0.0);
        }
    }
}

/// Paints two overlapping strokes with the pigments in `slots`, each dried to a layer of its own.
fn two_layers(mut painting: Painting, slots: [usize; 2]) -> Painting {
    for (slot, y) in slots.into_iter().zip([6.0, 8.0]) {
        let brush = loaded(&mut painting, HeadShape::Flat, 5.0, slot, 0.4);
        painting.stroke(brush, &along(&[(3.0, y), (20.0, y)], 0.5)).unwrap();
        painting.dry(1.0).unwrap();
    }
    painting
}

#[test]
fn layers_of_like_paint_become_one_unseen() {
    for painting in on_both(&bare(130, 100)) {
        let mut painting = two_layers(painting, [YELLOW, YELLOW]);
        let before = painting.picture().unwrap();
        let two = painting.document().unwrap();
        painting.merge(LayerRef::Dry(0), LayerRef::Dry(1)).unwrap();
        assert_eq!(painting.state().dry.len(), 1);
        let moved = largest(&before, &painting.picture().unwrap());
        assert!(moved < UNSEEN, "merging moved a colour by {moved}");
        let one = painting.document().unwrap();
        for slot in 0..=8 {
            let sum: u64 = two.dry.iter().map(|layer| layer.paint.totals()[slot]).sum();
            assert_eq!(one.dry[0].paint.totals()[slot], sum, "slot {slot}");
        }
        assert!(painting.undo().unwrap() && painting.document().unwrap() == two, "undo");
    }
}

#[test]
fn a_merge_that_shows_is_refused_and_changes_nothing() {
    for painting in on_both(&bare(130, 100)) {
        let mut painting = two_layers(painting, [YELLOW, BLUE]);
        let before = painting.picture().unwrap();
        let document = painting.document().unwrap();
        let error = painting.merge(LayerRef::Dry(1), LayerRef::Dry(0)).unwrap_err();
        assert!(
            matches!(error, PaintingError::MergeShows { delta_e, .. } if delta_e > MERGE_TOLERANCE),
            "{error}"
        );
        assert!(error.hint().is_some(), "no hint");
        assert!(painting.document().unwrap() == document, "the paint changed");
        assert!(painting.picture().unwrap() == before, "the picture changed");
        // The refused merge is no step of the history: the last step is the drying.
        assert!(painting.undo().unwrap(), "nothing to undo");
        assert_eq!(painting.state().dry.len(), 1);
        for missing in [1, 2, usize::MAX] {
            let error = painting.merge(LayerRef::Dry(0), LayerRef::Dry(missing)).unwrap_err();
            assert!(matches!(error, PaintingError::NoLayer { count: 1, .. }), "{error}");
        }
    }
}

#[test]
fn exported_pictures_have_the_colors_that_were_shown() {
    let mut painting = some_painting();
    let shown = painting.picture().unwrap();
    let on_screen = shown
        .values()
        .iter()
        .map(|rgb: &[f32; 4]| {
            let [r, g, b, _] = rgb.map(f64::from);
            let [r, g, b] = Rgb([r, g, b]).mapped_into_gamut().0.map(|value| value as f32);
            [r, g, b, 1.0]
        })
        .collect();
    let on_screen = Field::from_values(shown.width(), shown.height(), on_screen);
    for (bytes, within) in [
        // Rounding to 8 bits alone gives up to 1 CIEDE2000 near black.
        (png8(&shown, CELL_MM).unwrap().bytes, 1.0),
        (png16(&shown, CELL_MM).unwrap().bytes, UNSEEN),
    ] {
        let decoder = image::codecs::png::PngDecoder::new(std::io::Cursor::new(bytes)).unwrap();
        assert_eq!(decoder.dimensions(), (130, 100));
        let read = image::DynamicImage::from_decoder(decoder).unwrap().to_rgb32f();
        let linear = read.pixels().map(|pixel| {
            let [r, g, b] = Rgb(pixel.0.map(f64::from)).linear().0.map(|v| v as f32);
            [r, g, b, 1.0]
        });
        let read = Field::from_values(130, 100, linear.collect());
        let off = largest(&on_screen, &read);
        assert!(off < within, "a PNG is {off} off");
    }
    let bytes = linear_exr(&shown, CELL_MM).unwrap();
    let read = exr_channels(&bytes);
    for (index, rgb) in shown.values().iter().enumerate() {
        for (name, value) in ["R", "G", "B"].into_iter().zip(rgb) {
            let found = read.iter().find(|(channel, _)| channel == name).unwrap().1[index];
            assert!(found == *value, "{name} of cell {index}: {found}, shown {value}");
        }
    }
}

/// Names and values of the channels of a single-part OpenEXR file.
fn exr_channels(bytes: &[u8]) -> Vec<(String, Vec<f32>)> {
    use exr::prelude::{ReadChannels, ReadLayers, read};
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(std::io::Cursor::new(bytes))
        .unwrap();
    let channels = image.layer_data.channel_data.list;
    let values = |channel: &exr::prelude::AnyChannel<_>| channel_values(&channel.sample_data);
    channels.iter().map(|channel| (channel.name.to_string(), values(channel))).collect()
}

fn channel_values(samples: &exr::prelude::FlatSamples) -> Vec<f32> {
    samples.values_as_f32().collect()
}

#[test]
fn a_spectral_export_at_the_nodes_has_the_colors_that_were_shown() {
    let mut painting = some_painting();
    let flat = painting.flat_picture().unwrap();
    let document = painting.document().unwrap();
    let quadrature = painting.light().quadrature.clone();
    let spectral = SpectralDocument::at_nodes(&document, &quadrature);
    let planes: Vec<Field<f32>> = (0..spectral.count())
        .map(|node| {
            let cells = (0..130 * 100).map(|i| spectral.measured_reflectance(i % 130, i / 130));
            Field::from_values(130, 100, cells.map(|spectrum| spectrum[node] as f32).collect())
        })
        .collect();
    let bytes =
        paint::export::spectral_exr(&flat, &quadrature.rule.nodes_nm, &planes, CELL_MM).unwrap();
    let channels = exr_channels(&bytes);
    let mut nodes: Vec<(f64, &Vec<f32>)> = channels
        .iter()
        .filter_map(|(name, values)| {
            let nm = name.strip_prefix("T.")?.strip_suffix("nm")?.replace(',', ".");
            Some((nm.parse().unwrap(), values))
        })
        .collect();
    nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(nodes.len(), 8, "{:?}", channels.iter().map(|c| &c.0).collect::<Vec<_>>());
    let cells = (0..130 * 100).map(|cell| {
        let mut xyz = [0.0; 3];
        for ((_, values), weights) in nodes.iter().zip(&quadrature.rule.weights) {
            for (sum, weight) in xyz.iter_mut().zip(weights) {
                *sum += f64::from(values[cell]) * weight;
            }
        }
        let rgb =
            RgbSpace::Srgb.linear_from_xyz(xyz.into(), quadrature.rule.white, Adaptation::Bradford);
        let [r, g, b] = rgb.0.map(|v| v as f32);
        [r, g, b, 1.0]
    });
    let read = Field::from_values(130, 100, cells.collect());
    let off = largest(&flat, &read);
    assert!(off < UNSEEN, "{off} off");
}
