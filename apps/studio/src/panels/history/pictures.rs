//! Pictures of the canvas along the history, with an outline around what an action changed.

use std::sync::Arc;

use eframe::egui::{
    Color32, ColorImage, Context, Painter, Pos2, Rect, Stroke, StrokeKind, TextureHandle,
    TextureId, TextureOptions, Vec2, pos2, vec2,
};

use crate::theme;
use session::{HistoryShot, Thumbnail};

/// Textures that are kept; the ones that were drawn least recently make room.
const MOST: usize = 96;

/// Textures of the pictures drawn last, the latest at the end.
#[derive(Clone, Default)]
pub(super) struct Pictures(Vec<(Arc<Thumbnail>, TextureHandle)>);

impl std::fmt::Debug for Pictures {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Pictures").field(&self.0.len()).finish()
    }
}

impl Pictures {
    /// Draws a picture as large as fits into `area`, with an outline around what was changed. A
    /// missing one leaves an empty frame.
    pub(super) fn draw(&mut self, painter: &Painter, area: Rect, shot: Option<&HistoryShot>) {
        let Some(HistoryShot { picture, changed }) = shot else {
            let line = Stroke::new(1.0, theme::colors(painter.ctx()).line);
            painter.rect_stroke(area.shrink(2.0), 0.0, line, StrokeKind::Inside);
            return;
        };
        let place = fitted(picture, area);
        let whole = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
        painter.image(self.texture(painter.ctx(), picture), place, whole, Color32::WHITE);
        if let Some([left, top, width, height]) = changed.map(|changed| changed.map(|n| n as f32)) {
            let scale = place.width() / picture.width as f32;
            let corner = place.min + vec2(left, top) * scale;
            let outline = Rect::from_min_size(corner, vec2(width, height) * scale);
            // Dark beside light, so that it is seen on any paint.
            let outline = outline.expand(1.0).intersect(place.expand(1.0));
            let dark = Stroke::new(1.0, Color32::from_black_alpha(200));
            painter.rect_stroke(outline, 0.0, dark, StrokeKind::Outside);
            painter.rect_stroke(outline, 0.0, Stroke::new(1.0, Color32::WHITE), StrokeKind::Inside);
        }
    }

    fn texture(&mut self, context: &Context, picture: &Arc<Thumbnail>) -> TextureId {
        let found = self.0.iter().position(|(kept, _)| Arc::ptr_eq(kept, picture));
        let entry = match found {
            Some(index) => self.0.remove(index),
            None => {
                let pixels: Vec<u8> = picture.pixels.iter().flatten().copied().collect();
                let size = [picture.width, picture.height];
                let image = ColorImage::from_rgba_unmultiplied(size, &pixels);
                let texture = context.load_texture("history", image, TextureOptions::LINEAR);
                (Arc::clone(picture), texture)
            }
        };
        let texture = entry.1.id();
        self.0.push(entry);
        let surplus = self.0.len().saturating_sub(MOST);
        self.0.drain(..surplus);
        texture
    }
}

/// Size of a picture that is as large as fits into `room`.
pub(super) fn fitted_size(picture: &Thumbnail, room: Vec2) -> Vec2 {
    let size = vec2(picture.width.max(1) as f32, picture.height.max(1) as f32);
    size * (room.x / size.x).min(room.y / size.y)
}

fn fitted(picture: &Thumbnail, area: Rect) -> Rect {
    Rect::from_center_size(area.center(), fitted_size(picture, area.size()))
}
