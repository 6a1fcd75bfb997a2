//! A report on a few of the oils, one of them with HTML markup as its name.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use suite::program::{Run, impasto, repository};

/// Name given to cobalt blue. Every output must escape its markup.
pub(crate) const HOSTILE: &str = "<b>&\"";

/// Readings of the shipped zinc white, bone black, cobalt blue (renamed [`HOSTILE`]) and Prussian
/// blue, and of a second zinc white with only a masstone.
pub(crate) fn readings() -> String {
    let oils = std::fs::read_to_string(repository("measurements/van-gogh-oils.csv")).unwrap();
    let (header, rows) = oils.split_once('\n').unwrap();
    let renamed = header.replace(",Cobalt Blue,", ",\"<b>&\"\"\",");
    assert_ne!(renamed, header, "cobalt blue is among the oils");
    let rows = rows.lines().filter(|row| {
        let chosen = ["07", "12", "13"].iter().any(|start| row.starts_with(start));
        chosen || row.split(',').nth(1) == Some("none")
    });
    let rows: Vec<&str> = rows.collect();
    format!("{renamed}\n{}\n", rows.join("\n"))
}

/// A folder with `readings.csv` and the library fitted to it, `library.json`.
pub(crate) struct Work {
    folder: tempfile::TempDir,
}

impl Work {
    pub(crate) fn new() -> Self {
        let work = Self { folder: tempfile::tempdir().unwrap() };
        std::fs::write(work.path("readings.csv"), readings()).unwrap();
        let csv = work.text("readings.csv");
        let json = work.text("library.json");
        let fit = impasto(&["fit", &csv, "--output", &json, "--title", HOSTILE]);
        assert_eq!(fit.status, 0, "{}", fit.err);
        work
    }

    pub(crate) fn path(&self, inside: &str) -> PathBuf {
        self.folder.path().join(inside)
    }

    pub(crate) fn text(&self, inside: &str) -> String {
        self.path(inside).display().to_string()
    }

    /// Runs `impasto report` on the library with `more` arguments.
    pub(crate) fn report(&self, out: &str, more: &[&str]) -> Run {
        let library = self.text("library.json");
        let out = self.text(out);
        impasto(&[&["report", &library, "--out", &out], more].concat())
    }
}

/// The report with all readings, made once for all tests.
pub(crate) fn whole() -> &'static Work {
    static WORK: OnceLock<Work> = OnceLock::new();
    WORK.get_or_init(|| {
        let work = Work::new();
        let run = work.report("out", &[&work.text("readings.csv")]);
        assert_eq!(run.status, 0, "{}", run.err);
        work
    })
}

/// Path and bytes of every file in `folder` and its subfolder `figures`, sorted by path.
pub(crate) fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut found = Vec::new();
    for inside in [folder.to_owned(), folder.join("figures")] {
        for entry in std::fs::read_dir(inside).unwrap() {
            let path = entry.unwrap().path();
            if path.is_file() {
                let name = path.strip_prefix(folder).unwrap().display().to_string();
                found.push((name, std::fs::read(path).unwrap()));
            }
        }
    }
    found.sort();
    found
}
