//! Small dialogs: questions, export, new painting, preferences.

use std::path::Path;

use eframe::egui::{Align, Context, DragValue, Grid, Id, Key, Layout, Modal, RichText, Ui};
use render::export::{PictureFormat, SpectralBands};
use render::paint::ground::GroundKind;
use render::paint::scene::PixelsPerCell;
use render::paint::strokes::Canvas;

use super::drawing::DrawnFile;
use super::exporting::{Export, ExportKind};
use super::preferences::{Backend, Preferences};
use crate::pen::PenSettings;

/// The button of a dialog that was chosen in this frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Choice {
    /// The main button, or Enter.
    Yes,
    /// The second button.
    No,
    /// Esc, Cancel, or a click outside the dialog.
    Cancelled,
}

/// Label and tooltip of a button.
type ButtonText = (&'static str, &'static str);

/// Shows a dialog with `content` above a row of buttons.
fn dialog(
    ctx: &Context,
    title: &str,
    yes: ButtonText,
    no: Option<ButtonText>,
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
            if ui.button("Cancel").on_hover_text("Changes nothing (Esc)").clicked() {
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

/// Asks if changes should be saved before they are lost.
pub(super) fn unsaved(ctx: &Context, title: &str) -> Option<Choice> {
    let save = ("Save", "Saves it, then continues (Enter)");
    let discard = ("Discard", "Continues; unsaved changes are lost");
    dialog(ctx, "Save the painting?", save, Some(discard), |ui| {
        ui.label(format!("{title} has unsaved changes."));
    })
}

/// Asks if drawings should be saved before they are lost.
pub(super) fn unsaved_drawings(ctx: &Context, lost: &[DrawnFile]) -> Option<Choice> {
    let save = ("Save", "Asks where to save them, then continues (Enter)");
    let discard = ("Discard", "Continues; unsaved lines are lost");
    let names: Vec<&str> = lost.iter().map(|drawn| drawn.drawing.kind().name()).collect();
    let names = names.join(" and ");
    dialog(ctx, "Save the drawing?", save, Some(discard), |ui| {
        ui.label(format!("The {names} on the reference picture are in no file."));
    })
}

/// Asks if a revision should be deleted.
pub(super) fn delete(ctx: &Context, path: &Path) -> Option<Choice> {
    let number = path.file_stem().unwrap_or_default().to_string_lossy();
    let delete = ("Delete", "Deletes the file permanently (Enter)");
    dialog(ctx, "Delete the revision?", delete, None, |ui| {
        ui.label(format!("Revision {number} will be deleted."));
        ui.label(RichText::new("The painting itself stays.").weak());
    })
}

/// Asks what to export.
pub(super) fn export(ctx: &Context, chosen: &mut Export) -> Option<Choice> {
    const KINDS: [(ExportKind, &str, &str); 6] = [
        (
            ExportKind::Picture(PictureFormat::Png8),
            "Picture, PNG of 8 bits",
            "sRGB, for viewing and for the web",
        ),
        (
            ExportKind::Picture(PictureFormat::Png16),
            "Picture, PNG of 16 bits",
            "sRGB with finer steps, for editing",
        ),
        (
            ExportKind::Picture(PictureFormat::LinearExr),
            "Picture, linear OpenEXR",
            "Linear light in 32-bit floats, nothing clipped",
        ),
        (
            ExportKind::Spectral(SpectralBands::Nodes),
            "Spectra, OpenEXR of 8 wavelengths",
            "Reflectance of every cell at the eight wavelengths of the light",
        ),
        (
            ExportKind::Spectral(SpectralBands::Full),
            "Spectra, OpenEXR of all wavelengths",
            "Reflectance of every cell at all wavelengths of the library; takes a while",
        ),
        (
            ExportKind::PigmentMaps,
            "Pigment maps, a folder of PNG",
            "How much of each pigment lies where, with the scale in JSON and the sums in CSV",
        ),
    ];
    let next = ("Choose a name", "Asks where to write it (Enter)");
    dialog(ctx, "Export", next, None, |ui| {
        for (kind, words, tip) in KINDS {
            ui.radio_value(&mut chosen.kind, kind, words).on_hover_text(tip);
        }
        if let ExportKind::Picture(_) = chosen.kind {
            ui.add_space(4.0);
            ui.label("Pixels for each cell");
            ui.horizontal(|ui| {
                let counts = 1..=PixelsPerCell::MOST;
                for pixels in counts.filter_map(|count| PixelsPerCell::new(count).ok()) {
                    let words = format!("{0} x {0}", pixels.count());
                    let tip = "More hide the cells, and the light shades the relief between them";
                    ui.radio_value(&mut chosen.pixels, pixels, words).on_hover_text(tip);
                }
            });
        }
    })
}

/// Canvas of a new painting, as described in the dialog.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct NewPainting {
    width_mm: f64,
    height_mm: f64,
    cell_mm: f64,
    ground: GroundKind,
    seed: u64,
    /// Whether the new painting uses the library and palette of the current one.
    pub(super) same_pigments: bool,
}

impl Default for NewPainting {
    fn default() -> Self {
        Self {
            width_mm: 192.0,
            height_mm: 108.0,
            cell_mm: 0.1,
            ground: GroundKind::Linen,
            seed: 1,
            same_pigments: true,
        }
    }
}

/// Maximum number of cells of a canvas: 64 million, of which each layer takes 2.3 GB.
const MAX_CELLS: usize = 64 << 20;

impl NewPainting {
    /// The canvas that was described.
    pub(super) fn canvas(&self) -> Canvas {
        let Self { width_mm, height_mm, cell_mm, ground, seed, .. } = *self;
        Canvas { width_mm, height_mm, cell_mm, ground: ground.spec(seed) }
    }

    /// Whether the canvas has at most `MAX_CELLS` cells.
    pub(super) fn fits(&self) -> bool {
        let (width, height) = self.canvas().cells();
        width.saturating_mul(height) <= MAX_CELLS
    }

    /// Shows the dialog.
    pub(super) fn show(&mut self, ctx: &Context) -> Option<Choice> {
        let begin = ("Begin", "Begins to paint on the new canvas (Enter)");
        let choice = dialog(ctx, "New painting", begin, None, |ui| {
            Grid::new("new painting").num_columns(2).spacing([12.0, 6.0]).show(ui, |ui| {
                let length = |value, tip, ui: &mut Ui| {
                    let drag = DragValue::new(value).range(5.0..=2000.0).speed(1.0).suffix(" mm");
                    ui.add(drag).on_hover_text(tip);
                };
                grid_row(ui, "Width", |ui| length(&mut self.width_mm, "Width of the canvas", ui));
                grid_row(ui, "Height", |ui| {
                    length(&mut self.height_mm, "Height of the canvas", ui);
                });
                grid_row(ui, "Cell", |ui| {
                    let drag = DragValue::new(&mut self.cell_mm).range(0.02..=2.0).speed(0.01);
                    let tip = "Width of a cell; 0.1 mm is 254 per inch. Smaller is finer and \
                               slower";
                    ui.add(drag.suffix(" mm")).on_hover_text(tip);
                });
                grid_row(ui, "Ground", |ui| {
                    for (ground, name, tip) in [
                        (GroundKind::Linen, "Linen", "Primed linen in plain weave"),
                        (GroundKind::Paper, "Paper", "Cold-pressed paper"),
                        (GroundKind::Panel, "Panel", "A primed panel, nearly flat"),
                    ] {
                        ui.radio_value(&mut self.ground, ground, name).on_hover_text(tip);
                    }
                });
                grid_row(ui, "Seed", |ui| {
                    let tip = "Each number gives another piece of the same ground";
                    ui.add(DragValue::new(&mut self.seed)).on_hover_text(tip);
                });
                grid_row(ui, "Pigments", |ui| {
                    let same = &mut self.same_pigments;
                    ui.radio_value(same, true, "As now")
                        .on_hover_text("Keeps the library and the tubes");
                    let oils = ui.radio_value(same, false, "Van Gogh's oils");
                    oils.on_hover_text("The library that comes with the program");
                });
            });
            let (width, height) = self.canvas().cells();
            let fits = if self.fits() { "" } else { ": too many, choose larger cells" };
            ui.label(RichText::new(format!("{width} x {height} cells{fits}")).weak());
        });
        choice.filter(|choice| *choice != Choice::Yes || self.fits())
    }
}

/// Shows the preferences, which take effect while they are changed. Returns whether the
/// dialog stays open.
pub(super) fn preferences(ctx: &Context, preferences: &mut Preferences) -> bool {
    let mut open = true;
    let modal = Modal::new(Id::unique("preferences")).show(ctx, |ui| {
        ui.set_width(380.0);
        ui.heading("Preferences");
        ui.add_space(4.0);
        Grid::new("preferences").num_columns(2).spacing([12.0, 6.0]).show(ui, |ui| {
            grid_row(ui, "Autosave", |ui| {
                let drag = DragValue::new(&mut preferences.autosave_seconds).range(2..=3600);
                let tip = "Seconds between the copies that are kept in case the program ends unexpectedly";
                ui.add(drag.suffix(" s")).on_hover_text(tip);
            });
            grid_row(ui, "Undo memory", |ui| {
                let drag = DragValue::new(&mut preferences.undo_mib).range(0..=1 << 20);
                let tip = "Memory for undo; when it is full, the oldest actions can no longer be undone";
                ui.add(drag.suffix(" MiB")).on_hover_text(tip);
            });
            grid_row(ui, "Computes", |ui| {
                for (backend, name, tip) in [
                    (Backend::Auto, "Auto", "The graphics adapter if it is hardware, else the processor"),
                    (Backend::Cpu, "Processor", "All cores"),
                    (Backend::Gpu, "Graphics", "A graphics adapter, even a software one"),
                ] {
                    let tip = format!("{tip}; takes effect at the next start");
                    ui.radio_value(&mut preferences.backend, backend, name).on_hover_text(tip);
                }
            });
            grid_row(ui, "Size", |ui| {
                let drag = DragValue::new(&mut preferences.interface_scale).range(0.5..=3.0);
                let tip = "Size of text and buttons relative to the system's scale";
                ui.add(drag.speed(0.01).max_decimals(2)).on_hover_text(tip);
            });
            grid_row(ui, "Recordings", |ui| {
                let tip = "Plays at the speed of painting, otherwise as fast as possible";
                ui.checkbox(&mut preferences.replay_as_painted, "Play as painted")
                    .on_hover_text(tip);
            });
            pen(ui, &mut preferences.pen);
        });
        ui.add_space(8.0);
        ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
            open = !ui.button("Close").on_hover_text("Changes have taken effect (Esc)").clicked();
        });
    });
    open && !modal.should_close()
}

/// Adds the rows for pens and mice.
fn pen(ui: &mut Ui, pen: &mut PenSettings) {
    grid_row(ui, "Pen", |ui| {
        let drag = DragValue::new(&mut pen.gamma).range(0.2..=5.0).speed(0.01).max_decimals(2);
        let tip = "Exponent of the pressure: above 1 the brush presses less, below 1 more";
        ui.add(drag.prefix("pressure ")).on_hover_text(tip);
        let tip =
            "The brush follows tilt and twist of the pen; otherwise it is held as with a mouse";
        ui.checkbox(&mut pen.pen_tilt, "Tilt and twist").on_hover_text(tip);
    });
    grid_row(ui, "Mouse", |ui| {
        let drag = DragValue::new(&mut pen.grip.lean_deg).range(0.0..=80.0).max_decimals(0);
        let tip = "Angle between the handle and upright";
        ui.add(drag.prefix("leans ").suffix("\u{b0}")).on_hover_text(tip);
        let drag = DragValue::new(&mut pen.grip.towards_deg).range(0.0..=360.0).max_decimals(0);
        let tip =
            "Direction it leans to, clockwise from the right: 45 for a right hand, 135 for a left";
        ui.add(drag.prefix("towards ").suffix("\u{b0}")).on_hover_text(tip);
        let tip = "The broad side turns across the direction of the stroke";
        ui.checkbox(&mut pen.follow, "Follow the stroke").on_hover_text(tip);
    });
}

fn grid_row(ui: &mut Ui, name: &str, content: impl FnOnce(&mut Ui)) {
    ui.label(name);
    ui.horizontal(content);
    ui.end_row();
}
