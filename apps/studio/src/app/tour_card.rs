//! Shows the guided tour: a card with the step, and an outline around its place.

use eframe::egui::{
    Align2, Area, Color32, Context, Frame, Id, LayerId, Order, Pos2, Rect, RichText, Sense, Stroke,
    Ui, vec2,
};

use super::callout::outline;
use super::guide::{Facts, TourStep};
use super::intent::Intent;
use super::places::{self, Part};
use super::side::Tab;
use super::studio::Studio;
use crate::floating;
use crate::keymap::text;
use crate::language::{tr, tr_format};
use crate::theme;

/// Width of the card's contents, in points.
const WIDTH: f32 = 392.0;

/// Distance of the card from the place that it speaks of, in points.
const GAP: f32 = 12.0;

/// A button of the card.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Pressed {
    Back,
    Next,
    Leave,
}

impl Studio {
    /// Starts the tour, or goes on where it was left.
    pub(super) fn start_tour(&mut self) {
        self.tour.start();
        self.visible.panels = true;
        self.visible.palette = true;
    }

    /// Shows the tour and carries out its buttons. Escape leaves it.
    pub(super) fn show_tour(&mut self, context: &Context) {
        if !self.tour.is_running() {
            return;
        }
        match &self.painting {
            // What a recording paints is not done by the painter.
            _ if self.files.is_playing() => self.tour.forget(),
            Some(painting) => {
                self.tour.observe(Facts::of(painting));
            }
            None => {}
        }
        let place = self.tour.step().and_then(|step| self.place_of(step, context));
        let dialog = context.memory(|memory| memory.top_modal_layer().is_some());
        if let Some((place, ..)) = place.filter(|_| !dialog) {
            let layer = LayerId::new(Order::Foreground, Id::unique("place of the tour"));
            outline(&context.layer_painter(layer), place.shrink(2.0));
        }
        let canvas = self.canvas.rect();
        let at_canvas = (canvas.right_top() + vec2(-GAP, GAP), Align2::RIGHT_TOP);
        let (at, pivot) = place.map_or(at_canvas, |(_, at, pivot)| (at, pivot));
        // Beside the toolbar, whose buttons it would hide, and above the status line.
        let room = floating::room(context);
        let left = self.canvas.rect().left().clamp(room.left(), room.right());
        let area = Area::new(Id::unique("tour"))
            .order(Order::Foreground)
            .pivot(pivot)
            .fixed_pos(at)
            .constrain_to(room.with_min_x(left));
        let pressed = area.show(context, |ui| {
            Frame::popup(ui.style()).inner_margin(10).show(ui, |ui| self.tour_card(ui)).inner
        });
        let left = floating::take_escape(context).then_some(Pressed::Leave);
        match pressed.inner.or(left) {
            Some(Pressed::Back) => self.tour.back(),
            Some(Pressed::Next) => self.tour.next(),
            Some(Pressed::Leave) => {
                self.tour.leave();
                let hint = tr("Help, Guided tour goes on with it").to_owned();
                self.show_message(tr("the tour was left").to_owned(), Some(hint), false);
            }
            None => {}
        }
    }

    /// Place that a step points at, and where its card is: a corner or side of the card, and the
    /// point that it lies at.
    fn place_of(&self, step: TourStep, context: &Context) -> Option<(Rect, Pos2, Align2)> {
        let above =
            |place: Rect| (place, place.center_top() - vec2(0.0, GAP), Align2::CENTER_BOTTOM);
        let tab = |tab: Tab| {
            let place = places::rect(context, Part::Tab(tab.name()))?;
            let canvas = self.canvas.rect();
            let left = canvas.right() - GAP;
            // Beside a tab low in the window the card would hide the tubes.
            if place.top() > canvas.center().y {
                return Some((place, Pos2::new(left, canvas.bottom() - GAP), Align2::RIGHT_BOTTOM));
            }
            Some((place, Pos2::new(left, place.top()), Align2::RIGHT_TOP))
        };
        match step {
            TourStep::Load => places::rect(context, Part::Tubes).map(above),
            TourStep::Mix => Some(above(self.palette.rect())),
            TourStep::Paint => {
                let canvas = self.canvas.rect();
                Some((canvas, canvas.right_top() + vec2(-GAP, GAP), Align2::RIGHT_TOP))
            }
            TourStep::Dry => {
                let place = places::rect(context, Part::Button(Intent::Dry))?;
                Some((place, place.right_center() + vec2(GAP, 0.0), Align2::LEFT_CENTER))
            }
            TourStep::Glaze => tab(Tab::Brush),
            TourStep::Relight => tab(Tab::Light),
        }
    }

    /// Draws the card. Returns the button that was pressed.
    fn tour_card(&self, ui: &mut Ui) -> Option<Pressed> {
        ui.set_width(WIDTH);
        let number = self.tour.number();
        let of = TourStep::ALL.len();
        match self.tour.step() {
            Some(step) => {
                ui.horizontal(|ui| {
                    ui.label(RichText::new(tr(step.title())).heading().strong());
                    ui.weak(tr_format!("step {number} of {of}", number = number + 1, of));
                });
                for line in
                    step.lines(|intent: Intent| text(ui.ctx(), &intent.name()).unwrap_or_default())
                {
                    ui.label(line);
                }
            }
            None => {
                ui.label(RichText::new(tr("That was the tour")).heading().strong());
                ui.label(tr("What was painted stays. Help, Keys lists all keys."));
            }
        }
        ui.add_space(4.0);
        let mut pressed = None;
        ui.horizontal(|ui| {
            self.dots(ui);
            let back = ui.add_enabled(number > 0, eframe::egui::Button::new(tr("Back")));
            if back.on_hover_text(tr("The step before")).clicked() {
                pressed = Some(Pressed::Back);
            }
            if number < of
                && ui.button(tr("Next")).on_hover_text(tr("Goes on without it")).clicked()
            {
                pressed = Some(Pressed::Next);
            }
            let leave = if number < of { tr("Leave the tour") } else { tr("Close the tour") };
            if ui
                .button(leave)
                .on_hover_text(tr("Help, Guided tour shows it again (Esc)"))
                .clicked()
            {
                pressed = Some(Pressed::Leave);
            }
        });
        pressed
    }

    /// Draws a dot for each step, full if it was done.
    fn dots(&self, ui: &mut Ui) {
        let colors = theme::colors(ui.ctx());
        ui.spacing_mut().item_spacing.x = 3.0;
        for (index, done) in self.tour.done().into_iter().enumerate() {
            let (rect, _) = ui.allocate_exact_size(vec2(9.0, 16.0), Sense::hover());
            let here = index == self.tour.number();
            let edge = Stroke::new(if here { 2.0 } else { 1.0 }, colors.text);
            let fill = if done { colors.text } else { Color32::TRANSPARENT };
            ui.painter().circle(rect.center(), 4.0, fill, edge);
        }
        ui.spacing_mut().item_spacing.x = 6.0;
        ui.add_space(4.0);
    }
}
