//! The painter's hand, which does everything twice: in the program on its screen, and in a window
//! without a screen that is set up alike. That one tells where each control is.

use std::path::PathBuf;
use web_time::{Duration, Instant};

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2};
use egui_kittest::kittest::{NodeT, Queryable};
use paint::strokes::SurfaceId;

use super::harness::Window;
use crate::program::Program;
use crate::screen::{CONTROL, RETURN, SECONDARY, SHIFT};

/// Longest time that the screen gets to become still before a picture.
const REST: Duration = Duration::from_secs(8);

/// Keysyms of keys that write nothing.
const ESCAPE: u32 = 0xff1b;
const F1: u32 = 0xffbe;
const F12: u32 = 0xffc9;

/// A hand at both windows.
pub(super) struct Hand<'a> {
    pub(super) program: Program<'a>,
    /// The window that tells where controls are.
    pub(super) twin: Window,
    /// Folder of the pictures.
    folder: PathBuf,
    pictures: usize,
}

impl<'a> Hand<'a> {
    /// A hand that puts its pictures into `folder`.
    pub(super) fn new(program: Program<'a>, twin: Window, folder: PathBuf) -> Self {
        std::fs::create_dir_all(&folder).unwrap();
        Self { program, twin, folder, pictures: 0 }
    }

    fn on_screen(&self, at: Pos2) -> (i32, i32) {
        let (width, height) = self.program.screen.size();
        let x = at.x.round() as i32;
        let y = at.y.round() as i32;
        (x.clamp(0, width as i32 - 1), y.clamp(0, height as i32 - 1))
    }

    /// Middle of the first control with this label.
    pub(super) fn place(&mut self, label: &str) -> Pos2 {
        self.find(label).unwrap_or_else(|| {
            self.twin.save("painter-twin");
            let path = self.program.screen.all().keep("painter");
            panic!("nothing is called {label}; the screen is in {path}")
        })
    }

    /// Middle of the first control with this label, or else with one that contains it: rows of
    /// files have their sizes in theirs.
    pub(super) fn find(&mut self, label: &str) -> Option<Pos2> {
        let harness = self.twin.harness();
        let found = harness.query_all_by_label(label).next();
        let found = found.or_else(|| harness.query_all_by_label_contains(label).next());
        found.map(|node| node.rect().center())
    }

    /// Middle of the slider or field of a role with a label.
    pub(super) fn place_of(&mut self, role: Role, label: &str) -> Pos2 {
        let root = self.twin.harness().root();
        let mut all = root.children_recursive();
        let found = all.find(|node| {
            let inner = node.accesskit_node();
            inner.role() == role && inner.label().is_some_and(|own| own.contains(label))
        });
        found.map(|node| node.rect().center()).unwrap_or_else(|| panic!("no {role:?} {label}"))
    }

    /// Waits until both windows have done what was asked.
    pub(super) fn wait(&mut self) {
        std::thread::sleep(Duration::from_millis(150));
        self.twin.settle();
    }

    pub(super) fn click_at(&mut self, at: Pos2) {
        self.program.screen.click(self.on_screen(at));
        self.twin_click(at, PointerButton::Primary);
        self.wait();
    }

    fn twin_click(&mut self, pos: Pos2, button: PointerButton) {
        self.twin.frame(vec![Event::PointerMoved(pos)]);
        for pressed in [true, false] {
            let modifiers = Modifiers::NONE;
            self.twin.frame(vec![Event::PointerButton { pos, button, pressed, modifiers }]);
        }
    }

    /// Clicks with the secondary button.
    pub(super) fn click_aside(&mut self, at: Pos2) {
        self.program.screen.click_with(SECONDARY, self.on_screen(at));
        self.twin_click(at, PointerButton::Secondary);
        self.wait();
    }

    pub(super) fn click(&mut self, label: &str) {
        let at = self.place(label);
        self.click_at(at);
    }

    pub(super) fn double_click(&mut self, label: &str) {
        let at = self.place(label);
        let screen = self.program.screen;
        screen.point(self.on_screen(at));
        std::thread::sleep(Duration::from_millis(150));
        // Quickly: frames of a busy computer lie far apart, and would make two clicks of it.
        for pressed in [true, false, true, false] {
            screen.button(pressed);
            std::thread::sleep(Duration::from_millis(15));
        }
        self.twin_click(at, PointerButton::Primary);
        self.twin_click(at, PointerButton::Primary);
        self.wait();
    }

    /// Opens a menu and clicks one of its entries, which stand below its name.
    pub(super) fn choose(&mut self, menu: &str, entry: &str) {
        let left = self.twin.harness().get_all_by_label(menu).next().unwrap().rect().left();
        self.click(menu);
        let below = self
            .twin
            .harness()
            .query_all_by_label(entry)
            .min_by_key(|node| (node.rect().left() - left).abs() as u32);
        let at = below.map(|node| node.rect().center());
        self.click_at(at.unwrap_or_else(|| panic!("no {entry} in {menu}")));
    }

    pub(super) fn key(&mut self, modifiers: Modifiers, key: Key) {
        let mut held = Vec::new();
        held.extend(modifiers.command.then_some(CONTROL));
        held.extend(modifiers.shift.then_some(SHIFT));
        self.program.screen.key(keysym(key), &held);
        self.twin.key(modifiers, key);
        self.wait();
    }

    pub(super) fn escape(&mut self) {
        self.key(Modifiers::NONE, Key::Escape);
    }

    pub(super) fn text(&mut self, text: &str) {
        self.program.screen.text(text);
        self.twin.frame(vec![Event::Text(text.to_owned())]);
        self.wait();
    }

    /// Drags along points of the window, with `per_leg` positions between two.
    pub(super) fn drag(&mut self, corners: &[Pos2]) {
        let mut along = vec![corners[0]];
        for leg in corners.windows(2) {
            let steps = (leg[0].distance(leg[1]) / 6.0).ceil().max(1.0) as usize;
            along.extend((1..=steps).map(|step| leg[0].lerp(leg[1], step as f32 / steps as f32)));
        }
        let screen = self.program.screen;
        screen.point(self.on_screen(along[0]));
        std::thread::sleep(Duration::from_millis(80));
        screen.button(true);
        // Between press and release there is a frame, also of a busy computer.
        std::thread::sleep(Duration::from_millis(100));
        for &point in &along {
            screen.point(self.on_screen(point));
            std::thread::sleep(Duration::from_millis(8));
        }
        screen.button(false);
        self.twin.pen_stroke(&along);
        self.wait();
    }

    /// Paints along places of a surface, in mm.
    pub(super) fn paint(&mut self, surface: SurfaceId, along: &[(f64, f64)]) {
        let points: Vec<Pos2> =
            along.iter().map(|&(x, y)| self.twin.point(surface, x, y)).collect();
        self.drag(&points);
    }

    /// Moves the pointer over something.
    pub(super) fn hover(&mut self, at: Pos2) {
        self.program.screen.point(self.on_screen(at));
        self.twin.frame(vec![Event::PointerMoved(at)]);
        self.wait();
    }

    /// Moves the pointer to the status line.
    pub(super) fn aside(&mut self) {
        let height = self.twin.whole().height();
        self.hover(Pos2::new(120.0, height - 8.0));
    }

    /// Takes a picture of the screen once it is still, with the pointer where it is.
    pub(super) fn picture(&mut self, name: &str) {
        let screen = self.program.screen;
        let began = Instant::now();
        let mut last = screen.all();
        let mut since = Instant::now();
        while since.elapsed() < Duration::from_millis(700) && began.elapsed() < REST {
            std::thread::sleep(Duration::from_millis(100));
            let now = screen.all();
            if now != last {
                (last, since) = (now, Instant::now());
            }
        }
        self.pictures += 1;
        last.save(&self.folder.join(format!("{:02}-{name}.png", self.pictures)));
    }

    /// Takes a picture with the pointer out of the way.
    pub(super) fn station(&mut self, name: &str) {
        self.aside();
        self.picture(name);
    }

    /// Ends the program.
    pub(super) fn end(self) {
        self.program.kill();
    }
}

fn keysym(key: Key) -> u32 {
    match key {
        Key::Enter => RETURN,
        Key::Escape => ESCAPE,
        Key::F1 => F1,
        Key::F12 => F12,
        Key::Comma => u32::from(','),
        Key::OpenBracket => u32::from('['),
        Key::CloseBracket => u32::from(']'),
        other => {
            let name = other.name().to_lowercase();
            let mut letters = name.chars();
            let only = letters.next().filter(|_| letters.as_str().is_empty());
            u32::from(only.unwrap_or_else(|| panic!("no keysym for {other:?}")))
        }
    }
}
