//! Painting, drying, undo and another light in the window, then saving and reopening the painting.

use studio::files::Preferences;

use crate::export::{exported, painting, shows};
use crate::program::{Program, keep_preferences};
use crate::screen::{CONTROL, Pixels, RETURN, SHIFT, until};

/// Asserts that two captures are equal; saves both for inspection if not.
fn same(what: &str, before: &Pixels, after: &Pixels) {
    let differing = before.differing(after);
    if differing > 0 {
        let before = before.keep("before");
        let after = after.keep("after");
        panic!("{what}: {differing} pixels differ, see {before} and {after}");
    }
}

#[test]
fn a_saved_and_reopened_painting_is_shown_as_the_engine_exports_it() {
    let Some(screen) = crate::screen(1280, 800) else { return };
    let folder = tempfile::Builder::new().prefix("window").tempdir().unwrap();
    let home = folder.path().join("home");
    let last_folder = Some(folder.path().to_owned());
    keep_preferences(&home, &Preferences { last_folder, ..Preferences::default() });
    let program = Program::start(&screen, &home, "1280x800", &[]);
    screen.key(u32::from('1'), &[CONTROL]);
    let (x, y) = program.room.clone();
    let at = |across, down| program.at(across, down);
    let now = || {
        screen.aside();
        screen.still(x.clone(), y.clone())
    };
    // Capture the canvas after a change.
    let changed = |what: &str, before: &Pixels| {
        until(what, || Some(now()).filter(|after| before.differing(after) > 1_000))
    };
    let bare = now();
    screen.drag(at(0.2, 0.3), at(0.8, 0.35), 0.5);
    let wet = changed("a stroke is seen", &bare);
    screen.key(u32::from('d'), &[]);
    let dried = changed("its gloss is gone", &wet);
    screen.drag(at(0.5, 0.1), at(0.45, 0.9), 0.4);
    let crossed = changed("a second stroke is seen", &dried);
    screen.key(u32::from('z'), &[CONTROL]);
    same("undo takes the stroke back", &dried, &changed("undo is seen", &crossed));
    screen.key(u32::from('z'), &[CONTROL, SHIFT]);
    same("redo brings it again", &crossed, &changed("redo is seen", &dried));
    screen.key(u32::from('l'), &[]);
    changed("another light is seen", &crossed);

    let path = folder.path().join("study.exr");
    screen.key(u32::from('s'), &[CONTROL]);
    screen.still(x.clone(), y.clone());
    // The name field has the keyboard focus.
    screen.text("study");
    screen.key(RETURN, &[]);
    until("the painting is saved", || path.exists().then_some(()));
    let saved = painting(&path);
    assert_eq!(saved.dry.len(), 1, "one layer was dried");
    assert_eq!(saved.lighting.illuminant, "A");
    let picture = exported(&saved);
    let covered = shows(&program, &picture);
    assert_eq!(covered, x.len() * y.len());
    let status = program.quit();
    assert!(status.success(), "{status}");

    // Reopen in a new process on a larger screen.
    let Some(screen) = crate::screen(1920, 1080) else { return };
    let program = Program::start(&screen, &home, "1920x1080", &[&path]);
    let covered = shows(&program, &picture);
    assert!(covered > x.len() * y.len(), "only {covered} pixels are compared");
    assert!(program.quit().success());
}
