//! `impasto demo`: its output, and that it reproduces the shipped library.

use suite::program::{impasto, repository};

#[test]
fn the_shipped_library_is_what_the_demo_makes_byte_for_byte() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("deep/out");
    let run = impasto(&["demo", "--out", out.to_str().unwrap()]);
    assert_eq!(run.status, 0, "{}", run.err);
    let made = std::fs::read_to_string(out.join("van-gogh-oils.pigments.json")).unwrap();
    let shipped = repository("measurements/van-gogh-oils.pigments.json");
    let same = std::fs::read_to_string(shipped).unwrap() == made;
    assert!(same, "to renew it: cargo run --release -- demo --out measurements");
}

#[test]
fn the_demo_shows_pigments_errors_findings_and_mixtures() {
    let folder = tempfile::tempdir().unwrap();
    let run = impasto(&["demo", "--out", folder.path().to_str().unwrap()]);
    for word in ["Viridian", "colour error: mean", "not identified", "a sky", "#"] {
        assert!(run.out.contains(word), "`{word}` is missing: {}", run.out);
    }
    assert!(!run.out.contains('\x1b'), "no colour codes where there is no terminal");
    assert!(run.err.contains("Wrote "), "{}", run.err);
}

#[test]
fn the_library_records_its_input() {
    let text = std::fs::read(repository("measurements/van-gogh-oils.csv")).unwrap();
    let library =
        std::fs::read_to_string(repository("measurements/van-gogh-oils.pigments.json")).unwrap();
    let library: serde_json::Value = serde_json::from_str(&library).unwrap();
    let recorded = library["inputs"][0]["sha256"].as_str().unwrap();
    // A fit of the same bytes records the same hash, a fit of other bytes another hash.
    let folder = tempfile::tempdir().unwrap();
    let fitted = |bytes: &[u8]| {
        let csv = folder.path().join("a.csv");
        let out = folder.path().join("a.json");
        std::fs::write(&csv, bytes).unwrap();
        let csv = csv.to_str().unwrap();
        let out = out.to_str().unwrap();
        let run = impasto(&["fit", csv, "--output", out]);
        assert_eq!(run.status, 0, "{}", run.err);
        let text = std::fs::read_to_string(out).unwrap();
        let library: serde_json::Value = serde_json::from_str(&text).unwrap();
        library["inputs"][0]["sha256"].as_str().unwrap().to_owned()
    };
    assert_eq!(fitted(&text), recorded);
    assert_ne!(fitted(&[text, b"\n".to_vec()].concat()), recorded);
}
