//! Colour shifts and metamers under other lights.

use calibrate::evaluate::Viewing;
use calibrate::library::AmountKind;
use calibrate::palette::{Cards, Palette, color_shifts, metamers, test_lights};
use calibrate::{PigmentId, Recipe};
use spectra::Illuminant;
use spectra::color::{delta_e_ciede2000, metamerism_index};
use suite::near::assert_near;

use crate::made::{Oils, band, even, five, grid, library};

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
        let paints = |i: usize| -> std::collections::BTreeSet<PigmentId> {
            pair.recipes[i].iter().map(|(p, _)| *p).collect()
        };
        assert_ne!(paints(0), paints(1), "{:?}", pair.names);
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
        // Two mixtures that differ a little in shares also differ a little under other lights.
        assert!(worst < 1.0, "{:?}: {worst}", pair.names);
    }
}
