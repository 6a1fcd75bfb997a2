//! Tests of light, eyedropper and reference picture in the whole window with a real
//! worker.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use eframe::egui::{DroppedFile, Event, Key, Modifiers, Role, ViewportCommand, ViewportId, vec2};
use egui_kittest::kittest::Queryable;
use image::{Rgb, RgbImage};
use paint::strokes::{Action, Load, Squeeze, SurfaceId};
use session::Command;
use studio::app::Tab;
use studio::panels::Mode;

use super::harness::Window;

/// Clicks at a position of a surface, in mm.
fn press(window: &mut Window, surface: SurfaceId, x_mm: f64, y_mm: f64) {
    let place = window.point(surface, x_mm, y_mm);
    window.pen_stroke(&[place, place]);
    window.settle();
}

/// Draws frames until a control with this label exists.
fn wait_for(window: &mut Window, label: &str) {
    for _ in 0..6000 {
        if window.harness().query_by_label(label).is_some() {
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(5));
        window.harness().step();
    }
    panic!("there is no {label}");
}

/// A file dropped by the window system.
#[derive(Debug)]
struct Dropped(PathBuf);

impl DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

pub(super) fn drop_file(window: &mut Window, path: &Path) {
    let dropped = Arc::new(Dropped(path.to_owned()));
    window.harness().input_mut().dropped_files.push(dropped);
    window.harness().step();
}

fn squeeze(window: &mut Window, recipe: &[(&str, f64)]) {
    let recipe = recipe.iter().map(|(name, parts)| ((*name).to_owned(), *parts)).collect();
    let on = SurfaceId::Palette;
    let heap = Squeeze { on, recipe, vehicle: 0.2, x_mm: 20.0, y_mm: 15.0, volume_mm3: 60.0 };
    window.studio_mut().ask(Command::Apply(Action::Squeeze(heap)));
    window.settle();
}

#[test]
fn picked_palette_paint_is_matched_loaded_and_squeezed() {
    let mut window = Window::sized("picked-and-matched", vec2(1600.0, 1500.0), 1.0);
    squeeze(&mut window, &[("Zinc White", 3.0), ("Ultramarine", 1.0)]);
    window.studio_mut().tools.mode = Mode::Pick;
    press(&mut window, SurfaceId::Palette, 20.0, 15.0);
    // The eyedropper tab is selected and shows the mixture.
    wait_for(&mut window, "Copy Wet");
    assert!(window.harness().query_by_label_contains("20 % medium").is_some(), "its medium");
    window.click("Find recipes");
    wait_for(&mut window, "Load recipe 1");
    window.save("eyedropper-window");
    window.studio_mut().tools.mode = Mode::Paint;
    let answer = window.harness().query_by_label("\u{2206}E 0.00").is_some()
        || window.harness().query_by_label("\u{2206}E 0.01").is_some();
    assert!(answer, "the mixture itself is found");
    window.click("Load recipe 1");
    window.settle();
    let painting = window.studio().painting().unwrap().clone();
    let brush = painting.brushes.iter().find(|brush| brush.name == "round").unwrap();
    let slot = |name: &str| {
        let pigment = painting.library.find(name).unwrap();
        painting.slots.iter().position(|slot| *slot == Some(pigment)).unwrap()
    };
    for (name, share) in [("Zinc White", 0.75), ("Ultramarine", 0.25)] {
        let found = brush.parts[slot(name)];
        assert!((found - share).abs() < 1e-3, "{found} of {name}");
    }
    let before = painting.history.len();
    let revision = painting.revision;
    window.click("Lay recipe 1");
    window.settle();
    let painting = window.studio().painting().unwrap();
    assert!(
        painting.history.len() > before && painting.revision > revision,
        "{:?}",
        painting.history
    );
    assert!(painting.history.last().unwrap().contains("squeeze"), "{:?}", painting.history);
}

#[test]
fn a_new_illuminant_changes_the_color_of_the_brush() {
    let mut window = Window::open("relit");
    let load = Load {
        brush: "round".to_owned(),
        recipe: [("Vermilion".to_owned(), 1.0)].into(),
        vehicle: 0.0,
        amount_mm: 0.3,
    };
    window.studio_mut().ask(Command::Apply(Action::Load(load)));
    window.studio_mut().panels.select(Tab::Light);
    window.settle();
    let color = |window: &Window| {
        let brushes = &window.studio().painting().unwrap().brushes;
        brushes.iter().find(|brush| brush.name == "round").unwrap().color
    };
    let before = color(&window);
    assert!(before.is_some(), "there is paint on it");
    window.click("Illuminant: D65");
    window.harness().get_by_role(Role::TextInput).type_text("LED-RGB1");
    window.settle();
    window.click("LED-RGB1");
    window.settle();
    let painting = window.studio().painting().unwrap();
    assert_eq!(painting.lighting.illuminant, "LED-RGB1");
    assert_eq!(painting.light.viewing.illuminant.name(), "LED-RGB1");
    assert_ne!(color(&window), before, "the lamp changes the colour of red paint");
}

#[test]
fn the_pigment_whose_whole_name_was_typed_is_taken_by_enter() {
    let mut window = Window::open("searched-pigment");
    window.studio_mut().tools.tube = 7;
    window.click("Tubes...");
    let name = |window: &Window| {
        let painting = window.studio().painting().unwrap();
        painting.library[painting.slots[7].unwrap()].name.clone()
    };
    assert_eq!(name(&window), "Bone Black");
    window.harness().get_by_label("Search").focus();
    window.harness().step();
    window.harness().get_by_label("Search").type_text("eosin lake");
    window.harness().run_ok();
    window.save("searched-pigment");
    window.key(Modifiers::NONE, Key::Enter);
    window.settle();
    assert_eq!(name(&window), "Eosin Lake", "not the one of which it is a part");
}

#[test]
fn a_color_of_the_reference_picture_finds_recipes() {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("pinned.png");
    let picture =
        RgbImage::from_fn(
            320,
            400,
            |_, y| {
                if y < 200 { Rgb([196, 140, 70]) } else { Rgb([60, 80, 110]) }
            },
        );
    picture.save(&path).unwrap();
    let mut window = Window::open("pinned");
    assert!(window.harness().query_by_label("Reference picture").is_none(), "none is pinned");
    drop_file(&mut window, &path);
    wait_for(&mut window, "Reference picture");
    for _ in 0..100 {
        std::thread::sleep(std::time::Duration::from_millis(5));
        window.harness().step();
    }
    let place = window.harness().get_by_label("Reference picture").rect();
    window.pen_stroke(&[place.center() - vec2(0.0, 20.0); 2]);
    wait_for(&mut window, "Load recipe 1");
    window.save("reference-window");
    let wanted = window.studio().panels.eyedropper.target().unwrap().clone();
    let painting = window.studio().painting().unwrap();
    let shown = wanted.shown(painting.library.grid, &painting.light.viewing);
    assert_eq!(shown.to_bytes(), [196, 140, 70]);
    let done = painting.history_done;
    window.click("Close picture");
    window.settle();
    assert!(window.harness().query_by_label("Reference picture").is_none(), "it is gone");
    assert_eq!(window.studio().painting().unwrap().history_done, done, "nothing was painted by it");
}

#[test]
fn a_dropped_swatch_file_is_shown() {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("dropped.gpl");
    std::fs::write(&path, "GIMP Palette\n#\n 120 96 60 Umber\n").unwrap();
    let mut window = Window::open("dropped-colours");
    drop_file(&mut window, &path);
    wait_for(&mut window, "Umber");
    window.click("Umber");
    wait_for(&mut window, "Load recipe 1");
    assert_eq!(window.studio().panels.eyedropper.target().unwrap().name, "Umber");
}

#[test]
fn a_key_asks_the_system_for_full_screen_and_back() {
    let mut window = Window::open("full-screen");
    let mut press = |full: bool| {
        let viewport = window.harness().input_mut().viewports.entry(ViewportId::ROOT).or_default();
        viewport.fullscreen = Some(full);
        let key = |pressed| Event::Key {
            key: Key::F11,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers: Modifiers::NONE,
        };
        window.frame(vec![key(true), key(false)]);
        window.harness().output().viewport_output[&ViewportId::ROOT].commands.clone()
    };
    assert!(press(false).contains(&ViewportCommand::Fullscreen(true)));
    assert!(press(true).contains(&ViewportCommand::Fullscreen(false)));
}
