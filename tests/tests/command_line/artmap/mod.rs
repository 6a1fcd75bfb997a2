//! The command `impasto artmap`.

mod sampled;
mod proposed;
mod painted;
mod built;
mod paintings;
mod refusals;

use graphics::export::png8;
use graphics::field::Field;
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

    fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.0.path().join(name)).unwrap()
    }

    /// Names of the files, sorted.
    fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).unwrap();
        let name = |entry: std::io::Result<std::fs::DirEntry>| entry.unwrap().file_name();
        let mut names: Vec<_> = entries.map(|entry| name(entry).into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// A picture of 200 x 120 pixels. Left of x = 100 light strokes at 60 degrees, 10 px apart;
    /// right of it dark ones at 120 degrees, 8 px apart.
    fn strokes(&self) -> String {
        let color = |i: usize| {
            let x = (i % 200) as f32;
            let y = (i / 200) as f32;
            let (degrees, spacing, grey) =
                if x < 100.0 { (60.0_f32, 10.0, 0.5) } else { (120.0, 8.0, 0.1) };
            let (sin, cos) = degrees.to_radians().sin_cos();
            let across = (y * cos - x * sin) / spacing;
            let light = 1.0 + 0.2 * (std::f32::consts::TAU * across).cos();
            let [r, g, b] = [1.0, 0.9, 0.7].map(|channel| channel * grey * light);
            [r, g, b, 1.0]
        };
        let picture = Field::from_values(200, 120, (0..200 * 120).map(color).collect());
        self.write("strokes.png", png8(&picture, 1.0).unwrap().bytes)
    }
}

/// Marks on the picture of [`Folder::strokes`].
const MARKS: &str = r#"painting = "strokes.png"

[[sample]]
name = "wall"
scribble = [[20, 30], [70, 90]]

[[sample]]
name = "shade"
rectangle = [106, 6, 88, 108]
spacing = [[150, 60], [150, 68]]
"#;

fn artmap(arguments: &[&str]) -> Run {
    impasto(&[&["artmap"], arguments].concat())
}

/// Runs `impasto artmap` and asserts success.
#[track_caller]
fn done(arguments: &[&str]) -> Run {
    let run = artmap(arguments);
    assert_eq!(run.status, 0, "{arguments:?}: {}", run.err);
    run
}
