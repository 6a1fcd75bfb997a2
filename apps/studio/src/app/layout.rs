//! Lays out the window: menu bar, status line, toolbar, side panel and surfaces.

use web_time::Instant;

use eframe::egui::{CentralPanel, Frame, Margin, Panel, Ui};

use super::side::Drawn;
use super::studio::Studio;
use super::{menus, status, toolbar};
use crate::arrangement::Side;
use crate::language::{tr, tr_format};
use crate::panels::PanelContext;
use crate::theme;
use crate::view::fill_rect;

impl Studio {
    /// Draws all parts of the window, from its edges inwards.
    pub(super) fn draw(&mut self, ui: &mut Ui) {
        let context = ui.ctx().clone();
        let bar = Frame::new().inner_margin(Margin::symmetric(6, 2));
        let painting = self.painting.clone();
        let history = painting.as_ref().map_or((false, false), |painting| {
            (painting.history_done > 0, painting.history_done < painting.history.len())
        });
        let mirror = self.canvas.view.mirror;
        let mut intent = None;
        if self.visible.panels {
            let panels = self.shows_panels(&context);
            let shown = (panels, self.visible.palette, self.tools.figures);
            let scene = self.volumes.is_some();
            let open = painting.is_some();
            let look = self.files.preferences.look();
            let aids = self.aids;
            let state = menus::State { open, scene, history, shown, mirror, aids, look };
            let title = self.title.clone();
            Panel::top("menus").frame(bar).show_separator_line(false).show(ui, |ui| {
                fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).bar);
                intent = menus::show(ui, state, &title);
            });
            let line = status::height(&context, self.message.as_ref());
            Panel::bottom("line").frame(bar).exact_size(line).show_separator_line(false).show(
                ui,
                |ui| {
                    fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).bar);
                    self.status_line(ui);
                },
            );
            let column = bar.inner_margin(Margin::symmetric(4, 6));
            Panel::left("tools")
                .frame(column)
                .resizable(false)
                .exact_size(toolbar::width(&context))
                .show_separator_line(false)
                .show(ui, |ui| {
                    fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).bar);
                    let mode = self.keys.mode(self.tools.mode);
                    let state = toolbar::State { mode, mirror, history };
                    intent = intent.or(toolbar::show(ui, state));
                });
            if !theme::is_narrow(&context) {
                self.draw_columns(ui);
            }
        }
        if let Some(intent) = intent {
            self.perform(intent, &context);
        }
        let covered = self.shows_sheet(&context);
        CentralPanel::no_frame()
            .show(ui, |ui| if covered { self.draw_sheet(ui) } else { self.draw_surfaces(ui) });
        if covered {
            let events = context.input(|input| input.events.clone());
            self.update_pen(&context, &events, self.keys.mode(self.tools.mode));
        }
    }

    /// Draws the columns of panels at both sides.
    fn draw_columns(&mut self, ui: &mut Ui) {
        let Some(painting) = self.painting.clone() else { return };
        let context = ui.ctx().clone();
        let mut drawn = Drawn::default();
        for side in Side::ALL {
            let width = self.panels.column_width(&context, side);
            if width == 0.0 {
                continue;
            }
            let column = match side {
                Side::Left => Panel::left("left panels"),
                Side::Right => Panel::right("right panels"),
            };
            let column = column.frame(Frame::NONE).resizable(false).exact_size(width);
            column.show_separator_line(false).show(ui, |ui| {
                let requests = &mut self.requests;
                let mut cx = PanelContext { painting: &painting, tools: &mut self.tools, requests };
                self.panels.show(ui, side, (&mut cx, &self.files), &mut drawn);
            });
        }
        self.panels.drop_dragged(&context, drawn, ui.available_rect_before_wrap());
    }

    /// Draws the status line.
    fn status_line(&mut self, ui: &mut Ui) {
        let now = Instant::now();
        let Some(painting) = self.painting.clone() else {
            ui.weak(tr("preparing the canvas"));
            return;
        };
        let (width, height) = painting.canvas_cells;
        let mm = |cells: usize| cells as f64 * painting.cell_mm;
        let view = self.canvas.view;
        let turn = (view.snapped_turn().to_degrees().round() as i64).rem_euclid(360);
        let turn = if turn == 0 { String::new() } else { tr_format!(", {turn} degrees", turn) };
        let mirrored = if view.mirror { tr(", mirrored") } else { "" };
        let second =
            painting.second_lighting.as_ref().map(|second| format!(" | {}", second.illuminant));
        let light = &painting.lighting;
        let state = status::State {
            message: self.message.as_ref().filter(|message| message.is_displayed(now)),
            view: format!("{:.0} %{turn}{mirrored}", view.zoom * 100.0),
            size: format!("{width} x {height}, {:.0} x {:.0} mm", mm(width), mm(height)),
            light: format!("{}{}", light.illuminant, second.unwrap_or_default()),
            backend: &painting.backend,
        };
        if status::show(ui, &state) {
            self.message = None;
        }
    }
}
