//! `impasto fit` on files with one fault each: exit status 1, an error with place and reason, and
//! no output file.

use suite::program::{Run, impasto};

/// A small valid file; each test changes it to make one fault.
const SOUND: &str = "\
sample,film,backing,White,Red,400,410,420
a,paint,card,100,,90,91,92
b,paint,card,,100,10,11,60
c,paint,card,50,50,20,22,70
d,paint,card,90,10,40,42,80
";

/// Runs `fit` on a file of these bytes. Asserts that only a successful run leaves a file, the
/// library.
fn fit(bytes: &[u8]) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("bad.csv");
    std::fs::write(&file, bytes).unwrap();
    let output = folder.path().join("library.json");
    let run = impasto(&["fit", file.to_str().unwrap(), "--output", output.to_str().unwrap()]);
    let left: Vec<_> = std::fs::read_dir(folder.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .filter(|name| name != "bad.csv")
        .collect();
    if run.status == 0 {
        assert_eq!(left, ["library.json"], "{}", run.err);
    } else {
        assert!(left.is_empty(), "half-written: {left:?}");
    }
    run
}

/// Asserts that the file is refused with an error that contains all of `words`.
fn refused(bytes: &[u8], words: &[&str]) {
    let run = fit(bytes);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.out.is_empty(), "{}", run.out);
    assert!(run.err.contains("error: ") && run.err.contains("bad.csv"), "{}", run.err);
    for word in words {
        assert!(run.err.contains(word), "`{word}` is missing: {}", run.err);
    }
}

fn changed(from: &str, to: &str) -> Vec<u8> {
    assert!(SOUND.contains(from), "the sound file holds `{from}`");
    SOUND.replacen(from, to, 1).into_bytes()
}

#[test]
fn the_sound_file_is_fitted() {
    let run = fit(SOUND.as_bytes());
    assert_eq!(run.status, 0, "{}", run.err);
}

#[test]
fn decimal_commas_unquoted() {
    refused(&changed("10,11,60", "10,5,11,2,60,1"), &["row 3", "8 cells", "`11`", "decimal"]);
}

#[test]
fn quoted_decimal_commas_among_decimal_points() {
    refused(&changed("10,11,60", "\"10,5\",11.5,60"), &["row 3", "`410`", "`11.5`"]);
    let plain = fit(SOUND.replace("10,11,60", "10.5,11,60").as_bytes());
    let quoted = fit(SOUND.replace("10,11,60", "\"10,5\",11,60").as_bytes());
    assert_eq!((quoted.status, &quoted.out), (0, &plain.out), "{}", quoted.err);
}

#[test]
fn semicolons_without_a_sample_column() {
    let file = SOUND.replace("sample", "paint").replace(',', ";");
    refused(file.as_bytes(), &["row 1", "no column `sample`"]);
}

#[test]
fn points_among_decimal_commas() {
    let file = SOUND.replace(',', ";").replace("10;11;60", "10,5;1.011;60");
    refused(file.as_bytes(), &["row 3", "`410`", "`1.011`"]);
}

#[test]
fn semicolons_tabs_and_decimal_commas_are_read() {
    let plain = fit(SOUND.replace("10,11,60", "10.5,11,60").as_bytes());
    for separator in [";", "\t"] {
        let file = SOUND.replace(',', separator);
        let cells = ["10", "11", "60"].join(separator);
        assert!(file.contains(&cells), "{file}");
        let run = fit(file.replace(&cells, &cells.replace("10", "10,5")).as_bytes());
        assert_eq!((run.status, &run.out), (0, &plain.out), "{}", run.err);
    }
}

#[test]
fn missing_sample_column() {
    refused(&changed("sample,", "paint,"), &["row 1", "no column `sample`"]);
}

#[test]
fn no_wavelengths_at_all() {
    refused(b"sample,White\na,1\n", &["no column `400 (a wavelength in nm)`"]);
}

#[test]
fn repeated_wavelength() {
    refused(&changed("400,410,420", "400,410,410nm"), &["row 1", "410 nm occurs twice"]);
}

#[test]
fn repeated_pigment() {
    refused(&changed("White,Red", "Red,Red"), &["`Red` occurs twice", "4", "5"]);
}

#[test]
fn wavelengths_in_no_order() {
    refused(&changed("400,410,420", "420,400,410"), &["row 1", "410 nm after 400 nm", "hint"]);
}

#[test]
fn percent_mixed_with_fractions() {
    refused(&changed("20,22,70", "0.20,0.22,0.70"), &["row 4", "`0.7`", "hint", "--percent"]);
}

#[test]
fn nan() {
    refused(&changed("10,11,60", "10,NaN,60"), &["row 3", "`410`", "`NaN`"]);
}

#[test]
fn infinite_reflectance() {
    refused(&changed("10,11,60", "10,inf,60"), &["row 3", "`410`", "`inf`"]);
}

#[test]
fn negative_reflectance() {
    refused(&changed("10,11,60", "-10,11,60"), &["row 3", "`400`", "`-10`", "from 0 to 200 %"]);
}

#[test]
fn negative_amount() {
    refused(&changed("90,10,40", "90,-10,40"), &["row 5", "`Red`", "`-10`"]);
}

#[test]
fn amount_that_is_no_number() {
    refused(&changed("90,10,40", "90,some,40"), &["row 5", "`Red`", "`some`"]);
}

#[test]
fn amount_beyond_any_measure() {
    refused(&changed("90,10,40", "90,1.7e308,40"), &["row 5", "`Red`", "`1.7e308`"]);
}

#[test]
fn bare_cards_alone() {
    let run = fit(SOUND.replace("paint", "none").as_bytes());
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("no row is a film of paint"), "{}", run.err);
}

#[test]
fn control_characters_in_a_name() {
    refused(&changed("b,paint", "b\x1b[31m,paint"), &["row 3", "control characters"]);
}

#[test]
fn paint_without_a_recipe() {
    refused(&changed("50,50,20", ",,20"), &["row 4", "sample c"]);
}

#[test]
fn unknown_film() {
    refused(&changed("a,paint", "a,glass"), &["row 2", "`film`", "`glass`"]);
}

#[test]
fn empty_file() {
    refused(b"", &["holds no readings"]);
    refused(b"\n\n", &["holds no readings"]);
}

#[test]
fn header_alone() {
    refused(b"sample,White,400\n", &["holds no readings"]);
}

#[test]
fn truncated_row() {
    refused(
        &changed("d,paint,card,90,10,40,42,80\n", "d,paint,card,90,1"),
        &["row 5", "8 cells", "`5`"],
    );
}

#[test]
fn latin_1_bytes_are_read_and_said() {
    let mut bytes = changed("Red", "Gr?n");
    let at = bytes.iter().position(|&b| b == b'?').unwrap();
    bytes[at] = 0xfc;
    let run = fit(&bytes);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.err.contains("windows-1252"), "{}", run.err);
}

#[test]
fn contradicting_recipes_of_one_sample() {
    refused(&changed("d,paint,card,90,10", "c,paint,black,90,10"), &["row 5", "sample c", "row 4"]);
}

#[test]
fn a_reading_below_a_k1_that_was_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("dark.csv");
    std::fs::write(&file, SOUND.replace("10,11,60", "2,11,60")).unwrap();
    let path = file.to_str().unwrap();
    let run = impasto(&["fit", path, "--saunderson", "0.03,0.6"]);
    assert_eq!(run.status, 1, "{}", run.err);
    for word in ["row 3", "sample b", "400 nm", "k1 = 0.03", "--saunderson 0.019,0.6"] {
        assert!(run.err.contains(word), "`{word}` is missing: {}", run.err);
    }
    let floored =
        impasto(&["fit", path, "--saunderson", "0.03,0.6", "--below-surface", "floor", "--json"]);
    assert_eq!(floored.status, 0, "{}", floored.err);
    assert!(floored.out.contains("b (1)"), "the reading is named: {}", floored.out);
}
