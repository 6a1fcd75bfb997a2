//! Revisions of the painting with their thumbnails, as a panel shows them.

use std::path::PathBuf;

use eframe::egui::{ColorImage, Context, TextureHandle, TextureOptions};

use super::revisions::Revision;

/// A revision with its thumbnail as a texture.
#[derive(Clone)]
pub struct ListedRevision {
    /// File and number of the revision.
    pub revision: Revision,
    /// The thumbnail, if its file exists.
    pub texture: Option<TextureHandle>,
}

impl std::fmt::Debug for ListedRevision {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.revision.path.fmt(formatter)
    }
}

/// Revisions of the painting, the newest first.
#[derive(Debug, Clone, Default)]
pub struct RevisionList {
    /// The painting's file. A painting without one has no revisions.
    pub path: Option<PathBuf>,
    /// The revisions, the newest first.
    pub revisions: Vec<ListedRevision>,
}

impl RevisionList {
    /// Replaces the list and uploads the thumbnails.
    pub fn set(&mut self, ctx: &Context, path: Option<PathBuf>, revisions: Vec<Revision>) {
        self.path = path;
        let listed = revisions.into_iter().map(|revision| {
            let texture = revision.thumbnail.as_ref().map(|picture| {
                let size = [picture.width() as usize, picture.height() as usize];
                let image = ColorImage::from_rgba_unmultiplied(size, picture.as_raw());
                let name = revision.path.display().to_string();
                ctx.load_texture(name, image, TextureOptions::LINEAR)
            });
            ListedRevision { revision, texture }
        });
        self.revisions = listed.collect();
    }
}
