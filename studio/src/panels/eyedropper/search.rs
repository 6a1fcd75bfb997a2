//! The search for recipes: from what, under which lights, and what was found.

use std::sync::Arc;

use eframe::egui::{Button, DragValue, ProgressBar, Ui};
use pigment::evaluate::Viewing;
use pigment::matching::{MatchRequest, Sight};
use spectra::{Observer, light_from_text};

use super::super::desk::Desk;
use super::offers::Offer;
use super::wanted::{Wanted, shown, weights};
use crate::matching::{Matcher, Question};
use session::PaintingState;

/// Recipes shown.
const BEST: usize = 3;

/// Whole parts of a recipe, together, at first: strong pigments need a small one.
const PARTS: u32 = 40;

/// Limits of the search, and the search.
#[derive(Debug)]
pub(super) struct Search {
    matcher: Matcher,
    /// Whether all pigments of the library may take part, or those of the palette.
    whole_library: bool,
    /// Whether both lights of the split view count.
    both_lights: bool,
    parts: u32,
}

impl Default for Search {
    fn default() -> Self {
        Self { matcher: Matcher::default(), whole_library: false, both_lights: true, parts: PARTS }
    }
}

impl Search {
    /// Begins to search recipes for `wanted`.
    pub(super) fn begin(&mut self, ui: &Ui, easel: &PaintingState, wanted: &Wanted) {
        let question = self.question(easel, wanted);
        let context = ui.ctx().clone();
        self.matcher.ask(question, move || context.request_repaint());
    }

    /// What is asked for `wanted`.
    fn question(&self, easel: &PaintingState, wanted: &Wanted) -> Question {
        let library = &easel.library;
        let sights = self.sights(easel);
        let target = wanted.target(library.grid, &sights);
        let film = MatchRequest::usual_film(library, easel.ground_reflectance.to_vec());
        let mut request = MatchRequest::new(library, sights, film);
        if !self.whole_library {
            request.allowed = easel.slots.iter().copied().flatten().collect();
            request.allowed.sort_unstable();
            request.allowed.dedup();
        }
        request.whole_parts = Some(self.parts);
        // One part of the most is allowed, however many those are.
        request.least_share = request.least_share.min(1.0 / f64::from(self.parts));
        request.count = BEST;
        Question { library: Arc::clone(library), target, request }
    }

    fn sights(&self, easel: &PaintingState) -> Vec<Sight> {
        let mut sights = vec![Sight { viewing: easel.light.viewing.clone(), weight: 1.0 }];
        if let Some(second) = easel.second_lighting.as_ref().filter(|_| self.both_lights) {
            let illuminant = light_from_text(&second.illuminant).ok();
            let viewing = illuminant.zip(Observer::named(&second.observer).ok());
            sights.extend(viewing.map(|(illuminant, observer)| Sight {
                viewing: Viewing { illuminant, observer },
                weight: 1.0,
            }));
        }
        sights
    }

    /// Shows limits, progress and what was found for `wanted`.
    pub(super) fn show(&mut self, ui: &mut Ui, desk: &mut Desk<'_>, wanted: Option<&Wanted>) {
        self.matcher.update();
        let mut again = self.limits(ui, desk.easel);
        if let Some(share) = self.matcher.progress() {
            ui.horizontal(|ui| {
                let cancel = ui.button("Cancel").on_hover_text("Ends the search for recipes");
                ui.add(ProgressBar::new(share as f32).show_percentage());
                if cancel.clicked() {
                    self.matcher.cancel();
                }
            });
            ui.ctx().request_repaint_after_secs(0.1);
        } else {
            let find = ui.add_enabled(wanted.is_some(), Button::new("Find recipes for it"));
            let find = find
                .on_hover_text("Searches the three best recipes for the wanted colour")
                .on_disabled_hover_text("Choose a colour first");
            again |= find.clicked();
        }
        if let Some(wanted) = wanted.filter(|_| again) {
            self.begin(ui, desk.easel, wanted);
        }
        self.found(ui, desk);
    }

    /// Shows the limits; gives whether one was changed.
    fn limits(&mut self, ui: &mut Ui, easel: &PaintingState) -> bool {
        let before = (self.whole_library, self.both_lights, self.parts);
        ui.horizontal(|ui| {
            let palette = ui.radio_value(&mut self.whole_library, false, "Palette");
            palette.on_hover_text("Mixes pigments that are on the palette");
            let library = ui.radio_value(&mut self.whole_library, true, "Library");
            library.on_hover_text("Mixes any pigments of the library");
            let parts = DragValue::new(&mut self.parts)
                .range(1..=60)
                .speed(0.1)
                .update_while_editing(false)
                .suffix(" parts");
            let parts = ui.add(parts).accessible_name("Parts at most");
            parts.on_hover_text("Recipes are in whole parts, together at most so many");
        });
        if easel.second_lighting.is_some() {
            let both = ui.checkbox(&mut self.both_lights, "Under both lights");
            both.on_hover_text(
                "Recipes are to meet the colour under both lights of the split view",
            );
        }
        before != (self.whole_library, self.both_lights, self.parts)
    }

    fn found(&self, ui: &mut Ui, desk: &mut Desk<'_>) {
        if self.matcher.died() {
            ui.label("The search ended without an answer.");
        }
        let easel = desk.easel;
        let Some(answer) = self.matcher.answer() else { return };
        let Question { library, target, request } = &answer.question;
        if *library != easel.library {
            return;
        }
        let (asked, now) = (&request.sights[0].viewing, &easel.light.viewing);
        if asked != now {
            let told = format!("Found under {}, not the present light", asked.illuminant.name());
            ui.weak(told);
        }
        let recipes = match &answer.recipes {
            Ok(recipes) => recipes,
            Err(error) => {
                ui.label(format!("{error}."));
                return;
            }
        };
        if recipes.is_empty() {
            ui.label("No recipe fits; allow more parts.");
        }
        let white = weights(library.grid, asked).white();
        let goal = shown(target.lab[0], white);
        for (index, recipe) in recipes.iter().enumerate() {
            let offer = Offer { number: index + 1, library, recipe, white, wanted: goal };
            offer.show(ui, desk);
        }
    }
}
