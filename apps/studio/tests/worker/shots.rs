//! Pictures of the canvas along the history.

use graphics::gpu::BackendChoice;
use paint::document::Lighting;
use paint::strokes::{Action, Squeeze, SurfaceId};
use session::{Command, HistoryShot};
use spectra::color::Rgb;

use super::pen::{load, wander};
use super::window::Window;

/// Side of a pixel of the pictures in cells: 320 cells of the small canvas take 160 pixels.
const STEP: usize = 2;

fn shots(window: &Window) -> Vec<Option<&HistoryShot>> {
    window.state().history_shots.shots.iter().map(Option::as_ref).collect()
}

/// Mean light of a pixel's cells in the picture that the window received, as bytes.
fn seen(window: &Window, x: usize, y: usize) -> [u8; 3] {
    let cells = (0..STEP * STEP).map(|i| (STEP * x + i % STEP, STEP * y + i / STEP));
    let mut sum = [0.0; 3];
    for (x, y) in cells {
        let [r, g, b, _] = window.pictures.canvas[y * 320 + x];
        let light = Rgb([r, g, b].map(|byte| f64::from(byte) / 255.0)).linear().0;
        sum.iter_mut().zip(light).for_each(|(sum, light)| *sum += light);
    }
    Rgb(sum.map(|sum| sum / (STEP * STEP) as f64)).encoded().to_bytes()
}

fn heap(on: SurfaceId) -> Action {
    let recipe = [("Vermilion".to_owned(), 1.0)].into();
    Action::Squeeze(Squeeze { on, recipe, vehicle: 0.0, x_mm: 5.0, y_mm: 4.0, volume_mm3: 3.0 })
}

#[test]
fn every_action_has_a_picture_of_the_canvas_after_it() {
    let mut window = Window::open(BackendChoice::Cpu);
    let samples = wander(5, 120, 32.0, 20.0);
    window.act(load("round", "Bone Black"));
    window.stroke(SurfaceId::Canvas, "round", samples.chunks(20));
    window.act(heap(SurfaceId::Palette));
    window.act(heap(SurfaceId::Canvas));
    let snapshot = window.snapshot();
    window.wait_until("all pictures", |window| {
        let shots = shots(window);
        window.state().revision == snapshot.revision
            && shots.len() == 4
            && shots.iter().all(Option::is_some)
    });
    let shots: Vec<HistoryShot> = shots(&window).into_iter().flatten().cloned().collect();
    assert_eq!((shots[0].picture.width, shots[0].picture.height), (160, 100));
    assert_eq!(shots[0].changed, None, "nothing comes before the beginning");
    assert!(shots[1].changed.is_some(), "the stroke is outlined");
    assert_eq!(shots[2].changed, None, "the palette is not on the picture");
    assert!(std::sync::Arc::ptr_eq(&shots[1].picture, &shots[2].picture), "kept once");
    // The heap of 3 mm3 at 5, 4 mm, whose radius is 0.94 of the cube root: 27 cells across.
    let [left, top, width, height] = shots[3].changed.expect("the heap is outlined");
    assert!(
        left <= 25 && left + width >= 25 && top <= 20 && top + height >= 20,
        "{:?}",
        shots[3].changed
    );
    assert!(width < 30 && height < 30, "only the heap: {:?}", shots[3].changed);
    let three = window.state().history_shots.bytes;
    assert_eq!(three, 3 * 160 * 100 * 4, "three different pictures");
    window.wait_until("the picture", |window| {
        window.pictures.canvas.iter().all(|cell| cell[3] == 255)
    });
    let mut far = 0;
    for (index, pixel) in shots[3].picture.pixels.iter().enumerate() {
        let seen = seen(&window, index % 160, index / 160);
        let apart = pixel.iter().zip(seen).map(|(a, b)| a.abs_diff(b)).max().expect("three bytes");
        far += usize::from(apart > 8);
    }
    // Highlights are cut off cell by cell on the screen, and after the mean in the picture.
    assert!(far < 160, "{far} of 16000 pixels are not those that the window shows");
}

#[test]
fn pictures_stay_with_their_actions_through_undo_and_adjustments() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(heap(SurfaceId::Canvas));
    window.act(Action::Dry { fraction: 1.0 });
    window.ask(Command::GoTo(1));
    let opened = window.snapshot();
    window.wait_until("two pictures", |window| {
        window.state().revision == opened.revision && shots(window).iter().flatten().count() == 3
    });
    let before: Vec<_> = shots(&window).into_iter().map(Option::<&HistoryShot>::cloned).collect();
    assert_eq!(window.state().history_done, 1);
    let turned = |azimuth_deg| Action::Light(Lighting { azimuth_deg, ..Lighting::default() });
    let first = turned(10.0);
    let last = turned(200.0);
    window.ask(Command::Adjust(first));
    window.ask(Command::Adjust(last));
    window.ask(Command::EndAdjustment);
    let adjusted = window.snapshot();
    window.wait_until("the adjusted picture", |window| {
        let shots = shots(window);
        let light = window.state().history.last().is_some_and(|last| last.starts_with("light"));
        window.state().revision == adjusted.revision && light && shots[2].is_some()
    });
    let after: Vec<_> = shots(&window).into_iter().map(Option::<&HistoryShot>::cloned).collect();
    assert_eq!(after[..2], before[..2], "what was before stays");
    let [_, _, width, height] = after[2].as_ref().and_then(|shot| shot.changed).expect("a change");
    assert!(width > 150 && height > 90, "light from another side changes all: {width} x {height}");
}
