//! `impasto correct`: batches, recipes and stock on the command line.

use suite::program::{impasto, repository};

/// A file with spectra of a standard and of a batch with less blue than was meant, both of zinc white and
/// cobalt blue.
fn spectra(folder: &tempfile::TempDir) -> String {
    let library = repository("measurements/van-gogh-oils.pigments.json");
    let mixed = |blue: &str| {
        impasto(&["mix", &library, "Zinc White=88", &format!("Cobalt Blue={blue}"), "--json"])
            .json()
    };
    let list = |json: &serde_json::Value| -> String {
        let values = json.as_array().unwrap().iter();
        values.map(|value| format!(",{value}")).collect()
    };
    let standard = mixed("12");
    let batch = mixed("8");
    let csv = format!(
        "sample{}\nstandard{}\nbatch{}\n",
        list(&standard["wavelengths_nm"]),
        list(&standard["reflectance"]),
        list(&batch["reflectance"])
    );
    let file = folder.path().join("pot.csv");
    std::fs::write(&file, csv).unwrap();
    file.to_str().unwrap().to_owned()
}

#[test]
fn a_batch_that_lacks_blue_is_told_how_much() {
    let folder = tempfile::tempdir().unwrap();
    let file = spectra(&folder);
    let library = repository("measurements/van-gogh-oils.pigments.json");
    let standard = format!("{file}#standard");
    let batch = format!("{file}#batch");
    let made = ["--made", "Zinc White=440", "Cobalt Blue=60"];
    let all = [&["correct", &library, &standard, &batch], &made[..]].concat();
    let run = impasto(&all);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.out.contains("500 g") && run.out.contains("Cobalt Blue"), "{}", run.out);
    assert!(run.out.contains("the least addition first"), "{}", run.out);
    let json = impasto(&[&all[..], &["--json", "--at-most", "1"]].concat()).json();
    let first = &json["corrections"][0];
    assert_eq!(first["additions"][0]["name"], "Cobalt Blue");
    // 12 parts to 88 instead of 8 are 23 g more; less is within the tolerance.
    let grams = first["grams"].as_f64().unwrap();
    assert!((10.0..23.0).contains(&grams), "{grams}");
    assert!(first["delta_e"]["D65"].as_f64().unwrap() <= 0.5, "{first}");
    let spectral = impasto(&[&all[..], &["--by", "spectrum"]].concat()).out;
    assert!(spectral.contains("within 0.5 % of reflectance of the target"), "{spectral}");
    assert!(spectral.contains("; reflectance 0."), "{spectral}");
    let short = ["--stock", "cobalt=5", "--only", "Cobalt Blue"];
    let run = impasto(&[&all[..], &short].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.out.contains("no addition comes within 0.5 CIEDE2000"), "{}", run.out);
    assert!(run.out.contains("(all that is in stock)"), "{}", run.out);
    let near = [&["correct", &library, &standard, &standard], &made[..]].concat();
    assert!(impasto(&near).out.contains("nothing to add"));
}

#[test]
fn faults_name_the_option_and_the_way_out() {
    let folder = tempfile::tempdir().unwrap();
    let file = spectra(&folder);
    let library = repository("measurements/van-gogh-oils.pigments.json");
    let standard = format!("{file}#standard");
    let batch = format!("{file}#batch");
    for (target, pot, options, status, words) in [
        (standard.as_str(), file.as_str(), vec!["--made", "Zinc White=1"], 2, "holds 2"),
        (&standard, "#808080", vec!["--made", "Zinc White=1"], 2, "a batch is a measured spectrum"),
        (&standard, &batch, vec!["--made", "Zinc White"], 2, "--made takes PIGMENT=GRAMS"),
        (&standard, &batch, vec!["--made", "Gold=1"], 1, "`Gold`"),
        (&standard, &batch, vec!["--made", "Zinc White=1", "--grams", "0"], 2, "try --grams 500"),
        (&standard, &batch, vec!["--made", "Zinc White=1", "--least", "0"], 2, "try --least 0.1"),
    ] {
        let all = [&["correct", &library, target, pot], &options[..]].concat();
        let run = impasto(&all);
        assert_eq!(run.status, status, "{options:?}: {}", run.err);
        assert!(run.err.contains(words) && run.err.contains("hint: "), "{options:?}: {}", run.err);
        assert!(run.out.is_empty(), "{}", run.out);
    }
}
