//! The command `impasto painterly`.

mod models;
mod pictures;

use std::sync::OnceLock;

use suite::program::{Run, impasto};
use tempfile::TempDir;

/// A folder with the map `m.exr` of three tones painted in small dabs, its samples `s.exr` and `style.toml`.
pub(super) fn folder() -> TempDir {
    // Painted once for all tests.
    static FILES: OnceLock<[(&str, Vec<u8>); 3]> = OnceLock::new();
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in FILES.get_or_init(painted) {
        std::fs::write(folder.path().join(name), bytes).unwrap();
    }
    folder
}

/// Paints the samples and builds the map.
fn painted() -> [(&'static str, Vec<u8>); 3] {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| path(&folder, name);
    let run = |arguments: &[&str]| {
        let run = impasto(arguments);
        assert_eq!(run.status, 0, "{arguments:?}: {}", run.err);
        run
    };
    let text = run(&["artmap", "paint", "--show-style", "dabs"]).out;
    let small = text
        .replace("side_cells = 300", "side_cells = 64")
        .replace("cell_mm = 0.18", "cell_mm = 0.36");
    std::fs::write(folder.path().join("style.toml"), small).unwrap();
    let style = file("style.toml");
    let samples = file("s.exr");
    let map = file("m.exr");
    run(&["artmap", "paint", "--style", &style, "--tones", "3", "--output", &samples]);
    run(&["artmap", "build", &samples, "--size", "64", "--output", &map]);
    ["style.toml", "s.exr", "m.exr"].map(|name| (name, std::fs::read(file(name)).unwrap()))
}

fn path(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).display().to_string()
}

fn painterly(arguments: &[&str]) -> Run {
    impasto(&[&["painterly"], arguments].concat())
}

#[track_caller]
fn done(arguments: &[&str]) -> Run {
    let run = painterly(arguments);
    assert_eq!(run.status, 0, "{arguments:?}: {}", run.err);
    run
}

/// Mean of the channels of the pixels of a picture in a rectangle.
fn mean(picture: &str, [x, y, width, height]: [u32; 4]) -> f64 {
    let picture = image::open(picture).unwrap().to_rgb8();
    let pixels = (y..y + height).flat_map(|y| (x..x + width).map(move |x| (x, y)));
    let sum: f64 = pixels.map(|(x, y)| picture[(x, y)].0.map(f64::from).iter().sum::<f64>()).sum();
    sum / f64::from(3 * width * height)
}
