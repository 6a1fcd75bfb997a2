//! Tests of the first steps, the sample painting, the cursor, the palette's light, and the guided
//! tour.

use eframe::egui::{Key, Modifiers, Pos2, Shape, Theme, Vec2, vec2};
use egui_kittest::kittest::Queryable;
use graphics::tile::Rect;
use paint::document::Lighting;
use paint::strokes::{Action, Squeeze, SurfaceId};
use session::{Command, PaintingState};
use studio::app::{Facts, Intent, Tour, TourStep};
use studio::panels::Mode;

use super::fixture::painting;
use super::harness::Window;
use super::look::drawn_texts;

const SIZE: Vec2 = vec2(1280.0, 800.0);

/// Whether the window draws a text with `words`.
fn draws(window: &mut Window, words: &str) -> bool {
    drawn_texts(window).iter().any(|(_, text)| text.contains(words))
}

/// Where the window draws a text with `words`.
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
    // You can paint over the hints, because they take no clicks.
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
    let before = place_of_text(&mut window, "Press here").unwrap();
    window.click("Load brush");
    window.settle();
    window.click("Keep this mixture");
    window.settle();
    window.save("first-steps-message");
    let message = place_of_text(&mut window, "Kept").expect("a message");
    let lines = place_of_text(&mut window, "Press here").unwrap();
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
    // The worker measures the layers only when it is idle.
    fn measured(window: &Window) -> bool {
        let layers = &window.studio().painting().unwrap().layers;
        layers.len() == 3 && layers.iter().all(|layer| layer.coverage > 0.0)
    }
    while window.studio().painting().unwrap().title != "Oranges and a lemon"
        || window.studio().files.is_playing()
        || !measured(&window)
    {
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

/// Hovers at `hover`. Returns the pixels within `reach` of `at` that change, as offsets from `at`
/// with their new colours.
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
        // A fitted millimetre is 25 points. If the view is smaller, so is the rigger.
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
    let along: Vec<Pos2> =
        (0..20).map(|step| window_point(&window, 8.0 + 0.4 * f64::from(step))).collect();
    let last = along[19];
    window.frame(vec![eframe::egui::Event::PointerMoved(along[0])]);
    window.frame(vec![super::harness::button(along[0], true)]);
    for point in along {
        window.frame(vec![eframe::egui::Event::PointerMoved(point)]);
    }
    window.settle();
    let Some(picture) = window.picture() else { return };
    window.save("cursor-bent");
    // Inside, the window shows the cells of the canvas unchanged.
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
    let [under_first, under_second] = [false, true].map(|second| {
        let rect = Rect { x: 195, y: 145, width: 8, height: 8 };
        window.studio().palette.picture(second).unwrap().pixels(rect).pixels
    });
    assert_ne!(under_first, under_second, "the heap under both");
    let at = window.point(SurfaceId::Palette, 20.0, 15.0);
    let first = window.picture().map(|picture| window.color(&picture, at));
    let painted = done(&window);
    let switch = "Shows the palette under the second light, FL11";
    let place = window.harness().get_by_label(switch).rect().center();
    window.pen_stroke(&[place, place]);
    window.settle();
    assert!(window.studio().palette.shows_second_light(), "it is switched");
    assert_eq!(done(&window), painted, "and nothing is painted by that");
    window.save("palette-light");
    let second = window.picture().map(|picture| window.color(&picture, at));
    if let (Some(first), Some(second)) = (first, second) {
        assert_ne!(first, second, "the heap is shown under the other light");
    }
    window.studio_mut().ask(Command::SetSecondLight(None));
    window.settle();
    assert!(!window.studio().palette.shows_second_light(), "there is one light again");
    assert!(window.harness().query_by_label(switch).is_none(), "and no switch");
    window.key(Modifiers::NONE, Key::Escape);
}

fn bare() -> PaintingState {
    PaintingState { history: Vec::new(), history_done: 0, layers: Vec::new(), ..painting() }
}

fn add(painting: &mut PaintingState, label: &str) {
    painting.history.truncate(painting.history_done);
    painting.history.push(label.to_owned());
    painting.history_done += 1;
}

/// An action that changes a painting as a painter would.
type Act<'a> = &'a dyn Fn(&mut PaintingState);

#[test]
fn each_step_is_done_by_its_own_action_only() {
    let acts: [(TourStep, Act); 6] = [
        (TourStep::Load, &|painting| painting.brushes[1].amount_mm += 0.3),
        (TourStep::Paint, &|painting| add(painting, "stroke, round")),
        (TourStep::Mix, &|painting| add(painting, "stroke on the palette, round")),
        (TourStep::Dry, &|painting| add(painting, "dry all")),
        (TourStep::Glaze, &|painting| {
            painting.layers = super::fixture::painting().layers;
            painting.brushes[0].vehicle = 0.97;
            add(painting, "stroke, round");
        }),
        (TourStep::Relight, &|painting| painting.lighting.illuminant = "A".to_owned()),
    ];
    for (step, _) in &acts {
        for (done, act) in &acts {
            let mut after = bare();
            act(&mut after);
            let found = step.is_done(&Facts::of(&bare()), &Facts::of(&after));
            // A glaze is a stroke too.
            let wanted = step == done || (*step, *done) == (TourStep::Paint, TourStep::Glaze);
            assert_eq!(found, wanted, "{step:?} by {done:?}");
        }
    }
}

#[test]
fn undone_and_forgotten_actions_do_not_hold_the_tour_up() {
    let mut painting = bare();
    add(&mut painting, "stroke, round");
    let mut tour = Tour::default();
    tour.start();
    tour.next();
    assert!(!tour.observe(Facts::of(&painting)), "the stroke was there before");
    painting.history_done = 0;
    assert!(!tour.observe(Facts::of(&painting)), "undo is not a stroke");
    add(&mut painting, "stroke, flat");
    assert!(tour.observe(Facts::of(&painting)), "a stroke after undo");
    assert_eq!(tour.step(), Some(TourStep::Mix));
    assert_eq!(tour.done(), [false, true, false, false, false, false]);
}

#[test]
fn the_tour_is_left_resumed_and_begun_again() {
    let mut tour = Tour::default();
    assert!(!tour.observe(Facts::of(&bare())) && tour.step().is_none(), "it does not run");
    tour.start();
    tour.back();
    tour.next();
    tour.next();
    assert_eq!(tour.step(), Some(TourStep::Mix));
    tour.leave();
    assert_eq!((tour.step(), tour.is_running()), (None, false));
    tour.start();
    assert_eq!(tour.step(), Some(TourStep::Mix), "where it was left");
    for _ in 0..9 {
        tour.next();
    }
    assert_eq!((tour.step(), tour.number(), tour.is_running()), (None, 6, true));
    tour.back();
    assert_eq!(tour.step(), Some(TourStep::Relight));
    tour.next();
    tour.start();
    assert_eq!(tour.step(), Some(TourStep::Load), "from the start");
}

#[test]
fn another_painting_is_not_taken_for_the_painters_work() {
    let mut tour = Tour::default();
    tour.start();
    tour.next();
    tour.observe(Facts::of(&bare()));
    tour.forget();
    assert!(!tour.observe(Facts::of(&painting())), "it has strokes of its own");
    assert_eq!(tour.step(), Some(TourStep::Paint));
}

/// Draws a line on a surface, in mm.
fn draw(window: &mut Window, surface: SurfaceId, from: (f64, f64), to: (f64, f64)) {
    let along: Vec<_> = (0..=12)
        .map(|step: u32| {
            let share = f64::from(step) / 12.0;
            window.point(
                surface,
                from.0 + share * (to.0 - from.0),
                from.1 + share * (to.1 - from.1),
            )
        })
        .collect();
    window.pen_stroke(&along);
    window.settle();
}

fn double_click_tube(window: &mut Window, name: &str) {
    let label = format!("tube of {name}");
    // Time must pass, or these and the earlier clicks would be a triple click.
    window.harness().run_steps(60);
    let tube = window.harness().get_by_label(&label);
    tube.click();
    tube.click();
    window.settle();
}

#[test]
fn a_painter_goes_through_the_whole_tour() {
    let mut window = Window::sized("tour", vec2(1280.0, 800.0), 1.0);
    window.harness().get_all_by_label("Help").next().unwrap().click();
    window.harness().run_ok();
    window.click("Guided tour");
    window.harness().ctx.set_theme(Theme::Light);
    for step in TourStep::ALL {
        window.settle();
        assert_eq!(window.studio().tour().step(), Some(step));
        assert!(window.harness().query_by_label(step.title()).is_some(), "{step:?} has a card");
        window.save(&format!("tour-{step:?}"));
        let leave = window.harness().get_by_label("Leave the tour").rect();
        let card = window.harness().get_by_label(step.title()).rect().union(leave);
        for pigment in ["Zinc White", "Cochineal Lake", "Bone Black"] {
            let tube = window.harness().get_by_label(&format!("tube of {pigment}")).rect();
            assert!(!card.intersects(tube), "{step:?}: the card at {card} hides {pigment}");
        }
        match step {
            TourStep::Load => double_click_tube(&mut window, "Vermilion"),
            TourStep::Paint => draw(&mut window, SurfaceId::Canvas, (6.0, 10.0), (16.0, 14.0)),
            TourStep::Mix => {
                for (tube, x_mm) in [("Ultramarine", 20.0), ("Zinc White", 26.0)] {
                    window.click(&format!("tube of {tube}"));
                    draw(&mut window, SurfaceId::Palette, (x_mm, 20.0), (x_mm, 20.0));
                }
                assert_eq!(window.studio().tour().step(), Some(step), "heaps are not mixed yet");
                window.key(Modifiers::NONE, Key::B);
                draw(&mut window, SurfaceId::Palette, (18.0, 20.0), (30.0, 20.0));
            }
            TourStep::Dry => window.key(Modifiers::NONE, Key::D),
            TourStep::Glaze => {
                window.key(Modifiers::NONE, Key::W);
                window.studio_mut().tools.vehicle = 0.99;
                window.studio_mut().tools.load_mm = 0.1;
                double_click_tube(&mut window, "Cochineal Lake");
                draw(&mut window, SurfaceId::Canvas, (8.0, 9.0), (16.0, 15.0));
            }
            TourStep::Relight => window.key(Modifiers::NONE, Key::L),
        }
        window.settle();
    }
    assert_eq!(window.studio().tour().done(), [true; 6]);
    window.save("tour-end");
    assert!(window.harness().query_by_label("That was the tour").is_some(), "it says so");
    window.click("Close the tour");
    assert!(!window.studio().tour().is_running(), "closed");
}

#[test]
fn the_card_goes_back_and_on_and_escape_leaves_it() {
    let mut window = Window::open("tour-card");
    fn start(window: &mut Window) {
        window.harness().get_all_by_label("Help").next().unwrap().click();
        window.harness().run_ok();
        window.click("Guided tour");
    }
    start(&mut window);
    for step in [TourStep::Paint, TourStep::Mix] {
        window.click("Next");
        assert_eq!(window.studio().tour().step(), Some(step));
    }
    window.click("Back");
    assert_eq!(window.studio().tour().step(), Some(TourStep::Paint));
    // A window over the tour gets the key first.
    window.key(Modifiers::NONE, Key::F1);
    window.key(Modifiers::NONE, Key::Escape);
    assert!(window.studio().tour().is_running(), "Escape closed the keys");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(!window.studio().tour().is_running(), "Escape left the tour");
    let message = window.studio().message().unwrap();
    assert!(message.hint.as_ref().is_some_and(|hint| hint.contains("Guided tour")), "{message:?}");
    start(&mut window);
    assert_eq!(window.studio().tour().step(), Some(TourStep::Paint), "where it was left");
}

#[test]
fn the_steps_tell_the_keys_in_use() {
    fn key(intent: Intent) -> String {
        let keys = [
            (Intent::Tool(Mode::Paint), "F5"),
            (Intent::Dry, "F6"),
            (Intent::Wash, "F7"),
            (Intent::OtherLight, "F8"),
        ];
        let own = keys.iter().find(|(own, _)| *own == intent);
        own.map_or_else(String::new, |(_, key)| (*key).to_owned())
    }
    for (step, line, with, without) in [
        (TourStep::Mix, 1, "Choose Paint (F5) and", "Choose Paint and draw"),
        (TourStep::Dry, 0, "Press F6, or this button.", "Press this button."),
        (TourStep::Glaze, 0, "Wash (F7), set", "Wash, set"),
        (
            TourStep::Relight,
            0,
            "Press F8 for the light of a bulb",
            "Choose another light in the Light tab.",
        ),
    ] {
        let lines = step.lines(key);
        assert!(lines[line].starts_with(with), "{lines:?}");
        let lines = step.lines(|_| String::new());
        assert!(lines[line].starts_with(without), "{lines:?}");
    }
}
