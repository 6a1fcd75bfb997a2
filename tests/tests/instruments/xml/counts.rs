//! Detector counts referenced to a white and a dark, on the command line.

use std::path::Path;

use calibrate::library::PigmentLibrary;
use suite::program::impasto;

/// Writes the counts `of` a wavelength, every 10 nm from 380 to 730 nm; returns the path.
fn counts(folder: &Path, name: &str, of: impl Fn(f64) -> f64) -> String {
    let lines = (0..36).map(|i| 380.0 + 10.0 * f64::from(i));
    let lines: String = lines.map(|nm| format!("{nm}\t{}\n", of(nm))).collect();
    let path = folder.join(name);
    std::fs::write(&path, format!("nm\tcounts\n{lines}")).unwrap();
    path.to_str().unwrap().to_owned()
}

fn lamp(nm: f64) -> f64 {
    200.0 + nm
}

#[test]
fn a_grey_has_its_color_by_way_of_counts() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let white = counts(folder, "white.txt", |nm| 100.0 + lamp(nm));
    let dark = counts(folder, "dark.txt", |_| 100.0);
    let half = counts(folder, "half.txt", |nm| 100.0 + 0.5 * lamp(nm));
    let csv = folder.join("grey.csv");
    std::fs::write(&csv, "sample,380,480,580,680,730\nhalf,0.49,0.49,0.49,0.49,0.49\n").unwrap();
    let wanted = impasto(&["color", csv.to_str().unwrap(), "--json"]).json();
    let run =
        impasto(&["color", &half, "--white", &white, "--dark", &dark, "--tile", "0.98", "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    let found = run.json();
    for axis in 0..3 {
        let [found, wanted] = [&found, &wanted].map(|json| json[0]["lab"][axis].as_f64().unwrap());
        assert!((found - wanted).abs() < 1e-9, "{axis}: {found}, {wanted}");
    }
    let bare = impasto(&["color", &half, "--white", &white, "--dark", "0", "--json"]);
    assert!(bare.err.contains("the white is taken") && bare.err.contains("--tile"), "{}", bare.err);
    let lighter = bare.json()[0]["xyz"][1].as_f64().unwrap();
    assert!(lighter > wanted[0]["xyz"][1].as_f64().unwrap(), "the dark was left in: {lighter}");
}

#[test]
fn faults_name_both_files_and_the_way_out() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let white =
        counts(folder, "white.txt", |nm| if nm == 500.0 { 101.0 } else { 100.0 + lamp(nm) });
    let dark = counts(folder, "dark.txt", |_| 100.0);
    let half = counts(folder, "half.txt", |nm| 100.0 + 0.5 * lamp(nm));
    let run = impasto(&["color", &half, "--white", &white, "--dark", &dark]);
    assert_eq!(run.status, 1, "{}", run.err);
    for word in ["half.txt: cannot be set against", "white.txt", "500 nm", "--least-light"] {
        assert!(run.err.contains(word), "{word}: {}", run.err);
    }
    let run = impasto(&["color", &half, "--white", &white]);
    assert!(run.err.contains("hint: add --dark-reading FILE"), "{}", run.err);
    let run = impasto(&["color", &half]);
    assert!(run.status == 1 && run.err.contains("counts"), "{}", run.err);
    let run = impasto(&["color", &half, "--dark", &dark]);
    assert!(run.status == 2 && run.err.contains("--white"), "{}", run.err);
    let run = impasto(&["color", &half, "--white", &white, "--dark", &dark, "--tile", "99"]);
    assert!(run.status == 1 && run.err.contains("--tile 0.99"), "{}", run.err);
}

#[test]
fn a_library_names_the_references_among_its_inputs() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let white = counts(folder, "white.txt", lamp);
    let paint = counts(folder, "paint.txt", |nm| 0.9 * lamp(nm));
    let blue = counts(folder, "blue.txt", |nm| (0.5 - nm / 2000.0) * lamp(nm));
    let mixed = counts(folder, "mixed.txt", |nm| (0.8 - nm / 2000.0) * lamp(nm));
    let recipes = folder.join("recipes.csv");
    let table = "sample,white,blue\npaint,1,\nblue,,1\nmixed,1,1\n";
    std::fs::write(&recipes, table).unwrap();
    let library = folder.join("library.json");
    let recipes = recipes.to_str().unwrap();
    let output = library.to_str().unwrap();
    let fit =
        ["fit", &paint, &blue, &mixed, "--white", &white, "--dark", "0", "--recipes", recipes];
    let run = impasto(&[&fit[..], &["--output", output]].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    let text = std::fs::read_to_string(&library).unwrap();
    let library = PigmentLibrary::from_json("library.json", &text).unwrap();
    let inputs: Vec<_> = library.inputs.iter().map(|input| input.path.as_str()).collect();
    assert_eq!(inputs, [&paint, &blue, &mixed, &white, recipes], "{text}");
    let run = impasto(&[&fit[..], &["--output", &white]].concat());
    assert!(run.status != 0 && run.err.contains("white.txt"), "over an input: {}", run.err);
}
