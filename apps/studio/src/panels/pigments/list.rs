//! A searchable list of the library's pigments.

use eframe::egui::{Align, Key, Rect, ScrollArea, TextStyle, Ui, pos2, vec2};

use super::card::card;
use super::catalogue::Catalogue;
use crate::language::{tr, tr_format};
use crate::panels::controls::{mark, patch, row};
use crate::panels::fitted_text::text;
use crate::panels::search::{self, Highlight};
use crate::theme;
use pigment::PigmentId;

/// Height of the list, in points.
const LIST: f32 = 300.0;

/// State of the list: the search text.
#[derive(Debug, Clone, Default)]
pub(in crate::panels) struct PigmentList {
    search: String,
    highlight: Highlight,
}

impl PigmentList {
    /// Draws the list. `disabled_reason` gives the reason why a pigment cannot be chosen.
    /// Returns the pigment that was clicked, or taken with Enter.
    pub(in crate::panels) fn show(
        &mut self,
        ui: &mut Ui,
        catalogue: &Catalogue,
        scattering_per_mm: f64,
        disabled_reason: impl Fn(PigmentId) -> Option<String>,
    ) -> Option<PigmentId> {
        let id = ui.scope_id().with("search of a pigment");
        self.highlight.read_arrows(ui, ui.memory(|memory| memory.has_focus(id)));
        let field = theme::text_field(&mut self.search)
            .id(id)
            .hint_text(tr("name or colour index"))
            .desired_width(f32::INFINITY);
        let field = ui.add(field).accessible_name(tr("Search")).on_hover_text(tr(
            "Lists only pigments whose name or colour index contains this text. Enter takes the \
             marked one, arrows move the mark",
        ));
        let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let searches = field.has_focus() || entered;
        heads(ui, catalogue);
        let pigments = catalogue.library.ids();
        let mut found: Vec<PigmentId> =
            pigments.filter(|&pigment| self.finds(catalogue, pigment)).collect();
        search::sort(&mut found, &self.search, |&pigment| catalogue.name(pigment));
        let marked = self.highlight.among(&self.search, found.len());
        let moved = std::mem::take(&mut self.highlight.moved);
        if found.is_empty() {
            ui.weak(tr_format!("no pigment of {title} matches", title = catalogue.library.title));
        }
        let mut chosen = None;
        let list = ScrollArea::vertical().max_height(LIST).min_scrolled_height(LIST);
        list.show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            for (line, pigment) in found.into_iter().enumerate() {
                let why = disabled_reason(pigment);
                ui.add_enabled_ui(why.is_none(), |ui| {
                    let response = row(ui, 24.0, catalogue.name(pigment), false);
                    draw(ui, response.rect, catalogue, pigment, scattering_per_mm);
                    let marked = searches && line == marked;
                    if marked {
                        mark(ui, &response, moved);
                    }
                    if response.clicked() || (marked && entered && why.is_none()) {
                        chosen = Some(pigment);
                    }
                    response
                        .on_hover_ui(|ui| card(ui, catalogue, pigment, scattering_per_mm))
                        .on_disabled_hover_text(why.unwrap_or_default());
                });
            }
        });
        chosen
    }

    fn finds(&self, catalogue: &Catalogue, pigment: PigmentId) -> bool {
        let wanted = self.search.trim().to_lowercase();
        let pigment = &catalogue.library[pigment];
        let index = pigment.color_index.as_deref().unwrap_or_default();
        pigment.name.to_lowercase().contains(&wanted) || index.to_lowercase().contains(&wanted)
    }
}

/// Rectangles of swatch, name, colour index and hiding power in a row.
fn places(rect: Rect) -> [Rect; 4] {
    let inner = rect.shrink2(vec2(4.0, 3.0));
    let between = |left: f32, right: f32| {
        Rect::from_min_max(pos2(left, inner.top()), pos2(right, inner.bottom()))
    };
    let left = inner.left();
    let right = inner.right();
    [
        between(left, left + 40.0),
        between(left + 48.0, right - 128.0),
        between(right - 124.0, right - 72.0),
        between(right - 68.0, right),
    ]
}

fn heads(ui: &mut Ui, catalogue: &Catalogue) {
    let (rect, _) =
        ui.allocate_exact_size(vec2(ui.available_width(), 16.0), eframe::egui::Sense::hover());
    let [_, name, index, hides] = places(rect);
    let any_marked = catalogue.library.ids().any(|p| !remark(catalogue, p).is_empty());
    for (place, align, words) in [
        (name, Align::Min, tr("pigment")),
        (index, Align::Min, if any_marked { tr("index") } else { "" }),
        (hides, Align::Max, tr("hides from")),
    ] {
        text(
            ui,
            place.expand2(vec2(0.0, 3.0)),
            align,
            TextStyle::Small,
            theme::colors(ui.ctx()).faint,
            words,
        );
    }
}

fn draw(ui: &Ui, rect: Rect, catalogue: &Catalogue, pigment: PigmentId, scattering_per_mm: f64) {
    let [swatch, name, index, hides] = places(rect);
    let color =
        if ui.is_enabled() { theme::colors(ui.ctx()).text } else { theme::colors(ui.ctx()).faint };
    let colors = catalogue.colors(pigment);
    let (full, tint) = swatch.split_left_right_at_fraction(0.55);
    // A disabled row must not change the colour of its swatch.
    let mut painter = ui.painter().clone();
    painter.set_opacity(1.0);
    patch(&painter, tint, colors.tint_srgb);
    patch(&painter, full, Some(colors.masstone_srgb));
    text(ui, name, Align::Min, TextStyle::Body, color, catalogue.name(pigment));
    let marked = remark(catalogue, pigment);
    text(ui, index, Align::Min, TextStyle::Small, theme::colors(ui.ctx()).faint, marked);
    let words = catalogue.hiding(pigment, scattering_per_mm);
    text(ui, hides, Align::Max, TextStyle::Small, theme::colors(ui.ctx()).faint, &words);
}

/// The colour index, or `guessed` for a pigment that was not measured.
fn remark(catalogue: &Catalogue, pigment: PigmentId) -> &str {
    let known = &catalogue.library[pigment];
    match (&known.color_index, known.guessed) {
        (Some(index), _) => index,
        (None, true) => tr("guessed"),
        (None, false) => "",
    }
}
