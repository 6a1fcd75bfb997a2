//! Files of scenes in the whole window: the File menu, the file dialog, dropped files, and exports.

use std::path::{Path, PathBuf};

use eframe::egui::{Key, Modifiers, Role, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use paint::document::Document;
use paint::export::{SpectralBands, layers_file, painting_maps, pigment_maps, spectral_file};
use paint::light::Light;
use paint::scene::{picture, scene as picture_scene};
use session::volumes::{Inside, SceneState, Subject};
use web_time::{Duration, Instant};

use super::{PATIENCE, pour, rest, scene, volumes, wait};
use crate::harness::Window;
use crate::light::drop_file;

/// Corners of a square. All models have them in this order.
const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

const TRIANGLES: usize = 2;

fn lines<T>(rows: impl IntoIterator<Item = T>, line: impl Fn(T) -> String) -> String {
    rows.into_iter().map(line).collect()
}

fn obj() -> Vec<u8> {
    let places = lines(SQUARE, |[x, y, z]| format!("v {x} {y} {z}\n"));
    format!("{places}f 1 2 3 4\n").into_bytes()
}

fn ply() -> Vec<u8> {
    let head = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
                property float z\nelement face 2\nproperty list uchar int vertex_indices\n\
                end_header\n";
    let places = lines(SQUARE, |[x, y, z]| format!("{x} {y} {z}\n"));
    format!("{head}{places}3 0 1 2\n3 0 2 3\n").into_bytes()
}

/// A binary glTF: a header, a chunk of JSON, and a chunk of places and corners.
fn glb() -> Vec<u8> {
    let mut binary: Vec<u8> =
        SQUARE.iter().flatten().flat_map(|value| value.to_le_bytes()).collect();
    binary.extend([0_u16, 1, 2, 0, 2, 3].iter().flat_map(|corner| corner.to_le_bytes()));
    let json = serde_json::json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
              "min": [0, 0, 0], "max": [1, 1, 0] },
            { "bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 12 },
        ],
        "buffers": [{ "byteLength": binary.len() }],
    });
    let mut json = json.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut glb = b"glTF\x02\0\0\0".to_vec();
    glb.extend(((12 + 8 + json.len() + 8 + binary.len()) as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &json), (b"BIN\0", &binary)] {
        glb.extend((chunk.len() as u32).to_le_bytes());
        glb.extend(kind);
        glb.extend(chunk);
    }
    glb
}

fn file(folder: &Path, name: &str, bytes: &[u8]) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

/// A script of two regions that show different things inside.
const SCRIPT: &str = r#"format = "paint-volumes"
version = 1
title = "two regions"
subject = "shape:village"
seconds = 1.0

[palette]
A = "Ultramarine"

[[region]]
name = "left"
inside = "glaze"

[[region]]
name = "right"
inside = "own-colours"

[[pour]]
picked = [0.45, 0.55]
for_s = 0.5
amount_mm3 = 60
recipe = { A = 1 }
region = "left"
"#;

/// Waits until a scene with this title is open and drawn, and returns its state.
fn opened(window: &mut Window, title: &str) -> SceneState {
    wait(window, title, |volumes| {
        volumes.state().is_some_and(|state| state.title == title) && volumes.picture().is_some()
    });
    volumes(window).state().unwrap().clone()
}

/// Waits until the window shows these words.
fn wait_for_words(window: &mut Window, words: &str) {
    let start = Instant::now();
    while !window.shows(words) {
        assert!(start.elapsed() < PATIENCE, "\"{words}\" is not shown");
        std::thread::sleep(Duration::from_millis(3));
        window.harness().step();
    }
    // New widgets are laid out in the following frames.
    window.harness().run_steps(3);
}

/// Chooses an entry of the File menu.
fn choose(window: &mut Window, entry: &str) {
    window.open_menu("File");
    window.click(entry);
}

/// Opens a file in the dialog that asks for one.
fn open_in_dialog(window: &mut Window, name: &str) {
    wait_for_words(window, name);
    // A row contains the size and the age of its file too.
    window.harness().get_all_by_label_contains(name).next().unwrap().click();
    window.harness().run_steps(3);
    window.click("Open");
}

#[test]
fn a_wrong_file_is_told_and_dropped_models_open() {
    let mut window = scene("volumes-wrong");
    let folder = tempfile::tempdir().unwrap();
    let broken = file(folder.path(), "broken.obj", b"v 1 2");
    drop_file(&mut window, &broken);
    wait_for_words(&mut window, "broken.obj");
    window.save("volumes-wrong");
    assert_eq!(volumes(&window).state().unwrap().title, "village", "the open scene stays");
    window.click("OK");
    assert!(!window.shows("broken.obj"), "the message is closed");
    for (name, bytes) in [("one.obj", obj()), ("two.ply", ply()), ("three.glb", glb())] {
        let path = file(folder.path(), name, &bytes);
        drop_file(&mut window, &path);
        let state = opened(&mut window, path.file_stem().unwrap().to_str().unwrap());
        assert_eq!((state.triangles, state.flat), (TRIANGLES, false), "{name}");
    }
    let photograph = folder.path().join("photograph.png");
    image::RgbImage::from_pixel(48, 32, image::Rgb([200, 60, 30])).save(&photograph).unwrap();
    drop_file(&mut window, &photograph);
    assert!(opened(&mut window, "photograph").flat, "it is seen from the front");
    drop_file(&mut window, &file(folder.path(), "script.toml", SCRIPT.as_bytes()));
    let state = opened(&mut window, "two regions");
    assert_eq!(state.events.len(), 1, "{:?}", state.events);
    assert!(state.by_region && state.look.inside == Inside::ByRegion, "{:?}", state.look);
    window.save("volumes-regions");
    window.click("Own");
    wait(&mut window, "one choice for all", |volumes| {
        volumes.state().unwrap().look.inside == Inside::OwnColours
    });
    window.click("By region");
    wait(&mut window, "the choice of each region", |volumes| {
        volumes.state().unwrap().look.inside == Inside::ByRegion
    });
}

#[test]
fn a_model_that_is_dropped_on_the_easel_opens_as_a_scene_and_a_photograph_does_not() {
    let mut window = Window::open("volumes-dropped");
    let folder = tempfile::tempdir().unwrap();
    let photograph = folder.path().join("photograph.png");
    image::RgbImage::from_pixel(48, 32, image::Rgb([200, 60, 30])).save(&photograph).unwrap();
    drop_file(&mut window, &photograph);
    wait_for_words(&mut window, "Reference picture");
    assert!(!window.studio().shows_volumes, "it is pinned beside the canvas");
    drop_file(&mut window, &file(folder.path(), "square.glb", &glb()));
    assert!(window.studio().shows_volumes);
    assert_eq!(opened(&mut window, "square").triangles, TRIANGLES);
}

#[test]
fn the_file_menus_begin_open_and_leave_scenes_and_come_back_to_them() {
    let mut window = Window::open("volumes-menu");
    let folder = tempfile::tempdir().unwrap();
    file(folder.path(), "square.ply", &ply());
    file(folder.path(), "script.toml", SCRIPT.as_bytes());
    window.studio_mut().files.preferences.last_folder = Some(folder.path().to_owned());
    window.open_menu("File");
    let back = window.harness().get_by_label("Back to the scene");
    assert!(back.accesskit_node().is_disabled(), "there is none yet");
    window.click("New scene");
    opened(&mut window, "village");
    choose(&mut window, "Back to the easel");
    assert!(!window.studio().shows_volumes && window.studio().painting().is_some());
    let pictures = volumes(&window).pictures();
    choose(&mut window, "Back to the scene");
    assert!(window.studio().shows_volumes);
    assert_eq!(volumes(&window).state().unwrap().title, "village", "as it was");
    assert!(volumes(&window).pictures() >= pictures);
    // We open it once from the scene and once from the easel.
    choose(&mut window, "Open scene...");
    open_in_dialog(&mut window, "square.ply");
    assert_eq!(opened(&mut window, "square").triangles, TRIANGLES);
    choose(&mut window, "Back to the easel");
    choose(&mut window, "Open scene...");
    open_in_dialog(&mut window, "script.toml");
    opened(&mut window, "two regions");
    assert!(window.studio().shows_volumes);
    choose(&mut window, "New scene");
    assert_eq!(opened(&mut window, "village").events.len(), 0);
}

#[test]
fn regions_that_show_different_things_keep_them_when_the_script_is_saved() {
    let mut window = Window::open("volumes-kept-regions");
    let folder = tempfile::tempdir().unwrap();
    let script = file(folder.path(), "script.toml", SCRIPT.as_bytes());
    let context = window.harness().ctx.clone();
    window.studio_mut().open_scene(&context, Subject::Script(script));
    window.studio_mut().files.preferences.last_folder = Some(folder.path().to_owned());
    opened(&mut window, "two regions");
    window.key(Modifiers::NONE, Key::H);
    wait(&mut window, "no strokes", |volumes| !volumes.state().unwrap().look.hatching);
    window.key(Modifiers::COMMAND, Key::S);
    wait_for_words(&mut window, "Save the script");
    window.click("Save");
    let path = folder.path().join("two-regions.toml");
    let start = Instant::now();
    while !path.exists() {
        assert!(start.elapsed() < PATIENCE, "it is not saved");
        std::thread::sleep(Duration::from_millis(3));
        window.harness().step();
    }
    let saved = volumes::script::Script::open(&path).unwrap();
    let styles = saved.region_styles(&saved.settings().unwrap());
    let found: Vec<_> = styles.iter().map(|style| (style.name.as_str(), style.inside)).collect();
    use volumes::settings::Inside::{Glaze, OwnColors};
    assert_eq!(found, [("left", Glaze), ("right", OwnColors)]);
    assert_eq!(saved.settings().unwrap().hatching.inside, 0.0, "the change is in it");
}

/// A small, resting window with paint on the village. Its files go into `folder`, and its volumes
/// show `inside`.
fn poured(name: &'static str, folder: &Path, inside: Inside) -> Window {
    let mut window = Window::sized(name, vec2(900.0, 640.0), 1.0);
    let context = window.harness().ctx.clone();
    window.studio_mut().open_scene(&context, Subject::Shape("village".to_owned()));
    window.studio_mut().files.preferences.last_folder = Some(folder.to_owned());
    wait(&mut window, "the first picture", |volumes| volumes.picture().is_some());
    pour(&mut window);
    if inside == Inside::Glaze {
        window.key(Modifiers::NONE, Key::G);
    }
    wait(&mut window, "the look", |volumes| {
        let state = volumes.state().unwrap();
        state.look.inside == inside && !state.prepares
    });
    rest(&mut window);
    window.click("Export");
    window
}

/// Types a name in the dialog, and waits for the file or folder that it makes.
fn save(window: &mut Window, folder: &Path, name: &str) -> PathBuf {
    window.harness().run_steps(2);
    window.harness().get_all_by_role(Role::TextInput).last().unwrap().focus();
    window.harness().step();
    window.harness().key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.harness().step();
    let fields = window.harness().get_all_by_role(Role::TextInput);
    fields.last().unwrap().type_text(name);
    window.harness().step();
    window.click("Save");
    let path = folder.join(name);
    let start = Instant::now();
    while !path.exists() {
        assert!(start.elapsed() < 2 * PATIENCE, "{name} is not written");
        std::thread::sleep(Duration::from_millis(3));
        window.harness().step();
    }
    path
}

/// Writes a file by a button.
fn export(window: &mut Window, button: &str, folder: &Path, name: &str) -> PathBuf {
    window.click(button);
    save(window, folder, name)
}

#[test]
fn the_picture_that_is_exported_is_the_one_that_is_seen() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = poured("volumes-picture", folder.path(), Inside::OwnColours);
    let path = export(&mut window, "Picture...", folder.path(), "seen.png");
    let file = image::open(&path).unwrap().to_rgb8();
    let shown = volumes(&window).picture().unwrap();
    assert_eq!((file.width() as usize, file.height() as usize), (shown.width, shown.height));
    let off = file
        .pixels()
        .zip(&shown.pixels)
        .filter(|(own, shown)| (0..3).any(|channel| own.0[channel].abs_diff(shown[channel]) > 1));
    assert_eq!(off.count(), 0, "pixels differ");
    // The other format in the tooltip keeps its extension.
    let path = export(&mut window, "Picture...", folder.path(), "seen.exr");
    let bytes = std::fs::read(path).unwrap();
    let linear = graphics::exr_picture::linear_picture("seen.exr", &bytes).unwrap();
    assert_eq!((linear.width(), linear.height()), (shown_size(&window)[0], shown_size(&window)[1]));
}

fn shown_size(window: &Window) -> [usize; 2] {
    let shown = volumes(window).picture().unwrap();
    [shown.width, shown.height]
}

#[test]
fn an_animation_is_exported_as_a_gif_or_an_animated_png() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = poured("volumes-animation", folder.path(), Inside::OwnColours);
    let last = volumes(&window).state().unwrap().time.end;
    let path = export(&mut window, "Animation...", folder.path(), "all.png");
    let file = std::io::BufReader::new(std::fs::File::open(&path).unwrap());
    let decoder = image::codecs::png::PngDecoder::new(file).unwrap();
    assert!(decoder.is_apng().unwrap(), "it moves");
    let frames = image::AnimationDecoder::into_frames(decoder.apng().unwrap());
    let frames: Vec<_> = frames.collect_frames().unwrap();
    // There is one frame for each 24th of a second.
    assert_eq!(frames.len() as u64, last / 5 + 1);
    let [first, end] = [&frames[0], frames.last().unwrap()].map(|frame: &image::Frame| {
        frame
            .buffer()
            .pixels()
            .filter(|pixel: &&image::Rgba<u8>| {
                let [red, green, blue, _] = pixel.0;
                red.max(green).max(blue) - red.min(green).min(blue) > 24
            })
            .count()
    });
    assert!(first == 0 && end > 100, "colour comes: {first}, {end}");
    let path = export(&mut window, "Animation...", folder.path(), "all.gif");
    let bytes = std::fs::read(path).unwrap();
    assert!(bytes.starts_with(b"GIF89a"), "a GIF");
    let size = [6, 8].map(|at| usize::from(u16::from_le_bytes([bytes[at], bytes[at + 1]])));
    assert_eq!(size, shown_size(&window));
}

#[test]
fn the_painting_and_its_layers_spectra_and_maps_are_exported() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = poured("volumes-painting", folder.path(), Inside::Glaze);
    window.save("volumes-exports");
    let path = export(&mut window, "Painting...", folder.path(), "painting.exr");
    let bytes = std::fs::read(path).unwrap();
    let document: Document = paint::file::read("painting.exr", &bytes).unwrap();
    assert_eq!(document.title, "village");
    assert_eq!([document.wet.width(), document.wet.height()], shown_size(&window));
    let light = light(&document);
    let document = &document;
    let shown = picture(document, &picture_scene(document, &light));
    let seen = &volumes(&window).picture().unwrap().pixels;
    let bytes = graphics::export::frame_of(&graphics::encoding::encoded_from_linear(&shown));
    let off = bytes
        .values()
        .iter()
        .zip(seen)
        .filter(|(own, seen)| (0..3).any(|channel| own[channel].abs_diff(seen[channel]) > 1));
    assert_eq!(off.count(), 0, "under its light the painting is the picture that is seen");
    let spectra = spectral_file(document, &light, &shown, SpectralBands::Nodes, |_| true);
    for (kind, name, wanted) in [
        (
            "Layers, OpenRaster",
            "a.ora",
            layers_file(document, &light, |_| true).unwrap().unwrap().bytes,
        ),
        ("Spectra, OpenEXR of 8 wavelengths", "a.spectral.exr", spectra.unwrap().unwrap()),
    ] {
        let path = export_of_painting(&mut window, kind, folder.path(), name);
        assert!(std::fs::read(path).unwrap() == wanted, "{name} differs");
    }
    let maps =
        export_of_painting(&mut window, "Pigment maps, a folder of PNG", folder.path(), "a.maps");
    let files = pigment_maps("painting", &painting_maps(document), document.cell_mm).unwrap();
    let last = maps.join(&files.last().unwrap().name);
    let start = Instant::now();
    while !last.exists() {
        assert!(start.elapsed() < PATIENCE, "the maps are not all there");
        window.harness().step();
    }
    for file in files {
        assert!(std::fs::read(maps.join(&file.name)).unwrap() == file.bytes, "{}", file.name);
    }
}

fn light(document: &Document) -> Light {
    let lighting = &document.lighting;
    Light::named(&document.library, &lighting.illuminant, &lighting.observer).unwrap()
}

/// Writes an export of the painting, of a kind that the dialog names.
fn export_of_painting(window: &mut Window, kind: &str, folder: &Path, name: &str) -> PathBuf {
    window.open_menu("Layers, spectra, maps...");
    window.open_menu(kind);
    window.open_menu("Choose a name");
    save(window, folder, name)
}
