//! A monkey uses the whole program. After each random action nothing may have failed, and at the
//! end no paint may be lost. We play the recording again, action by action, and follow every
//! quantum of paint.

mod paws;

use std::path::{Path, PathBuf};

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, PointerButton, Pos2, Rect, vec2};
use egui_kittest::kittest::Queryable;
use paint::document::Document;
use paint::engine::PaintEngine;
use paint::file;
use paint::layer::SLOTS;
use paint::painting::Painting;
use paint::session::{Outcome, PaintingSession};
use paint::strokes::{Action, StrokeScript, SurfaceId};
use pigment::library::PigmentLibrary;
use session::volumes::Subject;
use studio::app::{Entry, Intent, SCENE_ENTRIES, SceneEntry, SceneIntent, Tab, entries};
use studio::files::FileRequest;
use web_time::{Duration, Instant};

use crate::harness::has_adapter;
use crate::light::drop_file;
use paws::{Control, Monkey, controls, lists_elsewhere, million_new_cells};

/// Most cells of a new canvas, in millions. A larger one would just take time.
const MOST_MILLION: f64 = 0.3;

/// Texts to type into fields of any kind.
const TEXTS: [&str; 14] = [
    "",
    "a",
    "Umbra",
    "study",
    "12",
    "0",
    "-3",
    "1e9",
    "3,5",
    "nan",
    "../up",
    "a/b\\c",
    "\u{e4}\u{df}",
    "a name that is much longer than any field of a panel is wide, and then some more of it",
];

const KEYS: [Key; 12] = [
    Key::ArrowUp,
    Key::ArrowDown,
    Key::ArrowLeft,
    Key::ArrowRight,
    Key::PageUp,
    Key::PageDown,
    Key::Home,
    Key::End,
    Key::Delete,
    Key::Backspace,
    Key::Tab,
    Key::Space,
];

const TABS: [Tab; 8] = [
    Tab::Brush,
    Tab::Layers,
    Tab::Light,
    Tab::Color,
    Tab::Wheel,
    Tab::Swatches,
    Tab::History,
    Tab::Files,
];

impl Monkey {
    fn act(&mut self) {
        let home = self.home().to_owned();
        if lists_elsewhere(&mut self.window, &home) {
            self.press(Modifiers::NONE, Key::Escape);
        }
        let busy = million_new_cells(&mut self.window).is_some_and(|cells| cells > MOST_MILLION);
        if busy || (self.window.studio().files.has_dialog() && self.dice.chance(12)) {
            self.escape();
        }
        match self.dice.below(100) {
            0..18 => self.stroke(),
            18..32 => self.entry(),
            32..54 => self.click_any(),
            54..58 => self.click_layer(),
            58..62 => self.click_aside(),
            62..68 => self.drag_any(),
            68..72 => self.scroll(),
            72..76 => self.escape(),
            76..78 => self.enter(),
            78..85 => self.fill_in(),
            85..89 => self.tube(),
            89..91 => self.resize(),
            91..93 => self.open_tab(),
            93..95 => self.drop_picture(),
            95..97 => self.undo(),
            _ => self.any_key(),
        }
        self.check();
        if self.dice.chance(12) {
            self.note("waits".to_owned());
            self.window.settle();
            self.check();
        }
    }

    fn point_in(&mut self, rect: Rect) -> Pos2 {
        rect.min + vec2(self.dice.share(), self.dice.share()) * rect.size()
    }

    fn anywhere(&mut self) -> Pos2 {
        let whole = self.window.whole();
        self.point_in(whole)
    }

    /// Draws a line of several legs over canvas or palette, or in a scene.
    fn stroke(&mut self) {
        let surface = self.dice.of(&[SurfaceId::Canvas, SurfaceId::Canvas, SurfaceId::Palette]);
        let studio = self.window.studio();
        let room = match (surface, &studio.volumes) {
            (_, Some(volumes)) if studio.shows_volumes => volumes.rect(),
            (SurfaceId::Canvas, _) => studio.canvas.rect(),
            (SurfaceId::Palette, _) => studio.palette.rect(),
        };
        // We have not drawn what was just opened.
        if !(room.is_finite() && room.is_positive()) {
            return;
        }
        let corners: Vec<Pos2> = (0..2 + self.dice.below(3)).map(|_| self.point_in(room)).collect();
        let mut along = vec![corners[0]];
        for leg in corners.windows(2) {
            let steps = 2 + self.dice.below(8);
            along.extend((1..=steps).map(|step| leg[0].lerp(leg[1], step as f32 / steps as f32)));
        }
        let tool = self.window.studio().tools.mode;
        self.note(format!("strokes on {surface:?} with {tool:?} along {corners:?}"));
        self.drag(&along);
    }

    /// Presses the key of a menu entry, or clicks the entry.
    fn entry(&mut self) {
        if self.window.studio().shows_volumes {
            let entries: Vec<&SceneEntry> =
                SCENE_ENTRIES.iter().filter(|entry| entry.intent != SceneIntent::Quit).collect();
            let entry = self.dice.of(&entries);
            let menu = entry.menu.name();
            self.perform(
                menu,
                entry.name,
                entry.shortcuts.first().map(|key| (key.modifiers, key.key)),
            );
            return;
        }
        // The sample would play for seconds.
        let left_out = [Intent::Quit, Intent::Sample];
        let rare = [Intent::NewScene, Intent::OpenScene, Intent::ShowScene, Intent::ScrapePalette];
        let entries: Vec<&Entry> =
            entries().filter(|entry| !left_out.contains(&entry.intent)).collect();
        let mut entry = self.dice.of(&entries);
        if rare.contains(&entry.intent) && self.dice.chance(60) {
            entry = self.dice.of(&entries);
        }
        let menu = entry.menu.name();
        self.perform(menu, entry.name, entry.shortcuts.first().map(|key| (key.modifiers, key.key)));
    }

    fn perform(&mut self, menu: &str, name: &str, key: Option<(Modifiers, Key)>) {
        if let Some((modifiers, key)) = key.filter(|_| self.dice.chance(70)) {
            self.note(format!("presses {modifiers:?} {key:?} for {name}"));
            self.press(modifiers, key);
            return;
        }
        self.note(format!("opens the menu {menu} for {name}"));
        let bar = self.window.harness().query_all_by_label(menu).next().map(|node| node.rect());
        let Some(bar) = bar else { return };
        self.click_at(bar.center(), PointerButton::Primary);
        // The entries stand below the menu's name.
        let below = self.window.harness().query_all_by_label(name).map(|node| node.rect());
        let entry = below.min_by_key(|rect| (rect.left() - bar.left()).abs() as u32);
        if let Some(entry) = entry {
            self.click_at(entry.center(), PointerButton::Primary);
        }
    }

    fn click_any(&mut self) {
        let found = controls(&mut self.window);
        self.click_one(&found);
    }

    /// Clicks in the layers: names, order, merging, opacity.
    fn click_layer(&mut self) {
        self.window.studio_mut().panels.select(Tab::Layers);
        self.window.frame(Vec::new());
        let mut found = controls(&mut self.window);
        let words = ["ayer", "Merge", "Rename", "Up", "Down", "Dry"];
        found.retain(|control| words.iter().any(|word| control.name.contains(word)));
        self.click_one(&found);
    }

    fn click_one(&mut self, found: &[Control]) {
        if found.is_empty() {
            return;
        }
        let control = &found[self.dice.below(found.len())];
        if control.name == "Quit" {
            return;
        }
        let button =
            if self.dice.chance(8) { PointerButton::Secondary } else { PointerButton::Primary };
        let twice = self.dice.chance(10);
        self.note(format!(
            "clicks {} ({:?}), {button:?}, twice: {twice}",
            control.name, control.role
        ));
        self.click_at(control.middle(), button);
        if twice {
            self.click_at(control.middle(), button);
        }
    }

    fn click_aside(&mut self) {
        let pos = self.anywhere();
        let button = self.dice.of(&[
            PointerButton::Primary,
            PointerButton::Secondary,
            PointerButton::Middle,
        ]);
        self.note(format!("clicks {button:?} at {pos:?}"));
        self.click_at(pos, button);
    }

    /// Drags a control, or any other place, e.g. the border of a panel.
    fn drag_any(&mut self) {
        let found = controls(&mut self.window);
        let from = if found.is_empty() || self.dice.chance(30) {
            self.anywhere()
        } else {
            let control = &found[self.dice.below(found.len())];
            self.note(format!("takes {}", control.name));
            let rect = control.rect;
            self.point_in(rect)
        };
        let to = if self.dice.chance(50) {
            self.anywhere()
        } else {
            from + vec2(self.dice.share() - 0.5, self.dice.share() - 0.5) * 160.0
        };
        self.note(format!("drags from {from:?} to {to:?}"));
        let along: Vec<Pos2> =
            (0..=6_u8).map(|step| from.lerp(to, f32::from(step) / 6.0)).collect();
        self.drag(&along);
    }

    fn scroll(&mut self) {
        let at = self.anywhere();
        let delta = vec2(0.0, (self.dice.share() - 0.5) * 300.0);
        let modifiers =
            self.dice.of(&[Modifiers::NONE, Modifiers::NONE, Modifiers::COMMAND, Modifiers::SHIFT]);
        self.note(format!("turns the wheel by {} at {at:?} with {modifiers:?}", delta.y));
        self.wheel(at, delta, modifiers);
    }

    fn escape(&mut self) {
        self.note("presses Escape".to_owned());
        self.press(Modifiers::NONE, Key::Escape);
    }

    fn enter(&mut self) {
        let modifiers = self.dice.of(&[Modifiers::NONE, Modifiers::NONE, Modifiers::COMMAND]);
        self.note(format!("presses Enter with {modifiers:?}"));
        self.press(modifiers, Key::Enter);
    }

    /// Types into a field and leaves it in one of the usual ways.
    fn fill_in(&mut self) {
        let mut found = controls(&mut self.window);
        found.retain(Control::takes_text);
        if found.is_empty() {
            return;
        }
        let field = found[self.dice.below(found.len())].clone();
        let text = self.dice.of(&TEXTS);
        let end = self.dice.of(&[
            Some(Key::Enter),
            Some(Key::Enter),
            Some(Key::Tab),
            Some(Key::Escape),
            None,
        ]);
        self.note(format!("types {text:?} into {} ({:?}), then {end:?}", field.name, field.role));
        self.click_at(field.middle(), PointerButton::Primary);
        if field.role == Role::TextInput && self.dice.chance(60) {
            self.press(Modifiers::COMMAND, Key::A);
        }
        if !text.is_empty() {
            self.write(text);
        }
        if let Some(key) = end {
            self.press(Modifiers::NONE, key);
        }
    }

    fn tube(&mut self) {
        let mut found = controls(&mut self.window);
        found.retain(|control| control.name.starts_with("tube of "));
        if found.is_empty() {
            return;
        }
        let tube = found[self.dice.below(found.len())].clone();
        self.note(format!("loads from the {}", tube.name));
        self.click_at(tube.middle(), PointerButton::Primary);
        self.click_at(tube.middle(), PointerButton::Primary);
    }

    fn resize(&mut self) {
        let size =
            vec2(900.0 + self.dice.share() * 1020.0, 600.0 + self.dice.share() * 480.0).round();
        self.note(format!("makes the window {size:?}"));
        self.window.harness().set_size(size);
        self.window.frame(Vec::new());
    }

    fn open_tab(&mut self) {
        let tab = self.dice.of(&TABS);
        self.note(format!("opens {tab:?}"));
        self.window.studio_mut().panels.select(tab);
        self.window.frame(Vec::new());
    }

    /// Drops a picture or a painting from the file manager.
    fn drop_picture(&mut self) {
        let folder = std::fs::read_dir(self.files()).unwrap();
        let mut paths: Vec<_> = folder.map(|entry| entry.unwrap().path()).collect();
        paths.retain(|path| path.is_file());
        paths.sort();
        if paths.is_empty() {
            return;
        }
        let path = paths[self.dice.below(paths.len())].clone();
        self.note(format!("drops {}", path.display()));
        drop_file(&mut self.window, &path);
    }

    fn undo(&mut self) {
        let modifiers = self.dice.of(&[Modifiers::COMMAND, Modifiers::COMMAND | Modifiers::SHIFT]);
        self.note(format!("presses {modifiers:?} Z"));
        self.press(modifiers, Key::Z);
    }

    fn any_key(&mut self) {
        let key = self.dice.of(&KEYS);
        let modifiers =
            self.dice.of(&[Modifiers::NONE, Modifiers::NONE, Modifiers::SHIFT, Modifiers::COMMAND]);
        self.note(format!("presses {modifiers:?} {key:?}"));
        self.press(modifiers, key);
    }
}

type Quanta = [i128; SLOTS + 1];

/// Totals of all wet paint of a session: on canvas, palette and brushes.
fn wet(session: &mut PaintingSession) -> Quanta {
    let mut all = Vec::new();
    for surface in SurfaceId::ALL {
        if let Some(painting) = session.painting_mut(surface) {
            all.push(painting.wet().unwrap().totals());
        }
    }
    let heads = session.kept_heads().unwrap();
    all.extend(heads.into_iter().filter_map(|head| Some(head.paint?.totals())));
    let mut sums = [0; SLOTS + 1];
    for totals in all {
        for (sum, total) in sums.iter_mut().zip(totals) {
            *sum += i128::from(total);
        }
    }
    sums
}

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
    fn painting(document: Document) -> Painting {
        let engine = PaintEngine::on_cpu(document.ground.height.clone());
        Painting::open(document, engine, 1 << 29).unwrap()
    }
    let mut session = PaintingSession::new(painting(canvas), palette.map(painting)).unwrap();
    session.take_up(&kept).unwrap();
    session
}

/// Checks what one action did to the paint.
fn check_action(action: &Action, outcome: &Outcome, before: (Quanta, i128), after: (Quanta, i128)) {
    let kind = action.kind();
    let (wet, dry) = before;
    let (wet_after, dry_after) = after;
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
        Action::Dry { .. } => assert_eq!(
            wet.iter().sum::<i128>() + dry,
            wet_after.iter().sum::<i128>() + dry_after,
            "{kind}"
        ),
        Action::Merge { .. } => assert_eq!(wet, wet_after, "{kind}"),
        Action::Undo {} | Action::Redo {} | Action::Palette(_) | Action::Swap { .. } => {}
        _ => assert_eq!((wet, dry), (wet_after, dry_after), "{kind}: {action:?}"),
    }
}

/// Plays the recording at `script` again and compares the end with the painting at `saved`, which
/// was opened from `opened`. Returns the number of actions.
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
    let heads = session.kept_heads().unwrap();
    let again = heads.into_iter().filter_map(|head| Some(head.paint?.totals()));
    let again: u64 = again.flatten().sum();
    let kept = table.brushes.iter().filter_map(|brush| Some(brush.paint.as_ref()?.totals()));
    assert_eq!(kept.flatten().sum::<u64>(), again, "paint on brushes");
    script.actions.len()
}

impl Monkey {
    /// Saves the painting and its recording. Checks that the recording gives the painting to the
    /// bit and loses no paint. Returns the number of recorded actions.
    fn settle_accounts(&mut self) -> usize {
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
        // We ask for the recording while it belongs to this file.
        let opened = self.window.studio().files.opened_content().map(<[u8]>::to_vec);
        let recording = self.save(FileRequest::SaveRecording, "recording", "json");
        self.check();
        let library = self.window.studio().painting().unwrap().library.clone();
        replay(&recording, &painting, &library, opened.as_deref())
    }

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
            // If a painting has a file, the dialog lists the folder of this file.
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

/// Seeds of the long run. You can name others in `IMPASTO_SEEDS`, separated by commas.
const SEEDS: [u64; 5] = [1, 2, 3, 4, 5];

/// Number of actions of a long run.
const LONG: usize = 1000;

fn run(name: &'static str, seed: u64, actions: usize) -> Monkey {
    let mut monkey = Monkey::new(name, seed);
    for number in 1..=actions {
        monkey.act();
        if number % 250 == 0 && has_adapter() {
            monkey.window.picture();
        }
    }
    monkey
}

#[test]
fn a_monkey_breaks_nothing() {
    let monkey = run("monkey", 7, 150);
    let painting = monkey.window.studio().painting().unwrap();
    assert!(painting.revision > 20, "it changed little: revision {}", painting.revision);
}

#[test]
fn a_monkey_among_volumes_breaks_nothing() {
    let mut monkey = Monkey::new("monkey-scenes", 11);
    let context = monkey.window.harness().ctx.clone();
    monkey.window.studio_mut().open_scene(&context, Subject::Shape("village".to_owned()));
    for _ in 0..60 {
        monkey.act();
    }
    assert!(monkey.window.studio().volumes.is_some(), "the scene is still there");
}

#[test]
#[ignore = "does five times a thousand actions, which takes many minutes"]
fn a_monkey_breaks_nothing_in_a_thousand_actions() {
    Monkey::count_panics();
    let given = std::env::var("IMPASTO_SEEDS").ok();
    let seeds = given.map(|seeds| seeds.split(',').map(|seed| seed.parse().unwrap()).collect());
    for seed in seeds.unwrap_or_else(|| SEEDS.to_vec()) {
        let recorded = run("monkey-long", seed, LONG).settle_accounts();
        assert!(recorded > 0, "seed {seed}: the recording is lost");
    }
}
