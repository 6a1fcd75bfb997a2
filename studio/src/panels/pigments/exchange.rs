//! Exchanging a pigment of what is painted already for another.

use eframe::egui::{ComboBox, Context, Id, Ui, Window};
use render::paint::document::Slots;
use render::paint::strokes::{Action, LayerRef};

use super::catalogue::Catalogue;
use super::list::PigmentList;
use crate::panels::Desk;
use session::PaintingState;

/// Which layers an exchange is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::panels) enum Place {
    /// All that have the pigment.
    Everywhere,
    /// One.
    In(LayerRef),
}

/// The window that asks which pigment, where, and for which.
#[derive(Debug, Clone)]
pub(in crate::panels) struct Exchange {
    open: bool,
    from: usize,
    place: Place,
    list: PigmentList,
}

impl Default for Exchange {
    fn default() -> Self {
        Self { open: false, from: 0, place: Place::Everywhere, list: PigmentList::default() }
    }
}

impl Exchange {
    /// Opens it for a pigment of the library.
    pub(in crate::panels) fn open(&mut self, from: usize, place: Place) {
        *self = Self { open: true, from, place, ..Self::default() };
    }

    /// Shows the window, if it is open.
    pub(in crate::panels) fn show(
        &mut self,
        context: &Context,
        id: &str,
        catalogue: &Catalogue,
        desk: &mut Desk<'_>,
    ) {
        if self.open && !self.fits(desk.easel) {
            self.open = false;
        }
        let mut open = self.open;
        let window = Window::new("Exchange a pigment").id(Id::unique(id)).open(&mut open);
        let window = window.resizable(false).collapsible(false).default_width(380.0);
        let chosen = window.show(context, |ui| self.ask(ui, catalogue, desk.easel));
        self.open = open;
        if let Some(to) = chosen.and_then(|inner| inner.inner).flatten() {
            for layer in layers(desk.easel, self.place, self.from, to) {
                let name = |pigment: usize| catalogue.name(pigment).to_owned();
                desk.act(Action::Swap { layer, from: name(self.from), to: name(to) });
            }
            self.open = false;
        }
    }

    /// Whether layer and pigment are still there.
    fn fits(&self, easel: &PaintingState) -> bool {
        pigments(easel, self.place).contains(&self.from)
    }

    fn ask(&mut self, ui: &mut Ui, catalogue: &Catalogue, easel: &PaintingState) -> Option<usize> {
        ui.horizontal(|ui| {
            ui.label("In");
            let tip = "Which layers the pigment is exchanged in";
            let shown = ComboBox::from_id_salt("place").selected_text(words(self.place));
            let places = shown.show_ui(ui, |ui| {
                for place in all_places(easel) {
                    ui.selectable_value(&mut self.place, place, words(place)).on_hover_text(tip);
                }
            });
            places.response.accessible_name("In").on_hover_text(tip);
            let here = pigments(easel, self.place);
            if !here.contains(&self.from) {
                self.from = here.first().copied().unwrap_or(self.from);
            }
            ui.label("exchange");
            let tip = "The pigment that goes";
            let shown = ComboBox::from_id_salt("from").width(150.0);
            let shown = shown.selected_text(catalogue.name(self.from));
            let from = shown.show_ui(ui, |ui| {
                for pigment in here {
                    let name = catalogue.name(pigment);
                    ui.selectable_value(&mut self.from, pigment, name).on_hover_text(tip);
                }
            });
            from.response.accessible_name("Exchange").on_hover_text(tip);
        });
        ui.label("for");
        let (place, from) = (self.place, self.from);
        self.list.show(ui, catalogue, easel.medium.scattering_per_mm, |to| {
            if to == from {
                Some("it is there already".to_owned())
            } else if layers(easel, place, from, to).is_empty() {
                Some("every layer in question has it already".to_owned())
            } else {
                None
            }
        })
    }
}

/// A layer's name for people; the lowest dry layer is 1.
pub(in crate::panels) fn words(place: Place) -> String {
    match place {
        Place::Everywhere => "all layers".to_owned(),
        Place::In(LayerRef::Wet) => "the wet layer".to_owned(),
        Place::In(LayerRef::Dry(index)) => format!("dry layer {}", index + 1),
    }
}

fn all_places(easel: &PaintingState) -> Vec<Place> {
    let dry = (0..easel.layers.len()).rev().map(|index| Place::In(LayerRef::Dry(index)));
    [Place::Everywhere, Place::In(LayerRef::Wet)].into_iter().chain(dry).collect()
}

fn slots(easel: &PaintingState, layer: LayerRef) -> Slots {
    match layer {
        LayerRef::Wet => easel.slots,
        LayerRef::Dry(index) => easel.layers.get(index).map_or([None; 8], |layer| layer.slots),
    }
}

fn asked_layers(easel: &PaintingState, place: Place) -> Vec<LayerRef> {
    match place {
        Place::In(layer) => vec![layer],
        Place::Everywhere => {
            let dry = (0..easel.layers.len()).map(LayerRef::Dry);
            dry.chain([LayerRef::Wet]).collect()
        }
    }
}

/// The pigments of the layers in question, in order of their slots.
fn pigments(easel: &PaintingState, place: Place) -> Vec<usize> {
    let mut found = Vec::new();
    let layers = asked_layers(easel, place);
    for pigment in layers.into_iter().flat_map(|layer| slots(easel, layer)).flatten() {
        if !found.contains(&pigment) {
            found.push(pigment);
        }
    }
    found
}

/// The layers where `from` can become `to`: those that have the first and lack
/// the second.
fn layers(easel: &PaintingState, place: Place, from: usize, to: usize) -> Vec<LayerRef> {
    let mut found = asked_layers(easel, place);
    found.retain(|&layer| {
        let slots = slots(easel, layer);
        slots.contains(&Some(from)) && !slots.contains(&Some(to))
    });
    found
}
