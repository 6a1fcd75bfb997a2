//! What is asked for is done.

use eframe::egui::{Context, ViewportCommand};
use render::paint::strokes::{Action, SurfaceId};

use super::Studio;
use super::intent::Intent;
use super::side::Panels;
use crate::panels::brushes::{wash, wipe};
use crate::panels::layers::dry;
use crate::panels::{Desk, FileRequest, Mode, Request};
use session::Command;

/// Degrees of one turn of view or brush by a key.
const TURN_DEG: f64 = 15.0;

/// One step of a brush's size by a key.
const STEP: f64 = 1.15;

/// One step of the zoom by a key.
const ZOOM: f64 = std::f64::consts::SQRT_2;

impl Studio {
    /// Does what was asked for.
    pub(super) fn act(&mut self, intent: Intent, context: &Context) {
        let room = self.canvas.rect();
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
            Intent::Preferences => self.file(FileRequest::Preferences),
            Intent::Quit => context.send_viewport_cmd(ViewportCommand::Close),
            Intent::Undo => self.action(Action::Undo {}),
            Intent::Redo => self.action(Action::Redo {}),
            Intent::Dry => self.with_desk(|_, desk| dry(desk)),
            Intent::Wash => self.with_desk(|_, desk| wash(desk)),
            Intent::Wipe => self.with_desk(|_, desk| wipe(desk)),
            Intent::ScrapePalette => self.action(Action::Scrape { on: SurfaceId::Palette }),
            Intent::OtherLight => self.with_desk(|panels, desk| panels.light.exchange(desk)),
            Intent::Larger => self.with_desk(|panels, desk| panels.brushes.resize(STEP, desk)),
            Intent::Smaller => {
                self.with_desk(|panels, desk| panels.brushes.resize(1.0 / STEP, desk));
            }
            Intent::TwistLeft => self.files.preferences.pen.grip.turn(-TURN_DEG),
            Intent::TwistRight => self.files.preferences.pen.grip.turn(TURN_DEG),
            Intent::Brush(number) => self.with_desk(|panels, desk| {
                if panels.brushes.choose(usize::from(number), desk) {
                    desk.tools.mode = Mode::Paint;
                }
            }),
            Intent::Tool(mode) => self.tools.mode = mode,
            Intent::ZoomIn => zoom(self, ZOOM),
            Intent::ZoomOut => zoom(self, 1.0 / ZOOM),
            Intent::Fit => self.canvas.fit(),
            Intent::ActualSize => self.canvas.view.actual_size(),
            Intent::Upright => {
                self.canvas.view.rotation = 0.0;
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

    /// Lets panels ask for something, if there is a painting.
    pub(super) fn with_desk(&mut self, ask: impl FnOnce(&mut Panels, &mut Desk<'_>)) {
        let Some(easel) = self.easel.clone() else { return };
        let asked = &mut self.asked;
        ask(&mut self.panels, &mut Desk { easel: &easel, tools: &mut self.tools, asked });
    }

    fn action(&mut self, action: Action) {
        self.asked.push(Request::Worker(Command::Apply(action)));
    }

    fn file(&mut self, request: FileRequest) {
        self.asked.push(Request::File(request));
    }
}
