//! Draws canvas, palette and reference picture, and handles tools other than the brush.

use std::time::Duration;

use eframe::egui::{
    Frame, Margin, Panel, PointerButton, Rect, Response, ScrollArea, Stroke, StrokeKind, Ui,
    UiBuilder, vec2,
};
use paint::strokes::SurfaceId;

use super::crop::CropAnswer;
use super::places::{self, Part};
use super::side::{Line, Tab, divider};
use super::studio::Studio;
use crate::floating;
use crate::language::tr;
use crate::panels::tubes::{DraggedTube, least_width, squeeze};
use crate::panels::{FileRequest, Mode, PanelContext, Request, figures};
use crate::theme;
use crate::view::{DragMode, Split, fill_rect};
use session::{Command, PaintingState};

/// Least height of palette and tubes, in points.
const LOWEST_PALETTE: f32 = 150.0;

/// Least height for touch: all tubes and the controls below them.
const TOUCH_PALETTE: f32 = 288.0;

/// Largest height of palette and tubes that the painter did not choose, in points.
const HIGHEST_PALETTE: f32 = 420.0;

/// Margins around the tubes, in points.
const SHELF: f32 = 32.0;

/// Height of the edge that is dragged to resize palette and tubes, in points.
const EDGE: f32 = 7.0;

impl Studio {
    /// Draws both surfaces in the remaining part of the window.
    pub(super) fn draw_surfaces(&mut self, ui: &mut Ui) {
        let mode = self.keys.mode(self.tools.mode);
        let drag = match mode {
            Mode::Pan => DragMode::Pan,
            Mode::Rotate => DragMode::Rotate,
            Mode::Zoom => DragMode::Zoom,
            Mode::Paint | Mode::Pick | Mode::Squeeze => DragMode::None,
            Mode::Blend | Mode::Scrape | Mode::Erase | Mode::Mask => DragMode::None,
        };
        fill_rect(ui.painter(), ui.max_rect(), theme::SURROUND);
        floating::set_room(ui.ctx(), ui.max_rect());
        if self.visible.palette && self.visible.panels {
            let height = self.palette_height(ui);
            Panel::bottom("palette")
                .frame(Frame::NONE)
                .resizable(false)
                .exact_size(height)
                .show_separator_line(false)
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
        self.draw_crop_bar(ui);
        let area = ui.available_rect_before_wrap();
        let painting = self.painting.clone();
        let lights = painting.as_ref().and_then(|painting| lights_of(painting));
        let split = lights.map(|lights| Split { at: &mut self.tools.split, lights });
        let response = self.canvas.show(ui, area, drag, split);
        self.draw_over(ui, &response);
        self.draw_aids(ui);
        if !self.is_framing() {
            self.handle_tool(ui, SurfaceId::Canvas, &response, mode);
            self.draw_mask(ui, &response, mode);
        }
        let events = ui.input(|input| input.events.clone());
        self.update_pen(ui.ctx(), &events, mode);
        self.draw_first_steps(ui);
        if !self.is_framing() {
            self.draw_cursor(ui, mode);
        }
        if self.tools.figures {
            let backend = painting.as_ref().map_or("", |painting| painting.backend.as_str());
            figures::overlay(ui, area, self.frames.rate(), self.figures, backend);
            ui.ctx().request_repaint_after(Duration::from_millis(250));
        }
    }

    /// Height of palette and tubes: that which the painter chose, or else a share of the
    /// window.
    fn palette_height(&self, ui: &Ui) -> f32 {
        let room = ui.available_height();
        let large = theme::is_touch(ui.ctx()) && !theme::is_narrow(ui.ctx());
        let lowest = if large { TOUCH_PALETTE } else { LOWEST_PALETTE };
        let usual = (0.3 * room).clamp(lowest, HIGHEST_PALETTE);
        let least = LOWEST_PALETTE.min(room);
        self.panels
            .arrangement
            .palette_height
            .unwrap_or(usual)
            .clamp(least, (0.6 * room).max(least))
    }

    /// Whether the pointer frames a crop or moves the reference picture instead of painting.
    pub(super) fn is_framing(&self) -> bool {
        self.crop.is_some() || self.panels.reference.takes_pointer()
    }

    /// Draws what lies over the canvas: the reference picture and the frame of a crop.
    fn draw_over(&mut self, ui: &Ui, response: &Response) {
        let Some(cell_mm) = self.painting.as_ref().map(|painting| painting.cell_mm) else { return };
        self.panels.reference.show_over(ui, &self.canvas, response, cell_mm);
        let answer = self.crop.as_mut().and_then(|crop| crop.show(ui, &self.canvas, response));
        self.carry_out(answer);
    }

    /// Draws the bar of a crop above the canvas, which yields to it.
    fn draw_crop_bar(&mut self, ui: &mut Ui) {
        let Some(cell_mm) = self.painting.as_ref().map(|painting| painting.cell_mm) else { return };
        let Some(crop) = &mut self.crop else { return };
        let bar = Panel::top("crop bar").frame(Frame::new().inner_margin(Margin::symmetric(10, 6)));
        let answer = bar.show_separator_line(false).show(ui, |ui| {
            fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).panel);
            crop.bar(ui, cell_mm)
        });
        self.carry_out(answer.inner);
    }

    fn carry_out(&mut self, answer: Option<CropAnswer>) {
        if answer.is_some() {
            self.crop = None;
        }
        if let Some(CropAnswer::Crop(rect)) = answer {
            self.requests.push(Request::File(FileRequest::Crop(rect)));
        }
    }

    /// Draws the palette with the tubes beside it.
    fn draw_palette(&mut self, ui: &mut Ui, drag: DragMode, mode: Mode) {
        let whole = ui.available_rect_before_wrap();
        // The panel keeps its height, whatever its contents.
        ui.expand_to_include_rect(whole);
        let cells = self.palette.cells();
        // The tubes have room in their rows; the palette yields, up to a third of the width.
        let tubes = least_width(ui, whole.height() - SHELF) + SHELF;
        let [least, most] = [0.34, 0.6].map(|share| share * whole.width().max(0.0));
        let most = (whole.width() - tubes).clamp(least, most);
        let width = (whole.height() * cells.0 as f32 / cells.1 as f32).min(most);
        let area = Rect::from_min_size(whole.min, vec2(width, whole.height()));
        let response = self.palette.show(ui, area, drag, None);
        let painting = self.painting.clone();
        if let Some(lights) = painting.as_ref().and_then(|painting| lights_of(painting)) {
            self.palette.show_light_switch(ui, lights);
        }
        self.handle_tool(ui, SurfaceId::Palette, &response, mode);
        let edge = Rect::from_min_size(whole.min, vec2(whole.width(), EDGE));
        let moved = divider(ui, edge, tr("Height of the palette"), Line::Level);
        if moved != 0.0 {
            self.panels.arrangement.palette_height = Some(whole.height() - moved);
        }
        let tubes_rect = Rect::from_min_max(area.right_top(), whole.right_bottom());
        let tubes_rect = tubes_rect.shrink2(vec2(6.0, 8.0));
        places::note(ui.ctx(), Part::Tubes, tubes_rect);
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
        let pressed = ui.input(|input| input.pointer.button_pressed(PointerButton::Secondary));
        if let Some(point) = pointer.filter(|_| pressed && response.contains_pointer()) {
            self.open_quick_palette(ui.ctx(), point, true);
        }
        let primary = ui.input(|input| input.pointer.button_down(PointerButton::Primary));
        let held = primary && response.is_pointer_button_down_on();
        // Pressed and released within a frame, the pen is never held.
        if mode == Mode::Pick && (held || response.clicked()) {
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

/// Names of the first and the second light, if there are two.
fn lights_of(painting: &PaintingState) -> Option<[&str; 2]> {
    let second = painting.second_lighting.as_ref()?;
    Some([painting.lighting.illuminant.as_str(), second.illuminant.as_str()])
}
