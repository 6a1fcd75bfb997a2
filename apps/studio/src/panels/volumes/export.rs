//! Files that a scene makes.

use eframe::egui::{Button, Ui, vec2};

use super::context::{SceneContext, SceneFileRequest};
use crate::files::SceneExport;
use crate::language::{english, tr};
use crate::panels::controls::row_height;

/// A button, its tip, and the request that it makes.
type Line = (&'static str, &'static str, SceneFileRequest);

const LINES: [Line; 5] = [
    (
        english("Picture..."),
        english("The picture as it is seen now: PNG, or linear OpenEXR"),
        file(SceneExport::Picture),
    ),
    (
        english("Painting..."),
        english(
            "An OpenEXR file with the pigments of every cell: relight it, exchange its pigments, go \
         on painting it",
        ),
        file(SceneExport::Painting),
    ),
    (
        english("Layers, spectra, maps..."),
        english(
            "The painting in layers for other programs, its spectra, maps of its pigments, or its picture",
        ),
        SceneFileRequest::ExportOfPainting,
    ),
    (
        english("Script..."),
        english(
            "All that was done, as a text file that this program and `impasto stencil` play again",
        ),
        file(SceneExport::Script),
    ),
    (
        english("Animation..."),
        english("All pictures from the start to the end: GIF or APNG"),
        file(SceneExport::Animation),
    ),
];

const fn file(export: SceneExport) -> SceneFileRequest {
    SceneFileRequest::Export(export)
}

/// Draws the buttons.
pub(super) fn show(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    for (name, tip, request) in LINES {
        let paints =
            request == file(SceneExport::Painting) || request == SceneFileRequest::ExportOfPainting;
        let films = request == file(SceneExport::Animation);
        let reason = match cx.state.time.end {
            _ if paints && cx.state.tubes.is_empty() => Some(tr("the scene has no pigments")),
            0 if films => Some(tr("no time has passed yet")),
            _ => None,
        };
        let size = vec2(ui.available_width(), row_height(ui, 26.0));
        let button =
            ui.add_enabled_ui(reason.is_none(), |ui| ui.add_sized(size, Button::new(tr(name))));
        let button = button.inner.on_hover_text(tr(tip));
        if button.on_disabled_hover_text(reason.unwrap_or_default()).clicked() {
            cx.file(request);
        }
    }
}
