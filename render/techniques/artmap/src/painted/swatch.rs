//! Painting of one swatch: the strokes of a tone on a canvas of their own, without its margins.

use std::sync::Arc;

use graphics::tile::Rect;
use paint::amount::{quanta_from_mm, share_of_65536};
use paint::document::{Document, Lighting, Medium};
use paint::engine::{BrushId, PaintEngine};
use paint::ground::{Ground, GroundError};
use paint::layer::{Cell, Layer, SLOTS};
use paint::light::Light;
use paint::painting::{Painting, PaintingError};

use super::brushwork::SwatchStroke;
use super::plan::{Style, ToneSource};
use super::tones::{Tone, ToneLadder};
use crate::sample::Sample;
use crate::sample::from_painting::{level_colors, summed_height, summed_paint};
use graphics::field::Field;

/// Everything that the swatches of a set share.
#[derive(Debug)]
pub(super) struct Workplace<'a> {
    pub(super) style: &'a Style,
    pub(super) ladder: &'a ToneLadder,
    pub(super) ground: Ground,
    pub(super) light: Arc<Light>,
}

/// Greatest deviation of the paint of a style from its tone, in L*.
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

    /// Shares by slot of the mixture that deviates by about `lightness` L* from the tone.
    fn shares(&self, lightness: f64) -> [f64; SLOTS] {
        let [dark, light] = &self.ends;
        let share = (0.5 + lightness / (2.0 * self.spread).max(1e-9)).clamp(0.0, 1.0);
        std::array::from_fn(|slot| dark[slot] + share * (light[slot] - dark[slot]))
    }
}

/// Ground of the canvas of a swatch, with its margins.
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

    /// An even dry film of the tone, if the style has one.
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
        Some(Layer {
            pigments: Field::filled(width, height, pigments),
            vehicle: Field::filled(width, height, 0),
        })
    }

    /// Mixture of the tone number `at`, and the share of the strokes that it has.
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

    /// Loads the clean brush with the paint of a stroke: each lock of hair with a mixture between
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

    /// The middle of a painted canvas as a sample.
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

/// Paint of a head between two mixtures of equal volume: `weights` around the head, at even
/// distances, are 0 for `dark` and 1 for `light`.
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
            let blended = |a: u32, b: u32| {
                share_of_65536(a, 65536 - light_parts) + share_of_65536(b, light_parts)
            };
            let pigments = std::array::from_fn(|slot| blended(a.pigments[slot], b.pigments[slot]));
            mixed.set_cell(index, Cell { pigments, vehicle: blended(a.vehicle, b.vehicle) });
        }
    }
    mixed
}
