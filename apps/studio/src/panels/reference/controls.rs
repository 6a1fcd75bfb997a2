//! The buttons above the picture.

use eframe::egui::{Button, DragValue, Ui};

use super::super::context::PanelContext;
use super::mode::ReferenceMode;
use super::picture::Picture;
use super::state::Reference;
use crate::files::FileRequest;
use crate::language::tr;

impl Reference {
    /// Draws the buttons for the picture, its view, and the use of the pointer.
    pub(super) fn controls(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        ui.horizontal_wrapped(|ui| {
            let open = ui.button(tr("Open\u{2026}")).accessible_name(tr("Open picture"));
            if open
                .on_hover_text(tr(
                    "Opens another picture: PNG, JPEG, TIFF, WebP, OpenEXR or a painting",
                ))
                .clicked()
            {
                cx.file(FileRequest::OpenReference(None));
            }
            self.view_controls(ui);
            let close = ui.add_enabled(self.is_open(), Button::new(tr("Close")));
            let close = close.accessible_name(tr("Close picture"));
            if close.on_hover_text(tr("Closes the picture")).clicked() {
                // Otherwise it is closed after a question.
                if self.unsaved_drawings().is_empty() {
                    self.close();
                }
                cx.file(FileRequest::CloseReference);
            }
        });
        ui.horizontal_wrapped(|ui| {
            for mode in ReferenceMode::ALL {
                let chosen = Button::selectable(self.mode == mode, mode.name());
                let button = ui.add_enabled(self.picture.is_some(), chosen);
                if button.on_hover_text(mode.description()).clicked() {
                    self.mode = mode;
                    self.first_place = None;
                    self.line.clear();
                }
            }
            if self.mode == ReferenceMode::Pick {
                let radius = DragValue::new(&mut self.radius)
                    .range(0.0..=100.0)
                    .speed(0.1)
                    .fixed_decimals(0)
                    .prefix(tr("radius "))
                    .suffix(" px");
                let radius = ui.add(radius).accessible_name(tr("Radius of the mean"));
                radius
                    .on_hover_text(tr("A click picks the mean within this radius; 0 is one pixel"));
            }
            self.exposure_control(ui);
        });
        self.over_controls(ui);
    }

    /// The exposure of a picture whose values are those of a scene.
    fn exposure_control(&mut self, ui: &mut Ui) {
        if !self.picture.as_ref().is_some_and(Picture::is_scene_linear) {
            return;
        }
        let drag = DragValue::new(&mut self.exposure).range(-16.0..=16.0).speed(0.05);
        let drag = drag.max_decimals(2).prefix(tr("exposure ")).suffix(" EV");
        let drag = ui.add(drag).accessible_name(tr("Exposure"));
        let tip = tr("Doubles the light of the picture with each step; colours are picked with it");
        if drag.on_hover_text(tip).changed() {
            self.texture = None;
        }
    }

    fn view_controls(&mut self, ui: &mut Ui) {
        let loaded = self.picture.is_some();
        let fit = ui.add_enabled(loaded, Button::new(tr("Fit")));
        if fit.on_hover_text(tr("Fits the whole picture into the panel")).clicked() {
            self.view = None;
        }
        let full = ui.add_enabled(loaded, Button::new("100 %"));
        if full.on_hover_text(tr("Shows one picture pixel as one screen pixel")).clicked()
            && let Some(view) = &mut self.view
        {
            view.zoom = 1.0 / ui.pixels_per_point();
        }
        let grey = ui.add_enabled(loaded, Button::selectable(self.grey, tr("Grey")));
        if grey.on_hover_text(tr("Shows lightness only")).clicked() {
            self.grey ^= true;
            self.texture = None;
        }
        let flip = ui.add_enabled(loaded, Button::selectable(self.flipped, tr("Flip")));
        if flip.on_hover_text(tr("Mirrors the picture")).clicked() {
            self.flipped ^= true;
        }
    }
}
