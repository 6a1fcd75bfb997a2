//! Draws the cursor: the brush head, or the eyedropper's ring of colour.

use eframe::egui::{Color32, CursorIcon, Pos2, Stroke, Ui};
use graphics::tile::Rect;
use paint::strokes::SurfaceId;

use super::hover::HoveringHead;
use super::studio::Studio;
use crate::panels::Mode;
use crate::theme;
use session::PaintingState;

/// Radius of the eyedropper's ring, in points.
const RING: f32 = 24.0;

impl Studio {
    /// Draws the cursor for the tool in use.
    pub(super) fn draw_cursor(&mut self, ui: &Ui, mode: Mode) {
        let Some(painting) = self.painting.clone() else { return };
        match mode {
            Mode::Paint => {
                self.draw_head(ui, &painting, true);
                self.draw_string(ui);
            }
            // The paint of the brush is set aside.
            Mode::Blend | Mode::Scrape | Mode::Erase => {
                self.draw_head(ui, &painting, false);
                self.draw_string(ui);
            }
            Mode::Pick => self.draw_ring(ui),
            Mode::Mask => self.draw_mask_cursor(ui),
            Mode::Squeeze | Mode::Pan | Mode::Rotate | Mode::Zoom => {}
        }
    }

    /// Draws the brush head: deformed as the worker reported it, or hovering above the
    /// surface. It has its colour where it `paints`.
    fn draw_head(&mut self, ui: &Ui, painting: &PaintingState, paints: bool) {
        if let Some(head) = &self.head {
            let shown = self.view(head.surface).show_head(ui, head, self.head_paint());
            self.head_rect = shown;
            ui.ctx().set_cursor_icon(CursorIcon::None);
            return;
        }
        let Some(hover) = &self.hover else { return };
        let Some(brush) = painting.brushes.iter().find(|brush| brush.name == hover.brush) else {
            return;
        };
        if !self
            .hovering
            .as_ref()
            .is_some_and(|held: &HoveringHead| held.is_of(&brush.spec, painting.cell_mm))
        {
            self.hovering = HoveringHead::of(&brush.spec, painting.cell_mm);
        }
        let head = self.hovering.as_mut().and_then(|held| held.over(hover));
        if let Some(head) = head {
            let paint = brush.color.filter(|_| paints);
            self.head_rect = self.view(hover.surface).show_head(ui, &head, paint);
            ui.ctx().set_cursor_icon(CursorIcon::None);
        }
    }

    /// Colour of the paint on the brush that paints; `None` if it does not, or is bare.
    pub(super) fn head_paint(&self) -> Option<[u8; 3]> {
        let painting = self.painting.as_ref()?;
        let brush = painting.brushes.iter().find(|brush| brush.name == self.tools.brush)?;
        brush.color.filter(|_| self.keys.mode(self.tools.mode) == Mode::Paint)
    }

    /// Draws a line from a stabilised brush to its pen, dark with a light core, so that it shows on
    /// every paint.
    fn draw_string(&self, ui: &Ui) {
        let Some(line) = self.pen.string_line() else { return };
        let painter = ui.painter_at(ui.max_rect());
        for (width, grey) in [(3.0, 20), (1.0, 235)] {
            let color = Color32::from_gray(grey);
            painter.line_segment(line, Stroke::new(width, color));
            painter.circle_stroke(line[1], 4.0, Stroke::new(width, color));
        }
    }

    /// Draws a ring of the colour under the pointer inside a neutral ring.
    fn draw_ring(&self, ui: &Ui) {
        let Some(point) = ui.input(|input| input.pointer.hover_pos()) else { return };
        let over = |surface: &SurfaceId| self.view(*surface).position(point).is_some();
        let Some(surface) = self.visible_surfaces().into_iter().find(over) else { return };
        let Some(color) = self.color_at(surface, point) else { return };
        let painter = ui.painter_at(self.view(surface).rect());
        painter.circle_stroke(point, RING + 6.0, Stroke::new(6.0, theme::SURROUND));
        painter.circle_stroke(point, RING, Stroke::new(8.0, color));
        ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
    }

    /// Screen colour of the cell at a window position; `None` off the surface.
    fn color_at(&self, surface: SurfaceId, point: Pos2) -> Option<Color32> {
        let view = self.view(surface);
        let [x, y] = view.position(point)?;
        let beyond = match surface {
            SurfaceId::Canvas => x >= f64::from(self.tools.split) * view.cells().0 as f64,
            SurfaceId::Palette => view.is_under_second(),
        };
        let second = view.picture(true).filter(|_| beyond);
        let x = x as usize;
        let y = y as usize;
        let cell = second.or(view.picture(false))?.pixels(Rect { x, y, width: 1, height: 1 });
        cell.pixels.first().copied()
    }
}
