//! Glazes over impasto. We dry ridges of white and yellow by brush and knife, lay thin transparent
//! glazes over them, wipe these off in part, and light the painting low from the side.

use std::f64::consts::PI;

use paint::brush::HeadShape;
use paint::document::{Lighting, Medium};
use paint::ground::GroundKind;
use paint::strokes::{Canvas, StrokeScript};

use super::script_builder::{Place, ScriptBuilder};

const WIDTH: f64 = 100.0;
const HEIGHT: f64 = 70.0;

pub(crate) fn script() -> StrokeScript {
    let ground = GroundKind::Panel.spec(1);
    let canvas = Canvas { width_mm: WIDTH, height_mm: HEIGHT, cell_mm: 0.125, ground };
    let body = [("W", "Lead White"), ("Y", "Chrome Yellow"), ("R", "Vermilion")];
    let mut script = ScriptBuilder::new("Glazes over impasto", canvas, &body, 1);
    script.built.lighting = Some(Lighting {
        azimuth_deg: 285.0,
        elevation_deg: 28.0,
        ambient: 0.35,
        relief: 3.0,
        ..Lighting::default()
    });
    script.built.medium = Some(Medium { scattering_per_mm: 120.0, ..Medium::default() });
    for (name, shape, size_mm) in [
        ("round", HeadShape::Round, 4.0),
        ("knife", HeadShape::Knife, 9.0),
        ("mop", HeadShape::Mop, 10.0),
        ("rag", HeadShape::Flat, 9.0),
    ] {
        script.brush(name, shape, size_mm);
    }
    relief(&mut script);
    script.dry();
    for brush in ["round", "knife"] {
        script.wash(brush);
    }
    script.palette(&[("L", "Eosin Lake"), ("U", "Ultramarine"), ("V", "Viridian")]);
    glazes(&mut script);
    script.built
}

/// Three whirls of white petals and a wavy border, each stroke repeated so that the paint piles up.
/// Two pulls of the knife below.
fn relief(script: &mut ScriptBuilder) {
    for number in 0..3 {
        let x = 18.0 + 32.0 * f64::from(number);
        let y = 27.0;
        for petal in 0..11 {
            let turn = f64::from(petal) * 2.0 * PI / 11.0 + script.about(0.06);
            for pass in 0..4 {
                script.fresh("round", "W1", 0.0, 0.6);
                let out = 15.0 - f64::from(pass);
                let bends = [(3.5, 0.0), (0.6 * out, 0.35), (out, 0.9)];
                let places: [Place; 3] = bends.map(|(out, bend): (f64, f64)| {
                    (x + out * (turn + bend).cos(), y + 1.35 * out * (turn + bend).sin())
                });
                script.stroke("round", &places, 0.75);
            }
        }
    }
    for pass in 0..5 {
        script.wash("round");
        script.load("round", "W1", 0.0, 0.6);
        let places: Vec<Place> = (0..19)
            .map(|i: i32| (4.0 + 5.1 * f64::from(i), 58.0 + 2.5 * f64::from(i % 2)))
            .collect();
        script.even("round", &places, 0.7);
        if pass > 2 {
            script.wash("knife");
            script.load("knife", "W8Y1R0.2", 0.0, 1.0);
            script.even("knife", &[(6.0, 66.0), (94.0, 65.0)], 0.5);
        }
    }
}

/// Three bands of glaze from left to right. A clean flat brush then takes the glaze off the crests
/// of their lower half and leaves it in the hollows.
fn glazes(script: &mut ScriptBuilder) {
    for (recipe, left, vehicle) in [("L1", 6.0, 0.9), ("U1", 38.0, 0.95), ("V1", 70.0, 0.93)] {
        for row in 0..7 {
            script.wash("mop");
            script.load("mop", recipe, vehicle, 0.06);
            let x = left + 4.0 * f64::from(row);
            script.even("mop", &[(x, 6.0), (x + 0.4, 35.0), (x, 64.0)], 0.3);
        }
    }
    for row in 0..4 {
        let y = 32.0 + 5.0 * f64::from(row);
        for (from, to) in [(4.0, 35.0), (36.0, 67.0), (68.0, 98.0)] {
            script.wash("rag");
            script.stroke("rag", &[(from, y), (to, y + 0.8)], 0.4);
        }
    }
}
