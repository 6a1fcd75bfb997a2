//! Windows as narrow as a phone: the canvas has most of them, and the panels lie on a sheet over it.

use eframe::egui::{Rect, vec2};
use egui_kittest::kittest::Queryable;
use paint::strokes::{Action, Load, SurfaceId};
use session::Command;

use super::harness::Window;

/// Window of a phone that is held upright, in points.
const PHONE: eframe::egui::Vec2 = vec2(390.0, 844.0);

/// A window with a loaded brush.
fn loaded(name: &'static str) -> Window {
    let mut window = Window::sized(name, PHONE, 2.0);
    window.studio_mut().tools.brush = "round".to_owned();
    let paint = Load {
        brush: "round".to_owned(),
        recipe: [("Vermilion".to_owned(), 1.0)].into(),
        vehicle: 0.2,
        amount_mm: 0.3,
    };
    window.studio_mut().ask(Command::Apply(Action::Load(paint)));
    window.settle();
    window
}

/// Paints a stroke through the middle of the canvas; returns the number of strokes done.
fn stroke(window: &mut Window) -> usize {
    let along: Vec<_> = (0..=20)
        .map(|at| window.point(SurfaceId::Canvas, 8.0 + 0.8 * f64::from(at), 10.0))
        .collect();
    window.pen_stroke(&along);
    window.settle();
    window.studio().painting().unwrap().history_done
}

#[test]
fn the_canvas_has_half_of_a_phones_window_and_all_controls_are_within_it() {
    for large in [false, true] {
        let mut window = Window::sized("narrow", PHONE, 2.0);
        window.studio_mut().files.preferences.touch_targets = large;
        window.harness().run_ok();
        window.show(if large { "narrow-touch" } else { "narrow" });
        let whole = window.whole();
        let canvas = window.studio().canvas.rect();
        let share = canvas.area() / whole.area();
        assert!(share >= 0.5, "the canvas has {share} of the window, large targets: {large}");
        for label in ["File", "Help", "Panels", "Canvas", "Palette", "Paint", "tube of Vermilion"] {
            let rect = window.harness().get_by_label(label).rect();
            assert!(whole.contains_rect(rect), "{label} at {rect} of {whole}");
        }
        assert!(window.harness().query_by_label("Brush").is_none(), "no panel takes room");
    }
}

#[test]
fn the_sheet_of_panels_covers_the_canvas_until_it_is_closed() {
    let mut window = loaded("sheet");
    assert_eq!(stroke(&mut window), 1);
    let canvas = window.studio().canvas.rect();
    window.click("Panels");
    window.settle();
    window.show("narrow-sheet");
    for label in ["Brush", "Layers", "Light", "History"] {
        let rect: Rect = window.harness().get_by_label(label).rect();
        assert!(window.whole().contains_rect(rect), "{label} at {rect}");
        assert!(rect.left() >= canvas.left(), "{label} lies beside the toolbar");
    }
    assert!(window.harness().query_by_label("Palette").is_none(), "the palette is covered");
    assert_eq!(stroke(&mut window), 1, "nothing is painted through the sheet");
    window.click("Panels");
    window.settle();
    assert_eq!(window.studio().canvas.rect(), canvas);
    assert_eq!(stroke(&mut window), 2, "the canvas is painted again");
}

#[test]
fn a_window_that_becomes_wider_has_its_columns_again() {
    let mut window = Window::sized("turned", PHONE, 2.0);
    window.click("Panels");
    window.harness().set_size(vec2(844.0, 390.0));
    window.harness().run_steps(4);
    window.show("narrow-turned");
    let tab = window.harness().get_by_label("Brush").rect();
    let canvas = window.studio().canvas.rect();
    assert!(tab.left() > canvas.right() && canvas.width() > 100.0, "{tab} beside {canvas}");
}
