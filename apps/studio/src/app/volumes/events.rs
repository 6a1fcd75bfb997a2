//! Handles the events of the worker of scenes.

use std::sync::Arc;
use web_time::Instant;

use eframe::egui::Context;
use graphics::tile::Rect;

use super::orbit::Orbit;
use super::workspace::Volumes;
use crate::app::status::Message;
use crate::files::{Files, Problem};
use crate::language::tr;
use crate::view::Picture;
use session::TilePixels;
use session::volumes::{ScenePicture, VolumeEvent};

impl Volumes {
    /// Handles all events that arrived since the last call.
    pub(in crate::app) fn handle_events(&mut self, files: &mut Files) {
        let events: Vec<VolumeEvent> = self.worker.events().collect();
        for event in events {
            self.handle_event(event, files);
        }
    }

    fn handle_event(&mut self, event: VolumeEvent, files: &mut Files) {
        match event {
            VolumeEvent::Opened(state) => {
                let orbit = Orbit::around(state.bounds, state.framed);
                let seen_from = state.seen_from.as_ref();
                self.orbit = seen_from.map_or(orbit, |camera| orbit.seen_by(camera));
                self.told.0 = None;
                (self.here, self.tools.here) = (None, None);
                self.message = None;
                files.scene_opened(&state);
                self.state = Some(state);
            }
            VolumeEvent::State(state) => {
                files.scene_changed(&state);
                self.state = Some(state);
            }
            VolumeEvent::Picture(picture) => self.show_picture(picture),
            VolumeEvent::Here(here) => {
                self.tools.here = Some((*here).clone());
                if let Some((_, answer)) = &mut self.here {
                    *answer = Some(*here);
                }
            }
            VolumeEvent::Recording(number, recording) => {
                self.write_recording(number, &recording, files);
            }
            VolumeEvent::Drawn(number, picture) => self.write_picture(number, picture, files),
            VolumeEvent::Painted(number, document) => self.write_painting(number, document, files),
            VolumeEvent::Message { text, hint, failed: true } => {
                let hint = hint.map(|hint| hint.to_string());
                files.report(Problem { text, hint });
            }
            VolumeEvent::Message { text, hint, failed: false } => {
                let hint = hint.map(|hint| hint.to_string());
                self.message =
                    Some(Message { text, hint, failed: false, shown_at: Instant::now() });
            }
        }
    }

    /// Puts a picture on the screen.
    fn show_picture(&mut self, picture: Arc<ScenePicture>) {
        let ScenePicture { width, height, .. } = *picture;
        let kept = self.picture.take().map(|(_, shown)| shown);
        let kept = kept.filter(|shown| shown.cells() == (width, height));
        let mut shown = kept.unwrap_or_else(|| Picture::new(tr("Scene"), (width, height)));
        let rect = Rect { x: 0, y: 0, width, height };
        shown.write(&TilePixels { rect, pixels: picture.pixels.clone() });
        self.picture = Some((picture, shown));
        self.pictures += 1;
        self.shown_at = Some(Instant::now());
        self.frames.begin(Instant::now(), None);
    }

    /// Asks for the next frame while something is awaited.
    pub(super) fn keep_awake(&self, context: &Context) {
        if let Some(rest) = self.message.as_ref().and_then(|message| message.rest(Instant::now())) {
            context.request_repaint_after(rest);
        }
    }
}
