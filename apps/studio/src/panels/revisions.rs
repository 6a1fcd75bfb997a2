//! The revisions panel: numbered copies of the painting with thumbnails.

use web_time::SystemTime;

use eframe::egui::{Align, Image, Layout, RichText, Ui, vec2};

use super::context::PanelContext;
use crate::files::{FileRequest, ListedRevision, RevisionList, ago, size};
use crate::language::{tr, tr_format};

/// Longer side of a thumbnail, in points.
const THUMBNAIL: f32 = 72.0;

/// Draws the panel: revisions, newest first, with buttons to open and delete them.
pub fn show(ui: &mut Ui, cx: &mut PanelContext<'_>, list: &RevisionList) {
    let keep = ui.button(tr("Keep revision"));
    let tip =
        tr("Keeps a numbered copy beside the painting's file; asks for a file name if it has none");
    if keep.on_hover_text(tip).clicked() {
        cx.file(FileRequest::KeepRevision);
    }
    if list.revisions.is_empty() {
        ui.label(RichText::new(tr("No revisions yet")).weak());
    }
    let now = SystemTime::now();
    for listed in &list.revisions {
        ui.separator();
        row(ui, cx, listed, now);
    }
}

fn row(ui: &mut Ui, cx: &mut PanelContext<'_>, listed: &ListedRevision, now: SystemTime) {
    let revision = &listed.revision;
    let number = revision.number;
    ui.horizontal(|ui| {
        let square = vec2(THUMBNAIL, THUMBNAIL);
        match &listed.texture {
            Some(texture) => {
                let picture = Image::from_texture(texture).fit_to_exact_size(square);
                let alt = tr_format!("Revision {number}", number);
                ui.add(picture.max_size(square).alt_text(alt))
                    .on_hover_text(revision.path.display().to_string());
            }
            None => {
                ui.allocate_space(vec2(THUMBNAIL, THUMBNAIL / 2.0));
            }
        }
        ui.with_layout(Layout::top_down(Align::Min), |ui| {
            ui.label(tr_format!("Revision {number}", number));
            let age = revision.kept.map(|kept| ago(kept, now)).unwrap_or_default();
            let details = format!("{age}, {}", size(revision.bytes));
            ui.label(RichText::new(details).weak().small());
            ui.horizontal(|ui| {
                let open = ui.button(tr_format!("Open {number}", number));
                if open.on_hover_text(tr("Opens it as a new painting")).clicked() {
                    cx.file(FileRequest::OpenRevision(revision.path.clone()));
                }
                let delete = ui.button(tr_format!("Delete {number}", number));
                if delete.on_hover_text(tr("Deletes it after a confirmation")).clicked() {
                    cx.file(FileRequest::DeleteRevision(revision.path.clone()));
                }
            });
        });
    });
}
