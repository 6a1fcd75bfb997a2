//! The eyedropper panel: colour, spectrum and paint at the last picked place, and recipes for a
//! colour.

mod target;
mod search;

use std::path::Path;
use std::sync::Arc;

use documents::file::disk;
use eframe::egui::{Align2, Button, DragValue, Grid, Key, Ui, vec2};
use paint::document::Medium;
use paint::strokes::SurfaceId;
use pigment::library::PigmentLibrary;
use pigment::palette::Appearance;
use session::{Command, Picked};
use spectra::swatch_file::{SwatchFile, SwatchFileError, read_aco, read_ase, read_gpl};

use super::context::{Mode, PanelContext, keep};
use super::controls::small_button;
use crate::chart::{Chart, Curve};
use crate::language::{layer_label, tr, tr_format};
use crate::theme;
use target::weights;

pub(super) use search::SearchPanel;
pub use target::{Color, TargetColor};
pub(super) use target::{LayerPaint, swatch};

/// State of the eyedropper panel: target colour, swatches and recipe search.
#[derive(Debug, Default)]
pub struct Eyedropper {
    target: Option<TargetColor>,
    /// Last colour of the reference picture that became the target.
    last_reference_color: Option<[f64; 3]>,
    text: String,
    fault: Option<String>,
    swatches: Vec<TargetColor>,
    search: SearchPanel,
}

impl Eyedropper {
    /// Whether a file has colour swatches, by its extension: `.gpl`, `.ase`, `.aco`.
    #[must_use]
    pub fn takes(path: &Path) -> bool {
        reader(path).is_some()
    }

    /// Loads the swatches of another painting program's palette. If this fails, the panel shows the
    /// error.
    pub fn open_swatches(&mut self, path: &Path) {
        self.fault = None;
        match colors(path) {
            Ok(palette) => self.swatches = wanted_of(&palette),
            Err(fault) => self.fault = Some(fault),
        }
    }

    /// Shows colours of another painting program as targets.
    pub fn set_swatches(&mut self, colors: &SwatchFile) {
        self.swatches = wanted_of(colors);
    }

    /// Target colour of the recipe search.
    #[must_use]
    pub fn target(&self) -> Option<&TargetColor> {
        self.target.as_ref()
    }

    /// Makes a colour the target and searches recipes for it.
    pub fn set_target(&mut self, ui: &Ui, cx: &PanelContext<'_>, wanted: TargetColor) {
        self.search.begin(ui, cx.painting, &wanted);
        self.target = Some(wanted);
        self.fault = None;
    }

    /// Draws the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        if cx.tools.reference_color != self.last_reference_color {
            self.last_reference_color = cx.tools.reference_color;
            if let Some(linear) = self.last_reference_color {
                self.set_target(
                    ui,
                    cx,
                    TargetColor::screen(tr("From the reference picture"), linear),
                );
            }
        }
        pick_controls(ui, cx);
        match cx.tools.picked.clone() {
            None => {
                ui.weak(tr(
                    "Click with the eyedropper, or with Alt held, to pick colour and paint.",
                ));
            }
            Some(picked) => {
                if show_picked(ui, cx, &picked) {
                    let name = tr_format!(
                        "Picked at {x_mm:.1}, {y_mm:.1} mm",
                        x_mm = picked.x_mm,
                        y_mm = picked.y_mm
                    );
                    let color = Color::Reflectance(Arc::new(picked.reflectance.clone()));
                    self.set_target(ui, cx, TargetColor { name, color });
                }
            }
        }
        ui.separator();
        self.target_row(ui, cx);
        self.search.show(ui, cx, self.target.as_ref());
    }

    fn target_row(&mut self, ui: &mut Ui, cx: &PanelContext<'_>) {
        let grid = cx.painting.library.grid;
        let viewing = &cx.painting.light.viewing;
        ui.horizontal(|ui| {
            if let Some(wanted) = &self.target {
                let color = wanted.shown(grid, viewing);
                let patch = swatch(ui, tr("Target colour"), vec2(40.0, 22.0), &[color]);
                let [l, a, b] = wanted.lab(grid, viewing).to_array();
                patch.on_hover_text(format!("{}: Lab {l:.2} {a:.2} {b:.2}", wanted.name));
            }
            let field = theme::text_field(&mut self.text)
                .hint_text(tr("Target: #rrggbb or L,a,b"))
                .desired_width(f32::INFINITY)
                .align(Align2::LEFT_CENTER);
            let field = ui.add(field).on_hover_text(
                tr("Target colour: sRGB as #rrggbb, or CIELAB as L,a,b under the light of the \
                 painting. Enter searches recipes for it"),
            );
            if field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
                match TargetColor::from_text(&self.text) {
                    Some(wanted) => self.set_target(ui, cx, wanted),
                    None => {
                        let found = self.text.trim();
                        self.fault = Some(tr_format!("A colour is #rrggbb or L,a,b, found `{found}`; try #4a7d8c or 52,-10,8", found));
                    }
                }
            }
        });
        if let Some(wanted) = &self.target {
            ui.weak(&wanted.name).on_hover_text(tr("Origin of the target colour"));
        }
        if let Some(fault) = &self.fault {
            ui.label(fault);
        }
        self.swatch_rows(ui, cx);
    }

    fn swatch_rows(&mut self, ui: &mut Ui, cx: &PanelContext<'_>) {
        if self.swatches.is_empty() {
            return;
        }
        let grid = cx.painting.library.grid;
        let viewing = &cx.painting.light.viewing;
        let mut clicked = None;
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = vec2(3.0, 3.0);
            for one in &self.swatches {
                let color = one.shown(grid, viewing);
                let patch = swatch(ui, &one.name, vec2(18.0, 18.0), &[color]);
                let hover = tr_format!("{name}. Click to search recipes for it", name = one.name);
                if patch.on_hover_text(hover).clicked() {
                    clicked = Some(one.clone());
                }
            }
        });
        if let Some(wanted) = clicked {
            self.set_target(ui, cx, wanted);
        }
    }
}

fn pick_controls(ui: &mut Ui, cx: &mut PanelContext<'_>) {
    ui.horizontal(|ui| {
        let picking = cx.tools.mode == Mode::Pick;
        let pick = ui.selectable_label(picking, tr("Eyedropper"));
        if pick.on_hover_text(tr("A click picks colour and paint; also with Alt held")).clicked() {
            cx.tools.mode = if picking { Mode::Paint } else { Mode::Pick };
        }
        let radius = DragValue::new(&mut cx.tools.pick_radius_mm)
            .range(0.0..=10.0)
            .speed(0.02)
            .fixed_decimals(1)
            .prefix(tr("radius "))
            .suffix(" mm");
        let radius = ui.add(radius).accessible_name(tr("Radius of the eyedropper"));
        radius.on_hover_text(tr("Radius of the averaged disc; 0 is one cell"));
    });
}

type Reader = fn(&str, &[u8]) -> Result<SwatchFile, SwatchFileError>;

fn reader(path: &Path) -> Option<Reader> {
    let ending = path.extension()?.to_str()?.to_ascii_lowercase();
    match ending.as_str() {
        "gpl" => Some(read_gpl),
        "ase" => Some(read_ase),
        "aco" => Some(read_aco),
        _ => None,
    }
}

fn colors(path: &Path) -> Result<SwatchFile, String> {
    let name = path.display().to_string();
    let reader = reader(path)
        .ok_or_else(|| tr_format!("{name}: expected a .gpl, .ase or .aco file", name))?;
    let bytes = disk::read(path).map_err(|error| format!("{name}: {error}"))?;
    reader(&name, &bytes).map_err(|error| error.to_string())
}

/// Converts swatches to target colours. This skips spot inks without a colour.
fn wanted_of(palette: &SwatchFile) -> Vec<TargetColor> {
    let swatches = palette.swatches.iter();
    let wanted = swatches.filter_map(|one| {
        let rgb = one.color.srgb()?;
        let name = if one.name.is_empty() { rgb.to_hex() } else { one.name.clone() };
        Some(TargetColor::screen(&name, rgb.linear().0))
    });
    wanted.collect()
}

/// Draws colour, spectrum and layers of the picked place. Returns whether you want recipes for its
/// colour.
fn show_picked(ui: &mut Ui, cx: &mut PanelContext<'_>, picked: &Picked) -> bool {
    let painting = cx.painting;
    let weights = weights(painting.library.grid, &painting.light.viewing);
    let appearance = Appearance::of(weights.xyz(&picked.reflectance), weights.white());
    ui.horizontal_top(|ui| {
        let patch = swatch(ui, tr("Picked colour"), vec2(68.0, 68.0), &[appearance.srgb]);
        patch
            .on_hover_text(tr("The colour as measured by an instrument: without relief and gloss"));
        numbers(ui, &appearance, picked);
    });
    let library = &painting.library;
    let color = appearance.srgb.to_bytes();
    let curve = Curve::new(tr("reflectance"), library.grid, &picked.reflectance).colored(color);
    let chart = Chart { curves: &[curve], marks: &[], quantity: tr("reflectance"), max: Some(1.0) };
    let chart = chart.show(ui, vec2(ui.available_width(), 110.0));
    chart.on_hover_text(tr("Reflectance over wavelength at the picked place"));
    let paints: Vec<Option<LayerPaint>> = picked.layers.iter().map(LayerPaint::of).collect();
    if paints.iter().all(Option::is_none) {
        ui.weak(tr("Bare ground"));
    }
    for (picked, paint) in picked.layers.iter().zip(&paints).rev() {
        if let Some(paint) = paint {
            let known = (cx.painting.library.as_ref(), &cx.painting.medium);
            layer(ui, known, &layer_label(&picked.label), paint);
        }
    }
    let mut recipes_requested = false;
    ui.horizontal_wrapped(|ui| {
        let has_wet = paints.last().is_some_and(Option::is_some);
        let load = ui.add_enabled(has_wet, Button::new(tr("Load the brush")));
        let load = load
            .on_hover_text(tr("Loads the selected brush with this wet paint"))
            .on_disabled_hover_text(tr("There is no wet paint at this place"));
        if load.clicked() {
            cx.command(Command::LoadPicked {
                brush: cx.tools.brush.clone(),
                picked: Box::new(picked.clone()),
                amount_mm: cx.tools.load_mm,
            });
        }
        let recipe = paints.last().and_then(Option::as_ref).map(|paint| paint.recipe(library));
        let kept = ui.add_enabled(has_wet, Button::new(tr("Keep")));
        let kept = kept.accessible_name(tr("Keep the picked paint"));
        let kept = kept
            .on_hover_text(tr("Keeps this wet mixture in the panel Swatches"))
            .on_disabled_hover_text(tr("There is no wet paint at this place"));
        if kept.clicked()
            && let Some((recipe, vehicle)) = recipe
        {
            keep(cx, recipe, vehicle);
        }
        let find = ui.button(tr("Find recipes"));
        recipes_requested =
            find.on_hover_text(tr("Searches recipes for the colour of this place")).clicked();
    });
    recipes_requested
}

fn three(values: [f64; 3]) -> String {
    values.map(|value| format!("{value:.2}")).join(" ")
}

fn numbers(ui: &mut Ui, appearance: &Appearance, picked: &Picked) {
    let grid = Grid::new("picked numbers").num_columns(2).min_row_height(16.0);
    grid.spacing(vec2(8.0, 1.0)).show(ui, |ui| {
        ui.weak("Lab").on_hover_text(tr("CIELAB under the light of the painting"));
        ui.monospace(three(appearance.lab.to_array()));
        ui.end_row();
        ui.weak("XYZ").on_hover_text(tr("Tristimulus values, 100 for the white"));
        ui.monospace(three(appearance.xyz.to_array()));
        ui.end_row();
        ui.weak("sRGB").on_hover_text(tr("As shown on the screen"));
        let note =
            if appearance.srgb.in_gamut() { "" } else { tr("  outside sRGB, shown clipped") };
        ui.monospace(format!("{}{note}", appearance.srgb.to_hex()));
        ui.end_row();
        let surface = match picked.surface {
            SurfaceId::Canvas => tr("Canvas"),
            SurfaceId::Palette => tr("Palette"),
        };
        ui.weak(surface).on_hover_text(tr("Where it was picked, from the upper left corner"));
        ui.monospace(format!("{:.1}, {:.1} mm", picked.x_mm, picked.y_mm));
        ui.end_row();
    });
}

/// Draws height and recipe of a layer's paint, with a button that copies it.
pub(super) fn layer(
    ui: &mut Ui,
    (library, medium): (&PigmentLibrary, &Medium),
    name: &str,
    paint: &LayerPaint,
) {
    ui.separator();
    ui.horizontal_wrapped(|ui| {
        ui.label(name);
        let mut details = format!("{:.3} mm", paint.thickness_mm);
        if paint.vehicle >= 0.005 {
            details += &tr_format!(", {vehicle:.0} % medium", vehicle = 100.0 * paint.vehicle);
        }
        if (paint.opacity - 1.0).abs() > 1e-9 {
            details += &tr_format!(", opacity {opacity:.2}", opacity = paint.opacity);
        }
        ui.weak(details)
            .on_hover_text(tr("Height of the paint, and how much of it is clear medium"));
        if let Some(text) = paint.mix_text(library, medium) {
            let copy = ui
                .add(small_button(ui, tr("Copy")))
                .accessible_name(tr_format!("Copy {name}", name));
            let hover =
                tr_format!("Copies the recipe as `impasto mix LIBRARY` takes it:\n{text}", text);
            if copy.on_hover_text(hover).clicked() {
                ui.ctx().copy_text(text);
            }
        }
    });
    recipe(ui, &tr_format!("parts of {name}", name), &paint.lines(library));
    if !paint.traces.is_empty() {
        let names = paint.traces.iter().map(|&trace| library[trace].name.as_str());
        ui.weak(tr_format!("traces of {names}", names = names.collect::<Vec<_>>().join(", ")));
    }
}

fn recipe(ui: &mut Ui, salt: &str, lines: &[(String, String)]) {
    let grid = Grid::new(salt).num_columns(2).min_row_height(16.0).spacing(vec2(8.0, 2.0));
    grid.show(ui, |ui| {
        for (amount, name) in lines {
            ui.monospace(format!("{amount:>6}"));
            ui.label(name);
            ui.end_row();
        }
    });
}
