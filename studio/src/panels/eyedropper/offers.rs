//! Recipes that were found, one click from brush and palette.

use std::f64::consts::TAU;

use eframe::egui::{Align, Button, Label, Layout, Ui, Vec2, vec2};
use pigment::library::PigmentLibrary;
use pigment::matching::Recipe;
use render::layer::SLOTS;
use render::paint::strokes::{Action, Load, PaletteSpec, Recipe as Parts};
use spectra::color::{Rgb, Xyz};

use super::super::desk::Desk;
use super::swatch::swatch;
use super::wanted::shown;
use crate::view::Outline;
use session::{Command, PaintingState};

/// The two colours beside each other, in points.
const PATCH: Vec2 = vec2(72.0, 40.0);

/// How far a heap is kept from other paint, over the cube root of its volume: its
/// radius is 0.94 (`Painting::squeeze`).
const REACH: f64 = 1.2;

/// A recipe found, with what it is compared to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Offer<'a> {
    /// Counted from 1.
    pub(super) number: usize,
    /// The pigments it names.
    pub(super) library: &'a PigmentLibrary,
    /// The recipe.
    pub(super) recipe: &'a Recipe,
    /// The white of the light it was found under.
    pub(super) white: Xyz,
    /// What was wanted, on the screen.
    pub(super) wanted: Rgb,
}

impl Offer<'_> {
    /// Shows the recipe beside what was wanted, with its buttons.
    pub(super) fn show(&self, ui: &mut Ui, desk: &mut Desk<'_>) {
        let Self { number, recipe: found, white, wanted, .. } = *self;
        ui.separator();
        ui.horizontal_top(|ui| {
            ui.vertical(|ui| {
                ui.set_width(PATCH.x);
                let colors = [wanted, shown(found.lab[0], white)];
                let patch = swatch(ui, &format!("Colour {number}"), PATCH, &colors);
                patch.on_hover_text("Left what is wanted, right what the recipe gives");
                told(ui, found);
            });
            ui.vertical(|ui| {
                ui.spacing_mut().item_spacing.y = 2.0;
                ui.spacing_mut().interact_size.y = 16.0;
                self.amounts().enumerate().for_each(|(at, (name, amount))| {
                    self.line(ui, desk, self.recipe.shares[at].0, name, amount);
                });
            });
        });
        let missing = self.missing(desk);
        let ready = missing.is_empty();
        ui.horizontal(|ui| {
            let load = ui.add_enabled(ready, Button::new("Load the brush"));
            let load = load.accessible_name(format!("Load recipe {number}"));
            let load = load
                .on_hover_text("Washes the brush in hand and puts this paint on it")
                .on_disabled_hover_text("Some of its pigments are not on the palette");
            if load.clicked() {
                self.load(desk);
            }
            let lay = ui.add_enabled(ready, Button::new("Lay on the palette"));
            let lay = lay.accessible_name(format!("Lay recipe {number}"));
            let lay = lay
                .on_hover_text("Puts a heap of this paint on the palette where there is room")
                .on_disabled_hover_text("Some of its pigments are not on the palette");
            if lay.clicked() {
                let (vehicle, volume_mm3) = (desk.tools.vehicle, desk.tools.squeeze_mm3);
                let reach_mm = REACH * volume_mm3.cbrt();
                let places = places(desk.easel, reach_mm);
                let recipe = self.parts();
                desk.command(Command::SqueezeInFreeSpace {
                    recipe,
                    vehicle,
                    volume_mm3,
                    places,
                    reach_mm,
                });
            }
        });
        if !ready {
            let (count, of) = (missing.len(), found.shares.len());
            let are = if count == 1 { "is" } else { "are" };
            ui.weak(format!("{count} of {of} pigments {are} not on the palette"));
        }
    }

    /// A pigment with its amount, and what puts it on the palette if it is not.
    fn line(&self, ui: &mut Ui, desk: &mut Desk<'_>, pigment: usize, name: &str, amount: f64) {
        let is_there = desk.easel.slots.contains(&Some(pigment));
        ui.horizontal(|ui| {
            ui.monospace(format!("{amount:>2}"));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if !is_there {
                    self.put(ui, desk, pigment);
                }
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                    ui.add(Label::new(name).truncate());
                });
            });
        });
    }

    /// Name and amount of each pigment: whole parts, or shares of a thousand.
    fn amounts(&self) -> impl Iterator<Item = (&str, f64)> {
        let Self { recipe, library, .. } = self;
        recipe.shares.iter().enumerate().map(|(at, &(pigment, share))| {
            let amount = match &recipe.parts {
                Some(parts) => f64::from(parts[at]),
                None => (1000.0 * share).round() / 1000.0,
            };
            (library.pigments[pigment].name.as_str(), amount)
        })
    }

    fn parts(&self) -> Parts {
        self.amounts().map(|(name, amount)| (name.to_owned(), amount)).collect()
    }

    fn load(&self, desk: &mut Desk<'_>) {
        let brush = desk.tools.brush.clone();
        let mut brushes = desk.easel.brushes.iter();
        if brushes.any(|one| one.name == brush && one.amount_mm > 0.0) {
            desk.command(Command::Apply(Action::Wash { brush: brush.clone() }));
        }
        let (vehicle, amount_mm) = (desk.tools.vehicle, desk.tools.load_mm);
        let load = Load { brush, recipe: self.parts(), vehicle, amount_mm };
        desk.command(Command::Apply(Action::Load(load)));
    }

    /// Its pigments that are not on the palette.
    fn missing(&self, desk: &Desk<'_>) -> Vec<usize> {
        let slots = &desk.easel.slots;
        let pigments = self.recipe.shares.iter().map(|(pigment, _)| *pigment);
        pigments.filter(|&pigment| !slots.contains(&Some(pigment))).collect()
    }

    /// Puts `pigment` on the palette, if it is full in place of another.
    fn put(&self, ui: &mut Ui, desk: &mut Desk<'_>, pigment: usize) {
        let name = &self.library.pigments[pigment].name;
        let on: Vec<usize> = desk.easel.slots.iter().copied().flatten().collect();
        if on.len() < SLOTS {
            let add = ui.small_button("Add").accessible_name(format!("Add {name}"));
            let hover = format!("{name} is not on the palette. Click to put a tube of it there");
            if add.on_hover_text(hover).clicked() {
                self.ask_palette(desk, on.iter().copied().chain([pigment]));
            }
            return;
        }
        let menu = ui.menu_button("For\u{2026}", |ui| {
            for &other in on.iter().filter(|&&other| !self.uses(other)) {
                let line = ui.button(&self.library.pigments[other].name);
                let hover = "Gives its place up, unless wet paint of it is left";
                if line.on_hover_text(hover).clicked() {
                    let all = on.iter().map(|&one| if one == other { pigment } else { one });
                    self.ask_palette(desk, all);
                    ui.close();
                }
            }
        });
        let menu = menu.response.accessible_name(format!("{name} in place of"));
        menu.on_hover_text(format!(
            "{name} is not on the palette, which is full: choose what it takes the place of"
        ));
    }

    fn uses(&self, pigment: usize) -> bool {
        self.recipe.shares.iter().any(|(used, _)| *used == pigment)
    }

    fn ask_palette(&self, desk: &mut Desk<'_>, pigments: impl Iterator<Item = usize>) {
        let name = |pigment: usize| self.library.pigments[pigment].name.as_str();
        desk.command(Command::Apply(Action::Palette(PaletteSpec::from_names(pigments.map(name)))));
    }
}

/// How far a recipe is from what is wanted, and of which film it is.
fn told(ui: &mut Ui, found: &Recipe) {
    let differences: Vec<String> =
        found.delta_e.iter().map(|difference| format!("{difference:.2}")).collect();
    ui.label(format!("\u{2206}E {}", differences.join(", "))).on_hover_text(
        "CIEDE2000 from what is wanted: below 1 can hardly be seen; above 5 these pigments do \
         not reach the colour",
    );
    if let Some(thickness) = found.thickness {
        let thickness = ui.weak(format!("film {thickness:.3}"));
        thickness.on_hover_text("Thickness of the film in units of the library");
    }
}

/// Places of the palette, in mm, that are on its wood as far as `reach_mm`, row by
/// row from the upper left.
fn places(easel: &PaintingState, reach_mm: f64) -> Vec<[f64; 2]> {
    let cells = easel.palette_cells;
    let (reach, step) = (reach_mm / easel.cell_mm, (reach_mm / easel.cell_mm).max(1.0));
    let along = |size: usize| (size as f64 / step) as usize;
    let rim = |[x, y]: [f64; 2]| {
        let turns = (0..16).map(|turn| f64::from(turn) * TAU / 16.0);
        turns.map(move |turn| [x + reach * turn.cos(), y + reach * turn.sin()])
    };
    let rows = (1..=along(cells.1)).map(|row| row as f64 * step);
    let all = rows.flat_map(|y| (1..=along(cells.0)).map(move |column| [column as f64 * step, y]));
    let on_wood =
        all.filter(|&place| rim(place).all(|place| Outline::Palette.contains(place, cells)));
    on_wood.map(|place| place.map(|cells| cells * easel.cell_mm)).collect()
}
