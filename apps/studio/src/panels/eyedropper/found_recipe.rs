//! A recipe that the search found, with buttons to load the brush and fill the palette.

use pigment::PigmentId;

use eframe::egui::{Align, Button, Label, Layout, Ui, Vec2, vec2};
use paint::layer::SLOTS;
use paint::strokes::{Action, PaletteSpec, Recipe as Parts};
use pigment::library::PigmentLibrary;
use pigment::matching::RecipeMatch;
use spectra::color::{Rgb, Xyz};

use super::super::context::PanelContext;
use super::super::controls::small_button;
use super::super::laying::{keep, lay_on_palette};
use super::swatch::swatch;
use super::target::screen_rgb;
use crate::language::{tr, tr_format};
use crate::theme;
use session::Command;

/// Size of the patch that compares two colours, in points.
const PATCH: Vec2 = vec2(72.0, 40.0);

/// A found recipe and the colour it is compared with.
#[derive(Debug, Clone, Copy)]
pub(super) struct FoundRecipe<'a> {
    /// Rank of the recipe, from 1.
    pub(super) number: usize,
    /// Library of its pigments.
    pub(super) library: &'a PigmentLibrary,
    /// Recipe found by the search.
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

    /// Draws a button that adds `pigment` to the palette, or a menu of pigments to
    /// replace if the palette is full.
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
