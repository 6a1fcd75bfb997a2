//! Draws the quick palette and reads the painter's answer.

use eframe::egui::{
    Align2, Area, Color32, Context, FontId, Id, Key, Order, PointerButton, Pos2, Rect, Role, Sense,
    Shape, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use super::choice::QuickChoice;
use super::ring::Ring;
use crate::theme;

/// Radius of the middle, in points.
const MIDDLE: f32 = 46.0;

/// Widths of the rings of tubes, mixtures and sizes, in points: each is wider than a finger.
const WIDTHS: [f32; 3] = [58.0, 52.0, 48.0];

/// Share of the width of a tube's wedge that shows its masstone; the rest shows its tint.
const MASSTONE: f32 = 0.68;

/// Side of the target of a wedge for accessibility, in points.
const TARGET: f32 = 44.0;

/// Time after which an opening key counts as held, in seconds.
const HOLD_SECONDS: f64 = 0.35;

/// Largest dot that stands for a brush size, as a radius in points.
const LARGEST_DOT: f32 = 19.0;

/// The open menu.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::app) struct QuickPalette {
    center: Pos2,
    opened: f64,
    /// Whether it was opened by the secondary button, whose release over a wedge chooses.
    by_button: bool,
    choices: [Vec<QuickChoice>; 3],
    /// Colour in the middle: what the brush holds.
    held: Option<[u8; 3]>,
}

/// The painter's answer.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::app) enum QuickAnswer {
    /// One of the choices.
    Chosen(QuickChoice),
    /// Nothing; the menu closes.
    Closed,
}

impl QuickPalette {
    /// Opens the menu around a point, moved so that it fits into the window.
    pub(in crate::app) fn at(
        context: &Context,
        point: Pos2,
        by_button: bool,
        choices: [Vec<QuickChoice>; 3],
        held: Option<[u8; 3]>,
    ) -> Self {
        let room = context.content_rect().shrink(radius(&choices) + 4.0);
        let within = |at: f32, low: f32, high: f32| {
            if low < high { at.clamp(low, high) } else { 0.5 * (low + high) }
        };
        let center = pos2(
            within(point.x, room.left(), room.right()),
            within(point.y, room.top(), room.bottom()),
        );
        let opened = context.input(|input| input.time);
        Self { center, opened, by_button, choices, held }
    }

    /// Draws the menu over the whole window, which takes no other input meanwhile. `opening` are the
    /// keys that open it; one that was held chooses when it is let go.
    pub(in crate::app) fn show(&self, context: &Context, opening: &[Key]) -> Option<QuickAnswer> {
        let whole = context.content_rect();
        let area = Area::new(Id::unique("quick palette")).order(Order::Foreground);
        let shown = area.fixed_pos(whole.min).constrain(false).show(context, |ui| {
            ui.set_clip_rect(whole);
            ui.allocate_rect(whole, Sense::click_and_drag());
            self.draw(ui)
        });
        let by_name = shown.inner.map(QuickAnswer::Chosen);
        by_name.or_else(|| self.answer(context, opening))
    }

    /// The answer by pointer and keys.
    fn answer(&self, context: &Context, opening: &[Key]) -> Option<QuickAnswer> {
        let (escape, let_go, released, secondary, pointer, now) = context.input(|input| {
            let pointer = &input.pointer;
            (
                input.key_pressed(Key::Escape),
                opening.iter().any(|key| input.key_released(*key)),
                pointer.button_released(PointerButton::Primary),
                pointer.button_released(PointerButton::Secondary),
                pointer.latest_pos(),
                input.time,
            )
        });
        // The click on a menu entry that opened it is still being let go.
        if now <= self.opened {
            return None;
        }
        if escape {
            return Some(QuickAnswer::Closed);
        }
        let chosen = pointer.and_then(|point| self.choice_at(point)).cloned();
        let held = now - self.opened > HOLD_SECONDS;
        let dragged = secondary && self.by_button;
        if !(released || dragged || (let_go && held && chosen.is_some())) {
            return None;
        }
        // A short click of the secondary button leaves the menu open.
        let inside = pointer.is_some_and(|point| point.distance(self.center) < MIDDLE);
        if inside && dragged && !released {
            return None;
        }
        Some(chosen.map_or(QuickAnswer::Closed, QuickAnswer::Chosen))
    }

    /// Rings with their choices from the inside; empty ones are left out.
    fn rings(&self) -> impl Iterator<Item = (Ring, &Vec<QuickChoice>)> {
        let mut inner = MIDDLE;
        let filled = WIDTHS.iter().zip(&self.choices).filter(|(_, choices)| !choices.is_empty());
        filled.map(move |(width, choices)| {
            let ring = Ring { inner, outer: inner + width, count: choices.len() };
            inner += width;
            (ring, choices)
        })
    }

    fn choice_at(&self, point: Pos2) -> Option<&QuickChoice> {
        self.rings().find_map(|(ring, choices)| choices.get(ring.wedge_at(point - self.center)?))
    }

    /// Draws all wedges. Returns the choice that was activated by its name.
    fn draw(&self, ui: &mut Ui) -> Option<QuickChoice> {
        let colors = theme::colors(ui.ctx());
        let painter = ui.painter().clone();
        let edge = Stroke::new(1.0, colors.line);
        painter.circle(self.center, radius(&self.choices) + 4.0, colors.panel, edge);
        let pointer = ui.input(|input| input.pointer.latest_pos());
        let below = pointer.and_then(|point| self.choice_at(point));
        let mut activated = None;
        for (at, (ring, choices)) in self.rings().enumerate() {
            for (index, choice) in choices.iter().enumerate() {
                let middle = self.center + ring.middle(index);
                let target = Rect::from_center_size(middle, Vec2::splat(TARGET));
                let id = Id::unique(("quick palette", at, index));
                let response = ui.interact(target, id, Sense::click());
                response.widget_info(|| WidgetInfo::labeled(Role::Button, true, choice.name()));
                if response.clicked() {
                    activated = Some(choice.clone());
                }
                let fill = match choice {
                    QuickChoice::Tube { color, .. } | QuickChoice::Mixture { color, .. } => {
                        screen(*color)
                    }
                    QuickChoice::Size(_) => colors.well,
                };
                painter.add(Shape::mesh(ring.mesh(self.center, index, fill)));
                if let QuickChoice::Tube { tint: Some(tint), .. } = choice {
                    let inner = ring.inner + MASSTONE * (ring.outer - ring.inner);
                    let rim = Ring { inner, ..ring };
                    painter.add(Shape::mesh(rim.mesh(self.center, index, screen(*tint))));
                }
                let outline = ring.outline(self.center, index);
                painter.add(Shape::closed_line(outline, Stroke::new(1.0, colors.line)));
                if let QuickChoice::Size(mm) = choice {
                    self.size(ui, middle, *mm);
                }
                if below == Some(choice) || response.has_focus() {
                    let line = Stroke::new(3.0, colors.strong);
                    painter.add(Shape::closed_line(ring.outline(self.center, index), line));
                }
            }
        }
        let held = self.held.map_or(colors.well, screen);
        painter.circle(self.center, MIDDLE - 8.0, held, Stroke::new(1.0, colors.line));
        if let Some(choice) = below {
            self.label(ui, &choice.label());
        }
        activated
    }

    /// Draws a dot that grows with the size of a brush, and the size in mm.
    fn size(&self, ui: &Ui, middle: Pos2, mm: f64) {
        let colors = theme::colors(ui.ctx());
        let radius = (1.0 + 2.8 * (mm as f32).sqrt()).min(LARGEST_DOT);
        ui.painter().circle_filled(middle - vec2(0.0, 3.0), 0.75 * radius, colors.text);
        let font = FontId::proportional(10.0);
        let at = middle + vec2(0.0, 16.0);
        ui.painter().text(at, Align2::CENTER_CENTER, format!("{mm}"), font, colors.text);
    }

    /// Draws the name of the choice below the pointer under the menu, or over it at the lower edge.
    fn label(&self, ui: &Ui, words: &str) {
        let colors = theme::colors(ui.ctx());
        let whole = ui.ctx().content_rect();
        let away = radius(&self.choices) + 20.0;
        let side = if self.center.y + away + 14.0 < whole.bottom() { 1.0 } else { -1.0 };
        let at = self.center + vec2(0.0, side * away);
        let galley = ui.painter().layout_no_wrap(
            words.to_owned(),
            FontId::proportional(14.0),
            colors.strong,
        );
        let rect = Align2::CENTER_CENTER.anchor_size(at, galley.size());
        ui.painter().rect_filled(rect.expand2(vec2(9.0, 4.0)), theme::CORNER_RADIUS, colors.bar);
        ui.painter().galley(rect.min, galley, colors.strong);
    }
}

/// Outer radius of all rings that are not empty.
fn radius(choices: &[Vec<QuickChoice>; 3]) -> f32 {
    let filled = WIDTHS.iter().zip(choices).filter(|(_, choices)| !choices.is_empty());
    MIDDLE + filled.map(|(width, _)| width).sum::<f32>()
}

fn screen([red, green, blue]: [u8; 3]) -> Color32 {
    Color32::from_rgb(red, green, blue)
}
