//! Cache of the textures of layer thumbnails.

use std::sync::Arc;

use eframe::egui::{
    Color32, ColorImage, Context, Pos2, Rect, Sense, TextureHandle, TextureOptions, Ui, vec2,
};

use crate::theme;
use session::Thumbnail;

/// Textures of the thumbnails in use.
#[derive(Clone, Default)]
pub(super) struct Thumbnails(Vec<(Arc<Thumbnail>, TextureHandle)>);

impl std::fmt::Debug for Thumbnails {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Thumbnails").field(&self.0.len()).finish()
    }
}

impl Thumbnails {
    /// Draws a thumbnail within `area` points, keeping its aspect ratio.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        thumbnail: &Arc<Thumbnail>,
        area: eframe::egui::Vec2,
    ) {
        let (rect, _) = ui.allocate_exact_size(area, Sense::hover());
        if thumbnail.width == 0 || thumbnail.height == 0 {
            return;
        }
        let size = vec2(thumbnail.width as f32, thumbnail.height as f32);
        let scale = (area.x / size.x).min(area.y / size.y);
        let place = Rect::from_center_size(rect.center(), size * scale);
        let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
        let texture = self.texture(ui.ctx(), thumbnail).id();
        ui.painter().rect_filled(place, 0.0, theme::SURROUND);
        ui.painter().image(texture, place, whole, Color32::WHITE);
    }

    /// Drops textures of thumbnails that are not in `layers`.
    pub(super) fn keep<'a>(&mut self, layers: impl Iterator<Item = &'a Arc<Thumbnail>> + Clone) {
        self.0.retain(|(kept, _)| layers.clone().any(|layer| Arc::ptr_eq(kept, layer)));
    }

    fn texture(&mut self, context: &Context, thumbnail: &Arc<Thumbnail>) -> &TextureHandle {
        let found = self.0.iter().position(|(kept, _)| Arc::ptr_eq(kept, thumbnail));
        let index = found.unwrap_or_else(|| {
            let pixels: Vec<u8> = thumbnail.pixels.iter().flatten().copied().collect();
            let size = [thumbnail.width, thumbnail.height];
            let image = ColorImage::from_rgba_unmultiplied(size, &pixels);
            let texture = context.load_texture("layer", image, TextureOptions::LINEAR);
            self.0.push((Arc::clone(thumbnail), texture));
            self.0.len() - 1
        });
        &self.0[index].1
    }
}
