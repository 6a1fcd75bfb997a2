//! What is where in the window.

use std::time::Instant;

use eframe::egui::{CentralPanel, Frame, Margin, Panel, Ui};

use super::Studio;
use super::{menus, status, toolbar};
use crate::panels::Desk;
use crate::theme;
use crate::view::fill_rect;

impl Studio {
    /// The window from its edges inwards.
    pub(super) fn layout(&mut self, ui: &mut Ui) {
        let context = ui.ctx().clone();
        let bar = Frame::new().inner_margin(Margin::symmetric(6, 2));
        let easel = self.easel.clone();
        let history = easel.as_ref().map_or((false, false), |easel| {
            (easel.history_done > 0, easel.history_done < easel.history.len())
        });
        let mirror = self.canvas.view.mirror;
        let mut asked = None;
        if self.shown.panels {
            let shown = (self.shown.panels, self.shown.palette, self.tools.figures);
            let state = menus::State { open: easel.is_some(), history, shown, mirror };
            let title = self.title.clone();
            Panel::top("menus").frame(bar).show_separator_line(false).show(ui, |ui| {
                fill_rect(ui.painter(), ui.clip_rect(), theme::BAR);
                asked = menus::show(ui, state, &title);
            });
            Panel::bottom("line").frame(bar).exact_size(24.0).show_separator_line(false).show(
                ui,
                |ui| {
                    fill_rect(ui.painter(), ui.clip_rect(), theme::BAR);
                    self.line(ui);
                },
            );
            let column = bar.inner_margin(Margin::symmetric(4, 6));
            Panel::left("tools")
                .frame(column)
                .resizable(false)
                .exact_size(42.0)
                .show_separator_line(false)
                .show(ui, |ui| {
                    fill_rect(ui.painter(), ui.clip_rect(), theme::BAR);
                    let mode = self.keys.mode(self.tools.mode);
                    let state = toolbar::State { mode, mirror, history };
                    asked = asked.or(toolbar::show(ui, state));
                });
            let side = Frame::new().inner_margin(Margin::symmetric(8, 6));
            Panel::right("side")
                .frame(side)
                .resizable(false)
                .exact_size(theme::PANEL_WIDTH)
                .show_separator_line(false)
                .show(ui, |ui| {
                    fill_rect(ui.painter(), ui.clip_rect(), theme::PANEL);
                    let Some(easel) = &easel else { return };
                    let asked = &mut self.asked;
                    let mut desk = Desk { easel, tools: &mut self.tools, asked };
                    self.panels.show(ui, &mut desk, &self.files);
                });
        }
        if let Some(intent) = asked {
            self.act(intent, &context);
        }
        CentralPanel::no_frame().show(ui, |ui| self.surfaces(ui));
    }

    /// The line below.
    fn line(&mut self, ui: &mut Ui) {
        let now = Instant::now();
        let Some(easel) = self.easel.clone() else {
            ui.weak("taking up the canvas");
            return;
        };
        let (width, height) = easel.canvas_cells;
        let mm = |cells: usize| cells as f64 * easel.cell_mm;
        let view = self.canvas.view;
        let turn = (view.snapped_turn().to_degrees().round() as i64).rem_euclid(360);
        let turn = if turn == 0 { String::new() } else { format!(", {turn} degrees") };
        let mirrored = if view.mirror { ", mirrored" } else { "" };
        let second =
            easel.second_lighting.as_ref().map(|second| format!(" | {}", second.illuminant));
        let light = &easel.lighting;
        let state = status::State {
            message: self.message.as_ref().filter(|message| message.stays(now)),
            view: format!("{:.0} %{turn}{mirrored}", view.zoom * 100.0),
            size: format!("{width} x {height}, {:.0} x {:.0} mm", mm(width), mm(height)),
            light: format!("{}{}", light.illuminant, second.unwrap_or_default()),
            backend: &easel.backend,
        };
        if status::show(ui, &state) {
            self.message = None;
        }
    }
}
