//! Tests of themes, touch targets, scale and glyphs, also in windows, dialogs and bars over the
//! canvas.

use std::collections::BTreeSet;

use eframe::egui::{FontFamily, FontId, Key, Modifiers, Rect, Role, Shape, Theme, Vec2, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use image::RgbaImage;
use paint::strokes::{Action, Squeeze, SurfaceId};
use session::Command;
use session::volumes::Subject;
use studio::app::{CropTool, Tab};
use studio::panels::Mode;
use studio::theme::{self, ThemeChoice, contrast};

use super::fixture::{SeenText, Target, targets, texts};
use super::harness::Window;
use super::volumes::scene;

pub(super) const TABS: [Tab; 8] = [
    Tab::Brush,
    Tab::Layers,
    Tab::Light,
    Tab::Color,
    Tab::Wheel,
    Tab::Swatches,
    Tab::History,
    Tab::Files,
];

const SIZES: [Vec2; 3] = [vec2(1280.0, 800.0), vec2(1440.0, 1000.0), vec2(1920.0, 1080.0)];

/// Themes, and whether the window is in touch mode.
const LOOKS: [(ThemeChoice, bool); 4] = [
    (ThemeChoice::Dark, false),
    (ThemeChoice::Light, false),
    (ThemeChoice::Dark, true),
    (ThemeChoice::Light, true),
];

pub(super) fn set_look(window: &mut Window, (theme, touch): (ThemeChoice, bool)) {
    let preferences = &mut window.studio_mut().files.preferences;
    (preferences.theme, preferences.touch_targets) = (theme, touch);
    window.harness().step();
    window.harness().run_ok();
}

fn show(window: &mut Window, tab: Tab) {
    window.studio_mut().panels.select(tab);
    window.harness().step();
    window.harness().run_ok();
}

fn seen(window: &mut Window) -> Vec<SeenText> {
    texts(window.harness().output())
}

pub(super) fn cut(window: &mut Window) -> Vec<String> {
    let cut = seen(window).into_iter().filter(SeenText::is_cut);
    cut.map(|text| format!("{} at {:?}", text.words, text.rect)).collect()
}

#[test]
fn no_text_of_the_window_is_cut_in_any_size_theme_or_panel() {
    for size in SIZES {
        let mut window = Window::sized("cut", size, 1.0);
        for look in LOOKS {
            set_look(&mut window, look);
            for tab in TABS {
                show(&mut window, tab);
                let cut = cut(&mut window);
                assert!(cut.is_empty(), "{size} {look:?} {tab:?}: {cut:#?}");
                let mut beyond = targets(&window.harness().root());
                beyond.retain(|target| target.right > size.x - 2.0);
                assert!(beyond.is_empty(), "{size} {look:?} {tab:?}: {beyond:#?}");
            }
            show(&mut window, Tab::Brush);
            window.show(&format!("look-{}-{:?}-{}", size.x, look.0, look.1));
        }
    }
}

#[test]
fn a_long_name_of_brush_or_pigment_is_not_cut() {
    let mut window = Window::open("long-names");
    window.click("Rename");
    let field = window.harness().get_by_label("Name of the brush");
    field.type_text(" for the thin branches at the edge");
    window.harness().key_press(Key::Enter);
    window.harness().run_ok();
    let names = seen(&mut window);
    let brush = names.iter().find(|text| text.words.contains("branches")).unwrap();
    let tube = names.iter().find(|text| text.words == "Chrome Yellow (Otero)").unwrap();
    window.save("long-names");
    assert!(brush.is_wholly_seen() && tube.is_wholly_seen(), "{brush:#?} {tube:#?}");
}

#[test]
fn the_brush_panel_is_whole_in_a_window_of_a_thousand_points() {
    let labels = ["Rename", "shape round", "Load from tube", "Medium only", "Wipe", "Wash"];
    for size in [vec2(1440.0, 1000.0), vec2(1920.0, 1080.0)] {
        let mut window = Window::sized("whole-brush-panel", size, 1.0);
        for look in LOOKS {
            set_look(&mut window, look);
            // The spectral curve makes room for any panel that was used last.
            show(&mut window, Tab::Light);
            show(&mut window, Tab::Brush);
            let heads = ["Fold Light", "Unfold Light"];
            let bottom = heads
                .into_iter()
                .find_map(|name| Some(window.harness().query_by_label(name)?.rect().top()))
                .unwrap();
            window.show(&format!("brush-panel-{look:?}-{}", size.y));
            for label in labels {
                let rect = window.harness().get_by_label(label).rect();
                assert!(rect.bottom() <= bottom, "{label} of {look:?} in {size}: {rect}");
            }
            let tops =
                ["Wipe", "Wash"].map(|name| window.harness().get_by_label(name).rect().top());
            assert_eq!(tops[0], tops[1], "a button stands alone: {look:?} in {size}");
            let names = seen(&mut window);
            let knife = names.iter().find(|text| text.words == "knife").unwrap();
            assert!(knife.is_wholly_seen(), "{knife:?}");
        }
    }
}

#[test]
fn the_marks_of_the_tip_are_whole_in_a_window_of_eight_hundred_points() {
    let mut window = Window::sized("whole-tip", SIZES[0], 1.0);
    for look in [(ThemeChoice::Dark, false), (ThemeChoice::Light, false)] {
        set_look(&mut window, look);
        show(&mut window, Tab::Brush);
        // If there is paint, numbers stand above. If not, the panel is shorter, and Light stays
        // open.
        for key in [Key::D, Key::W] {
            window.click("Load brush");
            window.key(Modifiers::NONE, key);
            window.settle();
            let [tip, below] = ["Marks of the tip", "Fold Light"]
                .map(|label| window.harness().get_by_label(label).rect());
            window.show(&format!("whole-tip-{key:?}"));
            assert!(tip.bottom() < below.top(), "{look:?} {key:?}: {tip} {below}");
        }
        // The settings of a tool replace the numbers of the film.
        window.click("Load brush");
        for mode in [Mode::Blend, Mode::Scrape, Mode::Erase] {
            window.studio_mut().tools.mode = mode;
            window.settle();
            let tip = window.harness().get_by_label("Marks of the tip").rect();
            let below = window.harness().get_by_label("Fold Light").rect();
            window.show(&format!("whole-tip-{mode:?}"));
            assert!(tip.bottom() < below.top(), "{look:?} {mode:?}: {tip} {below}");
        }
        window.studio_mut().tools.mode = Mode::Paint;
    }
}

#[test]
fn words_stand_in_the_middle_of_high_buttons() {
    let mut window = Window::sized("high-buttons", SIZES[0], 1.0);
    set_look(&mut window, (ThemeChoice::Dark, true));
    window.key(Modifiers::COMMAND, Key::Comma);
    window.settle();
    let button = window.harness().get_by_label("Close").rect();
    let words = seen(&mut window).into_iter().find(|text| text.words == "Close").unwrap();
    window.save("high-buttons");
    let off = (words.rect.center() - button.center()).length();
    assert!(off < 2.0, "{} in {button}", words.rect);
}

#[test]
fn palette_and_tubes_grow_with_the_window() {
    let [small, large] = [SIZES[0], SIZES[2]].map(|size| {
        let mut window = Window::sized("growing", size, 1.0);
        ["Palette", "tube of Vermilion"]
            .map(|label| window.harness().get_by_label(label).rect().size())
    });
    assert!(large[0].y > 1.25 * small[0].y, "the palette: {small:?} {large:?}");
    assert!(large[1].y > 1.25 * small[1].y, "the tubes: {small:?} {large:?}");
}

/// The most frequent colour of a rectangle.
fn background(picture: &RgbaImage, rect: Rect) -> [u8; 3] {
    let mut counts: std::collections::BTreeMap<[u8; 3], usize> = std::collections::BTreeMap::new();
    for y in rect.top().max(0.0) as u32..(rect.bottom() as u32).min(picture.height()) {
        for x in rect.left().max(0.0) as u32..(rect.right() as u32).min(picture.width()) {
            let [red, green, blue, _] = picture.get_pixel(x, y).0;
            *counts.entry([red, green, blue]).or_default() += 1;
        }
    }
    counts.into_iter().max_by_key(|(_, count)| *count).map_or([0; 3], |(color, _)| color)
}

#[test]
fn all_text_on_the_screen_has_a_contrast_of_seven() {
    for theme in [ThemeChoice::Dark, ThemeChoice::Light] {
        let mut window = Window::sized("contrast", vec2(1440.0, 1000.0), 1.0);
        window.studio_mut().tools.figures = true;
        set_look(&mut window, (theme, false));
        let mut read = 0;
        for tab in TABS {
            show(&mut window, tab);
            let Some(picture) = window.picture() else { return };
            window.save(&format!("contrast-{theme:?}-{tab:?}"));
            let shown = seen(&mut window).into_iter();
            // Disabled text is translucent.
            for text in shown.filter(|text| text.is_wholly_seen() && text.color.is_opaque()) {
                let [red, green, blue] = background(&picture, text.rect.expand(1.0));
                let behind = eframe::egui::Color32::from_rgb(red, green, blue);
                let found = contrast(text.color, behind);
                assert!(found >= 7.0, "{theme:?} {tab:?}: {} {found} on {behind:?}", text.words);
                read += 1;
            }
        }
        assert!(read > 200, "{read} lines of text were read");
    }
}

/// Controls that may be smaller than a finger, with the reason.
const SMALLER: [(&str, &str); 4] = [
    ("Close window", "the window's own button; Escape and a click elsewhere close it too"),
    ("Height of ", "edges are dragged, not clicked; folding does without them"),
    ("Width of ", "edges are dragged, not clicked; the usual width does without them"),
    ("Target colour", "it shows a colour and does nothing when it is clicked"),
];

/// All controls that are smaller than a finger.
pub(super) fn small(window: &mut Window) -> Vec<Target> {
    let all = targets(&window.harness().root());
    assert!(all.len() > 20, "{} targets", all.len());
    let least = theme::TOUCH_TARGET - 0.5;
    all.into_iter()
        .filter(|target| {
            (target.size.x < least || target.size.y < least)
                && !SMALLER.iter().any(|(name, _)| target.name.starts_with(name))
        })
        .collect()
}

#[test]
fn everything_that_is_touched_is_44_points_wide_and_high() {
    let mut window = Window::sized("touch", vec2(1440.0, 1000.0), 1.0);
    let recipe = [("Vermilion".to_owned(), 1.0)].into();
    let on = SurfaceId::Canvas;
    let x_mm = 16.0;
    let y_mm = 10.0;
    let heap = Squeeze { on, recipe, vehicle: 0.0, x_mm, y_mm, volume_mm3: 30.0 };
    for action in [Action::Squeeze(heap), Action::Dry { fraction: 1.0 }] {
        window.studio_mut().ask(Command::Apply(action));
    }
    let mut layers = 0;
    // On a busy machine this picture comes after the answers.
    for _ in 0..20 {
        window.settle();
        layers = window.studio().painting().map_or(0, |p| p.layers.len());
        if layers > 0 {
            break;
        }
    }
    assert_eq!(layers, 1, "a layer with its eye");
    let usual = small(&mut window).len();
    assert!(usual > 20, "the usual density is kept: {usual} small targets");
    set_look(&mut window, (ThemeChoice::Dark, true));
    for tab in TABS {
        show(&mut window, tab);
        let small = small(&mut window);
        assert!(small.is_empty(), "{tab:?}: {small:#?}");
    }
    for (opener, entry) in [("File", "Save"), ("View", "Upright"), ("Tubes...", "Take off")] {
        window.open_menu(opener);
        assert!(window.harness().query_by_label(entry).is_some(), "{opener} is open");
        let small = small(&mut window);
        assert!(small.is_empty(), "{opener}: {small:#?}");
        window.show(&format!("touch-{opener}"));
        window.key(Modifiers::NONE, Key::Escape);
    }
}

#[test]
fn scenes_have_the_same_theme_and_targets() {
    let mut window = Window::open("scene-look");
    let context = window.harness().ctx.clone();
    window.studio_mut().open_scene(&context, Subject::Shape("village".to_owned()));
    super::volumes::wait(&mut window, "the first picture", |scene| scene.picture().is_some());
    set_look(&mut window, (ThemeChoice::Light, true));
    assert_eq!(context.theme(), Theme::Light);
    window.save("scene-look");
    for name in ["View", "Light", "Here", "Events", "Export"] {
        let tabs = window.harness().query_all_by_label(name);
        let tab = tabs.max_by(|a, b| a.rect().top().total_cmp(&b.rect().top())).unwrap();
        tab.click();
        window.harness().step();
        let small = small(&mut window);
        assert!(small.is_empty(), "{name}: {small:#?}");
        let cut = cut(&mut window);
        assert!(cut.is_empty(), "{name}: {cut:#?}");
    }
    assert!(window.harness().query_by_label("tube of Zinc White").is_some());
    window.click("Fold Tubes");
    assert!(window.harness().query_by_label("tube of Zinc White").is_none(), "they are folded");
    window.click("Unfold Tubes");
    assert!(window.harness().query_by_label("tube of Zinc White").is_some());
}

#[test]
fn the_menu_changes_theme_targets_and_scale_at_once() {
    let mut window = Window::open("look-menu");
    fn choose(window: &mut Window, entry: &str) {
        window.open_menu("View");
        let entry = window.harness().query_all_by_label_contains(entry).last();
        // The entry may be out of view.
        entry.expect("an entry of the menu").click_accesskit();
        window.harness().step();
        window.harness().run_ok();
    }
    choose(&mut window, "Light theme");
    assert_eq!(window.harness().ctx.theme(), Theme::Light);
    choose(&mut window, "Dark theme");
    assert_eq!(window.harness().ctx.theme(), Theme::Dark);
    choose(&mut window, "Large targets for touch");
    assert!(theme::is_touch(&window.harness().ctx));
    choose(&mut window, "Large targets for touch");
    assert!(!theme::is_touch(&window.harness().ctx));
    choose(&mut window, "Larger interface");
    assert_eq!(window.studio().files.preferences.interface_scale, 1.1);
    choose(&mut window, "Smaller interface");
    assert_eq!(window.studio().files.preferences.interface_scale, 1.0);
}

#[test]
fn nothing_is_cut_at_any_scale_of_any_screen() {
    for pixels in [vec2(1280.0, 800.0), vec2(1920.0, 1080.0), vec2(3840.0, 2160.0)] {
        for preferred in [0.75, 1.25, 2.0, 3.0] {
            let scale = theme::scale_in_window(preferred, pixels);
            let mut window = Window::sized("scale", pixels / scale, 1.0);
            for tab in [Tab::Brush, Tab::Light, Tab::Color] {
                show(&mut window, tab);
                let cut = cut(&mut window);
                let scaled = format!("scale-{}-{preferred}-{tab:?}", pixels.x);
                window.show(&scaled);
                assert!(cut.is_empty(), "{pixels} at {preferred}, {tab:?}: {cut:#?}");
            }
            show(&mut window, Tab::Brush);
            let whole = window.whole();
            for label in ["File", "Canvas", "Paint", "Rename", "tube of Vermilion"] {
                let rect = window.harness().get_by_label(label).rect();
                assert!(whole.contains_rect(rect), "{label} at {rect} of {whole}");
            }
        }
    }
}

/// A window over the canvas: its name, a label that you see while it is open, and how to open it.
type Over = (&'static str, &'static str, fn(&mut Window));

const OVER: [Over; 7] = [
    ("Pen", "Pressure curve", |window| window.studio_mut().visible.pen = true),
    ("Own brushes", "New set", |window| window.studio_mut().visible.brush_sets = true),
    ("Keys", "All to standard", |window| window.key(Modifiers::NONE, Key::F1)),
    ("New", "Begin", |window| window.key(Modifiers::COMMAND, Key::N)),
    ("browser", "Grid", |window| window.key(Modifiers::COMMAND, Key::O)),
    ("quick palette", "quick Vermilion", |window| window.key(Modifiers::NONE, Key::C)),
    ("crop", "Shape of the crop", |window| {
        window.studio_mut().crop = Some(CropTool::new((320, 200)));
    }),
];

/// Opens a window over the canvas and waits until it has read its files.
fn open(window: &mut Window, (name, label, opens): Over) {
    opens(window);
    window.settle();
    let is_open = window.harness().query_all_by_label_contains(label).next().is_some();
    assert!(is_open, "{name} is open");
}

fn close(window: &mut Window, (name, label, _): Over) {
    window.key(Modifiers::NONE, Key::Escape);
    window.settle();
    let is_open = window.harness().query_all_by_label_contains(label).next().is_some();
    assert!(!is_open, "Escape closes {name}");
}

#[test]
fn no_text_of_a_window_over_the_canvas_is_cut_in_any_look() {
    let mut window = Window::sized("cut-over", vec2(1280.0, 800.0), 1.0);
    for look in [(ThemeChoice::Dark, false), (ThemeChoice::Light, true)] {
        set_look(&mut window, look);
        for over in OVER {
            open(&mut window, over);
            window.show(&format!("over-{}-{look:?}", over.0));
            let cut = cut(&mut window);
            assert!(cut.is_empty(), "{} {look:?}: {cut:#?}", over.0);
            close(&mut window, over);
        }
    }
}

#[test]
fn everything_that_is_touched_over_the_canvas_is_44_points_wide_and_high() {
    let mut window = Window::sized("touch-over", vec2(1440.0, 1000.0), 1.0);
    set_look(&mut window, (ThemeChoice::Dark, true));
    for over in OVER {
        open(&mut window, over);
        let small = small(&mut window);
        assert!(small.is_empty(), "{}: {small:#?}", over.0);
        close(&mut window, over);
    }
}

#[test]
fn every_character_over_the_canvas_has_a_glyph() {
    let mut window = Window::open("glyphs-over");
    for over in OVER {
        open(&mut window, over);
        check(&mut window, over.0);
        close(&mut window, over);
    }
}

/// Collects the texts of the last frame, with the family of their font.
fn drawn(shape: &Shape, texts: &mut BTreeSet<(FontFamily, String)>) {
    match shape {
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| drawn(shape, texts)),
        Shape::Text(text) => {
            for section in &text.galley.job.sections {
                let words = text.galley.job.text
                    [section.byte_range.start.0..section.byte_range.end.0]
                    .to_owned();
                texts.insert((section.format.font_id.family.clone(), words));
            }
        }
        _ => {}
    }
}

/// Texts that the window draws now, with the family of their font.
pub(super) fn drawn_texts(window: &mut Window) -> BTreeSet<(FontFamily, String)> {
    window.harness().step();
    let mut texts = BTreeSet::new();
    for clipped in &window.harness().output().shapes {
        drawn(&clipped.shape, &mut texts);
    }
    texts
}

/// Checks all drawn texts and all names for screen readers. Returns the number of texts.
pub(super) fn check(window: &mut Window, place: &str) -> usize {
    let mut texts = drawn_texts(window);
    let nodes = window.harness().query_all_by(|_| true);
    let named: Vec<String> = nodes
        .flat_map(|node| [node.accesskit_node().label(), node.accesskit_node().value()])
        .flatten()
        .collect();
    texts.extend(named.into_iter().map(|name| (FontFamily::Proportional, name)));
    let context = window.harness().ctx.clone();
    for (family, text) in &texts {
        for letter in text.chars().filter(|letter| !letter.is_control()) {
            let font = FontId::new(13.0, family.clone());
            let found = context.fonts_mut(|fonts| fonts.has_glyph(&font, letter));
            assert!(found, "{letter:?} of {text:?} has no glyph, {place}");
        }
    }
    texts.len()
}

fn check_menus(window: &mut Window) {
    let without = check(window, "without a menu");
    for menu in ["File", "Edit", "View", "Tools", "Help"] {
        window.harness().get_all_by_label(menu).next().unwrap().click();
        window.harness().run_ok();
        let texts = check(window, menu);
        assert!(texts > without, "{texts} texts with the menu {menu}, {without} without");
        window.key(Modifiers::NONE, Key::Escape);
    }
}

#[test]
fn a_chosen_entry_has_a_tick_that_is_drawn() {
    let mut window = Window::open("ticks");
    fn lines(window: &mut Window) -> (usize, String) {
        window.harness().get_all_by_label("View").next().unwrap().click();
        window.harness().run_ok();
        let entry = window.harness().get_by_role_and_label(Role::CheckBox, "Mirror");
        let chosen = entry.accesskit_node().toggled();
        let rect = entry.rect();
        let shapes = &window.harness().output().shapes;
        let ticks = shapes.iter().filter(|clipped| {
            let within = rect.contains_rect(clipped.shape.visual_bounding_rect());
            matches!(clipped.shape, Shape::Path(_)) && within
        });
        let found = (ticks.count(), format!("{chosen:?}"));
        window.key(Modifiers::NONE, Key::Escape);
        found
    }
    let plain = lines(&mut window);
    window.key(Modifiers::NONE, Key::M);
    let ticked = lines(&mut window);
    assert_eq!((plain.0, ticked.0), (0, 1), "{plain:?} {ticked:?}");
    assert!(ticked.1.contains("True"), "screen readers know it: {ticked:?}");
}

#[test]
fn every_character_of_menus_and_panels_has_a_glyph() {
    let mut window = Window::open("glyphs");
    window.studio_mut().canvas.view.mirror = true;
    window.studio_mut().ask(Command::SetSecondLight(Some(Default::default())));
    window.settle();
    check_menus(&mut window);
    for tab in TABS {
        window.studio_mut().panels.select(tab);
        window.settle();
        check(&mut window, tab.name());
    }
    window.key(Modifiers::NONE, Key::F1);
    assert!(check(&mut window, "the table of keys") > 60, "it is open");
}

#[test]
fn every_character_of_the_workspace_of_scenes_has_a_glyph() {
    let mut window = scene("glyphs-of-scenes");
    check_menus(&mut window);
    for tab in ["View", "Light", "Here", "Events", "Export"] {
        // This label stands after the menu of the same name.
        window.harness().get_all_by_label(tab).last().unwrap().click();
        window.harness().run_ok();
        check(&mut window, tab);
    }
}
