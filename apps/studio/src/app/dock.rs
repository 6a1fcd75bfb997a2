//! Draws the columns of panels. The header of a group has a fold button, tabs in as many rows as
//! they need, and a menu.

use eframe::egui::{
    Button, Context, CornerRadius, Id, Popup, Rect, Response, RichText, Role, ScrollArea, Sense,
    Shape, Stroke, TextStyle, Ui, UiBuilder, Vec2, WidgetInfo, pos2, vec2,
};

use super::side::{
    DraggedPanel, DrawnGroup, Line, Panels, SidePanel, Tab, divider, dropped, standard,
};
use crate::app::intent::{self, Part};
use crate::arrangement::{Arrangement, Column, HeightRequest, Move, Place, Side, WIDTHS, heights};
use crate::files::Files;
use crate::language::{tr, tr_format};
use crate::panels::PanelContext;
use crate::theme;
use crate::view::fill_rect;

const GAP: f32 = 8.0;

const MARGIN: f32 = 6.0;

const BELOW_TABS: f32 = 4.0;

/// A panel with higher contents than this may scroll beside others, in points. The panel of a clean
/// brush is higher than this. If it were lower, washing a brush would fold the panels below it in a
/// low window.
const LONG: f32 = 540.0;

/// Replaces [`LONG`] in touch mode, where panels are higher.
const LONG_TOUCH: f32 = 930.0;

/// We assume this height for a panel that was never drawn, in points.
const UNKNOWN: f32 = 300.0;

/// You can resize a panel down to this height, in points.
const LEAST: f32 = 80.0;

/// Largest share of the window's width for one column.
const WIDEST: f32 = 0.42;

/// Width of the strip at an edge without a column, in points. You can drop a panel there.
const STRIP: f32 = 56.0;

/// Rectangles of the columns and their groups in the window.
#[derive(Debug, Default)]
pub(super) struct Drawn {
    groups: Vec<DrawnGroup>,
    columns: Vec<(Side, Rect)>,
}

impl Panels {
    /// Shows a panel: selects its tab and unfolds its group.
    pub fn select(&mut self, tab: Tab) {
        if let Some(panel) = SidePanel::of(tab) {
            self.arrangement.select(panel.key);
            self.note_use(panel.key);
        }
    }

    /// The arrangement of the panels for the preferences; empty for the standard layout.
    #[must_use]
    pub fn arrangement(&self) -> Arrangement {
        if self.arrangement == standard() {
            Arrangement::default()
        } else {
            self.arrangement.clone()
        }
    }

    /// Places the panels as the preferences say.
    pub fn arrange(&mut self, arrangement: &Arrangement) {
        self.arrangement = arrangement.clone();
        self.arrangement.bound(&standard());
    }

    /// Moves all panels back to their usual places.
    pub fn arrange_as_usual(&mut self) {
        self.arrangement = standard();
        self.last_used.clear();
    }

    /// Notes that you used a panel, so that it stays open when there is little room.
    fn note_use(&mut self, key: &str) {
        if let Some(panel) = SidePanel::with_key(key) {
            self.uses += 1;
            self.last_used.insert(panel.tab, self.uses);
        }
    }

    pub(super) fn has_column(&self, side: Side) -> bool {
        !self.arrangement.column(side).groups.is_empty()
    }

    /// Width of a column in this window; 0 without panels.
    pub(super) fn column_width(&self, context: &Context, side: Side) -> f32 {
        if !self.has_column(side) {
            return 0.0;
        }
        let Column { width, .. } = self.arrangement.column(side);
        let touched = theme::is_touch(context);
        let least = if touched { theme::panel_width(context) } else { *WIDTHS.start() };
        let most = WIDEST * context.content_rect().width();
        width.min(most).max(least)
    }

    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        side: Side,
        (cx, files): (&mut PanelContext<'_>, &Files),
        drawn: &mut Drawn,
    ) {
        let whole = ui.max_rect();
        drawn.columns.push((side, whole));
        fill_rect(ui.painter(), whole, theme::colors(ui.ctx()).panel);
        if !theme::is_narrow(ui.ctx()) {
            self.width_divider(ui, side, whole);
        }
        let area = whole.shrink2(vec2(8.0, MARGIN));
        let column = self.arrangement.column(side).clone();
        let panels: Vec<Vec<&'static SidePanel>> = column
            .groups
            .iter()
            .map(|group| group.panels.iter().filter_map(|key| SidePanel::with_key(key)).collect())
            .collect();
        let header = |index: usize, open: bool| {
            let tabs: &[&'static SidePanel] = &panels[index];
            let chosen = *tabs.get(column.groups[index].chosen)?;
            Some(Header { panels: tabs, chosen, open })
        };
        let tab_heights: Vec<f32> = (0..panels.len())
            .map(|index| header(index, true).map_or(0.0, |header| header.height(ui, area.width())))
            .collect();
        let shared = self.share(ui.ctx(), &column, &panels, &tab_heights, area.height());
        let mut top = area.top();
        let mut requests = Vec::new();
        for (index, height) in shared.iter().copied().enumerate() {
            let Some(header) = header(index, height.is_some()) else { continue };
            let tabs =
                Rect::from_min_size(pos2(area.left(), top), vec2(area.width(), tab_heights[index]));
            requests.extend(header.show(ui, tabs, &self.arrangement));
            let bottom = tabs.bottom() + height.map_or(0.0, |height| height + BELOW_TABS);
            if height.is_some() {
                let body = Rect::from_min_max(
                    tabs.left_bottom() + vec2(0.0, BELOW_TABS),
                    pos2(area.right(), bottom),
                );
                self.body(ui, body, header.chosen, (cx, files));
            }
            let rect = Rect::from_min_max(tabs.min, pos2(area.right(), bottom));
            drawn.groups.push(DrawnGroup { side, index, rect });
            if let Some(height) = height.filter(|_| shared[index + 1..].iter().any(Option::is_some))
            {
                let gap = Rect::from_min_size(rect.left_bottom(), vec2(area.width(), GAP));
                let name = tr_format!("Height of {name}", name = tr(header.chosen.name));
                let moved = divider(ui, gap, &name, Line::Level);
                if moved != 0.0 {
                    let group = &mut self.arrangement.column_mut(side).groups[index];
                    group.height = Some((height + moved).max(LEAST));
                }
            }
            top = bottom + GAP;
        }
        for request in requests {
            self.carry_out(request);
        }
    }

    /// Shares the height of a column among its groups.
    fn share(
        &self,
        context: &Context,
        column: &Column,
        panels: &[Vec<&'static SidePanel>],
        tab_heights: &[f32],
        height: f32,
    ) -> Vec<Option<f32>> {
        let long = if theme::is_touch(context) { LONG_TOUCH } else { LONG };
        let requests = column.groups.iter().zip(panels).map(|(group, panels)| {
            let content =
                panels.get(group.chosen).and_then(|panel| self.content_heights.get(&panel.tab));
            let last_used = panels.iter().filter_map(|panel| self.last_used.get(&panel.tab));
            HeightRequest {
                folded: group.folded,
                wanted: group.height.or(content.copied()).unwrap_or(UNKNOWN),
                whole: panels.get(group.chosen).is_some_and(|panel| panel.is_whole())
                    && content.is_none_or(|content| *content <= long),
                last_used: last_used.copied().max().unwrap_or(0),
            }
        });
        let requests: Vec<HeightRequest> = requests.collect();
        let count = requests.len() as f32;
        let tabs: f32 = tab_heights.iter().sum();
        let bodies = requests.iter().filter(|request| !request.folded).count() as f32;
        let room = height - tabs - GAP * (count - 1.0).max(0.0) - BELOW_TABS * bodies;
        heights(&requests, room.max(0.0))
    }

    fn body(
        &mut self,
        ui: &mut Ui,
        rect: Rect,
        panel: &'static SidePanel,
        (cx, files): (&mut PanelContext<'_>, &Files),
    ) {
        let salt = Id::unique(("panel", panel.key));
        let mut within = ui.new_child(UiBuilder::new().id_salt(salt).max_rect(rect));
        within.set_clip_rect(rect.intersect(ui.clip_rect()));
        let area = ScrollArea::vertical().id_salt(panel.key).auto_shrink(false);
        let shown = area.show(&mut within, |ui| {
            (panel.show)(self, ui, cx, files);
            ui.min_rect().height()
        });
        let before = self.content_heights.insert(panel.tab, shown.inner);
        // The groups share the height anew. At first we do this before you see anything.
        if before.is_none() {
            ui.ctx().request_discard("a panel is drawn first");
        } else if before.is_some_and(|before| (before - shown.inner).abs() > 0.5) {
            ui.ctx().request_repaint();
        }
    }

    fn carry_out(&mut self, request: HeaderRequest) {
        match request {
            HeaderRequest::Fold(key, true) => self.arrangement.fold(key, true),
            HeaderRequest::Fold(key, false) | HeaderRequest::Select(key) => {
                self.arrangement.select(key);
                self.note_use(key);
            }
            HeaderRequest::Move(key, place) => {
                self.arrangement.move_to(key, place);
                self.note_use(key);
            }
        }
    }

    /// Adds the edge of a column, which you drag to make it wider.
    fn width_divider(&mut self, ui: &Ui, side: Side, whole: Rect) {
        let (x, sign, name) = match side {
            Side::Left => (whole.right() - GAP, 1.0, tr("Width of the left panels")),
            Side::Right => (whole.left(), -1.0, tr("Width of the right panels")),
        };
        let edge = Rect::from_min_size(pos2(x, whole.top()), vec2(GAP, whole.height()));
        let moved = divider(ui, edge, name, Line::Upright);
        if moved != 0.0 {
            let now = self.column_width(ui.ctx(), side);
            let width = (now + sign * moved).clamp(*WIDTHS.start(), *WIDTHS.end());
            self.arrangement.column_mut(side).width = width;
        }
    }

    /// If you release a dragged panel, this moves it there. `center` is the part of the window
    /// between the columns.
    pub(super) fn drop_dragged(&mut self, context: &Context, mut drawn: Drawn, center: Rect) {
        for side in Side::ALL {
            if drawn.columns.iter().all(|(drawn, _)| *drawn != side) {
                let (left, right) = center.split_left_right_at_x(match side {
                    Side::Left => center.left() + STRIP,
                    Side::Right => center.right() - STRIP,
                });
                drawn.columns.push((side, if side == Side::Left { left } else { right }));
            }
        }
        if let Some((key, place)) = dropped(context, &drawn.groups, &drawn.columns) {
            self.arrangement.move_to(key, place);
            self.note_use(key);
        }
    }
}

const ROW: f32 = 24.0;

const BUTTON: f32 = 20.0;

/// Space between the edge of a tab and its name, in points.
const PADDING: f32 = 5.0;

/// An action that you chose in the header of a group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum HeaderRequest {
    Select(&'static str),
    Fold(&'static str, bool),
    Move(&'static str, Place),
}

pub(super) struct Header<'a> {
    pub(super) panels: &'a [&'static SidePanel],
    /// The panel that you see of the group.
    pub(super) chosen: &'static SidePanel,
    /// Whether you see the panel, because the group is not folded.
    pub(super) open: bool,
}

impl Header<'_> {
    /// Height of the header in a column of a width.
    pub(super) fn height(&self, ui: &Ui, width: f32) -> f32 {
        let rows = self.rows(ui, width).len() as f32;
        rows * row_height(ui) + rows - 1.0
    }

    /// Tabs of each row, with their smallest widths.
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
        intent::note(ui.ctx(), Part::Tab(panel.name), rect);
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
