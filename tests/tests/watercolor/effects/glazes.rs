//! Glazes of calibrated pigments over paper of known reflectance.

use calibrate::PigmentId;
use documents::hint::Explain;
use graphics::compute::Compute;
use graphics::field::Field;
use paint::document::{Document, Lighting, Slots};
use paint::light::Light;
use paint::scene::{picture, scene};
use spectra::color::{Lab, delta_e_ciede2000};
use watercolor::{
    Controls, FrameTextures, GlazeError, Glazes, PaperTexture, Settings, Textures, Wash, paint,
};

use super::any_picture;

/// Tolerance in linear RGB for thin glazes rounded to whole quanta.
const NEAR: f32 = 2e-3;

/// Reflectance of a slightly warm white paper at `count` wavelengths.
fn paper(count: usize) -> Vec<f64> {
    (0..count).map(|i| 0.86 + 0.05 * i as f64 / count as f64).collect()
}

struct Made {
    glazes: Glazes,
    light: Light,
    sheet: PaperTexture,
}

/// Glazes of six oils, computed once for all tests.
fn made() -> &'static Made {
    static MADE: std::sync::OnceLock<Made> = std::sync::OnceLock::new();
    MADE.get_or_init(|| {
        let library = suite::oils::library();
        let light = Light::named(&library, "D65", "1931-2").unwrap();
        let slots: Slots = std::array::from_fn(|i| (i < 6).then_some(PigmentId(3 * i)));
        let paper = paper(library.grid.count());
        let glazes = Glazes::new(&library, &slots, paper, &light).unwrap();
        let sheet = PaperTexture::new(40, 30, &Settings::default().paper).unwrap();
        Made { glazes, light, sheet }
    })
}

/// Default light without relief.
fn level() -> Lighting {
    Lighting { relief: 0.0, ..Lighting::default() }
}

fn seen(document: &Document, light: &Light) -> Field<[f32; 4]> {
    picture(document, &scene(document, light))
}

#[test]
fn a_density_of_1_is_the_recipe_and_no_coverage_is_the_paper() {
    let Made { glazes, light, sheet } = made();
    let mut color = any_picture(40, 30, 51);
    color.values_mut().iter_mut().for_each(|c| c[3] = c[3].ceil());
    let covered: Vec<f32> = color.values().iter().map(|c| c[3]).collect();
    let thickness = Field::from_values(40, 30, covered);
    let document = glazes.document("made", &color, &thickness, sheet, level());
    let found = seen(&document, light);
    let bare = glazes.film().rgb(&[0.0; 8]);
    let mut bares = 0;
    for (found, color) in found.values().iter().zip(color.values()) {
        let wanted = match color[3] > 0.0 {
            true => glazes.film().rgb(&glazes.heights_mm(*color)),
            false => bare,
        };
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found - wanted).abs() < NEAR, "{color:?}: {found} {wanted}");
        }
        bares += usize::from(color[3] == 0.0);
    }
    assert!(bares > 100, "{bares} bare pixels");
    assert!(document.ground.height.values().iter().any(|height| *height > 0));
}

#[test]
fn a_density_of_2_is_two_glazes() {
    let Made { glazes, light, sheet } = made();
    let color = any_picture(40, 30, 52);
    let of = |times| glazes.document("made", &color, &Field::filled(40, 30, times), sheet, level());
    let twice = seen(&of(2.0), light);
    let mut glazed = of(1.0);
    let once = seen(&glazed, light);
    glazed.dry.push(glazed.dry[0].clone());
    let glazed = seen(&glazed, light);
    let mut darker = 0;
    for ((twice, glazed), once) in twice.values().iter().zip(glazed.values()).zip(once.values()) {
        for i in 0..3 {
            let off = (twice[i] - glazed[i]).abs();
            assert!(off < NEAR, "{twice:?} {glazed:?}: {off}");
        }
        darker += usize::from(twice[1] < once[1] - 1e-3);
    }
    assert!(darker > 800, "{darker} of 1200 pixels are darker under two glazes");
}

#[test]
fn a_painting_of_glazes_keeps_grain_edges_and_bare_paper_of_its_effects() {
    let Made { glazes, light, .. } = made();
    let mut settings = Settings::default().for_size(120, 90);
    settings.dry_brush.amount = 0.3;
    settings.dry_brush.patches = 0.0;
    settings.dry_brush.outline_px = 0.0;
    settings.paper.relief = 0.0;
    "#ffffff".clone_into(&mut settings.paper.color);
    let color = Field::from_values(
        120,
        90,
        (0..120 * 90)
            .map(|i: usize| match i % 120 < 60 {
                true => [0.75, 0.62, 0.4, 1.0],
                false => [0.6, 0.7, 0.8, 1.0],
            })
            .collect(),
    );
    let textures = Textures::of_photograph(&color, &settings).unwrap();
    let wash = Wash { color, controls: Controls::default() };
    let found = glazes.paint("made", &wash, &textures, &settings, level());
    assert_eq!(found.dry.len(), 1);
    let found = seen(&found, light);
    let mut cpu = Compute::cpu();
    let images = wash.upload(&mut cpu).unwrap();
    let uploaded = textures.upload(&mut cpu).unwrap();
    let plain = paint(&mut cpu, images, FrameTextures::from(&uploaded), &settings, None).unwrap();
    let plain = cpu.download(&plain).unwrap();
    // Green of both, encoded; their differences from the mean of each half must agree.
    let encoded = |linear: f32| f64::from(linear.max(0.0)).powf(1.0 / 2.2);
    for columns in [4..56, 64..116] {
        let places: Vec<(usize, usize)> =
            (4..86).flat_map(|y| columns.clone().map(move |x| (x, y))).collect();
        let of = |value: &dyn Fn((usize, usize)) -> f64| -> Vec<f64> {
            let values: Vec<f64> = places.iter().map(|&at| value(at)).collect();
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            values.into_iter().map(|value| value - mean).collect()
        };
        let glazed = of(&|at| encoded(found[at][1]));
        let painted = of(&|at| f64::from(plain[at][1]));
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let own = product(&glazed, &glazed);
        let other = product(&painted, &painted);
        let alike = product(&glazed, &painted) / (own * other).sqrt();
        let contrast = (own / other).sqrt();
        assert!(alike > 0.95, "the grain agrees by {alike} only");
        assert!((0.75..1.25).contains(&contrast), "the contrast is {contrast} times that");
    }
}

#[test]
fn a_palette_is_chosen_and_comes_near_to_colors_that_watercolor_has() {
    let library = suite::oils::library();
    let Made { light, .. } = made();
    let paper = paper(library.grid.count());
    let colors = [
        [0.95, 0.93, 0.85, 1.0],
        [0.85, 0.65, 0.35, 1.0],
        [0.5, 0.6, 0.75, 1.0],
        [0.55, 0.3, 0.35, 1.0],
        [0.75, 0.78, 0.45, 1.0],
    ];
    let color = Field::from_values(5, 1, colors.to_vec());
    let wash = Wash { color, controls: Controls::default() };
    let slots = Glazes::palette(&wash, &library, &paper, light).unwrap();
    let glazes = Glazes::new(&library, &slots, paper.clone(), light).unwrap();
    let film = glazes.film();
    let white = film.rgb(&[0.0; 8]);
    // Black is raised to the reflectance of the surface, the lowest that paint reaches.
    let black = library.saunderson.floor() as f32;
    for color in colors {
        let linear = spectra::color::Rgb([color[0], color[1], color[2]].map(f64::from)).linear();
        let wanted: [f32; 3] =
            std::array::from_fn(|i| black + (1.0 - black) * linear.0[i] as f32 * white[i]);
        let found = film.rgb(&glazes.heights_mm(color));
        let lab = |rgb: [f32; 3]| -> Lab { film.lab_from_rgb(rgb) };
        let off = delta_e_ciede2000(lab(wanted), lab(found));
        assert!(off < 4.0, "{color:?}: {off} CIEDE2000");
    }
    let none = Glazes::new(&library, &Slots::default(), paper, light).unwrap_err();
    assert!(
        matches!(none, GlazeError::Separation(_))
            && none.hint().unwrap().to_string().contains("pigments")
    );
}
