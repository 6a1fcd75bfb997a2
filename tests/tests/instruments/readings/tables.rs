//! Tables of readings as instruments and people write them: headings of names and wavelengths, lines above
//! the table, falling wavelengths, decimal commas.

use suite::near::assert_near;
use suite::program::{Run, impasto};

/// Runs `color` on a file with this content.
fn color(name: &str, content: &str) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(name);
    std::fs::write(&file, content).unwrap();
    impasto(&["color", file.to_str().unwrap(), "--json"])
}

fn colors(run: &Run) -> Vec<(String, Vec<f64>)> {
    assert_eq!(run.status, 0, "{}", run.err);
    let json = run.json();
    let samples = json.as_array().unwrap().iter();
    let lab = |sample: &serde_json::Value| {
        [0, 1, 2].iter().map(|axis| sample["lab"][axis].as_f64().unwrap()).collect()
    };
    samples.map(|sample| (sample["sample"].as_str().unwrap().to_owned(), lab(sample))).collect()
}

const PLAIN: &str = "sample,400,500,600,700\nRed,0.1,0.2,0.6,0.7\nBlue,0.5,0.4,0.2,0.1\n";

#[test]
fn every_way_to_write_a_table_gives_the_same_colors() {
    let expected = colors(&color("plain.csv", PLAIN));
    let heading = |name: &str| PLAIN.replace("sample", name);
    let comma = |separator: &str| {
        let quoted = |line: &str| {
            let cells = line.split(',').map(|cell| format!("\"{}\"", cell.replace('.', ",")));
            cells.collect::<Vec<_>>().join(separator)
        };
        PLAIN.lines().map(|line| quoted(line) + "\r\n").collect::<String>()
    };
    let falling = "Name;700;600;500;400\nRed;0,7;0,6;0,2;0,1\nBlue;0,1;0,2;0,4;0,5\n";
    let words = PLAIN.replacen("400,500,600,700", "400[nm],500[nm],600[nm],700[nm]", 1);
    let minolta = "Konica Minolta\n\nData Name\tL*(D65)\tSCI 400nm\tSCI 500nm\tSCI 600nm\tSCI 700nm\t\
                   SCE 400nm\tSCE 500nm\tSCE 600nm\tSCE 700nm\n\
                   Red\t50\t10\t20\t60\t70\t9\t19\t59\t69\nBlue\t60\t50\t40\t20\t10\t49\t39\t19\t9\n";
    let nix = "sep=;\nNix Toolkit;1.0\nOriginal Color Name;User Color Name;Mode;R400 nm;R500 nm;\
               R600 nm;R700 nm\nx;Red;M0;0,1;0,2;0,6;0,7\ny;Blue;M0;0,5;0,4;0,2;0,1\n";
    let unnamed = nix.replace(";Red;", ";;").replace(";Blue;", ";;").replace("\nx", "\nRed");
    for (way, content) in [
        ("name", heading("Name")),
        ("id", heading("SAMPLE_ID")),
        ("one word", heading("SampleName")),
        ("data name", heading("Data Name")),
        ("color name", heading("Color Name")),
        ("name in quotes", heading("\"Name\"")),
        ("wavelength in front", heading("wavelength").replace(',', "\t")),
        ("no heading", heading("")),
        (
            "row numbers",
            PLAIN.replace("sample", ",Name").replace("Red", "1,Red").replace("Blue", "2,Blue"),
        ),
        (
            "a column a sample",
            "wavelength\tRed\tBlue\n400\t0.1\t0.5\n500\t0.2\t0.4\n600\t0.6\t0.2\n700\t0.7\t0.1\n"
                .to_owned(),
        ),
        ("a column a sample with films", "wavelength\tRed\tBlue\nfilm\tpaint\tpaint\n400\t0,1\t0,5\n500\t0,2\t0,4\n600\t0,6\t0,2\n700\t0,7\t0,1\n".to_owned()),
        ("title", format!("My paints\nDate,1.1.2026\nName,Anna\n\n{}", heading("Name"))),
        ("quoted commas", comma(",")),
        ("commas between semicolons", comma(";")),
        ("falling", falling.to_owned()),
        ("units", words),
        ("Konica Minolta", minolta.to_owned()),
        ("Nix", nix.to_owned()),
        ("Nix, own names missing", unnamed.replace("\ny", "\nBlue")),
    ] {
        let found = colors(&color("table.csv", &content));
        for ((name, lab), (expected_name, expected_lab)) in found.iter().zip(&expected) {
            assert_eq!(name, expected_name, "{way}");
            assert_near(way, lab, expected_lab, 1e-9);
        }
        assert_eq!(found.len(), 2, "{way}");
    }
}

#[test]
fn rows_of_errors_are_lines_of_the_file() {
    for (content, place) in [
        ("Title\r\n\r\nName,400,500\r\nRed,0.1,0.2\r\n\r\nBlue,0.1,x\r\n", "row 6, column `500`"),
        ("Title\n\"a\nb\"\nName;500;400\nRed;0,1;0,2\nBlue;x;0,2\n", "row 6, column `500`"),
        (
            "Title\nName,500,400,450\nRed,0.1,0.2,0.3\n",
            "row 2, column `450`: wavelengths must rise or fall",
        ),
        ("Title\nName,500,,450\nRed,0.1,0.2,0.3\n", "row 2: column number 3 has no header"),
        (
            "Title\n\nName,Code,400,500\n,,0.1,0.2\n",
            "row 4, column `Name`: expected the sample's name",
        ),
        ("Title\nName,400,500\nRed,0.1\n", "row 3: expected 3 cells"),
        ("sample;A;B\n\nfilm;paint;none\n400;0,1;0,2\n500;0,1;x\n", "row 5, column `B`"),
        (
            "sample;A;B\n\nfilm;paint;none\n400;0,1;0,2\n500;0,1;-1\n",
            "row 5, column `B`: expected a reflectance from 0 to 2",
        ),
        ("sample;A;B\n\nfilm;paint;none\n500;0,1;0,2\n400;1;1\n450;1;1\n", "row 6, column `450`"),
    ] {
        let run = color("table.csv", content);
        assert_eq!(run.status, 1, "{content}\n{}", run.err);
        assert!(run.err.contains(place), "`{place}` is missing: {}", run.err);
    }
}

#[test]
fn columns_beside_the_names_are_told() {
    let both = "Data Name,SCI 400nm,SCI 500nm,SCE 400nm,SCE 500nm\nRed,10,20,9,19\n";
    let run = color("table.csv", both);
    assert!(run.err.contains("without the specular component (SCE) are left out"), "{}", run.err);
    let run = color("table.csv", "SAMPLE_ID,SAMPLE_NAME,Mode,400,500\n1,Red,M0,0.1,0.2\n");
    assert_eq!(colors(&run)[0].0, "Red");
    let run = color("table.csv", "sample,White,400,500\nRed,\"1,000\",0.1,0.2\n");
    assert_eq!(run.status, 0, "amounts take no part in colours: {}", run.err);
}
