//! Allowed dependencies of each crate, and the manifests that name heavy dependencies.

use std::collections::{BTreeMap, BTreeSet};

use xtask::files::{text, texts};

/// Dependencies of every kind in a manifest, by name, each with its line.
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
fn crates_depend_downwards_only() {
    let own = own_crates();
    assert!(own.contains("spectra") && own.contains("calibrate"), "the crates: {own:?}");
    for (folder, below) in [
        ("documents/derive", &[][..]),
        ("documents", &["documents-derive"]),
        ("spectra", &["documents"]),
        ("calibrate/pigment", &["documents", "spectra"]),
        ("calibrate/fit", &["documents", "spectra", "pigment"]),
        ("calibrate/maps", &["documents", "spectra", "pigment", "calibrate"]),
        ("reports", &["documents", "spectra", "calibrate"]),
        ("render/graphics", &["documents", "spectra"]),
        ("render/paint", &["documents", "spectra", "pigment", "graphics"]),
        ("render/techniques/artmap", &["documents", "spectra", "pigment", "graphics", "paint"]),
        (
            "render/techniques/painterly",
            &["documents", "spectra", "pigment", "graphics", "paint", "artmap"],
        ),
        ("render/techniques/strokes", &["documents", "spectra", "pigment", "graphics", "paint"]),
        ("render/techniques/volumes", &["documents", "spectra", "pigment", "graphics", "paint"]),
        ("render/techniques/watercolor", &["documents", "spectra", "pigment", "graphics", "paint"]),
        (
            "render/pictures",
            &[
                "documents",
                "spectra",
                "calibrate",
                "graphics",
                "paint",
                "artmap",
                "painterly",
                "strokes",
                "volumes",
                "watercolor",
            ],
        ),
        ("apps/session", &["documents", "spectra", "pigment", "graphics", "paint", "volumes"]),
        (
            "apps/studio",
            &[
                "documents",
                "spectra",
                "pigment",
                "graphics",
                "paint",
                "artmap",
                "painterly",
                "strokes",
                "volumes",
                "watercolor",
                "session",
            ],
        ),
        (
            "apps/cli",
            &[
                "documents",
                "spectra",
                "calibrate",
                "maps",
                "reports",
                "graphics",
                "paint",
                "artmap",
                "painterly",
                "volumes",
                "watercolor",
                "pictures",
            ],
        ),
    ] {
        let manifest = format!("{folder}/Cargo.toml");
        for (dependency, line) in dependencies(&manifest) {
            let ours = own.contains(&dependency) || line.contains("path =");
            assert!(!ours || below.contains(&dependency.as_str()), "{manifest}: {line}");
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
        let draws = [
            "apps/studio/benches/offscreen.rs",
            "apps/studio/src/window.rs",
            "apps/studio/src/view/canvas.rs",
            "apps/studio/src/view/meshes.rs",
            "apps/studio/src/view/pipeline.rs",
            "apps/studio/src/view/texture.rs",
        ];
        let may = path.starts_with("render/graphics/src/gpu/") || draws.contains(&path.as_str());
        assert!(!named || may, "{path}: {needle}");
        found += usize::from(named);
    }
    assert!(found > 0, "{needle} in no file");
}

#[test]
fn only_programs_parse_arguments() {
    let needle = ["clap", "::"].concat();
    for (path, text) in texts(&[".rs"]) {
        let may = path.starts_with("apps/cli/") || path == "apps/studio/src/arguments.rs";
        assert!(may || !text.contains(&needle), "{path}: {needle}");
    }
    for (path, _) in texts(&["/Cargo.toml"]) {
        let may = path.starts_with("apps/cli/") || path.starts_with("apps/studio/");
        assert!(may || !dependencies(&path).contains_key("clap"), "{path} depends on clap");
    }
}

#[test]
fn cargo_run_runs_the_program() {
    let manifest: toml::Table = text("Cargo.toml").parse().unwrap();
    let default = manifest["workspace"]["default-members"].as_array().unwrap();
    assert_eq!(default, &["apps/cli".into()], "members with several programs need `--bin`");
}

/// The profile of tests in a manifest, without packages that are missing in `lock`.
fn test_profile(manifest: &str, lock: &str) -> toml::Table {
    let manifest: toml::Table = text(manifest).parse().unwrap();
    let mut profile = manifest["profile"]["dev"].as_table().unwrap().clone();
    let packages = profile["package"].as_table_mut().unwrap();
    packages.retain(|name, _| name == "*" || lock.contains(&format!("name = \"{name}\"\n")));
    profile
}

#[test]
fn the_python_package_takes_over_what_the_tests_compiled() {
    let lock = text("apps/python/Cargo.lock");
    let [ours, theirs] =
        ["Cargo.toml", "apps/python/Cargo.toml"].map(|manifest| test_profile(manifest, &lock));
    assert_eq!(ours, theirs, "[profile.dev] of apps/python/Cargo.toml and of the workspace");
}

/// Names and versions of the packages in a lock file.
fn packages(lock: &str) -> BTreeSet<(String, String)> {
    let lock: toml::Table = text(lock).parse().unwrap();
    let all = lock["package"].as_array().unwrap().iter();
    let words = all.map(|package| {
        ["name", "version"].map(|key| package[key].as_str().unwrap().to_owned()).into()
    });
    words.collect()
}

#[test]
fn workspaces_of_their_own_have_the_versions_of_this_one() {
    // Versions that may stand for each other: 1.2 and 1.3, 0.22.1 and 0.22.3.
    let line = |(name, version): &(String, String)| {
        let mut numbers = version.split('.');
        let first = numbers.next().unwrap();
        let second = if first == "0" { numbers.next().unwrap() } else { "" };
        format!("{name} {first}.{second}")
    };
    let workspace = packages("Cargo.lock");
    let known: BTreeSet<String> = workspace.iter().map(line).collect();
    for lock in ["apps/python/Cargo.lock", "apps/web/Cargo.lock"] {
        let theirs = packages(lock);
        assert!(theirs.iter().any(|(name, _)| name == "impasto-calibrate"), "{lock}");
        for package in theirs {
            // Others would be compiled beside those of the tests, and compute other numbers than the program.
            let only_there = !known.contains(&line(&package));
            assert!(only_there || workspace.contains(&package), "{lock}: {package:?}");
        }
    }
}
