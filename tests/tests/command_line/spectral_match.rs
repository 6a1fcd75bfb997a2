//! `impasto match --by spectrum`: the table, its figures, and the case for which it is made.

use serde_json::Value;
use suite::program::{impasto, repository};

fn run(arguments: &[&str]) -> suite::program::Run {
    let library = repository("measurements/van-gogh-oils.pigments.json");
    impasto(&[&["match", library.as_str()], arguments].concat())
}

/// A measured yellow, whose paint is in the library with others that make the same colour.
fn sample() -> String {
    repository("measurements/van-gogh-oils.csv") + "#14B"
}

fn best(arguments: &[&str]) -> Value {
    let found = run(&[arguments, &["--json", "--tolerance", "0", "--count", "1"]].concat());
    assert_eq!(found.status, 0, "{}", found.err);
    let told = found.json();
    // The film over the black card.
    let target = told.as_array().unwrap().iter().find(|t| t["target"] == "14B on black").unwrap();
    target["recipes"][0].clone()
}

#[test]
fn a_recipe_by_spectrum_is_less_metameric_than_one_by_colour() {
    let lights = ["--illuminant", "D65", "--illuminant", "A=1e-6", "--illuminant", "FL11=1e-6"];
    let by = |by: &str| best(&[&[sample().as_str(), "--by", by], &lights[..]].concat());
    let color = by("color");
    let spectrum = by("spectrum");
    let index = |recipe: &Value, at: usize| recipe["metamerism"][at]["index"].as_f64().unwrap();
    let rms = |recipe: &Value| recipe["rms_percent"].as_f64().unwrap();
    let under = |recipe: &Value, light: &str| recipe["delta_e"][light].as_f64().unwrap();
    // By colour the recipe is exact under daylight and far off under lamps.
    assert!(under(&color, "D65") < 0.01 && index(&color, 0) > 1.0 && index(&color, 1) > 3.0);
    assert!(index(&spectrum, 0) < 0.2 && index(&spectrum, 1) < 0.6, "{spectrum}");
    assert!(under(&spectrum, "D65") < 0.7 && under(&spectrum, "FL11") < 0.7, "{spectrum}");
    assert!(rms(&spectrum) < 0.3 * rms(&color), "{} {}", rms(&spectrum), rms(&color));
    let told = &spectrum["metamerism"][1];
    assert_eq!(told["kind"], "special metamerism index, change of illuminant");
    assert_eq!((&told["from"], &told["to"]), (&"D65".into(), &"FL11".into()));
    assert_eq!(told["unit"], "CIEDE2000");
}

#[test]
fn the_table_says_what_is_matched_and_under_which_lights_it_is_told() {
    let found = run(&[&sample(), "--by", "spectrum", "--count", "1"]);
    for words in [
        "by spectrum: rms of reflectance from 400 to 700 nm, each wavelength equally",
        "equally near within 0.2 % of reflectance",
        "special metamerism index, change of illuminant, in CIEDE2000",
        "D65 to A",
        "D65 to FL11",
        "rms, %",
    ] {
        assert!(found.out.contains(words), "{words}: {}", found.out);
    }
    assert!(found.out.lines().all(|line| line.chars().count() <= 100), "{}", found.out);
    let csv = run(&[&sample(), "--by", "weighted-spectrum", "--count", "1", "--csv"]);
    let heading = csv.out.lines().next().unwrap();
    for column in ["distance", "rms_percent", "delta_e_FL11", "metamerism_D65 to A"] {
        assert!(heading.split(',').any(|one| one == column), "{heading}");
    }
    // A colour has no spectrum to compare.
    let colour = run(&["#4a7d8c", "--count", "1"]);
    assert!(colour.out.contains("(CIEDE2000)") && !colour.out.contains("rms"), "{}", colour.out);
    let refused = run(&["#4a7d8c", "--by", "spectrum"]);
    assert!(refused.status == 2 && refused.out.is_empty(), "{}", refused.out);
    assert!(refused.err.contains("only a colour") && refused.err.contains("--by color"));
}
