//! Every effect on the GPU compared with the CPU, the pipeline of all effects with its stages and
//! observer, and textures of flow, dispersion and paper (mean, spread, spectrum and seed).

use documents::hint::Explain;
use graphics::compute::Compute;
use graphics::field::Field;
use spectra::color::Rgb;
use suite::golden::assert_near;
use suite::program::device;
use watercolor::{
    ColorRange, Controls, DispersionSettings, DryBrushReach, FlowSettings, FrameTextures,
    PaperSettings, PaperShading, PaperTexture, PaperTextureError, Preset, Settings, Stage,
    StageObserver, Textures, Wash, dispersion, paint, turbulent_flow,
};

use super::{
    Layer, any_grey, any_picture, apply_density, apply_dry_brush, color_mask, edges, greys,
    numbers, shade_paper, without_effects, wobble,
};
use paint::ground::PaperFinish;

/// Tolerance for f32 where only one of the two backends uses fused multiply-add.
const NEAR: f64 = 2e-6;

/// Sizes of pictures, below and above the size of a workgroup and of a band of rows.
const SIZES: [(usize, usize); 6] = [(1, 1), (1, 9), (7, 5), (8, 8), (67, 33), (30, 71)];

/// Both backends, and a picture of one of the [`SIZES`].
struct Both {
    cpu: Compute,
    gpu: Compute,
    size: (usize, usize),
    picture: Field<[f32; 4]>,
}

impl Both {
    fn for_each(mut each: impl FnMut(&mut Self)) {
        let Some(device) = device() else { return };
        let picture = any_picture(1, 1, 0);
        let cpu = Compute::cpu();
        let gpu = Compute::gpu(device);
        let mut both = Self { cpu, gpu, size: (1, 1), picture };
        for (seed, (width, height)) in (0..).zip(SIZES) {
            (both.size, both.picture) = ((width, height), any_picture(width, height, seed));
            each(&mut both);
        }
    }

    fn grey(&self, seed: u64) -> Field<f32> {
        any_grey(self.size.0, self.size.1, seed)
    }

    /// Asserts that both backends compute the same picture within `near`.
    fn compare(
        &mut self,
        case: &str,
        near: f64,
        effect: impl Fn(&mut Compute, &Field<[f32; 4]>) -> Field<[f32; 4]>,
    ) {
        let wanted = effect(&mut self.cpu, &self.picture);
        let found = effect(&mut self.gpu, &self.picture);
        assert_near(format!("{case}, {:?}", self.size), &numbers(&found), &numbers(&wanted), near);
    }

    /// Asserts that both backends compute the same grey values within `near`.
    fn compare_greys(
        &mut self,
        case: &str,
        near: f64,
        effect: impl Fn(&mut Compute, &Field<[f32; 4]>) -> Field<f32>,
    ) {
        let wanted = effect(&mut self.cpu, &self.picture);
        let found = effect(&mut self.gpu, &self.picture);
        assert_near(format!("{case}, {:?}", self.size), &greys(&found), &greys(&wanted), near);
    }
}

#[test]
fn density_agrees() {
    Both::for_each(|both| {
        let textures: Vec<_> = (0..6).map(|seed| both.grey(seed)).collect();
        for strengths in
            [&[][..], &[0.0], &[1.3], &[-2.0, 0.5, 9.0, 2.0], &[0.4, 1.0, -1.0, 3.0, 2.0]]
        {
            for (overall, masked) in [(1.0, false), (0.3, false), (2.5, true), (0.0, true)] {
                let mask = masked.then_some(&textures[5]);
                let layers: Vec<Layer<'_>> = (0..strengths.len())
                    .map(|i| (&textures[i], strengths[i], [0.5, 0.0][i % 2]))
                    .collect();
                let case = format!("{strengths:?}, {overall}, {masked}");
                // A strength of 9 makes rounding errors larger.
                both.compare(&case, 10.0 * NEAR, |compute, picture| {
                    apply_density(compute, picture, overall, &layers, mask)
                });
            }
        }
    });
}

#[test]
fn edges_agree() {
    Both::for_each(|both| {
        for width_px in [0.0, 0.1, 0.5, 1.0, 3.3, 12.0] {
            let case = format!("{width_px} px");
            both.compare_greys(&case, NEAR, |compute, picture| edges(compute, picture, width_px));
        }
    });
}

#[test]
fn wobble_agrees() {
    Both::for_each(|both| {
        let heights = both.grey(11);
        for px in [0.0_f32, 0.01, 0.8, -3.0, 500.0] {
            // At low coverage the colour is a quotient of small numbers. The error of a position
            // grows with the displacement.
            let near = NEAR * (10.0 + 10.0 * f64::from(px.abs()));
            both.compare(&format!("{px} px"), near, |compute, picture| {
                wobble(compute, picture, &heights, px)
            });
        }
    });
}

#[test]
fn wobble_on_finer_paper_agrees() {
    Both::for_each(|both| {
        let (width, height) = both.size;
        for factor in [2, 5] {
            let heights = any_grey(width * factor, height * factor, 22);
            for px in [0.3_f32, -4.0] {
                let near = NEAR * (10.0 + 10.0 * f64::from(px.abs()));
                both.compare(&format!("{factor} cells, {px} px"), near, |compute, picture| {
                    wobble(compute, picture, &heights, px)
                });
            }
        }
    });
}

#[test]
fn dry_brush_agrees() {
    Both::for_each(|both| {
        let heights = both.grey(12);
        let flow = both.grey(13);
        let mask = both.grey(14);
        let edges = both.grey(21);
        for threshold in [0.0, 0.2, 0.9] {
            for (softness, patches, masked, outline, darkest) in [
                (0.1, 0.0, false, 0.0, 0.0),
                (0.5, 0.6, true, 2.0, 0.0),
                (0.02, 1.0, true, 0.0, 0.3),
                (0.2, 0.0, false, 1.5, 0.4),
            ] {
                let reach = DryBrushReach { threshold, softness, patches, outline, darkest };
                let mask = masked.then_some(&mask);
                let edges = (outline > 0.0).then_some(&edges);
                // Rounding errors grow with the inverse of the softness.
                let near = 4.0 * NEAR / f64::from(softness);
                both.compare(&format!("{reach:?}"), near, |compute, picture| {
                    apply_dry_brush(compute, picture, (&heights, &flow), reach, (edges, mask))
                });
            }
        }
    });
}

#[test]
fn color_mask_agrees() {
    Both::for_each(|both| {
        let mask = both.grey(15);
        for (color, tolerance) in [("#ffffff", 30.0), ("#4060a0", 1.0), ("#000000", 200.0)] {
            for mask in [None, Some(&mask)] {
                let range = ColorRange::around(Rgb::from_hex(color).unwrap(), tolerance);
                // `pow` of WGSL is inexact, and the mask divides errors in CIELAB by its tolerance.
                let near = 1e-3 / f64::from(tolerance);
                both.compare_greys(&format!("{color} {tolerance}"), near, |compute, picture| {
                    color_mask(compute, picture, range, mask)
                });
            }
        }
    });
}

#[test]
fn paper_shading_agrees() {
    Both::for_each(|both| {
        let heights = both.grey(16);
        for (color, relief) in [([1.0; 3], 0.0), ([0.9, 0.8, 0.6], 0.4), ([0.2, 1.0, 0.0], 5.0)] {
            let shading = PaperShading { color, relief };
            both.compare(&format!("{shading:?}"), NEAR, |compute, picture| {
                shade_paper(compute, picture, &heights, shading)
            });
        }
    });
}

type Stages = Vec<(Stage, Field<[f32; 4]>)>;

fn painted(
    compute: &mut Compute,
    wash: &Wash,
    settings: &Settings,
    observed: bool,
) -> (Field<[f32; 4]>, Stages) {
    let textures = Textures::of_photograph(&wash.color, settings).unwrap();
    let textures = textures.upload(compute).unwrap();
    let wash = wash.upload(compute).unwrap();
    let mut stages = Vec::new();
    let mut keep = |stage, color| stages.push((stage, color));
    let observer: Option<StageObserver<'_>> = if observed { Some(&mut keep) } else { None };
    let textures = FrameTextures::from(&textures);
    let color = paint(compute, wash, textures, settings, observer).unwrap();
    (compute.download(&color).unwrap(), stages)
}

fn wash(width: usize, height: usize) -> Wash {
    let controls = Controls {
        dry_brush: Some(any_grey(width, height, 31)),
        density: Some(any_grey(width, height, 32)),
    };
    Wash { color: any_picture(width, height, 33), controls }
}

#[test]
fn without_effects_the_picture_stays() {
    let settings = without_effects(Settings::default().for_size(48, 40));
    for color in [[0.3, 0.6, 0.9, 1.0], [0.0, 0.0, 0.0, 1.0], [1.0; 4], [0.123_456_7; 4]] {
        let mut color = color;
        color[3] = 1.0;
        let field = Field::filled(48, 40, color);
        let plain = Wash { color: field.clone(), controls: Controls::default() };
        let (found, stages) = painted(&mut Compute::cpu(), &plain, &settings, true);
        assert_eq!(found, field);
        assert_eq!(stages.len(), Stage::ALL.len());
        for (stage, picture) in stages {
            assert_eq!(picture, field, "{stage:?}");
        }
        let Some(mut gpu) = device().map(Compute::gpu) else { continue };
        let (found, stages) = painted(&mut gpu, &plain, &settings, true);
        assert_eq!(found, field, "on the device");
        stages.iter().for_each(|(stage, picture)| assert_eq!(*picture, field, "{stage:?}"));
    }
}

#[test]
fn an_observer_changes_nothing_and_every_stage_does_something() {
    let wash = wash(90, 70);
    for preset in Preset::ALL {
        let mut settings = preset.settings().for_size(90, 70);
        settings.wobble.amount_px = 1.0;
        settings.dry_brush.amount = 0.3;
        settings.dry_brush.patches = 0.0;
        settings.dry_brush.outline_px = 0.0;
        settings.back_runs.strength = 1.0;
        settings.back_runs.share = 1.0;
        let (alone, none) = painted(&mut Compute::cpu(), &wash, &settings, false);
        let (observed, stages) = painted(&mut Compute::cpu(), &wash, &settings, true);
        assert!(none.is_empty());
        assert_eq!(alone, observed, "{preset:?}");
        let order: Vec<Stage> = stages.iter().map(|(stage, _)| *stage).collect();
        assert_eq!(order, Stage::ALL);
        for pair in stages.windows(2) {
            assert_ne!(pair[0].1, pair[1].1, "{preset:?}: {:?}", pair[1].0);
        }
        assert_eq!(stages.last().unwrap().1, observed);
    }
}

#[test]
fn processor_and_device_paint_the_same() {
    let Some(mut gpu) = device().map(Compute::gpu) else { return };
    let wash = wash(130, 90);
    for preset in Preset::ALL {
        let mut settings = preset.settings().for_size(900, 600);
        settings.dry_brush.color = Some("#808080".to_owned());
        for observed in [false, true] {
            let (here, before) = painted(&mut Compute::cpu(), &wash, &settings, observed);
            let (there, after) = painted(&mut gpu, &wash, &settings, observed);
            // Displacement and a narrow band of the dry brush make rounding errors larger.
            assert_near(format!("{preset:?}"), &numbers(&there), &numbers(&here), 5e-4);
            for ((stage, here), (_, there)) in before.iter().zip(&after) {
                let case = format!("{preset:?}, {stage:?}");
                assert_near(case, &numbers(there), &numbers(here), 5e-4);
            }
        }
    }
}

const SIZE: usize = 512;

fn moments(field: &Field<f32>) -> (f64, f64) {
    let count = field.values().len() as f64;
    let mean = field.values().iter().map(|&v| f64::from(v)).sum::<f64>() / count;
    let squares = field.values().iter().map(|&v| (f64::from(v) - mean).powi(2)).sum::<f64>();
    (mean, (squares / count).sqrt())
}

/// Side of the square that we compute the spectrum of, in pixels.
const PART: usize = 256;

/// Power of the upper left square by radial frequency, in waves per [`PART`] pixels. A Hann window
/// suppresses leakage from its borders.
fn spectrum(field: &Field<f32>) -> Vec<f64> {
    let turn = std::f64::consts::TAU / PART as f64;
    let window: Vec<f64> = (0..PART).map(|i| 0.5 - 0.5 * (turn * i as f64).cos()).collect();
    let waves: Vec<(f64, f64)> = (0..PART).map(|i| (turn * i as f64).sin_cos()).collect();
    let transformed = |row: &[[f64; 2]]| -> Vec<[f64; 2]> {
        (0..PART)
            .map(|wave: usize| {
                row.iter().enumerate().fold([0.0; 2], |[re, im], (x, [a, b])| {
                    let (sin, cos) = waves[wave * x % PART];
                    [re + a * cos + b * sin, im + b * cos - a * sin]
                })
            })
            .collect()
    };
    let rows = (0..PART).map(|y| {
        let row =
            (0..PART).map(|x| [(f64::from(field[(x, y)]) - 0.5) * window[x] * window[y], 0.0]);
        transformed(&row.collect::<Vec<_>>())
    });
    let rows: Vec<_> = rows.collect();
    let mut power = vec![0.0; PART];
    for x in 0..PART {
        let column = transformed(&rows.iter().map(|row| row[x]).collect::<Vec<_>>());
        for (y, [re, im]) in column.into_iter().enumerate() {
            let [x, y] = [x, y].map(|i| i.min(PART - i) as f64);
            power[x.hypot(y).round() as usize] += re * re + im * im;
        }
    }
    power
}

/// Share of the power at frequencies from `low` to `high`, in waves per [`PART`] pixels.
fn share(power: &[f64], low: f64, high: f64) -> f64 {
    let all: f64 = power.iter().sum();
    let some = power.iter().enumerate().filter(|(i, _)| (low..=high).contains(&(*i as f64)));
    some.map(|(_, p)| p).sum::<f64>() / all
}

#[test]
fn flow_lies_between_its_widest_and_its_narrowest_cloud() {
    for (size_px, octaves) in [(16.0, 1), (64.0, 3), (32.0, 2)] {
        let settings = FlowSettings { size_px, octaves, ..FlowSettings::default() };
        let flow = turbulent_flow(SIZE, SIZE, &settings);
        let (mean, spread) = moments(&flow);
        assert!((mean - 0.5).abs() < 0.03 && (spread - 0.2).abs() < 0.03, "{mean} {spread}");
        let widest = PART as f64 / f64::from(size_px);
        let narrowest = widest * 2.0_f64.powi(octaves as i32 - 1);
        let power = spectrum(&flow);
        let inside = share(&power, 0.25 * widest, 2.0 * narrowest);
        assert!(inside > 0.97, "{size_px} px, {octaves} octaves: {inside}");
        let beyond = share(&power, 4.0 * narrowest, PART as f64);
        assert!(beyond < 0.002, "{size_px} px, {octaves} octaves: {beyond}");
    }
}

#[test]
fn grains_are_no_finer_than_their_finest() {
    for (finest_px, scales) in [(0.5, 4), (1.0, 1), (2.0, 2)] {
        let settings = DispersionSettings { finest_px, scales, ..DispersionSettings::default() };
        let grains = dispersion(SIZE, SIZE, &settings);
        let (mean, spread) = moments(&grains);
        assert!((mean - 0.5).abs() < 0.01 && (spread - 0.2).abs() < 0.01, "{mean} {spread}");
        // At this frequency the finest blur leaves exp(-4) of the power, and at twice of it
        // exp(-16).
        let cut = PART as f64 / (std::f64::consts::PI * f64::from(finest_px));
        if cut < 100.0 {
            let beyond = share(&spectrum(&grains), 2.0 * cut, PART as f64);
            assert!(beyond < 1e-3, "{finest_px} px: {beyond}");
            let before = share(&spectrum(&grains), 0.0, cut);
            assert!(before > 0.9, "{finest_px} px: {before}");
        }
    }
}

#[test]
fn textures_follow_their_seed_alone() {
    let [flow, again, other] = [3, 3, 4]
        .map(|seed| turbulent_flow(60, 50, &FlowSettings { seed, ..FlowSettings::default() }));
    assert_eq!(flow, again);
    assert_ne!(flow, other);
    let [grains, again, other] = [3, 3, 4].map(|seed| {
        dispersion(60, 50, &DispersionSettings { seed, ..DispersionSettings::default() })
    });
    assert_eq!(grains, again);
    assert_ne!(grains, other);
    // A larger picture has the same values where the two overlap.
    let large = turbulent_flow(90, 70, &FlowSettings { seed: 3, ..FlowSettings::default() });
    assert_eq!(large.row(20, 0, 60), flow.row(20, 0, 60));
}

#[test]
fn rough_paper_is_deeper_and_wider_than_cold_pressed_and_that_than_hot_pressed() {
    let papers =
        [PaperFinish::Rough, PaperFinish::ColdPressed, PaperFinish::HotPressed].map(|kind| {
            let settings = PaperSettings { kind, grain_px: 8.0, ..PaperSettings::default() };
            PaperTexture::new(SIZE, SIZE, &settings).unwrap()
        });
    let spreads = papers.each_ref().map(|paper| moments(&paper.heights));
    for ((mean, spread), wanted) in spreads.iter().zip([0.18 * 0.13 / 0.08, 0.18, 0.045]) {
        // Clipping to 0..1 reduces the spread a little.
        assert!((mean - 0.5).abs() < 0.02 && (spread - wanted).abs() < 0.03, "{mean} {spread}");
    }
    let long = papers.each_ref().map(|paper| share(&spectrum(&paper.heights), 0.0, 20.0));
    assert!(long[0] > long[1] && long[1] > long[2], "{long:?}");
    for paper in &papers {
        for part in [0.1, 0.3, 0.85] {
            let height = paper.height_above(part);
            let below = paper.heights.values().iter().filter(|h| **h < height).count();
            let found = below as f32 / (SIZE * SIZE) as f32;
            assert!((found - part).abs() < 2e-3, "{part}: {found}");
        }
        // Gradients times `per_slope(1.7)` have an RMS length of 1.7.
        let per_slope = paper.per_slope(1.7);
        let mut squares = 0.0;
        for y in 0..SIZE {
            for x in 0..SIZE {
                let at = |x: usize, y: usize| paper.heights[(x.min(SIZE - 1), y.min(SIZE - 1))];
                let across = at(x + 1, y) - at(x.saturating_sub(1), y);
                let down = at(x, y + 1) - at(x, y.saturating_sub(1));
                squares += f64::from(per_slope * per_slope * (across * across + down * down));
            }
        }
        let length = (squares / (SIZE * SIZE) as f64).sqrt();
        assert!((length - 1.7).abs() < 1e-3, "{length}");
    }
}

#[test]
fn a_scan_goes_on_mirrored_and_a_missing_one_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("paper.png");
    let pixels: Vec<u8> = (0..20 * 10).map(|i| (i * 37 % 251) as u8).collect();
    image::save_buffer(&path, &pixels, 20, 10, image::ColorType::L8).unwrap();
    let scan = Some(path.display().to_string());
    let settings = PaperSettings { scan, ..PaperSettings::default() };
    let paper = PaperTexture::new(64, 48, &settings).unwrap();
    let heights = &paper.heights;
    let (mean, spread) = moments(heights);
    assert!((mean - 0.5).abs() < 0.01 && (spread - 0.18).abs() < 0.01, "{mean} {spread}");
    for (x, y) in [(0, 0), (7, 3), (19, 9)] {
        let own = heights[(x, y)];
        for other in [(39 - x, y), (40 + x, y), (x, 19 - y), (x, 20 + y)] {
            assert_eq!(heights[other].to_bits(), own.to_bits(), "{x}, {y} and {other:?}");
        }
    }
    // Lighter pixels of the scan are higher.
    let order = [5, 90, 130].map(|i| (pixels[i], heights[(i % 20, i / 20)]));
    for pair in [[order[0], order[1]], [order[1], order[2]], [order[0], order[2]]] {
        assert_eq!(pair[0].0 < pair[1].0, pair[0].1 < pair[1].1, "{pair:?}");
    }
    let settings = PaperSettings { scan: Some("no/such.png".into()), ..PaperSettings::default() };
    let error = PaperTexture::new(8, 8, &settings).unwrap_err();
    assert!(matches!(error, PaperTextureError::Scan(_)));
    assert!(
        error.to_string().contains("no/such.png")
            && error.hint().unwrap().to_string().contains("paper.scan")
    );
}
