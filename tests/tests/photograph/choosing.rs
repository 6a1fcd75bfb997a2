//! Choosing the palette for a photograph from the pigments of a library.

use calibrate::PigmentId;
use graphics::field::Field;
use paint::document::Slots;
use paint::layer::SLOTS;
use strokes::{
    ChosenPalette, PaintFilm, Picture, SeparationError, SeparationSettings, choose_palette,
};

use crate::made::STUDIO;

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
    let find = |name: &str| Some(STUDIO.library.find(name).unwrap());
    let mut slots: Slots = [None; SLOTS];
    slots[..3].copy_from_slice(&[find("Lead White"), find(name), find("Bone Black")]);
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
