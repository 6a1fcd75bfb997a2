//! The revisions of the painting, as the panel shows them.

use std::path::PathBuf;

use eframe::egui::{ColorImage, Context, TextureHandle, TextureOptions};

use super::revisions::Revision;

/// A revision with its thumbnail on the screen.
#[derive(Clone)]
pub struct ListedRevision {
    /// What it is.
    pub revision: Revision,
    /// What it looks like, if its picture is there.
    pub texture: Option<TextureHandle>,
}

impl std::fmt::Debug for ListedRevision {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.revision.path.fmt(formatter)
    }
}

/// The revisions there are, the newest first.
#[derive(Debug, Clone, Default)]
pub struct RevisionList {
    /// The painting's file; a painting without one has no revisions.
    pub path: Option<PathBuf>,
    /// The revisions.
    pub revisions: Vec<ListedRevision>,
}

impl RevisionList {
    /// Takes up what was read, and brings the thumbnails to the screen.
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
