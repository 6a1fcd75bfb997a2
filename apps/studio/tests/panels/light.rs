//! Tests of the light panel, and of light, eyedropper and reference picture in the whole window
//! with a real worker.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use eframe::egui::{DroppedFile, Event, Key, Modifiers, Role, ViewportCommand, ViewportId, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use image::{Rgb, RgbImage};
use paint::document::Lighting;
use paint::optics::Gloss;
use paint::strokes::{Action, Load, Squeeze, SurfaceId};
use session::{Command, PaintingState};
use spectra::ColorTemperature;
use studio::app::Tab;
use studio::panels::light::LightPanel;
use studio::panels::{FileRequest, Mode};

use super::fixture::{PanelWindow, made_painting};
use super::harness::Window;

fn stage(painting: PaintingState) -> PanelWindow<LightPanel> {
    PanelWindow::new(LightPanel::default(), vec2(300.0, 660.0), painting, LightPanel::show)
}

fn queued_lighting(stage: &mut PanelWindow<LightPanel>) -> Lighting {
    let commands = stage.commands();
    let [Command::Apply(Action::Light(lighting))] = &commands[..] else {
        panic!("one change of light: {commands:?}");
    };
    lighting.clone()
}

#[test]
fn a_searched_light_is_set_by_a_click_only() {
    let mut stage = stage(made_painting());
    stage.save("light");
    stage.click("Illuminant: D65");
    stage.save("light-list");
    assert!(stage.harness.query_by_label("HP1").is_some(), "the whole list is there");
    stage.harness.get_by_role(Role::TextInput).type_text("violet");
    stage.run();
    assert!(stage.harness.query_by_label("HP1").is_none(), "the list is filtered");
    stage.harness.get_by_label("LED-V2").hover();
    stage.wait(1.0);
    assert!(stage.commands().is_empty(), "hovering sends nothing");
    stage.click("LED-V2");
    let wanted =
        Lighting { illuminant: "LED-V2".to_owned(), ..stage.state().painting.lighting.clone() };
    assert_eq!(queued_lighting(&mut stage), wanted);
    assert!(stage.harness.query_by_label("LED-V2").is_none(), "the list is closed");
    assert!(stage.harness.query_by_label("Illuminant: LED-V2").is_some(), "shown at once");
}

#[test]
fn enter_sets_the_first_match_or_a_typed_temperature() {
    for (typed, wanted) in [
        ("north sky", "D75"),
        ("3200K", "3200K"),
        ("D7450K", "D7450K"),
        ("a", "A"),
        ("led-b", "LED-B1"),
    ] {
        let mut stage = stage(made_painting());
        stage.click("Illuminant: D65");
        stage.harness.get_by_role(Role::TextInput).type_text(typed);
        stage.run();
        stage.harness.key_press(Key::Enter);
        stage.run();
        assert_eq!(queued_lighting(&mut stage).illuminant, wanted, "typed {typed}");
    }
}

#[test]
fn arrows_move_the_light_that_enter_takes() {
    let mut stage = stage(made_painting());
    stage.click("Illuminant: D65");
    stage.harness.get_by_role(Role::TextInput).type_text("led-b");
    stage.run();
    for key in [Key::ArrowDown, Key::ArrowDown, Key::ArrowDown, Key::ArrowUp, Key::Enter] {
        stage.harness.key_press(key);
        stage.run();
        stage.save("light-marked");
    }
    assert_eq!(queued_lighting(&mut stage).illuminant, "LED-B3");
}

#[test]
fn the_temperature_is_set_once_when_the_slider_is_released() {
    let mut stage = stage(made_painting());
    let slider = stage.harness.get_by_role_and_label(Role::Slider, "Temperature");
    let rect = slider.rect();
    let at = |share: f32| rect.left_center() + vec2(share * rect.width(), 0.0);
    stage.drag(&[at(0.6), at(0.3), at(0.2)]);
    let low = queued_lighting(&mut stage).illuminant;
    let kelvin: f64 = low.strip_suffix('K').unwrap().parse().unwrap();
    assert!((1500.0..4000.0).contains(&kelvin), "a black body below daylight: {low}");
    stage.drag(&[at(0.6), at(0.9)]);
    let high = queued_lighting(&mut stage).illuminant;
    let kelvin: f64 = high.strip_prefix('D').unwrap().strip_suffix('K').unwrap().parse().unwrap();
    assert!((4000.0..=25000.0).contains(&kelvin), "daylight: {high}");
}

#[test]
fn a_temperature_set_by_keys_is_applied_after_a_pause() {
    let mut stage = stage(made_painting());
    stage.harness.get_by_role_and_label(Role::Slider, "Temperature").focus();
    stage.harness.step();
    for _ in 0..3 {
        stage.harness.key_press(Key::ArrowRight);
        stage.harness.step();
    }
    assert!(stage.commands().is_empty(), "keys are still being pressed");
    stage.wait(0.7);
    assert!(queued_lighting(&mut stage).illuminant.starts_with('D'), "daylight");
}

#[test]
fn observers_are_chosen_and_lamp_files_are_requested() {
    let mut stage = stage(made_painting());
    stage.click("Observer");
    stage.click("2015-10");
    assert_eq!(queued_lighting(&mut stage).observer, "2015-10");
    stage.click("Measured lamp\u{2026}");
    assert_eq!(stage.requests(), [FileRequest::OpenLamp]);
}

#[test]
fn dragging_the_direction_adjusts_and_ends_on_release() {
    let mut stage = stage(made_painting());
    let rect = stage.harness.get_by_label("Light direction").rect();
    let centre = rect.center();
    stage.drag(&[centre, centre + vec2(20.0, 0.0), centre + vec2(0.0, 30.0)]);
    let commands = stage.commands();
    let lights: Vec<&Lighting> = commands
        .iter()
        .filter_map(|command| match command {
            Command::Adjust(Action::Light(lighting)) => Some(lighting),
            _ => None,
        })
        .collect();
    assert!(matches!(commands.last(), Some(Command::EndAdjustment)), "{commands:?}");
    assert_eq!(lights.len(), commands.len() - 1, "{commands:?}");
    assert_eq!(lights[0].elevation_deg, 90.0, "the centre is light from straight above");
    assert!(lights.iter().any(|light| light.azimuth_deg == 90.0), "{lights:?}");
    let last = lights[lights.len() - 1];
    assert_eq!(last.azimuth_deg, 180.0);
    // The drawn hemisphere has a radius of 48 points.
    assert!((last.elevation_deg - (30.0_f64 / 48.0).acos().to_degrees()).abs() < 0.1, "{last:?}");
    let undirected = Lighting { azimuth_deg: 0.0, elevation_deg: 0.0, ..last.clone() };
    let before = &stage.state().painting.lighting;
    assert_eq!(undirected, Lighting { azimuth_deg: 0.0, elevation_deg: 0.0, ..before.clone() });
    assert!(
        stage.harness.query_by_label_contains("180\u{b0}, ").is_some(),
        "shown before the worker reports it"
    );
}

#[test]
fn each_arrow_key_is_one_action() {
    let mut stage = stage(made_painting());
    stage.harness.get_by_label("Light direction").focus();
    stage.run();
    stage.harness.key_press(Key::ArrowRight);
    stage.harness.step();
    let lighting = queued_lighting(&mut stage);
    assert_eq!((lighting.azimuth_deg, lighting.elevation_deg), (320.0, 50.0));
    stage.harness.key_press(Key::ArrowUp);
    stage.harness.step();
    let lighting = queued_lighting(&mut stage);
    assert_eq!((lighting.azimuth_deg, lighting.elevation_deg), (320.0, 55.0));
}

#[test]
fn ambient_and_relief_sliders_adjust_and_end() {
    for (name, most) in [("Ambient", 1.0), ("Relief", 3.0)] {
        let mut stage = stage(made_painting());
        let rect = stage.harness.get_by_role_and_label(Role::Slider, name).rect();
        stage.drag(&[rect.center(), rect.right_center() + vec2(30.0, 0.0)]);
        let commands = stage.commands();
        let [.., Command::Adjust(Action::Light(last)), Command::EndAdjustment] = &commands[..]
        else {
            panic!("{name} adjusts and settles: {commands:?}");
        };
        let (moved, other) = match name {
            "Ambient" => (last.ambient, last.relief),
            _ => (last.relief, last.ambient),
        };
        let untouched = if name == "Ambient" { 1.0 } else { 0.5 };
        assert_eq!((moved, other), (most, untouched), "{name}");
    }
}

#[test]
fn dragging_the_adaptation_adjusts_both_lights_and_ends() {
    let mut painting = made_painting();
    painting.lighting.adaptation = 0.5;
    let second = Lighting { illuminant: "A".to_owned(), ..painting.lighting.clone() };
    painting.second_lighting = Some(second.clone());
    let mut stage = stage(painting);
    let slider = stage.harness.get_by_role_and_label(Role::Slider, "Adaptation");
    assert_eq!(slider.accesskit_node().numeric_value(), Some(0.5), "as reported");
    let rect = slider.rect();
    stage.drag(&[rect.center(), rect.left_center() - vec2(30.0, 0.0)]);
    let commands = stage.commands();
    let [
        ..,
        Command::Adjust(Action::Light(last)),
        Command::EndAdjustment,
        Command::SetSecondLight(Some(to_second)),
    ] = &commands[..]
    else {
        panic!("both lights change, the first as one action: {commands:?}");
    };
    let before = stage.state().painting.lighting.clone();
    assert_eq!(*last, Lighting { adaptation: 0.0, ..before });
    assert_eq!(*to_second, Lighting { adaptation: 0.0, ..second });
}

#[test]
fn wet_and_dry_gloss_are_dragged() {
    let mut stage = stage(made_painting());
    let medium = stage.state().painting.medium.clone();
    for (name, is_wet) in [("Wet gloss", true), ("Dry gloss", false)] {
        let rect = stage.harness.get_by_role_and_label(Role::Slider, name).rect();
        stage.drag(&[rect.center(), rect.right_top() + vec2(9.0, -9.0)]);
        let commands = stage.commands();
        let [.., Command::Adjust(Action::Gloss { wet, dry }), Command::EndAdjustment] =
            &commands[..]
        else {
            panic!("{name} adjusts and settles: {commands:?}");
        };
        let corner = Gloss { strength: 1.0, exponent: 500.0 };
        let wanted = if is_wet { (corner, medium.dry) } else { (medium.wet, corner) };
        assert_eq!((*wet, *dry), wanted, "{name}");
        // The worker still reports the old value.
        stage.wait(3.5);
    }
}

#[test]
fn the_second_light_is_switched_and_swapped() {
    let mut stage = stage(made_painting());
    stage.click("Second light");
    let first = stage.state().painting.lighting.clone();
    let second = Lighting { illuminant: "A".to_owned(), ..first.clone() };
    let commands = stage.commands();
    let [Command::SetSecondLight(Some(requests))] = &commands[..] else { panic!("{commands:?}") };
    assert_eq!(*requests, second);
    stage.state().painting.second_lighting = Some(second.clone());
    stage.run();
    stage.save("light-split");
    stage.click("Second illuminant: A");
    stage.harness.get_by_role(Role::TextInput).type_text("FL11");
    stage.run();
    stage.click("FL11");
    let commands = stage.commands();
    let [Command::SetSecondLight(Some(requests))] = &commands[..] else { panic!("{commands:?}") };
    assert_eq!(*requests, Lighting { illuminant: "FL11".to_owned(), ..first.clone() });
    stage.click("Swap");
    let commands = stage.commands();
    let [Command::SetSecondLight(Some(to_second)), Command::Apply(Action::Light(to_first))] =
        &commands[..]
    else {
        panic!("both lights are exchanged: {commands:?}");
    };
    assert_eq!((to_first, to_second), (&second, &first));
    stage.click("Second light");
    assert!(matches!(stage.commands()[..], [Command::SetSecondLight(None)]));
}

#[test]
fn the_second_light_follows_the_direction_of_the_first() {
    let mut painting = made_painting();
    painting.second_lighting =
        Some(Lighting { illuminant: "A".to_owned(), ..painting.lighting.clone() });
    let mut stage = stage(painting);
    stage.harness.get_by_label("Light direction").focus();
    stage.run();
    stage.harness.key_press_modifiers(Modifiers::NONE, Key::ArrowLeft);
    stage.harness.step();
    let commands = stage.commands();
    let [Command::Apply(Action::Light(first)), Command::SetSecondLight(Some(second))] =
        &commands[..]
    else {
        panic!("both are moved: {commands:?}");
    };
    assert_eq!(*second, Lighting { illuminant: "A".to_owned(), ..first.clone() });
    assert_eq!(first.azimuth_deg, 310.0);
}

#[test]
fn without_a_second_light_there_is_nothing_to_swap() {
    let stage = stage(made_painting());
    assert!(stage.harness.get_by_label("Swap").accesskit_node().is_disabled());
}

#[test]
fn white_point_numbers_equal_those_of_the_library() {
    let mut stage = stage(made_painting());
    let light = stage.state().painting.light.clone();
    let xyz = light.quadrature.rule.white;
    let sum = xyz.x + xyz.y + xyz.z;
    let temperature = ColorTemperature::of(&light.viewing.illuminant).unwrap();
    let lines = [
        format!("x {:.4}  y {:.4}", xyz.x / sum, xyz.y / sum),
        format!("{:.0} K  Duv {:+.4}", temperature.kelvin, temperature.duv),
    ];
    for text in lines {
        assert!(stage.harness.query_by_label(&text).is_some(), "{text}");
    }
    assert!(is_near_d65(xyz.x / sum, xyz.y / sum), "the light is D65");
}

fn is_near_d65(x: f64, y: f64) -> bool {
    (x - 0.3127).abs() < 1e-4 && (y - 0.3290).abs() < 1e-4
}

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
    for (name, share) in [("Zinc White", 0.75), ("Ultramarine", 0.25)] {
        let pigment = painting.library.find(name).unwrap();
        let slot = painting.slots.iter().position(|slot| *slot == Some(pigment)).unwrap();
        let found = brush.parts[slot];
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
    fn name(window: &Window) -> String {
        let painting = window.studio().painting().unwrap();
        painting.library[painting.slots[7].unwrap()].name.clone()
    }
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
    for full in [false, true] {
        let viewport = window.harness().input_mut().viewports.entry(ViewportId::ROOT).or_default();
        viewport.fullscreen = Some(full);
        let keys = [true, false].map(|pressed| Event::Key {
            key: Key::F11,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers: Modifiers::NONE,
        });
        window.frame(keys.to_vec());
        let commands = &window.harness().output().viewport_output[&ViewportId::ROOT].commands;
        assert!(commands.contains(&ViewportCommand::Fullscreen(!full)), "{full}");
    }
}
