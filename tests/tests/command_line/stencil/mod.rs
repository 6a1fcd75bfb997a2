//! The command `impasto stencil`.

mod scenes;
mod cameras;
mod resuming;
mod pigments;
mod faults;
mod recordings;

use std::path::Path;

use image::RgbImage;
use suite::program::{Run, impasto};
use tempfile::TempDir;

/// A red box, 2 units wide, 1 high and 1 deep.
const BOX: &str = "mtllib box.mtl\nv -1 0 -0.5\nv 1 0 -0.5\nv 1 1 -0.5\nv -1 1 -0.5\nv -1 0 0.5\n\
    v 1 0 0.5\nv 1 1 0.5\nv -1 1 0.5\nusemtl red\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\n\
    f 1 5 8 4\nf 2 3 7 6\n";

/// A folder with the model `box.obj`.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("box.obj"), BOX).unwrap();
    std::fs::write(folder.path().join("box.mtl"), "newmtl red\nKd 0.8 0.1 0.05\n").unwrap();
    folder
}

fn path(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).display().to_string()
}

fn stencil(arguments: &[&str]) -> Run {
    impasto(&[&["stencil"], arguments].concat())
}

#[track_caller]
fn done(arguments: &[&str]) -> Run {
    let run = stencil(arguments);
    assert_eq!(run.status, 0, "{arguments:?}: {}", run.err);
    run
}

/// Options of a small picture: wide cells, half a second, one sample a pixel.
const SMALL: [&str; 8] =
    ["--width", "64", "--seconds", "0.5", "--set", "grid.cell=0.2", "--set", "picture.samples=1"];

/// Options of paint poured before the middle of the first picture.
const POUR: [&str; 2] = ["--pour", "0.45,0.6,150"];

fn pixels(path: impl AsRef<Path>) -> RgbImage {
    image::open(path).unwrap().to_rgb8()
}

/// Names of the files in a folder that end in `ending`, sorted.
fn files(folder: impl AsRef<Path>, ending: &str) -> Vec<String> {
    let names = std::fs::read_dir(folder).unwrap();
    let names = names.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = names.filter(|name| name.ends_with(ending)).collect();
    names.sort();
    names
}
