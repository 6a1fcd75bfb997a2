//! Instrument files with faults or with other quantities than reflectance: refused with the place
//! and a hint.

use suite::program::{Run, impasto};

use super::fixture;

/// Runs `color` on a fixture in which the first `from` is replaced by `to`.
fn color(name: &str, from: &str, to: &str) -> Run {
    let bytes = std::fs::read(fixture(name)).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    assert!(text.contains(from), "{name} holds `{from}`");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(name);
    std::fs::write(&file, text.replacen(from, to, 1)).unwrap();
    impasto(&["color", file.to_str().unwrap()])
}

#[test]
fn faults_are_refused_with_file_and_line() {
    for (name, from, to, words) in [
        ("two.cgats", "0.105", "NaN", &["line 10", "`NaN`"][..]),
        ("two.cgats", "NUMBER_OF_SETS 2", "NUMBER_OF_SETS 3", &["line 12", "states 3", "`2`"]),
        ("two.cgats", "END_DATA\n", "", &["END_DATA"]),
        ("two.cgats", "SPECTRAL_NM450", "SPECTRAL_NM400", &["400 nm occurs twice", "hint"]),
        ("two.qtx", "20, 10.5", "20, ten", &["line 7", "`ten`"]),
        ("two.qtx", "20, 10.5, ", "20, ", &["line 7", "states 7", "hint"]),
        ("spectrasuite.txt", "400,00\t20", "400,00\tinf", &["line 10", "`inf`"]),
        ("madder.jaz", "500.0\t998.0", "500.0", &["line 11", "as many values"]),
        ("packed.jdx", "550F1", "550F2", &["line 13", "check"]),
        ("points.jdx", "450, 10.5", "450", &["line 17", "pairs"]),
        ("madder.ttt", "10.5000", "--", &["line 7", "`--`"]),
        ("madder.dpt", "450.00000,0.10500", "350.00000,0.10500", &["line 3", "rise or fall"]),
        (
            "madder.dpt",
            "500.00000,0.12000",
            "500.00000,-0.1200",
            &["row 1, column `500 nm`", "`-0.12`"],
        ),
    ] {
        let run = color(name, from, to);
        assert_eq!(run.status, 1, "{name}, {to}: {}{}", run.out, run.err);
        assert!(run.err.contains(name) && run.out.is_empty(), "{}", run.err);
        for word in words {
            assert!(run.err.contains(word), "{name}: `{word}` is missing: {}", run.err);
        }
    }
}

#[test]
fn other_quantities_are_refused_with_the_way_out() {
    for (name, from, to, words) in [
        ("madder.sp", "REFLECTIVE", "EMISSION", &["the power of a light", "--illuminant"]),
        (
            "spectrasuite.txt",
            "Spectrum Present: Yes\r\nN",
            "Spectrum Present: No\r\nN",
            &["counts", "--white"],
        ),
    ] {
        let run = color(name, from, to);
        assert_eq!(run.status, 1, "{name}: {}", run.err);
        for word in words {
            assert!(run.err.contains(word), "{name}: `{word}` is missing: {}", run.err);
        }
    }
}

#[test]
fn transmittance_is_reflectance_where_that_is_told() {
    let text = std::fs::read_to_string(fixture("madder.ttt")).unwrap();
    // Avantes names the quantity in two places.
    let text = text.replace("Reflectance", "Transmittance").replace("% reflectance", "%");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("madder.ttt");
    std::fs::write(&file, text).unwrap();
    let run = impasto(&["color", file.to_str().unwrap()]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(
        run.err.contains("transmittance") && run.err.contains("--as-reflectance"),
        "{}",
        run.err
    );
    let told = impasto(&["color", file.to_str().unwrap(), "--as-reflectance"]);
    let same = impasto(&["color", &fixture("madder.ttt")]);
    assert_eq!((told.status, told.out), (0, same.out), "{}", told.err);
}

#[test]
fn spectra_on_different_wavelengths_are_brought_together_or_refused() {
    let short = color("two.qtx", "BAT_REFLLOW=400", "BAT_REFLLOW=500");
    assert_eq!(short.status, 0, "{}", short.err);
    assert!(short.err.contains("500 to 700 nm"), "{}", short.err);
    let apart = color("two.qtx", "BAT_REFLLOW=400", "BAT_REFLLOW=750");
    assert_eq!(apart.status, 1, "{}", apart.err);
    for word in ["Madder ends at 700", "Slate begins at 750", "hint"] {
        assert!(apart.err.contains(word), "`{word}` is missing: {}", apart.err);
    }
}

#[test]
fn a_format_that_is_told_is_the_one_that_is_read() {
    let run = impasto(&["color", &fixture("madder.dpt"), "--format", "columns"]);
    assert!(run.status == 0 && run.err.contains("columns of text"), "{}", run.err);
    let run = impasto(&["color", &fixture("madder.dpt"), "--format", "qtx"]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("no spectrum in this Datacolor QTX file"), "{}", run.err);
    let run = impasto(&["color", &fixture("madder.dpt"), "--format", "csv"]);
    assert!(run.status == 1 && run.err.contains("row 1, column `0.20000`"), "{}", run.err);
    let run = impasto(&["color", &fixture("madder.dpt"), "--format", "xls"]);
    assert_eq!(run.status, 2, "{}", run.err);
}
