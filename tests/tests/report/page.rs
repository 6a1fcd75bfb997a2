//! The HTML page of a report (links, escaped names, captions, colours in dark mode), also in a
//! headless browser if one is installed, and its figures as SVG, PNG and CSV (size, numbers, axes,
//! marks, escaped names).

use std::process::Command;

use resvg::tiny_skia::Pixmap;

use crate::made::{HOSTILE, Work, files, whole};

fn page() -> String {
    std::fs::read_to_string(whole().path("out/report.html")).unwrap()
}

#[test]
fn it_loads_nothing() {
    let page = page();
    for loading in ["<script", "<iframe", "<object", "<embed", "<img", "@import", "url(", "src="] {
        assert!(!page.contains(loading), "{loading}");
    }
    // Links lead to figure files, to places on the page, or to the empty document `data:,`.
    let links: Vec<&str> =
        page.split("href=\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect();
    assert!(links.len() > 20, "{links:?}");
    for link in links {
        let near = link.starts_with('#') || link.starts_with("figures/") || link == "data:,";
        assert!(near, "{link}");
        if let Some(file) = link.strip_prefix("figures/") {
            assert!(whole().path("out/figures").join(file).is_file(), "{link} leads nowhere");
        }
        if let Some(place) = link.strip_prefix('#') {
            assert!(page.contains(&format!("id=\"{place}\"")), "{link} leads nowhere");
        }
    }
    let elsewhere = page.replace("xmlns=\"http://www.w3.org/2000/svg\"", "");
    assert!(!elsewhere.contains("http:") && !elsewhere.contains("https:"), "URL in the page");
}

#[test]
fn names_are_text() {
    let page = page();
    assert!(!page.contains("<b>&"), "a name became markup");
    assert!(page.contains("<title>&lt;b&gt;&amp;&quot;</title>"), "the title is shown");
    assert!(page.contains("% &lt;b&gt;&amp;&quot;"), "recipes name it");
}

#[test]
fn every_caption_has_the_command_that_made_it() {
    let page = page();
    let command = format!(
        "impasto report {} --out {} {}",
        whole().text("library.json"),
        whole().text("out"),
        whole().text("readings.csv")
    );
    let captions = page.matches("<figcaption>").count();
    assert!(captions >= 8, "{captions} captions");
    let folded = format!(
        "<details class=\"made\"><summary>Command</summary><code>{command}</code></details>\n"
    );
    assert_eq!(page.matches(&format!("{folded}</figcaption>")).count(), captions);
    assert_eq!(page.matches(&folded).count(), captions + 1, "the head has it too");
}

#[test]
fn recipes_stand_beside_the_codes_of_samples() {
    let page = page();
    let warning = page.split("<li>").find(|item| item.contains("07B")).unwrap();
    assert!(warning.contains("<small>07B: Zinc White (linseed) (S unknown)</small>"), "{warning}");
    // In the small charts, a recipe has two lines below its sample.
    let svg = std::fs::read_to_string(whole().path("out/figures/samples.svg")).unwrap();
    let texts: Vec<&str> =
        svg.split("<text ").skip(1).filter_map(|text| text.split(">\n").nth(1)).collect();
    let at = texts.iter().position(|text| text.starts_with("07B*")).unwrap();
    let before: Vec<&str> =
        texts[at - 3..at].iter().filter_map(|text| text.lines().next()).collect();
    assert_eq!(before, ["Zinc White (linseed) (S", "unknown)", "0.00"]);
}

#[test]
fn legends_of_bands_change_with_the_bands_in_the_dark() {
    let svg = std::fs::read_to_string(whole().path("out/figures/residuals.svg")).unwrap();
    let color = reports::style::SERIES[0].hex();
    let areas: Vec<&str> = svg
        .lines()
        .filter(|line| line.starts_with("<polygon") && line.contains("\"0.25\""))
        .collect();
    // There are two bands in the chart. The key has one square for each, and a second for the inner
    // one.
    assert_eq!(areas.len(), 5, "{areas:?}");
    assert!(areas.iter().all(|area| area.contains(&color)), "{areas:?}");
    let page = page();
    let dark = page.split("prefers-color-scheme:dark").nth(1).unwrap();
    assert!(dark.contains(&format!("svg [fill=\"{color}\"]{{fill:")), "also of bars and patches");
}

#[test]
fn printed_paper_is_white_in_figures_too() {
    let page = page();
    let paper = reports::style::PAPER.hex();
    let white = reports::style::Color([0xFF; 3]).hex();
    let printed: Vec<&str> = page.split("@media print").skip(1).collect();
    for rule in
        [format!(":root{{--paper:{white}}}"), format!("svg [fill=\"{paper}\"]{{fill:{white}}}")]
    {
        assert!(printed.iter().any(|rules| rules.contains(&rule)), "{rule}");
    }
}

#[test]
fn in_the_dark_ink_and_lines_are_exchanged_but_patches_are_not() {
    let page = page();
    let dark = page.split("prefers-color-scheme:dark").nth(1).unwrap().split("</style>").next();
    let dark = dark.unwrap();
    let ink = reports::style::INK.hex();
    assert!(dark.contains(&format!("svg [fill=\"{ink}\"]{{fill:")), "{dark}");
    let svg = std::fs::read_to_string(whole().path("out/figures/absorption.svg")).unwrap();
    let line = svg.lines().rfind(|l| l.starts_with("<polyline") && l.contains("16")).unwrap();
    let color = line.split("stroke=\"").nth(1).unwrap().split('"').next().unwrap();
    assert!(dark.contains(&format!("svg :not(rect)[stroke=\"{color}\"]{{stroke:")), "{color}");
    let patches = svg.lines().filter(|l| l.starts_with("<rect")).skip(1);
    for patch in patches {
        let color = patch.split(" fill=\"").nth(1).unwrap().split('"').next().unwrap();
        assert!(!dark.contains(&format!("svg [fill=\"{color}\"]")), "{patch}");
    }
}

const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

#[test]
fn a_browser_shows_every_figure_and_complains_of_nothing() {
    let Some(browser) =
        BROWSERS.iter().find(|name: &&&str| Command::new(name).arg("--version").output().is_ok())
    else {
        eprintln!("skipped: none of {BROWSERS:?} is on this machine");
        return;
    };
    let profile = tempfile::tempdir().unwrap();
    let shown = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"])
        .args(["--disable-background-networking", "--enable-logging=stderr", "--v=0"])
        .arg(format!("--user-data-dir={}", profile.path().display()))
        .args(["--window-size=1366,768", "--dump-dom"])
        .arg(format!("file://{}", whole().text("out/report.html")))
        .output()
        .unwrap();
    assert!(shown.status.success(), "{}", String::from_utf8_lossy(&shown.stderr));
    let log = String::from_utf8_lossy(&shown.stderr);
    let complaints: Vec<&str> = log.lines().filter(|line| line.contains("CONSOLE")).collect();
    assert!(complaints.is_empty(), "{complaints:?}");
    let dom = String::from_utf8(shown.stdout).unwrap();
    let page = std::fs::read_to_string(whole().path("out/report.html")).unwrap();
    let figures = page.matches("<figure id=").count();
    assert!(figures >= 8, "{figures} figures on the page");
    for name in page.split("<figure id=\"").skip(1).map(|rest| rest.split('"').next().unwrap()) {
        assert!(dom.contains(&format!("<figure id=\"{name}\">")), "{name} is not shown");
    }
    // The browser finds as many elements as the source has, so every figure is closed.
    for element in ["<svg ", "</svg>", "</figure>", "<table>", "</table>", "<polyline "] {
        assert_eq!(dom.matches(element).count(), page.matches(element).count(), "{element}");
    }
}

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
        let json = suite::program::impasto(&[verb, &csv, "--json"]).json();
        let mut reader = csv::Reader::from_reader(errors.as_bytes());
        let place = reader.headers().unwrap().iter().position(|title| title == column).unwrap();
        let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        let samples = json["per_sample"].as_array().unwrap();
        assert!(samples.len() > 10, "{verb}: {} samples", samples.len());
        for sample in samples {
            let name = sample["sample"].as_str().unwrap();
            let wanted = &sample["delta_e"];
            let row = rows.iter().find(|row| &row[0] == name).unwrap();
            let (found, wanted): (f64, f64) =
                (row[place].parse().unwrap(), wanted.as_f64().unwrap());
            // A library file has six digits of K and S.
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
    assert!(page.contains("K and S are not measured"), "the table says so");
}

#[test]
fn wavelength_axes_are_all_the_same() {
    // Horizontal positions of the labels 400 and 700, in tenths of a pixel.
    fn places(name: &str) -> [Vec<f64>; 2] {
        let svg = text(name, "svg");
        ["400", "700"].map(|tick| -> Vec<f64> {
            let labelled = svg.split("<text ").filter(|t| t.contains(&format!(">\n{tick}\n<")));
            labelled.map(|t| t.split('"').nth(1).unwrap().parse().unwrap()).collect()
        })
    }
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
    let [first, second] = [(); 2].map(|()| {
        let run = work.report("out", &[&work.text("readings.csv")]);
        assert_eq!(run.status, 0, "{}", run.err);
        files(&work.path("out"))
    });
    assert!(first.len() > 3 * FIGURES.len(), "{} files", first.len());
    assert_eq!(first.len(), second.len());
    for ((path, first), (_, second)) in first.iter().zip(&second) {
        assert!(first == second, "{path} differs");
    }
}
