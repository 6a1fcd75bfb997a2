//! The header of a group: a fold button, tabs in as many rows as they need, and a menu.

use eframe::egui::{
    Button, CornerRadius, Id, Popup, Rect, Response, RichText, Role, Sense, Shape, Stroke,
    TextStyle, Ui, UiBuilder, Vec2, WidgetInfo, pos2, vec2,
};

use super::drop::DraggedPanel;
use super::table::SidePanel;
use crate::app::places::{self, Part};
use crate::arrangement::{Arrangement, Move, Place};
use crate::language::{tr, tr_format};
use crate::theme;

/// Height of a row of tabs, in points.
const ROW: f32 = 24.0;

/// Width of the buttons beside the tabs, in points.
const BUTTON: f32 = 20.0;

/// Space between the edge of a tab and its name, in points.
const PADDING: f32 = 5.0;

/// A request of a header.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum HeaderRequest {
    /// Shows a panel.
    Select(&'static str),
    /// Folds or unfolds the group of a panel.
    Fold(&'static str, bool),
    /// Moves a panel.
    Move(&'static str, Place),
}

/// A group as its header shows it.
pub(super) struct Header<'a> {
    pub(super) panels: &'a [&'static SidePanel],
    /// The panel that is shown.
    pub(super) chosen: &'static SidePanel,
    /// Whether it is shown, rather than folded.
    pub(super) open: bool,
}

impl Header<'_> {
    /// Height of the header in a column of a width.
    pub(super) fn height(&self, ui: &Ui, width: f32) -> f32 {
        let rows = self.rows(ui, width).len() as f32;
        rows * row_height(ui) + rows - 1.0
    }

    /// Tabs of each row, with their least widths.
    fn rows(&self, ui: &Ui, width: f32) -> Vec<Vec<(&'static SidePanel, f32)>> {
        let room = width - 2.0 * (button_width(ui) + 1.0);
        let font = TextStyle::Body.resolve(ui.style());
        let mut rows: Vec<Vec<(&'static SidePanel, f32)>> = Vec::new();
        let mut used = f32::INFINITY;
        for &panel in self.panels {
            let name = tr(panel.name).to_owned();
            let laid =
                ui.painter().layout_no_wrap(name, font.clone(), theme::colors(ui.ctx()).text);
            let needed = (laid.size().x + 2.0 * PADDING).max(theme::target(ui));
            if used + 1.0 + needed > room {
                rows.push(Vec::new());
                used = -1.0;
            }
            used += 1.0 + needed;
            if let Some(row) = rows.last_mut() {
                row.push((panel, needed));
            }
        }
        rows
    }

    /// Draws the header into `rect`.
    pub(super) fn show(
        &self,
        ui: &mut Ui,
        rect: Rect,
        arrangement: &Arrangement,
    ) -> Option<HeaderRequest> {
        let side = vec2(button_width(ui), row_height(ui));
        let mut request = self.fold_button(ui, Rect::from_min_size(rect.min, side));
        let menu = Rect::from_min_size(pos2(rect.right() - side.x, rect.top()), side);
        request = request.or(self.menu_button(ui, menu, arrangement));
        let mut top = rect.top();
        for row in self.rows(ui, rect.width()) {
            let room = rect.width() - 2.0 * (side.x + 1.0) - (row.len() as f32 - 1.0);
            let spare = room - row.iter().map(|(_, width)| width).sum::<f32>();
            let mut left = rect.left() + side.x + 1.0;
            for &(panel, least) in &row {
                let width = least + spare / row.len() as f32;
                let tab = Rect::from_min_size(pos2(left, top), vec2(width, side.y));
                request = request.or(self.tab(ui, tab, panel, arrangement));
                left += width + 1.0;
            }
            top += side.y + 1.0;
        }
        request
    }

    fn tab(
        &self,
        ui: &mut Ui,
        rect: Rect,
        panel: &'static SidePanel,
        arrangement: &Arrangement,
    ) -> Option<HeaderRequest> {
        let colors = theme::colors(ui.ctx());
        let here = self.open && panel.tab == self.chosen.tab;
        let round = CornerRadius::same(theme::CORNER_RADIUS);
        let name =
            RichText::new(tr(panel.name)).color(if here { colors.strong } else { colors.text });
        let button = Button::new(name)
            .fill(if here { colors.chosen } else { colors.bar })
            .selected(here)
            .sense(Sense::click_and_drag())
            .min_size(rect.size())
            .corner_radius(CornerRadius { sw: 0, se: 0, ..round });
        let mut tabs = ui.new_child(UiBuilder::new().max_rect(rect));
        tabs.spacing_mut().button_padding = Vec2::ZERO;
        let response = tabs.put(rect, button);
        places::note(ui.ctx(), Part::Tab(panel.name), rect);
        response.dnd_set_drag_payload(DraggedPanel { key: panel.key });
        let mut request = None;
        if response.clicked() {
            request = Some(HeaderRequest::Select(panel.key));
        }
        response.context_menu(|ui| request = menu(ui, panel, self.open, arrangement));
        response.on_hover_text(tr_format!(
            "{description}. Drag it to another place, or click with the right button",
            description = tr(panel.description)
        ));
        request
    }

    fn fold_button(&self, ui: &Ui, rect: Rect) -> Option<HeaderRequest> {
        let name = tr(self.chosen.name);
        let (label, tip) = match self.open {
            true => (tr_format!("Fold {name}", name), tr("Shows only the tabs")),
            false => (tr_format!("Unfold {name}", name), tr("Shows the panel")),
        };
        let response = sign(ui, rect, &label, |rect| {
            let points = match self.open {
                true => [vec2(-4.0, -2.0), vec2(4.0, -2.0), vec2(0.0, 3.0)],
                false => [vec2(-2.0, -4.0), vec2(3.0, 0.0), vec2(-2.0, 4.0)],
            };
            let points = points.map(|offset| rect.center() + offset).to_vec();
            vec![Shape::convex_polygon(points, theme::colors(ui.ctx()).text, Stroke::NONE)]
        });
        let clicked = response.on_hover_text(tip).clicked();
        clicked.then_some(HeaderRequest::Fold(self.chosen.key, self.open))
    }

    fn menu_button(&self, ui: &Ui, rect: Rect, arrangement: &Arrangement) -> Option<HeaderRequest> {
        let name = tr_format!("Place of {name}", name = tr(self.chosen.name));
        let response = sign(ui, rect, &name, |rect| {
            [-1.0, 0.0, 1.0]
                .map(|row: f32| {
                    let at = rect.center() + vec2(0.0, 5.0 * row);
                    Shape::circle_filled(at, 1.5, theme::colors(ui.ctx()).text)
                })
                .to_vec()
        });
        let opened = Popup::menu(&response)
            .show(|ui| menu(ui, self.chosen, self.open, arrangement))
            .and_then(|shown| shown.inner);
        response.on_hover_text(tr("Moves this panel to another place"));
        opened
    }
}

/// Adds a button with a sign.
fn sign(ui: &Ui, rect: Rect, name: &str, shapes: impl FnOnce(Rect) -> Vec<Shape>) -> Response {
    let response = ui.interact(rect, Id::unique(("header", name)), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
    let colors = theme::colors(ui.ctx());
    let used = response.hovered() || response.has_focus();
    let fill = if used { colors.hovered } else { colors.bar };
    ui.painter().rect_filled(rect, theme::CORNER_RADIUS, fill);
    ui.painter().extend(shapes(rect));
    response
}

/// Draws the menu of a panel.
fn menu(
    ui: &mut Ui,
    panel: &'static SidePanel,
    open: bool,
    arrangement: &Arrangement,
) -> Option<HeaderRequest> {
    let mut request = None;
    let mut entry = |ui: &mut Ui, name: &str, tip: &str, wanted: Option<HeaderRequest>| {
        let button = ui.add_enabled(wanted.is_some(), Button::new(name)).on_hover_text(tip);
        if button.clicked() {
            request = wanted;
            ui.close();
        }
    };
    let (name, tip) = if open {
        (tr("Fold"), tr("Shows only the tabs"))
    } else {
        (tr("Unfold"), tr("Shows the panel"))
    };
    entry(ui, name, tip, Some(HeaderRequest::Fold(panel.key, open)));
    ui.separator();
    for step in Move::ALL {
        let (name, tip) = words(step);
        let place = arrangement.place_after(panel.key, step);
        entry(ui, name, tip, place.map(|place| HeaderRequest::Move(panel.key, place)));
    }
    request
}

fn words(step: Move) -> (&'static str, &'static str) {
    match step {
        Move::Up => (tr("Move up"), tr("Puts the panel above this group, or above the one before")),
        Move::Down => {
            (tr("Move down"), tr("Puts the panel below this group, or below the one after"))
        }
        Move::OtherColumn => {
            (tr("To the other side"), tr("Puts the panel at the other side of the canvas"))
        }
        Move::JoinAbove => (tr("Join the group above"), tr("Puts the panel among the tabs above")),
        Move::JoinBelow => (tr("Join the group below"), tr("Puts the panel among the tabs below")),
    }
}

fn row_height(ui: &Ui) -> f32 {
    ROW.max(theme::target(ui))
}

fn button_width(ui: &Ui) -> f32 {
    BUTTON.max(theme::target(ui))
}
