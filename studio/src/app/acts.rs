//! What is asked for is done.

use eframe::egui::{Context, ViewportCommand};
use render::paint::strokes::{Action, BrushSpec, Surface};

use super::Studio;
use super::intent::Intent;
use crate::panels::{FileRequest, Mode, Request};
use crate::worker::Command;

/// Degrees of one turn of view or brush by a key.
const TURN_DEG: f64 = 15.0;

/// One step of a brush's size by a key.
const STEP: f64 = 1.15;

/// What wiping leaves on the brush.
const WIPED: f64 = 0.3;

/// One step of the zoom by a key.
const ZOOM: f64 = std::f64::consts::SQRT_2;

impl Studio {
    /// Does what was asked for.
    pub(super) fn act(&mut self, intent: Intent, context: &Context) {
        let room = self.canvas.room();
        let density = context.pixels_per_point();
        let zoom = |studio: &mut Self, factor: f64| {
            studio.canvas.view.zoom_by(factor, room.center(), room, density);
        };
        match intent {
            Intent::New => self.file(FileRequest::New),
            Intent::Open => self.file(FileRequest::Open(None)),
            Intent::Save => self.file(FileRequest::Save),
            Intent::SaveAs => self.file(FileRequest::SaveAs),
            Intent::KeepRevision => self.file(FileRequest::KeepRevision),
            Intent::Export => self.file(FileRequest::Export),
            Intent::SaveRecording => self.file(FileRequest::SaveRecording),
            Intent::OpenReference => self.file(FileRequest::OpenReference(None)),
            Intent::OpenLamp => self.file(FileRequest::OpenLamp),
            Intent::Quit => context.send_viewport_cmd(ViewportCommand::Close),
            Intent::Undo => self.action(Action::Undo {}),
            Intent::Redo => self.action(Action::Redo {}),
            Intent::Dry => self.action(Action::Dry { fraction: self.tools.dry_share }),
            Intent::Wash => {
                let brush = self.tools.brush.clone();
                self.action(Action::Wash { brush });
            }
            Intent::Wipe => {
                let brush = self.tools.brush.clone();
                self.action(Action::Wipe { brush, keep: WIPED });
            }
            Intent::ScrapePalette => self.action(Action::Scrape { on: Surface::Palette }),
            Intent::Larger => self.resize(STEP),
            Intent::Smaller => self.resize(1.0 / STEP),
            Intent::TwistLeft => self.pen.settings.grip.turn(-TURN_DEG),
            Intent::TwistRight => self.pen.settings.grip.turn(TURN_DEG),
            Intent::Brush(number) => {
                let brush = self
                    .easel
                    .as_ref()
                    .and_then(|easel| easel.brushes.get(usize::from(number) - 1));
                if let Some(brush) = brush {
                    self.tools.brush = brush.name.clone();
                    self.tools.mode = Mode::Paint;
                }
            }
            Intent::Tool(mode) => self.tools.mode = mode,
            Intent::ZoomIn => zoom(self, ZOOM),
            Intent::ZoomOut => zoom(self, 1.0 / ZOOM),
            Intent::Fit => self.canvas.fit(),
            Intent::ActualSize => self.canvas.view.actual_size(),
            Intent::Upright => {
                self.canvas.view.turn = 0.0;
                self.canvas.view.mirror = false;
                self.canvas.fit();
            }
            Intent::TurnLeft => self.canvas.view.rotate(-TURN_DEG.to_radians()),
            Intent::TurnRight => self.canvas.view.rotate(TURN_DEG.to_radians()),
            Intent::Mirror => self.canvas.view.mirror ^= true,
            Intent::Panels => self.shown.panels ^= true,
            Intent::Palette => self.shown.palette ^= true,
            Intent::Figures => self.tools.figures ^= true,
            Intent::FullScreen => {
                let full = context.input(|input| input.viewport().fullscreen.unwrap_or(false));
                context.send_viewport_cmd(ViewportCommand::Fullscreen(!full));
            }
            Intent::Keys => self.shown.keys ^= true,
        }
    }

    /// Exchanges the brush in hand for one `factor` times as large.
    fn resize(&mut self, factor: f64) {
        let Some(easel) = &self.easel else { return };
        let Some(brush) = easel.brushes.iter().find(|brush| brush.name == self.tools.brush) else {
            return;
        };
        let size_mm = (brush.spec.size_mm * factor).clamp(0.2, 100.0);
        let spec = BrushSpec { size_mm, ..brush.spec.clone() };
        let command = Command::TakeBrush { name: brush.name.clone(), spec };
        self.asked.push(Request::Worker(command));
    }

    fn action(&mut self, action: Action) {
        self.asked.push(Request::Worker(Command::Act(action)));
    }

    fn file(&mut self, request: FileRequest) {
        self.asked.push(Request::File(request));
    }
}
