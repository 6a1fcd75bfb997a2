//! The hand in a scene: the pen uses the tool, the middle button and the wheel move the camera.

use web_time::Instant;

use eframe::egui::{Event, Modifiers, PointerButton, Popup, Response, Ui};
use paint::strokes::SurfaceId;

use super::workspace::Volumes;
use crate::pace;
use crate::pen::{Device, Pen, PenEvent, PenTargets, SurfaceTransform};
use session::brushes::{BrushOptions, StabiliserMethod};
use session::volumes::{ScenePen, VolumeCommand};

/// Points of scrolling that zoom by a factor of e, as on the easel.
const WHEEL_POINTS: f32 = 220.0;

impl Volumes {
    /// Turns, moves and zooms the camera by the middle button and the wheel.
    pub(super) fn navigate(&mut self, ui: &Ui, response: &Response) {
        let height = self.rect.height();
        if response.dragged_by(PointerButton::Middle) {
            let moved = response.drag_delta();
            if ui.input(|input| input.modifiers.shift) {
                self.orbit.pan(moved, height);
            } else {
                self.orbit.turn(moved);
            }
        }
        if !response.contains_pointer() {
            return;
        }
        let (scroll, zoom, pointer) = ui.input(|input| {
            (input.smooth_scroll_delta(), input.zoom_delta(), input.pointer.hover_pos())
        });
        let factor = zoom * (scroll.y / WHEEL_POINTS).exp();
        if let Some(pointer) = pointer.filter(|_| factor != 1.0) {
            self.orbit.zoom(factor, pointer - self.rect.center(), height);
        }
    }

    /// Uses the tool in hand where the pen is down.
    pub(super) fn use_tool(&mut self, ui: &Ui, pen: &mut Pen) {
        let context = ui.ctx();
        let corner = self.rect.min;
        // One point of the window is one unit of the pen's plane.
        let plane = SurfaceTransform::new(SurfaceId::Canvas, self.rect, |point| {
            (f64::from(point.x - corner.x), f64::from(point.y - corner.y))
        });
        let blocked = self.state.is_none()
            || Popup::is_any_open(context)
            || context.memory(|memory| memory.top_modal_layer().is_some());
        let covered = |point| {
            let above = context.layer_id_at(point);
            blocked || above.is_some_and(|layer| layer.order != eframe::egui::Order::Background)
        };
        let targets = PenTargets { surfaces: &[plane], covered: &covered };
        let events: Vec<Event> = ui.input(|input| input.events.clone());
        // Paint is poured at once: it has no direction that the pen would wait for, and no brush.
        pen.settings.follow = false;
        pen.settings.stabiliser.method = StabiliserMethod::Off;
        (pen.options, pen.guide) = (BrushOptions::default(), None);
        let now = Instant::now();
        for event in pen.process_frame(&events, Modifiers::NONE, now, &targets) {
            self.handle_pen(event);
        }
        if let Some(soon) = pen.repaint_after(Instant::now()) {
            pace::frame_after(context, soon, Instant::now());
        }
    }

    fn handle_pen(&mut self, event: PenEvent) {
        match event {
            PenEvent::Down { device, .. } => {
                self.device = Some(device);
                self.pours = false;
            }
            PenEvent::Move(samples) => {
                let measures = self.device.is_some_and(Device::is_pen);
                for sample in samples {
                    let sample = sample.sample;
                    let size = self.rect.size();
                    let pen = ScenePen {
                        at: [sample.x_mm as f32 / size.x, sample.y_mm as f32 / size.y],
                        pressure: if measures { sample.pressure as f32 } else { 1.0 },
                    };
                    if std::mem::replace(&mut self.pours, true) {
                        self.ask(VolumeCommand::PenMove(pen));
                    } else {
                        self.ask(VolumeCommand::PenDown(self.tools.grip, pen));
                    }
                }
            }
            PenEvent::Up => {
                if std::mem::take(&mut self.pours) {
                    self.ask(VolumeCommand::PenUp);
                }
            }
            PenEvent::Hover { .. }
            | PenEvent::Leave
            | PenEvent::Tap { .. }
            | PenEvent::Barrel { .. } => {}
        }
    }
}
