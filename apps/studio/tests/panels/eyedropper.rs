//! Tests of the panels of colours (eyedropper, wheel and swatches). Shown values must equal the
//! libraries' values, and clicks must queue the right requests.

use std::path::PathBuf;
use std::sync::Arc;

use documents::Task;
use eframe::egui::{Key, OutputCommand, Role, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use paint::document::Lighting;
use paint::layer::SLOTS;
use paint::strokes::{Action, PaletteSpec, Recipe, SurfaceId};
use pigment::PigmentId;
use pigment::evaluate::Viewing;
use pigment::matching::{FilmKind, RecipeLimits, RecipeMatch, Target, ViewingCondition, recipes};
use session::swatches::{KeptMixture, SwatchBook, SwatchChange};
use session::{Command, PaintingState, Picked, PickedLayer};
use spectra::color::{Adaptation, Lab, RgbSpace};
use spectra::{Illuminant, Observer};
use studio::files::SwatchFormat;
use studio::panels::eyedropper::{Color, Eyedropper, TargetColor};
use studio::panels::swatches::Swatches;
use studio::panels::wheel::{Plane, Wheel};
use studio::panels::{FileRequest, Mode, Request};
use studio::view::Outline;
use studio::wheel_maker::WheelRequest;
use web_time::{Duration, Instant};

use super::fixture::{
    Fixture, PIGMENTS, PanelWindow, assert_requests, click, is_disabled, made_painting, painting,
    picture, show_panel,
};
use super::harness::Window;

fn stage(painting: PaintingState) -> PanelWindow<Eyedropper> {
    PanelWindow::new(Eyedropper::default(), vec2(300.0, 1000.0), painting, Eyedropper::show)
}

/// A pick of wet paint (three parts white, one part ultramarine) over dry yellow.
fn picked(painting: &PaintingState) -> Picked {
    let library = &painting.library;
    let [white, blue, yellow] =
        ["Zinc White", "Ultramarine", "Chrome Yellow"].map(|name| library.find(name).unwrap());
    fn layer(label: &str, paint: &[(PigmentId, f64)], vehicle: f64) -> PickedLayer {
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
    }
    let mixture = library.mix([(white, 3.0), (blue, 1.0)]).unwrap();
    Picked {
        surface: SurfaceId::Canvas,
        x_mm: 103.24,
        y_mm: 54.11,
        reflectance: mixture.hiding(library.saunderson),
        layers: vec![
            layer("sunflowers", &[(yellow, 0.05)], 0.0),
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
    let [lab, xyz] = [lab.to_array(), xyz.to_array()]
        .map(|values| values.map(|value| format!("{value:.2}")).join(" "));
    for text in [lab, xyz, srgb, "103.2, 54.1 mm".to_owned()] {
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
    // egui copies the text in the frame of the release.
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

/// The recipes in up to 40 parts that the library search finds for the painting's palette.
fn library_recipes(
    painting: &PaintingState,
    target: &Target,
    conditions: Vec<ViewingCondition>,
) -> Vec<RecipeMatch> {
    let mut limits = RecipeLimits::new(&painting.library, conditions, FilmKind::Hiding);
    limits.allowed = painting.slots.iter().copied().flatten().collect();
    limits.allowed.sort_unstable();
    limits.whole_parts = Some(40);
    limits.count = 3;
    recipes(&painting.library, target, &limits, &Task::default()).unwrap()
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

fn wait_for_recipes(stage: &mut PanelWindow<Eyedropper>) {
    for _ in 0..3000 {
        stage.harness.step();
        if stage.harness.query_by_label("Load recipe 1").is_some() {
            return stage.run();
        }
        std::thread::sleep(Duration::from_millis(10));
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
        let parts = recipe.parts.as_ref().unwrap();
        let all = parts.iter().enumerate().map(|(at, part)| {
            (painting.library[recipe.shares.parts()[at].0].name.clone(), f64::from(*part))
        });
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
    // For greens you need a pigment that is not on the palette.
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
    // The search finds the mixture itself, three parts white and one part blue.
    assert_eq!(best[0].parts, Some(vec![3, 1]));
    assert!(best[0].delta_e.iter().all(|difference| *difference < 0.01), "{best:?}");
    assert!(stage.harness.query_by_label("\u{2206}E 0.00, 0.00").is_some(), "under both lights");
}

#[test]
fn a_search_can_be_cancelled() {
    let mut painting = made_painting();
    // In a large library the search takes long.
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
    std::thread::sleep(Duration::from_millis(500));
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

fn wheel(painting: PaintingState, wanted: Option<Lab>) -> Harness<'static, Fixture<Wheel>> {
    let wanted = wanted.map(|lab| TargetColor { name: "Lab".to_owned(), color: Color::Lab(lab) });
    let mut harness = show_panel(Wheel::default(), painting, move |wheel, ui, cx| {
        wheel.show(ui, cx, wanted.as_ref());
    });
    let start = Instant::now();
    while harness.query_by_label_contains("Mixing the tubes").is_some() {
        assert!(start.elapsed() < Duration::from_secs(60), "no wheel");
        std::thread::sleep(Duration::from_millis(5));
        harness.run();
    }
    harness
}

fn request(painting: &PaintingState) -> WheelRequest {
    let mut tubes: Vec<_> = painting.slots.iter().copied().flatten().collect();
    tubes.sort_unstable();
    let viewing = painting.light.viewing.clone();
    WheelRequest { library: painting.library.clone(), tubes, viewing }
}

#[test]
fn the_tubes_lie_at_their_measured_colours() {
    let painting = painting();
    let made = request(&painting).make().unwrap();
    let mut harness = wheel(painting, None);
    let rect = harness.get_by_label("Colour wheel").rect();
    assert!(rect.width() > 250.0 && (rect.width() - rect.height()).abs() < 0.5, "{rect}");
    let Some(drawn) = picture(&mut harness, "wheel") else { return };
    let chroma = made.gamut.samples.iter().map(|one| one.color.lab.a.hypot(one.color.lab.b));
    let plane = Plane::with_chroma(rect, chroma.fold(0.0, f64::max));
    for (pigment, color) in &made.masstones {
        let point = plane.point([color.lab.a, color.lab.b]);
        let found = drawn.get_pixel(point.x as u32, point.y as u32).0;
        let wanted = color.srgb.linear().mapped_into_gamut().encoded().to_bytes();
        let apart = found.iter().zip(wanted).map(|(a, b)| a.abs_diff(b)).max().unwrap();
        // The buttons of white and black lie in the middle.
        let chromatic = color.lab.a.hypot(color.lab.b) > 15.0;
        assert!(!chromatic || apart <= 2, "{pigment:?}: {found:?}, not {wanted:?}");
    }
}

#[track_caller]
fn wait_for(harness: &mut Harness<'static, Fixture<Wheel>>, words: &str) {
    let start = Instant::now();
    while harness.query_all_by_label_contains(words).next().is_none() {
        assert!(start.elapsed() < Duration::from_secs(60), "no `{words}`");
        std::thread::sleep(Duration::from_millis(10));
        harness.run_steps(2);
    }
}

#[test]
fn the_legend_tells_whether_a_colour_is_reached() {
    let made = request(&painting()).make().unwrap();
    let mixed = made.gamut.samples[200].color.lab;
    let mut harness = wheel(painting(), Some(mixed));
    wait_for(&mut harness, "The tubes reach it");
    wait_for(&mut harness, "Ring: what the brush holds");
    let neon = Lab { lightness: 80.0, a: -90.0, b: 20.0 };
    let far = made.nearest(neon).unwrap().delta_e;
    assert!(far > 10.0, "{far}");
    let mut harness = wheel(painting(), Some(neon));
    wait_for(&mut harness, "The tubes come within");
    let label = harness.get_by_label_contains("The tubes come within");
    let words = label.accesskit_node().value().unwrap();
    let found: f64 = words.trim_end_matches('.').rsplit(' ').next().unwrap().parse().unwrap();
    assert!(found <= far + 0.05 && found > 0.5 * far, "{found} by search, {far} by samples");
}

#[test]
fn a_click_finds_recipes_for_that_colour_and_offers_to_load_them() {
    let mut harness = wheel(painting(), None);
    click(&mut harness, "All lightnesses");
    let rect = harness.get_by_label("Colour wheel").rect();
    harness.hover_at(rect.center() + vec2(20.0, -14.0));
    harness.drag_at(rect.center() + vec2(20.0, -14.0));
    harness.drop_at(rect.center() + vec2(20.0, -14.0));
    harness.run_steps(3);
    wait_for(&mut harness, "Square: Lab 50 ");
    wait_for(&mut harness, "Load recipe 1");
    wait_for(&mut harness, "The tubes reach it");
    picture(&mut harness, "wheel-recipes");
    harness.get_by_label("Load recipe 1").click_accesskit();
    harness.run_steps(2);
    assert!(matches!(harness.state().requests[..], [Request::Worker(_)]), "the brush is loaded");
    harness.get_by_label("Clear the wheel's colour").click_accesskit();
    harness.run_steps(2);
    assert!(harness.query_by_label("Load recipe 1").is_none());
}

#[test]
fn a_palette_without_paint_that_mixes_tells_so() {
    let mut bare = painting();
    bare.slots = [None; SLOTS];
    let harness = wheel(bare, None);
    assert!(harness.query_by_label_contains("can be mixed").is_some());
}

#[test]
fn a_low_window_shows_the_wheel_whole() {
    for height in [800.0, 900.0, 1080.0] {
        let mut window = Window::sized("low-wheel", vec2(1440.0, height), 1.0);
        window.click("Wheel");
        let start = Instant::now();
        while window.harness().query_by_label("Colour wheel").is_none() {
            assert!(start.elapsed() < Duration::from_secs(60), "no wheel");
            std::thread::sleep(Duration::from_millis(10));
            window.harness().step();
        }
        window.settle();
        window.save(&format!("low-wheel-{height}"));
        let rect = window.harness().get_by_label("Colour wheel").rect();
        let tab = window.harness().get_by_label("Wheel").rect();
        // The status line takes 24 points.
        let room = tab.bottom()..=height - 24.0;
        assert!(rect.width() >= 128.0, "{rect} is too small to read");
        assert!(room.contains(&rect.top()) && room.contains(&rect.bottom()), "{rect} of {height}");
    }
}

fn kept(name: &str, library: &str, parts: &[(&str, f64)]) -> KeptMixture {
    let recipe: Recipe = parts.iter().map(|(name, part)| ((*name).to_owned(), *part)).collect();
    let color = "#4a7d8c".to_owned();
    let name = name.to_owned();
    let library = library.to_owned();
    KeptMixture { name, library, recipe, vehicle: 0.25, color, light: "D65".to_owned() }
}

fn book() -> SwatchBook {
    let own = painting().library.title.clone();
    SwatchBook {
        swatches: vec![
            kept("sky", &own, &[("Zinc White", 5.0), ("Ultramarine", 1.0)]),
            kept("far", "Acrylics", &[("Phthalo Green", 1.0)]),
            kept("lake", &own, &[("Zinc White", 2.0), ("Prussian Blue", 1.0)]),
        ],
    }
}

#[test]
fn moving_passes_over_mixtures_that_are_not_shown() {
    let mut harness = panel(book());
    click(&mut harness, "mixture sky");
    click(&mut harness, "Later");
    assert_requests(&mut harness, &[change(SwatchChange::Move(0, 2))]);
}

fn panel(book: SwatchBook) -> Harness<'static, Fixture<Swatches>> {
    show_panel(Swatches::default(), painting(), move |panel, ui, cx| panel.show(ui, cx, &book))
}

fn change(change: SwatchChange) -> Request {
    Request::File(FileRequest::Swatches(change))
}

#[test]
fn a_mixture_is_loaded_laid_moved_renamed_and_removed() {
    let mut harness = panel(book());
    assert!(harness.query_by_label("mixture far").is_none(), "of another library");
    click(&mut harness, "All libraries");
    picture(&mut harness, "swatches");
    click(&mut harness, "mixture sky");
    click(&mut harness, "Load the brush");
    let requests = std::mem::take(&mut harness.state_mut().requests);
    let [Request::Worker(Command::Apply(Action::Load(load)))] = &requests[..] else {
        panic!("{requests:?}");
    };
    assert_eq!((&load.recipe, load.vehicle), (&book().swatches[0].recipe, 0.25));
    assert_eq!(harness.state().tools.recent[0].0, load.recipe, "it is among the last mixtures");
    click(&mut harness, "Lay on the palette");
    let requests = std::mem::take(&mut harness.state_mut().requests);
    let laid = matches!(&requests[..], [Request::Worker(Command::SqueezeInFreeSpace { .. })]);
    assert!(laid, "{requests:?}");
    assert!(is_disabled(&harness, "Earlier"), "it is the first");
    click(&mut harness, "Later");
    assert_requests(&mut harness, &[change(SwatchChange::Move(0, 1))]);
    click(&mut harness, "mixture lake");
    click(&mut harness, "Rename");
    harness.get_by_label("Name of the mixture").type_text(" of glass");
    harness.run();
    harness.key_press(Key::Enter);
    harness.run();
    assert_requests(&mut harness, &[change(SwatchChange::Rename(2, "lake of glass".to_owned()))]);
    click(&mut harness, "Forget");
    assert_requests(&mut harness, &[change(SwatchChange::Remove(2))]);
    assert!(harness.query_by_label("Forget").is_none(), "nothing is selected any more");
}

#[test]
fn a_mixture_whose_pigments_are_missing_says_which_and_offers_the_way() {
    let mut harness = panel(book());
    click(&mut harness, "All libraries");
    click(&mut harness, "mixture far");
    assert!(is_disabled(&harness, "Load the brush") && is_disabled(&harness, "Lay on the palette"));
    assert!(harness.query_by_label("Phthalo Green is not in the open library.").is_some());
    assert!(harness.query_by_label("Add its tubes").is_none());
    click(&mut harness, "mixture lake");
    picture(&mut harness, "swatches-missing");
    assert!(is_disabled(&harness, "Load the brush"));
    assert!(harness.query_by_label("Prussian Blue is not on the palette.").is_some());
    click(&mut harness, "Add its tubes");
    let names = PIGMENTS.into_iter().chain(["Prussian Blue"]);
    let palette = Action::Palette(PaletteSpec::from_names(names));
    assert_requests(&mut harness, &[Request::Worker(Command::Apply(palette))]);
    let mut full = painting();
    full.slots[7] = full.library.find("Emerald Green").ok();
    harness.state_mut().painting = full;
    harness.run();
    assert!(is_disabled(&harness, "Add its tubes"), "the palette is full");
}

#[test]
fn files_are_asked_for_from_the_menu() {
    let mut harness = panel(book());
    for (name, wanted) in [
        ("Import...", FileRequest::ImportSwatches),
        ("Export mixtures...", FileRequest::ExportSwatches(SwatchFormat::Json)),
        ("Export colours (.gpl)...", FileRequest::ExportSwatches(SwatchFormat::Gpl)),
        ("Export colours (.ase)...", FileRequest::ExportSwatches(SwatchFormat::Ase)),
    ] {
        click(&mut harness, "Import, export");
        click(&mut harness, name);
        assert_requests(&mut harness, &[Request::File(wanted)]);
    }
    let harness = panel(SwatchBook::default());
    assert!(harness.query_by_label_contains("No mixture is kept").is_some());
}
