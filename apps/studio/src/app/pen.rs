//! Passes the input of pen, mouse and touch on to the worker.

use web_time::Instant;

use eframe::egui::{Context, Event, Order, Popup, RawInput};
use paint::strokes::{SampleDecimals, StrokeTool, SurfaceId};

use super::hover::Hover;
use super::intent::Intent;
use super::studio::Studio;
use super::twins::TwinStrokes;
use crate::pace;
use crate::panels::{Mode, Request};
use crate::pen::{Device, PenEvent, PenTargets, SurfaceTransform};
use session::Command;

/// Brush used for the eraser end of a pen, if the painting has it.
const ERASER: &str = "knife";

impl Studio {
    /// Reads the system's pen devices. Call before egui processes the input.
    pub fn raw_input(&mut self, context: &Context, input: &mut RawInput) {
        self.pen.read_systems(context, input);
    }

    /// Processes egui's pointer events and what the pens reported since the last call, with the
    /// current placement of the surfaces.
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
        let covered = |point| {
            let above = context.layer_id_at(point);
            blocked
                || above.is_some_and(|layer| layer.order != Order::Background)
                || self.canvas.split_handle().is_some_and(|handle| handle.contains(point))
                || self.aid_handles.iter().any(|handle| handle.contains(point))
                || self.palette.light_switch().is_some_and(|switch| switch.contains(point))
                || self.visible.palette
                    && self.palette.rect().contains(point)
                    && self.palette.position(point).is_none()
        };
        let view = PenTargets { surfaces: &transforms, covered: &covered };
        // Copied, because `covered` queries the context while the events are processed.
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

    /// Notes a command that goes to the worker.
    pub(super) fn note_command(&mut self, command: &Command) {
        self.stroke_cut = cut_after(self.stroke_cut, command);
    }

    /// Whether a command ended the open stroke before its pen was lifted: then it has no twins.
    fn is_stroke_cut(&self) -> bool {
        let queued = self.requests.iter().filter_map(|request| match request {
            Request::Worker(command) => Some(command),
            Request::File(_) => None,
        });
        queued.fold(self.stroke_cut, cut_after)
    }

    /// Name of the brush that a device moves.
    pub(super) fn brush_for(&self, device: Device) -> String {
        let brushes = self.painting.iter().flat_map(|painting| &painting.brushes);
        let eraser =
            device == Device::Eraser && brushes.into_iter().any(|brush| brush.name == ERASER);
        if eraser { ERASER.to_owned() } else { self.tools.brush.clone() }
    }
}

/// Whether a stroke that began with its group is cut after a command, if it was `cut` before.
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

/// The command that sets a brush down as a tool.
fn down(tool: StrokeTool, surface: SurfaceId, brush: String) -> Command {
    if tool.is_paint() {
        Command::PenDown { surface, brush, decimals: SampleDecimals::PEN }
    } else {
        Command::ToolDown { tool, surface, brush }
    }
}
