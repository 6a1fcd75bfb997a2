//! What a palette can mix.

use calibrate::evaluate::Viewing;
use calibrate::library::AmountKind;
use calibrate::palette::{Cards, Palette, sampled_gamut, spectral_locus, srgb_primaries};
use suite::near::assert_near;

use crate::made::{Oils, band, even, five, grid, library};

#[test]
fn the_outline_reaches_every_masstone_and_every_pair() {
    let oils = Oils::fitted();
    let palette = oils.palette();
    let gamut = sampled_gamut(&palette);
    let outline = gamut.in_lab([0.0, 100.0], 72);
    let masstones = palette.paints().iter().map(|&p| vec![(p, 1.0)]);
    let pairs = palette.pairs().map(|(a, b)| vec![(a, 0.5), (b, 0.5)]);
    for recipe in masstones.chain(pairs) {
        let lab = palette.look(&recipe).lab;
        assert!(outline.reaches([lab.a, lab.b]), "{} is outside", palette.recipe_label(&recipe));
    }
}

#[test]
fn every_sample_is_a_mixture_of_the_palette() {
    let oils = Oils::fitted();
    let palette = oils.palette();
    let gamut = sampled_gamut(&palette);
    assert!(gamut.samples.len() > 10_000, "{}", gamut.samples.len());
    for sample in &gamut.samples {
        let total: f64 = sample.recipe.iter().map(|(_, share)| share).sum();
        assert!((total - 1.0).abs() < 1e-9, "{:?}", sample.recipe);
        assert!(sample.recipe.iter().all(|(p, s)| palette.paints().contains(p) && *s >= 0.0));
    }
    let last = gamut.samples.last().unwrap();
    assert_eq!(last.colour, palette.look(&last.recipe));
}

#[test]
fn a_band_of_lightness_lies_within_the_whole() {
    let oils = Oils::fitted();
    let gamut = sampled_gamut(&oils.palette());
    let whole = gamut.in_lab([0.0, 100.0], 72);
    for low in [20.0, 40.0, 60.0, 80.0] {
        let band = gamut.in_lab([low, low + 20.0], 72);
        for (place, index) in band.sectors.iter().flatten() {
            let lightness = gamut.samples[*index].colour.lab.lightness;
            assert!((low..=low + 20.0).contains(&lightness), "{lightness} in the band from {low}");
            assert!(whole.reaches(*place), "{place:?} lies outside the whole");
        }
        assert!(band.area() < whole.area(), "from {low}: {} of {}", band.area(), whole.area());
    }
}

#[test]
fn more_paints_mix_more_colours() {
    let viewing = Viewing::default();
    let area = |count: usize| {
        let mut library = five();
        library.pigments.truncate(count);
        let palette = Palette::new(&library, &viewing, Cards::standard(grid())).unwrap();
        sampled_gamut(&palette).in_lab([0.0, 100.0], 72).area()
    };
    assert!(area(1) < 1.0, "a white alone: {}", area(1));
    assert!(area(2) < area(3) && area(3) < area(4), "{} {} {}", area(2), area(3), area(4));
}

#[test]
fn where_nothing_is_mixed_the_outline_returns_to_grey() {
    let pigments = vec![even("white", 0.001, 1.0), band("yellow", 2.0, 430.0, 0.6)];
    let library = library(pigments, AmountKind::Relative);
    let viewing = Viewing::default();
    let palette = Palette::new(&library, &viewing, Cards::standard(grid())).unwrap();
    let outline = sampled_gamut(&palette).in_lab([0.0, 100.0], 72);
    assert!(outline.polygon().contains(&[0.0, 0.0]), "{:?}", outline.polygon());
    assert!(!outline.reaches([0.0, -20.0]), "a yellow and a white mix no blue");
}

#[test]
fn the_locus_and_srgb_stand_where_the_standards_put_them() {
    let locus = spectral_locus(&Viewing::default());
    let at = |wanted: f64| locus.iter().find(|(nm, _)| *nm == wanted).unwrap().1;
    // CIE 015:2018, chromaticities of the 1931 observer.
    assert_near("520 nm", &at(520.0), &[0.0743, 0.8338], 1e-4);
    assert_near("700 nm", &at(700.0), &[0.7347, 0.2653], 1e-4);
    let oils = Oils::fitted();
    let palette = oils.palette();
    let [red, green, blue] = srgb_primaries(palette.weights().white());
    for (name, found, wanted) in
        [("red", red, [0.64, 0.33]), ("green", green, [0.3, 0.6]), ("blue", blue, [0.15, 0.06])]
    {
        // The white computed from D65 is not the rounded one of the standard.
        assert_near(name, &found, &wanted, 3e-4);
    }
    let outline = sampled_gamut(&palette).in_xy(72);
    for (place, _) in outline.sectors.iter().flatten() {
        assert!(inside(*place, &locus), "{place:?} lies outside the spectral locus");
    }
}

#[test]
fn the_same_palette_gives_the_same_gamut() {
    let oils = Oils::fitted();
    assert_eq!(sampled_gamut(&oils.palette()), sampled_gamut(&oils.palette()));
}

/// Whether a chromaticity lies within the horseshoe, closed by the purple line.
fn inside(place: [f64; 2], locus: &[(f64, [f64; 2])]) -> bool {
    let mut within = false;
    for (at, (_, a)) in locus.iter().enumerate() {
        let b = locus[(at + 1) % locus.len()].1;
        if (a[1] > place[1]) != (b[1] > place[1])
            && place[0] < (b[0] - a[0]) * (place[1] - a[1]) / (b[1] - a[1]) + a[0]
        {
            within = !within;
        }
    }
    within
}
