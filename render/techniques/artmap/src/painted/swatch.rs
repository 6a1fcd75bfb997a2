//! Paints one swatch: the strokes of a tone, from a style and a seed. It uses a separate canvas
//! with margins, and cuts these away.
//!
//! Strokes run along y, from top to bottom. They start at the points of a jittered grid, so that
//! strokes cover evenly. All random differences of strokes come from the seed.

use std::sync::Arc;

use graphics::field::Field;
use graphics::tile::Rect;
use paint::Sample as BrushworkSample;
use paint::amount::{quanta_from_mm, share_of_65536};
use paint::document::{Document, Lighting, Medium};
use paint::engine::{BrushId, PaintEngine};
use paint::ground::{Ground, GroundError};
use paint::layer::{Cell, Layer, SLOTS};
use paint::light::Light;
use paint::painting::{Painting, PaintingError};
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::plan::{Layout, Style, ToneSource};
use super::tones::{Tone, ToneLadder};
use crate::sample::Sample;
use crate::sample::from_painting::{level_colors, summed_height, summed_paint};

/// Everything that the swatches of a set share.
#[derive(Debug)]
pub(super) struct Workplace<'a> {
    pub(super) style: &'a Style,
    pub(super) ladder: &'a ToneLadder,
    pub(super) ground: Ground,
    pub(super) light: Arc<Light>,
}

/// The paint of a style deviates from its tone by at most this, in L*.
pub(super) fn spread(style: &Style) -> f64 {
    style.paint.lightness_spread + style.paint.streaks
}

/// Mixtures of the strokes of a tone, from its darkest to its lightest.
#[derive(Debug)]
struct Mixtures {
    spread: f64,
    ends: [[f64; SLOTS]; 2],
}

impl Mixtures {
    fn new(ladder: &ToneLadder, tone: &Tone, spread: f64) -> Self {
        Self { spread, ends: ladder.shares_about(tone.lab.lightness, spread) }
    }

    /// Shares by slot of the mixture that is lighter than the tone by about `lightness` L*.
    fn shares(&self, lightness: f64) -> [f64; SLOTS] {
        let [dark, light] = &self.ends;
        let share = (0.5 + lightness / (2.0 * self.spread).max(1e-9)).clamp(0.0, 1.0);
        std::array::from_fn(|slot| dark[slot] + share * (light[slot] - dark[slot]))
    }
}

pub(super) fn ground(style: &Style, ladder: &ToneLadder) -> Result<Ground, GroundError> {
    let (across, along) = style.margins();
    let side = style.canvas.side_cells;
    let width = side + 2 * across;
    let height = side + 2 * along;
    style.canvas.ground.build(width, height, style.canvas.cell_mm, ladder.library())
}

impl Workplace<'_> {
    /// Paints the tone number `at` with `strokes` and cuts the margins away.
    pub(super) fn swatch(
        &self,
        at: usize,
        strokes: &[SwatchStroke],
    ) -> Result<Sample, PaintingError> {
        let document = self.painted(at, strokes)?;
        Ok(self.sample(at, &document))
    }

    /// The whole canvas of the tone number `at`, with its margins.
    pub(super) fn painted(
        &self,
        at: usize,
        strokes: &[SwatchStroke],
    ) -> Result<Document, PaintingError> {
        let paint = &self.style.paint;
        let (tone, share) = self.tone(at);
        let mixtures = Mixtures::new(self.ladder, tone, spread(self.style));
        let library = self.ladder.library();
        let medium = Medium { stiffness: paint.stiffness, ..Medium::of(library) };
        let mut document = Document::bare(
            &self.style.name,
            self.style.canvas.cell_mm,
            self.ground.clone(),
            library.as_ref().clone(),
            medium,
            *self.ladder.slots(),
            Lighting::default(),
        );
        if let Some(underpainting) = self.underpainting(&mixtures) {
            document.push_dry(*self.ladder.slots(), underpainting);
        }
        let engine = PaintEngine::on_cpu(self.ground.height.clone());
        let mut painting = Painting::open_under(document, Arc::clone(&self.light), engine, 0)?;
        let brush = painting.add_brush(self.style.brush.shape, self.style.brush.size_mm)?;
        let mut coat = 0;
        for stroke in strokes.iter().filter(|stroke| stroke.rank < share) {
            if stroke.coat > coat {
                coat = stroke.coat;
                painting.dry(1.0 - paint.wet_in_wet)?;
            }
            self.load(&mut painting, brush, &mixtures, stroke)?;
            painting.stroke(brush, &stroke.samples)?;
        }
        painting.document()
    }

    fn underpainting(&self, mixtures: &Mixtures) -> Option<Layer> {
        let Style { paint, canvas, .. } = self.style;
        if paint.underpainting_mm == 0.0 {
            return None;
        }
        let pigments = mixtures
            .shares(0.0)
            .map(|share: f64| quanta_from_mm(share * paint.underpainting_mm, canvas.cell_mm));
        let width = self.ground.height.width();
        let height = self.ground.height.height();
        let mut layer = Layer::empty(width, height);
        layer.pigments = Field::filled(width, height, pigments);
        Some(layer)
    }

    /// Mixture of the tone number `at`, and the share of the strokes that this tone has.
    fn tone(&self, at: usize) -> (&Tone, f64) {
        let tones = self.ladder.tones();
        match self.style.paint.tones {
            ToneSource::Mixture => (&tones[at], f64::INFINITY),
            ToneSource::Density => {
                let light = at as f64 / (tones.len() - 1) as f64;
                (&tones[0], 1.0 - light * (1.0 - self.style.paint.lightest_share))
            }
        }
    }

    /// Loads the clean brush with the paint of a stroke. Each lock of hair gets a mixture between
    /// the darkest and the lightest of the stroke.
    fn load(
        &self,
        painting: &mut Painting,
        brush: BrushId,
        mixtures: &Mixtures,
        stroke: &SwatchStroke,
    ) -> Result<(), PaintingError> {
        let most = stroke.streaks.iter().fold(0.0, |most: f64, streak| most.max(streak.abs()));
        let lightness = stroke.lightness;
        let loaded = |painting: &mut Painting, lightness: f64| {
            painting.wash(brush)?;
            let recipe = mixtures.shares(lightness);
            painting.load(brush, &recipe, self.style.paint.vehicle, stroke.load_mm)?;
            painting.brush_paint(brush)
        };
        if most == 0.0 {
            return loaded(painting, lightness).map(|_| ());
        }
        let dark = loaded(painting, lightness - most)?;
        let light = loaded(painting, lightness + most)?;
        let weights: Vec<f64> =
            stroke.streaks.iter().map(|streak| (streak / most + 1.0) / 2.0).collect();
        painting.set_brush_paint(brush, &half_mixed(&dark, &light, &weights))
    }

    fn sample(&self, at: usize, document: &Document) -> Sample {
        let (across, along) = self.style.margins();
        let side = self.style.canvas.side_cells;
        let middle = Rect { x: across, y: along, width: side, height: side };
        Sample {
            name: format!("tone {}", at + 1),
            color: level_colors(document, &self.light).part(middle),
            paint: Some(
                summed_paint(document, |pigment| {
                    self.ladder.slots().iter().position(|slot| *slot == Some(pigment))
                })
                .part(middle),
            ),
            height_mm: Some(summed_height(document).part(middle)),
            mask: Field::filled(side, side, true),
            spacing: self.style.spacing_cells(),
            mm_per_texel: Some(document.cell_mm),
            guessed_relief: false,
        }
    }
}

/// Paint of a head between two mixtures of equal volume. `weights` lie at even distances around
/// the head: 0 gives `dark`, 1 gives `light`.
fn half_mixed(dark: &Layer, light: &Layer, weights: &[f64]) -> Layer {
    let width = dark.width();
    let height = dark.height();
    let mut mixed = Layer::empty(width, height);
    for x in 0..width {
        let at = x as f64 / width as f64 * weights.len() as f64;
        let first = at as usize;
        let share = at.fract();
        let [from, to] = [first, first + 1].map(|knot| weights[knot % weights.len()]);
        let light_parts = ((from + share * (to - from)) * 65536.0).round() as u32;
        for y in 0..height {
            let index = y * width + x;
            let [a, b] = [dark.cell(index), light.cell(index)];
            fn blended(a: u32, b: u32, light_parts: u32) -> u32 {
                share_of_65536(a, 65536 - light_parts) + share_of_65536(b, light_parts)
            }
            let pigments = std::array::from_fn(|slot| {
                blended(a.pigments[slot], b.pigments[slot], light_parts)
            });
            mixed.set_cell(
                index,
                Cell { pigments, vehicle: blended(a.vehicle, b.vehicle, light_parts) },
            );
        }
    }
    mixed
}

pub(super) const KNOTS: usize = 20;
/// Steps of the rank of a stroke from column to column and from row to row. This is Roberts'
/// sequence R2 (2018): the strokes with ranks below any value lie evenly on the plane.
const RANK_STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];
/// A stroke's path has this many points for each width of the brush.
const POINTS: f64 = 2.0;
/// Speed of the hand in brush widths per second. We only use time to order the samples.
const SPEED: f64 = 10.0;

/// A stroke of a swatch. Its paint is relative to the tone in which we paint it.
#[derive(Debug, Clone, PartialEq)]
pub struct SwatchStroke {
    /// Coat of the stroke, from 0.
    pub coat: u32,
    /// Rank among all strokes, 0 to 1. For example, a tone of density 0.3 has the strokes below
    /// 0.3.
    pub rank: f64,
    /// Poses of the brush, in mm from the corner of the canvas.
    pub samples: Vec<BrushworkSample>,
    /// L* of the stroke relative to its tone.
    pub lightness: f64,
    /// L* around the head relative to the stroke, at knots that are evenly spaced.
    pub streaks: Vec<f64>,
    /// Height of the paint on the head in mm.
    pub load_mm: f64,
}

/// Strokes on the canvas of a swatch with its margins, in the order in which we paint them.
#[must_use]
pub fn strokes(style: &Style, seed: u64) -> Vec<SwatchStroke> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (across, along) = style.margins();
    let side = style.canvas.side_cells;
    fn mm(cells: usize, style: &Style) -> f64 {
        cells as f64 * style.canvas.cell_mm
    }
    let size = [mm(side + 2 * across, style), mm(side + 2 * along, style)];
    let inner = [mm(along, style), mm(along + side, style)];
    let mut all = Vec::new();
    for coat in 0..style.strokes.coats {
        let mut strokes = coat_strokes(style, coat, size, &mut random);
        // A stroke that does not reach the swatch only costs time.
        strokes.retain(|stroke| {
            stroke.samples.iter().any(|sample: &BrushworkSample| {
                let reach = style.brush.size_mm;
                (inner[0] - reach..inner[1] + reach).contains(&sample.y_mm)
            })
        });
        if style.strokes.layout == Layout::Scatter {
            strokes.shuffle(&mut random);
        }
        all.append(&mut strokes);
    }
    all
}

fn coat_strokes(
    style: &Style,
    coat: u32,
    [width, height]: [f64; 2],
    random: &mut ChaCha8Rng,
) -> Vec<SwatchStroke> {
    let plan = &style.strokes;
    let columns = (width / plan.spacing_mm).ceil() as i64;
    let rows = (height / plan.advance_mm).ceil() as i64 + 1;
    // Strokes of a coat lie between the strokes of the coat before.
    let shift = 0.5 * f64::from(coat % 2);
    let mut strokes = Vec::new();
    for column in 0..columns {
        let phase = (plan.stagger * column as f64).fract() + shift;
        for row in -1..rows {
            let x = (column as f64 + 0.5 + shift) * plan.spacing_mm;
            let y = (row as f64 + 0.5 + phase) * plan.advance_mm;
            let middle = [(x, plan.spacing_mm), (y, plan.advance_mm)]
                .map(|(at, mm)| at + plan.jitter * mm * random.random_range(-0.5..=0.5));
            let [step, down] = RANK_STEPS;
            let rank = (step * column as f64 + down * (row + 1) as f64).fract();
            strokes.push(stroke(style, coat, rank, middle, random));
        }
    }
    strokes
}

fn stroke(
    style: &Style,
    coat: u32,
    rank: f64,
    middle: [f64; 2],
    random: &mut ChaCha8Rng,
) -> SwatchStroke {
    let plan = &style.strokes;
    let paint = &style.paint;
    let mut about = |spread: f64| spread * random.random_range(-1.0..=1.0);
    let length = plan.length_mm * (1.0 + about(plan.length_spread));
    // The sum of three even numbers is nearly normal. This has a standard deviation of 1.
    let angle = (0..3).map(|_| about(1.0)).sum::<f64>() * plan.angle_deg.to_radians();
    let sagitta = about(plan.bend) * length;
    let pressure = (plan.pressure * (1.0 + about(plan.pressure_spread))).clamp(0.0, 1.0);
    let lightness = about(paint.lightness_spread);
    let load_mm = paint.load_mm * (1.0 + about(paint.load_spread));
    let streaks = (0..KNOTS).map(|_| about(paint.streaks)).collect();
    let samples = samples(style, middle, [length, angle, sagitta, pressure]);
    SwatchStroke { coat, rank, samples, lightness, streaks, load_mm }
}

/// Poses along an arc from top to bottom. The broad side of the brush lies across the motion.
/// Pressure rises over the first brush width and falls over the last.
fn samples(
    style: &Style,
    [x, y]: [f64; 2],
    [length, angle, sagitta, pressure]: [f64; 4],
) -> Vec<BrushworkSample> {
    let size = style.brush.size_mm;
    let points = (POINTS * length / size).ceil().clamp(4.0, 200.0);
    let taper = size.min(length / 2.0);
    let (sin, cos) = angle.sin_cos();
    (0..=points as usize)
        .map(|at: usize| {
            let share = at as f64 / points;
            let along = length * (share - 0.5);
            let across = sagitta * (1.0 - (2.0 * share - 1.0).powi(2));
            let slope = -4.0 * sagitta * (2.0 * share - 1.0) / length;
            let rise = ((share.min(1.0 - share) * length) / taper).clamp(0.0, 1.0);
            let eased = rise * rise * (3.0 - 2.0 * rise);
            BrushworkSample {
                seconds: share * length / (size * SPEED),
                x_mm: x + across * cos + along * sin,
                y_mm: y + along * cos - across * sin,
                pressure: pressure * (style.strokes.lift + (1.0 - style.strokes.lift) * eased),
                tilt_x_deg: 0.0,
                tilt_y_deg: 0.0,
                // At 0 the broad side runs along x. The head turns with the heading.
                twist_deg: -(angle + slope.atan()).to_degrees(),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn style(name: &str) -> Style {
        let mut style = Style::named(name).unwrap();
        style.canvas.side_cells = 120;
        style
    }

    #[test]
    fn the_same_seed_gives_the_same_strokes_and_another_seed_others() {
        for name in Style::ALL {
            let style = style(name);
            assert_eq!(strokes(&style, 5), strokes(&style, 5), "{name}");
            assert_ne!(strokes(&style, 5), strokes(&style, 6), "{name}");
        }
    }

    #[test]
    fn strokes_run_down_within_their_spread_and_stay_evenly_spaced() {
        for name in Style::ALL {
            let style = style(name);
            let made = strokes(&style, 3);
            let (across, _) = style.margins();
            let mm = (120 + 2 * across) as f64 * style.canvas.cell_mm;
            for stroke in &made {
                let ends = [stroke.samples[0], stroke.samples[stroke.samples.len() - 1]];
                let way = [ends[1].x_mm - ends[0].x_mm, ends[1].y_mm - ends[0].y_mm];
                let length = way[0].hypot(way[1]) / style.strokes.length_mm;
                let spread = style.strokes.length_spread + 1e-9;
                assert!((length - 1.0).abs() <= spread, "{name}: {length}");
                let most = 3.0 * style.strokes.angle_deg.to_radians() + 1e-9;
                assert!(way[0].atan2(way[1]).abs() <= most, "{name}: {way:?}");
            }
            let columns = (mm / style.strokes.spacing_mm).ceil();
            let first = made.iter().filter(|stroke| stroke.coat == 0).count() as f64;
            assert!(first >= columns, "{name}: {first} strokes in {columns} columns");
        }
    }

    #[test]
    fn heads_turn_with_a_bent_stroke() {
        let mut style = style("oil-long");
        (style.strokes.bend, style.strokes.angle_deg) = (0.2, 0.0);
        for stroke in strokes(&style, 1) {
            for pair in stroke.samples.windows(2) {
                let way = [pair[1].x_mm - pair[0].x_mm, pair[1].y_mm - pair[0].y_mm];
                let heading = -way[0].atan2(way[1]).to_degrees();
                let twist = (pair[0].twist_deg + pair[1].twist_deg) / 2.0;
                assert!((twist - heading).abs() < 2.0, "{twist} for {heading}");
            }
        }
    }

    #[test]
    fn ranks_thin_the_strokes_out_evenly() {
        let mut style = style("hatching");
        style.canvas.side_cells = 600;
        let made = strokes(&style, 1);
        for share in [0.1, 0.35, 0.7] {
            let kept = made.iter().filter(|stroke| stroke.rank < share).count();
            let found = kept as f64 / made.len() as f64;
            assert!((found - share).abs() < 0.04, "{share}: {found}");
        }
    }
}
