//! The guided tour as data: its steps, the facts about a painting that show whether a step was
//! done, and the current step. [`callout`] outlines a part of the window beside a few lines of
//! text.

use eframe::egui::text::{LayoutJob, TextFormat};
use eframe::egui::{Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, vec2};
use paint::document::Lighting;
use session::PaintingState;

use crate::app::intent::Intent;
use crate::language::{tr, tr_format};
use crate::panels::Mode;
use crate::theme;

/// Share of medium in the paint of a brush from which its film is a glaze.
const GLAZE: f64 = 0.9;

/// Paint on a brush, in mm, above which more of it is a load.
const LOAD_MM: f64 = 0.01;

/// Actions done to a painting, as far as the tour looks at them.
#[derive(Debug, Clone, PartialEq)]
pub struct Facts {
    /// Name of each brush, and height of its paint in mm.
    loads: Vec<(String, f64)>,
    /// Number of strokes on the canvas.
    strokes: usize,
    /// Number of strokes on the palette.
    mixing_strokes: usize,
    /// Number of dryings.
    dryings: usize,
    /// Whether the last stroke on the canvas laid a glaze over dry paint.
    glazed: bool,
    lighting: Lighting,
}

impl Facts {
    /// The facts of a painting, from its brushes, light and the actions that are not undone.
    #[must_use]
    pub fn of(painting: &PaintingState) -> Self {
        let done = &painting.history[..painting.history_done.min(painting.history.len())];
        let count = |start: &str| done.iter().filter(|label| label.starts_with(start)).count();
        let last = done.iter().rev().find_map(|label| label.strip_prefix("stroke, "));
        let is_glaze = |brush: &str| {
            let mut brushes = painting.brushes.iter();
            brushes.any(|state| state.name == brush && state.vehicle >= GLAZE)
        };
        Self {
            loads: painting
                .brushes
                .iter()
                .map(|brush: &session::BrushState| (brush.name.clone(), brush.amount_mm))
                .collect(),
            strokes: count("stroke, "),
            mixing_strokes: count("stroke on the palette"),
            dryings: count("dry "),
            glazed: !painting.layers.is_empty() && last.is_some_and(is_glaze),
            lighting: painting.lighting.clone(),
        }
    }

    /// Whether a brush holds more paint than `before`.
    fn loaded_since(&self, before: &Self) -> bool {
        self.loads.iter().any(|(name, mm)| {
            let held = before.loads.iter().find(|(known, _)| known == name);
            *mm > held.map_or(0.0, |(_, mm)| *mm) + LOAD_MM
        })
    }

    /// Whether there was a stroke on the canvas since `before`.
    fn painted_since(&self, before: &Self) -> bool {
        self.strokes > before.strokes
    }

    /// Whether there was a stroke on the palette since `before`.
    fn mixed_since(&self, before: &Self) -> bool {
        self.mixing_strokes > before.mixing_strokes
    }

    /// Whether paint was dried since `before`.
    fn dried_since(&self, before: &Self) -> bool {
        self.dryings > before.dryings
    }

    /// Whether there was a stroke of a glaze over dry paint since `before`.
    fn glazed_since(&self, before: &Self) -> bool {
        self.painted_since(before) && self.glazed
    }

    /// Whether the light changed since `before`.
    fn relit_since(&self, before: &Self) -> bool {
        self.lighting != before.lighting
    }

    /// Lowers the counts to those of `now`: undo takes actions away, and the oldest leave the
    /// history when its memory is full. A brush that was washed can be loaded again.
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
    /// Paint from a tube on the brush.
    Load,
    /// A stroke on the canvas.
    Paint,
    /// A stroke through paint on the palette.
    Mix,
    /// The wet paint dries.
    Dry,
    /// A film of much medium over dry paint.
    Glaze,
    /// Another light over the painting.
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

    /// Two lines that say how it is done. `key` is the text of the key of an intent; empty if it has
    /// none.
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

    /// Whether the step was done between the facts `before` and `now`.
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

/// The guided tour. It can be left and goes on with the same step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tour {
    running: bool,
    /// Index of the step; the number of steps at the end.
    at: usize,
    /// The painting when the step began; `None` before the painting was seen.
    begun: Option<Facts>,
    done: [bool; TourStep::ALL.len()],
}

impl Tour {
    /// Starts the tour, or goes on where it was left; from the start if it had ended.
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

    /// Whether the tour is shown.
    #[must_use]
    pub fn is_running(&self) -> bool {
        self.running
    }

    /// The step that is shown; `None` while the tour is not running, and after the last step.
    #[must_use]
    pub fn step(&self) -> Option<TourStep> {
        TourStep::ALL.get(self.at).copied().filter(|_| self.running)
    }

    /// Index of the step from 0; the number of steps at the end.
    #[must_use]
    pub fn number(&self) -> usize {
        self.at
    }

    /// Which steps were done.
    #[must_use]
    pub fn done(&self) -> [bool; TourStep::ALL.len()] {
        self.done
    }

    /// Looks at the painting, and goes on if the step was done. Returns whether it was.
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

    /// Another painting was opened: what it holds is not done by the painter.
    pub fn forget(&mut self) {
        self.begun = None;
    }

    /// Goes on without doing the step.
    pub fn next(&mut self) {
        (self.at, self.begun) = ((self.at + 1).min(TourStep::ALL.len()), None);
    }

    /// Goes back by a step.
    pub fn back(&mut self) {
        (self.at, self.begun) = (self.at.saturating_sub(1), None);
    }
}

/// Room around the text, in points.
const MARGIN: f32 = 9.0;

/// Half width and height of the arrow, in points.
const ARROW: f32 = 8.0;

/// Side of a plate at which it points to its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Arrow {
    /// It points nowhere.
    None,
    /// Down, from the middle of the lower edge.
    Down,
}

/// Draws lines on a plate, at most `width` points wide. `at` is the middle of its upper edge, or
/// the tip of its arrow. Returns the rectangle of the plate.
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
    // Nearly opaque, so that it is read over any picture.
    let fill = colors.panel.gamma_multiply(0.94);
    painter.rect(plate, 6, fill, Stroke::new(1.0, colors.line), StrokeKind::Inside);
    if arrow == Arrow::Down {
        let tip = [vec2(-ARROW, -ARROW), vec2(ARROW, -ARROW), vec2(0.0, 0.0)].map(|part| at + part);
        painter.add(Shape::convex_polygon(tip.to_vec(), fill, Stroke::NONE));
    }
    painter.galley(plate.min + vec2(MARGIN, MARGIN), laid, colors.strong);
    plate
}

/// Draws an outline around a part of the window, seen on light and on dark.
pub(super) fn outline(painter: &Painter, part: Rect) {
    for (width, color) in [(5.0, Color32::from_black_alpha(150)), (2.0, Color32::WHITE)] {
        painter.rect_stroke(part, 6, Stroke::new(width, color), StrokeKind::Middle);
    }
}
