//! Lamps read from instrument files: sampling, choice by name, hints of errors.

use std::path::Path;

use documents::hint::Explain;
use spectra::instrument::ChoiceError;
use spectra::{Illuminant, LampError, LightError, lamp_from_bytes, light_from_text};
use suite::program::impasto;

use super::{fixture, records};

fn at(light: &Illuminant, nm: usize) -> f64 {
    light.power().values()[nm - 360]
}

#[test]
fn a_tm27_lamp_keeps_its_line() {
    let lamp = lamp_from_bytes("lamp.spdx", &fixture("lamp.spdx"), None).unwrap();
    assert_eq!((at(&lamp, 360), at(&lamp, 544), at(&lamp, 830)), (0.2, 1.0, 0.4));
    assert_eq!(records("f", &fixture("lamp.spdx")).unwrap()[0].name, "made-up lamp");
}

#[test]
fn a_sekonic_lamp_is_read_at_its_finest() {
    let bytes = fixture("sekonic.csv");
    let lamp = lamp_from_bytes("sekonic.csv", &bytes, None).unwrap();
    assert_eq!((at(&lamp, 381), at(&lamp, 382)), (0.21, 0.25));
    let text = String::from_utf8(bytes).unwrap();
    let wide: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    assert_eq!(lamp_from_bytes("sekonic.csv", &wide, None).unwrap(), lamp, "UTF-16");
}

#[test]
fn a_light_meters_file_is_a_lamp_and_no_reflectance() {
    let lamp = lamp_from_bytes("li180.txt", &fixture("li180.txt"), None).unwrap();
    assert_eq!((at(&lamp, 380), at(&lamp, 430), at(&lamp, 780)), (0.88, 0.93, 2.0));
    let folder = tempfile::tempdir().unwrap();
    let file =
        write(folder.path(), "li180.txt", std::str::from_utf8(&fixture("li180.txt")).unwrap());
    let run = impasto(&["color", &file]);
    assert_eq!(run.status, 1, "{}", run.err);
    for word in ["li180 is the power of a light", "--illuminant"] {
        assert!(run.err.contains(word), "`{word}` is missing: {}", run.err);
    }
}

#[test]
fn a_lamp_is_chosen_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("conditions.cxf");
    std::fs::write(&file, fixture("conditions.cxf")).unwrap();
    let file = file.to_str().unwrap();
    let lamp = light_from_text(&format!("{file}#Viewing lamp")).unwrap();
    assert_eq!((at(&lamp, 450), at(&lamp, 700)), (0.0015, 0.004));
    let several = light_from_text(file).unwrap_err();
    assert!(
        matches!(
            several,
            LightError::Lamp(LampError::Choice(ChoiceError::Several { count: 3, .. }))
        ),
        "{several}"
    );
    assert!(several.hint().unwrap().to_string().contains("#Viewing lamp"), "{several}");
    let paint = light_from_text(&format!("{file}#Blue & white (M0)")).unwrap_err();
    assert!(matches!(paint, LightError::Lamp(LampError::Quantity { .. })), "{paint}");
}

#[test]
fn a_refused_lamp_says_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let spectra = write(folder.path(), "grey.csv", "sample,400,500,600,700\ngrey,1,1,1,1\n");
    let lamp = write(folder.path(), "paint.txt", "nm\treflectance\n400\t0.1\n700\t0.2\n");
    let run = impasto(&["color", &spectra, "--illuminant", &lamp]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("paint.txt: `") && run.err.contains("`reflectance`"), "{}", run.err);
    assert!(run.err.contains("hint: a lamp is a spectrum of power"), "{}", run.err);
}

fn write(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}
