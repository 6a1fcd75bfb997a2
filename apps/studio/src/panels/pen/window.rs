//! The window of the pen.

use eframe::egui::{Context, Grid, Ui, vec2};
use session::brushes::{BrushOptions, PressureCurve};

use super::curve_editor::edit_curve;
use super::field::test_field;
use super::rows;
use crate::floating;
use crate::language::{brush_label, tr, tr_format};
use crate::panels::controls::button;
use crate::pen::{Pen, PenSettings, ReportKind, TestField};

/// Width of the window, in points.
const WIDTH: f32 = 452.0;

/// Settings that the window shows and changes.
#[derive(Debug)]
pub struct PenContext<'a> {
    /// The pen with its reports.
    pub pen: &'a Pen,
    /// Settings for all brushes.
    pub settings: &'a mut PenSettings,
    /// Options of the brush in hand.
    pub options: &'a mut BrushOptions,
    /// Label of the brush in hand.
    pub brush: &'a str,
}

/// State of the window of the pen.
#[derive(Debug, Default)]
pub struct PenWindow {
    field: TestField,
    /// Whether the options of the brush in hand are shown, instead of the settings for all.
    only_brush: bool,
    /// Pressure that the pen measures now.
    live: Option<f64>,
    /// Whether the device that pressed last measures pressure.
    measures: Option<bool>,
}

impl PenWindow {
    /// Draws the window while `open` is true; its close button and Escape clear `open`.
    pub fn show(&mut self, context: &Context, open: &mut bool, mut cx: PenContext<'_>) {
        if !*open {
            self.live = None;
            return;
        }
        self.read(cx.pen);
        floating::show(context, tr("Pen"), "pen", open, |ui| {
            ui.set_width(WIDTH);
            ui.horizontal(|ui| {
                let tip = tr("Settings for all brushes that have no own ones");
                ui.selectable_value(&mut self.only_brush, false, tr("All brushes"))
                    .on_hover_text(tip);
                let only = tr_format!("Only {brush}", brush = brush_label(cx.brush));
                let tip = tr("Options of the brush in hand, which come before those for all");
                ui.selectable_value(&mut self.only_brush, true, only).on_hover_text(tip);
            });
            ui.separator();
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 12.0;
                self.curve(ui, &mut cx);
                test_field(ui, &mut self.field, cx.pen);
            });
            self.below_curve(ui, &mut cx);
            ui.separator();
            if self.only_brush {
                brush_rows(ui, cx.options, cx.settings);
            } else {
                general_rows(ui, cx.settings);
            }
        });
    }

    /// Notes the pressure of the device.
    fn read(&mut self, pen: &Pen) {
        for report in pen.reports() {
            match report.kind {
                ReportKind::Pressed(state) | ReportKind::Moved(state) => {
                    self.live = state.pressure;
                    if let ReportKind::Pressed(_) = report.kind {
                        self.measures = Some(state.pressure.is_some());
                    }
                }
                ReportKind::Released | ReportKind::Gone => self.live = None,
                ReportKind::Barrel { .. } => {}
            }
        }
    }

    fn curve(&self, ui: &mut Ui, cx: &mut PenContext<'_>) {
        match (&mut cx.options.curve, self.only_brush) {
            (Some(own), true) => edit_curve(ui, own, self.live, true),
            (None, true) => edit_curve(ui, &mut cx.settings.curve.clone(), self.live, false),
            (_, false) => edit_curve(ui, &mut cx.settings.curve, self.live, true),
        }
    }

    /// Presets of the curve, the present pressure, and the button that clears the field.
    fn below_curve(&mut self, ui: &mut Ui, cx: &mut PenContext<'_>) {
        ui.horizontal(|ui| {
            if self.only_brush {
                own_curve(ui, cx);
            }
            match (&mut cx.options.curve, self.only_brush) {
                (Some(own), true) => rows::curve_presets(ui, own),
                (None, true) => {}
                (_, false) => rows::curve_presets(ui, &mut cx.settings.curve),
            }
            ui.with_layout(
                eframe::egui::Layout::right_to_left(eframe::egui::Align::Center),
                |ui| {
                    let nothing =
                        self.field.strokes().is_empty().then_some(tr("nothing was drawn yet"));
                    if button(ui, tr("Clear"), tr("Clears the field"), nothing) {
                        self.field.clear();
                    }
                    let curve = cx.options.curve.as_ref().unwrap_or(&cx.settings.curve);
                    ui.weak(match (self.live, self.measures) {
                        (Some(live), _) => {
                            let brush = cx.options.in_range(curve.at(live));
                            tr_format!("pen {live:.2}, brush {brush:.2}", live, brush)
                        }
                        (None, Some(false)) => tr("no pressure: by speed").to_owned(),
                        (None, _) => String::new(),
                    });
                },
            );
        });
    }
}

/// Whether the brush has a curve of its own.
fn own_curve(ui: &mut Ui, cx: &mut PenContext<'_>) {
    let mut own = cx.options.curve.is_some();
    let tip = tr("This brush has a pressure curve of its own");
    if ui.checkbox(&mut own, tr("Own curve")).on_hover_text(tip).changed() {
        let general: &PressureCurve = &cx.settings.curve;
        cx.options.curve = own.then(|| general.clone());
    }
}

fn general_rows(ui: &mut Ui, settings: &mut PenSettings) {
    grid(ui, |ui| {
        ui.label(tr("Stabiliser"));
        rows::stabiliser(ui, &mut settings.stabiliser);
        ui.end_row();
        ui.label(tr("Tilt and twist"));
        let tip =
            tr("The brush follows tilt and twist of the pen; otherwise it is held as with a mouse");
        ui.checkbox(&mut settings.pen_tilt, tr("From the pen")).on_hover_text(tip);
        ui.end_row();
        ui.label(tr("Without twist"));
        let tip = tr("The broad side turns across the direction of the stroke");
        ui.checkbox(&mut settings.follow, tr("Turns across the stroke")).on_hover_text(tip);
        ui.end_row();
    });
}

fn brush_rows(ui: &mut Ui, options: &mut BrushOptions, settings: &PenSettings) {
    grid(ui, |ui| {
        ui.label(tr("Pressure"));
        rows::range(ui, options);
        ui.end_row();
        ui.label(tr("Tilt"));
        rows::tilt(ui, &mut options.tilt);
        ui.end_row();
        ui.label(tr("Twist"));
        rows::twist(ui, &mut options.twist);
        ui.end_row();
        let mut own = options.stabiliser.is_some();
        let tip = tr("This brush has a stabiliser of its own");
        if ui.checkbox(&mut own, tr("Own stabiliser")).on_hover_text(tip).changed() {
            options.stabiliser = own.then_some(settings.stabiliser);
        }
        match &mut options.stabiliser {
            Some(own) => rows::stabiliser(ui, own),
            None => {
                ui.weak(tr("as for all brushes"));
            }
        }
        ui.end_row();
    });
}

fn grid(ui: &mut Ui, content: impl FnOnce(&mut Ui)) {
    Grid::new("pen rows")
        .num_columns(2)
        .spacing(vec2(12.0, 6.0))
        .min_row_height(24.0)
        .show(ui, content);
}
