//! Which pigments are on the palette.

use eframe::egui::{Align, Context, Sense, TextStyle, Ui, Window, vec2};
use render::layer::SLOTS;
use render::paint::strokes::{Action, PaletteSpec};

use crate::panels::controls::{back, button, patch, text};
use crate::panels::pigments::{Catalogue, PigmentList};
use crate::panels::{Desk, FileRequest};
use crate::theme;

/// The window that puts pigments of the library into the eight slots.
#[derive(Debug, Clone, Default)]
pub(super) struct Chooser {
    open: bool,
    slot: usize,
    list: PigmentList,
}

impl Chooser {
    /// Opens it for a slot.
    pub(super) fn open(&mut self, slot: usize) {
        *self = Self { open: true, slot, list: PigmentList::default() };
    }

    /// Shows the window, if it is open.
    pub(super) fn show(&mut self, context: &Context, catalogue: &Catalogue, desk: &mut Desk<'_>) {
        let mut open = self.open;
        let window = Window::new("Choose tubes").open(&mut open);
        let window = window.resizable(false).collapsible(false).default_width(400.0);
        window.show(context, |ui| self.ask(ui, catalogue, desk));
        self.open = open;
    }

    fn ask(&mut self, ui: &mut Ui, catalogue: &Catalogue, desk: &mut Desk<'_>) {
        ui.horizontal(|ui| {
            for slot in 0..SLOTS {
                self.slot(ui, catalogue, desk.easel.slots[slot], slot);
            }
        });
        ui.horizontal(|ui| {
            let held = desk.easel.slots[self.slot];
            let words = held.map_or("empty", |pigment| catalogue.name(pigment));
            ui.label(format!("Slot {}: {words}", self.slot + 1));
            let hindered = match held {
                None => Some("the slot is empty"),
                Some(_) if desk.easel.slots.iter().flatten().count() == 1 => {
                    Some("a palette has one pigment at least")
                }
                Some(_) => None,
            };
            let tip = "Empties the slot; paint of it must not be wet any more";
            if button(ui, "Take off", tip, hindered) {
                put(desk, self.slot, None);
            }
        });
        ui.separator();
        ui.horizontal(|ui| {
            ui.label(&catalogue.library.title);
            let tip = "Opens a pigment library or a painting with its own";
            if button(ui, "Open another library...", tip, None) {
                desk.file(FileRequest::Open(None));
            }
        });
        let slots = desk.easel.slots;
        let scattering = desk.easel.medium.scattering_per_mm;
        let chosen = self.list.show(ui, catalogue, scattering, |pigment| {
            let slot = slots.iter().position(|&held| held == Some(pigment))?;
            Some(format!("it is in slot {} already", slot + 1))
        });
        if let Some(pigment) = chosen {
            put(desk, self.slot, Some(pigment));
        }
    }

    fn slot(&mut self, ui: &mut Ui, catalogue: &Catalogue, held: Option<usize>, slot: usize) {
        let (rect, response) = ui.allocate_exact_size(vec2(42.0, 42.0), Sense::click());
        back(ui, &response, &format!("slot {}", slot + 1), slot == self.slot);
        let (upper, lower) = rect.shrink(5.0).split_top_bottom_at_fraction(0.6);
        let color = held.map(|pigment| catalogue.look(pigment).masstone_srgb);
        patch(ui.painter(), upper, color);
        let number = (slot + 1).to_string();
        text(ui, lower, Align::Center, TextStyle::Small, theme::TEXT, &number);
        if response.clicked() {
            self.slot = slot;
        }
        let name = held.map_or("empty", |pigment| catalogue.name(pigment));
        response.on_hover_text(format!("{name}: choose what this slot holds"));
    }
}

/// Asks for the palette with another pigment in a slot, or none; all others stay.
fn put(desk: &mut Desk<'_>, slot: usize, pigment: Option<usize>) {
    let mut slots = desk.easel.slots;
    slots[slot] = pigment;
    let pigments = &desk.easel.library.pigments;
    let names = slots.iter().flatten().map(|&pigment| pigments[pigment].name.as_str());
    desk.act(Action::Palette(PaletteSpec::from_names(names)));
}
