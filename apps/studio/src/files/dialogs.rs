//! Small dialogs: questions, export, new painting, preferences.
//!
//! Enter presses the default button of a dialog. In a field, Enter just leaves the field. You
//! press it again, or Ctrl+Enter at any time, for the button.

use std::path::Path;

use eframe::egui::{Align, Context, DragValue, Event, Grid, Id, Key, Layout, Modal, RichText, Ui};
use graphics::export::PictureFormat;
use paint::export::SpectralBands;
use paint::scene::PixelsPerCell;

use super::exporting::{Export, ExportKind, TimelapseExport};
use super::preferences::{Backend, Preferences};
use super::request::DrawnFile;
use crate::language::{Language, english, tr, tr_format};
use crate::pen::PenSettings;
use crate::theme::ThemeChoice;

/// The button of a dialog that you chose in this frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Choice {
    /// The main button, Enter outside of fields, or Ctrl+Enter.
    Yes,
    /// The second button.
    No,
    /// Escape, Cancel, or a click outside the dialog.
    Cancelled,
}

type ButtonText = (&'static str, &'static str);

/// Shows a dialog with `content` above a row of buttons.
pub(super) fn dialog(
    ctx: &Context,
    title: &str,
    yes: ButtonText,
    no: Option<ButtonText>,
    content: impl FnOnce(&mut Ui),
) -> Option<Choice> {
    let mut choice = None;
    let taken = keyboard_taken(ctx);
    let modal = Modal::new(Id::unique(("dialog", title))).show(ctx, |ui| {
        ui.set_width(380.0);
        ui.heading(title);
        ui.add_space(4.0);
        content(ui);
        ui.add_space(8.0);
        buttons_at_right(ui, |ui| {
            if ui.button(yes.0).on_hover_text(yes.1).clicked() {
                choice = Some(Choice::Yes);
            }
            if let Some(no) = no
                && ui.button(no.0).on_hover_text(no.1).clicked()
            {
                choice = Some(Choice::No);
            }
            if ui.button(tr("Cancel")).on_hover_text(tr("Changes nothing (Esc)")).clicked() {
                choice = Some(Choice::Cancelled);
            }
        });
    });
    if choice.is_none() && pressed(ctx, taken) {
        choice = Some(Choice::Yes);
    }
    choice.or_else(|| modal.should_close().then_some(Choice::Cancelled))
}

/// A row of buttons at the right edge. The first one stands outermost.
fn buttons_at_right(ui: &mut Ui, buttons: impl FnOnce(&mut Ui)) {
    // The row gives the height in which high buttons centre their text.
    ui.horizontal(|ui| ui.with_layout(Layout::right_to_left(Align::Center), buttons));
}

/// Asks whether to save changes before they are lost.
pub(super) fn unsaved(ctx: &Context, title: &str) -> Option<Choice> {
    let save = (tr("Save"), tr("Saves it, then continues (Enter)"));
    let discard = (tr("Discard"), tr("Continues; unsaved changes are lost"));
    dialog(ctx, tr("Save the painting?"), save, Some(discard), |ui| {
        ui.label(tr_format!("{title} has unsaved changes.", title));
    })
}

/// Asks whether to save drawings before they are lost.
pub(super) fn unsaved_drawings(ctx: &Context, lost: &[DrawnFile]) -> Option<Choice> {
    let save = (tr("Save"), tr("Asks where to save them, then continues (Enter)"));
    let discard = (tr("Discard"), tr("Continues; unsaved lines are lost"));
    let names: Vec<&str> = lost.iter().map(|drawn| tr(drawn.drawing.kind().name())).collect();
    let names = names.join(tr(" and "));
    dialog(ctx, tr("Save the drawing?"), save, Some(discard), |ui| {
        ui.label(tr_format!("The {names} on the reference picture are in no file.", names));
    })
}

/// Asks whether to delete a revision.
pub(super) fn delete(ctx: &Context, path: &Path) -> Option<Choice> {
    let number = path.file_stem().unwrap_or_default().to_string_lossy();
    let delete = (tr("Delete"), tr("Deletes the file permanently (Enter)"));
    dialog(ctx, tr("Delete the revision?"), delete, None, |ui| {
        ui.label(tr_format!("Revision {number} will be deleted.", number));
        ui.label(RichText::new(tr("The painting itself stays.")).weak());
    })
}

/// Asks what to export.
pub(super) fn export(ctx: &Context, chosen: &mut Export) -> Option<Choice> {
    const KINDS: [(ExportKind, &str, &str); 8] = [
        (
            ExportKind::Picture(PictureFormat::Png8),
            english("Picture, PNG of 8 bits"),
            english("sRGB, for viewing and for the web"),
        ),
        (
            ExportKind::Picture(PictureFormat::Png16),
            english("Picture, PNG of 16 bits"),
            english("sRGB with finer steps, for editing"),
        ),
        (
            ExportKind::Picture(PictureFormat::Tiff16),
            english("Picture, TIFF of 16 bits"),
            english("sRGB with its colour profile and the size in print"),
        ),
        (
            ExportKind::Picture(PictureFormat::LinearExr),
            english("Picture, linear OpenEXR"),
            english("Linear light in 32-bit floats, nothing clipped"),
        ),
        (
            ExportKind::Layers,
            english("Layers, OpenRaster"),
            english(
                "The ground, each dry layer and the wet paint for programs that paint in layers. Stacked \
             with normal opacity they show the picture; paint itself does not blend like that",
            ),
        ),
        (
            ExportKind::Spectral(SpectralBands::Nodes),
            english("Spectra, OpenEXR of 8 wavelengths"),
            english("Reflectance of every cell at the eight wavelengths of the light"),
        ),
        (
            ExportKind::Spectral(SpectralBands::Full),
            english("Spectra, OpenEXR of all wavelengths"),
            english("Reflectance of every cell at all wavelengths of the library; takes a while"),
        ),
        (
            ExportKind::PigmentMaps,
            english("Pigment maps, a folder of PNG"),
            english(
                "How much of each pigment lies where, with the scale in JSON and the sums in CSV",
            ),
        ),
    ];
    let next = (tr("Choose a name"), tr("Asks where to write it (Enter)"));
    dialog(ctx, tr("Export"), next, None, |ui| {
        for (kind, words, tip) in KINDS {
            ui.radio_value(&mut chosen.kind, kind, tr(words)).on_hover_text(tr(tip));
        }
        if let ExportKind::Picture(_) = chosen.kind {
            ui.add_space(4.0);
            ui.label(tr("Pixels for each cell"));
            ui.horizontal(|ui| {
                let counts = 1..=PixelsPerCell::MOST;
                for pixels in counts.filter_map(|count| PixelsPerCell::new(count).ok()) {
                    let words = format!("{0} x {0}", pixels.count());
                    let tip =
                        tr("More hide the cells, and the light shades the relief between them");
                    ui.radio_value(&mut chosen.pixels, pixels, words).on_hover_text(tip);
                }
            });
        }
    })
}

/// Asks for the settings of a timelapse.
pub(super) fn timelapse(ctx: &Context, chosen: &mut TimelapseExport) -> Option<Choice> {
    let next = (tr("Choose a name"), tr("Asks where to write it (Enter)"));
    dialog(ctx, tr("Export a timelapse"), next, None, |ui| chosen.controls(ui))
}

/// Shows the preferences. They take effect while you change them. Returns whether the dialog stays
/// open.
pub(super) fn preferences(ctx: &Context, preferences: &mut Preferences) -> bool {
    let mut open = true;
    let modal = Modal::new(Id::unique("preferences")).show(ctx, |ui| {
        ui.set_width(380.0);
        ui.heading(tr("Preferences"));
        ui.add_space(4.0);
        Grid::new("preferences").num_columns(2).spacing([12.0, 6.0]).show(ui, |ui| {
            grid_row(ui, tr("Autosave"), |ui| {
                let drag = DragValue::new(&mut preferences.autosave_seconds).range(2..=3600);
                let tip = tr("Seconds between the copies that are kept in case the program ends unexpectedly");
                ui.add(drag.suffix(" s")).on_hover_text(tip);
            });
            grid_row(ui, tr("Undo memory"), |ui| {
                let drag = DragValue::new(&mut preferences.undo_mib).range(0..=1 << 20);
                let tip = tr("Memory for undo; when it is full, the oldest actions can no longer be undone");
                ui.add(drag.suffix(" MiB")).on_hover_text(tip);
            });
            grid_row(ui, tr("Computes"), |ui| {
                for (backend, name, tip) in [
                    (Backend::Auto, tr("Auto"), tr("The graphics adapter if it is hardware, else the processor")),
                    (Backend::Cpu, tr("Processor"), tr("All cores")),
                    (Backend::Gpu, tr("Graphics"), tr("A graphics adapter, even a software one")),
                ] {
                    let tip = tr_format!("{tip}; takes effect at the next start", tip);
                    ui.radio_value(&mut preferences.backend, backend, name).on_hover_text(tip);
                }
            });
            grid_row(ui, tr("Size"), |ui| {
                let drag = DragValue::new(&mut preferences.interface_scale).range(0.5..=3.0);
                let tip = tr("Size of text and buttons relative to the system's scale");
                ui.add(drag.speed(0.01).max_decimals(2)).on_hover_text(tip);
            });
            grid_row(ui, tr("Theme"), |ui| {
                for (theme, name, tip) in [
                    (ThemeChoice::Dark, tr("Dark"), tr("Light text on dark panels")),
                    (ThemeChoice::Light, tr("theme|Light"), tr("Dark text on light panels")),
                    (ThemeChoice::System, tr("As the system"), tr("Dark or light, as the system prefers")),
                ] {
                    ui.radio_value(&mut preferences.theme, theme, name).on_hover_text(tip);
                }
            });
            grid_row(ui, tr("Language"), |ui| {
                let tip = tr("Language of the window; names of pigments and lights, and what the libraries report, stay English");
                let choice = &mut preferences.language;
                ui.radio_value(choice, None, tr("As the system")).on_hover_text(tip);
                for language in Language::ALL {
                    let name = language.own_name();
                    ui.radio_value(choice, Some(language), name).on_hover_text(tip);
                }
            });
            grid_row(ui, tr("Touch"), |ui| {
                let tip = tr("All buttons, rows and handles are at least 44 points high and wide");
                ui.checkbox(&mut preferences.touch_targets, tr("Large targets")).on_hover_text(tip);
            });
            grid_row(ui, tr("Recordings"), |ui| {
                let tip = tr("Plays at the speed of painting, otherwise as fast as possible");
                ui.checkbox(&mut preferences.replay_as_painted, tr("Play as painted"))
                    .on_hover_text(tip);
            });
            pen(ui, &mut preferences.pen);
        });
        ui.add_space(8.0);
        buttons_at_right(ui, |ui| {
            open = !ui.button(tr("Close")).on_hover_text(tr("Changes have taken effect (Esc)")).clicked();
        });
    });
    open && !modal.should_close()
}

fn pen(ui: &mut Ui, pen: &mut PenSettings) {
    grid_row(ui, tr("Pen"), |ui| {
        let tip =
            tr("The brush follows tilt and twist of the pen; otherwise it is held as with a mouse");
        ui.checkbox(&mut pen.pen_tilt, tr("Tilt and twist")).on_hover_text(tip);
        ui.weak(tr("pressure: Edit, Pen"));
    });
    grid_row(ui, tr("Mouse"), |ui| {
        let drag = DragValue::new(&mut pen.grip.lean_deg).range(0.0..=80.0).max_decimals(0);
        let tip = tr("Angle between the handle and upright");
        ui.add(drag.prefix(tr("leans ")).suffix("\u{b0}")).on_hover_text(tip);
        let drag = DragValue::new(&mut pen.grip.towards_deg).range(0.0..=360.0).max_decimals(0);
        let tip = tr(
            "Direction it leans to, clockwise from the right: 45 for a right hand, 135 for a left",
        );
        ui.add(drag.prefix(tr("towards ")).suffix("\u{b0}")).on_hover_text(tip);
        let tip = tr("The broad side turns across the direction of the stroke");
        ui.checkbox(&mut pen.follow, tr("Follow the stroke")).on_hover_text(tip);
    });
}

/// Adds a row with a name to the grid of a dialog.
pub(super) fn grid_row(ui: &mut Ui, name: &str, content: impl FnOnce(&mut Ui)) {
    ui.label(name);
    ui.horizontal(content);
    ui.end_row();
}

/// Whether a field or button has the keyboard. Ask this before you draw the dialog, because a field
/// gives the keyboard back in the frame of its Enter.
pub(crate) fn keyboard_taken(ctx: &Context) -> bool {
    ctx.egui_wants_keyboard_input()
}

/// Whether you pressed the default button by key in this frame. A held key counts once. `taken` is
/// the answer of [`keyboard_taken`] before the dialog was drawn.
pub(crate) fn pressed(ctx: &Context, taken: bool) -> bool {
    ctx.input(|input| {
        input.events.iter().any(|event| match event {
            Event::Key { key: Key::Enter, pressed: true, repeat: false, modifiers, .. } => {
                modifiers.command || (!taken && modifiers.is_none())
            }
            _ => false,
        })
    })
}
