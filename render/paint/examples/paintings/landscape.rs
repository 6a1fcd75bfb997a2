//! A wheat field with cypresses: underpainting, a sky painted wet in wet, then hills, field and
//! trees over dry paint, with thick highlights and thin lines by the rigger.
//!
//! Most strokes start at the points of a jittered grid. Direction and mixture depend on the
//! position. Strokes in the foreground are longer. You find the layout of the landscape here: its
//! size, the horizon and the path through the field. Its plants are cypresses and their shadows,
//! bushes, ears and stalks of wheat, and poppies.

use std::f64::consts::PI;

use paint::brush::HeadShape;
use paint::document::{Lighting, Medium};
use paint::ground::{ColorPrimer, GroundRelief, GroundSpec, Linen, Primer};
use paint::strokes::{Canvas, StrokeScript};

use super::script_builder::{Place, ScriptBuilder};

const SUN: Place = (47.0, 25.0);

const SKY: [(&str, &str); 6] = [
    ("W", "Lead White"),
    ("C", "Cobalt Blue"),
    ("U", "Ultramarine"),
    ("Y", "Chrome Yellow"),
    ("R", "Vermilion"),
    ("E", "Emerald Green"),
];

const EARTH: [(&str, &str); 8] = [
    ("W", "Lead White"),
    ("C", "Cobalt Blue"),
    ("Y", "Chrome Yellow"),
    ("R", "Vermilion"),
    ("V", "Viridian"),
    ("E", "Emerald Green"),
    ("K", "Bone Black"),
    ("P", "Prussian Blue"),
];

pub(crate) fn script() -> StrokeScript {
    let linen =
        Linen { seed: 7, threads_per_cm: 17.0, relief_mm: 0.06, unevenness: Linen::UNEVENNESS };
    let primer = Primer::Color(ColorPrimer { rgb: "#d9b98a".to_owned() });
    let ground = GroundSpec { reflectance: Some(primer), ..GroundRelief::Linen(linen).into() };
    let canvas = Canvas { width_mm: WIDTH, height_mm: HEIGHT, cell_mm: 0.2, ground };
    let mut script = ScriptBuilder::new("Wheat field with cypresses", canvas, &SKY, 1889);
    script.built.lighting =
        Some(Lighting { relief: 2.0, elevation_deg: 45.0, ..Lighting::default() });
    // Stiff paint that hides in a thin film.
    script.built.medium = Some(Medium { scattering_per_mm: 170.0, ..Medium::default() });
    for (name, shape, size_mm) in [
        ("wash", HeadShape::Flat, 20.0),
        ("flat", HeadShape::Flat, 6.0),
        ("filbert", HeadShape::Filbert, 4.5),
        ("small", HeadShape::Filbert, 2.8),
        ("round", HeadShape::Round, 2.2),
        ("rigger", HeadShape::Rigger, 1.1),
    ] {
        script.brush(name, shape, size_mm);
    }
    underpainting(&mut script);
    sky(&mut script);
    script.dry();
    sun(&mut script);
    script.palette(&EARTH);
    hills(&mut script);
    field(&mut script);
    script.dry();
    house(&mut script);
    shadows(&mut script);
    cypress(&mut script, (163.0, 104.0), 88.0, 11.5);
    cypress(&mut script, (181.0, 100.0), 58.0, 8.0);
    bushes(&mut script);
    wheat(&mut script);
    poppies(&mut script);
    script.built
}

/// A thin coat of paint on the whole canvas, so that no bare ground shows in gaps.
fn underpainting(script: &mut ScriptBuilder) {
    for (recipe, from, to) in
        [("W8C1", -4.0, 44.0), ("W9R0.5Y1", 44.0, 66.0), ("Y6R1W2", 66.0, 142.0)]
    {
        let mut y: f64 = from + 5.0;
        let mut way = 1.0;
        while y < to {
            script.wash("wash");
            script.load("wash", recipe, 0.3, 0.2);
            let bend = script.about(4.0);
            let [start, middle, end] =
                [-1.0, 0.0, 1.0].map(|side: f64| WIDTH / 2.0 + way * side * (WIDTH / 2.0 - 1.0));
            script.even("wash", &[(start, y), (middle, y + bend), (end, y)], 0.45);
            way = -way;
            y += 9.0;
        }
    }
    script.dry();
}

/// Direction of the wind at a position, in radians: to the right in waves, and around two whirls
/// and the sun.
fn wind((x, y): Place) -> f64 {
    let mut way = (1.0, 0.22 * (x / 23.0 + y / 31.0).sin());
    for ((cx, cy), reach, turn) in
        [((112.0, 24.0), 19.0, 1.0), ((146.0, 33.0), 12.0, -1.0), (SUN, 17.0, 1.0)]
    {
        let (dx, dy): (f64, f64) = (x - cx, y - cy);
        let distance = dx.hypot(dy).max(0.5);
        let weight = 3.2 * (-(distance / reach).powi(4)).exp();
        // A small inward component makes the whirls spirals.
        way.0 += weight * (-turn * dy - 0.2 * dx) / distance;
        way.1 += weight * (turn * dx - 0.2 * dy) / distance;
    }
    way.1.atan2(way.0)
}

/// Three points that follow the wind from `at` over `length` mm.
fn drift(at: Place, length: f64) -> Vec<Place> {
    let mut places = vec![at];
    let mut place = at;
    for step in 0..4 {
        let way = wind(place);
        place = (place.0 + length / 4.0 * way.cos(), place.1 + length / 4.0 * way.sin());
        if step % 2 == 1 {
            places.push(place);
        }
    }
    places
}

fn sky(script: &mut ScriptBuilder) {
    let blues = ["W4C1", "W7C1U0.2", "W11C1", "W18C1", "W26C1E0.3", "W30C0.5Y0.3", "W40Y0.6R0.2"];
    let mut tufts: Vec<Vec<Place>> = vec![Vec::new(); blues.len()];
    let mut y = 1.0;
    while y < HORIZON - 2.0 {
        let mut x = -6.0;
        while x < WIDTH {
            let at = (x + script.about(3.5), y + script.about(1.4));
            let depth = at.1 / HORIZON * 4.2 + brightness(at) + script.about(0.9);
            tufts[(depth.max(0.0) as usize).min(blues.len() - 1)].push(at);
            x += 9.0;
        }
        y += 3.0;
    }
    for (recipe, tuft) in blues.iter().zip(&tufts) {
        for (number, &at) in tuft.iter().enumerate() {
            if number % 6 == 0 {
                script.fresh("flat", recipe, 0.05, 0.25);
            }
            let length = 14.0 + script.about(4.0);
            let pressure = 0.58 + script.about(0.12);
            script.stroke("flat", &drift(at, length), pressure);
        }
    }
}

/// Number of steps by which clouds, whirls and the sun lighten the blue mixture of the sky.
fn brightness((x, y): Place) -> f64 {
    2.6 * ring((112.0, 24.0), 11.0, 3.0, (x, y))
        + 2.2 * ring((146.0, 33.0), 6.5, 2.2, (x, y))
        + 2.4 * bank(84.0, 47.0, 30.0, 4.0, (x, y))
        + 2.4 * bank(20.0, 49.0, 26.0, 4.0, (x, y))
        + 2.6 * bank(180.0, 14.0, 20.0, 5.0, (x, y))
        + 3.0 * bank(SUN.0, SUN.1, 15.0, 13.0, (x, y))
}

fn bank(cx: f64, cy: f64, wide: f64, high: f64, (x, y): Place) -> f64 {
    (-((x - cx) / wide).powi(2) - ((y - cy) / high).powi(2)).exp()
}

fn ring((cx, cy): Place, radius: f64, width: f64, (x, y): Place) -> f64 {
    let off = ((x - cx).hypot(y - cy) - radius) / width;
    (-off * off).exp()
}

/// Rings of thick yellow around a disc.
fn sun(script: &mut ScriptBuilder) {
    for (radius, recipe, count) in [
        (15.0, "W24Y1", 16),
        (11.5, "W12Y1", 13),
        (8.0, "W6Y1", 11),
        (4.6, "W3Y1", 8),
        (1.8, "W12Y1", 6),
    ] {
        script.fresh("filbert", recipe, 0.0, 0.4);
        for number in 0..count {
            let start = (f64::from(number) + script.about(0.3)) / f64::from(count) * 2.0 * PI;
            let arc = 7.0 / radius;
            let places: Vec<Place> = (0..3)
                .map(|i| start + f64::from(i) / 2.0 * arc)
                .map(|turn| (SUN.0 + radius * turn.cos(), SUN.1 + radius * turn.sin()))
                .collect();
            script.stroke("filbert", &places, 0.45);
        }
    }
}

/// Position of a crest below the top, in mm, as a function of x, and the mixtures below it.
type Ridge = (fn(f64) -> f64, [&'static str; 3]);

fn hills(script: &mut ScriptBuilder) {
    // From the farthest ridge to the nearest.
    let ridges: [Ridge; 3] = [
        (
            |x| 51.0 - 5.0 * (x / 34.0 + 0.6).sin() - 2.0 * (x / 11.0).sin(),
            ["W9C1R0.3", "W6C1R0.4", "W14C1R0.5"],
        ),
        (
            |x| 57.0 - 3.0 * (x / 27.0 + 2.4).sin() - (x / 8.0).sin(),
            ["W5C1V0.5", "W6C1E1", "W5V1Y0.6"],
        ),
        (|x| 61.0 - 1.4 * (x / 19.0).sin(), ["Y3V1W2", "Y10P1W3", "E1Y2W1"]),
    ];
    for (crest, recipes) in ridges {
        for pass in 0..3 {
            let mut x = -4.0 + 3.0 * f64::from(pass);
            while x < WIDTH {
                let recipe = recipes[script.one_of(3)];
                script.fresh("filbert", recipe, 0.05, 0.22);
                for _ in 0..2 {
                    let y = crest(x) + 2.6 * f64::from(pass) + 1.2 + script.about(0.5);
                    let fall = crest(x + 6.0) - crest(x);
                    script.stroke(
                        "filbert",
                        &[(x, y), (x + 4.0, y + fall * 0.6), (x + 12.0, y + fall * 1.6 + 0.6)],
                        0.55,
                    );
                    x += 8.0 + script.about(1.5);
                }
            }
        }
    }
}

/// A house with a red roof and two windows.
fn house(script: &mut ScriptBuilder) {
    // The lit wall, the shaded wall, the roof, and its lit ridge.
    for (recipe, rows, from, to) in [
        ("W24Y0.5R0.2", [57.0, 58.5, 60.0, 61.5], 77.0, 91.0),
        ("W9C1R0.5", [57.0, 58.5, 60.0, 61.5], 68.0, 74.0),
        ("R3Y1W1", [54.5, 54.2, 53.8, 53.4], 67.5, 92.0),
        ("R2Y2W4", [52.4, 52.2, 52.0, 51.8], 70.0, 89.5),
    ] {
        script.wash("flat");
        script.load("flat", recipe, 0.0, 0.4);
        for (number, y) in rows.into_iter().enumerate() {
            let (from, to) = if number % 2 == 0 { (from, to) } else { (to, from) };
            script.even("flat", &[(from, y), (to, y)], 0.42);
        }
    }
    script.fresh("round", "K1P1", 0.0, 0.22);
    for x in [80.0, 86.0] {
        script.dab("round", (x, 59.5), 0.5, 0.0);
    }
}

fn field(script: &mut ScriptBuilder) {
    let golds = ["Y8R2K1W3", "Y6R1.4K0.4W2", "Y6R1W4", "Y6R0.4W3", "W5Y1", "W9Y1"];
    let greens = ["Y3V1W1", "E1Y3W1", "Y6V1W3"];
    let earths = ["W9C1R1", "W10R0.6Y0.4", "W14R0.4Y0.6", "W12C0.6R0.6"];
    let mut y = HORIZON + 1.0;
    while y < HEIGHT + 5.0 {
        let near = (y - HORIZON) / (HEIGHT - HORIZON);
        let brush = if near > 0.22 { "flat" } else { "filbert" };
        let mut row = Vec::new();
        let mut x = -4.0 + script.about(2.0);
        while x < WIDTH + 4.0 {
            let (middle, half) = path(y);
            let on_path = (x - middle).abs() < half;
            let band = (near * 9.0 + (x / 40.0).sin() * 0.8).sin();
            let recipe = if on_path {
                earths[script.one_of(earths.len())]
            } else if near < 0.5 && band > 0.72 || ((x - middle).abs() < half + 4.0 * near + 1.0) {
                greens[script.one_of(greens.len())]
            } else {
                let light = 2.4 + 1.5 * band + script.about(1.7) - 1.2 * (near - 0.5);
                golds[(light.max(0.0) as usize).min(golds.len() - 1)]
            };
            let at = (x + script.about(1.5), y + script.about(1.2));
            let length = 5.5 + 9.5 * near + script.about(2.0);
            // Strokes are nearly level far away. Near by they are steep and bent by the wind.
            let (way, bow) = if on_path {
                (-0.3 - near * 0.4, 0.0)
            } else {
                (-0.15 - 1.05 * near.powf(0.6), 0.45)
            };
            let way = way + script.about(0.22);
            row.push((recipe, bowed(at, way, way + bow, length)));
            x += 5.0 + 1.5 * near;
        }
        // We sort by mixture, so that we need not wash the brush for every stroke.
        row.sort_by(|a, b| a.0.cmp(b.0));
        for (recipe, places) in row {
            script.fresh(brush, recipe, 0.05, 0.22);
            script.stroke(brush, &places, 0.5);
        }
        y += 2.4 + 4.6 * near;
    }
}

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

pub(crate) const WIDTH: f64 = 200.0;
pub(crate) const HEIGHT: f64 = 140.0;

/// Distance of the horizon from the top in mm. The field begins there.
pub(crate) const HORIZON: f64 = 62.0;

/// Middle and half width of the path in mm, `y` mm below the top.
pub(crate) fn path(y: f64) -> (f64, f64) {
    let near = ((y - HORIZON) / (HEIGHT - HORIZON)).clamp(0.0, 1.2);
    (92.0 - 8.0 * (near * 3.6).sin() + 34.0 * near * near, 1.2 + 13.0 * near.powf(1.4))
}
