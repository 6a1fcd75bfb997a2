//! Moving a dry layer by dragging its row to another place.

use eframe::egui::{Key, Rect, Response, Stroke, Ui, pos2};
use paint::document::LayerId;
use paint::strokes::{Action, LayerRef};

use crate::panels::PanelContext;
use crate::theme;

/// The row that is being dragged, and the rows of the frame.
#[derive(Debug, Clone, Default)]
pub(super) struct Order {
    dragged: Option<LayerId>,
    /// Rows from the top down.
    rows: Vec<(LayerId, Rect)>,
}

impl Order {
    /// Whether this row is being dragged.
    pub(super) fn is_dragged(&self, layer: LayerId) -> bool {
        self.dragged == Some(layer)
    }

    /// Notes a row and whether it is being dragged.
    pub(super) fn row(&mut self, layer: LayerId, response: &Response) {
        self.rows.push((layer, response.rect));
        if response.drag_started() {
            self.dragged = Some(layer);
        }
    }

    /// Draws the line where the dragged row would be dropped, and moves its layer there when it is
    /// released. Call it after all rows.
    pub(super) fn finish(&mut self, ui: &Ui, cx: &mut PanelContext<'_>) {
        let rows = std::mem::take(&mut self.rows);
        let Some(dragged) = self.dragged else { return };
        let (at, released, cancelled) = ui.input(|input| {
            let pointer = &input.pointer;
            (pointer.latest_pos(), !pointer.primary_down(), input.key_pressed(Key::Escape))
        });
        let from = rows.iter().position(|(layer, _)| *layer == dragged);
        let (Some(at), Some(from), false) = (at, from, cancelled) else {
            self.dragged = None;
            return;
        };
        let gap = gap(&rows, at.y);
        let to = place(rows.len(), from, gap);
        if released {
            self.dragged = None;
            if to != place(rows.len(), from, from) {
                cx.act(Action::Order { layer: LayerRef::Id(dragged), to });
            }
            return;
        }
        let y = match rows.get(gap) {
            Some((_, below)) => below.top() - ui.spacing().item_spacing.y / 2.0,
            None => rows.last().map_or(at.y, |(_, last)| last.bottom() + 1.0),
        };
        let room = rows[from].1.x_range();
        let line = Rect::from_min_max(pos2(room.min, y - 24.0), pos2(room.max, y + 24.0));
        ui.scroll_to_rect(line, None);
        let stroke = Stroke::new(2.0, theme::colors(ui.ctx()).strong);
        ui.painter().hline(room, y, stroke);
        ui.painter().circle_filled(pos2(room.min + 2.0, y), 3.0, stroke.color);
    }
}

/// Index of the gap between rows that is nearest to `y`: 0 above the first.
fn gap(rows: &[(LayerId, Rect)], y: f32) -> usize {
    rows.iter().filter(|(_, row)| row.center().y < y).count()
}

/// Place from the lowest of the layer in row `from` (0 is the topmost) of `count` when it is dropped
/// into a gap between rows.
fn place(count: usize, from: usize, gap: usize) -> usize {
    let row = if gap > from { gap - 1 } else { gap };
    count - 1 - row
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gap_above_or_below_the_dragged_row_leaves_it() {
        // Three rows: the topmost layer has place 2.
        for from in 0..3 {
            let places = [0, 1, 2, 3].map(|gap| place(3, from, gap));
            let wanted = [[2, 2, 1, 0], [2, 1, 1, 0], [2, 1, 0, 0]][from];
            assert_eq!(places, wanted, "row {from}");
        }
    }
}
