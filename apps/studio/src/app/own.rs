//! The windows of the pen and of own brushes.

use eframe::egui::Context;
use session::brushes::BrushSet;

use super::studio::Studio;
use crate::panels::own_brushes::OwnBrushRequest;
use crate::panels::pen::PenContext;
use crate::panels::{FileRequest, Request};

impl Studio {
    /// Draws the windows of the pen and of own brushes, if they are open.
    pub(super) fn draw_pen_windows(&mut self, context: &Context) {
        let brush = self.tools.brush.clone();
        let label = self.panels.brushes.label(&brush).to_owned();
        let preferences = &mut self.files.preferences;
        let mut options = preferences.options_of(&brush);
        let settings = &mut preferences.pen;
        let options_before = options.clone();
        let cx = PenContext { pen: &self.pen, settings, options: &mut options, brush: &label };
        self.pen_window.show(context, &mut self.visible.pen, cx);
        if options != options_before {
            preferences.set_options(&brush, options);
        }
        if self.visible.brush_sets {
            let open = &mut self.visible.brush_sets;
            let sets = &mut self.files.brush_sets;
            if let Some(request) = self.own_brushes.show(context, open, sets) {
                self.use_own_brushes(request);
            }
        }
    }

    fn use_own_brushes(&mut self, request: OwnBrushRequest) {
        match request {
            OwnBrushRequest::Use(preset) => {
                let mut name = None;
                self.with_panels(|panels, cx| name = Some(panels.brushes.take(&preset, cx)));
                if let Some(name) = name {
                    self.files.preferences.set_options(&name, preset.options);
                }
            }
            OwnBrushRequest::Keep { with_paint } => {
                let options = self.files.preferences.options_of(&self.tools.brush);
                let mut kept = None;
                self.with_panels(|panels, cx| {
                    kept = panels.brushes.kept(options, with_paint, cx);
                });
                if let Some(preset) = kept {
                    self.files.brush_set().put(preset);
                }
            }
            OwnBrushRequest::AddSet(name) => self.files.add_brush_set(BrushSet::new(&name)),
            OwnBrushRequest::Import => {
                self.requests.push(Request::File(FileRequest::ImportBrushes));
            }
            OwnBrushRequest::Export => {
                self.requests.push(Request::File(FileRequest::ExportBrushes));
            }
        }
    }
}
