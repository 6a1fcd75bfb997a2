//! Separates colours into heights of pigments and rebuilds the colours of the films, and chooses
//! the palette for a photograph from the pigments of a library.

use calibrate::PigmentId;
use graphics::field::Field;
use paint::document::Slots;
use paint::layer::SLOTS;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::color::{Rgb, delta_e_ciede2000};
use strokes::{
    ChosenPalette, ColorErrors, PaintFilm, Picture, Separation, SeparationError,
    SeparationSettings, black_compensated, choose_palette, rebuild_picture,
};

use crate::made::{HIDING, STUDIO, THIN, mixtures};

fn errors(separation: &Separation, picture: &Picture) -> ColorErrors {
    let heights = separation.separate(picture);
    ColorErrors::between(separation, picture, &rebuild_picture(separation.film(), &heights))
}

fn linear(hex: &str) -> [f32; 3] {
    Rgb::from_hex(hex).unwrap().linear().0.map(|value| value as f32)
}

#[test]
fn what_the_palette_mixes_comes_back() {
    let hiding = errors(&HIDING, &mixtures(11, 2000, 0.3));
    assert!(hiding.mean < 0.5, "{hiding:?}");
    assert!(hiding.out_of_gamut < 0.1, "{hiding:?}");
    let thin = errors(&THIN, &mixtures(12, 2000, 0.03));
    assert!(thin.mean < 0.3 && thin.p95 < 1.0, "{thin:?}");
    assert!(thin.out_of_gamut < 0.03, "{thin:?}");
}

#[test]
fn the_table_alone_is_near_and_refining_brings_nearer() {
    let picture = mixtures(13, 2000, 0.03);
    let looked_up: Vec<_> = picture.values().iter().map(|&rgb| THIN.heights_mm(rgb)).collect();
    let looked_up = Field::from_values(2000, 1, looked_up);
    let table = ColorErrors::between(&THIN, &picture, &rebuild_picture(THIN.film(), &looked_up));
    assert!(table.mean < 1.6, "{table:?}");
    assert!(errors(&THIN, &picture).mean < table.mean / 4.0);
}

#[test]
fn heights_are_never_negative_and_within_their_range() {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut colors: Vec<[f32; 3]> =
        (0..500).map(|_| std::array::from_fn(|_| random.random_range(-0.2..1.2))).collect();
    colors.extend([[0.0; 3], [1.0; 3], [f32::NAN, 0.5, f32::INFINITY]]);
    for separation in [&*HIDING, &*THIN] {
        for &rgb in &colors {
            for heights in [separation.heights_mm(rgb), separation.refined_heights_mm(rgb)] {
                let sum: f32 = heights.iter().sum();
                assert!(heights.iter().all(|height| *height >= 0.0), "{rgb:?}: {heights:?}");
                assert!((0.03 - 1e-6..0.3 + 1e-6).contains(&sum), "{rgb:?}: {sum} mm");
            }
        }
    }
}

#[test]
fn an_even_picture_gives_even_maps() {
    let maps = HIDING.separate(&Field::filled(9, 5, linear("#a07850")));
    assert!(maps.values().iter().all(|heights| *heights == maps[(0, 0)]));
}

#[test]
fn a_graded_picture_gives_maps_without_noise() {
    let from = linear("#b08060");
    let to = linear("#d8d0c8");
    let graded: Vec<[f32; 3]> = (0..400)
        .map(|at| std::array::from_fn(|i| from[i] + (to[i] - from[i]) * at as f32 / 399.0))
        .collect();
    let maps = HIDING.separate(&Field::from_values(400, 1, graded));
    let travelled: f32 = maps
        .values()
        .windows(2)
        .map(|pair| (0..8).map(|i| (pair[1][i] - pair[0][i]).abs()).sum::<f32>())
        .sum();
    let first = maps[(0, 0)];
    let last = maps[(399, 0)];
    let apart: f32 = (0..8).map(|i| (last[i] - first[i]).abs()).sum();
    assert!(travelled < 2.5 * apart, "{travelled} mm of change for {apart} mm apart");
}

#[test]
fn few_pigments_are_mixed() {
    let picture = mixtures(14, 500, 0.3);
    let maps = HIDING.separate(&picture);
    let mean = maps
        .values()
        .iter()
        .map(|heights: &[f32; 8]| {
            let total: f32 = heights.iter().sum();
            heights.iter().filter(|height| **height > 0.005 * total).count()
        })
        .sum::<usize>() as f64
        / 500.0;
    assert!(mean < 4.5, "{mean} pigments a colour");
}

#[test]
fn out_of_reach_lightness_is_kept_before_chroma() {
    let film = HIDING.film();
    for hex in ["#00ff00", "#ff00ff", "#00ffff", "#00c000", "#c000c0"] {
        let rgb = linear(hex);
        assert!(HIDING.is_out_of_gamut(rgb), "{hex}");
        let wanted = film.lab_from_rgb(rgb);
        let found = film.lab(&HIDING.refined_heights_mm(rgb).map(f64::from));
        let lighter = (found.lightness - wanted.lightness).abs();
        let chroma = wanted.to_lch().chroma - found.to_lch().chroma;
        assert!(lighter < 0.5 * chroma, "{hex}: L* off by {lighter}, C* less by {chroma}");
    }
    assert!(!HIDING.is_out_of_gamut(linear("#a07850")));
}

#[test]
fn films_that_may_be_thin_reach_farther_and_those_that_hide_show_less() {
    let picture = mixtures(15, 1000, 0.03);
    let hiding = errors(&HIDING, &picture);
    let thin = errors(&THIN, &picture);
    assert!(thin.out_of_gamut < hiding.out_of_gamut, "{thin:?} {hiding:?}");
    // A film over a black ground changes colour. This measures what the film does not hide.
    let black = vec![0.03; STUDIO.library.grid.count()];
    let materials = STUDIO.materials(&STUDIO.slots);
    let over_black = PaintFilm::at_nodes(
        strokes::FilmMaterials { ground: &black, ..materials },
        &STUDIO.quadrature,
    );
    let [by_hiding, by_thin] = [&HIDING, &THIN].map(|separation| {
        let heights = separation.separate(&picture);
        let differences = heights.values().iter().map(|heights| {
            let heights = heights.map(f64::from);
            delta_e_ciede2000(over_black.lab(&heights), separation.film().lab(&heights))
        });
        differences.sum::<f64>() / 1000.0
    });
    assert!(by_hiding < 0.7 * by_thin, "{by_hiding} {by_thin}");
}

#[test]
fn bare_ground_has_its_own_color() {
    let [r, g, b] = STUDIO.film().rgb(&[0.0; 8]);
    for value in [r, g, b] {
        assert!((value - 0.85).abs() < 2e-3, "{r} {g} {b}");
    }
}

#[test]
fn shadows_brought_within_reach_keep_their_differences() {
    let shadows: Vec<[f32; 3]> = (0..50).map(|at| [at as f32 * 0.0008; 3]).collect();
    let shadows = Field::from_values(50, 1, shadows);
    let raised = black_compensated(&shadows, HIDING.black());
    assert!((0.03..0.05).contains(&HIDING.black()), "{}", HIDING.black());
    assert!((raised[(0, 0)][1] - HIDING.black()).abs() < 1e-6);
    assert_eq!(black_compensated(&Field::filled(1, 1, [1.0; 3]), 0.04)[(0, 0)], [1.0; 3]);
    let plain = errors(&HIDING, &shadows);
    let raised = errors(&HIDING, &raised);
    assert!(raised.mean < 0.3 * plain.mean, "{raised:?} {plain:?}");
}

#[test]
fn the_same_input_gives_the_same_table() {
    let settings = SeparationSettings { lattice: 7, ..SeparationSettings::default() };
    let [one, again] = [(); 2].map(|()| Separation::new(STUDIO.film(), &settings).unwrap());
    assert_eq!(one, again);
}

#[test]
fn settings_out_of_range_are_refused() {
    let good = SeparationSettings { lattice: 5, ..SeparationSettings::default() };
    let refused = |settings| Separation::new(STUDIO.film(), &settings).unwrap_err();
    for lattice in [0, 4, 66] {
        let found = refused(SeparationSettings { lattice, ..good });
        assert_eq!(found, SeparationError::Lattice(lattice));
    }
    for (least_mm, most_mm) in [(0.0, 0.3), (0.3, 0.1), (0.1, 1e9), (0.1, f64::NAN)] {
        let found = refused(SeparationSettings { least_mm, most_mm, ..good });
        assert!(matches!(found, SeparationError::Heights { .. }), "{found}");
    }
    let none = PaintFilm::at_nodes(STUDIO.materials(&[None; 8]), &STUDIO.quadrature);
    assert_eq!(Separation::new(none, &good).unwrap_err(), SeparationError::NoPigment);
}

#[test]
fn a_film_of_one_height_and_one_pigment_is_possible() {
    let mut slots = [None; 8];
    slots[5] = STUDIO.slots[0];
    let film = PaintFilm::at_nodes(STUDIO.materials(&slots), &STUDIO.quadrature);
    let settings =
        SeparationSettings { lattice: 5, least_mm: 0.1, most_mm: 0.1, ..Default::default() };
    let separation = Separation::new(film, &settings).unwrap();
    let heights = separation.refined_heights_mm([0.2, 0.5, 0.7]);
    for (slot, height) in heights.into_iter().enumerate() {
        assert!((height - if slot == 5 { 0.1 } else { 0.0 }).abs() < 1e-6, "{heights:?}");
    }
}

fn chosen(picture: &Picture) -> ChosenPalette {
    let materials = STUDIO.materials(&[None; SLOTS]);
    choose_palette(
        picture,
        materials,
        |materials: strokes::FilmMaterials<'_>| PaintFilm::at_nodes(materials, &STUDIO.quadrature),
        &SeparationSettings::default(),
    )
    .unwrap()
}

/// Sixty tints and shades of one pigment: mixtures with lead white and bone black.
fn tints(name: &str) -> Picture {
    let mut slots: Slots = [None; SLOTS];
    let names = ["Lead White", name, "Bone Black"];
    slots[..3].copy_from_slice(&names.map(|name| Some(STUDIO.library.find(name).unwrap())));
    let film = PaintFilm::at_nodes(STUDIO.materials(&slots), &STUDIO.quadrature);
    let colors = (0..60).map(|at| {
        let white = 0.28 * (at % 10) as f32 / 10.0;
        let black = 0.02 * (at / 10) as f32 / 6.0;
        let mut heights = [0.0; SLOTS];
        heights[..3].copy_from_slice(&[white, 0.3 - white - black, black]);
        film.rgb(&heights).map(|value| value.clamp(0.0, 1.0))
    });
    Field::from_values(60, 1, colors.collect())
}

#[test]
fn a_photograph_of_one_hue_gets_a_palette_that_paints_it() {
    for name in ["Cobalt Blue", "Vermilion"] {
        let found = chosen(&tints(name));
        assert!(found.mean < 0.8, "{name}: {found:?}");
    }
}

#[test]
fn a_palette_holds_no_pigment_twice_and_none_unidentified() {
    let colors = (0..216).map(|at| [at / 36, at / 6 % 6, at % 6].map(|v| v as f32 / 5.0));
    let found = chosen(&Field::from_values(216, 1, colors.collect()));
    let mut pigments: Vec<PigmentId> = found.slots.iter().flatten().copied().collect();
    assert_eq!(pigments.len(), SLOTS, "all of sRGB needs a full palette: {found:?}");
    assert!(pigments.iter().all(|&pigment| STUDIO.library[pigment].identified));
    pigments.sort_unstable();
    pigments.dedup();
    assert_eq!(pigments.len(), SLOTS, "{found:?}");
}

#[test]
fn the_same_photograph_gets_the_same_palette() {
    let picture = tints("Viridian");
    assert_eq!(chosen(&picture), chosen(&picture));
}

#[test]
fn a_library_of_unknown_scattering_is_refused() {
    let mut library = STUDIO.library.clone();
    library.pigments.iter_mut().for_each(|pigment| pigment.identified = false);
    let materials = STUDIO.materials(&[None; SLOTS]);
    let materials = strokes::FilmMaterials { library: &library, ..materials };
    let picture = Field::filled(2, 2, [0.5; 3]);
    let found = choose_palette(
        &picture,
        materials,
        |materials: strokes::FilmMaterials<'_>| PaintFilm::at_nodes(materials, &STUDIO.quadrature),
        &SeparationSettings::default(),
    );
    assert_eq!(found, Err(SeparationError::NoPigment));
}
