//! Colour, spectrum and paint at the last picked place.

use eframe::egui::{Button, Grid, Ui, vec2};
use paint::document::Medium;
use paint::strokes::SurfaceId;
use pigment::library::PigmentLibrary;
use pigment::palette::Appearance;

use super::super::context::PanelContext;
use super::super::controls::small_button;
use super::super::laying::keep;
use super::layer_paint::LayerPaint;
use super::swatch::swatch;
use super::target::weights;
use crate::chart::{Chart, Curve};
use crate::language::{layer_label, tr, tr_format};
use session::{Command, Picked};

/// Draws colour, spectrum and layers of the picked place. Returns whether recipes for
/// its colour are requested.
pub(super) fn show_picked(ui: &mut Ui, cx: &mut PanelContext<'_>, picked: &Picked) -> bool {
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

fn numbers(ui: &mut Ui, appearance: &Appearance, picked: &Picked) {
    let three = |values: [f64; 3]| values.map(|value| format!("{value:.2}")).join(" ");
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
pub(in crate::panels) fn layer(
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

/// Draws amounts and names in two columns.
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
