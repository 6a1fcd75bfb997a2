//! A simulated hand that records its actions as a script.

use paint::pose::Sample;
use paint::strokes::{Action, Load, Recipe, Squeeze, Stroke, StrokeTool, SurfaceId};

/// Speed of the pen in mm per second.
const SPEED: f64 = 60.0;

/// Distance of the samples of a stroke, in mm.
const STEP: f64 = 0.8;

/// Position on a surface, in mm.
pub(crate) type Place = (f64, f64);

/// A hand and its recorded actions.
pub(crate) struct Hand {
    pub(crate) actions: Vec<Action>,
    seed: u64,
}

impl Hand {
    /// Creates a hand whose unsteadiness is seeded.
    pub(crate) fn new(seed: u64) -> Self {
        Self { actions: Vec::new(), seed }
    }

    /// Random number between `-most` and `most`.
    pub(crate) fn about(&mut self, most: f64) -> f64 {
        // Knuth's linear congruential generator, of which the upper bits are used.
        self.seed = self
            .seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let share = (self.seed >> 40) as f64 / f64::from(1 << 24);
        most * (2.0 * share - 1.0)
    }

    /// Washes a brush and loads it with parts of pigments by letter, such as `W6 U1`.
    pub(crate) fn load(&mut self, brush: &str, parts: &str, vehicle: f64, amount_mm: f64) {
        self.wash(brush);
        let brush = brush.to_owned();
        self.actions.push(Action::Load(Load { brush, recipe: recipe(parts), vehicle, amount_mm }));
    }

    /// Washes a brush.
    pub(crate) fn wash(&mut self, brush: &str) {
        self.actions.push(Action::Wash { brush: brush.to_owned() });
    }

    /// Squeezes a heap onto the palette.
    pub(crate) fn squeeze(&mut self, parts: &str, (x_mm, y_mm): Place, volume_mm3: f64) {
        let on = SurfaceId::Palette;
        let recipe = recipe(parts);
        let vehicle = 0.1;
        self.actions.push(Action::Squeeze(Squeeze { on, recipe, vehicle, x_mm, y_mm, volume_mm3 }));
    }

    /// Paints a stroke on the canvas.
    pub(crate) fn stroke(&mut self, brush: &str, along: &[Place], pressure: f64) {
        let samples = samples(along, pressure);
        let on = SurfaceId::Canvas;
        let tool = StrokeTool::Paint;
        let stroke = Stroke { brush: brush.to_owned(), on, tool, samples };
        self.actions.push(Action::Stroke(stroke));
    }

    /// Paints a stroke on the palette.
    pub(crate) fn mix(&mut self, brush: &str, along: &[Place], pressure: f64) {
        let samples = samples(along, pressure);
        let on = SurfaceId::Palette;
        let tool = StrokeTool::Paint;
        let stroke = Stroke { brush: brush.to_owned(), on, tool, samples };
        self.actions.push(Action::Stroke(stroke));
    }
}

/// Samples along a polyline: light pressure at both ends, the pen tilted along the
/// direction of movement, the broad side of the head across it.
pub(crate) fn samples(along: &[Place], pressure: f64) -> Vec<Sample> {
    let legs: Vec<f64> = along.windows(2).map(|leg| length(leg[0], leg[1])).collect();
    let whole: f64 = legs.iter().sum();
    let count = (whole / STEP).ceil().max(2.0) as usize;
    let place = |way: f64| {
        let mut left = way.clamp(0.0, whole);
        for (leg, long) in along.windows(2).zip(&legs) {
            if left <= *long {
                let share = left / long.max(1e-9);
                let between = |from: f64, to: f64| from + share * (to - from);
                return (between(leg[0].0, leg[1].0), between(leg[0].1, leg[1].1));
            }
            left -= long;
        }
        *along.last().expect("a stroke leads somewhere")
    };
    let sample = |index: usize| {
        let share = index as f64 / count as f64;
        let way = share * whole;
        let (x_mm, y_mm) = place(way);
        // Averaged over a few mm, so that the head does not jump at corners.
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
    };
    (0..=count).map(sample).collect()
}

fn length(from: Place, to: Place) -> f64 {
    (to.0 - from.0).hypot(to.1 - from.1)
}

/// Parses parts by letter.
fn recipe(parts: &str) -> Recipe {
    let part = |part: &str| {
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
            _ => panic!("{letter} of \"{parts}\" is no paint"),
        };
        (name.to_owned(), amount.parse().expect("parts are a number"))
    };
    parts.split_whitespace().map(part).collect()
}
