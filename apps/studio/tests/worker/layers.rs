//! Reported state of layers, brushes and tubes.

use graphics::gpu::BackendChoice;
use paint::amount::mm_from_quanta;
use paint::document::LayerId;
use paint::strokes::{Action, LayerRef, SurfaceId};

use super::pen::{load, wander};
use super::window::Window;

#[test]
fn layers_report_height_coverage_and_thumbnail() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("flat", "Vermilion"));
    let samples = wander(41, 80, 32.0, 20.0);
    window.stroke(SurfaceId::Canvas, "flat", [&samples[..]]);
    window.act(Action::Dry { fraction: 1.0 });
    window.act(load("round", "Ultramarine"));
    window.stroke(SurfaceId::Canvas, "round", [&wander(42, 50, 32.0, 20.0)[..]]);
    window.act(Action::Dry { fraction: 0.5 });
    let snapshot = window.snapshot();
    window.wait_until("both layers", |window: &Window| {
        let layers = &window.state().layers;
        layers.len() == 2 && layers.iter().all(|layer| layer.max_mm > 0.0)
    });
    for (reported, layer) in window.state().layers.iter().zip(&snapshot.canvas.dry) {
        let cells = layer.paint.vehicle.values().len();
        let volumes = (0..cells).map(|index| layer.paint.cell(index).volume());
        let painted: Vec<u32> = volumes.filter(|&volume| volume > 0).collect();
        let mm = |quanta: f64| quanta * mm_from_quanta(1, 0.1);
        let sum: f64 = painted.iter().map(|&volume| f64::from(volume)).sum();
        assert!(
            (reported.mean_mm - mm(sum / painted.len() as f64)).abs() < 1e-9,
            "{}",
            reported.mean_mm
        );
        assert_eq!(reported.max_mm, mm(f64::from(*painted.iter().max().unwrap())));
        assert!(
            (reported.coverage - painted.len() as f64 / cells as f64).abs() < 1e-12,
            "its share"
        );
        let thumbnail = &reported.thumbnail;
        assert_eq!((thumbnail.width, thumbnail.height), (160, 100));
        assert_eq!(thumbnail.pixels.len(), 160 * 100);
        let opaque = thumbnail.pixels.iter().filter(|pixel| pixel[3] > 0).count();
        let share = opaque as f64 / thumbnail.pixels.len() as f64;
        assert!((share - reported.coverage).abs() < 0.05, "{share} of {}", reported.coverage);
    }
    let reddest = |window: &Window| {
        let pixels = &window.state().layers[0].thumbnail.pixels;
        pixels.iter().filter(|p| p[3] == 255).map(|p| i32::from(p[0]) - i32::from(p[2])).max()
    };
    assert!(reddest(&window) > Some(40), "vermilion is red: {:?}", reddest(&window));
    let layer = LayerRef::Dry(0);
    let from = "Vermilion".to_owned();
    let to = "Emerald Green".to_owned();
    window.act(Action::Swap { layer, from, to });
    window.wait_until("another colour", |window| reddest(window) < Some(0));
    // Undo changes the paint of a layer, so its thumbnail must be updated.
    window.act(Action::Undo {});
    window.act(Action::Undo {});
    window.wait_until("one layer", |window| window.state().layers.len() == 1);
    window.wait_until("its colour", |window| reddest(window) > Some(40));
}

#[test]
fn a_changed_layer_gets_a_new_thumbnail() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("flat", "Vermilion"));
    window.stroke(SurfaceId::Canvas, "flat", [&wander(44, 60, 32.0, 20.0)[..]]);
    window.act(Action::Dry { fraction: 0.5 });
    window.act(Action::Dry { fraction: 1.0 });
    window.wait_until("both layers", |window| {
        let layers = &window.state().layers;
        layers.len() == 2 && layers.iter().all(|layer| layer.max_mm > 0.0)
    });
    let most: f64 = window.state().layers.iter().map(|layer| layer.max_mm).sum();
    window.act(Action::Merge { layer: LayerRef::Dry(1), with: None });
    window.wait_until("one layer as thick as both", |window| {
        let layers = &window.state().layers;
        layers.len() == 1 && (layers[0].max_mm - most).abs() < 1e-6
    });
}

#[test]
fn names_visibility_and_order_are_reported_by_identity() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("flat", "Vermilion"));
    window.stroke(SurfaceId::Canvas, "flat", [&wander(45, 60, 32.0, 20.0)[..]]);
    window.act(Action::Dry { fraction: 0.5 });
    window.act(load("round", "Ultramarine"));
    window.stroke(SurfaceId::Canvas, "round", [&wander(46, 40, 32.0, 20.0)[..]]);
    window.act(Action::Dry { fraction: 1.0 });
    window.wait_until("both layers", |window| {
        let layers = &window.state().layers;
        layers.len() == 2 && layers.iter().all(|layer| layer.max_mm > 0.0)
    });
    let before = window.state().layers.clone();
    let first = LayerRef::Id(LayerId(1));
    window.act(Action::Name { layer: first, name: "under".to_owned() });
    window.act(Action::Visible { layer: first, value: false });
    window.act(Action::Order { layer: first, to: 1 });
    window.wait_until("the order", |window| window.state().layers[1].label() == "under");
    let state = window.state().layers[1].clone();
    assert_eq!((state.id, state.visible, state.opacity), (LayerId(1), false, 1.0));
    // A moved layer keeps its figures and its picture while they are computed again.
    assert_eq!((state.coverage, state.max_mm), (before[0].coverage, before[0].max_mm));
    assert_eq!(state.thumbnail, before[0].thumbnail);
    let snapshot = window.snapshot();
    assert_eq!(snapshot.canvas.dry[1].name, "under");
    window.act(Action::Visible { layer: LayerRef::Id(LayerId(9)), value: true });
    let (text, _, failed) = window.message();
    assert!(failed && text.contains("there is no layer 9; the painting has 2, 1"), "{text}");
}

#[test]
fn brushes_and_tubes_are_reported() {
    let mut window = Window::open(BackendChoice::Cpu);
    let state = window.state();
    assert_eq!(state.brushes.len(), 6);
    assert!(state.brushes.iter().all(|brush| brush.color.is_none()), "the brushes are clean");
    assert!(state.masstones.iter().all(Option::is_some), "eight tubes");
    assert!(state.tints.iter().all(Option::is_some), "all can be mixed with white");
    window.act(load("round", "Ultramarine"));
    let round = |window: &Window| {
        let found = window.state().brushes.iter().find(|brush| brush.name == "round");
        found.cloned().expect("the brush exists")
    };
    window.wait_until("paint on the brush", |window| round(window).amount_mm > 0.0);
    let loaded = round(&window);
    assert!((loaded.amount_mm - 0.3).abs() < 1e-4, "{}", loaded.amount_mm);
    assert!((loaded.vehicle - 0.1).abs() < 1e-4, "{}", loaded.vehicle);
    let slot = loaded.parts.iter().position(|&part| part == 1.0).expect("one pigment");
    assert_eq!(loaded.color, window.state().masstones[slot]);
    window.stroke(SurfaceId::Palette, "round", [&wander(43, 40, 10.0, 8.0)[..]]);
    window.wait_until("less paint", |window| {
        (1e-3..loaded.amount_mm).contains(&round(window).amount_mm)
    });
    let used = round(&window);
    // The tip paints, so that it loses more than the whole head.
    assert!(used.tip_mm < used.amount_mm, "{} of {}", used.tip_mm, used.amount_mm);
    window.act(Action::Undo {});
    window.wait_until("the paint back", |window| round(window).amount_mm == loaded.amount_mm);
    window.act(Action::Wash { brush: "round".to_owned() });
    window.wait_until("a clean brush", |window| round(window).color.is_none());
}

#[test]
fn the_first_dirty_brush_is_told_once() {
    let mut window = Window::open(BackendChoice::Cpu);
    let dirty = |window: &mut Window| {
        window.snapshot();
        std::mem::take(&mut window.dirty)
    };
    window.act(load("round", "Ultramarine"));
    let path = wander(43, 60, 10.0, 8.0);
    window.stroke(SurfaceId::Canvas, "round", [&path[..]]);
    window.stroke(SurfaceId::Canvas, "round", [&path[..]]);
    assert!(dirty(&mut window).is_empty(), "its own paint makes no brush dirty");
    // A clean flat through wet paint.
    window.stroke(SurfaceId::Canvas, "flat", [&path[..]]);
    assert_eq!(dirty(&mut window), ["flat"]);
    window.stroke(SurfaceId::Canvas, "filbert", [&path[..]]);
    assert!(dirty(&mut window).is_empty(), "once is enough");
}
