//! The command `impasto watercolor`.

mod refusals;
mod photographs;
mod style;
mod meshes;
mod animation;
mod pigments;

use std::path::Path;

use graphics::export::png8;
use graphics::field::Field;
use image::RgbImage;
use suite::program::{Run, impasto};
use tempfile::TempDir;

/// A temporary folder, deleted when dropped.
struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// The path of a file in the folder, which need not exist.
    fn file(&self, name: &str) -> String {
        self.0.path().join(name).display().to_string()
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) -> String {
        std::fs::write(self.0.path().join(name), content).unwrap();
        self.file(name)
    }

    /// The names in the subfolder `inside`, sorted; empty if there is no such folder.
    fn names(&self, inside: &str) -> Vec<String> {
        let Ok(entries) = std::fs::read_dir(self.0.path().join(inside)) else { return Vec::new() };
        let name = |entry: std::io::Result<std::fs::DirEntry>| entry.unwrap().file_name();
        let mut names: Vec<_> = entries.map(|entry| name(entry).into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// A photograph of 160 x 120 pixels: red on the left, blue on the right, darker
    /// downwards, with a yellow disc in the middle.
    fn photograph(&self) -> String {
        let color = |i: usize| {
            let x = (i % 160) as f32;
            let y = (i / 160) as f32;
            let light = 1.0 - 0.5 * y / 120.0;
            let [r, g, b] = match (x - 80.0).hypot(y - 60.0) {
                ..30.0 => [0.8, 0.6, 0.1],
                _ if x < 80.0 => [0.6, 0.1, 0.05],
                _ => [0.05, 0.15, 0.5],
            };
            [r * light, g * light, b * light, 1.0]
        };
        let picture = Field::from_values(160, 120, (0..160 * 120).map(color).collect());
        self.write("photo.png", png8(&picture, 1.0).unwrap().bytes)
    }

    /// A mask of 160 x 120 pixels, white on the left and black on the right.
    fn mask(&self) -> String {
        let picture = Field::from_values(
            160,
            120,
            (0..160 * 120).map(|i: usize| [if i % 160 < 80 { 1.0 } else { 0.0 }; 4]).collect(),
        );
        self.write("mask.png", png8(&picture, 1.0).unwrap().bytes)
    }

    /// An OBJ file of a pyramid on a square, with a colour for each corner.
    fn pyramid(&self) -> String {
        let mut text: String = CORNERS
            .into_iter()
            .map(|([x, y, z], [r, g, b]): ([i8; 3], [u8; 3])| {
                format!("v {x} {y} {z} {r} {g} {b}\n")
            })
            .collect();
        for [a, b, c] in SIDES {
            text += &format!("f {} {} {}\n", a + 1, b + 1, c + 1);
        }
        self.write("pyramid.obj", text)
    }
}

/// Positions and colours of the corners of a pyramid.
const CORNERS: [([i8; 3], [u8; 3]); 5] = [
    ([-1, 0, 1], [1, 0, 0]),
    ([1, 0, 1], [0, 1, 0]),
    ([1, 0, -1], [0, 0, 1]),
    ([-1, 0, -1], [1, 1, 0]),
    ([0, 2, 0], [1, 0, 1]),
];
/// Triangles of the pyramid, as indices of [`CORNERS`].
const SIDES: [[u16; 3]; 6] = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [0, 2, 1], [0, 3, 2]];

fn watercolor(subject: &str, options: &[&str]) -> Run {
    impasto(&[&["watercolor", subject], options].concat())
}

/// Runs `impasto watercolor` on the CPU and asserts success.
#[track_caller]
fn painted(subject: &str, options: &[&str]) -> Run {
    let run = watercolor(subject, &[&["--backend", "cpu"], options].concat());
    assert_eq!(run.status, 0, "{options:?}: {}", run.err);
    run
}

/// Paints `subject` with `options` on the CPU. Returns the bytes of the PNG.
#[track_caller]
fn picture(folder: &Folder, subject: &str, options: &[&str]) -> Vec<u8> {
    let out = folder.file("picture.png");
    painted(subject, &[options, &["--picture", &out]].concat());
    std::fs::read(out).unwrap()
}

fn decoded(bytes: &[u8]) -> RgbImage {
    image::load_from_memory(bytes).unwrap().into_rgb8()
}

fn opened(path: impl AsRef<Path>) -> RgbImage {
    decoded(&std::fs::read(path).unwrap())
}

/// Mean and largest difference of two pictures of equal size, in levels of 8 bits.
#[track_caller]
fn difference(one: &RgbImage, other: &RgbImage) -> (f64, u8) {
    assert_eq!(one.dimensions(), other.dimensions(), "sizes");
    let pairs = one.as_raw().iter().zip(other.as_raw());
    let (sum, most) = pairs
        .map(|(a, b)| a.abs_diff(*b))
        .fold((0_u64, 0), |(sum, most), level| (sum + u64::from(level), most.max(level)));
    (sum as f64 / one.as_raw().len() as f64, most)
}

/// The mean colour of the columns from `left` to `right`.
fn mean(picture: &RgbImage, left: u32, right: u32) -> [f64; 3] {
    let inside = picture.enumerate_pixels().filter(|(x, ..)| (left..right).contains(x));
    let mut sum = [0.0; 3];
    let mut count = 0.0;
    for (.., pixel) in inside {
        (0..3).for_each(|i| sum[i] += f64::from(pixel.0[i]));
        count += 1.0;
    }
    sum.map(|sum| sum / count)
}
