//! What the worker told since the last frame.

use std::sync::Arc;
use std::time::Instant;

use render::paint::strokes::SurfaceId;

use super::Studio;
use super::side::Tab;
use super::status::Message;
use session::{Event, PaintingState};

impl Studio {
    /// Takes in what the worker told.
    pub(super) fn listen(&mut self) {
        let events: Vec<Event> = self.worker.events().collect();
        for event in events {
            self.hear(event);
        }
    }

    /// Takes in one thing, as if the worker had told it.
    pub fn hear(&mut self, event: Event) {
        self.heard += 1;
        self.files.handle_event(&event);
        match event {
            Event::Opened(state) => self.take_up(state),
            Event::State(state) => self.know(state),
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
                self.panels.bring(Tab::Color);
            }
            Event::Recording { number, .. } => self.answered = Some(number),
            // Of the files.
            Event::Snapshot(_) | Event::Progress { .. } | Event::Replayed => {}
            Event::Message { text, hint, failed } => {
                self.say(text, hint.map(|hint| hint.to_string()), failed)
            }
        }
    }

    /// Another painting is there.
    fn take_up(&mut self, state: Arc<PaintingState>) {
        self.canvas.open(state.canvas_cells);
        self.palette.open(state.palette_cells);
        self.head = None;
        self.hover = None;
        self.know(state);
        let Some(easel) = &self.easel else { return };
        let there = easel.brushes.iter().any(|brush| brush.name == self.tools.brush);
        if let Some(first) = easel.brushes.first().filter(|_| !there) {
            self.tools.brush = first.name.clone();
        }
    }

    fn know(&mut self, state: Arc<PaintingState>) {
        self.canvas.set_second(state.second_lighting.is_some());
        self.easel = Some(state);
    }

    /// Tells the painter something.
    pub(super) fn say(&mut self, text: String, hint: Option<String>, failed: bool) {
        self.message = Some(Message { text, hint, failed, said: Instant::now() });
    }
}
