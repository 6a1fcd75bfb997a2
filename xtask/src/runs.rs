//! Runs programs in the root of the workspace, e.g. to read their output, or several of them at the
//! same time.

use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use xtask::files::root;

/// Result of a part. We print the text of an error as it is.
pub(crate) type Outcome<T = ()> = Result<T, String>;

#[derive(Debug)]
pub(crate) struct Run {
    command: Command,
}

impl Run {
    pub(crate) fn new(program: impl AsRef<OsStr>) -> Self {
        let mut command = Command::new(program);
        command.current_dir(root());
        // Cargo describes the package of this program to it. Other builds would take that for their own.
        for (name, _) in std::env::vars_os() {
            let name = name.to_string_lossy();
            if name.starts_with("CARGO_PKG_") || name.starts_with("CARGO_MANIFEST_") {
                command.env_remove(&*name);
            }
        }
        Self { command }
    }

    pub(crate) fn cargo(words: &str) -> Self {
        Self::new("cargo").words(words)
    }

    /// Adds arguments, with spaces between them.
    pub(crate) fn words(self, words: &str) -> Self {
        self.args(words.split_whitespace())
    }

    pub(crate) fn args(mut self, args: impl IntoIterator<Item = impl AsRef<OsStr>>) -> Self {
        self.command.args(args);
        self
    }

    pub(crate) fn env(mut self, name: &str, value: impl AsRef<OsStr>) -> Self {
        self.command.env(name, value);
        self
    }

    /// Runs in `folder`, a path from the root.
    pub(crate) fn inside(mut self, folder: &str) -> Self {
        self.command.current_dir(root().join(folder));
        self
    }

    pub(crate) fn logged(mut self, file: &File) -> Outcome<Self> {
        let [out, errors] =
            [file, file].map(|file| file.try_clone().map_err(|error| error.to_string()));
        self.command.stdin(Stdio::null()).stdout(out?).stderr(errors?);
        Ok(self)
    }

    /// Runs this and waits. If it fails, you get an error.
    pub(crate) fn go(mut self) -> Outcome {
        let status = self.command.status().map_err(|error| self.fault(&error.to_string()))?;
        self.check(status)
    }

    /// Standard output, without the last line break.
    pub(crate) fn output(mut self) -> Outcome<String> {
        self.command.stderr(Stdio::inherit());
        let output = self.command.output().map_err(|error| self.fault(&error.to_string()))?;
        self.check(output.status)?;
        Ok(String::from_utf8_lossy(&output.stdout).trim_end().to_owned())
    }

    /// Passes each line of both outputs to `line`, and returns whether the program ended well.
    pub(crate) fn lines(mut self, mut line: impl FnMut(&str)) -> Outcome<bool> {
        let (reader, writer) = std::io::pipe().map_err(|error| error.to_string())?;
        let twin = writer.try_clone().map_err(|error| error.to_string())?;
        self.command.stdout(writer).stderr(twin);
        let mut child = self.command.spawn().map_err(|error| self.fault(&error.to_string()))?;
        // This process holds the other end of the pipe as long as it holds the command.
        drop(self);
        for text in BufReader::new(reader).split(b'\n') {
            let text = text.map_err(|error| error.to_string())?;
            line(String::from_utf8_lossy(&text).trim_end_matches('\r'));
        }
        Ok(child.wait().map_err(|error| error.to_string())?.success())
    }

    /// Whether you can start it and it ends well. This drops the output.
    pub(crate) fn works(mut self) -> bool {
        let quiet = self.command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        quiet.status().is_ok_and(|status| status.success())
    }

    fn check(&self, status: ExitStatus) -> Outcome {
        if status.success() { Ok(()) } else { Err(self.fault(&status.to_string())) }
    }

    fn fault(&self, reason: &str) -> String {
        let words = std::iter::once(self.command.get_program()).chain(self.command.get_args());
        let words: Vec<_> = words.map(OsStr::to_string_lossy).collect();
        format!("`{}`: {reason}", words.join(" "))
    }
}

pub(crate) fn target() -> PathBuf {
    root().join(std::env::var_os("CARGO_TARGET_DIR").unwrap_or_else(|| "target".into()))
}

pub(crate) fn is_installed(program: &str) -> bool {
    let folders = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&folders).any(|folder| folder.join(program).is_file())
}

pub(crate) type Environment = Vec<(&'static str, OsString)>;

/// Parts that run one after the other beside the tests. They have a low priority, so that they only
/// use time that the tests leave.
#[derive(Debug)]
pub(crate) struct Row {
    name: &'static str,
    log: PathBuf,
    thread: JoinHandle<(Outcome, Duration)>,
}

/// Runs the parts of a row. Each calls this program again and writes to the log of the row.
#[derive(Debug)]
pub(crate) struct RowRunner {
    program: PathBuf,
    log: File,
    environment: Environment,
}

impl RowRunner {
    pub(crate) fn part(&self, words: &str) -> Outcome {
        let run = match is_installed("nice") {
            true => Run::new("nice").words("-n 10").args([&self.program]),
            false => Run::new(&self.program),
        };
        let start = Instant::now();
        let run = self.environment.iter().fold(run, |run, (name, value)| run.env(name, value));
        run.words(words).logged(&self.log)?.go()?;
        let seconds = start.elapsed().as_secs();
        writeln!(&self.log, "   (`cargo xtask {words}`: {seconds} s)")
            .map_err(|error| error.to_string())
    }
}

impl Row {
    /// Begins a row. Pass a copy of this program as `program`. The log lies in `folder`.
    pub(crate) fn begin(
        name: &'static str,
        program: &Path,
        folder: &Path,
        environment: &Environment,
        parts: impl FnOnce(&RowRunner) -> Outcome + Send + 'static,
    ) -> Outcome<Self> {
        let log = folder.join(name.replace(' ', "-"));
        let file = File::create(&log).map_err(|error| format!("{}: {error}", log.display()))?;
        let environment = environment.clone();
        let runner = RowRunner { program: program.to_owned(), log: file, environment };
        let thread = std::thread::spawn(move || {
            let start = Instant::now();
            (parts(&runner), start.elapsed())
        });
        Ok(Self { name, log, thread })
    }

    /// Waits until the row ends, prints the log, and returns how long it ran.
    pub(crate) fn finish(self) -> Outcome<Duration> {
        let (outcome, time) = self.thread.join().map_err(|_| format!("{}: panicked", self.name))?;
        print!("{}", String::from_utf8_lossy(&std::fs::read(&self.log).unwrap_or_default()));
        outcome.map(|()| time)
    }
}

/// Ends every process that descends from this one. If the system has no `/proc`, this does nothing.
pub(crate) fn end_descendants() {
    let mut parents = Vec::new();
    for entry in std::fs::read_dir("/proc").into_iter().flatten().flatten() {
        let Ok(id) = entry.file_name().to_string_lossy().parse::<u32>() else { continue };
        let stat = std::fs::read_to_string(entry.path().join("stat")).unwrap_or_default();
        // The name in parentheses may hold spaces; then come state and parent.
        let parent =
            stat.rsplit_once(") ").and_then(|(_, rest)| rest.split(' ').nth(1)?.parse().ok());
        parents.extend(parent.map(|parent: u32| (id, parent)));
    }
    let mut descendants = vec![std::process::id()];
    let mut at = 0;
    while at < descendants.len() {
        let parent = descendants[at];
        descendants.extend(parents.iter().filter(|(_, of)| *of == parent).map(|(id, _)| *id));
        at += 1;
    }
    for id in &descendants[1..] {
        Run::new("kill").args([id.to_string()]).works();
    }
}
