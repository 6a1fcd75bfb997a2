//! Entries of the Edit menu.

use eframe::egui::{Key, Modifiers};

use super::row::{CTRL, CTRL_SHIFT, NONE, entry, key};
use crate::app::intent::{Entry, Intent, Menu};

pub(super) const ENTRIES: &[Entry] = &[
    entry(Intent::Undo, Menu::Edit, "Undo", "Undoes the last action", &[key(CTRL, Key::Z)]),
    entry(
        Intent::Redo,
        Menu::Edit,
        "Redo",
        "Redoes the last undone action",
        &[key(CTRL_SHIFT, Key::Z), key(CTRL, Key::Y)],
    ),
    entry(
        Intent::Dry,
        Menu::Edit,
        "Dry",
        "Dries the share of the wet paint that is set in the layer panel",
        &[key(NONE, Key::D)],
    ),
    entry(
        Intent::Wash,
        Menu::Edit,
        "Wash the brush",
        "Removes all paint from the brush",
        &[key(NONE, Key::W)],
    ),
    entry(
        Intent::Wipe,
        Menu::Edit,
        "Wipe the brush",
        "Removes most of the paint from the brush",
        &[key(NONE, Key::X)],
    ),
    entry(
        Intent::ScrapePalette,
        Menu::Edit,
        "Scrape the palette",
        "Removes all paint from the palette",
        &[],
    ),
    entry(
        Intent::Crop,
        Menu::Edit,
        "Crop...",
        "Frames the part of the canvas that stays; Enter cuts off the rest",
        &[],
    ),
    entry(
        Intent::OtherLight,
        Menu::Edit,
        "Other light",
        "Switches between the current and the previous light, at first a tungsten bulb",
        &[key(NONE, Key::L)],
    ),
    entry(
        Intent::Larger,
        Menu::Edit,
        "Larger brush",
        "Makes the selected brush larger",
        &[key(NONE, Key::CloseBracket)],
    ),
    entry(
        Intent::Smaller,
        Menu::Edit,
        "Smaller brush",
        "Makes the selected brush smaller",
        &[key(NONE, Key::OpenBracket)],
    ),
    entry(
        Intent::TwistLeft,
        Menu::Edit,
        "Twist left",
        "Rotates a brush moved by the mouse about its handle to the left",
        &[key(NONE, Key::Comma)],
    ),
    entry(
        Intent::TwistRight,
        Menu::Edit,
        "Twist right",
        "Rotates a brush moved by the mouse about its handle to the right",
        &[key(NONE, Key::Period)],
    ),
    entry(
        Intent::Pen,
        Menu::Edit,
        "Pen...",
        "Pressure curve, stabiliser, and tilt and twist of single brushes, with a field to try them",
        &[key(Modifiers::SHIFT, Key::P)],
    ),
    entry(
        Intent::BrushSets,
        Menu::Edit,
        "Own brushes...",
        "Sets of kept brushes: use, keep, order, export and import them",
        &[key(Modifiers::SHIFT, Key::B)],
    ),
    entry(
        Intent::Preferences,
        Menu::Edit,
        "Preferences...",
        "Autosave, undo memory, backend, sizes, and settings of pens and mice",
        &[key(CTRL, Key::Comma)],
    ),
];
