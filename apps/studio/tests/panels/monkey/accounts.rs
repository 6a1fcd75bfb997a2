//! The accounts of the paint: the recording is played again, action by action, and every quantum is
//! followed.

use std::path::{Path, PathBuf};
use web_time::{Duration, Instant};

use eframe::egui::{Key, Modifiers};
use paint::document::Document;
use paint::engine::PaintEngine;
use paint::file;
use paint::layer::SLOTS;
use paint::painting::Painting;
use paint::session::{Outcome, PaintingSession};
use paint::strokes::{Action, StrokeScript, SurfaceId};
use pigment::library::PigmentLibrary;
use studio::files::FileRequest;

use super::paws::Monkey;

/// Quanta of each slot and of the vehicle.
type Quanta = [i128; SLOTS + 1];

/// All wet paint of a session: on canvas, palette and brushes.
fn wet(session: &mut PaintingSession) -> Quanta {
    let mut sums = [0; SLOTS + 1];
    let mut add = |totals: [u64; SLOTS + 1]| {
        for (sum, total) in sums.iter_mut().zip(totals) {
            *sum += i128::from(total);
        }
    };
    for surface in SurfaceId::ALL {
        if let Some(painting) = session.painting_mut(surface) {
            add(painting.wet().unwrap().totals());
        }
    }
    for head in session.kept_heads().unwrap() {
        if let Some(paint) = head.paint {
            add(paint.totals());
        }
    }
    sums
}

/// All paint of the dry layers.
fn dry(session: &mut PaintingSession) -> i128 {
    let (canvas, _) = session.documents().unwrap();
    let totals = canvas.dry.iter().flat_map(|layer| layer.paint.totals());
    totals.map(i128::from).sum()
}

/// The session before the first action of a recording.
fn begun(
    script: &StrokeScript,
    library: &PigmentLibrary,
    opened: Option<&[u8]>,
) -> PaintingSession {
    let start = opened.map(|bytes| file::read("start", bytes).unwrap());
    let table = opened.filter(|_| script.table).and_then(|b| file::read_table("start", b).unwrap());
    let (canvas, palette, kept) = script.surfaces_with_table(library, start, table).unwrap();
    let painting = |document: Document| {
        let engine = PaintEngine::on_cpu(document.ground.height.clone());
        Painting::open(document, engine, 1 << 29).unwrap()
    };
    let mut session = PaintingSession::new(painting(canvas), palette.map(painting)).unwrap();
    session.take_up(&kept).unwrap();
    session
}

/// Checks what one action did to the paint.
fn check_action(action: &Action, outcome: &Outcome, before: (Quanta, i128), after: (Quanta, i128)) {
    let kind = action.kind();
    let (wet, dry) = before;
    let (wet_after, dry_after) = after;
    let sum = |quanta: Quanta| quanta.iter().sum::<i128>();
    match action {
        Action::Stroke(_) | Action::Cut(_) => {
            let taken = match outcome {
                Outcome::Painted(report) => report.taken.quanta.map(i128::from),
                Outcome::Nothing | Outcome::Done => [0; SLOTS + 1],
            };
            let kept = std::array::from_fn(|slot| wet_after[slot] + taken[slot]);
            assert_eq!(wet, kept, "{kind}: {action:?}");
            assert_eq!(dry, dry_after, "{kind}");
        }
        Action::Load(_) | Action::Squeeze(_) => {
            assert!(wet.iter().zip(&wet_after).all(|(a, b)| a <= b), "{kind}: {action:?}");
            assert_eq!(dry, dry_after, "{kind}");
        }
        Action::Wash { .. } | Action::Wipe { .. } | Action::Scrape { .. } => {
            assert!(wet.iter().zip(&wet_after).all(|(a, b)| a >= b), "{kind}: {action:?}");
            assert_eq!(dry, dry_after, "{kind}");
        }
        Action::Dry { .. } => assert_eq!(sum(wet) + dry, sum(wet_after) + dry_after, "{kind}"),
        Action::Merge { .. } => assert_eq!(wet, wet_after, "{kind}"),
        Action::Undo {} | Action::Redo {} | Action::Palette(_) | Action::Swap { .. } => {}
        _ => assert_eq!((wet, dry), (wet_after, dry_after), "{kind}: {action:?}"),
    }
}

/// Plays the recording at `script` again and compares the end with the painting at `saved`.
/// `opened` is the file that the painting was opened from. Returns the number of actions.
fn replay(script: &Path, saved: &Path, library: &PigmentLibrary, opened: Option<&[u8]>) -> usize {
    let script = StrokeScript::from_json("recording", &std::fs::read(script).unwrap()).unwrap();
    let opened = opened.filter(|_| script.start.is_some());
    if script.start.is_some() && opened.is_none() {
        return 0;
    }
    let mut session = begun(&script, library, opened);
    let mut used = Vec::new();
    let mut before = (wet(&mut session), dry(&mut session));
    for action in &script.actions {
        if let Some(name) = action.brush()
            && !used.contains(&name)
        {
            used.push(name);
            session.set_brush(name, &script.brushes[name]).unwrap();
        }
        let outcome = session.apply(action).unwrap();
        let after = (wet(&mut session), dry(&mut session));
        check_action(action, &outcome, before, after);
        before = after;
    }
    let bytes = std::fs::read(saved).unwrap();
    let canvas = file::read("saved", &bytes).unwrap();
    let table = file::read_table("saved", &bytes).unwrap().unwrap();
    let (canvas_again, palette_again) = session.documents().unwrap();
    assert!(canvas == canvas_again, "the canvas of the recording differs");
    assert!(Some(&table.palette) == palette_again.as_ref(), "its palette differs");
    let on_brushes = |totals: Vec<[u64; SLOTS + 1]>| totals.iter().flatten().sum::<u64>();
    let heads = session.kept_heads().unwrap();
    let again = heads.into_iter().filter_map(|head| Some(head.paint?.totals())).collect();
    let kept = table.brushes.iter().filter_map(|brush| Some(brush.paint.as_ref()?.totals()));
    assert_eq!(on_brushes(kept.collect()), on_brushes(again), "paint on brushes");
    script.actions.len()
}

impl Monkey {
    /// Saves the painting and its recording, and checks that the recording gives the painting to
    /// the bit and loses no paint on the way. Returns the number of recorded actions.
    pub(super) fn settle_accounts(&mut self) -> usize {
        for _ in 0..8 {
            self.press(Modifiers::NONE, Key::Escape);
        }
        self.window.studio_mut().shows_volumes = false;
        self.window.settle();
        self.note("saves the painting and its recording".to_owned());
        let folder = self.home().join("end");
        std::fs::create_dir_all(&folder).unwrap();
        self.window.studio_mut().files.preferences.last_folder = Some(folder);
        let painting = self.save(FileRequest::SaveAs, "end", "exr");
        // The recording is asked for in the state of the file.
        let opened = self.window.studio().files.opened_content().map(<[u8]>::to_vec);
        let recording = self.save(FileRequest::SaveRecording, "recording", "json");
        self.check();
        let library = self.window.studio().painting().unwrap().library.clone();
        replay(&recording, &painting, &library, opened.as_deref())
    }

    /// Saves under a name in the folder that the dialog lists, and returns the path.
    fn save(&mut self, request: FileRequest, name: &str, ending: &str) -> PathBuf {
        let state = self.window.studio().painting().unwrap().clone();
        self.window.studio_mut().files.request(request, &state);
        let began = Instant::now();
        self.window.settle();
        self.press(Modifiers::COMMAND, Key::A);
        self.write(name);
        self.press(Modifiers::NONE, Key::Enter);
        let file = format!("{name}.{ending}");
        loop {
            // A painting with a file is saved beside it.
            let folders = [self.home().join("end"), self.files()];
            let found = folders.iter().map(|folder| folder.join(&file)).find(|path| path.exists());
            if let Some(path) = found {
                self.window.settle();
                return path;
            }
            assert!(began.elapsed() < Duration::from_secs(60), "{file} is not saved");
            std::thread::sleep(Duration::from_millis(5));
            self.window.frame(Vec::new());
        }
    }
}
