//! Tests of changed keys, and of windows over the canvas: closing them, menus, and strokes beside
//! them.

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers, Rect, pos2};
use egui_kittest::kittest::Queryable;
use paint::strokes::SurfaceId;
use session::volumes::Subject;
use studio::app::{Entry, Intent, SceneEntry, SceneIntent};
use studio::panels::Mode;

use super::harness::Window;
use super::look::drawn_texts;
use super::volumes::{scene, volumes, wait};

/// Clicks the button of a key in the window of keys, and presses a key for it.
fn press_for(window: &mut Window, chip: &str, modifiers: Modifiers, key: Key) {
    click(window, chip);
    window.key(modifiers, key);
}

/// Clicks a control of the list. This may scroll first.
fn click(window: &mut Window, label: &str) {
    window.harness().get_by_label(label).scroll_to_me();
    window.harness().run_ok();
    window.click(label);
}

fn keys_of<'a>(window: &'a Window, name: &str) -> Option<Vec<&'a str>> {
    let keys = window.studio().files.preferences.keys.get(name)?;
    Some(keys.iter().map(String::as_str).collect())
}

#[test]
fn a_changed_key_works_and_the_old_one_no_longer() {
    let mut window = Window::open("keys-changed");
    window.key(Modifiers::NONE, Key::F1);
    press_for(&mut window, "change M of Mirror", Modifiers::NONE, Key::J);
    assert!(!window.studio().canvas.view.mirror, "the press is the editor's");
    assert_eq!(keys_of(&window, "mirror"), Some(vec!["J"]));
    window.save("keys-changed");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(!window.studio().visible.keys, "Escape closes the window");
    window.key(Modifiers::NONE, Key::M);
    assert!(!window.studio().canvas.view.mirror, "the old key does nothing");
    window.key(Modifiers::NONE, Key::J);
    assert!(window.studio().canvas.view.mirror, "the new key mirrors");
    // Menus and tooltips show the new key.
    let context = window.harness().ctx.clone();
    assert_eq!(Entry::of(Intent::Mirror).unwrap().shortcut_text(&context), "J");
    assert_eq!(Entry::of(Intent::Dry).unwrap().shortcut_text(&context), "D");
    // If you remove the only key, none is left.
    window.key(Modifiers::NONE, Key::F1);
    click(&mut window, "remove D of Dry");
    assert_eq!(keys_of(&window, "dry"), Some(Vec::new()));
    assert_eq!(Entry::of(Intent::Dry).unwrap().shortcut_text(&context), "");
    click(&mut window, "standard keys of Dry");
    assert_eq!(keys_of(&window, "dry"), None);
}

#[test]
fn a_key_of_another_action_is_named_and_taken_only_if_wanted() {
    let mut window = Window::open("keys-conflict");
    window.key(Modifiers::NONE, Key::F1);
    press_for(&mut window, "change M of Mirror", Modifiers::NONE, Key::W);
    let message = "W is the key of Wash the brush.";
    assert!(window.harness().query_by_label(message).is_some(), "both are named");
    window.save("keys-conflict");
    window.click("Cancel");
    assert!(window.studio().files.preferences.keys.is_empty(), "nothing changed");
    press_for(&mut window, "add a key to Mirror", Modifiers::NONE, Key::W);
    window.click("Take it");
    assert_eq!(keys_of(&window, "mirror"), Some(vec!["M", "W"]));
    assert_eq!(keys_of(&window, "wash"), Some(Vec::new()));
    window.key(Modifiers::NONE, Key::W);
    assert!(window.studio().canvas.view.mirror, "W mirrors");
    // You cannot use reserved keys and see the reason. Escape leaves the key.
    press_for(&mut window, "change M of Mirror", Modifiers::NONE, Key::Space);
    let refused = window.harness().query_by_label_contains("the space bar moves the view");
    assert!(refused.is_some(), "you see the reason");
    press_for(&mut window, "change M of Mirror", Modifiers::NONE, Key::Escape);
    assert!(window.studio().visible.keys, "the window stays");
    assert_eq!(keys_of(&window, "mirror"), Some(vec!["M", "W"]));
    window.click("All to standard");
    assert!(window.studio().files.preferences.keys.is_empty(), "all are back");
}

#[test]
fn brushes_and_tools_can_have_other_keys() {
    let mut window = Window::open("keys-brushes");
    let second = {
        window.key(Modifiers::NONE, Key::Num2);
        window.studio().tools.brush.clone()
    };
    window.key(Modifiers::NONE, Key::Num1);
    assert_ne!(window.studio().tools.brush, second);
    let keys = &mut window.studio_mut().files.preferences.keys;
    keys.insert("brush-2".to_owned(), vec!["Shift+Q".to_owned()]);
    keys.insert("tool-zoom".to_owned(), vec!["Num2".to_owned(), "2".to_owned()]);
    window.key(Modifiers::NONE, Key::Num2);
    assert_ne!(window.studio().tools.brush, second, "2 is no longer its key");
    assert_eq!(window.studio().tools.mode, Mode::Zoom);
    window.key(Modifiers::SHIFT, Key::Q);
    assert_eq!(window.studio().tools.brush, second);
}

#[test]
fn sentences_name_the_changed_keys() {
    let mut window = Window::open("keys-sentences");
    let keys = &mut window.studio_mut().files.preferences.keys;
    keys.insert("wash".to_owned(), vec!["Shift+W".to_owned()]);
    keys.insert("wipe".to_owned(), Vec::new());
    window.harness().run_ok();
    window.studio_mut().handle_event(session::Event::DirtyBrush("round".to_owned()));
    let hint = window.studio().message().and_then(|message| message.hint.clone());
    assert_eq!(hint.as_deref(), Some("wash (Shift+W) or wipe it before another colour"));
}

#[test]
fn actions_are_found_by_a_word() {
    let mut window = Window::open("keys-find");
    window.key(Modifiers::NONE, Key::F1);
    assert!(window.harness().query_by_label("change Ctrl+S of Save").is_some(), "all are listed");
    window.harness().get_by_label("Find an action").focus();
    window.harness().step();
    window.frame(vec![Event::Text("mirror".to_owned())]);
    window.harness().run_ok();
    assert!(window.harness().query_by_label("change M of Mirror").is_some(), "it is found");
    assert!(window.harness().query_by_label("change Ctrl+S of Save").is_none(), "others are not");
}

#[test]
fn faults_of_the_preferences_are_told_and_unknown_names_kept() {
    let mut window = Window::open("keys-faults");
    let keys = &mut window.studio_mut().files.preferences.keys;
    keys.insert("fly".to_owned(), vec!["F".to_owned()]);
    window.harness().run_ok();
    let faults = window.harness().query_all_by_label_contains("`fly` is nothing").count();
    assert_eq!(faults, 1);
    window.key(Modifiers::NONE, Key::F1);
    press_for(&mut window, "change M of Mirror", Modifiers::NONE, Key::K);
    assert_eq!(keys_of(&window, "fly"), Some(vec!["F"]), "it is kept");
}

#[test]
fn scenes_have_keys_of_their_own() {
    let mut window = scene("keys-scenes");
    window.key(Modifiers::NONE, Key::F1);
    press_for(&mut window, "change H of Hatching", Modifiers::NONE, Key::M);
    assert_eq!(keys_of(&window, "scene.hatching"), Some(vec!["M"]), "M is free in scenes");
    window.save("keys-scenes");
    window.key(Modifiers::NONE, Key::Escape);
    let before = volumes(&window).state().unwrap().look.hatching;
    window.key(Modifiers::NONE, Key::M);
    wait(&mut window, "no hatching", move |volumes| {
        volumes.state().unwrap().look.hatching != before
    });
    let context = window.harness().ctx.clone();
    let entry = SceneEntry::of(SceneIntent::Hatching).unwrap();
    assert_eq!(entry.shortcut_text(&context), "M");
    assert_eq!(Entry::of(Intent::Mirror).unwrap().shortcut_text(&context), "M", "as before");
}

/// Whether a control with this label shows a tooltip that contains `words`.
fn has_tooltip_with(window: &mut Window, label: &str, words: &str) -> bool {
    let count = window.harness().query_all_by_label(label).count();
    (0..count).any(|index| {
        let control = window.harness().query_all_by_label(label).nth(index);
        control.expect("as many as before").hover();
        window.harness().run_steps(90);
        drawn_texts(window).iter().any(|(_, text)| text.contains(words))
    })
}

#[test]
fn tooltips_tell_the_keys_in_use() {
    let mut window = Window::open("keys-tips");
    let context = window.harness().ctx.clone();
    let keys = [
        ("reference-over", "F5"),
        ("scene.play", "F6"),
        ("scene.step", "F7"),
        ("scene.start", "F8"),
        ("scene.volumes", "Shift+F2"),
        ("scene.inside", "Shift+F3"),
    ];
    for (name, key) in keys {
        let own = vec![key.to_owned()];
        window.studio_mut().files.preferences.keys.insert(name.to_owned(), own);
    }
    let file = std::path::PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("keys-tips.png");
    image::RgbImage::new(30, 20).save(&file).unwrap();
    window.studio_mut().panels.reference.open(&context, &file);
    window.studio_mut().panels.reference.toggle_over_canvas();
    while !window.studio().panels.reference.is_over_canvas() {
        std::thread::sleep(std::time::Duration::from_millis(5));
        window.harness().step();
    }
    window.settle();
    assert!(has_tooltip_with(&mut window, "Over canvas", "to draw after (key F5). It is never"));
    window.studio_mut().open_scene(&context, Subject::Shape("village".to_owned()));
    wait(&mut window, "the first picture", |volumes| volumes.picture().is_some());
    for (label, words) in [
        ("From the start", "Goes to the start (key F8)"),
        ("Play", "Lets time run (key F6)"),
        ("Step", "1/120 s (key F7)"),
        ("Volumes", "grey drawing (key Shift+F2)"),
        ("Own", "own colours (key Shift+F3)"),
    ] {
        assert!(has_tooltip_with(&mut window, label, words), "{label}: {words}");
    }
}

/// Rectangle of the control with this label, if there is one.
fn shown(window: &mut Window, label: &str) -> Option<Rect> {
    window.harness().query_by_label(label).map(|node| node.rect())
}

/// Texts that you see only while a certain window is open: the table of keys, the tubes' window,
/// and the exchange of pigments.
const KEYS: &str = "Alt + click";
const TUBES: &str = "Take off";
const EXCHANGE: &str = "exchange";

#[test]
fn escape_closes_the_topmost_window_first() {
    let mut window = Window::open("floating");
    window.click("Tubes...");
    assert!(shown(&mut window, TUBES).is_some(), "the tubes are open");
    window.key(Modifiers::NONE, Key::F1);
    assert!(shown(&mut window, KEYS).is_some(), "the keys are open, over the tubes");
    window.save("floating");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(shown(&mut window, KEYS).is_none(), "the keys were on top");
    assert!(shown(&mut window, TUBES).is_some(), "the tubes stay");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(shown(&mut window, TUBES).is_none(), "the tubes are closed");

    let studio = window.studio_mut();
    let tube = "tube of Vermilion";
    studio.tools.tube = 3;
    window.harness().get_by_label(tube).click_secondary();
    window.harness().run_ok();
    window.click("Exchange in the painting...");
    assert!(shown(&mut window, EXCHANGE).is_some(), "the exchange is open");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(shown(&mut window, EXCHANGE).is_none(), "the exchange is closed");
}

#[test]
fn escape_closes_the_windows_of_the_pen_and_of_own_brushes() {
    let mut window = Window::open("floating-pen");
    let open = |window: &Window| [window.studio().visible.pen, window.studio().visible.brush_sets];
    window.studio_mut().visible.pen = true;
    window.harness().run_ok();
    window.studio_mut().visible.brush_sets = true;
    window.settle();
    window.key(Modifiers::NONE, Key::F1);
    assert!(shown(&mut window, KEYS).is_some(), "the keys lie over both");
    window.key(Modifiers::NONE, Key::Escape);
    assert_eq!((shown(&mut window, KEYS), open(&window)), (None, [true, true]), "the keys first");
    window.key(Modifiers::NONE, Key::Escape);
    assert_eq!(open(&window), [true, false], "the own brushes were opened after the pen");
    window.key(Modifiers::NONE, Key::Escape);
    assert_eq!(open(&window), [false, false]);
}

#[test]
fn the_windows_of_the_pen_and_of_own_brushes_stay_off_the_menus_and_close_them() {
    let mut window = Window::open("floating-pen-menus");
    for (opens, field) in [(true, "Clear"), (false, "Keep brush")] {
        window.click("File");
        assert!(is_listed(&mut window), "the menu is open");
        let visible = &mut window.studio_mut().visible;
        (visible.pen, visible.brush_sets) = (opens, !opens);
        window.settle();
        assert!(!is_listed(&mut window), "{field}: the window closed the menu");
        let bar = window.harness().get_by_role_and_label(Role::Button, "File").rect();
        let rect = shown(&mut window, field).unwrap();
        assert!(rect.top() > bar.bottom() + 20.0, "{field}: {rect} is below the menu bar");
    }
}

#[test]
fn escape_in_the_name_of_a_set_leaves_the_window_open() {
    let mut window = Window::open("floating-name");
    window.studio_mut().visible.brush_sets = true;
    window.settle();
    window.click("New set");
    assert!(shown(&mut window, "Name of the set").is_some(), "a name is typed");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(shown(&mut window, "Name of the set").is_none(), "Escape cancels the name");
    assert!(window.studio().visible.brush_sets, "and closes nothing");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(!window.studio().visible.brush_sets, "the second one closes the window");
}

/// Whether the menu of files is open. The list of keys contains this name too, but not on a button.
fn is_listed(window: &mut Window) -> bool {
    window.harness().query_by_role_and_label(Role::Button, "Save recording...").is_some()
}

/// Clicks a menu of the bar. The list of keys has headings of the same name.
fn click_menu(window: &mut Window, name: &str) {
    window.harness().get_by_role_and_label(Role::Button, name).click();
    window.harness().step();
    window.harness().run_ok();
}

#[test]
fn a_window_leaves_the_menus_free_and_closes_the_one_that_is_open() {
    let mut window = Window::open("floating-menus");
    window.click("File");
    assert!(is_listed(&mut window), "the menu is open");
    // The menu gets this Escape.
    window.click("Tubes...");
    window.key(Modifiers::NONE, Key::F1);
    click_menu(&mut window, "File");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(!is_listed(&mut window), "Escape closes the menu");
    assert!(shown(&mut window, KEYS).is_some(), "and only the menu");
    window.key(Modifiers::NONE, Key::Escape);
    click_menu(&mut window, "File");
    window.key(Modifiers::NONE, Key::F1);
    assert!(!is_listed(&mut window), "the keys closed the menu");
    let bar = window.harness().get_by_role_and_label(Role::Button, "File").rect();
    let toolbar = window.harness().get_by_role_and_label(Role::Button, "Paint").rect();
    for label in ["Keys", "Choose tubes"] {
        // The last one is the title. The menus and buttons come before.
        let title = window.harness().get_all_by_label(label).last().unwrap().rect();
        assert!(title.top() > bar.bottom() && title.left() > toolbar.right(), "{label}: {title}");
    }
}

#[test]
fn a_stroke_beside_a_window_reaches_the_canvas() {
    let mut window = Window::open("floating-stroke");
    window.key(Modifiers::NONE, Key::F1);
    window.click("Tubes...");
    window.settle();
    let done = window.studio().painting().unwrap().history_done;
    let canvas = window.studio().canvas.rect();
    let right = window.point(SurfaceId::Canvas, 31.0, 10.0).min(canvas.right_bottom());
    let along: Vec<_> =
        (0..12).map(|at| right - eframe::egui::vec2(4.0 * at as f32, 0.0)).collect();
    window.pen_stroke(&along);
    window.settle();
    let painted = window.studio().painting().unwrap().history_done;
    assert_eq!(painted, done + 1, "the stroke was painted");
    // You cannot paint on the window itself.
    let inside = shown(&mut window, KEYS).unwrap().center();
    window.pen_stroke(&[inside, pos2(inside.x + 9.0, inside.y)]);
    window.settle();
    assert_eq!(window.studio().painting().unwrap().history_done, painted, "the window is in front");
}
