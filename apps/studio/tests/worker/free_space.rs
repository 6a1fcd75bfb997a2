//! Squeezing paint into free space of the palette.

use graphics::gpu::BackendChoice;
use paint::strokes::{Action, Squeeze, SurfaceId};
use session::Command;

use super::window::Window;

fn lay(window: &mut Window, pigment: &str, places: &[[f64; 2]]) {
    window.ask(Command::SqueezeInFreeSpace {
        recipe: [(pigment.to_owned(), 1.0)].into(),
        vehicle: 0.0,
        volume_mm3: 0.5,
        places: places.to_vec(),
        reach_mm: 1.0,
    });
}

/// Positions of the heaps in the recording, in mm.
fn heaps(window: &mut Window) -> Vec<[f64; 2]> {
    let recording = window.recording();
    let heaps = recording.actions.iter().filter_map(|action| match action {
        Action::Squeeze(Squeeze { on: SurfaceId::Palette, x_mm, y_mm, .. }) => Some([*x_mm, *y_mm]),
        _ => None,
    });
    heaps.collect()
}

#[test]
fn heaps_take_the_first_free_place_or_else_the_emptiest() {
    let mut window = Window::open(BackendChoice::Cpu);
    let places = [[-3.0, 2.0], [2.0, 2.0], [2.5, 2.5], [6.0, 2.0]];
    lay(&mut window, "Vermilion", &places);
    lay(&mut window, "Ultramarine", &places);
    assert_eq!(
        heaps(&mut window),
        [[2.0, 2.0], [6.0, 2.0]],
        "a place outside the surface is not used"
    );
    // With more paint at the last place, the first has the least.
    lay(&mut window, "Zinc White", &[[6.0, 2.0]]);
    lay(&mut window, "Zinc White", &[[6.0, 2.0], [2.0, 2.0]]);
    assert_eq!(heaps(&mut window)[2..], [[6.0, 2.0], [2.0, 2.0]]);
    window.act(Action::Undo {});
    window.act(Action::Undo {});
    window.act(Action::Undo {});
    lay(&mut window, "Bone Black", &places);
    assert_eq!(heaps(&mut window).last(), Some(&[6.0, 2.0]), "undone paint leaves the place free");
}

#[test]
fn without_a_place_nothing_is_squeezed_and_a_message_is_reported() {
    let mut window = Window::open(BackendChoice::Cpu);
    lay(&mut window, "Vermilion", &[[50.0, 2.0]]);
    let (text, hint, failed) = window.message();
    assert!(failed && text.contains("no place") && hint.is_some(), "{text}");
    assert!(heaps(&mut window).is_empty(), "the palette is bare");
}
