//! Layouts of tables as strangers bring them: geometries, doses, deviations, notes above the rows, colours
//! beside them, long tables, other languages. Every layout is read with commas, semicolons, tabs, decimal
//! commas and as a workbook, and gives the same samples. Spectra are flat, so that Y is the reflectance.

use suite::golden::assert_near;
use suite::program::{Run, impasto};

use super::workbooks::workbook;

/// A layout: its name, its text with commas and decimal points, the expected samples with their Y, and words
/// of the expected remark.
type Layout = (&'static str, String, &'static [(&'static str, f64)], &'static str);

const NM: [u32; 7] = [400, 450, 500, 550, 600, 650, 700];

/// Rows with these cells in front of a flat spectrum.
fn rows(head: &str, nm: &[u32], rows: &[(&str, f64)]) -> String {
    let mut text = head.to_owned();
    nm.iter().for_each(|nm| text += &format!(",{nm}"));
    for (cells, value) in rows {
        text += &format!("\n{cells}{}", format!(",{value}").repeat(nm.len()));
    }
    text + "\n"
}

/// Lines above, then a row for each wavelength with these values.
fn columns(above: &str, nm: &[u32], values: &[f64]) -> String {
    let cells: String = values.iter().map(|value| format!(",{value}")).collect();
    above.to_owned() + &nm.iter().map(|nm| format!("\n{nm}{cells}")).collect::<String>() + "\n"
}

/// A row for each reading, with `row` of wavelength, value and name.
fn long(head: &str, row: fn(u32, f64, &str) -> String, samples: &[(&str, f64)]) -> String {
    let readings = samples.iter().flat_map(|(name, value)| NM.map(|nm| row(nm, *value, name)));
    head.to_owned() + "\n" + &readings.map(|row| row + "\n").collect::<String>()
}

const BOTH: &[(&str, f64)] = &[("Red", 20.0), ("Blue", 40.0)];

fn layouts() -> Vec<Layout> {
    let wide: Vec<u32> = (0..18).map(|at| 190 + 30 * at).collect();
    let noisy = rows(
        "sample",
        &[350, 400, 450, 500, 550, 600, 650, 700, 750],
        &[("Red", 20.0), ("Blue", 40.0), ("White", 90.0)],
    );
    let metadata = "File Name,Red,Blue\nInvestigator,A,A\nTarget,Tree (100% abundance),Tree (100% abundance)\n\
        Sampling Environment,Laboratory,Laboratory\nAltitude,0,0";
    vec![
        (
            "geometry",
            rows(
                "Name,Geometry",
                &NM,
                &[("Red,15as15", 0.2), ("Red,45as15", 0.4), ("Blue,15as15", 0.6)],
            ),
            &[("Red 15as15", 20.0), ("Red 45as15", 40.0), ("Blue", 60.0)],
            "told apart by the column `Geometry`",
        ),
        (
            "angle",
            rows("Name,Date,Winkel", &NM, &[("Red,1.1.,15", 0.2), ("Red,1.1.,45", 0.4)]),
            &[("Red Winkel 15", 20.0), ("Red Winkel 45", 40.0)],
            "told apart by the column `Winkel`",
        ),
        (
            "side",
            rows("Probe,Seite", &NM, &[("Red,front", 0.2), ("Red,back", 0.4)]),
            &[("Red front", 20.0), ("Red back", 40.0)],
            "told apart by the column `Seite`",
        ),
        (
            "dose",
            rows("Sample,Dose [MJ/m2],Mode", &NM, &[("Red,0,M1", 0.2), ("Red,0.5,M1", 0.4)]),
            &[("Red Dose 0", 20.0), ("Red Dose 0.5", 40.0)],
            "told apart by the column `Dose",
        ),
        (
            "repeated",
            rows("Name", &NM, &[("Red", 0.2), ("Blue", 0.3), ("Blue", 0.5)]),
            BOTH,
            "3 readings, 2 spectra: Blue is the mean of 2",
        ),
        (
            "repeated columns",
            columns("nm,Red,Blue,Blue", &NM, &[0.2, 0.3, 0.5]),
            BOTH,
            "3 spectra, 2 samples: Blue is the mean of 2",
        ),
        (
            "two rows of headings",
            columns(
                "He_MJ/m2,0,,0.5,\nMeasurement,mean,std,mean,std\nwavelength_nm,,,,",
                &NM,
                &[0.2, 0.01, 0.4, 0.01],
            ),
            &[("0 mean", 20.0), ("0.5 mean", 40.0)],
            "`std` holds deviations",
        ),
        ("names above units", columns("Wavelength,Red,Blue\nnm,%,%", &NM, &[20.0, 40.0]), BOTH, ""),
        (
            "names above quantities",
            columns("Sample,Red,Blue\nnm,Reflectance,Reflectance", &NM, &[0.2, 0.4]),
            BOTH,
            "",
        ),
        ("notes above columns", columns(metadata, &NM, &[0.2, 0.4]), BOTH, ""),
        (
            "deviations beside columns",
            columns("nm,Red mean,Red std,Blue mean,Blue std", &NM, &[0.2, 0.01, 0.4, 0.01]),
            &[("Red mean", 20.0), ("Blue mean", 40.0)],
            "deviations",
        ),
        (
            "deviations below rows",
            rows(
                "Name",
                &NM,
                &[("Red", 0.2), ("Red std", 0.01), ("Blue", 0.4), ("Blue StdDev", 0.01)],
            ),
            BOTH,
            "rows 3, 5 hold deviations",
        ),
        (
            "deviations by a column",
            rows(
                "Name,Statistic",
                &NM,
                &[("Red,mean", 0.2), ("Red,std", 0.01), ("Blue,mean", 0.4)],
            ),
            BOTH,
            "row 3 holds deviations",
        ),
        (
            "colours of an instrument",
            rows(
                "User Color Name,L,a,b,L,c,h,Density,sRGB R",
                &NM,
                &[("Red,1,2,3,4,5,6,0.3,9", 0.2), ("Blue,1,2,3,4,5,6,0.3,9", 0.4)],
            ),
            BOTH,
            "",
        ),
        (
            "columns from 190 nm",
            columns("nm,Red,Blue", &wide, &[0.2, 0.4]),
            BOTH,
            "readings at 190 nm are left out",
        ),
        (
            "rows from 190 nm",
            rows("Name", &wide, &[("Red", 0.2), ("Blue", 0.4)]),
            BOTH,
            "readings at 190 nm are left out",
        ),
        (
            "rows to 2550 nm",
            rows("Name", &[400, 1475, 2550], &[("Red", 0.2), ("Blue", 0.4)]),
            BOTH,
            "2550 nm are left out",
        ),
        (
            "long",
            long(
                "sample,wavelength,reflectance",
                |nm, value, name| format!("{name},{nm},{value}"),
                &[("Red", 0.2), ("Blue", 0.4)],
            ),
            BOTH,
            "",
        ),
        (
            "long, wavelengths first",
            long(
                "Wellenl\u{e4}nge [nm],Reflexion,Probe",
                |nm, value, name| format!("{nm},{value},{name}"),
                &[("Red", 0.2), ("Blue", 0.4)],
            ),
            BOTH,
            "",
        ),
        (
            "long, in French",
            long(
                "valeur,\u{c9}chantillon,Longueur d'onde",
                |nm, value, name| format!("{value},{name},{nm}"),
                &[("Red", 0.2), ("Blue", 0.4)],
            ),
            BOTH,
            "",
        ),
        (
            "long, with geometries",
            long(
                "name,geometry,nm,value",
                |nm, value, name| format!("Red,{name},{nm},{value}"),
                &[("45as15", 0.2), ("45as75", 0.4)],
            ),
            &[("Red 45as15", 20.0), ("Red 45as75", 40.0)],
            "",
        ),
        (
            "long, numbered",
            long(
                "id,nm,value",
                |nm, value, name| format!("{name},{nm},{value}"),
                &[("1", 0.2), ("2", 0.4)],
            ),
            &[("1", 20.0), ("2", 40.0)],
            "",
        ),
        (
            "an id",
            rows("ID", &NM, &[("Red", 0.2), ("Blue", 0.4)]),
            BOTH,
            "named by the column `ID`",
        ),
        (
            "a colour",
            rows("Farbe", &NM, &[("Red", 0.2), ("Blue", 0.4)]),
            BOTH,
            "named by the column `Farbe`",
        ),
        (
            "a sample in Spanish",
            rows("Muestra,Fecha", &NM, &[("Red,x", 0.2), ("Blue,x", 0.4)]),
            BOTH,
            "",
        ),
        (
            "a sample in Italian",
            rows("Nome campione", &NM, &[("Red", 0.2), ("Blue", 0.4)]),
            BOTH,
            "",
        ),
        (
            "a sample in Dutch",
            rows("Golflengte (nm)", &NM, &[("Red", 0.2), ("Blue", 0.4)]),
            BOTH,
            "",
        ),
        ("units in brackets", columns("nm,Red [%],Blue (%)", &NM, &[20.0, 40.0]), BOTH, ""),
        (
            "noise at an end",
            noisy.replace("Red,20", "Red,200.9"),
            &[("Red", 20.0), ("Blue", 40.0), ("White", 90.0)],
            "Red: readings are cut to 400 to 750 nm, since it reads 200.9 % at 350 nm (row 2)",
        ),
    ]
}

/// The text with this separator and decimal sign.
fn restyled(text: &str, separator: &str, decimal: &str) -> String {
    let is_number = |cell: &str| cell.parse::<f64>().is_ok();
    let lines = text.lines().map(|line| {
        let cells = line
            .split(',')
            .map(|cell| if is_number(cell) { cell.replace('.', decimal) } else { cell.to_owned() });
        cells.collect::<Vec<String>>().join(separator) + "\r\n"
    });
    lines.collect()
}

fn color_of(file: &str, bytes: &[u8]) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(file);
    std::fs::write(&path, bytes).unwrap();
    impasto(&["color", path.to_str().unwrap(), "--json"])
}

/// Name and Y of each sample.
fn luminances(run: &Run) -> Vec<(String, f64)> {
    let json = run.json();
    let samples = json.as_array().unwrap().iter().map(|sample| {
        (sample["sample"].as_str().unwrap().to_owned(), sample["xyz"][1].as_f64().unwrap())
    });
    samples.collect()
}

#[test]
fn every_layout_is_read_in_every_style() {
    for (layout, text, samples, remark) in layouts() {
        let styles = [
            ("a.csv", text.clone().into_bytes()),
            ("semicolons.csv", restyled(&text, ";", ",").into_bytes()),
            ("points.csv", restyled(&text, ";", ".").into_bytes()),
            ("tabs.txt", restyled(&text, "\t", ".").into_bytes()),
            ("commas.txt", restyled(&text, "\t", ",").into_bytes()),
            ("book.xlsx", workbook(&text, 1)),
        ];
        for (file, bytes) in styles {
            let run = color_of(file, &bytes);
            assert_eq!(run.status, 0, "{layout}, {file}: {}", run.err);
            let found = luminances(&run);
            let [names, wanted]: [Vec<&str>; 2] = [
                found.iter().map(|(name, _)| name.as_str()).collect(),
                samples.iter().map(|(name, _)| *name).collect(),
            ];
            // A workbook has no leading zeros, and its numbers have a point.
            let plain: Vec<String> = names.iter().map(|name| name.replace("0,5", "0.5")).collect();
            assert_eq!(plain, wanted, "{layout}, {file}: {}", run.err);
            for ((name, y), (_, wanted)) in found.iter().zip(samples) {
                assert_near(format!("{layout}, {file}, {name}"), &[*y], &[*wanted], 1e-6);
            }
            assert!(run.err.contains(remark), "{layout}, {file}: `{remark}`: {}", run.err);
        }
    }
}

#[test]
fn numbers_with_commas_and_no_headings_are_read_as_with_blanks() {
    let commas = "380,1.90,2.64\n480,3.1,4.2\n580,5.5,6.1\n680,7,8\n780,3.2,1.1\n";
    let folder = tempfile::tempdir().unwrap();
    let [first, second] = [commas.to_owned(), commas.replace(',', " ")].map(|text| {
        let file = folder.path().join("lamps.csv");
        std::fs::write(&file, text).unwrap();
        let lamp = format!("{}#2", file.display());
        impasto(&["light", &lamp, "--json"])
    });
    assert_eq!((first.status, &first.out), (0, &second.out), "{}", first.err);
    let whole = color_of("a.csv", b"400,0,5\n500,0,6\n600,0,7\n");
    assert_eq!(whole.status, 1, "{}", whole.err);
    assert!(whole.err.contains("a heading for every column"), "{}", whole.err);
}

#[test]
fn samples_of_two_files_are_named_by_file() {
    let folder = tempfile::tempdir().unwrap();
    let files = [("a.csv", 0.2), ("b.csv", 0.4)].map(|(name, value)| {
        let file = folder.path().join(name);
        std::fs::write(&file, rows("sample", &NM, &[("Red", value), (name, 0.5)])).unwrap();
        file.to_str().unwrap().to_owned()
    });
    let run = impasto(&["color", &files[0], &files[1], "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    let found = luminances(&run);
    let names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["Red (a.csv)", "a.csv", "Red (b.csv)", "b.csv"]);
    assert_near("Red", &[found[0].1, found[2].1], &[20.0, 40.0], 1e-6);
    assert!(run.err.contains("1 name occurs in several files"), "{}", run.err);
}

/// Readings of a white, a red and their mixture, with these headings of amounts.
fn fit(heads: &str, amounts: [&str; 3], options: &[&str]) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("paints.csv");
    let [white, red, mixture] = amounts;
    let text = format!(
        "Probe;{heads};400;500;600\nw;{white};90;91;92\nr;{red};10;11;60\nm;{mixture};40;42;80\n"
    );
    std::fs::write(&file, text).unwrap();
    impasto(&[&["fit", file.to_str().unwrap(), "--json"], options].concat())
}

#[test]
fn amounts_may_have_units_and_pigments_numbers_for_names() {
    let plain = ["100;", ";100", "90;10"];
    let signed = ["100%;", ";100 %", "90%;10 %"];
    let number = ["--pigments", "08", "--pigments", "Titan", "--white", "Titan"];
    for (heads, amounts, options) in [
        ("Titanwei\u{df};Rot", plain, &[][..]),
        ("Blanc de titane;Rouge", plain, &[]),
        ("Titanwei\u{df} [%];Rot (%)", plain, &[]),
        ("Titanwei\u{df};Rot", signed, &[]),
        ("Titanwei\u{df};Rot", plain, &["--white", "Titan"]),
        ("Titan;08", plain, &number),
    ] {
        let run = fit(heads, amounts, options);
        assert_eq!(run.status, 0, "{heads}, {amounts:?}: {}", run.err);
        assert_eq!(run.json()["pigments"], 2, "{heads}: {}", run.out);
    }
    for (heads, amounts, options, words) in [
        ("Titan;08", plain, &["--white", "Titan"][..], &["column `08`", "--pigments 08"][..]),
        ("Titan (g);Rot (mg)", plain, &[], &["row 1, column `Rot (mg)`", "in one unit"]),
        (
            "Titanwei\u{df};Rot",
            ["100%;", ";100%", "90%;0.1"],
            &[],
            &["row 4, column `Rot`", "one unit"],
        ),
        ("Titanwei\u{df};Rot", plain, &["--white", "Blei"], &["Blei", "Titanwei"]),
    ] {
        let run = fit(heads, amounts, options);
        assert_eq!(run.status, 1, "{heads}: {}", run.err);
        for word in words {
            assert!(run.err.contains(word), "`{word}` is missing: {}", run.err);
        }
    }
}

#[test]
fn readings_under_several_geometries_are_no_calibration() {
    let text = rows(
        "sample,Geometry,White,Red",
        &NM,
        &[("w,15as15,1,", 0.9), ("w,45as15,1,", 0.8), ("r,15as15,,1", 0.2), ("r,45as15,,1", 0.1)],
    );
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.csv");
    std::fs::write(&file, text).unwrap();
    let run = impasto(&["fit", file.to_str().unwrap()]);
    assert_eq!(run.status, 1, "{}", run.err);
    for word in ["row 2: w is read under 2 geometries (column `Geometry`)", "one geometry"] {
        assert!(run.err.contains(word), "`{word}` is missing: {}", run.err);
    }
}

#[test]
fn faults_name_the_row_of_the_file_the_sample_and_the_odd_cell() {
    for (file, text, words) in [
        (
            "a.dpt",
            "400,0.5\n410,-0.5\n420,0.5\n430,0.5\n".to_owned(),
            &["row 2, column `410 nm`", "of a, found `-0.5`"][..],
        ),
        (
            "a.csv",
            "Name;400;500\nRed;0.1;0.2\nBlue;0.1;0,2\nGrey;0.3;0.3\n".to_owned(),
            &["row 3, column `500`", "`0,2`", "decimal"],
        ),
        (
            "a.csv",
            "Name;400;500\nRed;0,1;0.2\nBlue;0,1;0,2\n".to_owned(),
            &["row 2, column `500`", "`0.2`", "decimal"],
        ),
        ("a.csv", "nm;Red\n400;0.1\n410;0,2\n420;0.3\n".to_owned(), &["line 3", "`0,2`"]),
        ("a.csv", columns("nm,Red", &NM, &[7000.0]), &["and 7 of its 7 are not"]),
        (
            "a.csv",
            "name,nm,value\nRed,400,0.1\nRed,500,x\nRed,600,0.2\nRed,700,0.2\n".to_owned(),
            &["line 3", "`x`"],
        ),
    ] {
        let run = color_of(file, text.as_bytes());
        assert_eq!(run.status, 1, "{text}: {}", run.err);
        for word in words {
            assert!(run.err.contains(word), "`{word}` is missing: {}", run.err);
        }
    }
}

#[test]
fn recipes_may_name_readings_by_their_file() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let file = folder.path().join(name);
        std::fs::write(&file, text).unwrap();
        file.to_str().unwrap().to_owned()
    };
    let first = write("a.csv", &rows("sample", &NM, &[("1", 0.9), ("2", 0.2)]));
    let second = write("b.csv", &rows("sample", &NM, &[("1", 0.5), ("2", 0.2)]));
    let by_file = "reading,sample,White,Red\n1 (a.csv),w,1,\n2 (a.csv),r,,1\n1 (b.csv),m,9,1\n2 (b.csv),r,,1\n";
    let by_name = "sample,White,Red\n1,1,\n2,,1\n";
    for (recipes, samples) in [(by_file, 3), (by_name, 1)] {
        let recipes = write("recipes.csv", recipes);
        let run = impasto(&["fit", &first, &second, "--recipes", &recipes, "--json"]);
        assert_eq!(run.status, 0, "{}", run.err);
        assert_eq!(run.json()["samples"], samples, "{}", run.out);
        let said = "occurs in several files, and so does 1 other sample";
        assert!(run.err.contains(said), "{}", run.err);
    }
}
