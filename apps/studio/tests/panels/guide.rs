//! The first steps over the painting, the sample painting, the cursor, and the palette's light.

use eframe::egui::{Key, Modifiers, Pos2, Shape, Theme, Vec2, vec2};
use egui_kittest::kittest::Queryable;
use graphics::tile::Rect;
use paint::document::Lighting;
use paint::strokes::{Action, Squeeze, SurfaceId};
use session::Command;

use super::glyphs::drawn_texts;
use super::harness::Window;

const SIZE: Vec2 = vec2(1280.0, 800.0);

/// Whether the window draws a text that contains `words`.
fn draws(window: &mut Window, words: &str) -> bool {
    drawn_texts(window).iter().any(|(_, text)| text.contains(words))
}

/// Where the window draws a text that contains `words`.
fn place_of_text(window: &mut Window, words: &str) -> Option<eframe::egui::Rect> {
    window.harness().output().shapes.iter().find_map(|clipped| match &clipped.shape {
        Shape::Text(text) if text.galley.text().contains(words) => {
            Some(text.visual_bounding_rect())
        }
        _ => None,
    })
}

fn choose(window: &mut Window, menu: &str, entry: &str) {
    window.harness().get_all_by_label(menu).next().unwrap().click();
    window.harness().run_ok();
    window.click(entry);
}

fn done(window: &Window) -> usize {
    window.studio().painting().unwrap().history_done
}

#[test]
fn the_first_steps_are_gone_at_the_first_stroke_and_back_under_help() {
    let mut window = Window::first_start("first-steps", SIZE);
    for theme in [Theme::Light, Theme::Dark] {
        window.harness().ctx.set_theme(theme);
        window.harness().run_ok();
        window.save(&format!("first-steps-{theme:?}"));
    }
    for words in ["Double click a tube", "W washes it", "D dries", "Alt + click tells"] {
        assert!(draws(&mut window, words), "{words} is not shown");
    }
    let before = done(&window);
    // Over the lines: they take no clicks.
    let from = window.studio().canvas.rect().center_top() + vec2(-60.0, 40.0);
    let on = window.studio().canvas.position(from).is_some();
    let from = if on { from } else { window.studio().canvas.rect().center() };
    window.pen_stroke(&[from, from + vec2(30.0, 8.0), from + vec2(60.0, 14.0)]);
    window.settle();
    assert_eq!(done(&window), before + 1, "the stroke was painted");
    assert!(!draws(&mut window, "Double click a tube"), "the first stroke hides them");
    assert!(window.studio().files.preferences.first_steps_seen, "they were seen");
    choose(&mut window, "Help", "First steps");
    assert!(draws(&mut window, "Double click a tube"), "back under Help");
}

#[test]
fn the_first_steps_tell_the_keys_in_use() {
    let mut window = Window::first_start("first-steps-keys", SIZE);
    let keys = &mut window.studio_mut().files.preferences.keys;
    keys.insert("wash".to_owned(), vec!["J".to_owned()]);
    keys.insert("dry".to_owned(), Vec::new());
    window.harness().run_ok();
    for words in ["J washes it", "Edit, Dry dries the paint"] {
        assert!(draws(&mut window, words), "{words} is not shown");
    }
}

#[test]
fn the_first_steps_stay_within_a_small_window() {
    for size in [vec2(900.0, 600.0), vec2(1920.0, 1080.0)] {
        let mut window = Window::first_start("first-steps-size", size);
        window.save(&format!("first-steps-{}", size.x));
        let places = ["Press here", "Mix here", "Double click a tube"]
            .map(|words| place_of_text(&mut window, words).unwrap().expand(8.0));
        let [canvas, palette] =
            [&window.studio().canvas, &window.studio().palette].map(|view| view.rect());
        for (index, place) in places.into_iter().enumerate() {
            assert!(canvas.contains_rect(place), "{place} is not over the canvas {canvas}");
            let others = &places[index + 1..];
            assert!(!others.iter().any(|other| other.intersects(place)), "{place}: {others:?}");
        }
        assert!(places[1].center().x < palette.right(), "over the palette");
        assert!(places[2].center().x > palette.right(), "over the tubes");
    }
}

#[test]
fn a_message_does_not_cover_the_first_steps() {
    let mut window = Window::first_start("first-steps-message", SIZE);
    let place = |window: &mut Window| place_of_text(window, "Press here").unwrap();
    let before = place(&mut window);
    window.click("Load brush");
    window.settle();
    window.click("Keep this mixture");
    window.settle();
    window.save("first-steps-message");
    let message = place_of_text(&mut window, "Kept").expect("a message");
    let lines = place(&mut window);
    assert!(message.intersects(before), "{message} would cover {before}");
    assert!(lines.top() > message.bottom(), "{message} covers {lines}");
}

#[test]
fn the_sample_painting_opens_with_wet_and_dry_paint_and_nothing_to_save() {
    let mut window = Window::open("sample");
    let middle = window.studio().canvas.rect().center();
    window.pen_stroke(&[middle, middle + vec2(40.0, 10.0)]);
    window.settle();
    choose(&mut window, "File", "Sample painting");
    assert!(window.studio().files.has_dialog(), "unsaved changes are asked for");
    window.click("Discard");
    let began = web_time::Instant::now();
    let title = |window: &Window| window.studio().painting().unwrap().title.clone();
    // The worker measures the layers when it has nothing else to do.
    let measured = |window: &Window| {
        let layers = &window.studio().painting().unwrap().layers;
        layers.len() == 3 && layers.iter().all(|layer| layer.coverage > 0.0)
    };
    let playing = |window: &Window| window.studio().files.is_playing();
    while title(&window) != "Oranges and a lemon" || playing(&window) || !measured(&window) {
        assert!(began.elapsed().as_secs() < 60, "it is not opened");
        std::thread::sleep(std::time::Duration::from_millis(5));
        window.harness().step();
    }
    window.settle();
    window.save("sample");
    let studio = window.studio();
    let painting = studio.painting().unwrap();
    assert_eq!((painting.layers.len(), studio.files.path()), (3, None));
    assert!(painting.history.last().is_some_and(|label| label.starts_with("squeeze")), "heaps");
    assert!(!studio.files.has_unsaved_changes(), "nothing was painted by hand");
    let message = studio.message().unwrap();
    assert!(message.text.contains("the recording was played"), "{message:?}");
}

/// Pixels of the window that changed between two pictures, with their new colours.
fn changed(window: &mut Window, at: Pos2, reach: f32, hover: Pos2) -> Option<Vec<(Vec2, [u8; 3])>> {
    window.frame(vec![eframe::egui::Event::PointerGone]);
    window.harness().run_ok();
    let before = window.picture()?;
    window.frame(vec![eframe::egui::Event::PointerMoved(hover)]);
    window.frame(Vec::new());
    let after = window.picture()?;
    let steps = reach as i32;
    let offsets = (-steps..=steps).flat_map(|y| (-steps..=steps).map(move |x| (x, y)));
    let offsets = offsets.map(|(x, y)| vec2(x as f32, y as f32));
    let pixels = offsets.filter_map(|by| {
        let old = window.color(&before, at + by);
        let new = window.color(&after, at + by);
        (old != new).then_some((by, new))
    });
    Some(pixels.collect())
}

#[test]
fn the_cursor_is_an_outline_that_leaves_its_place_free() {
    let mut window = Window::open("cursor");
    for (brush, turn) in [("flat", 0.0), ("round", 0.7), ("knife", 0.0), ("rigger", 0.0)] {
        window.studio_mut().tools.brush = brush.to_owned();
        window.studio_mut().canvas.view.rotation = turn;
        // Fitted, a millimetre is 25 points; smaller, the rigger is small.
        window.studio_mut().canvas.view.zoom = if brush == "rigger" { 0.5 } else { 1.0 };
        window.studio_mut().canvas.view.fitted = false;
        window.harness().run_ok();
        let at = window.point(SurfaceId::Canvas, 16.0, 10.0);
        let Some(changed) = changed(&mut window, at, 90.0, at) else { return };
        window.save(&format!("cursor-{brush}"));
        let near: Vec<_> = changed.iter().filter(|(by, _)| by.length() < 2.0).collect();
        assert!(near.is_empty(), "{brush} covers its place: {near:?}");
        let light = changed.iter().filter(|(_, [red, ..])| *red > 240).count();
        let dark = changed.iter().filter(|(_, [red, ..])| *red < 130).count();
        assert!(light > 15 && dark > 15, "{brush}: {light} light and {dark} dark pixels");
    }
}

#[test]
fn the_bent_head_of_an_open_stroke_is_an_outline_too() {
    let mut window = Window::open("cursor-bent");
    let at = |x| window_point(&window, x);
    let along: Vec<Pos2> = (0..20).map(|step| at(8.0 + 0.4 * f64::from(step))).collect();
    let last = along[19];
    window.frame(vec![eframe::egui::Event::PointerMoved(along[0])]);
    window.frame(vec![super::harness::button(along[0], true)]);
    for point in along {
        window.frame(vec![eframe::egui::Event::PointerMoved(point)]);
    }
    window.settle();
    let Some(picture) = window.picture() else { return };
    window.save("cursor-bent");
    // Inside, the window shows the cells of the canvas as they are.
    let view = &window.studio().canvas;
    let [x, y] = view.position(last).unwrap().map(|cells| cells as usize);
    let cell = view.picture(false).unwrap().pixels(Rect { x, y, width: 1, height: 1 }).pixels[0];
    let [red, green, blue] =
        window.color(&picture, view.placement().point([x as f64 + 0.5, y as f64 + 0.5]));
    let off = [(red, cell.r()), (green, cell.g()), (blue, cell.b())];
    assert!(off.iter().all(|(shown, own)| shown.abs_diff(*own) < 24), "{off:?}");
    window.frame(vec![super::harness::button(last, false)]);
    window.settle();
}

fn window_point(window: &Window, x_mm: f64) -> Pos2 {
    window.point(SurfaceId::Canvas, x_mm, 10.0)
}

#[test]
fn the_palette_is_shown_under_either_of_two_lights() {
    let mut window = Window::open("palette-light");
    let heap = Squeeze {
        on: SurfaceId::Palette,
        recipe: [("Vermilion".to_owned(), 1.0)].into(),
        vehicle: 0.2,
        x_mm: 20.0,
        y_mm: 15.0,
        volume_mm3: 60.0,
    };
    window.studio_mut().ask(Command::Apply(Action::Squeeze(heap)));
    let lamp = Lighting { illuminant: "FL11".to_owned(), ..Lighting::default() };
    window.studio_mut().ask(Command::SetSecondLight(Some(lamp)));
    window.settle();
    let cells = |window: &Window, second| {
        let rect = Rect { x: 195, y: 145, width: 8, height: 8 };
        window.studio().palette.picture(second).unwrap().pixels(rect).pixels
    };
    assert_ne!(cells(&window, false), cells(&window, true), "the heap under both");
    let at = window.point(SurfaceId::Palette, 20.0, 15.0);
    let first = window.picture().map(|picture| window.color(&picture, at));
    let painted = done(&window);
    let switch = "Shows the palette under the second light, FL11";
    let place = window.harness().get_by_label(switch).rect().center();
    window.pen_stroke(&[place, place]);
    window.settle();
    assert!(window.studio().palette.is_under_second(), "it is switched");
    assert_eq!(done(&window), painted, "and nothing is painted by that");
    window.save("palette-light");
    let second = window.picture().map(|picture| window.color(&picture, at));
    if let (Some(first), Some(second)) = (first, second) {
        assert_ne!(first, second, "the heap is shown under the other light");
    }
    window.studio_mut().ask(Command::SetSecondLight(None));
    window.settle();
    assert!(!window.studio().palette.is_under_second(), "there is one light again");
    assert!(window.harness().query_by_label(switch).is_none(), "and no switch");
    window.key(Modifiers::NONE, Key::Escape);
}
