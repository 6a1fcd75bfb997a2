//! Command line of `impasto-studio` and the start settings that result from it.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Parser, ValueEnum};
use graphics::gpu::BackendChoice;

use crate::files::{Backend, FiguresLog, Home, Preferences, Problem};
use session::{Pace, WorkerOptions};

/// Paint by hand with calibrated pigments
///
/// Opens on Van Gogh's oils, a primed linen and a loaded round brush. Files can also be dropped
/// on the window. Exit status: 0 done, 2 could not run.
#[derive(Debug, Parser)]
#[command(name = "impasto-studio", version, max_term_width = 100)]
struct Arguments {
    /// A painting (.exr) to go on with, a pigment library (.json) to begin with, a recording of
    /// strokes (.json) to play, a picture (.png, .jpg, .tif, .webp) to pin beside the canvas, or a
    /// lamp's spectrum to paint under. The content decides. Or a scene of paint volumes: shape:village,
    /// a model (.glb, .obj, .ply) or a script (.toml)
    file: Option<PathBuf>,
    /// Processor or graphics adapter for the paint [default: from the preferences, else
    /// auto]
    #[arg(long, value_enum)]
    backend: Option<BackendName>,
    /// Memory limit of the undo history, in MiB; the oldest actions are dropped beyond
    /// it [default: from the preferences, else 512]
    #[arg(long, value_name = "MIB", value_parser = clap::value_parser!(u64).range(0..=1 << 20))]
    undo_memory: Option<u64>,
    /// Keep preferences and autosaves in this folder instead of the platform's
    #[arg(long, value_name = "FOLDER")]
    home: Option<PathBuf>,
    /// Playback speed of a recording [default: from the preferences, else fast]
    #[arg(long, value_enum, value_name = "PACE")]
    play: Option<PaceName>,
    /// Append one line of JSON a second: frames, latency, sub-steps, steps behind, and
    /// the position of the canvas in the window, in pixels
    #[arg(long, value_name = "FILE")]
    figures: Option<PathBuf>,
    /// Size of the window in points, such as 1280x800 [default: as last used]
    #[arg(long, value_name = "WxH", value_parser = window_size)]
    window: Option<[f32; 2]>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum BackendName {
    /// A hardware graphics adapter if there is one (see `impasto gpu`), else the
    /// processor
    Auto,
    /// The processor, on all cores
    Cpu,
    /// A graphics adapter, including software ones
    Gpu,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum PaceName {
    /// Maximum speed of the machine
    Fast,
    /// At the speed it was painted
    Painted,
}

fn window_size(text: &str) -> Result<[f32; 2], String> {
    let size = text.split_once(['x', 'X']).and_then(|(width, height)| {
        let [width, height] = [width, height]
            .map(|text| text.parse::<f32>().ok().filter(|l| (200.0..=16_384.0).contains(l)));
        Some([width?, height?])
    });
    size.ok_or_else(|| "expected two lengths from 200 to 16384, such as 1280x800".to_owned())
}

/// Settings that the window starts with.
#[derive(Debug)]
pub struct Start {
    /// File to open first.
    pub file: Option<PathBuf>,
    /// Folders for preferences and autosaves.
    pub home: Home,
    /// Preferences read from the file, or defaults.
    pub preferences: Preferences,
    /// Problems found in the preferences file. The window shows them.
    pub problems: Vec<Problem>,
    /// Backend and undo memory of the worker.
    pub worker: WorkerOptions,
    /// Playback speed of recordings, if you gave one on the command line.
    pub pace: Option<Pace>,
    /// Performance log, if asked for.
    pub figures: Option<FiguresLog>,
    /// Width and height of the window in points.
    pub window: [f32; 2],
}

/// Text printed instead of starting: help or an error.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stop {
    /// Text to print, with its final newline.
    pub text: String,
    /// Exit status: 0 if you asked for help, 2 if the program cannot start.
    pub status: u8,
}

impl Start {
    /// Parses the command line. The first argument is the program's name.
    ///
    /// # Errors
    /// [`Stop`] for `--help` and `--version`, invalid arguments, a log file that cannot be opened,
    /// and a system without a home folder.
    pub fn from_arguments(
        arguments: impl IntoIterator<Item = impl Into<OsString> + Clone>,
    ) -> Result<Self, Stop> {
        let parsed = Arguments::try_parse_from(arguments).map_err(|error| Stop {
            text: error.render().to_string(),
            status: if error.use_stderr() { 2 } else { 0 },
        })?;
        let home = match &parsed.home {
            Some(folder) => std::path::absolute(folder).ok().map(|path| Home::in_folder(&path)),
            None => Home::for_platform(),
        };
        let home = home.ok_or_else(|| {
            let what = "the system reports no home folder";
            Problem::new(what, "give one with impasto-studio --home FOLDER")
        })?;
        let (preferences, problems) = Preferences::read(&home.preferences());
        let backend = match (parsed.backend, preferences.backend) {
            (Some(BackendName::Auto), _) | (None, Backend::Auto) => BackendChoice::Auto,
            (Some(BackendName::Cpu), _) | (None, Backend::Cpu) => BackendChoice::Cpu,
            (Some(BackendName::Gpu), _) | (None, Backend::Gpu) => BackendChoice::Gpu,
        };
        let undo_bytes = parsed.undo_memory.unwrap_or(preferences.undo_mib) << 20;
        let figures = parsed.figures.as_deref().map(FiguresLog::open);
        let figures = figures.transpose().map_err(Stop::from)?;
        Ok(Self {
            file: parsed.file,
            home,
            window: parsed.window.or(preferences.window).unwrap_or([1280.0, 800.0]),
            preferences,
            problems,
            worker: WorkerOptions { backend, undo_bytes },
            pace: parsed.play.map(|pace| match pace {
                PaceName::Fast => Pace::Fast,
                PaceName::Painted => Pace::AsPainted,
            }),
            figures,
        })
    }
}

impl From<Problem> for Stop {
    fn from(problem: Problem) -> Self {
        let hint = problem.hint.as_ref().map(|hint| format!("hint: {hint}\n"));
        Self { text: format!("error: {}\n{}", problem.text, hint.unwrap_or_default()), status: 2 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn start(arguments: &[&str]) -> Result<Start, Stop> {
        Start::from_arguments(["impasto-studio"].iter().chain(arguments))
    }

    #[test]
    fn the_command_line_overrides_the_preferences() {
        let folder = tempfile::tempdir().unwrap();
        let home = folder.path().to_str().unwrap();
        let preferences = Preferences {
            undo_mib: 64,
            backend: Backend::Gpu,
            window: Some([1000.0, 700.0]),
            ..Preferences::default()
        };
        preferences.write(&Home::in_folder(folder.path()).preferences()).unwrap();
        let plain = start(&["--home", home]).unwrap();
        assert_eq!(plain.worker.backend, BackendChoice::Gpu);
        assert_eq!((plain.worker.undo_bytes, plain.window), (64 << 20, [1000.0, 700.0]));
        let settings = start(&[
            "a.exr",
            "--home",
            home,
            "--backend",
            "cpu",
            "--undo-memory",
            "8",
            "--window",
            "640x480",
            "--play",
            "painted",
        ]);
        let settings = settings.unwrap();
        assert_eq!(settings.file, Some(PathBuf::from("a.exr")));
        assert_eq!(
            settings.worker,
            WorkerOptions { backend: BackendChoice::Cpu, undo_bytes: 8 << 20 }
        );
        assert_eq!((settings.window, settings.pace), ([640.0, 480.0], Some(Pace::AsPainted)));
        assert_eq!(settings.preferences, preferences, "they stay as they are");
    }

    #[test]
    fn help_exits_with_0_and_errors_with_2() {
        assert_eq!(start(&["--help"]).unwrap_err().status, 0);
        for arguments in [
            &["--window", "8x8"][..],
            &["--window", "large"],
            &["--backend", "quantum"],
            &["--undo-memory", "-1"],
            &["a.exr", "b.exr"],
            &["--figures", "/no/such/folder/figures.jsonl"],
        ] {
            let stop = start(arguments).unwrap_err();
            assert_eq!(stop.status, 2, "{arguments:?}");
            assert!(stop.text.starts_with("error:"), "{arguments:?}: {}", stop.text);
        }
    }
}
