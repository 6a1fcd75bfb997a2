//! The studio in a page: what the scripts of the page call.
//!
//! The panels and the session are the same as in the program. The page provides what a browser
//! lacks: turns for the worker instead of a thread ([`Page::turn`]), files ([`Page::put`],
//! [`Page::changes`]) and styluses ([`Page::pen`]).

mod page_fonts;
mod framed;
mod told;
mod shown;

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use documents::file::disk;
use eframe::WebRunner;
use eframe::egui::pos2;
use js_sys::{Array, Function, Object, Uint8Array};
use session::warm_up::WarmUp;
use studio::files::{PageProblem, Problem};
use studio::language::{Language, set_system};
use studio::pen::{PagePens, PagePhase, PagePointer};
use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;
use web_time::{Duration, Instant};

use framed::Framed;

/// Folder of the files that were opened and saved. The page offers them for download.
const FILES: &str = "/files";

/// Folders that should outlive the page: preferences and autosaves.
const KEPT: [&str; 2] = ["/settings", "/data"];

/// Largest painting that a page opens, in bytes: 512 MiB. In memory it takes several times as much,
/// and a page has only 4 GiB.
const MOST_PAINTING_BYTES: u64 = 512 << 20;

/// Largest other file that a page opens, in bytes: 256 MiB, as in the program.
const MOST_BYTES: u64 = 256 << 20;

/// The studio in a page.
#[wasm_bindgen]
pub struct Page {
    runner: WebRunner,
    pens: RefCell<PagePens>,
    /// Changes of files that nobody has asked for yet.
    changes: RefCell<Vec<disk::Change>>,
    warm_up: RefCell<WarmUp>,
    fingers: bool,
}

#[wasm_bindgen]
impl Page {
    /// A page in this language, e.g. `de-AT`. Pass `fingers` if the device is used with fingers:
    /// targets are large then, unless the painter has chosen otherwise.
    #[wasm_bindgen(constructor)]
    pub fn new(language: &str, fingers: bool) -> Self {
        set_system(Language::of_name(language));
        let _ = disk::create_dir_all(FILES);
        Self {
            runner: WebRunner::new(),
            pens: RefCell::default(),
            changes: RefCell::default(),
            warm_up: RefCell::default(),
            fingers,
        }
    }

    /// Puts a file on the disk of the page. You do not get this as a change.
    ///
    /// # Errors
    /// If a file is in the way of its folder.
    pub fn put(&self, path: &str, bytes: Vec<u8>) -> Result<(), JsError> {
        self.changes.borrow_mut().extend(disk::take_changes());
        if let Some(folder) = Path::new(path).parent() {
            disk::create_dir_all(folder)?;
        }
        disk::write(path, bytes)?;
        disk::take_changes();
        Ok(())
    }

    /// Opens the studio in a canvas. `frame_done` is called after each frame.
    ///
    /// # Errors
    /// If the browser can draw neither with WebGPU nor with WebGL 2.
    pub async fn start(
        &self,
        canvas: HtmlCanvasElement,
        frame_done: Function,
    ) -> Result<(), JsValue> {
        let fingers = self.fingers;
        let create: eframe::AppCreator<'static> =
            Box::new(move |creation| Ok(Box::new(Framed::new(creation, frame_done, fingers))));
        self.runner.start(canvas, framed::options(), create).await
    }

    /// Lets the workers work for `budget_ms`. Returns the time until the next turn in ms. You get 0
    /// for immediately, and -1 if there is nothing to do until the next frame.
    pub fn turn(&self, budget_ms: f64) -> f64 {
        let Some(mut framed) = self.runner.app_mut::<Framed>() else { return -1.0 };
        let deadline = Instant::now() + Duration::from_secs_f64(budget_ms.max(0.0) / 1000.0);
        let wait = framed.studio.turn(deadline);
        let waits = framed.is_in_stroke(Instant::now());
        let shown = framed.frames > 0;
        drop(framed);
        // Do this while the window is not borrowed, because the work may ask for it.
        if !waits && session::thread::next() {
            return 0.0;
        }
        let idle = wait != session::Wait::None && !waits && shown;
        if idle && self.warm_up.borrow_mut().step() {
            return 0.0;
        }
        match wait {
            session::Wait::None => 0.0,
            session::Wait::Until(then) => {
                1000.0 * then.saturating_duration_since(Instant::now()).as_secs_f64()
            }
            session::Wait::Forever => -1.0,
        }
    }

    /// Files that have changed since the last call, each as its path and its content or null.
    pub fn changes(&self) -> Array {
        let mut changes = self.changes.take();
        changes.extend(disk::take_changes());
        let told = changes.into_iter().map(|(path, bytes)| {
            let bytes = bytes.map_or(JsValue::NULL, |bytes| Uint8Array::from(&bytes[..]).into());
            Array::of2(&path.display().to_string().into(), &bytes)
        });
        told.collect()
    }

    /// Every file that should outlive the page, each as its path and its content. Use this if the
    /// storage has lost them.
    pub fn kept(&self) -> Array {
        let mut kept = Vec::new();
        KEPT.iter().for_each(|folder| files_below(Path::new(folder), &mut kept));
        let told = kept.into_iter().filter_map(|path| {
            let bytes = disk::read(&path).ok()?;
            let bytes = Uint8Array::from(&bytes[..]).into();
            Some(Array::of2(&path.display().to_string().into(), &bytes))
        });
        told.collect()
    }

    /// Whether the page can open a file of this name and size. If not, the painter sees why. Ask
    /// this before you read the file.
    pub fn takes(&self, name: &str, bytes: f64) -> bool {
        let is_painting = name.to_ascii_lowercase().ends_with(".exr");
        let most = if is_painting { MOST_PAINTING_BYTES } else { MOST_BYTES };
        // A whole number from JavaScript, exact up to 8 PiB.
        let bytes = bytes as u64;
        if bytes > most {
            self.report(PageProblem::TooLarge { name: name.to_owned(), bytes, most }.into());
        }
        bytes <= most
    }

    /// Opens a file, either as the answer to the open dialog, or by its kind.
    ///
    /// # Errors
    /// If it has no name.
    pub fn open(&self, name: &str, bytes: Vec<u8>) -> Result<(), JsError> {
        let name = Path::new(name).file_name().ok_or_else(|| JsError::new("no name"))?;
        let path: PathBuf = Path::new(FILES).join(name);
        self.put(&path.display().to_string(), bytes)?;
        if let Some(mut framed) = self.runner.app_mut::<Framed>() {
            framed.open(path);
        }
        Ok(())
    }

    /// Extensions that a dialog has asked for since the last call, separated by commas. This is
    /// empty for all files, and undefined if no dialog asks.
    pub fn wanted(&self) -> Option<String> {
        let mut framed = self.runner.app_mut::<Framed>()?;
        let endings = framed.studio.files.take_wanted()?;
        let endings: Vec<String> = endings.iter().map(|ending| format!(".{ending}")).collect();
        Some(endings.join(","))
    }

    /// Shows the painter that the browser cannot read the file `name`.
    pub fn unreadable(&self, name: String, reason: String) {
        self.report(PageProblem::Unreadable { name, reason }.into());
    }

    /// Shows the painter a problem of the browser's storage: `denied`, `full`, `cleared`, or another
    /// one that `reason` describes in the browser's words.
    pub fn storage_problem(&self, kind: &str, reason: String) {
        let problem = match kind {
            "denied" => PageProblem::StorageDenied,
            "full" => PageProblem::StorageFull,
            "cleared" => PageProblem::StorageCleared,
            _ => PageProblem::StorageFailed(reason),
        };
        self.report(problem.into());
    }

    /// Takes a pointer event of a stylus. `phase` is 0 down, 1 move, 2 up, 3 gone. `numbers` are x
    /// and y in CSS pixels of the canvas, pressure, tiltX, tiltY, twist, buttons, and the age of
    /// the event in ms. Returns whether you see its stroke in [`Page::between`] and the worker
    /// already has what it needs.
    pub fn pen(&self, phase: u8, numbers: &[f64]) -> bool {
        let phase = match phase {
            0 => PagePhase::Down,
            1 => PagePhase::Move,
            2 => PagePhase::Up,
            _ => PagePhase::Gone,
        };
        let &[x, y, pressure, tilt_x, tilt_y, twist_deg, buttons, age_ms] = numbers else {
            return false;
        };
        let Some(mut framed) = self.runner.app_mut::<Framed>() else { return false };
        let zoom = f64::from(framed.zoom());
        let now = Instant::now();
        let age = Duration::from_secs_f64(age_ms.clamp(0.0, 1000.0) / 1000.0);
        let event = PagePointer {
            phase,
            at: pos2((x / zoom) as f32, (y / zoom) as f32),
            pressure,
            tilt_deg: (tilt_x, tilt_y),
            twist_deg,
            buttons: buttons as u16,
            arrived: now.checked_sub(age).unwrap_or(now),
        };
        let mut pens = self.pens.borrow_mut();
        for report in pens.reports(&event) {
            framed.studio.pen.feed(report);
        }
        if let Some(text) = pens.take_notice() {
            framed.report(Problem { text, hint: None });
        }
        let taken = phase == PagePhase::Move && framed.take_stylus();
        if !taken {
            framed.wake();
        }
        taken
    }

    /// Pixels that the stroke of a stylus changed since the last call or frame. Show it over the canvas
    /// until the next frame: `left`, `top`, `width` and `height` in physical pixels, `pixels`, and the
    /// brush head as `lines`, `strokes` and `dot`. Width and height are 0 if nothing changed. This is
    /// undefined if you see the stroke only in frames.
    pub fn between(&self) -> Option<Object> {
        let mut framed = self.runner.app_mut::<Framed>()?;
        framed.between().map(|(between, density)| shown::shown(&between, density))
    }

    /// Saves what the page would forget. Call this when the page is hidden.
    pub fn leave(&self) {
        if let Some(mut framed) = self.runner.app_mut::<Framed>() {
            framed.studio.keep_tools();
        }
    }

    /// State of the page as JSON, for its tests and figures.
    pub fn inspect(&self) -> String {
        let framed = self.runner.app_mut::<Framed>();
        framed.map_or_else(|| "null".to_owned(), |framed| told::told(&framed))
    }
}

impl Page {
    /// Shows a problem, once the studio is open.
    fn report(&self, problem: Problem) {
        if let Some(mut framed) = self.runner.app_mut::<Framed>() {
            framed.report(problem);
        }
    }
}

/// Adds the files in a folder and below it.
fn files_below(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = disk::read_dir(folder) else { return };
    for path in entries.flatten().map(|entry| entry.path()) {
        if disk::is_dir(&path) { files_below(&path, found) } else { found.push(path) }
    }
}
