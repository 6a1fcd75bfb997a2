//! Colour of paint: eight wavelengths compared with the full spectrum, mixtures of pigments
//! compared with mixtures of lights, thin films outside the gamut, an eye that has adapted in part,
//! and pictures with several pixels per cell.

use calibrate::evaluate::{Summary, Viewing, percentile};
use calibrate::{Curves, PigmentId};
use graphics::field::Field;
use paint::document::{Document, Lighting, Slots};
use paint::layer::SLOTS;
use paint::light::{Light, Mixer};
use paint::scene::{PixelsPerCell, SpectralDocument, fine_picture, picture, scene};
use spectra::color::{Adaptation, Lab, Lch, Rgb, RgbSpace, Xyz, delta_e_ciede2000};

use crate::made_up::{document, glazes_over_mixtures, lay, light, oils, slots, viewing};

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

/// CIEDE2000 of eight wavelengths from the full spectrum, by cell. Both are adapted to the white of
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
        let light = light(&oils(), name);
        for channel in 0..3 {
            let sum: f32 = light.rgb_from_nodes.iter().map(|rgb| rgb[channel]).sum();
            assert!((sum - 1.0).abs() < 2e-6, "{name}: {sum}");
        }
        let full = viewing(name).weights(oils().grid).unwrap().white();
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
    let library = oils();
    let light = light(&library, "D65");
    let [yellow, blue, white] = ["Chrome Yellow (Otero)", "Prussian Blue", "Lead White"]
        .map(|name| library.find(name).unwrap());
    // Tints with white: a yellow like ochre, and a clearly visible blue.
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
            let [by_paint, by_lights] =
                [paint, lights].map(|c| c.chroma > 20.0 && (130.0..190.0).contains(&c.hue_degrees));
            (green | by_paint, grey | by_lights)
        });
    assert!(green, "no mixture of paint is green");
    assert!(!grey, "a mixture of lights is green");
}

#[test]
fn a_mixer_mixes_as_the_library_does() {
    let library = oils();
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
    let [thin, thick] = [0.005, 3.0].map(|mm| {
        let [over_white, over_black] = [0.9, 0.03].map(|ground| {
            let mut document = document(1, 1, &["Ultramarine", "Lead White"]);
            document.ground.reflectance.fill(ground);
            lay(&mut document.wet, (0, 0), &[0.2 * mm, 0.8 * mm]);
            let light = light(&document.library, "D65");
            labs(&document, &light)[0]
        });
        delta_e_ciede2000(over_white, over_black)
    });
    assert!(thin > 20.0, "a glaze over white and black: {thin}");
    assert!(thick < 0.05, "three millimetres over white and black: {thick}");
}

#[test]
fn a_bare_ground_shows_its_measured_color() {
    let library = oils();
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
    let [day, bulb] = ["D65", "A"].map(|name| labs(&document, &light(&document.library, name)));
    let exact = exact_xyz(&document, &viewing("A"));
    let white = viewing("A").weights(document.library.grid).unwrap().white();
    let [relit, not_relit] = [bulb, day].map(|labs| {
        let each = labs.iter().zip(&exact).map(|(lab, xyz)| {
            let screen = RgbSpace::Srgb.white();
            let on_screen = spectra::color::adapt(*xyz, white, screen, Adaptation::Bradford);
            delta_e_ciede2000(*lab, Lab::from_xyz(on_screen, screen))
        });
        Summary::of(&each.collect::<Vec<f64>>()).mean
    });
    assert!(relit < 0.3 && not_relit > 1.0, "relit {relit}, not relit {not_relit}");
}

/// Thicknesses of the films in mm.
const FILMS_MM: [f64; 8] = [0.002, 0.004, 0.007, 0.01, 0.015, 0.02, 0.03, 0.05];

fn lch(rgb: Rgb) -> Lch {
    let xyz = RgbSpace::Srgb.xyz_from_linear().apply(rgb.0);
    Lab::from_xyz(xyz.into(), RgbSpace::Srgb.white()).to_lch()
}

#[test]
fn thin_films_of_every_pigment_keep_their_hue_on_a_screen() {
    let library = oils();
    let light = light(&library, "D65");
    let mut outside = 0;
    let mut worst = (0.0, String::new());
    let mut least = 1.0f64;
    let mut cut_off = 0.0f64;
    let pigments: Vec<_> = library.ids().collect();
    for pigments in pigments.chunks(SLOTS) {
        let mut films = document(FILMS_MM.len(), pigments.len(), &[]);
        let slots: Slots = std::array::from_fn(|slot| pigments.get(slot).copied());
        films.slots = slots;
        films.medium.films_break = false;
        for (slot, y) in (0..pigments.len()).enumerate() {
            for (x, mm) in FILMS_MM.into_iter().enumerate() {
                let mut amounts = [0.0; SLOTS];
                amounts[slot] = mm;
                lay(&mut films.wet, (x, y), &amounts);
            }
        }
        let even = picture(&films, &scene(&films, &light));
        // Paint that breaks stays within the gamut.
        films.medium.films_break = true;
        let broken = picture(&films, &scene(&films, &light));
        for &[r, g, b, _] in broken.values() {
            assert!(Rgb([r, g, b].map(f64::from)).in_gamut(), "{r} {g} {b}");
        }
        for (index, &[r, g, b, _]) in even.values().iter().enumerate() {
            let exact = Rgb([r, g, b].map(f64::from));
            let shown = exact.mapped_into_gamut();
            if exact.in_gamut() {
                assert_eq!(shown, exact);
                continue;
            }
            outside += 1;
            let clipped = Rgb(exact.0.map(|value| value.clamp(0.0, 1.0)));
            let [exact, shown, clipped] = [exact, shown, clipped].map(lch);
            let pigment = &library[pigments[index / FILMS_MM.len()]].name;
            let mm = FILMS_MM[index % FILMS_MM.len()];
            let lightness = (shown.lightness - exact.lightness).abs();
            assert!(lightness < 0.1, "{pigment} {mm} mm: {exact:?} shown as {shown:?}");
            if exact.chroma.min(shown.chroma) > 5.0 {
                let [turned, cut] = [shown, clipped].map(|to| {
                    let degrees = (to.hue_degrees - exact.hue_degrees).abs();
                    degrees.min(360.0 - degrees)
                });
                println!(
                    "{pigment} {mm} mm: {exact:?} shown as {shown:?}, turned {turned:.2}, cut off {cut:.2}"
                );
                if turned > worst.0 {
                    worst = (turned, format!("{pigment} {mm} mm: {exact:?} {shown:?}"));
                }
                cut_off = cut_off.max(cut);
                least = least.min(shown.chroma / exact.chroma);
            }
        }
    }
    println!("{outside} outside, turned {worst:?}, cut off {cut_off}, chroma {least}");
    assert!(outside > 10, "only {outside} films are outside the gamut");
    assert!(worst.0 < 0.5, "{worst:?}");
    assert!(cut_off > 5.0, "cutting off channels turns hues by {cut_off} degrees at most");
}

fn white(rgb: &[[f32; 3]]) -> [f64; 3] {
    std::array::from_fn(|channel| rgb.iter().map(|rgb| f64::from(rgb[channel])).sum())
}

#[test]
fn an_eye_that_adapted_in_part_keeps_some_of_the_color_of_the_light() {
    for name in ["A", "3000K", "D65", "FL11"] {
        let light = light(&oils(), name);
        assert_eq!(light.rgb_at_degree(1.0), light.rgb_from_nodes, "{name}");
        let chromas = [1.0, 0.75, 0.5, 0.25, 0.0].map(|degree| {
            let white = white(&light.rgb_at_degree(degree));
            let greatest = white.into_iter().fold(0.0, f64::max);
            assert!((greatest - 1.0).abs() < 1e-5, "{name} {degree}: {white:?}");
            let xyz: Xyz = RgbSpace::Srgb.xyz_from_linear().apply(white).into();
            Lab::from_xyz(xyz, RgbSpace::Srgb.white()).to_lch().chroma
        });
        if name == "D65" {
            assert!(chromas.iter().all(|chroma| *chroma < 0.1), "{chromas:?}");
        } else {
            assert!(chromas.windows(2).all(|pair| pair[0] < pair[1]), "{name}: {chromas:?}");
        }
        // Without adaptation, white has the chromaticity of the light.
        let found: Xyz =
            RgbSpace::Srgb.xyz_from_linear().apply(white(&light.rgb_at_degree(0.0))).into();
        let wanted = light.quadrature.rule.white;
        let [found, wanted] =
            [found, wanted].map(|v| [v.x / (v.x + v.y + v.z), v.y / (v.x + v.y + v.z)]);
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-6, "{name}: {found} {wanted}");
        }
    }
}

#[test]
fn a_painting_is_shown_with_the_adaptation_of_its_light() {
    let mut document = document(1, 1, &[]);
    let bulb = light(&document.library, "A");
    let [complete, half] = [1.0, 0.5].map(|adaptation| {
        document.lighting = Lighting { adaptation, ..Lighting::default() };
        picture(&document, &scene(&document, &bulb)).values()[0]
    });
    assert!((complete[0] - complete[2]).abs() < 0.01, "a grey ground: {complete:?}");
    assert!(half[0] > 1.5 * half[2], "yellow light: {half:?}");
    fn text(lighting: &Lighting) -> String {
        serde_json::to_string(lighting).unwrap()
    }
    let before = text(&Lighting::default());
    assert!(!before.contains("adaptation"), "files of complete adaptation stay: {before}");
    for adaptation in [1.0, 0.5] {
        let lighting = Lighting { adaptation, ..Lighting::default() };
        let read: Lighting = serde_json::from_str(&text(&lighting)).unwrap();
        assert_eq!(read, lighting);
    }
}

fn pixels(count: u8) -> PixelsPerCell {
    PixelsPerCell::new(count).unwrap()
}

fn both(document: &Document, count: u8) -> [Field<[f32; 4]>; 2] {
    let scene = scene(document, &light(&document.library, "D65"));
    [picture(document, &scene), fine_picture(document, &scene, pixels(count))]
}

#[test]
fn even_paint_keeps_its_bits() {
    let mut even = document(9, 7, &["Vermilion", "Lead White"]);
    for cell in (0..7).flat_map(|y| (0..9).map(move |x| (x, y))) {
        lay(&mut even.wet, cell, &[0.013, 0.02]);
    }
    even.lighting = Lighting { relief: 3.0, elevation_deg: 20.0, ..Lighting::default() };
    for count in 1..=4 {
        let [coarse, fine] = both(&even, count);
        assert_eq!((fine.width(), fine.height()), (9 * usize::from(count), 7 * usize::from(count)));
        assert!(fine.values().iter().all(|rgb| *rgb == coarse.values()[0]), "{count}");
    }
}

#[test]
fn a_picture_keeps_its_mean() {
    let glazes = glazes_over_mixtures();
    for count in 1..=4 {
        let [coarse, fine] = both(&glazes, count).map(|picture| -> f64 {
            let sum: f64 = picture.values().iter().map(|rgb| f64::from(rgb[1])).sum();
            sum / picture.values().len() as f64
        });
        assert!((coarse - fine).abs() < 0.01 * coarse, "{count}: {coarse} {fine}");
    }
}

#[test]
fn the_edge_of_a_slanting_stroke_has_no_stairs() {
    // Paint is to the left of a line that moves a cell to the right with each row.
    fn edge(y: f64) -> f64 {
        y - 0.5
    }
    let mut slanting = document(40, 40, &["Bone Black"]);
    for cell in (0..40).flat_map(|y| (0..40).map(move |x| (x, y))) {
        let covered = (cell.0 as f64) + 0.5 <= edge(cell.1 as f64 + 0.5) + 0.25;
        lay(&mut slanting.wet, cell, &[if covered { 0.2 } else { 0.0 }]);
    }
    let [coarse, fine] = both(&slanting, 4);
    let middle = 0.5 * (coarse[(0, 39)][1] + coarse[(39, 0)][1]);
    // Difference between the largest and the smallest distance from the line to the edge of the
    // paint, over quarters of a row.
    fn stairs(lighter: impl Fn(usize, usize) -> bool) -> f64 {
        let ends = (32..128).map(|y| {
            let x = (0..160).position(|x| lighter(x, y)).unwrap();
            x as f64 / 4.0 - edge((y as f64 + 0.5) / 4.0)
        });
        let (least, most) = ends.fold((f64::MAX, f64::MIN), |(a, b), d| (a.min(d), b.max(d)));
        most - least
    }
    let cells = stairs(|x, y| coarse[(x / 4, y / 4)][1] > middle);
    let pixels = stairs(|x, y| fine[(x, y)][1] > middle);
    assert!(cells > 0.7 && pixels < 0.3, "{cells} {pixels}");
}
