//! `impasto library export`: palettes, CxF spectra and tables of K and S for other programs, a round trip of
//! random palettes in swatch files (ASE, ACO, GPL), and errors of faulty ones. Also pigments
//! guessed from a colour: mixing gives the colour back, and the guess is marked.

use calibrate::PigmentId;
use calibrate::curation::{Body, guessed_pigment};
use calibrate::evaluate::Viewing;
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::color::{Adaptation, Lab, Rgb, RgbSpace, delta_e_cie76, delta_e_ciede2000};
use spectra::swatch_file::{
    SwatchColor, SwatchEntry, SwatchFile, d50_white, read_aco, read_ase, read_gpl, write_aco,
    write_ase, write_gpl,
};
use suite::program::impasto;

use crate::{LibraryFolder, done, oils, read, refused};

/// Exports the oils as `format` with `more` arguments, and reads the file back.
fn exported(format: &str, more: &[&str]) -> SwatchFile {
    let folder = LibraryFolder::new();
    let file = folder.path("palette");
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
    suite::golden::assert_near("D50", &d50_white().to_array(), &[96.42, 100.0, 82.51], 0.01);
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
    let folder = LibraryFolder::new();
    let file = folder.path("x");
    refused(&["export", &oils(), "--to", "gpl", "--tints=-1", "--output", &file], 2, &["`-1`"]);
    refused(&["export", &oils(), "--to", "csv", "--tints", "--output", &file], 2, &["no tints"]);
    refused(&["export", &oils(), "--to", "gpl", "--space", "lab", "--output", &file], 2, &["Lab"]);
}

#[test]
fn cxf_holds_the_spectra_that_mix_predicts() {
    let folder = LibraryFolder::new();
    let file = folder.path("oils.cxf");
    done(&["export", &oils(), "--to", "cxf", "--tints=4", "--output", &file]);
    let bytes = std::fs::read(&file).unwrap();
    let records = spectra::instrument::read(&file, &bytes, None).unwrap().spectra;
    assert_eq!(records.len(), 20 + 17);
    for recipe in [&["Viridian=1"][..], &["Viridian=1", "Zinc White=4"]] {
        let mix = impasto(&[&["mix", &oils()], recipe, &["--json"]].concat()).json();
        let name = if recipe.len() == 1 { "Viridian" } else { "Viridian 1:4" };
        let found = records.iter().find(|record| record.name == name).unwrap();
        let wanted = mix["reflectance"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap());
        suite::golden::assert_near(name, &found.values, &wanted.collect::<Vec<f64>>(), 1e-6);
    }
}

#[test]
fn what_srgb_cannot_show_is_said() {
    let folder = LibraryFolder::new();
    let file = folder.path("x.gpl");
    let run = done(&["export", &oils(), "--to", "gpl", "--output", &file]);
    assert!(run.err.contains("outside sRGB") && run.err.contains("Emerald Green"), "{}", run.err);
    assert!(!run.err.contains("Viridian"), "{}", run.err);
}

#[test]
fn a_table_of_curves_makes_the_same_library_again() {
    let folder = LibraryFolder::new();
    let csv = folder.path("curves.csv");
    let json = folder.path("again.json");
    done(&["export", &oils(), "--to", "csv", "--output", &csv]);
    done(&["convert", &csv, "--output", &json, "--title", "Oils"]);
    let first = read(&oils());
    let again = read(&json);
    assert_eq!((again.reference.as_deref(), again.title.as_str()), (Some("Zinc White"), "Oils"));
    assert_eq!((again.grid, again.saunderson), (first.grid, first.saunderson));
    for (a, b) in first.pigments.iter().zip(&again.pigments) {
        let [one, other] = [a, b].map(|p| {
            (
                [&p.absorption, &p.scattering, &p.absorption_sd, &p.scattering_sd],
                p.identified,
                &p.name,
            )
        });
        assert_eq!(one, other);
    }
    assert!(again.inputs[0].path.ends_with("curves.csv"));
}

#[test]
fn a_faulty_table_is_refused_with_its_place() {
    let folder = LibraryFolder::new();
    let csv = folder.path("curves.csv");
    let json = folder.path("out.json");
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
        (&format!("{head}\nA,K,1,1,1\nA,K/S,1,1,1\n"), &["pigment A", "`scattering`"]),
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

/// Colours with components that are exact in 8 bits, in 16 bits and in 32-bit floats.
fn color() -> impl Strategy<Value = SwatchColor> {
    fn step() -> impl Strategy<Value = f64> {
        (0..=1u8).prop_map(f64::from)
    }
    fn quarter(from: i32, to: i32) -> impl Strategy<Value = f64> {
        (from * 4..=to * 4).prop_map(|q| f64::from(q) / 4.0)
    }
    prop_oneof![
        [step(), step(), step()].prop_map(|rgb| SwatchColor::Rgb(Rgb(rgb))),
        (step(), quarter(-128, 127), quarter(-128, 127))
            .prop_map(|(l, a, b)| SwatchColor::Lab(Lab { lightness: 100.0 * l, a, b })),
        [step(), step(), step(), step()].prop_map(SwatchColor::Cmyk),
        step().prop_map(SwatchColor::Grey),
    ]
}

fn palette(groups: &'static str) -> impl Strategy<Value = SwatchFile> {
    let swatch = ("[^\u{0}]{0,9}", groups, color());
    let swatch = swatch.prop_map(|(name, group, color)| SwatchEntry {
        // Readers put blanks in place of characters that nobody sees.
        name: documents::plain_name(&name),
        group,
        color,
    });
    prop::collection::vec(swatch, 0..9)
        .prop_map(|swatches| SwatchFile { name: String::new(), swatches })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..Default::default() })]

    #[test]
    fn ase_is_read_as_written(palette in palette("[ab]{0,1}")) {
        let bytes = write_ase(&palette).unwrap();
        prop_assert_eq!(read_ase("p.ase", &bytes).unwrap(), palette);
    }

    #[test]
    fn aco_is_read_as_written(palette in palette("")) {
        let bytes = write_aco(&palette).unwrap();
        prop_assert_eq!(read_aco("p.aco", &bytes).unwrap(), palette);
    }

    #[test]
    fn gpl_is_read_as_written(rgbs in prop::collection::vec(any::<[u8; 3]>(), 0..9)) {
        let swatches = rgbs.iter().map(|rgb: &[u8; 3]| SwatchEntry {
            name: format!("Rot {rgb:?} \u{fc}"),
            group: String::new(),
            color: SwatchColor::Rgb(Rgb(rgb.map(|v| f64::from(v) / 255.0))),
        }).collect();
        let palette = SwatchFile { name: "Name: of # all".into(), swatches };
        let text = write_gpl(&palette).unwrap();
        prop_assert_eq!(read_gpl("p.gpl", text.as_bytes()).unwrap(), palette);
    }

    #[test]
    fn no_bytes_make_a_reader_panic_and_every_refusal_has_a_place(
        bytes in prop::collection::vec(any::<u8>(), 0..200),
    ) {
        all_say_where(&bytes)?;
    }

    #[test]
    fn nor_do_files_with_a_byte_changed_or_cut_short(
        palette in palette("[ab]{0,1}"),
        at in any::<prop::sample::Index>(),
        byte in any::<u8>(),
        cut in any::<prop::sample::Index>(),
    ) {
        let files = [write_ase(&palette).unwrap(), write_aco(&palette).unwrap()];
        for mut bytes in files {
            let place = at.index(bytes.len());
            bytes[place] = byte;
            all_say_where(&bytes)?;
            bytes.truncate(cut.index(bytes.len()));
            all_say_where(&bytes)?;
            let text = ["GIMP Palette\n".as_bytes(), &bytes].concat();
            all_say_where(&text)?;
        }
    }
}

fn all_say_where(bytes: &[u8]) -> Result<(), TestCaseError> {
    for read in [read_ase, read_aco, read_gpl] {
        if let Err(error) = read("the file", bytes) {
            let said = error.to_string();
            prop_assert!(
                said.starts_with("the file, byte ") || said.starts_with("the file, line ")
            );
        }
    }
    Ok(())
}

#[test]
fn a_small_ase_is_byte_for_byte_as_other_programs_write_it() {
    let swatch = SwatchEntry {
        name: "Red".into(),
        group: String::new(),
        color: SwatchColor::Rgb(Rgb([1.0, 0.0, 0.0])),
    };
    let palette = SwatchFile { name: String::new(), swatches: vec![swatch] };
    let mut wanted = b"ASEF\x00\x01\x00\x00\x00\x00\x00\x01".to_vec();
    wanted.extend(b"\x00\x01\x00\x00\x00\x1c\x00\x04\x00R\x00e\x00d\x00\x00RGB ");
    wanted.extend(b"\x3f\x80\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x02");
    assert_eq!(write_ase(&palette).unwrap(), wanted);
    let mut wanted = b"\x00\x01\x00\x01\x00\x00\xff\xff\x00\x00\x00\x00\x00\x00".to_vec();
    wanted.extend(b"\x00\x02\x00\x01\x00\x00\xff\xff\x00\x00\x00\x00\x00\x00");
    wanted.extend(b"\x00\x00\x00\x04\x00R\x00e\x00d\x00\x00");
    assert_eq!(write_aco(&palette).unwrap(), wanted);
}

#[test]
fn errors_name_file_and_byte_or_line() {
    fn error(result: Result<SwatchFile, spectra::swatch_file::SwatchFileError>) -> String {
        result.unwrap_err().to_string()
    }
    assert_eq!(
        error(read_ase("a.ase", b"ASEX\x00\x01\x00\x00")),
        "a.ase, byte 0: expected `ASEF`, found `ASEX`"
    );
    let wrong = b"ASEF\x00\x01\x00\x00\x00\x00\x00\x01\x00\x01\x00\x00\x00\x08\x00\x01\x00\x00HSV ";
    assert_eq!(
        error(read_ase("a.ase", wrong)),
        "a.ase, byte 22: expected RGB, LAB, CMYK or Gray, found `HSV `"
    );
    assert_eq!(
        error(read_aco("a.aco", b"\x00\x01\x00\x01\x00\x03\x00\x00\x00\x00\x00\x00\x00\x00")),
        "a.aco, byte 4: expected RGB, HSB, CMYK, Lab or grey, found `3`"
    );
    let lines = b"GIMP Palette\nName: x\n#\n 10 20 300\tred\n";
    let said = error(read_gpl("a.gpl", lines));
    assert!(said.starts_with("a.gpl, line 4:") && said.contains("10 20 300"), "{said}");
    assert!(error(read_gpl("a.gpl", b"RIFF")).starts_with("a.gpl, line 1:"));
    assert!(error(read_gpl("a.gpl", b"GIMP Palette\n\xff")).contains("byte 13"));
}

#[test]
fn hue_saturation_and_brightness_are_read_as_rgb() {
    // A hue of 120 degrees is green at full saturation and brightness.
    let bytes = b"\x00\x01\x00\x01\x00\x01\x55\x55\xff\xff\xff\xff\x00\x00";
    let SwatchColor::Rgb(rgb) = read_aco("a.aco", bytes).unwrap().swatches[0].color else {
        panic!("RGB")
    };
    assert_eq!(rgb.to_hex(), "#00ff00");
}

#[test]
fn a_thousand_colors_come_back_from_mixing() {
    let folder = LibraryFolder::new();
    let start = folder.path("white.json");
    done(&["from-rgb", "#f4f4f0", "--name", "White", "--output", &start]);
    let mut library = read(&start);
    let weights = Viewing::default().weights(library.grid).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(20);
    let mut met = 0;
    let mut missed = 0;
    for number in 0..1000 {
        let rgb = Rgb(std::array::from_fn(|_| random.random_range(0.0..1.0)));
        let wanted = RgbSpace::Srgb.xyz_from_encoded(rgb, weights.white(), Adaptation::Bradford);
        let body = if number % 2 == 0 { Body::Hiding } else { Body::Glaze };
        let Ok(guess) = guessed_pigment(&library, ("x", "x"), wanted, body, false) else {
            let least = rgb.linear().0.into_iter().fold(1.0, f64::min);
            assert!(least < library.saunderson.k1, "{} was not met", rgb.to_hex());
            missed += 1;
            continue;
        };
        library.pigments.truncate(1);
        library.pigments.push(guess.pigment);
        let mixture = library.mix([(PigmentId(1), 1.0)]).unwrap();
        let film = match body {
            Body::Hiding => mixture.hiding(library.saunderson),
            Body::Glaze => mixture.film(1.0, &[1.0; 31], library.film()),
        };
        let [wanted, found] =
            [wanted, weights.xyz(&film)].map(|xyz| Lab::from_xyz(xyz, weights.white()));
        let off = delta_e_ciede2000(wanted, found);
        assert!(
            off < 0.05 && film.iter().all(|r| *r > 0.03 && *r < 1.0),
            "{}: {off}",
            rgb.to_hex()
        );
        met += 1;
    }
    assert!(met > 850, "{met} met, {missed} below the surface's own reflection");
}

#[test]
fn a_guess_joins_a_library_and_is_marked_everywhere() {
    let folder = LibraryFolder::new();
    let with = folder.path("with.json");
    let run = done(&["from-rgb", &oils(), "#2a5caa", "--name", "Sky", "--output", &with]);
    assert!(run.out.contains("#2a5caa, 0.000 CIEDE2000"), "{}", run.out);
    let library = read(&with);
    assert_eq!(library.pigments.len(), 21);
    assert_eq!(library.pigments[..20], read(&oils()).pigments);
    assert!(library.pigments[20].guessed && library.pigments[20].identified);
    let mix = impasto(&["mix", &with, "Sky=1"]);
    assert!(
        mix.out.contains("#2a5caa") && mix.err.contains("warning: Sky: guessed"),
        "{}",
        mix.err
    );
    let list = done(&["list", &with]).out;
    assert!(
        list.lines().any(|line| line.starts_with("Sky ") && line.ends_with("guessed")),
        "{list}"
    );
    assert_eq!(done(&["list", &with, "--json"]).json()[20]["guessed"], true);
    let show = done(&["show", &with, "Sky"]).out;
    assert!(show.contains("Sky (guessed)") && show.contains("guessed from #2a5caa"), "{show}");
    assert!(done(&["check", &with]).out.contains("Sky: guessed from a colour"));
    let taken = ["from-rgb", &with, "#2a5caa", "--name", "Viridian", "--output", &oils()];
    assert_eq!(crate::tried(&taken).status, 1);
}

#[test]
fn a_glaze_shows_its_color_over_white_and_its_ground_elsewhere() {
    let folder = LibraryFolder::new();
    let with = folder.path("with.json");
    let glaze = ["from-rgb", &oils(), "lab(60, 40, 20)", "--name", "Rose", "--glaze"];
    done(&[&glaze[..], &["--output", &with]].concat());
    let [on_white, on_black] = ["white", "black"].map(|over| -> Vec<f64> {
        let mix = impasto(&["mix", &with, "Rose=1", "--thickness", "1", "--over", over, "--json"]);
        mix.json()["lab"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
    });
    suite::golden::assert_near("over white", &on_white, &[60.0, 40.0, 20.0], 0.01);
    assert!(on_black[0] < 30.0, "{on_black:?}");
}

#[test]
fn a_color_out_of_reach_is_refused_with_the_nearest() {
    let folder = LibraryFolder::new();
    let new = folder.path("new.json");
    let black = ["from-rgb", "#000000", "--name", "Black", "--output", &new];
    refused(&black, 1, &["k1 = 0.03", "the nearest is 12.", "`#313131`", "--nearest"]);
    assert!(!std::path::Path::new(&new).exists(), "nothing written");
    let run = done(&[&black[..], &["--nearest"]].concat());
    assert!(run.err.contains("warning: #000000 is out of reach"), "{}", run.err);
    done(&[&black[..], &["--saunderson", "none", "--nearest"]].concat());
    assert!(read(&new).saunderson.k1 == 0.0 && read(&new).reference.as_deref() == Some("Black"));
    for color in ["red", "#12345", "lab(1,2)", "lab(101,0,0)", "lab(nan,0,0)"] {
        refused(&["from-rgb", color, "--name", "X", "--output", &new], 2, &[color]);
    }
}

#[test]
fn options_may_stand_between_library_and_color() {
    let folder = LibraryFolder::new();
    let bare = folder.path("bare.json");
    let between = folder.path("between.json");
    done(&["from-rgb", &oils(), "40,5,-45", "--name", "Sky", "--output", &bare]);
    done(&["from-rgb", &oils(), "--name", "Sky", "lab(40, 5, -45)", "--output", &between]);
    let [one, other] = [&bare, &between].map(|path| read(path).pigments.pop().unwrap().absorption);
    assert_eq!(one, other);
    let new = folder.path("new.json");
    done(&["from-rgb", "--name", "White", "--output", &new, "#f4f4f0"]);
    let list = impasto(&["library", "list", &new]);
    assert!(list.out.contains("S = 1 for White"), "{}", list.out);
    let three = ["from-rgb", &oils(), "40,", "5", "--name", "X", "--output", &bare];
    refused(&three, 2, &["found `3` arguments"]);
}
