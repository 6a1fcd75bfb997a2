//! The guided tour: its steps as data, and the whole of it with a painter's hand.

use eframe::egui::{Key, Modifiers, Theme, vec2};
use egui_kittest::kittest::Queryable;
use paint::strokes::SurfaceId;
use session::PaintingState;
use studio::app::{Facts, Intent, Tour, TourStep};
use studio::panels::Mode;

use super::fixture::painting;
use super::harness::Window;

/// The fixture's painting without layers and history.
fn bare() -> PaintingState {
    PaintingState { history: Vec::new(), history_done: 0, layers: Vec::new(), ..painting() }
}

/// Adds an action to the history.
fn add(painting: &mut PaintingState, label: &str) {
    painting.history.truncate(painting.history_done);
    painting.history.push(label.to_owned());
    painting.history_done += 1;
}

/// Changes a painting as the painter would.
type Act<'a> = &'a dyn Fn(&mut PaintingState);

#[test]
fn each_step_is_done_by_its_own_action_only() {
    let with_medium = |painting: &mut PaintingState| {
        painting.layers = super::fixture::painting().layers;
        painting.brushes[0].vehicle = 0.97;
    };
    let acts: [(TourStep, Act); 6] = [
        (TourStep::Load, &|painting| painting.brushes[1].amount_mm += 0.3),
        (TourStep::Paint, &|painting| add(painting, "stroke, round")),
        (TourStep::Mix, &|painting| add(painting, "stroke on the palette, round")),
        (TourStep::Dry, &|painting| add(painting, "dry all")),
        (TourStep::Glaze, &|painting| {
            with_medium(painting);
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
    assert!(!tour.observe(Facts::of(&painting)), "undo is no stroke");
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
    // Time passes, or the clicks before would make these two a triple click.
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
    let start = |window: &mut Window| {
        window.harness().get_all_by_label("Help").next().unwrap().click();
        window.harness().run_ok();
        window.click("Guided tour");
    };
    start(&mut window);
    for step in [TourStep::Paint, TourStep::Mix] {
        window.click("Next");
        assert_eq!(window.studio().tour().step(), Some(step));
    }
    window.click("Back");
    assert_eq!(window.studio().tour().step(), Some(TourStep::Paint));
    // A window over the tour comes first.
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
    let key = |intent: Intent| {
        let keys = [
            (Intent::Tool(Mode::Paint), "F5"),
            (Intent::Dry, "F6"),
            (Intent::Wash, "F7"),
            (Intent::OtherLight, "F8"),
        ];
        let own = keys.iter().find(|(own, _)| *own == intent);
        own.map_or_else(String::new, |(_, key)| (*key).to_owned())
    };
    let with = |step: TourStep| step.lines(key).concat();
    assert!(with(TourStep::Mix).contains("Choose Paint (F5) and"), "{}", with(TourStep::Mix));
    assert!(with(TourStep::Dry).starts_with("Press F6, or this button."));
    assert!(with(TourStep::Glaze).starts_with("Wash (F7), set"));
    assert!(with(TourStep::Relight).starts_with("Press F8 for the light of a bulb"));
    let without = |step: TourStep| step.lines(|_| String::new()).concat();
    assert!(without(TourStep::Mix).contains("Choose Paint and draw"));
    assert!(without(TourStep::Dry).starts_with("Press this button."));
    assert!(without(TourStep::Glaze).starts_with("Wash, set"));
    assert!(without(TourStep::Relight).starts_with("Choose another light in the Light tab."));
}
