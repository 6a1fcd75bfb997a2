//! The window under the monkey's paws: clicks, drags, keys and text, and a record of them.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use eframe::egui::{
    Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, TouchPhase, Vec2,
};

use super::dice::Dice;
use super::refusals::is_refusal;
use crate::harness::Window;

/// Number of last actions that are told on a failure.
const TOLD: usize = 40;

/// Panics of all threads, once [`Monkey::count_panics`] was called.
static PANICS: AtomicUsize = AtomicUsize::new(0);

/// A monkey at a window.
pub(super) struct Monkey {
    pub(super) window: Window,
    pub(super) dice: Dice,
    seed: u64,
    record: Vec<String>,
    panics: usize,
}

impl Monkey {
    /// A monkey whose choices follow from `seed`, before a window whose dialogs list a folder of
    /// its home.
    pub(super) fn new(name: &'static str, seed: u64) -> Self {
        let mut window = Window::open(name);
        let files = window.folder().join("files");
        std::fs::create_dir_all(&files).unwrap();
        let picture =
            image::RgbImage::from_fn(48, 30, |x, y| image::Rgb([x as u8 * 5, y as u8 * 8, 90]));
        picture.save(files.join("reference.png")).unwrap();
        window.studio_mut().files.preferences.last_folder = Some(files);
        let panics = PANICS.load(Ordering::Relaxed);
        Self { window, dice: Dice::new(seed), seed, record: Vec::new(), panics }
    }

    /// Counts the panics of all threads of this process from now on, so that none is missed.
    pub(super) fn count_panics() {
        let before = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            PANICS.fetch_add(1, Ordering::Relaxed);
            before(panic);
        }));
    }

    /// The folder of the monkey's files.
    pub(super) fn files(&self) -> PathBuf {
        self.window.folder().join("files")
    }

    /// Home folder of the program.
    pub(super) fn home(&self) -> &Path {
        self.window.folder()
    }

    /// Notes what is about to be done.
    pub(super) fn note(&mut self, what: String) {
        self.record.push(what);
    }

    pub(super) fn move_to(&mut self, pos: Pos2) {
        self.window.frame(vec![Event::PointerMoved(pos)]);
    }

    pub(super) fn click_at(&mut self, pos: Pos2, button: PointerButton) {
        self.move_to(pos);
        for pressed in [true, false] {
            let modifiers = Modifiers::NONE;
            self.window.frame(vec![Event::PointerButton { pos, button, pressed, modifiers }]);
        }
        self.window.frame(Vec::new());
    }

    pub(super) fn drag(&mut self, along: &[Pos2]) {
        self.window.pen_stroke(along);
    }

    pub(super) fn press(&mut self, modifiers: Modifiers, key: Key) {
        let event =
            |pressed| Event::Key { key, physical_key: None, pressed, repeat: false, modifiers };
        self.window.frame(vec![Event::ModifiersChanged(modifiers), event(true)]);
        self.window.frame(vec![event(false), Event::ModifiersChanged(Modifiers::NONE)]);
        self.window.frame(Vec::new());
    }

    pub(super) fn write(&mut self, text: &str) {
        self.window.frame(vec![Event::Text(text.to_owned())]);
        self.window.frame(Vec::new());
    }

    pub(super) fn wheel(&mut self, at: Pos2, delta: Vec2, modifiers: Modifiers) {
        self.move_to(at);
        let wheel = Event::MouseWheel {
            unit: MouseWheelUnit::Point,
            delta,
            modifiers,
            source: MouseWheelSource::Wheel,
            phase: TouchPhase::Move,
        };
        self.window.frame(vec![Event::ModifiersChanged(modifiers), wheel]);
        self.window.frame(vec![Event::ModifiersChanged(Modifiers::NONE)]);
    }

    /// Panics if something failed that was not refused rightly.
    pub(super) fn check(&mut self) {
        let panics = PANICS.load(Ordering::Relaxed) - self.panics;
        assert_eq!(panics, 0, "a thread panicked");
        let studio = self.window.studio();
        let notices = studio.files.notices().map(str::to_owned);
        let message = studio.message().filter(|message| message.failed);
        let failures = notices.chain(message.map(|message| message.text.clone()));
        let wrong: Vec<String> = failures.filter(|text| !is_refusal(text)).collect();
        assert!(wrong.is_empty(), "{wrong:#?}");
    }
}

impl Drop for Monkey {
    fn drop(&mut self) {
        if std::thread::panicking() {
            let count = self.record.len();
            let mut told = format!("seed {}, {count} actions; the last of them:\n", self.seed);
            for what in &self.record[count.saturating_sub(TOLD)..] {
                let _ = writeln!(told, "  {what}");
            }
            let _ = std::io::stderr().write_all(told.as_bytes());
        }
    }
}
