//! The whole walk, in windows of several sizes and in both themes.

use std::path::Path;

use eframe::egui::vec2;
use session::initial_commands;
use studio::files::Preferences;
use studio::theme::ThemeChoice;

use super::hand::Hand;
use super::harness::Window;
use crate::program::{Program, keep_preferences};

/// Sizes of the screen, and of the window that fills it.
const SIZES: [(u16, u16); 4] = [(1280, 800), (1024, 700), (1440, 900), (1920, 1080)];

const THEMES: [(&str, ThemeChoice); 2] =
    [("dark", ThemeChoice::Dark), ("light", ThemeChoice::Light)];

/// Stations left out, as a list of their first letters in `IMPASTO_STATIONS`; all without it.
fn walks(hand: &mut Hand<'_>) {
    let wanted = std::env::var("IMPASTO_STATIONS").unwrap_or_else(|_| "tpobqclrdwx".to_owned());
    for station in wanted.chars() {
        match station {
            't' => hand.tour(),
            'p' => hand.pen(),
            'o' => hand.own_brush(),
            'b' => hand.tools(),
            'q' => hand.quick_palette(),
            'c' => hand.colors(),
            'l' => hand.layers(),
            'r' => {
                hand.crop();
                hand.reference();
            }
            'd' => hand.dialogs(),
            'w' => hand.window(),
            'x' => hand.others(),
            other => panic!("there is no station {other}"),
        }
    }
}

/// A picture to pin.
fn write_reference(folder: &Path) {
    let picture = image::RgbImage::from_fn(300, 200, |x: u32, y: u32| {
        image::Rgb([(x * 4 / 5) as u8, (y * 6 / 5) as u8, 120])
    });
    picture.save(folder.join("reference.png")).unwrap();
}

#[test]
#[ignore = "takes hundreds of pictures for a person to look at, which takes many minutes"]
fn a_painter_does_all_that_the_guides_tell_of() {
    let wanted = std::env::var("IMPASTO_LOOKS").unwrap_or_default();
    for (width, height) in SIZES {
        for (name, theme) in THEMES {
            let look = format!("{width}x{height}-{name}");
            if !wanted.is_empty() && !wanted.split(',').any(|wanted| wanted == look) {
                continue;
            }
            let Some(screen) = crate::screen(width, height) else { return };
            let folder = tempfile::Builder::new().prefix("painter").tempdir().unwrap();
            let pictures = folder.path().join("pictures");
            std::fs::create_dir_all(&pictures).unwrap();
            write_reference(&pictures);
            let home = folder.path().join("home");
            let preferences = Preferences {
                theme,
                last_folder: Some(pictures),
                first_steps_seen: true,
                ..Preferences::default()
            };
            keep_preferences(
                &home,
                &Preferences { first_steps_seen: false, ..preferences.clone() },
            );
            let size = vec2(width.into(), height.into());
            let mut twin = Window::with_commands("painter", size, 1.0, initial_commands());
            twin.studio_mut().files.preferences = preferences;
            twin.settle();
            let program = Program::start(&screen, &home, &format!("{width}x{height}"), &[]);
            let out = Path::new(env!("CARGO_MANIFEST_DIR")).join("../out/painter").join(&look);
            let mut hand = Hand::new(program, twin, out);
            walks(&mut hand);
            hand.end();
        }
    }
}
