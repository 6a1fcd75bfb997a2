//! `impasto library export`: palettes, CxF spectra and tables of K and S for other programs.

use spectra::color::{Adaptation, Lab, RgbSpace, delta_e_cie76};
use spectra::swatch_file::{SwatchColor, SwatchFile, d50_white, read_aco, read_ase, read_gpl};
use suite::program::impasto;

use crate::{Shelf, done, oils, read, refused};

/// Exports the oils as `format` with the further arguments `more`, and reads the file back.
fn exported(format: &str, more: &[&str]) -> SwatchFile {
    let shelf = Shelf::new();
    let file = shelf.path("palette");
    done(&[&["export", &oils(), "--to", format, "--output", &file], more].concat());
    let bytes = std::fs::read(&file).unwrap();
    let palette = match format {
        "gpl" => read_gpl(&file, &bytes),
        "ase" => read_ase(&file, &bytes),
        _ => read_aco(&file, &bytes),
    };
    palette.unwrap()
}

#[test]
fn each_palette_holds_the_colors_that_list_prints() {
    let list = done(&["list", &oils(), "--json"]).json();
    for format in ["gpl", "ase", "aco"] {
        let palette = exported(format, &[]);
        assert_eq!(palette.swatches.len(), 20);
        for (swatch, line) in palette.swatches.iter().zip(list.as_array().unwrap()) {
            assert_eq!(line["name"], swatch.name.as_str());
            assert_eq!(line["hex"], swatch.color.srgb().unwrap().to_hex(), "{format}");
        }
    }
    assert_eq!(exported("gpl", &[]).name, "Van Gogh's oils");
}

#[test]
fn lab_of_a_palette_is_the_same_color_under_d50() {
    for format in ["ase", "aco"] {
        let lab = exported(format, &["--space", "lab"]);
        let rgb = exported(format, &[]);
        for (lab, rgb) in lab.swatches.iter().zip(&rgb.swatches) {
            let (SwatchColor::Lab(found), SwatchColor::Rgb(rgb)) = (lab.color, rgb.color) else {
                panic!("{format}: {lab:?}")
            };
            if rgb.0.iter().any(|v| *v <= 0.0 || *v >= 1.0) {
                continue;
            }
            let white = d50_white();
            let xyz = RgbSpace::Srgb.xyz_from_encoded(rgb, white, Adaptation::Bradford);
            let off = delta_e_cie76(found, Lab::from_xyz(xyz, white));
            assert!(off < 0.03, "{format} {}: {off}", lab.name);
        }
    }
    // White of D50 in ISO 11664-2: 96.42, 100, 82.51.
    suite::near::assert_near("D50", &d50_white().to_array(), &[96.42, 100.0, 82.51], 0.01);
}

#[test]
fn tints_stand_beside_their_pigment() {
    let palette = exported("ase", &["--tints"]);
    assert_eq!(palette.swatches.len(), 20 + 3 * 17, "all but the white and two unknown S");
    let names: Vec<&str> = palette.swatches.iter().map(|s| s.name.as_str()).take(4).collect();
    assert_eq!(
        names[1..],
        ["Eosin Lake (wax) 1:1", "Eosin Lake (wax) 1:4", "Eosin Lake (wax) 1:9"]
    );
    assert!(palette.swatches[..4].iter().all(|s| s.group == "Eosin Lake (wax)"));
    let mix = impasto(&["mix", &oils(), "Eosin Lake (wax)=1", "Zinc White=9", "--json"]).json();
    assert_eq!(mix["hex"], palette.swatches[3].color.srgb().unwrap().to_hex());
    let one = exported("gpl", &["--tints=2.5"]);
    assert_eq!(one.swatches[1].name, "Eosin Lake (wax) 1:2.5");
    let shelf = Shelf::new();
    let file = shelf.path("x");
    refused(&["export", &oils(), "--to", "gpl", "--tints=-1", "--output", &file], 2, &["`-1`"]);
    refused(&["export", &oils(), "--to", "csv", "--tints", "--output", &file], 2, &["no tints"]);
    refused(&["export", &oils(), "--to", "gpl", "--space", "lab", "--output", &file], 2, &["Lab"]);
}

#[test]
fn cxf_holds_the_spectra_that_mix_predicts() {
    let shelf = Shelf::new();
    let file = shelf.path("oils.cxf");
    done(&["export", &oils(), "--to", "cxf", "--tints=4", "--output", &file]);
    let bytes = std::fs::read(&file).unwrap();
    let records = spectra::instrument::read(&file, &bytes, None).unwrap().spectra;
    assert_eq!(records.len(), 20 + 17);
    for recipe in [&["Viridian=1"][..], &["Viridian=1", "Zinc White=4"]] {
        let mix = impasto(&[&["mix", &oils()], recipe, &["--json"]].concat()).json();
        let name = if recipe.len() == 1 { "Viridian" } else { "Viridian 1:4" };
        let found = records.iter().find(|record| record.name == name).unwrap();
        let wanted = mix["reflectance"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap());
        suite::near::assert_near(name, &found.values, &wanted.collect::<Vec<f64>>(), 1e-6);
    }
}

#[test]
fn what_srgb_cannot_show_is_said() {
    let shelf = Shelf::new();
    let file = shelf.path("x.gpl");
    let run = done(&["export", &oils(), "--to", "gpl", "--output", &file]);
    assert!(run.err.contains("outside sRGB") && run.err.contains("Emerald Green"), "{}", run.err);
    assert!(!run.err.contains("Viridian"), "{}", run.err);
}

#[test]
fn a_table_of_curves_makes_the_same_library_again() {
    let shelf = Shelf::new();
    let csv = shelf.path("curves.csv");
    let json = shelf.path("again.json");
    done(&["export", &oils(), "--to", "csv", "--output", &csv]);
    done(&["convert", &csv, "--output", &json, "--title", "Oils"]);
    let first = read(&oils());
    let again = read(&json);
    assert_eq!((again.reference.as_deref(), again.title.as_str()), (Some("Zinc White"), "Oils"));
    assert_eq!((again.grid, again.saunderson), (first.grid, first.saunderson));
    for (a, b) in first.pigments.iter().zip(&again.pigments) {
        let curves = |p: &calibrate::library::Pigment| {
            [&p.absorption, &p.scattering, &p.absorption_sd, &p.scattering_sd].map(Clone::clone)
        };
        assert_eq!((curves(a), a.identified, &a.name), (curves(b), b.identified, &b.name));
    }
    assert!(again.inputs[0].path.ends_with("curves.csv"));
}

#[test]
fn a_faulty_table_is_refused_with_its_place() {
    let shelf = Shelf::new();
    let csv = shelf.path("curves.csv");
    let json = shelf.path("out.json");
    let head = "pigment,quantity,400,500,600";
    for (text, words) in [
        ("name,quantity,400\n", &["row 1", "`pigment`"][..]),
        ("pigment,quantity,400,500,610\nA,K,1,1,1\n", &["row 1", "constant step"]),
        ("pigment,quantity,400,x,600\nA,K,1,1,1\n", &["row 1", "column `x`"]),
        (&format!("{head}\nA,K,1,-1,1\nA,S,1,1,1\n"), &["row 2", "column `500`", "`-1`"]),
        (&format!("{head}\nA,K,1,nan,1\nA,S,1,1,1\n"), &["row 2", "`nan`"]),
        (&format!("{head}\nA,K,1,1,1\nA,T,1,1,1\n"), &["row 3", "`T`"]),
        (&format!("{head}\nA,K,1,1,1\nA,K,1,1,1\n"), &["row 3", "one row for each"]),
        (&format!("{head}\nA,K,1,1,1\n"), &["pigment A", "`scattering`"]),
        (&format!("{head}\nA,K,1,1\n"), &["row 2", "5 cells", "`4`"]),
        (&format!("{head}\nA,K,1,1,1\nA,S,2,2,2\n"), &["S = 1", "`0`", "--white"]),
        (&format!("{head}\n"), &["no pigment"]),
        ("", &["row 1", "`pigment`"]),
    ] {
        std::fs::write(&csv, text).unwrap();
        let run = crate::tried(&["convert", &csv, "--output", &json]);
        assert_eq!(run.status, 1, "{text}: {}", run.err);
        for word in words.iter().chain(&["curves.csv"]) {
            assert!(run.err.contains(word), "{word}: {}", run.err);
        }
    }
    std::fs::write(&csv, format!("{head}\nA,K,1,1,1\nA,S,2,2,2\nB,K/S,1,2,3\n")).unwrap();
    done(&["convert", &csv, "--reference", "A", "--output", &json]);
    let library = read(&json);
    assert_eq!(library.pigments[0].absorption, [0.5; 3]);
    assert!(!library.pigments[1].identified, "K/S alone");
}
