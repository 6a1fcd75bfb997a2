//! The dialog of a new painting: presets, format, size in cells and ground, with a picture of the
//! ground.

mod preview;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use eframe::egui::{
    Button, Color32, ComboBox, Context, DragValue, Grid, Image, RichText, Sense, Ui, Vec2, vec2,
};
use paint::document::Lighting;
use paint::ground::{
    ColorPrimer, GroundKind, GroundRelief, PaperFinish, PictureRelief, Primer, PrimerFilm,
    TonedPrimer,
};
use paint::light::Light;
use paint::strokes::PaletteSpec;
use session::PaintingState;
use spectra::color::Rgb;

use crate::files::dialogs::{Choice, dialog, grid_row};
use crate::files::job::Job;
use crate::files::new_canvas::{
    FORMATS, Format, KeptCanvases, LengthUnit, MAX_CELLS, NewCanvas, SIDE_MM, TONES, Tone,
};
use crate::files::work::file_name;
use crate::language::{tr, tr_format};
use crate::theme;
use pigment::library::PigmentLibrary;
use preview::{CELLS, Preview, PreviewLight};

/// sRGB of each tone; `None` if the library lacks one of the pigments.
type ToneColors = Vec<Option<[u8; 3]>>;

#[derive(Debug)]
pub(super) struct NewDialog {
    /// The canvas with your choices so far.
    pub(super) new: NewCanvas,
    pub(super) palette: PaletteSpec,
    pub(super) library: Arc<PigmentLibrary>,
    /// The library that comes with the program.
    pub(super) oils: Arc<PigmentLibrary>,
    lighting: Lighting,
    light: Arc<Light>,
    preview: Preview,
    /// Name of the preset, chosen or typed.
    preset: String,
    /// Free memory in bytes, if the system reports it.
    free_bytes: Option<u64>,
    finding_memory: Option<Job<Option<u64>>>,
    tones: [ToneColors; 2],
    mixing_tones: Option<Job<[ToneColors; 2]>>,
}

impl NewDialog {
    /// Creates the dialog, with the choices of `last`. The painting of `state` is the current one.
    #[must_use]
    pub(super) fn new(state: &PaintingState, mut last: NewCanvas, context: &Context) -> Self {
        last.bound();
        let pigments = state.slots.iter().flatten();
        let pigments = pigments.map(|&pigment| state.library[pigment].name.as_str());
        let wake = context.clone();
        let finding_memory =
            Job::start("memory", move || wake.request_repaint(), move |_| Ok(free_bytes()));
        let library = Arc::clone(&state.library);
        let oils = Arc::new(PigmentLibrary::van_gogh_oils());
        let libraries = [Arc::clone(&library), Arc::clone(&oils)];
        let wake = context.clone();
        let viewing = state.light.viewing.clone();
        let mixing_tones = Job::start(
            "tones",
            move || wake.request_repaint(),
            move |_| {
                Ok(libraries.each_ref().map(|library: &Arc<PigmentLibrary>| {
                    TONES.iter().map(|tone| tone.color(library, &viewing)).collect()
                }))
            },
        );
        Self {
            new: last,
            palette: PaletteSpec::from_names(pigments),
            library,
            oils,
            lighting: state.lighting.clone(),
            light: Arc::clone(&state.light),
            preview: Preview::default(),
            preset: String::new(),
            free_bytes: None,
            finding_memory: Some(finding_memory),
            tones: Default::default(),
            mixing_tones: Some(mixing_tones),
        }
    }

    /// The library that the new painting will have.
    #[must_use]
    pub(super) fn own_library(&self) -> &Arc<PigmentLibrary> {
        if self.new.same_pigments { &self.library } else { &self.oils }
    }

    /// Colour of a tone, once we know it.
    fn tone_color(&self, index: usize) -> Option<[u8; 3]> {
        let tones = &self.tones[usize::from(!self.new.same_pigments)];
        tones.get(index).copied().flatten()
    }

    /// Uses a picture that you chose.
    pub(super) fn set_picture(&mut self, purpose: CanvasPicture, path: PathBuf) {
        match purpose {
            CanvasPicture::FirstLayer => self.new.first_layer = Some(path),
            CanvasPicture::Relief => {
                let depth_mm = match &self.new.canvas.ground.relief {
                    GroundRelief::Image(picture) => picture.depth_mm,
                    _ => 0.2,
                };
                let path = path.display().to_string();
                self.new.canvas.ground.relief =
                    GroundRelief::Image(PictureRelief { path, depth_mm });
            }
        }
    }

    fn update(&mut self, context: &Context) {
        if let Some(found) = self.finding_memory.as_mut().and_then(Job::poll) {
            self.finding_memory = None;
            self.free_bytes = found.ok().flatten();
        }
        if let Some(found) = self.mixing_tones.as_mut().and_then(Job::poll) {
            self.mixing_tones = None;
            self.tones = found.unwrap_or_default();
        }
        let same = self.new.same_pigments;
        let library = Arc::clone(self.own_library());
        // The light depends on the library, so we can take it over only with the same one.
        let light = (same || *library == *self.library).then(|| Arc::clone(&self.light));
        let lighting = self.lighting.clone();
        self.preview.update(context, &self.new.canvas, same, move || PreviewLight {
            library,
            lighting,
            light,
        });
    }

    pub(super) fn show(&mut self, ctx: &Context, kept: &mut KeptCanvases) -> Option<NewAnswer> {
        self.update(ctx);
        let begin = (tr("Begin"), tr("Begins to paint on the new canvas (Enter)"));
        let mut answer = None;
        let choice = dialog(ctx, tr("New painting"), begin, None, |ui| {
            ui.set_width(WIDTH.min(ctx.content_rect().width() - 40.0));
            ui.horizontal_top(|ui| {
                ui.vertical(|ui| {
                    ui.set_width(SETTINGS);
                    let grid = Grid::new("new painting").num_columns(2).spacing([12.0, 7.0]);
                    grid.show(ui, |ui| {
                        grid_row(ui, tr("Preset"), |ui| self.preset_row(ui, kept));
                        self.size_rows(ui);
                        answer = self.ground_rows(ui);
                        grid_row(ui, tr("Pigments"), |ui| self.pigments(ui));
                    });
                });
                ui.vertical(|ui| self.ground_picture(ui));
            });
            self.size_line(ui);
        });
        match choice {
            Some(Choice::Yes) if self.new.fits() => Some(NewAnswer::Begin),
            Some(Choice::Yes) | None => answer,
            Some(Choice::No | Choice::Cancelled) => Some(NewAnswer::Cancelled),
        }
    }

    fn pigments(&mut self, ui: &mut Ui) {
        let same = &mut self.new.same_pigments;
        ui.radio_value(same, true, tr("As now"))
            .on_hover_text(tr("Keeps the library and the tubes"));
        let oils = ui.radio_value(same, false, tr("Van Gogh's oils"));
        oils.on_hover_text(tr("The library that comes with the program"));
    }

    /// Draws the lit piece of the ground.
    fn ground_picture(&self, ui: &mut Ui) {
        let room = vec2(CELLS[0] as f32, CELLS[1] as f32);
        let (rect, _) = ui.allocate_exact_size(room, Sense::hover());
        ui.painter().rect_filled(rect, 0.0, theme::SURROUND);
        if let Some(texture) = &self.preview.texture {
            let size = texture.size_vec2();
            let place = eframe::egui::Rect::from_center_size(rect.center(), size.min(room));
            let alt = Image::from_texture(texture).alt_text(tr("Piece of the ground"));
            ui.put(place, alt.fit_to_exact_size(place.size()));
        }
        let text = match (&self.preview.problem, self.new.kind()) {
            (Some(problem), _) => problem.text.clone(),
            (None, Some(_)) => {
                let mm = self.new.canvas.cell_mm * CELLS[0] as f64;
                tr_format!("{mm:.1} mm of the ground in the light of the painting", mm)
            }
            (None, None) => tr("The whole canvas in the light of the painting").to_owned(),
        };
        ui.label(RichText::new(text).weak().small());
    }

    /// Adds the rows for format, size and cells.
    fn size_rows(&mut self, ui: &mut Ui) {
        grid_row(ui, tr("Format"), |ui| self.format(ui));
        grid_row(ui, tr("Size"), |ui| {
            let unit = self.new.unit;
            let canvas = &mut self.new.canvas;
            side(ui, tr("Width"), unit, &mut canvas.width_mm);
            ui.label("x");
            side(ui, tr("Height"), unit, &mut canvas.height_mm);
            for unit in LengthUnit::ALL {
                let tip = tr("Unit of the size");
                let chosen = self.new.unit == unit;
                let button = Button::selectable(chosen, unit.sign())
                    .min_size(theme::at_least(ui, Vec2::ZERO));
                if ui.add(button).on_hover_text(tip).clicked() {
                    self.new.unit = unit;
                }
            }
        });
        grid_row(ui, tr("Cell"), |ui| {
            let drag = DragValue::new(&mut self.new.canvas.cell_mm).range(0.02..=2.0).speed(0.01);
            let tip = tr("Width of a cell; 0.1 mm is 254 per inch. Smaller is finer and slower");
            let drag = ui.add(drag.suffix(" mm")).accessible_name(tr("Width of a cell"));
            drag.on_hover_text(tip);
            let (width, height) = self.new.canvas.cells();
            let millions = self.new.cell_count() as f64 / 1e6;
            ui.label(tr_format!(
                "{width} x {height} cells, {millions:.1} million",
                width,
                height,
                millions
            ));
        });
        grid_row(ui, tr("Memory"), |ui| {
            let [canvas, layer] = self.new.memory().map(in_mib);
            ui.label(tr_format!("{canvas}, and {layer} for each dry layer", canvas, layer));
        });
    }

    fn format(&mut self, ui: &mut Ui) {
        let canvas = &self.new.canvas;
        let current = Format::of(canvas.width_mm, canvas.height_mm);
        let shown = current.map_or(tr("Own size"), |format| tr(format.name));
        let combo = ComboBox::from_id_salt("format").selected_text(shown).width(150.0);
        let combo = combo.show_ui(ui, |ui| {
            let mut group = "";
            for format in &FORMATS {
                if format.group != group {
                    group = format.group;
                    ui.label(RichText::new(tr(group)).weak().small());
                }
                let mm = format!("{} x {} mm", format.short_mm, format.long_mm);
                let row = ui.selectable_label(current == Some(format), tr(format.name));
                if row.on_hover_text(mm).clicked() {
                    self.new.set_format(format);
                }
            }
        });
        combo
            .response
            .accessible_name(tr("Format of the canvas"))
            .on_hover_text(tr("Paper and canvases by name"));
        let upright = self.new.is_upright();
        for (own, name, tip) in [
            (true, tr("Portrait"), tr("Higher than wide")),
            (false, tr("Landscape"), tr("Wider than high")),
        ] {
            if ui.selectable_label(upright == own, name).on_hover_text(tip).clicked() {
                self.new.set_upright(own);
            }
        }
    }

    /// A warning about the size, if there is one.
    fn size_problem(&self) -> Option<String> {
        if !self.new.fits() {
            return Some(tr_format!(
                "Too many cells: at most {most} million. Choose larger cells or a smaller size.",
                most = MAX_CELLS / 1_000_000
            ));
        }
        let [canvas, layer] = self.new.memory();
        let free = self.free_bytes.filter(|free| *free < canvas + layer)?;
        let free = in_mib(free);
        Some(tr_format!("With one layer this needs more memory than is free now, {free}.", free))
    }

    /// Draws the warning about the size. This takes up a line even without a warning, so that
    /// nothing moves.
    fn size_line(&self, ui: &mut Ui) {
        let text = self.size_problem().unwrap_or_default();
        ui.label(RichText::new(text).strong().color(theme::colors(ui.ctx()).strong));
    }

    /// Lets you choose, keep and remove presets.
    fn preset_row(&mut self, ui: &mut Ui, kept: &mut KeptCanvases) {
        let chosen = kept.preset(&self.preset).is_some();
        let shown = if chosen { self.preset.as_str() } else { tr("Presets") };
        let mut wanted = None;
        ui.add_enabled_ui(!kept.presets.is_empty(), |ui| {
            let combo = ComboBox::from_id_salt("presets").selected_text(shown).width(150.0);
            let combo = combo.show_ui(ui, |ui| {
                for preset in &kept.presets {
                    let own = preset.name == self.preset;
                    if ui.selectable_label(own, &preset.name).clicked() {
                        wanted = Some(preset.clone());
                    }
                }
            });
            combo
                .response
                .accessible_name(tr("Presets"))
                .on_hover_text(tr("Canvases kept under a name"));
        });
        if let Some(preset) = wanted {
            (self.preset, self.new) = (preset.name, preset.canvas);
        }
        let edit = theme::text_field(&mut self.preset).hint_text(tr("Name")).desired_width(120.0);
        let edit = ui.add(edit).accessible_name(tr("Name of the preset"));
        edit.on_hover_text(tr("Name under which these settings are kept"));
        let named = !self.preset.trim().is_empty();
        let keep = ui.add_enabled(named, Button::new(tr("Keep")));
        if keep.on_hover_text(tr("Keeps these settings under the name")).clicked() {
            self.preset = self.preset.trim().to_owned();
            kept.keep(&self.preset, self.new.clone());
        }
        let remove = ui.add_enabled(chosen, Button::new(tr("Remove preset")));
        if remove.on_hover_text(tr("Removes the preset of this name")).clicked() {
            kept.remove(&self.preset);
            self.preset.clear();
        }
    }

    /// Adds the rows for the ground. Returns a request for a picture.
    fn ground_rows(&mut self, ui: &mut Ui) -> Option<NewAnswer> {
        let mut answer = None;
        grid_row(ui, tr("Ground"), |ui| answer = self.kind(ui));
        grid_row(ui, tr("Relief"), |ui| self.relief(ui));
        grid_row(ui, tr("Colour"), |ui| self.tone(ui));
        self.own_tone(ui);
        grid_row(ui, tr("First layer"), |ui| {
            let chosen = self.first_layer(ui);
            answer = answer.or(chosen);
        });
        answer
    }

    fn kind(&mut self, ui: &mut Ui) -> Option<NewAnswer> {
        for (kind, name, tip) in [
            (GroundKind::Linen, tr("Linen"), tr("Primed linen in plain weave")),
            (GroundKind::Panel, tr("Panel"), tr("A primed panel, nearly flat")),
            (GroundKind::Paper, tr("Paper"), tr("Watercolour paper")),
            (GroundKind::Wood, tr("Wood"), tr("Varnished walnut")),
        ] {
            let chosen = self.new.kind() == Some(kind);
            if ui.selectable_label(chosen, name).on_hover_text(tip).clicked() && !chosen {
                self.new.set_kind(kind);
            }
        }
        let own = self.new.kind().is_none();
        let picture =
            ui.selectable_label(own, tr("Picture\u{2026}")).accessible_name(tr("Relief picture"));
        let tip = tr("Takes the relief from the greys of a picture, white the highest");
        picture.on_hover_text(tip).clicked().then_some(NewAnswer::Choose(CanvasPicture::Relief))
    }

    fn relief(&mut self, ui: &mut Ui) {
        let most = if self.new.kind().is_none() { 20.0 } else { 2.0 };
        let drag = DragValue::new(self.new.relief_mm()).range(0.0..=most).speed(0.005);
        let drag =
            ui.add(drag.max_decimals(3).suffix(" mm")).accessible_name(tr("Height of the relief"));
        drag.on_hover_text(tr("From the hollows of the ground to its heights"));
        if let GroundRelief::Linen(linen) = &mut self.new.canvas.ground.relief {
            let drag = DragValue::new(&mut linen.threads_per_cm).range(2.0..=60.0).speed(0.1);
            let drag = ui.add(drag.max_decimals(1).suffix(tr(" threads/cm")));
            drag.accessible_name(tr("Threads")).on_hover_text(tr("8 is coarse, 14 usual, 25 fine"));
            let drag = DragValue::new(&mut linen.unevenness).range(0.0..=1.0).speed(0.01);
            let drag = ui.add(drag.max_decimals(2).prefix(tr("uneven ")));
            let tip = tr("0 is a perfect weave, 0.5 is usual linen with thin and thick threads");
            drag.accessible_name(tr("Unevenness of the threads")).on_hover_text(tip);
        }
        if let GroundRelief::Paper(paper) = &mut self.new.canvas.ground.relief {
            for (finish, name) in [
                (PaperFinish::Rough, tr("Rough")),
                (PaperFinish::ColdPressed, tr("Cold")),
                (PaperFinish::HotPressed, tr("Hot")),
            ] {
                let tip = tr("How it was pressed; this sets the height of its relief");
                if ui.selectable_label(paper.finish == finish, name).on_hover_text(tip).clicked() {
                    (paper.finish, paper.relief_mm) = (finish, finish.relief_mm());
                }
            }
        }
        if let GroundRelief::Image(picture) = &self.new.canvas.ground.relief {
            ui.weak(file_name(Path::new(&picture.path))).on_hover_text(&picture.path);
        }
        if let Some(seed) = self.new.seed() {
            let drag = ui.add(DragValue::new(seed).prefix(tr("seed "))).accessible_name(tr("Seed"));
            drag.on_hover_text(tr("Each number gives another piece of the same ground"));
        }
    }

    fn tone(&mut self, ui: &mut Ui) {
        let library = self.own_library().clone();
        let colors: [Option<[u8; 3]>; TONES.len()] =
            std::array::from_fn(|index| self.tone_color(index));
        let primer = &mut self.new.canvas.ground.reflectance;
        let tone = Tone::of(primer.as_ref());
        let shown = match (tone, &primer) {
            (Some(tone), _) => tr(tone.name),
            (None, Some(Primer::Toned(_))) => tr("Own film"),
            (None, _) => tr("Plain colour"),
        };
        let combo = ComboBox::from_id_salt("tone").selected_text(shown).width(170.0);
        let combo = combo.show_ui(ui, |ui| {
            for (own, color) in TONES.iter().zip(colors) {
                let there = own.is_in(&library);
                let row = ui.add_enabled_ui(there, |ui| {
                    ui.horizontal(|ui| {
                        swatch(ui, color);
                        ui.selectable_label(tone == Some(own), tr(own.name))
                    })
                    .inner
                });
                if row.inner.on_hover_text(tr(own.description)).clicked() {
                    *primer = own.primer();
                }
            }
            let own_film = matches!(primer, Some(Primer::Toned(_))) && tone.is_none();
            let row = ui.selectable_label(own_film, tr("Own film"));
            let tip = tr("A film of pigments of your own; begins with the tone that is chosen");
            if row.on_hover_text(tip).clicked() && !own_film {
                *primer = match primer.take() {
                    Some(Primer::Toned(mut toned)) => {
                        // This makes it differ from the tone of that name.
                        toned.film.height_mm *= 1.01;
                        Some(Primer::Toned(toned))
                    }
                    _ => first_film(&library),
                };
            }
            let row = ui.selectable_label(shown == tr("Plain colour"), tr("Plain colour"));
            if row.on_hover_text(tr("Any colour, without pigments")).clicked() {
                *primer = Some(first_color());
            }
        });
        combo
            .response
            .accessible_name(tr("Colour of the ground"))
            .on_hover_text(tone.map_or(tr("Colour of the priming"), |tone| tone.description));
    }

    /// Adds rows for your own colour.
    fn own_tone(&mut self, ui: &mut Ui) {
        let library = self.own_library().clone();
        let primer = &mut self.new.canvas.ground.reflectance;
        let named = Tone::of(primer.as_ref()).is_some();
        match primer {
            Some(Primer::Toned(TonedPrimer { film })) if !named => {
                film_rows(ui, film, &library);
            }
            Some(Primer::Color(color)) => color_row(ui, color),
            _ => {}
        }
    }

    fn first_layer(&mut self, ui: &mut Ui) -> Option<NewAnswer> {
        let tip = tr("Lays the colours of a picture as a thin dry layer, mixed of the tubes");
        let choose = match &self.new.first_layer {
            None => {
                ui.weak(tr("none"));
                ui.button(tr("Picture\u{2026}")).accessible_name(tr("First layer picture"))
            }
            Some(path) => {
                let name = file_name(path);
                ui.add(eframe::egui::Label::new(name).truncate())
                    .on_hover_text(path.display().to_string());
                if ui.button(tr("Remove")).on_hover_text(tr("Begins without a layer")).clicked() {
                    self.new.first_layer = None;
                }
                ui.button(tr("Other\u{2026}")).accessible_name(tr("First layer picture"))
            }
        };
        choose.on_hover_text(tip).clicked().then_some(NewAnswer::Choose(CanvasPicture::FirstLayer))
    }
}

/// Why we ask for a picture file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum CanvasPicture {
    /// The greys become the relief of the ground.
    Relief,
    /// The colours become the first dry layer.
    FirstLayer,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NewAnswer {
    Begin,
    Cancelled,
    /// Asks for a picture. The dialog stays open.
    Choose(CanvasPicture),
}

const WIDTH: f32 = 760.0;

const SETTINGS: f32 = 476.0;

fn side(ui: &mut Ui, name: &str, unit: LengthUnit, mm: &mut f64) {
    let [least, most] = SIDE_MM.map(|side| side / unit.in_mm());
    let mut value = *mm / unit.in_mm();
    let decimals = if unit == LengthUnit::Mm { 1 } else { 2 };
    let drag = DragValue::new(&mut value).range(least..=most).max_decimals(decimals);
    let drag = ui.add(drag.speed(1.0 / unit.in_mm())).accessible_name(name);
    if drag.on_hover_text(tr_format!("{name} of the canvas", name)).changed() {
        *mm = value * unit.in_mm();
    }
}

fn swatch(ui: &mut Ui, color: Option<[u8; 3]>) {
    let side = ui.spacing().interact_size.y - 4.0;
    let (rect, _) = ui.allocate_exact_size(vec2(1.4 * side, side), Sense::hover());
    if let Some([red, green, blue]) = color {
        ui.painter().rect_filled(rect, 2.0, Color32::from_rgb(red, green, blue));
    }
}

/// Most pigments of a film.
const MOST_PIGMENTS: usize = 3;

/// The first film that we offer, of the first pigment with known K and S.
fn first_film(library: &PigmentLibrary) -> Option<Primer> {
    let name = library.pigments.iter().find(|pigment| pigment.identified)?.name.clone();
    let film = PrimerFilm { recipe: [(name, 1.0)].into(), height_mm: 0.001 };
    Some(Primer::Toned(TonedPrimer { film }))
}

fn first_color() -> Primer {
    Primer::Color(ColorPrimer { rgb: "#c8b89a".to_owned() })
}

/// Adds a row for each pigment of the film, and one for the thickness.
fn film_rows(ui: &mut Ui, film: &mut PrimerFilm, library: &PigmentLibrary) {
    let names: Vec<String> = film.recipe.keys().cloned().collect();
    for (row, name) in names.iter().enumerate() {
        grid_row(ui, if row == 0 { tr("Film") } else { "" }, |ui| {
            pigment(ui, row, film, name, library);
            if let Some(part) = film.recipe.get_mut(name) {
                let drag = DragValue::new(part).range(0.0..=100.0).speed(0.1).suffix(tr(" parts"));
                let drag = ui.add(drag).accessible_name(tr_format!("Parts of {name}", name));
                drag.on_hover_text(tr("Parts by volume of this pigment"));
            }
            let remove = ui.add_enabled(names.len() > 1, Button::new("\u{2212}"));
            let remove = remove.accessible_name(tr_format!("Leave {name} out", name));
            if remove.on_hover_text(tr("Leaves this pigment out")).clicked() {
                film.recipe.remove(name);
            }
        });
    }
    grid_row(ui, "", |ui| {
        let mut microns = film.height_mm * 1000.0;
        let drag = DragValue::new(&mut microns).range(0.0..=500.0).speed(0.02).max_decimals(2);
        let drag = ui.add(drag.suffix(" \u{b5}m")).accessible_name(tr("Thickness of the film"));
        let tip =
            tr("Height of the dry paint without the medium that thinned it: 0.5 to 1 for an \
                   imprimatura, 10 and more to hide the priming");
        if drag.on_hover_text(tip).changed() {
            film.height_mm = microns / 1000.0;
        }
        let more = film.recipe.len() < MOST_PIGMENTS;
        let next = library.pigments.iter().find(|p| !film.recipe.contains_key(&p.name));
        if let Some(next) = next.filter(|_| more)
            && ui.button(tr("Add pigment")).on_hover_text(tr("Mixes another one into it")).clicked()
        {
            film.recipe.insert(next.name.clone(), 1.0);
        }
    });
}

fn pigment(ui: &mut Ui, row: usize, film: &mut PrimerFilm, name: &str, library: &PigmentLibrary) {
    let combo = ComboBox::from_id_salt(("film", row)).selected_text(name).width(150.0);
    let combo = combo.show_ui(ui, |ui| {
        for other in &library.pigments {
            let free = !film.recipe.contains_key(&other.name);
            let chosen = other.name == name;
            if ui.selectable_label(chosen, &other.name).clicked() && free {
                let parts = film.recipe.remove(name).unwrap_or(1.0);
                film.recipe.insert(other.name.clone(), parts);
            }
        }
    });
    combo
        .response
        .accessible_name(tr_format!("Pigment {row}", row = row + 1))
        .on_hover_text(tr("A pigment of it"));
}

fn color_row(ui: &mut Ui, color: &mut ColorPrimer) {
    grid_row(ui, "", |ui| {
        let mut bytes = Rgb::from_hex(&color.rgb).map_or([200; 3], Rgb::to_bytes);
        let button = ui.color_edit_button_srgb(&mut bytes);
        if button
            .on_hover_text(tr("Colour in daylight; it becomes the smoothest spectrum"))
            .changed()
        {
            let [red, green, blue] = bytes;
            color.rgb = format!("#{red:02x}{green:02x}{blue:02x}");
        }
        ui.weak(&color.rgb);
    });
}

/// Memory in bytes that programs can still take; `None` where the system does not report it.
#[must_use]
fn free_bytes() -> Option<u64> {
    let text = std::fs::read_to_string(Path::new("/proc/meminfo")).ok()?;
    available(&text)
}

/// Reads the line `MemAvailable` of Linux, in bytes.
fn available(meminfo: &str) -> Option<u64> {
    let line = meminfo.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kib: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kib.checked_mul(1024)
}

/// Bytes as text, for example `178 MiB`.
#[must_use]
fn in_mib(bytes: u64) -> String {
    format!("{} MiB", bytes.div_ceil(1 << 20))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_free_memory_of_linux_is_read() {
        let text = "MemTotal:       16309468 kB\nMemFree:  1 kB\nMemAvailable:    2048 kB\n";
        assert_eq!(available(text), Some(2048 * 1024));
        assert_eq!(available("MemTotal: 5 kB\n"), None);
        assert_eq!(free_bytes().is_some(), cfg!(target_os = "linux"));
        assert_eq!(in_mib(186_624_000), "178 MiB");
    }
}
