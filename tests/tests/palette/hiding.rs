//! Hiding power is the thickness from which a film hides. Tinting strength is how much K/S a paint
//! adds to a white, also relative to a standard paint. We compare both with closed forms and the
//! oils.

use calibrate::PigmentId;
use calibrate::evaluate::Viewing;
use calibrate::library::{AmountKind, Pigment};
use calibrate::palette::{
    Cards, Hides, Palette, PaletteError, TintingStrength, hiding_powers, scattering_per_mm,
    tinting_strengths,
};
use suite::golden::assert_near;

use crate::made::{Oils, band, even, grid, library};

fn cards(black: f64, white: f64) -> Cards {
    let standard = Cards::standard(grid());
    let [black, white] = [black, white].map(|value| vec![value; grid().count()]);
    Cards { black, white, ..standard }
}

fn hides(pigment: Pigment, cards: Cards) -> Hides {
    let library = library(vec![pigment], AmountKind::Relative);
    let viewing = Viewing::default();
    hiding_powers(&Palette::new(&library, &viewing, cards).unwrap())[0].hides
}

#[test]
fn a_film_that_absorbs_nothing_hides_where_its_quadratic_says() {
    // With K = 0 and x = S d, R is x / (1 + x) over black and (g + x (1 - g)) / (1 + x (1 - g))
    // over a card of reflectance g. For g = 0.8 their ratio is 0.98 where 0.004 x^2 + 0.02 x -
    // 0.784 = 0.
    let x = (-0.02 + (0.02f64.powi(2) + 4.0 * 0.004 * 0.784).sqrt()) / 0.008;
    let Hides::From(thickness) = hides(even("milk", 0.0, 2.0), cards(0.0, 0.8)) else {
        panic!("a film that scatters hides")
    };
    assert_near("thickness", &[thickness], &[x / 2.0], 1e-9);
}

#[test]
fn twice_the_paint_hides_at_half_the_thickness() {
    let [twice, once] = [2.0, 1.0].map(|factor| {
        let paint = even("grey", 0.3 * factor, 0.7 * factor);
        hides(paint, Cards::standard(grid())).thickness().unwrap()
    });
    assert_near("half", &[twice], &[once / 2.0], 1e-9);
}

#[test]
fn clear_films_never_hide() {
    let standard = Cards::standard(grid());
    let Hides::Never { contrast } = hides(even("nothing", 0.0, 0.0), standard.clone()) else {
        panic!("a film without K and S never hides")
    };
    assert_near("the cards' own", &[contrast], &[0.05 / 0.8], 1e-12);
    // This dye does not absorb from 650 nm on.
    let mut dye = band("dye", 2.0, 550.0, 0.0);
    dye.absorption.iter_mut().for_each(|k| *k -= 0.01);
    dye.absorption[25..].fill(0.0);
    assert!(matches!(hides(dye, standard), Hides::Never { contrast } if contrast < 0.1));
}

#[test]
fn a_black_glaze_hides_once_no_eye_sees_the_card() {
    // Y over the cards is 80 and 5, each times exp(-2 K d). The film hides once they differ by
    // 0.02.
    let Hides::From(thickness) = hides(even("ink", 0.5, 0.0), Cards::standard(grid())) else {
        panic!("black hides")
    };
    assert_near("thickness", &[thickness], &[(75.0f64 / 0.02).ln()], 1e-9);
}

#[test]
fn cards_that_are_alike_need_no_film() {
    assert_eq!(hides(even("milk", 0.0, 2.0), cards(0.5, 0.5)), Hides::From(0.0));
}

#[test]
fn every_oil_hides_where_its_contrast_says_and_not_below() {
    let oils = Oils::fitted();
    let palette = oils.palette();
    assert!(palette.cards().black_measured && palette.cards().white_measured);
    let powers = hiding_powers(&palette);
    assert_eq!(powers.len(), 18);
    for power in powers {
        let name = palette.label(power.paint);
        let thickness = power.hides.thickness().unwrap_or_else(|| panic!("{name} never hides"));
        let contrast = |thickness: f64| {
            let mixture = oils.library.mix([(power.paint, 1.0)]).unwrap();
            let [black, white] = [&palette.cards().black, &palette.cards().white].map(|card| {
                let film = mixture.film(thickness, card, oils.library.film());
                palette.weights().xyz(&film).y
            });
            black / white
        };
        assert_near(&name, &[contrast(thickness)], &[0.98], 1e-9);
        assert!(contrast(0.98 * thickness) < 0.98, "{name} hides below {thickness}");
        for thicker in [1.1, 2.0, 10.0, 1000.0] {
            assert!(contrast(thicker * thickness) >= 0.98, "{name} at {thicker} x {thickness}");
        }
    }
}

#[test]
fn a_card_on_other_wavelengths_is_refused() {
    let library = library(vec![even("milk", 0.0, 2.0)], AmountKind::Relative);
    let viewing = Viewing::default();
    let short = Cards { white: vec![0.8; 30], ..Cards::standard(grid()) };
    let refused = Palette::new(&library, &viewing, short).unwrap_err();
    assert_eq!(refused, PaletteError::Cards { wanted: 31, found: 30 });
}

#[test]
fn the_white_of_a_library_hides_from_five_hundredths_of_a_millimetre_on() {
    let mut oils = calibrate::library::PigmentLibrary::van_gogh_oils();
    let per_mm = scattering_per_mm(&oils).unwrap();
    assert!((380.0..440.0).contains(&per_mm) && per_mm.fract() == 0.0, "{per_mm}");
    let white = oils.mix([(oils.reference_id().unwrap(), 1.0)]).unwrap();
    let cards = Cards::standard(oils.grid);
    let weights = Viewing::default().weights(oils.grid).unwrap();
    let [hiding, thinner] = [0.05, 0.04].map(|mm| {
        let [black, white] = [&cards.black, &cards.white]
            .map(|card| weights.xyz(&white.film(mm * per_mm, card, oils.film())).y);
        black / white
    });
    assert!((hiding - 0.98).abs() < 2e-4, "{hiding}");
    assert!(thinner < 0.975, "{thinner}");
    oils.reference = None;
    assert_eq!(scattering_per_mm(&oils), None);
}

fn strengths(
    pigments: Vec<Pigment>,
    amounts: AmountKind,
    standard: Option<PigmentId>,
) -> Vec<TintingStrength> {
    let library = library(pigments, amounts);
    let viewing = Viewing::default();
    let palette = Palette::new(&library, &viewing, Cards::standard(grid())).unwrap();
    tinting_strengths(&palette, standard)
}

fn four() -> Vec<Pigment> {
    vec![
        even("white", 0.0, 1.0),
        band("weak", 1.5, 520.0, 0.4),
        band("strong", 3.0, 520.0, 0.4),
        even("chalk", 0.0, 0.3),
    ]
}

#[test]
fn twice_the_absorption_is_twice_the_strength() {
    let mut pigments = four();
    pigments[2].absorption = pigments[1].absorption.iter().map(|k| 2.0 * k).collect();
    let found = strengths(pigments, AmountKind::Relative, None);
    assert_near("ratio", &[found[1].strength / found[0].strength], &[2.0], 1e-12);
    assert_near("percent", &[found[0].percent, found[1].percent], &[50.0, 100.0], 1e-9);
    assert_near("where", &[found[0].wavelength_nm], &[520.0], 1e-9);
}

#[test]
fn strength_is_k_over_s_of_one_part_in_nine_of_white_by_hand() {
    let found = strengths(four(), AmountKind::Relative, None);
    assert_near("K/S", &[found[1].strength], &[0.1 * 3.01 / (0.9 + 0.1 * 0.4)], 1e-12);
    // We subtract the K/S of the white itself.
    let mut grey = four();
    grey[0] = even("white", 0.2, 1.0);
    let found = strengths(grey, AmountKind::Relative, None);
    let tint = (0.9 * 0.2 + 0.1 * 3.01) / (0.9 + 0.1 * 0.4);
    assert_near("above white", &[found[1].strength], &[tint - 0.2], 1e-12);
}

#[test]
fn the_parts_of_white_make_the_depth_they_promise() {
    let oils = Oils::fitted();
    let palette = oils.palette();
    let mut deep = 0;
    for strength in tinting_strengths(&palette, None) {
        let Some(parts) = strength.white_parts else { continue };
        deep += 1;
        let mixture = palette.mixture(&palette.tint(strength.paint, parts));
        let nm = strength.wavelength_nm;
        let at = palette.library().grid.wavelengths_nm().position(|w| w == nm).unwrap();
        let depth = mixture.absorption[at] / mixture.scattering[at];
        assert_near(palette.label(strength.paint), &[depth], &[1.0], 1e-9);
    }
    assert!(deep >= 12, "{deep} paints of the oils are deeper than K/S = 1");
}

#[test]
fn a_paint_that_only_lightens_has_no_strength_and_no_such_tint() {
    let found = strengths(four(), AmountKind::Relative, None);
    assert_eq!(found.len(), 3, "the white is compared with itself");
    assert_eq!((found[2].strength, found[2].white_parts), (0.0, None));
}

#[test]
fn a_named_standard_is_the_whole() {
    let found = strengths(four(), AmountKind::Relative, Some(PigmentId(1)));
    assert_near("standard", &[found[0].percent], &[100.0], 1e-9);
    assert!(found[1].percent > 190.0, "{found:?}");
}

#[test]
fn without_a_white_paint_strength_is_absorption_per_amount() {
    let found = strengths(four(), AmountKind::Absolute, None);
    assert_near("K", &[found[1].strength, found[2].strength], &[1.51, 3.01], 1e-12);
    assert!(found.iter().all(|s| s.white_parts.is_none()));
}
