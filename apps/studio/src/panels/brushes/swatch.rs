//! The large swatch of what the selected brush holds, with its colour in numbers.

use eframe::egui::{
    Align, Color32, CornerRadius, Layout, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui,
    WidgetInfo, pos2, vec2,
};

use crate::language::{tr, tr_format};
use crate::panels::controls::{millimetres, named_button};
use crate::theme;
use session::{BrushState, BrushSwatch, FilmColor};

/// Height of the swatch, in points.
const HEIGHT: f32 = 50.0;

/// Height of the bare edge of ground and cards above and below the film, in points.
const EDGE: f32 = 7.0;

/// Draws the paint of a brush: at the left as a film that hides, at the right as the film that it
/// lays now, over the ground and over a black and white card; and its colour in numbers. With
/// `film` also how thick it is, and a button. Returns whether the mixture is to be kept.
pub(super) fn show(ui: &mut Ui, brush: Option<&BrushState>, film: bool) -> bool {
    let swatch = brush.and_then(|brush| brush.swatch.as_deref());
    let size = vec2(ui.available_width(), HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, tr("Paint on the brush")));
    match swatch {
        Some(swatch) => films(ui, rect, swatch),
        None => clean(ui, rect, brush),
    }
    let line = Stroke::new(1.0, theme::colors(ui.ctx()).well);
    ui.painter().rect_stroke(rect, CornerRadius::ZERO, line, StrokeKind::Inside);
    let (Some(swatch), Some(brush)) = (swatch, brush) else { return false };
    tip(response, swatch);
    ui.scope(|ui| {
        // Nothing is clicked in this line: it is only as high as its text.
        ui.spacing_mut().interact_size.y = 0.0;
        ui.horizontal(|ui| color(ui, swatch));
    });
    film && film_line(ui, swatch, brush)
}

fn films(ui: &Ui, rect: Rect, swatch: &BrushSwatch) {
    let painter = ui.painter_at(rect);
    let (opaque, thin) = rect.split_left_right_at_fraction(0.5);
    painter.rect_filled(opaque, 0.0, screen(swatch.opaque));
    let (ground, card) = thin.split_left_right_at_fraction(0.5);
    let (black, white) = card.split_left_right_at_fraction(0.5);
    let fields = [
        (ground, swatch.ground, swatch.over_ground),
        (black, swatch.cards[0], swatch.over_cards[0]),
        (white, swatch.cards[1], swatch.over_cards[1]),
    ];
    for (field, bare, film) in fields {
        painter.rect_filled(field, 0.0, screen(bare));
        let film_rect = Rect::from_min_max(
            pos2(field.left(), field.top() + EDGE),
            pos2(field.right(), field.bottom() - EDGE),
        );
        painter.rect_filled(film_rect, 0.0, screen(film));
    }
}

fn clean(ui: &Ui, rect: Rect, brush: Option<&BrushState>) {
    let colors = theme::colors(ui.ctx());
    ui.painter().rect_filled(rect, 0.0, colors.well);
    let medium = brush.is_some_and(|brush| brush.amount_mm > 0.0);
    let words = if medium { tr("medium only") } else { tr("the brush is clean") };
    let font = eframe::egui::TextStyle::Body.resolve(ui.style());
    let middle = eframe::egui::Align2::CENTER_CENTER;
    ui.painter().text(rect.center(), middle, words, font, colors.faint);
}

fn tip(response: Response, swatch: &BrushSwatch) {
    let lab = |color: FilmColor| {
        let [l, a, b] = color.lab.to_array();
        format!("Lab {l:.1} {a:.1} {b:.1}")
    };
    response.on_hover_text(tr_format!("The paint at the tip, by its measured K and S under the light of the painting.\n\
         Left: a film that hides, {film}.\n\
         Then the film as thick as the paint at the tip: over the ground, {ground}; over a black card, \
         {black}; over a white card, {white}. Their bare edges show above and below.", film = lab(swatch.opaque), ground = lab(swatch.over_ground), black = lab(swatch.over_cards[0]), white = lab(swatch.over_cards[1])));
}

/// Thickness and medium of the film; returns whether the mixture is to be kept.
fn film_line(ui: &mut Ui, swatch: &BrushSwatch, brush: &BrushState) -> bool {
    let thickness = millimetres(swatch.thickness_mm);
    let medium = tr_format!(
        "{thickness} at the tip, {vehicle:.0} % medium",
        thickness,
        vehicle = 100.0 * brush.vehicle
    );
    let line = ui.horizontal(|ui| {
        let words = ui.weak(medium);
        words
            .on_hover_text(tr("Thickness of the film, and the share of clear medium on the brush"));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let tip = tr("Keeps what the brush holds as a mixture in the panel Swatches");
            named_button(ui, tr("Keep"), tr("Keep this mixture"), tip, None)
        })
        .inner
    });
    line.inner
}

/// The colour of the film, and how much of the ground it hides.
fn color(ui: &mut Ui, swatch: &BrushSwatch) {
    let [l, a, b] = swatch.opaque.lab.to_array();
    ui.spacing_mut().item_spacing.x = 10.0;
    let lab = ui.monospace(format!("Lab {l:.1} {a:.1} {b:.1}"));
    lab.on_hover_text(tr("CIELAB of the film that hides, under the light of the painting"));
    let hides = ui.weak(tr_format!("hides {contrast:.0} %", contrast = 100.0 * swatch.contrast));
    hides.on_hover_text(tr(
        "Contrast ratio of the film: its luminance over the black card relative to that over the \
         white one. From 98 % on it hides",
    ));
}

fn screen(color: FilmColor) -> Color32 {
    let [red, green, blue] = color.srgb;
    Color32::from_rgb(red, green, blue)
}
