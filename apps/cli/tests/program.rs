//! The built program `impasto`: how it ends, and where its output goes.

use std::fs::OpenOptions;
use std::io::Read;
use std::process::{Command, Stdio};

fn impasto() -> Command {
    Command::new(env!("CARGO_BIN_EXE_impasto"))
}

#[test]
fn help_goes_to_the_output_and_faults_of_usage_to_the_error_stream() {
    let help = impasto().arg("--help").output().unwrap();
    assert_eq!(help.status.code(), Some(0));
    assert!(String::from_utf8(help.stdout).unwrap().contains("Usage: impasto"), "the usage");
    assert!(help.stderr.is_empty(), "nothing went wrong");
    let wrong = impasto().arg("no-such-verb").output().unwrap();
    assert_eq!(wrong.status.code(), Some(2));
    assert!(wrong.stdout.is_empty(), "there is no result");
    assert!(String::from_utf8(wrong.stderr).unwrap().contains("no-such-verb"), "the word");
}

#[cfg(unix)]
#[test]
fn a_reader_that_closes_the_pipe_early_is_no_fault() {
    let mut child =
        impasto().arg("--help").stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let mut errors = String::new();
    child.stderr.take().unwrap().read_to_string(&mut errors).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(0), "{errors}");
    assert!(errors.is_empty(), "{errors}");
}

#[cfg(target_os = "linux")]
#[test]
fn results_that_cannot_be_written_end_with_status_2() {
    let full = OpenOptions::new().write(true).open("/dev/full").unwrap();
    let done = impasto().arg("--help").stdout(full).output().unwrap();
    let errors = String::from_utf8(done.stderr).unwrap();
    assert_eq!(done.status.code(), Some(2), "{errors}");
    assert!(errors.contains("cannot write the results"), "{errors}");
}
