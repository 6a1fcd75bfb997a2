//! The window that chooses the pigments on the palette.

use eframe::egui::{Align, Context, Sense, TextStyle, Ui, vec2};
use paint::layer::SLOTS;
use paint::strokes::{Action, PaletteSpec};
use pigment::PigmentId;

use crate::floating;
use crate::language::{tr, tr_format};
use crate::panels::controls::{button, button_background, patch};
use crate::panels::fitted_text::text;
use crate::panels::pigments::{Catalogue, PigmentList};
use crate::panels::{FileRequest, PanelContext};
use crate::theme;

/// Width of the contents, in points.
const WIDTH: f32 = 400.0;

/// State of the window: selected slot and pigment list.
#[derive(Debug, Clone, Default)]
pub(super) struct Chooser {
    open: bool,
    slot: usize,
    list: PigmentList,
}

impl Chooser {
    /// Opens the window for a slot.
    pub(super) fn open(&mut self, slot: usize) {
        *self = Self { open: true, slot, list: PigmentList::default() };
    }

    /// Draws the window if it is open.
    pub(super) fn show(
        &mut self,
        context: &Context,
        catalogue: &Catalogue,
        cx: &mut PanelContext<'_>,
    ) {
        let mut open = self.open;
        floating::show(context, tr("Choose tubes"), tr("choose tubes"), &mut open, |ui| {
            ui.set_width(WIDTH);
            self.contents(ui, catalogue, cx);
        });
        self.open = open;
    }

    fn contents(&mut self, ui: &mut Ui, catalogue: &Catalogue, cx: &mut PanelContext<'_>) {
        ui.horizontal(|ui| {
            for slot in 0..SLOTS {
                self.slot(ui, catalogue, cx.painting.slots[slot], slot);
            }
        });
        ui.horizontal(|ui| {
            let held = cx.painting.slots[self.slot];
            let name = held.map_or(tr("empty"), |pigment| catalogue.name(pigment));
            ui.label(tr_format!("Slot {slot}: {name}", slot = self.slot + 1, name));
            let disabled_reason = match held {
                None => Some(tr("the slot is empty")),
                Some(_) if cx.painting.slots.iter().flatten().count() == 1 => {
                    Some(tr("the palette needs at least one pigment"))
                }
                Some(_) => None,
            };
            let tip = tr("Empties the slot; there must be no wet paint of it");
            if button(ui, tr("Take off"), tip, disabled_reason) {
                set_slot(cx, self.slot, None);
            }
        });
        ui.separator();
        ui.horizontal(|ui| {
            ui.label(&catalogue.library.title);
            let tip = tr("Opens a pigment library or a painting with its own");
            if button(ui, tr("Open another library..."), tip, None) {
                cx.file(FileRequest::Open(None));
            }
        });
        let slots = cx.painting.slots;
        let scattering = cx.painting.medium.scattering_per_mm;
        let chosen = self.list.show(ui, catalogue, scattering, |pigment| {
            let slot = slots.iter().position(|&held| held == Some(pigment))?;
            Some(tr_format!("it is already in slot {slot}", slot = slot + 1))
        });
        if let Some(pigment) = chosen {
            set_slot(cx, self.slot, Some(pigment));
        }
    }

    fn slot(&mut self, ui: &mut Ui, catalogue: &Catalogue, held: Option<PigmentId>, slot: usize) {
        let (rect, response) =
            ui.allocate_exact_size(theme::at_least(ui, vec2(42.0, 42.0)), Sense::click());
        button_background(
            ui,
            &response,
            &tr_format!("slot {slot}", slot = slot + 1),
            slot == self.slot,
        );
        let (upper, lower) = rect.shrink(5.0).split_top_bottom_at_fraction(0.6);
        let color = held.map(|pigment| catalogue.colors(pigment).masstone_srgb);
        patch(ui.painter(), upper, color);
        let number = (slot + 1).to_string();
        text(ui, lower, Align::Center, TextStyle::Small, theme::colors(ui.ctx()).text, &number);
        if response.clicked() {
            self.slot = slot;
        }
        let name = held.map_or(tr("empty"), |pigment| catalogue.name(pigment));
        response.on_hover_text(tr_format!("{name}: choose the pigment of this slot", name));
    }
}

/// Queues a palette with another pigment in one slot, or none.
fn set_slot(cx: &mut PanelContext<'_>, slot: usize, pigment: Option<PigmentId>) {
    let mut slots = cx.painting.slots;
    slots[slot] = pigment;
    let library = &cx.painting.library;
    let names = slots.iter().flatten().map(|&pigment| library[pigment].name.as_str());
    cx.act(Action::Palette(PaletteSpec::from_names(names)));
}
