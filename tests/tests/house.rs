//! The rules of this house, read from its files.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

const LONGEST_FILE: usize = 400;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned()
}

/// Every file below `folder`, as paths from the root; what is built and what
/// is hidden left out.
fn files_below(folder: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_str().unwrap();
            if name.starts_with('.') || ["target", "out", "__pycache__"].contains(&name) {
                continue;
            }
            if path.is_dir() {
                folders.push(path);
            } else {
                found.push(path.strip_prefix(root()).unwrap().to_str().unwrap().to_owned());
            }
        }
    }
    found.sort();
    found
}

/// Every file whose name ends in one of `endings`, with its text.
fn texts(endings: &[&str]) -> BTreeMap<String, String> {
    let files = files_below("");
    let wanted = files.into_iter().filter(|path| endings.iter().any(|end| path.ends_with(end)));
    let found: BTreeMap<_, _> = wanted.map(|path| (path.clone(), text(&path))).collect();
    assert!(!found.is_empty(), "no file ends in {endings:?}");
    found
}

fn text(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The dependencies of a manifest, of every kind, each with its line.
fn dependencies(manifest: &str) -> BTreeMap<String, String> {
    let mut section = "";
    let mut found = BTreeMap::new();
    let text = text(manifest);
    for line in text.lines().map(str::trim).filter(|line| !line.is_empty()) {
        if let Some(header) = line.strip_prefix('[') {
            section = header.trim_end_matches(']');
            if let Some((_, name)) = section.split_once("dependencies.") {
                found.insert(name.to_owned(), String::new());
            }
        } else if section.ends_with("dependencies") && !line.starts_with('#') {
            let name = line.split(['.', '=', ' ']).next().unwrap();
            found.insert(name.to_owned(), line.to_owned());
        }
    }
    found
}

/// The crates of this workspace: dependencies that have a path.
fn own_crates() -> BTreeSet<String> {
    let all = dependencies("Cargo.toml");
    let own = all.into_iter().filter(|(_, line)| line.contains("path =")).map(|(name, _)| name);
    own.collect()
}

#[test]
fn no_source_file_is_too_long() {
    for (path, text) in texts(&[".rs", ".wgsl"]) {
        let lines = text.lines().count();
        assert!(lines <= LONGEST_FILE, "{path}: {lines} lines");
    }
}

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
    // In two parts, so that this file does not hold what it forbids.
    let needles = ["todo", "unimplemented", "dbg"].map(|word| [word, "!("].concat());
    for (path, text) in texts(&[".rs"]) {
        for needle in &needles {
            assert!(!text.contains(needle), "{path}: {needle}");
        }
    }
}

#[test]
fn crates_depend_downwards_only() {
    let own = own_crates();
    assert!(own.contains("spectra") && own.contains("calibrate"), "the crates: {own:?}");
    for (folder, below) in [
        ("spectra", &[][..]),
        ("calibrate/pigment", &["spectra"]),
        ("calibrate", &["spectra", "pigment"]),
        ("reports", &["spectra", "calibrate"]),
        ("render/graphics", &["spectra"]),
        ("render/paint", &["spectra", "pigment", "graphics"]),
        ("render", &["spectra", "pigment", "graphics", "paint"]),
        ("cli", &["spectra", "calibrate", "reports", "render"]),
        ("studio/session", &["spectra", "pigment", "render"]),
        ("studio", &["spectra", "pigment", "render", "session"]),
    ] {
        let manifest = format!("{folder}/Cargo.toml");
        for (dependency, line) in dependencies(&manifest) {
            let ours = own.contains(&dependency) || line.contains("path =");
            assert!(!ours || below.contains(&dependency.as_str()), "{manifest}: {line}");
        }
    }
}

/// The modules of a crate in the order of its `lib.rs`.
fn modules(lib: &str) -> Vec<&str> {
    let declared = lib.lines().filter_map(|line| {
        line.strip_prefix("pub ").unwrap_or(line).strip_prefix("mod ")?.strip_suffix(';')
    });
    declared.collect()
}

#[test]
fn modules_use_only_what_stands_above_them() {
    for folder in [
        "spectra",
        "calibrate/pigment",
        "calibrate",
        "reports",
        "render/graphics",
        "render/paint",
        "render",
        "studio/session",
        "studio",
    ] {
        let lib = text(&format!("{folder}/src/lib.rs"));
        let order = modules(&lib);
        for path in files_below(&format!("{folder}/src")) {
            let inside = path.strip_prefix(&format!("{folder}/src/")).unwrap();
            let module = inside.split(['/', '.']).next().unwrap();
            let Some(own) = order.iter().position(|m| *m == module) else { continue };
            let source = text(&path);
            let code = source.split("#[cfg(test)]").next().unwrap();
            for used in code.split("crate::").skip(1) {
                let used = used.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap();
                let place = order.iter().position(|m| *m == used);
                assert!(place.is_none_or(|place| place <= own), "{path} uses {used}, below it");
            }
        }
    }
}

#[test]
fn the_solver_the_plotter_and_the_painter_are_each_named_in_one_file() {
    for name in ["clarabel", "plotters", "resvg"] {
        let needle = [name, "::"].concat();
        let mut texts = texts(&[".rs"]);
        texts.retain(|path, text| !path.starts_with("tests/") && text.contains(&needle));
        let paths: Vec<_> = texts.keys().collect();
        assert_eq!(paths.len(), 1, "{needle} in {paths:?}");
    }
}

#[test]
fn the_graphics_device_is_named_in_one_folder_and_where_the_window_draws() {
    let needle = ["wgpu", "::"].concat();
    let mut found = 0;
    for (path, text) in texts(&[".rs"]) {
        let named = text.contains(&needle);
        let draws =
            ["studio/src/window.rs", "studio/src/view/quad.rs", "studio/src/view/pipeline.rs"];
        let may = path.starts_with("render/graphics/src/gpu/") || draws.contains(&path.as_str());
        assert!(!named || may, "{path}: {needle}");
        found += usize::from(named);
    }
    assert!(found > 0, "{needle} in no file");
}

#[test]
fn every_shader_is_part_of_a_kernel() {
    let sources: String = texts(&[".rs"]).into_values().collect();
    for (path, _) in texts(&[".wgsl"]) {
        let name = Path::new(&path).file_name().unwrap().to_str().unwrap();
        assert!(sources.contains(&format!("{name}\"")), "{path} is in no kernel");
    }
}

#[test]
fn only_programs_parse_arguments() {
    let needle = ["clap", "::"].concat();
    for (path, text) in texts(&[".rs"]) {
        let may = path.starts_with("cli/") || path == "studio/src/arguments.rs";
        assert!(may || !text.contains(&needle), "{path}: {needle}");
    }
    for (path, _) in texts(&["/Cargo.toml"]) {
        let may = path.starts_with("cli/") || path.starts_with("studio/");
        assert!(may || !dependencies(&path).contains_key("clap"), "{path} depends on clap");
    }
}

#[test]
fn every_shipped_table_has_its_source() {
    let sources = text("spectra/data/SOURCES.md");
    for path in files_below("spectra/data") {
        let inside = path.strip_prefix("spectra/data/").unwrap();
        let told = inside == "SOURCES.md" || sources.contains(&format!("`{inside}`"));
        assert!(told, "{path} is not in SOURCES.md");
    }
}

#[test]
fn every_measurement_has_its_source() {
    for path in files_below("measurements").iter().filter(|path| !path.ends_with(".md")) {
        let name = path.strip_prefix("measurements/").unwrap();
        let stem = name.split('.').next().unwrap();
        let page = text(&format!("measurements/{stem}.md"));
        // A library is made from the table of the same stem, by one page.
        let told = name.ends_with(".pigments.json") || page.contains(name);
        assert!(told, "measurements/{stem}.md does not name {name}");
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
            let told = file[key].as_str().is_some_and(|words| !words.is_empty());
            assert!(told, "{path}: {key}");
        }
        let tolerance = file["tolerance"].as_f64();
        assert!(tolerance.is_some_and(|t| t > 0.0 && t < 1e-3), "{path}: {tolerance:?}");
        let stem = Path::new(path).file_stem().unwrap().to_str().unwrap();
        assert!(tests.contains(&format!("read(\"{stem}\")")), "{path} is compared nowhere");
    }
}
