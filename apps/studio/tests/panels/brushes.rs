//! Tests of the brush panel and of own brushes: keeping, using, ordering, and files.

use std::path::Path;
use std::time::Duration;

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use paint::brush::HeadShape;
use paint::document::LayerId;
use paint::strokes::{Action, BrushSpec, LayerRef, Load, MaskChange, Recipe};
use session::brushes::{BrushOptions, BrushSet, TiltUse};
use session::swatches::SwatchChange;
use session::{BrushState, Command};
use studio::panels::brushes::Brushes;
use studio::panels::{FileRequest, Mode, Request};

use super::fixture::{
    Fixture, PanelWindow, assert_requests, click, is_disabled, painting, picture, show_panel,
};
use super::harness::Window;

fn brushes() -> Harness<'static, Fixture<Brushes>> {
    show_panel(Brushes::default(), painting(), Brushes::show)
}

fn act(action: Action) -> Request {
    Request::Worker(Command::Apply(action))
}

fn take(name: &str, shape: HeadShape, size_mm: f64) -> Request {
    let spec = BrushSpec { shape, size_mm };
    Request::Worker(Command::SetBrush { name: name.to_owned(), spec })
}

/// Load action with the paint of the round brush of the test painting.
fn round_paint() -> Request {
    let recipe = [("Zinc White", 0.25), ("Vermilion", 0.75)];
    let recipe: Recipe = recipe.map(|(name, part)| (name.to_owned(), part)).into();
    act(Action::Load(Load { brush: "round".to_owned(), recipe, vehicle: 0.2, amount_mm: 0.4 }))
}

#[test]
fn a_click_or_a_number_selects_a_brush() {
    let mut harness = brushes();
    harness.state_mut().tools.mode = Mode::Squeeze;
    click(&mut harness, "knife");
    assert_eq!(harness.state().tools.brush, "knife");
    assert_eq!(harness.state().tools.mode, Mode::Paint);
    let there = harness.state_mut().with_panel(|panel, cx| panel.choose(2, cx));
    assert_eq!((there, harness.state().tools.brush.as_str()), (true, "flat"));
    for none in [0, 4, 9] {
        let there = harness.state_mut().with_panel(|panel, cx| panel.choose(none, cx));
        assert_eq!((there, harness.state().tools.brush.as_str()), (false, "flat"));
    }
    assert_requests(&mut harness, &[]);
}

#[test]
fn a_changed_shape_or_size_keeps_the_paint() {
    let mut harness = brushes();
    click(&mut harness, "shape filbert");
    assert_requests(&mut harness, &[take("round", HeadShape::Filbert, 6.0), round_paint()]);
    // The worker has not reported yet, so we use the requested head.
    harness.state_mut().with_panel(|panel, cx| panel.resize(1.5, cx));
    assert_requests(&mut harness, &[take("round", HeadShape::Filbert, 9.0), round_paint()]);
    click(&mut harness, "shape filbert");
    assert_requests(&mut harness, &[]);

    click(&mut harness, "flat");
    harness.get_by_role_and_label(Role::Slider, "Size").set_value_accesskit(0.5);
    harness.run();
    assert_requests(&mut harness, &[take("flat", HeadShape::Flat, 0.5)]);
    harness.state_mut().with_panel(|panel, cx| panel.resize(0.1, cx));
    assert_requests(&mut harness, &[take("flat", HeadShape::Flat, 0.2)]);
}

#[test]
fn the_label_follows_the_shape_but_not_a_name_of_the_painter() {
    let mut harness = brushes();
    click(&mut harness, "shape knife");
    click(&mut harness, "knife 2");
    click(&mut harness, "shape mop");
    assert!(harness.query_by_label("round").is_none());
    click(&mut harness, "Rename");
    harness.event(Event::Text(" of hog".to_owned()));
    harness.key_press(Key::Enter);
    harness.run();
    click(&mut harness, "shape fan");
    assert_eq!(harness.query_all_by_label("mop of hog").count(), 1);
}

#[test]
fn dragging_the_size_sends_one_request_at_the_end() {
    let mut harness = brushes();
    click(&mut harness, "knife");
    let rail = harness.get_by_role_and_label(Role::Slider, "Size").rect();
    harness.hover_at(rail.center());
    harness.drag_at(rail.center());
    harness.run();
    for step in 1..5_u8 {
        harness.hover_at(rail.center() + vec2(4.0 * f32::from(step), 0.0));
        harness.run();
    }
    assert_requests(&mut harness, &[]);
    harness.drop_at(rail.center() + vec2(16.0, 0.0));
    harness.run();
    let requests = format!("{:?}", harness.state().requests);
    assert_eq!(harness.state().requests.len(), 1, "{requests}");
    assert!(requests.contains("SetBrush { name: \"knife\""), "{requests}");
}

#[test]
fn a_reported_head_ends_its_request() {
    let mut harness = brushes();
    click(&mut harness, "shape mop");
    harness.state_mut().requests.clear();
    // The worker reports the head first and the load later.
    let round = &mut harness.state_mut().painting.brushes[0];
    round.spec.shape = HeadShape::Mop;
    let loaded = std::mem::replace(&mut round.amount_mm, 0.0);
    harness.run();
    click(&mut harness, "shape bright");
    assert_requests(&mut harness, &[take("round", HeadShape::Bright, 6.0), round_paint()]);
    let round = &mut harness.state_mut().painting.brushes[0];
    round.spec.shape = HeadShape::Bright;
    round.amount_mm = loaded;
    harness.run();
    // After washing, the brush has no paint to keep.
    harness.state_mut().painting.brushes[0].amount_mm = 0.0;
    harness.run();
    click(&mut harness, "shape fan");
    assert_requests(&mut harness, &[take("round", HeadShape::Fan, 6.0)]);
}

#[test]
fn keeping_selects_a_clean_copy_and_leaves_the_loaded_brush() {
    let mut harness = brushes();
    click(&mut harness, "Keep");
    assert_requests(&mut harness, &[take("round 2", HeadShape::Round, 6.0)]);
    assert_eq!(harness.state().tools.brush, "round 2", "selected before the worker reports it");
    assert!(is_disabled(&harness, "Wash"), "the copy is clean");
    let order: Vec<f32> =
        ["round", "round 2", "flat"].map(|name| harness.get_by_label(name).rect().top()).to_vec();
    assert!(order.is_sorted(), "the copy is listed after the original: {order:?}");
    click(&mut harness, "Keep");
    assert_requests(&mut harness, &[take("round 3", HeadShape::Round, 6.0)]);
}

#[test]
fn a_brush_is_added_renamed_and_removed() {
    let mut harness = brushes();
    click(&mut harness, "Add");
    click(&mut harness, "bright");
    assert_requests(&mut harness, &[take("bright", HeadShape::Bright, 6.0)]);
    assert_eq!(harness.state().tools.brush, "bright");

    click(&mut harness, "Rename");
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.event(Event::Text("for highlights".to_owned()));
    harness.key_press(Key::Enter);
    harness.run();
    assert!(harness.query_by_label("for highlights").is_some(), "its new name");
    assert_eq!(harness.state().tools.brush, "bright", "the painting keeps the old name");

    click(&mut harness, "Rename");
    harness.event(Event::Text(" never".to_owned()));
    harness.key_press(Key::Escape);
    harness.run();
    assert!(harness.query_by_label("for highlights").is_some(), "left as it was");

    click(&mut harness, "Remove");
    assert!(harness.query_by_label("for highlights").is_none(), "removed");
    assert_eq!(harness.state().tools.brush, "flat", "its neighbour is selected");
    click(&mut harness, "Remove");
    harness.run();
    assert!(
        harness.query_by_label("flat").is_none(),
        "removed from the list although the painting has it"
    );
    assert_requests(&mut harness, &[]);
}

#[test]
fn loading_uses_tube_or_medium_with_the_slider_values() {
    let mut harness = brushes();
    harness.state_mut().tools.tube = 4;
    harness.get_by_role_and_label(Role::Slider, "Load").set_value_accesskit(0.75);
    harness.get_by_role_and_label(Role::Slider, "Medium").set_value_accesskit(40.0);
    harness.run();
    click(&mut harness, "Load from tube");
    fn load(recipe: &[(&str, f64)], vehicle: f64) -> Request {
        let recipe = recipe.iter().map(|(name, part)| ((*name).to_owned(), *part)).collect();
        act(Action::Load(Load { brush: "round".to_owned(), recipe, vehicle, amount_mm: 0.75 }))
    }
    assert_requests(&mut harness, &[load(&[("Ultramarine", 1.0)], 0.4)]);
    harness.get_by_role_and_label(Role::Slider, "Medium").set_value_accesskit(99.5);
    harness.run();
    click(&mut harness, "Load from tube");
    assert_requests(&mut harness, &[load(&[("Ultramarine", 1.0)], 0.995)]);
    click(&mut harness, "Medium only");
    assert_requests(&mut harness, &[load(&[], 1.0)]);
    harness.state_mut().tools.tube = 7;
    harness.run();
    assert!(is_disabled(&harness, "Load from tube"), "slot 8 is empty");
}

#[test]
fn wiping_and_washing_need_paint() {
    let mut harness = brushes();
    harness.get_by_role_and_label(Role::Slider, "Wipe to").set_value_accesskit(55.0);
    harness.run();
    click(&mut harness, "Wipe");
    click(&mut harness, "Wash");
    let brush = "round".to_owned();
    let wipe = Action::Wipe { brush: brush.clone(), keep: 0.55 };
    assert_requests(&mut harness, &[act(wipe), act(Action::Wash { brush })]);
    click(&mut harness, "flat");
    assert!(is_disabled(&harness, "Wipe") && is_disabled(&harness, "Wash"), "it is clean");
    let table = harness.state_mut();
    table.with_panel(|_, cx| studio::panels::brushes::wash(cx));
    table.with_panel(|_, cx| studio::panels::brushes::wipe(cx));
    assert_requests(&mut harness, &[]);
}

#[test]
fn the_brush_list_follows_the_painting() {
    let mut harness = brushes();
    click(&mut harness, "knife");
    let state = &mut harness.state_mut().painting.brushes;
    let spec = BrushSpec { shape: HeadShape::Mop, size_mm: 20.0 };
    let mop = BrushState { name: "sky".to_owned(), spec, ..state[1].clone() };
    *state = vec![mop];
    harness.run();
    assert_eq!(harness.state().tools.brush, "sky", "the knife is gone");
    assert!(harness.query_by_label("knife").is_none(), "the knife is gone");
    assert!(is_disabled(&harness, "Remove"), "the last brush cannot be removed");
    harness.state_mut().painting.brushes.clear();
    harness.run();
    assert!(is_disabled(&harness, "Keep") && is_disabled(&harness, "Medium only"), "no brush");
}

#[test]
fn new_brushes_are_listed_in_the_order_of_their_shapes() {
    let mut reversed = painting();
    reversed.brushes.reverse();
    let harness = show_panel(Brushes::default(), reversed, Brushes::show);
    let tops = ["round", "flat", "knife"].map(|name| harness.get_by_label(name).rect().top());
    assert!(tops.is_sorted(), "{tops:?}");
}

#[test]
fn a_size_between_slider_steps_is_not_changed() {
    let mut odd = painting();
    odd.brushes[0].spec.size_mm = 6.123_456;
    let mut harness = show_panel(Brushes::default(), odd, Brushes::show);
    harness.run_steps(3);
    assert_requests(&mut harness, &[]);
}

#[test]
fn brushes_are_drawn() {
    let mut harness = brushes();
    let Some(drawn) = picture(&mut harness, "brushes") else { return };
    // The icon of the round brush has the colour of its paint.
    let row = harness.get_by_label("round").rect();
    let [red, green, blue] = harness.state().painting.brushes[0].color.unwrap();
    let at = drawn.get_pixel((row.left() + 36.0) as u32, (row.top() + 12.0) as u32).0;
    assert_eq!(at, [red, green, blue, 255]);
}

#[test]
fn the_swatch_tells_colour_thickness_and_hiding_of_what_the_brush_holds() {
    let mut harness = brushes();
    for words in ["Lab 47.2 52.1 38.4", "hides 62 %", "0.25 mm at the tip, 20 % medium"] {
        assert!(harness.query_by_label(words).is_some(), "{words}");
    }
    let rect = harness.get_by_label("Paint on the brush").rect();
    assert!(rect.height() >= 50.0 && rect.width() > 260.0, "{rect}");
    assert!(harness.query_by_label("Marks of the tip").is_some());
    if let Some(drawn) = picture(&mut harness, "brush-swatch") {
        let swatch = harness.state().painting.brushes[0].swatch.clone().unwrap();
        let middle = rect.center().y;
        for (share, y, [r, g, b], what) in [
            (0.25, middle, swatch.opaque.srgb, "the left half hides"),
            (0.6, middle, swatch.over_ground.srgb, "over the ground"),
            (0.6, rect.bottom() - 3.0, swatch.ground.srgb, "the bare ground"),
            (0.81, middle, swatch.over_cards[0].srgb, "over the black card"),
            (0.95, middle, swatch.over_cards[1].srgb, "over the white card"),
            (0.95, rect.top() + 3.0, swatch.cards[1].srgb, "the bare card"),
        ] {
            let x = rect.left() + share * rect.width();
            assert_eq!(drawn.get_pixel(x as u32, y as u32).0, [r, g, b, 255], "{what}");
        }
    }
    harness.state_mut().tools.brush = "flat".to_owned();
    harness.run();
    assert!(harness.query_by_label("hides 62 %").is_none(), "a clean brush has no colour");
    assert!(harness.query_by_label("Keep this mixture").is_none());
}

#[test]
fn what_the_brush_holds_is_kept_as_a_mixture() {
    let mut harness = brushes();
    click(&mut harness, "Keep this mixture");
    let requests = std::mem::take(&mut harness.state_mut().requests);
    let [Request::File(FileRequest::Swatches(SwatchChange::Keep(kept)))] = &requests[..] else {
        panic!("{requests:?}");
    };
    let recipe: Recipe = [("Zinc White", 0.25), ("Vermilion", 0.75)]
        .map(|(name, part)| (name.to_owned(), part))
        .into();
    assert_eq!((kept.name.as_str(), &kept.recipe), ("Vermilion and Zinc White", &recipe));
    assert!((kept.vehicle - 0.2).abs() < 1e-9, "{}", kept.vehicle);
    let painting = &harness.state().painting;
    let viewing = &painting.light.viewing;
    let wanted = painting.library.color(recipe, viewing).unwrap();
    assert_eq!(kept.color, wanted.hex());
    assert_eq!(kept.library, painting.library.title);
}

#[test]
fn the_mask_names_layers_as_the_layer_panel_does() {
    let mut painting = painting();
    painting.layers[1].name = "sky".to_owned();
    let mut stage =
        PanelWindow::new(Brushes::default(), vec2(300.0, 900.0), painting, Brushes::show);
    stage.state().tools.mode = Mode::Mask;
    stage.run();
    for (label, layer) in [("sky", LayerId(2)), ("Layer 1", LayerId(1))] {
        stage.click(label);
        let mask = Action::Mask(MaskChange::Layer(LayerRef::Id(layer)));
        let found = stage.commands();
        assert!(matches!(&found[..], [Command::Apply(found)] if *found == mask), "{found:?}");
    }
    // A long name stays inside the panel. The window checks this.
    stage.state().painting.layers[1].name = "the light over the trees at the far bank ".repeat(2);
    stage.run();
}

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

/// The sets of brushes that are stored in the home folder.
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
    let command = Command::Apply(Action::Load(load));
    window.studio_mut().ask(command);
    let options = BrushOptions { tilt: TiltUse::Fixed(40.0), ..BrushOptions::default() };
    window.studio_mut().files.preferences.set_options("round", options.clone());
    window.settle();
    window.click("with its paint");
    window.click("Keep brush");
    assert_eq!(names(&window), ["round"]);
    window.save("own-brushes");
    // The round brush of another painting is changed and clean, and has no options.
    let spec = BrushSpec { shape: HeadShape::Fan, size_mm: 20.0 };
    window.studio_mut().ask(Command::SetBrush { name: "round".to_owned(), spec });
    window.studio_mut().files.preferences.set_options("round", BrushOptions::default());
    let other = Load {
        brush: "round".to_owned(),
        recipe: [("Ultramarine".to_owned(), 1.0)].into(),
        vehicle: 0.0,
        amount_mm: 0.2,
    };
    window.studio_mut().ask(Command::Apply(Action::Load(other)));
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

/// Imports a file by typing its path in the browser.
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
    let is_reported =
        window.harness().query_by_label_contains("has no meaning here: hardness").is_some();
    assert!(is_reported, "nothing is dropped in silence");
    window.save("own-brushes-imported");

    std::fs::write(&ink, "{}").unwrap();
    import(&mut window, &ink);
    until(&mut window, "the problem", |window: &Window| window.shows("key `version`: is missing"));
}
