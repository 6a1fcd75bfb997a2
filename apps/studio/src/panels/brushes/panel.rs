//! Draws the brush panel.

use eframe::egui::{Key, Sense, Slider, Ui, Vec2, vec2};
use paint::brush::HeadShape;
use paint::strokes::BrushSpec;

use super::head;
use super::list::{BrushList, SIZES_MM};
use super::paint::{is_loaded, keep_mixture, load_medium, selected, wash, wipe};
use super::row::Row;
use super::swatch;
use super::tip::TipPreview;
use super::tool;
use crate::keymap::hint;
use crate::language::{tr, tr_format};
use crate::panels::controls::{button, button_background, buttons_fit, item, percent, slider};
use crate::panels::{PanelContext, tubes};
use crate::theme;

/// State of the brush panel: the brush list, and the head and paint of the selected
/// brush.
#[derive(Debug, Clone, Default)]
pub struct Brushes {
    pub(super) list: BrushList,
    /// Size while its slider is dragged, in mm.
    dragged_mm: Option<f64>,
    /// Name of the brush being renamed, and the text typed so far.
    renaming: Option<(String, String)>,
    tip: TipPreview,
}

/// Request of a row or of the buttons below the list.
enum ListRequest {
    Select(usize),
    Duplicate,
    Rename(usize),
    Remove(usize),
}

impl Brushes {
    /// Draws the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        self.list.synchronize(cx);
        if swatch::show(ui, selected(cx), !tool::has_settings(cx.tools.mode)) {
            keep_mixture(cx);
        }
        tool::show(ui, cx);
        ui.separator();
        self.brush_list(ui, cx);
        ui.separator();
        self.head(ui, cx);
        ui.separator();
        self.paint(ui, cx);
    }

    /// Selects the brush of a number key, from 1. Returns whether it exists.
    pub fn choose(&mut self, number: usize, cx: &mut PanelContext<'_>) -> bool {
        self.list.synchronize(cx);
        let exists = (1..=self.list.brushes.len()).contains(&number);
        if exists {
            self.list.select(number - 1, cx);
        }
        exists
    }

    /// Scales the selected brush by a factor. It keeps the mean of its paint.
    pub fn resize(&mut self, factor: f64, cx: &mut PanelContext<'_>) {
        self.list.synchronize(cx);
        let Some(spec) = self.list.spec(cx.painting, &cx.tools.brush) else { return };
        self.set_size(spec.size_mm * factor, cx);
    }

    /// Makes the selected brush as wide as `size_mm`, within the range of sizes. It keeps the mean
    /// of its paint.
    pub fn set_size(&mut self, size_mm: f64, cx: &mut PanelContext<'_>) {
        self.list.synchronize(cx);
        let Some(spec) = self.list.spec(cx.painting, &cx.tools.brush) else { return };
        let size_mm = rounded(size_mm).clamp(*SIZES_MM.start(), *SIZES_MM.end());
        self.list.replace_head(BrushSpec { size_mm, ..spec }, cx);
    }

    /// Head of the selected brush, including a requested change that is not confirmed
    /// yet.
    #[must_use]
    pub fn selected(&self, cx: &PanelContext<'_>) -> Option<BrushSpec> {
        self.list.spec(cx.painting, &cx.tools.brush)
    }

    fn brush_list(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let mut request = None;
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            for index in 0..self.list.brushes.len() {
                let name = self.list.brushes[index].name.clone();
                if self.renaming.as_ref().is_some_and(|(renamed, _)| *renamed == name) {
                    self.rename(ui, index);
                } else if let Some(done) = self.row(ui, cx, index) {
                    request = Some(done);
                }
            }
        });
        let selected = self.list.position(&cx.tools.brush);
        let none = selected.is_none().then_some(tr("no brush is selected"));
        ui.horizontal_wrapped(|ui| {
            let add = ui.menu_button(tr("Add"), |ui| self.add(ui, cx));
            add.response.on_hover_text(tr("Adds a clean brush to the list"));
            let tip = tr("Keeps this brush with its paint and selects a clean copy");
            if button(ui, tr("Keep"), tip, none) {
                request = Some(ListRequest::Duplicate);
            }
            if button(ui, tr("Rename"), tr("Renames this brush in the list"), none) {
                request = selected.map(ListRequest::Rename);
            }
            let last =
                (self.list.brushes.len() < 2).then_some(tr("the last brush cannot be removed"));
            let tip = tr("Removes this brush from the list");
            if button(ui, tr("Remove"), tip, none.or(last)) {
                request = selected.map(ListRequest::Remove);
            }
        });
        match request {
            Some(ListRequest::Select(index)) => self.list.select(index, cx),
            Some(ListRequest::Duplicate) => self.list.duplicate(cx),
            Some(ListRequest::Remove(index)) => self.list.remove(index, cx),
            Some(ListRequest::Rename(index)) => {
                let brush = &self.list.brushes[index];
                self.renaming = Some((brush.name.clone(), brush.label.clone()));
            }
            None => {}
        }
    }

    fn row(&self, ui: &mut Ui, cx: &PanelContext<'_>, index: usize) -> Option<ListRequest> {
        let brush = &self.list.brushes[index];
        let spec = self.list.spec(cx.painting, &brush.name)?;
        let state = cx.painting.brushes.iter().find(|state| state.name == brush.name);
        let is_selected = cx.tools.brush == brush.name;
        let shown = Row { number: index + 1, label: &brush.label, spec: &spec, state, is_selected };
        let response = shown.show(ui, cx.painting);
        let mut request = response.clicked().then_some(ListRequest::Select(index));
        response.context_menu(|ui| {
            if item(ui, tr("Rename"), tr("Renames this brush in the list"), None) {
                request = Some(ListRequest::Rename(index));
            }
            let last =
                (self.list.brushes.len() < 2).then_some(tr("the last brush cannot be removed"));
            if item(ui, tr("Remove"), tr("Removes this brush from the list"), last) {
                request = Some(ListRequest::Remove(index));
            }
        });
        request
    }

    fn rename(&mut self, ui: &mut Ui, index: usize) {
        let Some((_, typed)) = &mut self.renaming else { return };
        let response = ui
            .add(theme::text_field(typed).desired_width(f32::INFINITY).char_limit(40))
            .accessible_name(tr("Name of the brush"))
            .on_hover_text(tr("Enter accepts the name, Escape cancels"));
        let (enter, escape) =
            ui.input(|input| (input.key_pressed(Key::Enter), input.key_pressed(Key::Escape)));
        if response.lost_focus() {
            let typed = typed.trim().to_owned();
            if !escape && !typed.is_empty() {
                self.list.brushes[index].label = typed;
            }
            self.renaming = None;
        } else if !response.has_focus() && !enter {
            response.request_focus();
        }
    }

    fn add(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let size_mm = self.selected(cx).map_or(6.0, |spec| spec.size_mm);
        for shape in HeadShape::ALL {
            if item(ui, tr(shape.name()), tr("With the size of the selected brush"), None) {
                self.list.add(shape.name(), BrushSpec { shape, size_mm }, cx);
            }
        }
    }

    fn head(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let Some(spec) = self.selected(cx) else {
            ui.weak(tr("no brush is selected"));
            return;
        };
        ui.horizontal_wrapped(|ui| {
            let gap = if theme::is_touch(ui.ctx()) { 0.0 } else { 2.0 };
            ui.spacing_mut().item_spacing = Vec2::splat(gap);
            // Narrower than their share, so that the last one is not wrapped by rounding.
            let share = |count: f32| ((ui.available_width() + gap) / count - gap).floor();
            let width = if share(8.0) < theme::target(ui) { share(4.0) } else { share(8.0) };
            for shape in HeadShape::ALL {
                let size = vec2(width, 44.0);
                let (rect, response) = ui.allocate_exact_size(size, Sense::click());
                button_background(
                    ui,
                    &response,
                    &tr_format!("shape {shape}", shape = tr(shape.name())),
                    shape == spec.shape,
                );
                head::draw(ui.painter(), rect.shrink(3.0), shape, None);
                if response.clicked() {
                    self.list.replace_head(BrushSpec { shape, ..spec.clone() }, cx);
                }
                response.on_hover_text(tr_format!(
                    "{shape}; the brush keeps the mean of its paint",
                    shape = tr(shape.name())
                ));
            }
        });
        self.tip.show(ui, &spec);
        let mut size_mm = self.dragged_mm.unwrap_or_else(|| rounded(spec.size_mm));
        let cells = size_mm / cx.painting.cell_mm;
        let control = Slider::new(&mut size_mm, SIZES_MM).logarithmic(true).suffix(" mm");
        let control = control.max_decimals(2).update_while_editing(false);
        let keys = ["smaller", "larger"].map(|name| hint(ui.ctx(), name)).concat();
        let tip = tr_format!(
            "Width of the head, {cells:.0} cells of the canvas; the brush keeps the mean of its paint\
             {keys}",
            cells,
            keys
        );
        let response = slider(ui, tr("Size"), &tip, control);
        if response.changed() {
            self.dragged_mm = Some(rounded(size_mm));
        }
        if let Some(size_mm) = self.dragged_mm
            && !response.dragged()
        {
            self.list.replace_head(BrushSpec { size_mm, ..spec }, cx);
            self.dragged_mm = None;
        }
    }

    fn paint(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let none = self.selected(cx).is_none().then_some(tr("no brush is selected"));
        let height = Slider::new(&mut cx.tools.load_mm, 0.02..=2.0).logarithmic(true);
        let tip = tr("Height of paint that one load adds to the head");
        slider(ui, tr("Load"), tip, height.fixed_decimals(2).suffix(" mm"));
        let tip = tr(
            "Share of clear medium in a load: more makes the paint thinner and more transparent. \
             Glazes take 98 to 99.9 %; click the number to type it",
        );
        percent(ui, tr("Medium"), tip, &mut cx.tools.vehicle, 0.0..=100.0);
        let tip = tr("Share of its paint that wiping leaves on the brush");
        percent(ui, tr("Wipe to"), tip, &mut cx.tools.wipe_keep, 0.0..=100.0);
        ui.scope(|ui| {
            if theme::is_touch(ui.ctx()) {
                ui.spacing_mut().button_padding.x = 8.0;
            }
            let names = [tr("Load from tube"), tr("Medium only"), tr("Wipe"), tr("Wash")];
            if buttons_fit(ui, &names) {
                ui.horizontal(|ui| {
                    load_buttons(ui, cx, none);
                    clean_buttons(ui, cx, none);
                });
            } else {
                // In pairs, so that no button stands alone.
                ui.horizontal_wrapped(|ui| load_buttons(ui, cx, none));
                ui.horizontal_wrapped(|ui| clean_buttons(ui, cx, none));
            }
        });
    }
}

/// Draws the buttons that load the selected brush; `none` says why there is no brush.
fn load_buttons(ui: &mut Ui, cx: &mut PanelContext<'_>, none: Option<&str>) {
    let slot = cx.tools.tube;
    let held = cx.painting.slots.get(slot).copied().flatten();
    let empty = held.is_none().then_some(tr("no tube is selected"));
    let name = held.map_or("", |pigment| cx.painting.library[pigment].name.as_str());
    let tip = tr_format!("Adds paint of the selected tube to the brush: {name}", name);
    if button(ui, tr("Load from tube"), &tip, none.or(empty)) {
        tubes::load(cx, slot);
    }
    let tip = tr("Adds clear medium without pigment to the brush");
    if button(ui, tr("Medium only"), tip, none) {
        load_medium(cx);
    }
}

/// Draws the buttons that clean the selected brush; `none` says why there is no brush.
fn clean_buttons(ui: &mut Ui, cx: &mut PanelContext<'_>, none: Option<&str>) {
    let clean = (!is_loaded(cx)).then_some(tr("the brush is clean"));
    let [wipe_key, wash_key] = ["wipe", "wash"].map(|name| hint(ui.ctx(), name));
    let tip = tr_format!("Removes paint with a rag{wipe_key}", wipe_key);
    if button(ui, tr("Wipe"), &tip, none.or(clean)) {
        wipe(cx);
    }
    let tip = tr_format!("Removes all paint{wash_key}", wash_key);
    if button(ui, tr("Wash"), &tip, none.or(clean)) {
        wash(cx);
    }
}

/// Rounds a size in mm to 0.1 mm, below 1 mm to 0.01 mm.
fn rounded(size_mm: f64) -> f64 {
    let steps = if size_mm < 1.0 { 100.0 } else { 10.0 };
    (size_mm * steps).round() / steps
}
