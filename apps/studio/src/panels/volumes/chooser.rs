//! The window that chooses the pigment of a tube.

use eframe::egui::Context;
use paint::document::Medium;
use pigment::PigmentId;
use session::volumes::SceneState;

use crate::floating;
use crate::language::{tr, tr_format};
use crate::panels::controls::button;
use crate::panels::pigments::{CatalogueCache, PigmentList};

/// Width of the contents, in points.
const WIDTH: f32 = 400.0;

/// State of the window.
#[derive(Debug, Default)]
pub struct TubeChooser {
    /// Number of the tube, from 0, while the window is open.
    tube: Option<usize>,
    list: PigmentList,
    catalogue: CatalogueCache,
}

/// A choice of the painter.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum TubeChoice {
    /// A pigment for the tube with this number, by its name.
    Pigment(usize, String),
    /// Another library.
    Library,
}

impl TubeChooser {
    /// Opens the window for a tube.
    pub(super) fn open(&mut self, tube: usize) {
        (self.tube, self.list) = (Some(tube), PigmentList::default());
    }

    /// Draws the window if it is open. Returns what was chosen.
    pub(super) fn show(&mut self, context: &Context, state: &SceneState) -> Option<TubeChoice> {
        let tube = self.tube?;
        let name = &state.tubes.get(tube)?.name;
        let catalogue = self.catalogue.under(&state.library, &state.light);
        let scattering = Medium::of(&state.library).scattering_per_mm;
        let mut open = true;
        let mut choice = None;
        floating::show(context, tr("Choose a pigment"), tr("choose a pigment"), &mut open, |ui| {
            ui.set_width(WIDTH);
            ui.label(tr_format!("Tube {tube}: {name}", tube = tube + 1, name));
            ui.weak(tr("What was poured from this tube is paint of its new pigment."));
            ui.horizontal(|ui| {
                ui.label(&state.library.title);
                let tip = tr("Fills all tubes from another pigment library (.json)");
                if button(ui, tr("Open another library..."), tip, None) {
                    choice = Some(TubeChoice::Library);
                }
            });
            let held = |pigment: PigmentId| {
                let name = catalogue.name(pigment);
                let number = state.tubes.iter().position(|tube| tube.name == name)?;
                Some(tr_format!("it is already in tube {number}", number = number + 1))
            };
            if let Some(pigment) = self.list.show(ui, &catalogue, scattering, held) {
                choice = Some(TubeChoice::Pigment(tube, catalogue.name(pigment).to_owned()));
            }
        });
        if !open {
            self.tube = None;
        }
        choice
    }
}
