//! The Python package, and checks that run in Python, e.g. of golden files, or of scans and maps in
//! other programs.

use std::path::{Path, PathBuf};

use xtask::files::text;

use crate::runs::{Outcome, Run, target};

/// Lists of packages: for golden files and the tests of the Python package, for the checks of maps,
/// and for the checks of texts and scripts.
const REQUIREMENTS: [&[&str]; 3] = [
    &["tests/golden/requirements.txt", "apps/python/tests/requirements.txt"],
    &["calibrate/maps/tests/python/requirements.txt"],
    &["xtask/requirements.txt"],
];

/// Makes the virtual environment with these packages, in the folder of build output. If a list of
/// packages has changed, this makes it again.
pub(crate) fn python() -> Outcome<PathBuf> {
    let folder = target().join("python");
    let wanted: String = REQUIREMENTS.concat().into_iter().map(text).collect();
    let stamp = folder.join("requirements");
    if std::fs::read_to_string(&stamp).is_ok_and(|there| there == wanted) {
        return Ok(folder);
    }
    Run::new("python3").words("-m venv --clear").args([&folder]).go()?;
    for lists in REQUIREMENTS {
        let lists = lists.iter().flat_map(|list| ["-r", list]);
        pip_install(&folder).args(lists).go()?;
    }
    std::fs::write(&stamp, wanted).map_err(|error| format!("{}: {error}", stamp.display()))?;
    Ok(folder)
}

fn pip_install(folder: &Path) -> Run {
    Run::new(folder.join("bin/pip")).words("install -q --disable-pip-version-check")
}

/// Prepares a program of the virtual environment, so that it finds the other programs there.
fn of_python(folder: &Path, program: &str) -> Outcome<Run> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders = std::iter::once(folder.join("bin")).chain(std::env::split_paths(&path));
    let path = std::env::join_paths(folders).map_err(|error| error.to_string())?;
    Ok(Run::new(folder.join("bin").join(program)).env("PATH", path))
}

/// `wheel [--prepare | --build | --test]`: builds the wheel and tests it, or does one of both, or
/// only fetches what they need. We build the wheel with the profile and the folder of the tests, so
/// that it takes over their crates.
pub(crate) fn wheel(step: Option<&str>) -> Outcome {
    let python = python()?;
    let wheels = target().join("wheels");
    if matches!(step, None | Some("--build")) {
        std::fs::remove_dir_all(&wheels).ok();
        let build = of_python(&python, "maturin")?.words("build -q --locked -o").args([&wheels]);
        build.env("CARGO_TARGET_DIR", target()).inside("apps/python").go()?;
    }
    if matches!(step, None | Some("--test")) {
        let built = std::fs::read_dir(&wheels).into_iter().flatten().flatten();
        let built: Vec<PathBuf> = built.map(|entry| entry.path()).collect();
        pip_install(&python).words("--no-deps --force-reinstall").args(built).go()?;
        test_wheel(&python)?;
    }
    Ok(())
}

/// Checks types and runs the tests of the installed package.
fn test_wheel(python: &Path) -> Outcome {
    let folder = "apps/python";
    of_python(python, "mypy")?.words("src/impasto tests").inside(folder).go()?;
    // It fetches itself from npm, which not every machine can reach.
    if of_python(python, "pyright")?.words("--version").inside(folder).works() {
        of_python(python, "pyright")?.inside(folder).go()?;
    } else {
        println!("pyright did not run: npm cannot be reached");
    }
    let allowed = "impasto --ignore-disjoint-bases --allowlist tests/stubtest.txt";
    of_python(python, "stubtest")?.words(allowed).inside(folder).go()?;
    of_python(python, "pytest")?.words("-q").inside(folder).go()
}

/// `golden [--built]`: makes the golden files with the pinned colour-science, and reads scans and
/// maps with other programs. Pass `--built` to take the built example. Cargo, which would wait for
/// other builds, is then not asked.
pub(crate) fn golden(built: bool) -> Outcome {
    let python = python()?;
    let generate =
        of_python(&python, "python")?.words("-W ignore tests/golden/generate.py --check");
    generate.go()?;
    if !built {
        Run::cargo("build --locked -p impasto-maps --example light_and_dark").go()?;
    }
    let check = of_python(&python, "python")?.words("calibrate/maps/tests/python/check.py");
    check.args([target().join("debug/examples/light_and_dark")]).go()
}
