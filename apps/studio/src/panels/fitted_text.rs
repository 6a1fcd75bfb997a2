//! Text that fits into a rectangle: wrapped or smaller before it is truncated.

use std::sync::Arc;

use eframe::egui::text::{LayoutJob, TextWrapping};
use eframe::egui::{Align, Color32, FontId, Galley, Rect, TextStyle, Ui, pos2};

/// Smallest font, in points.
const SMALLEST: f32 = 9.0;

/// Space that a line of text may take above and below its rectangle, in points.
const OVER: f32 = 2.0;

/// Draws text within a rectangle, centred vertically: on one line, or on as many lines as
/// there is room for, or in a smaller font. Only what does not fit even so is truncated.
pub(super) fn text(
    ui: &Ui,
    rect: Rect,
    align: Align,
    style: TextStyle,
    color: Color32,
    words: &str,
) {
    let laid = fitted(ui, rect, align, style, color, words);
    let top = rect.center().y - laid.size().y / 2.0;
    draw(ui, rect, align, top, laid, color);
}

/// Draws text as [`text`] does, from the top of the rectangle.
pub(super) fn text_from_top(
    ui: &Ui,
    rect: Rect,
    align: Align,
    style: TextStyle,
    color: Color32,
    words: &str,
) {
    let laid = fitted(ui, rect, align, style, color, words);
    draw(ui, rect, align, rect.top(), laid, color);
}

/// Whether text fits into a rectangle on one line in its own font.
pub(super) fn fits_on_a_line(ui: &Ui, rect: Rect, style: TextStyle, words: &str) -> bool {
    let font = style.resolve(ui.style());
    let laid = ui.painter().layout_no_wrap(words.to_owned(), font, Color32::PLACEHOLDER);
    laid.size().x <= rect.width()
}

fn draw(ui: &Ui, rect: Rect, align: Align, top: f32, laid: Arc<Galley>, color: Color32) {
    let x = match align {
        Align::Min => rect.left(),
        Align::Center => rect.center().x,
        Align::Max => rect.right(),
    };
    ui.painter_at(rect.expand(OVER)).galley(pos2(x, top), laid, color);
}

/// Lays text out in the largest font in which it fits.
fn fitted(
    ui: &Ui,
    rect: Rect,
    align: Align,
    style: TextStyle,
    color: Color32,
    words: &str,
) -> Arc<Galley> {
    let usual = style.resolve(ui.style());
    let lay = |size: f32| {
        let font = FontId { size, family: usual.family.clone() };
        let height = ui.fonts_mut(|fonts| fonts.row_height(&font));
        let rows = ((rect.height() + 2.0 * OVER) / height).floor().max(1.0);
        let mut job = LayoutJob::simple(words.to_owned(), font, color, rect.width());
        job.wrap = TextWrapping {
            max_width: rect.width(),
            max_rows: rows as usize,
            ..TextWrapping::default()
        };
        job.halign = align;
        ui.painter().layout_job(job)
    };
    let mut size = usual.size;
    let mut laid = lay(size);
    while !is_whole(&laid) && size > SMALLEST {
        size = (size - 0.5).max(SMALLEST);
        laid = lay(size);
    }
    laid
}

/// Whether nothing is truncated, and no word is broken.
fn is_whole(laid: &Galley) -> bool {
    let broken = |row: &str| !row.ends_with(|last: char| !last.is_alphanumeric());
    let rows = laid.rows.len();
    let all_but_last = laid.rows.iter().take(rows.saturating_sub(1));
    !laid.elided && all_but_last.map(|row| row.text()).all(|row| !broken(&row))
}
