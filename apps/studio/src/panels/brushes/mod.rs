//! The brush panel: list of brushes, head shape and size. You load, wipe and wash the selected
//! brush here.

pub(super) mod row;

use eframe::egui::{Key, Sense, Slider, Ui, Vec2, vec2};
use session::brushes::{BrushOptions, BrushPreset, PresetLoad};
use session::{BrushState, Command, PaintingState};

use crate::keymap::hint;
use crate::language::{tr, tr_format};
use crate::panels::context::keep;
use crate::panels::controls::{button, button_background, buttons_fit, item, percent, slider};
use crate::panels::{Mode, PanelContext, tubes};
use crate::theme;
use paint::brush::HeadShape;
use paint::strokes::{Action, BrushSpec, Load, Recipe};
use row::{Row, TipPreview};

/// State of the brush panel: the brush list, and the head and paint of the selected
/// brush.
#[derive(Debug, Clone, Default)]
pub struct Brushes {
    list: BrushList,
    /// Size in mm while you drag its slider.
    dragged_mm: Option<f64>,
    /// Name of the brush that you rename, and the text typed so far.
    renaming: Option<(String, String)>,
    tip: TipPreview,
}

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
        if row::show_swatch(ui, selected(cx), !row::has_settings(cx.tools.mode)) {
            keep_mixture(cx);
        }
        row::show(ui, cx);
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

    /// Scales the selected brush by a factor. The mean of its paint stays.
    pub fn resize(&mut self, factor: f64, cx: &mut PanelContext<'_>) {
        self.list.synchronize(cx);
        let Some(spec) = self.list.spec(cx.painting, &cx.tools.brush) else { return };
        self.set_size(spec.size_mm * factor, cx);
    }

    /// Sets the width of the selected brush, within the range of sizes. The mean of its paint
    /// stays.
    pub fn set_size(&mut self, size_mm: f64, cx: &mut PanelContext<'_>) {
        self.list.synchronize(cx);
        let Some(spec) = self.list.spec(cx.painting, &cx.tools.brush) else { return };
        let size_mm = rounded(size_mm).clamp(*SIZES_MM.start(), *SIZES_MM.end());
        self.list.replace_head(BrushSpec { size_mm, ..spec }, cx);
    }

    /// Head of the selected brush, with changes that the worker has not confirmed yet.
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
            // This is narrower than their share, because rounding would wrap the last one.
            let [quarter, eighth] =
                [4.0, 8.0].map(|count: f32| ((ui.available_width() + gap) / count - gap).floor());
            let width = if eighth < theme::target(ui) { quarter } else { eighth };
            for shape in HeadShape::ALL {
                let size = vec2(width, 44.0);
                let (rect, response) = ui.allocate_exact_size(size, Sense::click());
                button_background(
                    ui,
                    &response,
                    &tr_format!("shape {shape}", shape = tr(shape.name())),
                    shape == spec.shape,
                );
                row::draw(ui.painter(), rect.shrink(3.0), shape, None);
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
                // The buttons wrap in pairs, so that none stands alone.
                ui.horizontal_wrapped(|ui| load_buttons(ui, cx, none));
                ui.horizontal_wrapped(|ui| clean_buttons(ui, cx, none));
            }
        });
    }

    /// Label of a brush in the list; its name if it is not there.
    #[must_use]
    pub fn label<'a>(&'a self, name: &'a str) -> &'a str {
        self.list.position(name).map_or(name, |at| &self.list.brushes[at].label)
    }

    /// Takes a brush of your own sets in hand. If the list has a brush of this name, that brush
    /// gets the head of `preset`. If not, this adds a new brush. If `preset` has paint, we wash the
    /// brush and load it with this paint. Returns the brush's name in the painting.
    pub fn take(&mut self, preset: &BrushPreset, cx: &mut PanelContext<'_>) -> String {
        self.list.synchronize(cx);
        match self.list.position(&preset.name) {
            Some(at) => {
                self.list.select(at, cx);
                self.list.replace_head(preset.brush.clone(), cx);
            }
            None => self.list.add(&preset.name, preset.brush.clone(), cx),
        }
        let name = cx.tools.brush.clone();
        if let Some(load) = &preset.load {
            (cx.tools.vehicle, cx.tools.load_mm) = (load.vehicle, load.amount_mm);
            if let Some(load) = load.for_brush(&name) {
                // We want the kept paint alone, without the paint on the brush before.
                wash(cx);
                cx.act(Action::Load(load));
            }
        }
        name
    }

    /// The brush in hand with these options, as a preset. If `with_paint` is true, it includes the
    /// paint on the brush. `None` if there is no brush.
    pub fn kept(
        &mut self,
        options: BrushOptions,
        with_paint: bool,
        cx: &mut PanelContext<'_>,
    ) -> Option<BrushPreset> {
        self.list.synchronize(cx);
        let at = self.list.position(&cx.tools.brush)?;
        let name = self.list.brushes[at].label.clone();
        let brush = self.list.spec(cx.painting, &cx.tools.brush)?;
        let paint = selected(cx).filter(|_| with_paint).and_then(|brush| load_matching(cx, brush));
        let load = paint.map(|paint| PresetLoad {
            recipe: paint.recipe,
            vehicle: paint.vehicle,
            amount_mm: paint.amount_mm,
        });
        Some(BrushPreset { name, brush, options, load })
    }
}

/// Draws the buttons that load the selected brush. `none` explains why there is no brush.
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

/// Draws the buttons that clean the selected brush. `none` explains why there is no brush.
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

fn rounded(size_mm: f64) -> f64 {
    let steps = if size_mm < 1.0 { 100.0 } else { 10.0 };
    (size_mm * steps).round() / steps
}

/// Range of head sizes, in mm.
const SIZES_MM: std::ops::RangeInclusive<f64> = 0.2..=100.0;

#[derive(Debug, Clone, PartialEq)]
struct ListedBrush {
    name: String,
    /// Label that you see.
    label: String,
    /// Requested head that the worker has not reported yet.
    requested: Option<RequestedHead>,
}

#[derive(Debug, Clone, PartialEq)]
struct RequestedHead {
    spec: BrushSpec,
    paint: Option<Load>,
}

/// Brushes in the panel. If you remove one, it stays in the painting, because the recording may
/// name it.
#[derive(Debug, Clone, Default, PartialEq)]
struct BrushList {
    brushes: Vec<ListedBrush>,
    removed: Vec<String>,
}

impl BrushList {
    /// Updates the list from the reported state: appends new brushes, drops missing ones, and
    /// ensures that the selected brush is in the list.
    fn synchronize(&mut self, cx: &mut PanelContext<'_>) {
        let reported = |name: &str| cx.painting.brushes.iter().find(|brush| brush.name == name);
        for entry in &mut self.brushes {
            let confirmed = entry.requested.as_ref().is_some_and(|requested| {
                reported(&entry.name).is_some_and(|brush| {
                    brush.spec == requested.spec
                        && (requested.paint.is_none() || brush.amount_mm > 0.0)
                })
            });
            if confirmed {
                entry.requested = None;
            }
        }
        self.brushes.retain(|entry| entry.requested.is_some() || reported(&entry.name).is_some());
        self.removed.retain(|name| reported(name).is_some());
        let mut new: Vec<&BrushState> = cx
            .painting
            .brushes
            .iter()
            .filter(|brush| {
                !self.removed.contains(&brush.name) && self.position(&brush.name).is_none()
            })
            .collect();
        // In the order of the shapes, from round to knife.
        new.sort_by_key(|brush| HeadShape::ALL.iter().position(|s| *s == brush.spec.shape));
        for BrushState { name, .. } in new {
            self.brushes.push(ListedBrush {
                name: name.clone(),
                label: name.clone(),
                requested: None,
            });
        }
        if self.position(&cx.tools.brush).is_none()
            && let Some(first) = self.brushes.first()
        {
            cx.tools.brush.clone_from(&first.name);
        }
    }

    fn position(&self, name: &str) -> Option<usize> {
        self.brushes.iter().position(|entry| entry.name == name)
    }

    /// Head of a brush, with changes that the worker has not confirmed yet.
    fn spec(&self, painting: &PaintingState, name: &str) -> Option<BrushSpec> {
        let requested =
            self.position(name).and_then(|entry| self.brushes[entry].requested.as_ref());
        requested.map(|requested| requested.spec.clone()).or_else(|| {
            Some(painting.brushes.iter().find(|brush| brush.name == name)?.spec.clone())
        })
    }

    /// Selects a brush, and the paint tool unless another tool with a head is in use.
    fn select(&self, entry: usize, cx: &mut PanelContext<'_>) {
        if let Some(entry) = self.brushes.get(entry) {
            cx.tools.brush.clone_from(&entry.name);
            if !cx.tools.mode.moves_head() {
                cx.tools.mode = Mode::Paint;
            }
        }
    }

    /// Adds a new, clean brush after the selected one and selects it. Its name is `base`, with a
    /// number if this exists.
    fn add(&mut self, base: &str, spec: BrushSpec, cx: &mut PanelContext<'_>) {
        let name = self.free_name(base, cx.painting);
        let after = self.position(&cx.tools.brush).map_or(self.brushes.len(), |entry| entry + 1);
        let requested = Some(RequestedHead { spec: spec.clone(), paint: None });
        self.brushes
            .insert(after, ListedBrush { name: name.clone(), label: name.clone(), requested });
        cx.command(Command::SetBrush { name, spec });
        self.select(after, cx);
    }

    /// Adds a clean copy of the selected brush and selects it; the original keeps its
    /// paint.
    fn duplicate(&mut self, cx: &mut PanelContext<'_>) {
        let kept = cx.tools.brush.clone();
        if let Some(spec) = self.spec(cx.painting, &kept) {
            self.add(&kept, spec, cx);
        }
    }

    /// Removes a brush from the list. If you had selected it, this selects its neighbour.
    fn remove(&mut self, index: usize, cx: &mut PanelContext<'_>) {
        let removed = self.brushes.remove(index);
        if removed.name == cx.tools.brush && !self.brushes.is_empty() {
            let next = index.min(self.brushes.len() - 1);
            cx.tools.brush.clone_from(&self.brushes[next].name);
        }
        self.removed.push(removed.name);
    }

    /// Replaces the head of the selected brush. The mean of its paint stays.
    fn replace_head(&mut self, spec: BrushSpec, cx: &mut PanelContext<'_>) {
        let Some(entry) = self.position(&cx.tools.brush) else { return };
        if self.spec(cx.painting, &cx.tools.brush).as_ref() == Some(&spec) {
            return;
        }
        let name = cx.tools.brush.clone();
        self.follow_shape(entry, spec.shape, cx.painting);
        // This is a second request before the worker reported, so we keep the paint of the first.
        let before = self.brushes[entry].requested.take();
        let paint = match before {
            Some(requested) => requested.paint,
            None => selected(cx).and_then(|brush| load_matching(cx, brush)),
        };
        self.brushes[entry].requested =
            Some(RequestedHead { spec: spec.clone(), paint: paint.clone() });
        cx.command(Command::SetBrush { name, spec });
        if let Some(paint) = paint {
            cx.act(Action::Load(paint));
        }
    }

    /// Labels a brush by its new shape, unless you have renamed it.
    fn follow_shape(&mut self, entry: usize, shape: HeadShape, painting: &PaintingState) {
        let label = stem(&self.brushes[entry].label);
        let is_shape = HeadShape::ALL.iter().any(|known| known.name() == label);
        if is_shape && label != shape.name() {
            self.brushes[entry].label = self.free_name(shape.name(), painting);
        }
    }

    /// A name that is free both as name and as label, e.g. `flat` or `flat 2`.
    fn free_name(&self, base: &str, painting: &PaintingState) -> String {
        let stem = stem(base);
        let numbered = (2..).map(|number| format!("{stem} {number}"));
        let mut names = std::iter::once(stem.to_owned()).chain(numbered);
        let free = names.find(|name| {
            !self.brushes.iter().any(|entry| entry.name == *name || entry.label == *name)
                && !painting.brushes.iter().any(|brush| brush.name == *name)
        });
        free.expect("there is always a free number")
    }
}

/// A name without its number.
fn stem(name: &str) -> &str {
    match name.rsplit_once(' ') {
        Some((stem, number)) if number.parse::<u32>().is_ok() => stem,
        _ => name,
    }
}

/// Loads the selected brush with clear medium only and selects the paint tool.
pub fn load_medium(cx: &mut PanelContext<'_>) {
    cx.load(Recipe::new(), 1.0);
}

/// Wipes the selected brush if it holds paint.
pub fn wipe(cx: &mut PanelContext<'_>) {
    if is_loaded(cx) {
        let brush = cx.tools.brush.clone();
        let keep = cx.tools.wipe_keep;
        cx.act(Action::Wipe { brush, keep });
    }
}

/// Washes the selected brush if it holds paint.
pub fn wash(cx: &mut PanelContext<'_>) {
    if is_loaded(cx) {
        let brush = cx.tools.brush.clone();
        cx.act(Action::Wash { brush });
    }
}

fn selected<'a>(cx: &PanelContext<'a>) -> Option<&'a BrushState> {
    cx.painting.brushes.iter().find(|brush| brush.name == cx.tools.brush)
}

fn is_loaded(cx: &PanelContext<'_>) -> bool {
    selected(cx).is_some_and(|brush| brush.amount_mm > 0.0)
}

/// Adds the paint on the selected brush to the kept mixtures.
fn keep_mixture(cx: &mut PanelContext<'_>) {
    let Some(brush) = selected(cx) else { return };
    // Four digits are as fine as you can divide paint with a knife.
    let rounded = recipe(cx, brush).into_iter().map(|(name, part)| (name, round(part)));
    let parts = rounded.filter(|(_, part)| *part > 0.0).collect();
    let vehicle = round(brush.vehicle);
    keep(cx, parts, vehicle);
}

fn round(share: f64) -> f64 {
    (1e4 * share).round() / 1e4
}

/// Pigments on a brush and their parts.
fn recipe(cx: &PanelContext<'_>, brush: &BrushState) -> Recipe {
    let library = &cx.painting.library;
    let parts = cx.painting.slots.iter().zip(brush.parts);
    let parts = parts.filter(|(_, part)| *part > 0.0);
    parts.filter_map(|(slot, part)| Some((library[(*slot)?].name.clone(), part))).collect()
}

/// Load action that reproduces the mean paint of a brush; `None` for a clean brush.
fn load_matching(cx: &PanelContext<'_>, brush: &BrushState) -> Option<Load> {
    if brush.amount_mm <= 0.0 {
        return None;
    }
    let recipe = recipe(cx, brush);
    // Paint without any pigment is clear medium.
    let vehicle = if recipe.is_empty() { 1.0 } else { brush.vehicle };
    Some(Load { brush: brush.name.clone(), recipe, vehicle, amount_mm: brush.amount_mm })
}
