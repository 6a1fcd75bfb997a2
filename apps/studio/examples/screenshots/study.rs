//! A study of two pears and a plum, after the photograph `docs/images/still-life.png`. A simulated
//! hand paints it and records its actions as a script.

use std::f64::consts::TAU;

use paint::brush::HeadShape;
use paint::document::Lighting;
use paint::ground::{ColorPrimer, GroundRelief, GroundSpec, Linen, Primer};
use paint::pose::Sample;
use paint::strokes::{
    Action, BrushSpec, Canvas, Load, Recipe, Squeeze, Stroke, StrokeTool, SurfaceId,
};
use pigment::library::PigmentLibrary;
use session::{Command, Origin, blank_canvas};

const WIDTH: f64 = 96.0;
const HEIGHT: f64 = 54.0;

/// Upper edge of the table, in mm.
const EDGE: f64 = 31.0;

/// Command that opens a toned linen canvas with low light from the left.
pub(crate) fn new_painting() -> Command {
    let Origin::Blank { mut script, library } =
        blank_canvas(PigmentLibrary::van_gogh_oils(), WIDTH, HEIGHT, 0.1)
    else {
        unreachable!("a bare canvas is bare");
    };
    script.title = "Two pears and a plum".to_owned();
    let linen =
        Linen { seed: 7, threads_per_cm: 16.0, relief_mm: 0.05, unevenness: Linen::UNEVENNESS };
    let primer = Primer::Color(ColorPrimer { rgb: "#c39a6b".to_owned() });
    let ground = GroundSpec { reflectance: Some(primer), ..GroundRelief::Linen(linen).into() };
    script.canvas = Canvas { ground, ..script.canvas };
    script.lighting = Some(light());
    for (name, shape, size_mm) in [
        ("round", HeadShape::Round, 2.2),
        ("flat", HeadShape::Flat, 5.0),
        ("filbert", HeadShape::Filbert, 6.0),
        ("rigger", HeadShape::Rigger, 0.8),
        ("mop", HeadShape::Mop, 7.0),
        ("knife", HeadShape::Knife, 7.0),
    ] {
        script.brushes.insert(name.to_owned(), BrushSpec { shape, size_mm });
    }
    Command::Open(Origin::Blank { script, library })
}

/// Low daylight that shows the relief.
pub(crate) fn light() -> Lighting {
    Lighting { azimuth_deg: 300.0, elevation_deg: 34.0, ..Lighting::default() }
}

/// Squeezes heaps along the rim of the palette, and mixes some below with the filbert.
pub(crate) fn palette(hand: &mut Hand) {
    for (index, parts) in ["W1", "L1", "Y1", "R1", "C1", "U1", "P1", "K1"].iter().enumerate() {
        let share = index as f64 / 7.0;
        let place = (7.0 + 50.0 * share, 8.0 - 2.5 * (share * TAU / 2.0).sin());
        hand.squeeze(parts, place, if index == 0 { 40.0 } else { 24.0 });
    }
    for (one, other, (x, y), turns) in [
        ("L3 Y1", "W1", (13.0, 20.0), 5.0),
        ("Y2 R1", "W1", (33.0, 20.0), 2.0),
        ("W5 K1", "U1 P0.3", (13.0, 33.0), 3.0),
        ("C3 U1", "W1", (33.0, 33.0), 1.5),
    ] {
        hand.squeeze(one, (x - 2.5, y), 14.0);
        hand.squeeze(other, (x + 2.5, y), 14.0);
        hand.wash("filbert");
        // The circles grow, because this is how you mix with a brush.
        let steps = (turns * 12.0) as usize;
        let spiral: Vec<Place> = (0..=steps)
            .map(|step| {
                let share = step as f64 / steps as f64;
                let turn = TAU * step as f64 / 12.0;
                let radius = 1.0 + 3.2 * share;
                (x + 1.3 * radius * turn.cos(), y + radius * turn.sin())
            })
            .collect();
        hand.mix("filbert", &spiral, 0.45);
    }
    hand.wash("filbert");
}

/// Paints wall and table in short strokes, with the shadows on the table.
pub(crate) fn surroundings(hand: &mut Hand) {
    let wall =
        ["W12 U0.8 P0.2 K1", "W15 U1 P0.2 K0.7", "W11 U0.6 P0.3 K1 L0.4", "W13 U1.1 K0.8 C0.2"];
    let table = ["W16 Y0.4 R0.2 K0.25", "W18 Y0.5 R0.2", "W15 Y0.4 R0.3 U0.25", "W22 Y0.5 R0.1"];
    rows(hand, &wall, 1.0, EDGE - 1.0, -0.35);
    rows(hand, &table, EDGE + 2.0, HEIGHT - 1.5, 0.08);
    let shadow = ["W4 K1 U0.5 Y0.8 C0.3", "W3.5 K1.2 Y1 R0.4 U0.5"];
    for (index, (x, y, long)) in [
        (44.0, 47.0, 17.0),
        (41.0, 49.5, 13.0),
        (62.0, 44.0, 14.0),
        (79.0, 46.0, 14.0),
        (76.0, 48.0, 13.0),
    ]
    .into_iter()
    .enumerate()
    {
        hand.load("flat", shadow[index % 2], 0.15, 0.3);
        hand.stroke("flat", &[(x - 4.0, y), (x + 0.5 * long, y - 0.8), (x + long, y - 2.2)], 0.5);
    }
}

fn rows(hand: &mut Hand, mixtures: &[&str], from: f64, to: f64, slope: f64) {
    let count = ((to - from) / 3.6).round();
    for row in 0..=count as usize {
        let y = from + (to - from) * row as f64 / count;
        let mut x = 1.0 - if row % 2 == 0 { 0.0 } else { 5.0 };
        let mut turn = row;
        while x < WIDTH {
            let long = 14.0 + hand.about(4.0);
            let mixture = mixtures[(turn * 7 + row * 3) % mixtures.len()];
            hand.load("flat", mixture, 0.1, 0.4);
            let rise = slope * long + hand.about(0.8);
            let bow = hand.about(0.6);
            let along =
                [(x, y - 0.5 * rise), (x + 0.5 * long, y + bow), (x + long, y + 0.5 * rise)];
            let pressure = 0.5 + hand.about(0.08);
            hand.stroke(
                "flat",
                &along.map(|(x, y): Place| {
                    (x.clamp(-2.0, WIDTH + 2.0), y.clamp(from - 1.0, to + 1.0))
                }),
                pressure,
            );
            x += long - 1.5;
            turn += 1;
        }
    }
}

/// Outline of a pear: shares of its height, and its half width there as a share of the largest.
const PEAR: [(f64, f64); 9] = [
    (0.0, 0.12),
    (0.07, 0.3),
    (0.3, 0.34),
    (0.45, 0.6),
    (0.55, 0.86),
    (0.7, 1.0),
    (0.85, 0.95),
    (0.94, 0.68),
    (1.0, 0.4),
];

const PLUM: [(f64, f64); 7] =
    [(0.0, 0.45), (0.1, 0.7), (0.3, 0.92), (0.5, 1.0), (0.7, 0.92), (0.9, 0.6), (1.0, 0.2)];

/// An upright fruit.
struct Fruit {
    x: f64,
    top: f64,
    tall: f64,
    half_width: f64,
    outline: &'static [(f64, f64)],
    /// Index of the point of `outline` where every other stroke begins.
    below: usize,
    /// Mixtures from the lit to the shaded side.
    mixtures: [&'static str; 7],
}

/// Paints the fruits wet in wet over the dry background.
pub(crate) fn fruits(hand: &mut Hand) {
    let orange = Fruit {
        x: 58.0,
        top: 9.0,
        tall: 34.0,
        half_width: 9.6,
        outline: &PEAR,
        below: 2,
        mixtures: [
            "Y3 R1.4 K0.5",
            "Y4 R1 W2",
            "Y4 R0.8 W8",
            "Y5 R1 W3",
            "Y4 R1.4",
            "Y3 R1.6 K0.25",
            "Y2 R1.5 C0.6 K0.6",
        ],
    };
    let yellow = Fruit {
        x: 37.0,
        top: 9.5,
        tall: 37.0,
        half_width: 11.0,
        outline: &PEAR,
        below: 2,
        mixtures: [
            "L5 Y1 W4",
            "L4 W12 Y0.3",
            "L5 W8 Y0.6",
            "L5 Y1.2 W2",
            "L4 Y1.4 K0.12",
            "L3 Y1.6 K0.35 P0.04",
            "L2 Y1.6 K0.8 P0.08",
        ],
    };
    let plum = Fruit {
        x: 79.0,
        top: 30.0,
        tall: 17.0,
        half_width: 8.6,
        outline: &PLUM,
        below: 0,
        mixtures: [
            "C4 U1 W7",
            "C5 U1 W14",
            "C5 U1.2 W8",
            "C5 U1.4 W4",
            "C5 U1.8 W2",
            "C4 U2 W1",
            "C3 U2 K0.6",
        ],
    };
    for fruit in [&orange, &yellow, &plum] {
        modelled(hand, fruit);
    }
    for (x, y, lean) in [(37.0, 10.5, -1.2), (58.0, 10.0, 2.2)] {
        hand.load("rigger", "K2 R1 Y0.6", 0.05, 0.4);
        hand.stroke("rigger", &[(x, y), (x + 0.2 * lean, y - 3.0), (x + lean, y - 6.0)], 0.7);
        hand.stroke("rigger", &[(x + 0.4, y), (x + 0.2 * lean + 0.4, y - 3.0)], 0.6);
    }
}

/// Paints the fruit in strokes from the top down along its outline, the darkest first.
fn modelled(hand: &mut Hand, fruit: &Fruit) {
    let last = fruit.mixtures.len() - 1;
    for index in (0..=last).rev() {
        // This lies inside the outline by half a brush.
        let side = (2.0 * index as f64 / last as f64 - 1.0) * (1.0 - 2.8 / fruit.half_width);
        let along: Vec<Place> = fruit
            .outline
            .iter()
            .map(|&(down, wide)| {
                (fruit.x + side * wide * fruit.half_width, fruit.top + down * fruit.tall)
            })
            .collect();
        hand.load("filbert", fruit.mixtures[index], 0.08, 0.7);
        let from = if index % 2 == 0 { 0 } else { fruit.below };
        hand.stroke("filbert", &along[from..], 0.5);
    }
}

/// Paints thick lights over the dry fruits, except the last one, [`AT_WORK`].
pub(crate) fn lights(hand: &mut Hand) {
    hand.load("round", "L2 W12", 0.02, 0.8);
    hand.stroke("round", &[(31.0, 36.0), (30.3, 33.0), (31.5, 29.5)], 0.4);
    hand.stroke("round", &[(34.6, 17.5), (34.9, 14.0)], 0.35);
    hand.load("round", "W16 C1 U0.3", 0.02, 0.8);
    hand.stroke("round", &[(75.0, 36.5), (76.0, 34.8), (77.5, 34.0)], 0.35);
    for (brush, parts) in [
        ("flat", "W8 U1 P0.2"),
        ("filbert", "L4 Y1"),
        ("rigger", "K2 R1"),
        ("round", "Y1.5 R0.3 W16"),
    ] {
        hand.load(brush, parts, 0.05, if brush == "round" { 0.9 } else { 0.5 });
    }
}

/// The last light, on the second pear. The screenshot shows the pen while it paints this stroke.
pub(crate) const AT_WORK: [Place; 4] = [(56.0, 16.5), (55.3, 22.0), (54.4, 27.5), (53.0, 32.5)];

/// Glazes the dry study: cool in the shadows, warm on the second pear.
pub(crate) fn glazes(hand: &mut Hand) {
    hand.load("mop", "U1 C0.1", 0.997, 0.12);
    hand.stroke("mop", &[(40.0, 49.0), (54.0, 47.5), (67.0, 45.5)], 0.35);
    hand.stroke("mop", &[(77.0, 48.5), (91.0, 47.0)], 0.35);
    hand.load("mop", "R1 C0.2", 0.994, 0.12);
    hand.stroke("mop", &[(60.0, 18.0), (63.5, 28.0), (64.0, 38.0)], 0.35);
}

/// Speed of the pen in mm per second.
const SPEED: f64 = 60.0;

const STEP: f64 = 0.8;

/// Position on a surface, in mm.
pub(crate) type Place = (f64, f64);

pub(crate) struct Hand {
    pub(crate) actions: Vec<Action>,
    seed: u64,
}

impl Hand {
    /// Creates a hand with seeded unsteadiness.
    pub(crate) fn new(seed: u64) -> Self {
        Self { actions: Vec::new(), seed }
    }

    /// Random number between `-most` and `most`.
    pub(crate) fn about(&mut self, most: f64) -> f64 {
        // This is Knuth's linear congruential generator. We use its upper bits.
        self.seed = self
            .seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let share = (self.seed >> 40) as f64 / f64::from(1 << 24);
        most * (2.0 * share - 1.0)
    }

    /// Washes a brush and loads it with parts of pigments by letter, e.g. `W6 U1`.
    pub(crate) fn load(&mut self, brush: &str, parts: &str, vehicle: f64, amount_mm: f64) {
        self.wash(brush);
        let brush = brush.to_owned();
        self.actions.push(Action::Load(Load { brush, recipe: recipe(parts), vehicle, amount_mm }));
    }

    pub(crate) fn wash(&mut self, brush: &str) {
        self.actions.push(Action::Wash { brush: brush.to_owned() });
    }

    pub(crate) fn squeeze(&mut self, parts: &str, (x_mm, y_mm): Place, volume_mm3: f64) {
        let on = SurfaceId::Palette;
        let recipe = recipe(parts);
        let vehicle = 0.1;
        self.actions.push(Action::Squeeze(Squeeze { on, recipe, vehicle, x_mm, y_mm, volume_mm3 }));
    }

    pub(crate) fn stroke(&mut self, brush: &str, along: &[Place], pressure: f64) {
        let samples = samples(along, pressure);
        let on = SurfaceId::Canvas;
        let tool = StrokeTool::Paint;
        let stroke = Stroke { brush: brush.to_owned(), on, tool, samples };
        self.actions.push(Action::Stroke(stroke));
    }

    pub(crate) fn mix(&mut self, brush: &str, along: &[Place], pressure: f64) {
        let samples = samples(along, pressure);
        let on = SurfaceId::Palette;
        let tool = StrokeTool::Paint;
        let stroke = Stroke { brush: brush.to_owned(), on, tool, samples };
        self.actions.push(Action::Stroke(stroke));
    }
}

/// Samples along a polyline. The pressure is light at both ends, the pen leans in the direction of
/// movement, and the broad side of the head lies across it.
pub(crate) fn samples(along: &[Place], pressure: f64) -> Vec<Sample> {
    let legs: Vec<f64> = along.windows(2).map(|leg| length(leg[0], leg[1])).collect();
    let whole: f64 = legs.iter().sum();
    let count = (whole / STEP).ceil().max(2.0) as usize;
    let place = |way: f64| {
        let mut left = way.clamp(0.0, whole);
        for (leg, long) in along.windows(2).zip(&legs) {
            if left <= *long {
                let share = left / long.max(1e-9);
                let from = leg[0];
                let to = leg[1];
                return (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1));
            }
            left -= long;
        }
        *along.last().expect("a stroke leads somewhere")
    };
    (0..=count)
        .map(|index| {
            let share = index as f64 / count as f64;
            let way = share * whole;
            let (x_mm, y_mm) = place(way);
            // We average over a few mm, so that the head does not jump at corners.
            let behind = place(way - 2.0);
            let ahead = place(way + 2.0);
            let course = (ahead.1 - behind.1).atan2(ahead.0 - behind.0);
            let soft = (share.min(1.0 - share) * 6.0).min(1.0);
            Sample {
                seconds: way / SPEED,
                x_mm,
                y_mm,
                pressure: pressure * (0.1 + 0.9 * soft),
                tilt_x_deg: 25.0 * course.cos(),
                tilt_y_deg: 25.0 * course.sin(),
                twist_deg: course.to_degrees() - 90.0,
            }
        })
        .collect()
}

fn length(from: Place, to: Place) -> f64 {
    (to.0 - from.0).hypot(to.1 - from.1)
}

/// Parses parts by letter.
fn recipe(parts: &str) -> Recipe {
    parts
        .split_whitespace()
        .map(|part| {
            let (letter, amount) = part.split_at(1);
            let name = match letter {
                "W" => "Zinc White",
                "L" => "Chrome Yellow (Otero)",
                "Y" => "Chrome Yellow",
                "R" => "Vermilion",
                "C" => "Cochineal Lake",
                "U" => "Ultramarine",
                "P" => "Prussian Blue",
                "K" => "Bone Black",
                _ => panic!("{letter} of \"{parts}\" is not paint"),
            };
            (name.to_owned(), amount.parse().expect("parts are a number"))
        })
        .collect()
}
