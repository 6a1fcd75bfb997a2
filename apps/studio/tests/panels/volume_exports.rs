//! Files that a scene makes, by the buttons of its panel.

use std::path::{Path, PathBuf};
use web_time::{Duration, Instant};

use eframe::egui::{Key, Modifiers, Role, vec2};
use egui_kittest::kittest::Queryable;
use paint::document::Document;
use paint::export::{SpectralBands, layers_file, painting_maps, pigment_maps, spectral_file};
use paint::light::Light;
use paint::scene::{picture, scene};
use session::volumes::{Inside, Subject};

use super::harness::Window;
use super::volumes::{PATIENCE, pour, rest, volumes, wait};

/// A small window with paint on the village, at rest, whose files go into `folder`. The volumes
/// show this inside.
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

/// Gives a name in the dialog that asks for one, and waits for the file or folder that it makes.
fn save(window: &mut Window, folder: &Path, name: &str) -> PathBuf {
    let field = |window: &mut Window| {
        window.harness().run_steps(2);
        let fields = window.harness().get_all_by_role(Role::TextInput);
        fields.last().unwrap().focus();
        window.harness().step();
    };
    field(window);
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
    // The other format that its tip names keeps its ending.
    let path = export(&mut window, "Picture...", folder.path(), "seen.exr");
    let bytes = std::fs::read(path).unwrap();
    let linear = graphics::exr_picture::linear_picture("seen.exr", &bytes).unwrap();
    assert_eq!((linear.width(), linear.height()), (shown_size(&window)[0], shown_size(&window)[1]));
}

/// Width and height of the picture in the window.
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
    // One for each 24th of a second, from the start on.
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
    let shown = picture(document, &scene(document, &light));
    let seen = &volumes(&window).picture().unwrap().pixels;
    let bytes = graphics::export::frame_of(&graphics::encoding::encoded_from_linear(&shown));
    let off = bytes
        .values()
        .iter()
        .zip(seen)
        .filter(|(own, seen)| (0..3).any(|channel| own[channel].abs_diff(seen[channel]) > 1));
    assert_eq!(off.count(), 0, "under its light the painting is the picture that is seen");
    let spectra =
        |bands| spectral_file(document, &light, &shown, bands, |_| true).unwrap().unwrap();
    for (kind, name, wanted) in [
        (
            "Layers, OpenRaster",
            "a.ora",
            layers_file(document, &light, |_| true).unwrap().unwrap().bytes,
        ),
        ("Spectra, OpenEXR of 8 wavelengths", "a.spectral.exr", spectra(SpectralBands::Nodes)),
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
