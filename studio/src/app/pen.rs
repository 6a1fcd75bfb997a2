//! What the pen does, handed on to the worker.

use std::time::Instant;

use eframe::egui::{Context, Order, Popup, RawInput, Ui};
use render::paint::strokes::SurfaceId;

use super::Studio;
use super::surfaces::Hover;
use crate::panels::Mode;
use crate::pen::{Device, PenEvent, PenTargets, SurfaceTransform};
use session::Command;

/// The brush that the other end of a pen is, if the stand has it: it scrapes.
const ERASER: &str = "knife";

impl Studio {
    /// Hears the pens of the system, before the window's library sees the input.
    pub fn raw_input(&mut self, context: &Context, input: &mut RawInput) {
        self.pen.read_systems(context, input);
    }

    /// Takes in what pen, mouse and fingers did since the last frame, over the
    /// surfaces as they are shown now.
    pub(super) fn lead(&mut self, ui: &Ui, mode: Mode) {
        let now = Instant::now();
        let Some(easel) = self.easel.clone() else { return };
        let transforms: Vec<SurfaceTransform> = self
            .surfaces_shown()
            .into_iter()
            .map(|surface| {
                let view = self.view(surface);
                let placement = view.placement();
                SurfaceTransform::new(surface, view.rect(), |point| {
                    let [x, y] = placement.cell(point);
                    (x * easel.cell_mm, y * easel.cell_mm)
                })
            })
            .collect();
        let context = ui.ctx();
        let other = mode != Mode::Paint
            || Popup::is_any_open(context)
            || context.memory(|memory| memory.top_modal_layer().is_some());
        let covered = |point| {
            let above = context.layer_id_at(point);
            other
                || above.is_some_and(|layer| layer.order != Order::Background)
                || self.canvas.split_handle().is_some_and(|handle| handle.contains(point))
                || self.shown.palette
                    && self.palette.rect().contains(point)
                    && self.palette.position(point).is_none()
        };
        let view = PenTargets { surfaces: &transforms, covered: &covered };
        // Copied: the context is asked for what covers a place meanwhile.
        let (heard, modifiers) = ui.input(|input| (input.events.clone(), input.modifiers));
        let events = self.pen.process_frame(&heard, modifiers, now, &view);
        events.into_iter().for_each(|event| self.led(event));
        if let Some(soon) = self.pen.repaint_after(Instant::now()) {
            context.request_repaint_after(soon);
        }
    }

    fn led(&mut self, event: PenEvent) {
        match event {
            PenEvent::Down { surface, device } => {
                self.hover = None;
                let brush = self.brush_of(device);
                self.ask(Command::PenDown { surface, brush });
            }
            PenEvent::Move(samples) => self.ask(Command::PenMove(samples)),
            PenEvent::Up => {
                self.head = None;
                self.ask(Command::PenUp);
            }
            PenEvent::Hover { surface, sample, device } => {
                let brush = self.brush_of(device);
                self.hover = Some(Hover { surface, sample, brush });
            }
            PenEvent::Leave => self.hover = None,
            // The button nearer to the tip picks, the other moves the view.
            PenEvent::Barrel { button, pressed } => {
                let mode = if button == 0 { Mode::Pick } else { Mode::Pan };
                self.keys.barrel(pressed.then_some(mode));
            }
        }
    }

    fn brush_of(&self, device: Device) -> String {
        let stand = self.easel.iter().flat_map(|easel| &easel.brushes);
        let eraser = device == Device::Eraser && stand.into_iter().any(|is| is.name == ERASER);
        if eraser { ERASER.to_owned() } else { self.tools.brush.clone() }
    }

    /// The surfaces in the window, those on top first.
    pub(super) fn surfaces_shown(&self) -> Vec<SurfaceId> {
        let palette = self.shown.palette && self.shown.panels;
        if palette { vec![SurfaceId::Palette, SurfaceId::Canvas] } else { vec![SurfaceId::Canvas] }
    }
}
