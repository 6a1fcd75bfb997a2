//! Tests of the surface view.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use crate::harness::{has_adapter, keep};
use eframe::egui::{Ui, Vec2, pos2, vec2};
use egui_kittest::Harness;
use graphics::tile;
use image::RgbaImage;
use session::TilePixels;
use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;
use studio::theme;
use studio::view::{DragMode, Drawing, Outline, Split, SurfaceView, ViewState, set_drawing};

/// Size of the test surfaces in cells: more than one chunk, not a multiple of it.
const CELLS: (usize, usize) = (700, 530);

/// Colour of a cell; neighbouring cells differ.
fn cell(x: usize, y: usize) -> [u8; 4] {
    [(x % 251) as u8, (y % 241) as u8, ((x / 16 + y / 16) % 2 * 255) as u8, 255]
}

/// A whole picture in tiles, as the worker reports it.
fn tiles(color: impl Fn(usize, usize) -> [u8; 4]) -> Vec<TilePixels> {
    let bounds = tile::Rect { x: 0, y: 0, width: CELLS.0, height: CELLS.1 };
    let pixels = |rect: tile::Rect| {
        let rows = rect.y..rect.y + rect.height;
        rows.flat_map(|y| (rect.x..rect.x + rect.width).map(move |x| (x, y)))
            .map(|(x, y)| color(x, y))
            .collect()
    };
    let rects = tile::TileSet::all(bounds);
    let rects = rects.iter().map(|tile| tile.rect(bounds));
    rects.map(|rect| TilePixels { rect, pixels: pixels(rect) }).collect()
}

fn surface(outline: Outline) -> SurfaceView {
    let mut surface = SurfaceView::new("Canvas", outline, 10.0);
    surface.open(CELLS);
    tiles(cell).iter().for_each(|tile| surface.write(false, tile));
    surface
}

/// Creates a window that shows only a surface.
fn shown(
    surface: SurfaceView,
    size: Vec2,
    density: f32,
    split: Option<f32>,
) -> Harness<'static, SurfaceView> {
    shown_by(Drawing::default(), surface, size, density, split)
}

/// Creates such a window whose quads are drawn in this way.
fn shown_by(
    drawing: Drawing,
    surface: SurfaceView,
    size: Vec2,
    density: f32,
    mut split: Option<f32>,
) -> Harness<'static, SurfaceView> {
    let show = move |ui: &mut Ui, surface: &mut SurfaceView| {
        let room = ui.ctx().content_rect();
        ui.set_clip_rect(room);
        ui.painter().rect_filled(room, 0.0, theme::SURROUND);
        let split = split.as_mut().map(|at| Split { at, lights: ["D65", "A"] });
        surface.show(ui, room, DragMode::None, split);
    };
    let mut harness = Harness::builder()
        .with_size(size)
        .with_pixels_per_point(density)
        .with_render_cursor(false)
        .with_context_setup(move |context| {
            theme::apply(context);
            set_drawing(context, drawing);
        })
        .build_ui_state(show, surface);
    harness.run();
    harness
}

/// Renders a surface if there is an adapter.
fn drawn(
    surface: SurfaceView,
    size: Vec2,
    density: f32,
    split: Option<f32>,
) -> (SurfaceView, Option<RgbaImage>) {
    let mut harness = shown(surface, size, density, split);
    let picture = has_adapter().then(|| harness.render().unwrap());
    (harness.into_state(), picture)
}

fn pixel(picture: &RgbaImage, x: u32, y: u32) -> [u8; 4] {
    picture.get_pixel(x, y).0
}

#[test]
fn at_actual_size_every_pixel_shows_its_cell() {
    for (density, rotation, mirror) in
        [(1.0, 0.0, false), (2.0, 0.0, true), (1.0, FRAC_PI_2, false), (1.5, 2.0 * FRAC_PI_2, true)]
    {
        let mut surface = surface(Outline::Rectangle);
        surface.view =
            ViewState { centre: [402.0, 311.0], zoom: 1.0, rotation, mirror, fitted: false };
        let (surface, picture) = drawn(surface, vec2(400.0, 300.0), density, None);
        let Some(picture) = picture else { return };
        let placement = surface.placement();
        for y in (0..picture.height()).step_by(3) {
            for x in (0..picture.width()).step_by(3) {
                let middle = pos2(x as f32 + 0.5, y as f32 + 0.5) / density;
                let place = placement.cell(middle).map(|cells| cells.floor() as usize);
                if surface.position(middle).is_some() && !near_edge(place) {
                    let wanted = cell(place[0], place[1]);
                    assert_eq!(pixel(&picture, x, y), wanted, "{x} {y} {place:?} {density}");
                }
            }
        }
    }
}

#[test]
fn rotated_and_mirrored_cells_are_drawn_where_the_view_places_them() {
    for (rotation, mirror) in [(0.0, false), (0.7, false), (2.5, true)] {
        let mut surface = surface(Outline::Rectangle);
        // Around the common corner of four chunks.
        surface.view =
            ViewState { centre: [511.0, 509.0], zoom: 7.0, rotation, mirror, fitted: false };
        let (surface, picture) = drawn(surface, vec2(300.0, 200.0), 1.0, None);
        let Some(picture) = picture else { return };
        let placement = surface.placement();
        let mut seen = 0;
        for y in 0..picture.height() {
            for x in 0..picture.width() {
                let middle = pos2(x as f32 + 0.5, y as f32 + 0.5);
                let place = placement.cell(middle);
                let inside = place.iter().all(|cells| (0.2..0.8).contains(&cells.fract()));
                let place = place.map(|cells| cells.floor() as usize);
                if inside && surface.position(middle).is_some() && !near_edge(place) {
                    seen += 1;
                    let wanted = cell(place[0], place[1]);
                    assert_eq!(pixel(&picture, x, y), wanted, "{x} {y} {place:?} {rotation}");
                }
            }
        }
        assert!(seen > 5_000, "{seen} pixels seen");
    }
}

#[test]
fn egui_draws_what_the_shader_of_quads_draws() {
    for (zoom, rotation, mirror, split) in [
        (1.0, 0.0, false, None),
        (7.0, 0.7, true, None),
        (1.6, 0.0, false, Some(0.4)),
        (0.37, 0.3, false, None),
    ] {
        let [own, by_egui] = [Drawing::default(), Drawing::Egui].map(|drawing| {
            let mut surface = surface(Outline::Rectangle);
            surface.view =
                ViewState { centre: [511.0, 509.0], zoom, rotation, mirror, fitted: false };
            let mut harness = shown_by(drawing, surface, vec2(300.0, 200.0), 1.0, split);
            // Tiles change when their textures are there.
            let around = tile::Rect { x: 505, y: 500, width: 40, height: 20 };
            let changed = tiles(|x: usize, y: usize| cell(x, y).map(|channel| channel / 2 + 127))
                .into_iter()
                .filter(|tile| !tile.rect.intersection(around).is_empty());
            changed.for_each(|tile| harness.state_mut().write(false, &tile));
            harness.run();
            has_adapter().then(|| harness.render().unwrap())
        });
        let (Some(own), Some(by_egui)) = (own, by_egui) else { return };
        for (x, y, one) in own.enumerate_pixels() {
            let other = by_egui.get_pixel(x, y);
            assert!(
                (0..4).all(|i: usize| one[i].abs_diff(other[i]) <= 3),
                "{x} {y} at {zoom}: {one:?}, not {other:?}"
            );
        }
        let colors: BTreeSet<[u8; 4]> = own.pixels().map(|pixel| pixel.0).collect();
        assert!(colors.len() > 100, "{} colours at {zoom}", colors.len());
    }
}

#[test]
fn a_reduced_fine_pattern_keeps_its_mean_light() {
    for zoom in [0.5, 0.37, 0.21] {
        let mut other = SurfaceView::new("Canvas", Outline::Rectangle, 10.0);
        other.open(CELLS);
        tiles(|x: usize, y: usize| [[0, 0, 0, 255], [255; 4]][(x + y) % 2])
            .iter()
            .for_each(|tile| other.write(false, tile));
        other.view = ViewState { centre: [350.0, 265.0], zoom, rotation: 0.3, ..other.view };
        other.view.fitted = false;
        let (_, picture) = drawn(other, vec2(100.0, 80.0), 1.0, None);
        let Some(picture) = picture else { return };
        for (x, y) in [(50, 40), (31, 44), (60, 30)] {
            // Half of the light, in sRGB.
            assert_eq!(pixel(&picture, x, y), [188, 188, 188, 255], "{x} {y} at {zoom}");
        }
    }
}

#[test]
fn the_split_line_separates_two_pictures_at_any_rotation() {
    let white = [255; 4];
    let black = [0, 0, 0, 255];
    for (rotation, mirror) in [(0.0, false), (1.1, false), (0.4, true)] {
        let mut surface = SurfaceView::new("Canvas", Outline::Rectangle, 10.0);
        surface.open(CELLS);
        surface.set_second(true);
        tiles(|_, _| white).iter().for_each(|tile| surface.write(false, tile));
        tiles(|_, _| black).iter().for_each(|tile| surface.write(true, tile));
        surface.view =
            ViewState { centre: [350.0, 265.0], zoom: 0.3, rotation, mirror, fitted: false };
        let (surface, picture) = drawn(surface, vec2(400.0, 400.0), 1.0, Some(0.25));
        let Some(picture) = picture else { return };
        for (column, wanted) in [(20.0, white), (150.0, white), (200.0, black), (680.0, black)] {
            let at = surface.placement().point([column, 40.0]);
            assert_eq!(pixel(&picture, at.x as u32, at.y as u32), wanted, "{column} {rotation}");
        }
    }
}

#[test]
fn only_changed_and_visible_tiles_are_uploaded() {
    let mut surface = surface(Outline::Rectangle);
    surface.view =
        ViewState { centre: [256.0, 256.0], zoom: 1.0, fitted: false, ..ViewState::default() };
    let mut harness = shown(surface, vec2(100.0, 100.0), 1.0, None);
    let bytes = |harness: &Harness<SurfaceView>| harness.state().picture(false).unwrap().uploaded();
    let first = bytes(&harness);
    // One of four chunks, and the edges of its neighbours.
    assert_eq!(first, 4 * 513 * 513);
    let text = tiles(|_, _| [9, 9, 9, 255]);
    let at =
        |x: usize, y: usize| text.iter().find(|tile| tile.rect.x == x && tile.rect.y == y).unwrap();
    // A visible tile, its neighbour, and an invisible one.
    for (x, y) in [(192, 192), (256, 192), (576, 64)] {
        harness.state_mut().write(false, at(x, y));
    }
    harness.run();
    assert_eq!(bytes(&harness) - first, 4 * 128 * 64);
    harness.run();
    assert_eq!(bytes(&harness) - first, 4 * 128 * 64, "nothing twice");
    if !has_adapter() {
        return;
    }
    let picture = harness.render().unwrap();
    let placement = harness.state().placement();
    for (place, wanted) in [([240, 230], [9, 9, 9, 255]), ([240, 270], cell(240, 270))] {
        let at = placement.point(place.map(|cells| cells as f64 + 0.5));
        assert_eq!(pixel(&picture, at.x as u32, at.y as u32), wanted, "{place:?}");
    }
}

#[test]
fn the_hole_of_the_palette_shows_the_surround() {
    let (surface, picture) = drawn(surface(Outline::Palette), vec2(500.0, 400.0), 1.0, None);
    let hole = surface.placement().point([700.0 - 0.24 * 530.0, 530.0 - 0.24 * 530.0]);
    assert_eq!(surface.position(hole), None);
    let Some(picture) = picture else { return };
    keep(&picture, "palette");
    let grey = theme::SURROUND.r();
    for at in [hole, surface.placement().point([6.0, 6.0])] {
        assert_eq!(pixel(&picture, at.x as u32, at.y as u32), [grey, grey, grey, 255], "{at}");
    }
    let on = surface.placement().point([350.0, 200.0]);
    assert_ne!(pixel(&picture, on.x as u32, on.y as u32), [grey, grey, grey, 255]);
}

/// Whether a place is near the drawn outline.
fn near_edge(place: [usize; 2]) -> bool {
    let [x, y] = place;
    x < 3 || y < 3 || x + 4 > CELLS.0 || y + 4 > CELLS.1
}
