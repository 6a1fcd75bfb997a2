//! The HTML page of a report in a headless browser, if one is installed.

use std::process::Command;

use crate::made::whole;

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
