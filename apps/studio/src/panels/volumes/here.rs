//! What is at a place of a scene: a card beside the pointer, and the panel that keeps it.

use eframe::egui::{Area, Context, Frame, Grid, Id, Key, Order, Pos2, Ui, vec2};
use paint::document::Medium;
use pigment::library::PigmentLibrary;
use session::volumes::{Here, SceneState};
use spectra::color::Rgb;

use super::context::SceneContext;
use crate::chart::{Chart, Curve};
use crate::language::{tr, tr_format};
use crate::panels::eyedropper::{LayerPaint, layer, swatch};

/// Draws the card beside `at`. Returns whether it stays: Escape and a click elsewhere close it.
pub fn show(context: &Context, at: Pos2, here: &Here, state: &SceneState) -> bool {
    let area = Area::new(Id::unique("here"))
        .order(Order::Foreground)
        .constrain(true)
        .fixed_pos(at + vec2(14.0, 14.0));
    let shown = area.show(context, |ui| {
        Frame::popup(ui.style()).show(ui, |ui| {
            ui.set_max_width(250.0);
            found(ui, here, &state.library);
        });
    });
    let elsewhere = context.input(|input| input.pointer.any_pressed())
        && context
            .pointer_interact_pos()
            .is_some_and(|pointer| !shown.response.rect.contains(pointer));
    !elsewhere && !context.input(|input| input.key_pressed(Key::Escape))
}

/// Draws the panel with the last answer.
pub(super) fn show_panel(ui: &mut Ui, cx: &SceneContext<'_>) {
    let Some(here) = &cx.tools.here else {
        ui.weak(tr("Right-click the scene to tell which paint lies there, and its colour."));
        return;
    };
    let library = &cx.state.library;
    found(ui, here, library);
    let paint = here.paint.as_ref().and_then(LayerPaint::of);
    let Some(paint) = paint.filter(|paint| !paint.shares.is_empty()) else { return };
    let Ok(mixture) = library.mix(&paint.shares) else { return };
    ui.separator();
    let reflectance = mixture.hiding(library.saunderson);
    let curve = Curve::new(tr("this paint"), library.grid, &reflectance);
    let chart = Chart { curves: &[curve], marks: &[], quantity: tr("reflectance"), max: Some(1.0) };
    let chart = chart.show(ui, vec2(ui.available_width(), 110.0));
    chart.on_hover_text(tr(
        "Reflectance of this paint over wavelength, where it is so thick that it hides",
    ));
}

/// Draws colour, place, region and paint.
fn found(ui: &mut Ui, here: &Here, library: &PigmentLibrary) {
    ui.horizontal_top(|ui| {
        let rgb = Rgb(here.srgb.map(|channel| f64::from(channel) / 255.0));
        let patch = swatch(ui, tr("Colour here"), vec2(52.0, 52.0), &[rgb]);
        patch.on_hover_text(tr("The colour as the screen shows it"));
        numbers(ui, here);
    });
    let Some(place) = here.place else {
        ui.label(tr("There is no surface here."));
        return;
    };
    let volumes = match here.volumes {
        0 => tr("outside of all volumes").to_owned(),
        1 => tr("inside of 1 volume").to_owned(),
        count => tr_format!("inside of {count} volumes", count),
    };
    ui.label(match &here.region {
        Some(region) => tr_format!("{volumes}, region {region}", volumes, region),
        None => volumes,
    })
    .on_hover_text(tr_format!(
        "At {x:.3}, {y:.3}, {z:.3} of the model",
        x = place.x,
        y = place.y,
        z = place.z
    ));
    if let Some(paint) = here.paint.as_ref().and_then(LayerPaint::of) {
        layer(ui, (library, &Medium::of(library)), tr("Paint"), &paint);
    }
}

fn numbers(ui: &mut Ui, here: &Here) {
    let grid = Grid::new("numbers here").num_columns(2).min_row_height(16.0);
    grid.spacing(vec2(8.0, 1.0)).show(ui, |ui| {
        ui.weak("Lab")
            .on_hover_text(tr("CIELAB of the colour shown, against the white of the screen"));
        ui.monospace(here.lab.map(|value| format!("{value:.2}")).join(" "));
        ui.end_row();
        ui.weak("sRGB").on_hover_text(tr("As shown on the screen"));
        let [red, green, blue] = here.srgb;
        ui.monospace(format!("#{red:02x}{green:02x}{blue:02x}"));
        ui.end_row();
    });
}
