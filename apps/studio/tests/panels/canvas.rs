//! Tests of the surface view: the reference picture over the canvas, the frame of a crop, parts
//! that a stroke changes between two frames, and the quads' shader against egui's own.

use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;
use std::path::PathBuf;

use eframe::egui::{
    Area, Color32, ColorImage, Context, Event, Frame, Id, Key, Modifiers, Pos2, Rect,
    TextureHandle, TextureOptions, Ui, Vec2, pos2, vec2,
};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use graphics::export::linear_exr;
use graphics::field::Field;
use graphics::tile;
use image::{Rgb as Pixel, RgbImage, Rgba, RgbaImage};
use paint::strokes::SurfaceId;
use session::TilePixels;
use studio::app::{Between, CropTool};
use studio::panels::reference::Reference;
use studio::pen::{Device, PointerState, Report, ReportKind};
use studio::view::{DragMode, Drawing, Outline, Split, SurfaceView, ViewState, set_drawing};
use studio::{theme, view};
use web_time::{Duration, Instant};

use super::fixture::{PanelWindow, made_painting};
use super::harness::{Window, button};
use crate::harness::{has_adapter, keep};

/// Size of the test surfaces in cells. This is more than one chunk, and not a multiple of it.
const CELLS: (usize, usize) = (700, 530);

fn cell(x: usize, y: usize) -> [u8; 4] {
    [(x % 251) as u8, (y % 241) as u8, ((x / 16 + y / 16) % 2 * 255) as u8, 255]
}

/// A whole picture in tiles, as the worker reports it.
fn tiles(color: impl Fn(usize, usize) -> [u8; 4]) -> Vec<TilePixels> {
    let bounds = tile::Rect { x: 0, y: 0, width: CELLS.0, height: CELLS.1 };
    let tiles = tile::TileSet::all(bounds);
    tiles
        .iter()
        .map(|tile| {
            let rect = tile.rect(bounds);
            let rows = rect.y..rect.y + rect.height;
            let cells = rows.flat_map(|y| (rect.x..rect.x + rect.width).map(move |x| (x, y)));
            TilePixels { rect, pixels: cells.map(|(x, y)| color(x, y)).collect() }
        })
        .collect()
}

fn surface(outline: Outline) -> SurfaceView {
    let mut surface = SurfaceView::new("Canvas", outline, 10.0);
    surface.open(CELLS);
    tiles(cell).iter().for_each(|tile| surface.write(false, tile));
    surface
}

fn shown(
    surface: SurfaceView,
    size: Vec2,
    density: f32,
    split: Option<f32>,
) -> Harness<'static, SurfaceView> {
    shown_by(Drawing::default(), surface, size, density, split)
}

/// Like [`shown`], but you choose how the quads are drawn.
fn shown_by(
    drawing: Drawing,
    surface: SurfaceView,
    size: Vec2,
    density: f32,
    mut split: Option<f32>,
) -> Harness<'static, SurfaceView> {
    let mut harness = Harness::builder()
        .with_size(size)
        .with_pixels_per_point(density)
        .with_render_cursor(false)
        .with_context_setup(move |context| {
            theme::apply(context);
            set_drawing(context, drawing);
        })
        .build_ui_state(
            move |ui: &mut Ui, surface: &mut SurfaceView| {
                let room = ui.ctx().content_rect();
                ui.set_clip_rect(room);
                ui.painter().rect_filled(room, 0.0, theme::SURROUND);
                let split = split.as_mut().map(|at| Split { at, lights: ["D65", "A"] });
                surface.show(ui, room, DragMode::None, split);
            },
            surface,
        );
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
            // Tiles change only when their textures exist.
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
    // This is one of four chunks, and the edges of its neighbours.
    assert_eq!(first, 4 * 513 * 513);
    let text = tiles(|_, _| [9, 9, 9, 255]);
    // A visible tile, its neighbour, and an invisible one.
    for (x, y) in [(192, 192), (256, 192), (576, 64)] {
        let tile = text.iter().find(|tile| tile.rect.x == x && tile.rect.y == y).unwrap();
        harness.state_mut().write(false, tile);
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

fn near_edge(place: [usize; 2]) -> bool {
    let [x, y] = place;
    x < 3 || y < 3 || x + 4 > CELLS.0 || y + 4 > CELLS.1
}

fn file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name)
}

fn until(window: &mut Window, what: &str, done: impl Fn(&mut Window) -> bool) {
    let start = Instant::now();
    while !done(window) {
        assert!(start.elapsed() < Duration::from_secs(30), "waited for {what}");
        std::thread::sleep(Duration::from_millis(5));
        window.harness().step();
    }
    window.settle();
}

/// A window with a red picture of 300 x 100 pixels, pinned and laid over the canvas.
fn overlaid(name: &'static str) -> Window {
    let path = file(&format!("{name}.png"));
    RgbImage::from_pixel(300, 100, Pixel([200, 20, 20])).save(&path).unwrap();
    let mut window = Window::open(name);
    let context = window.harness().ctx.clone();
    window.studio_mut().panels.reference.open(&context, &path);
    window.key(Modifiers::NONE, Key::O);
    until(&mut window, "the picture", |window| window.studio().panels.reference.is_over_canvas());
    window
}

#[test]
fn the_reference_lies_over_the_canvas_and_is_never_painted() {
    let mut window = overlaid("over-canvas");
    let history = window.studio().painting().unwrap().history.clone();
    // The fitted picture is as wide as the canvas of 32 x 20 mm, and 10.7 mm high.
    let inside = window.point(SurfaceId::Canvas, 25.0, 10.0);
    let beside = window.point(SurfaceId::Canvas, 25.0, 2.0);
    if let Some(picture) = window.picture() {
        let [red, green, _] = window.color(&picture, inside);
        assert!(
            i16::from(red) > i16::from(green) + 40,
            "the picture shines through: {red} {green}"
        );
        let [red, green, blue] = window.color(&picture, beside);
        assert!(red.abs_diff(green) < 20 && green.abs_diff(blue) < 30, "bare linen beside it");
    }
    window.save("over-canvas-window");
    window.key(Modifiers::NONE, Key::O);
    if let Some(picture) = window.picture() {
        let [red, green, _] = window.color(&picture, inside);
        assert!(i16::from(red) < i16::from(green) + 20, "it is gone: {red} {green}");
    }
    assert_eq!(window.studio().painting().unwrap().history, history, "nothing was painted");
}

#[test]
fn the_pen_moves_the_reference_only_while_that_is_on() {
    let mut window = overlaid("over-canvas-moved");
    window.click("Move");
    let done = window.studio().painting().unwrap().history_done;
    let from = window.point(SurfaceId::Canvas, 16.0, 10.0);
    window.pen_stroke(&[from, from + vec2(0.0, 40.0), from + vec2(0.0, 80.0)]);
    window.settle();
    assert_eq!(window.studio().painting().unwrap().history_done, done, "no stroke");
    let top = window.point(SurfaceId::Canvas, 16.0, 6.0);
    window.save("over-canvas-moving");
    if let Some(picture) = window.picture() {
        let [red, green, _] = window.color(&picture, top);
        assert!(
            i16::from(red) < i16::from(green) + 20,
            "the picture has moved down: {red} {green}"
        );
    }
    window.click("Move");
    window.pen_stroke(&[from, from + vec2(40.0, 0.0), from + vec2(80.0, 0.0)]);
    window.settle();
    assert!(window.studio().painting().unwrap().history_done > done, "now the pen paints");
}

#[test]
fn a_crop_is_framed_with_handles_and_applied_with_enter() {
    let mut window = Window::open("crop");
    let from = window.point(SurfaceId::Canvas, 4.0, 10.0);
    window.pen_stroke(&[from, from + vec2(60.0, 0.0), from + vec2(120.0, 0.0)]);
    window.settle();
    let history = window.studio().painting().unwrap().history_done;
    window.click("Edit");
    window.harness().get_by_label_contains("Crop...").click();
    window.settle();
    let canvas = window.studio().canvas.rect();
    for name in ["Crop", "Cancel", "Shape of the crop"] {
        let rect = window.harness().get_by_label(name).rect();
        assert!(rect.bottom() <= canvas.top(), "{name} covers the picture: {rect} {canvas}");
    }
    let handle = window.harness().get_by_label("Crop right").rect().center();
    let to = window.point(SurfaceId::Canvas, 20.0, 10.0);
    window.pen_stroke(&[handle, handle.lerp(to, 0.5), to]);
    window.save("crop-window");
    assert!(window.harness().query_by_label("20.0 x 20.0 mm").is_some(), "you see its size");
    let painting = window.studio().painting().unwrap();
    assert_eq!((painting.history_done, painting.canvas_cells), (history, (320, 200)));
    window.key(Modifiers::NONE, Key::Enter);
    until(&mut window, "the part", |window| {
        window.studio().painting().is_some_and(|painting| painting.canvas_cells == (200, 200))
    });
    assert!(window.studio().crop.is_none(), "the frame is gone");
    assert!(window.studio().files.has_unsaved_changes(), "the part is in no file");
    assert_eq!(window.studio().painting().unwrap().history_done, 0, "undo ends at a crop");
}

#[test]
fn a_handle_of_a_crop_follows_to_the_place_of_its_release() {
    let mut window = Window::open("crop-release");
    window.studio_mut().crop = Some(CropTool::new((320, 200)));
    window.settle();
    let handle = window.harness().get_by_label("Crop right").rect().center();
    let to = window.point(SurfaceId::Canvas, 20.0, 10.0);
    window.frame(vec![Event::PointerMoved(handle), button(handle, true)]);
    window.frame(vec![Event::PointerMoved(handle.lerp(to, 0.5))]);
    window.frame(vec![Event::PointerMoved(to), button(to, false)]);
    window.settle();
    assert!(window.harness().query_by_label("20.0 x 20.0 mm").is_some(), "as far as the pen went");
}

#[test]
fn escape_leaves_a_crop() {
    let mut window = Window::open("crop-left");
    window.click("Edit");
    window.harness().get_by_label_contains("Crop...").click();
    window.settle();
    assert!(window.studio().crop.is_some(), "it is framed");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(window.studio().crop.is_none());
    assert_eq!(window.studio().painting().unwrap().canvas_cells, (320, 200));
}

#[test]
fn an_exr_of_a_scene_has_an_exposure() {
    let path = file("scene-linear.exr");
    let picture = Field::filled(40, 20, [0.05, 0.1, 0.02, 1.0]);
    std::fs::write(&path, linear_exr(&picture, 0.1).unwrap()).unwrap();
    let mut stage = PanelWindow::new(
        Reference::default(),
        vec2(460.0, 360.0),
        made_painting(),
        Reference::show,
    );
    let context = stage.harness.ctx.clone();
    stage.state().panel.open(&context, &path);
    let start = Instant::now();
    while stage.harness.query_by_label("Exposure").is_none() {
        assert!(start.elapsed() < Duration::from_secs(30), "no exposure is offered");
        std::thread::sleep(Duration::from_millis(5));
        stage.harness.step();
    }
    stage.run();
    stage.save("reference-exr");
    let place = stage.harness.get_by_label("Reference picture").rect().center();
    stage.drag(&[place, place]);
    let picked = stage.state().tools.reference_color.take().unwrap();
    for (found, wanted) in picked.iter().zip([0.05, 0.1, 0.02]) {
        assert!((found - wanted).abs() < 1e-6, "{picked:?}");
    }
}

fn hold(window: &mut Window, x_mm: f64, kind: impl Fn(PointerState) -> ReportKind) {
    let at = window.point(SurfaceId::Canvas, x_mm, 9.0);
    let state =
        PointerState { at, pressure: Some(0.6), tilt_deg: Some((15.0, 5.0)), twist_deg: Some(0.0) };
    let report = Report { device: Device::Pen, arrived: Instant::now(), kind: kind(state) };
    window.studio_mut().pen.feed(report);
}

/// A window with an open stroke of a stylus.
fn in_stroke(name: &'static str) -> (Window, Context) {
    let mut window = Window::open(name);
    window.click("Load brush");
    window.settle();
    hold(&mut window, 6.0, ReportKind::Pressed);
    window.frame(Vec::new());
    let context = window.harness().ctx.clone();
    (window, context)
}

/// Moves the stylus from 6 to 24 mm without frames. Returns what was shown.
fn moved(window: &mut Window, context: &Context) -> Vec<Between> {
    let mut shown = Vec::new();
    let mut show = |window: &mut Window| {
        let part = window.studio_mut().between(context).expect("shown between frames");
        shown.extend(Some(part).filter(|part| part.patch.width > 0));
    };
    for step in 1..=36 {
        hold(window, 6.0 + 0.5 * f64::from(step), ReportKind::Moved);
        std::thread::sleep(Duration::from_millis(5));
        show(window);
    }
    // The last paint comes from the worker later.
    window.settle_by(show);
    shown
}

#[test]
fn parts_between_frames_show_the_pixels_of_the_next_frame() {
    for (turn, mirror) in [(0.0, false), (0.4, true)] {
        let (mut window, context) = in_stroke("between");
        window.studio_mut().canvas.view.rotation = turn;
        window.studio_mut().canvas.view.mirror = mirror;
        window.frame(Vec::new());
        let Some(mut shown) = window.picture() else { return };
        let before = shown.clone();
        let parts = moved(&mut window, &context);
        assert!(parts.len() > 5, "{} parts", parts.len());
        for Between { patch, .. } in &parts {
            let pixels =
                RgbaImage::from_raw(patch.width as u32, patch.height as u32, patch.rgba.clone());
            image::imageops::replace(
                &mut shown,
                &pixels.unwrap(),
                patch.left as i64,
                patch.top as i64,
            );
        }
        window.frame(Vec::new());
        let whole = window.picture().unwrap();
        let head = parts.last().and_then(|part| part.head.bounds()).unwrap().expand(2.0);
        let view = window.studio().canvas.rect();
        let mut painted = 0;
        let mut far = Vec::new();
        for (x, y, pixel) in whole.enumerate_pixels() {
            let at = Pos2::new(x as f32 + 0.5, y as f32 + 0.5);
            if !view.contains(at) || head.contains(at) {
                continue;
            }
            painted += usize::from(differ(pixel, before.get_pixel(x, y)) > 8);
            let by = differ(pixel, shown.get_pixel(x, y));
            far.extend((by > 3).then_some((x, y, by)));
        }
        assert!(painted > 2000, "the stroke is seen: {painted} pixels, turn {turn}");
        assert!(far.is_empty(), "{} pixels differ, turn {turn}: {:?}", far.len(), far.first());
    }
}

fn differ(a: &Rgba<u8>, b: &Rgba<u8>) -> u8 {
    a.0.iter().zip(b.0).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0)
}

#[test]
fn a_part_has_the_whole_head_and_lies_within_the_canvas() {
    let (mut window, context) = in_stroke("between-head");
    // The stroke leaves the view.
    window.studio_mut().canvas.view.fitted = false;
    window.studio_mut().canvas.view.zoom = 8.0;
    window.frame(Vec::new());
    let view = window.studio().canvas.rect();
    for Between { patch, head } in moved(&mut window, &context) {
        let min = Pos2::new(patch.left as f32, patch.top as f32);
        let max = min + vec2(patch.width as f32, patch.height as f32);
        let part = Rect::from_min_max(min, max);
        assert!(view.expand(1.0).contains_rect(part), "{part} within {view}");
        let bounds = head.bounds().map_or(part, |bounds| bounds.intersect(view));
        assert!(part.expand(1.0).contains_rect(bounds), "{bounds} within {part}");
    }
}

#[test]
fn frames_show_what_is_more_than_paint_and_head() {
    let (mut window, context) = in_stroke("between-more");
    assert!(window.studio_mut().between(&context).is_some());
    window.studio_mut().aids.symmetry.on = true;
    assert!(window.studio_mut().between(&context).is_none(), "the axis of symmetry lies over it");
    window.studio_mut().aids.symmetry.on = false;
    window.studio_mut().tools.figures = true;
    assert!(window.studio_mut().between(&context).is_none(), "and the figures");
    window.studio_mut().tools.figures = false;
    assert!(window.studio_mut().between(&context).is_some());
    hold(&mut window, 6.0, |_| ReportKind::Released);
    let _ = window.studio_mut().between(&context);
    assert!(!window.studio().pen.is_down(), "the pen is lifted without a frame");
    assert!(window.studio_mut().between(&context).is_none(), "no stroke is open");
}

/// Largest difference of a channel. Both shaders round, and egui's shader filters by itself in
/// tests.
const NEAR: u8 = 3;

/// Shows widgets, text of two sizes, a picture that changes, and a translucent card over them.
fn show(ui: &mut Ui, state: &mut (usize, Option<TextureHandle>)) {
    let (frame, picture) = state;
    fn image(side: usize, value: u8) -> ColorImage {
        ColorImage::filled([side, side], Color32::from_rgb(value, 255 - value, 90))
    }
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

fn rendered(setup: impl Fn(&Context) + 'static, density: f32) -> RgbaImage {
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
        let by_egui = rendered(theme::apply, density);
        let by_quads = rendered(
            |context: &Context| {
                theme::apply(context);
                view::draw_meshes(context);
            },
            density,
        );
        assert_eq!(by_egui.dimensions(), by_quads.dimensions());
        let colors: BTreeSet<[u8; 4]> = by_egui.pixels().map(|pixel| pixel.0).collect();
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
