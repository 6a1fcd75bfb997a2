//! Files that a scene makes.

use eframe::egui::{Button, Ui, vec2};

use super::context::{SceneContext, SceneFileRequest};
use crate::files::SceneExport;
use crate::panels::controls::row_height;

/// A button, its tip, and the request that it makes.
type Line = (&'static str, &'static str, SceneFileRequest);

const LINES: [Line; 5] = [
    (
        "Picture...",
        "The picture as it is seen now: PNG, or linear OpenEXR",
        file(SceneExport::Picture),
    ),
    (
        "Painting...",
        "An OpenEXR file with the pigments of every cell: relight it, exchange its pigments, go \
         on painting it",
        file(SceneExport::Painting),
    ),
    (
        "Layers, spectra, maps...",
        "The painting in layers for other programs, its spectra, maps of its pigments, or its picture",
        SceneFileRequest::ExportOfPainting,
    ),
    (
        "Script...",
        "All that was done, as a text file that this program and `impasto stencil` play again",
        file(SceneExport::Script),
    ),
    (
        "Animation...",
        "All pictures from the start to the end: GIF or APNG",
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
            _ if paints && cx.state.tubes.is_empty() => Some("the scene has no pigments"),
            0 if films => Some("no time has passed yet"),
            _ => None,
        };
        let size = vec2(ui.available_width(), row_height(ui, 26.0));
        let button =
            ui.add_enabled_ui(reason.is_none(), |ui| ui.add_sized(size, Button::new(name)));
        let button = button.inner.on_hover_text(tip);
        if button.on_disabled_hover_text(reason.unwrap_or_default()).clicked() {
            cx.file(request);
        }
    }
}
