//! Graded mixtures from one paint to another: steps, rows of prediction and their errors.

use calibrate::palette::{MixingRow, PainterRules, default_pairs, graded};
use calibrate::{PigmentId, Recipe};
use spectra::color::delta_e_ciede2000;
use suite::near::assert_near;

use crate::made::Oils;

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
    let linear =
        |at: usize| steps[at].colors[MixingRow::LinearRgb as usize].unwrap().srgb.linear().0;
    let first = linear(0);
    let middle = linear(5);
    let last = linear(10);
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
    let told: Vec<(&str, f64)> =
        steps.iter().filter_map(|s| Some((s.sample.as_deref()?, s.share))).collect();
    let names: Vec<&str> = told.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["13A", "13F", "13C", "13B", "13G", "07A"]);
    assert_near(
        "shares",
        &told.iter().map(|t| t.1).collect::<Vec<_>>(),
        &[0.0, 0.01, 0.493, 0.937, 0.989, 1.0],
        1e-9,
    );
    assert!(steps[0].share.is_sign_positive(), "a share of -0");
    // 13F and 13G are far from any tenth, so they are steps besides the eleven tenths.
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
    let mean = |row| mixture.mean_error(row, false).unwrap();
    assert_eq!(mean(MixingRow::LinearRgb).1, 9);
    assert!(mean(MixingRow::EightNodes).0 < mean(MixingRow::ThreeNodes).0);
    assert!(mean(MixingRow::ThreeNodes).0 < mean(MixingRow::LinearRgb).0);
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
