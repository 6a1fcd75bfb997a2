//! Every character that the window shows has a glyph in its fonts.

use std::collections::BTreeSet;

use eframe::egui::{FontFamily, FontId, Key, Modifiers, Role, Shape};
use egui_kittest::kittest::{NodeT, Queryable};
use session::Command;

use super::harness::Window;
use super::look::TABS;
use super::volumes::scene;

/// Texts that were drawn in the last frame, with the family of their font.
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

/// Checks what is shown now: drawn texts, and the names for screen readers. Returns the number of
/// texts.
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
    let lines = |window: &mut Window| {
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
    };
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
        // After the menu of this name.
        window.harness().get_all_by_label(tab).last().unwrap().click();
        window.harness().run_ok();
        check(&mut window, tab);
    }
}
