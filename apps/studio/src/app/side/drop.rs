//! Dragging a panel by its tab to another place.

use eframe::egui::{
    Context, DragAndDrop, Id, LayerId, Order, Pos2, Rect, Stroke, StrokeKind, TextStyle, pos2, vec2,
};

use super::table::SidePanel;
use crate::arrangement::{Place, Side};
use crate::theme;

/// Share of a group's height at its upper and at its lower edge that takes a panel as a new
/// group.
const EDGE: f32 = 0.25;

/// Longest such edge, in points.
const LONGEST_EDGE: f32 = 48.0;

/// Drag payload of a tab.
#[derive(Debug, Clone, Copy)]
pub(super) struct DraggedPanel {
    pub(super) key: &'static str,
}

/// A group on the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct DrawnGroup {
    pub(super) side: Side,
    pub(super) index: usize,
    pub(super) rect: Rect,
}

/// The place at a point of the window, and the rectangle that marks it.
pub(super) fn place_at(
    point: Pos2,
    groups: &[DrawnGroup],
    columns: &[(Side, Rect)],
) -> Option<(Place, Rect)> {
    let line = |rect: Rect, y: f32| {
        Rect::from_min_max(pos2(rect.left(), y - 2.0), pos2(rect.right(), y + 2.0))
    };
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
    // Between two groups, or below the last one.
    let index = of_side.iter().take_while(|group| group.rect.bottom() <= point.y).count();
    let marker = match of_side.get(index) {
        Some(group) => line(rect, group.rect.top()),
        None if of_side.is_empty() => rect,
        None => line(rect, of_side[index - 1].rect.bottom()),
    };
    Some((Place::Before(side, index), marker))
}

/// Marks the place below the pointer while a panel is dragged. Returns the panel's key and its
/// new place when it is released.
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

#[cfg(test)]
mod tests {
    use super::*;

    fn rect(top: f32, bottom: f32) -> Rect {
        Rect::from_min_max(pos2(1000.0, top), pos2(1280.0, bottom))
    }

    #[test]
    fn the_edges_of_a_group_take_a_new_group_and_its_middle_a_tab() {
        let group = |index, rect| DrawnGroup { side: Side::Right, index, rect };
        let groups = [group(0, rect(30.0, 430.0)), group(1, rect(436.0, 460.0))];
        let left = Rect::from_min_max(pos2(42.0, 30.0), pos2(90.0, 800.0));
        let columns = [(Side::Left, left), (Side::Right, rect(30.0, 800.0))];
        let place = |x, y| place_at(pos2(x, y), &groups, &columns).map(|(place, _)| place);
        assert_eq!(place(1100.0, 40.0), Some(Place::Before(Side::Right, 0)));
        assert_eq!(place(1100.0, 200.0), Some(Place::Tab(Side::Right, 0)));
        assert_eq!(place(1100.0, 400.0), Some(Place::Before(Side::Right, 1)));
        assert_eq!(place(1100.0, 433.0), Some(Place::Before(Side::Right, 1)));
        assert_eq!(place(1100.0, 448.0), Some(Place::Tab(Side::Right, 1)));
        assert_eq!(place(1100.0, 458.0), Some(Place::Before(Side::Right, 2)));
        assert_eq!(place(1100.0, 700.0), Some(Place::Before(Side::Right, 2)));
        assert_eq!(place(60.0, 300.0), Some(Place::Before(Side::Left, 0)));
        assert_eq!(place(600.0, 300.0), None);
    }
}
