//! Builds stroke scripts. This keeps the brushes, loads them when they run low, and varies
//! positions at random as a hand does.

use std::collections::BTreeMap;

use paint::brush::HeadShape;
use paint::pose::Sample;
use paint::strokes::{
    Action, BrushSpec, Canvas, Load, PaletteSpec, Recipe, Stroke, StrokeScript, StrokeTool,
    SurfaceId,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Position on the canvas in mm.
pub(crate) type Place = (f64, f64);

/// Number of strokes that a brush paints with one mixture before it is loaded again.
const STROKES_PER_LOAD: usize = 5;

/// A stroke script under construction.
pub(crate) struct ScriptBuilder {
    /// The script so far.
    pub(crate) built: StrokeScript,
    random: ChaCha8Rng,
    /// For each brush, its last mixture and the number of strokes painted with it.
    loaded: BTreeMap<String, (String, usize)>,
}

impl ScriptBuilder {
    /// Starts with an empty canvas. `seed` seeds the random variations.
    pub(crate) fn new(title: &str, canvas: Canvas, pigments: &[(&str, &str)], seed: u64) -> Self {
        let mut script = StrokeScript::new(title, "CC0-1.0", canvas, palette(pigments));
        script.library = Some("Van Gogh's oils".to_owned());
        Self { built: script, random: ChaCha8Rng::seed_from_u64(seed), loaded: BTreeMap::new() }
    }

    pub(crate) fn brush(&mut self, name: &str, shape: HeadShape, size_mm: f64) {
        self.built.brushes.insert(name.to_owned(), BrushSpec { shape, size_mm });
    }

    /// A random number from -`most` to `most`.
    pub(crate) fn about(&mut self, most: f64) -> f64 {
        self.random.random_range(-1.0..1.0) * most
    }

    /// A random index below `count`.
    pub(crate) fn one_of(&mut self, count: usize) -> usize {
        self.random.random_range(0..count)
    }

    /// Loads a brush with `recipe`: short names, each followed by its parts, for example `W10C1.5`.
    pub(crate) fn load(&mut self, brush: &str, recipe: &str, vehicle: f64, amount_mm: f64) {
        let load = Load { brush: brush.to_owned(), recipe: parts(recipe), vehicle, amount_mm };
        self.built.actions.push(Action::Load(load));
    }

    /// Washes a brush and loads it, unless it still holds enough of this mixture.
    pub(crate) fn fresh(&mut self, brush: &str, recipe: &str, vehicle: f64, amount_mm: f64) {
        match self.loaded.get_mut(brush) {
            Some((before, strokes)) if before == recipe && *strokes < STROKES_PER_LOAD => {
                *strokes += 1;
            }
            _ => {
                self.wash(brush);
                self.load(brush, recipe, vehicle, amount_mm);
                self.loaded.insert(brush.to_owned(), (recipe.to_owned(), 1));
            }
        }
    }

    pub(crate) fn wash(&mut self, brush: &str) {
        self.built.actions.push(Action::Wash { brush: brush.to_owned() });
    }

    pub(crate) fn dry(&mut self) {
        self.built.actions.push(Action::Dry { fraction: 1.0 });
    }

    /// Sets the pigments of the palette. We wash all brushes for this, because those that were in
    /// paint hold some of it.
    pub(crate) fn palette(&mut self, pigments: &[(&str, &str)]) {
        let brushes: Vec<String> = self.built.brushes.keys().cloned().collect();
        for brush in &brushes {
            self.wash(brush);
        }
        self.loaded.clear();
        self.built.actions.push(Action::Palette(palette(pigments)));
    }

    /// Paints a stroke through `places`. The brush lies across the path and leans forward.
    /// Its pressure rises from 60 % of `pressure` and falls back to it.
    pub(crate) fn stroke(&mut self, brush: &str, places: &[Place], pressure: f64) {
        let last = places.len() - 1;
        self.pull(brush, places, |i| if i == 0 || i == last { 0.6 * pressure } else { pressure });
    }

    /// Paints a stroke of constant pressure.
    pub(crate) fn even(&mut self, brush: &str, places: &[Place], pressure: f64) {
        self.pull(brush, places, |_| pressure);
    }

    fn pull(&mut self, brush: &str, places: &[Place], pressure: impl Fn(usize) -> f64) {
        let last = places.len() - 1;
        let mut seconds = 0.0;
        let mut twist = 0.0;
        let mut samples = Vec::with_capacity(places.len());
        for (i, &(x, y)) in places.iter().enumerate() {
            let from = places[i.saturating_sub(1)];
            let to = places[(i + 1).min(last)];
            let way = (to.1 - from.1).atan2(to.0 - from.0);
            if i > 0 {
                seconds += (x - places[i - 1].0).hypot(y - places[i - 1].1) / 80.0;
            }
            twist = nearest_turn(way.to_degrees() + 90.0, twist);
            samples.push(Sample {
                seconds: tidy(seconds, 10.0),
                x_mm: tidy(x, 10.0),
                y_mm: tidy(y, 10.0),
                pressure: tidy(pressure(i).clamp(0.0, 1.0), 100.0),
                tilt_x_deg: (25.0 * way.cos()).round(),
                tilt_y_deg: (25.0 * way.sin()).round(),
                twist_deg: twist.round(),
            });
        }
        self.built.actions.push(Action::Stroke(Stroke {
            brush: brush.to_owned(),
            on: SurfaceId::Canvas,
            tool: StrokeTool::Paint,
            samples,
        }));
    }

    /// Paints a dab. The brush leans to the lower right.
    pub(crate) fn dab(&mut self, brush: &str, (x, y): Place, pressure: f64, twist_deg: f64) {
        let sample = Sample {
            seconds: 0.0,
            x_mm: tidy(x, 10.0),
            y_mm: tidy(y, 10.0),
            pressure: tidy(pressure, 100.0),
            tilt_x_deg: 15.0,
            tilt_y_deg: 20.0,
            twist_deg: twist_deg.round(),
        };
        let brush = brush.to_owned();
        self.built.actions.push(Action::Stroke(Stroke {
            brush,
            on: SurfaceId::Canvas,
            tool: StrokeTool::Paint,
            samples: vec![sample],
        }));
    }
}

fn palette(pigments: &[(&str, &str)]) -> PaletteSpec {
    PaletteSpec {
        pigments: pigments
            .iter()
            .map(|(short, name): &(&str, &str)| (Some((*short).to_owned()), (*name).to_owned()))
            .collect(),
    }
}

/// Parses a recipe such as `W10C1.5`.
fn parts(recipe: &str) -> Recipe {
    let mut found = Recipe::new();
    let mut rest = recipe;
    while let Some(short) = rest.chars().next() {
        let end = rest[1..].find(|c: char| c.is_ascii_alphabetic()).map_or(rest.len(), |i| i + 1);
        let number = rest[1..end].parse().expect("a letter and its parts");
        found.insert(short.to_string(), number);
        rest = &rest[end..];
    }
    found
}

/// The twist nearest to `before` that differs from `angle` by a multiple of 180 degrees. A head is
/// symmetric, so both look alike.
fn nearest_turn(angle: f64, before: f64) -> f64 {
    angle - 180.0 * ((angle - before) / 180.0).round()
}

fn tidy(value: f64, per_unit: f64) -> f64 {
    (value * per_unit).round() / per_unit
}
