//! Painting, saving, reopening and exporting in the program's window, and recovery of paintings and
//! scenes after it was killed.

use std::path::{Path, PathBuf};

use graphics::export::png8;
use paint::document::Document;
use paint::light::Light;
use paint::{file, scene};
use studio::files::{Home, Preferences};
use studio::theme;
use web_time::{Duration, Instant, SystemTime};

use crate::program::{Program, keep_preferences};
use crate::screen::{CONTROL, Pixels, RETURN, SHIFT, Screen, until};

fn entries(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.map(|entry| entry.path()).collect()
}

/// Asserts that two captures are equal. If they are not, this saves both for you to inspect.
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
    let now = || {
        screen.aside();
        screen.still(x.clone(), y.clone())
    };
    // Captures the canvas after a change.
    let changed = |what: &str, before: &Pixels| {
        until(what, || Some(now()).filter(|after| before.differing(after) > 1_000))
    };
    let bare = now();
    screen.drag(program.at(0.2, 0.3), program.at(0.8, 0.35), 0.5);
    let wet = changed("a stroke is seen", &bare);
    screen.key(u32::from('d'), &[]);
    let dried = changed("its gloss is gone", &wet);
    screen.drag(program.at(0.5, 0.1), program.at(0.45, 0.9), 0.4);
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

    // We reopen in a new process on a larger screen.
    let Some(screen) = crate::screen(1920, 1080) else { return };
    let program = Program::start(&screen, &home, "1920x1080", &[&path]);
    let covered = shows(&program, &picture);
    assert!(covered > x.len() * y.len(), "only {covered} pixels are compared");
    assert!(program.quit().success());
}

const AUTOSAVE: u64 = 2;

/// Newest autosaved painting below `home`, and its time of writing.
fn kept(home: &Path) -> Option<(PathBuf, SystemTime)> {
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

/// Finds the centre of the recover button. It is the left of two equal buttons below the menu bar,
/// and we recognise it by the colour of buttons.
fn recover_button(screen: &Pixels) -> Option<(i32, i32)> {
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

/// Waits until something lost is offered, and recovers it. On a busy machine a click may be lost, so we
/// click again if the offer stays.
fn recover(screen: &Screen) {
    const PATIENCE: Duration = Duration::from_secs(5);
    let mut clicked: Option<Instant> = None;
    until("what was lost is recovered", || {
        if clicked.is_some_and(|at| at.elapsed() < PATIENCE) {
            return None;
        }
        match recover_button(&screen.all()) {
            None => clicked.map(drop),
            Some(button) => {
                screen.click(button);
                // A button has another colour below the pointer.
                screen.aside();
                clicked = Some(Instant::now());
                None
            }
        }
    });
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
    screen.drag(program.at(0.2, 0.2), program.at(0.8, 0.2), 0.5);
    let first = until("the first stroke is kept", || {
        let document = painting(&kept(&home)?.0);
        (wet(&document) > 0).then_some(document)
    });
    // We kill the program during a long stroke, once part of it was autosaved.
    screen.begin_drag(program.at(0.2, 0.5), program.at(0.8, 0.5), 4.0);
    let some = until("some of the open stroke is kept", || {
        let document = painting(&kept(&home)?.0);
        (wet(&document) > wet(&first)).then_some(document)
    });
    screen.begin_drag(program.at(0.8, 0.5), program.at(0.8, 0.9), 1.0);
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
    recover(&screen);
    let picture = exported(&last);
    let covered = shows(&program, &picture);
    assert_eq!(covered, x.len() * y.len());
    let now = screen.pixels(x.clone(), y.clone());
    assert!(before.differing(&now) > 0, "paint after the autosave is lost");
    // If we quit, it would ask about the unsaved painting.
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

fn colored(pixels: &Pixels) -> usize {
    let places = (0..pixels.height).flat_map(|y| (0..pixels.width).map(move |x| (x, y)));
    places
        .filter(|&(x, y): &(usize, usize)| {
            let [red, green, blue] = pixels.at(x, y);
            red.max(green).max(blue) - red.min(green).min(blue) > 24
        })
        .count()
}

/// Text of the autosaved script below `home`, if there is one.
fn autosaved_scene(home: &Path) -> Option<String> {
    let scenes = entries(&Home::in_folder(home).scenes());
    let generations = scenes.into_iter().flat_map(|scene| entries(&scene));
    let mut scripts = generations.map(|folder| folder.join("scene.toml"));
    scripts.find_map(|script| std::fs::read_to_string(script).ok())
}

#[test]
fn a_scene_is_poured_over_and_survives_a_kill() {
    let Some(screen) = crate::screen(1280, 800) else { return };
    let folder = tempfile::Builder::new().prefix("scene").tempdir().unwrap();
    let home = folder.path().to_owned();
    let program = Program::start(&screen, &home, "1280x800", &[Path::new("shape:village")]);
    let (x, y) = program.room.clone();
    let seen = || colored(&screen.pixels(x.clone(), y.clone()));
    let paper = || screen.pixels(x.clone(), y.clone()).at(5, 5) == [255; 3];
    until("the drawing is there", || (paper() && seen() == 0).then_some(()));
    let before = program.figures().unwrap().len();
    screen.drag(program.at(0.35, 0.7), program.at(0.5, 0.7), 4.0);
    let poured = seen();
    assert!(poured > 300, "{poured} pixels have a colour");
    let figures = program.figures().unwrap();
    let rates = figures[before..].iter().filter_map(|line| line["frames_a_second"].as_f64());
    eprintln!("frames a second while paint was poured: {:?}", rates.collect::<Vec<_>>());
    let script = until("the scene is kept", || {
        autosaved_scene(&home).filter(|text| text.matches("[[pour]]").count() > 40)
    });
    program.kill();

    let program = Program::start(&screen, &home, "1280x800", &[]);
    recover(&screen);
    until("its drawing is there", || (paper() && seen() == 0).then_some(()));
    screen.key(u32::from('p'), &[]);
    until("it plays", || (seen() > poured / 2).then_some(()));
    assert_eq!(autosaved_scene(&home).as_ref(), Some(&script), "the autosave stays");
    program.kill();
}

pub(crate) fn painting(path: &Path) -> Document {
    let bytes = std::fs::read(path).expect("the painting was saved");
    file::read(&path.display().to_string(), &bytes).expect("it is a painting")
}

/// Renders a painting as `impasto relight PAINTING --png` does.
pub(crate) fn exported(document: &Document) -> Pixels {
    let lighting = &document.lighting;
    let light = Light::named(&document.library, &lighting.illuminant, &lighting.observer);
    let scene = scene::scene(document, &light.expect("the light is known"));
    let picture = scene::picture(document, &scene);
    let png = png8(&picture, document.cell_mm).expect("a picture can be exported");
    let picture = image::load_from_memory(&png.bytes).expect("a PNG").into_rgb8();
    let width = picture.width() as usize;
    let height = picture.height() as usize;
    Pixels { width, height, rows: picture.pixels().map(|pixel| pixel.0).collect() }
}

/// Waits until the visible part of the canvas equals `picture`, one cell per pixel, to the bit.
/// Returns the number of compared pixels.
pub(crate) fn shows(program: &Program<'_>, picture: &Pixels) -> usize {
    let screen = program.screen;
    let (x, y) = &program.room;
    screen.aside();
    let began = Instant::now();
    until("the screen shows the picture of the file", || {
        // Opening a painting fits it into the view, so we set the zoom afterwards.
        screen.key(u32::from('1'), &[CONTROL]);
        let shown = screen.still(x.clone(), y.clone());
        let found = seen(program, picture).filter(|seen| *seen == shown);
        if found.is_none() && began.elapsed() > Duration::from_secs(60) {
            let on_screen = shown.keep("shown");
            let in_file = picture.keep("exported");
            let differing = seen(program, picture).map(|seen| seen.differing(&shown));
            panic!("{differing:?} pixels differ: see {on_screen} and {in_file}");
        }
        found.map(|seen| seen.rows.len())
    })
}

/// The visible part of `picture`. The program reports the position of the canvas. `None` if the
/// canvas is not shown at one pixel per cell.
fn seen(program: &Program<'_>, picture: &Pixels) -> Option<Pixels> {
    let [left, top, right, bottom] = program.canvas()?;
    let whole = left.fract() == 0.0 && top.fract() == 0.0;
    let size = (right - left, bottom - top) == (picture.width as f64, picture.height as f64);
    if !(whole && size) {
        return None;
    }
    let (x, y) = &program.room;
    let cell = |at: usize, first: f64| usize::try_from(at as i64 - first as i64).ok();
    let mut rows = Vec::with_capacity(x.len() * y.len());
    for row in y.clone() {
        for column in x.clone() {
            let column = cell(column, left)?;
            let row = cell(row, top)?;
            let inside = column < picture.width && row < picture.height;
            rows.push(inside.then(|| picture.at(column, row))?);
        }
    }
    Some(Pixels { width: x.len(), height: y.len(), rows })
}
