//! State of the page for its tests and figures.

use serde_json::json;

use crate::framed::Framed;

pub(crate) fn told(framed: &Framed) -> String {
    let studio = &framed.studio;
    let figures = studio.figures();
    let painting = studio.painting();
    let placement = studio.canvas.placement();
    let (width, height) = studio.canvas.cells();
    let corners = [[0.0, 0.0], [width as f64, height as f64]].map(|cell| {
        let point = placement.point(cell) * framed.zoom();
        [point.x, point.y]
    });
    json!({
        // Corners of the canvas in CSS pixels, and its size in cells.
        "corners": corners,
        "cells": [width, height],
        "cell_mm": painting.map(|state| state.cell_mm),
        "frames": framed.frames,
        "graphics": framed.graphics,
        "revision": painting.map(|state| state.revision),
        // Actions of the history that are done, and all of it.
        "history": painting.map(|state| [state.history_done, state.history.len()]),
        "light": painting.map(|state| &state.lighting.illuminant),
        "pigments": painting.map(|state| &state.library.title),
        "stroke_open": painting.map(|state| state.stroke_open),
        "notices": studio.files.notices().collect::<Vec<_>>(),
        "hints": studio.files.hints().collect::<Vec<_>>(),
        "theme": studio.files.preferences.theme,
        "touch_targets": studio.files.preferences.touch_targets,
        "lost": studio.files.lost(),
        "dialog": studio.files.has_dialog(),
        "title": studio.files.title(),
        "message": studio.message().map(|message| message.text.clone()),
        "substeps_per_second": figures.substeps_per_second,
        "waiting_substeps": figures.waiting_substeps,
        "mean_latency_ms": figures.mean_latency_ms,
        "max_latency_ms": figures.max_latency_ms,
    })
    .to_string()
}
