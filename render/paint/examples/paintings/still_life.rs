//! A still life alla prima: a jug, a lemon and an apple, painted in one sitting without drying. Every light
//! lies on wet paint, and edges are lost where a brush drags one colour into the next.

use paint::brush::HeadShape;
use paint::document::{Lighting, Medium};
use paint::ground::{GroundRelief, Linen};
use paint::strokes::{Canvas, StrokeScript};

use super::script_builder::{Place, ScriptBuilder};

const WIDTH: f64 = 96.0;
const HEIGHT: f64 = 72.0;
/// Height of the edge of the table.
const TABLE: f64 = 44.0;

/// A round thing: its middle and its half axes, in mm.
#[derive(Clone, Copy)]
struct Form {
    middle: Place,
    half: Place,
}

const JUG: Form = Form { middle: (29.0, 37.0), half: (12.5, 16.5) };
const LEMON: Form = Form { middle: (57.0, 52.0), half: (11.5, 8.0) };
const APPLE: Form = Form { middle: (75.0, 44.0), half: (10.0, 10.0) };

pub(crate) fn script() -> StrokeScript {
    let linen =
        Linen { seed: 11, threads_per_cm: 18.0, relief_mm: 0.05, unevenness: Linen::UNEVENNESS };
    let ground = GroundRelief::Linen(linen).into();
    let canvas = Canvas { width_mm: WIDTH, height_mm: HEIGHT, cell_mm: 0.07, ground };
    let pigments = [
        ("W", "Lead White"),
        ("Y", "Chrome Yellow"),
        ("R", "Vermilion"),
        ("L", "Eosin Lake"),
        ("U", "Ultramarine"),
        ("V", "Viridian"),
        ("K", "Bone Black"),
    ];
    let mut script = ScriptBuilder::new("Still life alla prima", canvas, &pigments, 5);
    script.built.lighting = Some(Lighting { relief: 1.5, ..Lighting::default() });
    script.built.medium = Some(Medium { scattering_per_mm: 170.0, ..Medium::default() });
    for (name, shape, size_mm) in [
        ("flat", HeadShape::Flat, 10.0),
        ("filbert", HeadShape::Filbert, 6.0),
        ("small", HeadShape::Filbert, 3.5),
        ("round", HeadShape::Round, 2.5),
        ("knife", HeadShape::Knife, 3.5),
    ] {
        script.brush(name, shape, size_mm);
    }
    wall(&mut script);
    table(&mut script);
    shadows(&mut script);
    jug(&mut script);
    apple(&mut script);
    lemon(&mut script);
    lights(&mut script);
    script.built
}

/// A dark wall in short diagonal strokes, cooler on the left.
fn wall(script: &mut ScriptBuilder) {
    for row in 0..7 {
        for column in 0..8 {
            let x = 1.0 + 13.5 * f64::from(column) + script.about(2.0);
            let y = 1.0 + 7.2 * f64::from(row) + script.about(1.0);
            let recipes =
                if column < 4 { ["U4V3L1W2", "V4U2R1W2"] } else { ["V3R2K1W1", "R2V3U1W1"] };
            let recipe = recipes[script.one_of(2)];
            script.fresh("flat", recipe, 0.1, 0.35);
            let slope = 4.0 + script.about(3.0);
            script.stroke("flat", &[(x - 8.0, y + slope), (x, y + 1.0), (x + 8.0, y - slope)], 0.5);
        }
    }
}

/// A table of warm greys in level strokes.
fn table(script: &mut ScriptBuilder) {
    for row in 0..6 {
        for column in 0..5 {
            let x = 2.0 + 23.0 * f64::from(column) + script.about(3.0);
            let y = TABLE + 4.0 + 5.2 * f64::from(row) + script.about(0.8);
            let recipe = ["W16Y1R0.8U0.4", "W14Y1R1V0.5", "W18Y1.2R0.7U0.3"][script.one_of(3)];
            script.fresh("flat", recipe, 0.05, 0.5);
            let bend = script.about(0.8);
            script.stroke("flat", &[(x - 14.0, y), (x, y + bend), (x + 14.0, y - bend)], 0.5);
        }
    }
}

/// Shadows on the table, cast to the right.
fn shadows(script: &mut ScriptBuilder) {
    for Form { middle: (x, y), half: (right, down) } in [JUG, LEMON, APPLE] {
        let y = y + 0.92 * down;
        for row in 0..3 {
            script.fresh("filbert", "U2R2V1W2", 0.05, 0.4);
            let y = y - 1.5 + 2.0 * f64::from(row);
            let reach = right * (1.9 - 0.25 * f64::from(row));
            let drop = script.about(0.5);
            script.stroke("filbert", &[(x - 0.3 * right, y), (x + reach, y + drop)], 0.5);
        }
    }
}

/// A stroke over a form: `share` of its half axis to the right of its middle, from one height to another, both
/// from -1 to 1. It bends as the form does.
fn over(form: Form, share: f64, (from, to): (f64, f64)) -> Vec<Place> {
    let Form { middle: (x, y), half: (right, down) } = form;
    (0..=6)
        .map(|step: i32| {
            let height = from + (to - from) * f64::from(step) / 6.0;
            (x + share * right * (1.0 - height * height).sqrt(), y + height * down)
        })
        .collect()
}

/// A white jug: shadow, half tones and light, each laid beside and into the wet one before.
fn jug(script: &mut ScriptBuilder) {
    for (recipe, share) in [
        ("W9U1R0.5", 0.82),
        ("W12U1R0.5", 0.5),
        ("W20U0.8R0.4", 0.18),
        ("W40U0.5R0.25Y0.1", -0.8),
        ("W40U0.5R0.3Y0.1", -0.15),
        ("W60U0.2R0.2Y0.15", -0.48),
    ] {
        script.fresh("filbert", recipe, 0.0, 1.3);
        script.stroke("filbert", &over(JUG, share, (-0.9, 0.86)), 0.5);
    }
    // The neck, its mouth and the handle.
    let x = JUG.middle.0;
    let y = JUG.middle.1 - JUG.half.1;
    for (recipe, offset) in [("W9U1R0.5", 2.8), ("W60U0.2R0.2Y0.15", -2.8), ("W20U0.8R0.4", 0.0)] {
        script.fresh("small", recipe, 0.0, 0.8);
        script.stroke("small", &[(x + offset, y + 3.5), (x + 1.1 * offset, y - 5.0)], 0.5);
    }
    script.fresh("round", "U3R2K1W2", 0.0, 0.5);
    script.stroke("round", &[(x - 3.4, y - 5.4), (x, y - 4.8), (x + 3.6, y - 5.4)], 0.5);
    script.fresh("small", "W10U1R0.5", 0.0, 0.9);
    let handle =
        [(x + 4.2, y - 3.0), (x + 12.0, y - 1.5), (x + 14.5, y + 8.0), (x + 10.0, y + 16.0)];
    script.stroke("small", &handle, 0.3);
}

/// A red apple, dark on the right, yellow where the light falls on its shoulder.
fn apple(script: &mut ScriptBuilder) {
    for (recipe, share) in [
        ("L5K1U0.6", 0.8),
        ("L5R2K0.4", 0.42),
        ("R4L2", 0.05),
        ("R6L0.6", -0.75),
        ("R6Y0.6W0.6", -0.38),
    ] {
        script.fresh("filbert", recipe, 0.0, 0.7);
        script.stroke("filbert", &over(APPLE, share, (-0.82, 0.88)), 0.45);
    }
    script.fresh("small", "Y3R1W3", 0.0, 0.9);
    script.stroke("small", &over(APPLE, -0.2, (-0.85, -0.1)), 0.3);
    script.fresh("round", "K2V1R1", 0.0, 0.6);
    let x = APPLE.middle.0 + 0.8;
    let y = APPLE.middle.1 - 0.8 * APPLE.half.1;
    script.stroke("round", &[(x, y + 1.0), (x + 0.4, y - 1.8), (x + 1.8, y - 4.4)], 0.35);
}

/// A lemon, green in its shadow, in level strokes.
fn lemon(script: &mut ScriptBuilder) {
    let upright = Form { middle: (0.0, 0.0), half: (LEMON.half.1, LEMON.half.0) };
    for (recipe, share) in [
        ("Y5V1R0.5", 0.8),
        ("Y7V0.5R0.4W1", 0.42),
        ("Y8W2", 0.05),
        ("Y8W8", -0.75),
        ("Y8W5", -0.35),
    ] {
        script.fresh("filbert", recipe, 0.0, 0.8);
        let places: Vec<Place> = over(upright, share, (-0.9, 0.86))
            .into_iter()
            .map(|(down, right)| (LEMON.middle.0 + right, LEMON.middle.1 + down))
            .collect();
        script.stroke("filbert", &places, 0.45);
    }
    let (x, y) = LEMON.middle;
    script.fresh("small", "Y8W4", 0.0, 0.9);
    script.dab("small", (x + LEMON.half.0 + 0.3, y - 0.6), 0.3, 80.0);
}

/// The highest lights, thick and last, over wet paint, and a flat light on the table by the knife.
fn lights(script: &mut ScriptBuilder) {
    script.wash("small");
    script.load("small", "W1", 0.0, 2.0);
    script.stroke("small", &over(JUG, -0.5, (-0.55, 0.1)), 0.25);
    let neck = (JUG.middle.0 - 2.9, JUG.middle.1 - JUG.half.1);
    script.stroke("small", &[(neck.0, neck.1 + 1.5), (neck.0 - 0.3, neck.1 - 3.5)], 0.2);
    script.wash("small");
    script.load("small", "W9Y1", 0.0, 2.0);
    let (x, y) = LEMON.middle;
    script.stroke("small", &[(x - 5.5, y - 3.6), (x - 1.0, y - 4.6), (x + 1.5, y - 4.4)], 0.2);
    script.wash("round");
    script.load("round", "W1", 0.0, 1.5);
    script.stroke(
        "round",
        &[
            (APPLE.middle.0 - 4.6, APPLE.middle.1 - 4.0),
            (APPLE.middle.0 - 3.2, APPLE.middle.1 - 5.4),
            (APPLE.middle.0 - 2.2, APPLE.middle.1 - 5.8),
        ],
        0.3,
    );
    script.wash("knife");
    script.load("knife", "W40Y1R0.3", 0.0, 1.5);
    script.even("knife", &[(35.0, 66.5), (47.0, 67.2)], 0.26);
    script.even("knife", &[(6.0, 61.0), (15.0, 61.4)], 0.26);
}
