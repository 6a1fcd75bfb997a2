//! The shipped stroke scripts equal the output of their generators, and can be painted.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

#[path = "../../../render/paint/examples/paintings/color_study.rs"]
mod color_study;

#[path = "../../../render/paint/examples/paintings/script_builder.rs"]
mod script_builder;

#[path = "../../../render/paint/examples/paintings/glaze.rs"]
mod glaze;

#[path = "../../../render/paint/examples/paintings/landscape.rs"]
mod landscape;

#[path = "../../../render/paint/examples/paintings/still_life.rs"]
mod still_life;

use std::convert::Infallible;
use std::ops::ControlFlow;

use graphics::field::Field;
use paint::engine::PaintEngine;
use paint::painting::{Painting, UNDO_BYTES};
use paint::session::{PaintingSession, ReplayReport};
use paint::strokes::StrokeScript;
use suite::program::repository;

fn shipped(name: &str) -> String {
    std::fs::read_to_string(repository(&format!("paintings/{name}.json"))).unwrap()
}

fn painted(script: &StrokeScript) -> (ReplayReport, PaintingSession) {
    let (document, _) = script.surfaces(&suite::oils::library(), None).unwrap();
    let engine = PaintEngine::on_cpu(document.ground.height.clone());
    let canvas = Painting::open(document, engine, UNDO_BYTES).unwrap();
    let mut session = PaintingSession::new(canvas, None).unwrap();
    let report = script
        .replay(
            &mut session,
            |_: &str, _: &mut Painting| Ok::<_, Infallible>(()),
            || ControlFlow::Continue(()),
        )
        .unwrap();
    (report, session)
}

/// A copy of `script` with only its first `actions` actions, on cells of twice the size. The tests
/// of the pages also play them at their own size.
fn begun(script: &StrokeScript, actions: usize) -> StrokeScript {
    let mut begun = script.clone();
    begun.actions.truncate(actions);
    begun.canvas.cell_mm *= 2.0;
    begun
}

#[test]
fn every_script_is_what_its_program_makes() {
    for (name, script) in [
        ("colour-study", color_study::script()),
        ("glaze", glaze::script()),
        ("landscape", landscape::script()),
        ("still-life", still_life::script()),
    ] {
        let made = script.to_json().unwrap();
        assert!(made == shipped(name), "{name}: run the example `paintings` again");
        assert_eq!(script.licence, "CC0-1.0");
        let read = StrokeScript::from_json(name, shipped(name).as_bytes()).unwrap();
        assert_eq!(read.actions.len(), script.actions.len(), "{name}");
    }
}

#[test]
fn the_long_ones_begin_well() {
    for name in ["glaze", "landscape", "still-life"] {
        let script = StrokeScript::from_json(name, shipped(name).as_bytes()).unwrap();
        let (report, mut session) = painted(&begun(&script, 60));
        assert_eq!((report.actions, report.idle), (60, 0), "{name}");
        let wet = session.canvas_mut().wet().unwrap();
        let dry = session.canvas().state().dry.len();
        assert!(
            dry > 0 || (0..wet.vehicle.values().len()).any(|i| wet.cell(i).volume() > 0),
            "{name}"
        );
    }
}

#[test]
fn the_study_is_the_same_twice_and_yellow_meets_blue_through_green() {
    let name = "colour-study";
    let script = StrokeScript::from_json(name, shipped(name).as_bytes()).unwrap();
    let [first, second]: [Field<[f32; 4]>; 2] =
        [(); 2].map(|()| painted(&script).1.canvas_mut().picture().unwrap());
    assert!(first.values() == second.values(), "the pictures differ");
    for (x_mm, paint, wanted) in [
        (15.0, "pure yellow", [-1.0, 0.05]),
        (60.0, "mixed", [0.5, 2.0]),
        (120.0, "pure blue", [-1.0, 0.05]),
    ] {
        let [y, x, width] = [12.0, x_mm, 10.0].map(|mm| (mm / script.canvas.cell_mm) as usize);
        let cells = first.row(y, x, width);
        let green = cells.iter().filter(|c| c[1] > 1.2 * c[0] && c[1] > 1.2 * c[2]).count();
        let share = green as f64 / cells.len() as f64;
        assert!(wanted[0] < share && share < wanted[1], "{paint}: {share}");
    }
}
