//! One frame of the workspace of scenes.

use eframe::egui::{CentralPanel, Frame, Margin, Panel, Ui};

use super::perform::WindowIntent;
use super::workspace::Volumes;
use super::{menus, toolbar};
use crate::files::Files;
use crate::floating;
use crate::panels::volumes::{
    SceneFileRequest, SceneRequest, TIME_BAR_HEIGHT, show_side, show_time_bar,
};
use crate::pen::Pen;
use crate::theme;
use crate::view::fill_rect;

impl Volumes {
    /// Draws the workspace over the whole window. Returns what is left to the window.
    pub(in crate::app) fn show(
        &mut self,
        ui: &mut Ui,
        panels: bool,
        pen: &mut Pen,
        files: &mut Files,
    ) -> Option<WindowIntent> {
        let context = ui.ctx().clone();
        let mut left = None;
        if !files.has_dialog() {
            for intent in self.read_keys(&context) {
                left = self.perform(intent, &context).or(left);
            }
        }
        let mut intent = None;
        if panels {
            intent = self.show_panels(ui);
        }
        if let Some(intent) = intent {
            left = self.perform(intent, &context).or(left);
        }
        CentralPanel::no_frame().show(ui, |ui| {
            let rect = ui.available_rect_before_wrap();
            floating::set_room(ui.ctx(), rect);
            self.show_canvas(ui, rect, pen);
        });
        self.send_requests(files);
        self.keep_awake(&context);
        left
    }

    /// Draws all parts around the picture. Returns the intent of menu or toolbar.
    fn show_panels(&mut self, ui: &mut Ui) -> Option<super::SceneIntent> {
        let context = ui.ctx().clone();
        let bar = Frame::new().inner_margin(Margin::symmetric(6, 2));
        let state = self.state.clone();
        let state = state.as_deref();
        let mut intent = None;
        let title = self.title();
        Panel::top("scene menus").frame(bar).show_separator_line(false).show(ui, |ui| {
            fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).bar);
            intent = menus::show(ui, state, &title);
        });
        Panel::bottom("scene line").frame(bar).exact_size(24.0).show_separator_line(false).show(
            ui,
            |ui| {
                fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).bar);
                self.status_line(ui);
            },
        );
        let column = bar.inner_margin(Margin::symmetric(4, 6));
        Panel::left("scene tools")
            .frame(column)
            .resizable(false)
            .exact_size(crate::app::toolbar::width(&context))
            .show_separator_line(false)
            .show(ui, |ui| {
                fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).bar);
                intent = intent.or(toolbar::show(ui, self.tools.grip.tool, state));
            });
        let side = Frame::new().inner_margin(Margin::symmetric(8, 6));
        Panel::right("scene side")
            .frame(side)
            .resizable(false)
            .exact_size(theme::panel_width(&context))
            .show_separator_line(false)
            .show(ui, |ui| {
                fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).panel);
                self.with_panels(|cx| show_side(ui, cx));
            });
        Panel::bottom("scene time")
            .frame(bar.inner_margin(Margin::symmetric(8, 0)))
            .exact_size(TIME_BAR_HEIGHT)
            .show_separator_line(false)
            .show(ui, |ui| {
                fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).panel);
                self.with_panels(|cx| show_time_bar(ui, cx));
            });
        intent
    }

    /// Sends the queued requests on in order.
    fn send_requests(&mut self, files: &mut Files) {
        for request in std::mem::take(&mut self.requests) {
            match request {
                SceneRequest::Worker(command) => self.worker.ask(command),
                SceneRequest::File(SceneFileRequest::Open(None)) => files.ask_for_scene(),
                SceneRequest::File(SceneFileRequest::Open(Some(path))) => {
                    self.open(session::volumes::Subject::of_file(&path));
                }
                SceneRequest::File(SceneFileRequest::Library) => files.ask_for_scene_library(),
                SceneRequest::File(SceneFileRequest::Export(export)) => {
                    files.ask_where_to_export_scene(export);
                }
                SceneRequest::File(SceneFileRequest::ExportOfPainting) => {
                    files.ask_what_to_export_of_scene();
                }
            }
        }
    }
}
