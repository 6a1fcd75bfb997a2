//! Timelapses of the session's recording.

use std::io::Cursor;

use egui_kittest::kittest::Queryable;
use image::AnimationDecoder;
use image::codecs::png::PngDecoder;
use paint::brush::HeadShape;
use paint::pose::Sample;
use paint::strokes::{
    Action, BrushSpec, LayerRef, Load, Stroke, StrokeScript, StrokeTool, SurfaceId,
};
use studio::files::FileRequest;

use super::bench::{Window, ask, click, folder, painted, picture, shows, type_name, until, window};

/// A recording of two strokes of a second on the canvas of the bench.
fn recorded(window: &Window) -> StrokeScript {
    let mut script = window.state().script();
    let spec = BrushSpec { shape: HeadShape::Round, size_mm: 3.0 };
    script.brushes.insert("round".to_owned(), spec);
    let brush = "round".to_owned();
    let recipe = [("Ultramarine".to_owned(), 1.0)].into();
    script.actions.push(Action::Load(Load { brush, recipe, vehicle: 0.1, amount_mm: 0.3 }));
    for y_mm in [5.0, 10.0] {
        let samples = (0..=20)
            .map(|index: u32| {
                let share = f64::from(index) / 20.0;
                Sample::upright(share, 3.0 + 18.0 * share, y_mm, 0.6)
            })
            .collect();
        let brush = "round".to_owned();
        let on = SurfaceId::Canvas;
        script.actions.push(Action::Stroke(Stroke { brush, on, tool: StrokeTool::Paint, samples }));
    }
    script
}

fn export(window: &mut Window, form: &str, name: &str) {
    ask(window, FileRequest::ExportTimelapse);
    click(window, form);
    click(window, "One after");
    picture(window, "timelapse");
    click(window, "Choose a name");
    type_name(window, name);
    click(window, "Save");
}

#[test]
fn a_timelapse_is_written_in_each_form() {
    let (folder, _) = folder();
    let mut window = window(folder.path(), painted("A"));
    let script = recorded(&window);
    window.state_mut().recorded = Some(script);
    let path = |name: &str| folder.path().join(name);

    export(&mut window, "GIF", "film.gif");
    until(&mut window, "the GIF", |window| shows(window, "Exported") && path("film.gif").is_file());
    let gif = std::fs::read(path("film.gif")).unwrap();
    assert!(gif.starts_with(b"GIF89a") && gif[6..10] == [120, 0, 80, 0], "a pixel a cell");

    export(&mut window, "Animated PNG", "film.png");
    let left = path(".film.png.frames");
    until(&mut window, "the APNG", |_| path("film.png").is_file() && !left.exists());
    let apng = std::fs::read(path("film.png")).unwrap();
    let apng = PngDecoder::new(Cursor::new(apng)).unwrap().apng().unwrap().into_frames();
    let apng = apng.collect_frames().unwrap();
    assert_eq!(apng.len(), 3, "the start, and one after each stroke");
    assert_eq!(apng[2].delay().numer_denom_ms(), (2000, 1), "the end is held");
    let differing = |a: usize, b: usize| {
        let pairs = apng[a].buffer().pixels().zip(apng[b].buffer().pixels());
        pairs.filter(|(a, b)| a != b).count()
    };
    assert!(differing(0, 1) > 200 && differing(1, 2) > 200, "each frame has one stroke more");

    export(&mut window, "Folder of PNG frames", "film");
    let frames = path("film.frames");
    until(&mut window, "the frames", |_| frames.join("frame-0003.png").is_file());
    let last = image::open(frames.join("frame-0003.png")).unwrap().into_rgba8();
    assert!(last == *apng[2].buffer(), "the same picture");
    assert!(frames.join("animation.json").is_file());
}

#[test]
fn a_recording_that_cannot_be_played_is_told_of() {
    let (folder, _) = folder();
    let mut window = window(folder.path(), painted("A"));
    let mut script = recorded(&window);
    script.actions.push(Action::Merge { layer: LayerRef::Dry(3), with: None });
    window.state_mut().recorded = Some(script);
    export(&mut window, "GIF", "film.gif");
    until(&mut window, "the reason", |window| {
        window.query_all_by_label_contains("(merge)").next().is_some()
    });
    assert!(!folder.path().join("film.gif").exists(), "nothing is written");
}
