//! Sends signals to the built program: it leaves no half-written file, and ends by the signal.

#![cfg(unix)]
#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use std::io::{BufRead, BufReader};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// A script that saves its painting after every stroke, so that most signals come during a save.
fn endless(folder: &Path) -> String {
    let stroke = r#"{"stroke": {"brush": "flat", "samples": [[0, 3, 4, 0.4], [0.1, 9, 5, 0.6]]}}"#;
    let save = r#"{"save": {"path": "saved.exr"}}"#;
    let actions = vec![format!("{stroke}, {save}"); 2000].join(", ");
    let text = format!(
        r#"{{"format": "strokes", "version": 1, "title": "Endless",
        "canvas": {{"width_mm": 60, "height_mm": 40, "cell_mm": 0.2}},
        "palette": {{"W": "Lead White"}}, "brushes": {{"flat": {{"shape": "flat", "size_mm": 5}}}},
        "actions": [{{"load": {{"brush": "flat", "recipe": {{"W": 1}}, "amount_mm": 0.3}}}}, {actions}]}}"#
    );
    let path = folder.join("endless.json");
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

fn send(child: &Child, signal: &str) {
    let kill = format!("kill -{signal} {}", child.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success(), "{kill}");
}

fn temporary(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    names.filter(|name| name.starts_with(".impasto-")).collect()
}

/// Waits until the first save is done.
fn saved(child: &mut Child, file: &Path) {
    while !file.exists() {
        assert!(child.try_wait().unwrap().is_none(), "it ended without a save");
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn a_signal_leaves_no_temporary_file_and_is_the_status() {
    let folder = tempfile::tempdir().unwrap();
    let script = endless(folder.path());
    let file = folder.path().join("saved.exr");
    for (moment, (name, number)) in
        [("INT", 2), ("TERM", 15), ("HUP", 1)].iter().cycle().take(18).enumerate()
    {
        let _ = std::fs::remove_file(&file);
        let mut child = Command::new(env!("CARGO_BIN_EXE_impasto"))
            .args(["paint", &script, "--backend", "cpu"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        saved(&mut child, &file);
        std::thread::sleep(Duration::from_millis(3 * moment as u64));
        send(&child, name);
        let status = child.wait().unwrap();
        assert_eq!(status.signal(), Some(*number), "{name}: {status}");
        assert!(temporary(folder.path()).is_empty(), "{name}: {:?}", temporary(folder.path()));
        let bytes = std::fs::read(&file).unwrap();
        assert!(bytes.len() > 1000, "the file is whole");
    }
}

#[test]
fn a_run_that_ends_before_its_first_write_makes_no_folder() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let [library, samples] = ["van-gogh-oils.pigments.json", "van-gogh-oils.csv"]
        .map(|name| format!("{}/../../measurements/{name}", env!("CARGO_MANIFEST_DIR")));
    let mut child = Command::new(env!("CARGO_BIN_EXE_impasto"))
        .args(["report", &library, &samples, "-o", out.to_str().unwrap()])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // It prints what it read, checks its folder, then refits and draws for a while.
    let mut messages = BufReader::new(child.stderr.take().unwrap());
    messages.read_line(&mut String::new()).unwrap();
    std::thread::sleep(Duration::from_millis(50));
    send(&child, "TERM");
    assert_eq!(child.wait().unwrap().signal(), Some(15), "it ended before");
    assert!(!out.exists(), "an empty folder is left");
}

#[test]
fn a_shell_sees_128_and_the_number() {
    let folder = tempfile::tempdir().unwrap();
    let script = endless(folder.path());
    let file = folder.path().join("saved.exr");
    let program = env!("CARGO_BIN_EXE_impasto");
    let line = format!(
        "'{program}' paint '{script}' --backend cpu & child=$!; \
         while ! [ -e '{}' ]; do sleep 0.01; done; kill -TERM $child; wait $child; echo $?",
        file.display()
    );
    let output = Command::new("sh").args(["-c", &line]).output().unwrap();
    assert_eq!(String::from_utf8_lossy(&output.stdout).trim(), "143");
}

#[cfg(target_os = "linux")]
#[test]
fn a_signal_that_was_ignored_at_the_start_stays_ignored() {
    let folder = tempfile::tempdir().unwrap();
    let script = endless(folder.path());
    let file = folder.path().join("saved.exr");
    let line = format!(
        "trap '' HUP; exec '{}' paint '{script}' --backend cpu",
        env!("CARGO_BIN_EXE_impasto")
    );
    let mut child = Command::new("sh").args(["-c", &line]).stdout(Stdio::null()).spawn().unwrap();
    saved(&mut child, &file);
    send(&child, "HUP");
    std::thread::sleep(Duration::from_millis(300));
    assert!(child.try_wait().unwrap().is_none(), "it goes on, as nohup asks");
    send(&child, "TERM");
    assert_eq!(child.wait().unwrap().signal(), Some(15));
}

#[test]
fn a_killed_run_is_cleaned_up_by_the_next_write() {
    let folder = tempfile::tempdir().unwrap();
    let script = endless(folder.path());
    let file = folder.path().join("saved.exr");
    // Killed as soon as a temporary file is seen, until one is left.
    for _ in 0..50 {
        let mut child = Command::new(env!("CARGO_BIN_EXE_impasto"))
            .args(["paint", &script, "--backend", "cpu"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        saved(&mut child, &file);
        while temporary(folder.path()).is_empty() {
            assert!(child.try_wait().unwrap().is_none(), "it ended before it was killed");
        }
        child.kill().unwrap();
        child.wait().unwrap();
        if !temporary(folder.path()).is_empty() {
            break;
        }
        let _ = std::fs::remove_file(&file);
    }
    assert!(!temporary(folder.path()).is_empty(), "no kill came during a write");
    let other = folder.path().join("other.json");
    let done = Command::new(env!("CARGO_BIN_EXE_impasto"))
        .args(["library", "from-rgb", "#ffffff", "--name", "White", "-o", other.to_str().unwrap()])
        .output()
        .unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    if Path::new("/proc/self").exists() {
        assert!(temporary(folder.path()).is_empty(), "{:?}", temporary(folder.path()));
    }
}
