//! Mixing charts, tints, drawdowns, and graded mixtures from one paint to another with their
//! errors. Palettes of absolute amounts: washes over the white card, which replaces a white paint.

use calibrate::evaluate::Viewing;
use calibrate::library::{AmountKind, PigmentLibrary};
use calibrate::palette::{
    Cards, MixingRow, PainterRules, Palette, PaletteError, TINTS, default_pairs, drawdowns, graded,
    hiding_powers, mixing_chart, sampled_gamut, tint_ladders,
};
use calibrate::{PigmentId, Recipe};
use documents::hint::Explain;
use spectra::color::delta_e_ciede2000;
use suite::golden::assert_near;

use crate::made::{Oils, band, even, five, grid, library, recipe};

#[test]
fn a_chart_holds_masstones_and_every_pair_both_ways() {
    let oils = Oils::fitted();
    let palette = oils.palette();
    let chart = mixing_chart(&palette);
    assert_eq!(chart.paints.len(), 18);
    for (row, &first) in chart.paints.iter().enumerate() {
        for (column, &second) in chart.paints.iter().enumerate() {
            let mixture = oils.library.mix([(first, 1.0), (second, 1.0)]).unwrap();
            let wanted = palette.appearance(&mixture.hiding(oils.library.saunderson));
            let off = delta_e_ciede2000(chart.colors[row][column].lab, wanted.lab);
            assert!(off < 1e-9, "{first:?} with {second:?}: {off}");
            let pale = [(first, 1.0), (second, 1.0), (palette.white().unwrap(), 6.0)];
            let mixture = oils.library.mix(pale).unwrap();
            let wanted = palette.appearance(&mixture.hiding(oils.library.saunderson));
            let off = delta_e_ciede2000(chart.tinted[row][column].lab, wanted.lab);
            assert!(off < 1e-9, "{first:?} with {second:?}, tinted: {off}");
            assert_eq!(chart.colors[row][column], chart.colors[column][row]);
        }
    }
}

#[test]
fn pigments_that_cannot_be_mixed_are_left_out_and_guessed_ones_marked() {
    let mut five = five();
    five.pigments[2].identified = false;
    five.pigments[3].guessed = true;
    let viewing = Viewing::default();
    let palette = Palette::new(&five, &viewing, Cards::standard(grid())).unwrap();
    assert_eq!(
        (palette.paints(), palette.left_out()),
        (&[0, 1, 3, 4].map(PigmentId)[..], vec![PigmentId(2)])
    );
    assert_eq!(mixing_chart(&palette).paints, palette.paints());
    assert_eq!(palette.label(PigmentId(3)), "blue (guessed)");
    assert_eq!(
        palette.recipe_label(&recipe([(0, 0.75), (3, 0.25)])),
        "75 % white + 25 % blue (guessed)"
    );
    five.pigments.iter_mut().for_each(|pigment| pigment.identified = false);
    let refused = Palette::new(&five, &viewing, Cards::standard(grid())).unwrap_err();
    assert_eq!(refused, PaletteError::NothingToMix(5));
    assert!(refused.hint().unwrap().to_string().contains("mixtures"));
}

#[test]
fn tints_pale_towards_the_white() {
    let oils = Oils::fitted();
    let palette = oils.palette();
    let white = palette.white().unwrap();
    assert_eq!(oils.library[white].name, "Zinc White");
    let ladders = tint_ladders(&palette);
    assert_eq!(ladders.len(), 17);
    for ladder in ladders {
        for (&parts, color) in TINTS.iter().zip(&ladder.colors) {
            let mixture = oils.library.mix([(ladder.paint, 1.0), (white, parts)]).unwrap();
            let wanted = palette.appearance(&mixture.hiding(oils.library.saunderson));
            assert!(delta_e_ciede2000(color.lab, wanted.lab) < 1e-9, "{:?}", ladder.paint);
        }
    }
}

#[test]
fn a_white_tinted_with_itself_is_itself() {
    let viewing = Viewing::default();
    let five = five();
    let palette = Palette::new(&five, &viewing, Cards::standard(grid())).unwrap();
    assert_eq!(palette.tint(PigmentId(0), 3.0), recipe([(0, 1.0)]));
    assert_eq!(palette.thinned(&recipe([(0, 0.5), (1, 0.5)]), 1.0), recipe([(0, 0.75), (1, 0.25)]));
}

#[test]
fn no_film_is_the_card_and_a_thick_one_the_masstone() {
    let oils = Oils::fitted();
    let palette = oils.palette();
    let cards = [&palette.cards().black, &palette.cards().white].map(|c| palette.appearance(c));
    for drawdown in drawdowns(&palette, &[0.0, 1.0, 10.0, 1e4]) {
        let name = palette.label(drawdown.paint);
        let [bare, thin, thick, masstone] = drawdown.steps.as_slice() else { panic!("four steps") };
        for (step, wanted, most) in [
            (bare.over_black.lab, cards[0].lab, 1e-6),
            (bare.over_white.lab, cards[1].lab, 1e-6),
            (masstone.over_white.lab, drawdown.masstone.lab, 1e-3),
            (masstone.over_black.lab, drawdown.masstone.lab, 1e-3),
        ] {
            assert!(delta_e_ciede2000(step, wanted) < most, "{name}");
        }
        for step in [thin, thick] {
            let gap = step.over_white.xyz.y - step.over_black.xyz.y;
            assert!(gap >= 0.0, "{name}: the black card looks lighter by {gap}");
        }
    }
}

#[test]
fn the_lightest_paint_is_the_white_of_a_library_that_names_none() {
    let pigments = vec![even("grey", 0.5, 1.0), even("pale", 0.01, 0.5), even("dark", 4.0, 0.1)];
    let mut library = library(pigments, AmountKind::Relative);
    library.reference = None;
    let viewing = Viewing::default();
    let palette = Palette::new(&library, &viewing, Cards::standard(grid())).unwrap();
    assert_eq!((palette.white(), palette.black()), (Some(PigmentId(1)), PigmentId(2)));
}

#[test]
fn the_ends_are_the_masstones_in_every_row_that_keeps_the_spectrum() {
    let oils = Oils::fitted();
    let palette = oils.palette();
    let rules = PainterRules::of(&palette).unwrap();
    let pair = (find(&oils, "Chrome Yellow"), find(&oils, "Cobalt Blue"));
    let mixture = graded(&palette, pair, &[], &rules);
    assert_eq!(mixture.steps.len(), 11);
    for (step, paint) in [(&mixture.steps[0], pair.0), (&mixture.steps[10], pair.1)] {
        let masstone = palette.color(&Recipe::single(paint));
        for row in [MixingRow::Spectrum, MixingRow::LinearRgb] {
            let color = step.colors[row as usize].unwrap();
            let off = delta_e_ciede2000(color.lab, masstone.lab);
            assert!(off < 1e-9, "{} of {paint:?}: {off}", row.name());
        }
        let eight = step.colors[MixingRow::EightNodes as usize].unwrap();
        assert!(delta_e_ciede2000(eight.lab, masstone.lab) < 1.0, "{paint:?} at 8 wavelengths");
    }
}

#[test]
fn the_middle_of_linear_rgb_is_the_mean_of_linear_rgb() {
    let oils = Oils::fitted();
    let palette = oils.palette();
    let rules = PainterRules::of(&palette).unwrap();
    let pair = (find(&oils, "Chrome Yellow"), find(&oils, "Ultramarine"));
    let steps = graded(&palette, pair, &[], &rules).steps;
    let [first, middle, last] = [0, 5, 10]
        .map(|at: usize| steps[at].colors[MixingRow::LinearRgb as usize].unwrap().srgb.linear().0);
    let mean: Vec<f64> = first.iter().zip(last).map(|(a, b)| f64::midpoint(*a, b)).collect();
    assert_near("middle", &middle, &mean, 1e-9);
}

#[test]
fn a_measured_share_stands_in_its_place_with_the_mixture_of_that_share() {
    let oils = Oils::fitted();
    let palette = oils.palette();
    let rules = PainterRules::of(&palette).unwrap();
    let measured = oils.measured(&palette);
    let pair = (find(&oils, "Prussian Blue"), find(&oils, "Zinc White"));
    let steps = graded(&palette, pair, &measured, &rules).steps;
    let reported: Vec<(&str, f64)> =
        steps.iter().filter_map(|s| Some((s.sample.as_deref()?, s.share))).collect();
    let names: Vec<&str> = reported.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["13A", "13F", "13C", "13B", "13G", "07A"]);
    assert_near(
        "shares",
        &reported.iter().map(|t| t.1).collect::<Vec<_>>(),
        &[0.0, 0.01, 0.493, 0.937, 0.989, 1.0],
        1e-9,
    );
    assert!(steps[0].share.is_sign_positive(), "a share of -0");
    // 13F and 13G are far from any tenth, so they come in addition to the eleven tenths.
    assert_eq!(steps.len(), 13);
    assert!(steps.windows(2).all(|pair| pair[0].share < pair[1].share));
    let half = steps.iter().find(|s| s.sample.as_deref() == Some("13C")).unwrap();
    let mixture = oils.library.mix([(pair.0, 50.7), (pair.1, 49.3)]).unwrap();
    let wanted = palette.appearance(&mixture.hiding(oils.library.saunderson));
    let spectrum = half.colors[MixingRow::Spectrum as usize].unwrap();
    assert!(delta_e_ciede2000(spectrum.lab, wanted.lab) < 1e-9);
    let sample = measured.iter().find(|m| m.sample == "13C").unwrap();
    let read = palette.appearance(&sample.reflectance);
    assert_eq!(half.colors[MixingRow::Measured as usize], Some(read));
    let off = delta_e_ciede2000(read.lab, spectrum.lab);
    assert_eq!(half.errors[MixingRow::Spectrum as usize], Some(off));
    assert_eq!(half.errors[MixingRow::Measured as usize], None);
}

#[test]
fn without_a_measurement_errors_are_from_the_full_spectrum() {
    let oils = Oils::fitted();
    let palette = oils.palette();
    let rules = PainterRules::of(&palette).unwrap();
    let pair = (find(&oils, "Chrome Yellow"), find(&oils, "Cobalt Blue"));
    let mixture = graded(&palette, pair, &oils.measured(&palette), &rules);
    let middle = &mixture.steps[5];
    assert_eq!((middle.sample.as_deref(), middle.colors[0]), (None, None));
    let [_, spectrum, _, _, linear] = middle.colors;
    let off = delta_e_ciede2000(spectrum.unwrap().lab, linear.unwrap().lab);
    assert_eq!(middle.errors[MixingRow::LinearRgb as usize], Some(off));
    assert_eq!(middle.errors[MixingRow::Spectrum as usize], None);
    // Yellow and blue mix to a green far from the straight line between them in linear RGB.
    assert!(off > 10.0, "{off}");
    let rows = [MixingRow::EightNodes, MixingRow::ThreeNodes, MixingRow::LinearRgb];
    let [eight, three, linear] = rows.map(|row| mixture.mean_error(row, false).unwrap());
    assert_eq!(linear.1, 9);
    assert!(eight.0 < three.0);
    assert!(three.0 < linear.0);
    assert_eq!(mixture.mean_error(MixingRow::LinearRgb, true), None);
}

#[test]
fn the_pairs_of_most_steps_come_first_then_a_yellow_and_a_blue() {
    let oils = Oils::fitted();
    let palette = oils.palette();
    let pairs = default_pairs(&palette, &oils.measured(&palette));
    let names: Vec<[String; 2]> =
        pairs.iter().map(|p| [p.0, p.1].map(|i| palette.label(i))).collect();
    assert_eq!(names[0], ["Bone Black", "Zinc White"]);
    assert_eq!(names[1], ["Prussian Blue", "Zinc White"]);
    assert_eq!(names.len(), 3);
    assert!(names[2][0].starts_with("Chrome Yellow"), "{names:?}");
    assert!(["Cobalt Blue", "Ultramarine"].contains(&names[2][1].as_str()), "{names:?}");
}

fn find(oils: &Oils, name: &str) -> PigmentId {
    oils.library.find(name).unwrap()
}

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
    // Without scattering, a wash attenuates the card by exp(-2 K d) = 1/10 where it absorbs most.
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
    // There the luminance over black is 0.98 times the luminance over white.
    let mixture = library.mix(recipe([(1, 1.0)])).unwrap();
    let weights = viewing.weights(grid()).unwrap();
    let [black, white] = [&palette.cards().black, &palette.cards().white]
        .map(|card| weights.xyz(&mixture.film(yellow, card, library.film())).y);
    let contrast = black / white;
    assert_near("contrast", &[contrast], &[0.98], 1e-6);
    let gamut = sampled_gamut(&palette);
    let most = gamut.samples.iter().map(|s| s.recipe.iter().map(|(_, share)| share).sum::<f64>());
    let deepest = most.fold(0.0, f64::max);
    assert!((deepest - 8.0).abs() < 1e-9, "the largest sum of washes is {deepest}");
    assert!(gamut.samples.iter().all(|s| s.color.lab.a.is_finite()));
}
