//! Source files: ASCII, no unfinished code, every shader in a kernel. Data files: each
//! names its source.

use std::path::Path;

use xtask::files::{files_below, text, texts};

#[test]
fn sources_are_ascii() {
    for (path, text) in texts(&[".rs", ".wgsl", ".py", ".toml"]) {
        for (line, number) in text.lines().zip(1..) {
            assert!(line.is_ascii(), "{path}:{number}: {line}");
        }
    }
}

#[test]
fn nothing_is_left_to_do() {
    // We join each from two parts, so that this file does not contain the forbidden macros.
    let needles = ["todo", "unimplemented", "dbg"].map(|word| [word, "!("].concat());
    for (path, text) in texts(&[".rs"]) {
        for needle in &needles {
            assert!(!text.contains(needle), "{path}: {needle}");
        }
    }
}

#[test]
fn every_shader_is_part_of_a_kernel() {
    let sources: String = texts(&[".rs"]).into_values().collect();
    for (path, _) in texts(&[".wgsl"]) {
        let name = Path::new(&path).file_name().unwrap().to_str().unwrap();
        assert!(sources.contains(&format!("{name}\"")), "{path} is in no kernel");
    }
}

/// Whether a content security policy lets a page load nothing from other hosts, and run no code but its own.
fn is_strict(policy: &str) -> bool {
    let rules: Vec<Vec<&str>> =
        policy.split(';').map(|rule| rule.split_whitespace().collect()).collect();
    let sources = |name: &str| rules.iter().find(|rule| rule[0] == name).map(|rule| &rule[1..]);
    let own = ["'self'", "'none'", "'wasm-unsafe-eval'", "'unsafe-inline'", "data:", "blob:"];
    sources("default-src") == Some(&["'none'"])
        && sources("script-src") == Some(&["'self'", "'wasm-unsafe-eval'"])
        && sources("base-uri") == Some(&["'none'"])
        && sources("form-action") == Some(&["'none'"])
        && rules.iter().flat_map(|rule| &rule[1..]).all(|source| own.contains(source))
}

#[test]
fn every_page_has_a_strict_content_security_policy() {
    let pages = files_below("apps/web");
    let pages: Vec<_> = pages.iter().filter(|path| path.ends_with("/page/index.html")).collect();
    assert_eq!(pages.len(), 2, "{pages:?}");
    for path in pages {
        let page = text(path);
        let start = "<meta http-equiv=\"Content-Security-Policy\" content=\"";
        let policy = page.split_once(start).and_then(|(_, rest)| rest.split_once('"'));
        let (policy, _) = policy.unwrap_or_else(|| panic!("{path} has no policy"));
        assert!(is_strict(policy), "{path}: {policy}");
        let (before, _) = page.split_once(start).unwrap();
        assert!(!before.contains("<script") && !before.contains("<link"), "{path}: it comes late");
    }
    let usual = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; form-action 'none'; base-uri 'none'";
    assert!(is_strict(usual));
    for (rule, other) in [
        ("'wasm-unsafe-eval'", "'unsafe-eval'"),
        ("default-src 'none'", "default-src *"),
        ("base-uri 'none'", "base-uri 'none'; img-src https://elsewhere.org"),
    ] {
        assert!(!is_strict(&usual.replace(rule, other)), "{other}");
    }
}

#[test]
fn every_shipped_table_has_its_source() {
    let sources = text("spectra/data/SOURCES.md");
    for path in files_below("spectra/data") {
        let inside = path.strip_prefix("spectra/data/").unwrap();
        let is_listed = inside == "SOURCES.md" || sources.contains(&format!("`{inside}`"));
        assert!(is_listed, "{path} is not in SOURCES.md");
    }
}

#[test]
fn every_measurement_has_its_source() {
    for path in files_below("measurements").iter().filter(|path| !path.ends_with(".md")) {
        let name = path.strip_prefix("measurements/").unwrap();
        let stem = name.split('.').next().unwrap();
        let page = text(&format!("measurements/{stem}.md"));
        // A library is made from the table of the same stem and shares its page.
        let is_listed = name.ends_with(".pigments.json") || page.contains(name);
        assert!(is_listed, "measurements/{stem}.md does not name {name}");
    }
}

#[test]
fn every_painting_has_its_source() {
    let page = text("paintings/README.md");
    for path in files_below("paintings").iter().filter(|path| !path.ends_with("README.md")) {
        let name = path.strip_prefix("paintings/").unwrap();
        assert!(page.contains(&format!("`{name}`")), "paintings/README.md does not name {name}");
    }
}

#[test]
fn every_golden_file_says_how_it_was_made_and_is_compared() {
    let tests: String = texts(&[".rs"]).into_values().collect();
    let golden = files_below("tests/golden");
    for path in golden.iter().filter(|path| path.ends_with(".json")) {
        let file: serde_json::Value = serde_json::from_str(&text(path)).unwrap();
        for key in ["command", "package", "method"] {
            let is_stated = file[key].as_str().is_some_and(|words| !words.is_empty());
            assert!(is_stated, "{path}: {key}");
        }
        let tolerance = file["tolerance"].as_f64();
        assert!(tolerance.is_some_and(|t| t > 0.0 && t < 1e-3), "{path}: {tolerance:?}");
        let stem = Path::new(path).file_stem().unwrap().to_str().unwrap();
        assert!(tests.contains(&format!("read(\"{stem}\")")), "{path} is compared nowhere");
    }
}

#[test]
fn architecture_names_files_that_exist() {
    let page = text("ARCHITECTURE.md");
    let (_, sections) = page.split_once("## Order of files").unwrap();
    let paths: Vec<String> = texts(&[".rs", ".wgsl", ".js"])
        .into_keys()
        .chain(files_below("render/techniques"))
        .collect();
    let mut folders: Vec<&str> = Vec::new();
    let mut checked = 0;
    for line in sections.lines() {
        if let Some(title) = line.strip_prefix("### ") {
            folders = title.split(", ").flat_map(|part| part.split(" and ")).collect();
        }
        // The first cell of a row names files and folders below those of the section's crates.
        let Some(cell) = line.strip_prefix("| `").and_then(|row| row.split(" | ").next()) else {
            continue;
        };
        if line.starts_with("| `let") || line.starts_with("| `use` lines") {
            continue;
        }
        let names = cell.split('`').step_by(2).flat_map(|name| name.split('/'));
        for name in names.filter(|name| !name.is_empty()) {
            let is_there = paths.iter().any(|path| {
                let mut parts = path.split('/');
                parts.any(|part| folders.contains(&part))
                    && parts.any(|part| part.split('.').next() == Some(name))
            });
            assert!(is_there || folders.contains(&name), "ARCHITECTURE.md: {name} of {folders:?}");
            checked += 1;
        }
    }
    assert!(checked > 150, "only {checked} names were found");
}
