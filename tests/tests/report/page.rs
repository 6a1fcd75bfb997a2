//! The HTML page of a report: links, escaped names, captions and colours in dark mode.

use crate::made::whole;

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
    // In the small charts, a recipe has two lines under its sample.
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
    let translucent = |line: &&str| line.starts_with("<polygon") && line.contains("\"0.25\"");
    let areas: Vec<&str> = svg.lines().filter(translucent).collect();
    // Two bands in the chart, and in the key one square for each and a second for the inner one.
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
