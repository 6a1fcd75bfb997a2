//! Everything that we check before we merge a change, in as little time as two cores allow.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::time::{Duration, Instant};

use crate::runs::{Environment, Outcome, Row, Run, end_descendants, target};
use crate::{checks, pages, testing};

/// `ci`: format, lints and every test. Wheel, pages, reference and golden files run beside the
/// tests.
pub(crate) fn ci() -> Outcome {
    let outcome = stages();
    if outcome.is_err() {
        end_descendants();
    }
    outcome
}

/// Prints the stages as they begin, and how long each took.
struct Clock {
    start: Instant,
    stages: Vec<(String, Duration)>,
}

impl Clock {
    fn stage<T>(&mut self, name: &str, run: impl FnOnce() -> Outcome<T>) -> Outcome<T> {
        println!("== {name}");
        let start = Instant::now();
        let outcome = run();
        let time = start.elapsed();
        println!("   ({} s)", time.as_secs());
        self.stages.push((name.to_owned(), time));
        outcome
    }

    fn table(&self) -> String {
        let mut rows = String::new();
        for (name, time) in &self.stages {
            let _ = writeln!(rows, "{:6} s  {name}", time.as_secs());
        }
        let seconds = self.start.elapsed().as_secs();
        rows + &format!("{} min {} s in all", seconds / 60, seconds % 60)
    }
}

fn stages() -> Outcome {
    let mut clock = Clock { start: Instant::now(), stages: Vec::new() };
    let folder = target().join("ci");
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let program = own_copy(&folder)?;
    let none = Environment::new();
    // Packages are fetched while Rust compiles.
    let python =
        Row::begin("python packages", &program, &folder, &none, |row| row.part("wheel --prepare"))?;
    let browser = Row::begin("browser packages", &program, &folder, &none, |row| {
        row.part("pages --prepare")
    })?;

    clock.stage("formatting", || checks::fmt(true))?;
    clock.stage("lints", || checks::lint(&[]))?;
    let build = "test --workspace --locked --no-run --timings";
    clock.stage("build of the tests", || Run::cargo(build).go())?;
    print!("{}", slowest_crates(15));
    let adapter = clock.stage("graphics adapter", adapter)?;
    clock.stage("packages, fetched beside", || {
        python.finish()?;
        browser.finish()
    })?;
    clock.stage("spelling and scripts", checks::texts_and_scripts)?;

    let tests_on = folder.join("adapters");
    fs::write(&tests_on, "").map_err(|error| error.to_string())?;
    let mut environment = adapter.clone();
    // Every test that wants an adapter adds a line: the one that it ran on, or none.
    environment.push(("IMPASTO_GPU_TESTS", tests_on.clone().into()));
    let mut rows = None;
    let workspace = ["--workspace".to_owned(), "--locked".to_owned()];
    let (counts, worked) = clock.stage("tests (unit, suite and doc tests)", || {
        testing::by_cargo(&workspace, &environment, || {
            rows = Some(begin_rows(&program, &folder, &adapter)?);
            Ok(())
        })
    })?;
    if !worked {
        println!("{counts}");
        return Err("tests failed".to_owned());
    }
    let (builds, checks) = rows.ok_or("cargo ran no test")?;
    let time = clock.stage("wheel, pages and reference, begun beside", || builds.finish())?;
    clock.stages.push((" of it beside".to_owned(), time));
    clock.stage("page in the browser", || pages::pages(Some("--test"), true))?;
    let time = clock.stage("golden files and Python, begun beside", || checks.finish())?;
    clock.stages.push((" of it beside".to_owned(), time));

    println!("== result\n{}\ntests on a graphics adapter:", clock.table());
    let names = fs::read_to_string(&tests_on).map_err(|error| error.to_string())?;
    for (adapter, number) in testing::adapters(&names)? {
        println!("{number:7} {adapter}");
    }
    println!("{counts}");
    Ok(())
}

/// Copies this program to `folder`, because cargo may rewrite the original while we run it.
fn own_copy(folder: &Path) -> Outcome<PathBuf> {
    let copy = folder.join("xtask");
    fs::remove_file(&copy).ok();
    let own = std::env::current_exe().map_err(|error| error.to_string())?;
    fs::copy(own, &copy).map_err(|error| format!("{}: {error}", copy.display()))?;
    Ok(copy)
}

/// Starts two rows of parts beside the tests, because tests leave a core idle at times. The first row
/// builds the wheel (with crates that the tests compiled), the pages and the reference one after the
/// other, because cargo allows only one build at a time. The second row runs checks in Python.
fn begin_rows(program: &Path, folder: &Path, environment: &Environment) -> Outcome<(Row, Row)> {
    let (is_built, built) = mpsc::channel();
    let builds = Row::begin("builds", program, folder, environment, move |row| {
        row.part("wheel --build")?;
        is_built.send(()).ok();
        row.part("pages --build --built")?;
        row.part("docs")
    })?;
    let checks = Row::begin("checks", program, folder, environment, move |row| {
        row.part("golden --built")?;
        built.recv().map_err(|_| "the wheel was not built".to_owned())?;
        row.part("wheel --test")
    })?;
    Ok((builds, checks))
}

/// Prints the graphics adapters. If there is none but a software adapter, this returns the
/// environment in which programs find it.
fn adapter() -> Outcome<Environment> {
    // Mesa's layer that chooses among devices asks for a display, which CI has not.
    let mut environment = vec![("NODEVICE_SELECT", "1".into())];
    let list = Run::new(target().join("debug/impasto")).words("gpu").env("NODEVICE_SELECT", "1");
    let list = list.output()?;
    println!("{list}");
    let kinds = ["discrete", "integrated", "virtual", "other"];
    if !list.lines().any(|line: &str| {
        let line = line.strip_prefix("   ").unwrap_or_default();
        kinds.iter().any(|kind| line.starts_with(&format!("{kind}, ")))
    }) {
        let drivers = fs::read_dir("/usr/share/vulkan/icd.d").into_iter().flatten().flatten();
        let paths = drivers.map(|entry| entry.path());
        let lavapipe = paths.filter(|path| path.to_string_lossy().contains("/lvp_icd")).min();
        let lavapipe =
            lavapipe.ok_or("no graphics adapter, and no Mesa: install mesa-vulkan-drivers")?;
        println!("no hardware adapter: the tests run on {}", lavapipe.display());
        environment.push(("VK_ICD_FILENAMES", lavapipe.into()));
    }
    Ok(environment)
}

/// The crates on which cargo spent most time in its last build with `--timings`, one a line.
fn slowest_crates(most: usize) -> String {
    let page = target().join("cargo-timings/cargo-timing.html");
    let mut units = timed_units(&fs::read_to_string(page).unwrap_or_default());
    units.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    let mut lines = String::new();
    for (name, seconds) in units.iter().take(most) {
        let _ = writeln!(lines, "{seconds:9.1} s  {name}");
    }
    lines
}

/// Reads name and seconds of every unit from cargo's page of timings, which holds them as JSON.
fn timed_units(page: &str) -> Vec<(String, f64)> {
    let data = page.split("const UNIT_DATA = ").nth(1).unwrap_or_default();
    let data = data.split("];").next().unwrap_or_default();
    let units = data.split('}').filter_map(|unit| {
        let name = value_of(unit, "name")?;
        let kind = value_of(unit, "target").unwrap_or_default();
        let seconds = value_of(unit, "duration")?.parse().ok()?;
        Some((format!("{name}{kind}"), seconds))
    });
    units.collect()
}

/// Value of `key` in a JSON object without objects inside.
fn value_of<'a>(unit: &'a str, key: &str) -> Option<&'a str> {
    let rest = unit.split(&format!("\"{key}\": ")).nth(1)?;
    match rest.strip_prefix('"') {
        Some(text) => text.split('"').next(),
        None => rest.split([',', '\n']).next().map(str::trim),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_a_page_of_timings_are_read() {
        let page = "const UNIT_DATA = [\n  {\n    \"i\": 0,\n    \"name\": \"wide\",\n    \"version\": \"1.0\",\n    \
            \"mode\": \"todo\",\n    \"target\": \" (test)\",\n    \"start\": 0.1,\n    \"duration\": 6.23,\n    \
            \"unblocked_units\": []\n  },\n  {\n    \"name\": \"b\",\n    \"target\": \"\",\n    \"duration\": 1\n  }\n];\nconst";
        let units = timed_units(page);
        assert_eq!(units, [("wide (test)".to_owned(), 6.23), ("b".to_owned(), 1.0)]);
    }
}
