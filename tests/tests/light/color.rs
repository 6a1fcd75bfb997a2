//! Colour of paint: eight wavelengths against the full spectrum, and mixtures of pigments against
//! mixtures of lights.

use calibrate::evaluate::{Summary, Viewing, percentile};
use calibrate::{Curves, PigmentId};
use paint::document::Document;
use paint::light::{Light, Mixer};
use paint::scene::{SpectralDocument, picture, scene};
use spectra::color::{Adaptation, Lab, Lch, Rgb, RgbSpace, Xyz, delta_e_ciede2000};

use crate::made_up::{document, glazes_over_mixtures, lay, light, slots, viewing};

/// CIELAB of every cell of the flat picture of `document`, relative to the white of sRGB.
fn labs(document: &Document, light: &Light) -> Vec<Lab> {
    let picture = picture(document, &scene(document, light));
    picture.values().iter().map(|c| lab([c[0], c[1], c[2]])).collect()
}

fn lab(rgb: [f32; 3]) -> Lab {
    let xyz = RgbSpace::Srgb.xyz_from_linear().apply(rgb.map(f64::from));
    Lab::from_xyz(xyz.into(), RgbSpace::Srgb.white())
}

/// XYZ of every cell, integrated over the full spectrum.
fn exact_xyz(document: &Document, viewing: &Viewing) -> Vec<Xyz> {
    let spectral = SpectralDocument::full(document);
    let weights = viewing.weights(document.library.grid).unwrap();
    let width = document.wet.width();
    let height = document.wet.height();
    let cells = (0..width * height).map(|i| (i % width, i / width));
    cells.map(|(x, y)| weights.xyz(&spectral.measured_reflectance(x, y))).collect()
}

/// CIEDE2000 of eight wavelengths against the full spectrum, by cell, both adapted to the white of
/// sRGB.
fn errors(document: &Document, name: &str) -> Vec<f64> {
    let light = light(&document.library, name);
    let white = light.quadrature.rule.white;
    let exact = exact_xyz(document, &viewing(name));
    let pairs = labs(document, &light).into_iter().zip(&exact);
    pairs
        .map(|(found, xyz)| {
            let rgb = RgbSpace::Srgb.linear_from_xyz(*xyz, white, Adaptation::Bradford);
            delta_e_ciede2000(found, lab(rgb.0.map(|v| v as f32)))
        })
        .collect()
}

#[test]
fn eight_wavelengths_keep_the_color_of_a_painting() {
    let document = glazes_over_mixtures();
    for light in ["D65", "A", "D50", "LED-B3"] {
        let errors = errors(&document, light);
        let summary = Summary::of(&errors);
        println!("{light}: {summary:?}, 99 % {}", percentile(&errors, 99.0));
        assert!(summary.mean < 0.3, "{light}: {summary:?}");
        assert!(summary.max > 0.0, "{light}: nothing was compared");
    }
}

#[test]
fn the_spectrum_at_the_nodes_has_the_color_of_the_picture() {
    let document = glazes_over_mixtures();
    let light = light(&document.library, "D65");
    let at_nodes = SpectralDocument::at_nodes(&document, &light.quadrature);
    let picture = picture(&document, &scene(&document, &light));
    for y in [0, 17, 47] {
        for x in 0..picture.width() {
            let xyz = light.quadrature.rule.xyz(&at_nodes.measured_reflectance(x, y));
            let white = light.quadrature.rule.white;
            let exact = RgbSpace::Srgb.linear_from_xyz(xyz, white, Adaptation::Bradford).0;
            let found = picture[(x, y)];
            for channel in 0..3 {
                let error = (f64::from(found[channel]) - exact[channel]).abs();
                assert!(error < 2e-6, "({x}, {y}): {found:?}, exactly {exact:?}");
            }
        }
    }
}

#[test]
fn a_perfect_diffuse_is_white_under_every_light() {
    for name in ["D65", "A", "FL11", "5600K"] {
        let light = light(&crate::made_up::oils(), name);
        for channel in 0..3 {
            let sum: f32 = light.rgb_from_nodes.iter().map(|rgb| rgb[channel]).sum();
            assert!((sum - 1.0).abs() < 2e-6, "{name}: {sum}");
        }
        let full = viewing(name).weights(crate::made_up::oils().grid).unwrap().white();
        let ours = light.quadrature.rule.white;
        let near = full.to_array().into_iter().zip(ours.to_array()).all(|(a, b)| a == b);
        assert!(near, "{name}: {full:?} {ours:?}");
    }
}

/// CIELAB lightness, chroma and hue of a linear sRGB colour.
fn seen(rgb: [f32; 3]) -> Lch {
    lab(rgb).to_lch()
}

#[test]
fn yellow_and_prussian_blue_make_green_where_lights_make_grey() {
    let library = crate::made_up::oils();
    let light = light(&library, "D65");
    let [yellow, blue, white] = ["Chrome Yellow (Otero)", "Prussian Blue", "Lead White"]
        .map(|name| library.find(name).unwrap());
    // Tints with white: an ochre-like yellow and a clearly visible blue.
    let [yellow, blue] = [vec![(yellow, 0.6), (white, 0.4)], vec![(blue, 0.03), (white, 0.97)]];
    let mixer = Mixer::new(&library, &light, &yellow, &blue).unwrap();
    let [first, last] = [mixer.mix(0.0), mixer.mix(1.0)];
    let (green, grey) = (1..20)
        .map(|i| {
            let share = i as f32 / 20.0;
            let lights: [f32; 3] = std::array::from_fn(|c| first[c] + share * (last[c] - first[c]));
            (seen(mixer.mix(share)), seen(lights))
        })
        .fold((false, false), |(green, grey), (paint, lights)| {
            let is_green = |c: &Lch| c.chroma > 20.0 && (130.0..190.0).contains(&c.hue_degrees);
            (green | is_green(&paint), grey | is_green(&lights))
        });
    assert!(green, "no mixture of paint is green");
    assert!(!grey, "a mixture of lights is green");
}

#[test]
fn a_mixer_mixes_as_the_library_does() {
    let library = crate::made_up::oils();
    for name in ["D65", "A"] {
        let light = light(&library, name);
        for (first, second) in [(1, 15), (12, 10), (4, 7)] {
            let first = PigmentId(first);
            let second = PigmentId(second);
            let first_recipe = [(first, 2.0)];
            let second_recipe = [(second, 1.0), (PigmentId(9), 1.0)];
            let mixer = Mixer::new(&library, &light, &first_recipe, &second_recipe).unwrap();
            let shares: Vec<f32> = (0..=100u8).map(|i| f32::from(i) / 100.0).collect();
            let mut found = vec![[0.0; 3]; shares.len()];
            mixer.mix_into(&shares, &mut found);
            for (share, found) in shares.into_iter().zip(found) {
                assert_eq!(found, mixer.mix(share));
                let t = f64::from(share);
                let parts = [(first, 1.0 - t), (second, 0.5 * t), (PigmentId(9), 0.5 * t)];
                let [absorption, scattering] = light.quadrature.mixed(&parts);
                let mixture = Curves { grid: library.grid, absorption, scattering };
                let xyz = light.quadrature.rule.xyz(&mixture.hiding(library.saunderson));
                let white = light.quadrature.rule.white;
                let Rgb(exact) = RgbSpace::Srgb.linear_from_xyz(xyz, white, Adaptation::Bradford);
                for channel in 0..3 {
                    let error = (f64::from(found[channel]) - exact[channel]).abs();
                    assert!(error < 3e-6, "{name} {share}: {found:?} {exact:?}");
                }
            }
        }
    }
}

#[test]
fn a_thin_glaze_shows_its_ground_and_a_thick_film_hides_it() {
    let over = |mm: f64, ground: f64| {
        let mut document = document(1, 1, &["Ultramarine", "Lead White"]);
        document.ground.reflectance.fill(ground);
        lay(&mut document.wet, (0, 0), &[0.2 * mm, 0.8 * mm]);
        let light = light(&document.library, "D65");
        labs(&document, &light)[0]
    };
    let difference = |mm| delta_e_ciede2000(over(mm, 0.9), over(mm, 0.03));
    let [thin, thick] = [difference(0.005), difference(3.0)];
    assert!(thin > 20.0, "a glaze over white and black: {thin}");
    assert!(thick < 0.05, "three millimetres over white and black: {thick}");
}

#[test]
fn a_bare_ground_shows_its_measured_color() {
    let library = crate::made_up::oils();
    for pigment in ["Zinc White", "Vermilion", "Bone Black"] {
        let mut document = document(1, 1, &[]);
        let film = library.mix([(library.find(pigment).unwrap(), 1.0)]).unwrap();
        document.ground.reflectance = film.hiding(library.saunderson);
        let weights = viewing("D65").weights(library.grid).unwrap();
        let xyz = weights.xyz(&document.ground.reflectance);
        let found = labs(&document, &light(&library, "D65"))[0];
        let error = delta_e_ciede2000(found, Lab::from_xyz(xyz, weights.white()));
        assert!(error < 0.5, "{pigment}: {error}");
    }
}

#[test]
fn opacity_is_thickness_and_a_dried_layer_looks_as_it_did_wet() {
    let names = ["Ultramarine", "Lead White"];
    let mut wet = document(2, 1, &names);
    lay(&mut wet.wet, (0, 0), &[0.004, 0.02]);
    lay(&mut wet.wet, (1, 0), &[0.002, 0.01]);
    let light = light(&wet.library, "D65");
    let seen = labs(&wet, &light);
    let mut dried = document(2, 1, &[]);
    let slots = slots(&dried.library, &names);
    let paint = wet.wet.clone();
    dried.push_dry(slots, paint);
    assert_eq!(labs(&dried, &light), seen);
    dried.dry[0].opacity = 0.5;
    let half = labs(&dried, &light);
    assert!(delta_e_ciede2000(half[0], seen[1]) < 1e-3, "{half:?} {seen:?}");
    dried.dry[0].opacity = 0.0;
    let bare = labs(&document(2, 1, &[]), &light);
    assert_eq!(labs(&dried, &light), bare);
}

#[test]
fn a_painting_made_under_one_light_looks_under_another_as_if_made_there() {
    let document = glazes_over_mixtures();
    let under = |name: &str| labs(&document, &light(&document.library, name));
    let day = under("D65");
    let bulb = under("A");
    let exact = exact_xyz(&document, &viewing("A"));
    let white = viewing("A").weights(document.library.grid).unwrap().white();
    let errors = |labs: &[Lab]| {
        let pairs = labs.iter().zip(&exact);
        let each: Vec<f64> = pairs
            .map(|(lab, xyz)| {
                let on_screen = spectra::color::adapt(
                    *xyz,
                    white,
                    RgbSpace::Srgb.white(),
                    Adaptation::Bradford,
                );
                delta_e_ciede2000(*lab, Lab::from_xyz(on_screen, RgbSpace::Srgb.white()))
            })
            .collect();
        Summary::of(&each).mean
    };
    let relit = errors(&bulb);
    let not_relit = errors(&day);
    assert!(relit < 0.3 && not_relit > 1.0, "relit {relit}, not relit {not_relit}");
}
