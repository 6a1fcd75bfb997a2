//! The panels in the columns at both sides of the window. To add a panel, write one line in the
//! table here, and its [`Tab`].

use std::collections::BTreeMap;

use eframe::egui::{
    Context, CursorIcon, DragAndDrop, Id, Key, LayerId, Order, Pos2, Rect, Role, Sense, Stroke,
    StrokeKind, TextStyle, Ui, WidgetInfo, pos2, vec2,
};

use crate::arrangement::{Arrangement, Place, Side};
use crate::files::Files;
use crate::language::tr;
use crate::panels::brushes::Brushes;
use crate::panels::eyedropper::Eyedropper;
use crate::panels::history::History;
use crate::panels::layers::Layers;
use crate::panels::light::LightPanel;
use crate::panels::reference::Reference;
use crate::panels::swatches::Swatches;
use crate::panels::tubes::Tubes;
use crate::panels::wheel::Wheel;
use crate::panels::{PanelContext, history};
use crate::theme;

type Show = fn(&mut Panels, &mut Ui, &mut PanelContext<'_>, &Files);

pub(super) struct SidePanel {
    pub(super) tab: Tab,
    /// Name in the preferences. It never changes.
    pub(super) key: &'static str,
    pub(super) name: &'static str,
    pub(super) description: &'static str,
    /// Index of its group in the standard layout.
    group: usize,
    pub(super) show: Show,
}

const fn panel(
    (tab, group): (Tab, usize),
    key: &'static str,
    (name, description): (&'static str, &'static str),
    show: Show,
) -> SidePanel {
    SidePanel { tab, key, name, description, group, show }
}

/// All panels. You need those of the first group while you paint, and the others from time to time.
#[rustfmt::skip]
const PANELS: [SidePanel; 8] = [
    panel((Tab::Brush, 0), "brush", ("Brush", "List of brushes, head and paint of the selected brush"), |panels, ui, cx, _| panels.brushes.show(ui, cx)),
    panel((Tab::Layers, 0), "layers", ("Layers", "Wet and dry paint"), |panels, ui, cx, _| panels.layers.show(ui, cx)),
    panel((Tab::Light, 1), "light", ("Light", "The light, the gloss, and a second light to compare"), |panels, ui, cx, _| panels.light.show(ui, cx)),
    panel((Tab::Color, 1), "colour", ("Colour", "Colour and paint picked by the eyedropper, and recipes for a colour"), |panels, ui, cx, _| panels.eyedropper.show(ui, cx)),
    panel((Tab::Wheel, 1), "wheel", ("Wheel", "Colours that the tubes on the palette can mix, and recipes for them"), |panels, ui, cx, _| panels.wheel.show(ui, cx, panels.eyedropper.target())),
    panel((Tab::Swatches, 1), "swatches", ("Swatches", "Mixtures that are kept"), |panels, ui, cx, files| panels.swatches.show(ui, cx, files.swatches())),
    panel((Tab::History, 1), "history", ("History", "List of actions, to undo and redo"), |panels, ui, cx, _| panels.history.show(ui, cx)),
    panel((Tab::Files, 1), "files", ("Files", "Numbered revisions of the painting"), |_, ui, cx, files| history::show(ui, cx, &files.revisions)),
];

impl SidePanel {
    /// Whether the column shows all of this panel if it can, because you need it while you paint.
    pub(super) fn is_whole(&self) -> bool {
        self.group == 0
    }

    pub(super) fn of(tab: Tab) -> Option<&'static Self> {
        PANELS.iter().find(|panel| panel.tab == tab)
    }

    pub(super) fn with_key(key: &str) -> Option<&'static Self> {
        PANELS.iter().find(|panel| panel.key == key)
    }
}

impl Tab {
    /// Name on the tab.
    #[must_use]
    pub fn name(self) -> &'static str {
        SidePanel::of(self).map_or("", |panel| panel.name)
    }
}

/// The standard layout: two groups at the right.
pub(super) fn standard() -> Arrangement {
    fn keys(group: usize) -> Vec<&'static str> {
        PANELS.iter().filter(|panel| panel.group == group).map(|panel| panel.key).collect()
    }
    let groups: Vec<Vec<&str>> = (0..).map(keys).take_while(|keys| !keys.is_empty()).collect();
    let groups: Vec<&[&str]> = groups.iter().map(Vec::as_slice).collect();
    Arrangement::in_right_column(&groups)
}

/// Panels of the columns at the sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Tab {
    /// List of brushes, head and paint of the selected brush.
    Brush,
    /// Wet and dry paint.
    Layers,
    /// Illuminant, direction, gloss and second light.
    Light,
    /// Picked colour and recipes for it.
    Color,
    /// Colours that the tubes can mix.
    Wheel,
    /// Mixtures that you keep.
    Swatches,
    /// List of actions.
    History,
    /// Numbered revisions of the painting.
    Files,
}

/// State of all panels, and their arrangement.
#[derive(Debug, Default)]
pub struct Panels {
    /// State of the brush panel.
    pub brushes: Brushes,
    /// State of the tube panel beside the palette.
    pub tubes: Tubes,
    /// Eyedropper panel with recipe search.
    pub eyedropper: Eyedropper,
    /// Reference picture beside the canvas.
    pub reference: Reference,
    pub(super) wheel: Wheel,
    swatches: Swatches,
    layers: Layers,
    pub(super) light: LightPanel,
    history: History,
    pub(super) arrangement: Arrangement,
    /// Heights of the panels' contents in the last frame, in points.
    pub(super) content_heights: BTreeMap<Tab, f32>,
    /// Counter of selections, and its value when you last selected each panel.
    pub(super) uses: u64,
    pub(super) last_used: BTreeMap<Tab, u64>,
}

/// If you drop a panel near the upper or lower edge of a group, it becomes a new group. This is how
/// near, as a share of the group's height.
const EDGE: f32 = 0.25;

/// [`EDGE`] counts up to this height, in points.
const LONGEST_EDGE: f32 = 48.0;

#[derive(Debug, Clone, Copy)]
pub(super) struct DraggedPanel {
    pub(super) key: &'static str,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct DrawnGroup {
    pub(super) side: Side,
    pub(super) index: usize,
    pub(super) rect: Rect,
}

/// The place at a point of the window, and the rectangle that marks it.
fn place_at(point: Pos2, groups: &[DrawnGroup], columns: &[(Side, Rect)]) -> Option<(Place, Rect)> {
    fn line(rect: Rect, y: f32) -> Rect {
        Rect::from_min_max(pos2(rect.left(), y - 2.0), pos2(rect.right(), y + 2.0))
    }
    if let Some(&DrawnGroup { side, index, rect }) =
        groups.iter().find(|group| group.rect.contains(point))
    {
        let edge = (EDGE * rect.height()).min(LONGEST_EDGE);
        return Some(if point.y < rect.top() + edge {
            (Place::Before(side, index), line(rect, rect.top()))
        } else if point.y > rect.bottom() - edge {
            (Place::Before(side, index + 1), line(rect, rect.bottom()))
        } else {
            (Place::Tab(side, index), rect)
        });
    }
    let &(side, rect) = columns.iter().find(|(_, rect)| rect.contains(point))?;
    let of_side: Vec<&DrawnGroup> = groups.iter().filter(|group| group.side == side).collect();
    // The place lies between two groups, or below the last one.
    let index = of_side.iter().take_while(|group| group.rect.bottom() <= point.y).count();
    let marker = match of_side.get(index) {
        Some(group) => line(rect, group.rect.top()),
        None if of_side.is_empty() => rect,
        None => line(rect, of_side[index - 1].rect.bottom()),
    };
    Some((Place::Before(side, index), marker))
}

/// Marks the place below the pointer while you drag a panel. When you release it, this returns the
/// panel's key and its new place.
pub(super) fn dropped(
    context: &Context,
    groups: &[DrawnGroup],
    columns: &[(Side, Rect)],
) -> Option<(&'static str, Place)> {
    let dragged = DragAndDrop::payload::<DraggedPanel>(context)?;
    let point = context.pointer_interact_pos()?;
    let (place, marker) = place_at(point, groups, columns)?;
    if context.input(|input| input.pointer.any_released()) {
        return Some((dragged.key, place));
    }
    let layer = LayerId::new(Order::Tooltip, Id::unique("dragged panel"));
    let painter = context.layer_painter(layer);
    let stroke = Stroke::new(2.0, theme::colors(context).strong);
    painter.rect_stroke(marker, 2, stroke, StrokeKind::Inside);
    if let Some(panel) = SidePanel::with_key(dragged.key) {
        let font = TextStyle::Body.resolve(&context.global_style());
        let words = painter.layout_no_wrap(panel.name.to_owned(), font, theme::BOARD_TEXT);
        let at = point + vec2(14.0, 14.0);
        let board = Rect::from_min_size(at, words.size()).expand(5.0);
        painter.rect_filled(board, theme::CORNER_RADIUS, theme::BOARD);
        painter.galley(at, words, theme::BOARD_TEXT);
    }
    None
}

/// An arrow key moves the edge by this, in points.
const STEP: f32 = 8.0;

/// The direction of the edge between two parts of the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Line {
    /// The edge is vertical, between parts side by side.
    Upright,
    /// The edge is horizontal, between parts above each other.
    Level,
}

/// Adds an edge in `rect` that you can drag, or move with the arrow keys. Returns how far it moves
/// in this frame, in points to the right or downwards.
pub(super) fn divider(ui: &Ui, rect: Rect, name: &str, line: Line) -> f32 {
    let response = ui.interact(rect, Id::unique(("divider", name)), Sense::drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, name));
    let (cursor, keys) = match line {
        Line::Upright => (CursorIcon::ResizeHorizontal, [Key::ArrowLeft, Key::ArrowRight]),
        Line::Level => (CursorIcon::ResizeVertical, [Key::ArrowUp, Key::ArrowDown]),
    };
    let mut moved = match line {
        Line::Upright => response.drag_delta().x,
        Line::Level => response.drag_delta().y,
    };
    if response.has_focus() {
        let [back, on] = keys.map(|key| ui.input(|input| input.num_presses(key)) as f32);
        moved += STEP * (on - back);
    }
    let used = response.hovered() || response.dragged() || response.has_focus();
    let colors = theme::colors(ui.ctx());
    let stroke =
        Stroke::new(if used { 2.0 } else { 1.0 }, if used { colors.faint } else { colors.line });
    match line {
        Line::Upright => ui.painter().vline(rect.center().x, rect.y_range(), stroke),
        Line::Level => ui.painter().hline(rect.x_range(), rect.center().y, stroke),
    };
    response.on_hover_cursor(cursor).on_hover_text(tr("Drag to resize"));
    moved
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_panel_has_its_own_key_and_a_place_in_the_standard_layout() {
        let standard = standard();
        for panel in &PANELS {
            assert!(standard.position(panel.key).is_some(), "{} has no place", panel.name);
            assert_eq!(SidePanel::with_key(panel.key).map(|found| found.tab), Some(panel.tab));
            assert_eq!(SidePanel::of(panel.tab).map(|found| found.key), Some(panel.key));
        }
    }

    fn rect(top: f32, bottom: f32) -> Rect {
        Rect::from_min_max(pos2(1000.0, top), pos2(1280.0, bottom))
    }

    #[test]
    fn the_edges_of_a_group_take_a_new_group_and_its_middle_a_tab() {
        let groups = [(0, rect(30.0, 430.0)), (1, rect(436.0, 460.0))]
            .map(|(index, rect)| DrawnGroup { side: Side::Right, index, rect });
        let left = Rect::from_min_max(pos2(42.0, 30.0), pos2(90.0, 800.0));
        let columns = [(Side::Left, left), (Side::Right, rect(30.0, 800.0))];
        for (x, y, wanted) in [
            (1100.0, 40.0, Some(Place::Before(Side::Right, 0))),
            (1100.0, 200.0, Some(Place::Tab(Side::Right, 0))),
            (1100.0, 400.0, Some(Place::Before(Side::Right, 1))),
            (1100.0, 433.0, Some(Place::Before(Side::Right, 1))),
            (1100.0, 448.0, Some(Place::Tab(Side::Right, 1))),
            (1100.0, 458.0, Some(Place::Before(Side::Right, 2))),
            (1100.0, 700.0, Some(Place::Before(Side::Right, 2))),
            (60.0, 300.0, Some(Place::Before(Side::Left, 0))),
            (600.0, 300.0, None),
        ] {
            let place = place_at(pos2(x, y), &groups, &columns).map(|(place, _)| place);
            assert_eq!(place, wanted, "{x} {y}");
        }
    }
}
