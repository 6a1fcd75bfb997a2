//! A scripted painter uses the built program. It does everything that the guides explain, and takes
//! a picture of the screen after each part, for a person to look at.
//!
//! It does everything twice: in the program on its screen, and in a twin window without a screen.
//! The twin has the same set-up and knows where each control is.

#[expect(dead_code, reason = "the tests of the panels need more of it")]
#[path = "../panels/harness.rs"]
mod harness;

use std::path::{Path, PathBuf};

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use paint::strokes::SurfaceId;
use paint::strokes::SurfaceId::{Canvas, Palette};
use session::initial_commands;
use studio::app::TourStep;
use studio::files::Preferences;
use studio::theme::ThemeChoice;
use web_time::{Duration, Instant};

use crate::program::{Program, keep_preferences};
use crate::screen::{CONTROL, RETURN, SECONDARY, SHIFT as SHIFT_KEY};
use harness::Window;

/// Longest time that we wait for a still screen before a picture.
const REST: Duration = Duration::from_secs(8);

const ESCAPE: u32 = 0xff1b;
const F1: u32 = 0xffbe;
const F12: u32 = 0xffc9;

/// A hand that does the same in both windows.
struct Hand<'a> {
    program: Program<'a>,
    /// The twin window. It knows where controls are.
    twin: Window,
    folder: PathBuf,
    pictures: usize,
}

impl<'a> Hand<'a> {
    /// A hand that saves its pictures in `folder`.
    fn new(program: Program<'a>, twin: Window, folder: PathBuf) -> Self {
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
    fn place(&mut self, label: &str) -> Pos2 {
        self.find(label).unwrap_or_else(|| {
            self.twin.save("painter-twin");
            let path = self.program.screen.all().keep("painter");
            panic!("nothing is called {label}; the screen is in {path}")
        })
    }

    /// Middle of the first control with this label, or else of one that contains it. For example,
    /// rows of files contain their sizes too.
    fn find(&mut self, label: &str) -> Option<Pos2> {
        let harness = self.twin.harness();
        let found = harness.query_all_by_label(label).next();
        let found = found.or_else(|| harness.query_all_by_label_contains(label).next());
        found.map(|node| node.rect().center())
    }

    /// Middle of the slider or field with a label.
    fn place_of(&mut self, role: Role, label: &str) -> Pos2 {
        let root = self.twin.harness().root();
        let mut all = root.children_recursive();
        let found = all.find(|node| {
            let inner = node.accesskit_node();
            inner.role() == role && inner.label().is_some_and(|own| own.contains(label))
        });
        found.map(|node| node.rect().center()).unwrap_or_else(|| panic!("no {role:?} {label}"))
    }

    /// Waits until both windows are done.
    fn wait(&mut self) {
        std::thread::sleep(Duration::from_millis(150));
        self.twin.settle();
    }

    fn click_at(&mut self, at: Pos2) {
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

    fn click_aside(&mut self, at: Pos2) {
        self.program.screen.click_with(SECONDARY, self.on_screen(at));
        self.twin_click(at, PointerButton::Secondary);
        self.wait();
    }

    fn click(&mut self, label: &str) {
        let at = self.place(label);
        self.click_at(at);
    }

    fn double_click(&mut self, label: &str) {
        let at = self.place(label);
        let screen = self.program.screen;
        screen.point(self.on_screen(at));
        std::thread::sleep(Duration::from_millis(150));
        // We click quickly, because frames of a busy computer lie far apart and would make two
        // clicks of it.
        for pressed in [true, false, true, false] {
            screen.button(pressed);
            std::thread::sleep(Duration::from_millis(15));
        }
        self.twin_click(at, PointerButton::Primary);
        self.twin_click(at, PointerButton::Primary);
        self.wait();
    }

    fn choose(&mut self, menu: &str, entry: &str) {
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

    fn key(&mut self, modifiers: Modifiers, key: Key) {
        let mut held = Vec::new();
        held.extend(modifiers.command.then_some(CONTROL));
        held.extend(modifiers.shift.then_some(SHIFT_KEY));
        self.program.screen.key(keysym(key), &held);
        self.twin.key(modifiers, key);
        self.wait();
    }

    fn escape(&mut self) {
        self.key(Modifiers::NONE, Key::Escape);
    }

    fn text(&mut self, text: &str) {
        self.program.screen.text(text);
        self.twin.frame(vec![Event::Text(text.to_owned())]);
        self.wait();
    }

    /// Drags along points of the window, with `per_leg` positions between two.
    fn drag(&mut self, corners: &[Pos2]) {
        let mut along = vec![corners[0]];
        for leg in corners.windows(2) {
            let steps = (leg[0].distance(leg[1]) / 6.0).ceil().max(1.0) as usize;
            along.extend((1..=steps).map(|step| leg[0].lerp(leg[1], step as f32 / steps as f32)));
        }
        let screen = self.program.screen;
        screen.point(self.on_screen(along[0]));
        std::thread::sleep(Duration::from_millis(80));
        screen.button(true);
        // Even on a busy computer there is a frame between press and release.
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
    fn paint(&mut self, surface: SurfaceId, along: &[(f64, f64)]) {
        let points: Vec<Pos2> =
            along.iter().map(|&(x, y)| self.twin.point(surface, x, y)).collect();
        self.drag(&points);
    }

    fn hover(&mut self, at: Pos2) {
        self.program.screen.point(self.on_screen(at));
        self.twin.frame(vec![Event::PointerMoved(at)]);
        self.wait();
    }

    fn aside(&mut self) {
        let height = self.twin.whole().height();
        self.hover(Pos2::new(120.0, height - 8.0));
    }

    /// Takes a picture once the screen is still. The pointer stays where it is.
    fn picture(&mut self, name: &str) {
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

    fn station(&mut self, name: &str) {
        self.aside();
        self.picture(name);
    }

    fn end(self) {
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

const NONE: Modifiers = Modifiers::NONE;
const SHIFT: Modifiers = Modifiers::SHIFT;

impl Hand<'_> {
    /// Shows pressure curve and stabiliser, with strokes on the test field.
    fn pen(&mut self) {
        self.key(SHIFT, Key::P);
        self.click("Firm");
        let field = self.place("Pressure curve") + vec2(0.0, 20.0);
        self.hover(field);
        self.station("pen-window");
        if self.find("Test field").is_some() {
            let middle = self.place("Test field");
            let corners =
                [vec2(-90.0, -20.0), vec2(-30.0, 20.0), vec2(30.0, -20.0), vec2(90.0, 20.0)];
            self.drag(&corners.map(|corner| middle + corner));
            self.station("pen-field");
        }
        self.key(SHIFT, Key::P);
    }

    /// Saves the current brush, with the paint on it, among the own brushes (button `Keep brush`).
    fn keep_brush(&mut self) {
        self.key(SHIFT, Key::B);
        self.click("with its paint");
        self.click("Keep brush");
        self.station("own-brushes");
        self.key(SHIFT, Key::B);
    }

    /// Uses the tools that work wet paint, and a mask.
    fn tools(&mut self) {
        self.key(NONE, Key::W);
        self.double_click("tube of Chrome Yellow");
        self.paint(Canvas, &[(30.0, 80.0), (160.0, 84.0)]);
        self.key(NONE, Key::N);
        self.paint(Canvas, &[(50.0, 74.0), (55.0, 92.0), (62.0, 74.0)]);
        self.station("blended");
        self.key(NONE, Key::S);
        self.paint(Canvas, &[(90.0, 76.0), (92.0, 92.0)]);
        self.station("scraped");
        self.key(NONE, Key::E);
        self.paint(Canvas, &[(120.0, 76.0), (128.0, 92.0), (136.0, 76.0)]);
        self.station("erased");
        self.key(NONE, Key::K);
        let mask =
            [(60.0, 10.0), (140.0, 12.0), (150.0, 60.0), (90.0, 70.0), (50.0, 40.0), (60.0, 10.0)];
        self.paint(Canvas, &mask);
        self.station("mask");
        self.key(NONE, Key::B);
        self.paint(Canvas, &[(40.0, 30.0), (165.0, 36.0)]);
        self.station("painted-through-the-mask");
    }

    /// Opens the round menu at the pointer.
    fn quick_palette(&mut self) {
        let middle = self.twin.point(Canvas, 100.0, 50.0);
        self.click_aside(middle);
        self.picture("quick-palette");
        let tube = self.place("quick Prussian Blue");
        self.hover(tube);
        self.picture("quick-palette-tube");
        self.click_at(tube);
    }

    /// Shows kept mixtures, the wheel of the tubes, and the eyedropper with recipes.
    fn colors(&mut self) {
        self.click("Keep this mixture");
        self.click("Swatches");
        self.station("swatches");
        self.click("Wheel");
        self.wait_for("Colour wheel");
        self.station("wheel");
        let at = self.place("Colour wheel") + vec2(20.0, -24.0);
        self.click_at(at);
        self.wait_for("Load recipe 1");
        self.station("wheel-recipes");
        self.key(NONE, Key::I);
        self.paint(Palette, &[(26.0, 20.0), (26.0, 20.1)]);
        self.station("eyedropper");
        self.key(NONE, Key::B);
        self.click("Light");
        self.station("light");
    }

    /// Dries, names, moves and merges layers.
    fn layers(&mut self) {
        self.key(NONE, Key::D);
        self.double_click("tube of Zinc White");
        self.paint(Canvas, &[(100.0, 30.0), (120.0, 90.0)]);
        self.key(NONE, Key::D);
        self.click("Layers");
        self.station("layers");
        self.click("menu of Layer 1");
        self.picture("layer-menu");
        self.click("Rename (F2)");
        self.text("sky");
        self.key(NONE, Key::Enter);
        self.click("menu of sky");
        self.click("Move up");
        self.station("layer-moved");
        self.click("menu of sky");
        if self.find("Merge down").is_some() {
            self.click("Merge down");
        }
        self.station("layers-merged");
        self.click("History");
        self.station("history");
        self.click("Brush");
    }

    /// Draws frames in both windows until a control is there.
    fn wait_for(&mut self, label: &str) {
        for _ in 0..60 {
            if self.find(label).is_some() {
                std::thread::sleep(Duration::from_millis(500));
                return;
            }
            self.wait();
        }
        panic!("there is no {label}");
    }
}

const DIALOGS_NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

impl Hand<'_> {
    /// Opens the frame of a crop and leaves it.
    fn crop(&mut self) {
        self.choose("Edit", "Crop...");
        self.station("crop-all");
        for (handle, x_mm, y_mm) in
            [("Crop upper left", 30.0, 20.0), ("Crop lower right", 150.0, 90.0)]
        {
            let from = self.place(handle);
            let to = self.twin.point(Canvas, x_mm, y_mm);
            self.drag(&[from, to]);
        }
        self.station("crop");
        self.escape();
    }

    /// Pins a picture beside the canvas and lays it over it.
    fn reference(&mut self) {
        self.choose("File", "Pin a picture...");
        self.wait_for("reference.png");
        std::thread::sleep(Duration::from_secs(1));
        self.station("browser");
        self.click("reference.png");
        self.click("Open");
        self.wait_for("Reference picture");
        self.station("reference");
        self.key(DIALOGS_NONE, Key::O);
        self.station("reference-over");
        self.key(DIALOGS_NONE, Key::O);
        self.click("Close picture");
    }

    /// Opens all dialogs of files.
    fn dialogs(&mut self) {
        self.key(CTRL, Key::N);
        self.station("new");
        self.escape();
        self.key(CTRL, Key::S);
        self.station("save");
        self.escape();
        self.key(CTRL, Key::E);
        self.station("export");
        self.escape();
        self.choose("File", "Export timelapse...");
        self.station("timelapse");
        self.escape();
        self.key(CTRL, Key::Comma);
        self.station("preferences");
        self.escape();
    }

    /// Opens menus, keys and figures, and uses the touch mode.
    fn window(&mut self) {
        for menu in ["File", "Edit", "View", "Tools", "Help"] {
            self.click(menu);
            self.picture(&format!("menu-{}", menu.to_lowercase()));
            self.escape();
        }
        self.key(DIALOGS_NONE, Key::F1);
        self.station("keys");
        self.click("Find an action");
        self.text("mirror");
        self.click("change M of Mirror");
        self.station("keys-change");
        self.escape();
        self.escape();
        self.key(DIALOGS_NONE, Key::F12);
        self.station("figures");
        self.key(DIALOGS_NONE, Key::F12);
        self.choose("View", "Large targets for touch");
        self.station("touch");
        self.click("View");
        self.picture("touch-menu-view");
        self.escape();
        self.key(CTRL, Key::Comma);
        self.station("touch-preferences");
        self.click("Large targets");
        self.click("Close");
        self.choose("View", "Palette");
        self.station("without-palette");
        self.choose("View", "Palette");
        self.paint(Canvas, &[(20.0, 96.0), (60.0, 100.0)]);
        self.key(CTRL, Key::Q);
        self.station("unsaved");
        self.escape();
    }

    /// Shows the workspace of scenes, and the sample painting.
    fn others(&mut self) {
        self.choose("File", "New scene");
        std::thread::sleep(Duration::from_secs(4));
        self.station("scene");
        self.key(CTRL, Key::E);
        self.choose("File", "Sample painting");
        self.station("sample-asks");
        if self.find("Discard").is_some() {
            self.click("Discard");
        }
        for _ in 0..60 {
            self.wait();
            if !self.twin.studio().files.is_playing() {
                break;
            }
        }
        std::thread::sleep(Duration::from_secs(5));
        self.station("sample");
    }

    /// Follows the tour and does what each card asks for.
    fn tour(&mut self) {
        self.station("first-start");
        self.choose("Help", "Guided tour");
        for step in TourStep::ALL {
            assert_eq!(self.twin.studio().tour().step(), Some(step), "the tour goes on");
            self.station(&format!("tour-{step:?}").to_lowercase());
            self.take(step);
        }
        self.station("tour-end");
        self.click("Close the tour");
    }

    fn take(&mut self, step: TourStep) {
        match step {
            TourStep::Load => self.double_click("tube of Vermilion"),
            TourStep::Paint => {
                self.paint(Canvas, &[(20.0, 30.0), (70.0, 20.0), (110.0, 45.0)]);
            }
            TourStep::Mix => {
                for (tube, x_mm) in [("Ultramarine", 22.0), ("Zinc White", 30.0)] {
                    self.click(&format!("tube of {tube}"));
                    self.key(Modifiers::NONE, Key::Q);
                    self.paint(Palette, &[(x_mm, 20.0), (x_mm, 20.1)]);
                }
                self.key(Modifiers::NONE, Key::B);
                self.paint(Palette, &[(18.0, 18.0), (34.0, 22.0), (18.0, 22.0), (34.0, 18.0)]);
                self.paint(Canvas, &[(30.0, 60.0), (80.0, 70.0), (150.0, 55.0)]);
            }
            TourStep::Dry => self.key(Modifiers::NONE, Key::D),
            TourStep::Glaze => {
                self.key(Modifiers::NONE, Key::W);
                // You see the medium of the loads once the other panels are folded.
                self.click("Fold Light");
                self.set_medium("99");
                self.double_click("tube of Cochineal Lake");
                self.paint(Canvas, &[(40.0, 20.0), (90.0, 60.0), (140.0, 40.0)]);
                self.set_medium("15");
                self.station("tour-brush-unfolded");
                self.click("Unfold Light");
            }
            TourStep::Relight => self.key(Modifiers::NONE, Key::L),
        }
    }

    fn set_medium(&mut self, percent: &str) {
        let at = self.place_of(Role::SpinButton, "Medium");
        self.click_at(at);
        self.key(Modifiers::COMMAND, Key::A);
        self.text(percent);
        self.key(Modifiers::NONE, Key::Enter);
    }
}

/// Sizes of the screen, and of the window that fills it.
const SIZES: [(u16, u16); 4] = [(1280, 800), (1024, 700), (1440, 900), (1920, 1080)];

const THEMES: [(&str, ThemeChoice); 2] =
    [("dark", ThemeChoice::Dark), ("light", ThemeChoice::Light)];

/// Goes through all parts of the walk. If you set the environment variable `IMPASTO_STATIONS`, this
/// goes only through the parts with these letters, in this order.
fn walks(hand: &mut Hand<'_>) {
    let wanted = std::env::var("IMPASTO_STATIONS").unwrap_or_else(|_| "tpobqclrdwx".to_owned());
    for station in wanted.chars() {
        match station {
            't' => hand.tour(),
            'p' => hand.pen(),
            'o' => hand.keep_brush(),
            'b' => hand.tools(),
            'q' => hand.quick_palette(),
            'c' => hand.colors(),
            'l' => hand.layers(),
            'r' => {
                hand.crop();
                hand.reference();
            }
            'd' => hand.dialogs(),
            'w' => hand.window(),
            'x' => hand.others(),
            other => panic!("there is no station {other}"),
        }
    }
}

fn write_reference(folder: &Path) {
    let picture = image::RgbImage::from_fn(300, 200, |x: u32, y: u32| {
        image::Rgb([(x * 4 / 5) as u8, (y * 6 / 5) as u8, 120])
    });
    picture.save(folder.join("reference.png")).unwrap();
}

#[test]
#[ignore = "takes hundreds of pictures for a person to look at, which takes many minutes"]
fn a_painter_does_all_that_the_guides_tell_of() {
    let wanted = std::env::var("IMPASTO_LOOKS").unwrap_or_default();
    for (width, height) in SIZES {
        for (name, theme) in THEMES {
            let look = format!("{width}x{height}-{name}");
            if !wanted.is_empty() && !wanted.split(',').any(|wanted| wanted == look) {
                continue;
            }
            let Some(screen) = crate::screen(width, height) else { return };
            let folder = tempfile::Builder::new().prefix("painter").tempdir().unwrap();
            let pictures = folder.path().join("pictures");
            std::fs::create_dir_all(&pictures).unwrap();
            write_reference(&pictures);
            let home = folder.path().join("home");
            let preferences = Preferences {
                theme,
                last_folder: Some(pictures),
                first_steps_seen: true,
                ..Preferences::default()
            };
            keep_preferences(
                &home,
                &Preferences { first_steps_seen: false, ..preferences.clone() },
            );
            let size = vec2(width.into(), height.into());
            let mut twin = Window::with_commands("painter", size, 1.0, initial_commands());
            twin.studio_mut().files.preferences = preferences;
            twin.settle();
            let program = Program::start(&screen, &home, &format!("{width}x{height}"), &[]);
            let out = Path::new(env!("CARGO_MANIFEST_DIR")).join("../out/painter").join(&look);
            let mut hand = Hand::new(program, twin, out);
            walks(&mut hand);
            hand.end();
        }
    }
}
