//! Tests of own brushes: keeping, using, ordering, and files.

use std::path::Path;
use std::time::Duration;

use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use paint::brush::HeadShape;
use paint::strokes::{BrushSpec, Load};
use session::Command;
use session::brushes::{BrushOptions, BrushSet, TiltUse};

use super::harness::Window;

fn open(name: &'static str) -> Window {
    let mut window = Window::open(name);
    window.studio_mut().visible.brush_sets = true;
    until(&mut window, "the sets", |window| window.studio().files.brush_sets.is_read());
    window.harness().run_ok();
    window
}

fn until(window: &mut Window, what: &str, done: impl Fn(&Window) -> bool) {
    for _ in 0..4000 {
        if done(window) {
            return;
        }
        std::thread::sleep(Duration::from_millis(3));
        window.harness().step();
    }
    panic!("{what} did not come");
}

fn names(window: &Window) -> Vec<String> {
    let set = window.studio().files.brush_sets.set();
    set.map_or_else(Vec::new, |set| {
        set.presets().iter().map(|preset| preset.name.clone()).collect()
    })
}

/// Sets of brushes in the home folder, as they are on the disk.
fn stored(window: &Window) -> Vec<BrushSet> {
    let folder = window.folder().join("brushes");
    session::brushes::folder::read_sets(&folder).0.into_iter().map(|stored| stored.set).collect()
}

#[test]
fn a_kept_brush_comes_back_with_head_options_and_paint() {
    let mut window = open("own-brushes");
    let load = Load {
        brush: "round".to_owned(),
        recipe: [("Vermilion".to_owned(), 1.0)].into(),
        vehicle: 0.25,
        amount_mm: 0.3,
    };
    let command = Command::Apply(paint::strokes::Action::Load(load));
    window.studio_mut().ask(command);
    let options = BrushOptions { tilt: TiltUse::Fixed(40.0), ..BrushOptions::default() };
    window.studio_mut().files.preferences.set_options("round", options.clone());
    window.settle();
    window.click("with its paint");
    window.click("Keep brush");
    assert_eq!(names(&window), ["round"]);
    window.save("own-brushes");
    // Another painting's round is changed and clean, and has no options.
    let spec = BrushSpec { shape: HeadShape::Fan, size_mm: 20.0 };
    window.studio_mut().ask(Command::SetBrush { name: "round".to_owned(), spec });
    window.studio_mut().files.preferences.set_options("round", BrushOptions::default());
    let other = Load {
        brush: "round".to_owned(),
        recipe: [("Ultramarine".to_owned(), 1.0)].into(),
        vehicle: 0.0,
        amount_mm: 0.2,
    };
    window.studio_mut().ask(Command::Apply(paint::strokes::Action::Load(other)));
    window.key(Modifiers::NONE, Key::Num2);
    window.settle();
    window.click("own brush round");
    window.click("Take in hand");
    window.settle();
    let studio = window.studio();
    assert_eq!(studio.tools.brush, "round");
    let brush = studio.painting().unwrap().brushes.iter().find(|brush| brush.name == "round");
    let brush = brush.unwrap();
    assert_eq!(brush.spec.shape, HeadShape::Round);
    assert!((brush.vehicle - 0.25).abs() < 1e-3 && brush.amount_mm > 0.1, "{brush:?}");
    let pigments = brush.parts.iter().filter(|part| **part > 0.0).count();
    assert_eq!(pigments, 1, "the kept paint alone: {brush:?}");
    assert_eq!(studio.files.preferences.options_of("round"), options);
    until(&mut window, "the file", |window| stored(window).len() == 1);
    assert_eq!(stored(&window)[0].presets()[0].options, options);
}

#[test]
fn brushes_are_renamed_ordered_and_removed_and_sets_removed_with_their_file() {
    let mut window = open("own-brushes-order");
    window.click("Keep brush");
    window.key(Modifiers::NONE, Key::Num2);
    let second = window.studio().tools.brush.clone();
    window.click("Keep brush");
    window.click(&format!("own brush {second}"));
    window.click("Up");
    assert_eq!(names(&window), [second.clone(), "round".to_owned()]);
    window.click("Rename brush");
    window.harness().run_ok();
    window.harness().get_by_label("Name of the own brush").type_text(" of hog");
    window.harness().step();
    window.key(Modifiers::NONE, Key::Enter);
    assert_eq!(names(&window), [format!("{second} of hog"), "round".to_owned()]);
    window.click("Remove brush");
    assert_eq!(names(&window), ["round"]);
    until(&mut window, "the file", |window| {
        stored(window).first().is_some_and(|set| set.presets().len() == 1)
    });
    window.click("Remove set");
    assert_eq!(names(&window).len(), 1, "it asks first");
    window.click("Really remove");
    until(&mut window, "an empty folder", |window| stored(window).is_empty());
}

/// Imports a file, whose path is typed in the browser.
fn import(window: &mut Window, path: &Path) {
    window.click("Import...");
    window.harness().run_ok();
    window.harness().get_by_label("Folder").focus();
    window.harness().step();
    window.key(Modifiers::COMMAND, Key::A);
    window.harness().get_by_label("Folder").type_text(path.to_str().unwrap());
    window.harness().step();
    window.key(Modifiers::NONE, Key::Enter);
}

#[test]
fn sets_are_exported_and_imported_and_brushes_of_mypaint_taken_over() {
    let mut window = open("own-brushes-files");
    window.click("Keep brush");
    let home = window.folder().to_owned();
    let exported = home.join("My brushes.json");
    window.studio_mut().files.preferences.last_folder = Some(home);
    window.click("Export...");
    window.click("Save");
    until(&mut window, "the export", |_| exported.exists());
    let kept = window.studio().files.brush_sets.set().unwrap().clone();
    let text = std::fs::read_to_string(&exported).unwrap();
    assert_eq!(BrushSet::of_json(&text, "out.json"), Ok(kept.clone()));
    import(&mut window, &exported);
    until(&mut window, "the set", |window| window.studio().files.brush_sets.sets.len() == 2);
    let kept = kept.named("My brushes 2");
    assert_eq!(window.studio().files.brush_sets.set(), Some(&kept), "under a name of its own");

    let ink = window.folder().join("ink.myb");
    let settings = r#""radius_logarithmic": {"base_value": 3, "inputs": {"pressure": [[0, -1], [1, 0]]}},
        "hardness": {"base_value": 0.5, "inputs": {}}"#;
    std::fs::write(&ink, format!(r#"{{"version": 3, "settings": {{{settings}}}}}"#)).unwrap();
    import(&mut window, &ink);
    until(&mut window, "the brush", |window| names(window).contains(&"ink".to_owned()));
    window.harness().run_ok();
    let told = window.harness().query_by_label_contains("has no meaning here: hardness").is_some();
    assert!(told, "nothing is dropped in silence");
    window.save("own-brushes-imported");

    std::fs::write(&ink, "{}").unwrap();
    import(&mut window, &ink);
    until(&mut window, "the problem", |window: &Window| window.shows("key `version`: is missing"));
}
