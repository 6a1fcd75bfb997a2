//! The card that tells what is at a place of a scene.

use eframe::egui::{Area, Context, Frame, Grid, Id, Key, Order, Pos2, Sense, Ui, vec2};
use session::volumes::Here;

use crate::panels::controls::{millimetres, patch};

/// Draws the card beside `at`. Returns whether it stays: Escape and a click elsewhere close it.
pub fn show(context: &Context, at: Pos2, here: &Here) -> bool {
    let area = Area::new(Id::unique("here"))
        .order(Order::Foreground)
        .constrain(true)
        .fixed_pos(at + vec2(14.0, 14.0));
    let shown = area.show(context, |ui| {
        Frame::popup(ui.style()).show(ui, |ui| {
            ui.set_max_width(240.0);
            card(ui, here);
        });
    });
    let elsewhere = context.input(|input| input.pointer.any_pressed())
        && context
            .pointer_interact_pos()
            .is_some_and(|pointer| !shown.response.rect.contains(pointer));
    !elsewhere && !context.input(|input| input.key_pressed(Key::Escape))
}

fn card(ui: &mut Ui, here: &Here) {
    ui.horizontal(|ui| {
        let (rect, _) = ui.allocate_exact_size(vec2(34.0, 34.0), Sense::hover());
        patch(ui.painter(), rect, Some(here.srgb));
        ui.vertical(|ui| {
            let [lightness, a, b] = here.lab;
            ui.label(format!("L* {lightness:.1}  a* {a:.1}  b* {b:.1}"));
            let [red, green, blue] = here.srgb;
            ui.weak(format!("#{red:02x}{green:02x}{blue:02x}"));
        });
    });
    if here.place.is_none() {
        ui.label("There is no surface here.");
        return;
    }
    let volumes = match here.volumes {
        0 => "outside of all volumes".to_owned(),
        1 => "inside of 1 volume".to_owned(),
        count => format!("inside of {count} volumes"),
    };
    ui.label(match &here.region {
        Some(region) => format!("{volumes}, region {region}"),
        None => volumes,
    });
    if !here.paint.is_empty() {
        ui.separator();
        Grid::new("paint here").num_columns(2).spacing([14.0, 3.0]).show(ui, |ui| {
            for (name, height_mm) in &here.paint {
                ui.label(name);
                ui.label(millimetres(*height_mm));
                ui.end_row();
            }
        });
    }
}
