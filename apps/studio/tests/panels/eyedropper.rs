//! Tests of the eyedropper panel: shown values equal those of the libraries, and clicks
//! queue the right requests.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui::{Key, OutputCommand, Role, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use paint::document::Lighting;
use paint::layer::SLOTS;
use paint::strokes::{Action, SurfaceId};
use pigment::PigmentId;
use pigment::evaluate::Viewing;
use pigment::matching::{FilmKind, MatchRequest, RecipeMatch, Target, ViewingCondition, recipes};
use session::{Command, PaintingState, Picked, PickedLayer};
use spectra::color::{Adaptation, Lab, RgbSpace};
use spectra::{Illuminant, Observer};
use studio::panels::Mode;
use studio::panels::eyedropper::{Color, Eyedropper};
use studio::view::Outline;

use super::panel_window::{PanelWindow, made_painting};

fn stage(painting: PaintingState) -> PanelWindow<Eyedropper> {
    PanelWindow::new(Eyedropper::default(), vec2(300.0, 1000.0), painting, Eyedropper::show)
}

/// A pick of wet paint (three parts white, one part ultramarine) over dry yellow.
fn picked(painting: &PaintingState) -> Picked {
    let library = &painting.library;
    let find = |name: &str| library.find(name).unwrap();
    let layer = |label: &str, paint: &[(PigmentId, f64)], vehicle: f64| {
        let mut layer = PickedLayer {
            label: label.to_owned(),
            slots: [None; SLOTS],
            amounts_mm: [0.0; SLOTS + 1],
            opacity: 1.0,
        };
        for (slot, (pigment, amount)) in paint.iter().enumerate() {
            (layer.slots[slot], layer.amounts_mm[slot]) = (Some(*pigment), *amount);
        }
        layer.amounts_mm[SLOTS] = vehicle;
        layer
    };
    let white = find("Zinc White");
    let blue = find("Ultramarine");
    let mixture = library.mix([(white, 3.0), (blue, 1.0)]).unwrap();
    Picked {
        surface: SurfaceId::Canvas,
        x_mm: 103.24,
        y_mm: 54.11,
        reflectance: mixture.hiding(library.saunderson),
        layers: vec![
            layer("sunflowers", &[(find("Chrome Yellow"), 0.05)], 0.0),
            layer("Wet", &[(white, 0.06), (blue, 0.02)], 0.02),
        ],
    }
}

fn with_pick() -> PanelWindow<Eyedropper> {
    let painting = made_painting();
    let found = picked(&painting);
    let mut stage = stage(painting);
    stage.state().tools.picked = Some(Arc::new(found));
    stage.run();
    stage
}

#[test]
fn picked_values_equal_those_of_the_library() {
    let mut stage = with_pick();
    stage.save("eyedropper");
    let painting = &stage.state().painting;
    let light = Arc::clone(&painting.light);
    let picked = picked(painting);
    let weights = light.viewing.weights(painting.library.grid).unwrap();
    let xyz = weights.xyz(&picked.reflectance);
    let lab = Lab::from_xyz(xyz, weights.white());
    let srgb = RgbSpace::Srgb.encoded_from_xyz(xyz, weights.white(), Adaptation::Bradford).to_hex();
    let three = |values: [f64; 3]| values.map(|value| format!("{value:.2}")).join(" ");
    for text in [three(lab.to_array()), three(xyz.to_array()), srgb, "103.2, 54.1 mm".to_owned()] {
        assert!(stage.harness.query_by_label(&text).is_some(), "{text}");
    }
    for text in ["Wet", "0.100 mm, 20 % medium", "sunflowers", "0.050 mm", "     3"] {
        assert!(stage.harness.query_by_label(text).is_some(), "{text}");
    }
    assert_eq!(stage.harness.query_all_by_label("     1").count(), 2, "of blue and of yellow");
}

#[test]
fn picked_wet_paint_is_loaded_and_its_recipe_copied() {
    let mut stage = with_pick();
    stage.click("Load the brush");
    let wanted = picked(&stage.state().painting);
    let commands = stage.commands();
    let [Command::LoadPicked { brush, picked, amount_mm }] = &commands[..] else {
        panic!("{commands:?}");
    };
    assert_eq!((brush.as_str(), &**picked, *amount_mm), ("round", &wanted, 0.3));
    stage.harness.get_by_label("Copy Wet").click();
    stage.harness.step();
    // The text is copied in the frame of the release.
    let copied = stage.harness.output().platform_output.commands.clone();
    let wanted = "\"Zinc White=3\" \"Ultramarine=1\" --thickness 4".to_owned();
    assert_eq!(copied, [OutputCommand::CopyText(wanted)]);
    assert!(stage.commands().is_empty(), "copying sends nothing");
}

#[test]
fn dry_paint_cannot_be_loaded() {
    let mut stage = with_pick();
    let mut found = picked(&stage.state().painting);
    found.layers[1].amounts_mm = [0.0; SLOTS + 1];
    stage.state().tools.picked = Some(Arc::new(found));
    stage.run();
    let button = stage.harness.get_by_label("Load the brush");
    assert!(button.accesskit_node().is_disabled(), "there is no wet paint");
}

#[test]
fn the_eyedropper_button_toggles_the_tool() {
    let mut stage = stage(made_painting());
    stage.click("Eyedropper");
    assert_eq!(stage.state().tools.mode, Mode::Pick);
    stage.click("Eyedropper");
    assert_eq!(stage.state().tools.mode, Mode::Paint);
}

/// Recipes that the library search finds for the painting's palette in up to 40 parts.
fn library_recipes(
    painting: &PaintingState,
    target: &Target,
    conditions: Vec<ViewingCondition>,
) -> Vec<RecipeMatch> {
    let mut request = MatchRequest::new(&painting.library, conditions, FilmKind::Hiding);
    request.allowed = painting.slots.iter().copied().flatten().collect();
    request.allowed.sort_unstable();
    request.whole_parts = Some(40);
    request.count = 3;
    recipes(&painting.library, target, &request).unwrap()
}

fn conditions(painting: &PaintingState) -> Vec<ViewingCondition> {
    vec![ViewingCondition { viewing: painting.light.viewing.clone(), weight: 1.0 }]
}

fn ask(stage: &mut PanelWindow<Eyedropper>, text: &str) {
    stage.harness.get_by_role(Role::TextInput).focus();
    stage.run();
    stage.harness.get_by_role(Role::TextInput).type_text(text);
    stage.run();
    stage.harness.key_press(Key::Enter);
    stage.run();
}

/// Waits for the first recipe's button.
fn wait_for_recipes(stage: &mut PanelWindow<Eyedropper>) {
    for _ in 0..3000 {
        stage.harness.step();
        if stage.harness.query_by_label("Load recipe 1").is_some() {
            return stage.run();
        }
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    panic!("no recipe was found");
}

#[test]
fn a_typed_color_gets_the_recipes_of_the_library_search() {
    let mut stage = stage(made_painting());
    ask(&mut stage, "48,-4,-22");
    wait_for_recipes(&mut stage);
    stage.save("eyedropper-match");
    let painting = stage.state().painting.clone();
    let conditions = conditions(&painting);
    let lab = Lab { lightness: 48.0, a: -4.0, b: -22.0 };
    let wanted = library_recipes(&painting, &Target::from_lab("", lab, &conditions), conditions);
    assert_eq!(wanted.len(), 3);
    for recipe in &wanted {
        let text = format!("\u{2206}E {:.2}", recipe.delta_e[0]);
        assert!(stage.harness.query_by_label(&text).is_some(), "{text}");
    }
    for (index, recipe) in wanted.iter().enumerate() {
        let name = |at: usize| painting.library[recipe.shares.parts()[at].0].name.clone();
        let parts = recipe.parts.as_ref().unwrap();
        let all = parts.iter().enumerate().map(|(at, part)| (name(at), f64::from(*part)));
        let all = all.collect();
        stage.click(&format!("Load recipe {}", index + 1));
        let commands = stage.commands();
        let [Command::Apply(Action::Load(load))] = &commands[..] else { panic!("{commands:?}") };
        assert_eq!((&load.recipe, load.brush.as_str()), (&all, "round"));
        assert_eq!((load.vehicle, load.amount_mm), (0.15, 0.3));
        stage.click(&format!("Lay recipe {}", index + 1));
        let commands = stage.commands();
        let [Command::SqueezeInFreeSpace { recipe, vehicle, volume_mm3, places, reach_mm }] =
            &commands[..]
        else {
            panic!("{commands:?}");
        };
        assert_eq!((recipe, *vehicle, *volume_mm3), (&all, 0.15, 60.0));
        assert!(places.len() > 20, "{} places on a palette of 64 x 42 mm", places.len());
        for &[x, y] in places {
            for [right, down] in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]] {
                let edge = [x + right * reach_mm, y + down * reach_mm].map(|mm| mm / 0.1);
                assert!(Outline::Palette.contains(edge, (640, 420)), "{x}, {y} mm is on the wood");
            }
        }
    }
}

#[test]
fn a_recipe_is_added_to_the_paint_on_a_brush_as_a_tube_is() {
    let mut painting = made_painting();
    painting.brushes[0].amount_mm = 0.2;
    let mut stage = stage(painting);
    ask(&mut stage, "#808080");
    wait_for_recipes(&mut stage);
    stage.click("Load recipe 1");
    let commands = stage.commands();
    let [Command::Apply(Action::Load(load))] = &commands[..] else {
        panic!("{commands:?}");
    };
    assert_eq!(load.brush, "round");
}

#[test]
fn pigments_missing_on_the_palette_can_be_added() {
    let mut painting = made_painting();
    // Greens need a pigment that is not on the palette.
    painting.slots = [None; SLOTS];
    painting.slots[0] = Some(painting.library.find("Zinc White").unwrap());
    let mut stage = stage(painting);
    stage.click("Library");
    assert!(stage.commands().is_empty(), "there is no target yet");
    ask(&mut stage, "50,-30,5");
    wait_for_recipes(&mut stage);
    stage.save("eyedropper-missing");
    let load = stage.harness.get_by_label("Load recipe 1");
    assert!(load.accesskit_node().is_disabled(), "pigments are missing");
    let add = stage.harness.get_all_by_label_contains("Add ").next().unwrap();
    let name = add.accesskit_node().label().unwrap().replace("Add ", "");
    add.click();
    stage.run();
    let commands = stage.commands();
    let [Command::Apply(Action::Palette(palette))] = &commands[..] else { panic!("{commands:?}") };
    let names: Vec<&str> = palette.pigments.iter().map(|(_, name)| name.as_str()).collect();
    assert_eq!(names, ["Zinc White", &name]);
    let slots = [0, 1].map(|at| stage.state().painting.library.find(names[at]).ok());
    stage.state().painting.slots[..2].copy_from_slice(&slots);
    stage.run();
    let gone = stage.harness.query_by_label(&format!("Add {name}")).is_none();
    assert!(gone, "{name} is on the palette now");
}

#[test]
fn on_a_full_palette_a_pigment_replaces_an_unused_one() {
    let mut painting = made_painting();
    let library = Arc::clone(&painting.library);
    let green = library.find("Viridian").unwrap();
    let others: Vec<PigmentId> = library.ids().filter(|&pigment| pigment != green).collect();
    for (slot, pigment) in painting.slots.iter_mut().zip(&others) {
        *slot = Some(*pigment);
    }
    let full = painting.slots;
    let mut stage = stage(painting);
    stage.click("Library");
    // The target is pure Viridian.
    let mixture = library.mix([(green, 1.0)]).unwrap().hiding(library.saunderson);
    let light = Arc::clone(&stage.state().painting.light);
    let weights = light.viewing.weights(library.grid).unwrap();
    let [l, a, b] = Lab::from_xyz(weights.xyz(&mixture), weights.white()).to_array();
    ask(&mut stage, &format!("{l},{a},{b}"));
    wait_for_recipes(&mut stage);
    stage.harness.get_all_by_label("Viridian in place of").next().unwrap().click();
    stage.run();
    let first = library[full[7].unwrap()].name.clone();
    let entry = stage.harness.get_all_by_role_and_label(Role::Button, &first).last().unwrap();
    entry.click();
    stage.run();
    let commands = stage.commands();
    let [Command::Apply(Action::Palette(palette))] = &commands[..] else { panic!("{commands:?}") };
    let names: Vec<&str> = palette.pigments.iter().map(|(_, name)| name.as_str()).collect();
    let mut wanted: Vec<&str> =
        full.iter().map(|slot| library[slot.unwrap()].name.as_str()).collect();
    wanted[7] = "Viridian";
    assert_eq!(names, wanted);
}

#[test]
fn a_reference_color_starts_a_search_that_a_newer_one_replaces() {
    let mut stage = stage(made_painting());
    stage.state().tools.reference_color = Some([0.9, 0.05, 0.02]);
    stage.harness.step();
    stage.state().tools.reference_color = Some([0.18, 0.18, 0.18]);
    wait_for_recipes(&mut stage);
    let wanted = stage.state().panel.target().unwrap().clone();
    assert_eq!(wanted.color, Color::Screen([0.18; 3]));
    let painting = stage.state().painting.clone();
    let conditions = conditions(&painting);
    let target = wanted.match_target(painting.library.grid, &conditions);
    let best = library_recipes(&painting, &target, conditions);
    let text = format!("\u{2206}E {:.2}", best[0].delta_e[0]);
    assert!(stage.harness.query_by_label(&text).is_some(), "{text}, of the newer colour");
}

#[test]
fn a_picked_place_is_matched_under_both_lights_of_the_split_view() {
    let mut painting = made_painting();
    painting.second_lighting =
        Some(Lighting { illuminant: "A".to_owned(), ..painting.lighting.clone() });
    let found = picked(&painting);
    let mut stage = stage(painting);
    stage.state().tools.picked = Some(Arc::new(found));
    stage.run();
    stage.click("Find recipes");
    wait_for_recipes(&mut stage);
    let painting = stage.state().painting.clone();
    let mut conditions = conditions(&painting);
    let illuminant = Illuminant::named("A").unwrap();
    let viewing = Viewing { illuminant, observer: Observer::default() };
    conditions.push(ViewingCondition { viewing, weight: 1.0 });
    let wanted = stage.state().panel.target().unwrap().clone();
    let best = library_recipes(
        &painting,
        &wanted.match_target(painting.library.grid, &conditions),
        conditions,
    );
    // The search finds the mixture itself: three parts white and one part blue.
    assert_eq!(best[0].parts, Some(vec![3, 1]));
    assert!(best[0].delta_e.iter().all(|difference| *difference < 0.01), "{best:?}");
    assert!(stage.harness.query_by_label("\u{2206}E 0.00, 0.00").is_some(), "under both lights");
}

#[test]
fn a_search_can_be_cancelled() {
    let mut painting = made_painting();
    // A large library, so that the search takes long.
    let mut library = (*painting.library).clone();
    for copy in 0..3 {
        let others = painting.library.pigments.iter().cloned();
        library.pigments.extend(others.map(|mut pigment| {
            pigment.name = format!("{} {copy}", pigment.name);
            pigment
        }));
    }
    painting.library = Arc::new(library);
    let mut stage = stage(painting);
    stage.click("Library");
    stage.harness.get_by_role(Role::TextInput).focus();
    stage.run();
    stage.harness.get_by_role(Role::TextInput).type_text("#345678");
    stage.run();
    stage.harness.key_press(Key::Enter);
    stage.harness.step();
    assert!(stage.harness.query_by_label("Find recipes for it").is_none(), "the search is running");
    stage.click("Cancel");
    std::thread::sleep(std::time::Duration::from_millis(500));
    stage.run();
    assert!(stage.harness.query_by_label("Load recipe 1").is_none(), "no result is shown");
    assert!(
        stage.harness.query_by_label("Find recipes for it").is_some(),
        "a new search is possible"
    );
}

#[test]
fn an_invalid_color_text_shows_an_error_with_examples() {
    let mut stage = stage(made_painting());
    ask(&mut stage, "blue");
    let text = "A colour is #rrggbb or L,a,b, found `blue`; try #4a7d8c or 52,-10,8";
    assert!(stage.harness.query_by_label(text).is_some(), "the error is shown");
    assert_eq!(stage.state().panel.target(), None);
}

#[test]
fn swatches_of_other_programs_become_targets_by_a_click() {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("colours.gpl");
    std::fs::write(&path, "GIMP Palette\nName: two\n#\n 20 60 120 Sea\n200 180 90\tSand\n")
        .unwrap();
    assert!(Eyedropper::takes(&path), "GIMP palettes are accepted");
    let mut stage = stage(made_painting());
    stage.state().panel.open_swatches(&path);
    stage.run();
    stage.click("Sand");
    let wanted = stage.state().panel.target().unwrap();
    assert_eq!(wanted.name, "Sand");
    stage.state().panel.open_swatches(&path.with_file_name("gone.gpl"));
    stage.run();
    assert!(stage.harness.query_by_label_contains("gone.gpl").is_some(), "the error is shown");
}
