//! The swatches panel: the grid of mixtures that you keep, and the recipe of the selected one.

use std::sync::Arc;

use eframe::egui::{
    Color32, DragAndDrop, Grid, Key, Response, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo,
    vec2,
};
use paint::layer::SLOTS;
use paint::light::Light;
use paint::strokes::{Action, PaletteSpec};
use pigment::library::PigmentLibrary;
use session::PaintingState;
use session::swatches::{KeptMixture, SwatchBook, SwatchChange, Usable};

use crate::files::{FileRequest, SwatchFormat};
use crate::language::{tr, tr_format};
use crate::panels::context::lay_on_palette;
use crate::panels::controls::{button, item, patch};
use crate::panels::{PanelContext, Request};
use crate::theme;

/// State of the swatches panel.
#[derive(Debug, Clone, Default)]
pub struct Swatches {
    chosen: Option<usize>,
    /// Name of the chosen mixture while you change it.
    typed: Option<String>,
    /// Whether you see mixtures of other libraries too.
    all_libraries: bool,
    colors: SwatchColors,
}

impl Swatches {
    /// Draws the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>, book: &SwatchBook) {
        self.chosen = self.chosen.filter(|&index| index < book.swatches.len());
        self.header(ui, cx, book);
        let shown: Vec<usize> = (0..book.swatches.len())
            .filter(|&index| {
                self.all_libraries || book.swatches[index].library == cx.painting.library.title
            })
            .collect();
        if shown.is_empty() {
            ui.weak(
                tr("No mixture is kept. \u{201c}Keep\u{201d} in the panel Brush keeps what the brush holds, beside a \
                 recipe it keeps that."),
            );
            return;
        }
        let colors = self.colors.get(cx.painting, book);
        let mixtures = shown.iter().map(|&index| (index, &book.swatches[index]));
        match show(ui, cx, mixtures, colors, self.chosen) {
            Some(GridRequest::Select(index)) => {
                (self.chosen, self.typed) = (Some(index), None);
            }
            Some(GridRequest::Load(index)) => {
                self.chosen = Some(index);
                let kept = &book.swatches[index];
                cx.load(kept.recipe.clone(), kept.vehicle);
            }
            Some(GridRequest::Move(from, to)) => self.change(cx, from, to),
            None => {}
        }
        if let Some(index) = self.chosen {
            ui.separator();
            let at = shown.iter().position(|&one| one == index);
            let before = at.and_then(|at| shown.get(at.checked_sub(1)?)).copied();
            let after = at.and_then(|at| shown.get(at + 1)).copied();
            let place = Place { index, before, after };
            let before = cx.requests.len();
            show_chosen(ui, cx, place, &book.swatches[index], &mut self.typed);
            self.follow(cx, before);
        }
    }

    fn change(&mut self, cx: &mut PanelContext<'_>, from: usize, to: usize) {
        cx.file(FileRequest::Swatches(SwatchChange::Move(from, to)));
        self.chosen = Some(to);
    }

    /// Looks at the requests from index `before` on. If one moves a mixture, the selection moves
    /// with it. If one removes a mixture, this clears the selection.
    fn follow(&mut self, cx: &PanelContext<'_>, before: usize) {
        for request in &cx.requests[before..] {
            let Request::File(FileRequest::Swatches(change)) = request else { continue };
            match change {
                SwatchChange::Move(_, to) => self.chosen = Some(*to),
                SwatchChange::Remove(_) => self.chosen = None,
                _ => {}
            }
        }
    }

    fn header(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>, book: &SwatchBook) {
        ui.horizontal(|ui| {
            let all = ui.checkbox(&mut self.all_libraries, tr("All libraries"));
            all.on_hover_text(tr("Shows mixtures that were kept from other libraries too"));
            ui.menu_button(tr("Import, export"), |ui| {
                let tip =
                    tr("Adds mixtures (.json), or colours (.gpl, .ase, .aco) to find recipes for");
                if item(ui, tr("Import..."), tip, None) {
                    cx.file(FileRequest::ImportSwatches);
                }
                let none = book.swatches.is_empty().then_some(tr("no mixture is kept"));
                for (format, name, tip) in [
                    (
                        SwatchFormat::Json,
                        tr("Export mixtures..."),
                        tr("Writes all recipes as JSON"),
                    ),
                    (
                        SwatchFormat::Gpl,
                        tr("Export colours (.gpl)..."),
                        tr("For GIMP, Inkscape and Krita"),
                    ),
                    (SwatchFormat::Ase, tr("Export colours (.ase)..."), tr("For Adobe programs")),
                ] {
                    if item(ui, name, tip, none) {
                        cx.file(FileRequest::ExportSwatches(format));
                    }
                }
            })
            .response
            .on_hover_text(tr("Imports and exports mixtures and their colours"));
        });
    }
}

/// Side of a patch, in points. It is large enough for a finger.
const SIDE: f32 = 44.0;

/// Payload of a mixture that you drag to another place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct DraggedSwatch(usize);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum GridRequest {
    /// Selects the mixture at an index.
    Select(usize),
    /// Loads the brush with this mixture.
    Load(usize),
    /// Moves a mixture from one index to another.
    Move(usize, usize),
}

/// Draws patches of the mixtures at these indices. `colors` has the colours of all mixtures.
fn show<'a>(
    ui: &mut Ui,
    cx: &PanelContext<'_>,
    shown: impl Iterator<Item = (usize, &'a KeptMixture)>,
    colors: &[[u8; 3]],
    chosen: Option<usize>,
) -> Option<GridRequest> {
    let mut request = None;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
        for (index, kept) in shown {
            let color = colors.get(index).copied();
            let usable = kept.usable(&cx.painting.library, &cx.painting.slots);
            let response = one(ui, kept, color, &usable, chosen == Some(index));
            response.dnd_set_drag_payload(DraggedSwatch(index));
            if let Some(from) = response.dnd_release_payload::<DraggedSwatch>() {
                request = Some(GridRequest::Move(from.0, index));
            } else if response.double_clicked() && usable == Usable::Now {
                request = Some(GridRequest::Load(index));
            } else if response.clicked() {
                request = Some(GridRequest::Select(index));
            }
            let is_target = response.dnd_hover_payload::<DraggedSwatch>().is_some();
            if is_target {
                let line = Stroke::new(2.0, theme::colors(ui.ctx()).strong);
                ui.painter().vline(response.rect.left() - 2.0, response.rect.y_range(), line);
            }
            if !DragAndDrop::has_any_payload(ui.ctx()) {
                response.on_hover_ui(|ui| tip(ui, cx, kept, &usable));
            }
        }
    });
    request
}

fn one(
    ui: &mut Ui,
    kept: &KeptMixture,
    color: Option<[u8; 3]>,
    usable: &Usable,
    chosen: bool,
) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(SIDE, SIDE), Sense::click_and_drag());
    let name = tr_format!("mixture {name}", name = kept.name);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &name));
    let colors = theme::colors(ui.ctx());
    patch(ui.painter(), rect.shrink(3.0), color);
    if let Usable::NotInLibrary(_) = usable {
        // We grey it: an older colour under a veil, and crossed out.
        let veil = Color32::from_rgba_unmultiplied(
            colors.panel.r(),
            colors.panel.g(),
            colors.panel.b(),
            170,
        );
        ui.painter().rect_filled(rect.shrink(3.0), 0.0, veil);
        let line = Stroke::new(1.5, colors.faint);
        ui.painter()
            .line_segment([rect.shrink(3.0).left_bottom(), rect.shrink(3.0).right_top()], line);
    }
    if let Usable::NotOnPalette(_) = usable {
        let at = rect.right_bottom() - vec2(9.0, 9.0);
        ui.painter().circle(at, 3.5, colors.panel, Stroke::new(1.5, colors.strong));
    }
    if chosen || response.hovered() || response.has_focus() {
        let line = Stroke::new(2.0, if chosen { colors.strong } else { colors.faint });
        ui.painter().rect_stroke(rect.shrink(1.0), theme::CORNER_RADIUS, line, StrokeKind::Inside);
    }
    response
}

fn tip(ui: &mut Ui, cx: &PanelContext<'_>, kept: &KeptMixture, usable: &Usable) {
    ui.strong(&kept.name);
    for (name, part) in &kept.recipe {
        ui.label(format!("{part} {name}"));
    }
    match reason(cx, usable) {
        Some(reason) => ui.weak(reason),
        None => ui.weak(tr("Double click loads the brush; drag to another place.")),
    };
}

/// Why you cannot load a mixture now; `None` if you can.
fn reason(cx: &PanelContext<'_>, usable: &Usable) -> Option<String> {
    match usable {
        Usable::Now => None,
        Usable::NotOnPalette(away) => {
            let names: Vec<&str> =
                away.iter().map(|pigment| cx.painting.library[*pigment].name.as_str()).collect();
            let all = names.join(", ");
            Some(match names.len() {
                1 => tr_format!("{name} is not on the palette.", name = all),
                _ => tr_format!("{names} are not on the palette.", names = all),
            })
        }
        Usable::NotInLibrary(names) => {
            let all = names.join(", ");
            Some(match names.len() {
                1 => tr_format!("{name} is not in the open library.", name = all),
                _ => tr_format!("{names} are not in the open library.", names = all),
            })
        }
    }
}

/// Index of a mixture in the list, and of its neighbours among the mixtures that you see.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Place {
    index: usize,
    before: Option<usize>,
    after: Option<usize>,
}

/// Draws the mixture at a place. `typed` is its name while you change it.
fn show_chosen(
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

/// Offers to add the missing tubes to the palette, if there is room.
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

/// Colours of the mixtures by their index in the list. We compute them again when light, library or
/// list change.
#[derive(Debug, Clone, Default)]
struct SwatchColors {
    of: Option<(Arc<PigmentLibrary>, Arc<Light>, SwatchBook)>,
    colors: Vec<[u8; 3]>,
}

impl SwatchColors {
    /// sRGB of each mixture of `book`. If its pigments are missing, this is the colour at the time
    /// when you kept it.
    fn get(&mut self, painting: &PaintingState, book: &SwatchBook) -> &[[u8; 3]] {
        let PaintingState { library, light, .. } = painting;
        let same = self.of.as_ref().is_some_and(|(own, under, list)| {
            Arc::ptr_eq(own, library) && Arc::ptr_eq(under, light) && list == book
        });
        if !same && let Ok(weights) = light.viewing.weights(library.grid) {
            self.colors = book
                .swatches
                .iter()
                .map(|kept: &KeptMixture| kept.screen_color(library, &weights))
                .collect();
            self.of = Some((Arc::clone(library), Arc::clone(light), book.clone()));
        }
        &self.colors
    }
}
