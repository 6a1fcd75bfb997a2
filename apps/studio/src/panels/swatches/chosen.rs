//! The selected mixture: its recipe, and what can be done with it.

use eframe::egui::{Grid, Key, Ui, vec2};
use paint::layer::SLOTS;
use paint::strokes::{Action, PaletteSpec};
use session::swatches::{KeptMixture, SwatchChange, Usable};

use super::grid::reason;
use crate::files::FileRequest;
use crate::language::{tr, tr_format};
use crate::panels::PanelContext;
use crate::panels::controls::button;
use crate::panels::laying::lay_on_palette;
use crate::theme;

/// Place of a mixture in the list, and of its neighbours among those that are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Place {
    pub(super) index: usize,
    pub(super) before: Option<usize>,
    pub(super) after: Option<usize>,
}

/// Draws the mixture at a place. `typed` is its name while it is changed.
pub(super) fn show(
    ui: &mut Ui,
    cx: &mut PanelContext<'_>,
    Place { index, before, after }: Place,
    kept: &KeptMixture,
    typed: &mut Option<String>,
) {
    name(ui, cx, index, kept, typed);
    let grid = Grid::new("kept parts").num_columns(2).min_row_height(16.0);
    grid.spacing(vec2(8.0, 2.0)).show(ui, |ui| {
        for (name, part) in &kept.recipe {
            ui.monospace(format!("{part:>6}"));
            ui.label(name);
            ui.end_row();
        }
    });
    let medium = tr_format!(
        "{vehicle:.0} % medium; {library}",
        vehicle = 100.0 * kept.vehicle,
        library = kept.library
    );
    ui.weak(medium)
        .on_hover_text(tr("Share of medium in a load, and the library it was kept from"));
    let usable = kept.usable(&cx.painting.library, &cx.painting.slots);
    let reason = reason(cx, &usable);
    ui.horizontal(|ui| {
        let tip = tr("Adds this mixture to the selected brush, as a tube does");
        if button(ui, tr("Load the brush"), tip, reason.as_deref()) {
            cx.load(kept.recipe.clone(), kept.vehicle);
        }
        let tip = tr("Puts this mixture on a free place of the palette");
        if button(ui, tr("Lay on the palette"), tip, reason.as_deref()) {
            lay_on_palette(cx, kept.recipe.clone(), kept.vehicle);
        }
    });
    ui.horizontal(|ui| {
        let mut change = None;
        if button(ui, tr("Rename"), tr("Gives this mixture another name"), None) {
            *typed = Some(kept.name.clone());
        }
        let first = before.is_none().then_some(tr("it is the first"));
        if button(ui, tr("Earlier"), tr("Moves it one place towards the first"), first) {
            change = before.map(|to| SwatchChange::Move(index, to));
        }
        let last = after.is_none().then_some(tr("it is the last"));
        if button(ui, tr("Later"), tr("Moves it one place towards the last"), last) {
            change = after.map(|to| SwatchChange::Move(index, to));
        }
        if button(ui, tr("Forget"), tr("Removes this mixture from the list"), None) {
            change = Some(SwatchChange::Remove(index));
        }
        if let Some(change) = change {
            cx.file(FileRequest::Swatches(change));
        }
    });
    if let Some(reason) = &reason {
        ui.label(reason);
    }
    add_tubes(ui, cx, &usable);
}

/// Draws the name, or the field that changes it.
fn name(
    ui: &mut Ui,
    cx: &mut PanelContext<'_>,
    index: usize,
    kept: &KeptMixture,
    typed: &mut Option<String>,
) {
    let Some(text) = typed else {
        ui.strong(&kept.name);
        return;
    };
    let field = theme::text_field(text).desired_width(f32::INFINITY).char_limit(60);
    let response = ui.add(field).accessible_name(tr("Name of the mixture"));
    let response = response.on_hover_text(tr("Enter accepts the name, Escape cancels"));
    if response.lost_focus() {
        if !ui.input(|input| input.key_pressed(Key::Escape)) {
            cx.file(FileRequest::Swatches(SwatchChange::Rename(index, text.clone())));
        }
        *typed = None;
    } else if !response.has_focus() {
        response.request_focus();
    }
}

/// Offers to put the tubes that are missing on the palette, if there is room.
fn add_tubes(ui: &mut Ui, cx: &mut PanelContext<'_>, usable: &Usable) {
    let Usable::NotOnPalette(away) = usable else { return };
    let held: Vec<_> = cx.painting.slots.iter().copied().flatten().collect();
    let full = held.len() + away.len() > SLOTS;
    let reason = full.then_some(tr("the palette has no room for them: replace tubes first"));
    let tip = tr("Puts the tubes that this mixture needs on the palette");
    if button(ui, tr("Add its tubes"), tip, reason) {
        let all = held.iter().chain(away);
        let names = all.map(|&pigment| cx.painting.library[pigment].name.as_str());
        let palette = PaletteSpec::from_names(names);
        cx.act(Action::Palette(palette));
    }
}
