//! Grounds: relief, reflectance and gloss of each kind, and refusal of invalid descriptions.

use calibrate::evaluate::Viewing;
use documents::hint::Explain;
use paint::amount::QUANTA_PER_CELL;
use paint::ground::{Ground, GroundError, GroundSpec};
use spectra::color::{Adaptation, RgbSpace};

use crate::made_up::{CELL_MM, oils};

fn spec(json: &str) -> GroundSpec {
    serde_json::from_str(json).unwrap_or_else(|error| panic!("{json}: {error}"))
}

fn made(json: &str, width: usize, height: usize) -> Ground {
    spec(json).build(width, height, CELL_MM, &oils()).unwrap()
}

/// Heights of all cells in mm, ascending.
fn sorted_mm(ground: &Ground) -> Vec<f64> {
    let mm = |&quanta: &i32| f64::from(quanta) / f64::from(QUANTA_PER_CELL) * CELL_MM;
    let mut heights: Vec<f64> = ground.height.values().iter().map(mm).collect();
    heights.sort_by(f64::total_cmp);
    heights
}

#[test]
fn every_kind_is_as_deep_as_it_says_and_the_same_again() {
    for (kind, relief) in [("linen", 0.12), ("paper", 0.08), ("panel", 0.012), ("wood", 0.1)] {
        let described = |seed: u64, relief: f64| {
            made(&format!(r#"{{"kind":"{kind}","seed":{seed},"relief_mm":{relief}}}"#), 300, 200)
        };
        let ground = described(1, relief);
        assert_eq!(ground, described(1, relief), "{kind}");
        assert_eq!(ground.name, format!("{kind}, seed 1"));
        assert_eq!(ground, made(&format!(r#"{{"kind":"{kind}"}}"#), 300, 200), "{kind}: defaults");
        assert_ne!(ground.height, described(2, relief).height, "{kind}");
        let heights = sorted_mm(&ground);
        let [low, high] = [0.02, 0.98].map(|share| heights[(share * 59_999.0) as usize]);
        assert!(heights[0] >= 0.0, "{kind}: {}", heights[0]);
        let span = (high - low) / relief;
        assert!((0.5..1.1).contains(&span), "{kind}: {span} of its relief");
        assert!(heights[59_999] < 1.6 * relief, "{kind}: {}", heights[59_999]);
        let twice = sorted_mm(&described(1, 2.0 * relief));
        assert!((twice[30_000] - 2.0 * heights[30_000]).abs() < 1e-6, "{kind}");
    }
}

#[test]
fn wood_is_brown_and_shines_and_its_grain_is_long() {
    let wood = made(r#"{"kind":"wood"}"#, 400, 400);
    let white = made(r#"{"kind":"panel"}"#, 2, 2);
    assert!(wood.gloss.strength > 0.0 && white.gloss.strength == 0.0, "{:?}", wood.gloss);
    // Reflectance falls from red over green to blue, and is neither very light nor black.
    let part = |from: usize, to: usize| {
        let values = &wood.reflectance[from..to];
        values.iter().sum::<f64>() / values.len() as f64
    };
    let blue = part(4, 9);
    let green = part(12, 18);
    let red = part(22, 28);
    assert!(blue < green && green < red && red < 0.4 && blue > 0.02, "{blue} {green} {red}");
    // From cell to cell heights change less along the fibres than across them.
    let change = |right: usize, down: usize| -> f64 {
        let height = |x: usize, y: usize| f64::from(wood.height[(x, y)]);
        let cells = (0..390 * 390).map(|i| (i % 390, i / 390));
        cells.map(|(x, y)| (height(x + right, y + down) - height(x, y)).abs()).sum()
    };
    let along = change(1, 0);
    let across = change(0, 1);
    assert!(along * 4.0 < across, "{along} along, {across} across");
    let own =
        made(r#"{"kind":"wood","reflectance":0.5,"gloss":{"strength":0,"exponent":9}}"#, 2, 2);
    assert!(own.gloss.strength == 0.0 && own.reflectance[3] == 0.5, "{own:?}");
}

#[test]
fn a_larger_canvas_of_paper_goes_on_where_the_smaller_ends() {
    let [small, large] =
        [40, 90].map(|size| made(r#"{"kind":"paper","seed":7}"#, size, size).height);
    for y in 0..40 {
        assert_eq!(small.row(y, 0, 40), large.row(y, 0, 40), "row {y}");
    }
}

#[test]
fn linen_has_as_many_threads_as_it_says() {
    for count in [8.0, 14.0, 22.0] {
        let json = format!(r#"{{"kind":"linen","seed":5,"threads_per_cm":{count}}}"#);
        let cloth = spec(&json).build(2000, 400, 0.05, &oils()).unwrap().height;
        // The sum over all rows cancels the weave and keeps one maximum for each thread along y.
        let column = |x: usize| -> f64 { (0..400).map(|y| f64::from(cloth[(x, y)])).sum() };
        let profile: Vec<f64> = (0..2000).map(column).collect();
        let mean = profile.iter().sum::<f64>() / 2000.0;
        let hills = profile.windows(2).filter(|w| w[0] < mean && w[1] >= mean).count();
        let found = hills as f64 / 10.0;
        assert!((found / count - 1.0).abs() < 0.12, "{count}: {found}");
    }
}

#[test]
fn a_picture_gives_its_relief_at_eight_and_sixteen_bits() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, picture: image::DynamicImage| {
        let path = folder.path().join(name);
        picture.save(&path).unwrap();
        path.display().to_string()
    };
    let eight = image::GrayImage::from_fn(4, 2, |x, _| image::Luma([(x * 85) as u8]));
    type Gray16 = image::ImageBuffer<image::Luma<u16>, Vec<u16>>;
    let sixteen = Gray16::from_fn(4, 2, |x, _| image::Luma([(x * 21845) as u16]));
    let [eight, sixteen] =
        [write("8.png", eight.into()), write("16.png", sixteen.into())].map(|path| {
            let json = serde_json::json!({"kind": "image", "path": path, "depth_mm": 0.3});
            made(&json.to_string(), 40, 10)
        });
    assert_eq!(eight.height, sixteen.height);
    let heights = sorted_mm(&eight);
    assert!(heights[0].abs() < 1e-9 && (heights[399] - 0.3).abs() < 1e-6, "{heights:?}");
    // Linear interpolation between the centres of pixels, a quarter of the width from the left.
    let mm = f64::from(eight.height[(10, 5)]) / f64::from(QUANTA_PER_CELL) * CELL_MM;
    assert!((mm - 0.055).abs() < 1e-6, "{mm}");

    let broken = folder.path().join("broken.png");
    std::fs::write(&broken, b"no picture").unwrap();
    for path in [folder.path().join("none.png"), broken] {
        let path = path.display().to_string();
        let json = serde_json::json!({"kind": "image", "path": path});
        let error = spec(&json.to_string()).build(4, 4, CELL_MM, &oils()).unwrap_err();
        assert!(error.to_string().starts_with(&path), "{error}");
        assert!(error.hint().is_some());
    }
}

#[test]
fn a_priming_is_the_librarys_white_a_number_a_color_or_a_spectrum() {
    let library = oils();
    let primed = |reflectance: &str| {
        let json = format!(r#"{{"kind":"panel","reflectance":{reflectance}}}"#);
        made(&json, 2, 2).reflectance
    };
    let white = made(r#"{"kind":"panel"}"#, 2, 2).reflectance;
    let zinc = library.mix([(library.find("Zinc White").unwrap(), 1.0)]).unwrap();
    assert_eq!(white, zinc.hiding(library.saunderson));
    assert_eq!(primed("0.5"), vec![0.5; 31]);

    let weights = Viewing::default().weights(library.grid).unwrap();
    let xyz = weights.xyz(&primed(r##"{"rgb":"#f4f1e8"}"##));
    let rgb = RgbSpace::Srgb.encoded_from_xyz(xyz, weights.white(), Adaptation::Bradford);
    assert_eq!(rgb.to_hex(), "#f4f1e8");

    let spectrum = r#"{"spectrum":{"grid":{"start_nm":300,"step_nm":100,"count":6},"values":[0.1,0.2,0.4,0.6,0.8,0.9]}}"#;
    let measured = primed(spectrum);
    assert!((measured[0] - 0.2).abs() < 1e-9 && (measured[30] - 0.8).abs() < 1e-9);
}

#[test]
fn descriptions_come_back_and_faulty_ones_are_refused() {
    let whole = r##"{"kind":"linen","seed":3,"threads_per_cm":9.0,"relief_mm":0.2,"reflectance":{"rgb":"#f4f1e8"},"gloss":{"strength":0.1,"exponent":12.0}}"##;
    assert_eq!(serde_json::to_string(&spec(whole)).unwrap(), whole);
    for (json, told) in [
        (r#"{"kind":"silk"}"#, "silk"),
        (r#"{"kind":"linen","seeds":1}"#, "seeds"),
        (r#"{"kind":"paper","threads_per_cm":9}"#, "threads_per_cm"),
        (r#"{"kind":"image"}"#, "path"),
        (r#"{"kind":"panel","reflectance":"white"}"#, "a number 0 to 1"),
        (r#"{"kind":"panel","gloss":{"strength":1}}"#, "exponent"),
        (r#"{"seed":1}"#, "kind"),
    ] {
        let error = serde_json::from_str::<GroundSpec>(json).unwrap_err().to_string();
        assert!(error.contains(told), "{json}: {error}");
    }
    for (json, told) in [
        (r#"{"kind":"linen","threads_per_cm":0}"#, "threads_per_cm of a ground is 2 to 60"),
        (r#"{"kind":"paper","relief_mm":-1}"#, "relief_mm of a ground is 0 to 2 mm"),
        (r#"{"kind":"panel","reflectance":1.5}"#, "found `1.5`"),
        (r##"{"kind":"panel","reflectance":{"rgb":"#12345"}}"##, "`#12345`"),
        (
            r##"{"kind":"panel","reflectance":{"spectrum":{"grid":{"start_nm":900,"step_nm":10,"count":6},"values":[0,0,0,0,0,0]}}}"##,
            "from 900 to 950 nm",
        ),
        (
            r##"{"kind":"panel","reflectance":{"spectrum":{"grid":{"start_nm":400,"step_nm":10,"count":2},"values":[0.1,-2]}}}"##,
            "410",
        ),
    ] {
        let error = spec(json).build(4, 4, CELL_MM, &oils()).unwrap_err();
        assert!(error.to_string().contains(told), "{json}: {error}");
    }
    let deep = spec(r#"{"kind":"linen","relief_mm":2}"#).build(64, 64, 0.001, &oils());
    assert!(matches!(deep, Err(GroundError::TooHigh { .. })), "{deep:?}");
}
