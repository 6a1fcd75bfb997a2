//! Popping of brushwork that ignores the model, beside that of ours.

use graphics::mesh::SampleModel;
use graphics::tile::Rect;

use super::super::made_up::map;
use super::super::settings::Offsets;
use super::tests::{TURNED, front, lit_with_the_model, popping_of};
use super::*;

/// Popping over `degrees` of a turn: of our strokes, of brushwork that stands still on the screen
/// while the model turns under it (a shower door), and of strokes thrown anew for each frame.
fn figures(mesh: &Mesh, degrees: f32, steps: usize) -> [f64; 3] {
    let mut settings = lit_with_the_model();
    // One tone: shading stays on the model whatever strokes do.
    (settings.light.darkest, settings.light.lightest) = (0.5, 0.5);
    let map = map(3);
    let mut painter = Painter::of_model(mesh, &map, &settings).unwrap();
    let ours = popping_of(mesh, degrees, steps, |camera, _| {
        painter.paint(camera, TURNED, 0.0).unwrap().color
    });
    let screen = front(&Settings::default(), TURNED.0);
    let screen = screen.part(Rect { x: 0, y: 0, width: TURNED.0, height: TURNED.1 });
    let fixed = popping_of(mesh, degrees, steps, |_, _| screen.clone());
    let random = popping_of(mesh, degrees, steps, |camera, number| {
        let mut settings = settings.clone();
        settings.strokes.seed = 100 + number as u64;
        settings.overlap.offsets = Offsets::Random;
        let mut painter = Painter::of_model(mesh, &map, &settings).unwrap();
        painter.paint(camera, TURNED, 0.0).unwrap().color
    });
    [ours, fixed, random]
}

#[test]
fn strokes_pop_far_less_than_a_texture_of_the_screen_and_than_random_ones() {
    // Over 6 degrees a texture that stands still has lost the model as random strokes have.
    for (shape, degrees, steps, least) in [
        (SampleModel::Sphere, 1.5, 1, 1.05),
        (SampleModel::TorusKnot, 1.5, 1, 1.05),
        (SampleModel::TorusKnot, 6.0, 2, 0.95),
    ] {
        let [ours, fixed, random] = figures(&shape.mesh(8000), degrees, steps);
        let what = format!("{} {degrees}: {ours:.3}, {fixed:.3}, {random:.3}", shape.name());
        assert!((fixed - 1.0).abs() < 1e-9, "{what}");
        assert!(random > least, "{what}");
        assert!(ours < 0.35 && ours < 0.3 * random, "{what}");
    }
}
