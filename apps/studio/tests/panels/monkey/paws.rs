//! The window under the monkey's paws: clicks, drags, keys and text, a record of them, and the
//! messages that may appear.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use eframe::egui::accesskit::{Action, Role};
use eframe::egui::{
    Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, Rect, TouchPhase,
    Vec2,
};
use egui_kittest::kittest::NodeT;

use crate::harness::Window;

/// If the monkey fails, it reports this many last actions.
const REPORTED: usize = 40;

/// Panics of all threads, once you call [`Monkey::count_panics`].
static PANICS: AtomicUsize = AtomicUsize::new(0);

pub(super) struct Monkey {
    pub(super) window: Window,
    pub(super) dice: Dice,
    seed: u64,
    record: Vec<String>,
    panics: usize,
}

impl Monkey {
    /// A monkey at a window. Its choices follow from `seed`, and its dialogs list a folder of its
    /// home.
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

    /// Counts the panics of all threads of this process from now on, so that we miss none.
    pub(super) fn count_panics() {
        let before = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            PANICS.fetch_add(1, Ordering::Relaxed);
            before(panic);
        }));
    }

    pub(super) fn files(&self) -> PathBuf {
        self.window.folder().join("files")
    }

    pub(super) fn home(&self) -> &Path {
        self.window.folder()
    }

    /// Notes the next action.
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
        let [down, up] = [true, false].map(|pressed| Event::Key {
            key,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers,
        });
        self.window.frame(vec![Event::ModifiersChanged(modifiers), down]);
        self.window.frame(vec![up, Event::ModifiersChanged(Modifiers::NONE)]);
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

    /// Panics if a thread has panicked, or if a message reports a failure that is not a refusal.
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
            let mut text = format!("seed {}, {count} actions; the last of them:\n", self.seed);
            for what in &self.record[count.saturating_sub(REPORTED)..] {
                let _ = writeln!(text, "  {what}");
            }
            let _ = std::io::stderr().write_all(text.as_bytes());
        }
    }
}

/// A generator of random numbers.
pub(super) struct Dice(u64);

impl Dice {
    /// Begins with a seed.
    pub(super) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Any number below `count`.
    pub(super) fn below(&mut self, count: usize) -> usize {
        // SplitMix64.
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) % count as u64) as usize
    }

    /// A number from 0 to 1.
    pub(super) fn share(&mut self) -> f32 {
        self.below(1 << 20) as f32 / (1 << 20) as f32
    }

    /// Whether something with a chance of `percent` happens.
    pub(super) fn chance(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }

    /// One of a list. This must not be empty.
    pub(super) fn of<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }
}

/// Parts of messages that refuse an action rightly.
const REFUSALS: [&str; 17] = [
    "is too high for more",
    "is piled as high as it can be",
    "the brush has room for ",
    "is still wet, so it cannot leave the palette",
    "the layer has no ",
    " already",
    "is not on the palette now",
    "one of the two layers is hidden",
    "lies between the two layers",
    "a recipe needs parts above 0",
    "has no opacity of its own",
    "on top of all layers",
    "a painting is being opened",
    "is not a valid file name",
    // If you enlarge a brush just after a change of the palette, it asks for its former paint.
    "recipe: pigments of the palette",
    // The panel shows a layer until an earlier undo is done.
    "there is no layer ",
    // Marks of samples are not a scene, but the monkey may drop them on the window.
    "format takes \"paint-volumes\"",
];

/// Whether a message refuses an action rightly.
pub(super) fn is_refusal(message: &str) -> bool {
    REFUSALS.iter().any(|part| message.contains(part))
}

/// Something with a name that you can click, drag or type into.
#[derive(Debug, Clone)]
pub(super) struct Control {
    pub(super) name: String,
    pub(super) role: Role,
    pub(super) rect: Rect,
}

impl Control {
    /// Whether you can type text into it.
    pub(super) fn takes_text(&self) -> bool {
        matches!(self.role, Role::TextInput | Role::MultilineTextInput | Role::SpinButton)
    }

    pub(super) fn middle(&self) -> Pos2 {
        self.rect.center()
    }
}

/// All controls with their middle in the window.
pub(super) fn controls(window: &mut Window) -> Vec<Control> {
    let whole = window.whole();
    let root = window.harness().root();
    let mut found = Vec::new();
    for node in root.children_recursive() {
        let inner = node.accesskit_node();
        let touched = inner.data().supports_action(Action::Click) || inner.role() == Role::Slider;
        let Some(name) = inner.label().or_else(|| inner.value()) else { continue };
        let rect = node.rect();
        if touched && !inner.is_disabled() && whole.contains(rect.center()) {
            found.push(Control { name, role: inner.role(), rect });
        }
    }
    found
}

/// Whether a dialog lists a folder outside `home`.
pub(super) fn lists_elsewhere(window: &mut Window, home: &Path) -> bool {
    let root = window.harness().root();
    root.children_recursive().any(|node| {
        let inner = node.accesskit_node();
        let is_folder =
            inner.role() == Role::TextInput && inner.label().as_deref() == Some("Folder");
        is_folder && !inner.value().is_some_and(|folder| Path::new(&folder).starts_with(home))
    })
}

/// Cells of the canvas in the dialog of a new painting, if it is open, in millions.
pub(super) fn million_new_cells(window: &mut Window) -> Option<f64> {
    let root = window.harness().root();
    root.children_recursive().find_map(|node| {
        let words = node.accesskit_node().label().or_else(|| node.accesskit_node().value())?;
        words.split_once(" cells, ")?.1.strip_suffix(" million")?.parse().ok()
    })
}
