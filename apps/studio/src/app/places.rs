//! Rectangles of parts of the window, noted where they are drawn, for the guide that points at
//! them.

use eframe::egui::{Context, Id, Rect};

use super::intent::Intent;

/// A part of the window that is pointed at.
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

/// Where a part was drawn in this frame or the one before; `None` if it is not shown.
pub(super) fn rect(context: &Context, part: Part) -> Option<Rect> {
    let pass = context.cumulative_pass_nr();
    let (rect, drawn): (Rect, u64) = context.data(|data| data.get_temp(id(part)))?;
    (drawn + 1 >= pass).then_some(rect)
}

fn id(part: Part) -> Id {
    Id::unique(("part of the window", format!("{part:?}")))
}
