use std::io::BufRead;
use std::process::{Command, Stdio};

use super::*;

fn files(text: &str) -> Vec<(&'static str, Content)> {
    let meta = SessionMeta { title: text.to_owned(), path: None, seconds: 7, desk: None };
    let text = || Content::Bytes(text.as_bytes().to_vec());
    let meta = Content::Bytes(serde_json::to_vec(&meta).unwrap());
    vec![(CANVAS, text()), (PALETTE, text()), (META, meta)]
}

/// Text of the only lost session, `None` without one. Asserts that its files agree.
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
