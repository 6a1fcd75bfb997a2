//! Tinting strength: closed forms, the tint of standard depth, and a standard paint.

use calibrate::PigmentId;
use calibrate::evaluate::Viewing;
use calibrate::library::{AmountKind, Pigment};
use calibrate::palette::{Cards, Palette, TintingStrength, tinting_strengths};
use suite::near::assert_near;

use crate::made::{Oils, band, even, grid, library};

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
    // The K/S of the white itself is subtracted.
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
    let mut told = 0;
    for strength in tinting_strengths(&palette, None) {
        let Some(parts) = strength.white_parts else { continue };
        told += 1;
        let mixture = palette.mixture(&palette.tint(strength.paint, parts));
        let nm = strength.wavelength_nm;
        let at = palette.library().grid.wavelengths_nm().position(|w| w == nm).unwrap();
        let depth = mixture.absorption[at] / mixture.scattering[at];
        assert_near(palette.label(strength.paint), &[depth], &[1.0], 1e-9);
    }
    assert!(told >= 12, "{told} paints of the oils are deeper than K/S = 1");
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
