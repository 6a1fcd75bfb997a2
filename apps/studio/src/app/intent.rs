//! Intents: everything that you can request by keys, menus and toolbar. This also notes the
//! rectangles of the window's parts, so that the tour can point at them.

use eframe::egui::{Context, Id, Rect};
use serde::Serialize;

use crate::keymap::{Shortcut, name_of};
use crate::panels::Mode;
use crate::theme::ThemeChoice;

/// One user action. Preferences name it as this enum does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Intent {
    /// Starts a new painting.
    New,
    /// Opens a file.
    Open,
    /// Saves the painting.
    Save,
    /// Saves the painting under another name.
    SaveAs,
    /// Keeps a numbered revision.
    KeepRevision,
    /// Exports a picture.
    Export,
    /// Saves the recording of all strokes.
    SaveRecording,
    /// Exports a timelapse of the recording.
    ExportTimelapse,
    /// Opens a reference picture beside the canvas.
    OpenReference,
    /// Lays the reference picture over the canvas, or removes it.
    ReferenceOver,
    /// Lights the painting with a measured lamp.
    OpenLamp,
    /// Shows or hides the window of the pen.
    Pen,
    /// Shows or hides the window of own brushes.
    BrushSets,
    /// Shows the preferences.
    Preferences,
    /// Begins a scene of paint volumes.
    NewScene,
    /// Opens a scene of paint volumes.
    OpenScene,
    /// Shows the scene that is open.
    ShowScene,
    /// Opens the sample painting.
    Sample,
    /// Closes the program.
    Quit,
    /// Undoes the last action.
    Undo,
    /// Redoes the last undone action.
    Redo,
    /// Dries a share of the wet paint.
    Dry,
    /// Removes all paint from the brush.
    Wash,
    /// Removes most of the paint from the brush.
    Wipe,
    /// Removes all paint from the palette.
    ScrapePalette,
    /// Lets you choose the part of the canvas that stays.
    Crop,
    /// Switches to the previous light.
    OtherLight,
    /// Increases the brush size by one step.
    Larger,
    /// Decreases the brush size by one step.
    Smaller,
    /// Rotates the brush about its handle to the left, for devices without twist.
    TwistLeft,
    /// Rotates the brush about its handle to the right, for devices without twist.
    TwistRight,
    /// Selects a brush of the list by its number, from 1.
    Brush(u8),
    /// Selects a tool.
    Tool(Mode),
    /// Opens or closes the round menu of tubes, mixtures and sizes at the pointer.
    QuickPalette,
    /// Shows or hides the window of the drawing aids.
    DrawingAids,
    /// Shows the ruler, or takes it away.
    Ruler,
    /// Shows the perspective guide, or takes it away.
    Perspective,
    /// Switches whether strokes follow the guide.
    Snapping,
    /// Turns symmetry on or off.
    Symmetry,
    /// Enlarges the view by one step.
    ZoomIn,
    /// Reduces the view by one step.
    ZoomOut,
    /// Fits the whole canvas and the palette into their views, keeping the rotation.
    Fit,
    /// Shows one canvas cell as one screen pixel.
    ActualSize,
    /// Fits the whole canvas into the view, upright and not mirrored.
    Upright,
    /// Rotates the view to the left by one step.
    TurnLeft,
    /// Rotates the view to the right by one step.
    TurnRight,
    /// Mirrors the view horizontally.
    Mirror,
    /// Shows or hides all panels.
    Panels,
    /// Shows or hides the palette.
    Palette,
    /// Shows or hides the performance figures.
    Figures,
    /// Toggles full screen.
    FullScreen,
    /// Selects the dark or the light theme, or the theme of the system.
    Theme(ThemeChoice),
    /// Switches touch mode, which makes everything large enough for a finger.
    TouchTargets,
    /// Enlarges text and controls by one step.
    LargerInterface,
    /// Reduces text and controls by one step.
    SmallerInterface,
    /// Moves all panels back to their usual places.
    StandardLayout,
    /// Shows or hides the table of keys.
    Keys,
    /// Shows or hides the first steps over the painting.
    FirstSteps,
    /// Starts or continues the guided tour.
    Tour,
}

/// Menu of the menu bar that holds an entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Menu {
    /// Opening, saving and exporting.
    File,
    /// Changes to painting, brush and light.
    Edit,
    /// Zoom, rotation and visible parts.
    View,
    /// Tools, which also stand in the toolbar at the left.
    Tools,
    /// The table of keys.
    Help,
}

impl Menu {
    /// Name in the menu bar.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::File => "File",
            Self::Edit => "Edit",
            Self::View => "View",
            Self::Tools => "Tools",
            Self::Help => "Help",
        }
    }
}

/// Menu entry of an intent.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// Intent that the entry requests.
    pub intent: Intent,
    /// Menu that holds the entry.
    pub menu: Menu,
    /// Name shown in the menu.
    pub name: &'static str,
    /// Description shown in the tooltip and the table of keys.
    pub description: &'static str,
    /// Shortcuts. The first stands beside the name.
    pub shortcuts: &'static [Shortcut],
}

impl Intent {
    /// Name of its keys in preferences, e.g. `save-as`, `tool-paint` or `brush-3`.
    #[must_use]
    pub fn name(self) -> String {
        name_of(&self)
    }
}

/// A part of the window that the tour points at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// Tubes beside the palette.
    Tubes,
    /// Button of the toolbar.
    Button(Intent),
    /// Tab of the side panel, by its name.
    Tab(&'static str),
}

/// Notes where a part is drawn in this frame.
pub(super) fn note(context: &Context, part: Part, rect: Rect) {
    let pass = context.cumulative_pass_nr();
    context.data_mut(|data| data.insert_temp(id(part), (rect, pass)));
}

/// Where a part was drawn in this frame or the one before; `None` if you do not see it.
pub(super) fn rect(context: &Context, part: Part) -> Option<Rect> {
    let pass = context.cumulative_pass_nr();
    let (rect, drawn): (Rect, u64) = context.data(|data| data.get_temp(id(part)))?;
    (drawn + 1 >= pass).then_some(rect)
}

fn id(part: Part) -> Id {
    Id::unique(("part of the window", format!("{part:?}")))
}
