//! Single actions of the monkey, and the choice between them.

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, PointerButton, Pos2, Rect, vec2};
use egui_kittest::kittest::Queryable;
use paint::strokes::SurfaceId;
use studio::app::{Entry, Intent, SCENE_ENTRIES, SceneEntry, SceneIntent, Tab, entries};

use super::controls::{Control, controls, lists_elsewhere, million_new_cells};
use super::paws::Monkey;
use crate::whole::drop_file;

/// Most cells of a new canvas, in millions: a larger one only takes time.
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

/// Keys that mean something in lists and fields.
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
    /// Does one action and checks that nothing failed.
    pub(super) fn act(&mut self) {
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

    /// A line of several legs over canvas or palette, or a scene.
    fn stroke(&mut self) {
        let surface = self.dice.of(&[SurfaceId::Canvas, SurfaceId::Canvas, SurfaceId::Palette]);
        let studio = self.window.studio();
        let room = match (surface, &studio.volumes) {
            (_, Some(volumes)) if studio.shows_volumes => volumes.rect(),
            (SurfaceId::Canvas, _) => studio.canvas.rect(),
            (SurfaceId::Palette, _) => studio.palette.rect(),
        };
        // Nothing is drawn yet of what was just opened.
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

    /// A key of an entry, or the entry of its menu.
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
        // The sample is played for seconds.
        let left_out = [Intent::Quit, Intent::Sample];
        let rare = [Intent::NewScene, Intent::OpenScene, Intent::ShowScene, Intent::ScrapePalette];
        let fitting = |entry: &&Entry| !left_out.contains(&entry.intent);
        let entries: Vec<&Entry> = entries().filter(fitting).collect();
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
        // Its entries stand below its name.
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

    /// Something of the layers: names, order, merging, opacity.
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

    /// Drags a control, or any place such as the border of a panel.
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

    /// Loads the brush from a tube, or squeezes one.
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
