//! The guided tour as data: its steps, the facts about a painting that show whether you did a step,
//! and the current step. [`callout`] outlines a part of the window beside a few lines of text.

use eframe::egui::text::{LayoutJob, TextFormat};
use eframe::egui::{Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, vec2};
use paint::document::Lighting;
use session::PaintingState;

use crate::app::intent::Intent;
use crate::language::{tr, tr_format};
use crate::panels::Mode;
use crate::theme;

/// From this share of medium in the paint of a brush, its film is a glaze.
const GLAZE: f64 = 0.9;

/// If the paint on a brush grows by more than this, in mm, you have loaded it.
const LOAD_MM: f64 = 0.01;

/// Your actions in a painting, as far as the tour needs them.
#[derive(Debug, Clone, PartialEq)]
pub struct Facts {
    /// Name of each brush, and height of its paint in mm.
    loads: Vec<(String, f64)>,
    strokes: usize,
    mixing_strokes: usize,
    dryings: usize,
    /// Whether the last stroke on the canvas laid a glaze over dry paint.
    glazed: bool,
    lighting: Lighting,
}

impl Facts {
    /// The facts of a painting, from its brushes, its light and the actions that you did not undo.
    #[must_use]
    pub fn of(painting: &PaintingState) -> Self {
        let done = &painting.history[..painting.history_done.min(painting.history.len())];
        let count = |start: &str| done.iter().filter(|label| label.starts_with(start)).count();
        let last = done.iter().rev().find_map(|label| label.strip_prefix("stroke, "));
        Self {
            loads: painting
                .brushes
                .iter()
                .map(|brush: &session::BrushState| (brush.name.clone(), brush.amount_mm))
                .collect(),
            strokes: count("stroke, "),
            mixing_strokes: count("stroke on the palette"),
            dryings: count("dry "),
            glazed: !painting.layers.is_empty()
                && last.is_some_and(|brush| {
                    let mut brushes = painting.brushes.iter();
                    brushes.any(|state| state.name == brush && state.vehicle >= GLAZE)
                }),
            lighting: painting.lighting.clone(),
        }
    }

    fn loaded_since(&self, before: &Self) -> bool {
        self.loads.iter().any(|(name, mm)| {
            let held = before.loads.iter().find(|(known, _)| known == name);
            *mm > held.map_or(0.0, |(_, mm)| *mm) + LOAD_MM
        })
    }

    fn painted_since(&self, before: &Self) -> bool {
        self.strokes > before.strokes
    }

    fn mixed_since(&self, before: &Self) -> bool {
        self.mixing_strokes > before.mixing_strokes
    }

    fn dried_since(&self, before: &Self) -> bool {
        self.dryings > before.dryings
    }

    fn glazed_since(&self, before: &Self) -> bool {
        self.painted_since(before) && self.glazed
    }

    fn relit_since(&self, before: &Self) -> bool {
        self.lighting != before.lighting
    }

    /// Lowers each count that is higher than in `now`. Undo removes actions, and the oldest leave
    /// the history when its memory is full. If you washed a brush, you can load it again.
    fn lower_to(&mut self, now: &Self) {
        self.strokes = self.strokes.min(now.strokes);
        self.mixing_strokes = self.mixing_strokes.min(now.mixing_strokes);
        self.dryings = self.dryings.min(now.dryings);
        for (name, mm) in &mut self.loads {
            let held = now.loads.iter().find(|(known, _)| known == name);
            *mm = mm.min(held.map_or(0.0, |(_, mm)| *mm));
        }
    }
}

/// A step of the guided tour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TourStep {
    /// Load paint from a tube on the brush.
    Load,
    /// Paint a stroke on the canvas.
    Paint,
    /// Paint a stroke through paint on the palette.
    Mix,
    /// Dry the wet paint.
    Dry,
    /// Lay a film of much medium over dry paint.
    Glaze,
    /// Put the painting under another light.
    Relight,
}

impl TourStep {
    /// All steps in their order.
    pub const ALL: [Self; 6] =
        [Self::Load, Self::Paint, Self::Mix, Self::Dry, Self::Glaze, Self::Relight];

    /// Title of the step.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Load => "Load the brush",
            Self::Paint => "Paint a stroke",
            Self::Mix => "Mix on the palette",
            Self::Dry => "Dry the paint",
            Self::Glaze => "Lay a glaze",
            Self::Relight => "Change the light",
        }
    }

    /// Two lines that explain the step. `key` returns the text of the key of an intent, or an empty
    /// text.
    #[must_use]
    pub fn lines(self, key: impl Fn(Intent) -> String) -> [String; 2] {
        let beside = |intent| match key(intent) {
            key if key.is_empty() => String::new(),
            key => format!(" ({key})"),
        };
        match self {
            Self::Load => [
                tr("Double click a tube: its paint is added to the brush.").to_owned(),
                tr("The Brush tab shows how much is on it, and its colour.").to_owned(),
            ],
            Self::Paint => [
                tr("Press on the canvas and draw.").to_owned(),
                tr("The brush empties, so load it again when it gets dry.").to_owned(),
            ],
            Self::Mix => [
                tr("Click a tube, then the palette, and so another: two heaps.").to_owned(),
                tr_format!(
                    "Choose Paint{key} and draw through both with the brush.",
                    key = beside(Intent::Tool(Mode::Paint))
                ),
            ],
            Self::Dry => [
                match key(Intent::Dry) {
                    key if key.is_empty() => tr("Press this button.").to_owned(),
                    key => tr_format!("Press {key}, or this button.", key),
                },
                tr("The wet paint becomes a dry layer that later strokes do not move.").to_owned(),
            ],
            Self::Glaze => [
                tr_format!(
                    "Wash{key}, set Medium to 99 % and Load to 0.10 mm, load a tube,",
                    key = beside(Intent::Wash)
                ),
                tr("and draw over dry paint: a thin film that it shines through.").to_owned(),
            ],
            Self::Relight => [
                match key(Intent::OtherLight) {
                    key if key.is_empty() => {
                        tr("Choose another light in the Light tab.").to_owned()
                    }
                    key => tr_format!(
                        "Press {key} for the light of a bulb, or choose one in the Light tab.",
                        key
                    ),
                },
                tr("The pigments change as real ones would.").to_owned(),
            ],
        }
    }

    /// Whether you did the step between the facts `before` and `now`.
    #[must_use]
    pub fn is_done(self, before: &Facts, now: &Facts) -> bool {
        match self {
            Self::Load => now.loaded_since(before),
            Self::Paint => now.painted_since(before),
            Self::Mix => now.mixed_since(before),
            Self::Dry => now.dried_since(before),
            Self::Glaze => now.glazed_since(before),
            Self::Relight => now.relit_since(before),
        }
    }
}

/// The guided tour. You can leave it and continue with the same step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tour {
    running: bool,
    at: usize,
    /// The painting at the start of the step; `None` before we have seen it.
    begun: Option<Facts>,
    done: [bool; TourStep::ALL.len()],
}

impl Tour {
    /// Starts the tour, or continues where you left it. If it had ended, it starts again.
    pub fn start(&mut self) {
        if self.at == TourStep::ALL.len() {
            *self = Self::default();
        }
        (self.running, self.begun) = (true, None);
    }

    /// Leaves the tour.
    pub fn leave(&mut self) {
        self.running = false;
    }

    /// Whether you see the tour.
    #[must_use]
    pub fn is_running(&self) -> bool {
        self.running
    }

    /// The current step; `None` while the tour is not running, and after the last step.
    #[must_use]
    pub fn step(&self) -> Option<TourStep> {
        TourStep::ALL.get(self.at).copied().filter(|_| self.running)
    }

    /// Index of the step from 0. At the end this is the number of steps.
    #[must_use]
    pub fn number(&self) -> usize {
        self.at
    }

    /// Which steps you have done.
    #[must_use]
    pub fn done(&self) -> [bool; TourStep::ALL.len()] {
        self.done
    }

    /// Looks at the painting, and continues if you did the step. Returns whether you did.
    pub fn observe(&mut self, now: Facts) -> bool {
        let Some(step) = self.step() else { return false };
        let Some(begun) = &mut self.begun else {
            self.begun = Some(now);
            return false;
        };
        if step.is_done(begun, &now) {
            self.done[self.at] = true;
            (self.at, self.begun) = (self.at + 1, Some(now));
            return true;
        }
        begun.lower_to(&now);
        false
    }

    /// Call this when another painting was opened, because you did not do its actions.
    pub fn forget(&mut self) {
        self.begun = None;
    }

    /// Continues without doing the step.
    pub fn next(&mut self) {
        (self.at, self.begun) = ((self.at + 1).min(TourStep::ALL.len()), None);
    }

    /// Goes back by a step.
    pub fn back(&mut self) {
        (self.at, self.begun) = (self.at.saturating_sub(1), None);
    }
}

const MARGIN: f32 = 9.0;

const ARROW: f32 = 8.0;

/// Side of a plate that has the arrow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Arrow {
    None,
    Down,
}

/// Draws lines of text on a plate, at most `width` points wide. `at` is the middle of the plate's
/// upper edge, or the tip of its arrow. Returns the rectangle of the plate.
pub(super) fn plate(
    painter: &Painter,
    at: Pos2,
    arrow: Arrow,
    width: f32,
    lines: &[String],
) -> Rect {
    let colors = theme::colors(painter.ctx());
    let mut job = LayoutJob::default();
    for (index, line) in lines.iter().enumerate() {
        let format = TextFormat::simple(FontId::proportional(13.0), colors.strong);
        let spacing = if index > 0 { "\n" } else { "" };
        job.append(&format!("{spacing}{line}"), 0.0, format);
    }
    job.wrap.max_width = width - 2.0 * MARGIN;
    let laid = painter.layout_job(job);
    let size = laid.size() + vec2(2.0, 2.0) * MARGIN;
    let top = match arrow {
        Arrow::None => at.y,
        Arrow::Down => at.y - ARROW - size.y,
    };
    let plate = Rect::from_min_size(Pos2::new(at.x - 0.5 * size.x, top).round(), size);
    // The plate is nearly opaque, so that you can read it over any picture.
    let fill = colors.panel.gamma_multiply(0.94);
    painter.rect(plate, 6, fill, Stroke::new(1.0, colors.line), StrokeKind::Inside);
    if arrow == Arrow::Down {
        let tip = [vec2(-ARROW, -ARROW), vec2(ARROW, -ARROW), vec2(0.0, 0.0)].map(|part| at + part);
        painter.add(Shape::convex_polygon(tip.to_vec(), fill, Stroke::NONE));
    }
    painter.galley(plate.min + vec2(MARGIN, MARGIN), laid, colors.strong);
    plate
}

/// Draws an outline around a part of the window. You see it on light and on dark.
pub(super) fn outline(painter: &Painter, part: Rect) {
    for (width, color) in [(5.0, Color32::from_black_alpha(150)), (2.0, Color32::WHITE)] {
        painter.rect_stroke(part, 6, Stroke::new(width, color), StrokeKind::Middle);
    }
}
