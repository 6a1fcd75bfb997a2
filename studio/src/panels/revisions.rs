//! The revisions of the painting: numbered copies with thumbnails.

use std::time::SystemTime;

use eframe::egui::{Align, Image, Layout, RichText, Ui, vec2};

use super::desk::Desk;
use crate::files::{FileRequest, ListedRevision, RevisionList, ago, size};

/// The longer side of a thumbnail, in points.
const THUMBNAIL: f32 = 72.0;

/// Shows the revisions, the newest first, and what can be done with them.
pub fn show(ui: &mut Ui, desk: &mut Desk<'_>, list: &RevisionList) {
    let keep = ui.button("Keep revision");
    let tip = "Keeps a numbered copy beside the painting's file; asks for the file if it has none";
    if keep.on_hover_text(tip).clicked() {
        desk.file(FileRequest::KeepRevision);
    }
    if list.revisions.is_empty() {
        ui.label(RichText::new("No revisions yet").weak());
    }
    let now = SystemTime::now();
    for listed in &list.revisions {
        ui.separator();
        row(ui, desk, listed, now);
    }
}

fn row(ui: &mut Ui, desk: &mut Desk<'_>, listed: &ListedRevision, now: SystemTime) {
    let revision = &listed.revision;
    let number = revision.number;
    ui.horizontal(|ui| {
        let square = vec2(THUMBNAIL, THUMBNAIL);
        match &listed.texture {
            Some(texture) => {
                let picture = Image::from_texture(texture).fit_to_exact_size(square);
                let alt = format!("Revision {number}");
                ui.add(picture.max_size(square).alt_text(alt))
                    .on_hover_text(revision.path.display().to_string());
            }
            None => {
                ui.allocate_space(vec2(THUMBNAIL, THUMBNAIL / 2.0));
            }
        }
        ui.with_layout(Layout::top_down(Align::Min), |ui| {
            ui.label(format!("Revision {number}"));
            let kept = revision.kept.map(|kept| ago(kept, now)).unwrap_or_default();
            let told = format!("{kept}, {}", size(revision.bytes));
            ui.label(RichText::new(told).weak().small());
            ui.horizontal(|ui| {
                let open = ui.button(format!("Open {number}"));
                if open.on_hover_text("Takes it up as a new painting").clicked() {
                    desk.file(FileRequest::OpenRevision(revision.path.clone()));
                }
                let delete = ui.button(format!("Delete {number}"));
                if delete.on_hover_text("Deletes it, after a question").clicked() {
                    desk.file(FileRequest::DeleteRevision(revision.path.clone()));
                }
            });
        });
    });
}
