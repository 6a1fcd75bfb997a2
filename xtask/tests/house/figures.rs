//! Figures of the sources and their limits. Call `cargo xtask figures` to see them, and `--list`
//! for the places.

use xtask::figures::Figures;
use xtask::files::{text, texts};
use xtask::rules::{RULES, rows_of, table};

#[test]
fn the_figures_keep_their_limits() {
    let figures = Figures::of(&texts(&[".rs", ".wgsl"]));
    assert!(figures.files > 500 && figures.words > 50_000, "{figures:?}");
    println!("{}", table(&figures));
    let mut broken = Vec::new();
    for rule in RULES.iter().filter(|rule| !rule.is_kept(&figures)) {
        broken.push(format!("{}: {:.2}, {} allowed", rule.name, rule.figure(&figures), rule.limit));
        if let Some(mark) = rule.mark {
            broken.push(format!("  cargo xtask figures --list {mark}"));
        }
    }
    assert!(figures.longest <= 800, "{}: {} lines", figures.longest_path, figures.longest);
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn the_architecture_page_has_the_same_limits() {
    let page = text("ARCHITECTURE.md");
    let rows = rows_of(&page);
    let ours: Vec<(String, String)> =
        RULES.iter().map(|rule| (rule.name.to_owned(), rule.limit.to_string())).collect();
    let theirs: Vec<(String, String)> =
        rows.iter().map(|[name, _, limit]| ((*name).to_owned(), (*limit).to_owned())).collect();
    assert_eq!(ours, theirs, "run `cargo xtask figures --write`");
    for [name, figure, _] in rows {
        assert!(figure.parse::<f64>().is_ok(), "{name}: {figure}");
    }
}
