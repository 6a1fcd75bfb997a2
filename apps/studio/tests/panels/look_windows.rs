//! Windows, dialogs and bars over the canvas: their texts are whole, their targets can be touched,
//! and their characters have glyphs.

use eframe::egui::{Key, Modifiers, vec2};
use egui_kittest::kittest::Queryable;
use studio::app::CropTool;
use studio::theme::ThemeChoice;

use super::glyphs::check;
use super::harness::Window;
use super::look::{cut, set_look, small};

/// A window over the canvas: its name, a label that is seen while it is open, and how it is opened.
type Over = (&'static str, &'static str, fn(&mut Window));

const OVER: [Over; 7] = [
    ("Pen", "Pressure curve", |window| window.studio_mut().visible.pen = true),
    ("Own brushes", "New set", |window| window.studio_mut().visible.brush_sets = true),
    ("Keys", "All to standard", |window| window.key(Modifiers::NONE, Key::F1)),
    ("New", "Begin", |window| window.key(Modifiers::COMMAND, Key::N)),
    ("browser", "Grid", |window| window.key(Modifiers::COMMAND, Key::O)),
    ("quick palette", "quick Vermilion", |window| window.key(Modifiers::NONE, Key::C)),
    ("crop", "Shape of the crop", |window| {
        window.studio_mut().crop = Some(CropTool::new((320, 200)));
    }),
];

/// Opens a window over the canvas and waits for what it reads.
fn open(window: &mut Window, (name, label, opens): Over) {
    opens(window);
    window.settle();
    let is_open = window.harness().query_all_by_label_contains(label).next().is_some();
    assert!(is_open, "{name} is open");
}

fn close(window: &mut Window, (name, label, _): Over) {
    window.key(Modifiers::NONE, Key::Escape);
    window.settle();
    let is_open = window.harness().query_all_by_label_contains(label).next().is_some();
    assert!(!is_open, "Escape closes {name}");
}

#[test]
fn no_text_of_a_window_over_the_canvas_is_cut_in_any_look() {
    let mut window = Window::sized("cut-over", vec2(1280.0, 800.0), 1.0);
    for look in [(ThemeChoice::Dark, false), (ThemeChoice::Light, true)] {
        set_look(&mut window, look);
        for over in OVER {
            open(&mut window, over);
            window.show(&format!("over-{}-{look:?}", over.0));
            let cut = cut(&mut window);
            assert!(cut.is_empty(), "{} {look:?}: {cut:#?}", over.0);
            close(&mut window, over);
        }
    }
}

#[test]
fn everything_that_is_touched_over_the_canvas_is_44_points_wide_and_high() {
    let mut window = Window::sized("touch-over", vec2(1440.0, 1000.0), 1.0);
    set_look(&mut window, (ThemeChoice::Dark, true));
    for over in OVER {
        open(&mut window, over);
        let small = small(&mut window);
        assert!(small.is_empty(), "{}: {small:#?}", over.0);
        close(&mut window, over);
    }
}

#[test]
fn every_character_over_the_canvas_has_a_glyph() {
    let mut window = Window::open("glyphs-over");
    for over in OVER {
        open(&mut window, over);
        check(&mut window, over.0);
        close(&mut window, over);
    }
}
