//! Draws canvas, palette and reference picture, and handles tools other than the brush.

use std::time::Duration;

use eframe::egui::{
    Frame, Margin, Panel, PointerButton, Rect, Response, ScrollArea, Stroke, StrokeKind, Ui,
    UiBuilder, pos2, vec2,
};
use render::paint::strokes::SurfaceId;

use super::side::Tab;
use super::studio::Studio;
use crate::panels::tubes::{DraggedTube, squeeze};
use crate::panels::{Mode, PanelContext, figures};
use crate::theme;
use crate::view::{DragMode, Split, fill_rect};
use session::Command;

/// Maximum width of the tubes beside the palette, in points.
const TUBES_WIDTH: f32 = 640.0;

impl Studio {
    /// Draws both surfaces in the remaining part of the window.
    pub(super) fn draw_surfaces(&mut self, ui: &mut Ui) {
        let mode = self.keys.mode(self.tools.mode);
        let drag = match mode {
            Mode::Pan => DragMode::Pan,
            Mode::Rotate => DragMode::Rotate,
            Mode::Zoom => DragMode::Zoom,
            Mode::Paint | Mode::Pick | Mode::Squeeze => DragMode::None,
        };
        fill_rect(ui.painter(), ui.max_rect(), theme::SURROUND);
        if self.visible.palette && self.visible.panels {
            let height = (0.3 * ui.available_height()).clamp(150.0, 236.0);
            Panel::bottom("palette")
                .frame(Frame::NONE)
                .resizable(true)
                .show_separator_line(false)
                .default_size(height)
                .size_range(110.0..=520.0)
                .show(ui, |ui| self.draw_palette(ui, drag, mode));
        }
        if self.panels.reference.is_open() && self.visible.panels {
            Panel::left("reference")
                .frame(Frame::new().inner_margin(Margin::same(6)))
                .show_separator_line(false)
                .default_size(0.3 * ui.available_width())
                .size_range(160.0..=0.6 * ui.available_width())
                .show(ui, |ui| {
                    fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).panel);
                    let before = self.tools.reference_color;
                    self.with_panels(|panels, cx| panels.reference.show(ui, cx));
                    if self.tools.reference_color != before {
                        self.panels.select(Tab::Color);
                    }
                });
        } else {
            self.panels.reference.hide();
        }
        let area = ui.available_rect_before_wrap();
        let painting = self.painting.clone();
        let lights = painting.as_ref().and_then(|painting| {
            let second = painting.second_lighting.as_ref()?;
            Some([painting.lighting.illuminant.as_str(), second.illuminant.as_str()])
        });
        let split = lights.map(|lights| Split { at: &mut self.tools.split, lights });
        let response = self.canvas.show(ui, area, drag, split);
        self.handle_tool(ui, SurfaceId::Canvas, &response, mode);
        self.update_pen(ui, mode);
        self.draw_cursor(ui, mode);
        if self.tools.figures {
            let backend = painting.as_ref().map_or("", |painting| painting.backend.as_str());
            figures::overlay(ui, area, self.frames.rate(), self.figures, backend);
            ui.ctx().request_repaint_after(Duration::from_millis(250));
        }
    }

    /// Draws the palette with the tubes beside it.
    fn draw_palette(&mut self, ui: &mut Ui, drag: DragMode, mode: Mode) {
        let whole = ui.available_rect_before_wrap();
        // The panel keeps its height, whatever its contents.
        ui.expand_to_include_rect(whole);
        let cells = self.palette.cells();
        let width = (whole.height() * cells.0 as f32 / cells.1 as f32).min(0.6 * whole.width());
        let area = Rect::from_min_size(whole.min, vec2(width, whole.height()));
        let response = self.palette.show(ui, area, drag, None);
        self.handle_tool(ui, SurfaceId::Palette, &response, mode);
        let right = whole.right().min(area.right() + TUBES_WIDTH);
        let tubes_rect = Rect::from_min_max(area.right_top(), pos2(right, whole.bottom()));
        let tubes_rect = tubes_rect.shrink2(vec2(6.0, 8.0));
        let mut ui = ui.new_child(UiBuilder::new().max_rect(tubes_rect));
        // A plain rectangle, which is cheap, and a thick outline for the rounded
        // corners.
        fill_rect(ui.painter(), tubes_rect.shrink(1.0), theme::colors(ui.ctx()).panel);
        let edge = Stroke::new(3.0, theme::colors(ui.ctx()).panel);
        ui.painter().rect_stroke(tubes_rect, 6, edge, StrokeKind::Inside);
        let shelf = Frame::new().inner_margin(Margin::same(8));
        shelf.show(&mut ui, |ui| {
            ui.set_min_size(ui.available_size());
            ScrollArea::vertical().show(ui, |ui| {
                let Some(painting) = &self.painting.clone() else { return };
                let requests = &mut self.requests;
                let mut cx = PanelContext { painting, tools: &mut self.tools, requests };
                self.panels.tubes.show(ui, &mut cx);
            });
        });
    }

    /// Handles eyedropper, squeezing and dropped tubes on a surface.
    fn handle_tool(&mut self, ui: &Ui, surface: SurfaceId, response: &Response, mode: Mode) {
        let Some(cell_mm) = self.painting.as_ref().map(|painting| painting.cell_mm) else { return };
        let pointer = ui.input(|input| input.pointer.latest_pos());
        let Some(place) = pointer.and_then(|point| self.view(surface).position(point)) else {
            return;
        };
        let [x_mm, y_mm] = place.map(|cells| cells * cell_mm);
        if let Some(tube) = response.dnd_release_payload::<DraggedTube>() {
            self.with_panels(|_, cx| squeeze(cx, tube.slot, surface, x_mm, y_mm));
        }
        let primary = ui.input(|input| input.pointer.button_down(PointerButton::Primary));
        if mode == Mode::Pick && primary && response.is_pointer_button_down_on() {
            let place = (surface, x_mm.to_bits(), y_mm.to_bits());
            if self.last_pick != Some(place) {
                self.last_pick = Some(place);
                let radius_mm = self.tools.pick_radius_mm;
                self.ask(Command::Pick { surface, x_mm, y_mm, radius_mm });
            }
        }
        if mode == Mode::Squeeze && response.clicked() {
            let slot = self.tools.tube;
            self.with_panels(|_, cx| squeeze(cx, slot, surface, x_mm, y_mm));
        }
    }
}
