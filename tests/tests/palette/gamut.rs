//! Gamut of a palette: sampled mixtures, outline, spectral locus and sRGB primaries, and colour
//! shifts and metamers under other lights.

use std::collections::{BTreeMap, BTreeSet};

use calibrate::PigmentId;
use calibrate::evaluate::Viewing;
use calibrate::library::AmountKind;
use calibrate::palette::{
    Cards, GamutSample, Palette, Recipe, color_shifts, metamers, sampled_gamut, spectral_locus,
    srgb_primaries, test_lights,
};
use spectra::Illuminant;
use spectra::color::{delta_e_ciede2000, metamerism_index};
use suite::golden::assert_near;

use crate::made::{Oils, band, even, five, grid, library};

#[test]
fn the_outline_reaches_every_masstone_and_every_pair() {
    let oils = Oils::fitted();
    let palette = oils.palette();
    let gamut = sampled_gamut(&palette);
    let outline = gamut.in_lab([0.0, 100.0], 72);
    let masstones = palette.paints().iter().map(|&p| Recipe::single(p));
    let pairs = palette.pairs().map(|(a, b)| Recipe::from([(a, 0.5), (b, 0.5)]));
    for recipe in masstones.chain(pairs) {
        let lab = palette.color(&recipe).lab;
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
    assert_eq!(last.color, palette.color(&last.recipe));
}

#[test]
fn a_band_of_lightness_lies_within_the_whole() {
    let oils = Oils::fitted();
    let gamut = sampled_gamut(&oils.palette());
    let whole = gamut.in_lab([0.0, 100.0], 72);
    for low in [20.0, 40.0, 60.0, 80.0] {
        let band = gamut.in_lab([low, low + 20.0], 72);
        for (place, index) in band.sectors.iter().flatten() {
            let lightness = gamut.samples[*index].color.lab.lightness;
            assert!((low..=low + 20.0).contains(&lightness), "{lightness} in the band from {low}");
            assert!(whole.reaches(*place), "{place:?} lies outside the whole");
        }
        assert!(band.area() < whole.area(), "from {low}: {} of {}", band.area(), whole.area());
    }
}

#[test]
fn more_paints_mix_more_colors() {
    let viewing = Viewing::default();
    let areas = [1, 2, 3, 4].map(|count| {
        let mut library = five();
        library.pigments.truncate(count);
        let palette = Palette::new(&library, &viewing, Cards::standard(grid())).unwrap();
        sampled_gamut(&palette).in_lab([0.0, 100.0], 72).area()
    });
    assert!(areas[0] < 1.0, "a white alone: {}", areas[0]);
    assert!(areas[1..].is_sorted_by(|a, b| a < b), "{areas:?}");
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
    // CIE 015:2018, chromaticities of the 1931 observer.
    for (nm, wanted) in [(520.0, [0.0743, 0.8338]), (700.0, [0.7347, 0.2653])] {
        let found = locus.iter().find(|(own, _)| *own == nm).unwrap().1;
        assert_near(format!("{nm} nm"), &found, &wanted, 1e-4);
    }
    let oils = Oils::fitted();
    let palette = oils.palette();
    let [red, green, blue] = srgb_primaries(palette.weights().white());
    for (name, found, wanted) in
        [("red", red, [0.64, 0.33]), ("green", green, [0.3, 0.6]), ("blue", blue, [0.15, 0.06])]
    {
        // The white computed from D65 is not exactly the rounded white of the standard.
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

/// Whether a chromaticity is inside the spectral locus and the purple line that closes it.
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

/// Cell of a colour in the grid that is searched for gaps: 10 in L*, 3 in a* and b*.
fn cell(sample: &GamutSample) -> [i32; 3] {
    let lab = sample.color.lab;
    [lab.lightness / 10.0, lab.a / 3.0, lab.b / 3.0].map(|side| side.floor() as i32)
}

/// The mixture of two recipes in equal parts, as the share of each paint in units of 1e-9.
fn halves(first: &Recipe, second: &Recipe) -> BTreeMap<PigmentId, i64> {
    let mut shares: BTreeMap<PigmentId, f64> = BTreeMap::new();
    for &(paint, share) in first.iter().chain(second) {
        *shares.entry(paint).or_default() += share / 2.0;
    }
    shares.into_iter().map(|(paint, share)| (paint, (1e9 * share).round() as i64)).collect()
}

#[test]
fn a_gap_between_two_samples_is_filled_or_was_tried() {
    let five = five();
    let viewing = Viewing::default();
    let palette = Palette::new(&five, &viewing, Cards::standard(grid())).unwrap();
    let samples = sampled_gamut(&palette).samples;
    let mut first: BTreeMap<[i32; 3], usize> = BTreeMap::new();
    for (at, sample) in samples.iter().enumerate() {
        first.entry(cell(sample)).or_insert(at);
    }
    // All pairs of occupied cells with one cell between them: this cell, the later of the two
    // samples, and their mixture in equal parts.
    let mut pairs = Vec::new();
    for (&[band, a, b], &one) in &first {
        for (da, db) in [(1, 0), (0, 1), (1, 1), (1, -1)] {
            if let Some(&other) = first.get(&[band, a + 2 * da, b + 2 * db]) {
                let mixed = halves(&samples[one].recipe, &samples[other].recipe);
                pairs.push(([band, a + da, b + db], one.max(other), mixed));
            }
        }
    }
    let made: BTreeSet<_> = pairs.iter().map(|(_, _, mixed)| mixed).collect();
    let recipe = |at: usize| halves(&samples[at].recipe, &samples[at].recipe);
    // The mixtures that fill gaps are at the end of the list, from index `own` on.
    let own = (0..samples.len()).rev().find(|&at| !made.contains(&recipe(at))).unwrap() + 1;
    let tried: BTreeSet<_> = (own..samples.len()).map(recipe).collect();
    assert!(tried.len() > 300, "{} of {} fill gaps", tried.len(), samples.len());
    let mut filled = 0;
    for (gap, later, mixed) in pairs.iter().filter(|(_, later, _)| *later < own) {
        let by = first.get(gap);
        filled += usize::from(by.is_some_and(|&at| at >= own));
        assert!(by.is_some() || tried.contains(mixed), "{gap:?} is empty, with {later} beside it");
    }
    assert!(filled > 100, "{filled} gaps between samples were filled");
}

#[test]
fn no_mixture_holds_a_pigment_that_is_not_identified() {
    let mut five = five();
    five.pigments[1].identified = false;
    let viewing = Viewing::default();
    let palette = Palette::new(&five, &viewing, Cards::standard(grid())).unwrap();
    let samples = sampled_gamut(&palette).samples;
    for sample in &samples {
        let total: f64 = sample.recipe.iter().map(|(_, share)| share).sum();
        assert!((total - 1.0).abs() < 1e-9, "{:?}", sample.recipe);
        assert!(
            sample.recipe.iter().all(|(paint, _)| *paint != PigmentId(1)),
            "{:?}",
            sample.recipe
        );
    }
}

#[test]
fn a_grey_keeps_its_color_and_a_band_does_not() {
    let five = five();
    let viewing = Viewing::default();
    let palette = Palette::new(&five, &viewing, Cards::standard(grid())).unwrap();
    let lights = test_lights(&palette);
    let names: Vec<&str> = lights.iter().map(|light| light.name.as_str()).collect();
    assert_eq!(names, ["D65", "A", "FL11"]);
    let recipes: Vec<_> = [4, 3].map(|paint| Recipe::single(PigmentId(paint))).into();
    let shifts = color_shifts(&palette, &lights, &recipes);
    assert_near("black", &shifts[0].shifts, &[0.0, 0.0, 0.0], 1e-6);
    assert_eq!(shifts[1].shifts[0], 0.0);
    assert!(shifts[1].shifts[1] > 2.0, "blue in lamplight: {:?}", shifts[1].shifts);
    assert_eq!(shifts[1].colors[0], palette.color(&Recipe::single(PigmentId(3))));
}

#[test]
fn the_palettes_own_light_comes_first() {
    let five = five();
    let illuminant = Illuminant::named("A").unwrap();
    let viewing = Viewing { illuminant, ..Viewing::default() };
    let palette = Palette::new(&five, &viewing, Cards::standard(grid())).unwrap();
    let lights = test_lights(&palette);
    let names: Vec<&str> = lights.iter().map(|light| light.name.as_str()).collect();
    assert_eq!(names, ["A", "D65", "FL11"]);
}

#[test]
fn metamers_match_in_daylight_and_part_worst_first() {
    let oils = Oils::fitted();
    let palette = oils.palette();
    let lights = test_lights(&palette);
    let measured = oils.measured(&palette);
    let found = metamers(&palette, &lights, &measured, 2.0, 8);
    assert_eq!(found.len(), 8);
    let mut before = f64::INFINITY;
    for pair in &found {
        let [first, second] = pair.colors[0];
        let apart = delta_e_ciede2000(first.lab, second.lab);
        assert_near("difference", &[pair.differences[0]], &[apart], 0.0);
        assert!(apart <= 2.0, "{:?}: {apart}", pair.names);
        assert_near("index under the first light", &[pair.indices[0]], &[0.0], 1e-9);
        for (at, light) in lights.iter().enumerate().skip(1) {
            let [standard, sample] = [0, 1].map(|i| [0, at].map(|at| pair.colors[at][i].xyz));
            let wanted = metamerism_index(standard, sample, light.weights.white()).unwrap();
            assert_near("index", &[pair.indices[at]], &[wanted], 1e-12);
        }
        let worst = pair.indices.iter().copied().fold(0.0, f64::max);
        assert!(worst <= before && worst > 2.0, "{worst} after {before}");
        before = worst;
        let [one, other] = [0, 1].map(|i: usize| -> BTreeSet<PigmentId> {
            pair.recipes[i].iter().map(|(p, _)| *p).collect()
        });
        assert_ne!(one, other, "{:?}", pair.names);
    }
    assert_eq!(found, metamers(&palette, &lights, &measured, 2.0, 8));
}

#[test]
fn no_color_is_told_twice() {
    let oils = Oils::fitted();
    let palette = oils.palette();
    let lights = test_lights(&palette);
    let found = metamers(&palette, &lights, &oils.measured(&palette), 2.0, 20);
    let mut names: Vec<&String> = found.iter().flat_map(|pair| &pair.names).collect();
    let count = names.len();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), count);
}

#[test]
fn the_same_paint_under_two_names_is_no_metamer() {
    let pigments = vec![
        even("white", 0.001, 1.0),
        band("blue", 3.0, 610.0, 0.2),
        band("blue of another maker", 3.0, 610.0, 0.2),
    ];
    let library = library(pigments, AmountKind::Relative);
    let viewing = Viewing::default();
    let palette = Palette::new(&library, &viewing, Cards::standard(grid())).unwrap();
    let found = metamers(&palette, &test_lights(&palette), &[], 0.5, 50);
    assert!(!found.is_empty(), "the two blues match under every light");
    for pair in found {
        let worst = pair.indices.iter().copied().fold(0.0, f64::max);
        // If two mixtures differ a little in shares, they also differ a little under other lights.
        assert!(worst < 1.0, "{:?}: {worst}", pair.names);
    }
}
