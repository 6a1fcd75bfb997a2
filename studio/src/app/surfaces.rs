//! Canvas and palette, and what the pen does on them.

use std::time::Duration;

use eframe::egui::{
    Frame, Margin, Panel, PointerButton, Rect, Response, ScrollArea, Stroke, StrokeKind, Ui,
    UiBuilder, pos2, vec2,
};
use render::paint::pose::Sample;
use render::paint::strokes::SurfaceId;

use super::Studio;
use super::side::Tab;
use crate::panels::tubes::{DraggedTube, squeeze};
use crate::panels::{Desk, Mode, figures};
use crate::theme;
use crate::view::{DragMode, Split, fill_rect};
use session::Command;

/// The most that the tubes take beside the palette, in points.
const SHELF: f32 = 640.0;

/// Where the brush hovers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Hover {
    /// Over which surface.
    pub(super) surface: SurfaceId,
    /// How it is held.
    pub(super) sample: Sample,
    /// Which brush.
    pub(super) brush: String,
}

impl Studio {
    /// Shows both surfaces in what is left of the window.
    pub(super) fn surfaces(&mut self, ui: &mut Ui) {
        let mode = self.keys.mode(self.tools.mode);
        let drag = match mode {
            Mode::Pan => DragMode::Pan,
            Mode::Rotate => DragMode::Rotate,
            Mode::Zoom => DragMode::Zoom,
            Mode::Paint | Mode::Pick | Mode::Squeeze => DragMode::None,
        };
        fill_rect(ui.painter(), ui.max_rect(), theme::SURROUND);
        if self.shown.palette && self.shown.panels {
            let height = (0.3 * ui.available_height()).clamp(150.0, 236.0);
            Panel::bottom("palette")
                .frame(Frame::NONE)
                .resizable(true)
                .show_separator_line(false)
                .default_size(height)
                .size_range(110.0..=520.0)
                .show(ui, |ui| self.table(ui, drag, mode));
        }
        if self.panels.reference.is_open() && self.shown.panels {
            Panel::left("reference")
                .frame(Frame::new().inner_margin(Margin::same(6)))
                .show_separator_line(false)
                .default_size(0.3 * ui.available_width())
                .size_range(160.0..=0.6 * ui.available_width())
                .show(ui, |ui| {
                    fill_rect(ui.painter(), ui.clip_rect(), theme::PANEL);
                    let before = self.tools.wanted;
                    self.with_desk(|panels, desk| panels.reference.show(ui, desk));
                    if self.tools.wanted != before {
                        self.panels.bring(Tab::Color);
                    }
                });
        }
        let room = ui.available_rect_before_wrap();
        let easel = self.easel.clone();
        let lights = easel.as_ref().and_then(|easel| {
            let second = easel.second_lighting.as_ref()?;
            Some([easel.lighting.illuminant.as_str(), second.illuminant.as_str()])
        });
        let split = lights.map(|lights| Split { at: &mut self.tools.split, lights });
        let response = self.canvas.show(ui, room, drag, split);
        self.used(ui, SurfaceId::Canvas, &response, mode);
        self.lead(ui, mode);
        self.cursor(ui, mode);
        if self.tools.figures {
            let backend = easel.as_ref().map_or("", |easel| easel.backend.as_str());
            figures::overlay(ui, room, self.frames.rate(), self.figures, backend);
            ui.ctx().request_repaint_after(Duration::from_millis(250));
        }
    }

    /// The palette with the tubes beside it.
    fn table(&mut self, ui: &mut Ui, drag: DragMode, mode: Mode) {
        let whole = ui.available_rect_before_wrap();
        // The table keeps its height, whatever lies on it.
        ui.expand_to_include_rect(whole);
        let cells = self.palette.cells();
        let width = (whole.height() * cells.0 as f32 / cells.1 as f32).min(0.6 * whole.width());
        let room = Rect::from_min_size(whole.min, vec2(width, whole.height()));
        let response = self.palette.show(ui, room, drag, None);
        self.used(ui, SurfaceId::Palette, &response, mode);
        let right = whole.right().min(room.right() + SHELF);
        let beside = Rect::from_min_max(room.right_top(), pos2(right, whole.bottom()));
        let beside = beside.shrink2(vec2(6.0, 8.0));
        let mut ui = ui.new_child(UiBuilder::new().max_rect(beside));
        // The middle at little cost; the rest is a line with round corners.
        fill_rect(ui.painter(), beside.shrink(1.0), theme::PANEL);
        let edge = Stroke::new(3.0, theme::PANEL);
        ui.painter().rect_stroke(beside, 6, edge, StrokeKind::Inside);
        let shelf = Frame::new().inner_margin(Margin::same(8));
        shelf.show(&mut ui, |ui| {
            ui.set_min_size(ui.available_size());
            ScrollArea::vertical().show(ui, |ui| {
                let Some(easel) = &self.easel.clone() else { return };
                let asked = &mut self.asked;
                let mut desk = Desk { easel, tools: &mut self.tools, asked };
                self.panels.tubes.show(ui, &mut desk);
            });
        });
    }

    /// What tools other than the brush do on a surface.
    fn used(&mut self, ui: &Ui, surface: SurfaceId, response: &Response, mode: Mode) {
        let Some(cell_mm) = self.easel.as_ref().map(|easel| easel.cell_mm) else { return };
        let pointer = ui.input(|input| input.pointer.latest_pos());
        let Some(place) = pointer.and_then(|point| self.view(surface).position(point)) else {
            return;
        };
        let [x_mm, y_mm] = place.map(|cells| cells * cell_mm);
        if let Some(tube) = response.dnd_release_payload::<DraggedTube>() {
            self.with_desk(|_, desk| squeeze(desk, tube.slot, surface, x_mm, y_mm));
        }
        let primary = ui.input(|input| input.pointer.button_down(PointerButton::Primary));
        if mode == Mode::Pick && primary && response.is_pointer_button_down_on() {
            let place = (surface, x_mm.to_bits(), y_mm.to_bits());
            if self.asked_at != Some(place) {
                self.asked_at = Some(place);
                let radius_mm = self.tools.pick_radius_mm;
                self.ask(Command::Pick { surface, x_mm, y_mm, radius_mm });
            }
        }
        if mode == Mode::Squeeze && response.clicked() {
            let slot = self.tools.tube;
            self.with_desk(|_, desk| squeeze(desk, slot, surface, x_mm, y_mm));
        }
    }

    /// Where a surface is in the window.
    pub(super) fn view(&self, surface: SurfaceId) -> &crate::view::SurfaceView {
        match surface {
            SurfaceId::Canvas => &self.canvas,
            SurfaceId::Palette => &self.palette,
        }
    }
}
