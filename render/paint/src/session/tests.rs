//! Tests of recordings, of actions on layers, of palette and brushes from a file, of the memory of
//! undo, and of sessions that go on from a kept one.

use std::convert::Infallible;
use std::ops::ControlFlow;
use std::sync::Arc;

use graphics::gpu::DeviceError;
use graphics::tile::Rect;
use pigment::library::PigmentLibrary;

use super::history::Limits;
use super::kept::{KeptSession, ReplayError};
use super::state::{Outcome, PaintingSession};
use crate::brush::{HeadShape, StrokeTool};
use crate::document::{Document, LayerId};
use crate::engine::{BrushId, PaintEngine};
use crate::file::{read, read_table, write_with_table};
use crate::history::TILE_BYTES;
use crate::layer::{Layer, LayerRef};
use crate::mask::Mask;
use crate::painting::Painting;
use crate::pose::Sample;
use crate::strokes::{
    Action, BrushSpec, KeptBrush, Load, MaskChange, Recipe, SideTable, Squeeze, Stroke,
    StrokeScript, SurfaceId,
};

fn recorded() -> PaintingSession {
    let library = PigmentLibrary::van_gogh_oils();
    let text = r#"{"format": "strokes", "version": 1, "brushes": {}, "actions": [],
        "canvas": {"width_mm": 8, "height_mm": 6, "cell_mm": 0.2}, "palette": ["Lead White"]}"#;
    let script = StrokeScript::from_json("header", text.as_bytes()).unwrap();
    let (canvas, _) = script.surfaces(&library, None).unwrap();
    let engine = PaintEngine::on_cpu(canvas.ground.height.clone());
    let canvas = Painting::open(canvas, engine, 1 << 24).unwrap();
    let mut session = PaintingSession::recorded(canvas, None, &script).unwrap();
    session.set_brush("round", &round(1.0)).unwrap();
    session
}

fn round(size_mm: f64) -> BrushSpec {
    BrushSpec { shape: HeadShape::Round, size_mm }
}

fn dab(session: &mut PaintingSession) {
    let sample = Sample {
        seconds: 0.0,
        x_mm: 4.0,
        y_mm: 3.0,
        pressure: 0.5,
        tilt_x_deg: 0.0,
        tilt_y_deg: 0.0,
        twist_deg: 0.0,
    };
    session.begin_stroke(SurfaceId::Canvas, "round").unwrap();
    session.extend(&[sample, sample]).unwrap();
    session.end_stroke().unwrap();
}

fn limit(session: &mut PaintingSession, limits: Limits) {
    session.record.as_mut().unwrap().limits = limits;
}

/// Asserts that the recording holds `count` strokes and stops at the next for `reason`.
fn stops(limits: Limits, count: usize, reason: &str) {
    let mut session = recorded();
    limit(&mut session, limits);
    for strokes in 1..=count {
        dab(&mut session);
        assert_eq!(session.recording().unwrap().actions.len(), strokes, "{reason}");
        assert_eq!(session.recording_stopped(), None, "{reason}");
    }
    dab(&mut session);
    assert_eq!(session.recording_stopped(), Some(reason), "after {count}");
    // Later actions would fit, but are not recorded: one before them is missing.
    limit(&mut session, Limits::default());
    session.undo().unwrap();
    dab(&mut session);
    assert_eq!(session.recording().unwrap().actions.len(), count, "{reason}");
    assert_eq!(session.history().1, count + 1, "painting goes on");
    let text = session.recording().unwrap().to_json().unwrap();
    assert!(StrokeScript::from_json("a.json", text.as_bytes()).is_ok(), "cannot be read");
}

#[test]
fn a_recording_holds_what_can_be_read_again_and_says_when_it_ends() {
    let all = Limits::default();
    stops(Limits { actions: 3, ..all }, 3, "a recording holds 3 actions");
    stops(Limits { samples: 5, ..all }, 2, "a recording holds 5 samples");
    let text = "{\"stroke\": {\"brush\": \"round\", \"samples\": [[0,4,3,0.5], [0,4,3,0.5]]}}";
    let bytes = 2 * (text.len() + 6);
    stops(Limits { bytes, ..all }, 2, "a recording holds 0 MiB");
}

#[test]
fn as_many_heads_are_recorded_as_a_file_may_name() {
    let mut session = recorded();
    limit(&mut session, Limits { brushes: 20, ..Limits::default() });
    let wipe = Action::Wipe { brush: "round".to_owned(), keep: 0.5 };
    for head in 0..20 {
        session.set_brush("round", &round(1.0 + 0.01 * f64::from(head))).unwrap();
        session.apply(&wipe).unwrap();
    }
    assert_eq!(session.recording_stopped(), None);
    let text = session.recording().unwrap().to_json().unwrap();
    let read = StrokeScript::from_json("a.json", text.as_bytes()).unwrap();
    // Every head but the last was washed when it was replaced: 20 wipes and 19 washes.
    assert_eq!((read.brushes.len(), read.actions.len()), (20, 39));
    session.set_brush("round", &round(9.0)).unwrap();
    session.apply(&wipe).unwrap();
    assert_eq!(session.recording_stopped(), Some("a recording holds 20 brushes"));
}

#[test]
fn after_a_backend_failed_nothing_before_it_is_taken_back_out_of_order() {
    let mut session = recorded();
    dab(&mut session);
    dab(&mut session);
    session.undo().unwrap();
    let reason = DeviceError::NoAdapter("it burnt".to_owned());
    let failed = session.follow_failure::<()>(Err(reason.into()));
    assert!(failed.is_err(), "the failure is not returned");
    assert_eq!(session.history(), (Vec::new(), 0));
    assert!(!session.undo().unwrap() && !session.redo().unwrap(), "a step from before the failure");
    let stopped = session.recording_stopped().unwrap();
    assert!(stopped.starts_with("the backend failed: ") && stopped.contains("burnt"), "{stopped}");
    dab(&mut session);
    assert!(session.undo().unwrap(), "no undo of the new stroke");
    assert!(!session.undo().unwrap(), "an undo from before the failure");
    assert_eq!(session.recording().unwrap().actions.len(), 3);
    // A refused action changes neither the history nor the recording.
    dab(&mut session);
    assert!(
        session.apply(&Action::Merge { layer: LayerRef::Dry(7), with: None }).is_err(),
        "no such layer"
    );
    assert_eq!(session.history().1, 1);
}

#[test]
fn a_session_without_a_header_is_not_recorded() {
    let PaintingSession { canvas, .. } = recorded();
    let mut session = PaintingSession::new(canvas, None).unwrap();
    session.set_brush("round", &round(1.0)).unwrap();
    dab(&mut session);
    assert!(
        session.recording().is_none() && session.recording_stopped().is_none(),
        "a recording was begun"
    );
}

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

/// Three dry layers of one paint. The first and the third overlap.
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
    assert_eq!(today.history(), (Vec::new(), 0), "taking up is not an action");
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
    let (_, palette, brushes) =
        bare.surfaces_with_table(&library, Some(left.0.clone()), Some(table.clone())).unwrap();
    assert_eq!((palette.unwrap().wet.totals(), brushes.len()), ([0; 9], 0));
    let missing = script.surfaces_with_table(&library, Some(left.0.clone()), None).unwrap_err();
    assert!(missing.to_string().starts_with("table: "), "{missing}");
    let mut other = left.0.clone();
    other.lighting.azimuth_deg += 1.0;
    let other = script.surfaces_with_table(&library, Some(other), Some(table)).unwrap_err();
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

const HEADER: &str = r#"{"format": "strokes", "version": 1, "brushes": {}, "actions": [],
    "canvas": {"width_mm": 24, "height_mm": 16, "cell_mm": 0.25},
    "mixing": {"width_mm": 12, "height_mm": 8, "cell_mm": 0.25},
    "palette": ["Lead White", "Prussian Blue"]}"#;

#[test]
fn what_cells_do_not_allow_is_found_before_the_first_action() {
    let loads = r#"{"load": {"brush": "flat", "recipe": {"Lead White": 1}, "vehicle": 0.2, "amount_mm": 0.1}},
        {"load": {"brush": "flat", "recipe": {"Lead White": 1}, "vehicle": 0.2, "amount_mm": 3}}"#;
    for (cell_mm, size_mm, refused) in [
        (0.25, 4.0, None),
        (0.05, 4.0, Some((1, "has room for"))),
        (0.04, 90.0, Some((0, "2048 cells wide"))),
    ] {
        let text = format!(
            r#"{{"format": "strokes", "version": 1,
            "canvas": {{"width_mm": 24, "height_mm": 16, "cell_mm": {cell_mm}}},
            "palette": ["Lead White"], "brushes": {{"flat": {{"shape": "flat", "size_mm": {size_mm}}}}},
            "actions": [{loads}]}}"#
        );
        let script = StrokeScript::from_json("a.json", text.as_bytes()).unwrap();
        let mut session = session_on(&script, None);
        let mut steps = 0;
        let played = script.replay(
            &mut session,
            |_: &str, _: &mut Painting| Ok::<(), Infallible>(()),
            || {
                steps += 1;
                ControlFlow::Continue(())
            },
        );
        match (played, refused) {
            (Ok(_), None) => assert_eq!(steps, 2),
            (Err(ReplayError::Action { index, error, .. }), Some((wanted, words))) => {
                assert_eq!((index, steps), (wanted, 0), "{error}");
                assert!(error.to_string().contains(words), "{error}");
            }
            (played, refused) => panic!("{played:?} for {refused:?}"),
        }
    }
}

fn opened(canvas: Document, palette: Option<Document>) -> (Painting, Option<Painting>) {
    let on_canvas = engine(&canvas);
    let on_palette = palette.as_ref().map(engine);
    let canvas = Painting::open(canvas, on_canvas, 1 << 26).unwrap();
    let palette = palette.zip(on_palette).map(|(palette, engine)| {
        Painting::open_under(palette, Arc::clone(canvas.light()), engine, 1 << 26).unwrap()
    });
    (canvas, palette)
}

fn engine(document: &Document) -> PaintEngine {
    PaintEngine::on_cpu(document.ground.height.clone())
}

fn begun() -> PaintingSession {
    let library = PigmentLibrary::van_gogh_oils();
    let script = StrokeScript::from_json("header", HEADER.as_bytes()).unwrap();
    let (canvas, palette) = script.surfaces(&library, None).unwrap();
    let (canvas, palette) = opened(canvas, palette);
    let mut session = PaintingSession::recorded(canvas, palette, &script).unwrap();
    for (name, shape, size_mm) in [("round", HeadShape::Round, 3.0), ("flat", HeadShape::Flat, 4.0)]
    {
        session.set_brush(name, &BrushSpec { shape, size_mm }).unwrap();
    }
    session
}

/// Samples of a bent path over a surface, `count` of them.
fn way(y_mm: f64, count: usize) -> Vec<Sample> {
    (0..count)
        .map(|index: usize| {
            let share = index as f64 / 20.0;
            Sample::upright(share, 2.0 + 9.0 * share, y_mm + 2.0 * share * share, 0.3 + 0.4 * share)
        })
        .collect()
}

fn draw(session: &mut PaintingSession, on: SurfaceId, brush: &str, y_mm: f64) {
    session.begin_stroke(on, brush).unwrap();
    session.extend(&way(y_mm, 21)).unwrap();
    session.end_stroke().unwrap();
}

/// Loads brushes, mixes on the palette, undoes, replaces a head by another, and dries.
fn first_half(session: &mut PaintingSession) {
    let recipe = [("Lead White".to_owned(), 1.0)].into();
    let vehicle = 0.1;
    let x_mm = 5.0;
    let y_mm = 4.0;
    let volume_mm3 = 20.0;
    let on = SurfaceId::Palette;
    let heap = Squeeze { on, recipe, vehicle, x_mm, y_mm, volume_mm3 };
    session.apply(&Action::Squeeze(heap)).unwrap();
    session.load("flat", [("Prussian Blue", 1.0)], 0.2).unwrap();
    draw(session, SurfaceId::Palette, "flat", 3.0);
    draw(session, SurfaceId::Canvas, "flat", 3.0);
    session.load("round", [("Prussian Blue", 1.0), ("Lead White", 2.0)], 0.3).unwrap();
    draw(session, SurfaceId::Canvas, "round", 6.0);
    session.undo().unwrap();
    session.set_brush("flat", &BrushSpec { shape: HeadShape::Flat, size_mm: 2.0 }).unwrap();
    session.load("flat", [("Lead White", 1.0)], 0.2).unwrap();
    draw(session, SurfaceId::Canvas, "flat", 9.0);
    session.apply(&Action::Dry { fraction: 0.5 }).unwrap();
}

fn second_half(session: &mut PaintingSession) {
    draw(session, SurfaceId::Canvas, "round", 4.0);
    draw(session, SurfaceId::Palette, "flat", 5.0);
    session.undo().unwrap();
    session.set_brush("wide", &BrushSpec { shape: HeadShape::Flat, size_mm: 6.0 }).unwrap();
    session.load("wide", [("Prussian Blue", 1.0)], 0.1).unwrap();
    draw(session, SurfaceId::Canvas, "wide", 8.0);
    session.set_brush("flat", &BrushSpec { shape: HeadShape::Flat, size_mm: 4.0 }).unwrap();
    draw(session, SurfaceId::Canvas, "flat", 10.0);
}

/// Keeps a session in two pieces of its recording, as autosaves do, and restores it.
fn restored(session: &mut PaintingSession, known: usize) -> PaintingSession {
    let earlier = session.recording().unwrap().actions[..known].to_vec();
    let tail = session.recording_from(known).unwrap();
    assert_eq!(tail.from, known, "it follows what is known");
    let mut recording = tail.header;
    recording.actions = earlier.into_iter().chain(tail.actions).chain(tail.open).collect();
    let brushes = session.kept_heads().unwrap();
    let mask = session.canvas().mask().cloned();
    let (canvas, palette) = session.documents().unwrap();
    let (canvas, palette) = opened(canvas, palette);
    let kept = KeptSession { brushes, recording: Some(recording), mask };
    PaintingSession::restored(canvas, palette, kept).unwrap()
}

/// Canvas, palette and brushes after the recording was played from the start.
fn replayed(session: &PaintingSession) -> PaintingSession {
    let text = session.recording().unwrap().to_json().unwrap();
    let script = StrokeScript::from_json("recording", text.as_bytes()).unwrap();
    let library = PigmentLibrary::van_gogh_oils();
    let (canvas, palette) = script.surfaces(&library, None).unwrap();
    let (canvas, palette) = opened(canvas, palette);
    let mut player = PaintingSession::new(canvas, palette).unwrap();
    script
        .replay(&mut player, |_, _| Ok::<(), Infallible>(()), || ControlFlow::Continue(()))
        .unwrap();
    player
}

fn assert_same_paint(a: &mut PaintingSession, b: &mut PaintingSession, when: &str) {
    assert!(a.documents().unwrap() == b.documents().unwrap(), "canvas and palette {when}");
    assert!(paint_on(a, "round") == paint_on(b, "round"), "the brush {when}");
}

fn paint_on(session: &mut PaintingSession, brush: &str) -> Option<Layer> {
    session.brush_paint(brush).unwrap()
}

#[test]
fn a_restored_session_goes_on_as_the_session_itself_would_have() {
    let mut whole = begun();
    first_half(&mut whole);
    let mut again = restored(&mut whole, 3);
    assert_same_paint(&mut whole, &mut again, "when restored");
    assert!(
        paint_on(&mut whole, "flat").is_some()
            && paint_on(&mut whole, "flat") == paint_on(&mut again, "flat"),
        "the second head"
    );
    second_half(&mut whole);
    second_half(&mut again);
    assert_same_paint(&mut whole, &mut again, "at the end");
    assert_eq!(whole.recording(), again.recording(), "the recordings agree");
    let (undone, _) = again.history();
    assert_eq!(undone.len(), 3, "only what was done since can be undone: {undone:?}");
}

#[test]
fn the_joined_recording_replays_to_the_bit() {
    let mut session = begun();
    first_half(&mut session);
    let mut session = restored(&mut session, 0);
    second_half(&mut session);
    let (canvas, palette) = session.documents().unwrap();
    let mut player = replayed(&session);
    assert!(player.documents().unwrap() == (canvas, palette), "canvas and palette");
}

#[test]
fn a_session_kept_within_a_stroke_replays_to_the_bit() {
    let mut session = begun();
    first_half(&mut session);
    session.begin_stroke(SurfaceId::Canvas, "round").unwrap();
    for pair in way(5.0, 12).chunks(3) {
        session.extend(pair).unwrap();
        while session.advance(5).unwrap() > 0 {}
    }
    let mut cut = restored(&mut session, 5);
    assert_eq!(cut.recording().unwrap().actions.last().map(Action::kind), Some("cut"));
    let mut player = replayed(&cut);
    assert_same_paint(&mut cut, &mut player, "within the stroke");
    second_half(&mut cut);
    let mut player = replayed(&cut);
    assert!(cut.documents().unwrap() == player.documents().unwrap(), "and after it");
    session.end_stroke().unwrap();
    let (finished, _) = session.documents().unwrap();
    let (open, _) = restored(&mut session, 0).documents().unwrap();
    assert!(finished == open, "a finished stroke is recorded whole");
}

#[test]
fn an_open_adjustment_is_kept() {
    let mut session = begun();
    first_half(&mut session);
    session.adjust(&Action::Stiffness { value: 0.75 }).unwrap();
    let kept = restored(&mut session, 0);
    let last = kept.recording().unwrap().actions.last();
    assert_eq!(last, Some(&Action::Stiffness { value: 0.75 }));
    assert!(session.recording().unwrap().actions.last() != last, "it is still open");
}

#[test]
fn brushes_that_do_not_go_together_are_refused() {
    let mut session = begun();
    first_half(&mut session);
    let (canvas, palette) = session.documents().unwrap();
    let brushes = session.kept_heads().unwrap();
    let refused = |change: fn(&mut super::KeptHead)| {
        let mut brushes = brushes.clone();
        let loaded = brushes.iter_mut().find(|brush| brush.paint.is_some()).unwrap();
        change(loaded);
        let (canvas, palette) = opened(canvas.clone(), palette.clone());
        let kept = KeptSession { brushes, ..KeptSession::default() };
        PaintingSession::restored(canvas, palette, kept).is_err()
    };
    assert!(!refused(|_| {}));
    assert!(refused(|brush| brush.ids.canvas = Some(BrushId(7))));
    assert!(refused(|brush| brush.spec.size_mm = 9.0), "its paint has other cells");
}

#[test]
fn the_mask_is_kept_and_one_of_another_canvas_is_refused() {
    let mut whole = begun();
    first_half(&mut whole);
    let open = vec![[0.0, 0.0], [7.0, 0.0], [7.0, 16.0], [0.0, 16.0]];
    whole.apply(&Action::Mask(MaskChange::PolygonMm(open))).unwrap();
    let mut again = restored(&mut whole, 3);
    second_half(&mut whole);
    second_half(&mut again);
    assert_same_paint(&mut whole, &mut again, "under the mask");
    again.apply(&Action::Mask(MaskChange::Inverse(true))).unwrap();
    draw(&mut again, SurfaceId::Canvas, "round", 12.0);
    let mut player = replayed(&again);
    assert!(again.documents().unwrap() == player.documents().unwrap(), "the recording replays");

    let mask = Mask::with_open(Rect { x: 0, y: 0, width: 3, height: 2 }, |_| true);
    let (canvas, palette) = again.documents().unwrap();
    let (canvas, palette) = opened(canvas, palette);
    let kept = KeptSession { mask: Some(Arc::new(mask)), ..KeptSession::default() };
    let refused = PaintingSession::restored(canvas, palette, kept);
    assert!(refused.unwrap_err().to_string().contains("masks"), "its cells are others");
}
