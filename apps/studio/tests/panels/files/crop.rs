//! Cropping the painting.

use graphics::tile::Rect;
use session::{Command, Origin};
use studio::files::FileRequest;

use super::bench::{ask, folder, painted, shows, until, window};

#[test]
fn a_crop_opens_the_part_that_stays_as_an_unsaved_painting() {
    let (folder, _) = folder();
    let mut window = window(folder.path(), painted("A"));
    let rect = Rect { x: 10, y: 20, width: 60, height: 40 };
    let whole = window.state().canvas.clone();
    ask(&mut window, FileRequest::Crop(rect));
    until(&mut window, "the part", |window| !window.state().commands.is_empty());
    // The palette of the bench has paint, which must not be lost.
    let [Command::Open(Origin::Recovered { canvas, palette, .. })] = &window.state().commands[..]
    else {
        panic!("{:?}", window.state().commands)
    };
    assert_eq!(**canvas, whole.cropped(rect));
    assert_eq!(**palette, *whole, "the palette stays as it is");
    assert!(window.state_mut().files().has_unsaved_changes(), "the part is in no file");
    assert!(shows(&window, "Cropped to 12.0 x 8.0 mm"), "the size is told");
}

#[test]
fn a_crop_with_a_clean_palette_begins_a_recording() {
    let (folder, path) = folder();
    let mut window = window(folder.path(), painted("A"));
    let bench = window.state_mut();
    let mut clean = (*bench.palette).clone();
    clean.wet = paint::layer::Layer::empty(120, 80);
    bench.palette = std::sync::Arc::new(clean);
    let rect = Rect { x: 0, y: 0, width: 30, height: 30 };
    ask(&mut window, FileRequest::Crop(rect));
    until(&mut window, "the part", |window| !window.state().commands.is_empty());
    let [Command::Open(Origin::Painting(part))] = &window.state().commands[..] else {
        panic!("{:?}", window.state().commands)
    };
    let part = part.clone();
    let mut script = paint::StrokeScript::continue_from("part.exr", &part);
    script.mixing = None;
    window.state_mut().recorded = Some(script);
    ask(&mut window, FileRequest::SaveRecording);
    super::bench::type_name(&mut window, "study");
    super::bench::click(&mut window, "Save");
    let start = path.with_extension("start.exr");
    until(&mut window, "the recording", |_| path.with_extension("json").is_file());
    assert_eq!(super::bench::document(&start), *part, "the recording starts from the part");
}
