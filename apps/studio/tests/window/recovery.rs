//! Recovery of a painting after the program was killed.

use std::path::{Path, PathBuf};
use web_time::SystemTime;

use paint::document::Document;
use studio::files::{Home, Preferences};
use studio::theme;

use crate::export::{exported, painting, shows};
use crate::program::{Program, keep_preferences};
use crate::screen::{CONTROL, Pixels, until};

/// Seconds between autosaves.
const AUTOSAVE: u64 = 2;

/// Newest autosaved painting below `home`, and its time of writing.
fn kept(home: &Path) -> Option<(PathBuf, SystemTime)> {
    let entries = |folder: &Path| {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        entries.map(|entry| entry.path()).collect::<Vec<_>>()
    };
    let sessions = Home::in_folder(home).sessions();
    let canvases = entries(&sessions).into_iter().flat_map(|session| entries(&session));
    let canvases = canvases.filter(|folder| {
        let name = folder.file_name().and_then(|name| name.to_str());
        name.is_some_and(|name| !name.starts_with('.'))
    });
    let found = canvases.filter_map(|folder| {
        let canvas = folder.join("canvas.exr");
        let written = canvas.metadata().ok()?.modified().ok()?;
        Some((canvas, written))
    });
    found.max_by_key(|(_, written)| *written)
}

/// Total wet paint of a painting, in quanta.
fn wet(document: &Document) -> u64 {
    document.wet.totals().iter().sum()
}

/// Finds the centre of the recover button: the left of two equal buttons below the menu
/// bar, recognized by the colour of buttons.
pub(crate) fn recover_button(screen: &Pixels) -> Option<(i32, i32)> {
    let fill = [theme::DARK.button.r(), theme::DARK.button.g(), theme::DARK.button.b()];
    for y in 44..120 {
        let row: Vec<usize> = (0..screen.width).filter(|&x| screen.at(x, y) == fill).collect();
        let runs = row.chunk_by(|left, right| right - left == 1);
        let buttons: Vec<&[usize]> = runs.filter(|run| (40..90).contains(&run.len())).collect();
        if let [left, right] = buttons[..]
            && right[0] - left[left.len() - 1] < 20
        {
            return Some(((left[0] + left.len() / 2) as i32, y as i32 + 4));
        }
    }
    None
}

#[test]
fn a_kill_within_a_stroke_loses_only_the_time_since_the_last_autosave() {
    let Some(screen) = crate::screen(1280, 800) else { return };
    let folder = tempfile::Builder::new().prefix("window").tempdir().unwrap();
    let home = folder.path().join("home");
    let preferences = Preferences { autosave_seconds: AUTOSAVE, ..Preferences::default() };
    keep_preferences(&home, &preferences);
    let program = Program::start(&screen, &home, "1280x800", &[]);
    screen.key(u32::from('1'), &[CONTROL]);
    let (x, y) = program.room.clone();
    let at = |across, down| program.at(across, down);
    screen.drag(at(0.2, 0.2), at(0.8, 0.2), 0.5);
    let first = until("the first stroke is kept", || {
        let document = painting(&kept(&home)?.0);
        (wet(&document) > 0).then_some(document)
    });
    // Kill the program during a long stroke, once part of it was autosaved.
    screen.begin_drag(at(0.2, 0.5), at(0.8, 0.5), 4.0);
    let some = until("some of the open stroke is kept", || {
        let document = painting(&kept(&home)?.0);
        (wet(&document) > wet(&first)).then_some(document)
    });
    screen.begin_drag(at(0.8, 0.5), at(0.8, 0.9), 1.0);
    let before = screen.pixels(x.clone(), y.clone());
    let killed = SystemTime::now();
    program.kill();
    screen.button(false);
    let (canvas, written) = kept(&home).expect("the autosave exists");
    let lost = killed.duration_since(written).unwrap_or_default();
    // The delay depends on the machine, but the autosave must date from the stroke.
    eprintln!("killed {:.1} s after the last autosave", lost.as_secs_f64());
    let last = painting(&canvas);
    assert!(wet(&last) >= wet(&some), "a later autosave holds no less paint");

    let program = Program::start(&screen, &home, "1280x800", &[]);
    let recover = until("a lost painting is offered", || recover_button(&screen.all()));
    screen.click(recover);
    let picture = exported(&last);
    let covered = shows(&program, &picture);
    assert_eq!(covered, x.len() * y.len());
    let now = screen.pixels(x.clone(), y.clone());
    assert!(before.differing(&now) > 0, "paint after the autosave is lost");
    // Quitting would ask about the unsaved painting.
    program.kill();
}

#[test]
fn signals_that_end_the_program_are_handled() {
    use std::os::unix::process::ExitStatusExt;

    let Some(screen) = crate::screen(1280, 800) else { return };
    let folder = tempfile::Builder::new().prefix("window").tempdir().unwrap();
    let home = folder.path().join("home");
    keep_preferences(&home, &Preferences::default());
    let mut program = Program::start(&screen, &home, "1280x800", &[]);
    let status = std::fs::read_to_string(format!("/proc/{}/status", program.child.id())).unwrap();
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap();
    let caught = u64::from_str_radix(caught.trim(), 16).unwrap();
    for signal in [1, 2, 15] {
        assert!(caught & (1 << (signal - 1)) != 0, "signal {signal} ends writes half done");
    }
    let sent = std::process::Command::new("kill").arg(program.child.id().to_string()).status();
    assert!(sent.unwrap().success());
    assert_eq!(program.child.wait().unwrap().signal(), Some(15), "shells see the signal");
}
