//! A study of mixtures. You see yellow and Prussian blue that mix wet to green, scales of tints, a
//! brush that we do not wash, patches mixed by knife, and a line by each head shape.

use paint::brush::HeadShape;
use paint::document::{Lighting, Medium};
use paint::ground::{GroundRelief, Linen};
use paint::strokes::{Canvas, StrokeScript};

use super::script_builder::ScriptBuilder;

pub(crate) fn script() -> StrokeScript {
    let linen =
        Linen { seed: 3, threads_per_cm: 16.0, relief_mm: 0.06, unevenness: Linen::UNEVENNESS };
    let ground = GroundRelief::Linen(linen).into();
    let canvas = Canvas { width_mm: 150.0, height_mm: 100.0, cell_mm: 0.2, ground };
    let pigments = [
        ("W", "Lead White"),
        ("Y", "Chrome Yellow"),
        ("P", "Prussian Blue"),
        ("R", "Vermilion"),
        ("U", "Ultramarine"),
        ("L", "Eosin Lake"),
        ("V", "Viridian"),
        ("K", "Bone Black"),
    ];
    let mut script = ScriptBuilder::new("A study of mixtures", canvas, &pigments, 2);
    script.built.lighting = Some(Lighting { relief: 2.0, ..Lighting::default() });
    script.built.medium = Some(Medium { scattering_per_mm: 120.0, ..Medium::default() });
    for (name, shape, size_mm) in [
        ("flat", HeadShape::Flat, 11.0),
        ("bright", HeadShape::Bright, 9.0),
        ("filbert", HeadShape::Filbert, 8.0),
        ("round", HeadShape::Round, 5.0),
        ("fan", HeadShape::Fan, 14.0),
        ("mop", HeadShape::Mop, 8.0),
        ("rigger", HeadShape::Rigger, 1.2),
        ("knife", HeadShape::Knife, 14.0),
    ] {
        script.brush(name, shape, size_mm);
    }
    through_green(&mut script);
    tints(&mut script);
    unwashed(&mut script);
    knifed(&mut script);
    shapes(&mut script);
    script.built
}

/// Yellow on the left and blue on the right, then strokes of the blue brush into the yellow.
fn through_green(script: &mut ScriptBuilder) {
    script.fresh("flat", "Y1", 0.0, 1.0);
    for y in [9.0, 16.0, 10.3, 17.3] {
        script.even("flat", &[(8.0, y), (80.0, y)], 0.5);
    }
    script.fresh("flat", "P1W3", 0.0, 0.8);
    for y in [9.0, 16.0, 10.3, 17.3] {
        script.even("flat", &[(142.0, y), (84.0, y)], 0.5);
    }
    // The brush still has blue: each pull carries it farther into the yellow.
    for reach in [62.0, 48.0, 34.0] {
        script.stroke("flat", &[(92.0, 9.5), (reach, 9.0)], 0.55);
        script.stroke("flat", &[(92.0, 16.0), (reach + 4.0, 16.0)], 0.55);
    }
}

/// Tints of ultramarine and of eosin lake, with white increasing from left to right.
fn tints(script: &mut ScriptBuilder) {
    for (y, name) in [(29.0, "U"), (39.0, "L")] {
        for (step, white) in [0, 2, 5, 12, 30, 80].into_iter().enumerate() {
            script.wash("filbert");
            script.load("filbert", &format!("{name}1W{white}"), 0.0, 0.8);
            let x = 9.0 + 12.0 * step as f64;
            for pass in 0..4 {
                let y = y + 1.2 * f64::from(pass % 2);
                script.even("filbert", &[(x, y), (x + 8.0, y)], 0.6);
            }
        }
    }
}

/// One load of vermilion, painted in three strokes across white, yellow, blue and white.
fn unwashed(script: &mut ScriptBuilder) {
    for (number, recipe) in ["W1", "Y1", "U1W2", "W1"].into_iter().enumerate() {
        script.wash("bright");
        script.load("bright", recipe, 0.0, 1.0);
        let x = 94.0 + 13.0 * number as f64;
        for pass in 0..6 {
            let x = x + 1.5 * f64::from(pass % 3);
            script.even("bright", &[(x, 26.0), (x + 0.5, 44.0)], 0.65);
        }
    }
    script.wash("round");
    script.load("round", "R1", 0.0, 0.8);
    for y in [29.5, 35.0, 40.5] {
        script.stroke("round", &[(86.0, y), (112.0, y - 0.8), (144.0, y)], 0.7);
    }
}

/// Short strokes of white, yellow, pink and pale blue, spread by a clean knife: two pulls on the
/// left, ten on the right.
fn knifed(script: &mut ScriptBuilder) {
    for left in [10.0, 50.0] {
        for (number, recipe) in ["W1", "Y1", "L1W4", "W1", "U1W6"].into_iter().enumerate() {
            script.wash("round");
            script.load("round", recipe, 0.0, 2.0);
            let y = 51.0 + 3.2 * number as f64;
            for _ in 0..5 {
                script.stroke("round", &[(left, y), (left + 7.0, y)], 0.7);
            }
        }
        script.wash("knife");
        let pulls = if left < 20.0 { 2 } else { 10 };
        for pull in 0..pulls {
            let rise = 2.0 - 4.0 * f64::from(pull % 2);
            script.even("knife", &[(left + 1.0, 57.5 + rise), (left + 30.0, 57.5 - rise)], 0.6);
        }
    }
}

/// A wavy line by each head shape with a single load.
fn shapes(script: &mut ScriptBuilder) {
    let names = ["round", "filbert", "bright", "fan", "rigger", "mop"];
    for (number, name) in names.into_iter().enumerate() {
        script.wash(name);
        let (recipe, vehicle) = if name == "rigger" { ("K1P1", 0.3) } else { ("V1W3", 0.05) };
        script.load(name, recipe, vehicle, 0.6);
        let left = if number < 3 { 10.0 } else { 78.0 };
        let y = 75.0 + 9.0 * (number % 3) as f64;
        let places: Vec<_> =
            (0..8).map(|i| (left + 8.5 * f64::from(i), y + 1.2 * f64::from(i).sin())).collect();
        script.stroke(name, &places, if name == "fan" { 0.75 } else { 0.55 });
    }
}
