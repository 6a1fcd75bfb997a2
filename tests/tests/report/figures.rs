//! Figures of a report as SVG, PNG and CSV: size, numbers, axes, marks and escaped names.

use resvg::tiny_skia::Pixmap;

use crate::made::{HOSTILE, Work, files, whole};

const FIGURES: [&str; 8] = [
    "absorption",
    "errors",
    "left-out",
    "light",
    "residuals",
    "samples",
    "scattering",
    "wavelengths",
];

fn figure(name: &str, ending: &str) -> Vec<u8> {
    std::fs::read(whole().path(&format!("out/figures/{name}.{ending}"))).unwrap()
}

fn text(name: &str, ending: &str) -> String {
    String::from_utf8(figure(name, ending)).unwrap()
}

#[test]
fn every_figure_is_there_as_svg_png_and_csv() {
    let mut wanted: Vec<String> = FIGURES
        .iter()
        .flat_map(|name| ["csv", "png", "svg"].map(|ending| format!("figures/{name}.{ending}")))
        .collect();
    wanted.push("report.html".to_owned());
    let found: Vec<String> =
        files(&whole().path("out")).into_iter().map(|(path, _)| path).collect();
    for path in &wanted {
        assert!(found.contains(path), "{path} is missing: {found:?}");
    }
}

#[test]
fn pictures_are_twice_as_fine_as_the_drawing_and_have_ink() {
    for name in FIGURES {
        let picture = Pixmap::decode_png(&figure(name, "png")).unwrap();
        let svg = text(name, "svg");
        let size = format!("width=\"{}\" height=\"{}\"", picture.width() / 2, picture.height() / 2);
        assert!(svg.contains(&size), "{name}: {size}");
        let paper = picture.pixel(0, 0).unwrap();
        let ink = picture.pixels().iter().filter(|pixel| **pixel != paper).count();
        let share = ink as f64 / picture.pixels().len() as f64;
        assert!((0.005..0.6).contains(&share), "{name}: {share}");
    }
}

#[test]
fn numbers_stand_under_a_unit_and_every_row_is_whole() {
    for name in FIGURES {
        let bytes = figure(name, "csv");
        let mut reader = csv::Reader::from_reader(bytes.as_slice());
        let header = reader.headers().unwrap().clone();
        let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        assert!(rows.len() >= 4, "{name}: {} rows", rows.len());
        for (column, title) in header.iter().enumerate() {
            let mut cells = rows.iter().map(|row| &row[column]).filter(|cell| !cell.is_empty());
            let numbers = cells.clone().count() > 0
                && cells.all(|cell| cell.parse::<f64>().is_ok_and(f64::is_finite));
            let unit = title.ends_with(']') && title.contains(" [");
            assert_eq!(numbers, unit, "{name}: {title}");
        }
    }
}

#[test]
fn the_numbers_of_a_figure_are_those_of_fit_and_validate() {
    let work = whole();
    let csv = work.text("readings.csv");
    let errors = text("errors", "csv");
    for (verb, column) in [("fit", "Fitted [CIEDE2000]"), ("validate", "Left out [CIEDE2000]")] {
        let told = suite::program::impasto(&[verb, &csv, "--json"]).json();
        let mut reader = csv::Reader::from_reader(errors.as_bytes());
        let place = reader.headers().unwrap().iter().position(|title| title == column).unwrap();
        let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        let samples = told["per_sample"].as_array().unwrap();
        assert!(samples.len() > 10, "{verb}: {} samples", samples.len());
        for sample in samples {
            let name = sample["sample"].as_str().unwrap();
            let wanted = &sample["delta_e"];
            let row = rows.iter().find(|row| &row[0] == name).unwrap();
            let (found, wanted): (f64, f64) =
                (row[place].parse().unwrap(), wanted.as_f64().unwrap());
            // A library file holds six digits of K and S.
            assert!((found - wanted).abs() < 2e-3, "{verb} {name}: {found}, {wanted}");
        }
    }
}

#[test]
fn pigments_without_a_known_s_are_marked() {
    let samples = text("samples", "csv");
    assert!(samples.contains("07B*"), "its masstone is marked with a star");
    for name in ["absorption", "scattering"] {
        assert!(text(name, "csv").contains("Zinc White (linseed) (S unknown)"), "{name}");
        assert!(text(name, "svg").contains("S unknown"), "{name}");
    }
    let page = std::fs::read_to_string(whole().path("out/report.html")).unwrap();
    assert!(page.contains("K and S are no measurement"), "the table says so");
}

#[test]
fn wavelength_axes_are_all_the_same() {
    // Horizontal positions of the labels 400 and 700, in tenths of a pixel.
    let places = |name: &str| {
        let svg = text(name, "svg");
        ["400", "700"].map(|tick| -> Vec<f64> {
            let labelled = svg.split("<text ").filter(|t| t.contains(&format!(">\n{tick}\n<")));
            labelled.map(|t| t.split('"').nth(1).unwrap().parse().unwrap()).collect()
        })
    };
    let [first, second] = places("residuals").map(|x| x[0]);
    for name in ["residuals", "light"] {
        let [short, long] = places(name);
        assert!(short.len() > 1 && short.iter().all(|x| *x == first), "{name}: {short:?}");
        assert!(long.len() > 1 && long.iter().all(|x| *x == second), "{name}: {long:?}");
    }
    // In the small charts 400 to 700 nm take the same share of the frame.
    let [mut short, mut long] = places("samples");
    short.sort_by(f64::total_cmp);
    long.sort_by(f64::total_cmp);
    let frame = 8800.0;
    let small = short[1] - short[0] - 100.0;
    let shares = [(second - first) / frame, (long[0] - short[0]) / small];
    assert!((shares[0] - shares[1]).abs() < 0.01, "{shares:?}");
}

#[test]
fn names_are_text_in_every_drawing() {
    for name in FIGURES {
        let svg = text(name, "svg");
        assert!(!svg.contains("<b>"), "{name} holds markup from a name");
        assert!(svg.contains("impasto report "), "{name} tells what made it");
    }
    assert!(text("absorption", "svg").contains("&lt;b&gt;&amp;&quot;"), "the name is shown");
    let mut reader = csv::Reader::from_reader(std::io::Cursor::new(figure("absorption", "csv")));
    let named = reader.records().any(|row| &row.unwrap()[0] == HOSTILE);
    assert!(named, "the CSV has the name as it is");
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let work = Work::new();
    let run = || {
        let run = work.report("out", &[&work.text("readings.csv")]);
        assert_eq!(run.status, 0, "{}", run.err);
        files(&work.path("out"))
    };
    let first = run();
    let second = run();
    assert!(first.len() > 3 * FIGURES.len(), "{} files", first.len());
    assert_eq!(first.len(), second.len());
    for ((path, first), (_, second)) in first.iter().zip(&second) {
        assert!(first == second, "{path} differs");
    }
}
