//! Draws canvas, palette and reference picture with cursor, mask and drawing aids, and passes the
//! input of pen, mouse and touch and the requests of the panels to the worker.

use std::time::Duration;

use eframe::egui::{
    Color32, Context, CursorIcon, Event, Frame, Id, Margin, Order, Painter, Panel, PointerButton,
    Popup, Pos2, RawInput, Rect, Response, Role, ScrollArea, Sense, Shape, Stroke, StrokeKind, Ui,
    UiBuilder, Vec2, WidgetInfo, pos2, vec2,
};
use graphics::tile::Rect as TileRect;
use paint::strokes::{Action, MaskChange, SampleDecimals, StrokeTool, SurfaceId};
use session::{Command, MaskState, PaintingState};
use web_time::Instant;

use super::crop::CropAnswer;
use super::hover::{DASH, Hover, HoveringHead, TwinStrokes};
use super::intent::{self, Intent, Part};
use super::side::{Line, Tab, divider};
use super::studio::Studio;
use crate::language::tr;
use crate::panels::tubes::{DraggedTube, least_width, squeeze};
use crate::panels::{FileRequest, Mode, PanelContext, Request, aids, figures};
use crate::pen::{
    AidHandle, AidLines, Device, DrawingAids, GuideKind, PenEvent, PenTargets, SurfaceTransform,
};
use crate::view::{DragMode, Placement, Split, fill_rect};
use crate::{floating, pace, theme};

/// Smallest height of palette and tubes, in points.
const LOWEST_PALETTE: f32 = 150.0;

/// Smallest usual height of palette and tubes in touch mode, in points. All tubes and the controls
/// below them have room.
const TOUCH_PALETTE: f32 = 288.0;

/// Largest usual height of palette and tubes, in points. You can drag their edge higher.
const HIGHEST_PALETTE: f32 = 420.0;

const SHELF: f32 = 32.0;

/// Height of the edge that you drag to resize palette and tubes, in points.
const EDGE: f32 = 7.0;

impl Studio {
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

    /// Height of palette and tubes: the one that the painter chose, or else a share of the window.
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

    /// True while the pointer frames a crop or moves the reference picture. You cannot paint then.
    pub(super) fn is_framing(&self) -> bool {
        self.crop.is_some() || self.panels.reference.takes_pointer()
    }

    fn draw_over(&mut self, ui: &Ui, response: &Response) {
        let Some(cell_mm) = self.painting.as_ref().map(|painting| painting.cell_mm) else { return };
        self.panels.reference.show_over(ui, &self.canvas, response, cell_mm);
        let answer = self.crop.as_mut().and_then(|crop| crop.show(ui, &self.canvas, response));
        self.carry_out(answer);
    }

    /// Draws the bar of a crop above the canvas, which becomes smaller.
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

    fn draw_palette(&mut self, ui: &mut Ui, drag: DragMode, mode: Mode) {
        let whole = ui.available_rect_before_wrap();
        // The panel keeps its height, whatever its contents.
        ui.expand_to_include_rect(whole);
        let cells = self.palette.cells();
        // The tubes need room in their rows. The palette gives up to a third of the width to them.
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
        intent::note(ui.ctx(), Part::Tubes, tubes_rect);
        let mut ui = ui.new_child(UiBuilder::new().max_rect(tubes_rect));
        // We draw a plain rectangle, because this is cheap, and a thick outline for the rounded
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
        // If you press and release within one frame, we never see the pen held.
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

    /// Reads the system's pen devices. Call before egui processes the input.
    pub fn raw_input(&mut self, context: &Context, input: &mut RawInput) {
        self.pen.read_systems(context, input);
    }

    /// Processes egui's pointer events and the reports of the pens since the last call. The
    /// surfaces lie where they are now.
    pub(super) fn update_pen(&mut self, context: &Context, events: &[Event], mode: Mode) {
        let now = Instant::now();
        let Some(painting) = self.painting.clone() else { return };
        let transforms: Vec<SurfaceTransform> = self
            .visible_surfaces()
            .into_iter()
            .map(|surface| {
                let view = self.view(surface);
                let placement = view.placement();
                SurfaceTransform::new(surface, view.rect(), |point| {
                    let [x, y] = placement.cell(point);
                    (x * painting.cell_mm, y * painting.cell_mm)
                })
            })
            .collect();
        let blocked = !mode.moves_head()
            || self.quick.is_some()
            || self.is_framing()
            || self.shows_sheet(context)
            || Popup::is_any_open(context)
            || context.memory(|memory| memory.top_modal_layer().is_some());
        let view = PenTargets {
            surfaces: &transforms,
            covered: &|point| {
                let above = context.layer_id_at(point);
                blocked
                    || above.is_some_and(|layer| layer.order != Order::Background)
                    || self.canvas.split_handle().is_some_and(|handle| handle.contains(point))
                    || self.aid_handles.iter().any(|handle| handle.contains(point))
                    || self.palette.light_switch().is_some_and(|switch| switch.contains(point))
                    || self.visible.palette
                        && self.palette.rect().contains(point)
                        && self.palette.position(point).is_none()
            },
        };
        // We copy this, because `covered` queries the context while the events are processed.
        let modifiers = context.input(|input| input.modifiers);
        self.pen.guide = self.aids.leading();
        let events = self.pen.process_frame(events, modifiers, now, &view);
        events.into_iter().for_each(|event| self.handle_pen_event(event, context));
        if let Some(soon) = self.pen.repaint_after(Instant::now()) {
            pace::frame_after(context, soon, Instant::now());
        }
    }

    fn handle_pen_event(&mut self, event: PenEvent, context: &Context) {
        match event {
            PenEvent::Down { surface, device } => {
                self.hover = None;
                self.visible.first_steps = false;
                self.files.preferences.first_steps_seen = true;
                let brush = self.brush_for(device);
                let tool = self.tools.stroke_tool(self.keys.mode(self.tools.mode));
                let symmetry = self.aids.symmetry;
                self.twins = (symmetry.on && surface == SurfaceId::Canvas)
                    .then(|| TwinStrokes::new(symmetry.twins(), tool, &brush));
                if self.twins.is_some() {
                    self.ask(Command::BeginGroup);
                }
                self.ask(down(tool, surface, brush));
            }
            PenEvent::Move(samples) => {
                if let Some(twins) = &mut self.twins {
                    twins.extend(&samples);
                }
                self.ask(Command::PenMove(samples));
            }
            PenEvent::Up => {
                self.head = None;
                self.ask(Command::PenUp);
                let cut = self.is_stroke_cut();
                if let Some(twins) = self.twins.take().filter(|_| !cut) {
                    let (tool, brush) = twins.tool();
                    twins
                        .commands(|| down(tool, SurfaceId::Canvas, brush.to_owned()))
                        .into_iter()
                        .for_each(|command| self.ask(command));
                    self.ask(Command::EndGroup);
                }
            }
            PenEvent::Hover { surface, sample, device } => {
                let brush = self.brush_for(device);
                self.hover = Some(Hover { surface, sample, brush });
            }
            PenEvent::Leave => self.hover = None,
            PenEvent::Tap { fingers: 2 } => self.perform(Intent::Undo, context),
            PenEvent::Tap { fingers: 3 } => self.perform(Intent::Redo, context),
            PenEvent::Tap { .. } => {}
            // The button nearer to the tip picks a colour, the other one pans the view.
            PenEvent::Barrel { button, pressed } => {
                let mode = if button == 0 { Mode::Pick } else { Mode::Pan };
                self.keys.barrel(pressed.then_some(mode));
            }
        }
    }

    /// Queues a command for the worker, after the requests of the panels.
    pub fn ask(&mut self, command: Command) {
        self.requests.push(Request::Worker(command));
    }

    /// Passes the queued requests on in order. File requests wait until a painting is open.
    pub(super) fn send_requests(&mut self) {
        for request in std::mem::take(&mut self.requests) {
            match (request, &self.painting) {
                (Request::Worker(command), _) => self.send(command),
                (Request::File(request), Some(painting)) => self.files.request(request, painting),
                // No painting is open yet.
                (request, None) => self.requests.push(request),
            }
        }
    }

    pub(super) fn send(&mut self, command: Command) {
        self.stroke_cut = cut_after(self.stroke_cut, &command);
        self.worker.ask(command);
    }

    /// Whether a command ended the open stroke before you lifted the pen. Such a stroke has no
    /// twins.
    fn is_stroke_cut(&self) -> bool {
        let queued = self.requests.iter().filter_map(|request| match request {
            Request::Worker(command) => Some(command),
            Request::File(_) => None,
        });
        queued.fold(self.stroke_cut, cut_after)
    }

    /// Name of the brush that this device moves.
    pub(super) fn brush_for(&self, device: Device) -> String {
        let brushes = self.painting.iter().flat_map(|painting| &painting.brushes);
        let eraser =
            device == Device::Eraser && brushes.into_iter().any(|brush| brush.name == ERASER);
        if eraser { ERASER.to_owned() } else { self.tools.brush.clone() }
    }

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

    /// Colour of the paint on the brush. `None` if the tool does not paint, or the brush is bare.
    pub(super) fn head_paint(&self) -> Option<[u8; 3]> {
        let painting = self.painting.as_ref()?;
        let brush = painting.brushes.iter().find(|brush| brush.name == self.tools.brush)?;
        brush.color.filter(|_| self.keys.mode(self.tools.mode) == Mode::Paint)
    }

    /// Draws the line from a stabilised brush to its pen. It is dark with a light core, so that you
    /// see it on every paint.
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
        let Some(surface) = self
            .visible_surfaces()
            .into_iter()
            .find(|surface| self.view(*surface).position(point).is_some())
        else {
            return;
        };
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
            SurfaceId::Palette => view.shows_second_light(),
        };
        let second = view.picture(true).filter(|_| beyond);
        let x = x as usize;
        let y = y as usize;
        let cell = second.or(view.picture(false))?.pixels(TileRect { x, y, width: 1, height: 1 });
        cell.pixels.first().copied()
    }

    /// Draws the outline of the mask. In the mask mode, this also takes the points of the polygon
    /// that you draw.
    pub(super) fn draw_mask(&mut self, ui: &Ui, response: &Response, mode: Mode) {
        let Some(painting) = self.painting.clone() else { return };
        let painter = ui.painter_at(self.canvas.rect());
        let placement = self.canvas.placement();
        let (now, happens) = ui.input(|input| (input.time, !input.events.is_empty()));
        let (phase, moves) = self.mask_dashes.phase(now, happens);
        if let Some(mask) = &painting.mask {
            draw_outline(&painter, &placement, mask, phase);
            if moves {
                ui.ctx().request_repaint_after(Duration::from_millis(120));
            }
        }
        if mode != Mode::Mask {
            self.mask_points.clear();
            return;
        }
        self.take_points(ui, response, &placement);
        let points: Vec<Pos2> = self.mask_points.iter().map(|&at| placement.point(at)).collect();
        for pair in points.windows(2) {
            march(&painter, [pair[0], pair[1]], phase);
        }
        if response.drag_stopped_by(PointerButton::Primary) {
            let polygon: Vec<[f64; 2]> = std::mem::take(&mut self.mask_points)
                .into_iter()
                .map(|point| point.map(|cells| cells * painting.cell_mm))
                .collect();
            if polygon.len() >= 3 {
                self.ask(Command::Apply(Action::Mask(MaskChange::PolygonMm(polygon))));
            }
        }
    }

    /// Takes the point under the pointer. With shift, the points are corners of a rectangle.
    fn take_points(&mut self, ui: &Ui, response: &Response, placement: &Placement) {
        if response.drag_started_by(PointerButton::Primary) {
            let start = ui.input(|input| input.pointer.press_origin());
            self.mask_points = start.map(|start| placement.cell(start)).into_iter().collect();
        }
        let held = response.dragged_by(PointerButton::Primary).then_some(());
        let Some(now) = held.and_then(|()| response.interact_pointer_pos()) else { return };
        let Some(&first) = self.mask_points.first() else { return };
        if ui.input(|input| input.modifiers.shift) {
            let from = placement.point(first);
            let to = now;
            let corners = [from, pos2(to.x, from.y), to, pos2(from.x, to.y), from];
            self.mask_points = corners.map(|corner| placement.cell(corner)).to_vec();
            self.mask_points[0] = first;
        } else if let Some(&last) = self.mask_points.last()
            && placement.point(last).distance(now) >= STEP
            && self.mask_points.len() < MOST_POINTS
        {
            self.mask_points.push(placement.cell(now));
        }
    }

    /// Shows a cross over the canvas.
    pub(super) fn draw_mask_cursor(&self, ui: &Ui) {
        let over = ui.input(|input| input.pointer.hover_pos());
        if over.is_some_and(|point| self.canvas.position(point).is_some()) {
            ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
        }
    }

    fn canvas_mm(painting: &PaintingState) -> [f64; 2] {
        let (columns, rows) = painting.canvas_cells;
        [columns, rows].map(|cells| cells as f64 * painting.cell_mm)
    }

    /// Shows or hides a guide, with a message.
    pub(super) fn toggle_guide(&mut self, kind: GuideKind) {
        self.aids.toggle(kind);
        let text = match (kind, self.aids.guide.is_some(), self.aids.snaps) {
            (GuideKind::Ruler, false, _) => tr("the ruler is off"),
            (GuideKind::Ruler, true, true) => tr("strokes follow the ruler"),
            (GuideKind::Ruler, true, false) => tr("the ruler is shown"),
            (GuideKind::Perspective, false, _) => tr("the perspective guide is off"),
            (GuideKind::Perspective, true, true) => tr("strokes follow the perspective guide"),
            (GuideKind::Perspective, true, false) => tr("the perspective guide is shown"),
        };
        self.say_of_aids(text.to_owned());
    }

    /// Switches whether strokes follow the guide, with a message.
    pub(super) fn toggle_snapping(&mut self) {
        self.aids.snaps ^= true;
        let text = match (self.aids.snaps, self.aids.guide) {
            (true, Some(_)) => tr("strokes follow the guide"),
            (true, None) => tr("strokes follow the guide once one is shown"),
            (false, _) => tr("strokes are free"),
        };
        self.say_of_aids(text.to_owned());
    }

    pub(super) fn toggle_symmetry(&mut self) {
        self.aids.symmetry.on ^= true;
        let text = match self.aids.symmetry.on {
            true => tr("strokes are repeated by symmetry when they end"),
            false => tr("symmetry is off"),
        };
        self.say_of_aids(text.to_owned());
    }

    fn say_of_aids(&mut self, text: String) {
        let hint = tr("Tools, Drawing aids has handles and settings").to_owned();
        self.show_message(text, Some(hint), false);
    }

    pub(super) fn draw_aids_window(&mut self, context: &Context) {
        aids::show(context, &mut self.visible.aids, &mut self.aids);
    }

    /// Draws the aids over the canvas. Their handles appear only while the window of the aids is
    /// open.
    pub(super) fn draw_aids(&mut self, ui: &Ui) {
        self.aid_handles.clear();
        let Some(painting) = self.painting.clone() else { return };
        self.aids.fit(Self::canvas_mm(&painting));
        let placement = self.canvas.placement();
        let view = self.canvas.rect();
        let on_canvas = OnCanvas { placement, cell_mm: painting.cell_mm, view };
        let painter = ui.painter_at(view);
        draw_lines(&painter, &on_canvas, &self.aids.lines());
        if let Some(twins) = &self.twins {
            twins.draw(&painter, &placement, painting.cell_mm);
        }
        if !self.visible.aids || self.is_framing() {
            return;
        }
        for handle in self.aids.handles() {
            let rect = on_canvas.handle(self.aids.place_of(handle), handle_size(ui));
            self.drag_aid(ui, &on_canvas, handle, rect);
            self.aid_handles.push(rect);
        }
        draw_handles(&painter, ui, &on_canvas, &self.aids);
    }

    fn drag_aid(&mut self, ui: &Ui, on_canvas: &OnCanvas, handle: AidHandle, rect: Rect) {
        let name = handle.name();
        let response = ui.interact(rect, Id::unique(("drawing aid", &name)), Sense::drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
        let place = self.aids.place_of(handle);
        if response.drag_started()
            && let Some(from) = ui.input(|input| input.pointer.press_origin())
        {
            let from = on_canvas.mm(from);
            self.aid_grabbed = [place[0] - from[0], place[1] - from[1]];
        }
        if let Some(point) = response.interact_pointer_pos().filter(|_| response.dragged()) {
            let to = on_canvas.mm(point);
            let [right, down] = self.aid_grabbed;
            self.aids.move_to(handle, [to[0] + right, to[1] + down]);
        }
        response.on_hover_cursor(CursorIcon::Grab).on_hover_text(name);
    }
}

fn lights_of(painting: &PaintingState) -> Option<[&str; 2]> {
    let second = painting.second_lighting.as_ref()?;
    Some([painting.lighting.illuminant.as_str(), second.illuminant.as_str()])
}

/// Brush used for the eraser end of a pen, if the painting has it.
const ERASER: &str = "knife";

/// Whether the stroke of the last group is cut: a command came that is neither a part of a stroke
/// nor a question. `cut` says this for the commands before `command`.
fn cut_after(cut: bool, command: &Command) -> bool {
    match command {
        Command::BeginGroup => false,
        Command::PenDown { .. }
        | Command::ToolDown { .. }
        | Command::PenMove(_)
        | Command::PenUp
        | Command::EndGroup => cut,
        other => cut || !other.is_question(),
    }
}

fn down(tool: StrokeTool, surface: SurfaceId, brush: String) -> Command {
    if tool.is_paint() {
        Command::PenDown { surface, brush, decimals: SampleDecimals::PEN }
    } else {
        Command::ToolDown { tool, surface, brush }
    }
}

const RING: f32 = 24.0;

/// The pen adds another point to a polygon when it has moved this far, in points.
const STEP: f32 = 3.0;

const WIDTH: f32 = 1.2;

/// Most points of a polygon. A script allows no more.
const MOST_POINTS: usize = 4000;

/// Draws the outline of a mask as dashes that have moved by `phase` points.
fn draw_outline(painter: &Painter, placement: &Placement, mask: &MaskState, phase: f32) {
    let seen = painter.clip_rect().expand(2.0);
    for line in &mask.outline {
        let ends = line.map(|(x, y)| placement.point([f64::from(x), f64::from(y)]));
        if seen.intersects(Rect::from_two_pos(ends[0], ends[1])) {
            march(painter, ends, phase);
        }
    }
}

/// Draws a line in black and white dashes. The dashes depend on the place in the window, so that
/// they continue from one line to the next.
fn march(painter: &Painter, [from, to]: [Pos2; 2], phase: f32) {
    let way = to - from;
    // The steps of the outline are shorter than the line is wide. Longer ends close the corners.
    let cap = 0.5 * WIDTH * way.normalized();
    let start = from.x + from.y + phase;
    let end = to.x + to.y + phase;
    let run = end - start;
    if run.abs() < 0.01 {
        painter.line_segment([from, to], Stroke::new(WIDTH, Color32::WHITE));
        return;
    }
    let low = start.min(end);
    let high = start.max(end);
    let mut at = low;
    while at < high - 0.001 {
        let dash = (at / DASH).floor();
        let next = ((dash + 1.0) * DASH).min(high).max(at + 0.01);
        let color = if dash.rem_euclid(2.0) < 0.5 { Color32::BLACK } else { Color32::WHITE };
        painter.line_segment(
            [from + way * ((at - start) / run) - cap, from + way * ((next - start) / run) + cap],
            Stroke::new(WIDTH, color),
        );
        at = next;
    }
}

const HANDLE: f32 = 14.0;

/// Distance from the edge of the view, in points, to which we move a handle from beyond it.
const AIDS_EDGE: f32 = 12.0;

#[derive(Debug, Clone, Copy)]
struct OnCanvas {
    placement: Placement,
    cell_mm: f64,
    view: Rect,
}

impl OnCanvas {
    fn point(&self, mm: [f64; 2]) -> Pos2 {
        self.placement.point(mm.map(|mm| mm / self.cell_mm))
    }

    fn mm(&self, point: Pos2) -> [f64; 2] {
        self.placement.cell(point).map(|cells| cells * self.cell_mm)
    }

    /// Rectangle in which you can touch the handle of this place. If the place lies beyond the
    /// view, the rectangle is at the edge.
    fn handle(&self, place: [f64; 2], size: Vec2) -> Rect {
        let room = self.view.shrink(AIDS_EDGE);
        let point = self.point(place);
        Rect::from_center_size(if room.is_positive() { room.clamp(point) } else { point }, size)
    }
}

fn handle_size(ui: &Ui) -> Vec2 {
    theme::at_least(ui, Vec2::splat(HANDLE + 4.0))
}

fn draw_lines(painter: &Painter, on_canvas: &OnCanvas, lines: &AidLines) {
    for (lines, dark, light) in [(&lines.faint, 28, 60), (&lines.main, 90, 170)] {
        for line in lines {
            let points: Vec<Pos2> = line.iter().map(|&place| on_canvas.point(place)).collect();
            for (width, color) in
                [(2.5, Color32::from_black_alpha(dark)), (1.0, Color32::from_white_alpha(light))]
            {
                painter.add(Shape::line(points.clone(), Stroke::new(width, color)));
            }
        }
    }
}

fn draw_handles(painter: &Painter, ui: &Ui, on_canvas: &OnCanvas, aids: &DrawingAids) {
    let colors = theme::colors(ui.ctx());
    let edge = Stroke::new(1.0, colors.strong);
    for handle in aids.handles() {
        let at = on_canvas.handle(aids.place_of(handle), Vec2::splat(HANDLE)).center();
        painter.circle_filled(at, 0.5 * HANDLE + 1.0, Color32::from_black_alpha(110));
        painter.circle(at, 0.5 * HANDLE - 1.0, colors.panel, edge);
    }
}
