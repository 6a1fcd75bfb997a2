//! Entries of the Tools menu.

use eframe::egui::Key;

use super::row::{NONE, SHIFT, entry, key};
use crate::app::intent::{Entry, Intent, Menu};
use crate::panels::Mode;

pub(super) const ENTRIES: &[Entry] = &[
    entry(
        Intent::Tool(Mode::Paint),
        Menu::Tools,
        "Paint",
        "The pen paints with the brush",
        &[key(NONE, Key::B)],
    ),
    entry(
        Intent::Tool(Mode::Blend),
        Menu::Tools,
        "Blend",
        "The pen softens and mixes wet paint with the clean head of the brush",
        &[key(NONE, Key::N)],
    ),
    entry(
        Intent::Tool(Mode::Scrape),
        Menu::Tools,
        "Scrape",
        "The pen scrapes wet paint off, down to a height; a knife scrapes with a straight edge",
        &[key(NONE, Key::S)],
    ),
    entry(
        Intent::Tool(Mode::Erase),
        Menu::Tools,
        "Erase",
        "The pen rubs wet paint off, as with a rag",
        &[key(NONE, Key::E)],
    ),
    entry(
        Intent::Tool(Mode::Mask),
        Menu::Tools,
        "Mask",
        "The pen draws what a mask leaves open; with shift a rectangle",
        &[key(NONE, Key::K)],
    ),
    entry(
        Intent::Tool(Mode::Squeeze),
        Menu::Tools,
        "Squeeze",
        "The pen squeezes paint from the selected tube",
        &[key(NONE, Key::Q)],
    ),
    entry(
        Intent::Tool(Mode::Pick),
        Menu::Tools,
        "Eyedropper",
        "The pen picks colour and paint; also while Alt is held",
        &[key(NONE, Key::I)],
    ),
    entry(
        Intent::Tool(Mode::Pan),
        Menu::Tools,
        "Hand",
        "The pen moves the view; also while the space bar is held, or with the middle button",
        &[key(NONE, Key::H)],
    ),
    entry(
        Intent::Tool(Mode::Rotate),
        Menu::Tools,
        "Turn",
        "The pen turns the view; also while shift and the space bar are held",
        &[key(NONE, Key::R)],
    ),
    entry(
        Intent::Tool(Mode::Zoom),
        Menu::Tools,
        "Zoom",
        "The pen zooms, upwards in; so does the wheel",
        &[key(NONE, Key::Z)],
    ),
    entry(
        Intent::QuickPalette,
        Menu::Tools,
        "Quick palette",
        "Opens tubes, mixtures and brush sizes at the pointer; so does the right button on the canvas",
        &[key(NONE, Key::C)],
    ),
    entry(
        Intent::DrawingAids,
        Menu::Tools,
        "Drawing aids...",
        "Ruler, perspective and symmetry with their handles and settings",
        &[key(SHIFT, Key::G)],
    ),
    entry(
        Intent::Ruler,
        Menu::Tools,
        "Ruler",
        "Shows a line or an ellipse that strokes keep to",
        &[key(NONE, Key::U)],
    ),
    entry(
        Intent::Perspective,
        Menu::Tools,
        "Perspective",
        "Shows vanishing points that strokes run to",
        &[key(NONE, Key::V)],
    ),
    entry(
        Intent::Snapping,
        Menu::Tools,
        "Strokes follow the guide",
        "Leads strokes along ruler or perspective; otherwise they are only shown",
        &[key(NONE, Key::G)],
    ),
    entry(
        Intent::Symmetry,
        Menu::Tools,
        "Symmetry",
        "Paints each stroke again when it ends, mirrored or turned",
        &[key(NONE, Key::Y)],
    ),
];
