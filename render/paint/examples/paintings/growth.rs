//! Plants of the landscape: cypresses and their shadows, bushes, ears and stalks of wheat,
//! poppies.

use std::f64::consts::PI;

use super::field_path::{HEIGHT, HORIZON, path};
use super::script_builder::{Place, ScriptBuilder};

/// The three points of a bent stroke of `length` mm from `x`, `y`. Its halves have the directions
/// `first` and `second`, in radians.
pub(crate) fn bowed((x, y): Place, first: f64, second: f64, length: f64) -> [Place; 3] {
    let half = 0.5 * length;
    let middle = (x + half * first.cos(), y + half * first.sin());
    [(x, y), middle, (middle.0 + half * second.cos(), middle.1 + half * second.sin())]
}

/// A cypress in upward strokes: four passes from dark and wide to light and narrow, each from the
/// foot to the top, then highlights on the side of the sun.
pub(crate) fn cypress(script: &mut ScriptBuilder, foot: Place, height: f64, half: f64) {
    let passes = [
        ("K2V1P0.5", 1.0, 7.0),
        ("V2P1K1Y1", 0.85, 7.0),
        ("Y5P1V1", 0.75, 7.0),
        ("Y10P1V1W1", 0.6, 8.0),
    ];
    for (number, (recipe, spread, step)) in passes.into_iter().enumerate() {
        let mut up: f64 = 0.0;
        while up < 0.97 {
            let wide = half * (1.0 - up).powf(0.7) * (0.75 + 0.9 * up * (1.0 - up)) * spread + 0.6;
            script.fresh("filbert", recipe, 0.0, 0.3);
            let count = ((wide / 2.4) as i32).max(1);
            for i in -count..=count {
                let side = f64::from(i) / f64::from(count);
                let lit = if number > 1 { -0.25 * half } else { 0.0 };
                let x = foot.0 + side * wide + lit * (1.0 - up) + script.about(0.8);
                let y = foot.1 - up * height + script.about(3.5);
                let length = 11.0 + script.about(2.5);
                let curl = 1.8 * (up * 14.0 + side * 2.0).sin();
                if number > 1 && script.about(1.0) > 0.2 {
                    continue;
                }
                let lean = -side * 0.25 * length;
                script.stroke(
                    "filbert",
                    &[
                        (x, y),
                        (x + curl + 0.3 * lean, y - 0.5 * length),
                        (x + lean - 0.4 * curl, y - length),
                    ],
                    0.5 * (1.0 - 0.3 * up),
                );
            }
            up += step / height;
        }
    }
    script.fresh("small", "Y4E2W1", 0.0, 0.3);
    for number in 0..(height / 4.0) as i32 {
        let up = f64::from(number) * 4.0 / height;
        script.load("small", "Y4E2W1", 0.0, 0.15);
        let wide = half * (1.0 - up).powf(0.7) * 0.75;
        let at =
            (foot.0 - wide * (0.55 + script.about(0.4)), foot.1 - up * height + script.about(2.0));
        let curl = 1.2 + script.about(1.2);
        script.stroke("small", &[at, (at.0 - curl, at.1 - 3.0), (at.0 + curl, at.1 - 6.0)], 0.35);
    }
}

/// Shadows of the cypresses on the wheat, away from the sun.
pub(crate) fn shadows(script: &mut ScriptBuilder) {
    for (x, y, length) in [(163.0, 104.0, 60.0), (181.0, 100.0, 40.0)] {
        for number in 0..14 {
            script.fresh("flat", ["C2R1K0.3Y2W2", "Y8R2K2C1"][number % 2], 0.1, 0.22);
            let along = number as f64 / 13.0;
            let at = (x - 9.0 + along * length, y - 1.0 + 9.0 * along + script.about(2.5));
            script.stroke("flat", &bowed(at, -0.1, 0.25, 10.0), 0.45);
        }
    }
}

/// Bushes at the foot of the trees and by the house.
pub(crate) fn bushes(script: &mut ScriptBuilder) {
    for (cx, cy, wide, high) in [
        (172.0, 103.0, 26.0, 7.0),
        (62.0, 61.0, 7.0, 5.0),
        (96.0, 61.0, 8.0, 4.0),
        (8.0, 60.0, 12.0, 4.0),
        (128.0, 61.0, 10.0, 3.0),
    ] {
        for (recipe, count, lift) in
            [("V2P1K1Y1", 18, 0.0), ("Y5P1V1W1", 11, 0.25), ("E1Y3W1", 8, 0.55)]
        {
            script.fresh("filbert", recipe, 0.0, 0.3);
            for _ in 0..count {
                script.load("filbert", recipe, 0.0, 0.1);
                let turn = script.about(PI);
                let out = script.about(1.0).abs().sqrt();
                let at =
                    (cx + out * wide * turn.cos(), cy + high * (0.8 * out * turn.sin() - lift));
                let bend = script.about(1.5);
                script.stroke(
                    "filbert",
                    &[at, (at.0 + bend, at.1 - 1.6), (at.0 + 1.5 * bend, at.1 - 4.0)],
                    0.5,
                );
            }
        }
    }
}

/// Ears of wheat in thick paint, and stalks by the rigger.
pub(crate) fn wheat(script: &mut ScriptBuilder) {
    for number in 0..150_usize {
        let near = 0.65 + script.about(0.35);
        let y = HORIZON + near * (HEIGHT - HORIZON) + script.about(3.0);
        let x = 100.0 + script.about(104.0);
        let (middle, half) = path(y);
        if (x - middle).abs() < half + 3.0 {
            continue;
        }
        let light = ["W5Y1", "W9Y1", "Y1W1", "W16Y1"][number / 38];
        script.fresh("small", light, 0.0, 0.4);
        let length = 3.0 + 4.0 * near;
        script.stroke(
            "small",
            &[(x, y), (x + 0.25 * length, y - 0.6 * length), (x + 0.7 * length, y - length)],
            0.5,
        );
    }
    for number in 0..90_usize {
        let recipe = ["Y8R2K1", "V2Y2K1", "W12Y1"][number / 30];
        let y = 118.0 + script.about(22.0);
        let x = 100.0 + script.about(102.0);
        let (middle, half) = path(y);
        if (x - middle).abs() < half + 2.0 {
            continue;
        }
        script.fresh("rigger", recipe, 0.3, 0.22);
        let lean = 5.0 + script.about(3.0);
        let tall = 11.0 + script.about(4.0);
        script.even(
            "rigger",
            &[(x, y), (x + 0.3 * lean, y - 0.6 * tall), (x + lean, y - tall)],
            0.6,
        );
    }
}

pub(crate) fn poppies(script: &mut ScriptBuilder) {
    for number in 0..46_usize {
        let near = 0.67 + script.about(0.33);
        let y = HORIZON + near * (HEIGHT - HORIZON) - 3.0 + script.about(2.0);
        let (middle, half) = path(y);
        let side = if number % 3 == 0 { 1.0 } else { -1.0 };
        let x = middle + side * (half + 3.0 + (8.0 + 44.0 * near) * script.about(1.0).powi(2));
        script.fresh("round", ["R4Y0.5", "R4W1", "R3Y1W1"][number / 16], 0.0, 0.4);
        for _ in 0..3 {
            let at = (x + script.about(0.9), y + script.about(0.7));
            script.dab("round", at, 0.35 + 0.45 * near, 0.0);
        }
    }
}
