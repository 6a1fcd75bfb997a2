//! One dry layer in the list: eye, thumbnail, name, figures, opacity and menu.

use eframe::egui::containers::menu::MenuButton;
use eframe::egui::{
    Button, Frame, Label, Margin, Rect, Response, RichText, Role, Sense, Stroke, Ui, UiBuilder,
    Vec2, WidgetInfo, vec2,
};
use paint::strokes::{Action, LayerRef};

use super::eye::eye;
use super::naming::Naming;
use super::opacity::Opacity;
use super::pigments::pigments;
use super::thumbnails::Thumbnails;
use crate::language::{layer_label, tr, tr_format};
use crate::panels::PanelContext;
use crate::panels::controls::millimetres;
use crate::panels::pigments::Catalogue;
use crate::theme;
use session::LayerState;

/// Size of a thumbnail in points.
const THUMBNAIL: [f32; 2] = [60.0, 44.0];

/// Room for the dots on the button of the menu, in points.
const DOTS: f32 = 16.0;

/// State that the rows share.
pub(super) struct RowParts<'a> {
    pub(super) naming: &'a mut Naming,
    pub(super) opacity: &'a mut Opacity,
    pub(super) thumbnails: &'a mut Thumbnails,
    pub(super) catalogue: &'a Catalogue,
}

/// How a row is shown.
#[derive(Debug, Clone, Copy)]
pub(super) struct RowLook {
    pub(super) chosen: bool,
    pub(super) dragged: bool,
}

/// A row that was drawn.
pub(super) struct DrawnRow {
    /// The row itself, below its controls.
    pub(super) response: Response,
    /// The name, if it is not being edited.
    pub(super) name: Option<Rect>,
}

/// Draws the row of a layer; `menu` fills its menu.
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
        // An edge, as the fill of chosen items would hide the rail of the slider.
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

/// Draws the eye, which shows and hides the layer.
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
