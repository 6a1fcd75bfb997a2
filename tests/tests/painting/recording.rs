//! Recordings of sessions: their replay gives the same paint and history bit for bit.

use std::convert::Infallible;
use std::ops::ControlFlow;

use paint::brush::HeadShape;
use paint::document::{Document, Lighting};
use paint::layer::SLOTS;
use paint::painting::Painting;
use paint::session::{PaintingSession, ReplayReport};
use paint::strokes::{Action, LayerRef, Load, StrokeScript, SurfaceId};
use rand::RngExt;

use super::studio::{
    BACKENDS, Backend, PALETTE, Whole, header, live, load, loaded_session as loaded, oils, on_cpu,
    random_action, seeded, set_up, spec, squeeze, surface, whole,
};

/// Writes the recording of a session as JSON and reads it back.
fn read(session: &PaintingSession) -> StrokeScript {
    let text = session.recording().unwrap().to_json().unwrap();
    StrokeScript::from_json("recording.json", text.as_bytes()).unwrap()
}

fn replayed(script: &StrokeScript, session: &mut PaintingSession) -> ReplayReport {
    script
        .replay(
            session,
            |_: &str, _: &mut Painting| Ok::<_, Infallible>(()),
            || ControlFlow::Continue(()),
        )
        .unwrap()
}

/// Asserts equal canvases and palettes, and that the paint on each brush of `painted` is on some
/// brush of
/// `played`.
fn assert_same(painted: &mut Whole, played: &mut Whole, what: &str) {
    assert!(painted.0 == played.0, "{what}: another canvas");
    assert!(painted.1 == played.1, "{what}: another palette");
    // The recording gives every head its own name, whereas the session reuses names for new heads.
    // So we compare the paint on brushes without names.
    let [painted, played] =
        [painted, played].map(|whole| whole.2.drain(..).flatten().collect::<Vec<_>>());
    assert!(painted.iter().all(|paint| played.contains(paint)), "{what}: other paint on a brush");
}

/// Paints at random: strokes, loads, adjustments, undo, redo and jumps in the history.
fn paint_at_random(session: &mut PaintingSession, seed: u64, actions: usize) {
    let mut random = seeded(seed);
    loaded(session);
    for pigment in &PALETTE[..4] {
        let place = (random.random_range(2.0..16.0), random.random_range(2.0..12.0));
        session.apply(&squeeze(SurfaceId::Palette, pigment, place)).unwrap();
    }
    for _ in 0..actions {
        match random.random_range(0..12) {
            0 => _ = session.undo().unwrap(),
            1 => _ = session.redo().unwrap(),
            2 => {
                let recipe = [("Lead White".to_owned(), 1.0 / 3.0), ("Viridian".to_owned(), 0.1)];
                let recipe = recipe.into();
                let vehicle = random.random_range(0.0..1.0);
                let amount_mm = random.random_range(0.0..0.4);
                // This is refused if the palette lacks viridian or the brush is full.
                let load = Load { brush: "knife".to_owned(), recipe, vehicle, amount_mm };
                let _ = session.apply(&Action::Load(load));
            }
            3 => {
                let keep = random.random_range(0.0..1.0);
                session.apply(&Action::Wipe { brush: "flat".to_owned(), keep }).unwrap();
            }
            4 => _ = session.apply(&Action::Wash { brush: "knife".to_owned() }).unwrap(),
            5 => {
                // This makes a new head under the same name, or takes an earlier head again.
                let size_mm = [4.0, 2.5, 10.0 / 3.0][random.random_range(0..3)];
                session.set_brush("knife", &spec(HeadShape::Knife, size_mm)).unwrap();
            }
            6 => {
                for _ in 0..random.random_range(1..4) {
                    let azimuth_deg = random.random_range(0.0..360.0);
                    let lamp = Lighting { azimuth_deg, ..Lighting::default() };
                    session.adjust(&Action::Light(lamp)).unwrap();
                }
                let value = random.random_range(0.0..2.0);
                let _ = session.adjust(&Action::Opacity { layer: LayerRef::Dry(0), value });
            }
            7 => {
                let on = surface(&mut random);
                live(session, on, "knife", &mut random);
            }
            8 => {
                let (_, done) = session.history();
                session.go_to(random.random_range(done.saturating_sub(4)..done + 3)).unwrap();
            }
            _ => _ = random_action(session, &mut random),
        }
    }
    session.end_adjustment();
}

fn assert_replays(backend: Backend, seed: u64, actions: usize) {
    let Some(mut session) = set_up(&header(), backend) else { return };
    paint_at_random(&mut session, seed, actions);
    let script = read(&session);
    assert_eq!(session.recording_stopped(), None, "the recording stopped");
    assert!(script.brushes.len() > 2, "no extra names for replaced heads");
    let mut other = set_up(&script, backend).unwrap();
    let report = replayed(&script, &mut other);
    let what = format!("seed {seed}");
    assert_eq!((report.actions, report.idle), (script.actions.len() as u64, 0), "{what}");
    let [played, painted] =
        [&other, &session].map(|session| (session.history().0.len(), session.history().1));
    assert_eq!(played, painted, "{what}");
    assert_same(&mut whole(&mut session), &mut whole(&mut other), &what);
    // Undo all actions in both sessions.
    session.go_to(0).unwrap();
    other.go_to(0).unwrap();
    assert_same(&mut whole(&mut session), &mut whole(&mut other), &what);
    // The replay is recorded too, and has the same actions.
    let again = read(&other);
    assert_eq!(again.actions[..script.actions.len()], script.actions, "{what}");
}

#[test]
fn a_recording_replays_bit_for_bit_on_the_processor() {
    for seed in 0..4 {
        assert_replays(BACKENDS[0], seed, 60);
    }
}

#[test]
fn a_recording_replays_bit_for_bit_on_the_device() {
    assert_replays(BACKENDS[1], 7, 50);
}

#[test]
fn a_session_may_go_on_with_a_painting() {
    let mut session = set_up(&header(), BACKENDS[0]).unwrap();
    paint_at_random(&mut session, 21, 20);
    session.apply(&Action::Dry { fraction: 0.5 }).unwrap();
    let (mut start, _) = session.documents().unwrap();
    start.title = "went on".to_owned();
    let mut script = StrokeScript::continue_from("study.exr", &start);
    script.mixing = header().mixing;
    fn continued(script: &StrokeScript, start: &Document) -> PaintingSession {
        let (canvas, palette) = script.surfaces(oils(), Some(start.clone())).unwrap();
        let canvas = on_cpu_lit(canvas);
        let palette = palette.map(on_cpu_lit);
        PaintingSession::recorded(canvas, palette, script).unwrap()
    }
    let mut session = continued(&script, &start);
    paint_at_random(&mut session, 22, 30);
    let script = read(&session);
    assert_eq!(script.start.as_deref(), Some("study.exr"));
    let mut other = continued(&script, &start);
    replayed(&script, &mut other);
    let mut painted = whole(&mut session);
    assert_ne!(painted.0.wet.totals(), [0; SLOTS + 1]);
    assert_same(&mut painted, &mut whole(&mut other), "a continued painting");
}

/// `document` on the CPU under its own light, which may not be daylight.
fn on_cpu_lit(document: Document) -> Painting {
    let engine = BACKENDS[0](&document).unwrap();
    Painting::open(document, engine, paint::painting::UNDO_BYTES).unwrap()
}

#[test]
fn a_replay_ends_where_it_is_told_to() {
    let mut session = set_up(&header(), BACKENDS[0]).unwrap();
    paint_at_random(&mut session, 5, 20);
    let script = read(&session);
    let mut other = set_up(&script, BACKENDS[0]).unwrap();
    let mut left = 9;
    let report = script
        .replay(
            &mut other,
            |_: &str, _: &mut Painting| Ok::<_, Infallible>(()),
            || {
                left -= 1;
                if left == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            },
        )
        .unwrap();
    assert_eq!(report.actions, 9);
    let mut begun = script.clone();
    begun.actions.truncate(9);
    let mut whole_of_nine = set_up(&script, BACKENDS[0]).unwrap();
    replayed(&begun, &mut whole_of_nine);
    assert!(whole(&mut other) == whole(&mut whole_of_nine), "not the first nine actions");
}

#[test]
fn only_what_was_done_is_recorded() {
    let mut session = set_up(&header(), BACKENDS[0]).unwrap();
    loaded(&mut session);
    session.set_brush("mop", &spec(HeadShape::Mop, 3.0)).unwrap();
    assert!(!session.undo().unwrap() && !session.redo().unwrap(), "a step in an empty history");
    session.apply(&Action::Dry { fraction: 1.0 }).unwrap();
    assert!(session.apply(&load("flat", "Octarine", 0.1)).is_err());
    assert!(session.apply(&load("flat", "Lead White", 50.0)).is_err(), "too much");
    session.begin_stroke(SurfaceId::Canvas, "mop").unwrap();
    session.end_stroke().unwrap();
    let script = read(&session);
    let kinds: Vec<&str> = script.actions.iter().map(Action::kind).collect();
    assert_eq!(kinds, ["load", "load"]);
    assert_eq!(script.brushes.keys().collect::<Vec<_>>(), ["flat", "knife"], "the mop is unused");
    assert_eq!(script.title, "a session");
    assert_eq!(script.library.as_deref(), Some(oils().title.as_str()));
    // If the first use of a brush is refused, it is recorded nevertheless, by a wash.
    assert!(session.apply(&load("mop", "Lead White", 50.0)).is_err(), "too much");
    let script = read(&session);
    assert_eq!(script.actions[2], Action::Wash { brush: "mop".to_owned() });
}

#[test]
fn a_header_must_describe_what_is_there() {
    let (canvas, palette) = header().surfaces(oils(), None).unwrap();
    let refused = |change: fn(&mut StrokeScript)| {
        let mut script = header();
        change(&mut script);
        let canvas = on_cpu(canvas.clone());
        let palette = palette.clone().map(on_cpu);
        PaintingSession::recorded(canvas, palette, &script)
            .map(|_| ())
            .map_err(|error| error.to_string())
    };
    assert_eq!(refused(|_| ()), Ok(()));
    for (change, wanted) in [
        (
            (|script| script.canvas.width_mm = 20.0) as fn(&mut StrokeScript),
            "canvas: as many cells as the painting has, 130 x 100, found `100 x 100`",
        ),
        (|script| script.palette.pigments.truncate(3), "palette: that of the painting, "),
        (|script| script.mixing = None, "canvas and palette have different palettes than"),
        (
            |script| script.lighting = Some(Lighting { relief: 0.0, ..Lighting::default() }),
            "canvas and palette have different lights than",
        ),
    ] {
        let error = refused(change).unwrap_err();
        assert!(error.starts_with(wanted), "{error}");
    }
}
