//! The interface drawn by the quads' shader against egui's own.

use eframe::egui::{
    Area, Color32, ColorImage, Context, Frame, Id, TextureHandle, TextureOptions, Ui, pos2, vec2,
};
use egui_kittest::Harness;
use image::RgbaImage;
use studio::{theme, view};

use super::harness::has_adapter;

/// Largest difference of a channel: both round, and egui's shader filters by itself in tests.
const NEAR: u8 = 3;

/// Widgets, text of two sizes, a picture that changes, and a translucent card over them.
fn show(ui: &mut Ui, state: &mut (usize, Option<TextureHandle>)) {
    let (frame, picture) = state;
    let image = |side: usize, value: u8| {
        ColorImage::filled([side, side], Color32::from_rgb(value, 255 - value, 90))
    };
    let options = TextureOptions::NEAREST;
    let picture =
        picture.get_or_insert_with(|| ui.ctx().load_texture("picture", image(16, 20), options));
    if *frame == 3 {
        picture.set_partial([4, 2], image(6, 200), options);
    }
    ui.heading("Titanium White");
    ui.label("0.30 mm at the tip, 15 % medium");
    if *frame > 1 {
        ui.label("Later glyphs: \u{e4}\u{f6}\u{fc} @ # { } ~");
    }
    ui.add_enabled_ui(false, |ui| ui.button("Load brush"));
    ui.image((picture.id(), vec2(80.0, 80.0)));
    Area::new(Id::unique("card")).fixed_pos(pos2(60.0, 90.0)).show(ui.ctx(), |ui| {
        let translucent = Frame::new().fill(Color32::from_rgba_unmultiplied(200, 40, 30, 120));
        translucent.corner_radius(9).inner_margin(14).show(ui, |ui| ui.label("over the picture"));
    });
    *frame += 1;
}

fn drawn(setup: impl Fn(&Context) + 'static, density: f32) -> RgbaImage {
    let mut harness = Harness::builder()
        .with_size(vec2(310.0, 230.0))
        .with_pixels_per_point(density)
        .with_render_cursor(false)
        .with_context_setup(setup)
        .build_ui_state(show, (0, None));
    harness.run_steps(6);
    harness.render().unwrap()
}

#[test]
fn the_interface_looks_alike_with_either_shader() {
    if !has_adapter() {
        return;
    }
    for density in [1.0, 1.5] {
        let by_egui = drawn(theme::apply, density);
        let quick = |context: &Context| {
            theme::apply(context);
            view::draw_meshes(context);
        };
        let by_quads = drawn(quick, density);
        assert_eq!(by_egui.dimensions(), by_quads.dimensions());
        let colors: std::collections::BTreeSet<[u8; 4]> =
            by_egui.pixels().map(|pixel| pixel.0).collect();
        assert!(colors.len() > 60, "a picture with {} colours", colors.len());
        for (x, y, pixel) in by_egui.enumerate_pixels() {
            let other = by_quads.get_pixel(x, y);
            assert!(
                (0..3).all(|i: usize| pixel[i].abs_diff(other[i]) <= NEAR),
                "({x}, {y}) at {density}: {pixel:?}, not {other:?}"
            );
        }
    }
}
