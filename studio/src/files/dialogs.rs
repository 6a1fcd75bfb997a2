//! The small dialogs: questions, exports, a new painting, preferences.

use std::path::Path;

use eframe::egui::{Align, Context, DragValue, Grid, Id, Key, Layout, Modal, RichText, Ui};
use render::export::{Bands, PictureFormat};
use render::paint::ground::{GroundRelief, GroundSpec, Linen, Panel, Paper};
use render::paint::strokes::Canvas;

use super::exporting::Export;
use super::preferences::{Backend, Preferences};
use crate::pen::PenSettings;

/// What came of a dialog in this frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Choice {
    /// Its main button, or Enter.
    Yes,
    /// Its second button.
    No,
    /// Esc, Cancel, or a click beside it.
    Cancelled,
}

/// A button of a question: its words and its tooltip.
type Words = (&'static str, &'static str);

/// A dialog of `content` with a row of buttons.
fn dialog(
    ctx: &Context,
    title: &str,
    yes: Words,
    no: Option<Words>,
    content: impl FnOnce(&mut Ui),
) -> Option<Choice> {
    let mut choice = None;
    let modal = Modal::new(Id::unique(("dialog", title))).show(ctx, |ui| {
        ui.set_width(380.0);
        ui.heading(title);
        ui.add_space(4.0);
        content(ui);
        ui.add_space(8.0);
        ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
            if ui.button(yes.0).on_hover_text(yes.1).clicked() {
                choice = Some(Choice::Yes);
            }
            if let Some(no) = no
                && ui.button(no.0).on_hover_text(no.1).clicked()
            {
                choice = Some(Choice::No);
            }
            if ui.button("Cancel").on_hover_text("Nothing is done (Esc)").clicked() {
                choice = Some(Choice::Cancelled);
            }
        });
    });
    let enter = !ctx.egui_wants_keyboard_input() && ctx.input(|i| i.key_pressed(Key::Enter));
    if choice.is_none() && enter {
        choice = Some(Choice::Yes);
    }
    choice.or_else(|| modal.should_close().then_some(Choice::Cancelled))
}

/// Whether changes are to be saved before they are lost.
pub(super) fn unsaved(ctx: &Context, title: &str) -> Option<Choice> {
    let save = ("Save", "Saves it, then goes on (Enter)");
    let discard = ("Discard", "Goes on; what was not saved is lost");
    dialog(ctx, "Save the painting?", save, Some(discard), |ui| {
        ui.label(format!("{title} has changes that are in no file."));
    })
}

/// Whether a revision is to be deleted.
pub(super) fn delete(ctx: &Context, path: &Path) -> Option<Choice> {
    let number = path.file_stem().unwrap_or_default().to_string_lossy();
    let delete = ("Delete", "Deletes the file for good (Enter)");
    dialog(ctx, "Delete the revision?", delete, None, |ui| {
        ui.label(format!("Revision {number} will be gone."));
        ui.label(RichText::new("The painting itself stays.").weak());
    })
}

/// What to export.
pub(super) fn export(ctx: &Context, chosen: &mut Export) -> Option<Choice> {
    const KINDS: [(Export, &str, &str); 6] = [
        (
            Export::Picture(PictureFormat::Png8),
            "Picture, PNG of 8 bits",
            "sRGB, for the web and for looking at",
        ),
        (
            Export::Picture(PictureFormat::Png16),
            "Picture, PNG of 16 bits",
            "sRGB with finer steps, for work on the picture",
        ),
        (
            Export::Picture(PictureFormat::LinearExr),
            "Picture, linear OpenEXR",
            "Linear light in 32-bit floats, nothing clipped",
        ),
        (
            Export::Spectral(Bands::Nodes),
            "Spectra, OpenEXR of 8 wavelengths",
            "Reflectance of every cell at the wavelengths of the light",
        ),
        (
            Export::Spectral(Bands::Full),
            "Spectra, OpenEXR of all wavelengths",
            "Reflectance of every cell at all wavelengths of the library; takes a while",
        ),
        (
            Export::PigmentMaps,
            "Pigment maps, a folder of PNG",
            "How much of each pigment lies where, with the scale in JSON and the sums in CSV",
        ),
    ];
    let next = ("Choose a name", "Asks where to write it (Enter)");
    dialog(ctx, "Export", next, None, |ui| {
        for (kind, words, tip) in KINDS {
            ui.radio_value(chosen, kind, words).on_hover_text(tip);
        }
    })
}

/// What a new painting is painted on.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct NewPainting {
    width_mm: f64,
    height_mm: f64,
    cell_mm: f64,
    ground: Ground,
    seed: u64,
    /// Whether the pigments of the painting that is there are taken.
    pub(super) same_pigments: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ground {
    Linen,
    Paper,
    Panel,
}

impl Default for NewPainting {
    fn default() -> Self {
        Self {
            width_mm: 192.0,
            height_mm: 108.0,
            cell_mm: 0.1,
            ground: Ground::Linen,
            seed: 1,
            same_pigments: true,
        }
    }
}

/// The most cells of a canvas that the dialog lets pass: 64 million, of which a
/// layer takes 2.3 GB.
const MAX_CELLS: usize = 64 << 20;

impl NewPainting {
    /// The canvas that was described.
    pub(super) fn canvas(&self) -> Canvas {
        let seed = self.seed;
        let relief = match self.ground {
            Ground::Linen => GroundRelief::Linen(Linen { seed, ..Linen::default() }),
            Ground::Paper => GroundRelief::Paper(Paper { seed, ..Paper::default() }),
            Ground::Panel => GroundRelief::Panel(Panel { seed, ..Panel::default() }),
        };
        let Self { width_mm, height_mm, cell_mm, .. } = *self;
        Canvas { width_mm, height_mm, cell_mm, ground: GroundSpec::from(relief) }
    }

    /// Whether the canvas is not too large.
    pub(super) fn fits(&self) -> bool {
        let (width, height) = self.canvas().cells();
        width.saturating_mul(height) <= MAX_CELLS
    }

    /// Asks for it.
    pub(super) fn show(&mut self, ctx: &Context) -> Option<Choice> {
        let begin = ("Begin", "Takes the new canvas up (Enter)");
        let choice = dialog(ctx, "New painting", begin, None, |ui| {
            Grid::new("new painting").num_columns(2).spacing([12.0, 6.0]).show(ui, |ui| {
                let length = |value, tip, ui: &mut Ui| {
                    let drag = DragValue::new(value).range(5.0..=2000.0).speed(1.0).suffix(" mm");
                    ui.add(drag).on_hover_text(tip);
                };
                named(ui, "Width", |ui| length(&mut self.width_mm, "Width of the canvas", ui));
                named(ui, "Height", |ui| length(&mut self.height_mm, "Height of the canvas", ui));
                named(ui, "Cell", |ui| {
                    let drag = DragValue::new(&mut self.cell_mm).range(0.02..=2.0).speed(0.01);
                    let tip = "Width of a cell; 0.1 mm is 254 to the inch. Smaller is finer and \
                               slower";
                    ui.add(drag.suffix(" mm")).on_hover_text(tip);
                });
                named(ui, "Ground", |ui| {
                    for (ground, name, tip) in [
                        (Ground::Linen, "Linen", "Primed linen in plain weave"),
                        (Ground::Paper, "Paper", "Cold-pressed paper"),
                        (Ground::Panel, "Panel", "A primed panel, nearly flat"),
                    ] {
                        ui.radio_value(&mut self.ground, ground, name).on_hover_text(tip);
                    }
                });
                named(ui, "Seed", |ui| {
                    let tip = "Another number is another piece of the same ground";
                    ui.add(DragValue::new(&mut self.seed)).on_hover_text(tip);
                });
                named(ui, "Pigments", |ui| {
                    let same = &mut self.same_pigments;
                    ui.radio_value(same, true, "As now").on_hover_text("Library and tubes stay");
                    let oils = ui.radio_value(same, false, "Van Gogh's oils");
                    oils.on_hover_text("The library that comes with the program");
                });
            });
            let (width, height) = self.canvas().cells();
            let fits = if self.fits() { "" } else { ": too many, take larger ones" };
            ui.label(RichText::new(format!("{width} x {height} cells{fits}")).weak());
        });
        choice.filter(|choice| *choice != Choice::Yes || self.fits())
    }
}

/// The preferences; they hold as they are changed.
pub(super) fn preferences(ctx: &Context, preferences: &mut Preferences) -> bool {
    let mut open = true;
    let modal = Modal::new(Id::unique("preferences")).show(ctx, |ui| {
        ui.set_width(380.0);
        ui.heading("Preferences");
        ui.add_space(4.0);
        Grid::new("preferences").num_columns(2).spacing([12.0, 6.0]).show(ui, |ui| {
            named(ui, "Autosave", |ui| {
                let drag = DragValue::new(&mut preferences.autosave_seconds).range(2..=3600);
                let tip = "Seconds between copies for the case that the program is killed";
                ui.add(drag.suffix(" s")).on_hover_text(tip);
            });
            named(ui, "Undo memory", |ui| {
                let drag = DragValue::new(&mut preferences.undo_mib).range(0..=1 << 20);
                let tip = "What undo may keep; what does not fit is forgotten, oldest first";
                ui.add(drag.suffix(" MiB")).on_hover_text(tip);
            });
            named(ui, "Computes", |ui| {
                for (backend, name, tip) in [
                    (Backend::Auto, "Auto", "The graphics adapter, where there is a real one"),
                    (Backend::Cpu, "Processor", "All cores"),
                    (Backend::Gpu, "Graphics", "A graphics adapter, even one in software"),
                ] {
                    let tip = format!("{tip}; from the next start on");
                    ui.radio_value(&mut preferences.backend, backend, name).on_hover_text(tip);
                }
            });
            named(ui, "Size", |ui| {
                let drag = DragValue::new(&mut preferences.interface_scale).range(0.5..=3.0);
                let tip = "Size of letters and buttons beside the system's own";
                ui.add(drag.speed(0.01).max_decimals(2)).on_hover_text(tip);
            });
            named(ui, "Recordings", |ui| {
                let tip = "At the speed they were painted with, else as fast as can be";
                ui.checkbox(&mut preferences.replay_as_painted, "Play as painted")
                    .on_hover_text(tip);
            });
            pen(ui, &mut preferences.pen);
        });
        ui.add_space(8.0);
        ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
            open = !ui.button("Close").on_hover_text("They hold already (Esc)").clicked();
        });
    });
    open && !modal.should_close()
}

/// Rows of how a brush is led.
fn pen(ui: &mut Ui, pen: &mut PenSettings) {
    named(ui, "Pen", |ui| {
        let drag = DragValue::new(&mut pen.gamma).range(0.2..=5.0).speed(0.01).max_decimals(2);
        let tip = "Pressure is raised to this: above 1 for a softer hand, below for a heavier";
        ui.add(drag.prefix("pressure ")).on_hover_text(tip);
        let tip = "Tilt and twist of the pen lead the brush; else it is held as by a mouse";
        ui.checkbox(&mut pen.pen_tilt, "Tilt and twist").on_hover_text(tip);
    });
    named(ui, "Mouse", |ui| {
        let drag = DragValue::new(&mut pen.grip.lean_deg).range(0.0..=80.0).max_decimals(0);
        let tip = "How far the handle leans, from upright";
        ui.add(drag.prefix("leans ").suffix("\u{b0}")).on_hover_text(tip);
        let drag = DragValue::new(&mut pen.grip.towards_deg).range(0.0..=360.0).max_decimals(0);
        let tip =
            "Where it leans to, clockwise from the right: 45 for a right hand, 135 for a left";
        ui.add(drag.prefix("towards ").suffix("\u{b0}")).on_hover_text(tip);
        let tip = "The broad side turns across the way that the brush is led";
        ui.checkbox(&mut pen.follow, "Follow the way").on_hover_text(tip);
    });
}

fn named(ui: &mut Ui, name: &str, content: impl FnOnce(&mut Ui)) {
    ui.label(name);
    ui.horizontal(content);
    ui.end_row();
}
