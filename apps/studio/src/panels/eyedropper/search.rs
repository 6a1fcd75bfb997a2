//! The recipe search of the eyedropper panel: limits, progress, and results with buttons to load
//! the brush and fill the palette.

use std::sync::Arc;

use eframe::egui::{Align, Button, DragValue, Label, Layout, ProgressBar, Ui, Vec2, vec2};
use paint::layer::SLOTS;
use paint::strokes::{Action, PaletteSpec, Recipe as Parts};
use pigment::PigmentId;
use pigment::evaluate::Viewing;
use pigment::library::PigmentLibrary;
use pigment::matching::{RecipeLimits, RecipeMatch, ViewingCondition};
use session::{Command, PaintingState};
use spectra::color::{Rgb, Xyz};
use spectra::{Observer, light_from_text};

use super::super::context::{PanelContext, keep, lay_on_palette};
use super::super::controls::small_button;
use super::target::{TargetColor, screen_rgb, swatch, weights};
use crate::language::{tr, tr_format};
use crate::recipe_search::{RecipeSearch, SearchRequest};
use crate::theme;

const BEST: usize = 3;

/// Default total of a recipe's whole parts. It is large, because strong pigments need small shares.
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

    /// Forgets the found recipes and ends a search.
    pub(in crate::panels) fn forget(&mut self) {
        self.search = RecipeSearch::default();
    }

    /// Builds the search request for `target_color` from the limits and the painting.
    fn request(&self, painting: &PaintingState, target_color: &TargetColor) -> SearchRequest {
        let library = &painting.library;
        let conditions = self.conditions(painting);
        let target = target_color.match_target(library.grid, &conditions);
        let film = RecipeLimits::usual_film(library, painting.ground_reflectance.to_vec());
        let mut limits = RecipeLimits::new(library, conditions, film);
        if !self.whole_library {
            limits.allowed = painting.slots.iter().copied().flatten().collect();
            limits.allowed.sort_unstable();
            limits.allowed.dedup();
        }
        limits.whole_parts = Some(self.parts);
        // The minimum share must allow a pigment with a single part.
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

    /// Draws the limits. Returns whether you changed one.
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

const PATCH: Vec2 = vec2(72.0, 40.0);

/// A found recipe, and the colour to compare it with.
#[derive(Debug, Clone, Copy)]
pub(super) struct FoundRecipe<'a> {
    pub(super) number: usize,
    pub(super) library: &'a PigmentLibrary,
    pub(super) recipe: &'a RecipeMatch,
    /// White point of the search's light.
    pub(super) white: Xyz,
    /// Target colour in encoded sRGB.
    pub(super) target: Rgb,
}

impl FoundRecipe<'_> {
    /// Draws the recipe beside the target colour, with its buttons.
    pub(super) fn show(&self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let Self { number, recipe: found, white, target, .. } = *self;
        ui.separator();
        ui.horizontal_top(|ui| {
            ui.vertical(|ui| {
                ui.set_width(PATCH.x);
                let colors = [target, screen_rgb(found.lab[0], white)];
                let patch = swatch(ui, &tr_format!("Colour {number}", number), PATCH, &colors);
                patch.on_hover_text(tr("Left: target colour; right: colour of the recipe"));
                match_quality(ui, found);
            });
            ui.vertical(|ui| {
                ui.spacing_mut().item_spacing.y = 2.0;
                ui.spacing_mut().interact_size.y = 16_f32.max(theme::target(ui));
                self.amounts().enumerate().for_each(|(at, (name, amount))| {
                    self.line(ui, cx, self.recipe.shares.parts()[at].0, name, amount);
                });
            });
        });
        let missing = self.missing(cx);
        let ready = missing.is_empty();
        ui.horizontal(|ui| {
            let load = ui.add_enabled(ready, Button::new(tr("Load brush")));
            let load = load.accessible_name(tr_format!("Load recipe {number}", number));
            let load = load
                .on_hover_text(tr("Adds this paint to the selected brush, as a tube does"))
                .on_disabled_hover_text(tr("Some of its pigments are not on the palette"));
            if load.clicked() {
                let vehicle = cx.tools.vehicle;
                cx.load(self.parts(), vehicle);
            }
            let lay = ui.add_enabled(ready, Button::new(tr("Lay on palette")));
            let lay = lay.accessible_name(tr_format!("Lay recipe {number}", number));
            let lay = lay
                .on_hover_text(tr("Puts this paint on a free place of the palette"))
                .on_disabled_hover_text(tr("Some of its pigments are not on the palette"));
            if lay.clicked() {
                let vehicle = cx.tools.vehicle;
                lay_on_palette(cx, self.parts(), vehicle);
            }
            let kept =
                ui.button(tr("Keep")).accessible_name(tr_format!("Keep recipe {number}", number));
            if kept.on_hover_text(tr("Keeps this mixture in the panel Swatches")).clicked() {
                let vehicle = cx.tools.vehicle;
                keep(cx, self.parts(), vehicle);
            }
        });
        if !ready {
            let count = missing.len();
            let of = found.shares.len();
            ui.weak(match count {
                1 => tr_format!("1 of {of} pigments is not on the palette", of),
                _ => tr_format!("{count} of {of} pigments are not on the palette", count, of),
            });
        }
    }

    /// Draws a pigment with its amount, and a button to add it to the palette if it is
    /// missing.
    fn line(
        &self,
        ui: &mut Ui,
        cx: &mut PanelContext<'_>,
        pigment: PigmentId,
        name: &str,
        amount: f64,
    ) {
        let is_on_palette = cx.painting.slots.contains(&Some(pigment));
        ui.horizontal(|ui| {
            ui.monospace(format!("{amount:>2}"));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if !is_on_palette {
                    self.add_button(ui, cx, pigment);
                }
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                    ui.add(Label::new(name).wrap());
                });
            });
        });
    }

    /// Name and amount of each pigment: whole parts, or shares rounded to 0.001.
    fn amounts(&self) -> impl Iterator<Item = (&str, f64)> {
        let Self { recipe, library, .. } = self;
        recipe.shares.iter().enumerate().map(|(at, &(pigment, share))| {
            let amount = match &recipe.parts {
                Some(parts) => f64::from(parts[at]),
                None => (1000.0 * share).round() / 1000.0,
            };
            (library[pigment].name.as_str(), amount)
        })
    }

    fn parts(&self) -> Parts {
        self.amounts().map(|(name, amount)| (name.to_owned(), amount)).collect()
    }

    /// Pigments of the recipe that are not on the palette.
    fn missing(&self, cx: &PanelContext<'_>) -> Vec<PigmentId> {
        let slots = &cx.painting.slots;
        self.recipe.shares.pigments().filter(|&pigment| !slots.contains(&Some(pigment))).collect()
    }

    /// Draws a button that adds `pigment` to the palette. If this is full, you choose a pigment to
    /// replace in a menu.
    fn add_button(&self, ui: &mut Ui, cx: &mut PanelContext<'_>, pigment: PigmentId) {
        let name = &self.library[pigment].name;
        let on_palette: Vec<PigmentId> = cx.painting.slots.iter().copied().flatten().collect();
        if on_palette.len() < SLOTS {
            let add =
                ui.add(small_button(ui, tr("Add"))).accessible_name(tr_format!("Add {name}", name));
            let hover =
                tr_format!("{name} is not on the palette. Click to put a tube of it there", name);
            if add.on_hover_text(hover).clicked() {
                self.set_palette(cx, on_palette.iter().copied().chain([pigment]));
            }
            return;
        }
        let menu = ui.menu_button(tr("For\u{2026}"), |ui| {
            for &other in on_palette.iter().filter(|&&other| !self.uses(other)) {
                let line = ui.button(&self.library[other].name);
                let hover = tr("Replaces it, unless wet paint of it is left");
                if line.on_hover_text(hover).clicked() {
                    let all =
                        on_palette.iter().map(|&one| if one == other { pigment } else { one });
                    self.set_palette(cx, all);
                    ui.close();
                }
            }
        });
        let menu = menu.response.accessible_name(tr_format!("{name} in place of", name));
        menu.on_hover_text(tr_format!(
            "{name} is not on the palette, which is full: choose a pigment to replace",
            name
        ));
    }

    fn uses(&self, pigment: PigmentId) -> bool {
        self.recipe.shares.pigments().any(|used| used == pigment)
    }

    fn set_palette(&self, cx: &mut PanelContext<'_>, pigments: impl Iterator<Item = PigmentId>) {
        cx.command(Command::Apply(Action::Palette(PaletteSpec::from_names(
            pigments.map(|pigment: PigmentId| self.library[pigment].name.as_str()),
        ))));
    }
}

/// Draws the colour difference of a recipe and the thickness of its film.
fn match_quality(ui: &mut Ui, found: &RecipeMatch) {
    let differences: Vec<String> =
        found.delta_e.iter().map(|difference| format!("{difference:.2}")).collect();
    ui.label(format!("\u{2206}E {}", differences.join(", "))).on_hover_text(
        tr("CIEDE2000 difference from the target: below 1 is hardly visible; above 5 these pigments do \
         not reach the colour"),
    );
    if let Some(thickness) = found.thickness {
        let thickness = ui.weak(tr_format!("film {thickness:.3}", thickness));
        thickness.on_hover_text(tr("Thickness of the film in units of the library"));
    }
}
