//! Effects, textures and settings of watercolour, on CPU and GPU. Applies each effect to fields
//! (upload, compute, download) and compares it on the CPU with its definition.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use graphics::compute::{Compute, GreyImage, Image};
use graphics::field::Field;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::color::{Lab, Rgb, RgbSpace};
use suite::program::device;
use watercolor::{
    self as effects, ColorRange, DensityLayer, DryBrushReach, PaperShading, Settings,
};

mod twins;
mod photographs;

/// A random picture of small patches with a coverage of 0, 1 or between.
fn any_picture(width: usize, height: usize, seed: u64) -> Field<[f32; 4]> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let patches: Vec<[f32; 4]> = (0..64)
        .map(|i| {
            let mut color: [f32; 4] = std::array::from_fn(|_| random.random_range(0.0..1.0));
            color[3] = [0.0, 1.0, 1.0, color[3]][i % 4];
            color
        })
        .collect();
    Field::from_values(
        width,
        height,
        (0..width * height)
            .map(|i: usize| patches[(i % width / 5 + i / width / 4 * 7) % 64])
            .collect(),
    )
}

/// `settings` without effects, on smooth white paper.
fn without_effects(mut settings: Settings) -> Settings {
    settings.wash.density = 1.0;
    settings.wobble.amount_px = 0.0;
    settings.edges.strength = 0.0;
    settings.flow.strength = 0.0;
    settings.back_runs.strength = 0.0;
    settings.dispersion.strength = 0.0;
    settings.paper.strength = 0.0;
    settings.paper.relief = 0.0;
    "#ffffff".clone_into(&mut settings.paper.color);
    settings.dry_brush.amount = 0.0;
    settings
}

fn any_grey(width: usize, height: usize, seed: u64) -> Field<f32> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let values = (0..width * height).map(|_| random.random_range(0.0..1.0)).collect();
    Field::from_values(width, height, values)
}

fn numbers(field: &Field<[f32; 4]>) -> Vec<f64> {
    field.values().iter().flatten().map(|&value| f64::from(value)).collect()
}

fn greys(field: &Field<f32>) -> Vec<f64> {
    field.values().iter().map(|&value| f64::from(value)).collect()
}

#[test]
fn pictures_survive_upload_and_download() {
    let field = Field::from_values(3, 2, (0..6).map(|i| [i as f32 / 8.0; 4]).collect());
    let mut cpu = Compute::cpu();
    let image = cpu.upload(&field).unwrap();
    assert_eq!(cpu.download(&image).unwrap(), field);
    let Some(mut gpu) = device().map(Compute::gpu) else { return };
    let image = gpu.upload(&field).unwrap();
    assert_eq!(image.size(), (3, 2));
    assert_eq!(gpu.download(&image).unwrap(), field);
}

type Colors = Field<[f32; 4]>;
type Greys = Field<f32>;

/// A texture with its strength and pivot.
type Layer<'a> = (&'a Greys, f32, f32);

fn uploaded(compute: &mut Compute, mask: Option<&Greys>) -> Option<GreyImage> {
    mask.map(|mask| compute.upload(mask).unwrap())
}

fn downloaded<T: bytemuck::Pod>(compute: &mut Compute, image: &Image<T>) -> Field<T> {
    compute.download(image).unwrap()
}

fn apply_density(
    compute: &mut Compute,
    color: &Colors,
    overall: f32,
    layers: &[Layer<'_>],
    mask: Option<&Greys>,
) -> Colors {
    let image = compute.upload(color).unwrap();
    let textures: Vec<_> =
        layers.iter().map(|(texture, ..)| compute.upload(*texture).unwrap()).collect();
    let layers: Vec<_> = layers
        .iter()
        .zip(&textures)
        .map(|(&(_, strength, pivot), texture)| DensityLayer { texture, strength, pivot })
        .collect();
    let mask = uploaded(compute, mask);
    let found = effects::apply_density(compute, image, overall, &layers, mask.as_ref()).unwrap();
    downloaded(compute, &found)
}

fn edges(compute: &mut Compute, color: &Colors, width_px: f32) -> Greys {
    let image = compute.upload(color).unwrap();
    let found = effects::edges(compute, &image, width_px).unwrap();
    downloaded(compute, &found)
}

fn wobble(compute: &mut Compute, color: &Colors, heights: &Greys, px_per_slope: f32) -> Colors {
    let image = compute.upload(color).unwrap();
    let heights = compute.upload(heights).unwrap();
    let found = effects::wobble(compute, image, &heights, px_per_slope).unwrap();
    downloaded(compute, &found)
}

fn apply_dry_brush(
    compute: &mut Compute,
    color: &Colors,
    (heights, flow): (&Greys, &Greys),
    reach: DryBrushReach,
    (edges, mask): (Option<&Greys>, Option<&Greys>),
) -> Colors {
    let image = compute.upload(color).unwrap();
    let heights = compute.upload(heights).unwrap();
    let flow = compute.upload(flow).unwrap();
    let [edges, mask] = [edges, mask].map(|greys| uploaded(compute, greys));
    let edges = edges.as_ref();
    let mask = mask.as_ref();
    let found =
        effects::apply_dry_brush(compute, image, &heights, &flow, reach, edges, mask).unwrap();
    downloaded(compute, &found)
}

fn color_mask(
    compute: &mut Compute,
    color: &Colors,
    range: ColorRange,
    mask: Option<&Greys>,
) -> Greys {
    let image = compute.upload(color).unwrap();
    let mask = uploaded(compute, mask);
    let found = effects::color_mask(compute, &image, range, mask.as_ref()).unwrap();
    downloaded(compute, &found)
}

fn shade_paper(
    compute: &mut Compute,
    color: &Colors,
    heights: &Greys,
    shading: PaperShading,
) -> Colors {
    let image = compute.upload(color).unwrap();
    let heights = compute.upload(heights).unwrap();
    let found = effects::shade_paper(compute, image, &heights, shading).unwrap();
    downloaded(compute, &found)
}

fn layer(texture: &Field<f32>, strength: f32) -> [Layer<'_>; 1] {
    [(texture, strength, 0.5)]
}

#[test]
fn density_2_squares_and_density_1_keeps_the_bits() {
    let picture = any_picture(40, 30, 1);
    let ones = Field::filled(40, 30, 1.0);
    let middle = Field::filled(40, 30, 0.5);
    for (overall, texture, strength) in [(1.0, &ones, 2.0), (2.0, &middle, 2.0)] {
        let found =
            apply_density(&mut Compute::Cpu, &picture, overall, &layer(texture, strength), None);
        for (found, c) in found.values().iter().zip(picture.values()) {
            let squared =
                if c[3] > 0.0 { [c[0] * c[0], c[1] * c[1], c[2] * c[2], c[3]] } else { *c };
            assert_eq!(*found, squared, "of {c:?}");
        }
    }
    let grey = any_grey(40, 30, 2);
    for (texture, strength) in [(&middle, 2.0), (&grey, 0.0)] {
        let found =
            apply_density(&mut Compute::Cpu, &picture, 1.0, &layer(texture, strength), None);
        assert_eq!(found, picture);
    }
    let none = Field::filled(40, 30, 0.0);
    let masked = apply_density(&mut Compute::Cpu, &picture, 1.0, &layer(&grey, 2.0), Some(&none));
    assert_eq!(masked, picture, "a mask of 0");
}

#[test]
fn density_is_the_formula_within_its_limits() {
    let picture = any_picture(33, 21, 3);
    let texture = any_grey(33, 21, 4);
    for strength in [-3.0, -0.4, 0.7, 1.9, 9.0] {
        let found =
            apply_density(&mut Compute::Cpu, &picture, 1.0, &layer(&texture, strength), None);
        for i in 0..found.values().len() {
            let found = found.values()[i];
            let c = picture.values()[i];
            let d = (1.0 + f64::from(strength) * (f64::from(texture.values()[i]) - 0.5)).max(0.0);
            for channel in 0..3 {
                let c_i = f64::from(c[channel]);
                let wanted = (c_i * (1.0 - (1.0 - c_i) * (d - 1.0))).clamp(0.0, 1.0);
                let wanted = if c[3] > 0.0 { wanted } else { c_i };
                let off = (f64::from(found[channel]) - wanted).abs();
                assert!(off < 1e-6, "strength {strength}, {c:?}: {found:?}");
            }
            assert_eq!(found[3].to_bits(), c[3].to_bits());
        }
    }
}

/// A column of opaque paint on bare paper. Bare pixels have an arbitrary colour. This must not
/// matter.
fn column(color: [f32; 3]) -> Field<[f32; 4]> {
    let [r, g, b] = color;
    Field::from_values(
        30,
        8,
        (0..240)
            .map(
                |i: usize| {
                    if (10..20).contains(&(i % 30)) { [r, g, b, 1.0] } else { [0.1, 0.2, 0.3, 0.0] }
                },
            )
            .collect(),
    )
}

#[test]
fn edges_darken_inside_the_paint_only_and_at_both_its_sides() {
    let picture = column([0.8, 0.7, 0.6]);
    for width_px in [0.0, 1.5] {
        let edges = edges(&mut Compute::Cpu, &picture, width_px);
        let layers = [(&edges, 1.5, 0.0)];
        let found = apply_density(&mut Compute::Cpu, &picture, 1.0, &layers, None);
        for x in 0..30 {
            let before = picture[(x, 4)];
            let after = found[(x, 4)];
            if !(10..20).contains(&x) {
                assert_eq!(before, after, "bare paper at {x}");
            } else if [10, 19].contains(&x) {
                assert!(after[0] < before[0] - 0.05, "the rim at {x}: {after:?}");
            } else if (14..16).contains(&x) {
                assert!((after[0] - before[0]).abs() < 1e-2, "the middle at {x}: {after:?}");
            }
            let mirrored = found[(29 - x, 4)];
            assert!((mirrored[0] - after[0]).abs() < 1e-6, "both sides alike at {x}");
        }
    }
}

#[test]
fn edges_are_the_symmetric_gradient() {
    let mut picture = any_picture(17, 12, 5);
    picture.values_mut().iter_mut().for_each(|color| color[3] = 1.0);
    let edges = edges(&mut Compute::Cpu, &picture, 0.0);
    for y in 0..12 {
        for x in 0..17 {
            let p = |x: usize, y: usize| picture[(x.clamp(1, 17) - 1, y.clamp(1, 12) - 1)];
            let x1 = x + 1;
            let y1 = y + 1;
            let sum: f32 = (0..3)
                .map(|i| {
                    (p(x1 - 1, y1)[i] - p(x1 + 1, y1)[i]).abs()
                        + (p(x1, y1 - 1)[i] - p(x1, y1 + 1)[i]).abs()
                })
                .sum();
            assert!((edges[(x, y)] - sum / 3.0).abs() < 1e-6, "at {x}, {y}");
        }
    }
    // A blur widens the gradient of a step by `width_px` and preserves its sum.
    let step = (0..400).map(|i| if i % 40 < 20 { [0.0, 0.0, 0.0, 1.0] } else { [1.0; 4] });
    let step = Field::from_values(40, 10, step.collect());
    for width_px in [0.0, 0.7, 2.0] {
        let edges = self::edges(&mut Compute::Cpu, &step, width_px);
        let row = edges.row(5, 0, 40);
        let sum: f32 = row.iter().sum();
        assert!((sum - 2.0).abs() < 1e-5, "{width_px}: {sum}");
        let around = row.iter().zip(0..).map(|(e, x)| e * (x as f32 - 19.5_f32).powi(2));
        let spread = (around.sum::<f32>() / sum).sqrt();
        // The difference over two pixels itself has a spread of half a pixel.
        let wanted = width_px.hypot(0.5);
        assert!((spread - wanted).abs() < 0.1 * wanted, "{width_px}: {spread} for {wanted}");
    }
}

#[test]
fn wobble_displaces_by_the_stated_px() {
    // Heights rise by 0.01 a pixel to the right and by 0.02 downwards.
    let heights = (0..60 * 50).map(|i| 0.01 * (i % 60) as f32 + 0.02 * (i / 60) as f32);
    let heights = Field::from_values(60, 50, heights.collect());
    let picture = Field::from_values(
        60,
        50,
        (0..3000)
            .map(|i: usize| [(i % 60) as f32 / 100.0, (i / 60) as f32 / 100.0, 0.5, 1.0])
            .collect(),
    );
    for px_per_slope in [30.0, -75.0, 122.5] {
        let found = wobble(&mut Compute::Cpu, &picture, &heights, px_per_slope);
        let x = 0.02 * px_per_slope;
        let y = 0.04 * px_per_slope;
        for at in [(20, 20), (31, 17), (25, 30)] {
            let [red, green, blue, covered] = found[at];
            let wanted = [(at.0 as f32 + x) / 100.0, (at.1 as f32 + y) / 100.0, 0.5, 1.0];
            for (found, wanted) in [red, green, blue, covered].iter().zip(wanted) {
                assert!(
                    (found - wanted).abs() < 1e-5,
                    "{px_per_slope} at {at:?}: {found} {wanted}"
                );
            }
        }
    }
    let still = wobble(&mut Compute::Cpu, &picture, &heights, 0.0);
    assert_eq!(still, picture);
}

#[test]
fn wobble_never_mixes_in_the_color_of_bare_paper() {
    let picture = column([0.9, 0.8, 0.7]);
    let found = wobble(&mut Compute::Cpu, &picture, &any_grey(30, 8, 6), 2.3);
    for color in found.values().iter().filter(|color| color[3] > 0.0) {
        for (found, wanted) in color.iter().zip([0.9, 0.8, 0.7]) {
            assert!((found - wanted).abs() < 1e-6, "{color:?}");
        }
    }
    assert!(found.values().iter().any(|color| color[3] > 0.0 && color[3] < 1.0));
}

#[test]
fn a_dry_brush_leaves_the_share_of_paper_below_its_threshold() {
    let heights = any_grey(200, 100, 7);
    let flow = Field::filled(200, 100, 0.5);
    let paint = Field::filled(200, 100, [0.2, 0.3, 0.4, 1.0]);
    fn reach(threshold: f32) -> DryBrushReach {
        DryBrushReach { threshold, softness: 1e-3, patches: 0.0, outline: 0.0, darkest: 0.0 }
    }
    for threshold in [0.1, 0.37, 0.8] {
        let found = apply_dry_brush(
            &mut Compute::Cpu,
            &paint,
            (&heights, &flow),
            reach(threshold),
            (None, None),
        );
        let covered: f32 = found.values().iter().map(|color| color[3]).sum();
        let below = heights.values().iter().filter(|height| **height < threshold).count();
        let bare = 20000.0 - covered;
        assert!((bare - below as f32).abs() < 60.0, "{threshold}: {bare} bare, {below} below");
        assert!(found.values().iter().all(|c| c[..3] == [0.2, 0.3, 0.4]), "colours stay");
    }
    let none = Field::filled(200, 100, 0.0);
    let masked = apply_dry_brush(
        &mut Compute::Cpu,
        &paint,
        (&heights, &flow),
        reach(0.6),
        (None, Some(&none)),
    );
    assert_eq!(masked, paint, "a mask of 0");
    assert_eq!(
        apply_dry_brush(&mut Compute::Cpu, &paint, (&heights, &flow), reach(0.0), (None, None)),
        paint
    );
    let patches = DryBrushReach { patches: 1.0, ..reach(0.6) };
    let thick =
        apply_dry_brush(&mut Compute::Cpu, &paint, (&heights, &flow), patches, (None, None));
    assert_eq!(thick, paint, "a thick wash");
    let thin = Field::filled(200, 100, 0.1);
    let all = apply_dry_brush(&mut Compute::Cpu, &paint, (&heights, &thin), patches, (None, None));
    let whole =
        apply_dry_brush(&mut Compute::Cpu, &paint, (&heights, &flow), reach(0.6), (None, None));
    assert_eq!(all, whole, "a thin wash");
}

#[test]
fn a_dry_brush_keeps_from_outlines_and_from_dark_washes() {
    let heights = any_grey(60, 40, 17);
    let flow = Field::filled(60, 40, 0.5);
    let reach = DryBrushReach {
        threshold: 0.6,
        softness: 1e-3,
        patches: 0.0,
        outline: 20.0,
        darkest: 0.25,
    };
    let light = Field::filled(60, 40, [0.6, 0.7, 0.5, 1.0]);
    let on = |color: &Field<_>, edges: Option<&Field<f32>>| {
        let paper = (&heights, &flow);
        apply_dry_brush(&mut Compute::Cpu, color, paper, reach, (edges, None))
    };
    fn bare(found: &Field<[f32; 4]>, columns: std::ops::Range<usize>) -> usize {
        let rows = (0..40).flat_map(|y| columns.clone().map(move |x| (x, y)));
        rows.filter(|&at| found[at][3] < 0.5).count()
    }
    // There is an outline along the middle.
    let strength = (0..2400).map(|i| if (25..35).contains(&(i % 60)) { 0.1 } else { 0.0 });
    let edges = Field::from_values(60, 40, strength.collect());
    let found = on(&light, Some(&edges));
    assert_eq!(bare(&found, 25..35), 0, "bare paper on the outline");
    assert!(bare(&found, 0..25) > 400, "{} bare away from it", bare(&found, 0..25));
    let dark = Field::filled(60, 40, [0.2, 0.25, 0.3, 1.0]);
    assert_eq!(on(&dark, None), dark, "a dark wash");
    let between = Field::filled(60, 40, [0.3, 0.35, 0.4, 1.0]);
    let [some, all] = [&between, &light].map(|color| bare(&on(color, None), 0..60));
    assert!(some > 100 && some < all, "{some} bare in a wash between, {all} in a light one");
}

#[test]
fn wobble_on_finer_paper_is_the_mean_of_its_cells() {
    let fine = any_grey(72, 54, 19);
    // Even paint stays even, and its coverage is a mean.
    let even = Field::filled(24, 18, [0.3, 0.5, 0.7, 1.0]);
    for color in wobble(&mut Compute::Cpu, &even, &fine, 2.0).values() {
        for (found, wanted) in color.iter().zip([0.3, 0.5, 0.7, 1.0]) {
            assert!((found - wanted).abs() < 1e-5, "{color:?}");
        }
    }
    // A slope of one cell's height displaces all samples by the same distance.
    let ramp = Field::from_values(72, 54, (0..72 * 54).map(|i| 0.01 * (i % 72) as f32).collect());
    let colors = (0..24 * 18).map(|i| [(i % 24) as f32 / 100.0, 0.5, 0.5, 1.0]).collect();
    let found = wobble(&mut Compute::Cpu, &Field::from_values(24, 18, colors), &ramp, 100.0);
    assert!((found[(10, 9)][0] - 0.12).abs() < 1e-5, "{:?}", found[(10, 9)]);
}

#[test]
fn colors_alike_are_told_by_cielab() {
    let picture = any_picture(40, 40, 8);
    let like = Rgb::from_hex("#8060a0").unwrap();
    fn lab(rgb: Rgb) -> [f64; 3] {
        let white = RgbSpace::Srgb.white();
        let xyz = RgbSpace::Srgb.xyz_from_linear().apply(rgb.linear().0);
        Lab::from_xyz(xyz.into(), white).to_array()
    }
    let range = ColorRange::around(like, 40.0);
    let found = color_mask(&mut Compute::Cpu, &picture, range, None);
    for (found, color) in found.values().iter().zip(picture.values()) {
        let own = lab(Rgb([color[0], color[1], color[2]].map(f64::from)));
        let off = own.iter().zip(lab(like)).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        let wanted = (3.0 - 2.0 * off / 40.0).clamp(0.0, 1.0);
        assert!((f64::from(*found) - wanted).abs() < 1e-4, "{color:?}: {found} {wanted}");
    }
    let some = found.values().iter().filter(|value| **value > 0.0).count();
    assert!((1..1600).contains(&some), "{some} of 1600 pixels are alike");
}

#[test]
fn a_sheet_shows_its_color_where_bare_and_its_slopes_in_the_light() {
    let heights = Field::from_values(30, 8, (0..240).map(|i| 0.02 * (i % 30) as f32).collect());
    let picture = column([0.5, 0.4, 0.3]);
    let shading = PaperShading { color: [0.9, 0.8, 0.7], relief: 0.5 };
    let found = shade_paper(&mut Compute::Cpu, &picture, &heights, shading);
    // The heights rise by 0.04 over two pixels, and the relief is 0.5.
    let light = 1.02;
    for (x, own) in [(5, [1.0, 1.0, 1.0]), (15, [0.5, 0.4, 0.3])] {
        for i in 0..3 {
            let wanted = own[i] * shading.color[i] * light;
            assert!((found[(x, 4)][i] - wanted).abs() < 1e-6, "{x}: {:?}", found[(x, 4)]);
        }
    }
    assert!(found.values().iter().all(|color| color[3].to_bits() == 1.0_f32.to_bits()));
    let white = PaperShading { color: [1.0; 3], relief: 0.0 };
    let mut full = any_picture(30, 8, 9);
    full.values_mut().iter_mut().for_each(|color| color[3] = 1.0);
    assert_eq!(shade_paper(&mut Compute::Cpu, &full, &heights, white), full);
}
