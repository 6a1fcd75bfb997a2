//! Reported tiles equal the exported picture.

use graphics::export::png8;
use graphics::gpu::BackendChoice;
use paint::document::{Document, Lighting};
use paint::light::Light;
use paint::scene::{picture, scene};
use paint::strokes::{Action, LayerRef, SurfaceId};
use session::{Command, Snapshot};

use super::pen::{load, wander};
use super::window::Window;

/// Renders the document as an export does.
pub(crate) fn exported(document: &Document, light: &Light) -> Vec<[u8; 4]> {
    let picture = picture(document, &scene(document, light));
    let bytes = png8(&picture, document.cell_mm).unwrap().bytes;
    let file = image::load_from_memory(&bytes).unwrap().into_rgba8();
    file.pixels().map(|pixel| pixel.0).collect()
}

/// Asserts that the tiles received so far equal the rendered document, to the byte.
pub(crate) fn assert_pictures(window: &mut Window, snapshot: &Snapshot) {
    let light = std::sync::Arc::clone(&window.state().light);
    let Lighting { illuminant, observer, .. } = &snapshot.canvas.lighting;
    assert_eq!(
        (illuminant, observer),
        (&window.state().lighting.illuminant, &window.state().lighting.observer),
        "the state tells of this light"
    );
    let canvas = exported(&snapshot.canvas, &light);
    let palette = exported(&snapshot.palette, &light);
    window.wait_until("the canvas as it is", |window| window.pictures.canvas == canvas);
    window.wait_until("the palette as it is", |window| window.pictures.palette == palette);
}

/// A step of the test.
type Step<'a> = &'a dyn Fn(&mut Window);

#[test]
fn tiles_cover_every_change() {
    let mut window = Window::open(BackendChoice::Cpu);
    let turned = |azimuth_deg| Lighting { azimuth_deg, ..Lighting::default() };
    let lamp = Lighting { illuminant: "A".to_owned(), ..Lighting::default() };
    let far = wander(11, 150, 32.0, 20.0);
    let near = wander(12, 80, 10.0, 8.0);
    window.act(load("round", "Ultramarine"));
    window.act(load("flat", "Chrome Yellow"));
    let opacity = Action::Opacity { layer: LayerRef::Dry(0), value: 0.3 };
    let swap = Action::Swap {
        layer: LayerRef::Dry(0),
        from: "Ultramarine".to_owned(),
        to: "Emerald Green".to_owned(),
    };
    let steps: [(&str, Step<'_>); 12] = [
        ("a stroke", &|w| w.stroke(SurfaceId::Canvas, "round", far.chunks(9))),
        ("mixing", &|w| w.stroke(SurfaceId::Palette, "flat", near.chunks(4))),
        ("drying", &|w| w.act(Action::Dry { fraction: 0.6 })),
        ("a stroke over it", &|w| w.stroke(SurfaceId::Canvas, "flat", far.chunks(50))),
        ("undo", &|w| w.act(Action::Undo {})),
        ("another lamp", &|w| w.act(Action::Light(lamp.clone()))),
        ("a thinner layer", &|w| w.act(opacity.clone())),
        ("other pigments", &|w| w.act(swap.clone())),
        ("the first state", &|w| w.ask(Command::GoTo(1))),
        ("the last state", &|w| w.ask(Command::GoTo(6))),
        ("a lamp that turns", &|w| {
            w.ask(Command::Adjust(Action::Light(turned(10.0))));
            w.ask(Command::Adjust(Action::Light(turned(120.0))));
            w.ask(Command::EndAdjustment);
        }),
        ("scraping", &|w| w.act(Action::Scrape { on: SurfaceId::Palette })),
    ];
    for (what, step) in steps {
        println!("after {what}");
        step(&mut window);
        let snapshot = window.snapshot();
        window.wait_until("the state", |window| window.state().revision == snapshot.revision);
        assert_pictures(&mut window, &snapshot);
    }
    assert!(
        !window
            .events
            .iter()
            .any(|event| matches!(event, session::Event::Message { failed: true, .. })),
        "nothing was refused"
    );
}

#[test]
fn a_second_light_has_its_own_picture() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("round", "Vermilion"));
    let lamp = Lighting { illuminant: "FL11".to_owned(), ..Lighting::default() };
    window.ask(Command::SetSecondLight(Some(lamp.clone())));
    let samples = wander(13, 100, 32.0, 20.0);
    window.stroke(SurfaceId::Canvas, "round", samples.chunks(10));
    let snapshot = window.snapshot();
    window.wait_until("the state", |window| window.state().second_lighting.as_ref() == Some(&lamp));
    assert_pictures(&mut window, &snapshot);
    let Lighting { illuminant, observer, .. } = &lamp;
    let light = Light::named(&snapshot.canvas.library, illuminant, observer).unwrap();
    let under = Document { lighting: lamp.clone(), ..(*snapshot.canvas).clone() };
    let second = exported(&under, &light);
    window.wait_until("the second picture", |window| window.pictures.second == second);
    assert!(second != window.pictures.canvas, "the lights differ");
    let under = Document { lighting: lamp.clone(), ..(*snapshot.palette).clone() };
    let palette = exported(&under, &light);
    window.wait_until("the palette", |window| window.pictures.second_palette == palette);
    assert!(palette != window.pictures.palette, "the wood differs too");
    window.ask(Command::SetSecondLight(None));
    window.wait_until("no second light", |window| window.state().second_lighting.is_none());
}
