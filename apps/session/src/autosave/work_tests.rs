//! Tests of the recording and the brushes in autosaves.

use paint::brush::HeadShape;
use paint::layer::{Cell, Layer};
use paint::session::{KeptHead, RecordingTail};
use paint::strokes::{Action, BrushSpec, PerSurface, StrokeScript, SurfaceId};

use super::*;
use crate::command::Origin;
use crate::defaults::blank_canvas;
use crate::event::Snapshot;

fn header() -> StrokeScript {
    let library = pigment::library::PigmentLibrary::van_gogh_oils();
    let Origin::Blank { script, .. } = blank_canvas(library, 6.0, 4.0, 0.5) else {
        panic!("a blank canvas")
    };
    *script
}

fn document() -> Document {
    let library = pigment::library::PigmentLibrary::van_gogh_oils();
    header().surfaces(&library, None).unwrap().0
}

fn dry(count: usize) -> Vec<Action> {
    (1..=count).map(|index| Action::Dry { fraction: index as f64 / 100.0 }).collect()
}

/// A painting whose recording goes on from action `from` with `count` actions.
fn painting(from: usize, count: usize) -> KeptPainting {
    let canvas = Arc::new(document());
    let palette = Arc::new(document());
    let snapshot = Snapshot { number: 1, canvas, palette, brushes: Arc::default(), revision: 1 };
    let mut paint = Layer::empty(2, 3);
    paint.set_cell(4, Cell { pigments: [7; 8], vehicle: count as u32 });
    let brush = KeptHead {
        name: "round".to_owned(),
        recorded: "round 2".to_owned(),
        spec: BrushSpec { shape: HeadShape::Round, size_mm: 4.0 },
        named: true,
        at: SurfaceId::Palette,
        numbers: PerSurface { canvas: None, palette: Some(0) },
        paint: Some(paint),
    };
    let tail = RecordingTail { header: header(), from, actions: dry(count), open: None };
    KeptPainting { snapshot, recording: Some(tail), brushes: vec![brush], mask: None }
}

fn meta() -> SessionMeta {
    SessionMeta { title: "study".to_owned(), path: None, seconds: 7, desk: None }
}

fn recovered(sessions: &Path) -> (Vec<Action>, RecoveredWork) {
    let lost = LostSession::all(sessions).unwrap().remove(0);
    let work = lost.work().unwrap().unwrap();
    (work.session.recording.clone().unwrap().actions, work)
}

/// Files of recordings in the folder of a session.
fn recordings(session: &Autosave) -> Vec<String> {
    let entries = std::fs::read_dir(session.folder()).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned());
    let mut names: Vec<_> = names
        .filter(|name: &String| name.starts_with("recording") || name.starts_with("start"))
        .collect();
    names.sort();
    names
}

#[test]
fn a_recording_grows_and_brushes_keep_their_paint() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = Autosave::begin(folder.path()).unwrap();
    assert_eq!(session.keep(&painting(0, 3), None, &meta()).unwrap(), 3);
    let mut second = painting(3, 2);
    second.recording.as_mut().unwrap().open = Some(Action::Undo {});
    assert_eq!(session.keep(&second, None, &meta()).unwrap(), 5);
    assert_eq!(recordings(&session), ["recording-1.jsonl"]);
    drop(session);
    let (actions, work) = recovered(folder.path());
    let wanted: Vec<Action> = dry(3).into_iter().chain(dry(2)).chain([Action::Undo {}]).collect();
    assert_eq!(actions, wanted);
    assert_eq!(work.session.brushes, second.brushes);
    assert_eq!(work.start, None);
}

#[test]
fn an_end_that_does_not_follow_keeps_no_recording_and_a_whole_one_begins_anew() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = Autosave::begin(folder.path()).unwrap();
    session.keep(&painting(0, 3), None, &meta()).unwrap();
    assert_eq!(session.keep(&painting(7, 1), None, &meta()).unwrap(), 0);
    assert_eq!(session.keep(&painting(0, 9), None, &meta()).unwrap(), 9);
    assert_eq!(recordings(&session), ["recording-2.jsonl"], "the older one is removed");
    session.clear().unwrap();
    assert!(recordings(&session).is_empty(), "nothing is left");
    assert_eq!(session.keep(&painting(9, 1), None, &meta()).unwrap(), 0, "nothing to follow");
    assert_eq!(session.keep(&painting(0, 4), None, &meta()).unwrap(), 4);
    drop(session);
    assert_eq!(recovered(folder.path()).0.len(), 4);
}

#[test]
fn what_a_crash_left_behind_a_recording_does_no_harm() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = Autosave::begin(folder.path()).unwrap();
    session.keep(&painting(0, 3), None, &meta()).unwrap();
    let file = session.folder().join("recording-1.jsonl");
    let complete = std::fs::read(&file).unwrap();
    std::fs::write(&file, [&complete[..], b"{\"dry\": {\"fra"].concat()).unwrap();
    drop(session);
    assert_eq!(recovered(folder.path()).0.len(), 3, "the half line is not of this generation");
    std::fs::write(&file, &complete[..complete.len() - 4]).unwrap();
    let lost = LostSession::all(folder.path()).unwrap().remove(0);
    let error = lost.work().unwrap_err();
    assert!(error.what.contains("recording-1.jsonl"), "{error}");
}

#[test]
fn an_append_that_failed_is_written_again() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = Autosave::begin(folder.path()).unwrap();
    session.keep(&painting(0, 3), None, &meta()).unwrap();
    let file = session.folder().join("recording-1.jsonl");
    let complete = std::fs::read(&file).unwrap();
    std::fs::write(&file, [&complete[..], b"rubbish"].concat()).unwrap();
    assert_eq!(session.keep(&painting(3, 1), None, &meta()).unwrap(), 4);
    drop(session);
    assert_eq!(recovered(folder.path()).0.len(), 4);
}

#[test]
fn the_painting_that_a_recording_continues_is_kept_once() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = Autosave::begin(folder.path()).unwrap();
    let continued = |from, count| {
        let mut painting = painting(from, count);
        let tail = painting.recording.as_mut().unwrap();
        tail.header = StrokeScript::continue_from("before.exr", &document());
        painting
    };
    session.keep(&continued(0, 1), Some(b"the file"), &meta()).unwrap();
    session.keep(&continued(1, 1), Some(b"not written"), &meta()).unwrap();
    assert_eq!(recordings(&session), ["recording-1.jsonl", "start-1.exr"]);
    drop(session);
    let (_, work) = recovered(folder.path());
    assert_eq!(work.start.as_deref(), Some(&b"the file"[..]));
}

#[cfg(unix)]
#[test]
fn a_palette_that_stays_the_same_is_not_written_again() {
    use std::os::unix::fs::MetadataExt;

    let folder = tempfile::tempdir().unwrap();
    let mut session = Autosave::begin(folder.path()).unwrap();
    let file = |session: &Autosave, number, name| {
        let path = generation_folder(session.folder(), number).join(name);
        std::fs::metadata(path).unwrap().ino()
    };
    let mut inodes = Vec::new();
    let held = folder.path().join("held");
    for number in 1..=3 {
        let mut painting = painting(0, 1);
        if number == 3 {
            let mut other = document();
            other.wet.set_cell(3, Cell { pigments: [5; 8], vehicle: 0 });
            painting.snapshot.palette = Arc::new(other);
        }
        session.keep(&painting, None, &meta()).unwrap();
        inodes.push(file(&session, number, PALETTE));
        if number == 1 {
            // So that its inode is not used again.
            let path = generation_folder(session.folder(), 1).join(PALETTE);
            std::fs::hard_link(path, &held).unwrap();
        }
    }
    assert_eq!(inodes[0], inodes[1], "the same file");
    assert_ne!(inodes[1], inodes[2], "a changed palette is written");
}
