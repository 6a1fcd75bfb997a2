//! Mixing charts, tints and drawdowns.

use calibrate::PigmentId;
use calibrate::evaluate::Viewing;
use calibrate::library::AmountKind;
use calibrate::palette::{
    Cards, Palette, PaletteError, TINTS, drawdowns, mixing_chart, tint_ladders,
};
use documents::hint::Explain;
use spectra::color::delta_e_ciede2000;

use crate::made::{Oils, even, five, grid, library, recipe};

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
    assert_eq!(refused, PaletteError::NothingToMix { pigments: 5 });
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
        let off = |a, b| delta_e_ciede2000(a, b);
        assert!(off(bare.over_black.lab, cards[0].lab) < 1e-6, "{name}");
        assert!(off(bare.over_white.lab, cards[1].lab) < 1e-6, "{name}");
        assert!(off(masstone.over_white.lab, drawdown.masstone.lab) < 1e-3, "{name}");
        assert!(off(masstone.over_black.lab, drawdown.masstone.lab) < 1e-3, "{name}");
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
