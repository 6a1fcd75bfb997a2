//! Shading of relief and gloss, and grounds: relief, reflectance and gloss of each kind, and
//! refusal of invalid descriptions.

use calibrate::evaluate::Viewing;
use documents::hint::Explain;
use paint::amount::QUANTA_PER_CELL;
use paint::document::Lighting;
use paint::ground::{self, GroundError, GroundSpec};
use paint::light::Light;
use paint::optics::{Gloss, Scene};
use paint::scene::{picture, scene};
use paint::shade::{MOST, SOFT, TopMaterial, Tops, reach, shade_row};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::color::{Adaptation, RgbSpace};

use crate::made_up::{CELL_MM, document, glazes_over_mixtures, lay, oils};
use TopMaterial::{Dry, Ground, Wet};

/// Width of the surfaces in cells. Their middle is at [`MIDDLE`].
const SIDE: usize = 65;
const MIDDLE: usize = 32;

/// Linear green of a grey cell in the middle of a surface. `cells` gives the height in cells at a
/// distance from the middle along x and y.
fn lit_in(scene: &Scene, cells: impl Fn(f64, f64) -> f64 + Sync, material: TopMaterial) -> f32 {
    let mut tops = Tops::level(SIDE, SIDE);
    tops.set_all(|x, y| {
        let [x, y] = [x, y].map(|at| at as f64 - MIDDLE as f64);
        (cells(x, y) * f64::from(1 << 21)) as i32
    });
    let mut out = [[0.0; 4]];
    shade_row(scene, (&tops, (MIDDLE, MIDDLE)), &[[0.5; 8]], &[material], &mut out);
    assert_eq!(out[0][3], 1.0, "alpha");
    out[0][1]
}

/// Linear green of a grey cell on a surface that rises by `slopes` along x and y, in cells per
/// cell.
fn lit(scene: &Scene, slopes: (f32, f32), material: TopMaterial) -> f32 {
    let [a, b] = [slopes.0, slopes.1].map(f64::from);
    lit_in(scene, |x, y| a * x + b * y, material)
}

fn studio(lighting: Lighting) -> Scene {
    let document = paint::document::Document { lighting, ..document(1, 1, &[]) };
    scene(&document, &Light::new(&document.library, &Viewing::default()).unwrap())
}

#[test]
fn a_level_surface_shows_what_was_measured() {
    let flat = studio(Lighting { relief: 0.0, ..Lighting::default() });
    let measured = lit(&flat, (0.0, 0.0), Wet);
    for elevation_deg in [5.0, 50.0, 90.0] {
        for ambient in [0.0, 0.5, 1.0] {
            let mut scene = studio(Lighting { elevation_deg, ambient, ..Lighting::default() });
            scene.lamp.ground = Gloss { strength: 3.0, exponent: 8.0 };
            for material in [Wet, Dry, Ground] {
                let found = lit(&scene, (0.0, 0.0), material);
                let off = (found - measured).abs();
                assert!(off < 1e-6, "{elevation_deg} {ambient} {material:?}");
            }
        }
    }
    // A picture of paint of even height on a level ground.
    let mut level = document(4, 4, &["Vermilion"]);
    for cell in (0..4).flat_map(|y| (0..4).map(move |x| (x, y))) {
        lay(&mut level.wet, cell, &[0.1]);
    }
    let light = Light::new(&level.library, &Viewing::default()).unwrap();
    let without = picture(&level, &scene(&level, &light));
    level.lighting = Lighting::default();
    let with = picture(&level, &scene(&level, &light));
    for (with, without) in with.values().iter().zip(without.values()) {
        for channel in 0..3 {
            assert!((with[channel] - without[channel]).abs() < 1e-6, "{with:?} {without:?}");
        }
    }
}

#[test]
fn slopes_towards_the_lamp_are_lighter_and_away_darker() {
    // The lamp is at the upper left, so a surface that rises to the right or downwards faces it.
    let scene = studio(Lighting::default());
    let level = lit(&scene, (0.0, 0.0), Ground);
    assert!(lit(&scene, (0.2, 0.0), Ground) > level * 1.02);
    assert!(lit(&scene, (0.0, 0.2), Ground) > level * 1.02);
    assert!(lit(&scene, (-0.2, 0.0), Ground) < level * 0.98);
    assert!(lit(&scene, (0.0, -0.2), Ground) < level * 0.98);
    // Half of the light is ambient and comes from the part of the sky that the slope sees. The
    // other half follows Lambert's law, relative to level paint.
    let [x, y, z] = scene.lamp.direction;
    for (a, b) in [(0.3f32, -0.1f32), (-0.2, 0.1), (-0.1, 0.3)] {
        let lambert = (z - a * x - b * y) / (1.0 + a * a + b * b).sqrt() / z;
        let open = 1.0 / (1.0 + (a * a + b * b) / 4.0);
        let light = 0.5 * open + 0.5 * lambert;
        let more = (light - 1.0).max(0.0);
        let factor = light.min(1.0) + more / (1.0 + more * (level / (1.0 - level) + 1.0 / MOST));
        let found = lit(&scene, (a, b), Ground) / level;
        assert!((found - factor).abs() < 1e-5, "{a} {b}: {found} {factor}");
    }
    // With ambient light only, you cannot see the direction of a slope.
    let soft = studio(Lighting { ambient: 1.0, ..Lighting::default() });
    let any = [(0.2, 0.1), (-0.2, -0.1), (-0.1, 0.2)].map(|slopes| lit(&soft, slopes, Wet));
    assert!(any.iter().all(|one| (one - level / 1.0125).abs() < 1e-5), "{any:?} {level}");
    // A slope that faces away from the lamp gets only ambient light.
    let steep = lit(&scene, (-1.0, -1.0), Ground) / level;
    assert!((steep - 0.5 / 1.5).abs() < 1e-5, "{steep}");
}

/// A scene with a lamp on the left, `elevation_deg` high.
fn from_the_left(elevation_deg: f64, ambient: f64) -> Scene {
    studio(Lighting { azimuth_deg: 270.0, elevation_deg, ambient, ..Lighting::default() })
}

#[test]
fn a_wall_casts_a_shadow_that_ends_softly() {
    let scene = from_the_left(20.0, 0.2);
    let level = lit(&scene, (0.0, 0.0), Ground);
    // A wall two cells high ends at these distances to the left of the middle, in cells. Its shadow
    // is 2 / tan 20 degrees = 5.5 cells long.
    let shades = [2.0, 3.0, 4.0, 6.0, 8.0, 12.0].map(|distance: f64| {
        lit_in(&scene, |x, _| if x <= -distance { 2.0 } else { 0.0 }, Ground) / level
    });
    assert!(shades.windows(2).all(|pair| pair[0] <= pair[1]), "{shades:?}");
    assert!(shades[0] < 0.35 && shades[1] < 0.6, "close behind the wall: {shades:?}");
    assert!(shades[5] > 0.99, "far behind the wall: {shades:?}");
    // At the distance of 3 cells the wall overtops the lamp by 2 / 3 - tan 20 degrees. It hides
    // slopes of 2 / 3 in at most 3 of 8 directions of the sky.
    let over = (2.0 / 3.0 - 20.0f32.to_radians().tan()) / SOFT;
    let free = 1.0 / (1.0 + over * over);
    let within = 0.8 * free + 0.2 / (1.0 + 0.5 * 4.0 / 9.0)..=0.8 * free + 0.2;
    assert!(within.contains(&shades[1]), "{shades:?} {within:?}");
    // In front of the wall there is light.
    let before = lit_in(&scene, |x, _| if x >= 3.0 { 2.0 } else { 0.0 }, Ground) / level;
    assert!(before > 0.95, "{before}");
}

#[test]
fn the_ground_of_a_furrow_is_darker_than_the_ridge_beside_it() {
    let soft = studio(Lighting { ambient: 1.0, ..Lighting::default() });
    let level = lit(&soft, (0.0, 0.0), Ground);
    for along in [0.0, 0.5, 1.0] {
        // Furrows 6 cells apart and half a cell deep. `up` is 1 at a ridge.
        let [ridge, ground] = [1.0, -1.0].map(|up| {
            let lit = lit_in(
                &soft,
                |x, y| {
                    let across = x * (1.0 - along) + y * along;
                    up * 0.25 * (across * std::f64::consts::PI / 3.0).cos()
                },
                Ground,
            );
            lit / level
        });
        assert!(ridge > 0.999 && ground < 0.996, "along {along}: {ridge} {ground}");
    }
}

#[test]
fn no_relief_makes_paint_lighter_than_white() {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let heights: Vec<f64> = (0..SIDE * SIDE).map(|_| random.random_range(0.0..2.0)).collect();
    for elevation_deg in [1.0, 20.0, 50.0] {
        for ambient in [0.0, 0.5] {
            let lighting = Lighting { elevation_deg, ambient, relief: 10.0, ..Lighting::default() };
            let mut scene = studio(lighting);
            scene.lamp.wet = Gloss { strength: 100.0, exponent: 8.0 };
            let mut lightest = 0.0f32;
            for shift in 0..200 {
                let lit = lit_in(
                    &scene,
                    |x, y| {
                        let column = (x + 100.0 + f64::from(shift)) as usize % SIDE;
                        heights[(y as usize + MIDDLE) % SIDE * SIDE + column]
                    },
                    Wet,
                );
                lightest = lightest.max(lit);
            }
            let level = lit(&scene, (0.0, 0.0), Wet);
            assert!(lightest > 1.1 * level && lightest < 1.0, "{level} {lightest}");
        }
    }
}

#[test]
fn a_height_matters_as_far_as_it_says() {
    for (cell_mm, cells) in [(0.05, 16), (0.1, 8), (0.4, 2), (3.0, 1)] {
        assert_eq!(reach(cell_mm), cells);
        let mut scene = from_the_left(1.0, 0.5);
        scene.cell_mm = cell_mm as f32;
        let level = lit(&scene, (0.0, 0.0), Wet);
        let far = cells as f64;
        let [out_of_reach, within] = [far + 1.0, far].map(|distance| {
            lit_in(&scene, |x, y| if x.abs().max(y.abs()) >= distance { 3.0 } else { 0.0 }, Wet)
        });
        assert_eq!(out_of_reach, level, "{cell_mm}");
        assert!(within < level, "{cell_mm}");
    }
}

#[test]
fn gloss_is_that_of_what_lies_on_top_and_brightest_at_the_mirror_angle() {
    let mut scene = studio(Lighting { ambient: 0.0, ..Lighting::default() });
    scene.lamp.wet = Gloss { strength: 0.5, exponent: 60.0 };
    scene.lamp.dry = Gloss { strength: 0.25, exponent: 60.0 };
    scene.lamp.ground = Gloss { strength: 0.0, exponent: 60.0 };
    let [x, y, z] = scene.lamp.direction;
    // Slopes -h_x / h_z and -h_y / h_z, where the normal is the halfway vector h of lamp and
    // viewer.
    let mirror = (-x / (z + 1.0), -y / (z + 1.0));
    let [wet, dry, ground] = [Wet, Dry, Ground].map(|material| lit(&scene, mirror, material));
    let veil = (1.0 - ((1.0 + z) / (2.0 + 2.0 * z).sqrt()).powf(60.0)) as f64;
    // Mirrored light replaces the same amount of light from within.
    for (found, strength) in [(wet, 0.5), (dry, 0.25)] {
        let mirrored = strength * veil / (1.0 + strength * veil);
        let wanted = f64::from(ground) + mirrored * (1.0 - f64::from(ground));
        assert!((f64::from(found) - wanted).abs() < 1e-4, "{found} {ground} {mirrored}");
    }
    for off in [0.8, 1.2] {
        let slopes = (mirror.0 * off, mirror.1 * off);
        assert!(lit(&scene, slopes, Wet) - lit(&scene, slopes, Ground) < wet - ground, "{off}");
    }
    let away = (-mirror.0, -mirror.1);
    assert_eq!(lit(&scene, away, Wet), lit(&scene, away, Ground), "no gloss away from the lamp");
}

#[test]
fn a_row_may_be_cut_anywhere() {
    let mut document = glazes_over_mixtures();
    document.lighting = Lighting::default();
    let linen = GroundSpec::default().build(48, 48, CELL_MM, &document.library).unwrap();
    document.ground.height = linen.height;
    let light = Light::new(&document.library, &Viewing::default()).unwrap();
    let scene = scene(&document, &light);
    let whole = picture(&document, &scene);
    let y = 20;
    let width = 48;
    let mut tops = Tops::level(width, 48);
    tops.set_all(|x, y| {
        let index = y * width + x;
        let paint = document.dry[0].paint.cell(index).volume() + document.wet.cell(index).volume();
        document.ground.height.values()[index] + paint as i32
    });
    for first in [0, 1, 13, 40] {
        for count in [1, 7, 8] {
            let mut internal = vec![scene.ground; count];
            for (layer, coat) in
                [(&document.dry[0].paint, &scene.dry[0]), (&document.wet, &scene.wet)]
            {
                paint::composite::composite_layer_row(coat, layer, (first, y), &mut internal);
            }
            let materials: Vec<TopMaterial> = (first..first + count)
                .map(|x| {
                    match (
                        document.wet.cell(y * width + x).volume(),
                        document.dry[0].paint.cell(y * width + x).volume(),
                    ) {
                        (0, 0) => Ground,
                        (0, _) => Dry,
                        _ => Wet,
                    }
                })
                .collect();
            let mut out = vec![[0.0; 4]; count];
            shade_row(&scene, (&tops, (first, y)), &internal, &materials, &mut out);
            assert_eq!(out, whole.row(y, first, count), "{first} {count}");
        }
    }
}

fn spec(json: &str) -> GroundSpec {
    serde_json::from_str(json).unwrap_or_else(|error| panic!("{json}: {error}"))
}

fn made(json: &str, width: usize, height: usize) -> ground::Ground {
    spec(json).build(width, height, CELL_MM, &oils()).unwrap()
}

fn sorted_mm(ground: &ground::Ground) -> Vec<f64> {
    let mm = ground.height.values().iter();
    let mm = mm.map(|&quanta| f64::from(quanta) / f64::from(QUANTA_PER_CELL) * CELL_MM);
    let mut heights: Vec<f64> = mm.collect();
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
    // Reflectance falls from red over green to blue. It is neither very light nor black.
    let [blue, green, red] = [4..9, 12..18, 22..28].map(|range| {
        let values = &wood.reflectance[range];
        values.iter().sum::<f64>() / values.len() as f64
    });
    assert!(blue < green && green < red && red < 0.4 && blue > 0.02, "{blue} {green} {red}");
    // Along the fibres, heights change less from cell to cell than across them.
    let [along, across] = [(1, 0), (0, 1)].map(|(right, down)| -> f64 {
        let cells = (0..390 * 390).map(|i| (i % 390, i / 390));
        let changes = cells.map(|(x, y)| {
            let [from, to] = [(x, y), (x + right, y + down)].map(|at| f64::from(wood.height[at]));
            (to - from).abs()
        });
        changes.sum()
    });
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
        // The sum over all rows cancels the weave. Each thread along y leaves one maximum.
        let profile: Vec<f64> =
            (0..2000).map(|x| (0..400).map(|y| f64::from(cloth[(x, y)])).sum()).collect();
        let mean = profile.iter().sum::<f64>() / 2000.0;
        let hills = profile.windows(2).filter(|w| w[0] < mean && w[1] >= mean).count();
        let found = hills as f64 / 10.0;
        assert!((found / count - 1.0).abs() < 0.12, "{count}: {found}");
    }
}

#[test]
fn threads_of_uneven_linen_differ_in_height_and_old_linen_stays() {
    /// Deviation of the crests of all threads along y, as a share of their mean.
    fn crests(settings: &str) -> f64 {
        let json = format!(r#"{{"kind":"linen","seed":5,"threads_per_cm":10{settings}}}"#);
        let cloth = spec(&json).build(1000, 400, 0.05, &oils()).unwrap().height;
        let crests: Vec<f64> = (0..50)
            .map(|thread: usize| {
                let columns = 20 * thread..20 * thread + 20;
                let cells = columns.flat_map(|x| (0..400).map(move |y| (x, y)));
                f64::from(cells.map(|place| cloth[place]).max().unwrap())
            })
            .collect();
        let mean = crests.iter().sum::<f64>() / 50.0;
        let squares = crests.iter().map(|crest| (crest - mean).powi(2)).sum::<f64>();
        (squares / 50.0).sqrt() / mean
    }
    let even = crests("");
    assert_eq!(even, crests(r#","unevenness":0"#));
    let uneven = crests(r#","unevenness":0.5"#);
    assert!(uneven > 2.0 * even && uneven < 0.4, "{even}, then {uneven}");
    let refused = spec(r#"{"kind":"linen","unevenness":1.5}"#).build(9, 9, 0.1, &oils());
    assert!(refused.unwrap_err().to_string().contains("unevenness"));
}

#[test]
fn a_picture_gives_its_relief_at_eight_and_sixteen_bits() {
    let folder = tempfile::tempdir().unwrap();
    let eight = image::GrayImage::from_fn(4, 2, |x, _| image::Luma([(x * 85) as u8]));
    type Gray16 = image::ImageBuffer<image::Luma<u16>, Vec<u16>>;
    let sixteen = Gray16::from_fn(4, 2, |x, _| image::Luma([(x * 21845) as u16]));
    let pictures: [(&str, image::DynamicImage); 2] =
        [("8.png", eight.into()), ("16.png", sixteen.into())];
    let [eight, sixteen] = pictures.map(|(name, picture)| {
        let path = folder.path().join(name);
        picture.save(&path).unwrap();
        let path = path.display().to_string();
        let json = serde_json::json!({"kind": "image", "path": path, "depth_mm": 0.3});
        made(&json.to_string(), 40, 10)
    });
    assert_eq!(eight.height, sixteen.height);
    let heights = sorted_mm(&eight);
    assert!(heights[0].abs() < 1e-9 && (heights[399] - 0.3).abs() < 1e-6, "{heights:?}");
    // We interpolate linearly between the centres of pixels, a quarter of the width from the left.
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
    fn primed(reflectance: &str) -> Vec<f64> {
        let json = format!(r#"{{"kind":"panel","reflectance":{reflectance}}}"#);
        made(&json, 2, 2).reflectance
    }
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
    for (json, reason) in [
        (r#"{"kind":"silk"}"#, "silk"),
        (r#"{"kind":"linen","seeds":1}"#, "seeds"),
        (r#"{"kind":"paper","threads_per_cm":9}"#, "threads_per_cm"),
        (r#"{"kind":"image"}"#, "path"),
        (r#"{"kind":"panel","reflectance":"white"}"#, "a number 0 to 1"),
        (r#"{"kind":"panel","gloss":{"strength":1}}"#, "exponent"),
        (r#"{"seed":1}"#, "kind"),
    ] {
        let error = serde_json::from_str::<GroundSpec>(json).unwrap_err().to_string();
        assert!(error.contains(reason), "{json}: {error}");
    }
    for (json, reason) in [
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
        assert!(error.to_string().contains(reason), "{json}: {error}");
    }
    let deep = spec(r#"{"kind":"linen","relief_mm":2}"#).build(64, 64, 0.001, &oils());
    assert!(matches!(deep, Err(GroundError::TooHigh { .. })), "{deep:?}");
}
