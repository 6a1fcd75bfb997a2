//! The program in a child process: killed while it saves, and without a graphics driver.
//!
//! A test cannot locate the program of another package, so the child is this test binary, which
//! runs one ignored test that calls the program.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use paint::file;

use super::program::{SCRIPT, place, script};

const ARGUMENTS: &str = "IMPASTO_CHILD_ARGUMENTS";

/// Runs `impasto` with the arguments in [`ARGUMENTS`]; without them it does nothing.
#[test]
#[ignore = "the child of the tests below"]
fn child() {
    let Ok(arguments) = std::env::var(ARGUMENTS) else { return };
    let arguments: Vec<&str> = arguments.split('\n').collect();
    let run = suite::program::impasto(&arguments);
    super::studio::tell(&format!("{}\nstatus {}\n{}", run.out, run.status, run.err));
}

/// A command that runs `impasto` with `arguments` in a child process.
fn program(arguments: &[&str]) -> Command {
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args(["--exact", "killed::child", "--ignored", "--nocapture", "--test-threads=1"]);
    command.env(ARGUMENTS, arguments.join("\n")).stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

/// Runs `command` and returns its stderr: output, exit status and errors of the program.
fn told(mut command: Command) -> String {
    String::from_utf8_lossy(&command.output().unwrap().stderr).into_owned()
}

fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

#[test]
fn a_painter_killed_at_any_moment_leaves_the_old_file_or_the_new_one_whole() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    // The script saves after every stroke, so most kills fall into a save.
    let mut text: serde_json::Value = serde_json::from_str(SCRIPT).unwrap();
    let actions = text["actions"].as_array_mut().unwrap();
    actions.pop();
    let stroke = actions[1].clone();
    for _ in 0..500 {
        actions.push(serde_json::json!({"save": {"path": "saved.exr"}}));
        actions.push(stroke.clone());
    }
    let endless = place(folder, "endless.json");
    std::fs::write(&endless, text.to_string()).unwrap();
    let saved = folder.join("saved.exr");
    let short = script(folder, "", "");
    let saved_name = saved.to_str().unwrap();
    assert!(
        told(program(&["paint", &short, "--backend", "cpu", "--output", saved_name]))
            .contains("status 0")
    );
    let old = std::fs::read(&saved).unwrap();
    let mut kept = 0;
    let mut new = 0;
    for moment in 0..12 {
        std::fs::write(&saved, &old).unwrap();
        let mut child = program(&["paint", &endless, "--backend", "cpu"]).spawn().unwrap();
        // The first four children may die before their first save, the others die after it.
        while moment > 3 && std::fs::read(&saved).unwrap() == old {
            assert!(child.try_wait().unwrap().is_none(), "it ended without a save");
            std::thread::sleep(Duration::from_millis(5));
        }
        // After its first save, every second child is killed at once.
        let wait = if moment > 3 && moment % 2 == 0 { 0 } else { 7 * moment };
        std::thread::sleep(Duration::from_millis(wait));
        child.kill().unwrap();
        let _ = child.wait().unwrap();
        let found = std::fs::read(&saved).unwrap();
        if found == old {
            kept += 1;
        } else {
            new += 1;
            let document = file::read("saved.exr", &found).unwrap();
            assert_eq!(document.title, "A trial");
        }
    }
    assert!(kept > 0 && new > 0, "{kept} times the old file, {new} times a new one");
    let left = files(folder);
    let strange = |name: &&String| !name.ends_with(".json") && *name != "saved.exr";
    let strange: Vec<_> = left.iter().filter(strange).collect();
    assert!(strange.iter().all(|name| name.starts_with(".impasto-")), "{strange:?}");
}

#[test]
fn without_a_driver_the_processor_paints_unless_a_device_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let script = script(folder, "", "");
    let picture = place(folder, "a.png");
    let without = |backend: &str| {
        let mut run = program(&["paint", &script, "--backend", backend, "--picture", &picture]);
        for variable in ["VK_ICD_FILENAMES", "VK_DRIVER_FILES"] {
            run.env(variable, "/nowhere/driver.json");
        }
        told(run)
    };
    let refused = without("gpu");
    assert!(refused.contains("status 2"), "{refused}");
    assert!(refused.contains("hint: paint on the processor: --backend cpu"), "{refused}");
    assert!(!Path::new(&picture).exists(), "refused, but a picture was written");
    let painted = without("auto");
    assert!(painted.contains("status 0") && painted.contains("on the processor"), "{painted}");
    assert!(Path::new(&picture).exists(), "no picture");
}
