//! Entries of the View menu.

use eframe::egui::Key;

use super::row::{CTRL, NONE, entry, key};
use crate::app::intent::{Entry, Intent, Menu};
use crate::theme::ThemeChoice;

pub(super) const ENTRIES: &[Entry] = &[
    entry(
        Intent::ZoomIn,
        Menu::View,
        "Zoom in",
        "Enlarges the view",
        &[key(CTRL, Key::Plus), key(CTRL, Key::Equals), key(NONE, Key::Plus)],
    ),
    entry(
        Intent::ZoomOut,
        Menu::View,
        "Zoom out",
        "Reduces the view",
        &[key(CTRL, Key::Minus), key(NONE, Key::Minus)],
    ),
    entry(
        Intent::Fit,
        Menu::View,
        "Whole canvas",
        "Fits the whole canvas and the palette into their views, keeping the rotation",
        &[key(CTRL, Key::Num0), key(NONE, Key::Num0)],
    ),
    entry(
        Intent::ActualSize,
        Menu::View,
        "Actual cells",
        "Shows one canvas cell as one screen pixel",
        &[key(CTRL, Key::Num1)],
    ),
    entry(
        Intent::Upright,
        Menu::View,
        "Upright",
        "Fits the whole canvas into the view, upright and not mirrored",
        &[key(NONE, Key::Home)],
    ),
    entry(
        Intent::TurnLeft,
        Menu::View,
        "Turn left",
        "Turns the view by 15 degrees to the left",
        &[key(CTRL, Key::OpenBracket)],
    ),
    entry(
        Intent::TurnRight,
        Menu::View,
        "Turn right",
        "Turns the view by 15 degrees to the right",
        &[key(CTRL, Key::CloseBracket)],
    ),
    entry(
        Intent::Mirror,
        Menu::View,
        "Mirror",
        "Mirrors the view; the painting does not change",
        &[key(NONE, Key::M)],
    ),
    entry(
        Intent::Panels,
        Menu::View,
        "Panels",
        "Shows or hides all panels",
        &[key(NONE, Key::Tab)],
    ),
    entry(
        Intent::Palette,
        Menu::View,
        "Palette",
        "Shows or hides palette and tubes",
        &[key(NONE, Key::P)],
    ),
    entry(
        Intent::ReferenceOver,
        Menu::View,
        "Reference over the canvas",
        "Lays the pinned picture over the canvas, to draw after; it is never painted",
        &[key(NONE, Key::O)],
    ),
    entry(
        Intent::Figures,
        Menu::View,
        "Figures",
        "Shows frame rate, latency and speed of the paint engine",
        &[key(NONE, Key::F12), key(NONE, Key::F3)],
    ),
    entry(
        Intent::FullScreen,
        Menu::View,
        "Full screen",
        "Toggles full screen",
        &[key(NONE, Key::F11)],
    ),
    entry(
        Intent::StandardLayout,
        Menu::View,
        "Standard layout",
        "Puts all panels back to their usual places and sizes",
        &[],
    ),
    entry(
        Intent::Theme(ThemeChoice::Dark),
        Menu::View,
        "Dark theme",
        "Light text on dark panels",
        &[],
    ),
    entry(
        Intent::Theme(ThemeChoice::Light),
        Menu::View,
        "Light theme",
        "Dark text on light panels",
        &[],
    ),
    entry(
        Intent::Theme(ThemeChoice::System),
        Menu::View,
        "Theme of the system",
        "Dark or light, as the system prefers",
        &[],
    ),
    entry(
        Intent::TouchTargets,
        Menu::View,
        "Large targets for touch",
        "Makes all buttons, rows and handles at least 44 points high and wide",
        &[],
    ),
    entry(
        Intent::LargerInterface,
        Menu::View,
        "Larger interface",
        "Enlarges text and controls, as far as they fit into the window",
        &[],
    ),
    entry(
        Intent::SmallerInterface,
        Menu::View,
        "Smaller interface",
        "Reduces text and controls",
        &[],
    ),
];
