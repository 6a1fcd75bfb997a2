//! Handles the events of the worker.

use std::sync::Arc;
use web_time::Instant;

use paint::strokes::SurfaceId;

use super::side::Tab;
use super::status::Message;
use super::studio::Studio;
use crate::language::tr_format;
use session::{Event, PaintingState};

impl Studio {
    /// Handles all events that arrived since the last call.
    pub(super) fn handle_events(&mut self) {
        let events: Vec<Event> = self.worker.events().collect();
        for event in events {
            self.handle_event(event);
        }
    }

    /// Handles one event as if it came from the worker. Tests use this to inject
    /// events.
    pub fn handle_event(&mut self, event: Event) {
        self.event_count += 1;
        self.files.handle_event(&event);
        match event {
            Event::Opened(state) => self.open_painting(state),
            Event::State(state) => self.set_painting(state),
            Event::Tiles { surface, second, tiles, newest } => {
                let view = match surface {
                    SurfaceId::Canvas => &mut self.canvas,
                    SurfaceId::Palette => &mut self.palette,
                };
                for tile in &tiles {
                    view.write(second, tile);
                }
                if let Some(arrived) = newest {
                    self.frames.shows(arrived);
                }
            }
            Event::Head(head) => self.head = head,
            Event::Performance(figures) => self.figures = figures,
            Event::Picked(picked) => {
                self.tools.picked = Some(picked);
                self.panels.select(Tab::Color);
            }
            Event::Recording { number, script } => self.last_recording = Some((number, script)),
            // Handled by the files above.
            Event::Snapshot(_) | Event::Kept(_) | Event::Progress { .. } | Event::Replayed => {}
            Event::DirtyBrush(brush) => {
                let text = tr_format!("the brush \u{201c}{brush}\u{201d} is dirty", brush);
                let key = |name| {
                    let row = self.keymap.easel.row(name);
                    let key = row.and_then(|row| row.keys.first());
                    key.map_or_else(String::new, |key| format!(" ({})", key.text()))
                };
                let wash = key("wash");
                let wipe = key("wipe");
                let hint =
                    tr_format!("wash{wash} or wipe{wipe} it before another colour", wash, wipe);
                self.show_message(text, Some(hint), false);
            }
            Event::Message { text, hint, failed } => {
                self.show_message(text, hint.map(|hint| hint.to_string()), failed);
            }
        }
    }

    /// Shows another painting and resets what belongs to the previous one.
    fn open_painting(&mut self, state: Arc<PaintingState>) {
        self.canvas.open(state.canvas_cells);
        self.palette.open(state.palette_cells);
        self.head = None;
        self.hover = None;
        self.tour.forget();
        self.crop = None;
        self.twins = None;
        self.set_painting(state);
        let Some(painting) = &self.painting else { return };
        let exists = painting.brushes.iter().any(|brush| brush.name == self.tools.brush);
        if let Some(first) = painting.brushes.first().filter(|_| !exists) {
            self.tools.brush = first.name.clone();
        }
    }

    fn set_painting(&mut self, state: Arc<PaintingState>) {
        for surface in [&mut self.canvas, &mut self.palette] {
            surface.set_second(state.second_lighting.is_some());
        }
        self.painting = Some(state);
    }

    /// Shows a message in the status line.
    pub(super) fn show_message(&mut self, text: String, hint: Option<String>, failed: bool) {
        self.message = Some(Message { text, hint, failed, shown_at: Instant::now() });
    }
}
