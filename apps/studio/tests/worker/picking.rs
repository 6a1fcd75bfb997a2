//! Picking colour and paint, and loading picked paint.

use std::sync::Arc;

use graphics::gpu::BackendChoice;
use paint::scene::SpectralDocument;
use paint::strokes::{Action, SurfaceId};
use session::{Command, Event, Picked};

use super::pen::{load, wander};
use super::window::Window;

fn pick(window: &mut Window, x_mm: f64, y_mm: f64, radius_mm: f64) -> Arc<Picked> {
    window.ask(Command::Pick { surface: SurfaceId::Canvas, x_mm, y_mm, radius_mm });
    window.wait("what was picked", |event| match event {
        Event::Picked(picked) => Some(Arc::clone(picked)),
        _ => None,
    })
}

#[test]
fn a_pick_equals_an_instrument_reading() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("flat", "Vermilion"));
    window.stroke(SurfaceId::Canvas, "flat", [&wander(51, 80, 32.0, 20.0)[..]]);
    window.act(Action::Dry { fraction: 1.0 });
    window.act(load("round", "Ultramarine"));
    let over = wander(51, 60, 32.0, 20.0);
    window.stroke(SurfaceId::Canvas, "round", [&over[..]]);
    let x_mm = over[30].x_mm;
    let y_mm = over[30].y_mm;
    let snapshot = window.snapshot();
    let spectral = SpectralDocument::full(&snapshot.canvas);
    let column = (x_mm / 0.1) as usize;
    let row = (y_mm / 0.1) as usize;
    let one = pick(&mut window, x_mm, y_mm, 0.0);
    let wanted = spectral.measured_reflectance(column, row);
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
    assert!(near(&one.reflectance, &wanted), "one cell");
    assert_eq!(one.layers.len(), 2);
    let heights: f64 = one.layers[1].amounts_mm.iter().sum();
    let volume = snapshot.canvas.wet.cell(row * 320 + column).volume();
    assert!((heights - paint::amount::mm_from_quanta(volume, 0.1)).abs() < 1e-12, "its height");
    // Mean over a disc, computed cell by cell.
    let radius = 0.35;
    let disc = pick(&mut window, x_mm, y_mm, radius);
    let mut sum = vec![0.0; wanted.len()];
    let mut count = 0.0;
    for index in 0..320 * 200 {
        let x = index % 320;
        let y = index / 320;
        let away = (0.1 * x as f64 + 0.05 - x_mm).hypot(0.1 * y as f64 + 0.05 - y_mm);
        if away <= radius {
            count += 1.0;
            for (sum, value) in sum.iter_mut().zip(spectral.measured_reflectance(x, y)) {
                *sum += value;
            }
        }
    }
    let mean: Vec<f64> = sum.iter().map(|sum| sum / count).collect();
    assert!(near(&disc.reflectance, &mean), "the mean of {count} cells");

    // A brush loaded with picked paint holds that paint.
    let brush = "filbert".to_owned();
    window.act(load("filbert", "Zinc White"));
    window.act(Action::Wash { brush: brush.clone() });
    window.ask(Command::LoadPicked {
        brush,
        picked: Arc::unwrap_or_clone(disc).into(),
        amount_mm: 0.2,
    });
    window.snapshot();
    let filbert = |window: &Window| {
        let found = window.state().brushes.iter().find(|brush| brush.name == "filbert");
        found.cloned().expect("the brush exists")
    };
    window.wait_until("paint on the brush", |window| {
        let state = filbert(window);
        (state.amount_mm - 0.2).abs() < 1e-3 && state.parts[0] == 0.0
    });
    let wet = pick(&mut window, x_mm, y_mm, radius).layers[1].clone();
    let total: f64 = wet.amounts_mm[..8].iter().sum();
    for (part, amount) in filbert(&window).parts.iter().zip(wet.amounts_mm) {
        assert!((part - amount / total).abs() < 1e-4, "{part} of {}", amount / total);
    }
    let bare = pick(&mut window, 0.05, 0.05, 0.0);
    window.ask(Command::LoadPicked {
        brush: "filbert".to_owned(),
        picked: Box::new((*bare).clone()),
        amount_mm: 0.2,
    });
    let (text, hint, failed) = window.message();
    assert!(failed && text.contains("no wet paint") && hint.is_some(), "{text}");
}
