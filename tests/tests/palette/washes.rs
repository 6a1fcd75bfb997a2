//! Palettes of absolute amounts: washes over the white card, which replaces a white paint.

use calibrate::evaluate::Viewing;
use calibrate::library::{AmountKind, PigmentLibrary};
use calibrate::palette::{
    Cards, MixingRow, PainterRules, Palette, graded, hiding_powers, mixing_chart, sampled_gamut,
    tint_ladders,
};
use calibrate::{PigmentId, Recipe};
use spectra::color::delta_e_ciede2000;
use suite::near::assert_near;

use crate::made::{band, even, grid, library, recipe};

fn watercolors() -> PigmentLibrary {
    let pigments = vec![
        band("red", 120.0, 520.0, 0.0),
        band("yellow", 80.0, 430.0, 15.0),
        band("blue", 100.0, 610.0, 4.0),
        even("water", 0.0, 0.0),
    ];
    library(pigments, AmountKind::Absolute)
}

#[test]
fn a_wash_goes_nine_tenths_of_the_way_where_it_absorbs_most() {
    let library = watercolors();
    let viewing = Viewing::default();
    let palette = Palette::new(&library, &viewing, Cards::standard(grid())).unwrap();
    // Without scattering a wash attenuates the card by exp(-2 K d) = 1/10 where it absorbs most.
    assert_near("red", &[palette.wash(PigmentId(0))], &[10f64.ln() / 2.0 / 120.01], 1e-9);
    assert_near("water", &[palette.wash(PigmentId(3))], &[1.0], 0.0);
    let at = 3;
    let yellow = palette.reflectance(&recipe([(1, 1.0)]))[at];
    let mixture = library.mix(recipe([(1, 1.0)])).unwrap();
    let hiding = mixture.hiding(library.saunderson)[at];
    assert_near("yellow", &[yellow], &[0.8 + 0.9 * (hiding - 0.8)], 1e-9);
}

#[test]
fn water_thins_a_wash_to_the_paper() {
    let library = watercolors();
    let viewing = Viewing::default();
    let palette = Palette::new(&library, &viewing, Cards::standard(grid())).unwrap();
    assert_eq!(palette.white(), None);
    assert_eq!(palette.tint(PigmentId(0), 3.0), recipe([(0, 0.25)]));
    let paper = palette.appearance(&palette.cards().white);
    for ladder in tint_ladders(&palette) {
        let far: Vec<f64> =
            ladder.colors.iter().map(|c| delta_e_ciede2000(c.lab, paper.lab)).collect();
        assert!(far.windows(2).all(|w| w[1] <= w[0] + 1e-9), "{:?}: {far:?}", ladder.paint);
    }
}

#[test]
fn charts_and_graded_mixtures_are_washes_over_the_white_card() {
    let library = watercolors();
    let viewing = Viewing::default();
    let palette = Palette::new(&library, &viewing, Cards::standard(grid())).unwrap();
    let chart = mixing_chart(&palette);
    let amounts =
        recipe([(0, 0.5 * palette.wash(PigmentId(0))), (2, 0.5 * palette.wash(PigmentId(2)))]);
    let film = library.mix(&amounts).unwrap().film(1.0, &palette.cards().white, library.film());
    assert_near("red and blue", &palette.reflectance(&recipe([(0, 0.5), (2, 0.5)])), &film, 1e-12);
    assert_eq!(chart.colors[0][2], palette.appearance(&film));
    let rules = PainterRules::of(&palette).unwrap();
    let mixture = graded(&palette, (PigmentId(1), PigmentId(2)), &[], &rules);
    let middle = &mixture.steps[5];
    let spectrum = middle.colors[MixingRow::Spectrum as usize].unwrap();
    assert_eq!(spectrum, palette.color(&recipe([(1, 0.5), (2, 0.5)])));
    assert!(middle.errors.iter().flatten().all(|error| error.is_finite()), "{middle:?}");
}

#[test]
fn amounts_that_hide_are_told_and_clear_ones_never_do() {
    let library = watercolors();
    let viewing = Viewing::default();
    let palette = Palette::new(&library, &viewing, Cards::standard(grid())).unwrap();
    let powers = hiding_powers(&palette);
    assert_eq!(powers[3].hides.thickness(), None);
    let yellow = powers[1].hides.thickness().unwrap();
    // There the luminance over black is 0.98 of that over white.
    let mixture = library.mix(recipe([(1, 1.0)])).unwrap();
    let weights = viewing.weights(grid()).unwrap();
    let over = |card: &[f64]| weights.xyz(&mixture.film(yellow, card, library.film())).y;
    let contrast = over(&palette.cards().black) / over(&palette.cards().white);
    assert_near("contrast", &[contrast], &[0.98], 1e-6);
    let gamut = sampled_gamut(&palette);
    let most = |recipe: &Recipe| recipe.iter().map(|(_, share)| share).sum::<f64>();
    let deepest = gamut.samples.iter().map(|s| most(&s.recipe)).fold(0.0, f64::max);
    assert!((deepest - 8.0).abs() < 1e-9, "the largest sum of washes is {deepest}");
    assert!(gamut.samples.iter().all(|s| s.color.lab.a.is_finite()));
}
