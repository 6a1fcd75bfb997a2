//! Incremental pictures: `refresh` renders and reports only the tiles that changed, and a window
//! that reads these shows the right picture. Also paint and reflectance of a rectangle, and that
//! saving, drying, merging and exporting keep the colours.

use documents::hint::Explain;
use graphics::export::{linear_exr, png8, png16};
use graphics::field::Field;
use graphics::tile::{Rect, TileSet};
use image::ImageDecoder;
use paint::brush::HeadShape;
use paint::document::{Document, Lighting, Medium};
use paint::file;
use paint::layer::LayerRef;
use paint::painting::{MERGE_TOLERANCE, Painting, PaintingError};
use paint::scene::SpectralDocument;
use paint::strokes::StrokeTool;
use spectra::color::{Adaptation, Rgb, RgbSpace};

use super::studio::{
    BLUE, CELL_MM, WHITE, YELLOW, along, bare, crossing, differences, loaded, on_both, on_cpu,
    on_gpu, pigment, pure,
};

/// The canvas has 5 x 3 tiles.
const WIDTH: usize = 300;
const HEIGHT: usize = 180;

/// A window's copy of the picture. It reads only the tiles that `refresh` reports.
struct Window {
    second: bool,
    shown: Field<[f32; 4]>,
}

impl Window {
    fn new(second: bool) -> Self {
        Self { second, shown: Field::filled(WIDTH, HEIGHT, [f32::NAN; 4]) }
    }

    /// Reads the changed tiles, and returns their number.
    fn follow(&mut self, painting: &mut Painting) -> usize {
        let bounds = painting.bounds();
        let tiles = painting.refresh(self.second).unwrap();
        for tile in tiles.iter() {
            let rect = tile.rect(bounds);
            let part = painting.picture_in(self.second, rect).unwrap();
            self.shown.put((rect.x, rect.y), &part);
        }
        tiles.len()
    }
}

fn lamp_light() -> Lighting {
    Lighting {
        illuminant: "A".into(),
        azimuth_deg: 100.0,
        elevation_deg: 35.0,
        ..Lighting::default()
    }
}

/// Picture of a newly opened copy of `painting`, under its own light or `other`.
fn anew(painting: &mut Painting, other: Option<&Lighting>) -> Field<[f32; 4]> {
    let mut document = painting.document().unwrap();
    let gpu = !painting.backend().starts_with("the processor");
    document.lighting = Lighting::default();
    let lighting = other.unwrap_or(&painting.state().lighting).clone();
    let mut opened = if gpu { on_gpu(document).unwrap() } else { on_cpu(document) };
    opened.relight(lighting).unwrap();
    opened.picture().unwrap()
}

#[test]
fn a_window_that_reads_what_changed_shows_what_is_there_under_both_lights() {
    for mut painting in on_both(&bare(WIDTH, HEIGHT)) {
        painting.set_second_light(Some(lamp_light())).unwrap();
        let mut first = Window::new(false);
        let mut second = Window::new(true);
        let brush = loaded(&mut painting, HeadShape::Flat, 4.0, WHITE, 0.5);
        let blue = loaded(&mut painting, HeadShape::Round, 3.0, BLUE, 0.5);
        let mut check = |painting: &mut Painting, most: usize, after: &str| {
            for (window, other) in [(&mut first, None), (&mut second, Some(lamp_light()))] {
                let tiles = window.follow(painting);
                assert!((1..=most).contains(&tiles), "after {after}: {tiles} tiles");
                assert!(window.shown == anew(painting, other.as_ref()), "after {after}");
                assert_eq!(window.follow(painting), 0, "twice after {after}");
            }
        };
        check(&mut painting, 15, "nothing");
        painting.stroke(brush, &along(&[(3.0, 4.0), (12.0, 5.0)], 0.5)).unwrap();
        check(&mut painting, 6, "a stroke");
        let mut stroke = painting.begin_stroke(StrokeTool::Paint, blue).unwrap();
        stroke.extend(&along(&[(40.0, 26.0), (56.0, 30.0), (58.0, 34.0)], 0.5)).unwrap();
        assert!(stroke.advance(&mut painting, 30).unwrap() > 0, "a stroke of 30 sub-steps");
        check(&mut painting, 6, "half a stroke");
        stroke.finish(&mut painting).unwrap();
        check(&mut painting, 6, "the rest of it");
        painting.undo().unwrap();
        check(&mut painting, 12, "undo");
        // If you read the whole picture, the set of changed tiles must stay.
        painting.redo().unwrap();
        painting.picture().unwrap();
        check(&mut painting, 12, "redo");
        painting.dry(0.5).unwrap();
        check(&mut painting, 12, "drying");
        painting.set_opacity(LayerRef::Dry(0), 0.5).unwrap();
        check(&mut painting, 15, "opacity");
        let from = pigment("Lead White");
        let to = pigment("Zinc White");
        painting.swap_pigment(LayerRef::Wet, from, to).unwrap();
        check(&mut painting, 15, "another pigment");
        painting.undo().unwrap();
        check(&mut painting, 15, "undoing that");
        painting.flat_picture().unwrap();
        painting.set_second_light(Some(lamp_light())).unwrap();
        check(&mut painting, 15, "a flat picture, and the same light again");
    }
}

#[test]
fn relighting_changes_the_first_view_alone_and_the_second_comes_and_goes() {
    for mut painting in on_both(&bare(WIDTH, HEIGHT)) {
        crossing(&mut painting);
        assert!(painting.second_light().is_none(), "a second light from the start");
        painting.set_second_light(Some(lamp_light())).unwrap();
        assert_eq!(painting.refresh(true).unwrap().len(), 15);
        let before = painting.picture_in(true, painting.bounds()).unwrap();
        painting.refresh(false).unwrap();
        painting.relight(Lighting { azimuth_deg: 45.0, ..Lighting::default() }).unwrap();
        assert!(painting.refresh(true).unwrap().is_empty(), "the second view changed");
        assert_eq!(painting.refresh(false).unwrap().len(), 15);
        let unknown = Lighting { illuminant: "moon".into(), ..Lighting::default() };
        assert!(painting.set_second_light(Some(unknown)).is_err(), "an unknown light");
        assert_eq!(painting.second_light(), Some(&lamp_light()));
        // The direction of the second light changes and changes back. Undo does not touch that
        // light.
        let moved = Lighting { azimuth_deg: 200.0, ..lamp_light() };
        painting.set_second_light(Some(moved)).unwrap();
        painting.refresh(true).unwrap();
        assert!(painting.picture_in(true, painting.bounds()).unwrap() != before, "not moved");
        painting.set_second_light(Some(lamp_light())).unwrap();
        painting.undo().unwrap();
        painting.refresh(true).unwrap();
        assert!(painting.picture_in(true, painting.bounds()).unwrap() == before, "moved back");
        painting.set_second_light(None).unwrap();
        painting.set_second_light(Some(lamp_light())).unwrap();
        assert_eq!(painting.refresh(true).unwrap().len(), 15);
        assert!(painting.picture_in(true, painting.bounds()).unwrap() == before, "set again");
    }
}

#[test]
fn a_heap_that_ends_with_its_tile_is_seen_beyond_it() {
    for mut painting in on_both(&bare(130, 100)) {
        let mut ended = 0;
        for step in 0..12 {
            // Start well inside the first tile (64 cells wide) and go on until the heap crosses its
            // edge.
            let x_mm = (56.0 + 0.25 * f64::from(step)) * CELL_MM;
            painting.squeeze(&pure(WHITE), 0.0, x_mm, 6.0, 3.0).unwrap();
            let wet = painting.wet().unwrap();
            let [last, next] =
                [63, 64].map(|x| (0..64).any(|y| wet.cell(y * 130 + x).volume() > 0));
            ended += usize::from(last && !next);
            let seen = painting.picture().unwrap();
            assert!(seen == anew(&mut painting, None), "step {step}");
            painting.scrape().unwrap();
            let seen = painting.picture().unwrap();
            assert!(seen == anew(&mut painting, None), "scraped, step {step}");
        }
        assert!(ended > 0, "no heap ended with its tile");
    }
}

#[test]
#[should_panic(expected = "the painting has a second light")]
fn no_second_view_without_a_second_light() {
    let mut painting = on_both(&bare(40, 40)).remove(0);
    let _: Result<TileSet, _> = painting.refresh(true);
}

#[test]
fn a_part_of_the_picture_is_that_of_the_whole() {
    for mut painting in on_both(&bare(130, 100)) {
        crossing(&mut painting);
        let whole = painting.picture().unwrap();
        for rect in [
            Rect { x: 0, y: 0, width: 130, height: 100 },
            Rect { x: 0, y: 40, width: 130, height: 7 },
            Rect { x: 17, y: 31, width: 1, height: 1 },
            Rect { x: 60, y: 50, width: 70, height: 50 },
            Rect { x: 5, y: 5, width: 0, height: 0 },
        ] {
            assert!(painting.picture_in(false, rect).unwrap() == whole.part(rect), "{rect:?}");
        }
    }
}

const RECTS: [Rect; 4] = [
    Rect { x: 0, y: 0, width: 130, height: 100 },
    Rect { x: 61, y: 13, width: 9, height: 58 },
    Rect { x: 40, y: 40, width: 1, height: 1 },
    Rect { x: 100, y: 70, width: 30, height: 30 },
];

#[test]
fn a_part_of_wet_and_dry_paint_is_that_of_the_whole() {
    for mut painting in on_both(&bare(130, 100)) {
        crossing(&mut painting);
        painting.dry(0.6).unwrap();
        crossing(&mut painting);
        painting.dry(0.3).unwrap();
        let document = painting.document().unwrap();
        for rect in RECTS {
            assert!(painting.wet_in(rect).unwrap() == document.wet.part(rect), "{rect:?}");
            for (index, layer) in document.dry.iter().enumerate() {
                let found = painting.dry_in(index, rect).unwrap();
                assert!(found == layer.paint.part(rect), "layer {index}, {rect:?}");
            }
        }
        let error = painting.dry_in(2, RECTS[1]).unwrap_err();
        assert!(matches!(error, PaintingError::NoLayer { index: 2, count: 2 }), "{error}");
    }
}

#[test]
fn the_reflectance_of_a_place_is_the_mean_of_its_cells() {
    for mut painting in on_both(&bare(130, 100)) {
        crossing(&mut painting);
        painting.dry(0.6).unwrap();
        painting.set_opacity(LayerRef::Dry(0), 1.7).unwrap();
        crossing(&mut painting);
        let document = painting.document().unwrap();
        let spectral = SpectralDocument::full(&document);
        for rect in &RECTS[1..] {
            let found = painting.reflectance_in(*rect).unwrap();
            let mut wanted = vec![0.0; spectral.count()];
            for y in rect.y..rect.y + rect.height {
                for x in rect.x..rect.x + rect.width {
                    for (sum, one) in wanted.iter_mut().zip(spectral.measured_reflectance(x, y)) {
                        *sum += one;
                    }
                }
            }
            let cells = (rect.width * rect.height) as f64;
            assert_eq!(found.len(), wanted.len());
            for (found, wanted) in found.iter().zip(wanted) {
                assert!((found - wanted / cells).abs() < 1e-12, "{found} of {rect:?}");
            }
            let unlike = found.iter().any(|value| (value - found[0]).abs() > 0.01);
            assert!(unlike, "a flat spectrum, {found:?}, at {rect:?}");
        }
    }
}

/// Nobody sees a colour difference up to this, in CIEDE2000.
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
        let mut document = bare(130, 100);
        // Thin paint in two layers covers less of its cell than in one.
        document.medium.films_break = fraction == 1.0;
        for mut painting in on_both(&document) {
            crossing(&mut painting);
            let before = painting.flat_picture().unwrap();
            assert!(painting.dry(fraction).unwrap(), "there was paint");
            let moved = largest(&before, &painting.flat_picture().unwrap());
            assert!(moved < UNSEEN, "{fraction} dried moved a colour by {moved}");
            assert!(painting.wet_totals_mm().unwrap()[WHITE] >= 0.0);
        }
    }
}

/// Paints two overlapping strokes with the pigments in `slots`, and dries each to its own layer.
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
    let even = Medium { films_break: false, ..Medium::default() };
    for painting in on_both(&Document { medium: even, ..bare(130, 100) }) {
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
fn like_layers_merge_where_thin_paint_breaks() {
    for painting in on_both(&bare(130, 100)) {
        let mut painting = two_layers(painting, [YELLOW, YELLOW]);
        painting.merge(LayerRef::Dry(0), LayerRef::Dry(1)).unwrap();
        assert!(painting.medium().films_break, "only the test of the merge has even films");
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
        // The refused merge is not a step of the history, so the last step is the drying.
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
        // Near black, rounding to 8 bits alone gives up to 1 CIEDE2000.
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
    let channels = channels.iter();
    channels.map(|own| (own.name.to_string(), channel_values(&own.sample_data))).collect()
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
