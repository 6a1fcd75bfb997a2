//! Draws the columns of panels.

use eframe::egui::{Context, Id, Rect, ScrollArea, Ui, UiBuilder, pos2, vec2};

use super::divider::{Line, divider};
use super::drop::{DrawnGroup, dropped};
use super::header::{Header, HeaderRequest};
use super::panels::{Panels, Tab};
use super::table::{SidePanel, standard};
use crate::arrangement::{Arrangement, Column, HeightRequest, Side, WIDTHS, heights};
use crate::files::Files;
use crate::language::{tr, tr_format};
use crate::panels::PanelContext;
use crate::theme;
use crate::view::fill_rect;

/// Space between two groups, in points.
const GAP: f32 = 8.0;

/// Space around the groups of a column, in points.
const MARGIN: f32 = 6.0;

/// Space between the tabs and their panel, in points.
const BELOW_TABS: f32 = 4.0;

/// Height from which a panel scrolls beside others, in points. The panel of a clean brush is higher,
/// so that a wash does not fold the panels below it in a low window.
const LONG: f32 = 540.0;

/// Height from which a panel with large targets scrolls beside others, in points.
const LONG_TOUCH: f32 = 930.0;

/// Height of a panel before it was drawn, in points.
const UNKNOWN: f32 = 300.0;

/// Least height of a panel that is resized, in points.
const LEAST: f32 = 80.0;

/// Largest share of the window's width for one column.
const WIDEST: f32 = 0.42;

/// Width of the strip at an edge without a column that takes a panel, in points.
const STRIP: f32 = 56.0;

/// Rectangles of the columns and their groups in the window.
#[derive(Debug, Default)]
pub(in crate::app) struct Drawn {
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

    /// Where the panels stand, for the preferences; empty for the standard layout.
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

    /// Puts all panels back to their usual places.
    pub fn arrange_as_usual(&mut self) {
        self.arrangement = standard();
        self.last_used.clear();
    }

    /// Notes that a panel was used, so that it stays open where there is little room.
    fn note_use(&mut self, key: &str) {
        if let Some(panel) = SidePanel::with_key(key) {
            self.uses += 1;
            self.last_used.insert(panel.tab, self.uses);
        }
    }

    /// Whether a column has panels.
    pub(in crate::app) fn has_column(&self, side: Side) -> bool {
        !self.arrangement.column(side).groups.is_empty()
    }

    /// Width of a column in a window of a width; 0 without panels.
    pub(in crate::app) fn column_width(&self, context: &Context, side: Side) -> f32 {
        if !self.has_column(side) {
            return 0.0;
        }
        let Column { width, .. } = self.arrangement.column(side);
        let touched = theme::is_touch(context);
        let least = if touched { theme::panel_width(context) } else { *WIDTHS.start() };
        let most = WIDEST * context.content_rect().width();
        width.min(most).max(least)
    }

    /// Draws a column into the whole of `ui`.
    pub(in crate::app) fn show(
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
        // The groups share the height anew, at first before anything is seen.
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

    /// Adds the edge of a column that is dragged to make it wider.
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

    /// Moves a dragged panel to the place at which it is released. `center` is the part of
    /// the window between the columns.
    pub(in crate::app) fn drop_dragged(
        &mut self,
        context: &Context,
        mut drawn: Drawn,
        center: Rect,
    ) {
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
