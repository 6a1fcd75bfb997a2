//! Connections of the window to the system: title, dropped files, performance log and
//! closing.

use std::path::{Path, PathBuf};
use web_time::{Duration, Instant};

use eframe::egui::{Align2, Context, FontId, Id, LayerId, Order, Rect, ViewportCommand};
use graphics::picture_formats::has_picture_ending;

use super::side::Tab;
use super::studio::Studio;
use super::volumes::Volumes;
use crate::files::FrameFigures;
use crate::language::tr;
use crate::panels::eyedropper::Eyedropper;
use crate::panels::{FileRequest, Request};
use crate::theme;
use session::Command;
use session::volumes::{Subject, VolumeCommand};

impl Studio {
    /// Prepares to close: stores the tool settings in the preferences, waits for files
    /// being written and stops the worker.
    pub fn finish(&mut self) {
        self.keep_tools();
        self.files.finish();
        self.worker.ask(Command::Quit);
    }

    /// Stores the tool settings in the preferences.
    pub fn keep_tools(&mut self) {
        let saved = &mut self.files.preferences.tools;
        saved.brush.clone_from(&self.tools.brush);
        saved.vehicle = self.tools.vehicle;
        saved.load_mm = self.tools.load_mm;
        saved.squeeze_mm3 = self.tools.squeeze_mm3;
        saved.dry_share = self.tools.dry_share;
    }

    /// Opens a file according to its kind, where it belongs: colours in the panel of colours, scenes in
    /// their workspace, paintings, recordings and pictures at the easel.
    pub fn open_path(&mut self, context: &Context, path: PathBuf) {
        if Eyedropper::takes(&path) {
            self.panels.eyedropper.open_swatches(&path);
            self.panels.select(Tab::Color);
            return;
        }
        let is_library = path.extension().is_some_and(|ending| ending == "json");
        if let Some(volumes) = self.volumes.as_mut().filter(|_| self.shows_volumes && is_library) {
            volumes.ask(VolumeCommand::Library(path));
            return;
        }
        if let Some(subject) = self.scene_subject(&path) {
            self.open_scene(context, subject);
            return;
        }
        self.requests.push(Request::File(FileRequest::Open(Some(path))));
    }

    /// Opens files dropped on the window, and shows a hint while files hover over it.
    pub(super) fn open_dropped(&mut self, context: &Context) {
        let (dropped, hovering) = context.input(|input| {
            let paths = input.raw.dropped_files.iter().map(|file| file.path().to_owned());
            (paths.collect::<Vec<_>>(), !input.raw.hovered_files.is_empty())
        });
        for path in dropped {
            self.open_path(context, path);
        }
        if hovering {
            let layer = LayerId::new(Order::Foreground, Id::unique("dropping"));
            let painter = context.layer_painter(layer);
            let whole = context.content_rect();
            painter.rect_filled(whole, 0.0, theme::BOARD);
            let font = FontId::proportional(18.0);
            let text = tr("Drop to open");
            painter.text(whole.center(), Align2::CENTER_CENTER, text, font, theme::BOARD_TEXT);
        }
    }

    /// The scene that a dropped file is opened as, if it is: while a scene is shown, a picture is
    /// one too.
    fn scene_subject(&self, path: &Path) -> Option<Subject> {
        let subject = Subject::from_text(path.to_str()?);
        let picture = || self.shows_volumes && has_picture_ending(path);
        subject.or_else(|| picture().then(|| Subject::of_file(path)))
    }

    pub(super) fn update_title(&mut self, context: &Context) {
        let mark = if self.files.has_unsaved_changes() { "*" } else { "" };
        let title = match self.volumes.as_ref().filter(|_| self.shows_volumes) {
            Some(volumes) => volumes.title(),
            None => format!("{}{mark}", self.files.title()),
        };
        if self.title != title {
            context.send_viewport_cmd(ViewportCommand::Title(format!("{title} - impasto")));
            self.title = title;
        }
    }

    /// Appends the performance figures to the log, if there is one.
    pub(super) fn log_figures(&mut self, context: &Context, now: Instant) {
        let Some(log) = &mut self.log else { return };
        let rate = self.frames.rate();
        let (width, height) = self.canvas.cells();
        let placement = self.canvas.placement();
        let corners = [[0, 0], [width, 0], [0, height], [width, height]];
        let sheet = corners.map(|corner| placement.point(corner.map(|cells| cells as f64)));
        let scene = self.volumes.as_ref().filter(|_| self.shows_volumes);
        let sheet = scene.map_or_else(|| Rect::from_points(&sheet), Volumes::rect);
        let sheet = sheet * context.pixels_per_point();
        let frames = FrameFigures {
            frames_a_second: rate.frames_a_second,
            latency_ms: rate.latency_ms,
            worst_latency_ms: rate.worst_ms,
            canvas_px: [sheet.left(), sheet.top(), sheet.right(), sheet.bottom()],
        };
        log.append_when_due(now, &frames, &self.figures);
        context.request_repaint_after(Duration::from_secs(1));
    }
}
