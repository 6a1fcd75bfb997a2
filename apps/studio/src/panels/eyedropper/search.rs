//! The recipe search of the eyedropper panel: limits, progress and results.

use std::sync::Arc;

use eframe::egui::{Button, DragValue, ProgressBar, Ui};
use pigment::evaluate::Viewing;
use pigment::matching::{MatchRequest, ViewingCondition};
use spectra::{Observer, light_from_text};

use super::super::context::PanelContext;
use super::found_recipe::FoundRecipe;
use super::target::{TargetColor, screen_rgb, weights};
use crate::language::{tr, tr_format};
use crate::recipe_search::{RecipeSearch, SearchRequest};
use session::PaintingState;

/// Number of recipes shown.
const BEST: usize = 3;

/// Default for the total of a recipe's whole parts. Large, because strong pigments need
/// small shares.
const PARTS: u32 = 40;

/// Limits of the recipe search and the running search.
#[derive(Debug)]
pub(in crate::panels) struct SearchPanel {
    search: RecipeSearch,
    /// Whether recipes may use the whole library instead of the palette.
    whole_library: bool,
    /// Whether recipes must match under both lights of the split view.
    both_lights: bool,
    parts: u32,
}

impl Default for SearchPanel {
    fn default() -> Self {
        Self {
            search: RecipeSearch::default(),
            whole_library: false,
            both_lights: true,
            parts: PARTS,
        }
    }
}

impl SearchPanel {
    /// Starts a search for recipes that match `target_color`.
    pub(in crate::panels) fn begin(
        &mut self,
        ui: &Ui,
        painting: &PaintingState,
        target_color: &TargetColor,
    ) {
        let request = self.request(painting, target_color);
        let context = ui.ctx().clone();
        self.search.start(request, move || context.request_repaint());
    }

    /// Forgets the recipes found, and ends a search.
    pub(in crate::panels) fn forget(&mut self) {
        self.search = RecipeSearch::default();
    }

    /// Builds the search request for `target_color` from the limits and the painting.
    fn request(&self, painting: &PaintingState, target_color: &TargetColor) -> SearchRequest {
        let library = &painting.library;
        let conditions = self.conditions(painting);
        let target = target_color.match_target(library.grid, &conditions);
        let film = MatchRequest::usual_film(library, painting.ground_reflectance.to_vec());
        let mut limits = MatchRequest::new(library, conditions, film);
        if !self.whole_library {
            limits.allowed = painting.slots.iter().copied().flatten().collect();
            limits.allowed.sort_unstable();
            limits.allowed.dedup();
        }
        limits.whole_parts = Some(self.parts);
        // The minimum share must not exclude a pigment of a single part.
        limits.least_share = limits.least_share.min(1.0 / f64::from(self.parts));
        limits.count = BEST;
        SearchRequest { library: Arc::clone(library), target, limits }
    }

    fn conditions(&self, painting: &PaintingState) -> Vec<ViewingCondition> {
        let mut conditions =
            vec![ViewingCondition { viewing: painting.light.viewing.clone(), weight: 1.0 }];
        if let Some(second) = painting.second_lighting.as_ref().filter(|_| self.both_lights) {
            let illuminant = light_from_text(&second.illuminant).ok();
            let viewing = illuminant.zip(Observer::named(&second.observer).ok());
            conditions.extend(viewing.map(|(illuminant, observer)| ViewingCondition {
                viewing: Viewing { illuminant, observer },
                weight: 1.0,
            }));
        }
        conditions
    }

    /// Draws limits, progress and the recipes found.
    pub(in crate::panels) fn show(
        &mut self,
        ui: &mut Ui,
        cx: &mut PanelContext<'_>,
        target_color: Option<&TargetColor>,
    ) {
        self.search.update();
        let mut restart = self.limits(ui, cx.painting);
        if let Some(share) = self.search.progress() {
            ui.horizontal(|ui| {
                let cancel =
                    ui.button(tr("Cancel")).on_hover_text(tr("Ends the search for recipes"));
                ui.add(ProgressBar::new(share as f32).show_percentage());
                if cancel.clicked() {
                    self.search.cancel();
                }
            });
            ui.ctx().request_repaint_after_secs(0.1);
        } else {
            let find =
                ui.add_enabled(target_color.is_some(), Button::new(tr("Find recipes for it")));
            let find = find
                .on_hover_text(tr("Searches the three best recipes for the target colour"))
                .on_disabled_hover_text(tr("Choose a colour first"));
            restart |= find.clicked();
        }
        if let Some(target_color) = target_color.filter(|_| restart) {
            self.begin(ui, cx.painting, target_color);
        }
        self.results(ui, cx);
    }

    /// Draws the limits. Returns whether one was changed.
    fn limits(&mut self, ui: &mut Ui, painting: &PaintingState) -> bool {
        let before = (self.whole_library, self.both_lights, self.parts);
        ui.horizontal(|ui| {
            let palette = ui.radio_value(&mut self.whole_library, false, tr("Palette"));
            palette.on_hover_text(tr("Mixes pigments that are on the palette"));
            let library = ui.radio_value(&mut self.whole_library, true, tr("Library"));
            library.on_hover_text(tr("Mixes any pigments of the library"));
            let parts = DragValue::new(&mut self.parts)
                .range(1..=60)
                .speed(0.1)
                .update_while_editing(false)
                .suffix(tr(" parts"));
            let parts = ui.add(parts).accessible_name(tr("Parts at most"));
            parts.on_hover_text(tr("Maximum sum of the whole parts of a recipe"));
        });
        if painting.second_lighting.is_some() {
            let both = ui.checkbox(&mut self.both_lights, tr("Under both lights"));
            both.on_hover_text(tr(
                "Recipes must match the colour under both lights of the split view",
            ));
        }
        before != (self.whole_library, self.both_lights, self.parts)
    }

    fn results(&self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        if self.search.crashed() {
            ui.label(tr("The search ended without a result."));
        }
        let painting = cx.painting;
        let Some(result) = self.search.result() else { return };
        let SearchRequest { library, target, limits } = &result.request;
        if *library != painting.library {
            return;
        }
        let searched = &limits.conditions[0].viewing;
        let current = &painting.light.viewing;
        if searched != current {
            let note = tr_format!(
                "Found under {name}, not the current light",
                name = searched.illuminant.name()
            );
            ui.weak(note);
        }
        let recipes = match &result.recipes {
            Ok(recipes) => recipes,
            Err(error) => {
                ui.label(format!("{error}."));
                return;
            }
        };
        if recipes.is_empty() {
            ui.label(tr("No recipe fits; allow more parts."));
        }
        let white = weights(library.grid, searched).white();
        let goal = screen_rgb(target.lab[0], white);
        for (index, recipe) in recipes.iter().enumerate() {
            let offer = FoundRecipe { number: index + 1, library, recipe, white, target: goal };
            offer.show(ui, cx);
        }
    }
}
