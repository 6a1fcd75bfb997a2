//! Tests of the wheel panel.

use web_time::{Duration, Instant};

use eframe::egui::vec2;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use paint::layer::SLOTS;
use session::PaintingState;
use spectra::color::Lab;
use studio::panels::Request;
use studio::panels::eyedropper::{Color, TargetColor};
use studio::panels::wheel::{Plane, Wheel};
use studio::wheel_maker::WheelRequest;

use super::fixture::{Fixture, click, painting, picture, show_panel};
use super::harness::Window;

fn wheel(painting: PaintingState, wanted: Option<Lab>) -> Harness<'static, Fixture<Wheel>> {
    let wanted = wanted.map(|lab| TargetColor { name: "Lab".to_owned(), color: Color::Lab(lab) });
    let mut harness = show_panel(Wheel::default(), painting, move |wheel, ui, cx| {
        wheel.show(ui, cx, wanted.as_ref());
    });
    let start = Instant::now();
    while harness.query_by_label_contains("Mixing the tubes").is_some() {
        assert!(start.elapsed() < Duration::from_secs(60), "no wheel");
        std::thread::sleep(Duration::from_millis(5));
        harness.run();
    }
    harness
}

fn request(painting: &PaintingState) -> WheelRequest {
    let mut tubes: Vec<_> = painting.slots.iter().copied().flatten().collect();
    tubes.sort_unstable();
    let viewing = painting.light.viewing.clone();
    WheelRequest { library: painting.library.clone(), tubes, viewing }
}

#[test]
fn the_tubes_lie_at_their_measured_colours() {
    let painting = painting();
    let made = request(&painting).make().unwrap();
    let mut harness = wheel(painting, None);
    let rect = harness.get_by_label("Colour wheel").rect();
    assert!(rect.width() > 250.0 && (rect.width() - rect.height()).abs() < 0.5, "{rect}");
    let Some(drawn) = picture(&mut harness, "wheel") else { return };
    let chroma = made.gamut.samples.iter().map(|one| one.color.lab.a.hypot(one.color.lab.b));
    let plane = Plane::with_chroma(rect, chroma.fold(0.0, f64::max));
    for (pigment, color) in &made.masstones {
        let point = plane.point([color.lab.a, color.lab.b]);
        let found = drawn.get_pixel(point.x as u32, point.y as u32).0;
        let wanted = color.srgb.linear().mapped_into_gamut().encoded().to_bytes();
        let apart = found.iter().zip(wanted).map(|(a, b)| a.abs_diff(b)).max().unwrap();
        // White and black lie side by side in the middle, one over the other.
        let chromatic = color.lab.a.hypot(color.lab.b) > 15.0;
        assert!(!chromatic || apart <= 2, "{pigment:?}: {found:?}, not {wanted:?}");
    }
}

/// Draws until a label contains these words.
#[track_caller]
fn wait_for(harness: &mut Harness<'static, Fixture<Wheel>>, words: &str) {
    let start = Instant::now();
    while harness.query_all_by_label_contains(words).next().is_none() {
        assert!(start.elapsed() < Duration::from_secs(60), "no `{words}`");
        std::thread::sleep(Duration::from_millis(10));
        harness.run_steps(2);
    }
}

#[test]
fn the_legend_tells_whether_a_colour_is_reached() {
    let made = request(&painting()).make().unwrap();
    let mixed = made.gamut.samples[200].color.lab;
    let mut harness = wheel(painting(), Some(mixed));
    wait_for(&mut harness, "The tubes reach it");
    wait_for(&mut harness, "Ring: what the brush holds");
    let neon = Lab { lightness: 80.0, a: -90.0, b: 20.0 };
    let far = made.nearest(neon).unwrap().delta_e;
    assert!(far > 10.0, "{far}");
    let mut harness = wheel(painting(), Some(neon));
    wait_for(&mut harness, "The tubes come within");
    let label = harness.get_by_label_contains("The tubes come within");
    let words = label.accesskit_node().value().unwrap();
    let found: f64 = words.trim_end_matches('.').rsplit(' ').next().unwrap().parse().unwrap();
    assert!(found <= far + 0.05 && found > 0.5 * far, "{found} by search, {far} by samples");
}

#[test]
fn a_click_finds_recipes_for_that_colour_and_offers_to_load_them() {
    let mut harness = wheel(painting(), None);
    click(&mut harness, "All lightnesses");
    let rect = harness.get_by_label("Colour wheel").rect();
    harness.hover_at(rect.center() + vec2(20.0, -14.0));
    harness.drag_at(rect.center() + vec2(20.0, -14.0));
    harness.drop_at(rect.center() + vec2(20.0, -14.0));
    harness.run_steps(3);
    wait_for(&mut harness, "Square: Lab 50 ");
    wait_for(&mut harness, "Load recipe 1");
    wait_for(&mut harness, "The tubes reach it");
    picture(&mut harness, "wheel-recipes");
    harness.get_by_label("Load recipe 1").click_accesskit();
    harness.run_steps(2);
    assert!(matches!(harness.state().requests[..], [Request::Worker(_)]), "the brush is loaded");
    harness.get_by_label("Clear the wheel's colour").click_accesskit();
    harness.run_steps(2);
    assert!(harness.query_by_label("Load recipe 1").is_none());
}

#[test]
fn a_palette_without_paint_that_mixes_tells_so() {
    let mut bare = painting();
    bare.slots = [None; SLOTS];
    let harness = wheel(bare, None);
    assert!(harness.query_by_label_contains("can be mixed").is_some());
}

#[test]
fn a_low_window_shows_the_wheel_whole() {
    for height in [800.0, 900.0, 1080.0] {
        let mut window = Window::sized("low-wheel", vec2(1440.0, height), 1.0);
        window.click("Wheel");
        let start = Instant::now();
        while window.harness().query_by_label("Colour wheel").is_none() {
            assert!(start.elapsed() < Duration::from_secs(60), "no wheel");
            std::thread::sleep(Duration::from_millis(10));
            window.harness().step();
        }
        window.settle();
        window.save(&format!("low-wheel-{height}"));
        let rect = window.harness().get_by_label("Colour wheel").rect();
        let tab = window.harness().get_by_label("Wheel").rect();
        // The status line takes 24 points.
        let room = tab.bottom()..=height - 24.0;
        assert!(rect.width() >= 128.0, "{rect} is too small to read");
        assert!(room.contains(&rect.top()) && room.contains(&rect.bottom()), "{rect} of {height}");
    }
}
