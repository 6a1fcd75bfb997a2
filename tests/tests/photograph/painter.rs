//! Painting a picture in strokes: the error falls from level to level, and the recorded script
//! gives the same painting.

use std::convert::Infallible;
use std::ops::ControlFlow;

use graphics::field::Field;
use paint::document::Document;
use paint::engine::PaintEngine;
use paint::painting::Painting;
use paint::session::{PaintingSession, ReplayReport};
use paint::strokes::{Action, Canvas, PaletteSpec, StrokeScript};
use strokes::{
    LevelReport, PaintProgress, Painter, Picture, Plan, black_compensated, plan_layer,
    rebuild_picture,
};

use crate::made::{HIDING, STUDIO};

const CELL_MM: f64 = 0.5;

/// A red disc on blue over ochre, 48 x 36 cells.
fn target() -> Picture {
    let color = |i: usize| {
        let x = (i % 48) as f32 - 20.0;
        let y = (i / 48) as f32 - 16.0;
        match (x.hypot(y) < 9.0, y > 6.0) {
            (true, _) => [0.5, 0.08 + 0.004 * (x + 10.0), 0.06],
            (_, true) => [0.45, 0.3, 0.12],
            _ => [0.12, 0.16, 0.3 + 0.005 * y],
        }
    };
    let picture = Field::from_values(48, 36, (0..48 * 36).map(color).collect());
    black_compensated(&picture, HIDING.black())
}

fn plan() -> Plan {
    Plan { sizes_mm: vec![5.0, 2.5, 1.5], seed: 3, ..Plan::default() }
}

/// A script without strokes on a smooth panel.
fn bare_script() -> StrokeScript {
    let canvas =
        r#"{"width_mm": 24, "height_mm": 18, "cell_mm": 0.5, "ground": {"kind": "panel"}}"#;
    let canvas: Canvas = serde_json::from_str(canvas).unwrap();
    let names = STUDIO.slots.iter().flatten().map(|&pigment| STUDIO.library[pigment].name.as_str());
    StrokeScript::new("disc", "CC0-1.0", canvas, PaletteSpec::from_names(names))
}

fn opened(script: &StrokeScript) -> Painting {
    let resolved = script.resolve(&STUDIO.library).unwrap();
    let (width, height) = script.canvas.cells();
    let ground = script.canvas.ground.build(width, height, CELL_MM, &STUDIO.library).unwrap();
    let engine = PaintEngine::on_cpu(ground.height.clone());
    Painting::open(script.bare(&STUDIO.library, &resolved, ground), engine, 0).unwrap()
}

/// Result of painting the target.
struct Finished {
    script: StrokeScript,
    session: PaintingSession,
    levels: Vec<LevelReport>,
    /// Number of strokes reported as planned, and number reported as painted.
    told: (usize, usize),
}

fn painted(plan: &Plan) -> Finished {
    let mut script = bare_script();
    let mut session = PaintingSession::new(opened(&script), None).unwrap();
    let mut told = (0, 0);
    let target = target();
    let painter = Painter { target: &target, separation: &HIDING, plan };
    let levels = painter
        .paint(&mut session, &mut script, |painted| match painted {
            PaintProgress::Planned(strokes) => told.0 += strokes,
            PaintProgress::Stroke => told.1 += 1,
        })
        .unwrap();
    Finished { script, session, levels, told }
}

fn replayed(text: &str) -> (Document, ReplayReport) {
    let script = StrokeScript::from_json("disc.json", text.as_bytes()).unwrap();
    let mut session = PaintingSession::new(opened(&script), None).unwrap();
    let report = script
        .replay(
            &mut session,
            |_: &str, _: &mut Painting| Ok::<_, Infallible>(()),
            || ControlFlow::Continue(()),
        )
        .unwrap();
    (session.documents().unwrap().0, report)
}

#[test]
fn a_painting_ends_at_a_quarter_of_the_difference_it_began_with() {
    let mut finished = painted(&plan());
    let target = target();
    let plan = plan();
    let painter = Painter { target: &target, separation: &HIDING, plan: &plan };
    let before = painter.errors(&mut opened(&bare_script()), 0.0).unwrap();
    let after = painter.errors(finished.session.canvas_mut(), 0.0).unwrap();
    assert!(after.mean < before.mean / 4.0, "{} of {}", after.mean, before.mean);
    let sizes: Vec<f64> = finished.levels.iter().map(|level| level.size_mm).collect();
    assert_eq!(sizes, plan.sizes_mm);
    for pair in finished.levels.windows(2) {
        assert!(pair[1].mean_error < 1.2 * pair[0].mean_error, "{:?}", finished.levels);
    }
    assert!(
        finished.session.canvas_mut().wet().unwrap().totals().iter().all(|total| *total == 0),
        "paint is still wet"
    );
}

#[test]
fn a_ground_of_the_color_of_the_picture_is_covered() {
    let bare = opened(&bare_script()).flat_picture().unwrap();
    let ground = bare.values()[0];
    let target = Field::filled(48, 36, [ground[0], ground[1], ground[2]]);
    let plan = plan();
    let painter = Painter { target: &target, separation: &HIDING, plan: &plan };
    let mut script = bare_script();
    let mut session = PaintingSession::new(opened(&script), None).unwrap();
    painter.paint(&mut session, &mut script, |_| {}).unwrap();
    let layers = session.canvas_mut().document().unwrap().dry;
    let covered = (0..48 * 36)
        .filter(|&cell| layers.iter().any(|layer| layer.paint.cell(cell).volume() > 0))
        .count();
    assert!(covered > 48 * 36 * 98 / 100, "{covered} of {} cells", 48 * 36);
}

#[test]
fn the_recorded_strokes_paint_the_same_bit_for_bit() {
    let mut finished = painted(&plan());
    let strokes = finished.script.actions.iter().filter(|a| a.kind() == "stroke").count();
    let laid: u64 = finished.levels.iter().map(|level| level.strokes).sum();
    assert!(strokes > 20, "{strokes} strokes");
    assert_eq!((strokes, strokes), finished.told);
    let text = finished.script.to_json().unwrap();
    let (document, report) = replayed(&text);
    let wanted = finished.session.canvas_mut().document().unwrap();
    assert!(wanted.dry.len() >= 3, "{} dry layers", wanted.dry.len());
    assert!(document.wet == wanted.wet && document.dry == wanted.dry, "the paintings differ");
    assert_eq!((report.strokes, report.strokes), (laid, strokes as u64));
    // Before every stroke the brush is washed and loaded.
    for actions in finished.script.actions.windows(3) {
        if let [first, Action::Load(load), stroke] = actions {
            assert_eq!((first.kind(), stroke.kind()), ("wash", "stroke"));
            assert!(load.amount_mm > 0.0 && load.recipe.values().all(|part| *part >= 1e-6));
        }
    }
}

#[test]
fn a_seed_gives_the_same_bytes_and_another_gives_others() {
    let text = |seed| painted(&Plan { seed, ..plan() }).script.to_json().unwrap();
    let first = text(3);
    let other = text(4);
    assert!(first == text(3), "the same seed, another script");
    assert!(first != other, "another seed, the same script");
}

#[test]
fn what_is_as_near_as_the_palette_comes_is_left_alone() {
    let target = target();
    let reached = rebuild_picture(HIDING.film(), &HIDING.separate(&target));
    assert_eq!(plan_layer(&target, &reached, &HIDING, &plan(), 2, CELL_MM), []);
}
