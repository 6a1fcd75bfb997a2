//! The whole window with a real worker, without a window system.

use std::io::Write;
use std::path::{Path, PathBuf};
use web_time::{Duration, Instant};

use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, UiBuilder, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use graphics::gpu::{BackendChoice, choose};
use image::RgbaImage;
use paint::strokes::SurfaceId;
use pigment::library::PigmentLibrary;
use session::{Command, WorkerOptions, blank_canvas};
use studio::app::{Parts, StartedWorker, Studio};
use studio::files::{Files, Home, Preferences};
use studio::pen::{Pen, PenSettings};
use studio::theme;

const PATIENCE: Duration = Duration::from_secs(60);

/// After this time without events we count the worker as idle.
const QUIET: Duration = Duration::from_millis(60);

pub(crate) struct Window {
    harness: Harness<'static, Option<Studio>>,
    name: &'static str,
    fences: u64,
    /// Home folder of the program, deleted with the window.
    folder: tempfile::TempDir,
}

impl Window {
    /// Opens a window of 1280 x 800 points with 320 x 200 cells of linen (32 x 20 mm) and Van
    /// Gogh's oils. If the test fails, its picture is saved as `name`.
    pub(crate) fn open(name: &'static str) -> Self {
        Self::sized(name, vec2(1280.0, 800.0), 1.0)
    }

    /// Like [`Self::open`], with a size in points and a pixel density.
    pub(crate) fn sized(name: &'static str, size: Vec2, density: f32) -> Self {
        let begin =
            vec![Command::Open(blank_canvas(PigmentLibrary::van_gogh_oils(), 32.0, 20.0, 0.1))];
        Self::with_commands(name, size, density, begin)
    }

    /// Opens a window as on the first start of the program, with the first steps.
    pub(crate) fn first_start(name: &'static str, size: Vec2) -> Self {
        let mut window = Self::sized(name, size, 1.0);
        window.studio_mut().files.preferences.first_steps_seen = false;
        window.studio_mut().visible.first_steps = true;
        window.harness.run_ok();
        window
    }

    /// Opens a window, and waits until its worker has executed `begin`.
    pub(crate) fn with_commands(
        name: &'static str,
        size: Vec2,
        density: f32,
        begin: Vec<Command>,
    ) -> Self {
        let mut window = Self::without_waiting(name, size, density, begin);
        let start = Instant::now();
        while window.studio().painting().is_none() {
            assert!(start.elapsed() < PATIENCE, "{name}: no painting was opened");
            std::thread::sleep(Duration::from_millis(5));
            window.harness.step();
        }
        window.settle();
        window
    }

    /// Opens a window without waiting for its worker.
    pub(crate) fn without_waiting(
        name: &'static str,
        size: Vec2,
        density: f32,
        begin: Vec<Command>,
    ) -> Self {
        let folder = tempfile::tempdir().expect("a folder for the session");
        let home = folder.path().to_owned();
        let mut begin = Some(begin);
        let harness = Harness::builder()
            .with_size(size)
            .with_pixels_per_point(density)
            .with_step_dt(1.0 / 60.0)
            .with_render_cursor(false)
            .with_context_setup(theme::apply)
            .build_ui_state(
                move |ui, studio: &mut Option<Studio>| {
                    let options =
                        WorkerOptions { backend: BackendChoice::Cpu, ..WorkerOptions::default() };
                    let studio = studio.get_or_insert_with(|| {
                        let worker = StartedWorker::new(options, begin.take().unwrap_or_default());
                        // We show nothing over the picture.
                        let preferences =
                            Preferences { first_steps_seen: true, ..Preferences::default() };
                        let files = Files::new(ui.ctx(), Home::in_folder(&home), preferences);
                        let pen = Pen::new(PenSettings::default());
                        let parts = Parts { worker, pen, files, open: None, log: None };
                        Studio::new(ui.ctx(), parts)
                    });
                    studio.logic(ui.ctx());
                    // This uses the whole window, without the margin of the harness.
                    let whole = ui.ctx().content_rect();
                    let mut ui = ui.new_child(UiBuilder::new().max_rect(whole));
                    ui.set_clip_rect(whole);
                    studio.ui(&mut ui, None);
                },
                None,
            );
        Self { harness, name, fences: 0, folder }
    }

    pub(crate) fn studio(&self) -> &Studio {
        self.harness.state().as_ref().expect("the window is there from the first frame on")
    }

    /// Mutable state of the window.
    pub(crate) fn studio_mut(&mut self) -> &mut Studio {
        self.harness.state_mut().as_mut().expect("the window is there from the first frame on")
    }

    /// The kittest harness. You need it for `get_by_label` and similar queries.
    pub(crate) fn harness(&mut self) -> &mut Harness<'static, Option<Studio>> {
        &mut self.harness
    }

    pub(crate) fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// Whether a label contains these words.
    pub(crate) fn shows(&self, words: &str) -> bool {
        self.harness.query_all_by_label_contains(words).next().is_some()
    }

    /// Draws frames until the worker has executed all commands and the window shows the
    /// result.
    pub(crate) fn settle(&mut self) {
        self.settle_by(|window| window.harness.step());
        self.harness.run_ok();
    }

    /// Takes turns until the worker answered all that was asked of it before.
    pub(crate) fn settle_by(&mut self, mut turn: impl FnMut(&mut Self)) {
        self.fences += 1;
        let fence = u64::MAX - self.fences;
        turn(self);
        self.studio_mut().ask(Command::Recording(fence));
        let start = Instant::now();
        let mut quiet = Instant::now();
        let mut events = self.studio().event_count();
        loop {
            turn(self);
            let answered = self.studio().last_recording() == Some(fence);
            if self.studio().event_count() != events {
                events = self.studio().event_count();
                quiet = Instant::now();
            } else if answered && quiet.elapsed() > QUIET {
                break;
            }
            assert!(start.elapsed() < PATIENCE, "{}: the worker does not end", self.name);
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    pub(crate) fn frame(&mut self, events: Vec<Event>) {
        self.harness.input_mut().events.extend(events);
        self.harness.step();
    }

    /// Drags the mouse with the primary button along points of the window, four in each frame.
    pub(crate) fn pen_stroke(&mut self, along: &[Pos2]) {
        let (Some(&first), Some(&last)) = (along.first(), along.last()) else { return };
        self.frame(vec![Event::PointerMoved(first)]);
        self.frame(vec![button(first, true)]);
        for points in along.chunks(4) {
            std::thread::sleep(Duration::from_millis(8));
            self.frame(points.iter().copied().map(Event::PointerMoved).collect());
        }
        self.frame(vec![button(last, false)]);
        self.frame(Vec::new());
    }

    pub(crate) fn key(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.harness.step();
        self.harness.run_ok();
    }

    pub(crate) fn click(&mut self, label: &str) {
        self.harness.get_by_label(label).click();
        self.harness.step();
        self.harness.run_ok();
    }

    /// Clicks a control that opens a menu or a window, and waits for its layout.
    pub(crate) fn open_menu(&mut self, label: &str) {
        self.click(label);
        self.harness.run_steps(3);
    }

    /// Converts a position on a surface, in mm, to a point of the window.
    pub(crate) fn point(&self, surface: SurfaceId, x_mm: f64, y_mm: f64) -> Pos2 {
        let studio = self.studio();
        let view = match surface {
            SurfaceId::Canvas => &studio.canvas,
            SurfaceId::Palette => &studio.palette,
        };
        let cell_mm = studio.painting().map_or(1.0, |painting| painting.cell_mm);
        view.placement().point([x_mm / cell_mm, y_mm / cell_mm])
    }

    /// Renders the window; `None` without an adapter.
    pub(crate) fn picture(&mut self) -> Option<RgbaImage> {
        has_adapter().then(|| self.harness.render().expect("the window is drawn"))
    }

    /// Renders the window for a person to look at, if we keep pictures ([`keep`]).
    pub(crate) fn show(&mut self, name: &str) {
        if are_pictures_kept() {
            self.save(name);
        }
    }

    /// Renders the window if there is an adapter, and saves the picture if we keep pictures.
    pub(crate) fn save(&mut self, name: &str) {
        if let Some(picture) = self.picture() {
            keep(&picture, name);
        }
    }

    /// Colour at a point of the window.
    pub(crate) fn color(&self, picture: &RgbaImage, at: Pos2) -> [u8; 3] {
        let pixel = at * self.harness.ctx.pixels_per_point();
        let [red, green, blue, _] = picture.get_pixel(pixel.x as u32, pixel.y as u32).0;
        [red, green, blue]
    }

    pub(crate) fn whole(&self) -> Rect {
        self.harness.ctx.content_rect()
    }
}

impl Drop for Window {
    fn drop(&mut self) {
        if std::thread::panicking() && has_adapter() {
            let path = folder().join(format!("{}.png", self.name));
            if let Ok(picture) = self.harness.render()
                && picture.save(&path).is_ok()
            {
                let _ = writeln!(std::io::stderr(), "the window is in {}", path.display());
            }
        }
    }
}

/// Whether there is a graphics adapter. If you set the environment variable `IMPASTO_GPU_TESTS` to
/// a file, this appends the adapter's name (or `none`) there.
pub(crate) fn has_adapter() -> bool {
    let device = choose(BackendChoice::Gpu).ok().flatten();
    let name = device.as_ref().map_or("none", |device| &device.adapter().name);
    if let Some(path) = std::env::var_os("IMPASTO_GPU_TESTS") {
        let file = std::fs::OpenOptions::new().append(true).create(true).open(path);
        let noted = file.and_then(|mut file| file.write_all(format!("{name}\n").as_bytes()));
        noted.expect("the list of tests on an adapter can be written");
    }
    if device.is_none() {
        let _ = writeln!(std::io::stderr(), "no graphics adapter: not tested");
    }
    device.is_some()
}

/// Whether to keep pictures. You set the environment variable `IMPASTO_PICTURES` for this.
fn are_pictures_kept() -> bool {
    std::env::var_os("IMPASTO_PICTURES").is_some()
}

/// Writes `target/tmp/NAME.png` if we keep pictures.
pub(crate) fn keep(picture: &RgbaImage, name: &str) {
    if are_pictures_kept() {
        let path = folder().join(format!("{name}.png"));
        picture.save(&path).expect("a picture can be written below target");
    }
}

pub(crate) fn button(pos: Pos2, pressed: bool) -> Event {
    let modifiers = Modifiers::NONE;
    Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers }
}

fn folder() -> PathBuf {
    // Examples do not have this variable.
    option_env!("CARGO_TARGET_TMPDIR").map_or_else(std::env::temp_dir, PathBuf::from)
}
