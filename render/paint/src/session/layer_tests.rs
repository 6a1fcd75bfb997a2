//! Tests of actions on layers, of palette and brushes from a file, and of the memory of undo.

use std::convert::Infallible;
use std::ops::ControlFlow;

use pigment::library::PigmentLibrary;

use super::state::{Outcome, PaintingSession};
use crate::brush::{HeadShape, StrokeTool};
use crate::document::{Document, LayerId};
use crate::engine::PaintEngine;
use crate::file::{read, read_table, write_with_table};
use crate::history::TILE_BYTES;
use crate::painting::{LayerRef, MaskChange, Painting};
use crate::pose::Sample;
use crate::strokes::{
    Action, BrushSpec, KeptBrush, Load, Recipe, SideTable, Squeeze, Stroke, StrokeScript, SurfaceId,
};

fn script() -> StrokeScript {
    let text = r#"{"format": "strokes", "version": 1, "brushes": {}, "actions": [],
        "canvas": {"width_mm": 20, "height_mm": 14, "cell_mm": 0.2},
        "mixing": {"width_mm": 16, "height_mm": 12, "cell_mm": 0.2},
        "palette": ["Lead White", "Vermilion"]}"#;
    StrokeScript::from_json("header", text.as_bytes()).unwrap()
}

fn painting(document: Document) -> Painting {
    let engine = PaintEngine::on_cpu(document.ground.height.clone());
    Painting::open(document, engine, 1 << 24).unwrap()
}

fn session_on(script: &StrokeScript, start: Option<(Document, SideTable)>) -> PaintingSession {
    let library = PigmentLibrary::van_gogh_oils();
    let (start, table) = start.unzip();
    let (canvas, palette, brushes) = script.surfaces_with_table(&library, start, table).unwrap();
    let canvas = painting(canvas);
    let palette = palette.map(painting);
    let mut session = PaintingSession::recorded(canvas, palette, script).unwrap();
    assert_eq!(session.take_up(&brushes).unwrap(), Vec::<String>::new());
    for (name, shape) in [("flat", HeadShape::Flat), ("knife", HeadShape::Knife)] {
        session.set_brush(name, &BrushSpec { shape, size_mm: 3.0 }).unwrap();
    }
    session
}

fn load(brush: &str, pigment: &str) -> Action {
    let recipe = Recipe::from([(pigment.to_owned(), 1.0)]);
    Action::Load(Load { brush: brush.to_owned(), recipe, vehicle: 0.1, amount_mm: 0.4 })
}

fn stroke(on: SurfaceId, brush: &str, y_mm: f64) -> Action {
    let samples = [3.0, 9.0, 13.0].map(|x_mm| Sample::upright(x_mm / 10.0, x_mm, y_mm, 0.6));
    Action::Stroke(Stroke {
        brush: brush.to_owned(),
        on,
        tool: StrokeTool::Paint,
        samples: samples.to_vec(),
    })
}

fn id(number: u32) -> LayerRef {
    LayerRef::Id(LayerId(number))
}

fn act(session: &mut PaintingSession, actions: impl IntoIterator<Item = Action>) {
    for action in actions {
        let outcome = session.apply(&action);
        assert!(
            matches!(outcome, Ok(Outcome::Done | Outcome::Painted(_))),
            "{action:?} {outcome:?}"
        );
    }
}

/// Three dry layers of one paint, 1 and 3 over each other.
fn layered(session: &mut PaintingSession) {
    act(session, [load("flat", "Lead White")]);
    for y_mm in [4.0, 10.0, 4.5] {
        act(session, [stroke(SurfaceId::Canvas, "flat", y_mm), Action::Dry { fraction: 1.0 }]);
    }
}

type Whole = (Document, Option<Document>, Vec<KeptBrush>);

fn whole(session: &mut PaintingSession) -> Whole {
    let (canvas, palette) = session.documents().unwrap();
    (canvas, palette, session.kept_brushes().unwrap())
}

/// Asserts that the recording of `session`, written and read, replays to the same bits on `again`.
fn assert_replays(session: &mut PaintingSession, mut again: PaintingSession) {
    let text = session.recording().unwrap().to_json().unwrap();
    let script = StrokeScript::from_json("a.json", text.as_bytes()).unwrap();
    script
        .replay(
            &mut again,
            |_: &str, _: &mut Painting| Ok::<(), Infallible>(()),
            || ControlFlow::Continue(()),
        )
        .unwrap();
    assert!(whole(&mut again) == whole(session), "not the same paint");
}

#[test]
fn actions_on_layers_are_undone_recorded_and_mean_the_same_layer_after_each_other() {
    let script = script();
    let mut session = session_on(&script, None);
    layered(&mut session);
    let before = whole(&mut session);
    act(
        &mut session,
        [
            Action::Name { layer: id(2), name: "low".to_owned() },
            Action::Order { layer: id(2), to: 2 },
            Action::Visible { layer: id(2), value: false },
            Action::Merge { layer: id(3), with: Some(id(1)) },
            Action::Opacity { layer: id(2), value: 0.5 },
        ],
    );
    let dry = &session.canvas().state().dry;
    assert_eq!(dry.iter().map(|layer| layer.id.0).collect::<Vec<_>>(), [1, 2]);
    assert_eq!((dry[1].name.as_str(), dry[1].visible, dry[1].opacity), ("low", false, 0.5));
    let (labels, done) = session.history();
    assert_eq!(
        labels[labels.len() - 3..],
        ["hide low", "merge Layer 3 with Layer 1", "50 % of low"]
    );
    let nothing = session.apply(&Action::Order { layer: id(2), to: 1 }).unwrap();
    assert_eq!(nothing, Outcome::Nothing, "it lies there");
    session.go_to(done - 5).unwrap();
    assert!(whole(&mut session) == before, "undo");
    session.go_to(done).unwrap();
    assert_replays(&mut session, session_on(&script, None));
    let error = session.apply(&Action::Visible { layer: id(3), value: true }).unwrap_err();
    assert_eq!(error.to_string(), "there is no layer 3; the painting has 1, 2");
    let lowest = Action::Merge { layer: id(1), with: None };
    assert!(session.apply(&lowest).unwrap_err().to_string().contains("no dry layer below"));
}

#[test]
fn a_painting_goes_on_with_its_palette_and_brushes_and_is_recorded() {
    let mut yesterday = session_on(&script(), None);
    layered(&mut yesterday);
    let heap = Squeeze {
        on: SurfaceId::Palette,
        recipe: Recipe::from([("Vermilion".to_owned(), 1.0)]),
        vehicle: 0.0,
        x_mm: 8.0,
        y_mm: 6.0,
        volume_mm3: 20.0,
    };
    let mix = stroke(SurfaceId::Palette, "flat", 6.0);
    act(&mut yesterday, [Action::Squeeze(heap), load("knife", "Vermilion"), mix]);
    let left = whole(&mut yesterday);
    let table = SideTable { palette: left.1.clone().unwrap(), brushes: left.2.clone() };
    let bytes = write_with_table(&left.0, &table.palette, &table.brushes).unwrap();

    let script = StrokeScript::continue_with_table("a.exr", &left.0, &table);
    let text = script.to_json().unwrap();
    assert!(text.contains("\"table\": true"), "{text}");
    let script = StrokeScript::from_json("a.json", text.as_bytes()).unwrap();
    let opened = || {
        let start = read("a.exr", &bytes).unwrap();
        session_on(&script, Some((start, read_table("a.exr", &bytes).unwrap().unwrap())))
    };
    let mut today = opened();
    assert!(whole(&mut today) == left, "not as it was left");
    assert_eq!(today.history(), (Vec::new(), 0), "taking up is no action");
    let on_canvas = [("flat", 7.0), ("knife", 12.0)];
    act(&mut today, on_canvas.map(|(brush, y)| stroke(SurfaceId::Canvas, brush, y)));
    let (canvas, _) = today.documents().unwrap();
    assert!(canvas.wet.totals()[1] > 0, "the brushes held vermilion");
    assert_replays(&mut today, opened());
    today.go_to(0).unwrap();
    assert!(whole(&mut today) == left, "the undo puts the loads back");
    // Without the key the palette is bare, whatever the file holds.
    let mut bare = script.clone();
    bare.table = false;
    let library = PigmentLibrary::van_gogh_oils();
    let table = || Some(table.clone());
    let (_, palette, brushes) =
        bare.surfaces_with_table(&library, Some(left.0.clone()), table()).unwrap();
    assert_eq!((palette.unwrap().wet.totals(), brushes.len()), ([0; 9], 0));
    let missing = script.surfaces_with_table(&library, Some(left.0.clone()), None).unwrap_err();
    assert!(missing.to_string().starts_with("table: "), "{missing}");
    let mut other = left.0.clone();
    other.lighting.azimuth_deg += 1.0;
    let other = script.surfaces_with_table(&library, Some(other), table()).unwrap_err();
    assert!(other.to_string().contains("another painting's"), "{other}");
}

#[test]
fn a_brush_whose_head_has_other_cells_comes_clean() {
    let mut session = session_on(&script(), None);
    act(&mut session, [load("flat", "Lead White"), load("knife", "Vermilion")]);
    let mut kept = session.kept_brushes().unwrap();
    kept[0].spec.size_mm = 4.0;
    let mut again = PaintingSession::new(painting(session.documents().unwrap().0), None).unwrap();
    assert_eq!(again.take_up(&kept).unwrap(), ["flat"]);
    assert!(again.kept_brushes().unwrap()[0].paint.is_none(), "it holds paint");
    assert_eq!(again.kept_brushes().unwrap()[1], kept[1], "the other holds its own");
}

#[test]
fn a_surface_may_use_the_memory_of_undo_that_the_other_leaves() {
    let mut session = session_on(&script(), None);
    act(&mut session, [load("flat", "Lead White"), load("knife", "Vermilion")]);
    // The canvas has 2 x 2 tiles: strokes of 7 tiles take more than three quarters of this.
    let limit = 8 * TILE_BYTES;
    session.set_undo_bytes(limit);
    act(&mut session, [3.0, 4.0].map(|y_mm| stroke(SurfaceId::Canvas, "flat", y_mm)));
    assert_eq!(session.history().1, 2);
    let mut palette = 0;
    for y_mm in [2.0, 4.0, 6.0, 8.0, 10.0] {
        act(&mut session, [stroke(SurfaceId::Palette, "knife", y_mm)]);
        palette += 1;
        let (used, most) = session.undo_bytes();
        assert!(used <= most && most == limit, "{used} of {most}");
    }
    // What cannot be reached gives its memory to the surface that is worked on.
    let reachable = session.history().1;
    assert!((1..=palette).contains(&reachable), "{reachable}");
    assert_eq!(session.canvas().undo_bytes().0, 0, "the canvas holds what nothing reaches");
    let (used, _) = session.painting(SurfaceId::Palette).unwrap().undo_bytes();
    assert!(used > limit / 2, "{used} of {limit} for the palette");
}

#[test]
fn the_history_names_layers_as_they_are_shown_before_each_action() {
    let mut session = session_on(&script(), None);
    layered(&mut session);
    let name = "sky".to_owned();
    act(
        &mut session,
        [
            Action::Name { layer: LayerRef::Dry(1), name },
            Action::Order { layer: LayerRef::Dry(0), to: 2 },
            Action::Mask(MaskChange::Layer(LayerRef::Dry(0))),
            Action::Visible { layer: LayerRef::Dry(2), value: false },
            Action::Order { layer: LayerRef::Dry(1), to: 2 },
            Action::Visible { layer: LayerRef::Dry(1), value: true },
            Action::Merge { layer: LayerRef::Dry(2), with: None },
        ],
    );
    let labels = session.history().0;
    let wanted = [
        "Layer 1 to place 3",
        "mask by sky",
        "hide Layer 1",
        "Layer 3 to place 3",
        "show Layer 1",
        "merge Layer 3 with the one below",
    ];
    assert_eq!(labels[labels.len() - 6..], wanted);
}
