//! Tests of the recording and the brushes in autosaves.

use std::io::BufRead;
use std::process::{Command, Stdio};

use paint::brush::HeadShape;
use paint::engine::BrushId;
use paint::layer::{Cell, Layer};
use paint::session::{KeptHead, RecordingTail};
use paint::strokes::{Action, BrushSpec, PerSurface, StrokeScript, SurfaceId};

use super::*;
use crate::command::Origin;
use crate::event::Snapshot;
use crate::prepare::blank_canvas;

fn files(text: &str) -> Vec<(&'static str, Content)> {
    let meta = SessionMeta { title: text.to_owned(), path: None, seconds: 7, desk: None };
    let [canvas, palette] =
        [CANVAS, PALETTE].map(|file| (file, Content::Bytes(text.as_bytes().to_vec())));
    let meta = Content::Bytes(serde_json::to_vec(&meta).unwrap());
    vec![canvas, palette, (META, meta)]
}

/// Text of the only lost session, if there is one. Asserts that its files agree.
fn found(sessions: &Path) -> Option<String> {
    let mut all = LostSession::all(sessions).unwrap();
    assert!(all.len() <= 1, "{all:?}");
    let lost = all.pop()?;
    for file in lost.files() {
        assert_eq!(std::fs::read_to_string(file).unwrap(), lost.meta.title);
    }
    Some(lost.meta.title.clone())
}

/// Saves `text`, but fails after `last` changes on the disk, as a crash would. Returns whether the
/// save was completed.
fn keep_until(session: &mut Autosave, text: &str, last: usize) -> bool {
    let mut count = 0;
    let kept = session.keep_files(&files(text), &mut || {
        count += 1;
        if count > last { Err(std::io::Error::other("killed")) } else { Ok(()) }
    });
    kept.is_ok()
}

#[test]
fn a_crash_at_any_moment_leaves_a_complete_generation() {
    let mut seen = Vec::new();
    for last in 0.. {
        let folder = tempfile::tempdir().unwrap();
        let mut session = Autosave::begin(folder.path()).unwrap();
        assert!(keep_until(&mut session, "first", usize::MAX), "the first is kept");
        let ended = keep_until(&mut session, "second", last);
        drop(session);
        let text = found(folder.path()).unwrap();
        assert!(text == "first" || text == "second", "{text}");
        seen.push(text);
        if ended {
            break;
        }
    }
    assert!(seen.len() > 12, "the crash was tried {} times only", seen.len());
    assert_eq!(seen.first().map(String::as_str), Some("first"));
    assert_eq!(seen.last().map(String::as_str), Some("second"));
    assert!(seen.is_sorted(), "newer, then older: {seen:?}");
}

#[test]
fn what_a_crash_left_half_written_is_no_hindrance() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = Autosave::begin(folder.path()).unwrap();
    for last in 0..14 {
        keep_until(&mut session, "half", last);
        assert!(keep_until(&mut session, "whole", usize::MAX), "after {last} changes");
        let kept = generations(session.folder()).unwrap();
        assert_eq!(kept.len(), 1, "{kept:?}");
    }
    drop(session);
    assert_eq!(found(folder.path()).as_deref(), Some("whole"));
}

#[test]
fn a_living_session_is_not_lost_and_a_lost_one_is_found_by_one_only() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = Autosave::begin(folder.path()).unwrap();
    assert!(keep_until(&mut session, "text", usize::MAX), "it is kept");
    assert_eq!(found(folder.path()), None, "it lives");
    drop(session);
    let claimed = LostSession::all(folder.path()).unwrap();
    assert_eq!(claimed.len(), 1);
    assert_eq!(found(folder.path()), None, "another looks at it");
    drop(claimed);
    assert_eq!(found(folder.path()).as_deref(), Some("text"));
    LostSession::all(folder.path()).unwrap().into_iter().for_each(LostSession::discard);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_session_that_ends_or_kept_nothing_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let empty = Autosave::begin(folder.path()).unwrap();
    let mut cleared = Autosave::begin(folder.path()).unwrap();
    let mut ended = Autosave::begin(folder.path()).unwrap();
    assert!(keep_until(&mut cleared, "saved", usize::MAX), "it is kept");
    cleared.clear().unwrap();
    assert!(keep_until(&mut ended, "text", usize::MAX), "it is kept");
    ended.end();
    drop((empty, cleared));
    assert_eq!(found(folder.path()), None);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "empty ones are removed");
}

const CHILD: &str = "IMPASTO_TEST_SESSIONS";

/// Child process of the next test. Does nothing without the environment variable [`CHILD`].
#[test]
fn child_that_keeps_a_session_and_waits() {
    let Some(sessions) = std::env::var_os(CHILD) else { return };
    let mut session = Autosave::begin(Path::new(&sessions)).unwrap();
    assert!(keep_until(&mut session, "of the child", usize::MAX), "it is kept");
    eprintln!("kept");
    let _ = std::io::stdin().lock().read_line(&mut String::new());
}

#[test]
fn the_session_of_a_killed_process_is_lost_and_of_a_living_one_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let name = "autosave::tests::child_that_keeps_a_session_and_waits";
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", name, "--nocapture"])
        .env(CHILD, folder.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let lines = std::io::BufReader::new(child.stderr.take().unwrap()).lines();
    assert!(lines.map_while(Result::ok).any(|line| line.contains("kept")), "the child failed");
    assert_eq!(found(folder.path()), None, "the child lives");
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(found(folder.path()).as_deref(), Some("of the child"));
}

#[test]
fn a_failed_autosave_is_named_by_the_painting_and_not_by_its_folder() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = Autosave::begin(folder.path()).unwrap();
    // A file where the folder was.
    std::fs::remove_dir_all(session.folder()).unwrap();
    std::fs::write(session.folder(), "in the way").unwrap();
    let meta = SessionMeta { title: "Two pears".to_owned(), path: None, seconds: 7, desk: None };
    let failures = [session.keep_script("", &meta).unwrap_err(), session.clear().unwrap_err()];
    for FileFailure { what, .. } in failures {
        assert!(what.starts_with("the autosave of Two pears: cannot be"), "{what}");
        let own = session.folder().file_name().unwrap().to_str().unwrap();
        assert!(!what.contains(own) && !what.contains("partial"), "{what}");
    }
}

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

/// A painting with a recording of `count` actions from action `from` on.
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
        ids: PerSurface { canvas: None, palette: Some(BrushId(0)) },
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
    for (from, start) in [(0, &b"the file"[..]), (1, &b"not written"[..])] {
        let mut painting = painting(from, 1);
        let tail = painting.recording.as_mut().unwrap();
        tail.header = StrokeScript::continue_from("before.exr", &document());
        session.keep(&painting, Some(start), &meta()).unwrap();
    }
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
    fn file(session: &Autosave, number: u64, name: &str) -> u64 {
        let path = generation_folder(session.folder(), number).join(name);
        std::fs::metadata(path).unwrap().ino()
    }
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
