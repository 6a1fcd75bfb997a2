//! `impasto artmap sample` of paintings that impasto made.

use serde_json::{Value, json};
use suite::program::impasto;

use super::{Folder, artmap, done};

/// Pigments of the crowded painting, one more than a table of samples holds.
const NINE: [&str; 9] = [
    "Zinc White",
    "Lead White",
    "Chrome Yellow",
    "Vermilion",
    "Minium",
    "Cobalt Blue",
    "Ultramarine",
    "Viridian",
    "Bone Black",
];

impl Folder {
    /// A painting of 80 x 60 cells: upright strokes 4 mm (8 cells) apart in two pigments; with
    /// `crowded`, a touch of seven further ones below.
    fn painting(&self, crowded: bool) -> String {
        let load = |pigment: &str, mm: f64| json!({"load": {"brush": "flat", "recipe": {pigment: 1}, "amount_mm": mm}});
        let stroke = |samples: Value| json!({"stroke": {"brush": "flat", "samples": samples}});
        let wash = json!({"wash": {"brush": "flat"}});
        let mut actions: Vec<Value> = Vec::new();
        for (index, pigment) in NINE[2..].iter().enumerate().filter(|_| crowded) {
            let at = 5.0 + 4.0 * index as f64;
            actions.extend([load(pigment, 0.1), stroke(json!([[0, at, 5, 0.6]])), wash.clone()]);
            if index == 5 {
                actions
                    .extend([json!({"dry": {}}), json!({"palette": [NINE[0], NINE[1], NINE[8]]})]);
            }
        }
        for (index, pigment) in NINE[..2].iter().cycle().take(9).enumerate() {
            let x = 4.0 + 4.0 * index as f64;
            actions.push(load(pigment, 0.4));
            actions.push(stroke(json!([[0, x, 2, 0.6], [1, x, 28, 0.6]])));
            actions.push(wash.clone());
        }
        let palette = if crowded { &NINE[..8] } else { &NINE[..2] };
        let script = json!({
            "format": "strokes", "version": 1, "title": "rows",
            "canvas": {"width_mm": 40, "height_mm": 30, "cell_mm": 0.5},
            "palette": palette,
            "brushes": {"flat": {"shape": "flat", "size_mm": 3}},
            "actions": actions,
        });
        let script = self.write("p.json", script.to_string());
        let painting = self.file("p.exr");
        let run = impasto(&["paint", &script, "--backend", "cpu", "--output", &painting]);
        assert_eq!(run.status, 0, "{}", run.err);
        painting
    }
}

#[test]
fn samples_of_a_painting_carry_its_pigments_and_relief() {
    let folder = Folder::new();
    let painting = folder.painting(false);
    let output = folder.file("s.exr");
    let run = ["sample", &painting, "--spacing", "8", "--output", &output, "--json"];
    let told = done(&run).json();
    assert_eq!(told["pigments"], json!(["Zinc White", "Lead White"]));
    assert_eq!(told["provenance"], "painting `rows`");
    let whole = &told["samples"][0];
    assert_eq!((&whole["name"], &whole["spacing_source"]), (&json!("p"), &json!("set")));
    assert_eq!((&whole["mm_per_texel"], &whole["guessed_relief"]), (&json!(0.5), &json!(false)));
    let degrees = whole["direction"]["degrees"].as_f64().unwrap();
    assert!((degrees - 90.0).abs() < 3.0, "{degrees}");
    let seen = whole["direction"]["seen_in"].as_str();
    assert!([Some("colour"), Some("relief")].contains(&seen), "{seen:?}");

    // Marks on a painting count its cells.
    let marks = folder.write(
        "m.toml",
        "[[sample]]\nname = \"half\"\nrectangle = [0, 0, 40, 60]\nspacing = [[4, 9], [12, 9]]\n",
    );
    let sheet = folder.file("s.png");
    let run = ["sample", &painting, "--marks", &marks, "--output", &output, "--sheet", &sheet];
    let told = done(&[&run[..], &["--json"]].concat()).json();
    let half = &told["samples"][0];
    assert_eq!(half["bounds"], json!([0, 0, 40, 60]));
    let [mean, most] = ["mean", "greatest"].map(|of| half["height_mm"][of].as_f64().unwrap());
    assert!(0.01 < mean && mean < most, "{mean} {most}");
    let shown = done(&["show", &output]).out;
    assert!(shown.contains("strokes 8.0 texels (4 mm) apart; Zinc White, Lead White"), "{shown}");
}

#[test]
fn more_than_eight_pigments_are_refused_unless_minor_ones_are_merged() {
    let folder = Folder::new();
    let painting = folder.painting(true);
    let output = folder.file("s.exr");
    let run = ["sample", &painting, "--spacing", "8", "--output", &output];
    let refused = artmap(&run);
    assert_eq!(refused.status, 1, "{}", refused.err);
    assert!(refused.err.contains("9 pigments, samples hold 8"), "{}", refused.err);
    assert!(refused.err.contains("--merge-minor"), "{}", refused.err);
    assert!(!folder.names().contains(&"s.exr".to_owned()), "nothing was written");
    let merged = done(&[&run[..], &["--merge-minor", "--json"]].concat());
    assert!(merged.err.contains(" is below 1 % of the pigment and counts as "), "{}", merged.err);
    let told = merged.json();
    assert!(told["pigments"].as_array().unwrap().len() <= 8, "{told}");
}

#[test]
fn files_that_hold_no_painting_are_refused() {
    let folder = Folder::new();
    let painting = folder.painting(false);
    let output = folder.file("s.exr");
    done(&["sample", &painting, "--spacing", "8", "--output", &output]);
    let again = folder.file("again.exr");
    let run = artmap(&["sample", &output, "--output", &again]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("s.exr: not a painting of impasto"), "{}", run.err);
    let run = artmap(&["show", &painting]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("p.exr: no samples of impasto"), "{}", run.err);
    let bytes = folder.bytes("s.exr");
    let cut = folder.write("cut.exr", &bytes[..bytes.len() / 2]);
    let run = artmap(&["show", &cut]);
    assert!(run.status == 1 && run.err.contains("cut.exr: "), "{}", run.err);
    assert!(run.err.contains("hint: "), "{}", run.err);
    let at = bytes.windows(11).position(|part| part == b"\"version\":1").unwrap();
    let mut later = bytes;
    later[at + 10] = b'7';
    let run = artmap(&["show", &folder.write("later.exr", later)]);
    assert!(run.status == 1 && run.err.contains("samples of version `7`"), "{}", run.err);
}
