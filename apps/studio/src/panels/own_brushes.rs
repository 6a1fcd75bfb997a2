//! The window of own brushes: sets of kept brushes, and a list of which settings of an imported
//! MyPaint brush we could take over.

use eframe::egui::{
    Align, CollapsingHeader, ComboBox, Context, Key, Response, ScrollArea, TextStyle, Ui, vec2,
};
use session::brushes::{BrushOptions, BrushPreset, ImportedBrush};

use crate::files::BrushSets;
use crate::language::{tr, tr_format};
use crate::panels::brushes::row;
use crate::panels::controls::{between, button, millimetres, row, text};
use crate::{floating, theme};

const WIDTH: f32 = 400.0;

/// A request of the window that the sets of brushes alone cannot fulfil.
#[derive(Debug, Clone, PartialEq)]
pub enum OwnBrushRequest {
    /// Takes this brush in hand.
    Use(Box<BrushPreset>),
    /// Keeps the brush in hand.
    Keep {
        /// Whether to keep its paint too.
        with_paint: bool,
    },
    /// Adds an empty set of this name.
    AddSet(String),
    /// Takes over the brushes of a file.
    Import,
    /// Exports the shown set.
    Export,
}

/// State of the window of own brushes.
#[derive(Debug, Default)]
pub struct OwnBrushes {
    chosen: usize,
    with_paint: bool,
    /// Name of the chosen brush while you type it.
    renamed: Option<String>,
    /// Name of a new set while you type it.
    new_set: Option<String>,
    /// Whether we ask before removing the set.
    asks_to_remove: bool,
}

impl OwnBrushes {
    /// Draws the window while `open` is true. The close button and Escape clear `open`. Returns
    /// your request, if any.
    pub fn show(
        &mut self,
        context: &Context,
        open: &mut bool,
        sets: &mut BrushSets,
    ) -> Option<OwnBrushRequest> {
        if self.renamed.is_some() || self.new_set.is_some() {
            floating::leave_escape(context);
        }
        floating::show(context, tr("Own brushes"), "own brushes", open, |ui| {
            ui.set_width(WIDTH);
            if !sets.is_read() {
                ui.weak(tr("reading the own brushes"));
                return None;
            }
            let mut request = self.set_row(ui, sets);
            ui.separator();
            let listed = self.list(ui, sets);
            request = request.take().or(listed);
            ui.separator();
            let asked = self.buttons(ui, sets);
            request = request.take().or(asked);
            if let Some(imported) = &sets.imported {
                ui.separator();
                show(ui, imported);
            }
            request
        })
        .flatten()
    }

    /// Draws the shown set, and buttons for whole sets.
    fn set_row(&mut self, ui: &mut Ui, sets: &mut BrushSets) -> Option<OwnBrushRequest> {
        let mut request = None;
        ui.horizontal(|ui| {
            let name = sets.set().map_or(tr("no set yet"), |set| set.name()).to_owned();
            let before = sets.shown;
            let combo = ComboBox::from_id_salt("set").selected_text(name).width(150.0);
            let combo = combo.show_ui(ui, |ui| {
                for (index, stored) in sets.sets.iter().enumerate() {
                    ui.selectable_value(&mut sets.shown, index, stored.set.name());
                }
            });
            combo
                .response
                .accessible_name(tr("Set of brushes"))
                .on_hover_text(tr("The set that is shown"));
            if sets.shown != before {
                (self.chosen, self.renamed, self.asks_to_remove) = (0, None, false);
            }
            if button(ui, tr("New set"), tr("Adds an empty set"), None) {
                self.new_set = Some(String::new());
            }
            let none = sets.set().is_none().then_some(tr("there is no set"));
            if button(
                ui,
                tr("Import..."),
                tr("Takes over a set (.json) or a brush of MyPaint (.myb)"),
                None,
            ) {
                request = Some(OwnBrushRequest::Import);
            }
            if button(ui, tr("Export..."), tr("Writes this set to a file"), none) {
                request = Some(OwnBrushRequest::Export);
            }
        });
        if let Some(typed) = &mut self.new_set {
            match name_field(ui, typed, tr("Name of the set")) {
                Typed::Open => {}
                Typed::Done(name) => {
                    self.new_set = None;
                    self.chosen = 0;
                    request = Some(OwnBrushRequest::AddSet(name));
                }
                Typed::Cancelled => self.new_set = None,
            }
        }
        request
    }

    fn list(&mut self, ui: &mut Ui, sets: &mut BrushSets) -> Option<OwnBrushRequest> {
        let mut request = None;
        let Some(set) = sets.set_mut() else {
            ui.weak(tr("Keep the brush in hand, or import a set."));
            return None;
        };
        if set.presets().is_empty() {
            ui.weak(tr("This set is empty."));
        }
        let mut renamed = None;
        ScrollArea::vertical().max_height(300.0).auto_shrink([false, true]).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            for (index, preset) in set.presets().iter().enumerate() {
                if self.chosen == index
                    && let Some(typed) = &mut self.renamed
                {
                    match name_field(ui, typed, tr("Name of the own brush")) {
                        Typed::Open => {}
                        Typed::Done(name) => {
                            renamed = Some(name);
                            self.renamed = None;
                        }
                        Typed::Cancelled => self.renamed = None,
                    }
                    continue;
                }
                let response = preset_row(ui, preset, self.chosen == index);
                if response.clicked() {
                    (self.chosen, self.renamed) = (index, None);
                }
                if response.double_clicked() {
                    request = Some(OwnBrushRequest::Use(Box::new(preset.clone())));
                }
                response.on_hover_text(tr("Click chooses, a double click takes the brush in hand"));
            }
        });
        if let Some(name) = renamed {
            set.rename(self.chosen, &name);
        }
        request
    }

    fn buttons(&mut self, ui: &mut Ui, sets: &mut BrushSets) -> Option<OwnBrushRequest> {
        let mut request = None;
        let count = sets.set().map_or(0, |set| set.presets().len());
        let none = (self.chosen >= count).then_some(tr("no brush is chosen"));
        ui.horizontal(|ui| {
            if button(ui, tr("Take in hand"), tr("Paints with the chosen brush"), none)
                && let Some(preset) = sets.set().and_then(|set| set.presets().get(self.chosen))
            {
                request = Some(OwnBrushRequest::Use(Box::new(preset.clone())));
            }
            let tip = tr("Keeps the brush in hand in this set, under its name in the list");
            if button(ui, tr("Keep brush"), tip, None) {
                request = Some(OwnBrushRequest::Keep { with_paint: self.with_paint });
            }
            let tip = tr("Keeps the mean of its paint too, and loads it again");
            ui.checkbox(&mut self.with_paint, tr("with its paint")).on_hover_text(tip);
        });
        ui.horizontal(|ui| self.change_list(ui, sets, none));
        request
    }

    fn change_list(&mut self, ui: &mut Ui, sets: &mut BrushSets, none: Option<&str>) {
        let chosen = self.chosen;
        if let Some(set) = sets.set_mut() {
            let last = set.presets().len().saturating_sub(1);
            if button(ui, tr("Rename brush"), tr("Renames the chosen brush"), none) {
                self.renamed = set.presets().get(chosen).map(|preset| preset.name.clone());
            }
            let first = (chosen == 0).then_some(tr("it is the first"));
            if button(ui, tr("Up"), tr("Moves the chosen brush up"), none.or(first)) {
                set.move_to(chosen, chosen - 1);
                self.chosen -= 1;
            }
            let end = (chosen >= last).then_some(tr("it is the last"));
            if button(ui, tr("Down"), tr("Moves the chosen brush down"), none.or(end)) {
                set.move_to(chosen, chosen + 1);
                self.chosen += 1;
            }
            if button(ui, tr("Remove brush"), tr("Removes the chosen brush from the set"), none) {
                set.remove(chosen);
                self.chosen = chosen.min(last.saturating_sub(1));
            }
        }
        let no_set = sets.set().is_none().then_some(tr("there is no set"));
        if !self.asks_to_remove {
            let tip = tr("Asks, then removes the set with its file");
            self.asks_to_remove = button(ui, tr("Remove set"), tip, no_set);
        } else if button(ui, tr("Really remove"), tr("Removes all brushes of the set"), no_set) {
            sets.remove_set();
            (self.chosen, self.asks_to_remove) = (0, false);
        }
    }
}

enum Typed {
    Open,
    Done(String),
    Cancelled,
}

/// A field for a name. Enter accepts it, Escape cancels.
fn name_field(ui: &mut Ui, typed: &mut String, name: &str) -> Typed {
    let field = theme::text_field(typed).desired_width(f32::INFINITY).char_limit(80);
    let response = ui.add(field.hint_text(name)).accessible_name(name);
    let escape = ui.input(|input| input.key_pressed(Key::Escape));
    if response.lost_focus() {
        let proper = !escape && !typed.trim().is_empty();
        return if proper { Typed::Done(typed.trim().to_owned()) } else { Typed::Cancelled };
    }
    if !response.has_focus() {
        response.request_focus();
    }
    Typed::Open
}

const HEIGHT: f32 = 34.0;

fn preset_row(ui: &mut Ui, preset: &BrushPreset, chosen: bool) -> Response {
    let response = row(ui, HEIGHT, &tr_format!("own brush {name}", name = preset.name), chosen);
    let inner = response.rect.shrink2(vec2(6.0, 3.0));
    row::draw(
        ui.painter(),
        between(inner, inner.left(), inner.left() + 24.0),
        preset.brush.shape,
        None,
    );
    let colors = theme::colors(ui.ctx());
    let (name, below) =
        between(inner, inner.left() + 32.0, inner.right()).split_top_bottom_at_fraction(0.55);
    text(ui, name, Align::Min, TextStyle::Body, colors.strong, &preset.name);
    let faint = if chosen { colors.text } else { colors.faint };
    text(ui, below, Align::Min, TextStyle::Small, faint, &summary(preset));
    response
}

/// Head, options and paint of a brush in a few words.
fn summary(preset: &BrushPreset) -> String {
    let mut words = vec![preset.brush.shape.to_string(), millimetres(preset.brush.size_mm)];
    let plain = BrushOptions::default();
    let options = &preset.options;
    for (differs, word) in [
        (options.curve.is_some(), tr("own curve")),
        (options.stabiliser.is_some(), tr("own stabiliser")),
        (options.tilt != plain.tilt, tr("own tilt")),
        (options.twist != plain.twist, tr("own twist")),
        (options.range != plain.range, tr("own pressure")),
    ] {
        if differs {
            words.push(word.to_owned());
        }
    }
    if let Some(load) = &preset.load {
        let pigments: Vec<&str> = load.recipe.keys().map(String::as_str).collect();
        let paint =
            if pigments.is_empty() { tr("a load set").to_owned() } else { pigments.join(" + ") };
        words.push(paint);
    }
    words.join(", ")
}

/// Lists the settings that we took over, and those without a meaning here.
fn show(ui: &mut Ui, imported: &ImportedBrush) {
    let title = tr_format!("Taken over from MyPaint: {name}", name = imported.preset.name);
    CollapsingHeader::new(title).id_salt("imported").default_open(true).show(ui, |ui| {
        ScrollArea::vertical().max_height(160.0).auto_shrink([false, true]).show(ui, |ui| {
            for line in &imported.taken {
                ui.label(line);
            }
            if !imported.meaningless.is_empty() {
                ui.weak(tr_format!(
                    "has no meaning here: {names}",
                    names = imported.meaningless.join(", ")
                ));
            }
        });
    });
}
