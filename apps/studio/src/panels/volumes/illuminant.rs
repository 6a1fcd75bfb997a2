//! The illuminant that the pigments of a scene are seen under.

use eframe::egui::Ui;
use session::volumes::SceneState;
use spectra::light_from_text;

use crate::language::tr;
use crate::panels::light::{IlluminantControl, White, power_chart};
use crate::theme;

/// Controls of the illuminant.
#[derive(Debug)]
pub struct SceneIlluminant {
    control: IlluminantControl,
    white: Option<White>,
}

impl Default for SceneIlluminant {
    fn default() -> Self {
        Self { control: IlluminantControl::new(tr("Illuminant"), tr("Temperature")), white: None }
    }
}

impl SceneIlluminant {
    /// Draws the choice of the illuminant, its power and its white. Returns the light that was
    /// chosen.
    pub(super) fn show(&mut self, ui: &mut Ui, state: &SceneState) -> Option<String> {
        ui.label(tr("Light on pigments")).on_hover_text(tr(
            "Light on the pigments of glazes and of the exported painting; the subject's own \
             colours stay as they are",
        ));
        let chosen = self.control.show(ui, &state.illuminant);
        let light = &state.light;
        let preview = self.control.preview().and_then(|name| light_from_text(&name).ok());
        let others: Vec<_> =
            preview.into_iter().map(|other| (other, theme::colors(ui.ctx()).strong)).collect();
        power_chart(ui, light, &others);
        if !self.white.as_ref().is_some_and(|white| white.is_of(light)) {
            self.white = Some(White::of(light));
        }
        if let Some(white) = &self.white {
            white.show(ui);
        }
        chosen.filter(|chosen| *chosen != state.illuminant)
    }
}
