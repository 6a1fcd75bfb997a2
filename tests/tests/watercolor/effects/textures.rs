//! Textures of flow, dispersion and paper: mean, spread, spectrum and seed.

use documents::hint::Explain;
use graphics::field::Field;
use paint::ground::PaperFinish;
use watercolor::{
    DispersionSettings, FlowSettings, PaperSettings, PaperTexture, PaperTextureError, dispersion,
    turbulent_flow,
};

const SIZE: usize = 512;

/// Mean and standard deviation.
fn moments(field: &Field<f32>) -> (f64, f64) {
    let count = field.values().len() as f64;
    let mean = field.values().iter().map(|&v| f64::from(v)).sum::<f64>() / count;
    let squares = field.values().iter().map(|&v| (f64::from(v) - mean).powi(2)).sum::<f64>();
    (mean, (squares / count).sqrt())
}

/// Side of the square whose spectrum is computed, in pixels.
const PART: usize = 256;

/// Power of the upper left square by radial frequency, in waves per [`PART`] pixels. A Hann window
/// suppresses leakage from its borders.
fn spectrum(field: &Field<f32>) -> Vec<f64> {
    let turn = std::f64::consts::TAU / PART as f64;
    let window = |i: usize| 0.5 - 0.5 * (turn * i as f64).cos();
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
    let row = |y: usize| -> Vec<[f64; 2]> {
        let value = |x: usize| (f64::from(field[(x, y)]) - 0.5) * window(x) * window(y);
        transformed(&(0..PART).map(|x| [value(x), 0.0]).collect::<Vec<_>>())
    };
    let rows: Vec<_> = (0..PART).map(row).collect();
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
        // At this frequency the finest blur keeps exp(-4) of the power, at twice of it exp(-16).
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
    let flow = |seed| turbulent_flow(60, 50, &FlowSettings { seed, ..FlowSettings::default() });
    let grains = |width, seed| {
        dispersion(width, 50, &DispersionSettings { seed, ..DispersionSettings::default() })
    };
    assert_eq!(flow(3), flow(3));
    assert_ne!(flow(3), flow(4));
    assert_eq!(grains(60, 3), grains(60, 3));
    assert_ne!(grains(60, 3), grains(60, 4));
    // A larger picture has the same values where the two overlap.
    let large = turbulent_flow(90, 70, &FlowSettings { seed: 3, ..FlowSettings::default() });
    assert_eq!(large.row(20, 0, 60), flow(3).row(20, 0, 60));
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
