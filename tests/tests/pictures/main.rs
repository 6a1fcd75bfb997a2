//! Reference pictures: small pictures of every technique, brush, preset and report figure, as the
//! program
//! `impasto` paints them on the processor.
//!
//! `tests/pictures/commands.txt` has the commands, and the pictures are beside it, at most 64 pixels a side.
//! If a picture differs, the test writes got, wanted and difference side by side to
//! `target/pictures` and prints the path. If you meant the change, run the test again with
//! `IMPASTO_ACCEPT_PICTURES=1`, look at the new references, and commit them.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use image::{Rgb, RgbImage, imageops};
use suite::program::{impasto, repository};

/// Longest side of a reference, in pixels.
const LONGEST: u32 = 64;

/// Greatest difference of a channel, of 255, that we ignore: processors round differently.
const ROUNDING: u8 = 1;

/// One line of `commands.txt`.
struct Case {
    name: String,
    words: Vec<String>,
}

fn cases() -> Vec<Case> {
    let text = std::fs::read_to_string(repository("tests/pictures/commands.txt")).unwrap();
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let cases = lines.map(|line| {
        let (name, command) = line.split_once(": ").unwrap();
        Case { name: name.to_owned(), words: words(command) }
    });
    cases.collect()
}

/// Words of a command, separated by spaces outside of quotation marks and braces.
fn words(command: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quoted = false;
    let mut depth = 0;
    for letter in command.chars() {
        match letter {
            '"' => quoted = !quoted,
            ' ' if !quoted && depth == 0 => words.push(String::new()),
            _ => {
                depth += i32::from(letter == '{') - i32::from(letter == '}');
                words.last_mut().unwrap().push(letter);
            }
        }
    }
    words
}

/// Runs a command that must succeed, and returns its output.
fn run(words: &[String]) -> String {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let run = impasto(&words);
    assert_eq!(run.status, 0, "impasto {}: {}", words.join(" "), run.err);
    run.out
}

/// Files that several commands read. They are made once, in a separate folder.
struct Materials {
    folder: tempfile::TempDir,
}

impl Materials {
    fn get() -> &'static Self {
        static MATERIALS: OnceLock<Materials> = OnceLock::new();
        MATERIALS.get_or_init(|| Self { folder: tempfile::tempdir().unwrap() })
    }

    fn path(&self, name: &str) -> String {
        self.folder.path().join(name).display().to_string()
    }

    /// The path `name`. Calls `make` the first time.
    fn made(&self, once: &OnceLock<String>, name: &str, make: impl FnOnce(&str)) -> String {
        let path = once.get_or_init(|| {
            let path = self.path(name);
            make(&path);
            path
        });
        path.clone()
    }

    /// The script `brush.json` with the head `shape`.
    fn brush(&self, shape: &str) -> String {
        let text = std::fs::read_to_string(repository("tests/pictures/brush.json")).unwrap();
        let path = self.path(&format!("{shape}.json"));
        std::fs::write(&path, text.replace("SHAPE", shape)).unwrap();
        path
    }

    /// The style `name` on a canvas of 64 cells.
    fn style(&self, name: &str) -> String {
        let text = run(&words(&format!("artmap paint --show-style {name}")));
        let lines = text.lines().map(|line| match line.starts_with("side_cells") {
            true => "side_cells = 64",
            false => line,
        });
        let path = self.path(&format!("{name}.toml"));
        std::fs::write(&path, lines.collect::<Vec<_>>().join("\n")).unwrap();
        path
    }

    fn painting(&self) -> String {
        static PAINTING: OnceLock<String> = OnceLock::new();
        self.made(&PAINTING, "painting.exr", |path| {
            let script = self.brush("flat");
            run(&words(&format!("paint {script} --backend cpu -o {path}")));
        })
    }

    /// An art map of two samples of dabs.
    fn map(&self) -> String {
        static MAP: OnceLock<String> = OnceLock::new();
        self.made(&MAP, "map.exr", |path| {
            let style = self.style("dabs");
            let samples = self.path("samples.exr");
            run(&words(&format!("artmap paint --style {style} --tones 2 -o {samples}")));
            run(&words(&format!("artmap build {samples} --size 64 -o {path}")));
        })
    }

    /// Figures of a report on the shipped oils.
    fn figures(&self) -> String {
        static FIGURES: OnceLock<String> = OnceLock::new();
        self.made(&FIGURES, "report/figures", |_| {
            let oils = repository("measurements/van-gogh-oils.pigments.json");
            run(&words(&format!("report {oils} -o {}", self.path("report"))));
        })
    }

    /// `word` with its braces filled in.
    fn filled(&self, word: &str, out: &str) -> String {
        let (Some(start), Some(end)) = (word.find('{'), word.find('}')) else {
            return word.to_owned();
        };
        let inside = &word[start + 1..end];
        let value = match inside.split_once(' ').unwrap_or((inside, "")) {
            ("out", _) => out.to_owned(),
            ("root", _) => repository(""),
            ("folder", _) => self.path(""),
            ("map", _) => self.map(),
            ("painting", _) => self.painting(),
            ("figures", _) => self.figures(),
            ("brush", shape) => self.brush(shape),
            ("style", name) => self.style(name),
            _ => panic!("{word}: nothing of this name is made"),
        };
        format!("{}{value}{}", &word[..start], &word[end + 1..])
    }
}

/// The picture of a case, at the size of a reference.
fn painted(case: &Case) -> RgbImage {
    let materials = Materials::get();
    let out = materials.path(&format!("{}.png", case.name));
    let words: Vec<String> = case.words.iter().map(|word| materials.filled(word, &out)).collect();
    let path = if let [figure] = &words[..] {
        figure
    } else {
        run(&words);
        &out
    };
    let picture = image::open(path).unwrap().to_rgb8();
    let (width, height) = picture.dimensions();
    let longest = width.max(height);
    if longest <= LONGEST {
        return picture;
    }
    let [width, height] = [width, height].map(|length| (length * LONGEST / longest).max(1));
    imageops::thumbnail(&picture, width, height)
}

/// Got, wanted and their difference side by side, if they differ.
fn difference(got: &RgbImage, wanted: &RgbImage) -> Option<RgbImage> {
    fn apart(a: &Rgb<u8>, b: &Rgb<u8>) -> [u8; 3] {
        [0, 1, 2].map(|channel| a[channel].abs_diff(b[channel]))
    }
    let same_size = got.dimensions() == wanted.dimensions();
    let mut pairs = got.pixels().zip(wanted.pixels());
    if same_size && pairs.all(|(a, b)| apart(a, b).iter().all(|&part| part <= ROUNDING)) {
        return None;
    }
    let width = got.width().max(wanted.width());
    let height = got.height().max(wanted.height());
    let mut sheet = RgbImage::from_pixel(3 * width + 8, height, Rgb([128; 3]));
    imageops::replace(&mut sheet, got, 0, 0);
    imageops::replace(&mut sheet, wanted, i64::from(width + 4), 0);
    for (x, y, pixel) in got.enumerate_pixels() {
        if let Some(other) = wanted.get_pixel_checked(x, y) {
            let shown = apart(pixel, other).map(|part| part.saturating_mul(8));
            sheet.put_pixel(2 * width + 8 + x, y, Rgb(shown));
        }
    }
    Some(sheet)
}

/// Compares all pictures with names that begin with `kind`, or accepts those painted now.
fn compare(kind: &str) {
    let references = PathBuf::from(repository("tests/pictures"));
    let sheets = PathBuf::from(repository("target/pictures"));
    let accepts = std::env::var_os("IMPASTO_ACCEPT_PICTURES").is_some_and(|value| value == "1");
    let all = cases();
    let chosen: Vec<&Case> = all.iter().filter(|case| case.name.starts_with(kind)).collect();
    assert!(!chosen.is_empty(), "no picture of this kind: {kind}");
    let mut faults = Vec::new();
    for case in chosen {
        let got = painted(case);
        let reference = references.join(format!("{}.png", case.name));
        if accepts {
            got.save(&reference).unwrap();
            continue;
        }
        match image::open(&reference) {
            Err(error) => faults.push(format!("{}: {error}", reference.display())),
            Ok(wanted) => faults.extend(difference(&got, &wanted.to_rgb8()).map(|sheet| {
                std::fs::create_dir_all(&sheets).unwrap();
                let path = sheets.join(format!("{}.png", case.name));
                sheet.save(&path).unwrap();
                format!("{} differs: got, wanted, difference in {}", case.name, path.display())
            })),
        }
    }
    assert!(
        faults.is_empty(),
        "{}\nif these changes are meant, run again with IMPASTO_ACCEPT_PICTURES=1",
        faults.join("\n")
    );
}

#[test]
fn brushes_paint_as_before() {
    compare("brush-");
}

#[test]
fn paintings_are_lit_as_before() {
    compare("light-");
}

#[test]
fn photographs_in_strokes_are_as_before() {
    compare("strokes-");
}

#[test]
fn watercolors_are_as_before() {
    compare("watercolor-");
}

#[test]
fn samples_and_maps_are_as_before() {
    compare("artmap-");
}

#[test]
fn brushwork_of_maps_is_as_before() {
    compare("painterly-");
}

#[test]
fn volumes_are_as_before() {
    compare("volumes-");
}

#[test]
fn figures_of_a_report_are_as_before() {
    compare("figure-");
}

#[test]
fn a_picture_that_differs_is_found_and_shown() {
    let wanted = RgbImage::from_pixel(8, 6, Rgb([100, 120, 140]));
    let mut got = wanted.clone();
    got.put_pixel(3, 2, Rgb([101, 120, 139]));
    assert!(difference(&got, &wanted).is_none(), "rounding");
    got.put_pixel(3, 2, Rgb([103, 120, 140]));
    let sheet = difference(&got, &wanted).unwrap();
    assert_eq!(sheet.dimensions(), (32, 6));
    assert_eq!(sheet.get_pixel(16 + 8 + 3, 2), &Rgb([24, 0, 0]));
    assert!(difference(&RgbImage::new(8, 5), &wanted).is_some(), "another size");
}

#[test]
fn every_reference_has_its_command() {
    let names: Vec<String> = cases().into_iter().map(|case| format!("{}.png", case.name)).collect();
    assert!(names.len() >= 60, "{} pictures", names.len());
    for entry in std::fs::read_dir(Path::new(&repository("tests/pictures"))).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(!name.ends_with(".png") || names.contains(&name), "{name} has no command");
    }
}
