//! One dry layer in the list: eye, thumbnail, name, figures, opacity and menu.

use std::sync::Arc;

use eframe::egui::containers::menu::MenuButton;
use eframe::egui::text::{CCursor, CCursorRange};
use eframe::egui::{
    Button, Color32, ColorImage, Context, Frame, Key, Label, Margin, Pos2, Rect, Response, Rgba,
    RichText, Role, Sense, Shape, Slider, SliderClamping, Stroke, TextureHandle, TextureOptions,
    Ui, UiBuilder, Vec2, WidgetInfo, pos2, vec2,
};
use paint::document::{LayerId, Slots};
use paint::layer::MAX_LAYER_NAME;
use paint::strokes::{Action, LayerRef};
use session::{Command, LayerState, Thumbnail};

use crate::language::{layer_label, tr, tr_format};
use crate::panels::PanelContext;
use crate::panels::controls::{button_background, millimetres, patch, slider};
use crate::panels::pigments::Catalogue;
use crate::theme;

const THUMBNAIL: [f32; 2] = [60.0, 44.0];

const DOTS: f32 = 16.0;

pub(super) struct RowParts<'a> {
    pub(super) naming: &'a mut Naming,
    pub(super) opacity: &'a mut Opacity,
    pub(super) thumbnails: &'a mut Thumbnails,
    pub(super) catalogue: &'a Catalogue,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct RowLook {
    pub(super) chosen: bool,
    pub(super) dragged: bool,
}

pub(super) struct DrawnRow {
    /// The row itself, below its controls.
    pub(super) response: Response,
    /// The name, unless you are editing it.
    pub(super) name: Option<Rect>,
}

/// Draws the row of a layer. `menu` fills its menu.
pub(super) fn row(
    ui: &mut Ui,
    cx: &mut PanelContext<'_>,
    parts: &mut RowParts<'_>,
    (state, look): (&LayerState, RowLook),
    menu: impl FnOnce(&mut Ui, &mut PanelContext<'_>),
) -> DrawnRow {
    let sense = Sense::click_and_drag();
    let builder = UiBuilder::new().id_salt(("dry layer", state.id.0)).sense(sense);
    let drawn = ui.scope_builder(builder, |ui| {
        let background = ui.response();
        let colors = theme::colors(ui.ctx());
        let fill = match background.hovered() {
            true => ui.visuals().widgets.hovered.bg_fill,
            false => ui.visuals().faint_bg_color,
        };
        if look.dragged {
            ui.set_opacity(0.5);
        }
        let frame = Frame::new().fill(fill).corner_radius(theme::CORNER_RADIUS);
        // We draw an edge, because the fill of chosen items would hide the rail of the slider.
        let edge = match (look.chosen, background.has_focus()) {
            (true, _) => Stroke::new(1.5, colors.strong),
            (false, true) => Stroke::new(1.5, colors.faint),
            (false, false) => Stroke::new(1.5, fill),
        };
        let frame = frame.stroke(edge).inner_margin(Margin::same(5));
        frame.show(ui, |ui| {
            ui.set_width(ui.available_width());
            let name = header(ui, cx, parts, state, menu);
            parts.opacity.slider(ui, cx, state);
            name
        })
    });
    let name = drawn.inner.inner;
    let label = tr_format!("choose {label}", label = layer_label(&state.label()));
    drawn.response.widget_info(|| WidgetInfo::selected(Role::Button, true, look.chosen, &label));
    DrawnRow { response: drawn.response, name }
}

fn header(
    ui: &mut Ui,
    cx: &mut PanelContext<'_>,
    parts: &mut RowParts<'_>,
    state: &LayerState,
    menu: impl FnOnce(&mut Ui, &mut PanelContext<'_>),
) -> Option<Rect> {
    let label = layer_label(&state.label());
    let line = ui.horizontal_top(|ui| {
        visibility(ui, cx, state);
        parts.thumbnails.show(ui, &state.thumbnail, THUMBNAIL.into());
        let spacing = ui.spacing();
        let menu_width = DOTS + 2.0 * spacing.button_padding.x + spacing.item_spacing.x;
        let room = ui.available_width() - menu_width.max(theme::target(ui));
        let name = ui.vertical(|ui| {
            ui.set_width(room.max(40.0));
            ui.spacing_mut().item_spacing.y = 2.0;
            ui.spacing_mut().interact_size.y = 14.0;
            ui.spacing_mut().button_padding.y = 0.0;
            let name = if parts.naming.is_of(state.id) {
                parts.naming.show(ui, cx, state);
                None
            } else {
                Some(name(ui, state))
            };
            let [mean, max] = [state.mean_mm, state.max_mm].map(millimetres);
            let covers = tr_format!("covers {coverage:.0} %", coverage = 100.0 * state.coverage);
            let figures = vec2(4.0, 0.0);
            ui.horizontal_wrapped(|ui| {
                ui.spacing_mut().item_spacing = figures;
                pigments(ui, parts.catalogue, &state.slots);
                small(ui, covers).on_hover_text(tr("Share of the canvas covered by this layer"));
            });
            small(ui, tr_format!("{mean}, max {max}", mean, max))
                .on_hover_text(tr("Mean height where it has paint, and maximum height"));
            name
        });
        let dots = Button::new("\u{2026}").min_size(Vec2::splat(theme::target(ui)));
        let (menu, _) = MenuButton::from_button(dots).ui(ui, |ui| menu(ui, cx));
        menu.accessible_name(tr_format!("menu of {label}", label))
            .on_hover_text(tr("Renames, moves and merges this layer"));
        name.inner
    });
    line.inner
}

fn visibility(ui: &mut Ui, cx: &mut PanelContext<'_>, state: &LayerState) {
    let response = eye(
        ui,
        &tr_format!("visibility of {label}", label = layer_label(&state.label())),
        state.visible,
    );
    if response.clicked() {
        let layer = LayerRef::Id(state.id);
        cx.act(Action::Visible { layer, value: !state.visible });
    }
    let tip = if state.visible { tr("Hides this layer") } else { tr("Shows this layer again") };
    response.on_hover_text(tr_format!("{tip}; its opacity stays, and so does its relief", tip));
}

/// Draws the whole name, on several lines if it is long.
fn name(ui: &mut Ui, state: &LayerState) -> Rect {
    let colors = theme::colors(ui.ctx());
    let color = if state.visible { colors.strong } else { colors.faint };
    let text = RichText::new(layer_label(&state.label())).strong().color(color);
    let tip =
        tr("Click chooses this layer, Ctrl+click a second one. Double click or F2 renames it. \
               Drag it to another place.");
    ui.add(Label::new(text).wrap()).on_hover_text(tip).rect
}

fn small(ui: &mut Ui, text: String) -> Response {
    ui.add(Label::new(RichText::new(text).small().weak()).extend())
}

/// Adds a clickable eye icon, open if the layer is `visible`.
pub(super) fn eye(ui: &mut Ui, name: &str, visible: bool) -> Response {
    let (rect, response) =
        ui.allocate_exact_size(theme::at_least(ui, vec2(24.0, 24.0)), Sense::click());
    button_background(ui, &response, name, false);
    let lens = Rect::from_center_size(rect.center(), vec2(16.0, 10.0));
    let color =
        if visible { theme::colors(ui.ctx()).strong } else { theme::colors(ui.ctx()).faint };
    let line = Stroke::new(1.5, color);
    ui.painter().add(Shape::line(lid(lens, 1.0), line));
    if visible {
        ui.painter().add(Shape::line(lid(lens, -1.0), line));
        ui.painter().circle_filled(rect.center(), 2.75, color);
    }
    response
}

/// Curve of the lower eyelid if `side` is 1, of the upper eyelid if it is -1.
fn lid(lens: Rect, side: f32) -> Vec<Pos2> {
    (0..=12)
        .map(|step: i16| {
            let along = f32::from(step) / 12.0;
            let bulge = 4.0 * along * (1.0 - along);
            pos2(
                lens.left() + lens.width() * along,
                lens.center().y + side * bulge * lens.height() / 2.0,
            )
        })
        .collect()
}

#[derive(Debug, Clone, Default)]
pub(super) struct Naming(Option<Edited>);

#[derive(Debug, Clone)]
struct Edited {
    layer: LayerId,
    text: String,
    /// Whether the text field has not been drawn yet.
    fresh: bool,
}

impl Naming {
    /// Begins to edit the name of a layer.
    pub(super) fn begin(&mut self, layer: &LayerState) {
        let text = layer.name.clone();
        self.0 = Some(Edited { layer: layer.id, text, fresh: true });
    }

    /// Whether you are editing the name of this layer.
    pub(super) fn is_of(&self, layer: LayerId) -> bool {
        self.0.as_ref().is_some_and(|edited| edited.layer == layer)
    }

    /// Draws the text field. Enter or a click elsewhere sets the name, Escape does not.
    pub(super) fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>, layer: &LayerState) {
        let Some(edited) = self.0.as_mut().filter(|edited| edited.layer == layer.id) else {
            return;
        };
        let field = theme::text_field(&mut edited.text);
        let field =
            field.char_limit(MAX_LAYER_NAME).hint_text(layer_label(&format!("Layer {}", layer.id)));
        let mut output = field.desired_width(ui.available_width()).show(ui);
        let response = output.response.response;
        let response = response
            .accessible_name(tr_format!("name of {label}", label = layer_label(&layer.label())));
        if std::mem::take(&mut edited.fresh) {
            response.request_focus();
            let all = CCursorRange::two(CCursor::new(0), CCursor::new(edited.text.chars().count()));
            output.state.cursor.set_char_range(Some(all));
            output.state.store(ui.ctx(), response.id);
        }
        if !response.lost_focus() {
            return;
        }
        let name: String = edited.text.chars().filter(|letter| !letter.is_control()).collect();
        let name = name.trim().to_owned();
        self.0 = None;
        if !ui.input(|input| input.key_pressed(Key::Escape)) && name != layer.name {
            cx.act(Action::Name { layer: LayerRef::Id(layer.id), name });
        }
    }
}

/// We drop an unconfirmed opacity after this time, in seconds.
const TIMEOUT_SECONDS: f64 = 1.0;

#[derive(Debug, Clone, Default)]
pub(super) struct Opacity {
    pending: Option<PendingOpacity>,
}

#[derive(Debug, Clone, Copy)]
struct PendingOpacity {
    layer: LayerId,
    value: f64,
    dragged: bool,
    until: f64,
}

impl Opacity {
    pub(super) fn slider(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>, state: &LayerState) {
        let now = ui.input(|input| input.time);
        let layer = state.id;
        let reported = state.opacity;
        self.pending = self.pending.filter(|pending| {
            pending.layer != layer
                || pending.dragged
                || (pending.until > now && (reported - pending.value).abs() > 1e-9)
        });
        let pending = self.pending.filter(|pending| pending.layer == layer);
        let shown = pending.map_or((reported * 100.0).round() / 100.0, |pending| pending.value);
        let mut value = shown;
        let control = Slider::new(&mut value, 0.0..=4.0).logarithmic(true).smallest_positive(0.02);
        let control = control.clamping(SliderClamping::Edits).max_decimals(2);
        let tip =
            tr("Factor of the layer's optical thickness: 1 as painted, 0 clear. A hidden layer \
                   keeps it");
        let response = slider(ui, tr("Opacity"), tip, control.update_while_editing(false));
        let response = response
            .accessible_name(tr_format!("opacity of {label}", label = layer_label(&state.label())));
        let dragged = response.dragged();
        if value != shown {
            let action = Action::Opacity { layer: LayerRef::Id(layer), value };
            cx.command(if dragged { Command::Adjust(action) } else { Command::Apply(action) });
            self.pending =
                Some(PendingOpacity { layer, value, dragged, until: now + TIMEOUT_SECONDS });
        }
        if let Some(pending) = self.pending.as_mut().filter(|pending| pending.layer == layer)
            && pending.dragged
            && !dragged
        {
            pending.dragged = false;
            pending.until = now + TIMEOUT_SECONDS;
            cx.command(Command::EndAdjustment);
        }
    }
}

/// Draws a patch in the masstone of each pigment.
pub(super) fn pigments(ui: &mut Ui, catalogue: &Catalogue, slots: &Slots) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        for &pigment in slots.iter().flatten() {
            let (rect, response) = ui.allocate_exact_size(vec2(13.0, 13.0), Sense::hover());
            patch(ui.painter(), rect.shrink(1.0), Some(catalogue.colors(pigment).masstone_srgb));
            response.on_hover_text(catalogue.name(pigment));
        }
    });
}

type Scaled = (Arc<Thumbnail>, [usize; 2], TextureHandle);

/// Textures of the thumbnails in use.
#[derive(Clone, Default)]
pub(super) struct Thumbnails(Vec<Scaled>);

impl std::fmt::Debug for Thumbnails {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Thumbnails").field(&self.0.len()).finish()
    }
}

impl Thumbnails {
    /// Draws a thumbnail within `area` points, with its aspect ratio, pixel by pixel.
    pub(super) fn show(&mut self, ui: &mut Ui, thumbnail: &Arc<Thumbnail>, area: Vec2) {
        let (rect, _) = ui.allocate_exact_size(area, Sense::hover());
        if thumbnail.width == 0 || thumbnail.height == 0 {
            return;
        }
        let size = vec2(thumbnail.width as f32, thumbnail.height as f32);
        let scale = (area.x / size.x).min(area.y / size.y);
        let density = ui.pixels_per_point();
        let pixels = (size * scale * density).round().max(Vec2::splat(1.0));
        let place = Rect::from_center_size(rect.center(), pixels / density);
        // On whole pixels, no filter blurs it.
        let corner = (place.min * density).round() / density;
        let place = Rect::from_min_size(corner, pixels / density);
        let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
        let size = [pixels.x as usize, pixels.y as usize];
        let texture = self.texture(ui.ctx(), thumbnail, size).id();
        ui.painter().rect_filled(place, 0.0, theme::SURROUND);
        ui.painter().image(texture, place, whole, Color32::WHITE);
    }

    /// Drops textures of thumbnails that are not in `layers`.
    pub(super) fn keep<'a>(&mut self, layers: impl Iterator<Item = &'a Arc<Thumbnail>> + Clone) {
        self.0.retain(|(kept, ..)| layers.clone().any(|layer| Arc::ptr_eq(kept, layer)));
    }

    fn texture(
        &mut self,
        context: &Context,
        thumbnail: &Arc<Thumbnail>,
        size: [usize; 2],
    ) -> &TextureHandle {
        let index = self
            .0
            .iter()
            .position(|(kept, of, _): &Scaled| Arc::ptr_eq(kept, thumbnail) && *of == size)
            .unwrap_or_else(|| {
                // A screen of another density needs another size.
                self.0.retain(|(kept, ..)| !Arc::ptr_eq(kept, thumbnail));
                let image = ColorImage::new(size, scaled(thumbnail, size));
                let texture = context.load_texture("layer", image, TextureOptions::LINEAR);
                self.0.push((Arc::clone(thumbnail), size, texture));
                self.0.len() - 1
            });
        &self.0[index].2
    }
}

/// The thumbnail with other columns and rows. Each pixel is the mean of the area that it covers.
fn scaled(thumbnail: &Thumbnail, [width, height]: [usize; 2]) -> Vec<Color32> {
    let source: Vec<Rgba> = thumbnail
        .pixels
        .iter()
        .copied()
        .map(|[red, green, blue, alpha]| {
            Rgba::from(Color32::from_rgba_unmultiplied(red, green, blue, alpha))
        })
        .collect();
    let columns: Vec<_> = (0..width).map(|x| shares(x, width, thumbnail.width)).collect();
    let mut pixels = Vec::with_capacity(width * height);
    for y in 0..height {
        let rows = shares(y, height, thumbnail.height);
        for columns in &columns {
            let mut mean = Rgba::TRANSPARENT;
            for &(row, share) in &rows {
                for &(column, part) in columns {
                    mean = mean + source[row * thumbnail.width + column] * (share * part);
                }
            }
            pixels.push(Color32::from(mean));
        }
    }
    pixels
}

/// The pixels of `source` that pixel `index` of `count` covers, with the share of each. The shares
/// sum to 1.
fn shares(index: usize, count: usize, source: usize) -> Vec<(usize, f32)> {
    let scale = source as f64 / count as f64;
    let from = index as f64 * scale;
    let to = (index + 1) as f64 * scale;
    let last = ((to - 1e-9) as usize).min(source - 1);
    (from as usize..=last)
        .map(|pixel: usize| {
            let covered = to.min((pixel + 1) as f64) - from.max(pixel as f64);
            (pixel, (covered / scale) as f32)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scaled_pixel_is_the_mean_of_what_it_covers() {
        for (count, source) in [(3, 7), (7, 3), (60, 160), (1, 5), (4, 4)] {
            let mut covered = vec![0.0; source];
            for index in 0..count {
                let shares = shares(index, count, source);
                let sum: f32 = shares.iter().map(|(_, share)| share).sum();
                assert!((sum - 1.0).abs() < 1e-5, "{index} of {count}: {sum}");
                for (pixel, share) in shares {
                    covered[pixel] += share * source as f32 / count as f32;
                }
            }
            assert!(covered.iter().all(|sum| (sum - 1.0).abs() < 1e-4), "{covered:?}");
        }
        let pixels = vec![[255, 0, 0, 255], [0, 0, 0, 0], [255, 0, 0, 255], [0, 0, 0, 0]];
        let thumbnail = Thumbnail { width: 2, height: 2, pixels };
        let half = scaled(&thumbnail, [1, 2]);
        assert!(half.iter().all(|color| (120..136).contains(&color.a())), "{half:?}");
        assert_eq!(scaled(&thumbnail, [2, 2])[0], Color32::from_rgb(255, 0, 0));
    }
}
